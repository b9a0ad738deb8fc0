// BRDFs in JSON: both forms of the metrology institutes, OpenMATERIAL's, and documents that lie.
#include "table/format/brdf_json.h"

#include <cmath>
#include <numbers>

#include "table/complaint.h"

#include <fmt/format.h>

namespace gonio {
namespace {

using namespace test;

Table table_of_json(const std::string& text) {
  const Folder folder;
  return read_table(folder.write("a.json", text));
}

const std::string new_form =
    R"({"metadata": {"id": "7", "type": "BRDF", "sample": {"name": "tile"}}, "data": {"variables": [
{"name": "theta_i", "type": "number", "unit": "rad"}, {"name": "phi_i", "type": "number", "unit": "deg"},
{"name": "theta_r", "type": "number", "unit": "deg"}, {"name": "phi_r", "type": "number", "unit": "deg"},
{"name": "wavelength_i", "type": "number", "unit": "nm"}, {"name": "pol_i", "type": "string"},
{"name": "BRDF", "type": "number", "unit": "sr-1"}, {"name": "uBRDF", "type": "number", "unit": "sr-1"}],
"values": [[0.5, 0, 20, 180, 650, "s", 0.3, 0.003], [0.5, 0, 20, 180, 450, "s", 0.2, 0.002],
[0.5, 0, -20, 180, 450, "p", 0.1, 0.001], [0.5, 0, 20, 180, 450, "s", 0.25, 0.002]]}})";

TEST(BrdfJson, OfTheNewFormHasAChannelForEachWavelength) {
  const Table t = table_of_json(new_form);
  EXPECT_EQ(t.format, "brdf_json");
  EXPECT_EQ(t.channels, (std::vector<std::string>{"450", "650"}));
  ASSERT_EQ(t.size(), 3U) << "one of two wavelengths, one on the other side, one measured again";
  EXPECT_NEAR(t.list()->theta_i_deg[0], 0.5 / degree, 1e-12);
  EXPECT_EQ(t.values[0][0], 0.2);
  EXPECT_EQ(t.values[1][0], 0.3);
  EXPECT_EQ(t.list()->theta_o_deg[1], 20);
  EXPECT_EQ(t.list()->phi_o_deg[1], 360);
  EXPECT_TRUE(std::isnan(t.values[1][1]));
  EXPECT_EQ(t.values[0][2], 0.25);
  ASSERT_EQ(t.warnings.size(), 1U);
  EXPECT_HAS(t.warnings[0], "1 p, 3 s");
  EXPECT_EQ(t.notes.at(2).first, "sample.name");
}

TEST(BrdfJson, ListsAFewOfManyPolarisations) {
  std::string rows;
  for (int k = 0; k < 1000; ++k)
    rows += fmt::format("{}[0.5, 0, 20, 180, 650, \"{}{}\", 0.3, 0.003]", k ? "," : "",
                        std::string(200, 'p'), k);
  const auto from = new_form.find("\"values\": [") + 11;
  std::string text = new_form;
  text.replace(from, text.rfind(']') + 1 - from, rows + "]");
  const Table t = table_of_json(text);
  ASSERT_EQ(t.warnings.size(), 1U);
  EXPECT_HAS(t.warnings[0], "… and 994 more");
  EXPECT_LT(t.warnings[0].size(), 600U);
}

TEST(BrdfJson, RefusesManyVariablesBeforeItReadsThem) {
  std::string many = "[0";
  for (int k = 0; k < 1024; ++k) many += ",0";
  const auto line = test::refusal([&] {
    table_of_json(R"({"head": {}, "data": {"values": [], "variables": )" + many + "]}}");
  });
  EXPECT_HAS(line, "data.variables: found an array, expected an array of at most 1024");
}

std::string old_form(const std::string& rows) {
  return R"({"head": {"date": "1.2.2020"}, "data": {"wavelengths": [700, 500], "theta_i": [0, 0, 45],
"phi_i": [0, 0, 0], "theta_v": [-10, 20, 45], "phi_v": [0, 0, 180], "pol": "uuu", "data": )" +
         rows + "}}";
}

TEST(BrdfJson, OfTheOldFormIsReadByWavelengthOrByGeometry) {
  for (const char* rows :
       {"[[1, 2, 3], [4, 5, 6]]", "[[700, 1, 2, 3], [500, 4, 5, 6]]", "[[1, 4], [2, 5], [3, 6]]"}) {
    const Table t = table_of_json(old_form(rows));
    EXPECT_EQ(t.channels, (std::vector<std::string>{"500", "700"}));
    ASSERT_EQ(t.size(), 3U);
    for (std::size_t g = 0; g < 3; ++g) {
      EXPECT_EQ(t.values[1][g], 1 + static_cast<double>(g)) << rows;
      EXPECT_EQ(t.values[0][g], 4 + static_cast<double>(g)) << rows;
    }
    EXPECT_EQ(t.list()->phi_o_deg[0], 180) << "a negative zenith angle";
    EXPECT_TRUE(t.warnings.empty()) << "unpolarised";
  }
}

TEST(BrdfJson, ThatLiesIsRefusedByItsPlace) {
  const auto said = [](std::string text, const std::string& what, const std::string& by) {
    const auto at = text.find(what);
    EXPECT_NE(at, text.npos);
    return complaint_about(text.replace(at, what.size(), by));
  };
  EXPECT_HAS(complaint_about(old_form("[[1, 2], [4, 5]]")),
             "data.data: found 2 rows of 2, expected 2 rows of 3");
  EXPECT_HAS(complaint_about(old_form("[[1, 2, 3], [4, 5]]")),
             "data.data[1]: found 2 entries, expected 3");
  EXPECT_HAS(complaint_about(old_form("[[700, 1, 2, 3], [501, 4, 5, 6]]")),
             "expected the wavelength 500");
  EXPECT_HAS(complaint_about(old_form("[[1, 2, 3], [4, \"x\", 6]]")), "data.data[1][1]");
  EXPECT_HAS(said(new_form, R"("unit": "rad")", R"("unit": "gon")"), "expected deg or rad");
  EXPECT_HAS(said(new_form, R"("name": "theta_r")", R"("name": "theta_x")"), "no theta_r");
  EXPECT_HAS(said(new_form, R"("name": "theta_r")", R"("name": "theta_i")"), "each name once");
  EXPECT_HAS(said(new_form, "0.3, 0.003]", "0.3]"), "a row of 8 entries");
  EXPECT_HAS(said(new_form, "[0.5, 0, 20", "[0.5, 0, 95"), "data.values[0][2]");
  EXPECT_HAS(said(new_form, "\"values\": [", "\"values\": [], \"x\": ["), "no samples");
  EXPECT_HAS(complaint_about("{\"data\": " + std::string(10'000, '[') + ", \"head\": 1"),
             "65 levels");
}

TEST(OpenMaterial, HasAnglesInRadiansAndWavelengthsInMetres) {
  const Table t = table_of_json(
      R"({"metadata": {"name": "asphalt"}, "brdf": {"wavelengths": [5.5e-07], "lookupTable": [
[5.5e-07, 0.5, 0.25, 3.141592653589793, 0.04], [5.5e-07, 0.5, 0, 0, 0.03], [6.5e-07, 0.5, 0.25, 3.141592653589793, 0.05]]}})");
  EXPECT_EQ(t.format, "xompt");
  EXPECT_EQ(t.channels, (std::vector<std::string>{"550", "650"}));
  ASSERT_EQ(t.size(), 2U);
  EXPECT_NEAR(t.list()->theta_i_deg[0], 0.5 / degree, 1e-12);
  EXPECT_NEAR(t.list()->phi_o_deg[0], 180, 1e-12);
  EXPECT_EQ(t.values[1][0], 0.05);
  EXPECT_TRUE(std::isnan(t.values[1][1]));
  EXPECT_TRUE(t.warnings.empty());
  EXPECT_EQ(
      table_of_json(R"({"brdf": {"lookupTable": [[5.5e-07, 0, 0, 0, 2e-05]]}})").warnings.size(),
      1U)
      << "far too dark";
  EXPECT_HAS(complaint_about(R"({"brdf": {"lookupTable": [[5.5e-07, 0.5, 0.25, 3.1]]}})"),
             "lookupTable[0]");
  EXPECT_HAS(complaint_about(R"({"brdf": {"lookupTable": [[550, 0.5, 0.25, 3.1, 1]]}})"),
             "a wavelength in metres");
  EXPECT_HAS(complaint_about(R"({"brdf": {"lookupTable": [[5.5e-07, 45, 0.25, 3.1, 1]]}})"),
             "an angle in radians");
}

TEST(OpenMaterial, OfWavelengthsThatRoundToOneHasAChannelForEach) {
  const Table t = table_of_json(
      R"({"brdf": {"lookupTable": [[5e-7, 0.1, 0.2, 3, 0.04], [5.0000001e-7, 0.1, 0.2, 3, 0.05]]}})");
  EXPECT_EQ(t.channels, (std::vector<std::string>{"500", "500.00001"}));
  EXPECT_EQ(t.values[1][0], 0.05);
}

TEST(BrdfJson, OfTheOldFormTellsDirectionsApartThatItHasTwice) {
  const Table t = table_of_json(
      R"({"head": {}, "data": {"wavelengths": [500, 500], "theta_i": [0, 0], "phi_i": [0, 0],
"theta_v": [10, 10], "phi_v": [0, 0], "data": [[1, 2], [3, 4]]}})");
  ASSERT_EQ(t.size(), 4U) << "a wavelength twice is measured once more";
  EXPECT_EQ(t.values[0], (Values{1, 2, 3, 4}));
  EXPECT_HAS(complaint_about(
                 R"({"head": {}, "data": {"wavelengths": [500], "theta_i": [], "phi_i": [],
"theta_v": [], "phi_v": [], "data": [[]]}})"),
             "no samples");
}

/// Each direction has room for each wavelength: 9,000 rows asked for half a gigabyte.
TEST(BrdfJson, OfOtherWavelengthsAtEachDirectionIsRefused) {
  const auto rows = [](int n, int step) {
    std::string all;
    for (int i = 0; i < n; ++i)
      all += fmt::format("{}[{}e-9, 0.1, {}, 0, 0.3]", i ? "," : "", 400 + i * step, 1e-4 * i);
    return R"({"brdf": {"lookupTable": [)" + all + "]}}";
  };
  EXPECT_EQ(complaint_about(rows(200, 0)), "");
  EXPECT_HAS(complaint_about(rows(200, 1)), "expected all wavelengths at most of them");
  EXPECT_HAS(complaint_about(rows(4097, 1)), "4096 wavelengths");
}

TEST(BrdfJson, OfASharedFileHasItsGeometriesAndBands) {
  GONIO_NEEDS_SHARED(path, "data/instruments/110119_1500-20_i0_A_NO_ADL.json");
  const Table t = read_table(path);
  EXPECT_EQ(t.size(), 16U);
  ASSERT_EQ(t.channels.size(), 81U);
  EXPECT_EQ(t.channels.back(), "780");
  EXPECT_EQ(t.values.back()[0], 3.33486199885066);
  EXPECT_EQ(t.list()->theta_o_deg[2], 20);
  EXPECT_EQ(t.list()->phi_o_deg[2], 180);
}

}  // namespace
}  // namespace gonio
