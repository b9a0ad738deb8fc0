#include "integrate/scattering/azimuth_integral.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "brdf/catalogue/registry.h"

namespace gonio {

AzimuthIntegral::AzimuthIntegral(Facets facets, int nodes)
    : facets_(std::move(facets)),
      ndf_(find_term(facets_.slopes == Microsurface::Slopes::ggx ? "ndf.ggx" : "ndf.beckmann")),
      nodes_(gauss_legendre(nodes)) {}

AzimuthIntegral::Peak AzimuthIntegral::peak(double c, double b, double apart) const {
  const double root = std::max(std::sqrt(b), 1e-300);
  if (facets_.slopes == Microsurface::Slopes::ggx)
    return {std::hypot(apart, facets_.alpha * c) / root, std::numbers::pi};
  const double width = facets_.alpha * c / root;
  return {width, std::min(8 * width, std::numbers::pi)};
}

void AzimuthIntegral::operator()(std::span<const Zenith> from,
                                 const Zenith& to,
                                 std::vector<std::vector<double>>& out) {
  const std::size_t n = from.size() * nodes_.size();
  const auto x = block_.resize(n);
  weight_.resize(n);
  std::size_t at = 0;
  for (const auto& one : from) {
    // of two cosines that rounding has made opposite, not 0
    const double c = std::max(one.cosine + to.cosine, 1e-15), b = one.sine * to.sine;
    // s₁² − s₂² = (c₂ − c₁)(c₂ + c₁)
    const double apart = (to.cosine - one.cosine) * c / std::max(one.sine + to.sine, 1e-300);
    const auto [width, reach] = peak(c, b, apart);
    const double grading = std::max(std::asinh(reach / width), 0.01);
    const double scale = reach / std::sinh(grading);
    for (const auto& node : nodes_) {
      // φ = scale sinh(grading x), from 0 to reach: half of what is symmetric
      const double e = std::exp(grading * node.x);
      const double half_sine = std::sin(scale * (e - 1 / e) / 4);
      const double dphi_dx = scale * grading * (e + 1 / e) / 2;
      const double t = apart * apart + 4 * b * half_sine * half_sine, y = t + c * c;
      const double length = std::sqrt(y);
      x[0][at] = x[1][at] = 0.5;  // not read
      x[2][at] = c / length;
      x[3][at] = std::min(length / 2, 1.0);
      x[4][at] = t / y;
      weight_[at++] = 2 * node.weight * dphi_dx / 4;
    }
  }
  double *const d = block_.extra(0), *const f = block_.extra(1);
  term_values(ndf_, {&facets_.alpha, 1}, block_.block(), d);
  for (std::size_t i = 0; i < n; ++i) weight_[i] *= d[i];
  out.resize(facets_.parameters.size());
  for (std::size_t k = 0; k < out.size(); ++k) {
    term_values(facets_.fresnel, facets_.parameters[k], block_.block(), f);
    out[k].assign(from.size(), 0);
    for (std::size_t i = 0; i < n; ++i) out[k][i / nodes_.size()] += weight_[i] * f[i];
  }
}

}  // namespace gonio
