#include "reports/diffuse/diffuse.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "brdf/catalogue/registry.h"
#include "reports/diffuse/forms.h"
#include "reports/page/render.h"
#include "reports/pictures.h"
#include "reports/plain.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

/// Every form at three roughnesses and few angles.
const DiffuseReport& report() {
  static const auto made = [] {
    DiffuseOptions o;
    o.roughness = {0, 0.5, 1};
    o.mu = {0.02, 0.1, 0.5, 1};
    o.pixels = 16;
    return diffuse_report(o);
  }();
  return made;
}
const DiffuseForm& form(std::string_view id) {
  return *find_form(report().rows.forms, id);
}

TEST(DiffuseReport, HasEveryDiffuseFormThatStandsForItself) {
  std::set<std::string> looked_at;
  for (const auto& f : report().rows.forms) looked_at.insert(f.id);
  for (const auto& t : catalogue())
    if (t.role() == Role::diffuse && t.id().find("metallic") == std::string_view::npos) {
      EXPECT_TRUE(looked_at.contains(std::string(t.id()))) << t.id();
    }
}

TEST(DiffuseReport, KnowsTheAlbedosThatAreKnown) {
  EXPECT_NEAR(form("diffuse.lambert").most_albedo, 1, 1e-5);
  EXPECT_NEAR(form("diffuse.lambert").least_average, 1, 1e-5);
  EXPECT_NEAR(form("diffuse.disney").most_albedo, 1.52, 0.005);
  EXPECT_EQ(form("diffuse.disney").most_roughness, 1);
  EXPECT_EQ(form("diffuse.disney").most_mu, 0.02);
  // EON of white gives all back, at each angle.
  for (const auto& r : report().rows.rows)
    if (r.form == "diffuse.eon") {
      EXPECT_NEAR(r.albedo, 1, 1e-3) << r.roughness << ", " << r.mu;
      EXPECT_NEAR(r.average, 1, 1e-3) << r.roughness;
    }
  // Fujii's closed form A (1 + (2/3 − 28/15π) r) at r = 1
  const double pi = std::acos(-1), a = 1 / (1 + 0.5 - 2 / (3 * pi));
  EXPECT_NEAR(form("diffuse.oren_nayar.fujii").least_average, a * (1 + 2.0 / 3 - 28 / (15 * pi)),
              1e-4);
}

TEST(DiffuseReport, CouplingByOneLessFresnelLeavesTooMuchAtGrazingAngles) {
  // A smooth surface mirrors most there, and 1 − F(VoH) is of the half angle, which light from
  // elsewhere makes small.
  EXPECT_GT(form("diffuse.lambert.coupled").most_with_lobe, 1.5);
  EXPECT_LT(form("diffuse.lambert.coupled").most_with_lobe, form("diffuse.lambert").most_with_lobe);
  EXPECT_LT(form("diffuse.hammon").most_with_lobe, form("diffuse.lambert").most_with_lobe);
}

TEST(DiffuseReport, ComparesAFormOnlyOnSurfacesThatItIsFor) {
  const auto& c = report().rows.colours;
  for (const std::string_view id : {"diffuse.lambert.coupled", "diffuse.hammon"}) {
    EXPECT_FALSE(largest_difference(c, id, "matte")) << id;
    EXPECT_TRUE(largest_difference(c, id, "plastic")) << id;
  }
  EXPECT_FALSE(largest_difference(c, "diffuse.eon", "matte")) << "it is the reference";
}

TEST(DiffuseReport, OfASmoothMatteSurfaceLambertIsTheReference) {
  // EON at roughness 0 is Lambert's.
  for (const auto& c : report().rows.colours)
    if (c.surface == "matte" && c.roughness == 0 &&
        (c.form == "diffuse.lambert" || c.form == "diffuse.oren_nayar.fujii")) {
      EXPECT_LT(c.delta_e, 1e-3) << c.form << ", " << c.material << ", " << c.light;
    }
  EXPECT_GT(*largest_difference(report().rows.colours, "diffuse.lambert", "matte", 1), 2);
}

TEST(DiffuseReport, AFinerPictureOfTheBallFindsHardlyLargerErrors) {
  const auto of = [](std::size_t pixels) {
    DiffuseOptions o;
    o.roughness = {1};
    o.mu = {0.5, 1};
    o.pixels = pixels;
    return diffuse_colours(o, diffusing::known_forms(), [](double) {});
  };
  const auto coarse = of(48), fine = of(72);
  ASSERT_EQ(coarse.size(), fine.size());
  for (std::size_t i = 0; i < fine.size(); ++i)
    EXPECT_NEAR(coarse[i].delta_e, fine[i].delta_e, 0.02 * fine[i].delta_e + 0.05)
        << fine[i].form << ", " << fine[i].light;
}

TEST(DiffuseReport, TheReferenceOnPlasticKeepsAllLight) {
  // White chalk below the lobe: nothing is lost and nothing made, so its albedo is 1.
  DiffuseOptions o;
  o.roughness = {0.5};
  o.mu = {0.1, 0.5, 1};
  o.pixels = 8;
  const auto all = diffuse_colours(o, diffusing::known_forms(), [](double) {});
  const auto even = [&](std::string_view id) {
    return std::ranges::find_if(all,
                                [&](const DiffuseColour& c) {
                                  return c.form == id && c.surface == "plastic" &&
                                         c.light == "even light" && c.material == "chalk";
                                })
        ->delta_e;
  };
  EXPECT_GT(even("diffuse.lambert"), even("diffuse.lambert.coupled"));
  EXPECT_LT(even("diffuse.lambert.coupled"), 3);
  // On a smooth surface it is what Frostbite and Hammon made for one, whose interface is in them.
  for (const auto& c : report().rows.colours)
    if (c.surface == "plastic" && c.roughness == 0 &&
        (c.form == "diffuse.frostbite" || c.form == "diffuse.hammon")) {
      EXPECT_LT(c.delta_e, 1.2) << c.form << ", " << c.material << ", " << c.light;
    }
}

TEST(DiffuseReport, SaysWhereNoKdGivesBackWhatTheReferenceDoes) {
  // Rough white Oren–Nayar gives back 71 % where EON gives back chalk's 83 %.
  double oren_nayar = 1;
  for (const auto& c : report().rows.colours) {
    EXPECT_GT(c.given_back, 0.5) << c.form;
    EXPECT_LT(c.given_back, 1.001) << c.form;
    if (c.form == "diffuse.oren_nayar" && c.surface == "matte" && c.material == "chalk" &&
        c.roughness == 1)
      oren_nayar = c.given_back;
    if (c.form == "diffuse.lambert" || c.material == std::string("grey")) {
      EXPECT_NEAR(c.given_back, 1, 1e-3) << c.form;
    }
  }
  EXPECT_NEAR(oren_nayar, 0.712 / 0.825, 0.005);
  const auto page = page::page_html(report_page(report()), report().pictures);
  EXPECT_NE(page.find("On chalk even kd = 1 gives back less than 99\u202f% of that: "), page.npos);
}

TEST(DiffuseReport, FactsAreThoseOfTheRows) {
  const auto f = facts(report().rows).diffuse;
  ASSERT_EQ(f.size(), report().rows.forms.size());
  for (const auto& d : f) EXPECT_EQ(d.most_albedo, form(d.id).most_albedo);
}

TEST(DiffuseReport, SentencesCanBeReadAloud) {
  const auto& said = report().findings;
  test::expect_plain(said);
  EXPECT_TRUE(said.headline.starts_with("Disney's diffuse makes light: a white surface reflects "));
  EXPECT_GE(said.sentences.size(), 8U);
}

TEST(DiffuseReport, PicturesAndRowsAreWhole) {
  test::expect_whole(report().pictures);
  const auto j = nlohmann::json::parse(to_json(report()));
  EXPECT_EQ(j["schema"], "gonio.report.diffuse/1");
  for (const char* list : {"rows", "forms", "colours"})
    for (const auto& r : j[list])
      for (const auto& [key, value] : r.items()) EXPECT_FALSE(value.is_structured()) << list << key;
  const auto lines = rows_csv(report());
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(lines, '\n')), j["rows"].size() + 1);
}

}  // namespace
}  // namespace gonio
