"""Fits tables in pages of gonio explore in a headless browser, and says where they are not as the program fits them.

    explore_fit_page.py GONIO FOLDER

The folder has t.csv and small.csv (tables), m.binary (one as MERL's), paint.html (a page with t.csv) and app.html (gonio explore --app).
"""

import json
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from devtools import Browser

gonio, folder = sys.argv[1], pathlib.Path(sys.argv[2])
complaints = []
model = "lambert+ggx/smith_ggx.correlated/schlick"
idle = "typeof kept === 'string' && job === null && dirty.waiting === 0"


def expect(holds, what):
    if not holds:
        complaints.append(what)


def run(*words):
    return subprocess.run([gonio, *words], cwd=folder, capture_output=True, text=True)


def natively(table, *words):
    done = run("fit", table, "--json", *words)
    if done.returncode:
        complaints.append(f"gonio fit {table}: {done.stderr}")
    return json.loads(done.stdout)


def lists(value):
    return value if isinstance(value, list) else [value]


def same_fit(page, program, what):
    """Parameters to 1e-6 and to 0.01 of a standard error, and all that is said."""
    expect(page.keys() == program.keys(), f"{what}: {page.keys() ^ program.keys()} in one of them only")
    for key in ("model", "channels", "warnings", "next", "metric", "intervals", "clusters", "input"):
        expect(page[key] == program[key], f"{what}: {key}: {page[key]}, the program says {program[key]}")
    expect(page["solver"]["instruction_set"] == "simd128", f"{what}: fitted by {page['solver']['instruction_set']}")
    for name, p in program["parameters"].items():
        q = page["parameters"][name]
        expect(q["status"] == p["status"], f"{what}: {name} is {q['status']}, the program says {p['status']}")
        for a, b, error in zip(lists(q["value"]), lists(p["value"]), lists(p["std_error"])):
            if b is None:
                expect(a is None, f"{what}: {name}: {a}, the program has no value")
            else:
                expect(abs(a - b) <= 1e-6 * abs(b) and (error is None or abs(a - b) <= 0.01 * error), f"{what}: {name}: {a!r}, the program says {b!r} ± {error}")
        for a, b in zip(lists(q["std_error"]), lists(p["std_error"])):
            expect(a is b is None or abs(a - b) <= 1e-3 * b, f"{what}: error of {name}: {a!r}, the program says {b!r}")


def drop(page, *names):
    root = page("DOM.getDocument")["root"]["nodeId"]
    node = page("DOM.querySelector", nodeId=root, selector="#file")["nodeId"]
    page("DOM.setFileInputFiles", nodeId=node, files=[str(folder / name) for name in names])


def drop_and_wait(page, *names):
    page.ask("say('waiting')")
    drop(page, *names)
    page.wait("$('status').textContent !== 'waiting' && job === null", 120)


def press(page, button, seconds=120):
    page.ask("say('waiting')")
    page.ask(f"$('{button}').click()")
    page.wait("$('status').textContent !== 'waiting' && job === null", seconds)
    return page.ask("$('status').textContent")


def document(page):
    return json.loads(page.ask("documents.get(items[active].fit.id)"))


def list_of_intervals(document):
    """Of the values that a fit bounds, on one side or on both."""
    all_of = lambda p, what: p[what] if isinstance(p["value"], list) else [p[what]]
    return [status for name, p in document["parameters"].items() if name != "roughness" for status in all_of(p, "status") if status in ("free", "upper_limit", "lower_limit")]


def fitted(page, what, table, *words):
    said = press(page, "fit")
    expect(said.startswith("Fitted"), f"{what}: {said}")
    if not said.startswith("Fitted"):
        return
    same_fit(document(page), natively(table, "--model", model, *words), what)
    expect(page.ask(f"$('fitted').innerText.includes('typical factor') && document.querySelectorAll('.interval').length === {len(list_of_intervals(document(page)))}"), f"{what}: the answer is shown, with intervals on the sliders")
    d = document(page)
    values = page.ask("values_of(items[active])")
    expect(values["alpha"] == [d["parameters"]["alpha"]["value"]], f"{what}: the sliders stand at the answer: {values}")


def of_the_program(page):
    page.open((folder / "paint.html").as_uri(), idle)
    page.ask("[...document.querySelectorAll('.slider input[type=range]')].slice(-4).forEach((r) => { r.value = 700; r.dispatchEvent(new Event('input')); r.dispatchEvent(new Event('change')); })")
    before = page.ask("state()")
    fitted(page, "a page with its table", "t.csv")
    page.ask("$('undo').click()")
    expect(page.ask("state()") == before, "a fit is undone")
    expect(page.ask("$('fitted').hidden && $('status').textContent === ''"), "and what it said goes with it")
    # What the last move said is gone with the next one, and a fit is better, worse, or neither.
    page.ask("$('redo').click()")
    expect(press(page, "fit").endswith(" as before."), f"a fit that is made again: {page.ask('$(`status`).textContent')}")
    page.ask("(() => { const r = $('value-0'); r.value = 500; r.dispatchEvent(new Event('input')); r.dispatchEvent(new Event('change')); })()")
    expect(page.ask("$('status').textContent") == "", "a fit is not spoken of beside another model")
    page.ask("$('undo').click()")
    page.ask("$('words').value = '--fix alpha=0.9'")
    expect(" worse than ×/÷" in press(page, "fit"), f"a worse fit: {page.ask('$(`status`).textContent')}")
    page.ask("$('reset').click()")
    expect(page.ask("$('status').textContent") == "", "a reset says nothing of fits")
    page.ask("$('words').value = ''")
    # What a person leaves out.
    page.ask("$('mask').value = 'theta_o > 70'")
    fitted(page, "without grazing samples", "t.csv", "--mask", "theta_o > 70")
    expect("without theta_o > 70" in page.ask("$('fitted').innerText"), "what was left out is said beside the answer")
    page.ask("$('words').value = '--robust huber --metric relative --fix f0=0.05'")
    fitted(page, "with options", "t.csv", "--mask", "theta_o > 70", "--robust", "huber", "--metric", "relative", "--fix", "f0=0.05")
    command_makes_the_same(page, "a fit with options")
    # Another model has nothing of it, and it is there again with the model.
    before = page.ask("$('fitted').innerText")
    page.ask("swap([['eon'], ['ggx', 'smith_ggx.correlated', 'schlick']])")
    expect(page.ask("$('fitted').hidden") and page.ask("document.querySelectorAll('.interval').length") == 0, "a fit says nothing of a model that was not fitted")
    page.ask("$('undo').click()")
    expect(page.ask("$('fitted').innerText") == before, "and it is there again with the model")
    page.ask("(() => { const r = $('exact-0'); r.value = 0.3, r.dispatchEvent(new Event('change')); })()")
    expect("You have moved its values since." in page.ask("$('fitted').innerText"), "values that have moved since the fit are said to have")
    page.ask("$('undo').click()")
    expect(page.ask("[$('mask').value, $('words').value]") == ["theta_o > 70", "--robust huber --metric relative --fix f0=0.05"], "undo leaves what is asked")
    link_shows_it(page)
    page.ask("$('words').value = '', $('mask').value = 'theta_o >'")
    said, program = press(page, "fit"), run("fit", "t.csv", "--mask", "theta_o >").stderr.strip()
    expect(said and program.endswith(said), f"a wrong mask: {said}; the program says {program}")
    # Samples that a fit leaves out are spoken of only where it leaves some out.
    beside = lambda fit: page.ask(f"beside_fit({{ fit: {json.dumps(fit)} }}, {{ name: 't.csv' }})")
    expect(beside({"file": "t.csv", "left_out": "theta_o > 70", "copies": True}) == ", with those that the fit leaves out by theta_o > 70 or as copies" and beside({"file": "t.csv", "left_out": "", "copies": False}) == "" and beside({"file": "u.csv", "left_out": "x"}) == "", "what a fit leaves out")
    page.ask("$('mask').value = ''")


def command_makes_the_same(page, what):
    """The command that is copied, and the one that stands under the answer, make the fit that the page made."""
    page.ask("$('copy-fit').click()")
    command, said = page.ask("$('copied').value"), page.ask("$('fitted').querySelector('code').textContent")
    expect(command == said, f"{what}: copied {command}, beside the answer {said}")
    (folder / "fit.json").unlink(missing_ok=True)
    done = subprocess.run(command.replace("gonio ", f"'{gonio}' "), shell=True, cwd=folder, capture_output=True, text=True)
    expect(done.returncode == 0, f"{what}: {command}: {done.stderr}")
    if done.returncode == 0:
        same_fit(document(page), json.loads((folder / "fit.json").read_text()), what)


whole = "[state(), $('fitted').innerText.replace('Save as JSON', '').trim(), document.querySelectorAll('.interval').length, $('mask').value, $('words').value]"


def link_shows_it(page):
    seen, link = page.ask(whole), page.ask("location.href")
    page.open("about:blank", "true")
    page.open(link, idle)
    expect(page.ask(whole) == seen and seen[2] > 0 and "typical factor" in seen[1], f"a link shows what was seen: {page.ask(whole)[1:]}, expected {seen[1:]}")


def table_only(page):
    """A page of a table has a model to begin with, and says what a fit lacks."""
    run("explore", "small.csv", "-o", "table.html")
    page.open("about:blank", "true")
    page.open((folder / "table.html").as_uri(), idle)
    expect(page.ask("items.length === 2 && !$('fit').disabled && !$('choose').disabled && is_model(items[active])"), "a page of a table can be fitted at once")
    page.ask("$('remove').click()")
    expect(page.ask("$('fit').disabled && !$('why').hidden && $('why').textContent"), "a page without a model says what a fit lacks")
    page.ask("$('undo').click(); $('fit').focus(); $('fit').click()")
    page.wait("job !== null")
    expect(page.ask("document.activeElement.id") == "cancel", "while a fit runs the focus is where it can be ended")
    page.wait("job === null && $('status').textContent.startsWith('Fitted')", 120)
    page.wait("document.activeElement.id === 'fit'")
    expect(page.ask("label(items[active])") == page.ask("items[active].about.name"), "a model that was fitted is called by its terms")
    names = page.ask("items.map(label)")
    page.ask("$('what').value = materials().find(([n]) => n.includes('measured'))[0], $('add').click()")
    press(page, "fit")
    expect(page.ask("label(items[active])") == page.ask("items[active].about.name"), "a metal that was fitted is no metal of that name")


def of_files(page):
    (folder / "empty.json").write_text('{"schema":"gonio.fit/1"}')
    page.open((folder / "app.html").as_uri(), idle)
    drop_and_wait(page, "empty.json")
    expect(page.ask("$('status').textContent") == "empty.json: found no model, channels and parameters, as a fit's document has them", f"a document without a fit: {page.ask('$(`status`).textContent')}")
    page.open((folder / "app.html").as_uri(), idle)
    expect(not page.ask("$('drop').hidden") and page.ask("$('fitting').hidden"), "a page without a table asks for one")
    drop_and_wait(page, "t.csv", "t.csv.gonio.json")
    expect(page.ask("items.length === 2 && $('inspection').textContent.includes('usable')"), f"a table is read: {page.ask('$(`status`).textContent')}")
    fitted(page, "a CSV that was dropped", "t.csv")
    page.ask("$('words').value = '--channels r'")
    said = press(page, "fit")
    expect(said.startswith("Fitted") and page.ask("items.length === 3"), f"a fit of one channel stands beside the model that was chosen: {said}")
    one = "items.length === 3 && items[active].channels.join() === 'r' && fit_pair()?.[0].name === 't.csv' && !$('fit').disabled && !$('choose').disabled && $('why').hidden"
    expect(page.ask(one) and ", channel r," in page.ask("$('fitted').innerText"), f"it can be fitted on: {page.ask('$(`why`).textContent')}")
    expect(page.ask("channel_shown() === 'r' && cuts.curves.every((c) => !c.name.includes('channel'))"), "it is drawn over the channel that it was fitted to")
    page.ask("items[active].fit.next = ['--model lambert is nearer'], show_panel(), panel = '', show_panel()")
    expect("Do it" in page.ask("$('fitted').innerText"), "and its advice can be taken")
    page.ask("view.channel = 1, show_view(), draw()")
    expect(page.ask("cuts.curves.some((c) => c.name.endsWith(', channel r')) && cuts.curves.filter((c) => c.name.includes('channel')).length") == 1, "over another channel it has the name of its own")
    said = press(page, "fit")
    expect(said.startswith("Fitted") and page.ask(one), f"a fit of one channel is made again in its place: {said}")
    page.ask("become('Rubber')")
    expect(page.ask("items[active].channels.length === 3 && !$('fit').disabled"), "what it becomes has the table's channels")
    page.ask("$('undo').click(); swap([['eon']])")
    expect(page.ask("$('fit').disabled") and "has 1 channel, t.csv has 3 channels" in page.ask("$('why').textContent"), f"another model of one channel is said to have one: {page.ask('$(`why`).textContent')}")
    page.ask("$('undo').click()")
    page.ask("$('words').value = ''; $('remove').click(); active = items.findIndex(is_model), show_all(), finish()")
    fitted(page, "and the page fits on", "t.csv")
    drop_and_wait(page, "m.binary")
    page.ask("active = items.findIndex((i) => is_model(i) && i.fit?.file === 't.csv'), show_all(), finish()")
    expect("Fits " in page.ask("$('why').textContent") and "to t.csv." in page.ask("$('why').textContent") and not page.ask("$('why').hidden"), f"of two tables it is said which is fitted: {page.ask('$(`why`).textContent')}")
    page.ask("$('what').value = 'Rubber', $('add').click()")
    last = page.ask("fit_pair()[0].name")
    expect(last == "t.csv", f"a new model is fitted to the table that was fitted last: {last}")
    page.ask("$(`pick-${items.findIndex((i) => i.name === 'm.binary')}`).click(), $(`pick-${items.length - 1}`).click()")
    last = page.ask("fit_pair()[0].name")
    expect(last == "m.binary" and "to m.binary." in page.ask("$('why').textContent"), f"or to the one that was chosen since: {last}")
    page.ask("for (let k = 0; k < 3; ++k) $('undo').click()")
    page.ask("active = items.findIndex((i) => is_model(i) && i.fit?.file === 't.csv'), show_all(), finish()")
    expect(page.ask("items[0].name === 'm.binary' && fit_pair()[0].name") == "t.csv", "a model that was fitted is fitted to its table again, though another came since")
    page.ask("active = items.findIndex((i) => i.name === 'm.binary'); $('remove').click(); active = items.findIndex(is_model), show_all(), finish()")
    page.ask("active = items.findIndex((i) => !is_model(i)); $('remove').click()")
    drop_and_wait(page, "m.binary")
    fitted(page, "a MERL table that was dropped", "m.binary")


def limits_and_unknowns(page):
    """A limit is something that is known."""
    document = {"model": model, "channels": ["f"], "parameters": {"alpha": {"value": None, "status": "upper_limit", "limit": 0.002}, "kd": {"value": [None], "status": ["not_identifiable"]}, "f0": {"value": [0.04], "status": ["free"]}}}
    said = lambda optimum: page.ask(f"fitted({json.dumps(json.dumps(document))}, 'x', null, {json.dumps(optimum)}, 'x').fit.said")
    of_the_page, alone = said({"alpha": [0.01], "kd": [0.2], "f0": [0.04]}), said({})
    expect(of_the_page == "Not known: kd. The value here is one of many that fit as well. The fit has only a limit of alpha. The value here is where it ended.", f"a limit: {of_the_page}")
    expect(alone == "The fit has no value for kd, alpha: it begins with another.", f"a limit of a document: {alone}")
    document["parameters"]["kd"] = {"value": [0.2], "status": ["free"]}
    expect(said({"alpha": [0.01]}).startswith("The fit has only a limit of alpha."), "a limit only")


def where_the_answer_is(page):
    """In one column the answer stands below the button, else among the views."""
    place = "$('fitted').previousElementSibling.id"
    expect(page.ask(place) == "facts", f"the answer stands among the views: {page.ask(place)}")
    page("Emulation.setDeviceMetricsOverride", width=420, height=900, deviceScaleFactor=1, mobile=False)
    page.wait(f"{place} === 'fitting'")
    expect(page.ask("$('fitted').getBoundingClientRect().top - $('fit').getBoundingClientRect().bottom") < 250, "in one column it stands below its button")
    expect(page.ask("document.documentElement.scrollWidth") <= 420, "and fits there")
    page("Emulation.setDeviceMetricsOverride", width=1400, height=900, deviceScaleFactor=1, mobile=False)
    page.wait(f"{place} === 'facts'")


def of_a_large_file(page):
    """The program puts no file of more than 16 MiB into a page: a person gives it."""
    run("explore", "m.binary", model, "-o", "large.html")
    page.open((folder / "large.html").as_uri(), idle)
    said = press(page, "fit")
    expect("drop it here" in said, f"a page without its file: {said}")
    drop_and_wait(page, "m.binary")
    expect(page.ask("items.length") == 2, "a file that the page knows is not shown twice")
    fitted(page, "a page that was given its file", "m.binary")


def columns(page):
    page.open("about:blank", "true")
    page.open((folder / "app.html").as_uri(), idle)
    (folder / "t.csv.gonio.json").unlink()
    rows = (folder / "t.csv").read_text().split("\n", 1)
    (folder / "odd.csv").write_text("thetai,phii,thetar,phir,brdf,green,blue\n" + rows[1])
    drop_and_wait(page, "odd.csv")
    said = page.ask("$('status').textContent")
    program = run("inspect", "odd.csv").stderr.strip()
    expect(said and program.endswith(said), f"a file with other names: {said}; the program says {program}")
    expect(page.ask("!$('columns').hidden"), "its columns are shown")
    guess = page.ask("Object.fromEntries([...document.querySelectorAll('#columns select')].map((s) => [s.dataset.role, s.value]))")
    expect(guess.get("theta_o") == "thetar" and guess.get("phi_i") == "phii", f"and guessed: {guess}")
    page.ask("document.querySelector('#columns select[data-role=f]') && (document.querySelector('#columns select[data-role=f]').value = 'green')")
    page.ask("say('waiting'); document.querySelector('#columns button').click()")
    page.wait("$('status').textContent !== 'waiting' && job === null", 60)
    run("columns", "odd.csv", "--map", "theta_i=thetai", "phi_i=phii", "theta_o=thetar", "phi_o=phir", "f=green")
    fitted(page, "columns that a person named", "odd.csv")
    (folder / "odd.csv.gonio.json").unlink()
    command_makes_the_same(page, "columns that a person named")
    page.ask("$('copy-address').click()")
    page.wait("$('status').textContent.includes('odd.csv')")
    # Nothing of it is known, and all that the program may be told has a place.
    page.open("about:blank", "true")
    page.open((folder / "app.html").as_uri(), idle)
    (folder / "letters.csv").write_text("A;B;C;D;E\n" + "".join(f"{out};{phi};{nm};{0.3 + 0.001 * out + 0.1 * (nm == 450)};{1 + out / 50}\n" for nm in (450, 550, 650) for out in range(0, 80, 8) for phi in (0, 90, 180)))
    drop_and_wait(page, "letters.csv")
    said = page.ask("$('columns').innerText")
    expect("--map" not in said and "one angle for all" in said, f"what is not known is said in the page's own words: {said}")
    expect(page.ask("$('angle-theta_i').hidden"), "an angle that is not one for all asks for no number")
    page.ask("for (const [role, value] of Object.entries({ theta_i: '=', theta_o: 'A', phi_o: 'B', channel: 'C', f: 'D' })) { const s = document.querySelector(`#columns select[data-role=${role}]`); s.value = value, s.dispatchEvent(new Event('change')); }")
    expect(page.ask("!$('angle-theta_i').hidden"), "one that is does")
    page.ask("$('angle-theta_i').value = '30', $('columns-forward').value = '0', $('columns-scale').value = '0.5'; say('waiting'); document.querySelector('#columns button').click()")
    page.wait("$('status').textContent !== 'waiting' && job === null", 60)
    expect(page.ask("items[0].channels") == ["450", "550", "650"], f"channels are rows of a column: {page.ask('$(`status`).textContent')}")
    read, written = page.ask("JSON.parse(items[0].data.side).columns"), run("columns", "letters.csv", "--map", "theta_i=30", "theta_o=A", "phi_o=B", "channel=C", "f=D", "--forward", "0", "--scale", "0.5")
    program = json.loads((folder / "letters.csv.gonio.json").read_text())["columns"]
    expect(read == program, f"columns as said in the page: {read}, the program writes {program} {written.stderr}")
    fitted(page, "one angle for all", "letters.csv")
    (folder / "letters.csv.gonio.json").unlink()
    command_makes_the_same(page, "one angle for all")
    # What has no place in the page stays as it was said.
    (folder / "letters.csv.gonio.json").write_text(json.dumps({"schema": "gonio.table/1", "columns": {"theta_i": "30", "theta_o": "A", "phi_o": "B", "channel": "C", "f": "D", "u_percent": "E", "cosines": [0, -1]}}))
    drop_and_wait(page, "letters.csv", "letters.csv.gonio.json")
    page.ask("$('columns-scale').value = '2'; say('waiting'); document.querySelector('#columns button').click()")
    page.wait("$('status').textContent !== 'waiting' && job === null", 60)
    read = page.ask("JSON.parse(items[0].data.side).columns")
    expect(read == {"theta_i": "30", "theta_o": "A", "phi_o": "B", "channel": "C", "f": "D", "scale": 2, "u_percent": "E", "cosines": [0, -1]}, f"uncertainties and cosines stay: {read}")
    expect("--cosines=0,-1 --scale 2" in page.ask("command_of('letters.csv', items[0].data.columns, 'lambert', {})"), "and stand in the command")
    (folder / "letters.csv.gonio.json").unlink()


def troubles(page):
    page.open("about:blank", "true")
    page.open((folder / "app.html").as_uri(), idle)
    (folder / "cut.binary").write_bytes((folder / "m.binary").read_bytes()[:100_000])
    (folder / "words.txt").write_text("no table at all\n")
    for broken in ("cut.binary", "words.txt"):
        drop_and_wait(page, broken)
        said, program = page.ask("$('status').textContent"), run("inspect", broken).stderr.strip()
        expect(said and program.endswith(said), f"{broken}: {said}; the program says {program}")
    (folder / "other.csv.gonio.json").write_text('{"schema":"gonio.table/1"}')
    drop_and_wait(page, "other.csv.gonio.json")
    expect("drop both at once" in page.ask("$('status').textContent"), "a side file without its table is no table")
    hostile = "<img src=x onerror=alert(1)>.csv"
    (folder / hostile).write_text((folder / "t.csv").read_text().replace("f_r", "f_<img src=x onerror=alert(2)>", 1))
    drop_and_wait(page, hostile)
    expect(page.ask("items.length === 2 && document.querySelectorAll('img').length === 0"), "names of files and channels are no markup")
    # One that ends, one that dies, and one after them.
    page.ask("say('waiting'); $('fit').click()")
    page.wait("job !== null")
    page.ask("$('cancel').click()")
    page.wait("job === null")
    expect(page.ask("$('status').textContent") == "Cancelled.", "a fit is cancelled")
    page.ask("globalThis.worker_text = $('worker').textContent; $('worker').textContent = 'throw new Error(\"no more memory\")'")
    said = press(page, "fit")
    expect("The fit stopped" in said and "no more memory" in said, f"a worker that dies: {said}")
    page.ask("$('worker').textContent = worker_text.replace('g.ask(at)', '(() => { throw new WebAssembly.RuntimeError(\"unreachable\"); })()')")
    said = press(page, "fit")
    expect("The fit stopped: unreachable" in said, f"a module that fails: {said}")
    page.ask("$('worker').textContent = worker_text")
    said = press(page, "fit")
    expect(said.startswith("Fitted"), f"and the next fit runs: {said}")


def models_and_saved(page):
    page.open("about:blank", "true")
    page.open((folder / "app.html").as_uri(), idle)
    drop_and_wait(page, "small.csv")
    said = press(page, "choose", 300)
    expect(said == "Compared.", f"models compared: {said}")
    best = page.ask("document.querySelector('#fitted .best td').firstChild.textContent")
    program = json.loads(run("fit", "small.csv", "--models", "all", "--json").stdout)["recommended"]
    expect(best == program, f"models compared: {best}, the program takes {program}")
    said = page.ask("$('fitted').innerText")
    d = json.loads(page.ask("documents.get(compared.id)"))
    expect(all(f"As good: {m}" in said for m in d["as_good"]) and all(f"But: {m}" in said for m in d["disagreement"]) and "--models all" in said, f"all that a comparison says is shown: {said}")
    page.ask("compared.as_good = ['lambert'], compared.disagreement = ['BIC prefers eon.'], show_panel()")
    expect("As good: lambert" in page.ask("$('fitted').innerText") and "But: BIC prefers eon." in page.ask("$('fitted').innerText"), "what is as good, and who disagrees")
    without = page.ask("[...document.querySelectorAll('#fitted tbody tr')].map((tr) => [tr.children[2].textContent, tr.querySelector('button') !== null])")
    expect(any(not take for _, take in without) and all(take == (factor != "–") for factor, take in without), f"only what was fitted can be taken: {without}")
    expect("on incident angles held out of each fit, and orders the list" in said, "how it ranks is said")
    page.ask("document.querySelector('#fitted .best button').focus(); document.querySelector('#fitted .best button').click()")
    page.wait("$('status').textContent.startsWith('Fitted')", 120)
    expect("On incident angles held out of its fit it is off by" in page.ask("$('fitted').innerText"), "a model that was taken says how it does on unseen angles")
    worse = "(before) => unseen_angles(judged.key, 'lambert', before)"
    expect(", worse than " in page.ask(f"({worse})(judged.rows[0][0])") and "worse" not in page.ask(f"({worse})('lambert')") and page.ask("unseen_angles('another', 'lambert', 'eon')") == "", "and whether that is worse than before")
    page.ask("$('undo').click()")
    expect(page.ask("$('fitted').innerText.includes('Models compared')"), "a model that was taken is given back")
    # What fails leaves everything as it was.
    before = page.ask("[state(), past.length]")
    page.ask("say('waiting'); carefully(() => fit_table(undefined, '--bounds nothing=0,1'))()")
    page.wait("$('status').textContent !== 'waiting' && job === null", 60)
    expect(page.ask("$('status').className === 'failed'") and page.ask("[state(), past.length]") == before, "advice that fails leaves no option and no step behind")
    # The models that are here, and those that are advised, are compared, too.
    here, advised = "lambert+ggx/smith_ggx.separable/schlick", "lambert+gtr/smith_ggx.separable/schlick"
    page.ask("$('redo').click(); $('term-Masking').value = 'smith_ggx.separable', $('term-Masking').onchange()")
    press(page, "fit")
    page.ask(f"items[active].fit.next = ['--model {advised} is nearer', '8 angles more']")
    said = press(page, "choose", 300)
    rows = page.ask("compared.rows.map((row) => row[0])")
    expect(said == "Compared." and here in rows and advised in rows and "those on this page, and those that Try offers" in page.ask("$('fitted').innerText"), f"what is here is compared, too: {said} {rows}")
    others = page.ask("compared.command")
    expect(f"--models all,{here},{advised} " in others, f"and so does the command: {others}")
    program = json.loads(run("fit", "small.csv", "--models", f"all,{here},{advised}", "--json").stdout)
    expect(page.ask("compared.recommended") == program["recommended"] and {m["model"] for m in program["models"]} == set(rows), f"as the program does: {page.ask('compared.recommended')}")
    page.ask("$('redo').click()")
    for k in range(8):
        (folder / f"more{k}.csv").write_bytes((folder / "small.csv").read_bytes())
    drop(page, *[f"more{k}.csv" for k in range(8)])
    page.wait("$('status').textContent.startsWith('more6.csv: eight models and tables')", 60)
    for k in range(6):
        page.ask("$('pick-0').click(), $('remove').click()")
    page.ask("$('pick-1').click()")
    page.ask("save = (name, text) => { globalThis.saved = text; }; $('save-page').click()")
    page.wait("globalThis.saved")
    (folder / "saved.html").write_text(page.ask("saved"))
    seen = page.ask(whole)
    page.open("about:blank", "true")
    page.open((folder / "saved.html").as_uri(), idle)
    there = page.ask(whole)
    expect(there[1:] == seen[1:] and json.loads(there[0])["i"][1] == json.loads(seen[0])["i"][1], f"a saved page shows the same: {there[1:]}, expected {seen[1:]}")
    expect(page.ask("$('inspection').textContent.includes('usable')"), "with what the table is")
    expect(page.ask("documents.has(items[active].fit.id)"), "with the document of its fit")
    link_shows_it(page)
    said = press(page, "fit")
    expect(said.startswith("Fitted"), f"and fits: {said}")


with Browser(1400, 900) as page:
    sys.excepthook = lambda *error: (print("\n".join(complaints)), sys.__excepthook__(*error))
    for part in (of_the_program, where_the_answer_is, limits_and_unknowns, table_only, of_files, of_a_large_file, columns, troubles, models_and_saved):
        part(page)
    complaints += page.problems(folder.as_uri())
print("\n".join(complaints))
sys.exit(1 if complaints else 0)
