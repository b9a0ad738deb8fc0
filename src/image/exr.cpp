#include "image/exr.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <set>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/file.h"
#include "image/exr_parts.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <half.h>

namespace gonio {

Image without_planes(const Imf::Header& header) {
  const auto& box = header.dataWindow();
  const auto length = [](std::int64_t first, std::int64_t last) {
    return static_cast<std::size_t>(last - first + 1);
  };
  Image image;
  image.width = length(box.min.x, box.max.x);
  image.height = length(box.min.y, box.max.y);
  for (auto a = header.begin(); a != header.end(); ++a)
    if (const auto* s = dynamic_cast<const Imf::StringAttribute*>(&a.attribute()))
      image.attributes[a.name()] = s->value();
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c)
    image.channels.emplace_back(c.name());
  return image;
}

namespace {

/// Bytes of an attribute of a type that has always as many.
constexpr std::array<std::pair<std::string_view, std::size_t>, 24> attribute_sizes{
    {{"box2i", 16},      {"box2f", 16},   {"chromaticities", 32},
     {"compression", 1}, {"double", 8},   {"envmap", 1},
     {"float", 4},       {"int", 4},      {"keycode", 28},
     {"m33d", 72},       {"m33f", 36},    {"m44d", 128},
     {"lineOrder", 1},   {"m44f", 64},    {"rational", 8},
     {"tiledesc", 9},    {"timecode", 8}, {"v2d", 16},
     {"v2f", 8},         {"v2i", 8},      {"v3d", 24},
     {"v3f", 12},        {"v3i", 12},     {"deepImageState", 1}}};

std::uint32_t number_at(std::string_view bytes, std::size_t at) {
  std::uint32_t n = 0;
  if (at + sizeof n <= bytes.size()) std::memcpy(&n, bytes.data() + at, sizeof n);
  return n;
}

/// True where a value of that type fills as many bytes as it has: OpenEXR reads on where it claims more, and takes what comes
/// there for what it is not.
bool fills(std::string_view type, std::string_view value) {
  if (const auto fixed =
          std::ranges::find(attribute_sizes, type, &decltype(attribute_sizes)::value_type::first);
      fixed != attribute_sizes.end())
    return value.size() == fixed->second;
  if (type == "preview")
    return value.size() == 8 + std::uint64_t{4} * number_at(value, 0) * number_at(value, 4);
  if (type == "stringvector") {
    std::size_t at = 0;
    while (at + 4 <= value.size()) at += 4 + std::size_t{number_at(value, at)};
    return at == value.size();
  }
  if (type != "chlist") return true;
  std::size_t at = 0;
  while (at < value.size() && value[at] != '\0')
    at = std::min(value.find('\0', at), value.size()) + 1 + 16;
  return at + 1 == value.size();
}

}  // namespace

std::size_t packed_rows(Imf::Compression c) {
  switch (c) {
    case Imf::ZIP_COMPRESSION:
    case Imf::PXR24_COMPRESSION:
      return 16;
    case Imf::PIZ_COMPRESSION:
    case Imf::B44_COMPRESSION:
    case Imf::B44A_COMPRESSION:
    case Imf::DWAA_COMPRESSION:
      return 32;
    case Imf::DWAB_COMPRESSION:
      return 256;
    default:
      return 1;
  }
}

std::size_t expect_sound_exr(const std::string& path) {
  InputFile in(path);  // says plainly what is no file at all
  const auto refuse = [&](const std::string& name, const std::string& found,
                          const std::string& expected) {
    return bad_input(in.path(), "attribute " + name, found, expected);
  };
  const auto text = [&] {
    std::string s;
    for (char c = 0; in.read(&c, 1), c != '\0';) {
      if (s.size() == 255) throw refuse(s, "a longer name", "at most 255 bytes");
      s += c;
    }
    return s;
  };
  std::array<std::uint32_t, 2> magic_and_version{};
  in.read(magic_and_version.data(), sizeof magic_and_version);
  if (magic_and_version[1] & 0x1000U)
    throw bad_input(in.path(), "byte 4", "an image of several parts", "one part");
  std::array<std::uint64_t, 2> image{}, tile{};
  std::size_t channels = 0, rows = packed_rows(Imf::ZIP_COMPRESSION);  // where it says nothing
  constexpr std::size_t most_attributes = 1000, most_header = std::size_t{1} << 22;
  std::set<std::string> seen;
  for (std::string name = text(); !name.empty(); name = text()) {
    if (!seen.insert(name).second) throw refuse(name, "a second one", "one of each name");
    if (seen.size() > most_attributes)
      throw bad_input(in.path(), "header", fmt::format("more than {} attributes", most_attributes),
                      "fewer");
    const std::string type = text();
    std::int32_t size = 0;
    in.read(&size, sizeof size);
    if (size < 0 || static_cast<std::uint64_t>(size) > in.size() - in.position())
      throw refuse(name, fmt::format("{} bytes", size), "as many as the file has");
    if (static_cast<std::uint64_t>(size) + in.position() > most_header)
      throw refuse(name, fmt::format("{} bytes", size),
                   fmt::format("a header of at most {} bytes", most_header));
    std::string value(static_cast<std::size_t>(size), '\0');
    in.read(value.data(), value.size());
    if (!fills(type, value))
      throw refuse(name, fmt::format("{} of {} bytes", type, size), "a value of its size");
    // OpenEXR goes by the name: others of these types are for whoever wrote them.
    if (name == "channels" && type == "chlist") {
      constexpr std::size_t behind_its_name = 17;
      channels = 0;
      for (std::size_t at = 0; at < value.size() && value[at] != '\0'; ++channels)
        at = value.find('\0', at) + behind_its_name;
      constexpr std::size_t most_channels = 4096;
      if (channels > most_channels)
        throw refuse(name, fmt::format("{} channels", channels),
                     fmt::format("at most {}", most_channels));
    }
    if (name == "compression" && type == "compression")
      rows = packed_rows(static_cast<Imf::Compression>(value[0]));
    for (std::size_t k = 0; k < 2; ++k) {
      if (name == "dataWindow")
        image[k] = std::uint64_t{number_at(value, 8 + 4 * k) - number_at(value, 4 * k)} + 1;
      if (name == "tiles" && type == "tiledesc") tile[k] = std::max(number_at(value, 4 * k), 1U);
    }
  }
  const std::size_t header = in.position();
  // On opening, it allocates for each tile's place in the file, and for the lines that are packed
  // as one.
  const std::uint64_t tiles =
      tile[0] > 0 ? ((image[0] - 1) / tile[0] + 1) * ((image[1] - 1) / tile[1] + 1) : 0;
  if (tiles > in.left(in.size()) / sizeof(std::uint64_t))
    throw bad_input(in.path(), "tiles", fmt::format("{} of them", tiles), "places for all of them");
  constexpr std::uint64_t most = std::uint64_t{1} << 27;
  const auto expect_few = [&](std::uint64_t width, std::uint64_t height) {
    const auto bytes = std::min<std::uint64_t>(width, longest_side) * channels * sizeof(float) *
                       std::min<std::uint64_t>(height, longest_side);
    if (bytes > most)
      throw bad_input(in.path(), "header", fmt::format("{} bytes packed as one", bytes),
                      fmt::format("at most {}", most));
  };
  // An image has tiles if its version says so, too.
  const bool has_tiles = (magic_and_version[1] & 0x200U) != 0 && tile[0] > 0;
  if (!has_tiles) expect_few(image[0], std::min<std::uint64_t>(image[1], rows));
  if (tile[0] > 0) expect_few(tile[0], tile[1]);
  if (tile[1] > image[1]) expect_few(image[0], tile[1]);  // read as lines, it keeps a row of tiles
  // For rows and columns, too, it allocates on opening.
  [[maybe_unused]] static const bool limited = [] {  // once: every thread that reads shares them
    constexpr auto longest = static_cast<int>(longest_side);
    Imf::Header::setMaxImageSize(longest, longest);
    Imf::Header::setMaxTileSize(longest, longest);
    return true;
  }();
  // As OpenEXR keeps them: each header a few times, each text and each name in room of its own, and
  // the place of each tile.
  constexpr std::size_t of_an_attribute = 1024, of_a_channel = 1024, copies = 16;
  return of_an_attribute * seen.size() + of_a_channel * channels + copies * header + copies * tiles;
}

std::vector<half> in_half(const std::string& path, std::span<const float> values) {
  std::vector<half> halves(values.begin(), values.end());
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::isfinite(values[i]) && !halves[i].isFinite())
      throw bad_input(path, "writing", fmt::format("{}", values[i]), "at most 65504 in half");
  return halves;
}

namespace {

/// read(file) of a sound one.
template <class Read>
Image reading(const std::string& path, Read read) {
  expect_sound_exr(path);
  return with_exr_errors(path, "OpenEXR", "a readable image", [&] {
    Imf::InputFile file(path.c_str(), 1);
    return read(file);
  });
}

/// A file in memory.  OpenEXR writes the end of a file where errors are lost, on closing: a full
/// disk would leave half a file and say nothing.
class Memory : public Imf::OStream {
 public:
  Memory() : OStream("memory") {}
  const std::string& bytes() const { return bytes_; }

  void write(const char* from, int n) override {
    const auto count = static_cast<std::size_t>(n);
    bytes_.resize(std::max(bytes_.size(), at_ + count));
    bytes_.replace(at_, count, from, count);
    at_ += count;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t to) override { at_ = to; }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

}  // namespace

std::string exr_bytes(const std::string& name, const Image& image, Storage storage) {
  Memory memory;
  with_exr_errors(name, "writing", "an image that OpenEXR can hold", [&] {
    Imf::Header header(static_cast<int>(image.width), static_cast<int>(image.height));
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const auto& [key, text] : image.attributes) header.insert(key, Imf::StringAttribute(text));
    Imf::FrameBuffer buffer;
    const auto insert = [&](std::size_t c, Imf::PixelType type, const auto& plane) {
      header.channels().insert(image.channels[c], Imf::Channel(type));
      // Imf::Slice takes a pointer to mutable bytes also for writing.
      char* base = static_cast<char*>(const_cast<void*>(static_cast<const void*>(plane.data())));
      buffer.insert(image.channels[c],
                    Imf::Slice(type, base, sizeof(plane[0]), sizeof(plane[0]) * image.width));
    };
    std::vector<std::vector<half>> halves(image.channels.size());
    for (std::size_t c = 0; c < image.channels.size(); ++c) {
      if (storage == Storage::single) {
        insert(c, Imf::FLOAT, image.planes[c]);
      } else {
        halves[c] = in_half(name, image.planes[c]);
        insert(c, Imf::HALF, halves[c]);
      }
    }
    Imf::OutputFile file(memory, header);
    file.setFrameBuffer(buffer);
    file.writePixels(static_cast<int>(image.height));
  });
  return memory.bytes();
}

void write_exr(const std::string& path, const Image& image, Storage storage) {
  OutputFile out(path);
  out.write(exr_bytes(path, image, storage));
  out.commit();
}

Image read_exr(const std::string& path, std::size_t most, const std::vector<std::string>& only) {
  return reading(path, [&](Imf::InputFile& file) {
    Image image = without_planes(file.header());
    if (!only.empty()) {
      const std::set<std::string> there(image.channels.begin(), image.channels.end());
      for (const auto& name : only)
        if (!there.contains(name))
          throw bad_input(path, "channels", fmt::format("{}", fmt::join(image.channels, ", ")),
                          name + " among them");
      image.channels = only;
    }
    const std::size_t pixels = image.width * image.height;  // of two ints: fits
    if (pixels > most / std::max<std::size_t>(image.channels.size(), 1))
      throw bad_input(path, "header",
                      fmt::format("{} × {} pixels × {} channels", image.width, image.height,
                                  image.channels.size()),
                      fmt::format("at most {} values", most));
    const auto box = file.header().dataWindow();
    const auto stride = sizeof(float) * image.width;
    Imf::FrameBuffer buffer;
    image.planes.assign(image.channels.size(), std::vector<float>(pixels));
    for (std::size_t c = 0; c < image.channels.size(); ++c) {
      // The slice's base is the address of pixel (0, 0), which the data window may leave out.
      const auto shift =
          static_cast<std::ptrdiff_t>(box.min.y) * static_cast<std::ptrdiff_t>(stride) +
          static_cast<std::ptrdiff_t>(box.min.x) * static_cast<std::ptrdiff_t>(sizeof(float));
      char* base = reinterpret_cast<char*>(image.planes[c].data()) - shift;
      buffer.insert(image.channels[c], Imf::Slice(Imf::FLOAT, base, sizeof(float), stride));
    }
    file.setFrameBuffer(buffer);
    file.readPixels(box.min.y, box.max.y);
    return image;
  });
}

Image read_exr_header(const std::string& path) {
  return reading(path, [](Imf::InputFile& file) { return without_planes(file.header()); });
}

std::string attribute_of(const Image& image,
                         const std::string& name,
                         const std::string& path,
                         const char* expected) {
  const auto found = image.attributes.find(name);
  if (found == image.attributes.end())
    throw bad_input(path, "header", "no attribute " + name, expected);
  return found->second;
}

}  // namespace gonio
