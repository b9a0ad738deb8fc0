#include "fitting/choice/choice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <random>
#include <span>

#include "data_synth/synth.h"
#include "fitting/choice/cross_validation.h"
#include "fitting/choice/document.h"
#include "fitting/fit.h"
#include "fitting/materials.h"
#include "fitting/support.h"
#include "many_fits.h"
#include "refusal.h"
#include "tables.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

const std::string paint = "lambert+ggx/smith_ggx.correlated/schlick",
                  metal = "ggx/smith_ggx.correlated/schlick",
                  gtr = "lambert+gtr/smith_ggx.correlated/schlick";

Table table_of(const std::string& model,
               const std::vector<std::string>& settings,
               std::uint64_t seed,
               double noise = 0.02) {
  SynthOptions s;
  s.layout = Layout::random;
  s.noise = noise;
  s.seed = seed;
  return synthesize(bind_model(model, parse_settings(settings), 1), s);
}

bool recommends(const ModelChoice& c, const std::string& truth) {
  const Advice a = advise(c);
  return a.recommended == truth || std::ranges::find(a.as_good, truth) != a.as_good.end();
}

TEST(ModelChoice, RecommendsTheModelThatATableWasMadeFromOrSaysThatItCannotTell) {
  const std::vector<std::string> models(usual_models().begin(), usual_models().end());
  std::size_t right = 0, all = 0, taken = 0;
  for (std::uint64_t seed = 1; seed <= test::few(4); ++seed)
    for (const auto& truth : std::span(models).first(test::few(models.size()))) {
      std::mt19937_64 random(1000 * seed + all);
      const auto settings = test::material_of(truth, random);
      const auto choice = compare_models(table_of(truth, settings, seed), {}, models);
      const Advice a = advise(choice);
      const bool told = recommends(choice, truth);
      if (!told)
        std::cout << truth << " " << fmt::format("{}", fmt::join(settings, ","))
                  << " was taken for " << a.recommended << '\n';
      right += told;
      taken += a.recommended == truth;
      ++all;
    }
  EXPECT_GE(20 * right, 19 * all);
  EXPECT_GE(4 * taken, 3 * all);  // and mostly it can tell
}

TEST(ModelChoice, TakesTheFewestParametersThatDoAsWell) {
  const auto choice = compare_models(table_of(paint, {"alpha=0.2", "f0=0.05", "kd=0.3"}, 1), {},
                                     std::vector{gtr, paint});
  const Advice a = advise(choice);
  EXPECT_EQ(a.recommended, paint);
  EXPECT_EQ(a.as_good, std::vector<std::string>{gtr});
  const auto document = nlohmann::json::parse(to_json(choice, a, {"t", "s", "csv", "log"}));
  EXPECT_EQ(document["recommended"], paint);
  EXPECT_EQ(document["models"][1]["cv_log_rms"], choice.rows[1].cv_log_rms);
  EXPECT_EQ(choice.rows[0].parameters, choice.rows[1].parameters + 1);
  EXPECT_GT(choice.rows[0].bic, choice.rows[1].bic);
  EXPECT_NEAR(choice.rows[1].cv_log_rms, 0.02, 0.002);
  EXPECT_GE(choice.rows[1].cv_log_rms, choice.rows[1].log_rms);
  EXPECT_GT(choice.rows[1].ns, 0);
}

TEST(ModelChoice, GivesAParameterToAicOnlyWhereItGainsMoreThanByChance) {
  // A table of paint: the parameter that gtr has more gains 1.1 of −2 ln L, and one without effect
  // gains 1 on average.
  const std::vector<std::string> models{paint, gtr};
  const auto gain = [&](const ModelChoice& c) {
    return 2 * c.effective_values * std::log(c.rows[0].log_rms / c.rows[1].log_rms);
  };
  const auto chance =
      compare_models(table_of(paint, {"alpha=0.2", "f0=0.05", "kd=0.3"}, 9), {}, models);
  ASSERT_GT(gain(chance), 1);
  ASSERT_LT(gain(chance), 2);
  EXPECT_LT(chance.rows[0].aic, chance.rows[1].aic);
  const auto tail = compare_models(
      table_of(gtr, {"alpha=0.2", "gamma=2.1", "f0=0.05", "kd=0.3"}, 9, 0.1), {}, models);
  ASSERT_GT(gain(tail), 2);
  EXPECT_GT(tail.rows[0].aic, tail.rows[1].aic);
}

TEST(ModelChoice, CountsHowFarAModelIsBehindInJackknifedErrorsOverBlocks) {
  const Table t = table_of(paint, {"alpha=0.2", "f0=0.05", "kd=0.3"}, 2);
  const std::vector<std::string> models{paint, gtr, "lambert"};
  const auto choice = compare_models(t, {}, models);
  const auto blocks = incident_blocks(Sampling(t, t.bins(), Metric::log, 0, false));
  const auto left_by = [&](std::size_t k) {
    FitOptions o;
    o.model = models[k];
    return cross_validate(t, pose(t, o), blocks, choice.fits[k]);
  };
  const auto best = left_by(0);
  EXPECT_EQ(choice.rows[0].cv_behind, 0);
  for (const std::size_t k : {1U, 2U}) {
    const auto left = left_by(k);
    // Means of the differences without each block.
    const auto mean_without = [&](std::size_t block) {
      double sum = 0, n = 0;
      for (std::size_t b = 0; b < blocks.count; ++b)
        if (b != block) sum += (left[b].squares - best[b].squares) / left[b].values, ++n;
      return sum / n;
    };
    const double mean = mean_without(blocks.count), n = static_cast<double>(blocks.count);
    double squares = 0;
    for (std::size_t b = 0; b < blocks.count; ++b) squares += std::pow(mean_without(b) - mean, 2);
    EXPECT_NEAR(choice.rows[k].cv_behind, mean / std::sqrt(squares * (n - 1) / n),
                1e-6 * choice.rows[k].cv_behind)
        << models[k];
    EXPECT_GT(choice.rows[k].cv_behind, 0);
  }
}

TEST(ModelChoice, OfAllAndOthersIsOfTheUsualModelsThenOfTheOthersEachOnce) {
  const auto usual = usual_models();
  std::vector<std::string> expected(usual.begin(), usual.end());
  EXPECT_EQ(models_asked({"all"}), expected);
  EXPECT_EQ(models_asked({paint, "all"}), expected) << "one of the usual";
  const std::string f90 = "lambert+gtr/smith_gtr.correlated/schlick.f90";
  expected.insert(expected.end(), {f90, "disney"});
  EXPECT_EQ(models_asked({f90, "all", gtr, "disney"}), expected);
  EXPECT_EQ(models_asked({metal, f90}), (std::vector{metal, f90}));
  EXPECT_HAS(test::refusal(
                 [] {
                   models_asked({"all", "all"});
                 },
                 Exit::usage),
             "'all' is there twice");
  EXPECT_HAS(test::refusal(
                 [] {
                   models_asked({"all", "no_such_model"});
                 },
                 Exit::usage),
             "no_such_model");
}

TEST(ModelChoice, LeavesAModelThatCannotBeFittedInItsPlaceAndSaysWhy) {
  const std::string aniso = "ggx_aniso/smith_ggx_aniso.correlated/schlick";
  const Table t =
      synthesize(bind_model(metal, parse_settings(std::vector<std::string>{"alpha=0.3,f0=0.8"}), 1),
                 {.layout = Layout::in_plane, .noise = 0.02});
  const auto choice =
      compare_models(t, {}, std::vector<std::string>{aniso, metal, "no_such_model"});
  ASSERT_EQ(choice.rows.size(), 3U);
  EXPECT_FALSE(choice.rows[0].compared);
  EXPECT_FALSE(choice.rows[0].note.empty());
  EXPECT_TRUE(std::isnan(choice.rows[0].bic));
  EXPECT_FALSE(choice.rows[2].compared);
  EXPECT_EQ(advise(choice).recommended, metal);
}

TEST(ModelChoice, IsOfModelsWithFewerParametersThanTheTableHasValues) {
  const BoundModel grey =
      bind_model("lambert", parse_settings(std::vector<std::string>{"kd=0.3"}), 1);
  const std::vector<std::string> models{"lambert", paint};
  const auto of = [&](std::size_t samples) {
    return compare_models(
        synthesize(grey, {.layout = Layout::random, .samples = samples, .noise = 0.02}), {},
        models);
  };
  const auto choice = of(3);
  EXPECT_TRUE(choice.rows[0].compared);
  EXPECT_FALSE(choice.rows[1].compared);
  EXPECT_FALSE(choice.rows[1].note.empty());
  EXPECT_EQ(advise(choice).recommended, "lambert");
  EXPECT_NE(test::refusal([&] { of(1); }), "");
}

TEST(ModelChoice, HoldsASettingForTheModelsThatHaveItsParameter) {
  const Table t =
      synthesize(bind_model(paint, parse_settings(std::vector<std::string>{"alpha=0.2,kd=0.3"}), 1),
                 {.layout = Layout::random, .samples = 300, .noise = 0.02});
  FitOptions o;
  o.fixed = parse_settings(std::vector<std::string>{"anisotropy=0", "alpha=0.2"});
  const auto choice = compare_models(t, o, std::vector<std::string>{"lambert", paint, "disney"});
  for (const auto& r : choice.rows) EXPECT_TRUE(r.compared) << r.note;
  EXPECT_EQ(choice.rows[1].parameters, 2U);
  EXPECT_EQ(choice.fits[1].values[choice.fits[1].model.find("alpha")->first], 0.2);
  o.fixed = parse_settings(std::vector<std::string>{"nonsense=3"});
  EXPECT_HAS(test::refusal(
                 [&] {
                   compare_models(t, o, std::vector<std::string>{"lambert", paint});
                 },
                 Exit::usage),
             "'nonsense'");
}

TEST(ModelChoice, KnowsNoTangentOfASurfaceThatWasNeverTurned) {
  const std::string aniso = "ggx_aniso/smith_ggx_aniso.correlated/schlick";
  const Table t =
      synthesize(bind_model(metal, parse_settings(std::vector<std::string>{"alpha=0.3,f0=0.8"}), 1),
                 {.layout = Layout::hemisphere, .noise = 0.02});
  FitOptions o;
  o.model = aniso;
  EXPECT_NE(test::refusal([&] { fit(t, o); }, Exit::usage), "");
  Table turned = t;
  DirectionList l = *turned.list();
  for (std::size_t i = 0; i < l.phi_i_deg.size(); ++i)
    for (auto* phi : {&l.phi_i_deg, &l.phi_o_deg}) (*phi)[i] += static_cast<double>(30 * (i % 7));
  turned.where = l;
  EXPECT_NO_THROW(fit(turned, o));
}

ModelRow row(const char* model, std::size_t parameters, double cv, double behind, double bic) {
  ModelRow r;
  r.model = model;
  r.compared = r.converged = true;
  r.parameters = parameters;
  r.log_rms = r.cv_log_rms = cv;
  r.cv_behind = behind;
  r.bic = bic;
  return r;
}

TEST(Advice, TakesNoModelThatIsToldToMissWhereANearerOneIsNot) {
  ModelChoice c;
  c.blocks = 3;
  c.effective_values = 3;  // few angles tell no two models apart
  c.rows = {row("simple", 3, 0.19, 0.5, -9), row("right", 7, 0.15, 0, -11),
            row("far", 1, 0.3, 1.5, -8)};
  c.rows[1].log_rms = 0.03;
  EXPECT_EQ(advise(c).recommended, "far") << "the fewest parameters of those as good";
  c.rows[0].misses = c.rows[2].misses = true;
  EXPECT_EQ(advise(c).recommended, "right");
  EXPECT_TRUE(advise(c).as_good.empty());
  c.rows[1].misses = true;
  EXPECT_TRUE(advise(c).none_fits);
  EXPECT_EQ(advise(c).recommended, "far");
  // Not told of a model that is too far off to be told: it refutes no nearer one.
  c.rows[1].misses = true, c.rows[2].misses = false;
  EXPECT_NE(advise(c).as_good, std::vector<std::string>{});
}

TEST(Advice, CallsNoModelNearestWhoseNeighbourIsNearerAndMisses) {
  ModelChoice c;
  c.blocks = 3;
  c.rows = {row("nearer", 3, 0.03, 0, 0), row("kept", 7, 0.1, 0, 0)};
  c.rows[0].misses = true;
  c.rows[0].log_rms = 0.04, c.rows[1].log_rms = 0.02;
  const auto a = advise(c);
  EXPECT_EQ(a.recommended, "kept");
  EXPECT_EQ(a.reason.find("nearest to the table"), a.reason.npos) << a.reason;
  EXPECT_NE(a.reason.find("miss the whole table"), a.reason.npos) << a.reason;
}

TEST(ModelChoice, SaysFromWhichOffsetItsLogRmsCounts) {
  Table t = table_of(paint, {"alpha=0.3", "f0=0.04", "kd=0.2"}, 1);
  EXPECT_EQ(floor_in_words(compare_models(t, {}, std::array{paint})), "");
  t.channels = {"r", "g"};
  t.values.push_back(t.values[0]);
  for (auto& plane : t.values)
    for (std::size_t i = 0; i < t.size(); i += 10)
      plane[i] = (i % 20 == 0 ? -1e-6 : 1e-6) * static_cast<double>(500 + i);
  const auto choice = compare_models(t, {}, std::array{paint});
  FitOptions o;
  o.model = paint;
  const FitDocument d = fit(t, o).document;
  ASSERT_GT(d.log_offset, 0);
  EXPECT_EQ(choice.log_offset, d.log_offset);
  EXPECT_LT(choice.rows[0].log_rms, d.residuals.log_rms);
  EXPECT_HAS(floor_in_words(choice), fmt::format("{:.3g} 1/sr", d.log_offset));
}

TEST(Advice, TellsWhereOtherJudgesPreferAnotherModel) {
  ModelChoice c;
  c.rows = {row("small", 3, 0.3, 9, 100), row("large", 9, 0.2, 0, 140)};
  c.rows[0].delta_e_itp = 2;
  c.rows[1].delta_e_itp = 5;
  const Advice a = advise(c);
  EXPECT_EQ(a.recommended, "large");
  EXPECT_TRUE(a.as_good.empty());
  ASSERT_EQ(a.disagreement.size(), 2U);
  EXPECT_EQ(a.disagreement[0], "BIC prefers small, by 40.");
  c.rows[1].delta_e_itp = c.rows[0].delta_e_itp;  // the sphere looks alike
  EXPECT_EQ(advise(c).disagreement.size(), 1U);
}

TEST(Advice, GoesByBicWhereNoAngleCanBeLeftOut) {
  ModelChoice c;
  c.rows = {row("small", 3, ModelRow::unknown, ModelRow::unknown, 100),
            row("large", 9, ModelRow::unknown, ModelRow::unknown, 90)};
  const Advice a = advise(c);
  EXPECT_EQ(a.recommended, "large");
}

TEST(Advice, DoesNotTakeAFitThatDidNotConvergeForItsFewParameters) {
  ModelChoice c;
  c.rows = {row("small", 3, 0.2001, 0.1, 100), row("large", 9, 0.2, 0, 140)};
  EXPECT_EQ(advise(c).recommended, "small");
  c.rows[0].converged = false;
  EXPECT_EQ(advise(c).recommended, "large");
  EXPECT_TRUE(advise(c).as_good.empty());
  c.rows[0].cv_log_rms = 0.1;  // the nearest of all, but for that
  c.rows[1].cv_behind = 9;
  EXPECT_EQ(advise(c).recommended, "large");
  c.rows[1].converged = false;
  EXPECT_EQ(advise(c).recommended, "small") << "of fits none of which converged";
}

TEST(Advice, TakesNoModelForBetterByItsRounding) {
  ModelChoice c;
  c.rows = {row("small", 3, 9e-15, 9, 100), row("large", 9, 1e-16, 0, 140)};
  EXPECT_EQ(advise(c).recommended, "small");
  c.rows[1].cv_log_rms = 0;
  EXPECT_EQ(advise(c).recommended, "small");
}

TEST(Advice, LetsNoFewValuesDecideByChance) {
  ModelChoice c;
  c.rows = {row("small", 3, 0.22, 1.1, 100), row("large", 9, 0.2, 0, 140)};
  c.effective_values = 1e4;
  EXPECT_EQ(advise(c).recommended, "large");
  c.effective_values = 100;
  EXPECT_EQ(advise(c).recommended, "small");
  c.rows[0].cv_behind = 2.1;
  EXPECT_EQ(advise(c).recommended, "large");
}

TEST(Advice, TakesNothingForAsGoodThatBicPutsFarBehindOrThatLeavesTwiceTheError) {
  ModelChoice c;
  c.blocks = 4;
  c.effective_values = 10;
  c.rows = {row("small", 3, 0.22, 2.5, 100), row("large", 9, 0.2, 0, 100)};
  EXPECT_EQ(advise(c).recommended, "small") << "Student's t of three degrees of freedom is 3.2";
  c.rows[0].bic = 111;
  EXPECT_EQ(advise(c).recommended, "large");
  c.rows[0] = row("small", 3, 0.41, 1, 100);
  EXPECT_EQ(advise(c).recommended, "large");
  EXPECT_TRUE(advise(c).as_good.empty());
}

TEST(Advice, SaysThatNoneFitsWhereAllMissTheTable) {
  ModelChoice c;
  c.rows = {row("small", 3, 0.3, 9, 100), row("large", 9, 0.2, 0, 100)};
  c.rows[0].misses = true;
  EXPECT_FALSE(advise(c).none_fits);
  c.rows[1].misses = true;
  EXPECT_TRUE(advise(c).none_fits);
  EXPECT_EQ(advise(c).recommended, "large") << "the nearest";
}

TEST(ModelChoice, OfTwoLobesAtFourAnglesDoesNotTakeADiffuseTermAlone) {
  const std::string lobe = "ggx/smith_ggx.correlated/schlick.weighted";
  const std::string two = "lambert+" + lobe + "+" + lobe;
  Table t = test::list_of(std::vector<double>(4 * 29));
  DirectionList l;
  for (int in = 10; in <= 70; in += 20)
    for (int out = -84; out <= 84; out += 6) {
      l.theta_i_deg.push_back(in);
      l.phi_i_deg.push_back(0);
      l.theta_o_deg.push_back(std::abs(out));
      l.phi_o_deg.push_back(out < 0 ? 0 : 180);
    }
  t.where = l;
  const auto truth = test::bind(
      two.c_str(), "kd=0.05,alpha=0.08,f0=0.04,weight=0.5,alpha_2=0.5,f0_2=0.2,weight_2=0.5", 1);
  test::put_values(t, truth);
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (double& v : t.values[0]) v *= std::exp(0.01 * normal(random));
  const auto choice = compare_models(t, {}, std::vector{std::string("lambert"), paint, two});
  const Advice a = advise(choice);
  EXPECT_EQ(a.recommended, two);
  EXPECT_FALSE(a.none_fits);
}

TEST(Advice, SaysWhatTheOneThatIsTakenDoesNotDo) {
  ModelChoice c;
  c.rows = {row("near", 3, 0.1, 0, 100)};
  EXPECT_TRUE(advise(c).beware.empty());
  c.rows[0].log_rms = std::log(2.5);
  c.rows[0].parameters_at_bound = {"alpha"};
  EXPECT_EQ(advise(c).beware, (std::vector<std::string>{
                                  "It is not near the table: typically off by a factor of 2.5.",
                                  "alpha is at the end of its range: the model lacks something."}));
  c.rows[0].parameters_at_bound = {"f0", "f0_2"};
  EXPECT_EQ(advise(c).beware[1],
            "f0, f0_2 are at the ends of their ranges: the model lacks something.");
}

TEST(Advice, IsEmptyWhereNothingCouldBeCompared) {
  ModelChoice c;
  c.rows.resize(2);
  EXPECT_TRUE(advise(c).recommended.empty());
  const auto document = nlohmann::json::parse(to_json(c, advise(c), {"t", "s", "csv", "log"}));
  EXPECT_FALSE(document.contains("recommended"));
  EXPECT_EQ(document["models"].size(), 2U);
}

}  // namespace
}  // namespace gonio
