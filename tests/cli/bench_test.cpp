// gonio bench: what it prints, and what it refuses before it measures.
#include "cli/program.h"

namespace gonio::test {
namespace {

TEST(BenchCommand, PrintsADocumentThatItCompares) {
  const Folder f;
  const std::string words = "bench --filter fresnel.linear --repeats 1";
  const auto first = gonio(f, words + " --json");
  ASSERT_EQ(first.code, 0) << first.err;
  const auto j = first.json();
  EXPECT_EQ(j["schema"], "gonio.bench/1");
  for (const auto& row : j["rows"]) EXPECT_EQ(row["id"], "fresnel.linear.as_written");
  EXPECT_FALSE(j.contains("changes"));
  f.write("old.json", first.out);
  const auto again = gonio(f, words + " --baseline old.json --json");
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(again.json()["changes"].size(), j["rows"].size());
  const auto told = gonio(f, words + " --baseline old.json");
  EXPECT_EQ(told.code, 0);
  EXPECT_NE(told.out.find(" times changed by more than three times both spreads"),
            std::string::npos)
      << told.out;
}

TEST(BenchCommand, PrintsOfABaselineWhatChangedAndNothingElse) {
  const Folder f;
  const std::string words = "bench --filter fresnel.linear --repeats 1";
  auto old = gonio(f, words + " --json").json();
  auto& rows = old["rows"];
  ASSERT_GT(rows.size(), 3U);
  for (auto& row : rows) row["ns_spread"] = 1e3 * row["ns"].get<double>();
  rows[0]["ns"] = 1e9, rows[0]["ns_spread"] = 0;  // however busy the machine is
  rows[1]["memory"] = "tape";
  f.write("old.json", old.dump());
  const auto told = gonio(f, words + " --baseline old.json");
  ASSERT_EQ(told.code, 0) << told.err;
  EXPECT_NE(told.out.find("\n1 of " + std::to_string(rows.size() - 1) + " times changed"),
            told.out.npos)
      << told.out;
  const auto count = [&](const std::string& word) {
    std::size_t n = 0;
    for (auto at = told.out.find(word); at != told.out.npos; at = told.out.find(word, at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(count(" -> "), 1U) << told.out;
  EXPECT_EQ(count("1 not timed earlier: "), 1U) << told.out;
  EXPECT_EQ(count("1 not timed now: "), 1U) << told.out;
  EXPECT_EQ(count("\n"), 6U + count("Other programs kept")) << told.out;
  rows[0]["ns_spread"] = 1e12;
  f.write("old.json", old.dump());
  EXPECT_NE(gonio(f, words + " --baseline old.json").out.find("\nnone of "), told.out.npos);
}

TEST(BenchCommand, MeasuresInProcessesOfItself) {
  const Folder f;
  const std::string words = "bench --filter fresnel.linear --repeats 1 --times --json";
  const auto several = gonio(f, words + " --processes 2"), one = gonio(f, words + " --processes 1");
  ASSERT_EQ(several.code, 0) << several.err;
  ASSERT_EQ(one.code, 0) << one.err;
  const auto document = several.json();
  EXPECT_EQ(document["processes"], 2);
  EXPECT_EQ(one.json()["processes"], 1);
  EXPECT_TRUE(document.contains("others_busy"));
  for (const auto& row : document["rows"]) {
    EXPECT_GT(row["ns"], 0);
    EXPECT_TRUE(row["error_rms"].is_null());
  }
}

TEST(BenchCommand, RefusesABaselineThatIsNoneBeforeItMeasures) {
  const Folder f;
  expect_one_line(gonio(f, "bench --baseline nothing.json"), 3, "nothing.json");
  f.write("old.json", R"({"schema": "gonio.fit/1"})");
  expect_one_line(gonio(f, "bench --baseline old.json"), 3, "gonio.bench/1");
}

TEST(BenchCommand, RefusesOptionsWithoutEffect) {
  const Folder f;
  expect_one_line_each(f, 2,
                       {{"bench fit --full", "bench kernels"},
                        {"bench fit --baseline old.json", "bench kernels"},
                        {"bench fit --processes 2", "bench kernels"},
                        {"bench --no-plain", "bench fit"},
                        {"bench --filter nothing.such", "nothing.such"},
                        {"bench everything", "everything"}});
}

}  // namespace
}  // namespace gonio::test
