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
/// Bytes of a text in base 85 (src/base/base85.h): five characters from "*" on are four bytes, "!" stands for "<"; the last are fewer.
function from_85(text) {
  const bytes = new Uint8Array(Math.floor(text.length * 4 / 5));
  for (let i = 0, at = 0; i < text.length; i += 5) {
    let four = 0;
    for (let k = i; k < i + 5; ++k) {
      const c = k < text.length ? text.charCodeAt(k) : 126;
      four = 85 * four + (c === 33 ? 60 : c) - 42;
    }
    for (let k = 24; k >= 0 && at < bytes.length; k -= 8) bytes[at++] = four >>> k;
  }
  return bytes;
}
/// Bytes of a module, which stands in the page as its gzip.
const unpacked = (id) => new Response(new Blob([from_85($(id).textContent.trim())]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
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
let judged = null;  // the last comparison, whatever is shown
const documents = new Map();  // those of fits and comparisons, by their ids: too long for an address
const usual = "lambert+ggx/smith_ggx.correlated/schlick";
/// 45°, or the angle nearest to it at which a table has values of its own.
const first_angle = () => {
  const measured = items.flatMap((item) => (item.cuts ?? []).map((c) => c.theta_i));
  return measured.length ? measured.reduce((a, b) => (Math.abs(b - 45) < Math.abs(a - 45) ? b : a)) : 45;
};
const first_view = () => ({ theta: first_angle(), phi: 0, phid: 90, ev: 0, log: true, slog: false, channel: 1, light: [0.5, 0.6, 0.62], lamp: "", turn: [0.6, 0.45], table: "" });
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

/// Number of channels of the file or fit that an entry shows some of.
const channels_in_file = (item) => (is_model(item) ? item.fit?.all ?? Math.max(item.channels.length, ...items.filter((one) => !is_model(one) && one.channels.length === item.channels.length).map(channels_in_file))
  : item.channels_in_file ?? item.inspection?.channels.length ?? item.channels.length);

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
  compared = s.k && typeof s.k === "object" ? s.k : null, judged = compared ?? judged;
  $("mask").value = String(s.m ?? ""), $("words").value = String(s.o ?? "");
  view = first_view();
  for (const name of ["theta", "phi", "phid", "ev", "channel"]) if (Number.isFinite(s.w?.[name])) view[name] = s.w[name];
  view.theta = clamp(view.theta, 0, 89), view.channel = clamp(Math.trunc(view.channel), 0, 2);
  for (const name of ["log", "slog"]) if (typeof s.w?.[name] === "boolean") view[name] = s.w[name];
  if (lamps().includes(s.w?.lamp)) view.lamp = s.w.lamp;
  if (typeof s.w?.table === "string") view.table = s.w.table;
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
/// After a move is finished: what was before can be had again, the address says what is, and what was said of the move before is gone.
function finish() {
  if (held !== null) return;
  const now = state();
  if (now === kept) return;
  past.push(kept), future = [], kept = now;
  if (past.length > 200) past.shift();
  say(""), to_address(), show_names(), show_buttons();
}
let own_address = "";
function to_address() {
  own_address = `#${encodeURIComponent(kept)}`;
  if (location.hash !== own_address) location.replace(own_address);
}
function travel(from, to) {
  if (!from.length) return;
  to.push(kept), kept = from.pop();
  restore(kept), say(""), to_address(), show_buttons();
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
    pick.onchange = () => {
      active = i;
      if (!is_model(item)) view.table = item.name;
      show_model(), show_view(), show_buttons(), make_pictures(), redraw(), finish();
    };
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
    const valid = exact.value !== "" && Number.isFinite(asked);
    if (valid) move(c, asked);
    show(), redraw(item), finish();
    if (valid) say(asked < p.low || asked > p.high ? `${name} goes from ${shown(p.low)} to ${shown(p.high)}.` : "");
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
    const item = bind(found[0], found[1], found[2], (items.find((one) => !is_model(one) && one.name === items[active].fit?.file) ?? items[active]).channels);
    if (added) active = items.push(item) - 1;
    else g.drop(items[active].handle), item.visible = items[active].visible, items[active] = item;
    say("");
  } catch (error) {
    say(`${name}: ${error.message}`, true);
  }
  show_all(), finish();
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
  const all = channels_to_show();
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
  $("reset").onclick = safely(() => { restore(began), say(""), finish(); });
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
  addEventListener("hashchange", safely(() => {
    if (location.hash === own_address) return;
    const said = from_address();
    finish(), say(...said);
  }));

  $("copy-spec").onchange = () => { copy(commands[$("copy-spec").value]()), $("copy-spec").value = ""; };
  $("copy-fit").onclick = safely(() => copy(fit_command()));
  $("copy-json").onclick = () => {
    const item = items[active], text = whole_document() ?? document_text(), n = JSON.parse(text).channels.length, all = channels_in_file(item);
    copy(text, n < all ? ` It holds ${n} of ${all} channels, ${channels_of(item).join(" ")}${documents.has(item.fit?.id) ? "; “Save as JSON” has the whole fit" : ""}.` : "");
  };
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
/// The same of all channels of a fit that has more than are shown, while no value has moved; null where there is none.
function whole_document() {
  const item = items[active], d = documents.has(item.fit?.id) && !item.changed ? JSON.parse(documents.get(item.fit.id)) : null;
  if (!d || d.channels.length <= item.channels.length) return null;
  const parameters = Object.fromEntries(Object.entries(values_of(item)).map(([name, v]) => {
    const all = d.parameters[name]?.value;
    return [name, { value: v.length === 1 ? v[0] : d.channels.map((c, k) => v[item.channels.indexOf(c)] ?? all?.[k] ?? null) }];
  }));
  const known = Object.values(parameters).every((p) => !Array.isArray(p.value) || p.value.every(Number.isFinite));
  return known ? JSON.stringify({ schema: "gonio.fit/1", model: item.about.spec, channels: d.channels, parameters }, null, 1) : null;
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

/// \return  what to say of it, and whether it failed; nothing of a page without one
function from_address() {
  const text = location.hash.slice(1);
  if (!text) return [];
  try {
    const missing = restore(decodeURIComponent(text));
    return [missing.length ? `The address shows ${missing.join(", ")}, too, which this page does not hold${can_fit ? ": drop it here" : ""}.` : "", missing.length > 0];
  } catch (error) {
    restore(kept ?? began);
    return [`The address cannot be shown: ${error instanceof TypeError || error instanceof SyntaxError || error instanceof URIError ? "it was not made by a page of gonio explore" : error.message}`, true];
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
    began = first_state();
    const said = from_address();
    if (!items.length) restore(began);
    say(...said);
    kept = state();
    connect(), show_buttons();
  } catch (error) {
    say(`This page could not start: ${error.message}`, true);
  }
})();
