#include "fitting/export/materialx_parts.h"

#include <algorithm>
#include <cmath>

#include "brdf/term/map.h"
#include "fitting/export/xml.h"
#include "optics/f0.h"

#include <fmt/format.h>

namespace gonio {

std::vector<Placed> placements(const Surface& s) {
  std::vector<Placed> all;
  const auto add = [&](const SurfaceLobe* base, const SurfaceLobe* coat) {
    const bool metal = base && base->is_metal() && s.largest_kd() < 0.05;
    all.push_back({base, coat, metal});
    if (base && base->is_metal()) all.push_back({base, coat, !metal});
  };
  if (s.lobes.size() < 2) {
    add(s.lobes.empty() ? nullptr : &s.lobes[0], nullptr);
    return all;
  }
  const auto strength = [](const SurfaceLobe& l) { return l.weight * l.largest_f0(); };
  const bool ordered = strength(s.lobes[0]) >= strength(s.lobes[1]);
  add(&s.lobes[ordered ? 0 : 1], &s.lobes[ordered ? 1 : 0]);
  add(&s.lobes[ordered ? 1 : 0], &s.lobes[ordered ? 0 : 1]);
  return all;
}

bool GreyDielectric::is_grey() const {
  return std::ranges::all_of(tint, [](double t) { return t == 1; });
}
GreyDielectric grey_dielectric(const SurfaceLobe& l) {
  const auto same = [](const std::vector<double>& v) {
    return std::ranges::count(v, v[0]) == std::ssize(v);
  };
  const bool grey = same(l.eta) && same(l.k) && l.k[0] == 0;
  const double most = l.largest_f0();
  GreyDielectric g{grey ? l.eta[0] : mapped<IorFromF0, double>(std::min(most, 0.66))[0], l.f0};
  for (double& t : g.tint) t = grey || most == 0 ? 1 : t / most;
  return g;
}

Stretch stretch_of(const SurfaceLobe& l, double tangent_deg) {
  return l.alpha_x < l.alpha_y ? Stretch{l.alpha_y, l.alpha_x, tangent_deg + 90}
                               : Stretch{l.alpha_x, l.alpha_y, tangent_deg};
}
double turns_of(double tangent_deg) {
  const double turns = tangent_deg / 360, half = turns - 0.5 * std::floor(turns / 0.5);
  return half < 0.25 ? half + 0.5 : half;
}

double fourth_root(double x) {
  return std::sqrt(std::sqrt(x));
}
double one_roughness(const SurfaceLobe& l) {
  return fourth_root(l.alpha_x * l.alpha_y);
}

MaterialxLayer layer_of(double alpha_x, double alpha_y, double tangent_deg, double weight) {
  const auto within = [](double x) { return std::clamp(x, 1e-4, 1.0); };
  return {within(alpha_x), within(alpha_y), tangent_deg, weight, {}};
}
MaterialxLayer dielectric(MaterialxLayer l, double eta, const std::vector<double>& tint) {
  const double f0 = mapped<F0FromIor, double>(eta, 1.0)[0];
  for (const double t : tint) l.channels.push_back({dielectric_layer(eta), f0, 1, t});
  return l;
}

std::vector<double> per_channel(const TargetParameters& p, std::string_view name, std::size_t n) {
  std::vector<double> v;
  for (std::size_t c = 0; c < n; ++c) v.push_back(value_in(p, name, c));
  return v;
}

std::vector<std::string> lost_in_layers(const BoundModel& fit,
                                        const Surface& s,
                                        const std::string& whose) {
  auto all = lost_by_all(fit, whose, "correlated");
  if (s.lobes.size() > 2)
    all.emplace_back("A third lobe: " + whose + " are a highlight and a coat.");
  if (s.lobes.size() == 2)
    all.emplace_back("The sum of two lobes: " + whose + " coat takes light from what is below it.");
  if (fit.model.anisotropic)
    all.emplace_back("The masking's direction: " + whose + " is that of one mean width.");
  if (!s.lobes.empty())
    all.emplace_back("Light lost between facets: " + whose + " highlight has it back.");
  return all;
}

std::string input(std::string_view name, std::string_view type, std::vector<double> v) {
  if (type == "color3") v.resize(3, v[0]);
  return fmt::format("<input name=\"{}\" type=\"{}\" value=\"{}\"/>\n", name, type, xml_numbers(v));
}

std::string material_file(const std::string& node,
                          const std::string& inputs,
                          const std::string& fit,
                          const std::string& before) {
  return xml_file(
      fmt::format("<materialx version=\"1.39\" colorspace=\"lin_rec709\">\n{0}<{1} "
                  "name=\"fit_shader\" type=\"surfaceshader\">\n{2}</{1}>\n<surfacematerial "
                  "name=\"fit\" type=\"material\">\n<input name=\"surfaceshader\" "
                  "type=\"surfaceshader\" nodename=\"fit_shader\"/>\n</surfacematerial>\n"
                  "</materialx>\n",
                  before, node, inputs),
      fit);
}

}  // namespace gonio
