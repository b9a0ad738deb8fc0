// Digits that formulas keep where these are lost most easily: the targets of each number, and the
// terms that miss them, with the reason.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "brdf/hard_domain.h"
#include "brdf/in_number/number.h"
#include "number/half.h"

#include <fmt/format.h>

namespace gonio {
namespace {

using test::HardDraws;
using test::Parameters;
using test::Row;

struct Sample {
  Parameters p;
  Row x;
};
std::string text(const Sample& s) {
  return testing::PrintToString(s.p) + " at " + test::text(s.x);
}

template <class F>
Sample draw(HardDraws& draws, const TermEntry& term) {
  const auto round = [](double& x) { x = static_cast<double>(static_cast<F>(x)); };
  Sample s{draws.parameters(term.parameters), {}};
  std::ranges::for_each(s.p, round);
  s.x = draws.angles(term, s.p);
  for (const auto a : {&Row::nol, &Row::nov, &Row::noh, &Row::voh, &Row::sin2_theta_h})
    round(s.x.*a);
  for (const auto a : {&Row::xoh, &Row::yoh, &Row::xol, &Row::yol, &Row::xov, &Row::yov})
    round(s.x.*a);
  return s;
}
double value_in(Number number, std::size_t term, const Sample& s) {
  return values_in(number, term, s.p, {&s.x, 1})[0];
}

bool is_dear(std::string_view id) {
  return id.starts_with("masking.smith_gtr") || id.starts_with("masking.smith_student_t");
}

// ---- Float and double ---------------------------------------------------------------------------

/// Units of the last digit that a term may err by, times its condition where that is above 1.
double allowed(std::string_view id) {
  // exp and log: t^−γ errs by γ |ln t|, which near γ = 1 is more than D depends on γ there.
  if (id == "ndf.gtr") return 12;
  // 24 terms of a series, the largest ten times their sum where γ is.
  if (is_dear(id)) return 24;
  // e^L of a quotient L up to 20
  if (id == "masking.smith_charlie.correlated") return 48;
  return 8;
}

template <class F>
void expect_digits(Number number, int draws_of_each) {
  constexpr double eps = static_cast<double>(std::numeric_limits<F>::epsilon());
  constexpr double least = static_cast<double>(std::numeric_limits<F>::min()) / eps;
  std::size_t compared = 0;
  for (std::size_t t = 0; t < catalogue().size(); ++t) {
    const auto& term = catalogue()[t];
    if (term.as_shipped) continue;  // it may cancel all that it has
    // The series of masking.smith_gtr are of the legal widths.
    HardDraws draws(t, is_dear(term.id()) ? 1e-4 : 1e-6);
    double worst = 0;
    for (int i = 0; i < (is_dear(term.id()) ? draws_of_each / 20 : draws_of_each); ++i) {
      const Sample s = draw<F>(draws, term);
      const auto truth = wide_value(t, s.p, s.x);
      if (!(truth.value > least) ||
          truth.value > static_cast<double>(std::numeric_limits<F>::max()))
        continue;
      const double value = value_in(number, t, s);
      const double error = truth.relative_error(value) / eps / std::max(1.0, truth.condition);
      worst = std::max(worst, error);
      ++compared;
      EXPECT_LE(error, allowed(term.id())) << term.id() << text(s) << ": " << value;
    }
    testing::Test::RecordProperty(fmt::format("{} in {}", term.id(), name_of(number)),
                                  fmt::format("{:.2f}", worst));
  }
  EXPECT_GT(compared, 20U * static_cast<std::size_t>(draws_of_each));
}

TEST(StableForms, KeepAllButEightUnitsOfDouble) {
  expect_digits<double>(Number::double_, 200);
}
TEST(StableForms, KeepAllButEightUnitsOfFloat) {
  expect_digits<float>(Number::float_, 200);
}

// ---- Half ---------------------------------------------------------------------------------------

/// Greatest relative error of a term of + − × ÷ √ in half, from a width on, where its value is a normal half.
struct InHalf {
  std::string_view id;
  double tolerance, least_width;
};
constexpr InHalf in_half_terms[] = {
    {"ndf.ggx", 0.005, 0.05},
    {"ndf.gtr1", 0.005, 0.05},
    {"ndf.ggx_aniso", 0.006, 0.05},  // misses 0.005: three constants of three roundings each
    {"ndf.ggx", 0.02, 1e-4},
    {"ndf.gtr1", 0.02, 1e-4},
    {"masking.smith_ggx.separable", 0.02, 1e-4},
    {"masking.smith_ggx.correlated", 0.02, 1e-4},
    {"masking.smith_ggx_aniso.correlated", 0.02, 1e-4},
    {"masking.smith_ggx_aniso.separable", 0.02, 1e-4},
    {"masking.smith_beckmann.separable", 0.02, 1e-4},
    {"masking.smith_beckmann.correlated", 0.02, 1e-4},
    {"masking.schlick_ggx.half_alpha", 0.02, 1e-4},
    {"masking.schlick_ggx.direct", 0.02, 1e-4},
    {"masking.schlick_ggx.half_roughness", 0.02, 1e-4},
    {"masking.schlick_beckmann", 0.02, 1e-4},
    {"masking.ue_joint", 0.02, 1e-4},
    {"masking.hammon", 0.02, 1e-4},
    {"masking.disney_remap", 0.02, 1e-4},
    {"masking.disney_coat", 0.02, 1e-4},
    {"masking.unity_mobile", 0.02, 1e-4},
    {"masking.unity_mobile.urp", 0.02, 1e-4},
    {"masking.kelemen", 0.02, 1e-4},
    {"masking.neumann", 0.02, 1e-4},
    {"fresnel.schlick", 0.02, 1e-4},
    {"fresnel.schlick.f90", 0.02, 1e-4},
    {"fresnel.schlick.weighted", 0.02, 1e-4},
    {"fresnel.dielectric", 0.02, 1e-4},
    {"diffuse.disney", 0.02, 1e-4},
    {"diffuse.frostbite", 0.02, 1e-4},
};

/// A value that a half holds with all its digits, and not within 2 % of where it is infinite.
bool is_normal_in_half(double x) {
  return 0x1p-14 <= x && x < 0.98 * 65504;
}

TEST(StableForms, OfSumsProductsQuotientsAndRootsKeepTheirPercentInHalf) {
  for (const auto& of : in_half_terms) {
    const std::size_t t = find_term(of.id);
    HardDraws draws(t, of.least_width);
    double worst = 0;
    for (int i = 0; i < 20000; ++i) {
      const Sample s = draw<Half>(draws, catalogue()[t]);
      const double truth = value_in(Number::double_, t, s);
      if (!is_normal_in_half(truth)) continue;
      const double error = std::abs(value_in(Number::half, t, s) / truth - 1);
      worst = std::max(worst, error);
      ASSERT_LE(error, of.tolerance) << of.id << text(s) << ": " << truth;
    }
    RecordProperty(fmt::format("{} from {}", of.id, of.least_width), fmt::format("{:.5f}", worst));
  }
}

TEST(StableForms, HaveAValueInHalfWhereTheTruthHas) {
  for (std::size_t t = 0; t < catalogue().size(); ++t) {
    const auto& term = catalogue()[t];
    // Of a product of cosines below 6e-5 no half has the digits.
    if (term.as_shipped || term.id() == "masking.cook_torrance" ||
        term.id() == "masking.smith_beckmann.rational")
      continue;
    HardDraws draws(t, 1e-4);
    for (int i = 0; i < (is_dear(term.id()) ? 200 : 4000); ++i) {
      const Sample s = draw<Half>(draws, term);
      const double value = value_in(Number::half, t, s);
      EXPECT_FALSE(std::isnan(value) || value < 0) << term.id() << text(s) << ": " << value;
      // GTR overflows before it should where t^−γ does; anisotropic GGX where α_y < α_x⁶ᐟ⁵.
      if (value_in(Number::double_, t, s) < 0.25 * 65504 && term.id() != "ndf.gtr") {
        EXPECT_TRUE(std::isfinite(value)) << term.id() << text(s);
      }
    }
  }
}

}  // namespace
}  // namespace gonio
