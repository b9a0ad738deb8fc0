// Budgets of a choice, and the worst that is found.
#include "validate/validate.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "integrate/albedo/directional_albedo.h"
#include "many_fits.h"
#include "optics/refractive_index.h"
#include "reports/measure/fresnel_error.h"
#include "stability/answer.h"
#include "support.h"
#include "validate/checks.h"
#include "validate/measure.h"
#include "validate/words.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

using nlohmann::json;

Validation of(json budgets, json more = {}) {
  json j = {{"schema", "gonio.choice/1"},
            {"model", "ggx/smith_ggx.correlated/schlick"},
            {"domain", {{"roughness", {0.1, 1}}, {"f0", {0.04, 0.9}}}},
            {"budgets", std::move(budgets)}};
  if (!more.is_null()) j.update(more);
  return validate(parse_choice("choice.json", j.dump()));
}
const BudgetCheck& only(const Validation& v) {
  EXPECT_EQ(v.budgets.size(), 1U);
  return v.budgets[0];
}
double white_albedo(const std::string& model, double roughness, double mu) {
  const auto b = furnace(bind_model(model, {{"alpha", {roughness * roughness}}}, 3));
  return directional_albedo(b, {&mu, 1})[0].value[0];
}

const std::string remapped = "ggx/schlick_ggx.direct/schlick";

TEST(Validate, FindsAReferenceToBeItself) {
  for (const char* model :
       {"ggx/smith_ggx.correlated/schlick", "beckmann/smith_beckmann.correlated/schlick",
        "lambert+ggx/smith_ggx.separable/schlick"}) {
    const auto v = of({{"albedo_error", 0}, {"delta_e_2000", {{"limit", 0}}}},
                      {{"model", model}, {"reference", model}});
    EXPECT_TRUE(v.holds()) << model;
    for (const auto& b : v.budgets) EXPECT_EQ(b.found, 0) << b.budget;
  }
}

TEST(Validate, RaisesNoFalseAlarmOnWhatKeepsTheLaws) {
  const auto v =
      of({{"energy_gain", 1e-5}, {"reciprocity", 1e-9}, {"nonfinite", 0}},
         {{"domain", {{"roughness", {0.2, 1}}, {"f0", {0.04, 0.9}}, {"mu", {0.05, 1}}}}});
  for (const auto& b : v.budgets) EXPECT_TRUE(b.holds) << sentence(b);
}

TEST(Validate, FindsTheWorstOfAMaskingThatARendererShips) {
  GONIO_MANY_FITS();
  const auto b =
      only(of({{"albedo_error", 0.01}}, {{"model", remapped},
                                         {"reference", smith},
                                         {"domain", {{"roughness", {0.1, 1}}, {"f0", 1}}}}));
  EXPECT_FALSE(b.holds);
  double worst = 0;  // by brute force, finer than the search's grid
  for (double r = 0.1; r <= 1.0001; r += 0.01)
    for (double mu = 0.05; mu <= 1.0001; mu += 0.02)
      worst = std::max(worst, std::abs(white_albedo(remapped, std::min(r, 1.0), std::min(mu, 1.0)) -
                                       white_albedo(smith, std::min(r, 1.0), std::min(mu, 1.0))));
  EXPECT_GT(b.found, worst - 2e-4);
  EXPECT_LT(b.found, worst + 2e-3);
  const double again = std::abs(white_albedo(remapped, at(b, "roughness"), at(b, "mu")) -
                                white_albedo(smith, at(b, "roughness"), at(b, "mu")));
  EXPECT_NEAR(again, b.found, 3e-5) << "the input that is named gives it";
}

TEST(Validate, FindsRoughnessThatIsSquaredTwice) {
  const auto v = of({{"albedo_error", 0.02}}, {{"alpha", "roughness^4"}, {"reference", smith}});
  EXPECT_FALSE(v.holds());
  EXPECT_GT(only(v).found, 0.05);
  EXPECT_TRUE(of({{"albedo_error", 0.02}}, {{"reference", smith}}).holds());
}

TEST(Validate, TellsEnergyThatOneBounceLosesAndThatCompensationGivesBack) {
  GONIO_MANY_FITS();
  const json white = {{"domain", {{"roughness", {0.1, 1}}}}};
  const auto single = only(of({{"energy_loss", 0.3}}, white));
  EXPECT_FALSE(single.holds);
  EXPECT_NEAR(single.found, 1 - white_albedo(smith, at(single, "roughness"), at(single, "mu")),
              3e-5);
  EXPECT_EQ(at(single, "roughness"), 1);
  json all = white;
  for (const char* how : {"kulla_conty", "turquin", "deterministic"}) {
    all["scattering"] = how;
    const auto b = only(of({{"energy_loss", 1e-3}}, all));
    EXPECT_TRUE(b.holds) << how << ": " << b.found;
  }
}

TEST(Validate, FindsEnergyThatIsMade) {
  // Schlick's k for image-based light at small roughness under no masking at all: more goes out
  // than came in.
  const auto v = of({{"energy_gain", 0.01}},
                    {{"model", "ggx/implicit/schlick"}, {"domain", {{"roughness", {0.5, 1}}}}});
  const auto none = of({{"energy_gain", 0.01}},
                       {{"model", "ggx/none/schlick"}, {"domain", {{"roughness", {0.5, 1}}}}});
  EXPECT_FALSE(none.holds());
  EXPECT_GT(only(none).found, 0.5);
  EXPECT_TRUE(v.holds()) << only(v).found;
}

TEST(Validate, TellsFresnelsErrorAsTheReportDoes) {
  for (const char* symbol : {"Au", "Fe"}) {
    const auto b = only(of({{"fresnel_error", 0.001}}, {{"domain", {{"metal", symbol}}}}));
    double most = 0;
    for (const auto& r : fresnel_errors(metal(*find_metal(symbol)), 360))
      if (r.form == "fresnel.schlick") most = std::max(most, std::abs(r.max_abs));
    EXPECT_NEAR(b.found, most, 1e-9) << symbol;
    EXPECT_FALSE(b.holds);
  }
  EXPECT_EQ(only(of({{"fresnel_error", 0}}, {{"model", "ggx/smith_ggx.correlated/dielectric"},
                                             {"domain", {{"eta", {1.3, 2}}}}}))
                .found,
            0);
}

TEST(Validate, TellsColourByTheQuantileThatIsAsked) {
  GONIO_MANY_FITS();
  const json more = {{"model", "ggx/smith_ggx.correlated/schlick"},
                     {"reference", "ggx/smith_ggx.correlated/conductor"},
                     {"domain", {{"roughness", {0.1, 1}}, {"metal", {"Fe"}}}}};
  const auto found = [&](double quantile) {
    return only(of({{"delta_e_2000", {{"limit", 1}, {"quantile", quantile}}}}, more)).found;
  };
  EXPECT_GT(found(1), 3);
  EXPECT_LT(found(0.5), found(0.95));
  EXPECT_LE(found(0.95), found(1));
}

TEST(Validate, FindsWhatChangesWhereLightAndViewDo) {
  EXPECT_TRUE(of({{"reciprocity", 1e-9}}, {{"scattering", "kulla_conty"}}).holds());
  const auto b = only(of({{"reciprocity", 0.01}}, {{"scattering", "turquin"}}));
  EXPECT_FALSE(b.holds);
  EXPECT_GT(b.found, 0.1);
  EXPECT_THROW(of({{"reciprocity", 0.01}}, {{"scattering", "fdez_aguera"}}), Error);
}

TEST(Validate, TellsTheChangeOverTheLargerOfTheTwo) {
  // Turquin's f is that of one bounce times a factor of the viewer's direction.
  const auto b = only(of({{"reciprocity", 0}},
                         {{"scattering", "turquin"}, {"domain", {{"roughness", 1}, {"f0", 0.9}}}}));
  const auto model = bind_model(smith, {{"alpha", {1}}, {"f0", {0.9}}}, 1);
  std::vector<double> mu;
  for (int i = 0; i <= 95; ++i) mu.push_back(0.05 + 0.01 * i);
  const auto bright = validating::albedos(model, Bounces::turquin, mu),
             plain = validating::albedos(model, Bounces::single, mu);
  double least = HUGE_VAL, most = 0;
  for (std::size_t m = 0; m < mu.size(); ++m) {
    least = std::min(least, bright[m][0] / plain[m][0]);
    most = std::max(most, bright[m][0] / plain[m][0]);
  }
  EXPECT_NEAR(b.found, 1 - least / most, 0.002);
}

TEST(Validate, ComparesAtTheParametersThatBothSidesShare) {
  json more = {{"model", "lambert+" + remapped},
               {"reference", "lambert+" + smith},
               {"parameters", {{"kd", 0.5}}},
               {"domain", {{"roughness", {0.4, 1}}, {"f0", 0.04}}}};
  const json budget = {{"delta_e_2000", {{"limit", 1}}}};
  const auto shared = of(budget, more);
  more["reference_parameters"] = {{"kd", 0.5}};
  EXPECT_EQ(only(shared).found, only(of(budget, more)).found);
  more["reference_parameters"] = {{"kd", 0.2}};
  EXPECT_GT(only(of(budget, more)).found, 1.5 * only(shared).found) << "another material";
  const auto document = json::parse(to_json(shared));
  for (const char* side : {"parameters", "reference_parameters"})
    EXPECT_EQ(document[side][0],
              (json{{"name", "kd"}, {"values", {0.5, 0.5, 0.5}}, {"from", "choice"}}))
        << side;
}

TEST(Validate, DrawsOneCurveOfASideThatSetsItsWidth) {
  const auto curves = [](const json& more) {
    std::vector<std::string> names;
    const auto v = of({{"energy_gain", 1}}, more);
    for (const auto& curve : v.pictures.figures.at(0).curves) names.push_back(curve.name);
    return names;
  };
  json more = {{"reference", smith}, {"domain", {{"roughness", {0.4, 1}}, {"f0", 0.04}}}};
  EXPECT_EQ(curves(more).size(), 6U);
  more["parameters"] = {{"alpha", 0.3}};
  EXPECT_EQ(curves(more),
            (std::vector<std::string>{"choice", "reference, roughness 0.4",
                                      "reference, roughness 0.7", "reference, roughness 1"}));
}

TEST(Validate, SaysEnergyThatIsKeptAndChangesAsFactors) {
  EXPECT_EQ(value_text("energy_gain", 0), "none");
  EXPECT_EQ(value_text("energy_loss", 0), "none");
  EXPECT_EQ(value_text("reciprocity", 1 - 1 / 2.7), "2.7 ×");
  EXPECT_EQ(value_text("reciprocity", 0.5), "2 ×");
  EXPECT_EQ(value_text("reciprocity", 1e-6), "1.000001 ×");
  EXPECT_EQ(value_text("reciprocity", 0.2), "1.25 ×");
  EXPECT_EQ(value_text("reciprocity", 1e-15), "none");
  EXPECT_EQ(value_text("reciprocity", 1), "any factor");
  EXPECT_EQ(value_text("albedo_error", 0), "0");
}

TEST(Validate, LooksBetweenTheStepsOfItsGrid) {
  const json j = {{"schema", "gonio.choice/1"},
                  {"model", smith},
                  {"alpha", "roughness^4"},
                  {"reference", smith},
                  {"domain", {{"roughness", {0.1, 1}}, {"f0", 0.9}}},
                  {"budgets", {{"albedo_error", 0.01}}}};
  const Choice c = parse_choice("choice.json", j.dump());
  const auto found = [&](bool refined) {
    return validating::checks_of(c, {9, 8, refined})[0].check({}).found;
  };
  EXPECT_GT(found(true), found(false) * 1.001);
}

TEST(Validate, HoldsWhatIsNoNumberForTheWorst) {
  const double nan = std::nan("");
  using validating::worse;
  EXPECT_EQ(worse(1, 2), 2);
  EXPECT_EQ(worse(2, 1), 2);
  EXPECT_TRUE(std::isnan(worse(nan, 5)));
  EXPECT_TRUE(std::isnan(worse(5, nan)));
  const json j = {{"schema", "gonio.choice/1"},
                  {"model", smith},
                  {"domain", {{"roughness", {0.1, 1}}}},
                  {"budgets", {{"energy_gain", 1}}}};
  const Choice c = parse_choice("choice.json", j.dump());
  const validating::ErrorAt error = [&](const Substance&, double roughness,
                                        std::span<const double> mu) {
    return std::vector<double>(mu.size(), roughness > 0.9 ? nan : 7);
  };
  const auto w = validating::worst(c, {}, validating::on_grid(c, {}, error, {}), error);
  EXPECT_TRUE(std::isnan(w.value));
  EXPECT_EQ(w.at.roughness, 1);
  BudgetCheck b{"albedo_error", 1e-3, nan, false, "searched"};
  b.at = {{"roughness", 1}};
  EXPECT_EQ(sentence(b), "The model has no value at roughness 1, so it keeps no budget there.");
}

TEST(Validate, TellsTimeOverTheBaselines) {
  // Several times as dear either way: no machine is so busy.
  const auto times = [](const char* model, const char* baseline) {
    return only(of({{"ns", {{"limit", 1}, {"baseline", baseline}}}},
                   {{"model", model}, {"domain", json::object()}}));
  };
  const char* const dear = "lambert+gtr/smith_gtr.correlated/conductor";
  EXPECT_FALSE(times(dear, "lambert").holds);
  EXPECT_TRUE(times("lambert", dear).holds);
}

TEST(Validate, TakesTheSubstanceOfAFit) {
  const test::Folder f;
  f.write("fit.json",
          json{{"schema", "gonio.fit/1"},
               {"model", smith},
               {"channels", {"r", "g", "b"}},
               {"parameters", {{"alpha", {{"value", 0.3}}}, {"f0", {{"value", {0.9, 0.5, 0.2}}}}}}}
              .dump());
  json j = {{"schema", "gonio.choice/1"},
            {"model", remapped},
            {"reference", smith},
            {"domain", {{"fits", "fit.json"}}},
            {"budgets", {{"albedo_error", 0.01}}}};
  const auto of_fit = validate(read_choice(f.write("choice.json", j.dump())));
  const json set = {{"alpha", 0.3}, {"f0", {0.9, 0.5, 0.2}}};
  j["domain"] = json::object();
  j["parameters"] = j["reference_parameters"] = set;
  const auto of_numbers = validate(parse_choice("choice.json", j.dump()));
  EXPECT_EQ(only(of_fit).found, only(of_numbers).found);
  EXPECT_GT(only(of_fit).found, 0.1);
  EXPECT_EQ(only(of_fit).substance, "fit.json");
  j["domain"] = {{"fits", "fit.json"}};
  j["parameters"] = j["reference_parameters"] = json::object();
  j["reference"] = "ggx/smith_ggx.correlated/conductor";
  EXPECT_THROW(validate(read_choice(f.write("choice.json", j.dump()))), Error)
      << "the fit has no eta, and a default is another metal";
}

TEST(Validate, NamesTheInputThatHasNoValueInHalf) {
  const json narrow = {{"number", "half"}, {"model", "ggx/smith_ggx.correlated/schlick"}};
  json sharp = narrow;
  sharp["domain"] = {{"roughness", {0.03, 0.03}}, {"mu", {0.1, 1}}, {"f0", 0.04}};
  const auto b = only(of({{"nonfinite", 0}}, sharp));
  EXPECT_FALSE(b.holds);
  EXPECT_FALSE(b.at.empty());
  EXPECT_GT(b.found, 0);
  EXPECT_NE(place_text(b).find("alpha"), std::string::npos) << place_text(b);
  // What overflows and what goes wrong otherwise are counted both.
  sharp["domain"] = {{"roughness", 0.1}, {"mu", {0.05, 1}}, {"f0", 0.9}};
  stability::Question q;
  q.arithmetic.number = Number::half;
  q.subject = stability::subjects_of(smith).front();
  const double alpha = 0.1 * 0.1;
  set_domain(q.subject, "alpha", {alpha, alpha});
  set_domain(q.subject, "f0", {0.9, 0.9});
  for (const char* name : {"nol", "nov"}) set_domain(q.subject, name, {0.05, 1});
  const auto looked = answer(q).looked;
  EXPECT_GT(looked.no_value.count, 0U);
  EXPECT_GT(looked.overflow.count, 0U);
  EXPECT_EQ(only(of({{"nonfinite", 0}}, sharp)).found,
            static_cast<double>(looked.no_value.count + looked.overflow.count));
}

TEST(Validate, CountsOperationsAndBytesOfACompensationToo) {
  const auto operations = [](const char* how) {
    return only(of({{"operations", 1}}, {{"scattering", how}})).found;
  };
  EXPECT_GT(operations("turquin"), operations("single"));
  EXPECT_EQ(only(of({{"table_bytes", 0}})).found, 0);
  EXPECT_TRUE(of({{"table_bytes", 0}}).holds());
  EXPECT_GT(only(of({{"table_bytes", 0}}, {{"scattering", "kulla_conty"}})).found, 1000);
  EXPECT_THROW(of({{"operations", 1}}, {{"scattering", "deterministic"}}), Error);
}

TEST(Suggest, NamesTheCheapestThatKeepsEveryBudget) {
  GONIO_MANY_FITS();
  json j = {{"schema", "gonio.choice/1"},
            {"model", smith},
            {"reference", smith},
            {"domain", {{"roughness", {0.3, 1}}, {"f0", 0.04}}},
            {"budgets", {{"albedo_error", 0.9}}}};
  const auto suggested = [&](double limit) {
    j["budgets"]["albedo_error"] = limit;
    return suggest(parse_choice("choice.json", j.dump()));
  };
  const auto any = suggested(0.9), near = suggested(2e-3), exact = suggested(1e-6);
  ASSERT_TRUE(any && near && exact);
  EXPECT_EQ(any->tried, 0U) << "the cheapest of all keeps a budget that all keep";
  EXPECT_LT(any->operations, near->operations);
  EXPECT_LE(near->operations, exact->operations);
  EXPECT_EQ(exact->model, smith);
  EXPECT_EQ(exact->scattering, "single");
  j["budgets"] = {{"operations", 2}};
  const auto none = suggest(parse_choice("choice.json", j.dump()));
  ASSERT_TRUE(none);
  EXPECT_FALSE(none->holds);
  EXPECT_EQ(none->operations, any->operations) << "the cheapest of all is the nearest";
  EXPECT_EQ(none->stopped_by, std::vector<std::string>{"operations"});
  j["model"] = "lambert";
  EXPECT_THROW(suggest(parse_choice("choice.json", j.dump())), Error);
}

TEST(Suggest, NamesTheNearestAndTheBudgetThatStopsIt) {
  GONIO_MANY_FITS();
  const json j = {{"schema", "gonio.choice/1"},
                  {"model", remapped},
                  {"reference", smith},
                  {"domain", {{"roughness", {0.4, 1}}, {"f0", 0.04}}},
                  {"budgets", {{"albedo_error", 1e-3}, {"operations", 25}}}};
  const Choice c = parse_choice("choice.json", j.dump());
  const auto s = suggest(c);
  ASSERT_TRUE(s);
  EXPECT_FALSE(s->holds);
  ASSERT_EQ(s->stopped_by.size(), 1U) << "others break both";
  Choice nearest = c;
  nearest.shipped.model = s->model;
  nearest.shipped.scattering = *find_value<Bounces>(s->scattering);
  std::size_t broken = 0;
  for (const auto& b : validate(nearest).budgets)
    if (!b.holds) {
      ++broken;
      EXPECT_EQ(b.budget, s->stopped_by[0]);
      EXPECT_NE(s->why.find(sentence(b)), s->why.npos) << s->why;
    }
  EXPECT_EQ(broken, 1U);
}

TEST(Suggest, TakesACompensationWhereEnergyMustNotBeLost) {
  GONIO_MANY_FITS();
  const json j = {{"schema", "gonio.choice/1"},
                  {"model", smith},
                  {"domain", {{"roughness", {0.5, 1}}, {"f0", 0.9}}},
                  {"budgets", {{"energy_loss", 0.01}, {"reciprocity", 1e-6}}}};
  const auto s = suggest(parse_choice("choice.json", j.dump()));
  ASSERT_TRUE(s);
  EXPECT_EQ(s->scattering, "kulla_conty") << "Turquin's is not reciprocal";
}

TEST(Validate, SaysEachBrokenBudgetInOneSentenceWithItsPlace) {
  const auto v = of({{"albedo_error", 0.01}, {"energy_gain", 0.01}},
                    {{"model", remapped}, {"reference", smith}});
  ASSERT_EQ(v.budgets.size(), 2U);
  EXPECT_FALSE(v.holds());
  const auto text = sentence(v.budgets[0]);
  EXPECT_TRUE(text.starts_with("The directional albedo is off the reference's by 0.")) << text;
  EXPECT_NE(text.find("at roughness "), text.npos) << text;
  EXPECT_NE(text.find(", cosine "), text.npos) << text;
  EXPECT_TRUE(text.ends_with("the budget is 0.01. The model is too dark.")) << text;
  const auto brighter = of({{"albedo_error", 0.01}}, {{"model", smith}, {"reference", remapped}});
  EXPECT_TRUE(sentence(brighter.budgets[0]).ends_with(" The model is too bright."));
}

TEST(Validate, WritesWhatMachinesRead) {
  const auto v = of({{"albedo_error", 0.01}, {"energy_gain", 0.01}},
                    {{"model", remapped}, {"reference", smith}});
  const auto xml = junit_of(v);
  EXPECT_NE(xml.find("tests=\"2\" failures=\"1\""), xml.npos) << xml;
  EXPECT_NE(xml.find("<failure message=\"The directional albedo"), xml.npos) << xml;
  const auto sarif = json::parse(sarif_of(v));
  ASSERT_EQ(sarif["runs"][0]["results"].size(), 1U);
  EXPECT_EQ(sarif["runs"][0]["results"][0]["ruleId"], "albedo_error");
  EXPECT_EQ(sarif["runs"][0]["tool"]["driver"]["rules"].size(), 2U);
  EXPECT_EQ(sarif["runs"][0]["automationDetails"]["id"], "gonio/choice.json/")
      << "so that several choices of a commit stand side by side";
  const auto place = sarif["runs"][0]["results"][0]["locations"][0]["physicalLocation"];
  EXPECT_EQ(place["region"]["startLine"], 1);
  const auto document = json::parse(to_json(v));
  EXPECT_EQ(document["schema"], "gonio.validation/1");
  EXPECT_EQ(document["holds"], false);
  EXPECT_EQ(document["budgets"][0]["budget"], "albedo_error");
  EXPECT_TRUE(document["budgets"][0]["at"]["roughness"].is_number());
  EXPECT_EQ(document["budgets"][0]["evidence"], "searched");
  EXPECT_EQ(document["budgets"][0]["limit_text"], "0.01");
  EXPECT_EQ(document["budgets"][0]["found_text"],
            value_text("albedo_error", document["budgets"][0]["found"]));
}

}  // namespace
}  // namespace gonio
