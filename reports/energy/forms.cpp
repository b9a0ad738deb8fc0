// Loss of every masking form at F = 1, by roughness and angle.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "brdf/catalogue/masking_shape.h"
#include "brdf/catalogue/registry.h"
#include "brdf/model/presets.h"
#include "integrate/albedo/directional_albedo.h"
#include "reports/energy/crossings.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace gonio {
namespace {

constexpr double pi = std::numbers::pi;
constexpr Goal goal{1e-5, 400'000};

/// The models in white, and by what an engine divides that keeps its lights without 1/π.
struct WhiteModel {
  std::string_view id;
  double divisor;
};
/// Disney's coat is GTR of gamma 1 with alpha up to 0.1.
const double most_coat_roughness = std::sqrt(0.1);
constexpr WhiteModel white_models[] = {
    {"model.ue_mobile", pi}, {"model.ue_mobile_simple", pi}, {"model.unity_mobile", 1}};

std::vector<EnergyForm> all_forms() {
  std::vector<EnergyForm> out;
  const auto gtr = [&](const std::string& masking, double gamma, double most) {
    out.push_back(
        {fmt::format("{}, gamma {}", masking, gamma), "ndf.gtr", masking, "", gamma, most});
  };
  for (const auto& t : catalogue()) {
    const std::string masking(t.about->id);
    if (role_of(masking) != Role::masking || t.anisotropic) continue;
    const bool coat = masking == "masking.disney_coat";
    const std::string ndf = "ndf." + std::string(shape_of_term(masking));
    if (ndf == "ndf.charlie") continue;  // sheen: what it does not reflect is for what lies below
    if (coat)
      gtr(masking, 1, most_coat_roughness);
    else if (ndf == "ndf.gtr")
      for (const double gamma : {1.0, 1.5, 3.0}) gtr(masking, gamma, 1);
    else if (ndf == "ndf.student_t")
      continue;  // at its tail's ends that of the other two
    else
      out.push_back({masking, ndf, masking});
  }
  for (const auto& m : white_models) {
    const std::string spec(find_preset(m.id)->spec);
    const auto first = spec.find('/');
    out.push_back({std::string(m.id), "ndf." + spec.substr(0, first),
                   "masking." + spec.substr(first + 1, spec.rfind('/') - first - 1),
                   std::string(m.id), 0, 1, m.divisor});
  }
  return out;
}

BoundModel bound(const EnergyForm& f, double roughness) {
  if (!f.model.empty())
    return bind_model(f.model, {{"roughness", {roughness}}, {"specular_color", {1}}}, 1);
  std::vector<Setting> s{{"alpha", {roughness * roughness}}, {"f0", {1}}};
  if (f.gamma > 0) s.push_back({"gamma", {f.gamma}});
  return bind_model(fmt::format("{}/{}/constant", short_id(f.ndf), short_id(f.masking)), s, 1);
}

std::vector<Crossing> crossings(const EnergyForm& f) {
  return gather_crossings([&](double mu, const auto& add) {
    if (mu == 0)
      for (const auto& a : f.averages) add(a.roughness, 1 - a.albedo);
    for (const auto& row : f.rows)
      if (row.mu == mu) add(row.roughness, 1 - row.albedo);
  });
}

}  // namespace

std::vector<EnergyForm> energy_forms(const EnergyOptions& o,
                                     const std::function<void(double)>& done) {
  const auto& mu = o.mu;
  auto forms = all_forms();
  if (!o.forms.empty())
    std::erase_if(forms, [&](const EnergyForm& f) {
      return std::ranges::find(o.forms, f.name) == o.forms.end();
    });
  std::size_t finished = 0;
  for (auto& f : forms) {
    auto roughness = o.roughness;
    std::erase_if(roughness, [&](double r) { return r > f.most_roughness; });
    f.rows.resize(roughness.size() * mu.size());
    f.averages.resize(roughness.size());
    tbb::parallel_for(std::size_t{0}, roughness.size(), [&](std::size_t r) {
      const auto b = bound(f, roughness[r]);
      const auto at = directional_albedo(b, mu, 0, goal);
      for (std::size_t m = 0; m < mu.size(); ++m)
        f.rows[r * mu.size() + m] = {roughness[r], mu[m], at[m].value[0] / f.divisor,
                                     at[m].error / f.divisor};
      const auto average = hemispherical_albedo(b, goal);
      f.averages[r] = {roughness[r], average.value[0] / f.divisor, average.error / f.divisor};
    });
    f.crossings = crossings(f);
    done(static_cast<double>(++finished) / static_cast<double>(forms.size()));
  }
  return forms;
}

}  // namespace gonio
