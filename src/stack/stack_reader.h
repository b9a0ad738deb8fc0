#pragma once
/// \file
/// Samples of a stack, part by part: the memory is the part's, whatever the stack's size.

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/file.h"
#include "base/memory.h"
#include "base/memory_budget.h"
#include "image/image_file.h"
#include "stack/stack.h"

namespace gonio {

/// Samples of a part, cut into pieces of its texels in the order of its rows, so that what belongs to a piece lies together.
struct StackPart {
  static constexpr std::size_t piece_texels = 512;  ///< of all pieces but the last
  struct Piece {
    std::size_t first = 0, texels = 0;  ///< of the part's texels
    std::span<const float>
        values;  ///< f_r [1/sr], [image][channel][texel]; NaN where there is none
    /// Unit vectors, [image][3], or [image][3][texel] where texels have their own.
    std::span<const float> light, view;
    std::span<const float> normal;  ///< [3][texel]; empty where all are z
  };
  Piece piece(std::size_t k) const;
  std::size_t pieces() const { return (texels + piece_texels - 1) / piece_texels; }

  using Floats = std::vector<float, ArrayAllocator<float>>;
  std::size_t texels = 0, images = 0, channels = 0;
  bool shared = true;  ///< all texels have an image's light and view
  Floats values, light, view, normal;
};

/// Refuses an image of another size than the first one of its stack.
void expect_size_of(const std::string& first,
                    std::size_t width,
                    std::size_t height,
                    const ImageFile&);

/// Open stack.  One thread reads parts, which are read on all.
class StackReader {
 public:
  /// Opens each image once: those of another size or without the channels are refused.  Frames are read whole: one that is no
  /// photograph is refused.
  explicit StackReader(Stack stack);
  /// Refuses what opening it would, without reading the images whole.
  static void expect_frames(Stack stack);

  const Stack& stack() const { return stack_; }
  std::size_t width() const { return width_; }
  std::size_t height() const { return height_; }
  /// Of the images; the only one of an image with one is "".
  const std::vector<std::string>& channels() const { return channels_; }
  bool shared() const { return shared_; }
  bool has_normals() const { return normals_ != none; }
  /// Columns and rows that files store as one; parts of whole ones read nothing twice.
  std::size_t block_width() const { return block_width_; }
  std::size_t block_height() const { return block_height_; }
  /// Bytes that a texel of a part takes.
  std::size_t bytes_of_texel() const;

  /// Samples of a part within the stack.  Refused by file, column and row: a light, view or normal that is no direction or below the
  /// surface of a texel that has a value there.  A texel whose normal is NaN or 0 has no values.
  void read(const Rectangle&, StackPart& to) const;

  /// Name of the stack: SHA-256 of the list of those of its document and of each file that it names.  A file that changes later is
  /// refused when it is read.
  const std::string& digest() const { return digest_; }

 private:
  struct WithoutName {};  ///< digest() is left empty
  StackReader(Stack stack, WithoutName);
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  struct Source {
    std::string path;
    std::vector<std::size_t> channels;  ///< that are read
    mutable std::unique_ptr<ImageFile>
        file;  ///< kept open where there are few; used by one thread at a time
    InputFile::Stamp opened{};
    std::size_t numbers = 0;           ///< of a texel, channels that are not read included
    std::size_t held = 0;              ///< bytes, while it is open
    std::optional<Vector> position{};  ///< vectors to it are computed, not read
  };
  Source source_of(const std::string& name);
  /// Numbers that a photograph is multiplied with after the dark frame is taken off, [channel][texel].
  void read_frames(const Rectangle&, std::vector<float>& dark, std::vector<float>& gain) const;
  /// Refuses a dark frame without numbers and a flat one without light, in most of its pixels.
  void expect_photographs() const;
  std::string make_digest() const;
  static void expect_unchanged(const Source&, const InputFile& now);
  std::unique_ptr<ImageFile> open(const std::string& path);
  /// Keeps a file open where those that are leave it room.
  void keep(Source&, std::unique_ptr<ImageFile>);
  std::size_t vectors(const std::string& name);
  void read(const Source&, const Rectangle&, std::vector<float>& to) const;
  /// \param places  of the part's texels, where there are positions
  void read_vectors(std::size_t map,
                    const Rectangle&,
                    const std::vector<float>& places,
                    std::vector<float>& to) const;
  /// Places of a part's texels in the unit of Stack::width, [3][texel].
  std::vector<float> places_of(const Rectangle&) const;
  /// Values of an image as f_r.  \param values  of its channels, as read
  void make_reflectance(const Rectangle& part,
                        std::size_t image,
                        const std::vector<std::vector<float>>& maps,
                        const std::vector<float>& places,
                        std::vector<float>& values) const;
  [[noreturn]] void refuse(const Source&,
                           const Rectangle&,
                           std::size_t texel,
                           const char* what) const;

  Stack stack_;
  std::string first_;  ///< path of the first image, whose size all have
  std::string digest_;
  std::size_t width_ = 0, height_ = 0, block_width_ = 1, block_height_ = 1;
  std::vector<std::string> channels_;
  bool shared_ = true, is_near_ = false;  ///< is_near_: there are positions
  std::vector<Source> images_, maps_;     ///< maps_: images of vectors, each once
  std::optional<Source> dark_, flat_, heights_;
  std::vector<float> middle_;                                ///< of the flat frame, by channel
  std::unordered_map<std::string, std::size_t> map_number_;  ///< by path
  std::vector<std::size_t> light_maps_, view_maps_;  ///< of each image: index into maps_, or none
  std::size_t normals_ = none;
  std::size_t kept_ = 0, kept_bytes_ = 0;  ///< files that stay open
  std::unique_ptr<MemoryBudget> opening_;  ///< of those that do not
};

}  // namespace gonio
