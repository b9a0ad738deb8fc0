// The page of the energy report.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "reports/energy/energy.h"
#include "reports/page/numbers.h"
#include "reports/page/section.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio::page {
namespace {

std::string mu_words(double mu) {
  return mu == 0 ? "on average" : mu == 1 ? "at normal incidence" : "at μ = " + plain(mu);
}
/// Roughnesses at which the loss exceeds each share, by what and at which angle.
Table crossings(const std::vector<std::pair<Cell, const std::vector<Crossing>*>>& rows,
                double least,
                double most) {
  Table t;
  t.head = columns("");
  t.above = {{"", 1}};
  t.look = "in-cards crossings";
  if (rows.empty()) return t;
  const auto& all = *rows[0].second;
  for (const auto& c : all) {
    if (t.above.size() == 1 || t.above.back().first != mu_words(c.mu))
      t.above.emplace_back(mu_words(c.mu), 0);
    ++t.above.back().second;
    t.head.push_back({fmt::format("{}\u202f%", plain(100 * c.share)), true});
  }
  const auto range = [&](const Crossing::Range& r) {
    if (r.to < most)
      return (r.from > least ? first_text(r.from) + "–" : "up to ") + last_text(r.to);
    return r.from > least ? first_text(r.from) : "≤\u202f" + plain(least);
  };
  for (const auto& [name, list] : rows) {
    auto& row = t.rows.emplace_back(std::vector{name});
    for (const auto& c : *list) {
      std::vector<std::string> ranges;
      for (const auto& r : c.ranges) ranges.push_back(range(r));
      row.push_back(ranges.empty() ? Cell{"never", {}, {}, "muted"}
                                   : Cell(fmt::format("{}", fmt::join(ranges, ", ")),
                                          "± " + significant(c.error, 1)));
    }
  }
  return t;
}
constexpr std::string_view crossing_note =
    "Each number is the roughness from which that much is lost; where a loss ends again, both ends "
    "are given. “≤ 0.05” means that it is lost on the smoothest surface looked at. The pointer "
    "shows the error of each.";

struct Ends {
  double least, most;
};
/// The smoothest and the roughest surface.
Ends ends(const EnergyRows& all) {
  Ends e{1, 0};
  for (const auto& f : all.forms)
    for (const auto& at : f.rows)
      e = {std::min(e.least, at.roughness), std::max(e.most, at.roughness)};
  return e;
}

Section from_where(const EnergyRows& all) {
  if (all.materials.empty()) return {};
  std::vector<std::pair<Cell, const std::vector<Crossing>*>> rows;
  for (const auto& m : all.materials) rows.emplace_back(Cell{m.name}, &m.crossings);
  const auto [least, most] = ends(all);
  return {"From which roughness does it matter?",
          fmt::format("GGX under Smith masking, correlated: the roughness from which each share of "
                      "what should leave is missing, by material and angle. {}",
                      crossing_note),
          {crossings(rows, least, most)}};
}

Section maskings(const EnergyRows& all, const Pictures& p) {
  Choice c;
  c.controls = {{"form", "Form", "masking.smith_ggx.correlated", true}};
  for (const auto& f : all.forms)
    c.controls[0].called.emplace_back(
        f.name, form_cell(f.name).text + (f.model.empty() ? "" : " (whole model)"));
  c.slots = {slot_of(p, "loss", c.controls), slot_of(p, "albedo", c.controls, 290)};
  c.slots[0].on_paper = c.slots[1].on_paper = false;
  c.look = "columns map";
  std::vector<std::pair<Cell, const std::vector<Crossing>*>> rows;
  for (const auto& f : all.forms) rows.emplace_back(form_cell(f.name), &f.crossings);
  const auto [least, most] = ends(all);
  return {"Every masking form",
          "At F = 1 a form should give all light back: E = 1. Beckmann's forms are under Beckmann, "
          "Smith for GTR is under GTR of that gamma, the coat's under GTR of gamma 1 with alpha up "
          "to 0.1, as it ships, all others under GGX. Whole mobile models are white and have their "
          "clamps; those that are π times a BRDF are divided by π.",
          {c, Shown{"average_loss", {}, 290},
           Subtitle{"Where each loses more than 1, 5, 10 %, by roughness"},
           Prose{std::string(crossing_note), "small muted"}, crossings(rows, least, most)}};
}

double truth_error(const EnergyRows& all) {
  double most = 0;
  for (const auto& m : all.materials)
    for (const auto& at : m.rows) most = std::max(most, at.error);
  return most;
}
/// Choices by material and angle.
std::vector<Control> by_material(const Pictures& p,
                                 std::string_view family,
                                 std::string material,
                                 std::string angle) {
  std::vector<Control> out{{"material", "Material", std::move(material), true},
                           {"angle", "Angle", std::move(angle), true}};
  for (const auto& a : values_of(p, family, "angle"))
    out[1].called.emplace_back(a, a == "average" ? "on average" : mu_words(std::stod(a)));
  return out;
}

Section bounces(const EnergyRows& all, const Pictures& p) {
  if (all.materials.empty()) return {};
  Choice c;
  c.controls = by_material(p, "bounces", all.materials[0].name, "average");
  c.slots = {slot_of(p, "bounces", c.controls, 280), slot_of(p, "beyond", c.controls, 280)};
  c.slots[1].on_paper = false;
  return {"Bounce by bounce",
          fmt::format("GGX's microsurface with heights and slopes as Smith's masking assumes them, "
                      "with light followed to the end: the deterministic solution, exact to {}.",
                      significant(truth_error(all), 1)),
          {c}};
}

Section compensations(const EnergyRows& all, const Pictures& p) {
  if (!has_family(p, "compensation")) return {};
  Choice c;
  const auto gold =
      std::ranges::find_if(all.materials, [](const auto& m) { return m.name.starts_with("gold"); });
  c.controls = by_material(p, "compensation",
                           gold == all.materials.end() ? all.materials[0].name : gold->name, "0.5");
  c.slots = {slot_of(p, "compensation", c.controls, 280),
             slot_of(p, "compensation_by_angle", c.controls, 280)};
  c.slots[1].on_paper = false;
  Table t{columns(
      "|>RMS error|>worst|worst at|>RMS, gold|>operations|>lookups|>table bytes|>ns|>ns without")};
  for (const auto& x : all.compensations)
    t.add(form_cell(x.id), significant(x.rms, 2), significant(x.worst, 2), x.worst_at,
          significant(x.gold_rms, 2), fmt::format("{}", x.operations), fmt::format("{}", x.lookups),
          count_text(x.bytes),
          fmt::format("{} ± {}", significant(x.ns, 2), significant(x.spread_ns, 1)),
          significant(x.without_ns, 2));
  return {
      "What gives it back",
      fmt::format("Albedo of each compensation less that of all bounces, which is exact to {}. "
                  "Below 0 light is still missing; above it there is too much.",
                  significant(truth_error(all), 1)),
      {c, Subtitle{"Error and cost"}, t,
       Prose{"Errors are over Schlick's Fresnel with four F0 from 0.04 to 1, and roughness and mu "
             "from "
             "0.1 on, with the tables that a shader reads. The errors on gold use its spectrum. "
             "Operations are those of the formula for one channel, counted. Table bytes "
             "are of 32 × 32 texels in half. ns is the time of D V F of GGX for one light and view "
             "with the compensation (for fdez_aguera, which extends the split sum, of F0 A + B), "
             "beside the same without it: one at a time, in float, on one thread, median ± half "
             "the distance of the quartiles. fdez_aguera is for Schlick's Fresnel only.",
             "small muted"}}};
}

/// Most ΔE2000 of each compensation under each light, by roughness.
Section single_lights(const EnergyRows& all) {
  if (all.single_lights.empty()) return {};
  Slot slot;
  for (const double f0 : {0.04, 0.5, 0.9})
    for (const std::string_view light : {"front light", "rim light"}) {
      Table t{columns("roughness|>one bounce|>Turquin|>Kulla and Conty|>± of the walks"),
              {},
              "in-cards"};
      for (const auto& none : all.single_lights) {
        if (none.f0 != f0 || none.light != light || none.id != "single") continue;
        const auto of = [&](std::string_view id) {
          const auto at = std::ranges::find_if(all.single_lights, [&](const SingleLight& s) {
            return s.id == id && s.f0 == f0 && s.light == light && s.roughness == none.roughness;
          });
          return significant(at->delta_e, 2);
        };
        t.add(significant(none.roughness, 2), of("single"), of("turquin"), of("kulla_conty"),
              significant(none.error, 1));
      }
      slot.each.push_back({{fmt::format("{:g}", f0), std::string(light)}, {std::move(t)}});
    }
  return {"Under a single light",
          "Most ΔE2000 over a ball from afar, against random walks on Smith's microsurface. The "
          "light stands 30° or 120° from the view, and a white diffuser that faces it is white. "
          "The albedo above is that under even light: it says little of pictures under one light.",
          {Choice{{{"f0", "F0", "0.9"}, {"light", "Light"}}, {std::move(slot)}, ""}}};
}

Section albedo_formulas(const EnergyRows& all) {
  if (all.albedo_forms.empty()) return {};
  Table t{columns("|>RMS error|>worst|worst at|>operations|>table bytes")};
  for (const auto& f : all.albedo_forms)
    t.add(form_cell(f.id), significant(f.rms, 2), significant(f.worst, 2), f.worst_at,
          f.operations ? fmt::format("{}", f.operations) : "–", count_text(f.bytes));
  return {"E as a formula",
          "Compensations look up E of GGX under Smith, correlated, at F = 1. A fit needs no table. "
          "Errors are against quadrature, over roughness from 0.05 on and NoV from 0.005 on.",
          {t}};
}

/// All figures of a family beside each other.
Group beside(const Pictures& p, std::string_view family, double height) {
  Group g{"panels", {}};
  for (const auto& f : p.figures)
    if (f.family == family) g.parts.emplace_back(Shown{f.family, f.choices, height});
  return g;
}
Section against_time(const Pictures& p) {
  if (!has_family(p, "estimators")) return {};
  return {"What a digit of E costs",
          "One E(μ, α) of GGX under Smith masking, correlated, at F = 1, on one thread. "
          "Deterministic rules show the error that they made when asked for one digit after the "
          "other. The truth is known to 1e-13; smaller errors are drawn there. Estimators by "
          "chance show the RMS error of independent repeats.",
          {beside(p, "estimators", 320)}};
}

Section split_sum(const EnergyRows& all) {
  if (all.light.tables.empty()) return {};
  Table t{columns(
      "texels|stored as|>lookup, most|>RMS|>between centres, most|>storage, most|>quadrature")};
  for (const auto& x : all.light.tables)
    t.add(fmt::format("{0} × {0}", x.size), std::string(x.stored), significant(x.lookup, 2),
          significant(x.lookup_rms, 2), significant(x.between, 2), significant(x.storage, 2),
          "± " + significant(x.bound, 1));
  Section s{
      "The split sum",
      "GGX under Smith, correlated, and Schlick: E = F0 A + B of an even environment. Errors of A "
      "+ B are after bilinear lookup over all NoV and roughness.",
      {t, Group{"panels", {Shown{"split_sum_samples", {}, 280}}}, Subtitle{"Under an environment"},
       Prose{
           fmt::format("ΔE2000 between the split sum and the integral, as a display shows them "
                       "with a white ball at half of its white: the mean over {} views. The split "
                       "takes n = v = r, so at grazing angles its lobe has the wrong shape. The "
                       "pointer shows the largest difference, and that of the luminance. Skies are "
                       "made by formula; maps of your own come with `--environment FILE`.",
                       all.light.views),
           "small muted"}}};
  std::vector<std::string> environments;
  for (const auto& l : all.light.lit)
    if (std::ranges::find(environments, l.environment) == environments.end())
      environments.push_back(l.environment);
  for (const auto& name : environments) {
    Table lit{{{name}}, {}};
    for (const auto& l : all.light.lit) {
      if (l.environment != name) continue;
      const auto column = fmt::format("NoV {}, F0 {}", plain(l.nov), plain(l.f0));
      auto at = std::ranges::find(lit.head, column, &Column::name);
      if (at == lit.head.end()) at = lit.head.insert(lit.head.end(), {column, true});
      const auto roughness = "roughness " + plain(l.roughness);
      auto row = std::ranges::find_if(
          lit.rows, [&](const auto& cells) { return cells[0].text == roughness; });
      if (row == lit.rows.end()) row = lit.rows.insert(row, std::vector{Cell{roughness}});
      row->resize(
          std::max<std::size_t>(row->size(), static_cast<std::size_t>(at - lit.head.begin()) + 1));
      (*row)[static_cast<std::size_t>(at - lit.head.begin())] =
          Cell(significant(l.delta_e, 2),
               fmt::format("largest ΔE {}; luminance of each view: RMS {}, most {}, bias {}; RMS "
                           "over the mean {} ± {}; truth to {}",
                           significant(l.delta_e_max, 2), percent(l.rms), percent(l.max),
                           signed_percent(l.bias), percent(l.of_mean), percent(l.of_mean_spread, 1),
                           percent(l.truth)));
    }
    s.parts.emplace_back(std::move(lit));
  }
  return s;
}
Section irradiances(const EnergyRows& all, const Pictures& p) {
  if (all.light.irradiance.empty()) return {};
  return {"Diffuse irradiance",
          "∫ L cos θ dω over the hemisphere by the sums that renderers take, relative to the exact "
          "value, RMS over normals.",
          {Subtitle{"Against samples"}, beside(p, "irradiance_by_samples", 260),
           Subtitle{"Against time"}, beside(p, "irradiance_by_time", 260)}};
}

}  // namespace
}  // namespace gonio::page

namespace gonio {

page::Page report_page(const EnergyReport& r) {
  using namespace page;
  Page out{"energy", "report energy", "Energy: what single scattering loses",
           "What single scattering loses, and what gives it back", r.findings.sentences};
  out.full = r.full;
  out.first = opening(r.pictures, "average_loss");
  out.sections = {from_where(r.rows),
                  maskings(r.rows, r.pictures),
                  bounces(r.rows, r.pictures),
                  compensations(r.rows, r.pictures),
                  single_lights(r.rows),
                  albedo_formulas(r.rows),
                  against_time(r.pictures),
                  split_sum(r.rows),
                  irradiances(r.rows, r.pictures)};
  out.most_shipped = {"smith_ggx.correlated",
                      "schlick_ggx.direct",
                      "schlick_ggx.half_alpha",
                      "ue_joint",
                      "smith_ggx.separable",
                      "smith_beckmann.correlated",
                      "none"};
  return out;
}

}  // namespace gonio
