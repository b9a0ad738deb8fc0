#pragma once
/// \file
/// Fit of one file, or of several of one sample.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/describe.h"
#include "fitting/fit.h"
#include "fitting/solve/options.h"
#include "table/format/measured_by.h"
#include "table/table.h"

namespace gonio {

/// All that determines a result beside the bytes of its table.
struct HowFitted {
  FitOptions options{.certificate = Certify::automatic};
  std::optional<Bins> bins = {};
  AsMeasured measured = {};
};
template <>
inline constexpr auto description<HowFitted> = FieldList{
    inlined(&HowFitted::options),
    Field{"bins", &HowFitted::bins,
          "where a sample sits in its bin: centre or edge (default: as the file says, or centre)"},
    inlined(&HowFitted::measured)};
static_assert(describes_every_member<HowFitted>());

struct FittedFile {
  Table table;
  FitResult result;
};
/// Reads and fits; the document is whole.  Several files are one table (table/format/as_one.h).
FittedFile fit_files(const std::vector<std::string>& paths,
                     const HowFitted&,
                     const std::function<void(const std::string&)>& phase = {});

}  // namespace gonio
