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
    return std::tuple{
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
              "of the parameters alone: once per block, and per sample where they vary")};
  }
  template <std::size_t... K>
  static constexpr auto operations(std::index_sequence<K...>) {
    return std::tuple{field(
        operation_keys[K], "", [](const CostRow& r) { return r.operations.by_kind[K]; },
        "operations of one sample")...};
  }
  static constexpr auto fields() {
    return std::tuple_cat(measured(),
                          operations(std::make_index_sequence<operation_names.size()>()));
  }
};

template <>
struct Description<Machine::Cache> {
  static constexpr auto fields() {
    using C = Machine::Cache;
    return std::tuple{field("level", "", &C::level, ""), field("bytes", "", &C::bytes, ""),
                      field("type", "", &C::type, "Data, Unified")};
  }
};
template <>
struct Description<Machine> {
  static constexpr auto fields() {
    using M = Machine;
    return std::tuple{field("cpu", "", &M::cpu, "as it calls itself"),
                      field("threads", "", &M::threads, "that run at once"),
                      field("caches", "", &M::caches, "without those of instructions"),
                      field("instruction_sets", "", &M::instruction_sets, "that run here"),
                      field("compiler", "", &M::compiler, ""),
                      field("flags", "", &M::flags, ""),
                      field("native_half", "", &M::native_half, "arithmetic in half, AVX512-FP16")};
  }
};
static_assert(describes_every_member<Machine>());

template <>
struct Description<CostSetting> {
  static constexpr auto fields() {
    using S = CostSetting;
    return std::tuple{
        field(
            "full", "", [](const S& s) { return s.options->full; }, setting_meaning),
        field(
            "machine", "", [](const S& s) -> const Machine& { return *s.machine; }, ""),
        field(
            "repetitions", "", [](const S& s) { return s.options->timing.repetitions; },
            "of each time, in each process"),
        field("processes", "", &S::processes, "that measured everything in turn"),
        field("others_busy", "", &S::others,
              "processors that other programs kept busy meanwhile, on average; null: not known"),
        field(
            "cache_samples", "", [](const S& s) { return s.options->cache_samples; },
            "of a column"),
        field(
            "stream_samples", "", [](const S& s) { return s.options->stream_samples; },
            "of a column")};
  }
};

template <>
struct Description<CostPoint> {
  static constexpr auto fields() {
    using P = CostPoint;
    return std::tuple{
        field("picture", "", &P::picture, "compensation, split_sum, quadrature, fit"),
        field("series", "", &P::series, ""),
        field("label", "", &P::label, ""),
        field("ns", "ns", at(&P::time, &Timing::ns), "time, median"),
        field("ns_spread", "ns", at(&P::time, &Timing::spread_ns), spread_meaning),
        field("error_rms", "", &P::error, ""),
        field("error_spread", "", &P::error_spread, "of error_rms"),
        field("ops", "", &P::operations, ""),
        field("bytes", "", &P::bytes, "of tables"),
        field("without_ns", "ns", at(&P::without, &Timing::ns),
              "of a compensation: time of the same uncompensated"),
        field("without_ns_spread", "ns", at(&P::without, &Timing::spread_ns), spread_meaning)};
  }
};

template <>
struct Description<CostSwitch> {
  static constexpr auto fields() {
    using S = CostSwitch;
    return std::tuple{
        field("question", "", &S::question, ""),
        field("from", "", &S::from, "id"),
        field("to", "", &S::to, "id"),
        field("number", "", &S::number, "float, double"),
        field("isa", "", &S::isa, "instruction set"),
        field("memory", "", &S::memory, "cache, streaming"),
        field("way", "", &S::way, "of a model: fused, composed"),
        field("more_ns", "ns", &S::ns, "that it takes more"),
        field("more_spread_ns", "ns", &S::ns_spread, "of what they differ by, between processes"),
        field("ratio_ns", "", &S::ratio, "of the times"),
        field("more_ops", "", &S::operations, "that it takes more"),
        field("error_from", "", &S::error_from, "RMS; null: of another truth"),
        field("error_to", "", &S::error_to, "RMS; null: of another truth"),
        field("differs", "", &S::differs, "the times, in every process and above the spread"),
        field(
            "frame_ms", "ms", [](const S& w) { return 1e-6 * frame_samples * w.ns; },
            "that a frame of 1920 × 1080 takes more, a sample each pixel, on one processor")};
  }
};

template <>
struct Description<SamplingRow> {
  static constexpr auto fields() {
    using R = SamplingRow;
    return std::tuple{
        field("id", "", &R::id, ""),
        field("name", "", &R::name, ""),
        field("roughness", "", &R::roughness, ""),
        field("mu", "", &R::mu, "cosine of the view"),
        field("deviation", "", &R::deviation, "standard deviation of a sample at F = 1, over E"),
        field("below", "", &R::below, "share of lights below the horizon"),
        field("ns", "ns", at(&R::time, &Timing::ns), "light and weight of a sample"),
        field("ns_spread", "ns", at(&R::time, &Timing::spread_ns), between_processes),
        field(
            "to_percent_ms", "ms", [](const R& r) { return 1e-3 * us_to_percent(r); },
            "until the error is 1 % of E")};
  }
};
template <>
struct Description<LookupRow> {
  static constexpr auto fields() {
    using R = LookupRow;
    return std::tuple{
        field("id", "", &R::id, ""),
        field("name", "", &R::name, ""),
        field("bytes", "", &R::bytes, "of the table"),
        field("fetched", "", &R::fetched, "bytes of a bilinear lookup"),
        field("a_rms", "", &R::a_rms, "null: not given apart"),
        field("b_rms", "", &R::b_rms, "null: not given apart"),
        field("plastic_rms", "", &R::plastic_rms, "of F0 A + B at F0 = 0.04"),
        field("mirror_rms", "", &R::mirror_rms, "of A + B"),
        field("mirror_max", "", &R::mirror_max, "of A + B"),
        field("ns", "ns", at(&R::time, &Timing::ns),
              "in float columns; a table's texels are fetched one by one"),
        field("ns_spread", "ns", at(&R::time, &Timing::spread_ns), between_processes)};
  }
};

template <>
struct Description<ShaderRow> {
  static constexpr auto fields() {
    using R = ShaderRow;
    return std::tuple{
        field("id", "", &R::id, "of a preset, or the spec"),
        field(
            "ops", "", [](const R& r) { return r.operations.total(); },
            "of its graph, on a colour three"),
        field(
            "instructions", "",
            [](const R& r) {
              return r.instructions.empty() ? std::nullopt : std::optional(r.instructions);
            },
            "of optimised SPIR-V by kind, on a colour one; null: no compiler was there")};
  }
};

template <>
struct Description<Timing> {
  static constexpr auto fields() {
    return std::tuple{field("ns", "ns", &Timing::ns, "median"),
                      field("ns_spread", "ns", &Timing::spread_ns, spread_meaning)};
  }
};

template <>
struct Description<CostChange> {
  static constexpr auto fields() {
    using C = CostChange;
    constexpr auto of_both = [](const C& c, auto value) {
      return c.before && c.now ? std::optional(value) : std::nullopt;
    };
    return std::tuple{
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
struct Description<BenchDocument> {
  static constexpr auto fields() {
    using B = BenchDocument;
    return std::tuple{constant_text("schema", "gonio.bench/1"), inlined(&B::setting),
                      field(
                          "rows", "", [](const B& b) -> const auto& { return *b.rows; },
                          "a form in a place, each"),
                      field("changes", "", if_there(&B::changes), "since an earlier document")};
  }
};

template <>
struct Description<CostReport> {
  static constexpr auto fields() {
    using R = CostReport;
    return std::tuple{
        constant_text("schema", "gonio.report.cost/1"),
        inlined([](const R& r) {
          return CostSetting{&r.rows.options, &r.rows.machine, r.rows.processes, r.rows.others};
        }),
        field("findings", "", at(&R::findings, &Findings::sentences), findings_meaning),
        field("rows", "", at(&R::rows, &CostRows::rows), "a form in a place, each"),
        field("switches", "", at(&R::rows, &CostRows::switches), ""),
        field("points", "", at(&R::rows, &CostRows::points), "estimates and fits by their time"),
        field(
            "sampling", "", [](const R& r) -> const auto& { return r.rows.studies.sampling; },
            "lights drawn for GGX"),
        field(
            "lookups", "", [](const R& r) -> const auto& { return r.rows.studies.lookup; },
            "A and B of the split sum by tables and formulas"),
        field(
            "shaders", "", [](const R& r) -> const auto& { return r.rows.studies.shaders; },
            "whole models as shaders, in float and three channels"),
        inlined(&R::pictures)};
  }
};

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
