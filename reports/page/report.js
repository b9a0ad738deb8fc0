"use strict";
// What the pages of the reports share, beside their pictures.

/// A list to choose from; changes are told.
function chooser(label, options, chosen, change) {
  return el("label", {}, label + " ", el("select", { onchange: (e) => change(e.target.value) },
    options.map(([value, text]) => el("option", { value, selected: value === chosen ? "" : null }, text))));
}
/// Sentences: the first at once, the others behind a click, and on paper.
function findings_view(findings, at_once = 5) {
  const told = (list) => list.map((f) => el("p", {}, f)), rest = findings.slice(at_once);
  if (!rest.length) return el("div", { class: "verdict" }, told(findings));
  const more = el("details", {}, el("summary", {}, many(rest.length, "more finding")), told(rest));
  addEventListener("beforeprint", () => { more.open = true; });
  return el("div", { class: "verdict" }, told(findings.slice(0, at_once)), more);
}
/// A table whose rows become cards where there is little room: each cell then tells what it is of.
function told_by_cell(head, list, classes) {
  const t = table(head, list, { row_class: classes });
  const names = head.map((h) => h?.n ?? h);
  for (const row of t.tBodies[0].rows) [...row.cells].forEach((cell, k) => k && cell.setAttribute("data-of", names[k]));
  return el("div", { class: "told-by-cell" }, t);
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
// What a link leads to is made by this script, after the browser has looked for it.
addEventListener("load", () => location.hash && document.getElementById(decodeURIComponent(location.hash.slice(1)))?.scrollIntoView());
