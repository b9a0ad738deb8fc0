"""A fit as people ask it, and the commands that end in files."""

import math
import os
import pickle
from pathlib import Path

from support import PAINT, PARAMETERS, InAFolder, gonio, np, program


class Fits(InAFolder):
    def setUp(self):
        super().setUp()
        self.table = gonio.synth(PAINT, "hemisphere", noise=0.02, **PARAMETERS)
        self.fit = gonio.fit(self.table)

    def test_has_parameters_by_attribute_as_arrays_of_channels(self):
        params, document = self.fit.params, self.fit["parameters"]
        self.assertEqual({p.name for p in params}, set(document))
        self.assertEqual(float(params.alpha), document["alpha"]["value"])
        self.assertEqual(params.kd.value.tolist(), document["kd"]["value"])
        self.assertEqual(params["kd"].std_error.tolist(), document["kd"]["std_error"])
        self.assertEqual(params.kd.ci95.shape, (3, 2))
        self.assertEqual(params.alpha.ci95.shape, (1, 2))
        self.assertEqual(params.alpha.status, ("free",))
        with self.assertRaisesRegex(AttributeError, "there are .*alpha"):
            params.gamma
        with self.assertRaises(TypeError):
            float(params.kd)

    def test_has_nan_where_the_document_has_null(self):
        fit = gonio.fit(self.table, fix={"f0": 0.05})
        self.assertTrue(math.isnan(fit.params.f0.std_error[0]))
        self.assertTrue(np.isnan(fit.params.f0.ci95).all())
        self.assertEqual(set(fit.params.f0.status), {"fixed"})

    def test_predicts_and_leaves_residuals(self):
        f = self.fit.predict(30, 0, [10, 20], 180)
        self.assertTrue((f == gonio.eval(self.fit, 30, 0, [10, 20], 180)).all())
        self.assertIs(gonio.evaluate, gonio.eval)
        left = self.fit.residuals()
        self.assertEqual(left.shape, self.table.values.shape)
        self.assertAlmostEqual(math.sqrt(np.nanmean(left ** 2)), self.fit["residuals"]["log_rms"], places=9)
        self.assertAlmostEqual(self.fit.typical_factor, math.exp(self.fit["residuals"]["log_rms"]))

    def test_has_the_covariance_of_its_errors(self):
        cov, names = self.fit.cov, self.fit.cov_names
        self.assertEqual(cov.shape, (len(names), len(names)))
        self.assertTrue(np.allclose(cov, cov.T))
        alpha, green = names.index("alpha"), names.index("kd.g")
        self.assertAlmostEqual(cov[alpha, alpha], self.fit.params.alpha.std_error[0] ** 2)
        self.assertAlmostEqual(cov[green, green], self.fit.params.kd.std_error[1] ** 2)

    def test_shows_itself_and_escapes_what_it_shows(self):
        self.assertIn("alpha = 0.1", repr(self.fit))
        page = self.fit._repr_html_()
        self.assertIn("<td>alpha</td>", page)
        evil = gonio.Fit(self.fit.text.replace('"warnings": []', '"warnings": ["<script>"]'))
        self.assertEqual(evil.warnings, ["<script>"])
        self.assertNotIn("<script>", evil._repr_html_())

    def test_of_a_file_reads_it_for_its_residuals(self):
        self.table.write("t.csv")
        fit = gonio.fit("t.csv")
        self.assertTrue(fit.converged)
        self.assertEqual(fit.residuals().shape[1], 3)
        self.assertEqual(fit.document["schema"], "gonio.fit/1")
        self.assertEqual(repr(pickle.loads(pickle.dumps(fit)).params), repr(fit.params))


class Commands(InAFolder):
    def test_give_the_programs_documents(self):
        os.environ["GONIO_PROGRAM"] = program.__globals__["PROGRAM"]
        table = gonio.synth(PAINT, "merl", **PARAMETERS)
        fit = gonio.fit(table)
        self.assertLess(gonio.compare(table, fit)["residuals"]["log_rms"], 0.01)
        self.assertEqual(gonio.export(fit, "gltf", "m.gltf")["target"], "gltf")
        self.assertTrue(Path("m.gltf").exists())
        page = gonio.explore(table, fit, "disney", output="p.html")
        self.assertEqual([sorted(item)[0] for item in page["items"]], ["covered", "model", "model"])
        self.assertTrue(Path("p.html").exists())
        table.write("t.binary")
        gonio.convert("t.binary", "t.mbsdf", "mbsdf")
        self.assertEqual(len(gonio.read("t.mbsdf").channels), 3)
        Path("c.csv").write_text("a,b,c,d\n30,0,30,0.5\n")
        gonio.columns("c.csv", {"theta_i": "a", "phi_i": "b", "theta_o": "c", "f": "d"})
        self.assertEqual(len(gonio.read("c.csv")), 1)

    def test_make_a_stack_of_photographs_and_their_lamps(self):
        os.environ["GONIO_PROGRAM"] = program.__globals__["PROGRAM"]
        for name in "abc":
            np.save(f"{name}.npy", np.full((4, 4), 0.2, np.float32))
        Path("dome.lp").write_text("3\na.npy 0 0 1\nb.npy 1 0 1\nc.npy 0 1 1\n")
        stack = gonio.stack("dome.lp", "stack.json", white=0.8)
        self.assertEqual([i["path"] for i in stack["images"]], ["a.npy", "b.npy", "c.npy"])
        self.assertAlmostEqual(stack["images"][0]["scale"], 1 / (np.pi * 0.8))
        self.assertTrue(Path("stack.json").exists())

    def test_are_refused_as_the_programs_are(self):
        os.environ["GONIO_PROGRAM"] = program.__globals__["PROGRAM"]
        with self.assertRaisesRegex(gonio.WrongUsage, "nearest"):
            gonio.compare("t.csv", "lambert", modle="x")
        with self.assertRaisesRegex(gonio.BadInput, "nothing.json"):
            gonio.plan("nothing.json")
        with self.assertRaisesRegex(gonio.BadInput, "nothing.json"):
            gonio.fit_map("nothing.json", "m.exr")
        os.environ["GONIO_PROGRAM"] = "/nowhere/gonio"
        self.addCleanup(os.environ.__setitem__, "GONIO_PROGRAM", program.__globals__["PROGRAM"])
        with self.assertRaisesRegex(gonio.Error, "no program"):
            gonio.report("schlick", "r")
