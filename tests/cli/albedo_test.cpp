// gonio albedo: what it prints, and what it refuses.
#include <cmath>

#include "cli/program.h"
#include "many_fits.h"

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
  for (const char* how : {"single", "turquin", "walk", "deterministic"})
    for (const char* phi : {"nan", "inf"})
      expect_one_line(gonio(f, std::string("albedo ") + white + " --mu 0.5 --phi " + phi +
                                   " --scattering " + how),
                      2, "azimuth");
  expect_one_line(gonio(f, std::string("albedo ") + white), 2, "--mu");
  expect_one_line(gonio(f, std::string("albedo ") + white + " --mu 1 --scattering hike"), 2,
                  "scattering");
  expect_one_line(gonio(f, std::string("albedo ") + white + " --mu 1 --error 0"), 2, "--error");
  expect_one_line(gonio(f, "albedo ggx/smith_gx/schlick --mu 1"), 2, "smith_gx");
}

constexpr const char* grey = "ggx/smith_ggx.correlated/schlick --set alpha=0.7 f0=0.6";

TEST(AlbedoCommand, AWalkAgreesWithTheHalfSpaceByOrders) {
  const Folder f;
  const std::string words = std::string("albedo ") + grey + " --mu 0.2,1 --average --json";
  const auto solved = gonio(f, words + " --scattering deterministic").json();
  const auto walked = gonio(f, words + " --scattering walk --walks 50000 --seed 3").json();
  EXPECT_LE(solved["error_bound"], 1e-5);
  EXPECT_EQ(walked["seed"], 3);
  EXPECT_EQ(walked["walks"], 50000);
  EXPECT_GT(walked["bounces"], 150000);
  for (std::size_t i = 0; i < 2; ++i) {
    const double error = walked["standard_error"][i];
    EXPECT_NEAR(walked["albedo"][i], solved["albedo"][i], 4 * error + 1e-5);
    EXPECT_LT(error, 0.01);
    EXPECT_LE(4 * error, walked["error_bound"]);
    for (std::size_t n = 0; n < 3; ++n)
      EXPECT_NEAR(walked["orders"][i][n], solved["orders"][i][n], 5 * error);
    EXPECT_GE(walked["rest"][i], 0);
  }
  for (const char* name : {"average", "average_orders", "average_rest"})
    for (const auto& j : {solved, walked}) EXPECT_EQ(j[name].size(), 1U) << name;
  EXPECT_EQ(walked["average_standard_error"].size(), 1U);
  EXPECT_NEAR(walked["average"][0], solved["average"][0], walked["error_bound"]);
  EXPECT_NEAR(walked["average_orders"][0][0], solved["average_orders"][0][0],
              walked["error_bound"]);
}

TEST(AlbedoCommand, AWalkIsTheSameForASeedWhateverElseIsAsked) {
  const Folder f;
  const std::string words =
      std::string("albedo ") + grey + " --scattering walk --walks 20000 --json --mu ";
  const auto one = gonio(f, words + "0.5").json(),
             two = gonio(f, words + "0.2,0.5 --jobs 1").json();
  EXPECT_EQ(one["albedo"][0], two["albedo"][1]);
  EXPECT_NE(one["albedo"][0], gonio(f, words + "0.5 --seed 2").json()["albedo"][0]);
  EXPECT_EQ(one.contains("average"), false);
}

TEST(AlbedoCommand, AveragesFewWalks) {
  const Folder f;
  const auto o =
      gonio(f, std::string("albedo ") + grey + " --average --scattering walk --walks 30 --json");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_NEAR(o.json()["average"][0], 0.6, o.json()["error_bound"]);
}

TEST(AlbedoCommand, CompensationsGiveBackAllAtFOne) {
  const Folder f;
  for (const char* how :
       {"kulla_conty", "kulla_conty.linear", "turquin", "fdez_aguera", "deterministic"}) {
    const auto j = gonio(f, std::string("albedo ") + white + " --mu 0.3,1 --average --json " +
                                "--error 1e-5 --scattering " + how)
                       .json();
    EXPECT_EQ(j["scattering"], how);
    for (const double a : {j["albedo"][0], j["albedo"][1], j["average"][0]})
      EXPECT_NEAR(a, 1, 1e-5) << how;
  }
}

TEST(AlbedoCommand, ScatteringLeavesDiffuseTermsToBeAdded) {
  const Folder f;
  const std::string lobe = "ggx/smith_ggx.correlated/schlick --set alpha=0.5 f0=0.04 ";
  for (const char* how : {"deterministic", "kulla_conty"}) {
    const std::string words =
        std::string(" --mu 0.5 --average --error 1e-6 --json --scattering ") + how;
    const auto without = gonio(f, "albedo " + lobe + words).json();
    const auto with = gonio(f, "albedo lambert+" + lobe + "kd=0.3" + words).json();
    EXPECT_NEAR(with["albedo"][0].get<double>(), without["albedo"][0].get<double>() + 0.3, 3e-6);
    EXPECT_NEAR(with["average"][0].get<double>(), without["average"][0].get<double>() + 0.3, 3e-6);
  }
}

TEST(AlbedoCommand, RefusesScatteringOfWhatItIsNotOf) {
  const Folder f;
  const std::string aniso =
      "albedo ggx_aniso/smith_ggx_aniso.correlated/schlick --set alpha_x=0.1 alpha_y=0.9 --mu 0.5 "
      "--scattering ";
  expect_one_line(gonio(f, aniso + "deterministic"), 2, "isotropic");
  EXPECT_EQ(gonio(f, aniso + "walk --walks 1000").code, 0);
  const std::string separable = "albedo ggx/smith_ggx.separable/conductor --mu 0.5 --scattering ";
  expect_one_line_each(f, 2,
                       {{separable + "walk", "smith_ggx.separable"},
                        {separable + "deterministic", "smith_ggx.separable"},
                        {separable + "fdez_aguera", "fresnel.schlick"},
                        {separable + "turquin --walks 10", "--walks"}});
  for (const char* walks : {"0", "1"})
    expect_one_line(gonio(f, separable + "walk --walks " + walks), 2, "walks");
  for (const char* how : {"walk", "deterministic", "kulla_conty"})
    expect_one_line(gonio(f, std::string("albedo ") + white + " --mu 0 --scattering " + how), 2,
                    "outside (0, 1]");
  expect_one_line(gonio(f, "term scattering.walk --at nov=1"), 2, "gonio albedo --scattering walk");
}

TEST(AlbedoCommand, ScatteringSaysThatAnIntegralDiverges) {
  const Folder f;
  expect_one_line(gonio(f,
                        "albedo beckmann_aniso.as_written/none/schlick --set alpha_x=1 "
                        "alpha_y=0.5 --mu 0.5 --error 1e-2 --scattering kulla_conty"),
                  3, "diverges");
}

TEST(AlbedoCommand, SaysThatAModelHasNoAverage) {
  GONIO_MANY_FITS();
  const Folder f;
  expect_one_line(gonio(f,
                        "albedo beckmann_aniso.as_written/none/schlick --set alpha_x=1 "
                        "alpha_y=0.5 --average --error 1e-3"),
                  3, "diverges");
}

TEST(AlbedoCommand, RefusesANegativeSeed) {
  const Folder f;
  expect_one_line(
      gonio(f, std::string("albedo ") + white + " --mu 0.5 --scattering walk --seed -1"), 2,
      "'-1' is below 0");
}

}  // namespace
}  // namespace gonio::test
