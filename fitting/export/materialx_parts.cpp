#include "fitting/export/materialx_parts.h"

#include <algorithm>
#include <cmath>

#include "brdf/term/map.h"
#include "fitting/export/xml.h"
#include "optics/f0.h"

#include <fmt/format.h>

namespace gonio {

MaterialxLayer layer_of(double alpha_x, double alpha_y, double tangent_deg, double weight) {
  const auto within = [](double x) { return std::clamp(x, 1e-4, 1.0); };
  return {within(alpha_x), within(alpha_y), tangent_deg, weight, {}};
}
MaterialxLayer dielectric(MaterialxLayer l, double eta, const std::vector<double>& tint) {
  const double f0 = mapped<F0FromIor, double>(eta, 1.0)[0];
  for (const double t : tint) l.channels.push_back({dielectric_layer(eta), f0, 1, t});
  return l;
}

std::vector<std::string> lost_in_layers(const BoundModel& fit,
                                        const Surface& s,
                                        const std::string& whose,
                                        std::string_view diffuse,
                                        std::string_view diffuse_name) {
  auto all = lost_by_all(fit, whose, "correlated", {"lambert", diffuse}, diffuse_name);
  if (s.lobes.size() > 2)
    all.emplace_back("A third lobe: " + whose + " are a highlight and a coat.");
  if (s.lobes.size() == 2)
    all.emplace_back("The sum of two lobes: " + whose + " coat takes light from what is below it.");
  if (fit.model.anisotropic)
    all.emplace_back("The masking's direction: " + whose + " is that of one mean width.");
  if (s.largest_kd() > 0 && !s.lobes.empty())
    all.emplace_back("The plain sum of diffuse light and highlight: " + whose +
                     " diffuse is what the highlight's albedo leaves.");
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
      exported_fit, fit);
}

}  // namespace gonio
