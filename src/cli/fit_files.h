#pragma once
/// \file
/// The fit of files: one, or many into a folder.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "fitting/fit.h"
#include "table/table.h"

namespace gonio::cli {

struct FittedFile {
  Table table;
  FitResult result;
};
/// Reads and fits; the document is whole.
FittedFile fit_file(const std::string& path,
                    std::optional<Bins> bins,
                    const FitOptions& options,
                    const std::function<void(const std::string&)>& phase = {});

struct Batch {
  std::vector<std::string> inputs;  ///< files, folders, and lists of paths (@FILE)
  std::string output;               ///< a folder
  std::optional<Bins> bins;
  FitOptions options;
  bool json = false, quiet = false;
};
/// Whether these are more than one file by their number or kind.
bool is_batch(const std::vector<std::string>& inputs);

/// Fits each table on its own, as many at a time as there are threads and memory for, and writes
/// NAME.json for each and summary.csv, .html and .page.json of all.  NAME is the file's name less its
/// ending; the whole name where several tables would share that; with -2, -3 … in the order of the
/// tables where they share even this.  A table whose document is there already, of the same bytes,
/// side file and options, is not fitted again.
///
/// A table that cannot be read or fitted is a row of the summary; a result that cannot be written
/// ends the batch.  \return bad_input if a table could not be read, else usage if the options do not
/// suit one, else not_converged if a fit did not, else done
Exit fit_batch(const Batch&);

}  // namespace gonio::cli
