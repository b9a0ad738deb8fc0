#include "fitting/judge/physics.h"

#include <algorithm>
#include <cmath>

#include "brdf/model/derivatives.h"
#include "integrate/albedo/directional_albedo.h"

namespace gonio {
namespace {

/// Samples of a list whose albedo is looked for: it takes a thousand steps for each.
constexpr std::size_t most_of_a_list = 50'000;

/// Albedos of the table, as far as they take less than a fit.
std::vector<AlbedoSample> albedo_of(TableFacts& facts) {
  const Table& t = facts.table();
  if (t.list() && t.patches.empty() && (t.between || t.size() > most_of_a_list)) return {};
  return facts.albedo().known;
}

/// Greatest values of the model over those of the data, by channel, of the values that are compared.
std::vector<double> peak_ratio(const BoundModel& b, const FitData<double>& thin) {
  const std::vector<bool> none_free(b.model.value_count, false);
  ModelDerivatives<double> model(b.model, none_free, kernels<double>(), nullptr,
                                 thin.aperture != nullptr);
  model.set(b.values);
  std::vector<double> of_model(b.model.channels), of_data(b.model.channels);
  for (const auto& task : thin.tasks)
    for (const auto& block : task)
      model.run(block.angles(), [&](std::size_t c) {
        const double* const f = model.channel(c).value;
        for (std::size_t i = 0; i < block.n; ++i) {
          if (!(block.weight(c)[i] > 0)) continue;
          const double t = block.target(c)[i];
          of_model[c] = std::max(of_model[c], f[i]);
          of_data[c] = std::max(of_data[c], thin.link == Link::log ? std::exp(t) - thin.offset : t);
        }
      });
  for (std::size_t c = 0; c < of_model.size(); ++c) of_model[c] /= of_data[c];
  return of_model;
}

}  // namespace

Physics check_physics(const BoundModel& b, TableFacts& facts, const FitData<double>& thin) {
  Physics p;
  for (const auto& a : albedo_of(facts)) {
    p.theta_i_deg.push_back(a.theta_i_deg);
    p.data_albedo.push_back(a.albedo);
  }
  if (p.theta_i_deg.empty())
    for (int theta = 0; theta < 90; theta += 15) {
      p.theta_i_deg.push_back(theta);
      p.data_albedo.emplace_back(facts.table().values.size(), std::nan(""));
    }
  std::vector<double> mu;
  for (const double theta : p.theta_i_deg) mu.push_back(std::cos(theta * degree));
  constexpr Goal enough{1e-4, 20'000};
  for (auto& a : directional_albedo(b, mu, 0, enough)) p.model_albedo.push_back(std::move(a.value));

  p.peak_ratio = peak_ratio(b, thin);
  return p;
}

}  // namespace gonio
