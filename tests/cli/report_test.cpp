// gonio report: what it refuses, before any work is done.
#include <filesystem>

#include "program.h"

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

}  // namespace
}  // namespace gonio::test
