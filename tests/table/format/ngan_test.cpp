// MIT CSAIL's anisotropic files: which bin is where, and what does not fit.
#include "table/format/ngan.h"

#include <cmath>

#include "table/complaint.h"
#include "table/foreign.h"

namespace gonio {
namespace {

using namespace test;

Table table_of_ngan(const std::string& bytes) {
  const Folder folder;
  return read_table(folder.write("m.dat", bytes));
}

TEST(NganFile, HasItsAzimuthsFastestAndItsPlanesAsColours) {
  // 2 × 3 × 4 × 5 bins, each its number in the file.
  const Table t = table_of_ngan(ngan_file({2, 3, 4, 5}, false, [](std::size_t k) { return k; }));
  EXPECT_EQ(t.format, "ngan");
  EXPECT_EQ(t.channels, (std::vector<std::string>{"r", "g", "b"}));
  ASSERT_EQ(t.size(), 120U);
  // Bin (1, 2, 3, 4): θ_i = 90°·1.5/2, θ_o = 90°·2.5/3, φ_diff = 360°·3.5/4, φ_i = 360°·4.5/5.
  const std::size_t i = 4 + 5 * (3 + 4 * (2 + 3 * 1));
  ASSERT_EQ(i, 119U);
  const DirectionList& l = *t.list();
  EXPECT_DOUBLE_EQ(l.theta_i_deg[i], 67.5);
  EXPECT_DOUBLE_EQ(l.theta_o_deg[i], 75);
  EXPECT_DOUBLE_EQ(l.phi_i_deg[i], 324);
  EXPECT_DOUBLE_EQ(l.phi_o_deg[i], 324 + 315 - 360);
  EXPECT_EQ(t.values[0][i], 119);
  EXPECT_EQ(t.values[2][i], 359);
  // Bin (0, 1, 2, 3).
  const std::size_t j = 3 + 5 * (2 + 4 * 1);
  EXPECT_DOUBLE_EQ(l.theta_i_deg[j], 22.5);
  EXPECT_DOUBLE_EQ(l.theta_o_deg[j], 45);
  EXPECT_DOUBLE_EQ(l.phi_i_deg[j], 252);
  EXPECT_DOUBLE_EQ(l.phi_o_deg[j], 252 + 225 - 360);
  EXPECT_EQ(t.values[1][j], 153);
  EXPECT_TRUE(t.warnings.empty());
}

TEST(NganFile, MayHoldHalfOfTheTurnBetweenLightAndViewer) {
  const Table t = table_of_ngan(ngan_file({1, 1, 4, 1}, true, [](std::size_t) { return 1; }));
  EXPECT_DOUBLE_EQ(t.list()->phi_i_deg[3], 180);
  EXPECT_DOUBLE_EQ(t.list()->phi_o_deg[3], 180 + 157.5);
}

TEST(NganFile, HasNegativesWhereNothingWasMeasured) {
  const Table t =
      table_of_ngan(ngan_file({1, 1, 2, 1}, false, [](std::size_t k) { return k == 1 ? -1 : 2; }));
  EXPECT_FALSE(t.negative_is_noise);
  EXPECT_EQ(mask(SampleAngles(t)(1), t.values[0][1]), Mask::negative);
  EXPECT_EQ(mask(SampleAngles(t)(0), t.values[0][0]), Mask::valid);
}

TEST(NganFile, OfTheWrongLengthIsRefused) {
  const Folder folder;
  const std::string good = ngan_file({2, 3, 4, 5}, false, [](std::size_t k) { return k; });
  EXPECT_COMPLAINT(folder.write("m", good.substr(0, good.size() - 12)),
                   "byte 0: found 2 × 3 × 4 × 5 bins in 1492 bytes, expected 64 bytes and 12");
  EXPECT_COMPLAINT(folder.write("m", good.substr(0, good.size() - 1)), "in 1503 bytes");
  EXPECT_COMPLAINT(folder.write("m", good.substr(0, 64)), "in 64 bytes");
  EXPECT_COMPLAINT(folder.write("m", good + good.substr(64, 12)), "in 1516 bytes");
  std::string lies = good;
  for (std::size_t k = 0; k < 4; ++k) lies.replace(4 * k, 4, std::string("\0\0\1\0", 4));
  EXPECT_COMPLAINT(folder.write("m", lies), "65536 × 65536 × 65536 × 65536 bins")
      << "a product of 2^64 is 0";
  std::string other = good;
  other[28] = 1;  // bins of another kind
  EXPECT_COMPLAINT(folder.write("m", other), "an unknown format");
}

/// A file of zeros, of which no disk is asked.
std::string hole(const Folder& folder, const std::array<std::int32_t, 4>& bins) {
  const std::string head = ngan_file(bins, false, nullptr);
  std::uintmax_t size = 12;
  for (const auto n : bins) size *= static_cast<std::uintmax_t>(n);
  const auto path = folder.write("m", head);
  std::filesystem::resize_file(path, head.size() + size);
  return path;
}

TEST(NganFile, OfMoreBinsThanATableHoldsIsReadAtFewerAzimuths) {
  const Folder folder;
  // 2^26 / 7 samples fit: of 96 azimuths with 225,000 bins each 42, and 32 are evenly spaced.
  const Table t = read_table(hole(folder, {50, 50, 90, 96}));
  EXPECT_EQ(t.size(), 225'000U * 32);
  ASSERT_EQ(t.warnings.size(), 1U);
  EXPECT_NE(t.warnings[0].find("21600000 bins, more than a table holds: one in 3"),
            std::string::npos)
      << t.warnings[0];
  EXPECT_DOUBLE_EQ(t.list()->phi_i_deg[1], 360 * 3.5 / 96);
  EXPECT_COMPLAINT(hole(folder, {500, 500, 90, 1}), "found 22500000 bins at each φ_i");
}

}  // namespace
}  // namespace gonio
