#include "fitting/result/document.h"

#include <cmath>
#include <filesystem>
#include <limits>

#include "refusal.h"
#include "support.h"

namespace gonio {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

FitDocument example() {
  using enum ParameterStatus;
  FitDocument d;
  d.model = "lambert+ggx/smith_ggx.correlated/schlick";
  d.parameters = {{"alpha", {0.25}, {0.01}, {0.23}, {0.27}, {free}, {none}, {""}, {none}},
                  {"f0",
                   {0.04, none, 1},
                   {1e-3, none, none},
                   {0.03, none, none},
                   {0.05, none, none},
                   {free, not_identifiable, at_bound},
                   {none, none, none},
                   {"", "why", ""},
                   {none, none, none}}};
  d.metric = "log";
  d.residuals = {0.1, 0.2, {{"theta_i", 0, 30, 12, 0.1, 0.2}}};
  d.free_names = {"alpha", "f0.r"};
  d.correlations = {{1, 0.5}, {0.5, 1}};
  d.solver.phase_ms = {{"load", 1.5}, {"solve_ms", 2}};
  d.masked = {{"negative", 7}};
  d.sensitivity = {{"edge", {{"alpha", {0.04}}, {"f0", {0.1, 0.2, 0.3}}}, 0.5}};
  return d;
}

std::string without_space(std::string s) {
  std::erase_if(s, [](char c) { return c == ' ' || c == '\n'; });
  return s;
}

TEST(FitDocument, FollowsTheContract) {
  const auto text = without_space(to_json(example()));
  EXPECT_HAS(text,
             R"({"schema":"gonio.fit/1","model":"lambert+ggx/smith_ggx.correlated/schlick",)");
  EXPECT_HAS(
      text,
      R"("alpha":{"value":0.25,"std_error":0.01,"ci95":[0.23,0.27],"status":"free","limit":null,"excluded":null,"reason":""})");
  EXPECT_HAS(text, R"("f0":{"value":[0.04,null,1.0],"std_error":[0.001,null,null],)");
  EXPECT_HAS(text, R"("ci95":[[0.03,0.05],[null,null],[null,null]],)");
  EXPECT_HAS(text, R"("status":["free","not_identifiable","at_bound"])");
  EXPECT_HAS(text, R"("bands":[{"angle":"theta_i","from_deg":0.0,"to_deg":30.0,"values":12,)");
  EXPECT_HAS(text, R"("names":["alpha","f0.r"],"correlations":[[1.0,0.5],[0.5,1.0]])");
  EXPECT_HAS(text, R"("time_ms":{"load_ms":1.5,"solve_ms":2.0})");
  EXPECT_HAS(text, R"("values_used":0,"masked":{"negative":7})");
  EXPECT_HAS(text, R"("relative_change":{"alpha":0.04,"f0":[0.1,0.2,0.3]})");
}

TEST(FitDocument, NamesTheChannelsAfterTheModel) {
  auto d = example();
  d.channels = {"r", "g", "b"};
  EXPECT_HAS(without_space(to_json(d)), R"(schlick","channels":["r","g","b"],)");
}

TEST(Comparison, WritesItsPartsAsTheFitDocumentDoes) {
  const Comparison c{
      "t.csv", {"lambert", {{"alpha", {0.25}}, {"kd", {0.1, none}}}}, example().residuals};
  const auto text = without_space(to_json(c));
  EXPECT_HAS(text,
             R"({"path":"t.csv","model":"lambert","parameters":{"alpha":0.25,"kd":[0.1,null]},)");
  const auto fit = without_space(to_json(example()));
  const auto from = fit.find(R"("residuals":)");
  EXPECT_HAS(text, fit.substr(from, fit.find(R"(,"identifiability")") - from) + "}");
}

TEST(Comparison, OfAPathThatIsNotUtf8IsStillJson) {
  EXPECT_HAS(to_json(Comparison{"a\xff", {}, {}}), "\"path\": \"a\xef\xbf\xbd\"");
}

TEST(FitDocument, ReadsBackItsModel) {
  const test::Folder folder;
  const auto fit = read_fitted_model(folder.write("fit.json", to_json(example())));
  EXPECT_EQ(fit.model, example().model);
  ASSERT_EQ(fit.parameters.size(), 2U);
  EXPECT_EQ(fit.parameters[0].first, "alpha");
  EXPECT_EQ(fit.parameters[0].second, std::vector{0.25});
  ASSERT_EQ(fit.parameters[1].second.size(), 3U);
  EXPECT_TRUE(std::isnan(fit.parameters[1].second[1]));
}

}  // namespace
}  // namespace gonio
