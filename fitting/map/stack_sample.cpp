#include "fitting/map/stack_sample.h"

#include <algorithm>
#include <cmath>

namespace gonio {
namespace {

/// Pieces of a map that lie in a band of its rows.
struct Band {
  std::size_t y = 0;
  std::vector<std::size_t> x;
};
struct Pieces {
  std::size_t width = 0, height = 0;  ///< of each
  std::vector<Band> bands;            ///< as many pieces in each
};

constexpr std::size_t most_numbers = 1 << 24;  ///< that are read at once

/// Columns that bands of such a height may have; wide ones no more than the middle, so that neither time nor memory grows with them.
std::size_t columns_of(const StackReader& stack, std::size_t height) {
  const std::size_t of_row = height * stack.stack().images.size() * stack.channels().size();
  return std::clamp(most_numbers / of_row, std::size_t{1}, stack.width());
}

/// The k-th of n places in a room, at distances that no pattern of a surface has: by steps of the generalised golden ratio in two dimensions [Roberts 2018].
/// \param number  of the place among all of them
std::size_t place(std::size_t k, std::size_t n, std::size_t room, double step, std::size_t number) {
  const double within = std::fmod(0.5 + step * static_cast<double>(number), 1);
  return static_cast<std::size_t>((static_cast<double>(k) + within) / static_cast<double>(n) *
                                  static_cast<double>(room));
}
constexpr double step_across = 0.5698402909980532, step_down = 0.7548776662466927;

/// Squares of four in a few rows: fewer of many images.
Pieces few_squares(const StackReader& stack) {
  constexpr std::size_t least_rows = 4, most_of_row = 64;
  const std::size_t images = stack.stack().images.size(),
                    texels = least_rows *
                             std::clamp(std::size_t{1 << 14} / images, std::size_t{8}, most_of_row),
                    columns = columns_of(stack, 2), begin = (stack.width() - columns) / 2;
  Pieces p{std::min(columns, std::size_t{2}), std::min(stack.height(), std::size_t{2}), {}};
  const std::size_t block = p.width * p.height,
                    across = std::min(std::max<std::size_t>(texels / least_rows / block, 1),
                                      columns / p.width),
                    down = std::min(std::max(least_rows, texels / (across * block)),
                                    stack.height() / p.height);
  for (std::size_t r = 0; r < down; ++r) {
    Band& band = p.bands.emplace_back();
    band.y = place(r, down, stack.height() - p.height + 1, step_down, r);
    for (std::size_t k = 0; k < across; ++k)
      band.x.push_back(begin +
                       place(k, across, columns - p.width + 1, step_across, r * across + k));
  }
  return p;
}

Pieces large_squares(const StackReader& stack) {
  constexpr std::size_t side = 33, most_bands = 6, most_across = 4;
  Pieces p{std::min(side, stack.width()), std::min(side, stack.height()), {}};
  const std::size_t numbers =
                        p.width * p.height * stack.stack().images.size() * stack.channels().size(),
                    most = std::max<std::size_t>(most_numbers / numbers, 2),
                    columns = std::max(columns_of(stack, p.height), p.width),
                    across =
                        std::clamp<std::size_t>(columns / p.width, 1, std::min(most_across, most)),
                    down = std::clamp<std::size_t>(stack.height() / p.height * 2, 1,
                                                   std::min(most_bands, most / across));
  for (std::size_t r = 0; r < down; ++r) {
    Band& band = p.bands.emplace_back();
    band.y = place(r, down, stack.height() - p.height + 1, step_down, r);
    for (std::size_t k = 0; k < across; ++k)
      band.x.push_back((stack.width() - columns) / 2 +
                       place(k, across, columns - p.width + 1, step_across, r * across + k));
  }
  return p;
}

TexelSample sample_of(const StackReader& stack, const Pieces& pieces) {
  const std::size_t across = pieces.bands[0].x.size();
  TexelSample s;
  s.block = pieces.width * pieces.height;
  s.block_width = pieces.width;
  s.texels = pieces.bands.size() * across * s.block;
  s.shared = stack.shared();
  s.images = stack.stack().images.size();
  s.channels = stack.channels().size();
  s.values.resize(s.images * s.channels * s.texels);
  s.light.resize(3 * s.images * (s.shared ? 1 : s.texels));
  s.view.resize(s.light.size());
  if (stack.has_normals()) s.normal.resize(3 * s.texels);
  StackPart part;
  std::size_t to = 0;
  for (const Band& band : pieces.bands) {
    const std::size_t begin = band.x.front(), columns = band.x.back() + pieces.width - begin;
    stack.read({begin, band.y, columns, pieces.height}, part);
    for (const std::size_t x : band.x)
      for (std::size_t k = 0; k < s.block; ++k, ++to) {
        const std::size_t at = k / pieces.width * columns + x - begin + k % pieces.width;
        const auto piece = part.piece(at / StackPart::piece_texels);
        const std::size_t from = at - piece.first;
        const auto take = [&](std::span<const float> in, std::vector<float>& out) {
          for (std::size_t row = 0; (row + 1) * piece.texels <= in.size(); ++row)
            out[row * s.texels + to] = in[row * piece.texels + from];
        };
        take(piece.values, s.values);
        if (!s.shared) {
          take(piece.light, s.light);
          take(piece.view, s.view);
        }
        if (stack.has_normals()) take(piece.normal, s.normal);
      }
  }
  if (s.shared) {
    std::ranges::copy(part.piece(0).light, s.light.begin());
    std::ranges::copy(part.piece(0).view, s.view.begin());
  }
  s.of_light = stack.stack().values == StackValues::f_r_cosine;
  if (s.of_light)  // what was divided by n·l of the directions as given
    for (std::size_t i = 0; i < s.images; ++i)
      for (std::size_t t = 0; t < s.texels; ++t) {
        const auto by = static_cast<float>(cosine_of(s, i, t));
        for (std::size_t k = 0; k < s.channels; ++k)
          s.values[(i * s.channels + k) * s.texels + t] *= by;
      }
  return s;
}

}  // namespace

TexelSample small_sample(const StackReader& stack) {
  return sample_of(stack, few_squares(stack));
}
TexelSample sample_in_pieces(const StackReader& stack) {
  return sample_of(stack, large_squares(stack));
}

}  // namespace gonio
