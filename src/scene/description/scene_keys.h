#pragma once
/// \file
/// Keys of gonio.scene/1: what reading and the schema follow from (base/json/form.h).

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/json/form.h"
#include "brdf/model/settings_form.h"
#include "scene/description/scene.h"

namespace gonio::scene {

inline constexpr double farthest = 1e9;  ///< [m]
inline constexpr double brightest = 1e12;
inline constexpr Numbers places{-farthest, farthest}, sizes{0, farthest, true},
    intensities{0, brightest};

// --- Materials ---

template <class Form>
void keys(Form& f, FromSpec& m) {
  f.required("model", m.model, "spec of a model, or a preset");
  f.optional("parameters", m.parameters,
             "a number or one per channel each; metal: a symbol such as Au; else their defaults",
             Entries{0, 100});
}
template <class Form>
void keys(Form& f, FromFit& m) {
  f.required("fit", m.path, "path of a fit's document");
}
template <class Form>
void keys(Form& f, FromGltf& m) {
  f.required("gltf", m.path, "path of a glTF 2.0 file");
  f.required("material", m.material, "name of its material: factors without textures");
}
template <class Form>
void keys(Form& f, Material& m) {
  f.by_key(m.from, {"model", "fit", "gltf"});
}

// --- Objects ---

/// Object as the file has it.
struct NamedObject {
  std::string material;
  std::variant<Sphere, MeshShape> shape;
};
template <class Form>
void keys(Form& f, Sphere& s) {
  f.optional("center", s.center, "[m]", places);
  f.optional("radius", s.radius, "[m]", sizes);
}
template <class Form>
void keys(Form& f, MeshShape::Node& n) {
  f.required("node", n.name, "name of a node: its mesh where it stands");
}
template <class Form>
void keys(Form& f, MeshShape::OfName& n) {
  f.required("mesh", n.name, "name of a mesh, in its own coordinates");
}
template <class Form>
void keys(Form& f, MeshShape& m) {
  f.required("gltf", m.path, "path of a glTF 2.0 file");
  f.by_key(m.part, {"node", "mesh"});
}
template <class Form>
void keys(Form& f, NamedObject& o) {
  f.required("material", o.material, "name of one of the scene's materials");
  f.by_name("shape", o.shape, {"sphere", "mesh"});
}

// --- Lights ---

template <class Form>
void keys(Form& f, AngleRange& a) {
  f.required("elevation_deg", a.elevation_deg, "above the horizon [°]", Numbers{-90, 90});
  f.required("azimuth_deg", a.azimuth_deg, "from +z towards +x [°]", Numbers{-360, 360});
  const auto [low, high] = a.azimuth_deg;
  f.expect(a.elevation_deg[0] <= a.elevation_deg[1], "elevation_deg", "[low, high]");
  f.expect(low <= high && high - low <= 360, "azimuth_deg", "[low, high], a circle at most");
}
template <class Form>
void keys(Form& f, DirectionalLight::Fixed& l) {
  Vector v{0, 1, 0};
  f.required("direction", v, "towards the light, of any length but 0", places);
  f.expect(length(v) > 0, "direction", "a vector that is not 0");
  l.direction = direction(v);
}
template <class Form>
void keys(Form& f, DirectionalLight::Ranging& l) {
  f.required("direction_range", l.range, "directions towards the light");
}
template <class Form>
void keys(Form& f, DirectionalLight& l) {
  f.by_key(l.from, {"direction", "direction_range"});
  f.required("irradiance", l.irradiance, "of a surface that faces the light", intensities);
}
template <class Form>
void keys(Form& f, RectangleLight& l) {
  f.required("center", l.center, "[m]", places);
  f.required("u", l.u, "from the centre to the middle of an edge [m]", places);
  f.required("v", l.v, "the same to the next edge; u × v points to where it shines", places);
  f.required("radiance", l.radiance, "", intensities);
  f.expect(length(l.u) > 0, "u", "a vector that is not 0");
  f.expect(std::abs(dot(l.u, l.v)) <= 1e-6 * length(l.u) * length(l.v) && length(l.v) > 0, "v",
           "a vector perpendicular to u that is not 0");
}
template <class Form>
void keys(Form& f, EnvironmentLight& l) {
  f.required("path", l.path,
             "OpenEXR file, a map over longitude and latitude, +y its top row, +z its middle");
  f.optional("scale", l.scale, "factor of its radiance", intensities);
}
/// Light as a list has it.
struct NamedLight {
  Light light;
};
template <class Form>
void keys(Form& f, NamedLight& l) {
  f.by_name("type", l.light, {"directional", "rectangle", "environment"});
}

// --- View, tolerance ---

template <class Form>
void keys(Form& f, Camera& c) {
  f.required("position", c.position, "[m]", places);
  f.required("target", c.target, "[m]", places);
  f.optional("up", c.up, "direction that is up in the picture", places);
  f.optional("fov_deg", c.fov_deg, "angle of the picture's height [°]",
             Numbers{0, 180, true, true});
  const Vector forward = c.target - c.position;
  f.expect(length(forward) > 0, "target", "a place other than the camera's");
  f.expect(length(cross(forward, c.up)) > 1e-9 * length(forward) * length(c.up), "up",
           "a vector that is not 0 and not along the view");
}
template <class Form>
void keys(Form& f, Orbit& o) {
  f.group("orbit", "cameras around a target, y up", [&](auto& within) {
    within.required("target", o.target, "[m]", places);
    within.required("distance", o.distance, "[m]", sizes);
    keys(within, o.from);
  });
}
/// View as the file has it.
struct AnyView {
  View view;
};
template <class Form>
void keys(Form& f, AnyView& v) {
  f.by_key(v.view, {"position", "orbit"});
}
template <class Form>
void keys(Form& f, Tolerance& t) {
  constexpr Numbers share{0, 1, true, true};
  f.required("metric", t.metric, "difference of a sample from the reference");
  f.required("limit", t.limit, "kept by the upper confidence bound of the quantile",
             Numbers{0, brightest});
  f.required("max", t.max, "passed by no sample", Numbers{0, brightest});
  f.optional("quantile", t.quantile, "of the samples' differences", share);
  f.optional("confidence", t.confidence, "of the bound", share);
  f.expect(t.max >= t.limit, "max", "a number from limit on");
}

/// Scene as its file has it.
struct SceneFile {
  std::vector<std::pair<std::string, Material>> materials;
  std::vector<NamedObject> objects;
  std::vector<NamedLight> lights;
  AnyView view;
  double exposure = Scene{}.exposure;
  Tolerance tolerance;
  std::optional<double> budget_ns;
  std::uint64_t seed = Scene{}.seed;
};
template <class Form>
void keys(Form& f, SceneFile& s) {
  f.constant("schema", "gonio.scene/1");
  f.required("materials", s.materials, "by their names", Entries{1, 1000});
  f.required("objects", s.objects, "what is seen", Entries{1, 10'000});
  f.required("lights", s.lights, "one environment at most", Entries{1, 1000});
  f.required("view", s.view, "a camera, or a range of them");
  f.optional("exposure", s.exposure, "factor of radiance, 1 being white then",
             Numbers{0, brightest, true});
  f.optional("tolerance", s.tolerance, "what a plan has to keep");
  f.optional("budget_ns", s.budget_ns, "mean time of a visible sample that a plan has to keep [ns]",
             Numbers{0, 1e12, true});
  f.optional("seed", s.seed, "of everything random");
}

}  // namespace gonio::scene
