// Guards that take light: from narrow peaks and towards the horizon.
#include "reports/own/guards.h"

#include "own/own_shaders.h"
#include "refusal.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

TEST(Guards, WhatIsAddedBelowIsNamedWithTheAngleFromWhichItTakesATenth) {
  SKIP_WITHOUT_SHADERS;
  const auto with = [](const std::string& below) {
    return audited(replaced(tutorial("4.0"), "(4.0 * NoL * NoV)", below));
  };
  EXPECT_HAS(slips(with("(4.0 * NoL * NoV + 0.01)")),
             "0.01 is added to 4 NoL NoV: it is held down towards the horizon, by a tenth and more "
             "from 81.4° on");
  EXPECT_HAS(slips(with("max(4.0 * NoL * NoV, 0.1)")),
             "4 NoL NoV is held above 0.1: it is held down towards the horizon, by a tenth and "
             "more from 81.4° on");
  EXPECT_HAS(slips(with("(4.0 * NoL * NoV + 0.05)")), "0.05 is added to 4 NoL NoV");
  const auto little = with("max(4.0 * NoL * NoV, 0.001)");
  EXPECT_EQ(slips(little), "");
  EXPECT_HAS(text_of(little), "from 89.1° on, where light and view are mirrored; right where");
  EXPECT_EQ(text_of(with("(4.0 * NoL * NoV)")).find("horizon"), std::string::npos);
  EXPECT_EQ(text_of(with("(4.0 * NoL * NoV + 1e-5)")).find("horizon"), std::string::npos);
}

TEST(Guards, WhatIsAddedInAMaskingFunctionIsNamed) {
  SKIP_WITHOUT_SHADERS;
  const auto v = [](const std::string& value) {
    return audited(
        "// alpha 0.1 1 0.5\nfloat V_Smith(float NoL, float NoV, float alpha) {\n  float "
        "a2 = alpha * alpha, d = NoV * sqrt(NoL * NoL * (1.0 - a2) + a2) + NoL * "
        "sqrt(NoV * NoV * (1.0 - a2) + a2);\n  return " +
        value + ";\n}\n");
  };
  EXPECT_EQ(text_of(v("0.5 / d")).find("horizon"), std::string::npos);
  EXPECT_EQ(text_of(v("0.5 / max(d, 1e-6)")).find("horizon"), std::string::npos);
  const auto sum = v("0.5 / (d + 0.05)");
  EXPECT_EQ(nearest(sum), "masking.smith_ggx.correlated");
  EXPECT_HAS(slips(sum), "0.1 is added to 1/V: it is held down towards the horizon");
  EXPECT_HAS(slips(v("min(0.5 / d, 1.0)")), "V is held below 1");
}

TEST(Guards, AHalfVectorThatIsNormalisedInPartIsNamed) {
  SKIP_WITHOUT_SHADERS;
  const auto of = [](const std::string& half) {
    return slips(audited(replaced(tutorial("4.0"), "normalize(L + V)", half)));
  };
  EXPECT_HAS(of("L + V"), "its half vector is not normalised: it is L + V");
  EXPECT_HAS(of("L + V / length(L + V)"), "it is L + V/|L + V|");
  EXPECT_EQ(of("(L + V) / length(L + V)"), "");
  EXPECT_EQ(of("(L + V) * inversesqrt(dot(L + V, L + V))"), "");
}

TEST(Guards, AnAmountThatTakesLittleIsTheRoundestThatItMayBe) {
  SKIP_WITHOUT_SHADERS;
  EXPECT_HAS(text_of(audited(
                 replaced(tutorial("4.0"), "(4.0 * NoL * NoV)", "(4.0 * NoL * NoV + 0.0001)"))),
             "0.0001 is added to 4 NoL NoV");
}

}  // namespace
}  // namespace gonio
