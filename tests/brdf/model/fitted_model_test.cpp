#include "brdf/model/fitted_model.h"

#include <filesystem>

#include "refusal.h"
#include "support.h"

namespace gonio {
namespace {

TEST(FittedModel, SaysWhereItsDocumentIsWrong) {
  const test::Folder folder;
  const auto complaint = [&](const std::string& text) {
    return test::refusal([&] { read_fitted_model(folder.write("fit.json", text)); });
  };
  EXPECT_HAS(complaint("{\n  \"schema\": ?"), "line 2, column 13");
  EXPECT_HAS(complaint("[]"), "the document: found an empty array, expected an object");
  EXPECT_HAS(complaint("{}"), "schema: found nothing");
  EXPECT_HAS(complaint(R"({"schema":"gonio.fit/2"})"), R"(schema: found "gonio.fit/2")");
  EXPECT_HAS(complaint(R"({"schema":"gonio.fit/1","model":3})"), "model: found 3");
  const std::string head = R"({"schema":"gonio.fit/1","model":"m","parameters":)";
  EXPECT_HAS(complaint(head + "[1]}"), "parameters: found an array, expected an object");
  EXPECT_HAS(complaint(head + R"({"a":{}}})"), "parameters.a.value: found nothing");
  EXPECT_HAS(complaint(head + R"({"a":{"value":[]}}})"),
             "parameters.a.value: found an empty array");
  EXPECT_HAS(complaint(head + R"({"a":{"value":[1,"x"]}}})"),
             R"(parameters.a.value[1]: found "x")");
  EXPECT_HAS(complaint(head + R"({"a":{"value":1e999}}})"), "found 1e999");
  std::filesystem::resize_file(folder / "fit.json", (1U << 26) + 1);
  EXPECT_HAS(test::refusal([&] { read_fitted_model(folder / "fit.json"); }), "at most 67108864");
}

TEST(FittedModel, HasTheValuesOfEachParameterThatIsNoSecondNameOfAnother) {
  const auto fit = parse_fitted_model(
      "fit.json", R"({"schema": "gonio.fit/1", "model": "lambert+ggx/smith_ggx.correlated/schlick",
    "parameters": {"alpha": {"value": 0.25}, "roughness": {"value": 0.5}, "f0": {"value": [0.9, 0.6, 0.5]}, "kd": {"value": 0}}})");
  const BoundModel b = bind_fitted("fit.json", fit, {});
  EXPECT_EQ(b.model.channels, 3U);
  EXPECT_EQ(b.values[b.model.find("alpha")->first], 0.25);
  EXPECT_EQ(b.values[b.model.find("f0")->slot(1)], 0.6);
}

TEST(FittedModel, OfAFreeScaleIsRefused) {
  const std::string path = "fit.json";
  const auto fit = parse_fitted_model(
      path,
      R"({"schema": "gonio.fit/1", "model": "lambert", "parameters": {"kd": {"value": [null, null, null]}}, "ratios": []})");
  EXPECT_HAS(test::refusal([&] { bind_fitted(path, fit, {}); }), "--scale free");
}

TEST(FittedModel, RefusesWhatCannotBeEvaluated) {
  const auto complaint = [](const std::string& parameters,
                            std::optional<std::size_t> channels = {}) {
    return test::refusal([&] {
      bind_fitted("fit.json",
                  parse_fitted_model("fit.json",
                                     R"({"schema":"gonio.fit/1","model":"lambert","parameters":{)" +
                                         parameters + "}}"),
                  channels);
    });
  };
  EXPECT_EQ(complaint(R"("kd":{"value":null})"),
            "fit.json: parameters.kd: found null (not identifiable), expected a value; fit again "
            "with --fix kd=…");
  EXPECT_HAS(
      complaint(""),
      "model and parameters: found nothing for 'kd', expected a model that can be evaluated");
  EXPECT_HAS(complaint(R"("kd":{"value":[0.1,0.2]})", 3), "expected a model of 3 channels");
}

}  // namespace
}  // namespace gonio
