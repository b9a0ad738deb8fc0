// Intervals hold the truth as often as they say, whatever the noise, and are no wider than that
// asks.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <random>
#include <tuple>

#include "base/quantile.h"
#include "fitting/fit.h"
#include "fitting/goniometer.h"
#include "fitting/support.h"

#include <boost/math/distributions/binomial.hpp>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

namespace gonio {
namespace {

enum class Places { in_plane_5, hemisphere_6, random_60, random_2000, goniometer_24 };
constexpr std::array places_names{"in_plane_5", "hemisphere_6", "random_60", "random_2000",
                                  "goniometer_24"};

enum class Kind {
  own,    ///< what the metric whitens
  other,  ///< what it does not
  gain    ///< 3 % for each incident angle, and 1 % of each value; the table is as if measured
};
constexpr std::array kind_names{"own", "other", "gain"};

struct Material {
  const char *name, *model, *settings;
};
constexpr std::array<Material, 3> materials{
    Material{"ggx", "lambert+ggx/smith_ggx.correlated/schlick", "alpha=0.2,f0=0.05,kd=0.1"},
    Material{"gtr", "lambert+gtr/smith_ggx.correlated/schlick",
             "alpha=0.2,gamma=1.7,f0=0.08,kd=0.1"},
    Material{"dielectric", "lambert+ggx/smith_ggx.correlated/dielectric",
             "alpha=0.3,eta=1.5,kd=0.2"}};

struct Cell {
  const Material& material;
  Places places;
  Kind kind;
  Metric metric;
  std::string name() const {
    return fmt::format("{} {} {} {}", material.name, places_names[static_cast<std::size_t>(places)],
                       kind_names[static_cast<std::size_t>(kind)], name_of(metric));
  }
};

/// Directions of a cell, the truth's values at them.
Table clean(const BoundModel& truth, Places places, std::uint64_t seed) {
  switch (places) {
    case Places::in_plane_5:
      return synthesize(truth, {.layout = Layout::in_plane});
    case Places::hemisphere_6:
      return synthesize(truth, {.layout = Layout::hemisphere});
    case Places::random_60:
      return synthesize(truth, {.layout = Layout::random, .samples = 60, .seed = seed});
    case Places::random_2000:
      return synthesize(truth, {.layout = Layout::random, .samples = 2000, .seed = seed});
    case Places::goniometer_24:
      break;
  }
  Table t = synthesize(truth, {.layout = Layout::random, .samples = 1});
  test::put_on_goniometer(t, truth);
  return t;
}

/// Value with noise of a relative size s, centred where the metric looks for the centre: log at the
/// median, l2_cosine at the mean y, relative where the mean of 1/y is that of f/y².
double spread(double f, double s, double z, Metric metric) {
  switch (metric) {
    case Metric::log:
      return f * std::exp(s * z);
    case Metric::l2_cosine:
      return f * std::exp(s * z - s * s / 2);
    case Metric::relative:
    case Metric::uncertainty:
      break;
  }
  return f * (1 + s * s) / (1 + std::clamp(s * z, -0.9, 0.9));
}

Table noisy(const BoundModel& truth, const Cell& c, std::uint64_t seed) {
  Table t = clean(truth, c.places, seed);
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  const SampleAngles at(t);
  std::map<double, double> gains;
  const bool cosine = c.metric == Metric::l2_cosine;
  for (std::size_t i = 0; i < t.size(); ++i) {
    double& f = t.values[0][i];
    const double nol = std::max(at(i).nol, 0.05);
    switch (c.kind) {
      case Kind::own:
        f = cosine ? f + 0.002 * normal(engine) / nol : spread(f, 0.05, normal(engine), c.metric);
        break;
      case Kind::other:  // dark values, at grazing angles, are the noisier ones
        f = spread(f, cosine ? 0.05 : std::min(0.002 / (nol * f), 0.2), normal(engine), c.metric);
        break;
      case Kind::gain: {
        const auto [gain, is_new] = gains.try_emplace(t.list()->theta_i_deg[i], 0);
        if (is_new) gain->second = std::exp(0.03 * normal(engine));
        f *= gain->second * std::exp(0.01 * normal(engine));
        break;
      }
    }
  }
  if (c.kind == Kind::gain)
    t.truth.reset();
  else
    t.truth = Truth{};
  t.negative_is_noise = false;
  return t;
}

/// Findings on one parameter of one cell over the seeds.
struct Found {
  std::string name;
  std::size_t told = 0, inside = 0, none = 0;
  std::vector<double> estimates, half_widths;

  double coverage() const { return static_cast<double>(inside) / static_cast<double>(told); }
  /// Median half width over that which the spread of the estimates asks.
  double width() const {
    if (half_widths.empty()) return 0;
    auto e = estimates, w = half_widths;
    // Half the range that holds 95 % of them.
    return median(w) / ((quantile(e, 0.975) - quantile(e, 0.025)) / 2);
  }
  /// True where an interval that holds must be wider than what the spread asks: a few incident angles, or the
  /// few values of a narrow peak, make the estimate but cannot tell its error well.
  bool rests_on_few() const {
    return name.find("_5 gain") != name.npos || name.find("_6 gain") != name.npos ||
           name.find("l2_cosine alpha") != name.npos || name.find("l2_cosine gamma") != name.npos;
  }
  double without() const { return static_cast<double>(none) / static_cast<double>(told + none); }
  /// Probability of so few (so many) inside if it is that share of all.
  double so_few(double share) const {
    return cdf(boost::math::binomial(static_cast<double>(told), share),
               static_cast<double>(inside));
  }
  double so_many(double share) const {
    if (inside == 0) return 1;
    return cdf(complement(boost::math::binomial(static_cast<double>(told), share),
                          static_cast<double>(inside) - 1));
  }
};

std::vector<Found> run(const Cell& c, std::size_t seeds) {
  const BoundModel truth = test::bind(c.material.model, c.material.settings, 1);
  FitOptions o;
  o.model = c.material.model;
  o.metric = c.metric;
  std::vector<FitResult> results(seeds);
  tbb::parallel_for(std::size_t{0}, seeds,
                    [&](std::size_t s) { results[s] = fit(noisy(truth, c, s + 1), o); });
  std::vector<Found> all;
  for (const auto& p : truth.model.parameters) {
    Found& f = all.emplace_back();
    f.name = fmt::format("{} {}", c.name(), p.name);
    const double x = truth.values[p.first];
    for (const auto& r : results) {
      const auto& q = test::parameter(r.document, p.name);
      f.estimates.push_back(r.model.values[p.first]);
      if (!std::isnan(q.limit[0])) {
        ++f.told;
        f.inside += q.status[0] == ParameterStatus::upper_limit ? x <= q.limit[0] : x >= q.limit[0];
        continue;
      }
      if (std::isnan(q.ci95_low[0])) {
        ++f.none;
        continue;
      }
      ++f.told;
      f.inside += q.ci95_low[0] <= x && x <= q.ci95_high[0];
      f.half_widths.push_back((q.ci95_high[0] - q.ci95_low[0]) / 2);
    }
  }
  return all;
}

/// Names of those hypotheses that Holm's step-down rejects.
std::vector<std::string> rejected(std::vector<std::pair<double, std::string>> p_values,
                                  double level) {
  std::ranges::sort(p_values);
  std::vector<std::string> names;
  for (std::size_t k = 0; k < p_values.size(); ++k) {
    if (p_values[k].first > level / static_cast<double>(p_values.size() - k)) break;
    names.push_back(p_values[k].second);
  }
  return names;
}

/// \param level  of all of them together
void expect_covered(const std::vector<Cell>& cells, std::size_t seeds, double level) {
  std::vector<std::pair<double, std::string>> low, high;
  for (const auto& c : cells)
    for (const auto& f : run(c, seeds)) {
      const std::string figures = fmt::format("{}: {:.3f} of {}, {:.2f} as wide as asked", f.name,
                                              f.coverage(), f.told, f.width());
      if (seeds > 500) fmt::print("{}\n", figures);
      if (f.rests_on_few()) {  // whose intervals may be wide, not narrow
        EXPECT_LE(f.width(), 4) << figures;
      } else {
        // Of few seeds the spread itself is not known well: to 0.97/√n.
        EXPECT_LE(f.width(), seeds < 1000 ? 1.5 * (1 + 2 / std::sqrt(seeds)) : 1.5) << figures;
        high.emplace_back(f.so_many(0.99), figures);
      }
      low.emplace_back(f.so_few(0.92), figures);
      EXPECT_LE(f.without(), 0.1) << figures;
    }
  for (const auto& name : rejected(low, level)) ADD_FAILURE() << "too narrow: " << name;
  for (const auto& name : rejected(high, level)) ADD_FAILURE() << "too wide: " << name;
}

TEST(CoverageOfFiveCells, IsThatOf95PercentIntervals) {
#ifndef NDEBUG
  GTEST_SKIP() << "takes long without optimisation";
#endif
  const Material &ggx = materials[0], &gtr = materials[1], &dielectric = materials[2];
  expect_covered({{ggx, Places::hemisphere_6, Kind::other, Metric::l2_cosine},
                  {ggx, Places::in_plane_5, Kind::gain, Metric::log},
                  {gtr, Places::random_60, Kind::own, Metric::relative},
                  {ggx, Places::random_60, Kind::other, Metric::l2_cosine},
                  {dielectric, Places::goniometer_24, Kind::gain, Metric::log}},
                 80, 0.01);
}

class CoverageOfCells : public testing::TestWithParam<std::tuple<std::size_t, std::size_t>> {};

TEST_P(CoverageOfCells, IsThatOf95PercentIntervals) {
  if (!std::getenv("GONIO_LONG")) GTEST_SKIP() << "takes minutes; GONIO_LONG is not set";
  const auto [material, places] = GetParam();
  std::vector<Cell> cells;
  for (const auto kind : {Kind::own, Kind::other, Kind::gain}) {
    const bool alone = places_names[places][0] == 'r';  // each direction has its own incident angle
    if (kind == Kind::gain && alone) continue;
    for (const auto metric : {Metric::log, Metric::l2_cosine, Metric::relative})
      cells.push_back({materials[material], static_cast<Places>(places), kind, metric});
  }
  expect_covered(cells, 1000, 0.01 / static_cast<double>(materials.size() * places_names.size()));
}

INSTANTIATE_TEST_SUITE_P(Long,
                         CoverageOfCells,
                         testing::Combine(testing::Range<std::size_t>(0, materials.size()),
                                          testing::Range<std::size_t>(0, places_names.size())),
                         [](const auto& i) {
                           return std::string(materials[std::get<0>(i.param)].name) + "_" +
                                  places_names[std::get<1>(i.param)];
                         });

}  // namespace
}  // namespace gonio
