// gonio export: what it writes, what it says of it, what it refuses.
#include "cli/program.h"

namespace gonio::test {
namespace {

void make_fit(const Folder& f, const std::string& model, const std::string& set) {
  ASSERT_EQ(gonio(f, "synth " + model + " --set " + set + " --layout in_plane -o t.csv").code, 0);
  const auto o = gonio(f, "fit t.csv --model " + model + " -o fit.json");
  ASSERT_EQ(o.code, 0) << o.err;
}

TEST(ExportCommand, RenamesWhatIsTheTargetsOwnModelAndKeepsTheFit) {
  const Folder f;
  make_fit(f, "gltf", "base_color=0.6,0.3,0.1 metallic=0 roughness=0.5");
  const auto o = gonio(f, "export fit.json --to gltf -o m.gltf --json");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_LT(o.json()["written"]["largest"], 1e-6);
  EXPECT_FALSE(o.json()["refitted"]);
  const auto file = nlohmann::json::parse(read_bytes(f / "m.gltf"));
  const auto& m = file["materials"][0];
  EXPECT_NEAR(m["pbrMetallicRoughness"]["roughnessFactor"], 0.5, 1e-3) << "not alpha";
  EXPECT_NEAR(m["pbrMetallicRoughness"]["baseColorFactor"][0], 0.6, 1e-3);
  EXPECT_EQ(m["extras"]["gonio"], nlohmann::json::parse(read_bytes(f / "fit.json")));
}

TEST(ExportCommand, FitsAgainWhereNamesDoNotSuffice) {
  const Folder f;
  make_fit(f, "lambert+ggx/smith_ggx.correlated/schlick", "alpha=0.4 f0=0.12 kd=0.3,0.2,0.1");
  const auto o = gonio(f, "export fit.json --to gltf -o m.gltf --json");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_TRUE(o.json()["refitted"]);
  EXPECT_LT(o.json()["written"]["rms"], o.json()["renamed"]["rms"]);
}

TEST(ExportCommand, WritesAFileThatIsReadAsTheFit) {
  const Folder f;
  make_fit(f, "lambert+ggx/smith_ggx.correlated/schlick", "alpha=0.4 f0=0.12 kd=0.3,0.2,0.1");
  ASSERT_EQ(gonio(f, "export fit.json --to gltf -o m.gltf").code, 0);
  f.write("d.csv", "theta_i,phi_i,theta_o,phi_o\n30,0,35,170\n70,0,60,190\n");
  const auto fit = gonio(f, "eval fit.json --directions d.csv --json");
  const auto file = gonio(f, "eval m.gltf --directions d.csv --json");
  ASSERT_EQ(file.code, 0) << file.err;
  EXPECT_EQ(file.json()["rows"], fit.json()["rows"]);
}

TEST(ExportCommand, RefusesWhatItCannotReadOrWrite) {
  const Folder f;
  make_fit(f, "lambert", "kd=0.2");
  f.write("newer.json", R"({"schema": "gonio.fit/2"})");
  expect_one_line_each(f, 3,
                       {{"export newer.json --to gltf -o m.gltf", "gonio.fit/2"},
                        {"export missing.json --to gltf -o m.gltf", "missing.json"},
                        {"export fit.json --to gltf -o nowhere/m.gltf", "nowhere/m.gltf"}});
  expect_one_line_each(f, 2,
                       {{"export fit.json --to vrml -o m.gltf", "vrml"},
                        {"export fit.json --to gltf -o fit.json", "fit.json"},
                        {"export fit.json --to gltf --tolerance -1 -o m.gltf", "--tolerance"}});
  EXPECT_FALSE(std::filesystem::exists(f / "m.gltf"));
}

}  // namespace
}  // namespace gonio::test
