// gonio fit as a person at a terminal sees it.
#include <algorithm>

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
  const std::string shown = "script -qec \"stty cols " + std::to_string(columns) +
                            "; '" GONIO_PROGRAM "' " + words + "\" /dev/null";
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
  const auto first = std::ranges::find_if(
      lines, [](const std::string& l) { return l.starts_with("beware  the model misses"); });
  ASSERT_NE(first, lines.end());
  EXPECT_TRUE((first + 1)->starts_with("        ")) << *(first + 1);
  EXPECT_NE((*(first + 1))[8], ' ');
  for (const auto& l : lines) EXPECT_LE(l.size(), 64U) << l;  // bytes, of which ° and ± have two
  const std::string piped = gonio(f, "fit t.csv").out;
  EXPECT_NE(piped.find("beware  the model misses"), piped.npos);
  EXPECT_NE(piped.find("; the intervals allow for it\nbeware  it is furthest off near theta_h "),
            piped.npos)
      << piped;
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
    const int n =
        gonio(f, std::string("fit --json ") + table).json()["solver"]["iterations"].get<int>();
    const auto said = gonio(f, std::string("fit ") + table).out;
    const std::string line =
        "converged after " + std::to_string(n) + (n == 1 ? " iteration\n" : " iterations\n");
    EXPECT_TRUE(said.ends_with(line)) << said;
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
