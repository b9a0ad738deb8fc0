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

/// True where two times are too near to each other for a clock: within twice their spreads.  A spread is what repetitions in one process
/// leave open: twice that is none between processes.
bool are_too_near(const Timing&, const Timing&);
/// Part of a time that is its spread at least.
inline constexpr double least_spread = 0.03;
/// True of a ratio of times that are too near to each other.
bool is_as_fast(double speedup);

}  // namespace gonio::scene
