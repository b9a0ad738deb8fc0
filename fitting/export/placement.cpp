#include "fitting/export/placement.h"

#include <algorithm>
#include <cmath>

#include "brdf/term/map.h"
#include "optics/f0.h"

namespace gonio {

std::vector<Placed> placements(const Surface& s) {
  std::vector<Placed> all;
  const auto add = [&](const SurfaceLobe* base, const SurfaceLobe* coat) {
    const bool metal = base && base->is_metal() && s.largest_kd() < 0.05;
    all.push_back({base, coat, metal});
    if (base && base->is_metal()) all.push_back({base, coat, !metal});
  };
  if (s.lobes.size() < 2) {
    add(s.lobes.empty() ? nullptr : &s.lobes[0], nullptr);
    return all;
  }
  const auto strength = [](const SurfaceLobe& l) { return l.weight * l.largest_f0(); };
  const bool ordered = strength(s.lobes[0]) >= strength(s.lobes[1]);
  add(&s.lobes[ordered ? 0 : 1], &s.lobes[ordered ? 1 : 0]);
  add(&s.lobes[ordered ? 1 : 0], &s.lobes[ordered ? 0 : 1]);
  return all;
}

bool GreyDielectric::is_grey() const {
  return std::ranges::all_of(tint, [](double t) { return t == 1; });
}
GreyDielectric grey_dielectric(const SurfaceLobe& l) {
  const auto same = [](const std::vector<double>& v) {
    return std::ranges::count(v, v[0]) == std::ssize(v);
  };
  const bool grey = same(l.eta) && same(l.k) && l.k[0] == 0;
  const double most = l.largest_f0();
  GreyDielectric g{grey ? l.eta[0] : mapped<IorFromF0, double>(std::min(most, 0.66))[0], l.f0};
  for (double& t : g.tint) t = grey || most == 0 ? 1 : t / most;
  return g;
}

Stretch stretch_of(const SurfaceLobe& l, double tangent_deg) {
  return l.alpha_x < l.alpha_y ? Stretch{l.alpha_y, l.alpha_x, tangent_deg + 90}
                               : Stretch{l.alpha_x, l.alpha_y, tangent_deg};
}
double half_turn_of(double tangent_deg) {
  return std::remainder(tangent_deg, 180);
}
double turns_of(double tangent_deg) {
  const double turns = tangent_deg / 360, half = turns - 0.5 * std::floor(turns / 0.5);
  return half < 0.25 ? half + 0.5 : half;
}

double fourth_root(double x) {
  return std::sqrt(std::sqrt(x));
}
double one_roughness(const SurfaceLobe& l) {
  return fourth_root(l.alpha_x * l.alpha_y);
}

std::vector<double> per_channel(const TargetParameters& p, std::string_view name, std::size_t n) {
  std::vector<double> v;
  for (std::size_t c = 0; c < n; ++c) v.push_back(parameter_in(p, name, c));
  return v;
}

FrameAngles<double> turned(FrameAngles<double> a, double c, double s) {
  const auto turn = [&](double& x, double& y) {
    const double along = x * c + y * s;
    y = y * c - x * s;
    x = along;
  };
  turn(a.xoh, a.yoh), turn(a.xol, a.yol), turn(a.xov, a.yov);
  return a;
}

}  // namespace gonio
