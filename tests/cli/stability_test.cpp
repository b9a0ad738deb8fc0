// gonio stability: what it says, how it exits, what it refuses.
#include "cli/program.h"

namespace gonio::test {
namespace {

/// What is smaller than the least number that is asked for errs by a share of that.
TEST(StabilityCommand, SaysByHowMuchASmallValueErrs) {
  const Folder f;
  const auto out =
      gonio(f, "stability ndf.ggx --domain alpha=0.003,0.0031 --require relative=0.02").out;
  EXPECT_NE(out.find("of 6.1e-05, the least that is asked for"), out.npos) << out;
  EXPECT_NE(out.find(", where values are normal numbers"), out.npos) << out;
  EXPECT_EQ(out.find("nowhere: relative=0.02 from there on"), out.npos) << out;
}

TEST(StabilityCommand, AnswersForOnesOwnDomain) {
  const Folder f;
  const auto o =
      gonio(f, "stability ndf.ggx --domain alpha=0.1,0.11 --require relative=0.02 --json");
  EXPECT_EQ(o.code, 0) << o.err;
  const auto j = o.json();
  EXPECT_EQ(j["schema"], "gonio.stability/1");
  EXPECT_EQ(j["id"], "ndf.ggx");
  EXPECT_EQ(j["form"], "cross");
  EXPECT_EQ(j["number"], "half");
  EXPECT_EQ(j["evidence"], "exhaustive");
  EXPECT_EQ(j["holds"], true);
  EXPECT_TRUE(j["counterexample"].is_null());
  EXPECT_EQ(j["domain"]["alpha"][1], 0.11);
}

TEST(StabilityCommand, NamesTheLeastOfEveryRequirementInOneCall) {
  const Folder f;
  const auto o = gonio(f, "stability ndf.ggx --domain alpha=0.001,0.1 --least --json");
  const auto least = o.json()["least"];
  ASSERT_EQ(least.size(), 8U);
  EXPECT_EQ(least[0]["requirement"], "finite");
  EXPECT_EQ(least[0]["value"], o.json()["safe_from"]);
  EXPECT_EQ(least[7]["requirement"], "absolute=0.002");
  EXPECT_EQ(least[7]["flush"], true);
  const auto text = gonio(f, "stability ndf.ggx --domain alpha=0.001,0.1 --least").out;
  EXPECT_NE(text.find("(roughness 0.0"), text.npos) << text;
}

TEST(StabilityCommand, ExitsWith1AndAnInputWhereWhatIsRequiredDoesNotHold) {
  const Folder f;
  const std::string words = "stability ndf.ggx --domain alpha=0.001,0.0012 ";
  const auto o = gonio(f, words + "--json");
  EXPECT_EQ(o.code, 1);
  const auto j = o.json();
  EXPECT_EQ(j["holds"], false);
  EXPECT_TRUE(j["counterexample"]["value"].is_null());  // infinite
  EXPECT_EQ(j["counterexample"]["inputs_hex"]["alpha"], "0x1419");
  const auto text = gonio(f, words);
  EXPECT_EQ(text.code, 1);
  EXPECT_NE(text.out.find("does not hold"), text.out.npos) << text.out;
  EXPECT_EQ(text.err, "");
}

TEST(StabilityCommand, TakesTheFormThatHasTheInputsOfTheDomain) {
  const Folder f;
  const auto j = gonio(f, "stability ndf.ggx --domain noh=0.5,0.6 alpha=0.5,0.51 --json").json();
  EXPECT_EQ(j["form"], "cosine");
}

TEST(StabilityCommand, ProvesWhatHoldsOnAnyGpu) {
  const Folder f;
  const std::string words = "stability ndf.ggx --any-gpu --domain alpha=0.1,0.2 ";
  const auto o = gonio(f, words + "--json");
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.json()["any_gpu"], true);
  EXPECT_EQ(o.json()["evidence"], "proved");
  EXPECT_EQ(gonio(f, "stability ndf.ggx --domain alpha=0.1,0.11 --json").json()["any_gpu"], false);
  const auto text = gonio(f, words).out;
  EXPECT_NE(text.find("in half, on any GPU"), text.npos) << text;
  EXPECT_NE(text.find("relative in IEEE arithmetic, at"), text.npos) << text;
  const auto open = gonio(f, words + "--require relative=1e-3");
  EXPECT_EQ(open.code, 1);
  const auto refuted = gonio(f, words + "--require relative=1e-6");
  EXPECT_NE(refuted.out.find("in an arithmetic that GPUs may have"), text.npos) << refuted.out;
}

TEST(StabilityCommand, TakesAsManyBoxesAsItIsGiven) {
  const Folder f;
  const std::string words = "stability fresnel.dielectric --number float --require nonnegative ";
  EXPECT_LE(gonio(f, words + "--boxes 2 --json").json()["boxes"], 2);
}

TEST(StabilityCommand, LooksAtWholeModels) {
  const Folder f;
  const auto o = gonio(f,
                       "stability lambert+ggx/smith_ggx.correlated/schlick --number float --domain "
                       "alpha=0.1,1 nol=0.01,1 nov=0.01,1 --json");
  const auto j = o.json();
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(j["evidence"], "proved");
  EXPECT_EQ(j["domain"].size(), 6U);
  EXPECT_LT(j["worst_rel"], 1e-2);
}

TEST(StabilityCommand, TakesTheNameOfAModelForItsSpec) {
  const Folder f;
  const auto j = gonio(f, "stability disney --number float --boxes 1 --json").json();
  EXPECT_EQ(j["id"], "disney+ggx_aniso/disney_remap/schlick+gtr1/disney_coat/schlick.weighted");
}

TEST(StabilityCommand, RefusesInOneLine) {
  const Folder f;
  expect_one_line_each(f, 2,
                       {{"stability ndf.none", "ndf.none"},
                        {"stability ndf.ggx --domain alpha=0.5,0.1", "reversed"},
                        {"stability ndf.ggx --domain alpha=0.1", "LOW,HIGH"},
                        {"stability ndf.ggx --domain alpha=0.1,7", "outside its range"},
                        {"stability ndf.ggx --domain alpha=nan,1", "alpha"},
                        {"stability ndf.ggx --domain alpha=,", "alpha"},
                        {"stability ndf.ggx --domain beta=0.1,1", "it has: alpha"},
                        {"stability ndf.ggx --require relative", "relative=X"},
                        {"stability ndf.ggx --require relative=x", "relative"},
                        {"stability ndf.ggx --form facet", "facet"},
                        {"stability ndf.ggx --number mixed --any-gpu", "mixed"},
                        {"stability ndf.ggx --flush --any-gpu", "flushing"},
                        {"stability ndf.ggx --number wide", "wide"}});
}

}  // namespace
}  // namespace gonio::test
