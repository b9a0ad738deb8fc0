#include "table/health/health.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

#include "base/quantile.h"
#include "table/health/facts.h"
#include "table/health/prospects.h"
#include "table/health/reciprocity.h"
#include "table/health/value_warnings.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

namespace gonio {
namespace {

struct Tally {
  std::array<std::size_t, names_of<Mask>.size()> masked{};
  double largest = 0, smallest = std::numeric_limits<double>::infinity();
};

Tally tally(const Table& t) {
  const SampleAngles at(t);
  using Range = tbb::blocked_range<std::size_t>;
  return tbb::parallel_reduce(
      Range(0, t.size(), 1 << 14), Tally{},
      [&](const Range& r, Tally sum) {
        for (std::size_t i = r.begin(); i < r.end(); ++i) {
          const auto a = at(i);
          for (const auto& plane : t.values) {
            const double v = plane[i];
            const Mask m = mask(a, v);
            ++sum.masked[static_cast<std::size_t>(m)];
            if (m != Mask::valid) continue;
            sum.largest = std::max(sum.largest, v);
            if (v > 0) sum.smallest = std::min(sum.smallest, v);
          }
        }
        return sum;
      },
      [](Tally a, const Tally& b) {
        for (std::size_t m = 0; m < a.masked.size(); ++m) a.masked[m] += b.masked[m];
        a.largest = std::max(a.largest, b.largest);
        a.smallest = std::min(a.smallest, b.smallest);
        return a;
      });
}

/// Size that negative values typically have; 0 where there are next to none, or they are a mark.
double negative_size(const Table& t) {
  const auto has_negative = [](const Values& plane) {
    return std::ranges::any_of(plane, [](double v) { return v < 0; });
  };
  if (!t.negative_is_noise || std::ranges::none_of(t.values, has_negative)) return 0;
  const SampleAngles at(t);
  std::vector<double> sizes;
  std::size_t above_horizon = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const auto a = at(i);
    for (const auto& plane : t.values) {
      const Mask m = mask(a, plane[i]);
      above_horizon += m != Mask::below_horizon;
      if (m == Mask::negative) sizes.push_back(-plane[i]);
    }
  }
  if (sizes.empty() || sizes.size() * 1000 < above_horizon) return 0;
  const double middle = median(sizes);
  // More than half of them one number: a mark for missing data, as a format would have one.
  const auto same = static_cast<std::size_t>(std::ranges::count(sizes, middle));
  return 2 * same > sizes.size() ? 0 : middle;
}

}  // namespace

double noise_floor(const Table& t) {
  TableFacts facts(t);
  return facts.noise_floor();
}

double negative_offset(TableFacts& facts) {
  const double size = negative_size(facts.table());
  return size > 0 && negatives_follow_neighbours(facts.table()) ? size : 0;
}

double spread_of_negatives(const Table& t) {
  const double size = negative_size(t);
  if (size == 0) return 0;
  TableFacts facts(t);
  return facts.negative_channel() ? 0 : 1.4826 * size;
}

double noise_floor(TableFacts& facts) {
  const double size = negative_size(facts.table());
  return size > 0 && !facts.negative_channel() && facts.negative_offset() == 0 ? 1.4826 * size : 0;
}

std::vector<std::size_t> first_of_copies(const Table& t, std::size_t axis) {
  const Grid* g = t.grid();
  if (!g || g->kind != Grid::Kind::in_out) return {};
  // A slice of axis 0 is one run of values, one of axis 1 a run for each incident angle.
  const std::size_t n = g->axes[axis].size, width = axis == 0 ? g->size() / n : g->axes[2].size;
  const std::size_t runs = g->size() / n / width;
  const auto copies = [&](std::size_t slice) {
    bool varies = false;
    for (const auto& plane : t.values) {
      const double first = plane[slice * width];
      for (std::size_t r = 0; r < runs; ++r) {
        const double* const here = plane.data() + (r * n + slice) * width;
        if (std::memcmp(here, here - width, width * sizeof(double)) != 0) return false;
        varies = varies || std::any_of(here, here + width, [&](double v) { return v != first; });
      }
    }
    return varies;
  };
  std::vector<std::size_t> first(n);
  for (std::size_t i = 1; i < n; ++i) first[i] = copies(i) ? first[i - 1] : i;
  return first;
}

std::size_t copied_rows(const Table& t, std::size_t axis) {
  const auto first = first_of_copies(t, axis);
  std::size_t copies = 0;
  for (std::size_t i = 0; i < first.size(); ++i) copies += first[i] != i;
  return copies;
}

std::vector<bool> copied_pairs(const Table& t) {
  const auto in = first_of_copies(t, 0), out = first_of_copies(t, 1);
  std::vector<bool> copied;
  for (std::size_t i = 0; i < in.size(); ++i)
    for (std::size_t o = 0; o < out.size(); ++o) copied.push_back(in[i] != i || out[o] != o);
  if (std::ranges::find(copied, true) == copied.end()) copied.clear();
  return copied;
}

IncidentAngles incident_angles(const DirectionList& l) {
  constexpr long turn = 360'000;
  const auto rounded = [&](double deg) {
    return static_cast<std::size_t>(turn + std::clamp(std::lround(deg * 1000), -turn, turn));
  };
  if (l.theta_i_deg.size() <
      static_cast<std::size_t>(turn) / 10) {  // a place for each would take longer
    std::vector<std::size_t> met;
    for (const double deg : l.theta_i_deg) met.push_back(rounded(deg));
    std::ranges::sort(met);
    met.erase(std::unique(met.begin(), met.end()), met.end());
    IncidentAngles few{met.size(), {}};
    for (const double deg : l.theta_i_deg)
      few.number.push_back(
          static_cast<std::uint32_t>(std::ranges::lower_bound(met, rounded(deg)) - met.begin()));
    return few;
  }
  std::vector<std::uint32_t> number(2 * turn + 1);
  for (const double deg : l.theta_i_deg) number[rounded(deg)] = 1;
  IncidentAngles all;
  for (auto& n : number) all.count += std::exchange(n, static_cast<std::uint32_t>(all.count));
  for (const double deg : l.theta_i_deg) all.number.push_back(number[rounded(deg)]);
  return all;
}

std::string layout_text(const Table& t) {
  const Grid* g = t.grid();
  if (!g) return fmt::format("{} samples", t.size());
  std::string s;
  for (const auto& a : g->axes) s += fmt::format("{}{} {}", s.empty() ? "" : " × ", a.size, a.name);
  return s;
}

std::string width_in_words(const NextDirection& d, double width) {
  return std::isnan(width) ? "not known"
                           : fmt::format("{:.2g} ({:.2g} %)", width, 100 * width / d.over);
}

std::string peak_in_words(const Highlight& p) {
  std::string s =
      fmt::format("half width {:.3g}° (like GGX alpha {:.3g}), {:.0f} sample{} within it, ",
                  p.half_width_deg, p.alpha, p.samples_within, p.samples_within == 1 ? "" : "s");
  switch (p.limit) {
    case PeakLimit::none:
      return s + "resolved";
    case PeakLimit::samples:
      return s + fmt::format("{}: alpha is at most {}{:.3g}",
                             p.samples_within <= 1 ? "one sample wide, so limited by the instrument"
                                                   : "not resolved",
                             p.samples_within <= 1 ? "" : "about ", p.alpha);
    case PeakLimit::aperture:
      return s + "as narrow as the instrument: only a fit parts the lobe's own width from it";
    case PeakLimit::bins:
      break;
  }
  return s +
         fmt::format("limited by the bins: where samples sit in them changes alpha by {:+.0f} %",
                     100 * p.bin_sensitivity.value_or(0));
}

double typical_uncertainty(const Table& t) {
  std::vector<double> parts;
  for (std::size_t c = 0; c < t.errors.size(); ++c)
    for (std::size_t i = 0; i < t.errors[c].size(); ++i)
      if (const double y = t.values[c][i]; y > 0 && t.errors[c][i] > 0)
        parts.push_back(t.errors[c][i] / y);
  return parts.empty() ? std::nan("") : median(parts);
}

Health inspect(const Table& t) {
  TableFacts facts(t);
  Health h;
  const Tally counts = tally(t);
  h.samples = t.size();
  h.values = t.size() * t.values.size();
  h.masked = counts.masked;
  h.valid = h.masked[static_cast<std::size_t>(Mask::valid)];
  h.largest = counts.largest;
  if (std::isfinite(counts.smallest)) h.smallest_positive = counts.smallest;
  h.noise_floor = facts.noise_floor();
  h.copied_rows = copied_rows(t, 0);
  h.copied_columns = copied_rows(t, 1);
  h.albedo = facts.albedo().known;
  h.albedo_left_out = facts.albedo().left_out;
  h.reciprocity_error = facts.reciprocity().error;
  h.reciprocity_note = facts.reciprocity().note;
  h.noise = facts.noise();
  const Bins bins = t.bins();
  const PeakSearch& search = facts.peak();
  h.peak_profiles = search.profiles;
  h.peak_contrast = search.contrast;
  if (search.peak) {
    Highlight& p = h.peak.emplace(Highlight{*search.peak, PeakLimit::none, {}});
    if (t.has_bins())
      if (const auto other = find_peak(t, bins == Bins::centre ? Bins::edge : Bins::centre).peak)
        p.bin_sensitivity = other->alpha / p.alpha - 1;
    // A mirror's image is as wide as both cones; h turns by half of that, to either side.
    const double of_instrument = (t.aperture.light + t.aperture.detector) / 4 / degree;
    if (p.half_width_deg < 1.5 * of_instrument)
      p.limit = PeakLimit::aperture;
    else if (!p.resolved)
      p.limit = PeakLimit::samples;
    else if (std::abs(p.bin_sensitivity.value_or(0)) > 0.1)
      p.limit = PeakLimit::bins;
  }
  h.retro = facts.retro();
  h.prospects = prospects(facts, h);
  for (auto& w : value_warnings(facts)) h.warnings.push_back(w.whole());
  return h;
}

}  // namespace gonio
