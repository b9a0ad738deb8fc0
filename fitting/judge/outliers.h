#pragma once
/// \file
/// Outliers: values whose residuals are far from those of the values around them.

#include <cstddef>
#include <optional>

#include "fitting/judge/left_over.h"

namespace gonio {

/// Values that no model of a surface explains and that the fit follows, as of dust, glints and slips of a reading.
struct Outliers {
  std::size_t values;    ///< of those that were looked at
  double share;          ///< of those
  double typical;        ///< median factor between them and what those around them say, above 1
  std::size_t farthest;  ///< sample of the table
  bool retro =
      false;  ///< whether most of them are bright ones near wo = wi: then they are a highlight
};

namespace misfit {
/// Values whose residuals are six robust standard deviations or more from those of the twelve nearest values of their channel,
/// by the table's scatter and by theirs, where these lie on all sides: at the end of the angles a wrong model looks the same.
/// None unless they make up most of the squares that the fit minimises, and few of its values.
std::optional<Outliers> outliers(const Left&);
}  // namespace misfit

}  // namespace gonio
