// Rows of the index, recomputed from the rows of the reports that they stand for.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "geometry/direction.h"
#include "reports/cost/cost.h"
#include "reports/cross_fit/cross_fit.h"
#include "reports/diffuse/diffuse.h"
#include "reports/energy/energy.h"
#include "reports/finding/words.h"
#include "reports/index/decisions.h"
#include "reports/schlick/schlick.h"
#include "reports/stability/stability.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace gonio {
namespace {

/// Times of every term that a decision asks for: twice the last one's each, in the order given.
CostRows timed(std::initializer_list<const char*> ids) {
  CostRows r;
  r.machine.instruction_sets = {"avx2"};
  double ns = 0.1;
  for (const char* id : ids) {
    CostRow row{};
    row.id = id;
    row.number = "float";
    row.isa = "avx2";
    row.memory = "cache";
    row.way = std::string_view(id).find('/') == std::string_view::npos ? "" : "composed";
    row.time = {ns, 0.001};
    r.rows.push_back(std::move(row));
    ns *= 2;
  }
  return r;
}
const Decision& of(const std::vector<Decision>& all, std::string_view subject) {
  static const Decision none{};
  const auto at =
      std::ranges::find_if(all, [&](const Decision& d) { return d.subject.starts_with(subject); });
  EXPECT_NE(at, all.end()) << subject;
  return at == all.end() ? none : *at;
}
std::string up_to(double delta_e) {
  return "ΔE " + at_most(delta_e);
}

TEST(IndexRow, OfCompensationsUnderSingleLightsIsThatOfTheirPictures) {
  EnergyRows r;
  // By roughness and light: Kulla and Conty are further off than nothing at 0.25, Turquin under the
  // rim light up to 0.5.
  const std::map<std::string_view, std::vector<std::array<double, 2>>> delta{
      {"single", {{1.4, 0.9}, {4, 3}, {14, 9}}},
      {"kulla_conty", {{10.4, 2}, {3.6, 2}, {2.2, 1.9}}},
      {"turquin", {{3, 2}, {3.5, 4.1}, {5.4, 3.1}}}};
  const std::vector roughness{0.25, 0.5, 1.0};
  for (const double f0 : {0.9, 0.04})
    for (const auto& [id, rows] : delta)
      for (std::size_t i = 0; i < rows.size(); ++i)
        for (std::size_t light = 0; light < 2; ++light)
          r.single_lights.push_back({id, light ? "rim light" : "front light", f0, roughness[i],
                                     rows[i][light] * (f0 < 0.5 ? 0.1 : 1), 0, 0});
  for (const auto* id : {"single", "kulla_conty", "turquin"}) {
    CompensationCost c{};
    c.id = id;
    c.without_ns = 4;
    c.ns = id == std::string("turquin") ? 8 : 17;
    r.compensations.push_back(c);
  }
  const auto row = of(decisions(facts(r)), "Multiple scattering under single lights");
  // Each way from where it is nearer under both lights, and nothing below: the least of the maxima.
  double nothing = 0, kulla = 0, below = 0;
  for (const auto& s : r.single_lights) {
    if (s.f0 != 0.9) continue;
    if (s.id == "single") nothing = std::max(nothing, s.delta_e + s.error);
    if (s.roughness >= 0.5 && s.id == "kulla_conty") kulla = std::max(kulla, s.delta_e + s.error);
    if (s.roughness < 0.5 && s.id == "single") below = std::max(below, s.delta_e + s.error);
  }
  EXPECT_EQ(row.take, "Kulla and Conty for roughness 0.5 or more, otherwise one bounce");
  EXPECT_EQ(row.error,
            fmt::format("{} (one bounce: {})", up_to(std::max(below, kulla)), at_most(nothing)));
  EXPECT_NE(below, kulla);
  EXPECT_EQ(of(decisions(facts(r)), "Multiple scattering under single lights, F0 0.04").error,
            "ΔE ≤ 1.4");
}

TEST(IndexRow, NamesTheFormThatLeavesLessBelowWhereItsOwnBegins) {
  EnergyRows r;
  const std::map<std::string_view, std::vector<double>> delta{
      {"single", {0.5, 7.4, 14}}, {"kulla_conty", {20, 13.6, 2}}, {"turquin", {3, 5.8, 11}}};
  const std::vector roughness{0.1, 0.25, 0.5};
  for (const double f0 : {0.9, 0.04})
    for (const auto& [id, rows] : delta)
      for (std::size_t i = 0; i < rows.size(); ++i)
        r.single_lights.push_back(
            {id, "front light", f0, roughness[i], rows[i] * (f0 < 0.5 ? 0.1 : 1), 0, 0});
  for (const auto* id : {"single", "kulla_conty", "turquin"}) {
    CompensationCost c{};
    c.id = id;
    c.without_ns = 4;
    c.ns = id == std::string("turquin") ? 8 : 17;
    r.compensations.push_back(c);
  }
  const auto row = of(decisions(facts(r)), "Multiple scattering under single lights");
  EXPECT_EQ(
      row.take,
      "Kulla and Conty for roughness 0.5 or more, Turquin for 0.25 to 0.5, otherwise one bounce");
  EXPECT_EQ(row.error, "ΔE ≤ 5.8 (one bounce: ≤ 14)");
  EXPECT_EQ(row.cost, "Kulla and Conty 17 ns, Turquin 8.0 ns (one bounce: 4.0 ns)");
  EXPECT_EQ(
      row.unless,
      "time is short: then Turquin for roughness 0.25 or more (ΔE ≤ 11), otherwise one bounce");
}

TEST(IndexRow, OfDarkMetalHasItsOwnRoughness) {
  EnergyRows r;
  const std::vector roughness{0.25, 0.5, 1.0};
  for (const auto& [f0, single] : std::map<double, std::vector<double>>{
           {0.9, {3, 8, 14}}, {0.5, {1.8, 3, 7}}, {0.04, {0.1, 0.2, 0.3}}})
    for (std::size_t i = 0; i < roughness.size(); ++i) {
      r.single_lights.push_back({"single", "front light", f0, roughness[i], single[i], 0, 0});
      r.single_lights.push_back({"kulla_conty", "front light", f0, roughness[i], 0.1, 0, 0});
    }
  CompensationCost c{};
  c.id = "kulla_conty";
  c.ns = 17, c.without_ns = 4;
  r.compensations = {c};
  const auto all = decisions(facts(r));
  const std::string lights = "Multiple scattering under single lights, ";
  EXPECT_EQ(of(all, lights + "F0 0.9 (bright metal)").take,
            "Kulla and Conty for roughness 0.25 or more, otherwise one bounce");
  EXPECT_EQ(of(all, lights + "F0 0.5 (dark metal)").take,
            "Kulla and Conty for roughness 0.5 or more, otherwise one bounce");
  EXPECT_EQ(of(all, lights + "F0 0.04 (no metal)").error, "ΔE ≤ 0.3")
      << "what one bounce lacks at 0.25 is not seen";
}

TEST(IndexRow, OfPlasticCompensatesNothingThatNobodySees) {
  EnergyRows r;
  const std::map<std::string_view, std::vector<double>> delta{{"single", {2.28, 2.59, 0.79}},
                                                              {"kulla_conty", {2.19, 2.52, 0.44}}};
  const std::vector roughness{0.25, 0.4, 1.0};
  for (const double f0 : {0.9, 0.04})
    for (const auto& [id, rows] : delta)
      for (std::size_t i = 0; i < rows.size(); ++i)
        r.single_lights.push_back({id, "front light", f0, roughness[i],
                                   rows[i] * (f0 > 0.5 && id == "single" ? 9 : 1), 0, 0});
  CompensationCost c{};
  c.id = "kulla_conty";
  c.ns = 17, c.without_ns = 4;
  r.compensations = {c};
  const auto all = decisions(facts(r));
  EXPECT_EQ(of(all, "Multiple scattering under single lights").take_id, "scattering.kulla_conty");
  const auto row = of(all, "Multiple scattering under single lights, F0 0.04");
  EXPECT_EQ(row.take, "One bounce");
  EXPECT_EQ(row.error, "ΔE ≤ 2.6") << "2.5 with a compensation: nobody sees that";
}

TEST(IndexRow, OfTheSplitSumSaysWhatMostOfASphereShows) {
  EnergyRows r;
  TableError t{};
  t.size = 32, t.stored = "half", t.lookup_rms = 0.005;
  r.light.tables = {t};
  for (const auto& [nov, delta_e] : std::vector<std::pair<double, double>>{
           {1, 2.412}, {1, 0.6}, {0.5, 4.2}, {0.5, 23.29}, {0.1, 33.5}}) {
    LitError l{};
    l.environment = "room with a window", l.nov = nov, l.f0 = 1, l.delta_e = delta_e;
    r.light.lit.push_back(l);
  }
  const auto row = of(decisions(facts(r)), "Image-based light");
  EXPECT_EQ(row.error, "mean ΔE 2.5 head on, 24 at 60°");
  EXPECT_EQ(row.unless, "the rim matters: then integrate over directions");
}

TEST(IndexRow, OfImageBasedLightIsThatOfAlbedos) {
  EnergyRows r;
  for (const double f0 : {0.9, 0.04}) {
    EnergyMaterial m{};
    m.f0 = f0;
    for (const double roughness : {0.5, 1.0})
      m.rows.push_back({roughness,
                        0.5,
                        f0,
                        0,
                        {},
                        {{"single", f0 * (1 - roughness / 2)}, {"fdez_aguera", f0 * 0.99}}});
    r.materials.push_back(m);
  }
  CompensationCost c{};
  c.id = "fdez_aguera";
  c.ns = 4, c.without_ns = 3;
  r.compensations = {c};
  const auto all = facts(r);
  const auto row = of(decisions(all), "Multiple scattering under image-based light");
  double most = 0;
  for (const auto& s : all.scattering)
    if (s.id == "fdez_aguera" && s.f0 == 0.9) most = std::ranges::max(s.delta_e);
  EXPECT_EQ(row.take_id, "scattering.fdez_aguera");
  EXPECT_TRUE(row.error.starts_with(up_to(most))) << row.error;
}

TEST(IndexRow, OfDiffuseFormsIsThatOfTheirColoursAndOfWhatTheyReflectBesideALobe) {
  DiffuseRows r;
  const auto form = [&](const char* id, bool with_interface, double own, double with_lobe) {
    DiffuseForm f{};
    f.id = id;
    f.with_interface = with_interface;
    f.most_albedo = own;
    f.most_with_lobe = with_lobe;
    r.forms.push_back(f);
  };
  form("diffuse.lambert", false, 1, 1.91);
  form("diffuse.lambert.coupled", true, 0.98, 1.4);
  form("diffuse.disney", true, 1.5, 2.2);
  form("diffuse.eon", false, 1, 1.9);
  const auto colour = [&](const char* id, const char* surface, std::initializer_list<double> all) {
    for (const double x : all)
      r.colours.push_back({id, surface, "chalk", "rim light", 1, x, x / 3, 1});
  };
  colour("diffuse.lambert", "matte", {3, 14, 6});
  colour("diffuse.lambert", "plastic", {9, 2});
  colour("diffuse.lambert.coupled", "plastic", {4, 5.2});
  colour("diffuse.disney", "plastic", {1, 0.5});
  colour("diffuse.eon", "plastic", {8});
  auto all = facts(r);
  join(all, facts(timed(
                {"diffuse.lambert", "diffuse.lambert.coupled", "diffuse.eon", "diffuse.disney"})));
  const auto rows = decisions(all);
  const auto& matte = of(rows, "Diffuse of matte surfaces");
  EXPECT_EQ(matte.take_id, "diffuse.eon");
  EXPECT_EQ(matte.error, "none (Lambert: ΔE ≤ 14)") << "the maximum, no quantile";
  const auto& below = of(rows, "Diffuse below a lobe");
  EXPECT_EQ(below.take_id, "diffuse.lambert.coupled")
      << "Disney's is nearer, and makes more light than any";
  EXPECT_EQ(below.error, up_to(5.2) + ", energy gain ≤ 40\u00a0% (Lambert: ΔE ≤ 9)");
}

TEST(IndexRow, OfDistributionsIsThatOfMeasuredMaterials) {
  CrossFitRows r;
  for (int i = 0; i < 20; ++i) {
    PublishedFit p{};
    p.tail = i < 17 ? 1 + 0.01 * i : 2.1;
    p.gamma = 1.2 + 0.02 * i;
    p.gamma_determined = i >= 10;  // of these the median is another
    p.ggx_log_rms = 0.3 + 0.01 * i;
    p.gtr_log_rms = 0.1 + 0.005 * i;
    r.published.push_back(p);
  }
  auto all = facts(r);
  join(all, facts(timed({"ggx/smith_ggx.correlated/schlick", "gtr/smith_gtr.correlated/schlick"})));
  const auto row = of(decisions(all), "Distribution");
  EXPECT_EQ(row.error, fmt::format("typically ×/÷ {:.3g} off published fits of measured materials "
                                   "(10 of the 10 that determine gamma have a longer tail)",
                                   std::exp(0.395)));  // between the tenth and the eleventh
  EXPECT_EQ(
      row.unless,
      fmt::format("you fit gamma, too (its median is 1.5): then GTR with its own Smith, typically "
                  "×/÷ {:.3g}, +0.10 ns",
                  std::exp(0.1475)))
      << "the error and the time of one model";
  EXPECT_FALSE(facts(CrossFitRows{}).tails);
}

TEST(IndexRow, OfPrecisionIsThatOfTheWholeHighlight) {
  StabilityRows r;
  StabilityRow d{};
  d.id = "ndf.ggx", d.form = "cross", d.number = "half, flushed", d.decides = "alpha",
  d.tolerance = 0.02;
  d.safe_from = 0.0039;
  r.rows = {d};
  r.highlights = {{"ggx/smith_ggx.correlated/schlick", "half", 88, 0.5, 0.022, 0.0371, 0.0315}};
  const auto row = of(decisions(facts(r)), "Precision");
  EXPECT_EQ(row.take, "sin² θ_h from |n × h|², α clamped to at least 0.038")
      << "at 0.037 it is not kept";
  EXPECT_EQ(row.error,
            "off by ≤ 2.2\u00a0%; surfaces smoother than roughness 0.2 look too rough (found by a "
            "search over angles up to 88°, with cosines in half precision)");
  r.highlights[0].safe_from.reset();
  EXPECT_EQ(of(decisions(facts(r)), "Precision").take, "float instead");
}

TEST(IndexRow, OfFresnelIsTheGreatestDifferenceOfEveryRoughnessAndView) {
  SchlickRows r;
  for (const auto& [material, mu, delta] :
       std::vector<std::tuple<std::string, double, std::vector<double>>>{
           {"gold", 1, {0.1, 0.3}}, {"gold", 0.1, {1.2, 1.7}}, {"gold", 0.5, {0.4}}}) {
    FresnelColour c{};
    c.form = "fresnel.schlick";
    c.material = material;
    c.mu = mu;
    c.delta_e = delta;
    r.rough.colours.push_back(c);
  }
  auto all = facts(r);
  join(all, facts(timed({"fresnel.schlick"})));
  EXPECT_EQ(of(decisions(all), "Fresnel of metals (gold)").error, up_to(1.7));
}

/// The highlight on metal in half: below what the report finds, a mirror direction has no value.
TEST(HighlightRows, EndWhereTheProductIsTooLarge) {
  const auto rows = highlight_rows();
  ASSERT_EQ(rows.size(), 2U);
  for (const auto& row : rows) {
    ASSERT_TRUE(row.finite_from && row.safe_from) << row.number;
    // D V F of a mirror is 1/(4 π α² NoL²) at most, which is 65504 here.
    const double cosine = std::cos(row.zenith_deg * degree);
    const double least = 1 / (cosine * std::sqrt(4 * std::numbers::pi * 65504));
    EXPECT_GT(*row.finite_from, 0.8 * least) << row.number;
    EXPECT_LT(*row.finite_from, 1.5 * least) << row.number;
    EXPECT_GE(*row.safe_from, *row.finite_from);
    EXPECT_LT(*row.safe_from, 0.5) << "else there is nothing to clamp at";
  }
}

}  // namespace
}  // namespace gonio
