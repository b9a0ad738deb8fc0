// The page of the audit: what every entry of the catalogue keeps and breaks.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/text.h"
#include "reports/audit/audit.h"
#include "reports/page/numbers.h"
#include "reports/page/render.h"

#include <fmt/format.h>

namespace gonio::page {
namespace {

/// Angles and parameters by their signs.
std::string symbols(std::string text) {
  for (const auto& [name, sign] : {std::pair{"alpha_x", "α_x"},
                                   {"alpha_y", "α_y"},
                                   {"alpha", "α"},
                                   {"gamma", "γ"},
                                   {"eta", "η"},
                                   {"theta_h", "θ_h"},
                                   {"theta_d", "θ_d"},
                                   {"theta_i", "θ_i"},
                                   {"theta_o", "θ_o"},
                                   {" deg", "°"}})
    for (std::size_t at = 0; (at = text.find(name, at)) != text.npos;) {
      const std::string_view word(name);
      const bool inside =
          (at > 0 && word[0] != ' ' && std::isalpha(static_cast<unsigned char>(text[at - 1]))) ||
          (at + word.size() < text.size() &&
           std::isalpha(static_cast<unsigned char>(text[at + word.size()])));
      if (inside)
        at += word.size();
      else
        text.replace(at, word.size(), sign);
    }
  return text;
}
std::string short_of(std::string_view id) {
  return std::string(id.substr(id.find('.') + 1));
}
std::string operations_text(const Operations& o) {
  std::string out;
  for (std::size_t k = 0; k < operation_names.size(); ++k)
    if (o.by_kind[k])
      out += fmt::format("{}{} {}", out.empty() ? "" : ", ", o.by_kind[k], operation_names[k]);
  return out;
}
/// Six decimals at most, and a difference from `to` never rounded away.
std::string near(double x, double to) {
  if (!std::isfinite(x)) return "∞";
  const double off = std::abs(x - to);
  if (off < 5e-7) return plain(to);
  return off < 0.01 ? fmt::format("{:.{}f}", x, off < 1e-4 ? 6 : 4) : significant(x);
}
const std::optional<Worst>& most_energy(const EntryAudit& e) {
  return e.energy ? e.energy : e.energy_under_lobe;
}

/// A column of the table: its title, and its text for an entry, which may be empty.
struct Law {
  std::string_view name;
  const char* title;
  std::string (*text)(const EntryAudit&);
};
const Law laws[]{{"normalisation", "∫ D cos θ",
                  [](const EntryAudit& e) {
                    return e.normalisation ? near(e.normalisation->value, 1) : std::string();
                  }},
                 {"reciprocity", "reciprocal",
                  [](const EntryAudit& e) {
                    return !e.reciprocity                ? std::string()
                           : e.reciprocity->value < 1e-9 ? "yes"
                                                         : percent(e.reciprocity->value);
                  }},
                 {"energy", "most albedo",
                  [](const EntryAudit& e) {
                    return most_energy(e) ? near(most_energy(e)->value, 1) : std::string();
                  }},
                 {"range", "range", [](const EntryAudit& e) {
                    return e.lowest && e.highest && e.kind != "map"
                               ? fmt::format("{} … {}", significant(e.lowest->value, 2),
                                             significant(e.highest->value, 2))
                               : std::string();
                  }}};

/// Its curve, logarithmic where it spans decades.
Figure picture(const EntryAudit& e) {
  Figure f = make_figure("entry", {{"id", std::string(e.about->id)}});
  f.title = symbols(e.picture.y);
  f.note = e.picture.reference.empty() || !e.distance
               ? ""
               : fmt::format("dashed: {}", e.distance->reference);
  f.x = {symbols(e.picture.x) + (e.picture.x.find("theta") != std::string::npos ? " [°]" : "")};
  f.y = {f.title};
  double least = std::numeric_limits<double>::infinity(), most = 0, lowest = 0;
  std::size_t positive = 0;
  for (const auto* list : {&e.picture.value, &e.picture.reference})
    for (const double v : *list) {
      if (!std::isfinite(v)) continue;
      most = std::max(most, v), lowest = std::min(lowest, v);
      if (v > 0) least = std::min(least, v), ++positive;
    }
  f.y.log = positive > 3 && most / least > 300 && lowest >= 0;
  if (f.y.log) f.y.from = std::max(least, most * 1e-6);
  f.curves = {{std::string(e.about->id), e.picture.at, e.picture.value}};
  if (!e.picture.reference.empty()) {
    f.curves.push_back({e.distance ? std::string(e.distance->reference) : "reference", e.picture.at,
                        e.picture.reference, FigureCurve::Kind::line, true});
  }
  return f;
}

std::string worst_text(const std::optional<Worst>& w) {
  if (!w) return "";
  return fmt::format("{}{}",
                     w->error > 0
                         ? with_error(w->value, w->error) + " ± " + significant(w->error, 1)
                         : significant(w->value, 6),
                     w->where.empty() ? "" : " at " + symbols(w->where));
}
Pairs details(const EntryAudit& e) {
  const auto& a = *e.about;
  const auto code = [](std::string_view text) {
    return text.empty() ? std::string() : fmt::format("`{}`", text);
  };
  const auto& d = e.distance;
  return {
      {{"formula", code(a.formula)},
       {"source", std::string(a.source)},
       {"shipped by", std::string(a.ships)},
       {"∫ D cos θ dω", e.normalisation && !std::isfinite(e.normalisation->value)
                            ? "diverges"
                            : worst_text(e.normalisation)},
       {"reciprocity error", worst_text(e.reciprocity)},
       {"largest albedo", worst_text(e.energy)},
       {"in the model", e.energy ? code(e.energy_of) : ""},
       {"under a lobe of f0 0.04", worst_text(e.energy_under_lobe)},
       {"lowest value", worst_text(e.lowest)},
       {"highest value", worst_text(e.highest)},
       {"value at 90°", worst_text(e.grazing)},
       {"light",
        e.light_unit == 1
            ? ""
            : "all figures are divided by π: it is shipped for lights that come without 1/π"},
       {"without a value", e.not_finite ? many(e.not_finite, "legal input")
                                        : "none of the inputs tried, ends of all ranges included"},
       {"distance",
        d ? fmt::format("{} at most, RMS {}, in {} to `{}`; most at {}", significant(d->most.value),
                        significant(d->rms), d->measure, d->reference, symbols(d->most.where))
          : ""},
       {"operations", e.operations ? operations_text(*e.operations) : ""}}};
}

std::string verdict_words(const EntryAudit& e) {
  std::string out = e.mistake ? "mistake" : "";
  for (const auto law : e.violates) out += fmt::format("{}{}", out.empty() ? "" : ", ", law);
  return out.empty() ? verdict(e) : out;
}

Section section_of(std::string_view kind, const char* title, const std::vector<EntryAudit>& all) {
  std::vector<const EntryAudit*> own;
  for (const auto& e : all)
    if (e.kind == kind) own.push_back(&e);
  if (own.empty()) return {};
  const auto some = [&](auto has) {
    return std::ranges::any_of(own, [&](const auto* e) { return has(*e); });
  };
  const bool distances = some([](const auto&e) { return e.distance.has_value(); }),
             operations = some([](const auto&e) { return e.operations.has_value(); });
  Table t{columns("form|verdict"), {}, "in-cards audit"};
  std::vector<const Law*> columns;
  for (const auto& law : laws)
    if (some([&](const auto& e) { return !law.text(e).empty(); })) {
      columns.push_back(&law);
      t.head.push_back({law.title, true});
    }
  if (distances) t.head.push_back({"off by at most", true});
  if (operations) t.head.push_back({"operations", true});
  for (const auto* e : own) {
    auto& row = t.rows.emplace_back(std::vector<Cell>{
        {std::string(e->about->title), {}, fmt::format("`{}`", short_of(e->about->id)), "form"},
        {verdict_words(*e), {}, {}, e->mistake || !e->violates.empty() ? "tag" : "muted"}});
    for (const auto* law : columns) {
      const auto text = law->text(*e);
      const bool breaks = std::ranges::find(e->violates, law->name) != e->violates.end();
      row.push_back({text.empty() ? "·" : text,
                     {},
                     {},
                     text.empty() ? "muted"
                     : breaks     ? "breaks"
                                  : ""});
    }
    if (distances)
      row.push_back(
          e->distance
              ? Cell{significant(e->distance->most.value, 2), {}, short_of(e->distance->reference)}
              : Cell{"·", {}, {}, "muted"});
    if (operations)
      row.push_back(Cell(e->operations ? fmt::format("{}", e->operations->total()) : "·",
                         e->operations ? operations_text(*e->operations) : ""));
    t.row_looks.push_back(fmt::format("entry{}{}{}", e->mistake ? " mistake" : "",
                                      e->violates.empty() ? "" : " violates",
                                      e->mistake || !e->violates.empty() ? "" : " clean"));
  }
  Choice one;
  one.controls = {{"id", "All that is known of", "", true}};
  Slot pictures{{}, false}, facts{{}, false};
  for (const auto* e : own) {
    const std::string id(e->about->id);
    one.controls[0].called.emplace_back(id, std::string(e->about->title));
    pictures.each.push_back({{id}, {Shown{"entry", {{"id", id}}, 210}}});
    facts.each.push_back({{id}, {details(*e)}});
  }
  one.slots = {std::move(pictures), std::move(facts)};
  return {title, "", {t, one}};
}

}  // namespace
}  // namespace gonio::page

namespace gonio {

std::string audit_page_html(const std::vector<EntryAudit>& all) {
  using namespace page;
  const auto count_of = [&](auto is) {
    return static_cast<std::size_t>(std::ranges::count_if(all, is));
  };
  const auto broken = [&](std::string_view law) {
    return count_of(
        [&](const auto& e) { return std::ranges::find(e.violates, law) != e.violates.end(); });
  };
  Page out{"", "audit", "The catalogue, audited", "The catalogue, audited"};
  out.findings = {fmt::format(
      "Among {} that are shipped or published, {} are mistakes (they differ from the form "
      "they are named for) and {} break a law that a BRDF should keep.",
      many(all.size(), "form"), count_of([](const auto& e) { return e.mistake; }),
      count_of([](const auto& e) { return !e.violates.empty(); }))};
  std::string facts;
  for (const auto& [name, law] : {std::pair{"not normalised", "normalisation"},
                                  {"not reciprocal", "reciprocity"},
                                  {"reflect more than they get", "energy"},
                                  {"outside their range", "range"},
                                  {"without a value somewhere", "finite"}})
    facts += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>", name, broken(law));
  std::string filter;
  for (const auto& [value, text] : {std::pair{"all", "all"},
                                    {"mistake", "mistakes"},
                                    {"violates", "break a law"},
                                    {"clean", "keep the laws"}})
    filter += fmt::format(
        R"(<label><input type="radio" name="shown" value="{}"{}><span>{}</span></label>)", value,
        std::string_view(value) == "all" ? " checked" : "", text);
  out.first = {
      Markup{fmt::format(
          R"(<dl class="facts">{}</dl><form class="controls filter"><span class="switch" role="group" aria-label="Shown">{}</span></form>)",
          facts, filter)},
      Prose{"Every figure is the worst over the entry's parameters, the ends of their ranges "
            "included, and over directions. ∫ D cos θ should be 1. “Most albedo” is the largest "
            "share of light from one direction that leaves again, at F = 1 and white: above 1 "
            "light is made. A distribution without a masking of its own is not judged by it; an "
            "uncoupled diffuse term is judged by itself. Forms that engines ship without 1/π, for "
            "lights that bring it along, are divided by π throughout. “Off by at most” is the "
            "distance to "
            "the form named below it."}};
  out.wide = true;
  Pictures pictures;
  for (const auto& e : all)
    if (!e.picture.at.empty()) pictures.figures.push_back(picture(e));
  for (const auto& [kind, title] : {std::pair{"ndf", "Normal distributions"},
                                    {"masking", "Masking and shadowing"},
                                    {"fresnel", "Fresnel"},
                                    {"diffuse", "Diffuse"},
                                    {"map", "Maps between parameters"},
                                    {"model", "Whole models"}})
    out.sections.push_back(section_of(kind, title, all));
  out.setting = "Every number of this page is in the JSON document beside it.";
  return page_html(out, pictures);
}

}  // namespace gonio
