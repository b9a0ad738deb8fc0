#include "table/format/rgl/warp.h"

#include <bit>
#include <utility>

namespace gonio::rgl {
namespace {

/// ∫₀ˣ of a density that goes linearly from a to b over the unit interval, and its inverse.
double integral(double a, double b, double x) {
  return x * (a + x / 2 * (b - a));
}
double inverse_integral(double a, double b, double area) {
  const double root = std::sqrt(std::max(a * a + 2 * (b - a) * area, 0.0));
  return a + root > 0 ? std::min(2 * area / (a + root), 1.0) : 0;
}

/// The last i < n of an ascending sequence that is not above v; 0 if there is none.
template <class Sequence>
std::size_t last_not_above(std::size_t n, double v, Sequence at) {
  std::size_t i = 0;
  for (std::size_t step = std::bit_floor(n); step > 0; step /= 2)
    if (i + step < n && at(i + step) <= v) i += step;
  return i;
}

}  // namespace

Warp::Warp(Image density, std::size_t slices) : density_(std::move(density)) {
  const std::size_t w = density_.width, h = density_.height;
  rows_.resize(slices * h * w);
  marginal_.resize(slices * h);
  for (std::size_t k = 0; k < slices; ++k) {
    float* const d = density_.nodes.data() + k * w * h;
    double* const rows = rows_.data() + k * w * h;
    double* const marginal = marginal_.data() + k * h;
    sums(d, rows, marginal);
    const double total = marginal[h - 1];
    // A density of nothing is taken as even.
    if (!(total > 0)) std::fill_n(d, w * h, 1.0F);
    const double scale = total > 0 ? 1 / total : 1;
    for (std::size_t i = 0; i < w * h; ++i)
      d[i] = static_cast<float>(static_cast<double>(d[i]) * scale);
    sums(d, rows, marginal);
  }
}

Point Warp::sample(std::size_t slice, const Point& s) const {
  const std::size_t w = density_.width, h = density_.height;
  const double* const marginal = marginal_.data() + slice * h;
  const double* const rows = rows_.data() + slice * w * h;
  const double y_area = s.y * marginal[h - 1];
  const std::size_t y = last_not_above(h - 1, y_area, [&](std::size_t i) { return marginal[i]; });
  const double low = rows[y * w + w - 1], high = rows[(y + 1) * w + w - 1];
  const double part_y = inverse_integral(low, high, y_area - marginal[y]);
  const auto row_area = [&](std::size_t x) {
    return std::lerp(rows[y * w + x], rows[(y + 1) * w + x], part_y);
  };
  const double x_area = s.x * row_area(w - 1);
  const std::size_t x = last_not_above(w - 1, x_area, row_area);
  const float* const d = density_.slice(slice) + y * w + x;
  const auto at = [&](std::size_t dx) {
    return std::lerp(static_cast<double>(d[dx]), static_cast<double>(d[w + dx]), part_y);
  };
  const double part_x = inverse_integral(at(0), at(1), x_area - row_area(x));
  return {(static_cast<double>(x) + part_x) / static_cast<double>(w - 1),
          (static_cast<double>(y) + part_y) / static_cast<double>(h - 1)};
}

Point Warp::invert(const Mix& mix, const Point& u) const {
  const std::size_t w = density_.width, h = density_.height;
  const Cell c(u, w, h);
  double y_area = 0, x_area = 0, y_all = 0, x_all = 0;
  for (std::size_t k = 0; k < mix.slice.size(); ++k) {
    if (mix.weight[k] == 0) continue;
    const double* const marginal = marginal_.data() + mix.slice[k] * h;
    const double* const row = rows_.data() + (mix.slice[k] * h + c.y) * w;
    const float* const d = density_.slice(mix.slice[k]) + c.y * w + c.x;
    const auto at = [&](std::size_t dx) {
      return std::lerp(static_cast<double>(d[dx]), static_cast<double>(d[w + dx]), c.part_y);
    };
    y_area += mix.weight[k] * (marginal[c.y] + integral(row[w - 1], row[2 * w - 1], c.part_y));
    y_all += mix.weight[k] * marginal[h - 1];
    x_area += mix.weight[k] *
              (std::lerp(row[c.x], row[w + c.x], c.part_y) + integral(at(0), at(1), c.part_x));
    x_all += mix.weight[k] * std::lerp(row[w - 1], row[2 * w - 1], c.part_y);
  }
  // Where there is no density the mapping is not defined: any continuation will do.
  return {x_all > 0 ? x_area / x_all : u.x, y_all > 0 ? y_area / y_all : u.y};
}

void Warp::sums(const float* d, double* rows, double* marginal) const {
  const std::size_t w = density_.width, h = density_.height;
  for (std::size_t y = 0; y < h; ++y) {
    double sum = 0;
    for (std::size_t x = 0; x < w; ++x) {
      if (x > 0)
        sum += (static_cast<double>(d[y * w + x - 1]) + static_cast<double>(d[y * w + x])) / 2;
      rows[y * w + x] = sum;
    }
    marginal[y] = y == 0 ? 0 : marginal[y - 1] + (rows[y * w - 1] + rows[y * w + w - 1]) / 2;
  }
}

}  // namespace gonio::rgl
