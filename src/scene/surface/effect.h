#pragma once
/// \file
/// Effects that a material may show, and the forms in which each can be simulated.

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "base/names.h"

namespace gonio::scene {

enum class Effect {
  fresnel,       ///< reflectance by angle
  compensation,  ///< light that leaves after several bounces between facets
  masking,       ///< facets that hide one another
  anisotropy,    ///< widths that differ along the tangent and across it
  coat,          ///< a clear layer on all else
  tail,          ///< a distribution that falls off more slowly than GGX, or faster
  diffuse,       ///< light from below the surface
  coupling,      ///< what of it the interface lets through
  spectrum,      ///< of a metal's index, in place of three wavelengths
  environment,   ///< light of an environment: two lookups, or an integral over directions
  precision,     ///< number that all is computed in
};
inline constexpr std::size_t effect_count = 11;

/// Form in which an effect is simulated: effect by effect, each from cheap to exact.
// clang-format off
enum class Form {
  schlick, f82, exact_fresnel,
  uncompensated, turquin, fdez_aguera, kulla_conty, tabulated,
  schlick_k, separable, correlated,
  isotropic, anisotropic,
  uncoated, coated,
  ggx_tail, gtr_tail,
  no_diffuse, lambert, disney, given_diffuse,
  uncoupled, coupled,
  rgb, spectral,
  split_sum, quadrature,
  in_float, in_double
};
// clang-format on

}  // namespace gonio::scene

template <>
inline constexpr std::array<std::string_view, 29> gonio::names_of<gonio::scene::Form>{
    "schlick",     "f82",       "exact",      "none",      "turquin",    "fdez_aguera",
    "kulla_conty", "tabulated", "schlick_k",  "separable", "correlated", "off",
    "on",          "off",       "on",         "ggx",       "gtr",        "none",
    "lambert",     "disney",    "as_given",   "off",       "on",         "rgb",
    "spectral",    "split_sum", "quadrature", "float",     "double"};

namespace gonio::scene {

/// By effect.
inline constexpr std::array<Form, effect_count> cheapest_forms{
    Form::schlick,  Form::uncompensated, Form::schlick_k,  Form::isotropic,
    Form::uncoated, Form::ggx_tail,      Form::no_diffuse, Form::uncoupled,
    Form::rgb,      Form::split_sum,     Form::in_float};

/// Forms of an effect, from cheap to exact.
std::span<const Form> forms_of(Effect);
/// Whether a form leaves the effect out, where others do it in a simpler way.
constexpr bool is_absence(Form form) {
  return form == Form::uncompensated || form == Form::isotropic || form == Form::uncoated ||
         form == Form::no_diffuse || form == Form::uncoupled;
}
/// That of an effect's forms that is named so.
std::optional<Form> find_form(Effect, std::string_view name);

/// A form of every effect.
struct Forms {
  std::array<Form, effect_count> form = cheapest_forms;  ///< [effect]

  Form& operator[](Effect e) { return form[static_cast<std::size_t>(e)]; }
  Form operator[](Effect e) const { return form[static_cast<std::size_t>(e)]; }
  std::string_view name(Effect e) const { return name_of((*this)[e]); }
  /// True where the form is not the cheapest.
  bool keeps(Effect e) const { return (*this)[e] > cheapest_forms[static_cast<std::size_t>(e)]; }
  bool operator==(const Forms&) const = default;
};

}  // namespace gonio::scene

template <>
inline constexpr std::array<std::string_view, gonio::scene::effect_count>
    gonio::names_of<gonio::scene::Effect>{"fresnel",  "compensation", "masking",  "anisotropy",
                                          "coat",     "tail",         "diffuse",  "coupling",
                                          "spectrum", "environment",  "precision"};
