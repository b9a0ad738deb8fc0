#include "fitting/choice/cross_validation.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "data_synth/synth.h"
#include "fitting/fit.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

BoundModel paint() {
  return bind_model("lambert+ggx/smith_ggx.correlated/schlick",
                    parse_settings(std::vector<std::string>{"alpha=0.2", "f0=0.05", "kd=0.3"}), 1);
}
Table table_of(Layout layout) {
  BoundModel model = paint();
  if (layout == Layout::merl)
    model =
        bind_model(to_text(model.model.spec),
                   parse_settings(std::vector<std::string>{"alpha=0.2", "f0=0.05", "kd=0.3"}), 3);
  SynthOptions s;
  s.layout = layout;
  return synthesize(model, s);
}
Sampling by_log(const Table& t) {
  return {t, t.bins(), Metric::log, 0, false};
}

TEST(IncidentBlocks, KeepNeighboursTogether) {
  const Table t = table_of(Layout::mbsdf);
  const Blocks b = incident_blocks(by_log(t), 4);
  ASSERT_EQ(b.count, 4U);
  EXPECT_TRUE(b.of_exchanged.empty());
  const SampleAngles at(t);
  std::map<double, std::set<std::uint16_t>> of_angle;
  for (std::size_t i = 0; i < t.size(); ++i) of_angle[at.theta_i(i)].insert(b.of_sample[i]);
  std::uint16_t last = 0;
  std::set<std::uint16_t> met;
  for (const auto& [theta, blocks] : of_angle) {
    ASSERT_EQ(blocks.size(), 1U);
    EXPECT_GE(*blocks.begin(), last);
    last = *blocks.begin();
    met.insert(last);
  }
  EXPECT_EQ(met.size(), 4U);
}

TEST(IncidentBlocks, GoByTheAnglesOfAListInAnyOrder) {
  Table t = table_of(Layout::in_plane);
  auto& list = std::get<DirectionList>(t.where);
  for (auto* column : {&list.theta_i_deg, &list.phi_i_deg, &list.theta_o_deg, &list.phi_o_deg})
    std::ranges::rotate(*column, column->begin() + static_cast<std::ptrdiff_t>(column->size() / 2));
  const Blocks b = incident_blocks(by_log(t), 2);
  ASSERT_EQ(b.count, 2U);
  double most_of_first = 0, least_of_second = 90;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double theta = list.theta_i_deg[i];
    if (b.of_sample[i] == 0)
      most_of_first = std::max(most_of_first, theta);
    else
      least_of_second = std::min(least_of_second, theta);
  }
  EXPECT_LT(most_of_first, least_of_second);
}

TEST(IncidentBlocks, KnowTheSampleWithLightAndViewerExchanged) {
  const Table t = table_of(Layout::merl);
  const Sampling s = by_log(t);
  const Blocks b = incident_blocks(s);
  ASSERT_EQ(b.of_exchanged.size(), t.size());
  std::size_t apart = 0, compared = 0;
  for (std::size_t i = 0; i < t.size(); i += 997) {
    // MERL's last axis is φ_d from 0 to 180°, in 180 bins: exchanged is at 180° − φ_d.
    const std::size_t k = i % 180, other = i - k + 179 - k;
    const auto a = s.angles()(i);
    if (!(a.nol > 0 && a.nov > 0)) continue;
    ++compared;
    EXPECT_EQ(b.of_exchanged[i], b.of_sample[other]) << i;
    apart += b.of_sample[i] != b.of_exchanged[i];
  }
  EXPECT_GT(compared, 500U);
  EXPECT_GT(apart, 0U);
}

TEST(CrossValidation, PredictsAngleByAngleWhatTheRightModelHas) {
  const Table t = table_of(Layout::mbsdf);
  FitOptions o;
  o.model = to_text(paint().model.spec);
  const auto blocks = incident_blocks(by_log(t));
  const auto right = cross_validate(t, pose(t, o), blocks, paint());
  ASSERT_EQ(right.size(), blocks.count);
  for (const auto& b : right) {
    EXPECT_GT(b.values, 500);
    EXPECT_LT(b.rms(), 1e-6);
  }
}

TEST(CrossValidation, DoesNotFitWhatItPredicts) {
  const Table t = table_of(Layout::in_plane);  // so few values that none is passed over
  FitOptions o;
  o.model = "lambert";
  const FitResult whole = fit(t, o);
  LogResiduals unseen;
  const auto blocks = incident_blocks(by_log(t));
  for (const auto& b : cross_validate(t, pose(t, o), blocks, whole.model)) unseen.add(b);
  const auto seen = total(log_residuals(by_log(t), whole.model));
  EXPECT_EQ(unseen.values, seen.values);
  EXPECT_GT(unseen.rms(), 1.01 * seen.rms());
}

}  // namespace
}  // namespace gonio
