#include "table/health/light.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "base/few.h"
#include "base/quantile.h"
#include "base/text.h"
#include "table/format/columns_command.h"
#include "table/format/measured_by.h"

#include <fmt/format.h>

namespace gonio {
namespace {

using std::numbers::pi;
constexpr double too_much = 1.05;  ///< light that goes out, over what comes in

std::string scaled_by(const Table& t, const char* what, double scale) {
  return fmt::format(": {}? ({})", what,
                     reading_command(t, [&](ColumnMap& map) { map.scale *= scale; }));
}
/// What values may be that return so many times the light.
std::string unit_of(const Table& t, double light) {
  constexpr double slack = 1.1;
  if (const auto note =
          std::ranges::find(t.notes, "reference", [](const auto& n) { return n.first; });
      note != t.notes.end()) {  // values × R/π
    const double reflectance = only_number(note->second).value_or(1);
    return light < slack * 100
               ? fmt::format(": in percent of the target? (gonio fit {} --reference {:.4g})",
                             file_word(t), reflectance / 100)
               : "";
  }
  if (light < slack * pi) return scaled_by(t, "a radiance factor", 1 / pi);
  if (light < slack * 100 * pi) return scaled_by(t, "a radiance factor in percent", 0.01 / pi);
  return fmt::format(": counts? (gonio fit {} --scale free, or a white standard by --reference)",
                     file_word(t));
}

/// Least value of each incident direction whose samples all are above 1/π, as a share of the light: no
/// proof, since the samples may lie in one plane.  Of directions that are all apart, those of 10° of θ_i are
/// taken together.  Values of the highlight are left out.
std::optional<std::pair<double, double>> bright_everywhere(const Table& t) {
  const DirectionList* l = t.list();
  if (!l) return {};
  constexpr std::size_t few = 8, large = 100'000;
  if (t.size() > large) return {};
  const SampleAngles at(t);
  const auto values_by = [&](auto&& direction_of) {
    constexpr double highlight = 20 * degree;  // which says nothing of what is around it
    std::map<std::pair<double, double>, std::vector<double>> by;
    for (std::size_t i = 0; i < t.size(); ++i) {
      if (at.half_difference(i).theta_h < highlight) continue;
      for (const auto& plane : t.values)
        if (mask(at(i), plane[i]) == Mask::valid) by[direction_of(i)].push_back(plane[i]);
    }
    return by;
  };
  auto of = values_by([&](std::size_t i) { return std::pair{l->theta_i_deg[i], l->phi_i_deg[i]}; });
  if (std::ranges::all_of(of, [](const auto& d) { return d.second.size() < few; })) {
    constexpr double band = 10;
    of = values_by([&](std::size_t i) {
      return std::pair{band * (std::floor(l->theta_i_deg[i] / band) + 0.5), 0.0};
    });
  }
  std::optional<std::pair<double, double>> most;  // light, θ_i
  for (auto& [direction, values] : of) {
    if (values.size() < few) continue;
    const double light = pi * quantile(values, 0.05);
    if (light > too_much && (!most || light > most->first)) most = {light, direction.first};
  }
  return most;
}

}  // namespace

std::string without_channel(const Table& t, std::size_t channel) {
  if (t.channels.size() > 2 * most_listed) return "";
  std::string others;
  for (std::size_t c = 0; c < t.channels.size(); ++c)
    if (c != channel) others += " " + shell_word(t.channels[c]);
  return fmt::format(" (gonio fit {} --channels{} leaves it out)", file_word(t), others);
}

std::vector<LightWarning> warnings_of_light(TableFacts& facts, bool divided) {
  const Table& t = facts.table();
  const auto unit = [&](double light) { return divided ? "" : unit_of(t, light); };
  constexpr double rounding = 1e-9;
  double most = 0, at = 0, whole = 0, shown = 0;
  std::size_t brightest = 0;
  std::vector<double> of_channel(t.channels.size());
  const auto look_at = [&](const AlbedoSample& a) {
    for (std::size_t c = 0; c < a.albedo.size(); ++c) {
      const double v = a.albedo[c];
      if (std::isnan(v)) continue;
      whole = std::max(whole, v);
      of_channel[c] = std::max(of_channel[c], v);
      const double sure = (v - a.error) * a.coverage;
      if (sure > most * (1 + rounding)) most = sure, at = a.theta_i_deg, shown = v, brightest = c;
    }
  };
  std::ranges::for_each(facts.albedo().known, look_at);
  std::ranges::for_each(facts.albedo().at_least, look_at);
  double others = 0;
  for (std::size_t c = 0; c < of_channel.size(); ++c)
    if (c != brightest) others = std::max(others, of_channel[c]);
  constexpr double of_its_own = 30;  // times as bright as all others: no colour
  if (most > too_much && others > 0 && others < 1 && shown > of_its_own * others) {
    return {
        {fmt::format("channel {} returns {:.3g} times the light at theta_i {:.3g}°, the others at "
                     "most {:.2g}: a scale of its own?{}",
                     t.channels[brightest], shown, at, others, without_channel(t, brightest)),
         ""}};
  }
  if (most > too_much)
    return {{fmt::format("the table returns {:.3g} times the light at theta_i {:.3g}°", shown, at),
             unit(shown)}};
  std::vector<LightWarning> all;
  constexpr double next_to_nothing = 5e-4;
  if (whole > 0 && whole < next_to_nothing)
    all.push_back({fmt::format("the table returns {:.2g} of the light", whole),
                   fmt::format(": a relative scale? (gonio fit {} --scale free fits that, too)",
                               file_word(t))});
  if (const auto bright = bright_everywhere(t))
    all.push_back(
        {fmt::format(
             "values at theta_i {:.3g}° are above 1/pi: probably {:.3g} times the light or more",
             bright->second, bright->first),
         unit(bright->first)});
  return all;
}

}  // namespace gonio
