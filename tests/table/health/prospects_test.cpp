#include "table/health/prospects.h"

#include <algorithm>
#include <random>

#include "brdf/model/evaluate.h"
#include "support.h"
#include "table/example.h"
#include "tables.h"

namespace gonio {
namespace {

using namespace test;

Verdict verdict(const Table& t, const std::string& of) {
  const Health h = inspect(t);
  const auto found = std::ranges::find(h.prospects, of, &Prospect::of);
  if (found == h.prospects.end()) {
    ADD_FAILURE() << "nothing is said of " << of;
    return Verdict::no;
  }
  EXPECT_FALSE(found->because.empty());
  return found->verdict;
}

/// The values of lambert + GGX with f0 = 0.05 at the table's samples.
Table filled(Table t, double alpha, double kd) {
  const auto model = bind_model("lambert+ggx/smith_ggx.correlated/schlick",
                                {{"alpha", {alpha}}, {"f0", {0.05}}, {"kd", {kd}}}, 1);
  t.format = "csv";
  t.channels = {"f"};
  test::put_values(t, model);
  return t;
}
Table in_out(double alpha, double kd) {
  Table t;
  t.where = mbsdf_grid(45, 90, Bins::centre);
  return filled(std::move(t), alpha, kd);
}
/// Five incident angles in the plane of incidence.
Table in_plane_of(double alpha, double kd, double most_theta_i = 75) {
  DirectionList l;
  for (int k = 0; k < 5; ++k)
    for (double out = -85; out <= 85; out += 1) {
      l.theta_i_deg.push_back(10 + k * (most_theta_i - 10) / 4);
      l.phi_i_deg.push_back(0);
      l.theta_o_deg.push_back(std::abs(out));
      l.phi_o_deg.push_back(out < 0 ? 0 : 180);
    }
  Table t;
  t.where = l;
  return filled(std::move(t), alpha, kd);
}
Table plain_lambertian() {
  return on_grid(mbsdf_grid(20, 20, Bins::centre), "mbsdf", {"f"},
                 [](const auto&, std::size_t) { return 0.2; });
}

TEST(Prospects, OfALambertianTableAreItsAlbedoAlone) {
  for (const char* of : {"alpha", "f0", "fresnel"})
    EXPECT_EQ(verdict(plain_lambertian(), of), Verdict::no);
  EXPECT_EQ(verdict(plain_lambertian(), "kd"), Verdict::yes);
  EXPECT_EQ(verdict(plain_lambertian(), "precision"), Verdict::yes);
}

TEST(Prospects, OfATableOfZerosSayThatItIs) {
  Table t = plain_lambertian();
  std::ranges::fill(t.values[0], 0);
  for (const auto& p : inspect(t).prospects) {
    EXPECT_EQ(p.because.find("nan"), std::string::npos) << p.of << ": " << p.because;
    if (p.of == "alpha") {
      EXPECT_EQ(p.because, "no highlight: all the values are 0");
    }
  }
}

TEST(Prospects, OfAGlossyTableAreAllOfThem) {
  for (const char* of : {"alpha", "f0", "fresnel", "kd", "precision", "intervals"})
    EXPECT_EQ(verdict(in_out(0.1, 0.2), of), Verdict::yes) << of;
}

TEST(Prospects, OfALobeNarrowerThanTheSamplesAreABound) {
  EXPECT_EQ(verdict(in_plane_of(0.001, 0.2), "alpha"), Verdict::weakly);
  EXPECT_EQ(verdict(in_plane_of(0.001, 0.2), "f0"), Verdict::weakly);
  EXPECT_EQ(verdict(in_plane_of(0.1, 0.2), "alpha"), Verdict::yes);
}

TEST(Prospects, OfAVeryRoughLobeAreNoAlphaBySight) {
  EXPECT_EQ(verdict(in_out(0.9, 0.5), "alpha"), Verdict::weakly);
  EXPECT_EQ(verdict(in_out(0.9, 0.5), "kd"), Verdict::weakly);
}

TEST(Prospects, OfABaseThatIsTheLobesTailAreNoAlbedo) {
  EXPECT_EQ(verdict(in_plane_of(0.3, 0), "kd"), Verdict::no);
  EXPECT_EQ(verdict(in_plane_of(0.15, 0.5), "kd"), Verdict::yes);
}

TEST(Prospects, OfFresnelNeedGrazingAngles) {
  EXPECT_EQ(verdict(in_plane_of(0.1, 0.2, 80), "fresnel"), Verdict::yes);
  EXPECT_EQ(verdict(in_plane_of(0.1, 0.2, 60), "fresnel"), Verdict::weakly);
  EXPECT_EQ(verdict(in_plane_of(0.1, 0.2, 45), "fresnel"), Verdict::no);
}

TEST(Prospects, OfIntervalsNeedIncidentAngles) {
  EXPECT_EQ(verdict(in_plane_of(0.1, 0.2), "intervals"), Verdict::weakly);
  EXPECT_EQ(verdict(mbsdf_example(), "intervals"), Verdict::yes);
}

TEST(Prospects, AreDimWhereTheNoiseFloorIsHigherThanTheBase) {
  Table t = in_out(0.1, 0.001);
  std::mt19937_64 random(1);
  std::normal_distribution<double> z;
  for (double& v : t.values[0]) v += 0.01 * z(random);
  EXPECT_EQ(verdict(t, "alpha"), Verdict::yes);
  EXPECT_NE(verdict(t, "kd"), Verdict::yes);
  EXPECT_NE(verdict(t, "precision"), Verdict::yes);
}

TEST(Prospects, OfNoiseShowNoHighlight) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6, 7, 8}) {
    Table t = in_plane_of(0.3, 0.3);
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    for (double& f : t.values[0]) f = 0.1 + 0.05 * normal(random);
    EXPECT_NE(verdict(t, "alpha"), Verdict::yes) << seed;
    EXPECT_FALSE(inspect(t).retro) << seed;
  }
}

TEST(Prospects, OfATableWithoutAValidValueAreNone) {
  Table t = plain_lambertian();
  for (double& v : t.values[0]) v = -1;
  const auto h = inspect(t);
  ASSERT_EQ(h.prospects.size(), 1U);
  EXPECT_EQ(h.prospects[0].verdict, Verdict::no);
}

}  // namespace
}  // namespace gonio
