#pragma once
/// \file
/// Emitted programs compiled by each language's own compiler, and run on Vulkan.

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "geometry/angles.h"
#include "number/half.h"
#include "number/parameter.h"
#include "shader/program.h"
#include "shader/vulkan.h"
#include "support.h"

#include <gtest/gtest.h>

namespace gonio::shader {

/// Device, where there is one and a compiler of GLSL; else why not.
std::unique_ptr<test::Vulkan> device(std::string& why);
/// Whether there are compilers of WGSL and Slang.
bool has_shading();
#define GONIO_NEEDS_VULKAN(variable) \
  std::string why;                   \
  const auto variable = device(why); \
  if (!variable) GTEST_SKIP() << why << ": run ./check, which installs it"
#define GONIO_NEEDS_SHADING \
  if (!has_shading())       \
  GTEST_SKIP() << "wgpu and slangpy are not there: run ./check, which fetches them"

/// 32-bit words of a file.
std::vector<std::uint32_t> words_of(const std::string& path);
/// SPIR-V of a compute program, which is held to be valid.
std::vector<std::uint32_t> compiled_glsl(const test::Folder&, const std::string& source);
/// Runs the compilers over a folder of programs and says what they did not take: languages.py.
void run_languages(const test::Folder&, const std::vector<std::string>& names);
/// Results of programs over their inputs, each in its language: of each so many rows of its number of results.
std::vector<std::vector<float>> run_all(test::Vulkan&,
                                        Language,
                                        const std::vector<std::string>& programs,
                                        const std::vector<std::vector<float>>& inputs,
                                        std::size_t rows,
                                        const std::vector<std::size_t>& results);

/// The same bits, signs of zeros and kinds of NaN aside.
bool same_bits(float, float);

template <class F>
constexpr Precision precision_of = std::same_as<F, Half> ? Precision::half : Precision::float_;

/// Numbers of a shader's kind.
template <class F>
class Draw {
 public:
  /// Within a range, of positive ones in logarithms.
  F operator()(const Range& r) {
    const double u = std::ldexp(static_cast<double>(random_() >> 11), -53);
    const double x = r.low > 0 ? r.low * std::pow(r.high / r.low, u) : r.low + (r.high - r.low) * u;
    const auto less = [](const F& a, const F& b) { return a < b; };
    return std::clamp(static_cast<F>(x), static_cast<F>(r.low), static_cast<F>(r.high), less);
  }
  /// Angles of two directions above the surface.
  FrameAngles<F> angles() {
    const auto direction = [&] {
      const auto z = static_cast<double>((*this)({0.02, 1}));
      const auto phi = static_cast<double>((*this)({0, 6.28}));
      const double s = std::sqrt(1 - z * z);
      return std::array{s * std::cos(phi), s * std::sin(phi), z};
    };
    const auto l = direction(), v = direction();
    std::array<double, 3> h{l[0] + v[0], l[1] + v[1], l[2] + v[2]};
    const double length = std::hypot(h[0], h[1], h[2]);
    for (auto& x : h) x /= length;
    const double voh = v[0] * h[0] + v[1] * h[1] + v[2] * h[2];
    const auto f = [](double x) { return static_cast<F>(std::min(x, 1.0)); };
    return {{f(l[2]), f(v[2]), f(h[2]), f(voh), f(h[0] * h[0] + h[1] * h[1])},
            f(h[0]),
            f(h[1]),
            f(l[0]),
            f(l[1]),
            f(v[0]),
            f(v[1])};
  }

 private:
  std::mt19937_64 random_{7};
};

template <class F>
F angle_of(const FrameAngles<F>& a, const std::string& name) {
  const std::pair<const char*, F> all[] = {{"NoL", a.nol},
                                           {"NoV", a.nov},
                                           {"NoH", a.noh},
                                           {"VoH", a.voh},
                                           {"sin2_theta_h", a.sin2_theta_h},
                                           {"XoH", a.xoh},
                                           {"YoH", a.yoh},
                                           {"XoL", a.xol},
                                           {"YoL", a.yol},
                                           {"XoV", a.xov},
                                           {"YoV", a.yov}};
  for (const auto& [n, x] : all)
    if (name == n) return x;
  ADD_FAILURE() << name;
  return F(0);
}

}  // namespace gonio::shader
