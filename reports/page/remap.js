"use strict";
// The remap report: masking forms of shaders against exact Smith.

const { rows, forms, mu, cosines, albedo, maps, uses, g1, vf, findings, full } = page_data();
const short = (name) => name.replace(/^masking\./, "");
const by_name = new Map(forms.map((f) => [f.form, f]));
const direct = "masking.schlick_ggx.direct", image = "masking.schlick_ggx.half_alpha";
const names = forms.map((f) => f.form);
const roughnesses = unique(rows.map((r) => r.roughness)), shown = unique(maps.map((m) => m.roughness));
const nearest_to = (list, x) => list.reduce((a, b) => (Math.abs(b - x) < Math.abs(a - x) ? b : a));
const references_of = (form) => unique(rows.filter((r) => r.form === form).map((r) => r.reference));
const kind_of = (reference) => reference.split(".").at(-1);
const rows_of = (form, kind) => rows.filter((r) => r.form === form && kind_of(r.reference) === kind);
const like_text = (r, by) => (r[`like_by_${by}_at_end`] ? (r[`like_by_${by}`] < 0.5 ? "≤ " : "≥ ") : "") + r[`like_by_${by}`].toFixed(2);

/// What is looked at in the first section.
const chosen = { form: names.includes(direct) ? direct : names[0], kind: "separable", roughness: nearest_to(shown, 0.3), by: "g2" };
const families = { "ndf.ggx": "GGX", "ndf.beckmann": "Beckmann" };
const form_options = forms.map((f) => [f.form, `${short(f.form)} (${families[f.ndf]})`]);
const kinds = [["separable", "separable"], ["correlated", "correlated"]];

// --- Errors ----------------------------------------------------------------------------------------------
const g2_of = (form, roughness) => maps.find((m) => m.form === form && m.roughness === roughness)?.g2;
function error_map() {
  const reference = references_of(chosen.form).find((r) => kind_of(r) === chosen.kind);
  const g = g2_of(chosen.form, chosen.roughness), smith = g2_of(reference, chosen.roughness);
  if (!g || !smith) return el("p", { class: "muted" }, "The reference was not measured.");
  const off = g.map((v, k) => v / smith[k] - 1), most = Math.max(...off.map(Math.abs));
  const limit = [0.001, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 100].find((l) => l >= most) ?? 1000;
  const at = (v) => (Math.max(-limit, Math.min(limit, v)) + limit) / (2 * limit);
  return heat_map(unit_axis("NoL", "NoL", cosines), unit_axis("NoV", "NoV", cosines),
    { error: { at: (k) => at(off[k]), colors: () => diverging(), label: "G2 / Smith − 1; below 0 it masks too much",
      ticks: [-limit, -limit / 2, 0, limit / 2, limit].map((v) => [at(v), minus(`${plain(100 * v)}\u202f%`)]) } },
    (k) => ["G2 ", el("b", {}, significant(g[k], 4)), ", Smith ", significant(smith[k], 4), ", error ", el("b", {}, signed_percent(off[k]))],
    `Relative error of ${chosen.form} against ${reference} at roughness ${chosen.roughness}, by NoL and NoV; at most ${percent(most)}.`).node;
}
/// All forms in grey, the chosen one in colour.
function all_curves(value, o) {
  const curve = (name) => { const list = rows_of(name, chosen.kind); return { x: list.map((r) => r.roughness), y: list.map(value) }; };
  return lines_figure([...names.filter((n) => n !== chosen.form && by_name.get(n).ndf === by_name.get(chosen.form).ndf)
      .map((n) => ({ name: short(n), ...curve(n), color: "rule", width: 1, quiet: true })), ...(o.beside ?? []),
    { name: short(chosen.form), ...curve(chosen.form), color: "accent", width: 2.2 }],
    { x_label: "roughness", x_ends: [0, 1], height: 300, ...o });
}
const rms_curves = () => all_curves((r) => Math.max(r.rms, 1e-9), { title: "RMS of G2 − Smith", note: "over NoL, NoV in [0.05, 1]²; grey: the other forms of the family", y_label: "RMS", scale: true,
  text: `RMS error of ${chosen.form} over roughness.`, y_text: (y) => significant(y, 3) });
function albedo_curves() {
  const reference = references_of(chosen.form).find((r) => kind_of(r) === chosen.kind);
  const curve = (name) => { const a = albedo.find((x) => x.form === name && x.roughness === chosen.roughness); return a ? { x: mu, y: a.albedo } : { x: [], y: [] }; };
  return lines_figure([{ name: `Smith, ${chosen.kind}`, ...curve(reference), color: "ink", dash: [5, 3] }, { name: short(chosen.form), ...curve(chosen.form), color: "accent", width: 2.2 }],
    { title: "Furnace: E(μ) at F = 1", note: `roughness ${plain(chosen.roughness)}`, x_label: "μ", y_label: "E", x_ends: [0, 1], height: 300,
      text: `Directional albedo of ${chosen.form} and of its reference over the cosine.`, y_text: (y) => significant(y, 4) });
}
const by_text = { g2: "its G2", albedo: "its E" };
const shift_curves = () => all_curves((r) => r[`like_by_${chosen.by}`], { title: "Behaves like roughness …", note: `of exact Smith, by ${by_text[chosen.by]}; grey: the other forms`, y_label: "behaves like",
  text: `Roughness of exact Smith that ${chosen.form} is nearest to.`, y_text: (y) => y.toFixed(3), beside: [{ name: "as it should", x: roughnesses, y: roughnesses, color: "ink", dash: [5, 3] }] });
const said_of = (f) => el("p", { class: "small" }, el("code", {}, f.formula), f.ships ? el("span", { class: "muted" }, ` · ${f.ships}`) : null);
const panels = changing(() => el("div", {}, said_of(by_name.get(chosen.form)),
  el("div", { class: "columns map" }, el("figure", {}, el("figcaption", {}, "Relative error of G2 ", el("small", {}, `${short(chosen.form)}, roughness ${plain(chosen.roughness)}`)), error_map()),
    albedo_curves()), el("div", { class: "columns", style: { "margin-top": "22px" } }, shift_curves(), rms_curves())));
const change = (key, convert = (v) => v) => (v) => { chosen[key] = convert(v); panels.again(); };
function each_form() {
  return section("How far off, and which roughness it behaves like", "G2 of each form against exact Smith: GGX's forms against Smith for GGX, Beckmann's against Smith for Beckmann. Forms that read the half vector (VoH, NoH) are "
    + "averaged over azimuths between light and view, evenly; the mobile ones, which stand for V F, are taken for masking here. E: under the form's own distribution, F = 1. Behaves like: the roughness "
    + "of exact Smith that is nearest by least squares, from 0.01 to 1 (what lies at an end may lie beyond); by G2, of masking alone, over NoL, NoV in [0.05, 1]²; by E over μ = 0.1 to 1, of distribution and masking "
    + "together. Of smooth surfaces E hardly tells one roughness from another.",
    el("div", { class: "controls" }, chooser("Form", form_options, chosen.form, change("form")), choice("Reference", kinds, chosen.kind, change("kind")),
      chooser("Roughness of map and E", shown.map((r) => [String(r), plain(r)]), String(chosen.roughness), change("roughness", Number)),
      el("span", {}, "Like by ", choice("Behaves like, by", [["g2", "G2"], ["albedo", "E"]], chosen.by, change("by")))), panels.node);
}

// --- In the wrong place ----------------------------------------------------------------------------------
function wrong_place() {
  if (!uses.length) return null;
  let at = 0.1;
  const figure = (light, title, note) => {
    const of = (form) => uses.filter((u) => u.light === light && u.form === form && u.mu === at);
    const curve = (list, key) => ({ x: list.map((u) => u.roughness), y: list.map((u) => u[key]) });
    const any = of(direct).length ? of(direct) : of(image);
    return lines_figure([{ name: "k = (r+1)²/8", ...curve(of(direct), "value"), color: "red" }, { name: "k = r²/2", ...curve(of(image), "value"), color: "accent" },
      { name: "Smith, separable", ...curve(any, "separable"), color: "ink", dash: [5, 3] }, { name: "correlated", ...curve(any, "correlated"), color: "muted", dash: [2, 3] }],
      { title, note, x_label: "roughness", y_label: light === "even" ? "E" : "G2", x_ends: [0, 1], height: 300, text: `${title} of either k and of exact Smith over roughness.`, y_text: (y) => significant(y, 4) });
  };
  const both = changing(() => el("div", { class: "columns" }, figure("even", "Even environment", "E at F = 1"), figure("single", "A single light in the mirror direction", "G2, NoL = NoV = μ")));
  return section("Each k in the other's place", "k = (r+1)²/8 is meant for single lights, k = r²/2 for image-based light. Each figure shows both, beside exact Smith.",
    el("div", { class: "controls" }, chooser("μ", mu.map((m) => [String(m), plain(m)]), String(at), (m) => { at = Number(m); both.again(); })), both.node,
    el("h3", {}, "Schlick's G1 at NoV 0.1"),
    scroll(table([{ n: "k" }, { n: "claimed" }, { n: "G1" }, { n: "roughness of (r+1)²/8" }, { n: "exact Smith there" }],
      g1.map((g) => [{ n: plain(g.k) }, { n: plain(g.claimed) }, { n: g.value.toFixed(4) }, { n: plain(g.roughness) }, { n: g.smith.toFixed(4) }]))));
}

// --- In place of V F -------------------------------------------------------------------------------------
function in_place_of_vf() {
  if (!vf.length) return null;
  const fresnels = unique(vf.map((v) => v.fresnel)), of_forms = unique(vf.map((v) => v.form));
  let form = of_forms[0], fresnel = fresnels[0];
  const both = changing(() => el("div", { class: "columns" }, [["all", "All directions", "azimuths even"], ["mirror", "Mirror direction", "h = n"]].map(([over, title, note]) => {
    const list = vf.filter((v) => v.form === form && v.fresnel === fresnel && v.over === over), x = list.map((v) => v.roughness);
    return lines_figure([{ name: "geometric mean", x, y: list.map((v) => v.bias), color: "accent", width: 2.2 }, { name: "least", x, y: list.map((v) => v.least), color: "muted", dash: [5, 3] },
      { name: "most", x, y: list.map((v) => v.most), color: "muted" }],
      { title, note, x_label: "roughness", y_label: "ratio", x_ends: [0, 1], log: true, scale: true, height: 300, text: `${form} over V F, ${title}.`, y_text: (y) => "×" + significant(y, 3) });
  })));
  return section("In place of V F", "F0 V of the mobile forms over V F of Smith (correlated) and an exact Fresnel term; 1 is right. V = 1/(4 LoH² (r + 0.5)): the 4 of D F G/(4 NoL NoV), which the publication leaves out, is given back. Cosines from 0.05 to 1 in steps of 0.05.",
    el("div", { class: "controls" }, chooser("Form", of_forms.map((f) => [f, short(f)]), form, (f) => { form = f; both.again(); }),
      chooser("Fresnel", fresnels.map((f) => [f, f]), fresnel, (f) => { fresnel = f; both.again(); })), both.node);
}

// --- All of it -------------------------------------------------------------------------------------------
function all_forms() {
  let kind = "correlated", roughness = nearest_to(roughnesses, 0.5);
  const list = changing(() => {
    const found = forms.map((f) => [f, rows_of(f.form, kind).find((r) => r.roughness === roughness)]).filter(([, r]) => r);
    return scroll(table(["", { n: "RMS of G2" }, { n: "most, relative" }, "at NoL, NoV", { n: "E(0.5)" }, { n: "Smith's" }, { n: "like r, by G2" }, { n: "by E" }, { n: "operations" }, { n: "roots" }, "reads h", "ships in"],
      found.sort(([a, x], [b, y]) => a.ndf.localeCompare(b.ndf) * -1 || x.rms - y.rms).map(([f, r]) => [el("code", {}, short(f.form)), { n: significant(r.rms, 2) }, { n: percent(r.max_rel) },
        r.max_rel > 1e-12 ? `${plain(r.max_rel_nol)}, ${plain(r.max_rel_nov)}` : "", { n: r.albedo_mu_0_5.toFixed(4) }, { n: r.albedo_reference.toFixed(4) }, { n: like_text(r, "g2") }, { n: like_text(r, "albedo") },
        { n: String(f.operations) }, { n: String(f.roots) }, f.reads_half ? "yes" : "", el("span", { class: "because small" }, f.ships)])));
  });
  return section("All forms", "From the nearest to the furthest, GGX's first. Operations: of one sample, counted, all kinds alike, roots and divisions among them.",
    el("div", { class: "controls" }, choice("Reference", kinds, kind, (k) => { kind = k; list.again(); }),
      chooser("Roughness", roughnesses.map((r) => [String(r), plain(r)]), String(roughness), (r) => { roughness = Number(r); list.again(); })), list.node,
    el("p", { class: "small muted" }, `RMS and bias by Gauss's rule with 24 × 24 nodes, off by at most ${significant(Math.max(...rows.map((r) => r.rms_error)), 1)} (16 × 16 beside it); the most over steps of 0.025; `
      + `E to ${significant(Math.max(...albedo.map((a) => a.error)), 1)}.`));
}

document.getElementById("page").replaceChildren(...[
  el("p", { class: "over" }, "gonio report remap"), el("h1", {}, "Masking forms against exact Smith, and which roughness each behaves like"),
  el("div", { class: "verdict" }, findings.map((f) => el("p", {}, f))),
  each_form(), wrong_place(), in_place_of_vf(), all_forms(),
  el("footer", {}, `${full ? "Full" : "Quick"} setting. Every figure of this page is in its data block and in the .json beside it.`)].filter(Boolean));
