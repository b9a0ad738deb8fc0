#include "reports/own/parameters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "base/letters.h"
#include "brdf/catalogue/foreign_terms.h"

namespace gonio {

std::vector<Parameter> known_parameters(std::size_t term) {
  const auto of = catalogue()[term].parameters;
  std::vector<Parameter> all(of.begin(), of.end());
  const auto* foreign = foreign_term(term);
  for (auto& p : all) {
    p.meaning = p.name;
    if (!foreign) continue;
    for (const auto& [name, role] : foreign->function->name.reading.arguments)
      if (role != "parameter" && (name == p.name || name == stem_of(p.name))) p.meaning = role;
  }
  return all;
}

namespace {

/// What is squared by its name: "alpha" of alphasq, "" of squared; none where the name says no square.
std::optional<std::string_view> square_of(std::string_view plain) {
  for (const std::string_view end : {"squared", "square", "pow2", "sqr", "sq", "2", "pow4", "4"})
    if (plain.ends_with(end)) return plain.substr(0, plain.size() - end.size());
  return {};
}

}  // namespace

std::string plain_name(std::string_view name) {
  constexpr std::string_view prefixes = "umg";
  for (const std::string_view of_struct : {"material_", "mat_"})
    if (name.starts_with(of_struct) && name.size() > of_struct.size())
      name.remove_prefix(of_struct.size());
  const auto is_upper = [](char c) { return c != lower_case(c); };
  const auto plain = [](std::string_view n) {
    std::string s;
    for (const char c : n)
      if (c != '_') s += lower_case(c);
    return s;
  };
  if (name.size() > 2 && prefixes.find(name[0]) != prefixes.npos &&
      (name[1] == '_' || (is_upper(name[1]) && !is_upper(name[0])))) {
    auto rest = plain(name.substr(1));
    if (!square_of(rest)) return rest;  // mSq is the square of m
  }
  return plain(name);
}

std::string_view stem_of(std::string_view n) {
  return n.ends_with("_r") || n.ends_with("_g") || n.ends_with("_b") ? n.substr(0, n.size() - 2)
                                                                     : n;
}

namespace {

/// The name that says what a parameter stands for, of a colour without its channel.
std::string known_as(const Parameter& p) {
  return plain_name(stem_of(p.meaning));
}

/// Of several parameters that may be F0, one that scales the highlight.
bool is_weight(const Parameter& p) {
  const auto n = known_as(p);
  return std::ranges::any_of(std::array{"weight", "intensity", "strength", "factor"},
                             [&](const char* end) { return n.ends_with(end); });
}

}  // namespace

bool is_f90(const Parameter& p) {
  const auto n = known_as(p);
  return n.starts_with("f90") || n.ends_with("f90");
}

bool is_metallic(const Parameter& p) {
  return known_as(p).starts_with("metal");
}

bool is_f0(const Parameter& p) {
  const auto n = known_as(p);
  if (is_f90(p)) return false;
  return n.starts_with("f0") || n == "r0" || n == "ks" || n == "spec" || n.starts_with("spec0") ||
         n == "specf0" || n.starts_with("speccol") ||
         (n.starts_with("specular") && n.find("tint") == n.npos && !is_exponent(p));
}

bool is_colour(const Parameter& p) {
  const auto n = known_as(p);
  if (is_f90(p)) return false;
  return p.per_channel || stem_of(p.name) != p.name || is_f0(p) ||
         std::ranges::any_of(std::array{"kd", "albedo", "diffuse", "specular"},
                             [&](const char* begin) { return n.starts_with(begin); }) ||
         n.find("color") != n.npos || n.find("colour") != n.npos;
}

bool is_rough(const Parameter& p) {
  const auto n = known_as(p);  // alphaRoughness of glTF's sample renderer is alpha
  return n.find("rough") != n.npos && n.find("alpha") == n.npos;
}

bool is_squared(const Parameter& p) {
  const auto n = known_as(p);
  const auto of = square_of(n);
  return of && !of->empty();
}

bool is_exponent(const Parameter& p) {
  const auto n = known_as(p);
  return n.find("shin") != n.npos || n.find("expo") != n.npos || n == "n" || n == "power" ||
         n == "specpower" || n == "specularpower";
}

bool is_anisotropy(const Parameter& p) {
  return known_as(p).find("aniso") != std::string::npos;
}

bool is_eta(const Parameter& p) {
  const auto n = known_as(p);
  return n == "eta" || n == "ior";
}

bool means_same(const Parameter& p, const Parameter& q) {
  const auto is_diffuse = [](const std::string& n) {
    return n == "kd" || n == "albedo" || n == "color" || n == "basecolor" ||
           n.starts_with("diffuse");
  };
  const auto is_k = [](const std::string& n) {
    return n == "k" || n == "etak" || n == "kappa" || n == "extinction";
  };
  const auto a = known_as(p), b = known_as(q);
  return a == b || (is_f0(p) && is_f0(q)) || (is_eta(p) && is_eta(q)) ||
         (is_diffuse(a) && is_diffuse(b)) || (is_k(a) && is_k(b)) ||
         (a.starts_with("f82") && b.starts_with("f82"));
}

std::optional<std::size_t> width_of(std::span<const Parameter> parameters) {
  for (const auto* name : {"alpha", "rough", "gloss", "smooth", "sigma", "width"})
    for (std::size_t k = 0; k < parameters.size(); ++k)
      if (known_as(parameters[k]).starts_with(name)) return k;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const auto n = known_as(parameters[k]);
    const auto letter = square_of(n).value_or(n);
    if (is_exponent(parameters[k]) || letter == "a" || letter == "m" || letter == "r" ||
        n.find("rough") != n.npos || n.find("alpha") != n.npos)
      return k;
  }
  if (const auto two = two_widths(parameters)) return (*two)[0];
  return {};
}

std::vector<std::size_t> possible_widths(std::span<const Parameter> parameters) {
  if (const auto named = width_of(parameters)) return {*named};
  std::vector<std::size_t> all;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const auto& p = parameters[k];
    if (!is_colour(p) && !is_metallic(p) && !is_eta(p) && !is_f90(p)) all.push_back(k);
  }
  return all;
}

std::optional<std::array<std::size_t, 2>> two_widths(std::span<const Parameter> all) {
  const auto is_width = [](const std::string& n) {
    return (n[0] == 'a' && n.size() == 2) || n.starts_with("alpha") || n.starts_with("rough");
  };
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = 0; j < all.size(); ++j) {
      const auto a = known_as(all[i]), b = known_as(all[j]);
      const bool is_said = i < j && a == b && stem_of(all[i].name) != stem_of(all[j].name);
      if (is_said && is_width(a)) return {{i, j}};  // by --argument
      if (a.size() < 2 || a.size() != b.size() || a.compare(0, a.size() - 1, b, 0, a.size() - 1))
        continue;
      const std::string ends{a.back(), b.back()};
      if (is_width(a) && (ends == "xy" || ends == "tb" || ends == "uv")) return {{i, j}};
    }
  return {};
}

namespace {

/// Low end, default and high end of a parameter without bounds, by what its name says.
struct Natural {
  double low, usual, high;
};
Natural natural_of(const Parameter& p) {
  if (is_f90(p)) return {0, 1, 1};
  if (is_colour(p) || is_metallic(p)) return {0, 0.5, 1};
  if (is_eta(p)) return {1.1, 1.5, 2.5};
  return {0.05, 0.5, 1};
}

}  // namespace

double low_of(const Parameter& p) {
  return std::isnan(p.start) ? natural_of(p).low : p.legal.low;
}
double usual_of(const Parameter& p) {
  return std::isnan(p.start) ? natural_of(p).usual : p.start;
}
double high_of(const Parameter& p) {
  return std::isnan(p.start) ? natural_of(p).high : p.legal.high;
}

std::vector<double> values_between(const Parameter& p, std::size_t count) {
  const Range r{low_of(p), high_of(p)};
  const bool by_ratio = r.low > 0 && r.high > 10 * r.low;
  std::vector<double> v;
  for (std::size_t k = 0; k < count; ++k) {
    const double part = (static_cast<double>(k) + 0.5) / static_cast<double>(count);
    v.push_back(by_ratio ? r.low * std::pow(r.high / r.low, part)
                         : r.low + part * (r.high - r.low));
  }
  return v;
}

double alpha_of(double width, double power) {
  return power == of_exponent         ? std::sqrt(2 / (width + 2))
         : power == of_gloss          ? (1 - width) * (1 - width)
         : power == of_gloss_as_alpha ? 1 - width
         : power == of_inverse        ? 1 / width
                                      : std::pow(width, power);
}

namespace {
constexpr std::array of_glosses{of_gloss, of_gloss_as_alpha};
}  // namespace

bool is_gloss(const Parameter& p) {
  const auto n = known_as(p);
  return n.find("gloss") != n.npos || n.find("smooth") != n.npos;
}

std::span<const double> powers_of(const Parameter& width) {
  static constexpr std::array powers{1.0, 2.0, 0.5, 4.0}, of_squares{0.5, 1.0, 2.0, 4.0};
  if (is_exponent(width)) return {&of_exponent, 1};
  if (is_squared(width)) return of_squares;
  return is_gloss(width) ? std::span<const double>(of_glosses) : powers;
}

std::vector<double> every_power(const Parameter& width) {
  const auto named = powers_of(width);
  std::vector<double> all(named.begin(), named.end());
  for (const double p : {1.0, 2.0, 0.5, 4.0, of_gloss, of_gloss_as_alpha, of_inverse, of_exponent})
    if (std::ranges::find(all, p) == all.end()) all.push_back(p);
  return all;
}

std::span<const double> conventions_of(const Parameter& width) {
  static constexpr std::array of_roughness{2.0, 1.0}, others{1.0, 2.0}, of_squares{0.5, 1.0};
  if (is_exponent(width) || is_gloss(width)) return powers_of(width);
  if (is_squared(width)) return of_squares;
  if (known_as(width) == "alpha") return std::span(others).first(1);
  return is_rough(width) ? of_roughness : others;
}

bool narrows(double power) {
  return power < 0;
}

std::string alpha_text(const std::string& w, double power) {
  return power == of_exponent         ? "√(2/(" + w + " + 2))"
         : power == of_gloss          ? "(1 − " + w + ")²"
         : power == of_gloss_as_alpha ? "1 − " + w
         : power == of_inverse        ? "1/" + w
         : power == 0.5               ? "√" + w
         : power == 2                 ? w + "²"
         : power == 4                 ? w + "⁴"
                                      : w;
}

std::optional<PartColours> part_colours(std::span<const Parameter> parameters) {
  PartColours c;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const auto& p = parameters[k];
    const auto n = known_as(p);
    if (is_metallic(p)) c.metallic = k;
    if (is_eta(p)) c.eta = k;
    if (is_f0(p))
      c.f0.push_back(k);
    else if (is_colour(p) && n.find("sheen") == n.npos && n.find("coat") == n.npos &&
             n.find("emi") == n.npos)
      c.diffuse.push_back(k);
  }
  const auto scales = [&](std::size_t k) { return is_weight(parameters[k]); };
  if (!std::ranges::all_of(c.f0, scales)) {
    std::ranges::copy_if(c.f0, std::back_inserter(c.weights), scales);
    std::erase_if(c.f0, scales);
  }
  if (c.metallic && !c.diffuse.empty()) c.f0 = c.diffuse;
  if (!c.f0.empty()) c.eta.reset();
  if (c.f0.empty() && !c.eta) return {};
  return c;
}

std::vector<PartColours> possible_colours(std::span<const Parameter> parameters) {
  std::vector<PartColours> all;
  if (auto named = part_colours(parameters)) all.push_back(std::move(*named));
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const auto stem = stem_of(parameters[k].name);
    if (!is_colour(parameters[k]) || (k > 0 && stem == stem_of(parameters[k - 1].name))) continue;
    PartColours c;
    for (std::size_t j = 0; j < parameters.size(); ++j)
      if (is_colour(parameters[j]))
        (stem_of(parameters[j].name) == stem ? c.f0 : c.diffuse).push_back(j);
    all.push_back(std::move(c));
  }
  return all;
}

namespace {

std::vector<double> plain_values(std::span<const Parameter> parameters, Others others) {
  std::vector<double> v;
  for (const auto& p : parameters) {  // a second width, as of a coat, divides
    const bool is_low = is_colour(p)
                            ? !std::isnan(p.start)
                            : others == Others::low && !std::isnan(p.start) && !is_rough(p);
    v.push_back(is_f90(p)                              ? high_of(p)
                : is_anisotropy(p) && p.legal.holds(0) ? 0
                : is_low && !is_anisotropy(p)          ? low_of(p)
                : is_colour(p)                         ? 0
                                                       : usual_of(p));
  }
  return v;
}

/// Plain values with one part's colours at a value, of a metal or of none.
std::vector<double> with_part(std::span<const Parameter> parameters,
                              const PartColours& colours,
                              std::span<const std::size_t> part,
                              double value,
                              double (*metallic)(const Parameter&),
                              Others others) {
  auto v = plain_values(parameters, others);
  if (colours.metallic) v[*colours.metallic] = metallic(parameters[*colours.metallic]);
  for (const auto k : part) v[k] = value;
  return v;
}

}  // namespace

std::vector<double> with_highlight(std::span<const Parameter> parameters,
                                   const PartColours& colours,
                                   double f0,
                                   Others others) {
  auto v = with_part(parameters, colours, colours.f0, f0, high_of, others);
  for (const auto k : colours.weights) v[k] = high_of(parameters[k]);
  if (colours.eta) v[*colours.eta] = high_of(parameters[*colours.eta]);
  return v;
}

std::vector<double> with_diffuse(std::span<const Parameter> parameters,
                                 const PartColours& colours,
                                 double colour,
                                 Others others) {
  return with_part(parameters, colours, colours.diffuse, colour, low_of, others);
}

}  // namespace gonio
