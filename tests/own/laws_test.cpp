// Laws are looked at over all parameters together.
#include "reports/own/laws.h"

#include "own/own_shaders.h"

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

}  // namespace
}  // namespace gonio
