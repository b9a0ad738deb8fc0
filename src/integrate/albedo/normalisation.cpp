#include "integrate/albedo/normalisation.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "brdf/catalogue/registry.h"
#include "integrate/rule/slopes.h"

namespace gonio {
namespace {

/// True where D grows as NoH⁻² or faster towards the horizon: ∫ D NoH dω has no value then, however
/// little D is.
bool diverges_at_the_horizon(std::size_t term, std::span<const double> parameters) {
  constexpr std::array cosines{1e-50, 1e-60};
  AngleBlock block(true);
  for (const double azimuth : {0.0, std::numbers::pi / 4, std::numbers::pi / 2}) {
    const auto c = block.resize(cosines.size());
    for (std::size_t i = 0; i < cosines.size(); ++i) {
      for (double* const column : c) column[i] = 0.5;
      c[2][i] = cosines[i];
      c[4][i] = 1;
      c[5][i] = std::cos(azimuth);
      c[6][i] = std::sin(azimuth);
    }
    double* const d = block.extra(0);
    term_values(term, parameters, block.block(), d);
    const double far = d[0] * square(cosines[0]), near = d[1] * square(cosines[1]);
    if (far > 0 && near > 0.99 * far) return true;
  }
  return false;
}

}  // namespace

Normalisation normalisation(std::size_t term,
                            std::span<const double> parameters,
                            const Goal& goal) {
  constexpr double pi = std::numbers::pi, infinity = std::numeric_limits<double>::infinity();
  if (diverges_at_the_horizon(term, parameters)) return {infinity, infinity, 0};
  const bool turned = catalogue()[term].anisotropic;
  const auto widths = slope_widths(term, parameters);
  AngleBlock block(turned);
  std::vector<double> weight;
  // x in [0, 1]: θ_h from the horizon, where the integral may diverge and numbers are densest, to
  // 45°. x in [1, 2]: (x − 1) S = s, where tan θ_h = |d| sinh s reaches 1 at S. y: ψ in a quarter
  // of the plane.
  const auto f = [&](std::span<const double> x, std::span<const double> y,
                     std::span<double* const> out) {
    const auto c = block.resize(x.size());
    weight.resize(x.size());
    for (std::size_t line = 0; line < y.size(); ++line) {
      const double dx = widths[0] * std::cos(y[line]), dy = widths[1] * std::sin(y[line]);
      const double d = turned ? std::hypot(dx, dy) : widths[0];
      const double end = std::asinh(1 / d);
      // d²p = α_x α_y ρ dρ dψ over the whole turn
      const double scale = widths[0] * (turned ? 4 * widths[1] : 2 * pi * widths[0]);
      for (std::size_t k = 0; k < line_nodes; ++k) {
        const std::size_t i = line * line_nodes + k;
        double noh, sine, rho, drho;
        if (x[i] > 1) {
          const double e = std::exp(end * (x[i] - 1));
          rho = (e - 1 / e) / 2;
          drho = end * (e + 1 / e) / 2;
          noh = 1 / std::sqrt(1 + square(d * rho));
          sine = d * rho * noh;
        } else {
          const double left = pi / 4 * x[i];
          noh = std::sin(left);
          sine = std::cos(left);
          rho = sine / noh / d;
          drho = pi / 4 / (noh * noh * d);
        }
        for (const std::size_t unread : {0, 1, 3}) c[unread][i] = 0.5;
        c[2][i] = noh;
        c[4][i] = sine * sine;
        if (turned) {
          for (std::size_t unread = 7; unread < 11; ++unread) c[unread][i] = 0.5;
          c[5][i] = sine * dx / d;
          c[6][i] = sine * dy / d;
        }
        weight[i] = scale * rho * drho * square(square(noh));  // dω NoH = NoH⁴ d²p
      }
    }
    double* const value = block.extra(0);
    term_values(term, parameters, block.block(), value);
    for (std::size_t i = 0; i < x.size(); ++i) out[0][i] = value[i] * weight[i];
  };
  const double quarter = turned ? pi / 2 : 0;
  const auto i = integrate(
      f, 1, {{{0, 0}, {1, quarter}}, {{1, 0}, {1.25, quarter}}, {{1.25, 0}, {2, quarter}}}, goal);
  return {i.value[0], i.error, i.evaluations};
}

}  // namespace gonio
