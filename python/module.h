#pragma once
/// \file
/// Module `gonio._gonio`: what python/gonio/__init__.py is made of.  It turns arguments into the rooms' types and calls them; results are
/// documents, as text, and arrays.
///
/// Every call that works lets other threads of Python run meanwhile.

#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "base/options.h"
#include "brdf/model/spec.h"
#include "table/table.h"

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>
#include <tbb/global_control.h>

namespace gonio::python {

namespace nb = nanobind;

/// Array that is read in place: of doubles, contiguous; anything else is refused by its type and not converted.
using Column = nb::ndarray<const double, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
/// Arrays that are handed over without a copy; they hold what owns their memory.  One that others look at is not to be written to.
using View = nb::ndarray<nb::numpy, const double>;
using Owned = nb::ndarray<nb::numpy, double>;

/// Numbers of an array, in place.
inline std::span<const double> span_of(const Column& c) {
  return {c.data(), c.size()};
}
/// Array that owns the numbers of a container, without a copy.  With the interpreter's lock held.
template <class Array, class Numbers>
Array owning(Numbers numbers, std::initializer_list<std::size_t> shape) {
  auto held = std::make_unique<Numbers>(std::move(numbers));
  const nb::capsule owner(held.get(), [](void* p) noexcept { delete static_cast<Numbers*>(p); });
  auto* const kept = held.release();
  return Array(kept->data(), shape, owner);
}

/// A parameter's name, its numbers, and its text where it is no number.
using Settings = std::vector<std::tuple<std::string, std::vector<double>, std::string>>;
std::vector<Setting> settings_from(const Settings&);

/// What a struct of options declares: name, annotation, meaning and default of each.
using Declared = std::vector<std::tuple<std::string, std::string, std::string, std::string>>;
Declared declared(const RecordType&);
/// Class of a struct of options, made of a call's words.
template <class Options>
void bind_options(nb::module_& m, const char* name) {
  nb::class_<Options>(m, name)
      .def("__init__",
           [](Options* at, const NamedWords& given) {
             Options made;
             take_words(record_of<Options>, &made, given);
             new (at) Options(std::move(made));
           })
      .def_static("declared", [] { return declared(record_of<Options>); });
}

/// Convention of that name; of no name none.
std::optional<Bins> bins_named(const std::optional<std::string>& name);

/// Threads while it lives: at most `jobs`; 0 for all.
class Jobs {
 public:
  /// \throws Error  wrong_usage of a number below 0
  explicit Jobs(int jobs);

 private:
  std::optional<tbb::global_control> control_;
};

/// Lets the handlers of signals run that came meanwhile.  KeyboardInterrupt, or what else they raise, ends the work: never to be called
/// within a parallel loop, whose other loops would be cut short and taken for done.
void let_interrupt();

void bind_tables(nb::module_&);
void bind_models(nb::module_&);
void bind_fits(nb::module_&);

}  // namespace gonio::python
