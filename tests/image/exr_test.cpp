#include "image/exr.h"

#include <cstdint>
#include <optional>
#include <random>

#include "base/error.h"
#include "refusal.h"
#include "support.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>

namespace gonio {
namespace {

using test::Folder;

Image example() {
  Image i;
  i.width = 7;
  i.height = 3;
  i.channels = {"B", "G", "R"};  // OpenEXR keeps them in this order
  for (int c = 0; c < 3; ++c) {
    auto& plane = i.planes.emplace_back();
    for (int k = 0; k < 21; ++k)
      plane.push_back(static_cast<float>(c) + 0.1F * static_cast<float>(k));
  }
  i.attributes = {{"gonio:a", "text with\nlines"}, {"gonio:b", ""}};
  return i;
}

TEST(Exr, ReadsBackWhatItWrote) {
  const Folder folder;
  write_exr(folder / "i.exr", example());
  const Image back = read_exr(folder / "i.exr");
  EXPECT_EQ(back.width, 7U);
  EXPECT_EQ(back.height, 3U);
  EXPECT_EQ(back.channels, example().channels);
  EXPECT_EQ(back.planes, example().planes);
  for (const auto& [name, text] : example().attributes) EXPECT_EQ(back.attributes.at(name), text);
}

TEST(Exr, HalvesAreTheNearestAndReadBackWidened) {
  const Folder folder;
  Image i = example();
  i.planes[0][0] = 1 + 0x1p-11F;      // a tie: to even
  i.planes[0][1] = 1 + 3 * 0x1p-11F;  // a tie: to even, upwards
  i.planes[0][2] = 0x1.8p-24F;        // below the smallest, 2^-24
  i.planes[0][3] = 65504;             // the largest
  write_exr(folder / "i.exr", i, Storage::half);
  const Image back = read_exr(folder / "i.exr");
  EXPECT_EQ(back.planes[0][0], 1);
  EXPECT_EQ(back.planes[0][1], 1 + 0x1p-9F);
  EXPECT_EQ(back.planes[0][2], 0x1p-23F);
  EXPECT_EQ(back.planes[0][3], 65504);
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t k = 0; k < 21; ++k)
      EXPECT_NEAR(back.planes[c][k], i.planes[c][k], 0x1p-11F * i.planes[c][k] + 0x1p-25F);
}

TEST(Exr, RefusesWhatHalfCannotHold) {
  const Folder folder;
  Image i = example();
  i.planes[1][4] = 65520;
  EXPECT_THROW(write_exr(folder / "i.exr", i, Storage::half), Error);
  EXPECT_EQ(folder.entries(), 0U);
  write_exr(folder / "i.exr", i);
  EXPECT_EQ(read_exr(folder / "i.exr").planes[1][4], 65520);
}

TEST(Exr, ReadsTheChannelsAskedForInTheirOrder) {
  const Folder folder;
  write_exr(folder / "i.exr", example());
  const Image back = read_exr(folder / "i.exr", 42, {"R", "B"});
  EXPECT_EQ(back.channels, (std::vector<std::string>{"R", "B"}));
  EXPECT_EQ(back.planes, (std::vector{example().planes[2], example().planes[0]}));
  EXPECT_THROW(read_exr(folder / "i.exr", 42, {"R", "Z"}), Error);
  const Image header = read_exr_header(folder / "i.exr");
  EXPECT_EQ(header.channels, example().channels);
  EXPECT_EQ(header.attributes.at("gonio:a"), "text with\nlines");
  EXPECT_EQ(header.width * header.height, 21U);
  EXPECT_TRUE(header.planes.empty());
}

TEST(Exr, RefusesMoreValuesThanItMayAllocate) {
  const Folder folder;
  write_exr(folder / "i.exr", example());
  EXPECT_EQ(read_exr(folder / "i.exr", 63).planes.size(), 3U);
  EXPECT_THROW(read_exr(folder / "i.exr", 62), Error);
}

/// A file of a few kilobytes: OpenEXR's table of line offsets, and no pixels.
void write_header_of_many(const std::string& path) {
  Imf::Header header(8192, 8192);
  header.compression() = Imf::DWAB_COMPRESSION;
  for (int c = 0; c < 16; ++c)
    header.channels().insert(std::to_string(c), Imf::Channel(Imf::FLOAT));
  const Imf::OutputFile file(path.c_str(), header);
}

TEST(Exr, RefusesASmallFileThatClaimsManyChannels) {
  const Folder folder;
  write_header_of_many(folder / "i.exr");
  EXPECT_LT(std::filesystem::file_size(folder / "i.exr"), 10'000U);
  EXPECT_EQ(read_exr_header(folder / "i.exr").channels.size(), 16U);
  EXPECT_HAS(test::refusal([&] { read_exr(folder / "i.exr"); }),
             "8192 × 8192 pixels × 16 channels");
}

TEST(Exr, RefusesAnAttributeLongerThanTheFile) {
  const Folder folder;
  Image image;
  image.width = image.height = 1;
  image.channels = {"Y"};
  image.planes = {{0.5F}};
  image.attributes["note"] = "four";
  write_exr(folder / "a.exr", image);
  std::string bytes = test::read_bytes(folder / "a.exr");
  const auto at = bytes.find("four");
  ASSERT_NE(at, bytes.npos);
  bytes.replace(at - 4, 4, "\xff\xff\xff\x7f");
  EXPECT_HAS(test::refusal([&] { read_exr(folder.write("b.exr", bytes)); }),
             "attribute note: found 2147483647 bytes");
}

TEST(Exr, SaysWhereItCannotWriteAndLeavesNothing) {
  const Folder folder;
  EXPECT_THROW(write_exr(folder / "none/such", example()), Error);
  EXPECT_THROW(write_exr(folder / "", example()), Error);
  Image wrong = example();
  wrong.width = 0;
  EXPECT_THROW(write_exr(folder / "i.exr", wrong), Error);
  EXPECT_EQ(folder.entries(), 0U);
}

TEST(Exr, EitherReadsOrRefusesDamagedFiles) {
  const Folder folder;
  write_exr(folder / "i.exr", example());
  const std::string original = test::read_bytes(folder / "i.exr");
  std::mt19937 random(5);
  for (int round = 0; round < 300; ++round) {
    std::string bytes = original;
    for (auto flips = random() % 5; flips > 0; --flips)
      bytes[random() % bytes.size()] = static_cast<char>(random());
    if (round % 3 == 0) bytes.resize(random() % bytes.size());
    test::refusal([&] { read_exr(folder.write("damaged.exr", bytes)); });
  }
}

TEST(Exr, ReadsEnvironmentMapsMadeElsewhere) {
  GONIO_NEEDS_SHARED(folder, "data/env");
  std::size_t maps = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".exr") continue;
    const Image i = read_exr(entry.path().string());
    EXPECT_EQ(i.width, 2 * i.height) << entry.path();
    EXPECT_GE(i.channels.size(), 3U);
    ++maps;
  }
  EXPECT_GT(maps, 0U);
}

/// Header of an image of one pixel with other attributes, which have the size that is given where there is one.
class ExrHeader {
 public:
  ExrHeader& add(const std::string& name,
                 const std::string& type,
                 const std::string& value,
                 std::optional<std::int32_t> size = {}) {
    const auto n = size.value_or(static_cast<std::int32_t>(value.size()));
    bytes_ += name + '\0' + type + '\0' + words({n}) + value;
    return *this;
  }
  static std::string words(const std::vector<std::int32_t>& all) {
    return {reinterpret_cast<const char*>(all.data()), 4 * all.size()};
  }
  ExrHeader& add_rest(std::int32_t columns = 1, std::int32_t lines = 1) {
    const std::string box = words({0, 0, columns - 1, lines - 1}), zero(1, '\0');
    return add("compression", "compression", zero)
        .add("dataWindow", "box2i", box)
        .add("displayWindow", "box2i", box)
        .add("lineOrder", "lineOrder", zero)
        .add("pixelAspectRatio", "float", std::string("\0\0\x80\x3f", 4))
        .add("screenWindowCenter", "v2f", std::string(8, '\0'))
        .add("screenWindowWidth", "float", std::string("\0\0\x80\x3f", 4));
  }
  std::string text() const { return bytes_ + std::string(65, '\0'); }

 private:
  std::string bytes_{"\x76\x2f\x31\x01\2\0\0\0", 8};
};
const std::string one_channel = std::string("Y\0", 2) + ExrHeader::words({2, 0, 1, 1}) + '\0';

TEST(Exr, RefusesAttributesThatDoNotFillTheirSize) {
  const Folder folder;
  const std::string hidden = std::string("x\0string\0\xff\xff\xff\x7f", 13);
  const auto line = [&](const ExrHeader& h) {
    return test::refusal([&] { read_exr_header(folder.write("h.exr", h.text())); });
  };
  EXPECT_EQ(line(ExrHeader().add("channels", "chlist", one_channel).add_rest()), "");
  // OpenEXR goes on behind the channels' end, which comes before that of the attribute.
  EXPECT_HAS(line(ExrHeader().add("channels", "chlist", '\0' + hidden + "yyyy").add_rest()),
             "attribute channels: found chlist of 18 bytes");
  const auto with = [&](const char* type, const std::string& value) {
    return line(
        ExrHeader().add("channels", "chlist", one_channel).add("a", type, value).add_rest());
  };
  EXPECT_HAS(with("box2i", hidden), "attribute a: found box2i of 13 bytes");
  EXPECT_HAS(with("int", "12345"), "int of 5 bytes");
  EXPECT_HAS(with("preview", ExrHeader::words({30'000, 17'000})), "preview of 8 bytes");
  EXPECT_HAS(with("stringvector", ExrHeader::words({0x7fffffff})), "stringvector of 4 bytes");
  EXPECT_EQ(with("stringvector", ExrHeader::words({2}) + "ab"), "");
  EXPECT_HAS(with(std::string(256, 't').c_str(), ""), "a longer name");
}

TEST(Exr, RefusesMoreTilesThanAFileHasPlacesFor) {
  const Folder folder;
  const ExrHeader h = ExrHeader()
                          .add("channels", "chlist", one_channel)
                          .add("tiles", "tiledesc", ExrHeader::words({1, 1}) + '\0')
                          .add_rest(16'384, 16'384);
  std::string text = h.text();
  text[5] = 2;  // tiled
  EXPECT_HAS(test::refusal([&] { read_exr_header(folder.write("t.exr", text)); }),
             "tiles: found 268435456 of them");
}

TEST(Exr, RefusesChannelsOfWhichTheLinesPackedAsOneFillTheMemory) {
  const Folder folder;
  std::string channels;
  for (int c = 0; c < 40'000; ++c)
    channels += std::to_string(c) + '\0' + ExrHeader::words({2, 0, 1, 1});
  const ExrHeader h = ExrHeader().add("channels", "chlist", channels + '\0').add_rest(16'384, 1);
  EXPECT_HAS(test::refusal([&] { read_exr_header(folder.write("c.exr", h.text())); }),
             "attribute channels: found 40000 channels");
  // What OpenEXR does not go by changes nothing.
  channels.clear();
  for (int c = 0; c < 2000; ++c)
    channels += std::to_string(c) + '\0' + ExrHeader::words({2, 0, 1, 1});
  const std::string zip = std::string("compression\0compression\0", 24) + ExrHeader::words({1});
  for (const auto& [type, value] : {std::pair("tiledesc", ExrHeader::words({16, 16}) + '\0'),
                                    std::pair("compression", std::string(1, '\0'))}) {
    std::string text = ExrHeader()
                           .add("channels", "chlist", channels + '\0')
                           .add_rest(16'384, 16)
                           .add("zz", type, value)
                           .text();
    text[text.find(zip) + zip.size()] = 3;
    EXPECT_HAS(test::refusal([&] { read_exr_header(folder.write("z.exr", text)); }),
               "bytes packed as one")
        << type;
  }
}

TEST(Exr, RefusesLinesPackedAsOneOfMoreThan128Megabytes) {
  const Folder folder;
  const auto refused = [&](int count) {
    std::string channels;
    for (int c = 0; c < count; ++c)
      channels += std::to_string(c) + '\0' + ExrHeader::words({2, 0, 1, 1});
    std::string text =
        ExrHeader().add("channels", "chlist", channels + '\0').add_rest(16'384, 16).text();
    const std::string zip = std::string("compression\0compression\0", 24) + ExrHeader::words({1});
    text[text.find(zip) + zip.size()] = 3;
    return test::refusal([&] { read_exr_header(folder.write("z.exr", text)); });
  };
  EXPECT_EQ(refused(128).find("packed as one"), std::string::npos);
  EXPECT_HAS(refused(129), "found 135266304 bytes packed as one, expected at most 134217728");
}

TEST(Exr, RefusesTilesWhoseChannelsFillTheMemory) {
  const Folder folder;
  std::string channels;
  for (int c = 0; c < 100; ++c)
    channels += std::to_string(c) + '\0' + ExrHeader::words({2, 0, 1, 1});
  const auto refused = [&](int tile_width, int tile_height) {
    std::string text =
        ExrHeader()
            .add("channels", "chlist", channels + '\0')
            .add("tiles", "tiledesc", ExrHeader::words({tile_width, tile_height}) + '\0')
            .add_rest(16'384, 1)
            .text();
    text[5] = 2;  // tiled
    text.append(std::size_t{8} * 16'384, '\0');
    return test::refusal([&] { read_exr_header(folder.write("t.exr", text)); });
  };
  EXPECT_HAS(refused(2048, 2048), "bytes packed as one");
  EXPECT_HAS(refused(1, 2048), "bytes packed as one") << "of lines a row of tiles is kept";
}

TEST(Exr, RefusesASecondAttributeOfAName) {
  const Folder folder;
  const ExrHeader h = ExrHeader()
                          .add("compression", "compression", "\3")
                          .add("compression", "compression", std::string(1, '\0'))
                          .add_rest(16, 1);
  EXPECT_HAS(test::refusal([&] { read_exr_header(folder.write("c.exr", h.text())); }),
             "attribute compression: found a second one");
}

TEST(Exr, RefusesHeadersThatFillTheMemory) {
  const Folder folder;
  const auto line = [&](const ExrHeader& h) {
    return test::refusal([&] { read_exr_header(folder.write("h.exr", h.text())); });
  };
  const auto with_attributes = [&](int n) {
    ExrHeader h = ExrHeader().add("channels", "chlist", one_channel);
    for (int k = 0; k < n; ++k) h.add("a" + std::to_string(k), "int", "1234");
    return line(h.add_rest());
  };
  EXPECT_EQ(with_attributes(900), "");
  EXPECT_HAS(with_attributes(1000), "header: found more than 1000 attributes");
  const auto with_text = [&](std::size_t n) {
    return line(ExrHeader()
                    .add("channels", "chlist", one_channel)
                    .add("t", "string", std::string(n, 't'))
                    .add_rest());
  };
  const auto with_channels = [&](int n) {
    std::string list;
    for (int k = 0; k < n; ++k) list += "c" + std::to_string(k) + '\0' + one_channel.substr(2, 16);
    return line(ExrHeader().add("channels", "chlist", list + '\0').add_rest());
  };
  EXPECT_EQ(with_channels(4000), "");
  EXPECT_HAS(with_channels(5000), "attribute channels: found 5000 channels");
  EXPECT_EQ(with_text(4'000'000), "");
  EXPECT_HAS(with_text(5'000'000),
             "attribute t: found 5000000 bytes, expected a header of at most");
}

}  // namespace
}  // namespace gonio
