#include "image/tiff_file.h"

#include "base/error.h"

#ifdef GONIO_TIFF
#include <array>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <vector>

#include "base/file.h"
#include "base/text.h"

#include <fmt/format.h>
#include <tiffio.h>
#endif

namespace gonio {

bool is_tiff(std::string_view first) {
  for (const std::string_view magic : {std::string_view("II*\0", 4), std::string_view("MM\0*", 4),
                                       std::string_view("II+\0", 4), std::string_view("MM\0+", 4)})
    if (first.starts_with(magic)) return true;
  return false;
}

#ifdef GONIO_TIFF
namespace {

constexpr std::uint64_t most_directory_bytes = std::uint64_t{1} << 24,
                        most_packed_together = std::uint64_t{1} << 27;

/// Whole numbers of a file, in its own order of bytes.
class WholeNumbers {
 public:
  explicit WholeNumbers(const InputFile& in) : in_(in) { in.read_at(0, &order_, 1); }
  std::uint64_t operator()(std::uint64_t at, std::size_t n) const {
    std::array<unsigned char, 8> bytes{};
    in_.read_at(at, bytes.data(), n);
    std::uint64_t v = 0;
    for (std::size_t k = 0; k < n; ++k) v = v << 8U | bytes[order_ == 'I' ? n - 1 - k : k];
    return v;
  }

 private:
  const InputFile& in_;
  char order_ = 0;
};

/// What the first directory says, where libtiff mends what it does not say.
struct Directory {
  struct Numbers {
    std::uint64_t count = 0, at = 0;
    std::size_t size = 1;
  };
  std::uint64_t bytes = 0;  ///< of all entries
  Numbers offsets, counts;  ///< of strips or tiles
};

/// Reads the first directory.  libtiff keeps what each entry claims to be, even where many claim the same bytes of the file: more than
/// `most_directory_bytes`, or 1000 entries, are refused.
Directory directory_of(const InputFile& in) {
  const WholeNumbers number(in);
  const bool big = number(2, 2) == TIFF_VERSION_BIG;
  const std::size_t word = big ? 8 : 4, before = big ? 8 : 2;
  const std::uint64_t begin = number(word, word), entries = number(begin, before);
  constexpr std::uint64_t most_entries = 1000;
  if (entries > most_entries)
    throw bad_input(in.path(), "directory", fmt::format("{} entries", entries),
                    fmt::format("at most {}", most_entries));
  Directory d;
  for (std::uint64_t k = 0; k < entries; ++k) {
    const std::uint64_t at = begin + before + k * (4 + 2 * word), tag = number(at, 2),
                        type = number(at + 2, 2), count = number(at + 4, word);
    const std::size_t size = type == 1 || type == 2 || type == 6 || type == 7     ? 1
                             : type == 3 || type == 8                             ? 2
                             : type == 4 || type == 9 || type == 11 || type == 13 ? 4
                                                                                  : 8;
    if (count > (most_directory_bytes - d.bytes) / size)
      throw bad_input(in.path(), "directory", fmt::format("tag {} of {} numbers", tag, count),
                      fmt::format("at most {} bytes of all tags: save the image without layers",
                                  most_directory_bytes));
    d.bytes += count * size;
    const std::uint64_t value = at + 4 + word;
    const Directory::Numbers numbers{count, count * size > word ? number(value, word) : value,
                                     size};
    if (tag == TIFFTAG_STRIPOFFSETS || tag == TIFFTAG_TILEOFFSETS) d.offsets = numbers;
    if (tag == TIFFTAG_STRIPBYTECOUNTS || tag == TIFFTAG_TILEBYTECOUNTS) d.counts = numbers;
  }
  return d;
}

class TiffFile final : public ImageFile {
 public:
  TiffFile(const std::string& path, bool linear) : ImageFile(path), in_(path) {
    constexpr std::uint64_t few = 1 << 16;
    const Directory directory = directory_of(in_);
    held_ = 2 * directory.bytes + few;
    open();
    const auto field = [&](std::uint32_t tag, auto value) {
      TIFFGetFieldDefaulted(tiff_.get(), tag, &value);
      return value;
    };
    const auto number = [&](std::uint32_t tag) { return int{field(tag, std::uint16_t{0})}; };
    const auto expect = [&](bool holds, const std::string& found) {
      if (!holds)
        throw bad_input(
            path_, "header", found,
            "grey or RGB of 16 bits a channel, or of floats of 32, upright, unpacked or "
            "packed by LZW, deflate or PackBits: develop the photograph so");
    };
    const int packing = number(TIFFTAG_COMPRESSION), kind = number(TIFFTAG_PHOTOMETRIC),
              bits = number(TIFFTAG_BITSPERSAMPLE), format = number(TIFFTAG_SAMPLEFORMAT),
              turned = number(TIFFTAG_ORIENTATION);
    in_unit_range_ = bits == 16 && format == SAMPLEFORMAT_UINT;
    expect(in_unit_range_ || (bits == 32 && format == SAMPLEFORMAT_IEEEFP),
           fmt::format("{} bits{}", bits, bits > 8 ? fmt::format(" of format {}", format) : ""));
    expect(packing == COMPRESSION_NONE || packing == COMPRESSION_LZW ||
               packing == COMPRESSION_ADOBE_DEFLATE || packing == COMPRESSION_DEFLATE ||
               packing == COMPRESSION_PACKBITS,
           fmt::format("compression {}", packing));
    samples_ = static_cast<std::size_t>(number(TIFFTAG_SAMPLESPERPIXEL));
    if (kind == PHOTOMETRIC_RGB)
      channels_ = {"R", "G", "B"};
    else
      channels_ = {"Y"};
    constexpr std::size_t most_others = 4;
    expect(kind == PHOTOMETRIC_RGB || kind == PHOTOMETRIC_MINISBLACK,
           fmt::format("colours of kind {}", kind));
    expect(samples_ >= channels_.size() && samples_ <= channels_.size() + most_others,
           fmt::format("{} channels", samples_));
    expect(turned == ORIENTATION_TOPLEFT, fmt::format("orientation {}", turned));
    is_apart_ = number(TIFFTAG_PLANARCONFIG) == PLANARCONFIG_SEPARATE;

    is_tiled_ = TIFFIsTiled(tiff_.get()) != 0;
    width_ = field(TIFFTAG_IMAGEWIDTH, std::uint32_t{0});
    height_ = field(TIFFTAG_IMAGELENGTH, std::uint32_t{0});
    const std::size_t rows = field(TIFFTAG_ROWSPERSTRIP, std::uint32_t{0});
    block_width_ = is_tiled_ ? field(TIFFTAG_TILEWIDTH, std::uint32_t{0}) : width_;
    block_height_ =
        is_tiled_ ? field(TIFFTAG_TILELENGTH, std::uint32_t{0}) : std::min(rows, height_);
    for (const std::size_t side : {width_, height_, block_width_, block_height_})
      if (side == 0 || side > longest_side)
        throw bad_input(path_, "header", fmt::format("a side of {} pixels", side),
                        fmt::format("1 to {}", longest_side));
    const std::uint64_t bytes =
        block_width_ * block_height_ * (is_apart_ ? 1 : samples_) * (in_unit_range_ ? 2 : 4);
    std::uint64_t packed = 0;
    const std::uint32_t blocks =
        is_tiled_ ? TIFFNumberOfTiles(tiff_.get()) : TIFFNumberOfStrips(tiff_.get());
    constexpr std::uint32_t most_blocks = 1 << 20;
    expect(blocks <= most_blocks, fmt::format("{} strips or tiles", blocks));
    if (directory.offsets.count < blocks || directory.counts.count < blocks)
      throw bad_input(path_, "directory",
                      fmt::format("{} places and {} sizes of strips or tiles",
                                  directory.offsets.count, directory.counts.count),
                      fmt::format("{} of each", blocks));
    const std::size_t down = (height_ + block_height_ - 1) / block_height_;
    const WholeNumbers number_at(in_);
    for (std::uint32_t k = 0; k < blocks; ++k) {
      packed = std::max(packed, TIFFGetStrileByteCount(tiff_.get(), k));
      const std::size_t rows_there =
          is_tiled_ ? block_height_ : std::min(block_height_, height_ - k % down * block_height_);
      const std::uint64_t need =
                              packing == COMPRESSION_NONE ? bytes / block_height_ * rows_there : 1,
                          there = number_at(directory.counts.at + k * directory.counts.size,
                                            directory.counts.size);
      if (TIFFGetStrileOffset(tiff_.get(), k) == 0 || there < need)
        throw bad_input(path_, fmt::format("{} {}", is_tiled_ ? "tile" : "strip", k),
                        fmt::format("{} bytes", there),
                        fmt::format("{} or more, at a place of their own", need));
    }
    if (bytes > most_packed_together || packed > 2 * bytes + few)
      throw bad_input(path_, "header",
                      fmt::format("strips or tiles of {} bytes, packed in up to {}", bytes, packed),
                      fmt::format("at most {}, and no more when packed", most_packed_together));
    held_ += bytes + packed;
    block_bytes_ = bytes;
    if (in_unit_range_ && !linear && !is_line())
      throw bad_input(path_, "TransferFunction", "none that is a line",
                      "one, as of light; or \"linear\": true in the stack (gonio stack --linear), "
                      "if its numbers are light all the same");
  }

  void read(const Rectangle& part,
            std::span<const std::size_t> channels,
            std::span<float* const> to) override {
    if (!is_apart_) return read_blocks(part, channels, to);
    for (std::size_t c = 0; c < channels.size(); ++c)
      read_blocks(part, channels.subspan(c, 1), to.subspan(c, 1));
  }

 private:
  struct Close {
    void operator()(TIFF* t) const { TIFFClose(t); }
    void operator()(TIFFOpenOptions* o) const { TIFFOpenOptionsFree(o); }
  };

  void open() {
    const std::unique_ptr<TIFFOpenOptions, Close> options(TIFFOpenOptionsAlloc());
    if (!options) throw std::bad_alloc();
    TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), 2 * most_packed_together);
    TIFFOpenOptionsSetErrorHandlerExtR(options.get(), on_error, this);
    TIFFOpenOptionsSetWarningHandlerExtR(
        options.get(), [](TIFF*, void*, const char*, const char*, va_list) { return 1; }, nullptr);
    // m: not mapped, since a file that is cut meanwhile would end the program.
    tiff_.reset(TIFFClientOpenExt(
        "image", "rm", this, on_read, [](thandle_t, void*, tmsize_t) { return tmsize_t{-1}; },
        on_seek, [](thandle_t) { return 0; },
        [](thandle_t file) { return static_cast<TiffFile*>(file)->in_.size(); }, nullptr, nullptr,
        options.get()));
    if (!tiff_) refuse("header");
  }
  [[noreturn]] void refuse(const std::string& place) {
    throw bad_input(path_, place, printable(message_.data(), 100),
                    fmt::format("a whole TIFF of at most {0} × {0}", longest_side));
  }
  static int on_error(TIFF*, void* file, const char*, const char* format, va_list values) {
    auto& message = static_cast<TiffFile*>(file)->message_;
    if (message[0] == 0) std::vsnprintf(message.data(), message.size(), format, values);
    return 1;
  }
  static tmsize_t on_read(thandle_t file, void* to, tmsize_t n) {
    auto& f = *static_cast<TiffFile*>(file);
    const std::uint64_t left = f.in_.size() - std::min(f.position_, f.in_.size()),
                        count = std::min(left, static_cast<std::uint64_t>(n));
    try {
      f.in_.read_at(f.position_, to, count);
    } catch (const std::exception&) {
      return -1;  // no exception may pass through libtiff, which says that it cannot read
    }
    f.position_ += count;
    return static_cast<tmsize_t>(count);
  }
  static toff_t on_seek(thandle_t file, toff_t to, int from) {
    auto& f = *static_cast<TiffFile*>(file);
    f.position_ = to + (from == SEEK_CUR ? f.position_ : from == SEEK_END ? f.in_.size() : 0);
    return f.position_;
  }

  /// Whether the curve from a file's numbers to light is a line, to half a percent of the whole range.
  bool is_line() {
    std::array<std::uint16_t*, 3> curves{};
    if (TIFFGetField(tiff_.get(), TIFFTAG_TRANSFERFUNCTION, &curves[0], &curves[1], &curves[2]) !=
        1)
      return false;
    constexpr int numbers = 1 << 16, off = 328;
    for (const std::uint16_t* curve : curves)
      for (int k = 0; curve && k < numbers; ++k)
        if (std::abs(curve[k] - k) > off) return false;
    return true;
  }

  /// Has the strip or tile of a pixel unpacked.
  void load(std::size_t x, std::size_t y, std::size_t channel) {
    const auto sample = static_cast<std::uint16_t>(is_apart_ ? channel : 0);
    const auto row = static_cast<std::uint32_t>(y);
    const std::uint32_t number =
        is_tiled_ ? TIFFComputeTile(tiff_.get(), static_cast<std::uint32_t>(x), row, 0, sample)
                  : TIFFComputeStrip(tiff_.get(), row, sample);
    if (is_loaded_ && number == loaded_) return;
    is_loaded_ = false;
    message_ = {};
    block_.resize(block_bytes_);
    const auto n = static_cast<tmsize_t>(
        is_tiled_ ? block_.size()
                  : block_.size() / block_height_ *
                        std::min(block_height_, height_ - y / block_height_ * block_height_));
    if ((is_tiled_ ? TIFFReadEncodedTile(tiff_.get(), number, block_.data(), n)
                   : TIFFReadEncodedStrip(tiff_.get(), number, block_.data(), n)) != n)
      refuse(fmt::format("{} {}", is_tiled_ ? "tile" : "strip", number));
    is_loaded_ = true;
    loaded_ = number;
  }

  void read_blocks(const Rectangle& part,
                   std::span<const std::size_t> channels,
                   std::span<float* const> to) {
    const std::size_t samples = is_apart_ ? 1 : samples_;
    const std::size_t right = part.x + part.width, bottom = part.y + part.height;
    // Column and row of the next block.
    const auto after = [](std::size_t at, std::size_t step) { return (at / step + 1) * step; };
    for (std::size_t y = part.y; y < bottom; y = after(y, block_height_))
      for (std::size_t x = part.x; x < right; x = after(x, block_width_)) {
        load(x, y, channels[0]);
        for (std::size_t v = y; v < std::min(bottom, after(y, block_height_)); ++v)
          for (std::size_t u = x; u < std::min(right, after(x, block_width_)); ++u)
            for (std::size_t c = 0; c < channels.size(); ++c)
              to[c][(v - part.y) * part.width + u - part.x] =
                  value(((v % block_height_) * block_width_ + u % block_width_) * samples +
                        (is_apart_ ? 0 : channels[c]));
      }
  }
  float value(std::size_t k) const {
    constexpr float most = 65535;
    std::uint16_t whole = 0;
    float number = 0;
    if (in_unit_range_)
      std::memcpy(&whole, &block_[2 * k], sizeof whole), number = static_cast<float>(whole) / most;
    else
      std::memcpy(&number, &block_[4 * k], sizeof number);
    return number;
  }

  InputFile in_;
  std::uint64_t position_ = 0;
  std::array<char, 128> message_{};
  bool is_apart_ = false, is_tiled_ = false, is_loaded_ = false;
  std::size_t samples_ = 1, block_bytes_ = 0;
  std::uint32_t loaded_ = 0;  ///< strip or tile in block_, where is_loaded_
  std::vector<unsigned char> block_;
  std::unique_ptr<TIFF, Close> tiff_;
};

}  // namespace

std::unique_ptr<ImageFile> open_tiff(const std::string& path, bool linear) {
  return std::make_unique<TiffFile>(path, linear);
}
#else
std::unique_ptr<ImageFile> open_tiff(const std::string& path, bool /*linear*/) {
  throw bad_input(path, "byte 0", "a TIFF", "another image: this gonio was built without libtiff");
}
#endif

}  // namespace gonio
