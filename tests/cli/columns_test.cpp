// gonio columns: what a file's columns are is said once, and every command knows it from then on.
#include "cli/program.h"

namespace gonio::test {
namespace {

constexpr const char* kText = "nm;in;phi;out;brdf\n500;-30;0;30;0,5\n600;-30;0;30;0,25\n";
constexpr const char* kMap = "--map theta_i=in phi_i=phi theta_o=out phi_o=0 f=brdf channel=nm";

TEST(Columns, AreShownUntilAMapIsGivenAndReadByItAfterwards) {
  const Folder f;
  f.write("t.csv", kText);
  expect_one_line(gonio(f, "inspect t.csv"), 3, "gonio columns FILE --map");
  const auto shown = gonio(f, "columns t.csv --json").json();
  EXPECT_EQ(shown["file_columns"][1]["name"], "in");
  EXPECT_EQ(shown["file_columns"][4]["lowest"], 0.25);
  EXPECT_TRUE(shown["columns"].is_null());
  EXPECT_EQ(f.entries(), 1U) << "showing writes nothing";

  const auto said = gonio(f, std::string("columns t.csv ") + kMap + " --json");
  ASSERT_EQ(said.code, 0) << said.err;
  EXPECT_EQ(said.json()["samples"], 1);
  EXPECT_EQ(said.json()["channels"], (nlohmann::json{"500", "600"}));
  EXPECT_EQ(f.entries(), 2U);
  EXPECT_EQ(gonio(f, "columns t.csv --json").json()["columns"]["theta_i"], "in");
  EXPECT_EQ(gonio(f, "inspect t.csv --json").json()["largest"], 0.5);
  EXPECT_EQ(gonio(f, "fit t.csv --model lambert").code, 0);
}

TEST(Columns, AreProposedAsACommandThatCanBeRun) {
  const Folder f;
  f.write("my table.csv",
          "wavelength;in;phi;view [deg];brdf\n500;-30;0;30;0,5\n600;-30;0;30;0,25\n");
  const auto proposal = gonio(f, "columns 'my table.csv' --json").json()["proposal"];
  EXPECT_EQ(proposal["needed"], true);
  EXPECT_EQ(proposal["columns"]["theta_o"], "view [deg]");
  const std::string text = gonio(f, "columns 'my table.csv'").out;
  const auto at = text.find("\n  gonio columns ");
  ASSERT_NE(at, text.npos) << text;
  ASSERT_EQ(gonio(f, text.substr(at + 9, text.find('\n', at + 1) - at - 9)).code, 0) << text;
  const auto said = gonio(f, "columns 'my table.csv' --json").json();
  EXPECT_EQ(said["columns"], proposal["columns"]);
  EXPECT_TRUE(said["proposal"].is_null()) << "it has one";
  EXPECT_EQ(gonio(f, "inspect 'my table.csv' --json").json()["channels"],
            (nlohmann::json{"500", "600"}));
  f.write("own.csv", "theta_i,theta_o,f\n10,20,1\n");
  EXPECT_NE(gonio(f, "columns own.csv").out.find("none is needed"), std::string::npos);
}

TEST(Columns, InJsonKeepTheirNamesAndHaveNoRangeWhereThereIsNoNumber) {
  const Folder f;
  const std::string name = "a name of more than forty characters, \xc2\xb5 and all";
  f.write("t.csv", "x;y;z;" + name + "\n1;2;3;red\n4;5;nan;blue\n");
  const auto columns = gonio(f, "columns t.csv --json").json()["file_columns"];
  EXPECT_EQ(columns[3]["name"], name);
  EXPECT_TRUE(columns[3]["lowest"].is_null());
  EXPECT_TRUE(columns[3]["highest"].is_null());
  EXPECT_EQ(columns[3]["numbers"], 0);
  EXPECT_EQ(columns[2]["numbers"], 1);
  EXPECT_EQ(columns[2]["highest"], 3);
}

TEST(Columns, AreSaidForManyFilesAtOnceOrForNone) {
  const Folder f;
  for (const char* name : {"a.csv", "b.csv"}) f.write(name, kText);
  f.write("c.csv", "x;y;z\n1;2;3\n");
  expect_one_line(gonio(f, std::string("columns a.csv b.csv c.csv ") + kMap), 3,
                  "c.csv: line 1: found no column 'in'");
  EXPECT_EQ(f.entries(), 3U) << "nothing is written where one does not read";
  ASSERT_EQ(gonio(f, std::string("columns a.csv b.csv ") + kMap).code, 0);
  EXPECT_EQ(read_bytes(f / "a.csv.gonio.json"), read_bytes(f / "b.csv.gonio.json"));
}

TEST(Columns, WarnHereAndInEveryResult) {
  const Folder f;
  f.write("t.csv", "theta_i,theta_o,f\n45,-45,0.1\n45,0,0.2\n45,45,5\n");
  const auto said = gonio(f, "columns t.csv --map f=f");
  EXPECT_NE(said.out.find("beware"), std::string::npos);
  EXPECT_NE(gonio(f, "inspect t.csv").out.find("--forward 0"), std::string::npos);
  EXPECT_EQ(gonio(f, "inspect t.csv --json").json()["warnings"].size(), 1U);
  EXPECT_NE(
      gonio(f, "fit t.csv --model lambert --json").json()["warnings"].dump().find("--forward"),
      std::string::npos);
  ASSERT_EQ(gonio(f, "columns t.csv --forward 0").code, 0);
  EXPECT_TRUE(gonio(f, "inspect t.csv --json").json()["warnings"].empty());
}

TEST(Columns, OfInspectAndFitAgreeOnWhatIsBelowTheHorizon) {
  const Folder f;
  f.write("t.csv",
          "theta_i,phi_i,theta_o,phi_o,f\n30,0,30,180,0.3\n30,0,90,180,7\n90,0,30,180,7\n");
  EXPECT_EQ(gonio(f, "inspect t.csv --json").json()["masked"]["below_horizon"], 2);
  EXPECT_EQ(gonio(f, "fit t.csv --model lambert --json").json()["input"]["masked"]["below_horizon"],
            2);
}

TEST(Columns, KeepWhatElseTheSideFileSaysOfThisTable) {
  const Folder f;
  ASSERT_EQ(gonio(f, std::string("synth ") + paint + " --layout in_plane -o t.csv").code, 0);
  ASSERT_EQ(gonio(f, "columns t.csv --scale 2").code, 0);
  EXPECT_FALSE(gonio(f, "inspect t.csv --json").json()["truth"].is_null());
  f.write("t.csv", kText);
  expect_one_line(gonio(f, std::string("columns t.csv ") + kMap), 3, "t.csv.gonio.json: sha256");
}

TEST(Columns, ThatAreTwoAnglesAreRefusedAndTheEarlierSideFileStays) {
  const Folder f;
  f.write("t.csv", kText);
  ASSERT_EQ(gonio(f, std::string("columns t.csv ") + kMap).code, 0);
  const auto before = read_bytes(f / "t.csv.gonio.json");
  expect_one_line(gonio(f, "columns t.csv --map theta_i=in theta_o=in f=brdf"), 3, "two things");
  EXPECT_EQ(read_bytes(f / "t.csv.gonio.json"), before);
}

TEST(Columns, TellWrongWordsFromWrongFiles) {
  const Folder f;
  f.write("t.csv", kText);
  f.write("noise", "dear reader\n");
  expect_one_line_each(f, 2,
                       {{"columns t.csv --map theta=in", "'theta' is none of"},
                        {"columns t.csv --map theta_i", "NAME=COLUMN"},
                        {"columns t.csv --map theta_i=", "NAME=COLUMN"},
                        {"columns t.csv --map f=in f=out", "f twice"},
                        {"columns t.csv --scale 0", "scale"},
                        {"columns t.csv --forward x", "forward"}});
  expect_one_line_each(
      f, 3,
      {{"columns missing", "missing: opening"},
       {"columns noise", "noise: the beginning"},
       {"columns noise --radians", "noise: the beginning"},
       {"columns t.csv --radians --map theta_i=in theta_o=out f=brdf", "radians"}});
  EXPECT_EQ(f.entries(), 2U);
}

}  // namespace
}  // namespace gonio::test
