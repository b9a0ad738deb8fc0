#pragma once
/// \file
/// Fits of many tables as documents: one of each table, and of all of them a table as CSV and one JSON document.

#include <array>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/names.h"
#include "fitting/batch/preview.h"
#include "fitting/result/document.h"

namespace gonio {

/// Fitted parameter, less what only its document shows of it.
struct BatchParameter {
  std::string name;
  std::vector<double> value, std_error;
  std::vector<ParameterStatus> status;
  std::vector<double> limit = {};
};

/// Part of a fit document that the summary shows.
struct BatchFit {
  std::string model;
  std::vector<std::string> channels;
  std::vector<BatchParameter> parameters;
  double log_rms = 0, rms = 0, cost = 0;
  double misfit = std::numeric_limits<double>::quiet_NaN();  ///< Misfit::size, where it was tested
  bool misfit_told = false;
  std::size_t values_used = 0;
  std::map<std::string, std::size_t> masked;  ///< values left out, by reason
  std::vector<std::string> warnings;
  std::vector<std::pair<std::string, double>> time_ms;  ///< by phase
};

/// One table of a batch.
struct BatchRow {
  std::string path;  ///< of the table
  std::string
      document;  ///< the name of its fit document, beside the summary; empty if there is none
  Exit outcome = Exit::bad_input;  ///< as if it had been fitted alone
  std::string message;             ///< why there is no fit; else why the search ended
  std::optional<BatchFit> fit;
  std::optional<Preview> preview;  ///< where there is a fit
  std::string page = {};  ///< the name of its page, beside the summary; empty if there is none
};

/// Fit document as a batch writes it: of schema "gonio.fit/1" like any other, and with
/// "batch": {"made_with", "preview"}.
/// \param made_with  all that determines the result beside the table's bytes, in words
std::string batch_document(const FitDocument&, const Preview&, const std::string& made_with);
/// Document of schema "gonio.failure/1", which stands under the fit's name where a table has none: whoever makes a
/// summary later knows that it was tried, and why.
std::string failure_document(const BatchRow&, const std::string& made_with);

/// Text as it comes back from a document: bytes that are no text are replaced there.
std::string as_in_document(const std::string& text);

/// Document of a batch as it lies in a folder, of a fit or of a failure.
struct ReadDocument {
  BatchRow row;                   ///< without its document and page
  std::string made_with, sha256;  ///< the latter of the table's bytes; empty of a failure
};
/// Memory that the rows of a document, and of all documents of a folder, take at most [bytes].
inline constexpr std::size_t most_of_a_row = std::size_t{1} << 24,
                             most_of_all_rows = std::size_t{1} << 29;
/// Memory that a document's row takes, about [bytes].
std::size_t memory_of(const ReadDocument&);
/// Document of a batch, read; no value of a document of anything else.  One that is not whole, or has a row that takes too much memory, is
/// bad_input.
std::optional<ReadDocument> read_document(const std::string& path);
/// \param bytes  of the document
std::optional<ReadDocument> parse_document(const std::string& path, const std::string& bytes);

/// Row read back from a fit's document, if it is there, whole, and the result for these bytes made in
/// this way.
std::optional<BatchRow> read_batch_document(const std::string& path,
                                            const std::string& sha256,
                                            const std::string& made_with);
/// True where a batch wrote it, of whatever table.
bool is_batch_document(const std::string& path);

/// Why a document that lies in a folder of results is not in its summary.
enum class LeftOut {
  made_otherwise,        ///< by another version of gonio, or with other options
  another_of_its_table,  ///< there is a newer one, or one under the name that the list gives it
  unreadable
};
template <>
inline constexpr std::array<std::string_view, 3> names_of<LeftOut>{
    "made_otherwise", "another_of_its_table", "unreadable"};

struct LeftOutDocument {
  std::string document;  ///< its name in the folder
  LeftOut why = LeftOut::unreadable;
  std::string path;       ///< of its table; empty where it cannot be read
  std::string made_with;  ///< of it; empty where it cannot be read
  std::string message;    ///< why it cannot be read
};

/// Summary of many tables.
struct BatchSummary {
  std::string made_with;  ///< all that determines a result beside the table's bytes, in words
  std::vector<BatchRow> rows;
  std::vector<std::string> missing = {};       ///< tables that nobody has tried yet, in this way
  std::vector<LeftOutDocument> left_out = {};  ///< in the order of their names
  std::string part = {};                       ///< "2/4", where these are the tables of one part

  /// check_failed if a table is missing, else bad_input if one could not be read, else usage if the options do not
  /// suit one, else not_converged if a fit did not, else done.
  Exit outcome() const;
};

/// One line per table, RFC 4180: path, document, status, exit_code, model, then for each parameter
/// and channel (kd.r) its value, std_error and status, then log_rms, rms [1/sr], cost, values_used,
/// masked, misfit, misfit_told (true or false), warnings (how many), message.  Unknown cells are empty; text is never a formula, see
/// base/csv.h.
std::string batch_csv(const std::vector<BatchRow>&);

/// Document of schema "gonio.batch/1": made_with, counts of the tables by status, the tables, and what is not among them.
/// \param previews  with them, on one line: for the page
std::string batch_json(const BatchSummary&, bool previews);

/// JSON Schema of fit documents, whether a batch wrote them or not.
std::string fit_schema();
/// JSON Schema of failure_document().
std::string failure_schema();
/// JSON Schema of batch_json().
std::string batch_schema();

}  // namespace gonio
