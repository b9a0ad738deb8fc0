#pragma once
/// \file
/// Page of a plan, gonio.plan/2.

#include <string>

#include "scene/plan/plan.h"

namespace gonio {

/// Page that shows the scene with all effects and as planned, and for each material what to keep, what to drop and why.
std::string plan_page_html(const scene::Scene&, const scene::Plan&);

/// Why the cheapest set that was passed over is not the plan: "the cheapest of them, at 1.29 ns, differs by 4.6 at its worst point,
/// where a plan may differ by 3.6".  \pre  one was
std::string why_passed_over(const scene::MaterialPlan&, scene::Cost);

}  // namespace gonio
