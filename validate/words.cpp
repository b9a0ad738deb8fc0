#include "validate/words.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

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
    Words{"energy_gain", "Energy gained",
          "More light leaves than comes in: the part above 1 is {}"},
    Words{"energy_loss", "Energy lost at F = 1", "White lobes lose {} of the light"},
    Words{"reciprocity", "Change of f where light and view change places",
          "f changes by {} where light and view change places"},
    Words{"nonfinite", "Inputs without a value", "Inputs without a value: {}"},
    Words{"operations", "Operations of a sample", "A sample takes {}"},
    Words{"ns", "Time against the baseline", "A sample takes {}"},
    Words{"table_bytes", "Bytes of tables", "Tables take {}"}};

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
                        : fmt::format("{} {:.4g}", name, value));
  if (!b.substance.empty()) add(b.substance);
  return text;
}

std::string sentence(const BudgetCheck& b) {
  const auto place = place_text(b);
  return fmt::format(
      "{}{}; the budget is {}.{}",
      fmt::format(fmt::runtime(words_of(b.budget).found), value_text(b.budget, b.found)),
      place.empty() ? "" : " at " + place, value_text(b.budget, b.limit),
      b.words.empty() ? "" : " " + b.words + ".");
}

}  // namespace gonio
