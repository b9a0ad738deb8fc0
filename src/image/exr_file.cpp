#include "image/exr_file.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "base/error.h"
#include "image/exr_parts.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>
#include <OpenEXR/ImfTiledInputFile.h>
#include <fmt/format.h>

namespace gonio {
namespace {

class ExrFile : public ImageFile {
 public:
  explicit ExrFile(const std::string& path) : ImageFile(path) {
    held_ = expect_sound_exr(path);
    reading([&] {
      auto lines = std::make_unique<Imf::InputFile>(path.c_str(), 0);
      const Imf::Header& header = lines->header();
      const Image image = without_planes(header);
      width_ = image.width;
      height_ = image.height;
      channels_ = image.channels;
      left_ = header.dataWindow().min.x;
      top_ = header.dataWindow().min.y;
      block_width_ = width_;
      block_height_ = packed_rows(header.compression());
      if (header.hasTileDescription()) {
        block_width_ = header.tileDescription().xSize;
        block_height_ = header.tileDescription().ySize;
        constexpr std::size_t most = std::size_t{1} << 22;  // of a part, beside its own pixels
        if (block_width_ * block_height_ > most)
          throw bad_input(path, "tiles", fmt::format("{} × {} pixels", block_width_, block_height_),
                          fmt::format("at most {}", most));
        lines.reset();
        tiles_ = std::make_unique<Imf::TiledInputFile>(path.c_str(), 0);
      }
      lines_ = std::move(lines);
      // What is packed as one is there twice, packed and not.
      held_ += 2 * block_width_ * block_height_ * channels_.size() * sizeof(float);
    });
  }

  void read(const Rectangle& part,
            std::span<const std::size_t> channels,
            std::span<float* const> to) override {
    // What is stored as one is read as one.  Where a part cuts through that it is copied from
    // there, piece by piece: all of it may be far larger than the part.
    constexpr std::size_t most_at_once = std::size_t{1} << 20;  // pixels, of lines
    const std::size_t across = block_width_,
                      down = tiles_
                                 ? block_height_
                                 : std::max(most_at_once / width_ / block_height_, std::size_t{1}) *
                                       block_height_;
    const auto whole = [](std::size_t first, std::size_t n, std::size_t block, std::size_t all) {
      return first % block == 0 && (n % block == 0 || first + n == all);
    };
    if (whole(part.x, part.width, across, width_) &&
        (!tiles_ || whole(part.y, part.height, down, height_)))
      return read_whole(part, channels, to);
    const std::size_t right = part.x + part.width, bottom = part.y + part.height;
    std::vector<float> between;
    std::vector<float*> planes(channels.size());
    for (std::size_t y = part.y / down * down; y < bottom; y += down)
      for (std::size_t x = part.x / across * across; x < right; x += across) {
        Rectangle piece{x, y, std::min(across, width_ - x), std::min(down, height_ - y)};
        const std::size_t left = std::max(x, part.x), top = std::max(y, part.y),
                          columns = std::min(right, x + piece.width) - left,
                          rows = std::min(bottom, y + piece.height) - top;
        if (!tiles_) piece.y = top, piece.height = rows;
        between.resize(channels.size() * piece.size());
        for (std::size_t k = 0; k < channels.size(); ++k)
          planes[k] = between.data() + k * piece.size();
        read_whole(piece, channels, planes);
        for (std::size_t k = 0; k < channels.size(); ++k)
          for (std::size_t row = top; row < top + rows; ++row)
            std::copy_n(planes[k] + (row - piece.y) * piece.width + (left - piece.x), columns,
                        to[k] + (row - part.y) * part.width + (left - part.x));
      }
  }

 private:
  /// Reads whole tiles, or lines with all their columns.
  void read_whole(const Rectangle& part,
                  std::span<const std::size_t> channels,
                  std::span<float* const> to) {
    // OpenEXR fills a channel once, however often it is asked for.
    const auto first_of = [&](std::size_t k) {
      return static_cast<std::size_t>(std::ranges::find(channels, channels[k]) - channels.begin());
    };
    Imf::FrameBuffer buffer;
    for (std::size_t k = 0; k < channels.size(); ++k) {
      if (first_of(k) != k) continue;
      // The slice's base is the address of pixel (0, 0), which may lie elsewhere.
      const auto x = left_ + static_cast<std::ptrdiff_t>(part.x);
      const auto y = top_ + static_cast<std::ptrdiff_t>(part.y);
      const auto shift = (y * static_cast<std::ptrdiff_t>(part.width) + x) *
                         static_cast<std::ptrdiff_t>(sizeof(float));
      buffer.insert(channels_[channels[k]],
                    Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(to[k]) - shift, sizeof(float),
                               sizeof(float) * part.width));
    }
    reading([&] {
      const auto number = [](std::size_t i) { return static_cast<int>(i); };
      if (tiles_) {
        tiles_->setFrameBuffer(buffer);
        tiles_->readTiles(
            number(part.x / block_width_), number((part.x + part.width - 1) / block_width_),
            number(part.y / block_height_), number((part.y + part.height - 1) / block_height_));
      } else {
        lines_->setFrameBuffer(buffer);
        lines_->readPixels(top_ + number(part.y), top_ + number(part.y + part.height - 1));
      }
    });
    for (std::size_t k = 0; k < channels.size(); ++k)
      if (first_of(k) != k) std::copy_n(to[first_of(k)], part.size(), to[k]);
  }
  template <class Read>
  void reading(Read&& read) {
    with_exr_errors(path_, "OpenEXR", "a readable image", read);
  }

  int left_ = 0, top_ = 0;
  std::unique_ptr<Imf::InputFile> lines_;
  std::unique_ptr<Imf::TiledInputFile> tiles_;
};

/// File of OpenEXR's on one of ours.  OpenEXR writes the end of a file where errors are lost, on closing: a write that fails is
/// remembered.
class Stream : public Imf::OStream {
 public:
  explicit Stream(OutputFile& out) : OStream("output"), out_(out) {}
  void write(const char* from, int n) override {
    out_.write_at(at_, {from, static_cast<std::size_t>(n)});
    at_ += static_cast<std::uint64_t>(n);
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t to) override { at_ = to; }

 private:
  OutputFile& out_;
  std::uint64_t at_ = 0;
};

}  // namespace

class ExrWriter::Inside {
 public:
  Inside(OutputFile& out,
         std::size_t width,
         std::size_t height,
         std::vector<ExrChannel> channels,
         const std::map<std::string, std::string>& attributes,
         Packing packing,
         int threads)
      : stream_(out), out_(out), width_(width), channels_(std::move(channels)) {
    writing([&] {
      Imf::Header header(static_cast<int>(width), static_cast<int>(height));
      header.compression() = packing == Packing::zip    ? Imf::ZIP_COMPRESSION
                             : packing == Packing::runs ? Imf::RLE_COMPRESSION
                                                        : Imf::NO_COMPRESSION;
      for (const auto& [key, text] : attributes) header.insert(key, Imf::StringAttribute(text));
      for (const auto& c : channels_)
        header.channels().insert(c.name, Imf::Channel(type_of(c.storage)));
      if (threads > Imf::globalThreadCount()) Imf::setGlobalThreadCount(threads);
      file_ = std::make_unique<Imf::OutputFile>(stream_, header, threads);
    });
  }

  void write(std::size_t rows, std::span<const float* const> planes) {
    Imf::FrameBuffer buffer;
    std::vector<std::vector<half>> halves(channels_.size());
    const auto above = static_cast<std::ptrdiff_t>(written_ * width_);
    const auto insert = [&](std::size_t c, const auto* first) {
      // Imf::Slice takes a pointer to mutable bytes also for writing, and that of row 0.
      const auto* row_0 = reinterpret_cast<const char*>(first) -
                          above * static_cast<std::ptrdiff_t>(sizeof(*first));
      buffer.insert(channels_[c].name,
                    Imf::Slice(type_of(channels_[c].storage), const_cast<char*>(row_0),
                               sizeof(*first), sizeof(*first) * width_));
    };
    for (std::size_t c = 0; c < channels_.size(); ++c) {
      if (channels_[c].storage == Storage::single) {
        insert(c, planes[c]);
      } else {
        halves[c] = in_half(out_.path(), {planes[c], rows * width_});
        insert(c, halves[c].data());
      }
    }
    writing([&] {
      file_->setFrameBuffer(buffer);
      file_->writePixels(static_cast<int>(rows));
    });
    written_ += rows;
  }

  void finish() { file_.reset(); }

 private:
  static Imf::PixelType type_of(Storage s) { return s == Storage::half ? Imf::HALF : Imf::FLOAT; }
  template <class Write>
  void writing(Write&& write) {
    with_exr_errors(out_.path(), "writing", "an image that OpenEXR can hold", write);
  }

  Stream stream_;
  OutputFile& out_;
  std::size_t width_, written_ = 0;
  std::vector<ExrChannel> channels_;
  std::unique_ptr<Imf::OutputFile> file_;
};

ExrWriter::ExrWriter(OutputFile& out,
                     std::size_t width,
                     std::size_t height,
                     std::vector<ExrChannel> channels,
                     const std::map<std::string, std::string>& attributes,
                     Packing packing,
                     int threads)
    : inside_(std::make_unique<Inside>(
          out, width, height, std::move(channels), attributes, packing, threads)) {}
ExrWriter::~ExrWriter() = default;
void ExrWriter::write(std::size_t rows, std::span<const float* const> planes) {
  inside_->write(rows, planes);
}
void ExrWriter::finish() {
  inside_->finish();
}

std::unique_ptr<ImageFile> open_exr(const std::string& path) {
  return std::make_unique<ExrFile>(path);
}

}  // namespace gonio
