#include "stability/answer.h"

#include <cmath>

#include "refusal.h"
#include "stability/evaluate.h"
#include "stability/exhaustive.h"
#include "stability/places.h"

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

/// Least of the halves of the first input from which, up to its end, no half of the last breaks the requirement: by halving, each
/// time over all inputs from there on.
std::optional<double> bisected(const Question& q) {
  const auto& s = q.subject;
  const auto halves = [&](std::size_t k) {
    std::vector<double> all;
    const auto places = places_within(Number::half, s.inputs[k].domain, true);
    for (auto p = places.first; p <= places.last; ++p)
      all.push_back(at_place(Number::half, p, true));
    return all;
  };
  std::vector<double> in;
  for (const auto& i : s.inputs) in.push_back(rounded(Number::half, i.domain.low, true));
  const auto deciding = halves(*s.decides), others = halves(in.size() - 1);
  const auto breaks = [&] {
    const double x = value_of(s, q.arithmetic, in), f = value_of(s, Number::double_, in);
    if (!std::isfinite(x)) return true;
    if (q.requirement.kind == Requirement::Kind::finite) return false;
    if (q.requirement.kind == Requirement::Kind::nonnegative) return x < 0;
    const double size =
        q.requirement.kind == Requirement::Kind::absolute ? 1 : std::max(std::abs(f), 0x1p-14);
    return std::abs(x - f) > q.requirement.limit * size;
  };
  const auto holds = [&](std::size_t from) {
    for (std::size_t d = from; d < deciding.size(); ++d)
      for (const double other : others) {
        in[*s.decides] = deciding[d];
        in.back() = other;
        if (breaks()) return false;
      }
    return true;
  };
  if (!holds(deciding.size() - 1)) return {};
  std::size_t fails = 0, kept = deciding.size() - 1;
  if (holds(0)) return deciding[0];
  while (kept - fails > 1) {
    const auto middle = (fails + kept) / 2;
    (holds(middle) ? kept : fails) = middle;
  }
  return deciding[kept];
}

TEST(StabilityAnswer, IsSafeFromWhereBruteForceFindsItInHalf) {
  struct Case {
    const char *id, *form, *required;
    std::vector<std::pair<const char*, Range>> domain;
  };
  std::size_t between = 0;
  for (const auto& [id, form, required, domain] :
       std::vector<Case>{{"ndf.ggx",
                          "cross",
                          "finite",
                          {{"alpha", {0.0021, 0.0023}}, {"sin2_theta_h", {0, 1e-5}}}},
                         {"ndf.ggx",
                          "cross",
                          "relative=0.02",
                          {{"alpha", {0.0037, 0.004}}, {"sin2_theta_h", {0, 4e-5}}}},
                         {"ndf.beckmann",
                          "cross",
                          "relative=0.03",
                          {{"alpha", {0.01, 0.02}}, {"sin2_theta_h", {0, 2e-5}}}},
                         {"ndf.ggx.mobile",
                          "cosine",
                          "relative=0.05",
                          {{"alpha", {0.05, 0.3}}, {"noh", {0.95, 1}}}},
                         {"fresnel.schlick",
                          "facet",
                          "absolute=0.0003",
                          {{"f0", {0.2, 0.5}}, {"voh", {0.5, 0.6}}}},
                         {"fresnel.f82",
                          "facet",
                          "nonnegative",
                          {{"f0", {0, 0.02}}, {"f82_tint", {0, 0}}, {"voh", {0.1, 0.2}}}},
                         {"masking.smith_ggx.correlated",
                          "cosines",
                          "relative=0.003",
                          {{"alpha", {0.1, 0.2}}, {"nol", {0.125, 0.125}}, {"nov", {0.1, 0.12}}}}})
    for (const bool flush : {false, true}) {
      Question q;
      q.subject = subject_of(id, form);
      q.arithmetic = {Number::half, flush, false};
      q.requirement = parse_requirement(required);
      for (const auto& [name, ends] : domain) set_domain(q.subject, name, ends);
      const auto a = answer(q);
      ASSERT_TRUE(a.safe_from) << id;
      EXPECT_EQ(a.safe_from->evidence, Evidence::exhaustive) << id;
      const auto brute = bisected(q);
      EXPECT_EQ(a.safe_from->value, brute) << id << ' ' << required << (flush ? ", flushed" : "");
      if (brute && *brute > domain[0].second.low * 1.01) ++between;
    }
  EXPECT_GE(between, 1U) << "the cases decide nothing";
}

TEST(StabilityAnswer, NamesTheLeastOfEveryRequirementInOneCall) {
  auto q = about("ndf.ggx", Number::half, "relative=0.05");
  set_domain(q.subject, "alpha", {0.002, 0.008});
  const auto all = least_values(q);
  ASSERT_EQ(all.size(), 8U);
  for (const auto& l : all) {
    Question one = q;
    one.requirement = parse_requirement(l.requirement);
    one.arithmetic.flush = l.flush;
    const auto alone = answer(one).safe_from;
    ASSERT_TRUE(alone);
    EXPECT_EQ(alone->value, l.value) << l.requirement;
  }
  EXPECT_EQ(all[2].requirement, "relative=0.05");
  EXPECT_LT(*all[0].value, *all[2].value) << "a value comes before its digits";
  EXPECT_NE(all[2].value, all[6].value) << "flushing costs some";
}

TEST(StabilityAnswer, ProvesFromWhereAWholeModelHasAValue) {
  auto q = about("ggx/smith_ggx.correlated/schlick", Number::half, "finite");
  for (const char* name : {"nol", "nov"}) set_domain(q.subject, name, {0.1, 1});
  const auto a = answer(q);
  EXPECT_FALSE(a.holds);
  ASSERT_TRUE(a.safe_from && a.safe_from->value);
  EXPECT_EQ(a.safe_from->evidence, Evidence::proved);
  EXPECT_GE(*a.safe_from->value, *a.looked.finite_from);
  set_domain(q.subject, "alpha", {*a.safe_from->value, 1});
  EXPECT_TRUE(answer(q).holds);
  set_domain(q.subject, "alpha", {1e-6, 0.001});
  EXPECT_FALSE(answer(q).safe_from->value) << "nowhere";
}

TEST(StabilityAnswer, AsksForAnAbsoluteErrorWhereAValueIsNextToNothing) {
  for (const auto& [required, holds] :
       {std::pair("absolute=0.005", true), {"absolute=0.002", false}, {"relative=0.02", false}}) {
    auto q = about("fresnel.f82", Number::half, required);
    set_domain(q.subject, "f0", {0.001, 0.001});
    EXPECT_EQ(answer(q).holds, holds) << required;
  }
  EXPECT_NE(refusal([] { parse_requirement("absolute=0"); }, Exit::usage), "");
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
    EXPECT_EQ(a.holds, *a.proved_rel <= 1e-6);
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

/// Question on any GPU.
Question on_any_gpu(Question q) {
  q.arithmetic.any_gpu = true;
  return q;
}

TEST(StabilityAnswer, OfWhatTheFormulaItselfHasNoValueForIsThatItIsNotFinite) {
  for (const Number number : {Number::half, Number::float_}) {
    auto q = about("ndf.beckmann_aniso.as_written", number, "finite");
    set_domain(q.subject, "alpha_x", {0.5, 0.5});
    set_domain(q.subject, "alpha_y", {0.5, 0.5});
    set_domain(q.subject, "sin2_theta_h", {1, 1});
    const auto a = answer(q);
    EXPECT_FALSE(a.holds);
    ASSERT_TRUE(a.counterexample);
    EXPECT_TRUE(std::isnan(a.counterexample->exact));
  }
}

TEST(StabilityAnswer, OfARelativeErrorAsksWhatVanished) {
  auto q = about("ndf.ggx.ue_mobile", Number::half, "relative=0.02");
  set_domain(q.subject, "alpha", {1e-4, 1e-4});
  set_domain(q.subject, "noh", {0.9985, 0.9985});
  const auto a = answer(q);
  EXPECT_FALSE(a.holds);
  ASSERT_TRUE(a.counterexample);
  EXPECT_EQ(a.counterexample->value, 0);
  EXPECT_GT(a.counterexample->exact, 1e-3);
}

TEST(StabilityAnswer, OnAnyGpuIsEstablishedByAProofAloneThoughEveryHalfWasLookedAt) {
  auto q = about("ndf.ggx", Number::half, "finite");
  set_domain(q.subject, "alpha", {0.1, 0.101});
  EXPECT_EQ(answer(q).evidence, Evidence::exhaustive);
  const auto a = answer(on_any_gpu(q));
  EXPECT_TRUE(a.holds);
  EXPECT_EQ(a.evidence, Evidence::proved);
  EXPECT_EQ(a.unproved_because, "");
  EXPECT_EQ(text_of(a.arithmetic), "half, on any GPU");
  ASSERT_TRUE(a.range);
  const auto own = exhaustive(q.subject, {}, 0.02);
  EXPECT_GT(a.range->high, value_of(q.subject, Number::half, own.relative.at));
}

TEST(StabilityAnswer, OnAnyGpuIsRefutedByWhatIeeeArithmeticGives) {
  auto q = about("ndf.ggx", Number::half, "finite");
  set_domain(q.subject, "alpha", {0.001, 0.001001});
  const auto a = answer(on_any_gpu(q));
  EXPECT_FALSE(a.holds);
  ASSERT_TRUE(a.counterexample);
  EXPECT_EQ(a.evidence, Evidence::exhaustive);
  EXPECT_TRUE(std::isinf(a.counterexample->value));
}

TEST(StabilityAnswer, OnAnyGpuIsRefutedByOneThatFlushes) {
  auto q = about("masking.ue_joint", Number::half, "finite");
  set_domain(q.subject, "alpha", {1e-6, 1e-6});
  set_domain(q.subject, "nol", {1, 1});
  set_domain(q.subject, "nov", {5e-5, 5.1e-5});
  EXPECT_TRUE(answer(q).holds);
  const auto a = answer(on_any_gpu(q));
  EXPECT_FALSE(a.holds);
  ASSERT_TRUE(a.counterexample);
  EXPECT_EQ(a.evidence, Evidence::searched);
  EXPECT_FALSE(std::isfinite(a.counterexample->value)) << "it is the flushing machine's";
}

TEST(StabilityAnswer, OnAnyGpuKeepsTheBoundThatGappaProves) {
  auto q = about("ndf.ggx", Number::float_, "relative=0.01");
  set_domain(q.subject, "alpha", {1e-3, 1});
  set_domain(q.subject, "sin2_theta_h", {1e-6, 0.999});
  const auto plain = answer(q), a = answer(on_any_gpu(q));
  if (a.unproved_because == "Gappa is not installed") GTEST_SKIP() << a.unproved_because;
  EXPECT_TRUE(a.holds) << a.unproved_because;
  EXPECT_EQ(a.evidence, Evidence::proved);
  ASSERT_TRUE(plain.proved_rel && a.proved_rel);
  EXPECT_GT(*a.proved_rel, *plain.proved_rel) << "more is allowed";
}

TEST(StabilityAnswer, OfABoundThatIsLargerThanWhatIsRequiredIsOpen) {
  auto q = about("ndf.ggx", Number::float_, "relative=3e-6");  // which no search refutes
  set_domain(q.subject, "alpha", {1e-3, 1});
  set_domain(q.subject, "sin2_theta_h", {1e-6, 0.999});
  const auto a = answer(on_any_gpu(q));
  if (a.unproved_because == "Gappa is not installed") GTEST_SKIP() << a.unproved_because;
  EXPECT_FALSE(a.holds);
  EXPECT_FALSE(a.counterexample);
  EXPECT_EQ(a.evidence, Evidence::open);
  EXPECT_GT(a.proved_rel.value_or(0), 3e-6);
  EXPECT_EQ(a.unproved_because, "the bound that is proved is larger");
}

TEST(StabilityAnswer, OnAnyGpuThatStaysOpenSaysWhy) {
  auto relative = about("ndf.gtr1", Number::float_, "relative=0.1");
  set_domain(relative.subject, "alpha", {0.3, 0.4});
  const auto r = answer(on_any_gpu(relative));
  EXPECT_FALSE(r.holds);
  EXPECT_EQ(r.evidence, Evidence::open);
  EXPECT_NE(r.unproved_because, "");
  auto finite = about("fresnel.conductor", Number::float_, "nonnegative");
  finite.boxes = 10;
  const auto f = answer(on_any_gpu(finite));
  EXPECT_EQ(f.evidence, Evidence::open);
  EXPECT_NE(f.unproved_because.find("the proof ran out of boxes; open is eta "), std::string::npos)
      << f.unproved_because;
}

TEST(StabilityAnswer, OnAnyGpuRefusesNumbersAndLibertiesThatItHasNoRuleFor) {
  const auto mixed = on_any_gpu(about("ndf.ggx", Number::mixed, "finite"));
  EXPECT_NE(refusal([&] { answer(mixed); }, Exit::usage).find("mixed"), std::string::npos);
  auto flushed = on_any_gpu(about("ndf.ggx", Number::half, "finite"));
  flushed.arithmetic.flush = true;
  EXPECT_NE(refusal([&] { answer(flushed); }, Exit::usage).find("flushing"), std::string::npos);
}

TEST(StabilityAnswer, RefusesARequirementThatIsNone) {
  for (const auto* text : {"relative", "relative=", "relative=0", "relative=-1", "relative=nan",
                           "relative=inf", "exact", ""})
    EXPECT_NE(refusal([&] { parse_requirement(text); }, Exit::usage), "") << text;
  EXPECT_EQ(parse_requirement("relative=0.02").text(), "relative=0.02");
}

}  // namespace
}  // namespace gonio::stability
