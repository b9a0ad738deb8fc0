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

TEST(ReportIndex, TellsFindingsClaimsAndQuestionsWithTheirPlace) {
  ReportIndex index{{}, "0.1.0", true, 1234};
  index.reports.push_back(
      {"schlick",
       "Schlick against exact Fresnel",
       1500,
       {{"One. And more.", "Two.", "3", "4", "5", "6"}, {}, {{"How wrong?", "Up to 0.22.", ""}}},
       7});
  index.reports[0].findings.judge("error below 1 %", "seed 000, Schlick", Claim::Judged::partly,
                                  "0.036 for glass.");  // told once, as a claim
  const auto j = nlohmann::json::parse(to_json(index));
  const auto& r = j["reports"][0];
  EXPECT_EQ(r["findings"], nlohmann::json({"One.", "Two.", "3", "4", "5"}));
  EXPECT_TRUE(r["more"]);
  EXPECT_EQ(r["time_ms"], 1500);
  EXPECT_EQ(j["claims"][0]["judged"], "holds in part");
  EXPECT_EQ(j["claims"][0]["report"], "schlick");
  EXPECT_EQ(j["claims"][0]["source"], "seed 000, Schlick");
  EXPECT_EQ(j["questions"][0]["answer"], "Up to 0.22.");
  EXPECT_TRUE(j["full"]);
}

}  // namespace
}  // namespace gonio
