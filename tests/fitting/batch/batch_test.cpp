#include "fitting/batch/batch.h"

#include <chrono>
#include <filesystem>
#include <set>

#include "base/file.h"
#include "fitting/batch/gather.h"
#include "refusal.h"
#include "support.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace gonio {
namespace {

namespace fs = std::filesystem;
/// By which a page is known for one of gonio's.
const std::string head = R"(<meta name="generator" content="gonio">)";

// --- The key of a kept result ---

void change(std::string& text) {
  text += "x";
}
void change(bool& on) {
  on = !on;
}
void change(std::vector<std::string>& all) {
  all.push_back("f0");
}
void change(std::vector<double>& all) {
  all.push_back(0.5);
}
void change(std::vector<Setting>& all) {
  all.push_back({"f0", {0.5}});
}
void change(std::optional<std::string>& text) {
  text = "theta_o > 80";
}
void change(std::optional<double>& number) {
  number = 0.5;
}
void change(std::optional<Bins>& bins) {
  bins = Bins::edge;
}
template <Named E>
void change(E& value) {
  value = static_cast<E>((static_cast<std::size_t>(value) + 1) % names_of<E>.size());
}

template <class Get>
constexpr auto member(Get get) {
  return get;
}
template <template <class> class Form, class Get>
constexpr auto member(As<Form, Get> shown) {
  return shown.get;
}
/// Calls f with each described member of a struct, those of inlined structs in their place.
template <class T, class F>
void for_each_member(T& of, const F& f) {
  const auto one = [&](const auto& described) {
    auto& m = of.*member(described.get);
    if constexpr (Described<std::remove_reference_t<decltype(m)>>)
      for_each_member(m, f);
    else
      f(m);
  };
  with_fields([&](const auto&... all) { (one(all), ...); }, description<T>);
}

/// Key with the k-th member changed.
template <class T>
std::string key_with(T example,
                     std::size_t changed,
                     const std::function<std::string(const T&)>& key) {
  std::size_t k = 0;
  for_each_member(example, [&](auto& m) {
    if (k++ == changed) change(m);
  });
  return key(example);
}
template <class T>
std::size_t members() {
  T example;
  std::size_t n = 0;
  for_each_member(example, [&](auto&) { ++n; });
  return n;
}

TEST(MadeWith, AnyDescribedOptionThatChangesIsAnotherKey) {
  std::set<std::string> keys{made_with({})};
  const std::size_t n = members<HowFitted>();
  EXPECT_EQ(
      n, member_count<FitOptions>() + member_count<AsMeasured>() + member_count<HowFitted>() - 2);
  for (std::size_t k = 0; k < n; ++k)
    EXPECT_TRUE(keys.insert(key_with<HowFitted>({}, k, made_with)).second) << "member " << k;
}

TEST(MadeWith, AnyPartOfASettingThatChangesIsAnotherKey) {
  const auto key = [](const Setting& s) {
    HowFitted how;
    how.options.fixed = {s};
    return made_with(how);
  };
  const Setting gamma{"gamma", {2}};
  std::set<std::string> keys{key(gamma)};
  for (std::size_t k = 0; k < members<Setting>(); ++k)
    EXPECT_TRUE(keys.insert(key_with<Setting>(gamma, k, key)).second) << "member " << k;
}

TEST(MadeWith, ReadsAsOneLine) {
  HowFitted how;
  how.options.fixed = {{"gamma", {2}}};
  how.bins = Bins::edge;
  const std::string key = made_with(how);
  EXPECT_TRUE(key.starts_with("gonio ")) << key;
  EXPECT_TRUE(
      key.ends_with("; model lambert+ggx/smith_ggx.correlated/schlick; "
                    "fix [{\"name\":\"gamma\",\"values\":2.0,\"text\":\"\",\"implied\":false}]; "
                    "metric log; intervals automatic; bin_sensitivity true; certificate auto; "
                    "scale held; bins edge"))
      << key;
}

// --- Inputs and names ---

TEST(Batch, NamesNoTwoDocumentsAlike) {
  EXPECT_EQ(document_names({"a/x.csv", "b/x.csv", "x.txt", "y.csv", "summary.page.csv"}),
            (std::vector<std::string>{"x.csv.json", "x.csv-2.json", "x.txt.json", "y.json",
                                      "summary.page-2.json"}));
}

/// In time quadratic in the tables this takes an hour, in linear time a second.
TEST(Batch, HasTablesWhoseNamesAreHiddenOrNoText) {
  const test::Folder f;
  fs::create_directories(f / "in");
  std::string csv = "theta_i,phi_i,theta_o,phi_o,f\n";
  for (int i = 0; i < 80; i += 10) csv += std::to_string(i) + ",0,30,180,0.1\n";
  std::vector<std::string> tables;
  for (const char* name : {"in/.h.csv", "in/\xff.csv", "in/\xfe.csv"})
    tables.push_back(f.write(name, csv));
  Batch b{tables, f / "out", {}};
  b.how.options.model = "lambert";
  EXPECT_EQ(fit_batch(b, {}).rows.size(), 3U);
  const auto list = read_list(f / "out");
  const BatchSummary s = gather(f / "out", list, {}, {});
  EXPECT_EQ(s.missing, std::vector<std::string>{});
  EXPECT_EQ(s.left_out.size(), 0U);
  ASSERT_EQ(s.rows.size(), 3U);
  for (const auto& row : s.rows) EXPECT_TRUE(row.fit) << row.document;
}

TEST(Batch, NamesManyDocumentsOfOneName) {
  constexpr std::size_t many = 300'000;
  std::vector<std::string> tables;
  for (std::size_t i = 0; i < many; ++i) tables.push_back(std::to_string(i) + "/a.csv");
  EXPECT_EQ(document_names(tables).back(), fmt::format("a.csv-{}.json", many));
}

TEST(Batch, CutsALongNameBetweenCharacters) {
  std::string name;
  for (int i = 0; i < 120; ++i) name += "ω";
  const auto cut = document_names({"x" + name + ".csv"})[0];
  EXPECT_EQ(cut, "x" + name.substr(0, 198) + ".json");
}

TEST(Batch, TakesTheTablesOfFoldersAndListsInTheirPlace) {
  const test::Folder f;
  fs::create_directory(f / "in");
  fs::create_directory(f / "in/within");
  for (const char* name : {"in/b.csv", "in/a.csv", "in/.hidden", "in/c.json", "in/d.html"})
    f.write(name, "x");
  const auto list = f.write("list", "p.csv\r\n\nq.csv\n");
  EXPECT_EQ(tables_of({"z.csv", f / "in", "@" + list}),
            (std::vector<std::string>{"z.csv", f / "in/a.csv", f / "in/b.csv", "p.csv", "q.csv"}));
}

TEST(Batch, RefusesAListOfMorePathsThanItMayHold) {
  const test::Folder f;
  const std::string none(std::size_t{1} << 21, '\n');
  EXPECT_HAS(test::refusal([&] { tables_of({"@" + f.write("empty", none)}); }),
             "lines: found none");
  constexpr std::size_t most = std::size_t{1} << 20;
  std::string text;
  for (std::size_t i = 0; i < most; ++i) text += std::to_string(i) + '\n';
  EXPECT_EQ(tables_of({"@" + f.write("full", text)}).size(), most);
  EXPECT_HAS(test::refusal([&] { tables_of({"@" + f.write("more", text + "a")}); }),
             "lines: found more than 1048576 paths");
}

TEST(Batch, RefusesAPathOfAListThatNoFileHas) {
  const test::Folder f;
  EXPECT_HAS(test::refusal([&] { tables_of({"@" + f.write("list", std::string(4096, 'a'))}); }),
             "a path: found 4096 bytes, expected fewer than 4096");
}

TEST(Batch, TellsItsProgressAndKeepsWhatItHas) {
  const test::Folder f;
  std::string csv = "theta_i,phi_i,theta_o,phi_o,f\n";
  for (int i = 0; i < 80; i += 10) csv += std::to_string(i) + ",0,30,180,0.1\n";
  f.write("a.csv", csv);
  f.write("broken.csv", "theta_i");
  Batch b{{f / "a.csv", f / "broken.csv"}, f / "out", {}};
  b.how.options.model = "lambert";
  std::vector<std::size_t> done;
  const BatchHooks hooks{[&](const BatchCount& n) { done.push_back(n.done); },
                         [](const BatchSummary&, const std::string& title) { return head + title; },
                         {}};
  const auto first = fit_batch(b, hooks);
  EXPECT_EQ(done, (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(first.count.failed, 1U);
  EXPECT_EQ(first.count.kept, 0U);
  EXPECT_EQ(first.outcome(), Exit::bad_input);
  EXPECT_EQ(test::read_bytes(f / "out/summary.html"), head + "out");
  EXPECT_EQ(fit_batch(b, hooks).count.kept, 1U);
  b.how.options.bin_sensitivity = false;
  EXPECT_EQ(fit_batch(b, hooks).count.kept, 0U);
}

TEST(Batch, EndsWhereADocumentCannotBeWritten) {
  const test::Folder f;
  std::string csv = "theta_i,phi_i,theta_o,phi_o,f\n";
  for (int i = 0; i < 80; i += 10) csv += std::to_string(i) + ",0,30,180,0.1\n";
  std::vector<std::string> tables;
  for (const char* name : {"a.csv", "b.csv", "c.csv"}) tables.push_back(f.write(name, csv));
  Batch b{tables, f / "out", {}};
  b.how.options.model = "lambert";
  fs::create_directory(f / "out");
  fs::create_symlink("nowhere/x", f / "out/c.json");
  EXPECT_HAS(test::refusal([&] { fit_batch(b, {}); }), "c.json: writing");
  EXPECT_FALSE(fs::exists(f / "out/summary.csv"));
}

TEST(Batch, MakesAPageOfEachTableWhereAskedAndKeepsItWithItsDocument) {
  const test::Folder f;
  std::string csv = "theta_i,phi_i,theta_o,phi_o,f\n";
  for (int i = 0; i < 80; i += 10) csv += std::to_string(i) + ",0,30,180,0.1\n";
  f.write("a.csv", csv), f.write("summary.csv", csv), f.write("broken.csv", "theta_i");
  Batch b{{f / "a.csv", f / "summary.csv", f / "broken.csv"}, f / "out", {}};
  b.how.options.model = "lambert";
  BatchHooks hooks;
  EXPECT_EQ(fit_batch(b, hooks).rows[0].page, "") << "none was asked for";
  hooks.page = [](const BatchSummary& s, const std::string&) { return head + s.rows[0].page; };
  hooks.table_page = [](const FittedFile& file) { return head + file.table.path; };
  const auto first = fit_batch(b, hooks);
  EXPECT_EQ(first.count.kept, 0U) << "their pages are missing";
  EXPECT_EQ(first.rows[0].page, "a.fit.html");
  EXPECT_EQ(first.rows[2].page, "") << "it could not be read";
  EXPECT_EQ(test::read_bytes(f / "out/a.fit.html"), head + (f / "a.csv"));
  EXPECT_EQ(test::read_bytes(f / "out/summary.fit.html"), head + (f / "summary.csv"));
  EXPECT_EQ(test::read_bytes(f / "out/summary.html"), head + "a.fit.html");
  const auto second = fit_batch(b, hooks);
  EXPECT_EQ(second.count.kept, 2U);
  EXPECT_EQ(second.rows[0].page, "a.fit.html");
  fs::last_write_time(f / "out/a.fit.html",
                      fs::last_write_time(f / "out/a.json") - std::chrono::seconds(1));
  EXPECT_EQ(fit_batch(b, hooks).count.kept, 1U) << "a page of an earlier fit is made again";
  f.write("a.csv", "theta_i");
  fit_batch(b, hooks);
  EXPECT_FALSE(fs::exists(f / "out/a.fit.html")) << "no page of what is no table any more";
}

TEST(Batch, TakesNoPageAwayThatIsAnInputOrSomebodyElses) {
  const test::Folder f;
  fs::create_directories(f / "out");
  std::string csv = "theta_i,phi_i,theta_o,phi_o,f\n";
  for (int i = 0; i < 80; i += 10) csv += std::to_string(i) + ",0,30,180,0.1\n";
  f.write("broken.csv", "theta_i");
  for (const std::string& page : {csv, std::string("mine")}) {
    f.write("out/broken.fit.html", page);
    Batch b{{f / "broken.csv"}, f / "out", {}};
    b.how.options.model = "lambert";
    for (int round = 0; round < 2; ++round) {  // the second finds the document of a failure
      fit_batch(b, {});
      EXPECT_EQ(test::read_bytes(f / "out/broken.fit.html"), page) << round;
    }
  }
  f.write("out/broken.fit.html", csv + R"(# <meta name="generator" content="gonio">)");
  const FileGuard guard;
  Batch b{{f / "broken.csv", f / "out/broken.fit.html"}, f / "out", {}};
  b.how.options.model = "lambert";
  fit_batch(b, {});
  EXPECT_TRUE(fs::exists(f / "out/broken.fit.html")) << "an input";
}

TEST(Batch, ReplacesNoFileThatNoBatchMade) {
  const test::Folder f;
  f.write("a.csv", "theta_i");
  const BatchHooks hooks{{}, {}, [](const FittedFile&) { return std::string("page"); }};
  for (const char* name :
       {"a.json", "a.fit.html", "summary.csv", "summary.html", "summary.page.json"}) {
    fs::remove_all(f / "out");
    fs::create_directories(f / "out");
    const std::string mine = f / (std::string("out/") + name);
    f.write(std::string("out/") + name, R"({"mine": true})");
    EXPECT_HAS(test::refusal([&] {
                 fit_batch({{f / "a.csv"}, f / "out", {}}, hooks);
               }),
               "a file that no batch made");
    EXPECT_EQ(test::read_bytes(mine), R"({"mine": true})") << name;
    EXPECT_FALSE(fs::exists(f / "out/summary.list.json")) << "said before it begins";
  }
  fs::remove_all(f / "out");
  fit_batch({{f / "a.csv"}, f / "out", {}}, hooks);
  f.write("out/a.json", R"({"schema": "gonio.fit/1", "mo)");  // that an earlier batch was to make
  EXPECT_NO_THROW(fit_batch({{f / "a.csv"}, f / "out", {}}, hooks));
  for (const char* name : {"a.json", "summary.csv"}) {
    const test::Folder results;
    fs::copy(f / "out", results / "out");
    results.write(std::string("out/") + name, R"({"mine": true})");
    EXPECT_HAS(test::refusal([&] {
                 fit_batch({{f / "a.csv"}, results / "out", {}}, hooks);
               }),
               "a file that no batch made")
        << "beside results of its own";
  }
}

TEST(Batch, WritesThroughNoLink) {
  const test::Folder f;
  f.write("a.csv", "theta_i");
  f.write("victim", "mine");
  for (const char* name : {"summary.csv", "summary.html", "summary.list.json", "a.json"}) {
    fs::remove_all(f / "out");
    fs::create_directories(f / "out");
    fs::create_symlink("../victim", f / (std::string("out/") + name));
    EXPECT_HAS(test::refusal([&] {
                 fit_batch({{f / "a.csv"}, f / "out", {}}, {});
               }),
               "writing: found a link");
    EXPECT_EQ(test::read_bytes(f / "victim"), "mine") << name;
  }
}

TEST(Batch, WithoutAPageItStillHasItsSummary) {
  const test::Folder f;
  f.write("broken.csv", "theta_i");
  fit_batch({{f / "broken.csv"}, f / "out", {}});
  EXPECT_TRUE(fs::exists(f / "out/summary.csv"));
  EXPECT_FALSE(fs::exists(f / "out/summary.html"));
}

}  // namespace
}  // namespace gonio
