#include "scene/surface/lobe_albedo.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "brdf/catalogue/registry.h"
#include "brdf/model/evaluate.h"
#include "integrate/albedo/directional_albedo.h"
#include "integrate/albedo/ggx_albedo.h"
#include "integrate/rule/quadrature.h"
#include "integrate/rule/slopes.h"

namespace gonio::scene {
namespace {

constexpr double goal = 1e-5;

/// Lobe at F = 1, and what is known of it.
struct White {
  BoundModel model;
  std::optional<SmithGgx> ggx;
  double alpha;

  double operator()(double mu) const {
    if (ggx) return ggx_albedo(alpha, mu, *ggx, goal).value;
    if (!model.model.anisotropic) return at(mu, 0);
    double sum = 0;  // one quarter is as the others: the mean of two within it
    for (const double eighth : {1.0, 3.0}) sum += at(mu, eighth * std::numbers::pi / 8) / 2;
    return sum;
  }
  double at(double mu, double phi) const {
    return directional_albedo(model, {{mu}}, phi, {goal, 200'000})[0].value[0];
  }
};

White white_of(const BoundModel& whole) {
  BoundModel one = whole;
  one.model.diffuse.clear();
  one.model.lobes.resize(1);
  White w{furnace(one), {}, 0};
  w.model.model.channels = 1;
  const auto& lobe = w.model.model.lobes[0];
  const auto id = [](const TermUse& t) { return catalogue()[t.term].id(); };
  const auto parameters = term_parameters(w.model, lobe.ndf, 0);
  const bool round = id(lobe.ndf) == "ndf.ggx_aniso" && parameters[0] == parameters[1];
  w.alpha = w.model.model.anisotropic ? std::sqrt(parameters[0] * parameters[1]) : parameters[0];
  if (id(lobe.ndf) == "ndf.ggx" || round) {
    if (id(lobe.masking).ends_with(".correlated")) w.ggx = SmithGgx::correlated;
    if (id(lobe.masking) == "masking.smith_ggx.separable") w.ggx = SmithGgx::separable;
  }
  return w;
}

}  // namespace

LobeAlbedo lobe_albedo(const BoundModel& model) {
  const White white = white_of(model);
  LobeAlbedo a;
  auto& curve = a.curve;
  constexpr std::size_t n = curve.terms;
  curve.width = white.alpha;
  curve.scale = 2 * std::sqrt(1 + white.alpha);
  const double top = 2 / curve.scale;
  std::array<double, n> value;
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = std::numbers::pi * (static_cast<double>(i) + 0.5) / n;
    const double root = top * (1 + std::cos(angle)) / 2, square = root * root;
    value[i] = white(std::clamp(white.alpha * square / (1 - square), 1e-9, 1.0));
    for (std::size_t k = 0; k < n; ++k)
      curve.coefficient[k] +=
          (k == 0 ? 1.0 : 2.0) / n * value[i] * std::cos(static_cast<double>(k) * angle);
  }
  a.average = 0;
  for (const auto& node : gauss_legendre(32))
    a.average += 2 * node.weight * node.x * value_at(curve, node.x);
  return a;
}

}  // namespace gonio::scene
