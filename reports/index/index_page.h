#pragma once
/// \file
/// The page that leads to all reports: questions and their answers, the findings of each, claims and their verdicts.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "reports/finding/report.h"

namespace gonio {

struct ReportIndex {
  struct Entry {
    std::string_view name, what;
    double ms;  ///< that it took
    Findings findings;
    std::size_t pictures;
  };
  std::vector<Entry> reports;
  std::string version;  ///< of gonio
  bool full = false;
  std::int64_t at_ms = 0;  ///< when, since 1970
};

/// The first sentence: up to a full stop before a blank and a capital or a quote.
std::string first_sentence(std::string_view);

std::string to_json(const ReportIndex&);
/// JSON Schema of that document.
std::string index_schema();
/// \param data  of to_json() above
std::string index_page_html(std::string_view data);

}  // namespace gonio
