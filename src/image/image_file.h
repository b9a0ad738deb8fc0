#pragma once
/// \file
/// Images on disk, read part by part: what is larger than memory has its parts in it alone.

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace gonio {

/// Most pixels along a side of an image, or of a tile of one.
inline constexpr std::size_t longest_side = std::size_t{1} << 14;

/// Part of an image; row 0 is its top one.
struct Rectangle {
  std::size_t x = 0, y = 0, width = 0, height = 0;
  std::size_t size() const { return width * height; }
  bool operator==(const Rectangle&) const = default;
};

/// At most so many rows, one at least, of whole blocks where these are no higher.
inline std::size_t whole_blocks(std::size_t most, std::size_t block_height) {
  return most >= block_height ? most / block_height * block_height : std::max<std::size_t>(most, 1);
}

/// Open image.  Not shared by threads.
class ImageFile {
 public:
  explicit ImageFile(std::string path) : path_(std::move(path)) {}
  virtual ~ImageFile() = default;
  ImageFile(const ImageFile&) = delete;
  ImageFile& operator=(const ImageFile&) = delete;

  const std::string& path() const { return path_; }
  std::size_t width() const { return width_; }
  std::size_t height() const { return height_; }
  const std::vector<std::string>& channels() const { return channels_; }
  /// Columns and rows that are stored as one: parts of whole ones, from a multiple of them on, read nothing twice.
  std::size_t block_width() const { return block_width_; }
  std::size_t block_height() const { return block_height_; }

  /// Whether its numbers go from 0 to 1: a file's whole ones over their largest.
  bool in_unit_range() const { return in_unit_range_; }
  /// Bytes that it holds in memory while it is open.
  std::size_t held() const { return held_; }

  /// Values of a part that lies within the image, rows one after the other.
  /// \param channels  indices into channels()
  /// \param to        for each of them room for the part
  virtual void read(const Rectangle&,
                    std::span<const std::size_t> channels,
                    std::span<float* const> to) = 0;

 protected:
  std::string path_;
  std::size_t width_ = 0, height_ = 0, block_width_ = 1, block_height_ = 1, held_ = 0;
  bool in_unit_range_ = false;
  std::vector<std::string> channels_;
};

/// Image of a path: OpenEXR of one part, scan lines or tiles, an array of NumPy's, a PNG or a TIFF of light.  At most `longest_side` pixels wide or high.
/// \param linear  said of a PNG or TIFF that does not say that its numbers are light
std::unique_ptr<ImageFile> open_image(const std::string& path, bool linear = false);

}  // namespace gonio
