#pragma once
/// \file
/// Fits of many tables into a folder.

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "fitting/batch/batch_document.h"
#include "fitting/batch/fit_file.h"
#include "fitting/batch/gather.h"
#include "fitting/batch/part.h"
#include "table/table.h"

namespace gonio {

/// Key under which a kept result is found: program, version, and all that the description of HowFitted names but what
/// is empty, null or false.
std::string made_with(const HowFitted&);

struct Batch {
  std::vector<std::string> inputs;  ///< files, folders, and lists of paths (@FILE)
  std::string output;               ///< a folder
  HowFitted how;
  std::optional<Part> part = {};  ///< the tables of this part alone, and no summary
};
/// True where these are more than one file by their number or kind.
bool is_batch(const std::vector<std::string>& inputs);

/// Paths that inputs stand for: those of folders and lists in their place, each once.  A folder or list that
/// cannot be read is bad_input.  They and their side files are inputs of the run (FileGuard).
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
  SummaryPage page;
  /// Page of one table, HTML; without it none is made.
  std::function<std::string(const FittedFile&)> table_page;
};
/// Rows in the order of the tables of the batch, or of its part.
struct BatchResult : BatchSummary {
  BatchCount count;
  std::size_t others = 0;  ///< tables of the folder's summary that are not of this batch
};

/// Fits each table on its own, as many at a time as there are threads and memory for, and writes
/// document_names() for each, of a fit or of a failure, NAME.fit.html where pages of tables are asked for, and the
/// summary of the folder by gather().  A table whose document is
/// there already, of the same bytes, side file and options, is not fitted again.
///
/// A table that cannot be read or fitted is a row of the summary; a result that cannot be written
/// ends the batch.
///
/// Of a part the documents have the names that they have of the whole, and no summary is written: it would know of
/// one part alone.  Any number of parts may share the folder, at once or one after the other.
BatchResult fit_batch(const Batch&, const BatchHooks& = {});

}  // namespace gonio
