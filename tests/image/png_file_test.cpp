// PNG in: sixteen bits of light, by parts, and what is refused.
#include "image/png_file.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/error.h"
#include "image/png.h"
#include "refusal.h"
#include "support.h"

#include <gtest/gtest.h>
#include <malloc.h>
#include <png.h>

namespace gonio {
namespace {

using test::Folder;

struct Written {
  int depth = 16, type = PNG_COLOR_TYPE_RGB, interlace = PNG_INTERLACE_NONE;
  double gamma = 1;  ///< 0: says nothing
  bool srgb = false;
  int packed_texts = 0;  ///< each of 0.9 MB, packed to a thousandth
};
constexpr std::uint32_t wide = 5, high = 4;

/// Sample (x, y, c) is 1000 y + 100 x + c.
std::string png_of(const Written& w) {
  std::string bytes;
  png_struct* png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_info* info = png_create_info_struct(png);
  png_set_write_fn(
      png, &bytes,
      [](png_struct* p, png_byte* from, std::size_t n) {
        static_cast<std::string*>(png_get_io_ptr(p))
            ->append(reinterpret_cast<const char*>(from), n);
      },
      nullptr);
  png_set_IHDR(png, info, wide, high, w.depth, w.type, w.interlace, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  if (w.gamma > 0) png_set_gAMA(png, info, w.gamma);
  std::string blanks(900'000, ' ');
  for (int k = 0; k < w.packed_texts; ++k) {
    png_text text{};
    text.compression = PNG_TEXT_COMPRESSION_zTXt;
    std::string key = "Comment";
    text.key = key.data();
    text.text = blanks.data();
    text.text_length = blanks.size();
    png_set_text(png, info, &text, 1);
  }
  if (w.srgb) png_set_sRGB(png, info, PNG_sRGB_INTENT_RELATIVE);
  png_write_info(png, info);
  const std::size_t numbers = png_get_channels(png, info);
  for (int pass = 0; pass < (w.interlace == PNG_INTERLACE_NONE ? 1 : 7); ++pass)
    for (std::uint32_t y = 0; y < high; ++y) {
      std::vector<png_byte> row;
      for (std::uint32_t x = 0; x < wide; ++x)
        for (std::size_t c = 0; c < numbers; ++c) {
          const auto v = static_cast<std::uint32_t>(1000 * y + 100 * x + c);
          if (w.depth == 16) row.push_back(static_cast<png_byte>(v / 256));
          row.push_back(static_cast<png_byte>(v % 256));
        }
      png_write_row(png, row.data());
    }
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

std::vector<float> read_plane(ImageFile& file, const Rectangle& part, std::size_t channel) {
  std::vector<float> plane(part.size());
  const std::array<std::size_t, 1> only{channel};
  const std::array<float*, 1> to{plane.data()};
  file.read(part, only, to);
  return plane;
}

void expect_numbers(ImageFile& file, const Rectangle& part, std::size_t channel) {
  const auto plane = read_plane(file, part, channel);
  for (std::size_t y = 0; y < part.height; ++y)
    for (std::size_t x = 0; x < part.width; ++x)
      EXPECT_EQ(plane[y * part.width + x],
                static_cast<float>(1000 * (part.y + y) + 100 * (part.x + x) + channel) / 65535.0F)
          << x << " " << y;
}

TEST(PngFile, OfSixteenBitsIsReadInPartsInAnyOrder) {
  const Folder f;
  f.write("a.png", png_of({}));
  const auto file = open_image(f / "a.png");
  EXPECT_EQ(file->width(), wide);
  EXPECT_EQ(file->height(), high);
  EXPECT_EQ(file->channels(), (std::vector<std::string>{"R", "G", "B"}));
  expect_numbers(*file, {0, 0, wide, high}, 1);
  expect_numbers(*file, {2, 3, 2, 1}, 2);
  expect_numbers(*file, {1, 0, 3, 2}, 0);  // above: from the beginning
}

TEST(PngFile, KeepsNoTextInMemoryWhileItIsOpen) {
  const Folder f;
  f.write("a.png", png_of({.packed_texts = 20}));
  const auto before = mallinfo2().uordblks;
  const auto file = open_image(f / "a.png");
  EXPECT_LT(mallinfo2().uordblks - before, std::size_t{1} << 20) << "unpacked they are 18 MB";
  expect_numbers(*file, {0, 0, wide, high}, 1);
  EXPECT_GE(file->held(), mallinfo2().uordblks - before);
}

TEST(PngFile, LeavesTransparencyOutAndKnowsGrey) {
  const Folder f;
  f.write("a.png", png_of({16, PNG_COLOR_TYPE_GRAY_ALPHA}));
  const auto grey = open_image(f / "a.png");
  EXPECT_EQ(grey->channels(), std::vector<std::string>{"Y"});
  expect_numbers(*grey, {0, 0, wide, high}, 0);
  f.write("b.png", png_of({16, PNG_COLOR_TYPE_RGB_ALPHA}));
  expect_numbers(*open_image(f / "b.png"), {0, 0, wide, high}, 2);
}

TEST(PngFile, IsRefusedWhereItsNumbersMayBeNoLight) {
  const Folder f;
  Written none, srgb, gamma, eight, palette, interlaced;
  none.gamma = 0;
  srgb.srgb = true;
  srgb.gamma = 0;
  gamma.gamma = 0.45455;
  eight.depth = 8;
  interlaced.interlace = PNG_INTERLACE_ADAM7;
  for (const auto& [w, word] :
       {std::pair<Written, const char*>{none, "none"}, {srgb, "sRGB"}, {gamma, "0.45455"}}) {
    f.write("a.png", png_of(w));
    const std::string said = test::refusal([&] { open_image(f / "a.png"); });
    for (const char* part : {"gAMA", word, "linear"}) EXPECT_HAS(said, part);
    EXPECT_NO_THROW(open_image(f / "a.png", true)) << word;
  }
  f.write("a.png", png_of(eight));
  EXPECT_HAS(test::refusal([&] { open_image(f / "a.png", true); }), "8 bits");
  f.write("a.png", png_of(interlaced));
  EXPECT_HAS(test::refusal([&] { open_image(f / "a.png", true); }), "interlaced");
}

TEST(PngFile, ThatIsDamagedIsReadOrRefusedAtEveryByte) {
  const Folder f;
  const std::string whole = png_of({});
  for (std::size_t at = 6; at < whole.size(); ++at)
    for (const int kind : {0, 1}) {
      std::string bytes = whole;
      if (kind == 0)
        bytes.resize(at);
      else
        bytes[at] = static_cast<char>(bytes[at] ^ 0x21);
      f.write("a.png", bytes);
      try {
        const auto file = open_image(f / "a.png", true);
        if (file->width() * file->height() < 1000)
          read_plane(*file, {0, 0, file->width(), file->height()}, 0);
      } catch (const Error&) {
      }
    }
}

}  // namespace
}  // namespace gonio
