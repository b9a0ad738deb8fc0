#pragma once
/// \file
/// Times that several processes find, each of everything in turn.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "reports/cost/baseline.h"

namespace gonio {

/// Arguments by which `gonio` measures the times alone, in one process, and prints them as a document.
std::vector<std::string> arguments_of_a_process(const CostOptions&);

/// Times of each of these names, one of every process in their order; empty where the options ask for none, or one of
/// them cannot be started or did not measure all.
std::vector<std::vector<double>> times_in_processes(const CostOptions&,
                                                    const std::vector<CostName>&,
                                                    const std::function<void(double)>& done);

}  // namespace gonio
