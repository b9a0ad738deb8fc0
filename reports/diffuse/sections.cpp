// The page of the report on diffuse forms.
#include <algorithm>
#include <optional>

#include "reports/diffuse/diffuse.h"
#include "reports/finding/facts.h"
#include "reports/finding/words.h"
#include "reports/page/numbers.h"
#include "reports/page/section.h"

#include <fmt/format.h>

namespace gonio::page {
namespace {

Section summary(const DiffuseRows& all) {
  Table t;
  t.head = columns(
      "form|its parameter|>most albedo|>least average|>with a lobe|reciprocal|>ΔE, matte|>ΔE, "
      "plastic|>operations|>ns");
  const auto delta = [&](const DiffuseForm& f, std::string_view surface) {
    const DiffuseColour* most = nullptr;
    for (const auto& c : all.colours)
      if (c.form == f.id && c.surface == surface && (!most || c.delta_e > most->delta_e)) most = &c;
    if (!most) return Cell("–");
    return Cell(significant(most->delta_e, 2), fmt::format("{}, {}, roughness {}", most->material,
                                                           most->light, plain(most->roughness)));
  };
  const auto share = [](double x, std::string at) {
    return Cell(significant(x, 3), std::move(at), {}, x > 1.0001 ? "breaks" : "");
  };
  for (const auto& f : all.forms)
    t.add(Cell{f.name, {}, fmt::format("`{}`", f.id.substr(f.id.find('.') + 1)), ""},
          f.parameter.empty() ? "–" : f.parameter,
          share(f.most_albedo,
                fmt::format("roughness {}, μ = {}", plain(f.most_roughness), plain(f.most_mu))),
          significant(f.least_average, 3), share(f.most_with_lobe, ""),
          f.reciprocity < 1e-9 ? "yes" : percent(f.reciprocity), delta(f, "matte"),
          delta(f, "plastic"), fmt::format("{}", f.operations),
          fmt::format("{} ± {}", significant(f.ns, 2), significant(f.spread_ns, 1)));
  return {"Every form in a line",
          "All at kd = 1, over roughness 0 to 1. An albedo above 1 makes light. “With a lobe” puts "
          "a GGX lobe of F0 = 0.04 on top. ΔE2000 is the largest over materials and lights; the "
          "pointer shows where.",
          {t}};
}

Section albedos(const Pictures& p) {
  Choice c;
  c.controls = {{"form", "Form", "Disney", true}};
  c.slots = {slot_of(p, "loss", c.controls), slot_of(p, "albedo", c.controls, 290)};
  c.slots[1].on_paper = false;
  c.look = "columns map";
  return {"What each gives back",
          "Share of the light that leaves a white surface again, by roughness and by the angle it "
          "is seen from.",
          {Shown{"average"}, c}};
}

/// "Oren–Nayar from roughness 0.6 on": where no kd gives back what the reference does; empty: nowhere.
std::string too_dark(const DiffuseRows& all) {
  constexpr double equal = 0.99;  // less is hardly seen
  std::vector<std::string> parts;
  for (const auto& f : all.forms) {
    std::optional<double> from;
    for (const auto& c : all.colours)
      if (c.form == f.id && c.given_back < equal) from = std::min(from.value_or(1), c.roughness);
    if (from) parts.push_back(fmt::format("{} from roughness {} on", f.name, plain(*from)));
  }
  return list_text(parts);
}

Section looks(const DiffuseRows& all, const Pictures& p) {
  Choice c;
  c.controls = {{"surface", "Surface", "matte"},
                {"material", "Material", "chalk", true},
                {"light", "Light", "front light", true}};
  c.slots = {slot_of(p, "delta_e", c.controls, 340)};
  const auto dark = too_dark(all);
  return {
      "How each looks beside the reference",
      "A ball under one light from the front, from 60° and from 120° to the view, or a plane "
      "under even light. A white surface that faces the light shows as the display's white. "
      "Matte surfaces are compared with EON. Plastic has a GGX lobe of F0 = 0.04 and of the "
      "same roughness on every form; its reference is EON below that lobe, coupled by albedos "
      "as in Kelemen and Szirmay-Kalos (2001), which loses and makes no light. Every form gives "
      "back as much on average as the reference: its kd is so chosen." +
          (dark.empty()
               ? std::string()
               : fmt::format(" On chalk even kd = 1 gives back less than 99\u202f% of that: {}.",
                             dark)),
      {c}};
}

}  // namespace
}  // namespace gonio::page

namespace gonio {

page::Page report_page(const DiffuseReport& r) {
  using namespace page;
  Page out{"diffuse", "report diffuse", "Diffuse forms", "What a matte surface gives back",
           r.findings.sentences};
  out.full = r.full;
  out.first = opening(r.pictures, "average");
  out.sections = {
      summary(r.rows),
      albedos(r.pictures),
      looks(r.rows, r.pictures),
      {"How it is measured",
       "",
       {Points{{"Roughness is what a renderer's slider sets: α = r² for Disney's, "
                "Frostbite's and Hammon's form, σ = r radians for Oren–Nayar as in "
                "MaterialX, r itself for Fujii's and EON.",
                "Albedos are integrals, exact to 10⁻⁶. Times are of column kernels, in "
                "float and in cache, on one thread. Here a form is timed "
                "by itself, in the report on costs as part of a lobe's model.",
                fmt::format("Colours are compared on a ball, where the cosines of light "
                            "and view are {:g} or more. Sentences round up, tables to "
                            "the nearest.",
                            least_colour_cosine),
                "Coupled forms reflect what the interface of a lobe leaves. Hammon's, "
                "Disney's and Frostbite's contain an interface. None of them is a "
                "matte surface: they are compared on plastic only."}}}}};
  out.most_shipped = {"Lambert", "Lambert, coupled", "Disney", "Frostbite", "Oren–Nayar", "EON"};
  return out;
}

}  // namespace gonio
