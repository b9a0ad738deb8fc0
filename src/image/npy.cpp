#include "image/npy.h"

#include <cctype>
#include <cstring>
#include <optional>

#include "base/error.h"
#include "base/numbers.h"
#include "image/exr_parts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {
namespace {

constexpr std::string_view kMagic = "\x93NUMPY";

/// Words of a header: {'descr': '<f4', 'fortran_order': False, 'shape': (3, 4), }
class Dictionary {
 public:
  Dictionary(const std::string& path, std::string_view text, std::uint64_t begins)
      : path_(path), text_(text), begins_(begins) {}

  NpyHeader read() {
    NpyHeader header;
    bool has_descr = false, has_order = false, has_shape = false;
    expect('{');
    while (!accept('}')) {
      const std::string key = quoted();
      expect(':');
      if (key == "descr" && !has_descr) {
        header.number = number();
        has_descr = true;
      } else if (key == "fortran_order" && !has_order) {
        header.fortran_order = truth();
        has_order = true;
      } else if (key == "shape" && !has_shape) {
        header.shape = shape();
        has_shape = true;
      } else {
        fail("the key " + key, "descr, fortran_order and shape, each once");
      }
      if (!accept(',')) {
        expect('}');
        break;
      }
    }
    skip_blanks();
    if (at_ != text_.size()) fail(rest(), "the end of the header");
    if (!has_descr || !has_order || !has_shape)
      fail("a key missing", "descr, fortran_order and shape");
    return header;
  }

 private:
  void skip_blanks() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  bool accept(char c) {
    skip_blanks();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  void expect(char c) {
    if (!accept(c)) fail(rest(), std::string(1, c));
  }
  std::string quoted() {
    skip_blanks();
    const char mark = at_ < text_.size() ? text_[at_] : ' ';
    if (mark != '\'' && mark != '"') fail(rest(), "a word in quotes");
    const auto end = text_.find(mark, at_ + 1);
    if (end == text_.npos) fail(rest(), "a word in quotes");
    std::string word(text_.substr(at_ + 1, end - at_ - 1));
    at_ = end + 1;
    return word;
  }
  NpyNumber number() {
    skip_blanks();
    const auto kinds = fmt::format("one of {}", fmt::join(names_of<NpyNumber>, ", "));
    if (at_ < text_.size() && text_[at_] == '[') fail("an array of records", kinds);
    const std::string word = quoted();
    const auto found = find_value<NpyNumber>(word);
    if (!found) fail(word, kinds);
    return *found;
  }
  bool truth() {
    skip_blanks();
    for (const bool value : {false, true}) {
      const std::string_view word = value ? "True" : "False";
      if (text_.substr(at_).starts_with(word)) {
        at_ += word.size();
        return value;
      }
    }
    fail(rest(), "True or False");
  }
  std::vector<std::size_t> shape() {
    std::vector<std::size_t> sizes;
    expect('(');
    while (!accept(')')) {
      skip_blanks();
      const std::size_t first = at_;
      while (at_ < text_.size() && std::isdigit(static_cast<unsigned char>(text_[at_]))) ++at_;
      const auto size = number_from<std::size_t>(text_.substr(first, at_ - first));
      if (!size) fail(rest(), "the length of an axis");
      sizes.push_back(*size);
      if (sizes.size() > 32) fail("more than 32 axes", "two or three");
      if (!accept(',')) {
        expect(')');
        break;
      }
    }
    return sizes;
  }
  std::string rest() const {
    return at_ < text_.size() ? std::string(text_.substr(at_, 40)) : "the end of the header";
  }
  [[noreturn]] void fail(const std::string& found, const std::string& expected) const {
    throw bad_input(path_, fmt::format("byte {}", begins_ + at_), found, expected);
  }

  const std::string& path_;
  std::string_view text_;
  std::uint64_t begins_;
  std::size_t at_ = 0;
};

std::string words(const std::vector<std::size_t>& shape) {
  return fmt::format("({}{})", fmt::join(shape, ", "), shape.size() == 1 ? "," : "");
}

/// Number of an array's bytes; no value where that is more than a file can have.
std::optional<std::uint64_t> bytes_of(const NpyHeader& header) {
  std::uint64_t bytes = size_of(header.number);
  for (const std::size_t n : header.shape)
    if (__builtin_mul_overflow(bytes, n, &bytes)) return std::nullopt;
  return bytes;
}

float widened(half h) {
  return h;
}
template <class N>
float widened(N n) {
  return static_cast<float>(n);
}

class NpyFile : public ImageFile {
 public:
  explicit NpyFile(const std::string& path) : ImageFile(path), in_(path) {
    header_ = read_npy_header(in_);
    const auto& shape = header_.shape;
    if (shape.size() != 2 && shape.size() != 3)
      throw bad_input(path, "shape", words(shape), "(height, width) or (height, width, channels)");
    height_ = shape[0];
    width_ = shape[1];
    const std::size_t channels = shape.size() == 3 ? shape[2] : 1;
    constexpr std::size_t most = 1024;
    for (const std::size_t n : {width_, height_})
      if (n == 0 || n > longest_side)
        throw bad_input(path, "shape", words(shape), fmt::format("1 to {} pixels", longest_side));
    if (channels == 0 || channels > most)
      throw bad_input(path, "shape", words(shape), fmt::format("1 to {} channels", most));
    if (channels == 1)
      channels_ = {"Y"};
    else if (channels == 3)
      channels_ = {"R", "G", "B"};
    else
      for (std::size_t c = 1; c <= channels; ++c) channels_.push_back(std::to_string(c));
    held_ = size_of(header_.number) * (header_.fortran_order ? height_ : width_ * channels);
  }

  void read(const Rectangle& part,
            std::span<const std::size_t> channels,
            std::span<float* const> to) override {
    switch (header_.number) {
      case NpyNumber::f2:
        return read_as<half>(part, channels, to);
      case NpyNumber::f4:
        return read_as<float>(part, channels, to);
      case NpyNumber::f8:
        return read_as<double>(part, channels, to);
      case NpyNumber::u1:
        return read_as<std::uint8_t>(part, channels, to);
      case NpyNumber::u2:
        return read_as<std::uint16_t>(part, channels, to);
      case NpyNumber::u4:
        return read_as<std::uint32_t>(part, channels, to);
    }
  }

 private:
  template <class N>
  void read_as(const Rectangle& part,
               std::span<const std::size_t> channels,
               std::span<float* const> to) {
    const std::size_t all = channels_.size();
    const auto read_numbers = [&](std::size_t first, std::size_t count) {
      bytes_.resize(count * sizeof(N));
      in_.read_at(header_.begins + first * sizeof(N), bytes_.data(), bytes_.size());
    };
    const auto value = [&](std::size_t i) {
      N n;
      std::memcpy(&n, bytes_.data() + i * sizeof(N), sizeof n);
      return widened(n);
    };
    if (header_.fortran_order) {
      for (std::size_t k = 0; k < channels.size(); ++k)
        for (std::size_t x = 0; x < part.width; ++x) {
          read_numbers(part.y + height_ * (part.x + x + width_ * channels[k]), part.height);
          for (std::size_t y = 0; y < part.height; ++y) to[k][y * part.width + x] = value(y);
        }
      return;
    }
    for (std::size_t y = 0; y < part.height; ++y) {
      read_numbers(((part.y + y) * width_ + part.x) * all, part.width * all);
      for (std::size_t k = 0; k < channels.size(); ++k)
        for (std::size_t x = 0; x < part.width; ++x)
          to[k][y * part.width + x] = value(x * all + channels[k]);
    }
  }

  InputFile in_;
  NpyHeader header_;
  std::vector<char> bytes_;
};

}  // namespace

std::size_t size_of(NpyNumber number) {
  static constexpr std::array<std::size_t, 6> sizes{2, 4, 8, 1, 2, 4};
  return sizes[static_cast<std::size_t>(number)];
}

bool is_npy(std::string_view first) {
  return first.starts_with(kMagic);
}

NpyHeader read_npy_header(InputFile& in) {
  std::array<unsigned char, 8> first{};
  in.read(first.data(), first.size());
  if (std::memcmp(first.data(), kMagic.data(), kMagic.size()) != 0)
    throw bad_input(in.path(), "byte 0", "other bytes", "an array of NumPy's (.npy)");
  const int version = first[6];
  if (version < 1 || version > 3 || first[7] != 0)
    throw bad_input(in.path(), "byte 6", fmt::format("version {}.{}", version, first[7]),
                    "version 1.0, 2.0 or 3.0");
  std::array<unsigned char, 4> length_bytes{};
  in.read(length_bytes.data(), version == 1 ? 2 : 4);
  std::size_t length = 0;
  for (std::size_t k = 4; k-- > 0;) length = length << 8U | length_bytes[k];
  constexpr std::size_t most = std::size_t{1} << 16;
  if (length > most)
    throw bad_input(in.path(), "byte 8", fmt::format("a header of {} bytes", length),
                    fmt::format("at most {}", most));
  const std::uint64_t begins = in.position();
  std::string text(length, '\0');
  in.read(text.data(), text.size());
  NpyHeader header = Dictionary(in.path(), text, begins).read();
  header.begins = in.position();
  const auto bytes = bytes_of(header);
  const std::uint64_t there = in.size() - header.begins;
  if (bytes != there)
    throw bad_input(in.path(), "shape", fmt::format("{} and {} bytes", words(header.shape), there),
                    bytes ? fmt::format("{} bytes", *bytes) : "a shape that a file can have");
  return header;
}

std::string npy_header(const std::vector<std::size_t>& shape) {
  std::string text =
      fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': {}, }}", words(shape));
  constexpr std::size_t before = 10, alignment = 64;
  text.append(alignment - (before + text.size() + 1) % alignment, ' ');
  text += '\n';
  std::string bytes(kMagic);
  bytes +=
      {'\1', '\0', static_cast<char>(text.size() & 0xffU), static_cast<char>(text.size() >> 8U)};
  return bytes + text;
}

std::unique_ptr<ImageFile> open_npy(const std::string& path) {
  return std::make_unique<NpyFile>(path);
}

}  // namespace gonio
