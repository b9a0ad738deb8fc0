#pragma once
/// \file
/// A model as a user names it: a spec with its settings, or the fit.json of a fit.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "brdf/model/fitted_model.h"
#include "brdf/model/model.h"

namespace gonio {

/// The file that the user named, for check_outputs: what is there, or what is called like a document;
/// none where it is a spec.
std::vector<std::string> file_in(const std::string& model);

struct ModelArgument {
  BoundModel model;
  std::vector<std::string> channels;      ///< the fit's names; else "r", "g", "b", or "f" of one
  std::vector<double> aperture_deg = {};  ///< of the fit's table: light, detector; or empty
};
/// The model named.  \param channels  as many as the model must have; else as many as its colours, or three
/// \throws Error  bad_input of a fit.json that is none, holds null values, or does not have these
///                channels; wrong_usage of settings beside one
ModelArgument model_argument(const std::string& model,
                             const std::vector<Setting>& set,
                             std::optional<std::size_t> channels = {});
/// The model of a fit's document, which errors call `name`.
ModelArgument model_argument(const std::string& name,
                             const FittedModel& fitted,
                             const std::vector<Setting>& set,
                             std::optional<std::size_t> channels = {});

}  // namespace gonio
