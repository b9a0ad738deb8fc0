#include "fitting/batch/preview.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <span>

#include "base/base64.h"
#include "brdf/model/evaluate.h"
#include "geometry/half_difference.h"
#include "image/display.h"
#include "integrate/albedo/directional_albedo.h"
#include "table/cut/cuts.h"

#include <fmt/format.h>

namespace gonio {
namespace {

constexpr double sky = 0.35, sun = 0.65;  // parts of the light on a surface that faces the sun
constexpr double sun_deg = 40;            // from the viewer, upwards

/// To so many significant digits: what a small picture shows, and half the bytes.
double rounded(double v, int digits) {
  return std::isfinite(v) ? std::strtod(fmt::format("{:.{}g}", v, digits).c_str(), nullptr) : v;
}

/// Which points of a curve to keep: the one at `centre`, and from there outwards such as lie apart by
/// a third of their distance from it, within limits.  A peak keeps its shape however narrow it is.
std::vector<std::size_t> thinned(const std::vector<double>& deg, std::size_t centre) {
  const auto apart = [&](double d) { return std::clamp(std::abs(d - deg[centre]) / 3, 1.0, 6.0); };
  std::vector<std::size_t> kept{centre};
  for (std::size_t i = centre, last = centre; i-- > 0;)
    if (deg[last] - deg[i] >= apart(deg[i])) kept.push_back(last = i);
  std::ranges::reverse(kept);
  for (std::size_t i = centre + 1, last = centre; i < deg.size(); ++i)
    if (deg[i] - deg[last] >= apart(deg[i])) kept.push_back(last = i);
  return kept;
}

/// The points of a cut where any channel has a value, thinned around the largest.
void thin(const Cut& cut,
          const std::vector<std::vector<double>>& from,
          std::vector<double>& deg,
          std::vector<std::vector<double>>& to) {
  std::vector<std::size_t> there;
  std::size_t centre = 0;
  double largest = -1;
  for (std::size_t i = 0; i < cut.deg.size(); ++i) {
    double most = -1;
    for (const auto& channel : from)
      if (std::isfinite(channel[i])) most = std::max(most, channel[i]);
    if (most < 0) continue;
    // Grazing values would set the scale of the picture.
    if (most > largest && std::abs(cut.deg[i]) < 80) {
      largest = most;
      centre = there.size();
    }
    there.push_back(i);
  }
  std::vector<double> places;
  for (const std::size_t i : there) places.push_back(cut.deg[i]);
  to.assign(from.size(), {});
  if (there.empty()) return;
  for (const std::size_t k : thinned(places, centre)) {
    deg.push_back(rounded(places[k], 4));
    for (std::size_t c = 0; c < from.size(); ++c) to[c].push_back(rounded(from[c][there[k]], 3));
  }
}

std::optional<Thumbnail> thumbnail(const Table& table, const BoundModel& fitted) {
  const auto cuts = make_cuts(table, fitted);
  if (cuts.empty()) return {};
  const Cut& cut =
      *std::ranges::min_element(cuts, {}, [](const Cut& c) { return std::abs(c.at_deg - 30); });
  Thumbnail t{cut.at, rounded(cut.at_deg, 4), cut.along, {}, {}, {}, {}, {}};
  const std::size_t all = cut.data.size(), shown = std::min<std::size_t>(all, 4);
  std::vector<std::vector<double>> data, model;
  for (std::size_t k = 0; k < shown; ++k) {
    t.channels.push_back(shown == all ? k : k * (all - 1) / (shown - 1));
    data.push_back(cut.data[t.channels[k]]);
    model.push_back(cut.model[t.channels[k]]);
  }
  thin(cut, data, t.data_deg, t.data);
  thin(cut, model, t.model_deg, t.model);
  return t;
}

/// Goal as close as the picture and its four digits show.
constexpr Goal seen{.error = 1e-4, .evaluations = 100'000};

/// Channel c between albedos at cosines 0, 1/n, …, 1.
double interpolated(const std::vector<Albedo>& at, std::size_t c, double cosine) {
  const double x = cosine * static_cast<double>(at.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(x), at.size() - 2);
  return std::lerp(at[i].value[c], at[i + 1].value[c], x - static_cast<double>(i));
}

std::string sphere(const std::vector<std::string>& channels, const BoundModel& fitted) {
  constexpr std::size_t n = Preview::size;
  std::vector<double> cosines;
  for (int i = 0; i <= 12; ++i) cosines.push_back(std::max(i / 12.0, 0.02));
  const auto under_sky = directional_albedo(fitted, cosines, 0, seen);

  // In the viewer's frame: x right, y up, z to the viewer.
  const Direction light{0, std::sin(sun_deg * degree), std::cos(sun_deg * degree)};
  std::vector<FrameAngles<double>> x;
  std::vector<bool> inside;
  for (std::size_t row = 0; row < n; ++row)
    for (std::size_t column = n / 2; column < n; ++column) {
      const double scale = 2.0 / static_cast<double>(n);
      const double right = (static_cast<double>(column) + 0.5) * scale - 1;
      const double up = 1 - (static_cast<double>(row) + 0.5) * scale;
      const double z2 = 1 - right * right - up * up;
      inside.push_back(z2 > 0);
      const Direction normal{right, up, std::sqrt(std::max(z2, 0.0))};
      // The tangent is where the azimuth around the vertical grows.
      const double across = std::max(std::hypot(normal.x, normal.z), 1e-9);
      const Direction tangent{normal.z / across, 0, -normal.x / across};
      const Direction bitangent{-normal.x * up / across, across, -normal.z * up / across};
      x.push_back(frame_angles({{dot(tangent, light), dot(bitangent, light), dot(normal, light)},
                                {tangent.z, bitangent.z, normal.z}}));
    }
  const auto f = evaluate(fitted, x);

  std::string bytes;
  std::vector<double> shown(channels.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t c = 0; c < shown.size(); ++c)
      shown[c] = sky * interpolated(under_sky, c, x[i].nov) +
                 sun * std::numbers::pi * f[c][i] * std::max(x[i].nol, 0.0);
    for (const double v : colour_of_channels(channels, shown))
      bytes += inside[i] ? static_cast<char>(srgb_byte(v)) : '\0';
  }
  return base64(bytes);
}

}  // namespace

Preview make_preview(const Table& table, const BoundModel& fitted) {
  Preview p{thumbnail(table, fitted), {}, sphere(table.channels, fitted)};
  const std::array at{std::cos(30 * degree)};
  const auto albedo = directional_albedo(fitted, at, 0, seen);
  for (const double a : albedo[0].value) p.albedo.push_back(rounded(a, 4));
  return p;
}

}  // namespace gonio
