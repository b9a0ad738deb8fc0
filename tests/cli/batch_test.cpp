// gonio fit of many tables.
#include <map>
#include <numbers>
#include <set>

#include "cli/many_tables.h"
#include "cli/program.h"

#include <fmt/format.h>
#include <sys/stat.h>

namespace gonio::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

TEST(Batch, FinishesAThousandFilesOfWhichATenthIsBroken) {
#ifdef __SANITIZE_ADDRESS__
  constexpr int files = 200;
#else
  constexpr int files = 1000;
#endif
  const Folder f;
  fs::create_directory(f / "in");
  fs::create_directory(f / "in/a folder in between");
  f.write("in/t0.csv.gonio.json", "no side file of any table that is fitted well");
  std::map<std::string, double> kd;
  std::set<std::string> broken{"in/t0.csv"};
  f.write("in/t0.csv", diffuse(0.1, 0.2));
  const std::string whole = diffuse(0.1, 0.2);
  const std::vector<std::string> bytes{"",
                                       std::string("\0\1\2\3garbage\xff", 12),
                                       whole.substr(0, 20),
                                       whole.substr(0, 30),
                                       whole.substr(0, whole.size() - 10),
                                       "theta_i,theta_i,theta_o,phi_o,f\n0,0,0,0,1\n",
                                       "theta_i,phi_i,theta_o,phi_o,f\n0,0,0,0,nan\n5,0,0,0,-inf\n",
                                       "theta_i,phi_i,theta_o,phi_o,f\n0,0,0,0,-1\n",
                                       "NVIDIA ARC MBSDF V1\nMBSDF_DATA_REFLECTION=\n\1"};
  for (int i = 1; i < files; ++i) {
    const std::string name = fmt::format("in/t{}.csv", i);
    if (i % 10 != 0) {
      const double a = 0.05 + 0.2 * i / files, b = a * (1 + 0.1 * (i % 7));
      f.write(name, diffuse(a, b));
      kd[name] = std::numbers::pi * std::sqrt(a * b);
      continue;
    }
    broken.insert(name);
    const auto kind = static_cast<std::size_t>(i / 10) % (bytes.size() + 3);
    if (kind < bytes.size())
      f.write(name, bytes[kind]);
    else if (kind == bytes.size())
      ASSERT_EQ(::mkfifo((f / name).c_str(), 0600), 0);
    else
      fs::create_symlink(kind == bytes.size() + 1 ? "nothing" : fs::path(f / name), f / name);
  }
  const auto o = gonio(f, "fit in --model lambert -o out --json");
  EXPECT_EQ(o.code, 3);
  EXPECT_EQ(o.err, "");
  const json batch = o.json();
  EXPECT_EQ(batch["counts"]["ok"], kd.size());
  EXPECT_EQ(batch["counts"]["bad_input"], broken.size());
  const auto rows = by_path(batch);
  ASSERT_EQ(rows.size(), static_cast<std::size_t>(files));
  for (const auto& [path, expected] : kd) {
    const json& row = rows.at(path);
    ASSERT_EQ(row["status"], "ok") << row;
    EXPECT_NEAR(row["parameters"]["kd"]["value"], expected, 1e-6 * expected);
  }
  for (const auto& path : broken) {
    const json& row = rows.at(path);
    EXPECT_EQ(row["exit_code"], 3) << row;
    EXPECT_TRUE(row["document"].is_null());
    EXPECT_TRUE(row["message"].get<std::string>().starts_with(path)) << row;
  }
  for (int i = 10; i <= 120; i += 10) {  // one of each kind
    const std::string path = fmt::format("in/t{}.csv", i);
    const auto alone = gonio(f, "fit " + path + " --model lambert");
    EXPECT_EQ("gonio: " + rows.at(path)["message"].get<std::string>() + "\n", alone.err);
  }
  for (int i = 1; i < files; i += files / 10) {
    const std::string name = fmt::format("t{}", i);
    ASSERT_EQ(gonio(f, "fit in/" + name + ".csv --model lambert -o alone.json").code, 0);
    json in_batch = document(f / ("out/" + name + ".json"));
    in_batch.erase("batch");
    EXPECT_EQ(in_batch, document(f / "alone.json"));
  }
  EXPECT_EQ(names_in(f / "out").size(), rows.size() + 4)
      << "a document of each, the list, the summary, no remains";
  const std::string csv = read_bytes(f / "out/summary.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), files + 1);
  EXPECT_LT(fs::file_size(f / "out/summary.html"), 10'000'000U);
}

TEST(Batch, GivesTheSameResultsWhateverTheThreads) {
  const Folder f;
  for (int i = 0; i < 6; ++i) f.write(fmt::format("g{}.csv", i), glossy(0.001 + 0.01 * i));
  f.write("broken.csv", "theta_i");
  for (const char* jobs : {"1", "3"})
    EXPECT_EQ(gonio(f, fmt::format("fit *.csv --jobs {0} -o r{0}", jobs)).code, 3);
  EXPECT_EQ(read_bytes(f / "r1/summary.csv"), read_bytes(f / "r3/summary.csv"));
  const auto names = names_in(f / "r1");
  EXPECT_EQ(names, names_in(f / "r3"));
  EXPECT_EQ(names.size(), 11U);
  for (int i = 0; i < 6; ++i)
    EXPECT_EQ(document(f / fmt::format("r1/g{}.json", i)),
              document(f / fmt::format("r3/g{}.json", i)));
}

TEST(Batch, FitsAgainOnlyWhatHasChanged) {
  const Folder f;
  fs::create_directory(f / "in");
  for (const char* name : {"a", "b", "c"})
    f.write(fmt::format("in/{}.csv", name), diffuse(0.1, 0.2));
  const auto long_ago = fs::file_time_type::clock::now() - std::chrono::hours(1);
  /// Runs and names the documents that were written.
  const auto written = [&](const std::string& options, int code = 0) {
    for (const char* name : {"a", "b", "c"})
      if (const auto path = f / fmt::format("out/{}.json", name); fs::exists(path))
        fs::last_write_time(path, long_ago);
    EXPECT_EQ(gonio(f, "fit in -o out --model lambert " + options).code, code);
    std::string names;
    for (const char* name : {"a", "b", "c"})
      if (const auto path = f / fmt::format("out/{}.json", name);
          fs::exists(path) && fs::last_write_time(path) > long_ago + std::chrono::minutes(1))
        names += name;
    return names;
  };
  EXPECT_EQ(written(""), "abc");
  const std::string csv = read_bytes(f / "out/summary.csv");
  const json page = json::parse(read_bytes(f / "out/summary.page.json"));
  EXPECT_EQ(written(""), "");
  EXPECT_EQ(read_bytes(f / "out/summary.csv"), csv);
  EXPECT_EQ(json::parse(read_bytes(f / "out/summary.page.json")), page);
  f.write("in/b.csv", diffuse(0.1, 0.3));
  EXPECT_EQ(written(""), "b");
  EXPECT_EQ(written("--metric relative"), "abc");
  EXPECT_EQ(written("--metric relative"), "");
  f.write("in/c.csv.gonio.json", R"({"schema": "gonio.table/1", "notes": {"by": "hand"}})");
  EXPECT_EQ(written("--metric relative"), "c");
  f.write("out/a.json", R"({"schema": "gonio.fit/1", "mo)");
  EXPECT_EQ(written("--metric relative"), "a");
  f.write("in/a.csv", "theta_i");
  EXPECT_EQ(written("--metric relative", 3), "a");
  EXPECT_EQ(document(f / "out/a.json")["schema"], "gonio.failure/1")
      << "not of bytes that are gone";
  EXPECT_EQ(written("--metric relative", 3), "a") << "it is tried again";
}

TEST(Batch, KilledAndStartedAgainItEndsAsIfNothingHadHappened) {
  const Folder f;
  fs::create_directory(f / "in");
  for (int i = 0; i < 12; ++i) f.write(fmt::format("in/g{}.csv", i), glossy(0.001 + 0.01 * i));
  ASSERT_EQ(gonio(f, "fit in -o whole").code, 0);
  for (const char* after : {"0.02", "0.05", "0.1", "0.2"}) {
    gonio(f, "fit in -o out", std::string("timeout -s KILL ") + after + " ");
    if (!fs::exists(f / "out")) continue;
    for (const auto& name : names_in(f / "out"))
      if (name.starts_with('g')) {
        EXPECT_EQ(document(f / ("out/" + name)), document(f / ("whole/" + name)));
      }
  }
  gonio(f, "fit in -o polite", "timeout -s TERM 0.1 ");
  fs::create_directory(f / "polite");  // if it did not come so far
  for (const auto& name : names_in(f / "polite")) EXPECT_FALSE(name.starts_with('.')) << name;
  ASSERT_EQ(gonio(f, "fit in -o out").code, 0);
  EXPECT_EQ(read_bytes(f / "out/summary.csv"), read_bytes(f / "whole/summary.csv"));
  for (const auto& name : names_in(f / "whole"))
    if (name.starts_with('g')) {
      EXPECT_EQ(document(f / ("out/" + name)), document(f / ("whole/" + name)));
    }
}

TEST(Batch, NamesDocumentsAfterTheirTablesAndNoTwoAlike) {
  const Folder f;
  for (const char* folder : {"a", "b"}) {
    fs::create_directory(f / folder);
    f.write(fmt::format("{}/x.csv", folder), diffuse(0.1, 0.2));
  }
  f.write("x.txt", diffuse(0.1, 0.2));
  f.write("y.csv", diffuse(0.1, 0.2));
  f.write("summary.page.csv", diffuse(0.1, 0.2));
  f.write("list.txt", "a/x.csv\r\n\nb/x.csv\nx.txt\n");
  const auto o =
      gonio(f, "fit @list.txt y.csv summary.page.csv --model lambert -o deep/out --json");
  ASSERT_EQ(o.code, 0) << o.err;
  std::vector<std::string> names;
  const json batch = o.json();
  for (const auto& t : batch["tables"]) names.push_back(t["document"]);
  EXPECT_EQ(names, (std::vector<std::string>{"x.csv.json", "x.csv-2.json", "x.txt.json", "y.json",
                                             "summary.page-2.json"}));
  for (const auto& n : names) EXPECT_TRUE(fs::exists(f / ("deep/out/" + n))) << n;
}

TEST(Batch, RefusesACallThatCannotBeMeant) {
  const Folder f;
  fs::create_directory(f / "in");
  fs::create_directory(f / "empty");
  f.write("in/a.csv", diffuse(0.1, 0.2));
  f.write("b.csv", diffuse(0.1, 0.2));
  f.write("list", "in/a.csv\n");
  f.write("summary.csv", diffuse(0.1, 0.2));
  const std::size_t before = f.entries();
  expect_one_line_each(f, 2,
                       {{"fit in", "-o DIR"},
                        {"fit in b.csv", "-o DIR"},
                        {"fit in -o in", "results go elsewhere"},
                        {"fit in -o ./in/", "results go elsewhere"},
                        {"fit in -o out --html p.html", "summary.html"},
                        {"fit in -o out --model lambertt", "lambert"},
                        {"fit in -o out --fix gamma=2", "no parameter 'gamma'"},
                        {"fit in -o out --bounds alpha=0.5,0.1", "the lower first"},
                        {"fit b.csv summary.csv -o .", "is an input"}});
  expect_one_line_each(f, 3,
                       {{"fit empty -o out", "no files"},
                        {"fit @nothing -o out", "nothing: opening"},
                        {"fit @empty -o out", "a directory"},
                        {"fit in -o b.csv", "b.csv"},
                        {"fit in -o b.csv/out", "b.csv/out"}});
  EXPECT_EQ(f.entries(), before);
}

TEST(Batch, AListOfTooManyBytesIsRefusedBeforeItIsRead) {
  const Folder f;
  f.write("list", "a.csv\n");
  fs::resize_file(f / "list", (1U << 26) + 1);
  expect_one_line(gonio(f, "fit @list -o out"), 3, "list: byte 0: found 67108865 bytes");
}

TEST(Batch, AnInputThatCannotBeLookedUpIsOneThatCannotBeRead) {
  const Folder f;
  f.write("a.csv", diffuse(0.1, 0.2));
  const std::string longest(300, 'x');
  const auto o = gonio(f, "fit a.csv " + longest + ".csv --model lambert -o out --json");
  EXPECT_EQ(o.code, 3) << o.err;
  auto rows = by_path(o.json());
  EXPECT_EQ(rows["a.csv"]["status"], "ok");
  EXPECT_EQ(rows[longest + ".csv"]["status"], "bad_input");
}

TEST(Batch, AnInputThatIsNotThereIsNamedBeforeTheOutput) {
  const Folder f;
  f.write("a.csv", diffuse(0.1, 0.2));
  for (const char* words :
       {"fit tables/ -o results/", "fit tables/ a.csv -o a.csv/out",
        "fit tables -o no/such/place.json", "inspect tables/ --html no/such/page.html",
        "convert tables/ no/such/b.csv"})
    expect_one_line(gonio(f, words), 3, "gonio: tables");
  EXPECT_FALSE(fs::exists(f / "results"));
}

TEST(Batch, NoCellOfTheSummaryIsAFormula) {
  const Folder f;
  f.write("=1+1.csv", diffuse(0.1, 0.2));
  f.write("b.csv", "theta_i");
  EXPECT_EQ(gonio(f, "fit ./=1+1.csv =1+1.csv b.csv --model lambert -o out").code, 3);
  const std::string csv = read_bytes(f / "out/summary.csv");
  EXPECT_NE(csv.find("\n./=1+1.csv,"), csv.npos) << csv;
  EXPECT_NE(csv.find("\n\"'=1+1.csv\","), csv.npos) << csv;
}

TEST(Batch, TellsOptionsThatDoNotSuitATableFromABadTable) {
  const Folder f;
  f.write("one.csv", diffuse(0.1, 0.2));
  f.write("three.csv",
          "theta_i,phi_i,theta_o,phi_o,f_r,f_g,f_b\n0,0,10,0,1,2,3\n30,0,10,0,1,2,3\n");
  const auto o =
      gonio(f, "fit one.csv three.csv --model lambert --fix kd=0.1,0.2,0.3 -o out --json");
  EXPECT_EQ(o.code, 2);
  const auto rows = by_path(o.json());
  EXPECT_EQ(rows.at("one.csv")["status"], "wrong_usage");
  EXPECT_EQ(rows.at("three.csv")["status"], "ok");
}

TEST(Batch, ADiskThatIsFullEndsIt) {
  const Folder f;
  for (const char* name : {"a.csv", "b.csv"}) f.write(name, diffuse(0.1, 0.2));
  const auto o = gonio(f, "fit a.csv b.csv --model lambert -o out", "ulimit -f 2; ");
  expect_one_line(o, 3, "File too large");
  EXPECT_EQ(names_in(f / "out"), std::set<std::string>{"summary.list.json"});
  EXPECT_EQ(gonio(f, "fit a.csv b.csv --model lambert -o out").code, 0);
}

}  // namespace
}  // namespace gonio::test
