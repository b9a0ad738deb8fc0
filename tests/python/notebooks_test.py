"""The notebooks run from top to bottom: by nbclient, which ./check fetches into build/notebooks."""

import json
import os
import subprocess
import unittest
from pathlib import Path

from support import InAFolder, gonio

PROJECT = Path(__file__).parents[2]
PYTHON = PROJECT / "build/notebooks/bin/python"

EXECUTE = """
import sys, json, nbformat, nbclient
notebook = nbformat.read(sys.argv[1], as_version=4)
nbformat.validate(notebook)
nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3", resources={"metadata": {"path": "."}}).execute()
print(json.dumps([[list(o.get("data", {"stream": 0})) for o in c.outputs] for c in notebook.cells if c.cell_type == "code"]))
"""


@unittest.skipUnless(PYTHON.exists(), "nbclient is not in build/notebooks: ./check fetches it")
class Notebooks(InAFolder):
    def run_notebook(self, path):
        packages = os.fspath(Path(gonio.__file__).parents[1])
        return subprocess.run([PYTHON, "-c", EXECUTE, path], capture_output=True, text=True,
                              env={**os.environ, "PYTHONPATH": packages, "IPYTHONDIR": os.getcwd(), "JUPYTER_RUNTIME_DIR": os.getcwd(), "MPLBACKEND": "agg"})

    def test_run_without_an_error_and_are_kept_without_outputs(self):
        notebooks = sorted((PROJECT / "python/notebooks").glob("*.ipynb"))
        self.assertEqual(len(notebooks), 2)
        for path in notebooks:
            with self.subTest(path.name):
                for cell in json.loads(path.read_text())["cells"]:
                    self.assertEqual(cell.get("outputs", []), [])
                p = self.run_notebook(path)
                self.assertEqual(p.returncode, 0, p.stderr[-2000:])
                if path.name == "fit_a_table.ipynb":  # a fit shows itself as a table
                    self.assertTrue(any("text/html" in kinds for outputs in json.loads(p.stdout) for kinds in outputs), p.stdout)

    def test_a_cell_that_fails_is_found(self):
        broken = json.loads((PROJECT / "python/notebooks/fit_a_table.ipynb").read_text())
        broken["cells"] = broken["cells"][:2]
        broken["cells"][1]["source"] = ["import gonio\n", "gonio.read('nothing.csv')"]
        Path("broken.ipynb").write_text(json.dumps(broken))
        p = self.run_notebook("broken.ipynb")
        self.assertEqual(p.returncode, 1)
        self.assertIn("nothing.csv", p.stderr)
