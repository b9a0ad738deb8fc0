#include "image/exr.h"

#include <random>

#include "base/error.h"
#include "support.h"

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
    try {
      read_exr(folder.write("damaged.exr", bytes));
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), Exit::bad_input);
    }
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

}  // namespace
}  // namespace gonio
