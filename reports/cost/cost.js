"use strict";
// The cost report: what accuracy costs in time.

const { rows, switches, sampling, lookups, shaders, points, figures, machine, findings, full, repetitions, processes, others_busy, cache_samples, stream_samples } = page_data();
const best = machine.instruction_sets.at(-1);
const short = (id) => id.replace(/^(ndf|masking|fresnel|diffuse|model|bound)\./, "");
const long_columns = `columns of ${plain(stream_samples * 4 / (1 << 20), 3)} MiB`;  // of floats: of doubles twice that
const memory_text = { cache: "in cache", streaming: long_columns };
/// To the first digit of the spread, or to picoseconds.
function ns_text(ns, spread) {
  const decimals = Math.min(3, Math.max(0, -Math.floor(Math.log10(Math.max(spread, 1e-3)))));
  return minus(`${ns.toFixed(decimals)} ± ${spread.toFixed(decimals)}`);
}
const error_text = (e) => (known(e) ? significant(e, 2) : "–");
const places = unique(rows.map((r) => [r.isa, r.memory].join(" "))).map((p) => p.split(" "));
const at_first = () => ({ number: "float", place: [best, "cache"].join(" ") });  // of each section its own
const at_best = { number: "float", set: best, memory: "cache" };
const place_options = places.map(([isa, memory]) => [[isa, memory].join(" "), `${isa}, ${memory_text[memory]}`]);

/// Tables of the other number, for paper.
function other_number(chosen, make) {
  const now = chosen.number;
  chosen.number = now === "float" ? "double" : "float";
  const made = [el("h3", {}, `In ${chosen.number}`), make()];
  chosen.number = now;
  return made;
}

// --- What it costs to switch ---------------------------------------------------------------------------
const signed = (x, text) => (x > 0 ? "+" : x < 0 ? "−" : "±") + text(Math.abs(x));
function switch_cells(s) {
  if (!s) return [{ n: "–" }, { n: "–" }];
    return [{ n: (s.more_ns > 0 ? "+" : "") + ns_text(s.more_ns, s.more_spread_ns) }, { n: s.differs ? `×${significant(s.ratio_ns, 2)}` : "a tie" }];
}
function what_it_costs() {
  const chosen = at_first();
  const of = (question, isa, memory) => switches.find((s) => s.question === question && s.isa === isa && s.memory === memory && s.number === chosen.number);
  const questions = unique(switches.map((s) => s.question));
  const of_number = () => in_cards(table(["from, to", { n: `${best}, in cache [ns]` }, { n: "" }, { n: `${best}, ${long_columns} [ns]` }, { n: "" }, { n: "a 1080p frame [ms]" }, { n: "operations" }, { n: "RMS error from" }, { n: "to" }],
    questions.map((q) => {
      const s = of(q, best, "cache") ?? switches.find((x) => x.question === q);
      return [el("span", { style: { display: "inline-block", "min-width": "9em", "white-space": "normal" } }, q + (s.way ? `, ${s.way}` : "")), ...switch_cells(of(q, best, "cache")), ...switch_cells(of(q, best, "streaming")), { n: s.differs ? signed(s.frame_ms, (x) => significant(x, 2)) : "a tie" }, { n: signed(s.more_ops, plain) }, { n: error_text(s.error_from) }, { n: error_text(s.error_to) }];
    })), ["", ...[`${best}, in cache [ns]`, `${best}, ${long_columns} [ns]`].flatMap((name) => [name, ""]), "a 1080p frame [ms]", "operations", "RMS error from", "to"]);
  const list = changing(of_number, () => other_number(chosen, of_number));
  const node = section("What does it cost to switch?", `What one sample takes more, with the spread between processes, and how many times as long it takes; what is not there in every process is a tie. A frame is one sample each pixel in cache, on one processor. In ${long_columns}, memory hides what is computed while it waits. `
    + "Terms are timed as a model uses them: D leaves a fraction, masking divides it, Fresnel and diffuse terms are added up; operations are those of the term alone, its division included.",
    el("div", { class: "controls" }, choice("Number", [["float", "float"], ["double", "double"]], chosen.number, (n) => { chosen.number = n; list.again(); })), list.node);
  node.id = "switches";  // a question of the index leads here
  return node;
}

const by_twos = (list) => el("div", {}, list.map((f, i) => (i % 2 ? null : el("div", { class: "columns", style: { "margin-top": "22px" } }, list.slice(i, i + 2).map((one) => figure_view(one, { height: 400 }))))));

// --- Time against error --------------------------------------------------------------------------------
function pictures() {
  const families = unique(figures.filter((f) => f.choices?.set).map((f) => f.family));
  if (!families.length) return null;
  const state = { number: "float", place: `${best} cache` };
  const offered = unique(figures.filter((f) => f.choices?.set).map((f) => `${f.choices.set} ${f.choices.memory}`));
  const all = changing(() => {
    const [set, memory] = state.place.split(" ");
    return by_twos(families.map((family) => picture_of(figures, family, { number: state.number, set, memory })).filter(Boolean));
  }, () => small_pictures(figures.filter((f) => f.choices?.set && f.choices.number === state.number && `${f.choices.set} ${f.choices.memory}` !== state.place)));
  return section("Time against error", "Each point is a form; further left is faster, further down is more exact. The line joins those that nothing dominates: nothing that is as exact is faster in every process that measured. What ties with a better form is not on it. "
    + "What has no error in double is drawn at 10⁻¹⁷. Masking is held against Smith of its distribution, height-correlated; Fresnel terms against the exact form that they stand for; whole models against correlated Smith "
    + "and exact Fresnel of glass and gold, of what stands for one alone of that one, under their own distribution, roughness 0.1 to 1.",
    el("div", { class: "controls" }, choice("Number", [["float", "float"], ["double", "double"]], state.number, (n) => { state.number = n; all.again(); }),
      choice("Place", offered.map((p) => [p, p.replace(" cache", ", in cache").replace(" streaming", `, ${long_columns}`)]), state.place, (p) => { state.place = p; all.again(); })), all.node,
    by_twos(figures.filter((f) => !f.choices?.set && f.family !== "quadrature")), quadrature());
}
function quadrature() {
  const cases = choices_of(figures, "quadrature", "case");
  if (!cases.length) return null;
  let now = cases.find((c) => c.includes("0.5")) ?? cases[0];
  const one = changing(() => figure_view(picture_of(figures, "quadrature", { case: now }), { height: 400 }), () => small_pictures(figures.filter((f) => f.family === "quadrature" && f.choices.case !== now)));
  return el("div", {}, el("div", { class: "controls" }, chooser("Albedo of", cases.map((c) => [c, c]), now, (c) => { now = c; one.again(); })), one.node);
}

// --- Whole models --------------------------------------------------------------------------------------
function whole_models() {
  const chosen = at_first();
  const ids = unique(rows.filter((r) => r.kind === "model").map((r) => r.id));
  const of = (id, way, isa, memory) => rows.find((r) => r.id === id && r.way === way && r.isa === isa && r.memory === memory && r.number === chosen.number);
  const text = (r) => ({ n: r ? ns_text(r.ns, r.ns_spread) : "–" });
  const bounds = (memory) => rows.filter((r) => r.kind === "bound" && r.isa === best && r.memory === memory && r.number === chosen.number);
  const names = { "bound.columns": "four columns read and one written", "bound.roots_and_division": "a division and two roots" };
  const times = (a, b) => ({ n: a && b ? `×${significant(a.ns / b.ns, 3)}` : "" });
  const of_number = () => in_cards(table(["model", { n: "channels" }, { n: "by hand [ns]" }, { n: "fused [ns]" }, { n: "over by hand" }, { n: "composed [ns]" }, { n: "over by hand" }, { n: `${long_columns}: by hand [ns]` }, { n: "fused [ns]" }, { n: "composed [ns]" }],
    ids.map((id) => {
      const [hand, fused, composed] = ["by_hand", "fused", "composed"].map((way) => of(id, way, best, "cache"));
      return [el("code", {}, short(id)), { n: String(composed.channels) }, text(hand), text(fused), times(fused, hand), text(composed), times(composed, hand), ...["by_hand", "fused", "composed"].map((way) => text(of(id, way, best, "streaming")))];
    }).concat(bounds("cache").map((r) => [names[r.id], { n: "" }, text(r), { n: "" }, { n: "" }, { n: "" }, { n: "" }, text(bounds("streaming").find((b) => b.id === r.id)), { n: "" }, { n: "" }]))));
  const list = changing(of_number, () => other_number(chosen, of_number));
  return section("Whole models, and what bounds them", `In columns of ${best}: written out by hand for that model alone, as the terms of the catalogue fused into one loop, and composed of the columns of its terms at run time; `
    + "beside them what the arithmetic and the memory allow, measured in the same run. Models that ship are evaluated in three channels.",
    el("div", { class: "controls" }, choice("Number", [["float", "float"], ["double", "double"]], chosen.number, (n) => { chosen.number = n; list.again(); })), list.node);
}

// --- Every entry ---------------------------------------------------------------------------------------
function every_entry() {
  const chosen = at_first();
  const in_place = (list) => list.filter((r) => r.number === chosen.number && [r.isa, r.memory].join(" ") === chosen.place);
  const of_number = () => in_cards(table(["", "kind", { n: "channels" }, { n: "time [ns]" }, { n: "operations" }, { n: "of the parameters" }, { n: "divisions" }, { n: "roots" }, { n: "exp, log" }, { n: "table [bytes]" }, { n: "largest error" }, { n: "RMS" }, { n: "ΔE2000 of gold" }, "of", "against", "front"],
    in_place(rows).filter((r) => !["bound", "by_hand", "sampling", "split_sum"].includes(r.kind)).map((r) => [r.way ? el("code", {}, `${short(r.id)}, ${r.way}`) : form_cell(r.id), r.kind, { n: String(r.channels) }, { n: ns_text(r.ns, r.ns_spread) }, { n: String(r.ops) }, { n: String(r.ops_block) }, { n: String(r.ops_div) }, { n: String(r.ops_sqrt) },
      { n: String(r.ops_exp + r.ops_log) }, { n: r.bytes ? count(r.bytes) : "" }, { n: error_text(r.error_max) }, { n: error_text(r.error_rms) }, { n: known(r.delta_e) ? significant(r.delta_e, 2) : "" },
      el("span", { class: "because small" }, r.measure), el("span", { class: "because small" }, named(r.truth)), r.pareto ? (r.tie ? "a tie" : "yes") : ""])));
  const list = changing(of_number, () => other_number(chosen, of_number));
  return section("Every entry", "Of one sample in all its channels; operations of the parameters, as a root of roughness, are made once per block here and hardly in these times: a shader whose roughness varies makes them for each sample. Errors are absolute: of terms over the directions and parameters that the audit looks at, D over its peak; of whole models as said above. On the front is what nothing of its kind, channels and truth dominates.",
    el("div", { class: "controls" }, choice("Number", [["float", "float"], ["double", "double"]], chosen.number, (n) => { chosen.number = n; list.again(); }),
      chooser("Place", place_options, chosen.place, (p) => { chosen.place = p; list.again(); })), list.node);
}

// --- Studies -------------------------------------------------------------------------------------------
const timed = (r) => ({ n: known(r.ns) ? ns_text(r.ns, r.ns_spread) : "–" });
function light_sampling() {
  if (!sampling.length) return null;
  const names = unique(sampling.map((r) => r.name)), places_of = unique(sampling.map((r) => `${r.roughness} ${r.mu}`));
  const at = (name, place) => sampling.find((r) => r.name === name && `${r.roughness} ${r.mu}` === place);
  const node = section("Light drawn for GGX", `One light and its weight, f NoL over its density at F = 1, in float columns of ${best} in cache. A sample's standard deviation is over E; the last columns are the time until the error is 1 % of E, variance at equal time, with the share of lights below the horizon.`,
    in_cards(table(["roughness, NoV", ...names.map((n) => ({ n: `${n}: σ` })), ...names.map((n) => ({ n: `${n} [µs to 1 %]` }))],
      places_of.map((p) => [p.replace(" ", ", "), ...names.map((n) => ({ n: significant(at(n, p).deviation, 2) })),
        ...names.map((n) => ({ n: known(at(n, p).to_percent_ms) ? `${significant(1000 * at(n, p).to_percent_ms, 2)} (${significant(100 * at(n, p).below, 2)} % below)` : "–" }))]).concat([["time of a sample [ns]", ...names.map((n) => timed(at(n, places_of[0]))), ...names.map(() => "")]]))));
  node.id = "sampling";
  return node;
}
function tables_and_formulas() {
  if (!lookups.length) return null;
  const node = section("Table or formula", `A and B of the split sum against quadrature, roughness from 0.05 and NoV from 1/32 on. Times are of float columns of ${best} in cache, where a table's texels are fetched one by one: a GPU has a unit for that, which this processor has not.`,
    in_cards(table(["", { n: "size [bytes]" }, { n: "fetched [bytes]" }, { n: "time [ns]" }, { n: "RMS of A" }, { n: "of B" }, { n: "of 0.04 A + B" }, { n: "of A + B" }, { n: "most" }],
      lookups.map((r) => [r.name, { n: r.bytes ? count(r.bytes) : "" }, { n: r.fetched ? count(r.fetched) : "" }, timed(r), ...["a_rms", "b_rms", "plastic_rms", "mirror_rms", "mirror_max"].map((k) => ({ n: error_text(r[k]) }))]))));
  node.id = "lookups";
  return node;
}

function as_shaders() {
  if (!shaders.length) return null;
  const compiled = shaders.some((r) => r.instructions);
  const of = (r, ...kinds) => ({ n: r.instructions ? count(kinds.reduce((sum, k) => sum + r.instructions[k], 0)) : "–" });
  const node = section("In a shader", "Each model as gonio shader writes it in GLSL, in float and three channels, all its parameters arguments. Operations are of the formula: what is shared counts once, what is done to a colour three times. "
    + (compiled ? "Instructions are of its SPIR-V after spirv-opt -O, without loads and copies; one on a colour counts once. One version of these compilers gives the same on every machine." : "Where glslangValidator and spirv-opt are on PATH, the instructions of its SPIR-V stand beside them."),
    in_cards(table(["model", { n: "operations" }, { n: "instructions" }, { n: "sums" }, { n: "products" }, { n: "divisions" }, { n: "roots" }, { n: "exp, log" }, { n: "choices" }],
      shaders.map((r) => [named(r.id) === r.id ? el("code", {}, short(r.id)) : form_cell(r.id), { n: count(r.ops) }, of(r, "add", "mul", "fma", "div", "sqrt", "exp", "log", "min_max", "compare", "select"), of(r, "add"), of(r, "mul", "fma"), of(r, "div"), of(r, "sqrt"), of(r, "exp", "log"), of(r, "min_max", "compare", "select")]))));
  node.id = "shaders";
  return node;
}

// --- The machine ---------------------------------------------------------------------------------------
function the_machine() {
  const size = (bytes) => (bytes >= 1 << 20 ? `${plain(bytes / (1 << 20))} MiB` : `${plain(bytes / 1024)} KiB`);
  return section("How it was measured", `${processes > 1 ? `Median over ${processes} processes, each of which measured everything in an order of its own, and as spread half the distance of the quartiles between them` : `Median of ${repetitions} repetitions in one process, and as spread half the distance of the quartiles: what differs from process to process is not in it`}. Kernels: the time of the thread. `
    + `In cache: ${count(cache_samples)} samples again and again; long columns: ${count(stream_samples)} samples, ${plain(stream_samples * 4 / (1 << 20))} MiB of floats each, of which a term reads and writes one to four and a model more: a last cache as large as that may hold them. `
    + "How columns lie to each other in memory matters in cache: each process measures three ways.",
    pairs([["processor", machine.cpu], ["threads", String(machine.threads)], ["other programs meanwhile", known(others_busy) ? `kept ${plain(others_busy, 2)} processors busy` : "not known"], ["arithmetic in half", machine.native_half ? "there, used by no kernel" : "none (AVX512-FP16): times are of float and double"], ["caches", machine.caches.map((c) => `L${c.level} ${size(c.bytes)}`).join(", ")],
      ["instruction sets", machine.instruction_sets.join(", ")], ["compiler", machine.compiler], ["flags", machine.flags]]));
}

const first = picture_of(figures, "masking", at_best) ?? figures[0];
show_report({
  command: "report cost", title: "What accuracy costs in time", findings, first: first && figure_view(first, { height: 360, copy: true }),
  sections: [what_it_costs(), pictures(), whole_models(), light_sampling(), tables_and_formulas(), as_shaders(), every_entry(), the_machine()],
  setting: full ? "Full setting." : "Quick setting; --full measures long columns in every instruction set, by more processes.",
});
