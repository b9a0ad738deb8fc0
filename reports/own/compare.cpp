#include "reports/own/compare.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "base/error.h"
#include "base/json/describe.h"
#include "base/letters.h"
#include "brdf/catalogue/foreign_terms.h"
#include "brdf/cost/model_operations.h"
#include "brdf/in_number/number.h"
#include "brdf/model/evaluate.h"
#include "brdf/model/own_files.h"
#include "reports/measure/samples.h"
#include "reports/own/cost.h"
#include "reports/own/pairing.h"
#include "reports/own/parameters.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace gonio {

bool is_term_name(const std::string& name) {
  return foreign::is_name(name) || std::ranges::any_of(names_of<Role>, [&](auto role) {
           return name.starts_with(std::string(role) + ".");
         });
}

namespace {

using auditing::Row;
using auditing::Values;

/// Differences of a comparison as they come: the largest goes into it with its place.
class Differences {
 public:
  explicit Differences(TermComparison& c) : of_(c) {}
  /// One that is no number is left out.
  void take(double d, std::span<const Parameter> parameters, const Values& at, const Row& row) {
    if (!std::isfinite(d)) return;
    squares_ += d * d;
    ++count_;
    if (!(d > of_.largest)) return;
    of_.largest = d;
    of_.at = auditing::joined(auditing::text(parameters, at), auditing::text(row));
  }
  double rms() const { return count_ ? std::sqrt(squares_ / static_cast<double>(count_)) : 0; }

 private:
  TermComparison& of_;
  double squares_ = 0;
  std::size_t count_ = 0;
};

constexpr std::size_t compared_at = 9;  ///< places between the bounds

/// One side of a comparison: its parameters, and its values over rows.
struct Side {
  std::vector<Parameter> parameters;
  std::function<Values(const Values&)> at;
};

/// Whether that name is a parameter's, or that of the colour whose channel it is.
bool is_called(const Parameter& p, std::string_view name) {
  return same_letters(p.name, name) || same_letters(stem_of(p.name), name);
}

/// What is said of a parameter.
const Range* said_of(const Domain& domain, const Parameter& p) {
  const auto said =
      std::ranges::find_if(domain, [&](const auto& d) { return is_called(p, d.first); });
  return said == domain.end() ? nullptr : &said->second;
}

/// Values of one's own parameters at a place within their bounds or those of a domain.  Metals are left out where nothing is said of
/// them, and two widths are not the same.
Values own_values(const Side& own, const Domain& domain, std::size_t k) {
  Values all;
  for (const auto& p : own.parameters) {
    Parameter at = p;
    const Range* const said = said_of(domain, p);
    if (said) at.legal = *said, at.start = said->low;
    const bool is_left_out = is_metallic(p) && !said;
    const bool is_second = p.meaning.ends_with('y') || p.meaning.ends_with('b');
    all.push_back(is_left_out
                      ? low_of(p)
                      : values_between(at, compared_at)[is_second ? (2 * k + 3) % compared_at : k]);
  }
  return all;
}

/// Asks for the bounds of all parameters that have none, by names that --domain takes.
void expect_bounds(const Side& own, const std::string& name, const Domain& domain) {
  std::vector<std::string> missing;
  for (const auto& p : own.parameters) {
    const std::string stem(stem_of(p.name));
    if (std::isnan(p.start) && !said_of(domain, p) &&
        std::ranges::find(missing, stem) == missing.end())
      missing.push_back(stem);
  }
  if (missing.empty()) return;
  throw wrong_usage(fmt::format("{} of {} {} no bounds: give them by --domain {}=LOW,HIGH",
                                fmt::join(missing, ", "), name, missing.size() > 1 ? "have" : "has",
                                fmt::join(missing, "=LOW,HIGH ")));
}

/// Compares by each of the pairs, and takes those of the least difference.
/// \param difference  of two values, given the largest of the other's
void compare_sides(TermComparison& c,
                   const Side& own,
                   const Side& other,
                   const std::vector<Row>& rows,
                   const Domain& domain,
                   double (*difference)(double own, double other, double most)) {
  for (const auto& [name, range] : domain) {
    const auto is_it = [&](const Parameter& q) { return is_called(q, name); };
    if (std::ranges::none_of(own.parameters, is_it) &&
        std::ranges::none_of(other.parameters, is_it))
      throw wrong_usage(fmt::format("neither {} nor {} has a parameter '{}'", c.a, c.b, name));
  }
  expect_bounds(own, c.a, domain);
  std::vector<Values> p, f;
  for (std::size_t k = 0; k < compared_at; ++k) {
    p.push_back(own_values(own, domain, k));
    f.push_back(own.at(p.back()));
  }
  const auto only_own = [&](const Parameter& q) {
    const Range* const said = said_of(domain, q);
    const Range at = said             ? *said
                     : is_metallic(q) ? Range{low_of(q), low_of(q)}
                                      : Range{low_of(q), high_of(q)};
    return at.low < at.high ? fmt::format("{} {:.4g} to {:.4g}", q.name, at.low, at.high)
                            : fmt::format("{} {:.4g}", q.name, at.low);
  };
  const auto alone = [&](const Parameter& w) {  // the other's
    const Range* const said = said_of(domain, w);
    return said ? said->low : std::isnan(w.start) ? 0.5 : w.start;
  };
  std::optional<TermComparison> best;
  for (const auto& pairs : possible_pairs(own.parameters, other.parameters)) {
    TermComparison t = c;
    Differences differences(t);
    for (std::size_t k = 0; k < compared_at; ++k) {
      Values q;
      for (std::size_t j = 0; j < pairs.size(); ++j) {
        const auto& w = other.parameters[j];
        q.push_back(
            std::clamp(pairs[j] ? pairs[j]->value(p[k]) : alone(w), w.legal.low, w.legal.high));
      }
      const auto g = other.at(q);
      const double most = *std::ranges::max_element(g);
      for (std::size_t i = 0; i < rows.size(); ++i)
        differences.take(difference(f[k][i], g[i], most), own.parameters, p[k], rows[i]);
    }
    t.rms = differences.rms();
    t.pairs = text_of(pairs, other.parameters);
    for (const auto k : unpaired(pairs, own.parameters))
      t.only_a.push_back(only_own(own.parameters[k]));
    for (std::size_t j = 0; j < pairs.size(); ++j)
      if (const auto& w = other.parameters[j]; !pairs[j])
        t.only_b.push_back(fmt::format("{} {:.4g}", w.name, alone(w)));
      else if (const Range* const said = said_of(domain, w);
               said && !(said->low < said->high) &&
               std::ranges::none_of(own.parameters, [&](const Parameter& q) {
                 return same_letters(q.name, w.name);
               }))
        throw wrong_usage(fmt::format("{} is {} here: set that", w.name, pairs[j]->text));
    if (!best || t.largest < best->largest) best = std::move(t);
  }
  c = std::move(*best);
}

Side side_of_term(std::size_t term, const std::vector<Row>& rows) {
  return {known_parameters(term),
          [term, &rows](const Values& p) { return shown_in(Number::double_, term, p, rows); }};
}

}  // namespace

TermComparison compare_terms(const std::string& a, const std::string& b, const Domain& domain) {
  const bool a_is_own = foreign::is_name(a), b_is_own = foreign::is_name(b);
  const std::size_t first = a_is_own ? 0 : find_term(a), second = b_is_own ? 0 : find_term(b);
  std::optional<Role> role;
  if (!a_is_own) role = catalogue()[first].role();
  if (!b_is_own) role = catalogue()[second].role();
  if (!role) role = catalogue()[foreign_term_named(a)].role();
  std::vector<std::string> tries{a};
  if (*role == Role::masking && a_is_own && a.find("includes=") == a.npos) {
    const auto close = a.rfind('}');
    const auto with = [&](const std::string& what) {
      return close == a.npos ? a + "{includes=" + what + "}"
                             : a.substr(0, close) + ";includes=" + what + "}";
    };
    tries = {with("v"), with("g")};
  }
  std::optional<TermComparison> best;
  for (const auto& name : tries) {
    const std::size_t x = a_is_own ? foreign_term_named(name, role) : first;
    const std::size_t y = b_is_own ? foreign_term_named(b, role) : second;
    const auto &own = catalogue()[x], &other = catalogue()[y];
    if (own.role() != other.role())
      throw wrong_usage(fmt::format("{} is of {}, {} of {}: terms of one role are compared", a,
                                    name_of(own.role()), b, name_of(other.role())));
    static constexpr std::string_view measures[] = {"D over the peak", "G2", "F", "f"};
    TermComparison c;
    c.a = a, c.b = b;
    c.measure = measures[static_cast<std::size_t>(*role)];
    if (tries.size() > 1) c.read_as = name.find("includes=v") != name.npos ? "V" : "G";
    const auto& rows = auditing::rows_of(*role);
    compare_sides(
        c, side_of_term(x, rows), side_of_term(y, rows), rows, domain,
        *role == Role::ndf ? [](double f, double g, double most) { return std::abs(f - g) / most; }
                           : [](double f, double g, double) { return std::abs(f - g); });
    c.operations_a = operations_in_one(x);
    c.operations_b = operations_in_one(y);
    for (const auto term_of : {x, y})
      if (const auto* f = foreign_term(term_of); f && c.in_channels.empty())
        c.in_channels = channels_text(*f->function, true);
    if (!best || c.largest < best->largest) {
      best = c;
      best->half_a = in_half(x, domain);
      best->half_b = in_half(y, domain);
    }
  }
  return *best;
}

double difference_between(std::size_t own, std::size_t other, const Domain& domain) {
  TermComparison c;
  const auto& rows = auditing::rows_of(catalogue()[own].role());
  compare_sides(c, side_of_term(own, rows), side_of_term(other, rows), rows, domain,
                [](double f, double g, double) { return std::abs(f - g); });
  return c.rms;
}

TermComparison compare_with_model(const std::string& own,
                                  const std::string& spec,
                                  const Domain& domain) {
  const std::size_t term = foreign_term_named(own);
  const auto& entry = catalogue()[term];
  if (entry.role() != Role::diffuse)
    throw wrong_usage(fmt::format("{} is of {}, and {} a whole model: name a term of ours, as {}.…",
                                  own, name_of(entry.role()), spec, name_of(entry.role())));
  TermComparison c;
  c.a = own, c.b = spec, c.measure = "f over its own value";
  const auto& rows = auditing::rows_of(Role::diffuse);
  BoundModel model = bind_model(spec, {}, 1);
  Side theirs{{}, [&](const Values& q) {
                for (std::size_t j = 0; j < q.size(); ++j)
                  model.values[model.model.parameters[j].first] = q[j];
                return evaluate(model, rows)[0];
              }};
  for (const auto& q : model.model.parameters) {
    Parameter p = *q.about;
    p.name = p.meaning = q.name;
    p.start = model.values[q.first];
    theirs.parameters.push_back(p);
  }
  const Side ours{known_parameters(term),
                  [&](const Values& p) { return values_in(Number::double_, term, p, rows); }};
  compare_sides(c, ours, theirs, rows, domain, [](double f, double g, double most) {
    constexpr double nothing = 1e-12;  // two that are as good as 0 are the same
    const bool is_nothing = std::max(std::abs(f), std::abs(g)) < nothing * most;
    return is_nothing ? 0 : std::abs(f / g - 1);
  });
  const auto& f = *foreign_term(term)->function;
  const bool in_one = model.model.lobes.empty();
  const std::size_t channels = in_one ? 1 : channels_of(f);
  c.operations_a = operations_of(f, channels).total();
  c.operations_b = operations_in(spec, channels);
  c.in_channels = channels_text(f, in_one);
  c.half_a = in_half(term, domain);
  c.half_b = in_half(stability::subjects_of(spec).back(), {});
  return c;
}

std::string to_json(const TermComparison& c) {
  Json document{{"a", c.a},
                {"b", c.b},
                {"read_as", c.read_as.empty() ? Json() : Json(c.read_as)},
                {"parameters", c.pairs.empty() ? Json() : Json(c.pairs)},
                {"only_a", c.only_a},
                {"only_b", c.only_b},
                {"measure", c.measure},
                {"largest", c.largest},
                {"at", c.at},
                {"rms", c.rms},
                {"operations", {c.operations_a, c.operations_b}},
                {"half", {c.half_a, c.half_b}}};
  const auto files = own_files({c.a, c.b});
  if (!files.empty()) document[std::string(own_files_key)] = json_of(files);
  return text_of(document);
}

std::string text_of(const TermComparison& c) {
  std::string s = fmt::format("{} beside {}{}\n", c.a, c.b,
                              c.read_as.empty() ? "" : fmt::format(", read as {}", c.read_as));
  if (!c.pairs.empty()) s += fmt::format("  {:<14}{}\n", "parameters", c.pairs);
  for (const auto& [of, only] : {std::pair(c.a, c.only_a), {c.b, c.only_b}})
    if (!only.empty())
      s += fmt::format("  {:<14}{}: {}; --set NAME=VALUE sets it\n", "only one has", of,
                       fmt::join(only, ", "));
  s += c.largest < 1e-12 ? fmt::format("  {:<14}none, in {}\n", "difference", c.measure)
                         : fmt::format("  {:<14}{:.4g} at most, RMS {:.3g}, in {}; at {}\n",
                                       "difference", c.largest, c.rms, c.measure, c.at);
  s += fmt::format("  {:<14}{} and {} operations{}\n", "cost", c.operations_a, c.operations_b,
                   c.in_channels);
  s += fmt::format("  {:<14}{}\n  {:<14}{}\n", "in half", c.half_a, "", c.half_b);
  return s;
}

}  // namespace gonio
