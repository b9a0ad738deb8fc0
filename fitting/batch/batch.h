#pragma once
/// \file
/// Fits of many tables into a folder.

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/describe.h"
#include "base/error.h"
#include "fitting/batch/batch_document.h"
#include "fitting/batch/fit_file.h"
#include "fitting/solve/options.h"
#include "table/table.h"

namespace gonio {

/// All that determines a result beside the bytes of its table.
struct HowFitted {
  FitOptions options;
  std::optional<Bins> bins;  ///< in place of what each table says
};
template <>
struct Description<HowFitted> {
  static constexpr auto fields() {
    return std::tuple{inlined(&HowFitted::options),
                      field("bins", "", &HowFitted::bins,
                            "where samples sit in their bins, if not as each table says")};
  }
};
static_assert(describes_every_member<HowFitted>());

/// Key under which a kept result is found: program, version, and all that the description of HowFitted names but what
/// is empty, null or false.
std::string made_with(const HowFitted&);

struct Batch {
  std::vector<std::string> inputs;  ///< files, folders, and lists of paths (@FILE)
  std::string output;               ///< a folder
  HowFitted how;
};
/// True where these are more than one file by their number or kind.
bool is_batch(const std::vector<std::string>& inputs);

/// Paths that inputs stand for: those of folders and lists in their place.  A folder or list that
/// cannot be read is bad_input.
std::vector<std::string> tables_of(const std::vector<std::string>& inputs);
/// Names of the documents of tables, each another: the file's name less its ending; the whole name
/// where several tables would share that; with -2, -3 … in the order of the tables where they share
/// even this.
std::vector<std::string> document_names(const std::vector<std::string>& tables);

/// State of a batch while it is running.
struct BatchCount {
  std::size_t all = 0, done = 0, kept = 0, failed = 0;
};
struct BatchHooks {
  /// Called at the start and after each table, by one thread at a time.
  std::function<void(const BatchCount&)> progress;
  /// Page of the summary: HTML of a title and of batch_json() with previews.
  std::function<std::string(std::string_view title, std::string_view data)> page;
  /// Page of one table, HTML; without it none is made.  \param document  fit.json as text
  std::function<std::string(const FittedFile&, std::string_view document)> table_page;
};
struct BatchResult {
  std::vector<BatchRow> rows;  ///< in the order of the tables
  BatchCount count;
  std::string made_with;
  /// bad_input if a table could not be read, else usage if the options do not suit one, else
  /// not_converged if a fit did not, else done.
  Exit outcome() const;
};

/// Fits each table on its own, as many at a time as there are threads and memory for, and writes
/// document_names() for each, NAME.fit.html where pages of tables are asked for, and summary.csv, .html and
/// .page.json of all.  A table whose document is
/// there already, of the same bytes, side file and options, is not fitted again.
///
/// A table that cannot be read or fitted is a row of the summary; a result that cannot be written
/// ends the batch.
BatchResult fit_batch(const Batch&, const BatchHooks& = {});

}  // namespace gonio
