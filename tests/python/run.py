"""Runs the tests of the module, all or those of the files named: run.py [NAME_test.py …]."""

import sys
import unittest
from pathlib import Path

here = Path(__file__).parent
sys.path.insert(0, str(here))
try:
    import numpy  # noqa: F401
except ImportError:
    print("Without NumPy: the module for Python is not tested (./check fetches it).")
    sys.exit(77)

names = [Path(name).stem for name in sys.argv[1:]] or sorted(f.stem for f in here.glob("*_test.py"))
outcome = unittest.TextTestRunner(verbosity=2).run(unittest.defaultTestLoader.loadTestsFromNames(names))
sys.exit(not outcome.wasSuccessful() or outcome.testsRun == 0)
