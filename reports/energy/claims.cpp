// Integrals by which claims on highlights and on energy are judged.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/random.h"
#include "brdf/catalogue/registry.h"
#include "geometry/direction.h"
#include "image/colour_difference.h"
#include "integrate/albedo/directional_albedo.h"
#include "integrate/rule/quadrature.h"
#include "integrate/rule/slopes.h"
#include "reports/energy/distribution_claims.h"
#include "reports/energy/energy.h"

namespace gonio {
namespace {

using std::numbers::pi;

/// E of a model at a cosine, to 1e-6.
double reflected(std::string_view spec, double roughness, double f0, double mu) {
  const auto b = bind_model(spec, {{"alpha", {roughness * roughness}}, {"f0", {f0}}}, 1);
  return directional_albedo(b, {&mu, 1}, 0, {1e-6, 400'000})[0].value[0];
}

/// Losses at normal incidence, where the peak of D is cut.
std::vector<ClaimRows::Clamped> clamped_at_2048() {
  std::vector<ClaimRows::Clamped> out;
  for (const double roughness : {0.14, 0.1, 0.07, 0.045}) {
    const auto shipped = reflected("ggx.ue_mobile/smith_ggx.correlated/constant", roughness, 1, 1);
    const auto whole = reflected("ggx/smith_ggx.correlated/constant", roughness, 1, 1);
    out.push_back({roughness, 1 - shipped / pi / whole});
  }
  return out;
}

/// Colour of a reflectance under even light.
Lab grey(double y) {
  constexpr std::array white{1.0, 1.0, 1.0};
  return lab({y, y, y}, white);
}

/// Looks from the roughness on at which its clamp is not reached.
std::vector<ClaimRows::Look> looks_of_the_simple_form(const EnergyForm& simple) {
  std::vector<ClaimRows::Look> out;
  for (const double f0 : {0.04, 0.9})
    for (const double mu : {1.0, 0.1}) {
      ClaimRows::Look most{f0, mu, 0, 0, 0, -1};
      for (const auto& at : simple.rows) {
        if (at.mu != mu || at.roughness < unclamped_roughness - 1e-9) continue;
        const double shipped = f0 * at.albedo;
        const double exact = reflected("ggx/smith_ggx.correlated/schlick", at.roughness, f0, mu);
        const double d = delta_e_2000(grey(shipped), grey(exact));
        if (d > most.delta_e) most = {f0, mu, at.roughness, shipped, exact, d};
      }
      if (most.delta_e >= 0) out.push_back(most);
    }
  return out;
}

/// Standard deviation along an axis, over α, of slopes up to `most` times α: of p = D cos⁴θ,
/// σ² = ½ ∫ t² p 2πt dt, where ∫ p 2πt dt = 1 over all slopes.
double deviation(std::string_view ndf, double alpha, double most) {
  constexpr int decades_of_nodes = 40;
  const double low = std::log(1e-4 * alpha), high = std::log(most * alpha);
  const auto nodes = gauss_legendre(decades_of_nodes * 4);
  AngleBlock block(false);
  const auto x = block.resize(nodes.size());
  std::vector<double> weight(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double t = std::exp(low + nodes[i].x * (high - low)), c2 = 1 / (1 + t * t);
    for (const std::size_t k : {0U, 1U, 3U}) x[k][i] = 1;
    x[2][i] = std::sqrt(c2);
    x[4][i] = t * t * c2;
    weight[i] = nodes[i].weight * (high - low) * pi * std::pow(t, 4) * c2 * c2;
  }
  double* const d = block.extra(0);
  term_values(find_term(ndf), std::array{alpha}, block.block(), d);
  double sum = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) sum += weight[i] * d[i];
  return std::sqrt(sum) / alpha;
}

/// Half vector of l + step·e and v, minus that of l − step·e.
Direction moved(const Direction& l, const Direction& v, const Direction& e, double step) {
  const auto half = [&](double s) {
    Direction h{l.x + s * e.x, l.y + s * e.y, l.z + s * e.z};
    const double length = std::sqrt(dot(h, h));
    h = {h.x / length + v.x, h.y / length + v.y, h.z / length + v.z};
    const double half_length = std::sqrt(dot(h, h));
    return Direction{h.x / half_length, h.y / half_length, h.z / half_length};
  };
  const auto a = half(step), b = half(-step);
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Direction cross(const Direction& a, const Direction& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

ClaimRows::HalfAngle solid_angle_of_half() {
  constexpr std::size_t pairs = 1000;
  constexpr double step = 1e-4;
  double most = 0;
  for (std::size_t i = 0; i < pairs; ++i) {
    Draws draw(1, i);
    const auto upper = [&] {
      return direction(std::acos(draw.uniform()), 2 * pi * draw.uniform());
    };
    const Direction l = upper(), v = upper();
    const double voh = std::sqrt((1 + dot(l, v)) / 2);
    const double theta = std::acos(l.z), phi = std::atan2(l.y, l.x);
    const Direction along = direction(theta + pi / 2, phi),
                    across{-std::sin(phi), std::cos(phi), 0};
    const auto area = cross(moved(l, v, along, step), moved(l, v, across, step));
    const double ratio = std::sqrt(dot(area, area)) / (4 * step * step);
    most = std::max(most, std::abs(ratio * 4 * voh - 1));
  }
  return {pairs, step, most};
}

}  // namespace

ClaimRows claim_rows(const std::vector<EnergyForm>& forms) {
  ClaimRows out;
  out.clamped = clamped_at_2048();
  if (const auto* simple = find_form(forms, "model.ue_mobile_simple"))
    out.simple_form = looks_of_the_simple_form(*simple);
  for (const double most : {10.0, 100.0, 1000.0})
    out.ggx_slopes.push_back({most, deviation("ndf.ggx", 0.3, most)});
  out.beckmann_deviation = deviation("ndf.beckmann", 0.3, 100);
  out.half_angle = solid_angle_of_half();
  out.phong_from_beckmann = phong_from_beckmann();
  return out;
}

}  // namespace gonio
