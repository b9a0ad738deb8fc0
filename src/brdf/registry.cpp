#include "brdf/registry.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/error.h"
#include "brdf/evaluate.h"

#include <fmt/format.h>

namespace gonio {
namespace {

/// Levenshtein distance: how many letters a typing error changed.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({change, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

std::size_t find(std::string_view id, auto&& name, auto&& eligible, std::string_view what) {
  const auto terms = catalogue();
  std::vector<std::pair<std::size_t, std::string_view>> near;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    if (!eligible(terms[i].about->id)) continue;
    const std::string_view n = name(terms[i].about->id);
    if (n == id) return i;
    near.emplace_back(distance(id, n), n);
  }
  std::ranges::stable_sort(near, {}, [](const auto& p) { return p.first; });
  if (near.size() > 3) near.resize(3);
  std::vector<std::string_view> names;
  for (const auto& n : near) names.push_back(n.second);
  throw wrong_usage(fmt::format("no {} '{}'; nearest: {}", what, id, fmt::join(names, ", ")));
}

template <class F>
std::vector<double> values(std::size_t term,
                           std::span<const double> parameters,
                           std::span<const FrameAngles<double>> rows) {
  const auto& k = kernels<F>("scalar");
  std::vector<F> p(parameters.begin(), parameters.end());
  AngleColumns<F> x(rows.size(), true);
  for (std::size_t i = 0; i < rows.size(); ++i) x.set(i, rows[i]);
  const std::size_t n = x.padded();
  const Column<F> ones(n, F(1)), zeros(n, F(0));
  Column<F> out(n);
  k.terms[term].add(x.block(), p.data(), {ones.data(), nullptr, zeros.data(), out.data(), nullptr});
  if (role_of(k.terms[term].about->id) == Role::masking)
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const F cosines = 4 * F(rows[i].nol) * F(rows[i].nov);
      out[i] = cosines > 0 ? cosines * out[i] : 0;  // at grazing G2 is 0, even where V has no bound
    }
  return {out.data(), out.data() + rows.size()};
}

}  // namespace

std::span<const TermKernels<double>> catalogue() {
  return kernels<double>("scalar").terms;
}

std::size_t find_term(std::string_view id) {
  return find(
      id, [](std::string_view s) { return s; }, [](std::string_view) { return true; }, "term");
}

std::size_t find_term(std::string_view id, Role role) {
  static constexpr std::string_view names[] = {"normal distribution", "masking", "Fresnel term",
                                               "diffuse term"};
  return find(
      id, short_id, [=](std::string_view s) { return role_of(s) == role; },
      names[static_cast<int>(role)]);
}

void check_range(const Parameter& p, std::string_view name, double value) {
  if (!p.legal.holds(value))
    throw wrong_usage(
        fmt::format("{} = {} is outside [{}, {}]", name, value, p.legal.low, p.legal.high));
}

TermValues evaluate_term(std::size_t term,
                         Number number,
                         const std::map<std::string, double>& parameters,
                         const std::map<std::string, std::vector<double>>& at) {
  const auto& t = catalogue()[term];
  TermValues result;
  std::vector<double> p;
  for (const auto& q : t.parameters) {
    const auto given = parameters.find(std::string(q.name));
    const double v = given == parameters.end() ? q.start : given->second;
    check_range(q, q.name, v);
    p.push_back(v);
    result.parameters.emplace_back(q.name, v);
  }
  for (const auto& [name, value] : parameters)
    if (std::ranges::none_of(t.parameters, [&, n = name](const auto& q) { return q.name == n; }))
      throw wrong_usage(fmt::format("{} has no parameter '{}'", t.about->id, name));

  using Row = FrameAngles<double>;
  static constexpr std::pair<std::string_view, double Row::*> known[] = {
      {"nol", &Row::nol}, {"nov", &Row::nov}, {"noh", &Row::noh},
      {"voh", &Row::voh}, {"cos", &Row::voh}, {"sin2_theta_h", &Row::sin2_theta_h},
      {"xoh", &Row::xoh}, {"yoh", &Row::yoh}, {"xol", &Row::xol},
      {"yol", &Row::yol}, {"xov", &Row::xov}, {"yov", &Row::yov}};
  std::size_t rows = 1;
  for (const auto& [name, column] : at) {
    const auto it = std::ranges::find(known, name, [](const auto& k) { return k.first; });
    if (it == std::end(known)) {
      std::vector<std::string_view> names;
      for (const auto& k : known) names.push_back(k.first);
      throw wrong_usage(fmt::format("unknown angle '{}'; known: {}", name, fmt::join(names, ", ")));
    }
    const double lowest = name.starts_with('x') || name.starts_with('y') ? -1 : 0;
    for (const double v : column)
      if (!(lowest <= v && v <= 1))
        throw wrong_usage(fmt::format("{} = {} is outside [{}, 1]", name, v, lowest));
    if (column.size() == 1) continue;
    if (rows != 1 && rows != column.size())
      throw wrong_usage(
          fmt::format("'{}' has {} values where another has {}", name, column.size(), rows));
    rows = column.size();
  }
  if (at.contains("cos") && at.contains("voh")) throw wrong_usage("cos and voh are the same angle");

  std::vector<Row> angles(rows, Row{{1, 1, 1, 1, 0}, 0, 0, 0, 0, 0, 0});
  for (const auto& [name, column] : at) {
    const auto member =
        std::ranges::find(known, name, [](const auto& k) { return k.first; })->second;
    for (std::size_t i = 0; i < rows; ++i) angles[i].*member = column[column.size() == 1 ? 0 : i];
  }
  const auto given = [&](const char* x, const char* y) { return at.contains(x) || at.contains(y); };
  const auto sine = [](double c) { return std::sqrt((1 - c) * (1 + c)); };
  for (auto& a : angles) {
    if (!at.contains("sin2_theta_h"))
      a.sin2_theta_h =
          given("xoh", "yoh") ? a.xoh * a.xoh + a.yoh * a.yoh : (1 - a.noh) * (1 + a.noh);
    if (!(a.sin2_theta_h <= 1))
      throw wrong_usage(fmt::format("xoh = {} and yoh = {}: no unit vector", a.xoh, a.yoh));
    if (!at.contains("noh")) a.noh = std::sqrt(1 - a.sin2_theta_h);
    if (!given("xoh", "yoh")) a.xoh = std::sqrt(a.sin2_theta_h);
    if (!given("xol", "yol")) a.xol = sine(a.nol);
    if (!given("xov", "yov")) a.xov = sine(a.nov);
  }
  result.values =
      number == Number::double_ ? values<double>(term, p, angles) : values<float>(term, p, angles);
  return result;
}

}  // namespace gonio
