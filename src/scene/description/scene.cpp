#include "scene/description/scene.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <tuple>
#include <unordered_map>

#include "base/error.h"
#include "base/file.h"
#include "base/json/memory.h"
#include "base/nearest.h"
#include "base/sha256.h"
#include "brdf/model/fitted_model.h"
#include "brdf/model/own_files.h"
#include "scene/description/gltf_file.h"
#include "scene/description/scene_keys.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio::scene {
namespace {

constexpr std::size_t kChannels = 3;

/// Files that a scene names, and what was read of them.
class Files {
 public:
  Files(const std::string& scene, const std::string& digest) : scene_(scene), digests_{digest} {}

  BoundModel fit(const std::string& name) {
    const std::string path = path_of(name);
    auto& known = fits_[place_of(path)];
    if (!known) {
      const std::string bytes = InputFile(path).read_rest(most_document_bytes);
      known = {bind_fitted(path, parse_fitted_model(path, bytes), kChannels), sha256(bytes)};
    }
    digests_.push_back(known->second);
    return known->first;
  }
  const GltfFile& gltf(const std::string& name) {
    const std::string path = path_of(name);
    auto& known = gltf_[place_of(path)];
    if (!known) {
      const CountedJson all(gltf_memory_);
      known = std::make_unique<GltfFile>(path);
      gltf_order_.push_back(known.get());
    }
    return *known;
  }
  /// \param at  the object
  std::shared_ptr<const Mesh> mesh(const MeshShape& shape, const JsonReader& at) {
    const auto* node = std::get_if<MeshShape::Node>(&shape.part);
    const std::string& name = node ? node->name : std::get<MeshShape::OfName>(shape.part).name;
    auto& known = meshes_[{shape.path, node != nullptr, name}];
    if (known)
      budget_.take(*known, at);
    else
      known = std::make_shared<const Mesh>(
          (node ? read_mesh_of_node : read_mesh)(gltf(shape.path), name, budget_));
    return known;
  }
  Environment environment(const std::string& name) {
    const InputFile file(path_of(name));
    digests_.push_back(sha256_of_file(file));
    Environment map = read_environment(file.path());
    file.expect_unchanged();
    return map;
  }
  /// Counts the files that a model takes functions from among those that the scene names.
  void add_own(const std::string& spec) {
    for (auto& f : own_files({spec})) digests_.push_back(std::move(f.sha256));
  }
  const std::string& scene() const { return scene_; }
  /// Digest of the list of all files' digests.
  std::string digest() const {
    auto all = digests_;
    for (const GltfFile* file : gltf_order_)
      for (auto& d : file->digests()) all.push_back(std::move(d));
    std::string list;
    for (const auto& d : all) list += d + '\n';
    return sha256(list);
  }

 private:
  std::string path_of(const std::string& name) const { return path_beside(scene_, name); }
  /// A file that is named in several ways is one.
  static std::string place_of(const std::string& path) {
    std::error_code unknown;
    return std::filesystem::weakly_canonical(path, unknown).string();
  }

  std::string scene_;
  std::vector<std::string> digests_;
  std::map<std::string, std::optional<std::pair<BoundModel, std::string>>> fits_;  ///< and digests
  std::map<std::string, std::unique_ptr<GltfFile>> gltf_;
  std::size_t gltf_memory_ = 0;  ///< of all their values, which stay
  std::vector<const GltfFile*> gltf_order_;
  std::map<std::tuple<std::string, bool, std::string>, std::shared_ptr<const Mesh>> meshes_;
  MeshBudget budget_;
};

/// The model, and whether its last lobe is a coat.  \param scene  its path   \param at  the material
std::pair<BoundModel, bool> model_of(const FromSpec& from,
                                     const std::string& scene,
                                     const JsonReader& at) {
  std::vector<Setting> settings;
  if (!from.parameters.empty()) settings = settings_of(from.parameters, at.at("parameters"));
  const auto bound = [&](const char* key, const char* expected, std::vector<Setting> with) {
    try {
      const auto spec = parse_model(own_files_beside(scene, from.model));
      return std::pair(bind_model(coat_as_lobe(spec), std::move(with), kChannels),
                       spec.coat.has_value());
    } catch (const Error& e) {  // the words are the file's, not the user's
      at.at(key).fail(fmt::format("{} ({})", expected, e.what()));
    }
  };
  bound("model", "a model", {});
  return bound("parameters", "parameters of the model", std::move(settings));
}

/// Gives a material the surface that it is from.
void resolve(Material& m, const JsonReader& at, Files& files) {
  if (const auto* spec = std::get_if<FromSpec>(&m.from)) {
    std::tie(m.is, m.coated) = model_of(*spec, files.scene(), at);
  } else if (const auto* fit = std::get_if<FromFit>(&m.from)) {
    m.is = files.fit(fit->path);
  } else {
    const auto& gltf = std::get<FromGltf>(m.from);
    m.is = read_material(files.gltf(gltf.path), gltf.material);
  }
  if (const auto* model = std::get_if<BoundModel>(&m.is)) files.add_own(to_text(model->model.spec));
}

void resolve(std::vector<Material>& materials, const JsonReader& at, Files& files) {
  for (auto& m : materials) resolve(m, at.at(m.name), files);
}

std::vector<Object> objects_of(std::vector<NamedObject>& named,
                               const std::vector<Material>& materials,
                               const JsonReader& at,
                               Files& files) {
  std::unordered_map<std::string_view, std::size_t> number;
  for (std::size_t i = 0; i < materials.size(); ++i) number[materials[i].name] = i;
  std::vector<Object> all;
  for (auto& [material, shape] : named) {
    const auto found = number.find(material);
    if (found == number.end()) {
      std::vector<std::string_view> names;
      for (const auto& m : materials) names.push_back(m.name);
      at.at(all.size())
          .at("material")
          .fail(fmt::format("one of the materials; nearest: {}",
                            fmt::join(nearest(material, names), ", ")));
    }
    if (auto* mesh = std::get_if<MeshShape>(&shape))
      mesh->mesh = files.mesh(*mesh, at.at(all.size()));
    all.push_back({std::move(shape), found->second});
  }
  return all;
}

bool shines(const Light& light) {
  const auto is_bright = [](const auto& c) {
    return std::ranges::any_of(c, [](auto v) { return v > 0; });
  };
  if (const auto* l = std::get_if<DirectionalLight>(&light)) return is_bright(l->irradiance);
  if (const auto* l = std::get_if<RectangleLight>(&light)) return is_bright(l->radiance);
  const auto& l = std::get<EnvironmentLight>(light);
  return l.scale > 0 && std::ranges::any_of(l.map.radiance, is_bright);
}

void resolve(std::vector<Light>& lights, const JsonReader& at, Files& files) {
  bool has_environment = false;
  for (std::size_t i = 0; i < lights.size(); ++i)
    if (auto* e = std::get_if<EnvironmentLight>(&lights[i])) {
      if (std::exchange(has_environment, true))
        at.at(i).fail("a second environment", "one at most");
      e->map = files.environment(e->path);
    }
  if (std::ranges::none_of(lights, shines)) at.fail("only black lights", "one that shines");
}

}  // namespace

Rgb EnvironmentLight::radiance(const Direction& d) const {
  Rgb c = map(into_map(d));
  for (double& v : c) v *= scale;
  return c;
}

Scene read_scene(const std::string& path) {
  const std::string bytes = InputFile(path).read_rest(most_document_bytes);
  const JsonDocument document(path, bytes, Places::pointer);
  const JsonReader& root = document.root();
  SceneFile file;
  read_record(root, file);
  Files files(path, sha256(bytes));

  Scene s = std::move(file.scene);
  s.path = path;
  resolve(s.materials, root.at("materials"), files);
  s.objects = objects_of(file.objects, s.materials, root.at("objects"), files);
  resolve(s.lights, root.at("lights"), files);
  s.sha256 = files.digest();
  return s;
}

std::string scene_schema() {
  return schema_text<SceneFile>("Scene");
}

}  // namespace gonio::scene
