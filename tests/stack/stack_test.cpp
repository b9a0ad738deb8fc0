// Documents of stacks: what they say, and how they are refused.
#include "stack/stack.h"

#include "base/error.h"
#include "refusal.h"
#include "stack/example.h"

namespace gonio {
namespace {

using namespace test;

TEST(Stack, ReadsDirectionsInEachForm) {
  const Folder f;
  const Stack s = read_stack(write_stack(
      f,
      R"([{"path": "0.exr", "theta_i": 30, "phi_i": 90, "view_map": "v.exr", "scale": 2},)"
      R"( {"path": "1.exr", "light": [3, 0, 4], "theta_o": 60}])",
      R"(, "values": "f_r_cosine", "normals": "n.exr", "channels": ["R", "G", "B"])"));
  ASSERT_EQ(s.images.size(), 2U);
  const auto light = direction_of(s.images[0].light);
  ASSERT_TRUE(light);
  EXPECT_NEAR(light->x, 0, 1e-15);
  EXPECT_NEAR(light->y, 0.5, 1e-15);
  EXPECT_NEAR(light->z, std::sqrt(0.75), 1e-15);
  EXPECT_FALSE(direction_of(s.images[0].view)) << "each texel has its own";
  EXPECT_EQ(s.images[0].scale, 2);
  const auto other = direction_of(s.images[1].light);
  EXPECT_NEAR(other->x, 0.6, 1e-15);
  EXPECT_NEAR(other->z, 0.8, 1e-15);
  EXPECT_NEAR(direction_of(s.images[1].view)->z, 0.5, 1e-15);
  EXPECT_EQ(s.values, StackValues::f_r_cosine);
  EXPECT_EQ(s.path_of("n.exr"), f / "n.exr");
}

TEST(Stack, IsReadBackAsItWasWritten) {
  const Folder f;
  Stack s = read_stack(
      write_stack(f, R"([{"path": "0.exr", "theta_i": 30, "phi_i": 90, "view_map": "v.exr"}])",
                  R"(, "truth": {"model": "lambert", "parameters": "p.exr", "noise": 0.5})"));
  const std::string text = to_json(s);
  const Stack back = read_stack(f.write("again.json", text));
  EXPECT_EQ(to_json(back), text);
  EXPECT_HAS(text, "\"theta_i\": 30.0");
  EXPECT_HAS(text, "\"view_map\": \"v.exr\"");
}

TEST(Stack, RefusesDirectionsThatAreMissingDoubleOrBelowTheSurface) {
  const Folder f;
  const auto line = [&](const std::string& image, const std::string& more = "") {
    return refusal([&] { read_stack(write_stack(f, "[" + image + "]", more)); });
  };
  EXPECT_EQ(line(R"({"path": "a", "theta_i": 0, "theta_o": 0})"), "") << "the ruler";
  EXPECT_HAS(line(R"({"path": "a", "theta_o": 0})"),
             "/images/0: found none of its keys, expected one of theta_i, light, light_map or "
             "light_position");
  EXPECT_HAS(line(R"({"path": "a", "theta_i": 0})"),
             "one of theta_o, view, view_map or view_position");
  EXPECT_HAS(line(R"({"path": "a", "theta_i": 0, "light": [0, 0, 1], "theta_o": 0})"),
             "found theta_i and light");
  EXPECT_HAS(line(R"({"path": "a", "theta_i": 90, "theta_o": 0})"), "/images/0/theta_i: found 90");
  EXPECT_HAS(line(R"({"path": "a", "light": [1, 0, 0], "theta_o": 0})"), "z above 0");
  EXPECT_HAS(line(R"({"path": "a", "theta_i": 0, "view": [0, 0, -1]})"), "/images/0/view");
  EXPECT_HAS(line(R"({"path": "a", "theta_i": 0, "theta_o": 0, "scale": 0})"), "scale");
  EXPECT_HAS(line(R"({"path": "a", "theta_i": 0, "theta_o": 0, "exposure": 1})"), "no such key");
  EXPECT_HAS(line(""), "found an array of 0");
  EXPECT_HAS(line(R"({"path": "a", "theta_i": 0, "theta_o": 0})", R"(, "channels": ["R", "G"])"),
             "an array of 1 or 3");
  EXPECT_HAS(line(R"({"path": "a", "theta_i": 0, "theta_o": 0})", R"(, "values": "radiance")"),
             "f_r or f_r_cosine");
}

}  // namespace
}  // namespace gonio
