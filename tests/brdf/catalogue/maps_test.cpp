#include "brdf/catalogue/maps.h"

#include <cmath>

#include "brdf/catalogue/registry.h"
#include "brdf/in_number/one_term.h"
#include "number/archetype.h"
#include "number/batch.h"
#include "number/dual.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

using Given = std::map<std::string, double>;

std::vector<double> apply(std::string_view id, const Given& p, Number number = Number::double_) {
  return evaluate_map(find_map(id).value(), number, p, {}).values.at(0);
}

template <template <class> class Map>
constexpr bool map_takes_every_number() {
  constexpr std::size_t n = Map<double>::parameters.size();
  return MapOver<Map<double>, double> && MapOver<Map<float>, float> &&
         MapOver<Map<Archetype>, Archetype> && MapOver<Map<Batch<float>>, Batch<float>> &&
         MapOver<Map<Dual<double, n>>, Dual<double, n>>;
}
template <template <class> class... M>
constexpr bool all_take_every_number(MapList<M...>) {
  return (map_takes_every_number<M>() && ...);
}
static_assert(all_take_every_number(Maps{}));

TEST(Maps, SayWhatTheyAreCalledWhatTheyDoAndWhoSaysSo) {
  for (const auto& m : maps()) {
    EXPECT_FALSE(m.about->title.empty() || m.about->formula.empty() || m.about->source.empty())
        << m.about->id;
    EXPECT_FALSE(m.outputs.empty()) << m.about->id;
    EXPECT_EQ(find_map(m.about->id), static_cast<std::size_t>(&m - maps().data()));
    for (const auto& p : m.parameters)
      EXPECT_TRUE(p.legal.holds(p.start) && !p.meaning.empty()) << m.about->id << " " << p.name;
  }
  EXPECT_FALSE(find_map("clamp.nothing"));
}

TEST(Maps, AreFiniteAtTheEndsOfTheirRanges) {
  for (const auto& m : maps())
    for (int corner = 0; corner < 1 << m.parameters.size(); ++corner) {
      Given p;
      for (std::size_t k = 0; k < m.parameters.size(); ++k) {
        const auto& range = m.parameters[k].legal;
        p[std::string(m.parameters[k].name)] = (corner >> k) & 1 ? range.high : range.low;
      }
      for (const auto number : {Number::double_, Number::float_})
        for (const double v : apply(m.about->id, p, number))
          EXPECT_TRUE(std::isfinite(v)) << m.about->id << " " << testing::PrintToString(p);
    }
}

TEST(ClampAlpha, IsRoughnessSquaredDownToAThousandth) {
  EXPECT_EQ(apply("clamp.alpha", {{"roughness", 0.5}})[0], 0.25);
  EXPECT_EQ(apply("clamp.alpha", {{"roughness", 0.03}})[0], 0.001);
  EXPECT_EQ(apply("clamp.alpha", {{"roughness", 0}})[0], 0.001);
}

TEST(ClampNov, TurnsNormalsSeenFromBehind) {
  EXPECT_DOUBLE_EQ(apply("clamp.nov", {{"nov", 0.25}})[0], 0.25001);
  EXPECT_DOUBLE_EQ(apply("clamp.nov", {{"nov", -0.25}})[0], 0.25001);
  EXPECT_EQ(apply("clamp.nov", {{"nov", 1}})[0], 1);
}

TEST(ClampVis, CapsTheVisibilityAt500) {
  EXPECT_EQ(0.5 / apply("clamp.vis", {{"d", 0}})[0], 500);
  EXPECT_EQ(apply("clamp.vis", {{"d", 0.3}})[0], 0.3);
}

TEST(AnisoDisney, KeepsTheProductOfTheWidths) {
  const auto w = apply("aniso.disney", {{"roughness", 0.6}, {"anisotropy", 0.8}});
  EXPECT_DOUBLE_EQ(w[0] * w[1], 0.36 * 0.36);
  EXPECT_DOUBLE_EQ(w[1] / w[0], 1 - 0.9 * 0.8);
  const auto round = apply("aniso.disney", {{"roughness", 0.6}, {"anisotropy", 0}});
  EXPECT_DOUBLE_EQ(round[0], 0.36);
  EXPECT_DOUBLE_EQ(round[1], 0.36);
}

TEST(AnisoImageworks, KeepsTheSumOfTheWidths) {
  const auto w = apply("aniso.imageworks", {{"roughness", 0.5}, {"anisotropy", 0.4}});
  EXPECT_DOUBLE_EQ(w[0], 0.35);
  EXPECT_DOUBLE_EQ(w[1], 0.15);
}

TEST(BlinnPhongExponent, RunsFrom1To8192) {
  EXPECT_EQ(apply("exponent.artist", {{"s", 0}})[0], 1);
  EXPECT_NEAR(apply("exponent.artist", {{"s", 1}})[0], 8192, 1e-9);
  const auto middle = apply("exponent.artist", {{"s", 0.5}});
  EXPECT_NEAR(middle[0], std::sqrt(8192), 1e-12);
  EXPECT_NEAR(2 / (middle[1] * middle[1]) - 2, middle[0], 1e-12);  // p = 2/alpha² − 2
}

TEST(FilterNormalVariance, LeavesAFlatSurfaceAndIsCapped) {
  EXPECT_DOUBLE_EQ(apply("filter.normal_variance", {{"alpha", 0.3}, {"variance", 0}})[0], 0.3);
  EXPECT_DOUBLE_EQ(apply("filter.normal_variance", {{"alpha", 0}, {"variance", 0.02}})[0], 0.2);
  EXPECT_DOUBLE_EQ(apply("filter.normal_variance", {{"alpha", 0}, {"variance", 9}})[0],
                   std::sqrt(0.18));
  EXPECT_EQ(apply("filter.normal_variance", {{"alpha", 1}, {"variance", 9}})[0], 1);
}

TEST(Maps, TakeAListOfOneParameterRowByRow) {
  const auto v = evaluate_map(find_map("aniso.imageworks").value(), Number::double_,
                              {{"anisotropy", 0.5}}, {{"roughness", {0.5, 1}}});
  ASSERT_EQ(v.values.size(), 2U);
  EXPECT_DOUBLE_EQ(v.values[1][0], 1.5);
  EXPECT_EQ(v.parameters.size(), 1U);
  const auto evaluate = [](const Given& p, const std::map<std::string, std::vector<double>>& at) {
    return evaluate_map(find_map("aniso.imageworks").value(), Number::double_, p, at);
  };
  EXPECT_ANY_THROW(evaluate({{"roughness", 2}}, {}));
  EXPECT_ANY_THROW(evaluate({{"alpha", 0.2}}, {}));
  EXPECT_ANY_THROW(evaluate({}, {{"roughness", {2}}}));
  EXPECT_ANY_THROW(evaluate({}, {{"noh", {1}}}));
  EXPECT_ANY_THROW(evaluate({{"roughness", 1}}, {{"roughness", {1}}}));
  EXPECT_ANY_THROW(evaluate({}, {{"roughness", {0, 1}}, {"anisotropy", {0, 0.5, 1}}}));
}

}  // namespace
}  // namespace gonio
