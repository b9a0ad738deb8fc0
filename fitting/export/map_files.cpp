#include "fitting/export/map_files.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "base/base64.h"
#include "base/json/reader.h"
#include "fitting/export/materialx_parts.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gonio {

std::array<float, 2> half_sides(std::size_t width, std::size_t height) {
  const auto largest = static_cast<double>(std::max(width, height));
  return {static_cast<float>(static_cast<double>(width) / largest),
          static_cast<float>(static_cast<double>(height) / largest)};
}

std::string document_of(const MapExport& e, const std::string& stack) {
  return text_of(Json{{"schema", "gonio.map_export/1"}, {"model", e.model}, {"stack", stack}});
}

namespace {

/// A plane of the image's shape in the xy plane, its texture's top at the top.
void add_plane(Json& all, std::size_t width, std::size_t height) {
  const auto [across, up] = half_sides(width, height);
  std::string bytes;
  const auto put = [&](auto x) {
    static_assert(std::endian::native == std::endian::little);  // as glTF has it
    bytes.append(reinterpret_cast<const char*>(&x), sizeof x);
  };
  constexpr std::array<std::array<float, 2>, 4> corners{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  for (const auto& [x, y] : corners)
    for (const float v : {x * across, y * up, 0.0F}) put(v);
  for (std::size_t k = 0; k < 4; ++k)
    for (const float v : {0.0F, 0.0F, 1.0F}) put(v);
  for (std::size_t k = 0; k < 4; ++k)
    for (const float v : {1.0F, 0.0F, 0.0F, 1.0F}) put(v);
  for (const auto& [x, y] : corners)
    for (const float v : {(x + 1) / 2, (1 - y) / 2}) put(v);
  for (const std::uint32_t k : {0U, 1U, 2U, 0U, 2U, 3U}) put(k);
  constexpr int float32 = 5126, uint32 = 5125, vertex_data = 34962, index_data = 34963;
  constexpr std::array<std::size_t, 6> at{0, 48, 96, 160, 192, 216};
  Json views = Json::array();
  for (std::size_t k = 0; k + 1 < at.size(); ++k)
    views.push_back({{"buffer", 0},
                     {"byteOffset", at[k]},
                     {"byteLength", at[k + 1] - at[k]},
                     {"target", k == 4 ? index_data : vertex_data}});
  const auto accessor = [&](int view, int type, std::size_t count, const char* shape) {
    return Json{{"bufferView", view}, {"componentType", type}, {"count", count}, {"type", shape}};
  };
  Json positions = accessor(0, float32, 4, "VEC3");
  positions["min"] = {-across, -up, 0};
  positions["max"] = {across, up, 0};
  all["scene"] = 0;
  all["scenes"] = Json::array({{{"nodes", {0}}}});
  all["nodes"] = Json::array({{{"name", "map"}, {"mesh", 0}}});
  all["meshes"] = Json::array(
      {{{"primitives",
         Json::array(
             {{{"attributes", {{"POSITION", 0}, {"NORMAL", 1}, {"TANGENT", 2}, {"TEXCOORD_0", 3}}},
               {"indices", 4},
               {"material", 0}}})}}});
  all["accessors"] =
      Json::array({positions, accessor(1, float32, 4, "VEC3"), accessor(2, float32, 4, "VEC4"),
                   accessor(3, float32, 4, "VEC2"), accessor(4, uint32, 6, "SCALAR")});
  all["bufferViews"] = views;
  all["buffers"] =
      Json::array({{{"byteLength", bytes.size()},
                    {"uri", "data:application/octet-stream;base64," + base64(bytes)}}});
}

}  // namespace

std::string gltf_file_of(const MapExport& e, const MapTextures& t, const std::string& stack) {
  std::vector<const PngImage*> textures{&t.base, &t.rough, &t.tint};
  Json material{
      {"name", "map"},
      {"pbrMetallicRoughness",
       {{"baseColorTexture", {{"index", 0}}}, {"metallicRoughnessTexture", {{"index", 1}}}}},
      {"extensions",
       {{"KHR_materials_ior", {{"ior", e.ior}}},
        {"KHR_materials_specular", {{"specularColorTexture", {{"index", 2}}}}}}}};
  if (!t.normals.pixels.empty()) {
    textures.push_back(&t.normals);
    material["normalTexture"] = {{"index", 3}};
  }
  material["extras"] = {{"gonio", {{"model", e.model}, {"stack", stack}}}};
  Json all{{"asset", {{"version", "2.0"}, {"generator", "gonio"}}},
           {"extensionsUsed", {"KHR_materials_ior", "KHR_materials_specular"}},
           {"materials", Json::array({material})}};
  constexpr int linear = 9729, linear_mipmap = 9987, clamp_to_edge = 33071;
  all["samplers"] = Json::array({{{"magFilter", linear},
                                  {"minFilter", linear_mipmap},
                                  {"wrapS", clamp_to_edge},
                                  {"wrapT", clamp_to_edge}}});
  all["images"] = all["textures"] = Json::array();
  for (std::size_t k = 0; k < textures.size(); ++k) {
    all["images"].push_back({{"mimeType", "image/png"},
                             {"uri", "data:image/png;base64," + base64(png_bytes(*textures[k]))}});
    all["textures"].push_back({{"sampler", 0}, {"source", k}});
  }
  add_plane(all, e.width, e.height);
  return text_of(all);
}

std::string open_pbr_file_of(const MapExport& e, const std::string& stack) {
  const auto image = [&](std::size_t texture, const char* name, bool is_colour) {
    return fmt::format(
        "<image name=\"{0}\" type=\"{1}\">\n<input name=\"file\" type=\"filename\" "
        "value=\"{2}\"{3}/>\n</image>\n",
        name, is_colour ? "color3" : "vector3", e.textures[texture],
        is_colour ? " colorspace=\"srgb_texture\"" : "");
  };
  const auto channel = [](const char* name, int index) {
    return fmt::format(
        "<extract name=\"{}\" type=\"float\">\n<input name=\"in\" type=\"vector3\" "
        "nodename=\"map_rough\"/>\n<input name=\"index\" type=\"integer\" "
        "value=\"{}\"/>\n</extract>\n",
        name, index);
  };
  const auto connected = [](const char* name, const char* type, const char* node) {
    return fmt::format("<input name=\"{}\" type=\"{}\" nodename=\"{}\"/>\n", name, type, node);
  };
  std::string nodes = image(0, "map_base", true) + image(1, "map_rough", false) +
                      image(2, "map_tint", true) + channel("map_roughness", 1) +
                      channel("map_metal", 2);
  std::string inputs =
      input("base_weight", "float", {1}) + connected("base_color", "color3", "map_base") +
      connected("base_metalness", "float", "map_metal") + input("specular_weight", "float", {1}) +
      connected("specular_color", "color3", "map_tint") +
      connected("specular_roughness", "float", "map_roughness") +
      input("specular_ior", "float", {e.ior});
  if (e.textures.size() > 3) {
    nodes += image(3, "map_normals", false) + "<normalmap name=\"map_normal\" type=\"vector3\">\n" +
             connected("in", "vector3", "map_normals") + "</normalmap>\n";
    inputs += connected("geometry_normal", "vector3", "map_normal");
  }
  return material_file("open_pbr_surface", inputs, document_of(e, stack), nodes);
}

std::string usd_preview_file_of(const MapExport& e, const std::string& stack) {
  const auto texture = [&](std::size_t k, const char* name, const char* space, const char* more) {
    return fmt::format(R"(
        def Shader "{0}"
        {{
            uniform token info:id = "UsdUVTexture"
            asset inputs:file = @{1}@
            token inputs:sourceColorSpace = "{2}"
            float2 inputs:st.connect = </map/material/st.outputs:result>
            token inputs:wrapS = "clamp"
            token inputs:wrapT = "clamp"
{3}        }}
)",
                       name, e.textures[k], space, more);
  };
  constexpr const char* colour = "            float3 outputs:rgb\n";
  std::string nodes = texture(0, "base", "sRGB", colour) + texture(2, "tint", "sRGB", colour) +
                      texture(1, "rough", "raw", "            float outputs:g\n");
  std::string normal;
  if (e.textures.size() > 3) {
    nodes += texture(3, "normals", "raw",
                     "            float4 inputs:bias = (-1, -1, -1, 0)\n"
                     "            float4 inputs:scale = (2, 2, 2, 1)\n"
                     "            float3 outputs:rgb\n");
    normal = "            normal3f inputs:normal.connect = </map/material/normals.outputs:rgb>\n";
  }
  const auto [x, y] = half_sides(e.width, e.height);
  return fmt::format(R"(#usda 1.0
(
    customLayerData = {{
        string gonio = {0}
    }}
    defaultPrim = "map"
    metersPerUnit = 1
    upAxis = "Y"
)

def Xform "map"
{{
    def Material "material"
    {{
        token outputs:surface.connect = </map/material/surface.outputs:surface>

        def Shader "surface"
        {{
            uniform token info:id = "UsdPreviewSurface"
            int inputs:useSpecularWorkflow = 1
            color3f inputs:diffuseColor.connect = </map/material/base.outputs:rgb>
            color3f inputs:specularColor.connect = </map/material/tint.outputs:rgb>
            float inputs:roughness.connect = </map/material/rough.outputs:g>
{1}            token outputs:surface
        }}

        def Shader "st"
        {{
            uniform token info:id = "UsdPrimvarReader_float2"
            string inputs:varname = "st"
            float2 outputs:result
        }}
{2}    }}

    def Mesh "plane" (
        prepend apiSchemas = ["MaterialBindingAPI"]
    )
    {{
        float3[] extent = [(-{3}, -{4}, 0), ({3}, {4}, 0)]
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
        rel material:binding = </map/material>
        point3f[] points = [(-{3}, -{4}, 0), ({3}, -{4}, 0), ({3}, {4}, 0), (-{3}, {4}, 0)]
        texCoord2f[] primvars:st = [(0, 0), (1, 0), (1, 1), (0, 1)] (
            interpolation = "vertex"
        )
        uniform token subdivisionScheme = "none"
    }}
}}
)",
                     Json(document_of(e, stack)).dump(), normal, nodes, x, y);
}

}  // namespace gonio
