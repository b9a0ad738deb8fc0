// gonio validate: what it says, how it exits, what it refuses.
#include <fstream>

#include "cli/program.h"

namespace gonio::test {
namespace {

void write(const Folder& f, const std::string& name, const nlohmann::json& j) {
  std::ofstream(f / name) << j.dump(2);
}
nlohmann::json choice(double limit) {
  return {{"schema", "gonio.choice/1"},
          {"model", "ggx/schlick_ggx.direct/schlick"},
          {"reference", "ggx/smith_ggx.correlated/schlick"},
          {"domain", {{"roughness", {0.2, 1}}, {"f0", 0.04}}},
          {"budgets", {{"albedo_error", limit}, {"energy_gain", 0.001}}}};
}

TEST(ValidateCommand, ExitsWith0WhereEveryBudgetIsKeptAndWith1AndTheWorstInputWhereOneIsBroken) {
  const Folder f;
  write(f, "kept.json", choice(0.9));
  write(f, "broken.json", choice(1e-4));
  const auto kept = gonio(f, "validate kept.json");
  EXPECT_EQ(kept.code, 0) << kept.err;
  EXPECT_NE(kept.out.find("The choice keeps every budget."), kept.out.npos) << kept.out;
  EXPECT_NE(kept.out.find("reference  "), kept.out.npos) << kept.out;
  EXPECT_NE(kept.out.find("f0 0.04, from the domain"), kept.out.npos) << kept.out;
  const auto broken = gonio(f, "validate broken.json");
  EXPECT_EQ(broken.code, 1) << broken.err;
  EXPECT_NE(broken.out.find("at roughness "), broken.out.npos) << broken.out;
  EXPECT_EQ(broken.err, "");
}

TEST(ValidateCommand, FindsTheDefectsOfTheDocsAndTheirWorstInput) {
  const Folder f;
  std::size_t seen = 0;
  for (const auto& e : std::filesystem::directory_iterator(project_folder() + "/docs/defect")) {
    const auto o = gonio(f, "validate " + e.path().string());
    EXPECT_EQ(o.code, 1) << e.path() << o.out << o.err;
    EXPECT_NE(o.out.find("BROKEN"), o.out.npos) << o.out;
    EXPECT_NE(o.out.find(" at "), o.out.npos) << "the worst input: " << o.out;
    EXPECT_EQ(o.err, "");
    ++seen;
  }
  EXPECT_EQ(seen, 6U);
}

TEST(ValidateCommand, LeavesADocumentAPageAndWhatMachinesRead) {
  const Folder f;
  write(f, "c.json", choice(1e-4));
  const auto o =
      gonio(f, "validate c.json --json -o v.json --html v.html --junit v.xml --sarif v.sarif");
  EXPECT_EQ(o.code, 1) << o.err;
  EXPECT_EQ(o.json()["schema"], "gonio.validation/1");
  EXPECT_EQ(read_bytes(f / "v.json"), o.out.substr(0, o.out.size() - 1));
  for (const char* name : {"v.html", "v.page.json", "v.xml", "v.sarif"})
    EXPECT_TRUE(std::filesystem::exists(f / name)) << name;
}

TEST(ValidateCommand, RefusesWhatItCannotReadOrWrite) {
  const Folder f;
  write(f, "c.json", choice(1));
  auto none = choice(1);
  none["budgets"] = nlohmann::json::object();
  write(f, "none.json", none);
  auto walks = choice(1);
  walks["model"] = "gtr/smith_gtr.correlated/schlick";
  walks["scattering"] = "deterministic";
  write(f, "walks.json", walks);
  auto unknown = choice(1);
  unknown["parameters"] = {{"sheen", 1}};
  write(f, "unknown.json", unknown);
  std::ofstream(f / "torn.json") << "{\"schema\": ";
  expect_one_line_each(f, 3,
                       {{"validate none.json", "none.json: /budgets: "},
                        {"validate walks.json", "walks.json: /model: found 'gtr'"},
                        {"validate torn.json", "torn.json"},
                        {"validate unknown.json", "unknown.json: /parameters/sheen: found 1"},
                        {"validate missing.json", "missing.json"},
                        {"validate c.json -o nowhere/v.json", "nowhere/v.json"}});
  expect_one_line_each(
      f, 2,
      {{"validate c.json --junit c.json", "c.json"}, {"validate c.json --html page", "page"}});
  EXPECT_FALSE(std::filesystem::exists(f / "v.json"));
}

TEST(ValidateCommand, WritesANameSoThatNoReaderTakesItForMore) {
  const Folder f;
  const std::string name = "e\x1b[31m\u202e&.json";
  std::string table = "theta_i,phi_i,theta_o,phi_o,f\n";
  for (int i = 0; i < 80; ++i) table += std::to_string(i) + ",0,30,180,0.2\n";
  f.write("t.csv", table);
  ASSERT_EQ(gonio(f, "fit t.csv --model ggx/smith_ggx.correlated/schlick -o fit.json").code, 0);
  std::filesystem::rename(f / "fit.json", f / name);
  auto c = choice(1e-9);
  c["domain"] = {{"roughness", {0.4, 1}}, {"fits", {name}}};
  write(f, "both.json", c);
  expect_one_line(gonio(f, "validate both.json"), 3, "/domain/roughness");
  c["domain"] = {{"fits", {name}}};
  write(f, "c\x1b é.json", c);
  const auto o = gonio(f, "validate c*.json --junit v.xml --sarif v.sarif");
  EXPECT_EQ(o.code, 1) << o.err;
  const auto json = gonio(f, "validate c*.json --json");
  for (const std::string& text :
       {o.out, json.out, read_bytes(f / "v.xml"), read_bytes(f / "v.sarif")}) {
    EXPECT_EQ(text.find('\x1b'), text.npos) << text;
    EXPECT_EQ(text.find("\u202e"), text.npos) << text;
  }
  EXPECT_NE(read_bytes(f / "v.xml").find("&amp;"), std::string::npos);
  EXPECT_NE(read_bytes(f / "v.sarif").find("\"c%1B%20%C3%A9.json\""), std::string::npos);
}

}  // namespace
}  // namespace gonio::test
