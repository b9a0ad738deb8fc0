// What is written reads back.
#include <cmath>
#include <cstring>

#include "base/error.h"
#include "base/file.h"
#include "base/sha256.h"
#include "refusal.h"
#include "support.h"
#include "table/example.h"

namespace gonio {
namespace {

using namespace test;

Table through_file(const Table& t, const Folder& folder, std::optional<Bins> bins = {}) {
  write_table(t, folder / "table");
  return read_table(folder / "table", bins);
}

void expect_same(const Table& a, const Table& b) {
  EXPECT_EQ(a.format, b.format);
  EXPECT_EQ(a.channels, b.channels);
  EXPECT_EQ(a.values, b.values);
  EXPECT_EQ(a.weights, b.weights);
  EXPECT_EQ(a.negative_is_noise, b.negative_is_noise);
  EXPECT_EQ(a.notes, b.notes);
  ASSERT_EQ(a.grid() != nullptr, b.grid() != nullptr);
  EXPECT_TRUE(!a.grid() || *a.grid() == *b.grid());
}

TEST(WriteTable, TakesNoSideFileAwayThatIsAnInput) {
  const Folder folder;
  Table t = merl_example(0.2);
  const std::string side = folder.write("table.gonio.json", R"({"sha256": "that of another"})");
  const FileGuard guard;
  will_read(side);
  EXPECT_HAS(refusal([&] { write_table(t, folder / "table"); }, Exit::usage), "is an input");
  EXPECT_TRUE(std::filesystem::exists(side));
}

TEST(MerlFile, ReadsBackWhatItWrote) {
  const Folder folder;
  for (const bool reciprocal : {true, false}) {
    const Table t = merl_example(0.2, Bins::centre, reciprocal), back = through_file(t, folder);
    EXPECT_TRUE(*back.grid() == *t.grid());
    const SampleAngles at(t);
    std::size_t below = 0, wrong = 0;
    for (std::size_t i = 0; i < t.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c) {
        const double v = t.values[c][i], w = back.values[c][i];
        if (mask(at(i), v) == Mask::below_horizon)
          below += w < 0;
        else
          wrong += std::abs(w / v - 1) > 1e-15;
      }
    EXPECT_EQ(wrong, 0U);
    EXPECT_GT(below, 10000U);
    EXPECT_EQ(folder.entries(), 1U) << "nothing to say, no side file";
  }
}

TEST(MerlFile, HasTheDocumentedSizeAndScale) {
  const Folder folder;
  Table t =
      on_grid(merl_grid(Bins::centre), "merl", {"f"}, [](const auto&, std::size_t) { return 1.0; });
  write_table(t, folder / "m");
  const auto bytes = read_bytes(folder / "m");
  ASSERT_EQ(bytes.size(), 34'992'012U);
  std::array<double, 3> first{};
  for (std::size_t c = 0; c < 3; ++c)
    std::memcpy(&first[c], bytes.data() + 12 + c * 90 * 90 * 180 * 8, 8);
  EXPECT_DOUBLE_EQ(first[0], 1500);
  EXPECT_DOUBLE_EQ(first[1], 1500 / 1.15);
  EXPECT_DOUBLE_EQ(first[2], 1500 / 1.66);
}

TEST(MbsdfFile, ReadsBackWhatItWrote) {
  const Folder folder;
  Table t = mbsdf_example();
  t.values[1][5] = -0.25;
  expect_same(t, through_file(t, folder));
  t.channels = {"f"};
  t.values.resize(1);
  expect_same(t, through_file(t, folder));
  EXPECT_EQ(folder.entries(), 1U);
}

TEST(MbsdfFile, WritesTheBytesItRead) {
  GONIO_NEEDS_SHARED(file, "data/mbsdf/carpaint_blue.mbsdf");
  const Folder folder;
  write_table(read_table(file), folder / "copy");
  EXPECT_TRUE(read_bytes(folder / "copy") == read_bytes(file));
}

TEST(CsvFile, ReadsBackBitForBit) {
  const Folder folder;
  const Table t = csv_example(), back = through_file(t, folder);
  expect_same(t, back);
  EXPECT_EQ(t.list()->theta_i_deg, back.list()->theta_i_deg);
  EXPECT_EQ(t.list()->phi_i_deg, back.list()->phi_i_deg);
  EXPECT_EQ(t.list()->theta_o_deg, back.list()->theta_o_deg);
  EXPECT_EQ(t.list()->phi_o_deg, back.list()->phi_o_deg);
}

/// Names that a separator, a quote, a line end or a blank stands in.
const std::vector<std::string> hostile_names{
    "a,b", "say \"x\"", "\"", "\"q\"", "\",\"", " lead",  "trail ",  "two\nlines", "\n#x", "a\rb",
    "a;b", "tab\tbed",  "#1", "f",     "f_f",   "weight", "theta_i", "0",          "\r\n", "µ"};

Table with_hostile_names(Table t) {
  t.channels = hostile_names;
  t.values.resize(t.channels.size(), t.values[0]);
  return t;
}

TEST(CsvFile, ReadsBackAnyNameOfAChannel) {
  const Folder folder;
  Table t = with_hostile_names(csv_example());
  expect_same(t, through_file(t, folder));
  for (const auto& name : hostile_names) {
    t.channels = {name};
    t.values.resize(1);
    expect_same(t, through_file(t, folder));
  }
  t.channels = {""};
  expect_same(t, through_file(t, folder));
}

TEST(ImageSlice, ReadsBackAnyNameOfAChannel) {
  const Folder folder;
  const Table t = with_hostile_names(slice_example());
  expect_same(t, through_file(t, folder));
}

TEST(CsvFile, TakesAGridAsItsDirections) {
  const Folder folder;
  Table t = mbsdf_example(4, 5);
  std::get<Grid>(t.where).bins = Bins::edge;
  t.truth = truth_example();
  t.format = "csv";
  const Table back = through_file(t, folder);
  EXPECT_EQ(back.values, t.values);
  const SampleAngles a(t), b(back);
  for (std::size_t i = 0; i < t.size(); ++i) EXPECT_NEAR(a(i).noh, b(i).noh, 1e-12);
}

TEST(CsvFile, TakesAnyOrderCommentsAndSpreadsheetHabits) {
  const Folder folder;
  const Table t =
      read_table(folder.write("t.csv",
                              "\xef\xbb\xbf# made by hand\r\nf_b, phi_o,theta_o,theta_i,phi_i\r\n"
                              "1e-3,10 ,20,30,-40\r\n# half way\r\nnan,1,2,3,4\r\n\r\n"));
  EXPECT_EQ(t.channels, std::vector<std::string>{"b"});
  ASSERT_EQ(t.size(), 2U);
  EXPECT_EQ(t.values[0][0], 1e-3);
  EXPECT_TRUE(std::isnan(t.values[0][1]));
  EXPECT_EQ(t.list()->phi_i_deg, (std::vector<double>{-40, 4}));
  EXPECT_TRUE(t.weights.empty());
}

TEST(ExrSlice, ReadsBackWhatItWrote) {
  const Folder folder;
  expect_same(slice_example(), through_file(slice_example(), folder));
  EXPECT_EQ(folder.entries(), 1U);
}

TEST(SideFile, KeepsTruthBinsAndNotes) {
  const Folder folder;
  for (Table t : {merl_example(0.2, Bins::edge), mbsdf_example(), csv_example(), slice_example()}) {
    t.truth = truth_example();
    t.notes = {{"instrument", "none"}, {"made", "today"}};
    const Table back = through_file(t, folder);
    ASSERT_TRUE(back.truth) << t.format;
    EXPECT_EQ(back.truth->model, t.truth->model);
    EXPECT_EQ(back.truth->parameters, t.truth->parameters);
    EXPECT_EQ(back.truth->noise, t.truth->noise);
    EXPECT_EQ(back.truth->floor, t.truth->floor);
    EXPECT_EQ(back.truth->outliers, t.truth->outliers);
    EXPECT_EQ(back.truth->seed, t.truth->seed);
    EXPECT_EQ(back.notes, t.notes);
    EXPECT_TRUE(!t.grid() || back.grid()->bins == t.grid()->bins);
  }
}

TEST(SideFile, GivesWayToAnExplicitConvention) {
  const Folder folder;
  Table t = mbsdf_example();
  std::get<Grid>(t.where).bins = Bins::edge;
  EXPECT_EQ(through_file(t, folder).grid()->bins, Bins::edge);
  EXPECT_EQ(through_file(t, folder, Bins::centre).grid()->bins, Bins::centre);
  EXPECT_EQ(folder.entries(), 2U);
  EXPECT_EQ(through_file(mbsdf_example(), folder).grid()->bins, Bins::centre);
  EXPECT_EQ(folder.entries(), 1U) << "the old side file does not speak for the new table";
}

TEST(SideFile, SpeaksForTheTableItWasWrittenWithAlone) {
  const Folder folder;
  Table t = csv_example();
  t.truth = truth_example();
  write_table(t, folder / "t.csv");
  EXPECT_EQ(read_table(folder / "t.csv").sha256, sha256_of_file(folder / "t.csv"));
  const std::string other = "theta_i,phi_i,theta_o,phi_o,f\n1,2,3,4,5\n";
  folder.write("t.csv", other);
  const std::string line = refusal([&] { read_table(folder / "t.csv"); });
  EXPECT_TRUE(line.starts_with((folder / "t.csv.gonio.json") + ": sha256: found ")) << line;
  EXPECT_TRUE(line.ends_with("… (it describes another table and may be removed)")) << line;
  TableAndDigest early(folder / "t.csv");
  EXPECT_THROW(early.finish(), Error) << "used before the sum was made, but not shown";
  std::filesystem::remove(folder / "t.csv.gonio.json");
  EXPECT_TRUE(read_table(folder / "t.csv").sha256.empty()) << "nobody asked";
}

TEST(SideFile, MadeByHandNeedsNoSha256) {
  const Folder folder;
  write_table(mbsdf_example(), folder / "m");
  folder.write("m.gonio.json", R"({"schema":"gonio.table/1","bins":"edge"})");
  const Table t = read_table(folder / "m");
  EXPECT_EQ(t.grid()->bins, Bins::edge);
}

TEST(SideFile, IsNotLookedForUnderANameThatIsTooLong) {
  const Folder folder;
  const std::string name(250, 'n');
  folder.write(name, "theta_i,phi_i,theta_o,phi_o,f\n1,2,3,4,5\n");
  EXPECT_EQ(read_table(folder / name).size(), 1U);
}

TEST(WriteTable, LeavesNothingWhereItFails) {
  const Folder folder;
  Table t = csv_example();
  t.truth = truth_example();
  std::filesystem::create_directory(folder / "taken");
  EXPECT_THROW(write_table(t, folder / "taken"), Error);
  EXPECT_THROW(write_table(t, folder / "none/such"), Error);
  std::filesystem::create_directory(folder / "a.gonio.json");
  EXPECT_THROW(write_table(t, folder / "a"), Error) << "where the side file cannot be, no table is";
  t.format = "merl";
  EXPECT_THROW(write_table(t, folder / "b"), Error) << "a list is not a grid";
  t.format = "mbsdf";
  EXPECT_THROW(write_table(t, folder / "b"), Error);
  t.format = "exr";
  EXPECT_THROW(write_table(t, folder / "b"), Error);
  t = slice_example();
  EXPECT_THROW(write_table(t, folder / "taken"), Error);
  EXPECT_THROW(write_table(t, folder / "none/such"), Error);
  EXPECT_EQ(folder.entries(), 2U);
}

}  // namespace
}  // namespace gonio
