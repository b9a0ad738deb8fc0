#include "fitting/map/curl.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "fitting/map/turns.h"

namespace gonio {
namespace {

/// Integrals around a loop from which the curl under any turn is made.
struct Loop {
  /// Of the slopes P and Q: along the lower side less along the upper one, and along the right side less along the left one.
  double p_across, q_across, p_up, q_up;

  double curl(const std::array<int, 4>& to) const {
    return std::abs(to[0] * p_across + to[1] * q_across + to[2] * p_up + to[3] * q_up);
  }
};

/// Slopes of a piece of a map, rows from above.
struct Slopes {
  std::size_t width, height;
  std::vector<double> p, q;
};

Slopes slopes_of(const TexelSample& s, const std::vector<float>& normals, std::size_t first) {
  constexpr double steepest = 5;
  Slopes all{s.block_width, s.block / s.block_width, {}, {}};
  for (std::size_t t = first; t < first + s.block; ++t) {
    const double z = double{normals[2 * s.texels + t]};
    for (const std::size_t axis : {0, 1}) {
      const double slope = -double{normals[axis * s.texels + t]} / z;
      (axis == 0 ? all.p : all.q)
          .push_back(std::abs(slope) < steepest ? slope : std::numeric_limits<double>::quiet_NaN());
    }
  }
  return all;
}

/// Sum along a side by the trapezoidal rule.
double along(const std::vector<double>& of, std::size_t first, std::size_t step, std::size_t size) {
  double sum = (of[first] + of[first + step * size]) / 2;
  for (std::size_t k = 1; k < size; ++k) sum += of[first + step * k];
  return sum;
}

void add_loops(const Slopes& s, std::size_t size, std::vector<Loop>& loops) {
  const std::size_t step = size < 16 ? size + 1 : size / 2, w = s.width;
  for (std::size_t y = 0; y + size < s.height; y += step)
    for (std::size_t x = 0; x + size < w; x += step) {
      const std::size_t upper = y * w + x, lower = upper + size * w, right = upper + size;
      const auto across = [&](const std::vector<double>& of) {
        return along(of, lower, 1, size) - along(of, upper, 1, size);
      };
      const auto up = [&](const std::vector<double>& of) {
        return along(of, right, w, size) - along(of, upper, w, size);
      };
      const Loop loop{across(s.p), across(s.q), up(s.p), up(s.q)};
      if (std::isfinite(loop.p_across + loop.q_across + loop.p_up + loop.q_up))
        loops.push_back(loop);
    }
}

struct Votes {
  double for_it = 0, against = 0, telling = 0, ratio = 1;
  /// Standard errors of a sign test.
  double decided() const {
    return std::abs(for_it - against) / std::sqrt(std::max(for_it + against, 1.0));
  }
  /// All for it, or all against, and by far.
  bool unanimous() const {
    constexpr double least = 3.5, far = 5;
    return std::min(for_it, against) == 0 && decided() >= least &&
           std::abs(std::log(ratio)) >= std::log(far);
  }
};

/// \param other  curls under another azimuth   \param noise  curl that chance makes
Votes votes(std::span<const double> given, std::span<const double> other, double noise) {
  constexpr double loud = 4;
  Votes v;
  std::vector<double> ratios;
  for (std::size_t k = 0; k < given.size(); ++k) {
    if (std::max(given[k], other[k]) <= loud * noise) continue;
    ++v.telling;
    v.for_it += 2 * other[k] < given[k];
    v.against += 2 * given[k] < other[k];
    ratios.push_back(other[k] / given[k]);
  }
  if (!ratios.empty()) v.ratio = median_of(std::move(ratios));
  return v;
}

}  // namespace

std::array<TurnOfNormals, 3> turns_of_normals(const TexelSample& s,
                                              const std::vector<float>& normals) {
  std::array<TurnOfNormals, 3> found{{{0}, {2}, {4}}};
  constexpr double certain = 6, nearly_all = 0.7, most = 0.6, few = 0.125, much = 12;
  constexpr double least_noise = 0.002;  // of normals that are known to 0.1°
  std::vector<Slopes> pieces;
  for (std::size_t t = 0; t + s.block <= s.texels; t += s.block)
    pieces.push_back(slopes_of(s, normals, t));
  double finest = 0;
  std::array<double, 3> strongest{};
  std::array<bool, 3> contradicted{};
  std::array<std::array<std::size_t, 2>, 3> unanimous{};  // sizes of loops, against and for it
  for (std::size_t size = 1; size < s.block_width; size *= 2) {
    std::vector<Loop> loops;
    for (const auto& piece : pieces) add_loops(piece, size, loops);
    if (loops.empty()) break;
    const auto curls = [&](const std::array<int, 4>& to) {
      std::vector<double> all;
      for (const auto& loop : loops) all.push_back(loop.curl(to));
      return all;
    };
    const auto given = curls({1, 0, 0, 1});
    double least = median_of(given);
    std::array<std::vector<double>, 3> others;
    for (std::size_t k = 0; k < found.size(); ++k) {
      others[k] = curls(turns[found[k].turn].to);
      least = std::min(least, median_of(others[k]));
    }
    const double noise = 1.4826 * least;
    if (size == 1) finest = std::max(noise, least_noise);
    // Noise grows with the root of a side.  Where far more is left under each azimuth, the surface
    // has steps.
    if (noise > much * finest * std::sqrt(static_cast<double>(size))) continue;
    for (std::size_t k = 0; k < found.size(); ++k) {
      const Votes v = votes(given, others[k], noise);
      // Steps have as large curls under both.
      if (v.telling >= 0.05 * static_cast<double>(loops.size()) && v.telling >= 36 &&
          std::abs(std::log(v.ratio)) < 0.1)
        contradicted[k] = true;
      // Where the normals of many texels are not known, few loops are left, but of several sizes.
      auto& sizes = unanimous[k][v.for_it > v.against];
      sizes += v.unanimous();
      if (v.decided() < certain && !(v.unanimous() && sizes > 1)) continue;
      const bool is_right = v.for_it >= nearly_all * v.telling && v.against <= few * v.for_it;
      if (!is_right && v.against < most * v.telling) continue;
      const auto verdict = is_right ? AzimuthVerdict::right : AzimuthVerdict::excluded;
      contradicted[k] = contradicted[k] ||
                        (found[k].verdict != AzimuthVerdict::open && found[k].verdict != verdict);
      if (v.decided() <= strongest[k]) continue;
      strongest[k] = v.decided();
      found[k] = {found[k].turn, verdict, v.ratio};
    }
  }
  for (std::size_t k = 0; k < found.size(); ++k)
    if (contradicted[k]) found[k] = {found[k].turn};
  return found;
}

}  // namespace gonio
