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
      if (there && c.errors?.[i] > 0) svg.append(mark("path", { class: "error", d: `M${px(c.x[i]).toFixed(1)} ${py(c.y[i] - c.errors[i]).toFixed(1)}V${py(c.y[i] + c.errors[i]).toFixed(1)}`, style: `stroke: var(--c${c.colour})` }));
      if (there && c.points) svg.append(mark("circle", { cx: px(c.x[i]).toFixed(1), cy: py(c.y[i]).toFixed(1), r: c.doubtful?.[i] ? 3.2 : 2.2, class: c.doubtful?.[i] ? "hollow" : false, style: `${c.doubtful?.[i] ? "stroke" : "fill"}: var(--c${c.colour})` }));
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
/// Channels to choose among are called as those of what is chosen, or of an entry that has more.
const channels_to_show = () => channels_of([items[active], ...items].reduce((a, b) => (b.channels.length > a.channels.length ? b : a)));
const channel_shown = () => channels_to_show()[Math.min(view.channel, channels_to_show().length - 1)];
/// The channel of an entry that is drawn: the one that is called as what is chosen, or else the one of its number.
const channel_of = (item) => (channels_of(item).includes(channel_shown()) ? channels_of(item).indexOf(channel_shown()) : Math.min(view.channel, item.channels.length - 1));
/// An entry's name, with its channel where that is another than the one that is chosen.
const drawn_name = (item) => (is_model(item) && !item.fit || channels_of(item).includes(channel_shown()) ? label(item) : `${label(item)}, channel ${channels_of(item)[channel_of(item)]}`);
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
    cuts.curves.push({ name: drawn_name(item), colour: i, x: angles, y: channels[channel_of(item)], channels });
    const own = (item.cuts ?? []).find((c) => Math.abs(c.theta_i - view.theta) <= 0.75);
    if (own) cuts.curves.push({ name: `${drawn_name(item)}, its own values at ${degrees(own.theta_i)}`, colour: i, x: own.theta_o, y: own.f[channel_of(item)], points: true });
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
/// True of a table's albedo that may be off by more than a tenth, or of whose hemisphere a tenth has no samples.
const is_doubtful = ({ value, error = 0, coverage = 1 }) => coverage < 0.9 || error > 0.1 * Math.max(...value.map((v) => v ?? 0));
const albedo_angles = Float64Array.from({ length: 18 }, (_, i) => 5 * i);
function evaluate_albedo() {
  const n = albedo_angles.length;
  albedos = { angles: albedo_angles, curves: [] };
  for (const [item, i] of drawn()) {
    if (!is_model(item)) {
      if (item.albedo.length) albedos.curves.push({ name: drawn_name(item), colour: i, x: item.albedo.map((a) => a.theta_i), y: item.albedo.map((a) => a.value[channel_of(item)] ?? NaN), errors: item.albedo.map((a) => a.error ?? 0), doubtful: item.albedo.map(is_doubtful), points: true });
      continue;
    }
    for (const dashed of items[active] === item ? [false, true] : [false]) {
      numbers(room.x, n).set(albedo_angles);
      const e = split(checked(g.albedo(item.handle, n, room.x, dashed, room.f)), n);
      albedos.curves.push({ name: dashed ? `${drawn_name(item)}, first lobe with F = 1` : drawn_name(item), colour: i, x: albedo_angles, y: e[channel_of(item)], channels: e, dashed, item });
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
  for (const picture of $("spheres").querySelectorAll("canvas")) {
    picture.onpointerdown = picture.onpointermove = (e) => {
      if (e.type === "pointerdown") picture.setPointerCapture(e.pointerId);
      if (!e.buttons) return;
      const box = picture.getBoundingClientRect();
      light_from((2 * (e.clientX - box.left) / box.width - 1) / 0.96, -(2 * (e.clientY - box.top) / box.height - 1) / 0.96);
    };
    picture.onpointerup = finish;
    by_arrows(picture, "move the light", (x, y) => { light_from(view.light[0] + 0.1 * x, view.light[1] + 0.1 * y), finish(); });
  }
  for (const [item, i] of drawn()) {
    const picture = $(`slice-${i}`), within = (k) => clamp(Math.floor(k), 0, sliceSize - 1);
    picture.onpointermove = (e) => { const box = picture.getBoundingClientRect(); read_slice(item, i, within((e.clientX - box.left) / box.width * sliceSize), within((e.clientY - box.top) / box.height * sliceSize)); };
    by_arrows(picture, "move the reading", (x, y) => { const at = Number($("slices").querySelector(".readout").dataset.at ?? (sliceSize + 1) * (sliceSize >> 1)); read_slice(item, i, within(at % sliceSize + x), within(Math.floor(at / sliceSize) - y)); });
  }
}
/// A picture that arrow keys do to what a pointer does.
function by_arrows(picture, what, move) {
  picture.tabIndex = 0, picture.setAttribute("aria-label", `${picture.getAttribute("aria-label")}: arrow keys ${what}`);
  picture.onkeydown = (e) => {
    const by = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[e.key];
    if (by) e.preventDefault(), move(...by);
  };
}
/// Puts the light where it shines on a place of the sphere, x to the right and y upwards.
function light_from(x, y) {
  const r = Math.hypot(x, y), k = Math.min(1, 0.999 / r);
  view.light = [x * k, y * k, Math.sqrt(Math.max(1 - (r * k) ** 2, 0))];
  view.lamp = "", dirty.light = true, show_view(), redraw();
}
function read_slice(item, i, x, y) {
  const f = slices.get(item);
  if (f) read_out($("slices"), y * sliceSize + x, `θh ${degrees((x + 0.5) / sliceSize * 90)}, θd ${degrees((sliceSize - y - 0.5) / sliceSize * 90)}`, f.map((channel, c) => [`${label(item)} ${f.length > 1 ? channels_of(item)[c] : ""}`, i, channel[y * sliceSize + x], " 1/sr"]));
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
/// Says which samples the comparison counts that the fit left out.
function beside_fit(model, table) {
  const { file, left_out, copies } = model.fit ?? {}, words = [left_out && `by ${left_out}`, copies && "as copies"].filter(Boolean);
  return file === table.name && words.length ? `, with those that the fit leaves out ${words.join(" or ")}` : "";
}
/// What is on screen in words.
function show_facts() {
  const model = items[active], lines = [];
  if (is_model(model)) {
    lines.push(`${label(model)} takes ${model.about.operations} operations a sample, in ${model.channels.length}${channels_in_file(model) > model.channels.length ? ` of ${channels_in_file(model)}` : ""} ${channels_in_file(model) === 1 ? "channel" : "channels"}.`);
    const of = (dashed) => albedos.curves.find((c) => c.item === model && Boolean(c.dashed) === dashed), all = of(false), white = of(true);
    if (all && white) {
      const at = nearest(albedo_angles, view.theta);
      lines.push(`${label(model)} at θi ${degrees(albedo_angles[at])}: albedo ${all.channels.map((e) => shown(Number(e[at].toPrecision(3)))).join(", ")}; ${model.about.parts.some((p) => p.length === 3) ? `its first lobe with F = 1 reflects ${shown(Number(white.channels[0][at].toPrecision(3)))}${white.channels[0][at] <= 1 ? ", the rest is lost between facets" : ": more than arrives"}` : "it has no lobe"}.`);
    }
    for (const table of items) if (comparable(table)) {
      checked(g.difference(model.handle, table.samples, room.f, room.rgba)), put(`ratio-${items.indexOf(table)}`, mapSize);
      const [n, typical, worst, h, d] = numbers(room.f, 5);
      lines.push(n ? `${label(model)} beside ${label(table)}: typical factor ×/÷ ${typical.toFixed(3)} over ${n} of its values${beside_fit(model, table)}; worst on the page's grid at θh ${degrees(h)}, θd ${degrees(d)}, where the model is ${worst > 1 ? `${shown(Number(worst.toPrecision(3)))} times too bright` : `${shown(Number((1 / worst).toPrecision(3)))} times too dark`}.${sphere_words(model, table)}` : `${label(model)} and ${label(table)} have no value in common.`);
    }
  }
  $("facts").replaceChildren(...lines.map((line) => make("p", {}, line)));
}
