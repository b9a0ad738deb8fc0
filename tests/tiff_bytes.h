#pragma once
/// \file
/// TIFF files written byte by byte, without libtiff.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace gonio::test {

/// Image of whole numbers of 16 bits, or of floats.
struct TiffImage {
  std::uint32_t width = 5, height = 4;
  std::uint16_t channels = 3, bits = 16;
  bool is_line = true;  ///< has a TransferFunction that is a line
  double power = 1;     ///< of that function
  std::uint32_t rows_per_strip = 3;
  std::vector<std::array<std::uint32_t, 3>>
      other_tags{};  ///< tag, type (3: 16 bits, 4: 32 bits), value; these replace its own
  std::vector<double> numbers{};  ///< [texel][channel]; empty: 1000 y + 100 x + c
};

/// Little end first, unpacked, in strips.
inline std::string tiff_of(const TiffImage& t) {
  std::string bytes("II*\0\0\0\0\0", 8);
  const auto put = [](std::string& to, auto v) {
    to.append(reinterpret_cast<const char*>(&v), sizeof v);
  };
  std::string entries;
  std::uint16_t count = 0;
  const auto entry = [&](std::uint16_t tag, std::uint16_t type, std::uint32_t n, std::uint32_t v) {
    for (const auto& [other, its_type, value] : t.other_tags)
      if (other == tag) type = static_cast<std::uint16_t>(its_type), v = value, n = 1;
    put(entries, tag);
    put(entries, type);
    put(entries, n);
    put(entries, v);
    ++count;
  };
  const auto values = [&](std::uint16_t tag, std::uint16_t type, const std::string& them,
                          std::uint32_t n) {
    std::uint32_t at = static_cast<std::uint32_t>(bytes.size());
    if (them.size() <= sizeof at)
      at = 0, std::memcpy(&at, them.data(), them.size());
    else
      bytes += them;
    entry(tag, type, n, at);
  };
  std::string offsets, sizes, bits, format, curve;
  std::uint32_t strips = 0;
  for (std::uint32_t y = 0; y < t.height; y += t.rows_per_strip, ++strips) {
    put(offsets, static_cast<std::uint32_t>(bytes.size()));
    const auto begin = bytes.size();
    for (std::uint32_t v = y; v < std::min(t.height, y + t.rows_per_strip); ++v)
      for (std::uint32_t x = 0; x < t.width; ++x)
        for (std::uint32_t c = 0; c < t.channels; ++c) {
          const double number = t.numbers.empty() ? 1000 * v + 100 * x + c
                                                  : t.numbers[(v * t.width + x) * t.channels + c];
          if (t.bits == 8)
            put(bytes, static_cast<std::uint8_t>(number));
          else if (t.bits == 16)
            put(bytes, static_cast<std::uint16_t>(number));
          else
            put(bytes, static_cast<float>(number));
        }
    put(sizes, static_cast<std::uint32_t>(bytes.size() - begin));
  }
  for (std::uint16_t c = 0; c < t.channels; ++c) {
    put(bits, t.bits);
    put(format, static_cast<std::uint16_t>(t.bits == 32 ? 3 : 1));
  }
  constexpr std::uint32_t numbers = 1 << 16;
  if (t.is_line && t.bits == 16)
    for (std::uint32_t k = 0; k < numbers; ++k)
      put(curve, static_cast<std::uint16_t>(65535 * std::pow(k / 65535.0, t.power) + 0.5));
  entry(256, 4, 1, t.width);
  entry(257, 4, 1, t.height);
  values(258, 3, bits, t.channels);
  entry(259, 3, 1, 1);
  entry(262, 3, 1, t.channels < 3 ? 1 : 2);
  values(273, 4, offsets, strips);
  entry(274, 3, 1, 1);
  entry(277, 3, 1, t.channels);
  entry(278, 4, 1, t.rows_per_strip);
  values(279, 4, sizes, strips);
  if (!curve.empty()) values(301, 3, curve, numbers);
  values(339, 3, format, t.channels);
  const auto directory = static_cast<std::uint32_t>(bytes.size());
  std::memcpy(&bytes[4], &directory, sizeof directory);
  put(bytes, count);
  bytes += entries;
  put(bytes, std::uint32_t{0});
  return bytes;
}

}  // namespace gonio::test
