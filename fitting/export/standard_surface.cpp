// Standard Surface as MaterialX 1.39.5 has it: a diffuse colour under a dielectric, or a metal, and
// a coat.
#include <algorithm>
#include <cmath>

#include "brdf/term/map.h"
#include "fitting/export/materialx_parts.h"
#include "optics/f0.h"

namespace gonio {
namespace {

/// aspect = √(1 − A),  α_x = min(r²/aspect, 1),  α_y = r² aspect          (mx_roughness_anisotropy)
///
/// The rotation turns the tangent clockwise, seen from above (mx_rotate_vector3).
std::vector<std::vector<double>> standard_values(const TargetParameters& p,
                                                 std::span<const FrameAngles<double>> angles) {
  const std::size_t n = p.front().values.size();  // base_color
  MaterialxSurface s;
  if (const double w = parameter_in(p, "coat"); w > 0) {
    const double r = parameter_in(p, "coat_roughness");
    s.layers.push_back(dielectric(layer_of(r * r, r * r, 0, w), parameter_in(p, "coat_IOR"),
                                  std::vector<double>(n, 1.0)));
  }
  const double r = parameter_in(p, "specular_roughness"), alpha = r * r;
  const double aspect = std::sqrt(1 - parameter_in(p, "specular_anisotropy"));
  auto base =
      layer_of(alpha / aspect, alpha * aspect, -360 * parameter_in(p, "specular_rotation"), 1);
  const auto color = per_channel(p, "base_color", n), edge = per_channel(p, "specular_color", n);
  s.kd.assign(n, 0.0);
  if (parameter_in(p, "metalness") > 0) {
    for (std::size_t c = 0; c < n; ++c)
      base.channels.push_back({artistic_layer(color[c], edge[c]), 0, 1, 1});
  } else {
    s.kd = color;
    s.diffuse_roughness = parameter_in(p, "diffuse_roughness");
    base.weight = parameter_in(p, "specular");
    if (base.weight > 0) base = dielectric(std::move(base), parameter_in(p, "specular_IOR"), edge);
  }
  s.layers.push_back(std::move(base));
  return evaluate(s, angles);
}

std::vector<TargetForm> standard_forms(const Surface& s) {
  std::vector<TargetForm> all;
  for (const auto& [base, coat, metal] : placements(s)) {
    TargetParameters p;
    const auto fixed = [&](const char* name, double value) {
      p.push_back({name, {value}, {0, 1}, false});
    };
    const auto diffuse = [&] {
      p.push_back({"base_color", s.kd});
      if (s.diffuse_roughness > 0) p.push_back({"diffuse_roughness", {s.diffuse_roughness}});
    };
    if (!base) {
      diffuse();
      fixed("metalness", 0), fixed("specular", 0);
    } else if (metal) {
      auto f0 = base->f0;
      for (double& r : f0) r *= base->weight;
      std::vector<double> edge;
      for (std::size_t c = 0; c < s.channels; ++c)
        edge.push_back(mapped<EdgeTintFromIndex, double>(base->eta[c], base->k[c])[1]);
      p.push_back({"base_color", f0, {0, 0.99}});
      fixed("metalness", 1), fixed("specular", 1);
      p.push_back({"specular_color", edge});
    } else {
      const auto like = grey_dielectric(*base);
      diffuse();
      fixed("metalness", 0);
      p.push_back({"specular", {base->weight}});
      p.push_back({"specular_color", like.tint, {0, 1}, !like.is_grey()});
      p.push_back({"specular_IOR", {like.eta}, index_range});
    }
    if (base) {
      const auto [wide, narrow, tangent] = stretch_of(*base, s.tangent_deg);
      p.push_back({"specular_roughness", {one_roughness(*base)}, roughness_range});
      if (wide != narrow) {
        p.push_back({"specular_anisotropy", {1 - narrow / wide}, {0, 0.98}});
        p.push_back({"specular_rotation", {turns_of(-tangent)}});
      }
    }
    if (coat) {
      p.push_back({"coat", {coat->weight}});
      p.push_back({"coat_roughness", {one_roughness(*coat)}, roughness_range});
      p.push_back({"coat_IOR", {grey_dielectric(*coat).eta}, index_range});
    }
    all.push_back({std::move(p), standard_values});
  }
  return all;
}

std::vector<std::string> standard_lost(const BoundModel& fit,
                                       const Surface& s,
                                       const TargetParameters&) {
  auto all =
      lost_in_layers(fit, s, "Standard Surface's", "oren_nayar", "Lambert's or Oren and Nayar's");
  if (!fresnel_is(fit, {"conductor", "dielectric", "gulbrandsen"}))
    all.emplace_back("The Fresnel curve: Standard Surface's is exact, of an index.");
  return all;
}

std::string standard_file(const Export& e, const std::string& fit) {
  std::string inputs = input("base", "float", {1});
  for (const auto& [name, v] : e.parameters)
    inputs += input(name, name.ends_with("_color") ? "color3" : "float", v);
  return material_file("standard_surface", inputs, fit);
}

}  // namespace

const Target standard_surface_target{"Standard Surface", standard_forms, standard_lost,
                                     standard_file};

}  // namespace gonio
