// The page of the remap report.
#include <algorithm>
#include <cmath>

#include "brdf/catalogue/registry.h"
#include "reports/page/numbers.h"
#include "reports/page/section.h"
#include "reports/remap/remap.h"

#include <fmt/format.h>

namespace gonio::page {
namespace {

std::string like_text(const NearestRoughness& n) {
  return fmt::format("{}{:.2f}", !n.at_end ? "" : n.roughness < 0.5 ? "≤ " : "≥ ", n.roughness);
}
const RemapRow* row_of(const RemapRows& all,
                       std::string_view form,
                       std::string_view reference,
                       double roughness) {
  for (const auto& r : all.rows)
    if (r.form == form && last_word(r.reference) == reference && r.roughness == roughness)
      return &r;
  return nullptr;
}
/// Roughnesses that pictures and tables are of.
std::vector<double> shown(const RemapRows& all) {
  std::vector<double> out;
  if (!all.forms.empty())
    for (const auto& at : all.forms[0].at)
      if (!at.g2.empty()) out.push_back(at.roughness);
  return out;
}
std::string nearest(const std::vector<double>& list, double x) {
  const auto at = std::ranges::min_element(list, {}, [&](double r) { return std::abs(r - x); });
  return at == list.end() ? "" : fmt::format("{:g}", *at);
}

Section each_form(const RemapRows& all, const Pictures& p) {
  const auto roughness = shown(all);
  Choice maps;
  maps.controls = {{"form", "Form", "schlick_ggx.direct", true},
                   {"reference", "Reference", "correlated"},
                   {"at", "Roughness", "roughness " + nearest(roughness, 0.3), true}};
  Slot formulas;
  for (const auto& f : all.forms) {
    const std::string id(short_id(f.form));
    maps.controls[0].called.emplace_back(id,
                                         fmt::format("{} ({})", form_cell(f.form).text,
                                                     f.ndf == "ndf.beckmann" ? "Beckmann" : "GGX"));
    formulas.each.push_back(
        {{id, "", ""},
         {Prose{fmt::format("`{}`{}{}", f.formula, f.ships.empty() ? "" : " · ", f.ships),
                "small"}}});
  }
  formulas.on_paper = false;
  auto errors = slot_of(p, "masking_error", maps.controls);
  errors.on_paper = false;
  auto own = slot_of(p, "g2", maps.controls);  // of the references, which have no error
  std::erase_if(own.each, [&](const Alternative& a) {
    return a.chosen[0] != short_id(references_of("ndf.ggx")[0]) &&
           a.chosen[0] != short_id(references_of("ndf.beckmann")[0]) &&
           a.chosen[0] != short_id(references_of("ndf.ggx")[1]) &&
           a.chosen[0] != short_id(references_of("ndf.beckmann")[1]);
  });
  for (auto& a : own.each) a.chosen[1] = a.chosen[0].substr(a.chosen[0].rfind('.') + 1);
  for (auto& a : own.each) errors.each.push_back(std::move(a));
  maps.slots = {std::move(errors), std::move(formulas)};
  Choice curves;
  curves.controls = {{"distribution", "Distribution", "GGX"},
                     {"reference", "Reference", "correlated"},
                     {"by", "Behaves like, by", "G2"},
                     {"roughness", "Roughness of E", nearest(roughness, 0.3), true}};
  for (const char* family : {"behaves_like", "rms", "furnace"})
    curves.slots.push_back(slot_of(p, family, curves.controls));
  curves.look = "panels";
  curves.slots[1].on_paper = curves.slots[2].on_paper = false;

  Table like{columns("")};
  for (const double r : roughness) like.head.push_back({plain(r), true});
  for (const auto& f : all.forms) {
    auto& row = like.rows.emplace_back(std::vector{form_cell(f.form)});
    for (const double r : roughness) {
      const auto* found = row_of(all, f.form, "correlated", r);
      row.push_back(found ? like_text(found->by_g2) : "");
    }
  }
  return {
      "How far off, and which roughness it behaves like",
      "G2 of each form against exact Smith: GGX's forms against Smith for GGX, Beckmann's against "
      "Smith for Beckmann. Forms that read the half vector (VoH, NoH) are averaged over azimuths "
      "between light and view, evenly. The mobile forms stand for V F; here they are taken for "
      "masking. E is under the form's own distribution, at F = 1. “Behaves like” is the roughness "
      "of exact Smith that is nearest by least squares, from 0.01 to 1; at an end it may lie "
      "beyond. “By G2” compares masking only, over NoL and NoV from 0.05 on. “By E” compares "
      "distribution and masking together, over μ from 0.1 on. On smooth surfaces E hardly depends "
      "on roughness.",
      {maps, curves, Subtitle{"The roughness of height-correlated Smith that each is like, by G2"},
       like}};
}

Section wrong_place(const RemapRows& all, const Pictures& p) {
  if (!has_family(p, "each_k")) return {};
  Choice c;
  c.controls = {{"mu", "μ", "0.1", true}};
  for (const char* light : {"even", "single"}) {
    Slot s;
    for (const auto& mu : values_of(p, "each_k", "mu"))
      s.each.push_back({{mu}, {Shown{"each_k", {{"light", light}, {"mu", mu}}}}});
    c.slots.push_back(std::move(s));
  }
  c.slots[1].on_paper = false;
  Table t{columns(">k|>claimed|>G1|>roughness it is meant for|>exact Smith there")};
  for (const auto& g : all.g1)
    t.add(plain(g.k), plain(g.claimed), fmt::format("{:.4f}", g.value), plain(g.roughness),
          fmt::format("{:.4f}", g.smith));
  return {"Each k in the other's place",
          "k = (r+1)²/8 is meant for single lights, k = r²/2 for image-based light. Each figure "
          "shows both, beside exact Smith.",
          {c, Subtitle{"Schlick's G1 at NoV 0.1"}, t}};
}

Section in_place_of_vf(const Pictures& p) {
  if (!has_family(p, "in_place_of_vf")) return {};
  Choice c;
  c.controls = {{"form", "Form", "", true}, {"fresnel", "Fresnel", "", true}};
  for (const auto& form : values_of(p, "in_place_of_vf", "form"))
    c.controls[0].called.emplace_back(form, form_cell("masking." + form).text);
  for (const char* over : {"all", "mirror"}) {
    auto s = slot_of(p, "in_place_of_vf", c.controls, 300, {{"over", over}});
    c.slots.push_back(std::move(s));
  }
  c.slots[1].on_paper = false;
  return {"In place of V F",
          "F0 V of the mobile forms over V F of Smith (correlated) and an exact Fresnel term; 1 is "
          "right. V = 1/(4 LoH² (r + 0.5)): the 4 of D F G/(4 NoL NoV), which the publication "
          "leaves out, is given back. Cosines go from 0.05 to 1 in steps of 0.05.",
          {c}};
}

Table all_forms(const RemapRows& all, std::string_view reference, double roughness) {
  Table t{
      columns("|>RMS of G2|>largest, relative|at NoL, NoV|>E(0.5)|>Smith's|>like r, by G2|>by "
              "E|>operations|>roots|reads h|ships in")};
  std::vector<std::pair<const RemapForm*, const RemapRow*>> found;
  for (const auto& f : all.forms)
    if (const auto* r = row_of(all, f.form, reference, roughness)) found.emplace_back(&f, r);
  std::ranges::stable_sort(found, [](const auto& a, const auto& b) {
    return a.first->ndf != b.first->ndf ? a.first->ndf > b.first->ndf
                                        : a.second->rms < b.second->rms;
  });
  for (const auto& [f, r] : found)
    t.add(form_cell(f->form), significant(r->rms, 2), percent(r->max_rel),
          r->max_rel > 1e-12 ? plain(r->max_rel_nol) + ", " + plain(r->max_rel_nov) : "",
          fmt::format("{:.4f}", r->albedo), fmt::format("{:.4f}", r->albedo_reference),
          like_text(r->by_g2), like_text(r->by_albedo), fmt::format("{}", f->operations),
          fmt::format("{}", f->roots), f->reads_half ? "yes" : "",
          Cell{f->ships, {}, {}, "because small"});
  return t;
}
Section every_form(const RemapRows& all) {
  const auto roughness = shown(all);
  Choice c;
  c.controls = {{"reference", "Reference", "correlated"},
                {"roughness", "Roughness", nearest(roughness, 0.5)}};
  Slot s;
  for (const char* reference : {"separable", "correlated"})
    for (const double r : roughness)
      s.each.push_back({{reference, fmt::format("{:g}", r)}, {all_forms(all, reference, r)}});
  c.slots = {std::move(s)};
  c.look = "";
  double rms_error = 0, albedo_error = 0;
  for (const auto& r : all.rows) rms_error = std::max(rms_error, r.rms_error);
  for (const auto& f : all.forms)
    for (const auto& at : f.at) albedo_error = std::max(albedo_error, at.error);
  return {
      "All forms",
      "From the nearest to the furthest, GGX's first. Operations are those of one sample, counted, "
      "all kinds alike, roots and divisions among them.",
      {c,
       Prose{
           fmt::format(
               "RMS and bias are by Gauss's rule with 24 nodes along each cosine. Beside 16 nodes "
               "their error is at most {}. The largest error is over steps of 0.025. E is exact to "
               "{}.",
               significant(rms_error, 1), significant(albedo_error, 1)),
           "small muted"}}};
}

}  // namespace
}  // namespace gonio::page

namespace gonio {

page::Page report_page(const RemapReport& r) {
  using namespace page;
  Page out{"remap", "report remap", "Masking: what the remaps do",
           "Masking forms against exact Smith, and which roughness each behaves like",
           r.findings.sentences};
  out.full = r.full;
  out.first = opening(r.pictures, "behaves_like",
                      {{"distribution", "GGX"}, {"reference", "correlated"}, {"by", "G2"}});
  out.sections = {each_form(r.rows, r.pictures), wrong_place(r.rows, r.pictures),
                  in_place_of_vf(r.pictures), every_form(r.rows)};
  out.most_shipped = {"schlick_ggx.direct",        "smith_ggx.correlated",
                      "schlick_ggx.half_alpha",    "ue_joint",
                      "smith_ggx.separable",       "kelemen",
                      "smith_beckmann.correlated", "schlick_beckmann"};
  return out;
}

}  // namespace gonio
