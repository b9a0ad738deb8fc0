// The same sphere as the table has it and as models have it, under three lights, and what is seen of the difference.

const sphere_scale = { steps: 25, not_covered: 254, limit: 1, max: 10 };
const share_covered = (x) => (x < 1 && x > 0.995 ? "> 99\u202f%" : percent(x));
const delta_e = (x) => (x < 0.005 ? "0" : x < 1 ? x.toFixed(2) : significant(x, 2));

/// \param name     what the page calls a model: "fit", or where there are several null, for their own names, numbered
/// \param at_once  of several, those that are shown before a reader asks for more
function spheres_section(spheres, name, at_once = spheres.models.length) {
  const title = "The same sphere, as the table has it and as fitted";
  const shown = spheres.lights.filter((l) => l.table);
  const most = Math.max(...spheres.lights.map((l) => l.covered));
  if (!shown.length)
    return section(title, `No sphere is shown: the table covers ${most > 0 ? "at most " + percent(most) : "none"} of what each of the three lights reaches, and a third is needed.`);
  const of_model = (model, m) => el("div", { class: "spheres" }, name ? null : el("h3", {}, `${m + 1}\u2002${model}`), shown.map((l) => spheres_under(spheres, l, m, name ?? model)));
  const others = spheres.models.slice(at_once);
  const node = section(title, spheres_answer(shown, spheres.models, name), spheres_keys(shown),
    ...spheres.models.slice(0, at_once).map(of_model), others.length ? more_spheres(others.length, () => others.map((model, k) => of_model(model, at_once + k))) : null,
    scroll(spheres_table(spheres, name)), el("p", { class: "small muted", style: { "margin-top": "12px" } }, spheres_how(spheres)));
  node.id = "spheres";
  return node;
}

/// Spheres that are drawn when a reader asks for them.
function more_spheres(n, make) {
  const more = el("details", { class: "more" }, el("summary", {}, many(n, "more model")));
  more.addEventListener("toggle", () => more.open && more.childElementCount === 1 && more.append(...make()));
  return more;
}

/// How far the models are from the table, in a sentence or two.
function spheres_answer(shown, models, name) {
  const of = (l, m) => l.models[m], worst_of = (m, key) => shown.reduce((a, l) => (of(l, m)[key] > of(a, m)[key] ? l : a));
  const best = models.map((_, m) => m).reduce((a, m) => (of(worst_of(m, "median"), m).median < of(worst_of(a, "median"), a).median ? m : a), 0);
  const who = name ? `the ${name}` : models[best], under = shown.length > 1 ? `under each of the ${shown.length === 3 ? "three" : "two"} lights` : `under ${shown[0].light}`;
  const capital = (text) => text[0].toUpperCase() + text.slice(1);
  const w = worst_of(best, "median"), most = of(w, best), tail = of(worst_of(best, "p95"), best).p95;
  const shares = [Math.min, Math.max].map((f) => percent(f(...shown.map((l) => l.covered))));
  const part = shown.every((l) => l.covered > 0.9) ? "" : ` The table covers ${shares[0] === shares[1] ? "" : `${shares[0]} to `}${shares[1]} of what light reaches.`;
  const first = name || models.length === 1 ? "" : `of ${models.length} models, `, closest = name || models.length === 1 ? "" : " comes closest: it";
  if (tail <= sphere_scale.limit) return capital(`${first}${who}${closest} looks like the table ${under}: 95\u202f% of the pixels differ by less than ΔE2000 ${delta_e(Math.max(tail, 0.01))}.${part}`);
  const half = `Under ${w.light}${shown.length > 1 ? ", where it differs most," : ""} half of the pixels are within ΔE2000 ${delta_e(most.median)} and 95\u202f% within ${delta_e(most.p95)}.`;
  const by_spacing = (key) => known(most["spacing_" + key]) && most["spacing_" + key] > 0.5 * most[key];
  const spacing = by_spacing("p95") ? ` Much of that is the spacing of the table's samples and not the ${name ?? "model"}: by it alone 95\u202f% are within ${delta_e(most.spacing_p95)}.` : "";
  if (most.median > sphere_scale.limit && by_spacing("median")) return `The table's samples lie too far apart to tell whether ${who} looks like it. ${half}${spacing}${part}`;
  const looks = most.median <= sphere_scale.limit ? "looks almost like the table" : most.median <= 3 ? "can be told from the table" : "looks different from the table";
  return `${capital(first + who)}${closest} ${looks}. ${half}${spacing}${part}`;
}

function spheres_keys(shown) {
  const key = (name) => el("span", { class: "step", style: { background: `var(--${name})` } });
  const hatched = shown.some((l) => l.covered < 1);
  return el("p", { class: "small keys" }, el("span", {}, key("zero"), "no difference"), el("span", {}, key("rms-1"), `ΔE2000 ${sphere_scale.limit}, hardly seen`),
    el("span", {}, key("high-1"), `above ${sphere_scale.limit}, seen side by side`), el("span", {}, key("high-2"), `${sphere_scale.max} or more`),
    hatched ? el("span", {}, el("span", { class: "step hatched" }), "the table has no value") : null);
}

/// Table, model and difference under a light.
function spheres_under(spheres, l, m, name) {
  const model = l.models[m], light = l.light[0].toUpperCase() + l.light.slice(1);
  const picture = (png, of) => el("img", { class: "sphere", width: spheres.pixels, height: spheres.pixels, src: `data:image/png;base64,${png}`, alt: `Sphere under ${l.light}, ${of}` });
  return el("figure", {}, el("figcaption", {}, light, el("span", {}, `, half within ΔE ${delta_e(model.median)}`)),
    el("div", { class: "sphere-row" }, picture(l.table, "table"), picture(model.picture, name),
      difference_picture(model.difference, spheres.pixels, sphere_scale, `Sphere under ${l.light}, difference between table and ${name}: half of the pixels within ΔE2000 ${delta_e(model.median)}`),
      el("small", {}, "table"), el("small", {}, name === "fit" ? name : "model"), el("small", {}, "difference")));
}

/// Of one model a row for each light, of several a row for each model.
function spheres_table(spheres, name) {
  const text = (x) => ({ n: known(x) ? delta_e(x) : "–" });
  if (!name) {
    const shown = spheres.lights.filter((l) => l.table);
    return table(["ΔE2000", ...shown.flatMap((l) => [{ n: `${l.light}, half below` }, { n: "95\u202f% below" }])],
      spheres.models.map((model, m) => [`${m + 1}\u2002${model}`, ...shown.flatMap((l) => [text(l.models[m].median), text(l.models[m].p95)])]));
  }
  const spacing = spheres.lights.some((l) => known(l.models[0]?.spacing_median));
  const head = ["light", { n: "covered" }, { n: "ΔE2000, half below" }, { n: "95\u202f% below" }, ...(spacing ? [{ n: "spacing alone, half" }, { n: "95\u202f%" }] : [])];
  return table(head, spheres.lights.map((l) => [l.light, { n: share_covered(l.covered) },
    ...["median", "p95", ...(spacing ? ["spacing_median", "spacing_p95"] : [])].map((key) => text(l.models[0]?.[key]))]));
}

function spheres_how(spheres) {
  const grey = spheres.channels.join() === "r,g,b" ? "" : ` Shown is the grey of ${spheres.channels.length > 1 ? "the mean of " : ""}${spheres.channels.join(", ")}.`;
  return "Front light: three lights on the viewer's side. Rim light: one of these, and two from behind the sphere. Flash: one, 10° above the viewer. "
    + "White is the table's 99th percentile of luminance under each light. "
    + `Covered: share of the lit pixels for which the table has values between its samples, or, where it is a list, a sample within 5° of both directions, mirrored or swapped.${grey}`
    + " Spacing alone: the difference between the fit and the fit known at the table's samples only.";
}
