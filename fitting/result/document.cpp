#include "fitting/result/document.h"

#include "base/json_describe.h"
#include "fitting/result/document_fields.h"

namespace gonio {

std::string to_json(const FitDocument& d) {
  return text_of(json_of(d));
}

std::string to_json(const Comparison& c) {
  return text_of(json_of(c));
}

std::string comparison_schema() {
  return schema_text<Comparison>("How far a model is from a table");
}

FittedModel read_fitted_model(const std::string& path) {
  const Json document = read_json(path);
  const JsonReader root(path, document);
  constexpr const char* schema = "gonio.fit/1";
  if (root.at("schema").string() != schema) root.at("schema").fail(schema);
  FittedModel fit{root.at("model").string(), {}};
  if (root.has("channels"))
    for (const auto& channel : root.at("channels").elements())
      fit.channels.push_back(channel.string());
  for (const auto& [name, parameter] : root.at("parameters").members())
    fit.parameters.emplace_back(name, parameter.at("value").numbers());
  return fit;
}

}  // namespace gonio
