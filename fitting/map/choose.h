#pragma once
/// \file
/// Choice of a map's model among several, by images that their fits have not seen.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "fitting/map/texels.h"
#include "stack/stack_reader.h"

namespace gonio {

/// Model that was tried on some texels of a stack.
struct TriedModel {
  std::string model;
  double unseen_rms = 0;  ///< median over the texels, in the metric's unit
};

/// Models by what they leave, the least first.
///
/// Each is fitted to three of four images of a sample's texels and predicts the fourth.  Those within 5 % of the best stand as they were
/// named.
/// \throws Error  wrong usage of a model that the options do not suit; bad_input of a stack where fewer than 20 texels can be compared
std::vector<TriedModel> try_models(const StackReader&,
                                   const TexelOptions&,
                                   std::span<const std::string> models);

}  // namespace gonio
