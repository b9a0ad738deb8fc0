#include "table/health.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "table/directional_albedo.h"
#include "table/peak.h"
#include "table/quantile.h"
#include "table/reciprocity.h"

namespace gonio {
namespace {

void count_values(const Table& t, Health& h) {
  const SampleAngles at(t);
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < t.size(); ++i) {
    const auto a = at(i);
    for (const auto& plane : t.values) {
      const double v = plane[i];
      const Mask m = mask(a, v);
      ++h.masked[static_cast<std::size_t>(m)];
      if (m != Mask::valid) continue;
      h.largest = std::max(h.largest, v);
      if (v > 0) smallest = std::min(smallest, v);
    }
  }
  h.samples = t.size();
  h.values = t.size() * t.values.size();
  h.valid = h.masked[static_cast<std::size_t>(Mask::valid)];
  if (std::isfinite(smallest)) h.smallest_positive = smallest;
  h.noise_floor = noise_floor(t);
}

}  // namespace

double noise_floor(const Table& t) {
  if (!t.negative_is_noise) return 0;
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
  return 2 * same > sizes.size() ? 0 : 1.4826 * middle;
}

std::vector<std::size_t> first_of_copies(const Table& t) {
  const Grid* g = t.grid();
  if (!g || g->kind != Grid::Kind::in_out) return {};
  const std::size_t rows = g->axes[0].size, width = g->size() / rows;
  const auto copies = [&](std::size_t row) {
    bool varies = false;
    for (const auto& plane : t.values) {
      const double* const here = plane.data() + row * width;
      if (std::memcmp(here, here - width, width * sizeof(double)) != 0) return false;
      varies = varies || std::any_of(here, here + width, [&](double v) { return v != here[0]; });
    }
    return varies;
  };
  std::vector<std::size_t> first(rows);
  for (std::size_t row = 1; row < rows; ++row) first[row] = copies(row) ? first[row - 1] : row;
  return first;
}

std::size_t copied_rows(const Table& t) {
  const auto first = first_of_copies(t);
  std::size_t copies = 0;
  for (std::size_t row = 0; row < first.size(); ++row) copies += first[row] != row;
  return copies;
}

Health inspect(const Table& t) {
  Health h;
  count_values(t, h);
  h.copied_rows = copied_rows(t);
  h.albedo = directional_albedo(t);
  auto [error, note] = reciprocity(t);
  h.reciprocity_error = error;
  h.reciprocity_note = note;
  const Bins bins = t.bins();
  h.peak = find_peak(t, bins);
  if (h.peak && t.has_bins())
    if (const auto other = find_peak(t, bins == Bins::centre ? Bins::edge : Bins::centre))
      h.bin_sensitivity = other->alpha / h.peak->alpha - 1;
  return h;
}

}  // namespace gonio
