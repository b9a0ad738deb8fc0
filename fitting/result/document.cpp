#include "fitting/result/document.h"

#include "base/file.h"
#include "base/json_reader.h"

namespace gonio {
namespace {

constexpr const char* kSchema = "gonio.fit/1";

Json parameters(const FitDocument& d) {
  Json all = Json::object();
  for (const auto& p : d.parameters) {
    Json& j = all[p.name];
    j["value"] = per_channel(p.value);
    j["std_error"] = per_channel(p.std_error);
    j["ci95"] = per_channel(p.ci95_low.size(), [&](std::size_t c) {
      return Json::array({p.ci95_low[c], p.ci95_high[c]});
    });
    j["status"] =
        per_channel(p.status.size(), [&](std::size_t c) { return Json(name_of(p.status[c])); });
  }
  return all;
}

Json residuals(const FitResiduals& r) {
  Json bands = Json::array();
  for (const auto& b : r.bands)
    bands.push_back({{"angle", b.angle},
                     {"from_deg", b.from_deg},
                     {"to_deg", b.to_deg},
                     {"values", b.values},
                     {"rms", b.rms},
                     {"log_rms", b.log_rms}});
  return {{"rms", r.rms}, {"log_rms", r.log_rms}, {"bands", bands}};
}

Json solver(const FitSolver& s) {
  Json times = Json::object();
  for (const auto& [phase, ms] : s.phase_ms)
    times[phase.ends_with("_ms") ? phase : phase + "_ms"] = ms;
  return {{"termination", s.termination},
          {"message", s.message},
          {"iterations", s.iterations},
          {"passes", s.passes},
          {"cost_per_iteration", s.cost_per_iteration},
          {"instruction_set", s.instruction_set},
          {"time_ms", times}};
}

Json input(const FitDocument& d) {
  return {{"path", d.input_path}, {"sha256", d.input_sha256},     {"format", d.input_format},
          {"bins", d.bins},       {"values_used", d.values_used}, {"masked", d.masked}};
}

Json bin_sensitivity(const std::vector<BinSensitivity>& all) {
  Json out = Json::array();
  for (const auto& s : all)
    out.push_back({{"other", s.other},
                   {"relative_change", per_name(s.relative_change)},
                   {"log_rms", s.log_rms}});
  return out;
}

}  // namespace

std::string to_json(const FitDocument& d) {
  return text_of(
      {{"schema", kSchema},
       {"model", d.model},
       {"channels", d.channels},
       {"warnings", d.warnings},
       {"parameters", parameters(d)},
       {"metric", d.metric},
       {"log_offset", d.log_offset},
       {"robust", d.robust},
       {"cost", d.cost},
       {"intervals", d.intervals},
       {"clusters", d.clusters},
       {"residuals", residuals(d.residuals)},
       {"identifiability",
        {{"names", d.free_names}, {"correlations", d.correlations}, {"condition", d.condition}}},
       {"solver", solver(d.solver)},
       {"input", input(d)},
       {"bin_sensitivity", bin_sensitivity(d.sensitivity)}});
}

std::string to_json(const Comparison& c) {
  return text_of({{"path", c.path},
                  {"model", c.model.model},
                  {"parameters", per_name(c.model.parameters)},
                  {"residuals", residuals(c.residuals)}});
}

FittedModel read_fitted_model(const std::string& path) {
  InputFile file(path);
  const Json document = parse_json(path, file.read_rest(std::uint64_t{1} << 26));
  const JsonReader root(path, document);
  if (root.at("schema").string() != kSchema) root.at("schema").fail(kSchema);
  FittedModel fit{root.at("model").string(), {}};
  for (const auto& [name, parameter] : root.at("parameters").members())
    fit.parameters.emplace_back(name, parameter.at("value").numbers());
  return fit;
}

}  // namespace gonio
