#pragma once
/// \file
/// One term or map by its id, as `gonio term` and `gonio.term` give it, and the document of the answer.

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "brdf/in_number/number.h"
#include "number/parameter.h"

namespace gonio {

struct TermQuestion {
  std::string id;
  std::string number = "double";
  std::map<std::string, double> parameters;  ///< `roughness` in place of an alpha, too
  std::map<std::string, std::vector<double>>
      at;  ///< a column for each cosine; of a map each parameter
};

struct TermAnswer {
  const About* about;
  std::vector<std::pair<std::string, double>> parameters;  ///< all of them, defaults included
  std::span<const std::string_view> outputs;  ///< names of a map's values; of a term none
  std::vector<std::vector<double>> values;    ///< [row][output]
};

/// \throws Error  wrong_usage of an id, a parameter or an angle that is not there, or that the term does not read
TermAnswer answer(const TermQuestion&);

/// {"id", "number", "parameters", "at", "values"}, of a map with "outputs"
std::string to_json(const TermAnswer&, const TermQuestion&);

/// Entries of the catalogue that are neither term nor map nor composed of terms, and what evaluates them.
struct Evaluated {
  const About* about;
  std::string_view by;
};
std::span<const Evaluated> evaluated_by_commands();

}  // namespace gonio
