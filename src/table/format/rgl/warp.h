#pragma once
/// \file
/// Grids over the unit square, and the mappings by which the RGL's measurements are sampled
/// [Dupuy & Jakob 2018].

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace gonio::rgl {

struct Point {
  double x, y;
};

/// A point of the unit square in a grid of width × height nodes.
struct Cell {
  std::size_t x, y;
  double part_x, part_y;

  Cell(const Point& p, std::size_t width, std::size_t height) {
    const auto place = [](double u, std::size_t n, std::size_t& i, double& part) {
      const double at = std::clamp(u, 0.0, 1.0) * static_cast<double>(n - 1);
      i = std::min(static_cast<std::size_t>(at), n - 2);
      part = at - static_cast<double>(i);
    };
    place(p.x, width, x, part_x);
    place(p.y, height, y, part_y);
  }

  struct Corner {
    std::size_t x, y;
    double weight;
  };
  std::array<Corner, 4> corners() const {
    return {{{x, y, (1 - part_x) * (1 - part_y)},
             {x + 1, y, part_x * (1 - part_y)},
             {x, y + 1, (1 - part_x) * part_y},
             {x + 1, y + 1, part_x * part_y}}};
  }
};

/// f over the nodes of a grid [slice][y][x]; bilinear between them.
struct Image {
  std::size_t width = 0, height = 0;
  std::vector<float> nodes;

  const float* slice(std::size_t k) const { return nodes.data() + k * width * height; }
  double operator()(const Point& p, std::size_t k = 0) const {
    const Cell c(p, width, height);
    const float* low = slice(k) + c.y * width + c.x;
    const auto along = [&](const float* v) {
      return std::lerp(static_cast<double>(v[0]), static_cast<double>(v[1]), c.part_x);
    };
    return std::lerp(along(low), along(low + width), c.part_y);
  }
};

/// Slices to be mixed, with their weights.
struct Mix {
  std::array<std::size_t, 4> slice{};
  std::array<double, 4> weight{};
};

/// Densities over the unit square, bilinear between nodes, each of integral 1; and the mapping that
/// makes them uniform: y by the marginal distribution over rows, x by the conditional one in the row.
class Warp {
 public:
  Warp(Image density, std::size_t slices);
  Point sample(std::size_t slice, const Point&) const;
  /// Inverse of sample() for densities mixed.
  Point invert(const Mix&, const Point&) const;
  const Image& density() const { return density_; }

 private:
  void sums(const float* d, double* rows, double* marginal) const;

  Image density_;
  std::vector<double> rows_, marginal_;  ///< cumulated: [slice][y][x], [slice][y]
};

}  // namespace gonio::rgl
