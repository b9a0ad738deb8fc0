"""Plays with pages of gonio explore in a headless browser, and says what is not as it should be.

    explore_page.py GONIO FOLDER

The folder has paint.html (a table, its fit and disney), plain.html (no argument) and hostile.html (a name that is markup).
"""

import csv
import json
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from devtools import Browser

gonio, folder = sys.argv[1], pathlib.Path(sys.argv[2])
complaints = []


def expect(holds, what):
    if not holds:
        complaints.append(what)


def address(name):
    return (folder / name).as_uri()


ready = "typeof kept === 'string' && document.querySelector('#facts p')"


def settle(page):
    page.wait("dirty.waiting === 0 && !dirty.all && !dirty.items.size")


def evaluated(model, rows):
    """f by gonio eval, of words that name a model."""
    with open(folder / "in.csv", "w", newline="") as out:
        csv.writer(out).writerows([["theta_i", "phi_i", "theta_o", "phi_o"], *rows])
    words = [gonio, "eval", *model, "--directions", str(folder / "in.csv"), "--json"]
    done = subprocess.run(words, capture_output=True, text=True)
    if done.returncode:
        complaints.append(f"{' '.join(words)}: {done.stderr}")
        return [[0, 0, 0]] * len(rows)
    return [row["f"] for row in json.loads(done.stdout)["rows"]]


def near(a, b, what):
    expect(abs(a - b) <= 1e-11 * abs(b), f"{what}: {a!r}, gonio eval says {b!r}")


def middle_of(page, selector, x=0.5, y=0.5):
    box = page.ask(f"(() => {{ const n = document.querySelector('{selector}'); n.scrollIntoView({{ block: 'center' }}); "
                   "const b = n.getBoundingClientRect(); return [b.left, b.top, b.width, b.height]; })()")
    return box[0] + x * box[2], box[1] + y * box[3]


# How many colours a picture has, and its bytes as a number.
page_tools = """
globalThis.look = (id) => picture_of(`#${id}`);
globalThis.picture_of = (selector) => {
  const c = document.querySelector(selector), all = new Uint32Array(c.getContext("2d").getImageData(0, 0, c.width, c.height).data.buffer);
  return { colours: new Set(all).size, sum: all.reduce((h, v) => (Math.imul(h, 31) + v) | 0, 0) };
};
globalThis.choose = (node, value) => { node.value = value; node.dispatchEvent(new Event("input")); node.dispatchEvent(new Event("change")); };
"""


def values_under_the_pointer(page):
    page.ask("choose(document.getElementById('theta'), 38)")
    settle(page)
    model = page.ask("model_words()").split()
    rows, read = [], []
    for part in (0.2, 0.45, 0.6, 0.71, 0.9):
        page.mouse("mouseMoved", *middle_of(page, "#cut .chart", part))
        at, values = page.ask("[Number($('cut').querySelector('.readout').dataset.at), JSON.parse($('cut').querySelector('.readout').dataset.values)]")
        rows.append([38, 0, abs(at), 0 if at < 0 else 180])
        read.append(dict(values))
    expect(len({row[2] for row in rows}) == 5, f"the pointer reads at its own place: {rows}")
    for f, values in zip(evaluated(model, rows), read):
        near(values["fit.json"], f[1], "under the pointer")
    # One cell of a slice.
    page.mouse("mouseMoved", *middle_of(page, "#slice-1", 0.3, 0.6))
    cell, values = page.ask("[Number($('slices').querySelector('.readout').dataset.at), JSON.parse($('slices').querySelector('.readout').dataset.values)]")
    expect(page.ask(f"slices.get(items[1])[2][{cell}]") == values[2][1], "a slice tells its cell")
    theta_h, theta_d = (cell % 96 + 0.5) / 96 * 90, (95 - cell // 96 + 0.5) / 96 * 90
    expect(abs(theta_h - 27) < 1.5 and abs(theta_d - 36) < 1.5, f"a slice tells the place under the pointer: {theta_h}, {theta_d}")
    # Keys do the same.
    before = page.ask("$('cut').querySelector('.readout').dataset.at")
    page.ask("document.querySelector('#cut .chart').focus()")
    page.key("keyDown", "ArrowRight")
    expect(page.ask("$('cut').querySelector('.readout').dataset.at") != before, "an arrow key moves the reading")


def facts(page):
    page.wait("document.getElementById('facts').innerText.includes('typical factor')")
    said = page.ask("document.getElementById('facts').innerText")
    fit = json.loads((folder / "fit.json").read_text())
    typical = 2.718281828459045 ** fit["residuals"]["log_rms"]
    word = said.split("typical factor ×/÷ ")[1].split(" ")[0]
    expect(abs(float(word) - typical) < 0.01, f"the page's typical factor {word} beside the fit's {typical}")


    delta = float(said.split("ΔE2000 ")[1].split(",")[0])
    expect(delta < 3, f"the spheres of a table and its fit are alike: {delta}")
    expect("roughness 0.38" in page.ask("document.getElementById('model').innerText"), "the roughness beside alpha")


def dots(page):
    page.wait("document.querySelector('#measured .dots')")
    n = page.ask("document.querySelector('#measured .dots').getAttribute('d').split('M').length - 1")
    expect(500 < n <= 2048, f"{n} dots, predicted against measured")


def together(page):
    before = json.loads(page.ask("state()"))["i"][1]["v"]["kd"]
    page.ask("document.getElementById('together').checked = true")
    page.ask("(() => { const r = document.getElementById('value-0'); r.focus(); choose(r, 100); r.blur(); })()")
    after = json.loads(page.ask("state()"))["i"][1]["v"]["kd"]
    expect(all(abs(b / a - after[0] / before[0]) < 1e-9 for a, b in zip(before, after)) and after != before, f"colours move together: {before}, {after}")
    expect(page.ask("[...document.querySelectorAll('.slider input[type=range]')].slice(0, 3).every((r, c) => Math.abs(r.value / 1000 - values_of(items[1]).kd[c]) < 1e-3)"), "and their sliders")
    page.ask("document.getElementById('together').checked = false; $('undo').click()")
    expect(json.loads(page.ask("state()"))["i"][1]["v"]["kd"] == before, "and are undone together")


def each_slider(page):
    names = page.ask("[...document.querySelectorAll('.slider input[type=range]')].map((r) => r.id)")
    expect(len(names) == 7, f"{names}: a slider for each value")
    expect(page.ask("document.querySelectorAll('.interval').length") == 7, "an interval on each slider of a fit")
    for name in names:
        before, pictures = json.loads(page.ask("state()")), page.ask("look('sphere-1')")
        others = page.ask("[look('sphere-0'), look('sphere-2')]")
        page.ask(f"(() => {{ const r = document.getElementById('{name}'); choose(r, (Number(r.value) + 350) % 1000); }})()")
        settle(page)
        after = json.loads(page.ask("state()"))
        moved = [(key, c) for key, v in before["i"][1]["v"].items() for c in range(len(v)) if v[c] != after["i"][1]["v"][key][c]]
        label = page.ask(f"document.querySelector('label[for={name}]').textContent")
        expect([f"{k}.{'rgb'[c]}" if len(before['i'][1]['v'][k]) > 1 else k for k, c in moved] == [label], f"{label} moves {moved}")
        for one in (before["i"][1], after["i"][1]):
            del one["v"], one["x"]
        expect(before == after, f"{label} moves nothing else")
        expect(page.ask("look('sphere-1')") != pictures, f"{label} moves the sphere")
        expect(page.ask("[look('sphere-0'), look('sphere-2')]") == others, f"{label} leaves the other spheres")


def ways_back(page):
    now = page.ask("state()")
    page.ask("$('undo').click()")
    earlier = page.ask("state()")
    expect(earlier != now, "undo")
    page.ask("$('redo').click()")
    expect(page.ask("state()") == now, "redo")
    page.ask("document.body.focus(); document.activeElement.blur()")
    page.key("keyDown", "a")
    held = json.loads(page.ask("state()"))
    fit = json.loads((folder / "fit.json").read_text())["parameters"]["alpha"]["value"]
    expect(held["i"][1]["v"]["alpha"] == [fit], "A, while its key is down")
    page.key("keyUp", "a")
    expect(page.ask("state()") == now, "and back when it is up")
    page.ask("$('reset').click()")
    expect(json.loads(page.ask("state()"))["i"][1]["v"]["alpha"] == [fit], "reset")
    page.ask("$('undo').click()")
    expect(page.ask("state()") == now, "a reset is undone")


def drags(page):
    x, y = middle_of(page, "#cut .chart", 0.7)
    page.mouse("mousePressed", x, y, True)
    page.mouse("mouseMoved", x + 40, y, True)
    page.mouse("mouseReleased", x + 40, y)
    settle(page)
    theta = page.ask("view.theta")
    expect(38 < theta < 75, f"a drag turns the light, to {theta}")
    light, picture = page.ask("view.light"), page.ask("look('sphere-1')")
    x, y = middle_of(page, "#sphere-1", 0.4, 0.3)
    page.mouse("mousePressed", x, y, True)
    page.mouse("mouseReleased", x, y)
    settle(page)
    expect(page.ask("view.light") != light and page.ask("look('sphere-1')") != picture, "a drag moves the sphere's light")
    expect(page.ask("Math.abs(view.light[0] + 0.2 / 0.96) < 0.02"), "to under the pointer")
    picture = page.ask("look('sphere-1')")
    page.ask("choose(document.getElementById('lamp'), 'rim light')")
    settle(page)
    expect(page.ask("look('sphere-1')") != picture, "other lights")
    seen = [page.ask("look('sphere-1')")]
    for lamp in page.ask("catalogue.wide_lights"):
        page.ask(f"choose(document.getElementById('lamp'), '{lamp}')")
        settle(page)
        early = page.ask("[items[1].passes, look('sphere-1')]")
        page.wait("drawn().every(([item]) => item.passes === catalogue.passes)")
        seen.append(page.ask("look('sphere-1')"))
        expect(early[0] < 64 and early[1] != seen[-1], f"a picture under {lamp} converges while it is watched, from {early[0]} passes on")
        expect(seen[-1]["colours"] > 100, f"and is drawn: {seen[-1]}")
        page.wait("document.getElementById('facts').innerText.includes('under front light')")
    expect(len({one["sum"] for one in seen}) == len(seen), "each light makes another picture")
    page.ask("choose(document.getElementById('lamp'), 'rim light')")
    settle(page)
    page.wait("solid !== null")
    before = page.ask("picture_of('#lobe canvas')")
    expect(before["colours"] > 30, f"the lobe in space is drawn, in {before} colours")
    x, y = middle_of(page, "#lobe canvas")
    page.mouse("mousePressed", x, y, True)
    page.mouse("mouseMoved", x + 50, y + 10, True)
    page.mouse("mouseReleased", x + 50, y + 10)
    expect(page.ask("picture_of('#lobe canvas')") != before, "and turned by a drag")


def address_goes_round(page):
    page.ask("choose(document.querySelectorAll('.term select')[1], 'ggx_aniso/'.slice(0, -1))")
    settle(page)
    state, pictures = page.ask("state()"), page.ask("['sphere-1', 'slice-1', 'sphere-0'].map(look)")
    link = page.ask("location.href")
    # In another page.
    page.open("about:blank", "true")
    page.open(link, ready)
    page.ask(page_tools)
    settle(page)
    expect(page.ask("state()") == state, "the address holds the state")
    expect(page.ask("$('lamp').value") == "rim light", "its light, too")
    expect(page.ask("['sphere-1', 'slice-1', 'sphere-0'].map(look)") == pictures, "and the pictures")


def keys_on_pictures(page):
    """Arrow keys do on a picture what a pointer does there."""
    page.ask("view.light = [0.1, 0.2, Math.sqrt(0.95)], view.lamp = 'rim light', $('sphere-1').focus()")
    before = page.ask("look('sphere-1')")
    page.key("keyDown", "ArrowRight")
    page.key("keyDown", "ArrowDown")
    settle(page)
    light = page.ask("view.light")
    expect(abs(light[0] - 0.2) < 1e-9 and abs(light[1] - 0.1) < 1e-9 and abs(sum(x * x for x in light) - 1) < 1e-9, f"arrow keys move a sphere's light: {light}")
    expect(page.ask("view.lamp === '' && document.activeElement.id === 'sphere-1'") and page.ask("look('sphere-1')") != before, "and the focus stays on it")
    for _ in range(15):
        page.key("keyDown", "ArrowRight")
    expect(page.ask("view.light[2] > 0 && Math.hypot(...view.light) < 1.0001"), "to the rim and no further")
    page.ask("$('slice-1').focus()")
    page.key("keyDown", "ArrowRight")
    first = page.ask("Number($('slices').querySelector('.readout').dataset.at)")
    page.key("keyDown", "ArrowRight")
    page.key("keyDown", "ArrowDown")
    expect(page.ask("Number($('slices').querySelector('.readout').dataset.at)") == first + 97, "and the reading of a slice, a cell at a time")
    expect(page.ask("[...document.querySelectorAll('canvas[tabindex]')].every((c) => c.getAttribute('aria-label').includes('arrow keys'))"), "and say so")


def albedos(page):
    """A table's albedo that it hardly knows looks like that."""
    page.wait("albedos.curves.some((c) => c.points)")
    page.ask("Object.assign(items[0], { kept: items[0].albedo, albedo: [[10, 0.3, 0.01, 1], [20, 0.3, 0.2, 1], [30, 0.3, 0, 0.5], [40, 0.3, 0, 1]].map(([theta_i, v, error, coverage]) => ({ theta_i, value: [v, v, v], error, coverage })) }), evaluate_albedo(), draw_albedo()")
    hollow, bars = page.ask("[[...$('albedo').querySelectorAll('circle')].map((c) => c.classList.contains('hollow')), [...$('albedo').querySelectorAll('.error')].map((e) => e.getBoundingClientRect().height)]")
    expect(hollow == [False, True, True, False], f"albedos that the table hardly knows are hollow: {hollow}")
    expect(len(bars) == 2 and bars[1] > 5 * bars[0] > 0, f"errors have bars: {bars}")
    page.ask("items[0].albedo = items[0].kept, evaluate_albedo(), draw_albedo()")
    expect(page.ask("items[0].albedo.every((a) => a.error >= 0 && a.coverage > 0)"), "the program says how well it knows them")


def channels(page):
    """What has more channels than are shown is not said to have as many."""
    page.ask("items[active].fit = null, items[0].channels_in_file = 5, show_facts()")
    expect("in 3 of 5 channels." in page.ask("$('facts').innerText"), f"channels of a table that are not shown: {page.ask('$(`facts`).innerText')[:200]}")
    page.ask("items[active].fit = null, $('copy-json').click()")
    page.wait("$('status').textContent.includes('It holds 3 of 5 channels, r g b.')")
    values = page.ask("values_of(items[active])")
    four = {"channels": ["r", "x", "g", "b"], "parameters": {name: {"value": [1, 0.25, 1, 1]} for name in values}}
    page.ask(f"documents.set('four', {json.dumps(json.dumps(four))}), Object.assign(items[active], {{ changed: false, fit: {{ id: 'four', all: 4, parameters: {{}}, said: '' }} }})")
    whole, colours = json.loads(page.ask("whole_document()")), {name: v for name, v in values.items() if len(v) == 3}
    expect(colours and whole["channels"] == ["r", "x", "g", "b"] and all(whole["parameters"][name]["value"] == [v[0], 0.25, *v[1:]] for name, v in colours.items()), f"a copy has all channels of a fit: {whole}")
    page.ask("items[active].changed = true")
    expect(page.ask("whole_document()") is None, "until a value moves that the others do not follow")


def copies(page):
    page.ask("choose(document.getElementById('theta'), 45)")
    settle(page)
    page.ask("$('copy-json').click()")
    (folder / "copied.json").write_text(page.ask("$('copied').value"))
    words = page.ask("model_words()").split()
    rows = [[45, 0, t, 180] for t in (0, 30, 45, 80)]
    expect(evaluated([str(folder / "copied.json")], rows) == evaluated(words, rows), "the JSON copied is the command copied")
    said = subprocess.run(page.ask("command()").replace("gonio eval", f"'{gonio}' eval"), shell=True, cwd=folder, capture_output=True, text=True)
    reading = dict(page.ask("JSON.parse($('cut').querySelector('.readout').dataset.values)"))
    expect(said.returncode == 0, f"the command copied runs: {said.stderr}")
    near(reading[page.ask("label(items[active])")], json.loads(said.stdout)["rows"][0]["f"][1], "the command copied, at the reading")
    shown = page.ask("(() => { const c = cuts.curves[cuts.curves.findIndex((c) => c.colour === active)]; return [0, 30, 45, 80].map((t) => c.channels.map((f) => f[nearest(cuts.angles, t)])); })()")
    for f, values in zip(evaluated(words, rows), shown):
        for a, b in zip(values, f):
            near(a, b, "the model copied")
    for what in page.ask("Object.keys(commands)"):
        page.ask(f"choose($('copy-spec'), '{what}')")
        line = page.ask("$('copied').value")
        done = subprocess.run(line.replace("gonio ", f"'{gonio}' "), shell=True, cwd=folder, capture_output=True, text=True)
        expect(line and done.returncode == 0, f"the command copied for {what}, {line}: {done.stderr}")
        expect(page.ask("$('copy-spec').value") == "", "and the menu is as before")
    fit = page.ask("fit_command()")
    done = subprocess.run(fit.replace("gonio", f"'{gonio}'", 1) + " --quiet", shell=True, cwd=folder, capture_output=True, text=True)
    expect(done.returncode == 0 and "gonio.fit/1" in (folder / "fit.json").read_text(), f"{fit}: {done.stderr}")
    svg = page.ask("svg_text('cut')")
    expect(svg.startswith("<svg") and "var(" not in svg.split("style=")[2].split('"')[1], "an SVG that stands alone")
    expect(page.ask("png_of('spheres').then((b) => b.size)") > 5000, "a PNG of the spheres")


def names(page):
    """An entry is called as it was named while it is that, and by its terms once it is another."""
    everywhere = ("[...[...document.querySelectorAll('#surfaces label')].map((n) => n.firstChild.textContent), ...[...document.querySelectorAll('#spheres figcaption, #slices .pictures figcaption')].map((n) => n.lastChild.textContent), "
                  "...[...document.querySelectorAll('#cut .readout .entry')].map((n) => n.childNodes[1].textContent.trim()), $('facts').innerText].join(' | ')")
    page.open("about:blank", "true")
    page.open(address("plain.html"), ready)
    page.ask(page_tools)
    terms = page.ask("items[0].about.name")
    for shipped in page.ask("catalogue.models.map((m) => m.title)"):
        page.ask(f"become(materials().find(([n]) => n.startsWith({json.dumps(shipped)}))[0])")
        expect(page.ask("items[0].about.name") != shipped and page.ask("label(items[0])").startswith(shipped), f"{shipped} is called so by whoever chose it, and its terms are no more than terms")
    page.ask("$('reset').click()")
    expect(page.ask("label(items[0])") == terms, "what nobody named is called by its terms")
    page.ask("$('what').value = 'Red plastic', $('add').click()")
    settle(page)
    expect("Red plastic" in page.ask(everywhere) and "changed" not in page.ask(everywhere), "what was added has its name")
    page.ask("(() => { const r = $('value-3'); r.focus(); choose(r, 500); })()")
    page.wait("$('facts').innerText.includes('Red plastic, changed')")
    seen = page.ask(everywhere)
    expect(seen.count("Red plastic") == seen.count("Red plastic, changed") >= 5, f"and says so when its values have moved: {seen}")
    page.ask("choose($('term-Diffuse'), 'oren_nayar')")
    page.wait("!$('facts').innerText.includes('Red plastic')")
    seen = page.ask(everywhere)
    expect("Red plastic" not in seen and seen.count(page.ask("label(items[1])")) >= 5, f"another model has no name of the one before: {seen}")
    page.ask("choose($('whole'), 'Red plastic'); $('what').value = 'Red plastic', $('add').click()")
    expect(page.ask("items.map(label)") == [terms, "Red plastic", "Red plastic, 2"], "two of one name are numbered")
    page.ask("$('add-lobe').click()")
    expect(page.ask("items[2].about.parts.filter((p) => p.length === 3).length") == 2, "a lobe is added")
    page.ask("$('take-lobe').click()")
    expect(page.ask("items[2].about.spec") == "lambert+ggx/smith_ggx.correlated/schlick", "and taken away")


def by_keys(page):
    page.open("about:blank", "true")
    page.open(address("paint.html"), ready)
    page.ask(page_tools)
    settle(page)
    before = page.ask("state()")
    page.ask("$('what').focus()")
    for key in ("ArrowDown", "ArrowDown", "g"):
        page.key("keyDown", key)
        page.key("keyUp", key)
    expect(page.ask("state()") == before, "a list that is gone through adds nothing")
    page.ask("$('term-Masking').focus(); choose($('term-Masking'), 'smith_ggx.separable')")
    expect(page.ask("document.activeElement.id") == "term-Masking", "the focus stays where a term was swapped")
    page.ask("$('whole').focus(); choose($('whole'), 'Rubber')")
    expect(page.ask("document.activeElement.id") == "whole", "and where a model became another")
    now = page.ask("state()")
    page.ask("$('compare').focus()")
    page.key("keyDown", " ")
    expect(page.ask("items[1].name") == "fit.json" and page.ask("$('status').textContent") == "This is A.", "the space bar holds A")
    page.key("keyUp", " ")
    expect(page.ask("state()") == now, "and lets it go")
    for _ in range(2):
        page.ask("$('undo').focus(); $('undo').click()")
    expect(page.ask("$('undo').disabled && document.activeElement.id") == "redo", "what cannot be undone further leaves the focus at what can be done")
    heard = page.ask("[...document.querySelectorAll('input[type=range]')].map((r) => [r.id, r.getAttribute('aria-valuetext')])")
    expect(all(text for _, text in heard) and dict(heard)["theta"] == "45°", f"sliders say their values: {heard}")


def frames(page):
    """What is drawn lies within its frame, between lines that tell its value."""
    outside = ("(id) => { const svg = $(id).querySelector('svg'), [, , w, h] = svg.getAttribute('viewBox').split(' ').map(Number); const all = [...svg.querySelectorAll('.curve')].flatMap((p) => [...p.getAttribute('d').matchAll(/[ML](-?[\\d.]+) (-?[\\d.]+)/g)].map((m) => [Number(m[1]), Number(m[2])])); "
               "return all.filter(([x, y]) => x < 45 || x > w - 9 || y < 3 || y > h - 21).length; }")
    page.open("about:blank", "true")
    page.open(address("paint.html"), ready)
    page.ask(page_tools)
    page.ask("for (const [k, v] of [[0, 0], [1, 0], [2, 0], [3, 0.003]]) choose($(`exact-${k}`), v)")  # a peak far above, and tails far below all that was measured
    page.wait("document.querySelector('#measured .dots') && $('measured').innerText.includes('at the edge')")
    expect(page.ask(f"({outside})('measured')") == 0, "predicted against measured stays within its frame")
    expect(page.ask("document.querySelectorAll('#measured .axis').length") > 4, "between lines that tell its values")
    page.open("about:blank", "true")
    page.open(address("dull.html"), ready)
    lines = page.ask("[...document.querySelectorAll('#cut text[text-anchor=end]')].map((t) => Number(t.textContent))")
    expect(len(lines) >= 4 and all(b / a < 3 for a, b in zip(lines, lines[1:])), f"a cut of one decade has lines within it: {lines}")
    boxes = page.ask("[...document.querySelectorAll('.slider input[type=number]')].map((n) => { n.value = '0.0038174'; return n.scrollWidth > n.clientWidth; })")
    expect(not any(boxes), "boxes of numbers show their digits")


def limits(page):
    """What a fit says of each value stands under its slider."""
    page.open("about:blank", "true")
    page.open(address("limits.html"), ready)
    said = page.ask("Object.fromEntries([...document.querySelectorAll('.slider')].map((s) => [s.querySelector('label').textContent, [s.innerText, s.querySelectorAll('.interval').length, s.querySelector('.interval')?.offsetWidth / s.querySelector('.track').offsetWidth]]))")
    for name, words, bar in (("kd.450", "fit: 95 % interval 0.1 to 0.3", 1), ("kd.550", "fit: at the end of its range, and the data push beyond it", 0), ("kd.650", "fit: not known; dark", 0),
                             ("alpha", "fit: best value for this model; the model is too wrong to bound it", 0), ("f0.450", "fit: at most 0.09 (95 %); values down to 0 do as well", 1),
                             ("f0.550", "fit: at least 0.02 (95 %)", 1), ("f0.650", "held by the fit", 0)):
        expect(name in said and words in said[name][0] and said[name][1] == bar, f"{name}: {said.get(name)}, expected {words}")
    expect(said["f0.550"][2] > 0.8, f"the bar of a lower limit reaches to the end: {said['f0.550']}")
    expect(page.ask("[...$('channel').options].map((o) => o.textContent)") == ["450", "550", "650"], "channels have their own names")
    expect(json.loads(page.ask("document_text()"))["channels"] == ["450", "550", "650"], "in the JSON that is copied, too")
    expect("kd.650" in page.ask("$('surfaces').innerText"), "what is not known is said beside the model")
    page.ask("swap([['eon'], ['ggx', 'smith_ggx.correlated', 'schlick']])")
    expect(page.ask("document.querySelectorAll('.interval').length") == 0 and "fit:" not in page.ask("$('model').innerText") and "kd.650" not in page.ask("$('surfaces').innerText"), "of another model the fit says nothing")
    page.ask("$('undo').click()")
    expect(page.ask("document.querySelectorAll('.interval').length") == 3, "until it is back")


def every_model(page):
    """Of the catalogue: whole models, and each term in the default model."""
    names = page.ask("materials().map(([name]) => name)")
    expect(len(names) > 15, "materials to begin with")
    choices = page.ask("catalogue.terms.map((t) => [t.role, t.short])")
    moves = [f"become({json.dumps(name)})" for name in names]
    for role, term in choices:
        parts = {"ndf": "ggx", "masking": "smith_ggx.correlated", "fresnel": "schlick", "diffuse": "lambert", role: term}
        moves.append(f"swap([[{json.dumps(parts['diffuse'])}], {json.dumps([parts[r] for r in ('ndf', 'masking', 'fresnel')])}])")
    moves.append("swap([['lambert']])")
    for move in moves:
        page.ask(move)
        settle(page)
        failed = page.ask("$('status').className === 'failed' && $('status').textContent")
        expect(not failed, f"{move}: {failed}")
        sphere, flat = page.ask("[look('sphere-0').colours, look('slice-0').colours]")
        drawn = page.ask("['cut', 'polar', 'albedo'].map((id) => $(id).querySelector('path.curve')?.getAttribute('d').length ?? 0)")
        expect(sphere > 10 and flat > (0 if 'lambert' in move else 1) and min(drawn[:2]) > 500, f"{move}: {sphere} and {flat} colours, paths of {drawn}")


def play(page):
    page.open(address("paint.html"), ready)
    page.ask(page_tools)
    settle(page)
    expect(page.ask("$('status').textContent") == "", "nothing to say at first")
    expect(page.ask("[...document.querySelectorAll('input, select, canvas, button, textarea')].every((n) => n.labels?.length || n.ariaLabel || n.textContent.trim())"), "every control has a label")
    values_under_the_pointer(page)
    facts(page)
    dots(page)
    each_slider(page)
    together(page)
    ways_back(page)
    drags(page)
    address_goes_round(page)
    copies(page)
    keys_on_pictures(page)
    albedos(page)
    channels(page)
    expect(page.ask("document.documentElement.scrollWidth") <= 1200, "not wider than its window")
    page("Emulation.setDeviceMetricsOverride", width=400, height=900, deviceScaleFactor=1, mobile=False)
    settle(page)
    expect(page.ask("document.documentElement.scrollWidth") <= 400, "nor than a narrow one")


def bad_addresses(page):
    for bad, words in (("#%7Bjunk", "cannot be shown"), ("#%ZZ", "cannot be shown"), ("#" + "[1]", "cannot be shown"),
                       ('#{"i":[{"n":"<b>x</b>","s":"ggx/none_such/schlick","v":{}}]}', "none_such"), ('#{"i":[{"t":7,"n":"x.csv"}]}', "it shows x.csv, which this page does not hold"), ('#{"i":[]}', "one to eight"), ('#{"i":[null]}', "neither a model nor a table"), ("#null", "one to eight"),
                       ('#{"i":[{"s":"lambert","f":{"parameters":{"kd":[7]}}}]}', "it was not made by a page of gonio explore"), ('#{"i":[{"s":"lambert"}],"k":{"rows":7}}', "it was not made by a page of gonio explore"),
                       ('#{"i":[{"s":"lambert","v":{"kd":"x"}}]}', "cannot be shown"),
                       ('#{"i":[{"s":"lambert","v":{"kd":[7,7,7]}}]}', "kd")):
        page.open("about:blank", "true")
        page.open(address("plain.html") + bad, ready)
        said = page.ask("$('status').textContent")
        expect(words in said and "undefined" not in said and " of null" not in said, f"{bad}: {said}")
        expect(page.ask("items.length === 1 && document.querySelector('path.curve') !== null"), f"{bad}: the page works")
        if "x.csv" in bad:
            page.open("about:blank", "true")
            page.open(address("dull.html") + '#{"i":[{"t":0},{"t":0}]}', ready)
            expect("a table twice" in page.ask("$('status').textContent"), "a table is shown once")
            page.open("about:blank", "true")
            page.open(address("dull.html") + '#{"i":[{"t":7,"n":"x.csv"},{"t":0,"n":"dull.csv"},{"s":"eon"}],"a":2}', ready)
            expect("x.csv, too" in page.ask("$('status').textContent") and page.ask("items.length === 2 && active === 1"), "what the page does not hold is named, and the rest is shown")
            page.open("about:blank", "true")
            page.open(address("plain.html") + bad, ready)
        expect(page.ask("document.querySelector('b') === null || !document.querySelector('h1 b, #status b')"), f"{bad}: a name is no markup")


def hostile(page):
    page.open(address("hostile.html"), "typeof kept === 'string' && dirty.waiting === 0")
    expect(page.ask("document.querySelectorAll('img').length") == 0, "a file's name is no markup")
    expect(page.ask("document.getElementById('surfaces').innerText.includes('<img src=x')"), "but text")


with Browser(1200, 900) as page:
    sys.excepthook = lambda *error: (print("\n".join(complaints)), sys.__excepthook__(*error))
    play(page)
    page("Emulation.setDeviceMetricsOverride", width=1200, height=900, deviceScaleFactor=1, mobile=False)
    page.open(address("plain.html"), ready)
    page.ask(page_tools)
    every_model(page)
    names(page)
    by_keys(page)
    frames(page)
    limits(page)
    bad_addresses(page)
    hostile(page)
    complaints += page.problems(folder.as_uri())
print("\n".join(complaints))
sys.exit(1 if complaints else 0)
