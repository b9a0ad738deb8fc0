// The page of the report on scenes: which effects a material needs under a light, and what leaving
// out the others saves.
#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "reports/finding/names.h"
#include "reports/finding/words.h"
#include "reports/page/numbers.h"
#include "reports/page/section.h"
#include "reports/page/spheres.h"
#include "reports/scenes/measure.h"
#include "reports/scenes/scenes.h"

#include <fmt/format.h>

namespace gonio::page {
namespace {

using page::Group;
using page::Table;

std::string delta(double x) {
  return x < 0.005 ? "0" : significant(x, 2);
}
using scenes::speed;
const SceneRow* found(const ScenesRows& all, std::string_view material, std::string_view light) {
  const auto at = std::ranges::find_if(
      all.rows, [&](const auto& r) { return r.material == material && r.light == light; });
  return at == all.rows.end() ? nullptr : &*at;
}

Section plans(const ScenesRows& all) {
  Table t{columns(""), {}, "told-by-cell"};
  const auto lights = unique(all.rows, &SceneRow::light);
  for (const auto& l : lights) t.head.push_back({capital(l)});
  for (const auto& m : unique(all.rows, &SceneRow::material)) {
    auto& row = t.rows.emplace_back(std::vector{Cell{capital(m)}});
    for (const auto& l : lights) {
      const auto* r = found(all, m, l);
      row.push_back(r ? Cell{speed(r->speedup_float),
                             {},
                             fmt::format("{}{} against double. {}",
                                         r->holds ? "" : "Not shown to hold on fresh points. ",
                                         speed(r->speedup),
                                         r->kept.empty() ? "Keeps nothing" : "Keeps " + r->kept),
                             "big"}
                      : Cell{"–"});
    }
  }
  return {
      "What to keep, and what that does to the time",
      fmt::format(
          "The large number compares the plan with all that the material has, both in float, as "
          "shaders ship it: with Kulla and Conty's lobe between facets. The small one compares it "
          "with everything on in double. A plan is slower where nothing as fast as that lobe "
          "keeps the tolerance with a plan's margin. Effects that are not kept have their cheapest "
          "form. "
          "A plan that holds differs by ΔE2000 {} or less at {} of the points, and by {} at "
          "most.{}",
          plain(all.tolerance.limit), percent_given(all.tolerance.quantile),
          plain(all.tolerance.max),
          std::ranges::all_of(all.rows, &SceneRow::holds)
              ? ""
              : " Where none is shown to hold, the nearest stands here, and says so."),
      {t},
      "plans"};
}

// --- Pictures
std::string triple(const ScenePicture& p, const scene::Tolerance& t) {
  const auto of = [&](const char* how) {
    return fmt::format("{} under {}, {}", p.material, p.light, how);
  };
  return sphere_figure(
      fmt::format("{}, ΔE of a pixel up to {}", capital(p.light), rounded_up(p.worst)), p.pixels,
      {{p.everything, of("everything on")},
       {p.planned, of("as planned")},
       {difference_png(p.difference, p.pixels, scenes::difference_scale(t)), of("difference")}});
}
Section spheres(const ScenesRows& all) {
  const auto& t = all.tolerance;
  std::string html = sphere_keys(scenes::difference_scale(t));
  for (const auto& m : unique(all.rows, &SceneRow::material)) {
    html += fmt::format(R"(<div class="spheres"><h3>{}</h3>)", markup_text(capital(m)));
    for (const auto& p : all.pictures)
      if (p.material == m) html += triple(p, t);
    html += "</div>\n";
  }
  return {"All effects, as planned, and the difference",
          "The pictures leave the reference's own error out, which counts in what a plan claims.",
          {Markup{html}}};
}

// --- Where the time goes
Section shares(const ScenesRows& all) {
  if (all.rows.empty()) return {};
  struct PartOfTime {
    const char *colour, *text;
    double (*of)(const SceneRow&);
  };
  const PartOfTime parts[]{{"accent", "stays", [](const SceneRow& r) { return r.ns_float; }},
                           {"rms-1", "nobody sees it under this light",
                            [](const SceneRow& r) { return r.ns_present_float - r.ns_float; }},
                           {"rule", "the material does not have it", [](const SceneRow& r) {
                              return r.ns_exact_float - r.ns_present_float;
                            }}};
  std::string html = R"(<p class="small keys">)";
  for (const auto& p : parts)
    html +=
        fmt::format(R"x(<span><span class="step" style="background:var(--{})"></span>{}</span>)x",
                    p.colour, p.text);
  html += R"(</p><div class="shares">)";
  std::vector<double> of_double;
  double least = all.rows[0].speedup, most = least;
  for (std::size_t i = 0; i < all.rows.size(); ++i) {
    const auto& r = all.rows[i];
    of_double.push_back(r.ns_exact / r.ns_exact_float);
    least = std::min(least, r.speedup), most = std::max(most, r.speedup);
    html += fmt::format(R"(<div{}><span>{}, {}</span><span class="of">)",
                        i && r.material != all.rows[i - 1].material ? R"( class="first")" : "",
                        markup_text(capital(r.material)), markup_text(r.light));
    for (const auto& p : parts)
      html +=
          fmt::format(R"x(<span title="{}" style="background:var(--{});width:{:.4g}%"></span>)x",
                      p.text, p.colour, 100 * std::clamp(p.of(r) / r.ns_exact_float, 0.0, 1.0));
    html += fmt::format(R"(</span><span class="small muted">{} → {} ns</span></div>)",
                        significant(r.ns_exact_float, 2), significant(r.ns_float, 2));
  }
  std::ranges::sort(of_double);
  return {"Where the saving comes from",
          fmt::format("Time of one direction of light in float, as parts of that of everything on. "
                      "Double takes {} that time; against it the plans are {} to {}.",
                      times(of_double[of_double.size() / 2]), speed(least), speed(most)),
          {Markup{html + "</div>"}}};
}

// --- One material
Section one_material(const ScenesReport& report) {
  const auto& all = report.rows;
  Choice c;
  c.controls = {{"material", "Material", "red plastic", true}, {"light", "Light"}};
  Slot tables{{}, false};
  for (const auto& r : all.rows) {
    std::vector<SceneEffectRow> list;
    for (const auto& e : all.effects)
      if (e.material == r.material && e.light == r.light) list.push_back(e);
    std::ranges::stable_sort(list, {}, [](const auto& e) {
      return e.keep ? 0 : e.why == "structural" ? 2 : 1;
    });
    Table t{columns("effect|here|>ΔE2000 if dropped|>ns saved|>operations saved|why"),
            {},
            "told-by-cell"};
    for (const auto& e : list) {
      const bool absent = e.why == "structural";
      t.add(capital(e.name),
            e.keep   ? Cell{e.keeps == e.name ? "keep" : "keep " + e.keeps, {}, {}, "verdict-yes"}
            : absent ? Cell{"absent", {}, {}, "muted"}
                     : Cell{"drop"},
            absent              ? "0"
            : e.why == "proved" ? at_most(e.error_if_dropped)
                                : delta(e.error_if_dropped),
            significant(e.ns_saved, 2),
            count_text(static_cast<std::size_t>(std::max(0.0, std::round(e.ops_saved)))),
            Cell{absent              ? e.reason
                 : e.why == "proved" ? "by proof"
                                     : "measured",
                 {},
                 {},
                 "muted"});
    }
    tables.each.push_back(
        {{r.material, r.light},
         {std::move(t),
          Prose{fmt::format("On {} fresh points {} exceed ΔE2000 {}. With a confidence of {} that "
                            "is less than {} of all. The plan is `{}`.",
                            count_text(r.samples), many(r.exceeding, "point"),
                            plain(all.tolerance.limit), percent_given(all.tolerance.confidence),
                            percent_at_most(r.upper_bound), r.spec),
                "small verification"}}});
  }
  c.slots = {std::move(tables), slot_of(report.pictures, "front", c.controls, 320)};
  c.slots[1].on_paper = false;
  c.look = "";
  return {"One material: keep, drop, and why",
          "Each effect dropped by itself, all others exact and in double. Errors do not add, so "
          "the plan's set is measured as a whole.",
          {c},
          "effects"};
}

Section switches(const ScenesReport& r) {
  page::Group all{"panels", {}};
  for (const auto& m : r.pictures.maps)
    if (m.family == "switches_on") all.parts.emplace_back(Shown{m.family, m.choices});
  if (all.parts.empty()) return {};
  return {
      "Where an effect switches on",
      fmt::format("One light, from beside the viewer (0°) round to the back, and every roughness. "
                  "The line is ΔE2000 {} at {} of the points: beyond it the effect is seen.",
                  plain(r.rows.tolerance.limit), percent_given(r.rows.tolerance.quantile)),
      {all},
      "switches"};
}

}  // namespace
}  // namespace gonio::page

namespace gonio {

page::Page report_page(const ScenesReport& r) {
  using namespace page;
  const auto& all = r.rows;
  Page out{"scenes", "report scenes", "Only what the scene needs", "Only what the scene needs",
           r.findings.sentences};
  out.full = r.full;
  const auto materials = unique(all.rows, &SceneRow::material);
  if (!materials.empty()) {  // the material whose needs change with the light
    const auto told = std::ranges::find(materials, "red plastic") == materials.end()
                          ? materials[0]
                          : "red plastic";
    std::string html;
    std::size_t n = 0;
    for (const auto& p : all.pictures)
      if (p.material == told && n++ < 2) html += triple(p, all.tolerance);
    if (n > 0)
      out.first = {Markup{fmt::format(
          R"(<div class="spheres picture"><h3>{}: everything on, as planned, and the difference</h3>{}</div>)",
          markup_text(capital(told)), html)}};
  }
  out.sections = {
      plans(all),
      spheres(all),
      shares(all),
      one_material(r),
      switches(r),
      {"How it is measured",
       "",
       {Points{
           {"Front light: three lights on the viewer's side. Rim light: one of these, and two "
            "from behind the sphere. Sky and sun: an even sky over a darker ground, and a "
            "small bright sun.",
            "The points are drawn evenly over the picture of a sphere. For every second one, "
            "four are drawn and the nearest to a highlight is likely to be taken.",
            "Everything on is one surface with each effect in its exact form, in double, "
            "whether the material has it or not, as in a shader for all materials. Light "
            "between facets is Kulla and Conty's lobe there, which shaders ship.",
            "Plans are compared with random walks between facets, tabulated. Each point's "
            "difference has what the table may be off by added. Rows of one effect leave it out.",
            "Times are of column kernels, composed on both sides: nothing is fused for the "
            "plan only. Those of a scene's row and of its list of sets were measured one after the "
            "other, and on a busy machine one may be twice the other.",
            "A plan need not be in its list: times within twice their spreads count as the same, "
            "and among such sets the plan takes the fewest operations.",
            fmt::format("A plan is chosen on one set of points, checked on a second, and "
                        "verified here on a third of {}.",
                        count_text(all.rows.empty() ? 0 : all.rows[0].samples))}}}}};
  if (!all.left_out.empty()) {
    Pairs list;
    for (const auto& m : all.left_out) list.each.emplace_back(m.material, m.why);
    out.sections.push_back({"Left out of the asset", "", {list}});
  }
  return out;
}

}  // namespace gonio
