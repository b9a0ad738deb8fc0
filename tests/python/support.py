"""The module beside the program: what one gives the other must give to the byte."""

import json
import os
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

import gonio
import numpy as np

PROGRAM = os.environ["GONIO_PROGRAM"]
PAINT = "lambert+ggx/smith_ggx.correlated/schlick"
PARAMETERS = {"alpha": 0.15, "f0": 0.05, "kd": (0.2, 0.1, 0.05)}
SET = ["--set", "alpha=0.15", "f0=0.05", "kd=0.2,0.1,0.05"]


def program(*words: object) -> str:
    """What the program prints; it must end well."""
    return subprocess.run([PROGRAM, *map(str, words)], check=True, capture_output=True, text=True).stdout


def without_times(text: str) -> str:
    """A document without the numbers of keys that are times."""
    return re.sub(r'("[a-z_]*_ms"|"ns"|"ns_spread"): [-+.0-9e]+', r"\1: 0", text)


class InAFolder(unittest.TestCase):
    """Tests in a folder of their own, which is left with them."""

    maxDiff = 2000

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)
        self.folder = Path(folder.name)


def directions(n: int, seed: int = 1) -> list[np.ndarray]:
    """Directions above the horizon [degrees]."""
    draw = np.random.default_rng(seed)
    return [draw.uniform(0, 85, n), draw.uniform(-180, 180, n), draw.uniform(0, 85, n), draw.uniform(-180, 180, n)]


__all__ = ["InAFolder", "PAINT", "PARAMETERS", "PROGRAM", "SET", "directions", "gonio", "json", "np", "program", "without_times"]
