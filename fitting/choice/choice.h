#pragma once
/// \file
/// Choice among models for one table: what each leaves, on angles that it was not fitted to, and which to take.

#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "brdf/model/model.h"
#include "fitting/result/document.h"
#include "fitting/solve/options.h"
#include "table/table.h"

namespace gonio {

/// One model beside the others.
struct ModelRow {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  std::string model;
  std::string note;       ///< why it cannot be compared, or what to beware of; else empty
  bool compared = false;  ///< false: all figures are unknown
  bool converged = false;
  bool misses = false;         ///< whether it misses the table by more than noise, see Misfit
  std::size_t parameters = 0;  ///< free ones, each channel's counted
  double log_rms = unknown;
  double cv_log_rms = unknown;  ///< of incident angles that the fit had not seen
  /// By how much its mean square on these is above the least of all, in standard errors over the blocks.
  double cv_behind = unknown;
  double aic = unknown, bic = unknown;
  double delta_e_2000 = unknown,
         delta_e_itp = unknown;  ///< of a rendered sphere; the caller's to fill in
  double ns = unknown;           ///< of one sample in all channels [ns]
  double ns_spread = unknown;    ///< half the distance of the quartiles over repetitions
  std::vector<std::string> parameters_at_bound;
};

/// Models of one table side by side.
struct ModelChoice {
  std::vector<ModelRow> rows;    ///< in the order asked
  std::vector<BoundModel> fits;  ///< of each row; empty models where there is none
  /// Values that would say as much if each were independent: what AIC and BIC count.
  double effective_values = ModelRow::unknown;
  /// Noise floor that log RMS counts from, as a fit by log does [1/sr]; 0: values count as they are.
  double log_offset = 0;
  std::size_t blocks = 0;             ///< of incident angles
  std::vector<std::string> warnings;  ///< of the table's values, whatever the model
};

/// What log RMS counts from where there is a floor, in a sentence; empty without.
std::string floor_in_words(const ModelChoice&);

/// Models that are compared where `all` is asked for.
std::span<const std::string_view> usual_models();
/// Models that `--models` names: `all` is the usual ones, which others follow that are named beside it.
/// \throws Error  wrong_usage of a model that is there twice, of a word that no model has
std::vector<std::string> models_asked(std::vector<std::string> names);

/// Fits of each model, judged side by side:
///
///   cv_log_rms   log RMS over blocks of incident angles, each predicted by a fit of the others
///   aic          n ln(RMS²) + 2 p,   bic   n ln(RMS²) + p ln n,   with n effective_values and p parameters
///
/// n is the number of values over their design effect 1 + (m − 1) ρ, m values an incident angle, ρ the correlation of the residuals
/// within one: of the model that leaves least.                                              [Kish 1965]
///
/// A model that this table cannot be fitted with stays among the rows, with the reason; where that is all of them, the first one's
/// error is thrown.  A setting holds for the models that have its parameter; wrong usage where none has.
/// \param progress  is told what is done and the share of all
ModelChoice compare_models(const Table&,
                           const FitOptions&,
                           std::span<const std::string> models,
                           const std::function<void(const std::string&, double)>& progress = {});

/// The same of options whose scale may be free: the table is then multiplied by a factor that makes it dark, each lobe gets a weight,
/// and the choice says so.  Throws wrong usage where none of the models can have weights.
ModelChoice compare_on_scale(Table&,
                             const FitOptions&,
                             std::vector<std::string> models,
                             const std::function<void(const std::string&, double)>& progress = {});

/// Recommendation, and why.
struct Advice {
  bool none_fits = false;                 ///< whether all miss the table by more than noise
  std::string recommended;                ///< model; empty where none could be compared
  std::string reason;                     ///< one sentence
  std::vector<std::string> as_good;       ///< models that the table cannot tell from it
  std::vector<std::string> disagreement;  ///< sentences: what other judges prefer
  std::vector<std::string> beware;        ///< sentences: what the one that is taken does not do
};

/// Models cannot be told from the one that predicts best where they leave so much more log RMS on unseen angles at most, as a part of
/// it, or as much as chance makes of few values; and are behind by Student's t standard errors over the blocks at most.  Or they
/// leave so little more that it is nothing.
inline constexpr double most_more = 0.05, next_to_nothing_more = 0.001;
/// What BIC prefers by more is better, and so is what leaves half the log RMS on unseen angles.
inline constexpr double decisive_bic = 10, most_more_by_chance = 1;
/// Log RMS from which on a model is not near its table.
inline constexpr double far_off = 0.25;

/// The least parameters among the models that cannot be told from the one that predicts best.  Among as many parameters the one that
/// predicts best.  Without blocks BIC decides.  A fit that did not converge is taken only where none did.  Where none fits, the nearest
/// is still named.
Advice advise(const ModelChoice&);

}  // namespace gonio
