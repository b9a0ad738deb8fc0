#include "reports/scenes/plan_page.h"

#include <algorithm>
#include <cmath>

#include "reports/page/numbers.h"
#include "reports/page/render.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio::page {
namespace {

using page::Table;
using scene::Effect;

std::string spaced(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}
std::string words_of(Effect e) {
  const auto name = name_of(e);
  if (name == "fresnel") return "Fresnel";
  if (name == "compensation") return "multiple scattering";
  if (name == "coupling") return "coupling of the diffuse";
  if (name == "spectrum") return "spectrum of the metal";
  if (name == "environment") return "integral over the environment";
  if (name == "precision") return "double precision";
  return spaced(std::string(name));
}
std::string form_words(std::string_view form) {
  return form == "on" || form == "off" ? "" : fmt::format(" ({})", spaced(std::string(form)));
}
template <class Is>
std::string names(const scene::MaterialPlan& m, Is is) {
  std::vector<std::string> out;
  for (const auto& e : m.effects)
    if (is(e)) out.push_back(words_of(e.effect) + (e.keep ? form_words(e.form) : ""));
  return out.empty() ? "nothing" : fmt::format("{}", fmt::join(out, ", "));
}
std::string rounded(double n) {
  return count_text(static_cast<std::size_t>(std::max(0.0, std::round(n))));
}

std::string kept_words(const scene::Forms& forms) {
  std::vector<std::string> out;
  for (std::size_t k = 0; k < scene::effect_count; ++k)
    if (const auto e = static_cast<Effect>(k); forms.keeps(e))
      out.push_back(words_of(e) + form_words(forms.name(e)));
  return out.empty() ? "nothing" : fmt::format("{}", fmt::join(out, ", "));
}

std::vector<std::string> verdict(const scene::Plan& p, std::string_view unit) {
  std::vector<std::string> out;
  std::vector<const scene::MaterialPlan*> shippable;
  for (const auto& m : p.materials)
    if (!m.needs_table()) shippable.push_back(&m);
  std::ranges::sort(shippable, {}, &scene::MaterialPlan::speedup);
  if (shippable.size() == 1)
    out.push_back(fmt::format("Dropping what this scene does not need makes {} {} as fast.",
                              shippable[0]->name, times(shippable[0]->speedup)));
  else if (!shippable.empty())
    out.push_back(fmt::format(
        "Dropping what this scene does not need makes {} {} as fast, and {}, which needs the most, "
        "{}.",
        shippable.back()->name, times(shippable.back()->speedup), shippable[0]->name,
        times(shippable[0]->speedup)));
  for (const auto& m : p.materials)
    if (m.needs_table())
      out.push_back(fmt::format(
          "No shader has the light between facets that {} needs here: what shaders have "
          "differs by {}{} at best.",
          m.name, unit, significant(m.shipped_upper, 2)));
  if (!p.holds)
    out.push_back(
        "Some material keeps the tolerance in no form that is offered: its plan is the nearest.");
  else
    out.push_back(fmt::format(
        "At {} of the points the plan differs by at most {}{}, and nowhere by more than {}.",
        percent(p.tolerance.quantile), unit, plain(p.tolerance.limit), plain(p.tolerance.max)));
  if (p.budget)
    out.push_back(p.budget->fits
                      ? fmt::format("A visible point takes {} ns of the {} ns that the scene "
                                    "allows; the worst material errs by at most {}{}.",
                                    significant(p.budget->ns), plain(p.budget->budget_ns), unit,
                                    significant(p.budget->error, 2))
                      : fmt::format("Even the cheapest forms take {} ns a point, more than the {} "
                                    "ns that the scene allows.",
                                    significant(p.budget->ns), plain(p.budget->budget_ns)));
  return out;
}

Section one(const scene::MaterialPlan& m, const scene::Plan& p, const std::string& unit_name) {
  Table t{{{"effect"},
           {"here"},
           {unit_name + " if dropped by itself", true},
           {"ns saved", true},
           {"operations saved", true},
           {"why"}},
          {},
          "told-by-cell"};
  auto effects = m.effects;
  std::ranges::stable_sort(effects, {}, [](const auto& e) {
    return e.keep ? 0 : e.why == scene::Why::structural ? 2 : 1;
  });
  for (const auto& e : effects) {
    const bool absent = e.why == scene::Why::structural, proved = e.why == scene::Why::proved;
    t.add(capital(words_of(e.effect)),
          e.keep   ? Cell{"keep" + form_words(e.form), {}, {}, "verdict-yes"}
          : absent ? Cell{"absent", {}, {}, "muted"}
                   : Cell{"drop"},
          absent ? "0" : (proved ? "≤ " : "") + significant(e.error_if_dropped, 2),
          absent && e.ops_saved == 0 ? "0" : significant(e.ns_saved, 2), rounded(e.ops_saved),
          Cell{absent   ? e.reason
               : proved ? "by proof"
                        : "measured",
               {},
               {},
               "muted"});
  }
  const auto& c = m.checked;
  Section s{m.name, "", {t}};
  if (!m.holds)
    s.parts.emplace_back(
        Prose{"No set of forms keeps the tolerance here. This one is the nearest."});
  const std::string failed =
      m.passed_over ? fmt::format(" {} failed there.", many(m.passed_over, "cheaper set")) : "";
  s.parts.emplace_back(Prose{
      m.bounded
          ? fmt::format("Checked on {} fresh points: less than {} of all exceed the limit, with a "
                        "confidence of {}. The error of the reference is in it.{}",
                        count_text(c.samples), percent(c.bound), percent(p.tolerance.confidence),
                        failed)
          : fmt::format("Checked on {} fresh points beside {}. No walk is known of this lobe, so "
                        "nothing is claimed beyond these points.{}",
                        count_text(c.samples), scene::reference_in_words(m.reference), failed),
      "small"});
  s.parts.emplace_back(Prose{fmt::format("The model: `{}`", m.spec), "small"});
  if (m.front.size() > 1) {
    Table front{{{"keeps"},
                 {"ns", true},
                 {"operations", true},
                 {fmt::format("{} at {}", unit_name, percent(p.tolerance.quantile)), true},
                 {"worst", true}},
                {}};
    for (const auto& f : m.front)
      front.add(kept_words(f.forms), significant(f.ns), rounded(f.ops),
                significant(f.error.quantile, 2), significant(f.error.worst, 2));
    s.parts.emplace_back(
        Subtitle{fmt::format("{} sets of which none is faster and errs less", m.front.size())});
    s.parts.emplace_back(front);
  }
  return s;
}

}  // namespace
}  // namespace gonio::page

namespace gonio {

std::string plan_page_html(const scene::Plan& p) {
  using namespace page;
  const bool relative = p.tolerance.metric == scene::Metric::relative;
  const std::string unit = relative ? "" : "ΔE2000 ", unit_name = relative ? "change" : "ΔE2000";
  Page out{"", "plan", "Plan of a scene", "Only what the scene needs", verdict(p, unit)};
  Table t{{{"material"},
           {"as fast", true},
           {"operations", true},
           {"keep"},
           {"drop"},
           {fmt::format("{} at {}", unit_name, page::percent(p.tolerance.quantile)), true},
           {"worst", true}},
          {},
          "told-by-cell"};
  for (const auto& m : p.materials)
    t.add(m.name, times(m.speedup), signed_percent(0 - m.ops_saved),
          names(m, [](const auto& e) { return e.keep; }),
          names(m, [](const auto& e) { return !e.keep && e.why != scene::Why::structural; }),
          m.bounded ? "≤ " + significant(m.checked.upper, 2) : significant(m.checked.quantile, 2),
          significant(m.checked.worst, 2));
  out.sections = {
      {"What to keep, and how much faster that is",
       "Times of the effects that a material has, in float, with Kulla and Conty's "
       "compensation, over the plan's; both of composed column kernels on this machine. "
       "Operations count no look-ups.",
       {t}}};
  for (const auto& m : p.materials) out.sections.push_back(one(m, p, unit_name));
  out.setting =
      "Points are what viewers see, half of them near highlights. Every figure of this page is in "
      "the plan beside it.";
  return page_html(out, {});
}

}  // namespace gonio
