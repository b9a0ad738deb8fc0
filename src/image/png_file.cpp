#include "image/png_file.h"

#include <array>
#include <cmath>
#include <csetjmp>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <new>
#include <optional>

#include "base/error.h"
#include "base/file.h"
#include "base/text.h"

#include <fmt/format.h>
#include <png.h>

namespace gonio {
namespace {

/// Does something that leaves by longjmp where libpng gives up: it may own nothing that has a destructor.
template <class Do>
bool done(png_struct* png, Do&& something) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  something();
  return true;
}

/// libpng's two structs, taken away with whoever has them.
struct PngStructs {
  png_struct* png = nullptr;
  png_info* info = nullptr;
  PngStructs() = default;
  PngStructs(const PngStructs&) = delete;
  PngStructs& operator=(const PngStructs&) = delete;
  ~PngStructs() { end(); }
  void end() { png_destroy_read_struct(&png, &info, nullptr); }
};

/// Names of chunks that say nothing of light, each with its 0.
constexpr auto passed_over =
    std::to_array<png_byte>({'t', 'E', 'X', 't', 0, 'z', 'T', 'X', 't', 0, 'i', 'T', 'X', 't', 0,
                             'i', 'C', 'C', 'P', 0, 's', 'P', 'L', 'T', 0, 'e', 'X', 'I', 'f', 0});

class PngFile final : public ImageFile {
 public:
  PngFile(const std::string& path, bool linear) : ImageFile(path) {
    begin();
    width_ = png_get_image_width(structs_.png, structs_.info);
    height_ = png_get_image_height(structs_.png, structs_.info);
    const int depth = png_get_bit_depth(structs_.png, structs_.info),
              type = png_get_color_type(structs_.png, structs_.info);
    if (type == PNG_COLOR_TYPE_PALETTE || depth != 16)
      throw bad_input(
          path_, "header",
          fmt::format("{} bits{}", depth, type == PNG_COLOR_TYPE_PALETTE ? " of a palette" : ""),
          "16 bits a channel: eight hold too few steps of light");
    if (png_get_interlace_type(structs_.png, structs_.info) != PNG_INTERLACE_NONE)
      throw bad_input(path_, "header", "interlaced rows", "rows from the top");
    double gamma = 0;
    const bool says = png_get_gAMA(structs_.png, structs_.info, &gamma) != 0,
               is_srgb = png_get_valid(structs_.png, structs_.info, PNG_INFO_sRGB) != 0;
    if (!linear && (is_srgb || !says || std::abs(gamma - 1) > 0.01))
      throw bad_input(
          path_, "gAMA",
          is_srgb ? "sRGB"
          : says  ? fmt::format("{:.5g}", gamma)
                  : std::string("none"),
          "1, as of light; or \"linear\": true in the stack (gonio stack --linear), if its "
          "numbers are light all the same");
    if ((type & PNG_COLOR_MASK_COLOR) != 0)
      channels_ = {"R", "G", "B"};
    else
      channels_ = {"Y"};
    samples_ = channels_.size() + ((type & PNG_COLOR_MASK_ALPHA) != 0 ? 1 : 0);
    row_.resize(width_ * samples_ * 2);
    constexpr std::size_t of_libraries = std::size_t{1} << 18;  // zlib's window, libpng's structs
    held_ = 3 * row_.size() + of_libraries;                     // libpng has this row and the last
    block_width_ = width_;
    in_unit_range_ = true;
  }

  void read(const Rectangle& part,
            std::span<const std::size_t> channels,
            std::span<float* const> to) override {
    if (!structs_.png || part.y < next_) begin();
    for (std::size_t y = 0; y < part.height; ++y) {
      while (next_ <= part.y + y) {
        png_byte* const row = row_.data();
        if (!done(structs_.png, [&] { png_read_row(structs_.png, row, nullptr); }))
          refuse(fmt::format("row {}", next_));
        ++next_;
      }
      for (std::size_t c = 0; c < channels.size(); ++c)
        for (std::size_t x = 0; x < part.width; ++x) {
          const png_byte* const at = &row_[((part.x + x) * samples_ + channels[c]) * 2];
          to[c][y * part.width + x] = static_cast<float>(at[0] * 256 + at[1]) / 65535.0F;
        }
    }
  }

 private:
  void begin() {
    structs_.end();
    in_.emplace(path_);
    next_ = 0;
    message_ = {};
    structs_.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, on_error,
                                          [](png_struct*, const char*) {});
    structs_.info = structs_.png ? png_create_info_struct(structs_.png) : nullptr;
    if (!structs_.info) throw std::bad_alloc();
    const bool read = done(structs_.png, [&] {
      png_set_user_limits(structs_.png, longest_side, longest_side);
      png_set_chunk_malloc_max(structs_.png, 1 << 20);
      png_set_chunk_cache_max(structs_.png, 1);
      // Of these each would be kept while the file is open, unpacked.
      png_set_keep_unknown_chunks(structs_.png, PNG_HANDLE_CHUNK_NEVER, passed_over.data(),
                                  passed_over.size() / 5);
      png_set_read_fn(structs_.png, this, on_read);
      png_read_info(structs_.png, structs_.info);
    });
    if (!read) refuse("header");
    // Of a file that became another one meanwhile, rows have another length.
    if (!row_.empty() && (png_get_rowbytes(structs_.png, structs_.info) != row_.size() ||
                          png_get_image_height(structs_.png, structs_.info) != height_))
      throw bad_input(path_, "header", "another size than before", "a file that stays as it is");
  }
  [[noreturn]] void refuse(const std::string& place) {
    const std::string found = printable(message_.data(), 100);
    structs_.end();
    throw bad_input(path_, place, found, fmt::format("a PNG of at most {0} × {0}", longest_side));
  }
  void keep(const char* message) {
    if (message != message_.data()) std::snprintf(message_.data(), message_.size(), "%s", message);
  }
  static void on_error(png_struct* png, const char* message) {
    static_cast<PngFile*>(png_get_error_ptr(png))->keep(message);
    png_longjmp(png, 1);
  }
  /// False where there are not as many bytes: no exception may pass through libpng.
  bool read_bytes(png_byte* to, std::size_t n) {
    try {
      in_->read(to, n);
      return true;
    } catch (const std::exception& e) {
      keep(e.what());
      return false;
    }
  }
  static void on_read(png_struct* png, png_byte* to, std::size_t n) {
    auto& file = *static_cast<PngFile*>(png_get_io_ptr(png));
    if (!file.read_bytes(to, n)) png_error(png, file.message_.data());
  }

  std::optional<InputFile> in_;
  PngStructs structs_;
  std::size_t next_ = 0, samples_ = 0;  ///< the row that is read next; numbers of a texel
  std::vector<png_byte> row_;
  std::array<char, 128> message_{};
};

}  // namespace

bool is_png(std::string_view first) {
  return first.starts_with("\x89PNG\r\n");
}

std::unique_ptr<ImageFile> open_png(const std::string& path, bool linear) {
  return std::make_unique<PngFile>(path, linear);
}

}  // namespace gonio
