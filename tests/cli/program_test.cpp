// The program as others call it: exit codes, one document on stdout, one line on stderr, whole
// files or none.
#include "cli/program.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "many_fits.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

namespace gonio::test {
namespace {

TEST(Program, GoesFromSynthOverInspectAndFitToCompare) {
  const Folder f;
  ASSERT_EQ(
      gonio(f, std::string("synth ") + paint + " --layout mbsdf --noise 0.02 -o p.mbsdf").code, 0);
  const auto health = gonio(f, "inspect p.mbsdf --json").json();
  EXPECT_EQ(health["format"], "mbsdf");
  EXPECT_EQ(health["masked"]["negative"], 0);
  EXPECT_TRUE(health["peak"]["resolved"]);

  const auto fit = gonio(f, "fit p.mbsdf -o p.json --html p.html --json");
  ASSERT_EQ(fit.code, 0) << fit.err;
  EXPECT_EQ(fit.err, "");
  const auto document = fit.json();
  EXPECT_EQ(document, nlohmann::json::parse(read_bytes(f / "p.json")));
  EXPECT_EQ(document["schema"], "gonio.fit/1");
  const auto& alpha = document["parameters"]["alpha"];
  EXPECT_NEAR(alpha["value"], 0.15, 4 * alpha["std_error"].get<double>());
  EXPECT_LT(alpha["ci95"][0], alpha["value"]);
  EXPECT_EQ(alpha["status"], "free");
  EXPECT_NEAR(document["parameters"]["roughness"]["value"], std::sqrt(0.15), 1e-3);
  EXPECT_EQ(document["parameters"]["kd"]["value"].size(), 3U);
  EXPECT_EQ(document["input"]["sha256"].get<std::string>().size(), 64U);
  EXPECT_NE(read_bytes(f / "p.html").find("<html"), std::string::npos);

  const auto same = gonio(f, "compare p.mbsdf p.json --json").json();
  EXPECT_NEAR(same["residuals"]["log_rms"], 0.02, 0.001);
  EXPECT_NEAR(same["residuals"]["log_rms"], document["residuals"]["log_rms"], 1e-9);
  const auto truth = gonio(f, std::string("compare p.mbsdf ") + paint + " --json").json();
  EXPECT_NEAR(truth["residuals"]["log_rms"], 0.02, 0.001);
  expect_one_line(gonio(f,
                        "compare p.mbsdf ggx_aniso/smith_ggx_aniso.correlated/schlick --set "
                        "alpha_x=0.3 alpha_y=0.2 f0=0.5"),
                  2, "is anisotropic");
  const auto other = gonio(f, "compare p.mbsdf lambert --set kd=0.2 --json").json();
  EXPECT_GT(other["residuals"]["log_rms"], 0.1);
}

TEST(Program, FindsTheSameResidualsInFitAndCompareAlsoWhereValuesAreZero) {
  const Folder f;
  std::string csv = "theta_i,phi_i,theta_o,phi_o,f\n";
  for (int i = 0; i < 80; ++i)
    csv += std::to_string(i) + ",0,30,180," + (i % 7 ? "0.1" : "0") + "\n";
  f.write("t.csv", csv);
  const auto fit = gonio(f, "fit t.csv --model lambert -o r.json --json").json();
  EXPECT_EQ(fit["input"]["masked"]["zero"], 12);
  const auto compared = gonio(f, "compare t.csv r.json --json").json();
  EXPECT_EQ(fit["residuals"], compared["residuals"]);
}

TEST(Program, ComparesAFitOfSomeChannelsOnThese) {
  const Folder f;
  gonio(f, std::string("synth ") + paint + " --layout hemisphere --noise 0.02 -o t.csv");
  const auto fit = gonio(f, "fit t.csv --channels r b -o two.json --json").json();
  const auto compared = gonio(f, "compare t.csv two.json --json");
  ASSERT_EQ(compared.code, 0) << compared.err;
  EXPECT_EQ(compared.json()["residuals"], fit["residuals"]);
  EXPECT_NE(gonio(f, "compare t.csv two.json").out.find("channels r, b, those of two.json"),
            std::string::npos);
}

TEST(Program, GivesTheSameFilesForASeedWhateverTheThreads) {
  const Folder f;
  for (const char* jobs : {"1", "2"}) {
    const std::string n(jobs);
    ASSERT_EQ(gonio(f, std::string("synth ") + paint +
                           " --layout mbsdf --noise 0.1 --seed 9 --jobs " + n + " -o t" + n)
                  .code,
              0);
    ASSERT_EQ(gonio(f, "fit t" + n + " --robust huber --jobs " + n + " -o r" + n).code, 0);
  }
  EXPECT_EQ(read_bytes(f / "t1"), read_bytes(f / "t2"));
  auto a = nlohmann::json::parse(read_bytes(f / "r1")),
       b = nlohmann::json::parse(read_bytes(f / "r2"));
  for (auto* d : {&a, &b}) {
    (*d)["solver"].erase("time_ms");
    (*d)["input"].erase("path");
  }
  EXPECT_EQ(a, b);
}

TEST(Program, EvaluatesTermsAsItsContractSays) {
  const Folder f;
  const auto d = gonio(f, "term ndf.ggx --set alpha=0.25 --at noh=1,0.9 --json").json();
  EXPECT_EQ(d["id"], "ndf.ggx");
  EXPECT_EQ(d["number"], "double");
  EXPECT_EQ(d["parameters"]["alpha"], 0.25);
  EXPECT_NEAR(d["values"][0], 1 / (M_PI * 0.0625), 1e-12);
  const auto g1 =
      gonio(f, "term masking.smith_ggx.separable --set alpha=0.25 --at nov=0.1 --json").json();
  EXPECT_NEAR(g1["values"][0], 2 * 0.1 / (0.1 + std::sqrt(0.0625 + (1 - 0.0625) * 0.01)), 1e-14);
  const auto g2 =
      gonio(f, "term masking.smith_ggx.separable --set alpha=0.25 --at nov=0.1 nol=0.1 --json")
          .json();
  EXPECT_NEAR(g2["values"][0], std::pow(g1["values"][0].get<double>(), 2), 1e-14);
}

TEST(Program, EvaluatesTermsAndMapsInEveryNumber) {
  const Folder f;
  const auto schlick = [&](const std::string& number) {
    const auto d =
        gonio(f, "term fresnel.schlick --set f0=0.04 --at cos=0.5 --json --number " + number)
            .json();
    EXPECT_EQ(d["number"], number);
    return d["values"][0].get<double>();
  };
  const double exact = 0.04 + 0.96 / 32;  // 0.07
  EXPECT_NEAR(schlick("double"), exact, 1e-16);
  EXPECT_EQ(schlick("wide"), exact);
  EXPECT_EQ(schlick("float"), static_cast<double>(0.07F));
  // f0 = 1311/32768 in half; f0 · 31/32 rounds to 1270/32768, + 1/32 to 1147/16384
  EXPECT_EQ(schlick("half"), 1147.0 / 16384);
  const double mixed = 1311.0 / 32768;  // in float: f0 · 31/32 + 1/32, exact
  EXPECT_EQ(schlick("mixed"), mixed * 31 / 32 + 1.0 / 32);
  const auto d = gonio(f, "term clamp.nov --set nov=0 --number half --json").json();
  EXPECT_EQ(d["values"][0], 168 * std::pow(2, -24));  // 1e-5
  const auto refused = gonio(f, "term ndf.ggx --at noh=1 --number quad");
  EXPECT_EQ(refused.code, 2);
}

TEST(Program, ListsEveryTermWithItsFormulaAndSource) {
  const Folder f;
  const auto m = gonio(f, "models --json").json();
  std::vector<std::string> ids;
  for (const auto& t : m["terms"]) {
    ids.push_back(t["id"]);
    EXPECT_FALSE(t["formula"].get<std::string>().empty()) << ids.back();
    EXPECT_FALSE(t["source"].get<std::string>().empty()) << ids.back();
  }
  for (const char* id : {"ndf.ggx", "ndf.gtr", "masking.smith_ggx.correlated",
                         "masking.smith_ggx.separable", "fresnel.schlick", "fresnel.dielectric",
                         "fresnel.conductor", "diffuse.lambert", "diffuse.lambert.coupled"})
    EXPECT_NE(std::find(ids.begin(), ids.end(), id), ids.end()) << id;
  EXPECT_EQ(m["metals"].size(), 13U);
}

TEST(Program, ListsOnlyWhatHoldsAWord) {
  const Folder f;
  const auto m = gonio(f, "models beckmann --json").json();
  EXPECT_GT(m["terms"].size(), 4U);
  EXPECT_LT(m["terms"].size(), 20U);
  EXPECT_TRUE(m["metals"].empty());
  EXPECT_EQ(gonio(f, "models GOLD --json").json()["metals"].size(), 1U);
  const auto o = gonio(f, "models Heitz");
  EXPECT_EQ(o.code, 0);
  EXPECT_NE(o.out.find("masking.smith_ggx.correlated"), std::string::npos) << "by its source";
  EXPECT_EQ(o.out.find("ndf.blinn_phong"), std::string::npos);
  const auto turned = gonio(f, "models tangent");
  EXPECT_NE(turned.out.find("ndf.ggx_aniso "), turned.out.npos) << turned.out;
  EXPECT_NE(turned.out.find(
                "tangent in [-360, 360], default 0: azimuth of the tangent [°], of a whole model"),
            turned.out.npos)
      << turned.out;
  EXPECT_EQ(turned.out.find("ndf.ggx "), turned.out.npos) << turned.out;
  expect_one_line(gonio(f, "models no_such_word"), 2, "no_such_word");
  expect_one_line(gonio(f, "models no_such_word --json"), 2, "no_such_word");
}

TEST(Program, EvaluatesAModelAtTheDirectionsOfAFile) {
  const Folder f;
  f.write("in.csv", "theta_i,phi_i,theta_o,phi_o\n0,0,0,0\n30,0,30,180\n95,0,10,0\n");
  ASSERT_EQ(gonio(f,
                  "eval ggx/smith_ggx.correlated/conductor --set alpha=0.2 metal=Au "
                  "--directions in.csv -o out.csv")
                .code,
            0);
  const std::string text = read_bytes(f / "out.csv");
  EXPECT_TRUE(text.starts_with("theta_i,phi_i,theta_o,phi_o,f_r,f_g,f_b\n0,0,0,0,"));
  EXPECT_NE(text.find("\n95,0,10,0,0,0,0\n"), std::string::npos) << text;
}

TEST(Program, TellsWrongUsageByExitCodeTwo) {
  const Folder f;
  f.write("t.csv", "theta_i,phi_i,theta_o,phi_o,f\n0,0,0,0,0.3\n");
  expect_one_line_each(
      f, 2,
      {{"", "subcommand"},
       {"nonsense", "no subcommand 'nonsense'"},
       {"model", "nearest: models"},
       {"fit", "FILE is required; see gonio fit --help"},
       {"fit t.csv --model", "--model has no value"},
       {"fit t.csv --metric squares", "squares"},
       {"fit t.csv --model ggx", "NDF/MASKING/FRESNEL"},
       {"fit t.csv -o -", "'-' is no file"},
       {"synth lambert --layout random -o -", "'-' is no file"},
       {"convert t.csv - --to csv", "'-' is no file"},
       {"fit t.csv --html page", "ends in .html"},
       {"inspect t.csv --html page.htm", "ends in .html"},
       {"fit t.csv --model foo/smith_ggx.correlated/schlick", "nearest: ggx"},
       {"fit t.csv --fix alpha=3", "[0.0001, 1]"},
       {"fit t.csv --fix beta=3", "no parameter 'beta'"},
       {"fit t.csv --bounds alpha=0.5,0.1", "bounds"},
       {"term ndf.gx --at noh=1", "ndf.ggx"},
       {"term ndf.ggx --at noh=2", "[0, 1]"},
       {"term ndf.ggx --at noh=1 nol=0.5", "does not read 'nol'"},
       {"term masking.smith_ggx.correlated --at sin2_theta_h=1", "nol, nov"},
       {"term fresnel.schlick --at theta=1", "cos, voh"},
       {"term ndf.ggx --set alpha=nan --at noh=1", "nan"},
       {"synth lambert --set kd=0.2 kd=0.3 --layout random -o x", "twice"},
       {"synth ggx/smith_ggx.correlated/schlick --set f0=0.1 base_color=0.5 --layout random -o "
        "x",
        "f0"},
       {"synth lambert --layout merl --noise -1 -o x", "noise"},
       {"compare t.csv fit --set kd", "NAME=VALUE"},
       {"fit t.csv --model lambert --fix kd=0.3 --bounds kd=0.1,0.2", "held"},
       {"fit t.csv --grey alpha", "no colour"},
       {"fit t.csv --model lambert --intervals by_angle", "one incident angle"},
       {"fit t.csv -o t.csv", "is an input"},
       {"fit t.csv --html ./t.csv", "is an input"},
       {"fit t.csv -o t.csv.gonio.json", "is an input"},
       {"fit t.csv -o r --html r", "two outputs"},
       {"fit t.csv -o r.page.json --html r.html", "two outputs"},
       {"eval lambert --directions t.csv -o t.csv", "is an input"},
       {"eval lambert --directions t.csv", "-o FILE or --json"}});
  EXPECT_EQ(f.entries(), 1U);
}

TEST(Program, TellsBadInputByExitCodeThreeAndLeavesNothing) {
  const Folder f;
  f.write("empty", "");
  f.write("unknown", "PK\x03\x04 not a table");
  f.write("masked.csv", "theta_i,phi_i,theta_o,phi_o,f\n0,0,0,0,-1\n10,0,10,0,nan\n91,0,0,0,1\n");
  f.write("angle.csv", "theta_i,phi_i,theta_o,phi_o,f\n0,0,nan,0,1\n");
  f.write("fine.csv", "theta_i,phi_i,theta_o,phi_o,f\n0,0,0,0,0.3\n30,0,30,180,0.4\n");
  f.write("broken.json", "{");
  ASSERT_EQ(::mkfifo((f / "pipe").c_str(), 0600), 0);
  f.write("other.json",
          R"({"schema":"gonio.fit/1","model":"lambert","parameters":{"kd":{"value":5}}})");
  f.write("bare.json", R"({"schema":"gonio.fit/1","model":"ggx/smith_ggx.correlated/schlick",)"
                       R"("parameters":{"f0":{"value":0.5}}})");
  ASSERT_EQ(gonio(f, std::string("synth ") + paint + " --layout mbsdf -o whole").code, 0);
  f.write("cut", read_bytes(f / "whole").substr(0, 100000));
  const std::size_t before = f.entries();
  expect_one_line_each(f, 3,
                       {{"fit missing -o r.json --html r.html", "missing: opening"},
                        {"inspect .", "a directory"},
                        {"fit /dev/null -o r.json", "/dev/null"},
                        {"fit empty -o r.json", "byte 0"},
                        {"fit unknown -o r.json", "unknown"},
                        {"fit cut -o r.json", "cut: "},
                        {"fit masked.csv -o r.json", "none that can be used"},
                        {"fit angle.csv -o r.json", "line 2, column theta_o"},
                        {"fit fine.csv --model lambert -o no/such/folder/r.json", "writing"},
                        {"fit fine.csv --model lambert -o r.json --html no/such/r.html", "writing"},
                        {"synth lambert --layout random -o no/such/t.csv", "writing"},
                        {"synth lambert --layout image_slice -o no/such/t.exr", "writing"},
                        {"inspect cut", "cut: "},
                        {"compare fine.csv missing.json", "missing.json"},
                        {"compare fine.csv broken.json", "broken.json"},
                        {"compare fine.csv other.json", "other.json: model and parameters"},
                        {"compare fine.csv bare.json", "nothing for 'alpha'"},
                        {"fit fine.csv --model lambert -o pipe", "a device or pipe"},
                        {"fit pipe -o r.json", "a device or pipe"},
                        {"eval lambert --directions unknown -o o.csv", "unknown"}});
  EXPECT_EQ(f.entries(), before);
}

TEST(Program, LeavesNothingWhenItIsInterrupted) {
  const Folder f;
  for (int tenths = 1; tenths < 8; tenths += 2) {
    const std::string after = "0.0" + std::to_string(tenths);
    const std::string command = "cd '" + f / "" + "' && timeout -s INT " + after + " " + program() +
                                " synth " + paint +
                                " --layout hemisphere -o t.csv >/dev/null 2>&1; true";
    ASSERT_EQ(std::system(command.c_str()), 0);
    for (const auto& e : std::filesystem::directory_iterator(f / ""))
      EXPECT_TRUE(e.path().filename() == "t.csv" || e.path().filename() == "t.csv.gonio.json")
          << e.path();
  }
}

TEST(Program, SaysThatAMicrofacetLobeCannotFitRetroReflection) {
  const Folder f;
  std::string csv = "theta_i,phi_i,theta_o,phi_o,f\n";
  for (int in = 10; in <= 60; in += 5)
    for (int out = -80; out <= 80; out += 1) {
      const double off = (out + in) / 3.0;  // −in: back to the light
      csv += std::to_string(in) + ",0," + std::to_string(std::abs(out)) +
             (out < 0 ? ",0," : ",180,") + std::to_string(0.1 + 2 / (1 + off * off)) + "\n";
    }
  f.write("retro.csv", csv);
  const auto d = gonio(f, "fit retro.csv --json").json();
  EXPECT_NE(d["warnings"].dump().find("sits at wo = wi"), std::string::npos) << d["warnings"];
  EXPECT_NE(gonio(f, "inspect retro.csv").out.find("sits at wo = wi"), std::string::npos);
}

TEST(Program, InspectMakesAPageAndItsData) {
  const Folder f;
  ASSERT_EQ(
      gonio(f, std::string("synth ") + paint + " --layout in_plane --noise 0.02 -o p.csv").code, 0);
  const auto o = gonio(f, "inspect p.csv --html p.html --json");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_NEAR(o.json()["noise"]["sigma"], 0.02, 0.004);
  EXPECT_EQ(o.json()["prospects"][0]["verdict"], "yes");
  EXPECT_NE(read_bytes(f / "p.html").find("<html"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(read_bytes(f / "p.page.json"))["health"], o.json());
  EXPECT_NE(gonio(f, "inspect p.csv").out.find("what a fit can hope to determine"),
            std::string::npos);
  const std::size_t before = f.entries();
  expect_one_line(gonio(f, "inspect p.csv --html p.csv"), 2, "p.csv");
  expect_one_line(gonio(f, "inspect missing --html q.html"), 3, "missing");
  expect_one_line(gonio(f, "inspect p.csv --html no/such/q.html"), 3, "writing");
  EXPECT_EQ(f.entries(), before);
}

TEST(Program, SaysWhenStandardOutputCannotBeWritten) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "needs /dev/full, which is not here";
  EXPECT_EQ(WEXITSTATUS(std::system((program() + " models --json >/dev/full 2>/dev/null").c_str())),
            3);
}

TEST(Program, ShowsAnExampleWithEveryHelp) {
  const Folder f;
  for (const char* command : {"models", "term", "eval", "synth", "columns", "convert", "inspect",
                              "fit", "compare", "bench"}) {
    const auto o = gonio(f, std::string(command) + " --help");
    EXPECT_EQ(o.code, 0);
    EXPECT_NE(o.out.find("Example:\n  gonio " + std::string(command)), std::string::npos)
        << command;
  }
}

TEST(Program, BenchesAFitWithItsSpreads) {
  GONIO_MANY_FITS();
  const Folder f;
  const auto o = gonio(f, "bench fit --repeats 1 --no-plain --json");
  ASSERT_EQ(o.code, 0) << o.err;
  const auto document = o.json();
  EXPECT_GT(document["values"], 1'000'000);
  for (const char* name : {"start and solve", "one pass", "its columns read", "whole program"}) {
    const auto& rows = document["rows"];
    const auto row = std::ranges::find_if(rows, [&](const auto& x) { return x["name"] == name; });
    ASSERT_NE(row, rows.end()) << name;
    EXPECT_LE((*row)["least_ms"], (*row)["median_ms"]);
  }
  EXPECT_EQ(gonio(f, "bench render").code, 2);
}

TEST(Program, BenchesMapsInEachWay) {
  GONIO_MANY_FITS();
  const Folder f;
  const auto o = gonio(f, "bench maps --repeats 1 --no-plain --json");
  ASSERT_EQ(o.code, 0) << o.err;
  const auto rows = o.json()["rows"];
  ASSERT_EQ(rows.size(), 6U);
  EXPECT_EQ(rows[0]["name"], "shared directions");
  for (const auto& row : rows) EXPECT_GT(row["texels_per_s"]["least"], 0) << row;
}

TEST(Program, BenchesPartsBesideOneProcess) {
  GONIO_MANY_FITS();
  const Folder f;
  const auto o = gonio(f, "bench parts --repeats 1 --json");
  ASSERT_EQ(o.code, 0) << o.err;
  const auto d = o.json();
  ASSERT_EQ(d["rows"].size(), 3U);
  const auto& eighth = d["rows"][2];  // whose time is so much less that no load makes it more
  EXPECT_EQ(eighth["parts"], 8);
  EXPECT_LT(eighth["slowest_ms"]["median"], d["whole_ms"]["median"]);
  for (const char* name : {"whole_ms", "nothing_to_do_ms"}) EXPECT_GT(d[name]["least"], 0) << name;
}

TEST(Program, FitsTheMeasuredCarPaintAndSaysWhatItMasked) {
  GONIO_NEEDS_SHARED(file, "data/mbsdf/carpaint_blue.mbsdf");
  const Folder f;
  const auto r = gonio(f, "fit '" + file + "' --html c.html --json");
  ASSERT_EQ(r.code, 0) << r.err;
  const auto d = r.json();
  EXPECT_EQ(d["input"]["masked"]["negative"], 54310);
  EXPECT_EQ(d["input"]["masked"]["copied"], 170370);
  EXPECT_EQ(d["intervals"], "clustered by incident angle");
  EXPECT_EQ(d["clusters"], 34);  // 11 of its 45 incident angles only repeat another
  // blue: the last channel's diffuse albedo is several times the others'
  EXPECT_GT(d["parameters"]["kd"]["value"][2].get<double>(),
            2 * d["parameters"]["kd"]["value"][1].get<double>());
}

}  // namespace
}  // namespace gonio::test
