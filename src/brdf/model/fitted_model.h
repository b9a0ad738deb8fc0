#pragma once
/// \file
/// Model that a fit's document holds, gonio.fit/1.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "brdf/model/model.h"

namespace gonio {

/// Part of a fit.json that says what was fitted: the model and its parameters' values; NaN where null.
struct FittedModel {
  std::string model;
  std::vector<std::pair<std::string, std::vector<double>>> parameters;
  std::vector<std::string> channels = {};  ///< empty where the file does not name them
  std::vector<double> aperture_deg = {};   ///< cones that the table was averaged over; or empty
  bool scale_is_free = false;              ///< kd and weights are known up to one factor
};
/// Whether bytes begin as the document of a fit or as a file that gonio export put one in.
/// \param head  first 256 bytes of a file, or all
bool begins_as_fit(std::string_view head);
FittedModel read_fitted_model(const std::string& path);
/// A fit's own document in bytes that begins_as_fit(): what gonio export put into another file, or all.
/// \param path  named in errors
std::string fit_document(const std::string& path, const std::string& bytes);
/// Model in a document's bytes.  \param path  named in errors
FittedModel parse_fitted_model(const std::string& path, const std::string& bytes);

/// Refuses a fit whose values are known up to one factor, where they themselves are asked for.
void expect_known_scale(const std::string& path, const FittedModel&);
/// Model with its values; a parameter without one is bad input of that file.
/// \param channels  of the model; else as many as its colours have
BoundModel bind_fitted(const std::string& path,
                       const FittedModel& fitted,
                       std::optional<std::size_t> channels);

}  // namespace gonio
