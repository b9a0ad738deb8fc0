"use strict";
// The audit of the catalogue: what every entry keeps and breaks.

const { entries } = page_data();
const kinds = [["ndf", "Normal distributions"], ["masking", "Masking and shadowing"], ["fresnel", "Fresnel"],
               ["diffuse", "Diffuse"], ["map", "Maps between parameters"], ["model", "Whole models"]];
const symbols = { alpha: "α", alpha_x: "α_x", alpha_y: "α_y", gamma: "γ", eta: "η", theta_h: "θ_h", theta_d: "θ_d", theta_i: "θ_i", theta_o: "θ_o" };
const symbol = (text) => text.replace(/\b(alpha_x|alpha_y|alpha|gamma|eta|theta_[hdio])\b/g, (w) => symbols[w]).replace(/ deg\b/g, "°");

// --- What is said of an entry ------------------------------------------------------------------------
const total = (e) => (e.operations ? Object.values(e.operations).reduce((a, b) => a + b, 0) : null);
function operations_text(e) {
  return Object.entries(e.operations).filter(([, n]) => n > 0).map(([kind, n]) => `${n} ${kind}`).join(", ");
}
/// Six decimals at most, and a difference from `to` never rounded away.
function near(x, to) {
  if (!known(x)) return "∞";
  const off = Math.abs(x - to);
  if (off < 5e-7) return `${to}`;
  return off < 0.01 ? minus(x.toFixed(off < 1e-4 ? 6 : 4)) : significant(x);
}
const most_energy = (e) => e.energy ?? e.energy_under_lobe;
const laws = {
  normalisation: (e) => (e.normalisation ? near(e.normalisation.value, 1) : null),
  reciprocity: (e) => (e.reciprocity ? (e.reciprocity.value < 1e-9 ? "yes" : percent(e.reciprocity.value)) : null),
  energy: (e) => { const most = most_energy(e); return most ? near(most.value, 1) : null; },
  range: (e) => (e.lowest && e.highest && e.kind !== "map" ? `${significant(e.lowest.value, 2)} … ${significant(e.highest.value, 2)}` : null),
};
const titles = { normalisation: "∫ D cos θ", reciprocity: "reciprocal", energy: "most albedo", range: "range" };
const cell = (e, law) => {
  const text = laws[law](e);
  return { n: text === null ? el("span", { class: "muted" }, "·") : el("span", { class: e.violates.includes(law) ? "breaks" : null }, text) };
};
const verdict_of = (e) => [
  e.mistake ? el("span", { class: "tag" }, "mistake") : null,
  ...e.violates.map((v) => el("span", { class: "tag" }, v)),
  !e.mistake && !e.violates.length ? el("span", { class: "muted" }, e.verdict) : null];

// --- Its picture -------------------------------------------------------------------------------------
/// On a logarithmic scale where the curve spans decades.
function draw_picture(node, e, width, height, axes = false) {
  const { at, value, reference } = e.picture;
  const all = [...value, ...reference].filter(known), positive = all.filter((v) => v > 0);
  if (!all.length) return;
  const top = Math.max(...all), log = positive.length > 3 && top / Math.min(...positive) > 300 && Math.min(...all) >= 0;
  const low = log ? Math.max(Math.min(...positive), top * 1e-6) : Math.min(0, ...all);
  const pad = axes ? { left: 46, right: 10, top: 8, bottom: 34 } : { left: 1, right: 1, top: 3, bottom: 3 };
  const x = (v) => pad.left + (width - pad.left - pad.right) * (v - at[0]) / (at.at(-1) - at[0]);
  const place = (v) => (log ? Math.log(Math.max(v, low) / low) / Math.log(top / low) : (v - low) / ((top - low) || 1));
  const y = (v) => height - pad.bottom - (height - pad.top - pad.bottom) * place(v);
  const line = (list) => list.map((v, i) => (known(v) ? `${i && known(list[i - 1]) ? "L" : "M"}${x(at[i]).toFixed(1)} ${y(v).toFixed(1)}` : "")).join("");
  const marks = [];
  if (axes) {
    const ticks = log ? log_ticks(low, top) : [low, (low + top) / 2, top];
    marks.push(...ticks.map((t) => [
      el("line", { x1: pad.left, x2: width - pad.right, y1: y(t), y2: y(t), stroke: "var(--rule)" }),
      el("text", { x: pad.left - 5, y: y(t) + 4, "text-anchor": "end" }, tick_text(Number(t.toPrecision(2))))]));
    marks.push(...[0, 0.5, 1].map((t) => { const v = at[0] + t * (at.at(-1) - at[0]);
      return el("text", { x: x(v), y: height - 17, "text-anchor": t === 0 ? "start" : t === 1 ? "end" : "middle" }, plain(v, 3)); }));
    marks.push(el("text", { x: (pad.left + width - pad.right) / 2, y: height - 3, "text-anchor": "middle" },
      symbol(e.picture.x) + (/theta/.test(e.picture.x) ? " [°]" : "")));
  }
  node.setAttribute("viewBox", `0 0 ${width} ${height}`);
  node.replaceChildren(...marks.flat(),
    ...(reference.length ? [el("path", { d: line(reference), fill: "none", stroke: "var(--muted)", "stroke-width": 1.2, "stroke-dasharray": "3 2.5" })] : []),
    el("path", { d: line(value), fill: "none", stroke: "var(--accent)", "stroke-width": 1.6 }));
}
function picture(e, width, height, axes = false) {
  const node = el("svg", { class: axes ? "entry-picture" : "thumb", width: axes ? null : width, height: axes ? null : height, role: "img",
    "aria-label": `${e.id}: ${symbol(e.picture.y)} over ${symbol(e.picture.x)}${e.picture.reference.length ? `, dashed ${e.distance.reference}` : ""}` });
  draw_picture(node, e, width, height, axes);
  return node;
}

// --- All that is known of one ------------------------------------------------------------------------
const worst = (name, w, value = w && significant(w.value, 6)) => (w ? [name, [el("b", {}, value ?? "–"),
  w.error > 0 ? el("span", { class: "muted" }, ` ± ${significant(w.error, 1)}`) : null, w.where ? el("span", { class: "muted" }, ` at ${symbol(w.where)}`) : null]] : [name, null]);
function details(e) {
  const d = e.distance;
  return el("div", { class: "detail" },
    el("figure", {}, el("figcaption", {}, symbol(e.picture.y), e.picture.reference.length ? el("small", {}, ` dashed: ${d.reference}`) : null), picture(e, 380, 210, true)),
    pairs([
      ["formula", el("code", {}, e.formula)],
      ["source", e.source + (e.seed ? ` · seed ${e.seed}` : "")],
      ["shipped by", e.ships || null],
      worst("∫ D cos θ dω", e.normalisation, e.normalisation && (known(e.normalisation.value) ? plain(e.normalisation.value, 9) : "diverges")),
      worst("reciprocity error", e.reciprocity),
      worst("largest albedo", e.energy), e.energy ? ["in the model", el("code", {}, e.energy_of)] : ["", null],
      worst("under a lobe of f0 0.04", e.energy_under_lobe),
      worst("lowest value", e.lowest), worst("highest value", e.highest), worst("at 90°", e.grazing),
      ["light", e.light_unit === 1 ? null : "all figures are divided by π: it is shipped for lights that come without 1/π"],
      ["without a value", e.not_finite ? many(e.not_finite, "legal input") : "none of the inputs tried, ends of all ranges included"],
      ["distance", d ? [el("b", {}, significant(d.max)), el("span", { class: "muted" }, ` at most, RMS ${significant(d.rms)}, in ${d.measure} to `), el("code", {}, d.reference),
        el("span", { class: "muted" }, `; most at ${symbol(d.where)}`)] : null],
      ["operations", e.operations ? operations_text(e) : null]].filter(([, v]) => v !== null)));
}

// --- The tables ----------------------------------------------------------------------------------------
const bodies = [];
function kind_section([kind, title]) {
  const of_kind = entries.filter((e) => e.kind === kind);
  if (!of_kind.length) return null;
  const columns = ["normalisation", "reciprocity", "energy", "range"].filter((law) => of_kind.some((e) => laws[law](e) !== null));
  const distance = of_kind.some((e) => e.distance), operations = of_kind.some((e) => e.operations);
  const width = 3 + columns.length + (distance ? 1 : 0) + (operations ? 1 : 0);
  const body = el("tbody", {});
  for (const e of of_kind) {
    const open = el("button", { type: "button", class: "plain", "aria-expanded": "false" }, el("code", {}, e.id.slice(e.id.indexOf(".") + 1)));
    const row = el("tr", { class: "entry", id: e.id },
      el("th", { scope: "row" }, open, el("div", { class: "entry-title" }, e.title), el("div", { class: "narrow" }, verdict_of(e))),
      el("td", { class: "thumbs" }, picture(e, 84, 34)),
      columns.map((law) => el("td", { class: "n" }, cell(e, law).n)),
      distance ? el("td", { class: "n" }, e.distance ? [significant(e.distance.max, 2), el("div", { class: "entry-title" }, e.distance.reference.slice(e.distance.reference.indexOf(".") + 1))] : el("span", { class: "muted" }, "·")) : null,
      operations ? el("td", { class: "n", title: e.operations ? operations_text(e) : null }, String(total(e) ?? "·")) : null,
      el("td", { class: "wide" }, verdict_of(e)));
    let more = null;
    open.addEventListener("click", () => {
      if (more) { more.remove(); more = null; } else { more = el("tr", { class: "more" }, el("td", { colspan: width }, details(e))); row.after(more); }
      open.setAttribute("aria-expanded", String(more !== null));
    });
    body.append(row);
    bodies.push([e, row, () => more]);
  }
  return section(title, null, scroll(el("table", { class: "audit" },
    el("thead", {}, el("tr", {}, el("th", {}, ""), el("th", { class: "thumbs" }, ""), columns.map((law) => el("th", { class: "n" }, titles[law])),
      distance ? el("th", { class: "n" }, "off by at most") : null, operations ? el("th", { class: "n" }, "operations") : null, el("th", { class: "wide" }, "verdict"))),
    body)));
}

const shown = { all: () => true, mistakes: (e) => e.mistake, violations: (e) => e.violates.length > 0, clean: (e) => !e.mistake && !e.violates.length };
function show(which) {
  for (const [e, row, more] of bodies) {
    row.hidden = !shown[which](e);
    if (more()) more().hidden = row.hidden;
  }
}
const broken = (law) => entries.filter((e) => e.violates.includes(law)).length;
const fact = (name, value, rest = null) => el("div", {}, el("dt", {}, name), el("dd", {}, value, rest ? el("small", {}, " " + rest) : null));

const sections = kinds.map(kind_section).filter(Boolean);
document.getElementById("page").replaceChildren(
  el("p", { class: "over" }, "gonio audit"), el("h1", {}, "The catalogue, audited"), contents(sections),
  el("p", { class: "verdict" }, `Of ${many(entries.length, "form")} that are shipped or published, `,
    el("b", {}, `${entries.filter((e) => e.mistake).length} are mistakes`), " (they differ from the form they are named for) and ",
    el("b", {}, `${entries.filter((e) => e.violates.length).length} break a law`), " that a BRDF should keep."),
  el("dl", { class: "facts" }, fact("not normalised", String(broken("normalisation"))), fact("not reciprocal", String(broken("reciprocity"))),
    fact("reflect more than they get", String(broken("energy"))), fact("outside their range", String(broken("range"))), fact("without a value somewhere", String(broken("finite")))),
  el("section", {}, el("div", { class: "controls" }, choice("Shown", [["all", "all"], ["mistakes", "mistakes"], ["violations", "break a law"], ["clean", "keep the laws"]], "all", show),
      el("span", { class: "hint" }, "An entry's name opens all that is known of it.")),
    el("p", {}, "Every figure is the worst over the entry's parameters, the ends of their ranges included, and over directions. ∫ D cos θ should be 1. "
      + "“Most albedo” is the largest share of light from one direction that leaves again, at F = 1 and white: above 1 light is made (a distribution without a masking of its own is not judged by it; an uncoupled diffuse term is judged by itself). "
      + "What engines ship without 1/π, for lights that bring it along, is divided by π throughout. "
      + "“Off by at most” is the distance to the form named below it. Curves: blue the entry, dashed that form.")),
  ...sections,
  el("footer", {}, "Every figure of this page is in its data block and in the .page.json beside it."));
