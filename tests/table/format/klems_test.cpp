// Klems' patches: which way round the matrix and the azimuths go, and what patches can resolve.
#include <algorithm>
#include <numeric>

#include "base/error.h"
#include "integrate/rule/quadrature.h"
#include "support.h"
#include "table/foreign.h"
#include "table/format/formats.h"
#include "table/health/directional_albedo.h"
#include "table/health/health.h"

namespace gonio {
namespace {

using namespace test;
using std::numbers::pi;

Table klems_table(const KlemsFile& file) {
  const Folder folder;
  return read_table(folder.write("a.xml", file.bytes()));
}

/// Not reciprocal and without symmetry: whatever is exchanged shows.
double uneven(const DirectionPair& p, std::size_t) {
  return 0.5 + 0.2 * p.wi.x + 0.1 * p.wi.y + 0.05 * p.wo.x - 0.03 * p.wo.y + 0.02 * p.wo.z;
}

void expect_klems_values(const Table& t, const Brdf& f) {
  const SampleAngles at(t);
  for (std::size_t i = 0; i < t.size(); ++i)
    ASSERT_NEAR(t.values[0][i], f(at.directions(i), 0), 1e-7) << i;
}

TEST(KlemsFile, GivesBackTheFunctionAtItsPatches) {
  for (const bool columns : {true, false}) {
    const Table t = klems_table({.columns = columns, .f = uneven});
    EXPECT_EQ(t.format, "klems");
    EXPECT_EQ(t.channels, std::vector<std::string>{"f"});
    EXPECT_EQ(t.size(), 73U * 73U);
    EXPECT_TRUE(t.weights.empty());
    expect_klems_values(t, uneven);
  }
}

TEST(KlemsFile, IsConstantOverAPatch) {
  const Table t = klems_table({.f = uneven});
  const SampleAngles at(t);
  for (std::size_t i = 0; i < t.size(); i += 13) {
    const auto [wi, wo] = at.directions(i);
    const auto near = [](const Direction& d, double step) {
      return direction(theta_of(d) + std::abs(step), phi_of(d) + step);
    };
    for (const double step : {-0.1, 0.0, 0.1})
      ASSERT_EQ(t.between({near(wi, step), near(wo, -step)}, 0), t.values[0][i]) << i;
  }
  for (const auto& a :
       directional_albedo(klems_table({.f = [](const auto&, auto) { return 1 / pi; }})))
    EXPECT_NEAR(a.albedo[0], 1, 1e-6) << a.theta_i_deg;
}

TEST(KlemsFile, HasTheAlbedoOfItsPatchesHoweverNarrowTheHighlight) {
  // All light goes out at less than 6° from the mirror direction, of which 0.08 is left.
  const auto lobe = [](const DirectionPair& p, std::size_t) {
    return dot({-p.wi.x, -p.wi.y, p.wi.z}, p.wo) > std::cos(6 * degree) ? 1.0 : 0.0;
  };
  Table t = klems_table({.f = lobe});
  ASSERT_EQ(t.patches.size(), t.size());
  EXPECT_NEAR(std::accumulate(t.patches.begin(), t.patches.begin() + 73, 0.0), pi, 1e-3);
  for (std::size_t i = 0; i < t.size(); ++i) t.values[0][i] *= 0.08 / t.patches[i];
  for (const auto& a : directional_albedo(t)) EXPECT_NEAR(a.albedo[0], 0.08, 1e-3) << a.theta_i_deg;
}

TEST(KlemsFile, TakesVisibleReflectionFromTheFrontWhereItCan) {
  const auto block = [](const auto&, std::size_t k) { return static_cast<double>(k); };
  const auto chosen = [&](std::vector<std::string> bands, std::vector<std::string> directions) {
    const Table t =
        klems_table({.bands = std::move(bands), .directions = std::move(directions), .f = block});
    return fmt::format("{} {} {}", t.values[0][0], t.notes[0].second, t.notes[1].second);
  };
  EXPECT_EQ(
      chosen({"Solar", "Visible"}, {"Transmission Front", "Reflection Back", "Reflection Front"}),
      "5 Visible Reflection Front");
  EXPECT_EQ(chosen({"Solar", "NIR"}, {"Reflection Back", "Reflection Front"}),
            "1 Solar Reflection Front");
  EXPECT_EQ(chosen({"Solar", "Visible"}, {"Transmission Back", "Reflection Back"}),
            "3 Visible Reflection Back");
}

TEST(KlemsFile, SeenFromTheBackIsTurnedAboutX) {
  const Table t = klems_table({.directions = {"Reflection Back"}, .f = uneven});
  expect_klems_values(t, [](DirectionPair p, std::size_t) {
    p.wi.y = -p.wi.y;
    p.wo.y = -p.wo.y;
    return uneven(p, 0);
  });
  const SampleAngles at(t);
  for (std::size_t i = 0; i < t.size(); i += 13)
    ASSERT_EQ(t.between(at.directions(i), 0), t.values[0][i]) << i;
}

/// The mean of a GGX-like lobe over solid angles about the patches of the half basis.
KlemsFile averaged_lobe(double alpha) {
  return {.f = [alpha](const DirectionPair& p, std::size_t) {
    double sum = 0;
    int count = 0;
    const auto spread = [](const Direction& d, int x, int y) {
      // 13° square about the direction, in the tangent plane there.
      const double theta = theta_of(d), phi = phi_of(d), side = 13 * degree;
      const double a = side * (x - 1) / 3, b = side * (y - 1) / 3;
      const Direction e{std::cos(theta) * std::cos(phi), std::cos(theta) * std::sin(phi),
                        -std::sin(theta)},
          n{-std::sin(phi), std::cos(phi), 0};
      const Direction r{d.x + a * e.x + b * n.x, d.y + a * e.y + b * n.y, d.z + a * e.z + b * n.z};
      const double l = std::sqrt(dot(r, r));
      return Direction{r.x / l, r.y / l, r.z / l};
    };
    for (int k = 0; k < 81; ++k) {
      const auto a = angles({spread(p.wi, k % 3, k / 3 % 3), spread(p.wo, k / 9 % 3, k / 27)});
      const double q = a.noh * a.noh * alpha * alpha + a.sin2_theta_h;
      sum += 0.02 + alpha * alpha / (pi * q * q) / 4;
      ++count;
    }
    return sum / count;
  }};
}

TEST(KlemsFile, ResolvesNoPeakNarrowerThanItsPatches) {
  const Health narrow = inspect(klems_table(averaged_lobe(0.02))),
               wide = inspect(klems_table(averaged_lobe(0.6)));
  ASSERT_TRUE(narrow.peak && wide.peak);
  EXPECT_FALSE(narrow.peak->resolved) << narrow.peak->half_width_deg;
  EXPECT_TRUE(wide.peak->resolved) << wide.peak->half_width_deg;
  EXPECT_NEAR(wide.peak->alpha, 0.6, 0.1);
}

TEST(KlemsFile, OfAShadeFabricHoldsItsFrontReflection) {
  GONIO_NEEDS_SHARED(path, "data/klems/2011-SA1.xml");
  const Table t = read_table(path);
  EXPECT_EQ(t.size(), 145U * 145U);
  const auto [least, most] = std::ranges::minmax(t.values[0]);
  EXPECT_NEAR(least, 0.154, 0.0005);
  EXPECT_NEAR(most, 0.204, 0.0005);
  // Its maker held the value over all outgoing directions: what is constant tells which is which.
  for (std::size_t i = 0; i < t.size(); ++i) ASSERT_EQ(t.values[0][i], t.values[0][i / 145 * 145]);
  EXPECT_NEAR(directional_albedo(t, 0).albedo[0], pi * 0.153571, 1e-4);
}

}  // namespace
}  // namespace gonio
