#pragma once
/// \file
/// The page of `gonio explore`: models and tables side by side, drawn by the catalogue's own code as WebAssembly.

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "answer/model_argument.h"
#include "explore/explored_table.h"

namespace gonio {

/// A page shows so many models and tables at most.
inline constexpr std::size_t most_explored = 8;

struct ExploredModel {
  std::string name;  ///< what the user called it
  ModelArgument model;
  std::string document = {};  ///< of a fit, for what it says of its values; "" of a long one
};

using Explored = std::variant<ExploredModel, ExploredTable>;

/// The model of a fit.json with its intervals, or of a spec without.
/// \param channels  of a spec's model, where that is to be compared with tables that have so many
ExploredModel explore_model(const std::string& name,
                            const std::vector<Setting>& set,
                            std::optional<std::size_t> channels = {});
/// The table of a file, with the file.
/// \throws Error  bad_input of a table without a valid value
ExploredTable explore_file(const std::string& path, std::optional<Bins> bins = {});

/// The page; without anything given it begins with a default model.
/// \param reads  whether it reads and fits tables itself, as one with tables always does
std::string explore_page_html(const std::vector<Explored>&, bool reads = false);

}  // namespace gonio
