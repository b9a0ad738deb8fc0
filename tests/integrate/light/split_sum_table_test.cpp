#include "integrate/light/split_sum_table.h"

#include <cmath>
#include <random>

#include "base/error.h"
#include "refusal.h"
#include "support.h"

namespace gonio {
namespace {

using test::Folder;
constexpr const char* correlated_smith = "smith_ggx.correlated";

TEST(SplitSumTable, HoldsAAndBAtTexelCentres) {
  const auto t = split_sum_table(correlated_smith, 5, 4);
  EXPECT_EQ(t.masking, "masking.smith_ggx.correlated");
  EXPECT_LE(t.error, 1e-7);
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t i = 0; i < 5; ++i) {
      const double nov = (static_cast<double>(i) + 0.5) / 5,
                   roughness = (static_cast<double>(j) + 0.5) / 4;
      const auto s = split_sum(correlated_smith, roughness, {{nov}})[0];
      EXPECT_NEAR(t.a[j * 5 + i], s.a, t.error + s.error);
      EXPECT_NEAR(t.b[j * 5 + i], s.b, t.error + s.error);
      const auto [a, b] = t(nov, roughness);
      EXPECT_NEAR(a, t.a[j * 5 + i], 1e-15);
      EXPECT_NEAR(b, t.b[j * 5 + i], 1e-15);
    }
}

TEST(SplitSumTable, IsLookedUpBilinearAndClamped) {
  const SplitSumTable t{"", 2, 2, 0, 0, {0, 1, 2, 7}, {1, 1, 1, 1}};
  EXPECT_EQ(t(0.5, 0.25)[0], 0.5);
  EXPECT_EQ(t(0.25, 0.5)[0], 1);
  EXPECT_EQ(t(0.5, 0.5)[0], 2.5);
  EXPECT_EQ(t(0, 0)[0], 0);
  EXPECT_EQ(t(1, 0.1)[0], 1);
  EXPECT_EQ(t(1, 1)[0], 7);
  EXPECT_EQ(t(0.3, 0.9)[1], 1);
}

/// As the file's own text says: R = A, G = B, bilinear at (NoV, roughness), E = F0 A + B.
TEST(SplitSumTable, ReadBackItGivesTheAlbedoToItsStatedError) {
  const Folder folder;
  const auto exact = split_sum_table(correlated_smith, 32, 32);
  for (const Storage storage : {Storage::single, Storage::half}) {
    write_split_sum_table(folder / "t.exr", exact, storage);
    const auto back = read_split_sum_table(folder / "t.exr");
    EXPECT_EQ(back.masking, exact.masking);
    EXPECT_EQ(back.error, exact.error);
    const auto as_stored = stored(exact, storage);
    EXPECT_EQ(back.a, as_stored.a);
    EXPECT_EQ(back.b, as_stored.b);

    const auto stated = lookup_error(back, 45);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> even(0, 1);
    double sum2 = 0;
    constexpr int points = 300;
    for (int k = 0; k < points; ++k) {
      const double nov = 1 - 0.999 * even(random), roughness = 0.01 + 0.99 * even(random),
                   f0 = even(random);
      const auto model = bind_model("ggx/smith_ggx.correlated/schlick",
                                    {{"roughness", {roughness}}, {"f0", {f0}}}, 1);
      const auto [a, b] = back(nov, roughness);
      const double off = f0 * a + b - directional_albedo(model, {{nov}})[0].value[0];
      EXPECT_LE(std::abs(off), 1.1 * std::max(stated.all.b.max, stated.all.e.max))
          << nov << " " << roughness << " " << f0;
      sum2 += off * off;
    }
    const double rms = std::sqrt(sum2 / points);
    EXPECT_LT(rms, 2 * stated.all.e.rms);
    EXPECT_GT(rms, stated.all.e.rms / 4);  // what is stated is no more than there is
  }
}

TEST(SplitSumTable, LookupsComeNearerTheFinerItIs) {
  double before = 1;
  for (const std::size_t n : {8U, 16U, 32U}) {
    const auto e = lookup_error(split_sum_table(correlated_smith, n, n), 40);
    EXPECT_LT(e.between.e.rms, before / 1.7);  // A changes within NoV of alpha: not as its square
    EXPECT_LT(e.between.e.max, e.all.e.max);
    before = e.between.e.rms;
  }
}

TEST(SplitSumTable, BySamplesComesNearerToQuadrature) {
  const auto truth = split_sum_table(correlated_smith, 12, 12);
  EXPECT_EQ(difference(truth, truth).e.max, 0);
  double before = 1;
  for (const std::size_t n : {16U, 256U, 4096U}) {
    const auto sampled = split_sum_table(correlated_smith, 12, 12, n);
    EXPECT_TRUE(std::isnan(sampled.error));
    const auto off = difference(sampled, truth);
    EXPECT_LT(off.e.rms, before / 4);
    EXPECT_LE(off.a.rms, off.a.max);
    before = off.e.rms;
  }
}

TEST(SplitSumTable, RefusesWhatItCannotReadOrMake) {
  const Folder folder;
  EXPECT_THROW(split_sum_table(correlated_smith, 0, 4), Error);
  EXPECT_THROW(split_sum_table(correlated_smith, 4, 4097), Error);
  Image image;
  image.width = image.height = 1;
  image.channels = {"R", "G"};
  image.planes = {{0.5F}, {0.5F}};
  write_exr(folder / "t.exr", image);
  EXPECT_THROW(read_split_sum_table(folder / "t.exr"), Error);
  image.attributes = {{"gonio:split_sum", ""},
                      {"gonio:masking", "masking.none"},
                      {"gonio:samples", "0"},
                      {"gonio:error", "1e-7"}};
  write_exr(folder / "t.exr", image);
  EXPECT_EQ(read_split_sum_table(folder / "t.exr").error, 1e-7);
  image.planes[1][0] = NAN;
  write_exr(folder / "t.exr", image);
  EXPECT_HAS(test::refusal([&] { read_split_sum_table(folder / "t.exr"); }), "pixel (0, 0)");
}

}  // namespace
}  // namespace gonio
