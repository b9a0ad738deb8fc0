#pragma once
/// \file
/// The cases of the report: truths, what is fitted to each, and one fit.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geometry/direction.h"
#include "reports/cross_fit/cross_fit.h"
#include "reports/measure/surfaces.h"
#include "table/table.h"

namespace gonio {

/// The truths, and what is fitted to each.
std::vector<CrossTruth> cross_truths(const CrossFitOptions&);
std::vector<CrossForm> cross_forms(const CrossTruth&);

/// The model of a truth: its exact Fresnel term is the dielectric's or the conductor's.
BoundModel bound_truth(const CrossTruth&, const FresnelSurface&, double roughness);

/// Light that has met two facets or more, f − D V F [1/sr], by random walks at each of the pairs, light and
/// viewer above the horizon: [channel][pair].
std::vector<std::vector<double>> beyond_one_facet(const BoundModel&,
                                                  std::span<const DirectionPair>,
                                                  std::size_t walks,
                                                  std::uint64_t seed);

/// A truth as a table, and what the walks leave uncertain in it.
struct CrossSlice {
  Table table;
  /// Table from half of the walks; no value: the truth is exact.
  std::optional<Table> half{};
  double log_error = 0;  ///< RMS over values of the standard error of ln f
};
/// One for each surface.  A walk does not depend on what facets reflect: all of one kind share theirs.
/// \param surfaces  of one kind
std::vector<CrossSlice> slices_of(const CrossTruth&,
                                  std::span<const FresnelSurface> surfaces,
                                  double roughness,
                                  const CrossLayout&,
                                  const CrossFitOptions&);

/// One form fitted to one truth.
CrossCase fit_case(const CrossTruth&,
                   const CrossForm&,
                   const FresnelSurface&,
                   double roughness,
                   const CrossSlice&,
                   Metric);

/// Slice of a published model that has no counterpart here: kd/π + a F(η) G S/(π NoL NoV), S = (1 + b (1 − NoH))^−c, G of
/// V-shaped grooves.  At small angles S is GTR's of alpha² = 2/b and gamma = c.
Table published_slice(double kd, double a, double b, double c, double eta, std::size_t bins);
std::vector<PublishedFit> published_fits(std::size_t bins);

/// Id without its prefix; what else a form is called by as it is.
std::string_view short_form(std::string_view name);

}  // namespace gonio
