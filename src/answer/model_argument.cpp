#include "answer/model_argument.h"

#include <filesystem>

#include "base/error.h"
#include "table/format/in_memory.h"

namespace gonio {
namespace {

ModelArgument named(BoundModel b, std::vector<std::string> names) {
  if (names.size() != b.model.channels) names = usual_channels(b.model.channels);
  return {std::move(b), std::move(names)};
}

void expect_no_settings(const std::vector<Setting>& set) {
  if (!set.empty()) throw wrong_usage("--set goes with a model, not with a fit.json");
}

}  // namespace

std::vector<std::string> file_in(const std::string& model) {
  if (model.ends_with(".json") || std::filesystem::exists(model)) return {model};
  return {};
}

ModelArgument model_argument(const std::string& model,
                             const std::vector<Setting>& set,
                             std::optional<std::size_t> channels) {
  if (file_in(model).empty()) return named(bind_model(model, set, channels), {});
  if (!std::filesystem::exists(model))
    throw bad_input(model, "opening", "no such file", "the fit.json of a fit, or a model");
  expect_no_settings(set);
  return model_argument(model, read_fitted_model(model), {}, channels);
}

ModelArgument model_argument(const std::string& name,
                             const FittedModel& fitted,
                             const std::vector<Setting>& set,
                             std::optional<std::size_t> channels) {
  expect_no_settings(set);
  if (!channels && !fitted.channels.empty()) channels = fitted.channels.size();
  return named(bind_fitted(name, fitted, channels), fitted.channels);
}

}  // namespace gonio
