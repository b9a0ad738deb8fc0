// Fits: of a file or of a table in memory, one model or several beside each other.
#include "base/error.h"
#include "fitting/batch/batch.h"
#include "fitting/choice/document.h"
#include "module.h"
#include "reports/pages/models_page.h"
#include "table/format/formats.h"

namespace gonio::python {
namespace {

void let_interrupt_at(const std::string&) {
  let_interrupt();
}

/// A table in memory as it is fitted.
Table masked(Table t, const HowFitted& how) {
  if (how.bins) throw wrong_usage("bins: of a file; a table that was read has its own");
  take(t, how.measured);
  return t;
}

std::string fit_path(const std::string& path, const HowFitted& how, int jobs) {
  const Jobs threads(jobs);
  return to_json(fit_files({path}, how, let_interrupt_at).result.document);
}

std::string fit_table(const Table& given, const HowFitted& how, int jobs) {
  const Jobs threads(jobs);
  const Table t = masked(given, how);
  FitDocument d = fit(t, how.options, [](const char*) { let_interrupt(); }).document;
  d.input_path = t.path;
  d.input_sha256 = t.sha256;
  return to_json(d);
}

std::string compare(Table& t,
                    const FitOptions& o,
                    const std::vector<std::string>& names,
                    const std::function<void()>& finish) {
  ModelChoice choice = compare_on_scale(t, o, models_asked(names),
                                        [](const std::string&, double) { let_interrupt(); });
  add_spheres(t, choice);
  finish();
  return to_json(choice, advise(choice), compared_table(t, o));
}

std::string compare_path(const std::string& path,
                         const HowFitted& how,
                         const std::vector<std::string>& models,
                         int jobs) {
  const Jobs threads(jobs);
  TableAndDigest in(path, how.bins);
  take(in.table, how.measured);
  in.table.path = path;
  return compare(in.table, how.options, models, [&] { in.finish(); });
}

std::string compare_table(const Table& t,
                          const HowFitted& how,
                          const std::vector<std::string>& models,
                          int jobs) {
  const Jobs threads(jobs);
  Table own = masked(t, how);
  return compare(own, how.options, models, [] {});
}

}  // namespace

void bind_fits(nb::module_& m) {
  using namespace nb::literals;
  const nb::call_guard<nb::gil_scoped_release> others_run;
  bind_options<HowFitted>(m, "HowFitted");
  m.def("fit_path", &fit_path, "path"_a, "how"_a, "jobs"_a, others_run);
  m.def("fit_table", &fit_table, "table"_a, "how"_a, "jobs"_a, others_run);
  m.def("compare_path", &compare_path, "path"_a, "how"_a, "models"_a, "jobs"_a, others_run);
  m.def("compare_table", &compare_table, "table"_a, "how"_a, "models"_a, "jobs"_a, others_run);
}

}  // namespace gonio::python
