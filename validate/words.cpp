#include "validate/words.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {
namespace {

struct Words {
  std::string_view budget, title, found;  ///< found: sentence with the value in place of {}
};
constexpr std::array all{
    Words{"albedo_error", "Directional albedo off the reference's",
          "The directional albedo is off the reference's by {}"},
    Words{"fresnel_error", "F off the exact one", "F is off the exact one by {}"},
    Words{"delta_e_2000", "Colour off the reference's, ΔE2000",
          "The colour is off the reference's by ΔE2000 {}"},
    Words{"energy_gain", "Energy gained", "The energy gain is {}"},
    Words{"energy_loss", "Energy lost at F = 1", "The energy loss of white lobes is {}"},
    Words{"reciprocity", "Factor by which f changes where light and view change places",
          "f changes by {} where light and view change places"},
    Words{"nonfinite", "Inputs without a value", "Inputs without a value: {}"},
    Words{"operations", "Operations of a sample", "A sample takes {}"},
    Words{"ns", "Time against the baseline", "A sample takes {}"},
    Words{"table_bytes", "Bytes of tables", "Tables take {}"}};

/// Factor between two values that differ by a part of the larger: "2.7 ×", "1.000001 ×"; rounding is "none".
std::string factor_text(double part) {
  if (part < 1e-12) return "none";
  if (part >= 1) return "any factor";
  const double above = part / (1 - part);
  const int digits = above >= 1 ? 1 : 1 - static_cast<int>(std::floor(std::log10(above)));
  auto text = fmt::format("{:.{}f}", 1 + above, above >= 99 ? 0 : digits);
  if (text.find('.') != text.npos) text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text + " ×";
}

const Words& words_of(std::string_view budget) {
  return *std::ranges::find(all, budget, &Words::budget);
}

}  // namespace

std::string_view title_of(std::string_view budget) {
  return words_of(budget).title;
}

std::string value_text(std::string_view budget, double value) {
  const auto number = [&](int digits) {
    if (!std::isfinite(value)) return std::string("no number");
    return fmt::format("{}{:.{}g}", value < 0 ? "−" : "", std::abs(value), digits);
  };
  const bool energy = budget == "energy_gain" || budget == "energy_loss";
  if (value == 0 && (energy || budget == "reciprocity")) return "none";
  if (budget == "reciprocity" && std::isfinite(value)) return factor_text(value);
  if (budget == "operations") return fmt::format("{:.0f} operations", value);
  if (budget == "ns") return number(3) + " times the baseline's time";
  if (budget == "table_bytes") return fmt::format("{:.0f} bytes", value);
  if (budget == "nonfinite") return fmt::format("{:.0f}", value);
  return number(3);
}

std::string place_text(const BudgetCheck& b) {
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  for (const auto& [name, value] : b.at)
    add(name == "theta" ? fmt::format("{:.3g}° of incidence", value)
                        : fmt::format("{} {:.4g}", name == "mu" ? "cosine" : name, value));
  if (!b.substance.empty()) add(b.substance);
  return text;
}

std::string value_text(const UsedParameter& p) {
  const bool grey =
      !p.values.empty() && std::ranges::count(p.values, p.values[0]) == std::ssize(p.values);
  const auto numbers =
      grey ? fmt::format("{:.4g}", p.values[0]) : fmt::format("{:.4g}", fmt::join(p.values, ", "));
  switch (p.from) {
    case UsedParameter::From::choice:
      return numbers;
    case UsedParameter::From::domain:
      return numbers.empty() ? "from the domain" : numbers + ", from the domain";
    default:
      return numbers + ", default";
  }
}

std::string sentence(const BudgetCheck& b) {
  const auto place = place_text(b);
  if (!std::isfinite(b.found))
    return fmt::format("The model has no value{}, so it keeps no budget there.",
                       place.empty() ? "" : " at " + place);
  return fmt::format(
      "{}{}; the budget is {}.{}",
      fmt::format(fmt::runtime(words_of(b.budget).found), value_text(b.budget, b.found)),
      place.empty() ? "" : " at " + place, value_text(b.budget, b.limit),
      b.words.empty() ? "" : " " + b.words + ".");
}

}  // namespace gonio
