#include "stability/prove_relative.h"

#include <cmath>
#include <cstdlib>
#include <random>

#include "any_machine.h"
#include "brdf/formula/masking.h"
#include "brdf/formula/ndf_ggx.h"
#include "brdf/function/functions.h"
#include "many_fits.h"
#include "stability/evaluate.h"
#include "stability/subjects.h"

namespace gonio::stability {
namespace {

using test::AnyMachine;

Subject ggx(Given given) {
  return subject("ndf.ggx", given, {{"alpha", {1e-3, 1}}});
}
Subject smith() {
  return subject("masking.smith_ggx.correlated", Given::cosines,
                 {{"alpha", {1e-3, 1}}, {"nol", {1e-3, 1}}, {"nov", {1e-3, 1}}});
}

#define GONIO_NEEDS_GAPPA(proof) \
  if (proof.why == "Gappa is not installed") GTEST_SKIP() << proof.why

/// Largest relative error of machines of the rule, found at inputs all over the domain, against double.
template <template <class> class Term, class F>
double worst_found(const Subject& s, const std::vector<Range>& domain, const Rounding& rule) {
  const RoundingScope scope(rule);
  std::mt19937_64 random(7);
  double worst = 0;
  const auto value = [&]<class T>(const std::vector<T>& in) {
    const auto all = std::span<const T>(in);
    const auto row = angles_of<T>(s.given, all.subspan(s.parameters));
    Quotient<T> q;
    term_at<Term, T>(all.first(s.parameters), {&row, 1}, &q);
    return q.value();
  };
  for (std::size_t k = 0; k < test::few(300'000, 3'000); ++k) {
    std::vector<AnyMachine<F>> in;
    std::vector<double> exact;
    for (const auto& [low, high] : domain) {
      const double share = std::ldexp(static_cast<double>(random() >> 11), -53);
      const double x =
          random() % 2 ? low + (high - low) * share : std::max(low, high * std::exp2(-30 * share));
      in.emplace_back(static_cast<F>(std::clamp(x, low, high)));
      exact.push_back(in.back().in_double());
    }
    const double f = value(exact);
    worst = std::max(worst, std::abs(value(in).in_double() / f - 1));
  }
  return worst;
}

TEST(RelativeProof, OfGgxAndOfSmithIsNotExceededAndNotFarAway) {
  const auto check = [](const Subject& s, const Rounding& rule, double most, auto&& found) {
    const auto p = prove_relative(s, Number::float_, rule);
    GONIO_NEEDS_GAPPA(p);
    ASSERT_TRUE(p.bound) << s.id << ": " << p.why;
    EXPECT_LE(*p.bound, most) << s.id;
    const double worst = found(p.domain);
    EXPECT_LE(worst, *p.bound) << s.id;
    EXPECT_GE(worst, *p.bound / 6) << s.id;
  };
  for (const Rounding& rule : {Rounding{}, Rounding::vulkan()}) {
    check(ggx(Given::cross), rule, rule.any_gpu ? 7e-6 : 1.2e-6, [&](const auto& domain) {
      return worst_found<Ggx, float>(ggx(Given::cross), domain, rule);
    });
    check(smith(), rule, rule.any_gpu ? 4e-6 : 5e-7, [&](const auto& domain) {
      return worst_found<SmithGgxCorrelated, float>(smith(), domain, rule);
    });
  }
}

TEST(RelativeProof, ThatOnePerCentIsKeptOnAnyGpuIsGivenForRationalFormsInFloat) {
  for (const char* id : {"masking.schlick_ggx.half_alpha", "masking.ue_joint", "masking.hammon",
                         "masking.smith_ggx.separable", "masking.smith_ggx.correlated"}) {
    const auto s =
        subject(id, Given::cosines, {{"alpha", {1e-3, 1}}, {"nol", {1e-3, 1}}, {"nov", {1e-3, 1}}});
    const auto p = prove_relative(s, Number::float_, Rounding::vulkan());
    GONIO_NEEDS_GAPPA(p);
    ASSERT_TRUE(p.bound) << id << ": " << p.why;
    EXPECT_LT(*p.bound, 0.01) << id;
  }
}

TEST(RelativeProof, SaysForWhichInputsItHolds) {
  const auto all = prove_relative(smith(), Number::float_, Rounding::vulkan());
  GONIO_NEEDS_GAPPA(all);
  ASSERT_TRUE(all.bound) << all.why;
  EXPECT_TRUE(all.whole);
  // A product with sin²θ_h = 0 may be flushed: the domain's end is left out.
  const auto part = prove_relative(ggx(Given::cross), Number::float_, Rounding::vulkan());
  ASSERT_TRUE(part.bound) << part.why;
  EXPECT_FALSE(part.whole);
  EXPECT_EQ(part.domain[1].low, 0x1p-125);
  EXPECT_EQ(part.domain[1].high, 1 - 0x1p-24);
}

TEST(RelativeProof, OfTheSineFromTheCosineIsNoneWorthTheName) {
  const auto p = prove_relative(ggx(Given::cosine), Number::float_);
  GONIO_NEEDS_GAPPA(p);
  EXPECT_GT(p.bound.value_or(1), 0.01) << "1 − c² has lost its digits near the peak";
}

TEST(RelativeProof, SaysWhatCannotBeWritten) {
  const auto why = [](std::string_view id, Given given, const Rounding& rule,
                      const std::vector<std::pair<const char*, Range>>& domain = {}) {
    return prove_relative(subject(id, given, domain), Number::float_, rule).why;
  };
  EXPECT_EQ(why("ndf.gtr", Given::cosine, {}), "log, which Gappa does not know");
  EXPECT_EQ(why("fresnel.schlick.spherical_gaussian", Given::facet, {}),
            "exp, which Gappa does not know");
  EXPECT_EQ(why("ndf.ggx.mobile", Given::cosine, {}),
            "a choice that inputs of the domain make differently");
  EXPECT_EQ(why("fresnel.schlick", Given::facet, {.contracted = true}), "contraction");
  EXPECT_EQ(why("fresnel.schlick", Given::facet, {.flushed = true}),
            "an input that may be subnormal");
  EXPECT_EQ(
      prove_relative(subject("ndf.ggx", Given::cross, {{"alpha", {0.01, 1}}}), Number::half).why,
      "a value that is not proved to be finite");
}

TEST(RelativeProof, WithoutGappaSaysSo) {
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", "/nowhere", 1);
  const auto p = prove_relative(smith(), Number::float_);
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_FALSE(p.bound);
  EXPECT_EQ(p.why, "Gappa is not installed");
}

TEST(RelativeProof, OfNoTimeIsNone) {
  const auto p = prove_relative(smith(), Number::float_, {}, 0);
  GONIO_NEEDS_GAPPA(p);
  EXPECT_FALSE(p.bound);
  EXPECT_EQ(p.why, "Gappa was out of time");
}

TEST(GappaScript, IsTheFormulaRoundedAndExact) {
  std::string why;
  EXPECT_EQ(gappa_script(subject("fresnel.constant", Given::facet, {}), Number::half, {},
                         {{0.5, 1}, {0, 1}}, false, why),
            "@rnd = float<11,-24,ne>;\nx0 = rnd(X0);\nx1 = rnd(X1);\n"
            "{ x0 in [0x1p-1,0x1p+0] /\\ x1 in [0x0p+0,0x1p+0] -> x0 -/ x0 in ? }\n");
  const auto text = gappa_script(subject("masking.ue_mobile_simple", Given::cosines, {}),
                                 Number::float_, {}, {{0.5, 1}, {0.5, 1}, {0.5, 1}}, true, why);
  EXPECT_NE(text.find("r1 = rnd(sqrt(x0)); e1 = sqrt(x0);"), text.npos) << text;
  EXPECT_NE(text.find("\n$ x1 in ("), text.npos) << text;
}

TEST(GappaBound, IsTheLargerEndOfTheIntervalFound) {
  EXPECT_NEAR(
      gappa_bound(
          "\nResults:\n  r9 -/ e9 in [-332669339962575889b-78 {-1.10071e-06, -2^(-19.7931)}, "
          "631697976671446225b-79 {1.04506e-06, 2^(-19.868)}]\n")
          .value(),
      1.1007105e-06, 1e-12);
  EXPECT_NEAR(
      gappa_bound(
          "Results:\n  r1 -/ e1 in [-1b-23 {-1.19209e-07, -2^(-23)}, 3b-23 {1e-07, 2^(-2)}]")
          .value(),
      3 * 0x1p-23, 1e-20);
  EXPECT_EQ(gappa_bound("Results:\n  r1 -/ e1 in [0, 0]"), 0);
  for (const char* none :
       {"", "Results:", "Error: some properties were not satisfied:\n  REL(r9, e9)",
        "Results:\n x in [a, b]", "Results:\n x in [1b-2 {", "Results:\n x in [1b-2 {}"})
    EXPECT_FALSE(gappa_bound(none)) << none;
}

}  // namespace
}  // namespace gonio::stability
