// Zemax's tabulated BSDF: where its polar coordinates about the mirror direction lie, what lies
// below the horizon, and what is refused.
#include "table/format/zemax.h"

#include <cmath>
#include <ranges>

#include "integrate/rule/quadrature.h"
#include "table/complaint.h"
#include "table/convert/convert.h"
#include "table/example.h"
#include "table/foreign.h"
#include "table/health/directional_albedo.h"

#include <fmt/ranges.h>

namespace gonio {
namespace {

using namespace test;

Table zemax_table(const ZemaxFile& file) {
  const Folder folder;
  return read_table(folder.write("a.bsdf", file.bytes()));
}
std::string zemax_replaced(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  EXPECT_NE(at, text.npos) << what;
  return text.replace(at, what.size(), by);
}
std::string zemax_complaint(const std::string& what, const std::string& by) {
  const ZemaxFile file{.f = [](const auto&, auto) { return 0.1; }};
  return complaint_about(zemax_replaced(file.bytes(), what, by));
}

ConvertOptions to_zemax() {
  ConvertOptions o;
  o.format = "zemax";
  return o;
}

/// Without symmetry but for the plane of incidence's.
double zemax_tilted(const DirectionPair& p, std::size_t c) {
  return 1 + 0.3 * p.wi.x + 0.4 * p.wo.x - 0.2 * p.wo.z + 0.1 * p.wo.y * p.wo.y +
         static_cast<double>(c);
}

TEST(ZemaxFile, HasItsValuesAtTheMirrorFramesDirections) {
  const Table t = zemax_table({.f = zemax_tilted});
  EXPECT_EQ(t.format, "zemax");
  const SampleAngles at(t);
  std::size_t mirror = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const auto p = at.directions(i);
    ASSERT_NEAR(t.values[0][i], zemax_tilted(p, 0), 1e-8) << i;
    ASSERT_GT(p.wo.z, 0);
    mirror += std::abs(p.wo.x + p.wi.x) + std::abs(p.wo.y) < 1e-12;
  }
  EXPECT_EQ(mirror, 3U) << "radius 0 counts once for each incident angle";
  EXPECT_EQ(t.list()->theta_i_deg.front(), 0);
  EXPECT_EQ(t.list()->theta_i_deg.back(), 75);
}

TEST(ZemaxFile, TurnsTheSampleAndCountsAzimuthsCounterClockwise) {
  const auto f = [](const DirectionPair& p, std::size_t) {
    return 1 + 0.3 * p.wi.x + 0.2 * p.wi.y + 0.4 * p.wo.x - 0.25 * p.wo.y;
  };
  const Table t = zemax_table({.symmetry = "ASymmetrical4D",
                               .rotation = {0, 90, 180},
                               .azimuth = {0, 90, 180, 270, 360},
                               .f = f});
  const SampleAngles at(t);
  for (std::size_t i = 0; i < t.size(); ++i)
    ASSERT_NEAR(t.values[0][i], f(at.directions(i), 0), 1e-8) << i;
  EXPECT_EQ(t.size(), 3U * (13 + 12 + 11)) << "azimuth 360 is azimuth 0, radius 0 one direction";
  const auto middle = DirectionPair{direction(15 * degree, -0.5), direction(20 * degree, 2)};
  EXPECT_NEAR(t.between(middle, 0), f(middle, 0), 0.15);
}

TEST(ZemaxFile, IsLinearBetweenItsAxesAndNothingBeyondThem) {
  const Table t = zemax_table({.f = [](const auto&, auto) { return 0.25; }});
  const auto f = [&](double theta_i, double azimuth, double radius) {
    return t.between({direction(theta_i * degree, 0.7),
                      [&] {
                        const auto wo = ZemaxFile::outgoing(theta_i, azimuth, radius);
                        return direction(theta_of(wo), phi_of(wo) + 0.7);
                      }()},
                     0);
  };
  EXPECT_NEAR(f(12, 33, 27), 0.25, 1e-9);
  EXPECT_NEAR(f(12, -33, 27), 0.25, 1e-9) << "the other half";
  EXPECT_TRUE(std::isnan(f(76, 0, 5)));
  EXPECT_TRUE(std::isnan(f(10, 0, 81)));
}

TEST(ZemaxFile, SaysThatItsChannelsAreTristimulusValues) {
  const Table t = zemax_table({.xyz = true, .f = zemax_tilted});
  EXPECT_EQ(t.channels, (std::vector<std::string>{"X", "Y", "Z"}));
  const SampleAngles at(t);
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(t.values[c][5], zemax_tilted(at.directions(5), c), 1e-8);
}

TEST(ZemaxFile, IsSaidToContradictItsOwnIntegral) {
  const ZemaxFile dense{.incident = {0, 40},
                        .azimuth = {0, 15, 30, 45, 60, 75, 90, 105, 120, 135, 150, 165, 180},
                        .radius = {0, 10, 20, 30, 40, 50, 60, 70, 80, 90, 100, 110, 120, 130},
                        .f = [](const auto&, auto) { return 0.5 / std::numbers::pi; }};
  EXPECT_TRUE(zemax_table(dense).warnings.empty()) << "a Lambertian half";
  const auto other = complaint_about(dense.bytes());
  EXPECT_EQ(other, "");
  const Folder folder;
  const Table t =
      read_table(folder.write("a.bsdf", zemax_replaced(dense.bytes(), "TIS 0.5", "TIS 0.3")));
  ASSERT_EQ(t.warnings.size(), 1U);
  EXPECT_HAS(t.warnings[0], "0.3 ");
}

TEST(ZemaxFile, ThatLiesIsRefusedByItsLine) {
  EXPECT_HAS(zemax_complaint("0 30 75", "0 75 30"),
             "line 9: found '30 after 75', expected AngleOfIncidence in ascending order");
  EXPECT_HAS(zemax_complaint("AngleOfIncidence 3", "AngleOfIncidence 4"),
             "expected 4 angles of AngleOfIncidence");
  EXPECT_HAS(zemax_complaint("AngleOfIncidence 3", "AngleOfIncidence 2"),
             "expected the end of the line");
  EXPECT_HAS(zemax_complaint("TIS 0.5", "TIS -0.5"), "expected an integral");
  EXPECT_HAS(zemax_complaint("0.1 0.1", "0.1 nan"), "found 'nan', expected a value");
  EXPECT_HAS(zemax_complaint("0.1 0.1", "0.1"), "found 'TIS', expected a value");
  EXPECT_HAS(zemax_complaint("DataEnd", ""), "expected DataEnd");
  EXPECT_HAS(zemax_complaint("BRDF", "BTDF"), "gonio fits reflection");
  EXPECT_HAS(zemax_complaint("Monochrome\nScatter", "Monochrome\nSource Measured\nScatter"),
             "found 'Source', expected each keyword once");
  EXPECT_HAS(zemax_complaint("Monochrome\nScatter", "XYZ\nScatter"), "TristimulusX");
  EXPECT_HAS(zemax_complaint("ScatterRadial 4\n0 10 40 80\n", ""), "no ScatterRadial");
  EXPECT_HAS(zemax_complaint("60\t120\t180", "60\t120\t190"), "0 to 180");
  EXPECT_HAS(zemax_complaint("AngleOfIncidence 3", "AngleOfIncidence 99999999999999"),
             "a number of angles");
  const std::string many = fmt::format("ScatterAzimuth 100\n{}\nScatterRadial 100\n{}\n",
                                       fmt::join(std::views::iota(0, 100), " "),
                                       fmt::join(std::views::iota(0, 100), " "));
  EXPECT_HAS(
      complaint_about("Source Measured\nSymmetry PlaneSymmetrical\nSpectralContent Monochrome\n"
                      "ScatterType BRDF\nSampleRotation 1\n0\nAngleOfIncidence 1\n0\n" +
                      many + "Monochrome\nDataBegin\nTIS 0.5\n0.1 0.1\nDataEnd\n"),
      "found '10000 values', expected as many as 34 bytes can hold");
}

TEST(ZemaxFile, IsWrittenFromAGridAndReadBack) {
  const Folder folder;
  const Table grid = on_grid(mbsdf_grid(45, 90, Bins::centre), "mbsdf", {"f"},
                             [](const auto& a, std::size_t) { return lobe(a, 0.5, 0.3); });
  const auto made = convert(grid, to_zemax());
  EXPECT_EQ(made.loss.without_data, 0U);
  EXPECT_GT(made.loss.compared, 100'000U);
  EXPECT_LT(made.loss.rms, 0.05);
  write_table(made.table, folder / "g.bsdf");
  const Table back = read_table(folder / "g.bsdf");
  ASSERT_EQ(back.size(), made.table.size());
  EXPECT_TRUE(back.warnings.empty()) << "its integral is its own";
  for (std::size_t i = 0; i < back.size(); ++i)
    ASSERT_NEAR(back.values[0][i], made.table.values[0][i], 1e-8 * back.values[0][i]) << i;
}

TEST(ZemaxFile, KeepsWhatIsWithoutDataWithout) {
  const Folder folder;
  Table grid = on_grid(mbsdf_grid(20, 31, Bins::centre), "mbsdf", {"f"},
                       [](const auto& a, std::size_t) { return lobe(a, 0.5, 0.3); });
  for (std::size_t i = 0; i < grid.size() / 2; ++i) grid.values[0][i] = std::nan("");
  const auto made = convert(grid, to_zemax());
  EXPECT_GT(made.loss.without_data, 100U);
  write_table(made.table, folder / "g.bsdf");
  const Table back = read_table(folder / "g.bsdf");
  std::size_t without = 0;
  for (const double v : back.values[0]) without += std::isnan(v);
  EXPECT_EQ(without, made.loss.without_data);
}

TEST(ZemaxFile, OfASharedVinylHasTheIntegralsThatItsLinesSay) {
  GONIO_NEEDS_SHARED(path, "data/instruments/imaging_sphere_planesymmetric.zemax.bsdf");
  const Table t = read_table(path);
  EXPECT_EQ(t.list()->theta_i_deg.front(), 15);
  EXPECT_NEAR(t.values[0][0], 6.375e-2, 1e-9);
  EXPECT_NEAR(directional_albedo(t, 15).albedo[0], 0.1345, 0.006);
}

}  // namespace
}  // namespace gonio
