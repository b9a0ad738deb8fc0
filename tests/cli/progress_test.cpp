// What a person at a terminal sees while a command works, and that nobody else sees any of it.
#include "cli/program.h"

namespace gonio::test {
namespace {

/// All that a terminal of 60 columns is told within so many seconds, in its order.
std::string seen_on_a_terminal(const Folder& f, const std::string& words, int seconds) {
  const std::string shown = "script -qc \"stty cols 60; timeout --foreground " +
                            std::to_string(seconds) + " " + program() + " " + words +
                            "\" /dev/null";
  EXPECT_EQ(std::system(("cd '" + f / "" + "' && " + shown + " >shown </dev/null").c_str()), 0);
  return read_bytes(f / "shown");
}

TEST(Progress, TellsTheTimeOfAStepThatTakesLong) {
  if (std::system("command -v script >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "needs script, which is not here";
  const Folder f;
  const std::string hours =
      "albedo ggx/smith_ggx.correlated/schlick --set alpha=1 f0=0.5 --mu 0.5 --scattering walk "
      "--walks 1000000000000 --error 1e-12";
  const auto shown = seen_on_a_terminal(f, hours, 6);
  EXPECT_NE(shown.find("walking 0 of 1 …\r"), shown.npos) << shown;
  EXPECT_NE(shown.find("walking 0 of 1 … 0:02"), shown.npos) << shown;
  const auto quiet = seen_on_a_terminal(f, hours + " --quiet", 2);
  EXPECT_EQ(quiet.find("walking"), quiet.npos) << quiet;
}

TEST(Progress, StaysInOneLineOfATerminal) {
  if (std::system("command -v script >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "needs script, which is not here";
  const Folder f;
  const std::string name(100, 'n');
  f.write(name + ".csv", "theta_i,theta_o,f\n10,20,0.1\n20,30,0.1\n30,40,0.1\n");
  const auto shown = seen_on_a_terminal(f, "compare " + name + ".csv lambert --set kd=0.3", 60);
  const auto begin = shown.find("reading ");
  ASSERT_NE(begin, shown.npos) << shown;
  const auto end = shown.find('\r', begin);
  EXPECT_LE(end - begin, 59U) << shown;
}

TEST(Progress, TellsHowMuchOfAMapIsDone) {
  if (std::system("command -v script >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "needs script, which is not here";
  const Folder f;
  ASSERT_EQ(
      gonio(f, std::string("synth ") + paint + " --layout map --size 40,30 --images 12 -o s").code,
      0);
  const auto shown = seen_on_a_terminal(f, "fit_map s/stack.json -o maps.exr", 60);
  EXPECT_NE(shown.find("fitting 40 × 30 texels, 0 % …"), shown.npos) << shown;
  EXPECT_NE(shown.find("fitting 40 × 30 texels, 100 %, 0:00 left …"), shown.npos) << shown;
}

TEST(Progress, IsNotShownInAPipe) {
  const Folder f;
  const auto o = gonio(f, "albedo lambert --set kd=0.3 --mu 0.5");
  EXPECT_EQ(o.err, "");
}

}  // namespace
}  // namespace gonio::test
