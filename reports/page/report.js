"use strict";
// What the pages of the reports share, beside their pictures.

/// Curves over one x, each with its own points; where a curve has none, the line goes on (spanGaps) or stops.
/// \param curves  [{name, x: […], y: […], color, width, dash, kind, quiet: no place in the legend}]
/// \param o       {title, note, x_label, y_label, x_log, log, x_ends, mark, text, x_text(x), y_text(y), scale: whether the
///                scale of y can be switched}
function lines_figure(curves, o) {
  const xs = [...new Set(curves.flatMap((c) => c.x))].sort((a, b) => a - b);
  const column = (c) => {
    const at = new Map(c.x.map((x, i) => [x, c.y[i]]));
    return xs.map((x) => (known(at.get(x)) ? at.get(x) : null));
  };
  const shades = curves.map((c, i) => c.color ?? line_colors[i % line_colors.length]);
  const data = [xs, ...curves.map(column)];
  const x_text = o.x_text ?? ((x) => plain(x, 4)), y_text = o.y_text ?? ((y) => significant(y, 3));
  const readout = el("div", { class: "readout", "aria-live": "polite" });
  const hover = (at) => {
    if (!at) return readout.replaceChildren(el("span", { class: "hint" }, o.hint ?? "Point at a curve to read it."));
    const told = curves.map((c, i) => [c, shades[i], at[i + 1] === null ? null : data[i + 1][at[i + 1] ?? at[0]]])
      .filter(([c, , y]) => !c.quiet && y !== null && y !== undefined);
    readout.replaceChildren(`${o.x_label} ${x_text(xs[at[0]])}: `,
      ...told.flatMap(([c, shade, y], k) => [k ? ", " : "", chip(shade), `${c.name} `, el("b", {}, y_text(y))]));
  };
  const plot = curve_plot(data, curves.map((c, i) => ({ color: shades[i], kind: c.kind ?? "line", width: c.width, dash: c.dash })),
    { ...o, y_of: () => true, hover });
  hover(null);
  const named = curves.map((c, i) => [c, shades[i]]).filter(([c]) => !c.quiet);
  const legend = el("div", { class: "controls" },
    o.scale ? choice(`Scale of ${o.y_label}`, [[false, "linear"], [true, "logarithmic"]], o.log ?? false, (log) => plot.set({ log })) : null,
    el("span", { class: "keys" }, named.map(([c, shade]) => el("span", {}, chip(shade), c.name))));
  return el("figure", {}, o.title ? el("figcaption", {}, o.title, o.note ? el("small", {}, " " + o.note) : null) : null,
    legend, plot.node, readout);
}

/// A list to choose from; changes are told.
function chooser(label, options, chosen, change) {
  return el("label", {}, label + " ", el("select", { onchange: (e) => change(e.target.value) },
    options.map(([value, text]) => el("option", { value, selected: value === chosen ? "" : null }, text))));
}
/// A place whose content is made again whenever a choice changes.
function changing(make) {
  const node = el("div", {});
  const again = () => node.replaceChildren(...[make()].flat());
  again();
  return { node, again };
}
const group_by = (list, key) => list.reduce((groups, x) => {
  const k = key(x);
  groups.get(k)?.push(x) ?? groups.set(k, [x]);
  return groups;
}, new Map());
const unique = (list) => [...new Set(list)];
