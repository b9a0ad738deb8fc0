#pragma once
/// \file
/// Tables for the tests of this room.

#include <cstdint>
#include <random>

#include "geometry/half_difference.h"
#include "table/format/formats.h"

namespace gonio::test {

/// f(angles, channel) on a grid.
template <class F>
Table on_grid(const Grid& g, std::string format, std::vector<std::string> channels, F f) {
  Table t;
  t.format = std::move(format);
  t.where = g;
  t.channels = std::move(channels);
  t.negative_is_noise = t.format != "merl";
  const SampleAngles at(t);
  for (std::size_t c = 0; c < t.channels.size(); ++c) {
    auto& plane = t.values.emplace_back(g.size());
    for (std::size_t i = 0; i < plane.size(); ++i) plane[i] = f(at(i), c);
  }
  return t;
}

/// kd/π + GGX with separable-free shape: D(θ_h)/4, enough to have a peak of known alpha.
inline double lobe(const Angles<double>& a, double alpha, double kd) {
  const double a2 = alpha * alpha, q = a.noh * a.noh * a2 + a.sin2_theta_h;
  return kd / std::numbers::pi + a2 / (std::numbers::pi * q * q) / 4;
}

inline Table merl_example(double alpha = 0.2, Bins bins = Bins::centre, bool reciprocal = true) {
  return on_grid(merl_grid(bins, reciprocal), "merl", {"r", "g", "b"},
                 [&](const auto& a, std::size_t c) {
                   return lobe(a, alpha, 0.1 * static_cast<double>(c + 1));
                 });
}
inline Table mbsdf_example(std::size_t n_theta = 12, std::size_t n_phi = 19) {
  return on_grid(mbsdf_grid(n_theta, n_phi, Bins::centre), "mbsdf", {"r", "g", "b"},
                 [&](const auto& a, std::size_t c) {
                   return static_cast<double>(
                       static_cast<float>(lobe(a, 0.3, 0.1 * static_cast<double>(c + 1))));
                 });
}
inline Table slice_example() {
  return on_grid(image_slice_grid(20, 15, 1.0, Bins::edge), "exr", {"g", "r", "x"},
                 [&](const auto& a, std::size_t c) {
                   return static_cast<double>(
                       static_cast<float>(lobe(a, 0.3, 0.1 * static_cast<double>(c + 1))));
                 });
}
inline Table csv_example() {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> theta(0, 90), phi(-180, 360), value(-0.1, 3);
  Table t;
  t.format = "csv";
  t.channels = {"r", "532nm"};
  t.values.resize(2);
  DirectionList l;
  for (int i = 0; i < 50; ++i) {
    l.theta_i_deg.push_back(theta(random));
    l.phi_i_deg.push_back(phi(random));
    l.theta_o_deg.push_back(theta(random));
    l.phi_o_deg.push_back(phi(random));
    for (auto& v : t.values) v.push_back(value(random));
    t.weights.push_back(std::abs(value(random)));
  }
  t.where = l;
  return t;
}
inline Truth truth_example() {
  return {"lambert+ggx",        {{"alpha", {0.2}}, {"kd", {0.1, 0.2, 0.3}}}, 0.01, 1e-4, 0.5,
          18446744073709551615U};
}

}  // namespace gonio::test
