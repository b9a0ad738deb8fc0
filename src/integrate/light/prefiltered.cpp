#include "integrate/light/prefiltered.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "brdf/formula/ndf_ggx.h"
#include "geometry/half_difference.h"

#include <tbb/parallel_for.h>

namespace gonio {
namespace {

using Patch = LightPyramid::Patch;
using Level = LightPyramid::Level;

constexpr std::size_t finest = 256, coarsest = 64;  ///< rows of the first level
constexpr double opening = 0.25;  ///< width of a patch, over that of the lobe there

/// Light that is gathered into a patch.
struct Sum {
  Patch patch;
  double weight = 0, x = 0, y = 0, z = 0;

  void add(const Rgb& flux, const Direction& from, double solid_angle) {
    const double w = flux[0] + flux[1] + flux[2];
    for (std::size_t c = 0; c < 3; ++c) patch.flux[c] += flux[c];
    patch.solid_angle += solid_angle;
    weight += w;
    x += w * from.x;
    y += w * from.y;
    z += w * from.z;
  }
  /// \param middle  centre of a patch of no light
  Patch done(const Direction& middle, double width) {
    const double length = std::hypot(x, y, z);
    // Light from all around has no centre.
    patch.centre = length > 1e-9 * weight && weight > 0
                       ? Direction{x / length, y / length, z / length}
                       : middle;
    patch.width = width;
    return patch;
  }
};

/// Extent of the widest of n patches that are made of so many equal steps of an angle [rad].
double widest(double angle, std::size_t steps, std::size_t n) {
  return angle * static_cast<double>((steps + n - 1) / n) / static_cast<double>(steps);
}
Direction middle_of(const Level& l, std::size_t i, std::size_t j) {
  const Environment map{l.width, l.height, {}, 0};
  return direction(map.theta(static_cast<double>(j) + 0.5), map.phi(static_cast<double>(i) + 0.5));
}

Level first_level(const Environment& map) {
  const std::size_t parts = map.height < coarsest ? (coarsest + map.height - 1) / map.height : 1;
  const std::size_t rows = map.height * parts, columns = map.width * parts;
  Level l;
  l.height = std::min(rows, finest);
  l.width = std::min(columns, 2 * finest);
  const Environment fine{columns, rows, {}, 0};
  std::vector<Sum> sums(l.width * l.height);
  for (std::size_t j = 0; j < rows; ++j) {
    const double top = std::cos(fine.theta(static_cast<double>(j))),
                 bottom = std::cos(fine.theta(static_cast<double>(j + 1)));
    const double solid_angle = (top - bottom) * 2 * std::numbers::pi / static_cast<double>(columns);
    for (std::size_t i = 0; i < columns; ++i) {
      Rgb flux = map.texel(i / parts, j / parts);
      for (double& v : flux) v *= solid_angle;
      sums[j * l.height / rows * l.width + i * l.width / columns].add(
          flux,
          direction(fine.theta(static_cast<double>(j) + 0.5),
                    fine.phi(static_cast<double>(i) + 0.5)),
          solid_angle);
    }
  }
  const double width = std::max(widest(std::numbers::pi, rows, l.height),
                                widest(2 * std::numbers::pi, columns, l.width));
  for (std::size_t k = 0; k < sums.size(); ++k)
    l.patch.push_back(sums[k].done(middle_of(l, k % l.width, k / l.width), width));
  return l;
}

Level above(const Level& below) {
  Level l;
  l.height = (below.height + 1) / 2;
  l.width = (below.width + 1) / 2;
  std::vector<Sum> sums(l.width * l.height);
  for (std::size_t j = 0; j < below.height; ++j)
    for (std::size_t i = 0; i < below.width; ++i) {
      const auto& p = below.patch[j * below.width + i];
      sums[j / 2 * l.width + i / 2].add(p.flux, p.centre, p.solid_angle);
    }
  for (std::size_t k = 0; k < sums.size(); ++k)
    l.patch.push_back(
        sums[k].done(middle_of(l, k % l.width, k / l.width), 2 * below.patch[0].width));
  return l;
}

/// Sum over patches that a lobe about `at` sees as one direction each.
template <class Weight>
struct Gathering {
  const std::vector<Level>& levels;
  Direction at;
  double width;  ///< of the lobe [rad]
  const Weight& weight;
  Rgb sum{};
  double all = 0;

  void add(std::size_t level, std::size_t i, std::size_t j) {
    const Level& l = levels[level];
    if (i >= l.width || j >= l.height) return;
    const auto& p = l.patch[j * l.width + i];
    const double cosine = std::clamp(dot(at, p.centre), -1.0, 1.0);
    if (level > 0 && p.width > opening * std::max(width, std::acos(cosine) - p.width)) {
      for (const std::size_t k : {0, 1, 2, 3}) add(level - 1, 2 * i + k % 2, 2 * j + k / 2);
      return;
    }
    const double w = weight(cosine);
    if (!(w > 0)) return;
    for (std::size_t c = 0; c < 3; ++c) sum[c] += w * p.flux[c];
    all += w * p.solid_angle;
  }
};

}  // namespace

LightPyramid::LightPyramid(const Environment& map) {
  levels_.push_back(first_level(map));
  while (levels_.back().height > 1) levels_.push_back(above(levels_.back()));
}

template <class Weight>
FilteredLight FilteredLight::gathered(const LightPyramid& light,
                                      std::size_t height,
                                      double width,
                                      const Weight& weight) {
  FilteredLight f;
  f.map_ = {2 * height, height, {}, 0};
  f.map_.radiance.resize(f.map_.width * f.map_.height);
  const auto& levels = light.levels();
  tbb::parallel_for(std::size_t{0}, height, [&](std::size_t j) {
    for (std::size_t i = 0; i < f.map_.width; ++i) {
      Gathering<Weight> g{levels,
                          direction(f.map_.theta(static_cast<double>(j) + 0.5),
                                    f.map_.phi(static_cast<double>(i) + 0.5)),
                          width, weight};
      const auto& top = levels.back();
      for (std::size_t k = 0; k < top.width; ++k) g.add(levels.size() - 1, k, 0);
      for (std::size_t c = 0; c < 3; ++c)
        f.map_.radiance[j * f.map_.width + i][c] =
            g.all > 0 ? static_cast<float>(g.sum[c] / g.all) : 0;
    }
  });
  return f;
}

Rgb FilteredLight::operator()(const Direction& d) const {
  const auto width = static_cast<double>(map_.width), height = static_cast<double>(map_.height);
  const double x = (1 - phi_of(d) / std::numbers::pi) / 2 * width - 0.5,
               y = theta_of(d) / std::numbers::pi * height - 0.5;
  const double right = x - std::floor(x), down = y - std::floor(y);
  const auto column = [&](double at) {
    return static_cast<std::size_t>(at < 0 ? at + width : at) % map_.width;
  };
  const auto row = [&](double at) {
    return static_cast<std::size_t>(std::clamp(at, 0.0, height - 1));
  };
  Rgb sum{};
  for (const bool low : {false, true})
    for (const bool east : {false, true}) {
      const double w = (low ? down : 1 - down) * (east ? right : 1 - right);
      const Rgb l =
          map_.texel(column(std::floor(x) + (east ? 1 : 0)), row(std::floor(y) + (low ? 1 : 0)));
      for (std::size_t c = 0; c < 3; ++c) sum[c] += w * l[c];
    }
  return sum;
}

FilteredLight prefiltered(const LightPyramid& light, double alpha) {
  constexpr double narrowest = 0.01;
  const double a = std::max(alpha, narrowest);
  const std::array parameter{a};
  const Ggx<double> d(parameter);
  const auto weight = [&](double nol) {
    if (!(nol > 0)) return 0.0;
    // n = v = r: h is half way between r and l
    const double noh2 = (1 + nol) / 2, noh = std::sqrt(noh2);
    return d({nol, 1, noh, noh, (1 - nol) / 2}).value() * nol;
  };
  const auto height = static_cast<std::size_t>(std::ceil(2 * std::numbers::pi / a));
  return FilteredLight::gathered(light, std::clamp<std::size_t>(height, 32, 256), 2 * a, weight);
}

FilteredLight mean_radiance(const LightPyramid& light) {
  return FilteredLight::gathered(light, 32, 0.4, [](double nol) { return nol; });
}

}  // namespace gonio
