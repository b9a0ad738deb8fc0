"""The package: types, words, the program."""

import ast
import inspect
import re
import subprocess
import sys
from pathlib import Path

from support import PROGRAM, InAFolder, gonio, program


class Package(InAFolder):
    def test_the_module_and_the_program_are_of_one_version(self):
        self.assertIn(gonio.__version__, program("--version"))

    def test_all_that_is_public_is_typed_and_says_what_it_does(self):
        self.assertTrue((Path(gonio.__file__).parent / "py.typed").exists())
        for name in gonio.__all__:
            if name.startswith("__"):
                continue
            thing = getattr(gonio, name)
            self.assertTrue(thing.__doc__, name)
            if not inspect.isfunction(thing):
                continue
            signature = inspect.signature(thing)
            self.assertIsNot(signature.return_annotation, inspect.Signature.empty, name)
            self.assertIn("Raises:", thing.__doc__, name)
            for p in signature.parameters.values():
                self.assertIsNot(p.annotation, inspect.Parameter.empty, f"{name}: {p.name}")
                if p.name not in ("jobs", "table", "path", "model", "parameters", "id", "bins", "layout"):
                    self.assertRegex(thing.__doc__, rf"\b{p.name}\b", name)

    def test_the_stub_names_what_the_module_has(self):
        from gonio import _gonio
        stub = ast.parse((Path(gonio.__file__).parent / "_gonio.pyi").read_text())
        named = {n.name for n in stub.body if isinstance(n, (ast.FunctionDef, ast.ClassDef))}
        there = {n for n in dir(_gonio) if not n.startswith("__")}
        self.assertEqual(there - named, set())

    def test_the_examples_run(self):
        examples = Path(__file__).parents[2] / "python/examples"
        self.assertEqual(len(list(examples.glob("*.py"))), 3)
        for example in sorted(examples.glob("*.py")):
            with self.subTest(example.name):
                p = subprocess.run([sys.executable, str(example)], capture_output=True, text=True)
                if re.search("No module named 'matplotlib'", p.stderr):
                    print("Without matplotlib: plot_with_matplotlib.py is not run.")
                    continue
                self.assertEqual((p.stderr, p.returncode), ("", 0))

    def test_no_help_of_the_program_speaks_of_an_argument_that_the_module_lacks(self):
        """Options of `gonio fit`, `albedo` and `synth`, apart from those of files, of terminals and of maps."""
        of_files = {"help", "html", "output", "json", "quiet", "pages", "set", "part", "model", "models", "as", "follow"}
        of_files |= {"argument", "includes", "bounds"}  # a spec says them in braces behind a shader's function
        for function in (gonio.fit, gonio.albedo, gonio.synth):
            text = subprocess.run([PROGRAM, function.__name__, "--help"], capture_output=True, text=True).stdout
            options = {name for name, told in re.findall(r"^ +(?:-\w,)?--([a-z]+)\b(.*(?:\n {20}.*)?)", text, re.M) if "Map: " not in told}
            self.assertIn("jobs", options, "the ruler")
            self.assertEqual(options - of_files - set(inspect.signature(function).parameters), set(), function.__name__)
