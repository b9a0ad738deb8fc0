// The program where things go wrong around it: full disks, kills, limits, closed streams.
#include <csignal>
#include <map>
#include <regex>

#include "cli/program.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace gonio::test {
namespace {

int status_of(const std::string& command) {
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string small_table() {
  std::string csv = "theta_i,phi_i,theta_o,phi_o,f\n";
  for (int i = 0; i < 80; ++i)
    csv += std::to_string(i) + ",0,30,180,0." + std::to_string(i + 10) + "\n";
  return csv;
}

/// Every file of a folder with what it holds, the hidden ones left out.
std::map<std::string, std::string> visible(const Folder& folder) {
  std::map<std::string, std::string> all;
  for (const auto& e : std::filesystem::directory_iterator(folder / ""))
    if (const auto name = e.path().filename().string(); name[0] != '.')
      all[name] = read_bytes(e.path().string());
  return all;
}

TEST(Surroundings, AFullDiskLeavesNothingBehind) {
  const Folder f;
  f.write("t.csv", small_table());
  f.write("c.json", R"({"schema": "gonio.choice/1", "model": "ggx/schlick_ggx.half_alpha/schlick",
    "domain": {"roughness": [0.4, 1], "f0": 0.04}, "budgets": {"operations": 1}})");
  // A limit of the size of files fails the write as a full disk does, in the middle of a file.
  for (const char* words :
       {"fit t.csv --model lambert -o r.json", "fit t.csv --model lambert --html r.html",
        "fit t.csv --model lambert -o r.json --html r.html", "synth lambert --layout mbsdf -o s",
        "synth lambert --layout random -o s.csv", "synth lambert --layout image_slice -o s.exr",
        "eval lambert --directions t.csv -o e.csv",
        "validate c.json --junit small.xml --sarif large.sarif"}) {
    const auto o = gonio(f, words, "ulimit -f 1; ");
    expect_one_line(o, 3, ": ");
    EXPECT_EQ(f.entries(), 2U) << words;
  }
}

TEST(Surroundings, AKillLeavesWholeFilesOrNone) {
  const Folder whole;
  const std::string words = std::string("synth ") + paint + " --layout mbsdf --seed 3 -o t.mbsdf";
  ASSERT_EQ(gonio(whole, words).code, 0);
  const auto expected = visible(whole);
  for (const char* signal : {"TERM", "KILL"})
    for (const char* after : {"0.005", "0.01", "0.02", "0.03", "0.05"}) {
      const Folder f;
      status_of("cd '" + f / "" + "' && timeout -s " + signal + " " + after + " " + program() +
                " " + words + " >/dev/null 2>&1");
      for (const auto& [name, bytes] : visible(f)) {
        ASSERT_TRUE(expected.contains(name)) << name;
        EXPECT_EQ(bytes, expected.at(name)) << name;
      }
      if (std::string(signal) == "TERM") {
        EXPECT_EQ(f.entries(), visible(f).size()) << "what was being made is gone";
      }
    }
}

TEST(Surroundings, WhatAKillLeavesIsTakenAwayByTheNextRun) {
  const Folder f;
  const std::string here = "cd '" + f / "" + "' && ";
  // A limit of the time of computing kills in the middle of the work, while a temporary file is
  // there.
  status_of(here + "(ulimit -t 1; exec " + program() + " report cross_fit -o r) >/dev/null 2>&1");
  const auto hidden = [&] {
    std::size_t n = 0;
    for (const auto& e : std::filesystem::recursive_directory_iterator(f / ""))
      n += e.path().filename().string().starts_with(".gonio.");
    return n;
  };
  if (hidden() == 0) GTEST_SKIP() << "done within a second";
  f.write("r/x.csv", small_table());
  EXPECT_EQ(gonio(f, "fit r/x.csv --model lambert -o r/x.json").code, 0);
  EXPECT_EQ(hidden(), 0U);
}

/// Ends a run by a signal as soon as a file of that kind lies in `out`.  \param kind  words of find
void end_once_there(const Folder& f,
                    const std::string& words,
                    const std::string& signal,
                    const std::string& kind) {
  status_of("cd '" + f / "" + "' && mkdir -p out && { " + program() + " " + words +
            " >/dev/null 2>&1 & p=$!; while kill -0 $p 2>/dev/null && [ -z \"$(find out -type f " +
            kind + " -print -quit)\" ]; do sleep 0.002; done; kill -s " + signal +
            " $p 2>/dev/null; wait $p; }");
}

/// True of a file that ends as its kind does.
bool ends_whole(const std::filesystem::path& path) {
  static const std::map<std::string, std::string> ends{
      {".html", "</html>"}, {".svg", "</svg>"}, {".mtlx", "</materialx>"}, {".json", "}"}};
  const auto bytes = read_bytes(path.string());
  const auto end = ends.find(path.extension().string());
  const auto text = bytes.substr(0, bytes.find_last_not_of('\n') + 1);
  return end == ends.end() ? !bytes.empty() : text.ends_with(end->second) && text != bytes;
}

TEST(Surroundings, AKillOfAPlanOrOfReportsLeavesWholeFilesOrNone) {
  const std::string scene =
      R"({"schema": "gonio.scene/1", "materials": {"m": {"model": "lambert"}},)"
      R"( "objects": [{"shape": "sphere", "material": "m"}],)"
      R"( "lights": [{"type": "directional", "direction": [0, 0, 1], "irradiance": [1, 1, 1]}],)"
      R"( "view": {"position": [0, 0, 10], "target": [0, 0, 0], "fov_deg": 20},)"
      R"( "tolerance": {"metric": "delta_e_2000", "quantile": 0.99, "limit": 1, "max": 4}})";
  const std::string begun = "-name '.gonio.*'", whole = "! -name '.gonio.*'";
  std::size_t files = 0;
  for (const auto& [words, when] :
       {std::pair{"plan s.json --samples 512 --cost operations -o out/p.json "
                  "--html out/p.html --write mtlx",
                  begun},
        {"plan s.json --samples 512 --cost operations -o out/p.json "
         "--html out/p.html --write mtlx",
         whole},
        {"report all -o out", begun},
        {"report schlick -o out", whole}})
    for (const char* signal : {"TERM", "KILL"}) {
      const Folder f;
      f.write("s.json", scene);
      end_once_there(f, words, signal, when);
      std::size_t hidden = 0;
      for (const auto& e : std::filesystem::recursive_directory_iterator(f / "out")) {
        if (!e.is_regular_file()) continue;
        if (e.path().filename().string().starts_with(".gonio.")) {
          ++hidden;
          continue;
        }
        ++files;
        EXPECT_TRUE(ends_whole(e.path())) << words << ": " << e.path();
      }
      if (std::string(signal) == "TERM") {
        EXPECT_EQ(hidden, 0U) << words;
      }
    }
  EXPECT_GT(files, 0U);
}

TEST(Surroundings, NothingThatAFileSaysMovesTheCursorOfATerminal) {
  const Folder f;
  const std::string evil = "\x1b[2J\xe2\x80\xae\xc2\x9b";
  std::string csv = "theta_i,phi_i,theta_o,phi_o,f_" + evil + ",f_g\n";
  for (int i = 0; i < 80; ++i) csv += std::to_string(i) + ",0,30,180,0.1,0.2\n";
  f.write("t.csv", csv);
  f.write("t.csv.gonio.json",
          nlohmann::json{{"schema", "gonio.table/1"}, {"notes", {{"n" + evil, evil}}}}.dump());
  for (const char* words :
       {"inspect t.csv", "fit t.csv --model lambert", "columns t.csv", "convert t.csv o.csv",
        "columns t.csv --map theta_i=theta_i phi_i=phi_i theta_o=theta_o phi_o=phi_o f_g=f_g",
        "columns t.csv --map f=nothing", "convert t.csv o.csv --channels nothing",
        "fit t.csv --model \"$(printf '\\033[2J')\"", "inspect \"$(printf '\\033[2J')\"",
        "fit t.csv --\"$(printf '\\033[2J')\"", "term \"$(printf '\\033[2J')\""}) {
    const auto o = gonio(f, std::string(words));
    for (const std::string& text : {o.out, o.err}) {
      EXPECT_EQ(text.find('\x1b'), text.npos) << words << "\n" << text;
      EXPECT_EQ(text.find("\xe2\x80\xae"), text.npos) << words;
      EXPECT_EQ(text.find("\xc2\x9b"), text.npos) << words;
    }
    EXPECT_FALSE(o.out.empty() && o.err.empty());
  }
}

TEST(Surroundings, NoLineOfAnErrorIsLong) {
  const Folder f;
  const std::string word(24'000, 'x');
  for (const std::string& words :
       {word, "fit " + word, "term " + word, "fit t.csv --metric " + word, "fit t.csv --" + word,
        "eval lambert --set kd=" + word + " --directions t.csv -o o.csv",
        "split_sum --size " + word + " --out t.exr", "synth " + word + " --layout merl -o t",
        "fit " + word + "/" + word}) {
    const auto o = gonio(f, words);
    EXPECT_NE(o.code, 0);
    EXPECT_EQ(std::ranges::count(o.err, '\n'), 1) << words.substr(0, 40);
    EXPECT_LT(o.err.size(), 1700U) << words.substr(0, 40);
  }
}

TEST(Surroundings, TheVersionIsThatOfTheProject) {
  const Folder f;
  const std::string project = read_bytes(project_folder() + "/CMakeLists.txt");
  const auto at = project.find("project(gonio VERSION ") + 22;
  const std::string first = project.substr(at, project.find(' ', at) - at) + "\n";
  const auto said = gonio(f, "--version").out;
  EXPECT_EQ(said.substr(0, first.size()), first);
  EXPECT_TRUE(std::regex_match(
      said.substr(first.size()),
      std::regex("commit ([0-9a-f]{12,}( with changes)?|unknown), (g\\+\\+|clang) [0-9.]+.*, "
                 "vector units here: .*sse2.*\n")))
      << said;
}

TEST(Surroundings, AVectorUnitIsTheBestThatMayBeTaken) {
  const Folder f;
  f.write("t.csv", small_table());
  const auto fit = [&](const std::string& set) {
    return gonio(f, "fit t.csv --model lambert --json", "GONIO_INSTRUCTION_SET=" + set + " ");
  };
  const auto plainest = fit("sse2").json();
  EXPECT_EQ(plainest["solver"]["instruction_set"], "sse2");
  EXPECT_EQ(plainest["parameters"], fit("").json()["parameters"]);
  expect_one_line(fit("sse9"), 2, "GONIO_INSTRUCTION_SET: 'sse9', expected one of sse2");
}

TEST(Surroundings, ALimitOfMemoryIsOneLine) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer needs more addresses than any limit leaves";
#endif
  const Folder f;
  ASSERT_EQ(gonio(f, "synth lambert --layout merl -o t.binary").code, 0);
  const std::size_t before = f.entries();
  std::size_t refused = 0, before_main = 0;
  for (int mebibytes = 60; mebibytes <= 160; mebibytes += 4) {
    const auto o =
        gonio(f, "fit t.binary -o r.json", "ulimit -v " + std::to_string(1024 * mebibytes) + "; ");
    if (o.code == 0 || o.code == 127) {  // enough, or not even for the program's libraries
      std::filesystem::remove(f / "r.json");
      continue;
    }
    // Embree asks for memory while it is loaded, and ends the program where there is none: within a
    // megabyte of what its loading needs.
    if (o.code == 134 && refused == 0 && before_main++ == 0) continue;
    ++refused;
    expect_one_line(o, 3, "gonio: ");  // no memory, or none for another thread
    EXPECT_EQ(f.entries(), before);
  }
  EXPECT_GT(refused, 0U);
}

TEST(Surroundings, AFitOfManyChannelsHasRoomForTheSamplesThatThereAre) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer needs more addresses than any limit leaves";
#endif
  const Folder f;
  std::string csv = "theta_i,theta_o";
  for (int c = 0; c < 4000; ++c) csv += ",f_" + std::to_string(c);
  for (int i = 0; i < 6; ++i) {
    csv += "\n30," + std::to_string(10 * i);
    for (int c = 0; c < 4000; ++c) csv += ",0.1";
  }
  f.write("t.csv", csv + "\n");
  const auto o = gonio(f, "fit t.csv --model lambert --jobs 1 -o r.json", "ulimit -v 2000000; ");
  EXPECT_EQ(o.code, 0) << o.err;
}

TEST(Surroundings, AFileThatChangesWhileItIsReadIsRefused) {
  const Folder f;
  ASSERT_EQ(gonio(f, "synth lambert --layout merl -o t.binary").code, 0);
  std::filesystem::remove(f / "t.binary.gonio.json");
  const std::string size = std::to_string(std::filesystem::file_size(f / "t.binary"));
  // Cut and grown again, over and over, until all is seen.
  status_of("cd '" + f / "" + "' && touch go && (while [ -e go ]; do truncate -s 5000 t.binary; " +
            "truncate -s " + size + " t.binary; done; touch done) >/dev/null 2>&1 &");
  for (int i = 0; i < 4; ++i) {
    const auto o = gonio(f, "fit t.binary --model lambert -o r.json");
    expect_one_line(o, 3, "t.binary");
    EXPECT_FALSE(std::filesystem::exists(f / "r.json")) << "of a mixture";
  }
  std::filesystem::remove(f / "go");
  while (!std::filesystem::exists(f / "done")) ::usleep(1000);
}

TEST(Surroundings, StreamsThatAreClosedCrashNothing) {
  const Folder f;
  f.write("t.csv", small_table());
  const std::string here = "cd '" + f / "" + "' && ",
                    fit = program() + " fit t.csv --model lambert ";
  const auto whole = gonio(f, "fit t.csv --model lambert -o whole.json");
  ASSERT_EQ(whole.code, 0);
  EXPECT_EQ(status_of(here + fit + "-o r.json --json >&- 2>/dev/null"), 3);
  const auto number = [&](const char* name) {
    return nlohmann::json::parse(read_bytes(f / name))["cost"];
  };
  EXPECT_EQ(number("r.json"), number("whole.json")) << "the result's own file is whole";
  EXPECT_EQ(status_of(here + fit + "-o r.json <&- >/dev/null 2>&-"), 0);
  EXPECT_EQ(status_of(here + program() + " fit nothing <&- >&- 2>&-"), 3);
  EXPECT_EQ(status_of(here + program() + " nonsense 2>&-"), 2);
  EXPECT_EQ(status_of(here + "{ sleep 0.3; " + program() +
                      " models --json 2>err; echo $? >code; } | true"),
            0);
  EXPECT_EQ(read_bytes(f / "code"), "3\n");
  EXPECT_EQ(read_bytes(f / "err"), "") << "whoever closed it has seen enough";
}

TEST(Surroundings, AnOutputThatHasNoPlaceIsToldBeforeTheFit) {
  const Folder f;
  f.write("t.csv", small_table());
  const std::string long_name(300, 'x');
  for (const std::string& place : {std::string("t.csv/r.json"), long_name, long_name + "/r.json"})
    expect_one_line(gonio(f, "fit t.csv --model lambert -o " + place), 3, "writing");
  EXPECT_EQ(f.entries(), 1U);
}

TEST(Surroundings, AnInputNeedNotBeWritableNorItsFolder) {
  const Folder f;
  std::filesystem::create_directory(f / "in");
  f.write("in/t.csv", small_table());
  ASSERT_EQ(::chmod((f / "in/t.csv").c_str(), 0444), 0);
  ASSERT_EQ(::chmod((f / "in").c_str(), 0555), 0);
  EXPECT_EQ(gonio(f, "fit in/t.csv --model lambert -o r.json").code, 0);
  if (::geteuid() != 0)  // root writes anywhere
    expect_one_line(gonio(f, "fit in/t.csv --model lambert -o in/r.json"), 3, "Permission denied");
  ASSERT_EQ(::chmod((f / "in").c_str(), 0755), 0);
}

TEST(Surroundings, ASignalThatIsIgnoredStaysSo) {
  const Folder f;
  const std::string words = "synth " + std::string(paint) + " --layout merl -o t >/dev/null 2>&1";
  EXPECT_EQ(status_of("cd '" + f / "" + "' && trap '' HUP INT && (" + program() + " " + words +
                      " & p=$!; sleep 0.05; kill -HUP $p; kill -INT $p; wait $p)"),
            0);
}

TEST(Surroundings, HelpThatCannotBePrintedIsAnError) {
  const Folder f;
  for (const char* words : {"--help", "fit --help", "--version", "models"})
    EXPECT_EQ(status_of(program() + " " + words + " >/dev/full 2>/dev/null"), 3) << words;
}

/// Documents that name files, each with the command that reads it.
TEST(Surroundings, ADocumentNamesNoFilesOutsideItsFolder) {
  const Folder f;
  std::filesystem::create_directory(f / "in");
  f.write("secret", "words that nobody shall see");
  f.write("in/scene.json",
          R"({"schema": "gonio.scene/1", "materials": {"a": {"fit": "../secret"}},
          "objects": [{"shape": "sphere", "material": "a"}],
          "lights": [{"type": "directional", "direction": [0, 1, 0], "irradiance": [1, 1, 1]}],
          "view": {"position": [0, 0, 10], "target": [0, 0, 0], "fov_deg": 20},
          "tolerance": {"metric": "delta_e_2000", "quantile": 0.9, "limit": 1, "max": 4}})");
  f.write(
      "in/stack.json",
      R"({"schema": "gonio.stack/1", "images": [{"path": "../secret", "theta_i": 0, "theta_o": 0}]})");
  f.write("in/choice.json",
          R"({"schema": "gonio.choice/1", "model": "ggx/smith_ggx.correlated/schlick",
          "domain": {"fits": ["../secret"]}, "budgets": {"operations": 500}})");
  for (const char* words : {"plan in/scene.json", "render in/scene.json -o p.png",
                            "fit_map in/stack.json -o m.exr", "validate in/choice.json"}) {
    const auto o = gonio(f, words);
    expect_one_line(o, 3, "--follow-paths");
    EXPECT_EQ(o.err.find("words"), o.err.npos) << o.err;
    const auto followed = gonio(f, std::string(words) + " --follow-paths");
    EXPECT_EQ(followed.err.find("--follow-paths"), followed.err.npos) << followed.err;
    EXPECT_EQ(followed.code, 3) << "it is read, and no fit";
  }
}

TEST(Surroundings, AFitTakesAShaderBesideItselfOnly) {
  const Folder f;
  std::filesystem::create_directory(f / "in");
  std::filesystem::create_directory(f / "out");
  f.write("out/my.glsl", "words that nobody shall see");
  f.write("d.csv", "theta_i,phi_i,theta_o,phi_o\n10,0,10,180\n");
  f.write("in/scene.json",
          R"({"schema": "gonio.scene/1", "materials": {"a": {"fit": "fit.json"}},
          "objects": [{"shape": "sphere", "material": "a"}],
          "lights": [{"type": "directional", "direction": [0, 1, 0], "irradiance": [1, 1, 1]}],
          "view": {"position": [0, 0, 10], "target": [0, 0, 0], "fov_deg": 20},
          "tolerance": {"metric": "delta_e_2000", "quantile": 0.9, "limit": 1, "max": 4}})");
  for (const char* name : {"out/my.glsl", "../out/my.glsl", "./////../out/my.glsl"}) {
    f.write("in/fit.json", fmt::format(R"({{"schema": "gonio.fit/1", "model": "{}:brdf",
          "channels": ["r", "g", "b"], "parameters": {{}}}})",
                                       name));
    for (const char* words :
         {"eval in/fit.json --directions d.csv --json", "render in/scene.json -o p.png",
          "export in/fit.json --to gltf -o o.gltf", "albedo in/fit.json --json"}) {
      const auto o = gonio(f, words);
      expect_one_line(o, 3, "--follow-paths");
      EXPECT_EQ(o.err.find("words"), o.err.npos) << o.err;
      const auto followed = gonio(f, std::string(words) + " --follow-paths");
      EXPECT_EQ(followed.err.find("--follow-paths"), followed.err.npos) << followed.err;
    }
  }
}

TEST(Surroundings, NothingThatADocumentNamesIsOverwritten) {
  const Folder f;
  f.write("t.csv", small_table());
  ASSERT_EQ(gonio(f, "fit t.csv --model ggx/smith_ggx.correlated/schlick -o fit.json").code, 0);
  const std::string fit = read_bytes(f / "fit.json");
  f.write("scene.json",
          R"({"schema": "gonio.scene/1", "materials": {"a": {"fit": "fit.json"}},
          "objects": [{"shape": "sphere", "material": "a"}],
          "lights": [{"type": "directional", "direction": [0, 1, 0], "irradiance": [1, 1, 1]}],
          "view": {"position": [0, 0, 10], "target": [0, 0, 0], "fov_deg": 20},
          "tolerance": {"metric": "delta_e_2000", "quantile": 0.9, "limit": 1, "max": 4}})");
  f.write("choice.json",
          R"({"schema": "gonio.choice/1", "model": "ggx/smith_ggx.correlated/schlick",
          "domain": {"fits": ["fit.json"]}, "budgets": {"operations": 500}})");
  f.write("list", "t.csv\n");
  std::filesystem::create_symlink("fit.json", f / "fit.png");
  for (const char* words :
       {"plan scene.json -o fit.json", "plan scene.json --html p.html -o ./p.page.json",
        "render scene.json -o fit.png", "validate choice.json -o fit.json",
        "validate choice.json --junit fit.json", "validate choice.json --sarif v --junit v",
        "batch --write slurm @list -o t.csv", "batch --write slurm @list t.csv -o list",
        "gather fit.json @list -o t.csv"}) {
    const auto o = gonio(f, words);
    EXPECT_TRUE(o.code == 2 || o.code == 3) << words << o.err;
    EXPECT_EQ(read_bytes(f / "fit.json"), fit) << words;
    EXPECT_EQ(read_bytes(f / "t.csv"), small_table()) << words;
    EXPECT_EQ(read_bytes(f / "list"), "t.csv\n") << words;
  }
}

/// Numbers of two documents of one shape: the largest difference, relative, and of correlations.
void compare(const nlohmann::json& a,
             const nlohmann::json& b,
             double& values,
             double& correlations,
             bool of_correlations = false) {
  ASSERT_EQ(a.type(), b.type());
  if (a.is_structured()) {
    ASSERT_EQ(a.size(), b.size());
    const auto& x = a.items();
    auto y = b.begin();
    for (const auto& [key, value] : x)
      compare(value, *y++, values, correlations, of_correlations || key == "correlations");
  } else if (a.is_number()) {
    const double p = a, q = b, scale = of_correlations ? 1 : std::max(std::abs(p), 1e-12);
    double& largest = of_correlations ? correlations : values;
    largest = std::max(largest, std::abs(p - q) / scale);
  }
}

TEST(Surroundings, VectorUnitsMoveNumbersByNoMoreThanTheDocsSay) {
  const Folder f;
  for (const char* seed : {"1", "2", "3"}) {
    ASSERT_EQ(gonio(f, std::string("synth ") + paint +
                           " --layout random --samples 300 --noise 0.05 -o t.csv --seed " + seed)
                  .code,
              0);
    const auto fit = [&](const std::string& set) {
      return gonio(f, "fit t.csv --json", "GONIO_INSTRUCTION_SET=" + set + " ").json();
    };
    const auto plainest = fit("sse2"), best = fit("");
    double values = 0, correlations = 0;
    for (const char* part : {"parameters", "identifiability"}) {
      auto a = plainest[part], b = best[part];
      a.erase("condition"), b.erase("condition");
      compare(a, b, values, correlations);
    }
    EXPECT_LE(values, 2.5e-8);
    EXPECT_LE(correlations, 1.3e-4);
  }
}

}  // namespace
}  // namespace gonio::test
