"use strict";
// What every page uses: its data, elements, numbers as people write them, the colour scheme.

const page_data = () => JSON.parse(document.getElementById("page-data").textContent);

/// el("p", {class: "small"}, "text", node, …); null children are left out.  Text is never parsed.
function el(tag, attributes = {}, ...children) {
  const svg = ["svg", "line", "circle", "path", "text", "rect"].includes(tag);
  const node = svg ? document.createElementNS("http://www.w3.org/2000/svg", tag)
                   : document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else if (name === "style") for (const [k, v] of Object.entries(value)) node.style.setProperty(k, v);
    else if (value !== null && value !== undefined) node.setAttribute(name, value);
  }
  node.append(...children.flat(Infinity).filter((c) => c !== null && c !== undefined));
  return node;
}

/// Anchor of a title: its words in small letters.
const anchor_of = (title) => title.toLowerCase().replace(/[^\p{L}\p{N}]+/gu, "-").replace(/^-|-$/g, "");
const section = (title, lead, ...rest) =>
  el("section", { id: anchor_of(title) }, el("h2", {}, title), lead ? el("p", {}, lead) : null, ...rest);
/// Links to the sections of a page.
const contents = (sections) => el("nav", { class: "contents", "aria-label": "Contents" },
  sections.map((s) => [s, s.querySelector("h2")]).filter(([s, title]) => s.id && title).map(([s, title]) => el("a", { href: `#${s.id}` }, title.textContent)));
const scroll = (node) => el("div", { class: "scroll" }, node);

/// [["term", value…], …] with null values left out
const pairs = (list) => el("dl", { class: "pairs" },
  list.filter(([, value]) => value !== null && value !== undefined)
      .map(([term, value]) => [el("dt", {}, term), el("dd", {}, value)]));

/// Rows of cells; a cell is text, a node, or {n: …} for a number set right.
function table(head, rows, { caption = null, row_class = () => null } = {}) {
  const cell = (tag, c, scope) => c !== null && typeof c === "object" && "n" in c
    ? el(tag, { class: "n", scope }, c.n) : el(tag, { scope }, c ?? "–");
  return el("table", {}, caption ? el("caption", {}, caption) : null,
    el("thead", {}, el("tr", {}, head.map((c) => cell("th", c, "col")))),
    el("tbody", {}, rows.map((row, i) => el("tr", { class: row_class(i) },
      row.map((c, k) => cell(k === 0 ? "th" : "td", c, k === 0 ? "row" : null))))));
}

// --- Numbers -----------------------------------------------------------------------------------
const known = (x) => typeof x === "number" && Number.isFinite(x);
const list_of = (x) => (Array.isArray(x) ? x : [x]);
const minus = (s) => s.replace("-", "−");
const superscript = (n) => [...String(n)].map((c) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[c] ?? "⁻").join("");

/// x to `digits` significant digits: 0.0312, 1 230, 4.1·10⁻⁶
function significant(x, digits = 3) {
  if (!known(x)) return "–";
  if (x === 0) return "0";
  const power = Math.floor(Math.log10(Math.abs(Number(x.toPrecision(digits)))));
  if (power < -4 || power > 6)
    return minus((x / 10 ** power).toFixed(digits - 1)) + "·10" + superscript(power);
  return minus(x.toFixed(Math.max(0, digits - 1 - power))).replace(/^\d{5,}$/, count);
}
/// Shortest text of a number within `digits` significant digits: 15, 0.04
const plain = (x, digits = 6) => (known(x) ? minus(String(Number(x.toPrecision(digits)))) : "–");
/// x to the digit that the second of its error stands at
function decimals_for(error) {
  if (!known(error) || error <= 0) return null;
  return Math.min(12, Math.max(0, 1 - Math.floor(Math.log10(Number(error.toPrecision(2))))));
}
function with_error(x, error) {
  const decimals = decimals_for(error);
  return decimals === null || !known(x) ? plain(x) : minus(x.toFixed(decimals));
}
const count = (n) => String(n).replace(/\B(?=(\d{3})+$)/g, "\u202f");
const many = (n, thing) => `${count(n)} ${thing}${n === 1 ? "" : "s"}`;
const percent = (x, digits = 2) => significant(100 * x, digits) + "\u202f%";
const signed_percent = (x) => (x > 0 ? "+" : "") + percent(x);
/// ln of a ratio as people say it: ×1.05, or ÷1.05 where it is below one
function ratio(ln) {
  if (!known(ln)) return "–";
  const f = Math.exp(Math.abs(ln));
  const text = f < 10 ? f.toFixed(f < 1.1 ? 3 : 2) : significant(f);
  return Number(text) === 1 ? "×1" : (ln < 0 ? "÷" : "×") + text;
}
/// Whether a log RMS is one of a model that is near its table, where nothing better tells.
const fits_well = (log_rms) => log_rms <= 0.25;
const degrees = (x, digits = 1) => (known(x) ? minus(String(Number(x.toFixed(digits)))) + "°" : "–");
const milliseconds = (t) => (t >= 1000 ? significant(t / 1000) + "\u202fs" : significant(t) + "\u202fms");
/// theta_i as θ with its index below
const angle_name = (name) => (/^theta_.$/.test(name) ? el("span", {}, "θ", el("sub", {}, name.at(-1))) : name);
const words = (name) => name.replaceAll("_", " ");
/// Words for how far a fitted parameter is known.
const status_words = { free: "fitted", fixed: "held", at_bound: "at the end of its range", not_identifiable: "not known",
                       upper_limit: "upper limit alone", lower_limit: "lower limit alone" };
const limit_text = (status, limit) => `${status === "upper_limit" ? "≤" : "≥"}\u202f${significant(limit, 3)}`;

/// A sentence with its angles as signs.
const with_angles = (text) => text.split(/(theta_[hdio])/).map((part, i) => (i % 2 ? angle_name(part) : part));
/// A sentence whose options of the program, with what they are given, stand out.
const with_code = (text) => text.split(/(--[a-z-]+(?: [^ ,;:]*[a-z0-9])?)/).map((part, i) => (i % 2 ? el("code", {}, part) : part));

// --- Colours -----------------------------------------------------------------------------------
const color = (name) => getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim();
/// Colour of a channel by its name, else by its place; told apart by people who see fewer colours too.
function channel_color(name, index) {
  const named = { r: "red", g: "green", b: "blue", f: "accent" };
  return named[name] ?? ["accent", "red", "green", "extra", "grey"][index % 5];
}
const chip = (name) => el("span", { class: "chip", style: { background: `var(--${name})` } });

/// Calls back whenever what is drawn must be drawn in other colours: the scheme changed, or paper.
const recolor = [];
function when_colors_change(draw) { if (!paper_width) recolor.push(draw); }
const redraw_all = () => recolor.forEach((draw) => draw());
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw_all);
addEventListener("beforeprint", () => { document.documentElement.dataset.paper = ""; redraw_all(); });
addEventListener("afterprint", () => { delete document.documentElement.dataset.paper; redraw_all(); });

/// A fold that paper opens.
function unfolded_on_paper(details) {
  addEventListener("beforeprint", () => { details.open = true; });
  return details;
}

/// Width in pixels that pictures are drawn at while what is for paper alone is made, and is not laid out yet; else 0.
let paper_width = 0;
/// Draws now that it has a width, and whenever that changes.
function when_resized(node, draw) {
  if (paper_width) return draw(paper_width);
  let width = 0;
  const look = () => {
    const now = Math.floor(node.clientWidth);
    if (now > 0 && now !== width) { width = now; draw(now); }
  };
  new ResizeObserver(() => requestAnimationFrame(look)).observe(node);
}

/// One of several words, pressed.
function choice(label, options, chosen, change) {
  const buttons = options.map(([value, text]) => el("button", {
    type: "button", "aria-pressed": String(value === chosen),
    onclick: () => {
      buttons.forEach((b, i) => b.setAttribute("aria-pressed", String(options[i][0] === value)));
      change(value);
    },
  }, text));
  return el("span", { class: "switch", role: "group", "aria-label": label }, buttons);
}
