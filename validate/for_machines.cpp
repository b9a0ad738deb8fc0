// The validation as continuous integration reads it: JUnit's XML and SARIF.
#include <algorithm>

#include "base/json/describe.h"
#include "base/text.h"
#include "validate/validate.h"
#include "validate/words.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gonio {

std::string junit_of(const Validation& v) {
  const auto broken = std::ranges::count(v.budgets, false, &BudgetCheck::holds);
  std::string out = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<testsuites>\n"
      "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\">\n",
      markup_text(v.path), v.budgets.size(), broken);
  for (const auto& b : v.budgets) {
    out += fmt::format("    <testcase classname=\"gonio validate\" name=\"{}\"", b.budget);
    out += b.holds ? "/>\n"
                   : fmt::format(">\n      <failure message=\"{}\"/>\n    </testcase>\n",
                                 markup_text(sentence(b)));
  }
  return out + "  </testsuite>\n</testsuites>\n";
}

std::string sarif_of(const Validation& v) {
  Json rules = Json::array(), results = Json::array();
  for (const auto& b : v.budgets) {
    rules.push_back(
        {{"id", b.budget}, {"shortDescription", {{"text", std::string(title_of(b.budget))}}}});
    if (b.holds) continue;
    results.push_back(
        {{"ruleId", b.budget},
         {"level", "error"},
         {"message", {{"text", sentence(b)}}},
         {"locations",
          Json::array({{{"physicalLocation",
                         {{"artifactLocation", {{"uri", uri_of(v.path)}}},
                          {"region", {{"startLine", 1}}}}},  // GitHub shows nothing without a line
                        {"logicalLocations",
                         Json::array({{{"fullyQualifiedName", "/budgets/" + b.budget}}})}}})}});
  }
  const Json document = {
      {"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
      {"version", "2.1.0"},
      {"runs",
       Json::array({{{"tool", {{"driver", {{"name", "gonio"}, {"rules", rules}}}}},
                     // Several choices of one commit: a run each, which takes no other's place.
                     {"automationDetails", {{"id", "gonio/" + uri_of(v.path) + "/"}}},
                     {"results", results}}})}};
  return text_of(document);
}

}  // namespace gonio
