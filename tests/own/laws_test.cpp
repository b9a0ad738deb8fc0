// Laws are looked at over all parameters together.
#include "reports/own/laws.h"

#include "own/own_shaders.h"
#include "refusal.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

TEST(OwnLaws, WhatBreaksOnlyWhereTwoParametersLeaveTheirDefaultsIsSeen) {
  SKIP_WITHOUT_SHADERS;
  const auto off = [](const std::string& times) {
    const OwnModel own(model_of("float kd 0 1 1, float b 0 1 0",
                                "vec3((kd + (1.0 - kd) * b * " + times + ") / PI)"),
                       "{includes=nothing}");
    return laws_of(own.function, own.term).reciprocity->value;
  };
  EXPECT_GT(off("NoL"), 0.5);
  EXPECT_LT(off("NoL * NoV"), 1e-9);
}

TEST(OwnLaws, AParameterWithOneValueAtBothEndsChangesSomething) {
  SKIP_WITHOUT_SHADERS;
  const auto a = audited(
      "// f0 0 1 0.04\nfloat F_Schlick(float f0, float VoH) { return f0 * (1.0 - f0) * pow(1.0 - "
      "VoH, 5.0); }\n");
  EXPECT_TRUE(a.laws.without_effect.empty());
  const auto log2 = audited(
      "// alpha 0.1 1 0.5\nfloat D_GTR1(float NoH, float alpha) { float a2 = alpha * alpha; return "
      "(a2 - 1.0) / (3.14159265358979 * log2(a2) * (1.0 + (a2 - 1.0) * NoH * NoH)); }\n");
  EXPECT_TRUE(log2.laws.without_effect.empty()) << "it has no value at one end";
  EXPECT_HAS(slips(log2), "log2 stands below where ln belongs");
}

TEST(OwnLaws, AFresnelTermAboveOneIsSaid) {
  SKIP_WITHOUT_SHADERS;
  const auto of = [](const std::string& value) {
    return text_of(audited("// f0 0 1 0.04\nfloat F_Schlick(float f0, float VoH) { return " +
                           value + "; }\n"));
  };
  EXPECT_HAS(of("f0 + (1.0 + f0) * pow(1.0 - VoH, 5.0)"), "above 1         3 at f0 1");
  EXPECT_EQ(of("f0 + (1.0 - f0) * pow(1.0 - VoH, 5.0)").find("above 1"), std::string::npos);
}

}  // namespace
}  // namespace gonio
