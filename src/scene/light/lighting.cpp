#include "scene/light/lighting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "brdf/formula/ndf_ggx.h"
#include "geometry/half_difference.h"
#include "integrate/scattering/visible_facets.h"

namespace gonio::scene {
namespace {

using Square = std::array<double, 2>;  ///< point of the unit square

bool is_black(const Rgb& c) {
  return c[0] == 0 && c[1] == 0 && c[2] == 0;
}

/// Directions that GGX reflects a viewer to: mirrored by visible normals.
class Lobe {
 public:
  Lobe(double alpha, const Direction& viewer)
      : alpha_(alpha),
        viewer_(viewer),
        area_((viewer.z + std::hypot(alpha * viewer.x, alpha * viewer.y, viewer.z)) / 2) {}

  Direction draw(const Square& point) const {
    const auto m = GgxFacets(alpha_, alpha_)({-viewer_.x, -viewer_.y, -viewer_.z}, area_, point);
    const Direction h = direction(Vector{m.x, m.y, m.z});
    const double c = 2 * dot(viewer_, h);
    return {c * h.x - viewer_.x, c * h.y - viewer_.y, c * h.z - viewer_.z};
  }
  /// D(h)/(4 σ(v)) [1/sr]
  double density(const Direction& l) const {
    const auto d = Ggx<double>(std::array{alpha_})(angles({l, viewer_}));
    return d.num / d.den / (4 * area_);
  }

 private:
  double alpha_;
  Direction viewer_;
  double area_;
};

/// Part of [0, 1) that lies from `low` on, `size` long, as [0, 1).
double stretched(double u, double low, double size) {
  return std::min((u - low) / size, std::nextafter(1.0, 0.0));
}

}  // namespace

/// Point of a surface, as lights see it.
class Lighting::Point {
 public:
  Point(const Vector& p, const Frame& f, const Direction& viewer, std::span<const double> widths)
      : position(p), frame(f) {
    for (const double w : widths) lobes.emplace_back(w, viewer);
  }
  Vector position;
  Frame frame;
  std::vector<Lobe> lobes;
};

/// Points of the unit square: those of Hammersley that are a call's, shifted by what was drawn.
class Lighting::Spread {
 public:
  Spread(std::size_t each, const Part& part, Draws& draw)
      : count(each),
        first_(part.index * each),
        all_(static_cast<double>(each * part.all)),
        shift_{draw.uniform(), draw.uniform()} {}

  std::size_t count;
  Square operator()(std::size_t i) const {
    Square p = hammersley(static_cast<std::uint32_t>(first_ + i), all_);
    for (std::size_t k = 0; k < 2; ++k) {
      p[k] += shift_[k];
      p[k] -= std::floor(p[k]);
    }
    return p;
  }

 private:
  std::size_t first_;
  double all_;
  Square shift_;
};

/// Rectangle as seen from a point.
class Lighting::FromRectangle {
 public:
  static constexpr bool is_everywhere = false;

  FromRectangle(const Rectangle& r, const Vector& from)
      : r_(r), to_(r.light.center - from), height_(-dot(to_, vector_of(r.normal))) {}

  /// False behind it.
  bool shines() const { return height_ > 0; }
  Direction draw(const Square& point) const {
    return direction(to_ + (2 * point[0] - 1) * r_.light.u + (2 * point[1] - 1) * r_.light.v);
  }
  struct Light {
    Rgb radiance{};
    double density = 0;  ///< of draw [1/sr]
    double distance = 0;
  };
  Light towards(const Direction& d) const {
    const double cosine = -dot(d, r_.normal);
    if (!(cosine > 0)) return {};
    const double t = height_ / cosine;
    const Vector across = t * vector_of(d) - to_;
    const auto beyond = [&](const Vector& side) {
      return std::abs(dot(across, side)) > dot(side, side);
    };
    if (beyond(r_.light.u) || beyond(r_.light.v)) return {};
    return {r_.light.radiance, t * t / (r_.area * cosine), t};
  }

 private:
  const Rectangle& r_;
  Vector to_;
  double height_;  ///< of the point above the rectangle
};

class Lighting::FromSky {
 public:
  static constexpr bool is_everywhere = true;

  explicit FromSky(const Sky& s) : s_(s), map_(s.light->map) {}

  bool shines() const { return !s_.rows.empty(); }
  Direction draw(const Square& point) const {
    const auto row = std::ranges::upper_bound(s_.rows, point[0]);
    const auto j = std::min(static_cast<std::size_t>(row - s_.rows.begin()), map_.height - 1);
    const auto texels = std::span(s_.within).subspan(j * map_.width, map_.width);
    const auto texel = std::ranges::upper_bound(texels, point[1]);
    const auto i = std::min(static_cast<std::size_t>(texel - texels.begin()), map_.width - 1);
    const double down = stretched(point[0], row_before(j), row_share(j));
    const double right = stretched(point[1], before(i, j), share(i, j));
    const double top = std::cos(map_.theta(static_cast<double>(j)));
    const double bottom = std::cos(map_.theta(static_cast<double>(j + 1)));
    return EnvironmentLight::out_of_map(direction(std::acos(top + down * (bottom - top)),
                                                  map_.phi(static_cast<double>(i) + right)));
  }
  struct Light {
    Rgb radiance{};
    double density = 0;
    double distance = std::numeric_limits<double>::infinity();
  };
  Light towards(const Direction& d) const {
    const auto [i, j] = map_.texel_at(EnvironmentLight::into_map(d));
    Rgb radiance = map_.texel(i, j);
    for (double& v : radiance) v *= s_.light->scale;
    return {radiance, row_share(j) * share(i, j) / solid_angle(map_, j)};
  }
  /// Solid angle of each texel of a row [sr].
  static double solid_angle(const Environment& map, std::size_t j) {
    const double height = std::cos(map.theta(static_cast<double>(j))) -
                          std::cos(map.theta(static_cast<double>(j + 1)));
    return height * 2 * std::numbers::pi / static_cast<double>(map.width);
  }

 private:
  double row_before(std::size_t j) const { return j > 0 ? s_.rows[j - 1] : 0; }
  double row_share(std::size_t j) const { return s_.rows[j] - row_before(j); }
  double before(std::size_t i, std::size_t j) const {
    return i > 0 ? double{s_.within[j * map_.width + i - 1]} : 0;
  }
  double share(std::size_t i, std::size_t j) const {
    return double{s_.within[j * map_.width + i]} - before(i, j);
  }

  const Sky& s_;
  const Environment& map_;
};

Lighting::Lighting(const Scene& scene, const Tracer* tracer) : tracer_(tracer) {
  for (const auto& light : scene.lights) {
    if (const auto* d = std::get_if<DirectionalLight>(&light)) {
      lights_.emplace_back(*d);
    } else if (const auto* r = std::get_if<RectangleLight>(&light)) {
      if (is_black(r->radiance)) continue;
      const Vector normal = cross(r->u, r->v);
      lights_.emplace_back(Rectangle{*r, direction(normal), 4 * length(normal)});
    } else {
      lights_.emplace_back(sky_of(std::get<EnvironmentLight>(light)));
    }
  }
}

Lighting::Sky Lighting::sky_of(const EnvironmentLight& light) {
  const auto& map = light.map;
  Sky s{&light, std::vector<double>(map.height), std::vector<float>(map.width * map.height)};
  double all = 0;
  for (std::size_t j = 0; j < map.height; ++j) {
    double row = 0;
    for (std::size_t i = 0; i < map.width; ++i) row += luminance(map.texel(i, j));
    double sum = 0;
    for (std::size_t i = 0; i < map.width && row > 0; ++i)
      s.within[j * map.width + i] =
          static_cast<float>(std::min((sum += luminance(map.texel(i, j))) / row, 1.0));
    s.within[(j + 1) * map.width - 1] = 1;
    s.rows[j] = all += row * FromSky::solid_angle(map, j);
  }
  if (!(all * light.scale > 0)) return {&light, {}, {}};
  for (double& r : s.rows) r /= all;
  return s;
}

void Lighting::add_from(const DirectionalLight& light,
                        const Point& at,
                        const Spread& spread,
                        std::vector<Incident>& out) const {
  const auto* fixed = std::get_if<DirectionalLight::Fixed>(&light.from);
  const auto drawn = [&] {
    const auto& [elevation, azimuth] = std::get<DirectionalLight::Ranging>(light.from).range;
    const auto [up, around] = spread(0);
    return direction_of(std::lerp(elevation[0], elevation[1], up),
                        std::lerp(azimuth[0], azimuth[1], around));
  };
  const Direction d = fixed ? fixed->direction : drawn();
  const double cosine = dot(d, at.frame.z);
  if (!(cosine > 0)) return;
  if (tracer_ &&
      tracer_->occluded(at.position, at.frame.z, d, std::numeric_limits<double>::infinity()))
    return;
  Incident& i = out.emplace_back(Incident{d, light.irradiance, false});
  for (double& v : i.weight) v *= cosine;
}

template <class Source>
void Lighting::add_from(const Source& source,
                        const Point& at,
                        const Spread& spread,
                        std::vector<Incident>& out) const {
  if (!source.shines()) return;
  const std::size_t lobes = at.lobes.size() + (Source::is_everywhere ? 1 : 0);
  const double of_light = lobes > 0 ? 0.5 : 1;
  const double of_lobe = (1 - of_light) / static_cast<double>(std::max<std::size_t>(lobes, 1));
  const auto drawn = [&](const Square& p) {
    const auto [u, v] = p;
    if (u < of_light) return at.frame.inside(source.draw({stretched(u, 0, of_light), v}));
    const double rest = u - of_light;
    const auto k = std::min(static_cast<std::size_t>(rest / of_lobe), lobes - 1);
    const Square point{stretched(rest, static_cast<double>(k) * of_lobe, of_lobe), v};
    return k < at.lobes.size() ? at.lobes[k].draw(point) : cosine_direction({v, point[0]});
  };
  for (std::size_t i = 0; i < spread.count; ++i) {
    const Direction l = drawn(spread(i));
    if (!(l.z > 0)) continue;
    const Direction d = at.frame.outside(l);
    const auto light = source.towards(d);
    if (is_black(light.radiance)) continue;
    double density = of_light * light.density;
    for (const auto& lobe : at.lobes) density += of_lobe * lobe.density(l);
    if constexpr (Source::is_everywhere) density += of_lobe * l.z / std::numbers::pi;
    if (tracer_ && tracer_->occluded(at.position, at.frame.z, d, light.distance)) continue;
    Incident& incident = out.emplace_back(Incident{d, light.radiance, Source::is_everywhere});
    for (double& w : incident.weight) w *= l.z / (static_cast<double>(spread.count) * density);
  }
}

void Lighting::incident(const Vector& position,
                        const Frame& frame,
                        const Direction& to_viewer,
                        std::span<const double> widths,
                        std::size_t count,
                        Draws& draw,
                        std::vector<Incident>& out,
                        Part part) const {
  const Direction viewer = frame.inside(to_viewer);
  if (!(viewer.z > 0)) return;
  const Point at(position, frame, viewer, widths);
  for (const auto& light : lights_) {
    const auto* d = std::get_if<DirectionalLight>(&light);
    const Spread spread(d ? 1 : count, part, draw);
    if (d)
      add_from(*d, at, spread, out);
    else if (const auto* r = std::get_if<Rectangle>(&light))
      add_from(FromRectangle(*r, position), at, spread, out);
    else
      add_from(FromSky(std::get<Sky>(light)), at, spread, out);
  }
}

}  // namespace gonio::scene
