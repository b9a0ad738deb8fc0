"use strict";
// The page of a batch: all materials at once, then each.

const page = page_data();
const tables = page.tables.map((t, i) => ({ ...t, place: i, name: t.path.split("/").pop() }));
const fitted = tables.filter((t) => t.parameters);
const failed = tables.filter((t) => !t.parameters);

// --- What is known of a table as numbers --------------------------------------------------------------
const mean = (list) => { const v = list_of(list).filter(known); return v.length ? v.reduce((a, b) => a + b, 0) / v.length : null; };
const names = [...new Set(fitted.flatMap((t) => Object.keys(t.parameters)))];
const quantities = [
  ...names.map((name) => ({ name, of: (t) => (t.parameters?.[name] ? mean(t.parameters[name].value) : null) })),
  { name: "log_rms", label: "log RMS", of: (t) => t.log_rms ?? null },
  { name: "misfit", label: "misfit beyond noise", of: (t) => t.misfit ?? null },
  { name: "albedo", label: "albedo at 30°", of: (t) => (t.preview ? mean(t.preview.albedo) : null) },
  { name: "values_used", of: (t) => t.values_used ?? null },
  { name: "masked", of: (t) => t.masked ?? null },
];
const quantity = (name) => quantities.find((q) => q.name === name);
const label_of = (q) => q.label ?? words(q.name);
const has_channels = (name) => fitted.some((t) => list_of(t.parameters[name]?.value).length > 1);
const axis_label = (q) => label_of(q) + (names.includes(q.name) && has_channels(q.name) ? ", mean of the channels" : "");

/// Size of what its model misses, of f.
const misfit_text = (t) => (!known(t.misfit) ? "–" : t.misfit > 0.5 ? "above half" : percent(t.misfit));

/// What a reader should know of a table before using its numbers: [short, in full]
function flags(t) {
  const out = [];
  if (!t.parameters) return [[words(t.status), t.message]];
  if (t.status !== "ok") out.push([words(t.status), t.message]);
  if (t.misfit_told) out.push([`misfit ${misfit_text(t)}`, "what is left follows the angles, by so much beyond noise"]);
  for (const [status, full] of [["not_identifiable", "the data do not determine it"], ["upper_limit", "the data tell the upper end alone"],
    ["lower_limit", "the data tell the lower end alone"], ["at_bound", "the best value may lie beyond"]]) {
    const which = Object.entries(t.parameters).filter(([name, p]) => !name.startsWith("roughness") && list_of(p.status).includes(status)).map(([name]) => name);
    if (which.length) out.push([`${which.join(", ")}: ${status_words[status]}`, full]);
  }
  if (t.warnings.length) out.push([many(t.warnings.length, "warning"), t.warnings.join("\n")]);
  return out;
}
for (const t of tables) t.flags = flags(t);

// --- Its colour and its sphere ------------------------------------------------------------------------
const is_rgb = (t) => t.channels.join() === "r,g,b";
function color_of(t) {
  const a = is_rgb(t) ? t.preview.albedo : Array(3).fill(mean(t.preview.albedo) ?? 0);
  const byte = (x) => { const c = Math.min(1, Math.max(0, x ?? 0)); return Math.round(255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055)); };
  return `rgb(${a.map(byte).join(",")})`;
}
function sphere_image(t) {
  const bytes = atob(t.preview.sphere), n = Math.round(Math.sqrt(2 * bytes.length / 3));
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = n;
  const g = canvas.getContext("2d"), image = g.createImageData(n, n);
  for (let row = 0, at = 0; row < n; ++row)
    for (let column = n / 2; column < n; ++column, at += 3)
      for (const x of [column, n - 1 - column])
        image.data.set([bytes.charCodeAt(at), bytes.charCodeAt(at + 1), bytes.charCodeAt(at + 2), 255], 4 * (row * n + x));
  g.putImageData(image, 0, 0);
  return canvas;
}
function sized(canvas, width, height) {
  const scale = devicePixelRatio || 1;
  canvas.width = Math.round(width * scale);
  canvas.height = Math.round(height * scale);
  canvas.style.width = width + "px";
  canvas.style.height = height + "px";
  const g = canvas.getContext("2d");
  g.scale(scale, scale);
  return g;
}
function draw_sphere(canvas, t, size) {
  const g = sized(canvas, size, size), r = size / 2;
  g.beginPath();
  g.arc(r, r, r - 0.75, 0, 2 * Math.PI);
  g.clip();
  g.translate(r, r);
  g.rotate(-35 * Math.PI / 180);  // the light from the upper left
  g.imageSmoothingQuality = "high";
  // The pixels at the rim, half outside, lie just beyond the clip.
  g.drawImage(t.image ??= sphere_image(t), -r * 1.03, -r * 1.03, size * 1.03, size * 1.03);
}

// --- A small curve --------------------------------------------------------------------------------------
function draw_curve(canvas, t, width, height) {
  const g = sized(canvas, width, height), c = t.preview.curve;
  if (!c) return;
  const signed = c.along === "theta_o", from = signed ? -90 : 0;
  const x_of = (deg) => 1 + (width - 2) * (deg - from) / (90 - from);
  let low = Infinity, high = 0;
  for (const [deg, all] of [[c.data_deg, c.data], [c.model_deg, c.model]])
    for (const values of all)
      values.forEach((v, i) => { if (v > 0 && Math.abs(deg[i]) <= 80) { low = Math.min(low, v); high = Math.max(high, v); } });
  if (!(high > 0)) return;
  low = Math.min(low, high / 10);
  const y_of = (v) => height - 3 - (height - 6) * Math.log(Math.max(v, low / 10) / low) / Math.log(high / low);
  g.lineWidth = 1;
  g.strokeStyle = color("rule");
  for (let e = Math.ceil(Math.log10(low)); e <= Math.log10(high); ++e) {
    const y = Math.round(y_of(10 ** e)) + 0.5;
    g.beginPath(); g.moveTo(0, y); g.lineTo(width, y); g.stroke();
  }
  if (signed) {
    g.setLineDash([2, 2]);
    const x = Math.round(x_of(c.at_deg)) + 0.5;
    g.beginPath(); g.moveTo(x, 0); g.lineTo(x, height); g.stroke();
    g.setLineDash([]);
  }
  g.beginPath(); g.rect(0, 0, width, height); g.clip();
  c.data.forEach((values, k) => {
    g.fillStyle = color(channel_color(t.channels[c.channels[k]], k));
    g.globalAlpha = 0.55;
    values.forEach((v, i) => { if (v > 0) { g.beginPath(); g.arc(x_of(c.data_deg[i]), y_of(v), 1.7, 0, 2 * Math.PI); g.fill(); } });
    g.globalAlpha = 1;
  });
  c.model.forEach((values, k) => {
    g.strokeStyle = color(t.channels.length > 1 ? channel_color(t.channels[c.channels[k]], k) : "ink");
    g.lineWidth = 1.3;
    g.beginPath();
    let down = false;
    values.forEach((v, i) => {
      if (!(v > 0)) { down = false; return; }
      g[down ? "lineTo" : "moveTo"](x_of(c.model_deg[i]), y_of(v));
      down = true;
    });
    g.stroke();
  });
}

// --- Drawn when seen --------------------------------------------------------------------------------------
const waiting = new Map(), drawn = new Map();
const seen = new IntersectionObserver((entries) => {
  for (const e of entries) if (e.isIntersecting && waiting.has(e.target)) {
    const draw = waiting.get(e.target);
    waiting.delete(e.target);
    drawn.set(e.target, draw);
    seen.unobserve(e.target);
    draw();
  }
}, { rootMargin: "400px" });
function draw_when_seen(node, draw) { waiting.set(node, draw); seen.observe(node); return node; }
when_colors_change(() => drawn.forEach((draw) => draw()));
addEventListener("beforeprint", () => { for (const [node, draw] of waiting) { drawn.set(node, draw); draw(); } waiting.clear(); });

// --- All at once -------------------------------------------------------------------------------------------
const sorted_numbers = (list) => list.filter(known).sort((a, b) => a - b);
const median_of = (list) => { const v = sorted_numbers(list); return v.length ? v[v.length >> 1] : null; };
const log_rms_text = (x) => significant(x, 3);  // one form for all of them
const link = (t) => (t.page ?? t.document ? el("a", { href: "./" + encodeURIComponent(t.page ?? t.document) }, t.name) : t.name);

function verdict() {
  const typical = median_of(fitted.map((t) => t.log_rms));
  const far = fitted.filter((t) => t.misfit_told).length;
  return el("p", { class: "verdict" },
    known(typical) ? ["Half of the fits are within ", el("b", {}, "×/÷\u202f" + ratio(typical).slice(1)), ` of their table (log RMS ${log_rms_text(typical)}). `] : null,
    far ? `The model misses ${far === fitted.length && far > 1 ? "all" : count(far)} of them by more than noise. ` : null,
    page.counts.not_converged ? `${count(page.counts.not_converged)} did not converge. ` : null,
    failed.length ? `${count(failed.length)} could not be fitted. ` : null,
    page.missing.length ? `${count(page.missing.length)} more ${page.missing.length === 1 ? "is" : "are"} still to be fitted. ` : null);
}
/// Tables that have no result yet, by their paths.
function still_missing() {
  if (!page.missing.length) return null;
  return unfolded_on_paper(el("details", {}, el("summary", {}, `${many(page.missing.length, "table")} still to be fitted`),
    el("ul", { class: "warnings" }, page.missing.map((path) => el("li", {}, path)))));
}
function facts() {
  const fact = (name, value, rest = null) => el("div", {}, el("dt", {}, name), el("dd", {}, value, rest ? el("small", {}, " " + rest) : null));
  const time = fitted.reduce((sum, t) => sum + t.time_ms, 0);
  return el("dl", { class: "facts" },
    fact("tables", count(tables.length)), fact("fitted", count(page.counts.ok)),
    page.counts.not_converged ? fact("not converged", count(page.counts.not_converged)) : null,
    failed.length ? fact("failed", count(failed.length)) : null,
    page.missing.length ? fact("missing", count(page.missing.length)) : null,
    fact("with flags", count(fitted.filter((t) => t.flags.length).length)),
    fact("values", count(fitted.reduce((sum, t) => sum + t.values_used, 0))),
    fact("time of all fits", milliseconds(time), "in sum"));
}
function failures() {
  if (!failed.length) return null;
  const list = el("ul", { class: "warnings" }, failed.map((t) => el("li", {}, el("b", {}, words(t.status) + ":"), " ", t.message)));
  return failed.length <= 6 ? list : el("details", {}, el("summary", {}, `${count(failed.length)} tables could not be fitted`), list);
}

/// Ends and scale of an axis: logarithmic where the values span more than a factor of 20.
function span_of(values) {
  const v = sorted_numbers(values);
  if (!v.length) return { log: false, low: 0, high: 1 };
  let [low, high] = [v[0], v.at(-1)];
  const positive = v.filter((x) => x > 0);
  if (low >= 0 && positive.length > 1 && high / positive[0] > 20) {
    low = positive[0];
    const margin = (high / low) ** 0.04;
    return { log: true, low: low / margin, high: high * margin };
  }
  const margin = 0.04 * (high - low) || 0.1 * Math.abs(high) || 1;
  return { log: false, low: low >= 0 ? Math.max(0, low - margin) : low - margin, high: high + margin };
}
function even_ticks(low, high) {
  const raw = (high - low) / 5, power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((k) => k * power).find((s) => s >= raw);
  const out = [];
  for (let k = Math.ceil(low / step); k * step <= high * (1 + 1e-9); ++k) out.push(Number((k * step).toPrecision(6)));
  return out;
}
const place_on = (s, x) => (s.log ? Math.log(x / s.low) / Math.log(s.high / s.low) : (x - s.low) / (s.high - s.low));

function overview() {
  const state = { x: quantity("alpha") ?? quantities[0], y: quantity("f0") ?? quantity("kd") ?? quantities[1], near: null };
  const canvas = el("canvas", { class: "map", role: "img" });
  const readout = el("div", { class: "readout", "aria-live": "polite" });
  let width = 0, points = [];
  function draw() {
    const height = Math.round(Math.min(470, Math.max(340, width * 0.45)));
    const g = sized(canvas, width, height);
    canvas.style.width = "100%";
    const there = fitted.filter((t) => known(state.x.of(t)));
    const sx = span_of(there.map(state.x.of)), sy = span_of(there.map(state.y.of));
    const box = { left: 62, right: width - 10, top: 10, bottom: height - 128 }, bars = { top: height - 112, bottom: height - 40 };
    const x_of = (v) => box.left + (box.right - box.left) * place_on(sx, v);
    const y_of = (v) => box.bottom - (box.bottom - box.top) * place_on(sy, v);
    g.font = plot_font;
    const ticks = (s) => (s.log ? log_ticks(s.low, s.high) : even_ticks(s.low, s.high));
    g.textBaseline = "top";
    g.textAlign = "center";
    for (const v of ticks(sx)) {
      g.fillStyle = color("faint");
      g.fillRect(Math.round(x_of(v)), box.top, 1, bars.bottom - box.top);
      g.fillStyle = color("muted");
      g.fillText(tick_text(v), x_of(v), bars.bottom + 6);
    }
    g.fillText(axis_label(state.x), (box.left + box.right) / 2, bars.bottom + 22);
    g.textAlign = "right";
    g.textBaseline = "middle";
    for (const v of ticks(sy)) {
      g.fillStyle = color("faint");
      g.fillRect(box.left, Math.round(y_of(v)), box.right - box.left, 1);
      g.fillStyle = color("muted");
      g.fillText(tick_text(v), box.left - 6, y_of(v));
    }
    g.save();
    g.translate(8, (box.top + box.bottom) / 2);
    g.rotate(-Math.PI / 2);
    g.textAlign = "center";
    g.fillText(axis_label(state.y), 0, 0);
    g.restore();

    points = there.filter((t) => known(state.y.of(t)) && (!sx.log || state.x.of(t) > 0) && (!sy.log || state.y.of(t) > 0))
      .map((t) => ({ t, x: x_of(state.x.of(t)), y: y_of(state.y.of(t)) }));
    for (const p of points) {
      g.beginPath();
      g.arc(p.x, p.y, p.t === state.near ? 8 : 5.5, 0, 2 * Math.PI);
      g.fillStyle = color_of(p.t);
      g.fill();
      g.lineWidth = p.t === state.near || p.t.misfit_told ? 2 : 1;
      g.strokeStyle = p.t === state.near ? color("accent") : p.t.misfit_told ? color("warn") : color("muted");
      g.stroke();
    }
    const bins = Array(Math.max(8, Math.min(40, Math.round(2 * Math.sqrt(there.length))))).fill(0);
    for (const t of there) {
      const u = place_on(sx, state.x.of(t));
      if (u >= 0 && u <= 1) ++bins[Math.min(bins.length - 1, Math.floor(u * bins.length))];
    }
    const most = Math.max(...bins, 1), step = (box.right - box.left) / bins.length;
    g.fillStyle = color("accent");
    g.globalAlpha = 0.6;
    bins.forEach((n, i) => g.fillRect(box.left + i * step + 0.5, bars.bottom - (bars.bottom - bars.top) * n / most, step - 1, (bars.bottom - bars.top) * n / most));
    g.globalAlpha = 1;
    g.fillStyle = color("rule");
    g.fillRect(box.left, bars.bottom, box.right - box.left, 1);
    g.fillStyle = color("muted");
    g.fillText(count(most), box.left - 6, bars.top + 5);
    const line = median_of(there.map(state.x.of));
    canvas.setAttribute("aria-label", `${axis_label(state.y)} against ${axis_label(state.x)} of ${many(points.length, "table")}, and how many have which ${label_of(state.x)}; its median is ${significant(line)}.`);
  }
  function say() {
    const t = state.near, hidden = fitted.length - points.length;
    readout.replaceChildren(...(t
      ? [el("b", {}, t.name), `: ${label_of(state.x)} ${significant(state.x.of(t), 4)}, ${label_of(state.y)} ${significant(state.y.of(t), 4)}, log RMS ${log_rms_text(t.log_rms)}. Click to see it below.`]
      : [el("span", { class: "hint" }, "Point at a dot to read it."), hidden > 0 ? ` ${many(hidden, "table")} without a value of both ${hidden === 1 ? "is" : "are"} not shown.` : ""]));
  }
  const nearest = (e) => {
    const r = canvas.getBoundingClientRect(), x = e.clientX - r.left, y = e.clientY - r.top;
    let best = null, least = 16 ** 2;
    for (const p of points) {
      const d = (p.x - x) ** 2 + (p.y - y) ** 2;
      if (d < least) { least = d; best = p.t; }
    }
    return best;
  };
  const point_at = (t) => { if (t !== state.near) { state.near = t; draw(); say(); canvas.style.cursor = t ? "pointer" : ""; } };
  canvas.addEventListener("pointermove", (e) => point_at(nearest(e)));
  canvas.addEventListener("pointerleave", () => point_at(null));
  canvas.addEventListener("click", (e) => { const t = nearest(e); if (t) show_only(t); });
  const select = (label, which) => el("label", {}, label + " ", el("select", {
    onchange: (e) => { state[which] = quantity(e.target.value); draw(); say(); } },
    quantities.map((q) => el("option", { value: q.name, selected: q === state[which] ? "" : null }, label_of(q)))));
  const node = el("div", {}, el("div", { class: "controls" }, select("across", "x"), select("up", "y")), canvas, readout);
  when_resized(canvas, (w) => { width = w; draw(); say(); });
  when_colors_change(() => width && draw());
  return section("All materials", "One dot per table in the colour of its fitted model under white light from everywhere; with an orange rim where the model misses the table by more than noise. "
    + "Below, how many have which value.", node);
}

// --- Each ------------------------------------------------------------------------------------------------
function values_text(p) {
  const values = list_of(p.value), limits = list_of(p.limit), states = list_of(p.status);
  if (values.length <= 4) return values.map((v, c) => (known(limits[c]) ? limit_text(states[c], limits[c]) : significant(v, 3))).join(", ");
  if (values.every((v) => !known(v))) return "–";
  const there = sorted_numbers(values);  // a spectrum
  return `${significant(there[0], 3)} to ${significant(there.at(-1), 3)}`;
}
const shown_names = names.filter((n) => !n.startsWith("roughness"));
function flag_list(t) {
  return t.flags.length ? el("span", { class: "flags" }, t.flags.map(([short, full]) => el("span", { title: full }, short))) : null;
}
function card(t) {
  if (!t.parameters)
    return el("article", { class: "card failed" }, el("h3", {}, t.name), el("p", { class: "small" }, el("b", {}, words(t.status)), " ", t.message));
  const sphere = el("canvas", { role: "img", "aria-label": `sphere of ${t.name}` });
  const curve = el("canvas", { class: "curve", role: "img", "aria-label": t.preview.curve
    ? `data and model at ${t.preview.curve.at} ${degrees(t.preview.curve.at_deg)}` : "no sample in the plane of incidence" });
  return draw_when_seen(el("article", { class: "card" },
    el("h3", {}, link(t)),
    el("div", { class: "pictures" }, sphere, curve),
    el("dl", {}, shown_names.filter((n) => t.parameters[n]).map((n) => [el("dt", {}, n), el("dd", {}, values_text(t.parameters[n]))]),
      el("dt", {}, "log RMS"), el("dd", {}, log_rms_text(t.log_rms)),
      el("dt", {}, "misfit"), el("dd", {}, misfit_text(t))),
    flag_list(t)),
  () => { draw_sphere(sphere, t, 76); draw_curve(curve, t, Math.max(60, curve.parentNode.clientWidth - 86), 76); });
}
function rows_table(list, state, sort_by) {
  const sorted = (name) => (state.sort === name ? (state.up ? "ascending" : "descending") : "none");
  const head = (name, text, number = true) => el("th", { class: number ? "n" : null, scope: "col", "aria-sort": sorted(name) },
    el("button", { type: "button", onclick: () => sort_by(name) }, text, state.sort === name ? (state.up ? " ↑" : " ↓") : ""));
  const columns = ["log_rms", "misfit", "albedo", "values_used", "masked"];
  return scroll(el("table", { class: "rows" },
    el("thead", {}, el("tr", {}, el("th", {}), head("name", "table", false), names.map((n) => head(n, n)),
      columns.map((n) => head(n, label_of(quantity(n)))), head("flags", "flags", false))),
    el("tbody", {}, list.map((t) => el("tr", {},
      el("td", {}, t.preview ? el("span", { class: "swatch", style: { background: color_of(t) } }) : null), el("th", { scope: "row" }, link(t)),
      t.parameters ? [names.map((n) => el("td", { class: "n" }, t.parameters[n] ? values_text(t.parameters[n]) : "–")),
        el("td", { class: "n" }, log_rms_text(t.log_rms)), el("td", { class: t.misfit_told ? "n told" : "n" }, misfit_text(t)), el("td", { class: "n" }, significant(mean(t.preview.albedo))),
        el("td", { class: "n" }, count(t.values_used)), el("td", { class: "n" }, count(t.masked)), el("td", {}, flag_list(t))]
        : el("td", { colspan: names.length + columns.length + 1 }, el("span", { class: "flags" }, el("span", {}, words(t.status))), " ", t.message))))));
}

let show_only = () => {};
function each() {
  const state = { words: "", kind: "all", sort: "place", up: true, view: "cards" };
  const body = el("div"), shown = el("span", { class: "muted" });
  const kinds = { all: () => true, flagged: (t) => t.parameters && t.flags.length, clean: (t) => t.parameters && !t.flags.length, failed: (t) => !t.parameters };
  const key = (t) => (state.sort === "place" ? t.place : state.sort === "name" ? t.name : state.sort === "flags" ? t.flags.length : quantity(state.sort).of(t));
  function ordered() {
    const wanted = state.words.toLowerCase().split(/\s+/).filter(Boolean);
    const list = tables.filter((t) => kinds[state.kind](t) && wanted.every((w) =>
      `${t.path} ${t.status} ${t.flags.map((f) => f[0]).join(" ")}`.toLowerCase().includes(w)));
    return list.map((t) => [key(t), t]).sort(([a, s], [b, t]) => {
      if (a === null || b === null) return (a === null) - (b === null) || s.place - t.place;  // unknown ones last
      const order = a < b ? -1 : a > b ? 1 : 0;
      return (state.up ? order : -order) || s.place - t.place;
    }).map(([, t]) => t);
  }
  function update() {
    for (const node of [...waiting.keys()]) seen.unobserve(node);
    waiting.clear();
    drawn.clear();
    const list = ordered();
    shown.textContent = list.length === tables.length ? many(list.length, "table") : `${count(list.length)} of ${many(tables.length, "table")}`;
    body.replaceChildren(state.view === "cards" ? el("div", { class: "cards" }, list.map(card)) : rows_table(list, state, sort_by));
    sort_select.value = state.sort;
    direction.textContent = state.up ? "↑ rising" : "↓ falling";
  }
  function sort_by(name) {
    state.up = state.sort === name ? !state.up : name === "name" || name === "place";
    state.sort = name;
    update();
  }
  const sort_select = el("select", { onchange: (e) => { state.sort = e.target.value; update(); } },
    [["place", "as given"], ["name", "name"], ["flags", "flags"], ...quantities.map((q) => [q.name, label_of(q)])]
      .map(([value, text]) => el("option", { value }, text)));
  const direction = el("button", { type: "button", class: "plain", onclick: () => { state.up = !state.up; update(); } });
  const search = el("input", { type: "search", placeholder: "part of a name", "aria-label": "Filter by name or flag",
    oninput: (e) => { state.words = e.target.value; update(); } });
  show_only = (t) => { state.words = search.value = t.name; state.kind = "all"; update(); out.scrollIntoView({ behavior: "smooth" }); };
  const kind = choice("Which tables", [["all", "all"], ["flagged", "flagged"], ["clean", "without flags"], ...(failed.length ? [["failed", "failed"]] : [])],
    state.kind, (v) => { state.kind = v; update(); });
  const view = choice("View", [["cards", "cards"], ["rows", "rows"]], state.view, (v) => { state.view = v; update(); });
  const out = section("Each material",
    "The sphere shows the fitted model, lit from the upper left under a uniform sky. Beside it f_r in the plane of incidence, logarithmic with a line per decade, "
      + "at the angle nearest to 30°: points are the table's samples, lines the model, the dashed line the mirror direction. A name links to its " + (tables.some((t) => t.page) ? "page." : "document."),
    el("div", { class: "controls" }, search, kind, el("label", {}, "by ", sort_select), direction, view, shown), body);
  update();
  return out;
}

const models = [...new Set(fitted.map((t) => t.model))];
document.getElementById("page").replaceChildren(
  el("p", { class: "over" }, "gonio fit, many tables"),
  el("h1", {}, `${models[0] ?? "No model"} fitted to ${many(tables.length, "table")}`),
  verdict(), ...[facts(), failures(), still_missing(), fitted.length ? overview() : null, each()].filter(Boolean),
  el("footer", {}, "Made with ", el("code", {}, page.made_with), ". f_r is in 1/sr, without the cosine. alpha is the width of the distribution, roughness = √alpha. ",
    "Every figure of this page is in its data block and, as a table, in summary.csv."));
