"use strict";
// What the pages of one table share: its curves, and what it can be trusted for.

const page = page_data();
const { health, channels, curves } = page;
const several = channels.length > 1, with_model = curves.some((c) => c.model.length > 0);
const file_name = health.path.split("/").pop();
const symbol = { theta_i: "θ_i", theta_o: "θ_o", theta_d: "θ_d", theta_h: "θ_h", phi_d: "φ_d", phi_o: "φ_o", phi: "φ" };
const words_of_angle = (name) => symbol[name] ?? words(name);

// --- Warnings ------------------------------------------------------------------------------------
const warning = (what, ...rest) => el("li", {}, el("b", {}, what), " ", rest);
const warning_list = (all) => (all.length ? el("ul", { class: "warnings", "aria-label": "Warnings" }, all) : null);

/// Warnings of the table alone; \param fitted  a fit that has told some of them, or null
function health_warnings(fitted) {
  const out = [], warn = (...parts) => out.push(warning(...parts)), { peak, noise } = health;
  if (!fitted) {
    for (const w of health.warnings ?? []) warn("Beware:", w + ".");
    if (health.retro) warn("Retro-reflective:", "the highlight sits at wo = wi and not at the half vector. A microfacet lobe cannot describe it.");
    if (copies_words()) warn("Copies:", copies_words() + ": no measurements of their own.");
  }
  const told = fitted?.warnings?.some((w) => w.includes("does not resolve its highlight"));
  if (peak && peak.limit === "samples" && !told) warn("Peak not resolved:", `${significant(peak.samples_within, 2)} samples within its half width of ${degrees(peak.half_width_deg, 2)}. It may be narrower.`);
  if (peak && peak.limit === "bins") warn("Peak limited by the bins:", known(health.bin_sensitivity) ? `where samples sit in them changes its alpha by ${signed_percent(health.bin_sensitivity)}.` : peak.in_words + ".");
  const above_horizon = health.values - (health.masked?.below_horizon ?? 0);
  const lost = (health.masked?.negative ?? 0) + (health.masked?.not_finite ?? 0);
  if (above_horizon > 0 && lost > 0.02 * above_horizon)
    warn("Many masked values:", `${percent(lost / above_horizon)} of those above the horizon.`);
  // Noise alone makes a median difference of 0.95 σ.
  if (health.reciprocity_error > Math.max(0.05, known(noise.sigma) ? 2 * noise.sigma : 0))
    warn("Not reciprocal:", `exchanging the directions changes a value by ${percent(health.reciprocity_error)} (median)`
      + (known(noise.sigma) && !noise.bound ? `, where noise would change it by ${percent(0.95 * noise.sigma)}.` : "."));
  const bright = (health.albedo ?? []).filter((a) => list_of(a.albedo).some((x) => x > 1));
  if (bright.length) warn("Albedo above 1", `at θ_i = ${bright.map((a) => degrees(a.theta_i_deg)).join(", ")}: more light leaves than arrives.`);
  return out;
}

// --- Curves ----------------------------------------------------------------------
function curve_text(cut) {
  const peak = (series) => series[0].reduce((best, v, i) => (v !== null && (best === null || v > series[0][best]) ? i : best), null);
  const d = peak(cut.data), m = cut.model.length ? peak(cut.model) : null;
  const at = (series, i) => (i === null ? "none" : `${significant(series[0][i])} per steradian at ${degrees(cut.deg[i])}`);
  return `Curves at ${symbol[cut.at]} ${degrees(cut.at_deg)} over ${symbol[cut.along]}, channel ${channels[0]}: `
    + `largest value of the data ${at(cut.data, d)}${cut.model.length ? `, of the model ${at(cut.model, m)}` : ""}.`;
}
function curve_panel(cut, state) {
  const readout = el("div", { class: "readout", style: { "min-height": `${1.5 * channels.length}em` } });
  const rest = () => readout.replaceChildren();
  const hover = (at) => {
    if (!at) return rest();
    readout.replaceChildren(el("table", {}, channels.map((name, c) => {
      if (!state.on[c]) return null;
      const d = at[1 + c], i = at[0];
      const y = d === null || d === undefined ? null : cut.data[c][d], f = cut.model[c]?.[d ?? i];
      return el("tr", {}, several ? el("td", {}, chip(channel_color(name, c)), name) : null,
        el("td", {}, angle_name(cut.along), ` ${degrees(cut.deg[d ?? i], 2)}`),
        el("td", {}, "data ", el("b", {}, significant(y, 4))),
        with_model ? [el("td", {}, "model ", el("b", {}, significant(f, 4))),
                      el("td", {}, y > 0 && f > 0 ? ratio(Math.log(f / y)) : "")] : null);
    })));
  };
  rest();
  const signed = cut.along === "theta_o";
  // Grazing values would set the scale for all others.
  const inside = (i) => Math.abs(cut.deg[i]) <= 85;
  const plot = curve_plot([cut.deg, ...cut.data, ...cut.model],
    [...channels.map((name, c) => ({ color: channel_color(name, c), kind: "points" })),
     ...(with_model ? channels.map((name, c) => ({ color: several ? channel_color(name, c) : "ink", kind: "line" })) : [])],
    { x_label: signed ? "θ_o [°], mirror side positive" : `${symbol[cut.along]} [°]`,
      x_ends: signed ? [-90, 90] : [0, 90], x_steps: [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 30], y_label: "f_r [1/sr]",
      log: state.log, mark: signed ? cut.at_deg : null, y_of: inside, hover, text: curve_text(cut) });
  return {
    plot,
    node: el("figure", {}, el("figcaption", {}, angle_name(cut.at), ` = ${degrees(cut.at_deg, 2)}`,
      cut.within_deg > 0 ? el("small", {}, ` data within ±${degrees(cut.within_deg)}`) : null),
      plot.node, readout),
  };
}
function curve_section() {
  const state = { log: true, on: channels.map(() => true) };
  const panels = curves.map((c) => curve_panel(c, state));
  const apply = () => panels.forEach((p) => p.plot.set({ log: state.log, shown: with_model ? [...state.on, ...state.on] : state.on }));
  const in_plane = curves.some((c) => c.along === "theta_o");
  const keys = el("span", { class: "keys" }, channels.map((name, c) => el("label", {},
    several ? el("input", { type: "checkbox", checked: "", onchange: (e) => { state.on[c] = e.target.checked; apply(); } }) : null,
    several ? [chip(channel_color(name, c)), name] : with_model ? [chip(channel_color(name, c)), "data", chip("ink"), "model"] : null)));
  const out = section(with_model ? "Data and model" : "Curves",
    "Points are the table's samples" + (curves.some((c) => c.at === "theta_i") && health.bins !== "none" ? " (where the grid has them, interpolated in the other angles)" : "")
      + (with_model ? ", lines the fitted model" : "") + ", without the cosine. " + (in_plane ? "The dashed line is the mirror direction. " : "")
      + "Drag across a plot to look closer; double click to go back.",
    curves.length === 0 ? el("p", {}, "No valid sample lies in the plane of incidence.") : [
      el("div", { class: "controls" },
        choice("Scale of f_r", [[true, "logarithmic"], [false, "linear"]], state.log, (v) => { state.log = v; apply(); }), keys),
      el("div", { class: "panels" }, panels.map((p) => p.node))]);
  return out;
}

// --- The table --------------------------------------------------------------------------------------
function noise_words() {
  const n = health.noise;
  if (!known(n.sigma)) return "cannot be told: no nine samples lie on a line along one angle";
  const from = n.along === "repeats" ? "from repeated samples" : `from neighbours along ${words_of_angle(n.along)}`;
  return `${n.bound ? "below" : "about"} ${percent(Math.max(n.sigma, n.bound ? 1e-4 : 0))} of each value, ${from}`;
}
function peak_words() {
  const peak = health.peak;
  if (peak) return `${peak.in_words}; height ${significant(peak.height)}, base ${significant(peak.base)} 1/sr`;
  if (health.peak_profiles === 0) return "none found: too few samples near the half vector to tell";
  return `none found: near the half vector values are ${significant(health.peak_contrast)} times the base`;
}
function copies_words() {
  const parts = [[health.copied_rows, "incident"], [health.copied_columns, "outgoing"]]
    .filter(([n]) => n > 0).map(([n, which]) => many(n, `${which} angle`));
  return parts.length ? `${parts.join(" and ")} repeat their neighbour value for value` : null;
}
function health_section() {
  const masked = Object.entries(health.masked ?? {}).filter(([reason]) => reason !== "valid");
  const of = (n) => `${count(n)} (${percent(n / health.values)})`;
  const facts = pairs([
    ["samples", `${count(health.samples)}, ${several ? `${channels.length} channels (${channels.join(", ")})` : "1 channel"}`],
    ["valid values", of(health.valid)],
    ...masked.map(([reason, n]) => [words(reason), of(n)]),
    ["range", `${significant(health.smallest_positive)} (smallest positive) to ${significant(health.largest)} 1/sr`],
    ["noise floor", health.noise_floor > 0 ? `${significant(health.noise_floor)} 1/sr, from the negative values` : "not seen: no negative values that are noise"],
    ["reciprocity", known(health.reciprocity_error) ? `${percent(health.reciprocity_error)} median difference of exchanged directions${health.reciprocity_note ? "; " + health.reciprocity_note : ""}` : health.reciprocity_note || "cannot be told from this layout"],
    ["noise", noise_words()],
    ["peak", peak_words()],
    ["retro-reflection", health.retro ? `the highlight, ${significant(health.retro.height)} 1/sr high and ${degrees(health.retro.half_width_deg)} wide, sits at wo = wi` : null],
    ["copies", copies_words()],
    ["bin convention", known(health.bin_sensitivity) ? `${health.bins}; the other one would change the peak's alpha by ${signed_percent(health.bin_sensitivity)}` : null],
  ]);
  const albedo = (health.albedo ?? []).length ? table(
    [angle_name("theta_i"), ...channels.map((c) => ({ n: several ? c : "albedo" })), { n: "coverage" }],
    health.albedo.map((a) => [degrees(a.theta_i_deg), ...list_of(a.albedo).map((x) => ({ n: significant(x) })), { n: percent(a.coverage) }]),
    { caption: "Directional albedo of the data" }) : null;
  const truth = health.truth ? pairs([["made by gonio from", el("code", {}, health.truth.model)],
    ["noise", percent(health.truth.noise ?? 0)], ["floor", `${significant(health.truth.floor ?? 0)} 1/sr`],
    ["outliers", percent(health.truth.outliers ?? 0)], ["seed", String(health.truth.seed)]]) : null;
  return section("What the table can be trusted for",
    "From the data alone, before any fit. Coverage is the share of the cosine-weighted hemisphere that valid samples speak for.",
    el("div", { class: "columns" }, el("div", {}, facts),
      el("div", {}, albedo ? scroll(albedo) : null, truth ? el("div", { style: { "margin-top": "16px" } }, el("h3", {}, "Truth"), truth) : null)));
}

