#include "scene/plan/half.h"

#include <algorithm>
#include <functional>

#include "brdf/catalogue/registry.h"
#include "brdf/in_number/number.h"
#include "brdf/term/product.h"
#include "integrate/rule/slopes.h"
#include "number/half.h"
#include "scene/kernel/multiple.h"

namespace gonio::scene {
namespace {

constexpr std::size_t channels = 3;
using Values = std::vector<double>;

/// A term of a model at rows, in halves.
Values in_half(const BoundModel& b,
               const TermUse& term,
               std::size_t channel,
               std::span<const FrameAngles<double>> rows) {
  Values out(rows.size());
  catalogue_in(Number::half)
      .terms[term.term]
      .values(term_parameters(b, term, channel), rows, out.data());
  return out;
}

/// Lobes and diffuse terms of a model in one channel.
struct Shares {
  std::vector<Values> diffuse, shape, fresnel;
  bool coupled = false;
};
Shares shares_of(const BoundModel& b,
                 std::size_t channel,
                 std::span<const FrameAngles<double>> rows) {
  Shares s;
  for (const auto& term : b.model.diffuse) {
    s.diffuse.push_back(in_half(b, term, channel, rows));
    s.coupled |= catalogue()[term.term].coupled;
  }
  for (const auto& lobe : b.model.lobes) {
    const auto d = in_half(b, lobe.ndf, 0, rows), v = in_half(b, lobe.masking, 0, rows);
    auto& shape = s.shape.emplace_back(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
      shape[i] = static_cast<double>(Half(d[i]) * Half(v[i]));
    s.fresnel.push_back(in_half(b, lobe.fresnel, channel, rows));
  }
  return s;
}

/// F of a channel by the spectrum, its sum in halves too.
Values spectral_in_half(const SpectralMetal<double>& metal,
                        std::size_t channel,
                        std::span<const FrameAngles<double>> rows) {
  const SpectralReflectance<Half> f(metal.in<Half>());
  Values out;
  for (const auto& a : rows) out.push_back(static_cast<double>(f(Half(a.voh))[channel]));
  return out;
}

Half multiple(const MultipleScattering& m,
              const AlbedoCurve<Half>& albedo,
              std::size_t channel,
              const Half& lobe,
              const FrameAngles<double>& a) {
  const auto how = forms_of(Effect::compensation)[m.form];
  const Half strength(m.strength[channel]), nov(a.nov);
  if (how == "kulla_conty")
    return added_by_kulla_conty(strength, lost_to_bounces(albedo, Half(a.nol), nov));
  if (how == "turquin") return added_by_turquin(lobe, value_at(albedo, nov), strength);
  if (how == "fdez_aguera") return added_by_fdez_aguera(lobe, value_at(albedo, nov), strength);
  return Half(0);
}

}  // namespace

std::vector<Rgb> radiance_in_half(const Surface& s, const LitPoints& p) {
  std::vector<Rgb> sum(p.count, Rgb{});
  std::span<const FrameAngles<double>> angles = p.angles;
  if (s.image_lit) {
    std::ranges::transform(p.view, sum.begin(), std::cref(*s.image_lit));
    angles = angles.first(p.sky);
  }
  const auto albedo = s.multiple.albedo.in<Half>();
  for (std::size_t c = 0; c < channels; ++c) {
    Shares base = shares_of(s.base, c, angles);
    if (s.spectrum) base.fresnel[0] = spectral_in_half(*s.spectrum, c, angles);
    const Shares coat = s.coat ? shares_of(*s.coat, c, angles) : Shares{};
    for (std::size_t i = 0; i < angles.size(); ++i) {
      Half f(0);
      for (const auto& d : base.diffuse) f = f + Half(d[i]);
      for (std::size_t l = 0; l < base.shape.size(); ++l) {
        const Half under = l == 0 && base.coupled ? f : Half(0);
        const Half dv(base.shape[l][i]), fresnel(base.fresnel[l][i]);
        f = s.spectrum && l == 0 ? spectral_lobe(f, under, dv, fresnel)
                                 : lobe_on(f, under, One{}, dv, fresnel);
      }
      if (!base.shape.empty())
        f = f + multiple(s.multiple, albedo, c, Half(base.shape[0][i]) * Half(base.fresnel[0][i]),
                         angles[i]);
      if (s.coat) f = lobe_on(f, f, One{}, Half(coat.shape[0][i]), Half(coat.fresnel[0][i]));
      sum[p.point[i]][c] += static_cast<double>(f) * p.weight[i][c];
    }
  }
  return sum;
}

}  // namespace gonio::scene
