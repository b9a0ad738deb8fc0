#pragma once
/// \file
/// Page of a plan, gonio.plan/2.

#include <string>

#include "scene/plan/plan.h"

namespace gonio {

/// Page that shows the scene with all effects and as planned, and for each material what to keep, what to drop and why.
std::string plan_page_html(const scene::Scene&, const scene::Plan&);

}  // namespace gonio
