"use strict";
// Models compared on a table: which to take, how near and how fast each is, and what each makes of the table.

const page = page_data(), { choice: advice, figures } = page;
const at_once = 6;  // models that are drawn before a reader asks for more
const models = advice.models.map((m, k) => ({ ...m, name: page.names[k], number: page.numbers[k],
  recommended: m.model === advice.recommended, as_good: advice.as_good.includes(m.model) }));
const compared = models.filter((m) => m.number > 0).sort((a, b) => a.number - b.number);
const taken = compared.find((m) => m.recommended), left_out = models.filter((m) => m.number === 0);
const predicted = advice.blocks > 0, file_name = advice.input.path.split("/").pop();
const capital = (text) => text[0].toUpperCase() + text.slice(1);
const in_a_row = (list) => (list.length > 1 ? `${list.slice(0, -1).join(", ")} and ${list.at(-1)}` : list[0] ?? "");
/// A spec that breaks between its parts.
const spec_code = (spec) => el("code", {}, spec.split(/(?<=[+/])/).flatMap((part) => [part, el("wbr")]));
const value_of = (m) => (predicted ? m.cv_log_rms : m.log_rms);
/// The recommended one and the nearest others, nearest first.
const first_few = compared.filter((m) => m.recommended || m.number <= at_once - (taken.number > at_once)).map((m) => m.number);

/// A sentence of the document, its specs as names; of the recommended one, which has just been named, "this model".
function in_words(text) {
  const specs = unique(models.map((m) => m.model)).sort((a, b) => b.length - a.length).map((s) => s.replace(/[.*+?^${}()|[\]\\]/g, "\\$&"));
  return capital(text.replace(new RegExp(`(?<![\\w.+/])(${specs.join("|")})(?![\\w+/]|\\.\\w)`, "g"),
    (spec) => (spec === advice.recommended ? "this model" : models.find((m) => m.model === spec).name)));
}

// --- What it says at the top ---------------------------------------------------------------------
function verdict() {
  const factor = ratio(value_of(taken)).slice(1), where = predicted ? " there" : "";
  const alike = models.filter((m) => m.as_good).map((m) => m.name);
  return el("div", { class: "verdict" },
    el("p", {}, "Take ", el("b", {}, taken.name), ": ", spec_code(taken.model), "."), el("p", {}, in_words(advice.reason)),
    el("p", {}, `Typically model and table differ by a factor of ${factor}${where}.`),
    alike.length ? el("p", {}, `The table cannot tell it from ${in_a_row(alike)}.`) : null,
    advice.disagreement.map((d) => el("p", {}, in_words(d))));
}
function warnings() {
  const out = [], warn = (what, text) => out.push(el("li", {}, el("b", {}, what), " ", text));
  if (!taken.converged) warn("Not converged:", `the fit of ${taken.name}.`);
  for (const text of advice.beware) warn("Beware:", in_words(text));
  if (left_out.length) warn("Not compared:", `${in_a_row(left_out.map((m) => m.name))}. The list of models says why.`);
  return out.length ? el("ul", { class: "warnings", "aria-label": "Warnings" }, out) : null;
}

// --- Error against time ----------------------------------------------------------------------------
function error_and_time() {
  const figure = figures.find((f) => f.id === "error_and_time");
  return section("How near, and how fast", "Each point is a model, with its number in the list below. Further down is nearer to the table, further left is faster. "
    + "The dashed line is the front: no model is faster, by more than both times vary, and as near. "
    + (predicted ? "Nearness is judged on incident angles that the fit had not seen." : "The table has too few incident angles to leave some out: nearness is that over the angles fitted."),
    figure_view(figure, { height: 380 }));
}

// --- The models --------------------------------------------------------------------------------------
function list_of_models() {
  const with_sphere = compared.some((m) => known(m.delta_e_2000));
  const number = (x, text) => ({ n: known(x) ? text(x) : "–" });
  const head = ["model", ...(predicted ? [{ n: "unseen" }] : []), { n: "log RMS" }, { n: "BIC" }, ...(with_sphere ? [{ n: "ΔE2000" }] : []), { n: "time [ns]" }, { n: "free" }, "at the end of its range"];
  const row = (m) => [
    el("span", {}, m.number ? `${m.number}\u2002` : "", m.name,
      m.recommended ? el("span", { class: "verdict-yes" }, "\u2002recommended") : m.as_good ? el("span", { class: "muted" }, "\u2002as good") : null,
      el("small", {}, spec_code(m.model)), m.note ? el("small", { class: "told" }, capital(m.note) + ".") : null),
    ...(predicted ? [number(m.cv_log_rms, (x) => significant(x, 3))] : []), number(m.log_rms, (x) => significant(x, 3)),
    number(m.bic, (x) => minus(count(Math.round(x)))), ...(with_sphere ? [number(m.delta_e_2000, delta_e)] : []),
    number(m.ns, (x) => significant(x, 2)), { n: m.number ? String(m.parameters) : "–" }, m.parameters_at_bound.join(", ") || "none"];
  const list = [...compared, ...left_out];
  const node = section("The models", `The nearest first${predicted ? ", on angles that the fit had not seen" : ", over the angles fitted"}. `,
    told_by_cell(head, list.map(row), (i) => (list[i].recommended ? "chosen" : null)));
  node.querySelector("p").append(el("a", { href: "#words" }, "What the words mean"));
  node.id = "models";
  return node;
}

// --- Curves -----------------------------------------------------------------------------------------
const curves_family = "curves", data_name = "data";
function curves() {
  const channels = choices_of(figures, curves_family, "channel");
  if (!channels.length) return section("Data and models", "No valid sample lies in the plane of incidence: there is no curve to draw.");
  const state = { channel: channels[0], all: false, log: true };
  const shown = (c) => c.name === data_name || state.all || first_few.includes(Number(c.name));
  const key = (c) => el("span", {}, line_key(line_style(c), c.kind), " ", c.name === data_name ? "table" : `${c.name}\u2002${compared[c.name - 1].name}`);
  const drawn = changing(() => {
    const list = figures.filter((f) => f.family === curves_family && f.choices.channel === state.channel);
    return [el("div", { class: "small keys", style: { "margin-bottom": "12px" } }, list[0].curves.filter(shown).map(key)),
      el("div", { class: "panels" }, list.map((f) => figure_view({ ...f, y: { ...f.y, log: state.log && Boolean(f.y.scales.log) } }, { height: 250, only: shown, bare: true })))];
  });
  const set = (key) => (value) => { state[key] = value; drawn.again(); };
  const node = section("Data and models", "Points are the table's samples, lines the fitted models by their numbers, without the cosine. A line that leaves the picture goes on beyond what the table has.",
    el("div", { class: "controls" },
      choice("Scale of f_r", [[true, "logarithmic"], [false, "linear"]], true, set("log")),
      channels.length > 1 ? choice("Channel", channels.map((c) => [c, c]), state.channel, set("channel")) : null,
      compared.length > first_few.length ? choice("Models", [[false, `the nearest ${first_few.length}`], [true, `all ${compared.length}`]], false, set("all")) : null),
    drawn.node);
  return node;
}

// --- Spheres ----------------------------------------------------------------------------------------
/// The spheres with names for specs, nearest model first.
function named_spheres() {
  const asked = models.filter((m) => m.number > 0), place = compared.map((m) => asked.indexOf(m));
  return { ...page.spheres, models: compared.map((m) => m.name),
    lights: page.spheres.lights.map((l) => ({ ...l, models: l.models.length ? place.map((k) => l.models[k]) : [] })) };
}

// --- Input and words ----------------------------------------------------------------------------------
function input() {
  const i = advice.input;
  return section("Input, and how it was judged", null, pairs([
    ["file", el("code", {}, i.path)], ["SHA-256", el("code", {}, i.sha256)], ["format", i.format], ["metric of the fits", words(advice.metric)],
    ["left out in turn", predicted ? `${many(advice.blocks, "block")} of neighbouring incident angles` : "nothing: the table has too few incident angles"],
    ["values", known(advice.effective_values) ? `worth ${count(Math.round(advice.effective_values))} independent ones, which AIC and BIC count` : null],
    ["fit it alone", el("code", {}, `gonio fit ${file_name} --model ${taken.model} -o fit.json --html fit.html`)]]));
}
function meanings() {
  const node = section("What the words mean", null, pairs([
    ["log RMS", "typical size of ln f − ln y, model over table: 0.1 is a factor of 1.1"],
    ["unseen", "log RMS on incident angles that were left out of the fit. It grows where a model has more parameters than the table can tell"],
    ["cannot be told", "at most 5 % more of it than the best model and within two standard errors over the blocks, or 0.1 % more"],
    ["BIC", "a judge of the fit to the whole table that asks a price for each free value; less is better, and only differences count"],
    ["ΔE2000", "difference of colour between a sphere of the table and one of the model: half of the pixels are within it, as a mean of three lights. Above 1 it is seen side by side"],
    ["time", "of one sample in all channels, in float, on this machine"],
    ["free", "values that were fitted, those of each channel counted"],
    ["at the end of its range", "a parameter that the data push beyond what it may be: the model lacks something"],
    ["front", "models that no other beats: none is faster, by more than both times vary, and as near"]]));
  node.id = "words";
  return node;
}

document.getElementById("page").replaceChildren(...[
  el("p", { class: "over" }, "gonio fit --models"), el("h1", {}, `Which model for ${file_name}`),
  verdict(), warnings(), error_and_time(), list_of_models(), curves(), spheres_section(named_spheres(), null, at_once), input(), meanings(),
  el("footer", {}, "f_r is in 1/sr, without the cosine. Every figure of this page is in its data block. Plots drawn with uPlot, © Leon Sorokin, MIT licence."),
].filter(Boolean));
