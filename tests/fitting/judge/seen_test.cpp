// A fit says no more of a table than the table shows without a model.
#include "fitting/judge/seen.h"

#include <cmath>
#include <fstream>
#include <sstream>

#include "fitting/fit.h"
#include "fitting/support.h"
#include "support.h"
#include "table/format/formats.h"
#include "table/health/computed.h"
#include "table/health/health.h"
#include "table/health/peak.h"
#include "tables.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

using test::parameter;
constexpr const char* paint = "lambert+ggx/smith_ggx.correlated/schlick";

const Prospect& prospect(const Health& h, std::string_view of) {
  return *std::ranges::find(h.prospects, of, &Prospect::of);
}

TEST(Seen, NothingIsKnownOfAChannelOfZeros) {
  Table t = synthesize(test::bind(paint, "alpha=0.3,f0=0.05,kd=0.2", 3),
                       {.layout = Layout::random, .samples = 200, .noise = 0.02});
  std::ranges::fill(t.values[2], 0);
  const auto d = fit(t, {}).document;
  for (const char* name : {"kd", "f0"}) {
    const auto& p = parameter(d, name);
    EXPECT_EQ(p.status[1], ParameterStatus::free);
    EXPECT_EQ(p.status[2], ParameterStatus::not_identifiable);
    EXPECT_TRUE(std::isnan(p.value[2]));
    EXPECT_EQ(p.reason[2], "no value of its channel can be used");
  }
}

/// Values by outgoing angle in the plane of incidence, at some incident angles.
template <class Value>
Table in_plane(const std::vector<double>& incident, double step, Value&& value) {
  Table t;
  t.format = "csv";
  t.channels = {"f"};
  DirectionList l;
  std::vector<double> values;
  for (const double in : incident)
    for (double out = -80; out <= 80; out += step) {
      l.theta_i_deg.push_back(in);
      l.phi_i_deg.push_back(0);
      l.theta_o_deg.push_back(std::abs(out));
      l.phi_o_deg.push_back(out > 0 ? 180 : 0);
      values.push_back(value(in, out));
    }
  t.where = std::move(l);
  t.values.emplace_back(values.size());
  std::ranges::copy(values, t.values[0].begin());
  return t;
}

TEST(Seen, OneConstantForEachIncidentAngleIsAComputedTableAndShowsNoLobe) {
  const auto constant = [](double in, double) { return 0.15 + 0.0006 * in; };
  const Table t = in_plane({0, 20, 40, 60}, 2, constant);
  EXPECT_TRUE(one_value_per_angle(t));
  const Health h = inspect(t);
  for (const char* of : {"alpha", "f0", "fresnel"}) EXPECT_EQ(prospect(h, of).verdict, Verdict::no);
  FitOptions o;
  o.model = paint;
  const auto d = fit(t, o).document;
  for (const char* name : {"alpha", "f0"}) {
    EXPECT_EQ(parameter(d, name).status[0], ParameterStatus::not_identifiable) << name;
    EXPECT_FALSE(parameter(d, name).reason[0].empty()) << name;
  }
  EXPECT_FALSE(std::isnan(parameter(d, "kd").value[0]));
  // Not so: noise, the same constant everywhere, too few of each.
  EXPECT_FALSE(one_value_per_angle(in_plane({0, 20, 40, 60}, 2, [&](double in, double out) {
    return constant(in, out) * (1 + 0.01 * std::sin(50 * out));
  })));
  EXPECT_FALSE(
      one_value_per_angle(in_plane({0, 20, 40, 60}, 2, [](double, double) { return 0.2; })));
  EXPECT_FALSE(one_value_per_angle(in_plane({0, 20, 40, 60}, 40, constant)));
}

TEST(Seen, RowsThatAreRepeatedAreNoComputedTable) {
  // One outgoing direction at each incident angle, eight rows of it; and eight of them.
  Table t =
      in_plane({0, 10, 20, 30, 40, 50, 60, 70}, 20, [](double in, double) { return 0.1 + in; });
  DirectionList l = *t.list();
  EXPECT_TRUE(one_value_per_angle(t));
  for (std::size_t i = 0; i < t.size(); ++i) {
    l.theta_o_deg[i] = l.theta_i_deg[i];
    l.phi_o_deg[i] = 180;
  }
  t.where = l;
  EXPECT_FALSE(one_value_per_angle(t));
}

TEST(Seen, OutliersAreNoHighlightAtTheRetroDirection) {
  for (const std::uint64_t seed : {1001U, 1002U, 1010U}) {
    const Table t =
        synthesize(test::bind(paint, "alpha=0.2,f0=0.05,kd=0.2", 3),
                   {.layout = Layout::in_plane, .noise = 0.02, .outliers = 0.2, .seed = seed});
    EXPECT_FALSE(TableFacts(t).retro()) << seed;
    FitOptions o;
    o.model = paint;
    o.robust = true;
    EXPECT_FALSE(std::isnan(parameter(fit(t, o).document, "f0").value[0])) << seed;
  }
}

/// Lobes around wo = wi and around the mirror direction.
Table two_highlights(double mirror) {
  return in_plane({10, 30, 50}, 0.25, [&](double in, double out) {
    const auto lobe = [](double from, double width) {
      return std::exp(-from * from / width / width);
    };
    return 0.1 + 10 * lobe(out + in, 1) + mirror * lobe(out - in, 2);
  });
}

TEST(Seen, OfTwoHighlightsBothAreToldAndF0IsNotThatOfTheSmaller) {
  const Health h = inspect(two_highlights(3));
  ASSERT_TRUE(h.retro);
  ASSERT_TRUE(h.peak);
  EXPECT_EQ(prospect(h, "alpha").verdict, Verdict::weakly);
  EXPECT_EQ(prospect(h, "f0").verdict, Verdict::no);
  EXPECT_EQ(prospect(inspect(two_highlights(0)), "alpha").verdict, Verdict::no);
  FitOptions o;
  o.model = paint;
  const auto d = fit(two_highlights(3), o).document;
  EXPECT_EQ(parameter(d, "f0").status[0], ParameterStatus::not_identifiable);
  EXPECT_FALSE(parameter(d, "f0").reason[0].empty());
}

TEST(Seen, AMeasuredHighlightThatIsNotResolvedHasAWidthAtMost) {
  const auto truth = test::bind(paint, "alpha=0.01,f0=0.5,kd=0.1", 1);
  Table t = in_plane({10, 30, 50}, 2, [](double, double) { return 0.0; });
  test::put_values(t, truth);
  for (std::size_t i = 0; i < t.size(); ++i)
    t.values[0][i] *= std::exp(0.01 * std::sin(static_cast<double>(7 * i * i)));
  const auto h = inspect(t);
  ASSERT_TRUE(h.peak && !h.peak->resolved);
  FitOptions o;
  o.model = paint;
  const FittedParameter measured = parameter(fit(t, o).document, "alpha");
  EXPECT_EQ(measured.status[0], ParameterStatus::upper_limit);
  EXPECT_EQ(measured.limit[0], h.peak->alpha);
  EXPECT_TRUE(std::isnan(measured.excluded[0])) << "the value does not contradict it";
  EXPECT_TRUE(std::isnan(measured.std_error[0]));
  t.truth = Truth{};  // points that no instrument has widened
  EXPECT_EQ(parameter(fit(t, o).document, "alpha").status[0], ParameterStatus::free);
}

TEST(Seen, OfUnlikeLobesTheNarrowestIsTheOneThatIsNotResolved) {
  const char* two = "lambert+gtr/smith_ggx.correlated/schlick+ggx/smith_ggx.correlated/schlick";
  const auto truth = test::bind(two, "alpha=0.08,gamma=2,f0=0.05,alpha_2=0.01,f0_2=0.3,kd=0.1", 1);
  Table t = in_plane({10, 25, 40, 55, 70}, 2, [](double, double) { return 0.0; });
  test::put_values(t, truth);
  ASSERT_TRUE(inspect(t).peak && !inspect(t).peak->resolved);
  FitOptions o;
  o.model = two;
  o.fixed = parse_settings(std::vector<std::string>{"gamma=2"});
  const auto d = fit(t, o).document;
  EXPECT_NE(parameter(d, "alpha").status[0], ParameterStatus::upper_limit);
  EXPECT_EQ(parameter(d, "alpha_2").status[0], ParameterStatus::upper_limit);
}

TEST(Klems2011SA1, IsAComputedTable) {
  GONIO_NEEDS_SHARED(file, "data/klems/2011-SA1.xml");
  const Table t = read_table(file);
  EXPECT_TRUE(one_value_per_angle(t));
  const auto d = fit(t, {}).document;
  EXPECT_TRUE(std::isnan(parameter(d, "f0").value[0]));
}

TEST(RetroSheet, HasTwoHighlights) {
  GONIO_NEEDS_SHARED(file, "data/alta_retro/retro-3M-jaune.dat");
  const Table t = read_table(file);
  const auto h = inspect(t);
  EXPECT_EQ(prospect(h, "alpha").verdict, Verdict::weakly) << prospect(h, "alpha").because;
  EXPECT_EQ(prospect(h, "f0").verdict, Verdict::no);
  EXPECT_TRUE(std::isnan(parameter(fit(t, {}).document, "f0").value[0]));
}

TEST(StarlinkChassis, IsAsNarrowAsInspectSays) {
  GONIO_NEEDS_SHARED(file, "data/starlink/chassis_brdf.csv");
  Table t;
  t.format = "csv";
  t.channels = {"f"};
  DirectionList l;
  std::vector<double> values;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    double theta_i, phi_i, theta_o, phi_o, f;
    if (!(words >> theta_i >> phi_i >> theta_o >> phi_o >> f)) continue;
    l.theta_i_deg.push_back(theta_i);
    l.phi_i_deg.push_back(phi_i);
    l.theta_o_deg.push_back(theta_o);
    l.phi_o_deg.push_back(phi_o);
    values.push_back(f);
  }
  ASSERT_EQ(values.size(), 724U);
  t.where = std::move(l);
  t.values.emplace_back(values.size());
  std::ranges::copy(values, t.values[0].begin());
  const auto h = inspect(t);
  const auto d = fit(t, {}).document;
  EXPECT_EQ(parameter(d, "alpha").status[0], ParameterStatus::upper_limit);
  EXPECT_EQ(parameter(d, "alpha").limit[0], h.peak->alpha);
  EXPECT_NEAR(h.peak->alpha, 0.0137, 0.0001);
  EXPECT_TRUE(std::isnan(parameter(d, "alpha").value[0]));
  EXPECT_NEAR(parameter(d, "alpha").excluded[0], 0.0318, 0.0001) << "where the fit ended";
  EXPECT_NEAR(parameter(d, "roughness").excluded[0], 0.178, 0.001);
}

}  // namespace
}  // namespace gonio
