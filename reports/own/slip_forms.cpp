#include "reports/own/slip_forms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "brdf/catalogue/foreign_terms.h"
#include "brdf/in_number/number.h"
#include "reports/own/laws.h"
#include "reports/own/nearest.h"
#include "reports/own/parameters.h"

#include <fmt/format.h>

namespace gonio {
namespace {

using auditing::Row;
using auditing::Values;

constexpr double pi = std::numbers::pi;

// ---- distributions, of c = NoH
/// GGX with what stands in the place of NoH².
double ggx_of(double a, double c2) {
  const double d = c2 * (a * a - 1) + 1;
  return a * a / (pi * d * d);
}
/// Beckmann with what stands in the places of NoH² and of NoH⁴.
double beckmann_of(double a, double c2, double c4) {
  return std::exp((1 - 1 / c2) / (a * a)) / (pi * a * a * c4);
}
constexpr const char* squared_twice = "NoH is squared twice: NoH⁴ stands where NoH² belongs";
constexpr std::array of_distribution{
    SlipForm{[](double a, const Row&) { return a * a / pi; },
             "NoH is 0 everywhere: a clamp holds it, as min in the place of max", "ggx"},
    SlipForm{
        [](double a, const Row& r) { return a * a / (pi * (r.noh * r.noh * (a * a - 1) + 1)); },
        "the denominator of GGX is not squared", "ggx"},
    SlipForm{[](double a, const Row& r) {
               const double d = r.noh * r.noh * (a * a - 1) + 1;
               return a * a / pi * d * d;
             },
             "the square of GGX's denominator multiplies: it belongs below, in brackets", "ggx"},
    SlipForm{[](double a, const Row& r) { return ggx_of(a, r.noh * r.noh) / a; },
             "alpha stands above where alpha² belongs", "ggx"},
    SlipForm{[](double a, const Row& r) { return ggx_of(a, std::pow(r.noh, 4)); }, squared_twice,
             "ggx"},
    SlipForm{[](double a, const Row& r) { return ggx_of(a, r.noh * r.noh) * r.noh * r.noh; },
             "NoH² stands below where NoH⁴ belongs", "ggx"},
    SlipForm{[](double a, const Row& r) { return ggx_of(a, r.noh * r.noh) * std::pow(r.noh, 4); },
             "the division by NoH⁴ is missing", "ggx"},
    SlipForm{[](double a, const Row& r) { return ggx_of(a, r.noh); },
             "NoH stands where NoH² belongs", "ggx"},
    SlipForm{[](double a, const Row& r) {
               const double d = r.noh * r.noh * (1 - a * a) + 1;
               return a * a / (pi * d * d);
             },
             "1 − alpha² stands below where alpha² − 1 belongs", "ggx"},
    SlipForm{[](double a, const Row& r) {
               const double d = r.noh * r.noh * (a * a + 1) + 1;
               return a * a / (pi * d * d);
             },
             "alpha² + 1 stands below where alpha² − 1 belongs", "ggx"},
    SlipForm{[](double a, const Row& r) {
               return beckmann_of(a, std::pow(r.noh, 4), std::pow(r.noh, 8));
             },
             squared_twice, "beckmann"},
    SlipForm{[](double a, const Row& r) {
               return beckmann_of(a, std::pow(r.noh, 4), std::pow(r.noh, 4));
             },
             squared_twice, "beckmann"},
    SlipForm{[](double a, const Row& r) { return beckmann_of(a, r.noh * r.noh, 1); },
             "the division by NoH⁴ is missing", "beckmann"},
    SlipForm{[](double a, const Row& r) { return beckmann_of(a, r.noh * r.noh, r.noh * r.noh); },
             "NoH² stands below where NoH⁴ belongs", "beckmann"},
    SlipForm{[](double a, const Row& r) {
               return beckmann_of(a, r.noh * r.noh, a * a * std::pow(r.noh, 4)) * a * a * a;
             },
             "alpha stands below where alpha² belongs", "beckmann"},
    SlipForm{[](double a, const Row& r) {
               const double n = 2 / (a * a) - 2;
               return (n + 1) / (2 * pi) * std::pow(r.noh, n);
             },
             "n + 1 stands above where n + 2 belongs: it is normalised over the hemisphere, not "
             "projected",
             "blinn_phong"},
    SlipForm{[](double a, const Row& r) {
               const double t = std::sqrt(std::max(0.0, 1 / (r.noh * r.noh) - 1));
               return std::exp(-t / a) / (pi * a * a * std::pow(r.noh, 4));
             },
             "tan θ/alpha stands in the exponent where its square belongs", "beckmann"},
    SlipForm{
        [](double a, const Row& r) { return (2 + a) / (2 * pi) * std::pow(r.sin2_theta_h, a / 2); },
        "its width is inverted: alpha stands where 1/alpha belongs in Charlie's exponent",
        "charlie"},
    SlipForm{[](double a, const Row& r) {
               return (2 + 1 / a) / (2 * pi) * std::pow(r.sin2_theta_h, 1 / a);
             },
             "½ is missing in Charlie's exponent: sin² θ has the power 1/(2 alpha)", "charlie"},
};

// ---- masking, of a cosine c
/// c² (1 − α²) + α², whose root stands in Smith's masking for GGX; over c² it is 1 + α² tan² θ.
double below(double a, double c) {
  return c * c * (1 - a * a) + a * a;
}
/// √(1 + α² tan² θ)
double steep(double a, double c) {
  return std::sqrt(below(a, c)) / c;
}
constexpr const char* no_root = "the square root of Smith's masking is missing";
constexpr const char* no_minus = "−1 is missing in Smith's Λ = (−1 + √(1 + α² tan² θ))/2";
constexpr const char* no_half = "½ is missing in Smith's Λ = (−1 + √(1 + α² tan² θ))/2";
constexpr const char* swapped_cosines =
    "NoL and NoV are swapped: expected NoV beside the root with NoL, and NoL beside the one with "
    "NoV";
/// Masking by one direction; of two the product.
struct OfOne {
  double (*g1)(double alpha, double cosine);
  const char *slip, *like;
};
constexpr std::array of_one{
    OfOne{[](double a, double c) { return 2 * c / (c + below(a, c)); }, no_root,
          "smith_ggx.separable"},
    OfOne{[](double a, double c) { return 2 / (2 + a * a * (1 / (c * c) - 1)); }, no_root,
          "smith_ggx.separable"},
    OfOne{[](double a, double c) { return 2 / (2 + steep(a, c)); }, no_minus,
          "smith_ggx.separable"},
    OfOne{[](double a, double c) { return 1 / steep(a, c); }, no_half, "smith_ggx.separable"},
    OfOne{[](double a, double c) { return 2 * c / (c + std::sqrt(c * c + a * a)); },
          "(1 − alpha²) is missing beside the cosine's square", "smith_ggx.separable"},
    OfOne{[](double a, double c) { return c / (c + a / 2); },
          "(1 − k) is missing beside the cosine in Schlick's masking", "schlick_ggx.half_alpha"},
    OfOne{[](double a, double c) { return c / (c * (1 - a) + a); },
          "k is alpha: Schlick's masking has k = alpha/2", "schlick_ggx.half_alpha"},
};
template <std::size_t k>
double of_both(double a, const Row& r) {
  return of_one[k].g1(a, r.nol) * of_one[k].g1(a, r.nov) / (4 * r.nol * r.nov);
}
/// As V, or as G1 itself.
template <std::size_t k, bool of_view, bool is_v>
double of_either(double a, const Row& r) {
  return of_one[k].g1(a, of_view ? r.nov : r.nol) / (is_v ? 4 * r.nol * r.nov : 1);
}

double correlated(const Row& r, double of_l, double of_v) {
  return 0.5 / (r.nov * of_l + r.nol * of_v);
}
double by_lambda(const Row& r, double of_l, double of_v) {
  return 1 / (1 + of_l + of_v) / (4 * r.nol * r.nov);
}
/// Right masking by one direction: Smith's for GGX, and Schlick's fit to it.
double smith_of(double a, double c) {
  return 2 / (1 + steep(a, c));
}
double schlick_of(double a, double c) {
  return c / (c * (1 - a / 2) + a / 2);
}
template <auto g1, bool of_view, bool is_twice>
double of_one_only(double a, const Row& r) {
  const double g = g1(a, of_view ? r.nov : r.nol);
  return (is_twice ? g * g : g) / (4 * r.nol * r.nov);
}
template <auto g1>
constexpr std::array<SlipForm, 4> halves(const char* like) {
  return {
      SlipForm{of_one_only<g1, true, false>,
               "its masking is that of the view only: G1 of the light is missing", like},
      SlipForm{of_one_only<g1, false, false>,
               "its masking is that of the light only: G1 of the view is missing", like},
      SlipForm{of_one_only<g1, true, true>, "NoV stands in both factors of its masking", like},
      SlipForm{of_one_only<g1, false, true>, "NoL stands in both factors of its masking", like}};
}
constexpr auto of_half = [] {
  std::array<SlipForm, 8> all{};
  const auto at = std::ranges::copy(halves<smith_of>("smith_ggx.separable"), all.begin()).out;
  std::ranges::copy(halves<schlick_of>("schlick_ggx.half_alpha"), at);
  return all;
}();
constexpr std::array of_pair{
    SlipForm{[](double a, const Row& r) {
               return correlated(r, std::sqrt(below(a, r.nov)), std::sqrt(below(a, r.nol)));
             },
             swapped_cosines, "smith_ggx.correlated"},
    SlipForm{[](double a, const Row& r) { return 0.25 / (r.nol * std::sqrt(below(a, r.nov))); },
             "its term of the view stands twice: that of the light, NoV beside the root with NoL, "
             "is missing",
             "smith_ggx.correlated"},
    SlipForm{[](double a, const Row& r) { return 0.25 / (r.nov * std::sqrt(below(a, r.nol))); },
             "its term of the light stands twice: that of the view, NoL beside the root with NoV, "
             "is missing",
             "smith_ggx.correlated"},
    SlipForm{[](double a, const Row& r) {
               const auto root = [&](double c) { return std::sqrt(c * c * (1 + a * a) + a * a); };
               return correlated(r, root(r.nol), root(r.nov));
             },
             "1 + alpha² stands where 1 − alpha² belongs in Smith's root", "smith_ggx.correlated"},
    SlipForm{[](double a, const Row& r) { return correlated(r, below(a, r.nol), below(a, r.nov)); },
             no_root, "smith_ggx.correlated"},
    SlipForm{[](double a, const Row& r) {
               const auto l = [&](double c) { return a * a * (1 / (c * c) - 1) / 2; };
               return by_lambda(r, l(r.nol), l(r.nov));
             },
             no_root, "smith_ggx.correlated"},
    SlipForm{[](double a, const Row& r) {
               return by_lambda(r, steep(a, r.nol) / 2, steep(a, r.nov) / 2);
             },
             no_minus, "smith_ggx.correlated"},
    SlipForm{[](double a, const Row& r) {
               return by_lambda(r, steep(a, r.nol) - 1, steep(a, r.nov) - 1);
             },
             no_half, "smith_ggx.correlated"},
    SlipForm{[](double a, const Row& r) {
               return correlated(r, std::hypot(r.nol, a), std::hypot(r.nov, a));
             },
             "(1 − alpha²) is missing beside the cosine's square", "smith_ggx.correlated"},
};
template <std::size_t... k>
constexpr auto pairs_of_one(std::index_sequence<k...>) {
  return std::array{SlipForm{of_both<k>, of_one[k].slip, of_one[k].like}...};
}
template <bool of_view, bool is_v, std::size_t... k>
constexpr auto ones(std::index_sequence<k...>) {
  return std::array{SlipForm{of_either<k, of_view, is_v>, of_one[k].slip, of_one[k].like}...};
}
constexpr auto each_one = std::make_index_sequence<of_one.size()>{};
constexpr auto of_product = pairs_of_one(each_one);
/// Of one direction k may be what the caller makes of alpha.
constexpr auto but_for_k = std::make_index_sequence<of_one.size() - 1>{};
constexpr std::array of_one_direction{
    ones<true, true>(but_for_k), ones<false, true>(but_for_k),  // without a root G1 may exceed 1
    ones<true, false>(but_for_k), ones<false, false>(but_for_k)};
/// 2 NoH c/VoH of Cook and Torrance, whose masking has no width.
double groove(const Row& r, double c) {
  return 2 * r.noh * c / r.voh;
}
constexpr const char* max_for_min =
    "max stands where min belongs: G = min(1, 2 NoH NoV/VoH, 2 NoH NoL/VoH)";
constexpr std::array of_none{
    SlipForm{[](double, const Row& r) { return 0.25 / (r.nol + r.nov + r.nol * r.nov); },
             "+ NoL NoV stands below where − NoL NoV belongs in Neubelt's V", "kelemen"},
    SlipForm{[](double, const Row& r) { return 1 / (r.nol + r.nov - r.nol * r.nov); },
             "4 times that of Neubelt: a 4 is missing below", "kelemen"},
    SlipForm{[](double, const Row& r) {
               const double a = groove(r, r.nol), b = groove(r, r.nov);
               return std::max(1.0, std::min(a, b)) / (4 * r.nol * r.nov);
             },
             max_for_min, "cook_torrance"},
    SlipForm{[](double, const Row& r) {
               const double a = groove(r, r.nol), b = groove(r, r.nov);
               return std::min(1.0, std::max(a, b)) / (4 * r.nol * r.nov);
             },
             max_for_min, "cook_torrance"},
    SlipForm{[](double, const Row& r) {
               const double a = groove(r, r.nol), b = groove(r, r.nov);
               return std::max({1.0, a, b}) / (4 * r.nol * r.nov);
             },
             max_for_min, "cook_torrance"},
    SlipForm{[](double, const Row& r) {
               return std::min(groove(r, r.nol), groove(r, r.nov)) / (4 * r.nol * r.nov);
             },
             "the 1 is missing: G = min(1, 2 NoH NoV/VoH, 2 NoH NoL/VoH)", "cook_torrance"},
    SlipForm{[](double, const Row& r) {
               const double a = groove(r, r.nol), b = groove(r, r.nov);
               return std::min({1.0, a / 2, b / 2}) / (4 * r.nol * r.nov);
             },
             "the 2 is missing: G = min(1, 2 NoH NoV/VoH, 2 NoH NoL/VoH)", "cook_torrance"},
    SlipForm{[](double, const Row& r) { return 0.25 / std::min(r.nol, r.nov); },
             "min stands where max belongs: V = 1/(4 max(NoL, NoV))", "neumann"},
};

// ---- diffuse functions, but for their colour
/// Burley's two factors with an F90.
double burley_of(double f90, const Row& r) {
  return (1 + (f90 - 1) * std::pow(1 - r.nol, 5)) * (1 + (f90 - 1) * std::pow(1 - r.nov, 5));
}
constexpr std::array of_diffuse{
    SlipForm{
        [](double a, const Row& r) { return burley_of(0.5 + 2 * std::sqrt(a) * r.noh * r.noh, r); },
        "NoH stands where VoH belongs in F90 = 0.5 + 2 roughness VoH²", "disney"},
    SlipForm{[](double a, const Row& r) {
               const double f90 = 0.5 + 2 * std::sqrt(a) * r.voh * r.voh;
               return (1 + (f90 - 1) * std::pow(r.nol, 5)) * (1 + (f90 - 1) * std::pow(r.nov, 5));
             },
             "NoL⁵ and NoV⁵ stand where (1 − NoL)⁵ and (1 − NoV)⁵ belong", "disney"},
    SlipForm{
        [](double a, const Row& r) { return burley_of(1.5 + 2 * std::sqrt(a) * r.voh * r.voh, r); },
        "F90 stands where F90 − 1 belongs", "disney"},
    SlipForm{
        [](double a, const Row& r) { return burley_of(0.5 + std::sqrt(a) * r.voh * r.voh, r); },
        "the 2 is missing in F90 = 0.5 + 2 roughness VoH²", "disney"},
    SlipForm{[](double a, const Row& r) { return burley_of(0.5 + 2 * std::sqrt(a) * r.voh, r); },
             "VoH is not squared in F90 = 0.5 + 2 roughness VoH²", "disney"},
    SlipForm{[](double sigma, const Row& r) {
               const double q = sigma * sigma, s = 2 * r.voh * r.voh - 1 - r.nol * r.nov;
               const double t = s > 0 ? std::min(r.nol, r.nov) : 1;
               return 1 - 0.5 * q / (q + 0.33) + 0.45 * q / (q + 0.09) * std::max(s, 0.0) / t;
             },
             "min stands where max belongs: s/max(NoL, NoV) in Oren and Nayar's B", "oren_nayar"}};

constexpr auto of_masking = [] {
  std::array<SlipForm, of_pair.size() + of_product.size() + of_none.size() + of_half.size()> all{};
  auto at = std::ranges::copy(of_pair, all.begin()).out;
  at = std::ranges::copy(of_product, at).out;
  at = std::ranges::copy(of_none, at).out;
  std::ranges::copy(of_half, at);
  return all;
}();

/// True where values are a form's but for rounding; where the form has none, they may be anything, and at the horizon they may have
/// none.
bool are(std::span<const double> values,
         std::span<const Row> rows,
         const std::function<double(const Row&)>& form) {
  Values wanted;
  double most = 0;
  for (const auto& r : rows) {
    wanted.push_back(form(r));
    if (std::isfinite(wanted.back())) most = std::max(most, std::abs(wanted.back()));
  }
  constexpr double rounding = 1e-6;  // of 1 − NoH² beside sin² θ
  if (!(most > 0)) return false;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!std::isfinite(wanted[i]) || (rows[i].noh == 0 && !std::isfinite(values[i]))) continue;
    if (!(std::abs(values[i] - wanted[i]) <= same_within * std::abs(wanted[i]) + rounding * most))
      return false;
  }
  return true;
}

/// G1 with a sum in its denominator: Smith's for GGX, and Schlick's of both k.
constexpr std::array with_sum{
    +[](double a, double c, double sum) { return 2 * c / (c + std::sqrt(below(a, c)) + sum); },
    +[](double a, double c, double sum) { return c / (c * (1 - a / 2) + a / 2 + sum); },
    +[](double a, double c, double sum) {
      const double k = (std::sqrt(a) + 1) * (std::sqrt(a) + 1) / 8;
      return c / (c * (1 - k) + k + sum);
    }};

/// "0.05 is added …", where values of V at widths are of two such factors.
std::string sum_in_masking(std::span<const Row> rows,
                           const std::vector<Values>& values,
                           std::span<const double> alphas) {
  const auto normal = static_cast<std::size_t>(
      std::ranges::max_element(rows, {}, [](const Row& r) { return r.nol * r.nov; }) -
      rows.begin());
  const double g = values[0][normal] * 4 * rows[normal].nol * rows[normal].nov;
  if (!(g > 0.2) || !(g < 1 - same_within)) return "";
  for (const auto g1 : with_sum) {
    const double sum = (1 / std::sqrt(g) - 1) / (1 - g1(alphas[0], 1, 1)) * g1(alphas[0], 1, 1);
    std::size_t k = 0;
    while (k < values.size() && are(values[k], rows, [&](const Row& r) {
             return g1(alphas[k], r.nol, sum) * g1(alphas[k], r.nov, sum) / (4 * r.nol * r.nov);
           }))
      ++k;
    if (k == values.size())
      return fmt::format(
          "{:.3g} is added to G1's denominator: masking takes {:.2g} % along the normal, where it "
          "takes none",
          sum, 100 * (1 - g));
  }
  return "";
}

std::string slip_of_two_widths(std::size_t term) {
  const auto& rows = auditing::rows_of(Role::masking);
  const auto parameters = known_parameters(term);
  const Values p{usual_of(parameters[0]), 0.7 * high_of(parameters[1])};
  const auto v = values_in(Number::double_, term, p, rows);
  const auto root = [&](double x, double y, double z) { return std::hypot(p[0] * x, p[1] * y, z); };
  const auto is = [&](auto of) {
    return are(v, rows, [&](const Row& r) {
      return of(r, root(r.xol, r.yol, r.nol), root(r.xov, r.yov, r.nov));
    });
  };
  if (is([](const Row& r, double of_l, double of_v) {
        return 0.5 / (r.nol * of_l + r.nov * of_v);
      }))
    return swapped_cosines;
  if (is([](const Row& r, double of_l, double of_v) {
        return correlated(r, of_l * of_l, of_v * of_v);
      }) ||
      is([](const Row& r, double of_l, double of_v) {
        return 1 / ((r.nol + of_l * of_l) * (r.nov + of_v * of_v));
      }))
    return no_root;
  return "";
}

/// Of a Fresnel function with F0, or with eta, and maybe with the extinction k.
std::string slip_of_fresnel(std::size_t term) {
  const auto& rows = auditing::rows_of(Role::fresnel);
  const auto known = known_parameters(term);
  Values p;
  for (const auto& q : known) p.push_back(usual_of(q));
  const auto eta = std::ranges::find_if(known, is_eta);
  const auto k = std::ranges::find_if(known, [](const Parameter& q) { return q.meaning == "k"; });
  const auto colours = part_colours(known);
  const bool has_f0 = colours && !colours->f0.empty();
  if (eta != known.end() && !has_f0) {
    const double extinction = k == known.end() ? 0 : usual_of(*k);
    const auto values = values_in(Number::double_, term, p, rows);
    for (const auto& s : exact_slips())
      if (are(values, rows,
              [&](const Row& r) { return s.value(r.voh, usual_of(*eta), extinction); }))
        return s.slip;
    return "";
  }
  if (!has_f0 && known.size() != 1) return "";
  const std::size_t of = has_f0 ? colours->f0[0] : 0;
  p[of] = low_of(known[of]) + 0.1 * (high_of(known[of]) - low_of(known[of]));
  return fresnel_slip(p[of], rows, values_in(Number::double_, term, p, rows), false);
}

}  // namespace

std::span<const SlipForm> slip_forms(Role role) {
  if (role == Role::ndf) return of_distribution;
  if (role == Role::diffuse) return of_diffuse;
  return role == Role::masking ? std::span<const SlipForm>(of_masking)
                               : std::span<const SlipForm>();
}

std::string slip_form(std::size_t term) {
  const auto& own = catalogue()[term];
  const auto& rows = auditing::rows_of(own.role());
  if (own.role() == Role::fresnel) return slip_of_fresnel(term);
  if (own.anisotropic && own.role() == Role::masking && own.parameters.size() == 2)
    return slip_of_two_widths(term);
  if (own.role() == Role::masking && own.parameters.empty()) {
    const auto v = values_in(Number::double_, term, {}, rows);
    for (const auto& s : of_none)
      if (are(v, rows, [&](const Row& r) { return s.value(0, r); })) return s.slip;
    return "";
  }
  const auto known = known_parameters(term);
  const auto width = width_of(known);
  if (!width || own.anisotropic) return "";
  constexpr std::size_t places = 4;
  const auto widths = values_between(known[*width], places);
  std::vector<Values> values;
  for (const double w : widths) {
    Values p;
    for (const auto& q : known) p.push_back(usual_of(q));
    p[*width] = w;
    values.push_back(values_in(Number::double_, term, p, rows));
  }
  const auto named = [&](std::span<const SlipForm> forms) -> std::string {
    for (const double power : powers_of(known[*width]))
      for (const auto& s : forms) {
        const bool has_colour = own.role() == Role::diffuse;
        const double colour =
            has_colour ? values[0][0] / s.value(alpha_of(widths[0], power), rows[0]) : 1;
        std::size_t k = 0;
        while (k < places && are(values[k], rows, [&](const Row& r) {
                 return colour * s.value(alpha_of(widths[k], power), r);
               }))
          ++k;
        if (k == places) return s.slip;
      }
    return "";
  };
  if (auto slip = named(slip_forms(own.role())); !slip.empty() || own.role() != Role::masking)
    return slip;
  for (const double power : powers_of(known[*width])) {
    Values alphas;
    for (const double w : widths) alphas.push_back(alpha_of(w, power));
    if (auto slip = sum_in_masking(rows, values, alphas); !slip.empty()) return slip;
  }
  if (!other_cosine(*foreign_term(term)->function)) return "";
  for (const auto& forms : of_one_direction)
    if (auto slip = named(forms); !slip.empty()) return slip;
  return "";
}

}  // namespace gonio
