#include "reports/cost/baseline.h"

#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "refusal.h"
#include "support.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

CostRow made(std::string id, double ns, double spread) {
  CostRow r{};
  r.id = std::move(id);
  r.kind = "fresnel", r.number = "float", r.isa = "scalar", r.memory = "cache";
  r.time = {ns, spread};
  return r;
}
const Machine machine{"cpu", 2, {}, {"scalar"}, "compiler", "flags"};

/// What is read of a document that was written of these rows.
EarlierCosts earlier(const std::vector<CostRow>& rows) {
  const test::Folder f;
  return read_costs(f.write("old.json", costs_json(machine, {}, {rows})));
}

TEST(CostBaseline, ReadsWhatBenchWrites) {
  const auto e = earlier({made("fresnel.a", 1.5, 0.25), made("fresnel.b", 2, 0)});
  EXPECT_EQ(e.cpu, "cpu");
  EXPECT_EQ(e.compiler, "compiler");
  EXPECT_EQ(e.flags, "flags");
  ASSERT_EQ(e.entries.size(), 2U);
  EXPECT_EQ(e.entries[0].name, name_of(made("fresnel.a", 0, 0)));
  EXPECT_EQ(e.entries[0].time.ns, 1.5);
  EXPECT_EQ(e.entries[0].time.spread_ns, 0.25);
}

TEST(CostBaseline, RatiosAreOfNowOverBefore) {
  const auto all = changes(earlier({made("a", 2, 0.2), made("b", 2, 0.2), made("c", 2, 0.2)}),
                           {made("a", 4, 0.4), made("b", 3.1, 0.2), made("c", 1, 0.1)});
  ASSERT_EQ(all.size(), 3U);
  EXPECT_DOUBLE_EQ(all[0].ratio, 2);
  EXPECT_DOUBLE_EQ(all[0].spread, 2 * std::hypot(0.1, 0.1));
  EXPECT_TRUE(all[0].differs);   // by 2 > 3 · 0.6
  EXPECT_FALSE(all[1].differs);  // by 1.1 < 3 · 0.4
  EXPECT_TRUE(all[2].differs);
}

TEST(CostBaseline, TellsWhatIsMissingOnEitherSide) {
  const auto all = changes(earlier({made("gone", 1, 0), made("there", 1, 0)}),
                           {made("new", 1, 0), made("there", 1, 0)});
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].name.id, "new");
  EXPECT_FALSE(all[0].before.has_value());
  EXPECT_TRUE(all[1].before && all[1].now);
  EXPECT_EQ(all[2].name.id, "gone");
  EXPECT_FALSE(all[2].now.has_value());
}

TEST(CostBaseline, DoesNotMissWhatWasFilteredOut) {
  EXPECT_TRUE(changes(earlier({made("masking.x", 1, 0)}), {}, "fresnel").empty());
  EXPECT_EQ(changes(earlier({made("masking.x", 1, 0)}), {}, "masking").size(), 1U);
}

TEST(CostBaseline, ComparesTheSameWayInTheSamePlaceAlone) {
  auto other = made("a", 1, 0);
  other.memory = "streaming";
  auto fused = made("a", 1, 0);
  fused.way = "fused";
  for (const auto& all : {changes(earlier({other}), {made("a", 1, 0)}),
                          changes(earlier({fused}), {made("a", 1, 0)})}) {
    ASSERT_EQ(all.size(), 2U);
    EXPECT_FALSE(all[0].before);
  }
}

TEST(CostBaseline, ReadsTheReportToo) {
  CostRows rows;
  rows.machine = machine;
  rows.rows = {made("a", 1, 0)};
  const test::Folder f;
  EXPECT_EQ(read_costs(f.write("cost.json", to_json(report_of(false, rows)))).entries.size(), 1U);
}

TEST(CostBaseline, WritesWhatChanged) {
  const std::vector<CostRow> rows{made("a", 3, 0)};
  const auto j = nlohmann::json::parse(
      costs_json(machine, {}, {rows}, changes(earlier({made("a", 2, 0), made("b", 1, 0)}), rows)));
  EXPECT_EQ(j["changes"].size(), 2U);
  EXPECT_EQ(j["changes"][0]["ratio"], 1.5);
  EXPECT_EQ(j["changes"][0]["differs"], true);
  EXPECT_EQ(j["changes"][1]["now"], nullptr);
  EXPECT_EQ(j["changes"][1]["ratio"], nullptr);
}

TEST(CostBaseline, RefusesWhatItIsNotSayingWhere) {
  const test::Folder f;
  const auto refused = [&](const std::string& bytes) {
    return test::refusal([&] { read_costs(f.write("old.json", bytes)); });
  };
  const auto with_row = [](const std::string& row) {
    return R"({"schema": "gonio.bench/1", "machine": {"cpu": "", "compiler": "", "flags": ""}, "rows": [)" +
           row + "]}";
  };
  const std::string names =
      R"("id": "a", "number": "float", "isa": "x", "memory": "cache", "way": "")";
  EXPECT_HAS(refused(""), "an empty file");
  EXPECT_HAS(refused("{"), "expected JSON");
  EXPECT_HAS(refused("[]"), "expected an object");
  EXPECT_HAS(refused("{}"), "schema");
  EXPECT_HAS(refused(R"({"schema": "gonio.fit/1"})"), "gonio.bench/1");
  EXPECT_HAS(refused(R"({"schema": "gonio.bench/1"})"), "machine");
  EXPECT_HAS(refused(with_row("3")), "rows[0]");
  EXPECT_HAS(refused(with_row("{" + names + "}")), "rows[0].ns: found nothing");
  EXPECT_HAS(refused(with_row("{" + names + R"(, "ns": "1"})")), "rows[0].ns");
  EXPECT_HAS(refused(with_row("{" + names + R"(, "ns": null, "ns_spread": 1})")), "a time above 0");
  EXPECT_HAS(refused(with_row("{" + names + R"(, "ns": 0, "ns_spread": 1})")), "a time above 0");
  EXPECT_HAS(refused(with_row("{" + names + R"(, "ns": -1, "ns_spread": 1})")), "a time above 0");
  EXPECT_HAS(refused(with_row("{" + names + R"(, "ns": 1, "ns_spread": -1})")),
             "rows[0].ns_spread");
  EXPECT_HAS(refused(with_row("{" + names + R"(, "ns": 1e999, "ns_spread": 0})")), "old.json");
  std::filesystem::resize_file(f / "old.json", (1U << 26) + 1);
  EXPECT_HAS(test::refusal([&] { read_costs(f / "old.json"); }), "at most 67108864");
  EXPECT_THROW(read_costs(f / "nothing.json"), Error);
}

}  // namespace
}  // namespace gonio
