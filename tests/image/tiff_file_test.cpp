// TIFF in: sixteen bits and floats of light, by strips and tiles, and what is refused.
#include "image/tiff_file.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "refusal.h"
#include "support.h"
#include "tiff_bytes.h"

#include <gtest/gtest.h>
#ifdef GONIO_TIFF
#include <tiffio.h>
#endif

namespace gonio {
namespace {

using test::Folder;
using test::tiff_of;
using test::TiffImage;

#ifndef GONIO_TIFF
TEST(TiffFile, IsRefusedWhereGonioWasBuiltWithoutLibtiff) {
  const Folder f;
  EXPECT_HAS(test::refusal([&] { open_image(f.write("a.tif", tiff_of({}))); }), "without libtiff");
}
#else
constexpr Rectangle all_of_it{0, 0, 5, 4};

std::vector<float> plane_of(ImageFile& file, const Rectangle& part, std::size_t channel) {
  std::vector<float> first(part.size()), plane(part.size());
  const std::array<std::size_t, 2> both{0, channel};  // several at a time, as a stack reads them
  const std::array<float*, 2> to{first.data(), plane.data()};
  file.read(part, both, to);
  return plane;
}

/// Numbers of a part are 1000 y + 100 x + c, over the largest.
void expect_samples(ImageFile& file, const Rectangle& part, std::size_t channel, float largest) {
  const auto plane = plane_of(file, part, channel);
  for (std::size_t y = 0; y < part.height; ++y)
    for (std::size_t x = 0; x < part.width; ++x)
      EXPECT_EQ(plane[y * part.width + x],
                static_cast<float>(1000 * (part.y + y) + 100 * (part.x + x) + channel) / largest)
          << x << " " << y;
}

/// How libtiff writes a file of 37 × 29 pixels, whose samples are those of expect_samples().
struct ByLibtiff {
  const char* mode = "w";
  int packing = COMPRESSION_NONE, predictor = 1, planes = PLANARCONFIG_CONTIG;
  bool tiled = false, floats = false, alpha = false;
};
constexpr std::uint32_t tiff_width = 37, tiff_height = 29, tile_side = 16, strip_rows = 5;

void write_tiff(const std::string& path, const ByLibtiff& w) {
  const std::unique_ptr<TIFF, void (*)(TIFF*)> t(TIFFOpen(path.c_str(), w.mode), TIFFClose);
  const std::uint32_t samples = w.alpha ? 4 : 3, size = w.floats ? 4 : 2;
  const auto set = [&](std::uint32_t tag, auto... v) { TIFFSetField(t.get(), tag, v...); };
  set(TIFFTAG_IMAGEWIDTH, tiff_width);
  set(TIFFTAG_IMAGELENGTH, tiff_height);
  set(TIFFTAG_BITSPERSAMPLE, 8 * size);
  set(TIFFTAG_SAMPLESPERPIXEL, samples);
  set(TIFFTAG_SAMPLEFORMAT, w.floats ? SAMPLEFORMAT_IEEEFP : SAMPLEFORMAT_UINT);
  set(TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_RGB);
  set(TIFFTAG_PLANARCONFIG, w.planes);
  set(TIFFTAG_COMPRESSION, w.packing);
  if (w.predictor != 1) set(TIFFTAG_PREDICTOR, w.predictor);
  std::array<std::uint16_t, 1> none{EXTRASAMPLE_UNASSALPHA};
  if (w.alpha) set(TIFFTAG_EXTRASAMPLES, 1, none.data());
  if (w.tiled) {
    set(TIFFTAG_TILEWIDTH, tile_side);
    set(TIFFTAG_TILELENGTH, tile_side);
  } else {
    set(TIFFTAG_ROWSPERSTRIP, strip_rows);
  }
  const std::uint32_t across = w.tiled ? tile_side : tiff_width,
                      down = w.tiled ? tile_side : strip_rows;
  const bool apart = w.planes == PLANARCONFIG_SEPARATE;
  for (std::uint32_t plane = 0; plane < (apart ? samples : 1); ++plane)
    for (std::uint32_t y = 0; y < tiff_height; y += down)
      for (std::uint32_t x = 0; x < tiff_width; x += across) {
        std::string block;
        for (std::uint32_t v = y; v < (w.tiled ? y + down : std::min(tiff_height, y + down)); ++v)
          for (std::uint32_t u = x; u < x + across; ++u)
            for (std::uint32_t c = apart ? plane : 0; c < (apart ? plane + 1 : samples); ++c) {
              const auto n = static_cast<std::uint16_t>(1000 * v + 100 * u + c);
              const auto number = static_cast<float>(n);
              block.append(w.floats ? reinterpret_cast<const char*>(&number)
                                    : reinterpret_cast<const char*>(&n),
                           size);
            }
        const auto n = static_cast<tmsize_t>(block.size());
        if (w.tiled)
          TIFFWriteEncodedTile(t.get(),
                               TIFFComputeTile(t.get(), x, y, 0, static_cast<std::uint16_t>(plane)),
                               block.data(), n);
        else
          TIFFWriteEncodedStrip(t.get(),
                                TIFFComputeStrip(t.get(), y, static_cast<std::uint16_t>(plane)),
                                block.data(), n);
      }
}

TEST(TiffFile, OfSixteenBitsIsReadInPartsInAnyOrder) {
  const Folder f;
  const auto file = open_image(f.write("a.tif", tiff_of({})));
  EXPECT_EQ(file->width(), 5U);
  EXPECT_EQ(file->height(), 4U);
  EXPECT_EQ(file->channels(), (std::vector<std::string>{"R", "G", "B"}));
  EXPECT_TRUE(file->in_unit_range());
  expect_samples(*file, all_of_it, 1, 65535);
  expect_samples(*file, {2, 3, 2, 1}, 2, 65535);
  expect_samples(*file, {1, 0, 3, 2}, 0, 65535);
}

TEST(TiffFile, OfGreyOrOfFloatsIsReadAsItIs) {
  const Folder f;
  const auto grey = open_image(f.write("a.tif", tiff_of({.channels = 1})));
  EXPECT_EQ(grey->channels(), std::vector<std::string>{"Y"});
  expect_samples(*grey, all_of_it, 0, 65535);
  const auto floats = open_image(f.write("b.tif", tiff_of({.bits = 32})));
  EXPECT_FALSE(floats->in_unit_range());
  expect_samples(*floats, all_of_it, 2, 1);
}

TEST(TiffFile, IsReadInEachLayoutAndPackingThatItNames) {
  const Folder f;
  std::vector<ByLibtiff> all;
  for (const int packing :
       {COMPRESSION_NONE, COMPRESSION_LZW, COMPRESSION_ADOBE_DEFLATE, COMPRESSION_PACKBITS})
    for (const int planes : {PLANARCONFIG_CONTIG, PLANARCONFIG_SEPARATE})
      for (const bool tiled : {false, true}) all.push_back({"w", packing, 1, planes, tiled});
  all.push_back({"wb"});   // the big end first
  all.push_back({"w8b"});  // BigTIFF
  all.push_back({"w", COMPRESSION_ADOBE_DEFLATE, PREDICTOR_HORIZONTAL});
  all.push_back({"w", COMPRESSION_LZW, PREDICTOR_FLOATINGPOINT, PLANARCONFIG_CONTIG, true, true});
  all.push_back({"w", COMPRESSION_NONE, 1, PLANARCONFIG_CONTIG, false, false, true});
  for (const auto& w : all) {
    SCOPED_TRACE(std::string(w.mode) + " " + std::to_string(w.packing) + " " +
                 std::to_string(w.planes) + (w.tiled ? " tiles" : ""));
    write_tiff(f / "a.tif", w);
    const auto file = open_image(f / "a.tif", true);
    const float largest = w.floats ? 1 : 65535;
    for (const std::size_t channel : {0, 2}) {
      expect_samples(*file, {0, 0, tiff_width, tiff_height}, channel, largest);
      expect_samples(*file, {13, 14, 9, 6}, channel, largest);
    }
  }
}

TEST(TiffFile, IsRefusedWhereItsNumbersMayBeNoLight) {
  const Folder f;
  for (const auto& [what, image] :
       {std::pair<const char*, TiffImage>{"no curve", {.is_line = false}},
        {"that of 2.2", {.power = 1 / 2.2}}}) {
    f.write("a.tif", tiff_of(image));
    const std::string said = test::refusal([&] { open_image(f / "a.tif"); });
    for (const char* part : {"TransferFunction", "--linear"}) EXPECT_HAS(said, part);
    EXPECT_NO_THROW(open_image(f / "a.tif", true)) << what;
  }
  f.write("a.tif", tiff_of({.power = 1.002}));  // a line but for rounding
  EXPECT_NO_THROW(open_image(f / "a.tif"));
}

TEST(TiffFile, OfAnotherKindIsRefusedWithWhatToDo) {
  const Folder f;
  const auto said = [&](const TiffImage& t) {
    f.write("a.tif", tiff_of(t));
    return test::refusal([&] { open_image(f / "a.tif", true); });
  };
  EXPECT_HAS(said({.bits = 8}), "found 8 bits, expected grey or RGB of 16 bits");
  EXPECT_HAS(said({.bits = 8}), "develop the photograph so");
  EXPECT_HAS(said({.other_tags = {{{274, 3, 6}}}}), "orientation 6");
  EXPECT_HAS(said({.other_tags = {{{262, 3, 0}}}}), "colours of kind 0");
  EXPECT_HAS(said({.other_tags = {{{259, 3, 7}}}}), "compression 7");
  EXPECT_HAS(said({.other_tags = {{{257, 4, 1'000'000}}}}), "a.tif: header");
  EXPECT_HAS(said({.other_tags = {{{256, 4, 16'385}}}}), "a.tif: header");
}

TEST(TiffFile, ThatClaimsMoreThanItHasIsRefusedBeforeItIsRead) {
  const Folder f;
  // A strip of 4 GB; and a tag of as many numbers, which libtiff would keep.
  std::string bytes = tiff_of(
      {.other_tags = {{{259, 3, 5}, {278, 4, 16'384}, {256, 4, 16'384}, {257, 4, 16'384}}}});
  f.write("a.tif", bytes);
  EXPECT_HAS(test::refusal([&] { open_image(f / "a.tif", true); }),
             "strips or tiles of 1610612736 bytes");
  bytes = tiff_of({});
  std::uint32_t directory = 0;
  std::memcpy(&directory, &bytes[4], sizeof directory);
  const std::uint32_t many = 100'000'000;
  std::memcpy(&bytes[directory + 2 + 10 * 12 + 4], &many, sizeof many);  // of the curve
  f.write("a.tif", bytes);
  EXPECT_HAS(test::refusal([&] { open_image(f / "a.tif", true); }), "tag 301 of 100000000 numbers");
}

TEST(TiffFile, WhoseStripsAreNotAllThereIsRefused) {
  // What libtiff takes for pixels otherwise is what lies behind in the file.
  const Folder f;
  const auto said = [&](const TiffImage& t) {
    f.write("a.tif", tiff_of(t));
    return test::refusal([&] { open_image(f / "a.tif", true); });
  };
  EXPECT_EQ(said({}), "");
  EXPECT_HAS(said({.other_tags = {{{273, 4, 8}}}}), "found 1 places and 2 sizes");
  EXPECT_HAS(said({.other_tags = {{{279, 4, 90}}}}), "found 2 places and 1 sizes");
  EXPECT_HAS(said({.rows_per_strip = 4, .other_tags = {{{279, 4, 60}}}}),
             "strip 0: found 60 bytes, expected 120");
  EXPECT_HAS(said({.rows_per_strip = 4, .other_tags = {{{273, 4, 0}}}}), "at a place of their own");
}

TEST(TiffFile, WhoseTagsCountBeyondEveryNumberIsRefused) {
  // A BigTIFF of two tags, whose counts add up to 2^64: a sum that wraps around would let others
  // pass.
  std::string bytes("II+\0\x08\0\0\0\x10\0\0\0\0\0\0\0\x02\0\0\0\0\0\0\0", 24);
  bytes += std::string("\xe7\xfd\x01\0\x01", 5) + std::string(15, '\0');
  bytes += std::string("\xe8\xfd\x01\0", 4) + std::string(8, '\xff') + std::string(16, '\0');
  const Folder f;
  f.write("a.tif", bytes);
  EXPECT_HAS(test::refusal([&] { open_image(f / "a.tif", true); }),
             "tag 65000 of 18446744073709551615 numbers");
}

TEST(TiffFile, ThatIsDamagedIsReadOrRefusedAtEveryByteWithoutAWordOfLibtiffs) {
  const Folder f;
  testing::internal::CaptureStderr();
  for (const auto& w : {ByLibtiff{}, ByLibtiff{"w", COMPRESSION_LZW, 1, PLANARCONFIG_CONTIG, true},
                        ByLibtiff{"w8", COMPRESSION_ADOBE_DEFLATE}}) {
    write_tiff(f / "whole.tif", w);
    const std::string whole = test::read_bytes(f / "whole.tif");
    std::uint32_t directory = 8;
    if (w.mode == std::string("w")) std::memcpy(&directory, &whole[4], sizeof directory);
    const std::size_t step = 1 + whole.size() / 300;
    for (std::size_t at = 4; at < whole.size(); at += at + 1 < directory ? step : 1)
      for (const int kind : {0, 1, 2}) {
        std::string bytes = whole;
        if (kind == 0)
          bytes.resize(at);
        else
          bytes[at] = static_cast<char>(bytes[at] ^ (kind == 1 ? 0x21 : 0xff));
        std::filesystem::remove(f / "a.tif");  // a new file: one that is cut waits for the disk
        f.write("a.tif", bytes);
        test::refusal([&] {
          const auto file = open_image(f / "a.tif", true);
          if (file->width() * file->height() < 10'000)
            plane_of(*file, {0, 0, file->width(), file->height()}, 0);
        });
      }
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}
#endif

}  // namespace
}  // namespace gonio
