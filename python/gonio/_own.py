"""Models of one's own.  A Python function becomes a shader: it is called once with symbols, which write down what is done to them."""

from __future__ import annotations

import inspect as _inspect
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as _np

from ._gonio import WrongUsage

_operators = {"add": "+", "subtract": "-", "multiply": "*", "divide": "/", "true_divide": "/"}
_compared = {"less": "<", "less_equal": "<=", "greater": ">", "greater_equal": ">=", "equal": "==", "not_equal": "!="}
_logic = {"logical_and": "&&", "logical_or": "||", "bitwise_and": "&&", "bitwise_or": "||"}
_calls = {"sqrt": "sqrt", "exp": "exp", "log": "log", "exp2": "exp2", "log2": "log2", "sin": "sin", "cos": "cos", "tan": "tan",
          "arcsin": "asin", "arccos": "acos", "arctan": "atan", "arctan2": "atan", "absolute": "abs", "fabs": "abs", "floor": "floor",
          "power": "pow", "float_power": "pow", "maximum": "max", "minimum": "min", "fmax": "max", "fmin": "min", "sign": "sign"}


provided: dict[str, str] = {}
"""Texts of models of one's own, by the names of their files, for the program: a fit of one names its file."""


class OwnModel(str):
    """A function of your own, as ``model`` made it: a spec, or the name of a term within one.

    ``text`` is the shader.  In a file of the name before the colon the program reads the same.
    """

    text: str


class Symbol(_np.lib.mixins.NDArrayOperatorsMixin):
    """A value of the function that is traced: a name in the shader's text."""

    def __init__(self, name: str, is_truth: bool, lines: list[str]) -> None:
        self.name, self.is_truth, self.lines = name, is_truth, lines

    def _made(self, text: str, is_truth: bool = False) -> Symbol:
        name = f"t{len(self.lines)}"
        self.lines.append(f"  {'bool' if is_truth else 'float'} {name} = {text};")
        return Symbol(name, is_truth, self.lines)

    def __array_ufunc__(self, ufunc: _np.ufunc, method: str, *inputs: Any, **named: Any) -> Symbol:
        name = ufunc.__name__
        if method != "__call__" or named:
            raise WrongUsage(f"numpy.{name}: a model is a formula of each sample by itself, without out=, where= and reductions")
        x = [_text(i) for i in inputs]
        if name in _operators:
            return self._made(f"{x[0]} {_operators[name]} {x[1]}")
        if name in _compared:
            return self._made(f"{x[0]} {_compared[name]} {x[1]}", True)
        if name in _logic:
            return self._made(f"{x[0]} {_logic[name]} {x[1]}", True)
        if name in ("logical_not", "invert"):
            return self._made(f"!{x[0]}", True)
        if name == "square":
            return self._made(f"{x[0]} * {x[0]}")
        if name == "reciprocal":
            return self._made(f"1.0 / {x[0]}")
        if name == "negative":
            return self._made(f"-{x[0]}")
        if name == "positive":
            return self
        if name in _calls:
            return self._made(f"{_calls[name]}({', '.join(x)})")
        raise WrongUsage(f"numpy.{name} has no word in a shader: expected {', '.join(sorted({*_operators, *_compared, *_calls}))}")

    def __array_function__(self, function: Callable[..., Any], types: Any, args: tuple[Any, ...], named: dict[str, Any]) -> Symbol:
        if function is _np.where and len(args) == 3 and not named:
            test, yes, no = map(_text, args)
            return self._made(f"{test} ? {yes} : {no}")
        if function is _np.clip and len(args) == 3 and not named:
            x, low, high = map(_text, args)
            return self._made(f"min(max({x}, {low}), {high})")
        raise WrongUsage(f"numpy.{function.__name__} of a model's values: expected where(test, a, b), clip(x, low, high) or a ufunc")

    def __bool__(self) -> bool:
        raise WrongUsage("a model that decides by `if` on its values: expected numpy.where(test, a, b)")

    def __float__(self) -> float:
        raise WrongUsage("a model that makes Python floats of its values, as math.sqrt does: expected numpy's functions")


def _text(x: Any) -> str:
    """The name of a symbol, or a number as GLSL writes it."""
    if isinstance(x, Symbol):
        return x.name
    number = _np.asarray(x)
    if number.ndim != 0 or number.dtype.kind not in "fiub" or not _np.isfinite(float(number)):
        raise WrongUsage(f"a model's constant {x!r}: expected a finite number")
    text = repr(float(number))
    return f"({text})" if text.startswith("-") else text


def shader_of(function: Callable[..., Any], bounds: Mapping[str, Iterable[float]], colours: Iterable[str]) -> tuple[str, str]:
    """GLSL of a function, and its name there."""
    arguments = list(_inspect.signature(function).parameters)
    colours = list(colours)
    for name in (*bounds, *colours):
        if name not in arguments:
            raise WrongUsage(f"{name}: found no such argument, expected one of {', '.join(arguments)}")
    lines: list[str] = []
    value = function(*(Symbol(name, False, lines) for name in arguments))
    if not isinstance(value, Symbol) or value.is_truth:
        raise WrongUsage(f"a model's value: found {type(value).__name__}, expected what numpy makes of its arguments")
    declared = [f"// {name} {' '.join(repr(float(x)) for x in ends)}" for name, ends in bounds.items()]
    head = ", ".join(f"float {name}" for name in arguments)
    text = [*declared, f"float one_channel({head}) {{", *lines, f"  return {value.name};", "}"]
    if colours:
        head = ", ".join(f"{'vec3' if name in colours else 'float'} {name}" for name in arguments)
        channels = (", ".join(f"{name}.{c}" if name in colours else name for name in arguments) for c in "rgb")
        text += [f"vec3 brdf({head}) {{", f"  return vec3({', '.join(f'one_channel({c})' for c in channels)});", "}"]
    return "\n".join(text) + "\n", "brdf" if colours else "one_channel"
