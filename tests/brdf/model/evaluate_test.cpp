#include "brdf/model/evaluate.h"

#include "brdf/model/model.h"
#include "brdf/model/presets.h"
#include "brdf/terms.h"
#include "constants.h"

#include <fmt/format.h>

namespace gonio {
namespace {

using test::eps;
using test::pi;

/// One term of a bound model for one channel, by the scalar kernel on its own.
double term(const BoundModel& b, const TermUse& t, std::size_t channel, const test::Row& x) {
  test::Parameters p;
  for (const auto i : t.parameters) p.push_back(b.values[b.model.parameters[i].slot(channel)]);
  return test::value_at(t.term, p, x);
}

/// f_c as model.h writes it.
double by_hand(const BoundModel& b, std::size_t channel, const test::Row& x) {
  double f = 0;
  for (const auto& l : b.model.lobes)
    f += term(b, l.ndf, 0, x) * term(b, l.masking, 0, x) * term(b, l.fresnel, channel, x);
  for (const auto& d : b.model.diffuse) {
    const bool coupled = catalogue()[d.term].coupled;
    const double through = coupled ? 1 - term(b, b.model.lobes[0].fresnel, channel, x) : 1;
    f += through * term(b, d, channel, x);
  }
  return f;
}

/// Lobes in which every term of the catalogue stands beside several others, with a diffuse term and
/// without.
std::vector<std::string> one_lobe_specs() {
  std::array<std::vector<std::string>, 4> names;
  for (const auto& t : catalogue())
    names[static_cast<std::size_t>(role_of(t.about->id))].emplace_back(short_id(t.about->id));
  std::size_t most = 0;
  for (const auto& n : names) most = std::max(most, n.size());
  std::vector<std::string> specs;
  for (std::size_t round = 0; round < 3; ++round)
    for (std::size_t i = 0; i < most; ++i) {
      const auto pick = [&](std::size_t role) {
        return names[role][(i + round * (role + 1)) % names[role].size()];
      };
      specs.push_back(pick(0) + "/" + pick(1) + "/" + pick(2));
      specs.push_back(pick(3) + "+" + specs.back());
    }
  return specs;
}

bool has_shipped_term(const Model& m) {
  return std::ranges::any_of(m.lobes, [](const Lobe& l) {
    return catalogue()[l.ndf.term].as_shipped || catalogue()[l.masking.term].as_shipped;
  });
}

const std::vector<std::string> two_lobe_specs{
    "lambert+ggx/smith_ggx.correlated/schlick+gtr/smith_ggx.separable/schlick",
    "lambert.coupled+ggx/smith_ggx.correlated/dielectric+ggx/smith_ggx.correlated/conductor",
    "gtr/smith_ggx.separable/conductor+gtr/smith_ggx.correlated/dielectric+ggx/smith_ggx.separable/"
    "schlick"};

std::vector<std::string> specs() {
  auto s = one_lobe_specs();
  s.insert(s.end(), two_lobe_specs.begin(), two_lobe_specs.end());
  s.push_back("lambert");
  return s;
}

/// Random values where a fit may look.
BoundModel draw(const std::string& spec, std::size_t channels, std::mt19937_64& random) {
  BoundModel b{compose(spec, channels), {}, {}};
  for (const auto& p : b.model.parameters)
    for (std::size_t c = 0; c < p.count; ++c)
      b.values.push_back(
          std::uniform_real_distribution(p.about->fit.low, p.about->fit.high)(random));
  if (const auto* t = b.model.tangent()) b.values[t->first] = 0;  // terms know of no other azimuth
  return b;
}

TEST(Evaluate, IsTheSumOfTheModelsTerms) {
  std::mt19937_64 random(11);
  const auto rows = test::random_angles(40, 12);
  for (const auto& spec : specs())
    for (const std::size_t channels : {1U, 3U}) {
      const auto b = draw(spec, channels, random);
      const auto f = evaluate(b, rows);
      const bool shipped = has_shipped_term(b.model);
      ASSERT_EQ(f.size(), channels);
      for (std::size_t c = 0; c < channels; ++c)
        for (std::size_t i = 0; i < rows.size(); ++i) {
          const double expected = by_hand(b, c, rows[i]);
          // F (D V − d) + d rounds at D V F + F d where 1 − F is small: the sum's parts are the
          // measure.
          EXPECT_NEAR(f[c][i], expected, (shipped ? 1e-12 : 32 * eps) * (expected + 1 / pi))
              << spec << " " << c;
        }
    }
}

TEST(Evaluate, GivesTheSameInEveryInstructionSetAndInFloat) {
  std::mt19937_64 random(13);
  const auto rows = test::random_angles(300, 14);
  for (const auto& spec : specs()) {
    const auto b = draw(spec, 3, random);
    const auto expected = evaluate(b, rows);
    const auto run = [&]<class F>(F tolerance, const std::string& set) {
      const auto x = test::columns<F>(rows);
      const std::vector<F> values(b.values.begin(), b.values.end());
      std::vector<Column<F>> columns;
      std::vector<F*> out;
      for (int c = 0; c < 3; ++c) out.push_back(columns.emplace_back(x.padded()).data());
      evaluate<F>(b.model, values, x.block(), out, kernels<F>(set));
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < rows.size(); ++i)
          EXPECT_NEAR(out[c][i], expected[c][i],
                      static_cast<double>(tolerance) * (expected[c][i] + 1 / pi))
              << set << " " << spec;
    };
    const bool shipped = has_shipped_term(b.model);
    for (const auto& set : instruction_sets()) {
      run(shipped ? 1e-9 : 1e-12, set);  // what cancels differs with the last bit of an input
      // A narrow peak multiplies the rounding of sin²θ_h to float.
      if (!shipped) run(2e-3F, set);
    }
  }
}

std::string spec_of(const auto& fused) {
  std::string spec;
  const auto& [diffuse, id] = fused.ids;
  for (std::size_t t = 0; t < id.size() && !id[t].empty(); ++t) {
    const bool in_lobe = t > diffuse && (t - diffuse) % 3 != 0;
    spec.append(t == 0 ? "" : in_lobe ? "/" : "+").append(id[t]);
  }
  return spec;
}

TEST(Evaluate, EveryModelAsItShipsIsFused) {
  const auto terms = [](std::string_view spec) {
    const auto m = compose(spec, 3);
    std::vector<std::size_t> all;
    for (const auto& d : m.diffuse) all.push_back(d.term);
    for (const auto& l : m.lobes)
      for (const auto& t : {l.ndf, l.masking, l.fresnel}) all.push_back(t.term);
    return all;
  };
  for (const auto& preset : presets())
    EXPECT_TRUE(std::ranges::any_of(kernels<float>().fused, [&](const auto& f) {
      return terms(spec_of(f)) == terms(preset.spec);
    })) << preset.spec;
}

TEST(Evaluate, FusedEqualsComposed) {
  std::mt19937_64 random(15);
  const auto rows = test::random_angles(300, 16);
  ASSERT_FALSE(kernels<double>().fused.empty());
  const auto check = [&]<class F>(F) {
    constexpr F few = 8 * std::numeric_limits<F>::epsilon();
    for (const auto& set : instruction_sets()) {
      const auto& k = kernels<F>(set);
      auto composed = k;
      composed.fused = {};
      EXPECT_EQ(k.fused.size(), kernels<F>("scalar").fused.size());
      for (const auto& fused : k.fused) {
        const std::string spec = spec_of(fused);
        for (const std::size_t channels : {1UL, 2UL, 3UL}) {
          const auto b = draw(spec, channels, random);
          const std::vector<F> values(b.values.begin(), b.values.end());
          const auto x = test::columns<F>(rows);
          std::vector<Column<F>> one, other;
          std::vector<F*> to_one, to_other;
          for (std::size_t c = 0; c < channels; ++c) {
            to_one.push_back(one.emplace_back(x.padded()).data());
            to_other.push_back(other.emplace_back(x.padded()).data());
          }
          evaluate<F>(b.model, values, x.block(), to_one, k);
          evaluate<F>(b.model, values, x.block(), to_other, composed);
          for (std::size_t c = 0; c < channels; ++c)
            for (std::size_t i = 0; i < x.padded(); ++i)
              EXPECT_NEAR(one[c][i], other[c][i], few * other[c][i]) << set << " " << spec;
        }
      }
    }
  };
  check(1.0);
  check(1.0F);
}

TEST(Evaluate, OfManyChannelsIsThatOfEachByItself) {
  std::mt19937_64 random(19);
  const auto rows = test::random_angles(300, 20);
  for (const std::string spec : {"lambert", "lambert.coupled", "disney"})
    for (const std::size_t channels : {2UL, 3UL, 6UL, 7UL}) {
      const auto all = draw(
          "diffuse." + spec + "+ggx/smith_ggx.correlated/conductor" + "+beckmann/hammon/schlick",
          channels, random);
      const auto together = evaluate(all, rows);
      for (std::size_t c = 0; c < channels; ++c) {
        BoundModel one{compose(to_text(all.model.spec), 1), {}, {}};
        for (const auto& p : all.model.parameters) one.values.push_back(all.values[p.slot(c)]);
        EXPECT_EQ(evaluate(one, rows)[0], together[c]) << spec << " " << channels;
      }
    }
}

TEST(Evaluate, IsTheSameForAColumnOfAnyLength) {
  std::mt19937_64 random(17);
  const auto rows = test::random_angles(1000, 18);
  const auto b = draw("lambert.coupled+gtr/smith_ggx.correlated/conductor", 3, random);
  const auto all = evaluate(b, rows);
  for (const std::size_t n : {0UL, 1UL, 15UL, 16UL, 17UL, 255UL, 256UL, 257UL, 999UL}) {
    const auto some = evaluate(b, {rows.data(), n});
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_EQ(some[c],
                std::vector<double>(all[c].begin(), all[c].begin() + static_cast<long>(n)));
  }
}

TEST(Evaluate, IsZeroBelowTheHorizonAndOnIt) {
  const auto b = bind_model("lambert+ggx/smith_ggx.correlated/schlick", {});
  const std::vector<Angles<double>> rows{{0.5, 0.5, 1, 0.5, 0},
                                         {-0.1, 0.5, 0.5, 0.5, 0.75},
                                         {0.5, 0, 0.5, 0.5, 0.75},
                                         {0.5, std::nan(""), 1, 1, 0}};
  const auto f = evaluate(b, rows);
  EXPECT_GT(f[0][0], 0);
  for (std::size_t i = 1; i < rows.size(); ++i) EXPECT_EQ(f[1][i], 0);
}

TEST(Evaluate, OfATurnedTangentIsThatOfDirectionsTurnedBack) {
  for (const char* spec : {"lambert+ggx_aniso/smith_ggx_aniso.correlated/schlick",  // one loop
                           "disney+beckmann_aniso/smith_beckmann_aniso.correlated/schlick"}) {
    const auto of = [&](double tangent) {
      return bind_model(spec, parse_settings(std::vector<std::string>{
                                  fmt::format("alpha_x=0.5,alpha_y=0.1,tangent={}", tangent)}));
    };
    std::vector<FrameAngles<double>> there, back;
    for (int k = 0; k < 600; ++k) {  // of more than one block
      const double theta = 0.002 * k, phi = 0.7 * k, turn = 33 * degree;
      const auto pair = [&](double by) {
        return frame_angles({direction(0.4, 2 + by), direction(theta, phi + by)});
      };
      there.push_back(pair(turn));
      back.push_back(pair(0));
    }
    const auto turned = evaluate(of(33), there), as_is = evaluate(of(0), back);
    const auto half = evaluate(of(33 - 180), there), other = evaluate(of(0), there);
    double apart = 0;
    for (std::size_t i = 0; i < there.size(); ++i) {
      EXPECT_NEAR(turned[2][i] / as_is[2][i], 1, 1e-12) << spec << i;
      EXPECT_NEAR(half[2][i] / as_is[2][i], 1, 1e-12) << spec << i;
      apart = std::max(apart, std::abs(other[2][i] / as_is[2][i] - 1));
    }
    EXPECT_GT(apart, 0.5);
  }
}

TEST(Evaluate, OfLambertIsItsAlbedoOverPi) {
  const auto b = bind_model("lambert", {{"kd", {0.1, 0.5, 1}}});
  const std::vector<Angles<double>> rows{{0.5, 0.5, 1, 0.5, 0}};
  const auto f = evaluate(b, rows);
  EXPECT_EQ(f[0][0], 0.1 / pi);
  EXPECT_EQ(f[1][0], 0.5 / pi);
  EXPECT_EQ(f[2][0], 1 / pi);
}

TEST(Evaluate, OfACoupledDiffuseKeepsWhatTheInterfaceReflects) {
  // α = 1 at normal incidence: D = 1/π, V = 1/4;  f = F/(4π) + (1 − F) kd/π
  const auto b = bind_model("lambert.coupled+ggx/smith_ggx.correlated/schlick",
                            {{"alpha", {1}}, {"f0", {0, 0.04, 1}}, {"kd", {0.6}}});
  const std::vector<Angles<double>> rows{{1, 1, 1, 1, 0}};
  const auto f = evaluate(b, rows);
  const double f0[] = {0, 0.04, 1};
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(f[c][0], f0[c] / (4 * pi) + (1 - f0[c]) * 0.6 / pi, 2 * eps);
}

TEST(Column, IsAlignedAndFilled) {
  for (const std::size_t n : {0UL, 1UL, 1000UL}) {
    Column<float> c(n, 2.5F);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(c.data()) % 64, 0U);
    for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(c[i], 2.5F);
  }
}

TEST(AngleColumns, ArePaddedWithHarmlessAngles) {
  AngleColumns<double> x(17);
  EXPECT_EQ(x.size(), 17U);
  EXPECT_EQ(x.padded() % padding, 0U);
  x.set(3, Angles<double>{0.1, 0.2, 0.3, 0.4, 0.91});
  const auto b = x.block();
  EXPECT_EQ(b.nol[3], 0.1);
  EXPECT_EQ(b.nov[3], 0.2);
  EXPECT_EQ(b.noh[3], 0.3);
  EXPECT_EQ(b.voh[3], 0.4);
  EXPECT_EQ(b.sin2_theta_h[3], 0.91);
  for (const auto* column : {b.nol, b.nov, b.noh, b.voh, b.sin2_theta_h})
    for (std::size_t i = x.size(); i < b.n; ++i) EXPECT_TRUE(0 < column[i] && column[i] < 1);
}

}  // namespace
}  // namespace gonio
