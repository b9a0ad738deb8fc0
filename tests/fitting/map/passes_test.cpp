#include "fitting/map/passes.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "fitting/map/register.h"
#include "fitting/map/stack.h"
#include "geometry/sampling.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

using test::Stack;
using test::StackOptions;

constexpr double t_of_tilt = 0.2, u_of_tilt = -0.1;

/// A register of texels whose normals are all tilted by the same, seen as they are.
struct Tilted {
  StackOptions made;
  std::unique_ptr<Stack> stack;
  std::unique_ptr<TexelTask> task;
  std::unique_ptr<TexelRegister> texels;
  TexelSamples samples;
  std::vector<float> values;  ///< [slot][padding]: the truth

  Tilted(const std::string& model, const LaneKernels& lanes) {
    made.model = model;
    made.texels = padding;
    stack = std::make_unique<Stack>(test::stack(made));
    const double length = std::hypot(1, t_of_tilt, u_of_tilt);
    const Frame frame(Direction{t_of_tilt / length, u_of_tilt / length, 1 / length});
    for (std::size_t t = 0; t < padding; ++t) {
      for (std::size_t k = 0; k < stack->truth.size(); ++k)
        stack->model.values[k] = stack->truth[k][t];
      for (std::size_t i = 0; i < made.images; ++i) {
        const auto d = stack->directions(i);
        const Direction l = frame.inside(d.wi), v = frame.inside(d.wo);
        const bool lit = l.z > 0.01 && v.z > 0.01;
        const std::vector angles{frame_angles(lit ? DirectionPair{l, v} : d)};
        const auto f = evaluate(stack->model, angles);
        for (std::size_t c = 0; c < 3; ++c)
          stack->values[stack->at(i, c, t)] = lit ? static_cast<float>(f[c][0] * l.z / d.wi.z) : 0;
      }
    }
    for (const auto& slot : stack->truth)
      for (const double x : slot) values.push_back(static_cast<float>(x));
    TexelOptions o;
    o.model = model;
    o.refine_normals = true;
    task = std::make_unique<TexelTask>(o, 3);
    samples = stack->samples();
    texels = std::make_unique<TexelRegister>(*task, samples, kernels<float>(), lanes, false);
    std::vector<std::size_t> first;
    for (std::size_t l = 0; l < lanes.lanes; ++l) first.push_back(l);
    texels->gather(first);
    std::vector<float> tilt(padding, static_cast<float>(t_of_tilt));
    tilt.insert(tilt.end(), padding, static_cast<float>(u_of_tilt));
    texels->tilt(tilt.data());
  }
};

/// Sums by unknown, of the first lane: [unknown, the residual's last]².
std::vector<double> sums_of(const TexelPasses& p, const UnknownOf& of, std::size_t unknowns) {
  const std::size_t n = unknowns + 1;
  std::vector<double> all(n * n);
  for (std::size_t c = 0; c < of.size(); ++c) {
    std::vector<std::size_t> at{unknowns};
    at.insert(at.end(), of[c].begin(), of[c].end());
    std::size_t e = 0;
    for (std::size_t a = 0; a < at.size(); ++a)
      for (std::size_t b = a; b < at.size(); ++b, ++e) {
        const double x = double{p.sums()[c][e * padding]};
        all[at[a] * n + at[b]] += x;
        if (a != b) all[at[b] * n + at[a]] += x;
      }
  }
  return all;
}

TEST(TexelPasses, OfTiltedNormalsAreTheSameInOneLoopAsTermByTerm) {
  for (const char* model :
       {"lambert+ggx/smith_ggx.correlated/schlick", "lambert+gtr/smith_ggx.correlated/schlick"}) {
    const LaneKernels& lanes = lane_kernels();
    LaneKernels without = lanes;
    without.fused_tilted = {};
    Tilted t(model, lanes);
    TexelPasses fused(*t.task, kernels<float>(), lanes);
    TexelPasses composed(*t.task, kernels<float>(), without);
    ASSERT_TRUE(fused.is_fused());
    ASSERT_FALSE(composed.is_fused());
    const std::size_t n = t.task->unknowns.count;
    const auto expect_same = [&](const UnknownOf& a, const UnknownOf& b, bool is_truth) {
      const auto in_one = sums_of(fused, a, n), by_term = sums_of(composed, b, n);
      const auto at = [&](std::size_t i, std::size_t j) { return by_term[i * (n + 1) + j]; };
      if (is_truth) {
        EXPECT_LT(at(n, n), 1e-9 * double{t.texels->signal()[0]}) << model;
        EXPECT_LT(in_one[n * (n + 1) + n], 1e-9 * double{t.texels->signal()[0]}) << model;
        return;
      }
      for (std::size_t i = 0; i <= n; ++i)
        for (std::size_t j = 0; j <= n; ++j)
          EXPECT_NEAR(in_one[i * (n + 1) + j], at(i, j), 2e-5 * std::sqrt(at(i, i) * at(j, j)))
              << model << " " << i << " " << j;
    };
    for (const bool is_truth : {true, false}) {
      fused.normal(t.texels->samples(), t.values.data());
      composed.normal(t.texels->samples(), t.values.data());
      expect_same(fused.unknowns(), composed.unknowns(), is_truth);
      fused.linear(t.texels->samples(), t.values.data());
      composed.linear(t.texels->samples(), t.values.data());
      expect_same(fused.linear_unknowns(), composed.linear_unknowns(), is_truth);
      for (float& x : t.values) x *= 1.1F;
    }
  }
}

TEST(TexelRegister, TiltsAnglesAsNormalsOfTheirOwnHaveThem) {
  Tilted t("lambert+ggx/smith_ggx.correlated/schlick", lane_kernels());
  const std::size_t width = lane_kernels().lanes;
  const auto tilted = [&](double along_x, double along_y) {
    const double length = std::hypot(1, along_x, along_y);
    return Direction{along_x / length, along_y / length, 1 / length};
  };
  const Direction n = tilted(t_of_tilt, u_of_tilt);
  const std::array part{n.x, n.y, n.z};
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(double{t.texels->normal(k, 0)}, part[k], 1e-6);
  const auto& x = t.texels->samples().x;
  for (std::size_t i = 0; i < t.made.images; ++i) {
    const auto d = t.stack->directions(i);
    const auto cosine = [&](std::size_t which, const Direction& z) {
      const Direction h{d.wi.x + d.wo.x, d.wi.y + d.wo.y, d.wi.z + d.wo.z};
      return which == 0 ? dot(h, z) / std::sqrt(dot(h, h)) : dot(which == 1 ? d.wi : d.wo, z);
    };
    const std::array<const float*, 3> found{x.noh, x.nol, x.nov};
    for (std::size_t which = 0; which < 3; ++which) {
      const double expected = cosine(which, n);
      const double held = which == 0 ? expected : std::max(expected, 1e-3);
      EXPECT_NEAR(double{found[which][i * width]}, held, 1e-6) << i;
      constexpr double step = 1e-5;
      const std::array ahead{tilted(t_of_tilt + step, u_of_tilt),
                             tilted(t_of_tilt, u_of_tilt + step)};
      for (std::size_t k = 0; k < 2; ++k)
        EXPECT_NEAR(double{x.frame[2 * which + k][i * width]},
                    (cosine(which, ahead[k]) - expected) / step, 1e-4)
            << i << " " << which << " " << k;
    }
    EXPECT_NEAR(double{x.sin2_theta_h[i * width]}, 1 - square(double{x.noh[i * width]}), 1e-6) << i;
  }
}

}  // namespace
}  // namespace gonio
