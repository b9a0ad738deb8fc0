// Fits: of a file or of a table in memory, one model or several beside each other.
#include "base/error.h"
#include "fitting/batch/fit_file.h"
#include "fitting/choice/document.h"
#include "module.h"
#include "reports/pages/models_page.h"
#include "table/format/formats.h"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

namespace gonio::python {
namespace {

void let_interrupt_at(const std::string&) {
  let_interrupt();
}

FitOptions options(const std::string& model,
                   const Settings& fix,
                   const Settings& bounds,
                   const std::vector<std::string>& grey,
                   const std::string& metric,
                   bool robust,
                   const std::string& intervals,
                   bool copies,
                   const std::string& certificate) {
  FitOptions o;
  o.model = model;
  o.fixed = settings_from(fix);
  o.bounds = settings_from(bounds);
  o.grey = grey;
  o.metric = value_of<Metric>(metric, "metric");
  o.robust = robust;
  o.intervals = value_of<Intervals>(intervals, "intervals");
  o.copies = copies;
  o.certificate = value_of<Certify>(certificate, "certificate");
  return o;
}

std::string fit_path(const std::string& path,
                     const std::optional<std::string>& bins,
                     const FitOptions& o,
                     int jobs) {
  const Jobs threads(jobs);
  return to_json(fit_file(path, bins_named(bins), o, let_interrupt_at).result.document);
}

std::string fit_table(const Table& t, const FitOptions& o, int jobs) {
  const Jobs threads(jobs);
  FitDocument d = fit(t, o, [](const char*) { let_interrupt(); }).document;
  d.input_path = t.path;
  d.input_sha256 = t.sha256;
  return to_json(d);
}

std::string compare(const Table& t,
                    const FitOptions& o,
                    const std::vector<std::string>& names,
                    const std::function<void()>& finish) {
  const auto models = models_asked(names);
  ModelChoice choice =
      compare_models(t, o, models, [](const std::string&, double) { let_interrupt(); });
  add_spheres(t, choice);
  finish();
  return to_json(choice, advise(choice),
                 {t.path, t.sha256, t.format, std::string(name_of(o.metric))});
}

std::string compare_path(const std::string& path,
                         const std::optional<std::string>& bins,
                         const FitOptions& o,
                         const std::vector<std::string>& models,
                         int jobs) {
  const Jobs threads(jobs);
  TableAndDigest in(path, bins_named(bins));
  in.table.path = path;
  return compare(in.table, o, models, [&] { in.finish(); });
}

std::string compare_table(const Table& t,
                          const FitOptions& o,
                          const std::vector<std::string>& models,
                          int jobs) {
  const Jobs threads(jobs);
  return compare(t, o, models, [] {});
}

}  // namespace

void bind_fits(nb::module_& m) {
  using namespace nb::literals;
  const nb::call_guard<nb::gil_scoped_release> others_run;
  nb::class_<FitOptions>(m, "FitOptions");
  m.def("fit_options", &options, "model"_a, "fix"_a, "bounds"_a, "grey"_a, "metric"_a, "robust"_a,
        "intervals"_a, "copies"_a, "certificate"_a);
  m.def("fit_path", &fit_path, "path"_a, "bins"_a.none(), "options"_a, "jobs"_a, others_run);
  m.def("fit_table", &fit_table, "table"_a, "options"_a, "jobs"_a, others_run);
  m.def("compare_path", &compare_path, "path"_a, "bins"_a.none(), "options"_a, "models"_a, "jobs"_a,
        others_run);
  m.def("compare_table", &compare_table, "table"_a, "options"_a, "models"_a, "jobs"_a, others_run);
}

}  // namespace gonio::python
