#include "integrate/split_sum.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "brdf/model.h"
#include "brdf/registry.h"
#include "integrate/directional_albedo.h"
#include "integrate/slopes.h"
#include "optics/fresnel_approximate.h"

#include <fmt/format.h>

namespace gonio {
namespace {

/// Channels F0 = 0 and F0 = 1, so that one integral gives B and A + B.
BoundModel two_interfaces(std::string_view masking, double roughness) {
  const auto term =
      masking.starts_with("masking.") ? find_term(masking) : find_term(masking, Role::masking);
  if (catalogue()[term].anisotropic)
    throw wrong_usage(fmt::format("{} is anisotropic: the split sum's table has one roughness",
                                  catalogue()[term].about->id));
  return bind_model(fmt::format("ggx/{}/schlick", short_id(catalogue()[term].about->id)),
                    {{"roughness", {roughness}}, {"f0", {0, 1}}});
}

void check(double nov) {
  if (!(0 < nov && nov <= 1)) throw wrong_usage(fmt::format("nov = {} is outside (0, 1]", nov));
}

/// i's binary digits mirrored behind the point.
double radical_inverse(std::uint32_t i) {
  std::uint32_t mirrored = 0;
  for (int bit = 0; bit < 32; ++bit) mirrored |= (i >> bit & 1U) << (31 - bit);
  return mirrored * 0x1p-32;
}

}  // namespace

std::vector<SplitSum> split_sum(std::string_view masking,
                                double roughness,
                                std::span<const double> nov,
                                const Goal& goal) {
  for (const double c : nov) check(c);
  const Goal half{goal.error / 2, goal.evaluations};
  const auto lobe = directional_albedo(two_interfaces(masking, roughness), nov, 0, half);
  const auto under = diffuse_albedo(
      bind_model("lambert.coupled+ggx/smith_ggx.correlated/schlick", {{"kd", {1}}, {"f0", {0}}}),
      nov, 0, goal);
  std::vector<SplitSum> rows;
  for (std::size_t i = 0; i < nov.size(); ++i) {
    const double b = lobe[i].value[0];
    rows.push_back(
        {lobe[i].value[1] - b, b, under[i].value[0], std::max(2 * lobe[i].error, under[i].error)});
  }
  return rows;
}

std::vector<SplitSum> sampled_split_sum(std::string_view masking,
                                        double roughness,
                                        std::span<const double> nov,
                                        std::size_t samples) {
  if (samples == 0 || samples > std::numeric_limits<std::uint32_t>::max())
    throw wrong_usage(fmt::format("samples = {} is outside [1, 4294967295]", samples));
  const auto model = two_interfaces(masking, roughness);
  const auto& lobe = model.model.lobes.front();
  const auto parameters = term_parameters(model, lobe.masking, 0);
  const double alpha2 = square(square(roughness)), n = static_cast<double>(samples);
  constexpr std::size_t at_once = 4096;
  std::vector<SplitSum> rows;
  for (const double mu : nov) {
    check(mu);
    const double sine = std::sqrt((1 - mu) * (1 + mu));
    SplitSum sum{0, 0, 0, std::numeric_limits<double>::quiet_NaN()};
    AngleBlock block(model.model.anisotropic);
    std::vector<double> weight, c;
    for (std::size_t first = 0; first < samples; first += at_once) {
      const std::size_t count = std::min(at_once, samples - first);
      const auto x = block.resize(count);
      weight.assign(count, 0);
      c.assign(count, 0);
      for (std::size_t k = 0; k < count; ++k) {
        const double u = static_cast<double>(first + k) / n;
        const double w = radical_inverse(static_cast<std::uint32_t>(first + k));
        const double along = std::cos(2 * std::numbers::pi * u);

        const double nol_d = std::sqrt(1 - w);
        const double lov = nol_d * mu + std::sqrt(w) * along * sine;
        sum.diffuse += 1 - schlick_weight(std::sqrt((1 + lov) / 2));

        const double t2 = alpha2 * w / (1 - w), noh = 1 / std::sqrt(1 + t2);
        const double voh = noh * (mu + sine * std::sqrt(t2) * along), nol = 2 * voh * noh - mu;
        const bool above = nol > 0 && voh > 0;
        x[0][k] = above ? std::min(nol, 1.0) : 0.5;
        x[1][k] = mu;
        x[2][k] = noh;
        x[3][k] = above ? std::min(voh, 1.0) : 0.5;
        x[4][k] = t2 * noh * noh;
        if (above) weight[k] = 4 * nol * voh / noh;
        c[k] = schlick_weight(x[3][k]);
      }
      double* const v = block.extra(0);
      term_values(lobe.masking.term, parameters, block.block(), v);
      for (std::size_t k = 0; k < count; ++k) {
        sum.a += weight[k] * v[k] * (1 - c[k]);
        sum.b += weight[k] * v[k] * c[k];
      }
    }
    sum.a /= n;
    sum.b /= n;
    sum.diffuse /= n;
    rows.push_back(sum);
  }
  return rows;
}

}  // namespace gonio
