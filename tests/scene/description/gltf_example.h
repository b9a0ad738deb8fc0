#pragma once
/// \file
/// A small glTF file: two triangles, nodes, materials.

#include <array>
#include <cstring>
#include <string>
#include <string_view>

#include "base/base64.h"
#include "base/json/reader.h"

#include <nlohmann/json.hpp>

namespace gonio::scene::test {

template <class T>
std::string bytes_of(const T& values) {
  return {reinterpret_cast<const char*>(values.data()), sizeof values};
}

/// A square of four vertices in the plane z = 0, its normals +z, its tangents +x, as two triangles.
inline std::string square_bytes() {
  constexpr std::array<float, 12> positions{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  constexpr std::array<float, 12> normals{0, 0, 2, 0, 0, 2, 0, 0, 2, 0, 0, 2};
  constexpr std::array<float, 16> tangents{1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1};
  constexpr std::array<std::uint16_t, 6> indices{0, 1, 2, 0, 2, 3};
  return bytes_of(positions) + bytes_of(normals) + bytes_of(tangents) + bytes_of(indices);
}

/// Mesh "square" of these bytes; nodes "top" (scaled by 2, then moved by 10 along x) above "placed" (turned from x to y);
/// materials "plain" and "coated".
inline Json square_gltf() {
  Json g = Json::parse(R"({
    "asset": {"version": "2.0"},
    "extensionsUsed": ["KHR_materials_clearcoat"],
    "buffers": [{"byteLength": 172}],
    "bufferViews": [
      {"buffer": 0, "byteOffset": 0, "byteLength": 48},
      {"buffer": 0, "byteOffset": 48, "byteLength": 48},
      {"buffer": 0, "byteOffset": 96, "byteLength": 64},
      {"buffer": 0, "byteOffset": 160, "byteLength": 12}],
    "accessors": [
      {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
      {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC3"},
      {"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC4"},
      {"bufferView": 3, "componentType": 5123, "count": 6, "type": "SCALAR"}],
    "meshes": [{"name": "square", "primitives": [
      {"attributes": {"POSITION": 0, "NORMAL": 1, "TANGENT": 2}, "indices": 3, "material": 0}]}],
    "nodes": [
      {"name": "top", "children": [1], "scale": [2, 2, 2], "translation": [10, 0, 0]},
      {"name": "placed", "mesh": 0, "rotation": [0, 0, 0.70710678118654752, 0.70710678118654752]}],
    "materials": [
      {"name": "plain"},
      {"name": "coated",
       "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 0.125, 1], "metallicFactor": 0, "roughnessFactor": 0.5},
       "extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 1, "clearcoatRoughnessFactor": 0.25}}}]
  })");
  g["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(square_bytes());
  return g;
}

/// Binary file of a document and its buffer.
inline std::string glb(Json document, std::string buffer) {
  document["buffers"][0].erase("uri");
  std::string text = document.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  buffer.resize((buffer.size() + 3) / 4 * 4, '\0');
  const auto chunk = [](std::string_view type, const std::string& bytes) {
    return bytes_of(std::array{static_cast<std::uint32_t>(bytes.size())}) + std::string(type) +
           bytes;
  };
  const std::string chunks = chunk("JSON", text) + chunk({"BIN\0", 4}, buffer);
  return "glTF" + bytes_of(std::array{2U, static_cast<std::uint32_t>(12 + chunks.size())}) + chunks;
}

/// A document with another value at a place; without a value it has nothing there.
inline Json with(Json document, const std::string& pointer, const Json& value) {
  document[Json::json_pointer(pointer)] = value;
  return document;
}
inline Json without(Json document, const std::string& pointer) {
  const Json::json_pointer at(pointer);
  Json& above = document[at.parent_pointer()];
  if (above.is_array())
    above.erase(std::stoul(at.back()));
  else
    above.erase(at.back());
  return document;
}

}  // namespace gonio::scene::test
