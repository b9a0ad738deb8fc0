#include "scene/render/render.h"

#include <algorithm>
#include <mutex>
#include <numeric>
#include <utility>
#include <variant>

#include "geometry/half_difference.h"
#include "geometry/sampling.h"
#include "scene/light/lighting.h"
#include "scene/surface/evaluate.h"
#include "scene/trace/camera.h"
#include "scene/trace/tracer.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

namespace gonio::scene {
namespace {

/// Light that is to be reflected by one surface, gathered into columns.
template <class F>
class Gathered {
 public:
  explicit Gathered(const Surface& s)
      : evaluate_(s),
        angles_(most,
                s.base.model.anisotropic || (s.coat && s.coat->model.anisotropic) ||
                    (s.multiple.lobe && s.multiple.lobe->anisotropic())),
        f_{Column<F>(most), Column<F>(most), Column<F>(most)} {
    for (std::size_t i = 0; i < most; ++i)  // so that whatever follows the last is harmless
      angles_.set(i, frame_angles({{0, 0, 1}, {0, 0, 1}}));
  }

  void add(const FrameAngles<double>& a, const Rgb& weight, Rgb& to) {
    angles_.set(light_.size(), a);
    light_.push_back({weight, &to});
    if (light_.size() == most) reflect();
  }
  /// Adds what it has gathered to where it belongs.
  void reflect() {
    const std::size_t n = light_.size(), padded = (n + padding - 1) / padding * padding;
    if (n == 0) return;
    evaluate_(angles_.block().part(0, padded),
              std::array{f_[0].data(), f_[1].data(), f_[2].data()});
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t c = 0; c < 3; ++c)
        (*light_[i].to)[c] += static_cast<double>(f_[c][i]) * light_[i].weight[c];
    light_.clear();
  }

 private:
  static constexpr std::size_t most = 1024;
  struct Light {
    Rgb weight;
    Rgb* to;
  };
  SurfaceEvaluator<F> evaluate_;
  AngleColumns<F> angles_;
  std::array<Column<F>, 3> f_;
  std::vector<Light> light_;
};

/// Numbers below n in any order, always the same: neighbours among a pixel's places are none among the directions of its
/// light, or what one leaves out would be missing from the other.
std::vector<std::size_t> shuffled(std::size_t n) {
  std::vector<std::size_t> all(n);
  std::iota(all.begin(), all.end(), std::size_t{0});
  Draws draw(n);
  for (std::size_t left = n; left > 1; --left)
    std::swap(all[left - 1],
              all[std::min(static_cast<std::size_t>(draw.uniform() * static_cast<double>(left)),
                           left - 1)]);
  return all;
}

/// Painter of one thread.
class Painter {
 public:
  Painter(const Scene& scene,
          std::span<const Shown> materials,
          const RenderOptions& o,
          std::span<const std::size_t> order,
          const Tracer& tracer,
          const Lighting& lights)
      : materials_(materials),
        o_(o),
        shuffled_(order),
        tracer_(tracer),
        lights_(lights),
        rays_(middle_camera(scene.view),
              static_cast<double>(o.width) / static_cast<double>(o.height)) {
    surfaces_.reserve(materials.size());
    for (const auto& m : materials) {
      if (m.surface.single)
        surfaces_.emplace_back(std::in_place_type<Gathered<float>>, m.surface);
      else
        surfaces_.emplace_back(std::in_place_type<Gathered<double>>, m.surface);
    }
    for (const auto& light : scene.lights)
      if (const auto* e = std::get_if<EnvironmentLight>(&light)) sky_ = e;
  }

  /// Sums of the samples of a rectangle of pixels.
  void paint(std::size_t x0, std::size_t x1, std::size_t y0, std::size_t y1, Picture& to) {
    sums_.assign((x1 - x0) * (y1 - y0), {});
    for (std::size_t y = y0, k = 0; y < y1; ++y)
      for (std::size_t x = x0; x < x1; ++x) paint(x, y, sums_[k++]);
    for (auto& s : surfaces_) std::visit([](auto& gathered) { gathered.reflect(); }, s);
    const auto n = static_cast<double>(o_.samples);
    for (std::size_t y = y0, k = 0; y < y1; ++y)
      for (std::size_t x = x0; x < x1; ++x, ++k)
        std::ranges::transform(sums_[k], to.radiance[y * o_.width + x].begin(),
                               [&](double v) { return v / n; });
  }

 private:
  void paint(std::size_t x, std::size_t y, Rgb& to) {
    Draws draw(o_.seed, y * o_.width + x);
    const std::array shift{draw.uniform(), draw.uniform()};
    for (std::size_t s = 0; s < o_.samples; ++s) {
      auto point = hammersley(static_cast<std::uint32_t>(s), static_cast<double>(o_.samples));
      for (std::size_t k = 0; k < 2; ++k) {
        point[k] += shift[k];
        point[k] -= std::floor(point[k]);
      }
      const Ray r = rays_((static_cast<double>(x) + point[0]) / static_cast<double>(o_.width),
                          (static_cast<double>(y) + point[1]) / static_cast<double>(o_.height));
      look_along(r, {shuffled_[s], o_.samples}, draw, to);
    }
  }
  void look_along(const Ray& r, const Part& part, Draws draw, Rgb& to) {
    const auto hit = tracer_.closest(r.origin, r.direction);
    if (!hit) {
      if (!sky_) return;
      const Rgb radiance = sky_->radiance(r.direction);
      for (std::size_t c = 0; c < 3; ++c) to[c] += radiance[c];
      return;
    }
    const Direction viewer{-r.direction.x, -r.direction.y, -r.direction.z};
    const auto& frame = hit->frame;
    const auto& lit = materials_[hit->material].surface.image_lit;
    if (lit && dot(frame.z, viewer) > 0) {
      const Rgb radiance = (*lit)(sky_view(frame, viewer));
      for (std::size_t c = 0; c < 3; ++c) to[c] += radiance[c];
    }
    incident_.clear();
    lights_.incident(hit->position, frame, viewer, materials_[hit->material].widths, 1, draw,
                     incident_, part);
    const Direction v = frame.inside(viewer);
    for (const auto& i : incident_) {
      if (lit && i.of_sky) continue;
      const auto a = frame_angles({frame.inside(i.direction), v});
      std::visit([&](auto& gathered) { gathered.add(a, i.weight, to); }, surfaces_[hit->material]);
    }
  }

  std::span<const Shown> materials_;
  const RenderOptions& o_;
  std::span<const std::size_t> shuffled_;
  const Tracer& tracer_;
  const Lighting& lights_;
  Rays rays_;
  const EnvironmentLight* sky_ = nullptr;
  std::vector<std::variant<Gathered<float>, Gathered<double>>> surfaces_;
  std::vector<Rgb> sums_;
  std::vector<Incident> incident_;
};

}  // namespace

Picture render(const Scene& scene,
               std::span<const Shown> materials,
               const RenderOptions& o,
               const std::function<void(std::size_t done, std::size_t all)>& progress) {
  std::vector<double> turns;
  for (const auto& m : materials) turns.push_back(m.turn);
  const Tracer tracer(scene, turns);
  const Lighting lights(scene, &tracer);
  const auto order = shuffled(o.samples);
  Picture picture{o.width, o.height, std::vector<Rgb>(o.width * o.height)};

  constexpr std::size_t side = 8;  // pixels of a part
  const std::size_t across = (o.width + side - 1) / side,
                    all = across * ((o.height + side - 1) / side);
  std::size_t done = 0;
  std::mutex telling;
  tbb::enumerable_thread_specific<Painter> painters(
      [&] { return Painter(scene, materials, o, order, tracer, lights); });
  tbb::parallel_for(std::size_t{0}, all, [&](std::size_t i) {
    const std::size_t x = i % across * side, y = i / across * side;
    painters.local().paint(x, std::min(x + side, o.width), y, std::min(y + side, o.height),
                           picture);
    const std::scoped_lock lock(telling);
    ++done;
    if (progress) progress(done, all);
  });
  return picture;
}

}  // namespace gonio::scene
