"use strict";
// The atlas of numerical stability: which alpha is safe in which number, what clamps save and cost.

const { rows, clamps, any_gpu, orders, figures, maps, findings, full } = page_data();
/// "GGX from NoH" of "ggx from NoH".
const spoken = (key) => key.replace(/^\S+/, named_short);
const given = { cross: "|n × h|²", cosine: "NoH alone", frame: "h in the frame", facet: "VoH", cosines: "NoL, NoV", directions: "two directions", turned: "two directions" };
const evidence_words = { exhaustive: "every input", searched: "search", proved: "proved", open: "open" };
const error_text = (x) => (known(x) ? (x >= 10 ? "×" + significant(x + 1, 2) : percent(x)) : "–");
const at_title = (r) => [r.inputs, r.inputs_hex].filter(Boolean).join("; ");
const worst = (r) => ({ n: el("span", { title: at_title(r) }, error_text(r.worst_rel)) });
const none_or = (n, title) => ({ n: n ? el("span", { title }, count(n)) : "none" });
const from = (r) => ({ n: !r.decides ? "–" : known(r.safe_from) ? significant(r.safe_from, 2) : "nowhere" });

most_shipped = ["ggx", "ggx.mobile", "beckmann", "gtr", "schlick", "smith_ggx.correlated"];

function dense(t) {
  const node = in_cards(t);
  node.classList.add("dense");
  return node;
}

// --- The question that people come with ----------------------------------------------------------------------------
function clamp_question() {
  const is_width = (r) => r.decides === "alpha" && r.id.startsWith("ndf.");
  const numbers = unique(rows.filter(is_width).map((r) => r.number));
  let number = numbers.includes("half") ? "half" : numbers[0];
  const of = (number) => dense(table(["distribution", "given", { n: "alpha from" }, { n: "worst" }, { n: "from 0.05 on" }, { n: "without a value" }, { n: "finite: proved from" }, "take instead", { n: "operations" }, "by"],
    rows.filter((r) => is_width(r) && r.number === number).map((r) => [form_cell(r.id), given[r.form], from(r), worst(r), { n: known(r.worst_rel_alpha_0_05) ? error_text(r.worst_rel_alpha_0_05) : "–" },
      none_or(r.nonfinite + r.overflow, r.nonfinite_at), { n: known(r.finite_from) ? significant(r.finite_from, 2) : "–" }, r.stable ? named(r.stable) : r.form === "cosine" ? `from ${given.cross}` : "–",
      { n: r.stable ? `${r.operations} → ${r.stable_operations}` : r.operations }, evidence_words[r.evidence]])));
  const body = changing(() => el("div", {}, el("div", { class: "controls" },
    choice("Number", numbers.map((n) => [n, n]), number, (n) => { number = n; body.again(); })), of(number)),
  () => numbers.filter((n) => n !== number).map((n) => [el("h3", {}, `In ${n}`), of(n)]));
  return section("Which alpha is safe", "From this alpha on every input that was looked at keeps the tolerance: 2 % in half and mixed numbers, 0.0001 in float, 10⁻¹⁰ in double. "
    + "Inputs count as exact: a NoH that is rounded to half on its way brings an error of its own, as ggx.mobile shows in mixed numbers. The worst input, also in bits, stands under the pointer. From 0.05 on: the worst from that alpha on, of what does not keep 2 % there.", body.node);
}

// --- Pictures -------------------------------------------------------------------------------------------------------
function by_alpha() {
  const numbers = choices_of(figures, "error_by_alpha", "number");
  if (!numbers.length) return null;
  let number = numbers[0], kind = choices_of(figures, "error_by_alpha", "kind")[0];
  const all = "all alike";
  let form = all;
  const panels = changing(() => {
    const kinds = choices_of(figures, "error_by_alpha", "kind", { number });
    if (!kinds.includes(kind)) kind = kinds[0];
    const figure = picture_of(figures, "error_by_alpha", { number, kind }), names = [all, ...figure.curves.filter((c) => !c.dashed).map((c) => c.name)];
    if (!names.includes(form)) form = all;
    return el("div", {}, el("div", { class: "controls" },
      choice("Number", numbers.map((n) => [n, n]), number, (n) => { number = n; panels.again(); }),
      choice("Kind", kinds.map((k) => [k, k]), kind, (k) => { kind = k; panels.again(); }),
      chooser("Form", names.map((n) => [n, n === all ? n : spoken(n)]), form, (f) => { form = f; panels.again(); })),
    figure_view(figure, { height: 380, emphasis: form === all ? undefined : form }));
  }, () => small_pictures(figures.filter((f) => f.family === "error_by_alpha" && !(f.choices.number === number && f.choices.kind === kind))));
  return section("How errors grow as surfaces get smooth", "The worst over all angles, at each alpha.", panels.node);
}
function error_maps() {
  const forms = choices_of(maps, "error", "form");
  if (!forms.length) return null;
  let form = forms.includes("ggx from NoH") ? "ggx from NoH" : forms[0], number = "half";
  const panels = changing(() => el("div", {}, el("div", { class: "controls" },
    chooser("Form", forms.map((f) => [f, spoken(f)]), form, (f) => { form = f; panels.again(); }),
    choice("Number", choices_of(maps, "error", "number", { form }).map((n) => [n, n]), number, (n) => { number = n; panels.again(); })),
  map_view(picture_of(maps, "error", { form, number }), { value_text: error_text })));
  return section("Where errors are", "By alpha and angle, both in logarithms.", panels.node);
}

// --- Clamps ------------------------------------------------------------------------------------------------------------
const clamp_table = () => {
  const up_to = (c, x) => ({ n: known(x) ? `${c.by} ${significant(x, 2)}` : "nowhere" });
  return section("What shipped clamps save and cost", "The same inputs with the clamp and without it. What it saves: inputs without a value, and the worst error of the others. What it costs: it changes values by more than 1 % up to the width or cosine told. "
    + "Cosine: the smaller of NoL and NoV.",
    dense(table(["clamp", "in", "number", { n: "no value up to, without" }, { n: "with" }, { n: "worst, without" }, { n: "with" }, { n: "changes values up to" }, { n: "by at most" }],
      clamps.map((c) => [c.clamp, el("code", {}, c.where), c.number, up_to(c, c.no_value_without), up_to(c, c.no_value_with), ...[c.worst_without, c.worst_with].map((x) => ({ n: error_text(x) })),
        up_to(c, c.changed_to), { n: error_text(c.changed_most) }]), { row_class: (i) => (i && clamps[i].clamp !== clamps[i - 1].clamp ? "first" : null) })));
};

// --- On any GPU --------------------------------------------------------------------------------------------------------
function on_any_gpu() {
  if (!any_gpu.length) return null;
  const numbers = unique(any_gpu.map((r) => r.number));
  let number = numbers[0], shown = "proved";
  const kinds = [["proved", "with a bound"], ["open", "open"]];
  const of = (number, shown) => dense(table(["form", "given", { n: "error at most" }, "1 %", "a value", "over", "why not"],
    any_gpu.filter((r) => r.number === number && r.evidence === shown).sort((a, b) => (a.proved_rel ?? 0) - (b.proved_rel ?? 0))
      .map((r) => [form_cell(r.id), given[r.form], { n: known(r.proved_rel) ? error_text(r.proved_rel) : "–" }, r.keeps ? "kept" : "not proved",
        r.finite ? "always" : "not proved", r.domain.replace("sin2_theta_h", "sin²θ_h"), r.why || "–"])));
  const body = changing(() => el("div", {}, el("div", { class: "controls" },
    choice("Number", numbers.map((n) => [n, n]), number, (n) => { number = n; body.again(); }),
    choice("Forms", kinds, shown, (s) => { shown = s; body.again(); })), of(number, shown)),
  () => kinds.filter(([k]) => k !== shown).map(([k, words]) => [el("h3", {}, `In ${number}, ${words}`), of(number, k)]));
  return section("On any GPU", "Proved for every GPU that keeps Vulkan 1.4, whatever it makes of what Vulkan leaves open: rounding up or down, division within 2.5 units, subnormals kept or dropped. "
    + "The shader declares no float controls, and its expressions are “precise”, so that nothing is fused or reordered. Domains are smaller than the hard one.", body.node);
}

// --- Without precise ---------------------------------------------------------------------------------------------------
function in_other_orders() {
  if (!orders.length) return null;
  const numbers = unique(orders.map((r) => r.number));
  let number = numbers[0];
  const of = (number) => dense(table(["form", "given", { n: "as written" }, { n: "regrouped" }, { n: "times" }, { n: "no value" }, { n: "values lost" }, "needs precise"],
    orders.filter((r) => r.number === number).sort((a, b) => b.regrouped - a.regrouped)
      .map((r) => [form_cell(r.id), given[r.form], { n: error_text(r.written) }, { n: el("span", { title: r.inputs }, error_text(r.regrouped)) },
        { n: r.written > 0 ? significant(r.regrouped / r.written, 2) : "–" }, none_or(r.no_value), none_or(r.lost), r.needs_precise ? "yes" : "no"])));
  const body = changing(() => el("div", {}, el("div", { class: "controls" },
    choice("Number", numbers.map((n) => [n, n]), number, (n) => { number = n; body.again(); })), of(number)),
  () => numbers.filter((n) => n !== number).map((n) => [el("h3", {}, `In ${n}`), of(n)]));
  return section("What a compiler costs that regroups", "Without the word “precise” a compiler may add and multiply in any order, and take a quotient for a product with the reciprocal. Each form was looked at in sixteen orders drawn at random. "
    + "Other liberties, as taking factors out, may cost more. A form needs the word where it keeps the tolerance as it is written, 0.0001 in float and 2 % in half, and in some order it does not. Domains are those of the section above.", body.node);
}

// --- Targets -----------------------------------------------------------------------------------------------------------
function missed() {
  const groups = new Map();
  for (const r of rows.filter((r) => r.misses)) {
    const key = r.id + r.reason, g = groups.get(key) ?? { id: r.id, reason: r.reason, numbers: [], worst: 0, beyond: 0 };
    g.numbers.push(r.number);
    g.worst = Math.max(g.worst, r.worst_rel ?? 0);
    g.beyond = Math.max(g.beyond, r.ulp_beyond ?? 0);
    groups.set(key, g);
  }
  if (!groups.size) return null;
  return section("What misses its target, and why", "Targets: in float and double 8 units of the last digit beyond what a unit of the inputs is worth there, and a value that is not negative; in half and mixed numbers 2 % from alpha 0.05 on, of other forms everywhere.",
    dense(table(["form", "in", { n: "worst" }, { n: "units beyond its inputs" }, "because"],
      [...groups.values()].map((g) => [form_cell(g.id), unique(g.numbers).join(", "), { n: error_text(g.worst) }, { n: significant(g.beyond, 2) }, el("span", { class: "reason" }, g.reason)]))));
}

// --- Everything -----------------------------------------------------------------------------------------------------------
function every_form() {
  const numbers = unique(rows.map((r) => r.number)), kinds = unique(rows.map((r) => r.id.split(".")[0]));
  let number = numbers[0], kind = kinds[0];
  const of = (number, kind) => dense(table(["form", "given", { n: "worst" }, { n: "ulp" }, { n: "condition there" }, { n: "ulp beyond it" }, "half raised", { n: "proved" }, { n: "no value" }, { n: "negative" }, { n: "overflow" }, { n: "vanished" }, { n: "wrong way" }, { n: "irreciprocal" }, "safe from", { n: "looked at" }, "by"],
    rows.filter((r) => r.number === number && r.id.startsWith(kind)).map((r) => [form_cell(r.id), given[r.form], worst(r), { n: significant(r.worst_ulp, 2) }, { n: significant(r.condition, 2) }, { n: significant(r.ulp_beyond, 2) }, r.flags || "–",
      { n: known(r.proved_rel) ? error_text(r.proved_rel) : "–" }, none_or(r.nonfinite, r.nonfinite_at), none_or(r.negative), none_or(r.overflow), none_or(r.vanished), none_or(r.not_monotone), none_or(r.irreciprocal),
      !r.decides ? "–" : known(r.safe_from) ? `${r.decides} ${significant(r.safe_from, 2)}` : "nowhere", { n: count(r.evaluations) }, evidence_words[r.evidence] + (r.settled ? "" : ", not settled")])));
  const body = changing(() => el("div", {}, el("div", { class: "controls" },
    choice("Kind", kinds.map((k) => [k, k]), kind, (k) => { kind = k; body.again(); }),
    choice("Number", numbers.map((n) => [n, n]), number, (n) => { number = n; body.again(); })), of(number, kind)),
  () => kinds.filter((k) => k !== kind).map((k) => [el("h3", {}, `${k}, ${number}`), of(number, k)]));
  return section("Every form in every number", "Over the hard domain: alpha from 10⁻⁶, cosines from 10⁻⁸, extinction up to 1000. “Every input”: each half there is was evaluated. “Search”: the worst that seeds and climbing found from two starts; there may be worse. Results below 2⁻⁶⁴, 5·10⁻²⁰, count as black in float, double and mixed numbers, and errors below a half's least normal number are measured against that. "
    + "Vanished: 0 where a value should be. Wrong way: neighbours between which the value rises where it should fall. Irreciprocal: another value with light and view exchanged. Half raised: flags on the way to the worst input.", body.node);
}

const first = picture_of(figures, "error_by_alpha", { number: "half" }) ?? figures[0];
show_report({
  command: "report stability", title: "Which formulas stay stable in few bits", findings, first: first && figure_view(first, { height: 340, copy: true }),
  sections: [clamp_question(), by_alpha(), error_maps(), clamps.length ? clamp_table() : null, on_any_gpu(), in_other_orders(), missed(), every_form()],
  setting: `${full ? "Full" : "Quick"} setting. Truths are computed in double, the worst of them again in fifty digits. Every figure of this page is in its data block and in the .json beside it.`,
});
