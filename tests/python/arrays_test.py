"""Arrays in and out: shapes, what is copied, what is refused."""

import tracemalloc

from support import PAINT, PARAMETERS, InAFolder, directions, gonio, json, np, program


def most_allocated(work):
    """Bytes that NumPy and Python had at most beyond those before."""
    tracemalloc.start()
    try:
        result = work()
        return tracemalloc.get_traced_memory()[1], result
    finally:
        tracemalloc.stop()


class Arrays(InAFolder):
    def test_values_are_the_programs(self):
        at = directions(500)
        np.savetxt("at.csv", np.stack(at, axis=-1), delimiter=",", header="theta_i,phi_i,theta_o,phi_o", comments="", fmt="%.17g")
        theirs = json.loads(program("eval", PAINT, "--set", "alpha=0.15", "f0=0.05", "kd=0.2,0.1,0.05", "--directions", "at.csv", "--json"))
        self.assertEqual(gonio.eval(PAINT, *at, **PARAMETERS).tolist(), [row["f"] for row in theirs["rows"]])

    def test_values_of_a_table_are_the_programs(self):
        gonio.synth(PAINT, "mbsdf", **PARAMETERS).write("t.mbsdf")
        open("at.csv", "w").write("theta_i,phi_i,theta_o,phi_o\n30,0,40,180\n20,0,25,170\n")
        theirs = [row["f"] for row in json.loads(program("eval", "t.mbsdf", "--directions", "at.csv", "--json"))["rows"]]
        self.assertEqual(gonio.eval(gonio.read("t.mbsdf"), [30, 20], 0, [40, 25], [180, 170]).tolist(), theirs)

    def test_directions_broadcast_and_the_channels_are_last(self):
        f = gonio.eval(PAINT, 30, 0, np.linspace(0, 80, 5)[:, None], np.linspace(0, 180, 7), **PARAMETERS)
        self.assertEqual(f.shape, (5, 7, 3))
        self.assertTrue(f[..., 0].flags.c_contiguous)
        one = gonio.eval(PAINT, 30, 0, 20, 30, **PARAMETERS)
        self.assertEqual(one.shape, (3,))
        self.assertEqual(one.tolist(), f[1, 1].tolist(), "the same at 20° and 30°")
        self.assertEqual(gonio.eval("lambert", [], [], [], [], kd=0.5).shape, (0, 3))

    def test_contiguous_doubles_are_read_in_place_and_others_are_copied(self):
        n = 200_000
        at = directions(n)
        gonio.eval(PAINT, *directions(10), **PARAMETERS)
        in_place, _ = most_allocated(lambda: gonio.eval(PAINT, *at, **PARAMETERS))
        self.assertLess(in_place, n, "neither the directions nor the values are an array of NumPy's own")
        one_is_float = [at[0].astype(np.float32), *at[1:]]
        copied, f = most_allocated(lambda: gonio.eval(PAINT, *one_is_float, **PARAMETERS))
        self.assertGreaterEqual(copied, 8 * n, "the ruler: a copy of one column is seen")
        every_other = [np.repeat(a, 2)[::2] for a in at]
        self.assertFalse(every_other[0].flags.c_contiguous)
        np.testing.assert_array_equal(gonio.eval(PAINT, *every_other, **PARAMETERS), gonio.eval(PAINT, *at, **PARAMETERS))

    def test_what_is_masked_is_no_number(self):
        for values in ([0.5, 1000, 0.25], [5, 1000, 25]):
            table = gonio.Table(30, 0, [10, 20, 30], 180, np.ma.masked_greater(values, 999))
            np.testing.assert_array_equal(table["f"], [values[0], np.nan, values[2]])
        with self.assertRaisesRegex(gonio.BadInput, r"theta_o\[1\]: found nan"):
            gonio.eval("lambert", 30, 0, np.ma.masked_greater([10, 80], 70), 180)

    def test_the_module_itself_takes_no_copy(self):
        from gonio import _gonio
        at = directions(3)
        model = _gonio.model("lambert", [])
        self.assertEqual(_gonio.evaluate(model, *at, 0).shape, (3, 3))
        for wrong in (at[0].astype(np.float32), np.repeat(at[0], 2)[::2], at[0].tolist(), at[0][None]):
            with self.assertRaises(TypeError):
                _gonio.evaluate(model, wrong, *at[1:], 0)

    def test_columns_of_a_table_are_in_place_and_outlive_it(self):
        t = gonio.synth(PAINT, "hemisphere", **PARAMETERS)
        self.assertTrue(np.shares_memory(t["r"], t["r"]))
        self.assertTrue(np.shares_memory(t.theta_i, t.theta_i))
        self.assertFalse(np.shares_memory(t["r"], t["g"]))
        self.assertFalse(np.shares_memory(t.values, t["r"]))
        with self.assertRaises(ValueError):
            t["r"][0] = 1
        r, copy = t["r"], t["r"].copy()
        del t
        again = [gonio.synth(PAINT, "hemisphere", **PARAMETERS) for _ in range(5)]
        np.testing.assert_array_equal(r, copy)
        del again

    def test_a_table_copies_its_arrays_once_and_keeps_them(self):
        at = directions(100)
        f = gonio.eval(PAINT, *at, **PARAMETERS)
        t = gonio.Table(*at, f, weights=np.full(100, 2.0), name="mine")
        at[0][:] = 0
        self.assertNotEqual(t.theta_i[0], 0)
        np.testing.assert_array_equal(t.values, f)
        self.assertEqual((t.channels, t.path, len(t), t.bins), (["r", "g", "b"], "mine", 100, None))
        self.assertEqual(t.weights.tolist(), [2.0] * 100)
        self.assertEqual(len(t.sha256), 64)
        self.assertNotEqual(t.sha256, gonio.Table(*directions(100), f).sha256, "weights count")
        grey = gonio.Table(*directions(100), f[..., 0])
        self.assertEqual(grey.channels, ["f"])
        self.assertEqual(grey["f"].tolist(), f[..., 0].tolist())
        with self.assertRaises(KeyError):
            grey["r"]

    def test_a_grid_computes_its_directions(self):
        t = gonio.synth(PAINT, "mbsdf", **PARAMETERS)
        self.assertEqual(len(t.theta_i), len(t))
        self.assertEqual(t.bins, "centre")
        f = gonio.eval(PAINT, t.theta_i, t.phi_i, t.theta_o, t.phi_o, **PARAMETERS)
        above = (t.theta_i < 90) & (t.theta_o < 90) & (t["r"] > 0)
        np.testing.assert_allclose(t.values[above], f[above], rtol=1e-5)

    def test_what_goes_not_together_is_refused_in_one_line(self):
        at = directions(4)
        f = np.ones((4, 3))
        for words, call in (
            ("do not go together", lambda: gonio.eval("lambert", [1, 2], [1, 2, 3], 0, 0)),
            ("theta_i: not an array of numbers", lambda: gonio.eval("lambert", ["a"], 0, 0, 0)),
            ("theta_o: not an array of numbers", lambda: gonio.eval("lambert", 0, 0, 1j, 0)),
            ("values: of shape (3, 3)", lambda: gonio.Table(*at, f[:3])),
            ("channels: a name for each", lambda: gonio.Table(*at, f, channels=["r"])),
            ("weights: 3 values of 4", lambda: gonio.Table(*at, f, weights=np.ones(3))),
            ("no parameter", lambda: gonio.eval("lambert", 0, 0, 0, 0, alpha=1)),
            ("kd: a number", lambda: gonio.eval("lambert", 0, 0, 0, 0, kd="0.5")),
            ("jobs", lambda: gonio.eval("lambert", 0, 0, 0, 0, jobs=-1)),
            ("robust", lambda: gonio.fit(gonio.Table(*at, f), robust="maybe")),
            ("layout", lambda: gonio.synth("lambert", "square")),
            ("noise", lambda: gonio.synth("lambert", "random", noise=-1)),
            ("--mu or --average", lambda: gonio.albedo("lambert")),
        ):
            with self.subTest(words), self.assertRaises(gonio.WrongUsage) as e:
                call()
            self.assertNotIn("\n", str(e.exception))
            if words != "no parameter":
                self.assertIn(words, str(e.exception))

    def test_what_is_no_direction_is_refused_with_its_place(self):
        at = directions(4)
        for k, name, bad in ((0, "theta_i", np.nan), (1, "phi_i", np.inf), (2, "theta_o", -1), (3, "phi_o", 1e9)):
            wrong = [a.copy() for a in at]
            wrong[k][2] = bad
            for call in (lambda: gonio.eval("lambert", *wrong), lambda: gonio.Table(*wrong, np.ones(4))):
                with self.assertRaisesRegex(gonio.BadInput, rf"{name}\[2\]: found .* expected a number in"):
                    call()

    def test_values_that_are_no_numbers_are_kept_and_not_fitted(self):
        at = directions(400)
        f = gonio.eval(PAINT, *at, **PARAMETERS)
        f[:5] = np.nan
        t = gonio.Table(*at, f)
        self.assertTrue(np.isnan(t["r"][:5]).all())
        fit = gonio.fit(t, certificate="none")
        self.assertEqual(fit["input"]["masked"]["not_finite"], 15)
        with self.assertRaises(gonio.BadInput):
            gonio.fit(gonio.Table(*at, np.full(400, np.nan)))
