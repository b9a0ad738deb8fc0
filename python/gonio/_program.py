"""The program that lies in the package: ``gonio`` on the command line."""

import os
import sys
from pathlib import Path

PROGRAM = Path(__file__).parent / "bin" / "gonio"


def main() -> None:
    """Becomes the program, with this process's words, streams and environment."""
    os.execv(PROGRAM, ["gonio", *sys.argv[1:]])
