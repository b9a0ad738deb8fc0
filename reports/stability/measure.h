#pragma once
/// \file
/// Places where the atlas looks at forms by their width, and what it finds there: for its pictures.

#include <string>
#include <vector>

#include "reports/stability/stability.h"
#include "stability/evaluate.h"

namespace gonio::stabilities {

using Inputs = std::vector<double>;

/// Ids of the forms that a setting looks at.
std::vector<std::string> forms(const StabilityOptions&);

/// Narrows a subject to where shaders live, in one number.  In half that is small: products of angles must not become
/// subnormal, which any GPU may flush.
void narrow_to_shaders(stability::Subject&, Number);

/// "overflow, underflow"; "" of neither.
std::string text_of(const HalfFlags&);
/// Width from which on people expect half to be good enough.
constexpr double usual_width = 0.05;
/// StabilityRow::misses and its reason, of a row that has all else.
bool misses_target(const StabilityRow&, Number);
std::string reason_of(const StabilityRow&, Number);

/// Adds the verdict on half for F and G.
void judge_f_and_g_in_half(Findings&, const StabilityRows&);

/// n values from low to high, each by the same factor.
std::vector<double> in_logarithms(double low, double high, std::size_t n);

}  // namespace gonio::stabilities
