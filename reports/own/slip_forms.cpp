#include "reports/own/slip_forms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "brdf/catalogue/foreign_terms.h"
#include "brdf/in_number/number.h"
#include "reports/own/nearest.h"
#include "reports/own/parameters.h"

namespace gonio {
namespace {

using auditing::Row;
using auditing::Values;

struct SlipForm {
  double (*value)(double parameter, const Row&);  ///< of F0 or of alpha
  const char* slip;
};

/// (1 − c)ⁿ of Schlick's form and its like.
double darkened(double c, int n) {
  return std::pow(1 - c, n);
}

constexpr std::array<SlipForm, 3> of_cosine{{
    {[](double f, const Row& r) { return f + (1 - f) * darkened(r.noh, 5); },
     "its Fresnel term takes NoH where VoH belongs"},
    {[](double f, const Row& r) { return f + (1 - f) * darkened(r.nov, 5); },
     "its Fresnel term takes NoV where VoH belongs"},
    {[](double f, const Row& r) { return f + (1 - f) * darkened(r.nol, 5); },
     "its Fresnel term takes NoL where VoH belongs"},
}};
constexpr std::array<SlipForm, 7> of_fresnel{{
    {[](double f, const Row& r) { return f + (1 - f) * darkened(r.voh, 4); },
     "its Fresnel term has the power 4, Schlick's has 5"},
    {[](double f, const Row& r) { return f + (1 - f) * darkened(r.voh, 6); },
     "its Fresnel term has the power 6, Schlick's has 5"},
    {[](double f, const Row& r) { return f + (1 - f) * darkened(r.voh, 3); },
     "its Fresnel term has the power 3, Schlick's has 5"},
    {[](double f, const Row& r) { return f + f * darkened(r.voh, 5); },
     "its Fresnel term is F0 + F0 (1 − VoH)⁵, expected F0 + (1 − F0) (1 − VoH)⁵"},
    {[](double f, const Row& r) { return f + darkened(r.voh, 5); },
     "its Fresnel term is F0 + (1 − VoH)⁵, expected F0 + (1 − F0) (1 − VoH)⁵"},
    {[](double f, const Row& r) { return f + (1 - f) * std::pow(r.voh, 5); },
     "its Fresnel term has VoH⁵ where (1 − VoH)⁵ belongs"},
    {[](double f, const Row& r) { return 1 + (f - 1) * darkened(r.voh, 5); },
     "its Fresnel term mixes from 1 to F0, expected from F0 to 1"},
}};

/// NoH² (α² − 1) + 1 of GGX.
double ggx_below(double alpha, const Row& r) {
  return r.noh * r.noh * (alpha * alpha - 1) + 1;
}
constexpr std::array<SlipForm, 2> of_distribution{{
    {[](double a, const Row& r) { return a * a / (std::numbers::pi * ggx_below(a, r)); },
     "the denominator of GGX is not squared"},
    {[](double a, const Row& r) {
       const double d = ggx_below(a, r);
       return a / (std::numbers::pi * d * d);
     },
     "alpha stands above where alpha² belongs"},
}};

/// √(c² (1 − α²) + α²) of Smith's masking for GGX.
double smith_root(double alpha, double c) {
  return std::sqrt(c * c * (1 - alpha * alpha) + alpha * alpha);
}
constexpr const char* swapped_cosines =
    "NoL and NoV are swapped: expected NoV beside the root with NoL, and NoL beside the one with "
    "NoV";
constexpr std::array<SlipForm, 1> of_masking{{
    {[](double a, const Row& r) {
       return 0.5 / (r.nol * smith_root(a, r.nol) + r.nov * smith_root(a, r.nov));
     },
     swapped_cosines},
}};

std::string swapped_of_two_widths(std::size_t term) {
  const auto& rows = auditing::rows_of(Role::masking);
  const auto parameters = known_parameters(term);
  const Values p{usual_of(parameters[0]), 0.7 * high_of(parameters[1])};
  const auto v = values_in(Number::double_, term, p, rows);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& r = rows[i];
    const auto root = [&](double x, double y, double z) {
      return std::hypot(p[0] * x, p[1] * y, z);
    };
    const double wanted =
        0.5 / (r.nol * root(r.xol, r.yol, r.nol) + r.nov * root(r.xov, r.yov, r.nov));
    if (!(std::abs(v[i] / wanted - 1) < same_within)) return "";
  }
  return swapped_cosines;
}

}  // namespace

std::string fresnel_slip(double f0,
                         std::span<const Row> rows,
                         std::span<const double> values,
                         bool of_model) {
  constexpr double same = 2e-3;
  const auto is = [&](const SlipForm& s) {
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (!(std::abs(values[i] - s.value(f0, rows[i])) < same)) return false;
    return true;
  };
  for (const auto& s : of_fresnel)
    if (is(s)) return s.slip;
  for (const auto& s : of_cosine)
    if (of_model && is(s)) return s.slip;
  return "";
}

std::string slip_form(std::size_t term) {
  const auto& own = catalogue()[term];
  const auto& rows = auditing::rows_of(own.role());
  if (own.role() == Role::fresnel) {
    const auto known = known_parameters(term);
    const auto colours = part_colours(known);
    const bool has_f0 = colours && !colours->f0.empty();
    if (!has_f0 && own.parameters.size() != 1) return "";
    const std::size_t k = has_f0 ? colours->f0[0] : 0;
    const auto& f0 = known[k];
    Values p;
    for (const auto& q : known) p.push_back(usual_of(q));
    const double at = low_of(f0) + 0.1 * (high_of(f0) - low_of(f0));
    p[k] = at;
    return fresnel_slip(at, rows, values_in(Number::double_, term, p, rows), false);
  }
  if (own.anisotropic && own.role() == Role::masking && own.parameters.size() == 2)
    return swapped_of_two_widths(term);
  if (own.role() == Role::masking && own.parameters.empty()) {
    const auto v = values_in(Number::double_, term, {}, rows);
    const auto is = [&](const Row& r) {
      return std::abs(v[static_cast<std::size_t>(&r - rows.data())] *
                          (r.nol + r.nov - r.nol * r.nov) -
                      1) < same_within;
    };
    return std::ranges::all_of(rows, is) ? "4 times that of Neubelt: a 4 is missing below" : "";
  }
  const auto known = known_parameters(term);
  const auto width = width_of(known);
  if (!width || own.anisotropic || own.role() == Role::diffuse) return "";
  std::span<const SlipForm> forms = of_masking;
  if (own.role() == Role::ndf) forms = of_distribution;
  constexpr std::size_t places = 4;
  const auto widths = values_between(known[*width], places);
  for (const double power : powers_of(known[*width]))
    for (const auto& s : forms) {
      bool is = true;
      for (std::size_t k = 0; is && k < places; ++k) {
        Values p;
        for (const auto& q : known) p.push_back(usual_of(q));
        p[*width] = widths[k];
        const auto v = values_in(Number::double_, term, p, rows);
        for (std::size_t i = 0; is && i < rows.size(); ++i) {
          const double wanted = s.value(alpha_of(widths[k], power), rows[i]);
          is = !std::isfinite(wanted) || std::abs(v[i] / wanted - 1) < same_within;
        }
      }
      if (is) return s.slip;
    }
  return "";
}

}  // namespace gonio
