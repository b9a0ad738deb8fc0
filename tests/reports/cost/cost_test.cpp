#include "reports/cost/cost.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <set>
#include <thread>
#include <tuple>

#include "brdf/catalogue/registry.h"
#include "brdf/cost/model_operations.h"
#include "brdf/in_number/number.h"
#include "brdf/kernel/kernels.h"
#include "brdf/model/presets.h"
#include "reports/audit/audit.h"
#include "reports/cost/claims.h"
#include "reports/cost/models.h"
#include "reports/cost/points.h"
#include "reports/cost/processes.h"
#include "reports/cost/studies.h"
#include "reports/finding/words.h"
#include "reports/measure/load.h"
#include "reports/pictures.h"
#include "reports/plain.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

/// As short as it gets: no test looks at a time itself.
CostOptions short_options() {
  CostOptions o;
  o.full = true;
  o.timing = {1, 1e-9, true};
  o.cache_samples = 16;
  o.stream_samples = 256;
  o.errors = false;
  return o;
}
CostOptions short_options(std::string filter) {
  auto o = short_options();
  o.filter = std::move(filter);
  o.errors = true;
  return o;
}

/// A form that takes so long and is off by so much.
CostRow made(std::string id, double ns, double spread, double rms) {
  CostRow r{};
  r.id = std::move(id);
  r.kind = "masking", r.number = "float", r.isa = "scalar", r.memory = "cache";
  r.time = {ns, spread};
  r.error.truth = "truth";
  r.error.rms = rms;
  return r;
}

TEST(CostFront, LeavesOutWhatAnotherBeatsInTimeAndIsNoWorseThan) {
  std::vector<CostRow> rows{made("fast", 1, 0.1, 0.5), made("slow", 3, 0.1, 0.5),
                            made("exact", 4, 0.1, 0.01), made("worse", 4.5, 0.1, 0.02)};
  mark_front(rows);
  const std::vector<bool> expected{true, false, true, false};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].pareto, expected[i]) << rows[i].id;
    EXPECT_FALSE(rows[i].tie) << rows[i].id;
  }
}

TEST(CostFront, CallsATieWhatIsNotSlowerBeyondBothSpreads) {
  std::vector<CostRow> rows{made("rough", 1, 0.2, 0.5), made("better", 1.3, 0.2, 0.1),
                            made("far", 1.5, 0.2, 0.6)};
  mark_front(rows);
  EXPECT_TRUE(rows[0].pareto);  // better is slower, though not by more than the spreads
  EXPECT_TRUE(rows[0].tie);
  EXPECT_TRUE(rows[1].pareto);
  EXPECT_FALSE(rows[1].tie);
  EXPECT_FALSE(rows[2].pareto);  // slower than rough by 0.5 > 0.4, and worse
}

TEST(CostFront, CallsThoseThatAreAlikeATieAndDrawsTheLineThroughOne) {
  std::vector<CostRow> rows{made("a", 1, 0.2, 0.5), made("b", 1.1, 0.2, 0.5)};
  mark_front(rows);
  EXPECT_TRUE(rows[0].pareto && rows[1].pareto);
  EXPECT_TRUE(rows[0].tie && rows[1].tie) << "the next run may find the other faster";
  EXPECT_TRUE(rows[0].on_line);
  EXPECT_FALSE(rows[1].on_line);
}

TEST(CostFront, ComparesOnlyWhatStandsForTheSameInTheSamePlace) {
  std::vector<CostRow> rows{made("a", 1, 0, 0.1), made("b", 2, 0, 0.2),     made("c", 2, 0, 0.2),
                            made("d", 2, 0, 0.2), made("unknown", 9, 0, 0), made("e", 2, 0, 0.2)};
  rows[1].error.truth = "another";
  rows[2].isa = "avx2";
  rows[3].memory = "streaming";
  rows[4].error.truth = "";
  rows[5].channels = 3;
  mark_front(rows);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_TRUE(rows[i].pareto) << rows[i].id;
  EXPECT_FALSE(rows[4].pareto);
  EXPECT_TRUE(rows[5].pareto);
}

TEST(CostFront, LeavesOutMistakes) {
  std::vector<CostRow> rows{made("fresnel.a.as_written", 1, 0, 0), made("fresnel.b", 2, 0, 0.1)};
  mark_front(rows);
  EXPECT_FALSE(rows[0].pareto);
  EXPECT_TRUE(rows[1].pareto);
}

TEST(CostFront, NeedsADifferenceThatEveryProcessFinds) {
  auto fast = made("fast", 1, 0.5, 0.5), slow = made("slow", 2, 0.5, 0.6);
  fast.each = {1, 1.5, 0.5, 1, 3}, slow.each = {2, 2.5, 1.5, 2, 4};  // whole processes are slow
  std::vector<CostRow> rows{fast, slow};
  mark_front(rows);
  EXPECT_TRUE(rows[0].pareto && !rows[0].tie);
  EXPECT_FALSE(rows[1].pareto);
  rows[1].each[3] = 0.9;  // one of five finds the other order
  mark_front(rows);
  EXPECT_TRUE(rows[1].pareto && rows[1].tie);
}

TEST(CostFacts, TellTheTimeOfAWholeHighlightThatStaysInCache) {
  CostRows r;
  r.machine.instruction_sets = {"scalar", "avx2"};
  EXPECT_FALSE(facts(r).setting->model_ns);
  for (const auto& [ns, isa, memory, way] :
       {std::tuple{9.0, "scalar", "cache", "fused"}, std::tuple{0.5, "avx2", "cache", "fused"},
        std::tuple{0.7, "avx2", "cache", "composed"},
        std::tuple{0.8, "avx2", "streaming", "fused"}}) {
    auto& row = r.rows.emplace_back(made("ggx/smith_ggx.correlated/schlick", ns, 0, 0));
    row.kind = "model", row.isa = isa, row.memory = memory, row.way = way;
  }
  EXPECT_EQ(facts(r).setting->model_ns, 0.5);
  r.rows.back().way = "composed";
  ASSERT_EQ(facts(r).whole.size(), 1U) << "most models are not fused: they are compared composed";
  EXPECT_EQ(facts(r).whole[0].ns, 0.7) << "in cache";
}

TEST(CostProcesses, MeasureTimesAloneWithTheSameOptions) {
  CostOptions o;
  o.full = true;
  o.filter = "ggx";
  o.timing.repetitions = 4;
  const auto words = arguments_of_a_process(o);
  const auto has = [&](std::initializer_list<std::string> list) {
    return std::ranges::search(words, list).begin() != words.end();
  };
  EXPECT_EQ(words[0], "bench");
  EXPECT_TRUE(has({"--json"}) && has({"--quiet"}) && has({"--times"}) && has({"--full"}));
  EXPECT_TRUE(has({"--processes", "1"}) && has({"--repeats", "4"}) && has({"--filter", "ggx"}));
}

TEST(CostProcesses, ThisOneMeasuresWhereNoneCanBeStarted) {
  auto o = short_options("fresnel.linear");
  o.full = false, o.errors = false, o.processes = 3;
  for (const std::string program : {"", "gonio-no-such-program", "false", "true"}) {
    o.program = program;
    const auto m = measure_costs(o);
    EXPECT_EQ(m.processes, 1) << program;
    ASSERT_FALSE(m.rows.empty());
    for (const auto& r : m.rows) EXPECT_TRUE(r.each.empty() && r.time.ns > 0) << program;
  }
}

TEST(Load, IsToldFromAQuarterOfAProcessorOn) {
  EXPECT_EQ(load_text({}, 2), "");
  EXPECT_EQ(load_text(0.2, 2), "");
  EXPECT_NE(load_text(1.3, 2).find("1.3 of the 2 processors"), std::string::npos);
}

TEST(Load, DoesNotCountThisProgram) {
  const OthersWork others;
  const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(300);
  std::vector<std::thread> busy;
  for (int i = 0; i < 4; ++i)
    busy.emplace_back([&] {
      while (std::chrono::steady_clock::now() < end) continue;
    });
  for (auto& t : busy) t.join();
  const auto found = others.processors();
  if (!found) GTEST_SKIP() << "the system does not tell";
  EXPECT_LT(*found, std::thread::hardware_concurrency());
  EXPECT_GE(*found, 0);
}

TEST(Cost, HasEveryTermAndModelInEveryNumberSetAndPlace) {
  const auto rows = measure_costs(short_options()).rows;
  std::set<std::tuple<std::string, std::string_view, std::string, std::string_view>> found;
  for (const auto& r : rows) {
    found.emplace(r.id, r.number, r.isa, r.memory);
    EXPECT_TRUE(std::isfinite(r.time.ns) && r.time.ns > 0) << r.id;
    EXPECT_TRUE(std::isfinite(r.time.spread_ns) && r.time.spread_ns >= 0) << r.id;
  }
  std::vector<std::string> ids;
  for (const auto& t : catalogue()) ids.emplace_back(t.about->id);
  for (const auto& p : presets()) ids.emplace_back(p.about.id);
  for (const auto& id : ids)
    for (const std::string_view number : {"float", "double"})
      for (const auto& set : instruction_sets())
        for (const std::string_view memory : {"cache", "streaming"})
          EXPECT_TRUE(found.contains({id, number, set, memory}))
              << id << " " << number << " " << set;
}

TEST(Cost, StreamsInTheBestSetAloneWhereItIsQuick) {
  auto o = short_options("fresnel.schlick.ue");
  o.full = false, o.errors = false;
  const auto best = instruction_sets().back();
  std::size_t streaming = 0;
  for (const auto measured = measure_costs(o); const auto& r : measured.rows) {
    EXPECT_EQ(r.id, "fresnel.schlick.ue");
    if (r.memory != "streaming") continue;
    EXPECT_EQ(r.isa, best);
    ++streaming;
  }
  EXPECT_EQ(streaming, 2U);
}

TEST(Cost, CountsTheOperationsOfATermAsCountedDoes) {
  auto o = short_options("masking.s");
  o.errors = false;
  for (const auto measured = measure_costs(o); const auto& r : measured.rows)
    EXPECT_EQ(r.operations, operations_of(find_term(r.id)).sample) << r.id;
}

TEST(Cost, AModelDividesOnceALobe) {
  const auto of = [](std::string_view spec) {
    return operations_of(bind_model(spec, {}, 1).model);
  };
  const auto ggx = of("ggx/smith_ggx.correlated/schlick");
  EXPECT_EQ(ggx[Operation::div], 1U);
  EXPECT_EQ(ggx[Operation::sqrt], 2U);
  // two numerators, two denominators: three products beside those of the terms
  const auto part = [](std::string_view id) { return operations_of(find_term(id)).fraction; };
  auto terms = part("ndf.ggx");
  terms += part("masking.smith_ggx.correlated");
  terms += part("fresnel.schlick");
  EXPECT_EQ(ggx.total(), terms.total() + 3 + 1);
  const auto diffuse = of("lambert+ggx/smith_ggx.correlated/schlick");
  EXPECT_EQ(diffuse[Operation::add], ggx[Operation::add] + 1);
  // three channels share D and V, and their division
  auto three = operations_of(bind_model("ggx/smith_ggx.correlated/schlick", {}, 3).model);
  EXPECT_EQ(three[Operation::div], 1U);
  EXPECT_EQ(three[Operation::sqrt], 2U);
  EXPECT_EQ(three.total(), ggx.total() + 2 * (part("fresnel.schlick").total() + 1));
  EXPECT_EQ(of("lambert").total(), operations_of(find_term("diffuse.lambert")).sample.total());
}

TEST(Cost, ErrorsInDoubleAreTheAudits) {
  for (const std::string id : {"fresnel.schlick", "fresnel.f82", "masking.ue_joint",
                               "masking.hammon", "ndf.ggx.mobile", "diffuse.disney"}) {
    const auto audited = audit({id})[0].distance;
    const auto e = costing::error_of_term(find_term(id), Number::double_);
    EXPECT_EQ(e.truth, audited->reference) << id;
    EXPECT_EQ(e.measure, audited->measure) << id;
    EXPECT_EQ(e.max, audited->most.value) << id;
    EXPECT_EQ(e.rms, audited->rms) << id;
  }
}

TEST(Cost, ExactFormsAreOffByRoundingAlone) {
  const auto error = [](std::string_view id, Number number) {
    return costing::error_of_term(find_term(id), number);
  };
  for (const std::string_view id : {"fresnel.dielectric", "masking.smith_ggx.correlated"}) {
    const auto f = error(id, Number::float_), d = error(id, Number::double_);
    EXPECT_EQ(f.truth, id);
    EXPECT_GT(f.max, 1e-9);
    EXPECT_LT(f.max, 1e-5);
    EXPECT_GT(d.max, 0);
    EXPECT_LT(d.max, 1e-13);
  }
}

TEST(Cost, MaskingIsHeldAgainstTheCorrelatedSmithOfItsDistribution) {
  const auto truth = [](std::string_view id) {
    return costing::error_of_term(find_term(id), Number::double_).truth;
  };
  EXPECT_EQ(truth("masking.schlick_ggx.direct"), "masking.smith_ggx.correlated");
  EXPECT_EQ(truth("masking.smith_ggx.separable"), "masking.smith_ggx.correlated");
  EXPECT_EQ(truth("masking.schlick_beckmann"), "masking.smith_beckmann.correlated");
}

const costing::Whole& whole(std::string_view id) {
  static const auto all = costing::wholes();
  return *std::ranges::find(all, id, &costing::Whole::id);
}

TEST(Cost, AnExactModelIsItsOwnTruth) {
  const auto e = costing::error_of_whole<double>(whole("ggx/smith_ggx.correlated/conductor"));
  EXPECT_EQ(e.truth, "ggx/smith_ggx.correlated/conductor");
  EXPECT_EQ(e.max, 0);
  EXPECT_EQ(e.delta_e, 0);
  const auto f = costing::error_of_whole<float>(whole("ggx/smith_ggx.correlated/conductor"));
  EXPECT_GT(f.max, 0);
  EXPECT_LT(f.max, 1e-4);
}

TEST(Cost, AModelIsOffByWhatItsTermsAreOff) {
  const auto schlick = costing::error_of_whole<double>(whole("ggx/smith_ggx.correlated/schlick"));
  const auto k = costing::error_of_whole<double>(whole("ggx/schlick_ggx.direct/schlick"));
  EXPECT_LT(schlick.max, 0.1);
  EXPECT_GT(schlick.max, 0.01);
  EXPECT_GT(k.rms, 10 * schlick.rms);
  EXPECT_GT(k.delta_e, schlick.delta_e);
}

TEST(Cost, TablesHaveBytes) {
  EXPECT_EQ(costing::table_bytes("masking.smith_ggx.correlated"), 0U);
  EXPECT_GT(costing::table_bytes("masking.smith_gtr.correlated"), 1000U);
}

TEST(CostSwitches, AreTheDifferencesOfTheirRows) {
  auto from = made("masking.schlick_ggx.direct", 1, 0.3, 0.2),
       to = made("masking.smith_ggx.correlated", 2, 0.4, 0);
  from.operations[Operation::mul] = 7;
  to.operations[Operation::mul] = 13;
  const auto switches = cost_switches({from, to});
  ASSERT_EQ(switches.size(), 1U);
  const auto& s = switches[0];
  EXPECT_EQ(s.ns, 1);
  EXPECT_DOUBLE_EQ(s.ns_spread, 0.5);
  EXPECT_EQ(s.ratio, 2);
  EXPECT_EQ(s.operations, 6);
  EXPECT_EQ(s.error_from, 0.2);
  EXPECT_EQ(s.error_to, 0);
}

TEST(CostSwitches, TellNoErrorsFromDifferentTruths) {
  std::vector<CostRow> rows{made("masking.schlick_ggx.direct", 1, 0.3, 0.2),
                            made("masking.smith_ggx.correlated", 2, 0.4, 0)};
  rows[1].error.truth = "another";
  const auto switches = cost_switches(rows);
  ASSERT_EQ(switches.size(), 1U);
  EXPECT_TRUE(std::isnan(switches[0].error_from));
  EXPECT_TRUE(std::isnan(switches[0].error_to));
}

TEST(CostSwitches, ComparesModelsInTheSameWay) {
  const auto model = [](std::string id, std::string_view way, double ns) {
    auto r = made(std::move(id), ns, 0, 0);
    r.kind = "model", r.way = way;
    return r;
  };
  const std::string k = "ggx/schlick_ggx.direct/schlick",
                    smith = "ggx/smith_ggx.correlated/schlick";
  std::vector<CostRow> rows{model(k, "composed", 2), model(smith, "composed", 3),
                            model(smith, "fused", 1)};
  const auto composed = cost_switches(rows);
  ASSERT_EQ(composed.size(), 1U);
  EXPECT_EQ(composed[0].way, "composed");
  EXPECT_EQ(composed[0].ratio, 1.5);
  rows.push_back(model(k, "fused", 0.5));
  const auto fused = cost_switches(rows);
  ASSERT_EQ(fused.size(), 1U);
  EXPECT_EQ(fused[0].way, "fused");
  EXPECT_EQ(fused[0].ratio, 2);
}

TEST(Cost, HoldsModelsBesideThoseWrittenByHand) {
  auto o = short_options("model.");
  o.errors = false;
  std::set<std::pair<std::string, std::string_view>> found;
  for (const auto measured = measure_costs(o); const auto& r : measured.rows)
    found.emplace(r.id, r.way);
  for (const auto& p : presets())
    for (const std::string_view way : {"by_hand", "fused", "composed"})
      EXPECT_TRUE(found.contains({std::string(p.about.id), way})) << p.about.id << " " << way;
}

const Studies& studies() {
  return costing::study_errors();
}
TEST(CostStudies, VisibleNormalsVaryLessAndBoundedOnesLeast) {
  const auto row = [](std::string_view id, double roughness, double mu) -> const SamplingRow& {
    return *std::ranges::find_if(studies().sampling, [&](const SamplingRow& r) {
      return r.id == id && r.roughness == roughness && r.mu == mu;
    });
  };
  for (const double mu : {0.1, 0.5}) {
    const double plain = row("sampling.ggx.d", 0.8, mu).deviation,
                 disk = row("sampling.ggx.vndf2018", 0.8, mu).deviation,
                 caps = row("sampling.ggx.caps", 0.8, mu).deviation,
                 bounded = row("sampling.ggx.bounded", 0.8, mu).deviation;
    EXPECT_LT(caps, 0.7 * plain);
    EXPECT_NEAR(disk, caps, 0.05 * caps);  // the same density
    EXPECT_LT(bounded, caps);
  }
}

TEST(CostStudies, ATableIsNearerTheLargerItIs) {
  const auto row = [](std::string_view id) -> const LookupRow& {
    return *std::ranges::find(studies().lookup, id, &LookupRow::id);
  };
  EXPECT_LT(row("split_sum.table.64.half").mirror_rms, row("split_sum.table.16.half").mirror_rms);
  EXPECT_LT(row("split_sum.table.32.float").a_rms, row("split_sum.table.32.8 bits").a_rms);
  EXPECT_EQ(row("split_sum.table.32.half").bytes, 4096U);
  EXPECT_EQ(row("split_sum.table.32.half").fetched, 16U);
  EXPECT_LT(row("split_sum.ours").mirror_rms, row("split_sum.materialx").mirror_rms);
  EXPECT_GT(row("split_sum.karis").mirror_rms, row("split_sum.materialx").mirror_rms);
  EXPECT_TRUE(std::isnan(row("split_sum.ours").a_rms));
}

TEST(CostStudies, CountWhatModelsTakeInAShader) {
  const auto rows = costing::shader_rows();
  const auto row = [&](std::string_view id) -> const ShaderRow& {
    return *std::ranges::find(rows, id, &ShaderRow::id);
  };
  const auto &exact = row("ggx/smith_ggx.correlated/dielectric"),
             &schlick = row("ggx/smith_ggx.correlated/schlick");
  EXPECT_GT(exact.operations.total(), 2 * schlick.operations.total());
  if (schlick.instructions.empty())
    GTEST_SKIP() << "glslangValidator or spirv-opt is not there: run ./check, which installs it";
  const auto of = [](const ShaderRow& r, std::string_view kind) {
    return std::ranges::find(r.instructions, kind, &std::pair<std::string_view, std::size_t>::first)
        ->second;
  };
  EXPECT_EQ(of(schlick, "sqrt"), 2U) << "of the masking";
  EXPECT_GT(of(exact, "sqrt"), 2U);
  EXPECT_LE(of(schlick, "add"), schlick.operations[Operation::add]) << "one of a colour is one";
}

TEST(CostStudies, EachIsTimedInEverySet) {
  for (const char* filter : {"sampling.ggx", "split_sum."}) {
    auto o = short_options(filter);
    const auto measured = measure_costs(o);
    for (const auto& set : instruction_sets())
      EXPECT_TRUE(
          std::ranges::any_of(measured.rows, [&](const CostRow& r) { return r.isa == set; }))
          << filter << " " << set;
    for (const auto& r : measured.rows) {
      EXPECT_GT(r.time.ns, 0) << r.id;
      EXPECT_NE(r.error.truth, "") << r.id;
      EXPECT_EQ(r.number, "float");
    }
  }
}

/// Rows of few forms, every kind of picture in them.
CostRows small_rows() {
  CostRows r;
  r.machine = this_machine();
  auto o = short_options("ggx");
  o.full = false;
  r.rows = measure_costs(o).rows;
  r.points = test::few_cost_points();
  r.switches = cost_switches(r.rows);
  r.studies =
      costing::with_times(costing::study_errors(), r.rows, r.machine.instruction_sets.back());
  return r;
}

TEST(CostPictures, AreWhole) {
  const auto rows = small_rows();
  const auto p = pictures(rows);
  test::expect_whole(p);
  std::set<std::string> ids;
  for (const auto& f : p.figures) ids.insert(f.family.empty() ? f.id : f.family);
  for (const std::string id :
       {"masking", "distribution", "model", "compensation", "split_sum", "fit", "quadrature"})
    EXPECT_TRUE(ids.contains(id)) << id;
  for (const auto& f : p.figures)
    for (const auto& c : f.curves)
      if (c.kind == FigureCurve::Kind::both) {
        EXPECT_TRUE(std::ranges::is_sorted(c.x)) << f.id;
      }
  const auto said = findings(rows);
  ASSERT_FALSE(said.sentences.empty());
  EXPECT_NE(said.sentences[0].find("Schlick's k"), std::string::npos) << said.sentences[0];
  EXPECT_TRUE(said.headline.starts_with("Exact Smith in place of Schlick's k costs "));
}

TEST(CostFindings, BeginWithWhatExactSmithCostsAndCallLessNothing) {
  auto rows = small_rows();
  rows.others = 1.3;
  for (auto& s : rows.switches) s.differs = true, s.ns = s.memory == "cache" ? 0.234 : -0.05;
  const auto said = findings(rows);
  EXPECT_EQ(said.sentences[0], said.headline) << "before it tells of other programs";
  EXPECT_NE(said.headline.find(" 0.23 ns more if its inputs are in cache. In a whole GGX model "
                               "that reads its inputs from memory it costs nothing."),
            std::string::npos)
      << said.headline;
  for (auto& s : rows.switches)
    if (s.memory != "cache") s.differs = false, s.ns = -0.01, s.ns_spread = 0.25;
  EXPECT_NE(findings(rows).headline.find("from memory it costs nothing that shows (± 0.25 ns)."),
            std::string::npos)
      << "what its spread may hide: " << findings(rows).headline;
}

TEST(CostFindings, CompareAFrameOfComposedModelsWithComposedOnes) {
  auto rows = small_rows();
  for (auto& r : rows.rows) {
    if (r.memory != "cache" || r.number != "float") continue;
    r.each.clear();
    r.time = {r.way == "composed" ? 0.3 : 0.2, 1e-4};
    if (r.id == "ggx/smith_ggx.correlated/conductor") r.time.ns += r.way == "composed" ? 0.6 : 0.4;
  }
  rows.switches = cost_switches(rows.rows);
  const auto ms = short_text(1e-6 * frame_samples * 0.6);
  const auto all = findings(rows).sentences;
  EXPECT_TRUE(std::ranges::any_of(all, [&](const std::string& x) {
    return x.find("a metal's exact Fresnel " + ms + " ms more") != x.npos;
  })) << ms;
}

TEST(CostFindings, JudgeExactFresnelByWhatIsMeasured) {
  CostRows r;
  r.machine = this_machine();
  for (const char* filter : {"schlick", "dielectric"}) {
    auto o = short_options(filter);
    o.errors = false;
    std::ranges::move(measure_costs(o).rows, std::back_inserter(r.rows));
  }
  Findings said;
  judge_costs(said, r);
  EXPECT_TRUE(std::ranges::any_of(said.claims, [](const Claim& c) {
    return c.claim == "the exact Fresnel equations are slow";
  }));
}

TEST(CostFindings, CanBeReadAloud) {
  auto rows = small_rows();
  rows.others = 1.3;
  rows.points = test::told_cost_points();
  for (auto& r : rows.studies.sampling) r.time = {3.456, 0.1};
  for (auto& r : rows.studies.lookup) r.time = {0.456, 0.1};
  for (const bool differs : {false, true}) {
    for (auto& s : rows.switches) s.differs = differs;
    rows.machine.native_half = differs;
    const auto said = findings(rows);
    EXPECT_GT(said.sentences.size(), 25U);
    test::expect_plain(said);
  }
}

TEST(CostDocument, HasTheKeysOfTheContract) {
  CostRows rows;
  rows.machine = this_machine();
  rows.rows = measure_costs(short_options("fresnel.schlick.ue")).rows;
  const auto j = nlohmann::json::parse(to_json(report_of(false, rows)));
  EXPECT_EQ(j["schema"], "gonio.report.cost/1");
  ASSERT_FALSE(j["rows"].empty());
  for (const auto& row : j["rows"]) {
    for (const char* key : {"id", "number", "isa", "ns", "ns_spread", "ops", "error_max",
                            "error_rms", "pareto", "memory", "kind"})
      EXPECT_TRUE(row.contains(key)) << key;
    std::size_t ops = 0;
    for (const auto name : operation_names)
      ops += row["ops_" + std::string(name)].get<std::size_t>();
    EXPECT_EQ(row["ops"], ops);
    EXPECT_GT(row["error_max"], 0);
  }
}

TEST(Machine, SaysWhatItIs) {
  const auto m = this_machine();
  EXPECT_GT(m.threads, 0U);
  EXPECT_EQ(m.instruction_sets, instruction_sets());
  EXPECT_NE(m.compiler, "");
  EXPECT_NE(m.flags.find("-ffp-contract=off"), std::string::npos) << m.flags;
}

}  // namespace
}  // namespace gonio
