#pragma once
/// \file
/// Description of a fit document.

#include <array>

#include "base/describe.h"
#include "brdf/model/own_files.h"
#include "fitting/result/document.h"

namespace gonio {

template <>
inline constexpr auto description<FittedParameter> =
    FieldList{Field{"value", per_channel(&FittedParameter::value),
                    "fitted value; null where the data cannot tell"},
              Field{"std_error", per_channel(&FittedParameter::std_error),
                    "standard error; null where it is not known"},
              Field{"ci95", per_channel([](const FittedParameter& p) {
                      std::vector<std::array<double, 2>> ends;
                      for (std::size_t c = 0; c < p.ci95_low.size(); ++c)
                        ends.push_back({p.ci95_low[c], p.ci95_high[c]});
                      return ends;
                    }),
                    "ends of the 95 % confidence interval"},
              Field{"status", per_channel(&FittedParameter::status), ""},
              Field{"limit", per_channel(&FittedParameter::limit),
                    "one-sided 95 % bound where the status is upper_limit or lower_limit"},
              Field{"excluded", per_channel(&FittedParameter::excluded),
                    "value of the fit where `limit` excludes it, and so no `value`; else null"},
              Field{"reason", per_channel(&FittedParameter::reason),
                    "why no more is known, or what fixed its order; else empty"}};

template <>
inline constexpr auto description<ResidualBand> = FieldList{
    Field{"angle", &ResidualBand::angle, "theta_i, theta_h or theta_d"},
    Field{"from_deg", "°", &ResidualBand::from_deg, ""},
    Field{"to_deg", "°", &ResidualBand::to_deg, ""},
    Field{"values", &ResidualBand::values, "number of values"},
    Field{"rms", "1/sr", &ResidualBand::rms, "RMS of f − y"},
    Field{"log_rms", &ResidualBand::log_rms, "RMS of ln f − ln y, where both are positive"}};

template <>
inline constexpr auto description<FitResiduals> = FieldList{
    Field{"rms", "1/sr", &FitResiduals::rms, "RMS of f − y"},
    Field{"log_rms", &FitResiduals::log_rms, "RMS of ln f − ln y, where both are positive"},
    Field{"bands", &FitResiduals::bands, "RMS by bands of angles"},
    Field{"chi2_per_freedom", if_there(&FitResiduals::chi2_per_freedom),
          "squares of what is left in standard uncertainties that the table states, over values "
          "less unknowns"}};

template <>
inline constexpr auto description<FitSolver> =
    FieldList{Field{"termination", &FitSolver::termination, "converged or not_converged"},
              Field{"message", &FitSolver::message, "why the search ended"},
              Field{"iterations", &FitSolver::iterations, ""},
              Field{"passes", &FitSolver::passes, "passes over the full data"},
              Field{"cost_per_iteration", &FitSolver::cost_per_iteration, ""},
              Field{"instruction_set", &FitSolver::instruction_set, ""},
              Field{"time_ms", "ms",
                    [](const FitSolver& s) {
                      auto times = s.phase_ms;
                      for (auto& [phase, ms] : times)
                        if (!phase.ends_with("_ms")) phase += "_ms";
                      return times;
                    },
                    "time of each phase"}};

template <>
inline constexpr auto description<BinSensitivity> =
    FieldList{Field{"other", &BinSensitivity::other, "bin convention that was not used"},
              Field{"relative_change", per_name(&BinSensitivity::relative_change),
                    "change of each parameter under it"},
              Field{"log_rms", &BinSensitivity::log_rms, "RMS of ln f − ln y under it"}};

template <>
inline constexpr auto description<CertificateCell> =
    FieldList{Field{"at", &CertificateCell::at, "values of the parameters"},
              Field{"cost", &CertificateCell::cost, "least cost of a thinned table there"},
              Field{"cost_all", &CertificateCell::cost_of_all,
                    "that of all values, in the lowest cells; null elsewhere"}};

template <>
inline constexpr auto description<Certificate> = FieldList{
    Field{"evidence", &Certificate::evidence, "searched: no proof; open where no width is free"},
    Field{"parameters", &Certificate::parameters, "axes of the search"},
    Field{"lowest", &Certificate::lowest, "least cost of all values among the cells"},
    Field{"thinned_cost", &Certificate::thinned_cost, "least cost of the thinned table"},
    Field{"moves", &Certificate::moves, "times that the fit went on from a lower place"},
    Field{"cells", &Certificate::cells, "the last parameter runs fastest"}};

template <>
inline constexpr auto description<MisfitCell> =
    FieldList{Field{"theta_h_from_deg", "°", &MisfitCell::theta_h_from_deg, ""},
              Field{"theta_h_to_deg", "°", &MisfitCell::theta_h_to_deg, ""},
              Field{"theta_d_from_deg", "°", &MisfitCell::theta_d_from_deg, ""},
              Field{"theta_d_to_deg", "°", &MisfitCell::theta_d_to_deg, ""},
              Field{"values", &MisfitCell::values, "number of values looked at"},
              Field{"difference", &MisfitCell::difference, "mean of model over data, less 1"}};

template <>
inline constexpr auto description<Misfit> = FieldList{
    Field{"tested", &Misfit::tested, "whether the residuals could be tested"},
    Field{"p", &Misfit::p,
          "probability that the residuals follow the angles this closely by chance"},
    Field{"size", &Misfit::size, "log RMS beyond noise"},
    Field{"told", &Misfit::told, "whether it is significant and large enough to matter"},
    Field{"follows", &Misfit::follows, "angles that most of it follows"},
    Field{
        "worst_cell", &Misfit::worst_cell,
        "cell of the residual map that is most clearly off: by its mean less two standard errors"},
    Field{"note", &Misfit::note, "why it was not tested"},
    Field{"too_few", &Misfit::too_few, "whether values or angles are too few to tell"},
    Field{"outliers", &Misfit::outliers, "number of values far from those around them"}};

template <>
inline constexpr auto description<Physics> = FieldList{
    Field{"theta_i_deg", "°", &Physics::theta_i_deg, "angles of incidence"},
    Field{"model_albedo", &Physics::model_albedo,
          "share of the light that the model returns, by angle and channel"},
    Field{"data_albedo", &Physics::data_albedo,
          "that of the table; null where its samples do not say"},
    Field{"peak_ratio", &Physics::peak_ratio,
          "greatest value of the model at the samples over the greatest of these, by channel"}};

template <>
inline constexpr auto description<Ratio> =
    FieldList{Field{"of", &Ratio::of, "name of a parameter, with its channel"},
              Field{"to", &Ratio::to, ""}, Field{"value", &Ratio::value, "of one over the other"},
              Field{"ci95",
                    [](const Ratio& r) {
                      return std::array{r.ci95_low, r.ci95_high};
                    },
                    "ends of the 95 % confidence interval"}};

template <>
inline constexpr auto description<FitDocument> = FieldList{
    constant_text("schema", "gonio.fit/1"),
    Field{"model", &FitDocument::model, ""},
    Field{"channels", &FitDocument::channels, "channels of the table, in the order of arrays"},
    Field{"warnings", &FitDocument::warnings, "sentences to know before believing the numbers"},
    Field{"next", &FitDocument::next,
          "sentences on what to try, the most promising first; models as --model takes them"},
    Field{"parameters", by_name(&FitDocument::parameters), ""},
    Field{"ratios", if_there(&FitDocument::ratios),
          "of what is known up to one factor, where the scale is free"},
    Field{"metric", &FitDocument::metric, "how values were compared"},
    Field{"log_offset", "1/sr", &FitDocument::log_offset, "offset of the log metric"},
    Field{"robust", &FitDocument::robust, "none or huber"},
    Field{"cost", &FitDocument::cost, "half the sum of the losses"},
    Field{"intervals", &FitDocument::intervals, "how the standard errors were made"},
    Field{"clusters", &FitDocument::clusters, "number of clusters of errors"},
    Field{"residuals", &FitDocument::residuals, ""},
    Group{"identifiability", "how well the free parameters can be told apart",
          Field{"names", &FitDocument::free_names,
                "rows of the matrix; of many channels those of one"},
          Field{"correlations", &FitDocument::correlations, "of the estimates"},
          Field{"condition", &FitDocument::condition, "of the scaled normal matrix"}},
    Field{"misfit", &FitDocument::misfit, "residuals that follow the angles"},
    Field{"physics", &FitDocument::physics, "what the model does to light"},
    Field{"solver", &FitDocument::solver, ""},
    Group{"input", "the table", Field{"path", &FitDocument::input_path, ""},
          Field{"sha256", &FitDocument::input_sha256, "of the file's bytes"},
          Field{"format", &FitDocument::input_format, ""},
          Field{"bins", &FitDocument::bins, "centre, edge or none"},
          Field{"uncertainty", &FitDocument::uncertainty, "of the values: stated or none"},
          Field{"aperture", "°", if_there(&FitDocument::aperture_deg),
                "full widths of the cones of light and detector that the model was averaged over"},
          Field{"values_used", &FitDocument::values_used, ""},
          Field{"masked", &FitDocument::masked, "values left out, by reason"},
          Field{"mask", if_there(&FitDocument::mask), "expression of --mask"}},
    Field{"bin_sensitivity", &FitDocument::sensitivity, "empty where there are no bins"},
    Field{"certificate", &FitDocument::certificate,
          "search for a lower optimum; null where none was asked for"},
    Field{own_files_key, if_there([](const FitDocument& d) { return own_files({d.model}); }),
          own_files_meaning}};
static_assert(describes_every_member<FitDocument>());

template <>
inline constexpr auto description<Comparison> = FieldList{
    Field{"path", &Comparison::path, "path of the table"},
    Field{"model", at(&Comparison::model, &FittedModel::model), ""},
    Field{"parameters", per_name(at(&Comparison::model, &FittedModel::parameters)), ""},
    Field{"residuals", &Comparison::residuals, "as in a fit document"},
    Field{own_files_key, if_there([](const Comparison& c) { return own_files({c.model.model}); }),
          own_files_meaning}};

}  // namespace gonio
