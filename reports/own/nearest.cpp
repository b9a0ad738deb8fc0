#include "reports/own/nearest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "base/letters.h"
#include "brdf/cost/model_operations.h"
#include "brdf/in_number/number.h"
#include "brdf/model/spec.h"
#include "reports/measure/samples.h"

#include <fmt/format.h>

namespace gonio {
namespace {

using auditing::Row;
using auditing::Values;

constexpr double same_within = 1e-3;
constexpr std::array powers{1.0, 2.0, 0.5, 4.0};
/// Stands for alpha = √(2/(exponent + 2)), of exponents of a cosine.
constexpr double of_exponent = -2;
double alpha_of(double width, double power) {
  return power == of_exponent ? std::sqrt(2 / (width + 2)) : std::pow(width, power);
}

std::string plain_name(std::string_view name) {
  std::string s;
  for (const char c : name)
    if (c != '_') s += lower_case(c);
  return s;
}
bool is_exponent(std::string_view name) {
  const auto n = plain_name(name);
  return n.find("shin") != n.npos || n.find("expo") != n.npos || n == "n" || n == "power" ||
         n == "specpower" || n == "specularpower";
}

/// Which of the file's parameters stands for each of the form's: [form's parameter] → the file's, or none.
struct Pairing {
  std::vector<std::optional<std::size_t>> of;
  std::optional<std::size_t> width;  ///< the file's, where the form has an alpha
};
Pairing pair_up(const TermEntry& own, const TermEntry& form) {
  Pairing p;
  const auto width = width_of(own.parameters);
  for (const auto& q : form.parameters) {
    const auto same = std::ranges::find(own.parameters, q.name, &Parameter::name);
    std::optional<std::size_t> k;
    if (q.name == "alpha")
      k = p.width = width;
    else if (same != own.parameters.end())
      k = static_cast<std::size_t>(same - own.parameters.begin());
    else if ((q.name == "f0" || q.name == "kd") && own.parameters.size() - width.has_value() == 1)
      k = width == 0 ? 1 : 0;
    p.of.push_back(k);
  }
  return p;
}

constexpr double pi = std::numbers::pi;
/// Factors that are slips often made.
constexpr std::array<std::pair<double, const char*>, 9> usual_factors{
    {{pi, "π times too large: 1/π is missing"},
     {1 / pi, "π times too small: it is divided by π once too often"},
     {4, "4 times too large: a 4 is missing below"},
     {0.25, "4 times too small: a 4 too many below"},
     {4 / pi, "4/π times too large: π stands below where 4 belongs"},
     {pi / 4, "π/4 of what it should be: 4 stands below where π belongs"},
     {4 * pi, "4π times too large: 1/(4π) is missing"},
     {2, "twice too large: a factor ½ is missing, as in V = ½/(…)"},
     {0.5, "half of what it should be"}}};

std::string factor_text(double factor) {
  for (const auto& [value, text] : usual_factors)
    if (std::abs(factor / value - 1) < same_within) return text;
  return fmt::format("{:.4g} times that form", factor);
}
bool is_usual(double factor) {
  return std::ranges::any_of(
      usual_factors, [&](const auto& u) { return std::abs(factor / u.first - 1) < same_within; });
}

/// Compares the file's function with one form, alpha being one power of its width.
NearestForm compared(std::size_t term, std::size_t form, const Pairing& pairing, double power) {
  const auto &own = catalogue()[term], &other = catalogue()[form];
  const auto& rows = auditing::rows_of(own.role());
  NearestForm n;
  n.term = form;
  if (pairing.width) n.width = own.parameters[*pairing.width].name;
  n.power = power;
  std::vector<Values> f, g;
  constexpr std::size_t places = 5;
  for (std::size_t k = 0; k < places; ++k) {
    Values p, q;
    for (const auto& a : own.parameters) p.push_back(values_between(a, places)[k]);
    bool is_legal = true;
    for (std::size_t j = 0; j < other.parameters.size(); ++j) {
      const auto from = pairing.of[j];
      double v = from ? p[*from] : other.parameters[j].start;
      if (from && from == pairing.width) v = alpha_of(v, power);
      is_legal = is_legal && other.parameters[j].legal.holds(v);
      q.push_back(v);
    }
    if (!is_legal) continue;
    f.push_back(shown_in(Number::double_, term, p, rows));
    g.push_back(shown_in(Number::double_, form, q, rows));
  }
  std::vector<double> ratios;
  for (std::size_t k = 0; k < f.size(); ++k)
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (const double r = f[k][i] / g[k][i]; std::isfinite(r) && r > 0) ratios.push_back(r);
  n.difference = std::numeric_limits<double>::infinity();
  if (ratios.empty() || f.size() < 2) return n;
  std::ranges::nth_element(ratios, ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2));
  const bool scales = own.role() == Role::ndf || own.role() == Role::diffuse;
  n.factor = scales || (own.role() == Role::masking && is_usual(ratios[ratios.size() / 2]))
                 ? ratios[ratios.size() / 2]
                 : 1;
  double highest = 0, wanted = 0;
  for (std::size_t k = 0; k < f.size(); ++k) {
    highest = std::max(highest, *std::ranges::max_element(f[k]));
    wanted = std::max(wanted, n.factor * *std::ranges::max_element(g[k]));
  }
  if (own.role() == Role::ndf && highest < wanted * (1 - same_within)) n.cap = highest;
  if (power == of_exponent) {
    n.norms = Range{1e300, 0};
    for (std::size_t k = 0; k < f.size(); ++k) {
      const double norm = *std::ranges::max_element(f[k]) / *std::ranges::max_element(g[k]);
      for (double& x : f[k]) x *= n.factor / norm;
      n.norms = Range{std::min(n.norms->low, norm), std::max(n.norms->high, norm)};
    }
    if (n.norms->high < n.norms->low * (1 + same_within)) n.norms.reset();
    n.cap.reset();
  }
  n.difference = 0;
  for (std::size_t k = 0; k < f.size(); ++k) {
    const double peak = own.role() == Role::ndf ? *std::ranges::max_element(g[k]) : 1;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (n.cap && n.factor * g[k][i] >= *n.cap * (1 - same_within) &&
          f[k][i] >= *n.cap * (1 - 1e-9))
        continue;
      const double d = std::abs(f[k][i] / n.factor - g[k][i]) / std::max(peak, 1e-300);
      n.difference = std::max(n.difference, std::isfinite(d) ? d : 1e9);
    }
  }
  return n;
}

}  // namespace

bool is_rough(std::string_view name) {
  return plain_name(name).find("rough") != std::string::npos;
}

std::vector<double> values_between(const Parameter& p, std::size_t count) {
  Range r = p.legal;
  if (std::isnan(p.start)) r = {0.05, 1};
  const bool by_ratio = r.low > 0 && r.high > 10 * r.low;
  std::vector<double> v;
  for (std::size_t k = 0; k < count; ++k) {
    const double part = (static_cast<double>(k) + 0.5) / static_cast<double>(count);
    v.push_back(by_ratio ? r.low * std::pow(r.high / r.low, part)
                         : r.low + part * (r.high - r.low));
  }
  return v;
}

std::optional<std::size_t> width_of(std::span<const Parameter> parameters) {
  for (const auto* name : {"alpha", "rough", "gloss", "sigma", "width"})
    for (std::size_t k = 0; k < parameters.size(); ++k)
      if (plain_name(parameters[k].name).starts_with(name)) return k;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const auto n = plain_name(parameters[k].name);
    if (is_exponent(n) || n == "a" || n == "a2" || n == "m" || n == "r" ||
        n.find("rough") != n.npos)
      return k;
  }
  return {};
}

bool is_same(const NearestForm& n) {
  return n.difference < same_within;
}

std::optional<NearestForm> nearest_form(std::size_t term) {
  const auto& own = catalogue()[term];
  std::optional<NearestForm> best;
  for (std::size_t form = 0; form < catalogue_size(); ++form) {
    const auto& entry = catalogue()[form];
    if (entry.role() != own.role() || entry.anisotropic || entry.coupled) continue;
    const Pairing pairing = pair_up(own, entry);
    const bool by_exponent = pairing.width && is_exponent(own.parameters[*pairing.width].name);
    for (const double power :
         by_exponent ? std::span(&of_exponent, 1) : std::span<const double>(powers)) {
      if (power != 1 && !pairing.width) continue;
      const auto n = compared(term, form, pairing, power);
      if (!std::isfinite(n.difference)) continue;
      // Forms may differ by rounding only, near a narrow peak by 1e-5: the first is taken, and the
      // plainest map.
      constexpr double by_rounding = 1e-5;
      if (!best || n.difference < std::min(0.5 * best->difference, best->difference - by_rounding))
        best = n;
    }
  }
  return best;
}

std::vector<std::string> likely_slips(std::size_t term, const NearestForm& n) {
  std::vector<std::string> all;
  if (!is_same(n)) return all;
  const auto& own = catalogue()[term];
  const auto& f = *foreign_term(term)->function;
  const auto id = catalogue()[n.term].id();
  if (!n.width.empty()) {
    const auto& w = n.width;
    if (is_rough(w) && n.power == 4)
      all.push_back(
          fmt::format("{} is squared once too often: alpha is {}⁴ here, expected {}²", w, w, w));
    const bool is_squared = w.ends_with('2') || w.ends_with("sq");
    if (is_squared && n.power == 1)
      all.push_back(fmt::format("{} is taken for alpha: it has not been squared", w));
    if (!is_rough(w) && !is_squared && n.power == 2)
      all.push_back(
          fmt::format("{} is squared once too often: the form's alpha is {}² here", w, w));
    if (!is_rough(w) && !is_squared && n.power == 0.5)
      all.push_back(
          fmt::format("{} stands where {}² belongs: the form's alpha is √{} here", w, w, w));
  }
  if (n.norms)
    all.push_back(
        fmt::format("the form is right and its norm is not: it is {:.3g} to {:.3g} times that of a "
                    "distribution, whose ∫ D cos θ is 1",
                    n.norms->low, n.norms->high));
  else if (std::abs(n.factor - 1) > same_within && own.role() != Role::diffuse)
    all.push_back(factor_text(n.factor));
  if (n.cap && n.width.size()) {
    const double alpha = 1 / std::sqrt(std::numbers::pi * *n.cap / n.factor);  // of a GGX peak
    const double w = std::pow(alpha, 1 / n.power);
    all.push_back(
        fmt::format("a clamp at {:.5g} cuts the peak below {} {:.3g}", *n.cap, n.width, w));
  }
  if (own.role() == Role::masking) {
    const auto name = plain_name(f.name.function);
    if (f.is_g && (name.starts_with("v") && !name.starts_with("vg")))
      all.push_back(
          "it gives G although it is called V: the division by 4 NoL NoV is missing, or stands "
          "elsewhere");
    if (id == "masking.schlick_ggx.direct")
      all.push_back(
          "its k is that of direct light, (roughness + 1)²/8; under an environment k = alpha/2");
  }
  return all;
}

std::vector<std::string> to_check(const std::string& width, double power) {
  if (!is_rough(width) || power != 1) return {};
  return {fmt::format(
      "{} is taken for alpha: right where the caller has squared a roughness before; otherwise "
      "highlights are too wide",
      width)};
}

std::optional<NearestModel> nearest_model(std::size_t term) {
  const auto& own = catalogue()[term];
  const auto width = width_of(own.parameters);
  const auto f0 = std::ranges::find_if(own.parameters, [](const Parameter& p) {
    const auto n = plain_name(p.name);
    return n == "f0" || n == "r0" || n == "ks" || n.starts_with("specular");
  });
  if (own.role() != Role::diffuse || !width || f0 == own.parameters.end()) return {};
  // Away from the horizon: shaders add to a denominator there.
  constexpr double least_cosine = 0.3;
  auto rows = auditing::rows_of(Role::diffuse);
  std::erase_if(rows, [](const Row& r) { return std::min(r.nol, r.nov) < least_cosine; });
  const auto widths = values_between(own.parameters[*width], 4);
  // The function's values by width: with F = 1, and with what else the parameters are.
  const auto values = [&](double f0_is, bool others) {
    std::vector<Values> all;
    for (const double w : widths) {
      Values p;
      for (const auto& q : own.parameters)
        p.push_back(&q == &own.parameters[*width] ? w
                    : &q == &*f0                  ? f0_is
                    : std::isnan(q.start)         ? 0.5
                    : others                      ? q.start
                                                  : q.legal.low);
      all.push_back(values_in(Number::double_, term, p, rows));
    }
    return all;
  };
  const auto dark = values(1, false);
  const auto is_alpha_only = [](const TermEntry& e) {
    return !e.anisotropic && !e.coupled &&
           (e.parameters.empty() || (e.parameters.size() == 1 && e.parameters[0].name == "alpha"));
  };
  /// Values of each form of a role by width; none where alpha is none of the form's.
  const auto forms = [&](Role role, double power) {
    std::vector<std::pair<std::size_t, std::vector<Values>>> all;
    for (std::size_t form = 0; form < catalogue_size(); ++form) {
      if (catalogue()[form].role() != role || !is_alpha_only(catalogue()[form])) continue;
      std::vector<Values> of;
      for (const double w : widths)
        if (const double alpha = alpha_of(w, power); catalogue()[form].parameters.empty())
          of.push_back(values_in(Number::double_, form, {}, rows));
        else if (catalogue()[form].parameters[0].legal.holds(alpha))
          of.push_back(values_in(Number::double_, form, std::array{alpha}, rows));
      if (of.size() == widths.size()) all.emplace_back(form, std::move(of));
    }
    return all;
  };
  const auto short_id = [](std::size_t form) {
    const std::string id(catalogue()[form].id());
    return id.substr(id.find('.') + 1);
  };
  struct Scaled {
    double power;
    std::vector<std::pair<std::size_t, std::vector<Values>>> shapes, maskings;
  };
  std::vector<Scaled> scaled;
  for (const double power : powers)
    scaled.push_back({power, forms(Role::ndf, power), forms(Role::masking, power)});
  // One alpha for both is tried first.
  std::vector<std::pair<const Scaled*, const Scaled*>> tries;
  for (const auto& s : scaled) tries.emplace_back(&s, &s);
  for (const auto& s : scaled)
    for (const auto& t : scaled)
      if (&s != &t) tries.emplace_back(&s, &t);
  for (const auto& [of_d, of_v] : tries) {
    for (const auto& [d, d_values] : of_d->shapes)
      for (const auto& [v, v_values] : of_v->maskings) {
        std::size_t peak = 0;
        for (std::size_t i = 0; i < rows.size(); ++i)
          if (d_values[0][i] * v_values[0][i] > d_values[0][peak] * v_values[0][peak]) peak = i;
        const double highest = d_values[0][peak] * v_values[0][peak];
        const double factor = dark[0][peak] / highest;
        const auto is_highlight = [&](std::size_t k, std::size_t i) {
          const double wanted = factor * d_values[k][i] * v_values[k][i];
          return std::abs(dark[k][i] - wanted) <=
                 same_within * std::abs(wanted) + 1e-30 * std::abs(factor) * highest;
        };
        bool same = factor > 0 && std::isfinite(factor);
        for (std::size_t k = 0; same && k < widths.size(); ++k)
          for (std::size_t i = 0; same && i < rows.size(); ++i) same = is_highlight(k, i);
        if (!same) continue;
        NearestModel n{"", std::string(own.parameters[*width].name), of_d->power, of_v->power,
                       factor};
        const auto with = values(f0->legal.low, true), without = values(f0->legal.low, false);
        double least = 1e300, most = -1e300;
        for (std::size_t i = 0; i < rows.size(); ++i) {
          least = std::min(least, with[0][i] - without[0][i]);
          most = std::max(most, with[0][i] - without[0][i]);
        }
        const bool is_lambert = least > 0 && most < least * (1 + same_within);
        n.lacks_diffuse = !is_lambert && most > same_within;
        auto spec = model_of_lobe(short_id(d), short_id(v), "schlick");
        if (is_lambert) spec.diffuse = "lambert";
        n.spec = to_text(spec);
        n.operations = operations_of(compose(spec, f0->per_channel ? 3 : 1)).total();
        return n;
      }
  }
  return {};
}

std::vector<std::string> likely_slips(const NearestModel& n) {
  std::vector<std::string> all;
  if (std::abs(n.factor - 1) > same_within)
    all.push_back("its highlight is " + factor_text(n.factor));
  const auto alpha = [&](double power) {
    return power == 0.5 ? "√" + n.width : n.width + (power == 2 ? "²" : power == 4 ? "⁴" : "");
  };
  if (n.power != n.masking_power)
    all.push_back(fmt::format("alpha is {} in D and {} in V: expected one alpha for both",
                              alpha(n.power), alpha(n.masking_power)));
  if (is_rough(n.width) && n.power == 4)
    all.push_back(fmt::format("{} is squared once too often: alpha is {}⁴ here, expected {}²",
                              n.width, n.width, n.width));
  return all;
}

}  // namespace gonio
