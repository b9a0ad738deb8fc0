#pragma once
/// \file
/// Surfaces in half precision, as phones would shade them.

#include <vector>

#include "scene/plan/samples.h"
#include "scene/surface/surface.h"

namespace gonio::scene {

/// Radiance of every point where f is computed in halves: its parameters and angles, each operation of its terms, their products and
/// sums.  What light brings is not rounded, nor is the sum over it, nor what is looked up of an environment.  Infinite or not a number where that is so.
std::vector<Rgb> radiance_in_half(const Surface&, const LitPoints&);

}  // namespace gonio::scene
