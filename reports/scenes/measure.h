#pragma once
/// \file
/// Measurements of scenes, and the names that the report gives to effects.

#include <span>
#include <string>
#include <string_view>

#include "reports/page/spheres.h"
#include "reports/scenes/scenes.h"
#include "scene/plan/samples.h"
#include "scene/surface/effect.h"

namespace gonio::scenes {

/// Name of an effect in a form: "exact Fresnel", "correlated masking".
std::string name_of_form(scene::Form);
/// Name of an effect as a whole: "Fresnel", "masking".
std::string_view name_of_effect(scene::Effect);

/// How a time changes: "6.3 × as fast", "18 × as slow"; "as fast" where a clock would not tell.
std::string speed(double ratio);

/// Steps that a byte of a picture's differences has to ΔE2000 1.
inline constexpr double steps_of_difference = 50;
/// Course of its colours: to what the tolerance allows at the quantile, and to the most.
page::DifferenceScale difference_scale(const scene::Tolerance&);
/// Picture of a lit scene, with all effects and as planned.  \param planned  by material  \param pixels  width and height
ScenePicture picture_of(const scene::Lit&,
                        std::span<const scene::Forms> planned,
                        std::size_t pixels,
                        std::size_t samples);

/// Maps of where effects switch on: of some that people ask for, at most six.
std::vector<SceneMap> switch_maps(const ScenesOptions&, const std::function<void(double)>& done);

}  // namespace gonio::scenes
