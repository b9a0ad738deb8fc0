// CSV as instruments write it: other names, units and conventions, said once in the side file.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "base/error.h"
#include "refusal.h"
#include "support.h"
#include "table/example.h"
#include "table/format/delimited.h"
#include "table/format/metadata.h"
#include "table/health/health.h"

#include <fmt/format.h>
#include <tbb/global_control.h>

namespace gonio {
namespace {

using namespace test;

/// The table of a text under what a side file says of its columns ("" for no side file).
Table read(const std::string& text, const std::string& columns = "") {
  const Folder folder;
  folder.write("t.csv", text);
  if (!columns.empty())
    folder.write("t.csv.gonio.json", R"({"schema":"gonio.table/1","columns":{)" + columns + "}}");
  return read_table(folder / "t.csv");
}
/// Complaint of the reader, after the folder's name.
std::string complaint_of_columns(const std::string& text, const std::string& columns = "") {
  const std::string line = refusal([&] { read(text, columns); });
  return line.empty() ? line : line.substr(line.find("t.csv"));
}
void expect_complaint(const std::string& text,
                      const std::string& columns,
                      const std::string& holding) {
  EXPECT_NE(complaint_of_columns(text, columns).find(holding), std::string::npos)
      << "instead: " << complaint_of_columns(text, columns);
}

/// The samples as "theta_i phi_i theta_o phi_o: values".
std::vector<std::string> samples(const Table& t) {
  std::vector<std::string> all;
  const auto& l = *t.list();
  for (std::size_t i = 0; i < t.size(); ++i) {
    char text[200];
    std::snprintf(text, sizeof text, "%.6g %.6g %.6g %.6g:", l.theta_i_deg[i], l.phi_i_deg[i],
                  l.theta_o_deg[i], l.phi_o_deg[i]);
    all.emplace_back(text);
    for (const auto& plane : t.values) {
      std::snprintf(text, sizeof text, " %.6g", plane[i]);
      all.back() += text;
    }
  }
  return all;
}
using Lines = std::vector<std::string>;

constexpr const char* kPlain = "theta_i,phi_i,theta_o,phi_o,f\n";

TEST(ColumnMap, TakesNamesNumbersAndConstants) {
  const Table t = read("in,out,brdf,speed\n30,20,0.5,x\n30,40,0.25,y\n",
                       R"("theta_i":"in","theta_o":"#2","phi_i":"10","phi_o":"190","f":"brdf")");
  EXPECT_EQ(samples(t), (Lines{"30 10 20 190: 0.5", "30 10 40 190: 0.25"}));
  EXPECT_EQ(t.channels, Lines{"f"});
}

TEST(ColumnMap, PrefersAColumnToAConstantOfThatName) {
  const Table t = read("theta_i,theta_o,400,700\n30,20,0.5,0.25\n",
                       R"("phi_o":"180","f_400":"400","f_700":"700")");
  EXPECT_EQ(t.channels, (Lines{"400", "700"}));
  EXPECT_EQ(samples(t), Lines{"30 0 20 180: 0.5 0.25"});
}

TEST(ColumnMap, TakesWhatIsNotSaidFromTheColumnOfThatName) {
  const Table t =
      read("theta_i,phi_i,theta_o,phi_o,f_x,weight,other\n1,2,3,4,5,6,seven\n", R"("f":"f_x")");
  EXPECT_EQ(samples(t), Lines{"1 2 3 4: 5"});
  EXPECT_EQ(t.weights, std::vector<double>{6});
  EXPECT_EQ(t.channels, Lines{"f"});
}

TEST(ColumnMap, TurnsSignedAnglesIntoTheOtherSide) {
  const Table t =
      read(std::string(kPlain) + "-30,0,20,0,1\n30,0,-20,0,2\n30,300,-20,300,3\n", R"("f":"f")");
  EXPECT_EQ(samples(t), (Lines{"30 180 20 0: 1", "30 0 20 180: 2", "30 300 20 120: 3"}));
}

TEST(ColumnMap, ReadsRadians) {
  const Table t = read(std::string(kPlain) + "0.5235987755982988,0,-1.5707963267948966,0,1\n",
                       R"("unit":"radians")");
  EXPECT_EQ(samples(t), Lines{"30 0 90 180: 1"});
  EXPECT_TRUE(t.warnings.empty());
}

TEST(ColumnMap, CountsAzimuthsFromWhereTheLightGoesTo) {
  const Table t = read("theta_i,theta_o,f\n30,20,1\n30,-20,2\n", R"("forward":0)");
  EXPECT_EQ(samples(t), (Lines{"30 0 20 180: 1", "30 0 20 0: 2"}));
}

TEST(ColumnMap, DividesByTheCosineAndScales) {
  const Table t =
      read("theta_i,theta_o,f\n0,60,1\n0,0,1\n0,90,7\n", R"("cosine":true,"scale":0.5)");
  EXPECT_EQ(samples(t), (Lines{"0 0 60 0: 1", "0 0 0 0: 0.5", "0 0 90 0: nan"}));
  EXPECT_EQ(inspect(t).masked[static_cast<std::size_t>(Mask::below_horizon)], 1U)
      << "90° is the horizon although its cosine is 6e-17";
}

TEST(ColumnMap, MakesChannelsOfRows) {
  const Table t = read(
      "nm,theta_i,theta_o,f\n"
      "1000,10,20,1\n"
      "550,10,20,2\n"
      "550,10,30,3\n"
      "550,10,20,4\n",
      R"("channel":"nm")");
  EXPECT_EQ(t.channels, (Lines{"550", "1000"})) << "ascending as numbers";
  EXPECT_EQ(samples(t), (Lines{"10 0 20 0: 2 1", "10 0 30 0: 3 nan", "10 0 20 0: 4 nan"}))
      << "a repeated measurement is another sample";
}

TEST(ColumnMap, KeepsOneWeightForAllChannelsOfADirection) {
  const std::string head = "c,theta_i,theta_o,f,weight\n";
  EXPECT_EQ(read(head + "a,1,2,3,5\nb,1,2,4,5\n", R"("channel":"c")").weights,
            std::vector<double>{5});
  expect_complaint(head + "a,1,2,3,5\nb,1,2,4,6\n", R"("channel":"c")", "column weight");
}

TEST(ColumnMap, RefusesChannelsThatShareNoDirections) {
  std::string text = "c,theta_i,theta_o,f\n";
  for (int i = 0; i < 100; ++i)
    text += std::to_string(i) + ",10," + std::to_string(0.5 * i) + ",1\n";
  expect_complaint(text, R"("channel":"c")", "100 channels at 100 directions in 100 rows");
}

TEST(ColumnMap, SkipsLinesAndTakesNamesFromACommentOverNumbers) {
  EXPECT_EQ(samples(read("Instrument 7\nMonday\nA;B;C\n10;20;0,5\n",
                         R"("theta_i":"A","theta_o":"B","f":"C","skip":2)")),
            Lines{"10 0 20 0: 0.5"});
  EXPECT_EQ(samples(read("# by hand\n# A   B   C\n10  20\t 0.5\n",
                         R"("theta_i":"A","theta_o":"B","f":"C")")),
            Lines{"10 0 20 0: 0.5"});
  EXPECT_EQ(samples(read("# three words here\n# and now four words\n10 20 0.5\n",
                         R"("theta_i":"#1","theta_o":"#2","f":"#3")")),
            Lines{"10 0 20 0: 0.5"});
}

TEST(ColumnMap, MustFitTheFile) {
  const std::string file = "a,b,c,c\n10,20,1,2\n";
  const std::string angles = R"("theta_i":"a","theta_o":"b",)";
  expect_complaint(file, angles + R"("f":"d")",
                   "line 1: found no column 'd' for f, expected one of a, b, c, c");
  expect_complaint(file, angles + R"("f":"c")", "column c: found a second column of that name");
  EXPECT_EQ(complaint_of_columns(file, angles + R"("f":"#4")"), "");
  expect_complaint(file, angles + R"("f":"#5")", "no column '#5'");
  expect_complaint(file, angles + R"("f":"#0")", "no column '#0'");
  expect_complaint(file, R"("theta_i":"a","f":"#3")", "no column 'theta_o' for theta_o");
  expect_complaint(file, R"("theta_i":"a","theta_o":"b")", "no column 'f' for f");
  expect_complaint(file, angles + R"("f":"a")", "a column that is two things");
  expect_complaint(file, angles + R"("f":"#3","weight":"#3")", "a column that is two things");
  expect_complaint(file, angles + R"("f":"#3","channel":"5")", "no column '5' for channel");
  expect_complaint(file, angles + R"("f_a":"#3","f_b":"#4","channel":"b")", "two things");
  expect_complaint("a,b,c,d,e\n10,20,1,2,3\n", angles + R"("f_a":"c","f_b":"d","channel":"e")",
                   "channel beside several f_NAME");
  expect_complaint(file, angles + R"("f":"#3","phi_o":"1000")", "found 1000");
  expect_complaint(file, R"("theta_i":"a","theta_o":"a","f":"#3")", "a column that is two things");
}

TEST(ColumnMap, MayNotMakeTwoChannelsOfOneName) {
  const std::string text = "theta_i,theta_o,a,b\n0,10,1,2\n";
  expect_complaint(text, R"("f":"a","f_f":"b")", "columns: found two channels named f");
  EXPECT_EQ(read(text, R"("f":"a","f_g":"b")").channels, (Lines{"f", "g"}));
}

TEST(ColumnMap, OfManyConstantsMayNotMakeATableOfAnySize) {
  constexpr std::size_t constants = 4000, rows = most_values / constants + 1;
  std::string text = "theta_i,phi_i,theta_o,phi_o,f\n", columns = R"("weight":"1")";
  for (std::size_t i = 0; i < rows; ++i) text += "0,0,10,0,1\n";
  for (std::size_t i = 0; i < constants; ++i) columns += ",\"f_" + std::to_string(i) + "\":\"1\"";
  expect_complaint(text, columns, "expected at most 67108864 numbers");
}

TEST(ColumnMap, IsNamedWhereItIsBroken) {
  for (const auto& [columns, holding] : std::initializer_list<std::pair<const char*, const char*>>{
           {R"("thetai":"a")", "columns.thetai: found \"a\", expected no such key"},
           {R"("f_":"a")", "columns.f_"},
           {R"("theta_i":5)", "columns.theta_i: found 5, expected a string"},
           {R"("unit":"grad")", "columns.unit: found \"grad\", expected \"degrees\" or"},
           {R"("forward":"no")", "columns.forward"},
           {R"("forward":null)", "columns.forward: found null, expected a number in [-360, 360]"},
           {R"("forward":1e300)",
            "columns.forward: found 1e+300, expected a number in [-360, 360]"},
           {R"("scale":0)", "columns.scale: found 0, expected a finite number above 0"},
           {R"("scale":-1)", "columns.scale: found -1, expected a finite number above 0"},
           {R"("scale":null)", "columns.scale: found null, expected a finite number above 0"},
           {R"("weight":"-1")", "column weight: found -1"},
           {R"("weight":"inf")", "column weight: found inf"},
           {R"("skip":1.5)", "columns.skip: found 1.5, expected a whole number"},
           {R"("cosine":1)", "columns.cosine: found 1, expected true or false"},
           {R"("skip":-1)", "columns.skip"}})
    expect_complaint(std::string(kPlain) + "1,2,3,4,5\n", columns, holding);
  const Folder folder;
  write_table(mbsdf_example(2, 3), folder / "m");
  folder.write("m.gonio.json", R"({"schema":"gonio.table/1","columns":{}})");
  EXPECT_THROW(read_table(folder / "m"), Error) << "an MBSDF has no columns";
}

TEST(ColumnMap, IsWrittenBesideWhatElseTheSideFileSays) {
  ColumnMap map;
  map.columns = {{"theta_i", "in"}, {"f", "#7"}};
  map.radians = true;
  map.cosines = {0, 1};
  map.forward_deg = 0;
  map.scale = 0.25;
  map.skip = 3;
  const std::string text = with_columns(
      "s", R"({"schema":"gonio.table/1","notes":{"made":"today"},"columns":{"f":"old"}})", map);
  EXPECT_NE(text.find("today"), text.npos);
  const auto back = column_map("s", text);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->columns, map.columns);
  EXPECT_TRUE(back->radians && back->cosines == (CosinePowers{0, 1}));
  EXPECT_EQ(back->forward_deg, 0);
  EXPECT_EQ(back->scale, 0.25);
  EXPECT_EQ(back->skip, 3U);
  EXPECT_FALSE(column_map("s", R"({"schema":"gonio.table/1"})"));
}

TEST(ColumnMap, SaysAnyPowersOfTheCosines) {
  ColumnMap map;
  map.cosines = {1, -2};
  const std::string text = with_columns("s", "", map);
  EXPECT_EQ(column_map("s", text)->cosines, (CosinePowers{1, -2})) << text;
  for (const char* wrong : {"[1]", "[0.5, 0]", "[9, 0]", "true"})
    EXPECT_THROW(
        column_map(
            "s", fmt::format(R"({{"schema":"gonio.table/1","columns":{{"cosines":{}}}}})", wrong)),
        Error)
        << wrong;
}

TEST(CsvFile, ReadsEverySeparatorQuotesAndDecimalCommas) {
  const Lines expected{"30 0 20.5 180: 0.25"};
  for (const char* text :
       {"theta_i;phi_i;theta_o;phi_o;f\r\n30;0;20,5;180;0,25\r\n",
        "theta_i\tphi_i\ttheta_o\tphi_o\tf\n30\t0\t20,5\t180\t0,25\n",
        "theta_i phi_i theta_o  phi_o f\n 30 0   20,5 180\t0,25 \n",
        "\"theta_i\",\"phi_i\",\"theta_o\",\"phi_o\",\"f\"\n30,0,\"20,5\",180,\"0,25\"\n",
        "theta_i,phi_i,theta_o,phi_o,f\n+30,0,20.5,180,+2.5e-1\n",
        "theta_i,\tphi_i,\ttheta_o,\tphi_o,\tf\n30,\t0,\t20.5,\t180,\t0.25\n"})
    EXPECT_EQ(samples(read(text)), expected) << text;
}

TEST(CsvFile, ReadsTheLineEndsOfOldMacs) {
  EXPECT_EQ(samples(read("# old\rtheta_i,phi_i,theta_o,phi_o,f\r30,0,20.5,180,0.25\r")),
            Lines{"30 0 20.5 180: 0.25"});
}

/// Columns of values f_0, f_1 …, and a row.
std::string wide(std::size_t channels) {
  std::string text = "theta_i,theta_o", row = "\n10,20";
  for (std::size_t i = 0; i < channels; ++i) {
    text += ",f_" + std::to_string(i);
    row += ",1";
  }
  return text + row + "\n";
}

TEST(CsvFile, OfMoreChannelsThanATableHoldsIsRefused) {
  EXPECT_EQ(read(wide(most_channels)).channels.size(), most_channels);
  expect_complaint(wide(most_channels + 1), "",
                   "t.csv: line 1: found 4097 channels, expected at most 4096");
  expect_complaint(wide(most_channels + 1), R"("unit":"degrees")",
                   "t.csv: line 1: found 4097 channels, expected at most 4096");
  std::string long_names = "theta_i,theta_o", row = "\n10,20";
  for (int i = 0; i < 300; ++i)
    long_names += ",f_" + std::to_string(i) + std::string(4000, 'x'), row += ",1";
  expect_complaint(long_names + row + "\n", "",
                   "bytes of names of channels, expected at most 1048576");
  std::string rows = "nm,theta_i,theta_o,f\n";
  for (std::size_t i = 0; i <= most_channels; ++i) rows += std::to_string(i) + ",10,20,1\n";
  expect_complaint(rows, R"("channel":"nm")",
                   "line 4098, column nm: found one more channel, expected at most 4096");
  std::string columns = R"("unit":"degrees")";
  for (std::size_t i = 0; i < 200'000; ++i) columns += ",\"f_" + std::to_string(i) + "\":\"1\"";
  expect_complaint(kPlain, columns, "columns: found 200000 channels, expected at most 4096");
}

TEST(CsvFile, OfMoreBytesThanItsNumbersTakeIsRefusedBeforeItIsRead) {
  const Folder folder;
  const auto path = folder.write("t.csv", kPlain);
  std::filesystem::resize_file(path, 25 * most_values + 1);  // a hole
  InputFile in(path);
  EXPECT_HAS(refusal([&] { read_csv(in); }),
             "t.csv: byte 0: found 1677721601 bytes, expected at most 1677721600");
}

/// Were each name looked for among all others, one by one, these would take some ten minutes.
TEST(CsvFile, OfManyColumnsTakesLinearTime) {
  constexpr std::size_t most = 1'000'000;
  expect_complaint(wide(most), "", "found 1000000 channels");
  std::string map = R"("f":"f_7")";
  for (std::size_t i = 0; i < most_channels - 1; ++i)
    map += ",\"f_" + std::to_string(i) + "\":\"f_" + std::to_string(most - i - 1) + "\"";
  EXPECT_EQ(read(wide(most), map).channels.size(), most_channels);
}

/// Megabytes, which are read in parts; comments and blank lines between.
std::string many_lines(std::size_t n) {
  std::string text = kPlain;
  for (std::size_t i = 0; i < n; ++i) {
    if (i % 1000 == 7) text += "# half way\n\n";
    text += std::to_string(i % 90) + ".25,0," + std::to_string(i % 89) + ".5,180," +
            (i % 501 ? std::to_string(i) + ".125\n" : "-\n");
  }
  return text;
}
constexpr std::size_t many = 120'000;

TEST(CsvFile, OfManyLinesIsTheSameTableReadInPartsByAnyNumberOfThreadsOrLineByLine) {
  const std::string text = many_lines(many);
  const Table at_once = read(text);
  ASSERT_EQ(at_once.size(), many);
  EXPECT_EQ(at_once.values[0][many - 1], many - 1 + 0.125);
  EXPECT_TRUE(std::isnan(at_once.values[0][501]));
  const auto expect_same = [&](const Table& t) {
    EXPECT_EQ(t.list()->theta_i_deg, at_once.list()->theta_i_deg);
    EXPECT_EQ(t.list()->theta_o_deg, at_once.list()->theta_o_deg);
    ASSERT_EQ(t.size(), many);
    EXPECT_EQ(std::memcmp(t.values[0].data(), at_once.values[0].data(), many * sizeof(double)), 0);
  };
  expect_same(read(text + "# a quote: \"\n"));  // leaves open where lines end
  for (const std::size_t threads : {1, 3}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    expect_same(read(text));
  }
}

TEST(CsvFile, OfManyLinesNamesTheFirstThatIsWrongWhateverTheThreads) {
  const std::string text = many_lines(many), good = "30,0,20,180,0.25\n";
  const std::size_t next = many + 2 * many / 1000 + 2;  // line below those of text
  const std::string place = "t.csv: line " + std::to_string(next);
  for (const std::size_t threads : {1, 2, 3}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_EQ(
        complaint_of_columns(text + "30,0,20,180\n" + text.substr(std::strlen(kPlain)) + "x\n"),
        place + ": found 4 fields, expected 5");
    EXPECT_EQ(complaint_of_columns(text + "270,0,20,180,1\n" + good + "1,2,3,4,y\n"),
              place +
                  ", column theta_i: found 270, expected a number in [-180, 180] degrees (a "
                  "zenith angle; perhaps columns are swapped)");
    EXPECT_EQ(complaint_of_columns(text + "30,0,20,180,1e\n"),
              place + ", column f: found '1e', expected a number");
  }
}

/// Who mapped the file into memory would be killed here.
TEST(CsvFile, ThatIsCutShortWhileItIsOpenIsToldWhereItEnds) {
  const Folder folder;
  const auto path = folder.write("t.csv", many_lines(many));
  InputFile in(path);
  std::filesystem::resize_file(path, 12345);
  EXPECT_HAS(refusal([&] { read_csv(in); }), "t.csv: byte 12345: found the end of the file");
}

TEST(CsvFile, OfManyLinesHasTheChannelsThatItsRowsName) {
  const std::string map = R"("channel":"nm")";
  std::string text = "nm,theta_i,theta_o,f\n";
  for (std::size_t i = 0; i < many; ++i)
    text += std::to_string(700 - 10 * (i % 30)) + ",20.25," + std::to_string(i / 30) + "e-2," +
            std::to_string(i) + ".125\n";
  const Table at_once = read(text, map), by_line = read(text + "# a quote: \"\n", map);
  ASSERT_EQ(at_once.channels.size(), 30U);
  EXPECT_EQ(at_once.channels[0], "410");
  EXPECT_EQ(at_once.channels, by_line.channels);
  EXPECT_EQ(at_once.size(), many / 30);
  EXPECT_EQ(at_once.values[0][3], 119.125);
  EXPECT_EQ(at_once.values, by_line.values);
  EXPECT_EQ(at_once.list()->theta_o_deg, by_line.list()->theta_o_deg);
  for (std::size_t i = 0; i < most_channels; ++i) text += "_" + std::to_string(i) + ",1,2,3\n";
  expect_complaint(text, map,
                   "line 124068, column nm: found one more channel, expected at most 4096");
}

TEST(CsvFile, MixesNoPointsAndCommasHoweverFarApart) {
  const std::string neither = "30;0;20;180;1\n";
  std::string commas = "theta_i;phi_i;theta_o;phi_o;f\n" + neither + "30;0;20;180;0,25\n";
  for (std::size_t i = 0; i < 2 * many; ++i) commas += neither;
  EXPECT_EQ(complaint_of_columns(commas), "");
  EXPECT_EQ(complaint_of_columns(commas + "30;0;20;180;0.25\n"),
            "t.csv: line 240004, column f: found 0.25, expected decimal points or decimal commas, "
            "not both");
}

TEST(CsvFile, NamesDecimalCommasThatCannotBeTold) {
  expect_complaint(std::string(kPlain) + "30,0,20,5,180,0,25\n", "",
                   "line 2: found 7 fields, expected 5 (a decimal comma needs ; or a tab");
  expect_complaint("theta_i;phi_i;theta_o;phi_o;f\n30;0;20,5;180;0.25\n", "",
                   "line 2, column f: found 0.25, expected decimal points or decimal commas");
  expect_complaint("theta_i;phi_i;theta_o;phi_o;f\n30;0;20;180;1,000,000\n", "", "'1,000,000'");
}

TEST(CsvFile, OfUnknownColumnsNamesThemAndTheCommand) {
  const std::string said = complaint_of_columns("lambda,thetai,phir\n1,2,3\n");
  EXPECT_NE(said.find("line 1: found columns lambda, thetai, phir, expected theta_i"), said.npos)
      << said;
  EXPECT_NE(said.find("gonio columns FILE --map"), said.npos) << said;
  expect_complaint("1,2,3\n4,5,6\n", "", "found columns #1, #2, #3");
  expect_complaint("\xff\xfet", "", "byte 0: found text in UTF-16, expected UTF-8");
  const std::string utf16("t\0h\0e\0t\0a\0_\0i\0,\0", 16);
  expect_complaint(utf16, "", "byte 0: found text in UTF-16, expected UTF-8");
  expect_complaint(utf16, R"("f":"f")", "byte 0: found text in UTF-16, expected UTF-8");
}

TEST(CsvFile, RefusesAnglesThatCannotBe) {
  expect_complaint(std::string(kPlain) + "270,10,20,0,1\n", "", "perhaps columns are swapped");
  EXPECT_EQ(complaint_of_columns(std::string(kPlain) + "-10,10,20,0,1\n"), "") << "the other side";
  expect_complaint(std::string(kPlain) + "-270,10,20,0,1\n", R"("f":"f")", "[-180, 180] degrees");
  expect_complaint(std::string(kPlain) + "30,10,20,0,1\n", R"("unit":"radians")",
                   "column theta_i: found 30, expected a number in [-3.142, 3.142] radians");
  expect_complaint(std::string(kPlain) + "30,10,20,0,1\n120,10,20,0,1\n150,10,20,0,1\n", "",
                   "column theta_i: found 2 of 3 above 90°");
  EXPECT_EQ(complaint_of_columns(std::string(kPlain) + "30,10,20,0,1\n120,10,20,0,1\n"), "");
}

std::string warnings_of(const Table& t) {
  std::string all;
  for (const auto& w : t.warnings) all += w + "\n";
  return all;
}

TEST(CsvFile, OfTheLargestNumbersIsInspected) {
  // The sum of any two of these values is infinite.
  std::string text = "theta_i,phi_i,theta_o,phi_o,f_r,f_g\n";
  for (int in = 5; in <= 45; in += 5)
    for (int out = 0; out <= 80; ++out)
      text += std::to_string(in) + ",0," + std::to_string(out) + ",180," +
              (out == in ? "1.75e308,1.75e308\n" : "1.1e308,1.1e308\n");
  const Table t = read(text);
  const Health h = inspect(t);
  EXPECT_EQ(h.largest, 1.75e308);
  ASSERT_GT(h.peak_profiles, 0U);
  EXPECT_LT(h.peak_contrast, 2);
  EXPECT_FALSE(to_json(t, h).empty());
}

TEST(CsvFile, WarnsOfDegreesThatLookLikeRadians) {
  const std::string text = std::string(kPlain) + "0.5,0,0.6,3.14,1\n1.4,0,1.5,0,2\n";
  EXPECT_NE(warnings_of(read(text)).find("radians"), std::string::npos);
  EXPECT_EQ(warnings_of(read(text, R"("unit":"radians")")), "");
  EXPECT_EQ(warnings_of(read(text + "2,0,2,0,1\n")), "");
}

TEST(CsvFile, WarnsOfRadiansWhateverASignOrAConventionMakesOfAzimuths) {
  const std::string text = "theta_i,theta_o,f\n0.5,-0.5,5\n0.5,0.6,2\n";
  for (const char* map : {R"("f":"f")", R"("forward":0)", R"("phi_o":"180")"})
    EXPECT_NE(warnings_of(read(text, map)).find("--radians"), std::string::npos) << map;
  EXPECT_EQ(warnings_of(read(text, R"("unit":"radians")")), "");
}

TEST(CsvFile, WithoutAzimuthsIsReadInPlane) {
  const std::string text = "theta_i,theta_o,f\n30,-20,1\n30,20,0.5\n";
  EXPECT_EQ(samples(read(text)), (Lines{"30 0 20 180: 1", "30 0 20 0: 0.5"}));
  expect_complaint("theta_i,theta_o,phi_o,f\n30,20,0,1\n", "", "phi_i: found no such column");
  expect_complaint("theta_i,theta_o,f,x\n30,20,0,1\n", "", "an unknown column");
}

TEST(CsvFile, MasksValuesThatAreNotThere) {
  for (const char* gap : {"", "-", "NA", "n/a", "nan"}) {
    const Table t = read(std::string("theta_i,phi_i,theta_o,phi_o,f_a,f_b\n30,0,20,0,") + gap +
                         ",1\n30,0,40,0,2,3\n");
    EXPECT_EQ(inspect(t).masked[static_cast<std::size_t>(Mask::not_finite)], 1U) << gap;
    EXPECT_EQ(inspect(t).valid, 3U) << gap;
    expect_complaint(std::string(kPlain) + "30,0," + gap + ",0,1\n", "", "column theta_o");
  }
  EXPECT_EQ(read("10,20,NA\n10,30,1\n", R"("theta_i":"#1","theta_o":"#2","f":"#3")").size(), 2U)
      << "no line of names";
  expect_complaint(std::string(kPlain) + "30,0,20,0,none\n", "", "'none'");
}

TEST(CsvFile, FindsItsTableUnderLinesOfWords) {
  const std::string words = "Instrument 7\nWavelength: 633 nm, room 3, by night\n\n# at noon\n",
                    rows = "30,0,20,0,1\n30,0,40,0,1\n30,0,50,0,1\n";
  EXPECT_EQ(complaint_of_columns(words + kPlain + rows), "");
  EXPECT_EQ(
      read(words + "in,out,f\n30,20,1\n30,40,1\n", R"("theta_i":"in","theta_o":"out")").size(), 2U);
  EXPECT_EQ(read("Instrument 7\n" + rows, R"("theta_i":"#1","theta_o":"#3","f":"#5")").size(), 3U)
      << "without names";
  const Folder folder;
  folder.write("t.csv", words + "in,out,f\n30,20,1\n30,40,1\n30,50,1\n");
  InputFile in(folder / "t.csv");
  const auto columns = csv_columns(in);
  ASSERT_EQ(columns.size(), 3U);
  EXPECT_EQ(columns[1].name, "out");
  EXPECT_EQ(columns[1].highest, 50);
}

TEST(CsvFile, WhoseNamesAreMoreOrFewerThanItsNumbersIsNoTableUnderWords) {
  expect_complaint("theta_i,phi_i,theta_o,phi_o,f,weight\n30,0,20,0,1\n30,0,40,0,1\n30,0,50,0,1\n",
                   "", "line 2: found 5 fields");
  expect_complaint(std::string(kPlain) + "deg,deg,deg,deg,1/sr\n30,0,20,0,1\n30,0,40,0,1\n", "",
                   "line 2");
}

TEST(ColumnMap, OfAPatternTakesEveryColumnThatIsLikeIt) {
  const std::string text = "in,out,500 nm,450 nm,note\n30,20,1,2,7\n30,40,3,4,7\n";
  const Table t = read(text, R"("theta_i":"in","theta_o":"out","f_*":"* nm")");
  EXPECT_EQ(t.channels, (std::vector<std::string>{"500", "450"}));
  EXPECT_EQ(t.values[1][1], 4);
  expect_complaint(text, R"("theta_i":"in","theta_o":"out","f_*":"*um")", "no column like '*um'");
  expect_complaint("in,out,1nm,1 nm\n30,20,1,2\n", R"("theta_i":"in","theta_o":"out","f_*":"*nm")",
                   "two channels named 1");
}

TEST(ColumnMap, TakesAColumnForThePatternThatFixesMoreOfItsName) {
  const std::string text =
      "theta_i,theta_o,450nm,550nm,U450nm,U550nm\n30,20,0.5,0.7,0.02,0.04\n30,40,0.6,0.8,0.02,0."
      "04\n";
  for (const char* said : {R"("f_*":"*nm","U_f_*":"U*nm")", R"("U_f_*":"U*nm","f_*":"*nm")"}) {
    const Table t = read(text, said);
    EXPECT_EQ(t.channels, (std::vector<std::string>{"450", "550"}));
    EXPECT_EQ(t.values[1], (Values{0.7, 0.8}));
    ASSERT_EQ(t.errors.size(), 2U);
    EXPECT_EQ(t.errors[1], (Values{0.02, 0.02})) << "half of U";
  }
  expect_complaint(text, R"("f_*":"*50nm","U_f_*":"U*0nm")", "a column that is two things");
}

TEST(ColumnMap, OfManyPatternsMayNotMakeColumnsWithoutEnd) {
  std::string names = "theta_i,theta_o", row = "30,20";
  for (int k = 0; k < 4000; ++k) names += fmt::format(",{}nm", k), row += ",1";
  const auto patterns = [](int n) {
    std::string all = R"("f_*":"*nm")";
    for (int k = 1; k < n; ++k) all += fmt::format(R"(,"u_f_{}_*":"*nm")", k);
    return all;
  };
  const std::string text = names + "\n" + row + "\n";
  expect_complaint(text, patterns(65), "columns: found 65 patterns, expected at most 64");
  expect_complaint(text, patterns(64), "12000 columns by patterns, expected at most 8256");
}

TEST(ColumnMap, TakesUncertaintiesInPartsOfTheValue) {
  const std::string text = "in,out,a,b,s,t\n30,20,2,4,10,5\n30,40,1,0,10,5\n30,50,1,4,10,5\n",
                    angles = R"("theta_i":"in","theta_o":"out",)";
  const auto errors = [&](const std::string& map) { return read(text, angles + map).errors; };
  EXPECT_EQ(errors(R"("f":"a","u_percent":"s")")[0], (Values{0.2, 0.1, 0.1}));
  EXPECT_EQ(errors(R"("f":"a","U_percent":"s")")[0], (Values{0.1, 0.05, 0.05}));
  EXPECT_EQ(errors(R"("f":"a","u_rel":"0.25")")[0], (Values{0.5, 0.25, 0.25}));
  const auto two = errors(R"("f_a":"a","f_b":"b","u_percent_a":"s","u_percent_b":"t")");
  EXPECT_EQ(two[0][0], 0.2);
  EXPECT_EQ(two[1], (Values{0.2, 0.05 * 4e-3, 0.2})) << "nothing is not known for certain";
}

TEST(ColumnMap, LaysOutAMatrix) {
  const std::string map = R"("theta_o":"#1","theta_i":"header","phi_o":"180")";
  const Lines laid{"10 0 0 180: 1", "20 0 0 180: 2", "10 0 5 180: nan", "20 0 5 180: 4"};
  EXPECT_EQ(samples(read("x;10°;20°\n0;1;2\n5;-;4\n", map)), laid);
  EXPECT_EQ(samples(read(";10;20\n0;1;2\n5;-;4\n", map)), laid) << "no names";
  EXPECT_EQ(
      samples(read("x;0.5;-0.5\n1;1;2\n", R"("theta_i":"#1","theta_o":"header","unit":"radians")")),
      (Lines{"57.2958 0 28.6479 0: 1", "57.2958 0 28.6479 180: 2"}));
  const Table t =
      read("x;u;30;200\n10;0.5;1;2\n", R"("theta_o":"x","theta_i":"5","phi_o":"header","u_f":"u")");
  EXPECT_EQ(samples(t), (Lines{"5 0 10 30: 1", "5 0 10 200: 2"}));
  EXPECT_EQ(t.errors, (std::vector<Values>{{0.5, 0.5}}));
  expect_complaint("x;10;200\n0;1;2\n", map,
                   "column 200: found 200, expected a number in [-180, 180] in the header");
}

TEST(ColumnMap, TakesElevations) {
  const std::string both = R"("theta_i":"90-el","theta_o":"90-#2","f":"f")";
  EXPECT_EQ(samples(read("el,to,f\n30,80,1\n90,60,2\n", both)),
            (Lines{"60 0 10 0: 1", "0 0 30 0: 2"}));
  EXPECT_EQ(
      samples(read("el,to,f\n0,1,1\n", R"("theta_i":"90-el","theta_o":"to","unit":"radians")")),
      (Lines{"90 0 57.2958 0: 1"}));
  EXPECT_EQ(samples(read("90-el,to,f\n30,80,1\n", R"("theta_i":"90-el","theta_o":"to")")),
            (Lines{"30 0 80 0: 1"}))
      << "a column of that very name";
  expect_complaint("el,to,f\n30,80,1\n", R"("theta_i":"90-x","theta_o":"to")",
                   "no column 'x' for theta_i");
}

TEST(ColumnMap, TakesHalfAndDifferenceAngles) {
  const std::string map = R"("theta_h":"h","theta_d":"d","phi_d":"p","f":"f")";
  EXPECT_EQ(samples(read("h,d,p,f,theta_i\n0,30,0,1,7\n20,30,90,2,7\n", map))[0],
            "30 0 30 -180: 1");
  const Table t = read("h,d,p,f\n20,30,90,2\n80,60,0,1\n85,60,0,1\n", map);
  const auto a = SampleAngles(t)(0);
  EXPECT_NEAR(a.noh, std::cos(20 * degree), 1e-12);
  EXPECT_NEAR(a.voh, std::cos(30 * degree), 1e-12);
  EXPECT_NEAR(a.nol, a.nov, 1e-12) << "phi_d 90°";
  EXPECT_EQ(inspect(t).masked[static_cast<std::size_t>(Mask::below_horizon)], 2U);
}

TEST(CsvFile, WarnsOfSwappedColumns) {
  std::string text = kPlain;
  for (int phi = 0; phi < 180; phi += 10)
    for (int theta = 0; theta < 90; theta += 30)
      text += "30,0," + std::to_string(phi) + "," + std::to_string(theta) + ",1\n";
  EXPECT_NE(warnings_of(read(text)).find("theta_o goes far beyond 90°"), std::string::npos);
}

TEST(CsvFile, WarnsWhereTheMirrorSeemsToBeOnTheLightsSide) {
  const std::string text = "theta_i,theta_o,f\n45,-45,0.1\n45,0,0.2\n45,45,5\n";
  EXPECT_NE(warnings_of(read(text, R"("f":"f")")).find("--forward 0"), std::string::npos);
  EXPECT_EQ(warnings_of(read(text, R"("forward":0)")), "");
  const std::string other = "theta_i,theta_o,f\n45,-45,5\n45,0,0.2\n45,45,0.1\n";
  EXPECT_NE(warnings_of(read(other, R"("forward":0)")).find("--forward 180)"), std::string::npos)
      << "the other one, not the one given";
}

/// Samples over the hemisphere, every 10°, as a CSV of value(theta_i, theta_o).
template <class F>
std::string hemispheres(F value) {
  std::string text = kPlain;
  for (int in = 10; in < 90; in += 10)
    for (int out = 0; out < 90; out += 10)
      for (int phi = 0; phi < (out == 0 ? 1 : 360); phi += 10)
        text += std::to_string(in) + ",0," + std::to_string(out) + "," + std::to_string(phi) + "," +
                std::to_string(value(in * degree, out * degree)) + "\n";
  return text;
}

std::string health_warnings(const Table& t) {
  std::string all;
  for (const auto& w : inspect(t).warnings) all += w + "\n";
  return all;
}

TEST(CsvFile, WarnsOfMoreLightThanArrives) {
  const auto even = [](double f) { return hemispheres([f](double, double) { return f; }); };
  const Table t = read(even(0.9));
  EXPECT_NE(health_warnings(t).find("returns 2.83 times"), std::string::npos) << health_warnings(t);
  EXPECT_NE(health_warnings(t).find("--scale 0.3183099"), std::string::npos);
  EXPECT_NE(to_json(t, inspect(t)).find("--scale 0.3183099"), std::string::npos);
  EXPECT_EQ(health_warnings(read(even(0.31))), "");
  Table other = t;
  other.format = "alta";
  EXPECT_NE(health_warnings(other).find("(gonio convert "), std::string::npos)
      << "other formats become CSV first";
}

TEST(CsvFile, WarnsOfACosineLeftInTheValues) {
  const Table t = read(hemispheres([](double, double out) { return 0.2 * std::cos(out); }));
  EXPECT_NE(health_warnings(t).find("--cosine"), std::string::npos);
  EXPECT_EQ(health_warnings(read(hemispheres([](double, double) { return 0.2; }))), "");
  const auto otherwise = health_warnings(
      read(hemispheres([](double in, double out) { return 0.1 * (in + 0.2) / (out + 1); })));
  EXPECT_EQ(otherwise.find("cos"), std::string::npos) << "reciprocity is broken otherwise";
  EXPECT_TRUE(otherwise.starts_with("exchanging the directions changes values by")) << otherwise;
}

TEST(NumberIn, TakesTheWholeFieldOrNothing) {
  EXPECT_EQ(number_in("1e-3"), 1e-3);
  EXPECT_EQ(number_in("-1,5"), -1.5);
  EXPECT_TRUE(std::isnan(number_in("nan").value()));
  for (const char* no : {"", "1,5.0", "1.5x", "1,2,3", " 1", "--1", "1e999", ","})
    EXPECT_FALSE(number_in(no)) << no;
  EXPECT_FALSE(number_in("1," + std::string(100, '0')));
}

TEST(NistPtfe, IsReadByItsMapAndIntegratesToItsReflectance) {
  GONIO_NEEDS_SHARED(file, "data/nist_ptfe/PTFE.data.csv");
  const Table t = read(read_bytes(file),
                       R"("theta_i":"thetai","phi_i":"phi","theta_o":"thetar","phi_o":"phir",)"
                       R"("f":"f_r11","channel":"lambda")");
  EXPECT_EQ(t.channels, (Lines{"0.351", "0.532", "0.633", "1.064"}));
  EXPECT_EQ(t.size(), 1824U);
  EXPECT_EQ(warnings_of(t), "");
  const Health h = inspect(t);
  EXPECT_EQ(h.valid, 7296U);
  ASSERT_EQ(h.albedo.size(), 6U);
  EXPECT_NEAR(h.albedo[0].albedo[1], 0.986, 0.003);
  EXPECT_GT(h.albedo[0].coverage, 0.95);
}

TEST(StarlinkChassis, IsReadByItsMap) {
  GONIO_NEEDS_SHARED(file, "data/starlink/chassis_brdf.csv");
  const Table t = read(read_bytes(file),
                       R"("theta_i":"phi_i","phi_i":"theta_i","theta_o":"phi_o","phi_o":"theta_o",)"
                       R"("f":"brdf")");
  ASSERT_EQ(t.size(), 724U);
  EXPECT_EQ(warnings_of(t), "");
  const auto peak =
      static_cast<std::size_t>(std::ranges::max_element(t.values[0]) - t.values[0].begin());
  EXPECT_NEAR(t.values[0][peak], 8038.03, 0.01);
  EXPECT_NEAR(SampleAngles(t)(peak).sin2_theta_h, 0, 1e-20) << "the mirror direction";
}

}  // namespace
}  // namespace gonio
