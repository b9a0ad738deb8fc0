#pragma once
/// \file
/// The fits of many tables in one look: a document for each, and of all of them a table as CSV, one
/// JSON document and a page.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "fitting/result/document.h"
#include "reports/tables/preview.h"

namespace gonio {

/// What a batch knows of one table.
struct BatchRow {
  std::string path;  ///< of the table
  std::string
      document;  ///< the name of its fit document, beside the summary; empty if there is none
  Exit outcome = Exit::bad_input;  ///< as if it had been fitted alone
  std::string message;             ///< why there is no fit; else the solver's words
  FitDocument fit;                 ///< what the summary shows of it, if there is one
  Preview preview;
};

/// A fit document as a batch writes it: of schema "gonio.fit/1" like any other, and with
/// "batch": {"made_with", "preview"}.
/// \param made_with  all that determines the result beside the table's bytes, in words
std::string batch_document(const FitDocument&, const Preview&, const std::string& made_with);

/// The same read back, if it is there, whole, and the result for these bytes made in this way.
std::optional<BatchRow> read_batch_document(const std::string& path,
                                            const std::string& sha256,
                                            const std::string& made_with);
/// Whether a batch wrote it, of whatever table.
bool is_batch_document(const std::string& path);

/// One line per table, RFC 4180: path, document, status, exit_code, model, then for each parameter
/// and channel (kd.r) its value, std_error and status, then log_rms, rms [1/sr], cost, values_used,
/// masked, warnings (how many), message.  What is not known is empty.
std::string batch_csv(const std::vector<BatchRow>&);

/// {"schema": "gonio.batch/1", "made_with", "counts": {status: tables}, "tables": [{"path",
/// "document", "status", "exit_code", "message", "model", "channels", "parameters", "log_rms", "rms",
/// "cost", "values_used", "masked", "warnings", "time_ms", "preview"}]}; the preview for the page only.
std::string batch_json(const std::vector<BatchRow>&, const std::string& made_with, bool previews);

/// The page, HTML.  \param data  batch_json() with previews
std::string batch_page_html(std::string_view title, std::string_view data);

}  // namespace gonio
