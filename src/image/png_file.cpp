#include "image/png_file.h"

#include <cmath>
#include <csetjmp>
#include <cstdint>
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

class PngFile final : public ImageFile {
 public:
  PngFile(const std::string& path, bool linear) : ImageFile(path) {
    begin();
    width_ = png_get_image_width(png_, info_);
    height_ = png_get_image_height(png_, info_);
    const int depth = png_get_bit_depth(png_, info_), type = png_get_color_type(png_, info_);
    if (type == PNG_COLOR_TYPE_PALETTE || depth != 16)
      throw bad_input(
          path_, "header",
          fmt::format("{} bits{}", depth, type == PNG_COLOR_TYPE_PALETTE ? " of a palette" : ""),
          "16 bits a channel: eight hold too few steps of light");
    if (png_get_interlace_type(png_, info_) != PNG_INTERLACE_NONE)
      throw bad_input(path_, "header", "interlaced rows", "rows from the top");
    double gamma = 0;
    const bool says = png_get_gAMA(png_, info_, &gamma) != 0,
               is_srgb = png_get_valid(png_, info_, PNG_INFO_sRGB) != 0;
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
  }
  ~PngFile() override { end(); }

  void read(const Rectangle& part,
            std::span<const std::size_t> channels,
            std::span<float* const> to) override {
    if (!png_ || part.y < next_) begin();
    for (std::size_t y = 0; y < part.height; ++y) {
      while (next_ <= part.y + y) {
        png_byte* const row = row_.data();
        if (!done(png_, [&] { png_read_row(png_, row, nullptr); }))
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
    end();
    in_.emplace(path_);
    next_ = 0;
    message_ = {};
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, on_error,
                                  [](png_struct*, const char*) {});
    info_ = png_ ? png_create_info_struct(png_) : nullptr;
    if (!info_) throw std::bad_alloc();
    const bool read = done(png_, [&] {
      png_set_user_limits(png_, longest_side, longest_side);
      png_set_chunk_malloc_max(png_, 1 << 20);
      png_set_chunk_cache_max(png_, 64);
      png_set_read_fn(png_, this, on_read);
      png_read_info(png_, info_);
    });
    if (!read) refuse("header");
  }
  void end() { png_destroy_read_struct(&png_, &info_, nullptr); }
  [[noreturn]] void refuse(const std::string& place) {
    const std::string found = printable(message_.data(), 100);
    end();
    throw bad_input(path_, place, found, fmt::format("a PNG of at most {0} × {0}", longest_side));
  }
  static void on_error(png_struct* png, const char* message) {
    auto& of = *static_cast<PngFile*>(png_get_error_ptr(png));
    std::snprintf(of.message_.data(), of.message_.size(), "%s", message);
    png_longjmp(png, 1);
  }
  static void on_read(png_struct* png, png_byte* to, std::size_t n) {
    auto& in = *static_cast<PngFile*>(png_get_io_ptr(png))->in_;
    if (in.size() - in.position() < n) png_error(png, "the end of the file");
    in.read(to, n);
  }

  std::optional<InputFile> in_;
  png_struct* png_ = nullptr;
  png_info* info_ = nullptr;
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
