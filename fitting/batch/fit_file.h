#pragma once
/// \file
/// Fit of one file.

#include <functional>
#include <optional>
#include <string>

#include "fitting/fit.h"
#include "table/table.h"

namespace gonio {

struct FittedFile {
  Table table;
  FitResult result;
};
/// Reads and fits; the document is whole.
FittedFile fit_file(const std::string& path,
                    std::optional<Bins> bins,
                    const FitOptions& options,
                    const std::function<void(const std::string&)>& phase = {});

}  // namespace gonio
