#pragma once
/// \file
/// Reciprocity: whether light that goes the other way finds the same reflectance.

#include <functional>
#include <optional>
#include <string>

#include "table/table.h"

namespace gonio {

struct Reciprocity {
  std::optional<double> error;  ///< median |a − b| / ((a + b)/2) over channels and samples
  std::string note;             ///< why there is none, or from what it is
};

/// Values that a sample is compared with.
enum class Partners {
  none,
  samples,  ///< the one whose wi and wo are exchanged
  between   ///< Table::between, at some of the samples if there are many
};
/// Visitor of each sample and channel: the value a, and b the other way; both valid.
using ReciprocalVisitor =
    std::function<void(std::size_t sample, std::size_t channel, double a, double b)>;
/// A grid of half angles shows each pair once, others each sample with its partner.
Partners for_each_reciprocal(const Table&, const ReciprocalVisitor&);
/// |a − b| / ((a + b)/2); 0 where both are 0
double reciprocity_error(double a, double b);

/// Each sample against the one with wi and wo exchanged, where both are valid; a sample that is its
/// own partner (θ_i = θ_o on a grid) counts, with no error.  In a list whose light always comes from
/// one azimuth the partner may be turned about the normal: the surface is taken as isotropic.
/// Where no sample has a partner, against Table::between.
Reciprocity reciprocity(const Table&);

}  // namespace gonio
