// What the catalogue's forms keep over the hard domain: found by looking, so that a form that
// begins to lose digits is seen.
#include <span>
#include <string_view>

#include "many_fits.h"
#include "stability/answer.h"

#include <gtest/gtest.h>

namespace gonio::stability {
namespace {

Subject subject(std::string_view id) {
  return subjects_of(id).at(0);
}

/// Units that a form may lose for each that its inputs' own rounding is worth.
struct Target {
  std::string_view id;
  double most;
};
constexpr double target = 8;
/// Forms of exp, of nine operations in a row and of one cancellation that is left miss it by little.
constexpr Target targets[] = {{"ndf.ggx", target},
                              {"ndf.gtr1", target},
                              {"masking.smith_ggx.separable", target},
                              {"masking.smith_ggx.correlated", target},
                              {"masking.smith_ggx_aniso.correlated", target},
                              {"masking.ue_joint", target},
                              {"fresnel.schlick", target},
                              {"ndf.ggx_aniso", 9},
                              {"ndf.beckmann", 11},
                              {"fresnel.dielectric", 15}};

TEST(Targets, FloatAndDoubleLoseFewUnitsBeyondWhatTheInputsOwnRoundingIsWorth) {
  for (const auto& t : std::span(targets).first(test::few(std::size(targets))))
    for (const auto number : {Number::float_, Number::double_}) {
      const auto s = subject(t.id);
      const auto l = look(s, {number, false, false}, 1e-4, 1);
      EXPECT_LE(l.beyond.value, t.most)
          << t.id << " in " << name_of(number) << " at " << text_of(s, l.beyond.at);
      EXPECT_EQ(l.no_value.count, 0U) << t.id << " in " << name_of(number);
      EXPECT_EQ(l.negative.count, 0U) << t.id << " in " << name_of(number);
    }
}

TEST(Targets, TheDistributionOfGgxKeepsHalfAPerCentInHalvesFromAWidthOf5PerCentOn) {
  auto s = subject("ndf.ggx");
  set_domain(s, "alpha", {0.05, test::few(2) == 2 ? 1 : 0.051});
  const auto l = look(s, {Number::half, false, false}, 0.005, 1);
  EXPECT_EQ(l.evidence, Evidence::exhaustive);
  EXPECT_LE(l.relative.value, 0.005);
  EXPECT_EQ(l.no_value.count, 0U);
}

}  // namespace
}  // namespace gonio::stability
