// Measured indices: the published figures, and what they must have in common.
#include "optics/refractive_index.h"

#include <cmath>
#include <fstream>
#include <sstream>

#include "optics/fresnel.h"
#include "support.h"

namespace gonio {
namespace {

struct PublishedIndex {
  std::string symbol;
  double n, k;  // at 550 nm
};
class MaterialTest : public testing::TestWithParam<PublishedIndex> {};
INSTANTIATE_TEST_SUITE_P(Metal,
                         MaterialTest,
                         testing::Values(PublishedIndex{"Au", 0.424, 2.472},
                                         PublishedIndex{"Ag", 0.060, 3.597},
                                         PublishedIndex{"Cu", 1.007, 2.582},
                                         PublishedIndex{"Al", 1.015, 6.627},
                                         PublishedIndex{"Cr", 3.181, 3.329},
                                         PublishedIndex{"Fe", 2.950, 2.932},
                                         PublishedIndex{"Ni", 1.921, 3.616},
                                         PublishedIndex{"W", 3.522, 2.741}),
                         [](const auto& test) { return test.param.symbol; });
// At the yellow helium line, 587.6 nm: where glass is catalogued (n_d).
class DispersionTest : public testing::TestWithParam<PublishedIndex> {};
INSTANTIATE_TEST_SUITE_P(Dielectric,
                         DispersionTest,
                         testing::Values(PublishedIndex{"BK7", 1.5168, 0},
                                         PublishedIndex{"H2O", 1.3334, 0},
                                         PublishedIndex{"SiO2", 1.4585, 0},
                                         PublishedIndex{"C", 2.4175, 0},
                                         PublishedIndex{"Al2O3", 1.7682, 0},
                                         PublishedIndex{"TiO2", 2.6142, 0},
                                         PublishedIndex{"PMMA", 1.4906, 0},
                                         PublishedIndex{"PC", 1.5848, 0},
                                         PublishedIndex{"PS", 1.5916, 0}),
                         [](const auto& test) { return test.param.symbol; });

TEST_P(MaterialTest, HasItsPublishedIndexAt550Nanometres) {
  const Material* m = find_metal(GetParam().symbol);
  ASSERT_TRUE(m);
  EXPECT_NEAR(m->rgb()[1].n, GetParam().n, 6e-4);
  EXPECT_NEAR(m->rgb()[1].k, GetParam().k, 6e-4);
}

TEST_P(DispersionTest, HasItsPublishedIndexAt588Nanometres) {
  const Material* m = find_material(GetParam().symbol);
  ASSERT_TRUE(m);
  EXPECT_NEAR(m->at(587.56).n, GetParam().n, 1e-3);
  EXPECT_EQ(m->at(587.56).k, 0);
  EXPECT_GT(m->at(450).n, m->at(650).n) << "blue is refracted more";
}

TEST(Materials, AreFoundBySymbolOrNameInAnyCase) {
  EXPECT_EQ(find_metal("au"), find_metal("Gold"));
  EXPECT_EQ(find_metal("AL"), find_metal("aluminium"));
  EXPECT_NE(find_metal("Al"), find_metal("Ag"));
  EXPECT_EQ(find_metal("unobtainium"), nullptr);
  EXPECT_EQ(find_metal(""), nullptr);
  EXPECT_EQ(find_metal("A"), nullptr);
  EXPECT_EQ(find_metal("water"), nullptr);
  EXPECT_EQ(find_material("water")->symbol, "H2O");
  EXPECT_EQ(find_material("Au"), find_metal("Au"));
}

void check(const Material& m) {
  EXPECT_FALSE(m.source.empty());
  EXPECT_EQ(find_material(m.symbol), &m);
  EXPECT_EQ(find_material(m.name), &m);
  for (double nm = 360; nm <= 830; nm += 5) {
    EXPECT_TRUE(Conductor<double>::parameters[0].legal.holds(m.at(nm).n)) << m.name << nm;
    EXPECT_TRUE(Conductor<double>::parameters[1].legal.holds(m.at(nm).k)) << m.name << nm;
  }
}
TEST(Materials, LieWithinTheLegalRangesAndNameTheirSource) {
  for (const auto& m : metals()) check(m);
  for (const auto& m : dielectrics()) check(m);
}

TEST(Materials, AreMeasuredOverTheVisibleSpectrumAndGiveBackTheirPoints) {
  for (const auto& m : metals()) {
    const auto& points = m.measured;
    ASSERT_GT(points.size(), 2U) << m.name;
    EXPECT_LE(points.front().nm, 360) << m.name;
    EXPECT_GE(points.back().nm, 830) << m.name;
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_EQ(m.at(points[i].nm).n, points[i].n) << m.name << points[i].nm;
      EXPECT_EQ(m.at(points[i].nm).k, points[i].k) << m.name << points[i].nm;
      if (i == 0) continue;
      const auto &a = points[i - 1], &b = points[i];
      ASSERT_LT(a.nm, b.nm) << m.name;
      EXPECT_NEAR(m.at((a.nm + b.nm) / 2).k, (a.k + b.k) / 2, 1e-12) << m.name << a.nm;
    }
    EXPECT_EQ(m.at(100).n, points.front().n);
    EXPECT_EQ(m.at(2000).k, points.back().k);
  }
}

/// The rows of three numbers of a file of the refractiveindex.info database: µm, n, k.
std::vector<Material::Measured> published(const std::string& path) {
  std::vector<Material::Measured> rows;
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    Material::Measured row{};
    std::string rest;
    if (words >> row.nm >> row.n >> row.k && !(words >> rest)) {
      row.nm *= 1000;
      rows.push_back(row);
    }
  }
  return rows;
}

TEST(Materials, AreThePublishedTables) {
  GONIO_NEEDS_SHARED(folder, "data/ior/refractiveindex.info");
  for (const auto& [symbol, file] : {std::pair{"Ag", "Ag_Johnson"},
                                     {"Al", "Al_Rakic"},
                                     {"Au", "Au_Johnson"},
                                     {"Co", "Co_Johnson"},
                                     {"Cr", "Cr_Johnson"},
                                     {"Cu", "Cu_Johnson"},
                                     {"CuZn", "other_alloys_Cu-Zn_Querry-Cu70Zn30"},
                                     {"Fe", "Fe_Johnson"},
                                     {"Hg", "Hg_Inagaki"},
                                     {"Ni", "Ni_Johnson"},
                                     {"Pt", "Pt_Rakic-LD"},
                                     {"Ti", "Ti_Johnson"},
                                     {"W", "W_Weaver"}}) {
    const auto rows = published(folder + "/" + file + ".yml");
    ASSERT_GT(rows.size(), 20U) << file;
    const Material& m = *find_metal(symbol);
    // Thinned platinum lies on straight lines between its points; the others have them all.
    const double tolerance = m.symbol == "Pt" ? 0.005 : 1e-9;
    for (const auto& row : rows)
      if (360 <= row.nm && row.nm <= 830) {
        EXPECT_NEAR(m.at(row.nm).n, row.n, tolerance * row.n) << symbol << " " << row.nm;
        EXPECT_NEAR(m.at(row.nm).k, row.k, tolerance * row.k) << symbol << " " << row.nm;
      }
  }
}

}  // namespace
}  // namespace gonio
