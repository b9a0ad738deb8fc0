#pragma once
/// \file
/// Columns and facts of a table that several fits read, made once.

#include <memory>
#include <optional>
#include <span>

#include "fitting/sample/data.h"
#include "table/health/facts.h"

namespace gonio {

/// Fit levels of the last table looked at, for the next fit that looks at it in the same way.  For one fit at a time.
class SharedColumns {
 public:
  /// fit_levels() of this sampling.
  template <class F>
  std::shared_ptr<const FitLevels<F>> levels(const Sampling&, std::span<const std::size_t> levels);
  /// Facts of that table.
  TableFacts& facts(const Table& t) {
    if (!facts_ || &facts_->table() != &t) facts_.emplace(t);
    return *facts_;
  }

 private:
  template <class F>
  struct Kept {
    std::optional<Sampling> of;
    std::vector<std::size_t> levels;
    std::shared_ptr<const FitLevels<F>> columns;
  };
  std::tuple<Kept<float>, Kept<double>> kept_;
  std::optional<TableFacts> facts_;
};

}  // namespace gonio
