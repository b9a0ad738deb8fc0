"""Commands that end in files: the program does them, beside the module or where ``GONIO_PROGRAM`` says."""

from __future__ import annotations

import os as _os
import subprocess as _subprocess
import tempfile as _tempfile
from collections.abc import Iterator
from contextlib import ExitStack as _ExitStack
from contextlib import contextmanager as _contextmanager
from typing import Any, Literal

from ._document import Document, Path
from ._gonio import BadInput, Error, WrongUsage
from ._own import OwnModel, provided
from ._program import PROGRAM

Target = Literal["gltf", "mitsuba", "standard_surface", "open_pbr", "usd_preview"]


class _WithShaders(str):
    """Path of a document whose shaders lie beside it: the program looks for them in the folder that it runs in."""


def _run(command: str, words: list[Path], options: dict[str, Any]) -> str:
    """Standard output of the program, which an interrupt ends, too."""
    at = next((_os.path.dirname(word) for word in words if isinstance(word, _WithShaders)), None)
    if at:
        words = [_os.path.abspath(word) if _os.path.exists(word) else word for word in words]
        options = {name: _os.path.abspath(value) if name == "output" else value for name, value in options.items()}
    call = [_os.environ.get("GONIO_PROGRAM") or _os.fspath(PROGRAM), command, *(_os.fspath(word) for word in words)]
    for name, value in options.items():
        option = "--" + name.replace("_", "-")
        if value is True:
            call.append(option)
        elif value is not None and value is not False:
            many = [value] if isinstance(value, (str, _os.PathLike)) or not hasattr(value, "__iter__") else list(value)
            call += [option, *map(str, many)]
    try:
        done = _subprocess.run(call, stdin=_subprocess.DEVNULL, capture_output=True, text=True, encoding="utf-8", check=False, cwd=at)
    except FileNotFoundError:
        raise Error(f"{call[0]}: no program gonio: it comes with the wheel; else name it by GONIO_PROGRAM") from None
    said = done.stderr.strip().removeprefix("gonio: ")
    if done.returncode == 2:
        raise WrongUsage(said)
    if done.returncode not in (0, 1, 4):  # 1: a check failed, 4: not converged; the document says so
        raise BadInput(said)
    return done.stdout


@_contextmanager
def _as_file(thing: Any, ending: str) -> Iterator[Path]:
    """The path of a table, of a document or of a model of one's own, written where it has none."""
    if isinstance(thing, (str, _os.PathLike)) and not isinstance(thing, OwnModel):
        yield thing
        return
    with _tempfile.TemporaryDirectory(prefix="gonio-") as folder:
        if isinstance(thing, OwnModel):  # of which the program reads the text
            name = _os.path.join(folder, thing.partition(":")[0])
            with open(name, "w", encoding="utf-8") as file:
                file.write(thing.text)
            yield _os.path.join(folder, thing)
            return
        path = _os.path.join(folder, "it" + ending)
        thing.write(path)
        for name, text in provided.items() if isinstance(thing, Document) else ():
            if name in thing.text:
                with open(_os.path.join(folder, name), "w", encoding="utf-8") as file:
                    file.write(text)
                path = _WithShaders(path)
        yield path


def compare(table: Any, model: Any, **options: Any) -> Document:
    """How far a model or a fit is from a table: the document of ``gonio compare --json``.

    Args:
        table: a ``Table`` or a file.
        model: a model, a fit, or the file of one.
        options: those of the program, as ``set=["alpha=0.2"]``, ``mask="theta_o > 80"``.

    Raises:
        WrongUsage: an option or a model that is none.
        BadInput: a file that cannot be read.
    """
    with _as_file(table, ".csv") as t, _as_file(model, ".json") as m:
        return Document(_run("compare", [t, m], {**options, "json": True}))


def convert(source: Any, output: Path, to: str, **options: Any) -> Document:
    """Writes a table in another format and says what that loses: the document of ``gonio convert --json``.

    Args:
        source: a ``Table`` or a file.
        output: the file to write.
        to: its format: "merl", "mbsdf", "utia", "csv", "rgl", "image_slice", "zemax" and what ``gonio convert --help`` lists.
        options: those of the program.

    Raises:
        WrongUsage, BadInput: as ``compare``.
    """
    with _as_file(source, ".csv") as s:
        return Document(_run("convert", [s, output], {"to": to, **options, "json": True}))


def columns(path: Path, map: dict[str, str] | None = None, **options: Any) -> Document:
    """Says what the columns of a CSV file are, beside it, or shows what they look like: the document of ``gonio columns --json``.

    Args:
        path: the file.
        map: ``{"theta_i": "incident", "f": "bsdf"}``; none to be shown the file's own.
        options: those of the program, as ``radians=True``, ``scale=0.3183``.

    Raises:
        WrongUsage, BadInput: as ``compare``.
    """
    words = [f"{name}={column}" for name, column in (map or {}).items()]
    return Document(_run("columns", [path], {**({"map": words} if words else {}), **options, "json": True}))


def export(fit: Any, to: Target, output: Path, **options: Any) -> Document:
    """Writes a fit, or a map, as another program's material, and says how far that is from it: the document of ``gonio export --json``.

    Args:
        fit: a fit or its file, or a map.
        to: the target.
        output: the file to write.
        options: those of the program, as ``preview=True``.

    Raises:
        WrongUsage, BadInput: as ``compare``.
    """
    with _as_file(fit, ".json") as f:
        return Document(_run("export", [f], {"to": to, **options, "output": output, "json": True}))


def plan(scene: Path, output: Path | None = None, **options: Any) -> Document:
    """Which optical effects a scene calls for: the document of ``gonio plan --json``.

    Args:
        scene: the file of a scene.
        output: where the plan is kept; none: nowhere.
        options: those of the program.

    Raises:
        WrongUsage, BadInput: as ``compare``.
    """
    return Document(_run("plan", [scene], {**options, "output": output, "json": True}))


def validate(choice: Path, **options: Any) -> Document:
    """Whether a choice of a model keeps its budgets: the document of ``gonio validate --json``.

    Args:
        choice: the file of a choice.
        options: those of the program, as ``suggest=True``.

    Raises:
        WrongUsage, BadInput: as ``compare``.  A budget that is broken is no error: the document says so.
    """
    return Document(_run("validate", [choice], {**options, "json": True}))


def render(scene: Path, output: Path, **options: Any) -> Document:
    """A picture of a scene: the document of ``gonio render --json``.

    Args:
        scene: the file of a scene.
        output: the picture, .png or .exr.
        options: those of the program, as ``width=256``.

    Raises:
        WrongUsage, BadInput: as ``compare``.
    """
    return Document(_run("render", [scene], {**options, "output": output, "json": True}))


def explore(*what: Any, output: Path, **options: Any) -> Document:
    """A page to play with, of models, fits and tables side by side: the document of ``gonio explore --json``.

    Args:
        what: eight at most: a ``Table``, a fit, a model, or the file of one.
        output: the page, .html.
        options: those of the program.

    Raises:
        WrongUsage, BadInput: as ``compare``.
    """
    with _ExitStack() as files:
        words = [files.enter_context(_as_file(w, ".json" if isinstance(w, dict) else ".csv")) for w in what]
        return Document(_run("explore", words, {**options, "output": output, "json": True}))


def fit_map(stack: Path, output: Path, model: str | None = None, **options: Any) -> Document:
    """A model fitted to each texel of a stack: the document of ``gonio fit_map --json``.

    Args:
        stack: the file of a stack.
        output: the map, OpenEXR.
        model: as in ``fit``.
        options: those of the program.

    Raises:
        WrongUsage, BadInput: as ``compare``; directions that are not the images' own.
    """
    with _as_file(model or "", ".json") as m:
        return Document(_run("fit_map", [stack], {"model": m or None, **options, "output": output, "json": True}))


def stack(lamps: Path, output: Path, **options: Any) -> Document:
    """Makes the stack of a map from photographs and the list of their lamps: the document of ``gonio stack --json``.

    Args:
        lamps: the list, ``.lp``.
        output: the document to write; the images lie in its folder or below.
        options: those of the program, as ``linear=True``, ``white=0.8``.

    Raises:
        WrongUsage, BadInput: as ``compare``.
    """
    return Document(_run("stack", [lamps], {**options, "output": output, "json": True}))


def report(name: str, output: Path = "reports", **options: Any) -> str:
    """Makes a report, as "schlick", or "all" of them, in a folder: what ``gonio report`` prints.

    Args:
        name: of the report.
        output: the folder.
        options: those of the program.

    Raises:
        WrongUsage, BadInput: as ``compare``.
    """
    return _run("report", [name], {**options, "output": output})
