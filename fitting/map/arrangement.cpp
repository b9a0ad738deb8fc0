#include "fitting/map/arrangement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>
#include <string_view>
#include <utility>

#include "fitting/map/curl.h"
#include "fitting/map/task.h"
#include "fitting/map/turns.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace gonio {
namespace {

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
  std::size_t turn = turns.size();  ///< of azimuths, into turns
  bool decides = false;             ///< nobody may believe an azimuth before this turn is excluded
  bool is_doubtful = true;          ///< said also where it is not sure
};

/// Angles from the plane become angles from the normal.
void count_from_normal(std::vector<float>& light, std::size_t run) {
  for (std::size_t at = 0; at + 3 * run <= light.size(); at += 3 * run)
    for (std::size_t k = at; k < at + run; ++k) {
      float &x = light[k], &y = light[k + run], &z = light[k + 2 * run];
      const float flat = std::hypot(x, y);
      if (!(flat > 0)) {
        z = std::nanf("");  // in the plane: no light
        continue;
      }
      x *= z / flat;
      y *= z / flat;
      z = flat;
    }
}

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

/// \param with_tangent  the model has one
std::vector<Arrangement> arrangements(const TexelSample& s, bool with_tangent) {
  std::vector<Arrangement> all;
  const std::size_t run = s.shared ? 1 : s.texels;
  const auto add = [&](std::string_view whose, std::string_view key, bool decides,
                       std::vector<std::vector<float> TexelSample::*> which) {
    for (std::size_t k = 0; k < turns.size(); ++k)
      all.push_back({[=, by = turns[k], texels = s.texels](TexelSample& to) {
                       for (const auto vectors : which)
                         turn(to.*vectors, vectors == &TexelSample::normal ? texels : run, by);
                     },
                     fmt::format("{} is {}", whose, turns[k].what),
                     fmt::format("{} becomes {}, a vector's (x, y) {}", key, turns[k].azimuth,
                                 turns[k].vector),
                     k, decides});
  };
  // The likeliest first: of several that are equally good the first is named.
  add("the light's azimuth", "phi_i", true, {&TexelSample::light});
  add("the view's azimuth", "phi_o", false, {&TexelSample::view});
  if (s.normal.empty())
    add("the azimuth of light and view", "φ, as phi_i and phi_o,", with_tangent,
        {&TexelSample::light, &TexelSample::view});
  else
    add("the normals' azimuth", "φ, the azimuth of X and Y,", true, {&TexelSample::normal});
  all.push_back({[run](TexelSample& to) { count_from_normal(to.light, run); },
                 "the light's angle is measured from the plane, and not from the normal",
                 "theta_i becomes 90° − θ, a vector's length in the plane and its z are exchanged",
                 turns.size(), false, false});
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
  const auto all = arrangements(s, TexelTask(asked, s.channels).turns());
  std::vector<ResidualRatio> seen(all.size());
  tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t k) {
    TexelSample sample = s;
    all[k].make(sample);
    seen[k] = compare_residuals(residuals_of_both(sample, fit_sample(sample, asked)), as_given,
                                residual_floor(given));
    if (seen[k].texels * 2 < compared) seen[k] = {};
  });
  // Of a surface many texels may be indifferent, as the threads of cloth that run along one axis:
  // those that tell decide.
  const auto enough = std::max(few_texels, compared / 10);
  const auto decided = [&](std::size_t for_it, std::size_t against) {
    return for_it >= enough && 20 * against <= for_it;
  };
  OtherArrangement best;
  std::size_t best_at = 0;
  double least = 1;
  bool others_excluded = true, half_turn_excluded = true;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const ResidualRatio& r = seen[k];
    if (all[k].decides && !decided(r.doubled, r.halved))
      (all[k].turn == half_turn ? half_turn_excluded : others_excluded) = false;
    const bool by_those_that_tell = decided(r.halved, r.doubled);
    if (r.lower < 0.8 || (r.ratio > 0.9 && !by_those_that_tell)) continue;
    // The first of those that are as good.
    const double left = r.ratio <= 0.9
                            ? r.ratio
                            : 1 - static_cast<double>(r.halved) / static_cast<double>(r.texels);
    const bool is_sure = by_those_that_tell || (r.ratio <= 0.5 && r.lower >= 0.9);
    if (left > 0.98 * least || !(is_sure || all[k].is_doubtful)) continue;
    least = left;
    best.what = all[k].what;
    best.cure = {all[k].cure};
    best.ratio = by_those_that_tell ? std::min(r.ratio, 0.5) : r.ratio;
    best.sure = is_sure;
    best_at = k;
  }
  if (others_excluded)
    best.azimuth = half_turn_excluded ? AzimuthCheck::checked : AzimuthCheck::half_turn_open;
  if (best.what.empty() || best.sure) return best;
  // One that only helps is no cure.
  TexelSample sample = s;
  all[best_at].make(sample);
  if (shared_residuals(sample, fit_sample(sample, better), better) > 0)
    best = OtherArrangement{{}, {}, "an rms", 1, false, best.azimuth};
  return best;
}

OtherArrangement arrangement_of_normals(const TexelSample& s,
                                        const TexelFit& refined,
                                        const LampsOfList& lamps) {
  OtherArrangement found;
  const auto seen = turns_of_normals(s, refined.normal);
  if (std::ranges::all_of(seen, [](auto& t) { return t.verdict == AzimuthVerdict::excluded; }))
    found.azimuth = AzimuthCheck::half_turn_open;
  std::vector<TurnOfNormals> right;
  std::ranges::copy_if(seen, std::back_inserter(right),
                       [](auto& t) { return t.verdict == AzimuthVerdict::right; });
  if (right.empty()) return found;
  // Where a lamp of the list stands.
  const auto side = [](int x, int y) {
    return x > 0 ? "right" : x < 0 ? "left" : y > 0 ? "upper" : "lower";
  };
  const bool of_one_pair = right.size() == 1;
  found.cure = {
      of_one_pair
          ? fmt::format("look at {} first: which side of a bump is bright? (the list has that "
                        "lamp on the right)",
                        lamps.right)
          : fmt::format("look at {} and then at {}: which side of a bump is bright in each? (the "
                        "list has the one lamp on the right, and the other on top)",
                        lamps.right, lamps.top)};
  for (const auto& t : right) {
    found.ratio = std::min(found.ratio, t.ratio);
    for (const auto& turn : {turns[t.turn], turns[t.turn + 1]}) {
      found.what += fmt::format(
          "{}{}", found.what.empty() ? "the light's azimuth is " : "; or it is ", turn.what);
      const std::string sides =
          of_one_pair ? fmt::format("the {} side", side(turn.to[0], turn.to[2]))
                      : fmt::format("the {} side, and then the {} one",
                                    side(turn.to[0], turn.to[2]), side(turn.to[1], turn.to[3]));
      found.cure.push_back(fmt::format("{}: phi_i becomes {}, a vector's (x, y) {}", sides,
                                       turn.azimuth, turn.vector));
    }
  }
  found.measure = "curl of the refined normals";
  found.sure = true;
  return found;
}

std::string words_of(AzimuthCheck azimuth) {
  switch (azimuth) {
    case AzimuthCheck::checked:
      return "checked";
    case AzimuthCheck::half_turn_open:
      return "checked, but for half a turn, which makes hollows of bumps: compare with a feature "
             "that you know";
    case AzimuthCheck::open:
      break;
  }
  return "could not be checked on this surface: photograph a coin or a ball under the same lamps, "
         "or compare with a feature that you know";
}

std::string refusal_of(const OtherArrangement& a) {
  std::string line = fmt::format("directions: {}; so read, the {} is {:.3g} times less", a.what,
                                 a.measure, 1 / a.ratio);
  for (const auto& cure : a.cure) line += "; " + cure;
  return line + "; --as-given fits all the same";
}

}  // namespace gonio
