#include "module.h"

#include <filesystem>

#include "base/path_error.h"

namespace gonio::python {
namespace {

/// Classes of errors, which live as long as the interpreter.
PyObject *wrong_usage_class = nullptr, *bad_input_class = nullptr;

PyObject* add_error(nb::module_& m, const char* name, const char* doc, const nb::tuple& bases) {
  PyObject* const c =
      PyErr_NewExceptionWithDoc((std::string("gonio.") + name).c_str(), doc, bases.ptr(), nullptr);
  if (c == nullptr) throw nb::python_error();
  m.attr(name) = nb::borrow(c);
  return c;
}

void add_errors(nb::module_& m) {
  PyObject* const any = add_error(m, "Error", "The line that the program would have printed.",
                                  nb::make_tuple(nb::borrow(PyExc_Exception)));
  const auto bases = nb::make_tuple(nb::borrow(any), nb::borrow(PyExc_ValueError));
  wrong_usage_class = add_error(
      m, "WrongUsage", "A call that nothing can be made of: the program's exit code 2.", bases);
  bad_input_class =
      add_error(m, "BadInput",
                "A file or an array that is not what it should be, or a file that cannot "
                "be written: the program's exit code 3.  FILE: PLACE: found X, expected Y.",
                bases);
  Py_DECREF(any);  // the module holds it
  nb::register_exception_translator([](const std::exception_ptr& p, void*) {
    const auto raise = [](const Error& e) {
      PyErr_SetString(e.code() == Exit::usage ? wrong_usage_class : bad_input_class, e.what());
    };
    try {
      std::rethrow_exception(p);
    } catch (const Error& e) {
      raise(e);
    } catch (const std::filesystem::filesystem_error& e) {
      raise(path_error(e));
    }
  });
}

}  // namespace

std::vector<Setting> settings_from(const Settings& all) {
  std::vector<Setting> settings;
  for (const auto& [name, values, text] : all) settings.push_back({name, values, text});
  return settings;
}

std::optional<Bins> bins_named(const std::optional<std::string>& name) {
  return name ? std::optional(value_of<Bins>(*name, "bins")) : std::nullopt;
}

Jobs::Jobs(int jobs) {
  if (jobs < 0) throw wrong_usage("jobs: a number of threads, or 0 for all");
  if (jobs > 0)
    control_.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(jobs));
}

void let_interrupt() {
  const nb::gil_scoped_acquire held;
  if (PyErr_CheckSignals() != 0) throw nb::python_error();
}

}  // namespace gonio::python

NB_MODULE(_gonio, m) {
  m.doc() = "The compiled part of the package gonio, whose functions are the ones to call.";
  m.attr("__version__") = GONIO_VERSION;
  gonio::python::add_errors(m);
  gonio::python::bind_tables(m);
  gonio::python::bind_models(m);
  gonio::python::bind_fits(m);
}
