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
    if (document.activeElement?.disabled) $("cancel").focus();
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
      worker.postMessage({ module, request: JSON.stringify(request), files }, Object.values(files).map((bytes) => bytes.buffer));
    });
  } finally {
    worker?.terminate(), address && URL.revokeObjectURL(address), clearInterval(clock), job = null, show_fitting();
  }
}
/// What fails is said, and does not end the page.  The focus is in the end where it was, or where the next step is.
const carefully = (call) => async (...what) => {
  const from = document.activeElement;
  try { await call(...what); } catch (error) { say(error.message, error.message !== "Cancelled."); }
  if ([document.body, $("cancel")].includes(document.activeElement) && from !== document.body) (from.isConnected && !from.disabled ? from : $("fit")).focus();
};
/// True of a model that can be fitted to a table: of as many channels, or once fitted to some of the table's.
const fits = (model, table) => model.channels.length === table.channels.length || model.fit?.file === table.name;
/// The table and the model that a fit is of: what is chosen, and beside it the table that was last chosen or fitted, or that it was fitted to, or else the first that is shown.
function fit_pair() {
  const chosen = items[active];
  if (!is_model(chosen)) {
    const model = items.find((item) => is_model(item) && item.channels.length === chosen.channels.length) ?? items.find((item) => is_model(item) && fits(item, chosen));
    return model && [chosen, model];
  }
  const beside = items.filter((table) => !is_model(table) && fits(chosen, table)), called = (name) => beside.find((table) => table.name === name);
  const table = called(view.table) ?? called(chosen.fit?.file) ?? beside.find((one) => one.visible) ?? beside[0];
  return table && [table, chosen];
}
function some_pair() {
  const pair = fit_pair();
  if (!pair) throw new Error(no_pair());
  return pair;
}
function no_pair() {
  const chosen = items[active], other = items.find((item) => is_model(item) !== is_model(chosen)), many = (item) => counted(item.channels.length, "channel");
  return other ? `${label(chosen)} has ${many(chosen)}, ${label(other)} has ${many(other)}, and a fit needs as many of both: choose another ${is_model(chosen) ? "model" : "table"}, or choose the table and add a model to it.`
    : `A fit needs a ${is_model(chosen) ? "table" : "model"}, too: choose or add one.`;
}
const counted = (n, word) => `${n} ${word}${n === 1 ? "" : "s"}`;
function show_fitting() {
  if (!can_fit) return;
  $("fitting").hidden = !items.some((item) => !is_model(item));
  $("fit").disabled = $("choose").disabled = Boolean(job) || !fit_pair();
  $("cancel").hidden = $("phase").hidden = !job;
  const pair = fit_pair(), several = items.filter((item) => !is_model(item)).length > 1;
  $("why").textContent = pair ? `Fits ${label(pair[1])} to ${label(pair[0])}. To fit another table, choose it, then the model again.` : no_pair(), $("why").hidden = Boolean(pair) && !several;
}

/// Bytes of a table's file, and of what is said beside it.  The page has none of a large table that the program put into it.
async function files_of(table) {
  const { data } = table;
  if (!data.bytes && data.file) data.bytes = new Blob([from_text(data.file)]);
  if (!data.bytes) throw new Error(`The page does not hold the file ${data.name} itself: drop it here to fit it.`);
  const bytes = await data.bytes.arrayBuffer().catch(() => { throw new Error(`${data.name} was moved or changed: drop it again.`); });
  return { [data.name]: new Uint8Array(bytes), ...(data.side ? { [`${data.name}.gonio.json`]: new TextEncoder().encode(data.side) } : {}) };
}
/// What a person asks of a fit beside its model, by the names of gonio fit's options: "--fix gamma=2 f0=0.04", words with blanks in quotes.
function asked(text = $("words").value) {
  const words = {}, mask = $("mask").value.trim();
  let name = null;
  for (const [, quoted, plain] of text.matchAll(/'([^']*)'|(\S+)/g)) {
    if (plain?.startsWith("--")) words[name = plain.slice(2).replaceAll("-", "_")] = [];
    else if (name === null) throw new Error(`options: found ${plain ?? quoted}, expected --NAME first`);
    else words[name].push(plain ?? quoted);
  }
  if (words.models) throw new Error("options: found --models; the button “Compare models” does that");
  if (mask) words.mask = [mask];
  return words;
}
const shell_word = (text) => (/^[\w./+,=-]+$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`);
const file_word = (name) => shell_word(name.startsWith("-") ? `./${name}` : name);
/// The command that does what was asked, and before it the one that says what a person said of the table's columns.
/// \param columns  a map, as a side file has it, or nothing
function command_of(name, columns, spec, { model, ...options }) {
  const words = [];
  if (columns) {
    const { unit, cosine, cosines, ...rest } = columns, own = ["forward", "scale", "skip"], map = Object.entries(rest).filter(([key]) => !own.includes(key));
    words.push("gonio columns", file_word(name), "--map", ...map.map(([role, column]) => shell_word(`${role}=${column}`)));
    if (unit === "radians") words.push("--radians");
    if (cosine) words.push("--cosine");
    if (cosines) words.push(`--cosines=${cosines.join(",")}`);
    for (const key of own) if (rest[key] !== undefined) words.push(`--${key} ${shell_word(String(rest[key]))}`);
    words.push("--quiet &&");
  }
  words.push("gonio fit", file_word(name), "--model", shell_word(spec));
  for (const [option, list] of Object.entries(options)) words.push(`--${option.replaceAll("_", "-")}`, ...list.map(shell_word));
  return [...words, "-o fit.json"].join(" ");
}
/// Fits the model that is moved to the first table beside it, as the page would.
function fit_command() {
  const [table, item] = some_pair(), words = asked();
  return command_of(table.name, table.data.columns, words.model?.join(" ") ?? item.about.spec, words);
}

/// A fit's document as an entry of the page: what it is called, its values, and what is said of them.
/// \param table    that it stands beside, for the channels that are shown, or null
/// \param optimum  values by parameter and channel, also of those that the document has none of; {} of a document alone
/// \param id       that the document is kept by
/// \param command  that makes the fit
function fitted(text, name, table, optimum, id, command) {
  const d = JSON.parse(text), n = d.channels?.length;
  if (!n || typeof d.model !== "string" || typeof (d.parameters ?? 0) !== "object") throw new Error(`${name}: found no model, channels and parameters, as a fit's document has them`);
  const shown_here = table?.channels.every((c) => d.channels.includes(c));
  const channels = shown_here ? table.channels : n === 1 || n === 3 ? d.channels : n === 2 ? d.channels.slice(0, 1) : [0, n >> 1, n - 1].map((k) => d.channels[k]);
  const values = {}, parameters = {}, unknown = [], limited = [];
  for (const [key, p] of Object.entries(d.parameters)) {
    const of = (list, one = !Array.isArray(p.value)) => (one ? [list] : channels.map((c) => list?.[Math.max(d.channels.indexOf(c), 0)]));
    const v = of(p.value), had = v.filter(Number.isFinite), [status, limit, reason, ci] = ["status", "limit", "reason", "ci95"].map((member) => of(p[member]));
    v.forEach((x, c) => { if (!Number.isFinite(x) && !key.startsWith("roughness")) (/_limit$/.test(status[c]) ? limited : unknown).push(v.length > 1 ? `${key}.${channels[c]}` : key); });
    const found = optimum[key] && (optimum[key].length > 1 ? of(optimum[key], false) : v.map(() => optimum[key][0]));
    if (found ?? had.length) values[key] = v.map((x, c) => (Number.isFinite(x) ? x : found ? found[c] : had.reduce((a, b) => a + b) / had.length));
    if (!key.startsWith("roughness") && (p.status ?? p.ci95)) parameters[key] = v.map((_, c) => [status[c] ?? "free", ...(status[c] === "upper_limit" ? [null, limit[c]] : status[c] === "lower_limit" ? [limit[c], null] : ci[c] ?? [null, null]), reason[c] ?? ""]);
  }
  const has_optimum = Object.keys(optimum).length > 0, without = has_optimum ? unknown : [...unknown, ...limited];
  const only = table && n < channels_in_file(table) ? d.channels.join(", ") : "";
  const said = [only && `Fitted to channel ${only}.`, !without.length ? "" : has_optimum ? `Not known: ${without.join(", ")}. The value here is one of many that fit as well.` : `The fit has no value for ${without.join(", ")}: it begins with another.`,
    has_optimum && limited.length ? `The fit has only a limit of ${limited.join(", ")}. The value here is where it ended.` : ""].filter(Boolean).join(" ");
  const fit = { id, parameters, said, ...(n > channels.length ? { all: n } : {}) };
  if (d.residuals) {
    const input = d.input ?? {}, file = String(input.path ?? table?.name ?? "").split("/").at(-1), options = {};
    if (input.mask) options.mask = [input.mask];
    if (d.metric && d.metric !== "log") options.metric = [d.metric];
    if (d.robust && d.robust !== "none") options.robust = [d.robust];
    Object.assign(fit, { file, log_rms: d.residuals.log_rms, metric: d.metric ?? "log", converged: d.solver?.termination === "converged", warnings: d.warnings ?? [], next: (d.next ?? []).slice(0, 2), meets: Boolean(d.misfit?.tested && !d.misfit.told && !d.warnings?.length), left_out: input.mask ?? "", copies: input.masked?.copied > 0, only, command: command ?? command_of(file, null, d.model, options) });
  }
  documents.set(id, text);
  return { name, spec: d.model, values, channels, fit: said || d.residuals || Object.keys(parameters).length ? fit : null };
}
const new_id = () => String(Date.now());
/// Shows a fit in place of the model that was fitted, or beside what is there.
function take_fit(data, instead) {
  if (!instead && items.length >= colours) throw new Error(`${data.name || "the fit"}: ${full}`);
  const item = bind(data.name, data.spec, "", data.channels, data.fit);
  for (const p of item.about.parameters) if (data.values[p.name]) numbers(g.values(item.handle) + 8 * p.first, p.count).set(data.values[p.name]);
  item.about = describe(item.handle);
  if (instead) g.drop(instead.handle), item.visible = instead.visible, active = items.indexOf(instead), items[active] = item;
  else active = items.push(item) - 1;
  compared = null, show_all(), finish();
}
const full = "eight models and tables are here: remove one first.";
const times = (log_rms) => `×/÷ ${Math.exp(log_rms).toFixed(3)}`;
function save(name, text, type = "application/json") {
  const address = URL.createObjectURL(new Blob([text], { type }));
  make("a", { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 1000);
}
/// A document that is here is saved; of an address there is none.
const saver = (id, name) => (documents.has(id) ? [make("div", { class: "controls" }, Object.assign(make("button", {}, "Save as JSON"), { onclick: () => save(name, documents.get(id)) }))] : []);
const line = (kind, said) => make("p", {}, make("b", {}, `${kind}: `), said);
/// Advice that is an option, and no matter of taste as the metric is, is taken at a press.
function advice(said) {
  const [, option, value] = /^--(model|bounds|mask|bins|robust) ('[^']*'|[^\s:]+)/.exec(said) ?? [], p = line("Try", said);
  if (option && can_fit && fit_pair()) p.append(" ", Object.assign(make("button", { "aria-label": `Do it: ${option} ${value}` }, "Do it"), { onclick: carefully(() => (option === "model" ? fit_table(value) : fit_table(undefined, `--${option} ${value}`))) }));
  return p;
}
const model_of = (said) => /^--model (\S+)/.exec(said)?.[1];
function fit_panel({ about, changed, fit }) {
  const head = `${about.name} misses ${fit.file}${fit.only ? `, channel ${fit.only},` : ""}${fit.left_out ? `, without ${fit.left_out},` : ""} by a typical factor of ${times(fit.log_rms)}; ${fit.converged ? "the fit converged" : "the fit did not converge"}.${changed ? " You have moved its values since." : ""}`;
  return [make("h2", {}, "Fit"), make("p", {}, head), ...fit.warnings.map((w) => line("Beware", w)), ...(fit.meets ? [make("p", {}, "What is left is no more than the table's own noise.")] : []), ...(fit.unseen ? [make("p", {}, fit.unseen)] : []), ...fit.next.map(advice), ...(fit.next.some((said) => said.includes("on a part of the table")) ? [make("p", { class: "muted" }, "The factors beside Try are of models fitted to a part of the table. “Compare models” ranks these models, too, by incident angles held out.")] : []), make("p", {}, make("code", {}, fit.command)), ...saver(fit.id, `${fit.file}.fit.json`)];
}
function comparison_panel(d) {
  const number = (x, digits = 3) => (Number.isFinite(x) ? Number(x.toPrecision(digits)).toString() : "–"), factor = (x) => (Number.isFinite(x) ? times(x) : "–");
  const rows = d.rows.map(([model, note, unseen, log_rms, bic, free]) => {
    const take = Number.isFinite(log_rms) ? Object.assign(make("button", {}, "Take"), { onclick: carefully(() => fit_table(model)) }) : "";
    return make("tr", model === d.recommended ? { class: "best" } : {}, make("td", {}, model, ...(note ? [make("small", {}, note)] : []), " ", take), make("td", {}, factor(unseen)), make("td", {}, factor(log_rms)), make("td", {}, number(bic, 4)), make("td", {}, number(free)));
  });
  const head = make("tr", {}, ...["model", "typical factor on unseen angles", "of the fit", "BIC", "free"].map((t) => make("th", { scope: "col" }, t)));
  return [make("h2", {}, `Models compared on ${d.file}`), ...(d.recommended ? [make("p", {}, d.none_fits ? "None fits; the nearest is " : "Take ", make("b", {}, d.recommended), `. ${d.reason ?? ""}`)] : []),
    make("p", { class: "muted" }, `${d.beside ? "Compared are the usual models, those on this page, and those that Try offers for their fits. " : ""}The first column is the factor on incident angles held out of each fit, and orders the list. A fit's own factor, and that beside Try, is of angles that were fitted.`),
    ...d.beware.map((w) => line("Beware", w)), ...d.as_good.map((m) => line("As good", m)), ...d.disagreement.map((w) => line("But", w)), ...(d.offset > 0 ? [make("p", {}, `These factors count values from ${shown(d.offset)} 1/sr on. A fit's own factor counts smaller ones in full.`)] : []),
    make("div", { class: "scroll" }, make("table", {}, make("thead", {}, head), make("tbody", {}, ...rows))), make("p", { class: "muted" }, "The program adds the colour difference of a rendered sphere and the speed of each: ", make("code", {}, d.command)), ...saver(d.id, `${d.file}.models.json`)];
}
let panel = "";
/// What a comparison says, or else the fit of the model that is chosen, if its terms are still those that were fitted.
function show_panel() {
  const item = items[active], fit = is_model(item) && item.fit?.command ? item.fit : null, now = JSON.stringify([compared ?? fit, item.changed, Boolean(can_fit && fit_pair())]);
  if (now === panel) return;
  panel = now;
  refill($("fitted"), compared ? comparison_panel(compared) : fit ? fit_panel(item) : []);
  $("fitted").hidden = !$("fitted").childElementCount;
}
/// Says where a model stands in the last comparison, if that was of the same table with the same options, beside the one that it replaces.
function unseen_angles(key, spec, before) {
  const rows = judged?.key === key ? judged.rows.filter((row) => Number.isFinite(row[2])) : [], of = (model) => rows.find((row) => row[0] === model), own = of(spec), old = of(before);
  if (!own) return "";
  return `On incident angles held out of its fit it is off by ${times(own[2])}${old && old[2] < own[2] ? `, worse than ${old[0]} with ${times(old[2])}` : ""}${own === rows[0] ? ", the nearest of all compared." : `; the nearest of all compared is ${rows[0][0]} with ${times(rows[0][2])}.`}`;
}
/// \param more  options beside those that a person wrote, which stand among them once the fit is made
async function fit_table(model, more = "") {
  const text_of_words = `${$("words").value} ${more}`.trim(), [table, item] = some_pair(), words = asked(text_of_words), spec = model ?? words.model?.join(" ") ?? item.about.spec, command = command_of(table.name, table.data.columns, spec, words);
  const { document: text, optimum } = JSON.parse(await ask({ do: "fit", file: table.name, options: { ...words, model: [spec] } }, await files_of(table)));
  const other = JSON.parse(text).input?.sha256, own = table.sha256;
  const found = fitted(text, "", table, optimum, new_id(), command), { model: _, ...rest } = words;
  Object.assign(found.fit, { unseen: unseen_angles(JSON.stringify([table.name, rest]), found.spec, item.about.spec) });
  $("words").value = text_of_words, view.table = table.name;
  if (found.channels.length < table.channels.length) view.channel = Math.max(table.channels.indexOf(found.channels[0]), 0);  // where it is drawn over what it was fitted to
  take_fit(found, found.channels.length === item.channels.length ? item : null);  // beside it, where the fit is of some channels
  const before = item.fit, now = found.fit, alike = before?.file === now.file && before.metric === now.metric && before.left_out === now.left_out && (before.only ?? "") === now.only;
  const compared_to = !alike ? "" : now.log_rms === before.log_rms ? "as before" : `${now.log_rms < before.log_rms ? "better" : "worse"} than ${times(before.log_rms)} before`;
  say(own && other && own !== other ? `Fitted, but ${table.name} is not the file that this page was made with.`
    : !before?.file || before.file !== now.file ? `Fitted to ${now.file}.`
    : alike ? `Fitted: typical factor ${times(now.log_rms)}, ${compared_to}.`
    : `Fitted: typical factor ${times(now.log_rms)}. The fit before had another metric, other samples or channels, so its ${times(before.log_rms)} does not compare.`);
}
async function compare_models() {
  const [table] = some_pair(), { model, ...words } = asked(), id = new_id();
  const beside = [...new Set([model?.join(" "), ...items.filter(is_model).flatMap((item) => [item.about.spec, ...(item.fit?.file === table.name ? item.fit.next?.map(model_of) ?? [] : [])])].filter(Boolean))];
  const text = await ask({ do: "models", file: table.name, models: ["all", ...beside], options: words }, await files_of(table)), d = JSON.parse(text);
  // In the order asked the usual ones come first, whichever of them are here, too.
  const others = words.scale ? beside : d.models.slice(d.models.findLastIndex((m) => !beside.includes(m.model)) + 1).map((m) => m.model);
  const behind = (m) => m.cv_log_rms ?? m.log_rms ?? Infinity, short = (x) => (Number.isFinite(x) ? Number(x.toPrecision(6)) : null);
  documents.set(id, text);
  view.table = table.name;
  compared = judged = { id, key: JSON.stringify([table.name, words]), file: table.name, beside: others.length > 0, recommended: d.recommended ?? "", none_fits: d.none_fits, reason: d.reason ?? "", offset: d.log_offset, as_good: d.as_good, disagreement: d.disagreement, beware: [...d.beware, ...d.warnings],
    rows: d.models.sort((a, b) => behind(a) - behind(b)).map((m) => [m.model, m.note ?? "", short(m.cv_log_rms), short(m.log_rms), short(m.bic), short(m.parameters)]),
    command: command_of(table.name, table.data.columns, "", { ...words }).replace("--model ''", `--models ${shell_word(["all", ...others].join(","))}`).replace("-o fit.json", "-o models.json") };
  finish(), say("Compared.");
}

/// Reads files that were dropped or chosen: tables with their side files, and documents of fits.
async function read_files(list) {
  const sides = new Map(), names = new Set(list.map((f) => f.name));
  for (const f of list) if (f.name.endsWith(".gonio.json")) sides.set(f.name.slice(0, -11), await f.text());
  for (const [name, side] of sides) {
    if (names.has(name)) continue;
    const table = tables.find(({ data }) => data.name === name);
    if (!table) throw new Error(`${name}.gonio.json says how ${name} is read: drop both at once.`);
    table.data.side = side, say(`${name} is fitted as ${name}.gonio.json says from now on.`);
  }
  for (const f of list) {
    if (f.name.endsWith(".gonio.json")) continue;
    if (f.name.endsWith(".json") && f.size < 1e7) {
      const text = await f.text();
      if (text.includes('"gonio.fit/1"')) {
        try { take_fit(fitted(text, f.name, items.find((item) => !is_model(item)), {}, new_id())), say(""); } catch (error) { throw error instanceof SyntaxError ? new Error(`${f.name}: ${error.message}`) : error; }
        continue;
      }
    }
    await read_table({ name: f.name, bytes: f, side: sides.get(f.name) ?? "" });
  }
}
async function read_table(source) {
  const same = tables.find(({ data }) => data.name === source.name && !data.bytes && !data.file);
  const files = { [source.name]: new Uint8Array(await source.bytes.arrayBuffer()), ...(source.side ? { [`${source.name}.gonio.json`]: new TextEncoder().encode(source.side) } : {}) };
  if (same) return Object.assign(same.data, source), say(`${source.name} is here: fit it now.`);  // of a page that the program made
  if (items.length >= colours) throw new Error(`${source.name}: ${full}`);
  const d = JSON.parse(await ask({ do: "read", file: source.name, options: asked() }, files));
  show_columns(source, d);
  if (!d.table && !$("columns").hidden) $("columns").scrollIntoView({ block: "nearest" });
  if (!d.table) throw new Error(d.error);
  const table = hold_table({ ...d.table, ...source, inspection: d.inspection, dropped: true });
  tables.push(table), items.unshift(table), active = Math.min(active + 1, items.length - 1);
  if (!items.some((item) => is_model(item) && item.channels.length === table.channels.length)) {
    const item = bind("", usual, "", table.channels);
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
  const number = (id, value) => Object.assign(make("input", { type: "number", step: "any", id, "aria-label": id.replace("-", " of ") }), { value });
  const pick = (role) => {
    const select = make("select", { "data-role": role }, make("option", { value: "" }, "none"), ...c.names.map((name, k) => make("option", { value: name || `#${k + 1}` }, name || `column ${k + 1}`)));
    const is_angle = roles_of_columns.includes(role), constant = is_angle && map[role] && Number.isFinite(Number(map[role])) && !c.names.includes(map[role]);
    if (is_angle) select.append(make("option", { value: "=" }, "one angle for all"));
    if (map[role] && !constant && ![...select.options].some((o) => o.value === map[role])) select.append(make("option", { value: map[role] }, map[role]));
    select.value = constant ? "=" : map[role] ?? "";
    const angle = is_angle ? number(`angle-${role}`, constant ? map[role] : "0") : "", show = () => { if (angle) angle.hidden = select.value !== "="; };
    select.onchange = show, show();
    return make("label", {}, `${role} `, select, angle);
  };
  const tick = (id, text, on) => { const t = make("input", { type: "checkbox", id }); t.checked = on; return make("label", {}, t, ` ${text}`); };
  const again = make("button", { class: "main" }, "Read it so");
  again.onclick = carefully(async () => {
    const columns = {};
    for (const s of box.querySelectorAll("select[data-role]")) if (s.value) columns[s.dataset.role] = s.value === "=" ? $(`angle-${s.dataset.role}`).value || "0" : s.value;
    if ($("in-radians").checked) columns.unit = "radians";
    if ($("with-cosine").checked) columns.cosine = true;
    for (const [key, usual] of [["forward", 180], ["scale", 1]]) if ($(`columns-${key}`).value !== "" && Number($(`columns-${key}`).value) !== usual) columns[key] = Number($(`columns-${key}`).value);
    // What was said of it besides, and has no place here, stays.
    const asked_here = [...[...box.querySelectorAll("select[data-role]")].map((s) => s.dataset.role), "unit", "cosine", "forward", "scale"];
    for (const [key, value] of Object.entries(map)) if (!asked_here.includes(key)) columns[key] = value;
    box.hidden = true;
    await read_table({ ...source, columns, side: JSON.stringify({ schema: "gonio.table/1", columns }) });
  });
  box.replaceChildren(make("h2", {}, `The columns of ${source.name}`), ...(c.said ?? []).map((s) => make("p", {}, s.replace(/one angle for all is --map \S+/, "its list has “one angle for all”"))),
    make("div", { class: "controls" }, ...[...roles_of_columns, ...(values.length ? values : ["f"]), "channel"].map(pick),
      make("label", { title: "180, or 0 where azimuths are counted from the way that the light goes" }, "mirror direction at φo − φi = ", number("columns-forward", map.forward ?? 180), "°"), make("label", { title: "1/π of a radiance factor" }, "f is the values times ", number("columns-scale", map.scale ?? 1)), tick("in-radians", "angles in radians", map.unit === "radians"), tick("with-cosine", "values are f cos θo", Boolean(map.cosine)), again));
}
function show_inspection(d) {
  const percent = (a, b) => `${(100 * a / b).toFixed(1)} %`, list = [
    ["layout", `${d.format}, ${d.layout}, channels ${d.channels.join(" ")}`], ["values", `${d.valid} of ${d.values} usable (${percent(d.valid, d.values)})`], ["range", `${shown(d.smallest_positive)} to ${shown(d.largest)} 1/sr`],
    ...(d.noise?.sigma ? [["noise", `${d.noise.bound ? "below" : "about"} ${Number((100 * d.noise.sigma).toPrecision(2))} % of each value`]] : []), ...(d.peak ? [["peak", d.peak.in_words]] : []),
    ...(d.albedo ?? []).map((a) => ["albedo", `at θi ${degrees(a.theta_i_deg)}: ${[].concat(a.albedo).map((v) => (v === null ? "–" : shown(Number(v.toPrecision(3))))).join(", ")}${!(a.error >= 5e-5) ? "" : ` ± ${Number(a.error.toPrecision(1))}`}, samples cover ${(100 * a.coverage).toFixed(0)} % of the hemisphere`]), ...(d.albedo_left_out ?? []).map((why) => ["albedo", `none at ${why}`]),
    ...(d.reciprocity_error !== null ? [["reciprocity", `median error ${(100 * d.reciprocity_error).toFixed(1)} %`]] : []), ...d.warnings.map((w) => ["beware", w]), ...d.prospects.map((p) => [p.of, `${p.verdict}: ${p.because}`])];
  $("inspection").querySelector("div").replaceChildren(make("dl", {}, ...list.flatMap(([k, v]) => [make("dt", {}, k), make("dd", {}, v)])));
  $("inspection").hidden = false;
}

/// This page with all that is in view: what its address says, and the tables and documents that an address cannot hold.
async function save_page() {
  const kept_tables = items.filter((item) => !is_model(item)), list = await Promise.all(kept_tables.map(async ({ data: { bytes, dropped, ...data } }) => {
    if (bytes && !data.file && bytes.size <= most_file) data.file = to_text(new Uint8Array(await bytes.arrayBuffer()));
    return data;
  }));
  const s = JSON.parse(state()), ids = [compared?.id, ...items.map((item) => item.fit?.id)].filter((id) => documents.has(id)), copy = pristine.cloneNode(true);
  for (const one of s.i) if (one.t !== undefined) one.t = kept_tables.indexOf(tables[one.t]);
  copy.querySelector("#explored").textContent = JSON.stringify({ items: list, state: JSON.stringify(s), documents: Object.fromEntries(ids.map((id) => [id, documents.get(id)])) }).replaceAll("<", "\\u003c");
  save("explored.html", `<!doctype html>\n${copy.outerHTML}\n`, "text/html");
}
const most_file = 1 << 24;
const to_text = (bytes) => { let s = ""; for (let i = 0; i < bytes.length; i += 32768) s += String.fromCharCode(...bytes.subarray(i, i + 32768)); return btoa(s); };
function connect_fitting() {
  if (!can_fit) return;
  $("drop").hidden = $("save-page").hidden = false;
  const inspected = tables.find(({ data }) => data.inspection);  // of a page that was saved
  if (inspected) show_inspection(inspected.data.inspection);
  // In one column the answer stands below the button that asks for it.
  const narrow = matchMedia("(max-width: 900px)"), place_answer = () => (narrow.matches ? $("fitting") : $("facts")).after($("fitted"));
  narrow.onchange = place_answer, place_answer();
  for (const id of ["mask", "words"]) $(id).onkeydown = (e) => { if (e.key === "Enter" && !$("fit").disabled) $("fit").click(); };
  $("fit").onclick = carefully(() => fit_table()), $("choose").onclick = carefully(compare_models), $("cancel").onclick = () => job?.cancel();
  $("save-page").onclick = carefully(save_page);
  $("file").onchange = carefully(async () => { const list = [...$("file").files]; $("file").value = ""; await read_files(list); });
  addEventListener("dragover", (e) => { e.preventDefault(), $("drop").classList.add("over"); });
  addEventListener("dragleave", () => $("drop").classList.remove("over"));
  addEventListener("drop", carefully(async (e) => { e.preventDefault(), $("drop").classList.remove("over"); await read_files([...e.dataTransfer.files]); }));
  show_fitting();
}
