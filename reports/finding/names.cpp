#include "reports/finding/names.h"

#include <algorithm>
#include <array>
#include <utility>

#include "brdf/catalogue/registry.h"

namespace gonio {

std::string name_of_form(std::string_view form) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 18> names{
      {{"masking.smith_ggx.correlated", "Height-correlated Smith"},
       {"masking.smith_ggx.separable", "Separable Smith"},
       {"masking.schlick_ggx.direct", "Schlick's k = (r+1)²/8"},
       {"masking.schlick_ggx.half_alpha", "Schlick's k = α/2"},
       {"masking.ue_joint", "Unreal's joint form"},
       {"masking.hammon", "Hammon's linear form"},
       {"fresnel.schlick", "Schlick"},
       {"fresnel.schlick.f90", "Schlick, F90 fitted"},
       {"fresnel.f82", "F82"},
       {"fresnel.lazanyi, corrected", "Lazányi's corrected form"},
       {"fresnel.dielectric", "Exact dielectric"},
       {"fresnel.conductor", "Exact conductor"},
       {"fresnel.conductor, three wavelengths", "Exact conductor at three wavelengths"},
       {"gtr/schlick_ggx.direct/schlick", "GTR with Schlick's k = (r+1)²/8 and Fresnel"},
       {"model.gltf", "glTF's model"},
       {"turquin", "Turquin"},
       {"kulla_conty", "Kulla and Conty"},
       {"fdez_aguera", "Fdez-Agüera"}}};
  const auto at = std::ranges::find(names, form, [](const auto& n) { return n.first; });
  if (at != names.end()) return std::string(at->second);
  const auto id = form.substr(0, form.find(','));
  const auto term = std::ranges::find(catalogue(), id, [](const auto& t) { return t.id(); });
  return term == catalogue().end() ? std::string(id) : std::string(term->about->title);
}

std::string in_text(std::string_view form) {
  auto name = name_of_form(form);
  // Names of people keep their capitals.
  for (const std::string_view word : {"Height", "Separable", "Exact", "Implicit", "No masking"})
    if (name.starts_with(word)) name[0] = static_cast<char>(name[0] + 32);
  return name;
}

}  // namespace gonio
