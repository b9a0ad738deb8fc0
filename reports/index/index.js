"use strict";
// The page that leads to all reports: what to ship first, then what shows it, then each report.

const { version, full, at_ms, machine, decisions, visible, fresnel, front, reports, claims } = page_data();
document.head.append(el("style", {}, `
.lead { color: var(--muted); max-width: 128ch; margin-bottom: 6px; }
.decide { margin-top: 14px; padding-top: 8px; }
.decide table { width: 100%; font-size: 14.5px; }
.decide :is(th, td) { padding: 5px 20px 5px 0; }
.decide tbody th { font-weight: 500; }
.decide .take { font-weight: 650; }
.decide small { color: var(--muted); font-weight: 400; font-size: 12.5px; }
.decide .told-by-cell { margin-bottom: 4px; }
.decide .told-by-cell small { display: block; max-width: 46ch; }
.seen-by td { text-align: center; padding: 4px 6px; border: 2px solid var(--ground); border-radius: 6px; font-variant-numeric: tabular-nums; }
.seen-by th { white-space: normal; padding: 4px 8px 4px 0; }
.seen-by thead th { border: 0; text-align: center; max-width: 8em; padding: 4px 6px; }
.unseen { background: color-mix(in srgb, var(--green) 18%, transparent); }
.beside { background: color-mix(in srgb, var(--high-1) 30%, transparent); }
.shows { background: color-mix(in srgb, var(--red) 34%, transparent); font-weight: 650; }
.unknown { color: var(--muted); }
.key { display: flex; flex-wrap: wrap; gap: 4px 8px; }
.key span { padding: 1px 8px; border-radius: 5px; white-space: nowrap; }
.seen-by td { min-width: 5.2em; }
@media print { .decide table, .seen-by { font-size: 11px; } .decide small { font-size: 9.5px; } .decide :is(th, td) { padding: 3px 12px 3px 0; } }
.small-picture { display: block; width: 100%; height: auto; background: var(--faint); border-radius: 4px; margin-bottom: 8px; }
.said summary { color: inherit; font-weight: 400; margin: 0; }
.said details > p { margin: 6px 0 2px; font-size: 13.5px; color: var(--muted); }
`));

const page_of = (report, anchor) => `${report}.html${anchor ? "#" + anchor : ""}`;
const sentence = (text) => text[0].toUpperCase() + text.slice(1);
const anchored = (id, node) => { node.id = id; return node; };
/// A cell whose aside stands small below it.
function cell(text) {
  const [main, aside] = text.split(/ \((.*)\)$/s);
  return aside ? el("span", {}, main, el("small", {}, aside)) : text;
}

// --- What to ship -----------------------------------------------------------------------------------------
function what_to_ship() {
  if (!decisions.length) return null;
  const rows = decisions.map((d) => [cell(d.for), el("span", { class: "take", title: d.take_id }, d.take), cell(d.error), cell(d.cost), d.unless || "–"]);
  return anchored("decide", el("section", { class: "decide" }, told_by_cell(["for", "take", "error left", "costs", "unless"], rows)));
}
const lead = () => ["What each shortcut leaves of exact Fresnel, exact Smith masking and all bounces of light.",
  `Its cost is what one float sample takes more than with the cheap form${machine && known(machine.model_ns) ? `; a whole GGX highlight takes ${significant(machine.model_ns, 2)} ns` : ""}.`,
  machine ? `Measured on ${machine.cpu || "this machine"} with ${machine.isa} from cache, ${full ? "full" : "quick"} setting.` : `${full ? "Full" : "Quick"} setting.`,
  machine && machine.others_busy >= 0.25 ? `Meanwhile other programs kept ${plain(machine.others_busy, 2)} of ${machine.threads} processors busy.` : ""].filter(Boolean).join(" ");

// --- What Fresnel's shortcuts show -----------------------------------------------------------------------
const shown_as = (delta_e) => (delta_e <= visible.just_seen ? "unseen" : delta_e <= visible.side_by_side ? "beside" : "shows");
const material_name = { "IOR 1.33": "water", "IOR 1.5": "glass, plastic" };
function grid() {
  if (!fresnel.length) return null;
  const forms = unique(fresnel.map((f) => f.form)), materials = unique(fresnel.map((f) => f.material));
  const t = table(["", ...forms], materials.map((m) => [material_name[m] ?? m, ...forms.map((form) => {
    const found = fresnel.find((f) => f.material === m && f.form === form);
    return found ? found.delta_e.toFixed(1) : "–";
  })]));
  [...t.tBodies[0].rows].forEach((row, i) => [...row.cells].forEach((c, k) => {
    const found = k && fresnel.find((f) => f.material === materials[i] && f.form === forms[k - 1]);
    if (k) c.className = found ? shown_as(found.delta_e) : "unknown";
  }));
  t.classList.add("seen-by");
  return anchored("fresnel", section("What Fresnel's shortcuts show", "Greatest ΔE2000 of the rough surface under even light, over roughness and three views.",
    t, el("p", { class: "small key" }, el("span", { class: "unseen" }, `unseen, to ${visible.just_seen}`), el("span", { class: "beside" }, `side by side, to ${visible.side_by_side}`), el("span", { class: "shows" }, "seen"), el("span", { class: "unknown" }, "– not computed")),
    el("p", { class: "small muted" }, `Up to ΔE2000 ${visible.just_seen} nobody sees a difference: its unit is scaled to that (CIE 142-2001). Up to ${visible.side_by_side} it is seen side by side alone: what observers just saw in CIELAB (Mahy, Van Eycken and Oosterlinck 1994).`)));
}
const time = () => (front.length ? anchored("time", section("What masking's accuracy costs", "Error of G₂ against height-correlated Smith, over the time of a sample: on the line, nothing is both faster and nearer.",
  figure_view(front[0], { height: 440 }))) : null);

// --- The reports ------------------------------------------------------------------------------------------
/// The picture's curves alone, its look from afar.
function small_picture(f) {
  if (!f) return null;
  const w = 260, h = 96, scale = (axis, from, to) => {
    const { low, high } = axis.scales[axis.log && axis.scales.log ? "log" : "linear"], at = axis.log && axis.scales.log ? Math.log : (v) => v;
    return (v) => (known(v) && !(axis.log && v <= 0) ? from + (to - from) * (at(v) - at(low)) / (at(high) - at(low)) : null);
  };
  const x = scale(f.x, 6, w - 6), y = scale(f.y, h - 6, 6);
  let xs = [];
  const marks = f.curves.slice(0, 6).flatMap((c) => {
    const of = (key) => c[key] ?? c[key + "_ns"] ?? c[key + "_ms"];
    xs = of("x") ?? xs;
    const points = xs.map((v, i) => [x(v), y(of("y")[i])]).filter(([a, b]) => a !== null && b !== null).map(([a, b]) => [a.toFixed(1), b.toFixed(1)]);
    const colour = `var(--${c.colour})`;
    return c.kind === "points" ? points.map(([a, b]) => el("circle", { cx: a, cy: b, r: 2.4, style: { fill: colour } }))
      : [el("path", { d: points.map(([a, b], i) => `${i ? "L" : "M"}${a},${b}`).join(""), "stroke-dasharray": c.dash || null, style: { fill: "none", stroke: colour, "stroke-width": "1.6" } })];
  });
  return el("svg", { class: "small-picture", viewBox: `0 0 ${w} ${h}`, role: "img", "aria-label": f.title }, marks);
}
const card = (r) => el("article", { class: "card" }, el("a", { href: page_of(r.name) }, small_picture(r.picture)),
  el("h3", {}, el("a", { href: page_of(r.name) }, sentence(r.what))), r.sentence ? el("p", {}, r.sentence) : null,
  el("p", { class: "small muted" }, el("a", { href: `${r.name}.json` }, "JSON"), " · ", el("a", { href: `${r.name}.csv` }, "CSV"), " · ", el("a", { href: `${r.name}/` }, many(r.pictures, "picture")), ` · ${milliseconds(r.time_ms)}`));
const cards = () => (reports.length ? anchored("reports", section("The reports", null, el("div", { class: "cards" }, reports.map(card)))) : null);

// --- Claims -----------------------------------------------------------------------------------------------
function verdicts() {
  if (!claims.length) return null;
  const classes = { "holds": "yes", "holds in part": "weakly", "does not hold": "no" };
  const words = (c) => {
    const shown_in = el("a", { href: page_of(c.report, c.anchor) }, "the report");
    return unfolded_on_paper(el("details", {}, el("summary", {}, `“${c.claim}”`), el("p", {}, sentence(c.verdict)), el("p", {}, c.source, " · ", shown_in)));
  };
  const t = told_by_cell(["verdict", "claim", "figure"], claims.map((c) => [el("span", { class: `verdict-${classes[c.judged]}` }, c.judged), words(c), c.figure]));
  t.classList.add("said");
  return anchored("claims", section("Claims in circulation", "As they stand in five notes on shading that this project began with, seed 000 to 004, which quote papers, talks and shaders. A click on one shows the figures behind its verdict, and where it stands.", t));
}

// --- What stands behind a figure --------------------------------------------------------------------------
const behind = () => anchored("about", section("What stands behind a figure", null, el("ul", { class: "findings" }, [
  "A form is taken if it is the cheapest of those whose error does not show. Of forms that no measurement tells apart in time it is the nearest, or the cheap form itself.",
  "Colours are those of a rough surface under even light, beside a perfect diffuser in D65, without a tone map. A metal's true colour is that of its spectrum; three wavelengths are 650, 550 and 450 nm.",
  "Masking is held against height-correlated Smith for GGX: RMS of G₂ over both cosines from 0.05 to 1 and over roughness.",
  "Bounces are held against transport between the facets, for F0 from 0.04 to 1 under Schlick's Fresnel, seen from cosine 0.1 on.",
  "Times are medians over several processes on this machine. A difference counts where each of them finds it, above its spread and 3 % of the time.",
  "Compensations are timed in one process, one light and view at a time.",
].map((text) => el("li", {}, text)))));

const parts = [what_to_ship(), el("div", { class: "columns" }, grid(), time()), cards(), verdicts(), behind()].filter((p) => p && p.childNodes.length);
const places = [["decide", "Decide"], ["fresnel", "Fresnel by material"], ["time", "Accuracy against time"], ["reports", "The reports"], ["claims", "Claims"], ["about", "What stands behind a figure"]];
const is_there = (id) => parts.some((p) => p.id === id || p.querySelector(`#${id}`));
document.getElementById("page").replaceChildren(
  el("h1", {}, "Which shortcuts can you ship?"), el("p", { class: "lead" }, lead(), fresnel.length ? [` ΔE is CIEDE2000: up to ${visible.just_seen} nobody sees it, up to ${visible.side_by_side} only side by side (`, el("a", { href: "#fresnel" }, "sources"), ")."] : null),
  el("nav", { class: "contents", "aria-label": "Contents" }, places.filter(([id]) => is_there(id)).map(([id, text]) => el("a", { href: `#${id}` }, text))),
  ...parts,
  el("footer", {}, `gonio ${version}, ${full ? "full" : "quick"} setting, made ${new Date(at_ms).toISOString().slice(0, 16).replace("T", " ")} UTC. All of this page is in index.json beside it.`));
