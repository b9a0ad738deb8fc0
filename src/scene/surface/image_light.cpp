#include "scene/surface/image_light.h"

#include <algorithm>
#include <cmath>

#include "integrate/light/split_sum.h"

#include <tbb/task_arena.h>

namespace gonio::scene {
namespace {

constexpr std::size_t cosines = ImageLight::Lobe::cosines;
using Table = std::array<double, cosines>;

std::vector<double> centres() {
  std::vector<double> all;
  for (std::size_t i = 0; i < cosines; ++i)
    all.push_back((static_cast<double>(i) + 0.5) / static_cast<double>(cosines));
  return all;
}

/// Value between two centres; beyond the outer ones theirs.
double looked_up(const Table& t, double nov) {
  const double x = std::clamp(nov * cosines - 0.5, 0.0, cosines - 1.0);
  const auto i = std::min(static_cast<std::size_t>(x), cosines - 2);
  return std::lerp(t[i], t[i + 1], x - static_cast<double>(i));
}

}  // namespace

SkyView sky_view(const Frame& frame, const Direction& to_viewer) {
  const Direction v = frame.inside(to_viewer);
  return {EnvironmentLight::into_map(frame.z),
          EnvironmentLight::into_map(frame.outside({-v.x, -v.y, v.z})), v.z};
}

const LightPyramid& ImageLight::pyramid() const {
  if (!pyramid_) pyramid_.emplace(light_.map);
  return *pyramid_;
}

std::shared_ptr<const ImageLight::Lobe> ImageLight::lobe(const std::string& masking,
                                                         double alpha) const {
  const std::scoped_lock lock(making_);
  auto& made = lobes_[{masking, alpha}];
  // Isolated: a thread that waits for its parts must not take up another task that asks for this
  // lock.
  if (!made)
    tbb::this_task_arena::isolate([&] {
      auto lobe = std::make_shared<Lobe>();
      lobe->light = prefiltered(pyramid(), alpha);
      const auto sums = split_sum(masking, std::sqrt(alpha), centres());
      for (std::size_t i = 0; i < cosines; ++i) {
        lobe->a[i] = sums[i].a;
        lobe->b[i] = sums[i].b;
      }
      made = std::move(lobe);
    });
  return made;
}

std::shared_ptr<const ImageLight::Even> ImageLight::even() const {
  const std::scoped_lock lock(making_);
  if (!even_)
    tbb::this_task_arena::isolate([&] {
      auto even = std::make_shared<Even>();
      even->mean = mean_radiance(pyramid());
      const auto diffuse = split_sum_diffuse(centres());
      for (std::size_t i = 0; i < cosines; ++i) even->diffuse[i] = diffuse[i].value[0];
      even_ = std::move(even);
    });
  return even_;
}

ImageLit::ImageLit(const ImageLight& light, ImageLitParts parts)
    : parts_(std::move(parts)), scale_(light.scale()) {
  if (parts_.lobe) lobe_ = light.lobe(parts_.lobe->masking, parts_.lobe->alpha);
  if (parts_.coat) coat_ = light.lobe(parts_.coat->masking, parts_.coat->alpha);
  if (parts_.compensated || std::ranges::any_of(parts_.kd, [](double x) { return x > 0; }))
    even_ = light.even();
}

Rgb ImageLit::operator()(const SkyView& view) const {
  LookedUp<double> at;
  at.nov = view.nov;
  if (even_) {
    at.mean = even_->mean(view.normal);
    at.diffuse = looked_up(even_->diffuse, view.nov);
  }
  if (lobe_) {
    at.lobe = lobe_->light(view.mirror);
    at.a = looked_up(lobe_->a, view.nov);
    at.b = looked_up(lobe_->b, view.nov);
  }
  if (coat_) {
    at.coat = coat_->light(view.mirror);
    at.coat_a = looked_up(coat_->a, view.nov);
    at.coat_b = looked_up(coat_->b, view.nov);
  }
  Rgb sum = image_lit(parts_, at);
  for (double& x : sum) x *= scale_;
  return sum;
}

}  // namespace gonio::scene
