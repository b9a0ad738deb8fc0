// Models: values, albedos, terms, synthesized tables, audits, the catalogue.
#include "answer/models.h"

#include <algorithm>

#include "answer/albedo.h"
#include "answer/file_functions.h"
#include "answer/model_argument.h"
#include "answer/term.h"
#include "answer/values.h"
#include "base/error.h"
#include "data_synth/synth.h"
#include "foreign/function.h"
#include "module.h"
#include "reports/audit/audit.h"
#include "reports/own/audit_file.h"
#include "table/format/measured_by.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

namespace gonio::python {
namespace {

/// Numbers that are written by several columns and then handed over, without a copy.
class Written {
 public:
  /// \param rows, columns  of an array whose rows are contiguous
  Written(std::size_t rows, std::size_t columns)
      : rows_(rows), columns_(columns), numbers_(rows * columns) {}
  double* row(std::size_t k) { return numbers_.data() + k * columns_; }
  /// With the interpreter's lock held.
  Owned hand_over() { return owning<Owned>(std::move(numbers_), {rows_, columns_}); }

 private:
  std::size_t rows_, columns_;
  Values numbers_;
};

DirectionColumns directions(const Column& theta_i,
                            const Column& phi_i,
                            const Column& theta_o,
                            const Column& phi_o) {
  for (const auto* c : {&phi_i, &theta_o, &phi_o})
    if (c->size() != theta_i.size()) throw wrong_usage("directions: columns of one length");
  const DirectionColumns at{span_of(theta_i), span_of(phi_i), span_of(theta_o), span_of(phi_o)};
  check_directions("directions", at);
  return at;
}

/// Values of all channels, [channel][sample], by what fills them.
template <class Fill>
Owned filled(std::size_t channels, std::size_t samples, const Fill& fill) {
  Written values(channels, samples);
  {
    const nb::gil_scoped_release others_run;
    std::vector<double*> rows;
    for (std::size_t c = 0; c < channels; ++c) rows.push_back(values.row(c));
    fill(std::span<double* const>(rows));
  }
  return values.hand_over();
}

Owned evaluate(const ModelArgument& m,
               const Column& theta_i,
               const Column& phi_i,
               const Column& theta_o,
               const Column& phi_o,
               int jobs) {
  const Jobs threads(jobs);
  const auto at = directions(theta_i, phi_i, theta_o, phi_o);
  return filled(m.channels.size(), at.size(),
                [&](std::span<double* const> out) { evaluate_at(m.model, at, out); });
}

Owned interpolate(const Table& t,
                  const Column& theta_i,
                  const Column& phi_i,
                  const Column& theta_o,
                  const Column& phi_o) {
  const auto at = directions(theta_i, phi_i, theta_o, phi_o);
  return filled(t.channels.size(), at.size(),
                [&](std::span<double* const> out) { interpolate_at(t, at, out); });
}

std::string albedo(const ModelArgument& m,
                   const std::string& name,
                   const AlbedoQuestion& q,
                   int jobs) {
  const Jobs threads(jobs);
  const auto step = [](const std::string&, std::size_t, std::size_t) { let_interrupt(); };
  return to_json(albedo_of(m.model, name, q, step), q);
}

Owned term(const std::string& id,
           const std::string& number,
           const std::map<std::string, double>& parameters,
           const std::map<std::string, std::vector<double>>& at) {
  std::vector<std::vector<double>> rows;
  {
    const nb::gil_scoped_release others_run;
    rows = answer(TermQuestion{id, number, parameters, at}).values;
  }
  Written values(rows.size(), rows.empty() ? 1 : rows[0].size());
  for (std::size_t k = 0; k < rows.size(); ++k) std::ranges::copy(rows[k], values.row(k));
  return values.hand_over();
}

Table synth(const ModelArgument& m,
            const std::string& layout,
            const SynthOptions& options,
            const std::string& aperture,
            int jobs) {
  const Jobs threads(jobs);
  SynthOptions s = options;
  s.layout = value_of<Layout>(layout, "layout");
  Table t = synthesize(m.model, s, aperture.empty() ? Aperture{} : aperture_from(aperture));
  t.path = "synth";
  return t;
}

std::string audit_of(const std::vector<std::string>& ids, int jobs) {
  const Jobs threads(jobs);
  std::vector<std::string> all = ids;
  if (all.empty())
    for (const auto id : auditable_ids()) all.emplace_back(id);
  // In parts, between which an interrupt ends the work.  Thrown within one it would leave others
  // with loops that were cut short.
  const std::size_t part = std::max(8, 4 * tbb::this_task_arena::max_concurrency());
  std::vector<EntryAudit> entries;
  for (std::size_t at = 0; at < all.size(); at += part) {
    let_interrupt();
    const auto from = all.begin() + static_cast<std::ptrdiff_t>(at);
    auto more = audit({from, from + static_cast<std::ptrdiff_t>(std::min(part, all.size() - at))});
    std::ranges::move(more, std::back_inserter(entries));
  }
  return to_json(entries) + "\n";
}

}  // namespace

void bind_models(nb::module_& m) {
  using namespace nb::literals;
  const nb::call_guard<nb::gil_scoped_release> others_run;
  nb::class_<ModelArgument>(m, "Model")
      .def_ro("channels", &ModelArgument::channels)
      .def_prop_ro("spec", [](const ModelArgument& a) { return to_text(a.model.model.spec); });
  m.def(
      "model",
      [](const std::string& spec, const Settings& set) {
        return model_argument(spec, settings_from(set));
      },
      "spec"_a, "settings"_a);
  m.def(
      "model_of_document",
      [](const std::string& text, const Settings& set) {
        constexpr const char* name = "document";
        return model_argument(name, parse_fitted_model(name, text), settings_from(set));
      },
      "text"_a, "settings"_a);
  m.def("evaluate", &evaluate, "model"_a, "theta_i"_a.noconvert(), "phi_i"_a.noconvert(),
        "theta_o"_a.noconvert(), "phi_o"_a.noconvert(), "jobs"_a);
  m.def("interpolate", &interpolate, "table"_a, "theta_i"_a.noconvert(), "phi_i"_a.noconvert(),
        "theta_o"_a.noconvert(), "phi_o"_a.noconvert());
  bind_options<AlbedoQuestion>(m, "AlbedoQuestion");
  m.def("albedo", &albedo, "model"_a, "name"_a, "question"_a, "jobs"_a, others_run);
  m.def("term", &term, "id"_a, "number"_a, "parameters"_a, "at"_a);
  bind_options<SynthOptions>(m, "SynthOptions");
  m.def("synth", &synth, "model"_a, "layout"_a, "options"_a, "aperture"_a, "jobs"_a, others_run);
  m.def("audit", &audit_of, "ids"_a, "jobs"_a, others_run);
  m.def("provide", &foreign::provide, "file"_a, "text"_a, others_run);
  m.def(
      "own_name",
      [](const std::string& name) {
        return foreign::text_of(foreign::read_function(foreign::parse_name(name)).name);
      },
      "name"_a, others_run);
  m.def(
      "is_own", [](const std::string& name) { return foreign::is_name(name); }, "name"_a);
  m.def(
      "audit_file",
      [](const std::string& name, int jobs) {
        const Jobs threads(jobs);
        return to_json(audit_file(name));
      },
      "name"_a, "jobs"_a, others_run);
  m.def(
      "models",
      [](const std::string& word) {
        return foreign::is_name(word) ? to_json(file_functions(word)) : to_json(entries_with(word));
      },
      "word"_a);
}

}  // namespace gonio::python
