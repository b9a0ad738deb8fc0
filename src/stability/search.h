#pragma once
/// \file
/// Searched evidence: the worst inputs of a subject that seeds and climbing find, for any number and any count of inputs.
///
/// Seeds lie towards every edge of the domain in logarithms: its ends, 0 and 1, what the subject says is hard, and where
/// two inputs meet (equal cosines, the critical angle).  From the worst of them on, steps of 1, 2, 4 … places of the number
/// in one input or two are taken wherever they lead to what is worse.  It is done twice, from two seeds.
///
/// Narrow numbers are judged by double while they climb, double by fifty digits; what is told is against fifty digits.

#include "stability/evidence.h"
#include "stability/subject.h"

namespace gonio::stability {

/// Relative error that people can live with: 2 % in half and mixed, 1e-4 in float, 1e-10 in double.
double usual_tolerance(Number);
/// Least number that a relative error is asked of: of what is smaller it is a share of this.  2⁻¹⁴ in half and mixed, 2⁻⁶⁴ in float
/// and double.
double least_asked(Number);

struct SearchOptions {
  Tolerance tolerance = 0;  ///< as Looked::lost has it; none of both: the usual one
  std::uint64_t seed = 1;
  double effort = 1;  ///< times as many seeds and steps
  /// false: only inputs without a value are looked for, in a tenth of the time; all else of Looked is as where nothing is wrong
  bool measures_errors = true;
};

/// Worst that is found, the same for a seed whatever the threads.
///
/// Results below 2⁻⁶⁴, in other numbers than half, are black and count as if they were that.  `irreciprocal` is looked at
/// where NoL and NoV are given, and nothing else of the directions.  Units of mixed numbers are those of a half.
/// `settled`: both seeds' worst relative error, and worst beyond the condition, agree within a factor of two, or are less
/// than 8 units.
///
/// \throws Error (wrong usage) of flushing or contraction in another number than half
Looked search(const Subject&, const Arithmetic&, const SearchOptions& = {});

}  // namespace gonio::stability
