#include "base/json/describe.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include "base/nearest.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

using Fields = std::span<const RecordField>;
using Kind = ValueKind;

/// Adds a key without looking whether it is there.
void put(Json& object, std::string_view name, Json value) {
  object.get_ref<Json::object_t&>().emplace_back(std::string(name), std::move(value));
}

/// First name that a record's documents have: what tells it from other alternatives.
std::string_view first_key(const RecordType& r) {
  return r.fields.front().name;
}

// --- Out ---

void put_fields(Json& object, Fields fields, const void* record, Digits digits);

Json json_at(const ValueType& t, const void* v, Digits digits) {
  switch (t.kind) {
    case Kind::truth:
      return t.whole(v) != 0;
    case Kind::number:
      return number_json(t.number(v), digits);
    case Kind::whole:
      if (t.is_signed) return t.whole(v);
      return static_cast<std::uint64_t>(t.whole(v));
    case Kind::name:
      return std::string(t.name(v));
    case Kind::text:
      return std::string(t.text(v));
    case Kind::embedded:
      return Json::parse(t.text(v));
    case Kind::own:
      return t.own->write(v);
    case Kind::optional: {
      Json out;
      t.each(v, [&](std::string_view, const void* value) { out = json_at(*t.of, value, digits); });
      return out;
    }
    case Kind::list: {
      Json out = Json::array();
      t.each(v, [&](std::string_view, const void* e) { out.push_back(json_at(*t.of, e, digits)); });
      return out;
    }
    case Kind::channels: {
      Json all = json_at(*t.of, v, digits);
      if (all.size() != 1) return all;
      Json one = std::move(all[0]);
      return one;
    }
    case Kind::named: {
      Json out = Json::object();
      t.each(v, [&](std::string_view name, const void* e) {
        put(out, name, json_at(*t.of, e, digits));
      });
      return out;
    }
    case Kind::record:
      break;
  }
  Json out = Json::object();
  put_fields(out, t.record->fields, v, digits);
  return out;
}

bool says_something(const ValueType& t, const void* v) {
  if (t.kind == Kind::channels) return says_something(*t.of, v);
  if (t.kind == Kind::number) return std::isfinite(t.number(v));
  if (t.kind == Kind::text) return !t.text(v).empty();
  bool any = t.each == nullptr;
  if (!any) t.each(v, [&](std::string_view, const void*) { any = true; });
  return any;
}

void put_field(Json& object, const RecordField& f, const void* record, Digits digits) {
  switch (f.role) {
    case FieldRole::constant:
      return put(object, f.name, std::string(f.constant));
    case FieldRole::group: {
      Json inner = Json::object();
      put_fields(inner, f.fields, record, digits);
      return put(object, f.name, std::move(inner));
    }
    default:
      break;
  }
  f.with_value(record, [&](const void* v) {
    const auto put_all = [&](std::string_view name, const void* e) {
      put(object, name, json_at(*f.type->of, e, digits));
    };
    switch (f.role) {
      case FieldRole::keyed:
        return f.type->each(v, put_all);
      case FieldRole::if_there:
        if (f.type->kind == Kind::optional)
          return f.type->each(v, [&](std::string_view, const void* e) { put_all(f.name, e); });
        if (says_something(*f.type, v)) put(object, f.name, json_at(*f.type, v, digits));
        return;
      case FieldRole::inlined:
        if (f.type->kind == Kind::record)
          return put_fields(object, f.type->record->fields, v, digits);
        return f.type->each(v, [&](std::string_view, const void* e) {
          put_fields(object, f.type->of->record->fields, e, digits);
        });
      case FieldRole::alternatives: {
        const std::size_t i = f.variant->index(v);
        if (!f.name.empty()) put(object, f.name, std::string(f.names[i]));
        return put_fields(object, f.variant->alternatives[i]->fields, f.variant->value(v), digits);
      }
      default:
        return put(object, f.name, json_at(*f.type, v, digits));
    }
  });
}

void put_fields(Json& object, Fields fields, const void* record, Digits digits) {
  for (const auto& f : fields) put_field(object, f, record, digits);
}

// --- In ---

/// "at least 1", "3", "1 to 1000"
std::string words_of(const Entries& n) {
  if (n.most == Entries{}.most) return fmt::format("at least {}", n.least);
  return n.least == n.most ? std::to_string(n.least) : fmt::format("{} to {}", n.least, n.most);
}

std::string words_of(const Numbers& n) {
  if (n.low == -Numbers::any && n.high == Numbers::any) return "a number";
  if (n.high == Numbers::any)
    return n.above_low ? fmt::format("a number above {:g}", n.low)
                       : fmt::format("a number from {:g} on", n.low);
  return fmt::format("a number in {}{:g}, {:g}{}", n.above_low ? '(' : '[', n.low, n.high,
                     n.below_high ? ')' : ']');
}

/// \param of  "an array of", "an object of"
void expect_entries(const JsonReader& j, const Entries& n, const char* of) {
  if (j.size() < n.least || j.size() > n.most)
    j.fail(fmt::format("{} {}", of, j.size()), fmt::format("{} {}", of, words_of(n)));
}

/// Object whose keys are read one after the other.
class ObjectReader {
 public:
  /// \param others  keys that are not described are passed over
  ObjectReader(const JsonReader& object, bool others) : at_(object), others_(others) {
    at_.expect_object();
  }

  void read(const RecordType& type, void* record) {
    others_ |= type.has_others;
    read(type.fields, record);
    if (type.check != nullptr)
      type.check(record, [&](bool holds, std::string_view key, std::string_view expected) {
        if (holds) return;
        const std::string at(key);
        (at_.has(at) ? at_.at(at) : at_).fail(std::string(expected));
      });
  }
  void read(Fields fields, void* record) {
    for (const auto& f : fields) read(f, record);
  }
  /// Refuses keys that are not described.
  void done() const {
    if (!others_)
      at_.visit_members([&](const std::string& key, const JsonReader& value) {
        if (std::ranges::find(known_, key) == known_.end())
          value.fail(known_.size() < 2 ? "no such key; " + either(known_)
                                       : fmt::format("no such key; nearest: {}, of {}",
                                                     nearest(key, known_).front(), either(known_)));
      });
  }

 private:
  void read(const RecordField& f, void* record);
  void read_inlined(const RecordField& f, void* value);
  void read_alternative(const RecordField& f, void* value);

  JsonReader at_;
  std::vector<std::string_view> known_;
  bool others_;
};

/// What holds for a value and all that is in it.
struct Within {
  Rules rules;
  bool others = false;  ///< keys that are not described are passed over

  /// The same for entries.
  Within entries() const {
    Within inner = *this;
    inner.rules.entries = {};
    return inner;
  }
};

void read_list(const JsonReader& j, const ValueType& t, void* v, const Within& in);

/// Whole number that a type can hold.
std::int64_t whole_in(const JsonReader& j, const ValueType& t) {
  const int bits = static_cast<int>(8 * t.size) - (t.is_signed ? 1 : 0);
  const std::uint64_t most = std::numeric_limits<std::uint64_t>::max() >> (64 - bits);
  if (t.is_signed && j.is_negative()) {
    const std::int64_t x = j.negative_number();
    if (x < -static_cast<std::int64_t>(most) - 1) j.fail("a number of fewer digits");
    return x;
  }
  const std::uint64_t x = j.whole_number();
  if (x > most) j.fail("a number of fewer digits");
  return static_cast<std::int64_t>(x);
}

void read_at(const JsonReader& j, const ValueType& t, void* v, const Within& in) {
  const Within inner = in.entries();
  switch (t.kind) {
    case Kind::truth:
      return t.set_whole(v, j.boolean());
    case Kind::number:
      return t.set_number(v, in.rules.has_numbers ? number_in(j, in.rules.numbers) : j.number());
    case Kind::whole: {
      if (in.rules.has_numbers) number_in(j, in.rules.numbers);
      return t.set_whole(v, whole_in(j, t));
    }
    case Kind::name: {
      const auto found = std::ranges::find(t.names, j.string());
      if (found == t.names.end()) j.fail(either({t.names.begin(), t.names.end()}));
      return t.set_whole(v, found - t.names.begin());
    }
    case Kind::text:
      return t.set_text(v, in.rules.not_empty ? text_in(j) : j.string());
    case Kind::own:
      return t.own->read(j, v);
    case Kind::optional:
      t.clear(v);
      if (!j.is_null()) read_at(j, *t.of, t.append(v, {}), in);
      return;
    case Kind::list:
      return read_list(j, t, v, in);
    case Kind::channels:
      if (j.is_array()) return read_list(j, *t.of, v, in);
      if (t.of->size == 0) {
        t.of->clear(v);
        return read_at(j, *t.of->of, t.of->append(v, {}), inner);
      }
      return t.of->each(v, [&](std::string_view, const void* e) {
        read_at(j, *t.of->of, const_cast<void*>(e), inner);
      });
    case Kind::named:
      t.clear(v);
      return visit_members_in(j, in.rules.entries, [&](const auto& name, const auto& member) {
        read_at(member, *t.of, t.append(v, std::string(name)), inner);
      });
    case Kind::record: {
      ObjectReader object(j, in.others);
      object.read(*t.record, v);
      return object.done();
    }
    case Kind::embedded:
      break;
  }
  j.fail("a value that can be read");
}

void read_list(const JsonReader& j, const ValueType& t, void* v, const Within& in) {
  const Within inner = in.entries();
  if (t.size > 0) {
    expect_array(j, {t.size, t.size});
    std::size_t next = 0;
    return t.each(v, [&](std::string_view, const void* e) {
      read_at(j.at(next++), *t.of, const_cast<void*>(e), inner);
    });
  }
  t.clear(v);
  expect_array(j, in.rules.entries);
  for (std::size_t i = 0; i < j.size(); ++i) read_at(j.at(i), *t.of, t.append(v, {}), inner);
}

void ObjectReader::read(const RecordField& f, void* record) {
  if (f.role == FieldRole::inlined) return read_inlined(f, f.place(record));
  if (f.role == FieldRole::alternatives) return read_alternative(f, f.place(record));
  known_.push_back(f.name);
  const std::string key(f.name);
  if (f.role == FieldRole::constant) {
    const JsonReader j = at_.at(key);
    if (j.string() != f.constant) j.fail(std::string(f.constant));
  } else if (f.role == FieldRole::group) {
    ObjectReader within(at_.at(key), others_);
    within.read(f.fields, record);
    within.done();
  } else if (f.place != nullptr) {
    const bool may_miss = f.rules.or_default || f.role == FieldRole::if_there;
    if (may_miss && !at_.has(key)) return;
    const JsonReader j = at_.at(key);
    if (f.role == FieldRole::if_there && f.type->kind == Kind::optional)
      read_at(j, *f.type->of, f.type->append(f.place(record), {}), {f.rules, others_});
    else
      read_at(j, *f.type, f.place(record), {f.rules, others_});
  }
}

/// An optional is there where the first of its keys is.
void ObjectReader::read_inlined(const RecordField& f, void* value) {
  if (f.type->kind == Kind::record) return read(*f.type->record, value);
  const RecordType& within = *f.type->of->record;
  f.type->clear(value);
  if (at_.has(std::string(first_key(within)))) return read(within, f.type->append(value, {}));
  for (const auto& inner : within.fields) known_.push_back(inner.name);
}

void ObjectReader::read_alternative(const RecordField& f, void* value) {
  const auto all = f.variant->alternatives;
  std::vector<std::string_view> names(f.names.begin(), f.names.end()), there;
  std::size_t found = 0;
  if (!f.name.empty()) {
    known_.push_back(f.name);
    const JsonReader j = at_.at(std::string(f.name));
    found = static_cast<std::size_t>(std::ranges::find(names, j.string()) - names.begin());
    if (found == names.size()) j.fail(either(names));
  } else {
    for (const RecordType* a : all) names.push_back(first_key(*a));
    for (const auto name : names)
      if (at_.has(std::string(name))) there.push_back(name);
    if (there.size() != 1)
      at_.fail(there.empty() ? "none of its keys" : fmt::format("{}", fmt::join(there, " and ")),
               "one of " + either(names));
    found = static_cast<std::size_t>(std::ranges::find(names, there[0]) - names.begin());
  }
  read(*all[found], f.variant->emplace(value, found));
}

// --- Schema ---

/// Schema that allows null too.
Json or_null(Json schema) {
  if (schema.contains("enum"))
    schema["enum"].push_back(nullptr);
  else if (!schema.contains("type"))
    schema = {{"anyOf", {schema, {{"type", "null"}}}}};
  else if (Json& type = schema["type"]; type.is_string())
    type = {type, "null"};
  return schema;
}

Json numbers_schema(const Rules& rules) {
  if (!rules.has_numbers) return {{"type", {"number", "null"}}};
  const Numbers& n = rules.numbers;
  Json out{{"type", "number"}};
  if (n.low > -Numbers::any) put(out, n.above_low ? "exclusiveMinimum" : "minimum", n.low);
  if (n.high < Numbers::any) put(out, n.below_high ? "exclusiveMaximum" : "maximum", n.high);
  return out;
}

/// Objects of exactly these keys, one for each choice among alternatives.
class ObjectSchema {
 public:
  void add(const RecordType& type, bool required) {
    if (type.has_others)
      for (Json& object : all_) object["additionalProperties"] = true;
    const void* example = type.example == nullptr ? nullptr : type.example();
    for (const auto& f : type.fields) add(f, required, example);
  }
  Json schema() const { return all_.size() == 1 ? all_[0] : Json{{"anyOf", all_}}; }

 private:
  void add(const RecordField& f, bool required, const void* example);
  void add_alternatives(const RecordField& f, bool required);
  void put_key(std::string_view key, const Json& schema, bool required) {
    for (Json& object : all_) {
      put(object["properties"], key, schema);
      if (required) object["required"].push_back(std::string(key));
    }
  }

  std::vector<Json> all_{{{"type", "object"},
                          {"properties", Json::object()},
                          {"required", Json::array()},
                          {"additionalProperties", false}}};
};

void put_entries(Json& schema, const Entries& n, const char* least, const char* most) {
  if (n.least > 0) put(schema, least, n.least);
  if (n.most < Entries{}.most) put(schema, most, n.most);
}

Json schema_at(const ValueType& t, const Rules& rules) {
  Rules inner = rules;
  inner.entries = {};
  switch (t.kind) {
    case Kind::truth:
      return {{"type", "boolean"}};
    case Kind::number:
      return numbers_schema(rules);
    case Kind::whole: {
      Json out{{"type", "integer"}};
      if (!t.is_signed) put(out, "minimum", 0);
      return out;
    }
    case Kind::name:
      return {{"enum", std::vector<std::string>(t.names.begin(), t.names.end())}};
    case Kind::text: {
      Json out{{"type", "string"}};
      if (rules.not_empty) put(out, "minLength", 1);
      return out;
    }
    case Kind::embedded:
      return schema_at(*t.of, {});
    case Kind::own:
      return t.own->schema();
    case Kind::optional:
      return or_null(schema_at(*t.of, rules));
    case Kind::list: {
      Json out{{"type", "array"}, {"items", schema_at(*t.of, inner)}};
      put_entries(out, t.size > 0 ? Entries{t.size, t.size} : rules.entries, "minItems",
                  "maxItems");
      return out;
    }
    case Kind::channels:
      return {{"anyOf", {schema_at(*t.of->of, inner), schema_at(*t.of, rules)}}};
    case Kind::named: {
      Json out{{"type", "object"}, {"additionalProperties", schema_at(*t.of, inner)}};
      put_entries(out, rules.entries, "minProperties", "maxProperties");
      if (out.size() > 2) put(out, "propertyNames", {{"minLength", 1}});
      return out;
    }
    case Kind::record:
      break;
  }
  ObjectSchema object;
  object.add(*t.record, true);
  return object.schema();
}

/// "what it is [unit]"
void put_meaning(Json& schema, const RecordField& f) {
  std::string text(f.meaning);
  if (!f.unit.empty()) text += fmt::format("{}[{}]", text.empty() ? "" : " ", f.unit);
  if (!text.empty()) put(schema, "description", text);
}

void ObjectSchema::add(const RecordField& f, bool required, const void* example) {
  const bool is_optional = f.type != nullptr && f.type->kind == Kind::optional;
  switch (f.role) {
    case FieldRole::constant:
      return put_key(f.name, {{"const", std::string(f.constant)}}, required);
    case FieldRole::inlined:
      return is_optional ? add(*f.type->of->record, false) : add(*f.type->record, required);
    case FieldRole::alternatives:
      return add_alternatives(f, required);
    case FieldRole::group: {
      ObjectSchema within;
      for (const auto& inner : f.fields) within.add(inner, true, example);
      Json schema = within.schema();
      put_meaning(schema, f);
      return put_key(f.name, schema, required);
    }
    default:
      break;
  }
  const bool if_there = f.role == FieldRole::if_there;
  const bool of_entries = f.role == FieldRole::keyed || (if_there && is_optional);
  Json schema = schema_at(of_entries ? *f.type->of : *f.type, f.rules);
  if (f.rules.or_default && example != nullptr && f.place != nullptr) {
    const Json value = json_at(*f.type, f.place(const_cast<void*>(example)), Digits::all);
    if (value.is_primitive() ? !value.is_null() && value != "" : f.type->size > 0)
      put(schema, "default", value);
  }
  put_meaning(schema, f);
  if (f.role == FieldRole::keyed)
    for (Json& object : all_) object["patternProperties"] = {{std::string(f.name), schema}};
  else
    put_key(f.name, schema, required && !if_there && !f.rules.or_default);
}

void ObjectSchema::add_alternatives(const RecordField& f, bool required) {
  std::vector<Json> all;
  for (std::size_t i = 0; i < f.variant->alternatives.size(); ++i) {
    ObjectSchema with = *this;
    if (!f.name.empty()) with.put_key(f.name, {{"const", std::string(f.names[i])}}, required);
    with.add(*f.variant->alternatives[i], required);
    all.insert(all.end(), with.all_.begin(), with.all_.end());
  }
  all_ = std::move(all);
}

}  // namespace

const JsonForm any_json{[](const void* v) { return *static_cast<const Json*>(v); },
                        [](const JsonReader& j, void* v) { *static_cast<Json*>(v) = j.json(); },
                        [] { return Json::object(); }};

Json number_json(double v, Digits digits) {
  if (!std::isfinite(v)) return nullptr;
  return digits == Digits::all ? v : std::strtod(fmt::format("{:.6g}", v).c_str(), nullptr);
}

Json json_of(const ValueRef& value, Digits digits) {
  return json_at(value.type, value.at, digits);
}

std::string json_text(const ValueRef& value, Digits digits) {
  return text_of(json_of(value, digits));
}

std::string json_line(const ValueRef& value, Digits digits) {
  return line_of(json_of(value, digits));
}

void read_value(const JsonReader& j, const ValueType& type, void* value, const Rules& rules) {
  read_at(j, type, value, {rules});
}

Json schema_of(const ValueType& type) {
  return schema_at(type, {});
}

std::string schema_text(const ValueType& type, std::string_view title) {
  Json out{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", std::string(title)}};
  out.update(schema_of(type));
  return text_of(out);
}

std::string either(const std::vector<std::string_view>& names) {
  std::string all;
  for (std::size_t i = 0; i < names.size(); ++i)
    all.append(i == 0 ? "" : i + 1 < names.size() ? ", " : " or ").append(names[i]);
  return all;
}

double number_in(const JsonReader& j, const Numbers& n) {
  if (!j.is_number() || !n.holds(j.number())) j.fail(words_of(n));
  return j.number();
}

void expect_array(const JsonReader& j, const Entries& n) {
  if (!j.is_array()) j.fail("an array of " + words_of(n));
  expect_entries(j, n, "an array of");
}

void visit_members_in(const JsonReader& j,
                      const Entries& n,
                      const std::function<void(const std::string&, const JsonReader&)>& visit) {
  j.expect_object();
  expect_entries(j, n, "an object of");
  j.visit_members([&](const std::string& name, const JsonReader& value) {
    if (name.empty()) value.fail("a key without a name", "a name");
    visit(name, value);
  });
}

std::string text_in(const JsonReader& j) {
  std::string text = j.string();
  if (text.empty() || text.find('\0') != text.npos) j.fail("a string that is not empty");
  return text;
}

}  // namespace gonio
