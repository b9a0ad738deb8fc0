#include "reports/stability/stability.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "many_fits.h"
#include "reports/pictures.h"
#include "reports/plain.h"
#include "reports/stability/measure.h"

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
  EXPECT_NE(report().findings.sentences[0].find("alpha"), std::string::npos);
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
  EXPECT_NEAR(*half.changed_to, 1 / std::sqrt(2048.0 * 1.01), 2e-5);
  const auto vis = find("max(denominator, 0.001)", "float");
  EXPECT_FALSE(vis.no_value_without);  // in float it saves nothing
  EXPECT_NEAR(vis.changed_most, 1, 0.01);
}

TEST(StabilityReport, OfAClampInACosineCountsTheSmallerOfBoth) {
  const auto rows = clamp_rows();
  const auto joint = *std::ranges::find_if(
      rows, [](const ClampRow& r) { return r.clamp == "NoV + 1e-5" && r.number == "float"; });
  EXPECT_EQ(joint.by, "cosine");
  // V is changed by 1 % where 1e-5 is 1 % of NoV, and of the sum that NoV is part of: about 1e-3.
  ASSERT_TRUE(joint.changed_to);
  EXPECT_GT(*joint.changed_to, 2e-4);
  EXPECT_LT(*joint.changed_to, 2e-3);
}

/// A row that misses nothing.
StabilityRow made_row(std::string id, std::string form, std::string number) {
  StabilityRow r{};
  r.id = std::move(id);
  r.form = std::move(form);
  r.number = std::move(number);
  r.decides = "alpha";
  r.tolerance = 0.02;
  r.safe_from = 0.004;
  return r;
}
TEST(StabilityReport, NamesABetterFormOnlyWhereItIsSafeFromASmallerAlpha) {
  std::vector<StabilityRow> rows{made_row("ndf.ggx", "cosine", "half"),
                                 made_row("ndf.ggx", "cross", "half"),
                                 made_row("ndf.ggx.mobile", "cosine", "half")};
  rows[0].safe_from = 0.2, rows[1].safe_from = 0.004, rows[2].safe_from = 1e-6;
  rows[2].stable = "ndf.ggx";
  EXPECT_EQ(better_form(rows, rows[0]), &rows[1]);
  EXPECT_EQ(better_form(rows, rows[1]), nullptr) << "not itself";
  EXPECT_EQ(better_form(rows, rows[2]), nullptr) << "which is safe from a smaller alpha";
  rows[2].safe_from.reset();
  EXPECT_EQ(better_form(rows, rows[2]), &rows[1]);
  rows[1].safe_from.reset();
  EXPECT_EQ(better_form(rows, rows[0]), nullptr) << "which is nowhere safe";
}

bool says(const Findings& f, const std::string& sentence) {
  return std::ranges::find(f.sentences, sentence) != f.sentences.end();
}

TEST(StabilityFindings, SayFromWhichAlphaOnAndThatOthersNeverDo) {
  StabilityRows r;
  r.rows = {made_row("ndf.ggx", "cross", "half"), made_row("ndf.ggx.mobile", "cosine", "mixed"),
            made_row("ndf.beckmann", "cross", "half"), made_row("ndf.gtr", "cross", "half")};
  r.rows[0].safe_from = 0.00391006;
  r.rows[1].safe_from = 0.2177;
  r.rows[1].evidence = stability::Evidence::searched;
  r.rows[2].safe_from = 1;
  r.rows[2].worst_rel = 0.099;
  r.rows[2].worst_from_usual = 0.036;
  r.rows[3].safe_from.reset();
  r.rows[3].worst_rel = 3862;
  r.rows[3].nonfinite = 2;
  r.rows[2].finite_from = 0.01;
  const auto f = findings(r);
  EXPECT_EQ(f.sentences[0],
            "In half precision, D of GGX is off by at most 2\u00a0% for alpha 0.004 or more, if "
            "the shader "
            "computes |n × h|².")
      << "0.0039 would be below the limit";
  EXPECT_EQ(f.sentences[1], "A clamp there changes only surfaces of a roughness below 0.063.");
  EXPECT_EQ(
      f.sentences[2],
      "With NoH rounded to half in the place of |n × h|², and the rest in float, D stays within it "
      "from alpha 0.22 on, as far as a search found.");
  EXPECT_TRUE(says(f,
                   "Beckmann from |n × h|² in half does not stay within 2\u00a0%: even from alpha "
                   "0.05 on there are "
                   "errors up to 3.6\u00a0%."));
  EXPECT_TRUE(says(
      f,
      "GTR of all gammas from |n × h|² in half does not stay within 2\u00a0%: somewhere there are "
      "values up to 3900 times too large."));
  EXPECT_TRUE(says(
      f,
      "In half, 1 of 3 ways to compute 3 formulas give no value, or infinity, for some inputs. "
      "From some alpha, F0 or index on, a value is proved for every input of 1."));
  test::expect_plain(f);
}

TEST(StabilityFindings, SayWhichMobileFormsMayBeClampedAnywhere) {
  StabilityRows r;
  r.rows = {made_row("ndf.ggx", "cross", "half"), made_row("ndf.ggx.mobile.cross", "cross", "half"),
            made_row("ndf.ggx.mobile", "cosine", "half"), made_row("ndf.gtr", "cross", "half")};
  r.rows[1].safe_from = 1e-6;
  r.rows[2].safe_from = 0.19;
  r.rows[3].safe_from = 0.96;
  r.rows[3].worst_rel = 1e9;
  const auto f = findings(r);
  EXPECT_TRUE(says(
      f, "The mobile form with a cross product in half stays within 2\u00a0% for every alpha."));
  EXPECT_TRUE(says(f,
                   "The mobile form from NoH in half stays within 2\u00a0% from alpha 0.19 on, of "
                   "a NoH that half "
                   "holds."));
  EXPECT_TRUE(says(f,
                   "GTR of all gammas from |n × h|² in half does not stay within 2\u00a0%: "
                   "somewhere there are values more "
                   "than a million times too large."));
  test::expect_plain(f);
}

TEST(StabilityFindings, CanBeReadAloud) {
  GONIO_MANY_FITS();
  test::expect_plain(report().findings);
  StabilityRows r;
  r.clamps = clamp_rows();
  for (const char* form : {"cross", "cosine"}) {
    AnyGpuRow row{};
    row.id = "ndf.ggx", row.form = form, row.number = "half";
    row.proved_rel = 0.0123;
    r.any_gpu.push_back(row);
  }
  const auto said = findings(r);
  test::expect_plain(said);
  EXPECT_GT(said.sentences.size(), 4U);
}

TEST(StabilityReport, OfADistributionThatMissesTellsTheWorstFromTheUsualWidthOn) {
  GONIO_MANY_FITS();
  const auto r = stability_rows({StabilityOptions::Setting::brief, {"ndf.beckmann"}}).rows.at(0);
  EXPECT_TRUE(r.misses);
  ASSERT_TRUE(r.worst_from_usual);
  EXPECT_LT(*r.worst_from_usual, 0.05);
  EXPECT_GT(*r.worst_from_usual, 0.02);
  EXPECT_GT(r.worst_rel, *r.worst_from_usual) << "narrower widths are worse";
  EXPECT_FALSE(row("cross", "half").worst_from_usual);
}

TEST(StabilityFindings, SayWhatClampsSaveAndCostInHalfAlone) {
  StabilityRows r;
  r.clamps = {{"min(D, 2048)", "ndf.ggx.mobile", "alpha", "half", 0.0022, {}, 0, 0, 0.022, 1},
              {"min(D, 2048)", "ndf.ggx.mobile", "alpha", "float", {}, {}, 0, 0, 0.022, 1}};
  const auto f = findings(r);
  ASSERT_EQ(f.sentences.size(), 1U);
  EXPECT_EQ(
      f.sentences[0],
      "min(D, 2048) in half, in GGX Mobile: without it values are missing up to alpha 0.0022, with "
      "it nowhere. It changes values by more than 1\u00a0% up to alpha 0.022.");
}

TEST(StabilityFindings, SayWhatIsProvedOnAnyGpu) {
  using stability::Evidence;
  StabilityRows r;
  r.any_gpu = {{"ndf.ggx", "cross", "float", "", Evidence::proved, 5.9e-6, true, true, ""},
               {"ndf.ggx", "cosine", "float", "", Evidence::proved, 0.26, false, true, "larger"},
               {"ndf.ggx", "cross", "half", "", Evidence::proved, 0.049, false, true, "larger"},
               {"ndf.ggx", "cosine", "half", "", Evidence::open, {}, false, true, "open"}};
  auto f = findings(r);
  EXPECT_TRUE(
      says(f,
           "On any GPU 1\u00a0% in float is proved for 1 of 2 forms. GGX from |n × h|² errs by "
           "0.00059\u00a0% at most; only from NoH, 26\u00a0% is all that is proved."));
  EXPECT_TRUE(
      says(f,
           "On any GPU 1\u00a0% in half is proved for none of 2 forms. GGX from |n × h|² errs by "
           "4.9\u00a0% at most; only from NoH, nothing is proved."));
  r.any_gpu[0].why = "Gappa is not installed";
  f = findings(r);
  ASSERT_EQ(f.sentences.size(), 1U);
  EXPECT_NE(f.sentences[0].find("Gappa is not installed"), std::string::npos);
}

TEST(StabilityReport, OnAnyGpuHasABoundOrAReasonForEveryForm) {
  GONIO_MANY_FITS();
  const auto rows = any_gpu_rows({StabilityOptions::Setting::brief, {"ndf.ggx", "ndf.gtr"}});
  ASSERT_EQ(rows.size(), 2U) << "brief looks at few";
  for (const auto& r : rows) {
    EXPECT_TRUE(r.finite) << r.form;
    EXPECT_EQ(r.keeps, r.why.empty()) << r.form;
    EXPECT_EQ(r.number, "float");
    EXPECT_NE(r.domain.find("alpha 0.001 to 1"), std::string::npos) << r.domain;
    if (r.why == "Gappa is not installed" || r.why == "Gappa was out of time") continue;
    EXPECT_EQ(r.keeps, r.form == "cross");
    EXPECT_EQ(r.proved_rel.value_or(1) < 1e-5, r.form == "cross");
    EXPECT_GT(r.proved_rel.value_or(1), 3e-6) << "IEEE arithmetic alone keeps less";
  }
}

TEST(StabilityReport, OfOrdersHasARowForEachFormThatTheNumberHolds) {
  const auto rows = order_rows({StabilityOptions::Setting::brief,
                                {"ndf.ggx", "fresnel.constant", "masking.smith_gtr.correlated"}});
  std::vector<std::string> seen;
  for (const auto& r : rows) {
    seen.push_back(r.id + " " + r.form + " " + r.number);
    EXPECT_GE(r.inputs, 128U);
    if (r.id == "fresnel.constant") {
      EXPECT_EQ(r.written, r.regrouped);
    }
    if (r.id == "ndf.ggx" && r.form == "cross") {
      EXPECT_GT(r.regrouped, 0);
      EXPECT_FALSE(r.needs_precise()) << r.number << " " << r.regrouped;
    }
  }
  EXPECT_EQ(seen, (std::vector<std::string>{
                      "ndf.ggx cross float", "ndf.ggx cosine float", "fresnel.constant facet float",
                      "masking.smith_gtr.correlated cosines float", "ndf.ggx cross half",
                      "ndf.ggx cosine half", "fresnel.constant facet half"}))
      << "a half does not hold the nodes of GTR's masking";
}

TEST(StabilityFindings, SayWhatRegroupingTakesFromAForm) {
  StabilityRows r;
  r.orders = {{"ndf.ggx", "cross", "half", 0.004, 0.009, "", 0, 0, 4096},
              {"ndf.gtr", "cross", "half", 0.015, 0.06, "", 0, 0, 4096},
              {"ndf.beckmann", "cross", "half", 0.03, 0.06, "", 0, 0, 4096}};
  EXPECT_FALSE(r.orders[0].needs_precise());
  EXPECT_TRUE(r.orders[1].needs_precise());
  EXPECT_FALSE(r.orders[2].needs_precise()) << "it keeps the tolerance in no order";
  const auto f = findings(r);
  EXPECT_TRUE(says(f,
                   "A compiler that regroups sums and products takes half's 2\u00a0% from 1 of 3 "
                   "forms, over inputs on which they keep it as written."));
  EXPECT_TRUE(says(f, "The worst of them errs by 6\u00a0% in place of 1.5\u00a0%."));
  test::expect_plain(f);
  r.orders[0].lost = 7;
  EXPECT_TRUE(r.orders[0].needs_precise()) << "values are lost";
}

TEST(StabilityTargets, OfFloatAreUnitsBeyondTheInputsAndOfHalfAWidth) {
  using stabilities::misses_target;
  auto r = made_row("ndf.ggx", "cross", "half");
  EXPECT_FALSE(misses_target(r, Number::half));
  r.safe_from = 0.06;
  EXPECT_TRUE(misses_target(r, Number::half));
  EXPECT_FALSE(misses_target(r, Number::float_));
  r.ulp_beyond = 9;
  EXPECT_TRUE(misses_target(r, Number::float_));
  r.ulp_beyond = 7;
  r.nonfinite = 1;
  EXPECT_TRUE(misses_target(r, Number::double_));
  auto fresnel = made_row("fresnel.schlick", "facet", "half");
  fresnel.decides = "f0";
  EXPECT_FALSE(misses_target(fresnel, Number::half));
  fresnel.worst_rel = 0.03;
  EXPECT_TRUE(misses_target(fresnel, Number::half));
}

TEST(StabilityTargets, WhatMissesHasItsReason) {
  using stabilities::reason_of;
  EXPECT_NE(reason_of(made_row("ndf.beckmann", "cross", "half"), Number::half).find("exponential"),
            std::string::npos);
  EXPECT_NE(reason_of(made_row("masking.smith_gtr.separable", "cosines", "float"), Number::float_)
                .find("polynomial"),
            std::string::npos);
  auto r = made_row("ndf.other", "cross", "half");
  EXPECT_EQ(reason_of(r, Number::half), "what its inputs were rounded by already costs as much");
  r.ulp_beyond = 100;
  EXPECT_EQ(reason_of(r, Number::half), "roundings of its operations add up");
  r.ulp_beyond = 1e5;
  EXPECT_NE(reason_of(r, Number::mixed).find("a half below its normal range"), std::string::npos);
  EXPECT_EQ(reason_of(r, Number::float_), "likely a difference that cancels on the way");
  r.flags = "overflow";
  EXPECT_EQ(reason_of(r, Number::half), "on the way there is overflow");
  r.nonfinite = 1;
  EXPECT_NE(reason_of(r, Number::half).find("leave the range"), std::string::npos);
  EXPECT_EQ(stabilities::text_of(HalfFlags{true, true}), "overflow, underflow");
  EXPECT_EQ(stabilities::text_of(HalfFlags{}), "");
}

TEST(StabilityReport, GivesAReasonToEveryRowThatMissesAndToNoOther) {
  GONIO_MANY_FITS();
  for (const auto& r : report().rows.rows) EXPECT_EQ(r.misses, !r.reason.empty()) << r.number;
  EXPECT_EQ(row("cross", "half").flags.find("overflow") == std::string::npos, true);
  EXPECT_FALSE(row("cross", "float").misses);
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
  EXPECT_TRUE(std::isnan(ggx->worst.front()));
  EXPECT_LT(ggx->worst.back(), 0.01);
  EXPECT_GT(ggx->worst.back(), 1e-4);
}

TEST(StabilityReport, DrawsNothingOfWhatHasNoValueAtAnyAlpha) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  StabilityRows r;
  r.by_alpha = {{"masking.smith_ggx.correlated", "", "half", {0.1, 1}, {none, none}},
                {"ndf.ggx", "cross", "half", {0.1, 1}, {none, 0.01}}};
  const auto drawn = pictures(r).figures;
  ASSERT_EQ(drawn.size(), 1U);
  EXPECT_EQ(drawn[0].curves.back().name, "ggx from |n × h|²");
  EXPECT_EQ(label_of(drawn[0].curves.back()), "GGX from |n × h|²");
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
