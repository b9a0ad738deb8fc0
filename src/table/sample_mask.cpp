#include "table/sample_mask.h"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>

#include "base/error.h"
#include "base/numbers.h"

#include <fmt/format.h>

namespace gonio {
namespace {

constexpr std::array<std::string_view, 10> angle_names{
    "theta_i", "phi_i", "theta_o", "phi_o", "phi", "theta_h", "theta_d", "retro", "mirror", "f"};

/// What names stand for at one sample: those above, then each channel.
using NamedValues = std::vector<double>;

double between_deg(const Direction& a, const Direction& b) {
  const Direction d{a.x - b.x, a.y - b.y, a.z - b.z};
  return 2 * std::asin(std::min(1.0, std::sqrt(dot(d, d)) / 2)) / degree;
}

void name_values(const Table& t, const SampleAngles& at, std::size_t i, NamedValues& to) {
  const auto p = at.directions(i);
  const DirectionList* l = t.list();
  const double phi_i = l ? l->phi_i_deg[i] : phi_of(p.wi) / degree,
               phi_o = l ? l->phi_o_deg[i] : phi_of(p.wo) / degree;
  const auto half = half_difference(p);
  double mean = 0;
  for (const auto& plane : t.values) mean += plane[i] / static_cast<double>(t.values.size());
  to = {l ? l->theta_i_deg[i] : theta_of(p.wi) / degree,
        phi_i,
        l ? l->theta_o_deg[i] : theta_of(p.wo) / degree,
        phi_o,
        std::abs(std::remainder(phi_o - phi_i, 360)),
        half.theta_h / degree,
        half.theta_d / degree,
        between_deg(p.wi, p.wo),
        between_deg({-p.wi.x, -p.wi.y, p.wi.z}, p.wo),
        mean};
  for (const auto& plane : t.values) to.push_back(plane[i]);
}

/// Part of an expression: a number, or a truth that is 1 or 0.
struct Part {
  std::function<double(const NamedValues&)> value;
  bool truth = false;
};
struct DividedByZero {};

/// Parser by descent, one function a level.
class Parser {
 public:
  Parser(std::string_view text, const Table& t) : text_(text), table_(t) {}
  Part whole() {
    if (text_.size() > 1000) fail("more than 1000 characters", "a short expression");
    Part p = either();
    skip_blanks();
    if (at_ < text_.size()) fail_here("and, or, or the end");
    expect_truth(p);
    return p;
  }

 private:
  [[noreturn]] void fail(const std::string& found, const std::string& expected) const {
    throw wrong_usage(
        fmt::format("--mask: character {}: found {}, expected {}", at_ + 1, found, expected));
  }
  [[noreturn]] void fail_here(const std::string& expected) const {
    fail(at_ < text_.size() ? fmt::format("'{}'", text_.substr(at_, 16)) : "the end", expected);
  }
  void skip_blanks() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }
  static bool in_name(char c) {
    return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9') || c == '_' ||
           c == '.';
  }
  bool take(std::string_view sign) {
    skip_blanks();
    if (!text_.substr(at_).starts_with(sign)) return false;
    const std::size_t end = at_ + sign.size();
    if (in_name(sign.back()) && end < text_.size() && in_name(text_[end])) return false;
    at_ = end;
    return true;
  }
  void expect_truth(const Part& p) const {
    if (!p.truth) fail_here("a comparison: <, <=, >, >=, == or !=");
  }
  void expect_number(const Part& p) const {
    if (p.truth) fail_here("a number: what was compared is none");
  }

  Part either() {
    Part a = both();
    while (take("or")) {
      expect_truth(a);
      Part b = both();
      expect_truth(b);
      a.value = [a = a.value, b = b.value](const NamedValues& n) { return a(n) != 0 || b(n) != 0; };
    }
    return a;
  }
  Part both() {
    Part a = negated();
    while (take("and")) {
      expect_truth(a);
      Part b = negated();
      expect_truth(b);
      a.value = [a = a.value, b = b.value](const NamedValues& n) { return a(n) != 0 && b(n) != 0; };
    }
    return a;
  }
  Part negated() {
    if (!take("not")) return compared();
    const Nested deeper(*this);
    Part a = negated();
    expect_truth(a);
    return {[a = a.value](const NamedValues& n) { return a(n) == 0; }, true};
  }
  /// a < b < c is a < b and b < c.
  Part compared() {
    using Compare = bool (*)(double, double);
    static constexpr std::array<std::pair<std::string_view, Compare>, 6> signs{
        {{"<=", [](double a, double b) { return a <= b; }},
         {">=", [](double a, double b) { return a >= b; }},
         {"==", [](double a, double b) { return a == b; }},
         {"!=", [](double a, double b) { return a != b; }},
         {"<", [](double a, double b) { return a < b; }},
         {">", [](double a, double b) { return a > b; }}}};
    Part left = sum(), all = left;
    for (bool first = true;; first = false) {
      const auto sign = std::ranges::find_if(signs, [&](const auto& s) { return take(s.first); });
      if (sign == signs.end()) return all;
      expect_number(left);
      Part right = sum();
      expect_number(right);
      all = {[before = first ? nullptr : all.value, a = left.value, b = right.value,
              compare = sign->second](const NamedValues& n) {
               return (!before || before(n) != 0) && compare(a(n), b(n));
             },
             true};
      left = right;
    }
  }
  Part sum() {
    Part a = product();
    for (;;) {
      const bool plus = take("+");
      if (!plus && !take("-")) return a;
      expect_number(a);
      Part b = product();
      expect_number(b);
      a.value = [a = a.value, b = b.value, sign = plus ? 1.0 : -1.0](const NamedValues& n) {
        return a(n) + sign * b(n);
      };
    }
  }
  Part product() {
    Part a = signed_one();
    for (;;) {
      const bool times = take("*");
      if (!times && !take("/")) return a;
      expect_number(a);
      Part b = signed_one();
      expect_number(b);
      a.value = [a = a.value, b = b.value, times](const NamedValues& n) {
        const double y = b(n);
        if (!times && y == 0) throw DividedByZero();
        return times ? a(n) * y : a(n) / y;
      };
    }
  }
  Part signed_one() {
    if (!take("-")) return one();
    const Nested deeper(*this);
    Part a = signed_one();
    expect_number(a);
    return {[a = a.value](const NamedValues& n) { return -a(n); }, false};
  }
  Part one() {
    if (take("(")) {
      const Nested deeper(*this);
      Part p = either();
      if (!take(")")) fail_here("')'");
      return p;
    }
    skip_blanks();
    const std::size_t from = at_;
    std::size_t end = at_;
    while (end < text_.size() &&
           (in_name(text_[end]) ||
            ((text_[end] == '-' || text_[end] == '+') && end > from &&
             (text_[end - 1] | 0x20) == 'e' && '0' <= text_[from] && text_[from] <= '9')))
      ++end;
    const std::string_view word = text_.substr(from, end - from);
    if (const auto number = number_from<double>(word); number && std::isfinite(*number)) {
      at_ = end;
      return {[x = *number](const NamedValues&) { return x; }, false};
    }
    const auto named = [&](std::size_t k) -> Part {
      at_ = end;
      return {[k](const NamedValues& n) { return n[k]; }, false};
    };
    for (std::size_t k = 0; k < angle_names.size(); ++k)
      if (word == angle_names[k]) return named(k);
    for (std::size_t c = 0; c < table_.channels.size(); ++c)
      if (word == "f_" + table_.channels[c]) return named(angle_names.size() + c);
    fail_here(fmt::format("a number, '(', {} or f_CHANNEL", fmt::join(angle_names, ", ")));
  }

  /// Depth of what is being parsed.
  struct Nested {
    Parser& parser;
    explicit Nested(Parser& p) : parser(p) {
      if (++parser.depth_ > 50) parser.fail("more than 50 levels", "fewer");
    }
    ~Nested() { --parser.depth_; }
  };

  std::string_view text_;
  const Table& table_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

/// A list loses the other samples, a grid has no value there.
void keep_where(Table& t, const std::vector<bool>& kept) {
  if (t.grid()) {
    for (auto& plane : t.values)
      for (std::size_t i = 0; i < plane.size(); ++i)
        if (!kept[i]) plane[i] = std::numeric_limits<double>::quiet_NaN();
    return;
  }
  const auto keep = [&](auto& all) {
    if (all.empty()) return;
    std::size_t to = 0;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (kept[i]) all[to++] = all[i];
    all.resize(to);
  };
  auto& l = std::get<DirectionList>(t.where);
  for (auto* angles : {&l.theta_i_deg, &l.phi_i_deg, &l.theta_o_deg, &l.phi_o_deg}) keep(*angles);
  for (auto* planes : {&t.values, &t.errors})
    for (auto& plane : *planes) keep(plane);
  keep(t.weights);
  keep(t.patches);
}

}  // namespace

void leave_out(Table& t, std::string_view expression) {
  const auto place = [&] { return fmt::format("--mask '{}'", expression); };
  const Part mask = Parser(expression, t).whole();
  const SampleAngles at(t);
  std::vector<bool> out(t.size());
  NamedValues named;
  for (std::size_t i = 0; i < t.size(); ++i) {
    name_values(t, at, i, named);
    try {
      out[i] = mask.value(named) != 0;
    } catch (const DividedByZero&) {
      throw bad_input(t.path, place(), fmt::format("a division by 0 at sample {}", i + 1),
                      "a divisor that is never 0");
    }
  }
  const auto count = static_cast<std::size_t>(std::ranges::count(out, true));
  if (count == t.size()) throw bad_input(t.path, place(), "no sample left", "at least one");
  t.notes.emplace_back("mask",
                       fmt::format("{} leaves out {} of {} samples", expression, count, t.size()));
  t.mask = expression;
  if (count == 0) return;
  t.between = nullptr;  // it would speak for what is left out
  t.left_out.reset();
  auto rest = std::make_shared<Table>(t);
  keep_where(*rest, out);
  out.flip();
  keep_where(t, out);
  t.left_out = std::move(rest);
}

std::size_t values_left_out(const Table& t, Mask otherwise) {
  if (!t.left_out) return 0;
  const SampleAngles at(*t.left_out);
  std::size_t count = 0;
  for (const auto& plane : t.left_out->values)
    for (std::size_t i = 0; i < plane.size(); ++i) count += mask(at(i), plane[i]) == otherwise;
  return count;
}

}  // namespace gonio
