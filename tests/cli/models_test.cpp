// gonio fit --models as a person at a terminal sees it.
#include <algorithm>

#include "cli/program.h"
#include "many_fits.h"

namespace gonio::test {
namespace {

constexpr const char* two =
    "lambert+ggx/smith_ggx.correlated/schlick,lambert+gtr/smith_ggx.correlated/schlick";

void make_table(const Folder& f) {
  ASSERT_EQ(
      gonio(f,
            "synth lambert+gtr/smith_ggx.correlated/schlick --set alpha=0.2 gamma=1.3 f0=0.05 "
            "kd=0.3 --layout hemisphere --noise 0.02 -o t.csv")
          .code,
      0);
}

TEST(Models, SaysFirstWhichToTakeAndWhy) {
  const Folder f;
  make_table(f);
  const auto o = gonio(f, std::string("fit t.csv --models ") + two + " -o c.json");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_TRUE(o.out.starts_with("take    lambert+gtr/smith_ggx.correlated/schlick\nbecause "))
      << o.out;
  const auto document = gonio(f, std::string("fit t.csv --json --models ") + two).json();
  EXPECT_EQ(document["schema"], "gonio.models/1");
  EXPECT_EQ(document["recommended"], "lambert+gtr/smith_ggx.correlated/schlick");
  const auto& rows = document["models"];
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_GT(rows[0]["cv_log_rms"], rows[1]["cv_log_rms"]);
  EXPECT_GT(rows[0]["bic"], rows[1]["bic"]);
  EXPECT_GT(rows[0]["delta_e_2000"], rows[1]["delta_e_2000"]);
  EXPECT_GT(rows[0]["delta_e_itp"], rows[1]["delta_e_itp"]);
  EXPECT_GT(rows[0]["delta_e_itp"], 1.2 * rows[0]["delta_e_2000"].get<double>())
      << "its steps are finer in what is dark and in light beyond white";
  EXPECT_GT(rows[0]["ns"], 0);
}

TEST(Models, OfAllAreTheUsualOnesAndEachStaysInTheTable) {
  GONIO_MANY_FITS();
  const Folder f;
  make_table(f);
  const auto rows = gonio(f, "fit t.csv --json --models all").json()["models"];
  EXPECT_GT(rows.size(), 8U);
  for (const auto& r : rows) EXPECT_TRUE(r.contains("cv_log_rms") || r.contains("note")) << r;
}

TEST(Models, AreOfOneTable) {
  const Folder f;
  make_table(f);
  for (const char* words :
       {"fit t.csv t.csv", "fit t.csv t.csv --html p.html", "fit t.csv --pages"}) {
    const auto o = gonio(f, std::string(words) + " --models " + two);
    EXPECT_EQ(o.code, 2) << words;
    EXPECT_EQ(std::ranges::count(o.err, '\n'), 1) << o.err;
  }
  const auto twice =
      gonio(f, "fit t.csv --models lambert,ggx/smith_ggx.correlated/schlick,lambert");
  EXPECT_EQ(twice.code, 2);
  EXPECT_NE(twice.err.find("'lambert' is there twice"), std::string::npos) << twice.err;
  const auto none = gonio(f, "fit t.csv --models no_such_model -o c.json");
  EXPECT_EQ(none.code, 2);
  EXPECT_NE(none.err.find("no_such_model"), std::string::npos) << none.err;
}

/// A page's data without what is measured in time: keys, the scale of time, and which models lie on the front.
nlohmann::json without_times(nlohmann::json page) {
  for (auto& m : page["choice"]["models"]) m.erase("ns"), m.erase("ns_spread");
  auto& picture = page["figures"][0];
  picture.erase("x");
  auto& curves = picture["curves"];
  for (auto& c : curves) c.erase("x_ns"), c.erase("x_error_ns");
  std::erase_if(curves.get_ref<nlohmann::json::array_t&>(),
                [](const auto& c) { return c["name"] == "front"; });
  return page;
}

TEST(Models, HaveAPageWithTheirDocumentInItsDataWhichIsTheSameOnAnyNumberOfThreads) {
  const Folder f;
  make_table(f);
  const auto run = [&](const std::string& jobs) {
    const auto o = gonio(f, std::string("fit t.csv --fix alpha=0.2 --models lambert,") + two +
                                " -o c.json --html p.html --jobs " + jobs);
    EXPECT_EQ(o.code, 0) << o.err;
    return nlohmann::json::parse(read_bytes(f / "p.page.json"));
  };
  const auto page = run("1");
  EXPECT_EQ(page["choice"], nlohmann::json::parse(read_bytes(f / "c.json")));
  EXPECT_GT(page["numbers"][0], 0) << "Lambert has no alpha to be held";
  EXPECT_NE(read_bytes(f / "p.html").find("<title>Models for t.csv</title>"), std::string::npos);
  EXPECT_EQ(without_times(page), without_times(run("2")));
}

}  // namespace
}  // namespace gonio::test
