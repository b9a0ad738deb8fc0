#include "reports/remap/remap.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "brdf/catalogue/masking_shape.h"
#include "brdf/catalogue/registry.h"
#include "reports/pictures.h"
#include "reports/plain.h"
#include "reports/remap/pairs.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

const std::string separable = "masking.smith_ggx.separable",
                  correlated = "masking.smith_ggx.correlated",
                  direct = "masking.schlick_ggx.direct", image = "masking.schlick_ggx.half_alpha",
                  coat = "masking.disney_coat", disney = "masking.disney_remap",
                  hammon = "masking.hammon", joint = "masking.ue_joint", none = "masking.none",
                  implicit = "masking.implicit", unity = "masking.unity_mobile";

/// Few roughnesses, and the forms named.
RemapRows of(std::vector<std::string> forms,
             std::vector<double> roughness = {0.5, 1},
             double step = 0.1) {
  return remap_rows({false, std::move(roughness), {0.5}, 4, step, std::move(forms)});
}
const RemapRow& row(const RemapRows& r,
                    std::string_view form,
                    std::string_view reference,
                    double roughness) {
  return *std::ranges::find_if(r.rows, [&](const RemapRow& x) {
    return x.form == form && x.reference == reference && x.roughness == roughness;
  });
}

TEST(RemapReport, ExactSmithBehavesLikeItself) {
  const auto r = of({separable, correlated}, {0.33, 0.7}, 0.0125);
  for (const auto& x : r.rows) {
    if (x.form != x.reference) continue;
    EXPECT_EQ(x.rms, 0) << x.form;
    EXPECT_NEAR(x.by_g2.roughness, x.roughness, 1e-4) << x.form;
    EXPECT_NEAR(x.by_albedo.roughness, x.roughness, 2e-3) << x.form;
    EXPECT_FALSE(x.by_g2.at_end);
  }
}

TEST(RemapReport, DisneysRemapBehavesLikeTheRoughnessItIsMadeOf) {
  const auto r = of({disney, coat}, {0.2, 0.5, 1});
  for (const double rough : {0.2, 0.5})
    EXPECT_NEAR(row(r, disney, separable, rough).by_g2.roughness, (1 + rough) / 2, 1e-4);
  EXPECT_TRUE(row(r, disney, separable, 1).by_g2.at_end);
  for (const double rough : {0.2, 0.5, 1.0})  // alpha 0.25, whatever it is
    EXPECT_NEAR(row(r, coat, separable, rough).by_g2.roughness, 0.5, 1e-4);
}

TEST(RemapReport, SchlicksKsAreSmithItselfAtRoughnessOne) {
  const auto r = of({direct, image});
  for (const auto& id : {direct, image}) {
    EXPECT_LT(row(r, id, separable, 1).max_rel, 1e-12) << id;
    EXPECT_GT(row(r, id, separable, 0.5).max_rel, 0.01) << id;
  }
}

TEST(RemapReport, RmsOfImplicitAgainstRoughnessOneIsAClosedForm) {
  // separable Smith of alpha 1: G1 = 2c/(1 + c); the difference c c' − 4 c c'/((1 + c)(1 + c'))
  const double a = remap_least_cosine, width = 1 - a;
  const double ln = std::log(2 / (1 + a));
  const double cc = (1 - a * a * a) / 3 / width;  // mean of c²
  // c²/(1 + c) = c − 1 + 1/(1 + c);  c²/(1 + c)² = 1 − 2/(1 + c) + 1/(1 + c)²
  const double once = ((1 - a * a) / 2 - width + ln) / width;
  const double twice = (width - 2 * ln + 1 / (1 + a) - 0.5) / width;
  const double mean = cc * cc - 8 * once * once + 16 * twice * twice;
  const auto r = of({implicit}, {1});
  EXPECT_NEAR(row(r, implicit, separable, 1).rms, std::sqrt(mean), 1e-9);
}

TEST(RemapReport, MostIsAtTheEndsWhereNothingMasks) {
  // 1/G2 − 1 of no masking is most where both directions graze: G1(c) = 2c/(c + 1) of alpha 1
  const auto r = of({none}, {1});
  const auto& x = row(r, none, separable, 1);
  const double g1 = 2 * 0.05 / 1.05;
  EXPECT_NEAR(x.max_rel, 1 / (g1 * g1) - 1, 1e-9);
  EXPECT_EQ(x.max_rel_nol, 0.05);
  EXPECT_EQ(x.max_rel_nov, 0.05);
  EXPECT_TRUE(x.by_g2.at_end);
  EXPECT_LT(x.by_g2.roughness, 0.011);
}

TEST(RemapReport, HammonsFormIsUnrealsInAllThatIsMeasured) {
  const auto r = of({hammon, joint});
  for (const auto& reference : {separable, correlated}) {
    const auto &a = row(r, hammon, reference, 0.5), &b = row(r, joint, reference, 0.5);
    EXPECT_NEAR(a.rms, b.rms, 1e-12);
    EXPECT_NEAR(a.albedo, b.albedo, a.albedo_error + b.albedo_error);
    EXPECT_NEAR(a.by_g2.roughness, b.by_g2.roughness, 1e-4);
  }
}

TEST(RemapReport, FormsOfTheHalfVectorAreAveragedOverAzimuths) {
  // Kelemen's 1/VoH² with 2 VoH² = 1 + NoL NoV + sin sin cos φ: its mean is 2/√((1 + NoL NoV)² −
  // sin² sin²)
  const double l = 0.6, v = 0.8, s = (1 - l * l) * (1 - v * v);
  const remapping::Pairs pairs({{l, v}}, 64);
  const auto mean = remapping::mean_g2(find_term("masking.kelemen"), 0.5, pairs);
  EXPECT_NEAR(mean[0], l * v * 2 / std::sqrt((1 + l * v) * (1 + l * v) - s), 1e-9);
  EXPECT_TRUE(remapping::reads_half(find_term("masking.kelemen")));
  EXPECT_FALSE(remapping::reads_half(find_term(correlated)));
}

TEST(RemapReport, EveryIsotropicFormOfGgxAndBeckmannHasItsOwnReferences) {
  std::set<std::string> forms;
  const auto r = of({}, {1});
  for (const auto& x : r.rows) {
    forms.insert(x.form);
    EXPECT_EQ(shape_of_term(x.form), shape_of_term(x.reference));
    EXPECT_TRUE(std::isfinite(x.rms) && std::isfinite(x.max_rel) && x.albedo > 0) << x.form;
    EXPECT_LT(x.rms_error, 1e-3) << x.form;
  }
  EXPECT_EQ(forms.size(), 22U);
  EXPECT_EQ(r.rows.size(), 44U);
  EXPECT_FALSE(forms.contains("masking.smith_gtr.separable"));
}

TEST(RemapReport, AlbedoIsThatOfTheFurnaceBesideTheReferences) {
  // separable loses more than correlated; at normal incidence of roughness 1 correlated keeps 1 −
  // ln 2
  const auto r = of({separable, correlated}, {1});
  const auto& x = row(r, separable, correlated, 1);
  EXPECT_LT(x.albedo, x.albedo_reference - 10 * x.albedo_error);
  EXPECT_NEAR(r.forms[1].at[0].albedo.back(), 1 - std::log(2.0), 1e-5);
}

TEST(RemapReport, EitherKIsRightForASingleLightAtTheNormalAndDirectMasksMoreBelow) {
  const auto r = of({separable, correlated, direct, image}, {0.5});
  ASSERT_EQ(r.uses.size(), 2U * 2 * r.mu.size());
  for (const auto& u : r.uses) {
    if (u.light != "single") continue;
    if (u.mu == 1) {
      EXPECT_NEAR(u.value, 1, 1e-12);
    } else if (u.form == direct) {
      EXPECT_LT(u.value, u.separable);
    }
    if (u.mu == 0.1 && u.form == direct) {  // k = 0.28125
      EXPECT_NEAR(u.value, std::pow(0.1 / (0.1 * 0.71875 + 0.28125), 2), 1e-12);
    }
  }
}

TEST(RemapReport, G1IsThatOfTheSeeds) {
  const auto r = of({direct});
  ASSERT_EQ(r.g1.size(), 2U);
  EXPECT_NEAR(r.g1[0].value, 0.1 / 0.2125, 1e-12);
  EXPECT_NEAR(r.g1[1].value, 0.1 / 0.353125, 1e-12);
  EXPECT_NEAR(r.g1[0].smith, r.g1[1].smith, 1e-12) << "one roughness, two k";
  EXPECT_NEAR(r.g1[0].roughness, 0.5, 1e-12);
  EXPECT_NEAR(r.g1[1].smith, 0.2 / (0.1 + std::sqrt(0.0625 + 0.9375 * 0.01)), 1e-12);
  EXPECT_NEAR(r.g1[1].roughness, 0.5, 1e-12);
}

TEST(RemapReport, TheMobileFormIsRightAtTheNormalOfRoughnessOneHalf) {
  const auto r = of({unity}, {0.5, 1});
  for (const auto& v : r.vf) {
    EXPECT_LE(v.least, v.most);
    EXPECT_GE(v.factor, std::max(v.bias, 1 / v.bias) - 1e-12);
    if (v.over == "mirror" && v.fresnel == "F = 1" && v.roughness == 1) {
      // NoL = NoV = c, alpha 1: V = 1/(4 c), the form's is 1/(6 c²)
      EXPECT_NEAR(v.least, 2.0 / 3, 1e-9);
      EXPECT_NEAR(v.most, 2.0 / 3 / 0.05, 1e-9);
    }
  }
}

TEST(RemapReport, RowsAreFlatAndHaveTheKeysOfTheContract) {
  const auto j = nlohmann::json::parse(to_json(report_of(false, of({direct}))));
  ASSERT_EQ(j["rows"].size(), 4U);
  for (const auto& x : j["rows"])
    for (const auto* key : {"form", "reference", "roughness", "rms", "max_rel", "albedo_mu_0_5"})
      EXPECT_TRUE(x.contains(key)) << key;
  ASSERT_EQ(j["maps"].size(), 1U);  // G2 alone: there is no reference to be off from
  EXPECT_EQ(j["maps"][0]["values"].size(), 400U) << "of the roughness that is shown";
}

TEST(RemapFacts, PutTheWordingOfFewerOperationsFirst) {
  const auto f = facts(of({separable, correlated, joint, hammon}, {0.5}));
  const auto place = [&](std::string_view form) {
    return std::ranges::find(f.masking, form, &Facts::Masking::form) - f.masking.begin();
  };
  ASSERT_EQ(f.masking.size(), 4U);
  EXPECT_NEAR(f.masking[place(hammon)].rms, f.masking[place(joint)].rms, 1e-9);
  EXPECT_LT(place(hammon), place(joint));
}

TEST(RemapReport, FindingsJudgeTheClaimsFromTheFigures) {
  auto r = of({separable, correlated, direct, image, joint, unity}, {0.1, 0.3, 0.5});
  const auto all = findings(r);
  const auto said = [&](std::string_view words) {
    return std::ranges::any_of(all.sentences,
                               [&](const std::string& f) { return f.find(words) != f.npos; });
  };
  EXPECT_TRUE(all.headline.starts_with("Unreal's joint form is the cheap masking nearest to"));
  EXPECT_TRUE(said("A surface of roughness 0.1 is masked by Schlick's k = (r+1)²/8 like one of"));
  EXPECT_TRUE(said("r²/2 for image-based” does not hold"));
  // Each is of height-correlated Smith, which the index compares with.
  EXPECT_TRUE(said(fmt::format("like one of roughness {:.2f} by height-correlated Smith",
                               row(r, direct, correlated, 0.3).by_g2.roughness)));
  EXPECT_EQ(all.claims[0].figure,
            fmt::format("RMS error of G₂: {:.2g} with (r+1)²/8, {:.2g} with r²/2",
                        *overall_rms(r, direct, correlated), *overall_rms(r, image, correlated)));
  EXPECT_NE(fmt::format("{:.2g}", *overall_rms(r, image, correlated)),
            fmt::format("{:.2g}", *overall_rms(r, image, separable)))
      << "or the choice of reference does not show";
  EXPECT_EQ(all.claims[0].judged, Claim::Judged::fails);
  EXPECT_EQ(all.claims.size(), 4U);
  // already too dark: 0.471 of what should be 0.543
  EXPECT_TRUE(said("“k = α/2 is too bright at grazing angles” does not hold"));
  EXPECT_EQ(all.claims[1].figure, "13\u00a0% darker than exact Smith at NoV 0.1");
  EXPECT_EQ(all.claims[2].figure,
            "it masks 72\u00a0% of the light there; exact Smith of a medium roughness (0.5) masks "
            "46\u00a0%");
  EXPECT_TRUE(said("“F V ≈ 1/(LoH²(r+0.5))” does not hold. Off by a factor of up to "));
  for (auto& row : r.rows)  // were it the other way round
    if (row.form == direct) row.rms = 0;
  EXPECT_EQ(findings(r).claims[0].judged, Claim::Judged::holds);
}

TEST(RemapReport, WhatIsSaidCanBeReadAloud) {
  auto r = of({separable, correlated, direct, image, joint, unity}, {0.1, 0.3, 0.5});
  test::expect_plain(findings(r));
  for (auto& row : r.rows) row.by_g2.at_end = true, row.rms = 0.12345;
  for (auto& use : r.uses) use.value = 2.345 * use.separable;
  for (auto& g : r.g1) g.value = 1.2345 * g.smith;
  for (auto& v : r.vf) v.least = 0.12345, v.most = 1.2345;
  test::expect_plain(findings(r));
  for (auto& row : r.rows) row.by_g2.roughness = 0.01;
  test::expect_plain(findings(r));
}

TEST(RemapReport, WhatLacksAQuarterIsFourTimesAsMuch) {
  // no spread: with the ¼ it is right, as printed off by four
  auto r = of({unity}, {0.5});
  const auto figure = [&] { return findings(r).claims.back().figure; };
  for (auto& v : r.vf) v.least = v.most = 1;
  const auto with_quarter = [&](std::string_view factor) {
    return findings(r).claims.back().verdict.ends_with(fmt::format("is off by up to {}.", factor));
  };
  EXPECT_EQ(figure(), "off by a factor of up to 4");
  EXPECT_TRUE(with_quarter("1"));
  for (auto& v : r.vf) v.least = 0.09, v.most = 1.8, v.factor = 3;
  EXPECT_EQ(figure(), "off by a factor of up to 7.2") << "not the RMS factor";
  EXPECT_TRUE(with_quarter("12"));
}

TEST(RemapReport, NamesOfTwoFormsOfTheSameValuesTheOneOfFewerOperations) {
  const auto r = of({separable, correlated, direct, joint, hammon}, {0.3, 0.5});
  const auto operations = [&](const std::string& id) {
    return std::ranges::find(r.forms, id, &RemapForm::form)->operations;
  };
  ASSERT_LT(operations(hammon), operations(joint));
  const auto all = findings(r).sentences;
  EXPECT_TRUE(std::ranges::any_of(all, [&](const std::string& s) {
    return s.starts_with("It takes " + std::to_string(operations(hammon)) + " operations");
  }));
}

TEST(RemapReport, PicturesShowWhatWasMeasured) {
  const auto r = of({separable, correlated, direct, image, unity});
  const auto p = pictures(r);
  test::expect_whole(p);
  const auto map =
      std::ranges::find(p.maps, "masking_error_schlick_ggx_direct_separable", &FigureMap::id);
  ASSERT_NE(map, p.maps.end());
  EXPECT_EQ(map->slices, std::vector<std::string>{"roughness 0.5"});
  const auto& worst = row(r, direct, separable, 0.5);
  const auto most = std::ranges::max_element(map->values, {}, [](double v) { return std::abs(v); });
  EXPECT_LE(std::abs(*most), 100 * worst.max_rel * (1 + 1e-9)) << "looked at more finely there";
  EXPECT_GE(std::abs(*most), 99 * worst.max_rel);
}

}  // namespace
}  // namespace gonio
