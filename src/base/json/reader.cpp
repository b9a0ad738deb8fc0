#include "base/json/reader.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "base/error.h"
#include "base/file.h"
#include "base/json/memory.h"
#include "base/text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

constexpr int kDeepest = 64;  ///< nested brackets; the contract's documents need 5
/// Bytes that the values of a document take: brackets alone take 33 times their text.
constexpr std::size_t most_memory = std::size_t{1} << 29;

/// What the values count to that this thread parses; nullptr: to nothing beside their own document.
thread_local std::size_t* counted_to = nullptr;

/// Byte where brackets nest deeper than that, or npos.
std::size_t too_deep(std::string_view bytes) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const char c = bytes[i];
    if (in_string && c == '\\')
      ++i;
    else if (c == '"')
      in_string = !in_string;
    else if (in_string)
      continue;
    else if (c == '[' || c == '{')
      ++depth;
    else if (c == ']' || c == '}')
      --depth;
    if (depth > kDeepest) return i;
  }
  return bytes.npos;
}

std::string place_of(std::string_view bytes, std::size_t at) {
  const auto before = bytes.substr(0, at);
  const auto column = at - (before.rfind('\n') + 1) + 1;  // npos + 1 is 0
  return fmt::format("line {}, column {}", 1 + std::ranges::count(before, '\n'), column);
}

/// A simple value as it is written, of others the kind: they may hold anything.
std::string name_of(const Json& j) {
  if (j.is_structured())
    return fmt::format("{} {}", j.empty() ? "an empty" : "an", j.is_object() ? "object" : "array");
  return line_of(j);
}

/// Step from an object to its member, as a part of a place.
std::string step_to(const std::string& key, Places places, bool is_first) {
  if (places == Places::dotted) return is_first ? key : "." + key;
  std::string escaped = "/";
  for (const char c : key)
    if (c == '~' || c == '/')
      escaped += c == '~' ? "~0" : "~1";
    else
      escaped += c;
  return escaped;
}

using Members = std::vector<Json::object_t::value_type>;

/// The members of an object, to add to without a search for the name.
Members& members_of(Json& object) {
  return object.get_ref<Json::object_t&>();
}

/// Frees values from the innermost on.  The library would move all elements of a list into another one first, which takes nearly twice
/// their memory.
void take_apart(Json& j) {
  if (j.is_array())
    for (Json& element : j) take_apart(element);
  else if (j.is_object())
    for (auto& [key, value] : members_of(j)) take_apart(value);
  if (j.is_structured()) j.clear();
}

/// Builds a document as it is read.  The library's own way looks every key up among those before it,
/// one by one: that is quadratic in the keys of an object.
class Builder final : public nlohmann::json_sax<Json> {
 public:
  Builder(const std::string& file, const std::string& bytes) : file_(file), bytes_(bytes) {}
  ~Builder() override { take_apart(root_); }
  Builder(const Builder&) = delete;
  Json take() { return std::move(root_); }

  bool null() override { return add(nullptr); }
  bool boolean(bool v) override { return add(v); }
  bool number_integer(std::int64_t v) override { return add(v); }
  bool number_unsigned(std::uint64_t v) override { return add(v); }
  bool number_float(double v, const std::string&) override { return add(v); }
  bool string(std::string& v) override {
    charge(v);
    return add(std::move(v));
  }
  bool binary(Json::binary_t& v) override { return add(std::move(v)); }
  bool start_object(std::size_t) override { return open(Json::object()); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool key(std::string& name) override {
    charge(name);
    members_of(*open_.back()).emplace_back(std::move(name), nullptr);
    return true;
  }
  bool end_array() override {
    open_.pop_back();
    return true;
  }
  bool end_object() override {
    keep_last(members_of(*open_.back()));
    return end_array();
  }
  bool parse_error(std::size_t byte,
                   const std::string& token,
                   const nlohmann::detail::exception& e) override {
    const auto end = std::min(bytes_.size(), byte > 0 ? byte - 1 : 0);
    if (dynamic_cast<const Json::parse_error*>(&e) == nullptr)
      throw bad_input(file_, place_of(bytes_, end), token, "a number that a double holds");
    throw bad_input(file_, place_of(bytes_, end),
                    end < bytes_.size() ? bytes_.substr(end, 12) : "the end of the file", "JSON");
  }

 private:
  Json& put(Json&& value) {
    if (open_.empty()) return root_ = std::move(value);
    Json& in = *open_.back();
    if (in.is_array()) return in.emplace_back(std::move(value));
    return members_of(in).back().second = std::move(value);
  }
  void charge(std::size_t bytes) {
    if ((memory_ += bytes) > most_memory)
      throw bad_input(file_, "JSON", fmt::format("more values than {} bytes hold", most_memory),
                      "fewer");
  }
  /// A text on its own, and what is allocated for its characters.
  void charge(const std::string& text) { charge(2 * sizeof text + text.size()); }
  bool add(Json&& value) {
    charge(2 * sizeof value);  // a list that grows has room for twice as many
    put(std::move(value));
    return true;
  }
  /// It stays where it is while it is open: nothing is added beside it.
  bool open(Json&& value) {
    charge(2 * sizeof value + 3 * sizeof(Json::array_t));
    open_.push_back(&put(std::move(value)));
    return true;
  }
  /// Keeps of members with one name the value of the last, where the first stands.
  void keep_last(Members& all) {
    order_.resize(all.size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    const auto name = [&](std::size_t k) -> const std::string& { return all[k].first; };
    std::ranges::sort(order_, [&](std::size_t a, std::size_t b) {
      const int c = name(a).compare(name(b));
      return c != 0 ? c < 0 : a < b;
    });
    std::vector<bool> repeats(all.size());
    bool any = false;
    for (std::size_t k = 0, first = 0; k < order_.size(); ++k) {
      if (name(order_[k]) != name(order_[first])) first = k;
      if (k == first) continue;
      all[order_[first]].second = std::move(all[order_[k]].second);
      repeats[order_[k]] = any = true;
    }
    if (!any) return;
    Members kept;
    for (std::size_t k = 0; k < all.size(); ++k)
      if (!repeats[k]) kept.push_back(std::move(all[k]));
    all = std::move(kept);
  }

  const std::string &file_, &bytes_;
  Json root_;
  std::vector<Json*> open_;  ///< the innermost last
  std::vector<std::size_t> order_;
  std::size_t own_memory_ = 0, &memory_ = counted_to ? *counted_to : own_memory_;
};

}  // namespace

CountedJson::CountedJson(std::size_t& bytes) : before_(std::exchange(counted_to, &bytes)) {}
CountedJson::~CountedJson() {
  counted_to = before_;
}

std::string text_of(const Json& j) {
  return printable_json(j.dump(2, ' ', false, Json::error_handler_t::replace)) + "\n";
}
std::string line_of(const Json& j) {
  return printable_json(j.dump(-1, ' ', false, Json::error_handler_t::replace));
}

Json parse_json(const std::string& file, const std::string& bytes) {
  if (const auto at = too_deep(bytes); at != bytes.npos)
    throw bad_input(file, place_of(bytes, at), fmt::format("{} levels of brackets", kDeepest + 1),
                    fmt::format("at most {}", kDeepest));
  Builder document(file, bytes);
  Json::sax_parse(bytes, &document);
  return document.take();
}

Json read_json(const std::string& file) {
  return parse_json(file, InputFile(file).read_rest(most_document_bytes));
}

void JsonReader::fail(const std::string& expected) const {
  fail(name_of(*value_), expected);
}

void JsonReader::fail(const std::string& found, const std::string& expected) const {
  throw bad_input(*file_, place_.empty() ? "the document" : place_, found, expected);
}

bool JsonReader::is_array() const {
  return value_->is_array();
}

bool JsonReader::is_number() const {
  return value_->is_number();
}

bool JsonReader::is_negative() const {
  return value_->is_number_integer() && !value_->is_number_unsigned();
}

bool JsonReader::is_string() const {
  return value_->is_string();
}

bool JsonReader::is_null() const {
  return value_->is_null();
}

std::size_t JsonReader::size() const {
  return value_->size();
}

void JsonReader::expect_object() const {
  if (!value_->is_object()) fail("an object");
}

bool JsonReader::has(const std::string& key) const {
  return value_->is_object() && value_->contains(key);
}

JsonReader JsonReader::within(const Json& value, std::string step) const {
  // An error cuts it before that (base/error.h), and each element of an array has its own.
  constexpr std::size_t most = 256;
  std::string place = place_ + std::move(step);
  if (place.size() > most) place.resize(most);
  return {*file_, value, std::move(place), places_};
}

JsonReader JsonReader::at(const std::string& key) const {
  expect_object();
  const auto found = value_->find(key);
  static const Json nothing;
  if (found == value_->end())
    within(nothing, step_to(key, places_, place_.empty())).fail("nothing", "a value");
  return within(*found, step_to(key, places_, place_.empty()));
}

JsonReader JsonReader::at(std::size_t index) const {
  if (!is_array()) fail("an array");
  static const Json nothing;
  const std::string step =
      places_ == Places::dotted ? fmt::format("[{}]", index) : fmt::format("/{}", index);
  if (index >= size()) within(nothing, step).fail("nothing", "a value");
  return within((*value_)[index], step);
}

void JsonReader::visit_members(
    const std::function<void(const std::string&, const JsonReader&)>& visit) const {
  expect_object();
  for (const auto& [key, value] : value_->get_ref<const Json::object_t&>())
    visit(key, within(value, step_to(key, places_, place_.empty())));
}

std::string JsonReader::string() const {
  if (!value_->is_string()) fail("a string");
  return value_->get<std::string>();
}

bool JsonReader::boolean() const {
  if (!value_->is_boolean()) fail("true or false");
  return value_->get<bool>();
}

double JsonReader::number() const {
  if (value_->is_null()) return std::numeric_limits<double>::quiet_NaN();
  if (!value_->is_number()) fail("a number or null");
  return value_->get<double>();
}

std::uint64_t JsonReader::whole_number() const {
  if (!value_->is_number_unsigned()) fail("a whole number");
  return value_->get<std::uint64_t>();
}

std::int64_t JsonReader::negative_number() const {
  if (!is_negative()) fail("a negative whole number");
  return value_->get<std::int64_t>();
}

std::vector<double> JsonReader::numbers() const {
  if (!is_array()) return {number()};
  std::vector<double> out(size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Json& value = (*value_)[i];  // a place for each would take most of the time
    out[i] = value.is_number() ? value.get<double>() : at(i).number();
  }
  if (out.empty()) fail("at least one number");
  return out;
}

JsonDocument::JsonDocument(std::string file, const std::string& bytes, Places places)
    : file_(std::move(file)),
      document_(std::make_unique<Json>(parse_json(file_, bytes))),
      root_(file_, *document_, "", places) {}

JsonDocument::JsonDocument(std::string file, Places places)
    : file_(std::move(file)),
      document_(std::make_unique<Json>(read_json(file_))),
      root_(file_, *document_, "", places) {}

JsonDocument::~JsonDocument() {
  take_apart(*document_);
}

}  // namespace gonio
