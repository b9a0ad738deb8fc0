#include "fitting/plan/candidates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "geometry/vector.h"

namespace gonio {
namespace {

double distance(const Vector& a, const Vector& b) {
  return std::atan2(length(cross(a, b)), dot(a, b)) / degree;
}

/// Angle as an instrument is set to it.
double set_to(double angle) {
  return std::round(10 * angle / degree) / 10;
}

}  // namespace

bool is_in_plane_of_incidence(const Table& t) {
  const SampleAngles at(t);
  constexpr double out_of_it = 0.02;  // sine
  const double along_normal = std::sin(degree);
  bool leaves_normal = false;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const auto p = at.directions(i);
    const double sine = std::hypot(p.wi.x, p.wi.y);
    if (sine < along_normal) continue;  // any plane through the normal is its plane of incidence
    leaves_normal = true;
    if (std::abs(p.wi.x * p.wo.y - p.wi.y * p.wo.x) > out_of_it * sine) return false;
  }
  return leaves_normal;
}

DirectionList candidates(bool in_plane) {
  constexpr int tilts = 26, turns = 12;
  DirectionList l;
  std::set<std::array<double, 3>> seen;
  for (int d = 5; d <= 80; d += 5)
    for (int h = 0; h <= tilts; ++h)
      for (int turn = 0; turn < 2 * turns; turn += in_plane ? turns : 1) {
        const double theta_h = 80 * std::pow(h / double{tilts}, 2);
        const auto p = directions(
            HalfDifference{theta_h * degree, 0, d * degree, turn * std::numbers::pi / turns});
        const double theta_i = set_to(theta_of(p.wi)), theta_o = set_to(theta_of(p.wo));
        // What is alike under a mirror at the plane of incidence is one.
        const double between =
            std::abs(std::remainder(phi_of(p.wo) - phi_of(p.wi), 2 * std::numbers::pi));
        const double phi = theta_i == 0 || theta_o == 0 ? 180 : set_to(between);
        if (theta_i > most_grazing_deg || theta_o > most_grazing_deg) continue;
        const Direction light = direction(theta_i * degree, 0),
                        viewer = direction(theta_o * degree, phi * degree);
        if (distance(vector_of(light), vector_of(viewer)) < least_apart_deg - 0.2) continue;
        if (!seen.insert({theta_i, theta_o, phi}).second) continue;
        l.theta_i_deg.push_back(theta_i);
        l.phi_i_deg.push_back(0);
        l.theta_o_deg.push_back(theta_o);
        l.phi_o_deg.push_back(phi);
      }
  return l;
}

}  // namespace gonio
