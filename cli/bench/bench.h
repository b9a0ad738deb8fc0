#pragma once
/// \file
/// Subjects that `gonio bench` can time, beside the kernels.

#include "cli/line/command.h"

namespace gonio::cli {

/// The fit of a MERL table beside the plain way of doing it.
struct FitBench {
  bool plain = true;  ///< with the plain way
  int repeats = 11;
};
Exit bench_fit(const FitBench&, const Common&);
/// Texels of maps beside one Ceres problem for each.
Exit bench_maps(const FitBench&, const Common&);
/// Parts of many tables beside one process for all.
Exit bench_parts(const FitBench&, const Common&);

}  // namespace gonio::cli
