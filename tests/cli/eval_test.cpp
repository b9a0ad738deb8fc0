// gonio eval, albedo, synth: a fit document where a spec may stand, and a table between its
// samples.
#include "cli/program.h"

namespace gonio::test {
namespace {

const std::string directions =
    "theta_i,phi_i,theta_o,phi_o\n30,0,30,180\n30,0,31.3,180\n10,0,85,20\n95,0,3,3\n";

/// A folder with the table t.binary, its fit t.json, and at.csv, three directions and one from below.
struct Fitted : Folder {
  Fitted() {
    write("at.csv", directions);
    EXPECT_EQ(gonio(*this, std::string("synth ") + paint + " --layout merl -o t.binary").code, 0);
    EXPECT_EQ(gonio(*this, "fit t.binary -o t.json --quiet").code, 0);
  }
};

TEST(EvalCommand, TakesAFitWhereItTakesAModel) {
  const Fitted f;
  const auto rows = [&](const std::string& what) {
    return gonio(f, "eval " + what + " --directions at.csv --json").json().at("rows");
  };
  const auto fit = rows("t.json"), model = rows(paint);
  ASSERT_EQ(fit.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(fit[i]["f"][c].get<double>(), model[i]["f"][c].get<double>(), 1e-9);
  EXPECT_GT(fit[0]["f"][0].get<double>(), fit[0]["f"][2].get<double>()) << "red paint";
}

TEST(EvalCommand, TakesATableAndSaysWhatItHoldsBetweenItsSamples) {
  const Fitted f;
  const auto table = gonio(f, "eval t.binary --directions at.csv --json").json();
  EXPECT_EQ(table["table"], "t.binary");
  const auto model = gonio(f, std::string("eval ") + paint + " --directions at.csv --json").json();
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const double expected = model["rows"][i]["f"][c];
      EXPECT_NEAR(table["rows"][i]["f"][c].get<double>(), expected, 1e-3 * expected);
    }
  EXPECT_TRUE(table["rows"][3]["f"][0].is_null()) << "light from below";
  f.write("edge.csv", "theta_i,phi_i,theta_o,phi_o\n90.5,0,3,3\n");
  ASSERT_EQ(gonio(f, "convert t.binary t.mbsdf").code, 0);
  const auto edge = gonio(f, "eval t.mbsdf --directions edge.csv --json").json();
  EXPECT_TRUE(edge["rows"][0]["f"][0].is_null()) << "within half a bin of one that has a value";
  ASSERT_EQ(gonio(f, "eval t.binary --directions at.csv -o e.csv").code, 0);
  EXPECT_EQ(gonio(f, "inspect e.csv --json").json()["valid"], 9);
}

TEST(EvalCommand, RefusesWhatHasNoValueThereOrIsNoModel) {
  const Fitted f;
  f.write("list.csv", "theta_i,phi_i,theta_o,phi_o,f\n30,0,30,180,0.1\n");
  f.write("other.json", "{\"schema\": \"gonio.table/1\"}");
  expect_one_line_each(f, 3,
                       {{"eval list.csv --directions at.csv --json", "gonio convert"},
                        {"eval none.json --directions at.csv --json", "none.json"},
                        {"eval other.json --directions at.csv --json", "gonio.fit/1"}});
  expect_one_line_each(f, 2,
                       {{"eval t.json --set kd=1 --directions at.csv --json", "--set"},
                        {"eval t.binary --set kd=1 --directions at.csv --json", "--set"},
                        {"eval t.json --bins edge --directions at.csv --json", "--bins"},
                        {"eval t.json --directions at.csv -o t.json", "is an input"},
                        {"synth t.json --layout in_plane -o t.json", "is an input"}});
}

TEST(AlbedoCommand, TakesAFitWhereItTakesAModel) {
  const Fitted f;
  const auto fit = gonio(f, "albedo t.json --mu 0.5 --json").json();
  const auto model = gonio(f, std::string("albedo ") + paint + " --mu 0.5 --json").json();
  EXPECT_EQ(fit["model"], model["model"]);
  EXPECT_NEAR(fit["albedo"][0][2].get<double>(), model["albedo"][0][2].get<double>(), 1e-8);
}

TEST(SynthCommand, TakesAFitWhereItTakesAModel) {
  const Fitted f;
  ASSERT_EQ(gonio(f, "synth t.json --layout hemisphere -o a.csv").code, 0);
  ASSERT_EQ(gonio(f, std::string("synth ") + paint + " --layout hemisphere -o b.csv").code, 0);
  const auto same = gonio(f, "compare a.csv t.json --json").json();
  EXPECT_LT(same["residuals"]["rms"].get<double>(), 1e-12);
  EXPECT_LT(gonio(f, "compare b.csv t.json --json").json()["residuals"]["rms"].get<double>(), 1e-9);
}

}  // namespace
}  // namespace gonio::test
