#include "fitting/plan/plan_next.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/quantile.h"
#include "base/random.h"
#include "brdf/model/evaluate.h"
#include "fitting/fit.h"
#include "fitting/plan/candidates.h"
#include "fitting/support.h"
#include "many_fits.h"
#include "refusal.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

namespace gonio {
namespace {

using test::bind;

const char* const paint = "lambert+ggx/smith_ggx.correlated/schlick";

void push(DirectionList& l, double theta_i, double theta_o, double phi_o) {
  l.theta_i_deg.push_back(theta_i);
  l.phi_i_deg.push_back(0);
  l.theta_o_deg.push_back(theta_o);
  l.phi_o_deg.push_back(phi_o);
}
DirectionList joined(DirectionList l, const DirectionList& more) {
  for (std::size_t i = 0; i < more.theta_i_deg.size(); ++i)
    push(l, more.theta_i_deg[i], more.theta_o_deg[i], more.phi_o_deg[i]);
  return l;
}
DirectionList directions_of(std::span<const NextDirection> rows) {
  DirectionList l;
  for (const auto& r : rows) push(l, r.theta_i_deg, r.theta_o_deg, r.phi_o_deg);
  return l;
}
/// Directions on a grid of three incident, four outgoing and four azimuth angles.
DirectionList coarse() {
  DirectionList l;
  for (const int in : {5, 30, 60})
    for (const int out : {0, 25, 50, 70})
      for (const int phi : {0, 60, 120, 180}) push(l, in, out, phi);
  return l;
}
/// Directions evenly drawn up to 80°.
DirectionList drawn(std::size_t n, std::uint64_t seed) {
  DirectionList l;
  Draws draw(seed, 1);
  const double low = std::cos(most_grazing_deg * degree);
  const auto zenith = [&] { return std::acos(low + (1 - low) * draw.uniform()) / degree; };
  for (std::size_t k = 0; k < n; ++k) {
    const double in = zenith(), out = zenith();
    push(l, in, out, 360 * draw.uniform());
  }
  return l;
}

/// Table of a material with 2 % of independent noise.
Table measured(const BoundModel& truth, const DirectionList& where, std::uint64_t seed) {
  Table t;
  t.path = "t.csv";
  t.format = "csv";
  for (std::size_t c = 0; c < truth.model.channels; ++c) t.channels.push_back(fmt::format("{}", c));
  t.where = where;
  t.values.assign(t.channels.size(), Values(where.theta_i_deg.size()));
  t.truth = Truth{};
  const SampleAngles at(t);
  std::vector<Angles<double>> angles;
  for (std::size_t i = 0; i < t.size(); ++i) angles.push_back(at(i));
  const auto f = evaluate(truth, angles);
  for (std::size_t c = 0; c < f.size(); ++c)
    for (std::size_t i = 0; i < t.size(); ++i)
      t.values[c][i] = f[c][i] * std::exp(0.02 * Draws(seed, c, i).normal());
  return t;
}

/// Paint or metal at random.
BoundModel material(std::uint64_t seed, std::size_t channels) {
  Draws draw(seed, 2);
  BoundModel m = bind(paint, "alpha=0.2", channels);
  for (const auto& p : m.model.parameters)
    for (std::size_t k = p.first; k < p.first + p.count; ++k) {
      const double u = draw.uniform();
      m.values[k] = p.name == "alpha" ? 0.05 * std::pow(10, u)
                    : p.name == "f0"  ? 0.03 * std::pow(20, u)
                                      : 0.03 + 0.7 * u;
    }
  return m;
}

/// Estimate, and width of its interval, of each value of a fit; as wide as 1, the range of all of them, where it tells none.
struct Found {
  double value, width;
};
std::map<std::string, Found> found(const FitResult& r) {
  std::map<std::string, Found> all;
  for (const auto& q : r.model.model.parameters) {
    const auto& p = test::parameter(r.document, q.name);
    for (std::size_t c = 0; c < q.count; ++c) {
      const double width = p.ci95_high[c] - p.ci95_low[c];
      all[q.count == 1 ? q.name : fmt::format("{}.{}", q.name, c)] = {
          r.model.values[q.first + c], std::isnan(width) ? 1 : width};
    }
  }
  return all;
}

/// Widest interval over the true value.
double widest(const FitResult& r, const BoundModel& truth) {
  double most = 0;
  const auto all = found(r);
  for (const auto& q : truth.model.parameters)
    for (std::size_t c = 0; c < q.count; ++c)
      most = std::max(most, all.at(q.count == 1 ? q.name : fmt::format("{}.{}", q.name, c)).width /
                                truth.values[q.first + c]);
  return most;
}

TEST(PlanNext, OfOneParameterNarrowsByTheRootOfTheNumberOfValues) {
  const BoundModel grey = bind("lambert", "kd=0.3", 1);
  FitOptions o;
  o.model = "lambert";
  const auto rows = plan_next(measured(grey, coarse(), 1), o, 20);
  ASSERT_EQ(rows.size(), 20U);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    EXPECT_EQ(rows[k].parameter, "kd");
    EXPECT_NEAR(rows[k].width_after * std::sqrt(49.0 + static_cast<double>(k)),
                rows[0].width_after * std::sqrt(49), 0.08 * std::sqrt(49) * rows[0].width_after);
  }
  // 48 values tell their noise to a tenth.
  EXPECT_NEAR(rows[19].width_after, 2 * 1.96 * 0.02 * 0.3 / std::sqrt(68),
              0.3 * rows[19].width_after);
}

TEST(PlanNext, BeginsWithTheWidestIntervalOfTheFitAndNeverWidensOne) {
  for (std::uint64_t seed = 1; seed <= test::few(6); ++seed) {
    const Table t = measured(material(seed, 3), coarse(), seed);
    const auto rows = plan_next(t, {}, 8);
    const FitResult r = fit(t, {});
    const auto all = found(r);
    EXPECT_NEAR(rows[0].width_before, all.at(rows[0].parameter).width, 1e-9);
    for (const auto& [name, of] : all)
      EXPECT_LE(of.width / of.value,
                rows[0].width_before / all.at(rows[0].parameter).value * (1 + 1e-9))
          << name;
    std::map<std::string, double> last;
    for (const auto& n : rows) {
      EXPECT_LE(n.width_after, n.width_before);
      EXPECT_TRUE(!last.contains(n.parameter) || n.width_before <= last[n.parameter]);
      last[n.parameter] = n.width_after;
      EXPECT_LE(std::max(n.theta_i_deg, n.theta_o_deg), most_grazing_deg);
    }
  }
}

TEST(PlanNext, IsTheSameEachTime) {
  const Table t = measured(material(3, 3), coarse(), 3);
  const auto a = plan_next(t, {}, 6), b = plan_next(t, {}, 6);
  ASSERT_EQ(a.size(), 6U);
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(a[k].theta_i_deg, b[k].theta_i_deg);
    EXPECT_EQ(a[k].phi_o_deg, b[k].phi_o_deg);
    EXPECT_EQ(a[k].width_after, b[k].width_after);
  }
}

TEST(PlanNext, StaysInThePlaneOfTheTable) {
  DirectionList l;
  for (int out = -80; out <= 80; out += 10) push(l, 30, std::abs(out), out > 0 ? 180 : 0);
  for (const auto& n : plan_next(measured(material(1, 3), l, 1), {}, 4))
    EXPECT_TRUE(n.phi_o_deg == 0 || n.phi_o_deg == 180) << n.phi_o_deg;
}

TEST(PlanNext, LooksForAHighlightThatTheTableDoesNotHold) {
  const BoundModel m = bind(paint, "alpha=0.05,f0=0.05,kd=0.3", 1);
  DirectionList l;
  for (const int in : {10, 30, 50})
    for (int out = 0; out <= 80; out += 10) push(l, in, out, 90);
  const Table t = measured(m, l, 1);
  const auto rows = plan_next(t, {}, 6);
  EXPECT_FALSE(rows[0].width_before < 0.3) << rows[0].parameter;
  const auto near_mirror = std::ranges::count_if(rows, [](const NextDirection& n) {
    const auto h = half_difference({direction(n.theta_i_deg * degree, 0),
                                    direction(n.theta_o_deg * degree, n.phi_o_deg * degree)});
    return h.theta_h < 10 * degree;
  });
  EXPECT_GE(near_mirror, 2);
  const auto after = fit(measured(m, joined(l, directions_of(rows)), 1), {});
  EXPECT_NEAR(found(after).at("alpha").value, 0.05, 0.005);
}

TEST(PlanNext, BeginsWithWhatTheFitTellsNothingOf) {
  const auto rows = plan_next(measured(bind("lambert", "kd=0.3", 1), coarse(), 1), {}, 3);
  EXPECT_TRUE(std::isnan(rows[0].width_before)) << rows[0].parameter;
  EXPECT_NE(rows[0].parameter, "kd");
}

TEST(PlanNext, LooksAtFourChannelsOfManyAndNamesThem) {
  const auto rows = plan_next(measured(material(2, 7), coarse(), 2), {}, 6);
  std::size_t named = 0;
  for (const auto& n : rows) {
    const auto dot = n.parameter.find('.');
    if (dot == n.parameter.npos) continue;
    ++named;
    const std::string channel = n.parameter.substr(dot + 1);
    EXPECT_TRUE(channel == "0" || channel == "2" || channel == "4" || channel == "6") << channel;
  }
  EXPECT_GT(named, 0U);
}

TEST(PlanNext, HasNoTwoDirectionsCloseTogether) {
  const Table t = measured(bind("lambert", "kd=0.3", 1), coarse(), 1);
  FitOptions o;
  o.model = "lambert";
  const auto rows = plan_next(t, o, 12);
  const auto pair = [](const NextDirection& n, bool exchanged, double mirror) {
    const double in = exchanged ? n.theta_o_deg : n.theta_i_deg,
                 out = exchanged ? n.theta_i_deg : n.theta_o_deg;
    return DirectionPair{direction(in * degree, 0),
                         direction(out * degree, mirror * n.phi_o_deg * degree)};
  };
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      for (const bool exchanged : {false, true})
        for (const double mirror : {1, -1}) {
          const auto a = pair(rows[i], false, 1), b = pair(rows[k], exchanged, mirror);
          EXPECT_LT(std::min(dot(a.wi, b.wi), dot(a.wo, b.wo)), std::cos(1.99 * degree))
              << i << ", " << k;
        }
}

TEST(PlanNext, RefusesWhatCannotBePlanned) {
  const Table t = measured(material(1, 1), coarse(), 1);
  FitOptions o;
  o.fixed = {{"kd", {0.2}}, {"alpha", {0.2}}, {"f0", {0.05}}};
  EXPECT_HAS(test::refusal([&] { plan_next(t, o, 3); }, Exit::usage), "no parameter");
  o.fixed.clear();
  EXPECT_HAS(test::refusal([&] { plan_next(measured(material(1, 1), drawn(3, 1), 1), o, 3); }),
             "more than the model's 3");
  FitOptions matte;
  matte.model = "lambert";
  EXPECT_HAS(test::refusal([&] { plan_next(t, matte, 3); }), "no further direction mends that");
}

/// Forecasts over what repeats of the table and its further directions show, by how much their estimates are spread.
TEST(PlanNext, ForecastsTheSpreadOf200RepeatsToAFifth) {
  GONIO_MANY_FITS();
  constexpr std::size_t materials = 8, repeats = 200;
  std::vector<double> ratios;
  for (std::uint64_t seed = 1; seed <= materials; ++seed) {
    const BoundModel truth = material(seed, 3);
    const auto rows = plan_next(measured(truth, coarse(), seed), {}, 8);
    // Each row's forecast is that of it and those above it: of each parameter the last is looked
    // at.
    std::map<std::string, std::size_t> last;
    for (std::size_t k = 0; k < rows.size(); ++k) last[rows[k].parameter] = k;
    for (const auto& [name, k] : last) {
      const auto where = joined(coarse(), directions_of(std::span(rows).first(k + 1)));
      std::vector<double> estimates(repeats);
      tbb::parallel_for(std::size_t{0}, repeats, [&](std::size_t r) {
        estimates[r] = found(fit(measured(truth, where, 1000 * seed + r), {})).at(name).value;
      });
      double mean = 0, squares = 0;
      for (const double x : estimates) mean += x / repeats;
      for (const double x : estimates) squares += (x - mean) * (x - mean) / (repeats - 1);
      ratios.push_back(rows[k].width_after / (2 * 1.96 * std::sqrt(squares)));
      EXPECT_NEAR(ratios.back(), 1, 0.2) << name << " of material " << seed;
    }
  }
  EXPECT_NEAR(median(ratios), 1, 0.1);
}

TEST(PlanNext, HalvesWhatDirectionsAtRandomLeave) {
  GONIO_MANY_FITS();
  constexpr std::size_t materials = 50, few = 16, further = 8, sets = 5;
  std::vector<double> ratios(materials);
  tbb::parallel_for(std::size_t{0}, materials, [&](std::size_t m) {
    const BoundModel truth = material(m, 1);
    const auto start = drawn(few, m);
    const auto left = [&](const DirectionList& more) {
      return widest(fit(measured(truth, joined(start, more), m), {}), truth);
    };
    std::vector<double> at_random;
    for (std::size_t k = 0; k < sets; ++k)
      at_random.push_back(left(drawn(further, 1000 * (k + 1) + m)));
    const auto rows = plan_next(measured(truth, start, m), {}, further);
    ratios[m] = left(directions_of(rows)) / median(at_random);
  });
  const double typical = median(ratios);
  EXPECT_LT(typical, 0.5);
  RecordProperty("ratio", fmt::format("{:.3f}", typical));
}

}  // namespace
}  // namespace gonio
