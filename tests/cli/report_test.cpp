// gonio report: what it refuses, before any work is done.
#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>

#include "cli/program.h"
#include "image/exr.h"
#include "reports/picture/figure.h"

#include <unistd.h>

namespace gonio::test {
namespace {

TEST(ReportCommand, NamesTheReportsThereAre) {
  const Folder f;
  expect_one_line(gonio(f, "report albedo -o out"), 2, "energy");
  EXPECT_FALSE(std::filesystem::exists(f / "out"));
}

TEST(ReportCommand, NeedsAPlaceToWrite) {
  const Folder f;
  expect_one_line(gonio(f, "report energy"), 2, "--output is required");
  f.write("file", "");
  expect_one_line(gonio(f, "report energy -o file/out"), 3, "file/out");
  expect_one_line(gonio(f, "report energy -o file"), 3, "file");
  EXPECT_EQ(read_bytes(f / "file"), "");
}

TEST(ReportCommand, RefusesAnEnvironmentThatIsNoneBeforeItBegins) {
  const Folder f;
  expect_one_line(gonio(f, "report energy -o out --environment nothing.exr"), 3, "nothing.exr");
  EXPECT_FALSE(std::filesystem::exists(f / "out/energy.json"));
  EXPECT_FALSE(std::filesystem::exists(f / "out/energy.html"));
}

namespace fs = std::filesystem;

/// Everything below a folder, hidden files too.
std::set<std::string> files_below(const std::string& folder) {
  std::set<std::string> all;
  for (const auto& e : fs::recursive_directory_iterator(folder))
    if (!e.is_directory()) all.insert(fs::relative(e.path(), folder).string());
  return all;
}

TEST(ReportCommand, WritesEveryPictureBesideThePage) {
  const Folder f;
  const auto o = gonio(f, "report schlick -o out");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.err, "");
  const auto data = nlohmann::json::parse(read_bytes(f / "out/schlick.json"));
  std::set<std::string> expected{"schlick.html", "schlick.json", "schlick.csv"};
  for (const auto& p : data["figures"])
    for (const char* ending : {".svg", ".csv"})
      expected.insert("schlick/" + p["id"].get<std::string>() + ending);
  for (const auto& p : data["maps"])
    for (const char* ending : {".svg", ".csv", ".exr"})
      expected.insert("schlick/" + p["id"].get<std::string>() + ending);
  EXPECT_EQ(files_below(f / "out"), expected);
  for (const auto& name : expected) EXPECT_GT(fs::file_size(f / ("out/" + name)), 60U) << name;
  const std::string rows = read_bytes(f / "out/schlick.csv");
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(rows, '\n')), 1 + data["rows"].size());
  EXPECT_TRUE(rows.starts_with("form,kind,name,")) << rows.substr(0, 80);
}

TEST(ReportCommand, WritesOnlyThePicturesThatThePageLinksToWhereItIsAskedFor) {
  const Folder f;
  ASSERT_EQ(gonio(f, "report diffuse -o out --pictures first").code, 0);
  const auto page = read_bytes(f / "out/diffuse.html");
  const auto data = nlohmann::json::parse(read_bytes(f / "out/diffuse.json"));
  std::set<std::string> expected{"diffuse.html", "diffuse.json", "diffuse.csv"};
  std::size_t all = 0;
  for (const auto& p : data["figures"]) {
    ++all;
    EXPECT_GT(p["curves"].size(), 0U) << "the document has every picture's values";
  }
  const std::regex link("href=\"(diffuse/[a-z0-9_]+\\.[a-z]+)\"");
  for (std::sregex_iterator at(page.begin(), page.end(), link), none; at != none; ++at)
    expected.insert((*at)[1]);
  const auto first = data["figures"][0]["id"].get<std::string>();  // the index leads to it
  for (const char* ending : {".svg", ".csv"}) expected.insert("diffuse/" + first + ending);
  EXPECT_EQ(files_below(f / "out"), expected);
  EXPECT_GT(expected.size(), 5U);
  EXPECT_LT(expected.size(), all) << "two files a picture";
}

TEST(ReportCommand, TakesAwayThePicturesThatOnlyAnEarlierRunHas) {
  const Folder f;
  fs::create_directories(f / "out/schlick/old_folder.svg");
  fs::create_directories(f / "out/schlick/sub");
  for (const char* name : {"x.svg", "schlick/old.svg", "schlick/old.csv", "schlick/old_map.exr",
                           "schlick/old.exr", "schlick/old.txt", "schlick/mine.svg",
                           "schlick/sub/x.svg", "schlick/colour_difference_gold_1.svg"})
    f.write(std::string("out/") + name, "earlier");
  fs::create_symlink("mine.svg", f / "out/schlick/old_link.svg");
  f.write(
      "out/schlick.json",
      R"({"schema":"gonio.report.schlick/1","figures":[{"id":"old"},{"id":"../x"},{"id":"sub/x"},
              {"id":"old_folder"},{"id":"old_link"},{"id":"colour_difference_gold_1"},{"id":".."},
              {"id":""},{"id":7},{},null],"maps":[{"id":"old_map"}]})");
  f.write("out/index.html", "of all");
  const auto o = gonio(f, "report schlick -o out");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.err, "out/index.html: of an earlier run; gonio report all makes it anew\n");
  const auto left = files_below(f / "out");
  for (const char* gone : {"schlick/old.svg", "schlick/old.csv", "schlick/old_map.exr"})
    EXPECT_FALSE(left.contains(gone)) << gone;
  for (const char* kept :
       {"x.svg", "schlick/old.exr", "schlick/old.txt", "schlick/mine.svg", "schlick/sub/x.svg"})
    EXPECT_TRUE(left.contains(kept)) << kept;
  EXPECT_TRUE(fs::is_symlink(f / "out/schlick/old_link.svg"));
  EXPECT_TRUE(fs::is_directory(f / "out/schlick/old_folder.svg"));
  EXPECT_NE(read_bytes(f / "out/schlick/colour_difference_gold_1.svg"), "earlier");
}

TEST(ReportCommand, TakesNoPictureAwayThatIsAnInput) {
  const Folder f;
  fs::create_directories(f / "out/schlick");
  Image sky{4, 2, {"B", "G", "R"}, std::vector(3, std::vector<float>(8, 1.0F)), {}};
  write_exr(f / "out/schlick/sky.exr", sky);
  f.write("out/schlick.json", R"({"schema":"gonio.report.schlick/1","maps":[{"id":"sky"}]})");
  const auto o = gonio(f, "report schlick --environment out/schlick/sky.exr -o out");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_TRUE(fs::exists(f / "out/schlick/sky.exr"));
}

TEST(ReportCommand, TakesNothingAwayForADocumentThatIsNotItsOwn) {
  const Folder f;
  for (const char* json :
       {R"({"schema":"gonio.report.schlick/1","figures":[{"id":"old"}])", "[[[", "",
        R"({"schema":"gonio.report.energy/1","figures":[{"id":"old"}]})",
        R"({"schema":"gonio.report.schlick/1","figures":{"id":"old"},"maps":"old"})"})
    EXPECT_TRUE(picture_files(json, "schlick").empty()) << json;
  fs::create_directories(f / "out/schlick");
  f.write("out/schlick/old.svg", "mine");
  f.write("out/schlick.json", R"({"figures":[{"id":"old"}]})");
  const auto o = gonio(f, "report schlick -o out");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.err, "");
  EXPECT_EQ(read_bytes(f / "out/schlick/old.svg"), "mine");
}

TEST(ReportCommand, LeavesNothingWhereOnePictureHasNoPlace) {
  const Folder f;
  fs::create_directories(f / "out/schlick/colour_difference_gold_1.svg");
  expect_one_line(gonio(f, "report schlick -o out"), 3, "colour_difference_gold_1.svg: ");
  EXPECT_TRUE(files_below(f / "out").empty()) << "those before it are gone again";
}

TEST(ReportCommand, LeavesNothingOnAFullDisk) {
  const Folder f;
  // A limit of the size of files fails the write as a full disk does, in the middle of a file.
  expect_one_line(gonio(f, "report schlick -o out", "ulimit -f 20; "), 3, "schlick.html: ");
  EXPECT_TRUE(fs::is_empty(f / "out"));
}

TEST(ReportCommand, RefusesAPlaceForPicturesThatIsNoneBeforeItBegins) {
  const Folder f;
  fs::create_directories(f / "out");
  f.write("out/schlick", "mine");  // where a folder of pictures would be
  expect_one_line(gonio(f, "report schlick -o out"), 3, "out/schlick");
  expect_one_line(gonio(f, "report all -o out"), 3, "out/schlick");
  EXPECT_EQ(files_below(f / "out"), std::set<std::string>{"schlick"});
  EXPECT_EQ(read_bytes(f / "out/schlick"), "mine");
}

TEST(ReportCommand, RefusesAFolderThatCannotBeWrittenBeforeItBegins) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const Folder f;
  fs::create_directories(f / "out");
  fs::permissions(f / "out", fs::perms::owner_read | fs::perms::owner_exec);
  expect_one_line(gonio(f, "report energy -o out"), 3, "out/energy");
  fs::permissions(f / "out", fs::perms::owner_all);
}

}  // namespace
}  // namespace gonio::test
