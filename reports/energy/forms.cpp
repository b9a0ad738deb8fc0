// Loss of every masking form at F = 1, by roughness and angle.
#include <algorithm>
#include <cmath>

#include "base/whole_loop.h"
#include "brdf/catalogue/masking_shape.h"
#include "brdf/catalogue/registry.h"
#include "brdf/model/presets.h"
#include "integrate/albedo/directional_albedo.h"
#include "reports/energy/crossings.h"
#include "reports/measure/light_unit.h"

#include <fmt/format.h>

namespace gonio {
namespace {

constexpr Goal row_goal{1e-5, 400'000};

/// Disney's coat is GTR of gamma 1 with alpha up to 0.1.
const double most_coat_roughness = std::sqrt(0.1);
/// The models that are looked at in white.
constexpr std::string_view white_models[] = {"model.ue_mobile", "model.ue_mobile_simple",
                                             "model.unity_mobile"};

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
  for (const auto id : white_models) {
    const auto lobe = parse_model(find_preset(id)->spec).lobes[0];
    out.push_back({std::string(id), "ndf." + lobe.ndf, "masking." + lobe.masking, std::string(id),
                   0, 1, light_unit(id)});
  }
  return out;
}

BoundModel bound(const EnergyForm& f, double roughness) {
  if (!f.model.empty())
    return bind_model(f.model, {{"roughness", {roughness}}, {"specular_color", {1}}}, 1);
  std::vector<Setting> s{{"alpha", {roughness * roughness}}, {"f0", {1}}};
  if (f.gamma > 0) s.push_back({"gamma", {f.gamma}});
  return bind_model(model_of_lobe(short_id(f.ndf), short_id(f.masking), "constant"), s, 1);
}

std::vector<Crossing> crossings(const EnergyForm& f) {
  const auto known = [&](double mu) {
    KnownLosses k;
    const auto add = [&](double roughness, double albedo) {
      k.roughness.push_back(roughness);
      k.loss.push_back(1 - albedo);
    };
    if (mu == 0)
      for (const auto& a : f.averages) add(a.roughness, a.albedo);
    for (const auto& row : f.rows)
      if (row.mu == mu) add(row.roughness, row.albedo);
    return k;
  };
  return gather_crossings(known, [&](double mu, double roughness) {
    const auto b = bound(f, roughness);
    const auto albedo = mu == 0 ? hemispherical_albedo(b, row_goal)
                                : directional_albedo(b, {&mu, 1}, 0, fine_goal)[0];
    return Bounded{1 - albedo.value[0] / f.divisor, albedo.error / f.divisor};
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
    for_each_whole(roughness.size(), [&](std::size_t r) {
      const auto b = bound(f, roughness[r]);
      const auto at = directional_albedo(b, mu, 0, row_goal);
      for (std::size_t m = 0; m < mu.size(); ++m)
        f.rows[r * mu.size() + m] = {roughness[r], mu[m], at[m].value[0] / f.divisor,
                                     at[m].error / f.divisor};
      const auto average = hemispherical_albedo(b, row_goal);
      f.averages[r] = {roughness[r], average.value[0] / f.divisor, average.error / f.divisor};
    });
    f.crossings = crossings(f);
    done(static_cast<double>(++finished) / static_cast<double>(forms.size()));
  }
  return forms;
}

}  // namespace gonio
