#include "scene/trace/tracer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include <embree3/rtcore.h>
#include <fmt/format.h>

namespace gonio::scene {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

Vector vector_of(const float* v) {
  return {double{v[0]}, double{v[1]}, double{v[2]}};
}
Direction opposite(const Direction& d) {
  return {-d.x, -d.y, -d.z};
}
double greatest(const Vector& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

struct Release {
  void operator()(RTCDevice d) const { rtcReleaseDevice(d); }
  void operator()(RTCScene s) const { rtcReleaseScene(s); }
  void operator()(RTCGeometry g) const { rtcReleaseGeometry(g); }
};
template <class Handle>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Release>;

/// Ray in double, where the callbacks for spheres find it.
struct Context : RTCIntersectContext {
  Vector origin;
  Vector direction;
  double least = 0;

  Context(const Vector& o, const Direction& d, double from)
      : RTCIntersectContext(), origin(o), direction(vector_of(d)), least(from) {
    rtcInitIntersectContext(this);
  }
  RTCRay ray(double distance) const {
    RTCRay r{};
    r.org_x = static_cast<float>(origin.x);
    r.org_y = static_cast<float>(origin.y);
    r.org_z = static_cast<float>(origin.z);
    r.dir_x = static_cast<float>(direction.x);
    r.dir_y = static_cast<float>(direction.y);
    r.dir_z = static_cast<float>(direction.z);
    r.tfar = static_cast<float>(distance);
    r.mask = ~0U;
    return r;
  }
};

/// Way to the first point of a sphere that lies further than `least`; infinite where there is none.
double way_to(const Sphere& s, const Context& c) {
  // |o + t d − c|² = r², of the point closest to the centre: t₀ ± √(r² − |o + t₀ d − c|²)
  const Vector from = c.origin - s.center;
  const double middle = -dot(from, c.direction);
  const Vector closest = from + middle * c.direction;
  const double rest = s.radius * s.radius - dot(closest, closest);
  if (!(rest >= 0)) return infinite;
  const double half = std::sqrt(rest);
  return middle - half > c.least   ? middle - half
         : middle + half > c.least ? middle + half
                                   : infinite;
}

/// Spheres as Embree is given them: as geometry of our own, since its own are met in float, where a normal keeps three digits.
struct Spheres {
  std::vector<std::pair<Sphere, std::size_t>> all;  ///< and the object's number
  double margin = 0;  ///< of the boxes around them: what float may round rays by
};

void bounds(const RTCBoundsFunctionArguments* a) {
  const auto& spheres = *static_cast<const Spheres*>(a->geometryUserPtr);
  const Sphere& s = spheres.all[a->primID].first;
  const double half = s.radius + spheres.margin;
  RTCBounds& b = *a->bounds_o;
  b.lower_x = static_cast<float>(s.center.x - half);
  b.lower_y = static_cast<float>(s.center.y - half);
  b.lower_z = static_cast<float>(s.center.z - half);
  b.upper_x = static_cast<float>(s.center.x + half);
  b.upper_y = static_cast<float>(s.center.y + half);
  b.upper_z = static_cast<float>(s.center.z + half);
}

template <class Arguments>
double way_to_sphere(const Arguments* a) {
  return way_to(static_cast<const Spheres*>(a->geometryUserPtr)->all[a->primID].first,
                *static_cast<const Context*>(a->context));
}
void meet(const RTCIntersectFunctionNArguments* a) {
  if (a->valid[0] == 0) return;
  RTCRayN* const r = RTCRayHitN_RayN(a->rayhit, a->N);
  RTCHitN* const h = RTCRayHitN_HitN(a->rayhit, a->N);
  const auto t = static_cast<float>(way_to_sphere(a));
  if (!(t < RTCRayN_tfar(r, a->N, 0))) return;
  RTCRayN_tfar(r, a->N, 0) = t;
  RTCHitN_geomID(h, a->N, 0) = a->geomID;
  RTCHitN_primID(h, a->N, 0) = a->primID;
}
void shade(const RTCOccludedFunctionNArguments* a) {
  if (a->valid[0] == 0) return;
  float& t = RTCRayN_tfar(a->ray, a->N, 0);
  if (way_to_sphere(a) < double{t}) t = -std::numeric_limits<float>::infinity();
}

/// Greatest coordinate of the cameras.
double reach(const View& view) {
  if (const auto* camera = std::get_if<Camera>(&view)) return greatest(camera->position);
  const auto& o = std::get<Orbit>(view);
  return greatest(o.target) + o.distance;
}

/// Normal, leant over to where it faces a viewer by a thousandth at least: at the outline of a smooth mesh of few
/// triangles it may not.
Direction facing(const Direction& normal, const Direction& viewer) {
  constexpr double least = 1e-3;
  const double cosine = dot(normal, viewer);
  if (cosine >= least) return normal;
  return direction(vector_of(normal) + (least - cosine) * vector_of(viewer));
}

}  // namespace

struct Tracer::Objects {
  const Scene& scene;
  std::vector<double> turns;  // by material
  Spheres spheres;
  std::vector<std::size_t> object;  // by Embree's geometry; of the spheres, which come first, none
  double step = 0;
  Owned<RTCDevice> device{rtcNewDevice(nullptr)};
  Owned<RTCScene> embree;

  Objects(const Scene& s, std::span<const double> turn)
      : scene(s), turns(turn.begin(), turn.end()) {
    turns.resize(scene.materials.size());
    if (!device) throw std::runtime_error("Embree found no device");
    embree.reset(rtcNewScene(device.get()));
    rtcSetSceneFlags(embree.get(), RTC_SCENE_FLAG_ROBUST);
    double world = reach(scene.view);
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
      const auto& shape = scene.objects[i].shape;
      if (const auto* sphere = std::get_if<Sphere>(&shape)) {
        spheres.all.emplace_back(*sphere, i);
        const double far = greatest(sphere->center) + sphere->radius;
        step = std::max(step, 1e-12 * far);
        world = std::max(world, far);
      } else {
        double far = 0;
        for (const auto& p : std::get<MeshShape>(shape).mesh->positions)
          far = std::max(far, greatest(vector_of(p.data())));
        step = std::max(step, 1e-6 * far);
        world = std::max(world, far);
      }
    }
    spheres.margin = 1e-6 * world;
    add_spheres();
    for (std::size_t i = 0; i < scene.objects.size(); ++i)
      if (const auto* mesh = std::get_if<MeshShape>(&scene.objects[i].shape)) add(*mesh->mesh, i);
    rtcCommitScene(embree.get());
    if (const auto e = rtcGetDeviceError(device.get()); e != RTC_ERROR_NONE)
      throw std::runtime_error(fmt::format("Embree: error {}", static_cast<int>(e)));
  }

  void attach(const Owned<RTCGeometry>& g, std::size_t of) {
    rtcCommitGeometry(g.get());
    rtcAttachGeometryByID(embree.get(), g.get(), static_cast<unsigned>(object.size()));
    object.push_back(of);
  }
  void add_spheres() {
    const Owned<RTCGeometry> g(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_USER));
    rtcSetGeometryUserPrimitiveCount(g.get(), static_cast<unsigned>(spheres.all.size()));
    rtcSetGeometryUserData(g.get(), &spheres);
    rtcSetGeometryBoundsFunction(
        g.get(), [](const RTCBoundsFunctionArguments* a) { bounds(a); }, nullptr);
    rtcSetGeometryIntersectFunction(g.get(), meet);
    rtcSetGeometryOccludedFunction(g.get(), shade);
    attach(g, 0);
  }
  template <class Element>
  static void fill(const Owned<RTCGeometry>& g,
                   RTCBufferType type,
                   RTCFormat format,
                   const std::vector<Element>& from) {
    void* to = rtcSetNewGeometryBuffer(g.get(), type, 0, format, sizeof(Element), from.size());
    if (to) std::ranges::copy(from, static_cast<Element*>(to));
  }
  void add(const Mesh& m, std::size_t of) {
    const Owned<RTCGeometry> g(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
    fill(g, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, m.positions);
    fill(g, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, m.triangles);
    attach(g, of);
  }

  Hit sphere_hit(const Context& ray, std::size_t k) const {
    const auto& [sphere, number] = spheres.all[k];
    const Direction out =
        direction(ray.origin + way_to(sphere, ray) * ray.direction - sphere.center);
    const bool within = dot(vector_of(out), ray.direction) > 0;
    return hit(number, sphere.center + sphere.radius * vector_of(out), within ? opposite(out) : out,
               Vector{out.z, 0, -out.x}, within);
  }
  Hit mesh_hit(const Context& ray, const RTCHit& h) const {
    const std::size_t number = object[h.geomID];
    const Mesh& m = *std::get<MeshShape>(scene.objects[number].shape).mesh;
    const auto& corners = m.triangles[h.primID];
    const std::array weight{1 - double{h.u} - double{h.v}, double{h.u}, double{h.v}};
    const auto between = [&](const auto& of_vertices) {
      Vector sum;
      for (std::size_t k = 0; k < 3; ++k)
        sum = sum + weight[k] * vector_of(of_vertices[corners[k]].data());
      return sum;
    };
    const Vector across{double{h.Ng_x}, double{h.Ng_y}, double{h.Ng_z}};
    Vector normal = between(m.normals);
    if (!(length(normal) > 0)) normal = across;
    const bool within = dot(across, normal) * dot(across, ray.direction) > 0;
    if (within) normal = -1 * normal;
    const bool has_tangents = !m.tangents.empty();
    const bool mirrored = has_tangents && m.tangents[corners[0]][3] < 0;
    return hit(number, between(m.positions),
               facing(direction(normal), direction(-1 * ray.direction)),
               has_tangents ? between(m.tangents) : Vector{}, within != mirrored);
  }
  /// \param mirrored  the bitangent, towards which a turn goes, is −normal × tangent
  Hit hit(std::size_t number,
          const Vector& position,
          const Direction& normal,
          const Vector& tangent,
          bool mirrored) const {
    const std::size_t material = scene.objects[number].material;
    const double turn = mirrored ? -turns[material] : turns[material];
    return {position, frame_along(normal, tangent, turn), number, material};
  }
};

Tracer::Tracer(const Scene& scene, std::span<const double> turns)
    : objects_(std::make_unique<const Objects>(scene, turns)) {}
Tracer::~Tracer() = default;

std::optional<Hit> Tracer::closest(const Vector& origin, const Direction& d) const {
  Context context(origin, d, 0);
  RTCRayHit h{};
  h.ray = context.ray(infinite);
  h.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(objects_->embree.get(), &context, &h);
  if (h.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return h.hit.geomID == 0 ? objects_->sphere_hit(context, h.hit.primID)
                           : objects_->mesh_hit(context, h.hit);
}

bool Tracer::occluded(const Vector& from,
                      const Direction& normal,
                      const Direction& d,
                      double distance) const {
  const double step = objects_->step;
  Context context(from + step * vector_of(normal), d, 0);
  RTCRay r = context.ray(distance - step);
  rtcOccluded1(objects_->embree.get(), &context, &r);
  return r.tfar < 0;
}

}  // namespace gonio::scene
