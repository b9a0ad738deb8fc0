#include "fitting/batch/gather.h"

#include <chrono>
#include <filesystem>
#include <set>
#include <thread>

#include "base/file.h"
#include "fitting/batch/batch.h"
#include "refusal.h"
#include "refused_locks.h"
#include "support.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Names = std::vector<std::string>;

std::string table(double f) {
  std::string csv = "theta_i,phi_i,theta_o,phi_o,f\n";
  for (int i = 0; i < 80; i += 10)
    csv += std::to_string(i) + ",0,30,180," + std::to_string(f) + "\n";
  return csv;
}

/// Tables a.csv to d.csv in a folder, the last of them broken, and results beside them.
struct Tables {
  Tables() {
    for (const char* name : {"a.csv", "b.csv", "c.csv"})
      paths.push_back(f.write(name, table(0.1 + 0.1 * static_cast<double>(paths.size()))));
    paths.push_back(f.write("d.csv", "theta_i"));
  }
  BatchResult fit(const Names& of,
                  std::optional<Part> part = {},
                  const char* metric = "log") const {
    Batch b{of, out, {}, part};
    b.how.options.model = "lambert";
    b.how.options.metric = value_of<Metric>(metric, "metric");
    return fit_batch(b);
  }
  test::Folder f;
  Names paths;
  std::string out = f / "out";
};

Names paths_of(const BatchSummary& s) {
  Names all;
  for (const auto& r : s.rows) all.push_back(r.path);
  return all;
}
Names left_out(const BatchSummary& s, LeftOut why) {
  Names all;
  for (const auto& d : s.left_out)
    if (d.why == why) all.push_back(d.document);
  return all;
}

TEST(Gather, OfPartsMakesTheSummaryThatOneProcessMakes) {
  const Tables t;
  t.fit(t.paths);
  const std::string csv = test::read_bytes(t.out + "/summary.csv");
  fs::remove_all(t.out);
  for (const std::size_t k : {2, 3, 1}) t.fit(t.paths, Part{k, 3});
  EXPECT_FALSE(fs::exists(t.out + "/summary.csv")) << "a part knows of its own tables alone";
  const auto s = gather(t.out, read_list(t.out), {});
  EXPECT_EQ(test::read_bytes(t.out + "/summary.csv"), csv);
  EXPECT_EQ(s.outcome(), Exit::bad_input) << "of the broken table";
  EXPECT_EQ(s.missing, Names{});
  EXPECT_TRUE(s.left_out.empty());
}

TEST(Gather, NamesTheTablesThatNobodyTried) {
  const Tables t;
  t.fit(t.paths, Part{1, 2});
  const auto s = gather(t.out, read_list(t.out), {});
  EXPECT_EQ(paths_of(s), (Names{t.paths[0], t.paths[2]}));
  EXPECT_EQ(s.missing, (Names{t.paths[1], t.paths[3]}));
  EXPECT_EQ(s.outcome(), Exit::check_failed);
  const json page = json::parse(test::read_bytes(t.out + "/summary.page.json"));
  EXPECT_EQ(page["missing"], (json{t.paths[1], t.paths[3]}));
}

TEST(Gather, KnowsWithoutAListWhatLiesThere) {
  const Tables t;
  t.fit(t.paths, Part{1, 2});
  const auto s = gather(t.out, {}, {});
  EXPECT_EQ(paths_of(s), (Names{t.paths[0], t.paths[2]}));
  EXPECT_EQ(s.made_with, read_list(t.out)->made_with);
  EXPECT_EQ(s.missing, Names{});
}

TEST(Gather, WithoutAListTakesTheUsualWayAlthoughTheFirstDocumentWasMadeOtherwise) {
  const Tables t;
  t.fit({t.paths[1], t.paths[2]});
  t.fit({t.paths[0]}, {}, "relative");
  fs::remove(t.out + "/summary.list.json");
  const auto s = gather(t.out, {}, {});
  ASSERT_EQ(paths_of(s), (Names{t.paths[1], t.paths[2]}));
  for (const auto& r : s.rows) EXPECT_TRUE(r.fit && r.preview) << "it is read once more";
  ASSERT_EQ(left_out(s, LeftOut::made_otherwise), Names{"a.json"});
  EXPECT_EQ(s.left_out[0].path, t.paths[0]);
}

TEST(Gather, OfDocumentsMadeInTwoWaysTakesThoseThatTheListAsksFor) {
  const Tables t;
  t.fit({t.paths[0], t.paths[1]});
  t.fit({t.paths[2], t.paths[1]}, Part{1, 2}, "relative");
  auto s = gather(t.out, read_list(t.out), {});
  EXPECT_EQ(paths_of(s), Names{t.paths[2]});
  EXPECT_EQ(s.missing, Names{t.paths[1]}) << "its document is of other options";
  ASSERT_EQ(left_out(s, LeftOut::made_otherwise), (Names{"a.json", "b.json"}));
  EXPECT_HAS(s.left_out[0].made_with, "metric log");
  EXPECT_EQ(s.left_out[0].path, t.paths[0]);
  s = gather(t.out, {}, {});
  EXPECT_EQ(paths_of(s), (Names{t.paths[0], t.paths[1]})) << "without a list the way of most";
}

TEST(Gather, TakesTheNewerOfTwoDocumentsOfATableAndTellsTheOther) {
  const Tables t;
  t.fit({t.paths[0]});
  fs::copy_file(t.out + "/a.json", t.out + "/older.json");
  fs::last_write_time(t.out + "/older.json",
                      fs::last_write_time(t.out + "/a.json") - std::chrono::seconds(9));
  auto s = gather(t.out, {}, {});
  ASSERT_EQ(s.rows.size(), 1U);
  EXPECT_EQ(s.rows[0].document, "a.json");
  EXPECT_EQ(left_out(s, LeftOut::another_of_its_table), Names{"older.json"});
  fs::rename(t.out + "/older.json", t.out + "/newer.json");
  fs::last_write_time(t.out + "/newer.json",
                      fs::last_write_time(t.out + "/a.json") + std::chrono::seconds(9));
  EXPECT_EQ(gather(t.out, {}, {}).rows[0].document, "newer.json");
  s = gather(t.out, read_list(t.out), {});
  EXPECT_EQ(s.rows[0].document, "a.json") << "the name that the list gives it";
  EXPECT_EQ(left_out(s, LeftOut::another_of_its_table), Names{"newer.json"});
}

TEST(Gather, FindsTheDocumentOfATableThatTheListNamesOtherwise) {
  const Tables t;
  t.fit({t.paths[0]});
  fs::create_directory(t.f / "other");
  const auto twin = t.f.write("other/a.csv", table(0.4));
  auto list = *read_list(t.out);
  list.tables = {twin, t.paths[0]};
  const auto s = gather(t.out, list, {});
  ASSERT_EQ(paths_of(s), Names{t.paths[0]});
  EXPECT_EQ(s.rows[0].document, "a.json");
  EXPECT_EQ(s.missing, Names{twin});
}

TEST(Gather, TellsADocumentThatCannotBeReadAndLeavesOthersFilesAlone) {
  const Tables t;
  t.fit({t.paths[0], t.paths[1]});
  t.f.write("out/a.json", "half a docum");
  t.f.write("out/notes.json", R"({"by": "hand"})");
  t.f.write("out/tile_0_0.exr", "no document");
  fs::create_directory(t.out + "/folder.json");
  const auto s = gather(t.out, read_list(t.out), {});
  EXPECT_EQ(paths_of(s), Names{t.paths[1]});
  EXPECT_EQ(s.missing, Names{t.paths[0]});
  ASSERT_EQ(left_out(s, LeftOut::unreadable), Names{"a.json"});
  EXPECT_HAS(s.left_out[0].message, "a.json: ");
  EXPECT_EQ(test::read_bytes(t.out + "/notes.json"), R"({"by": "hand"})");
}

TEST(Gather, ReadsNoDocumentThroughALinkOutOfItsFolder) {
  const Tables t;
  t.fit({t.paths[0], t.paths[1]});
  t.f.write("secret.txt", "my password");
  fs::create_symlink("../secret.txt", t.out + "/linked.json");
  fs::create_symlink("a.json", t.out + "/again.json");
  const auto s = gather(t.out, read_list(t.out), {});
  ASSERT_EQ(left_out(s, LeftOut::unreadable), Names{"linked.json"});
  for (const auto& d : s.left_out) EXPECT_EQ(d.message.find("password"), d.message.npos);
  EXPECT_EQ(left_out(s, LeftOut::another_of_its_table), Names{"again.json"});
}

TEST(Gather, ReplacesNoSummaryOfSomebodyElse) {
  const Tables t;
  t.fit({t.paths[0]});
  for (const char* name : {"summary.csv", "summary.html", "summary.page.json"}) {
    const test::Folder other;
    fs::copy(t.out + "/a.json", other / "a.json");
    other.write(name, "my notes");
    EXPECT_HAS(test::refusal([&] {
                 gather(other / "", {}, [](const BatchSummary&, const std::string&) {
                   return std::string("page");
                 });
               }),
               "a file that no batch made");
    EXPECT_EQ(test::read_bytes(other / name), "my notes");
  }
}

TEST(Gather, ReadsNoCurveWithoutOneValueForEachPlace) {
  for (const char* list : {"data", "model"})
    for (const bool longer : {false, true}) {
      const Tables t;
      t.fit({t.paths[0]});
      auto document = json::parse(test::read_bytes(t.out + "/a.json"));
      auto& row = document["batch"]["preview"]["curve"][list][0];
      if (longer)
        row.push_back(1);
      else
        row = json::array();
      t.f.write("out/a.json", document.dump());
      const auto s = gather(t.out, {}, {});
      ASSERT_EQ(s.left_out.size(), 1) << list << longer;
      EXPECT_HAS(s.left_out[0].message, std::string("/batch/preview/curve/") + list);
    }
}

TEST(Gather, ASideFileIsNoOtherWayOfMakingIt) {
  const Tables t;
  t.f.write("b.csv.gonio.json", R"({"schema": "gonio.table/1", "notes": {"by": "hand"}})");
  t.fit({t.paths[0], t.paths[1]}, Part{1, 1});
  const auto s = gather(t.out, read_list(t.out), {});
  EXPECT_EQ(paths_of(s), (Names{t.paths[0], t.paths[1]}));
  EXPECT_TRUE(s.left_out.empty());
}

/// Of what is refused unread no digest is made.
TEST(Gather, ASideFileThatIsTooLongHasNoName) {
  const Tables t;
  fs::resize_file(t.f.write("b.csv.gonio.json", "{}"), (std::size_t{1} << 24) + 1);
  EXPECT_HAS(test::refusal([&] { with_side_file("made", t.f / "b.csv"); }),
             "expected at most 16777216");
}

TEST(Gather, APathThatIsNoTextIsFoundAgain) {
  const Tables t;
  const auto odd = t.f.write("odd \xff.csv", table(0.1));
  t.fit({odd, t.paths[0]}, Part{1, 1});
  auto list = *read_list(t.out);
  list.tables = {odd, t.paths[0]};
  EXPECT_EQ(paths_of(gather(t.out, list, {})), list.tables);
}

TEST(Gather, LinksThePagesOfTables) {
  const Tables t;
  Batch b{{t.paths[0], t.paths[1]}, t.out, {}, Part{1, 1}};
  b.how.options.model = "lambert";
  BatchHooks hooks;
  hooks.table_page = [](const FittedFile&) { return std::string("page"); };
  fit_batch(b, hooks);
  fs::last_write_time(t.out + "/b.fit.html",
                      fs::last_write_time(t.out + "/b.json") - std::chrono::seconds(1));
  const auto s = gather(t.out, read_list(t.out), {});
  EXPECT_EQ(s.rows[0].page, "a.fit.html");
  EXPECT_EQ(s.rows[1].page, "") << "a page of an earlier fit";
}

TEST(Gather, AListThatIsNotWholeIsNone) {
  const Tables t;
  t.fit({t.paths[0]});
  for (const char* text : {"", "{", "[]", "{}", R"({"schema": "gonio.list/1"})",
                           R"({"schema": "gonio.list/2", "made_with": "x", "tables": []})",
                           R"({"schema": "gonio.list/1", "made_with": "x", "tables": [3]})"}) {
    t.f.write("out/summary.list.json", text);
    EXPECT_FALSE(read_list(t.out)) << text;
  }
}

TEST(Gather, RefusesAFolderWithNothingOfABatch) {
  const Tables t;
  EXPECT_HAS(test::refusal([&] { gather(t.out, {}, {}); }), "out: opening");
  fs::create_directory(t.out);
  t.f.write("out/notes.json", "{}");
  EXPECT_HAS(test::refusal([&] { gather(t.out, {}, {}); }), "found no result of a fit");
  EXPECT_FALSE(fs::exists(t.out + "/summary.csv"));
}

TEST(Gather, NamesItsPageAfterTheFolder) {
  const Tables t;
  t.fit({t.paths[0]});
  const std::string own = R"(<meta name="generator" content="gonio">)";
  const SummaryPage title = [&](const BatchSummary&, const std::string& name) {
    return own + name;
  };
  for (const char* ending : {"", "/", "/."}) {
    gather(t.out + ending, {}, title);
    EXPECT_EQ(test::read_bytes(t.out + "/summary.html"), own + "out") << ending;
  }
}

TEST(Gather, DoesNotWaitForTheLockThatItHas) {
  const Tables t;
  t.fit({t.paths[0], t.paths[1]});
  test::refused_locks = 0;
  gather(t.out, {}, {});
  EXPECT_EQ(test::refused_locks, 0);
}

TEST(Batch, AtOnceWithAnotherOfOtherTablesTheSummaryKnowsBoth) {
  const Tables t;
  for (int k = 0; k < 8; ++k) {
    fs::remove_all(t.out);
    std::thread other([&] { t.fit({t.paths[0], t.paths[3]}); });
    t.fit({t.paths[1], t.paths[2]});
    other.join();
    const json page = json::parse(test::read_bytes(t.out + "/summary.page.json"));
    std::set<std::string> paths;
    for (const auto& row : page["tables"]) paths.insert(row["path"]);
    EXPECT_EQ(paths, (std::set<std::string>(t.paths.begin(), t.paths.end())));
    EXPECT_EQ(page["tables"].size(), 4U) << "nothing double";
  }
}

TEST(Batch, AfterAnotherOfOtherTablesTellsOnlyItsOwnAndSumsUpAll) {
  const Tables t;
  t.fit({t.paths[0], t.paths[3]});
  const auto r = t.fit({t.paths[2], t.paths[1]});
  EXPECT_EQ(paths_of(r), (Names{t.paths[2], t.paths[1]}));
  EXPECT_EQ(r.others, 2U);
  EXPECT_EQ(r.outcome(), Exit::done) << "the broken one is the other's";
  const json page = json::parse(test::read_bytes(t.out + "/summary.page.json"));
  Names paths;
  for (const auto& row : page["tables"]) paths.push_back(row["path"]);
  EXPECT_EQ(paths, (Names{t.paths[2], t.paths[1], t.paths[0], t.paths[3]}));
}

TEST(Batch, OfATableThatIsNamedTwiceFitsItOnce) {
  const Tables t;
  const auto r = t.fit({t.paths[1], t.paths[0], t.paths[1]});
  ASSERT_EQ(paths_of(r), (Names{t.paths[1], t.paths[0]}));
  EXPECT_EQ(r.rows[0].document, "b.json");
}

TEST(Batch, InPartsHasTheNamesOfTheWholeList) {
  const Tables t;
  fs::create_directory(t.f / "other");
  const auto twin = t.f.write("other/a.csv", table(0.4));
  const Names both{t.paths[0], twin};
  const auto second = t.fit(both, Part{2, 2}), first = t.fit(both, Part{1, 2});
  ASSERT_EQ(paths_of(second), Names{twin});
  ASSERT_EQ(paths_of(first), Names{t.paths[0]});
  EXPECT_EQ(second.rows[0].document, "a.csv-2.json");
  EXPECT_EQ(first.rows[0].document, "a.csv.json");
}

TEST(Batch, APartWithoutTablesIsDone) {
  const Tables t;
  const auto r = t.fit({t.paths[0], t.paths[1]}, Part{3, 3});
  EXPECT_TRUE(r.rows.empty());
  EXPECT_EQ(r.outcome(), Exit::done);
  EXPECT_EQ(r.part, "3/3");
}

}  // namespace
}  // namespace gonio
