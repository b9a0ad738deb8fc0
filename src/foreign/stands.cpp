// What a function stands for, by its names and its values.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "foreign/directions.h"
#include "foreign/guesses.h"

namespace gonio::foreign {

bool reads_angle(const Function& f, std::string_view name) {
  return std::ranges::any_of(f.programs,
                             [&](const Program& p) { return reads(p, true, angle(name)); });
}

std::vector<double> defaults_of(const Function& f) {
  std::vector<double> v;
  for (const auto& p : f.parameters) {
    const auto role = f.name.reading.arguments.find(p.name);
    const auto name = plain(role == f.name.reading.arguments.end() ? p.name : role->second);
    constexpr double of_glass = 1.5;
    v.push_back(!p.bounded && (name == "eta" || name == "ior") ? of_glass : p.start);
  }
  return v;
}

std::array<double, 11> angles_between(double theta_l, double phi, double theta_v, double turn) {
  const std::array l{std::sin(theta_l) * std::cos(phi + turn),
                     std::sin(theta_l) * std::sin(phi + turn), std::cos(theta_l)};
  const std::array v{std::sin(theta_v) * std::cos(turn), std::sin(theta_v) * std::sin(turn),
                     std::cos(theta_v)};
  std::array<double, 3> h{l[0] + v[0], l[1] + v[1], l[2] + v[2]};
  const double size = std::hypot(h[0], h[1], h[2]);
  for (double& x : h) x /= size;
  return {l[2], v[2], h[2], size / 2, h[0] * h[0] + h[1] * h[1], h[0], h[1],
          l[0], l[1], v[0], v[1]};
}

bool differ(double a, double b) {
  return std::abs(a - b) > 1e-6 * std::max(std::abs(a), std::abs(b));
}

namespace {

/// True of values that are 1 along the normal and never more, whatever the parameters: G by vectors, which has its half vector, too.
bool gives_whole_g(const Function& f) {
  std::vector<std::vector<double>> settings{defaults_of(f)};
  for (std::size_t k = 0; k < f.parameters.size(); ++k)
    for (const double end : {f.parameters[k].range.low, f.parameters[k].range.high}) {
      settings.push_back(settings[0]);
      settings.back()[k] = end;
    }
  constexpr double same = 1e-3;
  return std::ranges::all_of(settings, [&](const std::vector<double>& p) {
    const double along = value_of(f, p, angles_between(0, 0, 0, 0))[0];
    if (!(std::abs(along - 1) < same)) return false;
    for (const double l : {0.3, 0.9, 1.4})
      for (const double v : {0.3, 0.9, 1.4}) {
        const double g = value_of(f, p, angles_between(l, 2, v, 0))[0];
        if (!(g >= 0) || !(g <= 1 + same)) return false;
      }
    return true;
  });
}

/// True of a value that is 1/4 along the normal, or 1 where the 4 stands elsewhere, and only grows towards the horizon: V.
/// \param between  azimuth from light to view
bool gives_v(const Function& f, double between) {
  const auto p = defaults_of(f);
  double last = 0;
  for (const double theta : {0.0, 0.5, 1.0, 1.3, 1.5}) {
    const double v = value_of(f, p, angles_between(theta, between, theta, 0))[0];
    constexpr double guard = 1e-4;  // that shaders add below
    if (theta == 0 && std::abs(v - 0.25) > guard && std::abs(v - 1) > guard) return false;
    if (!(v > last)) return false;
    last = v;
  }
  return true;
}

}  // namespace

Stands stands_for(const Function& f) {
  const bool l = reads_angle(f, "nol"), v = reads_angle(f, "nov"), facing = reads_angle(f, "voh");
  bool frame = false;
  for (std::size_t k = angle("xol"); k < angle_names.size(); ++k)
    frame |= reads_angle(f, angle_names[k]);
  const bool half = reads_angle(f, "noh") || reads_angle(f, "sin2_theta_h") ||
                    reads_angle(f, "xoh") || reads_angle(f, "yoh");
  if (half && !l && !v && !facing && !frame) return Stands::distribution;
  const auto& said = f.name.reading.includes;
  if (said && (*said == "g" || *said == "v") && f.programs.size() == 1) return Stands::masking;
  const bool of_facing = facing && !l && !v && !half && !frame;
  const std::string n = plain(f.name.function);
  const bool named = n.starts_with("v") || n.starts_with("g") || n.find("smith") != n.npos ||
                     n.find("visib") != n.npos || n.find("geom") != n.npos ||
                     n.find("mask") != n.npos || n.find("shadow") != n.npos;
  if (of_facing)  // Kelemen's V has no other cosine
    return named && f.programs.size() == 1 && gives_v(f, std::numbers::pi) ? Stands::masking
                                                                           : Stands::fresnel;
  // Of two widths it takes the cosines with the tangent, too; what takes vectors may be a whole
  // model.
  const bool of_cosines = std::ranges::none_of(f.arguments, [](const Argument& a) {
    return a.stands_for == "L" || a.stands_for == "V" || a.stands_for == "H";
  });
  const auto takes = [&](std::string_view cosine) {
    return std::ranges::find(f.arguments, cosine, &Argument::stands_for) != f.arguments.end();
  };
  if (!l && !v && !half && !frame && named && takes("nol") && takes("nov") &&
      f.programs.size() == 1 &&
      !differ(value_of(f, defaults_of(f), angles_between(0, 0, 0, 0))[0], 0.25))
    return Stands::masking;  // the V of G = NoL NoV
  const bool is_g_by_name = named || f.name.function.ends_with('G') || n.find("torrance") != n.npos;
  if (l && v && is_g_by_name && f.programs.size() == 1 && n.find("diffuse") == n.npos &&
      gives_whole_g(f))
    return Stands::masking;
  const bool may_be = (l || v) && (!frame || (of_cosines && !half && !facing)) &&
                      f.programs.size() == 1 && n.find("diffuse") == n.npos;
  return may_be && (named || (l && v && of_cosines && !half && !facing && gives_v(f, 0)))
             ? Stands::masking
             : Stands::lobe;
}

namespace {

bool is_fresnel_by_name(const Function& f) {
  const std::string n = plain(f.name.function);
  return n.find("fresnel") != n.npos || n.find("schlick") != n.npos;
}

/// Light and view with a half vector of that zenith angle, turned about it.
std::array<double, 11> angles_about(double theta_h, double voh, double turn) {
  const double x = std::sin(theta_h), z = std::cos(theta_h), s = std::sqrt(1 - voh * voh);
  const std::array across{s * std::cos(turn) * z, s * std::sin(turn), -s * std::cos(turn) * x};
  const std::array l{voh * x + across[0], across[1], voh * z + across[2]};
  const std::array v{voh * x - across[0], -across[1], voh * z - across[2]};
  return {l[2], v[2], z, voh, x * x, x, 0, l[0], l[1], v[0], v[1]};
}

}  // namespace

bool depends_on_voh_only(const Function& f) {
  const auto takes = [&](std::string_view what) {
    return std::ranges::find(f.arguments, what, &Argument::stands_for) != f.arguments.end();
  };
  const bool half = takes("H"), l = takes("L"), v = takes("V");
  if (half ? !l && !v : !l || !v) return false;
  const bool named = is_fresnel_by_name(f) || f.name.function.starts_with("F_");
  if (!named && (!half || takes("N"))) return false;
  const auto p = defaults_of(f);
  constexpr double grazing = 1e-6, same = 1e-3;
  const double taken_out = f.includes.find("pi") == f.includes.npos ? 1 : std::numbers::pi;
  std::vector<double> last;
  bool varies = false;
  for (const double voh : {grazing, 0.2, 0.5, 0.8, 0.95}) {
    std::vector<double> here;
    for (const double theta : {0.05, 0.1})
      for (const double turn : {0.0, 1.0, 2.5}) {
        const auto value = value_of(f, p, angles_about(theta, voh, turn));
        if (here.empty()) here = value;
        for (std::size_t c = 0; c < value.size(); ++c)
          if (!std::isfinite(value[c]) || std::abs(value[c] - here[c]) > 1e-6 * std::abs(here[c]))
            return false;
      }
    for (double x : here) {
      x *= taken_out;
      if (!named && (!(x >= 0) || !(x <= 1 + same))) return false;
      if (!named && voh == grazing && !(x > 1 - same)) return false;
    }
    varies = varies || (!last.empty() && differ(last[0], here[0]));
    last = here;
  }
  return varies;
}

bool gives_fresnel(const Function& f) {
  const bool l = reads_angle(f, "nol"), v = reads_angle(f, "nov");
  if (l == v) return false;
  for (std::size_t k = 0; k < angle_names.size(); ++k)
    if (angle_names[k] != (l ? "nol" : "nov") && reads_angle(f, angle_names[k])) return false;
  const auto& said = f.name.reading.arguments;
  if (std::ranges::any_of(f.arguments, [&](const Argument& a) {
        return a.stands_for != "parameter" && (a.stands_for.size() == 1 || said.contains(a.name));
      }))
    return false;
  if (!is_fresnel_by_name(f) && std::ranges::none_of(f.arguments, [](const Argument& a) {
        return a.stands_for != "parameter" && plain(a.name).starts_with("cos");
      }))
    return false;
  const auto at = [&](double c) {
    const double theta = std::acos(c);
    return value_of(f, defaults_of(f), angles_between(theta, 0, theta, 0))[0];
  };
  constexpr double grazing = 1e-6, same = 1e-3, middle = 0.5;
  return std::abs(at(grazing) - 1) < same && at(1) < 1 - same && at(1) >= 0 &&
         at(middle) < 1 + same;
}

}  // namespace gonio::foreign
