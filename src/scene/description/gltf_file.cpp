#include "scene/description/gltf_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "base/base64.h"
#include "base/error.h"
#include "base/nearest.h"
#include "base/sha256.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio::scene {
namespace {

constexpr std::array<const char*, 6> kLists{"accessors", "bufferViews", "buffers",
                                            "materials", "meshes",      "nodes"};
/// Extensions that are read, or that only concern textures, which are not.
constexpr std::array<std::string_view, 4> kKnown{"KHR_materials_ior", "KHR_materials_specular",
                                                 "KHR_materials_clearcoat",
                                                 "KHR_materials_anisotropy"};

bool is_binary(const std::string& head) {
  return head.starts_with("glTF");
}

/// Document of a binary file, and where the chunk of its buffer lies (of size 0 where there is none).
std::string text_of_binary(InputFile& in, std::uint64_t& first, std::uint64_t& size) {
  struct Header {
    std::array<char, 4> magic;
    std::uint32_t version, length;
  } header;
  struct Chunk {
    std::uint32_t length;
    std::array<char, 4> type;
  } chunk;
  in.read(&header, sizeof header);
  if (header.version != 2)
    throw bad_input(in.path(), "byte 4", fmt::format("version {}", header.version), "version 2");
  if (header.length != in.size())
    throw bad_input(in.path(), "byte 8", fmt::format("a length of {} bytes", header.length),
                    fmt::format("that of the file, {}", in.size()));
  std::string text;
  const auto next = [&] {
    in.read(&chunk, sizeof chunk);
    if (chunk.length > in.size() - in.position())
      throw bad_input(in.path(), fmt::format("byte {}", in.position() - sizeof chunk),
                      fmt::format("a chunk of {} bytes", chunk.length),
                      fmt::format("at most the {} that are left", in.size() - in.position()));
    return std::string_view(chunk.type.data(), chunk.type.size());
  };
  if (next() != "JSON")
    throw bad_input(in.path(), "byte 16", std::string(chunk.type.data(), 4), "JSON");
  if (chunk.length > most_document_bytes)
    throw bad_input(in.path(), "byte 12", fmt::format("{} bytes", chunk.length),
                    fmt::format("at most {}", most_document_bytes));
  text.resize(chunk.length);
  in.read(text.data(), text.size());
  if (in.position() < in.size() && next() == std::string_view("BIN\0", 4)) {
    first = in.position();
    size = chunk.length;
  }
  return text;
}

/// Whole number of a key that may be left out.
std::uint64_t whole_or(const JsonReader& object, const char* key, std::uint64_t otherwise) {
  return object.has(key) ? object.at(key).whole_number() : otherwise;
}

/// Bytes of a URI: those of %20 and the like, too.
std::string unescaped(const std::string& text) {
  std::string path;
  const auto digit = [](char c) {
    constexpr std::string_view digits = "0123456789abcdef";
    return digits.find(static_cast<char>(c >= 'A' && c <= 'F' ? c - 'A' + 'a' : c));
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto high = text[i] == '%' && i + 2 < text.size() ? digit(text[i + 1]) : text.npos;
    const auto low = high == text.npos ? text.npos : digit(text[i + 2]);
    if (low != text.npos) {
      path += static_cast<char>(16 * high + low);
      i += 2;
    } else {
      path += text[i];
    }
  }
  return path;
}

/// Path of a URI.
std::string path_of(const JsonReader& uri) {
  std::string path = unescaped(uri.string());
  // A scheme, such as https:, ends before the first slash.
  if (path.empty() || path.find('\0') != path.npos || path.starts_with('/') ||
      path.find(':') < path.find('/'))
    uri.fail("a path relative to the file, or data:…;base64,…");
  return path;
}

/// Files that a list names are no outputs, though none of them be read.
void keep_from_writing(const std::string& document, const JsonReader& list) {
  constexpr std::size_t most = 4096;
  const auto folder = std::filesystem::path(document).parent_path();
  for (std::size_t i = 0; i < std::min(list.size(), most); ++i) {
    const JsonReader entry = list.at(i);
    if (!entry.has("uri") || !entry.at("uri").is_string()) continue;
    const std::string uri = entry.at("uri").string();
    if (!uri.starts_with("data:")) will_read((folder / unescaped(uri)).string());
  }
}

}  // namespace

/// Bytes of a buffer: a part of a file, or of the document.
struct GltfFile::Buffer {
  std::string bytes;
  const InputFile* file = nullptr;
  std::unique_ptr<InputFile> own;
  std::uint64_t first = 0, size = 0;

  void read(std::uint64_t at, char* to, std::size_t n) const {
    if (file)
      file->read_at(first + at, to, n);
    else
      std::memcpy(to, bytes.data() + at, n);
  }
};

/// Place of an accessor's elements.
struct GltfFile::Layout {
  const Buffer* buffer;
  std::uint64_t first;
  std::size_t stride, size, count;  ///< [byte], [byte], elements
};

GltfFile::GltfFile(const std::string& path) : path_(path) {
  binary_ = std::make_unique<InputFile>(path);
  std::string text;
  if (is_binary(binary_->peek(4))) {
    text = text_of_binary(*binary_, binary_first_, binary_size_);
    digest_ = sha256_of_file(*binary_);
  } else {
    text = binary_->read_rest(most_document_bytes);
    digest_ = sha256(text);
    binary_.reset();
  }
  document_.emplace(path_, text, Places::pointer);
  root().expect_object();

  const JsonReader asset = root().at("asset");
  if (!asset.at("version").string().starts_with("2.")) asset.at("version").fail("2.0");
  if (asset.has("minVersion") && asset.at("minVersion").string() != "2.0")
    asset.at("minVersion").fail("2.0");
  if (root().has("extensionsRequired")) {
    const JsonReader required = root().at("extensionsRequired");
    if (!required.is_array()) required.fail("an array");
    for (std::size_t i = 0; i < required.size(); ++i)
      if (std::ranges::find(kKnown, required.at(i).string()) == kKnown.end())
        required.at(i).fail(fmt::format("an extension that is read: {}", fmt::join(kKnown, ", ")));
  }
  for (const char* name : kLists) {
    auto& of_that_name = lists_[name];
    if (!root().has(name)) continue;
    of_that_name = root().at(name);
    if (!of_that_name->is_array()) of_that_name->fail("an array");
  }
  for (const char* name : {"buffers", "images"})
    if (root().has(name) && root().at(name).is_array()) keep_from_writing(path_, root().at(name));
}

GltfFile::~GltfFile() = default;

const std::optional<JsonReader>& GltfFile::list(const char* name) const {
  return lists_.find(name)->second;
}

JsonReader GltfFile::entry(const char* name, const JsonReader& number) const {
  const auto& all = list(name);
  const auto size = all ? all->size() : 0;
  const auto i = number.whole_number();
  if (i >= size) number.fail(fmt::format("a number below {}, that of {}", size, name));
  return all->at(i);
}

const GltfFile::Names& GltfFile::names(const char* name) const {
  const auto [at, is_new] = names_.try_emplace(name);
  const auto& all = list(name);
  for (std::size_t i = 0; is_new && all && i < all->size(); ++i) {
    const JsonReader one = all->at(i);
    if (one.has("name"))
      ++at->second.try_emplace(one.at("name").string(), Named{i, 0}).first->second.count;
  }
  return at->second;
}

std::size_t GltfFile::named(const char* name, const char* what, const std::string& wanted) const {
  const auto& all = list(name);
  const JsonReader there = all ? *all : root().at(name);
  const Names& known = names(name);
  if (const auto found = known.find(wanted); found != known.end()) {
    if (found->second.count > 1)
      there.fail(fmt::format("{} times '{}'", found->second.count, wanted),
                 fmt::format("one {} of that name", what));
    return found->second.first;
  }
  constexpr std::size_t looked_at = 1000;
  std::vector<std::string_view> near;
  for (const auto& [other, of] : known)
    if (near.size() < looked_at) near.push_back(other);
  std::ranges::sort(near);
  there.fail(fmt::format("no {} '{}'", what, wanted),
             fmt::format("one of that name; nearest: {}", fmt::join(nearest(wanted, near), ", ")));
}

const std::vector<std::optional<std::size_t>>& GltfFile::nodes_above() const {
  if (nodes_above_) return *nodes_above_;
  const auto& nodes = list("nodes");
  std::vector<std::optional<std::size_t>> above(nodes ? nodes->size() : 0);
  for (std::size_t i = 0; i < above.size(); ++i) {
    const JsonReader node = nodes->at(i);
    if (!node.has("children")) continue;
    const JsonReader children = node.at("children");
    if (!children.is_array()) children.fail("an array");
    for (std::size_t k = 0; k < children.size(); ++k) {
      entry("nodes", children.at(k));
      auto& its = above[static_cast<std::size_t>(children.at(k).whole_number())];
      if (its) children.at(k).fail(fmt::format("a node that is no child of node {}", *its));
      its = i;
    }
  }
  // Each way up ends at the top, or where another went on from; one that meets itself is a circle.
  std::vector<std::size_t> walked_from(above.size(), above.size());
  for (std::size_t first = 0; first < above.size(); ++first)
    for (std::optional<std::size_t> at = first; at; at = above[*at]) {
      if (walked_from[*at] == first)
        nodes->at(*at).fail("a node below itself", "nodes that are a tree");
      if (walked_from[*at] != above.size()) break;
      walked_from[*at] = first;
    }
  return nodes_above_.emplace(std::move(above));
}

GltfFile::Buffer& GltfFile::buffer(const JsonReader& number) const {
  const JsonReader json = entry("buffers", number);
  const auto index = static_cast<std::size_t>(number.whole_number());
  auto& known = buffers_[index];
  if (known) return *known;
  constexpr std::size_t most = 64;
  if (buffers_.size() > most)
    number.fail(fmt::format("a buffer after {} others", most), fmt::format("at most {}", most));
  auto b = std::make_unique<Buffer>();
  const auto length = json.at("byteLength").whole_number();
  constexpr std::string_view data = "data:", base = ";base64,";
  if (!json.has("uri")) {
    if (index != 0 || binary_size_ == 0)
      json.fail("a buffer without a uri", "one with it: the file has no chunk for it");
    b->file = binary_.get();
    b->first = binary_first_;
    b->size = binary_size_;
  } else if (const std::string uri = json.at("uri").string(); uri.starts_with(data)) {
    const auto begin = uri.find(base);
    if (begin == uri.npos) json.at("uri").fail("a path relative to the file, or data:…;base64,…");
    b->bytes = from_base64(std::string_view(uri).substr(begin + base.size()));
    b->size = b->bytes.size();
  } else {
    b->own = std::make_unique<InputFile>(path_beside(path_, path_of(json.at("uri"))));
    b->file = b->own.get();
    b->size = b->own->size();
    buffer_digests_.push_back(sha256_of_file(*b->own));
  }
  if (length > b->size)
    json.at("byteLength").fail(fmt::format("at most the {} bytes that there are", b->size));
  b->size = length;
  known = std::move(b);
  return *known;
}

/// \param component  [byte]  \param count  components of an element
GltfFile::Layout GltfFile::layout(const JsonReader& accessor,
                                  std::size_t component,
                                  std::size_t count,
                                  std::size_t most) const {
  if (accessor.has("sparse")) accessor.at("sparse").fail("an accessor that is not sparse");
  const JsonReader number = accessor.at("count");
  const auto n = number.whole_number();
  if (n < 1 || n > most) number.fail(fmt::format("a number in [1, {}]", most));
  const JsonReader view = entry("bufferViews", accessor.at("bufferView"));
  const Buffer& b = buffer(view.at("buffer"));

  const auto view_first = whole_or(view, "byteOffset", 0);
  const auto view_size = view.at("byteLength").whole_number();
  if (view_first > b.size || view_size > b.size - view_first)
    view.fail(fmt::format("{} bytes from byte {} on", view_size, view_first),
              fmt::format("bytes of the buffer, which has {}", b.size));
  const std::size_t size = component * count;
  const auto stride = whole_or(view, "byteStride", size);
  if (stride < size || stride > 252)
    view.at("byteStride").fail(fmt::format("a number in [{}, 252]", size));
  const auto first = whole_or(accessor, "byteOffset", 0);
  const auto needed = (n - 1) * stride + size;
  if (first > view_size || needed > view_size - first)
    accessor.fail(fmt::format("{} bytes from byte {} on", needed, first),
                  fmt::format("bytes of its view, which has {}", view_size));
  return {&b, view_first + first, static_cast<std::size_t>(stride), size,
          static_cast<std::size_t>(n)};
}

std::string GltfFile::packed(const Layout& l) const {
  std::string all(l.size * l.count, '\0');
  if (l.stride == l.size) {
    l.buffer->read(l.first, all.data(), all.size());
    return all;
  }
  constexpr std::size_t block = 4096;  // elements read at once
  std::string part(block * l.stride, '\0');
  for (std::size_t i = 0; i < l.count; i += block) {
    const auto n = std::min(block, l.count - i);
    l.buffer->read(l.first + i * l.stride, part.data(), (n - 1) * l.stride + l.size);
    for (std::size_t k = 0; k < n; ++k)
      std::memcpy(all.data() + (i + k) * l.size, part.data() + k * l.stride, l.size);
  }
  return all;
}

std::vector<float> GltfFile::floats(const JsonReader& accessor,
                                    std::string_view type,
                                    std::size_t most) const {
  if (accessor.at("componentType").whole_number() != 5126)
    accessor.at("componentType").fail("5126, 32-bit floats");
  if (accessor.at("type").string() != type) accessor.at("type").fail(std::string(type));
  const auto components = static_cast<std::size_t>(type.back() - '0');
  const std::string bytes = packed(layout(accessor, sizeof(float), components, most));
  std::vector<float> all(bytes.size() / sizeof(float));
  std::memcpy(all.data(), bytes.data(), bytes.size());
  const auto bad = std::ranges::find_if_not(all, [](float v) { return std::isfinite(v); });
  if (bad != all.end())
    accessor.fail(fmt::format("{} in element {}", *bad,
                              static_cast<std::size_t>(bad - all.begin()) / components),
                  "finite numbers");
  return all;
}

std::vector<std::uint32_t> GltfFile::whole_numbers(const JsonReader& accessor,
                                                   std::size_t most) const {
  const JsonReader kind = accessor.at("componentType");
  const auto code = kind.whole_number();
  const std::size_t size = code == 5121 ? 1 : code == 5123 ? 2 : code == 5125 ? 4 : 0;
  if (size == 0) kind.fail("5121, 5123 or 5125, whole numbers without sign");
  if (accessor.at("type").string() != "SCALAR") accessor.at("type").fail("SCALAR");
  const std::string bytes = packed(layout(accessor, size, 1, most));
  std::vector<std::uint32_t> all(bytes.size() / size);
  for (std::size_t i = 0; i < all.size(); ++i) std::memcpy(&all[i], bytes.data() + i * size, size);
  return all;
}

std::vector<std::string> GltfFile::digests() const {
  if (binary_) binary_->expect_unchanged();
  for (const auto& [index, b] : buffers_)
    if (b && b->own) b->own->expect_unchanged();
  std::vector<std::string> all{digest_};
  all.insert(all.end(), buffer_digests_.begin(), buffer_digests_.end());
  return all;
}

}  // namespace gonio::scene
