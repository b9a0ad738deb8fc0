// SSDD: each parametrization gives the directions it stands for, blocks of other kinds are passed
// over, and what is not there is missed.
#include "table/format/ssdd.h"

#include <cmath>

#include "table/complaint.h"
#include "table/foreign.h"

namespace gonio {
namespace {

using namespace test;

Table table_of_ssdd(const std::string& bytes) {
  const Folder folder;
  return read_table(folder.write("m.ssdd", bytes));
}
/// One sample at four angles.
std::string one(const std::string& type,
                const std::array<int, 4>& angles,
                const std::string& more = "") {
  std::string text =
      "# made by hand\nVERSION 0.3\n\nDATA_TYPE brdf\nCOLOR_MODEL monochrome\nPARAM_TYPE " + type +
      "_coordinate_system\n";
  for (std::size_t k = 0; k < 4; ++k) text += fmt::format("PARAM{}_LIST {}\n", k, angles[k]);
  return text + more + "DATA ascii\n0.5\n";
}
/// wi and wo of that sample.
std::string directions_of(const std::string& text) {
  const Table t = table_of_ssdd(text);
  EXPECT_EQ(t.size(), 1U);
  const auto [wi, wo] = SampleAngles(t).directions(0);
  const auto shown = [](const Direction& d) {
    return fmt::format("({:.3f} {:.3f} {:.3f})", d.x + 1e-9, d.y + 1e-9, d.z + 1e-9);
  };
  return shown(wi) + " " + shown(wo);
}

TEST(SsddFile, KnowsItsParametrizations) {
  EXPECT_EQ(directions_of(one("spherical", {30, 90, 60, 180})),
            "(0.000 0.500 0.866) (-0.866 0.000 0.500)");
  EXPECT_EQ(directions_of(one("specular", {30, 0, 0, 0})),
            "(0.500 0.000 0.866) (-0.500 0.000 0.866)")
      << "the mirror direction";
  EXPECT_EQ(directions_of(one("specular", {30, 0, 30, 0})),
            "(0.500 0.000 0.866) (0.000 0.000 1.000)")
      << "from there to the normal";
  EXPECT_EQ(directions_of(one("specular", {30, 90, 0, 0})),
            "(0.000 0.500 0.866) (0.000 -0.500 0.866)");
  EXPECT_EQ(directions_of(one("specular", {30, 0, 90, 90})),
            "(0.500 0.000 0.866) (0.000 1.000 0.000)");
  EXPECT_EQ(directions_of(one("specular", {30, 90, 90, 90})),
            "(0.000 0.500 0.866) (-1.000 0.000 0.000)");
  EXPECT_EQ(directions_of(one("specular", {30, 0, 0, 0}, "PARAM4_LIST 30\n")),
            "(0.500 0.000 0.866) (-0.866 0.000 0.500)")
      << "an offset is further from the normal";
  // h at 30° along x; d turned on by 30° about it: the light at 60°, the viewer at 0°.
  EXPECT_EQ(directions_of(one("half_difference", {30, 0, 30, 0})),
            "(0.866 0.000 0.500) (0.000 0.000 1.000)");
}

constexpr const char* two_blocks =
    "VERSION 0.3\r\nSOFTWARE none\r\nDATA_TYPE btdf\r\nCOLOR_MODEL monochrome\r\nPARAM_TYPE "
    "specular_coordinate_system\r\nPARAM0_LIST 0 45\r\nPARAM2_LIST 0\r\nPARAM3_LIST 0\r\nDATA "
    "ascii\r\n8\r\n9\r\n"
    "DATA_TYPE brdf\r\nCOLOR_MODEL spectrum\r\nWAVELENGTH_LIST 450 650.5\r\nPARAM_TYPE "
    "spherical_coordinate_system\r\nREDUCTION_TYPE bilateral_symmetry\r\nPARAM0_LIST 10 20 # "
    "ascending\r\nPARAM2_LIST 0 30\r\n"
    "PARAM3_LIST 0 90 180\r\nDEVICE GCMS 4\r\nDATA ascii\r\n# PARAM3: 0\r\n1 -1\r\n2 -2\r\n3 "
    "-3\r\n4 -4\r\n"
    "5 -5\r\n6 -6\r\n7 -7 # seventh\r\n8 -8\r\n9 -9\r\n10 -10\r\n11 -11\r\n12 -12";

TEST(SsddFile, HasItsFirstAngleFastestAndEachDirectionOnce) {
  const Table t = table_of_ssdd(two_blocks);
  EXPECT_EQ(t.format, "ssdd");
  EXPECT_EQ(t.channels, (std::vector<std::string>{"450", "650.5"}));
  // θ_o = 0 has three names, of which the first counts: colours 5, 6, 9 and 10 fall out.
  EXPECT_EQ(t.values[0], (Values{1, 2, 3, 4, 7, 8, 11, 12}));
  EXPECT_EQ(t.values[1], (Values{-1, -2, -3, -4, -7, -8, -11, -12}));
  const DirectionList& l = *t.list();
  ASSERT_EQ(l.theta_i_deg.size(), 8U);
  EXPECT_NEAR(l.theta_i_deg[5], 20, 1e-12);
  EXPECT_NEAR(l.theta_o_deg[5], 30, 1e-12);
  EXPECT_NEAR(l.phi_o_deg[5], 90, 1e-12);
  EXPECT_NEAR(l.phi_o_deg[7], 180, 1e-12);
  const std::vector<std::pair<std::string, std::string>> notes{
      {"reduction", "bilateral_symmetry"}, {"DEVICE", "GCMS 4"}, {"left out", "btdf"}};
  EXPECT_EQ(t.notes, notes);
}

TEST(SsddFile, TakesAnAzimuthOfAWholeTurnForNone) {
  const Table t = table_of_ssdd(
      "VERSION 0.2\nDATA_TYPE brdf\nCOLOR_MODEL rgb\nPARAM_TYPE "
      "spherical_coordinate_system\nPARAM0_LIST 0 50\n"
      "PARAM1_LIST 0 180 360\nPARAM2_LIST 40\nPARAM3_LIST 0 360\nDATA ascii\n1 2 3\n4 5 6\n7 8 "
      "9\n1 1 1\n0 0 0\n0 0 "
      "0\n0 0 0\n0 0 0\n0 0 0\n0 0 0\n0 0 0\n0 0 0\n");
  EXPECT_EQ(t.values[0], (Values{1, 4, 1})) << "the light at the pole, at (50°, 0) and (50°, 180°)";
}

TEST(SsddFile, MayHaveItsNumbersInBinary) {
  std::string text = one("spherical", {30, 0, 60, 180});
  text.replace(text.find("ascii\n0.5\n"), 10, "binary\n" + bytes_of(0.25F) + "\n");
  const Table t = table_of_ssdd(text);
  EXPECT_EQ(t.values[0], Values{0.25});
  const Folder folder;
  EXPECT_COMPLAINT(folder.write("m", text.substr(0, text.size() - 2)),
                   "line 11: found 3 bytes after DATA, expected 1 × 1 numbers");
}

TEST(SsddFile, GoesOnRightAfterTheNumbersOfABlockInBinary) {
  std::string text = ssdd_file("specular", "binary", bytes_of(std::array{1.5F, 2.5F}));
  text.replace(text.find("brdf"), 4, "btdf");
  const std::string second = ssdd_file("spherical", "ascii", "3\n4\n");
  EXPECT_EQ(table_of_ssdd(text + second.substr(second.find("DATA_TYPE"))).values[0],
            (Values{3, 4}));
}

TEST(SsddFile, NamesTheLineThatIsWrong) {
  const Folder folder;
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = two_blocks;
    const auto at = text.find(from);
    EXPECT_NE(at, text.npos) << from;
    return folder.write("m", text.replace(at, from.size(), to));
  };
  EXPECT_COMPLAINT(with("VERSION 0.3", "VERSION 1.0"), "line 1: found VERSION");
  EXPECT_COMPLAINT(with("TYPE brdf", "TYPE specular_reflectance"), "no DATA of DATA_TYPE brdf");
  EXPECT_COMPLAINT(with("MODEL spectrum", "MODEL lab"),
                   "line 13: found lab, expected monochrome, rgb");
  EXPECT_COMPLAINT(with("WAVELENGTH_LIST 450 650.5", "NAME x"), "no WAVELENGTH_LIST");
  EXPECT_COMPLAINT(with("450 650.5", "450 450"), "each once");
  std::string many;
  for (int nm = 0; nm < 4097; ++nm) many += std::to_string(nm) + " ";
  EXPECT_COMPLAINT(with("450 650.5", many), "found more numbers, expected at most 4096");
  EXPECT_COMPLAINT(
      with("PARAM_TYPE spherical", "PARAM_TYPE distorted_spherical"),
      "found PARAM_TYPE distorted_spherical_coordinate_system, expected spherical_coo");
  EXPECT_COMPLAINT(with("LIST 10 20", "LIST 20 10"), "line 17: found angles out of order");
  EXPECT_COMPLAINT(with("LIST 10 20", "LIST 10 91"), "'91', expected a number from 0 to 90");
  EXPECT_COMPLAINT(with("LIST 0 30", "LIST 0 91"), "PARAM2_LIST 91, expected at most 90");
  EXPECT_COMPLAINT(with("PARAM2_LIST 0 30", "PARAM4_LIST 0 30"), "no PARAM2_LIST");
  EXPECT_COMPLAINT(with("DEVICE GCMS 4", "PARAM4_LIST 3"), "1 numbers in PARAM4_LIST, expected 2");
  EXPECT_COMPLAINT(with("3 -3", "3"), "found 1 numbers, expected 2");
  EXPECT_COMPLAINT(with("3 -3", "3 -3 3"), "line 25: found '3', expected 2 numbers");
  EXPECT_COMPLAINT(with("3 -3", "3 x"), "found 'x'");
  EXPECT_COMPLAINT(with("\r\n12 -12", "\r\n#12 -12"), "found 11 colours, expected 12, one a line");
  EXPECT_COMPLAINT(
      with("DATA_TYPE brdf",
           "DATA_TYPE brdf\nCOLOR_MODEL rgb\nPARAM_TYPE spherical_coordinate_system\n"
           "PARAM0_LIST 0\nPARAM2_LIST 0\nPARAM3_LIST 0\nDATA ascii\n1 2 3\nDATA_TYPE brdf"),
      "DATA_TYPE brdf twice");
}

TEST(SsddFile, IsNotBelievedMoreSamplesThanItHasBytes) {
  const Folder folder;
  std::string list;
  for (int k = 0; k < 3000; ++k) list += fmt::format(" {}", k / 100.0);
  const auto many = [&](int lists) {
    std::string text =
        "VERSION 0.3\nDATA_TYPE brdf\nCOLOR_MODEL monochrome\nPARAM_TYPE "
        "spherical_coordinate_system\n";
    for (int k = 0; k < 4; ++k) text += fmt::format("PARAM{}_LIST{}\n", k, k < lists ? list : " 0");
    return folder.write("m", text + "DATA ascii\n1\n2\n");
  };
  EXPECT_COMPLAINT(many(2), "found 4 bytes after DATA, expected 9000000 × 1 numbers");
  EXPECT_COMPLAINT(many(4), "at most 67108864 numbers, directions included");
}

TEST(SsddFile, KeepsNoMoreNotesAndBlocksThanAFileNeeds) {
  const Folder folder;
  std::string notes = "VERSION 0.3\nDATA_TYPE brdf\n", blocks = "VERSION 0.3\n";
  for (int i = 0; i < 1001; ++i) {
    notes += "NAME\n";
    blocks += "DATA_TYPE x\nCOLOR_MODEL monochrome\nPARAM0_LIST 0\nDATA ascii\n1\n";
  }
  EXPECT_COMPLAINT(folder.write("n", notes), "line 1003: found more notes, expected at most 1000");
  EXPECT_COMPLAINT(folder.write("b", blocks), "found more blocks, expected at most 1000");
}

}  // namespace
}  // namespace gonio
