#include "integrate/aperture/aperture_angles.h"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace gonio {
namespace {

/// D V F of GGX with F = 1, written again; alpha of x and y.
double lobe(const FrameAngles<double>& a, double alpha_x, double alpha_y) {
  const double x = a.xoh / alpha_x, y = a.yoh / alpha_y, t = x * x + y * y + a.noh * a.noh;
  const double d = 1 / (std::numbers::pi * alpha_x * alpha_y * t * t);
  const double alpha2 = alpha_x * alpha_y;
  const auto lambda = [&](double c) { return c + std::sqrt(alpha2 + (1 - alpha2) * c * c); };
  return d / (lambda(a.nol) * lambda(a.nov));
}
/// ... of isotropic surfaces, without a frame.
double lobe(const Angles<double>& a, double alpha) {
  const double alpha2 = alpha * alpha, t = alpha2 * (1 - a.sin2_theta_h) + a.sin2_theta_h;
  const auto lambda = [&](double c) { return c + std::sqrt(alpha2 + (1 - alpha2) * c * c); };
  return alpha2 / (std::numbers::pi * t * t * lambda(a.nol) * lambda(a.nov));
}

/// Mean over the cones by pairs of directions drawn at random.
template <class F>
double drawn(const DirectionPair& p, const Aperture& aperture, std::size_t n, const F& f) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform;
  const auto within = [&](const Direction& axis, double width) {
    const double z = 2 * std::pow(std::sin(width / 4), 2) * uniform(random),
                 r = std::sqrt(z * (2 - z));
    const double phi = 2 * std::numbers::pi * uniform(random), theta = theta_of(axis),
                 turn = phi_of(axis);
    // about +z, then tilted to the axis
    const double x = r * std::cos(phi), y = r * std::sin(phi), c = 1 - z;
    const double tilted = x * std::cos(theta) + c * std::sin(theta);
    return Direction{tilted * std::cos(turn) - y * std::sin(turn),
                     tilted * std::sin(turn) + y * std::cos(turn),
                     c * std::cos(theta) - x * std::sin(theta)};
  };
  double sum = 0, weight = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const DirectionPair q{within(p.wi, aperture.light), within(p.wo, aperture.detector)};
    if (!(q.wi.z > 0 && q.wo.z > 0)) continue;
    sum += q.wi.z * q.wo.z * f(frame_angles(q));
    weight += q.wi.z * q.wo.z;
  }
  return sum / weight;
}

template <class F>
double by_rule(const ApertureAngles& a, std::size_t i, const F& f) {
  double sum = 0;
  for (std::size_t k = a.begin(i); k < a.end(i); ++k) sum += a.weight(k) * f(a.angles(k));
  return sum;
}

std::vector<DirectionPair> mirror_pairs() {
  std::vector<DirectionPair> all;
  for (const double theta_i : {0.0, 30.0, 75.0})
    for (const double off : {-40.0, -8.0, -2.0, -0.2, 0.0, 0.4, 1.0})
      for (const double phi : {0.0, 0.3}) {
        if (theta_i + off < 0 || theta_i + off > 85) continue;
        all.push_back({direction(theta_i * degree, 0),
                       direction((theta_i + off) * degree, (180 + phi) * degree)});
      }
  return all;
}

/// RMS and greatest relative error of the rules.
struct Off {
  double rms = 0, most = 0;
};
template <class F>
Off off(const Aperture& aperture, bool frame, const F& f) {
  const auto where = mirror_pairs();
  const ApertureAngles a(
      where.size(), [&](std::size_t i) { return where[i]; }, aperture, frame);
  Off o;
  for (std::size_t i = 0; i < where.size(); ++i) {
    const double error = std::abs(by_rule(a, i, f) / drawn(where[i], aperture, 100'000, f) - 1);
    o.rms += error * error / static_cast<double>(where.size());
    o.most = std::max(o.most, error);
  }
  o.rms = std::sqrt(o.rms);
  return o;
}

TEST(ApertureAngles, AverageNarrowLobesAsManyDirectionsDo) {
  for (const Aperture aperture : {Aperture{0.7 * degree, 0.7 * degree}, Aperture{0, 0.3 * degree},
                                  Aperture{6 * degree, 2 * degree},
                                  Aperture{20 * degree, 8 * degree}, Aperture{40 * degree, 0}})
    for (const double alpha : {0.003, 0.01, 0.1, 0.5}) {
      if (alpha < (aperture.light + aperture.detector) / 8) continue;
      const auto [rms, most] =
          off(aperture, false, [&](const Angles<double>& x) { return lobe(x, alpha); });
      EXPECT_LT(rms, 0.01) << aperture.light / degree << "° " << alpha;
      EXPECT_LT(most, 0.03) << aperture.light / degree << "° " << alpha;
    }
}

TEST(ApertureAngles, AverageAnisotropicLobesAsManyDirectionsDo) {
  for (const auto& [x, y] : {std::pair{0.01, 0.03}, std::pair{0.1, 0.02}}) {
    const auto [rms, most] = off({0.7 * degree, 0.7 * degree}, true,
                                 [&](const FrameAngles<double>& s) { return lobe(s, x, y); });
    EXPECT_LT(rms, 0.012) << x;
    EXPECT_LT(most, 0.04) << x;
  }
}

TEST(ApertureAngles, AreOneWhereNothingIsAveragedOver) {
  const auto where = mirror_pairs();
  const ApertureAngles a(
      where.size(), [&](std::size_t i) { return where[i]; }, {1e-9, 0}, false);
  std::size_t alone = 0;
  for (std::size_t i = 0; i < where.size(); ++i) {
    double sum = 0;
    for (std::size_t k = a.begin(i); k < a.end(i); ++k) sum += a.weight(k);
    EXPECT_NEAR(sum, 1, 1e-12);
    alone += a.end(i) - a.begin(i) == 1;
  }
  EXPECT_GT(alone, where.size() / 2);
}

}  // namespace
}  // namespace gonio
