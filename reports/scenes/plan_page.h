#pragma once
/// \file
/// Page of a plan, gonio.plan/2.

#include <string>

#include "scene/plan/plan.h"

namespace gonio {

/// Page that shows the scene with all effects and as planned, and for each material what to keep, what to drop and why.
std::string plan_page_html(const scene::Scene&, const scene::Plan&);

/// Why the cheapest set that was passed over is not the plan: "the cheapest of them (1.29 ns) differs by 4.6 at its worst point, and
/// 3.6 is allowed".  \pre  one was
std::string why_passed_over(const scene::MaterialPlan&, scene::Cost);

/// That a plan does not keep `what`, and whether its budget is why.  \pre  it does not hold
std::string not_kept(const scene::MaterialPlan&, bool has_budget, const std::string& what);
/// What a plan that does not hold exceeds, as of why_passed_over(): "may exceed the limit at 53 % of all points, and …".
std::string what_is_exceeded(const scene::MaterialPlan&);

/// For a plan that keeps the table of the light between facets: the set of forms without it that was nearest when sets were
/// compared, and why it is rejected.
std::string without_table(const scene::MaterialPlan&, const scene::Tolerance&);

}  // namespace gonio
