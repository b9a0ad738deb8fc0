"use strict";
// Makes the drawn pictures of a page interactive: values under the pointer, zoom, hidden curves, choices.

const all = (of, what) => [...of.querySelectorAll(what)];
const clamp = (x, low, high) => Math.min(high, Math.max(low, x));
/// Ends of an axis as they stand in data-x, data-y: "0.1 10 log", "0 90 root".
const scale_of = (text) => { const [low, high, kind] = text.split(" "); return { low: +low, high: +high, log: kind === "log", root: kind === "root" }; };
const value_at = ({ low, high, log, root }, part) => (log ? low * (high / low) ** part : root ? (low ** 0.5 + (high ** 0.5 - low ** 0.5) * part) ** 2 : low + (high - low) * part);
const part_at = ({ low, high, log }, v) => (log ? Math.log(v / low) / Math.log(high / low) : (v - low) / (high - low));

// --- Numbers -------------------------------------------------------------------------------------
const superscript = (n) => [...String(n)].map((c) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[c] ?? "⁻").join("");
function tick_text(x) {
  if (x === 0) return "0";
  const power = Math.floor(Math.log10(Math.abs(x)) + 1e-9), lead = Number((x / 10 ** power).toPrecision(4));
  return (power >= -3 && power <= 5 ? String(Number(x.toPrecision(6))) : (lead === 1 ? "" : `${lead}·`) + "10" + superscript(power)).replace("-", "−");
}
/// A value to the digits that a tenth of a pixel tells apart.
function read_text(scale, part, step) {
  const v = value_at(scale, part), near = Math.abs(value_at(scale, part + step) - v);
  if (Math.abs(v) < near) return "0";
  return tick_text(Number(v.toPrecision(clamp(1 + Math.floor(Math.log10(Math.abs(v))) - Math.floor(Math.log10(near)), 1, 6))));
}
/// Round numbers between two values, as reports/picture/figure_scale.cpp has them.
function ticks_between(low, high, log, most) {
  const span = Math.log10(high / low), out = [];
  if (log && span > 0.9) {
    const step = Math.max(1, Math.ceil(span / most));
    for (let e = Math.floor(Math.log10(low)); e <= Math.log10(high); ++e)
      for (const d of span > 3 ? [1] : [1, 2, 5]) { const x = Number(`${d}e${e}`); if (e % step === 0 && x >= low && x <= high) out.push(x); }
    if (out.length > 1) return out;
  }
  const rough = (high - low) / most, decade = 10 ** Math.floor(Math.log10(rough)), step = decade * [1, 2, 5, 10].find((d) => d * decade >= rough * (1 - 1e-9));
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) out.push(Number((k * step).toPrecision(12)));
  return out.length > 1 || most > 30 ? out : ticks_between(low, high, log, 2 * most);
}

// --- A picture ------------------------------------------------------------------------------------
/// Runs of points of a path, in its drawing's pixels.
function runs_of(path) {
  return path.runs ??= path.getAttribute("d").split("M").slice(1).map((run) => {
    const numbers = run.replace("h0", "").match(/-?(\d+\.?\d*|\.\d+)/g).map(Number), out = [];
    for (let i = 0, x = 0, y = 0; i < numbers.length; i += 2) out.push([x += numbers[i], y += numbers[i + 1]]);
    return out;
  });
}
/// Returns the parts of a picture, which are looked up once.
const drawing_of = (plot) => plot.drawing ??= (() => {
  const inside = plot.firstElementChild, { width, height } = inside.viewBox.baseVal, figure = plot.closest("figure");
  return { inside, width, height, figure, x: scale_of(plot.dataset.x), y: scale_of(plot.dataset.y), x_name: figure.querySelector(".xl").textContent,
    curves: all(inside, "g[class]:not(.cells)"), keys: all(figure, ".keys button:not(.all)"), at_first: [".xt", ".yt"].map((g) => plot.querySelector(g).innerHTML), readout: figure.querySelector(".readout") };
})();
const is_shown = (d, k) => !d.keys[k].classList.contains("off") && (!d.curves[k].classList.contains("more") || d.figure.classList.contains("everything"));
const dots_of = (curve) => all(curve, ".dot").flatMap(runs_of).map(([at]) => at);
const line_of = (curve) => curve.querySelector("path:not([class])");
/// The dot of a curve that is nearest to a place across, where it is near.
const dot_at = (curve, x, reach) => dots_of(curve).reduce((a, b) => (Math.abs(b[0] - x) < Math.abs((a?.[0] ?? Infinity) - x) && Math.abs(b[0] - x) < reach ? b : a), null);

/// The part of the drawing between two places across; up and down as the curves that are shown ask for.
function show_part(plot, from, to) {
  const d = drawing_of(plot), whole = from <= 0 && to >= d.width, [xt, yt] = [".xt", ".yt"].map((g) => plot.querySelector(g));
  let top = 0, bottom = d.height;
  if (!whole || d.figure.matches(".everything, :has(.off)")) {
    const paths = d.curves.flatMap((c, k) => (is_shown(d, k) ? all(c, "path") : [])), ends = paths.filter((p) => !p.classList.length).flatMap((p) => [from, to].map((x) => height_at(runs_of(p), x)));
    const ys = [...paths.flatMap(runs_of).flat().filter(([x]) => x >= from && x <= to).map(([, y]) => y), ...ends.filter((y) => y !== null)];
    if (ys.length) [top, bottom] = [Math.min(...ys), Math.max(...ys)];
    const room = 0.06 * (bottom - top) || 10;
    [top, bottom] = [top - room, !d.y.log && d.y.low === 0 ? Math.min(bottom + room, d.height) : bottom + room];
  }
  [d.from, d.to, d.top, d.bottom] = [from, to, top, bottom];
  d.inside.setAttribute("viewBox", `${from} ${top} ${to - from} ${bottom - top}`);
  const texts = (scale, ends, most, place) => ticks_between(...ends, scale.log, most).map((v) => [place(part_at(scale, v)), tick_text(v)]);
  const xs = texts(d.x, [from, to].map((x) => value_at(d.x, x / d.width)), plot.clientWidth > 520 ? 8 : 4, (part) => part * d.width);
  const ys = texts(d.y, [bottom, top].map((y) => value_at(d.y, 1 - y / d.height)), 7, (part) => (1 - part) * d.height);
  xt.innerHTML = xs.map(([x, text]) => `<text x="${100 * (x - from) / (to - from)}%" y="${d.height + 17}">${text}</text>`).join("");
  yt.innerHTML = ys.map(([y, text]) => `<text x="-7" y="${(y - top) / (bottom - top) * d.height + 4}">${text}</text>`).join("");
  d.inside.querySelector(".g").setAttribute("d", xs.map(([x]) => `M${x} ${top}V${bottom}`).join("") + ys.map(([y]) => `M${from} ${y}H${to}`).join(""));
  d.inside.querySelector(".ax").setAttribute("d", `M${from} ${top}V${bottom}H${to}`);
  for (const g of plot.querySelectorAll(".labels")) g.setAttribute("visibility", whole && top === 0 ? "visible" : "hidden");
}
const show_whole = (plot) => show_part(plot, 0, drawing_of(plot).width);
/// A place of the drawing under a pointer.
function place_of(plot, event) {
  const d = drawing_of(plot), box = plot.getBoundingClientRect(), { x, y, width, height } = d.inside.viewBox.baseVal;
  return [x + (event.clientX - box.left) / box.width * width, y + (event.clientY - box.top) / box.height * height];
}
/// Height of a line at a place across, or nothing.
function height_at(runs, x) {
  const run = runs.find((r) => r[0][0] <= x && r.at(-1)[0] >= x);
  if (!run) return null;
  const i = Math.max(1, run.findIndex(([at]) => at >= x)), [a, b] = [run[i - 1], run[i] ?? run[i - 1]];
  return b[0] === a[0] ? b[1] : a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0]);
}
function mark(d, marks) {
  d.inside.querySelector(".here")?.remove();
  if (marks) d.inside.insertAdjacentHTML("beforeend", `<g class="here">${marks}</g>`);
}
/// Tells what is at a place.
function read(plot, [x, y]) {
  const d = drawing_of(plot);
  plot.at = [x, y];
  if (plot.dataset.cells) return read_cell(plot, d, x, y);
  const y_text = (at) => `<b>${read_text(d.y, 1 - at / d.height, 0.1 / d.height)}</b>`, x_text = (at) => `<b>${read_text(d.x, at / d.width, 0.1 / d.width)}</b>`;
  const shown = d.curves.map((c, k) => [c, d.keys[k].innerHTML]).filter(([, ], k) => is_shown(d, k));
  const dots = shown.flatMap(([c, name]) => dots_of(c).map((at, i) => ({ at, name, label: c.dataset.labels?.split("|")[i] })));
  const lines = shown.filter(([c]) => line_of(c)), near = (p) => Math.hypot(p.at[0] - x, p.at[1] - y);
  if (dots.length && lines.every(([c]) => /^r/.test(c.getAttribute("class")))) {  // each point speaks for itself
    const p = dots.reduce((a, b) => (near(b) < near(a) ? b : a));
    if (near(p) > 40) return stop_reading(plot);
    mark(d, `<path class="dot" d="M${p.at} h0"/>`);
    d.readout.innerHTML = `${p.name}${p.label ? `, ${p.label}` : ""}: ${d.x_name} ${x_text(p.at[0])}, ${y_text(p.at[1])}`;
    return;
  }
  if (dots.length) { const p = dots.reduce((a, b) => (Math.abs(b.at[0] - x) < Math.abs(a.at[0] - x) ? b : a)); if (Math.abs(p.at[0] - x) < 12) [x] = p.at; }
  const told = shown.map(([c, name]) => [name, line_of(c) ? height_at(runs_of(line_of(c)), x) : dot_at(c, x, 3)?.[1] ?? null]).filter(([, at]) => at !== null);
  if (!told.length) return stop_reading(plot);
  mark(d, `<path d="M${x} ${d.top ?? 0}V${d.bottom ?? d.height}"/>` + told.map(([, at]) => `<path class="dot" d="M${x} ${at}h0"/>`).join(""));
  d.readout.innerHTML = `${d.x_name} ${x_text(x)}: ` + told.map(([name, at]) => `${name} ${y_text(at)}`).join(", ");
}
/// Edges of a map's cells, and what is in them: places on the scale of colours, 65535 where nothing is.
const map_of = (plot) => plot.map ??= (({ xs, ys, nx, ny, cells, scale }) => {
  const bytes = Uint8Array.from(atob(cells), (c) => c.charCodeAt(0));
  return { x: xs.split(" ").map(Number), y: ys.split(" ").map(Number), nx: nx?.split("|"), ny: ny?.split("|"), scale: scale.split(" "), cells: Array.from({ length: bytes.length / 2 }, (_, k) => bytes[2 * k] + 256 * bytes[2 * k + 1]) };
})(plot.dataset);
/// Fills in the cells of a map that was not shown until now.
function fill_cells(plot) {
  const into = plot.querySelector(".cells:empty"), m = into && map_of(plot), shades = 64, paths = {};
  m?.cells.forEach((q, k) => {
    const i = Math.floor(k / (m.y.length - 1)), j = k % (m.y.length - 1), shade = Math.round(shades * q / 65534);
    if (q !== 65535) paths[shade] = `${paths[shade] ?? ""}M${m.x[i]} ${m.y[j]}H${m.x[i + 1]}V${m.y[j + 1]}H${m.x[i]}z`;
  });
  if (into) into.innerHTML = Object.entries(paths).map(([shade, d]) => `<path class="${m.scale[3] ? "d" : "q"}${shade}" d="${d}"/>`).join("");
  into?.setAttribute("shape-rendering", "crispEdges");
}
function read_cell(plot, d, x, y) {
  const m = map_of(plot);
  const i = clamp(m.x.findLastIndex((e) => e <= x), 0, m.x.length - 2), j = clamp(m.y.findLastIndex((e) => e >= y), 0, m.y.length - 2);
  const q = m.cells[i * (m.y.length - 1) + j], [kind, low, high, diverging] = m.scale, part = diverging && kind !== "log" ? q / 32767 - 1 : q / 65534;
  const value = kind === "log" ? low * (high / low) ** part : high * (kind === "root" ? Math.sign(part) * part * part : part);
  const range = (axis, length, names, k, edges) => names ? names[k] : [edges[k], edges[k + 1]].map((e) => read_text(axis, length === d.height ? 1 - e / length : e / length, 0.5 / length)).join("–");
  mark(d, `<path d="M${m.x[i]} ${m.y[j]}H${m.x[i + 1]}V${m.y[j + 1]}H${m.x[i]}z"/>`);
  d.readout.innerHTML = `${d.x_name} ${range(d.x, d.width, m.nx, i, m.x)}, ${plot.querySelector("text[transform^='translate']")?.textContent ?? ""} ${range(d.y, d.height, m.ny, j, m.y)}: `
    + (q === 65535 ? "no value" : `<b>${q === 65534 ? "≥ " : kind === "log" && q === 0 ? "≤ " : ""}${tick_text(Number(value.toPrecision(kind === "log" && Math.abs(value - 1) < 0.1 ? 5 : 3)))}</b>`);
}
function stop_reading(plot) {
  const d = drawing_of(plot);
  mark(d);
  d.readout.replaceChildren();
}

const on = (what, use) => document.addEventListener(what, (e) => { const plot = e.target.closest?.(".plot"); if (plot) use(plot, e); });
let cut = null;  // {plot, from} while a part is cut out
on("pointermove", (plot, e) => {
  if (cut?.plot !== plot) return read(plot, place_of(plot, e));
  const [x] = place_of(plot, e), d = drawing_of(plot);
  mark(d, `<path class="cut" d="M${cut.from} ${d.top ?? 0}H${x}V${d.bottom ?? d.height}H${cut.from}z"/>`);
});
on("pointerout", (plot, e) => { if (!plot.contains(e.relatedTarget)) stop_reading(plot); });
on("pointerdown", (plot, e) => { if (e.pointerType === "mouse" && !plot.dataset.cells) { cut = { plot, from: place_of(plot, e)[0] }; e.preventDefault(); } });
addEventListener("pointerup", (e) => {
  if (!cut) return;
  const { plot, from } = cut, to = place_of(plot, e)[0], d = drawing_of(plot), now = d.inside.viewBox.baseVal;
  cut = null;
  mark(d);
  if (Math.abs(to - from) > 0.01 * now.width) show_part(plot, Math.max(now.x, Math.min(from, to)), Math.min(now.x + now.width, Math.max(from, to)));
});
on("dblclick", show_whole);
on("keydown", (plot, e) => {
  const [right, down] = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[e.key] ?? [0, 0], d = drawing_of(plot);
  if (!right && !down) return;
  e.preventDefault();
  const step = plot.map ? [d.width / (plot.map.x.length - 1), d.height / (plot.map.y.length - 1)] : [d.width / 100, d.height / 50], [x, y] = plot.at ?? [0, d.height / 2];
  read(plot, [clamp(x + right * step[0], 0, d.width), clamp(y + down * step[1], 0, d.height)]);
});
document.addEventListener("click", (e) => {
  const key = e.target.closest(".keys button");
  if (!key) return;
  const text = key.textContent, off = !key.classList.contains("off"), whole = key.classList.contains("all"), everything = !key.closest("figure").classList.contains("everything");
  for (const figure of key.closest(".alike") ? all(key.closest(".alike"), "figure:has(.keys)") : [key.closest("figure")]) {
    const plot = figure.querySelector(".plot"), d = drawing_of(plot);
    if (whole) figure.classList.toggle("everything", everything);
    else d.keys.filter((k) => k.textContent === text).forEach((k) => k.classList.toggle("off", off));
    d.curves.forEach((c, k) => c.classList.toggle("off", d.keys[k].classList.contains("off")));
    show_whole(plot);
  }
});
// A key that is pointed at puts its curve before the others.
for (const [what, is] of [["pointerover", true], ["pointerout", false]])
  document.addEventListener(what, (e) => {
    const key = e.target.closest?.(".keys button:not(.all)"), figure = key?.closest("figure");
    if (figure) emphasise(figure, is ? all(figure, ".keys button:not(.all)").indexOf(key) : figure.kept ?? -1);
  });
function emphasise(figure, k) {
  figure.classList.toggle("one", k >= 0);
  drawing_of(figure.querySelector(".plot")).curves.forEach((c, i) => c.classList.toggle("before", i === k));
}

// --- Choices --------------------------------------------------------------------------------------
const fits = (of, now) => of.every((v, k) => v === "" || v === now[k]);
/// Contents of a slot that are not shown, by what they are of.
const others_of = (slot) => all(slot, ":scope > template");
const of = (node) => (node.dataset.of ?? "").split("|");
function choose(form, changed) {
  const names = [...new Set([...form.elements].map((c) => c.name).filter(Boolean))], values = () => names.map((n) => form.elements[n].value);
  const slots = all(form.parentElement, ".slot").filter((s) => s.closest(".choice") === form.parentElement), there = [...slots[0]?.children ?? []].map(of);
  if (!there.length) return;
  let now = values();
  if (changed !== undefined) {  // the rest as near to what it was as there is
    const k = names.indexOf(changed), same = (a) => a.reduce((n, v, i) => n + (v === "" || v === now[i] ? 2 ** (a.length - i) : 0), 0);
    const best = there.filter((a) => a[k] === "" || a[k] === now[k]).reduce((a, b) => (a && same(a) >= same(b) ? a : b), null) ?? now;
    now = now.map((v, i) => best[i] || v);
    names.forEach((n, i) => { form.elements[n].value = now[i]; });
  }
  [...form.elements].forEach((c) => [...(c.options ?? [c])].forEach((o) => {  // what the controls before it leave
    const k = names.indexOf(c.name), is = there.some((a) => a.slice(0, k).every((v, i) => v === "" || v === now[i]) && (a[k] === "" || a[k] === o.value));
    (o.closest("option, label") ?? o).hidden = !is;
  }));
  if (changed === undefined) return;
  for (const slot of slots) {
    const shown = slot.firstElementChild, next = fits(of(shown), now) && shown.dataset.of !== undefined ? null : others_of(slot).find((t) => fits(of(t), now));
    if (fits(of(shown), now) && shown.dataset.of !== undefined) continue;
    if (shown.dataset.of !== undefined) {
      const kept = document.createElement("template");
      kept.dataset.of = shown.dataset.of;
      kept.innerHTML = shown.innerHTML;
      slot.append(kept);
    }
    shown.replaceChildren(...(next ? [next.content.cloneNode(true)] : []));
    if (next) { shown.dataset.of = next.dataset.of; next.remove(); } else delete shown.dataset.of;
    all(shown, ".plot[data-cells]").forEach(fill_cells);
  }
  emphasise_chosen(form, now);
}
/// Puts the curve of the chosen name before the others, where a choice is of that.
function emphasise_chosen(form, now) {
  const k = form.parentElement.dataset.emphasis;
  if (k === undefined) return;
  for (const figure of all(form.parentElement, "figure:has(.keys)")) {
    figure.kept = all(figure, ".keys button:not(.all)").findIndex((b) => (b.value || b.textContent) === now[k]);
    emphasise(figure, figure.kept);
  }
}
document.addEventListener("change", (e) => { const form = e.target.closest("form.controls"); if (form) choose(form, e.target.name); });
for (const form of all(document, "form.controls")) {
  choose(form);
  emphasise_chosen(form, [...new FormData(form).values()]);
  form.addEventListener("submit", (e) => e.preventDefault());
}

// --- Things to look through -------------------------------------------------------------------------
function browse(box) {
  const form = box.querySelector("form"), { words, kind, key, falling, view } = form.elements, [cards, rows] = [".cards", ".rows"].map((c) => box.querySelector(c));
  const list = [...cards.children].map((card, i) => ({ card, row: all(rows, "tbody > tr")[i], keys: card.dataset.keys.split("|"), words: card.dataset.words.toLowerCase(), i }));
  const update = () => {
    const k = key.selectedIndex - 1, sign = falling.checked ? -1 : 1, wanted = words.value.toLowerCase().split(/\s+/), value = ({ keys: { [k]: v } }) => (isNaN(v) ? v.toLowerCase() : +v);
    const before = (a, b) => (k < 0 ? sign * (a.i - b.i) : (a.keys[k] === "") - (b.keys[k] === "") || sign * ((value(a) > value(b)) - (value(a) < value(b))) || a.i - b.i);
    let shown = 0;
    for (const one of [...list].sort(before)) {
      const is = (kind.value === "" || kind.value === one.card.dataset.kind) && wanted.every((w) => one.words.includes(w));
      shown += is;
      for (const node of [one.card, one.row]) { node.hidden = !is; node.parentElement.append(node); }
    }
    [cards.hidden, rows.hidden] = [view.value === "rows", view.value === "cards"];
    form.querySelector(".shown").textContent = `${shown} of ${list.length}`;
  };
  form.addEventListener("input", update);
  rows.querySelector("thead").addEventListener("click", (e) => {
    const at = [...key.options].findIndex((o) => o.text === (e.target.cellIndex === 0 ? "name" : e.target.textContent));
    falling.checked = key.selectedIndex === at && !falling.checked;
    if (at > 0) key.selectedIndex = at;
    update();
  });
  update();
}
all(document, ".browse").forEach(browse);

// --- Paper ----------------------------------------------------------------------------------------
addEventListener("beforeprint", () => {
  for (const fold of all(document, "details")) fold.open = true;
  for (const slot of all(document, ".slot[data-paper]")) {
    const shown = of(slot.firstElementChild), first = shown.findIndex((v) => v !== ""), told = new Set([shown[first]]);
    const near = (t) => of(t).filter((v, i) => v === shown[i]).length, list = others_of(slot).sort((a, b) => near(b) - near(a)).filter((t) => !told.has(of(t)[first]) && told.add(of(t)[first]));
    const paper = document.createElement("div");
    paper.className = !list[0]?.content.querySelector("figure") ? "paper" : list.length > 1 ? "paper panels small-ones" : "paper panels";
    for (const t of list) {
      const part = t.content.cloneNode(true);
      if (!part.querySelector("figure")) paper.insertAdjacentHTML("beforeend", "<h3></h3>"), paper.lastElementChild.textContent = of(t)[first];
      paper.append(part);
    }
    slot.closest(".choice").append(paper);  // below the others, as wide as the page
    all(paper, ".plot[data-cells]").forEach(fill_cells);
  }
});
addEventListener("afterprint", () => all(document, ".paper").forEach((p) => p.remove()));
