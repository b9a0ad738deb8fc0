#include "brdf/by_hand.h"

#include "brdf/evaluate.h"
#include "brdf/model.h"
#include "brdf/terms.h"

namespace gonio {
namespace {

template <class F>
void expect_agreement(double relative) {
  const auto rows = test::random_angles(1000, 21);
  const auto x = test::columns<F>(rows);
  for (const auto& set : instruction_sets()) {
    ASSERT_FALSE(hand_written<F>(set).empty()) << set;
    for (const auto& hand : hand_written<F>(set)) {
      auto b = bind_model(hand.spec, {{"roughness", {0.6}}}, hand.channels);
      if (const auto* gamma = b.model.find("gamma_2")) b.values[gamma->first] = 1;
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
