#include "table/health/health.h"

#include <cmath>
#include <limits>

#include "support.h"
#include "table/example.h"

namespace gonio {
namespace {

using namespace test;
using std::numbers::pi;

Table lambertian(const Grid& g, const std::string& format) {
  return on_grid(g, format, {"r", "g", "b"},
                 [](const auto&, std::size_t c) { return 0.25 * static_cast<double>(c + 1) / pi; });
}

TEST(Albedo, OfALambertianTableIsItsReflectance) {
  for (const auto bins : {Bins::centre, Bins::edge})
    for (const Table& t :
         {lambertian(merl_grid(bins), "merl"), lambertian(merl_grid(bins, false), "merl"),
          lambertian(mbsdf_grid(45, 90, bins), "mbsdf")}) {
      const auto h = inspect(t);
      ASSERT_EQ(h.albedo.size(), 6U);
      for (std::size_t k = 0; k < 6; ++k) {
        EXPECT_EQ(h.albedo[k].theta_i_deg, 15 * static_cast<double>(k));
        EXPECT_GT(h.albedo[k].coverage, 0.98) << t.format << " at " << h.albedo[k].theta_i_deg;
        for (std::size_t c = 0; c < 3; ++c)
          EXPECT_NEAR(h.albedo[k].albedo[c], 0.25 * static_cast<double>(c + 1), 1e-12);
      }
      EXPECT_FALSE(h.peak) << "a Lambertian surface has none";
    }
}

Table hemisphere(double step) {
  Table t;
  t.format = "csv";
  t.channels = {"f"};
  DirectionList l;
  std::vector<double> f;
  for (const double in : {0.0, 40.0})
    for (double out = 0; out < 88; out += step)
      for (double phi = 0; phi < 360; phi += 10) {
        l.theta_i_deg.push_back(in);
        l.phi_i_deg.push_back(0);
        l.theta_o_deg.push_back(out);
        l.phi_o_deg.push_back(phi);
        f.push_back(std::cos(out * degree) * 3 / (2 * pi));
      }
  t.where = l;
  t.values.emplace_back(f.begin(), f.end());
  return t;
}

TEST(Albedo, OfAListThatCoversTheHemisphereIsItsIntegral) {
  const auto h = inspect(hemisphere(4));
  ASSERT_EQ(h.albedo.size(), 2U);
  EXPECT_EQ(h.albedo[1].theta_i_deg, 40);
  EXPECT_NEAR(h.albedo[1].albedo[0], 1, 0.01);
  EXPECT_EQ(h.albedo[1].coverage, 1);
}

TEST(Albedo, IsLeftOutWhereTheSamplesDoNotSpeakForAHemisphere) {
  EXPECT_TRUE(inspect(hemisphere(30)).albedo.empty());
  Table peaked = hemisphere(4);
  peaked.values[0].back() = 1000;
  EXPECT_EQ(inspect(peaked).albedo.size(), 1U) << "one sample would decide";
  EXPECT_TRUE(inspect(csv_example()).albedo.empty());
  EXPECT_TRUE(inspect(slice_example()).albedo.empty());
}

TEST(Albedo, IsNotANumberWhereMostOfTheHemisphereLacks) {
  Table t = lambertian(mbsdf_grid(45, 90, Bins::centre), "mbsdf");
  for (std::size_t i = 0; i < t.size(); ++i)
    if (t.grid()->unravel(i)[1] < 35) t.values[0][i] = -1e-3;
  const auto h = inspect(t);
  EXPECT_TRUE(std::isnan(h.albedo[2].albedo[0]));
  EXPECT_NEAR(h.albedo[2].albedo[1], 0.5, 1e-12);
  EXPECT_LT(h.albedo[2].coverage, 0.2);
}

TEST(Health, CountsEachValueOnce) {
  Table t = lambertian(mbsdf_grid(45, 90, Bins::centre), "mbsdf");
  t.values[0][0] = -0.5;
  t.values[0][1] = -1.5;
  t.values[0][2] = -1;
  t.values[1][0] = std::numeric_limits<double>::quiet_NaN();
  t.values[1][1] = std::numeric_limits<double>::infinity();
  t.values[2][7] = 9;
  const auto h = inspect(t);
  EXPECT_EQ(h.samples, 45U * 45 * 90);
  EXPECT_EQ(h.values, 3 * h.samples);
  EXPECT_EQ(h.masked[static_cast<std::size_t>(Mask::negative)], 3U);
  EXPECT_EQ(h.masked[static_cast<std::size_t>(Mask::not_finite)], 2U);
  EXPECT_EQ(h.valid, h.values - 5);
  EXPECT_EQ(h.largest, 9);
  EXPECT_NEAR(h.smallest_positive, 0.25 / pi, 1e-15);
  EXPECT_EQ(h.noise_floor, 0) << "three of half a million tell nothing";
}

/// A tenth of the values is negative, −k/1000 in no order.
Table noisy() {
  Table t = lambertian(mbsdf_grid(10, 10, Bins::centre), "mbsdf");
  for (auto& plane : t.values)
    for (std::size_t i = 0; i < plane.size(); i += 10)
      plane[i] = -1e-3 * static_cast<double>(i / 10 * 37 % 100 + 1);
  return t;
}

TEST(NoiseFloor, IsTheSpreadOfTheNegativeValues) {
  Table t = noisy();
  EXPECT_NEAR(noise_floor(t), 1.4826 * 0.05, 2e-3);
  EXPECT_EQ(inspect(t).noise_floor, noise_floor(t));
  t.values[0][0] = -std::numeric_limits<double>::infinity();
  t.values[0][10] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NEAR(noise_floor(t), 1.4826 * 0.05, 2e-3);
}

TEST(NoiseFloor, IsZeroWhereNegativesAreAMarkOrFew) {
  Table t = noisy();
  t.negative_is_noise = false;
  EXPECT_EQ(noise_floor(t), 0);
  t = noisy();
  for (auto& plane : t.values)
    for (std::size_t i = 0; i < 600; i += 10) plane[i] = -1;
  EXPECT_EQ(noise_floor(t), 0) << "more than half are -1";
  t = lambertian(mbsdf_grid(10, 10, Bins::centre), "mbsdf");
  t.values[0][0] = -1;
  t.values[1][0] = -2;
  EXPECT_EQ(noise_floor(t), 0) << "2 of 3000";
  t.values[2][0] = -3;
  EXPECT_NEAR(noise_floor(t), 2 * 1.4826, 1e-12) << "3 of 3000";
}

TEST(NoiseFloor, CountsNoValueBelowTheHorizon) {
  Table t = hemisphere(4);
  auto& theta_o = std::get<DirectionList>(t.where).theta_o_deg;
  for (std::size_t i = 0; i < t.size(); i += 3) {
    theta_o[i] = 100;
    t.values[0][i] = -1 - static_cast<double>(i);
  }
  EXPECT_EQ(noise_floor(t), 0);
}

TEST(Health, TakesMerlsNegativesForNoDataAndNotForNoise) {
  Table t = merl_example();
  t.values[0][0] = -1;
  const auto h = inspect(t);
  EXPECT_EQ(h.noise_floor, 0);
  EXPECT_EQ(h.masked[static_cast<std::size_t>(Mask::negative)], 1U);
  EXPECT_GT(h.masked[static_cast<std::size_t>(Mask::below_horizon)], 0U);
}

TEST(Reciprocity, IsExactForAReciprocalTable) {
  const auto h = inspect(mbsdf_example());
  ASSERT_TRUE(h.reciprocity_error);
  EXPECT_LT(*h.reciprocity_error, 1e-6);
  EXPECT_LT(*inspect(merl_example(0.2, Bins::centre, false)).reciprocity_error, 1e-12);
}

TEST(Reciprocity, IsTheMedianOverExchangedPairs) {
  Table t = lambertian(mbsdf_grid(6, 3, Bins::centre), "mbsdf");
  for (auto& plane : t.values)
    for (std::size_t i = 0; i < t.size(); ++i) {
      const auto [a, b, c] = t.grid()->unravel(i);
      if (a > b) plane[i] *= 1.5;
    }
  EXPECT_NEAR(*inspect(t).reciprocity_error, 0.5 / 1.25, 1e-12);
}

TEST(Reciprocity, IsAbsentWhereTheLayoutHoldsEachPairOnce) {
  for (const Table& t : {merl_example(), slice_example()}) {
    const auto h = inspect(t);
    EXPECT_FALSE(h.reciprocity_error);
    EXPECT_EQ(h.reciprocity_note, "cannot be checked: the layout holds each reciprocal pair once");
  }
}

TEST(Reciprocity, FindsPairsInAList) {
  Table t;
  t.channels = {"f"};
  t.where = DirectionList{{10, 30, 50}, {0, 0, 0}, {30, 10, 20}, {180, -180, 0}};
  t.values = {{1, 2, 3}};
  EXPECT_NEAR(*inspect(t).reciprocity_error, 1 / 1.5, 1e-12)
      << "turned by 180 degrees: one azimuth";
  t.where = DirectionList{{10, 30, 50}, {5, 180, 0}, {30, 10, 20}, {180, 365, 0}};
  EXPECT_NEAR(*inspect(t).reciprocity_error, 1 / 1.5, 1e-12);
  t.where = DirectionList{{10, 30, 50}, {5, 180, 0}, {30, 10, 20}, {180, 4, 0}};
  EXPECT_FALSE(inspect(t).reciprocity_error);
}

TEST(Reciprocity, OfTheMeasuredTablesIsAsDocumented) {
  GONIO_NEEDS_SHARED(paint, "data/mbsdf/carpaint_blue.mbsdf");
  GONIO_NEEDS_SHARED(modules, "data/mbsdf/example_modules.mbsdf");
  const auto h = inspect(read_table(paint));
  EXPECT_EQ(h.masked[static_cast<std::size_t>(Mask::negative)], 75'159U);
  EXPECT_EQ(h.values, 546'750U);
  EXPECT_NEAR(h.largest, 8.9, 0.05);
  EXPECT_NEAR(*h.reciprocity_error, 0.23, 0.0005);
  EXPECT_NEAR(*inspect(read_table(modules)).reciprocity_error, 0.0505, 0.0005);
}

TEST(Peak, GivesTheWidthOfAGgxLobeBack) {
  for (const double alpha : {0.02, 0.05, 0.1, 0.2, 0.35}) {
    for (const auto bins : {Bins::centre, Bins::edge}) {
      const auto h = inspect(merl_example(alpha, bins));
      ASSERT_TRUE(h.peak) << alpha;
      EXPECT_NEAR(h.peak->alpha / alpha, 1, 0.03) << alpha;
      EXPECT_TRUE(h.peak->resolved);
      ASSERT_TRUE(h.peak->bin_sensitivity);
      EXPECT_EQ(*h.peak->bin_sensitivity < 0, bins == Bins::centre) << "edges are below centres";
    }
    const auto slice = on_grid(image_slice_grid(90, 90, pi / 2, Bins::centre), "exr", {"f"},
                               [&](const auto& a, std::size_t) { return lobe(a, alpha, 0.2); });
    EXPECT_NEAR(inspect(slice).peak->alpha / alpha, 1, 0.03) << alpha;
  }
  const auto coarse = on_grid(mbsdf_grid(45, 90, Bins::centre), "mbsdf", {"f"},
                              [&](const auto& a, std::size_t) { return lobe(a, 0.2, 0.2); });
  EXPECT_NEAR(inspect(coarse).peak->alpha / 0.2, 1, 0.04);
}

TEST(Peak, NarrowerThanTheSamplesIsNotResolved) {
  const auto narrow = on_grid(mbsdf_grid(45, 90, Bins::centre), "mbsdf", {"f"},
                              [&](const auto& a, std::size_t) { return lobe(a, 0.002, 0.2); });
  const auto h = inspect(narrow);
  ASSERT_TRUE(h.peak);
  EXPECT_FALSE(h.peak->resolved);
}

TEST(InspectJson, HasTheDocumentedKeys) {
  Table t = mbsdf_example();
  const auto text = to_json(t, inspect(t));
  for (const char* key : {"path",
                          "format",
                          "channels",
                          "samples",
                          "values",
                          "valid",
                          "masked",
                          "below_horizon",
                          "negative",
                          "not_finite",
                          "bins",
                          "bin_sensitivity",
                          "noise_floor",
                          "largest",
                          "smallest_positive",
                          "albedo",
                          "theta_i_deg",
                          "coverage",
                          "reciprocity_error",
                          "reciprocity_note",
                          "peak",
                          "limit",
                          "in_words",
                          "peak_profiles",
                          "peak_contrast",
                          "retro",
                          "noise",
                          "sigma",
                          "over_zenith",
                          "over_value",
                          "copied_columns",
                          "prospects",
                          "verdict",
                          "because",
                          "truth"})
    EXPECT_NE(text.find(std::string("\"").append(key).append("\": ")), std::string::npos) << key;
  EXPECT_NE(text.find("\"truth\": null"), std::string::npos);
  t.truth = truth_example();
  EXPECT_NE(to_json(t, inspect(t)).find("\"seed\": 18446744073709551615"), std::string::npos);
}

TEST(Health, CountsIncidentAnglesThatOnlyRepeatAnother) {
  Table t;
  t.format = "mbsdf";
  t.channels = {"f"};
  t.where = mbsdf_grid(5, 4, Bins::centre);
  t.values.resize(1);
  for (std::size_t row = 0; row < 5; ++row)
    for (std::size_t i = 0; i < 20; ++i)
      t.values[0].push_back(static_cast<double>(i + 100 * std::min<std::size_t>(row, 2)));
  EXPECT_EQ(first_of_copies(t), (std::vector<std::size_t>{0, 1, 2, 2, 2}));
  EXPECT_EQ(inspect(t).copied_rows, 2U);
  t.values[0].assign(100, 0.3);  // the same everywhere is no copy
  EXPECT_EQ(inspect(t).copied_rows, 0U);
  t.where = merl_grid(Bins::centre);
  EXPECT_TRUE(first_of_copies(t).empty());
}

TEST(Health, CountsOutgoingAnglesThatOnlyRepeatAnother) {
  Table t = mbsdf_example(5, 4);
  EXPECT_EQ(inspect(t).copied_columns, 0U);
  for (auto& plane : t.values)
    for (std::size_t row = 0; row < 5; ++row)
      std::copy_n(&plane[row * 20 + 2 * 4], 4, &plane[row * 20 + 3 * 4]);
  EXPECT_EQ(first_of_copies(t, 1), (std::vector<std::size_t>{0, 1, 2, 2, 4}));
  EXPECT_EQ(inspect(t).copied_columns, 1U);
  EXPECT_EQ(inspect(t).copied_rows, 0U);
  t.values[2][3 * 4] += 1;  // one value of one channel differs
  EXPECT_EQ(inspect(t).copied_columns, 0U);
}

TEST(Peak, OneSampleWideIsTheInstruments) {
  Table t;
  t.format = "csv";
  t.channels = {"f"};
  DirectionList l;
  std::vector<double> f;
  for (const double in : {10.0, 20.0, 30.0, 40.0})
    for (double out = -80; out <= 80; out += 1) {
      l.theta_i_deg.push_back(in);
      l.phi_i_deg.push_back(0);
      l.theta_o_deg.push_back(std::abs(out));
      l.phi_o_deg.push_back(out < 0 ? 0 : 180);
      f.push_back(out == in ? 8000 : 1e-4);
    }
  t.where = l;
  t.values.emplace_back(f.begin(), f.end());
  const auto h = inspect(t);
  ASSERT_TRUE(h.peak);
  EXPECT_EQ(h.peak->limit, PeakLimit::samples);
  EXPECT_EQ(h.peak->samples_within, 1);
  EXPECT_NE(peak_in_words(*h.peak).find("one sample wide"), std::string::npos);
  EXPECT_EQ(h.prospects[0].verdict, Verdict::weakly);
}

TEST(Peak, OfAlphaBelow002InMerlIsLimitedByTheBins) {
  EXPECT_EQ(inspect(merl_example(0.01)).peak->limit, PeakLimit::bins);
  EXPECT_EQ(inspect(merl_example(0.05)).peak->limit, PeakLimit::none);
}

/// A lobe around wo = wi as the other is around the half vector.
Table retro_reflective(const Grid& g, const std::string& format, double share) {
  return on_grid(g, format, {"f"}, [&](const auto& a, std::size_t) {
    const double q = a.voh * a.voh * 0.04 + (1 - a.voh * a.voh);
    return 0.1 + share * 0.04 / (q * q) + (1 - share) * lobe(a, 0.2, 0);
  });
}

TEST(Retro, IsSeenWhereTheHighlightSitsAtTheIncidentDirection) {
  for (const auto& [grid, format] : {std::pair(mbsdf_grid(45, 90, Bins::centre), "mbsdf"),
                                     std::pair(merl_grid(Bins::centre), "merl")}) {
    const auto h = inspect(retro_reflective(grid, format, 1));
    ASSERT_TRUE(h.retro) << format;
    EXPECT_GT(h.retro->height, 10 * h.retro->base);
    EXPECT_EQ(h.prospects[0].verdict, Verdict::no);
    EXPECT_NE(h.prospects[0].because.find("wo = wi"), std::string::npos);
    EXPECT_TRUE(inspect(retro_reflective(grid, format, 0.9)).retro) << "with a little gloss";
    EXPECT_FALSE(inspect(retro_reflective(grid, format, 0.05)).retro) << "the gloss is higher";
  }
}

TEST(Retro, IsNotSeenInGlossOrLambertian) {
  EXPECT_FALSE(inspect(mbsdf_example()).retro);
  for (const double alpha : {0.02, 0.2, 0.9}) EXPECT_FALSE(inspect(merl_example(alpha)).retro);
  EXPECT_FALSE(inspect(lambertian(merl_grid(Bins::centre), "merl")).retro);
}

TEST(IncidentAngles, AreNumberedInAscendingOrderAndToldApartByAThousandthOfADegree) {
  DirectionList l;
  l.theta_i_deg = {60, 0, 45, 45.0001, 45.001, 0, -30};
  const auto angles = incident_angles(l);
  EXPECT_EQ(angles.count, 5U);
  EXPECT_EQ(angles.number, (std::vector<std::uint32_t>{4, 1, 2, 2, 3, 1, 0}));
}

}  // namespace
}  // namespace gonio
