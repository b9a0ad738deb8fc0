#include "stability/evaluate.h"

#include <cmath>
#include <numbers>

#include "brdf/catalogue/registry.h"
#include "brdf/model/evaluate.h"

#include <gtest/gtest.h>

namespace gonio::stability {
namespace {

Subject ggx(std::size_t form) {
  return subjects_of("ndf.ggx").at(form);
}

TEST(StabilityValue, OfGgxAtItsPeakIsOneOverPiAlphaSquared) {
  const std::array in{0.25, 0.0};
  EXPECT_NEAR(value_of(ggx(0), Number::double_, in), 16 / std::numbers::pi, 1e-14);
  EXPECT_NEAR(truth_of(ggx(0), in).value, 16 / std::numbers::pi, 1e-14);
}

TEST(StabilityValue, FollowsFromItsInputsInTheNumber) {
  // 1 − c² of a cosine next to 1: in half it is c's spacing, 2⁻¹⁰, where the true sine's square is
  // 2⁻¹⁰ − 2⁻²².
  const double c = 1 - 0x1p-11, alpha = 0.0625;
  const std::array in{alpha, c};
  const double s2 = 0x1p-10, t = alpha * alpha * c * c + s2;
  EXPECT_NEAR(value_of(ggx(1), Number::half, in), alpha * alpha / (std::numbers::pi * t * t),
              0.01 * value_of(ggx(1), Number::half, in));
  const auto truth = truth_of(ggx(1), in);
  const double true_s2 = (1 - c) * (1 + c), true_t = alpha * alpha * c * c + true_s2;
  EXPECT_NEAR(truth.value / (alpha * alpha / (std::numbers::pi * true_t * true_t)), 1, 1e-12);
}

TEST(StabilityValue, HasTheConditionOfItsInputs) {
  // D of the peak is 1/(π α²): two units for each of alpha's; sin²θ_h = 0 has no digits to lose.
  EXPECT_NEAR(truth_of(ggx(0), std::array{0.25, 0.0}).condition, 2, 1e-9);
  // Given NoH, a unit of its last digit moves the sine by far more.
  EXPECT_GT(truth_of(ggx(1), std::array{0.01, 1 - 1e-6}).condition, 1e4);
}

TEST(StabilityValue, IsOfInputsAsTheNumberHoldsThem) {
  const auto subject = ggx(0);
  EXPECT_EQ(rounded(subject, Number::half, std::array{0.1, 0.1})[0], 0.0999755859375);
  EXPECT_EQ(rounded(subject, Number::mixed, std::array{0.1, 0.1})[0], 0.0999755859375);
  EXPECT_EQ(rounded(subject, Number::mixed, std::array{0.1, 0.1})[1], static_cast<double>(0.1F));
}

TEST(StabilityValue, OfAModelIsTheProductOfItsTerms) {
  // Against the composed kernels, which the program evaluates models with.
  const auto bound = bind_model(
      "lambert.coupled+ggx/smith_ggx.correlated/schlick+beckmann/smith_beckmann.correlated/schlick",
      parse_settings(std::array<std::string, 1>{"alpha=0.3,kd=0.4,f0=0.05,alpha_2=0.6,f0_2=0.2"}),
      1);
  const auto s = subjects_of(to_text(bound.model.spec)).at(0);
  std::vector<double> in;
  for (const auto& p : bound.model.parameters) in.push_back(bound.values[p.first]);
  const std::array angles{0.7, 0.4, -0.3};
  in.insert(in.end(), angles.begin(), angles.end());
  const auto a = angles_of<double>(Given::directions, angles);
  const double want = evaluate(bound, std::span<const FrameAngles<double>>(&a, 1))[0][0];
  EXPECT_NEAR(value_of(s, Number::double_, in), want, 1e-14 * want);
  EXPECT_NEAR(truth_of(s, in).value, want, 1e-13 * want);
  EXPECT_NEAR(value_of(s, Number::half, in), want, 0.02 * want);
}

TEST(StabilityValue, IsOfHalvesFlushedAndContractedAsAsked) {
  const auto joint = subjects_of("masking.ue_joint").at(0);
  const std::array small{1e-6, 1.0, 5e-5};  // its divisor is a sum of subnormals
  const auto at = [&](const auto& in, bool flush, bool contract) {
    return value_of(joint, {Number::half, flush, contract}, in);
  };
  EXPECT_NEAR(at(small, false, false), 4949, 50);
  EXPECT_NEAR(at(small, false, true), 4949, 50);
  EXPECT_TRUE(std::isinf(at(small, true, false)));
  EXPECT_TRUE(std::isinf(at(small, true, true)));
  std::size_t contracted = 0, flushed = 0;
  for (int k = 1; k < 100; ++k) {
    const std::array in{0.3, 0.009 * k, 0.7};
    contracted += at(in, false, true) != at(in, false, false);
    EXPECT_EQ(at(in, true, true), at(in, false, true));
    flushed += at(in, true, false) != at(in, false, false);
  }
  EXPECT_GT(contracted, 10U);
  EXPECT_EQ(flushed, 0U);
}

TEST(StabilityValue, OfManyOperationsGetsAShareOfTheWork) {
  EXPECT_EQ(share_of_cheap(ggx(0)), 1);
  const double gtr = share_of_cheap(subjects_of("masking.smith_gtr.correlated").at(0));
  EXPECT_LT(gtr, 0.5);
  EXPECT_GT(gtr, 0);
  EXPECT_LT(share_of_cheap(subjects_of("ggx/smith_gtr.correlated/conductor").at(0)), gtr);
}

TEST(StabilityValue, IsToldByTheBitsOfItsInputs) {
  EXPECT_EQ(hex(Number::half, 1, true), "0x3c00");
  EXPECT_EQ(hex(Number::half, 0x1p-24, true), "0x0001");
  EXPECT_EQ(hex(Number::half, 0x1p-14, true), "0x0400");
  EXPECT_EQ(hex(Number::half, -65504, true), "0xfbff");
  EXPECT_EQ(hex(Number::half, INFINITY, true), "0x7c00");
  EXPECT_EQ(hex(Number::mixed, 1, false), "0x3f800000");
  EXPECT_EQ(hex(Number::double_, 1, false), "0x3ff0000000000000");
}

}  // namespace
}  // namespace gonio::stability
