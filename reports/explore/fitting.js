// ---- reading files and fitting --------------------------------------------------------------------------------------------------
// The program itself does it, as a second module in a worker; it is unpacked when first asked for.
const pristine = document.documentElement.cloneNode(true), can_fit = $("fit-module") !== null;
let fit_module = null, job = null;
/// Asks the module for a document.  \param files  bytes by name
async function ask(request, files) {
  if (job) throw new Error("wait for what is being done, or cancel it");
  const begin = performance.now(), show = (text) => { $("phase").textContent = `${text} … ${((performance.now() - begin) / 1000).toFixed(0)} s`; };
  const mine = job = { what: "starting", cancel: () => {} }, clock = setInterval(() => show(mine.what), 500);
  let worker, address;
  try {
    show_fitting(), show(mine.what);
    const module = fit_module ??= await WebAssembly.compile(await unpacked("fit-module"));
    address = URL.createObjectURL(new Blob([$("worker").textContent], { type: "text/javascript" }));
    return await new Promise((done, fail) => {
      mine.cancel = () => fail(new Error("Cancelled."));
      worker = new Worker(address);
      worker.onerror = (e) => { e.preventDefault?.(), fail(new Error(`The fit stopped: ${e.message || "the worker ended"}. Try again, or with a smaller table.`)); };
      worker.onmessage = ({ data }) => {
        if (data.phase !== undefined) mine.what = data.phase, show(data.phase);
        else if (data.code === 0) done(data.text);
        else fail(new Error(data.code > 0 ? data.text : `The fit stopped: ${data.text}. Try again, or with a smaller table.`));
      };
      worker.postMessage({ module, request: JSON.stringify(request), files });
    });
  } finally {
    worker?.terminate(), address && URL.revokeObjectURL(address), clearInterval(clock), job = null, show_fitting();
  }
}
/// What fails is said, and does not end the page.
const carefully = (call) => async (...what) => {
  try { await call(...what); } catch (error) { say(error.message, error.message !== "Cancelled."); }
};
/// The table and the model that a fit is of: what is chosen, and the first beside it that has as many channels.
function fit_pair() {
  const chosen = items[active], other = is_model(chosen) ? items.find(comparable) : items.find((item) => is_model(item) && item.channels === chosen.channels);
  return other && (is_model(chosen) ? [other, chosen] : [chosen, other]);
}
function show_fitting() {
  if (!can_fit) return;
  $("fitting").hidden = !items.some((item) => !is_model(item));
  $("fit").disabled = $("choose").disabled = Boolean(job) || !fit_pair();
  $("cancel").hidden = $("phase").hidden = !job;
}

/// Bytes of a table's file, and of what is said beside it.  The page has none of a large table that the program put into it.
async function files_of(table) {
  const data = page.items[table.place];
  if (!data.bytes && data.file) data.bytes = new Blob([from_text(data.file)]);
  if (!data.bytes) throw new Error(`The page does not hold the file ${data.name} itself: drop it here to fit it.`);
  const bytes = await data.bytes.arrayBuffer().catch(() => { throw new Error(`${data.name} was moved or changed: drop it again.`); });
  return { [data.name]: new Uint8Array(bytes), ...(data.side ? { [`${data.name}.gonio.json`]: new TextEncoder().encode(data.side) } : {}) };
}
/// Options as gonio fit takes them, by their names: "--fix gamma=2 f0=0.04", words with blanks in quotes.
function asked_words() {
  const words = {}, mask = $("mask").value.trim();
  let name = null;
  for (const [, quoted, plain] of $("words").value.matchAll(/'([^']*)'|(\S+)/g)) {
    if (plain?.startsWith("--")) words[name = plain.slice(2).replaceAll("-", "_")] = [];
    else if (name === null) throw new Error(`options: found ${plain ?? quoted}, expected --NAME first`);
    else words[name].push(plain ?? quoted);
  }
  if (mask) words.mask = [mask];
  return words;
}

/// Values, intervals and all that a fit says, as an entry of the page.
/// \param optimum  values by parameter and channel, also of those that the document has none of; {} of a document alone
function fitted(text, name, table, optimum) {
  const d = JSON.parse(text), n = d.channels.length, shown_here = table?.channels.every((c) => d.channels.includes(c));
  const channels = shown_here ? table.channels : n === 1 || n === 3 ? d.channels : n === 2 ? d.channels.slice(0, 1) : [0, n >> 1, n - 1].map((k) => d.channels[k]);
  const of = (list) => (Array.isArray(list) ? channels.map((c) => list[Math.max(d.channels.indexOf(c), 0)]) : [list]);
  const values = {}, intervals = {}, unknown = [];
  for (const [key, p] of Object.entries(d.parameters)) {
    const v = of(p.value), known = v.filter(Number.isFinite);
    v.forEach((x, c) => { if (!Number.isFinite(x)) unknown.push(v.length > 1 ? `${key}.${channels[c]}` : key); });
    const found = optimum[key] && (optimum[key].length > 1 ? of(optimum[key]) : v.map(() => optimum[key][0]));
    if (found ?? known.length) values[key] = v.map((x, c) => (Number.isFinite(x) ? x : found ? found[c] : known.reduce((a, b) => a + b) / known.length));
    if (p.ci95) intervals[key] = Array.isArray(p.value) ? of(p.ci95) : [p.ci95];
  }
  const said = !unknown.length ? "" : Object.keys(optimum).length ? `Not known: ${unknown.join(", ")}. The value here is one of many that fit as well.` : `The fit has no value for ${unknown.join(", ")}: it begins with another.`;
  return { kind: "model", name, spec: d.model, values, intervals, channels, said, document: text };
}
/// Shows a fit in place of the model that was fitted, or beside what is there.
function take_fit(data, instead) {
  const place = page.items.push(data) - 1;
  const item = bind(data.name, data.spec, "", data.intervals, data.channels.length);
  for (const p of item.about.parameters) if (data.values[p.name]) numbers(g.values(item.handle) + 8 * p.first, p.count).set(data.values[p.name]);
  Object.assign(item, { origin: place, about: describe(item.handle) });
  const at = items.indexOf(instead);
  if (at >= 0) g.drop(instead.handle), item.visible = instead.visible, items[at] = item, active = at;
  else if (items.length < colours) active = items.push(item) - 1;
  else throw new Error("Eight models and tables are here: remove one first.");
  show_all(), finish();
}
const times = (log_rms) => `×/÷ ${Math.exp(log_rms).toFixed(3)}`;
function save(name, text, type = "application/json") {
  const address = URL.createObjectURL(new Blob([text], { type }));
  make("a", { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 1000);
}
const saver = (label, name, text) => Object.assign(make("button", {}, label), { onclick: () => save(name, text) });
function show_fit(text, table) {
  const d = JSON.parse(text), line = (kind, said) => make("p", {}, make("b", {}, `${kind}: `), said);
  // Advice that is an option, and no matter of taste as the metric is, is taken at a press.
  const advice = (said) => {
    const [, option, value] = /^--(model|bounds|mask|bins) ('[^']*'|[^\s:]+)/.exec(said) ?? [], p = line("Try", said);
    if (option) p.append(" ", Object.assign(make("button", {}, "Do it"), { onclick: carefully(() => {
      if (option === "model") return fit_table(value);
      $("words").value = `${$("words").value} --${option} ${value}`.trim();
      return fit_table();
    }) }));
    return p;
  };
  const head = `${d.model} leaves a typical factor of ${times(d.residuals.log_rms)} on ${table.name}; ${d.solver.termination === "converged" ? "the fit converged" : "the fit did not converge"}.`;
  $("fitted").replaceChildren(make("h2", {}, "Fit"), make("p", {}, head), ...d.warnings.map((w) => line("Beware", w)), ...d.next.slice(0, 2).map(advice),
    make("div", { class: "controls" }, saver("Save as JSON", `${table.name}.fit.json`, text)));
  $("fitted").hidden = false;
}
/// Shows the sentences of a fit that came as a document, where a table is beside it.
function show_document(data) {
  const table = can_fit && data?.document && fit_pair()?.[0];
  if (table) show_fit(data.document, table);
}
async function fit_table(model) {
  const [table, item] = fit_pair(), words = asked_words(), spec = model ?? words.model?.join(" ") ?? item.about.spec;
  const { document: text, optimum } = JSON.parse(await ask({ do: "fit", file: page.items[table.place].name, options: { ...words, model: [spec] } }, await files_of(table)));
  const other = JSON.parse(text).input?.sha256, own = page.items[table.place].sha256;
  take_fit(fitted(text, spec === item.about.spec ? item.name : spec, page.items[table.place], optimum), item), show_fit(text, table);
  say(own && other && own !== other ? `Fitted, but ${table.name} is not the file that this page was made with.` : "Fitted.");
}
async function compare_models() {
  const [table] = fit_pair();
  const text = await ask({ do: "models", file: page.items[table.place].name, models: ["all"], options: asked_words() }, await files_of(table)), d = JSON.parse(text);
  const number = (x, digits = 3) => (Number.isFinite(x) ? Number(x.toPrecision(digits)).toString() : "–"), factor = (x) => (Number.isFinite(x) ? times(x) : "–");
  const behind = (m) => m.cv_log_rms ?? m.log_rms ?? Infinity;
  const rows = d.models.sort((a, b) => behind(a) - behind(b)).map((m) => {
    const take = make("button", {}, "Take");
    take.onclick = carefully(() => fit_table(m.model));
    return make("tr", m.model === d.recommended ? { class: "best" } : {}, make("td", {}, m.model, ...(m.note ? [make("small", {}, m.note)] : [])), make("td", {}, factor(m.cv_log_rms)), make("td", {}, factor(m.log_rms)), make("td", {}, number(m.bic, 4)), make("td", {}, number(m.parameters)), make("td", {}, take));
  });
  const head = make("tr", {}, ...["model", "typical factor on unseen angles", "of the fit", "BIC", "free", ""].map((t) => make("th", { scope: "col" }, t)));
  $("fitted").replaceChildren(make("h2", {}, "Models compared"), ...(d.recommended ? [make("p", {}, d.none_fits ? "None fits; the nearest is " : "Take ", make("b", {}, d.recommended), `. ${d.reason ?? ""}`)] : []),
    ...[...(d.beware ?? []), ...(d.warnings ?? [])].map((w) => make("p", {}, make("b", {}, "Beware: "), w)), make("div", { class: "scroll" }, make("table", {}, make("thead", {}, head), make("tbody", {}, ...rows))),
    make("div", { class: "controls" }, saver("Save as JSON", `${table.name}.models.json`, text)));
  $("fitted").hidden = false, say("Compared.");
}

/// Reads files that were dropped or chosen: tables with their side files, and documents of fits.
async function read_files(list) {
  const sides = new Map();
  for (const f of list) if (f.name.endsWith(".gonio.json")) sides.set(f.name.slice(0, -11), await f.text());
  for (const f of list) {
    if (f.name.endsWith(".gonio.json")) continue;
    if (f.name.endsWith(".json") && f.size < 1e7) {
      const text = await f.text();
      if (text.includes('"gonio.fit/1"')) { take_fit(fitted(text, f.name, page.items[fit_pair()?.[0].place], {})), show_document(page.items.at(-1)); continue; }
    }
    await read_table({ name: f.name, bytes: f, side: sides.get(f.name) ?? "" });
  }
}
async function read_table(source) {
  const same = page.items.find((one) => one.kind === "table" && one.name === source.name && !one.bytes && !one.file);
  const files = { [source.name]: new Uint8Array(await source.bytes.arrayBuffer()), ...(source.side ? { [`${source.name}.gonio.json`]: new TextEncoder().encode(source.side) } : {}) };
  if (same) return Object.assign(same, source), say(`${source.name} is here: fit it now.`);  // of a page that the program made
  if (items.length >= colours) throw new Error("Eight models and tables are here: remove one first.");
  const d = JSON.parse(await ask({ do: "read", file: source.name, options: asked_words() }, files));
  show_columns(source, d);
  if (!d.table) throw new Error(d.error);
  const data = { ...d.table, ...source, name: source.name }, place = page.items.push(data) - 1;
  const table = { ...hold_table(data), place };
  tables.push(table), items.unshift(table), active = Math.min(active + 1, items.length - 1);
  if (!items.some((item) => is_model(item) && item.channels === table.channels)) {
    const item = bind("model", "lambert+ggx/smith_ggx.correlated/schlick", "", {}, table.channels);
    if (items.length === 2 && is_model(items[1])) g.drop(items[1].handle), items.pop();
    active = items.push(item) - 1;
  }
  show_inspection(d.inspection), show_all(), finish(), say("");
}
const roles_of_columns = ["theta_i", "phi_i", "theta_o", "phi_o"];
/// What each column of a text file is, as it was guessed, for a person to change.
function show_columns(source, d) {
  const c = d.columns, box = $("columns");
  box.hidden = !c || (d.table && !c.needed && !source.side);
  if (box.hidden) return;
  const map = (source.side && JSON.parse(source.side).columns) || c.map || {}, values = Object.keys(map).filter((key) => key === "f" || key.startsWith("f_"));
  const pick = (role) => {
    const select = make("select", { "data-role": role }, make("option", { value: "" }, "none"), ...c.names.map((name, k) => make("option", { value: name || `#${k + 1}` }, name || `column ${k + 1}`)));
    if (map[role] && ![...select.options].some((o) => o.value === map[role])) select.append(make("option", { value: map[role] }, map[role]));
    select.value = map[role] ?? "";
    return make("label", {}, `${role} `, select);
  };
  const tick = (id, text, on) => { const t = make("input", { type: "checkbox", id }); t.checked = on; return make("label", {}, t, ` ${text}`); };
  const again = make("button", { class: "main" }, "Read it so");
  again.onclick = carefully(async () => {
    const columns = {};
    for (const s of box.querySelectorAll("select[data-role]")) if (s.value) columns[s.dataset.role] = s.value;
    if ($("in-radians").checked) columns.unit = "radians";
    if ($("with-cosine").checked) columns.cosine = true;
    for (const key of ["forward", "scale", "skip", "weight", "channel"]) if (map[key] !== undefined) columns[key] = map[key];
    box.hidden = true;
    await read_table({ ...source, side: JSON.stringify({ schema: "gonio.table/1", columns }) });
  });
  box.replaceChildren(make("h2", {}, `The columns of ${source.name}`), ...(c.said ?? []).map((s) => make("p", {}, s)),
    make("div", { class: "controls" }, ...[...roles_of_columns, ...(values.length ? values : ["f"])].map(pick), tick("in-radians", "angles in radians", map.unit === "radians"), tick("with-cosine", "values are f cos θo", Boolean(map.cosine)), again));
}
function show_inspection(d) {
  const percent = (a, b) => `${(100 * a / b).toFixed(1)} %`, list = [
    ["layout", `${d.format}, ${d.layout}, channels ${d.channels.join(" ")}`], ["values", `${d.valid} of ${d.values} usable (${percent(d.valid, d.values)})`], ["range", `${shown(d.smallest_positive)} to ${shown(d.largest)} 1/sr`],
    ...(d.noise?.sigma ? [["noise", `${d.noise.bound ? "below" : "about"} ${Number((100 * d.noise.sigma).toPrecision(2))} % of each value`]] : []), ...(d.peak ? [["peak", d.peak.in_words]] : []),
    ...(d.reciprocity_error !== null ? [["reciprocity", `median error ${(100 * d.reciprocity_error).toFixed(1)} %`]] : []), ...d.warnings.map((w) => ["beware", w]), ...d.prospects.map((p) => [p.of, `${p.verdict}: ${p.because}`])];
  $("inspection").querySelector("div").replaceChildren(make("dl", {}, ...list.flatMap(([k, v]) => [make("dt", {}, k), make("dd", {}, v)])));
  $("inspection").hidden = false;
}

/// This page with what is in view, as the program would have made it.
async function save_page() {
  const list = await Promise.all(items.map(async (item) => {
    if (is_model(item)) return { kind: "model", name: item.name, spec: item.about.spec, channels: item.channels === 1 ? ["f"] : ["r", "g", "b"], values: values_of(item), said: "", intervals: item.intervals ?? {} };
    const { bytes, ...data } = page.items[item.place];
    if (bytes && !data.file && bytes.size <= most_file) data.file = to_text(new Uint8Array(await bytes.arrayBuffer()));
    return data;
  }));
  const copy = pristine.cloneNode(true);
  copy.querySelector("#explored").textContent = JSON.stringify({ items: list }).replaceAll("<", "\\u003c");
  save("gonio.html", `<!doctype html>\n${copy.outerHTML}\n`, "text/html");
}
const most_file = 1 << 24;
const to_text = (bytes) => { let s = ""; for (let i = 0; i < bytes.length; i += 32768) s += String.fromCharCode(...bytes.subarray(i, i + 32768)); return btoa(s); };
function connect_fitting() {
  if (!can_fit) return;
  $("drop").hidden = $("save-page").hidden = false;
  $("fit").onclick = carefully(() => fit_table()), $("choose").onclick = carefully(compare_models), $("cancel").onclick = () => job?.cancel();
  $("save-page").onclick = carefully(save_page);
  $("file").onchange = carefully(async () => { const list = [...$("file").files]; $("file").value = ""; await read_files(list); });
  addEventListener("dragover", (e) => { e.preventDefault(), $("drop").classList.add("over"); });
  addEventListener("dragleave", () => $("drop").classList.remove("over"));
  addEventListener("drop", carefully(async (e) => { e.preventDefault(), $("drop").classList.remove("over"); await read_files([...e.dataTransfer.files]); }));
  show_fitting();
}
