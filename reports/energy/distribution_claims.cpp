// Claims on distributions and on sums over the hemisphere: that Phong is Beckmann, that irradiance
// is a sum.
#include "reports/energy/distribution_claims.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "brdf/catalogue/registry.h"
#include "integrate/rule/quadrature.h"
#include "integrate/rule/slopes.h"
#include "reports/finding/words.h"

#include <fmt/format.h>

namespace gonio {
namespace {

/// D of each cosine of the half vector.
std::vector<double> distribution(std::string_view id,
                                 double alpha,
                                 const std::vector<double>& cosine) {
  AngleBlock block(false);
  const auto x = block.resize(cosine.size());
  for (std::size_t i = 0; i < cosine.size(); ++i) {
    for (const std::size_t k : {0U, 1U, 3U}) x[k][i] = 1;
    x[2][i] = cosine[i];
    x[4][i] = (1 - cosine[i]) * (1 + cosine[i]);
  }
  term_values(find_term(id), std::array{alpha}, block.block(), block.extra(0));
  return {block.extra(0), block.extra(0) + cosine.size()};
}

/// ½ ∫ |D₁ − D₂| cos θ dω, over the logarithm of tan θ.
double apart(std::string_view one, std::string_view other, double alpha) {
  constexpr int nodes = 400;
  const double low = std::log(1e-4 * alpha), high = std::log(1e4);
  std::vector<double> cosine, weight;
  for (const auto& node : gauss_legendre(nodes)) {
    const double t = std::exp(low + node.x * (high - low)), c = 1 / std::sqrt(1 + t * t);
    cosine.push_back(c);
    // cos θ dω = 2π cos θ sin θ dθ, and dθ = t cos² θ d(ln t)
    weight.push_back(node.weight * (high - low) * 2 * std::numbers::pi * c * (t * c) * t * c * c);
  }
  const auto a = distribution(one, alpha, cosine), b = distribution(other, alpha, cosine);
  double sum = 0;
  for (std::size_t i = 0; i < cosine.size(); ++i) sum += weight[i] * std::abs(a[i] - b[i]);
  return sum / 2;
}

void phong_is_beckmann(Findings& to, const EnergyRows& r) {
  const auto& all = r.claims.phong_from_beckmann;
  if (all.empty()) return;
  const auto &smooth = all.front(), &rough = all.back();
  to.judge(
      "Phong and Beckmann are equivalent by the exponent 2α⁻² − 2",
      "the exponent that Walter et al. 2007 recommend",
      verdict(rough.share < 0.01, smooth.share < 0.01),
      fmt::format("{} of the facets' projected area is distributed differently at roughness {:g}",
                  percent(rough.share, 2), rough.roughness),
      fmt::format("at roughness {:g} they differ by {}.", smooth.roughness,
                  percent(smooth.share, 2)));
}

void irradiance_is_a_sum(Findings& to, const EnergyRows& r) {
  const auto of = [&](std::string_view rule) {
    return std::ranges::find_if(r.light.irradiance,
                                [&](const IrradianceRow& x) { return x.rule == rule; });
  };
  const auto low = of("riemann"), middle = of("riemann_midpoint"), end = r.light.irradiance.end();
  if (low == end || middle == end) return;
  to.judge("irradiance is a Riemann sum, divided by the number of samples", "",
           verdict_on_small(std::abs(low->bias)),
           fmt::format("the sum is off by {} at {} samples", percent(low->bias, 2), low->samples),
           fmt::format("with more samples the error vanishes. The sky is brighter towards the "
                       "zenith. With samples at the middle of each step the sum is off by {}.",
                       percent(middle->bias, 2)));
}

}  // namespace

std::vector<ClaimRows::Apart> phong_from_beckmann() {
  std::vector<ClaimRows::Apart> out;
  for (const double roughness : {0.2, 0.3, 0.5, 0.7, 0.9})
    out.push_back({roughness, apart("ndf.blinn_phong", "ndf.beckmann", roughness * roughness)});
  return out;
}

void judge_distributions_and_sums(Findings& to, const EnergyRows& r) {
  phong_is_beckmann(to, r);
  irradiance_is_a_sum(to, r);
}

}  // namespace gonio
