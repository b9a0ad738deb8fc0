// Every term in every number type, at arguments that rapidcheck thinks up and, where one fails,
// makes simpler.  A term named in the catalogue is tested here at once.
#include <bit>
#include <limits>

#include "brdf/in_number/number.h"
#include "brdf/terms.h"
#include "number/half.h"

#include <fmt/format.h>
#include <rapidcheck.h>
#include <rapidcheck/detail/TestListenerAdapter.h>

namespace gonio {
namespace {

using test::Parameters;
using test::Row;
using test::text;

/// A number type as these tests see it.
struct Type {
  Number number;
  double epsilon;               ///< the distance from 1 to the number above
  double least;                 ///< values below it may have lost digits
  double (*parameter)(double);  ///< rounds as evaluation in the number does
  double (*angle)(double);
};

double as_double(double x) {
  return x;
}
double as_float(double x) {
  return static_cast<double>(static_cast<float>(x));
}
double as_half(double x) {
  return static_cast<double>(Half(x));
}

template <class F>
constexpr double epsilon = static_cast<double>(std::numeric_limits<F>::epsilon());
template <class F>
constexpr double least_exact = static_cast<double>(std::numeric_limits<F>::min()) /
                               (std::same_as<F, Half> ? 1 : epsilon<F>);

constexpr Type types[] = {
    {Number::wide, epsilon<double>, least_exact<double>, as_double, as_double},
    {Number::double_, epsilon<double>, least_exact<double>, as_double, as_double},
    {Number::float_, epsilon<float>, least_exact<float>, as_float, as_float},
    {Number::half, epsilon<Half>, least_exact<Half>, as_half, as_half},
    {Number::mixed, epsilon<Half>, least_exact<Half>, as_half, as_float},
};

struct NumberSample {
  Parameters p;
  Row x;
};
std::ostream& operator<<(std::ostream& out, const NumberSample& s) {
  const auto& x = s.x;
  return out << "parameters " << text(s.p) << " at " << text(x) << " in the frame "
             << text(Parameters{x.xoh, x.yoh, x.xol, x.yol, x.xov, x.yov});
}

/// In [low, high]; becomes simpler towards low.
double uniform(double low, double high) {
  constexpr int steps = 1 << 30;
  const int k = *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(0, steps + 1));
  return low + (high - low) * (static_cast<double>(k) / steps);
}
double by_factors(double low, double high) {
  return std::exp(uniform(std::log(low), std::log(high)));
}
bool one_in(int n) {
  return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(0, n)) == n - 1;
}

/// A legal value: an end, 1 (where formulas have holes) or anything between.
double legal(const Range& r) {
  if (one_in(8)) return r.low;
  if (one_in(8)) return r.high;
  if (r.holds(1) && one_in(8)) return 1;
  const bool decades = r.low > 0 && r.high / r.low > 100;
  return std::clamp(decades ? by_factors(r.low, r.high) : uniform(r.low, r.high), r.low, r.high);
}

template <class T>
T one_of(std::initializer_list<T> values) {
  return *rc::gen::resize(rc::kNominalSize, rc::gen::elementOf(std::vector<T>(values)));
}

/// A pair of directions above the surface, half vectors from the peak outwards, some grazing.
Row pair() {
  const double h = one_in(2) ? by_factors(1e-5, 1) : uniform(0, 1.5);
  const double d = one_in(3) ? 1.5707 - by_factors(1e-3, 1) : uniform(0, 1.5);
  const double phi_h = uniform(-3.1416, 3.1416), phi_d = uniform(0, 3.1416);
  Row row = frame_angles(directions(HalfDifference{h, phi_h, d, phi_d}));
  static_cast<Angles<double>&>(row) = angles(SinCos(h), SinCos(d), std::cos(phi_d));
  RC_PRE(row.nol > 1e-4 && row.nov > 1e-4);
  return row;
}

/// Cosines at their ends and near them, which need not go together.
Row corner() {
  const auto cosine = [] { return one_of<double>({1, 0.5, 1e-6, 0}); };
  const double nol = cosine(), nov = cosine(), voh = cosine();
  RC_PRE(nol + nov > 1e-3);
  const auto [noh, sin2] =
      one_of<std::pair<double, double>>({{1, 0}, {1, 1e-6}, {0.6, 0.64}, {0.01, 0.9999}});
  return test::framed({nol, nov, noh, voh, sin2});
}

/// Rounded to the type, so that its value and the truth are of the same arguments.
NumberSample sample(std::span<const Parameter> parameters, const Type& type, Row (*row)() = pair) {
  NumberSample s;
  for (const auto& q : parameters) s.p.push_back(type.parameter(legal(q.legal)));
  s.x = row();
  constexpr double Row::*all[] = {&Row::nol,          &Row::nov, &Row::noh, &Row::voh,
                                  &Row::sin2_theta_h, &Row::xoh, &Row::yoh, &Row::xol,
                                  &Row::yol,          &Row::xov, &Row::yov};
  for (const auto a : all) s.x.*a = type.angle(s.x.*a);
  return s;
}

double value_in_number(Number number, std::size_t term, const NumberSample& s) {
  return values_in(number, term, s.p, {&s.x, 1})[0];
}

constexpr int thoughts = 150;

/// The same thoughts in every run.
void check(std::string_view what, auto&& property) {
  rc::detail::TestMetadata about;
  rc::detail::TestParams fixed;
  fixed.seed = 1;
  fixed.maxSuccess = thoughts;
  rc::detail::TestListenerAdapter silent;
  const auto result =
      rc::detail::checkProperty(rc::detail::toProperty(property), about, fixed, silent, {});
  rc::detail::FailureResult failure;
  if (result.match(failure)) {
    ADD_FAILURE() << what << ": " << failure.description;
  } else if (!result.template is<rc::detail::SuccessResult>()) {
    std::ostringstream text;
    rc::detail::printResultMessage(result, text);
    ADD_FAILURE() << what << ": " << text.str();
  }
}

void for_every_term_and_type(auto&& property) {
  for (std::size_t t = 0; t < catalogue().size(); ++t)
    for (const auto& type : types)
      property(t, type, fmt::format("{} in {}", catalogue()[t].about->id, name_of(type.number)));
}

/// In few bits a shader's arithmetic may divide by zero and cancel all it has.
bool is_held_to(const Type& type, std::size_t term) {
  return !catalogue()[term].as_shipped || type.epsilon == epsilon<double>;
}
/// What left the range of a half may be anything afterwards: 0/0 where α² is 0.
bool left_the_range_of_half() {
  return half_flags.overflow || half_flags.underflow;
}

TEST(NumberTypes, EveryTermIsAsExactAsItsInputsLastDigitsAllow) {
  for_every_term_and_type([](std::size_t t, const Type& type, const std::string& what) {
    if (type.number == Number::wide) return;  // the truth itself
    double worst = 0;
    int compared = 0;
    const double bound = catalogue()[t].as_shipped ? 1000 : 16;  // a shader's arithmetic may cancel
    check(what, [&] {
      const NumberSample s = sample(catalogue()[t].parameters, type);
      RC_LOG() << s;
      half_flags = {};
      const double value = value_in_number(type.number, t, s);
      RC_ASSERT(!(value < 0));
      if (!is_held_to(type, t)) return;
      const bool anything = left_the_range_of_half();
      RC_ASSERT(anything || std::isfinite(value));
      const auto truth = wide_value(t, s.p, s.x);
      const double digits = type.epsilon * (1 + truth.condition);
      if (std::abs(truth.value) < type.least || !(digits < 0.05)) return;
      const double error = truth.relative_error(value) / digits;
      if (error < bound) {
        ++compared;
        if (!anything) worst = std::max(worst, error);
      } else {
        RC_LOG() << "error " << error << " of " << truth.value;
        RC_ASSERT(anything);
      }
    });
    if (is_held_to(type, t)) {
      EXPECT_GE(compared, thoughts / 10) << what;
    }
    testing::Test::RecordProperty(what, fmt::format("{:.2f}", worst));
  });
}

TEST(NumberTypes, WideIsTheTruthRounded) {
  for (std::size_t t = 0; t < catalogue().size(); ++t) {
    NumberSample s{{}, test::random_angles(2, t)[1]};
    for (const auto& q : catalogue()[t].parameters) s.p.push_back(q.start);
    EXPECT_EQ(value_in_number(Number::wide, t, s), wide_value(t, s.p, s.x).value)
        << catalogue()[t].about->id;
  }
}

TEST(NumberTypes, EveryTermIsFiniteAndNotNegativeAtTheEndsOfItsRange) {
  for_every_term_and_type([](std::size_t t, const Type& type, const std::string& what) {
    if (!is_held_to(type, t)) return;
    check(what, [&] {
      const NumberSample s = sample(catalogue()[t].parameters, type, corner);
      RC_LOG() << s;
      half_flags = {};
      const double value = value_in_number(type.number, t, s);
      RC_ASSERT(left_the_range_of_half() || (std::isfinite(value) && value >= 0));
    });
  });
}

TEST(NumberTypes, WhatIsReciprocalIsSoToTheLastBit) {
  const auto differs = [](const Type& type, std::size_t t) {
    const NumberSample s = sample(catalogue()[t].parameters, type);
    RC_LOG() << s;
    NumberSample swapped = s;
    std::swap(swapped.x.nol, swapped.x.nov);
    std::swap(swapped.x.xol, swapped.x.xov);
    std::swap(swapped.x.yol, swapped.x.yov);
    const double a = value_in_number(type.number, t, s),
                 b = value_in_number(type.number, t, swapped);
    return std::bit_cast<std::uint64_t>(a) != std::bit_cast<std::uint64_t>(b);
  };
  std::vector<bool> reciprocal(catalogue().size(), true);
  for (std::size_t t = 0; t < reciprocal.size(); ++t)
    check("", [&] {
      if (differs(types[0], t)) reciprocal[t] = false;
    });
  for_every_term_and_type([&](std::size_t t, const Type& type, const std::string& what) {
    if (reciprocal[t])
      check(what, [&] { RC_ASSERT(!differs(type, t)); });
    else
      EXPECT_TRUE(catalogue()[t].as_shipped) << what;
  });
}

TEST(NumberTypes, DoubleAndFloatAreWhatTheKernelsCompute) {
  const auto rows = test::random_angles(50, 3);
  for (std::size_t t = 0; t < catalogue().size(); ++t)
    for (const auto& p : test::legal_grid(catalogue()[t].parameters, 3)) {
      const auto d = test::values_of<double>(t, p, rows);
      const auto f = test::values_of<float>(t, p, rows);
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const NumberSample s{p, rows[i]};
        ASSERT_EQ(value_in_number(Number::double_, t, s), d[i]) << catalogue()[t].about->id << s;
        ASSERT_EQ(value_in_number(Number::float_, t, s), static_cast<double>(f[i]))
            << catalogue()[t].about->id << s;
      }
    }
}

TEST(NumberTypes, MixedIsWhatAShadersDeclarationsCompute) {
  const auto term = find_term("ndf.ggx.ue_mobile");  // float D_GGX_R2(half a, float NoH)
  for (const double alpha : {0.02, 0.1, 0.3, 0.77, 1.0})
    for (const double noh : {0.1, 0.9, 0.999, 0.99999, 1.0}) {
      const Half a(alpha);
      const auto c = static_cast<float>(noh), a2 = static_cast<float>(a * a);
      const float d = (c * a2 - c) * c + 1.0F;
      const NumberSample s{{alpha}, test::framed({0.5, 0.5, noh, 0.5, (1 - noh) * (1 + noh)})};
      EXPECT_EQ(value_in_number(Number::mixed, term, s),
                static_cast<double>(std::min(a2 / (d * d), 2048.0F)))
          << s;
    }
}

TEST(NumberTypes, MixedRoundsNoHToHalfWhereAShaderDeclaresItSo) {
  // half GGX_Mobile(half roughness, half NoH): 1 − NoH² is a half's too before it is assigned to a
  // float
  const auto term = find_term("ndf.ggx.mobile");
  for (const double noh : {0.9, 0.999, 0.99976, 0.9999, 1.0}) {
    const Half c(noh);
    const auto rest = static_cast<float>(1 - c * c), a = static_cast<float>(Half(0.03)),
               n = static_cast<float>(c) * a, p = a / (rest + n * n);
    const NumberSample s{{0.03}, test::framed({0.5, 0.5, noh, 0.5, (1 - noh) * (1 + noh)})};
    EXPECT_EQ(value_in_number(Number::mixed, term, s), as_half(std::min(p * p, 2048.0F))) << s;
  }
}

TEST(NumberTypes, HalfIsTheFormulaRoundedAfterEveryOperation) {
  const NumberSample s{{0.3}, test::framed({0.5, 0.5, 0.9, 0.5, 0.19})};
  const Half a(0.3), pi_(3.14159265358979);
  const Half u = a * (Half(0.9) * Half(0.9)) + 1 / a * Half(0.19);
  EXPECT_EQ(value_in_number(Number::half, find_term("ndf.ggx"), s),
            static_cast<double>(1 / pi_ / (u * u)));
}

/// Of a term in half at these parameters, as exact as sixteen units of its last digit.
void expect_right_in_half(const char* id, double first, double second, double voh) {
  const auto term = find_term(id);
  const Parameters p{as_half(first), as_half(second)};
  const Row x = test::framed({0.5, 0.5, 0.5, as_half(voh), 0.75});
  EXPECT_NEAR(value_in_number(Number::half, term, {p, x}), wide_value(term, p, x).value,
              16 * epsilon<Half>)
      << id << text(p) << " at " << voh;
}

TEST(NumberTypes, AConductorHasRoomInHalfWhileTheSquareOfItsIndexHas) {
  for (const double voh : {0.0, 0.1, 0.3, 0.5, 0.7, 1.0}) {
    for (const double eta : {0.0115, 0.05, 1.5, 6.0})
      for (const double k : {0.0, 2.5, 7.0, 15.0, 17.0, 40.0, 250.0})
        expect_right_in_half("fresnel.conductor", eta, k, voh);
    for (const double f0 : {0.05, 0.3, 0.56, 0.6, 0.65, 0.7, 0.9})
      for (const double g : {0.0, 0.5, 1.0})
        expect_right_in_half("fresnel.gulbrandsen", f0, g, voh);
  }
}

TEST(NumberTypes, AConductorOfAnIndexNearOneIsRightInHalf) {
  for (const double eta : {0.95, 0.984, 0.998, 1.0, 1.02})
    for (const double k : {0.0, 0.0028, 0.05})
      for (const double voh : {0.0, 0.1, 0.5, 1.0})
        expect_right_in_half("fresnel.conductor", eta, k, voh);
  for (const double voh : {0.17, 0.175, 0.177, 0.178, 0.179, 0.18, 0.185}) {  // about the critical
    const double f =
        value_in_number(Number::half, find_term("fresnel.conductor"),
                        {{as_half(0.984), 0}, test::framed({0.5, 0.5, 0.5, as_half(voh), 0.75})});
    EXPECT_TRUE(f > 0.1 && f <= 1 + 24 * epsilon<Half>) << voh << ": " << f;
  }
}

TEST(NumberTypes, MaskingInANumberGivesG2InThatNumber) {
  const auto term = find_term("masking.smith_ggx.correlated");
  const NumberSample s{{0.3}, test::framed({0.7, 0.4, 1, 1, 0})};
  const double g2 = shown_in(Number::half, term, s.p, {&s.x, 1})[0];
  const Half cosines = 4 * Half(0.7) * Half(0.4);
  EXPECT_EQ(g2, static_cast<double>(cosines * Half(value_in_number(Number::half, term, s))));
  const auto ndf = find_term("ndf.ggx");
  EXPECT_EQ(shown_in(Number::half, ndf, s.p, {&s.x, 1}),
            values_in(Number::half, ndf, s.p, {&s.x, 1}));
}

TEST(NumberTypes, MapsComputeInTheNumberToo) {
  const auto map = find_map("clamp.nov").value();
  const auto in = [&](Number number, double nov) {
    return map_in(number, map, Parameters{nov})[0];
  };
  EXPECT_EQ(in(Number::double_, -0.5), 0.50001);
  EXPECT_EQ(in(Number::float_, -0.5), static_cast<double>(0.50001F));
  EXPECT_EQ(in(Number::wide, -0.5), 0.50001);
  EXPECT_EQ(in(Number::half, -0.5), 0.5);  // 1e-5 is less than half a digit
  EXPECT_EQ(in(Number::half, 0), as_half(1e-5));
  EXPECT_EQ(in(Number::mixed, 0), as_half(1e-5));
}

TEST(NumberTypes, OperationsAreCountedOncePerParametersAndOncePerSample) {
  using O = Operation;
  const auto ggx = operations_of(find_term("ndf.ggx"));
  Operations once, each;
  once[O::div] = 2;  // 1/α, 1/π
  each[O::mul] = 4;  // (α · c² + s² · 1/α)²
  each[O::add] = 1;
  each[O::div] = 1;
  EXPECT_EQ(ggx.parameters, once);
  EXPECT_EQ(ggx.sample, each);
}

}  // namespace
}  // namespace gonio
