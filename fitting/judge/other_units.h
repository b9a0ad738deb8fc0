#pragma once
/// \file
/// Units in which a model meets a table that it misses otherwise.

#include <functional>
#include <optional>
#include <string>

#include "fitting/solve/options.h"
#include "table/table.h"

namespace gonio {

/// Unit or scale that makes the values fit the model, in place of f in 1/sr.
struct OtherUnit {
  std::string step;  ///< what they may be, with the command that reads them so
  double log_rms;    ///< that the model leaves of them
};

/// Log RMS that options leave on a coarse sample of a table; NaN where they cannot.
using TryTable = std::function<double(const Table&, const FitOptions&)>;

/// The unit in which the model leaves least: radiance factors, percents, cosines left in or divided by, or any scale; where that is
/// at most half of what it leaves of the table as it is.  Asked of lists, whose files say no unit, and not of what gonio made.
/// \param here  log RMS of the table as it is
std::optional<OtherUnit> other_unit(const Table&, const FitOptions&, double here, const TryTable&);

}  // namespace gonio
