#pragma once
/// \file
/// Arrays of NumPy's, .npy: a header in Python's words, then the numbers.
///     [numpy.lib.format, NumPy 1.x and 2.x: versions 1.0, 2.0 and 3.0]

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/file.h"
#include "base/names.h"
#include "image/image_file.h"

namespace gonio {

/// Numbers that are read, by NumPy's names: floats and unsigned integers, the lower byte first.
enum class NpyNumber { f2, f4, f8, u1, u2, u4 };
template <>
inline constexpr std::array<std::string_view, 6> names_of<NpyNumber>{"<f2", "<f4", "<f8",
                                                                     "|u1", "<u2", "<u4"};
std::size_t size_of(NpyNumber);  ///< [bytes]

struct NpyHeader {
  NpyNumber number = NpyNumber::f4;
  bool fortran_order = false;  ///< the first index runs fastest, not the last
  std::vector<std::size_t> shape;
  std::uint64_t begins = 0;  ///< byte of the first number
};

/// True of the first six bytes.
bool is_npy(std::string_view first);
/// Header of a file that is as long as it says.  Refused: anything but one array of `NpyNumber`, a header of more than 64 KiB,
/// a shape whose bytes are not those of the file.
NpyHeader read_npy_header(InputFile&);
/// Bytes before the numbers of an array of floats, version 1.0, the last index fastest.
std::string npy_header(const std::vector<std::size_t>& shape);

/// Image of an array (height, width), whose channel is Y, or (height, width, channels): R, G and B of three, else 1, 2 …
/// Integers are as they are.  Parts of arrays in Fortran's order are read column by column, which takes longer.
std::unique_ptr<ImageFile> open_npy(const std::string& path);

}  // namespace gonio
