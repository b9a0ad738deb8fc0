#include "base/options.h"

namespace gonio {

void for_each_option(const RecordType& record,
                     void* at,
                     FunctionRef<void(const RecordField&, void* value)> take) {
  for (const RecordField& f : record.fields) {
    if (f.rules.not_asked) continue;
    if (f.role == FieldRole::inlined)
      for_each_option(*f.type->record, f.place(at), take);
    else
      take(f, f.place(at));
  }
}

std::vector<std::string_view> choices_of(const ValueType& t, const Rules& rules) {
  if (t.kind == ValueKind::truth && !rules.either.yes.empty())
    return {rules.either.no, rules.either.yes};
  return {t.names.begin(), t.names.end()};
}

std::string help_of(const RecordField& f) {
  std::string help(f.meaning);
  if (!f.unit.empty()) help.append(" [").append(f.unit).append("]");
  return help;
}

}  // namespace gonio
