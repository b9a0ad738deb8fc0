#pragma once
/// \file
/// Plan of one material: its effects one by one, sets of their forms, and the set that keeps the tolerance at the least cost.

#include <cstdint>

#include "scene/plan/plan.h"
#include "scene/plan/samples.h"

namespace gonio::scene {

/// Streams of points: those that sets are compared on, those that the chosen one is checked on; verify.cpp has its own.
inline constexpr std::uint64_t choosing = 1, checking = 2;

/// Plan of a material that is seen; where the scene has a budget, the front and no set of it yet.
MaterialPlan plan_material(const Lit&, std::size_t material, const PlanOptions&);

/// Puts a set that was judged into a plan, and what follows from it.
void take(MaterialPlan&, const Look&, const JudgedSet&);

/// Points of a check: fewer where each has the many directions that a lookup is compared with.
std::size_t fresh_points(const Scene&, const PlanOptions&, const Surface&);

}  // namespace gonio::scene
