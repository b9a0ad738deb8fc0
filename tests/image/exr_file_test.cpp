// OpenEXR by parts: the same numbers as of the whole, in scan lines and in tiles.
#include "image/exr_file.h"

#include <cstring>
#include <fstream>
#include <random>

#include "base/error.h"
#include "refusal.h"
#include "support.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfTileDescription.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <half.h>
#include <sys/resource.h>
#include <unistd.h>

namespace gonio {
namespace {

using test::Folder;
using test::refusal;

constexpr std::size_t width = 45, height = 70;
std::vector<std::vector<float>> planes() {
  std::vector<std::vector<float>> all(3, std::vector<float>(width * height));
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t t = 0; t < all[c].size(); ++t)
      all[c][t] = static_cast<float>(c) + 0.25F * static_cast<float>(t);
  return all;
}
const std::vector<std::string> names{"B", "G", "R"};

/// File of another program: a data window that does not begin at 0, packed, tiled or not.
std::string foreign(const Folder& f, Imf::Compression packing, int tile) {
  const Imath::Box2i window({-7, 5}, {static_cast<int>(width) - 8, static_cast<int>(height) + 4});
  Imf::Header header(window, window);
  header.compression() = packing;
  auto all = planes();
  Imf::FrameBuffer buffer;
  for (std::size_t c = 0; c < 3; ++c) {
    header.channels().insert(names[c], Imf::Channel(Imf::FLOAT));
    char* first = reinterpret_cast<char*>(all[c].data()) +
                  static_cast<std::ptrdiff_t>(sizeof(float)) * (7 - 5 * std::ptrdiff_t{width});
    buffer.insert(names[c], Imf::Slice(Imf::FLOAT, first, sizeof(float), sizeof(float) * width));
  }
  const std::string path = f / "foreign.exr";
  if (tile == 0) {
    Imf::OutputFile out(path.c_str(), header);
    out.setFrameBuffer(buffer);
    out.writePixels(static_cast<int>(height));
  } else {
    header.setTileDescription(Imf::TileDescription(static_cast<unsigned>(tile), 16));
    Imf::TiledOutputFile out(path.c_str(), header);
    out.setFrameBuffer(buffer);
    out.writeTiles(0, out.numXTiles() - 1, 0, out.numYTiles() - 1);
  }
  return path;
}

void expect_parts(const std::string& path, const std::vector<std::vector<float>>& all) {
  const auto image = open_exr(path);
  ASSERT_EQ(image->width(), width);
  ASSERT_EQ(image->height(), height);
  ASSERT_EQ(image->channels(), names);
  std::mt19937 random(3);
  for (int round = 0; round < 20; ++round) {
    Rectangle part{random() % width, random() % height, 0, 0};
    part.width = 1 + random() % (width - part.x);
    part.height = 1 + random() % (height - part.y);
    if (round == 0) part = {0, 0, width, height};
    const std::vector<std::size_t> which{2, 0};
    std::vector<std::vector<float>> got(2, std::vector<float>(part.size()));
    const std::vector<float*> to{got[0].data(), got[1].data()};
    image->read(part, which, to);
    for (std::size_t k = 0; k < 2; ++k)
      for (std::size_t t = 0; t < part.size(); ++t)
        ASSERT_EQ(got[k][t],
                  all[which[k]][(part.y + t / part.width) * width + part.x + t % part.width]);
  }
}

TEST(ExrFile, GivesAChannelAsOftenAsItIsAskedFor) {
  const Folder f;
  const auto all = planes();
  for (const int tile : {0, 16}) {
    const auto file = open_exr(foreign(f, Imf::ZIP_COMPRESSION, tile));
    for (const Rectangle& part : {Rectangle{0, 0, width, height}, Rectangle{3, 5, 7, 9}}) {
      std::vector<std::vector<float>> read(3, std::vector<float>(part.size(), -1));
      const std::vector<float*> to{read[0].data(), read[1].data(), read[2].data()};
      file->read(part, std::vector<std::size_t>{1, 2, 1}, to);
      EXPECT_EQ(read[0][0], all[1][part.y * width + part.x]);
      EXPECT_EQ(read[0], read[2]);
      EXPECT_NE(read[0], read[1]);
    }
  }
}

TEST(ExrFile, PartsAreThoseOfTheWholeInLinesAndInTiles) {
  const Folder f;
  for (const auto packing :
       {Imf::NO_COMPRESSION, Imf::ZIPS_COMPRESSION, Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION}) {
    SCOPED_TRACE(packing);
    for (const int tile : {0, 16, 32, 100}) expect_parts(foreign(f, packing, tile), planes());
  }
}

TEST(ExrFile, SaysWhichRowsAndColumnsAreStoredAsOne) {
  const Folder f;
  const auto lines = open_exr(foreign(f, Imf::PIZ_COMPRESSION, 0));
  EXPECT_EQ(lines->block_width(), width);
  EXPECT_EQ(lines->block_height(), 32U);
  const auto tiles = open_exr(foreign(f, Imf::ZIP_COMPRESSION, 24));
  EXPECT_EQ(tiles->block_width(), 24U);
  EXPECT_EQ(tiles->block_height(), 16U);
}

std::string written(const Folder& f, std::size_t rows_at_once, int threads, ExrWriter::Packing p) {
  const auto all = planes();
  OutputFile out(f / "w.exr");
  ExrWriter writer(out, width, height, {{"R"}, {"G", Storage::half}, {"B"}}, {{"gonio:a", "b"}}, p,
                   threads);
  for (std::size_t y = 0; y < height; y += rows_at_once) {
    const std::size_t rows = std::min(rows_at_once, height - y);
    const std::vector<const float*> from{all[2].data() + y * width, all[1].data() + y * width,
                                         all[0].data() + y * width};
    writer.write(rows, from);
  }
  writer.finish();
  out.commit();
  return test::read_bytes(f / "w.exr");
}

/// A part through many tiles, or through lines of few columns, costs one tile and some lines, not all that it cuts.
TEST(ExrFile, NeedsNoMemoryForAllThatAPartCutsThrough) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers take the address space for themselves";
#endif
  const Folder f;
  constexpr int side = 4096;
  for (const int tile : {0, 1024}) {
    Imf::Header header(side, side);
    header.compression() = Imf::ZIP_COMPRESSION;
    header.channels().insert("Y", Imf::Channel(Imf::HALF));
    std::vector<half> row(side);  // all rows are this one
    Imf::FrameBuffer buffer;
    buffer.insert("Y", Imf::Slice(Imf::HALF, reinterpret_cast<char*>(row.data()), sizeof(half), 0));
    const std::string path = f / "large.exr";
    if (tile == 0) {
      Imf::OutputFile out(path.c_str(), header);
      out.setFrameBuffer(buffer);
      out.writePixels(side);
    } else {
      header.setTileDescription(Imf::TileDescription(tile, tile));
      Imf::TiledOutputFile out(path.c_str(), header);
      out.setFrameBuffer(buffer);
      out.writeTiles(0, out.numXTiles() - 1, 0, out.numYTiles() - 1);
    }
    const auto image = open_exr(path);
    const Rectangle part = tile == 0 ? Rectangle{5, 0, 2, side} : Rectangle{0, 1000, side, 2};
    std::vector<float> numbers(part.size());
    const std::vector<std::size_t> which{0};
    const std::vector<float*> to{numbers.data()};
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_AS, &before), 0);
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const rlim_t room = rlim_t{12} << 20;  // of 16 MB of tiles cut through, of 64 MB of lines
    const rlimit limit{pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)) + room,
                       before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_AS, &limit), 0);
    EXPECT_NO_THROW(image->read(part, which, to)) << tile;
    ::setrlimit(RLIMIT_AS, &before);
  }
}

TEST(ExrFile, CountsItsHeaderInWhatItHolds) {
  const Folder f;
  Image image;
  image.width = image.height = 1;
  image.channels = {"Y"};
  image.planes = {{0.5F}};
  const auto held = [&] {
    f.write("a.exr", exr_bytes("a.exr", image, Storage::single));
    return open_image(f / "a.exr")->held();
  };
  const std::size_t before = held();
  image.attributes["note"] = std::string(1'000'000, 'x');
  EXPECT_GE(held(), before + 4'000'000) << "OpenEXR keeps a text four times";
}

TEST(ExrWriter, WritesTheSameBytesWhateverTheRowsAtOnceAndTheThreads) {
  const Folder f;
  const std::string whole = written(f, height, 0, ExrWriter::Packing::zip);
  const Image back = read_exr(f / "w.exr");
  EXPECT_EQ(back.attributes.at("gonio:a"), "b");
  EXPECT_EQ(back.channels, names);
  EXPECT_EQ(back.planes[0], planes()[0]);
  EXPECT_EQ(back.planes[2], planes()[2]);
  for (std::size_t t = 0; t < back.planes[1].size(); ++t)
    EXPECT_NEAR(back.planes[1][t], planes()[1][t], planes()[1][t] * 0x1p-11F);
  for (const std::size_t rows : {1, 7, 16, 64})
    for (const int threads : {0, 3})
      EXPECT_EQ(written(f, rows, threads, ExrWriter::Packing::zip), whole) << rows;
  expect_parts((written(f, 16, 0, ExrWriter::Packing::none), f / "w.exr"),
               {planes()[0], back.planes[1], planes()[2]});
}

TEST(ExrWriter, RefusesWhatHalfCannotHoldAndLeavesNothing) {
  const Folder f;
  const auto line = refusal([&] {
    OutputFile out(f / "w.exr");
    ExrWriter writer(out, 1, 1, {{"Y", Storage::half}}, {});
    const float much = 70'000;
    const std::vector<const float*> from{&much};
    writer.write(1, from);
  });
  EXPECT_HAS(line, "found 70000, expected at most 65504 in half");
  EXPECT_EQ(f.entries(), 0U);
}

TEST(ExrFile, RefusesLargeTilesAndEitherReadsOrRefusesDamagedFiles) {
  const Folder f;
  std::string bytes = test::read_bytes(foreign(f, Imf::ZIP_COMPRESSION, 16));
  const auto at = bytes.find("tiledesc");
  ASSERT_NE(at, bytes.npos);
  std::string large = bytes;
  const std::uint32_t sides[]{4096, 2048};  // after "tiledesc\0" and the length
  std::memcpy(large.data() + at + 13, sides, sizeof sides);
  EXPECT_HAS(refusal([&] { open_exr(f.write("large.exr", large)); }), "at most 4194304");

  for (const int tile : {0, 16}) {
    const std::string original = test::read_bytes(foreign(f, Imf::ZIP_COMPRESSION, tile));
    std::mt19937 random(5);
    for (int round = 0; round < 300; ++round) {
      bytes = original;
      for (auto flips = 1 + random() % 4; flips > 0; --flips)
        bytes[random() % bytes.size()] = static_cast<char>(random());
      if (round % 3 == 0) bytes.resize(random() % bytes.size());
      refusal([&] {
        const auto image = open_exr(f.write("damaged.exr", bytes));
        if (image->width() * image->height() > 1'000'000 || image->channels().empty()) return;
        std::vector<float> all(image->width() * image->height());
        const std::vector<std::size_t> which{0};
        const std::vector<float*> to{all.data()};
        image->read({0, 0, image->width(), image->height()}, which, to);
      });
    }
  }
}

}  // namespace
}  // namespace gonio
