#include "table/peak.h"

#include <algorithm>
#include <cmath>

#include "table/quantile.h"

namespace gonio {
namespace {

constexpr std::size_t kProfiles = 8;
constexpr double kFirst = 5 * degree, kStep = 5 * degree;  ///< bands of θ_d

struct Point {
  double theta_h, value;
};
using Profile = std::vector<Point>;

/// Mean over the channels; NaN where one of them says nothing.
double mean_value(const Table& t, const Angles<double>& a, std::size_t i) {
  double sum = 0;
  for (const auto& plane : t.values) {
    const Mask m = mask(a, plane[i]);
    // Noise goes both ways: leaving out its negative half would lift the base.
    if (m != Mask::valid && !(m == Mask::negative && t.negative_is_noise)) return std::nan("");
    sum += plane[i];
  }
  return sum / static_cast<double>(t.values.size());
}

/// The samples of each band of θ_d; of a grid over θ_d only the row nearest the band's middle.
std::array<Profile, kProfiles> collect(const Table& t, Bins bins) {
  std::array<Profile, kProfiles> profiles;
  const SampleAngles at(t, bins);
  const auto add = [&](std::size_t band, const Angles<double>& a, std::size_t i) {
    if (const double v = mean_value(t, a, i); !std::isnan(v))
      profiles[band].push_back({std::atan2(std::sqrt(a.sin2_theta_h), a.noh), v});
  };
  const Grid* g = t.grid();
  if (g && g->kind == Grid::Kind::half_difference) {
    const auto [n_h, n_d, n_phi] = std::array{g->axes[0].size, g->axes[1].size, g->axes[2].size};
    for (std::size_t band = 0; band < kProfiles; ++band) {
      const double middle = kFirst + (static_cast<double>(band) + 0.5) * kStep;
      const auto row = std::lround(
          std::clamp(g->axes[1].index(middle, bins), 0.0, static_cast<double>(n_d - 1)));
      for (std::size_t h = 0; h < n_h; ++h)
        for (std::size_t k = 0; k < n_phi; ++k) {
          const std::size_t i = (h * n_d + static_cast<std::size_t>(row)) * n_phi + k;
          add(band, at(i), i);
        }
    }
  } else {
    for (std::size_t i = 0; i < t.size(); ++i) {
      const auto a = at(i);
      const double band = std::floor((std::acos(std::min(a.voh, 1.0)) - kFirst) / kStep);
      if (band >= 0 && band < kProfiles) add(static_cast<std::size_t>(band), a, i);
    }
  }
  return profiles;
}

/// In order of θ_h; samples at one θ_h become their mean.
void merge(Profile& p) {
  std::ranges::stable_sort(p, {}, &Point::theta_h);
  Profile merged;
  double count = 0;
  for (const Point& s : p) {
    if (merged.empty() || s.theta_h > merged.back().theta_h + 1e-6) {
      merged.push_back(s);
      count = 1;
    } else {
      ++count;
      merged.back().value += (s.value - merged.back().value) / count;
    }
  }
  p = std::move(merged);
}

std::optional<Peak> peak_of(const Profile& p) {
  if (p.size() < 8) return {};
  std::vector<double> values;
  for (const auto& s : p) values.push_back(s.value);
  const double height = std::max({values[0], values[1], values[2]}), base = quantile(values, 0.1);
  if (!(height > 1.5 * std::max(base, 0.0))) return {};
  const double half = (height + base) / 2;
  std::size_t k = 0;
  while (p[k].value < half) ++k;  // up to the height, among the first three
  while (k + 2 < p.size() && !(p[k + 1].value < half && p[k + 2].value < half)) ++k;
  if (k + 2 >= p.size()) return {};
  const double part = std::clamp((p[k].value - half) / (p[k].value - p[k + 1].value), 0.0, 1.0);
  const double width = std::lerp(p[k].theta_h, p[k + 1].theta_h, part);
  const double within = static_cast<double>(
      std::ranges::count_if(p, [&](const Point& s) { return s.theta_h <= width; }));
  return Peak{width / degree, 0, within, false, height, base};
}

}  // namespace

std::optional<Peak> find_peak(const Table& t, Bins bins) {
  std::size_t usable = 0;
  std::array<std::vector<double>, 4> found;  // width, samples within, height, base
  for (auto& profile : collect(t, bins)) {
    merge(profile);
    if (profile.size() >= 8) ++usable;
    if (const auto p = peak_of(profile)) {
      found[0].push_back(p->half_width_deg);
      found[1].push_back(p->samples_within);
      found[2].push_back(p->height);
      found[3].push_back(p->base);
    }
  }
  if (2 * found[0].size() <= usable) return {};
  Peak p{median(found[0]), 0, median(found[1]), false, median(found[2]), median(found[3])};
  // D(θ)/D(0) = (1 + sin²θ (1 − α²)/α²)⁻² is ½ where sin²θ (1 − α²)/α² = √2 − 1.
  const double s = std::sin(p.half_width_deg * degree);
  p.alpha = s / std::sqrt(std::numbers::sqrt2 - 1 + s * s);
  p.resolved = p.samples_within >= 3;
  return p;
}

}  // namespace gonio
