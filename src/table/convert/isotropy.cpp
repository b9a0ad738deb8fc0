#include "table/convert/isotropy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>
#include <vector>

namespace gonio {
namespace {

constexpr double agreed_deg = 0.1;
constexpr std::size_t most_compared = 20'000;

class Change {
 public:
  void add(double a, double b) {
    if (!std::isfinite(a) || !std::isfinite(b)) return;
    differences_ += std::abs(a - b);
    values_ += (a + b) / 2;
    ++count_;
  }
  std::optional<double> share() const {
    return count_ > 0 && values_ > 0 ? std::optional(differences_ / values_) : std::nullopt;
  }

 private:
  double differences_ = 0, values_ = 0;
  std::size_t count_ = 0;
};

Direction turned(const Direction& d, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * d.x - s * d.y, s * d.x + c * d.y, d.z};
}

/// Mean over the channels of the valid value of a sample; NaN.
double mean_value(const Table& t, const Angles<double>& a, std::size_t i) {
  double sum = 0;
  for (const auto& plane : t.values) {
    if (mask(a, plane[i]) != Mask::valid) return std::nan("");
    sum += plane[i];
  }
  return sum / static_cast<double>(t.values.size());
}

}  // namespace

std::optional<double> change_with_azimuth(const Table& t) {
  const DirectionList* const l = t.list();
  if (!l) return {};
  const SampleAngles at(t);
  Change change;
  if (t.between) {
    const auto mean = [&](const DirectionPair& p) {
      double sum = 0;
      for (std::size_t c = 0; c < t.values.size(); ++c) sum += t.between(p, c);
      return sum / static_cast<double>(t.values.size());
    };
    const std::size_t every = 1 + t.size() / most_compared;
    for (std::size_t i = 0; i < t.size(); i += every) {
      if (!(mean_value(t, at(i), i) >= 0)) continue;
      const auto p = at.directions(i);
      for (const double angle : {45 * degree, 90 * degree})
        change.add(mean(p), mean({turned(p.wi, angle), turned(p.wo, angle)}));
    }
    return change.share();
  }
  struct Entry {
    std::array<long, 3> key;
    double phi, value;
  };
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double value = mean_value(t, at(i), i);
    // Without an azimuth of its own wi tells nothing.
    if (!(value >= 0) || l->theta_i_deg[i] < agreed_deg) continue;
    const auto rounded = [](double deg) { return std::lround(deg / agreed_deg); };
    const double phi = std::abs(std::remainder(l->phi_o_deg[i] - l->phi_i_deg[i], 360));
    entries.push_back({{rounded(l->theta_i_deg[i]), rounded(l->theta_o_deg[i]),
                        l->theta_o_deg[i] < agreed_deg ? 0 : rounded(phi)},
                       l->phi_i_deg[i],
                       value});
  }
  std::ranges::sort(entries, [](const Entry& a, const Entry& b) {
    return std::tie(a.key, a.phi) < std::tie(b.key, b.phi);
  });
  for (std::size_t i = 1; i < entries.size(); ++i)
    if (entries[i].key == entries[i - 1].key &&
        std::abs(std::remainder(entries[i].phi - entries[i - 1].phi, 360)) > 1)
      change.add(entries[i - 1].value, entries[i].value);
  return change.share();
}

}  // namespace gonio
