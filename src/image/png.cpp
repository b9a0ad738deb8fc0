#include "image/png.h"

#include <csetjmp>
#include <new>

#include <png.h>

namespace gonio {
namespace {

void append(png_struct* png, png_byte* bytes, std::size_t n) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(bytes), n);
}

/// False where libpng gave up.  It leaves by longjmp: nothing here has a destructor.
bool write(png_struct* png,
           png_info* info,
           std::string& to,
           const PngImage& image,
           std::vector<png_text>& text) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_write_fn(png, &to, append, nullptr);
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width),
               static_cast<png_uint_32>(image.height), 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (image.is_srgb) png_set_sRGB(png, info, PNG_sRGB_INTENT_RELATIVE);
  png_set_text(png, info, text.data(), static_cast<int>(text.size()));
  png_write_info(png, info);
  for (std::size_t y = 0; y < image.height; ++y)
    png_write_row(png, image.pixels[y * image.width].data());
  png_write_end(png, info);
  return true;
}

}  // namespace

std::string png_bytes(const PngImage& image) {
  auto keys_and_values = image.text;  // libpng takes pointers to mutable text
  std::vector<png_text> text;
  for (auto& [key, value] : keys_and_values) {
    png_text t{};
    t.compression = PNG_TEXT_COMPRESSION_NONE;
    t.key = key.data();
    t.text = value.data();
    t.text_length = value.size();
    text.push_back(t);
  }
  png_struct* png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_info* info = png ? png_create_info_struct(png) : nullptr;
  std::string bytes;
  const bool done = info && write(png, info, bytes, image, text);
  png_destroy_write_struct(&png, &info);
  if (!done) throw std::bad_alloc();  // all that is left to fail in memory
  return bytes;
}

}  // namespace gonio
