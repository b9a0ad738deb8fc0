#pragma once
/// \file
/// The page of `gonio explore`: models and tables side by side, drawn by the catalogue's own code as WebAssembly.

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "answer/model_argument.h"
#include "table/cut/cuts.h"
#include "table/health/health.h"
#include "table/table.h"

namespace gonio {

/// A page shows so many models and tables at most.
inline constexpr std::size_t most_explored = 8;

/// Models are compared with so many samples of a table at most.
inline constexpr std::size_t most_explored_samples = 8192;

struct ExploredModel {
  std::string name;  ///< what the user called it
  ModelArgument model;
  /// 95 % intervals of a fit's parameters, low and high by channel; NaN where there is none.
  std::vector<std::pair<std::string, std::vector<std::array<double, 2>>>> intervals;
  /// Values that the fit could not determine ("kd.b"): they begin where the other channels are, or where a fit begins.
  std::vector<std::string> undetermined = {};
};

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
};

using Explored = std::variant<ExploredModel, ExploredTable>;

/// The model of a fit.json with its intervals, or of a spec without.
/// \param channels  of a spec's model, where that is to be compared with tables that have so many
ExploredModel explore_model(const std::string& name,
                            const std::vector<Setting>& set,
                            std::optional<std::size_t> channels = {});
/// \throws Error  bad_input of a table without a valid value
ExploredTable explore_table(const std::string& name, Table);

/// The page; without anything given it begins with a default model.
std::string explore_page_html(const std::vector<Explored>&);

}  // namespace gonio
