#include "stability/prove.h"

#include <cmath>
#include <random>

#include "any_machine.h"
#include "brdf/formula/masking.h"
#include "brdf/formula/masking_shipped.h"
#include "brdf/formula/ndf.h"
#include "brdf/formula/ndf_anisotropic.h"
#include "brdf/formula/ndf_ggx.h"
#include "brdf/formula/ndf_shipped.h"
#include "brdf/function/functions.h"
#include "many_fits.h"
#include "optics/fresnel_approximate.h"
#include "stability/evaluate.h"
#include "stability/subjects.h"

#include <fmt/format.h>
#include <tbb/global_control.h>

namespace gonio::stability {
namespace {

using test::AnyMachine;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A term as a template, given its angles in one way: in any number, in that which is proved and in machines.
template <template <class> class Term, Given given>
struct Of {
  static constexpr std::size_t parameters = Term<double>::parameters.size();

  template <class T>
  static T value(std::span<const T> in) {
    const auto row = angles_of<T>(given, in.subspan(parameters));
    Quotient<T> q;
    term_at<Term, T>(in.first(parameters), {&row, 1}, &q);
    return q.value();
  }
};

template <class F, class Formula>
Provable<F> provable() {
  return {
      [](std::span<const Enclosure<F>> in) { return Formula::template value<Enclosure<F>>(in); },
      [](std::span<const double> in) {
        std::vector<F> x;
        for (const double v : in) x.push_back(static_cast<F>(v));
        return static_cast<double>(Formula::template value<F>(x));
      }};
}

/// Inputs all over a domain, at its ends and next to them.
template <class F>
std::vector<F> drawn(std::span<const Range> domain, std::mt19937_64& random) {
  std::vector<F> x;
  for (const auto& side : domain) {
    const double share = std::ldexp(static_cast<double>(random() >> 11), -53);
    double v = side.low + (side.high - side.low) * share;
    switch (random() % 6) {
      case 0:
        v = side.low;
        break;
      case 1:
        v = side.high;
        break;
      case 2:
        v = static_cast<double>(
            test::stepped(static_cast<F>(side.high), -static_cast<int>(random() % 4)));
        break;
      case 3:
        v = side.low + (side.high - side.low) * std::exp2(-40 * share);
        break;
      default:
        break;
    }
    x.push_back(static_cast<F>(std::clamp(static_cast<double>(static_cast<F>(v)),
                                          static_cast<double>(static_cast<F>(side.low)),
                                          static_cast<double>(static_cast<F>(side.high)))));
  }
  return x;
}

/// A proof, and inputs that machines of its rule compute: none of the values leaves the range.
template <class F, class Formula>
void attack(const char* name, std::vector<Range> domain, const Rounding& rule) {
  const double most = static_cast<double>(std::numeric_limits<F>::max());
  const auto proof = prove<F>(provable<F, Formula>(), domain, rule, {0, most}, {.boxes = 20'000});
  const auto at =
      fmt::format("{}{}{}{}", name, rule.any_gpu ? ", any GPU" : "",
                  rule.flushed ? ", flushed" : "", rule.contracted ? ", contracted" : "");
  ASSERT_TRUE(proof.holds()) << at << ": " << proof.open_boxes << " open of " << proof.boxes;
  const RoundingScope scope(rule);
  std::mt19937_64 random(4);
  for (std::size_t k = 0; k < test::few(25'000, 500); ++k) {
    const auto x = drawn<F>(domain, random);
    const std::vector<AnyMachine<F>> in(x.begin(), x.end());
    const double y = Formula::template value<AnyMachine<F>>(in).in_double();
    ASSERT_TRUE(proof.range->holds(y))
        << at << ": " << std::hexfloat << static_cast<double>(x[0]) << " "
        << static_cast<double>(x.back()) << ": " << y << " is not in [" << proof.range->low << ", "
        << proof.range->high << "]";
  }
}

/// Ten formulas under four rules, 25 000 inputs each: a million.
template <class F>
void attack_all(double alpha) {
  const Range width{alpha, 1}, part{0, 1}, above{1e-2, 1};
  for (const Rounding& rule : {Rounding{}, Rounding{.contracted = true},
                               Rounding{.contracted = true, .flushed = true}, Rounding::vulkan()}) {
    attack<F, Of<Ggx, Given::cross>>("GGX", {width, part}, rule);
    attack<F, Of<Ggx, Given::cosine>>("GGX by its cosine", {width, {0.1, 0.9}}, rule);
    attack<F, Of<GgxAniso, Given::frame>>("anisotropic GGX", {{0.5, 1}, {0.5, 1}, part, part},
                                          rule);
    attack<F, Of<GgxUeMobile, Given::cosine>>("mobile GGX", {width, {0.1, 0.9}}, rule);
    // On any GPU e^x may be negative where it is subnormal, which in half it soon is.
    attack<F, Of<Beckmann, Given::cosine>>("Beckmann", {{0.5, 1}, {rule.any_gpu ? 0.8 : 0.5, 1}},
                                           rule);
    attack<F, Of<SmithGgxCorrelated, Given::cosines>>("Smith", {width, above, above}, rule);
    attack<F, Of<SmithGgxSeparable, Given::cosines>>("separable Smith", {width, above, above},
                                                     rule);
    attack<F, Of<UeJointClamped, Given::cosines>>("joint Smith, clamped", {width, above, above},
                                                  rule);
    attack<F, Of<Schlick, Given::facet>>("Schlick", {part, part}, rule);
    attack<F, Of<Kelemen, Given::directions>>("Kelemen", {above, above, {0, 1}}, rule);
  }
}

TEST(Proof, OfARangeIsLeftByNoneOfAMillionInputsInHalf) {
  attack_all<Half>(0.125);
}
TEST(Proof, OfARangeIsLeftByNoneOfAMillionInputsInFloat) {
  attack_all<float>(1e-3);
}

TEST(Proof, ThatGgxIsFiniteNeedsFewBoxes) {
  const auto in_float = subject("ndf.ggx", Given::cross, {{"alpha", {1e-4, 1}}});
  const auto f = prove(in_float, Number::float_, {}, finite_and_not_negative(Number::float_));
  EXPECT_TRUE(f.holds());
  EXPECT_LE(f.boxes, 3U);
  const auto in_half = subject("ndf.ggx", Given::cross, {{"alpha", {0.03, 1}}});
  const auto h = prove(in_half, Number::half, {}, finite_and_not_negative(Number::half));
  EXPECT_TRUE(h.holds());
  EXPECT_LE(h.boxes, 25U);
  EXPECT_LE(h.range->high, 65504);
  const auto smith = subject("masking.smith_ggx.correlated", Given::cosines,
                             {{"nol", {1e-3, 1}}, {"nov", {1e-3, 1}}});
  const auto v = prove(smith, Number::float_, {}, finite_and_not_negative(Number::float_));
  EXPECT_TRUE(v.holds());
  EXPECT_EQ(v.boxes, 1U);
}

TEST(Proof, OfWhatOverflowsHalfGivesTheInputsInHex) {
  // The peak 1/(π α²) is more than a half holds below an alpha of 0.0022.
  const auto s = subject("ndf.ggx", Given::cross, {{"alpha", {0.001, 1}}});
  const auto p = prove(s, Number::half, {}, finite_and_not_negative(Number::half));
  EXPECT_FALSE(p.holds());
  EXPECT_EQ(p.evidence, Evidence::searched);
  ASSERT_TRUE(p.counterexample);
  EXPECT_EQ(p.counterexample->inputs_hex, (std::vector<std::string>{"0x1419", "0x0000"}));
  EXPECT_EQ(p.counterexample->value, infinity);
  EXPECT_EQ(value_of(s, Number::half, p.counterexample->inputs), infinity);
}

TEST(Proof, OfGgxInHalvesReachesDownToWhereItsPeakIsTooHigh) {
  const auto s = subject("ndf.ggx", Given::cross, {});
  const auto from = [&](const Rounding& rule) {
    return proved_from(s, Number::half, rule, finite_and_not_negative(Number::half)).value();
  };
  EXPECT_NEAR(from({}), 0.0022, 0.0003);  // 1/(π α²) is 65504
  EXPECT_LT(from(rounding_of({Number::half, true, false})), 0.01);
}

TEST(Proof, GoesToTheFacesOfABoxWhereAValueOnlyRises) {
  // f0 (1 − w) + w lies in [0, 2] where f0 and w are taken for independent; it rises with f0.
  const auto s = subject("fresnel.schlick", Given::facet, {});
  const auto p = prove(s, Number::half, {}, {0, 1});
  EXPECT_TRUE(p.holds());
  EXPECT_EQ(p.range->high, 1);
  EXPECT_FALSE(prove(s, Number::half, {}, {0, 0.999}).holds());
}

TEST(Proof, GoesToTheRightFace) {
  const auto s = subject("fresnel.schlick", Given::facet, {{"voh", {0.5, 1}}});
  const auto p = prove(s, Number::float_, {}, {0, 0.97});
  EXPECT_FALSE(p.holds()) << "F is 1 where f0 is";
  ASSERT_TRUE(p.counterexample);
  EXPECT_GT(p.counterexample->value, 0.97);
}

TEST(Proof, IsNoneWhereAValueMayBeNoNumberHoweverNarrowItsRange) {
  const Provable<float> f{[](auto in) { return sqrt(in[0]); },
                          [](auto in) { return std::sqrt(in[0]); }};
  const auto p = prove<float>(f, std::vector<Range>{{-1, 1}}, {}, {0, 1});
  ASSERT_TRUE(p.counterexample);
  EXPECT_TRUE(std::isnan(p.counterexample->value));
}

TEST(Proof, IsOpenWhereSingleInputsAreNeitherProvedNorRefuted) {
  // Vulkan lets e^x be negative where it is subnormal; nobody's is.
  const Provable<Half> f{
      [](auto in) { return exp(-in[0]); },
      [](auto in) { return static_cast<double>(exp(-static_cast<Half>(in[0]))); }};
  const auto p = prove<Half>(f, std::vector<Range>{{15, 15.0625}}, Rounding::vulkan(),
                             finite_and_not_negative(Number::half));
  EXPECT_EQ(p.evidence, Evidence::open);
  EXPECT_FALSE(p.out_of_budget);
  EXPECT_GT(p.open_boxes, 0U);
}

TEST(Proof, OfAFormWithGuardsGoesEveryWayThroughThem) {
  for (const auto& [id, given] :
       {std::pair{"ndf.gtr1", Given::cross}, {"ndf.gtr1", Given::cosine}}) {
    const auto s = subject(
        id, given,
        {{"alpha", {1e-3, 1}}, {given == Given::cross ? "sin2_theta_h" : "noh", {1e-3, 1}}});
    EXPECT_TRUE(prove(s, Number::float_, {}, finite_and_not_negative(Number::float_)).holds())
        << s.form();
  }
}

// ---- faults put in
// ---------------------------------------------------------------------------------

/// UeJointClamped without its second clamp.
struct JointUnclamped {
  template <class T>
  static T value(std::span<const T> in) {
    const T nov = min<T>(in[2] + constant<T>(1e-5L), T(1));
    const T sum = in[1] * (nov * (1 - in[0]) + in[0]) + nov * (in[1] * (1 - in[0]) + in[0]);
    return constant<T>(0.5L) / sum;
  }
};
/// GGX of a divisor that is guarded, and of one whose quotient is.
template <bool behind>
struct Guarded {
  template <class T>
  static T value(std::span<const T> in) {
    const T den = square(square(in[0]) + in[1]);
    if (behind) return max<T>(square(in[0]) / den, small<T>());
    return square(in[0]) / max<T>(den, small<T>());
  }
};

TEST(Proof, FailsWhereAClampIsRemoved) {
  const std::vector<Range> domain{{0, 1}, {0, 1}, {0, 1}};
  const Range required{0, 65504};
  EXPECT_TRUE(
      (prove<float>(provable<float, Of<UeJointClamped, Given::cosines>>(), domain, {}, required)
           .holds()));
  const auto p = prove<float>(provable<float, JointUnclamped>(), domain, {}, required);
  EXPECT_FALSE(p.holds());
  ASSERT_TRUE(p.counterexample);
  EXPECT_EQ(p.counterexample->inputs, (std::vector<double>{0, 0, 0}));
  EXPECT_EQ(p.counterexample->value, infinity);
}

TEST(Proof, FailsWhereAGuardIsMovedBehindTheDivision) {
  const std::vector<Range> domain{{0, 1}, {0, 1}};
  const Range required = finite_and_not_negative(Number::float_);
  EXPECT_TRUE((prove<float>(provable<float, Guarded<false>>(), domain, {}, required).holds()));
  const auto p = prove<float>(provable<float, Guarded<true>>(), domain, {}, required);
  EXPECT_FALSE(p.holds());
  ASSERT_TRUE(p.counterexample);
  EXPECT_TRUE(std::isnan(p.counterexample->value));
}

TEST(Proof, FindsAFaultPlantedAtASingleInput) {
  for (const double at : {0.0, 0.25, 0.3330078125, 0.999511718750, 1.0, 0x1p-24}) {
    const auto pole = [&]<class T>(const T& x) { return 1 / (x - constant<T>(at)); };
    const Provable<Half> f{[&](auto in) { return pole(in[0]); },
                           [&](auto in) { return static_cast<double>(pole(Half(in[0]))); }};
    const auto p = prove<Half>(f, std::vector<Range>{{0, 1}}, {}, {-1e5, 1e5});
    ASSERT_TRUE(p.counterexample) << at;
    // 1/x overflows of the subnormals next to it, too.
    EXPECT_NEAR(p.counterexample->inputs[0], at, 0x1p-16) << at;
  }
}

TEST(Proof, OfWhatCanBeNeitherProvedNorRefutedIsOpenAndSaysHowMuch) {
  // x (1 − x) is at most 1/4, which intervals see in small boxes alone; three boxes are too few.
  const std::vector<Range> domain{{0, 1}};
  const auto few = prove<float>(Provable<float>{[](auto in) { return in[0] * (1 - in[0]); },
                                                [](auto in) { return in[0] * (1 - in[0]); }},
                                domain, {}, {0, 0.26}, {.boxes = 3});
  EXPECT_EQ(few.evidence, Evidence::open);
  EXPECT_TRUE(few.out_of_budget);
  EXPECT_FALSE(few.range);
  EXPECT_GT(few.open_share, 0);
  EXPECT_LT(few.open_share, 1);
  EXPECT_FALSE(few.open.empty());
  const auto more =
      prove<float>(provable<float, Of<Schlick, Given::facet>>(), std::vector<Range>{{0, 1}, {0, 1}},
                   {}, {0, 1.01}, {.boxes = 3000});
  EXPECT_TRUE(more.holds());
}

TEST(Proof, WhoseBoxesRunOutLeavesNoneOfThemOut) {
  auto s = subjects_of("fresnel.conductor").at(0);
  set_domain(s, "voh", {0.5, 0.5});
  set_domain(s, "k", {0, 0});
  set_domain(s, "eta", {0.5, 1});  // F is 0 at its end, and its enclosure there below
  for (std::uint64_t boxes = 1; boxes <= 50; ++boxes) {
    const auto p =
        prove(s, Number::float_, {}, finite_and_not_negative(Number::float_), {.boxes = boxes});
    EXPECT_EQ(p.evidence, Evidence::open) << boxes;
    EXPECT_LE(p.boxes, boxes);
    EXPECT_GT(p.open_share, 0) << boxes;
  }
}

TEST(Proof, HalvesASideTooShortForItsLogarithm) {
  auto s = subjects_of("fresnel.conductor").at(0);
  set_domain(s, "voh", {0.5, 0.5});
  set_domain(s, "k", {0, 1e-30});
  set_domain(s, "eta", {0.5, 1});
  const auto p =
      prove(s, Number::float_, {}, finite_and_not_negative(Number::float_), {.boxes = 200});
  EXPECT_EQ(p.evidence, Evidence::open);
  EXPECT_GT(p.boxes, 1U);
  EXPECT_GE(p.open_share, 0);
}

TEST(Proof, IsTheSameWhateverTheThreads) {
  const auto s = subject("fresnel.dielectric", Given::facet, {});
  const auto run = [&] { return prove(s, Number::half, {}, {0, 1}, {.boxes = 600}); };
  const auto all = run();
  tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const auto again = run();
  EXPECT_EQ(all.boxes, again.boxes);
  EXPECT_EQ(all.open_boxes, again.open_boxes);
  EXPECT_EQ(all.open_share, again.open_share);
  EXPECT_EQ(all.evaluations, again.evaluations);
  EXPECT_EQ(all.evidence, again.evidence);
}

TEST(Proof, OfAModelIsOfItsTermsTogether) {
  auto s = subjects_of("lambert+ggx/smith_ggx.correlated/schlick").front();
  for (const auto& i : s.inputs) {
    if (i.name.starts_with("alpha")) set_domain(s, i.name, {0.1, 1});
    if (i.name == "nol" || i.name == "nov") set_domain(s, i.name, {0.1, 1});
    if (i.name == "cos_phi") set_domain(s, i.name, {0, 1});
  }
  // Not that it is not negative: of f0 = 0 and VoH that is rounded to more than 1, F is −1e-35.
  const auto p = prove(s, Number::float_, {}, finite_values(Number::float_));
  EXPECT_TRUE(p.holds()) << p.open_boxes << " of " << p.boxes;
}

TEST(Proof, OfAGpusIsWiderThanOfIeee) {
  const auto s = subject("ndf.ggx", Given::cross, {{"alpha", {0.01, 1}}});
  const auto required = finite_and_not_negative(Number::float_);
  const auto plain = prove(s, Number::float_, {}, required),
             any = prove(s, Number::float_, Rounding::vulkan(), required);
  ASSERT_TRUE(plain.holds());
  ASSERT_TRUE(any.holds());
  EXPECT_GT(any.range->high, plain.range->high);
}

}  // namespace
}  // namespace gonio::stability
