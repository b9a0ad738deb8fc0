#include "fitting/data.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/error.h"

namespace gonio {
namespace {

/// Numbers the incident angles: the rows of a theta_i axis, the distinct angles of a list (to
/// 0.001°), whole degrees on a half/difference grid, where every sample has its own.
class IncidentAngle {
 public:
  explicit IncidentAngle(const Table& t) : table_(t) {
    if (const auto* l = t.list())
      for (const double theta : l->theta_i_deg) ids_.try_emplace(key(theta), 0);
    std::uint16_t next = 0;
    for (auto& [k, id] : ids_) id = std::min<std::uint16_t>(next++, 65534);
  }
  std::size_t count() const {
    if (table_.list()) return std::min<std::size_t>(ids_.size(), 65535);
    return by_row() ? table_.grid()->axes[0].size : 90;
  }
  std::uint16_t operator()(std::size_t i, const Angles<double>& a) const {
    if (const auto* l = table_.list()) return ids_.at(key(l->theta_i_deg[i]));
    if (by_row()) return static_cast<std::uint16_t>(table_.grid()->unravel(i)[0]);
    const double deg = std::acos(std::clamp(a.nol, 0.0, 1.0)) / degree;
    return static_cast<std::uint16_t>(std::min(deg, 89.0));
  }

 private:
  bool by_row() const { return table_.grid()->kind == Grid::Kind::in_out; }
  static long key(double theta_deg) { return std::lround(theta_deg * 1000); }
  const Table& table_;
  std::map<long, std::uint16_t> ids_;
};

constexpr std::size_t chunk = 16384;

struct Counts {
  std::size_t samples = 0, used = 0, zero = 0, zero_weight = 0;
  std::array<std::size_t, mask_names.size()> masked{};
};

}  // namespace

double noise_offset(const Table& t) {
  if (!t.negative_is_noise) return 0;
  std::vector<double> negative;
  std::size_t all = 0;
  for (const auto& channel : t.values)
    for (const double v : channel) {
      ++all;
      if (v < 0 && std::isfinite(v)) negative.push_back(-v);
    }
  if (negative.size() * 1000 < all || negative.empty()) return 0;
  const auto middle = negative.begin() + static_cast<std::ptrdiff_t>(negative.size() / 2);
  std::ranges::nth_element(negative, middle);
  return 1.4826 * *middle;
}

FitData fit_data(const Table& t, Bins bins, Metric metric, double offset) {
  const SampleAngles at(t, bins);
  const std::size_t n = t.size(), channels = t.values.size(), chunks = (n + chunk - 1) / chunk;
  const bool needs_positive = metric != Metric::l2_cosine && offset == 0;
  const auto usable = [&](const Angles<double>& a, double v) {
    return mask(a, v) == Mask::valid && !(needs_positive && v == 0);
  };
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
        const bool zero = needs_positive && channel[i] == 0, weightless = !(weight(i) > 0);
        c.zero += zero;
        c.zero_weight += weightless && !zero;
        c.used += !zero && !weightless;
        any = any || (!zero && !weightless);
      }
      c.samples += any;
    }
  });

  FitData d;
  d.offset = metric == Metric::l2_cosine ? 0 : offset;
  Counts total;
  std::vector<std::size_t> first;
  for (const auto& c : counts) {
    first.push_back(total.samples);
    total.samples += c.samples;
    total.used += c.used;
    total.zero += c.zero;
    total.zero_weight += c.zero_weight;
    for (std::size_t m = 0; m < c.masked.size(); ++m) total.masked[m] += c.masked[m];
  }
  for (std::size_t m = 1; m < mask_names.size(); ++m) d.masked[mask_names[m]] = total.masked[m];
  if (needs_positive) d.masked["zero"] = total.zero;
  if (!t.weights.empty()) d.masked["zero_weight"] = total.zero_weight;
  d.values_used = total.used;
  if (total.samples == 0) {
    std::string reasons;
    for (const auto& [reason, count] : d.masked)
      if (count) reasons += fmt::format("{}{} {}", reasons.empty() ? "" : ", ", count, reason);
    throw bad_input(t.path, "values", fmt::format("none that can be used ({})", reasons), "at least one");
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
  const IncidentAngle incident(t);
  d.clusters = incident.count();
  tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t k) {
    std::size_t to = first[k];
    std::vector<double> value(channels);
    for (std::size_t i = k * chunk; i < std::min(n, (k + 1) * chunk); ++i) {
      if (!(weight(i) > 0)) continue;
      const auto a = at(i);
      bool any = false;
      for (std::size_t c = 0; c < channels; ++c) {
        const double v = t.values[c][i];
        value[c] = usable(a, v) ? v : -1;
        any = any || value[c] >= 0;
      }
      if (!any) continue;
      for (std::size_t c = 0; c < channels; ++c) d.y[c][to] = value[c];
      d.angles.set(to, a);
      d.root_weight[to] = std::sqrt(weight(i));
      d.incident[to] = incident(i, a);
      ++to;
    }
  });
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
  s.offset = d.offset;
  const auto x = d.angles.block();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t from = i * step;
    s.angles.set(i, {x.nol[from], x.nov[from], x.noh[from], x.voh[from], x.sin2_theta_h[from]});
    s.root_weight[i] = d.root_weight[from];
    s.incident[i] = d.incident[from];
    for (std::size_t c = 0; c < d.y.size(); ++c) {
      s.y[c][i] = d.y[c][from];
      s.values_used += d.y[c][from] >= 0;
    }
  }
  return s;
}

}  // namespace gonio
