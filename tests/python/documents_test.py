"""Documents of the module are those of the program."""

from pathlib import Path

from support import PAINT, PARAMETERS, SET, InAFolder, gonio, json, np, program, without_times


class Documents(InAFolder):
    def setUp(self):
        super().setUp()
        program("synth", PAINT, *SET, "--layout", "hemisphere", "--noise", "0.02", "-o", "paint.csv")

    def expect_same(self, ours, theirs):
        self.assertEqual(without_times(ours.text), without_times(theirs))
        self.assertEqual(json.loads(ours.text), ours)

    def test_a_fit_is_the_programs_to_the_byte(self):
        self.expect_same(gonio.fit("paint.csv"), program("fit", "paint.csv", "--json"))

    def test_options_of_a_fit_are_the_programs(self):
        ours = gonio.fit("paint.csv", PAINT, fix={"f0": 0.05}, bounds={"roughness": (0.2, 0.6)}, grey=["kd"], metric="l2_cosine",
                         robust="huber", intervals="independent", copies="keep", certificate="none", jobs=1)
        self.expect_same(ours, program("fit", "paint.csv", "--model", PAINT, "--fix", "f0=0.05", "--bounds", "roughness=0.2,0.6", "--grey",
                                       "kd", "--metric", "l2_cosine", "--robust", "huber", "--intervals", "independent", "--copies", "keep",
                                       "--certificate", "none", "--json"))

    def test_a_table_that_was_read_is_fitted_as_its_file(self):
        ours, theirs = gonio.fit(gonio.read("paint.csv")), json.loads(program("fit", "paint.csv", "--json"))
        for d in (ours, theirs):
            d["solver"].pop("time_ms")
        self.assertEqual(ours, theirs)

    def test_arrays_are_fitted_as_the_file_that_holds_them(self):
        Path("paint.csv.gonio.json").unlink()  # that gonio made the table is known of the file alone
        t = gonio.read("paint.csv")
        again = gonio.Table(t.theta_i, t.phi_i, t.theta_o, t.phi_o, t.values, channels=t.channels)
        self.assertEqual(gonio.fit(again)["parameters"], gonio.fit("paint.csv")["parameters"])

    def test_models_compared_are_the_programs(self):
        names = ["lambert", PAINT]
        self.expect_same(gonio.fit("paint.csv", models=names), program("fit", "paint.csv", "--models", ",".join(names), "--json"))
        of_table = gonio.fit(gonio.read("paint.csv"), models=names)
        self.assertEqual(of_table["recommended"], PAINT)

    def test_models_of_a_table_of_free_scale_are_the_programs(self):
        names = ["lambert", PAINT]
        self.expect_same(gonio.fit("paint.csv", models=names, scale="free"),
                         program("fit", "paint.csv", "--scale", "free", "--models", ",".join(names), "--json"))

    def test_albedos_are_the_programs(self):
        mu = [0.01, 0.5, 1]
        words = ["--mu", "0.01,0.5,1", "--average", "--json"]
        self.expect_same(gonio.albedo(PAINT, mu, average=True, **PARAMETERS), program("albedo", PAINT, *SET, *words))
        white = "ggx/smith_ggx.correlated/schlick"
        for how in ("walk", "deterministic", "kulla_conty", "turquin", "fdez_aguera"):
            more, said = ({"seed": 3, "walks": 2000}, ["--seed", "3", "--walks", "2000"]) if how == "walk" else ({}, [])
            self.expect_same(gonio.albedo(white, mu, average=True, scattering=how, alpha=0.8, f0=0.9, **more),
                             program("albedo", white, "--set", "alpha=0.8", "f0=0.9", "--scattering", how, *said, *words))

    def test_audits_tables_and_the_catalogue_are_the_programs(self):
        self.assertEqual(gonio.audit("masking.schlick_ggx.direct").text, program("audit", "masking.schlick_ggx.direct", "--json"))
        self.assertEqual(gonio.models().text, program("models", "--json"))
        self.assertEqual(gonio.models("ggx").text, program("models", "ggx", "--json"))
        self.assertEqual(gonio.inspect("paint.csv").text, program("inspect", "paint.csv", "--json"))

    def test_terms_and_maps_have_the_programs_values(self):
        noh = np.linspace(0.1, 1, 7)
        said = ",".join(map(repr, noh.tolist()))
        for number in ("double", "float", "half", "wide"):
            theirs = json.loads(program("term", "ndf.ggx", "--set", "roughness=0.5", "--at", "noh=" + said, "--number", number, "--json"))
            ours = gonio.term("ndf.ggx", {"noh": noh}, number=number, roughness=0.5)
            self.assertEqual(ours.tolist(), theirs["values"])
        several = next(m for m in gonio.models()["maps"] if len(m["outputs"]) > 1)
        theirs = json.loads(program("term", several["id"], "--json"))["values"]
        self.assertEqual(gonio.term(several["id"]).tolist(), theirs)

    def test_synthesized_tables_are_the_programs_to_the_byte(self):
        ours = gonio.synth(PAINT, "hemisphere", noise=0.02, **PARAMETERS)
        ours.write("ours.csv")
        self.assertEqual(open("ours.csv", "rb").read(), open("paint.csv", "rb").read())
        gonio.synth(PAINT, "mbsdf", noise=0.1, outliers=0.01, seed=7, bins="edge", **PARAMETERS).write("ours.mbsdf")
        program("synth", PAINT, *SET, "--layout", "mbsdf", "--noise", "0.1", "--outliers", "0.01", "--seed", "7", "--bins", "edge", "-o",
                "theirs.mbsdf")
        self.assertEqual(open("ours.mbsdf", "rb").read(), open("theirs.mbsdf", "rb").read())

    def test_a_fit_is_a_model_for_both(self):
        fit = gonio.fit("paint.csv")
        fit.write("fit.json")
        open("at.csv", "w").write("theta_i,phi_i,theta_o,phi_o\n30,0,40,180\n10,20,30,40\n")
        theirs = [row["f"] for row in json.loads(program("eval", "fit.json", "--directions", "at.csv", "--json"))["rows"]]
        for model in (fit, dict(fit), "fit.json"):
            self.assertEqual(gonio.eval(model, [30, 10], [0, 20], [40, 30], [180, 40]).tolist(), theirs)
