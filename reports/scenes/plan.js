"use strict";
// A plan: what each material of a scene keeps, what it drops, and why.

const plan = page_data(), { tolerance } = plan;
const materials = Object.entries(plan.materials).map(([name, m]) => ({ name, ...m }));
const unit = tolerance.metric === "relative" ? "" : "ΔE2000 ";
const unit_name = tolerance.metric === "relative" ? "change" : "ΔE2000";
const times = (x) => `${x < 9.95 ? x.toFixed(1) : x.toFixed(0)}\u202f×`;
const effect_words = { fresnel: "Fresnel", compensation: "multiple scattering", masking: "masking", anisotropy: "anisotropy", coat: "coat", tail: "tail",
  diffuse: "diffuse", coupling: "coupling of the diffuse", spectrum: "spectrum of the metal", environment: "integral over the environment", precision: "double precision" };
const form_words = (e) => (["on", "off"].includes(e.form) ? "" : ` (${words(e.form)})`);
const capital = (text) => text[0].toUpperCase() + text.slice(1);
const names = (list) => list.map((e) => effect_words[e.effect] + (e.keep ? form_words(e) : "")).join(", ");
const kept = (m) => m.effects.filter((e) => e.keep);
const dropped = (m) => m.effects.filter((e) => !e.keep && e.why !== "structural");

function verdict() {
  const fastest = materials.reduce((a, b) => (b.speedup > a.speedup ? b : a)), slowest = materials.reduce((a, b) => (b.speedup < a.speedup ? b : a));
  const lines = materials.length === 1
    ? [`The material ${fastest.name} is ${times(fastest.speedup)} as fast with what this scene needs of it as with every effect.`]
    : [`With what this scene needs of it, ${fastest.name} is ${times(fastest.speedup)} as fast as with every effect; ${slowest.name}, which needs the most, ${times(slowest.speedup)}.`];
  lines.push(`At ${percent(tolerance.quantile)} of the points nobody sees more than ${unit}${plain(tolerance.limit)}, and nowhere more than ${plain(tolerance.max)}.`);
  if (plan.budget) {
    const b = plan.budget;
    lines.push(b.fits ? `A visible point takes ${significant(b.ns, 3)} ns of the ${plain(b.budget_ns)} ns that the scene allows; the worst material errs by at most ${unit}${significant(b.error, 2)}.`
      : `Even the cheapest forms take ${significant(b.ns, 3)} ns a point, more than the ${plain(b.budget_ns)} ns that the scene allows.`);
  }
  return findings_view(lines);
}

function summary() {
  return section("What to keep, and how much faster that is", "Times of all effects in their exact form, in double, over the plan's; both of composed column kernels on this machine.",
    told_by_cell(["material", { n: "as fast" }, { n: "operations" }, "keep", "drop", { n: `${unit_name} at ${percent(tolerance.quantile)}` }, { n: "worst" }],
      materials.map((m) => [el("a", { href: `#${encodeURIComponent(m.name)}` }, m.name), { n: times(m.speedup) }, { n: m.ops_saved > 0 ? `−${percent(m.ops_saved, 2)}` : "0" },
        kept(m).length ? names(kept(m)) : "nothing", dropped(m).length ? names(dropped(m)) : "nothing", { n: m.samples ? `≤ ${significant(m.error_upper, 2)}` : "0" }, { n: m.samples ? significant(m.worst, 2) : "0" }])));
}

const why_words = { structural: "changes nothing", proved: "by proof", measured: "measured" };
function one(m) {
  const order = [...m.effects].sort((a, b) => b.keep - a.keep || (a.why === "structural") - (b.why === "structural"));
  const front = [...(m.front ?? [])];
  const node = section(m.name, null,
    told_by_cell(["effect", "here", { n: `${unit_name} if dropped alone` }, { n: "ns saved" }, { n: "operations saved" }, "why"],
      order.map((e) => [capital(effect_words[e.effect]), e.keep ? el("span", { class: "verdict-yes" }, `keep${form_words(e)}`) : e.why === "structural" ? el("span", { class: "muted" }, "absent") : "drop",
        { n: e.why === "structural" ? "0" : (e.why === "proved" ? "≤ " : "") + significant(e.error_if_dropped, 2) }, { n: e.why === "structural" && e.ops_saved === 0 ? "0" : significant(e.ns_saved, 2) }, { n: count(Math.round(e.ops_saved)) },
        el("span", { class: "muted" }, e.why === "structural" ? e.reason : why_words[e.why])])),
    m.samples ? el("p", { class: "small" }, `Checked on ${count(m.samples)} fresh points: less than ${percent(m.exceeding_bound)} of all lie beyond the limit, with a confidence of ${percent(tolerance.confidence)}.`, m.passed_over ? ` ${capital(many(m.passed_over, "cheaper set"))} failed there.` : "")
      : el("p", { class: "small" }, "No cheaper set keeps the tolerance: only what changes nothing is dropped."),
    el("p", { class: "small" }, "The model: ", el("code", {}, m.spec)),
    front.length > 1 ? el("details", {}, el("summary", {}, `${front.length} sets of which none is faster and errs less`),
      in_cards(table(["keeps", { n: "ns" }, { n: "operations" }, { n: `${unit_name} at ${percent(tolerance.quantile)}` }, { n: "worst" }],
        front.map((c) => [Object.entries(c.forms).filter(([, form]) => !["none", "off", "schlick", "schlick_k", "ggx", "rgb", "split_sum", "float"].includes(form)).map(([e, form]) => effect_words[e] + form_words({ form })).join(", ") || "nothing",
          { n: significant(c.ns, 3) }, { n: count(Math.round(c.ops)) }, { n: significant(c.error_quantile, 2) }, { n: significant(c.worst, 2) }])))) : null);
  node.id = encodeURIComponent(m.name);
  return node;
}

const sections = [summary(), ...materials.map(one)];
document.getElementById("page").replaceChildren(
  el("p", { class: "over" }, "gonio plan"), el("h1", {}, "Only what the scene needs"), contents(sections), verdict(), ...sections,
  el("footer", {}, "Points are what viewers see, half of them near highlights. Every figure of this page is in the plan beside it."));
