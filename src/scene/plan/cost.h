#pragma once
/// \file
/// Cost of a surface by direction of light: of f in three channels, and of what is looked up in place of an environment's directions.

#include <functional>
#include <span>
#include <vector>

#include "scene/plan/samples.h"
#include "timing/timing.h"

namespace gonio::scene {

/// Operations of a row, those of several bounces and of the coat too; lookups count nothing.
double operations_of(const Surface&, const LitPoints&);

/// Times of a row [ns], each composed of its terms' kernels, measured side by side.  A surface that looks the environment up spares
/// its rows, and looks up once a point.
std::vector<Timing> times_of(std::span<const Surface>, const LitPoints&);

}  // namespace gonio::scene
