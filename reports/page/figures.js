"use strict";
// Pictures that are data (reports/picture/figure.h), drawn, with what is under the pointer; their files lie beside the page.

/// {color, dash, width} of a curve, as its data tell: the same of a name in all pictures of the report.
const line_style = ({ colour, dash, width }) => ({ color: colour, dash: dash ? dash.split(" ").map(Number) : null, width });
/// Look of a curve, beside its name.
const line_key = (style, kind) => el("svg", { width: 24, height: 10, viewBox: "0 0 24 10", "aria-hidden": "true" },
  kind === "points" ? null : el("line", { x1: 1, x2: 23, y1: 5, y2: 5, stroke: `var(--${style.color})`, "stroke-width": style.width, "stroke-dasharray": style.dash?.join(" ") }),
  kind === "line" ? null : el("circle", { cx: 12, cy: 5, r: 3.2, fill: `var(--${style.color})` }));

/// Links to the files of a picture: gonio report writes them into a folder of the report's name.
const picture_folder = /^gonio\.report\.(\w+)\//.exec(page_data().schema ?? "")?.[1];
function picture_files(picture, endings) {
  return picture_folder ? el("span", { class: "files" }, endings.map((e) => el("a", { href: `${picture_folder}/${picture.id}.${e}` }, e.toUpperCase()))) : null;
}
const picture_caption = (picture, endings) => el("figcaption", {}, picture.title, picture.note ? el("small", {}, " " + picture.note) : null, " ", picture_files(picture, endings));

/// The picture of a family with these choices; numbers and words are alike.
const picture_of = (pictures, family, choices = {}) => pictures.find((p) => p.family === family
  && Object.entries(choices).every(([of, chosen]) => p.choices[of] === String(chosen)));
/// What can be chosen, in order: [value…] of a family, where the other choices are these.
const choices_of = (pictures, family, of, others = {}) => unique(pictures.filter((p) => p.family === family
  && Object.entries(others).every(([o, chosen]) => p.choices[o] === String(chosen))).map((p) => p.choices[of]));

/// Curves over one x, each with its own points; several may share an x.
/// Returns [xs, columns, index]: index[curve][i] is the point of the curve at xs[i], or undefined, and so is then its value; null is
/// a point without a value.
function merged_points(curves) {
  const times = new Map();  // how often each x is needed
  const at = curves.map((c) => {
    const own = new Map();
    c.x.forEach((x, i) => known(x) && (own.get(x)?.push(i) ?? own.set(x, [i])));
    own.forEach((list, x) => times.set(x, Math.max(times.get(x) ?? 0, list.length)));
    return own;
  });
  const xs = [...times].sort(([a], [b]) => a - b).flatMap(([x, n]) => Array(n).fill(x));
  const index = at.map((own) => { let k = 0; return xs.map((x, i) => { k = xs[i - 1] === x ? k + 1 : 0; return own.get(x)?.[k]; }); });
  return [xs, index.map((list, c) => list.map((i) => (i === undefined ? undefined : known(curves[c].y[i]) ? curves[c].y[i] : null))), index];
}

/// What a picture calls a curve.
const called = (curve) => curve.label ?? curve.name;
/// Names of the curves that a report's pictures show at first where there are more than can be told apart: the most shipped first.
let most_shipped = [];
const told_apart = 6;
/// Which of these are shown until the reader asks for all: references, what is emphasised, then what is most shipped.
function shown_first(curves, emphasis) {
  const rank = (c) => {
    const of = most_shipped.findIndex((name) => c.name.split(" = ").includes(name));
    return c.name === emphasis ? -1 : of < 0 ? most_shipped.length : of;
  };
  const own = curves.filter((c) => !c.dashed);
  const first = new Set(own.length > told_apart ? [...own].sort((a, b) => rank(a) - rank(b)).slice(0, told_apart) : own);
  return curves.map((c) => c.dashed || first.has(c));
}

/// \param figure  of the page's data
/// \param o       {height, emphasis: the curve that others stand back behind, only(curve): whether it is shown, x_text(x), y_text(y),
///                bare: without choices and keys, which stand once above several; copy: it stands on the page a second time}
/// Returns its element.
function figure_view(figure, o = {}) {
  let x = [];
  const timed = (c, key) => c[key] ?? c[key + "_ns"] ?? c[key + "_ms"];  // keys of what is measured in time end in its unit
  const curves = figure.curves.map((c) => ({ ...c, x: x = timed(c, "x") ?? x, y: timed(c, "y"), x_error: timed(c, "x_error"), y_error: timed(c, "y_error") })).filter((c) => o.only?.(c) ?? true);
  if (o.emphasis) curves.sort((a, b) => (a.name === o.emphasis) - (b.name === o.emphasis));  // drawn last
  const styles = curves.map(line_style).map((s, i) => (o.emphasis && curves[i].name === o.emphasis ? { color: "accent", width: 2.4 }
    : !o.emphasis || curves[i].dashed ? s : { color: "rule", width: 1, quiet: true }));
  const [xs, columns, index] = merged_points(curves);
  const along = (values, c) => values && index[c].map((i) => (i === undefined ? null : values[i]));
  const single = curves.some((c) => c.kind === "points") && curves.every((c) => c.dashed || c.kind === "points");
  const first = shown_first(curves, o.emphasis), some = first.includes(false);
  let shown = first;
  const x_text = o.x_text ?? ((v) => plain(v, 4)), y_text = o.y_text ?? ((v) => significant(v, 3));
  const with_bar = (text, e) => (known(e) && e > 0 ? `${text} ± ${significant(e, 1)}` : text);

  const readout = el("div", { class: "readout", "aria-live": "polite" });
  const hint = () => readout.replaceChildren(el("span", { class: "hint" }, single ? "Point at a point to read it." : "Point at a curve to read it."));
  const hover = (at) => {
    const told = at && curves.map((c, k) => [c, styles[k], at[k + 1] ?? null]).filter(([, s, i], k) => i !== null && !s.quiet && shown[k])
      .map(([c, s, i]) => [c, s, i, curves.indexOf(c)]).filter(([, , i, k]) => known(columns[k][i]));
    if (!told?.length) return hint();
    const y_of = (c, k, i) => el("b", {}, with_bar(y_text(columns[k][i]), c.y_error?.[index[k][i]]));
    const x_of = (c, k, i) => with_bar(x_text(xs[i]), c.x_error?.[index[k][i]]);
    if (single) {
      const [[c, s, i, k]] = told, label = c.labels?.[index[k][i]];
      return readout.replaceChildren(line_key(s, c.kind), ` ${[called(c), label].filter(Boolean).join(", ")}: ${figure.x.label} `, el("b", {}, x_of(c, k, i)), `, ${figure.y.label} `, y_of(c, k, i));
    }
    readout.replaceChildren(`${figure.x.label} ${x_text(xs[told[0][2]])}: `, ...told.flatMap(([c, s, i, k], n) =>
      [n ? ", " : "", line_key(s, c.kind), ` ${called(c)} `, c.labels?.[index[k][i]] ? `${c.labels[index[k][i]]} ` : "", y_of(c, k, i)]));
  };

  const plot = curve_plot([xs, ...columns], curves.map((c, k) => ({ ...styles[k], kind: c.kind, mute: single && c.dashed, labels: along(c.labels, k), x_error: along(c.x_error, k), y_error: along(c.y_error, k) })),
    { x_label: figure.x.label, y_label: figure.y.label, x_log: figure.x.log, log: figure.y.log, x_scales: figure.x.scales, y_scales: curves.length === figure.curves.length || known(figure.y.to) ? figure.y.scales : null,
      height: o.height ?? 300, shown, text: `${figure.title}: ${figure.y.label} by ${figure.x.label}.`, y_of: () => true, single, hover });
  hint();
  const id = o.copy || paper_width ? null : figure.id;
  if (o.bare) return el("figure", { id }, picture_caption(figure, ["svg", "csv"]), plot.node, readout);
  const scales = [[false, "linear"], [true, "logarithmic"]];
  const y_choice = figure.y.scales.log && figure.y.scales.linear.low >= 0, x_choice = figure.x.scales.log;
  const keys = el("span", { class: "keys" });
  const show_keys = () => keys.replaceChildren(...curves.flatMap((c, k) => (styles[k].quiet || !shown[k] ? [] : [el("span", {}, line_key(styles[k], c.kind), " ", called(c))])),
    ...(o.emphasis && styles.some((s) => s.quiet) ? [el("span", { class: "muted" }, "grey: the others")] : []));
  show_keys();
  const controls = el("div", { class: "controls" },
    y_choice ? choice(`Scale of ${figure.y.label}`, scales.map(([v, t]) => [v, x_choice ? `y ${t}` : t]), figure.y.log, (log) => plot.set({ log })) : null,
    x_choice ? choice(`Scale of ${figure.x.label}`, scales.map(([v, t]) => [v, `x ${t}`]), figure.x.log, (x_log) => plot.set({ x_log })) : null,
    some ? choice("Curves", [[false, `${first.filter((is, k) => is && !curves[k].dashed).length} curves`], [true, `all ${curves.filter((c) => !c.dashed).length}`]], false, (all) => {
      shown = all ? curves.map(() => true) : first;
      plot.set({ shown });
      show_keys();
    }) : null, keys);
  return el("figure", { id }, picture_caption(figure, ["svg", "csv"]), controls, plot.node, readout);
}

