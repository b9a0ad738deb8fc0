#include "fitting/choice/document.h"

#include <cmath>
#include <optional>

#include "base/json/form.h"

namespace gonio {
namespace {

struct RowFile {
  std::string model;
  std::optional<std::string> note;
  bool converged = false;
  std::uint64_t parameters = 0;
  std::optional<double> log_rms, cv_log_rms, cv_behind, aic, bic, delta_e_2000, delta_e_itp, ns,
      ns_spread;
  std::vector<std::string> parameters_at_bound;
};
template <class Form>
void keys(Form& f, RowFile& r) {
  constexpr Numbers amounts{0, Numbers::any};
  f.required("model", r.model, "spec or preset, as asked");
  f.required("converged", r.converged, "false of one that was not compared, too");
  f.optional("note", r.note, "why it could not be compared, or what to beware of");
  f.required("parameters", r.parameters, "free values, each channel's counted");
  f.optional("log_rms", r.log_rms, "of ln f − ln y over the table", amounts);
  f.optional("cv_log_rms", r.cv_log_rms, "on incident angles that the fit had not seen", amounts);
  f.optional(
      "cv_behind", r.cv_behind,
      "standard errors, over blocks of angles, that its mean square there is above the least",
      amounts);
  f.optional("aic", r.aic, "Akaike's criterion at effective_values", Numbers{});
  f.optional("bic", r.bic, "Schwarz's criterion at effective_values", Numbers{});
  f.optional("delta_e_2000", r.delta_e_2000,
             "of a sphere beside the table's, median pixel, mean of three lights", amounts);
  f.optional("delta_e_itp", r.delta_e_itp, "the same by ΔE_ITP, white at 203 cd/m²", amounts);
  f.optional("ns", r.ns, "of a sample in all channels, in float", amounts);
  f.optional("ns_spread", r.ns_spread, "half the distance of the quartiles", amounts);
  f.required("parameters_at_bound", r.parameters_at_bound,
             "whose values the data push beyond their range");
}

struct InputFile {
  std::string path, sha256, format;
};
template <class Form>
void keys(Form& f, InputFile& i) {
  f.required("path", i.path, "");
  f.required("sha256", i.sha256, "of the file");
  f.required("format", i.format, "");
}

struct ModelsFile {
  InputFile input;
  std::string metric;
  std::vector<RowFile> models;
  std::optional<double> effective_values;
  std::uint64_t blocks = 0;
  std::optional<std::string> recommended, reason;
  std::vector<std::string> as_good, disagreement, beware;
};
template <class Form>
void keys(Form& f, ModelsFile& m) {
  f.constant("schema", "gonio.models/1");
  f.required("input", m.input, "table");
  f.required("metric", m.metric, "that the fits minimise");
  f.required("models", m.models, "in the order asked");
  f.optional("effective_values", m.effective_values,
             "independent values that the table's are worth", Numbers{0, Numbers::any});
  f.required("blocks", m.blocks,
             "of incident angles that were left out in turn; 0: too few angles");
  f.optional("recommended", m.recommended, "model");
  f.optional("reason", m.reason, "one sentence");
  f.required("as_good", m.as_good, "models that the table cannot tell from it");
  f.required("disagreement", m.disagreement, "what other judges prefer, in sentences");
  f.required("beware", m.beware, "what the recommended one does not do, in sentences");
}

std::optional<std::string> if_any(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional(text);
}
std::optional<double> known(double x) {
  return std::isfinite(x) ? std::optional(x) : std::nullopt;
}

}  // namespace

std::string to_json(const ModelChoice& choice, const Advice& advice, const ComparedTable& t) {
  ModelsFile f{{t.path, t.sha256, t.format},
               t.metric,
               {},
               known(choice.effective_values),
               choice.blocks,
               {},
               {},
               advice.as_good,
               advice.disagreement,
               advice.beware};
  for (const auto& r : choice.rows)
    f.models.push_back({r.model, if_any(r.note), r.converged, r.parameters, known(r.log_rms),
                        known(r.cv_log_rms), known(r.cv_behind), known(r.aic), known(r.bic),
                        known(r.delta_e_2000), known(r.delta_e_itp), known(r.ns),
                        known(r.ns_spread), r.parameters_at_bound});
  if (!advice.recommended.empty()) {
    f.recommended = advice.recommended;
    f.reason = advice.reason;
  }
  return text_of(form_json(f));
}

std::string models_schema() {
  return form_schema<ModelsFile>("Models compared on a table");
}

}  // namespace gonio
