// Arrays of NumPy's: their numbers by parts, and headers that lie.
#include "image/npy.h"

#include <cstring>
#include <random>

#include "base/error.h"
#include "refusal.h"
#include "support.h"

#include <half.h>

namespace gonio {
namespace {

using test::Folder;
using test::refusal;

/// File with those words for a header, of a version.
std::string npy(const std::string& words, const std::string& numbers, char version = 1) {
  std::string length;
  for (int k = 0; k < (version == 1 ? 2 : 4); ++k)
    length += static_cast<char>(words.size() >> (8 * static_cast<unsigned>(k)) & 0xff);
  return std::string("\x93NUMPY") + version + '\0' + length + words + numbers;
}
std::string header(const std::string& number, const std::string& order, const std::string& shape) {
  return "{'descr': '" + number + "', 'fortran_order': " + order + ", 'shape': " + shape + ", }\n";
}

constexpr std::size_t height = 4, width = 5, channels = 3;
/// Whole numbers, which every type holds.
int value(std::size_t y, std::size_t x, std::size_t c) {
  return static_cast<int>(50 * y + 10 * x + c);
}
template <class N>
std::string numbers(bool fortran) {
  std::string bytes;
  const auto put = [&](std::size_t y, std::size_t x, std::size_t c) {
    const auto n = static_cast<N>(static_cast<float>(value(y, x, c)));
    bytes.append(reinterpret_cast<const char*>(&n), sizeof n);
  };
  if (fortran)
    for (std::size_t c = 0; c < channels; ++c)
      for (std::size_t x = 0; x < width; ++x)
        for (std::size_t y = 0; y < height; ++y) put(y, x, c);
  else
    for (std::size_t y = 0; y < height; ++y)
      for (std::size_t x = 0; x < width; ++x)
        for (std::size_t c = 0; c < channels; ++c) put(y, x, c);
  return bytes;
}

TEST(Npy, HoldsTheSameNumbersOfEveryTypeInBothOrders) {
  const Folder f;
  for (const bool fortran : {false, true}) {
    const std::string order = fortran ? "True" : "False";
    for (const auto& [type, bytes] : {std::pair("<f2", numbers<half>(fortran)),
                                      {"<f4", numbers<float>(fortran)},
                                      {"<f8", numbers<double>(fortran)},
                                      {"|u1", numbers<std::uint8_t>(fortran)},
                                      {"<u2", numbers<std::uint16_t>(fortran)},
                                      {"<u4", numbers<std::uint32_t>(fortran)}}) {
      SCOPED_TRACE(std::string(type) + " " + order);
      const auto image = open_npy(f.write("a.npy", npy(header(type, order, "(4, 5, 3)"), bytes)));
      EXPECT_EQ(image->width(), width);
      EXPECT_EQ(image->height(), height);
      EXPECT_EQ(image->channels(), (std::vector<std::string>{"R", "G", "B"}));
      const Rectangle part{1, 2, 3, 2};
      std::vector<float> blue(part.size()), red(part.size());
      const std::vector<std::size_t> which{2, 0};
      const std::vector<float*> to{blue.data(), red.data()};
      image->read(part, which, to);
      for (std::size_t y = 0; y < part.height; ++y)
        for (std::size_t x = 0; x < part.width; ++x) {
          EXPECT_EQ(static_cast<int>(blue[y * part.width + x]), value(y + 2, x + 1, 2));
          EXPECT_EQ(static_cast<int>(red[y * part.width + x]), value(y + 2, x + 1, 0));
        }
    }
  }
}

TEST(Npy, OfTwoAxesHasOneChannelInEveryVersionOfTheFormat) {
  const Folder f;
  const std::string bytes = numbers<float>(false).substr(0, 6 * sizeof(float));
  for (const char version : {'\1', '\2', '\3'}) {
    const auto image =
        open_npy(f.write("a.npy", npy(header("<f4", "False", "(2, 3)"), bytes, version)));
    EXPECT_EQ(image->channels(), std::vector<std::string>{"Y"});
    std::vector<float> all(6);
    const std::vector<std::size_t> which{0};
    const std::vector<float*> to{all.data()};
    image->read({0, 0, 3, 2}, which, to);
    EXPECT_EQ(std::memcmp(all.data(), bytes.data(), bytes.size()), 0);
  }
}

TEST(Npy, HeaderThatIsWrittenIsNumpysToTheByte) {
  // numpy.save of numpy.zeros((2, 3), 'float32') begins so.
  const std::string words = "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }";
  EXPECT_EQ(npy_header({2, 3}), std::string("\x93NUMPY\x01\0v\0", 10) + words +
                                    std::string(117 - words.size(), ' ') + "\n");
  const Folder f;
  const auto image =
      open_npy(f.write("a.npy", npy_header({2, 3, 4}) + std::string(24 * sizeof(float), '\0')));
  EXPECT_EQ(image->channels(), (std::vector<std::string>{"1", "2", "3", "4"}));
}

TEST(Npy, RefusesHeadersThatLieInOneLine) {
  const Folder f;
  const std::string six(6 * sizeof(float), '\0');
  const auto line = [&](const std::string& bytes) {
    return refusal([&] { open_npy(f.write("lie.npy", bytes)); });
  };
  const auto of_words = [&](const std::string& words) { return line(npy(words, six)); };
  EXPECT_EQ(of_words(header("<f4", "False", "(2, 3)")), "") << "the ruler: this one is read";
  EXPECT_HAS(of_words(header("<f4", "False", "(2, 4)")), "found (2, 4) and 24 bytes, expected 32");
  EXPECT_HAS(of_words(header("<f4", "False", "(2, 2)")), "expected 16 bytes");
  EXPECT_HAS(of_words(header("<f4", "False", "(4294967296, 4294967296, 4294967296)")),
             "a shape that a file can have");
  EXPECT_HAS(of_words(header("<f4", "False", "(18446744073709551616, 1)")),
             "the length of an axis");
  EXPECT_HAS(of_words(header("<f4", "False", "(-2, 3)")), "the length of an axis");
  EXPECT_HAS(of_words(header("<f4", "False", "(6,)")), "(height, width)");
  EXPECT_HAS(of_words(header("<f4", "False", "(1, 1, 1, 6)")), "(height, width)");
  EXPECT_HAS(of_words(header("<f4", "False", "(6, 0)")), "expected 0 bytes");
  EXPECT_HAS(line(npy(header("<f4", "False", "(6, 0)"), "")), "1 to 16384 pixels");
  EXPECT_HAS(line(npy(header("|u1", "False", "(1, 16385)"), std::string(16385, 'x'))),
             "1 to 16384 pixels");
  EXPECT_HAS(line(npy(header("|u1", "False", "(1, 1, 2000)"), std::string(2000, 'x'))),
             "1 to 1024 channels");
  EXPECT_HAS(of_words(header(">f4", "False", "(2, 3)")), "found >f4, expected one of <f2, <f4");
  EXPECT_HAS(of_words(header("|O", "False", "(2, 3)")), "found |O");
  EXPECT_HAS(of_words("{'descr': [('a', '<f4')], 'fortran_order': False, 'shape': (6,)}"),
             "an array of records");
  EXPECT_HAS(of_words(header("<f4", "Perhaps", "(2, 3)")), "True or False");
  EXPECT_HAS(of_words("{'descr': '<f4', 'shape': (2, 3)}"), "a key missing");
  EXPECT_HAS(of_words("{'descr': '<f4', 'descr': '<f4'}"), "the key descr");
  EXPECT_HAS(of_words("{'colour': 1}"), "the key colour");
  EXPECT_HAS(of_words("{'descr"), "a word in quotes");
  EXPECT_HAS(of_words("[]"), "expected {");
  EXPECT_HAS(of_words(""), "the end of the header");
  EXPECT_HAS(of_words(header("<f4", "False", "(2, 3)") + "x"), "the end of the header");
  std::string many = "(";
  for (int k = 0; k < 1000; ++k) many += "1,";
  EXPECT_HAS(of_words(header("<f4", "False", many + ")")), "more than 32 axes");
  EXPECT_HAS(line(npy(header("<f4", "False", "(2, 3)"), six, '\4')), "version 4.0");
  EXPECT_HAS(line(std::string("\x93NUMPY\x02\0\xff\xff\xff\x7f", 12)), "a header of 2147483647");
  EXPECT_HAS(line("\x93NUMPY"), "the end of the file");
  EXPECT_HAS(line("something else"), "other bytes");
}

TEST(Npy, SaysWhatItHolds) {
  const Folder f;
  const auto held = [&](const char* order, const char* shape) {
    const std::string head = npy(header("<f8", order, shape), ""), path = f.write("a.npy", head);
    std::filesystem::resize_file(path, head.size() + std::uintmax_t{8} * 3 * 2000 * 500);  // holes
    return open_npy(path)->held();
  };
  EXPECT_EQ(held("False", "(3, 2000, 500)"), 8U * 2000 * 500) << "a row";
  EXPECT_EQ(held("True", "(2000, 3, 500)"), 8U * 2000) << "a column";
}

TEST(Npy, EitherReadsOrRefusesDamagedFiles) {
  const Folder f;
  const std::string original = npy(header("<f2", "True", "(4, 5, 3)"), numbers<half>(true));
  std::mt19937 random(5);
  std::size_t refused = 0;
  for (int round = 0; round < 1000; ++round) {
    std::string bytes = original;
    for (auto flips = 1 + random() % 4; flips > 0; --flips)
      bytes[random() % 80] = static_cast<char>(random());
    if (round % 3 == 0) bytes.resize(random() % bytes.size());
    refused += !refusal([&] {
                  const auto image = open_npy(f.write("damaged.npy", bytes));
                  std::vector<float> all(image->width() * image->height());
                  const std::vector<std::size_t> which{0};
                  const std::vector<float*> to{all.data()};
                  image->read({0, 0, image->width(), image->height()}, which, to);
                }).empty();
  }
  EXPECT_GT(refused, 900U);
}

}  // namespace
}  // namespace gonio
