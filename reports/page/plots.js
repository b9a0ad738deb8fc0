"use strict";
// Plots: curves by uPlot, a heat map on a canvas, an interval as a line.

const plot_font = "12px system-ui, -apple-system, 'Segoe UI', Roboto, 'DejaVu Sans', sans-serif";

/// Ticks of a logarithmic axis: decades; 1, 2, 5 where few decades are seen; every digit in one.
function log_ticks(low, high) {
  const span = Math.log10(high / low);
  const digits = span > 3 ? [1] : span > 0.9 ? [1, 2, 5] : [1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8];
  const step = Math.max(1, Math.ceil(span / 6));
  const ticks = [];
  for (let e = Math.floor(Math.log10(low)); e <= Math.ceil(Math.log10(high)); ++e)
    if (e % step === 0)
      for (const d of digits) {
        const x = Number(`${d}e${e}`);
        if (x >= low && x <= high) ticks.push(x);
      }
  return ticks.length > 2 ? ticks : even_splits(low, high);  // hardly a range
}
/// Some five ticks at round numbers.
function even_splits(low, high) {
  const rough = (high - low) / 6, decade = 10 ** Math.floor(Math.log10(rough));
  const step = decade * [1, 2, 5, 10].find((digit) => digit * decade >= rough * (1 - 1e-9));
  return Array.from({ length: 8 }, (_, i) => (Math.ceil(low / step - 1e-9) + i) * step).filter((x) => x <= high + 1e-9 * step);
}
function tick_text(x) {
  if (x === null) return "";
  if (x === 0) return "0";
  const power = Math.floor(Math.log10(Math.abs(x)) + 1e-9);
  if (power >= -3 && power <= 3) return minus(String(Number(x.toPrecision(6))));
  const lead = Number((x / 10 ** power).toPrecision(3));
  return (lead === 1 ? "" : minus(String(lead)) + "·") + "10" + superscript(power);
}

/// Texts of ticks, of which those are left out that would touch others: of a logarithmic axis first all but decades, else every second …
/// \param places  of their middles, in pixels   \param room  that each takes
function uncrowded(texts, places, room) {
  const free = (keep) => {
    let end = -Infinity;
    return texts.every((text, i) => {
      if (!keep(i) || !text) return true;
      const begin = places[i] - room(text) / 2, is_free = begin >= end;
      end = begin + room(text);
      return is_free;
    });
  };
  const decade = (i) => /^(0\.0*1|10*|10[⁻⁰¹²³⁴-⁹]+)$/.test(texts[i]);
  const rules = [() => true, ...(texts.filter((_, i) => decade(i)).length > 2 ? [decade] : []), ...[2, 3, 4, 6, 8].map((n) => (i) => i % n === 0), (i) => i === 0];
  const rule = rules.find(free) ?? (() => true);
  return texts.map((text, i) => (rule(i) ? text : ""));
}

/// Boxes that cover a straight line.
function covered(from, to) {
  const steps = Math.ceil(Math.hypot(to.x - from.x, to.y - from.y) / 4) || 1;
  return Array.from({ length: steps + 1 }, (_, i) => {
    const part = i / steps, x = from.x + part * (to.x - from.x), y = from.y + part * (to.y - from.y);
    return [x - 2, y - 2, x + 2, y + 2];
  });
}

/// Where labels of points go, so that none hides another: [[text, x, y]…], as many as find a place.
/// \param points  [{x, y, label, width}] in pixels   \param box  {left, top, right, bottom} to stay in
/// \param lines   [[{x, y}…]…] to keep off
function label_places(points, box, lines = []) {
  const taken = [...points.map(({ x, y }) => [x - 3, y - 3, x + 3, y + 3]),
    ...lines.flatMap((l) => l.slice(1).flatMap((to, i) => covered(l[i], to)))], out = [];
  const free = ([l, t, r, b]) => l > box.left && r < box.right && t > box.top && b < box.bottom
    && !taken.some((o) => l < o[2] && o[0] < r && t < o[3] && o[1] < b);
  for (const { x, y, label, width: w } of points) {
    const beside = [[5, -16], [-5 - w, -16], [5, 3], [-5 - w, 3], [7, -6], [-7 - w, -6], [-w / 2, -18], [-w / 2, 5]];
    const place = beside.map(([right, down]) => [x + right, y + down, x + right + w, y + down + 13]).find(free);
    if (!place) continue;
    taken.push([place[0] - 4, place[1], place[2] + 4, place[3]]);  // two numbers side by side are not one
    out.push([label, place[0], (place[1] + place[3]) / 2]);
  }
  return out;
}

/// \param data    [x, y…] for uPlot; null where there is no value and a line breaks, undefined where
///                it goes on without one
/// \param series  [{color, kind: "points" | "line" | "both", width, dash: [on, off], labels, x_error, y_error}] of the y;
///                the last three as long as y, of each point, or nothing
/// \param o       {x_label, x_ends: [from, to], x_steps, x_log, y_label, x_scales and y_scales: {linear, log: {low, high, ticks,
///                few}} of the whole, height, log, mark: x of a dashed line, text: the plot in words, y_of(i): whether point i sets
///                the range of y, single: the point next to the pointer speaks alone, of a series that
///                is not mute, shown: whether each series is at first, hover(indices or null)}
/// Returns {node, set({log, x_log, shown})}.
function curve_plot(data, series, o) {
  const node = el("div", { class: "curve", role: "img", tabindex: 0, "aria-label": o.text });
  const state = { log: o.log, x_log: o.x_log, shown: o.shown ?? series.map(() => true) };
  let plot = null;
  const bar = (errors, i) => (errors && known(errors[i]) ? errors[i] : 0);

  // The whole is drawn as it is told; what a reader cuts out of it has its own range.
  const told = (scales, log) => scales?.[log ? "log" : "linear"];
  const y_range = (u, low, high) => {
    let least = Infinity, most = -Infinity;
    const [from, to] = u.series[0].idxs ?? [0, data[0].length - 1];  // what of x is seen
    const scale = told(o.y_scales, state.log);
    if (scale && from === 0 && to === data[0].length - 1 && state.shown.every(Boolean)) return [scale.low, scale.high];
    series.forEach((_, s) => {
      if (!state.shown[s]) return;
      data[s + 1].forEach((v, i) => {
        if (!known(v) || i < from || i > to || !o.y_of(i) || (state.log && v <= 0)) return;
        const e = bar(series[s].y_error, i);
        least = Math.min(least, state.log && v <= e ? v : v - e);
        most = Math.max(most, v + e);
      });
    });
    if (least > most) return state.log ? [0.1, 1] : [0, 1];
    if (state.log) return [least / (most / least) ** 0.06 / 1.02, most * (most / least) ** 0.06 * 1.02];
    return [Math.min(0, least), most + 0.06 * (most - Math.min(0, least)) || 1];
  };
  const [first, last] = [data[0][0], data[0].at(-1)];
  const x_range = (u, low, high) => {
    if (low > first || high < last) return [low, high];
    const scale = told(o.x_scales, state.x_log);
    return scale ? [scale.low, scale.high] : o.x_ends ?? [first, last];
  };
  /// Ticks that are told, where the whole scale is seen: few where there is little room for them.
  const told_ticks = (scales, log) => {
    const scale = told(scales, log), free = log ? log_ticks : even_splits;
    return !scale && !log ? {} : { filter: (u, ticks) => ticks,
      splits: (u, a, low, high) => (low !== scale?.low || high !== scale.high ? free(low, high) : a > 0 || u.width > 520 ? scale.ticks : scale.few) };
  };
  const line = 15;
  const tick_texts = (u, ticks, of) => {
    const is_log = of === "x" ? state.x_log : state.log, { min, max } = u.scales[of], at = is_log ? Math.log : (v) => v;
    const length = of === "x" ? u.width - 80 : u.height - 70, part = (v) => (at(v) - at(min)) / (at(max) - at(min));
    const g = u.ctx;
    g.save();
    g.font = plot_font;
    const texts = uncrowded(ticks.map(tick_text), ticks.map((v) => length * part(v)), of === "x" ? (text) => g.measureText(text).width + 8 : () => line);
    g.restore();
    return texts;
  };
  const next_point = (u) => {  // [series, index] of the point next to the pointer, within 40 pixels
    let best = [null, null], least = 1600;
    u.data.slice(1).forEach((y, s) => state.shown[s] && !series[s].mute && y.forEach((v, i) => {
      if (!known(v)) return;
      const far = (u.valToPos(u.data[0][i], "x") - u.cursor.left) ** 2 + (u.valToPos(v, "y") - u.cursor.top) ** 2;
      if (far < least) [best, least] = [[s + 1, i], far];
    }));
    return best;
  };
  const nearest = (u, s, i) => {  // points lie apart: the one next to the cursor speaks
    if (o.single) {
      const [of, at] = next_point(u);
      return s === 0 ? at ?? i : of === s ? at : null;
    }
    const y = u.data[s];
    if (s === 0 || known(y[i])) return i;
    for (let k = 1; k < y.length; ++k)
      for (const j of [i - k, i + k])
        if (j >= 0 && j < y.length && known(y[j]))
          return Math.abs(u.valToPos(u.data[0][j], "x") - u.valToPos(u.data[0][i], "x")) < 12 ? j : null;
    return null;
  };
  const filled = (s) => data[s + 1].filter(known).length;
  const axis = (label, extra) => ({
    stroke: () => color("muted"), font: plot_font, label, labelFont: plot_font, labelSize: 20, labelGap: 0,
    grid: { stroke: () => color("faint"), width: 1 }, ticks: { stroke: () => color("rule"), width: 1, size: 4 },
    gap: 4, ...extra,
  });
  const drawn = (u, use) => series.forEach((s, k) => state.shown[k] && u.data[k + 1].forEach((v, i) => {
    if (known(v) && u.data[0][i] >= u.scales.x.min && u.data[0][i] <= u.scales.x.max) use(s, i, u.data[0][i], v);
  }));
  function draw_bars(u) {
    const g = u.ctx, { left, top, width, height } = u.bbox;
    g.save();
    g.beginPath();
    g.rect(left, top, width, height);
    g.clip();
    g.lineWidth = devicePixelRatio;
    drawn(u, (s, i, x, y) => {
      const [ex, ey] = [bar(s.x_error, i), bar(s.y_error, i)];
      if (!(ex > 0) && !(ey > 0)) return;
      const place = (v, scale, log, beyond) => (log && v <= 0 ? beyond : u.valToPos(v, scale, true));
      const [px, py] = [u.valToPos(x, "x", true), u.valToPos(y, "y", true)];
      g.strokeStyle = color(s.color);
      g.beginPath();
      if (ey > 0) {
        g.moveTo(px, place(y - ey, "y", state.log, top + height));
        g.lineTo(px, place(y + ey, "y", state.log));
      }
      if (ex > 0) {
        g.moveTo(place(x - ex, "x", state.x_log, left), py);
        g.lineTo(place(x + ex, "x", state.x_log), py);
      }
      g.stroke();
    });
    g.restore();
  }
  const most_labels = 60;  // more of them would hide the points
  function draw_labels(u) {
    const points = [], ways = new Map(), g = u.ctx, ratio = devicePixelRatio, { left, top, width, height } = u.bbox;
    g.save();
    g.font = plot_font.replace("12px", "11px");
    drawn(u, (s, i, x, y) => s.mute && ways.set(s, [...ways.get(s) ?? [], { x: u.valToPos(x, "x"), y: u.valToPos(y, "y") }]));
    drawn(u, (s, i, x, y) => s.labels?.[i] && points.push({ x: u.valToPos(x, "x"), y: u.valToPos(y, "y"), label: s.labels[i], width: g.measureText(s.labels[i]).width }));
    if (points.length && points.length <= most_labels) {
      g.translate(left, top);
      g.scale(ratio, ratio);
      g.fillStyle = color("ink");
      g.textBaseline = "middle";
      g.textAlign = "left";
      for (const [label, x, y] of label_places(points, { left: 0, top: 0, right: width / ratio, bottom: height / ratio }, [...ways.values()])) g.fillText(label, x, y);
    }
    g.restore();
  }
  function build(width) {
    plot?.destroy();
    const shown_data = state.log
      ? [data[0], ...data.slice(1).map((y) => y.map((v) => (known(v) && v <= 0 ? null : v)))] : data;
    plot = new uPlot({
      width, height: o.height ?? 250, legend: { show: false }, padding: [8, 8, 0, 0],
      cursor: { y: false, drag: { x: true, y: false }, dataIdx: nearest, points: { size: 7 } },
      scales: { x: { time: false, range: x_range, distr: state.x_log ? 3 : 1 },
                y: { distr: state.log ? 3 : 1, range: y_range } },
      axes: [
        axis(o.x_label, { size: 30, space: 40, incrs: o.x_steps, values: (u, ticks) => tick_texts(u, ticks, "x"),
                          ...told_ticks(o.x_scales, state.x_log) }),
        axis(o.y_label, { size: 52, values: (u, ticks) => tick_texts(u, ticks, "y"),
                          ...told_ticks(o.y_scales, state.log) }),
      ],
      // pxAlign 0: rounded to whole pixels, points would stand beside their line
      series: [{}, ...series.map((s, i) => (s.kind === "points"
        ? { pxAlign: 0, show: state.shown[i], stroke: () => color(s.color), paths: () => null,
            points: { show: true, size: filled(i) > 60 ? 4.5 : 7, width: 0, fill: () => color(s.color) + "8c" } }
        : { pxAlign: 0, show: state.shown[i], stroke: () => color(s.color), width: s.width ?? 1.6, dash: s.dash,
            points: { show: s.kind === "both", size: 5, width: 0, fill: () => color(s.color) } }))],
      hooks: {
        drawClear: [(u) => {
          if (!known(o.mark)) return;
          const x = u.valToPos(o.mark, "x", true);
          if (x < u.bbox.left || x > u.bbox.left + u.bbox.width) return;
          u.ctx.save();
          u.ctx.strokeStyle = color("muted");
          u.ctx.setLineDash([3 * devicePixelRatio, 3 * devicePixelRatio]);
          u.ctx.beginPath();
          u.ctx.moveTo(x, u.bbox.top);
          u.ctx.lineTo(x, u.bbox.top + u.bbox.height);
          u.ctx.stroke();
          u.ctx.restore();
        }],
        draw: [draw_bars, draw_labels],
        setCursor: [(u) => o.hover?.(u.cursor.idxs[0] === null || u.cursor.left < 0 ? null : u.cursor.idxs)],
      },
    }, shown_data, node);
  }
  // The arrow keys go from point to point of what is seen.
  node.addEventListener("keydown", (e) => {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[e.key];
    if (!step || !plot) return;
    e.preventDefault();
    const points = plot.data[0].map((_, i) => i).filter((i) => plot.data.slice(1).some((y, s) => state.shown[s] && series[s].kind === "points" && known(y[i])));
    const to = points.length ? points : plot.data[0].map((_, i) => i), now = plot.cursor.idx ?? -1;
    const next = step > 0 ? to.find((i) => i > now) ?? to.at(-1) : to.findLast((i) => i < now) ?? to[0];
    plot.setCursor({ left: plot.valToPos(plot.data[0][next], "x"), top: 0 });
  });
  when_resized(node, build);
  when_colors_change(() => plot && build(plot.width));
  return { node, set(change) { Object.assign(state, change); if (plot) build(plot.width); } };
}

/// A colour between those of a list, at t in [0, 1].
function between_colors(list, t) {
  const rgb = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));
  const x = Math.min(1, Math.max(0, t)) * (list.length - 1), i = Math.min(list.length - 2, Math.floor(x));
  const a = rgb(list[i]), b = rgb(list[i + 1]);
  return `rgb(${a.map((v, k) => Math.round(v + (x - i) * (b[k] - v))).join(",")})`;
}
const diverging = () => ["low-2", "low-1", "zero", "high-1", "high-2"].map(color);
const sequential = () => ["zero", "rms-1", "rms-2"].map(color);

/// Colour of a difference: one course below what is hardly seen, another from there to the greatest.
function difference_color(x, { limit, max }) {
  const list = x <= limit ? ["zero", "rms-1"] : ["high-1", "high-2"];
  return between_colors(list.map(color), x <= limit ? x / limit : (x - limit) / (max - limit));
}
/// A square picture of differences, a byte a pixel in base64: \param scale  {steps to 1, limit, max, not_covered: the byte of pixels
/// that have none, if there are such}.  255 is beside the picture.
function difference_picture(bytes, pixels, scale, text) {
  const canvas = el("canvas", { class: "sphere", width: pixels, height: pixels, role: "img", "aria-label": text });
  const parts = Uint8Array.from(atob(bytes), (c) => c.charCodeAt(0)), beside = 255, greys = [136, 184];
  const draw = () => {
    const g = canvas.getContext("2d"), image = g.createImageData(pixels, pixels);
    const colours = Array.from({ length: beside }, (_, part) => difference_color(part / scale.steps, scale).match(/\d+/g).map(Number));
    const stripes = (i) => Array(3).fill(greys[((i % pixels) + Math.floor(i / pixels)) % 8 < 4 ? 0 : 1]);
    parts.forEach((part, i) => { if (part !== beside) image.data.set([...(part === scale.not_covered ? stripes(i) : colours[part]), 255], 4 * i); });
    g.putImageData(image, 0, 0);
  };
  draw();
  when_colors_change(draw);
  return canvas;
}

/// An axis of a map over angles: {edges [°], …how it is drawn}.  theta_h grows as its square root: the peak is seen.
function map_axis(name, edges) {
  const root = name === "theta_h";
  const label = { theta_h: "θ_h [°], half-vector angle (axis grows as √θ_h)", theta_d: "θ_d [°], difference angle",
                  theta_i: "θ_i [°], incident angle", theta_o: "θ_o [°], outgoing angle" }[name];
  const even = [0, 15, 30, 45, 60, 75, 90];
  return { name, edges, label, unit: "°", ends: [0, 90], part: (deg) => (root ? Math.sqrt(deg / 90) : deg / 90), value: (part) => 90 * (root ? part * part : part),
           ticks: root ? [0, 0.5, 2, 5, 10, 20, 30, 45, 60, 90] : even, few: root ? [0, 2, 10, 30, 60, 90] : even };
}

/// Cells over two axes, one of several layers at a time.
/// \param x, y    {name, label, unit, edges, at: what is told of a cell, ends, part(value): place in [0, 1], value(part), ticks, few: fewer
///                ticks, names: of the cells, instead of ticks; edges then count them}
/// \param layers  {name: {at(k): place on the scale in [0, 1], or null; colors: function to a list, or
///                 color(k); ticks: [[place, text]…]; label; ground: colour where nothing is;
///                 text(k): what stands in the cell, where there is room; above(k): it is beyond a line that is
///                 drawn}}, of cell k = x · cells of y + y
/// \param say(k)  what is at a cell   \param text  the picture in words
/// Returns {node, set(name)}.
function heat_map(x, y, layers, say, text) {
  const nx = x.edges.length - 1, ny = y.edges.length - 1;
  const canvas = el("canvas", { class: "map", role: "img", tabindex: 0, "aria-label": text });
  const readout = el("div", { class: "readout", "aria-live": "polite" });
  const state = { layer: Object.values(layers)[0], cell: null };

  const box = { left: 46, top: 8, right: 10, bottom: 84 };
  let width = 0, height = 0, legend_width = 0, legend_height = 0;
  let turned = false, label_beside = true;  // names of x, which are longer than their cells are wide; what colours mean
  let y_lines = [];  // of each name of y
  const small = 11 / 12;  // letters of a name in two lines
  const x_of = (value) => box.left + (width - box.left - box.right) * x.part(value);
  const y_of = (value) => height - box.bottom - (height - box.bottom - box.top) * y.part(value);

  /// Text that is at most so wide.
  function fitting(g, text, most) {
    if (g.measureText(text).width <= most) return text;
    let n = text.length;
    while (n > 1 && g.measureText(text.slice(0, n) + "…").width > most) --n;
    return text.slice(0, n) + "…";
  }
  /// In one line, or in two of smaller letters, broken where a part of the name ends.
  function name_lines(g, text, most) {
    const fits = (part) => g.measureText(part).width * small <= most;
    if (g.measureText(text).width <= most) return [text];
    const breaks = [...text.matchAll(/[/+.,: ]/g)].map((m) => m.index + 1).filter((at) => fits(text.slice(0, at)));
    const whole = breaks.filter((at) => fits(text.slice(at)));
    const at = whole.findLast((i) => text[i - 1] === "/") ?? whole.at(-1) ?? breaks.at(-1) ?? 0;
    return [text.slice(0, at), fitting(g, text.slice(at), most / small)].filter(Boolean);
  }
  /// The room that the axes' texts need.
  function make_room(g) {
    const widest = (texts) => Math.max(0, ...texts.map((t) => g.measureText(t).width));
    const of_y = widest(y.names ?? y.ticks.map(tick_text)), of_x = x.names ? widest(x.names) : 0;
    box.left = Math.min(Math.max(46, of_y + 32), 0.44 * width);
    y_lines = (y.names ?? []).map((name) => name_lines(g, name, box.left - 24));
    turned = Boolean(x.names) && of_x > (width - box.left - box.right) / nx - 6;
    legend_width = Math.min(360, width - box.left - box.right);
    label_beside = width - box.left - box.right > legend_width + 16 + g.measureText(state.layer.label).width;
    legend_height = label_beside ? 33 : 50;
    box.bottom = 51 + legend_height + (turned ? Math.min(130, 0.7 * of_x) - 6 : 0);
    const [row, most] = y_lines.some((lines) => lines.length > 1) ? [30, 1500] : [26, 1200];
    height = y.names ? box.top + box.bottom + Math.min(most, Math.max(120, row * ny)) : Math.round(Math.min(470, Math.max(330, width * 0.52)));
  }
  function draw() {
    const scale = devicePixelRatio || 1, measure = canvas.getContext("2d");
    measure.font = plot_font;
    make_room(measure);
    canvas.width = width * scale;
    canvas.height = height * scale;
    canvas.style.height = height + "px";
    const g = canvas.getContext("2d");
    g.scale(scale, scale);
    g.font = plot_font;
    const layer = state.layer, colors = layer.colors?.();
    const [x0, x1, y0, y1] = [...x.ends.map(x_of), ...y.ends.map(y_of)];

    if (layer.ground) {
      g.fillStyle = color(layer.ground);
      g.fillRect(x0, y1, x1 - x0, y0 - y1);
    }
    for (let i = 0; i < nx; ++i)
      for (let j = 0; j < ny; ++j) {
        const k = i * ny + j, at = layer.at(k);
        if (at === null) continue;
        const [l, r] = [Math.round(x_of(x.edges[i])), Math.round(x_of(x.edges[i + 1]))];
        const [t, b] = [Math.round(y_of(y.edges[j + 1])), Math.round(y_of(y.edges[j]))];
        g.fillStyle = layer.color ? layer.color(k) : between_colors(colors, at);
        g.fillRect(l, t, r - l, b - t);
        const said = layer.text?.(k);
        if (!said || g.measureText(said).width > r - l - 4 || b - t < 16) continue;
        const [red, green, blue] = [1, 3, 5].map((at) => parseInt(g.fillStyle.slice(at, at + 2), 16));  // as canvas tells it: #rrggbb
        g.fillStyle = 0.299 * red + 0.587 * green + 0.114 * blue < 130 ? "#fcfcfa" : "#1c1f23";
        g.textAlign = "center";
        g.textBaseline = "middle";
        g.fillText(said, (l + r) / 2, (t + b) / 2);
      }
    if (layer.above) {  // a line between cells of which only one is
      g.beginPath();
      const edge = (k, other, ...[l, t, r, b]) => { if (layer.above(k) !== layer.above(other)) { g.moveTo(l, t); g.lineTo(r, b); } };
      for (let i = 0; i < nx; ++i)
        for (let j = 0; j < ny; ++j) {
          const k = i * ny + j, [l, r] = [i, i + 1].map((e) => Math.round(x_of(x.edges[e]))), [b, t] = [j, j + 1].map((e) => Math.round(y_of(y.edges[e])));
          if (i + 1 < nx) edge(k, k + ny, r, t, r, b);
          if (j + 1 < ny) edge(k, k + 1, l, t, r, t);
        }
      g.strokeStyle = color("ink");
      g.lineWidth = 2;
      g.stroke();
      g.lineWidth = 1;
    }
    g.strokeStyle = color("rule");
    g.strokeRect(x0 + 0.5, y1 + 0.5, x1 - x0 - 1, y0 - y1 - 1);

    g.fillStyle = color("muted");
    g.textAlign = "center";
    g.textBaseline = "top";
    const middles = (axis) => axis.names.map((name, i) => [i + 0.5, name]), wide = (text) => g.measureText(text).width + 8;
    const free_ticks = (ticks, place) => { const texts = uncrowded(ticks.map(tick_text), ticks.map(place), wide); return ticks.map((t, i) => [t, texts[i]]); };
    for (const [t, name] of x.names ? middles(x) : free_ticks(width > 520 ? x.ticks : x.few, x_of)) {
      g.fillRect(Math.round(x_of(t)), y0, 1, 4);
      if (!turned) { g.fillText(name, x_of(t), y0 + 7); continue; }
      g.save();
      g.translate(x_of(t) + 5, y0 + 7);
      g.rotate(-0.7);
      g.textAlign = "right";
      g.fillText(fitting(g, name, 180), 0, 0);
      g.restore();
    }
    g.textAlign = "center";
    g.fillText(fitting(g, x.label, x1 - x0), (x0 + x1) / 2, height - legend_height - 29);
    g.textAlign = "right";
    g.textBaseline = "middle";
    for (const [t, lines] of y.names ? y_lines.map((lines, i) => [i + 0.5, lines]) : y.ticks.map((t) => [t, [tick_text(t)]])) {
      g.fillRect(x0 - 4, Math.round(y_of(t)), 4, 1);
      g.font = lines.length > 1 ? plot_font.replace("12px", "11px") : plot_font;
      lines.forEach((line, i) => g.fillText(line, x0 - 7, y_of(t) + 12 * (i - (lines.length - 1) / 2)));
    }
    g.font = plot_font;
    g.save();
    g.translate(9, (y0 + y1) / 2);
    g.rotate(-Math.PI / 2);
    g.textAlign = "center";
    g.fillText(fitting(g, y.label, y0 - y1), 0, 0);
    g.restore();

    // Legend
    const [lx, lw, ly] = [x0, legend_width, height - legend_height];
    const scale_colors = colors ?? ["#000000", "#ffffff"];
    for (let i = 0; i < lw; ++i) {
      g.fillStyle = between_colors(scale_colors, (i + 0.5) / lw);
      g.fillRect(lx + i, ly, 1.5, 10);
    }
    g.fillStyle = color("muted");
    g.textBaseline = "top";
    const names = uncrowded(layer.ticks.map(([, name]) => name), layer.ticks.map(([at]) => lw * at), (text) => g.measureText(text).width + 8);
    layer.ticks.forEach(([at], i) => {
      const name = names[i];
      g.textAlign = at < 0.05 ? "left" : at > 0.95 ? "right" : "center";
      g.fillText(name, lx + lw * at, ly + 14);
    });
    g.textAlign = "left";
    g.textBaseline = "middle";
    if (label_beside) g.fillText(layer.label, lx + lw + 16, ly + 5);
    else g.fillText(fitting(g, layer.label, width - lx - 4), lx, ly + 38);
    if (state.cell) {
      const [i, j] = state.cell;
      g.strokeStyle = color("ink");
      g.lineWidth = 1.5;
      g.strokeRect(x_of(x.edges[i]), y_of(y.edges[j + 1]), x_of(x.edges[i + 1]) - x_of(x.edges[i]), y_of(y.edges[j]) - y_of(y.edges[j + 1]));
    }
  }
  function tell() {
    if (!state.cell) {
      readout.replaceChildren(el("span", { class: "hint" }, "Point at a cell, or move with the arrow keys, to read it."));
      return;
    }
    const [i, j] = state.cell;
    const place = (axis, n) => (axis.names ? axis.names[n] : axis.at ? plain(axis.at[n], 3) : `${plain(axis.edges[n], 3)}–${plain(axis.edges[n + 1], 3)}${axis.unit}`);
    readout.replaceChildren(angle_name(x.name), ` ${place(x, i)}, `, angle_name(y.name), ` ${place(y, j)}: `, ...say(i * ny + j));
  }
  const point_at = (cell) => { state.cell = cell; draw(); tell(); };
  canvas.addEventListener("pointermove", (e) => {
    const r = canvas.getBoundingClientRect();
    const [x0, x1, y0, y1] = [...x.ends.map(x_of), ...y.ends.map(y_of)];
    const u = (e.clientX - r.left - x0) / (x1 - x0), v = (y0 - e.clientY + r.top) / (y0 - y1);
    if (!(u >= 0 && u < 1 && v >= 0 && v < 1)) return point_at(null);
    const find = (edges, a) => edges.findLastIndex((edge) => edge <= a);
    point_at([Math.min(nx - 1, find(x.edges, x.value(u))), Math.min(ny - 1, find(y.edges, y.value(v)))]);
  });
  canvas.addEventListener("pointerleave", () => point_at(null));
  canvas.addEventListener("keydown", (e) => {
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[e.key];
    if (!step) return;
    e.preventDefault();
    const [i, j] = state.cell ?? [0, 0];
    point_at([Math.min(nx - 1, Math.max(0, i + step[0])), Math.min(ny - 1, Math.max(0, j + step[1]))]);
  });
  const node = el("div", {}, canvas, readout);
  when_resized(node, (w) => { width = w; draw(); });
  when_colors_change(() => width && draw());
  tell();
  return { node, set(name) { state.layer = layers[name]; if (width) draw(); tell(); } };
}

/// An interval around a value on a common scale of relative distance; truth as a tick.  What goes on beyond the scale ends in
/// an arrow, as does the open end of a limit, whose other end stands in the middle.
/// \param low, high, truth  relative to the value, or to the limit; -Infinity or Infinity at an open end; `reach` is the end of the scale
function interval_drawing(low, high, truth, reach, text) {
  const w = 180, h = 16, x = (r) => w / 2 + (w / 2 - 8) * Math.max(-1, Math.min(1, r / reach));
  const line = (x1, x2, y1, y2, stroke, width) => el("line", { x1, x2, y1, y2, stroke: `var(--${stroke})`, "stroke-width": width });
  const arrow = (right, fill) => el("path", { d: right ? `M${w - 8} 3 l7 5 l-7 5z` : "M8 3 l-7 5 l7 5z", fill: `var(--${fill})` });
  const limit = !Number.isFinite(low) || !Number.isFinite(high);
  return el("svg", { width: w, height: h, viewBox: `0 0 ${w} ${h}`, role: "img", "aria-label": text },
    line(2, w - 2, h / 2, h / 2, "rule", 1),
    line(x(low), x(high), h / 2, h / 2, "accent", 4),
    low < -reach ? arrow(false, "accent") : null, high > reach ? arrow(true, "accent") : null,
    limit ? line(w / 2, w / 2, 2, h - 2, "accent", 3) : el("circle", { cx: w / 2, cy: h / 2, r: 3, fill: "var(--ink)" }),
    known(truth) ? (Math.abs(truth) <= reach ? line(x(truth), x(truth), 1, h - 1, "red", 2) : arrow(truth > 0, "red")) : null);
}
