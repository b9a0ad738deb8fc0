#include "scene/plan/samples.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <unordered_map>

#include "base/error.h"
#include "base/json/describe.h"
#include "geometry/half_difference.h"
#include "scene/description/scene_keys.h"
#include "scene/plan/plan.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace gonio::scene {
namespace {

constexpr std::size_t most_looks =
    20'000;  ///< for one point: what fills less of the picture is not seen
constexpr int candidates = 4;
constexpr double wide = 1.001;  ///< times a bounding sphere's radius: a mesh's points are floats

FrameAngles<double> angles_of(const Frame& frame, const Direction& light, const Direction& viewer) {
  return frame_angles({frame.inside(light), frame.inside(viewer)});
}

bool passes_through(const Ray& ray, const BoundingSphere& sphere) {
  const Vector way = sphere.center - ray.origin;
  const Vector d = vector_of(ray.direction);
  const Vector beside = way - dot(way, d) * d;
  const double radius = wide * sphere.radius;
  return dot(beside, beside) <= radius * radius;
}

template <class F>
std::vector<Rgb> radiance_in(const Surface& s,
                             const LitPoints& p,
                             const Block<F>& all,
                             std::vector<Rgb>* off) {
  const std::size_t rows = s.image_lit ? p.sky : p.point.size();
  const auto x = all.part(0, (rows + padding - 1) / padding * padding);
  std::vector<Column<F>> f;
  std::vector<F*> out;
  for (std::size_t c = 0; c < (off ? 6 : 3); ++c) out.push_back(f.emplace_back(x.n).data());
  SurfaceEvaluator<F>{s}(x, std::span(out).first(3), std::span(out).subspan(3));
  const auto sum_of = [&](std::span<const Column<F>> columns) {
    std::vector<Rgb> sum(p.count, Rgb{});
    if (s.image_lit) std::ranges::transform(p.view, sum.begin(), std::cref(*s.image_lit));
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t c = 0; c < 3; ++c)
        sum[p.point[i]][c] += static_cast<double>(columns[c].data()[i]) * p.weight[i][c];
    return sum;
  };
  if (off) *off = sum_of(std::span(f).subspan(3));
  return sum_of(std::span(f).first(3));
}

std::vector<double> turns_of(const std::vector<Look>& looks) {
  std::vector<double> turns;
  for (const auto& l : looks) turns.push_back(l.turn());
  return turns;
}

/// Rows of a point's light are kept, of all the points that sets are compared on: of more lights each has fewer.
constexpr std::size_t least_directions = 4;
std::size_t most_directions(const Scene& s) {
  return (std::size_t{1} << 21) / points_of_plan(s, PlanOptions{}.samples);
}

std::size_t with_extent(const Scene& s) {
  return static_cast<std::size_t>(std::ranges::count_if(
      s.lights, [](const Light& l) { return !std::holds_alternative<DirectionalLight>(l); }));
}
PicturePart around(std::span<const PicturePart> parts) {
  if (parts.empty()) return {};
  double left = 1, right = 0, top = 1, bottom = 0;
  for (const auto& p : parts) {
    left = std::min(left, p.x), right = std::max(right, p.x + p.width);
    top = std::min(top, p.y), bottom = std::max(bottom, p.y + p.height);
  }
  return {left, top, right - left, bottom - top};
}
/// By material the first that is the same but for its name.
std::vector<std::size_t> first_of_each(const Scene& s) {
  std::vector<std::size_t> all;
  std::unordered_map<std::string, std::size_t> known;
  for (const auto& m : s.materials) {
    std::string what = json_line(m);
    if (const auto* b = std::get_if<BoundModel>(&m.is)) what += json_line(b->values);
    all.push_back(known.try_emplace(std::move(what), all.size()).first->second);
  }
  return all;
}
/// Rows of a point that one direction of each light takes, those with an extent apart.
std::size_t without_extent(const Scene& s) {
  return s.lights.size() - with_extent(s);
}
const Scene& with_few_lights(const Scene& s) {
  const std::size_t most = most_directions(s);
  if (least_directions * with_extent(s) + without_extent(s) > most)
    throw bad_input(
        s.path, "/lights",
        fmt::format("{} with an extent, {} without", with_extent(s), without_extent(s)),
        fmt::format("at most {} in a plan of this tolerance, those with an extent as {} each", most,
                    least_directions));
  return s;
}

}  // namespace

Lit::Lit(const Scene& s)
    : scene(with_few_lights(s)),
      same_as(first_of_each(s)),
      looks(looks_of(s)),
      tracer(s, turns_of(looks)),
      lighting(s, &tracer) {}

void Lit::tell_apart(const std::vector<std::optional<Forms>>& by_material) {
  const auto before = same_as;
  for (std::size_t m = 0; m < before.size(); ++m)
    for (same_as[m] = before[m]; same_as[m] < m; ++same_as[m])
      if (before[same_as[m]] == before[m] && by_material[same_as[m]] == by_material[m]) break;
}

bool Lit::is_seen(std::size_t material) const {
  return std::ranges::any_of(
      scene.objects, [&](const Object& o) { return same_as[o.material] == same_as[material]; });
}

PointDrawer Lit::drawer(std::size_t material, std::size_t directions) const {
  const std::size_t each = (most_directions(scene) - without_extent(scene)) /
                           std::max<std::size_t>(with_extent(scene), 1);
  return {scene,    same_as[material],         same_as, looks[material].widths(), tracer,
          lighting, std::min(directions, each)};
}

LitColumns::LitColumns(std::span<const FrameAngles<double>> rows)
    : wide(rows.size(), true), narrow(rows.size(), true) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    wide.set(i, rows[i]);
    narrow.set(i, rows[i]);
  }
}

std::vector<Rgb> radiance(const Surface& s,
                          const LitPoints& p,
                          const LitColumns& columns,
                          std::vector<Rgb>* off) {
  return s.single ? radiance_in<float>(s, p, columns.narrow.block(), off)
                  : radiance_in<double>(s, p, columns.wide.block(), off);
}

PointDrawer::PointDrawer(const Scene& s,
                         std::size_t material,
                         const std::vector<std::size_t>& same_as,
                         std::vector<double> widths,
                         const Tracer& tracer,
                         const Lighting& lighting,
                         std::size_t directions)
    : scene_(s),
      material_(material),
      directions_(directions),
      same_as_(same_as),
      widths_(std::move(widths)),
      tracer_(tracer),
      lighting_(lighting) {
  for (const auto& object : s.objects)
    if (same_as_[object.material] == material) bounds_.push_back(bounding_sphere(object));
  double area = 0;
  if (const auto* camera = std::get_if<Camera>(&s.view))
    for (const auto& b : bounds_) {
      const auto part = part_around(*camera, 1, b.center, wide * b.radius);
      if (!(part.area() > 0)) continue;
      parts_.push_back(part);
      area_before_.push_back(area += part.area());
    }
  // Parts that overlap as much as that cost more than the rectangle around them all.
  if (PicturePart all = around(parts_); area > all.area()) {
    area = all.area();
    parts_ = {all};
    area_before_ = {area};
  }
  constexpr double worth = 0.25;
  if (!(area < worth)) parts_.clear();
  constexpr std::size_t looks = 16'384;
  std::size_t seen = 0;
  for (std::size_t i = 0; i < looks; ++i) {
    Draws draw(s.seed, 0, material, i);
    seen += look_once(draw).has_value();
  }
  coverage_ = static_cast<double>(seen) / looks * (parts_.empty() ? 1 : area);
}

/// Moves a place of the picture into the parts, evenly; false where it is to be passed over: where parts overlap, others are there
/// as often.
bool PointDrawer::moved_into_parts(double& x, double& y, Draws& draw) const {
  const double at = x * area_before_.back();
  const auto k = std::min<std::size_t>(
      static_cast<std::size_t>(std::ranges::upper_bound(area_before_, at) - area_before_.begin()),
      parts_.size() - 1);
  const PicturePart& p = parts_[k];
  x = p.x + p.width * (at - (k > 0 ? area_before_[k - 1] : 0)) / p.area();
  y = p.y + p.height * y;
  const auto there = std::ranges::count_if(parts_, [&](const auto& o) { return o.holds(x, y); });
  return there <= 1 || draw.uniform() * static_cast<double>(there) < 1;
}

std::optional<PointDrawer::Seen> PointDrawer::look_once(Draws& draw) const {
  const Camera camera = draw_camera(scene_.view, draw);
  double x = draw.uniform(), y = draw.uniform();
  if (!parts_.empty() && !moved_into_parts(x, y, draw)) return {};
  const Ray seen = ray(camera, x, y, 1);
  if (std::ranges::none_of(bounds_, [&](const auto& b) { return passes_through(seen, b); }))
    return {};
  const auto hit = tracer_.closest(seen.origin, seen.direction);
  if (!hit || same_as_[hit->material] != material_) return {};
  const Direction to_viewer{-seen.direction.x, -seen.direction.y, -seen.direction.z};
  if (!(dot(hit->frame.z, to_viewer) > 0)) return {};
  return Seen{*hit, to_viewer};
}

std::optional<PointDrawer::Seen> PointDrawer::look(Draws& draw) const {
  if (coverage_ == 0) return {};
  for (std::size_t i = 0; i < most_looks; ++i)
    if (auto seen = look_once(draw)) return seen;
  return {};
}

double PointDrawer::near_peak(const Seen& seen) const {
  double nearest = 0;
  for (const auto& light : scene_.lights) {
    Direction l;
    if (const auto* d = std::get_if<DirectionalLight>(&light)) {
      const auto* fixed = std::get_if<DirectionalLight::Fixed>(&d->from);
      if (!fixed) continue;
      l = fixed->direction;
    } else if (const auto* r = std::get_if<RectangleLight>(&light)) {
      l = direction(r->center - seen.hit.position);
    } else {
      continue;
    }
    const auto a = angles_of(seen.hit.frame, l, seen.to_viewer);
    if (!(a.nol > 0)) continue;
    for (const double w : widths_) {
      const double width2 = w * w, peak = width2 / (width2 + a.sin2_theta_h);
      nearest = std::max(nearest, peak * peak);
    }
  }
  return nearest;
}

LitPoints PointDrawer::draw(std::uint64_t stream, std::size_t first, std::size_t count) const {
  struct One {
    Seen seen;
    std::vector<Incident> light;
  };
  std::vector<std::optional<One>> all(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    Draws draws(scene_.seed, stream, material_, first + i);
    auto seen = look(draws);
    if (!seen) return;
    if ((first + i) % 2 == 1) {
      double sum = near_peak(*seen) + 1e-3;
      for (int k = 1; k < candidates; ++k) {
        const auto other = look(draws);
        if (!other) continue;
        const double weight = near_peak(*other) + 1e-3;
        sum += weight;
        if (draws.uniform() * sum < weight) seen = other;
      }
    }
    One& one = all[i].emplace(One{*seen, {}});
    lighting_.incident(seen->hit.position, seen->hit.frame, seen->to_viewer, widths_, directions_,
                       draws, one.light);
  });
  std::erase_if(all, [](const auto& one) { return !one; });
  LitPoints p;
  p.count = all.size();
  const bool has_sky = std::ranges::any_of(
      scene_.lights, [](const Light& l) { return std::holds_alternative<EnvironmentLight>(l); });
  for (const bool of_sky : {false, true}) {
    p.sky = p.point.size();
    for (std::size_t i = 0; i < p.count; ++i) {
      const Seen& seen_here = all[i]->seen;
      for (const auto& light : all[i]->light) {
        if (light.of_sky != of_sky) continue;
        const auto a = angles_of(seen_here.hit.frame, light.direction, seen_here.to_viewer);
        if (!(a.nol > 0)) continue;
        p.angles.push_back(a);
        p.point.push_back(static_cast<std::uint32_t>(i));
        p.weight.push_back(light.weight);
      }
    }
  }
  for (std::size_t i = 0; has_sky && i < p.count; ++i)
    p.view.push_back(sky_view(all[i]->seen.hit.frame, all[i]->seen.to_viewer));
  return p;
}

}  // namespace gonio::scene
