"use strict";
// The remap report: masking forms of shaders against exact Smith.

const { rows, forms, g1, figures, maps, albedo_error, findings, full } = page_data();
const short = (name) => name.replace(/^masking\./, "");
const by_name = new Map(forms.map((f) => [f.form, f]));
const direct = "masking.schlick_ggx.direct";
const names = forms.map((f) => f.form);
const roughnesses = unique(rows.map((r) => r.roughness)), shown = choices_of(figures, "furnace", "roughness");
const nearest_to = (list, x) => list.reduce((a, b) => (Math.abs(b - x) < Math.abs(a - x) ? b : a));
const kind_of = (reference) => reference.split(".").at(-1);
const rows_of = (form, kind) => rows.filter((r) => r.form === form && kind_of(r.reference) === kind);
const like_text = (r, by) => (r[`like_by_${by}_at_end`] ? (r[`like_by_${by}`] < 0.5 ? "≤ " : "≥ ") : "") + r[`like_by_${by}`].toFixed(2);

most_shipped = ["schlick_ggx.direct", "smith_ggx.correlated", "schlick_ggx.half_alpha", "ue_joint", "smith_ggx.separable", "kelemen", "smith_beckmann.correlated", "schlick_beckmann"];

/// What is looked at in the first section.
const chosen = { form: names.includes(direct) ? direct : names[0], kind: "separable", roughness: nearest_to(shown, 0.3), by: "G2" };
const families = { "ndf.ggx": "GGX", "ndf.beckmann": "Beckmann" };
const form_options = forms.map((f) => [f.form, `${named(f.form)} (${families[f.ndf]})`]);
const kinds = [["separable", "separable"], ["correlated", "correlated"]];

// --- Errors ----------------------------------------------------------------------------------------------
const said_of = (f) => el("p", { class: "small" }, el("code", {}, f.formula), f.ships ? el("span", { class: "muted" }, ` · ${f.ships}`) : null);
const g2_map = (form) => picture_of(maps, "g2", { form });
/// Against the reference, of which it tells G2 too; of the reference itself, its G2.
function error_map(form, smith) {
  const slice = `roughness ${chosen.roughness}`, own = g2_map(form), map = picture_of(maps, "masking_error", { form, reference: chosen.kind });
  return map ? map_view(map, { slice, value_text: (v) => signed_percent(v / 100), say: (k) => [": G2 ", el("b", {}, significant(own.values[k], 4)), ", Smith ", significant(g2_map(smith).values[k], 4)] })
    : map_view(own, { slice });
}
const panels = changing(() => {
  const { form: id, kind: reference, by, roughness } = chosen, form = short(id), distribution = families[by_name.get(id).ndf], emphasis = { emphasis: form, height: 300 };
  const smith = short(rows.find((r) => r.form === id && kind_of(r.reference) === reference).reference);
  return el("div", {}, said_of(by_name.get(id)),
    el("div", { class: "columns map" }, error_map(form, smith), figure_view(picture_of(figures, "furnace", { distribution, roughness }),
      { ...emphasis, y_text: (y) => significant(y, 4), only: (c) => !c.dashed || c.name === smith })),
    el("div", { class: "columns", style: { "margin-top": "22px" } },
      figure_view(picture_of(figures, "behaves_like", { distribution, reference, by }), { ...emphasis, y_text: (y) => y.toFixed(3) }),
      figure_view(picture_of(figures, "rms", { distribution, reference }), emphasis)));
}, () => [el("h3", {}, "The roughness of exact Smith that each is like, by G2"),
  in_cards(table(["", ...shown.map((r) => ({ n: r }))], forms.map((f) => [form_cell(f.form), ...rows_of(f.form, chosen.kind).filter((r) => shown.includes(String(r.roughness))).map((r) => ({ n: like_text(r, "g2") }))])))]);
const change = (key) => (v) => { chosen[key] = v; panels.again(); };
function each_form() {
  return section("How far off, and which roughness it behaves like", "G2 of each form against exact Smith: GGX's forms against Smith for GGX, Beckmann's against Smith for Beckmann. Forms that read the half vector (VoH, NoH) are "
    + "averaged over azimuths between light and view, evenly; the mobile ones, which stand for V F, are taken for masking here. E: under the form's own distribution, F = 1. Behaves like: the roughness "
    + "of exact Smith that is nearest by least squares, from 0.01 to 1 (what lies at an end may lie beyond); by G2, of masking alone, over NoL, NoV in [0.05, 1]²; by E over μ = 0.1 to 1, of distribution and masking "
    + "together. Of smooth surfaces E hardly tells one roughness from another.",
    el("div", { class: "controls" }, chooser("Form", form_options, chosen.form, change("form")), choice("Reference", kinds, chosen.kind, change("kind")),
      chooser("Roughness of map and E", shown.map((r) => [r, r]), chosen.roughness, change("roughness")),
      el("span", {}, "Like by ", choice("Behaves like, by", [["G2", "G2"], ["E", "E"]], chosen.by, change("by")))), panels.node);
}

// --- In the wrong place ----------------------------------------------------------------------------------
function wrong_place() {
  const mus = choices_of(figures, "each_k", "mu");
  if (!mus.length) return null;
  let mu = "0.1";
  const both = changing(() => el("div", { class: "columns" }, ["even", "single"].map((light) =>
    figure_view(picture_of(figures, "each_k", { light, mu }), { y_text: (y) => significant(y, 4) }))),
  () => small_pictures(figures.filter((f) => f.family === "each_k" && f.choices.mu !== mu && ["0.3", "0.5", "1"].includes(f.choices.mu))));
  return section("Each k in the other's place", "k = (r+1)²/8 is meant for single lights, k = r²/2 for image-based light. Each figure shows both, beside exact Smith.",
    el("div", { class: "controls" }, chooser("μ", mus.map((m) => [m, m]), mu, (m) => { mu = m; both.again(); })), both.node,
    el("h3", {}, "Schlick's G1 at NoV 0.1"),
    in_cards(table([{ n: "k" }, { n: "claimed" }, { n: "G1" }, { n: "roughness that it is meant for" }, { n: "exact Smith there" }],
      g1.map((g) => [{ n: plain(g.k) }, { n: plain(g.claimed) }, { n: g.value.toFixed(4) }, { n: plain(g.roughness) }, { n: g.smith.toFixed(4) }]))));
}

// --- In place of V F -------------------------------------------------------------------------------------
function in_place_of_vf() {
  const of_forms = choices_of(figures, "in_place_of_vf", "form"), fresnels = choices_of(figures, "in_place_of_vf", "fresnel");
  if (!of_forms.length) return null;
  let form = of_forms[0], fresnel = fresnels[0];
  const both = changing(() => el("div", { class: "columns" }, ["all", "mirror"].map((over) =>
    figure_view(picture_of(figures, "in_place_of_vf", { form, fresnel, over }), { y_text: (y) => "×" + significant(y, 3) }))),
  () => small_pictures(figures.filter((f) => f.family === "in_place_of_vf" && !(f.choices.form === form && f.choices.fresnel === fresnel))));
  return section("In place of V F", "F0 V of the mobile forms over V F of Smith (correlated) and an exact Fresnel term; 1 is right. V = 1/(4 LoH² (r + 0.5)): the 4 of D F G/(4 NoL NoV), which the publication leaves out, is given back. Cosines from 0.05 to 1 in steps of 0.05.",
    el("div", { class: "controls" }, chooser("Form", of_forms.map((f) => [f, named_short(f)]), form, (f) => { form = f; both.again(); }),
      chooser("Fresnel", fresnels.map((f) => [f, f]), fresnel, (f) => { fresnel = f; both.again(); })), both.node);
}

// --- All of it -------------------------------------------------------------------------------------------
function all_forms() {
  let kind = "correlated", roughness = nearest_to(roughnesses, 0.5);
  const of = (kind, roughness) => {
    const found = forms.map((f) => [f, rows_of(f.form, kind).find((r) => r.roughness === roughness)]).filter(([, r]) => r);
    return in_cards(table(["", { n: "RMS of G2" }, { n: "most, relative" }, "at NoL, NoV", { n: "E(0.5)" }, { n: "Smith's" }, { n: "like r, by G2" }, { n: "by E" }, { n: "operations" }, { n: "roots" }, "reads h", "ships in"],
      found.sort(([a, x], [b, y]) => a.ndf.localeCompare(b.ndf) * -1 || x.rms - y.rms).map(([f, r]) => [form_cell(f.form), { n: significant(r.rms, 2) }, { n: percent(r.max_rel) },
        r.max_rel > 1e-12 ? `${plain(r.max_rel_nol)}, ${plain(r.max_rel_nov)}` : "", { n: r.albedo_mu_0_5.toFixed(4) }, { n: r.albedo_reference.toFixed(4) }, { n: like_text(r, "g2") }, { n: like_text(r, "albedo") },
        { n: String(f.operations) }, { n: String(f.roots) }, f.reads_half ? "yes" : "", el("span", { class: "because small" }, f.ships)])));
  };
  const list = changing(() => of(kind, roughness), () => kinds.filter(([k]) => k !== kind).map(([k, words]) => [el("h3", {}, `Against ${words} Smith, roughness ${plain(roughness)}`), of(k, roughness)]));
  return section("All forms", "From the nearest to the furthest, GGX's first. Operations: of one sample, counted, all kinds alike, roots and divisions among them.",
    el("div", { class: "controls" }, choice("Reference", kinds, kind, (k) => { kind = k; list.again(); }),
      chooser("Roughness", roughnesses.map((r) => [String(r), plain(r)]), String(roughness), (r) => { roughness = Number(r); list.again(); })), list.node,
    el("p", { class: "small muted" }, `RMS and bias by Gauss's rule with 24 × 24 nodes, off by at most ${significant(Math.max(...rows.map((r) => r.rms_error)), 1)} (16 × 16 beside it); the most over steps of 0.025; `
      + `E to ${significant(albedo_error, 1)}.`));
}

const first = picture_of(figures, "behaves_like", { distribution: "GGX", reference: "separable", by: "G2" }) ?? figures[0];
show_report({
  command: "report remap", title: "Masking forms against exact Smith, and which roughness each behaves like", findings, first: first && figure_view(first, { height: 330, copy: true, y_text: (y) => y.toFixed(3) }),
  sections: [each_form(), wrong_place(), in_place_of_vf(), all_forms()],
  setting: `${full ? "Full" : "Quick"} setting. Every figure of this page is in its data block and in the .json beside it.`,
});
