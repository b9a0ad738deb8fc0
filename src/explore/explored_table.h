#pragma once
/// \file
/// A table as the explorer's pages hold it: made by the program, and by a page that reads a file itself.

#include <cstdint>
#include <string>
#include <vector>

#include "base/json/reader.h"
#include "table/cut/cuts.h"
#include "table/health/health.h"
#include "table/table.h"

namespace gonio {

/// Models are compared with so many samples of a table at most.
inline constexpr std::size_t most_explored_samples = 8192;

/// A page that the program makes holds no file of more bytes.
inline constexpr std::uint64_t most_held_bytes = std::uint64_t{1} << 24;

/// A table as a page holds it: resampled, but for the values that are drawn as points.
struct ExploredTable {
  std::string name;
  std::vector<std::string> channels;  ///< three at most; of more the first, middle and last
  std::size_t channels_in_file = 0;
  std::size_t values = 0;  ///< valid ones of the file, in these channels
  Table grid;              ///< over explore::page_grid(); NaN where the table has no value near
  double loss =
      1;  ///< typical factor between the file's values and the grid's at the same directions
  double covered = 0;  ///< share of the file's values at whose directions the grid has one
  /// Of the file itself, most_explored_samples at most: four angles as gonio eval has them [°], then values by channel.
  std::vector<std::vector<double>> samples;
  std::vector<Cut> cuts;             ///< of the file itself
  std::vector<AlbedoSample> albedo;  ///< likewise
  /// The file itself, for a page that fits it, and its side file; the SHA-256 alone of one of more than most_held_bytes.  Empty where the page holds it.
  std::string file = {}, side = {}, sha256 = {};
};

/// \throws Error  bad_input of a table without a valid value
ExploredTable explore_table(const std::string& name, Table);
/// The same as a page reads it.
Json page_json(const ExploredTable&);

}  // namespace gonio
