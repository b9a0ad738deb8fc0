#include "reports/yardstick/by_hand.h"

#include <random>

#include "brdf/model/evaluate.h"
#include "brdf/model/model.h"
#include "brdf/terms.h"

namespace gonio {
namespace {

template <class F>
void expect_agreement(double relative) {
  const auto rows = test::random_angles(1000, 21);
  const auto x = test::columns<F>(rows);
  for (const auto& set : instruction_sets()) {
    ASSERT_FALSE(by_hand<F>(set).models.empty()) << set;
    for (const auto& hand : by_hand<F>(set).models) {
      // Each value another, so that none can stand in another's place.
      std::mt19937_64 random(22);
      BoundModel b{compose(hand.spec, hand.channels), {}, {}};
      for (std::size_t i = 0; i < b.model.value_count; ++i)
        b.values.push_back(std::uniform_real_distribution(0.2, 0.6)(random));
      for (const auto& p : b.model.parameters)
        for (std::size_t c = 0; c < p.count; ++c) {
          double& v = b.values[p.first + c];
          if (p.name == "gamma") v = 1.7;
          if (p.name == "tangent") v = 0;  // by hand nothing is turned
          if (p.name == "f0_2") v = 0.04;  // of a coat, one for all channels
        }
      const std::vector<F> values(b.values.begin(), b.values.end());
      std::vector<Column<F>> columns;
      std::vector<F*> one, other;
      for (std::size_t c = 0; c < hand.channels; ++c) {
        one.push_back(columns.emplace_back(x.padded()).data());
        other.push_back(columns.emplace_back(x.padded()).data());
      }
      hand.value(x.block(), values.data(), one.data());
      evaluate<F>(b.model, values, x.block(), other, kernels<F>(set));
      for (std::size_t c = 0; c < hand.channels; ++c)
        for (std::size_t i = 0; i < rows.size(); ++i)
          EXPECT_NEAR(one[c][i], other[c][i], relative * static_cast<double>(other[c][i]) + 1e-30)
              << set << " " << hand.spec;
    }
  }
}

TEST(ModelsByHand, AreTheModelsThatTheyAreMeasuredAgainst) {
  expect_agreement<double>(1e-9);
  expect_agreement<float>(1e-3);
}

}  // namespace
}  // namespace gonio
