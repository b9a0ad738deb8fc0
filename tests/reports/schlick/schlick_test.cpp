#include "reports/schlick/schlick.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "optics/spectrum.h"
#include "reports/pictures.h"
#include "reports/plain.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

const SchlickOptions few{false, {1.1, 1.5, 2, 3}, 180, {0.5}};
const auto unwatched = [](double) {};

FresnelRow row(const std::vector<FresnelRow>& rows, std::string_view form) {
  return *std::ranges::find(rows, form, &FresnelRow::form);
}
FresnelForm form(const std::vector<FresnelForm>& forms, std::string_view name) {
  return *std::ranges::find(forms, name, &FresnelForm::name);
}
const SchlickRows& smooth() {
  static const SchlickRows rows{smooth_rows(few, unwatched), {}, {}, {}};
  return rows;
}
const RoughFresnel& rough() {
  static const RoughFresnel rows = rough_rows(few, unwatched);
  return rows;
}

TEST(SchlickReport, AtBrewstersAngleSchlickIsOffByWhatTheClosedFormSays) {
  // tan θ = n: nothing is reflected in p, ((n² − 1)/(n² + 1))² in s
  for (const double n : {1.33, 1.5, 2.4}) {
    const auto s = dielectric(n, "");
    const double c = 1 / std::hypot(1, n), f0 = std::pow((n - 1) / (n + 1), 2);
    const double exact = std::pow((n * n - 1) / (n * n + 1), 2) / 2;
    const double approximate = f0 + (1 - f0) * std::pow(1 - c, 5);
    EXPECT_NEAR(exact_values(s, {&c, 1})[0][0], exact, 1e-14);
    EXPECT_NEAR(form_values(form(forms_for(s), "fresnel.schlick"), s, 0, {&c, 1})[0], approximate,
                1e-14);
    const auto r = row(fresnel_errors(s, 900), "fresnel.schlick");
    EXPECT_GE(r.max_abs, std::abs(approximate - exact));
    EXPECT_GE(r.max_rel, 0.999 * std::abs(approximate / exact - 1));
  }
}

TEST(SchlickReport, FindsTheGreatestErrorOfGlass) {
  // By an own search, Rs and Rp as Fresnel wrote them: tan and sin of sums of the two angles.
  double most = 0, where = 0;
  for (double deg = 0.01; deg < 90; deg += 0.01) {
    const double i = deg * std::acos(-1) / 180, t = std::asin(std::sin(i) / 1.5);
    const double rs = std::sin(i - t) / std::sin(i + t), rp = std::tan(i - t) / std::tan(i + t);
    const double off =
        std::abs(0.04 + 0.96 * std::pow(1 - std::cos(i), 5) - (rs * rs + rp * rp) / 2);
    if (off > most) most = off, where = deg;
  }
  const auto r = row(fresnel_errors(dielectric(1.5, "glass"), 900), "fresnel.schlick");
  EXPECT_NEAR(r.max_abs, most, 1e-5);
  EXPECT_NEAR(r.max_abs_theta_deg, where, 0.1);
}

TEST(SchlickReport, TheLinearFormsMeansAreThoseOfItsIntegrals) {
  // n = 1 reflects nothing, the linear form 1 − c: RMS² = (2/π) ∫ (1 − cos θ)² dθ, bias = 1/3
  const auto r = row(fresnel_errors(dielectric(1, ""), 900), "fresnel.linear.as_written");
  const double pi = std::acos(-1);
  EXPECT_NEAR(r.rms, std::sqrt(2 / pi * (3 * pi / 4 - 2)), 1e-6);
  EXPECT_NEAR(r.bias, 1.0 / 3, 1e-6);
  EXPECT_NEAR(r.within_deg, std::acos(0.99) * 180 / pi, 0.1);
}

TEST(SchlickReport, FromInsideTheGreatestErrorIsWhereTotalReflectionBegins) {
  const auto s = dielectric_inside(1.5, "glass");
  const auto rows = fresnel_errors(s, 900);
  const auto r = row(rows, "fresnel.schlick");
  const double c = std::sqrt(5.0) / 3;  // sin θ = 2/3
  EXPECT_NEAR(r.max_abs_theta_deg, std::asin(2.0 / 3) * 180 / std::acos(-1), 1e-9);
  EXPECT_NEAR(r.max_abs, 0.96 * (1 - std::pow(1 - c, 5)), 1e-6);
}

TEST(SchlickReport, AtTheOuterAngleSchlickIsAsGoodFromInside) {
  for (const double n : {1.2, 1.5, 2.4}) {
    const auto inside = fresnel_errors(dielectric_inside(n, ""), 9000),
               outside = fresnel_errors(dielectric(n, ""), 9000);
    EXPECT_NEAR(row(inside, "fresnel.schlick, outer angle").max_abs,
                row(outside, "fresnel.schlick").max_abs, 2e-4)
        << n;
  }
}

TEST(SchlickReport, WhatIsExactInOtherWordsHasNoError) {
  for (const auto& r : smooth().smooth)
    if ((r.form == "fresnel.gulbrandsen" && r.kind != "spectral") ||
        (r.form == "fresnel.disney2015" && r.eta < 1.3)) {
      EXPECT_LT(r.max_abs, 1e-12) << r.form << r.name;
    }
}

TEST(SchlickReport, LazanyiWithoutCorrectionIsSchlickAndWithItNearerWhereAnyHelps) {
  int channels = 0, nearer = 0;
  for (const auto& m : metals()) {
    const auto rows = fresnel_errors(metal(m), 180);
    for (const auto* channel : {"red", "green", "blue"}) {
      const auto of = [&](std::string_view form) {
        return std::ranges::find_if(
                   rows,
                   [&](const FresnelRow& r) { return r.form == form && r.channel == channel; })
            ->rms;
      };
      EXPECT_NEAR(of("fresnel.lazanyi"), of("fresnel.schlick"), 1e-12) << m.name;
      const double corrected = of("fresnel.lazanyi, corrected"), schlick = of("fresnel.schlick");
      EXPECT_LE(corrected, schlick * (1 + 1e-12)) << m.name;  // the correction may be none
      ++channels;
      nearer += corrected < 0.9 * schlick;
    }
  }
  EXPECT_GT(nearer, channels / 2);
}

TEST(SchlickReport, NoOtherF90ServesAllChannelsOfAMetalBetter) {
  const auto at = angle_steps(90);
  for (const auto& m : metals()) {
    const auto s = metal(m);
    const auto exact = exact_values(s, at.cosine);
    auto f90 = form(forms_for(s), "fresnel.schlick.f90");
    const auto squares = [&](double change) {
      auto f = f90;
      f.settings[1].values[0] += change;
      double sum = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        const auto v = form_values(f, s, c, at.cosine);
        for (std::size_t i = 0; i < v.size(); ++i) sum += std::pow(v[i] - exact[c][i], 2);
      }
      return sum;
    };
    EXPECT_LT(squares(0), squares(-0.01)) << m.name;
    if (f90.settings[1].values[0] < 1) {
      EXPECT_LT(squares(0), squares(0.01)) << m.name;
    }
  }
}

TEST(SchlickReport, F82MeetsTheExactValueAt82DegreesWhereTheEdgeIsDarker) {
  const double edge = 1 / 7.0, normal = 1;
  for (const auto& m : metals()) {
    const auto s = metal(m);
    const auto f82 = form(forms_for(s), "fresnel.f82");
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(form_values(f82, s, c, {&normal, 1})[0], exact_values(s, {&normal, 1})[c][0],
                  1e-12);
      if (f82.settings[1].values[c] < 1) {
        EXPECT_NEAR(form_values(f82, s, c, {&edge, 1})[0], exact_values(s, {&edge, 1})[c][0], 1e-12)
            << m.name;
      }
    }
  }
}

TEST(SchlickReport, ASpectrumWithoutColourHasTheErrorsOfItsIndex) {
  const Material::Measured flat[] = {{300, 2, 0.5}, {900, 2, 0.5}};
  const Material grey{"G", "grey", "", flat};
  const auto one = fresnel_errors(metal(grey), 90), spectrum = fresnel_errors(spectral(grey), 90);
  const auto a = row(one, "fresnel.schlick");
  const auto b = row(spectrum, "fresnel.schlick");
  EXPECT_NEAR(a.max_abs, b.max_abs, 1e-12);
  EXPECT_NEAR(a.rms, b.rms, 1e-12);
  EXPECT_TRUE(std::isnan(b.eta));
  EXPECT_NEAR(row(spectrum, "fresnel.conductor, three wavelengths").max_abs, 0, 1e-12);
}

TEST(SchlickReport, AlbedosAreThoseOfTheModelsAndColoursDifferWhereTheyDo) {
  const auto& r = rough();
  const auto find = [&](const auto& list, std::string_view f, std::string_view material,
                        double mu) {
    return *std::ranges::find_if(
        list, [&](const auto& a) { return a.form == f && a.material == material && a.mu == mu; });
  };
  for (const auto& a : r.albedos) {
    EXPECT_LE(a.bound, 1e-5);
    if (a.form == "fresnel.gulbrandsen" && a.channel.empty()) {
      EXPECT_NEAR(a.albedo[0], a.exact[0], 2 * a.bound) << a.material;
    }
  }
  const auto tungsten = find(r.albedos, "fresnel.schlick", "tungsten", 0.1);
  EXPECT_GT(tungsten.albedo[0], tungsten.exact[0] + 1e-2);
  EXPECT_GT(find(r.colours, "fresnel.schlick", "tungsten", 0.1).delta_e[0], 1);
}

TEST(SchlickReport, ColoursOfRoughMetalsAreThoseOfTheirSpectra) {
  // a smooth mirror seen head on: its albedo is its reflectance, its colour the spectrum's
  auto o = few;
  o.roughness = {0.05};
  const auto r = rough_rows(o, unwatched);
  for (const auto& m : metals()) {
    const auto rgb = reflectance_rgb(m, 1);
    for (const auto& a : r.albedos)
      if (a.material == m.name && a.mu == 1 && a.form == "fresnel.schlick") {
        const std::size_t c = a.channel == "red" ? 0 : a.channel == "green" ? 1 : 2;
        EXPECT_NEAR(a.exact[0], rgb[c], 2e-5) << m.name << " " << a.channel;
      }
  }
  // the shortcut's gold is another colour, even head on
  const auto gold = std::ranges::find_if(r.colours, [](const FresnelColour& c) {
    return c.material == "gold" && c.mu == 1 && c.form == "fresnel.conductor, three wavelengths";
  });
  ASSERT_NE(gold, r.colours.end());
  EXPECT_GT(gold->delta_e[0], 1);
}

TEST(SchlickReport, SeeksTheGreatestColourErrorBetweenTheCosinesThatItShows) {
  auto smooth_water = few;
  smooth_water.roughness = {0.1};
  const auto r = rough_rows(smooth_water, unwatched);
  const auto most = [&](double least, double up_to) {
    double all = 0;
    for (const auto& c : r.colours)
      if (c.material == "IOR 1.33" && c.form == "fresnel.schlick" && c.mu >= least && c.mu <= up_to)
        all = std::max(all, c.delta_e[0]);
    return all;
  };
  EXPECT_GT(most(0.11, 0.49), std::max(most(0.1, 0.1), most(0.5, 1))) << "water, near mu 0.2";
}

TEST(SchlickReport, RowsAreFlatAndHaveTheKeysOfTheContract) {
  const auto j = nlohmann::json::parse(to_json(report_of(false, smooth())));
  ASSERT_EQ(j["rows"].size(), smooth().smooth.size());
  std::set<std::string> forms;
  for (const auto& r : j["rows"]) {
    forms.insert(r["form"]);
    for (const auto& [key, value] : r.items()) EXPECT_TRUE(value.is_primitive()) << key;
    for (const auto* key :
         {"form", "kind", "name", "eta", "k", "max_abs", "max_abs_theta_deg", "max_rel", "rms"})
      EXPECT_TRUE(r.contains(key)) << key;
    EXPECT_EQ(r["eta"].is_null(), r["kind"] == "spectral");
  }
  for (const auto* id :
       {"schlick", "schlick.f90", "f82", "lazanyi", "schlick.ue", "schlick.spherical_gaussian",
        "linear.as_written", "disney2015", "gulbrandsen"})
    EXPECT_TRUE(forms.contains("fresnel." + std::string(id))) << id;
}

TEST(SchlickReport, MapsHaveAnErrorForEveryCell) {
  const auto r = fresnel_maps();
  for (const auto& m : r.maps)
    EXPECT_EQ(m.error.size(), r.ior.size() * r.theta_deg.size()) << m.form;
  const auto& exact = r.maps.front();
  ASSERT_EQ(exact.form, "exact");
  EXPECT_LT(exact.error.front(), 1e-3);  // near IOR 1, near the normal
}

TEST(SchlickReport, TheVerdictsAreMadeFromTheFigures) {
  const auto said = [](const SchlickRows& r, std::string_view words) {
    const auto all = findings(r).sentences;
    return std::ranges::any_of(all, [&](const std::string& f) { return f.find(words) != f.npos; });
  };
  EXPECT_TRUE(said(smooth(), "below 1 %” does not hold"));
  EXPECT_TRUE(said(smooth(), "Glass: absolute error up to 0.036, relative error up to "));
  EXPECT_TRUE(said(smooth(), "“most non-metals have F0 0.02 to 0.04” does not hold"));
  EXPECT_TRUE(said(smooth(), "near a relative IOR of 1 its error is larger” holds in part"));
  EXPECT_TRUE(said(smooth(), "Absolute error up to 0.22 at IOR 1.1, "))
      << "the number it is judged on";
  EXPECT_TRUE(said(smooth(), "has no error where a channel has one n and one k: Gulbrandsen"));
  EXPECT_FALSE(said(smooth(), "one k: exact"));
  auto unreal = smooth();
  for (auto& r : unreal.smooth)
    if (r.form == "fresnel.schlick.ue" && r.kind == "dielectric")
      r.max_abs = r.name == "IOR 1.1" ? 0.9 : r.name == "IOR 1.5" ? 0.05 : r.max_abs;
  EXPECT_TRUE(said(unreal, "up to IOR 1.5. It is off most at IOR 1.1, by up to 0.9."));
  auto good = smooth();
  for (auto& r : good.smooth) r.max_abs = r.max_rel = r.eta < 1.2 && r.k == 0 ? 0.2 : 1e-3;
  EXPECT_TRUE(said(good, "near a relative IOR of 1 its error is larger” holds."));
  for (auto& r : good.smooth) r.max_abs = 1e-3;
  EXPECT_TRUE(said(good, "below 1 %” holds."));
}

TEST(SchlickReport, ClaimsCountTheRowsOfTheReport) {
  std::size_t small = 0, all = 0, bright = 0, channels = 0;
  for (const auto& x : smooth().smooth) {
    if (x.form != "fresnel.schlick" || (x.kind != "dielectric" && x.kind != "metal")) continue;
    ++all, small += x.max_abs < 0.01;
    if (x.kind != "metal") continue;
    const double f0 = f0_of_index({x.eta, x.k});
    ++channels, bright += 0.7 <= f0 && f0 <= 1;
  }
  const auto said = [](const std::string& words) {
    const auto found = findings(smooth());
    return std::ranges::any_of(found.claims, [&](const Claim& c) {
      return c.figure.find(words) != c.figure.npos || c.verdict.find(words) != c.verdict.npos;
    });
  };
  EXPECT_TRUE(said(std::to_string(bright) + " of " + std::to_string(channels) + " channels"));
  EXPECT_TRUE(
      said(std::to_string(small) + " of " + std::to_string(all) + " IORs of dielectrics and"))
      << "those that were measured, too";
}

TEST(SchlickReport, WhatIsSaidCanBeReadAloud) {
  auto r = smooth();
  test::expect_plain(findings(r));
  r.rough = rough();
  const auto said = findings(r);
  test::expect_plain(said);
  EXPECT_TRUE(said.headline.starts_with("With Schlick in place of exact Fresnel, rough glass"))
      << said.headline;
  for (auto& row : r.smooth) row.max_abs = row.max_rel = row.rms = 0.0012345;
  for (auto& c : r.rough.colours)
    for (double& e : c.delta_e) e = 0.12345;
  test::expect_plain(findings(r));
}

TEST(SchlickReport, PicturesShowWhatWasMeasured) {
  const auto p = pictures({smooth().smooth, fresnel_maps(), fresnel_curves(), {}});
  test::expect_whole(p);
  const auto map = std::ranges::find(p.maps, "error_by_angle_schlick_from_outside", &FigureMap::id);
  ASSERT_NE(map, p.maps.end());
  const std::size_t angle = 40, index = 9;
  const auto s = dielectric(map->y.at[index], "");
  const double c = std::cos(map->x.at[angle] * std::numbers::pi / 180);
  EXPECT_NEAR(map->values[angle * map->y.size() + index],
              form_values(form(forms_for(s), "fresnel.schlick"), s, 0, {&c, 1})[0] -
                  exact_values(s, {&c, 1})[0][0],
              1e-12);
  const auto gold =
      std::ranges::find(p.figures, "reflectance_gold_three_wavelengths_red", &Figure::id);
  ASSERT_NE(gold, p.figures.end());
  EXPECT_TRUE(gold->curves.front().dashed) << "the exact one";
  EXPECT_EQ(gold->curves[1].name, "schlick = lazanyi = schlick.ue") << "the same on gold";
}

}  // namespace
}  // namespace gonio
