// Whether the standard errors of texels hold the truth.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <string>

#include "fitting/map/stack.h"
#include "fitting/map/texels.h"

#include <gtest/gtest.h>

namespace gonio::test {
namespace {

/// Part of the texels that lie within 1.96 standard errors of the truth, of each parameter the lowest and the highest of its channels.
std::map<std::string, std::array<double, 2>> coverage(const StackOptions& made) {
  const Stack s = stack(made);
  TexelOptions asked;
  asked.model = made.model;
  const TexelFit f = fit_texels(s.samples(), asked);
  std::map<std::string, std::array<double, 2>> all;
  std::size_t column = 0;
  for (const auto& q : s.model.model.parameters)
    for (std::size_t c = 0; c < q.count; ++c, ++column) {
      std::size_t inside = 0, known = 0;
      for (std::size_t t = 0; t < s.texels; ++t) {
        const auto& k = f.columns[column];
        if (k.status[t] != static_cast<std::uint8_t>(ParameterStatus::free) ||
            std::isnan(k.std_error[t]))
          continue;
        ++known;
        inside +=
            std::abs(double{k.value[t]} - s.truth[q.first + c][t]) <= 1.96 * double{k.std_error[t]};
      }
      EXPECT_GE(known, s.texels * 95 / 100) << q.name;
      const double part = static_cast<double>(inside) / static_cast<double>(known);
      auto& range = all.try_emplace(q.name, std::array{part, part}).first->second;
      range = {std::min(range[0], part), std::max(range[1], part)};
    }
  return all;
}

TEST(TexelIntervals, HoldTheTruth) {
  StackOptions made;
  made.texels = std::getenv("GONIO_LONG") ? 256 * 256 : 64 * 64;
  for (const std::size_t images : {10, 24, 64}) {
    made.images = images;
    made.noise = Noise::of_light;
    made.sigma = 0.002;
    for (const auto& [name, part] : coverage(made)) {
      EXPECT_GE(part[0], 0.93) << name << " of " << images;
      EXPECT_LE(part[1], images < 24 ? 0.985 : 0.975) << name << " of " << images;
    }
    // A few bright images decide on alpha, whose residuals are small by chance, too.
    made.noise = Noise::relative;
    made.sigma = 0.02;
    const auto loud = coverage(made);
    for (const auto& [name, part] : loud) EXPECT_GE(part[0], 0.93) << name << " of " << images;
    EXPECT_LE(loud.at("alpha")[1], 0.97) << images;
  }
}

}  // namespace
}  // namespace gonio::test
