"""A fit as people ask it: parameters by attribute, arrays by channel, what it predicts, what it leaves."""

from __future__ import annotations

import html as _html
import math as _math
import os as _os
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as _np
import numpy.typing as _npt

from ._document import Document

Array = _npt.NDArray[_np.float64]


@dataclass(frozen=True)
class Parameter:
    """A fitted parameter.  Each array has one entry for each channel, or one where all channels share the value."""

    name: str
    value: Array
    """NaN where the data do not determine it."""
    std_error: Array
    """NaN where the status is not "free"."""
    ci95: Array
    """Interval of 95 %, ``[channel, 2]``; NaN where there is none."""
    status: tuple[str, ...]
    """"free", "fixed", "at_bound", "not_identifiable" or as the document says."""
    reason: tuple[str, ...]
    """Why a value is not known; "" where it is."""

    def __float__(self) -> float:
        """The value, where channels share it."""
        if self.value.size != 1:
            raise TypeError(f"{self.name} has a value for each of {self.value.size} channels: {self.name}.value[0]")
        return float(self.value[0])

    def __repr__(self) -> str:
        return f"{self.name} = " + ", ".join(_with_error(v, e, s) for v, e, s in zip(self.value, self.std_error, self.status))


class Parameters:
    """Parameters of a fit: ``fit.params.alpha``, ``fit.params["alpha"]``, and all of them in a loop."""

    def __init__(self, document: dict[str, Any]) -> None:
        self._all = {name: _parameter(name, p) for name, p in document.items()}

    def __getattr__(self, name: str) -> Parameter:
        try:
            return self.__dict__["_all"][name]  # type: ignore[no-any-return]
        except KeyError:
            raise AttributeError(f"no parameter {name}; there are {', '.join(self.__dict__.get('_all', ()))}") from None

    def __getitem__(self, name: str) -> Parameter:
        return self._all[name]

    def __iter__(self) -> Iterator[Parameter]:
        return iter(self._all.values())

    def __len__(self) -> int:
        return len(self._all)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._all]

    def __repr__(self) -> str:
        return "\n".join(map(repr, self))


class Fit(Document):
    """The document of a fit, a ``dict`` with the keys of ``docs/document/fit.md``, and what one asks of it first."""

    def __init__(self, text: str, table: Any = None) -> None:
        super().__init__(text)
        self._table = table

    @property
    def document(self) -> dict[str, Any]:
        """The whole document."""
        return dict(self)

    @property
    def params(self) -> Parameters:
        """Parameters with their errors, intervals and statuses."""
        return Parameters(self["parameters"])

    @property
    def warnings(self) -> list[str]:
        """What speaks against the fit, in sentences; empty is good."""
        return list(self["warnings"])

    @property
    def converged(self) -> bool:
        """Whether the solver found an optimum.  A model that does not fit converges, too: see ``warnings``."""
        return bool(self["solver"]["termination"] == "converged")

    @property
    def typical_factor(self) -> float:
        """By which factor the model is typically off the values, exp of the root mean square of log ratios: 1.02 is 2 %."""
        return _math.exp(self["residuals"]["log_rms"])

    @property
    def cov(self) -> Array:
        """Covariance of the parameters that ``cov_names`` names, of their standard errors and correlations; NaN where one is unknown."""
        errors = []
        for name in self.cov_names:
            parameter, _, channel = name.partition(".")
            error = self.params[parameter].std_error
            errors.append(error[self["channels"].index(channel) if channel and error.size > 1 else 0])
        correlations = _np.array([[_np.nan if x is None else x for x in row] for row in self["identifiability"]["correlations"]], dtype=float)
        return correlations.reshape(len(errors), len(errors)) * _np.outer(errors, errors)

    @property
    def cov_names(self) -> list[str]:
        """Rows of ``cov``, as "alpha" and "kd.r"."""
        return list(self["identifiability"]["names"])

    def predict(self, theta_i: _npt.ArrayLike, phi_i: _npt.ArrayLike, theta_o: _npt.ArrayLike, phi_o: _npt.ArrayLike) -> Array:
        """f of the fitted model at directions, as ``gonio.eval``: 1/sr, channels last."""
        from . import eval as evaluate  # which is above this file

        return evaluate(self, theta_i, phi_i, theta_o, phi_o)

    def residuals(self, table: Any = None) -> Array:
        """log(f of the table / f of the model), ``[sample, channel]``; NaN where either is not above 0.

        Args:
            table: the fitted one unless given.
        """
        from . import read

        t = self._table if table is None else table
        t = read(t) if isinstance(t, (str, _os.PathLike)) else t
        f = self.predict(t.theta_i, t.phi_i, t.theta_o, t.phi_o)
        with _np.errstate(divide="ignore", invalid="ignore"):
            ratio = _np.log(t.values / f)
        return _np.where(_np.isfinite(ratio), ratio, _np.nan)

    def __repr__(self) -> str:
        head = f"<gonio.Fit {self['model']}: typically a factor {self.typical_factor:.4g} off, {self['solver']['termination']}>"
        return "\n".join([head, *map(repr, self.params), *(f"warning: {w}" for w in self.warnings)])

    def _repr_html_(self) -> str:
        rows = "".join(
            f"<tr><td>{_html.escape(p.name)}</td><td>{_html.escape('' if p.value.size == 1 else channel)}</td><td>{v:.5g}</td>"
            f"<td>{'' if _math.isnan(e) else f'± {e:.2g}'}</td><td>{_html.escape(status)}</td></tr>"
            for p in self.params for v, e, status, channel in zip(p.value, p.std_error, p.status, self["channels"]))
        warnings = "".join(f"<li>{_html.escape(w)}</li>" for w in self.warnings)
        return (f"<p><b>{_html.escape(self['model'])}</b>, typically a factor {self.typical_factor:.4g} off</p>"
                f"<table><tr><th>parameter</th><th>channel</th><th>value</th><th>standard error</th><th>status</th></tr>{rows}</table>"
                + (f"<ul>{warnings}</ul>" if warnings else ""))


def _parameter(name: str, p: dict[str, Any]) -> Parameter:
    def numbers(x: Any) -> Array:
        return _np.atleast_1d(_np.array(_without_none(x), dtype=float))

    ci = numbers(p["ci95"] if p["ci95"] is not None else [None, None]).reshape(-1, 2)
    words = {key: tuple(p[key]) if isinstance(p[key], list) else (p[key],) for key in ("status", "reason")}
    return Parameter(name, numbers(p["value"]), numbers(p["std_error"]), ci, words["status"], words["reason"])


def _without_none(x: Any) -> Any:
    """NaN for null, wherever it stands; for a null interval, two."""
    if isinstance(x, list):
        pairs = any(isinstance(y, list) for y in x)
        return [[_math.nan, _math.nan] if pairs and y is None else _without_none(y) for y in x]
    return _math.nan if x is None else x


def _with_error(value: float, error: float, status: str) -> str:
    if status != "free":
        return f"{value:.5g} ({status})"
    return f"{value:.5g} ± {error:.2g}"
