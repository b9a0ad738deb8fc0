#include "cli/model_argument.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "brdf/model/roughness.h"
#include "fitting/result/document.h"

#include <fmt/format.h>

namespace gonio::cli {
namespace {

std::vector<std::string> plain_names(std::size_t channels) {
  if (channels == 1) return {"f"};
  if (channels == 3) return {"r", "g", "b"};
  std::vector<std::string> names;
  for (std::size_t c = 0; c < channels; ++c) names.push_back(std::to_string(c));
  return names;
}

BoundModel bound(const std::string& path,
                 const FittedModel& fitted,
                 std::optional<std::size_t> channels) {
  std::vector<Setting> settings;
  for (const auto& [name, values] : fitted.parameters) {
    if (is_roughness(name)) continue;  // alpha says the same
    for (const double v : values)
      if (std::isnan(v))
        throw bad_input(path, "parameters." + name, "null (not identifiable)",
                        "a value; fit again with --fix " + name + "=…");
    settings.push_back({name, values});
  }
  try {
    BoundModel b = bind_model(fitted.model, settings, channels);
    for (const auto& p : b.model.parameters)
      if (std::ranges::find(b.given, p.name) == b.given.end())
        throw wrong_usage("nothing for '" + p.name + "'");
    return b;
  } catch (const Error& e) {  // the words are the file's, not the user's
    throw bad_input(
        path, "model and parameters", e.what(),
        channels ? fmt::format("a model of {} channel{}", *channels, *channels == 1 ? "" : "s")
                 : "a model that can be evaluated");
  }
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
  return named(bound(model, fitted, channels), fitted.channels);
}

}  // namespace gonio::cli
