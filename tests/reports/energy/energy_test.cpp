#include "reports/energy/energy.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "integrate/albedo/directional_albedo.h"
#include "integrate/light/irradiance.h"
#include "integrate/scattering/half_space.h"
#include "many_fits.h"
#include "optics/spectrum.h"
#include "reports/energy/crossings.h"
#include "reports/energy/skies.h"
#include "reports/pictures.h"
#include "reports/plain.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

const EnergyOptions few{false, {0.3, 0.5, 1}, {0.1, 0.5, 1}, 1024};
const auto unwatched = [](double) {};

EnergyRows of_forms(const std::vector<std::string>& names) {
  auto o = few;
  o.forms = names;
  EnergyRows r;
  r.forms = energy_forms(o, unwatched);
  return r;
}
const EnergyForm& form(const EnergyRows& r, std::string_view name) {
  return *std::ranges::find(r.forms, name, &EnergyForm::name);
}
const std::string correlated = "masking.smith_ggx.correlated",
                  separable = "masking.smith_ggx.separable", none = "masking.none";

const std::vector<EnergyMaterial>& materials() {
  static const auto all = energy_materials(few, unwatched);
  return all;
}
const EnergyMaterial& material(std::string_view name) {
  return *std::ranges::find(materials(), name, &EnergyMaterial::name);
}

TEST(EnergyReport, KnowsWhatWhiteGgxLosesAtRoughnessOne) {
  const auto r = of_forms({correlated, separable});
  const auto& f = form(r, correlated);
  EXPECT_NEAR(f.rows.back().albedo, 1 - std::log(2.0), 1e-5);
  EXPECT_NEAR(1 - f.averages.back().albedo, 0.591, 5e-4);
  EXPECT_NEAR(1 - form(r, separable).averages.back().albedo, 0.623, 5e-4);
}

TEST(EnergyReport, LightIsMadeByNoMaskingAndByTheMobileFormsAlone) {
  GONIO_MANY_FITS();
  std::set<std::string> makers;
  const auto r = of_forms({});
  for (const auto& f : r.forms)
    for (const auto& at : f.rows)
      if (at.albedo > 1 + 1e-4) makers.insert(f.name);
  EXPECT_EQ(makers, (std::set<std::string>{"masking.none", "masking.disney_coat, gamma 1",
                                           "masking.unity_mobile", "masking.unity_mobile.urp",
                                           "masking.ue_mobile_simple", "model.unity_mobile",
                                           "model.ue_mobile_simple"}));
}

std::vector<double> twenty() {
  std::vector<double> r;
  for (int i = 1; i <= 20; ++i) r.push_back(0.05 * i);
  return r;
}
std::vector<Crossing> crossings_of(double (*loss)(double), double error = 0) {
  const auto r = twenty();
  std::vector<double> losses;
  for (const double x : r) losses.push_back(loss(x));
  return crossings_at(1, r, losses, [=](double x) { return Bounded{loss(x), error}; });
}
/// Place where a rising loss is a share.
double bisected(const std::function<double(double)>& loss, double share) {
  double low = 0, high = 1;
  while (high - low > 1e-9) (loss((low + high) / 2) > share ? high : low) = (low + high) / 2;
  return high;
}

TEST(Crossings, AreSolvedForToAHundredthOfAThousandth) {
  const auto loss = [](double r) { return r * r * r / (0.3 + r) + 0.002 * std::sin(9 * r); };
  for (const auto& c : crossings_of(loss)) {
    ASSERT_EQ(c.ranges.size(), 1U);
    EXPECT_NEAR(c.ranges[0].from, bisected(loss, c.share), 1e-5) << c.share;
    EXPECT_EQ(c.ranges[0].to, 1);
    EXPECT_LE(c.error, 1e-5);
  }
}

TEST(Crossings, SayByHowMuchTheLossesErrorMovesThem) {
  for (const auto& c : crossings_of([](double r) { return r / 6.3; }, 1e-3))
    EXPECT_NEAR(c.error, 6.3e-3, 1e-5);
}

TEST(Crossings, EndWhereTheLossIsSmallAgain) {
  const auto found = crossings_of([](double r) { return 0.2 * (0.25 - (r - 0.5) * (r - 0.5)); });
  // at most 5 %: above 1 % between 0.5 ± √0.2, and no further
  ASSERT_EQ(found[0].ranges.size(), 1U);
  EXPECT_NEAR(found[0].ranges[0].from, 0.5 - std::sqrt(0.2), 1e-5);
  EXPECT_NEAR(found[0].ranges[0].to, 0.5 + std::sqrt(0.2), 1e-5);
  EXPECT_TRUE(found[2].ranges.empty());
}

TEST(Crossings, OfALossThatIsThereFromTheStartBeginAtTheLeastRoughness) {
  for (const auto& c : crossings_of([](double) { return 0.5; })) {
    ASSERT_EQ(c.ranges.size(), 1U);
    EXPECT_EQ(c.ranges[0].from, 0.05);
    EXPECT_EQ(c.ranges[0].to, 1);
  }
}

TEST(EnergyReport, CrossingsOfGgxAreThoseOfItsOneIntegral) {
  auto o = few;
  o.roughness = {0.05, 0.2, 0.4, 0.6, 0.8, 1};
  o.forms = {correlated};
  const auto f = energy_forms(o, unwatched)[0];
  std::size_t compared = 0;
  for (const auto& c : f.crossings) {
    const auto loss = [&](double r) {
      return 1 - (c.mu == 0 ? ggx_average_albedo(r * r) : ggx_albedo(r * r, c.mu)).value;
    };
    if (c.ranges.empty() || c.ranges[0].from == 0.05) continue;
    EXPECT_NEAR(c.ranges[0].from,
                bisected([&](double r) { return r < 0.05 ? 0 : loss(r); }, c.share), c.error + 1e-9)
        << c.mu << ", " << c.share;
    EXPECT_LT(c.error, 1e-4);
    if (c.mu == 0.1 && c.share == 0.1) {
      EXPECT_NEAR(c.ranges[0].from, 0.243, 5e-4);
    }
    ++compared;
  }
  EXPECT_GT(compared, 8U);
}

TEST(EnergyReport, CrossingsOfMaterialsAreThoseOfTheDeterministicSolution) {
  GONIO_MANY_FITS();
  EnergyOptions o{false, {0.5, 0.6, 0.7, 0.8, 0.9}, {1}, 0};
  o.gold = false;
  const auto all = energy_materials(o, unwatched);
  const auto& half = *std::ranges::find(all, "F0 = 0.5", &EnergyMaterial::name);
  std::size_t compared = 0;
  for (const auto& c : half.crossings) {
    if (c.ranges.empty() || c.ranges[0].from == 0.5) continue;
    const double r = c.ranges[0].from;
    const auto truth = half_space(
        bind_model("ggx/smith_ggx.correlated/schlick", {{"alpha", {r * r}}, {"f0", {0.5}}}, 1),
        {{1}}, 1e-5);
    const auto& s = c.mu == 0 ? truth.average : truth.at[0];
    // A loss rises by less than 1 where roughness does.
    EXPECT_NEAR(1 - s.order[0][0] / s.albedo[0], c.share, c.error + 1e-5) << c.mu;
    EXPECT_LT(c.error, 2e-3);
    ++compared;
  }
  EXPECT_GT(compared, 0U);
}

TEST(EnergyReport, ItsCrossingsAreThoseOfItsRows) {
  const auto r = of_forms({"masking.schlick_ggx.direct", none});
  // at mu = 0.1: Schlick with k for direct light loses at once, no masking never
  for (const auto& c : form(r, "masking.schlick_ggx.direct").crossings)
    EXPECT_TRUE(c.mu != 0.1 || c.ranges.at(0).from == 0.3);
  for (const auto& c : form(r, none).crossings) EXPECT_TRUE(c.mu != 0.1 || c.ranges.empty());
}

TEST(EnergyReport, TheCoatIsMeasuredAsItShips) {
  const std::string coat = "masking.disney_coat, gamma 1";
  const auto r = of_forms({coat});
  const auto& f = form(r, coat);
  EXPECT_EQ(f.ndf, "ndf.gtr");
  for (const auto& at : f.rows) EXPECT_LE(at.roughness, std::sqrt(0.1));
  EXPECT_EQ(f.rows.size(), 3U);  // of the three roughnesses 0.3 alone
}

TEST(EnergyReport, ErrorsOfCompensationsAreComparedOnTheSameMaterials) {
  GONIO_MANY_FITS();
  for (const auto& c : compensation_costs(materials())) {
    EXPECT_EQ(std::isnan(c.gold_rms), c.id == "fdez_aguera") << c.id;
    EXPECT_EQ(c.worst_at.find("gold"), c.worst_at.npos) << c.id;
    EXPECT_GE(std::abs(c.worst), c.rms);
  }
}

TEST(EnergyReport, CompensationsHaveOneTimeInEveryReportOfARun) {
  GONIO_MANY_FITS();
  const auto once = compensation_costs(materials()), again = compensation_costs(materials());
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(once[i].ns, again[i].ns) << once[i].id;
    EXPECT_EQ(once[i].without_ns, again[i].without_ns) << once[i].id;
  }
}

TEST(EnergyReport, ErrorsOfCompensationsDoNotDependOnWhatElseWasLookedAt) {
  GONIO_MANY_FITS();
  EnergyOptions o{false, {0.5, 1}, {0.5, 1}, 0};
  o.gold = false;
  const auto less = compensation_errors(energy_materials(o, unwatched));
  o.roughness = {0.45, 0.5, 0.55, 1};
  o.mu = {0.01, 0.5, 0.55, 1};
  const auto more = compensation_errors(energy_materials(o, unwatched));
  for (std::size_t i = 0; i < less.size(); ++i) {
    EXPECT_NEAR(less[i].rms, more[i].rms, 1e-5) << less[i].id;
    EXPECT_NEAR(less[i].worst, more[i].worst, 1e-5) << less[i].id;
  }
}

TEST(EnergyReport, ErrorsOfCompensationsAreThoseOfTheTablesThatAShaderReads) {
  GONIO_MANY_FITS();
  const auto errors = compensation_errors(materials());
  const auto rms = [&](std::string_view id) {
    return std::ranges::find(errors, id, &CompensationError::id)->rms;
  };
  // Errors with E itself, over the same places.
  std::map<std::string_view, std::pair<double, double>> exact;
  for (const auto& m : materials())
    for (const auto& at : m.rows)
      for (const auto& s : at.scattering)
        if (m.f0 && at.mu > 0) {
          exact[s.id].first += (s.albedo - at.truth) * (s.albedo - at.truth);
          exact[s.id].second += 1;
        }
  for (const std::string_view id : {"single", "kulla_conty", "turquin", "fdez_aguera"}) {
    const double without = std::sqrt(exact[id].first / exact[id].second);
    EXPECT_NEAR(rms(id), without, id == "single" ? 1e-12 : 0.004) << id;
    if (id != "single") {
      EXPECT_NE(rms(id), without) << id;
    }
  }
}

TEST(EnergyReport, GoldIsSeenByItsSpectrum) {
  // Smooth gold at normal incidence reflects what its spectrum does, in linear sRGB.
  const auto seen = reflectance_rgb(*find_metal("Au"), 1);
  EnergyOptions o{false, {0.1}, {1}, 0};
  std::size_t c = 0;
  for (const auto& m : energy_materials(o, unwatched))
    if (m.name.starts_with("gold")) {
      EXPECT_NEAR(m.rows[0].truth, seen[c++], 6e-3) << m.name;
    }
  EXPECT_EQ(c, 3U);
}

TEST(EnergyReport, TheFitOfEIsNearerThanMaterialX) {
  const auto forms = albedo_form_errors();
  ASSERT_EQ(forms.size(), 3U);
  EXPECT_LT(std::abs(forms[0].worst), 0.005);
  EXPECT_GT(std::abs(forms[1].worst), 0.05);
  EXPECT_LT(forms[0].rms, forms[1].rms / 4);
}

TEST(EnergyReport, WhiteGivesAllBackAndTheOrdersSumToTheTruth) {
  for (const auto& at : material("F = 1").rows) EXPECT_NEAR(at.truth, 1, at.error + 1e-12);
  for (const auto& m : materials())
    for (const auto& at : m.rows) {
      double sum = 0;
      for (const double e : at.orders) sum += e;
      EXPECT_NEAR(sum, at.truth, 1e-12) << m.name;
      EXPECT_LE(at.error, 1e-5);
    }
}

TEST(EnergyReport, CompensationsOfRoughMetalsAreNearerToTheTruthThanNone) {
  for (const auto* name : {"F = 1", "F0 = 0.9", "gold, red"})
    for (const auto& at : material(name).rows) {
      if (at.roughness < 0.5) continue;
      const double off = std::abs(at.scattering[0].albedo - at.truth);
      ASSERT_EQ(at.scattering[0].id, "single");
      for (std::size_t k = 1; k < at.scattering.size(); ++k)
        EXPECT_LT(std::abs(at.scattering[k].albedo - at.truth), off / 3)
            << name << " " << at.scattering[k].id << " " << at.roughness << " " << at.mu;
    }
}

TEST(EnergyReport, KnowsWhatASingleLightShowsFarBetterThanWaysDiffer) {
  auto o = few;
  o.roughness = {0.25, 1};
  o.lit_points = 32;
  const auto rows = single_lights(o, unwatched);
  ASSERT_EQ(rows.size(), 2U * 2 * 3 * 3) << "roughness, light, F0, way";
  const auto of = [&](std::string_view id, double roughness) {
    double most = 0;
    for (const auto& r : rows)
      if (r.id == id && r.roughness == roughness && r.f0 == 0.9) most = std::max(most, r.delta_e);
    return most;
  };
  for (const auto& r : rows) EXPECT_LT(r.error, 0.6) << r.id << " " << r.roughness;
  EXPECT_GT(of("kulla_conty", 0.25), 1.5 * of("single", 0.25));
  EXPECT_LT(of("kulla_conty", 1), of("single", 1) / 5);
}

TEST(EnergyReport, EveryEstimatorComesNearer) {
  std::map<std::string, std::vector<EstimatorPoint>> by_name;
  for (const auto& e : estimator_points(few, unwatched))
    by_name[std::string(e.estimator) + std::to_string(e.roughness)].push_back(e);
  EXPECT_EQ(by_name.size(), 15U);
  for (const auto& [name, points] : by_name) {
    EXPECT_LT(points.back().error, points.front().error / 2 + 1e-13) << name;
    for (const auto& p : points) {
      EXPECT_TRUE(p.bound == 0 || p.error <= p.bound + 1e-13) << name;
      EXPECT_GT(p.ns, 0) << name;
    }
  }
}

TEST(EnergyReport, RowsAreFlatAndHaveTheKeysOfTheContract) {
  const auto r = of_forms({correlated, separable});
  const auto j = nlohmann::json::parse(to_json(report_of(false, r)));
  ASSERT_EQ(j["rows"].size(), 2U * 9U);
  for (const auto& row : j["rows"])
    for (const auto* key :
         {"ndf", "masking", "roughness", "mu", "albedo", "loss", "average", "error"})
      EXPECT_TRUE(row.contains(key)) << key;
  const auto& row = j["rows"][0];
  EXPECT_NEAR(row["albedo"].get<double>() + row["loss"].get<double>(), 1, 1e-5);
}

TEST(EnergyReport, FindingsAreMadeFromTheFigures) {
  const auto all = findings(of_forms({correlated, separable, none})).sentences;
  const auto said = [&](std::string_view words) {
    return std::ranges::any_of(all, [&](const std::string& f) { return f.find(words) != f.npos; });
  };
  EXPECT_TRUE(said("69.3\u00a0% at normal incidence and 59.1\u00a0% on average"));
  EXPECT_TRUE(
      said("Worst: GGX without masking reflects 5 times the light that arrives, at roughness 1, "
           "cosine 0.1."));
}

TEST(EnergyReport, CountsAFormOnceWhoseTailWasVaried) {
  auto r = of_forms({correlated, none});
  for (const auto* tail : {"none, gamma 1", "none, gamma 3"}) {
    r.forms.push_back(form(r, none));
    r.forms.back().name = tail;
  }
  const auto all = findings(r).claims;
  const auto at = std::ranges::find(all, "reflected energy never exceeds incoming", &Claim::claim);
  ASSERT_NE(at, all.end());
  EXPECT_EQ(at->figure, "1 of 2 maskings and whole models reflect more");
  EXPECT_EQ(at->verdict.find("shipped"), std::string::npos) << "some are shipped by no one";
}

TEST(EnergyReport, RanksCompensationsUnderASingleLightByWhatTheyLeaveWhereTheyPay) {
  EnergyRows r;
  const std::map<std::string_view, std::vector<double>> delta{
      {"single", {7.4, 6.9, 29}}, {"kulla_conty", {13.6, 5.9, 2.9}}, {"turquin", {5.3, 5.8, 11.2}}};
  const std::vector roughness{0.25, 0.45, 1.0};
  for (const auto& [id, rows] : delta)
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (const auto* light : {"front light", "rim light"})
        r.single_lights.push_back({id, light, 0.9, roughness[i],
                                   light[0] == 'f'     ? rows[i]
                                   : id == "turquin"   ? 2.5
                                   : roughness[i] < .4 ? 3
                                                       : 2,
                                   0, 0});
  for (const auto& [id, rms, worst] :
       {std::tuple("kulla_conty", 0.0102, 0.039), {"turquin", 0.0081, 0.058}}) {
    CompensationCost c{};
    c.id = id;
    c.rms = rms, c.worst = worst;
    r.compensations.push_back(c);
  }
  const auto said = [&](std::string_view sentence) {
    const auto all = findings(r).sentences;
    return std::ranges::find(all, sentence) != all.end();
  };
  EXPECT_TRUE(
      said("Under the worse of a front and a rim light, white metal of F0 = 0.9 with Kulla and "
           "Conty is nearer to all bounces than with nothing, by more than twice the walks' error, "
           "from roughness 0.45 on."));
  EXPECT_TRUE(said("There it leaves ΔE2000 5.9 at most, where one bounce leaves up to 29."))
      << "not the 13.6 of a roughness where it is further off";
  EXPECT_TRUE(said("There it leaves ΔE2000 12 at most, where one bounce leaves up to 29."))
      << "11.2 rounded up";
  EXPECT_TRUE(said(
      "Where they pay, Kulla and Conty leaves less at most. Over albedos, which are light from "
      "all sides, Turquin's RMS error is smaller, but Kulla and Conty's largest error is."));
  EXPECT_TRUE(
      said("Under the rim light by itself Turquin is farther than nothing at roughness "
           "0.45 to 1."));
  r.compensations[0].worst = 0.06;
  EXPECT_TRUE(said(
      "Where they pay, Kulla and Conty leaves less at most. Over albedos, which are light from "
      "all sides, Turquin's RMS error is smaller."));
  r.compensations[0].rms = 0.001;
  EXPECT_TRUE(said("Where they pay, Kulla and Conty leaves less at most, as by albedos."));
}

TEST(EnergyReport, PicturesShowWhatWasMeasured) {
  auto r = of_forms({correlated, separable, none});
  r.materials = materials();
  const auto p = pictures(r);
  test::expect_whole(p);
  const auto map = std::ranges::find(p.maps, "loss_masking_none", &FigureMap::id);
  ASSERT_NE(map, p.maps.end());
  const auto& at = form(r, none).rows[1 * 3 + 2];  // the second roughness, the third mu
  EXPECT_EQ(map->values[1 * 3 + 2], 100 * (1 - at.albedo));
  EXPECT_EQ(map->x.at[1], at.roughness);
  EXPECT_EQ(map->y.at[2], at.mu);
}

TEST(EnergyReport, JudgesWhatIsSaidOfHighlightsByClosedForms) {
  EnergyRows r;
  r.claims = claim_rows({});
  const auto claims = findings(r).claims;
  const auto verdict = [&](std::string_view claim) {
    const auto it = std::ranges::find(claims, claim, &Claim::claim);
    return it == claims.end() ? std::string() : sentence(*it);
  };
  // σ² = ½ (ln(1 + T²) − T²/(1 + T²)) α² of GGX's slopes up to T α
  const auto deviation = [](double t) {
    return fmt::format("{:.3g} α", std::sqrt((std::log1p(t * t) - t * t / (1 + t * t)) / 2));
  };
  const auto slopes = verdict("alpha is the standard deviation of the slopes");
  for (const auto& words : {std::string("does not hold"), std::string("0.71 α"), deviation(1000)})
    EXPECT_NE(slopes.find(words), slopes.npos) << words << ": " << slopes;
  const auto clamp = verdict("the mobile form's clamp of D at 2048 hardly shows");
  EXPECT_NE(clamp.find("acts below roughness 0.149"), clamp.npos) << clamp;
  EXPECT_NE(verdict("dωₕ = dωₗ/(4 VoH)").find("” holds."), std::string::npos);
}

TEST(EnergyReport, JudgesWhatIsSaidOfEnergyByItsForms) {
  auto r = of_forms({correlated, none, "masking.disney_coat, gamma 1",
                     "masking.smith_gtr.correlated, gamma 1", "model.ue_mobile_simple"});
  r.claims = claim_rows(r.forms);
  const auto judged = [&](std::string_view claim) {
    const auto claims = findings(r).claims;
    const auto it = std::ranges::find(claims, claim, &Claim::claim);
    EXPECT_NE(it, claims.end()) << claim;
    return it == claims.end() ? Claim::Judged::holds : it->judged;
  };
  EXPECT_EQ(judged("reflected energy never exceeds incoming"), Claim::Judged::partly);
  EXPECT_EQ(judged("as roughness grows the highlight widens and dims so that energy stays"),
            Claim::Judged::fails);
  EXPECT_EQ(judged("the simple mobile form keeps the look"), Claim::Judged::fails);
  judged("GGX's G of a fixed roughness 0.25 looks good on the coat");
  for (auto& f : r.forms)
    for (auto& at : f.rows) at.albedo = std::min(at.albedo, 1 + at.error);
  EXPECT_EQ(judged("reflected energy never exceeds incoming"), Claim::Judged::holds);
  const auto all = findings(r).sentences;
  EXPECT_TRUE(std::ranges::any_of(all, [](const std::string& s) {
    return s.find("None of 5 maskings and whole models reflect more") != s.npos;
  })) << "no more than the integral's error";
}

LitError lit(std::string light, double roughness, double nov, double f0, double delta_e) {
  LitError l{};
  l.environment = std::move(light);
  l.roughness = roughness, l.nov = nov, l.f0 = f0, l.delta_e = delta_e;
  return l;
}

TEST(EnergyReport, EverySentenceCanBeReadAloud) {
  GONIO_MANY_FITS();
  auto r = of_forms({correlated, separable, none, "masking.disney_coat, gamma 1",
                     "masking.smith_gtr.correlated, gamma 1", "model.ue_mobile_simple"});
  r.materials = materials();
  r.compensations = compensation_costs(r.materials);
  r.albedo_forms = albedo_form_errors();
  r.claims = claim_rows(r.forms);
  r.light.tables = {{32, "half", 1e-7, 2.4e-4, 0.1, 4e-3, 0.018}};
  r.light.lit = {lit("overcast sky", 0.5, 1, 1, 0.6), lit("clear sky with sun", 0.25, 0.1, 1, 7.3),
                 lit("clear sky with sun", 0.25, 0.1, 0.04, 2.1)};
  r.light.costs = {{"split sum", 61.2, 1}, {"quadrature", 1.7e6, 1e4}};
  const auto said = findings(r);
  test::expect_plain(said);
  EXPECT_GT(said.sentences.size(), 14U);
  EXPECT_GE(said.claims.size(), 7U);
}

// --- Image-based light --------------------------------------------------------------------------

TEST(Skies, HaveTheLightThatTheySay) {
  const auto skies = synthetic_skies();
  ASSERT_EQ(skies.size(), 3U);
  const Direction up{};
  EXPECT_NEAR(luminance(irradiance(even_light(), up)), std::numbers::pi, 1e-3);
  EXPECT_NEAR(exposure_for(even_light()), 0.5, 1e-6);
  EXPECT_NEAR(luminance(irradiance(skies[0].map, up)), std::numbers::pi * 7 / 9, 1e-3);
  // The sun adds four times the sky's light to what faces it.
  const auto sun = direction(50 * degree, 0);
  const double facing = luminance(irradiance(skies[1].map, sun)),
               away = luminance(irradiance(skies[1].map, {-sun.x, 0, sun.z}));
  EXPECT_GT(facing / away, 4);
  // The window's side of the room is brighter than the other.
  EXPECT_GT(luminance(irradiance(skies[2].map, {1, 0, 0})),
            5 * luminance(irradiance(skies[2].map, {-1, 0, 0})));
}

TEST(ImageLight, TheSplitSumIsExactUnderEvenLightAlone) {
  GONIO_MANY_FITS();
  EnergyOptions o = few;
  o.views = 2;
  o.environments = {{"even light", even_light()}};
  const auto light = image_light(o, unwatched);
  double even = 0, other = 0;
  for (const auto& l : light.lit) {
    EXPECT_GE(l.delta_e_max, l.delta_e);
    (l.environment == "even light" ? even : other) =
        std::max(l.environment == "even light" ? even : other, l.delta_e_max);
  }
  EXPECT_LT(even, 0.1);
  EXPECT_GT(other, 2);
  ASSERT_EQ(light.costs.size(), 2U);
  EXPECT_GT(light.costs[1].ns, 100 * light.costs[0].ns);
}

}  // namespace
}  // namespace gonio
