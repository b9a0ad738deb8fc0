#pragma once
/// \file
/// Cost of accuracy: the time of every term and of whole models, in every number and instruction
/// set, beside the operations of their formulas and their distance to the truth.

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "number/counted.h"
#include "reports/finding/report.h"
#include "reports/measure/machine.h"
#include "reports/picture/figure.h"
#include "timing/timing.h"

namespace gonio {

namespace page {
struct Page;
}

/// Distance of a form from the truth that it stands for.
struct CostError {
  std::string truth;        ///< what it is held against; empty: nothing
  std::string measure;      ///< what is compared: "G2", "F" …
  double max = 0, rms = 0;  ///< of the absolute difference
  /// Colour error of whole models, of gold seen in even light, at most; not a number: not known
  double delta_e = std::numeric_limits<double>::quiet_NaN();
};

/// One entry of the catalogue, or a whole model, in one number, instruction set and place.
struct CostRow {
  std::string id;  ///< of a term or a whole model, else the model's spec
  /// "ndf", "masking", "fresnel", "diffuse", "model"; "by_hand": a model written out by hand; "bound"; of studies "sampling", "split_sum"
  std::string_view kind;
  std::string_view number;  ///< "float", "double"
  std::string isa;          ///< "sse2", "avx2", …
  /// "cache": columns of few samples; "streaming": columns that no cache of a core holds; those of a
  /// term may stay in one that all cores share
  std::string_view memory;
  /// Way of a model: "fused" into one loop, "composed" of columns, "by_hand"; else ""
  std::string_view way;
  std::size_t channels;
  Timing time;            ///< of one sample: the median over processes, and the spread between them
  Operations operations;  ///< of one sample; a term's with its division, which a model makes once
  std::size_t bytes = 0;  ///< of tables
  CostError error;
  /// A place on the front of time and error: no rival (of the same kind, number, set, place and truth) that is at least
  /// as accurate is faster by a difference that survives (timing.h).
  bool pareto = false;
  /// A tie with a rival that is at least as accurate: their times differ by nothing that survives.
  bool tie = false;
  bool on_line = false;  ///< a place on the line that is drawn through the front (front.h)
  /// Operations that depend on the parameters alone: made once per block here, for each sample by a shader whose
  /// roughness varies.
  Operations block_operations{};
  std::vector<double> each{};  ///< time in each process, in their order; empty: one measured all
};
inline ComparedTime compared(const CostRow& r) {
  return {r.time, r.each};
}

/// An estimate or a fit by how long it takes.
struct CostPoint {
  std::string_view picture;  ///< "compensation", "split_sum", "quadrature", "fit"
  std::string series, label;
  Timing time;
  double error, error_spread;
  std::size_t operations = 0, bytes = 0;
  Timing without{};  ///< of a compensation: what the same takes uncompensated
};

/// Cost of going from one form to another.
struct CostSwitch {
  std::string question;  ///< "Schlick's k to exact Smith, separable"
  std::string from, to;  ///< ids
  std::string isa;
  std::string_view number, memory, way;
  double ns, ns_spread;         ///< that it takes more
  double ratio;                 ///< of the times
  double operations;            ///< that it takes more
  double error_from, error_to;  ///< RMS; not numbers where they are of different truths
  bool differs = false;         ///< the times, by what survives (timing.h)
};

struct CostOptions {
  bool full = false;
  TimingOptions timing{7, 1e-3, true};
  /// Samples of a column: in cache, and streaming.
  std::size_t cache_samples = 512, stream_samples = std::size_t{1} << 21U;
  std::string filter{};  ///< ids that hold it; empty: all
  bool errors = true;    ///< else none is known, which takes seconds less
  /// Processes that measure everything in turn, each in an order of its own: between them memory lies differently, and
  /// other programs come and go.  One: this one measures.
  int processes = 1;
  std::string program{};  ///< of which they are: `gonio`; empty: this process measures
};
/// Standard: streaming in the best instruction set alone; full: in all of them, and more processes.
CostOptions cost_options(bool full);

/// Name of those that stream: "columns of 8 MiB", of floats.
std::string long_columns(const CostOptions&);

/// Error of a Fresnel form against the spectra of metals, seen as linear sRGB: RMS over the angle and all metals known.
struct MetalError {
  std::string form;
  double rms;
};

/// Time that was not measured.
inline constexpr Timing unknown_time{std::numeric_limits<double>::quiet_NaN(),
                                     std::numeric_limits<double>::quiet_NaN()};

/// A way to draw lights for GGX, at one roughness and view.
struct SamplingRow {
  std::string id, name;
  double roughness, mu;
  double deviation;  ///< standard deviation of a sample's weight at F = 1, over E
  double below;      ///< share of the lights that lie below the horizon
  Timing time = unknown_time;
};
/// A and B of the split sum by a table or a formula, over roughness from 0.05 and NoV from 1/32 on.
struct LookupRow {
  std::string id, name;
  std::size_t bytes, fetched;     ///< of the table, and of a bilinear lookup
  double a_rms, b_rms;            ///< not numbers of what gives A + B alone
  double plastic_rms;             ///< of F0 A + B at F0 = 0.04
  double mirror_rms, mirror_max;  ///< of A + B
  Timing time = unknown_time;
};
/// A whole model written as a shader, in float and three channels, all its parameters arguments.
struct ShaderRow {
  std::string id;         ///< as that of its times
  Operations operations;  ///< of its graph: what is shared counts once, on a colour three times
  /// Instructions of its optimised SPIR-V by kind, one on a colour counts once; empty where no compiler is there
  std::vector<std::pair<std::string_view, std::size_t>> instructions{};
};
struct Studies {
  std::vector<SamplingRow> sampling{};
  std::vector<LookupRow> lookup{};
  std::vector<ShaderRow> shaders{};
};
/// Time until samples leave an error of 1 % of E [µs].
inline double us_to_percent(const SamplingRow& r) {
  return 1e-3 * r.time.ns * (100 * r.deviation) * (100 * r.deviation);
}

/// Samples of a frame of 1920 × 1080, one each pixel.
inline constexpr double frame_samples = 1920 * 1080;

/// Terms, whole models and bounds, and how they were measured.
struct MeasuredCosts {
  std::vector<CostRow> rows;
  int processes = 1;  ///< that measured
  /// Processors that other programs kept busy meanwhile, on average; no value where the system does not tell
  std::optional<double> others{};
};

/// Everything that the report measures.
struct CostRows {
  Machine machine;
  CostOptions options;
  std::vector<CostRow> rows;
  std::vector<CostPoint> points;
  std::vector<CostSwitch> switches;
  std::vector<MetalError> metals;
  int processes = 1;
  std::optional<double> others{};
  Studies studies{};
};

MeasuredCosts measure_costs(const CostOptions&, const ReportProgress& done = {});
/// Sets `pareto`, `tie` and `on_line` of rows whose error is known.
void mark_front(std::vector<CostRow>&);
/// The pairs of forms that engineers consider, of these rows.
std::vector<CostSwitch> cost_switches(const std::vector<CostRow>&);
std::vector<CostPoint> cost_points(const CostOptions&, const std::function<void(double)>& done);
std::vector<MetalError> errors_on_metals();
/// All of these.
CostRows cost_rows(const CostOptions&, const ReportProgress& done = {});

/// A form that is kept as a mistake in circulation: none chooses it.
bool is_mistake(const CostRow&);
/// The row of a form in a place, of a model in one way; nullptr if it was not measured.
const CostRow* find_row(const std::vector<CostRow>&,
                        std::string_view id,
                        std::string_view number,
                        std::string_view isa,
                        std::string_view memory,
                        std::string_view way = {});

Findings findings(const CostRows&);
Facts facts(const CostRows&);
/// Time against error, and what else is drawn.
Pictures pictures(const CostRows&);

using CostReport = Report<CostRows>;
CostReport cost_report(const CostOptions&, const ReportProgress& done = {});

/// Document {"rows": […], …}: flat objects; what is not known is null.
std::string to_json(const CostReport&);
/// Its rows as CSV.
std::string rows_csv(const CostReport&);
/// JSON Schema of the document.
std::string cost_schema();
/// Its page.
page::Page report_page(const CostReport&);

}  // namespace gonio
