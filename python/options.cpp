// Options of the program's structs as keywords of Python: what a description declares.
#include "base/options.h"

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

}  // namespace

Declared declared(const RecordType& record) {
  Declared all;
  const auto add = [&](const RecordField& f, const void* value) {
    std::string about = help_of(f);
    if (!is_flag(f) && !choices_of(*f.type, f.rules).empty())
      about += fmt::format("; {}", expected_of(*f.type, f.rules));
    all.emplace_back(f.name, annotation(*f.type, f.rules), about, word_of(*f.type, f.rules, value));
  };
  for_each_option(record, const_cast<void*>(record.example()), add);  // nothing is written
  return all;
}

}  // namespace gonio::python
