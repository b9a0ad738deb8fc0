#include "fitting/export/materialx_layers.h"

#include <algorithm>
#include <cmath>

#include "brdf/formula/coat.h"
#include "brdf/formula/diffuse.h"
#include "brdf/formula/masking.h"
#include "brdf/formula/ndf_anisotropic.h"
#include "brdf/formula/scattering.h"
#include "brdf/term/product.h"
#include "fitting/export/placement.h"
#include "geometry/direction.h"
#include "optics/fresnel.h"
#include "optics/fresnel_approximate.h"

namespace gonio {
namespace {

/// A layer's parts that its parameters alone decide.
class Prepared {
 public:
  explicit Prepared(const MaterialxLayer& l)
      : layer_(l),
        cos_(std::cos(l.tangent_deg * degree)),
        sin_(std::sin(l.tangent_deg * degree)),
        alpha_(std::sqrt(l.alpha_x * l.alpha_y)),
        d_(std::array{l.alpha_x, l.alpha_y}),
        v_(std::array{alpha_}) {}

  /// f of each channel, and what goes through to below.
  void operator()(const FrameAngles<double>& at,
                  std::span<double> f,
                  std::span<double> through) const {
    const auto a = turned(at, cos_, sin_);
    const double dv = as_value<double>(d_(a) * v_(a));
    const auto [e, e_a, e_b] = mapped<AlbedoFitMaterialx, double>(alpha_, a.nov);
    double mean = 0;
    for (std::size_t c = 0; c < layer_.channels.size(); ++c) {
      const auto& channel = layer_.channels[c];
      const double r = channel.fresnel(a);
      f[c] = layer_.weight * channel.tint * Turquin<double>::apply(std::array{dv * r, e, r})[0];
      const double single = channel.f0 * e_a + channel.f90 * e_b;
      const double albedo = Turquin<double>::apply(std::array{single, e, r})[0];
      through[c] = left_by_view(layer_.weight * albedo);
      mean += through[c] / static_cast<double>(layer_.channels.size());
    }
    if (layer_.grey_through) std::ranges::fill(through, mean);
  }

 private:
  const MaterialxLayer& layer_;
  double cos_, sin_, alpha_;
  GgxAniso<double> d_;
  SmithGgxCorrelated<double> v_;
};

}  // namespace

std::vector<std::vector<double>> evaluate(const MaterialxSurface& s,
                                          std::span<const FrameAngles<double>> angles) {
  const std::size_t n = s.kd.size();
  std::vector<Prepared> layers;
  for (const auto& l : s.layers)
    if (l.weight > 0) layers.emplace_back(l);
  std::vector<Eon<double>> eon;
  std::vector<OrenNayar<double>> plain;
  for (const double kd : s.kd) {
    eon.emplace_back(std::array{kd, s.diffuse_roughness});
    plain.emplace_back(std::array{kd, s.diffuse_roughness});
  }
  std::vector<std::vector<double>> f(n, std::vector<double>(angles.size()));
  std::vector<double> own(n), through(n), left(n);
  for (std::size_t i = 0; i < angles.size(); ++i) {
    std::ranges::fill(left, 1.0);
    for (const auto& layer : layers) {
      layer(angles[i], own, through);
      for (std::size_t c = 0; c < n; ++c) f[c][i] += left[c] * own[c], left[c] *= through[c];
    }
    for (std::size_t c = 0; c < n; ++c)
      f[c][i] += left[c] * (s.compensated ? eon[c](angles[i]) : plain[c](angles[i]));
  }
  return f;
}

LayerFresnel dielectric_layer(double eta) {
  return [f = Dielectric<double>(std::array{eta})](const Angles<double>& a) { return f(a); };
}
LayerFresnel artistic_layer(double f0, double edge) {
  return [f = Gulbrandsen<double>(std::array{std::min(f0, 0.99), edge})](const Angles<double>& a) {
    return f(a);
  };
}
LayerFresnel f82_layer(double f0, double tint) {
  return [f = F82Tint<double>(std::array{f0, tint})](const Angles<double>& a) { return f(a); };
}

}  // namespace gonio
