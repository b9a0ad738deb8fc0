"use strict";
// The energy report: what single scattering loses and what gives it back.

const { rows, forms, crossings, truth, costs, findings, full, split_sum_tables, split_sum_light, irradiance, albedo_forms, views, figures, maps } = page_data();
const short = (name) => name.replace(/^(masking|scattering)\./, "");
const mu_text = (mu) => (mu === "average" ? "on average" : Number(mu) === 1 ? "at normal incidence" : `at μ = ${plain(Number(mu))}`);
const degrees_of = (mu) => degrees(Math.acos(mu) * 180 / Math.PI, 0);
const ratio_of = (share) => `${plain(100 * share)}\u202f%`;
const reference = "masking.smith_ggx.correlated";
const roughnesses = unique(rows.map((r) => r.roughness)), mus = unique(rows.map((r) => r.mu));

most_shipped = ["smith_ggx.correlated", "schlick_ggx.direct", "schlick_ggx.half_alpha", "ue_joint", "smith_ggx.separable", "smith_beckmann.correlated", "none"];

// --- The answer ------------------------------------------------------------------------------------------
/// Roughnesses at which the loss exceeds each share, by what and at which angle.
function crossing_table(kind, names, text) {
  const shares = unique(crossings.map((c) => c.share)), angles = unique(crossings.map((c) => c.mu));
  const find = (name, mu, share) => crossings.find((c) => c[kind] === name && c.mu === mu && c.share === share);
  const least = roughnesses[0], most = roughnesses.at(-1);
  const range = ([from, to]) => {
    if (to < most) return (from > least ? from.toFixed(2) + "–" : "up to ") + to.toFixed(2);
    return from > least ? from.toFixed(2) : `≤\u202f${plain(least)}`;
  };
  const said = (c) => (!c || c.ranges.length === 0 ? el("span", { class: "muted" }, "never")
    : el("span", { title: `± ${significant(c.error, 1)}` }, c.ranges.map(range).join(", ")));
  const head = ["", ...angles.flatMap((mu) => shares.map((share) => ({ n: ratio_of(share) })))];
  const top = el("tr", {}, el("th", {}), angles.map((mu) => el("th", { colspan: shares.length, class: "n" }, mu_text(mu))));
  const t = table(head, names.map((name) => [text(name),
    ...angles.flatMap((mu) => shares.map((share) => ({ n: said(find(name, mu, share)) })))]));
  t.classList.add("crossings");
  const told = in_cards(t, ["", ...angles.flatMap((mu) => shares.map((share) => `${ratio_of(share)} ${mu_text(mu)}`))]);
  t.tHead.prepend(top);
  return told;
}
const crossing_note = "Each number is the roughness from which on that much is lost. Where a loss ends again, both ends stand there. “≤ 0.05” means that it is lost on the smoothest surface looked at. The error of each stands under the pointer.";

// --- Every masking ---------------------------------------------------------------------------------------
const of_form = group_by(rows, (r) => r.form);
/// Loss by roughness and angle; where more leaves than came, in the other colour.
const loss_map = (form) => map_view(picture_of(maps, "loss", { form }), { value_text: (v) => percent(v / 100, 3), say: (k) => {
  const c = of_form.get(form)[k];
  return [": E ", el("b", {}, significant(c.albedo, 5)), ` ± ${significant(c.error, 1)} (${degrees_of(c.mu)} from the normal)`];
} });
const albedo_curves = (form) => figure_view(picture_of(figures, "albedo", { form }), { height: 290, y_text: (y) => significant(y, 4) });
const averages = (form) => figure_view(picture_of(figures, "average_loss"), { height: 290, emphasis: short(form), y_text: (y) => percent(y / 100, 3) });
function maskings() {
  let name = reference;
  const panels = changing(() => el("div", {},
    el("div", { class: "columns map" }, loss_map(name), albedo_curves(name)), averages(name)));
  const groups = forms.map((f) => [f.form, named(f.form) + (f.model ? " (whole model)" : "")]);
  return section("Every masking form", "At F = 1 a form should give all back: E = 1. Beckmann's forms stand under Beckmann, Smith for GTR under GTR of that gamma, the coat's under GTR of gamma 1 "
    + "with alpha up to 0.1, as it ships, all others under GGX. Whole mobile models in white, their clamps included; those that are π times a BRDF, divided by π.",
    el("div", { class: "controls" }, chooser("Form", groups, name, (n) => { name = n; panels.again(); })), panels.node,
    el("h3", {}, "Where each loses more than 1, 5, 10 %, by roughness"), el("p", { class: "small muted" }, crossing_note),
    crossing_table("form", forms.map((f) => f.form), form_cell));
}

// --- Bounces ---------------------------------------------------------------------------------------------
const materials = unique(truth.map((t) => t.material));
function bounces() {
  if (!materials.length) return null;
  let material = materials[0], mu = "average";
  const angles = unique(truth.map((t) => t.mu));
  const panels = changing(() => el("div", { class: "columns" },
    figure_view(picture_of(figures, "bounces", { material, angle: mu }), { height: 280, y_text: (y) => significant(y, 4) }),
    figure_view(picture_of(figures, "beyond", { material, angle: mu }), { height: 280, y_text: (y) => percent(y / 100, 3) })),
  () => small_pictures(figures.filter((f) => f.family === "bounces" && f.choices.angle === String(mu) && f.choices.material !== material)));
  return section("Bounce by bounce", "GGX's microsurface with heights and slopes as Smith's masking assumes them, light followed to the end: the deterministic solution, to " + significant(Math.max(...truth.map((t) => t.error)), 1) + ".",
    el("div", { class: "controls" }, chooser("Material", materials.map((m) => [m, m]), material, (m) => { material = m; panels.again(); }),
      chooser("Angle", angles.map((a) => [String(a), mu_text(a)]), "average", (a) => { mu = a; panels.again(); })), panels.node);
}

// --- Compensations -----------------------------------------------------------------------------------------
function compensations() {
  const angles = choices_of(figures, "compensation", "angle");
  if (!angles.length) return null;
  let material = materials.find((m) => m.startsWith("gold")) ?? materials[0], mu = "0.5", without = false;
  const panels = changing(() => {
    const o = { height: 280, y_text: (y) => minus(y.toFixed(5)), only: (c) => without || c.name !== "single" };
    return el("div", { class: "columns" }, figure_view(picture_of(figures, "compensation", { material, angle: mu }), o),
      figure_view(picture_of(figures, "compensation_by_angle", { material }), o));
  }, () => small_pictures(figures.filter((f) => f.family === "compensation" && f.choices.angle === String(mu) && f.choices.material !== material)));
  const cost_rows = costs.map((c) => [form_cell(c.scattering), { n: significant(c.rms, 2) }, { n: significant(c.worst, 2) }, c.worst_at, { n: significant(c.gold_rms, 2) },
    { n: String(c.operations) }, { n: String(c.lookups) }, { n: c.bytes ? count(c.bytes) : "0" }, { n: `${significant(c.cost_ns, 2)} ± ${significant(c.spread_ns, 1)}` }, { n: significant(c.without_ns, 2) }]);
  return section("What gives it back", "Albedo of each compensation less the truth: the deterministic solution of all bounces, exact to " + significant(Math.max(...truth.map((t) => t.error)), 1) + ". Below 0 light is still missing, above it there is too much.",
    el("div", { class: "controls" }, chooser("Material", materials.map((m) => [m, m]), material, (m) => { material = m; panels.again(); }),
      chooser("Angle", angles.map((a) => [String(a), mu_text(a)]), "0.5", (a) => { mu = a; panels.again(); }),
      choice("Curves", [[false, "compensations"], [true, "and single scattering"]], without, (v) => { without = v; panels.again(); })), panels.node,
    el("h3", {}, "Error and cost"),
    in_cards(table(["", { n: "RMS error" }, { n: "worst" }, "worst at", { n: "RMS, gold" }, { n: "operations" }, { n: "lookups" }, { n: "table bytes" }, { n: "ns" }, { n: "ns without" }], cost_rows)),
    el("p", { class: "small muted" }, "Errors over Schlick's Fresnel with F0 of 0.04, 0.5, 0.9 and 1, roughness and mu from 0.1 to 1, with the tables that a shader reads; of gold, by its spectrum, beside them. Operations: of the formula for one channel, counted. Table bytes: 32 × 32 in half. ns: D V F of GGX for one light and view with the compensation (of fdez_aguera, which stands on the split sum: F0 A + B), "
      + "beside the same without; one at a time, in float, on one thread, median ± half the distance of the quartiles. fdez_aguera is for Schlick's Fresnel alone."));
}

/// E(α, NoV) at F = 1 as a shader may have it.
function albedo_formulas() {
  if (!albedo_forms.length) return null;
  return section("E as a formula", "What compensations look up, E of GGX under Smith, correlated, F = 1: without a table by a fit. Errors against quadrature over roughness 0.05 to 1 and NoV 0.005 to 1.",
    in_cards(table(["", { n: "RMS error" }, { n: "worst" }, "worst at", { n: "operations" }, { n: "table bytes" }],
      albedo_forms.map((f) => [form_cell(f.form), { n: significant(f.rms, 2) }, { n: significant(f.worst, 2) }, f.worst_at, { n: f.operations ? String(f.operations) : "–" }, { n: f.bytes ? count(f.bytes) : "0" }]))));
}

// --- Error against time --------------------------------------------------------------------------------------
function against_time() {
  const cases = figures.filter((f) => f.family === "estimators");
  if (!cases.length) return null;
  return section("What a digit of E costs", "One E(μ, α) of GGX under Smith masking, correlated, F = 1, on one thread. Deterministic ones: the error that was made, asked for one digit after the other; the truth is known to 1e-13: what is nearer is drawn there. "
    + "Estimators by chance: the RMS error of independent repeats.",
    el("div", { class: "panels" }, cases.map((f) => figure_view(f, { height: 320, x_text: (x) => significant(x, 2), y_text: (y) => significant(y, 2) }))));
}

// --- Image-based light --------------------------------------------------------------------------------------
function split_sum() {
  if (!split_sum_tables.length) return null;
  const tables = in_cards(table(["texels", "stored as", { n: "lookup, most" }, { n: "RMS" }, { n: "between centres, most" }, { n: "storage, most" }, { n: "quadrature" }],
    split_sum_tables.map((t) => [`${t.size} × ${t.size}`, t.stored, { n: significant(t.lookup_max, 2) }, { n: significant(t.lookup_rms, 2) },
      { n: significant(t.between_centres_max, 2) }, { n: significant(t.storage_max, 2) }, { n: "± " + significant(t.bound, 1) }])));
  const samples = figure_view(picture_of(figures, "split_sum_samples"), { height: 280, y_text: (y) => significant(y, 2) });
  const light = [...group_by(split_sum_light, (l) => l.environment)].map(([name, list]) => in_cards(table(
    [name, ...unique(list.map((l) => l.nov)).flatMap((nov) => unique(list.map((l) => l.f0)).map((f0) => ({ n: `NoV ${plain(nov)}, F0 ${plain(f0)}` })))],
    unique(list.map((l) => l.roughness)).map((r) => [`roughness ${plain(r)}`, ...list.filter((l) => l.roughness === r).map((l) => ({ n: el("span", { title: `most ΔE ${significant(l.delta_e_2000_max, 2)}; luminance of each view: RMS ${percent(l.rms)}, most ${percent(l.max)}, bias ${signed_percent(l.bias)}; RMS over the mean ${percent(l.of_mean)} ± ${percent(l.of_mean_spread, 1)}; truth to ${percent(l.truth_error)}` }, significant(l.delta_e_2000, 2)) }))]))));
  return section("The split sum", "GGX under Smith, correlated, and Schlick: E = F0 A + B of an even environment. Errors of A + B after bilinear lookup over all NoV and roughness.",
    tables, el("div", { class: "panels" }, samples),
    el("h3", {}, "Under an environment"),
    [el("p", { class: "small muted" }, `ΔE2000 between the split sum and the integral, as a display shows them with a white ball at half of its white: the mean over ${views} views. The split takes n = v = r, so at grazing angles its lobe has the wrong shape. The greatest difference, and that of the luminance, stand under the pointer. Skies are made by formula; maps of your own come with --environment FILE.`), ...light]);
}
function irradiances() {
  const views_of = (family) => el("div", { class: "panels" }, figures.filter((f) => f.family === family).map((f) => figure_view(f, { height: 260, y_text: (y) => percent(y / 100) })));
  if (!irradiance.length) return null;
  return section("Diffuse irradiance", "∫ L cos θ dω over the hemisphere by the sums that renderers take, relative to the exact value, RMS over normals.",
    el("h3", {}, "Against samples"), views_of("irradiance_by_samples"), el("h3", {}, "Against time"), views_of("irradiance_by_time"));
}

const first = picture_of(figures, "average_loss") ?? figures[0];
show_report({
  command: "report energy", title: "What single scattering loses, and what gives it back", findings, first: first && figure_view(first, { height: 330, copy: true, y_text: (y) => percent(y / 100, 3) }),
  sections: [
    materials.length ? section("From which roughness on does it matter?", "GGX under Smith masking, correlated: the roughness from which on more than 1, 5, 10 % of what should leave is missing, by material and angle. " + crossing_note,
      crossing_table("material", materials, (m) => m)) : null,
    maskings(), bounces(), compensations(), albedo_formulas(), against_time(), split_sum(), irradiances()],
  setting: `${full ? "Full" : "Quick"} setting. Every figure of this page is in its data block and in the .json beside it.`,
});
