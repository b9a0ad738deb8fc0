"use strict";
// Scenes: which effects a material needs under a light, and what leaving out the others saves.

const { rows, effects, left_out, front, spheres, figures, maps, findings, quantile, limit, max, confidence, full } = page_data();
const materials = unique(rows.map((r) => r.material)), lights = unique(rows.map((r) => r.light));
const capital = (text) => text[0].toUpperCase() + text.slice(1);
const times = (x) => `${x < 9.95 ? x.toFixed(1) : x.toFixed(0)}\u202f×`;
const found = (list, material, light) => list.find((r) => r.material === material && r.light === light);
const delta = (x) => (x < 0.005 ? "0" : significant(x, 2));

// --- The plans ---------------------------------------------------------------------------------------------------------
function plans() {
  const cell = (material, light) => {
    const r = found(rows, material, light);
    return r ? el("span", {}, el("b", {}, times(r.speedup_float)), el("span", { class: "small muted" }, ` ${times(r.speedup)} from double`), el("small", {}, r.kept ? capital(r.kept) : "Nothing")) : null;
  };
  const node = section("What to keep, and how much faster that is", `In bold, how many times as fast as everything on, both in float; beside it, against everything on in double; below it, what stays on. All else is off, and nobody sees it: ΔE2000 is at most ${limit} at ${percent(quantile)} of the points, and at most ${max} anywhere.`,
    told_by_cell(["", ...lights.map(capital)], materials.map((m) => [capital(m), ...lights.map((l) => cell(m, l))])));
  node.id = "plans";
  return node;
}

// --- Pictures ----------------------------------------------------------------------------------------------------------
function triple(p) {
  const of = `${p.material} under ${p.light}`;
  const shown = (png, how) => el("img", { class: "sphere", width: p.pixels, height: p.pixels, src: `data:image/png;base64,${png}`, alt: `${of}, ${how}` });
  return el("figure", {}, el("figcaption", {}, capital(p.light), el("span", {}, `, ΔE up to ${delta(p.worst)}`)),
    el("div", { class: "sphere-row" }, shown(p.everything, "everything on"), shown(p.planned, "as planned"), difference_picture(p.difference, p.pixels, { steps: 50, limit, max }, `${of}, difference`)));
}
function pictures() {
  const key = (name) => el("span", { class: "step", style: { background: `var(--${name})` } });
  const all = materials.map((m) => el("div", { class: "spheres" }, el("h3", {}, capital(m)), spheres.filter((p) => p.material === m).map(triple)));
  const node = section("All effects, as planned, and the difference", null, el("p", { class: "small keys" },
    el("span", {}, key("zero"), "no difference"), el("span", {}, key("rms-1"), `ΔE2000 ${limit}, hardly seen`), el("span", {}, key("high-1"), `above ${limit}, seen side by side`), el("span", {}, key("high-2"), `${max}`)), ...all);
  return node;
}

// --- Where the time goes --------------------------------------------------------------------------------------------------
function shares() {
  const parts = [["accent", "stays", (r) => r.ns_float], ["rms-1", "nobody sees it under this light", (r) => r.ns_present_float - r.ns_float],
    ["rule", "the material has not got it", (r) => r.ns_exact_float - r.ns_present_float]];
  const lines = rows.map((r, i) => el("div", { class: i && r.material !== rows[i - 1].material ? "first" : null },
    el("span", {}, `${capital(r.material)}, ${r.light}`),
    el("span", { class: "of" }, parts.map(([colour, text, of]) => el("span", { title: text, style: { background: `var(--${colour})`, width: `${100 * Math.max(0, of(r)) / r.ns_exact_float}%` } }))),
    el("span", { class: "small muted" }, `${significant(r.ns_exact_float, 2)} → ${significant(r.ns_float, 2)} ns`)));
  return section("Where the saving comes from", `Time of one direction of light in float, as parts of that of everything on. Double takes ${times(median(rows.map((r) => r.ns_exact / r.ns_exact_float)))} that time; against it the plans are ${times(Math.min(...rows.map((r) => r.speedup)))} to ${times(Math.max(...rows.map((r) => r.speedup)))} as fast.`,
    el("p", { class: "small keys" }, parts.map(([colour, text]) => el("span", {}, el("span", { class: "step", style: { background: `var(--${colour})` } }), text))), el("div", { class: "shares" }, lines));
}
const median = (list) => { const s = [...list].sort((a, b) => a - b); return s[s.length >> 1]; };

// --- One material ------------------------------------------------------------------------------------------------------
const why_words = { structural: "it has none", proved: "by proof", measured: "measured" };
function one_material() {
  let material = materials.includes("red plastic") ? "red plastic" : materials[0], light = lights[0];
  const body = changing(() => {
    const list = effects.filter((e) => e.material === material && e.light === light), row = found(rows, material, light);
    const figure = picture_of(figures, "front", { material, light });
    return el("div", {}, el("div", { class: "controls" },
      chooser("Material", materials.map((m) => [m, m]), material, (m) => { material = m; body.again(); }),
      choice("Light", lights.map((l) => [l, l]), light, (l) => { light = l; body.again(); })),
    told_by_cell(["effect", "here", { n: "ΔE2000 if dropped" }, { n: "ns saved" }, { n: "operations saved" }, "why"],
      [...list].sort((a, b) => b.keep - a.keep || (a.why === "structural") - (b.why === "structural")).map((e) => [capital(e.name),
        e.keep ? el("span", { class: "verdict-yes" }, e.keeps === e.name ? "keep" : `keep ${e.keeps}`) : e.why === "structural" ? el("span", { class: "muted" }, "absent") : "drop",
        { n: e.why === "structural" ? "0" : (e.why === "proved" ? "≤ " : "") + delta(e.error_if_dropped) }, { n: significant(e.ns_saved, 2) }, { n: count(Math.round(e.ops_saved)) },
        el("span", { class: "muted" }, e.why === "structural" ? e.reason : why_words[e.why])])),
    row ? el("p", { class: "small verification" }, `On ${count(row.samples)} fresh points ${many(row.exceeding, "point")} lie beyond ΔE2000 ${limit}; with a confidence of ${percent(confidence)} that is less than ${percent(row.upper_bound)} of all. The plan is `, el("code", {}, row.spec), ".") : null,
    figure ? el("div", { class: "front" }, figure_view(figure, { height: 320 })) : null);
  });
  const node = section("One material: keep, drop, and why", "Each effect dropped alone, all others exact and in double. Errors do not add, so the plan's set is measured as a whole.", body.node);
  node.id = "effects";
  return node;
}

// --- Maps --------------------------------------------------------------------------------------------------------------
function switches() {
  const all = maps.filter((m) => m.family === "switches_on");
  if (!all.length) return null;
  const node = section("Where an effect switches on", `One light, from beside the viewer (0°) round to the back, and every roughness. The line is ΔE2000 ${limit} at ${percent(quantile)} of the points: beyond it the effect is seen.`,
    el("div", { class: "panels" }, all.map((m) => map_view(m, { value_text: delta }))));
  node.id = "switches";
  return node;
}

const how = () => section("How it is measured", null, el("ul", { class: "findings" },
    el("li", {}, "Front light: three lights on the viewer's side. Rim light: one of these, and two from behind the sphere. Sky and sun: an even sky over a darker ground, and a small bright sun."),
    el("li", {}, "The points are drawn evenly over the picture of a sphere; for every second one, the nearest to a highlight of four is likely to be taken."),
    el("li", {}, "Everything on is one surface with each effect in its exact form, in double, whether the material has it or not, as in a shader for all materials."),
    el("li", {}, "Times are of column kernels, composed on both sides: nothing is fused for the plan alone."),
    el("li", {}, `A plan is chosen on one set of points, checked on a second, and verified here on a third of ${count(rows[0]?.samples ?? 0)}.`)));
const left_out_of_asset = () => (left_out.length ? section("Left out of the asset", null, el("dl", { class: "pairs" }, left_out.map((m) => [el("dt", {}, m.material), el("dd", {}, m.why)]))) : null);
/// The material whose needs change with the light.
const told = spheres.filter((p) => p.material === (materials.includes("red plastic") ? "red plastic" : materials[0])).slice(0, 2);
show_report({
  command: "report scenes", title: "Only what the scene needs", findings, first: told.length ? el("div", { class: "spheres picture" }, el("h3", {}, `${capital(told[0].material)}: everything on, as planned, and the difference`), told.map(triple)) : null,
  sections: [plans(), pictures(), shares(), one_material(), switches(), how(), left_out_of_asset()],
  setting: `${full ? "Full" : "Quick"} setting. Every figure of this page is in its data block and in the .json beside it.`,
});
