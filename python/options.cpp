// Options of the program's structs as keywords of Python: what a description declares
// (base/describe.h), and what a call gives.
#include "base/options.h"

#include <algorithm>

#include "base/error.h"
#include "base/nearest_names.h"
#include "fitting/solve/options.h"
#include "module.h"

#include <fmt/format.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

namespace gonio::python {
namespace {

bool are_settings(const ValueType& t) {
  return &t == &type_of<std::vector<Setting>>;
}

/// Annotation of a value.
std::string annotation(const ValueType& t, const Rules& rules) {
  if (are_settings(t)) return "Mapping[str, Values]";
  if (!choices_of(t, rules).empty()) return "str";
  switch (t.kind) {
    case ValueKind::truth:
      return "bool";
    case ValueKind::whole:
      return "int";
    case ValueKind::number:
      return "float";
    case ValueKind::text:
      return "str";
    case ValueKind::optional:
      return annotation(*t.of, rules) + " | None";
    default:
      return fmt::format("Iterable[{}]", annotation(*t.of, rules));
  }
}

/// Value as Python has it; None of an optional without one and of settings.
nb::object shown(const ValueType& t, const Rules& rules, const void* value) {
  if (are_settings(t)) return nb::none();
  if (const auto names = choices_of(t, rules); !names.empty()) {
    const auto name = names[static_cast<std::size_t>(t.whole(value))];
    return nb::str(name.data(), name.size());
  }
  switch (t.kind) {
    case ValueKind::truth:
      return nb::bool_(t.whole(value) != 0);
    case ValueKind::whole:
      return nb::int_(t.whole(value));
    case ValueKind::number:
      return nb::float_(t.number(value));
    case ValueKind::text:
      return nb::str(t.text(value).data(), t.text(value).size());
    case ValueKind::optional: {
      nb::object held = nb::none();
      t.each(value, [&](std::string_view, const void* v) { held = shown(*t.of, rules, v); });
      return held;
    }
    default:
      return nb::tuple();
  }
}

template <class T>
T cast(nb::handle given, const std::string& name, const char* expected) {
  T value;
  if (nb::try_cast(given, value)) return value;
  const nb::str kind(given.type().attr("__name__"));
  throw wrong_usage(fmt::format("{}: found {}, expected {}", name, kind.c_str(), expected));
}

void set(const ValueType& t,
         const Rules& rules,
         void* value,
         nb::handle given,
         const std::string& name) {
  if (given.is_none()) return;  // its default
  if (are_settings(t)) {
    *static_cast<std::vector<Setting>*>(value) = settings_from(nb::cast<Settings>(given));
    return;
  }
  if (const auto names = choices_of(t, rules); !names.empty()) {
    const auto word = cast<std::string>(given, name, "text");
    const auto at = std::ranges::find(names, word);
    if (at == names.end()) refuse_name(word, names, name);
    return t.set_whole(value, at - names.begin());
  }
  switch (t.kind) {
    case ValueKind::truth:
      return t.set_whole(value, cast<bool>(given, name, "True or False"));
    case ValueKind::whole:
    case ValueKind::number: {
      const bool whole = t.kind == ValueKind::whole;
      const double x = cast<double>(given, name, "a number");
      if (rules.has_numbers && !rules.numbers.holds(x))
        throw wrong_usage(fmt::format("{}: found {}, expected a number in [{}, {}]", name, x,
                                      rules.numbers.low, rules.numbers.high));
      if (!whole) return t.set_number(value, x);
      return t.set_whole(value, t.is_signed ? cast<std::int64_t>(given, name, "a whole number")
                                            : static_cast<std::int64_t>(cast<std::uint64_t>(
                                                  given, name, "a whole number from 0 on")));
    }
    case ValueKind::text:
      return t.set_text(value, cast<std::string>(given, name, "text"));
    case ValueKind::optional:
      return set(*t.of, rules, t.append(value, {}), given, name);
    default:
      t.clear(value);
      for (const nb::handle entry : given) set(*t.of, rules, t.append(value, {}), entry, name);
  }
}

}  // namespace

nb::list declared(const RecordType& record) {
  nb::list all;
  // Nothing is written: a record is handed as the walk takes it.
  const auto add = [&](const RecordField& f, const void* value) {
    std::string about = help_of(f);
    const ValueType& held = f.type->kind == ValueKind::optional ? *f.type->of : *f.type;
    if (const auto names = choices_of(held, f.rules); !names.empty())
      about += fmt::format(" ({})", fmt::join(names, ", "));
    all.append(nb::make_tuple(std::string(f.name), annotation(*f.type, f.rules), about,
                              shown(*f.type, f.rules, value)));
  };
  for_each_option(record, const_cast<void*>(record.example()), add);
  return all;
}

void take(const RecordType& record, void* to, const nb::dict& given) {
  for_each_option(record, to, [&](const RecordField& f, void* value) {
    const std::string name(f.name);
    if (given.contains(name.c_str())) set(*f.type, f.rules, value, given[name.c_str()], name);
  });
}

}  // namespace gonio::python
