#include "geometry/half_difference.h"

namespace gonio {
namespace {

Direction turn_y(const Direction& d, double angle) {
  const double s = std::sin(angle), c = std::cos(angle);
  return {c * d.x + s * d.z, d.y, -s * d.x + c * d.z};
}
Direction turn_z(const Direction& d, double angle) {
  const double s = std::sin(angle), c = std::cos(angle);
  return {c * d.x - s * d.y, s * d.x + c * d.y, d.z};
}

}  // namespace

DirectionPair directions(const HalfDifference& a) {
  const Direction d = direction(a.theta_d, a.phi_d);
  const auto place = [&](const Direction& v) { return turn_z(turn_y(v, a.theta_h), a.phi_h); };
  return {place(d), place({-d.x, -d.y, d.z})};
}

HalfDifference half_difference(const DirectionPair& p) {
  const Direction sum{p.wi.x + p.wo.x, p.wi.y + p.wo.y, p.wi.z + p.wo.z};
  HalfDifference a;
  a.theta_h = theta_of(sum);
  a.phi_h = std::hypot(sum.x, sum.y) > 0 ? phi_of(sum) : 0;
  const Direction d = turn_y(turn_z(p.wi, -a.phi_h), -a.theta_h);
  a.theta_d = theta_of(d);
  a.phi_d = std::hypot(d.x, d.y) > 0 ? phi_of(d) : 0;
  return a;
}

}  // namespace gonio
