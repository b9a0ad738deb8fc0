#pragma once
/// \file
/// The atlas of numerical stability: from which inputs on each form of the catalogue fails in each number, what the clamps
/// that shaders ship cost and save, and which form to take instead.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reports/finding/report.h"
#include "stability/evidence.h"

namespace gonio {

namespace page {
struct Page;
}

/// A form in a number over the hard domain.
struct StabilityRow {
  std::string id, form;  ///< form: how its angles are given, stability::Given
  std::string number;    ///< with what else is done to it: "half, flushed", "half, contracted"
  stability::Evidence evidence;
  double worst_ulp;
  double ulp_beyond;  ///< most units over what a unit of the inputs is worth there, where that is
                      ///< above one
  double worst_rel;
  std::optional<double> proved_rel;  ///< bound of the relative error, where one is proved
  double condition;                  ///< of the inputs where worst_ulp is
  std::string at, inputs_hex;  ///< where worst_rel is: "alpha 0.01, noh 1", and the same in bits
  std::string flags;         ///< that a half raises on the way there: "overflow", "underflow", both
  std::uint64_t nonfinite;   ///< inputs without a value, of those looked at
  std::string nonfinite_at;  ///< the first
  std::uint64_t negative, overflow, vanished, irreciprocal, not_monotone;
  std::string decides;  ///< the parameter that people clamp; empty: there is none
  std::optional<double>
      safe_from;     ///< of it: from there on the tolerance is kept by every input looked at
  double tolerance;  ///< relative; of a Fresnel term in few bits, which may be next to 0, absolute
  bool is_absolute;
  std::uint64_t lost;                 ///< inputs that do not keep it
  std::optional<double> finite_from;  ///< of it: from there on a value is proved for every input
  std::uint64_t evaluations;
  bool settled;  ///< searches from two seeds agree within a factor of two
  std::string
      stable;  ///< id of the form that stands for the same without the fault; empty: this one
  std::size_t operations;         ///< of one sample
  std::size_t stable_operations;  ///< of that form
  /// True where a target is not kept.  Float and double: more than 8 units beyond what the inputs' rounding is worth, no
  /// value or a negative one.  Half and mixed: less than the tolerance from alpha 0.05 on, or of other parameters anywhere.
  bool misses;
  std::string reason;  ///< why; empty: it does not
  /// Most relative error of alpha from 0.05 on, of a distribution in half or mixed that misses; none: nobody looked.
  std::optional<double> worst_from_usual;
};

/// A clamp that shaders ship: a form with it and the same without, in a number, over the same inputs.
struct ClampRow {
  std::string clamp, where;  ///< "min(D, 2048)", id of the form that has it
  std::string by;            ///< "alpha", or "cosine": the smaller of NoL and NoV
  std::string number;
  /// Largest of these at which an input has no value; none: everywhere there is one.
  std::optional<double> no_value_without, no_value_with;
  double worst_without, worst_with;  ///< most relative error against the form without it in double
  std::optional<double>
      changed_to;  ///< largest of these at which it changes a value by more than 1 %, in double
  double changed_most;  ///< most |with / without − 1|, in double
};

/// A form under all that Vulkan allows a GPU (gonio stability --any-gpu), over a domain that is smaller than the hard one.
struct AnyGpuRow {
  std::string id, form, number;
  std::string domain;  ///< for which the bound is proved: "alpha 0.001 to 1, nol 0.001 to 1 …"
  stability::Evidence evidence;
  std::optional<double> proved_rel;  ///< bound of the relative error
  bool keeps;                        ///< it is at most `any_gpu_tolerance`
  bool finite;                       ///< a value is proved for every input of the domain
  std::string why;                   ///< where it is not proved to keep the tolerance
};
constexpr double any_gpu_tolerance = 0.01;

/// A form whose sums and products a compiler regroups (stability/regroup.h), over a domain that is smaller than the hard one.
struct OrderRow {
  std::string id, form, number;
  double written,
      regrouped;           ///< most relative error in the formula's own order, and over all orders
  std::string at;          ///< inputs where the second is
  std::uint64_t no_value;  ///< inputs without a value in the formula's own order
  std::uint64_t lost;      ///< further ones without a value in some order
  std::uint64_t inputs;    ///< that were looked at

  /// True where the formula keeps the number's usual tolerance as it is written, and in some order it does not.
  bool needs_precise() const;
};

/// GGX under correlated Smith and Schlick on metal, as D V F and then NoL, for light and view up to a zenith angle.
struct HighlightRow {
  std::string id, number;
  double zenith_deg;
  double least_f0;                    ///< of a metal: F0 from there to 1
  double tolerance;                   ///< relative, a tenth more than the search asks for
  std::optional<double> safe_from;    ///< alpha from which a search finds none that breaks it
  std::optional<double> finite_from;  ///< alpha from which it finds a value for every input
};

struct StabilityRows {
  std::vector<StabilityRow> rows;
  std::vector<HighlightRow> highlights;
  std::vector<ClampRow> clamps;
  std::vector<AnyGpuRow> any_gpu;
  std::vector<OrderRow> orders;
  /// Curves of the worst relative error over all angles by a form's alpha: NaN where an input has no value.
  struct ByAlpha {
    std::string id, form, number;
    std::vector<double> alpha, worst;
  };
  std::vector<ByAlpha> by_alpha;
  /// Relative error by alpha and angle, the worst of each cell: [alpha][angle].
  struct Map {
    std::string id, form, number;
    std::vector<double> alpha, angle, error;
  };
  std::vector<Map> maps;
};

/// Setting: what is looked at, and for how long.
struct StabilityOptions {
  /// brief: distributions, masking and Fresnel forms that people ship, in half, mixed and float; quick: every form in every number.
  /// Half is also flushed where every half is looked at, and but for brief contracted; full: both for all, and longer searches.
  enum class Setting { brief, quick, full } setting = Setting::quick;
  std::vector<std::string> ids{};  ///< empty: as the setting says
};

StabilityRows stability_rows(const StabilityOptions&, const ReportProgress& done = {});
std::vector<HighlightRow> highlight_rows();
std::vector<ClampRow> clamp_rows();
/// Row of the form to take in place of r's, with NoH from a cross product: one that is safe from a smaller alpha in the same
/// number; null: none is.
const StabilityRow* better_form(const std::vector<StabilityRow>&, const StabilityRow& r);
std::vector<AnyGpuRow> any_gpu_rows(const StabilityOptions&);
std::vector<OrderRow> order_rows(const StabilityOptions&);
std::vector<StabilityRows::ByAlpha> errors_by_alpha(bool all);
std::vector<StabilityRows::Map> error_maps(bool all);

Findings findings(const StabilityRows&);
Facts facts(const StabilityRows&);
/// Pictures of the page, by family: figures error_by_alpha of number and kind; maps error of form and number.
Pictures pictures(const StabilityRows&);

using StabilityReport = Report<StabilityRows>;
StabilityReport stability_report(const StabilityOptions&, const ReportProgress& done = {});

/// Document {"rows": […], …}: flat objects; what is not known is null.
std::string to_json(const StabilityReport&);
/// Its rows as CSV.
std::string rows_csv(const StabilityReport&);
/// JSON Schema of the document.
std::string stability_schema();
/// Its page.
page::Page report_page(const StabilityReport&);

}  // namespace gonio
