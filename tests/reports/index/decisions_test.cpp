#include "reports/index/decisions.h"

#include <algorithm>
#include <cmath>

#include "reports/index/index_page.h"
#include "reports/plain.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

/// Facts of every report, few of each.
Facts made_facts() {
  Facts f;
  f.setting = Facts::Setting{"a processor", 2, "avx2"};
  for (const auto& [id, ns] :
       std::vector<std::pair<std::string, double>>{{"masking.schlick_ggx.direct", 0.2},
                                                   {"masking.ue_joint", 0.2},
                                                   {"masking.smith_ggx.correlated", 0.6},
                                                   {"fresnel.schlick", 0.1},
                                                   {"fresnel.f82", 0.4},
                                                   {"fresnel.dielectric", 0.7},
                                                   {"fresnel.conductor", 1.0}})
    f.in_cache.push_back({id, ns, 0.01});
  f.masking = {{"masking.schlick_ggx.direct", 0.28},
               {"masking.ue_joint", 0.07},
               {"masking.smith_ggx.correlated", 0}};
  for (const auto& [form, material, delta_e] :
       std::vector<std::tuple<std::string, std::string, double>>{
           {"fresnel.schlick", "gold", 0.9},
           {"fresnel.f82", "gold", 0.8},
           {"fresnel.conductor, three wavelengths", "gold", 0.7},
           {"fresnel.schlick", "brass", 1.6},
           {"fresnel.f82", "brass", 1.2},
           {"fresnel.conductor, three wavelengths", "brass", 0.9},
           {"fresnel.schlick", "iron", 5.7},
           {"fresnel.f82", "iron", 0.4},
           {"fresnel.conductor, three wavelengths", "iron", 0.3},
           {"fresnel.schlick", "IOR 1.5", 3.2},
           {"fresnel.f82", "IOR 1.5", 4}})
    f.fresnel.push_back(
        {form, material.starts_with("IOR") ? "dielectric" : "metal", material, delta_e, 0.1});
  for (const double f0 : {0.9, 0.04})
    for (const bool even : {false, true}) {
      // At roughness 0.2 a compensation under a single light is further off than nothing.
      const double first = even ? 0.1 : 4, most = f0 > 0.5 ? 18 : 1.9;
      f.scattering.push_back(
          {"single", f0, even, {0.2, 0.4, 1}, {0.5, f0 > 0.5 ? 2.5 : 1.7, most}});
      for (const auto& [id, last] :
           {std::pair("turquin", 1.9), {"kulla_conty", 1.5}, {"fdez_aguera", 1.0}})
        if (even == (id == std::string("fdez_aguera")))
          f.scattering.push_back({id, f0, even, {0.2, 0.4, 1}, {first, 0.2, last}});
    }
  f.compensations = {{"kulla_conty", false, 13, 0.1, 2112, 4.1},
                     {"turquin", false, 7.7, 0.1, 2048, 4.1},
                     {"fdez_aguera", true, 1.2, 0.1, 0, 3}};
  f.precision = {{"ndf.ggx", "cross", "half, flushed", 0.02, 0.004},
                 {"ggx/smith_ggx.correlated/schlick", "directions", "half", 0.02, 0.037, 88}};
  for (const auto& [id, ns] :
       std::vector<std::pair<std::string, double>>{{"diffuse.lambert", 0.02},
                                                   {"diffuse.lambert.coupled", 0.1},
                                                   {"diffuse.disney", 0.2},
                                                   {"diffuse.eon", 0.5},
                                                   {"diffuse.hammon", 0.6}})
    f.in_cache.push_back({id, ns, 0.01});
  f.whole = {{"ggx/smith_ggx.correlated/schlick", 0.2, 0.01},
             {"gtr/smith_gtr.correlated/schlick", 1.0, 0.01}};
  f.tails = Facts::Tails{14, 9, 1.4, std::log(1.5), std::log(1.2)};
  f.diffuse = {{"diffuse.lambert", 1, false, 1.91, 14, 9.0},
               {"diffuse.lambert.coupled", 0.95, true, 1.5, {}, 5.0},
               {"diffuse.disney", 1.52, true, 2.1, {}, 6.0},
               {"diffuse.eon", 1.0005, false, 1.9, {}, 8.0},
               {"diffuse.hammon", 0.9, true, 1.0002, {}, 3.5}};
  f.split_sum = Facts::SplitSum{32, 4096, 0.0008, {}, {}};
  return f;
}
const Decision& about(const std::vector<Decision>& all, std::string_view subject) {
  static const Decision none{};
  const auto at =
      std::ranges::find_if(all, [&](const Decision& d) { return d.subject.starts_with(subject); });
  return at == all.end() ? none : *at;
}

TEST(Choose, KeepsTheUsualFormExactlyWhereItsErrorIsSmall) {
  const std::vector<Candidate> all{{"nearer and cheaper", 0.1, 0.5, 0.01}, {"usual", 0.5, 1, 0.01}};
  EXPECT_EQ(choose(all, "usual", 0.5)->form, "usual");
  EXPECT_EQ(choose(all, "usual", 0.3)->form, "nearer and cheaper");
}
TEST(Choose, TakesTheCheapestElseTheNearestOfThoseAsFastElseTheNearestOfAll) {
  const std::vector<Candidate> all{{"a", 0.5, 1, 0.1}, {"b", 0.2, 1.15, 0.1}, {"c", 0.1, 3, 0.1}};
  EXPECT_EQ(choose(all, "usual", 1)->form, "b") << "within both spreads";
  EXPECT_EQ(
      choose(std::vector<Candidate>{{"a", 0.5, 1, 0.001}, {"b", 0.2, 1.05, 0.001}}, "usual", 1)
          ->form,
      "b")
      << "less than a tenth";
  EXPECT_EQ(choose(std::vector<Candidate>{{"a", 0.5, 1, 0.001}, {"b", 0.2, 1.2, 0.001}}, "usual", 1)
                ->form,
            "a");
  EXPECT_EQ(choose(all, "usual", 0.01)->form, "c");
  EXPECT_EQ(choose({}, "usual", 1), nullptr);
}

TEST(Decisions, OfferAsCheaperOnlyWhatEveryProcessFindsCheaper) {
  auto f = made_facts();
  const auto time = [&](std::string_view id) -> Facts::Time& {
    return *std::ranges::find(f.in_cache, id, &Facts::Time::id);
  };
  f.masking.push_back({"masking.smith_ggx.separable", 0.02});
  f.in_cache.push_back({"masking.smith_ggx.separable", 0.52, 0.001});
  EXPECT_NE(about(decisions(f), "Masking").unless.find("Separable Smith"), std::string::npos);
  time("masking.smith_ggx.separable").ns = 0.57;  // less than a tenth is worth no error
  EXPECT_NE(about(decisions(f), "Masking").unless.find("Unreal's joint form"), std::string::npos);
  time("masking.smith_ggx.separable").ns = 0.52;
  for (const auto* id : {"masking.schlick_ggx.direct", "masking.ue_joint",
                         "masking.smith_ggx.correlated", "masking.smith_ggx.separable"})
    time(id).each.assign(3, time(id).ns);
  time("masking.smith_ggx.separable").each[1] = 0.61;  // the median is not its
  EXPECT_NE(about(decisions(f), "Masking").unless.find("Unreal's joint form"), std::string::npos);
  time("masking.smith_ggx.correlated").each.assign(3, 0.2);  // as fast as Schlick's k
  EXPECT_EQ(about(decisions(f), "Masking").cost, "none measured");
}

TEST(Decisions, OfferNoCheaperMaskingThatSavesNothingInAWholeModel) {
  auto f = made_facts();
  f.whole.push_back({"ggx/ue_joint/schlick", 0.15, 0.01});
  EXPECT_EQ(about(decisions(f), "Masking").unless,
            "time is short: then Unreal's joint form, RMS error 0.07 in G₂");
  f.whole.back().ns = 0.19;
  EXPECT_EQ(about(decisions(f), "Masking").unless, "") << "within both spreads";
  f.whole.back().ns = 0.25;
  EXPECT_EQ(about(decisions(f), "Masking").unless, "") << "it costs time there";
}

TEST(Decisions, SayWhatToTakeByTheFactsOfTheRun) {
  const auto all = decisions(made_facts());
  const auto& masking = about(all, "Masking");
  EXPECT_EQ(masking.take, "Height-correlated Smith");
  EXPECT_EQ(masking.take_id, "masking.smith_ggx.correlated");
  EXPECT_EQ(masking.error, "none (Schlick's k: RMS error 0.28 in G₂)");
  EXPECT_EQ(masking.cost, "+0.40 ns");
  EXPECT_EQ(masking.unless, "time is short: then Unreal's joint form, RMS error 0.07 in G₂");
  EXPECT_EQ(about(all, "Fresnel of gold, brass").take, "Schlick");
  EXPECT_EQ(about(all, "Fresnel of gold, brass").unless,
            "it is seen next to a photograph: then exact conductor at three wavelengths for brass "
            "(ΔE ≤ 0.9)");
  EXPECT_EQ(about(all, "Fresnel of other metals (iron)").take, "F82");
  EXPECT_EQ(about(all, "Fresnel of other metals (iron)").error,
            "ΔE ≤ 0.4 (Schlick: ΔE ≤ 5.7 for iron)");
  auto f = made_facts();
  f.fresnel.push_back({"fresnel.schlick", "metal", "chromium", 7, 0.1});
  f.fresnel.push_back({"fresnel.f82", "metal", "chromium", 0.7, 0.1});
  EXPECT_EQ(about(decisions(f), "Fresnel of other metals").error,
            "ΔE ≤ 0.7 (Schlick: ΔE ≤ 7 for chromium)");
  EXPECT_EQ(about(all, "Fresnel of dielectrics (glass)").take, "Exact dielectric");
  const auto& bounces = about(all, "Multiple scattering under single lights");
  EXPECT_EQ(bounces.subject, "Multiple scattering under single lights, F0 0.9 (bright metal)");
  EXPECT_EQ(bounces.take, "Turquin for roughness 0.4 or more, otherwise one bounce");
  EXPECT_EQ(bounces.error, "ΔE ≤ 1.9 (one bounce: ≤ 18)");
  EXPECT_EQ(bounces.unless, "");
  const auto& plastic = about(all, "Multiple scattering under single lights, F0 0.04 (no metal)");
  EXPECT_EQ(plastic.take, "One bounce");
  EXPECT_EQ(plastic.error, "ΔE ≤ 1.9");
  EXPECT_EQ(bounces.cost, "Turquin 12 ns (one bounce: 4.1 ns)");
  EXPECT_EQ(about(all, "Multiple scattering under image-based light").take_id,
            "scattering.fdez_aguera");
  EXPECT_EQ(about(all, "Fresnel of gold, brass").cost, "none (the usual form)");
  const auto& bits = about(all, "Precision: a GGX highlight in half precision");
  EXPECT_EQ(bits.take, "sin² θ_h from |n × h|², α clamped to at least 0.037");
  EXPECT_EQ(bits.unless, "half precision is used for D only: then α clamped to at least 0.004");
}

TEST(Decisions, NameBesideAPhotographNoFormThatShowsThere) {
  auto f = made_facts();
  for (auto& x : f.fresnel)
    if (x.material == "gold") x.delta_e = x.form == "fresnel.schlick" ? 1.4 : 1.3;
  EXPECT_EQ(about(decisions(f), "Fresnel of gold").unless,
            "it is seen next to a photograph: then the full spectrum for gold; exact conductor at "
            "three wavelengths "
            "for brass (ΔE ≤ 0.9)");
}

TEST(Decisions, HaveARowForEachPartOfAMaterial) {
  const auto all = decisions(made_facts());
  const auto& tails = about(all, "Distribution");
  EXPECT_EQ(tails.take_id, "ndf.ggx");
  EXPECT_EQ(tails.error,
            "typically ×/÷ 1.5 off published fits of measured materials (9 of the 14 that "
            "determine gamma have a longer tail)");
  EXPECT_EQ(without_aside(tails.error),
            "typically ×/÷ 1.5 off published fits of measured materials");
  EXPECT_EQ(
      tails.unless,
      "you fit gamma, too (its median is 1.4): then GTR with its own Smith, typically ×/÷ 1.2, "
      "+0.80 ns");
  const auto& matte = about(all, "Diffuse of matte surfaces");
  EXPECT_EQ(matte.take_id, "diffuse.eon");
  EXPECT_EQ(matte.error, "none (Lambert: ΔE ≤ 14)");
  EXPECT_EQ(matte.cost, "+0.48 ns");
  const auto& below = about(all, "Diffuse below a lobe");
  EXPECT_EQ(below.take_id, "diffuse.hammon") << "the only one that makes no light";
  EXPECT_EQ(below.error, "ΔE ≤ 3.5 (Lambert: ΔE ≤ 9)");
  const auto& light = about(all, "Image-based light");
  EXPECT_EQ(light.take, "Split sum, 32 × 32 table in half precision");
  EXPECT_EQ(light.error, "RMS 0.0008 of E");
  EXPECT_EQ(light.cost, "one look-up");
  EXPECT_EQ(light.unless, "");
  auto f = made_facts();
  f.split_sum->head_on = 1.26, f.split_sum->from_side = 9.4, f.split_sum->grazing = 14;
  f.split_sum->ns = 21;
  const auto lit = decisions(f);
  EXPECT_EQ(about(lit, "Image-based light").cost, "21 ns a pixel");
  EXPECT_EQ(about(lit, "Image-based light").error, "mean ΔE 1.3 head on, 9.4 at 60°");
  EXPECT_EQ(about(lit, "Image-based light").unless,
            "the rim matters: then integrate over directions");
}

TEST(Decisions, TakeNoDiffuseTermThatMakesLight) {
  auto f = made_facts();
  f.diffuse[3].most_albedo = 1.01;
  EXPECT_EQ(about(decisions(f), "Diffuse of matte surfaces").take_id, "diffuse.lambert");
  f.diffuse[4].most_with_lobe = 1.6;
  const auto below = about(decisions(f), "Diffuse below a lobe");
  EXPECT_EQ(below.take_id, "diffuse.lambert.coupled")
      << "where all make light, that which makes least";
  EXPECT_EQ(below.error, "ΔE ≤ 5, energy gain ≤ 50\u00a0% (Lambert: ΔE ≤ 9)");
}

TEST(Decisions, ChangeWhereAThresholdIsCrossed) {
  auto f = made_facts();
  f.fresnel[3].delta_e = 2.4;  // Schlick on brass is seen by itself
  auto all = decisions(f);
  EXPECT_EQ(about(all, "Fresnel of gold").subject, "Fresnel of gold");
  EXPECT_EQ(about(all, "Fresnel of other metals").subject, "Fresnel of other metals (brass, iron)");
  f = made_facts();
  for (auto& s : f.scattering)
    if (s.id == "turquin") s.delta_e[2] = 2.4;
  auto bounces = about(decisions(f), "Multiple scattering");
  EXPECT_EQ(bounces.take, "Kulla and Conty for roughness 0.4 or more, otherwise one bounce");
  EXPECT_EQ(
      bounces.unless,
      "time is short: then Turquin for roughness 0.4 or more (ΔE ≤ 2.4), otherwise one bounce");
  for (auto& s : f.scattering)
    if (s.id == "kulla_conty") s.delta_e[1] = 2.6;  // further off than nothing up to there
  bounces = about(decisions(f), "Multiple scattering");
  EXPECT_EQ(bounces.take, "Turquin for roughness 0.4 or more, otherwise one bounce")
      << "nothing leaves 2.5 below 1";
  for (auto& s : f.scattering)
    if (s.id != "single") s.delta_e[2] = 19;
  bounces = about(decisions(f), "Multiple scattering");
  EXPECT_EQ(bounces.take, "One bounce") << "each is further off than nothing";
  EXPECT_EQ(bounces.error, "ΔE ≤ 18");
  f = made_facts();
  f.masking[1].rms = 0.009;
  EXPECT_EQ(about(decisions(f), "Masking").take, "Unreal's joint form");
}

TEST(Decisions, AreLeftOutWhereAFactIsMissing) {
  EXPECT_TRUE(decisions({}).empty());
  auto f = made_facts();
  const auto all = decisions(f).size();
  f.precision[0].safe_from.reset();
  EXPECT_EQ(decisions(f).size(), all - 1);
  f.masking.clear();
  EXPECT_EQ(decisions(f).size(), all - 2);
  f.in_cache.clear();
  EXPECT_EQ(about(decisions(f), "Fresnel").take, "");
  f.scattering.clear();
  f.split_sum.reset();
  f.whole.clear();
  EXPECT_TRUE(decisions(f).empty());
}

TEST(Decisions, HaveAtMostThreeNumbersACell) {
  EXPECT_EQ(test::numbers_in("RMS 0.07 of G₂, F82, k = (r+1)²/8, ΔE ≤ 3"), 2U);
  auto f = made_facts();
  f.split_sum->head_on = 1.26, f.split_sum->from_side = 9.4, f.split_sum->grazing = 14;
  for (const auto& d : decisions(f))
    for (const auto& cell : {d.subject, d.take, d.error, d.cost, d.unless})
      EXPECT_LE(test::numbers_in(cell), 3U) << cell;
}

TEST(DecisionTable, FitsATerminalAndIsAligned) {
  auto all = decisions(made_facts());
  all[0].subject =
      "Fresnel of gold, silver, copper, brass, aluminium, chromium, cobalt, iron, nickel";
  const auto table = decision_table(all, 80);
  EXPECT_LT(table.size(), 2500U);
  std::size_t from = 0, lines = 0;
  for (auto to = table.find('\n'); to != table.npos; from = to + 1, to = table.find('\n', from)) {
    std::size_t width = 0;
    for (const char c : table.substr(from, to - from))
      width += (static_cast<unsigned char>(c) & 0xC0) != 0x80;
    EXPECT_LE(width, 80U) << table.substr(from, to - from);
    ++lines;
  }
  EXPECT_GT(lines, all.size());
  EXPECT_NE(table.find("Exact dielectric"), table.npos) << table;
  EXPECT_EQ(table.find("Schlick's k:"), table.npos) << "asides are the page's";
}

}  // namespace
}  // namespace gonio
