// Several files of one sample: their samples as one list, and files that disagree.
#include "table/format/as_one.h"

#include "base/sha256.h"
#include "refusal.h"
#include "support.h"
#include "table/example.h"
#include "table/format/formats.h"

namespace gonio {
namespace {

using namespace test;

/// Lines of an incident angle, seen from a ring of directions.  \param scale  of the values
std::string run_of(double theta_i, double scale, const std::string& names = "f") {
  std::string text = "theta_i,phi_i,theta_o,phi_o," + names + "\n";
  for (int k = 0; k < 24; ++k)
    text += fmt::format("{},0,{},{},{}\n", theta_i, 10 + k, 180 - k,
                        scale * (0.1 + 0.01 * k) * (k % 2 ? 1.01 : 0.99));
  return text;
}

TEST(AsOne, HasTheSamplesOfAllFilesInTheirOrder) {
  const Folder folder;
  const std::vector<std::string> paths{folder.write("a.csv", run_of(20, 1)),
                                       folder.write("b.csv", run_of(40, 1))};
  const Table t = read_as_one(paths);
  const Table a = read_table(paths[0]), b = read_table(paths[1]);
  ASSERT_EQ(t.size(), 48U);
  EXPECT_EQ(t.list()->theta_i_deg[23], 20);
  EXPECT_EQ(t.list()->theta_i_deg[24], 40);
  EXPECT_EQ(t.values[0][23], a.values[0][23]);
  EXPECT_EQ(t.values[0][24], b.values[0][0]);
  EXPECT_EQ(t.path, paths[0] + ", " + paths[1]);
  EXPECT_EQ(t.sha256, sha256(sha256_of_file(paths[0]) + "\n" + sha256_of_file(paths[1]) + "\n"));
  EXPECT_TRUE(t.warnings.empty());
  EXPECT_EQ(t.notes.back(),
            (std::pair<std::string, std::string>{"agreement", "no direction stands in two files"}));
}

TEST(AsOne, NamesTheFileWhoseScaleDiffersWhereDirectionsAreShared) {
  const Folder folder;
  const auto of = [&](double scale) {
    return read_as_one(
        {folder.write("a.csv", run_of(20, 1)), folder.write("b.csv", run_of(20, scale))});
  };
  EXPECT_TRUE(of(1.03).warnings.empty()) << "within 5 %";
  EXPECT_HAS(of(1.03).notes.back().second, "1.03 × the files before it, at 24 shared directions");
  ASSERT_EQ(of(1.2).warnings.size(), 1U);
  EXPECT_HAS(of(1.2).warnings[0], "b.csv is 1.2 × ");
}

TEST(AsOne, LeavesOutWhatAGridHasBelowTheHorizon) {
  const Folder folder;
  const Table grid = merl_example(0.3);
  write_table(grid, folder / "g.binary");
  const Table t = read_as_one({folder / "g.binary"});
  EXPECT_LT(t.size(), grid.size());
  EXPECT_EQ(t.format, "merl");
  EXPECT_TRUE(t.grid() == nullptr);
}

TEST(AsOne, RefusesFilesOfOtherChannels) {
  const Folder folder;
  const std::vector<std::string> paths{folder.write("a.csv", run_of(20, 1)),
                                       folder.write("b.csv", run_of(40, 1, "f_x"))};
  EXPECT_HAS(refusal([&] { read_as_one(paths); }), "b.csv: channels: found x, expected f, as ");
}

}  // namespace
}  // namespace gonio
