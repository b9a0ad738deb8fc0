#include "reports/own/laws.h"

#include <algorithm>
#include <cmath>

#include "brdf/catalogue/foreign_terms.h"
#include "brdf/in_number/number.h"
#include "geometry/direction.h"
#include "integrate/albedo/normalisation.h"
#include "reports/measure/samples.h"
#include "reports/own/parameters.h"
#include "reports/own/row_columns.h"

namespace gonio {
namespace {

using auditing::Row;
using auditing::Values;

/// Five widths, both ends among them.
std::vector<double> widths_of(const Parameter& p) {
  auto at = values_between(p, 5);
  at.front() = low_of(p);
  at.back() = high_of(p);
  return at;
}

using Settings = std::vector<std::vector<double>>;

/// Values of parameters that laws are looked at with: five widths with the ends and the default of some others, colours at their
/// upper ends; each parameter at its ends with the others at their defaults; and some places over all bounds together.
Settings looked_at(std::span<const Parameter> parameters) {
  const auto width = width_of(parameters);
  const auto is_width = [&](const Parameter& p) { return width && &p == &parameters[*width]; };
  std::size_t rows = 1;
  constexpr std::size_t many = 60;
  auto all = auditing::combinations(parameters, [&](const Parameter& p) {
    const auto at = is_width(p)    ? widths_of(p)
                    : is_colour(p) ? std::vector{high_of(p)}
                    : rows > many || std::isnan(p.start)
                        ? std::vector{usual_of(p)}
                        : std::vector{p.legal.low, p.start, p.legal.high};
    rows *= at.size();
    return at;
  });
  std::vector<double> usual;
  for (const auto& p : parameters) usual.push_back(usual_of(p));
  for (const double w :
       width ? std::vector{low_of(parameters[*width]), usual[*width], high_of(parameters[*width])}
             : std::vector{0.0}) {
    auto at = usual;
    if (width) at[*width] = w;
    all.push_back(at);
    for (std::size_t k = 0; k < parameters.size(); ++k)
      for (const double v : {low_of(parameters[k]), high_of(parameters[k])}) {
        if (is_width(parameters[k])) continue;
        auto one = at;
        one[k] = v;
        all.push_back(one);
      }
  }
  constexpr std::size_t spread = 24;
  constexpr double golden = 0.618033988749895;
  for (std::size_t j = 1; j <= spread && !parameters.empty(); ++j) {
    std::vector<double> at;
    for (const auto& p : parameters) {
      const double part = std::fmod(static_cast<double>(j * (at.size() + 1)) * golden, 1);
      at.push_back(part < 0.3   ? low_of(p)
                   : part < 0.6 ? high_of(p)
                                : low_of(p) + (part - 0.6) / 0.4 * (high_of(p) - low_of(p)));
    }
    all.push_back(std::move(at));
  }
  return all;
}

/// Directions nearer to the horizon than those that laws are looked at with: there many shaders divide by 0 or take roots of less.
std::vector<Row> grazing() {
  std::vector<Row> rows;
  for (const double nol : {0.001, 0.01, 0.03, 0.5, 1.0})
    for (const double nov : {0.001, 0.01, 0.03, 0.5, 1.0})
      for (const double phi : {0.0, 90.0, 180.0})
        rows.push_back(auditing::row(std::acos(nol), 0, std::acos(nov), phi * degree));
  return rows;
}

bool is_within_one(std::span<const Parameter> parameters, const Values& p) {
  for (std::size_t k = 0; k < p.size(); ++k)
    if (p[k] > 1 && (is_colour(parameters[k]) || is_f90(parameters[k]))) return false;
  return true;
}

bool takes(const foreign::Function& f, std::string_view cosine, std::string_view vector) {
  return std::ranges::any_of(f.arguments, [&](const foreign::Argument& a) {
    return a.stands_for == cosine || a.stands_for == vector;
  });
}
bool takes_both_cosines(const foreign::Function& f) {
  return takes(f, "nol", "L") && takes(f, "nov", "V");
}

/// Names of parameters, and of a term's cosines, that its programs read and that change no value.
std::vector<std::string> without_effect(const foreign::Function& f,
                                        std::size_t term,
                                        std::span<const Parameter> parameters,
                                        const Settings& settings) {
  const Role role = catalogue()[term].role();
  std::vector<Row> rows;
  constexpr std::size_t part = 7;
  const auto& all_rows = auditing::rows_of(role);
  for (std::size_t i = part; i < all_rows.size(); i += part) rows.push_back(all_rows[i]);
  const auto values = [&](std::size_t c, const Values& p, const std::vector<Row>& at) {
    return f.is_g ? shown_in(Number::double_, term + c, p, at)
                  : values_in(Number::double_, term + c, p, at);
  };
  // The last settings spread over all bounds together.
  constexpr std::size_t enough = 24;
  const auto looked_at = std::span(settings).last(std::min(enough, settings.size()));
  const auto is_same_always = [&](const auto& changed) {
    for (const auto& p : looked_at)
      for (std::size_t c = 0; c < f.programs.size(); ++c)
        if (changed(c, p)) return false;
    return true;
  };
  const auto differ = [](const Values& v, const Values& w) {
    for (std::size_t i = 0; i < v.size(); ++i)
      if (std::isfinite(v[i]) && std::isfinite(w[i]) &&
          std::abs(v[i] - w[i]) > 1e-9 * std::max(std::abs(v[i]), std::abs(w[i])))
        return true;
    return false;
  };
  std::vector<std::string> names;
  for (std::size_t k = 0; k < parameters.size(); ++k)
    if (is_same_always([&](std::size_t c, Values p) {
          // Both ends may have one value, as f0 (1 − f0) has, or one of them none.
          p[k] = low_of(parameters[k]);
          const auto low = values(c, p, rows);
          constexpr std::size_t places = 3;
          auto at = values_between(parameters[k], places);
          at.push_back(high_of(parameters[k]));
          return std::ranges::any_of(at, [&](double v) {
            p[k] = v;
            return differ(low, values(c, p, rows));
          });
        }))
      names.emplace_back(parameters[k].name);
  const auto changes = [&](double Row::*cosine) {
    auto other = rows;
    for (auto& r : other) r.*cosine *= 0.6;
    return !is_same_always([&](std::size_t c, const Values& p) {
      return differ(values(c, p, rows), values(c, p, other));
    });
  };
  if (role == Role::masking && takes_both_cosines(f)) {
    const bool by_l = changes(&Row::nol), by_v = changes(&Row::nov);
    if (by_v && !by_l) names.emplace_back("NoL");
    if (by_l && !by_v) names.emplace_back("NoV");
  }
  if (role == Role::ndf && !f.reads_frame && takes(f, "noh", "H") && !changes(&Row::noh))
    names.emplace_back("NoH");
  if (role == Role::fresnel && takes(f, "voh", "voh") && !changes(&Row::voh))
    names.emplace_back("VoH");
  return names;
}

}  // namespace

double Row::*other_cosine(const foreign::Function& f) {
  const bool l = takes(f, "nol", "L"), v = takes(f, "nov", "V");
  return l == v ? nullptr : l ? &Row::nov : &Row::nol;
}

Laws laws_of(const foreign::Function& f, std::size_t term) {
  Laws a;
  const Role role = catalogue()[term].role();
  const auto parameters = known_parameters(term);
  const auto settings = looked_at(parameters);
  const auto& rows = auditing::rows_of(role);
  std::vector<Row> other;
  for (const auto& r : rows) other.push_back(auditing::exchanged(r));
  const auto horizon = role == Role::ndf || role == Role::fresnel ? std::vector<Row>{} : grazing();
  RowColumns at_rows(rows), at_other(other), at_horizon(horizon);
  const bool is_of_surface =
      std::ranges::any_of(parameters, [](const Parameter& q) { return is_f0(q) || is_eta(q); });
  constexpr double above_by_rounding = 1e-5;  // some fits' own
  constexpr double below_by_rounding = 1e-12;  // as (1 − VoH)⁵ is where VoH rounds to more than 1
  const auto count_finite = [&](const std::vector<double>& v, const Values& p,
                                const std::vector<Row>& at) {
    for (std::size_t i = 0; i < v.size(); ++i) {
      if (std::isfinite(v[i])) continue;
      if (a.not_finite++ == 0)
        a.not_finite_at = auditing::joined(auditing::text(parameters, p), auditing::text(at[i]));
    }
  };
  for (const auto& p : settings)
    for (std::size_t c = 0; c < f.programs.size(); ++c) {
      count_finite(at_horizon.values(term + c, p), p, horizon);
      const auto v = at_rows.values(term + c, p);
      const auto w = at_other.values(term + c, p);
      count_finite(v, p, rows);
      for (std::size_t i = 0; i < v.size(); ++i) {
        if (!std::isfinite(v[i])) continue;
        const auto at = [&] {
          return auditing::joined(auditing::text(parameters, p), auditing::text(rows[i]));
        };
        // A weight or an F90 above 1 is meant.
        const bool is_above = role == Role::fresnel && v[i] > 1 + above_by_rounding;
        if (is_above && is_of_surface && is_within_one(parameters, p))
          take_largest(a.above_one, v[i], at());
        if (v[i] < -below_by_rounding) take_smallest(a.lowest, v[i], at());
        const double size = std::max(std::abs(v[i]), std::abs(w[i]));
        const double off = std::abs(v[i] - w[i]);
        if ((role == Role::diffuse || role == Role::masking) && size > 0 &&
            (!a.reciprocity || off / size > a.reciprocity->value))
          a.reciprocity = FoundAt{off / size, at()};
      }
    }
  a.without_effect = without_effect(f, term, parameters, settings);
  if (role == Role::diffuse && a.not_finite == 0 && takes_both_cosines(f)) {
    const Row behind = auditing::row(100 * degree, 0, 30 * degree, 90 * degree);
    const auto v = values_in(Number::double_, term, settings[0], std::span(&behind, 1));
    a.fails_behind = !std::isfinite(v[0]);
  }
  // Masking by one cosine is half of a product, which alone keeps the law.
  if (role == Role::masking && !takes_both_cosines(f)) a.reciprocity.reset();
  if (role == Role::ndf)
    for (const auto& p : settings)
      if (const double v = normalisation(term, p).value;
          !a.normalisation || std::abs(v - 1) > std::abs(a.normalisation->value - 1))
        a.normalisation = FoundAt{v, auditing::text(parameters, p)};
  return a;
}

}  // namespace gonio
