#pragma once
/// \file
/// Measured costs beside those of an earlier document.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reports/cost/cost.h"

namespace gonio {

/// Name of what is timed: the same on every machine.
struct CostName {
  std::string id, number, isa, memory, way;
  auto operator<=>(const CostName&) const = default;
};
CostName name_of(const CostRow&);

struct EarlierCosts {
  std::string cpu, compiler, flags;  ///< of the machine
  struct Entry {
    CostName name;
    Timing time;
  };
  std::vector<Entry> entries;
};

/// A document of `gonio bench --json` or cost.json of `gonio report cost`.  Anything else is bad_input.
EarlierCosts read_costs(const std::string& path);
/// Costs in a document's text.  \param name  of where it is from
EarlierCosts costs_of(const std::string& text, const std::string& name);

struct CostChange {
  CostName name;
  std::optional<Timing> before, now;  ///< where it is missing: not measured
  double ratio = 0, spread = 0;       ///< of now over before, where both are there
  bool differs = false;  ///< by more than three times both spreads, which chance alone seldom does
};
/// Changes in the order of the rows; what is not among them comes last.
/// \param filter  entries whose ids do not hold it are left out
std::vector<CostChange> changes(const EarlierCosts&,
                                const std::vector<CostRow>&,
                                std::string_view filter = {});

/// The document of `gonio bench`: rows as of the cost report, and what changed since an earlier one.
std::string costs_json(const Machine&,
                       const CostOptions&,
                       const MeasuredCosts&,
                       const std::vector<CostChange>& = {});
/// JSON Schema of that document.
std::string bench_schema();

}  // namespace gonio
