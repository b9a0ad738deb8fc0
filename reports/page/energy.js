"use strict";
// The energy report: what single scattering loses and what gives it back.

const { rows, forms, crossings, truth, compensation, costs, estimators, findings, full, split_sum_tables, split_sum_samples, split_sum_light, irradiance, albedo_forms, views } = page_data();
const short = (name) => name.replace(/^(masking|scattering)\./, "");
const mu_text = (mu) => (mu === "average" ? "on average" : mu === 1 ? "at normal incidence" : `at μ = ${plain(mu)}`);
const degrees_of = (mu) => degrees(Math.acos(mu) * 180 / Math.PI, 0);
const ratio_of = (share) => `${plain(100 * share)}\u202f%`;
const reference = "masking.smith_ggx.correlated";
const roughnesses = unique(rows.map((r) => r.roughness)), mus = unique(rows.map((r) => r.mu));

// --- The answer ------------------------------------------------------------------------------------------
/// Roughnesses at which the loss exceeds each share, by what and at which angle.
function crossing_table(kind, names, text) {
  const shares = unique(crossings.map((c) => c.share)), angles = unique(crossings.map((c) => c.mu));
  const find = (name, mu, share) => crossings.find((c) => c[kind] === name && c.mu === mu && c.share === share);
  const least = roughnesses[0], most = roughnesses.at(-1);
  const range = ([from, to]) => {
    if (to < most) return (from > least ? from.toFixed(2) : "") + "–" + to.toFixed(2);
    return from > least ? from.toFixed(2) : `≤\u202f${plain(least)}`;
  };
  const said = (c) => (!c || c.ranges.length === 0 ? el("span", { class: "muted" }, "never")
    : el("span", { title: `± ${significant(c.error, 1)}` }, c.ranges.map(range).join(", ")));
  const head = ["", ...angles.flatMap((mu) => shares.map((share) => ({ n: ratio_of(share) })))];
  const top = el("tr", {}, el("th", {}), angles.map((mu) => el("th", { colspan: shares.length, class: "n" }, mu_text(mu))));
  const t = table(head, names.map((name) => [el("code", {}, text(name)),
    ...angles.flatMap((mu) => shares.map((share) => ({ n: said(find(name, mu, share)) })))]));
  t.classList.add("crossings");
  t.tHead.prepend(top);
  return scroll(t);
}
const crossing_note = "A single number: from there on, up to roughness 1. Two: from one to the other. ≤ 0.05: at the least roughness looked at already. What each is uncertain by is under the pointer.";

// --- Every masking ---------------------------------------------------------------------------------------
const of_form = group_by(rows, (r) => r.form);
/// Loss by roughness and angle; where more leaves than came, in the other colour.
function loss_map(name) {
  const list = of_form.get(name), roughnesses = unique(list.map((c) => c.roughness));
  const x = unit_axis("roughness", "roughness", roughnesses), y = unit_axis("mu", "μ = cos θ", mus);
  const cells = roughnesses.flatMap((r) => mus.map((mu) => list.find((c) => c.roughness === r && c.mu === mu)));
  const limit = [0.1, 0.25, 0.5, 1, 2, 5, 10, 100].find((l) => l >= Math.max(...cells.map((c) => Math.abs(c.loss)))) ?? 100;
  const at = (v) => (v + limit) / (2 * limit);
  return heat_map(x, y, { loss: { at: (k) => at(cells[k].loss), colors: () => diverging(), label: "1 − E; below 0 light is made",
    ticks: [-limit, -limit / 2, 0, limit / 2, limit].map((v) => [at(v), ratio_of(v).replace("-", "−")]) } },
    (k) => ["E ", el("b", {}, significant(cells[k].albedo, 5)), ` ± ${significant(cells[k].error, 1)}, loss `, el("b", {}, percent(cells[k].loss, 3)),
      ` (${degrees_of(cells[k].mu)} from the normal)`],
    `Loss 1 − E of ${name} by roughness and cosine; most ${percent(Math.max(...cells.map((c) => c.loss)), 3)}, least ${percent(Math.min(...cells.map((c) => c.loss)), 3)}.`).node;
}
function albedo_curves(name) {
  const list = of_form.get(name), roughnesses = unique(list.map((c) => c.roughness));
  const shown = [0.1, 0.3, 0.5, 0.7, 0.85, 1].map((r) => roughnesses.reduce((a, b) => (Math.abs(b - r) < Math.abs(a - r) ? b : a)));
  return lines_figure(unique(shown).map((r) => {
    const at = list.filter((c) => c.roughness === r);
    return { name: `r = ${plain(r)}`, x: at.map((c) => c.mu), y: at.map((c) => c.albedo) };
  }), { title: "E(μ)", note: "F = 1: what is missing to 1, masking took", x_label: "μ", y_label: "E", x_ends: [0, 1], height: 290,
        text: `Directional albedo of ${name} over the cosine for several roughnesses.`, y_text: (y) => significant(y, 4) });
}
function averages(name) {
  const curve = (n) => { const first = of_form.get(n).filter((c) => c.mu === mus[0]); return { x: first.map((c) => c.roughness), y: first.map((c) => 1 - c.average) }; };
  const others = forms.map((f) => f.form).filter((n) => n !== name && n !== reference)
    .map((n) => ({ name: short(n), ...curve(n), color: "rule", width: 1, quiet: true }));
  return lines_figure([...others, ...(name === reference ? [] : [{ name: short(reference), ...curve(reference), color: "ink", dash: [5, 3] }]),
    { name: short(name), ...curve(name), color: "accent", width: 2.2 }],
    { title: "Loss on average", note: "1 − 2 ∫ E μ dμ; grey: all other forms", x_label: "roughness", y_label: "loss", x_ends: [0, 1], height: 290,
      text: `Average loss of ${name} over roughness.`, y_text: (y) => percent(y, 3) });
}
function maskings() {
  let name = reference;
  const panels = changing(() => el("div", {},
    el("div", { class: "columns map" }, el("figure", {}, el("figcaption", {}, "Loss 1 − E ", el("small", {}, "by roughness and angle")), loss_map(name)),
      el("div", {}, albedo_curves(name))), averages(name)));
  const groups = forms.map((f) => [f.form, short(f.form) + (f.model ? " (whole model)" : "")]);
  return section("Every masking form", "At F = 1 a form should give all back: E = 1. Beckmann's forms stand under Beckmann, Smith for GTR under GTR of that gamma, the coat's under GTR of gamma 1 "
    + "with alpha up to 0.1, as it ships, all others under GGX. Whole mobile models in white, their clamps included; those that are π times a BRDF, divided by π.",
    el("div", { class: "controls" }, chooser("Form", groups, name, (n) => { name = n; panels.again(); })), panels.node,
    el("h3", {}, "Where each loses more than 1, 5, 10 %, by roughness"), el("p", { class: "small muted" }, crossing_note),
    crossing_table("form", forms.map((f) => f.form), short));
}

// --- Bounces ---------------------------------------------------------------------------------------------
const materials = unique(truth.map((t) => t.material));
function bounces() {
  if (!materials.length) return null;
  let material = materials[0], mu = "average";
  const angles = unique(truth.map((t) => t.mu));
  const panels = changing(() => {
    const list = truth.filter((t) => t.material === material && t.mu === mu);
    const x = list.map((t) => t.roughness), most = Math.max(...list.map((t) => t.orders.length));
    const beyond = (n) => list.map((t) => t.albedo - t.orders.slice(0, n).reduce((a, b) => a + b, 0));
    const curves = Array.from({ length: Math.min(5, most) }, (_, n) => ({ name: n ? `after ${n + 1}` : "after one bounce", x, y: list.map((t) => t.orders[n] ?? 0) }));
    return el("div", { class: "columns" },
      lines_figure([...curves, { name: "all", x, y: list.map((t) => t.albedo), color: "ink", dash: [5, 3] }],
        { title: "What leaves, by the number of facets met", x_label: "roughness", y_label: "albedo", x_ends: [0, 1], scale: true, height: 280,
          text: `Energy by bounce of ${material}.`, y_text: (y) => significant(y, 4) }),
      lines_figure([1, 2, 3, 5].map((n) => ({ name: n === 1 ? "after more than one" : `more than ${n}`, x, y: beyond(n).map((v, i) => v / list[i].albedo) })),
        { title: "Share that a simulation cut off there misses", x_label: "roughness", y_label: "share", x_ends: [0, 1], scale: true, height: 280,
          text: `Share of the energy of ${material} beyond a number of bounces.`, y_text: (y) => percent(y, 3) }));
  });
  return section("Bounce by bounce", "GGX's microsurface with heights and slopes as Smith's masking assumes them, light followed to the end: the deterministic solution, to " + significant(Math.max(...truth.map((t) => t.error)), 1) + ".",
    el("div", { class: "controls" }, chooser("Material", materials.map((m) => [m, m]), material, (m) => { material = m; panels.again(); }),
      chooser("Angle", angles.map((a) => [String(a), mu_text(a)]), "average", (a) => { mu = a === "average" ? a : Number(a); panels.again(); })), panels.node);
}

// --- Compensations -----------------------------------------------------------------------------------------
const methods = unique(compensation.map((c) => c.scattering));
function compensations() {
  if (!methods.length) return null;
  let material = materials.find((m) => m.startsWith("gold")) ?? materials[0], mu = 0.5, without = false;
  const angles = unique(compensation.map((c) => c.mu));
  const panels = changing(() => {
    const list = compensation.filter((c) => c.material === material);
    const shown = methods.filter((m) => (without || m !== "single") && list.some((c) => c.scattering === m));
    const over_roughness = shown.map((m) => { const at = list.filter((c) => c.scattering === m && c.mu === mu); return { name: short(m), x: at.map((c) => c.roughness), y: at.map((c) => c.error) }; });
    const rough = unique(list.map((c) => c.roughness)).at(-1);
    const over_mu = shown.map((m) => { const at = list.filter((c) => c.scattering === m && c.mu !== "average" && c.roughness === rough); return { name: short(m), x: at.map((c) => c.mu), y: at.map((c) => c.error) }; });
    const o = { y_label: "E − truth", x_ends: [0, 1], height: 280, y_text: (y) => minus(y.toFixed(5)) };
    return el("div", { class: "columns" },
      lines_figure(over_roughness, { ...o, title: "Error over roughness", note: mu_text(mu), x_label: "roughness", text: `Error of each compensation for ${material} over roughness.` }),
      lines_figure(over_mu, { ...o, title: "Error over the angle", note: `at roughness ${plain(rough)}`, x_label: "μ", text: `Error of each compensation for ${material} over the cosine.` }));
  });
  const cost_rows = costs.map((c) => [el("code", {}, short(c.scattering)), { n: significant(c.rms, 2) }, { n: significant(c.worst, 2) }, c.worst_at, { n: significant(c.gold_rms, 2) },
    { n: String(c.operations) }, { n: String(c.lookups) }, { n: c.bytes ? count(c.bytes) : "0" }, { n: `${significant(c.cost_ns, 2)} ± ${significant(c.spread_ns, 1)}` }, { n: significant(c.without_ns, 2) }]);
  return section("What gives it back", "Albedo of each compensation less the truth: the deterministic solution of all bounces, exact to " + significant(Math.max(...truth.map((t) => t.error)), 1) + ". Below 0 light is still missing, above it there is too much.",
    el("div", { class: "controls" }, chooser("Material", materials.map((m) => [m, m]), material, (m) => { material = m; panels.again(); }),
      chooser("Angle", angles.map((a) => [String(a), mu_text(a)]), "0.5", (a) => { mu = a === "average" ? a : Number(a); panels.again(); }),
      choice("Curves", [[false, "compensations"], [true, "and single scattering"]], without, (v) => { without = v; panels.again(); })), panels.node,
    el("h3", {}, "Error and cost"),
    scroll(table(["", { n: "RMS error" }, { n: "worst" }, "worst at", { n: "RMS, gold" }, { n: "operations" }, { n: "lookups" }, { n: "table bytes" }, { n: "ns" }, { n: "ns without" }], cost_rows)),
    el("p", { class: "small muted" }, "Errors over the materials of Schlick's Fresnel, F0 from 0.04 to 1, all roughnesses and angles; of gold beside them. Operations: of the formula for one channel, counted. Table bytes: 32 × 32 in half. ns: D V F of GGX for one light and view with the compensation (of fdez_aguera, which stands on the split sum: F0 A + B), "
      + "beside the same without; one at a time, in float, on one thread, median ± half the distance of the quartiles. fdez_aguera is for Schlick's Fresnel alone."));
}

/// E(α, NoV) at F = 1 as a shader may have it.
function albedo_formulas() {
  if (!albedo_forms.length) return null;
  return section("E as a formula", "What compensations look up, E of GGX under Smith, correlated, F = 1: without a table by a fit. Errors against quadrature over roughness 0.05 to 1 and NoV 0.005 to 1.",
    scroll(table(["", { n: "RMS error" }, { n: "worst" }, "worst at", { n: "operations" }, { n: "table bytes" }],
      albedo_forms.map((f) => [el("code", {}, short(f.form)), { n: significant(f.rms, 2) }, { n: significant(f.worst, 2) }, f.worst_at, { n: f.operations ? String(f.operations) : "–" }, { n: f.bytes ? count(f.bytes) : "0" }]))));
}

// --- Error against time --------------------------------------------------------------------------------------
function against_time() {
  const cases = [...group_by(estimators, (e) => `roughness ${plain(e.roughness)}, μ = ${plain(e.mu)}`)];
  if (!cases.length) return null;
  return section("What a digit of E costs", "One E(μ, α) of GGX under Smith masking, correlated, F = 1, on one thread. Deterministic ones: the error that was made, asked for one digit after the other; the truth is known to 1e-13: what is nearer is drawn there. "
    + "Estimators by chance: the RMS error of independent repeats.",
    el("div", { class: "panels" }, cases.map(([name, list]) => lines_figure(
      [...group_by(list, (e) => e.estimator)].map(([estimator, points]) => {
        const sorted = [...points].sort((a, b) => a.cost_ns - b.cost_ns);
        return { name: estimator, x: sorted.map((p) => p.cost_ns), y: sorted.map((p) => Math.max(p.error, 1e-13)), kind: "both" };
      }), { title: name, x_label: "ns", y_label: "error of E", x_log: true, log: true, height: 320, text: `Error of E against time: ${name}.`, x_text: (x) => significant(x, 2), y_text: (y) => significant(y, 2) }))));
}

// --- Image-based light --------------------------------------------------------------------------------------
function split_sum() {
  if (!split_sum_tables.length) return null;
  const tables = scroll(table(["texels", "stored as", { n: "lookup, most" }, { n: "RMS" }, { n: "between centres, most" }, { n: "storage, most" }, { n: "quadrature" }],
    split_sum_tables.map((t) => [`${t.size} × ${t.size}`, t.stored, { n: significant(t.lookup_max, 2) }, { n: significant(t.lookup_rms, 2) },
      { n: significant(t.between_centres_max, 2) }, { n: significant(t.storage_max, 2) }, { n: "± " + significant(t.bound, 1) }])));
  const n = split_sum_samples.map((s) => s.samples);
  const samples = lines_figure(["a_max", "a_rms", "b_max", "b_rms"].map((k, i) => ({ name: k[0].toUpperCase() + (k.endsWith("max") ? ", most" : ", RMS"),
    x: n, y: split_sum_samples.map((s) => s[k]), color: i < 2 ? "accent" : "red", dash: k.endsWith("max") ? null : [5, 3], kind: "both" })),
    { title: "A and B by importance sampling", note: "Hammersley points from D, against quadrature, 16 × 16 texels", x_label: "samples", y_label: "error", x_log: true, log: true, height: 280,
      text: "Error of the split sum's A and B against the number of samples.", y_text: (y) => significant(y, 2) });
  const light = [...group_by(split_sum_light, (l) => l.environment)].map(([name, list]) => scroll(table(
    [name, ...unique(list.map((l) => l.nov)).flatMap((nov) => unique(list.map((l) => l.f0)).map((f0) => ({ n: `NoV ${plain(nov)}, F0 ${plain(f0)}` })))],
    unique(list.map((l) => l.roughness)).map((r) => [`roughness ${plain(r)}`, ...list.filter((l) => l.roughness === r).map((l) => ({ n: el("span", { title: `relative to each view: RMS ${percent(l.rms)}, most ${percent(l.max)}, bias ${signed_percent(l.bias)}; truth to ${percent(l.truth_error)}` }, `${percent(l.of_mean)} ± ${percent(l.of_mean_spread, 1)}`) }))]))));
  return section("The split sum", "GGX under Smith, correlated, and Schlick: E = F0 A + B of an even environment. Errors of A + B after bilinear lookup over all NoV and roughness.",
    tables, el("div", { class: "panels" }, samples),
    el("h3", {}, "Under an environment"),
    light.length ? [el("p", { class: "small muted" }, "RMS over views of split sum − integral, over the integral's mean, in luminance; the split takes n = v = r, so at grazing angles the lobe has the wrong shape. " + `${views} views; ±: half of what one half of them says and the other. Relative to each view, and the truth's own error, under the pointer.`), ...light]
      : el("p", { class: "small muted" }, "Not measured: no map was given (--environment FILE …)."));
}
function irradiances() {
  const lights = [...group_by(irradiance, (i) => i.light)];
  if (!lights.length) return null;
  const names = { riemann: "equal steps in θ and φ, low ends", riemann_midpoint: "equal steps, middles", cosine: "drawn from the cosine" };
  const figure = (over, label, text) => ([light, list]) => lines_figure([...group_by(list, (i) => i.rule)].map(([rule, points]) => ({ name: names[rule] ?? words(rule),
    x: points.map((p) => p[over]), y: points.map((p) => p.rms), kind: "both" })),
    { title: light, x_label: label, y_label: "RMS error", x_log: true, log: true, height: 260, text: `Error of the irradiance of ${light} over ${text}.`, y_text: (y) => percent(y) });
  return section("Diffuse irradiance", "∫ L cos θ dω over the hemisphere by the sums that renderers take, relative to the exact value, RMS over normals.",
    el("h3", {}, "Against samples"), el("div", { class: "panels" }, lights.map(figure("samples", "samples", "the number of samples"))),
    el("h3", {}, "Against time"), el("div", { class: "panels" }, lights.map(figure("cost_ns", "ns", "time"))));
}

document.getElementById("page").replaceChildren(...[
  el("p", { class: "over" }, "gonio report energy"), el("h1", {}, "What single scattering loses, and what gives it back"),
  el("div", { class: "verdict" }, findings.map((f) => el("p", {}, f))),
  materials.length ? section("From which roughness on does it matter?", "GGX under Smith masking, correlated: the roughness from which on more than 1, 5, 10 % of what should leave is missing, by material and angle. " + crossing_note,
    crossing_table("material", materials, (m) => m)) : null,
  maskings(), bounces(), compensations(), albedo_formulas(), against_time(), split_sum(), irradiances(),
  el("footer", {}, `${full ? "Full" : "Quick"} setting. Every figure of this page is in its data block and in the .json beside it.`)].filter(Boolean));
