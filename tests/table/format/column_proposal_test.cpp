#include "table/format/column_proposal.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace gonio {
namespace {

ColumnSummary column(const char* name, double lowest, double highest) {
  return {name, 100, lowest, highest, 50};
}

using Map = std::vector<std::pair<std::string, std::string>>;

TEST(ColumnProposal, NamesOfAnInstrumentAreRecognised) {
  const std::vector<ColumnSummary> columns{
      column("lambda", 0.351, 1.064), column("thetai", -0.001, 75), column("phi", 0, 90),
      column("thetar", 0, 85),        column("phir", -180, 180),    column("f_r11", 0.1, 3),
      column("f_r12/f_r11", -1, 1)};
  const auto p = propose_columns(columns);
  ASSERT_TRUE(p.map);
  EXPECT_TRUE(p.needed);
  EXPECT_EQ(p.map->columns, (Map{{"theta_i", "thetai"},
                                 {"phi_i", "phi"},
                                 {"theta_o", "thetar"},
                                 {"phi_o", "phir"},
                                 {"f", "f_r11"},
                                 {"channel", "lambda"}}));
  EXPECT_FALSE(p.map->radians);
  EXPECT_TRUE(p.said.empty());
}

TEST(ColumnProposal, AZenithAngleThatGoesRoundIsTheAzimuth) {
  const std::vector<ColumnSummary> columns{column("phi_i", 0, 85), column("theta_i", 0, 180),
                                           column("phi_o", -85, 85), column("theta_o", 0, 0),
                                           column("brdf", 0, 9)};
  const auto p = propose_columns(columns);
  ASSERT_TRUE(p.map);
  EXPECT_EQ(p.map->columns, (Map{{"theta_i", "phi_i"},
                                 {"phi_i", "theta_i"},
                                 {"theta_o", "phi_o"},
                                 {"phi_o", "theta_o"},
                                 {"f", "brdf"}}));
  ASSERT_EQ(p.said.size(), 2U);
  EXPECT_TRUE(p.said[0].ends_with("theta_i holds 180°, which no zenith angle is")) << p.said[0];
  EXPECT_TRUE(p.said[1].ends_with("the other direction's names are swapped")) << p.said[1];
}

TEST(ColumnProposal, AnglesWithinTwoPiAreRadians) {
  const std::vector<ColumnSummary> columns{column("theta_in [rad]", 0, 1.5),
                                           column("Theta out", 0, 1.55), column("azimuth", 0, 3.14),
                                           column("BRDF", 0, 9)};
  const auto p = propose_columns(columns);
  ASSERT_TRUE(p.map);
  EXPECT_TRUE(p.map->radians);
  EXPECT_EQ(p.map->columns, (Map{{"theta_i", "theta_in [rad]"},
                                 {"theta_o", "Theta out"},
                                 {"phi_o", "azimuth"},
                                 {"f", "BRDF"}}));
  auto degrees = columns;
  degrees[1].highest = 1.65;
  EXPECT_FALSE(propose_columns(degrees).map->radians) << "above a right angle";
  auto turned = columns;
  turned[2].highest = 180;
  EXPECT_FALSE(propose_columns(turned).map->radians) << "an azimuth beyond a turn";
}

TEST(ColumnProposal, AWordForADirectionAloneIsItsZenithAngle) {
  const std::vector<ColumnSummary> columns{column("wavelength", 400, 700), column("in", -60, 60),
                                           column("out", 0, 85), column("value", 0, 9)};
  const auto p = propose_columns(columns);
  ASSERT_TRUE(p.map);
  EXPECT_EQ(
      p.map->columns,
      (Map{{"theta_i", "in"}, {"theta_o", "out"}, {"f", "value"}, {"channel", "wavelength"}}));
  auto letters = columns;
  letters[1].name = "i", letters[2].name = "o";
  EXPECT_FALSE(propose_columns(letters).map) << "a letter is no word";
}

TEST(ColumnProposal, ItsOwnNamesNeedNone) {
  const std::vector<ColumnSummary> columns{column("theta_i", 0, 75), column("phi_i", 0, 0),
                                           column("theta_o", 0, 85), column("phi_o", 0, 180),
                                           column("f_r", 0, 1),      column("f_g", 0, 1)};
  const auto p = propose_columns(columns);
  ASSERT_TRUE(p.map);
  EXPECT_FALSE(p.needed);
}

TEST(ColumnProposal, OfWhatCannotBeToldNothingIsProposed) {
  const std::vector<ColumnSummary> no_names{column("", 0, 75), column("", 0, 0), column("", 0, 85)};
  const auto p = propose_columns(no_names);
  EXPECT_FALSE(p.map);
  EXPECT_EQ(p.said.size(), 3U) << "two angles and the value";
  const std::vector<ColumnSummary> no_value{column("aoi", 0, 75), column("theta_s", 0, 80)};
  EXPECT_FALSE(propose_columns(no_value).map);
}

TEST(ColumnProposal, NamesOfOtherLabsAreRecognised) {
  using Names = std::vector<const char*>;
  for (const Names& names :
       {Names{"Incident_angle", "Measure_angle", "azimuth", "bsdf"},
        Names{"incident", "polar", "azimuth", "BRDF [1/sr]"},
        Names{"Einfallswinkel (deg)", "Streuwinkel (deg)", "Azimut", "BRDF"}}) {
    const std::vector<ColumnSummary> columns{column(names[0], 0, 75), column(names[1], 0, 80),
                                             column(names[2], 0, 180), column(names[3], 0, 9)};
    const auto p = propose_columns(columns);
    ASSERT_TRUE(p.map) << names[0];
    EXPECT_EQ(
        p.map->columns,
        (Map{{"theta_i", names[0]}, {"theta_o", names[1]}, {"phi_o", names[2]}, {"f", names[3]}}))
        << names[0];
  }
}

TEST(ColumnProposal, CosineCorrectedValuesAndColumnsOfWavelengthsAreRecognised) {
  const std::vector<ColumnSummary> corrected{column("aoi", 0, 75), column("theta_s", 0, 80),
                                             column("ccBRDF", 0, 1)};
  const auto p = propose_columns(corrected);
  ASSERT_TRUE(p.map);
  EXPECT_TRUE(p.map->cosines == (CosinePowers{0, 1}));
  EXPECT_TRUE(p.needed);
  const std::vector<ColumnSummary> bands{column("aoi", 0, 75), column("theta_s", 0, 80),
                                         column("390nm", 0, 1), column("400.5nm", 0, 1),
                                         column("f", 0, 1)};
  const auto q = propose_columns(bands);
  ASSERT_TRUE(q.map);
  EXPECT_EQ(q.map->columns, (Map{{"theta_i", "aoi"}, {"theta_o", "theta_s"}, {"f_*", "*nm"}}));
  EXPECT_FALSE(q.map->cosines == (CosinePowers{0, 1}));
}

TEST(ColumnProposal, NumbersAsNamesAreWavelengthsWhereBothAnglesHaveOne) {
  const std::vector<ColumnSummary> spectra{column("AOI [deg]", 0, 75), column("AOR (deg)", -80, 80),
                                           column("400", 0, 1), column("450.5", 0, 1)};
  const auto p = propose_columns(spectra);
  ASSERT_TRUE(p.map);
  EXPECT_EQ(p.map->columns, (Map{{"theta_i", "AOI [deg]"},
                                 {"theta_o", "AOR (deg)"},
                                 {"f_400", "400"},
                                 {"f_450.5", "450.5"}}));
  auto other = spectra;
  other.push_back(column("12", 0, 1));  // no wavelength
  EXPECT_FALSE(propose_columns(other).map);
}

TEST(ColumnProposal, RadianceFactorsAreDividedByPiAndByAHundredInPercent) {
  constexpr double of_part = 0.31830988618379067;
  for (const auto& [name, scale] : {std::pair("R [%]", of_part / 100),
                                    {"Reflectance (percent)", of_part / 100},
                                    {"BRF", of_part},
                                    {"radiance factor", of_part}}) {
    const std::vector<ColumnSummary> columns{column("angle of incidence", 0, 75),
                                             column("angle of reflection", -80, 80),
                                             column(name, 0, 90)};
    const auto p = propose_columns(columns);
    ASSERT_TRUE(p.map) << name;
    EXPECT_EQ(p.map->columns.back(), std::pair(std::string("f"), std::string(name)));
    EXPECT_DOUBLE_EQ(p.map->scale, scale) << name;
  }
  // A radius, or what a name says nothing of, is no radiance factor; f beside one is f.
  const std::vector<ColumnSummary> radius{column("aoi", 0, 75), column("aor", -80, 80),
                                          column("R", 0, 90)};
  EXPECT_FALSE(propose_columns(radius).map);
  const std::vector<ColumnSummary> both{column("aoi", 0, 75), column("aor", -80, 80),
                                        column("R [%]", 0, 90), column("BRDF", 0, 9)};
  EXPECT_EQ(propose_columns(both).map->scale, 1);
}

TEST(ColumnProposal, UncertaintiesAreRecognised) {
  using Case = std::pair<const char*, const char*>;
  for (const auto& [name, role] :
       {Case{"uBRDF", "u_f"}, Case{"u_brdf [1/sr]", "u_f"}, Case{"sigma", "u_f"},
        Case{"std", "u_f"}, Case{"unc", "u_f"}, Case{"uncertainty", "u_f"}, Case{"f_std", "u_f"},
        Case{"standard uncertainty (k=1)", "u_f"}, Case{"U (k=2)", "U_f"}, Case{"U", "U_f"},
        Case{"U_brdf", "U_f"}, Case{"expanded uncertainty", "U_f"}, Case{"unc [%]", "u_percent"},
        Case{"U (k=2) [%]", "U_percent"}, Case{"rel. unc", "u_rel"},
        Case{"relative uncertainty", "u_rel"}}) {
    const std::vector<ColumnSummary> columns{column("aoi", 0, 75), column("theta_s", 0, 80),
                                             column("brdf", 0, 9), column(name, 0.01, 2)};
    const auto p = propose_columns(columns);
    ASSERT_TRUE(p.map) << name;
    EXPECT_EQ(p.map->columns,
              (Map{{"theta_i", "aoi"}, {"theta_o", "theta_s"}, {"f", "brdf"}, {role, name}}))
        << name;
    auto zero = columns;
    zero[3].lowest = 0;
    EXPECT_EQ(propose_columns(zero).map->columns.size(), 3U) << name << ": it would be refused";
  }
  const std::vector<ColumnSummary> bands{column("aoi", 0, 75),  column("theta_s", 0, 80),
                                         column("390nm", 0, 1), column("u_390nm", 0.1, 1),
                                         column("400nm", 0, 1), column("u_400nm", 0.1, 1)};
  EXPECT_EQ(propose_columns(bands).map->columns,
            (Map{{"theta_i", "aoi"}, {"theta_o", "theta_s"}, {"f_*", "*nm"}, {"u_f_*", "u_*nm"}}));
}

TEST(ColumnProposal, UncertaintiesOfEachWavelengthKeepUnitAndFactor) {
  using Case = std::array<const char*, 4>;  // value, uncertainty, their patterns
  const std::pair<Case, const char*> cases[] = {
      {{"BRDF {} nm [1/sr]", "U {} nm (k=2) [%]", "BRDF * nm [1/sr]", "U * nm (k=2) [%]"},
       "U_percent_*"},
      {{"{} nm", "{} nm unc. rel. (k=1)", "* nm", "* nm unc. rel. (k=1)"}, "u_rel_*"},
      {{"{}nm", "U95_{}nm", "*nm", "U95_*nm"}, "U_f_*"},
      {{"{}nm", "U{}nm", "*nm", "U*nm"}, "U_f_*"}};
  for (const auto& [names, role] : cases) {
    std::vector<std::string> all;
    for (const int k : {0, 1})
      for (const int nm : {450, 550}) all.push_back(fmt::format(fmt::runtime(names[k]), nm));
    std::vector<ColumnSummary> columns{column("aoi", 0, 75), column("theta_s", 0, 80)};
    for (const auto& name : all) columns.push_back(column(name.c_str(), 0.1, 2));
    const auto p = propose_columns(columns);
    ASSERT_TRUE(p.map) << names[1];
    EXPECT_EQ(
        p.map->columns,
        (Map{{"theta_i", "aoi"}, {"theta_o", "theta_s"}, {"f_*", names[2]}, {role, names[3]}}))
        << names[1];
    ASSERT_EQ(p.said.size(), 1U) << names[1];
    EXPECT_EQ(p.said[0].find("expanded") != std::string::npos, role[0] == 'U') << p.said[0];
    EXPECT_EQ(p.said[0].ends_with("in percent"), role == std::string("U_percent_*")) << p.said[0];
    columns.back().lowest = 0;
    EXPECT_EQ(propose_columns(columns).map->columns.size(), 3U) << "it would be refused";
  }
}

TEST(ColumnProposal, CoverageFactorsAreReadOrTheColumnIsNamedAsNotUsed) {
  const auto with = [](const char* name) {
    return propose_columns(std::vector{column("aoi", 0, 75), column("theta_s", 0, 80),
                                       column("brdf", 0, 9), column(name, 0.01, 2)});
  };
  using Case = std::pair<const char*, const char*>;
  for (const auto& [name, role] :
       {Case{"U (k=1) [%]", "u_percent"}, Case{"U (k=2.0)", "U_f"}, Case{"U95 [%]", "U_percent"},
        Case{"U (95 %) [1/sr]", "U_f"}, Case{"2 sigma (%)", "U_percent"}, Case{"1σ", "u_f"},
        Case{"expanded uncertainty (k = 2) in %", "U_percent"},
        Case{"erweiterte Messunsicherheit [%]", "U_percent"},
        Case{"Standardabweichung [sr^-1]", "u_f"}}) {
    const auto p = with(name);
    EXPECT_EQ(p.map->columns.back(), (std::pair<std::string, std::string>(role, name)));
    EXPECT_EQ(p.said.size(), 1U) << name;
  }
  for (const char* name : {"U (k=3) [%]", "3 sigma", "unc [ppm]", "U [‰]", "uncertainty budget"}) {
    const auto p = with(name);
    EXPECT_EQ(p.map->columns.size(), 3U) << name;
    ASSERT_EQ(p.said.size(), 1U) << name;
    EXPECT_TRUE(p.said[0].starts_with(std::string(name) + " looks like an uncertainty"))
        << p.said[0];
  }
  for (const char* name : {"angle uncertainty", "sigma_theta_i", "comment", "run 2"})
    EXPECT_TRUE(with(name).said.empty()) << name;
}

TEST(ColumnProposal, ColumnsOfOneNameGoByTheirNumber) {
  const std::vector<ColumnSummary> columns{column("aoi", 0, 75), column("theta_s", 0, 80),
                                           column("brdf", 0, 1), column("brdf", 0, 2)};
  EXPECT_EQ(propose_columns(columns).map->columns[2],
            (std::pair<std::string, std::string>("f", "#3")));
}

}  // namespace
}  // namespace gonio
