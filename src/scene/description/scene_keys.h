#pragma once
/// \file
/// Keys of gonio.scene/1: what reading and the schema follow from (base/describe.h).

#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "base/describe.h"
#include "brdf/model/settings_form.h"
#include "scene/description/scene.h"

namespace gonio::scene {

inline constexpr double farthest = 1e9;  ///< [m]
inline constexpr double brightest = 1e12;
inline constexpr Numbers places{-farthest, farthest}, sizes{0, farthest, true},
    intensities{0, brightest}, parts{0, 1, true, true};

/// Object as the file has it.
struct NamedObject {
  std::string material;
  std::variant<Sphere, MeshShape> shape;
};

/// Scene as its file has it.
struct SceneFile {
  Scene scene;
  std::vector<NamedObject> objects;
};

}  // namespace gonio::scene

namespace gonio {

// --- Materials ---

template <>
inline constexpr auto description<scene::FromSpec> = FieldList{
    Field{"model", &scene::FromSpec::model, "spec of a model, or a preset", not_empty},
    Field{"parameters", &scene::FromSpec::parameters,
          "a number or one per channel each; metal: a symbol such as Au; else their defaults",
          Entries{0, 100}, or_default}};
template <>
inline constexpr auto description<scene::FromFit> =
    FieldList{Field{"fit", &scene::FromFit::path, "path of a fit's document", not_empty}};
template <>
inline constexpr auto description<scene::FromGltf> =
    FieldList{Field{"gltf", &scene::FromGltf::path, "path of a glTF 2.0 file", not_empty},
              Field{"material", &scene::FromGltf::material,
                    "name of its material: factors without textures", not_empty}};
template <>
inline constexpr auto description<scene::Material> = FieldList{by_key(&scene::Material::from)};

// --- Objects ---

template <>
inline constexpr auto description<scene::Sphere> =
    FieldList{Field{"center", "m", &scene::Sphere::center, "", scene::places, or_default},
              Field{"radius", "m", &scene::Sphere::radius, "", scene::sizes, or_default}};
template <>
inline constexpr auto description<scene::MeshShape::Node> = FieldList{Field{
    "node", &scene::MeshShape::Node::name, "name of a node: its mesh where it stands", not_empty}};
template <>
inline constexpr auto description<scene::MeshShape::OfName> = FieldList{Field{
    "mesh", &scene::MeshShape::OfName::name, "name of a mesh, in its own coordinates", not_empty}};
template <>
inline constexpr auto description<scene::MeshShape> =
    FieldList{Field{"gltf", &scene::MeshShape::path, "path of a glTF 2.0 file", not_empty},
              by_key(&scene::MeshShape::part)};
template <>
inline constexpr auto description<scene::NamedObject> =
    FieldList{Field{"material", &scene::NamedObject::material,
                    "name of one of the scene's materials", not_empty},
              by_name("shape", &scene::NamedObject::shape, "sphere", "mesh")};

// --- Lights ---

template <>
struct Description<scene::AngleRange> {
  static constexpr auto fields() {
    return FieldList{field("elevation_deg", "°", &scene::AngleRange::elevation_deg,
                           "above the horizon", Numbers{-90, 90}),
                     field("azimuth_deg", "°", &scene::AngleRange::azimuth_deg,
                           "from +z towards +x", Numbers{-360, 360})};
  }
  static void check(scene::AngleRange& a, Demand expect) {
    const auto [low, high] = a.azimuth_deg;
    expect(a.elevation_deg[0] <= a.elevation_deg[1], "elevation_deg", "[low, high]");
    expect(low <= high && high - low <= 360, "azimuth_deg", "[low, high], a circle at most");
  }
};
template <>
struct Description<scene::DirectionalLight::Fixed> {
  static constexpr auto fields() {
    return FieldList{field("direction", &scene::DirectionalLight::Fixed::direction,
                           "towards the light, of any length but 0", scene::places)};
  }
  static void check(scene::DirectionalLight::Fixed& l, Demand expect) {
    const Vector v{l.direction.x, l.direction.y, l.direction.z};
    expect(length(v) > 0, "direction", "a vector that is not 0");
    l.direction = direction(v);
  }
};
template <>
struct Description<scene::DirectionalLight::Ranging> {
  static constexpr auto fields() {
    return FieldList{field("direction_range", &scene::DirectionalLight::Ranging::range,
                           "directions towards the light")};
  }
};
template <>
inline constexpr auto description<scene::DirectionalLight> =
    FieldList{by_key(&scene::DirectionalLight::from),
              Field{"irradiance", &scene::DirectionalLight::irradiance,
                    "of a surface that faces the light", scene::intensities}};
template <>
struct Description<scene::RectangleLight> {
  static constexpr auto fields() {
    using L = scene::RectangleLight;
    return FieldList{
        field("center", "m", &L::center, "", scene::places),
        field("u", "m", &L::u, "from the centre to the middle of an edge", scene::places),
        field("v", "m", &L::v, "the same to the next edge; u × v points to where it shines",
              scene::places),
        field("radiance", &L::radiance, "", scene::intensities)};
  }
  static void check(scene::RectangleLight& l, Demand expect) {
    expect(length(l.u) > 0, "u", "a vector that is not 0");
    expect(std::abs(dot(l.u, l.v)) <= 1e-6 * length(l.u) * length(l.v) && length(l.v) > 0, "v",
           "a vector perpendicular to u that is not 0");
  }
};
template <>
inline constexpr auto description<scene::EnvironmentLight> = FieldList{
    Field{"path", &scene::EnvironmentLight::path,
          "OpenEXR file, a map over longitude and latitude, +y its top row, +z its middle",
          not_empty},
    Field{"scale", &scene::EnvironmentLight::scale, "factor of its radiance", scene::intensities,
          or_default}};
template <>
inline constexpr auto description<scene::Light> =
    FieldList{by_name("type", itself, "directional", "rectangle", "environment")};

// --- View, tolerance ---

template <>
struct Description<scene::Camera> {
  static constexpr auto fields() {
    using C = scene::Camera;
    return FieldList{
        field("position", "m", &C::position, "", scene::places),
        field("target", "m", &C::target, "", scene::places),
        field("up", &C::up, "direction that is up in the picture", scene::places, or_default),
        field("fov_deg", "°", &C::fov_deg, "angle of the picture's height",
              Numbers{0, 180, true, true}, or_default)};
  }
  static void check(scene::Camera& c, Demand expect) {
    const Vector forward = c.target - c.position;
    expect(length(forward) > 0, "target", "a place other than the camera's");
    expect(length(cross(forward, c.up)) > 1e-9 * length(forward) * length(c.up), "up",
           "a vector that is not 0 and not along the view");
  }
};
template <>
inline constexpr auto description<scene::Orbit> =
    FieldList{Group{"orbit", "cameras around a target, y up",
                    Field{"target", "m", &scene::Orbit::target, "", scene::places},
                    Field{"distance", "m", &scene::Orbit::distance, "", scene::sizes},
                    inlined(&scene::Orbit::from)}};
template <>
inline constexpr auto description<scene::View> = FieldList{by_key(itself)};
template <>
struct Description<scene::Tolerance> {
  static constexpr auto fields() {
    using T = scene::Tolerance;
    constexpr Numbers amounts{0, scene::brightest};
    return FieldList{
        field("metric", &T::metric, "difference of a sample from the reference"),
        field("limit", &T::limit, "kept by the upper confidence bound of the quantile", amounts),
        field("max", &T::max, "passed by no sample", amounts),
        field("quantile", &T::quantile, "of the samples' differences", scene::parts, or_default),
        field("confidence", &T::confidence, "of the bound", scene::parts, or_default)};
  }
  static void check(scene::Tolerance& t, Demand expect) {
    expect(t.max >= t.limit, "max", "a number from limit on");
  }
};

template <>
struct Description<scene::SceneFile> {
  template <class Member>
  static constexpr auto of_scene(Member member) {
    return at(&scene::SceneFile::scene, member);
  }
  static constexpr auto fields() {
    using S = scene::Scene;
    return FieldList{
        constant_text("schema", "gonio.scene/1"),
        field("materials", by_name(of_scene(&S::materials)), "by their names", Entries{1, 1000}),
        field("objects", &scene::SceneFile::objects, "what is seen", Entries{1, 10'000}),
        field("lights", of_scene(&S::lights), "one environment at most", Entries{1, 1000}),
        field("view", of_scene(&S::view), "a camera, or a range of them"),
        field("exposure", of_scene(&S::exposure), "factor of radiance, 1 being white then",
              Numbers{0, scene::brightest, true}, or_default),
        field("tolerance", of_scene(&S::tolerance), "what a plan has to keep", or_default),
        field("budget_ns", "ns", if_there(of_scene(&S::budget_ns)),
              "mean time of a visible sample that a plan has to keep", Numbers{0, 1e12, true}),
        field("seed", of_scene(&S::seed), "of everything random", or_default)};
  }
};

}  // namespace gonio
