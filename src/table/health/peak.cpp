#include "table/health/peak.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/quantile.h"

#include <tbb/parallel_for.h>

namespace gonio {
namespace {

constexpr std::size_t kProfiles = 8;
constexpr double kFirst = 5 * degree, kStep = 5 * degree;  ///< bands of the other angle
constexpr double kReach = 3 * degree;                      ///< of the best profile's first angle
constexpr double kSlack = 0.25 * degree;                   ///< what others may start later

struct Point {
  double angle, value;
};
using Profile = std::vector<Point>;

/// Mean over the channels; NaN where one of them says nothing.
double mean_value(const Table& t, const Angles<double>& a, std::size_t i) {
  const auto n = static_cast<double>(t.values.size());
  double mean = 0;
  for (const auto& plane : t.values) {
    const Mask m = mask(a, plane[i]);
    // Noise goes both ways: leaving out its negative half would lift the base.
    if (m != Mask::valid && !(m == Mask::negative && t.negative_is_noise)) return std::nan("");
    mean += plane[i] / n;  // not their sum, which may be infinite
  }
  return mean;
}

double theta_h_of(const Angles<double>& a) {
  return std::atan2(std::sqrt(a.sin2_theta_h), a.noh);
}
double theta_d_of(const Angles<double>& a) {
  return std::acos(std::min(a.voh, 1.0));
}

/// The samples of each band of θ_d (θ_h); of a grid over these only the row nearest the band's middle.
std::array<Profile, kProfiles> collect(const Table& t, Bins bins, Around around) {
  std::array<Profile, kProfiles> profiles;
  const SampleAngles at(t, bins);
  const bool mirror = around == Around::half_vector;
  const auto add = [&](Profile& profile, const Angles<double>& a, std::size_t i) {
    if (const double v = mean_value(t, a, i); !std::isnan(v))
      profile.push_back({mirror ? theta_h_of(a) : theta_d_of(a), v});
  };
  const Grid* g = t.grid();
  if (g && g->kind == Grid::Kind::half_difference) {
    const std::size_t n_d = g->axes[1].size, n_phi = g->axes[2].size;
    // Who asks about the retro direction asks whether, not how wide: some φ_d are enough.
    const std::size_t step = mirror ? 1 : (n_phi + 23) / 24;
    const Axis &across = g->axes[mirror ? 1 : 0], &along = g->axes[mirror ? 0 : 1];
    for (std::size_t band = 0; band < kProfiles; ++band) {
      const double middle = kFirst + (static_cast<double>(band) + 0.5) * kStep;
      const auto row = static_cast<std::size_t>(std::lround(
          std::clamp(across.index(middle, bins), 0.0, static_cast<double>(across.size - 1))));
      for (std::size_t j = 0; j < along.size; ++j) {
        const auto samples = at.row(mirror ? j * n_d + row : row * n_d + j);
        double mean = 0, count = 0;
        for (std::size_t k = 0; k < n_phi; k += step)
          if (const double v = mean_value(t, samples(k), samples.first() + k); !std::isnan(v))
            ++count, mean += v / count - mean / count;  // their sum may be infinite
        if (count > 0) profiles[band].push_back({along.angle(static_cast<double>(j), bins), mean});
      }
    }
  } else {
    // Those in a band, and few others.
    const double nearest = std::cos(kFirst - degree),
                 farthest = std::cos(kFirst + kProfiles * kStep + degree);
    constexpr std::size_t part = 1 << 14;
    std::vector<std::array<Profile, kProfiles>> parts((t.size() + part - 1) / part);
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t k) {
      for (std::size_t i = k * part; i < std::min(t.size(), (k + 1) * part); ++i) {
        const auto a = at(i);
        const double cosine = mirror ? a.voh : a.noh;
        if (cosine > nearest || cosine < farthest) continue;
        const double band = std::floor(((mirror ? theta_d_of(a) : theta_h_of(a)) - kFirst) / kStep);
        if (band >= 0 && band < kProfiles) add(parts[k][static_cast<std::size_t>(band)], a, i);
      }
    });
    for (std::size_t band = 0; band < kProfiles; ++band)
      for (const auto& p : parts)
        profiles[band].insert(profiles[band].end(), p[band].begin(), p[band].end());
  }
  return profiles;
}

/// In order of the angle; samples at one angle become their mean.
void merge(Profile& p) {
  std::ranges::stable_sort(p, {}, &Point::angle);
  Profile merged;
  double count = 0;
  for (const Point& s : p) {
    if (merged.empty() || s.angle > merged.back().angle + 1e-6) {
      merged.push_back(s);
      count = 1;
    } else {
      ++count;
      merged.back().value += s.value / count - merged.back().value / count;
    }
  }
  p = std::move(merged);
}

/// Height of the highlight that a profile may have in its first three values, and what these stand on.
struct Ends {
  double height, base;
};
Ends ends_of(const Profile& p, Around around) {
  std::vector<double> values;
  for (const auto& s : p) values.push_back(s.value);
  std::array first{values[0], values[1], values[2]};
  std::ranges::sort(first);
  // A mirror peak may lie between the samples; where a table is not expected to have one, a single
  // value may be an outlier.
  const double height = first[around == Around::retro ? 1 : 2];
  return {height, quantile(values, 0.1)};
}

std::optional<Peak> peak_of(const Profile& p, const Ends& ends) {
  const auto [height, base] = ends;
  if (!(height > 1.5 * std::max(base, 0.0))) return {};
  const double half = height / 2 + base / 2;
  std::size_t k = 0;
  while (k < 2 && p[k].value < half) ++k;  // up to the height, among the first three
  while (k + 2 < p.size() && !(p[k + 1].value < half && p[k + 2].value < half)) ++k;
  if (k + 2 >= p.size()) return {};
  const double part = std::clamp((p[k].value - half) / (p[k].value - p[k + 1].value), 0.0, 1.0);
  const double width = std::lerp(p[k].angle, p[k + 1].angle, part);
  const double within = static_cast<double>(
      std::ranges::count_if(p, [&](const Point& s) { return s.angle <= width; }));
  const auto far = std::lround(0.9 * static_cast<double>(p.size() - 1));
  return Peak{width / degree,
              0,
              within,
              false,
              height,
              base,
              p[static_cast<std::size_t>(far)].angle / degree};
}

}  // namespace

PeakSearch find_peak(const Table& t, Bins bins, Around around) {
  PeakSearch search;
  std::vector<double> contrasts;
  std::array<std::vector<double>, 5> found;  // width, samples within, height, base, its angle
  auto profiles = collect(t, bins, around);
  double first = kReach;
  tbb::parallel_for(std::size_t{0}, kProfiles, [&](std::size_t k) { merge(profiles[k]); });
  for (const auto& profile : profiles)
    if (profile.size() >= 8) first = std::min(first, profile[0].angle);
  for (const auto& profile : profiles) {
    if (profile.size() < 8 || profile[0].angle > std::min(first + kSlack, kReach)) continue;
    ++search.profiles;
    const Ends ends = ends_of(profile, around);
    contrasts.push_back(ends.base > 0     ? ends.height / ends.base
                        : ends.height > 0 ? std::numeric_limits<double>::infinity()
                                          : 1);
    if (const auto p = peak_of(profile, ends)) {
      found[0].push_back(p->half_width_deg);
      found[1].push_back(p->samples_within);
      found[2].push_back(p->height);
      found[3].push_back(p->base);
      found[4].push_back(p->base_deg);
    }
  }
  if (!contrasts.empty()) search.contrast = median(contrasts);
  if (2 * found[0].size() <= search.profiles) return search;
  Peak p{median(found[0]), 0, median(found[1]), false, median(found[2]), median(found[3]),
         median(found[4])};
  // D(θ)/D(0) = (1 + sin²θ (1 − α²)/α²)⁻² is ½ where sin²θ (1 − α²)/α² = √2 − 1.
  const double s = std::sin(p.half_width_deg * degree);
  p.alpha = s / std::sqrt(std::numbers::sqrt2 - 1 + s * s);
  p.resolved = p.samples_within >= 3 && p.half_width_deg >= t.patch_deg;
  search.peak = p;
  return search;
}

std::optional<Peak> retro_peak(const Table& t, const std::optional<Peak>& half_vector) {
  const auto retro = find_peak(t, t.bins(), Around::retro).peak;
  const auto above = [](const Peak& p) { return p.height - std::max(p.base, 0.0); };
  if (!retro || retro->height < 2 * retro->base) return {};
  if (half_vector && above(*retro) <= above(*half_vector)) return {};
  return retro;
}

}  // namespace gonio
