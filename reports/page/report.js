"use strict";
// What the pages of the reports share, beside their pictures.

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
// What a link leads to is made by this script, after the browser has looked for it.
addEventListener("load", () => location.hash && document.getElementById(decodeURIComponent(location.hash.slice(1)))?.scrollIntoView());
