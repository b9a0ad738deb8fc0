#pragma once
/// \file
/// Description of a fit document.

#include <array>

#include "base/describe.h"
#include "fitting/result/document.h"

namespace gonio {

template <>
struct Description<FittedParameter> {
  static constexpr auto fields() {
    return std::tuple{field("value", per_channel(&FittedParameter::value),
                            "fitted value; null where the data cannot tell"),
                      field("std_error", per_channel(&FittedParameter::std_error),
                            "standard error; null where it is not known"),
                      field("ci95", per_channel([](const FittedParameter& p) {
                              std::vector<std::array<double, 2>> ends;
                              for (std::size_t c = 0; c < p.ci95_low.size(); ++c)
                                ends.push_back({p.ci95_low[c], p.ci95_high[c]});
                              return ends;
                            }),
                            "ends of the 95 % confidence interval"),
                      field("status", per_channel(&FittedParameter::status), ""),
                      field("limit", per_channel(&FittedParameter::limit),
                            "one-sided 95 % bound where the status is upper_limit or lower_limit"),
                      field("reason", per_channel(&FittedParameter::reason),
                            "why no more is known, or what fixed its order; else empty")};
  }
};

template <>
struct Description<ResidualBand> {
  static constexpr auto fields() {
    return std::tuple{
        field("angle", &ResidualBand::angle, "theta_i, theta_h or theta_d"),
        field("from_deg", "°", &ResidualBand::from_deg, ""),
        field("to_deg", "°", &ResidualBand::to_deg, ""),
        field("values", &ResidualBand::values, "number of values"),
        field("rms", "1/sr", &ResidualBand::rms, "RMS of f − y"),
        field("log_rms", &ResidualBand::log_rms, "RMS of ln f − ln y, where both are positive")};
  }
};

template <>
struct Description<FitResiduals> {
  static constexpr auto fields() {
    return std::tuple{
        field("rms", "1/sr", &FitResiduals::rms, "RMS of f − y"),
        field("log_rms", &FitResiduals::log_rms, "RMS of ln f − ln y, where both are positive"),
        field("bands", &FitResiduals::bands, "RMS by bands of angles")};
  }
};

template <>
struct Description<FitSolver> {
  static constexpr auto fields() {
    return std::tuple{field("termination", &FitSolver::termination, "converged or not_converged"),
                      field("message", &FitSolver::message, "why the search ended"),
                      field("iterations", &FitSolver::iterations, ""),
                      field("passes", &FitSolver::passes, "passes over the full data"),
                      field("cost_per_iteration", &FitSolver::cost_per_iteration, ""),
                      field("instruction_set", &FitSolver::instruction_set, ""),
                      field(
                          "time_ms", "ms",
                          [](const FitSolver& s) {
                            auto times = s.phase_ms;
                            for (auto& [phase, ms] : times)
                              if (!phase.ends_with("_ms")) phase += "_ms";
                            return times;
                          },
                          "time of each phase")};
  }
};

template <>
struct Description<BinSensitivity> {
  static constexpr auto fields() {
    return std::tuple{field("other", &BinSensitivity::other, "bin convention that was not used"),
                      field("relative_change", per_name(&BinSensitivity::relative_change),
                            "change of each parameter under it"),
                      field("log_rms", &BinSensitivity::log_rms, "RMS of ln f − ln y under it")};
  }
};

template <>
struct Description<CertificateCell> {
  static constexpr auto fields() {
    return std::tuple{field("at", &CertificateCell::at, "values of the parameters"),
                      field("cost", &CertificateCell::cost, "least cost of a thinned table there"),
                      field("cost_all", &CertificateCell::cost_of_all,
                            "that of all values, in the lowest cells; null elsewhere")};
  }
};

template <>
struct Description<Certificate> {
  static constexpr auto fields() {
    return std::tuple{
        field("evidence", &Certificate::evidence,
              "searched: no proof; open where no width is free"),
        field("parameters", &Certificate::parameters, "axes of the search"),
        field("lowest", &Certificate::lowest, "least cost of all values among the cells"),
        field("thinned_cost", &Certificate::thinned_cost, "least cost of the thinned table"),
        field("moves", &Certificate::moves, "times that the fit went on from a lower place"),
        field("cells", &Certificate::cells, "the last parameter runs fastest")};
  }
};

template <>
struct Description<MisfitCell> {
  static constexpr auto fields() {
    return std::tuple{
        field("theta_h_from_deg", "°", &MisfitCell::theta_h_from_deg, ""),
        field("theta_h_to_deg", "°", &MisfitCell::theta_h_to_deg, ""),
        field("theta_d_from_deg", "°", &MisfitCell::theta_d_from_deg, ""),
        field("theta_d_to_deg", "°", &MisfitCell::theta_d_to_deg, ""),
        field("values", &MisfitCell::values, "number of values looked at"),
        field("difference", &MisfitCell::difference, "mean of model over data, less 1")};
  }
};

template <>
struct Description<Misfit> {
  static constexpr auto fields() {
    return std::tuple{
        field("tested", &Misfit::tested, "whether the residuals could be tested"),
        field("p", &Misfit::p, "probability that luck alone has them follow the angles so"),
        field("size", &Misfit::size, "RMS of what follows the angles, of f"),
        field("told", &Misfit::told, "whether it is significant and large enough to matter"),
        field("follows", &Misfit::follows, "angles that most of it follows"),
        field("worst_cell", &Misfit::worst_cell, "cell of the residual map that is furthest off"),
        field("note", &Misfit::note, "why it was not tested")};
  }
};

template <>
struct Description<Physics> {
  static constexpr auto fields() {
    return std::tuple{
        field("theta_i_deg", "°", &Physics::theta_i_deg, "angles of incidence"),
        field("model_albedo", &Physics::model_albedo,
              "share of the light that the model returns, by angle and channel"),
        field("data_albedo", &Physics::data_albedo,
              "that of the table; null where its samples do not say"),
        field("peak_ratio", &Physics::peak_ratio,
              "greatest value of the model at the samples over the greatest of these, by channel")};
  }
};

template <>
struct Description<FitDocument> {
  static constexpr auto fields() {
    return std::tuple{
        constant_text("schema", "gonio.fit/1"),
        field("model", &FitDocument::model, ""),
        field("channels", &FitDocument::channels, "channels of the table, in the order of arrays"),
        field("warnings", &FitDocument::warnings, "sentences to know before believing the numbers"),
        field("next", &FitDocument::next,
              "sentences on what to try, the most promising first; models as --model takes them"),
        field("parameters", by_name(&FitDocument::parameters), ""),
        field("metric", &FitDocument::metric, "how values were compared"),
        field("log_offset", "1/sr", &FitDocument::log_offset, "offset of the log metric"),
        field("robust", &FitDocument::robust, "none or huber"),
        field("cost", &FitDocument::cost, "half the sum of the losses"),
        field("intervals", &FitDocument::intervals, "how the standard errors were made"),
        field("clusters", &FitDocument::clusters, "number of clusters of errors"),
        field("residuals", &FitDocument::residuals, ""),
        group("identifiability", "how well the free parameters can be told apart",
              field("names", &FitDocument::free_names, "rows of the matrix"),
              field("correlations", &FitDocument::correlations, "of the estimates"),
              field("condition", &FitDocument::condition, "of the scaled normal matrix")),
        field("misfit", &FitDocument::misfit, "residuals that follow the angles"),
        field("physics", &FitDocument::physics, "what the model does to light"),
        field("solver", &FitDocument::solver, ""),
        group("input", "the table", field("path", &FitDocument::input_path, ""),
              field("sha256", &FitDocument::input_sha256, "of the file's bytes"),
              field("format", &FitDocument::input_format, ""),
              field("bins", &FitDocument::bins, "centre, edge or none"),
              field("values_used", &FitDocument::values_used, ""),
              field("masked", &FitDocument::masked, "values left out, by reason")),
        field("bin_sensitivity", &FitDocument::sensitivity, "empty where there are no bins"),
        field("certificate", &FitDocument::certificate,
              "search for a lower optimum; null where none was asked for")};
  }
};
static_assert(describes_every_member<FitDocument>());

template <>
struct Description<Comparison> {
  static constexpr auto fields() {
    return std::tuple{
        field("path", &Comparison::path, "path of the table"),
        field("model", at(&Comparison::model, &FittedModel::model), ""),
        field("parameters", per_name(at(&Comparison::model, &FittedModel::parameters)), ""),
        field("residuals", &Comparison::residuals, "as in a fit document")};
  }
};

}  // namespace gonio
