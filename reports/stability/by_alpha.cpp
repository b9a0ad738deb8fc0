// Errors by a form's width: the worst over all angles, and by angle.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/whole_loop.h"
#include "brdf/catalogue/registry.h"
#include "reports/stability/measure.h"
#include "reports/stability/stability.h"
#include "stability/places.h"

namespace gonio {
namespace stabilities {

std::vector<double> in_logarithms(double low, double high, std::size_t n) {
  std::vector<double> x(n);
  for (std::size_t i = 0; i < n; ++i)
    x[i] = low * std::pow(high / low, static_cast<double>(i) / static_cast<double>(n - 1));
  x.back() = high;
  return x;
}

namespace {

using stability::Given;
using stability::Subject;

/// Half vectors from the peak to the horizon as sin²θ_h, or directions by their cosine.
std::vector<double> angles(const Subject& s, std::size_t n) {
  const bool distribution = s.given == Given::cross || s.given == Given::cosine;
  auto x = in_logarithms(distribution ? 1e-8 : 1e-6, distribution ? 0.9999 : 1, n);
  if (distribution) x.insert(x.begin(), 0);
  return x;
}

/// Inputs of a subject at a width and an angle of these, of two directions one each; parameters beside the width start where
/// a fit does.
Inputs inputs(const Subject& s, double alpha, double angle, double other) {
  Inputs in;
  const auto& own = catalogue()[*s.term].parameters;
  for (std::size_t k = 0; k < s.parameters; ++k)
    in.push_back(k == s.decides ? alpha : own[k].start);
  switch (s.given) {
    case Given::cross:
      in.push_back(angle);
      break;
    case Given::cosine:
      in.push_back(std::sqrt(1 - angle));
      break;
    default:
      in.push_back(angle);
      in.push_back(other);
  }
  return in;
}

/// |x / f − 1| at inputs as the number holds them; 0 where f is below the number's least normal one or above its largest;
/// NaN where there is no value.
double error_at(const Subject& s, Number number, const Inputs& at) {
  const auto in = stability::rounded(s, number, at);
  const double exact = stability::value_of(s, Number::double_, in),
               value = stability::value_of(s, number, in);
  if (!std::isfinite(value)) return no_value;
  if (!std::isfinite(exact)) return 0;
  const double least = std::ldexp(1, stability::least_exponent(number));
  if (std::abs(exact) < least || std::abs(exact) > stability::largest(number)) return 0;
  return std::abs(value / exact - 1);
}

/// Distributions by width, and masking whose angles are two cosines.
std::vector<Subject> with_width(bool all) {
  static constexpr std::string_view shipped[] = {
      "ndf.ggx",      "ndf.ggx.ue_mobile",    "ndf.ggx.mobile",
      "ndf.gtr",      "ndf.ggx.mobile.cross", "ndf.gtr.as_written",
      "ndf.beckmann", "ndf.blinn_phong",      "masking.smith_ggx.correlated"};
  std::vector<Subject> out;
  for (std::size_t term = 0; term < catalogue().size(); ++term) {
    const auto& entry = catalogue()[term];
    if (!all && std::ranges::find(shipped, entry.id()) == std::end(shipped)) continue;
    for (auto& s : stability::subjects_of_term(term)) {
      const bool width = s.decides && s.inputs[*s.decides].name == "alpha";
      if (width &&
          (s.given == Given::cross || s.given == Given::cosine || s.given == Given::cosines))
        out.push_back(std::move(s));
    }
  }
  return out;
}

constexpr std::array numbers{Number::half, Number::mixed, Number::float_};
/// Least width of the pictures: of half, what a half can hold at all.
double least_width(Number n) {
  return n == Number::float_ ? 1e-6 : 0x1p-14;
}

/// Forms in each number, computed side by side.
template <class Row, class Make>
std::vector<Row> of_each(bool all, const Make& make) {
  const auto subjects = with_width(all);
  std::vector<Row> rows(subjects.size() * numbers.size());
  for_each_whole(rows.size(), [&](std::size_t k) {
    rows[k] = make(subjects[k / numbers.size()], numbers[k % numbers.size()]);
  });
  return rows;
}

}  // namespace
}  // namespace stabilities

std::vector<StabilityRows::ByAlpha> errors_by_alpha(bool all) {
  using namespace stabilities;
  return of_each<StabilityRows::ByAlpha>(all, [&](const Subject& s, Number number) {
    StabilityRows::ByAlpha row{s.id, std::string(s.form()), std::string(name_of(number)), {}, {}};
    const bool two = s.given == Given::cosines;  // every pair of them
    const auto at = two ? angles(s, all ? 28 : 14) : angles(s, all ? 800 : 200);
    for (const double alpha : in_logarithms(least_width(number), 1, all ? 121 : 61)) {
      double worst = 0;
      for (std::size_t k = 0; k < (two ? at.size() * at.size() : at.size()); ++k) {
        const double e =
            error_at(s, number, inputs(s, alpha, at[k % at.size()], at[k / at.size()]));
        if (!(e <= worst)) worst = e;
        if (std::isnan(worst)) break;
      }
      row.alpha.push_back(stability::rounded(number, alpha, true));
      row.worst.push_back(worst);
    }
    return row;
  });
}

std::vector<StabilityRows::Map> error_maps(bool all) {
  using namespace stabilities;
  constexpr std::size_t cells = 48, looks = 3;
  return of_each<StabilityRows::Map>(all, [&](const Subject& s, Number number) {
    StabilityRows::Map map{s.id, std::string(s.form()), std::string(name_of(number)), {}, {}, {}};
    const bool distribution = s.given != Given::cosines;
    map.alpha = in_logarithms(least_width(number), 1, cells);
    map.angle = in_logarithms(distribution ? 1e-8 : 1e-6, distribution ? 0.9999 : 1, cells);
    // Each cell reaches half way to the next: places within it, on the same logarithmic steps.
    const auto within = [](const std::vector<double>& x, std::size_t i, std::size_t k) {
      const double step = std::log(x[1] / x[0]);
      const double part = (static_cast<double>(k) + 0.5) / looks - 0.5;
      return std::min(x[i] * std::exp(part * step), x.back());
    };
    for (std::size_t a = 0; a < cells; ++a)
      for (std::size_t b = 0; b < cells; ++b) {
        double worst = 0;
        for (std::size_t k = 0; k < looks * looks; ++k) {
          const double angle = within(map.angle, b, k % looks);
          const double e =
              error_at(s, number, inputs(s, within(map.alpha, a, k / looks), angle, angle));
          if (!(e <= worst)) worst = e;
          if (std::isnan(worst)) break;
        }
        map.error.push_back(worst);
      }
    return map;
  });
}

}  // namespace gonio
