#include "scene/description/mesh.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string_view>

#include "base/json/describe.h"
#include "geometry/vector.h"
#include "scene/description/gltf_file.h"

#include <fmt/format.h>

namespace gonio::scene {
namespace {

constexpr double kFarthest = 1e9;  ///< [m]

Vector vector_of(const std::array<float, 3>& v) {
  return {double{v[0]}, double{v[1]}, double{v[2]}};
}
std::array<float, 3> floats_of(const Vector& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// Values in groups of n.
template <std::size_t n, class V>
std::vector<std::array<V, n>> grouped(const std::vector<V>& values) {
  std::vector<std::array<V, n>> all(values.size() / n);
  for (std::size_t i = 0; i < all.size(); ++i) std::copy_n(&values[i * n], n, all[i].begin());
  return all;
}

/// Map of points: rows of its linear part, and what it adds.
struct Affine {
  std::array<Vector, 3> rows{Vector{1, 0, 0}, Vector{0, 1, 0}, Vector{0, 0, 1}};
  Vector shift;

  Vector turned(const Vector& v) const {
    return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)};
  }
  Vector operator()(const Vector& p) const { return turned(p) + shift; }
  double determinant() const { return dot(rows[0], cross(rows[1], rows[2])); }
  /// Rows of the cofactors: they map normals, up to their lengths and the determinant's sign.
  Affine of_normals() const {
    return {{cross(rows[1], rows[2]), cross(rows[2], rows[0]), cross(rows[0], rows[1])}, {}};
  }
};

/// First b, then a.
Affine operator*(const Affine& a, const Affine& b) {
  Affine c{{}, a(b.shift)};
  for (std::size_t i = 0; i < 3; ++i)
    c.rows[i] = a.rows[i].x * b.rows[0] + a.rows[i].y * b.rows[1] + a.rows[i].z * b.rows[2];
  return c;
}

Affine transform_of(const JsonReader& node) {
  constexpr Numbers any{-kFarthest, kFarthest};
  node.expect_object();
  if (node.has("matrix")) {
    std::array<double, 16> m{};  // by columns
    read_key(node, "matrix", m, any);
    if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1)
      node.at("matrix").fail("one whose last row is 0, 0, 0, 1");
    return {{Vector{m[0], m[4], m[8]}, Vector{m[1], m[5], m[9]}, Vector{m[2], m[6], m[10]}},
            {m[12], m[13], m[14]}};
  }
  Vector shift, scale{1, 1, 1};
  std::array<double, 4> q{0, 0, 0, 1};
  read_key(node, "translation", shift, any);
  read_key(node, "scale", scale, any);
  read_key(node, "rotation", q, Numbers{-2, 2});
  const double l = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
  if (!(std::abs(l - 1) < 0.01)) node.at("rotation").fail("a quaternion of length 1");
  const auto [x, y, z, w] = std::array{q[0] / l, q[1] / l, q[2] / l, q[3] / l};
  return {{Vector{scale.x * (1 - 2 * (y * y + z * z)), scale.y * 2 * (x * y - z * w),
                  scale.z * 2 * (x * z + y * w)},
           Vector{scale.x * 2 * (x * y + z * w), scale.y * (1 - 2 * (x * x + z * z)),
                  scale.z * 2 * (y * z - x * w)},
           Vector{scale.x * 2 * (x * z - y * w), scale.y * 2 * (y * z + x * w),
                  scale.z * (1 - 2 * (x * x + y * y))}},
          shift};
}

/// Direction of a vector; 0 where it has none.
std::array<float, 3> unit(const Vector& v) {
  if (!(length(v) > 0 && std::isfinite(length(v)))) return {};
  const Direction d = direction(v);
  return floats_of({d.x, d.y, d.z});
}

/// Indices of a primitive's triangles.
std::vector<std::uint32_t> indices_of(const GltfFile& file,
                                      const JsonReader& primitive,
                                      std::size_t vertices,
                                      std::size_t most) {
  if (!primitive.has("indices")) {
    std::vector<std::uint32_t> all(vertices);
    for (std::size_t i = 0; i < vertices; ++i) all[i] = static_cast<std::uint32_t>(i);
    if (vertices % 3 != 0)
      primitive.fail(fmt::format("{} vertices", vertices), "three for each triangle");
    return all;
  }
  const JsonReader accessor = file.entry("accessors", primitive.at("indices"));
  auto all = file.whole_numbers(accessor, most);
  const auto beyond = std::ranges::find_if(all, [&](std::uint32_t i) { return i >= vertices; });
  if (beyond != all.end())
    accessor.fail(fmt::format("{} in element {}", *beyond, beyond - all.begin()),
                  fmt::format("vertices below {}", vertices));
  if (all.size() % 3 != 0)
    accessor.fail(fmt::format("{} indices", all.size()), "three for each triangle");
  return all;
}

/// Gives each triangle vertices of its own with its normal; those without area, which have none, are left out.
void make_flat(Mesh& m) {
  Mesh flat;
  for (const auto& t : m.triangles) {
    const std::array corner{m.positions[t[0]], m.positions[t[1]], m.positions[t[2]]};
    const Vector a = vector_of(corner[0]);
    const auto normal = unit(cross(vector_of(corner[1]) - a, vector_of(corner[2]) - a));
    if (normal == std::array<float, 3>{}) continue;
    const auto first = static_cast<std::uint32_t>(flat.positions.size());
    flat.positions.insert(flat.positions.end(), corner.begin(), corner.end());
    flat.normals.insert(flat.normals.end(), 3, normal);
    flat.triangles.push_back({first, first + 1, first + 2});
  }
  m = std::move(flat);
}

Mesh read_primitive(const GltfFile& file, const JsonReader& primitive, MeshBudget& budget) {
  if (primitive.has("mode") && primitive.at("mode").whole_number() != 4)
    primitive.at("mode").fail("4, triangles");
  const JsonReader attributes = primitive.at("attributes");
  Mesh m;
  const auto values = [&](const char* name, const char* type) {
    const JsonReader accessor = file.entry("accessors", attributes.at(name));
    auto all = file.floats(accessor, type, budget.vertices);
    if (const auto n = m.positions.size(); n > 0 && accessor.at("count").whole_number() != n)
      accessor.at("count").fail(fmt::format("that of the positions, {}", n));
    return all;
  };
  m.positions = grouped<3>(values("POSITION", "VEC3"));
  const bool has_normals = attributes.has("NORMAL");
  const auto most = has_normals ? budget.triangles : budget.vertices / 3;
  const auto indices = indices_of(file, primitive, m.positions.size(), 3 * most);
  m.triangles = grouped<3>(indices);
  if (has_normals) {
    m.normals = grouped<3>(values("NORMAL", "VEC3"));
    for (std::size_t i = 0; i < m.normals.size(); ++i)
      if ((m.normals[i] = unit(vector_of(m.normals[i]))) == std::array<float, 3>{})
        file.entry("accessors", attributes.at("NORMAL"))
            .fail(fmt::format("no length in element {}", i), "vectors of length 1");
    if (attributes.has("TANGENT")) m.tangents = grouped<4>(values("TANGENT", "VEC4"));
  }
  budget.vertices -= std::max(m.positions.size(), has_normals ? 0 : indices.size());
  budget.triangles -= m.triangles.size();
  if (!has_normals) make_flat(m);
  return m;
}

void append(Mesh& all, Mesh&& more) {
  const auto first = static_cast<std::uint32_t>(all.positions.size());
  const bool tangents = (first == 0 || !all.tangents.empty()) && !more.tangents.empty();
  all.positions.insert(all.positions.end(), more.positions.begin(), more.positions.end());
  all.normals.insert(all.normals.end(), more.normals.begin(), more.normals.end());
  all.tangents.insert(all.tangents.end(), more.tangents.begin(), more.tangents.end());
  if (!tangents) all.tangents.clear();
  for (const auto& t : more.triangles)
    all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

/// Refuses many triangles on the same three points: a ray that meets one meets them all.
void expect_apart(const Mesh& m, const JsonReader& mesh) {
  constexpr std::size_t most = 64;
  std::vector<std::size_t> places;  // of the three points in any order
  for (const auto& t : m.triangles) {
    std::size_t place = 0;
    for (const auto corner : t) {
      const auto& p = m.positions[corner];
      place += std::hash<std::string_view>()({reinterpret_cast<const char*>(p.data()), sizeof p});
    }
    places.push_back(place);
  }
  std::ranges::sort(places);
  for (std::size_t i = most; i < places.size(); ++i)
    if (places[i] == places[i - most])
      mesh.fail(fmt::format("more than {} triangles on the same points", most), "fewer");
}

[[noreturn]] void refuse_more(const JsonReader& at) {
  at.fail("more triangles", fmt::format("at most {} vertices and {} triangles in a scene",
                                        MeshBudget{}.vertices, MeshBudget{}.triangles));
}

Mesh read(const GltfFile& file, const JsonReader& mesh, MeshBudget& budget) {
  const JsonReader primitives = mesh.at("primitives");
  if (!primitives.is_array()) primitives.fail("an array");
  Mesh all;
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    if (budget.vertices < 3 || budget.triangles < 1) refuse_more(primitives.at(i));
    append(all, read_primitive(file, primitives.at(i), budget));
  }
  if (all.triangles.empty()) mesh.fail("no triangle that has an area", "one at least");
  expect_apart(all, mesh);
  return all;
}

/// \param node  named where it leads out of the world
void move(Mesh& m, const Affine& to, const JsonReader& node) {
  const double sign = to.determinant() < 0 ? -1 : 1;
  const Affine normals = to.of_normals();
  for (auto& p : m.positions) {
    const Vector moved = to(vector_of(p));
    if (!(length(moved) <= kFarthest))
      node.fail("a vertex out of the world",
                fmt::format("at most {:g} m from its centre", kFarthest));
    p = floats_of(moved);
  }
  for (auto& n : m.normals)
    if ((n = unit(sign * normals.turned(vector_of(n)))) == std::array<float, 3>{})
      node.fail("a scale that leaves no normal", "one that is not 0");
  for (auto& t : m.tangents) {
    const auto along = unit(to.turned(vector_of({t[0], t[1], t[2]})));
    t = {along[0], along[1], along[2], static_cast<float>(t[3] < 0 ? -sign : sign)};
  }
  if (sign < 0)
    for (auto& t : m.triangles) std::swap(t[1], t[2]);
}

}  // namespace

void MeshBudget::take(const Mesh& m, const JsonReader& at) {
  if (m.positions.size() > vertices || m.triangles.size() > triangles) refuse_more(at);
  vertices -= m.positions.size();
  triangles -= m.triangles.size();
}

Mesh read_mesh(const GltfFile& file, const std::string& name, MeshBudget& budget) {
  const auto index = file.named("meshes", "mesh", name);
  const JsonReader mesh = file.list("meshes")->at(index);
  Mesh m = read(file, mesh, budget);
  move(m, {}, mesh);
  return m;
}

Mesh read_mesh_of_node(const GltfFile& file, const std::string& name, MeshBudget& budget) {
  const auto index = file.named("nodes", "node", name);
  const auto& nodes = *file.list("nodes");
  const auto& above = file.nodes_above();
  constexpr int deepest = 1000;
  Affine to;
  int depth = 0;
  for (std::optional<std::size_t> at = index; at; at = above[*at]) {
    if (++depth > deepest)
      nodes.at(index).fail(fmt::format("more than {} levels of nodes", deepest), "fewer");
    to = transform_of(nodes.at(*at)) * to;
  }
  const JsonReader node = nodes.at(index);
  Mesh m = read(file, file.entry("meshes", node.at("mesh")), budget);
  move(m, to, node);
  return m;
}

}  // namespace gonio::scene
