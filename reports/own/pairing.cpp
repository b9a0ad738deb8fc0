#include "reports/own/pairing.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "reports/own/parameters.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {
namespace {

std::string known(const Parameter& p) {
  return plain_name(stem_of(p.meaning));
}

StandsFor itself(std::span<const Parameter> own, std::size_t k, double scale = 1) {
  return {[k, scale](std::span<const double> v) { return scale * v[k]; },
          fmt::format("{}{}", scale == 1 ? "" : fmt::format("{} ", scale), stem_of(own[k].name))};
}
StandsFor alpha_by(std::span<const Parameter> own, std::size_t k, double power) {
  return {[k, power](std::span<const double> v) { return alpha_of(v[k], power); },
          alpha_text(std::string(own[k].name), power)};
}
/// Of a width whose alpha is known: another file's roughness, say.
StandsFor width_of_alpha(StandsFor alpha, const Parameter& width) {
  const double power = conventions_of(width)[0];
  if (power == 1) return alpha;
  return {[of = alpha.value, power](std::span<const double> v) {
            const double a = of(v);
            return power == of_exponent         ? 2 / (a * a) - 2
                   : power == of_gloss          ? 1 - std::sqrt(a)
                   : power == of_gloss_as_alpha ? 1 - a
                                                : std::pow(a, 1 / power);
          },
          fmt::format("that of alpha = {}", alpha.text)};
}

/// Pairs of everything but widths.
Pairs by_name(std::span<const Parameter> own, std::span<const Parameter> other) {
  const bool has_metals = std::ranges::any_of(own, is_metallic);
  Pairs all(other.size());
  for (std::size_t j = 0; j < other.size(); ++j)
    for (std::size_t k = 0; k < own.size() && !all[j]; ++k) {
      const auto &q = other[j], &p = own[k];
      // In a metallic workflow specular is F0 of a dielectric over 0.08.
      constexpr double of_specular = 0.08;
      const bool is_over = has_metals && known(p) == "specular" && known(q) == "f0";
      if (means_same(p, q)) all[j] = itself(own, k, is_over ? of_specular : 1);
    }
  return all;
}

}  // namespace

std::vector<Pairs> possible_pairs(std::span<const Parameter> own,
                                  std::span<const Parameter> other) {
  const Pairs named = by_name(own, other);
  const auto width = width_of(own), width_of_other = width_of(other);
  const auto two = two_widths(own), two_of_other = two_widths(other);
  std::vector<Pairs> all;
  const auto add = [&](std::size_t j, StandsFor first, std::optional<StandsFor> second = {}) {
    Pairs p = named;
    p[j] = std::move(first);
    if (second) p[(*two_of_other)[1]] = std::move(*second);
    all.push_back(std::move(p));
  };
  if (two_of_other && two) {
    for (const double power : conventions_of(own[(*two)[0]]))
      for (const std::size_t first : {0U, 1U})
        add((*two_of_other)[0], alpha_by(own, (*two)[first], power),
            alpha_by(own, (*two)[1 - first], power));
  } else if (two_of_other && width) {
    const auto anisotropy = std::ranges::find_if(
        own, [](const Parameter& p) { return known(p).find("aniso") != std::string::npos; });
    const auto k = static_cast<std::size_t>(anisotropy - own.begin());
    for (const double power : conventions_of(own[*width])) {
      const auto alpha = alpha_by(own, *width, power);
      if (anisotropy == own.end()) {
        add((*two_of_other)[0], alpha, alpha);
        continue;
      }
      const auto along = [&](double sign, bool is_aspect) {
        const std::string name(own[k].name);
        return StandsFor{
            [of = alpha.value, k, sign, is_aspect](std::span<const double> v) {
              return of(v) * (is_aspect ? std::pow(1 - 0.9 * v[k], -sign / 2) : 1 + sign * v[k]);
            },
            is_aspect ? fmt::format("{} {} √(1 − 0.9 {})", alpha.text, sign > 0 ? "/" : "·", name)
                      : fmt::format("{} (1 {} {})", alpha.text, sign > 0 ? "+" : "−", name)};
      };
      for (const bool is_aspect : {true, false})
        for (const double sign : {1.0, -1.0})
          add((*two_of_other)[0], along(sign, is_aspect), along(-sign, is_aspect));
    }
  } else if (width_of_other) {
    for (const auto k : possible_widths(own)) {
      if (!width &&
          std::ranges::any_of(other, [&](const Parameter& q) { return means_same(own[k], q); }))
        continue;
      for (const double power : conventions_of(own[k]))
        add(*width_of_other, known(own[k]) == known(other[*width_of_other])
                                 ? itself(own, k)
                                 : width_of_alpha(alpha_by(own, k, power), other[*width_of_other]));
    }
  }
  if (all.empty()) all.push_back(named);
  return all;
}

std::vector<std::size_t> unpaired(const Pairs& pairs, std::span<const Parameter> own) {
  std::vector<std::size_t> left;
  for (std::size_t k = 0; k < own.size(); ++k) {
    // What stands for something changes it.
    std::vector<double> low, high;
    for (const auto& p : own)
      low.push_back(0.25 * (3 * low_of(p) + high_of(p))), high.push_back(low.back());
    high[k] = 0.25 * (low_of(own[k]) + 3 * high_of(own[k]));
    if (std::ranges::none_of(pairs,
                             [&](const auto& p) { return p && p->value(low) != p->value(high); }))
      left.push_back(k);
  }
  return left;
}

std::string text_of(const Pairs& pairs, std::span<const Parameter> other) {
  std::vector<std::string> all;
  for (std::size_t j = 0; j < other.size(); ++j)
    if (pairs[j]) all.push_back(fmt::format("{} = {}", other[j].name, pairs[j]->text));
  return fmt::format("{}", fmt::join(all, ", "));
}

}  // namespace gonio
