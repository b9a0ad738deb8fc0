#pragma once
/// \file
/// The page that leads to all reports: what to ship, what Fresnel shows, accuracy against time, each report, and claims.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "reports/finding/report.h"
#include "reports/index/decisions.h"

namespace gonio {

struct ReportIndex {
  struct Entry {
    std::string_view name, what;
    double ms;  ///< that it took
    Findings findings;
    std::size_t pictures;
    Pictures first{};  ///< of them, the first alone
  };
  std::vector<Entry> reports;
  std::string version;  ///< of gonio
  bool full = false;
  std::int64_t at_ms = 0;  ///< when, since 1970
  Facts facts{};           ///< of all reports
  bool quick = false;      ///< a first look
};
/// Adds a report with what the index shows of it.
void add_report(ReportIndex&, std::string_view name, std::string_view what, double ms, ReportFiles);

/// The first sentence: up to a full stop before a blank and a capital or a quote.
std::string first_sentence(std::string_view);

std::string to_json(const ReportIndex&);
/// JSON Schema of that document.
std::string index_schema();
std::string index_page_html(const ReportIndex&);

}  // namespace gonio
