// Any bytes as a scene, or as a glTF file that a scene names.
#include "scene/description/scene.h"

#include "fuzz/one_file.h"
#include "scene/description/gltf_file.h"

namespace {

using namespace gonio;
using namespace gonio::scene;

void check(const Mesh& m) {
  if (m.normals.size() != m.positions.size() ||
      (!m.tangents.empty() && m.tangents.size() != m.positions.size()))
    std::abort();
  for (const auto& t : m.triangles)
    for (const auto i : t)
      if (i >= m.positions.size()) std::abort();
  for (const auto* list : {&m.positions, &m.normals})
    for (const auto& v : *list)
      for (const float x : v)
        if (!(x >= -2e9F && x <= 2e9F)) std::abort();
}

/// Every named thing of a list, as a scene that names it would have it read.
template <class Read>
void each_named(const GltfFile& file, const char* list, Read&& read) {
  const auto& all = file.list(list);
  for (std::size_t i = 0; all && i < all->size() && i < 10; ++i) try {
      read(all->at(i).at("name").string());
    } catch (const Error& e) {
      if (e.code() != Exit::bad_input) std::abort();
    }
}

void read_gltf(const std::string& path) {
  const GltfFile file(path);
  MeshBudget budget;
  each_named(file, "materials", [&](const std::string& name) { read_material(file, name); });
  each_named(file, "meshes",
             [&](const std::string& name) { check(read_mesh(file, name, budget)); });
  each_named(file, "nodes",
             [&](const std::string& name) { check(read_mesh_of_node(file, name, budget)); });
  file.digests();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::read_as_file(data, size, [](const std::string& path) {
#if defined(GONIO_FUZZ_gltf)
    read_gltf(path);
#else
    if (read_scene(path).sha256.size() != 64) std::abort();
#endif
  });
}
