#pragma once
/// \file
/// What is known of a shader's error, term by term, with its evidence (src/stability).

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "shader/language.h"
#include "shader/traced_formula.h"

namespace gonio::shader {

/// Least cosine of the domain: 89.4 degrees.
inline constexpr double least_cosine = 0.01;

/// A sentence for each term: is it finite on every GPU that keeps Vulkan's rules, and how far off was it found, or proved
/// to be, for parameters where a fit looks for them (or the constant's value) and cosines from least_cosine on.  Seconds.
///
/// The same of a whole model: terms that are right make a product that may overflow in half.
///
/// WGSL's compilers may fuse a product and a sum.
std::vector<std::string> evidence_of(const TracedFormula&,
                                     Language,
                                     const std::function<void(std::string_view term)>& progress);

}  // namespace gonio::shader
