#include "base/options.h"

#include <algorithm>
#include <ranges>

#include "base/error.h"
#include "base/numbers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

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
  const bool said = !rules.either.yes.empty();
  if (t.kind == ValueKind::truth)
    return {said ? rules.either.no : "false", said ? rules.either.yes : "true"};
  return {t.names.begin(), t.names.end()};
}

bool is_flag(const RecordField& f) {
  return f.type->kind == ValueKind::truth && f.rules.either.yes.empty();
}

std::string help_of(const RecordField& f) {
  return f.unit.empty() ? std::string(f.meaning) : fmt::format("{} [{}]", f.meaning, f.unit);
}

bool set_from_words(const ValueType& t,
                    const Rules& rules,
                    void* value,
                    std::span<const std::string> words) {
  if (t.read_words) return t.read_words(value, words), true;
  if (t.kind == ValueKind::optional || t.kind == ValueKind::list) {
    t.clear(value);
    return std::ranges::all_of(words, [&](const std::string& word) {
      return set_from_words(*t.of, rules, t.append(value, {}), {&word, 1});
    });
  }
  if (words.size() != 1) return false;
  const std::string& word = words[0];
  if (t.kind == ValueKind::text) return t.set_text(value, std::string(word)), true;
  const auto names = choices_of(t, rules);
  if (const auto at = std::ranges::find(names, word); at != names.end())
    return t.set_whole(value, at - names.begin()), true;
  const auto x = number_from<double>(word);
  if (!x || !names.empty() || (rules.has_numbers && !rules.numbers.holds(*x))) return false;
  if (t.kind == ValueKind::number) return t.set_number(value, *x), true;
  const auto set = [&](const auto& n) {
    if (n) t.set_whole(value, static_cast<std::int64_t>(*n));
    return n && t.whole(value) == static_cast<std::int64_t>(*n);
  };
  return t.is_signed ? set(number_from<std::int64_t>(word)) : set(number_from<std::uint64_t>(word));
}

std::string expected_of(const ValueType& t, const Rules& rules) {
  if (t.kind == ValueKind::optional || t.kind == ValueKind::list) return expected_of(*t.of, rules);
  if (const auto names = choices_of(t, rules); !names.empty())
    return fmt::format("one of {}", fmt::join(names, ", "));
  if (rules.has_numbers)
    return fmt::format("a number in [{}, {}]", rules.numbers.low, rules.numbers.high);
  return t.kind == ValueKind::number ? "a number" : "a whole number";
}

void take_words(const RecordType& record, void* to, const NamedWords& given) {
  std::size_t taken = 0;
  for_each_option(record, to, [&](const RecordField& f, void* value) {
    const auto at = given.find(std::string(f.name));
    if (at == given.end()) return;
    ++taken;
    if (!set_from_words(*f.type, f.rules, value, at->second))
      throw wrong_usage(fmt::format("{}: found {}, expected {}", f.name,
                                    fmt::join(at->second, ", "), expected_of(*f.type, f.rules)));
  });
  if (taken < given.size())
    throw wrong_usage(fmt::format("options: found one that is none of these among {}",
                                  fmt::join(std::views::keys(given), ", ")));
}

std::string word_of(const ValueType& t, const Rules& rules, const void* value) {
  std::string word;
  if (const auto names = choices_of(t, rules); !names.empty())
    word = names[static_cast<std::size_t>(t.whole(value))];
  else if (t.kind == ValueKind::text)
    word = t.text(value);
  else if (t.kind == ValueKind::number)
    word = fmt::format("{}", t.number(value));
  else if (t.kind == ValueKind::whole)
    word = std::to_string(t.whole(value));
  else if (t.kind == ValueKind::optional)
    t.each(value, [&](std::string_view, const void* held) { word = word_of(*t.of, rules, held); });
  return word;
}

}  // namespace gonio
