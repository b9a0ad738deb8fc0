// No start whatever leads below the optimum that a fit reports.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <span>

#include "brdf/model/roughness.h"
#include "fitting/choice/choice.h"
#include "fitting/fit.h"
#include "fitting/materials.h"
#include "fitting/solve/descend.h"
#include "fitting/solve/search.h"
#include "fitting/support.h"
#include "many_fits.h"
#include "support.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

namespace gonio {
namespace {

constexpr const char* models[] = {
    "ggx/smith_ggx.correlated/schlick",
    "lambert+ggx/smith_ggx.correlated/schlick",
    "lambert.coupled+ggx/smith_ggx.correlated/schlick",
    "lambert+beckmann/smith_beckmann.correlated/schlick",
    "lambert+gtr/smith_ggx.correlated/schlick",
    "gtr/smith_gtr.correlated/schlick",
    "lambert+ggx/smith_ggx.correlated/dielectric",
    "lambert.coupled+ggx/smith_ggx.correlated/dielectric",
    "gtr/smith_ggx.correlated/dielectric",
    "ggx/smith_ggx.correlated/conductor",
    "lambert+ggx/smith_ggx.correlated/conductor",
    "gtr/smith_ggx.correlated/conductor",
    "lambert+ggx/smith_ggx.correlated/schlick.f90",
    "disney+ggx/smith_ggx.correlated/schlick",
    "ggx/smith_ggx.correlated/schlick+beckmann/smith_beckmann.correlated/schlick",
    "lambert+ggx/smith_ggx.correlated/schlick+ggx/smith_ggx.correlated/schlick"};

/// Values of the free slots, each drawn from where a fit may look: widths and indices evenly by ratio.
std::vector<double> drawn(const Problem& p, std::mt19937_64& random) {
  std::vector<double> x;
  for (const auto& q : p.start.model.parameters)
    for (std::size_t c = 0; c < q.count; ++c) {
      if (!p.free.mask()[q.first + c]) continue;
      const std::size_t i = p.free.index(q.first + c);
      const double low = p.bounds.low[i], high = p.bounds.high[i];
      const double u = std::uniform_real_distribution<>()(random);
      const double from = std::max(low, 1e-3 * high);
      x.push_back(high <= 1 && !is_alpha(q.name) ? low + u * u * (high - low)
                                                 : from * std::pow(high / from, u));
    }
  return x;
}

/// Lowest cost that descents from random places end at.
Fitted lowest_of(const Problem& p,
                 const FitData<double>& data,
                 std::size_t starts,
                 std::uint64_t seed) {
  const Accumulator<double> accumulate(p.start.model, data, p.free);
  std::vector<std::vector<double>> x(starts);
  std::vector<double> cost(starts);
  tbb::parallel_for(std::size_t{0}, starts, [&](std::size_t k) {
    std::mt19937_64 random(1000 * seed + k);
    x[k] = drawn(p, random);
    cost[k] = descend(
                  [&](const std::vector<double>& at) {
                    auto values = p.start.values;
                    p.free.put(at, values);
                    return accumulate.normal_equations(values);
                  },
                  x[k], p.bounds, {100, 1e-9})
                  .cost;
  });
  const auto best = static_cast<std::size_t>(std::ranges::min_element(cost) - cost.begin());
  BoundModel from = p.start;
  p.free.put(x[best], from.values);
  return minimise(p, data, from, no_huber);
}

std::string text_of(const BoundModel& b) {
  std::string text;
  for (const auto& [name, values] : named_values(b)) {
    text += " " + name;
    for (const double v : values) text += (&v == values.data() ? "=" : ",") + std::to_string(v);
  }
  return text;
}

void expect_nothing_lower(const Table& t, FitOptions o, std::uint64_t seed) {
  o.bin_sensitivity = false;
  o.certificate = Certify::automatic;
  const auto r = fit(t, o);
  const FitOptions whole = expanded(o);
  const Problem p = pose(t, whole);
  const Sampling s(t, t.bins(), o.metric, p.offset, is_reciprocal(p.start));
  const auto lowest = lowest_of(p, fit_data<double>(s), 64, seed);
  EXPECT_GE(lowest.solution.at.cost, r.document.cost * (1 - 1e-6))
      << o.model << " " << name_of(o.metric) << "\n  found" << text_of(r.model) << "\n  lower"
      << text_of(lowest.model);
}

/// A table of some model, with some noise, and the options to fit it with.
void look_at(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto any = [&](std::size_t n) { return random() % n; };
  const auto model = models[any(std::size(models))];
  const std::size_t channels = any(3) ? 1 : 3;
  BoundModel truth = bind_model(model, {}, channels);
  FitOptions o;
  o.model = model;
  o.metric = static_cast<Metric>(any(3));
  {
    const Table none = synthesize(truth, {.layout = Layout::random, .samples = 8});
    const FitOptions whole = expanded(o);
    const Problem p = pose(none, whole);
    p.free.put(drawn(p, random), truth.values);
  }
  if (any(4) == 0) o.model = models[any(std::size(models))];  // that is not the truth
  constexpr std::array layouts{Layout::in_plane, Layout::hemisphere, Layout::random,
                               Layout::random};
  SynthOptions s{.layout = layouts[any(4)], .samples = 60, .noise = 0.02, .seed = seed};
  if (any(2)) s.samples = 600;
  if (any(3) == 0) s.noise = 0.1;
  SCOPED_TRACE(testing::Message() << "table " << seed << ": " << model << text_of(truth) << " "
                                  << name_of(s.layout));
  expect_nothing_lower(synthesize(truth, s), o, seed);
}

class Optimum : public testing::TestWithParam<int> {};

TEST_P(Optimum, IsAsLowAsAnyOf64RandomStartsFinds) {
  GONIO_MANY_FITS();
  const bool is_long = std::getenv("GONIO_LONG") != nullptr;
  const int count = is_long ? 100 : 2;
  for (int k = 0; k < count; ++k) look_at(static_cast<std::uint64_t>(100 * GetParam() + k));
}
INSTANTIATE_TEST_SUITE_P(Tables, Optimum, testing::Range(0, 10));

TEST(LostOptimum, OfTwinValleysAndOfAnExponentWithoutEffectIsFound) {
  GONIO_MANY_FITS();
  look_at(15);   // an extinction of 20 for one of 0
  look_at(444);  // alpha = 1, where an exponent has no effect but on the way down
  look_at(834);  // eta on the other side of 1
}

/// Tables of one model, and what is asked of their fits: none ends above where the truth is.
struct Family {
  const char* name;
  const char* model;
  std::vector<std::string> settings;
};
const Family families[] = {
    {"wide_dielectric",
     "lambert.coupled+ggx/smith_ggx.correlated/dielectric",
     {"kd=0,alpha=0.9,eta=1.2", "kd=0,alpha=0.5,eta=1.1", "kd=0.05,alpha=0.7,eta=1.4",
      "kd=0.1,alpha=0.3,eta=2.5"}},
    {"short_tail",
     "lambert+gtr/smith_ggx.correlated/schlick",
     {"alpha=0.2,gamma=9.5,f0=0.2,kd=0.05", "alpha=0.4,gamma=7,f0=0.05,kd=0.2",
      "alpha=0.1,gamma=9,f0=0.6,kd=0.01", "alpha=0.3,gamma=0.8,f0=0.3,kd=0.1"}},
    {"metal",
     "ggx/smith_ggx.correlated/conductor",
     {"alpha=0.2,eta=0.2,k=3", "alpha=0.05,eta=1.5,k=0.4", "alpha=0.4,eta=2.5,k=3"}},
    {"two_lobes",
     "lambert+ggx/smith_ggx.correlated/schlick+ggx/smith_ggx.correlated/schlick",
     {"alpha=0.05,f0=0.04,alpha_2=0.4,f0_2=0.2,kd=0.1", "alpha=0.5,f0=0.3,alpha_2=0.1,f0_2=0.02"}}};

class Truth : public testing::TestWithParam<Family> {};

TEST_P(Truth, LiesBelowNoFit) {
  GONIO_MANY_FITS();
  for (const auto& settings : GetParam().settings)
    for (const Metric metric : {Metric::log, Metric::l2_cosine, Metric::relative})
      for (const Layout layout : {Layout::in_plane, Layout::hemisphere, Layout::random})
        for (const std::uint64_t seed : {1U, 2U}) {
          const auto truth =
              bind_model(GetParam().model, parse_settings(std::vector<std::string>{settings}),
                         seed == 1 ? 3 : 1);
          const Table t =
              synthesize(truth, {.layout = layout, .samples = 300, .noise = 0.02, .seed = seed});
          FitOptions o;
          o.model = GetParam().model;
          o.metric = metric;
          const Problem p = pose(t, o);
          const Sampling s(t, t.bins(), metric, p.offset, true);
          const double there = Accumulator<double>(p.start.model, fit_data<double>(s), p.free)
                                   .normal_equations(truth.values)
                                   .cost;
          EXPECT_LT(fit(t, o).document.cost, there)
              << settings << " " << name_of(metric) << " " << name_of(layout) << " " << seed;
        }
}
INSTANTIATE_TEST_SUITE_P(Families, Truth, testing::ValuesIn(families), [](const auto& i) {
  return i.param.name;
});

/// Fits tables of a model, each by its own seed: none ends above where the truth is.
void expect_no_more_than_truth(const char* model,
                               const std::string& settings,
                               SynthOptions how,
                               Metric metric,
                               const std::vector<std::uint64_t>& seeds,
                               Certify certificate = Certify::automatic) {
  const auto truth = test::bind(model, settings, 3);
  FitOptions o;
  o.model = model;
  o.metric = metric;
  o.bin_sensitivity = false;
  o.certificate = certificate;
  for (const std::uint64_t seed : seeds) {
    how.seed = seed;
    const Table t = synthesize(truth, how);
    const Problem p = pose(t, o);
    const Sampling s(t, t.bins(), metric, p.offset, is_reciprocal(p.start));
    const double there = minimise(p, fit_data<double>(s), truth, no_huber).solution.at.cost;
    const auto r = fit(t, o);
    EXPECT_LE(r.document.cost, there * (1 + 1e-6))
        << settings << " " << name_of(metric) << " " << seed << "\n  found" << text_of(r.model);
  }
}

TEST(LostOptimum, OfAMetalWithAnIndexBelow1IsNotLostByOneChannel) {
  const SynthOptions few{.layout = Layout::random, .samples = 150, .noise = 0.1};
  expect_no_more_than_truth("blinn_phong/cook_torrance/conductor", "alpha=0.24,eta=0.89,k=0.96",
                            few, Metric::relative, {2, 3, 9});
  expect_no_more_than_truth("ggx/smith_ggx.correlated/conductor", "alpha=0.3,eta=0.7,k=1.2", few,
                            Metric::relative, {1, 2});
}

TEST(LostOptimum, OfValuesOfManyDecadesIsNotLostWithoutADiffusePart) {
  GONIO_MANY_FITS();
  const SynthOptions few{.layout = Layout::random, .samples = 150, .noise = 0.02};
  expect_no_more_than_truth("lambert+blinn_phong/smith_ggx.separable/conductor",
                            "alpha=0.15,eta=0.44,k=2.19,kd=0", few, Metric::relative, {2, 8},
                            Certify::none);
  expect_no_more_than_truth(
      "lambert+beckmann/smith_beckmann.correlated/schlick+beckmann/smith_beckmann.correlated/"
      "schlick",
      "alpha=0.1,f0=0.04,kd=0,alpha_2=0.5,f0_2=0.1", few, Metric::log, {1, 5, 9}, Certify::none);
  expect_no_more_than_truth(
      "lambert+beckmann/cook_torrance/schlick+blinn_phong/smith_ggx.correlated/dielectric",
      "alpha=0.7307,f0=0.04,kd=0,alpha_2=0.2361,eta_2=1.5628",
      {.layout = Layout::random, .samples = 150, .noise = 0.005}, Metric::log, {482142, 1},
      Certify::none);
}

TEST(LostOptimum, OfATableThatFadesBelowAllNumbersIsFound) {
  for (const char* masking : {"smith_ggx", "smith_beckmann"})
    for (const Metric metric : {Metric::relative, Metric::log})
      expect_no_more_than_truth(
          (std::string("lambert+beckmann/") + masking + ".correlated/conductor").c_str(),
          "alpha=0.038,eta=0.9305,k=1.5896,kd=0",
          {.layout = Layout::random, .samples = 60, .noise = 0.005}, metric, {251089, 1});
}

TEST(LostOptimum, OfALobeThatVanishesAtAnIndexOf1IsNotAboveTheDiffuseAlone) {
  const Table tables[] = {
      synthesize(test::bind("lambert", "kd=0.2", 3),
                 {.layout = Layout::random, .samples = 40, .noise = 0.1, .seed = 2}),
      synthesize(test::bind("lambert", "kd=0.2", 1), {.layout = Layout::in_plane, .noise = 0.02})};
  for (const Table& t : std::span(tables).first(test::few(2)))
    for (const Metric metric : {Metric::log, Metric::relative}) {
      FitOptions o;
      o.metric = metric;
      o.certificate = Certify::automatic;
      o.model = "lambert";
      const double alone = fit(t, o).document.cost;
      for (const char* fresnel : {"conductor", "dielectric"}) {
        o.model = std::string("lambert+ggx/smith_ggx.correlated/") + fresnel;
        EXPECT_LE(fit(t, o).document.cost, alone * (1 + 1e-6)) << fresnel << name_of(metric);
      }
    }
}

TEST(LostOptimum, OfTwoLobesIsToldWhereOneDoesBetter) {
  GONIO_MANY_FITS();
  GONIO_NEEDS_SHARED(file, "data/mbsdf/carpaint_blue.mbsdf");
  // F of Schlick is 1 at grazing whatever f0 is: a second lobe cannot vanish.
  const Table t = read_table(file);
  for (const bool copies : {false, true}) {
    FitOptions one, two;
    one.bin_sensitivity = two.bin_sensitivity = false;
    one.copies = two.copies = copies;
    two.model = one.model + "+ggx/smith_ggx.correlated/schlick";
    two.certificate = Certify::automatic;
    const auto a = fit(t, one).document, b = fit(t, two).document;
    const bool told = std::ranges::any_of(b.warnings, [](const std::string& w) {
      return w.find("lobes the model meets the table better") != std::string::npos;
    });
    EXPECT_EQ(told, b.cost > a.cost) << a.cost << " " << b.cost;
    EXPECT_LT(b.cost, 1.05 * a.cost);
  }
}

TEST(LostOptimum, OfTwoLobesIsComparedWithTheBestOfFewer) {
  GONIO_MANY_FITS();
  GONIO_NEEDS_SHARED(file, "data/mbsdf/carpaint_blue.mbsdf");
  const Table t = read_table(file);
  FitOptions o;
  o.metric = Metric::relative;
  o.bin_sensitivity = false;
  o.certificate = Certify::automatic;
  const std::string lobe = "+ggx/smith_ggx.correlated/schlick";
  const auto cost_of = [&](const std::string& model) {
    o.model = model;
    return fit(t, o).document.cost;
  };
  const double least = std::min(cost_of("lambert"), cost_of("lambert" + lobe));
  o.model = "lambert" + lobe + lobe;
  const auto two = fit(t, o).document;
  const bool said = std::ranges::any_of(two.warnings, [&](const std::string& w) {
    return w.find(fmt::format("(cost {:.6g} for", least)) != std::string::npos;
  });
  EXPECT_EQ(said, two.cost > least) << fmt::format("{:.17g} {:.17g}", two.cost, least);
}

TEST(LostOptimum, OfARetroreflectorIsNotTheFirstValley) {
  GONIO_NEEDS_SHARED(file, "data/alta_retro/retro-3M-jaune.dat");
  const Table t = read_table(file);
  FitOptions o;
  o.metric = Metric::relative;
  FitOptions wide = o;
  wide.bounds = parse_settings(std::vector<std::string>{"alpha=0.2,1"});
  EXPECT_LE(fit(t, o).document.cost, fit(t, wide).document.cost * (1 + 1e-6));
  if (test::few(4) < 4) return;
  for (const char* fresnel : {"schlick", "dielectric"})
    for (const char* ndf : {"ggx", "gtr"}) {
      o.model = std::string("lambert+") + ndf + "/smith_ggx.correlated/" + fresnel;
      expect_nothing_lower(t, o, 1);
    }
}

/// Holds the fit of a table without a certificate against that with one, which may have nothing to repair, and against
/// the truth.
void expect_nothing_to_repair(const std::string& model,
                              const std::vector<std::string>& settings,
                              std::size_t channels,
                              Metric metric,
                              const SynthOptions& how) {
  const auto truth = bind_model(model, parse_settings(settings), channels);
  const Table t = synthesize(truth, how);
  FitOptions o;
  o.model = model;
  o.metric = metric;
  o.bin_sensitivity = false;
  const Problem p = pose(t, o);
  const auto data = fit_data<double>(sampling_for(p, t, t.bins()));
  const double there = minimise(p, data, truth, no_huber).solution.at.cost;
  o.certificate = Certify::none;
  const auto alone = fit(t, o);
  o.certificate = Certify::automatic;
  const auto certified = fit(t, o);
  EXPECT_LE(alone.document.cost, std::min(there, certified.document.cost) * (1 + 1e-6))
      << model << text_of(truth) << " " << name_of(metric) << " " << name_of(how.layout) << " "
      << how.samples << " " << how.noise << " " << how.seed << "\n  alone" << text_of(alone.model)
      << "\n  certified" << text_of(certified.model);
}

TEST(SearchAlone, LeavesTheCertificateNothingToRepairOfUsualModels) {
  for (std::uint64_t seed = 1; seed <= test::few(2); ++seed)
    for (const auto usual : usual_models()) {
      const std::string model(usual);
      std::mt19937_64 random(seed);
      const auto any = [&](auto... of) { return std::array{of...}[random() % sizeof...(of)]; };
      const auto settings = test::material_of(model, random);
      // One azimuth tells no tangent.
      const Layout layout = model.find("aniso") != model.npos
                                ? Layout::random
                                : any(Layout::random, Layout::in_plane, Layout::hemisphere);
      expect_nothing_to_repair(model, settings, any(std::size_t{1}, std::size_t{3}),
                               any(Metric::log, Metric::l2_cosine, Metric::relative),
                               {.layout = layout,
                                .samples = any(std::size_t{60}, std::size_t{300}),
                                .noise = any(0.02, 0.1),
                                .seed = seed});
    }
}

TEST(SearchAlone, LooksIntoTheOtherValleysOfAMetalOnceItsWidthIsFound) {
  GONIO_MANY_FITS();
  expect_nothing_to_repair("ggx/smith_ggx.correlated/conductor",
                           {"alpha=0.08157,eta=0.08911,0.03688,0.2262,k=1.411,0.0204,2.662"}, 3,
                           Metric::relative,
                           {.layout = Layout::random, .samples = 60, .noise = 0.1, .seed = 1881});
  const char* const gtr = "gtr/smith_ggx.correlated/conductor";
  expect_nothing_to_repair(gtr, {"alpha=0.002216,gamma=7.705,eta=0.5164,k=4.423"}, 1,
                           Metric::relative,
                           {.layout = Layout::random, .samples = 300, .noise = 0.02, .seed = 1778});
  expect_nothing_to_repair(gtr, {"alpha=0.3372,gamma=9.004,eta=0.06706,k=0.06468"}, 1,
                           Metric::l2_cosine,
                           {.layout = Layout::hemisphere, .noise = 0.02, .seed = 500});
  expect_nothing_to_repair("blinn_phong/cook_torrance/conductor",
                           {"alpha=0.005974,eta=6.124,k=7.928"}, 1, Metric::log,
                           {.layout = Layout::in_plane, .noise = 0.02, .seed = 1828});
  // With longer steps it leaves the valley of one channel.
  expect_nothing_to_repair(
      "lambert+ggx/smith_ggx.correlated/conductor",
      {"alpha=0.2291,kd=0.5493,0.2268,0.02762,eta=0.02615,4.519,0.01752,k=2.012,14.69,3.615"}, 3,
      Metric::relative, {.layout = Layout::random, .samples = 60, .noise = 0.02, .seed = 214});
}

TEST(SearchAlone, FollowsStartsThatAreNotTheBestYet) {
  expect_nothing_to_repair("blinn_phong/cook_torrance/conductor",
                           {"alpha=0.9376,eta=0.0231,k=0.04189"}, 1, Metric::relative,
                           {.layout = Layout::random, .samples = 60, .noise = 0.02, .seed = 192});
  expect_nothing_to_repair(
      "lambert+ggx/smith_ggx.correlated/schlick.f90",
      {"alpha=0.006009,kd=0.1696,0.8131,0.3776,f0=0.4501,0.1862,0.05222,f90=0.1569"}, 3,
      Metric::l2_cosine,
      {.layout = Layout::hemisphere, .samples = 300, .noise = 0.02, .seed = 1241});
}

/// Chassis of a satellite, whose columns are named the other way round.
Table chassis(const std::string& file) {
  const test::Folder folder;
  folder.write("chassis.csv.gonio.json",
               R"({"schema":"gonio.table/1","columns":{"theta_i":"phi_i","phi_i":"theta_i",)"
               R"("theta_o":"phi_o","phi_o":"theta_o","f":"brdf"}})");
  return read_table(folder.write("chassis.csv", test::read_bytes(file)));
}

TEST(LostOptimum, OfAConductorIsNotLostAtAnExtinctionOf0) {
  GONIO_NEEDS_SHARED(file, "data/starlink/chassis_brdf.csv");
  const Table t = chassis(file);
  FitOptions o;
  o.model = "ggx/smith_ggx.correlated/conductor";
  for (const Metric metric : {Metric::log, Metric::l2_cosine, Metric::relative}) {
    o.metric = metric;
    expect_nothing_lower(t, o, 1);
  }
}

}  // namespace
}  // namespace gonio
