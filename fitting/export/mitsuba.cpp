// Mitsuba 3: rough conductors, which reflect as dielectrics where nothing is absorbed, and a
// diffuse one, blended.
//
//   f = s_0 (r/π) + Σ_l s_l w_l D V F(eta, k),   shares s of a blend add up to 1, V is Smith's,
//   separable
//
// A blend weighs its parts: r = kd/s_0, and w_l = weight/s_l, which may be above 1 and Mitsuba
// takes as it is.
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "brdf/catalogue/registry.h"
#include "brdf/model/evaluate.h"
#include "fitting/export/target.h"
#include "fitting/export/xml.h"

#include <fmt/format.h>

namespace gonio {
namespace {

std::string ending_of(std::size_t lobe) {
  return lobe == 0 ? "" : fmt::format("_{}", lobe + 1);
}

/// Names of the catalogue for Mitsuba's.
std::string catalogue_name(const std::string& name) {
  const auto i = name.rfind('_');
  const bool later =
      i != std::string::npos && i + 1 < name.size() && '2' <= name[i + 1] && name[i + 1] <= '9';
  const std::string stem = later ? name.substr(0, i) : name, ending = later ? name.substr(i) : "";
  if (stem == "reflectance") return "kd";
  if (stem == "alpha_u") return "alpha_x" + ending;
  if (stem == "alpha_v") return "alpha_y" + ending;
  if (stem == "specular_reflectance") return "weight" + ending;
  return stem + ending;
}

std::vector<TargetForm> mitsuba_forms(const Surface& s) {
  std::string spec;
  TargetForm form;
  auto& p = form.parameters;
  const bool diffuse = s.largest_kd() > 0 || s.lobes.empty();
  if (diffuse) {
    spec = "lambert";
    p.push_back({"reflectance", s.kd});
  }
  for (std::size_t l = 0; l < s.lobes.size(); ++l) {
    const auto& lobe = s.lobes[l];
    const auto end = ending_of(l);
    const bool anisotropic = lobe.alpha_x != lobe.alpha_y;
    spec += spec.empty() ? "" : "+";
    spec += anisotropic ? "ggx_aniso/smith_ggx_aniso.separable/conductor.weighted"
                        : "ggx/smith_ggx.separable/conductor.weighted";
    const Range width{1e-4, 1};
    if (anisotropic) {
      p.push_back({"alpha_u" + end, {lobe.alpha_x}, width});
      p.push_back({"alpha_v" + end, {lobe.alpha_y}, width});
    } else {
      p.push_back({"alpha" + end, {lobe.alpha_x}, width});
    }
    p.push_back({"eta" + end, lobe.eta, {0.001, 20}});
    p.push_back({"k" + end, lobe.k, {0, 100}, lobe.is_metal()});
    // Of a metal the index says how much it reflects; of a dielectric it says the angles, too.
    p.push_back({"specular_reflectance" + end, {lobe.weight}, {0, 1}, !lobe.is_metal()});
  }
  form.values = [spec, tangent = s.tangent_deg, channels = s.channels](
                    const TargetParameters& now, std::span<const FrameAngles<double>> angles) {
    std::vector<Setting> settings;
    for (const auto& x : now) settings.push_back({catalogue_name(x.name), x.values});
    if (spec.find("aniso") != spec.npos) settings.push_back({"tangent", {tangent}});
    return evaluate(bind_model(spec, std::move(settings), channels), angles);
  };
  return {std::move(form)};
}

std::vector<std::string> mitsuba_lost(const BoundModel& fit,
                                      const Surface& s,
                                      const TargetParameters&) {
  auto all = lost_by_all(fit, "Mitsuba's", "separable");
  for (const auto& d : fit.model.diffuse)
    if (catalogue()[d.term].coupled)
      all.emplace_back(
          "What the highlight takes from the diffuse light: Mitsuba's blend adds both.");
  if (!fresnel_is(fit, {"conductor", "dielectric"}))
    all.emplace_back("The Fresnel curve: Mitsuba's is exact, of an index.");
  if (s.tangent_deg != 0)
    all.push_back(
        fmt::format("The tangent at {:.4g}°: Mitsuba takes it from texture coordinates, which are "
                    "to be turned.",
                    s.tangent_deg));
  return all;
}

std::string mitsuba_file(const Export& e, const std::string& fit) {
  const auto find = [&](const std::string& name) -> const std::vector<double>* {
    const auto it = std::ranges::find(
        e.parameters, name, [](const auto& p) -> auto& { return p.first; });
    return it == e.parameters.end() ? nullptr : &it->second;
  };
  const auto rgb = [](const std::string& name, std::vector<double> v, double scale) {
    for (double& x : v) x *= scale;
    v.resize(3, v[0]);
    return fmt::format("<rgb name=\"{}\" value=\"{}\"/>\n", name, xml_numbers(v));
  };
  const auto* reflectance = find("reflectance");
  std::size_t lobes = 0;
  while (find("eta" + ending_of(lobes))) ++lobes;
  double diffuse_share = reflectance ? 1 : 0;
  if (reflectance && lobes > 0)  // as small as leaves kd/share within 1
    diffuse_share = std::clamp(*std::ranges::max_element(*reflectance), 0.5, 0.99);
  std::vector<std::pair<double, std::string>> parts;
  if (reflectance)
    parts.emplace_back(diffuse_share, "<bsdf type=\"diffuse\">\n" +
                                          rgb("reflectance", *reflectance, 1 / diffuse_share) +
                                          "</bsdf>\n");
  for (std::size_t l = 0; l < lobes; ++l) {
    const auto end = ending_of(l);
    const double share = (1 - diffuse_share) / static_cast<double>(lobes);
    std::string one =
        "<bsdf type=\"roughconductor\">\n<string name=\"distribution\" value=\"ggx\"/>\n";
    for (const char* name : {"alpha", "alpha_u", "alpha_v"})
      if (const auto* v = find(name + end))
        one += fmt::format("<float name=\"{}\" value=\"{}\"/>\n", name, xml_numbers(*v));
    for (const char* name : {"eta", "k"}) one += rgb(name, *find(name + end), 1);
    one += fmt::format("<spectrum name=\"specular_reflectance\" value=\"{}\"/>\n</bsdf>\n",
                       xml_numbers({(*find("specular_reflectance" + end))[0] / share}));
    parts.emplace_back(share, std::move(one));
  }
  auto [left, all] = parts.back();
  for (std::size_t i = parts.size() - 1; i-- > 0;) {
    const auto& [share, one] = parts[i];
    all = fmt::format(
        "<bsdf type=\"blendbsdf\">\n<float name=\"weight\" value=\"{}\"/>\n{}{}</bsdf>\n",
        xml_numbers({left / (left + share)}), one, all);
    left += share;
  }
  all.insert(5, " version=\"3.0.0\" id=\"fit\"");  // of the outermost
  return xml_file(all, exported_fit, fit);
}

}  // namespace

const Target mitsuba_target{"Mitsuba", mitsuba_forms, mitsuba_lost, mitsuba_file};

}  // namespace gonio
