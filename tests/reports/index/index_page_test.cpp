#include "reports/index/index_page.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

TEST(FirstSentence, EndsBeforeAnother) {
  EXPECT_EQ(first_sentence("F is off by 0.036 (at 85.5°). Within 0.01 to 47°."),
            "F is off by 0.036 (at 85.5°).");
  EXPECT_EQ(first_sentence("“below 1 %” is wrong. “Good” too."), "“below 1 %” is wrong.");
  EXPECT_EQ(first_sentence("approx. half of it."), "approx. half of it.");
  EXPECT_EQ(first_sentence(""), "");
}

ReportFiles made_files() {
  ReportFiles r;
  r.findings = {{"One. And more.", "Two."}, {}, {}};
  r.findings.judge("error below 1 %", "Schlick 1994", Claim::Judged::partly, "0.036 of light",
                   "0.036 for glass.");
  r.facts.setting = Facts::Setting{"a processor", 2, "avx2", {}, 0.5};
  r.facts.fresnel = {{"fresnel.schlick", "metal", "gold", 0.9, 0.1},
                     {"fresnel.gulbrandsen", "metal", "gold", 0, 0}};
  r.facts.precision = {{"ndf.ggx", "cross", "half, flushed", 0.02, 0.004},
                       {"ggx/smith_ggx.correlated/schlick", "directions", "half", 0.02, 0.04, 88}};
  r.facts.masking = {{"masking.schlick_ggx.direct", 0.28},
                     {"masking.cook_torrance", 0.4},
                     {"masking.ue_joint", 0.4 * (1 + 1e-6)},
                     {"masking.smith_ggx.correlated", 0}};
  for (const auto& [id, ns] : {std::pair("masking.schlick_ggx.direct", 0.3),
                               {"masking.cook_torrance", 0.5},
                               {"masking.ue_joint", 0.45},
                               {"masking.smith_ggx.correlated", 0.6}})
    r.facts.in_cache.push_back({id, ns, 0.01});
  const FigureCurve points{"GGX", {1, 2}, {0.1, 0.2}, FigureCurve::Kind::points};
  r.pictures.figures = {{"first", "First", "", {"x"}, {"y"}, {points}},
                        {"second", "Second", "", {"x"}, {"y"}, {points}}};
  return r;
}

TEST(ReportIndex, TellsDecisionsOneSentenceAReportAndClaimsWithTheirFigure) {
  ReportIndex index{{}, "0.1.0", true, 1234, {}, {}};
  add_report(index, "schlick", "Schlick against exact Fresnel", 1500, made_files());
  const auto j = nlohmann::json::parse(to_json(index));
  EXPECT_EQ(j["decisions"][0]["take_id"], "masking.smith_ggx.correlated");
  for (const char* key : {"for", "take", "take_id", "error", "cost", "unless"})
    EXPECT_TRUE(j["decisions"][0].contains(key)) << key;
  const auto& r = j["reports"][0];
  EXPECT_EQ(r["sentence"], "One.");
  EXPECT_EQ(r["picture"]["id"], "first");
  EXPECT_EQ(r["pictures"], 2);
  EXPECT_EQ(r["time_ms"], 1500);
  EXPECT_EQ(j["claims"][0]["judged"], "holds in part");
  EXPECT_EQ(j["claims"][0]["figure"], "0.036 of light");
  const auto& curves = j["front"][0]["curves"];
  ASSERT_EQ(curves.size(), 2U);
  EXPECT_EQ(curves[0]["y"], (std::vector<double>{0.28, 0.4, 0}))
      << "the errors of the table, each formula once";
  EXPECT_EQ(curves[0]["labels"][1], "Cook–Torrance");
  EXPECT_EQ(curves[1]["y"], (std::vector<double>{0.28, 0})) << "Cook–Torrance is beaten in both";
  EXPECT_EQ(j["front"][0]["y"]["label"], "RMS error of G₂");
  ASSERT_EQ(j["fresnel"].size(), 2U) << "a decision may name any of them";
  EXPECT_EQ(j["fresnel"][0]["form"], "Schlick");
  EXPECT_EQ(j["machine"]["isa"], "avx2");
  EXPECT_EQ(j["machine"]["model_ns"], 0.5);
  const auto page = index_page_html(index);
  EXPECT_NE(page.find("<a href=\"schlick/first.svg\">"), page.npos);
  EXPECT_EQ(page.find("href=\"schlick/\""), page.npos) << "a bare folder";
  index.reports[0].findings.headline = "Better said.";
  EXPECT_EQ(nlohmann::json::parse(to_json(index))["reports"][0]["sentence"], "Better said.");
}

}  // namespace
}  // namespace gonio
