// gonio fit as a person at a terminal sees it.
#include <algorithm>
#include <filesystem>

#include "base/text.h"
#include "cli/program.h"

namespace gonio::test {
namespace {

/// A paint whose highlight has another tail than the model's.
void make_misfit(const Folder& f) {
  ASSERT_EQ(gonio(f,
                  "synth lambert+gtr/smith_ggx.correlated/schlick --set alpha=0.3 gamma=1 f0=0.05 "
                  "kd=0.2 --layout in_plane --noise 0.01 -o t.csv")
                .code,
            0);
}

/// Lines that a terminal of so many columns shows.
std::vector<std::string> on_a_terminal(const Folder& f, const std::string& words, int columns) {
  const std::string shown = "script -qec \"stty cols " + std::to_string(columns) + "; " +
                            program() + " " + words + "\" /dev/null";
  EXPECT_EQ(std::system(("cd '" + f / "" + "' && " + shown + " >shown </dev/null").c_str()), 0);
  std::string text = read_bytes(f / "shown");
  std::erase(text, '\r');
  return split(text, '\n');
}

TEST(Fit, LinesAreWrappedBelowTheirTextOnATerminalAndWholeInAPipe) {
  if (std::system("command -v script >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "needs script, which is not here";
  const Folder f;
  make_misfit(f);
  const auto lines = on_a_terminal(f, "fit t.csv --quiet", 60);
  const auto first = std::ranges::find_if(lines, [](const std::string& l) {
    return l.starts_with("beware  beyond noise the model is off");
  });
  ASSERT_NE(first, lines.end());
  EXPECT_TRUE((first + 1)->starts_with("        ")) << *(first + 1);
  EXPECT_NE((*(first + 1))[8], ' ');
  for (const auto& l : lines)  // bytes, of which ° and ± have two; a model's name is not broken
    EXPECT_TRUE(l.size() <= 64 || l.find(' ', l.find_first_not_of(' ')) == l.npos) << l;
  const std::string piped = gonio(f, "fit t.csv").out;
  EXPECT_NE(piped.find("beware  beyond noise the model is off"), piped.npos);
  EXPECT_NE(piped.find("; intervals are widened\nbeware  for instance, around theta_h "),
            piped.npos)
      << piped;
}

TEST(Fit, RemembersTheConesForACompare) {
  const Folder f;
  ASSERT_EQ(
      gonio(f, std::string("synth ") + paint + " --layout in_plane --aperture 8,2 -o t.csv").code,
      0);
  ASSERT_EQ(gonio(f, "fit t.csv -o fit.json --certificate none").code, 0);
  std::filesystem::remove(f / "t.csv.gonio.json");
  const auto rms = [&](const std::string& options) {
    return gonio(f, "compare t.csv " + options + " --json")
        .json()["residuals"]["rms"]
        .get<double>();
  };
  EXPECT_EQ(rms("fit.json"), rms("fit.json --aperture 8,2"));
  EXPECT_NE(gonio(f, "compare t.csv fit.json").out.find("8° (light) and 2° (detector)"),
            std::string::npos);
  EXPECT_LT(rms("fit.json"), 0.1 * rms("fit.json --aperture 0.1,0"));
}

TEST(Fit, ComparesModelsOfCountsByTheirWeights) {
  const Folder f;
  ASSERT_EQ(
      gonio(f, std::string("synth ") + paint + " --layout in_plane --noise 0.02 -o t.csv").code, 0);
  ASSERT_EQ(gonio(f, "columns t.csv --scale 54321").code, 0);
  const std::string lobe = "ggx/smith_ggx.correlated/schlick";
  const auto d =
      gonio(f, "fit t.csv --scale free --models lambert,eon,lambert+" + lobe + " --json").json();
  ASSERT_EQ(d["models"].size(), 2U) << "eon has no weight";
  EXPECT_EQ(d["recommended"], "lambert+" + lobe + ".weighted");
  EXPECT_NE(d["warnings"].dump().find("the scale is free"), std::string::npos);
  expect_one_line(gonio(f, "fit t.csv --scale free --models eon"), 2, "scale free");
  expect_one_line(gonio(f, "fit t.csv --scale free --fix kd=0.3"), 2, "kd given");
}

TEST(Fit, SaysInTwoLinesWhatToTryNext) {
  const Folder f;
  // Several models mend this about as well.
  ASSERT_EQ(
      gonio(
          f,
          "synth disney --set roughness=0.5 base_color=0.5 --layout in_plane --noise 0.03 -o t.csv")
          .code,
      0);
  const auto next = gonio(f, "fit t.csv --json").json()["next"];
  ASSERT_GT(next.size(), 2U);
  const auto said = gonio(f, "fit t.csv").out;
  for (std::size_t k = 0; k < next.size(); ++k)
    EXPECT_EQ(said.find("\ntry     " + next[k].get<std::string>() + "\n") != said.npos, k < 2)
        << said;
  ASSERT_EQ(gonio(f, std::string("synth ") + paint + " --layout in_plane -o p.csv").code, 0);
  EXPECT_EQ(gonio(f, "fit p.csv").out.find("\ntry "), std::string::npos) << "nothing is wrong";
}

/// True where a sentence holds the words.
bool any_holds(const nlohmann::json& sentences, const std::string& words) {
  return std::ranges::any_of(sentences, [&](const nlohmann::json& s) {
    return s.get<std::string>().find(words) != std::string::npos;
  });
}

TEST(Fit, TellsThatSinteredPtfeAsAModelReturnsMoreLightThanArrives) {
  GONIO_NEEDS_SHARED(path, "data/nist_ptfe/PTFE.data.csv");
  const Folder f;
  f.write("ptfe.csv", read_bytes(path));
  ASSERT_EQ(gonio(f,
                  "columns ptfe.csv --map theta_i=thetai phi_i=phi theta_o=thetar phi_o=phir "
                  "f=f_r11 channel=lambda")
                .code,
            0);
  const auto d = gonio(f, "fit ptfe.csv --json").json();
  const auto& physics = d["physics"];
  double most = 0, at = 0;
  for (std::size_t k = 0; k < physics["theta_i_deg"].size(); ++k)
    for (const auto& albedo : physics["model_albedo"][k])
      if (albedo > most) most = albedo, at = physics["theta_i_deg"][k];
  EXPECT_NEAR(most, 1.015, 0.005);
  EXPECT_EQ(at, 75);
  EXPECT_TRUE(any_holds(d["warnings"], "at theta_i 75° (the table 0.97")) << d["warnings"];
  EXPECT_TRUE(any_holds(d["warnings"], "more than there is")) << d["warnings"];
  EXPECT_TRUE(any_holds(d["next"], "may return less light")) << d["next"];
}

TEST(Fit, TellsThatACarPaintWithItsCopiesRisesAboveItsTable) {
  GONIO_NEEDS_SHARED(path, "data/mbsdf/carpaint_blue.mbsdf");
  const Folder f;
  const auto kept = gonio(f, "fit '" + path + "' --metric l2_cosine --copies keep --json").json();
  double most = 0;
  for (const double ratio : kept["physics"]["peak_ratio"]) most = std::max(most, ratio);
  EXPECT_GT(most, 2);
  EXPECT_TRUE(any_holds(kept["warnings"], "the model's greatest value is")) << kept["warnings"];
  EXPECT_TRUE(any_holds(kept["next"], "fit without --copies keep")) << kept["next"];
  const auto left = gonio(f, "fit '" + path + "' --metric l2_cosine --json").json();
  EXPECT_FALSE(any_holds(left["warnings"], "the model's greatest value is")) << left["warnings"];
  EXPECT_FALSE(any_holds(left["next"], "--copies")) << left["next"];
}

TEST(Fit, SaysWhatIsKnownInPlainWords) {
  const Folder f;
  ASSERT_EQ(gonio(f, "synth lambert --set kd=0.2 --layout in_plane -o t.csv").code, 0);
  const auto fixed = gonio(f, "fit t.csv --model lambert --fix kd=0.3");
  EXPECT_NE(fixed.out.find("held\n"), fixed.out.npos) << fixed.out;
  const auto bound = gonio(f, "fit t.csv --model lambert --bounds kd=0.3,0.5");
  EXPECT_NE(bound.out.find("at the end of its range"), bound.out.npos) << bound.out;
  for (const auto& o : {fixed, bound}) {
    EXPECT_EQ(o.out.find("at_bound"), o.out.npos);
  }
  EXPECT_NE(gonio(f, "synth " + std::string(paint) + " --layout in_plane -o p.csv").code, 2);
  for (const char* table : {"t.csv --model lambert", "p.csv"}) {
    const auto said = gonio(f, std::string("fit ") + table).out;
    EXPECT_TRUE(said.ends_with("\nconverged\n")) << said;
  }
}

TEST(Fit, AnIntervalThatIsCutIsShownByItsEnds) {
  const Folder f;
  std::string csv = "theta_i,phi_i,theta_o,phi_o,f\n";
  for (int i = 0; i < 80; i += 10)  // a diffuse reflectance that few values know, near its least
    csv += std::to_string(i) + ",0,30,180," + (i % 20 ? "0.01" : i % 40 ? "0.1" : "1e-4") + "\n";
  f.write("t.csv", csv);
  const auto d = gonio(f, "fit t.csv --model lambert --metric l2_cosine --json").json();
  const auto& kd = d["parameters"]["kd"];
  ASSERT_EQ(kd["status"], "free");
  ASSERT_EQ(kd["ci95"][0], 0) << "cut at the end of its range";
  const auto said = gonio(f, "fit t.csv --model lambert --metric l2_cosine").out;
  EXPECT_NE(said.find(" (95 %: 0 to 0."), said.npos) << said;
}

TEST(Fit, CountsOfABatchAreOfEachTableOnce) {
  const Folder f;
  for (const char* name : {"a", "b"})
    ASSERT_EQ(
        gonio(f, std::string("synth lambert --set kd=0.2 --layout in_plane -o ") + name + ".csv")
            .code,
        0);
  f.write("c.csv", "theta_i");
  EXPECT_NE(gonio(f, "fit a.csv --model lambert -o out b.csv").out.find("tables   2: 2 fitted\n"),
            std::string::npos);
  const auto again = gonio(f, "fit a.csv b.csv c.csv --model lambert -o out").out;
  EXPECT_NE(again.find("tables   3: 0 fitted, 2 kept from before, 1 failed\n"), again.npos)
      << again;
}

}  // namespace
}  // namespace gonio::test
