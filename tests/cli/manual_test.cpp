// gonio manual: what shells and man make of it.
#include "base/text.h"
#include "cli/program.h"

namespace gonio::test {
namespace {

/// Output of a command of bash, in the folder where the manual lies under share.
std::string bash(const Folder& f, const std::string& command) {
  f.write("script", command);
  const std::string call = "cd '" + (f / "") + "' && bash script > said 2>&1";
  EXPECT_EQ(std::system(call.c_str()), 0) << read_bytes(f / "said");
  return read_bytes(f / "said");
}

/// What bash offers for the last of some words.
std::string offered(const Folder& f, const std::string& words, int count) {
  return bash(f, "source share/bash-completion/completions/gonio\nCOMP_WORDS=(" + words +
                     ")\nCOMP_CWORD=" + std::to_string(count - 1) +
                     "\n_gonio\necho \"${COMPREPLY[@]}\"");
}

bool has(const char* program) {
  return std::system((std::string("command -v ") + program + " >/dev/null").c_str()) == 0;
}

TEST(Manual, HasAPageForEachCommandThatManReadsWithoutAWarning) {
  const Folder f;
  ASSERT_EQ(gonio(f, "manual share").code, 0);
  const std::string help = gonio(f, "--help").out;
  int pages = 0;
  for (const auto& line : split(help.substr(help.find("Subcommands:")), '\n')) {
    if (!line.starts_with("  ")) continue;
    const std::string name = line.substr(2, line.find(' ', 2) - 2);
    if (name.empty()) continue;
    const std::string page = read_bytes(f / ("share/man/man1/gonio-" + name + ".1"));
    EXPECT_NE(page.find(".SH EXAMPLE"), page.npos) << name;
    EXPECT_NE(page.find(".SH EXIT STATUS"), page.npos) << name;
    ++pages;
  }
  EXPECT_GT(pages, 20);
  if (!has("groff")) GTEST_SKIP() << "Without groff: man pages are not set.";
  EXPECT_EQ(bash(f, "for p in share/man/man1/*; do groff -man -ww -z -Tutf8 $p; done"), "");
  const std::string fit =
      bash(f, "groff -man -Tutf8 -P-cbou share/man/man1/gonio-fit.1 | tr '\\n' ' ' | tr -s ' '");
  for (const char* told : {"--metric", "l2_cosine", "gonio fit ", "-o, --output"})
    EXPECT_NE(fit.find(told), fit.npos) << told << "\n" << fit;
}

TEST(Manual, TellsWhichWordsMayBeLeftOutAndWhichMayBeSeveral) {
  const Folder f;
  ASSERT_EQ(gonio(f, "manual share").code, 0);
  const auto synopsis = [&](const std::string& name) {
    const std::string page = read_bytes(f / ("share/man/man1/gonio-" + name + ".1"));
    const auto at = page.find(".SH SYNOPSIS\n");
    return page.substr(at, page.find(".SH OPTIONS") - at);
  };
  EXPECT_EQ(synopsis("gather"), ".SH SYNOPSIS\n.B gonio gather\n.I DIR\n.I [FILE...]\n[options]\n");
  EXPECT_EQ(synopsis("fit"), ".SH SYNOPSIS\n.B gonio fit\n.I FILE...\n[options]\n");
}

TEST(Manual, LetsBashCompleteCommandsOptionsAndWhatTheyTake) {
  const Folder f;
  ASSERT_EQ(gonio(f, "manual share").code, 0);
  EXPECT_EQ(offered(f, "gonio insp", 2), "inspect\n");
  EXPECT_EQ(offered(f, "gonio fit --metr", 3), "--metric\n");
  EXPECT_EQ(offered(f, "gonio fit --metric l2", 4), "l2_cosine\n");
  EXPECT_EQ(offered(f, "gonio shader --language w", 4), "wgsl\n");
  EXPECT_NE(offered(f, "gonio fit --model lambert+gg", 4)
                .find("lambert+ggx/smith_ggx.correlated/schlick"),
            std::string::npos);
  EXPECT_EQ(offered(f, "gonio fit --models al", 4), "all\n");
  EXPECT_EQ(offered(f, "gonio fit ''", 3), "\n") << "a table: bash offers files";
  EXPECT_EQ(offered(f, "gonio fit -o ''", 4), "\n") << "a file";
}

TEST(Manual, IsReadByZshAndFish) {
  const Folder f;
  ASSERT_EQ(gonio(f, "manual share").code, 0);
  if (!has("zsh") || !has("fish"))
    GTEST_SKIP() << "Without zsh and fish: their words are not read.";
  EXPECT_EQ(bash(f, "zsh -n share/zsh/site-functions/_gonio"), "");
  const std::string words = "source share/fish/vendor_completions.d/gonio.fish; complete -C ";
  EXPECT_NE(bash(f, "fish -c \"" + words + "'gonio fit --metric l2'\"").find("l2_cosine"),
            std::string::npos);
  EXPECT_NE(bash(f, "fish -c \"" + words + "'gonio insp'\"").find("inspect"), std::string::npos);
}

TEST(Manual, WithoutAPlaceForItIsOneLine) {
  const Folder f;
  expect_one_line_each(f, 3, {{"manual /proc/nowhere", "/proc/nowhere"}});
  f.write("share", "a file");
  expect_one_line_each(f, 3, {{"manual share", "share"}});
  expect_one_line_each(f, 2, {{"manual", "DIR"}});
}

}  // namespace
}  // namespace gonio::test
