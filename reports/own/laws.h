#pragma once
/// \file
/// The laws that a function of a person's file keeps or breaks, over its parameters and over directions.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "foreign/function.h"
#include "reports/measure/samples.h"
#include "reports/own/energy.h"

namespace gonio {

struct Laws {
  std::optional<FoundAt> normalisation;  ///< ∫ D cos θ dω, furthest from 1
  std::optional<FoundAt>
      reciprocity;                   ///< largest relative difference with light and view exchanged
  std::optional<FoundAt> lowest;     ///< below 0, else none
  std::optional<FoundAt> above_one;  ///< of a Fresnel term, else none
  std::size_t not_finite = 0;        ///< of the inputs looked at, in double
  std::string not_finite_at;         ///< the first of them
  /// Parameters, and of a term cosines, that it reads and that change nothing.
  std::vector<std::string> without_effect;
  bool fails_behind = false;  ///< a whole model has no value for a light behind the horizon
};
Laws laws_of(const foreign::Function&, std::size_t foreign_term);
/// Of a function that takes the cosine of one direction only, that of the other; null of one that takes both, or neither.
double auditing::Row::*other_cosine(const foreign::Function&);

}  // namespace gonio
