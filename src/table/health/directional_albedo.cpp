#include "table/health/directional_albedo.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <tuple>
#include <utility>

#include "base/few.h"
#include "base/random.h"
#include "integrate/rule/quadrature.h"
#include "table/format/rgl/function.h"
#include "table/format/utia.h"
#include "table/grid_cell.h"
#include "table/health/around_one_light.h"
#include "table/health/key_counts.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace gonio {
namespace {

/// Values of each channel at a pair of directions; NaN where the table does not say.
struct Values3 {
  std::vector<double> f;
  /// Where they are asked for: what f may as well be between samples that far apart (their geometric mean on the flank of a
  /// highlight), and what every other sample would make of it.
  std::vector<double> otherwise, coarse;
  /// By which one half of the samples makes it more than the other does, of two halvings; empty where nobody says.
  std::vector<std::array<double, 2>> apart;
};
using Between = std::function<void(const DirectionPair&, bool all, Values3&)>;

/// Mean over half vectors in polar coordinates, densest at the highlight, times π.
/// Less than half of the hemisphere says nothing about its mean: noisy dark channels keep their peak.
///
///   ∫ f cos θ_o dω_o = ∫ dψ ∫₀^end dθ_h 4 VoH f NoL sin θ_h,   θ_h = end x³
///
/// The error is the sum of six: what two rules of every other node differ by; what it changes, at every fourth node, to
/// interpolate logarithms, since between samples on the flank of a highlight the surface lies between the two; half of what it
/// changes to leave out every other sample, which makes errors of interpolation four times as large; what two halves
/// of the samples differ by, the more of two halvings, which a ridge makes that few of them meet; what lacks, which may be twice what it is nearest to; and half a thousandth at the horizon, where samples end.
AlbedoSample integrate(double theta_i_deg, std::size_t channels, const Between& between) {
  constexpr std::size_t radii = 96, rays = 64;
  constexpr double pi = std::numbers::pi;
  const Direction wi = direction(theta_i_deg * degree, 0);
  const double slope = wi.x / wi.z;
  struct Sums {
    std::array<double, 2> value{}, weight{};          // of every other node
    double otherwise = 0, coarse = 0, looked_at = 0;  // differences
    std::array<double, 2> halves{};
    double beside = 0;  // weight × value nearest to what lacks
    double lacks = 0, pending = 0,
           last = 0;  // weights; those of a ray before its first value; that value
  };
  std::vector<Sums> sums(channels);
  const std::vector<double> nothing(channels);
  Values3 here{nothing, nothing, nothing, {}};
  std::array<double, 2> all_nodes{};
  for (std::size_t j = 0; j < rays; ++j) {
    const double psi = 2 * pi * (static_cast<double>(j) + 0.5) / rays, k = slope * std::cos(psi),
                 root = std::hypot(k, 1.0), end = std::atan(k > 0 ? k + root : 1 / (root - k));
    for (auto& s : sums) s.pending = 0, s.last = std::nan("");
    for (std::size_t i = 0; i < radii; ++i) {
      const double x = (static_cast<double>(i) + 0.5) / radii, theta = end * x * x * x;
      const Direction h = direction(theta, psi);
      const double voh = dot(wi, h);
      const Direction wo{2 * voh * h.x - wi.x, 2 * voh * h.y - wi.y, 2 * voh * h.z - wi.z};
      const double weight = 12 * voh * std::max(wo.z, 0.0) * std::sin(theta) * end * x * x;
      if (!(weight > 0)) continue;
      all_nodes[(i + j) % 2] += weight;
      const bool all = (i + 2 * j) % 4 == 0;
      between({wi, wo}, all, here);
      for (std::size_t c = 0; c < channels; ++c) {
        Sums& s = sums[c];
        const double f = here.f[c];
        if (!std::isfinite(f)) {
          s.lacks += weight;
          if (std::isnan(s.last))
            s.pending += weight;
          else
            s.beside += weight * s.last;
          continue;
        }
        s.beside += s.pending * f;
        s.pending = 0, s.last = f;
        s.value[(i + j) % 2] += weight * f;
        s.weight[(i + j) % 2] += weight;
        if (!all) continue;
        s.looked_at += weight;
        if (std::isfinite(here.otherwise[c])) s.otherwise += weight * (here.otherwise[c] - f);
        if (std::isfinite(here.coarse[c])) s.coarse += weight * (here.coarse[c] - f);
        if (!here.apart.empty())
          for (const bool second : {false, true})
            s.halves[second] += weight * here.apart[c][second];
      }
    }
  }
  const double whole = all_nodes[0] + all_nodes[1];
  AlbedoSample a{theta_i_deg, 0, {}, 1, 0};
  for (const auto& s : sums) {
    const auto& [v, w] = std::tie(s.value, s.weight);
    const double all = w[0] + w[1], mean = (v[0] + v[1]) / all;
    a.albedo.push_back(all > whole / 2 ? pi * mean : std::nan(""));
    a.coverage = std::min(a.coverage, all / whole);
    if (!(all > whole / 2)) continue;
    const double halves = std::abs(v[0] / w[0] - v[1] / w[1]);
    const double apart = (std::abs(s.otherwise) + std::abs(s.coarse) / 2 +
                          std::max(std::abs(s.halves[0]), std::abs(s.halves[1]))) /
                         std::max(s.looked_at, 1e-300);
    const double lacks =
        std::max(std::abs(2 * s.beside - mean * s.lacks), mean * s.lacks / 2) / whole;
    constexpr double constant = 1e-6, at_horizon = 5e-4;
    const double horizon = halves + apart > constant * mean ? at_horizon * mean : 0;
    a.error = std::max(a.error, pi * (halves + apart + lacks + horizon));
  }
  return a;
}

/// Sum over the patches that a list's values are means of, exact, from the incident patch nearest to θ_i.
AlbedoSample sum_of_patches(const Table& t, double theta_i_deg) {
  const DirectionList& l = *t.list();
  const SampleAngles at(t);
  const Direction wanted = direction(theta_i_deg * degree, 0);
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < t.size(); ++i)
    if (dot(at.directions(i).wi, wanted) > dot(at.directions(nearest).wi, wanted)) nearest = i;
  AlbedoSample a{theta_i_deg, l.phi_i_deg[nearest], {}, 1, 0};
  const bool noisy = noise_floor(t) > 0;
  for (const auto& plane : t.values) {
    double sum = 0, weight = 0;
    for (std::size_t i = 0; i < t.size(); ++i) {
      if (l.theta_i_deg[i] != l.theta_i_deg[nearest] || l.phi_i_deg[i] != l.phi_i_deg[nearest] ||
          !counts_in_integral(mask(at(i), plane[i]), noisy))
        continue;
      sum += t.patches[i] * plane[i];
      weight += t.patches[i];
    }
    a.albedo.push_back(weight > std::numbers::pi / 2 ? sum / weight * std::numbers::pi
                                                     : std::nan(""));
    a.coverage = std::min(a.coverage, weight / std::numbers::pi);
  }
  return a;
}

std::vector<AlbedoSample> of_function(const Table& t, double step_deg) {
  std::vector<AlbedoSample> all(static_cast<std::size_t>(std::ceil(90 / step_deg)));
  tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t k) {
    all[k] = directional_albedo(t, step_deg * static_cast<double>(k));
  });
  return all;
}

/// True where all azimuths between the two directions are from 0 to 180°, as goniometers write them.
bool one_half_turn(const DirectionList& l, const std::vector<std::size_t>& samples) {
  return std::ranges::all_of(samples, [&](std::size_t i) {
    const double phi = l.phi_o_deg[i] - l.phi_i_deg[i];
    return phi >= 0 && phi <= 180;
  });
}

/// How far from the mirror direction a light's nearest sample may be: within a highlight that the table resolves, or
/// anywhere if samples in the mirror direction of other lights show none.
double farthest_from_mirror(const Table& t, const PeakSearch& search) {
  constexpr double tiny = 0.25 * degree;
  if (search.peak && search.peak->resolved) return search.peak->half_width_deg * degree;
  if (search.peak || search.profiles == 0) return tiny;
  const double lowest = std::cos(45 * degree), highest = std::cos(5 * degree),
               sine = std::sin(tiny);
  const SampleAngles at(t);
  for (std::size_t i = 0; i < t.size(); ++i) {
    const auto a = at(i);
    if (a.voh > lowest && a.voh < highest && a.sin2_theta_h < sine * sine) return HUGE_VAL;
  }
  return tiny;
}

constexpr auto too_far_apart = ": the samples are too far apart for the highlight";

/// A few incident angles in words.
std::string angles_in_words(const std::set<double>& deg) {
  std::vector<std::string> all;
  for (const double x : deg) all.push_back(fmt::format("{:.3g}°", x));
  return few_of(all);
}

TableAlbedo albedo_of_list(const Table& t, const PeakSearch& search) {
  const auto fewest = static_cast<std::size_t>(
      1 / (1 - std::cos(AroundOneLight::reach_deg * degree)));  // caps of that size in a hemisphere
  const auto nodes = cosine_hemisphere(24, 48);
  const DirectionList& l = *t.list();
  const Hashes hashes = hashes_of(t.size(), [&](std::size_t i) -> AngleKey<2> {
    return {std::lround(l.theta_i_deg[i] * 1e6), std::lround(l.phi_i_deg[i] * 1e6)};
  });
  std::map<std::pair<double, double>, std::vector<std::size_t>> groups;
  for (const std::size_t i : KeyCounts(hashes).among(hashes, fewest))
    if (l.theta_i_deg[i] < 90 && l.theta_o_deg[i] < 90)
      groups[{l.theta_i_deg[i], l.phi_i_deg[i]}].push_back(i);
  const bool one_azimuth =
      std::ranges::all_of(l.phi_i_deg, [&](double phi) { return phi == l.phi_i_deg[0]; });
  std::vector<std::pair<std::pair<double, double>, std::vector<std::size_t>>> lights;
  for (auto& [incident, samples] : groups)
    if (samples.size() >= fewest) lights.emplace_back(incident, std::move(samples));
  const bool noisy = noise_floor(t) > 0;
  const double farthest = farthest_from_mirror(t, search);
  struct Light {
    std::optional<AlbedoSample> albedo;  ///< none of too few samples
    double from_mirror = 0;
    bool sure = false;
  };
  std::vector<Light> found(lights.size());
  tbb::parallel_for(std::size_t{0}, lights.size(), [&](std::size_t k) {
    const auto& [incident, samples] = lights[k];
    const bool half = one_azimuth && one_half_turn(l, samples);
    const AroundOneLight f(t, samples, half, noisy);
    double within = 0;
    for (const auto& node : nodes)
      if (f.reaches(node.direction)) within += node.weight;
    if (within < 0.95 * std::numbers::pi) return;
    std::array<std::vector<std::size_t>, 4> halves;  // of two halvings
    for (const std::size_t i : samples) {            // whatever their order
      Draws draws(1, std::lround(l.theta_o_deg[i] * 1e3), std::lround(l.phi_o_deg[i] * 1e3));
      for (const std::size_t first : {0, 2}) halves[first + (draws.uniform() < 0.5)].push_back(i);
    }
    std::vector<AroundOneLight> of_half;
    for (const auto& some : halves) of_half.emplace_back(t, some, half, noisy);
    std::vector<AroundOneLight::Between> here(t.channels.size()), there(here);
    AlbedoSample a =
        integrate(incident.first, here.size(), [&](const DirectionPair& p, bool all, Values3& v) {
          f(p, here);
          for (std::size_t c = 0; c < here.size(); ++c) v.f[c] = here[c].middle;
          if (!all) return;
          for (std::size_t c = 0; c < here.size(); ++c) v.otherwise[c] = v.f[c] - here[c].doubt;
          v.coarse = v.f;
          v.apart.assign(here.size(), {});
          for (std::size_t part = 0; part < of_half.size(); ++part) {
            of_half[part](p, there);
            for (std::size_t c = 0; c < there.size(); ++c) {
              const double change = there[c].line - here[c].line;
              if (!std::isfinite(change)) continue;
              v.coarse[c] += change;  // four times their mean
              v.apart[c][part / 2] += part % 2 == 0 ? -change : change;
            }
          }
        });
    a.phi_i_deg = incident.second;
    double most = 0;
    for (const double v : a.albedo) most = std::max(most, v);
    // Between rings of samples of another surface's ridge or rim, as far as tried.
    constexpr double of_list = 3e-3;
    if (a.error > of_list / 100 * most) a.error += of_list * most;
    constexpr double known = 0.2;  // a peak between samples farther apart cannot be integrated
    found[k] = {std::move(a), f.from_mirror(), !(a.error > known * most)};
  });
  TableAlbedo all;
  std::set<double> few(l.theta_i_deg.begin(), l.theta_i_deg.end()), unsure, hidden;
  double widest = 0, least = HUGE_VAL, most = 0;
  for (auto& [a, from_mirror, sure] : found) {
    if (!a) continue;
    few.erase(a->theta_i_deg);
    if (!sure) {
      unsure.insert(a->theta_i_deg);
    } else if (from_mirror > farthest) {
      widest = std::max(widest, from_mirror);
      hidden.insert(a->theta_i_deg);
      for (const double v : a->albedo) least = std::fmin(least, v), most = std::fmax(most, v);
      all.at_least.push_back(std::move(*a));
    } else {
      all.known.push_back(std::move(*a));
    }
  }
  const auto leave_out = [&](const std::set<double>& deg, const std::string& why) {
    if (!deg.empty()) all.left_out.push_back(angles_in_words(deg) + ": " + why);
  };
  leave_out(few, "the samples do not cover the hemisphere");
  if (!unsure.empty()) all.left_out.push_back(angles_in_words(unsure) + too_far_apart);
  leave_out(hidden,
            fmt::format("a highlight narrower than {:.2g}° would not show; without one {:.3g}{}",
                        widest / degree, least,
                        most - least > 0.005 * most ? fmt::format(" to {:.3g}", most) : ""));
  return all;
}

/// By the format's own function, whose error is that of its grid and its incident angles: four times what the albedo differs
/// by from a cubic through its values at the four nearest of them, and a thousandth.  Of 23 models at six angles no error was
/// larger.
AlbedoSample of_rgl(const Table& t, const RglFunction& f, double theta_i_deg) {
  const auto albedo = [&](double theta_deg) {
    return integrate(theta_deg, t.channels.size(), [&](const DirectionPair& p, bool, Values3& v) {
      for (std::size_t c = 0; c < v.f.size(); ++c) v.f[c] = v.otherwise[c] = v.coarse[c] = f(p, c);
    });
  };
  AlbedoSample a = albedo(theta_i_deg);
  std::vector<double> nodes = t.list()->theta_i_deg;
  std::ranges::sort(nodes);
  constexpr double alike = 1e-4;
  nodes.erase(
      std::unique(nodes.begin(), nodes.end(), [](double x, double y) { return y - x < alike; }),
      nodes.end());
  std::erase_if(nodes, [](double x) { return x > 89; });
  if (nodes.size() < 4) return a;
  const auto above = std::ranges::upper_bound(nodes, theta_i_deg) - nodes.begin();
  const auto first = static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(above - 2, 0, static_cast<std::ptrdiff_t>(nodes.size()) - 4));
  std::vector<double> cubic(t.channels.size());
  for (std::size_t k = first; k < first + 4; ++k) {
    double part = 1;
    for (std::size_t l = first; l < first + 4; ++l)
      if (l != k) part *= (theta_i_deg - nodes[l]) / (nodes[k] - nodes[l]);
    const auto there = albedo(nodes[k]);
    for (std::size_t c = 0; c < cubic.size(); ++c) cubic[c] += part * there.albedo[c];
  }
  constexpr double of_incident_angles = 4, of_grid = 1e-3;
  double most = 0;
  for (std::size_t c = 0; c < cubic.size(); ++c)
    most = std::max(most,
                    of_incident_angles * std::abs(cubic[c] - a.albedo[c]) + of_grid * a.albedo[c]);
  a.error += most;
  return a;
}

}  // namespace

AlbedoSample directional_albedo(const Table& t, double theta_i_deg) {
  const std::size_t channels = t.channels.size();
  if (!t.patches.empty()) return sum_of_patches(t, theta_i_deg);
  if (t.grid()) {
    const SampleAngles at(t);
    return integrate(theta_i_deg, channels, [&](const DirectionPair& p, bool all, Values3& v) {
      const GridCell cell = cell_around(t, at, p);
      const GridCell wide = all ? cell_around(t, at, p, 2) : GridCell();
      for (std::size_t c = 0; c < channels; ++c) {
        v.f[c] = cell.mean_of(t.values[c]);
        if (!all) continue;
        v.coarse[c] = wide.mean_of(t.values[c]);
        double logs = 0, parts = 0;
        for (std::size_t k = 0; k < cell.count; ++k)
          if (const double f = t.values[c][cell.sample[k]]; std::isfinite(f) && f >= 0)
            logs += cell.part[k] * std::log(f), parts += cell.part[k];
        v.otherwise[c] = std::exp(logs / parts);
      }
    });
  }
  // The cosine of the integral takes back what RGL divides by.
  if (const RglFunction rgl = rgl_function(t)) return of_rgl(t, rgl, theta_i_deg);
  if (!has_utia_directions(t)) {
    const Interpolator between(t);
    return integrate(theta_i_deg, channels, [&](const DirectionPair& p, bool, Values3& v) {
      for (std::size_t c = 0; c < channels; ++c)
        v.f[c] = v.otherwise[c] = v.coarse[c] = between(p, c);
    });
  }
  Table coarse, logs;  // these of f over `least`
  double least = HUGE_VAL;
  for (const auto& plane : t.values)
    for (const double v : plane)
      if (v > 0) least = std::min(least, v);
  logs.values = coarse.values = t.values;
  for (auto& plane : logs.values)
    for (double& v : plane) v = std::log(v / least);
  interpolate_utia(logs);
  interpolate_utia(coarse, 2);
  return integrate(theta_i_deg, channels, [&](const DirectionPair& p, bool all, Values3& v) {
    for (std::size_t c = 0; c < channels; ++c) {
      v.f[c] = t.between(p, c);
      if (!all) continue;
      // Between samples that far apart a highlight may lie as far below that mean again.
      v.otherwise[c] = 2 * least * std::exp(logs.between(p, c)) - v.f[c];
      v.coarse[c] = coarse.between(p, c);
    }
  });
}

TableAlbedo albedo_of_table(const Table& t, double step_deg, const PeakSearch& search) {
  if (t.list() && !t.between) return albedo_of_list(t, search);
  const bool slice = t.grid() && std::ranges::any_of(t.grid()->axes, [](const Axis& a) {
                       return a.spacing == Axis::Spacing::constant;
                     });
  if (slice && !t.between) return {{}, {}, {"an image slice holds no hemisphere"}};
  TableAlbedo all{of_function(t, step_deg), {}, {}};
  std::set<double> unsure;
  for (auto& a : all.known) {
    double most = 0;
    for (const double v : a.albedo) most = std::fmax(most, v);
    if (!(a.error > most) || most == 0) continue;
    unsure.insert(a.theta_i_deg);
    std::ranges::fill(a.albedo, std::nan(""));
  }
  if (!unsure.empty()) all.left_out.push_back(angles_in_words(unsure) + too_far_apart);
  return all;
}

std::vector<AlbedoSample> albedo_curve(const Table& t, double step_deg) {
  return albedo_of_table(t, step_deg, find_peak(t, t.bins())).known;
}

std::vector<AlbedoSample> directional_albedo(const Table& t) {
  return albedo_curve(t, 15);
}

}  // namespace gonio
