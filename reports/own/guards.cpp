#include "reports/own/guards.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "geometry/direction.h"
#include "reports/own/nearest.h"
#include "reports/own/parameters.h"

#include <fmt/format.h>

namespace gonio {

using auditing::Row;
using auditing::Values;

namespace {

constexpr double bitten = 0.9;  ///< a tenth is lost
constexpr int halvings = 40;

/// What a guard's amount is over.
double over(HorizonGuard::Kind kind, const Row& r, double v) {
  return kind == HorizonGuard::Kind::sum || kind == HorizonGuard::Kind::floor
             ? 1 / (4 * r.nol * r.nov)
             : v;
}
std::string text_of(const HorizonGuard& g) {
  switch (g.kind) {
    case HorizonGuard::Kind::sum:
      return fmt::format("{:.3g} is added to 4 NoL NoV", g.amount);
    case HorizonGuard::Kind::floor:
      return fmt::format("4 NoL NoV is held above {:.3g}", g.amount);
    case HorizonGuard::Kind::sum_of_v:
      return fmt::format("{:.3g} is added to 1/V", g.amount);
    case HorizonGuard::Kind::cap:
      break;
  }
  return fmt::format("V is held below {:.3g}", 1 / g.amount);
}

}  // namespace

std::optional<Bite> bite_of(const Parameter& width,
                            double power,
                            const std::function<double(double)>& left) {
  constexpr double materials = 0.04;
  const bool is_narrow_high = narrows(power);
  const double low = low_of(width), high = high_of(width), least = 1e-3 * (high - low);
  // At no width at all there is no peak.
  double narrow = is_narrow_high ? (power == of_exponent ? high : std::min(high, 1 - least))
                                 : std::max(low, least);
  double wide = is_narrow_high ? low : high;
  Bite b;
  b.narrowest = narrow;
  b.left = left(narrow);
  if (!(b.left < bitten) || !(left(wide) > bitten)) return {};
  for (int k = 0; k < halvings; ++k) {
    const double middle = (narrow + wide) / 2;
    (left(middle) < bitten ? narrow : wide) = middle;
  }
  b.from = narrow;
  b.is_little = alpha_of(b.from, power) < materials;
  return b;
}

std::string text_of(const Bite& b, const Parameter& width, double power) {
  return fmt::format(
      "a guard or a clamp cuts the peak {} {} {:.3g}: {:.2g} of it is left at {:.3g}{}",
      narrows(power) ? "above" : "below", width.name, b.from, b.left, b.narrowest,
      b.is_little ? "; right where no material is so smooth" : "");
}

double HorizonGuard::left(const Row& r, double v) const {
  const double x = amount * over(kind, r, v);
  return kind == Kind::sum || kind == Kind::sum_of_v ? 1 / (1 + x) : 1 / std::max(1.0, x);
}

std::optional<HorizonGuard> guard_of(std::span<const Row> rows,
                                     const std::vector<Values>& own,
                                     const std::vector<Values>& form) {
  using Kind = HorizonGuard::Kind;
  for (const auto kind : {Kind::sum, Kind::floor, Kind::sum_of_v, Kind::cap}) {
    // Where most is lost the amount is known best.
    double most = same_within, amount = 0;
    for (std::size_t k = 0; k < own.size(); ++k)
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const double lost = form[k][i] / own[k][i] - 1;
        if (!(lost > most) || !std::isfinite(lost)) continue;
        const double x = over(kind, rows[i], form[k][i]);
        most = lost;
        amount = (kind == Kind::sum || kind == Kind::sum_of_v ? lost : lost + 1) / x;
      }
    if (!(amount > 0)) return {};
    // Where it takes little its amount is not known well: the roundest that does is the one that
    // was written.
    for (const int digits : {0, 1, 17}) {
      const HorizonGuard g{kind, std::stod(fmt::format("{:.{}e}", amount, digits))};
      bool is = true;
      for (std::size_t k = 0; is && k < own.size(); ++k)
        for (std::size_t i = 0; is && i < rows.size(); ++i)
          is = std::abs(own[k][i] / (form[k][i] * g.left(rows[i], form[k][i])) - 1) < same_within;
      if (is) return g;
    }
  }
  return {};
}

std::optional<Drop> drop_of(const std::function<double(const Row&)>& left,
                            const std::optional<HorizonGuard>& guard) {
  const auto is_lost = [&](double theta) {
    return !(left(auditing::row(theta, 0, theta, std::numbers::pi)) > bitten);
  };
  constexpr double steepest = 89.5 * degree;  // beyond it nothing is seen
  double here = 0, there = steepest;
  if (is_lost(here) || !is_lost(there)) return {};
  for (int k = 0; k < halvings; ++k) {
    const double middle = (here + there) / 2;
    (is_lost(middle) ? there : here) = middle;
  }
  return Drop{there / degree, guard ? text_of(*guard) : "a guard below"};
}

bool Drop::is_little() const {
  constexpr double steep_deg = 85;
  return is_of_sheen || from_deg > steep_deg;
}

std::string text_of(const Drop& d) {
  return fmt::format(
      "{}: it is held down towards the horizon, by a tenth and more from {:.3g}° on, where light "
      "and view are mirrored{}",
      d.what, d.from_deg,
      d.is_of_sheen   ? "; Khronos's sheen does so"
      : d.is_little() ? "; right where nothing is seen so steeply"
                      : "");
}

}  // namespace gonio
