// ALTA's tables: each parametrization gives the directions it stands for, and the cosine goes.
#include <algorithm>
#include <bit>

#include "base/error.h"
#include "support.h"
#include "table/foreign.h"
#include "table/format/formats.h"
#include "table/health/health.h"

namespace gonio {
namespace {

using namespace test;
using std::numbers::pi;

Table table_of_alta(const std::string& bytes) {
  const Folder folder;
  return read_table(folder.write("a.dat", bytes));
}

/// wi and wo of one sample, as "(x y z) (x y z)".
std::string alta_directions(const std::string& in, const std::vector<double>& x) {
  std::vector<double> row = x;
  row.push_back(0.5);
  const Table t = table_of_alta(alta_file(in, "INV_STERADIAN", x.size(), 1, {row}));
  EXPECT_EQ(t.values[0][0], 0.5);
  const auto [wi, wo] = SampleAngles(t).directions(0);
  const auto text = [](const Direction& d) {
    return fmt::format("({:.3f} {:.3f} {:.3f})", d.x + 1e-9, d.y + 1e-9, d.z + 1e-9);
  };
  return text(wi) + " " + text(wo);
}

TEST(AltaFile, KnowsParametrizationsOfTwoDirections) {
  EXPECT_EQ(alta_directions("SPHERICAL_TL_PL_TV_PV", {pi / 6, 0, pi / 3, pi / 2}),
            "(0.500 0.000 0.866) (0.000 0.866 0.500)");
  EXPECT_EQ(alta_directions("CARTESIAN", {0.6, 0, 0.8, 0, -0.8, 0.6}),
            "(0.000 -0.800 0.600) (0.600 0.000 0.800)");
  EXPECT_EQ(alta_directions("ISOTROPIC_TL_TV_PROJ_DPHI", {pi / 6, -pi / 6, 0}),
            "(0.500 0.000 0.866) (-0.500 0.000 0.866)");
  EXPECT_EQ(alta_directions("ISOTROPIC_TL_TV_PROJ_DPHI", {pi / 6, 0, pi / 3}),
            "(0.500 0.000 0.866) (0.000 0.866 0.500)");
  EXPECT_EQ(alta_directions("ISOTROPIC_TV_PROJ_DPHI", {0, -pi / 3}),
            "(0.000 0.000 1.000) (0.000 -0.866 0.500)");
  EXPECT_EQ(alta_directions("ISOTROPIC_TV_TL", {pi / 6, -pi / 3}),
            "(-0.866 0.000 0.500) (0.500 0.000 0.866)");
  EXPECT_EQ(alta_directions("ISOTROPIC_TV_TL_DPHI", {pi / 6, pi / 3, pi}),
            "(0.866 0.000 0.500) (-0.500 0.000 0.866)");
  EXPECT_EQ(alta_directions("RUSIN_TH_TD_PD", {0, pi / 6, 0}),
            "(-0.500 0.000 0.866) (0.500 0.000 0.866)")
      << "the difference direction is the view's";
  EXPECT_EQ(alta_directions("RUSIN_TH_PH_TD_PD", {pi / 6, pi / 2, 0, 0}),
            "(0.000 0.500 0.866) (0.000 0.500 0.866)");
  EXPECT_EQ(alta_directions("RUSIN_TH_TD", {0, pi / 6}),
            "(0.000 -0.500 0.866) (0.000 0.500 0.866)");
  EXPECT_EQ(alta_directions("COS_TH_TD", {1, std::cos(pi / 6)}),
            "(-0.500 0.000 0.866) (0.500 0.000 0.866)");
}

TEST(AltaFile, DividesTheCosineOfTheViewOut) {
  const Table t =
      table_of_alta(alta_file("ISOTROPIC_TV_TL", "INV_STERADIAN_COSINE_FACTOR", 2, 1,
                              {{pi / 3, pi / 6, 0.2}, {pi / 2 - 0.005, pi / 6, 0.2}, {0, 0, -1}}));
  EXPECT_NEAR(t.values[0][0], 0.4, 1e-12);
  EXPECT_TRUE(std::isnan(t.values[0][1])) << "too near the horizon";
  EXPECT_EQ(t.values[0][2], -1);
  ASSERT_EQ(t.notes.size(), 1U);
  EXPECT_NE(t.notes[0].second.find("1 values"), std::string::npos) << t.notes[0].second;
}

TEST(AltaFile, NamesChannels) {
  const auto channels = [](const std::string& out, std::size_t n) {
    std::vector<double> row(2 + n, 0.1);
    return table_of_alta(alta_file("ISOTROPIC_TV_TL", out, 2, n, {row})).channels;
  };
  EXPECT_EQ(channels("INV_STERADIAN", 1), std::vector<std::string>{"f"});
  EXPECT_EQ(channels("RGB_COLOR", 3), (std::vector<std::string>{"r", "g", "b"}));
  EXPECT_EQ(channels("INV_STERADIAN", 2), (std::vector<std::string>{"1", "2"}));
}

TEST(AltaFile, ReadsOverIntervals) {
  const std::string head =
      "#DIM 2 2\n#VS 2\n#PARAM_IN ISOTROPIC_TV_TL\n#PARAM_OUT INV_STERADIAN\n# DIM 7 7\n";
  const Table t = table_of_alta(head +
                                "0 0 1 2\n"
                                "0 0 3 4 0 9\r\n"
                                "\n"
                                "# between\n"
                                "0 0 5 6 0 9 0 9");
  EXPECT_EQ(t.values[0], (Values{1, 3, 5}));
  EXPECT_EQ(t.values[1], (Values{2, 4, 6}));
}

TEST(AltaFile, MayBeBinaryInEitherByteOrder) {
  for (const bool big : {false, true}) {
    // The first sample begins with the byte '#', which a header line would too.
    const std::vector<double> numbers{
        std::bit_cast<double>(big ? 0x23'00000000000000ULL : 0x3fe0000000000023ULL),
        0.25,
        7,
        1,
        0.5,
        -0.25,
        8,
        1};
    std::string bytes = fmt::format(
        "#FORMAT binary\n#VERSION 0\n#PRECISION ieee754-double\n#SAMPLE_COUNT 2\n#ENDIAN {}\n"
        "#DIM 2 1\n#VS 1\n#PARAM_IN ISOTROPIC_TV_TL\n#PARAM_OUT INV_STERADIAN\n#BEGIN_STREAM\n",
        big ? "big" : "little");
    for (const double x : numbers) {
      std::string b = bytes_of(x);
      if (big) std::ranges::reverse(b);
      bytes += b;
    }
    const Table t = table_of_alta(bytes + "\n#END_STREAM\n");
    EXPECT_EQ(t.values[0], (Values{7, 8}));
    EXPECT_NEAR(t.list()->theta_i_deg[0], 0.25 / degree, 1e-12);
    EXPECT_NEAR(t.list()->theta_o_deg[1], 0.5 / degree, 1e-12);
  }
}

TEST(AltaFile, OfARetroReflectorPeaksWhereLightComesFrom) {
  GONIO_NEEDS_SHARED(path, "data/alta_retro/retro-3M-jaune.dat");
  const Table t = read_table(path);
  EXPECT_EQ(t.size(), 7397U);
  const SampleAngles at(t);
  // Away from the mirror direction, where the sheet's surface has a highlight of its own.
  for (const double theta_deg : {15.0, 30.0}) {
    double highest = 0, from_light_deg = 180;
    for (std::size_t i = 0; i < t.size(); ++i) {
      const auto [wi, wo] = at.directions(i);
      if (std::abs(t.list()->theta_i_deg[i] - theta_deg) > 0.01 ||
          dot(wi, wo) < std::cos(12 * degree) || !(t.values[0][i] > highest))
        continue;
      highest = t.values[0][i];
      from_light_deg = std::acos(std::min(dot(wi, wo), 1.0)) / degree;
    }
    EXPECT_LT(from_light_deg, 1.5) << theta_deg << ": samples lie 1° apart";
    EXPECT_GT(highest, 12) << theta_deg;
  }
  // f is reciprocal only if the cosine was the view's: with the light's the ratio would be 0.8.
  const auto value = [&](double theta_i_deg, double theta_o_deg) {
    for (std::size_t i = 0; i < t.size(); ++i)
      if (std::abs(t.list()->theta_i_deg[i] - theta_i_deg) < 1e-3 &&
          std::abs(t.list()->theta_o_deg[i] - theta_o_deg) < 1e-3 &&
          std::abs(t.list()->phi_o_deg[i]) < 1e-3)
        return t.values[0][i];
    return 0.0;
  };
  EXPECT_NEAR(value(15, 30) / value(30, 15), 1, 0.01);
}

}  // namespace
}  // namespace gonio
