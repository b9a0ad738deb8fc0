// What is said of a fit with a shipped form is what that form does.
#include "reports/cross_fit/cross_fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "integrate/rule/quadrature.h"
#include "integrate/scattering/half_space.h"
#include "many_fits.h"
#include "reports/cross_fit/cases.h"
#include "reports/pictures.h"
#include "reports/plain.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <tbb/global_control.h>

namespace gonio {
namespace {

using std::numbers::pi;

const FresnelSurface glass = dielectric(1.5, "IOR 1.5");
const FresnelSurface gold = metal(*find_metal("Au"));
const CrossTruth ggx{"GGX", "ggx", "smith_ggx.correlated"};

/// One roughness, few bins and walks, and the forms named.
CrossFitOptions few(std::vector<std::string> forms, std::vector<std::string> metals = {}) {
  return {false, {0.5}, {1.5}, std::move(metals), {3}, 12, 64, std::move(forms)};
}
const CrossCase& find(const CrossFitRows& r,
                      std::string_view truth,
                      std::string_view fitted,
                      std::string_view material = "IOR 1.5") {
  return *std::ranges::find_if(r.cases, [&](const CrossCase& c) {
    return c.truth == truth && c.fitted == fitted && c.material == material &&
           c.metric == Metric::log && c.layout == cross_layouts[0].name;
  });
}
/// A slice of any model, and a form fitted to it.
CrossCase fitted(const std::string& truth, std::vector<Setting> values, const CrossForm& form) {
  SynthOptions o;
  o.layout = Layout::image_slice;
  o.slice = 12;
  const CrossSlice slice{synthesize(bind_model(truth, std::move(values), 1), o)};
  return fit_case(ggx, form, glass, 0.5, slice, Metric::log);
}

TEST(CrossFit, EveryMaskingTermComesBackFromASliceOfItsOwn) {
  for (const auto& f : cross_forms(ggx)) {
    if (f.kind != "masking") continue;
    const auto spec = fmt::format("ggx/{}/dielectric", f.name.substr(f.name.find('.') + 1));
    const auto c = fitted(spec, {{"roughness", {0.5}}, {"eta", {1.5}}}, f);
    EXPECT_TRUE(c.converged) << f.name;
    EXPECT_NEAR(c.find("roughness")->fitted, 0.5, 5e-7) << f.name;
    EXPECT_NEAR(c.find("f0")->fitted, 0.04, 1e-6) << f.name;
    EXPECT_LT(c.log_rms, 1e-6) << f.name;
  }
}

TEST(CrossFit, EveryFresnelTermOfF0ComesBackFromASliceOfItsOwn) {
  for (const auto* name :
       {"schlick", "schlick.ue", "schlick.spherical_gaussian", "constant", "linear.as_written"}) {
    const auto spec = fmt::format("ggx/smith_ggx.correlated/{}", name);
    const auto c = fitted(spec, {{"roughness", {0.5}}, {"f0", {0.04}}}, {name, "fresnel", spec});
    EXPECT_NEAR(c.find("roughness")->fitted, 0.5, 5e-7) << name;
    EXPECT_NEAR(c.find("f0")->fitted, 0.04, 1e-6) << name;
    EXPECT_LT(c.log_rms, 1e-6) << name;
  }
}

TEST(CrossFit, ASphericalGaussianStandsForSchlickWithALittleLessF0) {
  const auto c = fitted("ggx/smith_ggx.correlated/schlick", {{"roughness", {0.5}}, {"f0", {0.04}}},
                        {"", "fresnel", "ggx/smith_ggx.correlated/schlick.spherical_gaussian"});
  EXPECT_NEAR(c.find("roughness")->fitted, 0.5, 5e-4);
  EXPECT_LT(c.find("f0")->fitted, 0.04);
  EXPECT_GT(c.find("f0")->fitted, 0.036);
}

TEST(CrossFit, WhatIsPiTimesABrdfIsFittedToPiTimesTheTruth) {
  const std::string spec = "ggx/smith_ggx.correlated/constant";
  const auto c = fitted(spec, {{"roughness", {0.5}}, {"f0", {0.1}}}, {"", "fresnel", spec, {}, pi});
  EXPECT_NEAR(c.find("f0")->fitted, 0.1 * pi, 1e-6);
  EXPECT_NEAR(c.find("roughness")->fitted, 0.5, 5e-7);
}

TEST(CrossFit, ExactFormsOfAReportComeBack) {
  auto o = cross_fit_options(true);
  o.roughness = {0.1, 0.6};
  o.roughness.resize(test::few(2));
  o.bins = 10;
  o.walks = 16;
  o.forms = {"none of them"};
  const auto r = cross_fit_rows(o);
  std::set<std::string> truths;
  for (const auto& c : r.cases) {
    truths.insert(c.truth);
    ASSERT_EQ(c.fitted, "exact");
    if (c.truth == "GGX, all orders") continue;
    EXPECT_LT(c.log_rms, 1e-6) << c.truth << " " << c.material;
    for (const auto& v : c.values)
      EXPECT_NEAR(v.fitted, v.truth, 1e-6 * std::max(1.0, v.truth))
          << c.truth << " " << c.material << " " << c.roughness << " " << v.parameter;
  }
  EXPECT_EQ(truths.size(), 2 + o.gamma.size());
}

TEST(CrossFit, AFreeGammaIsTwoOfGgxAndLessOfItWithAllOrders) {
  const auto r = cross_fit_rows(few({"ndf.gtr"}));
  EXPECT_NEAR(find(r, "GGX", "ndf.gtr").find("gamma")->fitted, 2, 1e-5);
  const auto* all = find(r, "GGX, all orders", "ndf.gtr").find("gamma");
  EXPECT_LT(all->fitted, 2 - 3 * all->error);
  EXPECT_GT(all->error, 0);
}

TEST(CrossFit, TheTruthOfAllOrdersReflectsWhatTheHalfSpaceDoes) {
  const auto m = bound_truth({"", "ggx", "smith_ggx.correlated", {}, true}, gold, 0.9);
  const Direction v = direction(std::acos(0.6), 0);
  const auto nodes = cosine_hemisphere(8, 8);
  std::vector<DirectionPair> pairs;
  for (const auto& n : nodes) pairs.push_back({n.direction, v});
  const auto first = beyond_one_facet(m, pairs, 2048, 1),
             second = beyond_one_facet(m, pairs, 2048, 2);
  const double mu[] = {0.6};
  const auto exact = half_space(m, mu);
  for (std::size_t c = 0; c < 3; ++c) {
    double sum = 0, variance = 0, later = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      sum += nodes[i].weight * (first[c][i] + second[c][i]) / 2;
      variance += std::pow(nodes[i].weight * (first[c][i] - second[c][i]) / 2, 2);
    }
    for (std::size_t n = 1; n < exact.at[0].order[c].size(); ++n) later += exact.at[0].order[c][n];
    EXPECT_NEAR(sum, later, 4 * std::sqrt(variance) + 1e-3);
    EXPECT_LT(std::sqrt(variance), 0.01 * later);
  }
}

/// A slice of glass.
CrossSlice slice_of(const CrossTruth& t,
                    double roughness,
                    const CrossLayout& layout,
                    const CrossFitOptions& o) {
  return slices_of(t, {&glass, 1}, roughness, layout, o)[0];
}

TEST(CrossFit, SlicesThatShareTheirWalksAreThoseThatEachHasAlone) {
  const auto o = few({});
  const CrossTruth all{"", "ggx", "smith_ggx.correlated", {}, true};
  const std::array metals{gold, metal(*find_metal("Al"))};
  const auto together = slices_of(all, metals, 0.8, cross_layouts[0], o);
  ASSERT_EQ(together.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    const auto alone = slices_of(all, {&metals[k], 1}, 0.8, cross_layouts[0], o)[0];
    EXPECT_EQ(together[k].log_error, alone.log_error);
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < alone.table.size(); ++i)
        if (std::isfinite(alone.table.values[c][i])) {
          ASSERT_EQ(together[k].table.values[c][i], alone.table.values[c][i]);
          ASSERT_EQ(together[k].half->values[c][i], alone.half->values[c][i]);
        }
  }
}

TEST(CrossFit, ASliceOfAllOrdersIsBrighterAndSaysWhatItsWalksLeaveOpen) {
  const auto o = few({});
  const CrossTruth all{"", "ggx", "smith_ggx.correlated", {}, true};
  const auto once = slice_of(ggx, 0.8, cross_layouts[0], o),
             more = slice_of(all, 0.8, cross_layouts[0], o);
  EXPECT_FALSE(once.half);
  ASSERT_TRUE(more.half);
  EXPECT_EQ(once.log_error, 0);
  EXPECT_GT(more.log_error, 0);
  const SampleAngles at(once.table);
  for (std::size_t i = 0; i < once.table.size(); ++i) {
    const bool seen = std::min(at(i).nol, at(i).nov) > std::cos(80 * degree);
    ASSERT_EQ(std::isfinite(once.table.values[0][i]), seen);
    if (seen) {
      EXPECT_GE(more.table.values[0][i], once.table.values[0][i]);
    }
  }
}

TEST(CrossFit, ThreeTimesTheBinsGiveMuchTheSame) {
  auto o = few({});
  o.bins = cross_fit_options(false).bins;
  const auto forms = cross_forms(ggx);
  for (const auto* name : {"fresnel.schlick", "masking.schlick_ggx.direct"}) {
    const auto& form = *std::ranges::find(forms, name, &CrossForm::name);
    for (const double roughness : {0.1, 0.6}) {
      const auto over = [&](const CrossLayout& layout) {
        const auto slice = slice_of(ggx, roughness, layout, o);
        return fit_case(ggx, form, glass, roughness, slice, Metric::log);
      };
      const auto quick = over(cross_layouts[0]), fine = over(cross_layouts[1]);
      EXPECT_NEAR(quick.find("roughness")->shift(), fine.find("roughness")->shift(), 0.003) << name;
      EXPECT_NEAR(quick.find("f0")->shift(), fine.find("f0")->shift(), 0.03) << name;
      EXPECT_NEAR(quick.log_rms, fine.log_rms, 0.1 * fine.log_rms) << name;
    }
  }
}

TEST(CrossFit, UnrealsSchlickIsSchlickFromAnF0Of2PercentOn) {
  const auto r = cross_fit_rows(few({"fresnel.schlick", "fresnel.schlick.ue"}));
  for (const auto* p : {"roughness", "f0"})
    EXPECT_NEAR(find(r, "GGX", "fresnel.schlick").find(p)->fitted,
                find(r, "GGX", "fresnel.schlick.ue").find(p)->fitted, 1e-7);
}

TEST(CrossFit, WhatEndsAtABoundIsToldAsSuch) {
  // masking that takes more than Smith's: gold would have to reflect more than all
  const auto r = cross_fit_rows(few({"masking.implicit"}, {"Au"}));
  const auto* red = find(r, "GGX", "masking.implicit", "gold").find("f0", "red");
  EXPECT_EQ(red->status, ParameterStatus::at_bound);
  const auto j = nlohmann::json::parse(to_json(report_of(false, r)));
  EXPECT_TRUE(
      std::ranges::any_of(j["rows"], [](const auto& x) { return x["status"] == "at_bound"; }));
}

TEST(CrossFit, RowsAreFlatAndHaveTheKeysOfTheContract) {
  const auto r = cross_fit_rows(few({"fresnel.schlick"}, {"Au"}));
  const auto j = nlohmann::json::parse(to_json(report_of(false, r)));
  ASSERT_FALSE(j["rows"].empty());
  for (const auto& x : j["rows"]) {
    for (const auto* key :
         {"truth", "fitted", "parameter", "true_value", "fitted_value", "residual_log_rms"})
      ASSERT_TRUE(x.contains(key)) << key;
    for (const auto& [key, value] : x.items()) EXPECT_TRUE(value.is_primitive()) << key;
  }
}

TEST(CrossFit, PicturesShowWhatWasFittedAndLeaveOutWhatEndsAtABound) {
  const auto r = cross_fit_rows(few({"masking.implicit", "fresnel.schlick"}, {"Au"}));
  const auto p = pictures(r);
  test::expect_whole(p);
  const FigureChoices masking{
      {"truth", "GGX"}, {"kind", "masking"}, {"material", "IOR 1.5"}, {"quantity", "roughness"}};
  const auto f = std::ranges::find(p.figures, masking, &Figure::choices);
  ASSERT_NE(f, p.figures.end());
  ASSERT_EQ(f->curves.size(), 2U);  // the exact form beside it
  const auto* v = find(r, "GGX", "masking.implicit").find("roughness");
  EXPECT_EQ(f->curves[1].y[0], v->fitted - v->truth);

  const FigureChoices all{{"quantity", "F0"}, {"roughness", "all"}};
  const auto& m = *std::ranges::find(p.maps, all, &FigureMap::choices);
  const auto cell = [&](std::string_view truth, std::string_view form) {
    const auto x = std::ranges::find(m.x.names, truth) - m.x.names.begin(),
               y = std::ranges::find(m.y.names, form) - m.y.names.begin();
    return m.values[static_cast<std::size_t>(x) * m.y.size() + static_cast<std::size_t>(y)];
  };
  EXPECT_GT(cell("GGX: dielectrics", "Implicit"), 1);
  EXPECT_TRUE(std::isnan(cell("GGX: metals", "Implicit")));
  EXPECT_EQ(cell("GGX: metals", "exact"), 0);
}

TEST(CrossFit, IsTheSameWhateverTheThreads) {
  GONIO_MANY_FITS();
  const auto o = few({"fresnel.schlick", "ndf.gtr"});
  std::string one;
  {
    const tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
    one = to_json(cross_fit_report(o));
  }
  EXPECT_EQ(one, to_json(cross_fit_report(o)));
}

/// Range of F0 of glass, by form, metric and directions.
const CrossRange& range(const std::vector<CrossRange>& all,
                        std::string_view form,
                        Metric metric,
                        std::string_view layout) {
  return *std::ranges::find_if(all, [&](const CrossRange& x) {
    return x.fitted == form && x.metric == metric && x.layout == layout && x.parameter == "f0";
  });
}

TEST(CrossFit, F0BelongsToMetricAndDirections) {
  GONIO_MANY_FITS();
  auto o = few({"fresnel.schlick", "masking.schlick_ggx.direct"});
  o.roughness = {0.1, 0.4, 0.7, 1};
  o.gamma = {};
  o.bins = cross_fit_options(false).bins;
  const auto all = ranges(cross_fit_rows(o));
  struct Known {
    const char* form;
    Metric metric;
    const char* layout;
    double least, most;
  };
  constexpr double near = 0.03;
  for (const auto& k :
       {Known{"masking.schlick_ggx.direct", Metric::log, "image_slice", 0.02, 0.38},
        {"masking.schlick_ggx.direct", Metric::l2_cosine, "image_slice", -0.40, -0.20},
        {"masking.schlick_ggx.direct", Metric::log, "hemisphere", 0.055, 0.26},
        {"fresnel.schlick", Metric::log, "image_slice", 0.05, 0.095},
        {"fresnel.schlick", Metric::l2_cosine, "image_slice", 0.15, 0.41},
        {"fresnel.schlick", Metric::log, "hemisphere", -0.21, 0.06}}) {
    const auto& x = range(all, k.form, k.metric, k.layout);
    EXPECT_NEAR(x.least, k.least, near) << k.form << " " << name_of(k.metric) << " " << k.layout;
    EXPECT_NEAR(x.most, k.most, near) << k.form << " " << name_of(k.metric) << " " << k.layout;
    EXPECT_EQ(x.fits, o.roughness.size());
  }
  EXPECT_TRUE(std::ranges::none_of(
      all, [](const CrossRange& x) { return x.layout == "image_slice_finer"; }));
}

TEST(CrossFit, BothApproximationsTogetherBendTheTail) {
  GONIO_MANY_FITS();
  auto o = few({"gtr/schlick_ggx.direct/schlick"});
  o.roughness = {0.3};
  o.bins = cross_fit_options(false).bins;
  const auto r = cross_fit_rows(o);
  EXPECT_NEAR(find(r, "GGX", "gtr/schlick_ggx.direct/schlick").find("gamma")->shift(), -0.29, 0.02);
}

TEST(CrossFit, APublishedSliceIsWhatItsAuthorsWrote) {
  const double kd = 0.1, a = 30, b = 200, c = 1.5, eta = 1.4;
  const Table t = published_slice(kd, a, b, c, eta, 20);
  const SampleAngles at(t);
  std::size_t seen = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (!std::isfinite(t.values[0][i])) continue;
    const auto x = at(i);
    const double in = std::acos(x.voh), out = std::asin(std::sin(in) / eta);
    const double rs = std::sin(in - out) / std::sin(in + out),
                 rp = std::tan(in - out) / std::tan(in + out);
    const double g = std::min({1.0, 2 * x.noh * x.nov / x.voh, 2 * x.noh * x.nol / x.voh});
    const double s = std::pow(1 + b * (1 - x.noh), -c);
    EXPECT_NEAR(t.values[0][i],
                kd / pi + a * (rs * rs + rp * rp) / 2 * g * s / (pi * x.nol * x.nov),
                1e-9 * t.values[0][i]);
    ++seen;
  }
  EXPECT_GT(seen, 100U);
}

TEST(CrossFit, MeasuredTailsAreFoundAsPublished) {
  GONIO_MANY_FITS();
  // red specular plastic: a narrow core, whose tail goes on far below GGX's
  const auto all = published_fits(20);
  ASSERT_EQ(all.size(), 20U);
  const auto& plastic = *std::ranges::find(all, "red-specular-plastic", &PublishedFit::material);
  EXPECT_TRUE(plastic.gamma_determined);
  EXPECT_NEAR(plastic.gamma, plastic.tail, 0.02);
  EXPECT_NEAR(plastic.gtr_roughness, plastic.width, 0.003);
  EXPECT_LT(plastic.gtr_log_rms, plastic.ggx_log_rms / 10);
}

/// Everything that can be told: all forms of sentences, of all materials.
const CrossFitRows& all_kinds() {
  static const CrossFitRows rows = [] {
    auto o = few({"fresnel.schlick", "masking.schlick_ggx.direct", "masking.ue_joint",
                  "masking.implicit", "ndf.gtr", "gtr/schlick_ggx.direct/schlick",
                  "lambert+ggx/smith_ggx.correlated/exact", "ggx/smith_ggx.correlated/exact"},
                 {"Au"});
    o.published = true;
    return cross_fit_rows(o);
  }();
  return rows;
}

TEST(CrossFit, WhatIsSaidCanBeReadAloud) {
  GONIO_MANY_FITS();
  auto r = all_kinds();
  const auto expect = [&] {
    test::expect_plain(findings(r));
    for (const auto& s : sentences_of_forms(r)) test::expect_plain(s.sentence);
  };
  expect();
  EXPECT_GE(findings(r).sentences.size(), 15U);
  for (auto& c : r.cases) {
    c.converged = false;
    for (auto& v : c.values) v.fitted = 1.2345 * v.truth, v.error = 0.001234;
    c.log_rms_truth = 0.01234;
  }
  for (auto& p : r.published) p.tail = 3;
  expect();
  for (auto& c : r.cases)
    for (auto& v : c.values) v.fitted = 0.2345 * v.truth, v.status = ParameterStatus::at_bound;
  expect();
}

TEST(CrossFit, NoiseOfTheWalksStandsBesideTheResidual) {
  GONIO_MANY_FITS();
  const auto& r = all_kinds();
  const auto p = pictures(r);
  const auto f = std::ranges::find_if(p.figures, [](const Figure& x) {
    return x.family == "shifts" && x.title == "Residual" && x.note.starts_with("GGX, all orders");
  });
  ASSERT_NE(f, p.figures.end());
  const auto noise = std::ranges::find(f->curves, "noise of the random walks", &FigureCurve::name);
  ASSERT_NE(noise, f->curves.end());
  EXPECT_EQ(noise->y, std::vector<double>{find(r, "GGX, all orders", "exact").log_rms_truth});
  EXPECT_TRUE(std::ranges::any_of(findings(r).sentences, [](const std::string& s) {
    return s.find("is noise of the random walks") != s.npos;
  }));
}

TEST(CrossFit, TheFirstPictureIsWhatTheHeadlineIsOf) {
  GONIO_MANY_FITS();
  EXPECT_EQ(pictures(all_kinds()).figures[0].note, "GGX, IOR 1.5");
  EXPECT_EQ(pictures(all_kinds()).figures[0].title, "Shift of F0");
  EXPECT_TRUE(std::ranges::any_of(
      pictures(all_kinds()).figures[0].curves,
      [](const FigureCurve& c) { return label_of(c) == "Schlick's k = (r+1)²/8"; }));
}

TEST(CrossFit, NoShiftIsThatOfAValueWithoutAnInterval) {
  GONIO_MANY_FITS();
  auto r = all_kinds();
  const auto headline = findings(r).headline;
  std::size_t without = 0, all = 0;
  for (auto& c : r.cases)
    for (auto& v : c.values) {
      if (c.fitted == "masking.schlick_ggx.direct" && v.parameter == "f0") {
        v.status = ParameterStatus::unbounded;
        v.fitted = -7 * v.truth;
      }
      ++all, without += v.status != ParameterStatus::free;
    }
  EXPECT_NE(findings(r).headline, headline);
  const auto said = findings(r).sentences;
  EXPECT_TRUE(
      std::ranges::none_of(said, [](const std::string& s) { return s.find("−800") != s.npos; }));
  EXPECT_TRUE(std::ranges::any_of(said, [&](const std::string& s) {
    return s.starts_with(fmt::format("{} of {} fitted parameters have no interval", without, all));
  }));
}

TEST(CrossFit, FindingsFollowTheFigures) {
  auto r = all_kinds();
  const auto said = [&](std::string_view words) {
    const auto all = findings(r).sentences;
    return std::ranges::any_of(all, [&](const std::string& f) { return f.find(words) != f.npos; });
  };
  EXPECT_TRUE(findings(r).headline.starts_with(
      "A fit of glass with Schlick's k = (r+1)²/8 gets F0 wrong by "))
      << findings(r).headline;
  EXPECT_TRUE(said("fitted with Schlick in place of exact Fresnel"));
  EXPECT_TRUE(said("gives its parameters back."));
  EXPECT_TRUE(said("fits converged."));
  EXPECT_TRUE(said("measured materials of MERL by Löw and others."));
  EXPECT_EQ(findings(r).claims[0].judged, Claim::Judged::holds) << "on GGX's tail";
  EXPECT_TRUE(
      said("On a slice down to the horizon, where no instrument is trusted, it is off by "));
  const auto headline = findings(r).headline;
  const auto from = headline.find("off by ") + 4;
  const auto elsewhere = headline.substr(from, headline.find(" when fitted") - from);
  EXPECT_FALSE(said("no instrument is trusted, it is off " + elsewhere)) << "a range of its own";
  EXPECT_FALSE(said("GTR's gamma shifts by −")) << "no interval is known of it here";
  for (auto& c : r.cases)
    if (c.fitted == "gtr/schlick_ggx.direct/schlick")
      for (auto& v : c.values) v.status = ParameterStatus::free;
  EXPECT_TRUE(said("GTR's gamma shifts by −"));
  for (auto& c : r.cases)
    if (c.fitted == "exact") c.values[0].fitted += 0.1, c.converged = false;
  EXPECT_TRUE(said("back only roughly"));
  EXPECT_TRUE(said("did not converge"));
}

}  // namespace
}  // namespace gonio
