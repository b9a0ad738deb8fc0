#include "reports/pages/spheres_section.h"

#include <algorithm>
#include <cmath>

#include "base/rounded.h"
#include "base/text.h"
#include "image/colour_difference.h"
#include "reports/finding/names.h"
#include "reports/page/numbers.h"
#include "reports/page/spheres.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio::page {
namespace {

using Lights = std::vector<const SpheresUnderLight*>;
constexpr double told_apart = 3;

DifferenceScale scale_of(const Lights& shown) {
  return {ModelSphere::difference_steps, just_seen, 10,
          std::ranges::any_of(shown, [](const auto* l) { return l->covered < 1; })};
}
/// The light under which a model is farthest from the table.
const SpheresUnderLight& worst(const Lights& shown, std::size_t m, double ModelSphere::*of) {
  return **std::ranges::max_element(shown, {}, [&](const auto* l) { return l->models[m].*of; });
}

/// How far the models are from the table.
std::string answer(const Lights& shown, const Spheres& s, std::string_view name) {
  std::vector<std::size_t> all(s.models.size());
  for (std::size_t m = 0; m < all.size(); ++m) all[m] = m;
  const std::size_t best = *std::ranges::min_element(all, {}, [&](std::size_t m) {
    return worst(shown, m, &ModelSphere::median).models[m].median;
  });
  const bool several = name.empty() && s.models.size() > 1;
  const auto alike = std::ranges::count_if(all, [&](std::size_t m) {
    return worst(shown, m, &ModelSphere::median).models[m].median <= just_seen;
  });
  if (several && alike > 1)
    return fmt::format(
        "{} of {} models look almost like the table: half of their pixels differ by "
        "less than ΔE2000 {} under each light.",
        alike, s.models.size(), just_seen);
  const auto who = name.empty() ? s.models[best] : fmt::format("the {}", name);
  const auto begin =
      several ? fmt::format("Among {} models, {} comes closest: it", s.models.size(), who)
              : capital(who);
  const auto& w = worst(shown, best, &ModelSphere::median);
  const auto& most = w.models[best];
  const auto& widest = worst(shown, best, &ModelSphere::p95);
  const double tail = widest.models[best].p95;
  const auto [least, largest] = std::ranges::minmax(shown, {}, &SpheresUnderLight::covered);
  const auto from = percent(least->covered), to = percent(largest->covered);
  const auto part = least->covered > 0.9
                        ? std::string()
                        : fmt::format(" The table covers {}{} of what light reaches.",
                                      from == to ? "" : from + " to ", to);
  if (tail <= just_seen)
    return fmt::format(
        "{} looks like the table {}: 95\u202f% of the pixels differ by less than ΔE2000 {}.{}",
        begin,
        shown.size() > 1
            ? fmt::format("under each of the {} lights", shown.size() == 3 ? "three" : "two")
            : "under " + shown[0]->light,
        delta_e_text(std::max(tail, 0.01)), part);
  const auto half =
      &widest == &w ? fmt::format(
                          "Under {}, the worst light, half of the pixels are within ΔE2000 {}, and "
                          "95\u202f% within {}.",
                          w.light, delta_e_text(most.median), delta_e_text(tail))
                    : fmt::format(
                          "The median is largest under {}: half of the pixels are within ΔE2000 "
                          "{}. The largest errors are under {}: 95\u202f% of the pixels are within "
                          "{}.",
                          w.light, delta_e_text(most.median), widest.light, delta_e_text(tail));
  const double apart = widest.models[best].spacing_p95;
  const auto spacing =
      apart > 0.5 * tail
          ? fmt::format(
                " Under {}, a model without any misfit would reach {}, from the spacing of the "
                "table's samples.",
                widest.light, delta_e_text(apart))
          : std::string();
  if (most.median > just_seen && most.spacing_median > 0.5 * most.median)
    return fmt::format(
        "The table's samples lie too far apart to tell whether {} looks like it. {}{}{}", who, half,
        spacing, part);
  return fmt::format("{} {}. {}{}{}", begin,
                     most.median <= just_seen    ? "looks almost like the table"
                     : most.median <= told_apart ? "looks slightly different from the table"
                                                 : "looks different from the table",
                     half, spacing, part);
}

/// Table, model and difference under each light.
Markup row_of(const Lights& shown, const Spheres& s, std::size_t m, std::string_view name) {
  std::string html = R"(<div class="spheres">)";
  if (name.empty()) html += fmt::format("<h3>{}\u2002{}</h3>", m + 1, markup_text(s.models[m]));
  const auto scale = scale_of(shown);
  for (const auto* l : shown) {
    const auto& model = l->models[m];
    const auto of = [&](std::string_view what) {
      return fmt::format("Sphere under {}, {}", l->light, what);
    };
    html += sphere_figure(
        fmt::format("{}: median ΔE2000 {}", capital(l->light), delta_e_text(model.median)),
        s.pixels,
        {{l->table, of("table"), "table"},
         {model.picture, of(name.empty() ? s.models[m] : name), name.empty() ? "model" : name},
         {difference_png(model.difference, s.pixels, scale), of("difference"), "difference"}});
  }
  return {html + "</div>\n"};
}

/// A row for each light, or for each of several models.
/// True where pixels show nearest samples: the table's format defines no values between them.
bool has_nearest(const Spheres& s) {
  return std::ranges::any_of(s.lights, [](const auto& l) {
    return !l.models.empty() && std::isfinite(l.models[0].spacing_median);
  });
}

page::Table numbers(const Lights& shown, const Spheres& s, std::string_view name) {
  const auto text = [](double x) { return Cell(std::isfinite(x) ? delta_e_text(x) : "–"); };
  page::Table t;
  t.look = "scroll";
  if (name.empty()) {
    t.head = columns("ΔE2000");
    for (const auto* l : shown)
      for (const char* what : {": median", ": 95th percentile"})
        t.head.push_back({l->light + what, true});
    for (std::size_t m = 0; m < s.models.size(); ++m) {
      auto& row =
          t.rows.emplace_back(std::vector{Cell(fmt::format("{}\u2002{}", m + 1, s.models[m]))});
      for (const auto* l : shown)
        row.insert(row.end(), {text(l->models[m].median), text(l->models[m].p95)});
    }
    return t;
  }
  const bool spacing = has_nearest(s);
  t.head = columns(spacing ? "light|>covered|>ΔE2000: median|>95th percentile|>from spacing "
                             "only: median|>from spacing only: 95th percentile"
                           : "light|>covered|>ΔE2000: median|>95th percentile");
  for (const auto& l : s.lights) {
    const auto of = [&](double ModelSphere::*what) {
      return l.models.empty() ? Cell("–") : text(l.models[0].*what);
    };
    auto& row = t.rows.emplace_back(
        std::vector{Cell(l.light),
                    Cell(l.covered < 1 && l.covered > 0.995 ? "> 99\u202f%" : percent(l.covered)),
                    of(&ModelSphere::median), of(&ModelSphere::p95)});
    if (spacing)
      row.insert(row.end(), {of(&ModelSphere::spacing_median), of(&ModelSphere::spacing_p95)});
  }
  return t;
}

std::string how(const Spheres& s, bool has_columns) {
  const bool colours = s.channels == std::vector<std::string>{"r", "g", "b"};
  return fmt::format(
      "Front light: three lights on the viewer's side. Rim light: one of these, and two from "
      "behind "
      "the sphere. Flash: one, 10° above the viewer. The table's 99th percentile of "
      "luminance under each light is shown as white. {}{}{}{}",
      has_nearest(s)
          ? fmt::format("Each pixel shows the table's nearest sample, if its light and viewer are "
                        "within {}° of the pixel's. Samples mirrored at the plane of incidence, "
                        "or with light and view exchanged, also count.",
                        Spheres::reach_deg)
          : std::string("For each pixel the table is interpolated."),
      colours
          ? std::string()
          : fmt::format(" Shown is the grey of {}{}.", s.channels.size() > 1 ? "the mean of " : "",
                        fmt::join(s.channels, ", ")),
      has_columns ? " Covered: share of the lit pixels for which the table has a value." : "",
      has_columns && has_nearest(s)
          ? " From spacing only: "
            "the ΔE2000 that spacing causes by itself, found by sampling the fit at the table's "
            "directions."
          : "");
}

}  // namespace
}  // namespace gonio::page

namespace gonio {

std::string delta_e_text(double x) {
  using namespace page;
  return x < 0.005 ? "0" : x < 1 ? fmt::format("{:.2f}", x) : significant(x, 2);
}

page::Section spheres_section(const Spheres& s, std::string_view name, std::size_t at_once) {
  using namespace page;
  Section out{"The same sphere, as the table has it and as fitted", {}, {}, "spheres"};
  Lights shown;
  double most = 0;
  for (const auto& l : s.lights) {
    if (!l.table.empty()) shown.push_back(&l);
    most = std::max(most, l.covered);
  }
  if (shown.empty()) {
    out.title = "No sphere to show";
    out.text = fmt::format(
        "The table has samples for {} of a sphere's lit pixels: too few for a comparison.",
        most > 0 ? "at most " + rounded_up(100 * most) + "\u202f%" : "none");
    return out;
  }
  out.text = answer(shown, s, name);
  out.parts.emplace_back(Markup{sphere_keys(scale_of(shown))});
  Fold more{many(s.models.size() - std::min(at_once, s.models.size()), "more model"), {}};
  for (std::size_t m = 0; m < s.models.size(); ++m)
    (m < at_once ? out.parts : more.parts).emplace_back(row_of(shown, s, m, name));
  if (!more.parts.empty()) out.parts.emplace_back(std::move(more));
  out.parts.emplace_back(numbers(shown, s, name));
  out.parts.emplace_back(Prose{how(s, !name.empty()), "small muted"});
  return out;
}

}  // namespace gonio
