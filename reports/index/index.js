"use strict";
// The page that leads to all reports.

const { version, full, at_ms, questions, reports, claims } = page_data();
const page_of = (report, anchor) => `${report}.html${anchor ? "#" + anchor : ""}`;
const sentence = (text) => text[0].toUpperCase() + text.slice(1);

function answers() {
  if (!questions.length) return null;
  return section("Questions", null, el("dl", { class: "questions" }, questions.map((q) =>
    [el("dt", {}, el("a", { href: page_of(q.report, q.anchor) }, q.question)), el("dd", {}, q.answer)])));
}

const findings = () => reports.map((r) => section(sentence(r.what), null,
  el("p", { class: "small" }, el("a", { href: page_of(r.name) }, el("b", {}, "the report")), " · ", el("a", { href: `${r.name}.json` }, "JSON"), " · ", el("a", { href: `${r.name}.csv` }, "CSV"), " · ",
    el("a", { href: `${r.name}/` }, many(r.pictures, "picture")), el("span", { class: "muted" }, ` · made in ${milliseconds(r.time_ms)}`)),
  el("ul", { class: "findings" }, r.findings.map((f) => el("li", {}, f))),
  r.more ? el("p", { class: "small" }, el("a", { href: page_of(r.name) }, "More findings")) : null));

/// Grouped by report, a line above each.
function claim_table(list, classes) {
  const t = table(["", "claim", "verdict"], list.map((c) => [el("span", { class: `verdict-${classes[c.judged]}` }, c.judged),
    el("span", { class: "because" }, el("a", { href: page_of(c.report, c.anchor) }, c.claim), el("small", {}, c.source)), el("span", { class: "because" }, c.verdict)]),
  { row_class: (i) => (list[i].report !== list[i - 1]?.report ? "first" : null) });
  t.classList.add("claims");
  return t;
}
function verdicts() {
  if (!claims.length) return null;
  const classes = { "holds": "yes", "holds in part": "weakly", "does not hold": "no" };
  return section("Claims and verdicts", "Statements in circulation, as they stand in papers, talks and shaders, and what the figures say of them. Seeds are the documents that describe the shipped forms, by their numbers in gonio audit.",
    scroll(claim_table([...group_by(claims, (c) => c.report)].flatMap(([, list]) => list), classes)));
}

document.getElementById("page").replaceChildren(...[
  el("p", { class: "over" }, "gonio report all"), el("h1", {}, "What approximations lose, and what they cost"),
  answers(), ...findings(), verdicts(),
  el("footer", {}, `gonio ${version}, ${full ? "full" : "quick"} setting, made ${new Date(at_ms).toISOString().slice(0, 16).replace("T", " ")} UTC. All of this page is in index.json beside it.`)].filter(Boolean));
