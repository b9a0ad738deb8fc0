#include "table/health/around_one_light.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/half_difference.h"

namespace gonio {
namespace {

Direction half_vector_of(const Direction& a, const Direction& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

}  // namespace

bool counts_in_integral(Mask m, bool noisy) {
  return m == Mask::valid || (m == Mask::negative && noisy);
}

AroundOneLight::AroundOneLight(const Table& t,
                               const std::vector<std::size_t>& samples,
                               bool half,
                               bool noisy)
    : table_(t), at_(t), noisy_(noisy) {
  const DirectionList& l = *t.list();
  const Direction wi = direction(l.theta_i_deg[samples[0]] * degree, 0);
  for (const std::size_t i : samples) {
    const double phi = (l.phi_o_deg[i] - l.phi_i_deg[i]) * degree;
    for (const double side : {phi, -phi}) {
      const Direction wo = direction(l.theta_o_deg[i] * degree, side);
      all_.push_back({wo, theta_of(half_vector_of(wi, wo)), i});
      if (!half) break;  // else the other half is its mirror image
    }
  }
  // A direction looks only at those no farther from it in zenith angle than it may be at all.
  std::ranges::stable_sort(all_, {}, height);
  innermost_ = &*std::ranges::min_element(all_, {}, &Sample::theta_h);
  constexpr double further = 1.5, least = 0.1 * degree;
  for (const Sample& s : all_)
    if (s.theta_h > std::max(further * innermost_->theta_h, least) &&
        (!next_ || s.theta_h < next_->theta_h))
      next_ = &s;
}

void AroundOneLight::operator()(const DirectionPair& p, std::span<Between> channels) const {
  const double theta_h = theta_of(half_vector_of(p.wi, p.wo));
  const Near n = near(p.wo, theta_h);
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const double first = value(n.first, c), other = value(n.across, c);
    Between& f = channels[c];
    f = {first, first, 0};
    if (!std::isnan(other)) {
      const double part = std::clamp(
          (theta_h - n.first->theta_h) / (n.across->theta_h - n.first->theta_h), 0.0, 1.0);
      f.line = std::lerp(first, other, part);
      f.doubt =
          f.line - std::pow(std::max(first, 0.0), 1 - part) * std::pow(std::max(other, 0.0), part);
      // Noise below 0 has no logarithm.
      f.middle = first > 0 && other > 0 ? f.line - f.doubt / 2 : f.line;
    } else if (theta_h < innermost_->theta_h) {
      const double in = value(innermost_, c), out = value(next_, c);
      if (in > 0 && out > 0) f.doubt = first * std::abs(in / out - 1);
    } else {
      const double second = value(n.second, c);
      f.doubt = std::isnan(second) ? std::abs(first) : std::abs(first - second) / 2;
    }
  }
}

AroundOneLight::Near AroundOneLight::near(const Direction& wo, double theta_h) const {
  constexpr double far_deg = 3 * reach_deg;  // of those beside the nearest
  const double zenith = theta_of(wo), margin = far_deg * degree + 1e-6;
  const double highest = zenith < margin ? 1.0 : std::cos(zenith - margin);
  const double reach = std::cos(reach_deg * degree), far = std::cos(far_deg * degree);
  Near n;
  std::array<double, 2> closeness{-1, -1};  // of the first and the second
  std::array<const Sample*, 2> side{};      // the nearest within and without its θ_h
  std::array<double, 2> closest{-1, -1};
  auto s = std::ranges::lower_bound(all_, std::cos(zenith + margin), {}, height);
  for (; s != all_.end() && s->wo.z <= highest; ++s) {
    const double c = dot(s->wo, wo);
    if (c < far) continue;
    const bool without = s->theta_h > theta_h;
    if (c > closest[without]) closest[without] = c, side[without] = &*s;
    if (c > closeness[0] || (c == closeness[0] && s->number < n.first->number)) {
      n.second = n.first, closeness[1] = closeness[0];
      n.first = &*s, closeness[0] = c;
    } else if (c > closeness[1] && s->number != n.first->number) {
      n.second = &*s, closeness[1] = c;
    }
  }
  if (!(closeness[0] >= reach)) return {};
  n.across = side[n.first->theta_h > theta_h ? 0 : 1];
  return n;
}

double AroundOneLight::value(const Sample* s, std::size_t channel) const {
  if (!s) return std::nan("");
  const double v = table_.values[channel][s->number];
  return counts_in_integral(mask(at_(s->number), v), noisy_) ? v : std::nan("");
}

}  // namespace gonio
