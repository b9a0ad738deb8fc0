// What the nearest model says of slips, in sentences.
#include <cmath>
#include <numbers>

#include "reports/own/nearest_model.h"
#include "reports/own/parameters.h"

#include <fmt/format.h>

namespace gonio {

bool is_without_pi(const NearestModel& n) {
  const bool is_highlight = n.spec.starts_with(n.shape) && !n.lacks_diffuse;
  return is_highlight && std::abs(n.factor * std::numbers::pi - 1) < same_within;
}

bool is_sheen(const NearestModel& n) {
  return n.shape == "charlie";
}

std::string highlight_text(double factor, bool guessed_pi) {
  if (const double off = std::abs(factor * std::numbers::pi - 1); !guessed_pi || off > 0.02)
    return "its highlight is " + factor_text(factor);
  return "its diffuse part is π times too large beside its highlight: 1/π is missing; or, if its "
         "value includes π, the highlight is divided by π once too often";
}

std::vector<std::string> likely_slips(const NearestModel& n,
                                      const Parameter& width,
                                      bool guessed_pi) {
  std::vector<std::string> all;
  if (std::abs(n.factor - 1) > same_within) all.push_back(highlight_text(n.factor, guessed_pi));
  const bool is_slip = !n.is_weight || n.colours.metallic;  // a metal's F0 is no weight
  if (is_slip && !n.disguise.empty()) all.push_back(n.disguise);
  for (const auto& slip :
       {n.half_vector, n.form_slip, n.fresnel_slip, n.interface_slip, n.diffuse_slip})
    if (!slip.empty()) all.push_back(slip);
  const std::string name(width.name);
  if (n.power != n.masking_power)
    all.push_back(fmt::format("alpha is {} in D and {} in V: expected one alpha for both",
                              alpha_text(name, n.power), alpha_text(name, n.masking_power)));
  if (is_rough(width) && n.power == 4)
    all.push_back(
        fmt::format("{0} is squared once too often: alpha is {0}⁴ here, expected {0}²", name));
  if (n.bite && !n.bite->is_little) all.push_back(text_of(*n.bite, width, n.power));
  if (n.drop && !n.drop->is_little()) all.push_back(text_of(*n.drop));
  return all;
}

std::vector<std::string> to_check(const NearestModel& n, const Parameter& width) {
  auto all = to_check(width, n.power);
  if (n.is_weight && !n.colours.metallic) all.push_back(n.disguise);
  if (auto k = k_of(n.masking); !k.empty()) all.push_back(std::move(k));
  if (n.drop && n.drop->is_little()) all.push_back(text_of(*n.drop));
  if (n.bite && n.bite->is_little) all.push_back(text_of(*n.bite, width, n.power));
  return all;
}

}  // namespace gonio
