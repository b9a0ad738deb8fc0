#include "reports/own/nearest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "brdf/in_number/number.h"
#include "geometry/direction.h"
#include "integrate/albedo/normalisation.h"
#include "reports/finding/words.h"
#include "reports/measure/samples.h"
#include "reports/own/laws.h"
#include "reports/own/parameters.h"

#include <fmt/format.h>

namespace gonio {
namespace {

using auditing::Row;
using auditing::Values;

/// Which of the file's parameters stands for each of the form's: [form's parameter] → the file's, or none.
struct Pairing {
  std::vector<std::optional<std::size_t>> of;
  std::optional<std::size_t> width;  ///< the file's, where the form has an alpha
};
Pairing pair_up(std::span<const Parameter> own,
                std::size_t form,
                std::optional<std::size_t> width) {
  Pairing p;
  const auto known = known_parameters(form);
  const auto width_of_form = width_of(known);
  std::optional<std::size_t> other;  // the first beside the width
  bool is_only = true;               // channels of one colour are one
  for (std::size_t k = 0; k < own.size(); ++k) {
    if (k == width) continue;
    is_only = is_only && (!other || stem_of(own[k].name) == stem_of(own[*other].name));
    if (!other) other = k;
  }
  for (std::size_t j = 0; j < known.size(); ++j) {
    const auto& q = known[j];
    const auto same = std::ranges::find_if(own, [&](const auto& o) { return means_same(o, q); });
    std::optional<std::size_t> k;
    if (q.name == "alpha")
      k = p.width = width;
    else if (same != own.end())
      k = static_cast<std::size_t>(same - own.begin());
    else if (j == width_of_form)
      k = width;
    else if ((q.name == "f0" || q.name == "kd") && is_only)
      k = other;
    p.of.push_back(k);
  }
  return p;
}
/// What a form's parameter is where a file's stands for it.
double value_for(const Parameter& form, const Parameter& own, double v, double power) {
  if (form.name == "alpha") return alpha_of(v, power);
  return form.name == "f0" && is_eta(own) ? square((v - 1) / (v + 1)) : v;
}

constexpr double pi = std::numbers::pi;
/// Factors that are slips often made.
constexpr std::array<std::pair<double, const char*>, 11> usual_factors{
    {{pi, "π times too large: 1/π is missing"},
     {1 / pi, "π times too small: it is divided by π once too often"},
     {4, "4 times too large: a 4 is missing below"},
     {0.25, "4 times too small: a 4 too many below"},
     {4 / pi, "4/π times too large: π stands below where 4 belongs"},
     {pi / 4, "π/4 of what it should be: 4 stands below where π belongs"},
     {4 * pi, "4π times too large: 1/(4π) is missing"},
     {2 * pi, "2π times too large: 1/(2π) is missing"},
     {2, "twice too large: a factor ½ is missing"},
     {0.5, "half of what it should be"},
     {std::numbers::ln2, "ln 2 of what it should be: log2 stands below where ln belongs"}}};

bool is_usual(double factor) {
  return std::ranges::any_of(
      usual_factors, [&](const auto& u) { return std::abs(factor / u.first - 1) < same_within; });
}

/// Of a distribution, the widths at which its peak is less than the form's.
std::optional<Bite> bite_in(std::size_t term, const NearestForm& n, std::size_t width) {
  const auto own = known_parameters(term);
  static const Row peak = auditing::row(30 * degree, 0, 30 * degree, std::numbers::pi);
  return bite_of(own[width], n.power, [&](double w) {
    Values p, q;
    for (const auto& a : own) p.push_back(usual_of(a));
    p[width] = w;
    for (const auto& a : catalogue()[n.term].parameters)
      q.push_back(a.name == "alpha" ? alpha_of(w, n.power) : a.start);
    const std::span one(&peak, 1);
    return values_in(Number::double_, term, p, one)[0] /
           (n.factor * values_in(Number::double_, n.term, q, one)[0]);
  });
}

/// What V loses towards the horizon beside its form.
std::optional<Drop> drop_over(const NearestForm& n,
                              std::size_t term,
                              const std::optional<HorizonGuard>& guard) {
  Values p, q;
  for (const auto& a : known_parameters(term)) p.push_back(usual_of(a));
  for (const auto& a : catalogue()[n.term].parameters)
    q.push_back(n.width && a.name == "alpha" ? alpha_of(usual_of(*n.width), n.power) : a.start);
  auto drop = drop_of(
      [&](const Row& r) {
        const std::span one(&r, 1);
        return values_in(Number::double_, term, p, one)[0] /
               (n.factor * values_in(Number::double_, n.term, q, one)[0]);
      },
      guard);
  if (drop && guard)
    drop->is_of_sheen = catalogue()[n.term].id() == "masking.smith_charlie.correlated" &&
                        guard->kind == HorizonGuard::Kind::cap &&
                        std::abs(guard->amount - 1) < same_within;
  return drop;
}

/// Where a guard holds masking down towards the horizon, takes it out of the values of G2.  \return  whether there is one
bool take_guard(NearestForm& n,
                std::size_t term,
                std::span<const Row> rows,
                std::vector<Values>& f,
                const std::vector<Values>& g) {
  const auto as_v = [&](std::vector<Values> all) {
    for (auto& one : all)
      for (std::size_t i = 0; i < rows.size(); ++i) one[i] /= 4 * rows[i].nol * rows[i].nov;
    return all;
  };
  const auto own = as_v(f), form = as_v(g);
  const auto guard = guard_of(rows, own, form);
  if (!guard) return false;
  for (std::size_t k = 0; k < f.size(); ++k)
    for (std::size_t i = 0; i < rows.size(); ++i) f[k][i] /= guard->left(rows[i], form[k][i]);
  n.drop = drop_over(n, term, guard);
  return true;
}

/// Of masking by one direction, the cosine of the other, which masks nothing along the normal.
double Row::*along_normal(std::size_t term) {
  const bool is_masking = catalogue()[term].role() == Role::masking;
  return is_masking ? other_cosine(*foreign_term(term)->function) : nullptr;
}

/// Compares the file's function with one form, alpha being one power of its width.
NearestForm compared(std::size_t term, std::size_t form, const Pairing& pairing, double power) {
  const auto &own = catalogue()[term], &other = catalogue()[form];
  const auto known = known_parameters(term);
  NearestForm n;
  n.term = form;
  auto rows = auditing::rows_of(own.role());
  const auto unmasked = along_normal(term);
  n.of_one = unmasked != nullptr;
  for (auto& r : rows)
    if (n.of_one)
      r = unmasked == &Row::nol ? auditing::row(0, 0, std::acos(r.nov), 0)
                                : auditing::row(std::acos(r.nol), 0, 0, 0);
  if (pairing.width) n.width = known[*pairing.width];
  n.power = power;
  std::vector<Values> f, g;
  constexpr std::size_t places = 5;
  const bool of_two = own.anisotropic || two_widths(known);
  for (std::size_t k = 0; k < places; ++k) {
    Values p, q;
    // Two widths have two values.
    for (const auto& a : known)
      p.push_back(values_between(a, places)[(k + (of_two ? 2 * p.size() : 0)) % places]);
    constexpr double of_no_surface = 0.01;  // there Unreal's F90 is less than 1
    for (std::size_t j = 0; j < known.size() && k == 0 && own.role() == Role::fresnel; ++j)
      if (is_f0(known[j]))
        p[j] = low_of(known[j]) + of_no_surface * (high_of(known[j]) - low_of(known[j]));
    bool is_legal = true;
    for (std::size_t j = 0; j < other.parameters.size(); ++j) {
      const auto from = pairing.of[j];
      const bool is_white = own.role() == Role::diffuse && other.parameters[j].name == "kd";
      const double v = from       ? value_for(other.parameters[j], known[*from], p[*from], power)
                       : is_white ? 1
                                  : other.parameters[j].start;
      is_legal = is_legal && other.parameters[j].legal.holds(v);
      q.push_back(v);
    }
    if (!is_legal) continue;
    f.push_back(shown_in(Number::double_, term, p, rows));
    g.push_back(shown_in(Number::double_, form, q, rows));
    if (n.of_one && !foreign_term(term)->function->is_g)
      for (double& x : f.back()) x /= 2;  // G1/(2 NoV)
  }
  n.difference = std::numeric_limits<double>::infinity();
  if (f.size() < 2) return n;
  const std::size_t widest = pairing.width && narrows(power) ? 0 : f.size() - 1;
  // Of a distribution a guard takes least of the widest peak.
  const bool of_widest = own.role() == Role::ndf && pairing.width;
  std::vector<double> ratios;
  for (std::size_t k = 0; k < f.size(); ++k)
    for (std::size_t i = 0; i < rows.size() && (!of_widest || k == widest); ++i)
      if (const double r = f[k][i] / g[k][i]; std::isfinite(r) && r > 0) ratios.push_back(r);
  if (ratios.empty()) return n;
  std::ranges::nth_element(ratios, ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2));
  const bool scales = own.role() == Role::ndf || own.role() == Role::diffuse;
  n.factor =
      scales || (own.role() == Role::masking && !n.of_one && is_usual(ratios[ratios.size() / 2]))
          ? ratios[ratios.size() / 2]
          : 1;
  double highest = 0, wanted = 0;
  for (std::size_t k = 0; k < f.size(); ++k) {
    highest = std::max(highest, *std::ranges::max_element(f[k]));
    wanted = std::max(wanted, n.factor * *std::ranges::max_element(g[k]));
  }
  // A clamp is the largest value at the narrowest width, too; a guard makes that less.
  if (const double narrowest = *std::ranges::max_element(f[f.size() - 1 - widest]);
      own.role() == Role::ndf && highest < wanted * (1 - same_within) &&
      narrowest >= highest * (1 - 1e-9))
    n.cap = highest;
  if (power == of_exponent || (own.role() == Role::ndf && own.anisotropic)) {
    n.norms = Range{1e300, 0};
    for (std::size_t k = 0; k < f.size(); ++k) {
      const double norm = *std::ranges::max_element(f[k]) / *std::ranges::max_element(g[k]);
      for (double& x : f[k]) x *= n.factor / norm;
      n.norms = Range{std::min(n.norms->low, norm), std::max(n.norms->high, norm)};
    }
    if (n.norms->high < n.norms->low * (1 + same_within)) n.norms.reset();
    n.cap.reset();
  }
  const bool is_guarded =
      own.role() == Role::masking && !n.of_one && take_guard(n, term, rows, f, g);
  n.difference = 0;
  double held_down = 0;  // the largest difference of what lies below the form
  std::size_t low_rows = 0;
  bool widest_is_held = false;
  for (std::size_t k = 0; k < f.size(); ++k) {
    const double peak = own.role() == Role::ndf ? *std::ranges::max_element(g[k]) : 1;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (n.cap && n.factor * g[k][i] >= *n.cap * (1 - same_within) &&
          f[k][i] >= *n.cap * (1 - 1e-9))
        continue;
      // Without a value is said elsewhere, where there is next to none.
      if (!std::isfinite(f[k][i]) && (g[k][i] < same_within * peak || rows[i].noh == 0)) continue;
      const double off = (f[k][i] / n.factor - g[k][i]) / std::max(peak, 1e-300);
      const double d = std::isfinite(off) ? std::abs(off) : 1e9;
      if (own.role() == Role::ndf && off < -same_within) {
        held_down = std::max(held_down, d);
        ++low_rows;
        constexpr double much = 0.02;  // a guard takes little of the widest
        widest_is_held = widest_is_held || (k == widest && off < -much);
      } else {
        n.difference = std::max(n.difference, d);
      }
    }
  }
  // The form itself, where it is there, is nearer than another with a guard.
  if (is_guarded) n.difference = std::max(n.difference, 0.5 * same_within);
  if (own.role() == Role::masking && !n.of_one && !n.drop && is_same(n) &&
      own.parameters.size() <= 1)
    n.drop = drop_over(n, term, {});
  // A guard holds narrow peaks down, and nothing else differs.
  if (low_rows > 0 &&
      !(pairing.width && is_same(n) && !widest_is_held && 2 * low_rows < f.size() * rows.size() &&
        (n.bite = bite_in(term, n, *pairing.width))))
    n.difference = std::max(n.difference, held_down);
  return n;
}

}  // namespace

std::string factor_text(double factor) {
  for (const auto& [value, text] : usual_factors)
    if (std::abs(factor / value - 1) < same_within) return text;
  return fmt::format("{:.4g} times that form", factor);
}
bool is_same(const NearestForm& n) {
  return n.difference < same_within;
}

namespace {

/// True of a form without a slip, but for what its own steps in float and half round.
bool is_plain(const NearestForm& n) {
  constexpr double rounding = 5e-3;
  return n.difference < rounding && std::abs(n.factor - 1) < same_within && !n.cap && !n.norms &&
         !n.bite && !n.drop;
}

}  // namespace

std::optional<NearestForm> nearest_form(std::size_t term) {
  const auto& own = catalogue()[term];
  const auto known = known_parameters(term);
  std::vector<std::optional<std::size_t>> widths;
  // Whatever its name, a parameter of D or V is a width.
  const bool is_of_width = own.role() == Role::ndf || own.role() == Role::masking;
  const bool is_named = width_of(known).has_value();
  if (is_of_width && !is_named) {
    const auto all = possible_widths(known);
    widths.assign(all.begin(), all.end());
  }
  if (widths.empty()) widths.push_back(width_of(known));
  const auto two = two_widths(known);
  std::optional<NearestForm> best, shipped;
  std::size_t best_map = 0;
  for (std::size_t form = 0; form < catalogue_size(); ++form) {
    const auto& entry = catalogue()[form];
    if (entry.role() != own.role() || entry.anisotropic != own.anisotropic || entry.coupled)
      continue;
    if (along_normal(term) && (entry.parameters.empty() || entry.id().ends_with(".correlated")))
      continue;             // by one direction it is the separable one
    if (own.anisotropic) {  // the widths along the tangent and the bitangent, in either order
      if (own.parameters.size() != 2 || entry.parameters.size() != 2) continue;
      for (const std::size_t first : {0, 1}) {
        auto n = compared(term, form, {{first, 1 - first}, {}}, 1);
        n.is_swapped = two && first != (*two)[0];
        if (std::isfinite(n.difference) && (!best || n.difference < best->difference)) best = n;
      }
      continue;
    }
    for (const auto& width : widths) {
      const Pairing pairing = pair_up(known, form, width);
      std::vector<double> powers{1};
      if (pairing.width) {
        const auto& w = known[*pairing.width];
        const auto named = powers_of(w);
        powers.assign(named.begin(), named.end());
        if (own.role() == Role::ndf) powers = every_power(w);
      }
      for (const double& power : powers) {
        const auto n = compared(term, form, pairing, power);
        if (!std::isfinite(n.difference)) continue;
        // A form as it is shipped goes before the one that it stands for with what ships missing,
        // where its clamp says that it is that one.
        if (!entry.about->reference().empty() && is_plain(n) &&
            (!shipped || n.difference < shipped->difference))
          shipped = n;
        // A map that a width's name does not allow is no likeness: it is exact or nothing.
        if (pairing.width && !is_same(n) &&
            (is_named ? std::ranges::find(powers_of(known[*pairing.width]), power) ==
                            powers_of(known[*pairing.width]).end()
                      : own.role() == Role::masking))
          continue;
        // Forms may differ by rounding only, near a narrow peak by 1e-5: the plainest map is taken,
        // and the first.
        constexpr double by_rounding = 1e-5;
        const auto map = static_cast<std::size_t>(&power - powers.data());
        const bool is_plainer = best && is_same(*best) && map < best_map &&
                                n.difference < best->difference + by_rounding;
        if (!best || is_plainer ||
            n.difference < std::min(0.5 * best->difference, best->difference - by_rounding))
          best = n, best_map = map;
      }
    }
  }
  if (shipped && best && is_same(*best) && best->cap &&
      catalogue()[best->term].id() == catalogue()[shipped->term].about->reference()) {
    shipped->as_shipped = likely_slips(term, *best);
    shipped->difference = std::min(shipped->difference, best->difference);
    return shipped;
  }
  return best;
}

std::vector<std::string> likely_slips(std::size_t term, const NearestForm& n) {
  std::vector<std::string> all;
  if (!is_same(n)) return all;
  const auto& own = catalogue()[term];
  const auto& f = *foreign_term(term)->function;
  const bool of_each = f.is_g && catalogue()[n.term].id() == "masking.smith_ggx.separable";
  if (n.width) {
    const auto& w = n.width->name;
    const bool is_roughness = is_rough(*n.width), is_square = is_squared(*n.width);
    const bool is_width_by_name = width_of(std::span(&*n.width, 1)).has_value();
    if (is_roughness && !is_square && n.power == 4)
      all.push_back(
          fmt::format("{} is squared once too often: alpha is {}⁴ here, expected {}²", w, w, w));
    if (!is_roughness && !is_square && is_width_by_name && n.power == 2)
      all.push_back(
          fmt::format("{} is squared once too often: the form's alpha is {}² here", w, w));
    if (is_roughness && (n.power == of_gloss || n.power == of_gloss_as_alpha))
      all.push_back(fmt::format("{0} is used as a smoothness: expected 1 − {0} in its place", w));
    if (is_gloss(*n.width) && !narrows(n.power))
      all.push_back(fmt::format("{0} is used as a roughness: expected 1 − {0} in its place", w));
    if ((is_roughness || w == "alpha") && n.power == of_inverse)
      all.push_back(fmt::format("{0} is inverted: the form's alpha is 1/{0} here", w));
    if (!is_roughness && !is_square && is_width_by_name && n.power == 0.5)
      all.push_back(
          fmt::format("{} stands where {}² belongs: the form's alpha is √{} here", w, w, w));
  }
  if (n.norms) {
    Range norms{1e300, 0};
    for (const auto& p : auditing::combinations(known_parameters(term), [](const Parameter& q) {
           return Values{low_of(q), usual_of(q), high_of(q)};
         })) {
      const double norm = normalisation(term, p).value;
      norms = {std::min(norms.low, norm), std::max(norms.high, norm)};
    }
    all.push_back(
        fmt::format("the form is right and its norm is not: ∫ D cos θ is {:.3g} to {:.3g}, "
                    "expected 1",
                    norms.low, norms.high));
  }
  if (!n.norms && std::abs(n.factor - 1) > same_within && own.role() != Role::diffuse)
    all.push_back(of_each && std::abs(n.factor / 0.25 - 1) < same_within
                      ? "4 times too small: the 2 of each G1 = 2 c/(c + …) is missing"
                      : factor_text(n.factor));
  if (n.is_swapped)
    all.push_back(fmt::format("{} and {} are swapped: {} belongs to the tangent X",
                              own.parameters[0].name, own.parameters[1].name,
                              own.parameters[(*two_widths(known_parameters(term)))[0]].name));
  if (n.cap && n.width) {
    const double alpha = 1 / std::sqrt(std::numbers::pi * *n.cap / n.factor);  // of a GGX peak
    const double w = std::pow(alpha, 1 / n.power);
    all.push_back(
        fmt::format("a clamp at {:.5g} cuts the peak below {} {:.3g}", *n.cap, n.width->name, w));
  }
  if (n.bite && !n.bite->is_little) all.push_back(text_of(*n.bite, *n.width, n.power));
  if (n.drop && !n.drop->is_little()) all.push_back(text_of(*n.drop));
  if (own.role() == Role::masking && !n.of_one) {
    const auto name = plain_name(f.name.function);
    if (f.is_g && (name.starts_with("v") && !name.starts_with("vg")))
      all.push_back(
          "it gives G although it is called V: the division by 4 NoL NoV is missing, or stands "
          "elsewhere");
  }
  return all;
}

std::string k_of(std::string_view form) {
  if (form.ends_with("schlick_ggx.direct"))
    return "its k is that of direct light, (roughness + 1)²/8: right for lamps; under an "
           "environment k = alpha/2";
  if (form.ends_with("schlick_ggx.half_alpha"))
    return "its k is that of image light, alpha/2: right under an environment; for lamps most "
           "shaders have k = (roughness + 1)²/8";
  return "";
}

std::vector<std::string> to_check(const Parameter& width, double power) {
  if (power == 1 && is_squared(width) && !is_rough(width))
    return {fmt::format("{} is taken for alpha: right where it is no square, as of a second lobe",
                        width.name)};
  if (!is_rough(width) || is_squared(width) || power != 1) return {};
  return {fmt::format(
      "{} is taken for alpha: right where the caller has squared a roughness before; otherwise "
      "highlights are too wide",
      width.name)};
}

std::vector<std::string> to_check(const NearestForm& n) {
  if (!is_same(n)) return {};
  auto all = n.width ? to_check(*n.width, n.power) : std::vector<std::string>{};
  if (auto k = k_of(catalogue()[n.term].id()); !k.empty()) all.push_back(std::move(k));
  if (n.bite && n.bite->is_little) all.push_back(text_of(*n.bite, *n.width, n.power));
  if (n.drop && n.drop->is_little()) all.push_back(text_of(*n.drop));
  for (const auto& what : n.as_shipped)
    all.push_back(fmt::format("{}; {} ships so", what, catalogue()[n.term].id()));
  if (catalogue()[n.term].role() == Role::diffuse && std::abs(n.factor - 1) > same_within) {
    constexpr double pi_of_energy = 1e-3;
    all.push_back(std::abs(n.factor / std::numbers::pi - 1) < pi_of_energy
                      ? "1/π is missing: right where its caller divides by π"
                      : fmt::format("its value is {:.4g} times that form's: right where that is "
                                    "meant, as energy that a diffuse part may keep",
                                    n.factor));
  }
  return all;
}

}  // namespace gonio
