"""What a type checker says of the package, of the examples and of a user's lines: by mypy, which ./check fetches into build/mypy."""

import subprocess
import sys
import unittest
from pathlib import Path

from support import InAFolder, gonio

PROJECT = Path(__file__).parents[2]
MYPY = PROJECT / "build/mypy/bin/mypy"


@unittest.skipUnless(MYPY.exists(), "mypy is not in build/mypy: ./check fetches it")
class Types(InAFolder):
    def mypy(self, *words):
        # The package as it is built, with its stub; NumPy's types from the interpreter of these tests.
        package = Path("package/gonio")
        if not package.exists():
            package.mkdir(parents=True)
            for file in Path(gonio.__file__).parent.iterdir():
                if file.suffix in (".py", ".pyi", ".typed"):
                    (package / file.name).write_bytes(file.read_bytes())
        return subprocess.run([MYPY, "--strict", "--python-executable", sys.executable, "--cache-dir", "cache", *words],
                              env={"MYPYPATH": "package", "PATH": "/usr/bin:/bin"}, capture_output=True, text=True)

    def test_the_package_and_its_examples_keep_their_types(self):
        examples = sorted((PROJECT / "python/examples").glob("*.py"))
        self.assertEqual(len(examples), 3)
        for words in (["-p", "gonio"], ["--ignore-missing-imports", *map(str, examples)]):
            with self.subTest(words[0]):
                p = self.mypy(*words)
                self.assertEqual(p.returncode, 0, p.stdout + p.stderr)

    def test_a_fit_has_what_it_says_and_a_comparison_has_not(self):
        good = ("import gonio\n"
                "fit = gonio.fit('t.csv', metric='log', fix={'f0': 0.04})\n"
                "print(fit.params.alpha.value, fit.warnings, fit.predict(30, 0, [10], 180).shape)\n"
                "table = gonio.synth('lambert', 'random', kd=0.2)\n"
                "print(gonio.albedo('lambert', [0.5], kd=0.2)['average'], len(table))\n"
                "print(gonio.fit('t.csv', models=['lambert'])['recommended'])\n")
        Path("good.py").write_text(good)
        p = self.mypy("good.py")
        self.assertEqual(p.returncode, 0, p.stdout + p.stderr)
        for bad in ("gonio.fit('t.csv', models='all').params", "gonio.fit(3)", "gonio.eval('lambert', 0, 0, 0)", "gonio.fit('t.csv').parms"):
            Path("bad.py").write_text(f"import gonio\nprint({bad})\n")
            self.assertEqual(self.mypy("bad.py").returncode, 1, bad)
