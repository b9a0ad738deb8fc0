#pragma once
/// \file
/// Fits of approximations: slices synthesized from exact Fresnel facets are fitted with the
/// shipped forms, and the other parameters absorb what a form gets wrong.

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "data_synth/synth.h"
#include "fitting/fit.h"
#include "reports/finding/report.h"
#include "reports/picture/figure.h"

namespace gonio {

namespace page {
struct Page;
}

/// A surface that is synthesized.
struct CrossTruth {
  std::string name;              ///< "GGX", "GGX, all orders", "GTR 1.5"
  std::string ndf, masking;      ///< without prefix
  std::vector<Setting> shape{};  ///< gamma
  bool multiple = false;         ///< light that meets several facets too, see beyond_one_facet()
};

/// A form that is fitted to a truth.
struct CrossForm {
  /// "exact", the id of what is exchanged ("masking.ue_joint") or of a preset, or a spec.
  std::string name;
  /// Difference from the truth: "exact": nothing; "fresnel", "masking", "distribution": that term
  /// alone; "combination": several; "model": a whole model, its diffuse included
  std::string kind;
  std::string model;  ///< spec or preset; its word "exact" stands for the exact Fresnel term
  std::vector<Setting> fixed{};
  double scale = 1;  ///< of the truth: π for what is shipped without the 1/π of a BRDF
  bool metals_only = false;
};

/// A parameter of a fit beside its true value.
struct CrossValue {
  std::string parameter;  ///< "roughness", "f0", "gamma", "kd"
  std::string channel;    ///< "red" …; empty: the one there is
  double truth, fitted;
  double error;  ///< standard error of `fitted` by that of the truth; 0: the truth is exact
  ParameterStatus status;

  /// fitted − truth, of F0 as a part of the truth.
  double shift() const;
};

/// A form fitted to a truth.
struct CrossCase {
  std::string truth, fitted, kind, model;
  std::string material;
  double roughness;
  Metric metric;
  std::string layout;
  bool converged;
  double log_rms;        ///< of ln f − ln truth over all values
  double log_rms_truth;  ///< of it what is noise of the truth
  std::vector<CrossValue> values;

  bool is_dielectric() const;  ///< else a metal
  /// True of a value that has an interval: no bound stopped it, the data determine it, and the model is near enough to the truth to
  /// bound it; or of one of a form that is the truth to the last digits.
  bool is_determined(const CrossValue&) const;
  /// nullptr if the model has none.
  const CrossValue* find(std::string_view parameter, std::string_view channel = {}) const;
};

/// Shifts of a parameter over the roughnesses, fitted to GGX met once by one metric over one set of directions.
struct CrossRange {
  std::string fitted, material, parameter;
  Metric metric;
  std::string_view layout;
  double least, most;          ///< F0 as a part of the truth; no numbers where no fit could tell
  std::size_t fits, at_bound;  ///< at_bound: of the fits, those without an interval
};

/// Sentences on what a form does to a truth, over materials and roughnesses.
struct CrossSentence {
  std::string truth, fitted, kind, sentence;
};

/// A published fit of a measured material, fitted anew with GGX or GTR under its own height-correlated Smith; diffuse and Fresnel as
/// they were published.
struct PublishedFit {
  std::string material;
  double width,
      tail;  ///< as published: roughness of the highlight's core, and the exponent of its tail
  double beckmann;  ///< as published, in another model: roughness of Beckmann's distribution
  double ggx_roughness, ggx_log_rms, gtr_roughness, gamma;
  bool gamma_determined;
  double gtr_log_rms;
};

/// Everything that the report measures.
struct CrossFitRows {
  std::vector<CrossCase> cases;
  std::vector<double> roughness;
  std::vector<std::string> materials;
  double walk_error = 0;  ///< RMS over values of the standard error of ln f that the walks leave
  std::vector<PublishedFit> published{};
};

/// Sampling of a truth: a layout of gonio synth, and up to which angle from the normal its values are
/// given, to light and viewer alike.
struct CrossLayout {
  std::string_view name, what;  ///< in the rows; in words
  Layout layout;
  double reach_deg;
  std::size_t finer = 1;  ///< times the bins of an image slice, along each axis
};
/// The first is that of all cases: it resolves every highlight, and holds all angles of the Fresnel term.
/// Instruments trust nothing nearer to the horizon than some 80°, where forms differ most.
inline constexpr std::array cross_layouts{
    CrossLayout{"image_slice", "slice to 80°", Layout::image_slice, 80},
    CrossLayout{"image_slice_finer", "slice of three times the bins", Layout::image_slice, 80, 3},
    CrossLayout{"image_slice_whole", "slice to the horizon", Layout::image_slice, 90},
    CrossLayout{"hemisphere", "hemisphere of six incident angles", Layout::hemisphere, 90}};

/// Choice of what is fitted to what.
struct CrossFitOptions {
  bool full = false;
  std::vector<double> roughness;    ///< ascending, in (0, 1]
  std::vector<double> ior;          ///< of dielectrics
  std::vector<std::string> metals;  ///< symbols
  std::vector<double> gamma;        ///< of GTR truths
  std::size_t bins;                 ///< of a slice, along each axis
  /// Walks for each value of a surface of roughness 1.  On smoother ones few walks meet a second facet: there they are
  /// 1/alpha times as many, up to 16 times.
  std::size_t walks;
  std::vector<std::string> forms{};  ///< names of forms, beside "exact"; empty: all
  bool published = false;            ///< published fits too
};
/// Standard: by 0.1 in roughness; full: by 0.05, and more materials.
CrossFitOptions cross_fit_options(bool full);

CrossFitRows cross_fit_rows(const CrossFitOptions&, const ReportProgress& done = {});
/// Shifts of roughness and F0 of every form that was fitted by more than one metric: none of them holds for another metric,
/// or over other directions.
std::vector<CrossRange> ranges(const CrossFitRows&);
/// Sentences for each form and truth.
std::vector<CrossSentence> sentences_of_forms(const CrossFitRows&);
Findings findings(const CrossFitRows&);
Facts facts(const CrossFitRows&);
/// Pictures of the page, by family: maps matrix of quantity and roughness ("all": RMS), truth × form; figures shifts of truth, kind,
/// material and quantity, compared of form, material and quantity.
Pictures pictures(const CrossFitRows&);

using CrossFitReport = Report<CrossFitRows>;
CrossFitReport cross_fit_report(const CrossFitOptions&, const ReportProgress& done = {});

/// Document {"rows": […], …}: flat objects; what is not known is null.
std::string to_json(const CrossFitReport&);
/// Its rows as CSV.
std::string rows_csv(const CrossFitReport&);
/// JSON Schema of the document.
std::string cross_fit_schema();
/// Its page.
page::Page report_page(const CrossFitReport&);

}  // namespace gonio
