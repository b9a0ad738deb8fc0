"use strict";
// What the page of models uses beside its pictures.

/// A list to choose from; changes are told.
function chooser(label, options, chosen, change) {
  return el("label", {}, label + " ", el("select", { onchange: (e) => change(e.target.value) },
    options.map(([value, text]) => el("option", { value, selected: value === chosen ? "" : null }, text))));
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

const unique = (list) => [...new Set(list)];
