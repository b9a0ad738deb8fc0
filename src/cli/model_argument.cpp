#include "cli/model_argument.h"

#include <filesystem>

#include "base/error.h"
#include "brdf/model/fitted_model.h"

namespace gonio::cli {
namespace {

std::vector<std::string> plain_names(std::size_t channels) {
  if (channels == 1) return {"f"};
  if (channels == 3) return {"r", "g", "b"};
  std::vector<std::string> names;
  for (std::size_t c = 0; c < channels; ++c) names.push_back(std::to_string(c));
  return names;
}

}  // namespace

std::vector<std::string> file_in(const std::string& model) {
  if (model.ends_with(".json") || std::filesystem::exists(model)) return {model};
  return {};
}

ModelArgument model_argument(const std::string& model,
                             const std::vector<std::string>& set,
                             std::optional<std::size_t> channels) {
  const auto named = [](BoundModel b, std::vector<std::string> names) {
    if (names.size() != b.model.channels) names = plain_names(b.model.channels);
    return ModelArgument{std::move(b), std::move(names)};
  };
  if (file_in(model).empty()) return named(bind_model(model, parse_settings(set), channels), {});
  if (!std::filesystem::exists(model))
    throw bad_input(model, "opening", "no such file", "the fit.json of a fit, or a model");
  if (!set.empty()) throw wrong_usage("--set goes with a model, not with a fit.json");
  const auto fitted = read_fitted_model(model);
  if (!channels && !fitted.channels.empty()) channels = fitted.channels.size();
  return named(bind_fitted(model, fitted, channels), fitted.channels);
}

}  // namespace gonio::cli
