#pragma once
/// \file
/// Effects that a material may show, and the forms in which each can be simulated.

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

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

/// Names of an effect's forms, from cheap to exact.
std::span<const std::string_view> forms_of(Effect);

/// A form of every effect.
struct Forms {
  std::array<std::size_t, effect_count> form{};  ///< [effect], of forms_of

  std::size_t& operator[](Effect e) { return form[static_cast<std::size_t>(e)]; }
  std::size_t operator[](Effect e) const { return form[static_cast<std::size_t>(e)]; }
  std::string_view name(Effect e) const { return forms_of(e)[(*this)[e]]; }
  /// True where the form is not the cheapest.
  bool keeps(Effect e) const { return (*this)[e] > 0; }
  bool operator==(const Forms&) const = default;
};

}  // namespace gonio::scene

template <>
inline constexpr std::array<std::string_view, gonio::scene::effect_count>
    gonio::names_of<gonio::scene::Effect>{"fresnel",  "compensation", "masking",  "anisotropy",
                                          "coat",     "tail",         "diffuse",  "coupling",
                                          "spectrum", "environment",  "precision"};
