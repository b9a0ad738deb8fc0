#include "integrate/light/split_sum.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "brdf/catalogue/registry.h"
#include "geometry/sampling.h"
#include "integrate/rule/slopes.h"
#include "optics/fresnel_approximate.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace gonio {
namespace {

void check(std::size_t samples) {
  if (samples == 0 || samples > std::numeric_limits<std::uint32_t>::max())
    throw wrong_usage(fmt::format("samples = {} is outside [1, 4294967295]", samples));
}
double sine_of(double cosine) {
  return std::sqrt((1 - cosine) * (1 + cosine));
}

/// At one NoV, from half vectors in columns.
SplitSum sampled(const BoundModel& model, double alpha, double mu, std::size_t samples) {
  constexpr std::size_t at_once = 4096;
  const auto& masking = model.model.lobes.front().masking;
  const auto parameters = term_parameters(model, masking, 0);
  const double n = static_cast<double>(samples), sine = sine_of(mu);
  SplitSum sum{0, 0, std::numeric_limits<double>::quiet_NaN()};
  AngleBlock block(false);
  std::vector<double> weight;
  for (std::size_t first = 0; first < samples; first += at_once) {
    const std::size_t count = std::min(at_once, samples - first);
    const auto x = block.resize(count);
    weight.resize(count);
    for (std::size_t k = 0; k < count; ++k) {
      const auto [u, w] = hammersley(static_cast<std::uint32_t>(first + k), n);
      const double t2 = square(alpha) * w / (1 - w), noh = 1 / std::sqrt(1 + t2);
      const double along = std::cos(2 * std::numbers::pi * u);
      const double voh = noh * (mu + sine * std::sqrt(t2) * along);
      weight[k] = 4 * put_half_vector(x, k, mu, noh, voh, t2 * noh * noh) * voh / noh;
    }
    double* const v = block.extra(0);
    term_values(masking.term, parameters, block.block(), v);
    for (std::size_t k = 0; k < count; ++k) {
      const double c = schlick_weight(x[3][k]);
      sum.a += weight[k] * v[k] * (1 - c);
      sum.b += weight[k] * v[k] * c;
    }
  }
  sum.a /= n;
  sum.b /= n;
  return sum;
}

}  // namespace

BoundModel two_interfaces(std::string_view masking,
                          double roughness,
                          const std::array<double, 2>& f0) {
  const auto term =
      masking.starts_with("masking.") ? find_term(masking) : find_term(masking, Role::masking);
  if (catalogue()[term].anisotropic)
    throw wrong_usage(fmt::format("{} is anisotropic: the split sum's table has one roughness",
                                  catalogue()[term].about->id));
  return bind_model(model_of_lobe("ggx", short_id(catalogue()[term].about->id), "schlick"),
                    {{"roughness", {roughness}}, {"f0", {f0[0], f0[1]}}});
}

std::vector<SplitSum> split_sum(std::string_view masking,
                                double roughness,
                                std::span<const double> nov,
                                const Goal& goal) {
  const Goal half{goal.error / 2, goal.evaluations};
  std::vector<SplitSum> rows;
  for (const auto& e : directional_albedo(two_interfaces(masking, roughness), nov, 0, half))
    rows.push_back({e.value[1] - e.value[0], e.value[0], 2 * e.error});
  return rows;
}

std::vector<SplitSum> sampled_split_sum(std::string_view masking,
                                        double roughness,
                                        std::span<const double> nov,
                                        std::size_t samples) {
  check_cosines(nov);
  check(samples);
  const auto model = two_interfaces(masking, roughness);
  std::vector<SplitSum> rows(nov.size());
  tbb::parallel_for(std::size_t{0}, nov.size(), [&](std::size_t i) {
    rows[i] = sampled(model, square(roughness), nov[i], samples);
  });
  return rows;
}

std::vector<Albedo> split_sum_diffuse(std::span<const double> nov, const Goal& goal) {
  return diffuse_albedo(
      bind_model("lambert.coupled+ggx/smith_ggx.correlated/schlick", {{"kd", {1}}, {"f0", {0}}}, 1),
      nov, 0, goal);
}

std::vector<double> sampled_split_sum_diffuse(std::span<const double> nov, std::size_t samples) {
  check_cosines(nov);
  check(samples);
  std::vector<double> diffuse;
  for (const double mu : nov) {
    double sum = 0;
    for (std::size_t i = 0; i < samples; ++i) {
      const Direction l =
          cosine_direction(hammersley(static_cast<std::uint32_t>(i), static_cast<double>(samples)));
      const double voh = std::sqrt((1 + l.z * mu + l.x * sine_of(mu)) / 2);
      sum += 1 - schlick_weight(voh);
    }
    diffuse.push_back(sum / static_cast<double>(samples));
  }
  return diffuse;
}

}  // namespace gonio
