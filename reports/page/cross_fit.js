"use strict";
// The cross fit report: what fits with shipped forms make of roughness, F0 and gamma.

const { findings, full } = page_data();

document.getElementById("page").replaceChildren(
  el("p", { class: "over" }, "gonio report cross_fit"), el("h1", {}, "What fits with shipped approximations make of roughness, F0 and gamma"),
  el("div", { class: "verdict" }, findings.map((f) => el("p", {}, f))),
  el("footer", {}, `${full ? "Full" : "Quick"} setting. Every figure of this page is in its data block and in the .json beside it.`));
