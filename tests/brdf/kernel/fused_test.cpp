// Whole models in one loop are the same models by columns; here one that no table of fused models
// has, with two lobes, a frame and a diffuse term under the first.
#include "brdf/kernel/fused.h"

#include <numeric>

#include "brdf/formula/diffuse.h"
#include "brdf/formula/masking.h"
#include "brdf/formula/ndf_anisotropic.h"
#include "brdf/formula/ndf_ggx.h"
#include "brdf/model/derivatives.h"
#include "brdf/terms.h"
#include "optics/fresnel_approximate.h"

namespace gonio {
namespace {

using TwoLobes = ModelTerms<TermList<LambertCoupled>,
                            TermList<GgxAniso, SmithGgxAnisoCorrelated, Schlick>,
                            TermList<Ggx, SmithGgxCorrelated, Schlick>>;
constexpr auto spec =
    "lambert.coupled+ggx_aniso/smith_ggx_aniso.correlated/schlick+ggx/smith_ggx.correlated/schlick";

class FusedModel : public testing::Test {
 protected:
  FusedModel() : rows_(test::random_angles(300, 5)), x_(test::columns<double>(rows_)) {
    for (const auto& p : model_.parameters) values_.push_back(0.5 * p.about->start);
    values_[model_.tangent()->first] = 20;
    turned_.set(values_);
    const auto terms = terms_of(model_);
    for (std::size_t t = 0; t < terms.size(); ++t) {
      for (std::size_t k = 0; k < terms[t]->parameters.size(); ++k)
        of_terms_[t][k] = values_[slot({t, k})];
      parameters_[t][0] = of_terms_[t].data();
    }
  }
  std::size_t slot(const FusedColumn& c) const {
    if (c.parameter == terms_of(model_)[c.term]->parameters.size()) return model_.tangent()->first;
    return model_.parameters[terms_of(model_)[c.term]->parameters[c.parameter]].slot(0);
  }

  const Model model_ = compose(spec, 1);
  std::vector<double> values_;
  std::vector<test::Row> rows_;
  AngleColumns<double> x_;
  TurnedFrame<double> turned_{model_, kernels<double>()};
  std::array<std::array<double, max_parameters>, max_fused_terms> of_terms_{};
  FusedParameters<double> parameters_{};
};

TEST_F(FusedModel, OfTwoLobesAndAFrameHasTheValueOfItsColumns) {
  Column<double> fused(x_.padded()), composed(x_.padded());
  Fused<double, TwoLobes>::value<1>({turned_(x_.block()), parameters_, {fused.data()}});
  double* const out = composed.data();
  evaluate<double>(model_, values_, x_.block(), {&out, 1});
  for (std::size_t i = 0; i < rows_.size(); ++i) EXPECT_DOUBLE_EQ(fused[i], composed[i]);
}

TEST_F(FusedModel, OfTwoLobesAndAFrameHasTheNormalEquationsOfItsColumns) {
  using Normal = FusedNormal<double, TwoLobes>;
  EXPECT_EQ(Normal::K, 1 + model_.value_count);
  Column<double> target(x_.padded(), std::log(0.2)), weight(x_.padded(), 0);
  for (std::size_t i = 0; i < rows_.size(); ++i) weight[i] = static_cast<double>(i % 4);
  constexpr std::size_t entries = Normal::K * (Normal::K + 1) / 2;
  Column<double> sums(entries * padding, 0), cost(padding, 0);
  Normal::pass<Link::log, NormalSums>(NormalArguments<double>{turned_(x_.block()),
                                                              1,
                                                              parameters_,
                                                              {target.data()},
                                                              {weight.data()},
                                                              0.01,
                                                              {sums.data()},
                                                              cost.data()});

  const auto& k = kernels<double>();
  const std::vector<bool> free(model_.value_count, true);
  ModelDerivatives<double> derivatives(model_, free, k);
  derivatives.set(values_);
  double *const link = derivatives.fresh(), *const slope = derivatives.fresh();
  Column<double> expected(entries * padding, 0), expected_cost(padding, 0);
  constexpr std::size_t block = Scratch<double>::block;
  for (std::size_t at = 0; at < x_.padded(); at += block) {
    const auto x = x_.block().part(at, std::min(block, x_.padded() - at));
    derivatives.run(x, [&](std::size_t c) {
      const auto& f = derivatives.channel(c);
      k.link[static_cast<std::size_t>(Link::log)](x.n, f.value, 0.01, link, slope);
      k.residual(x.n, {link, slope, target.data() + at, weight.data() + at,
                       std::numeric_limits<double>::max(), link, slope, expected_cost.data()});
      std::array<const double*, max_columns> j{};
      for (std::size_t column = 0; column + 1 < Normal::K; ++column)
        for (const auto& [of, d] : f.d)
          if (of == slot(Normal::columns()[column])) j[column] = d;
      k.gram[Normal::K](x.n, link, slope, j.data(), expected.data());
    });
  }
  const auto total = [](const Column<double>& lanes, std::size_t entry) {
    return std::accumulate(lanes.data() + entry * padding, lanes.data() + (entry + 1) * padding,
                           0.0);
  };
  EXPECT_NEAR(total(cost, 0), total(expected_cost, 0), 1e-12 * total(expected_cost, 0));
  for (std::size_t e = 0; e < entries; ++e)
    EXPECT_NEAR(total(sums, e), total(expected, e), 1e-11 * total(expected, 0)) << e;
}

}  // namespace
}  // namespace gonio
