#include "fitting/export/materialx_layers.h"

#include <cmath>
#include <numbers>

#include "geometry/half_difference.h"

namespace gonio {
namespace {

/// ∫ f cos θ_i dω_i for a viewer, by midpoints.
double albedo(const MaterialxSurface& s, double theta_o) {
  constexpr int rows = 160, columns = 160;
  std::vector<FrameAngles<double>> angles;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const double sin2 = (i + 0.5) / rows;  // even in sin²θ: weight π/n
      angles.push_back(frame_angles(
          {direction(std::asin(std::sqrt(sin2)), 2 * std::numbers::pi * (j + 0.5) / columns),
           direction(theta_o, 0)}));
    }
  double sum = 0;
  const auto values = evaluate(s, angles);
  for (const double f : values[0]) sum += f;
  return sum * std::numbers::pi / (rows * columns);
}

MaterialxLayer layer(double alpha, LayerFresnel f, double f0) {
  return {alpha, alpha, 0, 1, {{std::move(f), f0, 1, 1}}};
}

TEST(MaterialxLayers, AreLambertWithoutALayer) {
  EXPECT_NEAR(albedo({{}, {0.6}}, 0.5), 0.6, 1e-12);
}

TEST(MaterialxLayers, GiveBackWhatFacetsKeepUpToMaterialxsFitOfIt) {
  const LayerFresnel mirror = [](const Angles<double>&) { return 1.0; };
  for (const double alpha : {0.2, 0.5, 1.0})
    for (const double theta : {0.2, 1.0}) {
      const double all = albedo({{layer(alpha, mirror, 1)}, {0}}, theta);
      EXPECT_NEAR(all, 1, 0.06) << alpha << " " << theta;
    }
}

TEST(MaterialxLayers, LetThroughWhatTheyDoNotReflect) {
  for (const double theta : {0.2, 1.0}) {
    const double glass = albedo({{layer(0.3, dielectric_layer(1.5), 0.04)}, {0}}, theta);
    const double white = albedo({{layer(0.3, dielectric_layer(1.5), 0.04)}, {1}}, theta);
    EXPECT_NEAR(white, 1, 0.03) << theta;
    EXPECT_LT(glass, 0.25);
  }
}

TEST(MaterialxLayers, HaveTheRatioOfTheirWidthsAlongTheTangent) {
  const LayerFresnel mirror = [](const Angles<double>&) { return 1.0; };
  const auto at = [&](double tangent, double phi) {
    MaterialxLayer l = layer(0.1, mirror, 1);
    l.alpha_x = 0.4, l.tangent_deg = tangent;
    return evaluate(MaterialxSurface{{l}, {0}},
                    std::vector{frame_angles({direction(0.6, phi * degree),
                                              direction(0.2, (phi + 180) * degree)})})[0][0];
  };
  EXPECT_GT(at(0, 0), 4 * at(0, 90)) << "wide along the tangent";
  EXPECT_NEAR(at(30, 30), at(0, 0), 1e-9 * at(0, 0));
}

}  // namespace
}  // namespace gonio
