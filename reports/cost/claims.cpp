// Claims on what forms cost: masking forms beside each other, exact Fresnel, a fifth power.
#include "reports/cost/claims.h"

#include <algorithm>
#include <cmath>

#include "reports/finding/words.h"

#include <fmt/format.h>

namespace gonio {
namespace {

const CostRow* in_cache(const CostRows& r, std::string_view id, std::string_view way = "") {
  return find_row(r.rows, id, "float", r.machine.instruction_sets.back(), "cache", way);
}
/// Nothing tells the times of these apart (timing.h).
bool is_tie(const ComparedTime& a, const ComparedTime& b) {
  return !difference(a, b).survives;
}
bool is_tie(const CostRow& a, const CostRow& b) {
  return is_tie({a.time, a.each}, {b.time, b.each});
}
std::string ns(const Timing& t) {
  return fmt::format("{:.2f} ns", t.ns);
}

void schlick_beside_joint(Findings& to, const CostRows& r) {
  const auto *schlick = in_cache(r, "masking.schlick_ggx.direct"),
             *joint = in_cache(r, "masking.ue_joint.clamped"),
             *plain = in_cache(r, "masking.hammon");  // in the fewest operations
  if (!schlick || !joint || !plain) return;
  const auto longer_than = [&](const CostRow& other) {
    return schlick->time.ns > other.time.ns && !is_tie(*schlick, other);
  };
  to.judge(
      "Schlick's masking costs a bit more than the joint approximation", "",
      verdict(longer_than(*joint), longer_than(*plain)),
      fmt::format("Schlick's {}, Unreal's joint form {}{}, {}{} with its clamp", ns(schlick->time),
                  ns(plain->time), is_tie(*schlick, *plain) ? " (within the spreads)" : "",
                  ns(joint->time), is_tie(*schlick, *joint) ? " (within the spreads)" : ""),
      "times are in float, from cache.");
}

void exact_is_slow(Findings& to, const CostRows& r) {
  const auto *schlick = in_cache(r, "fresnel.schlick"), *exact = in_cache(r, "fresnel.dielectric"),
             *model = in_cache(r, "ggx/smith_ggx.correlated/schlick", "composed"),
             *exact_model = in_cache(r, "ggx/smith_ggx.correlated/dielectric", "composed");
  if (!schlick || !exact || !model || !exact_model) return;
  const double term = exact->time.ns / schlick->time.ns,
               whole = exact_model->time.ns / model->time.ns;
  to.judge("the exact Fresnel equations are slow", "",
           verdict(whole > 1.5, term > 1.5 && !is_tie(*exact, *schlick)),
           fmt::format("exact takes {:.1f} times Schlick's time", term),
           fmt::format(
               "the equations are those of a dielectric. A whole GGX model, composed of its terms, "
               "takes {:.2f} times as long with them. Both are timed in float, from cache.",
               whole));
}

void pow5(Findings& to, const CostRows& r) {
  const auto of = [&](std::string_view label) {
    return std::ranges::find_if(
        r.points, [&](const CostPoint& p) { return p.picture == "power" && p.label == label; });
  };
  const auto by_pow = of("pow"), by_hand = of("Pow5");
  if (by_pow == r.points.end() || by_hand == r.points.end()) return;
  to.judge("writing one's own Pow5 is faster than pow", "",
           verdict(by_pow->time.ns > by_hand->time.ns && !is_tie({by_pow->time}, {by_hand->time})),
           fmt::format("pow takes {:.1f} times as long", by_pow->time.ns / by_hand->time.ns),
           "timed in a loop that the compiler may vectorise. The values differ only by rounding.");
}

/// Schlick's form at each cosine, with a fifth power.
template <class Fifth>
Timed schlick(const std::vector<float>& cosine, std::vector<float>& to, Fifth fifth) {
  return {cosine.size(), [&cosine, &to, fifth] {
            for (std::size_t i = 0; i < cosine.size(); ++i)
              to[i] = 0.04F + 0.96F * fifth(1 - cosine[i]);
          }};
}

}  // namespace

std::vector<CostPoint> power_points(const TimingOptions& timing) {
  constexpr std::size_t samples = 512;
  std::vector<float> cosine, by_pow(samples), by_hand(samples);
  for (std::size_t i = 0; i < samples; ++i)
    cosine.push_back((static_cast<float>(i) + 0.5F) / static_cast<float>(samples));
  const auto times =
      time_all({schlick(cosine, by_pow, [](float x) { return std::pow(x, 5.0F); }),
                schlick(cosine, by_hand, [](float x) { return x * (x * x) * (x * x); })},
               timing);
  double most = 0;
  for (std::size_t i = 0; i < samples; ++i)
    most = std::max(most, static_cast<double>(std::abs(by_pow[i] - by_hand[i])));
  return {{"power", "fifth power", "pow", times[0], 0, 0},
          {"power", "fifth power", "Pow5", times[1], most, 0}};
}

void judge_costs(Findings& to, const CostRows& r) {
  schlick_beside_joint(to, r);
  exact_is_slow(to, r);
  pow5(to, r);
}

}  // namespace gonio
