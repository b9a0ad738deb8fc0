#include "table/health.h"

#include <algorithm>
#include <limits>

#include "table/directional_albedo.h"
#include "table/peak.h"
#include "table/quantile.h"
#include "table/reciprocity.h"

namespace gonio {
namespace {

void count_values(const Table& t, Health& h) {
  const SampleAngles at(t);
  std::vector<double> negatives;
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < t.size(); ++i) {
    const auto a = at(i);
    for (const auto& plane : t.values) {
      const double v = plane[i];
      const Mask m = mask(a, v);
      ++h.masked[static_cast<std::size_t>(m)];
      if (m == Mask::negative) negatives.push_back(-v);
      if (m != Mask::valid) continue;
      h.largest = std::max(h.largest, v);
      if (v > 0) smallest = std::min(smallest, v);
    }
  }
  h.samples = t.size();
  h.values = t.size() * t.values.size();
  h.valid = h.masked[static_cast<std::size_t>(Mask::valid)];
  if (std::isfinite(smallest)) h.smallest_positive = smallest;
  if (t.negative_is_noise && !negatives.empty()) h.noise_floor = 1.4826 * median(negatives);
}

}  // namespace

Health inspect(const Table& t) {
  Health h;
  count_values(t, h);
  h.albedo = directional_albedo(t);
  auto [error, note] = reciprocity(t);
  h.reciprocity_error = error;
  h.reciprocity_note = note;
  const Bins bins = t.grid() ? t.grid()->bins : Bins::centre;
  h.peak = find_peak(t, bins);
  if (h.peak && t.has_bins())
    if (const auto other = find_peak(t, bins == Bins::centre ? Bins::edge : Bins::centre))
      h.bin_sensitivity = other->alpha / h.peak->alpha - 1;
  return h;
}

}  // namespace gonio
