"use strict";
// What the pages of the reports share, beside their pictures.

/// Name of a form by its id, of a variant with what tells it: form_names is of reports/finding/names.cpp.
function named(form) {
  const [id] = form.split(",");
  return form_names[form] ?? (id in form_names ? form_names[id] + form.slice(id.length) : form);
}
/// The same by an id without its role, of a term that a renderer's highlight has.
const named_short = (id) => named(["fresnel", "masking", "ndf", "model"].map((role) => `${role}.${id}`).find((form) => form.split(",")[0] in form_names) ?? id);
/// A form's name, and its id small.
const form_cell = (form) => (named(form) === form ? el("code", {}, form) : el("span", { class: "form" }, named(form), " ", el("small", {}, el("code", {}, form.slice(form.indexOf(".") + 1)))));
/// A list to choose from; changes are told.
function chooser(label, options, chosen, change) {
  return el("label", {}, label + " ", el("select", { onchange: (e) => change(e.target.value) },
    options.map(([value, text]) => el("option", { value, selected: value === chosen ? "" : null }, text))));
}
/// Sentences: the first at once, the others behind a click, and on paper.
function findings_view(findings, at_once = 5) {
  const told = (list) => list.map((f) => el("p", {}, f)), rest = findings.slice(at_once);
  if (!rest.length) return el("div", { class: "verdict" }, told(findings));
  return el("div", { class: "verdict" }, told(findings.slice(0, at_once)), unfolded_on_paper(el("details", {}, el("summary", {}, many(rest.length, "more finding")), told(rest))));
}
/// Cells that say what they are of, where a table has no room for its head.  \param names  of the columns
function name_cells(table, names) {
  for (const row of table.tBodies[0].rows) [...row.cells].forEach((cell, k) => k && cell.setAttribute("data-of", names[k]));
  return table;
}
/// A table of words whose rows become cards where there is little room: each cell then tells what it is of.
function told_by_cell(head, list, classes) {
  const names = head.map((h) => h?.n ?? h);
  return el("div", { class: "told-by-cell" }, name_cells(table(head, list, { row_class: classes }), names));
}
/// A table of numbers whose rows become cards where there is little room.  \param names  of its columns, where its head does not name them
function in_cards(t, names = [...t.tHead.rows[0].cells].map((c) => c.textContent)) {
  return el("div", { class: "scroll in-cards" }, name_cells(t, names));
}
/// A place whose content is made again whenever a choice changes.
/// \param paper  makes what of the other choices is printed beside the chosen one; made when that happens   \param columns  of it
function changing(make, paper, columns) {
  const chosen = el("div", {}), node = paper ? el("div", {}, chosen, on_paper(paper, columns)) : chosen;
  const again = () => chosen.replaceChildren(...[make()].flat());
  again();
  return { node, again };
}
/// What is printed and not shown.  \param columns  of pictures beside each other
function on_paper(make, columns = 3) {
  const node = el("div", { class: "paper" }), page = 700;
  addEventListener("beforeprint", () => {
    paper_width = Math.floor(page / columns) - 16;
    node.replaceChildren(...[make()].flat(Infinity).filter(Boolean));
    paper_width = 0;
  });
  addEventListener("afterprint", () => node.replaceChildren());
  return node;
}
/// Pictures of all choices beside each other, small.
const small_pictures = (list, view = (f) => figure_view(f, { bare: true, height: 190 })) => el("div", { class: "panels small-ones" }, list.map(view));

const group_by = (list, key) => list.reduce((groups, x) => {
  const k = key(x);
  groups.get(k)?.push(x) ?? groups.set(k, [x]);
  return groups;
}, new Map());
const unique = (list) => [...new Set(list)];
// What a link leads to is made by this script, after the browser has looked for it.
addEventListener("load", () => location.hash && document.getElementById(decodeURIComponent(location.hash.slice(1)))?.scrollIntoView());

/// Way back to the page of all reports, where this one was made beside it.
const way_back = () => ("index" in document.documentElement.dataset ? [el("a", { href: "index.html" }, "All reports"), " · "] : null);
/// The page of a report: the first sentences and the picture that shows them, then its sections.
/// \param o  {command, title, findings, first: that picture, wide: whether it needs the width of the page, sections: nodes, or null of what
///           there is not, setting: what is said at its end}
function show_report(o) {
  const sections = o.sections.filter(Boolean), [answer, ...rest] = o.findings;
  document.getElementById("page").replaceChildren(
    el("header", {}, el("p", { class: "over" }, way_back(), `gonio ${o.command}`), el("h1", {}, o.title), contents(sections)),
    el("div", { class: o.wide ? "opening wide" : "opening" },
      answer ? el("p", { class: "verdict answer" }, answer) : null, o.first ?? null, rest.length ? findings_view(rest, 3) : null),
    ...sections, el("footer", {}, o.setting));
}
