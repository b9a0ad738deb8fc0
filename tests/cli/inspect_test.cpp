#include "cli/program.h"

namespace gonio::test {
namespace {

TEST(Inspect, PlansWhatToMeasureNextWhereItIsAsked) {
  const Folder f;
  ASSERT_EQ(
      gonio(f, std::string("synth ") + paint + " --layout in_plane --noise 0.02 -o p.csv").code, 0);
  const auto plain = gonio(f, "inspect p.csv --json");
  EXPECT_FALSE(plain.json().contains("next"));
  const auto planned = gonio(f, "inspect p.csv --plan-next 3 --json");
  ASSERT_EQ(planned.code, 0) << planned.err;
  auto document = planned.json();
  ASSERT_EQ(document["next"].size(), 3U);
  for (const auto& row : document["next"]) {
    EXPECT_EQ(row.size(), 8U);
    EXPECT_EQ(row["phi_i"], 0);
    EXPECT_TRUE(row["phi_o"] == 0 || row["phi_o"] == 180);
    EXPECT_LE(row["width_after"].get<double>(), row["width_before"].get<double>());
  }
  EXPECT_EQ(planned.json(), gonio(f, "inspect p.csv --plan-next 3 --json --jobs 1").json());
  document.erase("next");
  EXPECT_EQ(document, plain.json()) << "all else stays";

  const auto words = gonio(f, "inspect p.csv --plan-next 3").out;
  const auto before = gonio(f, "inspect p.csv").out;
  ASSERT_TRUE(words.starts_with(before));
  EXPECT_TRUE(words.substr(before.size())
                  .starts_with("\nmeasure next  these directions for a fit "
                               "of lambert+ggx"))
      << words.substr(before.size());
}

TEST(Inspect, BoundsTheErrorOfTheAlbedoOfAnRglFile) {
  for (const char* model :
       {"lambert+ggx/smith_ggx.correlated/schlick --set alpha=0.02 f0=0.04 kd=0.3",
        "lambert+beckmann/smith_beckmann.correlated/schlick --set alpha=0.1 f0=0.04 kd=0.05",
        "ggx/smith_ggx.correlated/schlick --set alpha=0.2 f0=0.9", "lambert --set kd=0.5"}) {
    const Folder f;
    ASSERT_EQ(gonio(f, std::string("synth ") + model + " --layout rgl -o t.bsdf").code, 0);
    const auto rows = gonio(f, "inspect t.bsdf --json").json()["albedo"];
    const auto truth =
        gonio(f, std::string("albedo ") + model +
                     " --mu 1 0.965925826 0.866025404 0.707106781 0.5 0.258819045 --json")
            .json()["albedo"];
    ASSERT_EQ(rows.size(), 6U);
    for (std::size_t k = 0; k < 6; ++k) {
      const double error = rows[k]["error"].get<double>(), right = truth[k].get<double>();
      EXPECT_NEAR(rows[k]["albedo"][0].get<double>(), right, error) << model << " " << 15 * k;
      EXPECT_LT(error, 0.1 * right) << model << " " << 15 * k;
    }
  }
}

TEST(Inspect, RefusesPlansInOneLine) {
  const Folder f;
  ASSERT_EQ(gonio(f, std::string("synth ") + paint + " --layout in_plane -o p.csv").code, 0);
  f.write("few.csv", "theta_i,phi_i,theta_o,phi_o,f\n30,0,30,180,1\n30,0,40,180,0.5\n");
  expect_one_line_each(f, 2,
                       {{"inspect p.csv --plan-next 0", "not in range 1 to 256"},
                        {"inspect p.csv --plan-next 257", "not in range 1 to 256"},
                        {"inspect p.csv --plan-next 3 --model nothing", "nothing"},
                        {"inspect p.csv --model lambert", "--plan-next"}});
  expect_one_line(gonio(f, "inspect few.csv --plan-next 3"), 3, "free parameters");
  expect_one_line(gonio(f, "inspect p.csv --plan-next 3 --model lambert"), 3,
                  "no further direction mends that (try --model lambert+ggx");
}

}  // namespace
}  // namespace gonio::test
