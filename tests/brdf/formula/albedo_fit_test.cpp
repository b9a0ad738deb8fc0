// The fits of GGX's albedo that shaders evaluate, and how far they are off.
#include <algorithm>
#include <array>
#include <cmath>

#include "brdf/catalogue/registry.h"
#include "brdf/formula/scattering.h"
#include "integrate/albedo/ggx_albedo.h"
#include "integrate/light/split_sum.h"

namespace gonio {
namespace {

/// E over roughness in [0.05, 1] and √NoV in [0, 1].
struct AlbedoAt {
  double alpha, nov, e;
};
std::vector<AlbedoAt> samples(int roughnesses, int cosines) {
  std::vector<AlbedoAt> all;
  for (int i = 0; i <= roughnesses; ++i)
    for (int j = 0; j <= cosines; ++j) {
      const double alpha = square(0.05 + 0.95 * i / roughnesses), nov = square(1.0 * j / cosines);
      all.push_back(
          {alpha, nov, j == 0 ? 1 : ggx_albedo(alpha, nov, SmithGgx::correlated, 1e-7).value});
    }
  return all;
}

struct Errors {
  double worst = 0, rms = 0;
};
template <class Fit>
Errors errors_of(const std::vector<AlbedoAt>& at, const Fit& fit) {
  Errors e;
  for (const auto& s : at) {
    const double off = std::abs(fit(s.alpha, s.nov) - s.e);
    e.worst = std::max(e.worst, off);
    e.rms += off * off / static_cast<double>(at.size());
  }
  e.rms = std::sqrt(e.rms);
  return e;
}

double fitted(double alpha, double nov) {
  return AlbedoFit<double>::apply(std::array{alpha, nov})[0];
}

TEST(AlbedoFit, IsOffByWhatItSays) {
  const auto e = errors_of(samples(95, 200), fitted);
  EXPECT_LE(e.worst, 0.0049);
  EXPECT_GE(e.worst, 0.0048);
  EXPECT_NEAR(e.rms, 0.0024, 0.0001);
  const auto in_float = errors_of(samples(38, 80), [](double alpha, double nov) {
    const std::array p{static_cast<float>(alpha), static_cast<float>(nov)};
    return static_cast<double>(AlbedoFit<float>::apply(p)[0]);
  });
  EXPECT_LE(in_float.worst, 0.0049);
}

TEST(AlbedoFit, IsNoWorseOnSmootherSurfacesAndNeverAboveOne) {
  for (double alpha = 1e-4; alpha < 0.0025; alpha *= 1.3)
    for (double t = 0; t <= 1; t += 0.01) {
      const double nov = std::min(1.0, alpha * (1 / std::max(t, alpha / (1 + alpha)) - 1));
      const double truth = nov > 0 ? ggx_albedo(alpha, nov).value : 1;
      EXPECT_NEAR(fitted(alpha, nov), truth, 0.0049) << alpha << " " << nov;
    }
  for (const auto& s : samples(95, 200)) EXPECT_LE(fitted(s.alpha, s.nov), 1) << s.alpha << s.nov;
}

/// Linear least squares by the normal equations, Cholesky's way; a's lower half is overwritten.
constexpr std::size_t terms = 12;
using Row = std::array<double, terms>;
Row solve(std::array<Row, terms> a, Row b) {
  for (std::size_t i = 0; i < terms; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = a[i][j];
      for (std::size_t k = 0; k < j; ++k) sum -= a[i][k] * a[j][k];
      a[i][j] = i == j ? std::sqrt(sum) : sum / a[j][j];
    }
    for (std::size_t k = 0; k < i; ++k) b[i] -= a[i][k] * b[k];
    b[i] /= a[i][i];
  }
  for (std::size_t i = terms; i-- > 0;) {
    for (std::size_t k = i + 1; k < terms; ++k) b[i] -= a[k][i] * b[k];
    b[i] /= a[i][i];
  }
  return b;
}

/// The least worst error, by Lawson's weights: each time as many times more as a sample is off.
TEST(AlbedoFit, IsTheBestOfItsForm) {
  const auto at = samples(38, 80);
  std::vector<Row> rows;
  for (const auto& s : at) {
    const double t = s.alpha / (s.alpha + s.nov), pre = t * t * (1 - t);
    const double rough = pre * s.alpha * s.alpha, rougher = rough * s.alpha * t * t;
    rows.push_back({pre * t, pre * t * t, pre * std::pow(t, 3), pre * std::pow(t, 4), rough,
                    rough * t, rough * t * t, rough * std::pow(t, 4), rougher, rougher * t,
                    rougher * t * t, rougher * std::pow(t, 3)});
  }
  Row scale{}, best{};
  for (const auto& row : rows)
    for (std::size_t k = 0; k < terms; ++k) scale[k] = std::max(scale[k], std::abs(row[k]));
  std::vector<double> weight(rows.size(), 1);
  double least = 1;
  for (int pass = 0; pass < 200; ++pass) {
    std::array<Row, terms> a{};
    Row b{};
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (std::size_t j = 0; j < terms; ++j) {
        const double w = weight[i] * rows[i][j] / scale[j];
        b[j] += w * (1 - at[i].e);
        for (std::size_t k = 0; k <= j; ++k) a[j][k] += w * rows[i][k] / scale[k];
      }
    auto c = solve(a, b);
    for (std::size_t k = 0; k < terms; ++k) c[k] /= scale[k];
    double worst = 0, most = 0;
    std::vector<double> off;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      double loss = 0;
      for (std::size_t k = 0; k < terms; ++k) loss += c[k] * rows[i][k];
      off.push_back(std::abs(loss - (1 - at[i].e)));
      worst = std::max(worst, off.back());
    }
    if (worst < least) least = worst, best = c;
    for (std::size_t i = 0; i < rows.size(); ++i)
      most = std::max(most, weight[i] *= off[i] / worst + 0.01);
    for (auto& w : weight) w /= most;
  }
  EXPECT_NEAR(errors_of(at, fitted).worst, least, 1e-5)
      << "should be " << testing::PrintToString(best);
}

TEST(AlbedoFitMaterialx, IsOffByWhatIsSaidOfIt) {
  const auto e = errors_of(samples(95, 200), [](double alpha, double nov) {
    return AlbedoFitMaterialx<double>::apply(std::array{alpha, nov})[0];
  });
  EXPECT_NEAR(e.worst, 0.127, 0.001);
  EXPECT_NEAR(e.rms, 0.018, 0.001);
  double a = 0, b = 0;
  for (const double roughness : {0.05, 0.1, 0.2, 0.3, 0.5, 0.75, 1.0}) {
    std::vector<double> nov;
    for (int j = 1; j <= 40; ++j) nov.push_back(square(j / 40.0));
    const auto truth = split_sum("smith_ggx.correlated", roughness, nov, {1e-5, 100'000});
    for (std::size_t j = 0; j < nov.size(); ++j) {
      const auto fit = AlbedoFitMaterialx<double>::apply(std::array{square(roughness), nov[j]});
      a = std::max(a, std::abs(fit[1] - truth[j].a));
      b = std::max(b, std::abs(fit[2] - truth[j].b));
    }
  }
  EXPECT_NEAR(a, 0.0994, 0.0005);
  EXPECT_NEAR(b, 0.0450, 0.0005);
}

}  // namespace
}  // namespace gonio
