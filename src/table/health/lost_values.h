#pragma once
/// \file
/// Values that noise, digits, a full detector or somebody who filled gaps took away.

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace gonio {

class TableFacts;

/// Last value that many samples share, of a channel or of several that end there.
struct SharedEnd {
  double value;
  std::size_t sharers, values;
  std::vector<std::string> channels;
};
/// The least value, where that many share it and noise goes on above.
std::optional<SharedEnd> clipped_end(TableFacts&);

/// Says that zeros or digits hide values.
void warn_of_zeros(TableFacts&, std::vector<std::string>& all);

/// A greatest value that many samples share is where a detector was full; a least one, where noise was clipped; any other, where
/// somebody filled a gap.
void warn_of_shared_ends(TableFacts&, std::vector<std::string>& all);

/// Size of noise or digits below which each channel lost values [1/sr]: the noise floor that its negative values betray, or how much
/// those scatter that stand beside values below 0, beside clipped ones, or beside zeros where these are more than 0.5 %.  Else 0, and
/// where zeros stand between values that are alike: these are marks.
std::vector<double> lost_below(TableFacts&);
/// True where some channel lost values.
inline bool is_any_lost(const std::vector<double>& lost) {
  return std::ranges::any_of(lost, [](double size) { return size > 0; });
}

/// True where noise below 0, or below a least value, was clipped: every metric is then biased.
bool is_clipped(TableFacts&);

}  // namespace gonio
