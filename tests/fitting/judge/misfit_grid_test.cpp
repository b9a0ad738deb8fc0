// Tables of few incident angles, as goniometers write them: a model that does not fit is never
// taken for one that does, and the right model is not accused.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <random>

#include "fitting/fit.h"
#include "fitting/support.h"
#include "many_fits.h"
#include "tables.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace gonio {
namespace {

constexpr const char* one_lobe = "lambert+ggx/smith_ggx.correlated/schlick";
constexpr const char* two_lobes =
    "lambert+ggx/smith_ggx.correlated/schlick+ggx/smith_ggx.correlated/schlick";
constexpr const char* one_gtr = "lambert+gtr/smith_ggx.correlated/schlick";
constexpr const char* one_beckmann = "lambert+beckmann/smith_beckmann.correlated/schlick";

struct TruthAndFit {
  const char *truth, *settings, *fitted;
};
const std::vector<TruthAndFit> wrong_pairs{
    {two_lobes, "alpha=0.1,alpha_2=0.4,f0=0.03,f0_2=0.05,kd=0.03", one_lobe},
    {one_gtr, "alpha=0.3,gamma=1.2,f0=0.05,kd=0.05", one_lobe},
    {one_lobe, "alpha=0.2,f0=0.05,kd=0.05", one_beckmann},
    {one_beckmann, "alpha=0.3,f0=0.05,kd=0.2", one_lobe},
    {"lambert+ggx/smith_ggx.correlated/dielectric", "alpha=0.5,eta=1.5,kd=0.1", one_lobe},
    {one_lobe, "alpha=0.3,f0=0.05,kd=0.3", "lambert"},
    {"eon", "kd=0.6,r=0.8", "lambert"},
    {one_lobe, "alpha=0.25,f0=0.08,kd=0.1", "ggx/smith_ggx.correlated/schlick"}};
const std::vector<TruthAndFit> right_pairs{
    {one_lobe, "alpha=0.2,f0=0.05,kd=0.2", one_lobe},
    {one_lobe, "alpha=0.08,f0=0.04,kd=0.02", one_lobe},
    {one_lobe, "alpha=0.25,f0=0.08,kd=0.3", one_gtr},
    {two_lobes, "alpha=0.1,alpha_2=0.4,f0=0.03,f0_2=0.05,kd=0.03", two_lobes},
    {"ggx/smith_ggx.correlated/conductor", "alpha=0.3,eta=0.2,k=3",
     "ggx/smith_ggx.correlated/conductor"},
    {one_beckmann, "alpha=0.3,f0=0.05,kd=0.2", one_beckmann},
    {"eon", "kd=0.6,r=0.8", "eon"},
    {"lambert", "kd=0.3", "lambert"}};

enum class Around { in_plane, half_turn, coarse };
/// Angles whose values share a gain.
enum class GainOf { incident, outgoing, detector, light_and_detector };
constexpr std::array<const char*, 4> gain_names{"incident", "outgoing", "detector",
                                                "light and detector"};
struct Errors {
  double noise, gain;
  GainOf of = GainOf::incident;
  double floor = 0;  ///< noise of one size, of what a tenth of the values are below
  double noise_of_third =
      -1;  ///< of the third of three channels; less than 0: there is one channel
};

/// Exact values, and a table of them with errors.
struct MeasuredTable {
  Table exact, table;
};
MeasuredTable measured_table(
    const TruthAndFit& pair, Around around, int angles, const Errors& errors, unsigned seed) {
  MeasuredTable m;
  Table& t = m.exact;
  t.format = "csv";
  t.channels = {"f"};
  DirectionList l;
  const auto add = [&](double in, double out, double phi) {
    l.theta_i_deg.push_back(in);
    l.phi_i_deg.push_back(0);
    l.theta_o_deg.push_back(out);
    l.phi_o_deg.push_back(phi);
  };
  for (int k = 0; k < angles; ++k) {
    const double in = 10 + 60.0 * k / (angles - 1);
    if (around == Around::in_plane)
      for (int out = -84; out <= 84; out += 6) add(in, std::abs(out), out < 0 ? 0 : 180);
    const int step = around == Around::coarse ? 20 : 10, turn = around == Around::coarse ? 45 : 15;
    if (around != Around::in_plane)
      for (int out = 0; out < 85; out += step)
        for (int phi = 0; phi <= (out > 0 ? 180 : 0); phi += turn) add(in, out, phi);
  }
  t.where = std::move(l);
  test::put_values(t, test::bind(pair.truth, pair.settings, 1));
  const std::size_t n = t.size();
  auto sorted = t.values[0];
  std::ranges::sort(sorted);
  const double floor = errors.floor * sorted[n / 10];
  if (errors.noise_of_third >= 0) {
    t.channels = {"r", "g", "b"};
    t.values.resize(3, t.values[0]);
  }
  m.table = t;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::map<std::array<double, 3>, double> gain;
  const auto gain_of = [&](std::array<double, 3> key) {
    const auto [here, is_new] = gain.emplace(key, 0);
    if (is_new) here->second = std::exp(errors.gain * normal(random));
    return here->second;
  };
  for (std::size_t i = 0; i < n; ++i) {
    const auto& list = *t.list();
    const double in = list.theta_i_deg[i], out = list.theta_o_deg[i], phi = list.phi_o_deg[i];
    double common = 1;
    if (errors.of == GainOf::incident || errors.of == GainOf::light_and_detector)
      common *= gain_of({in, -1, -1});
    if (errors.of == GainOf::outgoing) common *= gain_of({-1, out, -1});
    if (errors.of == GainOf::detector || errors.of == GainOf::light_and_detector)
      common *= gain_of({-1, out, out > 0 ? phi : 0});
    for (std::size_t c = 0; c < t.values.size(); ++c)
      m.table.values[c][i] *=
          common * std::exp((c == 2 ? errors.noise_of_third : errors.noise) * normal(random));
    if (floor > 0)
      for (auto& plane : m.table.values) plane[i] += floor * normal(random);
  }
  return m;
}

struct GridTally {
  unsigned fits = 0, told = 0, too_few = 0, wrong = 0, silent_and_wrong = 0;
  void add(const GridTally& o) {
    fits += o.fits, told += o.told, too_few += o.too_few;
    wrong += o.wrong, silent_and_wrong += o.silent_and_wrong;
  }
};

void judge(const TruthAndFit& pair,
           Around around,
           int angles,
           const Errors& errors,
           unsigned seed,
           GridTally& sum) {
  const auto [exact, table] = measured_table(pair, around, angles, errors, seed);
  FitOptions o;
  o.model = pair.fitted;
  const auto result = fit(table, o);
  Table fitted = exact;
  test::put_values(fitted, result.model);
  const auto& f = fitted.values[0];
  double squares = 0;
  for (std::size_t i = 0; i < exact.size(); ++i)
    squares += std::pow(std::log(std::max(f[i], 1e-30) / exact.values[0][i]), 2);
  const double off = std::sqrt(squares / static_cast<double>(exact.size()));
  const auto& m = result.document.misfit;
  const bool wrong = off > std::max(std::hypot(errors.noise, errors.gain), 0.01);
  ++sum.fits;
  sum.told += m.told;
  sum.too_few += m.too_few;
  sum.wrong += wrong;
  sum.silent_and_wrong += wrong && !m.told && !m.too_few;
}

struct Grid3 {
  std::vector<TruthAndFit> pairs;
  std::vector<int> angles;
  std::vector<Errors> errors;
  unsigned seeds;
};
/// Tallies by layout and number of angles.
std::map<std::pair<Around, int>, GridTally> tallies_of(const Grid3& g, const char* what) {
  std::map<std::pair<Around, int>, GridTally> all;
  std::string table;
  for (const Around around : {Around::in_plane, Around::half_turn, Around::coarse})
    for (const auto& pair : g.pairs)
      for (const int angles : g.angles)
        for (const auto& e : g.errors) {
          GridTally t;
          for (unsigned seed = 1; seed <= g.seeds; ++seed) judge(pair, around, angles, e, seed, t);
          all[{around, angles}].add(t);
          table += fmt::format(
              "{} layout {} angles {:>2} noise {:<5} gain {:<4} by {:<8} told {:>2} too few {:>2} "
              "of {:>2}, wrong {:>2} silent {:>2}  {} as {}\n",
              what, static_cast<int>(around), angles, e.noise, e.gain,
              gain_names[static_cast<std::size_t>(e.of)], t.told, t.too_few, t.fits, t.wrong,
              t.silent_and_wrong, pair.truth, pair.fitted);
        }
  if (std::getenv("GONIO_LONG")) fmt::print("{}", table);
  return all;
}

bool is_long() {
  return std::getenv("GONIO_LONG") != nullptr;
}
Grid3 grid_of(const std::vector<TruthAndFit>& pairs) {
  const char* const seeds = std::getenv("GONIO_SEEDS");
  if (is_long())
    return {pairs,
            {4, 7, 8, 10, 14},
            {{0, 0},
             {0.005, 0},
             {0.02, 0},
             {0.05, 0},
             {0.02, 0.03},
             {0.02, 0.03, GainOf::outgoing},
             {0.02, 0.03, GainOf::detector},
             {0.005, 0.03, GainOf::light_and_detector}},
            seeds ? static_cast<unsigned>(std::atoi(seeds)) : 40};
  return {{pairs[0], pairs[1], pairs[2]},
          {7, 8, 10},
          {{0.02, 0}, {0.02, 0.03}, {0.02, 0.03, GainOf::outgoing}, {0.02, 0.03, GainOf::detector}},
          1};
}

TEST(MisfitOfFewAngles, OfAWrongModelIsSaidOrThatTheValuesAreTooFew) {
  GONIO_MANY_FITS();
  std::map<Around, GridTally> by_layout;
  for (const auto& [key, t] : tallies_of(grid_of(wrong_pairs), "wrong"))
    by_layout[key.first].add(t);
  for (const auto& [layout, t] : by_layout) {
    EXPECT_GT(t.wrong, 0U);
    EXPECT_LE(20 * t.silent_and_wrong, t.wrong) << static_cast<int>(layout);
  }
}

TEST(MisfitOfFewAngles, OfTheRightModelIsNotSaid) {
  GONIO_MANY_FITS();
  std::map<Around, GridTally> by_layout, from_eight;
  for (const auto& [key, t] : tallies_of(grid_of(right_pairs), "right")) {
    by_layout[key.first].add(t);
    if (key.second >= 8) from_eight[key.first].add(t);
  }
  for (const auto& [layout, t] : by_layout)
    EXPECT_LE(50 * t.told, t.fits)
        << static_cast<int>(layout) << ": " << t.told << " of " << t.fits;
  for (const auto& [layout, t] : from_eight)
    EXPECT_LE(10 * t.too_few, t.fits) << static_cast<int>(layout);
}

TEST(MisfitOfFewAngles, IsJudgedByNoiseThatIsLargerBesideDarkValuesOrInOneChannel) {
  GONIO_MANY_FITS();
  const std::vector<Errors> errors{{0.01, 0, GainOf::incident, 0.1},
                                   {0.02, 0, GainOf::incident, 0.2},
                                   {0.01, 0, GainOf::incident, 0, 0.04}};
  const auto tally_of = [&](const std::vector<TruthAndFit>& pairs) {
    GridTally all;
    for (const auto& pair : pairs)
      for (const Around around : {Around::in_plane, Around::coarse})
        for (const auto& e : errors)
          for (unsigned seed = 1; seed <= (is_long() ? 40U : 4U); ++seed)
            judge(pair, around, 12, e, seed, all);
    return all;
  };
  const auto right = tally_of({{one_gtr, "alpha=0.25,gamma=1.5,f0=0.05,kd=0.03", one_gtr},
                               {"ggx/smith_ggx.correlated/schlick", "alpha=0.3,f0=0.6",
                                "ggx/smith_ggx.correlated/schlick"}});
  EXPECT_LE(50 * right.told, right.fits) << right.told << " of " << right.fits;
  const auto wrong = tally_of({{one_gtr, "alpha=0.25,gamma=1.3,f0=0.05,kd=0.03", one_lobe},
                               {one_lobe, "alpha=0.25,f0=0.05,kd=0.05", one_beckmann}});
  EXPECT_GE(20 * wrong.told, 19 * wrong.fits) << wrong.told << " of " << wrong.fits;
}

TEST(MisfitOfFewAngles, OfTheScaleOfTheWholeTableIsOnTheScaleOfTheFitsQuality) {
  for (const int angles : {4, 6, 10}) {
    auto [exact, table] = measured_table({one_lobe, "alpha=0.3,f0=0.05,kd=0.2", ""},
                                         Around::half_turn, angles, {0, 0}, 1);
    const auto size = [&](auto&& changed, const char* model) {
      Table t = table;
      const SampleAngles at(t);
      for (std::size_t i = 0; i < t.size(); ++i) t.values[0][i] *= changed(at(i));
      FitOptions o;
      o.model = model;
      const auto d = fit(t, o).document;
      EXPECT_TRUE(d.misfit.told) << angles;
      EXPECT_NEAR(d.misfit.size, d.residuals.log_rms, 0.2 * d.residuals.log_rms) << angles;
    };
    size([](const auto&) { return 100 * M_PI; }, one_lobe);
    size([](const auto& a) { return a.nol; }, one_lobe);
    size([](const auto&) { return 20.0; }, "lambert");
  }
}

TEST(MisfitOfFewAngles, WithErrorsByAngleAskedForIsJudgedToo) {
  const auto [exact, table] = measured_table(wrong_pairs[0], Around::half_turn, 6, {0.02, 0}, 1);
  FitOptions o;
  o.model = wrong_pairs[0].fitted;
  o.intervals = Intervals::by_angle;
  EXPECT_TRUE(fit(table, o).document.misfit.told);
}

TEST(GainsOfAngles, AreNoMisfitOfTheRightModelAndWidenItsIntervals) {
  GONIO_MANY_FITS();
  const std::map<std::string, double> truth{{"alpha", 0.2}, {"f0", 0.05}, {"kd", 0.2}};
  for (const GainOf of : {GainOf::outgoing, GainOf::detector, GainOf::light_and_detector})
    for (const Around around : {Around::in_plane, Around::half_turn}) {
      unsigned inside = 0, stated = 0, told = 0, fits = 0;
      for (unsigned seed = 1; seed <= (is_long() ? 40U : 8U); ++seed) {
        const auto m = measured_table(right_pairs[0], around, 14, {0.02, 0.03, of}, seed);
        FitOptions o;
        o.model = one_lobe;
        const auto d = fit(m.table, o).document;
        told += d.misfit.told;
        ++fits;
        for (const auto& [name, value] : truth) {
          const auto& p = test::parameter(d, name);
          ++stated;
          inside += p.ci95_low[0] <= value && value <= p.ci95_high[0];
        }
        EXPECT_NE(d.intervals.find(", and errors shared by each "), std::string::npos)
            << d.intervals;
      }
      const auto where = std::string(gain_names[static_cast<std::size_t>(of)]) +
                         (around == Around::in_plane ? ", in plane" : ", half a turn");
      EXPECT_LE(10 * told, fits) << where;
      EXPECT_GE(10 * inside, (is_long() ? 8 : 7) * stated)
          << where << ": " << inside << " of " << stated;
    }
}

}  // namespace
}  // namespace gonio
