// A clear layer on diffuse terms: its albedo is that of its values.
#include "validate/coat.h"

#include "geometry/half_difference.h"
#include "integrate/rule/quadrature.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

using validating::Coated;

BoundModel varnish(double kd) {
  return bind_model("lambert+ggx/smith_ggx.correlated/schlick",
                    {{"alpha", {0.5}}, {"f0", {0.1}}, {"kd", {kd}}}, 1);
}

TEST(Coat, HasTheAlbedoThatItsValuesAddUpTo) {
  for (const auto coating : {Coating::view, Coating::both}) {
    const Coated coat(varnish(0.7), coating);
    for (const double mu : {0.2, 0.9}) {
      constexpr int turns = 64;
      const auto nodes = cosine_hemisphere(48, turns);
      double sum = 0;
      for (std::size_t i = 0; i < nodes.size(); i += turns) {
        std::vector<FrameAngles<double>> ring;
        for (std::size_t k = i; k < i + turns; ++k)
          ring.push_back(frame_angles({nodes[k].direction, direction(std::acos(mu), 0)}));
        const auto f = coat.values(ring);
        for (std::size_t k = 0; k < turns; ++k) sum += nodes[i + k].weight * f[0][k];
      }
      EXPECT_NEAR(coat.albedos(std::vector{mu})[0][0], sum, 1e-3) << name_of(coating) << " " << mu;
    }
  }
}

TEST(Coat, GivesAllBackToTheViewOrIsReciprocal) {
  const std::vector<double> mu{0.05, 0.3, 1};
  for (const auto& albedo : Coated(varnish(1), Coating::view).albedos(mu))
    EXPECT_NEAR(albedo[0], 1, 1e-9);
  for (const auto& albedo : Coated(varnish(1), Coating::both).albedos(mu))
    EXPECT_LT(albedo[0], 0.98);
  const auto there = frame_angles({direction(0.3, 0), direction(1.2, 1)}),
             back = frame_angles({direction(1.2, 1), direction(0.3, 0)});
  const auto f = [&](Coating coating, const auto& angles) {
    return Coated(varnish(1), coating).values({angles})[0][0];
  };
  EXPECT_NEAR(f(Coating::both, there), f(Coating::both, back), 1e-12);
  EXPECT_GT(f(Coating::view, back) / f(Coating::view, there), 1.01);
}

}  // namespace
}  // namespace gonio
