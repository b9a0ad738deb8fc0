// Tensor trees: which value holds where, and trees that are none.
#include "table/format/tensor_tree.h"

#include <cmath>
#include <numbers>

#include "table/complaint.h"
#include "table/foreign.h"
#include "table/health/reciprocity.h"

namespace gonio {
namespace {

using namespace test;

Table tree_table(std::size_t axes,
                 const std::string& braces,
                 const std::string& side = "Reflection Front") {
  const Folder folder;
  return read_table(folder.write("a.xml", tensor_tree_file(axes, braces, side)));
}
std::string numbers_in_braces(std::size_t count) {
  std::string text = "{";
  for (std::size_t k = 0; k < count; ++k) text += fmt::format(" {}", k);
  return text + " }";
}

TEST(TensorTree, MapsTheDiscToTheSquareWithItsAreas) {
  for (const double x : {-0.9, -0.3, 0.0, 0.2, 0.6})
    for (const double y : {-0.4, 0.0, 0.1, 0.35}) {
      const auto [a, b] = square_of_disc(x, y);
      const auto [u, v] = disc_of_square(a, b);
      EXPECT_NEAR(u, x, 1e-14);
      EXPECT_NEAR(v, y, 1e-14);
      constexpr double h = 1e-6;
      const auto right = square_of_disc(x + h, y), up = square_of_disc(x, y + h);
      if (std::abs(std::abs(x) - std::abs(y)) < 1e-3)
        continue;  // on a diagonal the map has an edge
      EXPECT_NEAR(((right.x - a) * (up.y - b) - (right.y - b) * (up.x - a)) / (h * h),
                  1 / std::numbers::pi, 1e-5);
    }
  EXPECT_NEAR(square_of_disc(1, 0).x, 1, 1e-15);
  EXPECT_NEAR(square_of_disc(1, 0).y, 0.5, 1e-15);
}

TEST(TensorTree, OfThreeAxesLaysTheMirrorDirectionAtPlusX) {
  // One leaf of 2 × 2 × 2 values: the incident half that exists, then x, then y fastest.
  const Table t = tree_table(3, numbers_in_braces(8));
  ASSERT_EQ(t.size(), 4U) << "the other half of the incident coordinate has no angle";
  const auto f = [&](double phi_i, double theta_o, double phi_o) {
    return t.between({direction(0.6, phi_i), direction(theta_o, phi_o)}, 0);
  };
  using std::numbers::pi;
  EXPECT_EQ(f(0, 0.6, pi - 0.1), 2 + 0) << "forward and to its right";
  EXPECT_EQ(f(0, 0.6, pi + 0.1), 2 + 1);
  EXPECT_EQ(f(0, 0.6, 0.1), 0) << "backward: turned by half a turn";
  EXPECT_EQ(f(1.3, 0.6, 1.3 + pi - 0.1), 2) << "turned with the light";
  EXPECT_TRUE(std::isnan(f(0, 1.6, 0)));
  for (std::size_t i = 0; i < t.size(); ++i)
    EXPECT_EQ(t.between(SampleAngles(t).directions(i), 0), t.values[0][i]);
}

TEST(TensorTree, OfFourAxesNegatesTheIncidentPoint) {
  // A branch whose nodes are numbered by bits, the first axis the lowest.
  std::string braces = "{";
  for (int k = 0; k < 16; ++k) braces += fmt::format("{{ {} }}", k);
  const Table t = tree_table(4, braces + "}"),
              back = tree_table(4, braces + "}", "Reflection Back");
  ASSERT_EQ(t.size(), 16U);
  const DirectionPair p{direction(0.5, 0.3), direction(0.4, 0.3 + std::numbers::pi / 2)};
  // −wi lies at −x, −y: bits 0 and 1 clear; wo at −x, +y: bit 3 set.
  EXPECT_EQ(t.between(p, 0), 8);
  const auto turned = [](const Direction& d) { return Direction{d.x, -d.y, d.z}; };
  EXPECT_EQ(back.between({turned(p.wi), turned(p.wo)}, 0), 8);
  for (const Table* of : {&t, &back})
    for (std::size_t i = 0; i < 16; ++i)
      EXPECT_EQ(of->between(SampleAngles(*of).directions(i), 0), of->values[0][i]);
}

TEST(TensorTree, HasCellsOfUnlikeSizes) {
  std::string braces = "{";
  for (int k = 0; k < 8; ++k) braces += k == 6 ? numbers_in_braces(8) : "{ 100 }";
  const Table t = tree_table(3, braces + "}");
  EXPECT_EQ(t.size(), 3U + 8);  // node 6 is incident low (sine above 0), x and y high
  EXPECT_NEAR(t.patch_deg, std::sqrt(std::numbers::pi) / 4 / degree, 1e-9);
}

TEST(TensorTree, ThatIsNoneIsRefused) {
  const auto said = [](const std::string& braces) {
    return complaint_about(tensor_tree_file(3, braces));
  };
  EXPECT_HAS(said("{ 1 2 3 }"), "found a leaf of 3 values, expected 1, 8 or another power of that");
  EXPECT_HAS(said("{ 1 "), "expected a number");
  EXPECT_HAS(said("{ 1 x }"), "found 'x', expected a number");
  EXPECT_HAS(said("{ nan }"), "found 'nan'");
  EXPECT_HAS(said("{}"), "a leaf of 0 values");
  EXPECT_HAS(said("{{1}{2}}"), "found '}', expected '{'");
  EXPECT_HAS(said("{ 1 } 2"), "expected the end of the tree");
  EXPECT_HAS(said(std::string(10'000, '{')), "at most 16 levels");
}

TEST(TensorTree, OfASharedFileReflectsWhatRadianceSays) {
  GONIO_NEEDS_SHARED(path, "data/instruments/t3.xml");
  const Table t = read_table(path);
  EXPECT_EQ(t.format, "tensor_tree");
  // By 512² cells of equal projected solid angle.
  const auto albedo = [&](double theta) {
    double sum = 0;
    constexpr int n = 512;
    for (int a = 0; a < n; ++a)
      for (int b = 0; b < n; ++b) {
        const auto [x, y] = disc_of_square((a + 0.5) / n, (b + 0.5) / n);
        sum += t.between({direction(theta * degree, std::numbers::pi),
                          {x, y, std::sqrt(std::max(0.0, 1 - x * x - y * y))}},
                         0);
      }
    return sum * std::numbers::pi / (n * n);
  };
  EXPECT_NEAR(albedo(0), 0.388, 0.002);
  EXPECT_NEAR(albedo(80), 0.536, 0.002);
  EXPECT_GT(*reciprocity(t).error, 0.05) << "of what lies between, as few leaves find a partner";
}

}  // namespace
}  // namespace gonio
