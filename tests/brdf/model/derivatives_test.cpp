#include "brdf/model/derivatives.h"

#include <map>

#include "brdf/terms.h"
#include "constants.h"

namespace gonio {
namespace {

using test::eps;

class DerivativesOf : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(
    Models,
    DerivativesOf,
    testing::Values(
        "lambert",
        "ggx/smith_ggx.correlated/schlick",
        "lambert+ggx/smith_ggx.correlated/schlick",
        "lambert.coupled+ggx/smith_ggx.separable/schlick",
        "gtr/smith_ggx.correlated/conductor",
        "lambert+gtr/smith_ggx.separable/dielectric",
        "lambert.coupled+gtr/smith_ggx.correlated/conductor",
        "lambert+ggx/smith_ggx.correlated/schlick+gtr/smith_ggx.separable/schlick",
        "lambert.coupled+ggx/smith_ggx.correlated/dielectric+ggx/smith_ggx.correlated/conductor",
        "lambert+ggx_aniso/smith_ggx_aniso.correlated/schlick",
        "beckmann_aniso/smith_beckmann_aniso.correlated/schlick+shape_invariant/"
        "smith_ggx_aniso.separable/schlick"));

/// Values away from the ends of where a fit may look, so that differences can be taken.
std::vector<double> drawn_parameters(const Model& m, std::mt19937_64& random) {
  std::vector<double> values;
  for (const auto& p : m.parameters)
    for (std::size_t c = 0; c < p.count; ++c) {
      const auto s = test::spread(p.about->fit, 10);
      values.push_back(std::uniform_real_distribution(s[2], s[8])(random));
    }
  return values;
}

/// Results of one block: [channel] its values and, by slot, its derivatives.
struct Result {
  std::vector<double> value;
  std::map<std::size_t, std::vector<double>> d;
};
std::vector<Result> run(const Model& m,
                        std::span<const double> values,
                        const std::vector<bool>& free,
                        std::span<const test::Row> rows,
                        const Kernels<double>& k = kernels<double>()) {
  const auto x = test::columns<double>(rows);
  ModelDerivatives<double> derivatives(m, free, k);
  derivatives.set(values);
  std::vector<Result> results(m.channels);
  derivatives.run(x.block(), [&](std::size_t c) {
    const auto& column = derivatives.channel(c);
    results[c].value.assign(column.value, column.value + rows.size());
    for (const auto& [slot, d] : column.d) {
      EXPECT_FALSE(results[c].d.contains(slot)) << "slot " << slot << " twice";
      results[c].d[slot].assign(d, d + rows.size());
    }
  });
  return results;
}

TEST_P(DerivativesOf, GivesTheValuesOfEvaluate) {
  std::mt19937_64 random(21);
  const auto rows = test::random_angles(200, 22);
  for (const std::size_t channels : {1U, 3U}) {
    BoundModel b{compose(GetParam(), channels), {}, {}};
    b.values = drawn_parameters(b.model, random);
    const auto expected = evaluate(b, rows);
    const auto results = run(b.model, b.values, std::vector<bool>(b.model.value_count, true), rows);
    for (std::size_t c = 0; c < channels; ++c)
      for (std::size_t i = 0; i < rows.size(); ++i)
        EXPECT_NEAR(results[c].value[i], expected[c][i], 32 * eps * (1 + expected[c][i]));
  }
}

TEST_P(DerivativesOf, GivesTheDerivativesOfDifferences) {
  std::mt19937_64 random(23);
  const auto rows = test::random_angles(64, 24);
  for (int trial = 0; trial < 4; ++trial) {
    BoundModel b{compose(GetParam(), 3), {}, {}};
    b.values = drawn_parameters(b.model, random);
    const auto results = run(b.model, b.values, std::vector<bool>(b.model.value_count, true), rows);
    for (const auto& p : b.model.parameters)
      for (std::size_t slot = p.first; slot < p.first + p.count; ++slot)
        for (std::size_t c = 0; c < 3; ++c) {
          ASSERT_EQ(results[c].d.contains(slot), p.slot(c) == slot) << p.name << ", channel " << c;
          if (!results[c].d.contains(slot)) continue;
          const double x = b.values[slot];
          // Where a small step of the parameter is a large one of ln f, a smaller one; of a tangent
          // [°] by the narrowest width.
          double steep = 20;
          for (std::size_t i = 0; i < rows.size(); ++i)
            if (const double f = results[c].value[i]; f > 0)
              steep = std::max(steep, std::abs(x * results[c].d.at(slot)[i] / f));
          const double h = &p == b.model.tangent() ? 1e-5 : 1e-3 * x * 20 / steep;
          const auto at = [&](double v) {
            BoundModel moved = b;
            moved.values[slot] = v;
            return evaluate(moved, rows)[c];
          };
          const auto a0 = at(x - h), a1 = at(x - h / 2), a2 = at(x + h / 2), a3 = at(x + h);
          for (std::size_t i = 0; i < rows.size(); ++i) {
            const double expected = (4 * (a2[i] - a1[i]) / h - (a3[i] - a0[i]) / (2 * h)) / 3;
            EXPECT_NEAR(results[c].d.at(slot)[i], expected,
                        1e-6 * std::abs(expected) + 1e-7 * results[c].value[i] / std::abs(x))
                << p.name << " at " << test::text(rows[i]);
          }
        }
  }
}

TEST_P(DerivativesOf, LeavesOutTheDerivativesOfFixedSlotsAndChangesNoOther) {
  std::mt19937_64 random(25);
  const auto rows = test::random_angles(48, 26);
  const Model m = compose(GetParam(), 3);
  const auto values = drawn_parameters(m, random);
  const auto all = run(m, values, std::vector<bool>(m.value_count, true), rows);
  for (int trial = 0; trial < 8; ++trial) {
    std::vector<bool> free(m.value_count);
    for (std::size_t i = 0; i < free.size(); ++i) free[i] = random() % 2;
    const auto some = run(m, values, free, rows);
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(some[c].value, all[c].value);
      for (const auto& [slot, d] : all[c].d) {
        EXPECT_EQ(some[c].d.contains(slot), free[slot]);
        if (some[c].d.contains(slot)) {
          EXPECT_EQ(some[c].d.at(slot), d);
        }
      }
      for (const auto& [slot, d] : some[c].d) EXPECT_TRUE(all[c].d.contains(slot));
    }
  }
}

TEST_P(DerivativesOf, GivesTheSameInEveryInstructionSet) {
  std::mt19937_64 random(27);
  const auto rows = test::random_angles(256, 28);
  const Model m = compose(GetParam(), 2);
  const auto values = drawn_parameters(m, random);
  const std::vector<bool> free(m.value_count, true);
  const auto scalar = run(m, values, free, rows, kernels<double>("scalar"));
  for (const auto& set : instruction_sets()) {
    const auto lanes = run(m, values, free, rows, kernels<double>(set));
    for (std::size_t c = 0; c < 2; ++c)
      for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_NEAR(lanes[c].value[i], scalar[c].value[i], 1e-13 * std::abs(scalar[c].value[i]))
            << set;
        for (const auto& [slot, d] : scalar[c].d) {
          const double scale = std::abs(d[i]) + scalar[c].value[i] / std::abs(values[slot]);
          EXPECT_NEAR(lanes[c].d.at(slot)[i], d[i], 1e-12 * scale) << set << " " << slot;
        }
      }
  }
}

TEST(ModelDerivatives, SharesAGreyParameterBetweenItsChannels) {
  const std::vector<std::string> grey{"kd"};
  const Model m = compose("lambert+ggx/smith_ggx.correlated/schlick", 3, grey);
  ASSERT_EQ(m.find("kd")->count, 1U);
  ASSERT_EQ(m.find("f0")->count, 3U);
  std::mt19937_64 random(29);
  const auto rows = test::random_angles(16, 30);
  const auto results =
      run(m, drawn_parameters(m, random), std::vector<bool>(m.value_count, true), rows);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_TRUE(results[c].d.contains(m.find("kd")->first));
    EXPECT_EQ(results[c].d.size(), 3U);  // kd, alpha, f0 of the channel
  }
}

TEST(ModelDerivatives, LendsScratchColumnsThatItDoesNotWriteItself) {
  const Model m = compose("lambert.coupled+ggx/smith_ggx.correlated/schlick", 3);
  std::mt19937_64 random(31);
  const auto values = drawn_parameters(m, random);
  const auto rows = test::random_angles(32, 32);
  const auto x = test::columns<double>(rows);
  const std::vector<bool> free(m.value_count, true);
  ModelDerivatives<double> derivatives(m, free, kernels<double>());
  derivatives.set(values);
  double* const mine = derivatives.fresh();
  double* const also_mine = derivatives.fresh();
  EXPECT_NE(mine, also_mine);
  for (std::size_t i = 0; i < 32; ++i) mine[i] = also_mine[i] = 7;
  derivatives.run(x.block(), [&](std::size_t c) {
    EXPECT_NE(derivatives.channel(c).value, mine);
    for (const auto& [slot, d] : derivatives.channel(c).d) EXPECT_TRUE(d != mine && d != also_mine);
  });
  for (std::size_t i = 0; i < 32; ++i) EXPECT_TRUE(mine[i] == 7 && also_mine[i] == 7);
}

}  // namespace
}  // namespace gonio
