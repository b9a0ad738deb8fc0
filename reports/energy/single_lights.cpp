// What each compensation does to a picture under one light.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/whole_loop.h"
#include "brdf/formula/scattering.h"
#include "brdf/model/evaluate.h"
#include "geometry/half_difference.h"
#include "image/display.h"
#include "integrate/albedo/ggx_albedo.h"
#include "integrate/scattering/tabulated_lobe.h"
#include "reports/energy/energy.h"

namespace gonio {
namespace {

constexpr double pi = std::numbers::pi;
constexpr std::array f0s{0.04, 0.5, 0.9};
constexpr std::array<std::string_view, 3> ways{"single", "turquin", "kulla_conty"};
struct Light {
  const char* name;
  double from_viewer_deg;
};
constexpr std::array lights{Light{"front light", 30}, Light{"rim light", 120}};

/// Points of a ball, seen from afar, that a light reaches: light and view in the frame of each normal.
std::vector<DirectionPair> lit_points(double from_viewer_deg, std::size_t wanted) {
  constexpr int pixels = 64;
  constexpr double least_cosine = 0.1;  // as other colours of this report
  const double t = from_viewer_deg * degree;
  std::vector<DirectionPair> all;
  for (int i = 0; i < pixels; ++i)
    for (int j = pixels / 2; j < pixels; ++j) {  // the other half is its mirror image
      const double x = (2 * i + 1.0) / pixels - 1, y = (2 * j + 1.0) / pixels - 1;
      const double z2 = 1 - x * x - y * y;
      if (z2 <= 0) continue;
      const double nov = std::sqrt(z2), nol = x * std::sin(t) + nov * std::cos(t);
      if (std::min(nov, nol) < least_cosine) continue;
      const double sines = std::sqrt((1 - nol * nol) * (1 - nov * nov));
      const double turn =
          sines > 0 ? std::acos(std::clamp((std::cos(t) - nol * nov) / sines, -1.0, 1.0)) : 0;
      all.push_back({direction(std::acos(nol), turn), direction(std::acos(nov), 0)});
    }
  std::vector<DirectionPair> some;
  const std::size_t n = std::min(wanted, all.size());
  for (std::size_t k = 0; k < n; ++k) some.push_back(all[(2 * k + 1) * all.size() / (2 * n)]);
  return some;
}

/// ΔE2000 of a point, white where a white diffuser that faces the light is.
double difference(double f, double truth, double nol) {
  const auto seen = [&](double x) { return Rgb{pi * nol * x, pi * nol * x, pi * nol * x}; };
  return displayed_difference(seen(f), seen(truth), 1);
}

/// Rows of one roughness: [light][f0][way].
std::vector<SingleLight> rows_of(double roughness, const EnergyOptions& o) {
  const double alpha = roughness * roughness;
  const auto model = bind_model("ggx/smith_ggx.correlated/schlick",
                                {{"alpha", {alpha}}, {"f0", {f0s.begin(), f0s.end()}}}, f0s.size());
  const TabulatedLobe later(model);  // of all bounces but the first, which is known
  const double average = ggx_average_albedo(alpha).value;
  std::vector<SingleLight> rows;
  for (const auto& light : lights) {
    const std::size_t first = rows.size();
    for (const double f0 : f0s)
      for (const auto way : ways) rows.push_back({way, light.name, f0, roughness, 0, 0, 0});
    const auto points = lit_points(light.from_viewer_deg, o.lit_points);
    for (const auto& at : points) {
      const double nol = at.wi.z, nov = at.wo.z;
      const auto angles = frame_angles(at);
      const auto single = evaluate(model, std::vector{angles});
      const auto more = later.at(angles);
      const double e_light = ggx_albedo(alpha, nol).value, e_view = ggx_albedo(alpha, nov).value;
      for (std::size_t c = 0; c < f0s.size(); ++c) {
        const double truth = single[c][0] + more.f[c];
        const std::array shaded{
            single[c][0], Turquin<double>::apply(std::array{single[c][0], e_view, f0s[c]})[0],
            single[c][0] + KullaContyLobe<double>::apply(
                               std::array{e_light, e_view, average, schlick_average(f0s[c])})[0]};
        for (std::size_t w = 0; w < ways.size(); ++w) {
          auto& row = rows[first + c * ways.size() + w];
          const double off = difference(shaded[w], truth, nol);
          row.delta_e = std::max(row.delta_e, off);
          row.delta_e_mean += off / static_cast<double>(points.size());
          row.error = std::max(row.error, difference(truth + more.error[c], truth, nol));
        }
      }
    }
  }
  return rows;
}

}  // namespace

std::vector<SingleLight> single_lights(const EnergyOptions& o,
                                       const std::function<void(double)>& done) {
  std::vector<double> roughness;
  for (const double r : o.roughness)
    if (std::abs(r * 20 - std::round(r * 20)) < 1e-9 && r >= 0.1 - 1e-9) roughness.push_back(r);
  std::vector<std::vector<SingleLight>> parts(roughness.size());
  for_each_whole(parts.size(), [&](std::size_t i) { parts[i] = rows_of(roughness[i], o); });
  if (done) done(1);
  std::vector<SingleLight> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace gonio
