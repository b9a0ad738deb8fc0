#pragma once
/// \file
/// The whole models that are measured: what they compute, and how far from the truth that is.

#include <string>
#include <vector>

#include "brdf/in_number/number.h"
#include "brdf/model/model.h"
#include "reports/cost/cost.h"

namespace gonio::costing {

/// A whole model that is measured: compositions in one channel, those that ship in three.
struct Whole {
  std::string id;  ///< of a preset, else the spec
  BoundModel model;
};
std::vector<Whole> wholes();

std::size_t table_bytes(const Model&);
std::size_t table_bytes(std::string_view term);

/// Error of a term in a number against the form at the end of what it stands for; masking against the correlated
/// Smith of its distribution.
CostError error_of_term(std::size_t term, Number);
/// Error of a whole model in F against exact Smith (correlated) and exact Fresnel under its distribution, of glass
/// and of gold without diffuse reflection, over roughness 0.1 to 1 and cosines from 0.05, where D is above
/// a millionth of its most.
template <class F>
CostError error_of_whole(const Whole&);

}  // namespace gonio::costing
