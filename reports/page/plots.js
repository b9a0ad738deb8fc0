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
  if (ticks.length > 1) return ticks;
  const step_now = 10 ** Math.floor(Math.log10((high - low) / 2));  // hardly a range: even steps
  return Array.from({ length: 21 }, (_, i) => (Math.ceil(low / step_now) + i) * step_now)
    .filter((x) => x <= high).filter((_, i, all) => i % Math.ceil(all.length / 5) === 0);
}
function tick_text(x) {
  if (x === null) return "";
  if (x === 0) return "0";
  const power = Math.floor(Math.log10(Math.abs(x)) + 1e-9);
  if (power >= -3 && power <= 3) return minus(String(Number(x.toPrecision(6))));
  const lead = Number((x / 10 ** power).toPrecision(3));
  return (lead === 1 ? "" : minus(String(lead)) + "·") + "10" + superscript(power);
}

/// \param data    [x, y…] for uPlot; null where there is no value
/// \param series  [{color, kind: "points" | "line" | "both", width, dash: [on, off]}] of the y
/// \param o       {x_label, x_ends, x_steps, x_log, y_label, height, log, mark: x of a dashed line, text: the plot
///                in words, y_of(i): whether point i sets the range of y, hover(indices or null)}
/// Returns {node, set({log, shown})}.
function curve_plot(data, series, o) {
  const node = el("div", { class: "curve", role: "img", tabindex: 0, "aria-label": o.text });
  const state = { log: o.log, shown: series.map(() => true) };
  let plot = null;

  const y_range = (u, low, high) => {
    let least = Infinity, most = -Infinity;
    const [from, to] = u.series[0].idxs ?? [0, data[0].length - 1];  // what of x is seen
    series.forEach((_, s) => {
      if (!state.shown[s]) return;
      data[s + 1].forEach((v, i) => {
        if (v === null || i < from || i > to || !o.y_of(i) || (state.log && v <= 0)) return;
        least = Math.min(least, v);
        most = Math.max(most, v);
      });
    });
    if (least > most) return state.log ? [0.1, 1] : [0, 1];
    if (state.log) return [least / (most / least) ** 0.06 / 1.02, most * (most / least) ** 0.06 * 1.02];
    return [Math.min(0, least), most + 0.06 * (most - Math.min(0, least)) || 1];
  };
  const [first, last] = [data[0][0], data[0].at(-1)];
  const x_range = (u, low, high) => (low <= first && high >= last ? o.x_ends ?? [first, last] : [low, high]);
  const nearest = (u, s, i) => {  // points lie apart: the one next to the cursor speaks
    const y = u.data[s];
    if (s === 0 || y[i] !== null) return i;
    for (let k = 1; k < y.length; ++k)
      for (const j of [i - k, i + k])
        if (j >= 0 && j < y.length && y[j] !== null)
          return Math.abs(u.valToPos(u.data[0][j], "x") - u.valToPos(u.data[0][i], "x")) < 12 ? j : null;
    return null;
  };
  const filled = (s) => data[s + 1].filter((v) => v !== null).length;
  const log_axis = { splits: (u, a, low, high) => log_ticks(low, high), filter: (u, ticks) => ticks };
  const axis = (label, extra) => ({
    stroke: () => color("muted"), font: plot_font, label, labelFont: plot_font, labelSize: 20, labelGap: 0,
    grid: { stroke: () => color("faint"), width: 1 }, ticks: { stroke: () => color("rule"), width: 1, size: 4 },
    gap: 4, ...extra,
  });
  function build(width) {
    plot?.destroy();
    const shown_data = state.log
      ? [data[0], ...data.slice(1).map((y) => y.map((v) => (v !== null && v > 0 ? v : null)))] : data;
    plot = new uPlot({
      width, height: o.height ?? 250, legend: { show: false }, padding: [8, 8, 0, 0],
      cursor: { y: false, drag: { x: true, y: false }, dataIdx: nearest, points: { size: 7 } },
      scales: { x: { time: false, range: x_range, distr: o.x_log ? 3 : 1 },
                y: { distr: state.log ? 3 : 1, range: y_range } },
      axes: [
        axis(o.x_label, { size: 30, space: 40, incrs: o.x_steps, values: (u, ticks) => ticks.map(tick_text),
                          ...(o.x_log ? log_axis : {}) }),
        axis(o.y_label, { size: 52, values: (u, ticks) => ticks.map(tick_text),
                          ...(state.log ? log_axis : {}) }),
      ],
      // pxAlign 0: rounded to whole pixels, points would stand beside their line
      series: [{}, ...series.map((s, i) => (s.kind === "points"
        ? { pxAlign: 0, show: state.shown[i], stroke: () => color(s.color), paths: () => null,
            points: { show: true, size: filled(i) > 60 ? 4.5 : 7, width: 0, fill: () => color(s.color) + "8c" } }
        : { pxAlign: 0, show: state.shown[i], stroke: () => color(s.color), width: s.width ?? 1.6, dash: s.dash,
            spanGaps: s.kind === "both", points: { show: s.kind === "both", size: 5, width: 0, fill: () => color(s.color) } }))],
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
        setCursor: [(u) => o.hover?.(u.cursor.idxs[0] === null || u.cursor.left < 0 ? null : u.cursor.idxs)],
      },
    }, shown_data, node);
  }
  // The arrow keys go from point to point of what is seen.
  node.addEventListener("keydown", (e) => {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[e.key];
    if (!step || !plot) return;
    e.preventDefault();
    const points = plot.data[0].map((_, i) => i).filter((i) => plot.data.slice(1).some((y, s) => state.shown[s] && series[s].kind === "points" && y[i] !== null));
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

/// An axis of a map over angles: {edges [°], …how it is drawn}.  theta_h grows as its square root: the peak is seen.
function map_axis(name, edges) {
  const root = name === "theta_h";
  const label = { theta_h: "θ_h [°], half-vector angle (axis grows as √θ_h)", theta_d: "θ_d [°], difference angle",
                  theta_i: "θ_i [°], incident angle", theta_o: "θ_o [°], outgoing angle" }[name];
  const even = [0, 15, 30, 45, 60, 75, 90];
  return { name, edges, label, unit: "°", ends: [0, 90], part: (deg) => (root ? Math.sqrt(deg / 90) : deg / 90), value: (part) => 90 * (root ? part * part : part),
           ticks: root ? [0, 0.5, 2, 5, 10, 20, 30, 45, 60, 90] : even, few: root ? [0, 2, 10, 30, 60, 90] : even };
}

/// An axis of a map over anything from 0 to 1, of cells around `at`.
function unit_axis(name, label, at) {
  const between = at.slice(1).map((x, i) => (x + at[i]) / 2);
  return { name, at, label, unit: "", ends: [0, 1], edges: [0, ...between, 1], part: (x) => x, value: (part) => part,
           ticks: [0, 0.2, 0.4, 0.6, 0.8, 1], few: [0, 0.5, 1] };
}

/// Cells over two axes, one of several layers at a time.
/// \param layers  {name: {at(k): place on the scale in [0, 1], or null; colors: function to a list, or
///                 color(k); ticks: [[place, text]…]; label; ground: colour where nothing is}}, of cell
///                 k = x · cells of y + y
/// \param say(k)  what is at a cell   \param text  the picture in words
/// Returns {node, set(name)}.
function heat_map(x, y, layers, say, text) {
  const nx = x.edges.length - 1, ny = y.edges.length - 1;
  const canvas = el("canvas", { class: "map", role: "img", tabindex: 0, "aria-label": text });
  const readout = el("div", { class: "readout", "aria-live": "polite" });
  const state = { layer: Object.values(layers)[0], cell: null };

  const box = { left: 46, top: 8, right: 10, bottom: 84 };
  let width = 0, height = 0;
  const x_of = (value) => box.left + (width - box.left - box.right) * x.part(value);
  const y_of = (value) => height - box.bottom - (height - box.bottom - box.top) * y.part(value);

  function draw() {
    const scale = devicePixelRatio || 1;
    height = Math.round(Math.min(470, Math.max(330, width * 0.52)));
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
      }
    g.strokeStyle = color("rule");
    g.strokeRect(x0 + 0.5, y1 + 0.5, x1 - x0 - 1, y0 - y1 - 1);

    g.fillStyle = color("muted");
    g.textAlign = "center";
    g.textBaseline = "top";
    for (const t of width > 520 ? x.ticks : x.few) {
      g.fillRect(Math.round(x_of(t)), y0, 1, 4);
      g.fillText(String(t), x_of(t), y0 + 7);
    }
    g.fillText(x.label.slice(0, width > 420 ? 99 : 7), (x0 + x1) / 2, y0 + 22);
    g.textAlign = "right";
    g.textBaseline = "middle";
    for (const t of y.ticks) {
      g.fillRect(x0 - 4, Math.round(y_of(t)), 4, 1);
      g.fillText(String(t), x0 - 7, y_of(t));
    }
    g.save();
    g.translate(9, (y0 + y1) / 2);
    g.rotate(-Math.PI / 2);
    g.textAlign = "center";
    g.fillText(y.label, 0, 0);
    g.restore();

    // Legend
    const [lx, lw, ly] = [x0, Math.min(360, x1 - x0), height - 33];
    const scale_colors = colors ?? ["#000000", "#ffffff"];
    for (let i = 0; i < lw; ++i) {
      g.fillStyle = between_colors(scale_colors, (i + 0.5) / lw);
      g.fillRect(lx + i, ly, 1.5, 10);
    }
    g.fillStyle = color("muted");
    g.textBaseline = "top";
    const ticks = lw < 300 && layer.ticks.length > 3 ? layer.ticks.filter((_, i) => i % 2 === 0) : layer.ticks;
    ticks.forEach(([at, name]) => {
      g.textAlign = at < 0.05 ? "left" : at > 0.95 ? "right" : "center";
      g.fillText(name, lx + lw * at, ly + 14);
    });
    if (x1 - x0 > 620) {
      g.textAlign = "left";
      g.textBaseline = "middle";
      g.fillText(layer.label, lx + lw + 16, ly + 5);
    }
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
    const place = (axis, n) => (axis.at ? plain(axis.at[n], 3) : `${plain(axis.edges[n], 3)}–${plain(axis.edges[n + 1], 3)}${axis.unit}`);
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
  return { node, set(name) { state.layer = layers[name]; draw(); } };
}

/// An interval around a value on a common scale of relative distance; truth as a tick.
/// \param low, high, truth  relative to the value; `reach` is the end of the scale
function interval_drawing(low, high, truth, reach, text) {
  const w = 180, h = 16, x = (r) => w / 2 + (w / 2 - 8) * Math.max(-1, Math.min(1, r / reach));
  const line = (x1, x2, y1, y2, stroke, width) => el("line", { x1, x2, y1, y2, stroke: `var(--${stroke})`, "stroke-width": width });
  return el("svg", { width: w, height: h, viewBox: `0 0 ${w} ${h}`, role: "img", "aria-label": text },
    line(2, w - 2, h / 2, h / 2, "rule", 1),
    line(x(low), x(high), h / 2, h / 2, "accent", 4),
    el("circle", { cx: w / 2, cy: h / 2, r: 3, fill: "var(--ink)" }),
    known(truth) ? (Math.abs(truth) <= reach ? line(x(truth), x(truth), 1, h - 1, "red", 2)
      : el("path", { d: truth > 0 ? `M${w - 7} 3 l6 5 l-6 5z` : "M7 3 l-6 5 l6 5z", fill: "var(--red)" })) : null);
}
