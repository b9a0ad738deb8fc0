#include "reports/stability/stability.h"

#include <algorithm>
#include <cmath>

#include "many_fits.h"
#include "reports/pictures.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

/// GGX alone: the rows that answer the question which alpha is safe.
const StabilityReport& report() {
  static const auto made = stability_report({StabilityOptions::Setting::brief, {"ndf.ggx"}});
  return made;
}
const StabilityRow& row(std::string_view form, std::string_view number) {
  return *std::ranges::find_if(report().rows.rows, [&](const StabilityRow& r) {
    return r.form == form && r.number == number;
  });
}

TEST(StabilityReport, SaysFromWhichAlphaOnGgxIsSafeInHalf) {
  GONIO_MANY_FITS();
  const auto& r = row("cross", "half");
  EXPECT_EQ(r.evidence, stability::Evidence::exhaustive);
  EXPECT_EQ(r.decides, "alpha");
  ASSERT_TRUE(r.safe_from);
  EXPECT_GT(*r.safe_from, 0.0022);  // below, the peak 1/(π α²) is more than a half holds
  EXPECT_LT(*r.safe_from, 0.05);
  EXPECT_GT(r.nonfinite + r.overflow, 0U);
  EXPECT_NE(r.inputs_hex.find("0x"), std::string::npos);
  const auto& questions = report().findings.questions;
  ASSERT_EQ(questions.size(), 1U);
  EXPECT_NE(questions[0].answer.find("alpha"), std::string::npos);
}

TEST(StabilityReport, OfFloatHasAProofFromSomeAlphaOn) {
  GONIO_MANY_FITS();
  const auto& r = row("cross", "float");
  ASSERT_TRUE(r.finite_from);
  EXPECT_LE(*r.finite_from, 1e-4);
  EXPECT_EQ(r.nonfinite, 0U);
}

TEST(StabilityReport, LooksAtFormsOfNoOperations) {
  GONIO_MANY_FITS();
  const auto r = stability_rows({StabilityOptions::Setting::brief, {"fresnel.constant"}});
  ASSERT_FALSE(r.rows.empty());
  EXPECT_EQ(r.rows[0].operations, 0U);
  EXPECT_EQ(r.rows[0].worst_rel, 0);
}

TEST(StabilityReport, OfAClampSaysWhatItSavesAndCosts) {
  const auto rows = clamp_rows();
  const auto find = [&](std::string_view clamp, std::string_view number) {
    return *std::ranges::find_if(
        rows, [&](const ClampRow& r) { return r.clamp == clamp && r.number == number; });
  };
  const auto half = find("min(D, 2048)", "half");
  EXPECT_TRUE(half.no_value_without);
  EXPECT_FALSE(half.no_value_with);
  // π D of the peak is 1/α²: 2048 for α = 0.0221.
  ASSERT_TRUE(half.changed_to);
  EXPECT_NEAR(*half.changed_to, 1 / std::sqrt(2048.0), 0.004);
  const auto vis = find("max(denominator, 0.001)", "float");
  EXPECT_FALSE(vis.no_value_without);  // in float it saves nothing
  EXPECT_NEAR(vis.changed_most, 1, 0.01);
}

TEST(StabilityReport, PicturesAreWhole) {
  GONIO_MANY_FITS();
  test::expect_whole(report().pictures);
  EXPECT_FALSE(report().pictures.maps.empty());
}

TEST(StabilityReport, ErrorsByAlphaBreakWhereAnInputHasNoValue) {
  GONIO_MANY_FITS();
  const auto curves = errors_by_alpha(false);
  const auto ggx = std::ranges::find_if(curves, [](const auto& c) {
    return c.id == "ndf.ggx" && c.form == "cross" && c.number == "half";
  });
  ASSERT_NE(ggx, curves.end());
  EXPECT_TRUE(std::isnan(ggx->worst.front()) || ggx->worst.front() > 0.1);
  EXPECT_LT(ggx->worst.back(), 0.01);
}

TEST(StabilityReport, TellsEachRowAsAFlatObject) {
  GONIO_MANY_FITS();
  const auto j = nlohmann::json::parse(to_json(report()));
  EXPECT_EQ(j["schema"], "gonio.report.stability/1");
  ASSERT_FALSE(j["rows"].empty());
  for (const auto& r : j["rows"])
    for (const auto* key :
         {"id", "form", "number", "evidence", "worst_ulp", "worst_rel", "proved_rel", "condition",
          "inputs_hex", "nonfinite", "safe_from", "evaluations"})
      EXPECT_TRUE(r.contains(key)) << key;
  const auto lines = rows_csv(report());
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(lines, '\n')), j["rows"].size() + 1);
}

}  // namespace
}  // namespace gonio
