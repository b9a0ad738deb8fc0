// Synthesized tables are what they say they are.
#include "data_synth/synth.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "brdf/model/evaluate.h"
#include "refusal.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace gonio {
namespace {

using namespace test;

BoundModel paint() {
  return bind_model("lambert+ggx/smith_ggx.correlated/schlick",
                    parse_settings(std::vector<std::string>{"alpha=0.15,f0=0.05,kd=0.2,0.1,0.05"}),
                    3);
}

TEST(Synth, WithoutNoiseHoldsTheModelAtEverySampleOfEveryLayout) {
  const auto b = paint();
  for (std::size_t l = 0; l < names_of<Layout>.size(); ++l) {
    const Table t = synthesize(b, {.layout = static_cast<Layout>(l)});
    const SampleAngles at(t);
    std::vector<std::size_t> picked;
    std::vector<Angles<double>> angles;
    for (std::size_t i = 0; i < t.size(); i += 97) {
      picked.push_back(i);
      angles.push_back(at(i));
    }
    const auto f = evaluate(b, angles);
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < picked.size(); ++i)
        if (t.format != "rgl") {
          ASSERT_EQ(t.values[c][picked[i]], f[c][i]) << names_of<Layout>[l];
        } else if (std::isfinite(t.values[c][picked[i]])) {  // in float, by way of what is stored
          ASSERT_NEAR(t.values[c][picked[i]], f[c][i], 1e-5 * f[c][i]) << i;
        }
  }
}

TEST(Synth, AnRglFileTakesNoNoiseAndOneAzimuth) {
  const auto refused = [](const BoundModel& b, const SynthOptions& o) {
    return refusal([&] { synthesize(b, o); }, Exit::usage);
  };
  EXPECT_HAS(refused(paint(), {.layout = Layout::rgl, .noise = 0.1}), "noise");
  EXPECT_HAS(refused(paint(), {.layout = Layout::rgl, .outliers = 0.1}), "outliers");
  const auto brushed =
      bind_model("ggx_aniso/smith_ggx_aniso.correlated/schlick",
                 parse_settings(std::vector<std::string>{"alpha_x=0.3,alpha_y=0.2,f0=0.6"}), 1);
  EXPECT_HAS(refused(brushed, {.layout = Layout::rgl}), "anisotropic");
  const auto grey = bind_model("lambert", parse_settings(std::vector<std::string>{"kd=0.5"}), 1);
  EXPECT_EQ(synthesize(grey, {.layout = Layout::rgl}).channels.size(), 3U);
}

TEST(Synth, ASliceHasAsManyBinsAsAsked) {
  const Table t = synthesize(paint(), {.layout = Layout::image_slice, .slice = 7});
  EXPECT_EQ(t.size(), 49U);
}

TEST(Synth, NoiseHasTheSpreadAskedForAndItsMedianIsTheModel) {
  const Table clean = synthesize(paint(), {.layout = Layout::random, .samples = 20000});
  const Table noisy =
      synthesize(paint(), {.layout = Layout::random, .samples = 20000, .noise = 0.05});
  double sum = 0, squares = 0;
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < clean.size(); ++i) {
      const double z = std::log(noisy.values[c][i] / clean.values[c][i]) / 0.05;
      sum += z;
      squares += z * z;
    }
  const double n = 3.0 * static_cast<double>(clean.size());
  EXPECT_NEAR(sum / n, 0, 4 / std::sqrt(n));
  EXPECT_NEAR(squares / n, 1, 4 * std::sqrt(2 / n));
}

TEST(Synth, FloorIsAddedAndOutliersAreAsManyAsAskedFor) {
  const SynthOptions plain{.layout = Layout::random, .samples = 20000};
  SynthOptions other = plain;
  other.floor = 0.25;
  const Table a = synthesize(paint(), plain), raised = synthesize(paint(), other);
  for (std::size_t i = 0; i < a.size(); ++i)
    ASSERT_DOUBLE_EQ(raised.values[1][i], a.values[1][i] + 0.25);
  other = plain;
  other.outliers = 0.1;
  const Table spoilt = synthesize(paint(), other);
  std::size_t thrown = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double ratio = spoilt.values[0][i] / a.values[0][i];
    thrown += ratio != 1;
    EXPECT_LE(std::abs(std::log10(ratio)), 2);
  }
  EXPECT_NEAR(static_cast<double>(thrown), 2000, 4 * std::sqrt(1800.0));
}

TEST(Synth, IsTheSameForASeedWhateverTheThreadsAndAnotherForAnother) {
  const SynthOptions o{.layout = Layout::mbsdf, .noise = 0.1, .outliers = 0.1, .seed = 7};
  const Table many = synthesize(paint(), o);
  {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(synthesize(paint(), o).values, many.values);
  }
  SynthOptions p = o;
  p.seed = 8;
  EXPECT_NE(synthesize(paint(), p).values, many.values);
}

TEST(Synth, RemembersTheTruth) {
  const Table t = synthesize(paint(), {.layout = Layout::in_plane, .noise = 0.02, .seed = 5});
  ASSERT_TRUE(t.truth);
  EXPECT_EQ(t.truth->model, "lambert+ggx/smith_ggx.correlated/schlick");
  EXPECT_EQ(t.truth->noise, 0.02);
  EXPECT_EQ(t.truth->seed, 5U);
  const auto& p = t.truth->parameters;
  const auto kd = std::ranges::find(p, "kd", [](const auto& x) { return x.first; });
  ASSERT_NE(kd, p.end());
  EXPECT_EQ(kd->second, (std::vector<double>{0.2, 0.1, 0.05}));
}

TEST(Synth, RefusesAMerlOrUtiaTableOfTwoChannels) {
  const auto b = bind_model("lambert", parse_settings(std::vector<std::string>{"kd=0.1,0.2"}));
  EXPECT_THROW(synthesize(b, {.layout = Layout::merl}), Error);
  EXPECT_THROW(synthesize(b, {.layout = Layout::utia}), Error);
}

TEST(Synth, AUtiaTableKnowsHowTheSurfaceWasTurned) {
  const auto b =
      bind_model("ggx_aniso/smith_ggx_aniso.correlated/schlick",
                 parse_settings(std::vector<std::string>{"alpha_x=0.4,alpha_y=0.1,f0=0.5"}), 3);
  const Table t = synthesize(b, {.layout = Layout::utia});
  // Light and viewer 15° apart in the plane of the tangent, then in that of the bitangent: D of the
  // half vector at 7.5°.
  const auto width = [](double alpha) { return std::pow(std::tan(7.5 * degree) / alpha, 2); };
  const double along = t.values[0][1], across = t.values[0][1 + 12];
  EXPECT_NEAR(along / across, std::pow((1 + width(0.1)) / (1 + width(0.4)), 2), 0.02)
      << "masking hardly differs so near the normal";
  EXPECT_THROW(synthesize(b, {.layout = Layout::merl}), Error);
}

}  // namespace
}  // namespace gonio
