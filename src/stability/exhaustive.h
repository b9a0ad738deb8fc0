#pragma once
/// \file
/// Exhaustive evidence: a term at every half there is, or at every pair of them, against the same formula in double.

#include <functional>
#include <string_view>

#include "stability/evidence.h"
#include "stability/kernel/half_columns.h"
#include "stability/subject.h"

namespace gonio::stability {

/// Formula over columns, in halves and in double, as the catalogue's terms are.
struct Formula {
  std::function<void(const Block<float>&, const float* parameters, float* out)> halves;
  std::function<void(const Block<double>&, const double* parameters, double* out)> doubles;
};
/// A term of the catalogue, halves by these rules.
Formula formula_of(std::size_t term, const HalfRules&, std::string_view instruction_set = {});

/// True where at most two inputs have more than one half in their domain, and at most one of these is a parameter.
bool can_be_exhausted(const Subject&);

/// Worst and first of all halves within the subject's domain; an input whose domain is one point stays there.
/// Subnormal inputs are among them, flushed or not.
///
/// The worst is confirmed in fifty digits: its values are against these.  `beyond` is the largest among the worst inputs
/// of 256 rows, each of which is one value of the parameter.  The angles are rounded before the formula takes them up,
/// also where what follows may be contracted.
///
/// \param tolerance  relative of a result above 2⁻¹⁴; below it of 2⁻¹⁴
/// \param formula    in place of the subject's own, and then against its double alone, without condition
/// \throws Error (wrong usage) where can_be_exhausted is false
Looked exhaustive(const Subject&,
                  const HalfRules&,
                  const Tolerance& tolerance = 0.02,
                  const Formula* formula = nullptr);

}  // namespace gonio::stability
