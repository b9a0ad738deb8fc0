#include "fitting/map/arrangement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace gonio {
namespace {

/// x and y of directions become others: a mirror image or a turn by quarters.
struct Turn {
  std::array<int, 4> to;  ///< x' = to₀ x + to₁ y, y' = to₂ x + to₃ y
  std::string_view what;
  std::string_view azimuth;  ///< what the azimuth becomes, φ being as given
  std::string_view vector;   ///< what becomes of x and y
};
constexpr std::array<Turn, 7> turns{
    {{{1, 0, 0, -1}, "negated, or y points down", "−φ", "(x, −y)"},
     {{-1, 0, 0, 1}, "counted from −x and backwards", "180° − φ", "(−x, y)"},
     {{0, 1, 1, 0}, "counted from y, or x and y are exchanged", "90° − φ", "(y, x)"},
     {{0, -1, -1, 0}, "counted from −y and backwards", "270° − φ", "(−y, −x)"},
     {{0, -1, 1, 0}, "a quarter turn behind", "φ + 90°", "(−y, x)"},
     {{0, 1, -1, 0}, "a quarter turn ahead", "φ − 90°", "(y, −x)"},
     {{-1, 0, 0, -1}, "half a turn off", "φ + 180°", "(−x, −y)"}}};

/// \param vectors  [item][3][run], as light, view and normals are
void turn(std::vector<float>& vectors, std::size_t run, const Turn& by) {
  for (std::size_t at = 0; at + 3 * run <= vectors.size(); at += 3 * run)
    for (std::size_t k = 0; k < run; ++k) {
      float& x = vectors[at + k];
      float& y = vectors[at + run + k];
      const float was = x;
      x = static_cast<float>(by.to[0]) * was + static_cast<float>(by.to[1]) * y;
      y = static_cast<float>(by.to[2]) * was + static_cast<float>(by.to[3]) * y;
    }
}

/// The values of the images in another order: those of image order[i] are taken for image i's.
void reorder(TexelSample& s, const std::vector<std::size_t>& order) {
  const std::size_t run = s.channels * s.texels;
  const auto was = s.values;
  for (std::size_t i = 0; i < s.images; ++i)
    std::copy_n(was.begin() + static_cast<std::ptrdiff_t>(order[i] * run), run,
                s.values.begin() + static_cast<std::ptrdiff_t>(i * run));
}

/// Another arrangement, by what makes it of the given one.
struct Arrangement {
  std::function<void(TexelSample&)> make;
  std::string what, cure;
};

/// Orders in which images are listed by mistake.
std::vector<std::pair<std::vector<std::size_t>, std::string>> orders(std::size_t images) {
  std::vector<std::size_t> given(images);
  std::iota(given.begin(), given.end(), std::size_t{0});
  std::vector<std::pair<std::vector<std::size_t>, std::string>> all;
  if (images < 2) return all;
  all.emplace_back(std::vector(given.rbegin(), given.rend()), "the images are in reverse order");
  auto further = given, back = given;
  std::ranges::rotate(further, further.begin() + 1);
  std::ranges::rotate(back, back.end() - 1);
  all.emplace_back(further, "each image stands one place late");
  all.emplace_back(back, "each image stands one place early");
  // 1, 10, 11, 2 … for 1, 2, …, from 0 and from 1.
  for (const std::size_t from : {std::size_t{0}, std::size_t{1}}) {
    auto sorted = given;
    std::ranges::sort(sorted, {}, [&](std::size_t i) { return std::to_string(i + from); });
    if (sorted == given) continue;
    std::vector<std::size_t> inverse(images);
    for (std::size_t i = 0; i < images; ++i) inverse[sorted[i]] = i;
    for (auto* order : {&inverse, &sorted})
      all.emplace_back(*order, "the images are ordered as words, 1, 10, 2, and not as numbers");
  }
  return all;
}

std::vector<Arrangement> arrangements(const TexelSample& s) {
  std::vector<Arrangement> all;
  const std::size_t run = s.shared ? 1 : s.texels;
  const auto add = [&](std::string_view whose, std::string_view key, const Turn& by,
                       std::vector<std::vector<float> TexelSample::*> which) {
    all.push_back({[=, texels = s.texels](TexelSample& to) {
                     for (const auto vectors : which)
                       turn(to.*vectors, vectors == &TexelSample::normal ? texels : run, by);
                   },
                   fmt::format("{} is {}", whose, by.what),
                   fmt::format("{} becomes {}, a vector's (x, y) {}", key, by.azimuth, by.vector)});
  };
  // The likeliest first: of several that are equally good the first is named.
  for (const auto& by : turns) add("the light's azimuth", "phi_i", by, {&TexelSample::light});
  for (const auto& by : turns) add("the view's azimuth", "phi_o", by, {&TexelSample::view});
  for (const auto& by : turns)
    if (s.normal.empty())
      add("the azimuth of light and view", "φ, as phi_i and phi_o,", by,
          {&TexelSample::light, &TexelSample::view});
    else
      add("the normals' azimuth", "φ, the azimuth of X and Y,", by, {&TexelSample::normal});
  for (auto& [order, what] : orders(s.images))
    all.push_back({[order = order](TexelSample& to) { reorder(to, order); }, what,
                   "list them in the order of their directions"});
  return all;
}

}  // namespace

OtherArrangement other_arrangement(const TexelSample& s, TexelOptions asked, TexelOptions better) {
  for (auto* o : {&asked, &better}) o->metric = Metric::l2_cosine;
  const TexelFit given = fit_sample(s, asked);
  const auto residuals_of_both = [&](const TexelSample& sample, const TexelFit& fit) {
    auto left = light_residuals(sample, fit, given);
    if (better.model == asked.model) return left;
    const auto other = light_residuals(sample, fit_sample(sample, better), given);
    for (std::size_t t = 0; t < left.size(); ++t) left[t] = std::fmin(left[t], other[t]);
    return left;
  };
  const auto as_given = residuals_of_both(s, given);
  const auto compared = static_cast<std::size_t>(
      std::ranges::count_if(as_given, [](double left) { return left >= 0; }));
  const auto all = arrangements(s);
  std::vector<ResidualRatio> seen(all.size());
  tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t k) {
    TexelSample sample = s;
    all[k].make(sample);
    seen[k] = compare_residuals(residuals_of_both(sample, fit_sample(sample, asked)), as_given,
                                residual_floor(given));
    if (seen[k].texels * 2 < compared) seen[k] = {};
  });
  OtherArrangement best;
  std::size_t best_at = 0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    // The first of those that are as good.
    if (seen[k].lower < 0.8 || seen[k].ratio > 0.9 || seen[k].ratio > 0.98 * best.ratio) continue;
    best = {all[k].what, all[k].cure, "an rms", seen[k].ratio,
            seen[k].ratio <= 0.5 && seen[k].lower >= 0.9};
    best_at = k;
  }
  if (best.what.empty() || best.sure) return best;
  // One that only helps is no cure.
  TexelSample sample = s;
  all[best_at].make(sample);
  return shared_residuals(sample, fit_sample(sample, better), better) > 0 ? OtherArrangement{}
                                                                          : best;
}

OtherArrangement arrangement_of_normals(const TexelSample& s, const TexelFit& refined) {
  OtherArrangement found;
  if (s.block != 4 || refined.normal.empty()) return found;
  // Changes of the slopes P along x and Q along y, in each square of texels.
  struct Changes {
    double p_x, p_y, q_x, q_y;
  };
  std::vector<Changes> squares;
  for (std::size_t t = 0; t < s.texels; t += s.block) {
    const auto slope = [&](std::size_t axis, std::size_t k) {
      return double{-refined.normal[axis * s.texels + t + k]} /
             double{refined.normal[2 * s.texels + t + k]};
    };
    const auto along_x = [&](std::size_t a) {
      return slope(a, 1) + slope(a, 3) - slope(a, 0) - slope(a, 2);
    };
    const auto along_y = [&](std::size_t a) {  // upwards
      return slope(a, 0) + slope(a, 1) - slope(a, 2) - slope(a, 3);
    };
    const Changes c{along_x(0), along_y(0), along_x(1), along_y(1)};
    if (std::isfinite(c.p_x + c.p_y + c.q_x + c.q_y)) squares.push_back(c);
  }
  const auto curls = [&](const std::array<int, 4>& to) {
    std::vector<double> all;
    for (const auto& c : squares)
      all.push_back(std::abs(to[0] * c.p_y + to[1] * c.q_y - to[2] * c.p_x - to[3] * c.q_x));
    return all;
  };
  const auto given = curls({1, 0, 0, 1});
  constexpr std::size_t few_squares = 32;  // so that chance does not accuse
  if (given.size() < few_squares) return found;
  // One of each two that differ by half a turn.
  for (const std::size_t k : {0, 2, 4}) {
    const auto now = curls(turns[k].to);
    std::size_t lower = 0;
    for (std::size_t q = 0; q < now.size(); ++q) lower += now[q] < given[q];
    const double ratio = median_of(now) / median_of(given);
    // Half as much in most squares; or less in more of them than chance makes, by six standard
    // errors of a sign test.
    const auto n = static_cast<double>(now.size()), less = static_cast<double>(lower);
    const bool sure =
        (ratio <= 0.5 && less >= 0.8 * n) || (ratio <= 0.8 && less >= n / 2 + 6 * std::sqrt(n) / 2);
    if (!sure || ratio >= found.ratio) continue;
    const auto &one = turns[k], &other = turns[k + 1];
    found = {
        fmt::format("the light's azimuth is {}; or it is {}", one.what, other.what),
        fmt::format("phi_i becomes {}, a vector's (x, y) {}, if the surface then has its bumps and "
                    "hollows right; else {}, and {}",
                    one.azimuth, one.vector, other.azimuth, other.vector),
        "a curl of the refined normals, which a surface's have not,", ratio, true};
  }
  return found;
}

}  // namespace gonio
