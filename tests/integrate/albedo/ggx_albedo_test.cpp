#include "integrate/albedo/ggx_albedo.h"

#include <cmath>
#include <string>

#include "base/error.h"
#include "brdf/model/model.h"
#include "constants.h"
#include "integrate/albedo/directional_albedo.h"

namespace gonio {
namespace {

using test::ln2;
constexpr SmithGgx maskings[] = {SmithGgx::correlated, SmithGgx::separable};

BoundModel white(SmithGgx masking, double alpha) {
  const std::string name = masking == SmithGgx::correlated ? "correlated" : "separable";
  return bind_model("ggx/smith_ggx." + name + "/schlick", {{"alpha", {alpha}}, {"f0", {1}}}, 1);
}

TEST(GgxAlbedo, AtAlphaOneIsTheClosedForm) {
  for (const double mu : {1e-6, 0.001, 0.05, 0.5, 1.0}) {
    const auto correlated = ggx_albedo(1, mu, SmithGgx::correlated, 1e-11);
    EXPECT_NEAR(correlated.value, 1 - mu * std::log(1 + 1 / mu), correlated.error) << mu;
    EXPECT_LE(correlated.error, 1e-11);
    const auto separable = ggx_albedo(1, mu, SmithGgx::separable, 1e-11);
    EXPECT_NEAR(separable.value, 2 * (1 - ln2) / (1 + mu), separable.error) << mu;
    EXPECT_LE(separable.error, 1e-11);
  }
}

TEST(GgxAlbedo, LosesAtRoughnessOneWhatWasMeasured) {
  EXPECT_NEAR(1 - ggx_albedo(1, 1).value, 0.693, 0.0005);
  EXPECT_NEAR(1 - ggx_average_albedo(1).value, 0.591, 0.0005);
  EXPECT_NEAR(1 - ggx_average_albedo(1, SmithGgx::separable).value, 0.623, 0.0005);
}

/// The other way integrates over slopes, in two dimensions, through the composed model.
TEST(GgxAlbedo, AgreesWithTheIntegralOverSlopes) {
  const std::vector<double> mu{0.001, 0.01, 0.1, 0.4, 0.8, 0.999999, 1};
  for (const auto masking : maskings)
    for (const double alpha : {1e-4, 1e-3, 0.02, 0.2, 0.6, 1.0}) {
      const auto slopes = directional_albedo(white(masking, alpha), mu);
      for (std::size_t i = 0; i < mu.size(); ++i) {
        const auto e = ggx_albedo(alpha, mu[i], masking);
        EXPECT_NEAR(e.value, slopes[i].value[0], e.error + slopes[i].error)
            << alpha << " " << mu[i];
        EXPECT_LE(e.error, 1e-8);
      }
    }
}

TEST(GgxAlbedo, ItsBoundIsTrueAndWhatWasAskedFor) {
  for (const auto masking : maskings)
    for (double alpha = 1e-4; alpha < 1.01; alpha *= std::pow(10, 0.25))
      for (double mu = 1e-6; mu < 1.01; mu *= std::pow(10, 0.2)) {
        const double a = std::min(alpha, 1.0), c = std::min(mu, 1.0);
        const auto truth = ggx_albedo(a, c, masking, 1e-13);
        ASSERT_LT(truth.error, 2e-13);
        for (const double goal : {1e-2, 1e-4, 1e-6, 1e-8}) {
          const auto e = ggx_albedo(a, c, masking, goal);
          EXPECT_LE(std::abs(e.value - truth.value), e.error + truth.error)
              << a << " " << c << " " << goal;
          EXPECT_LE(e.error, goal * 1.0001);
        }
      }
}

TEST(GgxAlbedo, AveragesToTheHemispheresAlbedo) {
  const auto correlated = ggx_average_albedo(1, SmithGgx::correlated, 1e-10);
  EXPECT_NEAR(correlated.value, 4 / 3.0 * (1 - ln2), correlated.error);
  EXPECT_LE(correlated.error, 1e-10);
  const auto separable = ggx_average_albedo(1, SmithGgx::separable, 1e-10);
  EXPECT_NEAR(separable.value, 4 * (1 - ln2) * (1 - ln2), separable.error);
  for (const auto masking : maskings) {
    const auto slopes = hemispherical_albedo(white(masking, 0.3), {1e-6, 1'000'000});
    const auto average = ggx_average_albedo(0.3, masking);
    EXPECT_NEAR(average.value, slopes.value[0], average.error + slopes.error);
  }
}

TEST(GgxAlbedo, OfATableIsThatOfItsEntries) {
  const std::vector<double> alpha{0.01, 0.5, 1}, mu{0.1, 0.7};
  const auto table = ggx_albedo_table(alpha, mu, SmithGgx::separable);
  ASSERT_EQ(table.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(table[i].value, ggx_albedo(alpha[i / 2], mu[i % 2], SmithGgx::separable, 1e-6).value);
    EXPECT_LE(table[i].error, 1e-6);
  }
}

TEST(GgxAlbedo, RefusesWhatIsOutOfRange) {
  for (const double mu : {0.0, -0.1, 1.0000001, std::nan("")})
    EXPECT_THROW(ggx_albedo(0.3, mu), Error) << mu;
  for (const double alpha : {0.0, 1.1, std::nan("")}) {
    EXPECT_THROW(ggx_albedo(alpha, 0.5), Error) << alpha;
    EXPECT_THROW(ggx_average_albedo(alpha), Error) << alpha;
    EXPECT_THROW(ggx_albedo_table({{alpha}}, {{0.5}}), Error) << alpha;
  }
}

}  // namespace
}  // namespace gonio
