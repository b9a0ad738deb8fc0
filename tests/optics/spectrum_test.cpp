// Spectra to linear RGB: the white of the light, the perfect reflector, and metals' colours.
#include "optics/spectrum.h"

#include <cmath>
#include <fstream>
#include <map>

#include "optics/fresnel.h"
#include "support.h"

namespace gonio {
namespace {

using Rgb = std::array<double, 3>;

TEST(Spectrum, WhiteUnderD65HasItsPublishedChromaticity) {
  const auto v = xyz(spectrum([](double) { return 1.0; }));
  EXPECT_NEAR(v[0] / (v[0] + v[1] + v[2]), 0.3127, 5e-5);
  EXPECT_NEAR(v[1] / (v[0] + v[1] + v[2]), 0.3290, 5e-5);
  EXPECT_NEAR(v[1], 1, 1e-15);
}

TEST(Spectrum, PerfectReflectorIsWhiteAndBlackIsBlack) {
  for (const double x : linear_srgb(spectrum([](double) { return 1.0; }))) EXPECT_NEAR(x, 1, 1e-14);
  for (const double x : linear_srgb(spectrum([](double) { return 0.0; }))) EXPECT_EQ(x, 0);
}

TEST(Spectrum, MatrixIsThatOfTheStandardToItsRounding) {
  // IEC 61966-2-1 prints four digits, for a white of (0.3127, 0.3290).
  constexpr std::array<Rgb, 3> standard{
      {{3.2406, -1.5372, -0.4986}, {-0.9689, 1.8758, 0.0415}, {0.0557, -0.2040, 1.0570}}};
  for (const double centre : {450.0, 550.0, 650.0}) {
    const auto s = spectrum([=](double nm) { return std::exp(-std::pow((nm - centre) / 30, 2)); });
    const auto v = xyz(s), rgb = linear_srgb(s);
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(rgb[i], standard[i][0] * v[0] + standard[i][1] * v[1] + standard[i][2] * v[2],
                  5e-4)
          << centre << " " << i;
  }
}

TEST(Spectrum, IsAddedLight) {
  const auto ramp = spectrum([](double nm) { return (nm - 360) / 470; });
  const auto back = spectrum([](double nm) { return (830 - nm) / 470; });
  const auto a = linear_srgb(ramp), b = linear_srgb(back);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(a[i] + b[i], 1, 1e-14);
  EXPECT_GT(a[0], b[0]) << "reflects more of the long waves: reddish";
  EXPECT_LT(a[2], b[2]);
}

// The same integral by 1 nm, done apart from this code with complex numbers and the matrix that has
// 7 digits.
TEST(ReflectanceRgb, IsThatOfAFinerIntegral) {
  struct Colours {
    const char* symbol;
    Rgb normal, grazing;  // at c = 1 and 0.1
  };
  for (const auto& [symbol, normal, grazing] :
       {Colours{"Au", {1.0376, 0.7284, 0.3646}, {0.9922, 0.8928, 0.7242}},
        {"Cu", {0.9317, 0.6227, 0.5223}, {0.9598, 0.8085, 0.7665}},
        {"Ag", {0.9894, 0.9840, 0.9778}, {0.9900, 0.9892, 0.9905}},
        {"Al", {0.9073, 0.9159, 0.9223}, {0.8362, 0.8734, 0.9085}},
        {"Ni", {0.6971, 0.6405, 0.5632}, {0.7277, 0.7263, 0.7286}},
        {"Fe", {0.5297, 0.5132, 0.4942}, {0.6324, 0.6294, 0.6506}},
        {"Ti", {0.6186, 0.5794, 0.5425}, {0.6620, 0.6693, 0.6821}},
        {"Pt", {0.6779, 0.6377, 0.5836}, {0.7009, 0.7121, 0.7226}}})
    for (std::size_t i = 0; i < 3; ++i) {
      const Material& m = *find_metal(symbol);
      EXPECT_NEAR(reflectance_rgb(m, 1)[i], normal[i], 5e-4) << symbol << " channel " << i;
      EXPECT_NEAR(reflectance_rgb(m, 0.1)[i], grazing[i], 5e-4) << symbol << " channel " << i;
    }
}

TEST(ReflectanceRgb, OfGlassIsNearlyGrey) {
  constexpr Rgb glass{0.0419, 0.0423, 0.0434}, water{0.0202, 0.0206, 0.0211};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(reflectance_rgb(*find_material("BK7"), 1)[i], glass[i], 2e-4);
    EXPECT_NEAR(reflectance_rgb(*find_material("water"), 1)[i], water[i], 2e-4);
  }
}

TEST(ReflectanceRgb, IsWhiteAtGrazing) {
  for (const auto& m : metals())
    for (const double x : reflectance_rgb(m, 0)) EXPECT_NEAR(x, 1, 1e-13) << m.name;
}

TEST(ReflectanceRgb, AndItsShortcutAreTheSameWhereTheSpectrumIsFlat) {
  const Material::Measured flat[] = {{500, 0.2, 3}, {600, 0.2, 3}};
  const Material grey{"grey", "grey", "", flat};
  for (const double c : {0.0, 0.1, 0.5, 1.0}) {
    const auto exact = reflectance_rgb(grey, c), shortcut = reflectance_per_channel(grey, c);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(exact[i], shortcut[i], 1e-13) << c;
  }
}

TEST(ReflectanceRgb, OfTheShortcutIsFarOffForGoldAndNearForAluminium) {
  const auto worst = [](const char* symbol) {
    double w = 0;
    const auto exact = reflectance_rgb(*find_metal(symbol), 1),
               shortcut = reflectance_per_channel(*find_metal(symbol), 1);
    for (std::size_t i = 0; i < 3; ++i) w = std::max(w, std::abs(exact[i] - shortcut[i]));
    return w;
  };
  EXPECT_NEAR(worst("Au"), 0.081, 1e-3) << "red is out of the gamut: 1.038 for 0.957";
  EXPECT_LT(worst("Al"), 0.005);
}

TEST(WavebandColours, AddUpToWhiteAndToTheColoursOfMetals) {
  const auto bands = waveband_colours();
  for (std::size_t c = 0; c < 3; ++c) {
    double white = 0;
    for (const auto& b : bands) white += b.rgb[c];
    EXPECT_NEAR(white, 1, 1e-13);
  }
  double worst = 0;
  for (const auto& m : metals())
    for (const double cosine : {0.02, 0.1, 0.3, 0.6, 1.0}) {
      Rgb sum{};
      for (const auto& b : bands) {
        const Index n = m.at(b.nm);
        const std::array p{n.n, n.k};
        const double f = Conductor<double>(p)({cosine, cosine, 1, cosine, 0}).value();
        for (std::size_t c = 0; c < 3; ++c) sum[c] += b.rgb[c] * f;
      }
      const auto exact = reflectance_rgb(m, cosine);
      for (std::size_t c = 0; c < 3; ++c) worst = std::max(worst, std::abs(sum[c] - exact[c]));
    }
  EXPECT_LT(worst, 4e-3);
}

/// A CSV of numbers under a line of names.
std::vector<std::vector<double>> table(const std::string& path) {
  std::vector<std::vector<double>> rows;
  std::ifstream in(path);
  std::string line;
  for (std::getline(in, line); std::getline(in, line);) {
    rows.emplace_back();
    for (std::size_t from = 0, to = 0; to != line.npos; from = to + 1) {
      to = line.find(',', from);
      rows.back().push_back(std::stod(line.substr(from, to - from)));
    }
  }
  return rows;
}

TEST(Spectrum, ColoursGoToXyzAndBack) {
  const auto red = spectrum([](double nm) { return nm > 600 ? 0.8 : 0.1; });
  const auto there = xyz(red), back = xyz_of_srgb(linear_srgb(red));
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(back[i], there[i], 1e-12) << i;
}

TEST(Spectrum, IsThatOfThePublishedTablesAtOneNanometre) {
  GONIO_NEEDS_SHARED(observer, "data/cie/cie1931_2deg_1nm.csv");
  GONIO_NEEDS_SHARED(light, "data/cie/d65.csv");
  std::map<double, double> d65;
  for (const auto& row : table(light)) d65[row.at(0)] = row.at(1);
  const auto reflectance = [](double nm) { return 0.5 + 0.4 * std::sin(nm / 60); };
  Rgb sum{};
  double white = 0;
  for (const auto& row : table(observer)) {
    const auto above = d65.lower_bound(row[0]);
    const auto below = above->first == row[0] ? above : std::prev(above);
    const double t = above == below ? 0 : (row[0] - below->first) / (above->first - below->first);
    const double power = std::lerp(below->second, above->second, t);
    for (std::size_t i = 0; i < 3; ++i) sum[i] += power * row.at(1 + i) * reflectance(row[0]);
    white += power * row[2];
  }
  const auto v = xyz(spectrum(reflectance));
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(v[i], sum[i] / white, 2e-4) << i;
}

}  // namespace
}  // namespace gonio
