"""Fits analytic BRDF models to tabulated reflectance, and says how far to trust the result.

The functions are the program's commands, their arguments its options, and their results its documents: what ``gonio fit FILE --json``
prints is ``gonio.fit(FILE).text``, to the byte but for times.  Angles are in degrees, f is in 1/sr without the cosine.

Arrays go in and come out without a copy where that is possible; each function says where it copies.  Calls that work let other
threads of Python run meanwhile, and an interrupt ends them at their next step.

Errors are one line each, as the program's: ``WrongUsage`` of a call that nothing can be made of, ``BadInput`` of a file or an array
that is not what it should be.  Both are ``gonio.Error`` and ``ValueError``.  They call options by the program's names: ``--mu`` is ``mu``.
"""

from __future__ import annotations

import functools as _functools
import hashlib as _hashlib
import inspect as _inspect
import json as _json
import os as _os
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, TypeVar, Union
from typing import overload as _overload

import numpy as _np
import numpy.typing as _npt

from . import _gonio
from ._commands import columns, compare, convert, explore, export, fit_map, plan, render, report, stack, validate
from ._document import Document, Path
from ._fit import Fit, Parameter, Parameters
from ._gonio import BadInput, Error, WrongUsage, __version__
from ._own import OwnModel
from ._own import provided as _provided
from ._own import shader_of as _shader_of

__all__ = [
    "BadInput", "Document", "Error", "Fit", "OwnModel", "Parameter", "Parameters", "Table", "WrongUsage", "__version__", "albedo", "audit",
    "columns", "compare", "convert", "eval", "evaluate", "explore", "export", "fit", "fit_map", "inspect", "model", "models", "plan", "read",
    "render", "report", "stack", "synth", "term", "validate",
]

Values = Union[float, Sequence[float], _npt.NDArray[Any], str]
"""One number, one for each channel, or a word, as in ``metal="Au"``."""


class Table:
    """Samples of reflectance: where each was taken, and its values.

    Made by ``read``, by ``synth``, or of arrays::

        Table(theta_i, phi_i, theta_o, phi_o, values, channels=["r", "g", "b"])

    Args:
        theta_i, phi_i, theta_o, phi_o: zenith angles in [0, 180] and azimuths in [-360, 360] degrees, to the light and to the detector.
            Arrays that broadcast to one shape, of n samples in all; phi_o = phi_i + 180 is the mirror's side.
        values: f in 1/sr, without the cosine: n numbers, or ``[..., channel]``.  NaN, negative ones and those below the horizon are
            kept and not fitted.
        channels: their names; "f" of one, "r", "g", "b" of three unless given.
        weights: n numbers from 0 on, or none for all 1.
        name: stands in documents where a file's path would.

    The arrays are copied once.  Their SHA-256, columns one after the other, stands in documents for that of a file.

    Raises:
        BadInput: an angle, a weight or a channel that is none; light that comes from below in most samples.
        WrongUsage: arrays that do not go together.
    """

    def __init__(self, theta_i: _npt.ArrayLike, phi_i: _npt.ArrayLike, theta_o: _npt.ArrayLike, phi_o: _npt.ArrayLike,
                 values: _npt.ArrayLike, *, channels: Sequence[str] = (), weights: _npt.ArrayLike | None = None,
                 name: str = "array") -> None:
        columns, shape = _columns(theta_i, phi_i, theta_o, phi_o)
        f = _numbers("values", values)
        if f.shape == shape:
            f = f[..., _np.newaxis]
        if f.shape[:-1] != shape:
            raise WrongUsage(f"values: of shape {f.shape}, where directions are of shape {shape}")
        planes = [_np.ascontiguousarray(f[..., c]).reshape(-1) for c in range(f.shape[-1])]
        w = None if weights is None else _numbers("weights", weights).reshape(-1)
        a, b, c, d = columns
        self._table = _gonio.table(name, a, b, c, d, planes, list(channels), w)

    @classmethod
    def _of(cls, table: _gonio.Table) -> Table:
        made = cls.__new__(cls)
        made._table = table
        return made

    def __len__(self) -> int:
        return len(self._table)

    def __repr__(self) -> str:
        return f"<gonio.Table {self.path}: {len(self)} samples, channels {' '.join(self.channels)}>"

    def __getitem__(self, channel: str) -> _npt.NDArray[_np.float64]:
        """f of a channel, by its name: n numbers in 1/sr, in place and not to be written to."""
        try:
            return self._table.column(self.channels.index(channel))
        except ValueError:
            raise KeyError(f"{channel}: the channels are {', '.join(self.channels)}") from None

    @property
    def values(self) -> _npt.NDArray[_np.float64]:
        """f in 1/sr, ``[sample, channel]``: a copy.  ``table["r"]`` is a channel in place."""
        return _np.stack([self[c] for c in self.channels], axis=-1)

    @property
    def theta_i(self) -> _npt.NDArray[_np.float64]:
        """Zenith angles of the light [degrees].  In place, of a grid computed at each call; so are the three others."""
        return self._table.angle(0)

    @property
    def phi_i(self) -> _npt.NDArray[_np.float64]:
        """Azimuths of the light [degrees]."""
        return self._table.angle(1)

    @property
    def theta_o(self) -> _npt.NDArray[_np.float64]:
        """Zenith angles of the detector [degrees]."""
        return self._table.angle(2)

    @property
    def phi_o(self) -> _npt.NDArray[_np.float64]:
        """Azimuths of the detector [degrees]."""
        return self._table.angle(3)

    @property
    def weights(self) -> _npt.NDArray[_np.float64] | None:
        """n numbers, in place; None where all are 1."""
        w = self._table.weights()
        return w if len(w) else None

    @property
    def channels(self) -> list[str]:
        """Names of the channels."""
        return self._table.channels

    @property
    def path(self) -> str:
        """The file it was read from, or its name."""
        return self._table.path

    @property
    def sha256(self) -> str:
        """Of the file's bytes, or of the arrays."""
        return self._table.sha256

    @property
    def format(self) -> str:
        """"csv", "merl", "mbsdf", "exr", "rgl" …: that ``write`` writes."""
        return self._table.format

    @property
    def bins(self) -> str | None:
        """"centre" or "edge": where samples sit in their bins; None where there are no bins."""
        return self._table.bins if self._table.has_bins else None

    @property
    def warnings(self) -> list[str]:
        """What is odd about the file or the arrays, though they could be read."""
        return self._table.warnings

    def write(self, path: Path) -> None:
        """Writes the table in its format, and beside it what that does not hold.

        Raises:
            BadInput: a file that cannot be written.
        """
        _gonio.write(self._table, _os.fspath(path))


Model = Union[str, Mapping[str, Any]]
"""A spec or a preset as ``models`` lists them; the path of a fit.json; a fit's document; or a shader: ``FILE[:FUNCTION]``, or what ``model`` gives."""


_languages = ("glsl", "hlsl", "brdf", "frag")


def model(source: str | Callable[..., Any], function: str = "", *, language: str = "glsl", bounds: Mapping[str, Sequence[float]] | None = None,
          colours: str | Iterable[str] = (), includes: str = "", arguments: Mapping[str, str] | None = None) -> OwnModel:
    """A shader's text, or a Python function over NumPy arrays, as a model that stands wherever a spec stands::

        mine = gonio.model(text, "D_GGX")
        gonio.audit(mine)
        gonio.fit(table, f"{mine}/smith_ggx.correlated/schlick")

        def glossy(NoH, NoL, NoV, alpha, kd):
            a2 = alpha**2
            return kd / np.pi + a2 / (np.pi * (NoH**2 * (a2 - 1) + 1)**2) / 4
        gonio.fit(table, gonio.model(glossy, bounds={"alpha": (0.01, 1), "kd": (0, 1)}, colours="kd"))

    A Python function is called once, with symbols that write down what is done to them; from then on the formula runs as a shader does, with
    exact derivatives, in every number.  It may use NumPy's arithmetic, comparisons, ``where``, ``clip`` and the usual functions.

    Args:
        source: the text, or the function.  Arguments are cosines and directions by their usual names (``docs/task/own_model.md``), all
            others parameters; a Python function takes cosines.
        function: the one that is meant, of a text with several.
        language: "glsl", "hlsl", or "brdf" of Disney's BRDF Explorer.
        bounds: of parameters that the text does not give any: ``{"alpha": (0.01, 1)}``, with a default ``(0.01, 1, 0.2)``; one number fixes it.
        colours: parameters of a Python function that have one value a channel.
        includes: what the value has beside f, where gonio's guess is wrong: "nothing", "cosine", "pi", "cosine,pi"; of masking "g" or "v".
        arguments: what arguments stand for, where their names do not say it: ``{"x": "noh"}``, ``{"n": "parameter"}``.

    Raises:
        BadInput: a text that does not compile, with its line, or that cannot be run.
        WrongUsage: a function that cannot be written down.
    """
    bounds = dict(_by_name("bounds", bounds, '{"alpha": (0.01, 1)}'))
    if callable(source):
        if language != "glsl" or function:
            raise WrongUsage("language and function go with a shader's text, not with a Python function")
        text, function = _shader_of(source, {n: b for n, b in bounds.items() if _np.ndim(b) > 0}, _words(colours) if colours else ())
        bounds = {n: b for n, b in bounds.items() if _np.ndim(b) == 0}
    else:
        text = source
        if colours:
            raise WrongUsage("colours go with a Python function: a shader's text says vec3")
        if language not in _languages:
            raise WrongUsage(f"language: found {language}, expected one of {', '.join(_languages)}")
    file = f"own_{_hashlib.sha256(text.encode()).hexdigest()[:12]}.{language}"
    _gonio.provide(file, text)
    _provided[file] = text
    words = [f"argument.{x}={y}" for x, y in _by_name("arguments", arguments, '{"x": "noh"}').items()]
    words += [f"includes={includes}"] if includes else []
    words += [f"{n}={','.join(repr(float(x)) for x in _np.atleast_1d(b))}" for n, b in bounds.items()]
    made = OwnModel(_gonio.own_name(f"{file}{':' + function if function else ''}{'{' + ';'.join(words) + '}' if words else ''}"))
    made.text = text
    return made


def _numbers(name: str, x: _npt.ArrayLike) -> _npt.NDArray[_np.float64]:
    """The same array where it is one of doubles, contiguous; else a copy that is.  What is masked is NaN."""
    try:
        a = _np.asarray(x)
        if a.dtype.kind not in "fiub":
            raise TypeError(a.dtype)
        if isinstance(x, _np.ma.MaskedArray):
            a = x.astype(_np.float64).filled(_np.nan)  # type: ignore[attr-defined]
        return _np.ascontiguousarray(a, dtype=_np.float64).reshape(a.shape)
    except (TypeError, ValueError) as e:
        raise WrongUsage(f"{name}: not an array of numbers ({e})") from None


def _columns(*angles: _npt.ArrayLike) -> tuple[list[_npt.NDArray[_np.float64]], tuple[int, ...]]:
    """The four angles as columns of one length, and the shape that they had."""
    names = ("theta_i", "phi_i", "theta_o", "phi_o")
    arrays = [_numbers(n, a) for n, a in zip(names, angles)]
    try:
        shape = _np.broadcast_shapes(*(a.shape for a in arrays))
    except ValueError:
        raise WrongUsage(f"directions: shapes {', '.join(str(a.shape) for a in arrays)} do not go together") from None
    return [_np.ascontiguousarray(_np.broadcast_to(a, shape)).reshape(-1) for a in arrays], shape


def _by_name(option: str, x: Mapping[str, Any] | None, example: str) -> Mapping[str, Any]:
    """The option, where its names have values."""
    if x is None or isinstance(x, Mapping):
        return x or {}
    raise WrongUsage(f"{option}: found {type(x).__name__}, expected a dict, as {example}")


def _words(x: str | Iterable[str]) -> list[str]:
    """Words of a list, or of a text with commas, as the program takes it."""
    return [word.strip() for word in x.split(",")] if isinstance(x, str) else list(x)


def _settings(parameters: Mapping[str, Values]) -> list[tuple[str, list[float], str]]:
    """Parameters as the module takes them: a name, its numbers, and its text."""
    all_of_them: list[tuple[str, list[float], str]] = []
    for name, value in parameters.items():
        if isinstance(value, str):
            if name != "metal":
                raise WrongUsage(f"{name}: a number, or one for each channel")
            all_of_them.append((name, [], value))
        else:
            all_of_them.append((name, _numbers(name, value).reshape(-1).tolist(), ""))
    return all_of_them


def _model(model: Model, parameters: Mapping[str, Values]) -> _gonio.Model:
    if isinstance(model, Mapping):
        text = model.text if isinstance(model, Document) else _json.dumps(model)
        return _gonio.model_of_document(text, _settings(parameters))
    return _gonio.model(_os.fspath(model), _settings(parameters))


_Result = TypeVar("_Result")
_examples = {"fix": '{"f0": 0.05}', "bounds": '{"alpha": (0.05, 0.5)}'}


def _with_options(options: type[Any], rest: str = "") -> Callable[[Callable[..., _Result]], Callable[..., _Result]]:
    """Function whose keywords are those that a struct of the program declares, with their defaults, and their meanings in its doc.

    It is called with ``options`` made of them; others go to ``rest``.
    """
    declared = {name: (annotation, about, _default(annotation, word)) for name, annotation, about, word in options.declared()}

    def declare(function: Callable[..., _Result]) -> Callable[..., _Result]:
        own = _inspect.signature(function)
        kept = [p.replace(default=declared[p.name][2]) if p.name in declared else p for p in own.parameters.values() if p.name != "options"]
        last = [kept.pop()] if rest else []
        kept += [_inspect.Parameter(name, _inspect.Parameter.KEYWORD_ONLY, default=default, annotation=annotation)
                 for name, (annotation, _, default) in declared.items() if name not in own.parameters]
        signature = own.replace(parameters=kept + last)

        @_functools.wraps(function)
        def call(*positions: Any, **named: Any) -> _Result:
            given = signature.bind(*positions, **named).arguments
            taken = {name: given.pop(name) for name in declared if name in given}
            others = given.pop(rest, {})
            words = {name: _in_words(name, declared[name][0], value) for name, value in taken.items() if value is not None}
            return function(**others, options=options(words), **given)

        call.__signature__ = signature  # type: ignore[attr-defined]
        meanings = [f"{name}: {about}{', as ' + _examples[name] if name in _examples else ''}." for name, (_, about, _) in declared.items()]
        call.__doc__ = (function.__doc__ or "").replace("{options}", "\n        ".join(meanings))
        return call
    return declare


def _default(annotation: str, word: str) -> Any:
    """A declared default; None where there is no word for it."""
    if annotation.startswith("Iterable"):
        return ()
    known: dict[str, Callable[[str], Any]] = {"int": int, "float": float, "bool": "true".__eq__}
    read = known.get(annotation, str)
    return read(word) if word else None


def _in_words(name: str, annotation: str, value: Any) -> list[str]:
    """An option's value as the program's words."""
    if annotation.startswith("Mapping"):
        return [f"{key}={text or ','.join(map(repr, numbers))}" for key, numbers, text in _settings(_by_name(name, value, _examples[name]))]
    if annotation == "Iterable[str]":
        return _words(value)
    if annotation == "Iterable[float]":
        return [repr(x) for x in _numbers(name, value).reshape(-1).tolist()]
    return [str(value).lower() if isinstance(value, (bool, _np.bool_)) else str(value)]


def read(path: Path, *, bins: str | None = None) -> Table:
    """Table of a file, its format found from the bytes: ``gonio inspect FILE`` says what it holds.

    Args:
        bins: "centre" or "edge": where samples sit in their bins; else what the file says, or "centre".

    Raises:
        BadInput: a file that cannot be read as what it claims, with the place.
    """
    return Table._of(_gonio.read(_os.fspath(path), bins))


def inspect(table: Table | Path) -> Document:
    """What a table holds and what a fit of it can hope for: the document of ``gonio inspect --json``.

    Raises:
        BadInput: as ``read``.
    """
    return Document(_gonio.inspect((table if isinstance(table, Table) else read(table))._table))


@_overload
def fit(table: Table | Path, model: str = "", *, models: None = None, jobs: int = 0, **options: Any) -> Fit: ...
@_overload
def fit(table: Table | Path, model: str = "", *, models: str | Iterable[str], jobs: int = 0, **options: Any) -> Document: ...
@_with_options(_gonio.HowFitted)
def fit(table: Table | Path, model: str = "", *, models: str | Iterable[str] | None = None, jobs: int = 0,
        options: _gonio.HowFitted) -> Fit | Document:
    """Model fitted to a table, or several compared: the document of ``gonio fit --json``.

    Args:
        table: a ``Table`` or a file.
        models: models to compare in place of one fit, a list or a text with commas, or "all" for the usual ones; the document says which
            to take.  ``gonio.models`` lists what there is.
        jobs: threads, at most; 0 for all.  The result is the same for any number.
        {options}

    Returns:
        A ``Fit``, the document ``gonio.fit/1`` with ``params``, ``warnings``, ``predict`` and ``residuals``; or ``gonio.models/1`` of several.  A fit that did not converge says so at ``["solver"]["termination"]``: that is no
        error here.  ``gonio.eval`` takes the document of a fit as a model.

    Raises:
        WrongUsage: an option that is none, or that does not fit the model.
        BadInput: as ``read``; a table without a usable value.

    Source: ``docs/document/fit.md`` has every key, ``docs/equations/sources.md`` the papers.
    """
    compared = None if models is None else _words(models)
    if compared == []:
        raise WrongUsage('models: found none, expected models to compare, or "all"')
    if isinstance(table, Table):
        if compared is None:
            return Fit(_gonio.fit_table(table._table, options, jobs), table)
        return Document(_gonio.compare_table(table._table, options, compared, jobs))
    path = _os.fspath(table)
    if compared is None:
        return Fit(_gonio.fit_path(path, options, jobs), path)
    return Document(_gonio.compare_path(path, options, compared, jobs))


def eval(model: Model | Table, theta_i: _npt.ArrayLike, phi_i: _npt.ArrayLike, theta_o: _npt.ArrayLike, phi_o: _npt.ArrayLike, *,
         jobs: int = 0, **parameters: Values) -> _npt.NDArray[_np.float64]:
    """f of a model at directions, or of a table between its samples: the values of ``gonio eval``.

    Args:
        model: a model, a fit, or a ``Table`` that is a grid or comes from an RGL file.
        theta_i, phi_i, theta_o, phi_o: zenith angles in [0, 180] and azimuths in [-360, 360] degrees; arrays that broadcast to one shape.
            Those of doubles, contiguous and of that shape are read in place; others are copied.
        parameters: of the model: ``alpha=0.2``, ``kd=(0.2, 0.1, 0.05)``, ``metal="Au"``; those left out have their defaults.

    Returns:
        f in 1/sr without the cosine, of that shape and with the channels last, not copied.  0 below the horizon; of a table NaN where it
        has no value.  Channels lie one after the other in memory: ``f[..., c]`` is contiguous.

    Raises:
        WrongUsage: a model or a parameter that is none.
        BadInput: an angle that is none; a table at single directions.

    Source: ``models`` names the paper of each term.
    """
    (a, b, c, d), shape = _columns(theta_i, phi_i, theta_o, phi_o)
    if isinstance(model, Table):
        if parameters:
            raise WrongUsage("parameters go with a model, not with a table")
        f = _gonio.interpolate(model._table, a, b, c, d)
    else:
        f = _gonio.evaluate(_model(model, parameters), a, b, c, d, jobs)
    return _np.moveaxis(f.reshape(f.shape[:1] + shape), 0, -1)


evaluate = eval


@_with_options(_gonio.AlbedoQuestion, rest="parameters")
def albedo(model: Model, mu: float | Iterable[float] = (), *, jobs: int = 0, options: _gonio.AlbedoQuestion, **parameters: Values) -> Document:
    """Share of light that a model gives back, with a bound of its error: the document of ``gonio albedo --json``.

    Args:
        {options}
        parameters: as in ``eval``.

    Raises:
        WrongUsage: a cosine outside (0, 1], a model that this scattering does not know, an option that is none.
        BadInput: an integral that diverges.

    Source: ``docs/equations/scattering.md``.
    """
    name = model if isinstance(model, str) else "document"
    return Document(_gonio.albedo(_model(model, parameters), name, options, jobs))


def term(id: str, at: Mapping[str, _npt.ArrayLike] | None = None, *, number: str = "double",
         **parameters: float) -> _npt.NDArray[_np.float64]:
    """One factor of a model, or a map of parameters, on its own: the values of ``gonio term``.

    Args:
        id: as ``models`` lists it: "ndf.ggx".
        at: columns by name, copied: cosines noh, nol, nov, voh or cos; of the tangent frame xoh, yoh, xol, yol, xov, yov; sin2_theta_h.  Of
            a map its parameters.  A column of one value serves all rows.
        number: "double", "float", "half" (rounded after each operation), "wide" (fifty digits) or "mixed".
        parameters: of the term; ``roughness`` is taken for ``alpha``, too.

    Returns:
        D in 1/sr, F, or G2 (G1 where only nov is given), one for each row; of a map of several outputs ``[row, output]``.

    Raises:
        WrongUsage: a term, a parameter or an angle that is none, or that the term does not read.
    """
    columns = {n: _numbers(n, x).reshape(-1).tolist() for n, x in _by_name("at", at, '{"noh": [1, 0.9]}').items()}
    for name, x in parameters.items():
        if _numbers(name, x).ndim != 0:
            raise WrongUsage(f"{name}: found several numbers, expected one; what a term is evaluated at goes into at={{\"{name}\": …}}")
    values = _gonio.term(id, number, {n: float(x) for n, x in parameters.items()}, columns)
    return values[:, 0] if values.shape[1] == 1 else values


@_with_options(_gonio.SynthOptions, rest="parameters")
def synth(model: Model, layout: str, *, aperture: str | None = None, jobs: int = 0, options: _gonio.SynthOptions, **parameters: Values) -> Table:
    """Table sampled from a model, with noise if asked: what ``gonio synth`` writes.

    Args:
        layout: "merl", "mbsdf", "utia", "rgl", "in_plane", "image_slice", "hemisphere" or "random".
        aperture: full widths of the cones of light and detector in degrees, as "0.7,0.35", that each value is the mean over.
        {options}
        parameters: as in ``eval``.

    Raises:
        WrongUsage: a layout, a number or a parameter that is none.
    """
    return Table._of(_gonio.synth(_model(model, parameters), layout, options, aperture or "", jobs))


def audit(ids: str | Iterable[str] = (), *, jobs: int = 0) -> Document:
    """What entries of the catalogue keep and break of what a BRDF must keep: the document of ``gonio audit --json``.

    Args:
        ids: terms, maps or models as ``models`` lists them, or one shader; none for all, which takes a minute.

    Raises:
        WrongUsage: an id that is none; the line names the nearest.
    """
    named = [ids] if isinstance(ids, str) else list(ids)
    own = [i for i in named if _gonio.is_own(i)]
    if own and len(named) > 1:
        raise WrongUsage("ids: found a shader among several, expected it by itself")
    return Document(_gonio.audit_file(own[0], jobs) if own else _gonio.audit(named, jobs))


def models(word: str = "") -> Document:
    """Terms that models are made of, maps, whole models and metals: the document of ``gonio models --json``.

    Args:
        word: only those that hold it in their id, title or source, or have a parameter of that name; a shader has its functions listed.

    Raises:
        WrongUsage: a word that none holds.
    """
    return Document(_gonio.models(word))
