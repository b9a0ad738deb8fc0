#pragma once
/// \file
/// Plan as a document, gonio.plan/2.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/plan/plan.h"

namespace gonio::scene {

std::string to_json(const Plan&);
std::string plan_schema();

/// Forms that a plan chooses, by material of the scene; no value for those that no object has.
struct PlannedForms {
  std::vector<std::optional<Forms>> by_material;
};

/// Forms of a plan's document.  A plan of another scene, forms that a material does not offer, and a spec that is not that of the
/// forms are bad_input.
PlannedForms read_plan(const std::string& path, const Scene&, const std::vector<Look>&);

/// What a plan ships of a material: its model's spec and parameters, and the form of each effect.
struct PlannedMaterial {
  std::string spec;
  std::vector<std::pair<std::string, std::vector<double>>> parameters;
  Forms forms;
};
/// One material of a plan's document, without its scene.  A name that the plan has not is wrong usage.
PlannedMaterial read_planned_material(const std::string& path, const std::string& name);

}  // namespace gonio::scene
