#include "table/format/rgl/resample.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <deque>
#include <memory>
#include <numbers>
#include <utility>

#include "geometry/half_difference.h"
#include "table/format/rgl/material.h"

#include <tbb/parallel_for.h>

namespace gonio {
namespace {

using std::numbers::pi;
using namespace rgl;

constexpr std::size_t facet_nodes = 256;    ///< of D and the areas, over u = √(2 θ/π)
constexpr std::size_t visible_nodes = 128;  ///< of visible normals over u, and half as many over φ
/// The part of an even distribution, of the file's facets and of the normals that grid points follow.
constexpr double even_facets = 0.01, even_points = 0.3;

double theta_at(std::size_t i, std::size_t n) {
  const double u = static_cast<double>(i) / static_cast<double>(n - 1);
  return u * u * pi / 2;
}
/// dω/(du dv) at a facet.
double solid_angle_per_area(double u, double theta) {
  return 2 * pi * pi * u * std::sin(theta);
}

/// Two rows alike, as the files have what does not depend on the azimuth.
Image of_theta(const std::vector<double>& v) {
  Image i{v.size(), 2, {}};
  for (int row = 0; row < 2; ++row)
    for (const double x : v) i.nodes.push_back(static_cast<float>(x));
  return i;
}

/// ∫ g(u, θ) cos-free over the hemisphere of what depends on θ alone, over du.
template <class G>
double integral(G g) {
  constexpr int steps = 2048;
  double sum = 0;
  for (int k = 0; k < steps; ++k) {
    const double u = (k + 0.5) / steps, theta = u * u * pi / 2;
    sum += g(u, theta) * pi * u * std::sin(theta);
  }
  return sum / steps;
}

/// D(θ_h) as the mean of 4 f cos θ_i cos θ_o at φ_d = 90°, with an even one as part of it; its integral over cos θ is 1.
/// \param theta_d  [rad]
Image facets(const RglFunction& f,
             std::size_t channels,
             const std::vector<double>& theta_d,
             double even) {
  using std::numbers::pi;
  std::vector<double> d(facet_nodes, std::nan(""));
  for (std::size_t i = 0; i < facet_nodes; ++i) {
    double sum = 0;
    int count = 0;
    for (const double theta : theta_d) {
      const auto p = directions(HalfDifference{theta_at(i, facet_nodes), 0, theta, pi / 2});
      if (p.wi.z < least_cosine) continue;  // wo.z is the same
      for (std::size_t c = 0; c < channels; ++c)
        if (const double v = f(p, c); v >= 0) sum += 4 * v * p.wi.z * p.wo.z, ++count;
    }
    if (count) d[i] = sum / count;
  }
  // Where nothing is known, as it is nearest to there: a step of D would be one of what is stored
  // over it.
  for (std::size_t i = 1; i < facet_nodes; ++i)
    if (std::isnan(d[i])) d[i] = d[i - 1];
  for (std::size_t i = facet_nodes - 1; i-- > 0;)
    if (std::isnan(d[i])) d[i] = d[i + 1];
  if (std::isnan(d[0])) std::ranges::fill(d, 0);
  const Image shape = of_theta(d);
  const double area = 2 * pi * integral([&](double u, double theta) {
                        return shape({u, 0.5}) * std::cos(theta);
                      });
  for (double& v : d) v = area > 0 ? (1 - even) * v / area + even / pi : 1 / pi;
  return of_theta(d);
}

/// ∫ D max(0, wi·m) dω
double visible_area(const Image& d, double theta) {
  return integral([&](double u, double theta_m) {
    const double a = std::cos(theta) * std::cos(theta_m), b = std::sin(theta) * std::sin(theta_m);
    const double phi = a >= b ? pi : std::acos(std::max(-a / b, -1.0));
    return 2 * d({u, 0.5}) * (a * phi + b * std::sin(phi));
  });
}

/// Visible normals of an incident direction at grid points, none where they and all about them mirror it below the horizon.
void append_visible(const Image& d, const Direction& wi, Image& to) {
  const auto point = [&](std::size_t x, std::size_t y) {
    return Point{static_cast<double>(x) / static_cast<double>(to.width - 1),
                 static_cast<double>(y) / static_cast<double>(to.height - 1)};
  };
  std::vector<char> above;
  for (std::size_t y = 0; y < to.height; ++y)
    for (std::size_t x = 0; x < to.width; ++x)
      above.push_back(reflected(wi, direction_at(point(x, y))).z > 0);
  for (std::size_t y = 0; y < to.height; ++y)
    for (std::size_t x = 0; x < to.width; ++x) {
      bool any = false;
      for (std::size_t j = y > 0 ? y - 1 : 0; j < std::min(y + 2, to.height); ++j)
        for (std::size_t i = x > 0 ? x - 1 : 0; i < std::min(x + 2, to.width); ++i)
          any |= above[j * to.width + i] != 0;
      const Point u = point(x, y);
      const Direction m = direction_at(u);
      const double density =
          d({u.x, 0.5}) * std::max(dot(wi, m), 0.0) * solid_angle_per_area(u.x, theta_of(m));
      to.nodes.push_back(any ? static_cast<float>(density) : 0.0F);
    }
}

/// Grid points that have no value take that of the nearest that has one.  \return true if any has
bool fill(std::vector<double>& f, std::vector<char>& known, std::size_t n) {
  std::deque<std::size_t> next;
  for (std::size_t i = 0; i < known.size(); ++i)
    if (known[i]) next.push_back(i);
  const bool any = !next.empty();
  for (; !next.empty(); next.pop_front()) {
    const std::size_t i = next.front(), x = i % n, y = i / n;
    const auto take = [&](std::size_t to) {
      if (known[to]) return;
      known[to] = 1;
      f[to] = f[i];
      next.push_back(to);
    };
    if (x > 0) take(i - 1);
    if (x + 1 < n) take(i + 1);
    if (y > 0) take(i - n);
    if (y + 1 < n) take(i + n);
  }
  return any;
}

/// The direction, or the one above it that is far enough from the horizon to have a value.
Direction raised(const Direction& d) {
  if (d.z >= least_cosine) return d;
  return direction(std::acos(least_cosine), phi_of(d));
}

}  // namespace

RglTable rgl_table(const RglFunction& f, std::vector<std::string> channels, const RglSizes& sizes) {
  using std::numbers::pi;
  const std::size_t n = sizes.n, nodes = n * n, n_theta = sizes.n_theta,
                    n_channels = channels.size();
  Fields fields;
  fields.phi_i = {0};
  for (std::size_t k = 0; k < n_theta; ++k) {
    const double left = 1 - static_cast<double>(k) / static_cast<double>(n_theta - 1);
    fields.theta_i.push_back(
        static_cast<double>(static_cast<float>(pi / 2 * (1 - std::pow(left, 1.5)))));
  }
  fields.channels = std::move(channels);
  std::vector<double> some_theta_d;
  for (int k = 0; k <= 12; ++k) some_theta_d.push_back(5 * k * degree);
  fields.ndf = facets(f, n_channels, some_theta_d, even_facets);
  std::vector<double> areas(facet_nodes);
  for (std::size_t i = 0; i < facet_nodes; ++i)
    areas[i] = visible_area(fields.ndf, theta_at(i, facet_nodes));
  fields.sigma = of_theta(areas);
  fields.vndf = {visible_nodes, visible_nodes / 2, {}};
  for (const double theta : fields.theta_i)
    append_visible(facets(f, n_channels, {std::min(theta, 85 * degree)}, even_points),
                   direction(theta, 0), fields.vndf);
  fields.data = {n, n, std::vector<float>(n_theta * n_channels * nodes)};
  fields.invented.resize(n_theta * nodes);

  const Warp warp(fields.vndf, n_theta);
  // [θ_i][channel][y][x]
  std::vector<std::vector<std::vector<double>>> values(
      n_theta, std::vector(n_channels, std::vector<double>(nodes)));
  std::vector<std::vector<char>> filled(n_theta, std::vector<char>(n_channels));
  std::atomic<std::size_t> above = 0;
  std::vector<std::atomic<std::size_t>> without(n_channels);
  const auto place = [&](std::size_t k, std::size_t i) {
    const Point s{static_cast<double>(i % n) / static_cast<double>(n - 1),
                  static_cast<double>(i / n) / static_cast<double>(n - 1)};
    return warp.sample(k, s);
  };
  tbb::parallel_for(std::size_t{0}, n_theta, [&](std::size_t k) {
    const Direction wi = direction(fields.theta_i[k], 0);
    std::vector<std::vector<char>> known(n_channels, std::vector<char>(nodes));
    for (std::size_t i = 0; i < nodes; ++i) {
      const Direction wo = reflected(wi, direction_at(place(k, i)));
      const bool up = std::min(wi.z, wo.z) > horizon_cosine;
      above += up;
      for (std::size_t c = 0; c < n_channels; ++c) {
        double v = up ? f({wi, wo}, c) : std::nan("");
        if (!std::isfinite(v)) v = f({raised(wi), raised(wo)}, c);
        known[c][i] = std::isfinite(v);
        values[k][c][i] = std::max(v, 0.0);
        without[c] += up && !known[c][i];
      }
    }
    for (std::size_t c = 0; c < n_channels; ++c) {
      for (std::size_t i = 0; i < nodes; ++i)
        if (!known[c][i]) fields.invented[k * nodes + i] = 1;
      filled[k][c] = fill(values[k][c], known[c], n);
    }
  });
  // An incident direction that has no value at all takes those of the nearest that has.
  for (std::size_t c = 0; c < n_channels; ++c)
    for (std::size_t k = 0; k < n_theta; ++k)
      for (std::size_t away = 1; !filled[k][c] && away < n_theta; ++away) {
        const bool before = k >= away && filled[k - away][c];
        if (!before && !(k + away < n_theta && filled[k + away][c])) continue;
        values[k][c] = values[before ? k - away : k + away][c];
        break;
      }
  tbb::parallel_for(std::size_t{0}, n_theta, [&](std::size_t k) {
    const double theta = fields.theta_i[k];
    const Direction wi = direction(theta, 0);
    const double area = fields.sigma({std::sqrt(2 / pi * theta), 0.5});
    for (std::size_t i = 0; i < nodes; ++i) {
      const Point u = place(k, i);
      const double cos_o = std::max(reflected(wi, direction_at(u)).z, 0.0);
      for (std::size_t c = 0; c < n_channels; ++c)
        fields.data.nodes[(k * n_channels + c) * nodes + i] =
            static_cast<float>(values[k][c][i] * cos_o * 4 * area / fields.ndf({u.x, 0.5}));
    }
  });
  const std::size_t most = *std::ranges::max_element(without);
  if (most == 0) fields.invented.clear();  // what lies below the horizon is nobody's
  return {table_of(std::make_shared<const Material>(std::move(fields))), above, most};
}

std::size_t rgl_numbers(std::size_t channels, const RglSizes& s) {
  return s.n_theta * s.n * s.n * (channels + 4);
}

Table rgl_mixed(const Table& t,
                std::vector<std::string> channels,
                bool spectral,
                const std::vector<std::vector<double>>& weight) {
  const auto from = material_of(t);
  Fields f{from->theta_i, from->phi_i,        std::move(channels),
           spectral,      from->has_jacobian, from->ndf,
           from->sigma,   from->vndf(),       {from->width(), from->height(), {}},
           from->invented};
  const std::size_t nodes = f.data.width * f.data.height, n = from->channels.size();
  for (std::size_t slice = 0; slice < f.phi_i.size() * f.theta_i.size(); ++slice)
    for (const auto& parts : weight)
      for (std::size_t i = 0; i < nodes; ++i) {
        double sum = 0;
        for (std::size_t c = 0; c < n; ++c)
          sum += parts[c] * static_cast<double>(from->data.slice(slice * n + c)[i]);
        f.data.nodes.push_back(static_cast<float>(sum));
      }
  return table_of(std::make_shared<const Material>(std::move(f), from->symmetry));
}

}  // namespace gonio
