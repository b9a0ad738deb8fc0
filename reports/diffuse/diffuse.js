"use strict";
// The report on diffuse forms: what each gives back, how it looks, what it costs.

const { forms, colours, figures, maps, findings, full } = page_data();
most_shipped = ["Lambert", "Lambert, coupled", "Disney", "Frostbite", "Oren–Nayar", "EON"];
const short = (id) => id.slice(id.indexOf(".") + 1);
const most_of = (id, surface) => {
  const list = colours.filter((c) => c.form === id && c.surface === surface);
  return list.length ? list.reduce((a, b) => (b.delta_e_2000 > a.delta_e_2000 ? b : a)) : null;
};

// --- Every form in a line ------------------------------------------------------------------------------------
function summary() {
  const delta = (c) => ({ n: c ? el("span", { title: `${c.material}, ${c.light}, roughness ${plain(c.roughness)}` }, significant(c.delta_e_2000, 2)) : "–" });
  const share = (x) => el("span", { class: x > 1.0001 ? "breaks" : null }, significant(x, 3));
  return section("Every form in a line", "At kd = 1, over roughness 0 to 1. Above an albedo of 1 light is made. With a lobe: a GGX lobe of F0 = 0.04 on top. ΔE2000: the most over materials and lights, where it is stands under the pointer.",
    in_cards(table(["form", "its parameter", { n: "most albedo" }, { n: "least average" }, { n: "with a lobe" }, "reciprocal", { n: "ΔE, matte" }, { n: "ΔE, plastic" }, { n: "operations" }, { n: "ns" }],
      forms.map((f) => [[f.name, " ", el("small", {}, el("code", {}, short(f.form)))], f.parameter || "–",
        { n: el("span", { title: `roughness ${plain(f.most_roughness)}, μ = ${plain(f.most_mu)}` }, share(f.most_albedo)) }, { n: significant(f.least_average, 3) }, { n: share(f.most_with_lobe) },
        f.reciprocity < 1e-9 ? "yes" : percent(f.reciprocity), delta(most_of(f.form, "matte")), delta(most_of(f.form, "plastic")), { n: String(f.operations) },
        { n: `${significant(f.cost_ns, 2)} ± ${significant(f.spread_ns, 1)}` }]))));
}

// --- What each gives back ------------------------------------------------------------------------------------
function albedos() {
  const names = choices_of(maps, "loss", "form");
  let name = names.includes("Disney") ? "Disney" : names[0];
  const panels = changing(() => el("div", { class: "columns map" },
    map_view(picture_of(maps, "loss", { form: name }), { value_text: (v) => percent(v / 100, 3) }),
    figure_view(picture_of(figures, "albedo", { form: name }), { height: 290, y_text: (y) => significant(y, 4) })));
  return section("What each gives back", "Share of the light that leaves a white surface again, by roughness and by the angle it is seen from.",
    figure_view(picture_of(figures, "average"), { height: 300, y_text: (y) => significant(y, 4) }),
    el("div", { class: "controls" }, chooser("Form", names.map((n) => [n, n]), name, (n) => { name = n; panels.again(); })), panels.node);
}

// --- How each looks ------------------------------------------------------------------------------------------
function looks() {
  let surface = "matte", material = "chalk", light = "front light";
  const panels = changing(() => figure_view(picture_of(figures, "delta_e", { surface, material, light }), { height: 340, y_text: (y) => significant(y, 2) }));
  const options = (key) => choices_of(figures, "delta_e", key).map((c) => [c, c]);
  return section("How each looks beside the reference", "A ball under one light, from the front, from 60° and from 120° to the view, or a plane under even light; a white surface that faces the light shows as the display's white. Matte: against EON. "
    + "Plastic: a GGX lobe of F0 = 0.04 and of the same roughness on all, and in the reference EON below it, coupled by albedos as Kelemen and Szirmay-Kalos do (2001), so that nothing is lost and nothing made.",
    el("div", { class: "controls" }, choice("Surface", options("surface"), surface, (s) => { surface = s; panels.again(); }),
      chooser("Material", options("material"), material, (m) => { material = m; panels.again(); }),
      chooser("Light", options("light"), light, (l) => { light = l; panels.again(); })), panels.node);
}

const how = () => section("How it is measured", null, el("ul", { class: "findings" },
  el("li", {}, "Roughness is what a renderer's slider sets: α = r² for Disney's, Frostbite's and Hammon's form, σ = r radians for Oren–Nayar as in MaterialX, r itself for Fujii's and EON."),
  el("li", {}, "Albedos are integrals, exact to 10⁻⁶. Times are of column kernels, in float and in cache, on one thread."),
  el("li", {}, "Coupled forms reflect what the interface of a lobe leaves; Hammon's holds its interface. They are compared on plastic alone.")));
const first = picture_of(figures, "average") ?? figures[0];
show_report({
  command: "report diffuse", title: "What a matte surface gives back", findings, first: first && figure_view(first, { height: 330, copy: true, y_text: (y) => significant(y, 4) }),
  sections: [summary(), albedos(), looks(), how()],
  setting: `${full ? "Full" : "Quick"} setting. Every figure of this page is in its data block and in the .json beside it.`,
});
