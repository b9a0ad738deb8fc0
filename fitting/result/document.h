#pragma once
/// \file
/// The result of a fit as plain data: what fitting/ fills in, fit.json holds and pages show.

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/names.h"
#include "brdf/model/fitted_model.h"
#include "table/health/health.h"

namespace gonio {

enum class ParameterStatus {
  free,
  fixed,
  at_bound,
  not_identifiable,
  upper_limit,
  lower_limit,
  unbounded  ///< the best value of this model, which misses the table by too much to bound it
};
template <>
inline constexpr std::array<std::string_view, 7> names_of<ParameterStatus>{
    "free", "fixed", "at_bound", "not_identifiable", "upper_limit", "lower_limit", "unbounded"};

/// One parameter, one entry per channel where it has channels.  NaN stands for "not known": the
/// value and error of a parameter that is not identifiable, the error of a fixed one.
struct FittedParameter {
  std::string name;
  std::vector<double> value, std_error, ci95_low, ci95_high;
  std::vector<ParameterStatus> status;
  std::vector<double> limit = {};  ///< one-sided 95 % bound of an upper or lower limit
  std::vector<std::string> reason =
      {};  ///< why there is no value, interval or limit, or what fixed its order; else empty
  std::vector<double> excluded = {};  ///< value of the fit, where it lies beyond `limit`
};

struct FitSolver {
  std::string termination;         ///< "converged" or "not_converged"
  std::string message;             ///< why the search ended
  int iterations = 0, passes = 0;  ///< over the full data, the passes of trial steps included
  std::vector<double> cost_per_iteration;  ///< of the full data, ½ Σ ρ
  std::string instruction_set;
  std::vector<std::pair<std::string, double>> phase_ms;  ///< load, columns, start, solve, …
};

/// RMS of a band of angles, over all channels.
struct ResidualBand {
  std::string angle;  ///< "theta_i", "theta_h" or "theta_d"
  double from_deg, to_deg;
  std::size_t values;
  double rms;      ///< of f − y [1/sr]
  double log_rms;  ///< of ln f − ln y, where both are positive
};

struct FitResiduals {
  double rms = 0, log_rms = 0;
  std::vector<ResidualBand> bands;
  std::optional<double> chi2_per_freedom = {};  ///< where the table states uncertainties
};

/// Change of the parameters if the samples sat at the other place in their bins.
struct BinSensitivity {
  std::string other;  ///< the convention not used
  std::vector<std::pair<std::string, std::vector<double>>> relative_change;
  double log_rms = 0;       ///< under the other convention
  double log_rms_here = 0;  ///< under that of the fit, of the same samples
};

/// Cell of a certificate.
struct CertificateCell {
  std::vector<double> at;  ///< values of the parameters
  double cost = 0;         ///< of a thinned table
  double cost_of_all = 0;  ///< of all values; NaN where that was not asked
};

/// Search for a lower optimum: the cost over one or two parameters, all others solved for anew.
struct Certificate {
  std::string evidence;                 ///< "searched", or "open" where there was nothing to search
  std::vector<std::string> parameters;  ///< the axes
  double lowest = 0;        ///< cost of all values in the lowest cell; NaN without cells
  double thinned_cost = 0;  ///< of the thinned table where it is lowest
  int moves = 0;            ///< times that the fit went on from a lower cell
  std::vector<CertificateCell> cells;
};

/// Cell of the residual map.
struct MisfitCell {
  double theta_h_from_deg, theta_h_to_deg, theta_d_from_deg, theta_d_to_deg;
  std::size_t values;
  double difference;  ///< mean of model over data, less 1
};

/// Residuals that follow the angles, as those of the right model do not.
struct Misfit {
  bool tested = false;
  double p = std::numeric_limits<double>::quiet_NaN();     ///< probability by luck alone
  double size = std::numeric_limits<double>::quiet_NaN();  ///< beyond noise, as the log RMS counts
  bool told = false;                 ///< whether it is significant and large enough to matter
  std::vector<std::string> follows;  ///< "theta_h", "theta_d", "grazing angles": the most of it
  std::optional<MisfitCell> worst_cell;
  std::string note;          ///< why it was not tested
  bool too_few = false;      ///< whether values or angles are too few to tell
  std::size_t outliers = 0;  ///< number of values that lie alone
  /// True where nothing is left but noise, or the values' own rounding.
  bool reproduces() const { return !told && !too_few; }
};

/// Model beside the table as physics sees them.
struct Physics {
  std::vector<double> theta_i_deg;
  std::vector<std::vector<double>> model_albedo, data_albedo;  ///< [angle][channel]; NaN: not known
  std::vector<double> peak_ratio;  ///< by channel: greatest of the model over that of the table
};

/// One parameter's value over another's, of a fit whose scale is free.
struct Ratio {
  std::string of, to;  ///< "kd.g", "kd.r"
  double value, ci95_low, ci95_high;
};

struct FitDocument {
  std::string model;
  std::vector<std::string> channels;  ///< of the table, as parameters with channels are indexed
  std::vector<std::string> warnings;  ///< what a reader must know before believing the numbers
  std::vector<std::string> next;      ///< what may help, see next_steps()
  std::vector<FittedParameter> parameters;  ///< alpha and roughness both
  std::optional<std::vector<Ratio>> ratios =
      {};  ///< of what is known up to one factor, where the scale is free
  std::string metric;
  double log_offset = 0;  ///< [1/sr] of the log metric
  std::string robust = "none";
  double cost = 0;
  std::string intervals;  ///< how the standard errors were made: "independent" or "clustered by …"
  std::size_t clusters = 0;

  FitResiduals residuals;
  Misfit misfit;
  Physics physics;
  std::vector<std::string>
      free_names;  ///< "alpha", "f0.r" …, rows of the matrix below; see Uncertainty
  std::vector<std::vector<double>> correlations;  ///< of the free parameters' estimates
  double condition = 0;                           ///< of the scaled normal matrix
  FitSolver solver;

  std::string input_path, input_sha256, input_format;
  std::string bins;                                      ///< "centre", "edge" or "none"
  std::string uncertainty = "none";                      ///< or "stated", of each value
  std::optional<std::vector<double>> aperture_deg = {};  ///< of light and detector, if known
  std::size_t values_used = 0;
  std::map<std::string, std::size_t> masked;  ///< values left out, by reason
  std::optional<std::string> mask = {};       ///< expression of --mask
  std::vector<BinSensitivity> sensitivity;    ///< empty where there are no bins
  std::optional<Certificate> certificate;     ///< none where it was not asked for
};

/// The document as JSON text, schema "gonio.fit/1"; what is not a finite number is null.
std::string to_json(const FitDocument&);

/// Residuals of a model against a table.
struct Comparison {
  std::string path;  ///< of the table
  FittedModel model;
  FitResiduals residuals;
};
/// {"path", "model", "parameters": {NAME: number or array}, "residuals" as in a fit document}
std::string to_json(const Comparison&);
/// JSON Schema of that document.  (Of a fit document, see fitting/batch/batch_document.h.)
std::string comparison_schema();

}  // namespace gonio
