#include "table/health/cosine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "base/quantile.h"
#include "table/format/columns_command.h"

#include <fmt/format.h>

namespace gonio {
namespace {

/// Slopes of ln f over the logarithms of both cosines, away from the highlight, and the spread of ln f before and
/// after they are taken out.  Of a cosine that hardly changes the slope is 0.
struct Trend {
  double incident = 0, outgoing = 0, before = 0, after = 0;

  double distance(const Cosines& c) const {
    return std::max(std::abs(incident - c.incident), std::abs(outgoing - c.outgoing));
  }
};
std::optional<Trend> trend_of(const Table& t) {
  const SampleAngles at(t);
  const double off_specular = std::sin(25 * degree);
  double n = 0;
  std::array<double, 3> sum{};                    // of the logarithms: both cosines, and f
  std::array<std::array<double, 3>, 3> square{};  // of their products
  const std::size_t step = t.size() / 30'000 + 1;
  for (std::size_t i = 0; i < t.size(); i += step) {
    const auto a = at(i);
    if (!(std::min(a.nol, a.nov) > 0.17) || a.sin2_theta_h < off_specular * off_specular) continue;
    const double f = value_of_all(t, a, i);  // the channels' colours are no trend
    if (!(f > 0)) continue;
    const std::array x{std::log(a.nol), std::log(a.nov), std::log(f)};
    ++n;
    for (std::size_t p = 0; p < 3; ++p) {
      sum[p] += x[p];
      for (std::size_t q = 0; q < 3; ++q) square[p][q] += x[p] * x[q];
    }
  }
  constexpr double few = 12, changes = 0.03, tied = 0.7;  // squared correlation
  if (n < few) return {};
  const auto v = [&](std::size_t p, std::size_t q) {
    return square[p][q] / n - sum[p] / n * (sum[q] / n);
  };
  const bool in = v(0, 0) > changes, out = v(1, 1) > changes;
  if ((!in && !out) || (in && out && v(0, 1) * v(0, 1) > tied * v(0, 0) * v(1, 1))) return {};
  Trend trend{0, 0, std::sqrt(std::max(v(2, 2), 0.0)), 0};
  if (in && out) {
    const double det = v(0, 0) * v(1, 1) - v(0, 1) * v(0, 1);
    trend.incident = (v(0, 2) * v(1, 1) - v(1, 2) * v(0, 1)) / det;
    trend.outgoing = (v(1, 2) * v(0, 0) - v(0, 2) * v(0, 1)) / det;
  } else if (in) {
    trend.incident = v(0, 2) / v(0, 0);
  } else {
    trend.outgoing = v(1, 2) / v(1, 1);
  }
  trend.after =
      std::sqrt(std::max(v(2, 2) - trend.incident * v(0, 2) - trend.outgoing * v(1, 2), 0.0));
  return trend;
}

/// True where partners are those of an isotropic surface, since the light always comes from one azimuth.
bool takes_as_isotropic(const Table& t) {
  if (t.grid()) return t.grid()->kind == Grid::Kind::in_out;
  const auto& phi = t.list()->phi_i_deg;
  return std::ranges::all_of(phi, [&](double p) { return p == phi[0]; });
}

/// Samples of a list whose light comes from one azimuth against f at the exchanged zenith angles, where four samples of the same
/// azimuth lie around these: away from the highlight logarithms are interpolated.
void for_each_between(const Table& t, const ReciprocalVisitor& visit) {
  const DirectionList& l = *t.list();
  constexpr std::size_t large = 100'000;
  constexpr double farthest_deg = 12, off_specular = 0.35;  // between samples; sin θ_h
  if (t.size() > large || !takes_as_isotropic(t)) return;
  const SampleAngles at(t);
  using Row = std::map<double, std::size_t>;  // by θ_o
  std::map<long, std::map<double, Row>> rows;
  const auto azimuth_of = [&](std::size_t i) {
    return std::lround(1000 * std::abs(std::remainder(l.phi_o_deg[i] - l.phi_i_deg[i], 360)));
  };
  for (std::size_t i = 0; i < t.size(); ++i)
    rows[azimuth_of(i)][l.theta_i_deg[i]][l.theta_o_deg[i]] = i;
  const auto around = [&](const auto& of, double deg) {
    const auto above = of.lower_bound(deg);
    if (above == of.end() || (above == of.begin() && above->first != deg))
      return std::pair{of.end(), of.end()};
    const auto below = above->first == deg ? above : std::prev(above);
    return above->first - below->first > farthest_deg ? std::pair{of.end(), of.end()}
                                                      : std::pair{below, above};
  };
  const auto between = [](double x, double from, double to, double there, double here) {
    return to > from ? std::lerp(there, here, (x - from) / (to - from)) : there;
  };
  const auto log_of = [&](std::size_t i) { return std::log(value_of_all(t, at(i), i)); };
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double a = value_of_all(t, at(i), i), wanted = l.theta_i_deg[i];
    if (!(a > 0) || at(i).sin2_theta_h < off_specular * off_specular) continue;
    const auto& plane = rows[azimuth_of(i)];
    const auto [low, high] = around(plane, l.theta_o_deg[i]);
    if (low == plane.end()) continue;
    const auto along = [&](const Row& row) {
      const auto [below, above] = around(row, wanted);
      return below == row.end() ? std::nan("")
                                : between(wanted, below->first, above->first, log_of(below->second),
                                          log_of(above->second));
    };
    const double b = std::exp(between(l.theta_o_deg[i], low->first, high->first, along(low->second),
                                      along(high->second)));
    if (std::isfinite(b)) visit(i, 0, a, b);
  }
}

}  // namespace

std::string divided_by(const Table& t, const CosinePowers& c) {
  return reading_command(t, [&](ColumnMap& map) {
    map.cosines = {map.cosines.incident + c.incident, map.cosines.outgoing + c.outgoing};
  });
}

double value_of_all(const Table& t, const Angles<double>& a, std::size_t i) {
  double f = 0;
  for (const auto& plane : t.values)
    if (mask(a, plane[i]) == Mask::valid) f += plane[i];
  return f;
}

const Cosines* warn_of_cosine(TableFacts& facts, std::vector<std::string>& all) {
  const Table& t = facts.table();
  const auto sigma = [&] { return facts.noise().sigma.value_or(0); };
  constexpr std::size_t few = 8;
  std::vector<double> raw;
  std::array<std::vector<double>, 4>
      without;  // of f cos θ_o or f/cos θ_i; of the others; of their squares
  const SampleAngles at(t);
  const auto compare = [&](std::size_t i, std::size_t, double a, double b) {
    const auto x = at(i);
    const double low = std::min(x.nol, x.nov), high = std::max(x.nol, x.nov);
    // Elsewhere the two cannot be told apart.
    if (!(low >= least_cosine && high > 1.2 * low && a + b > 0)) return;
    raw.push_back(reciprocity_error(a, b));
    without[0].push_back(reciprocity_error(a / x.nov, b / x.nol));
    without[1].push_back(reciprocity_error(a / x.nol, b / x.nov));
    without[2].push_back(reciprocity_error(a / (x.nov * x.nov), b / (x.nol * x.nol)));
    without[3].push_back(reciprocity_error(a / (x.nol * x.nol), b / (x.nov * x.nov)));
  };
  if (facts.reciprocity().error) for_each_reciprocal(t, compare);
  const bool between = raw.size() < few && t.list();
  if (between) for_each_between(t, compare);
  const auto trend = trend_of(t);
  std::size_t first = 0;  // of those that the trend decides between
  if (raw.size() >= few) {
    const double with = median(raw);
    for (std::size_t k = 0; k < without.size(); ++k) {
      const double rest = median(without[k]);
      if (!(with > 0.1 && 3 * rest < with && rest < 0.05 + 2 * sigma())) continue;
      constexpr double clearly = 0.5;  // of the power
      const Cosines *one = &cosines[2 * k], *other = one + 1;
      const double nearer =
          trend ? trend->distance(*other) - trend->distance(*one) : 0;  // to the first one
      if (nearer < 0) std::swap(one, other);
      const bool decides =
          std::abs(nearer) > clearly && 2 * trend->after < trend->before;  // which it explains
      all.push_back(fmt::format(
          "exchanging the directions changes values by {:.2g} %, without a cosine by {:.2g} %: "
          "they look like {}{} ({}{})",
          100 * with, 100 * rest, one->in_words,
          decides ? "" : fmt::format(" or {}", other->in_words), divided_by(t, *one),
          decides ? "" : fmt::format(", or --cosines={},{}", other->incident, other->outgoing)));
      return one;
    }
    if (!between && with > std::max(0.1, 5 * sigma())) {
      if (!takes_as_isotropic(t))
        all.push_back(fmt::format(
            "exchanging the directions changes values by {:.3g} %: they are no f, or the "
            "directions are not what they seem",
            100 * with));
      return nullptr;
    }
    if (!between) first = 2 * without.size();
  }
  if (!trend || !(3 * trend->after < trend->before && trend->after < 0.1 + 2 * sigma()))
    return nullptr;
  for (const auto& c : std::span(cosines).subspan(first))
    if (std::abs(c.incident) < 2 && std::abs(c.outgoing) < 2 && trend->distance(c) < 0.15) {
      all.push_back(fmt::format(
          "away from the highlight values change like a cosine: probably they are {} ({})",
          c.in_words, divided_by(t, c)));
      return &c;
    }
  return nullptr;
}

void warn_of_reciprocity(TableFacts& facts, std::vector<std::string>& all) {
  constexpr double much = 0.05, no_instruments = 0.1, beside_noise = 5;
  const double error = facts.reciprocity().error.value_or(0);
  if (!(error > std::max(much, beside_noise * facts.noise().sigma.value_or(0)))) return;
  if (error > no_instruments && takes_as_isotropic(facts.table()))
    all.push_back(fmt::format(
        "exchanging the directions changes values by {:.3g} %: no f, other directions, or "
        "an anisotropic surface",
        100 * error));
  else
    all.push_back(fmt::format(
        "exchanging the directions changes values by {:.2g} %, far more than noise: {}, which no "
        "model follows",
        100 * error,
        facts.computed() ? "what computed the table is not reciprocal"
                         : "errors of the instrument"));
}

}  // namespace gonio
