#include "brdf/in_number/one_term.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "brdf/catalogue/foreign_terms.h"
#include "brdf/catalogue/registry.h"
#include "geometry/frame_of_angles.h"

#include <fmt/format.h>

namespace gonio {
namespace {

/// The values of an entry's parameters: those given, else the defaults; refuses what it does not have.
std::vector<double> resolve(const About& about,
                            std::span<const Parameter> parameters,
                            const std::map<std::string, double>& given,
                            std::vector<std::pair<std::string, double>>& used) {
  std::vector<double> p;
  for (const auto& q : parameters) {
    const auto it = given.find(std::string(q.name));
    const double v = it == given.end() ? q.start : it->second;
    check_range(q, q.name, v);
    p.push_back(v);
    used.emplace_back(q.name, v);
  }
  for (const auto& [name, value] : given)
    if (std::ranges::none_of(parameters, [&, n = name](const auto& q) { return q.name == n; })) {
      std::vector<std::string_view> names;
      for (const auto& q : parameters) names.push_back(q.name);
      throw wrong_usage(
          fmt::format("{} has no parameter '{}'; it has: {}", about.id, name,
                      names.empty() ? "none" : fmt::to_string(fmt::join(names, ", "))));
    }
  return p;
}

/// Number of rows that columns make, those of one value serving all.
std::size_t count_rows(const std::map<std::string, std::vector<double>>& at) {
  std::size_t rows = 1;
  for (const auto& [name, column] : at) {
    if (column.size() == 1) continue;
    if (rows != 1 && rows != column.size())
      throw wrong_usage(
          fmt::format("'{}' has {} values where another has {}", name, column.size(), rows));
    rows = column.size();
  }
  return rows;
}
double in_row(const std::vector<double>& column, std::size_t row) {
  return column[column.size() == 1 ? 0 : row];
}

}  // namespace

bool reads_angle(std::size_t term, double FrameAngles<double>::*angle) {
  using Row = FrameAngles<double>;
  static const std::array<Row, 3> places{{
      {{0.61, 0.53, 0.83, 0.71, 0.3111}, 0.41, 0.37, 0.57, -0.44, 0.31, 0.66},
      {{0.11, 0.93, 0.27, 0.79, 0.9271}, 0.81, 0.51, 0.87, -0.48, 0.33, 0.16},
      {{0.89, 0.07, 0.35, 0.97, 0.8775}, 0.77, 0.53, 0.31, 0.33, 0.61, -0.79},
  }};
  std::vector<double> p;
  for (const auto& q : catalogue()[term].parameters) p.push_back(q.start);
  return std::ranges::any_of(places, [&](const Row& place) {
    std::array rows{place, place};
    rows[1].*angle *= 0.97;
    const auto value = values_in(Number::double_, term, p, rows);
    return value[0] < value[1] || value[1] < value[0];
  });
}

TermValues evaluate_term(std::size_t term,
                         Number number,
                         const std::map<std::string, double>& parameters,
                         const std::map<std::string, std::vector<double>>& at) {
  const auto& t = catalogue()[term];
  TermValues result;
  const auto p = resolve(*t.about, t.parameters, parameters, result.parameters);

  using Row = FrameAngles<double>;
  static constexpr std::pair<std::string_view, double Row::*> known[] = {
      {"nol", &Row::nol}, {"nov", &Row::nov}, {"noh", &Row::noh},
      {"voh", &Row::voh}, {"cos", &Row::voh}, {"sin2_theta_h", &Row::sin2_theta_h},
      {"xoh", &Row::xoh}, {"yoh", &Row::yoh}, {"xol", &Row::xol},
      {"yol", &Row::yol}, {"xov", &Row::xov}, {"yov", &Row::yov}};
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
  }
  const std::size_t rows = count_rows(at);
  if (at.contains("cos") && at.contains("voh")) throw wrong_usage("cos and voh are the same angle");

  std::vector<Row> angles(rows, Row{{1, 1, 1, 1, 0}, 0, 0, 0, 0, 0, 0});
  for (const auto& [name, column] : at) {
    const auto member =
        std::ranges::find(known, name, [](const auto& k) { return k.first; })->second;
    for (std::size_t i = 0; i < rows; ++i) angles[i].*member = in_row(column, i);
  }
  // NoH and VoH of two directions; of those that are not given.
  const bool has_half = at.contains("noh"), has_facing = at.contains("voh") || at.contains("cos");
  const bool of_directions = at.contains("nol") || at.contains("nov");
  if (of_directions && !(has_half && has_facing) &&
      (reads_angle(term, &Row::noh) || reads_angle(term, &Row::voh))) {
    if (!has_half && !has_facing && at.contains("nol") && at.contains("nov"))
      throw wrong_usage(fmt::format(
          "{} reads the half vector: expected voh or noh beside nol and nov", t.about->id));
    for (auto& a : angles) {
      const double sum = a.nol + a.nov;
      if (!has_half && !has_facing) a.voh = std::sqrt(sum / 2);  // the other along the normal
      (has_half ? a.voh : a.noh) = sum / (2 * (has_half ? a.noh : a.voh));
      if (!((has_half ? a.voh : a.noh) <= 1 + 1e-12))
        throw wrong_usage(fmt::format("no two directions have nol = {}, nov = {} and {} = {}",
                                      a.nol, a.nov, has_half ? "noh" : "voh",
                                      has_half ? a.noh : a.voh));
      a.noh = std::min(a.noh, 1.0), a.voh = std::min(a.voh, 1.0);
    }
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
  const auto* const file = foreign_term(term);
  if (file && file->function->reads_frame && !file->function->anisotropic && !given("xol", "yol") &&
      !given("xov", "yov"))
    for (auto& a : angles) a = with_frame<double>(a);
  result.values = shown_in(number, term, p, angles);
  return result;
}

MapValues evaluate_map(std::size_t map,
                       Number number,
                       const std::map<std::string, double>& parameters,
                       const std::map<std::string, std::vector<double>>& at) {
  const auto& m = maps()[map];
  MapValues result;
  const auto p = resolve(*m.about, m.parameters, parameters, result.parameters);
  for (const auto& [name, column] : at) {
    const auto it = std::ranges::find(m.parameters, name, &Parameter::name);
    if (it == m.parameters.end())
      throw wrong_usage(fmt::format("{} does not read '{}'", m.about->id, name));
    if (parameters.contains(name)) throw wrong_usage(fmt::format("'{}' is set and listed", name));
    for (const double v : column) check_range(*it, name, v);
    std::erase_if(result.parameters, [&, n = name](const auto& used) { return used.first == n; });
  }
  for (std::size_t row = 0; row < count_rows(at); ++row) {
    auto q = p;
    for (std::size_t k = 0; k < q.size(); ++k)
      if (const auto it = at.find(std::string(m.parameters[k].name)); it != at.end())
        q[k] = in_row(it->second, row);
    result.values.push_back(map_in(number, map, q));
  }
  return result;
}

}  // namespace gonio
