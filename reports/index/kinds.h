#pragma once
/// \file
/// The reports by name: each a page DIR/NAME.html and its data DIR/NAME.json, made from the same struct;
/// its rows DIR/NAME.csv, and its pictures in DIR/NAME/.

#include <span>
#include <string_view>

#include "reports/finding/report.h"

namespace gonio {

struct ReportKind {
  std::string_view name, what;
  ReportFiles (*make)(const ReportOptions&, const ReportProgress&);
  std::string (*schema)();  ///< JSON Schema of its document
  double weight = 1;        ///< the time it takes at the standard setting, about [s]
};

/// All reports, in the order of the index page.
std::span<const ReportKind> report_kinds();

}  // namespace gonio
