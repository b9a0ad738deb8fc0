#pragma once
/// \file
/// Several files of one sample, as instruments write them: one for each incident angle, detector or day.

#include <optional>
#include <string>
#include <vector>

#include "table/format/formats.h"

namespace gonio {

/// The samples of all files, in their order, as one list; of grids those above the horizon.  All have the same channels.
///
/// Where a file's directions stand in an earlier one, too (θ_i, θ_o and |φ_o − φ_i| to 0.05°), the two are compared: a note gives the median
/// of the ratios, and a warning names files whose scales differ, by more than 5 % and by more than three standard errors of the
/// median.  What is odd about a file is said with its name.
/// Table::sha256 is that of the files' own, line by line.
/// \throws Error  as read_table(), or bad_input where channels differ or there are more samples than a reader takes
Table read_as_one(const std::vector<std::string>& paths, std::optional<Bins> bins = {});
/// The table of one file, or that of several.
TableAndDigest read_files(const std::vector<std::string>& paths, std::optional<Bins> bins = {});

}  // namespace gonio
