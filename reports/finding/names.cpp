#include "reports/finding/names.h"

#include <algorithm>
#include <array>
#include <utility>

#include "brdf/catalogue/registry.h"

namespace gonio {
namespace {

/// Shorter than the catalogue's titles, as people say them.
constexpr std::array<std::pair<std::string_view, std::string_view>, 69> names{
    {{"masking.smith_ggx.correlated", "Height-correlated Smith"},
     {"masking.smith_ggx.separable", "Separable Smith"},
     {"masking.schlick_ggx.direct", "Schlick's k = (r+1)²/8"},
     {"masking.schlick_ggx.half_alpha", "Schlick's k = α/2"},
     {"masking.ue_joint", "Unreal's joint form"},
     {"masking.hammon", "Unreal's joint form (Hammon)"},
     {"fresnel.schlick", "Schlick"},
     {"fresnel.schlick.f90", "Schlick, F90 fitted"},
     {"fresnel.f82", "F82"},
     {"fresnel.lazanyi, corrected", "Lazányi's corrected form"},
     {"fresnel.dielectric", "Exact dielectric"},
     {"fresnel.conductor", "Exact conductor"},
     {"fresnel.conductor, three wavelengths", "Exact conductor at three wavelengths"},
     {"gtr/schlick_ggx.direct/schlick", "GTR with Schlick's k = (r+1)²/8 and Fresnel"},
     {"model.gltf", "glTF's model"},
     {"model.filament", "Filament's model"},
     {"model.disney", "Disney's model"},
     {"model.disney2017", "Disney's model of 2017"},
     {"turquin", "Turquin"},
     {"kulla_conty", "Kulla and Conty"},
     {"fdez_aguera", "Fdez-Agüera"},
     {"single", "One bounce"},
     {"masking.none", "No masking"},
     {"masking.schlick_ggx.half_roughness", "Schlick's k = r/2"},
     {"masking.schlick_beckmann", "Schlick's k for Beckmann"},
     {"masking.smith_beckmann.correlated", "Smith for Beckmann, correlated"},
     {"masking.ue_joint.clamped", "Unreal's joint form, clamped"},
     {"masking.unity_mobile", "Unity's mobile form"},
     {"masking.unity_mobile.urp", "Unity's mobile form as shipped"},
     {"masking.ue_mobile_simple", "Unreal's simple mobile form"},
     {"fresnel.schlick.ue", "Unreal's Schlick"},
     {"fresnel.schlick.spherical_gaussian", "Schlick by a spherical Gaussian"},
     {"fresnel.linear.as_written", "Schlick, its power missing"},
     {"fresnel.lazanyi", "Lazányi's form"},
     {"fresnel.gulbrandsen", "Gulbrandsen's form"},
     {"fresnel.disney2015", "Disney's form of 2015"},
     {"fresnel.schlick.weighted", "Schlick of a partial layer"},
     {"fresnel.schlick.f90.weighted", "Schlick with F90, partial layer"},
     {"fresnel.schlick.metallic", "Schlick, metallic workflow"},
     {"fresnel.schlick.reflectance", "Schlick, Filament's parameters"},
     {"masking.smith_ggx_aniso.correlated", "Anisotropic Smith, correlated"},
     {"masking.smith_ggx_aniso.separable", "Anisotropic Smith, separable"},
     {"masking.smith_beckmann_aniso.correlated", "Anisotropic Beckmann, correlated"},
     {"masking.smith_beckmann.rational", "Walter's rational form"},
     {"masking.smith_gtr.correlated", "Smith for GTR, correlated"},
     {"masking.smith_gtr.separable", "Smith for GTR, separable"},
     {"masking.smith_charlie.correlated", "Smith for Charlie"},
     {"masking.smith_student_t.correlated", "Smith for Student's t"},
     {"masking.disney_coat", "Disney's coat"},
     {"masking.disney_remap", "Disney's remapped Smith"},
     {"masking.cook_torrance", "Cook–Torrance"},
     {"ndf.ggx", "GGX"},
     {"ndf.ggx.mobile", "GGX_Mobile"},
     {"ndf.ggx.mobile.cross", "GGX_Mobile, its cross product"},
     {"ndf.ggx.ue_mobile", "D_GGX_R2"},
     {"ndf.beckmann_aniso.as_written", "Anisotropic Beckmann as written"},
     {"ndf.shape_invariant", "Student's t for its shape"},
     {"ndf.gtr", "GTR"},
     {"ndf.gtr1", "GTR of γ = 1"},
     {"ndf.gtr.as_written", "GTR as if γ were 2"},
     {"diffuse.lambert", "Lambert"},
     {"diffuse.oren_nayar.fujii", "Fujii's Oren–Nayar"},
     {"model.ue_mobile", "Unreal's mobile model"},
     {"model.ue_mobile_simple", "Unreal's simple mobile model"},
     {"model.unity_mobile", "Unity's mobile model"},
     {"scattering.albedo_fit", "gonio's fit"},
     {"scattering.albedo_fit.materialx", "MaterialX's fit"},
     {"kulla_conty.linear", "Kulla and Conty, one bounce short"},
     {"scattering.kulla_conty.linear", "Kulla and Conty, one bounce short"}}};

const std::string_view* name_in_list(std::string_view form) {
  const auto at = std::ranges::find(names, form, [](const auto& n) { return n.first; });
  return at == names.end() ? nullptr : &at->second;
}

}  // namespace

std::string name_of_form(std::string_view form) {
  if (const auto* name = name_in_list(form)) return std::string(*name);
  const auto id = form.substr(0, form.find(','));
  if (const auto* name = name_in_list(id)) return std::string(*name).append(form.substr(id.size()));
  const auto term = std::ranges::find(catalogue(), id, [](const auto& t) { return t.id(); });
  if (term == catalogue().end()) return std::string(form);
  return std::string(term->about->title).append(form.substr(id.size()));
}

std::string in_text(std::string_view form) {
  auto name = name_of_form(form);
  // Names of people keep their capitals.
  for (const std::string_view word : {"Height", "Separable", "Exact", "Implicit", "No masking"})
    if (name.starts_with(word)) name[0] = static_cast<char>(name[0] + 32);
  return name;
}

std::string brief_name(std::string_view form) {
  constexpr std::size_t brief = 34;
  if (form.find('/') != form.npos) return name_of_form(form);
  auto name = name_of_form(form);
  return name.size() <= brief ? name : std::string(short_id(form));
}

std::string capital(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 32);
  return text;
}

}  // namespace gonio
