"use strict";
// A validation: each budget, the worst that was found, and where.

const told = page_data(), broken = told.budgets.filter((b) => !b.holds);
const evidence = { proved: "proved for every input", exhaustive: "every input looked at", searched: "searched: there may be worse", counted: "counted", measured: "measured here" };

function verdict() {
  const lines = broken.length === 0 ? ["The choice keeps every budget."] : [`The choice breaks ${broken.length} of ${many(told.budgets.length, "budget")}.`];
  for (const b of broken.slice(0, 3)) lines.push(b.sentence);
  if (told.budgets.some((b) => b.budget === "reciprocity") && told.budgets.some((b) => b.budget === "energy_loss"))
    lines.push("A compensation that gives back all light for each view may change where light and view change places: the two budgets can conflict.");
  return el("div", { class: "verdict" }, lines.map((l) => el("p", {}, l)));
}

document.getElementById("page").replaceChildren(...[
  el("p", { class: "over" }, "gonio validate"), el("h1", {}, broken.length ? "Not yet" : "Ready to ship"), verdict(),
  section("Budgets", "The worst of each in the choice's domain.",
    told_by_cell(["budget", "kept", { n: "found" }, { n: "allowed" }, "at", "evidence"],
      told.budgets.map((b) => [b.title, el("span", { class: b.holds ? "verdict-yes" : "verdict-no" }, b.holds ? "yes" : "no"), { n: b.found_text }, { n: b.limit_text },
        b.place || "–", el("span", { class: "muted" }, b.words || evidence[b.evidence])]))),
  told.figures.length ? section("Light that comes back", "Of a uniform white sky, by the view.", ...told.figures.map((f) => figure_view(f))) : null,
  told.suggestion ? section("The cheapest that keeps every budget", null, el("p", {}, el("code", {}, told.suggestion.model), told.suggestion.scattering === "single" ? "." : ` with ${words(told.suggestion.scattering)}.`, " ", told.suggestion.why)) : null,
  section("The choice", null, pairs([["model", el("code", {}, told.model)], ["scattering", words(told.scattering)], ["number", told.number],
    ["reference", told.reference ? el("code", {}, told.reference) : null], ["file", el("code", {}, told.choice)]])),
  el("footer", {}, "Albedos and colours are of the formula in double; what the number loses is told by the budget of inputs without a value, and by gonio stability."),
].filter(Boolean));
