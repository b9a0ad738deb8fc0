// docs/examples/ci: the repository that others copy, checked as their build servers check it.
#include <filesystem>
#include <set>

#include "cli/program.h"

namespace gonio::test {
namespace {

namespace fs = std::filesystem;

const fs::path example = fs::path(project_folder()) / "docs/examples/ci";

/// Runs a command in the copy of the example, with the built program in PATH.
int in_example(const Folder& f, const std::string& command) {
  const auto program = fs::path(program_path()).parent_path().string();
  const int status = std::system(
      ("cd '" + f / "ci" + "' && PATH='" + program + "':$PATH " + command + " > ../said 2>&1")
          .c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

nlohmann::json sarif(const Folder& f, const std::string& name) {
  return nlohmann::json::parse(read_bytes(f / ("ci/results/" + name + ".sarif")));
}

TEST(CiExample, PassesAndStopsACommitThatBreaksItsShader) {
  const Folder f;
  fs::copy(example, f / "ci", fs::copy_options::recursive);
  ASSERT_EQ(in_example(f, "./check-materials"), 0) << read_bytes(f / "said");
  std::set<std::string> categories;
  for (const char* name : {"metal", "paint"}) {
    const auto run = sarif(f, name)["runs"][0];
    EXPECT_EQ(run["results"].size(), 0U);
    categories.insert(run["automationDetails"]["id"]);
    EXPECT_NE(read_bytes(f / (std::string("ci/results/") + name + ".xml")).find("failures=\"0\""),
              std::string::npos);
  }
  EXPECT_EQ(categories.size(), 2U) << "GitHub keeps one run of a category";

  auto text = read_bytes(f / "ci/materials/paint.glsl");
  const std::string whole = "float a2 = alpha * alpha;", torn = "float a2 = alpha;";
  text.replace(text.find(whole), whole.size(), torn);
  f.write("ci/materials/paint.glsl", text);
  EXPECT_EQ(in_example(f, "./check-materials"), 1) << read_bytes(f / "said");
  EXPECT_EQ(sarif(f, "metal")["runs"][0]["results"].size(), 0U);
  const auto results = sarif(f, "paint")["runs"][0]["results"];
  ASSERT_GE(results.size(), 1U);
  EXPECT_EQ(results[0]["locations"][0]["physicalLocation"]["artifactLocation"]["uri"],
            "materials/paint.json")
      << "below the top of the repository";

  f.write("ci/materials/torn.json", "{");
  EXPECT_EQ(in_example(f, "./check-materials"), 3) << read_bytes(f / "said");
}

TEST(CiExample, RunsByTheFilesOfGitHubAndGitLab) {
  const fs::path project = project_folder(), python = project / "build/openjd/bin/python";
  if (!fs::exists(python)) GTEST_SKIP() << "needs PyYAML, which ./check fetches with openjd-cli";
  const Folder f;
  const auto program = fs::path(program_path()).parent_path().string();
  const int status =
      std::system(("'" + python.string() + "' '" + (project / "tests/cli/ci_files.py").string() +
                   "' '" + example.string() + "' '" + program + "' '" +
                   (project / "build/dist").string() + "' > '" + f / "said" + "' 2>&1")
                      .c_str());
  const auto said = read_bytes(f / "said");
  EXPECT_EQ(status, 0) << said;
  for (std::size_t at = said.find("without "); at != said.npos; at = said.find("without ", at + 1))
    std::cout << said.substr(at, said.find('\n', at) - at) << "\n";
}

}  // namespace
}  // namespace gonio::test
