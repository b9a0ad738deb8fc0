// The page of the report on Schlick's approximation.
#include <algorithm>
#include <cmath>
#include <map>

#include "reports/page/numbers.h"
#include "reports/page/section.h"
#include "reports/schlick/schlick.h"

#include <fmt/format.h>

namespace gonio::page {
namespace {

using Rows = std::vector<const FresnelRow*>;
template <class Is>
Rows rows_where(const SchlickRows& all, Is is) {
  Rows out;
  for (const auto& r : all.smooth)
    if (is(r)) out.push_back(&r);
  return out;
}

constexpr double nothing = 1e-9;
std::string error_text(double x) {
  return std::abs(x) < nothing ? "0" : significant(x, 2);
}
std::string share_text(double x) {
  return std::abs(x) < nothing ? "0" : percent(x);
}
std::string place(const FresnelRow& r) {
  return r.name + ", " + degrees_text(r.max_abs_theta_deg);
}
const FresnelRow& worst(const Rows& rows, double FresnelRow::*of) {
  return **std::ranges::max_element(rows, {}, [&](const auto* r) { return r->*of; });
}

Section summary(const SchlickRows& all) {
  Table t;
  t.head = columns(
      "form|>IOR 1.5, most|>RMS|>relative|>IOR 1.01–3, most|>from inside, most|>metals, "
      "most|>median RMS|>in linear RGB, most");
  const Cell none = "–";
  for (const auto& form :
       unique(rows_where(all, [](const auto&) { return true; }), &FresnelRow::form)) {
    const auto of = [&](std::string_view kind) {
      return rows_where(all, [&](const auto& r) { return r.form == form && r.kind == kind; });
    };
    const auto most = [&](std::string_view kind) {
      const auto list = of(kind);
      if (list.empty()) return none;
      const auto& w = worst(list, &FresnelRow::max_abs);
      return Cell(error_text(w.max_abs), place(w));
    };
    auto& row = t.rows.emplace_back(std::vector{form_cell(form)});
    const auto outside = of("dielectric");
    const auto glass = std::ranges::find(outside, "IOR 1.5", &FresnelRow::name);
    if (glass == outside.end())
      row.insert(row.end(), 3, none);
    else
      row.insert(row.end(),
                 {Cell(error_text((*glass)->max_abs), place(**glass)), error_text((*glass)->rms),
                  Cell(share_text((*glass)->max_rel), degrees_text((*glass)->max_rel_theta_deg))});
    auto metals = of("metal");
    std::ranges::sort(metals, {}, &FresnelRow::rms);
    row.insert(row.end(), {most("dielectric"), most("dielectric_inside"), most("metal"),
                           metals.empty() ? none : Cell(error_text(metals[metals.size() / 2]->rms)),
                           most("spectral")});
  }
  return {"Every form in a line",
          "Error of F: the form's value less the exact one. Every form is given the exact F0; in "
          "linear RGB that is cut to the gamut, which changes gold's. F82 takes "
          "its tint from the exact value at 82°; F90 and Lazányi's correction are fitted to each "
          "surface; the index forms have the index. The pointer shows where an error is largest.",
          {t}};
}

Section by_index(const Pictures& p) {
  Choice c;
  c.controls = {{"form", "Form", "schlick", true},
                {"side", "Side", "from outside"},
                {"error", "Error", "absolute"}};
  const auto relative = [&](std::string_view family, const char* error) {
    auto slot = slot_of(p, family, c.controls);
    for (auto& a : slot.each) a.chosen[2] = error;
    return slot;
  };
  auto maps = relative("error_by_angle", "absolute");
  for (auto& a : relative("relative_error_by_angle", "relative").each)
    maps.each.push_back(std::move(a));
  maps.on_paper = false;
  c.slots = {std::move(maps), slot_of(p, "error_by_index", c.controls, 290)};
  c.look = "columns map";
  for (auto& control : c.controls)
    if (control.key == "form")
      for (const auto& form : values_of(p, "error_by_angle", "form"))
        control.called.emplace_back(form, form_cell("fresnel." + form).text);
  return {"By angle and index",
          "Dielectrics, with the light in air or in the denser medium. From inside, all light is "
          "reflected beyond the critical angle; forms that use the angle within the medium cannot "
          "show that.",
          {c}};
}

Section one_material(const Pictures& p) {
  Choice c;
  c.controls = {{"material", "Material", "aluminium", true},
                {"kind", "Wavelengths", "three wavelengths"},
                {"channel", "Channel", "red"}};
  c.slots = {slot_of(p, "reflectance", c.controls, 330),
             slot_of(p, "reflectance_error", c.controls, 330)};
  c.slots[0].on_paper = false;
  return {"One material", "Exact reflectance beside every form.", {c}};
}

/// A table of every named material under every form.
Table materials(const SchlickRows& all, std::string_view kind, double FresnelRow::*error) {
  const auto list =
      rows_where(all, [&](const auto& r) { return r.kind == kind && !r.name.starts_with("IOR "); });
  const auto forms = unique(list, &FresnelRow::form);
  Table t;
  t.head = columns("");
  for (const auto& f : forms) t.head.push_back({form_cell(f).text, true});
  for (const auto& material : unique(list, &FresnelRow::material)) {
    auto& row = t.rows.emplace_back(std::vector{Cell{material}});
    for (const auto& f : forms) {
      Rows own = list;
      std::erase_if(own, [&](const auto* r) { return r->material != material || r->form != f; });
      if (own.empty()) {
        row.push_back("–");
        continue;
      }
      const auto& w = worst(own, error);
      const bool relative = error == &FresnelRow::max_rel;
      row.push_back(
          Cell(relative ? share_text(w.*error) : error_text(w.*error),
               w.name + ", " +
                   (error == &FresnelRow::rms
                        ? "all angles"
                        : degrees_text(relative ? w.max_rel_theta_deg : w.max_abs_theta_deg))));
    }
  }
  return t;
}
Section named_materials(const SchlickRows& all) {
  Choice c;
  c.controls = {{"kind", "Surfaces", "metals, three wavelengths"},
                {"error", "Error", "largest error"}};
  Slot slot;
  for (const auto& [kind, words] : {std::pair{"metal", "metals, three wavelengths"},
                                    {"dielectric", "dielectrics at 550 nm"},
                                    {"dielectric_inside", "from inside"},
                                    {"spectral", "spectra in linear RGB"}})
    for (const auto& [error, name] : {std::pair{&FresnelRow::max_abs, "largest error"},
                                      {&FresnelRow::max_rel, "relative"},
                                      {&FresnelRow::rms, "RMS"}})
      slot.each.push_back({{words, name}, {materials(all, kind, error)}});
  c.slots = {std::move(slot)};
  c.look = "";
  return {"Named materials",
          "The worst channel of each material; the pointer shows which, and at which angle. In "
          "linear RGB the exact value is the spectrum's colour, and F0 is that colour cut to the "
          "gamut. The form of three wavelengths is the exact equation at 650, 550 and 450 nm for "
          "red, green and blue.",
          {c}};
}

Section rough(const SchlickReport& r) {
  const auto& p = r.pictures;
  if (!has_family(p, "albedo_error")) return {};
  Choice c;
  c.controls = {{"material", "Material", "aluminium", true},
                {"channel", "Channel", "red"},
                {"mu", "Angle", "0.5"}};
  for (const auto& mu : values_of(p, "albedo_error", "mu"))
    c.controls[2].called.emplace_back(mu, "μ = " + mu);
  for (const char* family : {"albedo_error", "albedo_relative_error", "colour_difference"})
    c.slots.push_back(slot_of(p, family, c.controls));
  c.slots[0].on_paper = c.slots[1].on_paper = false;
  c.look = "panels";
  double bound = 0;
  for (const auto& a : r.rows.rough.albedos) bound = std::max(bound, a.bound);
  return {"What it does to a rough surface",
          fmt::format(
              "Directional albedo E(μ) of GGX under Smith masking, correlated, single scattering, "
              "with the form in place of exact Fresnel. For metals the exact value is the colour "
              "of the whole spectrum in linear RGB, and F0 is that colour. The linear form and "
              "Gulbrandsen's are left out. The numerical error of every E is at most {}.",
              significant(bound, 1)),
          {c}};
}

}  // namespace
}  // namespace gonio::page

namespace gonio {

page::Page report_page(const SchlickReport& r) {
  using namespace page;
  Page out{"schlick", "report schlick", "Schlick's approximation and its kin",
           "Schlick's approximation and its kin against exact Fresnel", r.findings.sentences};
  // What a reader sees of it, on a metal that shows it.
  auto metals = values_of(r.pictures, "colour_difference", "material");
  metals.insert(metals.begin(), "iron");
  for (const auto& metal : metals)
    if (out.first.empty())
      out.first = opening(r.pictures, "colour_difference", {{"material", metal}, {"mu", "0.1"}});
  out.sections = {summary(r.rows), by_index(r.pictures), one_material(r.pictures),
                  named_materials(r.rows), rough(r)};
  out.full = r.full;
  out.setting =
      "RMS over equal steps of θ from 0 to 90°. The exact F is computed in double: its error is "
      "below the last digit that is printed.";
  out.most_shipped = {
      "schlick",           "schlick.ue", "schlick.f90", "f82", "schlick.spherical_gaussian",
      "lazanyi, corrected"};
  return out;
}

}  // namespace gonio
