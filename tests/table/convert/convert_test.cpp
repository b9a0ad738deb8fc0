// A table in another layout: what is kept exactly, what is lost, and that the figures of it are
// true.
#include "table/convert/convert.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/quantile.h"
#include "refusal.h"
#include "support.h"
#include "table/example.h"

namespace gonio {
namespace {

using namespace test;

ConvertOptions to(const std::string& format) {
  ConvertOptions o;
  o.format = format;
  return o;
}

bool same_bits(const Values& a, const Values& b) {
  return std::ranges::equal(
      a, b, [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

/// A wide lobe, so that 4° bins can hold it.
Table wide_mbsdf(std::size_t n_theta = 45, std::size_t n_phi = 90) {
  return on_grid(mbsdf_grid(n_theta, n_phi, Bins::centre), "mbsdf", {"f"},
                 [](const auto& a, std::size_t) { return lobe(a, 0.5, 0.3); });
}
/// One channel: a bin costs its time three times over otherwise.
Table wide_merl(double alpha = 0.5, Bins bins = Bins::centre) {
  return on_grid(merl_grid(bins), "merl", {"f"},
                 [&](const auto& a, std::size_t) { return lobe(a, alpha, 0.1); });
}

TEST(Convert, CopiesTheSameLayoutValueForValue) {
  Table t = merl_example(0.2, Bins::edge);
  t.values[1][77] = -1;
  t.truth = truth_example();
  const auto [back, loss] = convert(t, to("merl"));
  EXPECT_EQ(loss.method, Loss::Method::copied);
  EXPECT_TRUE(*back.grid() == *t.grid());
  for (std::size_t c = 0; c < 3; ++c) EXPECT_TRUE(same_bits(back.values[c], t.values[c]));
  EXPECT_EQ(loss.rms, 0);
  EXPECT_EQ(loss.lost, 0U);
  EXPECT_TRUE(back.truth);
  const Table slice = slice_example();
  EXPECT_TRUE(*convert(slice, to("exr")).table.grid() == *slice.grid())
      << "its sizes and phi_d too";
  EXPECT_EQ(convert(merl_example(0.2, Bins::centre, false), to("merl")).loss.method,
            Loss::Method::copied);
}

TEST(Convert, SaysTrulyWhatGoingThereAndBackCosts) {
  const Table t = wide_merl();
  const auto there = convert(t, to("mbsdf"));
  EXPECT_EQ(there.loss.method, Loss::Method::interpolated);
  EXPECT_LT(there.loss.rms, 0.04);
  EXPECT_FALSE(there.table.truth);
  const Table back = convert(there.table, to("merl")).table;
  const SampleAngles at(t);
  double squares = 0, largest = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const auto a = at(i);
    if (mask(a, 1) != Mask::valid) continue;
    const double truth = lobe(a, 0.5, 0.1), v = back.values[0][i];
    ASSERT_GT(v, 0);
    const double d = 2 * std::abs(v - truth) / (v + truth);
    squares += d * d;
    largest = std::max(largest, d);
    ++count;
  }
  EXPECT_EQ(there.loss.compared, count);
  EXPECT_NEAR(there.loss.rms, std::sqrt(squares / static_cast<double>(count)), 1e-6);
  EXPECT_NEAR(there.loss.largest, largest, 1e-4);
}

TEST(Convert, InterpolatesToTheModelItself) {
  const Table t = wide_merl(), fine = convert(t, to("mbsdf")).table;
  const SampleAngles at(fine);
  std::vector<double> off;
  for (std::size_t i = 0; i < fine.size(); ++i)
    off.push_back(std::abs(fine.values[0][i] / lobe(at(i), 0.5, 0.1) - 1));
  EXPECT_LT(median(off), 1e-3);
  EXPECT_LT(quantile(off, 0.99), 0.01);
}

TEST(Convert, TurnsOneBinConventionIntoTheOther) {
  const Table edge = wide_merl(0.3, Bins::edge);
  auto o = to("merl");
  o.bins = Bins::centre;
  const auto [centre, loss] = convert(edge, o);
  EXPECT_EQ(loss.method, Loss::Method::interpolated);
  const SampleAngles at(centre);
  std::vector<double> off;
  for (std::size_t i = 0; i < centre.size(); i += 7)
    if (mask(at(i), centre.values[0][i]) == Mask::valid)
      off.push_back(std::abs(centre.values[0][i] / lobe(at(i), 0.3, 0.1) - 1));
  EXPECT_LT(quantile(off, 0.95), 0.01);
}

TEST(Convert, KeepsMaskedRegionsMasked) {
  Table t = wide_merl();
  std::size_t removed = 0;
  for (std::size_t i = 0; i < t.size(); ++i)
    if (const auto theta_d = t.grid()->unravel(i)[1]; theta_d >= 30 && theta_d < 50) {
      t.values[0][i] = -1;
      ++removed;
    }
  const auto there = convert(t, to("mbsdf"));
  EXPECT_GT(there.loss.without_data, 20'000U);
  EXPECT_TRUE(std::ranges::none_of(there.table.values[0], [](double v) { return v <= 0; }))
      << "never black, never a mark that reads as noise";
  const Table back = convert(there.table, to("merl")).table;
  EXPECT_FALSE(back.negative_is_noise);
  std::size_t filled = 0, marked = 0;
  const SampleAngles at(t);
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (mask(at(i), 1) != Mask::valid) continue;
    if (t.values[0][i] < 0) filled += back.values[0][i] > 0;
    marked += back.values[0][i] == -1;
  }
  EXPECT_LT(filled * 20, removed) << "a bin or so at the edge of the hole";
  EXPECT_GT(marked, removed / 3);
}

TEST(Convert, GoesThroughAListWithoutLoss) {
  const Folder folder;
  Table t = mbsdf_example();
  t.values[1][100] = std::nan("");
  auto list = convert(t, to("csv"));
  EXPECT_EQ(list.loss.method, Loss::Method::listed);
  EXPECT_EQ(list.loss.left_out, 0U);
  write_table(list.table, folder / "t.csv");
  auto o = to("mbsdf");
  o.n_theta = 12;
  o.n_phi = 19;
  const auto back = convert(read_table(folder / "t.csv"), o);
  EXPECT_EQ(back.loss.nearest, 0U);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_TRUE(same_bits(back.table.values[c], t.values[c]));
  EXPECT_NEAR(back.loss.rms, 0, 1e-9);
}

TEST(Convert, LeavesBinsBelowTheHorizonOutOfAList) {
  const Table t = on_grid(image_slice_grid(90, 90, 45 * degree, Bins::centre), "exr", {"f"},
                          [](const auto& a, std::size_t) { return lobe(a, 0.5, 0.1); });
  const auto [list, loss] = convert(t, to("csv"));
  EXPECT_GT(loss.left_out, 1000U);
  EXPECT_EQ(list.size() + loss.left_out, t.size());
  EXPECT_EQ(list.size(), loss.bins);
  auto o = to("exr");
  o.phi_d_deg = 45;
  const auto back = convert(list, o);
  EXPECT_EQ(back.loss.without_data, 0U);
  const SampleAngles at(t);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < t.size(); ++i)
    wrong += mask(at(i), 1) == Mask::valid &&
             std::abs(back.table.values[0][i] / t.values[0][i] - 1) > 1e-7;
  EXPECT_EQ(wrong, 0U);
}

TEST(Convert, RefusesAListThatReachesTooFewBins) {
  Table t = csv_example();
  t.path = "some.csv";
  t.channels = {"f"};
  t.values.resize(1);
  EXPECT_HAS(refusal([&] { convert(t, to("mbsdf")); }),
             "some.csv: converting: found samples within 2° of");
}

/// Relative error of a table of lobe(…, 0.5, 0.3), in the middle.
double median_error(const Table& t) {
  const SampleAngles at(t);
  std::vector<double> off;
  for (std::size_t i = 0; i < t.size(); ++i)
    if (mask(at(i), t.values[0][i]) == Mask::valid)
      off.push_back(std::abs(t.values[0][i] / lobe(at(i), 0.5, 0.3) - 1));
  return median(off);
}

TEST(Convert, FillsEmptyBinsFromTheNearestSampleWithinReachAlone) {
  // Every 6° in the angles that 45 × 45 × 31 bins take every 2°.
  const Table coarse = convert(wide_mbsdf(15, 31), to("csv")).table;
  auto o = to("mbsdf");
  o.n_phi = 31;
  o.reach_deg = 3;
  const auto [t, loss] = convert(coarse, o);
  EXPECT_GT(loss.nearest, loss.bins / 2);
  EXPECT_LT(loss.without_data, loss.bins / 10);
  EXPECT_LT(loss.rms, 0.1);
  EXPECT_LT(median_error(t), 0.05);
  o.reach_deg = 0.5;
  EXPECT_THROW(convert(coarse, o), Error);
}

TEST(Convert, TakesASideThatWasNotMeasuredFromItsMirrorImage) {
  const Table whole = convert(wide_mbsdf(30, 46), to("csv")).table;
  const auto& l = *whole.list();
  Table half = whole;
  DirectionList kept;
  half.values[0].clear();
  for (std::size_t i = 0; i < whole.size(); ++i) {
    if (l.theta_i_deg[i] <= l.theta_o_deg[i]) continue;  // phi_d below 90° alone
    kept.theta_i_deg.push_back(l.theta_i_deg[i]);
    kept.phi_i_deg.push_back(l.phi_i_deg[i]);
    kept.theta_o_deg.push_back(l.theta_o_deg[i]);
    kept.phi_o_deg.push_back(l.phi_o_deg[i]);
    half.values[0].push_back(whole.values[0][i]);
  }
  half.where = kept;
  auto o = to("exr");
  o.phi_d_deg = 120;
  o.reach_deg = 4;
  const auto [slice, loss] = convert(half, o);
  EXPECT_LT(loss.without_data * 10, loss.bins);
  EXPECT_LT(median_error(slice), 0.05);
}

TEST(Convert, SaysHowFarTheTwoSidesAndTheTwoWaysDiffer) {
  Table sides = wide_merl();
  for (std::size_t i = 0; i < sides.size(); ++i)
    for (auto& plane : sides.values) plane[i] = sides.grid()->unravel(i)[2] < 90 ? 1 : 3;
  const auto a = convert(sides, to("mbsdf"));
  ASSERT_TRUE(a.loss.mirror);
  EXPECT_NEAR(*a.loss.mirror, 1, 1e-6) << "2 (3 − 1)/(3 + 1)";
  EXPECT_FALSE(a.loss.reciprocity);
  std::vector<double> values(a.table.values[0].begin(), a.table.values[0].end());
  EXPECT_EQ(median(values), 2);

  Table ways = wide_mbsdf();
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const auto at = ways.grid()->unravel(i);
    ways.values[0][i] = at[0] < at[1] ? 1 : 3;
  }
  const auto b = convert(ways, to("merl"));
  ASSERT_TRUE(b.loss.reciprocity);
  EXPECT_NEAR(*b.loss.reciprocity, 1, 1e-6);
  EXPECT_FALSE(b.loss.mirror);
}

TEST(Convert, AsksAListThatKnowsItsValuesEverywhere) {
  Table t = csv_example();  // 50 samples
  t.between = [](const DirectionPair& p, std::size_t c) {
    return lobe(angles(p), 0.5, 0.1 * static_cast<double>(c + 1));
  };
  auto o = to("mbsdf");
  o.channels = {"532nm"};
  const auto [grid, loss] = convert(t, o);
  EXPECT_EQ(loss.method, Loss::Method::interpolated);
  EXPECT_EQ(loss.without_data, 0U);
  EXPECT_NEAR(loss.mirror.value(), 0, 1e-12);
  const SampleAngles at(grid);
  for (std::size_t i = 0; i < grid.size(); i += 101)
    EXPECT_NEAR(grid.values[0][i] / lobe(at(i), 0.5, 0.2), 1, 1e-6) << "the second channel";
  EXPECT_FALSE(convert(t, to("csv")).table.between) << "CSV holds samples alone";
}

TEST(Convert, TellsWhatBecomesOfChannelsAndWeights) {
  Table t = wide_mbsdf(6, 7);
  t.channels = {"400", "500", "600", "700"};
  t.values.assign(4, t.values[0]);
  for (std::size_t c = 0; c < 4; ++c)
    for (double& v : t.values[c]) v *= static_cast<double>(c + 1);
  EXPECT_THROW(convert(t, to("mbsdf")), Error);
  EXPECT_EQ(convert(t, to("csv")).table.channels.size(), 4U);
  auto o = to("mbsdf");
  o.channels = {"700", "500", "400"};
  const auto three = convert(t, o);
  EXPECT_EQ(three.loss.dropped, std::vector<std::string>{"600"});
  EXPECT_EQ(three.loss.renamed, o.channels);
  EXPECT_EQ(three.table.channels, (std::vector<std::string>{"r", "g", "b"}));
  EXPECT_NEAR(three.table.values[0][5] / t.values[3][5], 1, 1e-6);
  EXPECT_TRUE(three.loss.rounded);
  EXPECT_LT(three.loss.largest, 1e-7);
  o.channels = {"700"};
  o.format = "merl";
  EXPECT_TRUE(convert(t, o).loss.replicated);
  for (const auto& wrong : {std::vector<std::string>{"900"}, {"400", "400", "500"}}) {
    o.channels = wrong;
    EXPECT_THROW(convert(t, o), Error);
  }
  Table list = csv_example();
  EXPECT_EQ(convert(list, to("csv")).table.weights, list.weights);
  EXPECT_FALSE(convert(list, to("csv")).loss.weights_dropped);
}

TEST(Convert, MakesAUtiaTableOfAGridAndTakesItBack) {
  Table t = wide_mbsdf();
  const auto [utia, loss] = convert(t, to("utia"));
  EXPECT_EQ(loss.method, Loss::Method::interpolated);
  EXPECT_TRUE(loss.replicated);
  EXPECT_FALSE(loss.mirror) << "UTIA's has a value for φ and one for −φ";
  EXPECT_FALSE(loss.reciprocity);
  EXPECT_EQ(loss.bins, 241U * 241U);
  EXPECT_GT(loss.lost, 0U) << "beyond 75° nothing comes back";
  const SampleAngles at(utia);
  double largest = 0;
  for (std::size_t i = 0; i < utia.size(); ++i)
    largest = std::max(largest, std::abs(utia.values[0][i] / lobe(at(i), 0.5, 0.3) - 1));
  EXPECT_LT(largest, 0.02) << "2° bins of a wide lobe, read between";
  const Folder folder;
  write_table(utia, folder / "m.bin");
  EXPECT_EQ(read_table(folder / "m.bin").values[1], utia.values[0]);
  const auto again = convert(read_table(folder / "m.bin"), to("utia"));
  EXPECT_EQ(again.loss.method, Loss::Method::copied);
  EXPECT_EQ(again.loss.largest, 0);
  const auto list = convert(again.table, to("csv")).table;
  EXPECT_EQ(convert(list, to("utia")).loss.method, Loss::Method::copied) << "the same directions";
  const auto mbsdf = convert(again.table, to("mbsdf"));
  EXPECT_EQ(mbsdf.loss.method, Loss::Method::interpolated);
  EXPECT_TRUE(mbsdf.loss.mirror);
}

TEST(Convert, MakesNoUtiaTableOfAListThatSaysNothingBetweenItsSamples) {
  Table t = csv_example();
  t.path = "t.csv";
  t.channels.pop_back();
  t.values.pop_back();
  EXPECT_HAS(refusal([&] { convert(t, to("utia")); }),
             "t.csv: converting: found a list of other directions than UTIA's");
}

TEST(Convert, MakesNoImageThatNobodyReads) {
  Table t = csv_example();
  t.values.assign(2072, t.values[0]);
  t.channels.clear();
  for (int c = 0; c < 2072; ++c) t.channels.push_back(std::to_string(c));
  EXPECT_HAS(refusal([&] { convert(t, to("exr")); }, Exit::usage),
             "90 × 90 pixels and 2072 channels has more than 16777216 values");
}

TEST(Convert, CutsASliceAndTakesItForTheWhole) {
  const Table t = wide_merl();
  auto o = to("exr");
  o.phi_d_deg = 45;
  const auto [slice, loss] = convert(t, o);
  EXPECT_NEAR(slice.grid()->axes[2].span / degree, 45, 1e-12);
  const SampleAngles at(slice);
  std::vector<double> off;
  for (std::size_t i = 0; i < slice.size(); ++i)
    if (mask(at(i), slice.values[0][i]) == Mask::valid)
      off.push_back(std::abs(slice.values[0][i] / lobe(at(i), 0.5, 0.1) - 1));
  EXPECT_GT(off.size(), 5000U);
  EXPECT_LT(quantile(off, 0.99), 0.01);
  EXPECT_FALSE(loss.one_phi_d);
  EXPECT_TRUE(convert(slice, to("merl")).loss.one_phi_d);
}

}  // namespace
}  // namespace gonio
