#pragma once
/// \file
/// glTF 2.0 file, as text or binary, and the buffers that it names [ISO/IEC 12113].
/// Dear to compile: for .cpp files only.

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/file.h"
#include "base/json/reader.h"

namespace gonio::scene {

/// The document and its buffers.  Nothing in it is trusted: what is asked for is bad_input with a JSON pointer where it is not
/// there.  A buffer is opened when something in it is asked for.
class GltfFile {
 public:
  /// Refuses other versions, and extensions without which the file is not what it says.
  explicit GltfFile(const std::string& path);
  GltfFile(const GltfFile&) = delete;
  ~GltfFile();

  const std::string& path() const { return path_; }
  const JsonReader& root() const { return document_->root(); }
  /// One of the lists of the root, such as "nodes"; nothing where the file has none.
  const std::optional<JsonReader>& list(const char* name) const;
  /// Entry of such a list that a value of the document has the number of.
  JsonReader entry(const char* list, const JsonReader& number) const;
  /// Number of the entry of that name; where none or several have it that is refused.  \param what  an entry is, as "material"
  std::size_t named(const char* list, const char* what, const std::string& name) const;
  /// Node above each: a node has one at most, and none is above itself.
  const std::vector<std::optional<std::size_t>>& nodes_above() const;

  /// Elements of an accessor, packed.  \param type  that it is to have, as "VEC3", of components of 32-bit floats
  std::vector<float> floats(const JsonReader& accessor,
                            std::string_view type,
                            std::size_t most) const;
  /// Whole numbers of an accessor of one component.
  std::vector<std::uint32_t> whole_numbers(const JsonReader& accessor, std::size_t most) const;

  /// SHA-256 of the file and of those buffers beside it that were asked for, in the order in which that was.
  std::vector<std::string> digests() const;

 private:
  struct Buffer;
  struct Layout;
  /// Number of the first entry of a name, and of how many have it.
  struct Named {
    std::size_t first = 0, count = 0;
  };
  using Names = std::unordered_map<std::string, Named>;
  const Names& names(const char* list) const;
  Buffer& buffer(const JsonReader& number) const;
  Layout layout(const JsonReader& accessor,
                std::size_t component,
                std::size_t count,
                std::size_t most) const;
  std::string packed(const Layout&) const;

  std::string path_, digest_;
  std::optional<JsonDocument> document_;
  std::map<std::string, std::optional<JsonReader>, std::less<>> lists_;
  std::unique_ptr<InputFile> binary_;  ///< of a binary file, for its buffer
  std::uint64_t binary_first_ = 0, binary_size_ = 0;
  mutable std::map<std::string, Names, std::less<>> names_;
  mutable std::optional<std::vector<std::optional<std::size_t>>> nodes_above_;
  mutable std::map<std::size_t, std::unique_ptr<Buffer>> buffers_;
  mutable std::vector<std::string> buffer_digests_;
};

}  // namespace gonio::scene
