"use strict";
// The report on Schlick's approximation: how far each form is from exact Fresnel reflectance.

const { rows, map, maps, curve_theta_deg, curves, roughness, albedos, colours, findings, full } = page_data();
const short = (form) => form.replace(/^fresnel\./, "");
const greatest = (list, key) => list.reduce((a, b) => (key(b) > key(a) ? b : a));
const median = (list) => { const s = [...list].sort((a, b) => a - b); return s.length ? s[Math.floor(s.length / 2)] : null; };
const of_kind = group_by(rows, (r) => r.kind);
const forms = unique(rows.map((r) => r.form));
const is_grid = (r) => r.name.startsWith("IOR ");
const grid = (kind, form) => of_kind.get(kind).filter((r) => r.form === form && is_grid(r)).map((r) => ({ ...r, ior: kind === "dielectric" ? r.eta : 1 / r.eta }));
const points = (x) => significant(x, 2);
const place = (r) => `${r.name}, ${degrees(r.max_abs_theta_deg)}`;
const nothing = (x) => known(x) && Math.abs(x) < 1e-9;
const none = { n: "–" };
const number = (x, title) => ({ n: el("span", { title }, nothing(x) ? "0" : points(x)) });

// --- Every form in a line ------------------------------------------------------------------------------------
function summary() {
  const of = (kind, form) => of_kind.get(kind)?.filter((r) => r.form === form) ?? [];
  const cells = (form) => {
    const worst = (kind) => {
      const list = of(kind, form);
      if (!list.length) return none;
      const most = greatest(list, (r) => r.max_abs);
      return number(most.max_abs, place(most));
    };
    const glass = of("dielectric", form).find((r) => r.name === "IOR 1.5"), metals = of("metal", form);
    return [glass ? number(glass.max_abs, degrees(glass.max_abs_theta_deg)) : none, glass ? number(glass.rms) : none,
      glass ? { n: nothing(glass.max_rel) ? "0" : el("span", { title: degrees(glass.max_rel_theta_deg) }, percent(glass.max_rel)) } : none,
      worst("dielectric"), worst("dielectric_inside"),
      worst("metal"), metals.length ? number(median(metals.map((r) => r.rms))) : none, worst("spectral")];
  };
  return section("Every form in a line", "F of the form less the exact F. F0 is the exact one; of the forms that have more to set, F82 has its tint from the exact value at 82°, F90 and Lazányi's correction are fitted to each "
    + "surface, the index forms have the index. Where it is worst stands under the pointer.",
    scroll(table(["form", { n: "IOR 1.5, most" }, { n: "RMS" }, { n: "relative" }, { n: "IOR 1.01–3, most" }, { n: "from inside, most" }, { n: "metals, most" }, { n: "median RMS" }, { n: "in linear RGB, most" }],
      forms.map((form) => [el("code", {}, short(form)), ...cells(form)]))));
}

// --- Angle and index --------------------------------------------------------------------------------------------
const sides = [["dielectric", "from outside"], ["dielectric_inside", "from inside"]];
function edges_of(at) {
  const step = at[1] - at[0];
  return [...at.map((x) => x - step / 2), at.at(-1) + step / 2];
}
function error_map(form, kind, relative) {
  const find = (name) => maps.find((m) => m.kind === kind && m.form === name);
  const exact = find("exact").error, error = find(form).error, ny = map.ior.length, nx = map.theta_deg.length;
  const ior = edges_of(map.ior), theta = edges_of(map.theta_deg);
  const x = { ...map_axis("theta_d", theta), label: "θ [°], angle from the facet's normal" };
  const y = { name: "IOR", at: map.ior, edges: ior, label: "index of refraction", unit: "", ends: [ior[0], ior.at(-1)], part: (v) => (v - ior[0]) / (ior.at(-1) - ior[0]),
              value: (p) => ior[0] + p * (ior.at(-1) - ior[0]), ticks: [1, 1.5, 2, 2.5, 3], few: [1, 2, 3] };
  // cells by angle, the data by index; small errors are seen beside great ones: the scale grows as the square
  const of = (k) => Math.floor(k % ny) * nx + Math.floor(k / ny);
  const value = (k) => error[of(k)] / (relative ? exact[of(k)] : 1);
  const at = (v) => (Math.sign(v) * Math.sqrt(Math.min(1, Math.abs(v))) + 1) / 2;
  const worst = Math.max(...error.map(Math.abs));
  return heat_map(x, y, { error: { at: (k) => at(value(k)), colors: () => diverging(), label: relative ? "(F − exact)/exact" : "F − exact",
    ticks: [-1, -0.3, -0.05, 0, 0.05, 0.3, 1].map((v) => [at(v), relative ? `${minus(String(100 * v))}\u202f%` : minus(String(v))]) } },
    (k) => ["F ", el("b", {}, significant(exact[of(k)] + error[of(k)], 4)), ", exact ", el("b", {}, significant(exact[of(k)], 4)), ", error ", el("b", {}, significant(error[of(k)], 3)),
      ` (${signed_percent(error[of(k)] / exact[of(k)])})`],
    `Error of ${short(form)} by angle and index of refraction, at most ${significant(worst, 3)}.`).node;
}
function over_index(form, kind) {
  const curve = (key, name, color, dash) => { const list = grid(kind, form); return { name, x: list.map((r) => r.ior), y: list.map((r) => r[key]), color, dash }; };
  const reference = grid(kind, "fresnel.schlick");
  return lines_figure([...(form === "fresnel.schlick" ? [] : [{ name: "schlick, most", x: reference.map((r) => r.ior), y: reference.map((r) => r.max_abs), color: "grey", dash: [5, 3] }]),
    curve("max_abs", "most |error|", "accent"), curve("rms", "RMS", "green")],
    { title: "Error by index", x_label: "index of refraction", y_label: "error of F", x_ends: [1, 3], height: 290, scale: true, log: true, text: `Error of ${short(form)} over the index of refraction.`, y_text: points });
}
function by_index() {
  let kind = "dielectric", form = "fresnel.schlick", relative = false;
  const panels = changing(() => {
    const names = unique(of_kind.get(kind).map((r) => r.form));
    if (!names.includes(form)) form = "fresnel.schlick";
    return el("div", {}, el("div", { class: "controls" },
      chooser("Form", names.map((f) => [f, short(f)]), form, (f) => { form = f; panels.again(); }),
      choice("Side", sides, kind, (k) => { kind = k; panels.again(); }),
      choice("Error", [[false, "absolute"], [true, "relative"]], relative, (r) => { relative = r; panels.again(); })),
      el("div", { class: "columns map" }, el("figure", {}, el("figcaption", {}, "F − exact ", el("small", {}, "by angle and index; the scale of colours grows as the square")), error_map(form, kind, relative)),
        over_index(form, kind)));
  });
  return section("By angle and index", "Dielectrics, the light in air or in the denser medium. From inside all is reflected beyond the critical angle; forms that are asked at the angle within the medium know nothing of it.", panels.node);
}

/// Forms that come to the same on a surface are one curve.  \param list  [{form, y}]
function distinct(list) {
  const out = [];
  for (const c of list) {
    const same = out.find((o) => o.y.every((v, i) => Math.abs(v - c.y[i]) < 1e-9));
    if (same) same.name += " = " + short(c.form);
    else out.push({ ...c, name: short(c.form) });
  }
  return out.map((c, i) => ({ ...c, color: c.form === "exact" ? "ink" : line_colors[i % line_colors.length], width: c.form === "exact" ? 2.4 : undefined, dash: i < 6 ? null : [5, 3] }));
}

// --- Materials ----------------------------------------------------------------------------------------------------
const kind_names = { dielectric: "at 550 nm", dielectric_inside: "from inside", metal: "three wavelengths", spectral: "spectrum in linear RGB" };
function materials() {
  let material = "aluminium", kind = "metal", channel = "red";
  const panels = changing(() => {
    const own = curves.filter((c) => c.material === material), kinds = unique(own.map((c) => c.kind));
    if (!kinds.includes(kind)) kind = kinds[0];
    const channels = unique(own.filter((c) => c.kind === kind).map((c) => c.channel));
    if (!channels.includes(channel)) channel = channels[0];
    const list = own.filter((c) => c.kind === kind && c.channel === channel), exact = list.find((c) => c.form === "exact");
    const drawn = distinct([...list.filter((c) => c !== exact), exact].map((c) => ({ form: c.form, x: curve_theta_deg, y: c.value })));
    const own_name = drawn.find((c) => c.y.every((v, i) => Math.abs(v - exact.value[i]) < 1e-9));
    Object.assign(own_name, { name: own_name.form === "exact" ? "exact" : `exact = ${own_name.name.replace(" = exact", "")}`, color: "ink", width: 2.4, dash: null });
    return el("div", {}, el("div", { class: "controls" },
      chooser("Material", unique(curves.map((c) => c.material)).map((m) => [m, m]), material, (m) => { material = m; panels.again(); }),
      choice("What of it", kinds.map((k) => [k, kind_names[k]]), kind, (k) => { kind = k; panels.again(); }),
      channels.length > 1 ? choice("Channel", channels.map((c) => [c, c]), channel, (c) => { channel = c; panels.again(); }) : null),
      el("div", { class: "columns" },
        lines_figure(drawn,
          { title: "F(θ)", x_label: "θ [°]", y_label: "F", x_ends: [0, 90], height: 330, text: `Reflectance of ${material} by angle.`, y_text: (y) => significant(y, 4), hint: "Point at a curve to read all of them." }),
        lines_figure(drawn.filter((c) => c !== own_name && !c.form.includes("linear")).map((c) => ({ ...c, y: c.y.map((v, i) => v - exact.value[i]) })),
          { title: "F − exact", note: "without the linear form", x_label: "θ [°]", y_label: "error", x_ends: [0, 90], height: 330, text: `Errors of the forms for ${material} by angle.`, y_text: (y) => significant(y, 3) })));
  });
  return section("One material", "Exact against every form.", panels.node);
}
function material_table() {
  const keys = { max_abs: "most |error|", max_rel: "relative, most", rms: "RMS" };
  let key = "max_abs", kind = "metal";
  const body = changing(() => {
    const list = of_kind.get(kind).filter((r) => !is_grid(r)), names = unique(list.map((r) => r.form));
    const text = (r) => (nothing(r[key]) ? "0" : key === "max_rel" ? percent(r[key]) : points(r[key]));
    const angle = (r) => (key === "max_rel" ? r.max_rel_theta_deg : r.max_abs_theta_deg);
    return el("div", {}, el("div", { class: "controls" },
      choice("What", [["metal", "metals, three wavelengths"], ["dielectric", "dielectrics at 550 nm"], ["dielectric_inside", "from inside"], ["spectral", "spectra in linear RGB"]], kind, (k) => { kind = k; body.again(); }),
      choice("Error", Object.entries(keys), key, (k) => { key = k; body.again(); })),
      scroll(table(["", ...names.map((n) => ({ n: short(n) }))], [...group_by(list, (r) => r.material)].map(([material, own]) =>
        [material, ...names.map((n) => { const worst = greatest(own.filter((r) => r.form === n), (r) => r[key]);
          return { n: el("span", { title: `${worst.name}, ${key === "rms" ? "all angles" : degrees(angle(worst))}` }, text(worst)) }; })]))));
  });
  return section("Named materials", "The worst channel of each; channel and angle under the pointer. In linear RGB the truth is the spectrum's colour; F0 is that colour, cut to the gamut; the form of three wavelengths is the exact equation at 650, 550 and "
    + "450 nm for red, green and blue.", body.node);
}

// --- Rough surfaces ---------------------------------------------------------------------------------------------------
function rough() {
  if (!albedos.length) return null;
  let material = "aluminium", mu = 0.5, channel = "red";
  const panels = changing(() => {
    const own = albedos.filter((a) => a.material === material), channels = unique(own.map((a) => a.channel));
    if (!channels.includes(channel)) channel = channels[0];
    const list = own.filter((a) => a.channel === channel && a.mu === mu);
    const shown = (l) => l.filter((a) => !/linear|gulbrandsen/.test(a.form));
    const curve = (off) => distinct(shown(list).map((a) => ({ form: a.form, x: roughness, y: a.albedo.map((v, k) => off(v, a.exact[k])) })));
    const figure = (title, y_label, off, y_text) => lines_figure(curve(off), { title, x_label: "roughness", y_label, x_ends: [0, 1], height: 300, text: `${title} of ${material} over roughness.`, y_text });
    return el("div", {}, el("div", { class: "controls" },
      chooser("Material", unique(albedos.map((a) => a.material)).map((m) => [m, m]), material, (m) => { material = m; panels.again(); }),
      channels.length > 1 ? choice("Channel", channels.map((c) => [c, c]), channel, (c) => { channel = c; panels.again(); }) : null,
      choice("Angle", unique(albedos.map((a) => a.mu)).map((m) => [m, m === 1 ? "μ = 1" : `μ = ${plain(m)}`]), mu, (m) => { mu = m; panels.again(); })),
      el("div", { class: "panels" }, figure("E − exact", "error of E", (v, e) => v - e, (y) => significant(y, 3)),
        figure("E/exact − 1", "relative error", (v, e) => v / e - 1, (y) => signed_percent(y)),
        lines_figure(distinct(shown(colours.filter((c) => c.material === material && c.mu === mu)).map((c) => ({ form: c.form, x: roughness, y: c.delta_e }))),
          { title: "ΔE2000", note: "of the colours under D65, all channels", x_label: "roughness", y_label: "ΔE2000", x_ends: [0, 1], height: 300, text: `Colour difference of ${material} over roughness.`, y_text: (y) => significant(y, 3) })));
  });
  return section("What it does to a rough surface", "Directional albedo E(μ) of GGX under Smith masking, correlated, single scattering, with the form in place of the exact F; the linear form, and Gulbrandsen's, which is exact, are left out. "
    + `Every E is known to ${significant(Math.max(...albedos.map((a) => a.error_bound)), 1)} or better.`, panels.node);
}

document.getElementById("page").replaceChildren(...[
  el("p", { class: "over" }, "gonio report schlick"), el("h1", {}, "Schlick’s approximation and its kin against exact Fresnel"),
  el("div", { class: "verdict" }, findings.map((f) => el("p", {}, f))),
  summary(), by_index(), materials(), material_table(), rough(),
  el("footer", {}, `${full ? "Full" : "Quick"} setting. RMS over equal steps of θ from 0 to 90°. The exact F is computed in double, so that it is off by less than what is printed. Every figure of this page is in its data block and in the .json beside it.`)].filter(Boolean));
