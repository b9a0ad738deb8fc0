"use strict";
// The page of a table before any fit.

const { picture, trust, albedo } = page;

// --- What it says at the top ---------------------------------------------------------------------
function verdict() {
  const { peak } = health;
  return el("p", { class: "verdict" }, el("code", {}, file_name), ` holds ${count(health.valid)} valid values of ${count(health.values)}`
    + ` over ${health.layout.split(" × ").map((a) => a.replace(/[a-z_]+$/, words_of_angle)).join(" × ")}. `,
    known(health.noise.sigma) ? `Their noise is ${health.noise.bound ? "below" : "about"} ${percent(Math.max(health.noise.sigma, 1e-4))}. ` : null,
    health.retro ? "The highlight sits where the light comes from."
      : peak ? ["The highlight is as wide as that of GGX with ", el("b", {}, `alpha ${significant(peak.alpha, 2)}`), peak.limit === "none" ? "." : ", at most."]
      : health.peak_profiles > 0 ? "No highlight stands out." : "Too few samples lie near the half vector to see a highlight.");
}
function facts() {
  const fact = (name, value, rest = null) => el("div", {}, el("dt", {}, name), el("dd", {}, value, rest ? el("small", {}, " " + rest) : null));
  const { noise, peak } = health;
  const middle = (health.albedo ?? []).find((a) => list_of(a.albedo).every(known));
  return el("dl", { class: "facts" },
    fact("valid", percent(health.valid / health.values), `of ${count(health.values)}`),
    fact("noise", known(noise.sigma) ? (noise.bound ? "< " : "") + percent(Math.max(noise.sigma, noise.bound ? 1e-4 : 0)) : "–"),
    fact("highlight", peak ? degrees(peak.half_width_deg, 2) : "–", peak ? "half width" : null),
    fact("reciprocity", known(health.reciprocity_error) ? percent(health.reciprocity_error) : "–", known(health.reciprocity_error) ? "median error" : null),
    middle ? fact("albedo", list_of(middle.albedo).map((x) => significant(x, 2)).join(" "), `at ${degrees(middle.theta_i_deg)}`) : null,
    fact("largest", significant(health.largest), "1/sr"));
}

// --- Prospects -----------------------------------------------------------------------------------
const prospect_names = { alpha: "width of the highlight, alpha", f0: "its strength, f0", fresnel: "its rise towards grazing, Fresnel",
                         kd: "base, kd", precision: "precision of the values", intervals: "errors shared by an incident angle" };
function prospects() {
  return section("What a fit can hope to determine", "From the data alone; what other parameters take or leave, the fit's own intervals say.",
    el("div", { class: "prospects" }, scroll(table(["", "", "because"], health.prospects.map((p) => [
      prospect_names[p.of] ?? p.of, el("span", { class: `verdict-${p.verdict}` }, p.verdict),
      el("span", { class: "because" }, p.because.replace(/theta_[iohd]/g, words_of_angle))])))));
}

// --- The picture -----------------------------------------------------------------------------------
const rgb = ["r", "g", "b"].map((name) => channels.indexOf(name));
const colored = rgb.every((c) => c >= 0);
/// Of the values that are shown: nearly all of them, and not the horizon's few.
function range_of(values) {
  const sorted = values.flat().filter((v) => v > 0).sort((a, b) => a - b);
  if (!sorted.length) return [0.1, 1];
  const at = (q) => sorted[Math.round(q * (sorted.length - 1))];
  const [low, high] = [at(0.005), at(0.995)];
  return high > 1.05 * low ? [low, high] : [low / 1.05, high * 1.05];
}
/// Not Math.min(...values): a call takes some ten thousand arguments, and a table has more.
function ends_of(values) {
  return values.reduce(([low, high], v) => [Math.min(low, v), Math.max(high, v)], [Infinity, -Infinity]);
}
function picture_layers() {
  const [low, high] = range_of(picture.value), span = Math.log(high / low);
  const places = { logarithmic: (v) => Math.log(Math.max(v, 1e-300) / low) / span, linear: (v) => v / high };
  const ticks = {
    logarithmic: log_ticks(low, high).map((v) => [places.logarithmic(v), tick_text(v)]),
    linear: [0, 0.25, 0.5, 0.75, 1].map((t) => [t, tick_text(Number((t * high).toPrecision(2)))]),
  };
  const within = (t) => Math.min(1, Math.max(0, t));
  const encode = (x) => Math.round(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055));
  const layers = {};
  for (const scale of ["logarithmic", "linear"]) {
    if (colored) {
      const value = (k) => rgb.map((c) => picture.value[c][k]);
      const luminance = (v) => 0.2126 * v[0] + 0.7152 * v[1] + 0.0722 * v[2];
      layers["colour " + scale] = {
        at: (k) => (value(k).every(known) ? within(places[scale](luminance(value(k)))) : null),
        color: (k) => {  // the ratios of the channels are kept, the luminance is put on the scale
          const v = value(k).map((x) => Math.max(x, 0)), y = luminance(v), t = within(places[scale](y));
          const light = scale === "linear" ? t : t ** 2.2;
          return `rgb(${v.map((x) => encode(within(y > 0 ? x / y * light : 0))).join(",")})`;
        },
        ticks: ticks[scale], label: "luminance of f_r [1/sr]", ground: "rule" };
    }
    channels.forEach((name, c) => {
      layers[`${name} ${scale}`] = {
        at: (k) => (known(picture.value[c][k]) ? within(places[scale](picture.value[c][k])) : null),
        colors: sequential, ticks: ticks[scale], label: several ? `f_r of ${name} [1/sr]` : "f_r [1/sr]", ground: "rule" };
    });
  }
  return layers;
}
function picture_section() {
  const first = colored ? "colour" : channels[0], state = { what: first, scale: "logarithmic" };
  const empty = picture.value.every((plane) => !plane.some(known));
  if (empty) return null;
  const where = known(picture.phi_d_deg) ? `at φ_d = ${degrees(picture.phi_d_deg)}` : "as the mean of a cell's samples";
  const [lowest, highest] = ends_of(picture.value.flat().filter(known));
  const text = `f_r over half-vector angle and difference angle ${where}, from ${significant(lowest)} to ${significant(highest)} per steradian.`;
  const map = heat_map(map_axis("theta_h", picture.theta_h_deg), map_axis("theta_d", picture.theta_d_deg), picture_layers(),
    (k) => (picture.value.some((plane) => known(plane[k]))
      ? channels.map((name, c) => [several ? [chip(channel_color(name, c)), `${name} `] : null, el("b", {}, significant(picture.value[c][k])), " "]).flat(2).filter(Boolean).concat("1/sr")
      : ["no valid value"]), text);
  const show = () => map.set(`${state.what} ${state.scale}`);
  const names = [...(colored ? [["colour", "colour"]] : []), ...channels.map((name) => [name, several ? name : "f_r"])];
  const out = section("The table as a picture",
    `f_r over half and difference angle, ${where}: the highlight at the left edge, Fresnel's rise at the top, retro-reflection at the bottom.`
      + (colored ? " In colour the luminance is on the scale and the channels keep their ratios." : ""),
    el("div", { class: "controls" },
      names.length > 1 ? choice("Shown", names, first, (w) => { state.what = w; show(); }) : null,
      choice("Scale", [["logarithmic", "logarithmic"], ["linear", "linear"]], "logarithmic", (w) => { state.scale = w; show(); })),
    map.node);
  show();
  return out;
}

// --- Albedo ----------------------------------------------------------------------------------------
function albedo_section() {
  const x = albedo.map((a) => a.theta_i_deg), y = channels.map((_, c) => albedo.map((a) => list_of(a.albedo)[c] ?? null));
  if (albedo.length < 2 || !y.some((v) => v.some(known))) return null;
  const readout = el("div", { class: "readout" });
  const hover = (at) => readout.replaceChildren(...(at ? [angle_name("theta_i"), ` ${degrees(x[at[0]])}: `,
    ...channels.flatMap((name, c) => [several ? chip(channel_color(name, c)) : "", el("b", {}, significant(y[c][at[0]])), " "]),
    `, samples cover ${percent(albedo[at[0]].coverage)} of the hemisphere`] : []));
  const [lowest, highest] = ends_of(y.flat().filter(known));
  const plot = curve_plot([x, ...y, ...y],
    [...channels.map((name, c) => ({ color: channel_color(name, c), kind: "points" })), ...channels.map((name, c) => ({ color: channel_color(name, c), kind: "line" }))],
    { x_label: "θ_i [°]", x_ends: [0, 90], x_steps: [5, 10, 15, 30], y_label: "albedo", log: false, y_of: () => true, hover,
      text: `Directional albedo from ${significant(lowest)} to ${significant(highest)} over incident angles from ${degrees(x[0])} to ${degrees(x.at(-1))}.` });
  return section("Directional albedo", "∫ f cos θ_o dω_o: how much of the light from θ_i leaves again. Where samples lack, their mean stands in; above 1 more light leaves than arrives.",
    el("figure", { class: "half" }, plot.node, readout));
}
// --- Noise -------------------------------------------------------------------------------------------
function noise_section() {
  const { noise } = health;
  const bands = (title, unit, list, from, to) => (list.length === 0 ? null : table(
    [title, { n: "values" }, { n: "σ of ln f" }, ""],
    list.map((b) => [`${tick_text(b[from])}–${tick_text(b[to])}${unit}`, { n: count(b.values) }, { n: percent(b.sigma) },
      el("span", { class: "bar", style: { width: `${Math.round(90 * b.sigma / Math.max(...list.map((c) => c.sigma)))}px` } })])));
  const per_channel = list_of(noise.channels).filter(known).length > 1
    ? ` By channel: ${channels.map((name, c) => `${name} ${percent(noise.channels[c])}`).join(", ")}.` : "";
  return section("Noise", `${noise_words().replace(/^./, (c) => c.toUpperCase())}.${noise.bound ? "" : per_channel} `
    + (known(noise.sigma) ? "Each value is compared with the smooth curve through its four neighbours on either side; errors that neighbours share, as of an adjustment or of interpolation, are not seen." : ""),
    noise.over_zenith.length + noise.over_value.length === 0 ? null : el("div", { class: "columns" },
      scroll(bands("larger of θ_i, θ_o", "°", noise.over_zenith, "from_deg", "to_deg")),
      scroll(bands("value [1/sr]", "", noise.over_value, "from", "to"))));
}

// --- Reciprocity, masks ----------------------------------------------------------------------------
const nice_limit = (x) => [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2].find((l) => l >= x) ?? 2;
const thirds = (limit) => [0, 0.5, 1].map((t) => [t, (t === 1 ? "≥ " : "") + percent(t * limit)]);
function trust_map(layers, say, text) {
  return heat_map(map_axis(trust.x, trust.x_deg), map_axis(trust.y, trust.y_deg), layers, say, text);
}
function reciprocity_section() {
  const seen = trust.reciprocity.filter(known).sort((a, b) => a - b);
  if (!seen.length) return section("Reciprocity", `Cannot be told: ${health.reciprocity_note}.`);
  const limit = nice_limit(seen[Math.floor(0.95 * (seen.length - 1))]);
  const sigma = health.noise.sigma;
  const text = `Mean difference of exchanged directions by angle: half of the cells below ${percent(seen[seen.length >> 1])}, largest ${percent(seen.at(-1))}.`;
  const map = trust_map({ error: { at: (k) => (known(trust.reciprocity[k]) ? Math.min(1, trust.reciprocity[k] / limit) : null), colors: sequential,
      ticks: thirds(limit), label: "mean relative difference" } },
    (k) => (trust.pairs[k] ? [el("b", {}, percent(trust.reciprocity[k])), ` mean difference of ${many(trust.pairs[k], "pair")}`] : ["no pair of valid values"]), text);
  return section("Reciprocity", `|f(wi, wo) − f(wo, wi)| over their mean. Median ${percent(health.reciprocity_error)}, ${health.reciprocity_note.replace("median ", "")}.`
    + (known(sigma) && !health.noise.bound ? ` The noise alone would make a median of ${percent(0.95 * sigma)}.` : ""), map.node);
}
function mask_section() {
  const reasons = Object.keys(trust.masked).filter((why) => trust.masked[why].some((n) => n > 0));
  if (!reasons.length) return section("What was masked", "Nothing: every value is finite, not negative, and above the horizon.");
  const first = reasons.find((why) => why !== "below_horizon") ?? reasons[0];
  const why_text = { below_horizon: "directions below the surface, whatever is stored there", negative: "negative values, which no reflectance is",
                     not_finite: "not a number, or infinite" };
  const layers = Object.fromEntries(reasons.map((why) => [why, {
    at: (k) => (trust.values[k] ? trust.masked[why][k] / trust.values[k] : null), colors: sequential,
    ticks: [0, 0.25, 0.5, 0.75, 1].map((t) => [t, percent(t)]), label: `share of values: ${words(why)}` }]));
  const map = trust_map(layers, (k) => (trust.values[k] ? [`of ${many(trust.values[k], "value")} `,
      ...reasons.map((why, i) => [i ? ", " : "", el("b", {}, percent(trust.masked[why][k] / trust.values[k])), ` ${words(why)}`]).flat()] : ["no values"]),
    `Share of masked values by angle: ${reasons.map((why) => `${words(why)} ${percent(health.masked[why] / health.values)} in all`).join(", ")}.`);
  map.set(first);
  return section("What was masked, and where", reasons.map((why) => `${count(health.masked[why])} values (${percent(health.masked[why] / health.values)}): ${why_text[why]}`).join("; ")
    + ". Masked values are left out everywhere, never taken for black.",
    reasons.length > 1 ? el("div", { class: "controls" }, choice("Shown", reasons.map((why) => [why, words(why)]), first, (w) => map.set(w))) : null,
    map.node);
}

/// Directions to measure next, where they were asked for.
function next_section() {
  if (!page_data().next?.length) return null;
  const width = (w) => ({ n: known(w) ? significant(w, 2) : "not known" });
  return section("What to measure next", "Each direction narrows the parameter that is least known by then. Before and after: the width of its 95 % interval.",
    scroll(table([{ n: "θi [°]" }, { n: "φi [°]" }, { n: "θo [°]" }, { n: "φo [°]" }, "parameter", { n: "before" }, { n: "after" }],
      page_data().next.map((d) => [{ n: plain(d.theta_i, 4) }, { n: plain(d.phi_i, 4) }, { n: plain(d.theta_o, 4) }, { n: plain(d.phi_o, 4) }, d.parameter, width(d.width_before), width(d.width_after)]))));
}

document.getElementById("page").replaceChildren(
  el("p", { class: "over" }, "gonio inspect"), el("h1", {}, file_name), verdict(),
  ...[warning_list(health_warnings(false)), facts(), prospects(), next_section(), picture_section(), curve_section(), albedo_section(), noise_section(),
      el("div", { class: "columns" }, reciprocity_section(), mask_section()), health_section()].filter(Boolean),
  el("footer", {}, "f_r is in 1/sr, without the cosine. Every figure of this page is in its data block and in the .page.json beside it. "
    + "Curves drawn with uPlot, © Leon Sorokin, MIT licence."));
