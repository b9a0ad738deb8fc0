"use strict";
// The page of a fit.

const { fit, residual_map } = page;

/// Parameters as rows: one per channel where they have channels.
function parameter_rows() {
  const truth = true_values();
  return Object.entries(fit.parameters).flatMap(([name, p]) => {
    const values = list_of(p.value), errors = list_of(p.std_error), states = list_of(p.status);
    const intervals = values.length > 1 ? p.ci95 : [p.ci95];
    const true_value = truth[name] ? list_of(truth[name]) : null;
    return values.map((value, c) => ({
      name, channel: values.length > 1 ? c : null, first: c === 0,
      label: values.length > 1 ? `${name}.${channels[c]}` : name,
      value, error: errors[c], status: states[c], limit: list_of(p.limit)[c], reason: list_of(p.reason ?? "")[c], low: intervals[c]?.[0], high: intervals[c]?.[1],
      truth: true_value ? true_value[Math.min(c, true_value.length - 1)] : null,
    }));
  });
}
/// Of a synthesized table; alpha and roughness from each other (alpha = roughness²).
function true_values() {
  const out = { ...(health.truth?.parameters ?? {}) };
  for (const [name, v] of Object.entries(out)) {
    if (/^alpha/.test(name)) out[name.replace("alpha", "roughness")] ??= list_of(v).map(Math.sqrt);
    if (/^roughness/.test(name)) out[name.replace("roughness", "alpha")] ??= list_of(v).map((r) => r * r);
  }
  return out;
}
const rows = parameter_rows();

// --- What it says at the top ---------------------------------------------------------------------
// A log RMS is a relative error while it is small.
const log_rms_text = (x) => (x < 0.3 ? percent(x) : significant(x, 3));
function verdict() {
  const ln = fit.residuals.log_rms, fits = fit.misfit?.tested ? !fit.misfit.told : fits_well(ln);
  return el("p", { class: "verdict" },
    el("code", {}, fit.model), ` ${fits ? "reproduces" : "misses"} the ${count(fit.input.values_used)} values used of `,
    el("code", {}, file_name), ` ${fits ? "to" : "by"} a typical factor of `,
    el("b", {}, "×/÷\u202f" + ratio(ln).slice(1)), ` (log RMS ${log_rms_text(ln)}); the fit `,
    fit.solver.termination === "converged" ? "converged." : el("b", {}, "did not converge."));
}
function warnings() {
  const out = [];
  const warn = (...parts) => out.push(warning(...parts));
  for (const w of fit.warnings ?? []) warn("Beware:", with_angles(w), ".");
  if (fit.solver.termination !== "converged") warn("Not converged.", fit.solver.message);
  const named = (status) => rows.filter((r) => r.status === status).map((r) => r.label).join(", ");
  if (named("not_identifiable")) warn("Not known:", named("not_identifiable"), ". These data do not determine it; no value is given.");
  const limits = [named("upper_limit"), named("lower_limit")].filter(Boolean).join(", ");
  if (limits) warn("Limits alone:", limits, ". The data tell one end, at 95 %.");
  if (named("at_bound")) warn("At the end of its range:", named("at_bound"), ". The data push beyond it.");
  const tied = strongest_correlation();
  if (tied && Math.abs(tied.rho) > 0.95) warn("Hardly separable:", `${tied.a} and ${tied.b} (correlation ${minus(tied.rho.toFixed(3))}).`);
  for (const s of fit.bin_sensitivity ?? []) {
    const most = Object.entries(s.relative_change)
      .flatMap(([name, v]) => list_of(v).filter(known).map((x) => [name, x])).sort(([, a], [, b]) => Math.abs(b) - Math.abs(a))[0];
    const [here, there] = [fit.residuals.log_rms, s.log_rms].map(log_rms_text);
    if (most && Math.abs(most[1]) > 0.01)
      warn("Bin convention matters:", `with samples at the ${s.other} of their bins, ${most[0]} changes most, by ${signed_percent(most[1])}`
        + (here === there ? "." : `; the log RMS would be ${there} instead of ${here}.`));
  }
  return warning_list([...out, ...health_warnings(fit)]);
}
function next_steps() {
  if (!fit.next?.length) return null;
  return el("div", { class: "next" }, el("h2", {}, "What to try next"), el("ul", {}, fit.next.map((step) => el("li", {}, with_code(step), "."))));
}
function facts() {
  const total = Object.values(fit.solver.time_ms).reduce((a, t) => a + t, 0);
  const fact = (name, value, rest = null) => el("div", {}, el("dt", {}, name), el("dd", {}, value, rest ? el("small", {}, " " + rest) : null));
  return el("dl", { class: "facts" },
    fact("typical factor", "×/÷\u202f" + ratio(fit.residuals.log_rms).slice(1)),
    fact("log RMS", log_rms_text(fit.residuals.log_rms)),
    fact("RMS", significant(fit.residuals.rms), "1/sr"),
    fact("values used", count(fit.input.values_used), `of ${count(health.values)}`),
    fact("metric", words(fit.metric), fit.robust === "none" ? null : `robust: ${words(fit.robust)}`),
    fact("time", milliseconds(total)));
}

// --- Parameters ----------------------------------------------------------------------------------
function parameters() {
  const with_truth = rows.some((r) => known(r.truth));
  const relative = (r, x) => (x - r.value) / Math.abs(r.value);
  // An interval that is cut, wider than the error says, or reaches further to one side has ends of their own size.
  const even = (r) => {
    const [least, most] = [r.value - r.low, r.high - r.value].sort((a, b) => a - b);
    return most < 1e-3 * Math.abs(r.value) || (least > 1.9 * r.error && most < Math.min(1.5 * least, 2.8 * r.error));
  };
  const number = (r, x) => (!known(r.error) || even(r) ? with_error(x, r.error) : plain(Math.abs(x) < 1e-4 * r.high ? 0 : x, 3));
  const limit = (r) => limit_text(r.status, r.limit);
  const widths = rows.filter((r) => known(r.value) && r.value !== 0 && known(r.low) && known(r.high))
    .map((r) => Math.max(-relative(r, r.low), relative(r, r.high)));
  const reach = Math.min(1, 1.1 * Math.max(...widths, 0)) || 1;
  const drawing = (r) => {
    if (known(r.limit) && r.limit > 0) {
      const upper = r.status === "upper_limit", truth = known(r.truth) ? r.truth / r.limit - 1 : null;
      return interval_drawing(upper ? -Infinity : 0, upper ? 0 : Infinity, truth, reach, `${upper ? "at most" : "at least"} ${significant(r.limit, 3)}`);
    }
    if (!known(r.value) || r.value === 0 || !known(r.low) || !known(r.high)) return "";
    const [low, high] = [relative(r, r.low), relative(r, r.high)];
    return interval_drawing(low, high, known(r.truth) ? relative(r, r.truth) : null, reach,
      `95 % interval ${signed_percent(low)} to ${signed_percent(high)} of the value`);
  };
  const sigma = (r) => (known(r.value) && known(r.error) && r.error > 0
    ? `${minus(((r.value - r.truth) / r.error).toFixed(1))} σ` : null);
  const head = ["", { n: "value" }, { n: "standard error" }, { n: "95 % interval" }, "status",
    ...(with_truth ? [{ n: "truth" }, { n: "off by" }] : []),
    `interval relative to the value, ±${percent(reach)}`];
  const body = rows.map((r) => [
    r.channel === null ? el("code", {}, r.name)
      : [chip(channel_color(channels[r.channel], r.channel)), el("code", {}, r.label)],
    { n: known(r.value) ? number(r, r.value) : known(r.limit) ? limit(r) : "–" },
    { n: known(r.error) ? significant(r.error, 2) : "–" },
    { n: known(r.limit) ? limit(r) : known(r.low) && known(r.high) ? `${number(r, r.low)} … ${number(r, r.high)}` : "–" },
    el("span", { class: `status ${r.status}` }, status_words[r.status], r.reason ? el("small", {}, r.reason) : null),
    ...(with_truth ? [{ n: known(r.truth) ? plain(r.truth) : "–" }, { n: known(r.truth) ? sigma(r) ?? "–" : "–" }] : []),
    drawing(r),
  ]);
  const clusters = fit.clusters > 0 ? `, ${count(fit.clusters)} clusters` : "";
  return section("Parameters",
    `Values are written to the second digit of their standard error. Intervals: ${fit.intervals}${clusters}. `
      + "A bar stands around its value; what goes on beyond the picture has an arrow, and a limit begins in the middle."
      + (with_truth ? " The table is synthetic: the orange tick is the value it was made with." : ""),
    el("div", { class: "parameters" }, scroll(table(head,
      body.map((b) => b.map((c) => (Array.isArray(c) ? el("span", {}, c) : c))),
      { row_class: (i) => (rows[i].first ? "first" : null) }))));
}

// --- Where the model is off ----------------------------------------------------------------------
function map_text() {
  const seen = residual_map.mean.map((v, k) => ({ v, k })).filter((c) => c.v !== null);
  if (!seen.length) return "No cell has valid values.";
  const worst = seen.reduce((a, b) => (Math.abs(b.v) > Math.abs(a.v) ? b : a));
  const nd = residual_map.theta_d_deg.length - 1;
  const place = (edges, i) => degrees((edges[i] + edges[i + 1]) / 2);
  const median = seen.map((c) => Math.abs(c.v)).sort((a, b) => a - b)[seen.length >> 1];
  return `Model over data by half-vector and difference angle, ${seen.length} cells: half of them within a factor of `
    + `${Math.exp(median).toFixed(4)}; farthest ${ratio(worst.v)} at half-vector angle `
    + `${place(residual_map.theta_h_deg, Math.floor(worst.k / nd))}, difference angle ${place(residual_map.theta_d_deg, worst.k % nd)}.`;
}
function residual_heat_map() {
  const m = residual_map;
  // The scale holds 95 % of the cells; the rest is shown as its ends.
  const limit_of = (values) => {
    const sizes = values.filter(known).map(Math.abs).sort((a, b) => a - b);
    const most = sizes[Math.floor(0.95 * (sizes.length - 1))] ?? 0;
    return Math.log([1.01, 1.02, 1.05, 1.1, 1.2, 1.5, 2, 3, 5, 10, 30, 100, 1000].find((f) => Math.log(f) >= most) ?? 1e4);
  };
  const layer = (values, signed, colors, label) => {
    const limit = limit_of(values), low = signed ? -limit : 0;
    const more = (t) => (Math.abs(t) === limit ? (t < 0 ? "≤ " : "≥ ") : "") + ratio(t);
    const at = (v) => (v - low) / (limit - low);
    return { at: (k) => (known(values[k]) ? at(values[k]) : null), colors, label,
      ticks: (signed ? [-limit, -limit / 2, 0, limit / 2, limit] : [0, limit / 2, limit]).map((t) => [at(t), more(t)]) };
  };
  return heat_map(map_axis("theta_h", m.theta_h_deg), map_axis("theta_d", m.theta_d_deg),
    { mean: layer(m.mean, true, diverging, "model/data, geometric mean of the cell"),
      rms: layer(m.rms, false, sequential, "typical factor between model and data") },
    (k) => (m.count[k] === 0 ? ["no valid values"]
      : [el("b", {}, `model/data ${ratio(m.mean[k])}`), `, RMS ×/÷ ${ratio(m.rms[k]).slice(1)}, ${count(m.count[k])} values`]),
    map_text());
}
function residuals() {
  const map = residual_heat_map();
  const bands = fit.residuals.bands ?? [];
  const most = Math.max(...bands.map((b) => b.log_rms ?? 0), 1e-12);
  const text = most < 0.3 ? percent : (x) => significant(x, 3);  // one form for all of them
  const bar = (b) => (known(b.log_rms) ? el("span", { class: "bar", style: { width: `${Math.round(70 * b.log_rms / most)}px` } }) : "");
  const band_tables = [...new Set(bands.map((b) => b.angle))].map((angle) => table(
    [el("span", {}, angle_name(angle), " [°]"), { n: "values" }, { n: "RMS [1/sr]" }, { n: "log RMS" }, ""],
    bands.filter((b) => b.angle === angle).map((b) => [`${plain(b.from_deg, 3)}–${plain(b.to_deg, 3)}`,
      { n: count(b.values) }, ...(b.values > 0
        ? [{ n: significant(b.rms, 2) }, { n: known(b.log_rms) ? text(b.log_rms) : "–" }, bar(b)]
        : [{ n: "–" }, { n: "–" }, ""])])));
  return section("Where the model is off",
    "Each cell compares model and data by their ratio, over all channels and all valid positive values in it. Blue: the model is too dark; orange: too bright.",
    el("div", { class: "columns map" },
      el("div", {},
        el("div", { class: "controls" }, choice("Shown", [["mean", "mean ratio"], ["rms", "RMS"]], "mean", (w) => map.set(w))),
        map.node, el("p", { class: "small muted", "aria-hidden": "true" }, map_text())),
      el("div", { class: "bands" }, band_tables.map((t) => el("div", { class: "scroll", style: { "margin-bottom": "18px" } }, t)))));
}

// --- Light that comes back -------------------------------------------------------------------------
function albedo() {
  const p = fit.physics;
  if (!p?.theta_i_deg.length) return null;
  const most = 4;  // channels that are told apart at a glance
  const shown = channels.length <= most ? channels.map((_, c) => c)
    : Array.from({ length: most }, (_, k) => Math.round(k * (channels.length - 1) / (most - 1)));
  const of = (rows, c) => rows.map((row) => list_of(row)[c] ?? null);
  const x = p.theta_i_deg, above = (v) => known(v) && v > 1.001, all_model = p.model_albedo.flat(), all_data = p.data_albedo.flat();
  const has_data = all_data.some(known);
  let top = [0, 0];  // angle and channel where the model is brightest
  p.model_albedo.forEach((row, k) => list_of(row).forEach((v, c) => { if (v > list_of(p.model_albedo[top[0]])[top[1]]) top = [k, c]; }));
  const [brightest, data_there] = [p.model_albedo, p.data_albedo].map((rows) => list_of(rows[top[0]])[top[1]]);
  const share = (v) => significant(v, v > 0.995 && v < 1.095 ? 4 : 3);
  const words = `The fitted model returns at most ${share(brightest)} of the light, at θ_i ${degrees(x[top[0]])}`
    + (known(data_there) ? `; there the table returns ${share(data_there)}.` : ".")
    + (above(brightest) ? " Above 1 more light leaves than arrives: no surface does that." : "");
  const ratios = (p.peak_ratio ?? []).filter(known);
  const peaks = ratios.length ? ` At the table's own samples the model's greatest value is ${[...new Set([Math.min(...ratios), Math.max(...ratios)].map((r) => plain(r, 2)))].join(" to ")} times the table's.` : "";
  const one = Math.max(...all_model, ...all_data.filter(known)) > 0.8;  // else the line is far above all
  const plot = curve_plot([x, ...(has_data ? shown.map((c) => of(p.data_albedo, c)) : []), ...shown.map((c) => of(p.model_albedo, c)), ...(one ? [x.map(() => 1)] : [])],
    [...(has_data ? shown.map((c) => ({ color: channel_color(channels[c], c), kind: "points" })) : []),
     ...shown.map((c) => ({ color: several ? channel_color(channels[c], c) : "ink", kind: "line" })), ...(one ? [{ color: "grey", kind: "line", width: 1, dash: [4, 4] }] : [])],
    { x_label: "θ_i [°], incident angle", x_ends: [0, 90], y_label: "share of the light", log: false, height: 280, y_of: () => true, text: words });
  // Of many angles those that stand apart, and where it is brightest.
  const rows = x.length <= 12 ? x.map((_, k) => k)
    : [...new Set([...[0, 10, 20, 30, 40, 50, 60, 70, 80, 85].map((deg) => x.reduce((best, v, k) => (Math.abs(v - deg) < Math.abs(x[best] - deg) ? k : best), 0)), top[0]])].sort((a, b) => a - b);
  const cell = (v) => ({ n: above(v) ? el("span", { class: "told" }, share(v) + ", above 1") : known(v) ? share(v) : "–" });
  const head = shown.flatMap((c) => [{ n: `model${several ? " " + channels[c] : ""}` }, ...(has_data ? [{ n: `table${several ? " " + channels[c] : ""}` }] : [])]);
  return section("Light that comes back",
    "Share of the light from one direction that all directions together return, by the angle it comes from: the fitted model"
      + (has_data ? " beside the table. Where half of the directions or more lack, the table does not say." : "; this table does not say its own."),
    el("p", {}, words + peaks),
    el("div", { class: "columns light" },
      el("figure", {}, el("figcaption", {}, el("span", { class: "keys" },
        several ? shown.map((c) => el("span", {}, chip(channel_color(channels[c], c)), channels[c]))
          : [has_data ? el("span", {}, chip(channel_color(channels[0], 0)), "table") : null, el("span", {}, chip("ink"), "model")]),
        el("small", {}, " ", [several ? "lines: model" : null, several && has_data ? "points: table" : null, one ? "dashed: all of the light" : null].filter(Boolean).join(", "))), plot.node),
      scroll(table([el("span", {}, angle_name("theta_i"), " [°]"), ...head],
        rows.map((k) => [plain(Number(x[k].toFixed(1)), 3), ...shown.flatMap((c) => [cell(list_of(p.model_albedo[k])[c]), ...(has_data ? [cell(list_of(p.data_albedo[k])[c])] : [])])])))));
}

// --- How sure -------------------------------------------------------------------------------------
function strongest_correlation() {
  const { names, correlations } = fit.identifiability;
  let best = null;
  names.forEach((a, i) => names.slice(0, i).forEach((b, j) => {
    const rho = correlations[i]?.[j];
    if (known(rho) && (best === null || Math.abs(rho) > Math.abs(best.rho))) best = { a: b, b: a, rho };
  }));
  return best;
}
function correlation_matrix() {
  const { names, correlations } = fit.identifiability;
  const cell = (rho, i, j) => {
    if (j > i) return el("td");
    if (i === j) return el("td", { class: "muted" }, "1");
    if (!known(rho)) return el("td", {}, "–");
    const share = Math.round(70 * Math.abs(rho));
    return el("td", { style: { background: `color-mix(in srgb, var(--${rho < 0 ? "low-1" : "high-1"}) ${share}%, transparent)` } },
      minus(rho.toFixed(2)));
  };
  return el("table", { class: "matrix" },
    el("caption", {}, "Correlation of the estimates"),
    el("tbody", {}, names.map((name, i) => el("tr", {}, el("th", { scope: "row" }, el("code", {}, name)),
      names.slice(0, i + 1).map((_, j) => cell(correlations[i]?.[j], i, j)))),
      el("tr", {}, el("th"), names.map((name) => el("td", { class: "muted" }, el("code", {}, name))))));
}
function confidence() {
  const sensitivity = (fit.bin_sensitivity ?? []).map((s) => table(
    ["", { n: "relative change" }],
    [...Object.entries(s.relative_change).map(([name, v]) => [el("code", {}, name), { n: list_of(v).map((x) => (known(x) ? signed_percent(x) : "–")).join(", ") }]),
     ["log RMS then", { n: log_rms_text(s.log_rms) }]],
    { caption: `If samples sat at the ${s.other} of their bins` }));
  const tied = strongest_correlation();
  if (fit.identifiability.names.length === 0) return null;  // nothing was fitted
  return section("How well the parameters are separated",
    `Condition number of the scaled normal matrix: ${significant(fit.identifiability.condition)}.`
      + (tied ? ` The pair hardest to tell apart: ${tied.a} and ${tied.b}, correlation ${minus(tied.rho.toFixed(3))}.` : ""),
    el("div", { class: "columns" },
      fit.identifiability.names.length > 1 ? scroll(correlation_matrix()) : null,
      sensitivity.map((t) => scroll(t))));
}

// --- Whether another optimum lies lower -----------------------------------------------------------------
/// Axis of the search: its cells reach half way to the next, by ratio where they are spread so.
function search_axis(name, at) {
  const by_ratio = at[0] > 0;
  const [to, back] = by_ratio ? [Math.log, Math.exp] : [Math.sqrt, (x) => x * x];
  const x = at.map(to), half = (x[1] - x[0]) / 2, first = x[0] - half, last = x.at(-1) + half;
  const edges = [...x.map((v) => back(Math.max(by_ratio ? -Infinity : 0, v - half))), back(last)];
  const [low, high] = [edges[0], edges.at(-1)];
  const steps = by_ratio && high / low > 30 ? [1] : [1, 2, 5];
  const ticks = Array.from({ length: 9 }, (_, k) => 10 ** (k - 5)).flatMap((p) => steps.map((s) => s * p)).filter((t) => t >= low && t <= high);
  return { name, edges, at, label: name, unit: "", ends: [low, high], ticks, few: ticks.filter((_, i) => i % 2 === 0),
    part: (v) => (to(v) - to(low)) / (to(high) - to(low)), value: (part) => back(to(low) + part * (to(high) - to(low))) };
}
/// Number of the place next to a value.
const next_to = (at, value) => at.reduce((best, a, i) => (Math.abs(Math.log(a / value)) < Math.abs(Math.log(at[best] / value)) ? i : best), 0);
function search_words(c) {
  const moved = c.moves > 0 ? ` The fit went on ${many(c.moves, "time")} from a place that was lower.` : "";
  const lies = c.lowest >= fit.cost * (1 - 1e-6);
  return `${count(c.cells.length)} cells over ${c.parameters.join(" and ")}, all other parameters solved for anew in each on a thinned table; those within 1 % `
    + `of the lowest again with all values. ${lies ? "None lies below the fit" : "One lies below the fit"}: the lowest costs ${significant(c.lowest, 6)}, the fit ${significant(fit.cost, 6)}.`
    + `${moved} This is a search and no proof.`;
}
function search() {
  const c = fit.certificate;
  if (!c) return null;
  if (!c.cells.length) return section("Whether another optimum lies lower", "No width, exponent or index is free: nothing was searched.");
  const least = Math.min(c.thinned_cost, ...c.cells.map((cell) => cell.cost).filter(known));
  const above = c.cells.map((cell) => (known(cell.cost) && least > 0 ? Math.max(1, cell.cost / least) : null));
  const fitted = c.parameters.map((name) => list_of(fit.parameters[name]?.value ?? null)[0]);
  const places = c.parameters.map((_, a) => [...new Set(c.cells.map((cell) => cell.at[a]))]);
  const draw = () => {
    if (places.length === 1) {
      const plot = curve_plot([places[0], above], [{ color: "accent", kind: "both" }], {
        x_label: c.parameters[0], x_log: places[0][0] > 0, y_label: "least cost, relative to the lowest", log: true, height: 300,
        mark: known(fitted[0]) ? fitted[0] : null, y_of: () => true, text: search_words(c) });
      return el("figure", {}, el("figcaption", {}, "Least cost at each ", el("code", {}, c.parameters[0]),
        known(fitted[0]) ? el("small", {}, " dashed: the fitted value") : null), plot.node);
    }
    const axes = c.parameters.map((name, a) => search_axis(name, places[a]));
    const sizes = above.filter(known).map(Math.log10).sort((a, b) => a - b);
    const limit = Math.max(sizes[Math.floor(0.95 * (sizes.length - 1))] ?? 0, 0.01);
    const here = fitted.every(known) ? fitted.map((v, a) => next_to(places[a], v)) : null;
    const chosen = here ? here[0] * places[1].length + here[1] : -1;
    const map = heat_map(axes[0], axes[1], { cost: {
      at: (k) => (known(above[k]) ? Math.min(1, Math.log10(above[k]) / limit) : null), colors: sequential,
      label: "least cost of the cell, relative to the lowest", text: (k) => (k === chosen ? "fit" : null),
      ticks: [0, 0.5, 1].map((t) => [t, (t === 1 ? "≥ " : "") + "×\u202f" + significant(10 ** (t * limit), 3)]) } },
      (k) => [el("b", {}, known(above[k]) ? `×\u202f${significant(above[k], 4)} the lowest cost` : "no finite cost"),
        known(c.cells[k].cost_all) ? `, ${significant(c.cells[k].cost_all, 6)} with all values` : ""], search_words(c));
    return map.node;
  };
  return section("Whether another optimum lies lower", search_words(c), draw());
}

// --- Solver and input ---------------------------------------------------------------------------------
function solver() {
  const s = fit.solver;
  const phases = Object.entries(s.time_ms), total = phases.reduce((a, [, t]) => a + t, 0);
  const tones = ["accent", "grey", "green", "extra", "red", "low-1", "high-1"];
  const name = (key) => words(key.replace(/_ms$/, ""));
  const times = total > 0 ? el("div", {},
    el("h3", {}, `Time, ${milliseconds(total)}`),
    el("div", { class: "phases", "aria-hidden": "true" }, phases.map(([, t], i) => el("span", { style: { flex: `${t} 0 0`, background: `var(--${tones[i % tones.length]})` } }))),
    table(["", { n: "time" }, { n: "share" }], phases.map(([key, t], i) => [
      el("span", {}, chip(tones[i % tones.length]), name(key)), { n: milliseconds(t) }, { n: percent(t / total) }]))) : null;
  const cost = s.cost_per_iteration;
  const span = cost.length > 1 ? Math.max(...cost) / Math.min(...cost) - 1 : 0;
  const plot = span > 0.01 ? curve_plot([cost.map((_, i) => i), cost], [{ color: "accent", kind: "line" }], {
    x_label: "iteration", y_label: "cost", height: 200, log: cost.every((c) => c > 0), y_of: () => true, text:
      `Cost over ${many(cost.length - 1, "step")}, from ${significant(cost[0])} to ${significant(cost.at(-1))}.` }) : null;
  return section("How the solver got there", s.message,
    el("div", { class: "columns" },
      plot ? el("figure", {}, el("figcaption", {}, "Cost per iteration ", el("small", {}, `${significant(cost[0])} → ${significant(fit.cost)}`)), plot.node)
        : cost.length > 1 ? el("p", {}, `The cost changed by ${percent(span)} over ${many(cost.length - 1, "step")}: too little to draw.`) : null,
      times,
      pairs([["termination", words(s.termination)], ["iterations", count(s.iterations)], ["cost", significant(fit.cost, 6)],
        ["instruction set", s.instruction_set], ["passes over the data", known(s.passes) ? count(s.passes) : null],
        ["metric", words(fit.metric)], ["log offset", fit.log_offset > 0 ? `${significant(fit.log_offset)} 1/sr` : null],
        ["robust loss", words(fit.robust)]])));
}
function input() {
  const i = fit.input;
  return section("Input", null, pairs([
    ["file", el("code", {}, i.path)], ["SHA-256", el("code", {}, i.sha256)], ["format", i.format],
    ["bins", i.bins === "none" ? "none: samples are points" : `samples at the ${i.bins} of their bins`],
    ["values used", count(i.values_used)],
    ["left out", Object.entries(i.masked).filter(([, n]) => n > 0).map(([why, n]) => `${count(n)} ${words(why)}`).join(", ") || "none"],
  ]));
}

document.getElementById("page").replaceChildren(
  el("p", { class: "over" }, "gonio fit"),
  el("h1", {}, `${fit.model} fitted to ${file_name}`),
  verdict(), ...[warnings(), next_steps()].filter(Boolean), facts(),
  ...[parameters(), curve_section(), spheres_section(page.spheres, "fit"), residuals(), albedo(), search(), confidence(), health_section(), solver(), input()].filter(Boolean),
  el("footer", {}, "f_r is in 1/sr, without the cosine. alpha is the width of the distribution, roughness = √alpha. ",
    "Every figure of this page is in its data block, and the fit's in fit.json. Plots drawn with uPlot, © Leon Sorokin, MIT licence."));
