#pragma once
/// \file
/// Slips of whole models beside those of a single term: what multiplies a highlight, its half vector, and what stands for Fresnel's
/// term.

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "number/parameter.h"
#include "reports/own/parameters.h"
#include "reports/own/slip_forms.h"

namespace gonio {

/// What a slip multiplies a highlight with.
struct Disguise {
  double (*factor)(const auditing::Row&);
  const char* slip;
  bool is_of_f = false;    ///< said of F
  bool is_weight = false;  ///< right where F0 is a weight
};
/// The first is none.
std::span<const Disguise> disguises();

/// What a shader does with its half vector.
struct HalfVector {
  std::array<double, 2> (*cosines)(const auditing::Row&);  ///< NoH, VoH; none: it is of length 1
  const char* slip;
  bool is_clamped = true;  ///< its cosines are at most 1
};
std::span<const HalfVector> half_vectors();

/// A Fresnel term that a function has where no parameter is F0, with its parameter.
struct Interface {
  std::string_view id;
  double parameter;
  const ExactSlip* exact = nullptr;
  const OtherCosine* cosine = nullptr;

  auditing::Values values(std::vector<auditing::Row>) const;
  const char* slip() const { return exact ? exact->slip : cosine ? cosine->slip : ""; }
};
/// One without an id where a parameter is F0.
std::vector<Interface> interfaces(const PartColours&, std::span<const Parameter>);

}  // namespace gonio
