// gonio albedo: what it prints, and what it refuses.
#include <cmath>

#include "program.h"

namespace gonio::test {
namespace {

constexpr const char* white = "ggx/smith_ggx.correlated/schlick --set alpha=1 f0=1";

TEST(AlbedoCommand, GivesTheClosedFormsOfWhiteGgxAtAlphaOne) {
  const Folder f;
  const auto o = gonio(f, std::string("albedo ") + white + " --mu 0.01,0.5,1 --average --json");
  ASSERT_EQ(o.code, 0) << o.err;
  const auto j = o.json();
  ASSERT_EQ(j["mu"], (std::vector<double>{0.01, 0.5, 1}));
  ASSERT_EQ(j["albedo"].size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    const double mu = j["mu"][i];
    EXPECT_NEAR(j["albedo"][i], 1 - mu * std::log(1 + 1 / mu), 1e-8);
  }
  ASSERT_EQ(j["average"].size(), 1U);
  EXPECT_NEAR(j["average"][0], 4 / 3.0 * (1 - std::log(2.0)), 1e-8);
  EXPECT_LE(j["error_bound"], 1e-8);
  EXPECT_GT(j["error_bound"], 0);
}

TEST(AlbedoCommand, GivesAnAlbedoPerChannelWhereTheyDiffer) {
  const Folder f;
  const auto j = gonio(f, "albedo lambert --set kd=0.2,0.4,0.9 --mu 0.5 --average --json").json();
  ASSERT_EQ(j["albedo"][0].size(), 3U);
  ASSERT_EQ(j["average"].size(), 3U);
  for (const auto& a : {j["albedo"][0], j["average"]}) {
    EXPECT_NEAR(a[0], 0.2, 1e-12);
    EXPECT_NEAR(a[1], 0.4, 1e-12);
    EXPECT_NEAR(a[2], 0.9, 1e-12);
  }
  EXPECT_FALSE(gonio(f, "albedo lambert --mu 0.5 --json").json().contains("average"));
}

TEST(AlbedoCommand, FurnaceTakesFresnelAway) {
  const Folder f;
  const std::string gold = "albedo ggx/smith_ggx.correlated/conductor --set alpha=1 metal=Au";
  const auto j = gonio(f, gold + " --furnace --mu 1 --json").json();
  EXPECT_NEAR(j["albedo"][0], 1 - std::log(2.0), 1e-8);
  EXPECT_LT(gonio(f, gold + " --mu 1 --json").json()["albedo"][0][2], 0.2);
}

TEST(AlbedoCommand, AnisotropicModelsAreSeenFromAnAzimuth) {
  const Folder f;
  const std::string words =
      "albedo ggx_aniso/smith_ggx_aniso.correlated/schlick --set alpha_x=0.1 alpha_y=0.9 f0=1 "
      "--mu 0.2 --json";
  const double along = gonio(f, words).json()["albedo"][0];
  const double across = gonio(f, words + " --phi 90").json()["albedo"][0];
  const double behind = gonio(f, words + " --phi 180").json()["albedo"][0];
  EXPECT_GT(across, along + 0.1);
  EXPECT_NEAR(along, behind, 2e-8);
}

TEST(AlbedoCommand, IsTheSameForAnyNumberOfThreads) {
  const Folder f;
  const std::string words = std::string("albedo ") + white + " --mu 0.1,0.3,0.7 --average --json";
  EXPECT_EQ(gonio(f, words + " --jobs 1").out, gonio(f, words + " --jobs 2").out);
}

TEST(AlbedoCommand, RefusesWhatItCannotDo) {
  const Folder f;
  for (const char* mu : {"0", "-0.5", "1.5", "nan"})
    expect_one_line(gonio(f, std::string("albedo ") + white + " --mu " + mu), 2, "outside (0, 1]");
  expect_one_line(gonio(f, std::string("albedo ") + white), 2, "--mu");
  expect_one_line(gonio(f, std::string("albedo ") + white + " --mu 1 --scattering walk"), 2,
                  "scattering");
  expect_one_line(gonio(f, std::string("albedo ") + white + " --mu 1 --error 0"), 2, "--error");
  expect_one_line(gonio(f, "albedo ggx/smith_gx/schlick --mu 1"), 2, "smith_gx");
}

TEST(AlbedoCommand, SaysThatAModelHasNoAverage) {
  const Folder f;
  expect_one_line(gonio(f,
                        "albedo beckmann_aniso.as_written/none/schlick --set alpha_x=1 "
                        "alpha_y=0.5 --average --error 1e-3"),
                  3, "diverges");
}

}  // namespace
}  // namespace gonio::test
