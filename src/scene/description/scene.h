#pragma once
/// \file
/// Scene: materials, objects, lights, views and the tolerance that a plan has to keep; gonio.scene/1 resolved.  y is up, lengths
/// in metres, light in any unit that the exposure is one over.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/names.h"
#include "brdf/model/given_parameter.h"
#include "brdf/model/model.h"
#include "geometry/direction.h"
#include "geometry/vector.h"
#include "image/environment.h"
#include "scene/description/gltf_material.h"
#include "scene/description/mesh.h"

namespace gonio::scene {

// --- Materials ---

/// Model by its spec, or a preset; files of its functions lie beside the scene.  "coat:" before its last lobe puts that lobe on all others, by facet (brdf/formula/coat.h).
struct FromSpec {
  std::string model;
  GivenParameters parameters;
};
/// Model of a fit's document.
struct FromFit {
  std::string path;
};
/// Material of a glTF file.
struct FromGltf {
  std::string path, material;
};

struct Material {
  std::string name;
  std::variant<FromSpec, FromFit, FromGltf> from;  ///< as the file says, paths too
  std::variant<BoundModel, GltfMaterial> is;       ///< a model has three channels
  bool coated = false;                             ///< the model's last lobe lies on all others
};

// --- Objects ---

struct Sphere {
  Vector center;
  double radius = 1;
};
/// Mesh of a glTF file: as a node of that name places it, or in its own coordinates.
struct MeshShape {
  struct Node {
    std::string name;
  };
  struct OfName {
    std::string name;
  };
  std::string path;
  std::variant<Node, OfName> part;
  std::shared_ptr<const Mesh> mesh;  ///< shared by objects of the same part
};
struct Object {
  std::variant<Sphere, MeshShape> shape;
  std::size_t material = 0;  ///< of Scene::materials
};

// --- Lights ---

/// Ranges of directions, both ends included.  \see direction_of
struct AngleRange {
  std::array<double, 2> elevation_deg{}, azimuth_deg{};
};
/// Direction of an elevation above the horizon, and an azimuth from +z towards +x [°].
Direction direction_of(double elevation_deg, double azimuth_deg);

struct DirectionalLight {
  struct Fixed {
    Direction direction;  ///< towards the light
  };
  struct Ranging {
    AngleRange range;
  };
  std::variant<Fixed, Ranging> from;
  Rgb irradiance{};  ///< of a surface that faces the light
};
/// Points center + s u + t v, s and t in [−1, 1]; u and v are perpendicular.  It shines to the side that u × v points to.
struct RectangleLight {
  Vector center, u, v;
  Rgb radiance{};
};
struct EnvironmentLight {
  std::string path;
  double scale = 1;
  Environment map;  ///< radiance without the scale; z up there

  /// Radiance that comes from a direction of the scene; the map's middle is +z, its left half +x.
  Rgb radiance(const Direction&) const;
  /// Direction in the map of one of the scene, and back.
  static Direction into_map(const Direction& d) { return {d.z, d.x, d.y}; }
  static Direction out_of_map(const Direction& d) { return {d.y, d.z, d.x}; }
};
using Light = std::variant<DirectionalLight, RectangleLight, EnvironmentLight>;

// --- View, tolerance ---

struct Camera {
  Vector position, target, up{0, 1, 0};
  double fov_deg = 40;  ///< of the picture's height
};
/// Cameras at a distance around a target, y up.
struct Orbit {
  Vector target;
  double distance = 0;
  AngleRange from;  ///< of the directions from the target to the cameras
};
using View = std::variant<Camera, Orbit>;

/// Difference of a pixel from that of the reference: CIELAB under D65 of what is exposed and clipped to [0, 1], or relative to the
/// reference's radiance.
enum class Metric { delta_e_2000, relative };

/// Bound that a plan keeps: the upper confidence bound of the quantile keeps the limit, no sample passes the greatest.
struct Tolerance {
  Metric metric = Metric::delta_e_2000;
  double quantile = 0.99, limit = 1, max = 4, confidence = 0.95;
  bool operator==(const Tolerance&) const = default;
};

struct Scene {
  std::string path;
  /// Name of all that a plan depends on.  It is the SHA-256 of a list, a line each, of the SHA-256 of the scene's file and of each file
  /// that it names, in the order in which it does.  Bytes, and not what they are read as: a value that a later version comes to
  /// read cannot be forgotten in them, and `sha256sum` tells which file is another.  Not paths: a scene that is moved as a whole
  /// stays the same.  A scene that is only laid out anew is another, which costs a new plan and hides nothing.
  std::string sha256;
  std::vector<Material> materials;  ///< in the file's order
  std::vector<Object> objects;
  std::vector<Light> lights;
  View view;
  double exposure = 1;  ///< what radiance is multiplied with: 1 is white then
  Tolerance tolerance;
  std::optional<double> budget_ns;  ///< mean time of a visible sample [ns]
  std::uint64_t seed = 1;
};

/// Scene of a file, with all that it names; paths are relative to its folder.  Whatever is wrong is bad_input: the file, the place
/// as a JSON pointer [RFC 6901], what was found and what is expected there.
Scene read_scene(const std::string& path);
/// JSON Schema of such a file.
std::string scene_schema();

}  // namespace gonio::scene

template <>
inline constexpr std::array<std::string_view, 2> gonio::names_of<gonio::scene::Metric>{
    "delta_e_2000", "relative"};
