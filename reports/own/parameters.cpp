#include "reports/own/parameters.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/letters.h"

namespace gonio {

std::string plain_name(std::string_view name) {
  std::string s;
  for (const char c : name)
    if (c != '_') s += lower_case(c);
  return s;
}

std::string_view stem_of(std::string_view n) {
  return n.ends_with("_r") || n.ends_with("_g") || n.ends_with("_b") ? n.substr(0, n.size() - 2)
                                                                     : n;
}

bool is_colour(const Parameter& p) {
  const std::string n = plain_name(p.name);
  return p.per_channel || stem_of(p.name) != p.name ||
         std::ranges::any_of(std::array{"f0", "r0", "kd", "ks", "albedo", "diffuse", "specular"},
                             [&](const char* begin) { return n.starts_with(begin); }) ||
         n.find("color") != n.npos || n.find("colour") != n.npos;
}

bool is_rough(std::string_view name) {
  return plain_name(name).find("rough") != std::string::npos;
}

bool is_exponent(std::string_view name) {
  const auto n = plain_name(name);
  return n.find("shin") != n.npos || n.find("expo") != n.npos || n == "n" || n == "power" ||
         n == "specpower" || n == "specularpower";
}

std::optional<std::size_t> width_of(std::span<const Parameter> parameters) {
  for (const auto* name : {"alpha", "rough", "gloss", "smooth", "sigma", "width"})
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

double low_of(const Parameter& p) {
  return std::isnan(p.start) ? 0.05 : p.legal.low;
}
double usual_of(const Parameter& p) {
  return std::isnan(p.start) ? 0.5 : p.start;
}
double high_of(const Parameter& p) {
  return std::isnan(p.start) ? 1 : p.legal.high;
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
                                      : std::pow(width, power);
}

std::span<const double> powers_of(std::string_view width) {
  static constexpr std::array powers{1.0, 2.0, 0.5, 4.0};
  static constexpr std::array of_glosses{of_gloss, of_gloss_as_alpha};
  const auto n = plain_name(width);
  if (is_exponent(width)) return {&of_exponent, 1};
  if (n.find("gloss") != n.npos || n.find("smooth") != n.npos) return of_glosses;
  return powers;
}

bool narrows(double power) {
  return power < 0;
}

std::string alpha_text(const std::string& w, double power) {
  return power == of_exponent         ? "√(2/(" + w + " + 2))"
         : power == of_gloss          ? "(1 − " + w + ")²"
         : power == of_gloss_as_alpha ? "1 − " + w
         : power == 0.5               ? "√" + w
         : power == 2                 ? w + "²"
         : power == 4                 ? w + "⁴"
                                      : w;
}

std::optional<PartColours> part_colours(std::span<const Parameter> parameters) {
  const auto is_f0 = [](const Parameter& p) {
    const auto n = plain_name(stem_of(p.name));
    return n == "f0" || n == "r0" || n == "ks" || n.starts_with("speccol") ||
           (n.starts_with("specular") && n.find("tint") == n.npos && !is_exponent(n));
  };
  PartColours c;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const auto& p = parameters[k];
    const auto n = plain_name(stem_of(p.name));
    if (n.starts_with("metal")) c.metallic = k;
    if (is_f0(p))
      c.f0.push_back(k);
    else if (is_colour(p) && n.find("sheen") == n.npos && n.find("coat") == n.npos &&
             n.find("emi") == n.npos)
      c.diffuse.push_back(k);
  }
  if (c.metallic && !c.diffuse.empty()) c.f0 = c.diffuse;
  if (c.f0.empty()) return {};
  return c;
}

namespace {

std::vector<double> plain_values(std::span<const Parameter> parameters, Others others) {
  std::vector<double> v;
  for (const auto& p : parameters) {  // a second width, as of a coat, divides
    const bool is_low = is_colour(p)
                            ? !std::isnan(p.start)
                            : others == Others::low && !std::isnan(p.start) && !is_rough(p.name);
    v.push_back(is_low ? low_of(p) : is_colour(p) ? 0 : usual_of(p));
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
  return with_part(parameters, colours, colours.f0, f0, high_of, others);
}

std::vector<double> with_diffuse(std::span<const Parameter> parameters,
                                 const PartColours& colours,
                                 double colour,
                                 Others others) {
  return with_part(parameters, colours, colours.diffuse, colour, low_of, others);
}

}  // namespace gonio
