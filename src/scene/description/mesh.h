#pragma once
/// \file
/// Triangles of a glTF 2.0 file.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace gonio {
class JsonReader;
}

namespace gonio::scene {

class GltfFile;

/// Triangles that share vertices.  Every number is finite, every index one of a vertex.
struct Mesh {
  std::vector<std::array<float, 3>> positions;  ///< [m]
  std::vector<std::array<float, 3>> normals;    ///< of length 1, one for each position
  /// Direction (0 where there is none), and the sign of the bitangent sign · normal × tangent; one for each position, or none
  std::vector<std::array<float, 4>> tangents;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise from outside
};

/// Vertices and triangles that a scene's objects may still have: rays are traced through each object's own.
struct MeshBudget {
  std::size_t vertices = std::size_t{1} << 22, triangles = std::size_t{1} << 23;

  /// Those of an object that has the mesh of another.  \param at  named where there are too few
  void take(const Mesh&, const JsonReader& at);
};

/// All primitives of a mesh, in its own coordinates.  Where they have no normals, each triangle has its own.
/// \param name  of one mesh of the file
Mesh read_mesh(const GltfFile&, const std::string& name, MeshBudget&);
/// Primitives of a node's mesh where it stands: moved by the node and by all those above it.
/// \param name  of one node of the file
Mesh read_mesh_of_node(const GltfFile&, const std::string& name, MeshBudget&);

}  // namespace gonio::scene
