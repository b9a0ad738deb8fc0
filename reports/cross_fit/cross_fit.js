"use strict";
// The cross fit report: what fits with shipped forms make of roughness, F0 and gamma.

const { findings, sentences, ranges, published, figures, maps, materials, full } = page_data();
const short = (name) => name.replace(/^(masking|fresnel|ndf|model)\./, "");
most_shipped = ["schlick", "schlick_ggx.direct", "ggx", "schlick_ggx.half_alpha", "f82", "ue_joint", "ue_mobile", "gltf", "disney"];
const kind_names = { fresnel: "Fresnel term", masking: "masking", distribution: "distribution", combination: "several terms", model: "whole model" };

// --- Truth × form ----------------------------------------------------------------------------------------
/// The matrix that the page begins with.
function matrices() {
  const chosen = { quantity: "roughness", roughness: "all" };
  const view = changing(() => map_view(picture_of(maps, "matrix", chosen)),
    () => maps.filter((m) => m.family === "matrix" && m.choices.roughness === chosen.roughness && m.choices.quantity !== chosen.quantity).map((m) => map_view(m)), 1);
  const change = (key) => (v) => { chosen[key] = v; view.again(); };
  return el("div", { class: "picture" }, el("p", { class: "small muted" }, "Each row is a form that is fitted, each column the truth that it is fitted to. A cell is empty where that form was not fitted, or where most of its fits end at a bound."),
    el("div", { class: "controls" },
      choice("Quantity", choices_of(maps, "matrix", "quantity").map((q) => [q, q]), chosen.quantity, change("quantity")),
      choice("Roughness", choices_of(maps, "matrix", "roughness").map((r) => [r, r === "all" ? "RMS over all" : `at ${r}`]), chosen.roughness, change("roughness"))), view.node);
}

// --- Over roughness --------------------------------------------------------------------------------------
function over_roughness() {
  const first = figures[0].choices, chosen = { truth: first.truth, kind: "masking", material: first.material };
  let emphasis = "";
  const panels = changing(() => {
    const kinds = choices_of(figures, "shifts", "kind", { truth: chosen.truth });
    if (!kinds.includes(chosen.kind)) chosen.kind = kinds[0];
    const seen = figures.filter((f) => f.family === "shifts" && Object.entries(chosen).every(([of, value]) => f.choices[of] === value));
    const said = sentences.filter((s) => s.truth === chosen.truth && s.kind === chosen.kind);
    const names = said.map((s) => short(s.fitted));
    if (!names.includes(emphasis)) emphasis = "";
    const change = (key) => (v) => { chosen[key] = v; panels.again(); };
    return [el("div", { class: "controls" },
      choice("Truth", choices_of(figures, "shifts", "truth").map((t) => [t, t]), chosen.truth, change("truth")),
      choice("What differs from the truth", kinds.map((k) => [k, kind_names[k]]), chosen.kind, change("kind")),
      choice("Material", choices_of(figures, "shifts", "material", { truth: chosen.truth }).map((m) => [m, m]), chosen.material, change("material")),
      chooser("Form", [["", "all alike"], ...said.map((s) => [short(s.fitted), named(s.fitted)])], emphasis, (v) => { emphasis = v; panels.again(); })),
      el("div", { class: "columns" }, seen.map((f) => figure_view(f, { emphasis }))),
      el("h3", { style: { "margin-top": "22px" } }, "Each in a sentence"),
      el("div", { class: "columns" }, said.map((s) => el("p", { class: "small" }, form_cell(s.fitted), el("br"), s.sentence)))];
  }, () => small_pictures(figures.filter((f) => f.family === "shifts" && f.choices.material === chosen.material && f.choices.truth === chosen.truth && f.choices.kind !== chosen.kind)));
  return section("Over roughness", "The shift of each parameter that the form brings about. F0 of metals is the mean of the channels. Points at a bound are left out. Where light meets several facets bars are what the random walks leave uncertain; "
    + "dashed: the exact form of single scattering.", panels.node);
}

// --- Metric and directions -----------------------------------------------------------------------------
function compared() {
  const forms = choices_of(figures, "compared", "form");
  if (!forms.length) return null;
  const chosen = { form: forms.includes("schlick_ggx.direct") ? "schlick_ggx.direct" : forms[0], material: choices_of(figures, "compared", "material")[0] };
  const panels = changing(() => el("div", { class: "columns" }, choices_of(figures, "compared", "quantity").map((quantity) => picture_of(figures, "compared", { ...chosen, quantity })).filter(Boolean).map((f) => figure_view(f))));
  const change = (key) => (v) => { chosen[key] = v; panels.again(); };
  return section("Metric and directions", "The same truth, GGX met once, and the same form, fitted by another metric or over other directions. The log metric looks at all directions alike, l2_cosine at the bright peak.",
    el("div", { class: "controls" }, chooser("Form", forms.map((f) => [f, named_short(f)]), chosen.form, change("form")),
      choice("Material", choices_of(figures, "compared", "material").map((m) => [m, m]), chosen.material, change("material"))), panels.node);
}

/// Shifts as ranges: a form a row, metric and directions across.
function ranges_by_metric() {
  if (!ranges.length) return null;
  const metric_names = { log: "log", l2_cosine: "cosine-weighted" }, columns = unique(ranges.map((x) => `${metric_names[x.metric]}, ${x.directions}`)).sort((a, b) => a.endsWith("horizon") - b.endsWith("horizon"));
  const said = { f0: ["F0", (x) => (Math.abs(x) < 5e-4 ? "0" : signed_percent(x))], roughness: ["roughness", (x) => (Math.abs(x) < 5e-5 ? "0" : (x > 0 ? "+" : "") + significant(x, 2))] };
  let parameter = "f0", material = ranges[0].material;
  const of = (material) => {
    const own = ranges.filter((x) => x.parameter === parameter && x.material === material), say = said[parameter][1];
    const cell = (x) => !x ? "" : { n: el("span", { title: x.at_bound ? `${x.at_bound} of ${x.fits} at a bound` : null }, known(x.least) ? `${say(x.least)} to ${say(x.most)}` : "at its bounds", x.at_bound && known(x.least) ? "*" : "") };
    return in_cards(table(["form", ...columns.map((c) => ({ n: c }))], [...group_by(own, (x) => x.fitted).values()].map((list) =>
      [form_cell(list[0].fitted), ...columns.map((c) => cell(list.find((x) => `${metric_names[x.metric]}, ${x.directions}` === c)))])));
  };
  const body = changing(() => of(material), () => unique(ranges.map((x) => x.material)).filter((m) => m !== material).map((m) => [el("h3", {}, `${m}: ${said[parameter][0]}`), of(m)]));
  return section("What a shift depends on", "Range over the roughnesses of what a fit makes of a parameter, by metric and by the directions that were measured. The log metric counts all directions alike, the cosine-weighted one follows the bright peak. *: some fits ended at a bound and are left out.",
    el("div", { class: "controls" }, choice("Parameter", Object.entries(said).map(([id, [name]]) => [id, name]), parameter, (p) => { parameter = p; body.again(); }),
      choice("Material", unique(ranges.map((x) => x.material)).map((m) => [m, m]), material, (m) => { material = m; body.again(); })), body.node);
}
/// Measured materials, by published fits.
function published_fits() {
  if (!published.length) return null;
  const two = (x) => ({ n: significant(x, 2) });
  return section("Measured materials", "Every fifth material of the MERL database, as Löw, Kronander, Ynnerman and Unger published its highlight in 2012 (green, metric E2; doi:10.1145/2077341.2077350), and what GGX and GTR in place of its distribution make of it over the slice to 80°. Of GGX the tail's exponent is 2; smaller is longer. *: gamma ended at its bound.",
    in_cards(table(["material", { n: "core, published" }, { n: "tail, published" }, { n: "Beckmann, published" }, { n: "GGX roughness" }, { n: "residual" }, { n: "GTR roughness" }, { n: "gamma" }, { n: "residual" }],
      published.map((p) => [p.material, two(p.width), two(p.tail), two(p.beckmann), two(p.ggx_roughness), two(p.ggx_log_rms), two(p.gtr_roughness), { n: significant(p.gamma, 2) + (p.gamma_determined ? "" : "*") }, two(p.gtr_log_rms)]))));
}

const how = () => section("How it is made", null,
    el("p", {}, "A slice of directions is synthesized without noise from exact Fresnel facets (dielectric; conductor of measured n and k at three wavelengths) under GGX or GTR with its own Smith masking, height-correlated; of “all orders” light "
      + "that meets several facets is added by random walks. It is fitted as gonio fit does, by the log metric, all parameters free; the form differs from the truth in one term, or in several, or it is a whole model with its diffuse term. "
      + "The exact Fresnel term has its index free, of metals F0 and edge tint. Unreal's F0 of green is held at the true one, Lazányi's n too."),
    el("p", {}, "The slice has theta_h by theta_d at phi_d = 90°, as gonio synth's image_slice has, with theta_h denser towards the highlight, so that each roughness is resolved and all angles of the Fresnel term are there; every bin up to 80° from the normal, to light and viewer, counts the same. "
      + "There NoL = NoV. Other directions weigh other errors: “Metric and directions” compares a slice of three times the bins, the whole slice, a hemisphere of six incident angles, and the metric l2_cosine. Materials: " + materials.join(", ") + "."),
    el("p", {}, "What is shipped without the 1/π of a BRDF (ue_mobile, ue_mobile_simple) is fitted to π times the truth. At roughness 1 the width stands at its bound, where its truth is; forms that would be rougher end there, and are told as such."));
show_report({
  command: "report cross_fit", title: "What fits with shipped approximations make of roughness, F0 and gamma", findings, first: matrices(), wide: true,
  sections: [ranges_by_metric(), over_roughness(), compared(), published_fits(), how()],
  setting: `${full ? "Full" : "Quick"} setting. Every fit, with its status, is in the rows of the .json and .csv beside this page.`,
});
