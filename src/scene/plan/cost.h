#pragma once
/// \file
/// Cost of a surface: f of one direction of light in three channels.

#include <functional>
#include <span>
#include <vector>

#include "scene/plan/samples.h"
#include "timing/timing.h"

namespace gonio::scene {

/// Operations, those of several bounces and of the coat too.
double operations_of(const Surface&);

/// Times of one row [ns], each composed of its terms' kernels, measured side by side.
std::vector<Timing> times_of(std::span<const Surface>, const LitPoints&);

}  // namespace gonio::scene
