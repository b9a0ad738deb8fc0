// gonio synth: what it says of the table that it wrote.
#include "cli/program.h"

namespace gonio::test {
namespace {

TEST(SynthCommand, SaysInOneLineWhatItWrote) {
  const Folder f;
  const std::string words = std::string("synth ") + paint + " --layout in_plane -o p.csv";
  const auto o = gonio(f, words + " --noise 0.02 --seed 7");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.out, "p.csv: csv, 855 directions, channels r g b, noise 2 %, seed 7\n");
  EXPECT_EQ(o.err, "");
  EXPECT_EQ(gonio(f, words).out, "p.csv: csv, 855 directions, channels r g b, no noise\n");
  EXPECT_EQ(gonio(f,
                  "synth lambert --layout random --samples 4000 --floor 0.1 --outliers 0.05 -o "
                  "l.csv")
                .out,
            "l.csv: csv, 4,000 directions, channels r g b, no noise, floor 0.1 1/sr, outliers 5 %, "
            "seed 1\n");
}

TEST(SynthCommand, IsSilentWhereThatIsAskedForAndPrintsOneDocumentWhereThatIs) {
  const Folder f;
  const std::string words = std::string("synth ") + paint + " --layout in_plane -o p.csv";
  EXPECT_EQ(gonio(f, words + " --quiet").out, "");
  const auto j = gonio(f, words + " --json").json();
  EXPECT_EQ(j["path"], "p.csv");
  EXPECT_EQ(j["samples"], 855);
}

}  // namespace
}  // namespace gonio::test
