// RGL's tensor files: what they were made from comes back, at the samples and between them.
#include "base/error.h"
#include "support.h"
#include "table/convert/convert.h"
#include "table/foreign.h"
#include "table/format/formats.h"
#include "table/health/directional_albedo.h"
#include "table/health/health.h"

namespace gonio {
namespace {

using namespace test;
using std::numbers::pi;

Table read(const RglFile& file) {
  const Folder folder;
  return read_table(folder.write("a.bsdf", file.bytes()));
}

double lobe(const DirectionPair& p, std::size_t channel) {
  const auto a = angles(p);
  const double q = a.noh * a.noh * 0.25 + a.sin2_theta_h;
  return 0.05 * static_cast<double>(channel + 1) + 0.25 / (pi * q * q) / 4;
}

void expect_values(const Table& t, const Brdf& f) {
  const SampleAngles at(t);
  std::size_t above = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const auto p = at.directions(i);
    if (p.wo.z < least_cosine) {
      EXPECT_TRUE(std::isnan(t.values[0][i]));
      continue;
    }
    ++above;
    for (std::size_t c = 0; c < t.values.size(); ++c) {
      EXPECT_NEAR(t.values[c][i], f(p, c), 1e-6 * f(p, c)) << i;
      EXPECT_NEAR(t.between(p, c), f(p, c), 1e-5 * f(p, c)) << i;
    }
  }
  EXPECT_GT(above, t.size() / 3);
}

TEST(RglFile, GivesBackTheFunctionAtItsOwnDirections) {
  for (const bool jacobian : {true, false})
    for (const bool even : {true, false}) {
      RglFile file{.jacobian = jacobian, .even = even, .f = lobe};
      const Table t = read(file);
      EXPECT_EQ(t.format, "rgl");
      EXPECT_EQ(t.channels, (std::vector<std::string>{"r", "g", "b"}));
      EXPECT_EQ(t.size(), 4 * (7 * 7 + 1)) << "each direction once";
      expect_values(t, lobe);
    }
}

TEST(RglFile, HoldsWavelengthsAsChannels) {
  const Table t = read({.wavelengths = {400, 550.5F, 700, 1000}, .f = lobe});
  EXPECT_EQ(t.channels, (std::vector<std::string>{"400", "550.5", "700", "1000"}));
  expect_values(t, lobe);
}

TEST(RglFile, DefinesTheFunctionBetweenItsSamples) {
  RglFile file{.size = 64, .f = lobe};
  file.theta_i.clear();
  for (int k = 0; k < 16; ++k) file.theta_i.push_back(0.1F * static_cast<float>(k));
  const Table t = read(file);
  double worst = 0;
  for (const double theta_i : {0.05, 0.3, 0.75, 1.1})
    for (const double theta_o : {0.0, 0.3, 0.7, 1.2})
      for (const double phi : {0.1, 1.5, 3.0, 3.14159}) {
        const DirectionPair p{direction(theta_i, 0.7), direction(theta_o, 0.7 + phi)};
        for (std::size_t c = 0; c < 3; ++c)
          worst = std::max(worst, std::abs(t.between(p, c) / lobe(p, c) - 1));
      }
  EXPECT_LT(worst, 0.02);
  EXPECT_TRUE(std::isnan(t.between({direction(0.3, 0), direction(1.6, 0)}, 0)));
}

TEST(RglFile, IsNowhereMoreThanItsSamplesAround) {
  // Values that do not vanish with the cosine, as what an instrument leaves near the horizon.
  RglFile file{.size = 16, .f = [](const DirectionPair& p, std::size_t) {
                 return 0.01 / std::max(p.wo.z, 1e-3);
               }};
  file.theta_i = {0, 0.4F, 0.8F, 1.2F, static_cast<float>(pi / 2)};
  const Table t = read(file);
  const double largest = inspect(t).largest;
  std::size_t values = 0;
  for (double in = 0.5; in < 90; ++in)
    for (double out = 0.5; out < 90; out += in < 60 ? 0.25 : 1)
      for (double phi = 0; phi <= 180; phi += 30) {
        const double f =
            t.between({direction(in * degree, 0), direction(out * degree, phi * degree)}, 0);
        if (out > 89.5) {
          EXPECT_TRUE(std::isnan(f)) << in << " " << out;
        }
        if (std::isnan(f)) continue;
        ++values;
        EXPECT_LE(f, largest * (1 + 1e-6)) << in << " " << out << " " << phi;
      }
  EXPECT_GT(values, 100'000U);
  EXPECT_TRUE(std::isnan(t.between({direction(1.5, 0), direction(0.3, 2)}, 0)))
      << "nearer to 90°, where no sample is valid, than to the last that is";
  file.theta_i.pop_back();
  const Table shorter = read(file);
  EXPECT_TRUE(std::isnan(shorter.between({direction(1.21, 0), direction(0.3, 2)}, 0)));
  EXPECT_FALSE(std::isnan(shorter.between({direction(1.19, 0), direction(0.3, 2)}, 0)));
}

TEST(RglFile, OfAWhiteDiffuserReflectsAll) {
  const RglFile file{.size = 64, .f = [](const auto&, auto) { return 1 / pi; }};
  const Table t = read(file);
  for (const float theta : file.theta_i) {
    const auto a = directional_albedo(t, static_cast<double>(theta) / degree);
    EXPECT_NEAR(a.albedo[0], 1, 0.002) << theta;
    EXPECT_NEAR(a.coverage, 1, 1e-12);
  }
}

TEST(RglFile, IsReciprocalWhereItsFunctionIs) {
  const auto error = [](const Brdf& f) {
    const Table t = read({.size = 32, .f = f});
    return inspect(t).reciprocity_error.value_or(9);
  };
  EXPECT_LT(error(lobe), 0.05);
  EXPECT_GT(error([](const DirectionPair& p, std::size_t c) { return lobe(p, c) * p.wo.z; }), 0.2)
      << "a forgotten cosine";
}

double grooved(const DirectionPair& p, std::size_t) {
  const double x = p.wi.x + p.wo.x, y = p.wi.y + p.wo.y;
  return 0.3 + 0.03 * (x * x - y * y) + 0.05 * p.wi.y * p.wo.y;
}

TEST(RglFile, MayDependOnTheAzimuth) {
  RglFile file{.size = 12, .f = grooved};
  for (int k = 0; k <= 8; ++k) file.phi_i.push_back(static_cast<float>(-pi + k * pi / 4));
  file.phi_i.erase(file.phi_i.begin());
  const Table t = read(file);
  EXPECT_EQ(t.size(), (3 * 8 + 1) * (11 * 11 + 1)) << "both ends are one azimuth, the pole is one";
  expect_values(t, grooved);
  const DirectionPair p{direction(0.4, pi - 1e-4), direction(0.9, 1)};
  const DirectionPair q{direction(0.4, -pi + 1e-4), direction(0.9, 1)};
  EXPECT_NEAR(t.between(p, 0), t.between(q, 0), 1e-4);
}

TEST(RglFile, OverPartOfATurnIsFoldedIntoIt) {
  for (const int parts : {2, 4}) {
    const auto f = [&](const DirectionPair& p, std::size_t c) {
      // Under a half turn alone a product of coordinates stays; under mirrors it does not.
      return grooved(p, c) + (parts == 2 ? 0.05 * p.wi.x * p.wo.y : 0);
    };
    RglFile file{.size = 12, .f = f};
    file.phi_i.clear();
    for (int k = 0; k <= 4; ++k)
      file.phi_i.push_back(static_cast<float>(-pi + k * 2 * pi / parts / 4));
    const Table t = read(file);
    expect_values(t, f);
    const SampleAngles at(t);
    for (std::size_t i = 0; i < t.size(); i += 7) {
      const auto p = at.directions(i);
      // The ends of the part are each other's images, whose grids differ.
      if (p.wo.z < least_cosine || std::abs(p.wi.x * p.wi.y) < 1e-6) continue;
      const auto turned = [](const Direction& d, double x, double y) {
        return Direction{x * d.x, y * d.y, d.z};
      };
      for (const auto& [x, y] : {std::pair{-1, -1}, std::pair{-1, 1}, std::pair{1, -1}})
        if (x == y || parts == 4) {
          EXPECT_NEAR(t.between({turned(p.wi, x, y), turned(p.wo, x, y)}, 0), f(p, 0), 2e-5)
              << parts << " " << i << " " << x << " " << y;
        }
    }
  }
}

TEST(RglFile, NegativeValuesAreMaskedAsNoise) {
  const Table t = read({.f = [](const auto& p, auto) { return p.wo.x > 0 ? -0.01 : 0.2; }});
  const Health h = inspect(t);
  EXPECT_GT(h.masked[static_cast<std::size_t>(Mask::negative)], 0U);
  EXPECT_TRUE(t.negative_is_noise);
}

TEST(RglFile, OfFeltHasTheAlbedoOfItsDatabase) {
  GONIO_NEEDS_SHARED(path, "data/rgl/acrylic_felt_green_rgb.bsdf");
  const Table t = read_table(path);
  EXPECT_EQ(t.format, "rgl");
  constexpr std::array<std::array<double, 2>, 5> known{
      {{0, 0.218}, {20, 0.227}, {40, 0.252}, {60, 0.306}, {75, 0.366}}};
  for (const auto& [theta_deg, green] : known)
    EXPECT_NEAR(directional_albedo(t, theta_deg).albedo[1], green, 0.001) << theta_deg;
  ConvertOptions options;
  options.format = "mbsdf";
  const auto made = convert(t, options);
  const Health from = inspect(t), to = inspect(made.table);
  EXPECT_LE(to.largest, from.largest * (1 + 1e-6));
  EXPECT_GT(made.loss.without_data, 0U);
  EXPECT_LT(made.loss.without_data * 5, made.loss.bins);
  const SampleAngles at(t);
  for (std::size_t i = 0; i < t.size(); ++i)
    if (mask(at(i), t.values[1][i]) == Mask::valid && at(i).nol > 1e-3 &&
        at(i).sin2_theta_h > 1e-12) {
      EXPECT_NEAR(t.between(at.directions(i), 1), t.values[1][i], 2e-4 * t.values[1][i]) << i;
    }
}

}  // namespace
}  // namespace gonio
