#include "stability/answer.h"

#include <cmath>

#include "refusal.h"
#include "stability/evaluate.h"

#include <gtest/gtest.h>

namespace gonio::stability {
namespace {

using test::refusal;

Question about(std::string_view id, Number number, std::string_view required) {
  Question q;
  q.subject = subjects_of(id).at(0);
  q.arithmetic = {number, false, false};
  q.requirement = parse_requirement(required);
  return q;
}

TEST(StabilityAnswer, OfEveryHalfEstablishesWhatItLookedAt) {
  auto q = about("ndf.ggx", Number::half, "relative=0.02");
  set_domain(q.subject, "alpha", {0.1, 0.101});
  const auto a = answer(q);
  EXPECT_TRUE(a.holds);
  EXPECT_EQ(a.evidence, Evidence::exhaustive);
  EXPECT_FALSE(a.counterexample);
  EXPECT_GT(a.looked.relative.value, 1e-4);
  EXPECT_LT(a.looked.relative.value, 0.02);
}

TEST(StabilityAnswer, HasTheInputThatBreaksARequirement) {
  auto q = about("ndf.ggx", Number::half, "relative=1e-4");
  set_domain(q.subject, "alpha", {0.1, 0.101});
  const auto a = answer(q);
  EXPECT_FALSE(a.holds);
  ASSERT_TRUE(a.counterexample);
  const auto& c = *a.counterexample;
  ASSERT_EQ(c.inputs.size(), 2U);
  EXPECT_EQ(c.inputs[0].first, "alpha");
  const std::array in{c.inputs[0].second, c.inputs[1].second};
  EXPECT_EQ(value_of(q.subject, Number::half, in), c.value);
  EXPECT_GT(std::abs(c.value / c.exact - 1), 1e-4);
  EXPECT_EQ(c.inputs_hex[0].second, hex(Number::half, in[0], true));
}

TEST(StabilityAnswer, OfASmoothPeakInHalfIsThatItOverflows) {
  auto q = about("ndf.ggx", Number::half, "finite");
  set_domain(q.subject, "alpha", {0.001, 0.001001});  // 1/(π α²) is above 65504
  const auto a = answer(q);
  EXPECT_FALSE(a.holds);
  EXPECT_TRUE(a.counterexample);
}

TEST(StabilityAnswer, ProvesThatEveryFloatHasAValue) {
  auto q = about("ndf.ggx", Number::float_, "nonnegative");
  set_domain(q.subject, "alpha", {1e-4, 1});
  const auto a = answer(q);
  EXPECT_TRUE(a.holds);
  EXPECT_EQ(a.evidence, Evidence::proved);
  ASSERT_TRUE(a.range);
  EXPECT_GE(a.range->low, 0);
  EXPECT_GE(a.range->high, 1 / (3.1415927 * 1e-8));
}

TEST(StabilityAnswer, OfASearchThatFindsNothingStaysOpen) {
  auto q = about("ndf.ggx", Number::mixed, "relative=0.5");  // which nothing proves
  set_domain(q.subject, "alpha", {0.1, 1});
  const auto a = answer(q);
  EXPECT_FALSE(a.counterexample);
  EXPECT_FALSE(a.holds);
  EXPECT_EQ(a.evidence, Evidence::open);
}

TEST(StabilityAnswer, HasTheBoundThatGappaProvesOrSaysWhyNot) {
  auto q = about("masking.ue_joint", Number::float_, "relative=1e-6");
  set_domain(q.subject, "alpha", {1e-3, 1});
  set_domain(q.subject, "nol", {1e-3, 1});
  set_domain(q.subject, "nov", {1e-3, 1});
  const auto a = answer(q);
  EXPECT_FALSE(a.counterexample);
  EXPECT_NE(a.proved_rel.has_value(), a.unproved_because == "Gappa is not installed");
  if (a.proved_rel) {
    EXPECT_GE(*a.proved_rel, a.looked.relative.value);
    EXPECT_EQ(a.holds, a.evidence == Evidence::proved);
  }
}

TEST(StabilityAnswer, ProvesABoundOverADomainWhoseEndsAreNoFloats) {
  auto q = about("masking.ue_joint", Number::float_, "relative=1e-5");
  for (const auto* input : {"alpha", "nol", "nov"}) set_domain(q.subject, input, {0.001, 0.9});
  const auto a = answer(q);
  if (a.unproved_because == "Gappa is not installed") GTEST_SKIP() << a.unproved_because;
  EXPECT_TRUE(a.holds) << a.unproved_because;
  EXPECT_EQ(a.evidence, Evidence::proved);
}

TEST(StabilityAnswer, OfWhatHasNoValueIsThatItKeepsNoRequirement) {
  for (const auto* required : {"finite", "nonnegative", "relative=0.02"}) {
    auto q = about("ndf.ggx", Number::half, required);
    set_domain(q.subject, "alpha", {0.001, 0.001001});  // the peak is more than a half holds
    EXPECT_FALSE(answer(q).holds) << required;
  }
}

TEST(StabilityAnswer, RefusesARequirementThatIsNone) {
  for (const auto* text : {"relative", "relative=", "relative=0", "relative=-1", "relative=nan",
                           "relative=inf", "exact", ""})
    EXPECT_NE(refusal([&] { parse_requirement(text); }, Exit::usage), "") << text;
  EXPECT_EQ(parse_requirement("relative=0.02").text(), "relative=0.02");
}

}  // namespace
}  // namespace gonio::stability
