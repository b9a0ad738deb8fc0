#include "fitting/data.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "table/health.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace gonio {
namespace {

/// Tells incident angles apart: the rows of a theta_i axis that are no copies, the angles of a list to
/// 0.001°, whole degrees on a half/difference grid, where every sample has its own.
class IncidentKey {
 public:
  explicit IncidentKey(const Table& t) : table_(t), first_(first_of_copies(t)) {}
  std::uint32_t operator()(std::size_t i, const Angles<double>& a) const {
    if (const auto* l = table_.list())
      return static_cast<std::uint32_t>(std::lround(l->theta_i_deg[i] * 1000));
    if (!first_.empty()) return static_cast<std::uint32_t>(first_[table_.grid()->unravel(i)[0]]);
    return static_cast<std::uint32_t>(std::acos(std::clamp(a.nol, 0.0, 1.0)) / degree);
  }

 private:
  const Table& table_;
  std::vector<std::size_t> first_;
};

/// Replaces the keys, which are small numbers, by those from 0 on; returns how many there are.
std::size_t compact(std::vector<std::uint32_t>& keys) {
  if (keys.empty()) return 0;
  std::vector<std::uint32_t> number(*std::ranges::max_element(keys) + std::size_t{1});
  for (const auto k : keys) number[k] = 1;
  std::uint32_t next = 0;
  for (auto& n : number)
    if (n) n = next++;
  for (auto& k : keys) k = number[k];
  return next;
}

constexpr std::size_t chunk = 16384;

struct Counts {
  std::size_t samples = 0, used = 0, zero = 0, zero_weight = 0;
  double weight = 0;
  std::array<std::size_t, mask_names.size()> masked{};
};

}  // namespace

FitData fit_data(const Table& t, Bins bins, Metric metric, double offset) {
  const SampleAngles at(t, bins);
  const std::size_t n = t.size(), channels = t.values.size(), chunks = (n + chunk - 1) / chunk;
  if (metric == Metric::l2_cosine) offset = 0;
  const auto weight = [&](std::size_t i) { return t.weights.empty() ? 1.0 : t.weights[i]; };

  std::vector<Counts> counts(chunks);
  tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t k) {
    Counts& c = counts[k];
    for (std::size_t i = k * chunk; i < std::min(n, (k + 1) * chunk); ++i) {
      const auto a = at(i);
      bool any = false;
      for (const auto& channel : t.values) {
        const Mask m = mask(a, channel[i]);
        ++c.masked[static_cast<std::size_t>(m)];
        if (m != Mask::valid) continue;
        const bool zero = !usable(metric, channel[i], offset), weightless = !(weight(i) > 0);
        c.zero += zero;
        c.zero_weight += weightless && !zero;
        c.used += !zero && !weightless;
        any = any || !weightless;
      }
      c.samples += any;
      if (any) c.weight += weight(i);
    }
  });

  FitData d;
  d.metric = metric;
  d.offset = offset;
  Counts total;
  std::vector<std::size_t> first;
  for (const auto& c : counts) {
    first.push_back(total.samples);
    total.samples += c.samples;
    total.used += c.used;
    total.zero += c.zero;
    total.weight += c.weight;
    total.zero_weight += c.zero_weight;
    for (std::size_t m = 0; m < c.masked.size(); ++m) total.masked[m] += c.masked[m];
  }
  for (std::size_t m = 1; m < mask_names.size(); ++m) d.masked[mask_names[m]] = total.masked[m];
  if (!usable(metric, 0, offset)) d.masked["zero"] = total.zero;
  if (!t.weights.empty()) d.masked["zero_weight"] = total.zero_weight;
  d.values_used = total.used;
  if (total.used == 0) {
    std::string reasons;
    for (const auto& [reason, count] : d.masked)
      if (count) reasons += fmt::format("{}{} {}", reasons.empty() ? "" : ", ", count, reason);
    throw bad_input(t.path, "values", fmt::format("none that can be used ({})", reasons),
                    "at least one");
  }

  d.angles = AngleColumns<double>(total.samples);
  const std::size_t padded = d.angles.padded();
  const auto column = [&](double in_padding) {
    auto c = Column<double>::for_overwrite(padded);
    std::fill(c.data() + total.samples, c.data() + padded, in_padding);
    return c;
  };
  for (std::size_t c = 0; c < channels; ++c) d.y.push_back(column(-1));
  d.root_weight = column(0);
  d.incident.resize(total.samples);
  const IncidentKey key(t);
  const double mean_weight = total.weight / static_cast<double>(total.samples);
  if (!std::isfinite(mean_weight))
    throw bad_input(t.path, "weights", "a sum that is not finite", "weights of a usual size");
  tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t k) {
    std::size_t to = first[k];
    std::vector<double> value(channels);
    for (std::size_t i = k * chunk; i < std::min(n, (k + 1) * chunk); ++i) {
      if (!(weight(i) > 0)) continue;
      const auto a = at(i);
      bool any = false;
      for (std::size_t c = 0; c < channels; ++c) {
        const double v = t.values[c][i];
        value[c] = mask(a, v) == Mask::valid ? v : -1;
        any = any || value[c] >= 0;
      }
      if (!any) continue;
      for (std::size_t c = 0; c < channels; ++c) d.y[c][to] = value[c];
      d.angles.set(to, a);
      d.root_weight[to] = std::sqrt(weight(i) / mean_weight);
      d.incident[to] = key(i, a);
      ++to;
    }
  });
  d.clusters = compact(d.incident);
  return d;
}

FitData thinned(const FitData& d, std::size_t most) {
  // An odd step: an even one would visit the same columns of every row of an even grid.
  const std::size_t step = d.samples() <= most ? 1 : (d.samples() / most) | 1U;
  const std::size_t n = (d.samples() + step - 1) / step;
  FitData s;
  s.angles = AngleColumns<double>(n);
  s.root_weight = Column<double>(s.angles.padded(), 0.0);
  for (std::size_t c = 0; c < d.y.size(); ++c) s.y.emplace_back(s.angles.padded(), -1.0);
  s.incident.resize(n);
  s.clusters = d.clusters;
  s.metric = d.metric;
  s.offset = d.offset;
  const auto x = d.angles.block();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t from = i * step;
    s.angles.set(i, {x.nol[from], x.nov[from], x.noh[from], x.voh[from], x.sin2_theta_h[from]});
    s.root_weight[i] = d.root_weight[from];
    s.incident[i] = d.incident[from];
    for (std::size_t c = 0; c < d.y.size(); ++c) {
      s.y[c][i] = d.y[c][from];
      s.values_used += usable(d.metric, d.y[c][from], d.offset);
    }
  }
  return s;
}

}  // namespace gonio
