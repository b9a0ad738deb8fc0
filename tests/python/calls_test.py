"""Calls: threads, interrupts, hostile files, what is left behind."""

import os
import signal
import subprocess
import sys
import threading
import time

from support import PAINT, PARAMETERS, InAFolder, directions, gonio, np, without_times


class Calls(InAFolder):
    def test_other_threads_run_meanwhile(self):
        before = sys.getswitchinterval()
        self.addCleanup(sys.setswitchinterval, before)
        sys.setswitchinterval(1000)  # nobody takes the interpreter from one who does not let go
        count, seen, over = [0], {}, threading.Event()
        at = directions(300_000)
        calls = {
            "eval": lambda: gonio.eval(PAINT, *at, **PARAMETERS),
            "fit": lambda: gonio.fit(table),
            "albedo": lambda: gonio.albedo("ggx/smith_ggx.correlated/schlick", [0.3], scattering="walk", walks=300_000, error=1e-9,
                                           alpha=0.8, f0=1),
            "audit": lambda: gonio.audit(["ndf.ggx", "ndf.gtr"]),
            "read": lambda: [gonio.read("t.csv") for _ in range(5)],
            "synth": lambda: gonio.synth(PAINT, "merl", **PARAMETERS),
        }
        table = gonio.synth(PAINT, "random", samples=100_000, noise=0.05, **PARAMETERS)
        table.write("t.csv")

        def work():
            for name, call in calls.items():
                begin = count[0]
                call()
                seen[name] = count[0] - begin
            over.set()

        worker = threading.Thread(target=work)
        worker.start()
        while not over.is_set():
            count[0] += 1
            time.sleep(0)  # lets go
        worker.join()
        # A call that holds the interpreter lets nobody in between its two looks: it counts 0.
        for name, times in seen.items():
            with self.subTest(name):
                self.assertGreater(times, 1)

    def test_an_interrupt_ends_a_call_at_its_next_step(self):
        # An interrupt that the caller ignores, as of a job in the background, would be ignored here, too.
        code = ("import gonio, signal, sys\nsignal.signal(signal.SIGINT, signal.default_int_handler)\nprint('begun', flush=True)\n"
                "try:\n  for _ in range(100): gonio.audit()\nexcept KeyboardInterrupt:\n  print('interrupted', flush=True)\n"
                "print(gonio.term('ndf.ggx', {'noh': 1})[0] > 0)")
        for seconds in (0.2, 0.5, 0.9):
            with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as p:
                self.assertEqual(p.stdout.readline(), "begun\n")
                time.sleep(seconds)
                p.send_signal(signal.SIGINT)
                out, err = p.communicate(timeout=300)
            self.assertEqual((out, err, p.returncode), ("interrupted\nTrue\n", "", 0))

    def test_results_are_the_same_for_any_number_of_threads(self):
        table = gonio.synth(PAINT, "random", samples=5000, noise=0.05, jobs=1, **PARAMETERS)
        np.testing.assert_array_equal(table.values, gonio.synth(PAINT, "random", samples=5000, noise=0.05, jobs=2, **PARAMETERS).values)
        self.assertEqual(*(without_times(gonio.fit(table, jobs=j).text) for j in (1, 2)))
        self.assertEqual(*(gonio.audit("ndf.gtr", jobs=j).text for j in (1, 2)))
        at = directions(50_000)
        np.testing.assert_array_equal(*(gonio.eval(PAINT, *at, jobs=j, **PARAMETERS) for j in (1, 2)))

    def test_a_hostile_file_is_an_error_and_nothing_else(self):
        gonio.synth(PAINT, "mbsdf", **PARAMETERS).write("whole.mbsdf")
        gonio.synth(PAINT, "hemisphere", **PARAMETERS).write("whole.csv")
        draw = np.random.default_rng(3)
        refused = 0
        for name in ("whole.mbsdf", "whole.csv"):
            whole = open(name, "rb").read()
            for cut in (0, 1, 7, 64, len(whole) // 2, len(whole) - 1):
                torn = bytearray(whole[:cut])
                for k in draw.integers(0, max(cut, 1), 20):
                    if cut:
                        torn[k] = draw.integers(256)
                open("torn", "wb").write(torn)
                try:
                    gonio.fit("torn", certificate="none")
                except gonio.BadInput as e:
                    refused += 1
                    self.assertTrue(str(e).startswith("torn: "), e)
                    self.assertNotIn("\n", str(e))
        self.assertGreaterEqual(refused, 9)
        for path in ("not there", ".", "/dev/zero", "a" * 5000, "na\0me"):
            with self.assertRaises((gonio.BadInput, ValueError)):
                gonio.read(path)

    def test_files_are_left_whole_or_not_at_all(self):
        table = gonio.synth(PAINT, "hemisphere", **PARAMETERS)
        with self.assertRaises(gonio.BadInput):
            table.write("no/such/folder.csv")
        table.write("t.csv")
        self.assertEqual(sorted(os.listdir()), ["t.csv", "t.csv.gonio.json"])

    def test_errors_are_of_the_classes_that_are_said(self):
        for kind in (gonio.WrongUsage, gonio.BadInput):
            self.assertTrue(issubclass(kind, gonio.Error) and issubclass(kind, ValueError))
            self.assertTrue(kind.__doc__)
        with self.assertRaisesRegex(gonio.WrongUsage, "ggx"):
            gonio.term("ndf.gxg", {"noh": 1})
        with self.assertRaisesRegex(gonio.BadInput, "^nowhere.json: opening: found no such file"):
            gonio.eval("nowhere.json", 0, 0, 0, 0)
        with self.assertRaisesRegex(gonio.BadInput, "^document: "):
            gonio.eval({"model": 3}, 0, 0, 0, 0)

    def test_words_are_a_list_or_a_text_with_commas(self):
        table = gonio.synth(PAINT, "in_plane", noise=0.02, **PARAMETERS)
        listed = gonio.fit(table, models=["lambert", PAINT], grey=["f0"])
        self.assertEqual(*(without_times(d.text) for d in (listed, gonio.fit(table, models=f"lambert, {PAINT}", grey="f0"))))
        self.assertEqual([row["model"] for row in gonio.fit(table, models="lambert")["models"]], ["lambert"])
        with self.assertRaisesRegex(gonio.WrongUsage, "^models: found none, expected models to compare"):
            gonio.fit(table, models=[])

    def test_what_is_not_by_name_is_refused_in_one_line_with_an_example(self):
        table = gonio.synth(PAINT, "in_plane", **PARAMETERS)
        for call, said in ((lambda: gonio.fit(table, fix="f0=0.05"), 'fix: found str, expected a dict, as {"f0": 0.05}'),
                           (lambda: gonio.fit(table, bounds=[("alpha", 0.1, 0.3)]),
                            'bounds: found list, expected a dict, as {"alpha": (0.05, 0.5)}'),
                           (lambda: gonio.term("ndf.ggx", [1, 0.9], alpha=0.3), 'at: found list, expected a dict, as {"noh": [1, 0.9]}'),
                           (lambda: gonio.term("ndf.ggx", noh=[1, 0.9], alpha=0.3),
                            'noh: found several numbers, expected one; what a term is evaluated at goes into at={"noh": …}'),
                           (lambda: gonio.synth("lambert", "random", samples=0), "samples: found 0, expected a number in [1, 10000000]"),
                           (lambda: gonio.synth("lambert", "random", noise=-1), "noise: found -1, expected a number in [0, 5]")):
            with self.assertRaises(gonio.WrongUsage) as refused:
                call()
            self.assertEqual(str(refused.exception), said)
        with self.assertRaisesRegex(KeyError, "q: the channels are r, g, b"):
            table["q"]

    def test_nothing_leaks(self):
        code = ("import gonio, gc\n"
                "t = gonio.synth('lambert', 'random', samples=50, kd=0.4)\n"
                "kept = t['r'], t.theta_i, gonio.eval('lambert', 0, 0, 0, 0)\n"
                "fit = gonio.fit(t, 'lambert')\n"
                "try: gonio.read('nowhere')\nexcept gonio.BadInput as e: held = e\n")
        p = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
        self.assertEqual((p.stdout, p.stderr, p.returncode), ("", "", 0))

    def test_memory_does_not_grow_with_calls(self):
        def resident():
            return int(open("/proc/self/statm").read().split()[1]) * os.sysconf("SC_PAGE_SIZE")

        at = directions(50_000)
        for _ in range(5):
            gonio.eval(PAINT, *at, **PARAMETERS)
        before = resident()
        for _ in range(100):
            gonio.eval(PAINT, *at, **PARAMETERS)
        self.assertLess(resident() - before, 30e6, "100 results are 120 MB")
