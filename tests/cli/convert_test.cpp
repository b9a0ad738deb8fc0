// gonio convert: another format, and what that lost, on the terminal and as a document.
#include "cli/program.h"

namespace gonio::test {
namespace {

TEST(ConvertCommand, PlacesTheLargestDifferenceOfAListThatItLaidOnAGrid) {
  const Folder f;
  ASSERT_EQ(gonio(f,
                  "synth lambert+ggx/smith_ggx.correlated/schlick --set alpha=0.2 --layout "
                  "in_plane -o ip.csv")
                .code,
            0);
  const auto o = gonio(f, "convert ip.csv z.bsdf --to zemax --channels g --reach 30 --json");
  ASSERT_EQ(o.code, 0) << o.err;
  const auto at = o.json()["there_and_back"]["largest_at"];
  for (const char* angle : {"theta_i_deg", "theta_o_deg"}) {
    EXPECT_GE(at[angle].get<double>(), 0);
    EXPECT_LE(at[angle].get<double>(), 90);
  }
}

TEST(ConvertCommand, GoesByTheEndingOrByTheWord) {
  const Folder f;
  ASSERT_EQ(gonio(f, std::string("synth ") + paint + " --layout mbsdf -o p.mbsdf").code, 0);
  const auto list = gonio(f, "convert p.mbsdf p.csv --json");
  ASSERT_EQ(list.code, 0) << list.err;
  EXPECT_EQ(list.json()["method"], "listed");
  EXPECT_EQ(list.json()["there_and_back"]["rms"], 0);
  EXPECT_TRUE(list.json()["there_and_back"]["largest_at"].is_null());
  const auto back = gonio(f, "convert p.csv again --to mbsdf --json").json();
  EXPECT_EQ(back["method"], "gathered");
  EXPECT_EQ(back["bins_from_nearest"], 0);
  EXPECT_EQ(read_bytes(f / "again"), read_bytes(f / "p.mbsdf"));
  EXPECT_EQ(gonio(f, "convert p.mbsdf p.exr --phi-d 60 --json").json()["output"]["format"], "exr");
  EXPECT_EQ(gonio(f, "inspect p.exr --json").json()["format"], "exr");
  const auto coarse = gonio(f, "convert p.mbsdf c.mbsdf --theta 20 --phi 30 --to-bins edge");
  EXPECT_NE(coarse.out.find("20 theta_i × 20 theta_o × 30 phi, bins edge"), std::string::npos)
      << coarse.out;
  EXPECT_NE(coarse.out.find("and back      RMS difference"), std::string::npos);
  EXPECT_EQ(gonio(f, "inspect c.mbsdf --json").json()["bins"], "edge");
}

TEST(ConvertCommand, KeepsAFitWhereTheLayoutCanHoldIt) {
  const Folder f;
  ASSERT_EQ(gonio(f,
                  "synth lambert+ggx/smith_ggx.correlated/schlick --set alpha=0.4 f0=0.05 kd=0.2 "
                  "--layout mbsdf -o p.mbsdf")
                .code,
            0);
  ASSERT_EQ(gonio(f, "convert p.mbsdf p2.mbsdf --theta 60 --phi 91").code, 0);
  const auto fit = gonio(f, "fit p2.mbsdf --json").json();
  EXPECT_NEAR(fit["parameters"]["alpha"]["value"], 0.4, 0.01);
}

TEST(ConvertCommand, TakesAUtiaTableToCsvAndBackToTheSameBytes) {
  const Folder f;
  ASSERT_EQ(
      gonio(f,
            "synth ggx_aniso/smith_ggx_aniso.correlated/schlick --set alpha_x=0.35 alpha_y=0.2 "
            "f0=0.6,0.5,0.4 --layout utia -o a.bin")
          .code,
      0);
  const auto inspected = gonio(f, "inspect a.bin --json").json();
  EXPECT_EQ(inspected["format"], "utia");
  EXPECT_EQ(inspected["warnings"].size(), 0U) << "its side file says what its numbers are";
  ASSERT_EQ(gonio(f, "convert a.bin a.csv").code, 0);
  const auto back = gonio(f, "convert a.csv b.bin --json").json();
  EXPECT_EQ(back["output"]["format"], "utia");
  EXPECT_EQ(back["method"], "copied");
  EXPECT_EQ(read_bytes(f / "b.bin"), read_bytes(f / "a.bin"));
  std::filesystem::remove(f / "b.bin.gonio.json");
  EXPECT_NE(gonio(f, "inspect b.bin").out.find("beware"), std::string::npos);
}

TEST(ConvertCommand, NeverTouchesItsInputAndLeavesNothingWhereItFails) {
  const Folder f;
  ASSERT_EQ(gonio(f, std::string("synth ") + paint + " --layout in_plane -o p.csv").code, 0);
  const auto before = read_bytes(f / "p.csv");
  const auto entries = f.entries();
  expect_one_line_each(f, 2,
                       {{"convert a.csv o.exr --phi-d nan", "not in range 0 to 180"},
                        {"convert a.csv o.exr --reach 1e13", "not in range 0 to 30"},
                        {"columns a.csv --scale nan", "not in range 1e-12 to 1e+12"},
                        {"convert p.csv p.csv", "is an input"},
                        {"convert p.csv ./p.csv", "is an input"},
                        {"convert p.csv p.csv.gonio.json --to csv", "is an input"},
                        {"convert p.csv other", "--to merl"},
                        {"convert p.csv other.txt", "--to merl"},
                        {"convert p.csv o.csv --channels r,x", "no channel 'x'"},
                        {"convert p.csv o.mbsdf --channels r,g", "one channel or three"},
                        {"convert p.csv o.csv --to png", "png"}});
  expect_one_line_each(f, 3,
                       {{"convert p.csv o.mbsdf", "--reach"},
                        {"convert missing o.csv", "missing"},
                        {"convert p.csv no/such/o.csv", "writing"}});
  EXPECT_EQ(read_bytes(f / "p.csv"), before);
  EXPECT_EQ(f.entries(), entries);
}

TEST(ConvertCommand, KeepsASideFileThatSomeoneWroteByHand) {
  const Folder f;
  ASSERT_EQ(gonio(f, "synth lambert --layout mbsdf -o p.mbsdf").code, 0);
  ASSERT_EQ(gonio(f, "convert p.mbsdf o.csv").code, 0);
  const auto table = read_bytes(f / "o.csv");
  const std::string by_hand = R"({"schema": "gonio.table/1", "notes": {"instrument": "mine"}})";
  for (const std::string& text : {by_hand, std::string("no document")}) {
    f.write("o.csv.gonio.json", text);
    expect_one_line(gonio(f, "convert p.mbsdf o.csv"), 3, "o.csv.gonio.json: writing the table");
    EXPECT_EQ(read_bytes(f / "o.csv.gonio.json"), text);
    EXPECT_EQ(read_bytes(f / "o.csv"), table);
  }
  std::filesystem::remove(f / "o.csv.gonio.json");
  EXPECT_EQ(gonio(f, "convert p.mbsdf o.csv").code, 0);
  EXPECT_EQ(gonio(f, "convert p.mbsdf o.csv").code, 0) << "its own side file is replaced";
}

TEST(ConvertCommand, WritesForRenderersThatReadRgl) {
  const Folder f;
  ASSERT_EQ(gonio(f, std::string("synth ") + paint + " --layout mbsdf -o p.mbsdf").code, 0);
  const auto said = gonio(f, "convert p.mbsdf p.bsdf --grid 24 --theta 12");
  ASSERT_EQ(said.code, 0) << said.err;
  EXPECT_NE(said.out.find("99 % of the values within"), std::string::npos) << said.out;
  EXPECT_EQ(gonio(f, "inspect p.bsdf --json").json()["format"], "rgl");
  const auto document =
      gonio(f, "convert p.mbsdf s --to rgl --grid 24 --theta 12 --spectral --json").json();
  EXPECT_EQ(document["output"]["channels"].size(), 16U);
  EXPECT_EQ(document["channels_to_spectra"], true);
  EXPECT_GT(document["there_and_back"]["largest"], document["there_and_back"]["within_99_percent"]);
  ASSERT_EQ(gonio(f, "convert p.bsdf again.bsdf --grid 24 --theta 12").code, 0)
      << "and from one of these";
  ASSERT_EQ(
      gonio(f,
            "synth ggx_aniso/smith_ggx_aniso.correlated/schlick --set alpha_x=0.35 alpha_y=0.2 "
            "f0=0.6,0.5,0.4 --layout utia -o a.bin")
          .code,
      0);
  const auto entries = f.entries();
  expect_one_line_each(f, 3,
                       {{"convert a.bin o.bsdf", "as the surface is turned"},
                        {"convert p.mbsdf no/such/o.bsdf", "writing"}});
  expect_one_line_each(f, 2,
                       {{"convert p.mbsdf o.bsdf --theta 180 --grid 512", "--grid"},
                        {"convert p.mbsdf o.bsdf --theta 1", "--theta 2"},
                        {"convert p.mbsdf o.bsdf --grid 2", "--grid"},
                        {"convert p.mbsdf o.bsdf --channels r,g", "wavelengths"}});
  EXPECT_EQ(f.entries(), entries) << "nothing half written";
  EXPECT_EQ(gonio(f, "convert p.mbsdf o.bsdf", "ulimit -f 100;").code, 3);
  EXPECT_EQ(f.entries(), entries);
}

TEST(ConvertCommand, GivesTheSameFileAndFiguresWhateverTheThreads) {
  const Folder f;
  ASSERT_EQ(gonio(f, std::string("synth ") + paint + " --layout mbsdf --noise 0.1 -o p.mbsdf").code,
            0);
  const auto one = gonio(f, "convert p.mbsdf o.mbsdf --theta 50 --jobs 1 --json");
  const auto bytes = read_bytes(f / "o.mbsdf");
  EXPECT_EQ(gonio(f, "convert p.mbsdf o.mbsdf --theta 50 --jobs 2 --json").out, one.out);
  EXPECT_TRUE(read_bytes(f / "o.mbsdf") == bytes);
}

}  // namespace
}  // namespace gonio::test
