#include "fitting/choice/choice.h"

#include <algorithm>
#include <cmath>

#include "data_synth/synth.h"
#include "fitting/choice/document.h"
#include "many_fits.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

const std::string paint = "lambert+ggx/smith_ggx.correlated/schlick",
                  metal = "ggx/smith_ggx.correlated/schlick",
                  gtr = "lambert+gtr/smith_ggx.correlated/schlick",
                  beckmann = "lambert+beckmann/smith_beckmann.correlated/schlick";

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

TEST(ModelChoice, RecommendsTheModelThatATableWasMadeFrom) {
  struct Truth {
    std::string model;
    std::vector<std::string> settings;
  };
  const std::vector<Truth> truths{{paint, {"alpha=0.2", "f0=0.05", "kd=0.3"}},
                                  {metal, {"alpha=0.3", "f0=0.8"}},
                                  {gtr, {"alpha=0.2", "gamma=1.4", "f0=0.05", "kd=0.3"}},
                                  {beckmann, {"alpha=0.3", "f0=0.05", "kd=0.3"}}};
  const std::vector<std::string> models{paint, metal, gtr, beckmann};
  std::size_t right = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= test::few(5); ++seed)
    for (const auto& t : truths) {
      const auto choice = compare_models(table_of(t.model, t.settings, seed), {}, models);
      const Advice a = advise(choice);
      right += recommends(choice, t.model);
      ++all;
      EXPECT_TRUE(a.recommended == t.model || t.model == gtr || t.model == metal) << a.reason;
    }
  EXPECT_EQ(right, all);
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

TEST(ModelChoice, LeavesAModelThatCannotBeFittedInItsPlaceAndSaysWhy) {
  const std::string aniso = "ggx_aniso/smith_ggx_aniso.correlated/schlick";
  const Table t =
      synthesize(bind_model(metal, parse_settings(std::vector<std::string>{"alpha=0.3,f0=0.8"}), 1),
                 {.layout = Layout::in_plane, .noise = 0.02});
  const auto choice =
      compare_models(t, {}, std::vector<std::string>{aniso, metal, "no_such_model"});
  ASSERT_EQ(choice.rows.size(), 3U);
  EXPECT_FALSE(choice.rows[0].compared);
  EXPECT_NE(choice.rows[0].note.find("anisotropic"), std::string::npos);
  EXPECT_TRUE(std::isnan(choice.rows[0].bic));
  EXPECT_FALSE(choice.rows[2].compared);
  EXPECT_EQ(advise(choice).recommended, metal);
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

TEST(Advice, TellsWhereOtherJudgesPreferAnotherModel) {
  ModelChoice c;
  c.rows = {row("small", 3, 0.3, 9, 100), row("large", 9, 0.2, 0, 140)};
  c.rows[0].delta_e_itp = 2;
  c.rows[1].delta_e_itp = 5;
  const Advice a = advise(c);
  EXPECT_EQ(a.recommended, "large");
  EXPECT_TRUE(a.as_good.empty());
  ASSERT_EQ(a.disagreement.size(), 2U);
  EXPECT_TRUE(a.disagreement[0].starts_with("BIC prefers small")) << a.disagreement[0];
  EXPECT_NE(a.disagreement[1].find("sphere"), std::string::npos);
}

TEST(Advice, GoesByBicWhereNoAngleCanBeLeftOut) {
  ModelChoice c;
  c.rows = {row("small", 3, ModelRow::unknown, ModelRow::unknown, 100),
            row("large", 9, ModelRow::unknown, ModelRow::unknown, 90)};
  const Advice a = advise(c);
  EXPECT_EQ(a.recommended, "large");
  EXPECT_NE(a.reason.find("BIC"), std::string::npos);
}

TEST(Advice, DoesNotTakeAFitThatDidNotConvergeForItsFewParameters) {
  ModelChoice c;
  c.rows = {row("small", 3, 0.2001, 0.1, 100), row("large", 9, 0.2, 0, 140)};
  EXPECT_EQ(advise(c).recommended, "small");
  c.rows[0].converged = false;
  EXPECT_EQ(advise(c).recommended, "large");
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
