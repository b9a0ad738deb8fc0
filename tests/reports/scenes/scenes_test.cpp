#include "reports/scenes/scenes.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <set>

#include "base/base64.h"
#include "many_fits.h"
#include "reports/page/render.h"
#include "reports/pictures.h"
#include "reports/plain.h"
#include "reports/scenes/cases.h"
#include "reports/scenes/measure.h"
#include "scene/surface/surface.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

/// Two materials under two lights, compared by operations: no time has a say.
ScenesOptions few() {
  ScenesOptions o;
  o.materials = {"red plastic", "everything needed"};
  o.lights = {"front light", "rim light"};
  o.plan.cost = scene::Cost::operations;
  o.plan.samples = 1024;
  o.plan.fresh = 16'384;
  o.pixels = 24;
  o.picture_samples = 9;
  o.map_angle_deg = {0, 105};
  o.map_roughness = {0.25, 0.6};
  o.map_samples = 512;
  return o;
}
const ScenesReport& report() {
  static const auto made = scenes_report(few());
  return made;
}
const SceneRow& row(std::string_view material, std::string_view light) {
  return *std::ranges::find_if(report().rows.rows, [&](const SceneRow& r) {
    return r.material == material && r.light == light;
  });
}
const SceneEffectRow& effect(std::string_view material,
                             std::string_view light,
                             std::string_view name) {
  return *std::ranges::find_if(report().rows.effects, [&](const SceneEffectRow& e) {
    return e.material == material && e.light == light && e.effect == name;
  });
}

TEST(ScenesReport, HasFiguresWithinTheirRanges) {
  GONIO_MANY_FITS();
  ASSERT_EQ(report().rows.rows.size(), 4U);
  for (const auto& r : report().rows.rows) {
    EXPECT_TRUE(r.holds) << r.material << r.light;
    EXPECT_LE(r.upper_bound, 0.01);
    EXPECT_GT(r.upper_bound, 0);
    EXPECT_EQ(r.samples, scene::verified_samples);
    EXPECT_LE(r.exceeding, 0.01 * static_cast<double>(r.samples));
    EXPECT_LT(r.ops_saved, 1);
    EXPECT_LE(r.error_quantile, r.error_upper);
    EXPECT_LE(r.worst, 4);
    for (const double ns : {r.ns, r.ns_exact, r.ns_exact_float, r.ns_present_float, r.ns_float})
      EXPECT_GT(ns, 0);
    EXPECT_DOUBLE_EQ(r.speedup, r.ns_exact / r.ns);
    EXPECT_DOUBLE_EQ(r.speedup_float, r.ns_present_float / r.ns_float)
        << "what the material has not is no saving";
    EXPECT_GT(r.ns_exact, r.ns_exact_float) << "double is no faster than float";
  }
}

TEST(ScenesReport, NeedsExactFresnelUnderARimLightAlone) {
  GONIO_MANY_FITS();
  const auto &front = effect("red plastic", "front light", "fresnel"),
             &rim = effect("red plastic", "rim light", "fresnel");
  EXPECT_FALSE(front.keep);
  EXPECT_LT(front.error_if_dropped, 1);
  EXPECT_EQ(front.keeps, "");
  EXPECT_TRUE(rim.keep);
  EXPECT_GT(rim.error_if_dropped, 2);
  EXPECT_EQ(rim.form, "exact");
  EXPECT_EQ(rim.keeps, "exact Fresnel");
  EXPECT_NE(row("red plastic", "rim light").kept.find("exact Fresnel"), std::string::npos);
  EXPECT_NE(row("red plastic", "front light").dropped.find("exact Fresnel"), std::string::npos);
  EXPECT_GT(row("red plastic", "front light").ops_saved, row("red plastic", "rim light").ops_saved);
}

TEST(ScenesReport, EverythingNeededKeepsNearlyEverything) {
  GONIO_MANY_FITS();
  for (const char* light : {"front light", "rim light"})
    for (const char* name :
         {"compensation", "masking", "anisotropy", "coat", "diffuse", "coupling"})
      EXPECT_TRUE(effect("everything needed", light, name).keep) << light << ": " << name;
  EXPECT_TRUE(effect("everything needed", "rim light", "fresnel").keep);
  EXPECT_EQ(row("everything needed", "rim light").absent, "tail, spectrum, environment");
}

TEST(ScenesReport, TellsEachEffectOnceAndInOneOfThreeLists) {
  GONIO_MANY_FITS();
  const auto listed = [](const std::string& list) {
    return list.empty() ? std::size_t{0}
                        : static_cast<std::size_t>(std::ranges::count(list, ',')) + 1;
  };
  for (const auto& r : report().rows.rows)
    EXPECT_EQ(listed(r.kept) + listed(r.dropped) + listed(r.absent), scene::effect_count)
        << r.material << r.light;
  std::set<std::tuple<std::string, std::string, std::string>> told;
  for (const auto& e : report().rows.effects)
    EXPECT_TRUE(told.emplace(e.material, e.light, e.effect).second);
  EXPECT_EQ(told.size(), 4 * scene::effect_count);
}

TEST(ScenesReport, IsTheSameAgainWhereNoTimeIsTold) {
  GONIO_MANY_FITS();
  auto o = few();
  o.materials = {"red plastic"};
  o.lights = {"rim light"};
  o.map_angle_deg.clear();
  const auto again = scenes_rows(o);
  ASSERT_EQ(again.rows.size(), 1U);
  const auto& first = row("red plastic", "rim light");
  EXPECT_EQ(again.rows[0].spec, first.spec);
  EXPECT_EQ(again.rows[0].kept, first.kept);
  EXPECT_EQ(again.rows[0].ops_saved, first.ops_saved);
  EXPECT_EQ(again.rows[0].exceeding, first.exceeding);
  EXPECT_EQ(again.rows[0].error_upper, first.error_upper);
  const auto picture = std::ranges::find_if(report().rows.pictures, [](const ScenePicture& p) {
    return p.material == "red plastic" && p.light == "rim light";
  });
  EXPECT_EQ(again.pictures[0].everything, picture->everything);
  EXPECT_EQ(again.pictures[0].difference, picture->difference);
}

TEST(ScenesReport, ShowsASphereAndWhereThePlanDiffers) {
  GONIO_MANY_FITS();
  ASSERT_EQ(report().rows.pictures.size(), 4U);
  for (const auto& p : report().rows.pictures) {
    for (const auto& png : {from_base64(p.everything), from_base64(p.planned)})
      EXPECT_EQ(png.substr(1, 3), "PNG");
    const auto apart = from_base64(p.difference);
    const std::size_t n = p.pixels;
    ASSERT_EQ(apart.size(), n * n);
    const auto byte = [&](const std::string& s, std::size_t i) {
      return static_cast<unsigned char>(s[i]);
    };
    EXPECT_EQ(byte(apart, 0), 255) << "no sphere in the corner";
    EXPECT_LT(byte(apart, n / 2 * n + n / 2), 255);
    const auto disc = static_cast<double>(
        std::ranges::count_if(apart, [](char c) { return static_cast<unsigned char>(c) != 255; }));
    EXPECT_NEAR(disc / static_cast<double>(n * n), 0.71, 0.04) << "a sphere seen at 10 radii";
    double most = 0;
    for (std::size_t i = 0; i < apart.size(); ++i)
      if (byte(apart, i) != 255) most = std::max(most, byte(apart, i) / 50.0);
    EXPECT_NEAR(most, p.worst, 0.011);
    if (p.material == "red plastic") {  // of which a plan leaves out what is just seen
      EXPECT_GT(p.worst, 0.1) << p.light;
      EXPECT_NE(p.everything, p.planned);
    }
    EXPECT_LE(p.worst, 4);
  }
}

TEST(ScenesReport, PicturesAreWhole) {
  GONIO_MANY_FITS();
  test::expect_whole(report().pictures);
  EXPECT_EQ(report().pictures.figures.size(), 4U);
  EXPECT_EQ(report().pictures.maps.size(), 3U) << "of red plastic";
  auto turned = report().rows;
  std::ranges::reverse(turned.rows);
  const auto all = pictures(turned).figures;
  for (const auto& f : all)
    EXPECT_LE(f.curves[1].x.size(), all[0].curves[1].x.size()) << "the first has most to see";
  for (const auto& m : report().pictures.maps) EXPECT_EQ(m.line, 1);
}

TEST(ScenesReport, MapsSwitchFresnelOnBehindTheViewer) {
  GONIO_MANY_FITS();
  const auto& m = report().rows.maps.at(0);
  EXPECT_EQ(m.effect, "fresnel");
  EXPECT_NEAR(m.own_roughness, 0.25, 1e-12);
  EXPECT_LT(m.error.at(0), 1) << "light from where one looks";
  EXPECT_GT(m.error.at(2), 1) << "light from the side";
}

TEST(ScenesCases, AreScenesThatHaveTheirEffects) {
  EXPECT_EQ(scenes::material_names().size(), 6U);
  EXPECT_EQ(scenes::light_names().size(), 3U);
  for (const auto& name : scenes::material_names()) {
    const auto s = scenes::scene_of(scenes::material_of(name), "front light");
    const scene::Look look(s.materials.at(0));
    const auto absent = [&](scene::Effect e) {
      const auto& offer = look.offer(e);
      return offer.same_as_exact == offer.forms.front();
    };
    EXPECT_EQ(absent(scene::Effect::coat), name != "car paint" && name != "everything needed")
        << name;
    EXPECT_EQ(absent(scene::Effect::anisotropy),
              name != "brushed aluminium" && name != "everything needed")
        << name;
    EXPECT_EQ(absent(scene::Effect::fresnel), false) << name;
  }
  EXPECT_NEAR(scenes::roughness_of("satin gold"), 0.45, 1e-12);
}

TEST(ScenesAsset, IsPlannedWithoutWhatHasTextures) {
  GONIO_MANY_FITS();
  const std::string path = ::testing::TempDir() + "gonio_asset.gltf";
  std::ofstream(path) << R"({"asset": {"version": "2.0"}, "textures": [{}], "materials": [
    {"name": "plain", "pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0.4}},
    {"name": "drawn", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]})";
  auto o = few();
  o.materials.clear();
  o.lights = {"front light"};
  o.asset = path;
  const auto r = scenes_rows(o);
  ASSERT_EQ(r.rows.size(), 1U);
  EXPECT_EQ(r.rows[0].material, "plain");
  EXPECT_TRUE(r.rows[0].holds);
  ASSERT_EQ(r.left_out.size(), 1U);
  EXPECT_EQ(r.left_out[0].material, "drawn");
  EXPECT_NE(r.left_out[0].why.find("texture"), std::string::npos);
  EXPECT_EQ(r.left_out[0].why.find(path), std::string::npos) << "it is known which file";
  const auto said = findings(r).sentences;
  EXPECT_NE(std::ranges::find(said,
                              "In the asset, one material with textures, or otherwise no single "
                              "surface, is left out; the page names it at its end."),
            said.end());
}

TEST(ScenesNames, AreOneForEachForm) {
  std::set<std::string> names;
  constexpr std::size_t forms = names_of<scene::Form>.size();
  for (std::size_t f = 0; f < forms; ++f)
    names.insert(scenes::name_of_form(static_cast<scene::Form>(f)));
  EXPECT_EQ(names.size(), forms);
}

// --- Sentences -----------------------------------------------------------------------------------

SceneRow made_row(std::string material, std::string light, double ns_float) {
  SceneRow r;
  r.material = std::move(material);
  r.light = std::move(light);
  r.ns_exact = 20;
  r.ns_exact_float = 12;
  r.ns_present_float = 10;
  r.ns = r.ns_float = ns_float;
  r.speedup = r.ns_exact / r.ns;
  r.speedup_float = r.ns_present_float / r.ns_float;
  r.upper_bound = 0.005;
  r.holds = true;
  return r;
}
SceneEffectRow made_effect(std::string light, bool keep, double error) {
  SceneEffectRow e;
  e.material = "chalk";
  e.light = std::move(light);
  e.effect = "fresnel";
  e.name = "exact Fresnel";
  e.keep = keep;
  e.why = "measured";
  e.error_if_dropped = error;
  return e;
}
ScenesRows made_rows() {
  ScenesRows r;
  r.rows = {made_row("chalk", "front light", 1), made_row("chalk", "rim light", 4),
            made_row("everything needed", "rim light", 9.5)};
  r.effects = {made_effect("front light", false, 0.5), made_effect("rim light", true, 7.25)};
  return r;
}
bool says(const Findings& f, const std::string& sentence) {
  return std::ranges::find(f.sentences, sentence) != f.sentences.end();
}

TEST(ScenesFindings, BeginWithWhatIsSavedAndWhereNothingIs) {
  const auto f = findings(made_rows());
  ASSERT_FALSE(f.sentences.empty());
  EXPECT_EQ(
      f.sentences[0],
      "At no visible difference, plans are faster than all effects of the material in 2 of 3 "
      "scenes whose plans hold. The most is saved for chalk under front light: 90\u00a0% of a "
      "float shader's time.");
  EXPECT_EQ(f.sentences[1],
            "The plan is about as fast as all effects for the material that needs everything "
            "under rim light.");
}

TEST(ScenesFindings, CountAPlanAsFasterWhereItsTableSaysSo) {
  auto r = made_rows();
  const auto counted = [&](double speedup, const char* scenes) {
    r.rows[1].speedup_float = speedup;
    r.rows[1].ns_float = 10 / speedup;
    EXPECT_EQ(scenes::speed(speedup) == "about as fast", scenes[3] == '1');
    const auto headline = findings(r).headline;
    EXPECT_NE(headline.find(scenes), headline.npos) << headline;
  };
  counted(1.13, "In 2 of 3 scenes, leaving out");
  counted(1.12, "In 1 of 3 scenes, leaving out");
}

TEST(ScenesFindings, PromiseNoTimeWhereNoPlanSavesAny) {
  auto r = made_rows();
  for (auto& row : r.rows) row.speedup_float = 1;
  const auto f = findings(r);
  EXPECT_EQ(f.headline, "Leaving out effects that nobody sees saves no time in these scenes.");
  EXPECT_EQ(f.sentences[0].find("The most is saved"), std::string::npos) << f.sentences[0];
}

TEST(ScenesFindings, BlameTheTableOnlyWhereAPlanKeepsIt) {
  auto r = made_rows();
  r.rows[0].ns_float = 200, r.rows[0].speedup_float = 0.05, r.rows[0].needs_table = true;
  r.rows[2].ns_float = 14, r.rows[2].speedup_float = 10.0 / 14;
  const auto f = findings(r);
  const auto at = std::ranges::find(f.sentences,
                                    "The plan is slower than all effects of the material for chalk "
                                    "under front light: it takes 20 times as long.");
  ASSERT_NE(at, f.sentences.end());
  EXPECT_EQ(at[1],
            "No set of forms without the tabulated light between facets keeps the tolerance there "
            "with a plan's margin.");
  EXPECT_EQ(at[2],
            "The plan is slower than all effects of the material for the material that needs "
            "everything under rim light: it takes 1.4 times as long.");
  EXPECT_EQ(
      at[3],
      "No set of forms as fast as all effects keeps the tolerance there with a plan's margin.");
}

TEST(ScenesFindings, CountWhatIsKept) {
  auto r = made_rows();
  EXPECT_TRUE(
      says(findings(r),
           "Better than Schlick's Fresnel is kept in 1 of 3 scenes, and multiple scattering "
           "in none."));
}

TEST(ScenesFindings, SayHowTheLightDecides) {
  const auto f = findings(made_rows());
  EXPECT_TRUE(
      says(f,
           "The light decides: chalk needs exact Fresnel under rim light, where dropping it "
           "costs ΔE2000 7.2; under front light that costs 0.5, and it is dropped."));
  EXPECT_TRUE(
      says(f,
           "So chalk is 10 times as fast as with all that it has under front light, and 2.5 "
           "times under rim light."));
}

TEST(ScenesFindings, SayWhichPlansDoNotHold) {
  auto r = made_rows();
  EXPECT_TRUE(says(findings(r),
                   "On fresh points all plans hold: the share of points beyond the limit is at "
                   "most 0.5\u00a0%, with a confidence of 95\u00a0%."));
  r.rows[0].holds = r.rows[1].holds = false;
  EXPECT_TRUE(
      says(findings(r),
           "On fresh points 2 of 3 plans do not hold: chalk under front light and under rim "
           "light."));
  const std::string why =
      "The reference itself is known to ΔE2000 0.97 there, which counts in what a plan differs by.";
  EXPECT_FALSE(says(findings(r), why));
  r.rows[1].reference_error = 0.9635;
  EXPECT_TRUE(says(findings(r), why));
}

TEST(ScenesFindings, SayAtWhichAnglesAnEffectIsSeen) {
  auto r = made_rows();
  r.maps = {
      {"chalk", "fresnel", "exact Fresnel", 0.9, {0, 60, 120}, {0.3, 0.8}, {9, 0, 9, 2, 9, 0}}};
  const auto sentence = [&] { return findings(r).sentences.back(); };
  EXPECT_EQ(sentence(),
            "Chalk of roughness 0.8 needs exact Fresnel with a light about 60° from the viewer.");
  r.maps[0].error[5] = 2;
  EXPECT_EQ(sentence(),
            "Chalk of roughness 0.8 needs exact Fresnel with a light 60° to 120° from the viewer.");
  r.maps[0].error[1] = 2;
  EXPECT_EQ(sentence(),
            "Chalk of roughness 0.8 needs exact Fresnel with a light up to 120° from the viewer.");
  r.maps[0].error[5] = 0;
  EXPECT_EQ(sentence(),
            "Chalk of roughness 0.8 needs exact Fresnel with a light up to 60° from the viewer.");
}

TEST(ScenesFindings, CanBeReadAloud) {
  GONIO_MANY_FITS();
  test::expect_plain(report().findings);
}

TEST(ScenesReport, TellsEachRowAsAFlatObject) {
  GONIO_MANY_FITS();
  const auto j = nlohmann::json::parse(to_json(report()));
  EXPECT_EQ(j["schema"], "gonio.report.scenes/1");
  for (const char* list : {"rows", "effects", "front"}) {
    ASSERT_FALSE(j[list].empty()) << list;
    for (const auto& r : j[list])
      for (const auto& [key, value] : r.items()) EXPECT_FALSE(value.is_structured()) << list << key;
  }
  const auto lines = rows_csv(report());
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(lines, '\n')), j["rows"].size() + 1);
  const auto page = page::page_html(report_page(report()), report().pictures);
  EXPECT_NE(page.find("Only what the scene needs"), std::string::npos);
}

}  // namespace
}  // namespace gonio
