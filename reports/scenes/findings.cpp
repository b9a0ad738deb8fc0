// The scenes in sentences: made from their rows alone.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "reports/finding/names.h"
#include "reports/finding/words.h"
#include "reports/scenes/scenes.h"
#include "scene/plan/cost.h"

#include <fmt/format.h>

namespace gonio {
namespace {

constexpr std::string_view no_difference = "no visible difference";

/// "2.1", "12": two digits.
std::string times_text(double ratio) {
  return fmt::format("{:.{}f}", ratio, ratio < 9.95 ? 1 : 0);
}
std::string delta_text(double error) {
  return fmt::format("{:.{}f}", error, error < 9.95 ? error < 0.095 ? 2 : 1 : 0);
}
/// Part of the time of all that the material has: what it has not, no shader would compute.
double saved(const SceneRow& r) {
  return 1 - r.ns_float / r.ns_present_float;
}
/// Material as it stands in a sentence.
std::string material_text(const std::string& material) {
  return material == "everything needed" ? "the material that needs everything" : material;
}
std::string scene_text(const SceneRow& r) {
  return fmt::format("{} under {}", material_text(r.material), r.light);
}

/// Scenes, those of a material together: "chalk under rim light, and under sky and sun".
std::string scenes_text(const std::vector<const SceneRow*>& rows) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < rows.size();) {
    std::vector<std::string> lights;
    const auto& material = rows[i]->material;
    for (; i < rows.size() && rows[i]->material == material; ++i)
      lights.push_back("under " + rows[i]->light);
    parts.push_back(fmt::format("{} {}", material_text(material), list_text(lights)));
  }
  return list_text(parts);
}

/// Time that plans save, and where they save nothing.
void savings(Findings& to, const ScenesRows& r) {
  std::vector<const SceneRow*> none, slower;
  std::vector<SceneRow> held;  // a plan that does not hold saves what is seen
  std::ranges::copy_if(r.rows, std::back_inserter(held), &SceneRow::holds);
  if (held.empty()) return;
  for (const auto& row : held) {
    if (scene::is_as_fast(row.speedup_float))
      none.push_back(&row);
    else if (row.speedup_float < 1)
      slower.push_back(&row);
  }
  const auto& most = *std::ranges::max_element(held, {}, saved);
  const auto up_to = percent(saved(most), 2);
  const auto faster = held.size() - none.size() - slower.size();
  auto sentence = fmt::format(
      "At {}, plans are faster than all effects of the material in {} scenes whose plans hold.",
      no_difference, of_all(faster, held.size()));
  if (faster > 0)
    sentence += fmt::format(" The most is saved for {}: {} of a float shader's time.",
                            scene_text(most), up_to);
  to.say(std::move(sentence));
  if (!none.empty())
    to.say(fmt::format("The plan is about as fast as all effects for {}.", scenes_text(none)));
  const auto slowest_of = [](const std::vector<const SceneRow*>& rows) {
    const auto* const row = *std::ranges::min_element(rows, {}, &SceneRow::speedup_float);
    return rounded_up(1 / row->speedup_float, 3);
  };
  for (const bool by_table : {true, false}) {
    std::vector<const SceneRow*> these;
    std::ranges::copy_if(slower, std::back_inserter(these),
                         [&](const SceneRow* row) { return row->needs_table == by_table; });
    if (these.empty()) continue;
    to.say(
        fmt::format("The plan is slower than all effects of the material for {}: it takes {}{} "
                    "times as long.",
                    scenes_text(these), these.size() == 1 ? "" : "up to ", slowest_of(these)));
    to.say(fmt::format("No {} keeps the tolerance there with a plan's margin.",
                       by_table ? "set of forms without the tabulated light between facets"
                                : "set of forms as fast as all effects"));
  }
  to.headline = faster == 0 ? "Leaving out effects that nobody sees saves no time in these scenes."
                            : fmt::format(
                                  "In {} scenes, leaving out effects that nobody sees saves time, "
                                  "up to {}.",
                                  of_all(faster, r.rows.size()), up_to);
  if (held.size() < r.rows.size())
    to.headline += fmt::format(" In {}, the plan fails its check.", r.rows.size() - held.size());
  to.say(fmt::format(
      "{} means that ΔE2000 to the reference, in double, is at most {:g} at {} of the "
      "points; half of them are drawn near highlights.",
      capital(std::string(no_difference)), r.tolerance.limit, percent_given(r.tolerance.quantile)));
}

/// Part of float in the speed, apart from what plans drop.
void precision(Findings& to, const ScenesRows& r) {
  std::vector<double> ratios;
  double most = 0;
  for (const auto& row : r.rows) ratios.push_back(row.ns_exact / row.ns_exact_float);
  for (const auto& e : r.effects)
    if (e.effect == "precision") most = std::max(most, e.error_if_dropped);
  std::ranges::sort(ratios);
  to.say(
      fmt::format("Float, which shaders ship anyway, is not counted there: it is {} times as fast "
                  "as double, and changes ΔE2000 by less than {}.",
                  times_text(ratios[ratios.size() / 2]),
                  most < 0.01 ? std::string("0.01") : fmt::format("{:.1g}", most)));
}

/// Effects that one light needs and another does not, where that is clearest.
void lights(Findings& to, const ScenesRows& r) {
  const SceneEffectRow *kept = nullptr, *dropped = nullptr;
  double contrast = 0;
  for (const auto& a : r.effects)
    for (const auto& b : r.effects) {
      if (a.material != b.material || a.effect != b.effect || !a.keep || b.keep ||
          b.why != "measured")
        continue;
      const double c = a.error_if_dropped - b.error_if_dropped;
      if (c > contrast) {
        contrast = c;
        kept = &a;
        dropped = &b;
      }
    }
  if (!kept) return;
  to.say(fmt::format(
      "The light decides: {} needs {} under {}, where dropping it costs ΔE2000 {}; under {} that "
      "costs "
      "{}, and it is dropped.",
      kept->material, kept->name, kept->light, delta_text(kept->error_if_dropped), dropped->light,
      delta_text(dropped->error_if_dropped)));
  const auto row = [&](const SceneEffectRow& e) {
    return std::ranges::find_if(
        r.rows, [&](const SceneRow& x) { return x.material == e.material && x.light == e.light; });
  };
  const auto slow = row(*kept), fast = row(*dropped);
  if (slow != r.rows.end() && fast != r.rows.end() && fast->speedup_float > slow->speedup_float)
    to.say(fmt::format(
        "So {} is {} times as fast as with all that it has under {}, and {} times under {}.",
        kept->material, times_text(fast->speedup_float), fast->light,
        times_text(slow->speedup_float), slow->light));
}

/// How many scenes keep what shaders often leave out.
void counts(Findings& to, const ScenesRows& r) {
  struct Asked {
    std::string_view effect, name;
    std::size_t kept = 0;
  };
  std::array asked{Asked{"fresnel", "better than Schlick's Fresnel"},
                   Asked{"compensation", "multiple scattering"},
                   Asked{"masking", "Smith's masking"},
                   Asked{"coupling", "diffuse coupled to Fresnel"}};
  for (const auto& e : r.effects)
    if (const auto at = std::ranges::find(asked, e.effect, &Asked::effect); at != asked.end())
      at->kept += e.keep;
  std::ranges::stable_sort(asked, std::ranges::greater{}, &Asked::kept);
  for (std::size_t i = 0; i < asked.size(); i += 2)
    to.say(capital(fmt::format("{} is kept in {} scenes, and {} in {}.", asked[i].name,
                               of_all(asked[i].kept, r.rows.size()), asked[i + 1].name,
                               number_or_none(asked[i + 1].kept))));
}

/// Change by three wavelengths in place of a metal's spectrum.
void metals(Findings& to, const ScenesRows& r) {
  std::vector<const SceneEffectRow*> rows;
  for (const auto& e : r.effects)
    if (e.effect == "spectrum" && e.why == "measured") rows.push_back(&e);
  if (rows.empty()) return;
  const auto [least, most] =
      std::ranges::minmax_element(rows, {}, &SceneEffectRow::error_if_dropped);
  to.say(
      fmt::format("Fresnel's equations at three wavelengths in place of a metal's spectrum change "
                  "{} by ΔE2000 {} under {}{}.",
                  (*most)->material, delta_text((*most)->error_if_dropped), (*most)->light,
                  (*least)->material == (*most)->material
                      ? std::string()
                      : fmt::format(", and {} by {}", (*least)->material,
                                    delta_text((*least)->error_if_dropped))));
}

void verified(Findings& to, const ScenesRows& r) {
  std::vector<const SceneRow*> broken;
  for (const auto& row : r.rows)
    if (!row.holds) broken.push_back(&row);
  const auto worst = std::ranges::max_element(r.rows, {}, &SceneRow::upper_bound);
  if (broken.empty())
    to.say(
        fmt::format("On fresh points {} hold: the share of points beyond the limit is at most {}, "
                    "with a confidence of {}.",
                    r.rows.size() == 1 ? "the plan is seen to" : "all plans",
                    percent_at_most(worst->upper_bound), percent_given(r.tolerance.confidence)));
  else
    to.say(fmt::format("On fresh points {} plans do not hold: {}.",
                       of_all(broken.size(), r.rows.size()), scenes_text(broken)));
  if (broken.empty()) return;
  const auto unknown = std::ranges::max(broken, {}, &SceneRow::reference_error)->reference_error;
  if (unknown > 0.5 * r.tolerance.limit)
    to.say(
        fmt::format("The reference itself is known to ΔE2000 {} there, which counts in what "
                    "a plan differs by.",
                    rounded_up(unknown)));
}

/// Materials of an asset that were not planned.
void left_out(Findings& to, const ScenesRows& r) {
  if (r.left_out.empty()) return;
  to.say(
      fmt::format("In the asset, {} with textures, or otherwise no single surface, {} left out; "
                  "the page names {} at its end.",
                  r.left_out.size() == 1 ? std::string("one material")
                                         : fmt::format("{} materials", r.left_out.size()),
                  r.left_out.size() == 1 ? "is" : "are", r.left_out.size() == 1 ? "it" : "them"));
}

/// Angles of light at which an effect is seen at its material's own roughness.
void switches(Findings& to, const ScenesRows& r) {
  for (const auto& m : r.maps) {
    if (m.light_deg.empty() || m.roughness.empty()) continue;
    const auto near = std::ranges::min_element(
        m.roughness, {}, [&](double x) { return std::abs(x - m.own_roughness); });
    const auto j = static_cast<std::size_t>(near - m.roughness.begin());
    std::vector<std::size_t> seen;
    for (std::size_t i = 0; i < m.light_deg.size(); ++i)
      if (m.error[i * m.roughness.size() + j] > r.tolerance.limit) seen.push_back(i);
    std::string where = "under no single light";
    if (!seen.empty()) {
      const double first = m.light_deg[seen.front()], last = m.light_deg[seen.back()];
      where = seen.front() == 0 && first != last
                  ? fmt::format("with a light up to {:g}° from the viewer", last)
              : first == last
                  ? fmt::format("with a light about {:g}° from the viewer", first)
                  : fmt::format("with a light {:g}° to {:g}° from the viewer", first, last);
    }
    // What the map drops is Smith's masking, to Schlick's form of it.
    const auto needed = m.effect == "masking" ? std::string("Smith's masking") : m.name;
    to.say(fmt::format("{} of roughness {:.2g} needs {} {}.", capital(m.material), *near, needed,
                       where));
  }
}

}  // namespace

Findings findings(const ScenesRows& r) {
  Findings f;
  if (r.rows.empty()) return f;
  savings(f, r);
  lights(f, r);
  precision(f, r);
  metals(f, r);
  verified(f, r);
  left_out(f, r);
  counts(f, r);
  switches(f, r);
  return f;
}

}  // namespace gonio
