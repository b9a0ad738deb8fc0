// Options of the program's structs as keywords of Python: what a description declares, and what a
// call gives in words.
#include "base/options.h"

#include "base/error.h"
#include "module.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio::python {
namespace {

/// Annotation of a value.
std::string annotation(const ValueType& t, const Rules& rules) {
  if (t.read_words) return "Mapping[str, Values]";
  if (t.kind == ValueKind::optional) return annotation(*t.of, rules) + " | None";
  if (t.kind == ValueKind::list) return fmt::format("Iterable[{}]", annotation(*t.of, rules));
  if (t.kind == ValueKind::whole) return "int";
  if (t.kind == ValueKind::number) return "float";
  return t.kind == ValueKind::truth && rules.either.yes.empty() ? "bool" : "str";
}

/// What a value has to be.
std::string expected(const ValueType& t, const Rules& rules) {
  if (t.kind == ValueKind::optional || t.kind == ValueKind::list) return expected(*t.of, rules);
  if (const auto names = choices_of(t, rules); !names.empty())
    return fmt::format("one of {}", fmt::join(names, ", "));
  if (rules.has_numbers)
    return fmt::format("a number in [{}, {}]", rules.numbers.low, rules.numbers.high);
  return t.kind == ValueKind::number ? "a number" : "a whole number";
}

}  // namespace

Declared declared(const RecordType& record) {
  Declared all;
  const auto add = [&](const RecordField& f, const void* value) {
    std::string about = help_of(f);
    if (!is_flag(f) && !choices_of(*f.type, f.rules).empty())
      about += fmt::format("; {}", expected(*f.type, f.rules));
    all.emplace_back(f.name, annotation(*f.type, f.rules), about, word_of(*f.type, f.rules, value));
  };
  for_each_option(record, const_cast<void*>(record.example()), add);  // nothing is written
  return all;
}

void take(const RecordType& record, void* to, const Words& given) {
  for_each_option(record, to, [&](const RecordField& f, void* value) {
    const auto at = given.find(std::string(f.name));
    if (at != given.end() && !set_from_words(*f.type, f.rules, value, at->second))
      throw wrong_usage(fmt::format("{}: found {}, expected {}", f.name,
                                    fmt::join(at->second, ", "), expected(*f.type, f.rules)));
  });
}

}  // namespace gonio::python
