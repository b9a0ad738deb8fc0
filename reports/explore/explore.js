"use strict";
// Everything that is shown comes from the module, which is the program's own code: here are sliders, plots and pictures.
// Names are text only: nothing that was read becomes markup.
const $ = (id) => document.getElementById(id);
const make = (tag, attributes = {}, ...children) => filled(document.createElement(tag), attributes, children);
const mark = (tag, attributes = {}, ...children) => filled(document.createElementNS("http://www.w3.org/2000/svg", tag), attributes, children);
function filled(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) if (value !== false) node.setAttribute(name, value === true ? "" : value);
  node.append(...children);
  return node;
}
const shown = (v) => (!Number.isFinite(v) ? "no value" : v !== 0 && (Math.abs(v) < 1e-3 || Math.abs(v) >= 1e5) ? v.toExponential(3) : String(Number(v.toPrecision(5))));
const degrees = (v) => `${Number(v.toFixed(2))}°`;
const clamp = (v, low, high) => Math.min(Math.max(v, low), high);
const say = (text, failed = false) => { $("status").textContent = text; $("status").className = failed ? "failed" : ""; };
const colours = 8, sliceSize = 96, sphereSize = 192, mapSize = 18, steps = 1000;

// ---- the module -----------------------------------------------------------------------------------------------------------------
let g, room;
const from_text = (text) => Uint8Array.from(atob(text.trim()), (c) => c.charCodeAt(0));
/// Bytes of a module, which stands in the page in base64 of its gzip.
const unpacked = (id) => new Response(new Blob([from_text($(id).textContent)]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
async function start() {
  if (!globalThis.WebAssembly || !globalThis.DecompressionStream) throw new Error("this browser is too old: it has no WebAssembly or no DecompressionStream");
  const bytes = await unpacked("module");
  const view = () => new DataView(g.memory.buffer);
  // Of a system there is little: no environment, no files; what would be printed goes nowhere.
  const system = {
    environ_get: () => 0, environ_sizes_get: (n, size) => (view().setUint32(n, 0, true), view().setUint32(size, 0, true), 0),
    fd_close: () => 0, fd_seek: () => 70, fd_write: () => 8, proc_exit: (code) => { throw new Error(`the module ended with ${code}`); },
  };
  g = (await WebAssembly.instantiate(bytes, { wasi_snapshot_preview1: system })).instance.exports;
  g._initialize();
  room = { x: g.allocate(8 * 512), f: g.allocate(24 * Math.max(512, sliceSize ** 2)), rgba: g.allocate(4 * sphereSize ** 2) };
}
/// Numbers in the module's memory; memory that has grown is elsewhere, so this is asked anew each time.
const numbers = (at, n) => new Float64Array(g.memory.buffer, at, n);
const answer = () => {
  const all = new Uint8Array(g.memory.buffer), at = g.answer();
  return new TextDecoder().decode(all.slice(at, all.indexOf(0, at)));
};
function checked(code) {
  if (code < 0) throw new Error(answer());
  return code;
}
function with_text(texts, call) {
  const at = texts.map((text) => {
    const bytes = new TextEncoder().encode(`${text}\0`), p = g.allocate(bytes.length);
    new Uint8Array(g.memory.buffer, p, bytes.length).set(bytes);
    return p;
  });
  try { return checked(call(...at)); } finally { at.forEach((p) => g.release(p)); }
}
const split = (channels, n) => Array.from({ length: channels }, (_, c) => numbers(room.f + 8 * c * n, n).slice());
const describe = (handle) => (checked(g.describe(handle)), JSON.parse(answer()));

// ---- what is shown --------------------------------------------------------------------------------------------------------------
let catalogue, tables = [], page;  // page: what it came with
// All that a person sees is made of these and of two fields of text, and state() holds them.
let items = [], view, active = 0, compared = null;
const documents = new Map();  // those of fits and comparisons, by their ids: too long for an address
const usual = "lambert+ggx/smith_ggx.correlated/schlick";
/// 45°, or the angle nearest to it at which a table has values of its own.
const first_angle = () => {
  const measured = items.flatMap((item) => (item.cuts ?? []).map((c) => c.theta_i));
  return measured.length ? measured.reduce((a, b) => (Math.abs(b - 45) < Math.abs(a - 45) ? b : a)) : 45;
};
const first_view = () => ({ theta: first_angle(), phi: 0, phid: 90, ev: 0, log: true, slog: false, channel: 1, light: [0.5, 0.6, 0.62], lamp: "", turn: [0.6, 0.45] });
const settings_of = (values) => Object.entries(values).map(([name, v]) => `${name}=${v.join(",")}`).join(" ");
const is_model = (item) => item && item.kind === "model";
/// Name that a person gave; without one a model is called by its terms.
const plain_name = (item) => (!is_model(item) ? item.name : item.name ? `${item.name}${item.changed ? ", changed" : ""}` : item.about.name);
/// What an entry is called everywhere, numbered where two would be called the same.
function label(item) {
  const name = plain_name(item), before = items.slice(0, Math.max(items.indexOf(item), 0)).filter((one) => plain_name(one) === name).length;
  return before ? `${name}, ${before + 1}` : name;
}
/// Names of channels: a model that was not fitted has those of the first table beside it that has as many.
const channels_of = (item) => (is_model(item) && !item.fit && items.find((one) => !is_model(one) && one.channels.length === item.channels.length) || item).channels;

/// \param name  that a person gave, or ""
/// \param fit   what a fit says of it (fitted() in fitting.js), or null
function bind(name, spec, values, channels, fit = null) {
  const handle = with_text([spec, typeof values === "string" ? values : settings_of(values)], (s, v) => g.bind(s, v, channels.length));
  return { kind: "model", name, fit, changed: false, handle, about: describe(handle), visible: true, channels };
}
function hold_table(data) {
  const hold = (text, make_of) => {
    const bytes = from_text(text), at = g.allocate(Math.max(bytes.length, 4));
    new Uint8Array(g.memory.buffer, at, bytes.length).set(bytes);
    const handle = checked(make_of(at, bytes.length));
    g.release(at);
    return handle;
  };
  const channels = data.channels.length;
  return { ...data, data, samples: hold(data.samples, (at, bytes) => g.samples(channels, bytes / 4 / (4 + channels), at)),
    handle: hold(data.values, (at) => g.table(channels, ...data.sizes, at)), visible: true };
}
const values_of = (item) => {
  const all = numbers(g.values(item.handle), item.about.parameters.reduce((n, p) => n + p.count, 0));
  return Object.fromEntries(item.about.parameters.map((p) => [p.name, [...all.subarray(p.first, p.first + p.count)]]));
};

// The whole state as text: for the address, undo, A and the page that is saved.
const state = () => JSON.stringify({
  i: items.map((item) => ({ ...(is_model(item) ? { n: item.name, x: item.changed ? 1 : 0, s: item.about.spec, v: values_of(item), c: item.channels, f: item.fit ?? undefined } : { t: tables.indexOf(item), n: item.name }), h: item.visible ? 0 : 1 })),
  a: active, w: view, m: $("mask").value, o: $("words").value, k: compared ?? undefined,
});
/// \return  names of tables that the text shows and this page does not hold
/// \throws Error  where nothing of it can be shown; then nothing has changed
function restore(text) {
  const s = JSON.parse(text);
  if (!Array.isArray(s?.i) || !s.i.length || s.i.length > colours) throw new Error("found no list of one to eight models and tables");
  const list = [], made = [], missing = [];
  let chosen = null;
  try {
    s.i.forEach((one, k) => {
      const is_table = Number.isInteger(one?.t);
      if (!is_table && typeof one?.s !== "string") throw new Error("found an entry that is neither a model nor a table");
      const item = is_table ? [tables[one.t], ...tables].find((t) => t && (one.n === undefined || t.name === one.n))
        : bind(String(one.n ?? ""), one.s, Object.fromEntries(Object.entries(one.v ?? {}).map(([name, v]) => [name, v.map(Number)])), channels_in(one.c), one.f && typeof one.f === "object" ? one.f : null);
      if (!item) return missing.push(String(one.n ?? "a table"));
      if (!is_table) made.push(item), item.changed = Boolean(one.x);
      if (list.some(([other]) => other === item)) throw new Error("found a table twice");
      list.push([item, !one.h]);
      if (k === s.a) chosen = item;
    });
    if (!list.length) throw new Error(`it shows ${missing.join(", ")}, which this page does not hold`);
  } catch (error) {
    made.forEach((item) => g.drop(item.handle));
    throw error;
  }
  items.filter(is_model).forEach((item) => g.drop(item.handle));
  items = list.map(([item, visible]) => Object.assign(item, { visible }));
  active = Math.max(items.indexOf(chosen), 0);
  compared = s.k && typeof s.k === "object" ? s.k : null;
  $("mask").value = String(s.m ?? ""), $("words").value = String(s.o ?? "");
  view = first_view();
  for (const name of ["theta", "phi", "phid", "ev", "channel"]) if (Number.isFinite(s.w?.[name])) view[name] = s.w[name];
  view.theta = clamp(view.theta, 0, 89), view.channel = clamp(Math.trunc(view.channel), 0, 2);
  for (const name of ["log", "slog"]) if (typeof s.w?.[name] === "boolean") view[name] = s.w[name];
  if (lamps().includes(s.w?.lamp)) view.lamp = s.w.lamp;
  if (Array.isArray(s.w?.turn) && s.w.turn.length === 2 && s.w.turn.every(Number.isFinite)) view.turn = s.w.turn;
  if (Array.isArray(s.w?.light) && s.w.light.length === 3 && s.w.light.every(Number.isFinite) && Math.hypot(...s.w.light) > 1e-3) view.light = s.w.light;
  dirty.light = true, show_all();
  return missing;
}
const channels_in = (c) => (Array.isArray(c) && (c.length === 1 || c.length === 3) ? c.map(String) : c === 1 ? ["f"] : c === 3 ? ["r", "g", "b"] : first_channels());
const first_channels = () => (tables[0] ?? page.items[0])?.channels ?? ["r", "g", "b"];
/// A page begins with what it was given, and with a model for a table that has none.
function first_state() {
  if (page.state) return page.state;
  const list = page.items.map((one, k) => (one.kind === "table" ? { t: tables.findIndex((t) => t.data === one), n: one.name }
    : { n: one.name, s: one.spec, v: one.values, c: one.channels, f: one.document ? fitted(one.document, one.name, null, {}, `given ${k}`).fit ?? undefined : undefined }));
  if (!list.some((one) => one.s) && list.length < colours) list.push({ s: usual });
  return JSON.stringify({ i: list, a: Math.max(list.findIndex((one) => one.s), 0) });
}

let past = [], future = [], kept, began, held = null;
/// After a move is finished: what was before can be had again, and the address says what is.
function finish() {
  if (held !== null) return;
  const now = state();
  if (now === kept) return;
  past.push(kept), future = [], kept = now;
  if (past.length > 200) past.shift();
  to_address(), show_names(), show_buttons();
}
let own_address = "";
function to_address() {
  own_address = `#${encodeURIComponent(kept)}`;
  if (location.hash !== own_address) location.replace(own_address);
}
function travel(from, to) {
  if (!from.length) return;
  to.push(kept), kept = from.pop();
  restore(kept), to_address(), show_buttons();
  for (const [ended, other] of [["undo", "redo"], ["redo", "undo"]]) if (document.activeElement === $(ended) && $(ended).disabled) $(other).focus();
}
function show_buttons() {
  $("undo").disabled = !past.length, $("redo").disabled = !future.length;
  $("remove").disabled = items.length < 2;
  for (const id of ["copy-spec", "copy-json"]) $(id).disabled = !is_model(items[active]);
  $("copy-fit").disabled = !fit_pair();
  $("add").disabled = items.length >= colours;
  show_fitting(), show_panel();
}

// ---- the side: surfaces, terms, sliders -----------------------------------------------------------------------------------------
function show_all() {
  show_surfaces(), show_model(), show_view(), show_buttons(), make_pictures(), redraw();
}
/// Fills a box anew; what had the focus in it has it again.
function refill(box, nodes) {
  const had = box.contains(document.activeElement) && document.activeElement.id;
  box.replaceChildren(...nodes);
  if (had) $(had)?.focus();
}
let names = "";
/// A name follows from what an entry is now: where one has become another, all that is labelled is so anew.
function show_names() {
  if (names !== items.map(label).join("\n")) show_surfaces(), make_pictures(), redraw();
}
function show_surfaces() {
  names = items.map(label).join("\n");
  refill($("surfaces"), items.map((item, i) => {
    const pick = make("input", { type: "radio", name: "active", id: `pick-${i}` }), see = make("input", { type: "checkbox", id: `see-${i}`, "aria-label": `draw ${label(item)}` });
    pick.checked = i === active, see.checked = item.visible;
    pick.onchange = () => { active = i; show_model(), show_view(), show_buttons(), make_pictures(), redraw(), finish(); };
    see.onchange = () => { item.visible = see.checked; make_pictures(), redraw(), finish(); };
    const named = make("label", { for: `pick-${i}` }, label(item), make("small", {}, is_model(item) ? [item.about.spec, item.fit?.said].filter(Boolean).join(". ") : item.said));
    return make("div", { class: "surface" }, see, make("span", { class: "dot", style: `background: var(--c${i})` }), pick, named);
  }));
}
const roles = [["ndf", "Distribution"], ["masking", "Masking"], ["fresnel", "Fresnel"]];
const term_of = (id) => catalogue.terms.find((t) => t.id === id);
/// A list of terms of one role, and who ships the one that is chosen.
function chooser(role, name, chosen, choose) {
  const select = make("select", { "aria-label": name, id: `term-${name}` });
  if (role === "diffuse") select.append(make("option", { value: "" }, "none"));
  for (const t of catalogue.terms) if (t.role === role) select.append(make("option", { value: t.short }, t.ships ? `${t.title} – ${t.ships}` : t.title));
  const term = chosen && term_of(chosen);
  select.value = term ? term.short : "";
  select.onchange = () => choose(select.value);
  const about = term ? make("small", {}, term.formula, make("br"), term.ships ? `shipped by ${term.ships}` : term.source) : "";
  return make("div", { class: "term" }, make("label", {}, name, select), about);
}
function swap(parts) {
  const item = items[active], short = (id) => (id.includes(".") && term_of(id) ? term_of(id).short : id);
  const spec = parts.filter((p) => p[0] !== "").map((p) => p.map(short).join("/")).join("+");
  try {
    with_text([spec], (s) => g.swap_model(item.handle, s));
    // It is another model: no name and no fit of the one before holds for it.
    Object.assign(item, { about: describe(item.handle), name: "", fit: null, changed: false });
    say("");
  } catch (error) {
    say(`${spec}: ${error.message}`, true);
  }
  show_all(), finish();
}
function show_model() {
  const item = items[active];
  if (!is_model(item)) return refill($("model"), [make("p", { class: "muted small" }, "A table has no sliders. Choose a model to move it.")]);
  const terms = make("details", { class: "terms" }, make("summary", {}, "Terms"));
  terms.open = $("model").querySelector(".terms")?.open ?? innerWidth > 900;
  const parts = item.about.parts, diffuse = parts.findIndex((p) => p.length === 1), nodes = [];
  const whole = make("select", { id: "whole", "aria-label": "Whole model or material" }, make("option", { value: "" }, "as below"));
  for (const [name] of materials()) whole.append(make("option", { value: name }, name));
  whole.onchange = () => become(whole.value);
  nodes.push(make("div", { class: "term" }, make("label", {}, "Become", whole)));
  const replaced = (k, value) => parts.map((p, i) => (i === k ? value : p));
  terms.append(chooser("diffuse", "Diffuse", diffuse < 0 ? null : parts[diffuse][0], (to) => swap(diffuse < 0 ? [[to], ...parts] : replaced(diffuse, [to]))));
  parts.forEach((part, k) => {
    if (part.length !== 3) return;
    const lobe = parts.slice(0, k).filter((p) => p.length === 3).length, ending = lobe ? ` ${lobe + 1}` : "";
    roles.forEach(([role, name], r) => terms.append(chooser(role, name + ending, part[r], (to) => swap(replaced(k, part.map((id, j) => (j === r ? to : id)))))));
  });
  const lobe = ["ggx", "smith_ggx.correlated", "schlick"], lobes = parts.filter((p) => p.length === 3).length, button = (id, text, to) => Object.assign(make("button", { id }, text), { onclick: () => swap(to) });
  terms.append(make("div", { class: "controls" }, button("add-lobe", "Add a lobe", [...parts, lobe]), ...(lobes > 1 || lobes && lobes < parts.length ? [button("take-lobe", "Take the last lobe away", parts.slice(0, -1))] : [])));
  nodes.push(terms);
  for (const p of item.about.parameters) for (let c = 0; c < p.count; ++c) nodes.push(slider(item, p, c));
  refill($("model"), nodes);
}
/// What a fit says of one value: in words, and between which ends it lies, if it says so.
function known(found, p) {
  const [status, low, high, reason] = found, why = reason ? `; ${reason}` : "", ends = [low, high].map((v) => Number.isFinite(v));
  if (status === "fixed") return ["held by the fit"];
  if (status === "at_bound") return [`fit: at the end of its range, and the data push beyond it${why}`];
  if (status === "not_identifiable") return [`fit: not known${why}`];
  if (status === "unbounded" || !ends.some(Boolean)) return [reason ? `fit: ${reason}` : ""];
  const words = ends[0] && ends[1] ? `95 % interval${p.roughness ? ` of ${p.name}` : ""} ${shown(low)} to ${shown(high)}` : ends[1] ? `at most ${shown(high)} (95 %)` : `at least ${shown(low)} (95 %)`;
  return [`fit: ${words}${why}`, ends[0] ? low : p.from, ends[1] ? high : p.to];
}
function slider(item, p, c) {
  const to_scale = (v) => clamp(p.log ? Math.log(v / p.from) / Math.log(p.to / p.from) : (v - p.from) / (p.to - p.from || 1), 0, 1);
  const from_scale = (x) => (p.log ? p.from * (p.to / p.from) ** x : p.from + (p.to - p.from) * x);
  const name = p.count > 1 ? `${p.name}.${channels_of(item)[c]}` : p.name, id = `value-${p.first + c}`;
  const range = make("input", { type: "range", id, min: 0, max: steps, step: 1 }), exact = make("input", { type: "number", step: "any", id: `exact-${p.first + c}`, "aria-label": `${name}, exact value` });
  const root = make("span"), value = (k) => numbers(g.values(item.handle) + 8 * (p.first + k), 1), now = () => value(c)[0];
  const tell = () => {
    exact.value = shown(now()), range.setAttribute("aria-valuetext", shown(now()));
    if (p.roughness) root.textContent = `${p.roughness} ${shown(g.roughness(now()))}; `;
  };
  const show = () => { range.value = Math.round(steps * to_scale(now())), tell(); };
  const move = (k, v) => { value(k)[0] = clamp(v, p.low, p.high), item.changed = true; };
  range.oninput = () => {
    const factor = from_scale(range.value / steps) / now();
    move(c, from_scale(range.value / steps)), tell(), redraw(item);
    if (!$("together").checked || p.count === 1 || !Number.isFinite(factor)) return;
    // Channels that were 0 follow none.
    for (let k = 0; k < p.count; ++k) if (k !== c) move(k, value(k)[0] * factor);
    for (const other of document.querySelectorAll(".slider")) other.show?.();
  };
  range.onchange = finish;
  exact.onchange = () => {
    const asked = Number(exact.value);
    if (exact.value !== "" && Number.isFinite(asked)) move(c, asked), say(asked < p.low || asked > p.high ? `${name} goes from ${shown(p.low)} to ${shown(p.high)}.` : "");
    show(), redraw(item), finish();
  };
  show();
  const track = make("div", { class: "track" }, range), found = item.fit?.parameters?.[p.name]?.[c], [words, ...ends] = found ? known(found, p) : [""];
  if (ends.length) {
    const [low, high] = ends.map(to_scale), bar = make("span", { class: "interval" });
    // As the thumb moves, whose middle stays half its width within.
    bar.style.left = `calc(8px + (100% - 16px) * ${low})`, bar.style.width = `calc((100% - 16px) * ${high - low})`;
    track.append(bar);
  }
  const said = [c === 0 ? p.meaning : "", words].filter(Boolean).join("; ");
  if (said) range.setAttribute("aria-describedby", `said-${p.first + c}`);
  return Object.assign(make("div", { class: "slider" }, make("label", { for: id }, name), track, exact, said || p.roughness ? make("small", { id: `said-${p.first + c}` }, root, said) : ""), { show: () => document.activeElement !== range && show() });
}

/// Whole models that are shipped, metals, and a few surfaces to begin with: name, spec, settings.
const materials = () => [
  ["Red plastic", "lambert+ggx/smith_ggx.correlated/schlick", "kd=0.5,0.03,0.02 alpha=0.05 f0=0.04"],
  ["Rubber", "lambert+ggx/smith_ggx.correlated/schlick", "kd=0.02 alpha=0.5 f0=0.04"],
  ["Brushed steel", "ggx_aniso/smith_ggx_aniso.correlated/schlick", "alpha_x=0.08 alpha_y=0.4 f0=0.56,0.57,0.58"],
  ...catalogue.metals.map((m) => [`${m.name} (measured n, k)`, "ggx/smith_ggx.correlated/conductor", `metal=${m.symbol} alpha=0.15`]),
  ...catalogue.models.map((m) => [`${m.title}${m.ships ? ` – ${m.ships}` : ""}`, m.id, ""]),
];
function become(name, added = false) {
  const found = materials().find(([n]) => n === name);
  if (!found) return;
  try {
    const item = bind(found[0], found[1], found[2], items[active].channels);
    if (added) active = items.push(item) - 1;
    else g.drop(items[active].handle), item.visible = items[active].visible, items[active] = item;
    say("");
  } catch (error) {
    say(`${name}: ${error.message}`, true);
  }
  show_all(), finish();
}

// ---- plots ----------------------------------------------------------------------------------------------------------------------
const edge = { left: 46, right: 10, top: 12, bottom: 30 };
function ticks_of(low, high, log) {
  const all = [];
  if (log && high >= 4 * low) {
    const decades = Math.log10(high / low), a = Math.ceil(Math.log10(low) - 1e-9), b = Math.floor(Math.log10(high) + 1e-9), each = Math.max(1, Math.ceil((b - a) / 6));
    const power = (k) => `10${String(k).replace(/./g, (c) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)])}`, plain = (v) => String(Number(v.toPrecision(1)));
    // Few decades have lines within them, so that each value can be read between two.
    const within = decades >= 3 ? [1] : decades >= 1.2 ? [1, 2, 5] : [1, 2, 3, 5, 7], whole = within.length === 1;
    for (let k = whole ? a : a - 1; k <= b; k += whole ? each : 1) for (const m of within) {
      const v = m * 10 ** k;
      if (v >= low * (1 - 1e-9) && v <= high * (1 + 1e-9)) all.push([v, k >= (whole ? 0 : -3) && k < 4 ? plain(v) : `${m > 1 ? `${m}·` : ""}${power(k)}`]);
    }
    return all;
  }
  const raw = (high - low) / 6, power = 10 ** Math.floor(Math.log10(raw)), step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= raw);
  for (let v = Math.ceil(low / step) * step; v <= high + step * 1e-9; v += step) all.push([v, String(Number(v.toPrecision(6)))]);
  return all;
}
/// Draws curves {x, y, colour, dashed, points} into a figure.  Answers what draws a cursor.
function draw_plot(figure, { x: [x0, x1], y: [y0, y1], log, x_ticks, curves, lights = [] }) {
  // In pixels as they are, so that text is as large as the page's.
  const width = clamp(figure.querySelector(".chart").clientWidth, 240, 900), height = Math.round(width * 0.56);
  const px = (x) => edge.left + (x - x0) / (x1 - x0) * (width - edge.left - edge.right);
  const part = (y) => (log ? Math.log(y / y0) / Math.log(y1 / y0) : (y - y0) / (y1 - y0));
  const py = (y) => height - edge.bottom - clamp(part(y), -0.02, 1.02) * (height - edge.top - edge.bottom);
  const svg = mark("svg", { viewBox: `0 0 ${width} ${height}`, xmlns: "http://www.w3.org/2000/svg" });
  for (const [x, text] of x_ticks.map((t) => (Array.isArray(t) ? t : [t, String(t)]))) svg.append(mark("path", { class: "axis", d: `M${px(x)} ${edge.top}V${height - edge.bottom}` }), mark("text", { x: px(x), y: height - edge.bottom + 17, "text-anchor": "middle" }, text));
  for (const [y, text] of ticks_of(y0, y1, log)) svg.append(mark("path", { class: "axis", d: `M${edge.left} ${py(y)}H${width - edge.right}` }), mark("text", { x: edge.left - 6, y: py(y) + 4, "text-anchor": "end" }, text));
  for (const x of lights) svg.append(mark("path", { class: "light", d: `M${px(x)} ${edge.top}V${height - edge.bottom}` }));
  for (const c of curves) {
    let d = "", pen = false;
    for (let i = 0; i < c.x.length; ++i) {
      const there = Number.isFinite(c.y[i]) && (!log || c.y[i] > 0);
      if (there && c.points) svg.append(mark("circle", { cx: px(c.x[i]).toFixed(1), cy: py(c.y[i]).toFixed(1), r: 2.2, style: `fill: var(--c${c.colour})` }));
      else if (there && c.dots) d += `M${px(c.x[i]).toFixed(1)} ${py(c.y[i]).toFixed(1)}h0`;
      else if (there) d += `${pen ? "L" : "M"}${px(c.x[i]).toFixed(1)} ${py(c.y[i]).toFixed(1)}`;
      pen = there;
    }
    if (d) svg.append(mark("path", { class: `curve${c.dashed ? " dashed" : c.dots ? " dots" : ""}`, d, style: `stroke: var(--c${c.colour})` }));
  }
  figure.querySelector(".chart").replaceChildren(svg);
  const cursor = (x) => svg.append(mark("path", { class: "cursor", d: `M${px(x)} ${edge.top}V${height - edge.bottom}` }));
  return { cursor };
}
/// What a reading says: one entry for each curve, with its full value for whoever reads by program.
function read_out(figure, at, where, entries) {
  const box = figure.querySelector(".readout");
  box.dataset.at = at, box.dataset.values = JSON.stringify(entries.map(([name, , v]) => [name, v]));
  box.replaceChildren(where, ...entries.flatMap(([name, colour, v, unit]) => [" ", make("span", { class: "entry" }, make("span", { style: `color: var(--c${colour})` }, "● "), `${name} `, make("b", {}, shown(v)), unit ?? "")]));
}
const nearest = (list, x) => list.reduce((best, v, i) => (Math.abs(v - x) < Math.abs(list[best] - x) ? i : best), 0);
const channel_of = (item) => Math.min(view.channel, item.channels.length - 1);
const drawn = () => items.map((item, i) => [item, i]).filter(([item]) => item.visible);

function cut_angles() {
  const all = new Set();
  for (let t = -89; t <= 89; ++t) all.add(t);
  all.add(view.theta);
  for (let d = 0.02; d < 12; d *= 1.3) for (const t of [view.theta - d, view.theta + d]) if (Math.abs(t) < 89.5) all.add(t);
  return Float64Array.from(all).sort();
}
let cuts = { angles: [], curves: [] }, cursor = null, albedos = { angles: [], curves: [] }, albedo_cursor = null;
function evaluate_cut() {
  const angles = cut_angles();
  numbers(room.x, angles.length).set(angles);
  cuts = { angles, curves: [] };
  for (const [item, i] of drawn()) {
    const channels = split(checked(g.cut(item.handle, view.theta, view.phi, angles.length, room.x, room.f)), angles.length);
    cuts.curves.push({ name: label(item), colour: i, x: angles, y: channels[channel_of(item)], channels });
    const own = (item.cuts ?? []).find((c) => Math.abs(c.theta_i - view.theta) <= 0.75);
    if (own) cuts.curves.push({ name: `${label(item)}, its own values at ${degrees(own.theta_i)}`, colour: i, x: own.theta_o, y: own.f[channel_of(item)], points: true });
  }
}
function draw_cut() {
  let high = 0, low = Infinity;
  for (const c of cuts.curves) for (const v of c.y) if (v > 0 && v < Infinity) high = Math.max(high, v), low = Math.min(low, v);
  if (!(high > 0)) high = 1, low = 0.1;
  low = Math.max(low, high * 1e-6);
  const y = view.log ? [10 ** Math.floor(Math.log10(low) + 0.01), high * 1.3] : [0, high * 1.05];
  const plot = draw_plot($("cut"), { x: [-90, 90], y, log: view.log, x_ticks: [-90, -60, -30, 0, 30, 60, 90], curves: cuts.curves, lights: [view.theta, -view.theta] });
  const at = nearest(cuts.angles, cursor ?? view.theta);
  plot.cursor(cuts.angles[at]);
  read_out($("cut"), cuts.angles[at], `θo ${degrees(cuts.angles[at])}`, cuts.curves.filter((c) => !c.points).map((c) => [c.name, c.colour, c.y[at], " 1/sr"]));
  draw_polar(high, at);
}
function draw_polar(high, at) {
  const radius = (f) => (view.log ? clamp(1 + Math.log10(f / high) / 4, 0, 1) : f / high), size = 200;
  const place = (theta, r) => `${(size * r * Math.sin(theta * Math.PI / 180)).toFixed(1)} ${(-size * r * Math.cos(theta * Math.PI / 180)).toFixed(1)}`;
  const text = 12 * 520 / clamp($("polar").querySelector(".chart").clientWidth, 240, 900);
  const svg = mark("svg", { viewBox: "-260 -225 520 290", xmlns: "http://www.w3.org/2000/svg", style: `font-size: ${text}px` });
  for (const r of [0.25, 0.5, 0.75, 1]) svg.append(mark("path", { class: "axis", d: `M${-size * r} 0A${size * r} ${size * r} 0 0 1 ${size * r} 0` }));
  for (let t = -90; t <= 90; t += 30) svg.append(mark("path", { class: "axis", d: `M0 0L${place(t, 1)}` }), mark("text", { x: 216 * Math.sin(t * Math.PI / 180), y: -212 * Math.cos(t * Math.PI / 180) + 4, "text-anchor": "middle" }, `${t}°`));
  svg.append(mark("path", { class: "light", d: `M${place(-view.theta, 1)}L0 0` }), mark("text", { x: 0, y: 40, "text-anchor": "middle" }, view.log ? "each ring is a factor of 10" : `outermost ring: ${shown(high)} 1/sr`));
  for (const c of cuts.curves) {
    if (c.points) continue;
    const d = [...c.y].map((f, i) => (f > 0 ? place(c.x[i], radius(f)) : "0 0")).join("L");
    svg.append(mark("path", { class: "curve", d: `M0 0L${d}Z`, style: `stroke: var(--c${c.colour})` }));
  }
  svg.append(mark("path", { class: "cursor", d: `M0 0L${place(cuts.angles[at], 1)}` }));
  $("polar").querySelector(".chart").replaceChildren(svg);
}
/// Of the model that is moved, at the samples of each table.
function draw_measured() {
  const curves = [], model = items[active], stride = 4;
  let low = Infinity, high = 0;
  for (const [item, i] of drawn()) if (comparable(item)) {
    const n = checked(g.measured_and_modelled(model.handle, item.samples, channel_of(item), stride, room.f));
    const [measured, y] = split(2, n), there = [...measured.keys()].filter((k) => measured[k] > 0 && y[k] > 0);
    for (const k of there) low = Math.min(low, measured[k], y[k]), high = Math.max(high, measured[k], y[k]);
    curves.push({ colour: i, x: there.map((k) => Math.log10(measured[k])), y: there.map((k) => y[k]), dots: true });
  }
  $("measured").hidden = !curves.length;
  if (!(high > 0)) return;
  // All that the tables have, and a model's values up to a factor of 1000 beyond; others stand at the edge.
  const measured = curves.flatMap((c) => c.x), least = 10 ** Math.min(...measured), most = 10 ** Math.max(...measured);
  low = 10 ** Math.floor(Math.log10(Math.max(low, least / 1000)) + 1e-9), high = 10 ** Math.ceil(Math.log10(Math.min(high, most * 1000)) - 1e-9);
  const ends = [Math.log10(low), Math.log10(high)], beyond = curves.reduce((n, c) => n + c.y.filter((v) => v < low || v > high).length, 0);
  $("measured").querySelector(".readout").textContent = beyond ? `${beyond} of the model's values lie further away: they are drawn at the edge.` : "";
  curves.push({ colour: active, x: ends, y: [low, high], dashed: true });
  draw_plot($("measured"), { x: ends, y: [low, high], log: true, x_ticks: ticks_of(low, high, true).map(([v, text]) => [Math.log10(v), text]), curves });
}
const albedo_angles = Float64Array.from({ length: 18 }, (_, i) => 5 * i);
function evaluate_albedo() {
  const n = albedo_angles.length;
  albedos = { angles: albedo_angles, curves: [] };
  for (const [item, i] of drawn()) {
    if (!is_model(item)) {
      if (item.albedo.length) albedos.curves.push({ name: label(item), colour: i, x: item.albedo.map((a) => a.theta_i), y: item.albedo.map((a) => a.value[channel_of(item)] ?? NaN), points: true });
      continue;
    }
    for (const dashed of items[active] === item ? [false, true] : [false]) {
      numbers(room.x, n).set(albedo_angles);
      const e = split(checked(g.albedo(item.handle, n, room.x, dashed, room.f)), n);
      albedos.curves.push({ name: dashed ? `${label(item)}, first lobe with F = 1` : label(item), colour: i, x: albedo_angles, y: e[channel_of(item)], channels: e, dashed, item });
    }
  }
}
function draw_albedo() {
  let high = 1;
  for (const c of albedos.curves) for (const v of c.y) if (v < 20) high = Math.max(high, v);
  const plot = draw_plot($("albedo"), { x: [0, 90], y: [0, high * 1.05], log: false, x_ticks: [0, 15, 30, 45, 60, 75, 90], curves: albedos.curves, lights: [view.theta] });
  const at = nearest(albedo_angles, albedo_cursor ?? view.theta);
  plot.cursor(albedo_angles[at]);
  read_out($("albedo"), albedo_angles[at], `θi ${degrees(albedo_angles[at])}`, albedos.curves.filter((c) => !c.points).map((c) => [c.name, c.colour, c.y[at]]));
}

// ---- the lobe in space ----------------------------------------------------------------------------------------------------------
let solid = null;
/// Corners of the lobe of what is chosen, close together where its highlight is: x along the mirror direction, z up.
function evaluate_lobe() {
  const item = items[active], near = [0.4, 0.8, 1.5, 2.5, 4].flatMap((d) => [-d, d]);
  const sorted = (list, low, high) => Float64Array.from(new Set(list.filter((v) => v >= low && v <= high))).sort();
  const thetas = sorted([...Array.from({ length: 30 }, (_, i) => 3 * i), 89.5, view.theta, ...near.map((d) => view.theta + d)], 0, 89.5);
  const phis = sorted([...Array.from({ length: 61 }, (_, i) => 6 * i - 180), ...near], -180, 180), n = thetas.length * phis.length;
  numbers(room.x, thetas.length).set(thetas), numbers(room.x + 8 * thetas.length, phis.length).set(phis);
  const f = split(checked(g.lobe(item.handle, view.theta, view.phi, thetas.length, phis.length, room.x, room.f)), n)[channel_of(item)];
  const high = f.reduce((most, v) => (v > most ? v : most), 0) || 1, at = new Float64Array(3 * n);
  for (let i = 0; i < n; ++i) {
    const r = !(f[i] > 0) ? 0 : view.log ? clamp(1 + Math.log10(f[i] / high) / 4, 0, 1) : f[i] / high;
    const t = thetas[Math.floor(i / phis.length)] * Math.PI / 180, p = phis[i % phis.length] * Math.PI / 180;
    at.set([r * Math.sin(t) * Math.cos(p), r * Math.sin(t) * Math.sin(p), r * Math.cos(t)], 3 * i);
  }
  solid = { at, rows: thetas.length, columns: phis.length };
}
function draw_lobe() {
  const canvas = $("lobe").querySelector("canvas"), scale = devicePixelRatio || 1, c = canvas.getContext("2d"), style = getComputedStyle(document.documentElement);
  canvas.width = canvas.clientWidth * scale, canvas.height = canvas.clientHeight * scale;
  const size = 0.7 * Math.min(canvas.height, canvas.width / 2), [yaw, pitch] = view.turn, [cy, sy, cp, sp] = [Math.cos(yaw), Math.sin(yaw), Math.cos(pitch), Math.sin(pitch)];
  /// To the right, up, and towards the viewer.
  const seen = (x, y, z) => { const u = x * cy - y * sy, v = x * sy + y * cy; return [u, z * cp + v * sp, z * sp - v * cp]; };
  const place = ([u, v]) => [canvas.width / 2 + size * u, 0.76 * canvas.height - size * v];
  const path = (points) => { c.beginPath(); points.forEach((p, i) => (i ? c.lineTo(...place(p)) : c.moveTo(...place(p)))); };
  c.strokeStyle = style.getPropertyValue("--rule"), c.lineWidth = scale;
  path(Array.from({ length: 73 }, (_, k) => seen(Math.cos(k * Math.PI / 36), Math.sin(k * Math.PI / 36), 0))), c.stroke();
  const t = view.theta * Math.PI / 180;
  c.strokeStyle = style.getPropertyValue("--muted"), c.setLineDash([3 * scale, 3 * scale]);
  path([seen(-Math.sin(t), 0, Math.cos(t)), [0, 0, 0]]), c.stroke(), c.setLineDash([]);
  const corners = Array.from({ length: solid.at.length / 3 }, (_, i) => seen(...solid.at.subarray(3 * i, 3 * i + 3))), faces = [];
  for (let i = 0; i + 1 < solid.rows; ++i) for (let k = 0; k + 1 < solid.columns; ++k) {
    const q = [0, 1, solid.columns + 1, solid.columns].map((d) => corners[i * solid.columns + k + d]);
    const [a, b] = [0, 1, 2].map((d) => [q[2][d] - q[0][d], q[3][d] - q[1][d]]).reduce(([x, y], [u, v]) => [[...x, u], [...y, v]], [[], []]);
    const normal = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]], length = Math.hypot(...normal);
    if (length > 1e-9) faces.push([q[0][2] + q[1][2] + q[2][2] + q[3][2], q, Math.abs(normal[2]) / length]);
  }
  faces.sort((x, y) => x[0] - y[0]);
  const [red, green, blue] = style.getPropertyValue(`--c${active}`).trim().match(/[0-9a-f]{2}/gi).map((h) => parseInt(h, 16));
  for (const [, q, facing] of faces) {
    const lit = 0.45 + 0.55 * facing;
    c.fillStyle = c.strokeStyle = `rgb(${red * lit} ${green * lit} ${blue * lit})`;
    path(q), c.closePath(), c.fill(), c.stroke();
  }
}

// ---- pictures -------------------------------------------------------------------------------------------------------------------
let slices = new Map();
/// A table that the model which is moved can be held against.
const comparable = (item) => !is_model(item) && is_model(items[active]) && items[active].channels.length === item.channels.length;
/// A canvas for each surface that is drawn, and of the model that is moved beside each table their ratio.
function make_pictures() {
  const canvas = (id, size, name, colour, what) => {
    const picture = make("canvas", { id, width: size, height: size, role: "img", "aria-label": `${what} of ${name}` });
    return make("figure", {}, picture, make("figcaption", {}, make("span", { style: `color: var(--c${colour})` }, "● "), name));
  };
  $("spheres").querySelector(".pictures").replaceChildren(...drawn().map(([item, i]) => canvas(`sphere-${i}`, sphereSize, label(item), i, "Lit sphere")));
  $("slices").querySelector(".pictures").replaceChildren(
    ...drawn().map(([item, i]) => canvas(`slice-${i}`, sliceSize, label(item), i, "Image slice")),
    ...drawn().filter(([item]) => comparable(item)).map(([item, i]) => canvas(`ratio-${i}`, mapSize, `the model over ${label(item)} at its samples: blue too dark, orange too bright, by a factor of 2 or more where full`, i, "Ratio")));
  for (const picture of $("spheres").querySelectorAll("canvas")) picture.onpointerdown = picture.onpointermove = (e) => {
    if (e.type === "pointerdown") picture.setPointerCapture(e.pointerId);
    if (!e.buttons) return;
    const box = picture.getBoundingClientRect(), x = (2 * (e.clientX - box.left) / box.width - 1) / 0.96, y = -(2 * (e.clientY - box.top) / box.height - 1) / 0.96;
    const r = Math.hypot(x, y), k = Math.min(1, 0.999 / r);
    view.light = [x * k, y * k, Math.sqrt(Math.max(1 - (r * k) ** 2, 0))];
    view.lamp = "", dirty.light = true, show_view(), redraw();
  };
  for (const picture of $("spheres").querySelectorAll("canvas")) picture.onpointerup = finish;
  for (const [item, i] of drawn()) $(`slice-${i}`).onpointermove = (e) => {
    const box = e.target.getBoundingClientRect(), x = clamp(Math.floor((e.clientX - box.left) / box.width * sliceSize), 0, sliceSize - 1), y = clamp(Math.floor((e.clientY - box.top) / box.height * sliceSize), 0, sliceSize - 1);
    const f = slices.get(item);
    if (f) read_out($("slices"), y * sliceSize + x, `θh ${degrees((x + 0.5) / sliceSize * 90)}, θd ${degrees((sliceSize - y - 0.5) / sliceSize * 90)}`, f.map((channel, c) => [`${label(item)} ${f.length > 1 ? channels_of(item)[c] : ""}`, i, channel[y * sliceSize + x], " 1/sr"]));
  };
}
function put(id, size) {
  const pixels = new Uint8ClampedArray(g.memory.buffer, room.rgba, 4 * size * size);
  $(id)?.getContext("2d").putImageData(new ImageData(pixels.slice(), size, size), 0, 0);
}
// A perfect diffuser, lit from above, is white at exposure 0.
const exposure = () => Math.PI * 2 ** view.ev;
const lamps = () => [...catalogue.lights, ...catalogue.wide_lights], wide_lamp = () => catalogue.wide_lights.indexOf(view.lamp);
function draw_spheres() {
  // Under a light that extends, spheres are compared under the first that does not.
  if (dirty.light) checked(view.lamp ? g.sphere_under(sphereSize, Math.max(catalogue.lights.indexOf(view.lamp), 0)) : g.sphere(sphereSize, ...view.light));
  for (const [item, i] of drawn()) {
    if (!dirty.light && !dirty.all && !dirty.items.has(item)) continue;
    if (wide_lamp() >= 0) checked(g.wide_sphere(item.handle, sphereSize, wide_lamp())), item.passes = 0;
    else checked(g.draw(item.handle, sphereSize, exposure(), room.rgba)), put(`sphere-${i}`, sphereSize), item.passes = catalogue.passes;
  }
  gather();
}
let gathering = 0;
/// Light that extends is gathered, with each frame a pass more of the sphere that has fewest.
function gather() {
  cancelAnimationFrame(gathering), gathering = 0;
  const [item, i] = drawn().reduce((least, one) => (one[0].passes < least[0].passes ? one : least), [{ passes: catalogue.passes }, 0]);
  if (item.passes >= catalogue.passes) return;
  item.passes = checked(g.gather(item.handle, exposure(), room.rgba)), put(`sphere-${i}`, sphereSize);
  gathering = requestAnimationFrame(safely(gather));
}
function draw_slices() {
  for (const [item, i] of drawn()) {
    if (!dirty.all && !dirty.items.has(item)) continue;
    const channels = checked(g.slice(item.handle, sliceSize, view.phid, exposure(), view.slog ? 1 : 0, room.f, room.rgba));
    slices.set(item, split(channels, sliceSize ** 2)), put(`slice-${i}`, sliceSize);
  }
}
function sphere_words(model, table) {
  checked(g.sphere_difference(model.handle, table.handle, exposure(), room.f));
  const [median, p95, covered] = numbers(room.f, 3);
  return covered > 0.3 ? ` Their spheres differ${wide_lamp() < 0 ? "" : ` under ${catalogue.lights[0]}`} by ΔE2000 ${median.toFixed(1)}, 95 % of the pixels by at most ${p95.toFixed(1)}.` : "";
}
/// Says that the comparison counts samples which the fit left out.
const beside_fit = (model, table) => (model.fit?.file === table.name && model.fit.log_rms !== undefined ? `, those too that the fit leaves out${model.fit.left_out ? ` by ${model.fit.left_out}` : ""}` : "");
/// What is on screen in words.
function show_facts() {
  const model = items[active], lines = [];
  if (is_model(model)) {
    lines.push(`${label(model)} takes ${model.about.operations} operations a sample, in ${model.channels.length} ${model.channels.length === 1 ? "channel" : "channels"}.`);
    const of = (dashed) => albedos.curves.find((c) => c.item === model && Boolean(c.dashed) === dashed), all = of(false), white = of(true);
    if (all && white) {
      const at = nearest(albedo_angles, view.theta);
      lines.push(`${label(model)} at θi ${degrees(albedo_angles[at])}: albedo ${all.channels.map((e) => shown(Number(e[at].toPrecision(3)))).join(", ")}; ${model.about.parts.some((p) => p.length === 3) ? `its first lobe with F = 1 reflects ${shown(Number(white.channels[0][at].toPrecision(3)))}${white.channels[0][at] <= 1 ? ", the rest is lost between facets" : ": more than arrives"}` : "it has no lobe"}.`);
    }
    for (const table of items) if (comparable(table)) {
      checked(g.difference(model.handle, table.samples, room.f, room.rgba)), put(`ratio-${items.indexOf(table)}`, mapSize);
      const [n, typical, worst, h, d] = numbers(room.f, 5);
      lines.push(n ? `${label(model)} beside ${label(table)}: typical factor ×/÷ ${typical.toFixed(3)} over ${n} values${beside_fit(model, table)}; worst sample at θh ${degrees(h)}, θd ${degrees(d)}, where the model is ${worst > 1 ? `${shown(Number(worst.toPrecision(3)))} times too bright` : `${shown(Number((1 / worst).toPrecision(3)))} times too dark`}.${sphere_words(model, table)}` : `${label(model)} and ${label(table)} have no value in common.`);
    }
  }
  $("facts").replaceChildren(...lines.map((line) => make("p", {}, line)));
}

// ---- when what is drawn ---------------------------------------------------------------------------------------------------------
const dirty = { all: true, light: true, items: new Set(), waiting: 0 };
let slow = 0;
/// Draws again before the next frame; integrals a little later, when the hand rests.
function redraw(item) {
  if (item) dirty.items.add(item);
  else dirty.all = true;
  if (!dirty.waiting) dirty.waiting = setTimeout(safely(draw), 0);
  clearTimeout(slow), slow = setTimeout(safely(() => { evaluate_lobe(), draw_lobe(), evaluate_albedo(), draw_albedo(), draw_measured(), show_facts(); }), 60);
}
function draw() {
  dirty.waiting = 0;
  document.querySelector(".turned").hidden = !items.some((item) => is_model(item) && item.about.anisotropic);
  evaluate_cut(), draw_cut(), draw_spheres(), draw_slices();
  dirty.all = dirty.light = false, dirty.items.clear();
}
/// An error of the module is said, and does not end the page.
function safely(call) {
  return (...what) => {
    try { return call(...what); } catch (error) { say(error instanceof WebAssembly.RuntimeError ? `The evaluator stopped (${error.message}): reload the page.` : error.message, true); }
  };
}

// ---- controls -------------------------------------------------------------------------------------------------------------------
function show_view() {
  for (const [id, unit] of [["theta", "°"], ["phi", "°"], ["phid", "°"], ["ev", " EV"]]) {
    $(id).value = view[id];
    const said = `${Number(Number(view[id]).toFixed(2))}${unit}`;
    document.querySelector(`output[for="${id}"]`).textContent = said, $(id).setAttribute("aria-valuetext", said);
  }
  // Channels are called as those of what is chosen.
  const all = channels_of([items[active], ...items].reduce((a, b) => (b.channels.length > a.channels.length ? b : a)));
  $("channel").replaceChildren(...all.map((name, c) => make("option", { value: c }, { r: "red", g: "green", b: "blue" }[name] ?? name)));
  $("log").checked = view.log, $("slog").checked = view.slog, $("channel").value = Math.min(view.channel, all.length - 1), $("lamp").value = view.lamp;
}
function turn_light(theta) {
  view.theta = clamp(Math.round(2 * Math.abs(theta)) / 2, 0, 89);
  show_view(), redraw();
}
function connect() {
  for (const id of ["theta", "phi", "phid", "ev"]) {
    $(id).oninput = () => { view[id] = Number($(id).value); show_view(), redraw(); };
    $(id).onchange = finish;
  }
  for (const id of ["log", "slog"]) $(id).onchange = () => { view[id] = $(id).checked; redraw(), finish(); };
  $("lamp").onchange = () => { view.lamp = $("lamp").value, dirty.light = true, redraw(), finish(); };
  $("channel").onchange = () => { view.channel = Number($("channel").value); redraw(), finish(); };
  $("what").append(...materials().map(([name]) => make("option", { value: name }, name)));
  $("add").onclick = () => become($("what").value, true);
  $("remove").onclick = () => { if (is_model(items[active])) g.drop(items[active].handle); items.splice(active, 1), active = Math.min(active, items.length - 1), show_all(), finish(); };
  $("undo").onclick = safely(() => travel(past, future));
  $("redo").onclick = safely(() => travel(future, past));
  $("reset").onclick = safely(() => { restore(began), finish(); });
  let a = began;
  $("mark").onclick = () => { a = state(); say("A is what you see now. Hold the key A to compare."); };
  const hold = safely(() => { if (held === null) held = state(), restore(a), say("This is A."); });
  const release = safely(() => { if (held !== null) { const back = held; restore(back), held = null, say(""); } });
  $("compare").onpointerdown = hold, $("compare").onpointerup = $("compare").onpointerleave = $("compare").onpointercancel = release;
  $("compare").onkeydown = (e) => { if (e.key === " " || e.key === "Enter") e.preventDefault(), hold(); };
  $("compare").onkeyup = $("compare").onblur = release;
  addEventListener("blur", release);
  const typing = (e) => e.target.matches?.("select, textarea, input[type=number], #fitting input");
  addEventListener("keydown", (e) => {
    if ((e.ctrlKey || e.metaKey) && e.key.toLowerCase() === "z" && !typing(e)) e.preventDefault(), $(e.shiftKey ? "redo" : "undo").click();
    else if (e.key.toLowerCase() === "a" && !e.ctrlKey && !e.metaKey && !e.altKey && !typing(e)) hold();
  });
  addEventListener("keyup", (e) => { if (e.key.toLowerCase() === "a") release(); });
  addEventListener("resize", () => redraw());
  addEventListener("hashchange", safely(() => { if (location.hash !== own_address) from_address(), finish(); }));

  $("copy-spec").onchange = () => { copy(commands[$("copy-spec").value]()), $("copy-spec").value = ""; };
  $("copy-fit").onclick = safely(() => copy(fit_command()));
  $("copy-json").onclick = () => copy(document_text(), items[active].fit && documents.has(items[active].fit.id) ? ` It holds the channels that are shown, ${items[active].channels.join(" ")}; "Save as JSON" has the whole fit.` : "");
  $("copy-address").onclick = () => {
    const dropped = items.filter((item) => item.dropped).map(label).join(", ");
    copy(location.href, dropped && ` The address does not hold ${dropped}, as "Save page" does.`);
  };
  // A reading under the pointer in both views of the cut; a drag turns the light.
  const part_of = (e) => { const box = e.currentTarget.getBoundingClientRect(); return (e.clientX - box.left - edge.left) / (box.width - edge.left - edge.right); };
  const cut_x = (e) => -90 + part_of(e) * 180;
  const polar_x = (e) => { const box = e.currentTarget.getBoundingClientRect(); return Math.atan2(e.clientX - box.left - box.width / 2, box.top + 225 / 290 * box.height - e.clientY) * 180 / Math.PI; };
  for (const [id, angle] of [["cut", cut_x], ["polar", polar_x]]) {
    const plot = $(id).querySelector(".chart");
    plot.onpointermove = plot.onpointerdown = (e) => {
      const theta = clamp(angle(e), -89, 89);
      if (e.buttons) plot.setPointerCapture(e.pointerId), turn_light(theta);
      else cursor = theta, draw_cut();
    };
    plot.onpointerup = finish;
  }
  const albedo = $("albedo").querySelector(".chart");
  albedo.onpointermove = (e) => { albedo_cursor = clamp(part_of(e) * 90, 0, 85); draw_albedo(); };
  const space = $("lobe").querySelector("canvas"), tilt = (yaw, pitch) => { view.turn = [view.turn[0] + yaw, clamp(view.turn[1] + pitch, 0, 1.57)]; draw_lobe(); };
  space.onpointerdown = (e) => space.setPointerCapture(e.pointerId);
  space.onpointermove = (e) => { if (e.buttons) tilt(e.movementX / 100, e.movementY / 100); };
  space.onpointerup = finish;
  space.onkeydown = (e) => {
    const by = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1] }[e.key];
    if (by) e.preventDefault(), tilt(...by), finish();
  };
  $("cut").querySelector(".chart").onkeydown = (e) => step_by_key(e, (by) => { cursor = cuts.angles[clamp(nearest(cuts.angles, cursor ?? view.theta) + by, 0, cuts.angles.length - 1)]; draw_cut(); });
  albedo.onkeydown = (e) => step_by_key(e, (by) => { albedo_cursor = clamp((albedo_cursor ?? view.theta) + 5 * by, 0, 85); draw_albedo(); });
  connect_fitting();
  for (const id of ["cut", "polar", "albedo"]) add_save(id, "SVG", () => new Blob([svg_text(id)], { type: "image/svg+xml" }));
  for (const id of ["spheres", "slices"]) add_save(id, "PNG", () => png_of(id));
}
function step_by_key(e, step) {
  const by = { ArrowLeft: -1, ArrowRight: 1, PageUp: 10, PageDown: -10 }[e.key];
  if (by) e.preventDefault(), step(by);
}

// ---- what is taken away ---------------------------------------------------------------------------------------------------------
const model_words = () => `${items[active].about.spec} --set ${settings_of(values_of(items[active]))}`;
/// Evaluates the model where the reading in the cut stands.
function command() {
  const at = cuts.angles[nearest(cuts.angles, cursor ?? view.theta)], turned = at < 0 ? 0 : 180;
  return `printf 'theta_i,phi_i,theta_o,phi_o\\n${view.theta},${view.phi},${Math.abs(at)},${view.phi + turned}\\n' > directions.csv\ngonio eval ${model_words()} --directions directions.csv --json`;
}
const commands = {
  values: command,
  shader: () => `gonio shader ${model_words()} --language glsl`,
  gltf: () => exported("gltf", "gltf"), mitsuba: () => exported("mitsuba", "xml"), open_pbr: () => exported("open_pbr", "mtlx"),
};
const exported = (target, ending) => `printf '%s' '${JSON.stringify(JSON.parse(document_text()))}' > model.json\ngonio export model.json --to ${target} -o model.${ending}`;
/// A document that gonio reads as it reads a fit's.
function document_text() {
  const item = items[active], channels = channels_of(item);
  const parameters = Object.fromEntries(Object.entries(values_of(item)).map(([name, v]) => [name, { value: v.length === 1 ? v[0] : v }]));
  return JSON.stringify({ schema: "gonio.fit/1", model: item.about.spec, channels, parameters }, null, 1);
}
function copy(text, more = "") {
  const box = $("copied");
  box.hidden = false, box.value = text, box.select();
  const by_hand = () => say(`Select the text below the buttons to copy it.${more}`);
  if (!navigator.clipboard) return by_hand();
  navigator.clipboard.writeText(text).then(() => say(`Copied.${more}`), by_hand);
}
/// A plot that stands by itself: with the colours that it has here.
function svg_text(id) {
  const svg = $(id).querySelector("svg"), alone = svg.cloneNode(true), own = svg.querySelectorAll("*");
  alone.querySelectorAll("*").forEach((node, i) => {
    const style = getComputedStyle(own[i]);
    node.setAttribute("style", ["stroke", "fill", "stroke-width", "stroke-dasharray", "font-size", "font-family"].map((name) => `${name}: ${style.getPropertyValue(name)}`).join("; "));
  });
  return new XMLSerializer().serializeToString(alone);
}
function png_of(id) {
  const all = [...$(id).querySelectorAll("canvas")], whole = make("canvas", { width: all.reduce((n, c) => n + c.width + 4, 0), height: Math.max(...all.map((c) => c.height)) });
  let x = 0;
  for (const c of all) whole.getContext("2d").drawImage(c, x, 0), x += c.width + 4;
  return new Promise((done) => whole.toBlob(done));
}
function add_save(id, kind, bytes) {
  const button = make("button", { class: "save", "aria-label": `Save as ${kind}` }, kind);
  button.onclick = async () => {
    const address = URL.createObjectURL(await bytes());
    make("a", { href: address, download: `${id}.${kind.toLowerCase()}` }).click();
    setTimeout(() => URL.revokeObjectURL(address), 1000);
  };
  $(id).querySelector("figcaption").prepend(button);
}

function from_address() {
  const text = location.hash.slice(1);
  if (!text) return false;
  try {
    const missing = restore(decodeURIComponent(text));
    say(missing.length ? `The address shows ${missing.join(", ")}, too, which this page does not hold${can_fit ? ": drop it here" : ""}.` : "", missing.length > 0);
    return true;
  } catch (error) {
    restore(kept ?? began);
    say(`The address cannot be shown: ${error instanceof TypeError || error instanceof SyntaxError || error instanceof URIError ? "it was not made by a page of gonio explore" : error.message}`, true);
    return false;
  }
}
(async () => {
  try {
    page = JSON.parse($("explored").textContent);
    await start();
    checked(g.catalogue());
    catalogue = JSON.parse(answer());
    $("lamp").append(make("option", { value: "" }, "one, where you drag it"), ...lamps().map((name) => make("option", { value: name }, name)));
    for (const data of page.items) if (data.kind === "table") tables.push(hold_table(data));
    for (const [id, text] of Object.entries(page.documents ?? {})) documents.set(id, text);
    document.querySelector(".explorer").hidden = false;
    say("");
    began = first_state();
    if (!from_address() && !items.length) restore(began);
    kept = state();
    connect(), show_buttons();
  } catch (error) {
    say(`This page could not start: ${error.message}`, true);
  }
})();
