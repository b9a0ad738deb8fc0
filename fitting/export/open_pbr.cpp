// OpenPBR as MaterialX 1.39.5 has it: a diffuse colour under a dielectric, or a metal with an edge
// tint, and a coat.
#include <algorithm>
#include <cmath>

#include "brdf/term/map.h"
#include "fitting/export/materialx_parts.h"
#include "optics/f0.h"

namespace gonio {
namespace {

/// α_x = r² √(2/(1 + (1 − A)²)),  α_y = (1 − A) α_x                          (open_pbr_anisotropy)
///
/// The weight s of the highlight changes a dielectric's index, so that F0 is s times as large:
///
///   η ← (1 + √(s F0))/(1 − √(s F0))
///
/// of which what lies below loses light at grazing angles even where s is 0.  Under a coat of weight w, roughness c and index η_c:  r⁴ ← min(1, r⁴ + 2 c⁴),  η ← η/η_c or its inverse, whichever is
/// above 1, each mixed by w with what it was.
std::vector<std::vector<double>> open_pbr_values(const TargetParameters& p,
                                                 std::span<const FrameAngles<double>> angles) {
  const std::size_t n = p.front().values.size();  // base_color
  MaterialxSurface s;
  double r = parameter_in(p, "specular_roughness"), eta = parameter_in(p, "specular_ior");
  if (const double w = parameter_in(p, "coat_weight"); w > 0) {
    const double c = parameter_in(p, "coat_roughness"), index = parameter_in(p, "coat_ior");
    s.layers.push_back(
        dielectric(layer_of(c * c, c * c, 0, w), index, std::vector<double>(n, 1.0)));
    r += w * (fourth_root(std::min(1.0, std::pow(r, 4) + 2 * std::pow(c, 4))) - r);
    eta += w * (std::max(eta / index, index / std::max(eta, 1.0)) - eta);
  }
  const double across = 1 - parameter_in(p, "specular_roughness_anisotropy");
  const double wide = r * r * std::sqrt(2 / (1 + across * across));
  auto base = layer_of(wide, across * wide, parameter_in(p, "geometry_tangent"), 1);
  const double strength = parameter_in(p, "specular_weight");
  const auto color = per_channel(p, "base_color", n), tint = per_channel(p, "specular_color", n);
  s.kd.assign(n, 0.0);
  if (parameter_in(p, "base_metalness") > 0) {
    base.weight = strength;
    for (std::size_t c = 0; c < n; ++c)
      base.channels.push_back({f82_layer(color[c], tint[c]), 0, 1, 1});
  } else {
    s.kd = color;
    s.diffuse_roughness = parameter_in(p, "base_diffuse_roughness");
    s.compensated = true;
    const double f0 = mapped<F0FromIor, double>(eta, 1.0)[0];
    base = dielectric(std::move(base),
                      strength == 1 ? eta : mapped<IorFromF0, double>(strength * f0)[0], tint);
  }
  s.layers.push_back(std::move(base));
  return evaluate(s, angles);
}

std::vector<TargetForm> open_pbr_forms(const Surface& s) {
  std::vector<TargetForm> all;
  for (const auto& [base, coat, metal] : placements(s)) {
    TargetParameters p;
    const auto fixed = [&](const char* name, double value) {
      p.push_back({name, {value}, {0, 1}, false});
    };
    const auto diffuse = [&, &is_metal = metal] {
      p.push_back({"base_color", s.kd});
      if (s.diffuse_roughness > 0 && !is_metal)
        p.push_back({"base_diffuse_roughness", {s.diffuse_roughness}});
    };
    if (!base) {
      diffuse();
      fixed("base_metalness", 0), fixed("specular_weight", 0);
      p.push_back({"specular_color", std::vector<double>(s.channels, 0.0), {0, 1}, false});
      p.push_back({"specular_ior", {1.5}, index_range, false});
      p.push_back({"specular_roughness", {0.3}, roughness_range});
    } else if (metal) {
      p.push_back({"base_color", base->f0});
      fixed("base_metalness", 1);
      p.push_back({"specular_weight", {base->weight}, {0, 1}, base->weight < 1});
      p.push_back({"specular_color", base->f82_tint});
    } else {
      // The weight of a dielectric would change its index; a tint lowers the whole curve.
      auto like = grey_dielectric(*base);
      for (double& t : like.tint) t *= base->weight;
      diffuse();
      fixed("base_metalness", 0), fixed("specular_weight", 1);
      p.push_back({"specular_color", like.tint, {0, 1}, !like.is_grey()});
      p.push_back({"specular_ior", {like.eta}, index_range});
    }
    if (base) {
      const auto [wide, narrow, tangent] = stretch_of(*base, s.tangent_deg);
      // What a coat will roughen is written smoother.
      const double added = coat ? 2 * coat->alpha_x * coat->alpha_y : 0;
      const double r4 = (wide * wide + narrow * narrow) / 2 - added;
      p.push_back({"specular_roughness", {fourth_root(std::max(r4, 1e-8))}, roughness_range});
      if (wide != narrow) {
        p.push_back({"specular_roughness_anisotropy", {1 - narrow / wide}});
        p.push_back({"geometry_tangent", {half_turn_of(tangent)}, {-180, 180}});
      }
    }
    if (coat) {
      p.push_back({"coat_weight", {coat->weight}});
      p.push_back({"coat_roughness", {one_roughness(*coat)}, roughness_range});
      p.push_back({"coat_ior", {grey_dielectric(*coat).eta}, index_range});
    }
    all.push_back({std::move(p), open_pbr_values});
  }
  return all;
}

std::vector<std::string> open_pbr_lost(const BoundModel& fit,
                                       const Surface& s,
                                       const TargetParameters& p) {
  auto all = lost_in_layers(fit, s, "OpenPBR's", "eon", "Lambert's or EON");
  const bool metal = parameter_in(p, "base_metalness") > 0;
  if (metal && !fresnel_is(fit, {"schlick", "f82"}))
    all.emplace_back("The Fresnel curve: OpenPBR's metal has Schlick's with a tint at the edge.");
  if (!metal && !fresnel_is(fit, {"dielectric"}))
    all.emplace_back("The Fresnel curve: OpenPBR's is exact, of an index.");
  if (s.lobes.empty())
    all.emplace_back("A surface without a highlight: OpenPBR's is dark at grazing angles.");
  return all;
}

/// OpenPBR has a tangent and no angle: nodes that turn the geometry's.
std::string turned_tangent(double angle_deg) {
  std::string nodes;
  for (const char* name : {"normal", "tangent"})
    nodes += std::string("<") + name + " name=\"fit_" + name +
             "\" type=\"vector3\">\n<input name=\"space\" type=\"string\" value=\"world\"/>\n</" +
             name + ">\n";
  return nodes +
         "<rotate3d name=\"fit_turned\" type=\"vector3\">\n<input name=\"in\" type=\"vector3\" "
         "nodename=\"fit_tangent\"/>\n" +
         input("amount", "float", {-angle_deg}) +  // MaterialX turns clockwise
         "<input name=\"axis\" type=\"vector3\" nodename=\"fit_normal\"/>\n</rotate3d>\n";
}

std::string open_pbr_file(const Export& e, const std::string& fit) {
  std::string inputs = input("base_weight", "float", {1}), before;
  for (const auto& [name, v] : e.parameters)
    if (name == "geometry_tangent") {
      before = turned_tangent(v[0]);
      inputs += "<input name=\"geometry_tangent\" type=\"vector3\" nodename=\"fit_turned\"/>\n";
    } else {
      inputs += input(name, name.ends_with("_color") ? "color3" : "float", v);
    }
  inputs += input("coat_darkening", "float", {0});
  return material_file("open_pbr_surface", inputs, fit, before);
}

}  // namespace

const Target open_pbr_target{"OpenPBR", open_pbr_forms, open_pbr_lost, open_pbr_file};

}  // namespace gonio
