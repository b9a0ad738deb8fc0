#include "answer/model_argument.h"

#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "foreign/function.h"
#include "table/format/in_memory.h"

#include <fmt/format.h>

namespace gonio {
namespace {

/// A parameter of a person's file that nobody gave a value, and that has no default.
void expect_values(const BoundModel& b) {
  for (const auto& p : b.model.parameters)
    if (std::isnan(b.values[p.first]))
      throw wrong_usage(
          fmt::format("{} of {} has no value: give it by --set {}=VALUE, or a default by a comment "
                      "\"// {} LOW HIGH DEFAULT\" in the file",
                      p.name, to_text(b.model.spec), p.name, p.name));
}

ModelArgument named(BoundModel b, std::vector<std::string> names) {
  expect_values(b);
  if (names.size() != b.model.channels) names = usual_channels(b.model.channels);
  return {std::move(b), std::move(names)};
}

void expect_no_settings(const std::vector<Setting>& set) {
  if (!set.empty()) throw wrong_usage("--set goes with a model, not with a fit.json");
}

}  // namespace

std::vector<std::string> file_in(const std::string& model) {
  if (foreign::is_name(model)) return {};
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
  auto argument = named(bind_fitted(name, fitted, channels), fitted.channels);
  argument.aperture_deg = fitted.aperture_deg;
  return argument;
}

}  // namespace gonio
