// The page of the cross fit report.
#include <algorithm>
#include <cmath>
#include <set>

#include "brdf/catalogue/registry.h"
#include "reports/cross_fit/cases.h"
#include "reports/cross_fit/cross_fit.h"
#include "reports/page/numbers.h"
#include "reports/page/section.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio::page {
namespace {

using page::Group;
using page::Table;

/// The matrix that the page begins with.
std::vector<Part> matrices(const Pictures& p) {
  Choice c;
  c.controls = {{"quantity", "Quantity", "roughness"}, {"roughness", "Roughness", "all"}};
  for (const auto& r : values_of(p, "matrix", "roughness"))
    c.controls[1].called.emplace_back(r, r == "all" ? "RMS over all" : "at " + r);
  c.slots = {slot_of(p, "matrix", c.controls)};
  c.look = "";
  return {Group{
      "picture",
      {Prose{
           "Each row is a form that is fitted, each column the truth that it is fitted to. A cell "
           "is empty where that form was not fitted, or where most of its fits have no interval.",
           "small muted"},
       c}}};
}

Section over_roughness_of(const CrossFitReport& r) {
  const auto& p = r.pictures;
  if (!has_family(p, "shifts")) return {};
  Choice c;
  c.controls = {{"truth", "Truth"},
                {"kind", "What differs from the truth", "masking"},
                {"material", "Material"}};
  c.controls[1].called = {{"fresnel", "Fresnel term"},
                          {"masking", "masking"},
                          {"distribution", "distribution"},
                          {"combination", "several terms"},
                          {"model", "whole model"}};
  for (const auto& quantity : values_of(p, "shifts", "quantity")) {
    c.slots.push_back(slot_of(p, "shifts", c.controls, 300, {{"quantity", quantity}}));
    c.slots.back().on_paper = false;
  }
  c.slots[0].on_paper = true;
  Slot said{{}, false};
  for (const auto& s : sentences_of_forms(r.rows)) {
    const std::vector<std::string> of{s.truth, s.kind, ""};
    auto at = std::ranges::find(said.each, of, &Alternative::chosen);
    if (at == said.each.end())
      at = said.each.insert(at, {of, {Table{columns("form|what it does"), {}, "told-by-cell"}}});
    std::get<Table>(at->parts[0].is).add(form_cell(s.fitted), s.sentence);
  }
  Choice sentences = c;
  sentences.controls.pop_back();
  for (auto& a : said.each) a.chosen.pop_back();
  sentences.slots = {std::move(said)};
  sentences.look = "";
  return {"Over roughness",
          "The shift of each parameter that the form causes. F0 of metals is the mean of the "
          "channels. Points without an interval are left out. Where light meets several facets, "
          "bars show "
          "the uncertainty of the random walks; the exact form of single scattering is dashed. "
          "All of this is by the log metric on a slice to 80°.",
          {c, Subtitle{"Each in a sentence"}, sentences}};
}

Section by_surface(const Pictures& p) {
  if (!has_family(p, "compared")) return {};
  Choice c;
  c.controls = {{"form", "Form", "schlick_ggx.direct", true}, {"material", "Material"}};
  for (const auto& form : values_of(p, "compared", "form")) {
    auto name = form;
    for (const char* role : {"fresnel.", "masking.", "ndf.", "model."})
      if (const auto cell = form_cell(role + form); name == form && !cell.aside.empty())
        name = cell.text;
    c.controls[0].called.emplace_back(form, name);
  }
  for (const auto& quantity : values_of(p, "compared", "quantity")) {
    c.slots.push_back(slot_of(p, "compared", c.controls, 300, {{"quantity", quantity}}));
    c.slots.back().on_paper = false;
  }
  return {"Metric and directions",
          "The same truth, GGX met once, and the same form, fitted by another metric or over other "
          "directions. The log metric weighs all directions alike, l2_cosine the bright peak.",
          {c}};
}

/// Shifts as ranges: a form a row, metric and directions across.
Section ranges_by_metric(const CrossFitRows& all) {
  const auto list = ranges(all);
  if (list.empty()) return {};
  const auto column = [](const CrossRange& x) {
    const auto at = std::ranges::find(cross_layouts, x.layout, &CrossLayout::name);
    return fmt::format("{}, {}", x.metric == Metric::log ? "log" : "cosine-weighted", at->what);
  };
  Choice c;
  c.controls = {{"parameter", "Parameter", "f0"}, {"material", "Material"}};
  c.controls[0].called = {{"f0", "F0"}, {"roughness", "roughness"}};
  std::vector<std::string> across;
  for (const auto& x : list)
    if (std::ranges::find(across, column(x)) == across.end()) across.push_back(column(x));
  std::ranges::stable_sort(across, {}, [](const auto& name) { return name.ends_with("horizon"); });
  Slot tables;
  for (const auto& x : list) {
    const std::vector<std::string> of{x.parameter, x.material};
    auto at = std::ranges::find(tables.each, of, &Alternative::chosen);
    if (at == tables.each.end()) {
      Table t{columns("form")};
      for (const auto& name : across) t.head.push_back({name, true});
      at = tables.each.insert(at, {of, {std::move(t)}});
    }
    auto& rows = std::get<Table>(at->parts[0].is).rows;
    const auto name = form_cell(x.fitted);
    auto row = std::ranges::find_if(rows, [&](const auto& cells) {
      return cells[0].aside == name.aside && cells[0].text == name.text;
    });
    if (row == rows.end()) {
      row = rows.insert(row, std::vector<Cell>(across.size() + 1));
      (*row)[0] = name;
    }
    const bool f0 = x.parameter == "f0";
    const auto say = [&](double v) {
      if (std::abs(v) < (f0 ? 5e-4 : 5e-5)) return std::string("0");
      return f0 ? signed_percent(v) : (v > 0 ? "+" : "") + significant(v, 2);
    };
    const auto k =
        static_cast<std::size_t>(std::ranges::find(across, column(x)) - across.begin()) + 1;
    (*row)[k] = Cell(std::isfinite(x.least) ? fmt::format("{} to {}{}", say(x.least), say(x.most),
                                                          x.at_bound ? "*" : "")
                                            : "no interval",
                     x.at_bound ? fmt::format("{} of {} without", x.at_bound, x.fits) : "");
  }
  c.slots = {std::move(tables)};
  c.look = "";
  return {"What a shift depends on",
          "The range of a parameter's shift over the roughnesses, by metric and by the directions "
          "that were measured. The log metric weighs all directions alike, the cosine-weighted one "
          "follows the bright peak. *: fits without an interval are left out.",
          {c}};
}

Section published_fits_of(const CrossFitRows& all) {
  if (all.published.empty()) return {};
  Table t{
      columns("material|>core, published|>tail, published|>Beckmann, published|>GGX "
              "roughness|>residual|>GTR roughness|>gamma|>residual")};
  const auto two = [](double x) { return Cell(significant(x, 2)); };
  for (const auto& f : all.published)
    t.add(f.material, two(f.width), two(f.tail), two(f.beckmann), two(f.ggx_roughness),
          two(f.ggx_log_rms), two(f.gtr_roughness),
          significant(f.gamma, 2) + (f.gamma_determined ? "" : "*"), two(f.gtr_log_rms));
  return {
      "Measured materials",
      "Every fifth material of the MERL database. Löw, Kronander, Ynnerman and Unger published "
      "its highlight in 2012 (green, metric E2; doi:10.1145/2077341.2077350); here GGX and GTR, "
      "each with its own height-correlated Smith, replace its distribution and its V-shaped "
      "grooves over the slice to 80°. GGX's tail has the exponent 2; smaller "
      "is longer. *: gamma has no interval.",
      {t}};
}

Section how(const CrossFitRows& all) {
  return {
      "How it is made",
      "",
      {Prose{"A slice of directions is synthesized without noise from exact Fresnel facets "
             "(dielectric; conductor of measured n and k at three wavelengths) under GGX or GTR "
             "with its own Smith masking, height-correlated. “All orders” adds light that meets "
             "several facets, by random walks. The slice is fitted as `gonio fit` does, by the log "
             "metric, all parameters free. The form differs from the truth in one term or in "
             "several, or it is a whole model with its diffuse term. The exact Fresnel term has "
             "its index free, for metals F0 and edge tint. Unreal's F0 of green is held at the "
             "true one, Lazányi's n too."},
       Prose{fmt::format(
           "The slice has theta_h by theta_d at phi_d = 90°, like the image_slice of `gonio "
           "synth`, with theta_h denser towards the highlight: each roughness is resolved and all "
           "angles of the Fresnel term are there. Every bin up to 80° from the normal, to light "
           "and viewer, counts the same, and NoL = NoV. Other directions weigh other errors: "
           "“Metric and directions” compares a slice of three times the bins, the whole slice, a "
           "hemisphere of six incident angles, and the metric l2_cosine. Materials: {}.",
           fmt::join(all.materials, ", "))},
       Prose{"Forms that are shipped without the 1/π of a BRDF (ue_mobile, ue_mobile_simple) are "
             "fitted to π times the truth. At roughness 1 the width is at its bound, where its "
             "truth is; forms that would be rougher end there and are marked."}}};
}

}  // namespace
}  // namespace gonio::page

namespace gonio {

page::Page report_page(const CrossFitReport& r) {
  using namespace page;
  Page out{"cross_fit", "report cross_fit", "Cross fits: what the other parameters absorb",
           "How wrong roughness, F0 and gamma become when fitted with shipped approximations",
           r.findings.sentences};
  out.full = r.full;
  out.first = matrices(r.pictures);
  out.wide = true;
  out.sections = {ranges_by_metric(r.rows), over_roughness_of(r), by_surface(r.pictures),
                  published_fits_of(r.rows), how(r.rows)};
  out.setting = "Every fit and its status are in the rows of the CSV and JSON files.";
  out.most_shipped = {"schlick", "schlick_ggx.direct", "ggx",       "schlick_ggx.half_alpha",
                      "f82",     "ue_joint",           "ue_mobile", "gltf",
                      "disney"};
  return out;
}

}  // namespace gonio
