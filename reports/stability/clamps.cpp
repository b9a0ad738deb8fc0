// What the clamps that shaders ship save and cost: the same inputs with each and without.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "brdf/catalogue/registry.h"
#include "brdf/in_number/number.h"
#include "reports/stability/measure.h"
#include "reports/stability/stability.h"

namespace gonio {
namespace {

using stabilities::Inputs;

/// A form with a clamp beside the one without it, as functions of the same inputs.
struct Clamp {
  std::string name, where;
  std::string by;  ///< what people look at: "alpha", or "cosine", the smaller of both
  std::vector<Inputs> inputs;
  std::function<double(Number, const Inputs&)> with, without;
};

/// D over widths and half vectors, both in logarithms: {alpha, NoH}.
std::vector<Inputs> half_vectors() {
  std::vector<Inputs> all;
  for (const double alpha : stabilities::in_logarithms(1e-4, 1, 61))
    for (const double s2 : stabilities::in_logarithms(1e-8, 0.999, 61))
      all.push_back({alpha, std::sqrt(1 - s2)});
  return all;
}
/// V over widths and both cosines, all in logarithms: {alpha, NoL, NoV}.
std::vector<Inputs> direction_pairs() {
  std::vector<Inputs> all;
  const auto cosines = stabilities::in_logarithms(1e-6, 1, 31);
  for (const double alpha : stabilities::in_logarithms(1e-4, 1, 21))
    for (const double nol : cosines)
      for (const double nov : cosines) all.push_back({alpha, nol, nov});
  return all;
}

double mapped(const char* map, Number number, double x) {
  const std::array in{x};
  return map_in(number, *find_map(map), in)[0];
}

std::vector<Clamp> clamps() {
  using stability::subject_of;
  const auto gtr = subject_of("ndf.gtr.as_written", "cosine"),
             ggx = subject_of("ndf.ggx", "cosine"), mobile = subject_of("ndf.ggx.mobile", "cosine"),
             joint = subject_of("masking.ue_joint", "cosines"),
             clamped = subject_of("masking.ue_joint.clamped", "cosines");
  const auto of = [](stability::Subject s) {
    return [s](Number n, const Inputs& x) { return stability::value_of(s, n, x); };
  };
  constexpr double pi = std::numbers::pi;
  return {
      {"alpha = max(r², 0.001)", "ndf.gtr.as_written", "alpha", half_vectors(),
       [gtr](Number n, const Inputs& x) {
         const double alpha = mapped("clamp.alpha", n, std::sqrt(x[0]));
         return stability::value_of(gtr, n, std::array{alpha, 2.0, x[1]});
       },
       [gtr](Number n, const Inputs& x) {
         return stability::value_of(gtr, n, std::array{x[0], 2.0, x[1]});
       }},
      {"min(D, 2048)", "ndf.ggx.mobile", "alpha", half_vectors(), of(mobile),
       // The engine divides the light by π instead.
       [ggx](Number n, const Inputs& x) { return pi * stability::value_of(ggx, n, x); }},
      {"NoV + 1e-5", "masking.ue_joint", "cosine", direction_pairs(),
       [joint](Number n, const Inputs& x) {
         return stability::value_of(joint, n, std::array{x[0], x[1], mapped("clamp.nov", n, x[2])});
       },
       of(joint)},
      {"max(denominator, 0.001)", "masking.ue_joint.clamped", "cosine", direction_pairs(),
       of(clamped), of(joint)}};
}

/// By how much the clamp changes a value, in double.
double change_by(const Clamp& c, const Inputs& x) {
  return std::abs(c.with(Number::double_, x) / c.without(Number::double_, x) - 1);
}

/// Factor, up to a step of the grids, by which the inputs that the clamp goes by may grow until it changes the value by less.
double reach_of(const Clamp& c, const Inputs& x, double change) {
  const auto at = [&](double factor) {
    Inputs y = x;
    if (c.by == "alpha")
      y[0] *= factor;
    else
      for (const std::size_t k : {1U, 2U})
        if (x[k] == std::min(x[1], x[2])) y[k] *= factor;
    return y;
  };
  double low = 1, high = 1.6;
  while (high - low > 1e-4) {
    const double middle = (low + high) / 2;
    (change_by(c, at(middle)) > change ? low : high) = middle;
  }
  return high;
}

ClampRow row_of(const Clamp& c, Number number) {
  constexpr double little = 0.01;
  ClampRow row{c.name, c.where, c.by, std::string(name_of(number)), {}, {}, 0, 0, {}, 0};
  std::vector<Inputs> last;  // of those that the clamp changes, farthest from 0
  for (const auto& given : c.inputs) {
    // As the number holds them, so that what is told is the formula's error and not its inputs'.
    Inputs x;
    for (const double v : given) x.push_back(stability::rounded(number, v, x.empty()));
    const double by = c.by == "alpha" ? x[0] : std::min(x[1], x[2]);
    if (by == 0) continue;
    const auto raise = [by](std::optional<double>& to) { to = std::max(to.value_or(0), by); };
    const double exact = c.without(Number::double_, x), change = change_by(c, x);
    if (change > little && by >= row.changed_to.value_or(0)) {
      if (by > row.changed_to.value_or(0)) last.clear();
      last.push_back(x);
      raise(row.changed_to);
    }
    row.changed_most = std::max(row.changed_most, change);
    const auto look = [&](double value, std::optional<double>& no_value, double& worst) {
      if (!std::isfinite(value))
        raise(no_value);
      else
        worst = std::max(worst, std::abs(value / exact - 1));
    };
    look(c.without(number, x), row.no_value_without, row.worst_without);
    look(c.with(number, x), row.no_value_with, row.worst_with);
  }
  double farther = 1;
  for (const auto& x : last) farther = std::max(farther, reach_of(c, x, little));
  if (row.changed_to) *row.changed_to *= farther;
  return row;
}

}  // namespace

std::vector<ClampRow> clamp_rows() {
  std::vector<ClampRow> rows;
  for (const auto& c : clamps())
    for (const auto number : {Number::half, Number::mixed, Number::float_})
      rows.push_back(row_of(c, number));
  return rows;
}

}  // namespace gonio
