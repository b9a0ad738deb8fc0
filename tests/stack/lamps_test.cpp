// Lists of lamps: what they name, and what is refused.
#include "stack/lamps.h"

#include <cmath>
#include <filesystem>
#include <variant>

#include "refusal.h"
#include "stack/example.h"
#include "stack/stack_reader.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

using namespace test;

/// Two images and their list.
void write_dome(const Folder& f, const std::string& list) {
  std::filesystem::create_directories(f / "dome");
  for (std::size_t k = 0; k < 2; ++k)
    write_exr(f / ("dome/img_" + std::to_string(k) + ".exr"), stack_image(k));
  f.write("dome/lamps.lp", list);
}

TEST(Lamps, BecomeAStackOfImagesSeenFromAbove) {
  const Folder f;
  write_dome(f, "2\r\nC:\\my dome\\img_0.jpg 0.1 -0.2 0.9\r\n\r\n/raw/img_1.exr\t0 0.5 2\r\n");
  const Stack s = stack_of_lamps(f / "dome/lamps.lp", "", f / "stack.json");
  ASSERT_EQ(s.images.size(), 2U);
  EXPECT_EQ(s.images[0].path, "dome/img_0.exr");
  EXPECT_EQ(s.images[1].path, "dome/img_1.exr");
  EXPECT_EQ(s.values, StackValues::f_r_cosine);
  const auto light = std::get<SideVector<Side::light>>(s.images[0].light).towards;
  EXPECT_EQ(light.x, 0.1);
  EXPECT_EQ(light.y, -0.2);
  EXPECT_EQ(light.z, 0.9);
  EXPECT_EQ(direction_of(s.images[1].view)->z, 1);
  f.write("stack.json", to_json(s));
  EXPECT_EQ(StackReader(read_stack(f / "stack.json")).width(), stack_width);
}

TEST(Lamps, OfClippedAndDarkNumbersAreLeftOutBeforeTheyAreScaled) {
  const Folder f;
  write_dome(f, "2\nimg_0.exr 0 0 1\nimg_1.exr 0 0 1\n");
  Stack s = stack_of_lamps(f / "dome/lamps.lp", "", f / "stack.json");
  for (auto& image : s.images) image.scale = 100;
  s.saturation = stack_value(0, 0, 7);
  s.floor = stack_value(0, 0, 2);
  f.write("stack.json", to_json(s));
  StackPart part;
  StackReader(read_stack(f / "stack.json")).read({0, 0, stack_width, stack_height}, part);
  const auto values = part.piece(0).values;
  for (std::size_t t = 0; t < stack_width * stack_height; ++t)
    EXPECT_EQ(std::isnan(values[t]), t <= 2 || t >= 7) << t;
}

TEST(Lamps, AreRefusedByTheirLine) {
  const Folder f;
  const auto said = [&](const std::string& list) {
    write_dome(f, list);
    return refusal([&] { stack_of_lamps(f / "dome/lamps.lp", "", f / "dome/stack.json"); });
  };
  EXPECT_HAS(said(""), "an empty file");
  EXPECT_HAS(said("\n\n"), "line 1: found nothing");
  EXPECT_HAS(said("two\n"), "line 1: found two");
  EXPECT_HAS(said("3\nimg_0.exr 0 0 1\nimg_1.exr 0 0 1\n"), "line 1: found 3 images");
  EXPECT_HAS(said("2\nimg_0.exr 0 0 1\nimg_1.exr 0 nan 1\n"), "line 3");
  EXPECT_HAS(said("1\nimg_0.exr 0 1\n"), "line 2");
  EXPECT_HAS(said("1\n0 0 1\n"), "a name before");
  EXPECT_HAS(said("1\nimg_0.exr 0 0 -1\n"), "z = -1");
  EXPECT_HAS(said("2\nimg_0.exr 0 0 1\nimg_0.exr 0 1 1\n"), "each image once");
  EXPECT_HAS(said("2\nimg_0.jpg 0 0 1\nimg_0.tif 0 1 1\n"), "each image once");
  EXPECT_HAS(said("1\nnothing.exr 0 0 1\n"), "nothing.exr");
  write_dome(f, "1\nimg_0.exr 0 0 1\n");
  std::filesystem::create_directories(f / "other");
  EXPECT_HAS(refusal([&] { stack_of_lamps(f / "dome/lamps.lp", "", f / "other/stack.json"); }),
             "below the folder");
}

TEST(Lamps, TakeAnImageByItsNameBeforeOneOfAnotherEnding) {
  const Folder f;
  write_dome(f, "1\nimg_0.npy 0 0 1\n");
  f.write("dome/img_0.npy", "an array");
  EXPECT_EQ(stack_of_lamps(f / "dome/lamps.lp", "", f / "stack.json").images[0].path,
            "dome/img_0.npy");
}

TEST(Lamps, OfManyLinesTakeLinearTime) {
  const Folder f;
  std::string list = "9999\n";
  for (int k = 0; k < 9999; ++k) list += "img_" + std::to_string(k) + ".exr 0 0 1\n";
  write_dome(f, list);
  EXPECT_HAS(refusal([&] { stack_of_lamps(f / "dome/lamps.lp", "", f / "stack.json"); }),
             "img_2.exr");
}

}  // namespace
}  // namespace gonio
