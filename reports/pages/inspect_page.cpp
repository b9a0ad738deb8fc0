#include "reports/pages/inspect_page.h"

#include <algorithm>
#include <limits>
#include <numbers>

#include "base/json/describe.h"
#include "reports/page/assets.h"
#include "reports/page/page.h"
#include "reports/pages/angle_bins.h"
#include "reports/pages/fields.h"
#include "reports/picture/json_numbers.h"
#include "table/health/directional_albedo.h"
#include "table/health/reciprocity.h"

namespace gonio {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

AngleBins picture_bins(const Table& t) {
  const Grid* g = t.grid();
  if (!g && !t.between) return {Grid::Kind::half_difference, 45, 30};
  if (!g || g->kind == Grid::Kind::in_out || g->axes[2].size > 1)
    return {Grid::Kind::half_difference, 90, 90};
  return {Grid::Kind::half_difference, std::min<std::size_t>(g->axes[0].size, 180),
          std::min<std::size_t>(g->axes[1].size, 180)};
}

AngleBins trust_bins(const Table& t) {
  const Grid* g = t.grid();
  if (!g) return {Grid::Kind::in_out, 18, 18};
  const auto few = [&](std::size_t axis) { return std::min<std::size_t>(g->axes[axis].size, 45); };
  return {g->kind, few(0), few(1)};
}

}  // namespace

SlicePicture make_slice_picture(const Table& t) {
  const AngleBins bins = picture_bins(t);
  const std::size_t cells = bins.x * bins.y;
  SlicePicture p{none, bins.x_deg(), bins.y_deg(), {}};
  if (const Grid* g = t.grid(); g || t.between) {
    const bool one = g && g->kind == Grid::Kind::half_difference && g->axes[2].size == 1;
    const double phi_d = one ? g->axes[2].angle(0, g->bins) : std::numbers::pi / 2;
    p.phi_d_deg = phi_d / degree;
    p.value.assign(t.values.size(), std::vector<double>(cells, none));
    const Interpolator between(t);
    for (std::size_t h = 0; h < bins.x; ++h)
      for (std::size_t d = 0; d < bins.y; ++d) {
        // The middle on the axis as it is drawn.
        const double root = (static_cast<double>(h) + 0.5) / static_cast<double>(bins.x),
                     part = (static_cast<double>(d) + 0.5) / static_cast<double>(bins.y);
        const auto at =
            directions(HalfDifference{90 * degree * root * root, 0, 90 * degree * part, phi_d});
        if (!(at.wi.z > 0 && at.wo.z > 0)) continue;
        for (std::size_t c = 0; c < t.values.size(); ++c)
          p.value[c][h * bins.y + d] = between(at, c);
      }
    return p;
  }
  const SampleAngles at(t);
  for (const auto& plane : t.values) {
    std::vector<double> sum(cells), count(cells);
    for (std::size_t i = 0; i < t.size(); ++i) {
      const auto a = at(i);
      if (mask(a, plane[i]) != Mask::valid) continue;
      sum[bins.cell(a)] += plane[i];
      ++count[bins.cell(a)];
    }
    for (std::size_t k = 0; k < cells; ++k) sum[k] = count[k] > 0 ? sum[k] / count[k] : none;
    p.value.push_back(std::move(sum));
  }
  return p;
}

TrustMap make_trust_map(const Table& t) {
  const AngleBins bins = trust_bins(t);
  const std::size_t cells = bins.x * bins.y;
  TrustMap map{bins.x_name(),
               bins.y_name(),
               bins.x_deg(),
               bins.y_deg(),
               std::vector<std::size_t>(cells),
               {},
               std::vector<double>(cells),
               std::vector<std::size_t>(cells)};
  for (auto& counts : map.masked) counts.assign(cells, 0);
  const SampleAngles at(t);
  for (std::size_t i = 0; i < t.size(); ++i) {
    const auto a = at(i);
    const std::size_t k = bins.cell(a);
    map.values[k] += t.values.size();
    for (const auto& plane : t.values) ++map.masked[static_cast<std::size_t>(mask(a, plane[i]))][k];
  }
  for_each_reciprocal(t, [&](std::size_t i, std::size_t, double a, double b) {
    const std::size_t k = bins.cell(at(i));
    map.reciprocity[k] += reciprocity_error(a, b);
    ++map.pairs[k];
  });
  for (std::size_t k = 0; k < cells; ++k)
    map.reciprocity[k] =
        map.pairs[k] ? map.reciprocity[k] / static_cast<double>(map.pairs[k]) : none;
  return map;
}

InspectPage make_inspect_page(const Table& t) {
  return {t.channels, make_cuts(t), make_slice_picture(t), make_trust_map(t), albedo_curve(t, 5)};
}

std::string to_json(const InspectPage& page, std::string_view health_json) {
  return json_line(InspectPageDocument{{health_json}, page}, Digits::six);
}

std::string inspect_page_schema() {
  return schema_text<InspectPageDocument>("Page of a table");
}

std::string inspect_page_html(std::string_view title, std::string_view data) {
  return make_page(title, data, std::string(assets::table_js).append(assets::inspect_js));
}

}  // namespace gonio
