// What leaves after all bounces, material by material, and how far from it each compensation ends.
#include <algorithm>
#include <iterator>

#include "brdf/catalogue/registry.h"
#include "integrate/scattering/compensation.h"
#include "integrate/scattering/half_space.h"
#include "reports/energy/crossings.h"

#include <fmt/format.h>

namespace gonio {
namespace {

/// Materials that share a model: one for each channel.
struct Family {
  std::string_view fresnel;
  std::vector<Setting> settings;
  std::vector<std::string> names;
};

constexpr std::string_view schlick = "schlick";

std::vector<Family> families() {
  const std::vector<std::string> gold{"metal=Au"};
  return {{schlick, {{"f0", {1, 0.9, 0.5, 0.04}}}, {"F = 1", "F0 = 0.9", "F0 = 0.5", "F0 = 0.04"}},
          {"conductor", parse_settings(gold), {"gold, red", "gold, green", "gold, blue"}}};
}

/// Crossings of the loss as a share of what should leave.
std::vector<Crossing> crossings(const EnergyMaterial& m) {
  return gather_crossings([&](double mu, const auto& add) {
    for (const auto& at : m.rows)
      if (at.mu == mu) add(at.roughness, 1 - at.orders[0] / at.truth);
  });
}

/// One roughness: a row for each channel's material at each mu and on average (mu 0).
std::vector<std::vector<EnergyMaterial::At>> solve(const Family& family,
                                                   double roughness,
                                                   const std::vector<double>& mu) {
  constexpr Goal goal{1e-6, 400'000};
  auto settings = family.settings;
  settings.push_back({"alpha", {roughness * roughness}});
  const auto model = bind_model(fmt::format("ggx/smith_ggx.correlated/{}", family.fresnel),
                                settings, family.names.size());
  const auto all = half_space(model, mu, 1e-5);
  std::vector<std::vector<EnergyMaterial::At>> rows(family.names.size());
  for (std::size_t c = 0; c < rows.size(); ++c) {
    const auto put = [&](double at, const Scattered& s) {
      rows[c].push_back(
          {roughness, at, s.albedo[c], s.error[c], s.order[c], {{"single", s.order[c][0]}}});
    };
    for (std::size_t i = 0; i < mu.size(); ++i) put(mu[i], all.at[i]);
    put(0, all.average);
  }
  for (std::size_t m = 0; m < names_of<Compensation>.size(); ++m) {
    const auto how = static_cast<Compensation>(m);
    // A and B, by which it works, are of Schlick's Fresnel.
    if (how == Compensation::fdez_aguera && family.fresnel != schlick) continue;
    const auto at = compensated_albedo(model, how, mu, 0, goal);
    const auto average = compensated_average(model, how, goal);
    for (std::size_t c = 0; c < rows.size(); ++c) {
      for (std::size_t i = 0; i < mu.size(); ++i)
        rows[c][i].scattering.push_back({names_of<Compensation>[m], at[i].value[c]});
      rows[c].back().scattering.push_back({names_of<Compensation>[m], average.value[c]});
    }
  }
  return rows;
}

}  // namespace

std::vector<EnergyMaterial> energy_materials(const EnergyOptions& o,
                                             const std::function<void(double)>& done) {
  std::vector<EnergyMaterial> out;
  const auto all = families();
  const double steps = static_cast<double>(all.size() * o.roughness.size());
  std::size_t finished = 0;
  for (const auto& family : all) {
    const std::size_t first = out.size();
    for (std::size_t c = 0; c < family.names.size(); ++c) {
      out.push_back({family.names[c], fmt::format("fresnel.{}", family.fresnel), {}, {}});
      if (family.fresnel == schlick) out.back().f0 = family.settings[0].values[c];
    }
    for (const double r : o.roughness) {
      const auto rows = solve(family, r, o.mu);
      for (std::size_t c = 0; c < rows.size(); ++c)
        std::ranges::copy(rows[c], std::back_inserter(out[first + c].rows));
      done(static_cast<double>(++finished) / steps);
    }
  }
  for (auto& m : out) m.crossings = crossings(m);
  return out;
}

}  // namespace gonio
