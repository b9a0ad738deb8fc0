"""Models of one's own: a shader's text and a Python function stand where a spec stands."""

import unittest

from support import PAINT, PARAMETERS, InAFolder, directions, gonio, np, program

SHADER = """// alpha 0.001 1 0.2
// f0 0 1 0.04
// kd 0 1 0.5
const float PI = 3.14159265358979323846;
float D_GGX(float NoH, float alpha) {
  float a2 = alpha * alpha, d = NoH * NoH * (a2 - 1.0) + 1.0;
  return a2 / (PI * d * d);
}
vec3 brdf(float NoL, float NoV, float NoH, float VoH, float alpha, vec3 f0, vec3 kd) {
  float a2 = alpha * alpha;
  float V = 0.5 / (NoV * sqrt(NoL * NoL * (1.0 - a2) + a2) + NoL * sqrt(NoV * NoV * (1.0 - a2) + a2));
  return kd / PI + D_GGX(NoH, alpha) * V * (f0 + (1.0 - f0) * pow(1.0 - VoH, 5.0));
}
"""
TRUTH = {"alpha": 0.3, "f0": (0.6, 0.5, 0.4), "kd": (0.1, 0.2, 0.3)}


def glossy(NoL, NoV, NoH, VoH, alpha, f0, kd):
    a2 = alpha**2
    d = a2 / (np.pi * (NoH**2 * (a2 - 1) + 1) ** 2)
    v = 0.5 / (NoV * np.sqrt(NoL**2 * (1 - a2) + a2) + NoL * np.sqrt(NoV**2 * (1 - a2) + a2))
    return kd / np.pi + np.where(NoL > 0, d * v * (f0 + (1 - f0) * np.clip(1 - VoH, 0, 1) ** 5), 0)


def traced():
    return gonio.model(glossy, bounds={"alpha": (0.001, 1, 0.2), "f0": (0, 1), "kd": (0, 1)}, colours="f0,kd")


class OwnModel(InAFolder):
    def test_the_program_reads_a_fit_of_one_with_its_shader(self):
        table = gonio.synth(PAINT, "random", **PARAMETERS)
        fit = gonio.fit(table, traced())
        self.assertAlmostEqual(gonio.compare(table, fit)["residuals"]["log_rms"], fit["residuals"]["log_rms"], places=6)

    def test_both_are_the_model_that_they_say(self):
        at = directions(500)
        wanted = gonio.eval(PAINT, *at, **TRUTH)
        for mine in (gonio.model(SHADER, "brdf"), traced()):
            f = gonio.eval(mine, *at, **TRUTH)
            np.testing.assert_allclose(f, wanted, rtol=1e-9)
            self.assertAlmostEqual(gonio.albedo(mine, [0.5], **TRUTH)["albedo"][0][0], gonio.albedo(PAINT, [0.5], **TRUTH)["albedo"][0][0],
                                   delta=2e-4)

    def test_both_are_fitted_and_read_back(self):
        table = gonio.synth(PAINT, "random", samples=2000, **TRUTH)
        for mine in (gonio.model(SHADER, "brdf"), traced()):
            fitted = gonio.fit(table, mine)
            self.assertAlmostEqual(fitted["parameters"]["alpha"]["value"], 0.3, 5)
            self.assertEqual(len(fitted["shaders"][0]["sha256"]), 64)
            np.testing.assert_allclose(gonio.eval(fitted, *directions(9)), gonio.eval(PAINT, *directions(9), **TRUTH), rtol=1e-4)

    def test_a_term_stands_in_a_spec_beside_ours_and_in_an_audit(self):
        d = gonio.model(SHADER, "D_GGX")
        at = directions(50)
        np.testing.assert_allclose(gonio.eval(f"{d}/smith_ggx.correlated/schlick", *at, alpha=0.3, f0=1),
                                   gonio.eval("ggx/smith_ggx.correlated/schlick", *at, alpha=0.3, f0=1), rtol=1e-9)
        beside = gonio.compare(d, "ndf.ggx", domain=["alpha=0.1,1"])
        self.assertLess(beside["largest"], 1e-12)
        self.assertEqual(gonio.audit(d)["rows"][0]["nearest"]["id"], "ndf.ggx")
        self.assertEqual([f["function"] for f in gonio.models(d)["functions"]], ["D_GGX"])
        np.testing.assert_allclose(gonio.term(d, {"noh": [1.0, 0.9]}, alpha=0.3), gonio.term("ndf.ggx", {"noh": [1.0, 0.9]}, alpha=0.3))

    def test_bounds_and_readings_are_said(self):
        bare = gonio.model("float f(float x, float NoL, float NoV, float w) { return w * x / (NoL + NoV); }", arguments={"x": "noh"},
                           bounds={"w": (0.1, 2)}, includes="nothing")
        (p,) = gonio.models(bare)["functions"][0]["parameters"]
        self.assertEqual((p["name"], p["low"], p["high"]), ("w", 0.1, 2))

    def test_the_program_reads_the_same_text(self):
        mine = traced()
        file = self.folder / mine.split(":")[0]
        file.write_text(mine.text)
        self.assertEqual(program("models", mine.split("{")[0], "--json"), gonio.models(mine).text)

    def test_what_is_no_model_is_one_line(self):
        def branches(NoH, alpha):
            return alpha if NoH > 0.5 else NoH

        for make, said in {
            "text": (lambda: gonio.model("float f(float NoL) { return NoL"), "a text that compiles"),
            "branch": (lambda: gonio.model(branches), "numpy.where"),
            "sum": (lambda: gonio.model(lambda NoH: np.sum(NoH)), "numpy.sum"),
            "bounds": (lambda: gonio.model(glossy, bounds={"beta": (0, 1)}), "beta"),
            "language": (lambda: gonio.model(SHADER, language="wgsl"), "wgsl"),
            "constant": (lambda: gonio.model(lambda NoH: NoH * np.inf), "finite"),
        }.values():
            with self.assertRaises(gonio.Error) as caught:
                make()
            self.assertIn(said, str(caught.exception))
            self.assertNotIn("\n", str(caught.exception))


if __name__ == "__main__":
    unittest.main()
