// gonio explore: the page that it writes, what it refuses, and the page in a browser.
#include "cli/program.h"

namespace gonio::test {
namespace {

TEST(Explore, WritesOnePageAndSaysWhatItHolds) {
  const Folder f;
  gonio(f, "synth " + std::string(paint) + " --layout hemisphere -o t.csv");
  const auto o = gonio(f, "explore t.csv disney -o p.html --json");
  ASSERT_EQ(o.code, 0) << o.err;
  const auto document = o.json();
  EXPECT_EQ(document["page"], "p.html");
  EXPECT_EQ(document["items"][0]["table"], "t.csv");
  EXPECT_GT(document["items"][0]["covered"], 0.9);
  EXPECT_EQ(document["items"][1]["model"], "disney");
  EXPECT_NE(read_bytes(f / "p.html").find("id=\"explored\""), std::string::npos);
  const auto said = gonio(f, "explore t.csv -o q.html").out;
  EXPECT_NE(said.find("typically off by"), std::string::npos);
  EXPECT_EQ(gonio(f, "explore t.csv disney -o again.html").code, 0);
  EXPECT_EQ(read_bytes(f / "again.html"), read_bytes(f / "p.html"));
}

TEST(Explore, RefusesWhatNoPageCanShow) {
  const Folder f;
  f.write("odd.csv", "a,b\n1,2\n");
  gonio(f, "synth " + std::string(paint) + " --layout in_plane -o t.csv");
  const std::size_t before = f.entries();
  expect_one_line_each(
      f, 2,
      {{"explore", "-o"},
       {"explore a b c d e f g h i -o p.html", "9 models and tables, expected 8 at most"},
       {"explore disney lambert --set kd=0.1 -o p.html", "--set"},
       {"explore t.csv --set kd=0.1 -o p.html", "--set"},
       {"explore ggx/nothing/schlick -o p.html", "nothing"},
       {"explore t.csv -o t.csv", "t.csv"}});
  expect_one_line_each(f, 3,
                       {{"explore odd.csv -o p.html", "odd.csv"},
                        {"explore missing.json -o p.html", "missing.json"},
                        {"explore disney -o no/such/p.html", "writing"}});
  EXPECT_EQ(f.entries(), before);
}

bool lacks_browser() {
  const auto found = [](const char* names) {
    return std::system((std::string("for c in ") + names +
                        "; do command -v $c >/dev/null && exit 0; done; exit 1")
                           .c_str()) == 0;
  };
  return !found("chromium chromium-browser google-chrome") || !found("python3");
}
/// Plays with the pages of a folder by a script, which says what is not as it should be.
void play_with(const Folder& f, const std::string& script) {
  const int status = std::system(("python3 '" + project_folder() + "/tests/cli/" + script + "' " +
                                  program() + " '" + f / "" + "' >'" + f / "said" + "' 2>&1")
                                     .c_str());
  EXPECT_EQ(status, 0) << read_bytes(f / "said");
}

TEST(Explore, PageDoesInABrowserWhatItSays) {
  if (lacks_browser()) GTEST_SKIP() << "needs Chromium and Python 3, which are not here";
  const Folder f;
  gonio(f, "synth " + std::string(paint) + " --layout hemisphere --noise 0.02 -o t.csv");
  ASSERT_EQ(gonio(f, "fit t.csv -o fit.json --quiet").code, 0);
  ASSERT_EQ(gonio(f, "explore t.csv fit.json disney -o paint.html").code, 0);
  ASSERT_EQ(gonio(f, "explore -o plain.html").code, 0);
  gonio(f,
        "synth lambert+ggx/smith_ggx.correlated/schlick --set alpha=0.9 f0=0.04 kd=0.3 --layout "
        "hemisphere -o dull.csv");
  ASSERT_EQ(gonio(f, "explore dull.csv -o dull.html").code, 0);
  f.write("limits.json",
          R"({"schema": "gonio.fit/1", "model": "lambert+ggx/smith_ggx.correlated/schlick",
"channels": ["450", "550", "650"], "parameters": {
"kd": {"value": [0.2, 1, null], "ci95": [[0.1, 0.3], null, null], "status": ["free", "at_bound", "not_identifiable"], "limit": [null, null, null], "reason": ["", "", "dark"]},
"alpha": {"value": 0.3, "ci95": [0, 1], "status": "unbounded", "limit": null, "reason": "best value for this model; the model is too wrong to bound it"},
"roughness": {"value": 0.5477},
"f0": {"value": [0.01, 0.04, 0.04], "ci95": [null, null, null], "status": ["upper_limit", "lower_limit", "fixed"], "limit": [0.09, 0.02, null], "reason": ["values down to 0 do as well", "", ""]}}})");
  ASSERT_EQ(gonio(f, "explore dull.csv limits.json -o limits.html").code, 0);
  const std::string name = "'<img src=x onerror=alert(1)>.csv'";
  ASSERT_EQ(gonio(f, "explore ./" + name + " -o hostile.html", "cp t.csv " + name + "; ").code, 0);
  play_with(f, "explore_page.py");
}

TEST(Explore, PageFitsInABrowserAsTheProgramDoes) {
  if (lacks_browser()) GTEST_SKIP() << "needs Chromium and Python 3, which are not here";
  const Folder f;
  const std::string synth = "synth " + std::string(paint) + " --noise 0.02 --layout ";
  ASSERT_EQ(gonio(f, synth + "hemisphere -o t.csv").code, 0);
  ASSERT_EQ(gonio(f, synth + "in_plane -o small.csv").code, 0);
  ASSERT_EQ(gonio(f, synth + "merl -o m.binary").code, 0);
  std::filesystem::remove(f /
                          "m.binary.gonio.json");  // as a table from elsewhere: without its truth
  ASSERT_EQ(gonio(f, "explore t.csv lambert+ggx/smith_ggx.correlated/schlick -o paint.html").code,
            0);
  ASSERT_EQ(gonio(f, "explore --app -o app.html").code, 0);
  EXPECT_LT(read_bytes(f / "app.html").size(), 3'000'000U);
  play_with(f, "explore_fit_page.py");
}

}  // namespace
}  // namespace gonio::test
