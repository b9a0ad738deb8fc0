"use strict";
// The report on Schlick's approximation: how far each form is from exact Fresnel reflectance.

const { rows, figures, maps, albedo_error_bound, findings, full } = page_data();
const short = (form) => form.replace(/^fresnel\./, "");
const greatest = (list, key) => list.reduce((a, b) => (key(b) > key(a) ? b : a));
const median = (list) => { const s = [...list].sort((a, b) => a - b); return s.length ? s[Math.floor(s.length / 2)] : null; };
const of_kind = group_by(rows, (r) => r.kind);
const forms = unique(rows.map((r) => r.form));
const is_grid = (r) => r.name.startsWith("IOR ");
const points = (x) => significant(x, 2);
const place = (r) => `${r.name}, ${degrees(r.max_abs_theta_deg)}`;
const nothing = (x) => known(x) && Math.abs(x) < 1e-9;
const none = { n: "–" };
most_shipped = ["schlick", "schlick.ue", "schlick.f90", "f82", "schlick.spherical_gaussian", "lazanyi, corrected"];
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
    in_cards(table(["form", { n: "IOR 1.5, most" }, { n: "RMS" }, { n: "relative" }, { n: "IOR 1.01–3, most" }, { n: "from inside, most" }, { n: "metals, most" }, { n: "median RMS" }, { n: "in linear RGB, most" }],
      forms.map((form) => [form_cell(form), ...cells(form)]))));
}

// --- Angle and index --------------------------------------------------------------------------------------------
function error_map(form, side, relative) {
  const [absolute, share, exact] = ["error_by_angle", "relative_error_by_angle", "exact_reflectance"]
    .map((family) => picture_of(maps, family, family === "exact_reflectance" ? { side } : { form, side }));
  return map_view(relative ? share : absolute, { value_text: relative ? signed_percent : (v) => significant(v, 3), say: (k) => [": F ", el("b", {}, significant(exact.values[k] + absolute.values[k], 4)), ", exact ",
    el("b", {}, significant(exact.values[k], 4)), relative ? `, error ${significant(absolute.values[k], 3)}` : ` (${signed_percent(share.values[k])})`] });
}
function by_index() {
  let side = "from outside", form = "schlick", relative = false;
  const panels = changing(() => {
    const names = choices_of(maps, "error_by_angle", "form", { side });
    if (!names.includes(form)) form = "schlick";
    return el("div", {}, el("div", { class: "controls" },
      chooser("Form", names.map((f) => [f, named_short(f)]), form, (f) => { form = f; panels.again(); }),
      choice("Side", choices_of(maps, "error_by_angle", "side").map((s) => [s, s]), side, (s) => { side = s; panels.again(); }),
      choice("Error", [[false, "absolute"], [true, "relative"]], relative, (r) => { relative = r; panels.again(); })),
      el("div", { class: "columns map" }, error_map(form, side, relative),
        figure_view(picture_of(figures, "error_by_index", { form, side }), { height: 290, y_text: points })));
  }, () => small_pictures(figures.filter((f) => f.family === "error_by_index")));
  return section("By angle and index", "Dielectrics, the light in air or in the denser medium. From inside all is reflected beyond the critical angle; forms that are asked at the angle within the medium know nothing of it.", panels.node);
}

// --- Materials ----------------------------------------------------------------------------------------------------
function materials() {
  let material = "aluminium", kind = "three wavelengths", channel = "red";
  const panels = changing(() => {
    const kinds = choices_of(figures, "reflectance", "kind", { material });
    if (!kinds.includes(kind)) kind = kinds[0];
    const channels = choices_of(figures, "reflectance", "channel", { material, kind });
    if (!channels.includes(channel)) channel = channels[0];
    const chosen = { material, kind, channel };
    return el("div", {}, el("div", { class: "controls" },
      chooser("Material", choices_of(figures, "reflectance", "material").map((m) => [m, m]), material, (m) => { material = m; panels.again(); }),
      choice("What of it", kinds.map((k) => [k, k]), kind, (k) => { kind = k; panels.again(); }),
      channels.length > 1 ? choice("Channel", channels.map((c) => [c, c]), channel, (c) => { channel = c; panels.again(); }) : null),
      el("div", { class: "columns" }, figure_view(picture_of(figures, "reflectance", chosen), { height: 330, y_text: (y) => significant(y, 4) }),
        figure_view(picture_of(figures, "reflectance_error", chosen), { height: 330 })));
  }, () => small_pictures([...group_by(figures.filter((f) => f.family === "reflectance_error"), (f) => f.choices.material)].map(([, list]) => list[0])));
  return section("One material", "Exact against every form.", panels.node);
}
function material_table() {
  const keys = { max_abs: "most |error|", max_rel: "relative, most", rms: "RMS" };
  const kinds = [["metal", "metals, three wavelengths"], ["dielectric", "dielectrics at 550 nm"], ["dielectric_inside", "from inside"], ["spectral", "spectra in linear RGB"]];
  let key = "max_abs", kind = "metal";
  const of = (kind, key) => {
    const list = of_kind.get(kind).filter((r) => !is_grid(r)), names = unique(list.map((r) => r.form));
    const text = (r) => (nothing(r[key]) ? "0" : key === "max_rel" ? percent(r[key]) : points(r[key]));
    const angle = (r) => (key === "max_rel" ? r.max_rel_theta_deg : r.max_abs_theta_deg);
    return in_cards(table(["", ...names.map((n) => ({ n: named(n) }))], [...group_by(list, (r) => r.material)].map(([material, own]) =>
      [material, ...names.map((n) => { const worst = greatest(own.filter((r) => r.form === n), (r) => r[key]);
        return { n: el("span", { title: `${worst.name}, ${key === "rms" ? "all angles" : degrees(angle(worst))}` }, text(worst)) }; })])));
  };
  const body = changing(() => el("div", {}, el("div", { class: "controls" },
    choice("What", kinds, kind, (k) => { kind = k; body.again(); }),
    choice("Error", Object.entries(keys), key, (k) => { key = k; body.again(); })), of(kind, key)),
  () => kinds.filter(([k]) => k !== kind).map(([k, words]) => [el("h3", {}, `${words}: ${keys[key]}`), of(k, key)]));
  return section("Named materials", "The worst channel of each; channel and angle under the pointer. In linear RGB the truth is the spectrum's colour; F0 is that colour, cut to the gamut; the form of three wavelengths is the exact equation at 650, 550 and "
    + "450 nm for red, green and blue.", body.node);
}

// --- Rough surfaces ---------------------------------------------------------------------------------------------------
function rough() {
  const materials = choices_of(figures, "albedo_error", "material");
  if (!materials.length) return null;
  let material = "aluminium", mu = "0.5", channel = "red";
  const panels = changing(() => {
    const channels = choices_of(figures, "albedo_error", "channel", { material });
    if (!channels.includes(channel)) channel = channels[0];
    const view = (family, choices) => figure_view(picture_of(figures, family, choices), { height: 300 });
    return el("div", {}, el("div", { class: "controls" },
      chooser("Material", materials.map((m) => [m, m]), material, (m) => { material = m; panels.again(); }),
      channels.length > 1 ? choice("Channel", channels.map((c) => [c, c]), channel, (c) => { channel = c; panels.again(); }) : null,
      choice("Angle", choices_of(figures, "albedo_error", "mu").map((m) => [m, `μ = ${m}`]), mu, (m) => { mu = m; panels.again(); })),
      el("div", { class: "panels" }, view("albedo_error", { material, channel, mu }), view("albedo_relative_error", { material, channel, mu }), view("colour_difference", { material, mu })));
  }, () => small_pictures(figures.filter((f) => f.family === "colour_difference" && f.choices.mu === mu)));
  return section("What it does to a rough surface", "Directional albedo E(μ) of GGX under Smith masking, correlated, single scattering, with the form in place of the exact F. Of metals the truth is the colour of the whole spectrum in linear RGB, and F0 is that colour. The linear form and Gulbrandsen's are left out. "
    + `Every E is known to ${significant(albedo_error_bound, 1)} or better.`, panels.node);
}

// What a reader sees of it, on a metal that shows it.
const first = ["iron", ...choices_of(figures, "colour_difference", "material")].map((material) => picture_of(figures, "colour_difference", { material, mu: "0.1" })).find(Boolean) ?? figures[0];
show_report({
  command: "report schlick", title: "Schlick's approximation and its kin against exact Fresnel", findings, first: first && figure_view(first, { height: 300, copy: true }),
  sections: [summary(), by_index(), materials(), material_table(), rough()],
  setting: `${full ? "Full" : "Quick"} setting. RMS over equal steps of θ from 0 to 90°. The exact F is computed in double, so that it is off by less than what is printed. Every figure of this page is in its data block and in the .json beside it.`,
});
