// What is said of an instrument: uncertainties in columns and documents, cones, reference targets.
#include "table/format/measured_by.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "optics/spectrum.h"
#include "table/complaint.h"

#include <fmt/format.h>

namespace gonio {
namespace {

using namespace test;

Table table_of_csv(const std::string& text, const std::string& side = "") {
  const Folder folder;
  const std::string path = folder.write("a.csv", text);
  if (!side.empty()) folder.write("a.csv.gonio.json", side);
  return read_table(path);
}

TEST(Uncertainties, StandInColumns) {
  const Table one = table_of_csv(
      "theta_i,phi_i,theta_o,phi_o,f_r,f_g,u_f\n10,0,20,180,.5,.25,.01\n10,0,30,180,.4,.2,.02\n");
  ASSERT_EQ(one.errors.size(), 2U) << "one column for both channels";
  EXPECT_EQ(one.errors[1][1], .02);
  const Table own =
      table_of_csv("theta_i,phi_i,theta_o,phi_o,f_r,U_f_g,f_g,u_f_r\n10,0,20,180,.5,.08,.25,.01\n");
  EXPECT_EQ(own.errors[0][0], .01);
  EXPECT_EQ(own.errors[1][0], .04) << "U is expanded by 2";
  const Table gap =
      table_of_csv("theta_i,phi_i,theta_o,phi_o,f,u_f\n10,0,20,180,nan,nan\n10,0,30,180,.4,.2\n");
  EXPECT_EQ(gap.errors[0][1], .2);
  const Table rows = table_of_csv(
      "theta_i,phi_i,theta_o,phi_o,nm,f,u_f\n10,0,20,180,450,.5,.01\n10,0,20,180,650,.4,.02\n",
      R"({"schema": "gonio.table/1", "columns": {"channel": "nm"}})");
  ASSERT_EQ(rows.errors.size(), 2U);
  EXPECT_EQ(rows.errors[1][0], .02);
}

TEST(Uncertainties, ThatSayNothingAreRefusedWithTheirPlace) {
  const auto said = [](const std::string& columns, const std::string& row) {
    return refusal([&] {
      table_of_csv("theta_i,phi_i,theta_o,phi_o," + columns + "\n10,0,20,180," + row + "\n");
    });
  };
  EXPECT_HAS(said("f,u_f", ".5,0"), "a standard uncertainty above 0");
  EXPECT_HAS(said("f,u_f", ".5,-1"), "line 2");
  EXPECT_HAS(said("f,u_f", ".5,nan"), "sample 1");
  EXPECT_HAS(said("f_r,f_g,u_f_r", ".5,.5,.1"), "no uncertainty of f_g");
  EXPECT_HAS(said("f,u_f_x", ".5,.1"), "u_f_x of no values");
}

TEST(Uncertainties, AreWrittenAndReadAgain) {
  const Folder folder;
  Table t = table_of_csv("theta_i,phi_i,theta_o,phi_o,f_r,f_g,u_f\n10,0,20,180,.5,.25,.01\n");
  t.aperture = {0.7 * degree, 0.1 * degree};
  write_table(t, folder / "b.csv");
  const Table again = read_table(folder / "b.csv");
  EXPECT_EQ(again.errors, t.errors);
  EXPECT_NEAR(again.aperture.light, 0.7 * degree, 1e-15);
  EXPECT_NEAR(again.aperture.detector, 0.1 * degree, 1e-15);
}

TEST(Uncertainties, StandInASideFile) {
  const std::string text = "theta_i,phi_i,theta_o,phi_o,f\n10,0,20,180,3\n10,0,30,180,0\n";
  const Table t = table_of_csv(
      text, R"({"schema": "gonio.table/1", "uncertainty": {"relative": 0.01, "floor": 0.04}})");
  EXPECT_NEAR(t.errors[0][0], 0.05, 1e-15);
  EXPECT_NEAR(t.errors[0][1], 0.04, 1e-15);
  for (const char* bad :
       {R"({"relative": -1})", R"({"relative": 0})", R"({"absolute": 1})", R"({})"})
    EXPECT_NE(refusal([&] {
                table_of_csv(
                    text, fmt::format(R"({{"schema": "gonio.table/1", "uncertainty": {}}})", bad));
              }),
              "")
        << bad;
}

TEST(Uncertainties, OfDocumentsAreStandardOrExpanded) {
  const auto document = [](const char* about, const char* u) {
    return fmt::format(R"({{"metadata": {{}}, "data": {{"variables": [
{{"name": "theta_i", "unit": "deg"}}, {{"name": "phi_i", "unit": "deg"}}, {{"name": "theta_r", "unit": "deg"}},
{{"name": "phi_r", "unit": "deg"}}, {{"name": "BRDF", "unit": "sr-1"}}, {{"name": "uBRDF", "unit": "sr-1", "description": "{}"}}],
"values": [[5, 0, 20, 180, 0.3, {}]]}}}})",
                       about, u);
  };
  const auto read = [&](const char* about, const char* u) {
    const Folder folder;
    return read_table(folder.write("a.json", document(about, u)));
  };
  EXPECT_EQ(read("standard uncertainty", "0.02").errors[0][0], 0.02);
  EXPECT_EQ(read("expanded uncertainty (k = 2)", "0.02").errors[0][0], 0.01);
  EXPECT_HAS(refusal([&] { read("", "0"); }), "an uncertainty above 0");
  const auto in_percent = [&](std::string text, std::string_view of) {
    const Folder folder;
    const auto unit = text.find("sr-1", text.find(of));
    return read_table(folder.write("a.json", text.replace(unit, 4, "%")));
  };
  const auto text = document("standard uncertainty", "4");
  EXPECT_NEAR(in_percent(text, "\"uBRDF\"").errors[0][0], 0.012, 1e-15);
  EXPECT_HAS(refusal([&] { in_percent(text, "\"BRDF\""); }), R"(unit: found "%", expected 1/sr)");
  EXPECT_HAS(refusal([&] { read("", "null"); }), "data.values[0][5]");
}

TEST(Apertures, AreWidthsOrSolidAngles) {
  const Aperture a = aperture_from("0.7,1.2273e-4sr");
  EXPECT_NEAR(a.light, 0.7 * degree, 1e-15);
  EXPECT_NEAR(2 * std::numbers::pi * (1 - std::cos(a.detector / 2)), 1.2273e-4, 1e-12);
  for (const char* bad : {"", "1", "0,0", "-1,1", "60,0", "nan,1", "1,2,3", "1,4sr", "a,b"})
    EXPECT_HAS(refusal([&] { aperture_from(bad); }, Exit::usage), "LIGHT,DETECTOR") << bad;
}

TEST(Apertures, StandInTheOldFormsHead) {
  const Folder folder;
  const Table t = read_table(
      folder.write("a.json", R"({"head": {"irradiation_sa": "1.2273E10-4", "collection_sa": 4.9e-9},
"data": {"wavelengths": [550], "theta_i": [0], "phi_i": [0], "theta_v": [10], "phi_v": [0], "data": [[0.3]]}})"));
  EXPECT_NEAR(t.aperture.light / degree, 0.716, 0.001);
  EXPECT_NEAR(t.aperture.detector / degree, 0.00453, 0.00001);
}

TEST(References, MakeFOfRatios) {
  Table t = table_of_csv("theta_i,phi_i,theta_o,phi_o,f,u_f\n10,0,20,180,1,.01\n");
  t.truth = Truth{};
  take(t, {.mask = {}, .aperture = {}, .reference = 0.99});
  EXPECT_FALSE(t.truth) << "it is that of the values before";
  EXPECT_NEAR(t.values[0][0], 0.99 / std::numbers::pi, 1e-15);
  EXPECT_NEAR(t.errors[0][0], 0.0099 / std::numbers::pi, 1e-15);
  for (const double bad : {0.0, -1.0, 99.0})
    EXPECT_HAS(refusal([&] { take_reference(t, bad); }, Exit::usage), "reference") << bad;
}

/// A matte spectrum at these wavelengths, which grows with them where asked.
Table spectrum_from(double first, double last, double step, bool grows) {
  std::string names = "theta_i,phi_i,theta_o,phi_o", values = "10,0,20,180";
  for (double nm = first; nm <= last; nm += step) {
    names += fmt::format(",f_{:g}", nm);
    values += fmt::format(",{}", grows ? (nm - 300) / 1000 : 0.5);
  }
  std::string errors;
  for (double nm = first; nm <= last; nm += step) {
    names += fmt::format(",u_f_{:g}", nm);
    values += ",0.01";
  }
  return table_of_csv(names + "\n" + values + "\n");
}

TEST(Spectra, BecomeLinearRgbWhereTheyCoverWhatIsSeen) {
  Table grey = spectrum_from(400, 700, 10, false), slope = spectrum_from(380, 740, 20, true);
  take_rgb(grey);
  take_rgb(slope);
  EXPECT_EQ(grey.channels, (std::vector<std::string>{"r", "g", "b"}));
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(grey.values[c][0], 0.5, 1e-12) << "weights add up to 1";
    EXPECT_GT(grey.errors[c][0], 0.01 / std::sqrt(31.0)) << "bands count unequally";
    EXPECT_LT(grey.errors[c][0], 0.01);
  }
  const auto exact =
      linear_srgb(spectrum([](double nm) { return (std::clamp(nm, 380.0, 740.0) - 300) / 1000; }));
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(slope.values[c][0], exact[c], 1e-12);
  for (const auto& [first, last, step] :
       {std::array{420.0, 700.0, 10.0}, std::array{400.0, 680.0, 10.0},
        std::array{400.0, 700.0, 60.0}}) {
    Table t = spectrum_from(first, last, step, false);
    EXPECT_HAS(refusal([&] { take_rgb(t); }, Exit::usage), "400 to 700 nm");
  }
}

TEST(Channels, AreTakenByNameOrByTheNearestBand) {
  Table t = spectrum_from(400, 700, 50, true);
  pick_channels(t, {"561nm", "400"});
  EXPECT_EQ(t.channels, (std::vector<std::string>{"550", "400"}));
  ASSERT_EQ(t.notes.size(), 1U);
  EXPECT_EQ(t.notes[0].second, "550 is the nearest to 561nm");
  EXPECT_EQ(t.values[0][0], 0.25);
  EXPECT_EQ(t.errors[1][0], 0.01);
  for (const char* bad : {"900nm", "561", "r", ""})
    EXPECT_HAS(refusal(
                   [&] {
                     Table x = t;
                     pick_channels(x, {bad});
                   },
                   Exit::usage),
               "among 550, 400")
        << bad;
  EXPECT_HAS(refusal(
                 [&] {
                   Table x = t;
                   pick_channels(x, {"550nm", "550"});
                 },
                 Exit::usage),
             "twice");
}

}  // namespace
}  // namespace gonio
