#include "brdf/model/fitted_model.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/file.h"
#include "base/json/describe.h"
#include "base/text.h"
#include "brdf/model/fit_misfit.h"
#include "brdf/model/own_files.h"
#include "brdf/model/roughness.h"

#include <fmt/format.h>

namespace gonio {
namespace {

/// Line before a fit in the XML that gonio export writes, in a comment.
constexpr std::string_view comment_begin = "<!-- gonio: the fit";

/// Line that begins a file of USD, and the key of the fit in it.
constexpr std::string_view usd_begin = "#usda", usd_key = "string gonio = ";

/// Document in a text of USD, which writes it as JSON writes a string.
std::string document_in_usd(const std::string& path, const std::string& bytes) {
  const auto begin = bytes.find(usd_key);
  if (begin == bytes.npos)
    throw bad_input(path, "USD", "no text 'gonio'", "a file of gonio export");
  const auto first = begin + usd_key.size(), last = bytes.find('\n', first);
  const JsonDocument text(path, bytes.substr(first, last - first));
  return JsonReader(path, text.root().json(), "customLayerData.gonio").string();
}

/// Document in a file: bytes of XML hold it in a comment, of USD in a text, others are it.
std::string document_in(const std::string& path, const std::string& bytes) {
  if (bytes.starts_with(usd_begin)) return document_in_usd(path, bytes);
  if (!bytes.starts_with('<')) return bytes;
  const auto begin = bytes.find(comment_begin);
  if (begin == bytes.npos)
    throw bad_input(path, "XML", "no comment 'gonio: the fit'", "a file of gonio export");
  const auto first = bytes.find('\n', begin), last = bytes.find("-->", begin);
  if (first == bytes.npos || last == bytes.npos || last < first)
    throw bad_input(path, "XML", "a comment without end", "a file of gonio export");
  return bytes.substr(first, last - first);
}

/// Fit in a document: glTF, in which gonio export keeps the fit, or itself.
JsonReader fit_in(const JsonDocument& document) {
  const JsonReader root = document.root();
  return root.has("asset") ? root.at("materials").at(0).at("extras").at("gonio") : root;
}

FittedModel fitted_model(const JsonDocument& document) {
  const JsonReader root = fit_in(document);
  constexpr const char* schema = "gonio.fit/1";
  if (root.at("schema").string() != schema) root.at("schema").fail(schema);
  FittedModel fit{root.at("model").string(), {}};
  if (root.has("channels")) {
    const JsonReader channels = root.at("channels");
    expect_array(channels, {});
    for (std::size_t k = 0; k < channels.size(); ++k)
      fit.channels.push_back(channels.at(k).string());
  }
  if (root.has("input") && root.at("input").has("aperture"))
    fit.aperture_deg = root.at("input").at("aperture").numbers();
  fit.scale_is_free = root.has("ratios");
  root.at("parameters").visit_members([&](const auto& name, const JsonReader& parameter) {
    fit.parameters.emplace_back(name, parameter.at("value").numbers());
  });
  return fit;
}

}  // namespace

bool begins_as_fit(std::string_view head) {
  return head.starts_with('{') || head.starts_with(usd_begin) ||
         head.find(comment_begin) != head.npos;
}

FittedModel read_fitted_model(const std::string& path) {
  InputFile in(path);
  return parse_fitted_model(path, in.read_rest(most_document_bytes));
}

std::string fit_document(const std::string& path, const std::string& bytes) {
  std::string text = document_in(path, bytes);
  const JsonDocument document(path, text);
  if (document.root().has("asset")) return text_of(fit_in(document).json());
  if (text.size() == bytes.size()) return text;
  // Around it in a comment stand the ends of lines.
  if (text.starts_with('\n')) text.erase(0, 1);
  if (text.ends_with('\n')) text.pop_back();
  return text;
}

FittedModel parse_fitted_model(const std::string& path, const std::string& bytes) {
  return fitted_model({path, document_in(path, bytes)});
}

std::optional<double> typical_misfit(const std::string& path, const std::string& bytes) {
  const JsonDocument document(path, document_in(path, bytes));
  const JsonReader root = fit_in(document);
  if (!root.has("residuals") || !root.at("residuals").has("log_rms")) return {};
  const auto log_rms = root.at("residuals").at("log_rms");
  if (!log_rms.is_number()) return {};
  return std::exp(log_rms.number());
}

void expect_known_scale(const std::string& path, const FittedModel& fitted) {
  if (fitted.scale_is_free)
    throw bad_input(path, "ratios", "kd and weights up to one factor (--scale free)",
                    "a fit of values in 1/sr; gonio columns FILE --scale brings them to that");
}

BoundModel bind_fitted(const std::string& path,
                       const FittedModel& fitted,
                       std::optional<std::size_t> channels) {
  const std::string model = own_files_of_fit(path, fitted.model);
  expect_known_scale(path, fitted);
  std::vector<Setting> settings;
  for (const auto& [name, values] : fitted.parameters) {
    const auto is_of = [n = name](const auto& p) { return p.first == alpha_name(n); };
    if (is_roughness(name) && std::ranges::any_of(fitted.parameters, is_of))
      continue;  // alpha says the same
    for (const double v : values)
      if (std::isnan(v))
        throw bad_input(path, "parameters." + name, "null (not identifiable)",
                        "a value; fit again with --fix " + name + "=…");
    settings.push_back({name, values});
  }
  try {
    BoundModel b = bind_model(model, settings, channels);
    for (const auto& p : b.model.parameters)
      if (std::ranges::find(b.given, p.name) == b.given.end())
        throw wrong_usage("nothing for '" + p.name + "'");
    return b;
  } catch (const Error& e) {  // the words are the file's, not the user's
    throw bad_input(
        path, "model and parameters", e.what(),
        channels ? "a model of " + counted(*channels, "channel") : "a model that can be evaluated");
  }
}

}  // namespace gonio
