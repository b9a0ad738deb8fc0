#pragma once
/// \file
/// The parts of cost_report(), each filling its own.

#include <functional>
#include <string>
#include <vector>

#include "brdf/in_number/number.h"
#include "brdf/model/model.h"
#include "reports/cost/cost.h"

namespace gonio {

namespace costing {

/// A whole model that is measured: compositions in one channel, those that ship in three.
struct Whole {
  std::string id;  ///< of a preset, else the spec
  BoundModel model;
};
std::vector<Whole> wholes();

/// Of one sample in all channels, as one formula: a lobe's D V and F divide together.
Operations operations_of_model(const Model&);
std::size_t table_bytes(const Model&);
std::size_t table_bytes(std::string_view term);

/// A term in a number against the form at the end of what it stands for; masking against the correlated
/// Smith of its distribution.
CostError error_of_term(std::size_t term, Number);
/// A whole model in F against exact Smith (correlated) and exact Fresnel under its distribution, of glass
/// and of gold without diffuse reflection, over roughness 0.1 to 1 and cosines from 0.05, where D is above
/// a millionth of its most.
template <class F>
CostError error_of_whole(const Whole&);

}  // namespace costing

void add_switches(CostReport&);
void add_points(CostReport&, const CostOptions&, const std::function<void(double)>& done);
/// From what the others have filled in.
void add_findings(CostReport&);

/// A form that is kept as a mistake in circulation: none chooses it.
bool is_mistake(const CostRow&);

/// The row of a form in a place, of a model in one way; nullptr if it was not measured.
const CostRow* find_row(const std::vector<CostRow>&,
                        std::string_view id,
                        std::string_view number,
                        std::string_view isa,
                        std::string_view memory,
                        std::string_view way = {});

}  // namespace gonio
