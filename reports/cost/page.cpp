// The cost report as JSON.
#include <optional>
#include <utility>

#include "reports/cost/baseline.h"
#include "reports/cost/studies.h"
#include "reports/picture/document.h"

namespace gonio {
namespace {

/// Value of what is held against a truth; else none.
template <class T>
std::optional<T> if_known(const CostRow& r, T value) {
  return r.error.truth.empty() ? std::nullopt : std::optional<T>(value);
}
std::optional<std::size_t> total_operations(const CostRow& r) {
  return r.kind == "by_hand" || costing::is_study(r.kind) ? std::nullopt
                                                          : std::optional(r.operations.total());
}
std::optional<std::size_t> block_operations(const CostRow& r) {
  return r.kind == "by_hand" || costing::is_study(r.kind)
             ? std::nullopt
             : std::optional(r.block_operations.total());
}
constexpr std::array<std::string_view, operation_names.size()> operation_keys{
    "ops_add", "ops_mul", "ops_div", "ops_sqrt", "ops_exp", "ops_log", "ops_compare", "ops_select"};

/// Setting in which a document of costs was measured.
struct CostSetting {
  const CostOptions* options;
  const Machine* machine;
  int processes;
  std::optional<double> others;
};
/// Document of `gonio bench`.
struct BenchDocument {
  CostSetting setting;
  const std::vector<CostRow>* rows;
  std::optional<std::vector<CostChange>> changes;
};

constexpr std::string_view spread_meaning = "half the distance of the quartiles",
                           between_processes =
                               "half the distance of the quartiles, between processes";

}  // namespace

template <>
struct Description<CostRow> {
  static constexpr auto measured() {
    using R = CostRow;
    return FieldList{
        field("id", "", &R::id, "of a term or a whole model, else the model's spec"),
        field("number", "", &R::number, "float, double"),
        field("isa", "", &R::isa, "instruction set"),
        field("ns", "ns", at(&R::time, &Timing::ns), "time of one sample, median over processes"),
        field("ns_spread", "ns", at(&R::time, &Timing::spread_ns), between_processes),
        field("ops", "", total_operations, "operations of one sample, all kinds alike"),
        field(
            "error_max", "", [](const R& r) { return if_known(r, r.error.max); }, "most, absolute"),
        field(
            "error_rms", "", [](const R& r) { return if_known(r, r.error.rms); }, ""),
        field(
            "pareto", "", [](const R& r) { return if_known(r, r.pareto); },
            "on the front of time and error"),
        field("tie", "", &R::tie,
              "with one as exact or more: no difference of their times survives from process to "
              "process"),
        field("memory", "", &R::memory, "cache, streaming"),
        field("kind", "", &R::kind,
              "ndf, masking, fresnel, diffuse, model, by_hand, bound, sampling, split_sum"),
        field("way", "", &R::way, "of a model: fused, composed, by_hand"),
        field("channels", "", &R::channels, ""),
        field("truth", "", at(&R::error, &CostError::truth), "what it is held against"),
        field("measure", "", at(&R::error, &CostError::measure), "what is compared"),
        field("delta_e", "", at(&R::error, &CostError::delta_e),
              "CIEDE2000 of gold in even light, at most"),
        field("bytes", "", &R::bytes, "of tables"),
        field("ops_block", "", block_operations,
              "only of the parameters: once per block, and per sample where they vary"),
        field("ns_each", "ns", &R::each, "time in each process, in their order")};
  }
  template <std::size_t... K>
  static constexpr auto operations(std::index_sequence<K...>) {
    return FieldList{field(
        operation_keys[K], "", [](const CostRow& r) { return r.operations.by_kind[K]; },
        "operations of one sample")...};
  }
  static constexpr auto fields() {
    return joined(measured(), operations(std::make_index_sequence<operation_names.size()>()));
  }
};

template <>
inline constexpr auto description<Machine::Cache> = FieldList{
    Field{"level", &Machine::Cache::level, ""}, Field{"bytes", &Machine::Cache::bytes, ""},
    Field{"type", &Machine::Cache::type, "Data, Unified"}};
template <>
inline constexpr auto description<Machine> =
    FieldList{Field{"cpu", &Machine::cpu, "as it calls itself"},
              Field{"threads", &Machine::threads, "that run at once"},
              Field{"caches", &Machine::caches, "without those of instructions"},
              Field{"instruction_sets", &Machine::instruction_sets, "that run here"},
              Field{"compiler", &Machine::compiler, ""},
              Field{"flags", &Machine::flags, ""},
              Field{"native_half", &Machine::native_half, "arithmetic in half, AVX512-FP16"}};
static_assert(describes_every_member<Machine>());

template <>
inline constexpr auto description<CostSetting> = FieldList{
    Field{"full", [](const CostSetting& s) { return s.options->full; }, setting_meaning},
    Field{"machine", [](const CostSetting& s) -> const Machine& { return *s.machine; }, ""},
    Field{"repetitions", [](const CostSetting& s) { return s.options->timing.repetitions; },
          "of each time, in each process"},
    Field{"processes", &CostSetting::processes, "that measured everything in turn"},
    Field{"others_busy", &CostSetting::others,
          "processors that other programs kept busy meanwhile, on average; null: not known"},
    Field{"cache_samples", [](const CostSetting& s) { return s.options->cache_samples; },
          "of a column"},
    Field{"stream_samples", [](const CostSetting& s) { return s.options->stream_samples; },
          "of a column"}};

template <>
inline constexpr auto description<CostPoint> = FieldList{
    Field{"picture", &CostPoint::picture, "compensation, split_sum, quadrature, fit"},
    Field{"series", &CostPoint::series, ""},
    Field{"label", &CostPoint::label, ""},
    Field{"ns", "ns", at(&CostPoint::time, &Timing::ns), "time, median"},
    Field{"ns_spread", "ns", at(&CostPoint::time, &Timing::spread_ns), spread_meaning},
    Field{"error_rms", &CostPoint::error, ""},
    Field{"error_spread", &CostPoint::error_spread, "of error_rms"},
    Field{"ops", &CostPoint::operations, ""},
    Field{"bytes", &CostPoint::bytes, "of tables"},
    Field{"without_ns", "ns", at(&CostPoint::without, &Timing::ns),
          "of a compensation: time of the same uncompensated"},
    Field{"without_ns_spread", "ns", at(&CostPoint::without, &Timing::spread_ns), spread_meaning}};

template <>
inline constexpr auto description<CostSwitch> = FieldList{
    Field{"question", &CostSwitch::question, ""},
    Field{"from", &CostSwitch::from, "id"},
    Field{"to", &CostSwitch::to, "id"},
    Field{"number", &CostSwitch::number, "float, double"},
    Field{"isa", &CostSwitch::isa, "instruction set"},
    Field{"memory", &CostSwitch::memory, "cache, streaming"},
    Field{"way", &CostSwitch::way, "of a model: fused, composed"},
    Field{"more_ns", "ns", &CostSwitch::ns, "that it takes more"},
    Field{"more_spread_ns", "ns", &CostSwitch::ns_spread,
          "of what they differ by, between processes"},
    Field{"ratio_ns", &CostSwitch::ratio, "of the times"},
    Field{"more_ops", &CostSwitch::operations, "that it takes more"},
    Field{"error_from", &CostSwitch::error_from, "RMS; null: of another truth"},
    Field{"error_to", &CostSwitch::error_to, "RMS; null: of another truth"},
    Field{"differs", &CostSwitch::differs, "the times, in every process and above the spread"},
    Field{"frame_ms", "ms", [](const CostSwitch& w) { return 1e-6 * frame_samples * w.ns; },
          "that a frame of 1920 × 1080 takes more, a sample each pixel, on one processor"}};

template <>
inline constexpr auto description<SamplingRow> = FieldList{
    Field{"id", &SamplingRow::id, ""},
    Field{"name", &SamplingRow::name, ""},
    Field{"roughness", &SamplingRow::roughness, ""},
    Field{"mu", &SamplingRow::mu, "cosine of the view"},
    Field{"deviation", &SamplingRow::deviation, "standard deviation of a sample at F = 1, over E"},
    Field{"below", &SamplingRow::below, "share of lights below the horizon"},
    Field{"ns", "ns", at(&SamplingRow::time, &Timing::ns), "light and weight of a sample"},
    Field{"ns_spread", "ns", at(&SamplingRow::time, &Timing::spread_ns), between_processes},
    Field{"to_percent_ms", "ms", [](const SamplingRow& r) { return 1e-3 * us_to_percent(r); },
          "until the error is 1 % of E"}};
template <>
inline constexpr auto description<LookupRow> = FieldList{
    Field{"id", &LookupRow::id, ""},
    Field{"name", &LookupRow::name, ""},
    Field{"bytes", &LookupRow::bytes, "of the table"},
    Field{"fetched", &LookupRow::fetched, "bytes of a bilinear lookup"},
    Field{"a_rms", &LookupRow::a_rms, "null: not given apart"},
    Field{"b_rms", &LookupRow::b_rms, "null: not given apart"},
    Field{"plastic_rms", &LookupRow::plastic_rms, "of F0 A + B at F0 = 0.04"},
    Field{"mirror_rms", &LookupRow::mirror_rms, "of A + B"},
    Field{"mirror_max", &LookupRow::mirror_max, "of A + B"},
    Field{"ns", "ns", at(&LookupRow::time, &Timing::ns),
          "in float columns; a table's texels are fetched one by one"},
    Field{"ns_spread", "ns", at(&LookupRow::time, &Timing::spread_ns), between_processes}};

template <>
inline constexpr auto description<ShaderRow> =
    FieldList{Field{"id", &ShaderRow::id, "of a preset, or the spec"},
              Field{"ops", [](const ShaderRow& r) { return r.operations.total(); },
                    "of its graph, on a colour three"},
              Field{"instructions",
                    [](const ShaderRow& r) {
                      return r.instructions.empty() ? std::nullopt : std::optional(r.instructions);
                    },
                    "of optimised SPIR-V by kind, on a colour one; null: no compiler was there"}};

template <>
inline constexpr auto description<Timing> =
    FieldList{Field{"ns", "ns", &Timing::ns, "median"},
              Field{"ns_spread", "ns", &Timing::spread_ns, spread_meaning}};

template <>
struct Description<CostChange> {
  static constexpr auto fields() {
    using C = CostChange;
    constexpr auto of_both = [](const C& c, auto value) {
      return c.before && c.now ? std::optional(value) : std::nullopt;
    };
    return FieldList{
        field("id", "", at(&C::name, &CostName::id), ""),
        field("number", "", at(&C::name, &CostName::number), ""),
        field("isa", "", at(&C::name, &CostName::isa), ""),
        field("memory", "", at(&C::name, &CostName::memory), ""),
        field("way", "", at(&C::name, &CostName::way), ""),
        field("before", "", &C::before, "null: not measured"),
        field("now", "", &C::now, "null: not measured"),
        field(
            "ratio", "", [=](const C& c) { return of_both(c, c.ratio); }, "of now over before"),
        field(
            "ratio_spread", "", [=](const C& c) { return of_both(c, c.spread); }, ""),
        field(
            "differs", "", [=](const C& c) { return of_both(c, c.differs); },
            "by more than three times both spreads")};
  }
};

template <>
inline constexpr auto description<BenchDocument> =
    FieldList{constant_text("schema", "gonio.bench/1"), inlined(&BenchDocument::setting),
              Field{"rows", [](const BenchDocument& b) -> const auto& {return *b.rows;
}
, "a form in a place, each"
}
, Field {
  "changes", if_there(&BenchDocument::changes), "since an earlier document"
}
}
;

template <>
inline constexpr auto description<CostReport> = FieldList{
    constant_text("schema", "gonio.report.cost/1"), inlined([](const CostReport& r) {
      return CostSetting{&r.rows.options, &r.rows.machine, r.rows.processes, r.rows.others};
    }),
    Field{"findings", at(&CostReport::findings, &Findings::sentences), findings_meaning},
    Field{"rows", at(&CostReport::rows, &CostRows::rows), "a form in a place, each"},
    Field{"switches", at(&CostReport::rows, &CostRows::switches), ""},
    Field{"points", at(&CostReport::rows, &CostRows::points), "estimates and fits by their time"},
    Field{"sampling", [](const CostReport& r) -> const auto& {return r.rows.studies.sampling;
}
, "lights drawn for GGX"
}
, Field{"lookups", [](const CostReport& r) -> const auto& {return r.rows.studies.lookup;
}
, "A and B of the split sum by tables and formulas"
}
, Field{"shaders", [](const CostReport& r) -> const auto& {return r.rows.studies.shaders;
}
, "whole models as shaders, in float and three channels"
}
, inlined(&CostReport::pictures)
}
;

std::string costs_json(const Machine& m,
                       const CostOptions& o,
                       const MeasuredCosts& measured,
                       const std::vector<CostChange>& changes) {
  return page_document(BenchDocument{{&o, &m, measured.processes, measured.others},
                                     &measured.rows,
                                     changes.empty() ? std::nullopt : std::optional(changes)});
}
std::string bench_schema() {
  return schema_text<BenchDocument>("gonio bench --json");
}

std::string to_json(const CostReport& r) {
  return page_document(r);
}
std::string rows_csv(const CostReport& r) {
  return csv_of(r.rows.rows, Digits::six);
}
std::string cost_schema() {
  return schema_text<CostReport>("gonio report cost");
}

}  // namespace gonio
