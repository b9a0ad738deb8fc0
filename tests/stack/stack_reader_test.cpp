// Samples of a stack by parts: the numbers that the images hold, and where they are refused.
#include "stack/stack_reader.h"

#include <cmath>
#include <limits>

#include "base/error.h"
#include "image/npy.h"
#include "refusal.h"
#include "stack/example.h"

#include <tbb/global_control.h>

namespace gonio {
namespace {

using namespace test;

StackPart read(const std::string& stack, const Rectangle& part) {
  const StackReader reader(read_stack(stack));
  StackPart samples;
  reader.read(part, samples);
  return samples;
}
constexpr Rectangle whole{0, 0, stack_width, stack_height};

TEST(StackReader, HoldsTheValuesOfAPartAndEachImagesDirections) {
  const Folder f;
  const Rectangle part{1, 2, 3, 2};
  const auto s = read(example_stack(f), part);
  ASSERT_EQ(s.pieces(), 1U);
  const auto p = s.piece(0);
  ASSERT_EQ(p.texels, 6U);
  EXPECT_TRUE(s.shared);
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t t = 0; t < 6; ++t)
        EXPECT_EQ(p.values[(i * 3 + c) * 6 + t],
                  stack_value(i, c, (2 + t / 3) * stack_width + 1 + t % 3));
  ASSERT_EQ(p.light.size(), 6U);
  EXPECT_FLOAT_EQ(p.light[1], 0.5F);
  EXPECT_FLOAT_EQ(p.light[3], 0.6F);
  EXPECT_FLOAT_EQ(p.light[5], 0.8F);
  EXPECT_FLOAT_EQ(p.view[5], 1);
  EXPECT_TRUE(p.normal.empty());
}

TEST(StackReader, ReadsNumpysArraysAsTheSameImages) {
  const Folder f;
  const auto exr = read(example_stack(f), whole);
  for (std::size_t i = 0; i < 2; ++i) {
    std::vector<float> mixed;
    for (std::size_t t = 0; t < whole.size(); ++t)
      for (std::size_t c = 0; c < 3; ++c) mixed.push_back(stack_value(i, c, t));
    f.write(std::to_string(i) + ".npy",
            npy_header({stack_height, stack_width, 3}) +
                std::string(reinterpret_cast<const char*>(mixed.data()), mixed.size() * 4));
  }
  std::string images = two_images;
  for (auto at = images.find(".exr"); at != images.npos; at = images.find(".exr"))
    images.replace(at, 4, ".npy");
  const auto npy = read(write_stack(f, images), whole);
  EXPECT_EQ(npy.values, exr.values);
  EXPECT_EQ(npy.light, exr.light);
}

TEST(StackReader, CutsPiecesInTheOrderOfTheRows) {
  const Folder f;
  constexpr std::size_t width = 400;  // × 4 rows: four pieces
  write_exr(f / "0.exr", stack_image(0, width));
  write_exr(f / "1.exr", stack_image(1, width));
  const auto s = read(write_stack(f, two_images), {0, 0, width, stack_height});
  ASSERT_EQ(s.pieces(), 4U);
  std::size_t seen = 0;
  for (std::size_t k = 0; k < s.pieces(); ++k) {
    const auto p = s.piece(k);
    EXPECT_EQ(p.first, seen);
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t t = 0; t < p.texels; ++t)
          ASSERT_EQ(p.values[(i * 3 + c) * p.texels + t], stack_value(i, c, p.first + t));
    seen += p.texels;
  }
  EXPECT_EQ(seen, width * stack_height);
}

TEST(StackReader, MasksWhatIsNoNumber) {
  const Folder f;
  const auto path = example_stack(f);
  Image i = stack_image(0);
  i.planes[1][3] = std::numeric_limits<float>::infinity();
  i.planes[2][4] = std::numeric_limits<float>::quiet_NaN();
  write_exr(f / "0.exr", i);
  const auto s = read(path, whole);
  for (std::size_t k = 0; k < s.values.size(); ++k)
    EXPECT_EQ(std::isnan(s.values[k]), k == 1 * 20 + 3 || k == 0 * 20 + 4) << k;
}

TEST(StackReader, DividesTheCosineOut) {
  const Folder f;
  const auto f_r = read(example_stack(f), whole);
  const auto with = read(example_stack(f, R"(, "values": "f_r_cosine")"), whole);
  for (std::size_t k = 0; k < f_r.values.size(); ++k)
    EXPECT_NEAR(with.values[k] * (k < 60 ? std::sqrt(0.75F) : 0.8F), f_r.values[k],
                1e-6F * f_r.values[k]);

  // With a normal of its own, a texel's cosine is to that.
  write_exr(f / "n.exr", vector_image(0.6F, 0, 0.8F));
  const auto turned =
      read(example_stack(f, R"(, "values": "f_r_cosine", "normals": "n.exr")"), whole);
  for (std::size_t k = 60; k < 120; ++k)  // the second light is along the normal
    EXPECT_NEAR(turned.values[k], f_r.values[k], 1e-6F * f_r.values[k]);
  EXPECT_NEAR(turned.normal[0], 0.6F, 1e-7F);
  EXPECT_NEAR(turned.normal[2 * 20 + 7], 0.8F, 1e-7F);
}

TEST(StackReader, HasADirectionForEachTexelWhereAnImageHas) {
  const Folder f;
  const auto shared = read(example_stack(f), whole);
  write_exr(f / "l.exr", vector_image(3, 0, 4));
  const auto s =
      read(write_stack(f, R"([{"path": "0.exr", "theta_i": 30, "phi_i": 90, "theta_o": 0},)"
                          R"( {"path": "1.exr", "light_map": "l.exr", "view": [0, 0, 2]}])"),
           whole);
  EXPECT_FALSE(s.shared);
  EXPECT_EQ(s.values, shared.values);
  const auto p = s.piece(0);
  ASSERT_EQ(p.light.size(), 2 * 3 * 20U);
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t t = 0; t < 20; ++t) {
        EXPECT_EQ(p.light[(i * 3 + k) * 20 + t], shared.light[i * 3 + k]);
        EXPECT_EQ(p.view[(i * 3 + k) * 20 + t], shared.view[i * 3 + k]);
      }
}

TEST(StackReader, SeesANearLampFromEachTexelAndMoreOfItsLightWhereItIsNearer) {
  const Folder f;
  example_stack(f);
  const std::string images =
      R"([{"path": "0.exr", "light_position": [1, 2, 6], "view_position": [0, 0, 9], "scale": 2}])";
  Image heights{stack_width, stack_height, {"Y"}, {std::vector<float>(20, 0.5F)}, {}};
  write_exr(f / "h.exr", heights);
  for (const double height : {0.0, 0.5}) {
    const auto s = read(write_stack(f, images,
                                    std::string(R"(, "values": "f_r_cosine", "width": 10)") +
                                        (height > 0 ? R"(, "heights": "h.exr")" : "")),
                        whole);
    ASSERT_FALSE(s.shared);
    for (std::size_t t = 0; t < 20; ++t) {
      // Texels are 2 wide, and the middle is that of column 2, between the rows 1 and 2.
      const double x = 2 * (static_cast<double>(t % 5) - 2),
                   y = 2 * (1.5 - static_cast<double>(t / 5));
      const double lx = 1 - x, ly = 2 - y, lz = 6 - height, far = std::hypot(lx, ly, lz);
      EXPECT_NEAR(s.light[t], lx / far, 1e-6);
      EXPECT_NEAR(s.light[20 + t], ly / far, 1e-6);
      EXPECT_NEAR(s.light[40 + t], lz / far, 1e-6);
      EXPECT_NEAR(s.view[t], -x / std::hypot(x, y, 9 - height), 1e-6);
      const double of_middle = 1 + 4 + 36;
      const double expected =
          2 * double{stack_value(0, 0, t)} * (far * far / of_middle) / (lz / far);
      EXPECT_NEAR(s.values[t], expected, 1e-5 * expected);
    }
  }
}

TEST(StackReader, NeedsTheWidthInWhichLampsHavePositions) {
  const Folder f;
  const auto line = [&](const char* image, const char* more) {
    return refusal([&] { read(write_stack(f, image, more), whole); });
  };
  example_stack(f);
  const char* near = R"([{"path": "0.exr", "light_position": [1, 2, 6], "theta_o": 0}])";
  EXPECT_HAS(line(near, ""), "/images: found an array, expected \"width\" beside it");
  EXPECT_EQ(line(near, R"(, "width": 10)"), "");
  EXPECT_HAS(
      line(R"([{"path": "0.exr", "light_position": [1, 2, 0], "theta_o": 0}])", R"(, "width": 10)"),
      "light_position: ");
  write_exr(f / "h.exr", Image{5, 4, {"Y"}, {std::vector<float>(20, 7)}, {}});
  EXPECT_HAS(line(near, R"(, "width": 10, "heights": "h.exr")"),
             "column 0, row 0: found one below");
  write_exr(f / "h.exr", vector_image(0, 0, 1));
  EXPECT_HAS(line(near, R"(, "width": 10, "heights": "h.exr")"), "h.exr: channels");
}

/// Image whose channel c has begin + c + step · texel.
Image ramp(float begin, float step) {
  Image i = stack_image(0);
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t t = 0; t < whole.size(); ++t)
      i.planes[2 - c][t] = begin + static_cast<float>(c) + step * static_cast<float>(t);
  return i;
}

TEST(StackReader, TakesTheDarkFrameOffAndDividesByTheWhiteSheetOverItsMiddle) {
  const Folder f;
  write_exr(f / "dark.exr", ramp(0.125F, 0));
  write_exr(f / "white.exr", ramp(2, 0.25F));
  const auto plain = read(example_stack(f), whole);
  const auto both = read(example_stack(f, R"(, "dark": "dark.exr", "flat": "white.exr")"), whole);
  const auto dark = read(example_stack(f, R"(, "dark": "dark.exr")"), whole);
  for (std::size_t k = 0; k < plain.values.size(); ++k) {
    const auto c = static_cast<float>(k / 20 % 3), t = static_cast<float>(k % 20);
    const float less = plain.values[k] - (0.125F + c);
    EXPECT_FLOAT_EQ(dark.values[k], less) << "below 0, too";
    EXPECT_FLOAT_EQ(both.values[k], less * (1.875F + 0.25F * 7) / (1.875F + 0.25F * t)) << k;
  }
}

TEST(StackReader, KnowsClippedLightByTheFilesOwnNumbersAndShadowsWithoutTheDarkFrame) {
  const Folder f;
  write_exr(f / "dark.exr", ramp(0.25F, 0));
  const auto s =
      read(example_stack(f, R"(, "dark": "dark.exr", "saturation": 4.25, "floor": 0.5)"), whole);
  for (std::size_t t = 0; t < 20; ++t) {
    const float own = stack_value(0, 0, t);
    EXPECT_EQ(std::isnan(s.values[t]), own >= 4.25F || own - 0.25F <= 0.5F) << own;
  }
}

TEST(StackReader, LooksAtItsFramesAsAtItsImages) {
  const Folder f;
  write_exr(f / "white.exr", ramp(2, 0.25F));
  const std::string path = example_stack(f, R"(, "flat": "white.exr")");
  const auto line = [&] { return refusal([&] { StackReader reader(read_stack(path)); }); };
  const auto name = StackReader(read_stack(path)).digest();
  write_exr(f / "white.exr", ramp(2.5F, 0.25F));
  EXPECT_NE(StackReader(read_stack(path)).digest(), name);
  {
    const FileGuard guard;
    const StackReader reader(read_stack(path));
    EXPECT_THROW(OutputFile(f / "white.exr"), NameTaken) << "an input";
  }
  write_exr(f / "white.exr", stack_image(0, 6));
  EXPECT_HAS(line(), "white.exr: size: found 6 × 4");
  Image white = ramp(2, 0.25F);
  for (auto& plane : white.planes)
    for (const std::size_t t : {6, 7, 8, 11, 12, 13}) plane[t] = 0;
  write_exr(f / "white.exr", white);
  EXPECT_HAS(line(), "white.exr: its middle: found none above the dark frame");
  std::filesystem::remove(f / "white.exr");
  EXPECT_HAS(line(), "white.exr: opening");
}

TEST(StackReader, RefusesAFrameThatIsNoPhotograph) {
  const Folder f;
  constexpr float no_number = std::numeric_limits<float>::quiet_NaN(),
                  infinite = std::numeric_limits<float>::infinity();
  const auto line = [&](const char* frame, float first, std::size_t texels) {
    Image image = ramp(2, 0.25F);
    for (auto& plane : image.planes) std::fill_n(plane.begin(), texels, first);
    write_exr(f / "frame.exr", image);
    const std::string path = example_stack(f, std::string(R"(, ")") + frame + R"(": "frame.exr")");
    return refusal([&] { StackReader::expect_frames(read_stack(path)); });
  };
  for (const float wrong : {0.0F, -1.0F, no_number, infinite}) {
    EXPECT_HAS(line("flat", wrong, 20),
               "frame.exr: R: found none above 0 in 20 of 20 pixels, expected numbers of a white "
               "sheet");
    EXPECT_HAS(line("flat", wrong, 11), "in 11 of 20 pixels");
    EXPECT_EQ(line("flat", wrong, 4), "") << "some are dead";
  }
  for (const float wrong : {no_number, infinite}) {
    EXPECT_HAS(line("dark", wrong, 20),
               "frame.exr: R: found none in 20 of 20 pixels, expected numbers of a photograph");
    EXPECT_EQ(line("dark", wrong, 4), "");
  }
  EXPECT_EQ(line("dark", 0, 20), "") << "nothing is dark";
}

TEST(StackReader, RefusesADirectionBelowTheSurfaceByItsTexel) {
  const Folder f;
  example_stack(f);
  const auto path = write_stack(f, R"([{"path": "0.exr", "light_map": "l.exr", "theta_o": 0}])",
                                R"(, "normals": "n.exr")");
  write_exr(f / "n.exr", vector_image(0, 0, 1));
  const auto line_with = [&](float z) {
    Image l = vector_image(0, 0, 1);
    l.planes[2][7] = z;
    write_exr(f / "l.exr", l);
    return refusal([&] { read(path, whole); });
  };
  EXPECT_EQ(line_with(1), "") << "the ruler";
  EXPECT_HAS(line_with(-1), "l.exr: column 2, row 1: found one below the surface");
  EXPECT_HAS(line_with(0), "column 2, row 1");
  EXPECT_HAS(line_with(std::numeric_limits<float>::quiet_NaN()), "found no direction");
  // Not where there is no value, or no surface.
  Image masked = stack_image(0);
  for (auto& plane : masked.planes) plane[7] = std::numeric_limits<float>::quiet_NaN();
  write_exr(f / "0.exr", masked);
  EXPECT_EQ(line_with(-1), "");
  write_exr(f / "0.exr", stack_image(0));
  Image n = vector_image(0, 0, 1);
  n.planes[2][7] = 0;
  write_exr(f / "n.exr", n);
  EXPECT_EQ(line_with(-1), "");
  EXPECT_TRUE(std::isnan(read(path, whole).values[7]));
  n.planes[2][7] = -1;
  write_exr(f / "n.exr", n);
  EXPECT_HAS(line_with(1), "n.exr: column 2, row 1: found a normal that points below");
}

TEST(StackReader, RefusesImagesOfOtherSizesAndWithoutTheChannels) {
  const Folder f;
  const auto path = example_stack(f);
  const auto line = [&] { return refusal([&] { StackReader reader(read_stack(path)); }); };
  EXPECT_EQ(line(), "");
  write_exr(f / "1.exr", stack_image(1, 6));
  EXPECT_HAS(line(), "1.exr: size: found 6 × 4, expected 5 × 4 as ");
  Image two = stack_image(1);
  two.channels.pop_back();
  two.planes.pop_back();
  write_exr(f / "1.exr", two);
  EXPECT_HAS(line(), "1.exr: channels: found B, G, expected R, G, B among them");
  write_exr(f / "0.exr", two);
  EXPECT_HAS(line(), "0.exr: channels: found B, G, expected one, or R, G and B");
  f.write("0.exr", "no image");
  EXPECT_HAS(line(), "an image in OpenEXR, an array of NumPy's");
  std::filesystem::remove(f / "0.exr");
  EXPECT_HAS(line(), "0.exr: opening");
}

TEST(StackReader, HasTheOnlyChannelOrThoseThatTheStackNames) {
  const Folder f;
  example_stack(f);
  const StackReader green(read_stack(write_stack(f, two_images, R"(, "channels": ["G"])")));
  EXPECT_EQ(green.channels(), std::vector<std::string>{""});
  StackPart s;
  green.read(whole, s);
  EXPECT_EQ(s.channels, 1U);
  EXPECT_EQ(s.values[3], stack_value(0, 1, 3));
}

TEST(StackReader, IsNamedByItsBytesAndNotByItsPlace) {
  const Folder f, g;
  const auto digest = [](const std::string& path) {
    return StackReader(read_stack(path)).digest();
  };
  const auto name = digest(example_stack(f));
  EXPECT_EQ(digest(example_stack(g)), name);
  EXPECT_NE(digest(example_stack(g, R"(, "values": "f_r_cosine")")), name);
  example_stack(g);
  Image other = stack_image(1);
  other.planes[0][11] += 1;
  write_exr(g / "1.exr", other);
  EXPECT_NE(digest(g / "stack.json"), name);
}

TEST(StackReader, TellsTheFirstOfSeveralErrorsWhateverTheThreads) {
  const Folder f;
  std::string images = "[";
  for (int i = 0; i < 8; ++i) {
    write_exr(f / std::to_string(i) + ".exr", stack_image(0));
    Image l = vector_image(0, 0, i < 3 ? 1 : -1);
    write_exr(f / "l" + std::to_string(i) + ".exr", l);
    images += std::string(i ? "," : "") + R"({"path": ")" + std::to_string(i) +
              R"(.exr", "theta_o": 0, "light_map": "l)" + std::to_string(i) + R"(.exr"})";
  }
  const StackReader reader(read_stack(write_stack(f, images + "]")));
  for (int round = 0; round < 20; ++round) {
    StackPart s;
    EXPECT_HAS(refusal([&] { reader.read(whole, s); }), "l3.exr: column 0, row 0");
  }
}

TEST(StackReader, IsNamedByEveryByteOfItsImages) {
  const Folder f;
  constexpr std::size_t side = 512;  // 3 MB, of which the byte lies in the middle
  std::string bytes = npy_header({side, side, 3}) + std::string(side * side * 3 * 4, '\0');
  f.write("a.npy", bytes);
  const auto path = write_stack(f, R"([{"path": "a.npy", "theta_i": 0, "theta_o": 10}])");
  const auto before = StackReader(read_stack(path)).digest();
  for (std::size_t at = bytes.size() / 2; at < bytes.size(); at += 400'003) {
    std::string other = bytes;
    other[at] = '\1';
    f.write("a.npy", other);
    EXPECT_NE(StackReader(read_stack(path)).digest(), before) << at;
  }
}

TEST(StackReader, RefusesAnImageThatChangesWhileItIsRead) {
  const Folder f;
  const StackReader reader(read_stack(example_stack(f)));
  StackPart s;
  reader.read(whole, s);
  Image other = stack_image(1);
  other.planes[0][11] += 1;
  write_exr(f / "1.exr", other);
  EXPECT_HAS(refusal([&] { reader.read(whole, s); }), "1.exr: reading: found the file changed");
}

TEST(StackReader, RefusesAFileThatIsMuchLongerThanItsImage) {
  const Folder f;
  const auto path = example_stack(f);
  std::filesystem::resize_file(f / "1.exr", std::uintmax_t{1} << 40U);
  EXPECT_HAS(refusal([&] { StackReader reader(read_stack(path)); }), "1.exr: size");
}

}  // namespace
}  // namespace gonio
