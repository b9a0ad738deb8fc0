#include "fitting/judge/scales.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace gonio::misfit {
namespace {

constexpr double chance_of_scales = 0.05;
constexpr std::size_t few_to_scale =
    7;  ///< angles, of which none can run smoothly, see are_smooth()
constexpr double most_between_few = 0.045;
constexpr std::size_t most_to_scale = 1 << 13;  ///< values looked at

}  // namespace

std::size_t number_of_angles(const Left& left, SharedAngle axis) {
  return left.angles[static_cast<std::size_t>(axis)];
}

Scales::Scales(const Left& all_values, bool by_incident)
    : left_(thinned(all_values, most_to_scale)), now_(regress(left_, {}, {}, true)) {
  if (now_.rounded) return;
  using enum SharedAngle;
  if (by_incident && has_room(left_, incident)) open({incident});
  while (open_best({incident, outgoing, azimuth})) {
  }
  refine(light, {incident});
  refine(detector, {outgoing, azimuth});
  follows_incident = is_open(incident) && are_smooth(left_, axes_up_to(incident));
  for (const auto& s : all) {
    between_few =
        between_few || (s.of != incident && number_of_angles(left_, s.of) < few_to_scale &&
                        s.square > most_between_few * most_between_few);
    of_all = of_all || common_factor(left_, axes_up_to(s.of)) > most_of_a_scale;
  }
}

std::vector<SharedAngle> Scales::axes() const {
  std::vector<SharedAngle> of;
  for (const auto& s : all) of.push_back(s.of);
  return of;
}

bool Scales::is_open(SharedAngle a) const {
  return std::ranges::find(all, a, &Scaled::of) != all.end();
}

std::vector<SharedAngle> Scales::axes_with(SharedAngle a) const {
  auto of = axes();
  of.push_back(a);
  return of;
}

std::vector<SharedAngle> Scales::axes_up_to(SharedAngle last) const {
  auto of = axes();
  std::erase(of, last);
  of.push_back(last);
  return of;
}

Regression Scales::with(SharedAngle a) const {
  return regress(left_, axes_with(a), {}, true);
}

void Scales::open(SharedAngle a) {
  open({a, 0, {}}, with(a));
}

void Scales::open(Scaled a, Regression there) {
  luck = std::min(luck, luck_of_scales(now_, there));
  const double scales = static_cast<double>(there.scales) - static_cast<double>(now_.scales);
  a.square += std::max(0.0, now_.left - there.left * (1 + scales / left_.samples));
  all.push_back(std::move(a));
  now_ = std::move(there);
}

bool Scales::open_best(std::initializer_list<SharedAngle> among) {
  std::optional<SharedAngle> best;
  Regression of_best;
  double least = chance_of_scales;
  for (const SharedAngle a : among) {
    if (is_open(a) || !has_room(left_, a)) continue;
    Regression there = with(a);
    const double p = luck_of_scales(now_, there);
    if (p > least || (p == least && best && there.left >= of_best.left)) continue;
    if (a != SharedAngle::incident && are_smooth(left_, axes_with(a))) continue;
    least = p, best = a, of_best = std::move(there);
  }
  if (best) open({*best, 0, {}}, std::move(of_best));
  return best.has_value();
}

void Scales::refine(SharedAngle a, std::initializer_list<SharedAngle> coarser) {
  const auto same = [&](SharedAngle x) {
    return number_of_angles(left_, x) == number_of_angles(left_, a);
  };
  if (!has_room(left_, a) || std::ranges::any_of(coarser, same)) return;
  Scaled finer{a, 0, {}};
  std::vector<SharedAngle> of;
  for (const auto& s : all)
    if (std::ranges::find(coarser, s.of) == coarser.end())
      of.push_back(s.of);
    else
      finer.coarser.push_back(s.of), finer.square += s.square;
  of.push_back(a);
  Regression there = regress(left_, of, {}, true);
  if (luck_of_scales(now_, there) > chance_of_scales || are_smooth(left_, of)) return;
  std::erase_if(all,
                [&](const Scaled& s) { return std::ranges::find(coarser, s.of) != coarser.end(); });
  open(std::move(finer), std::move(there));
}

}  // namespace gonio::misfit
