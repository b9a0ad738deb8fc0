#pragma once
/// \file
/// Stacks of images that the tests of maps make up.

#include <cmath>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "brdf/model/evaluate.h"
#include "fitting/map/texels.h"
#include "geometry/half_difference.h"

namespace gonio::test {

/// A map with its parameters, [slot][texel].
struct Stack {
  BoundModel model;
  std::size_t texels = 0, images = 0;
  std::vector<float> light, view, normal, values;
  std::vector<std::vector<double>> truth;

  TexelSamples samples() const {
    return {texels, images, model.model.channels, values, true, light, view, normal};
  }
  std::size_t at(std::size_t image, std::size_t channel, std::size_t texel) const {
    return (image * model.model.channels + channel) * texels + texel;
  }
  /// Directions as they are: floats of unit length but for rounding.
  DirectionPair directions(std::size_t image) const {
    const auto of = [&](const std::vector<float>& v) {
      const Direction d{double{v[3 * image]}, double{v[3 * image + 1]}, double{v[3 * image + 2]}};
      const double length = std::sqrt(dot(d, d));
      return Direction{d.x / length, d.y / length, d.z / length};
    };
    return {of(light), of(view)};
  }
};

enum class Noise { none, relative, of_light };

struct StackOptions {
  std::string model = "lambert+ggx/smith_ggx.correlated/schlick";
  std::size_t texels = 64, images = 64, channels = 3;
  Noise noise = Noise::none;
  double sigma = 0;  ///< a part of f, or of f NoL [1/sr]
  unsigned seed = 1;
  std::optional<double> gamma = {};  ///< none: 1.5 to 2.5
};

/// Light all around, half of the views near the mirror direction.
inline Stack stack(const StackOptions& o) {
  Stack s;
  s.model = bind_model(o.model, {}, o.channels);
  s.texels = o.texels;
  s.images = o.images;
  std::mt19937 random(o.seed);
  std::uniform_real_distribution<double> uniform;
  std::normal_distribution<double> normal;
  const auto turn = [&] { return 360 * degree * uniform(random); };
  for (std::size_t i = 0; i < o.images;) {
    const Direction l = direction(70 * degree * std::sqrt(uniform(random)), turn());
    Direction v = direction(65 * degree * std::sqrt(uniform(random)), turn());
    if (i % 2) {
      const double near = uniform(random);
      const Direction h = direction(25 * degree * near * near, turn());
      const double c = dot(l, h);
      v = {2 * c * h.x - l.x, 2 * c * h.y - l.y, 2 * c * h.z - l.z};
    }
    if (v.z < 0.2) continue;
    for (const double x : {l.x, l.y, l.z}) s.light.push_back(static_cast<float>(x));
    for (const double x : {v.x, v.y, v.z}) s.view.push_back(static_cast<float>(x));
    ++i;
  }
  std::vector<FrameAngles<double>> angles;
  for (std::size_t i = 0; i < o.images; ++i) angles.push_back(frame_angles(s.directions(i)));
  s.values.resize(o.texels * o.images * o.channels);
  s.truth.assign(s.model.values.size(), std::vector<double>(o.texels));
  for (std::size_t t = 0; t < o.texels; ++t) {
    for (const auto& q : s.model.model.parameters)
      for (std::size_t c = 0; c < q.count; ++c) {
        const auto name = q.about->name;
        const double u = uniform(random);
        const double x = name == "alpha" && q.name != "alpha" ? 0.35 + 0.3 * u  // of a further lobe
                         : name == "alpha"                    ? 0.06 * std::pow(8.0, u)
                         : name == "alpha_x"                  ? 0.25 + 0.25 * u
                         : name == "alpha_y"                  ? 0.06 + 0.1 * u
                         : name == "tangent"                  ? -40 + 170 * u
                         : name == "kd"                       ? 0.05 + 0.6 * u
                         : name == "f0"                       ? 0.03 + 0.3 * u
                         : name == "gamma"                    ? o.gamma.value_or(1.5 + u)
                         : name == "eta"                      ? 1.3 + 0.5 * u
                                                              : q.about->start;
        s.model.values[q.first + c] = s.truth[q.first + c][t] = x;
      }
    const auto f = evaluate(s.model, angles);
    for (std::size_t i = 0; i < o.images; ++i)
      for (std::size_t c = 0; c < o.channels; ++c) {
        const double off = o.sigma * normal(random);
        const double y = o.noise == Noise::relative   ? f[c][i] * (1 + off)
                         : o.noise == Noise::of_light ? f[c][i] + off / angles[i].nol
                                                      : f[c][i];
        s.values[s.at(i, c, t)] = static_cast<float>(y);
      }
  }
  return s;
}

}  // namespace gonio::test
