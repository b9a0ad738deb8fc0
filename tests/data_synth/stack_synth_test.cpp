// Synthesized stacks are what they say they are.
#include "data_synth/stack_synth.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "brdf/model/evaluate.h"
#include "image/image_file.h"
#include "refusal.h"
#include "stack/stack_reader.h"
#include "support.h"

#include <tbb/global_control.h>

namespace gonio {
namespace {

using namespace test;

BoundModel paint() {
  return bind_model("lambert+ggx/smith_ggx.correlated/schlick",
                    parse_settings(std::vector<std::string>{"alpha=0.15,f0=0.05,kd=0.2,0.1,0.05"}),
                    3);
}
std::vector<std::vector<float>> planes_of(const std::string& path) {
  const auto file = open_image(path);
  std::vector<std::size_t> all;
  std::vector<std::vector<float>> planes;
  std::vector<float*> to;
  for (std::size_t c = 0; c < file->channels().size(); ++c) {
    all.push_back(c);
    planes.emplace_back(file->width() * file->height());
  }
  for (auto& p : planes) to.push_back(p.data());
  file->read({0, 0, file->width(), file->height()}, all, to);
  return planes;
}

/// Widths that grow to the right, red that grows downwards.
std::string varying(const Folder& f, std::size_t width, std::size_t height) {
  Image p;
  p.width = width;
  p.height = height;
  p.channels = {"alpha", "kd.R"};
  p.planes.resize(2);
  for (std::size_t t = 0; t < width * height; ++t) {
    p.planes[0].push_back(0.1F + 0.01F * static_cast<float>(t % width));
    p.planes[1].push_back(0.02F * static_cast<float>(t / width));
  }
  write_exr(f / "p.exr", p);
  return f / "p.exr";
}

TEST(StackSynth, HoldsTheModelOfEachTexelsParameters) {
  const Folder f;
  StackSynthOptions o;
  o.images = 5;
  o.parameters = varying(f, 6, 20);
  const Stack written = synthesize_stack(paint(), o, f / "s");
  const StackReader reader(read_stack(f / "s/stack.json"));
  EXPECT_EQ(reader.width(), 6U);
  EXPECT_EQ(reader.height(), 20U);
  StackPart s;
  reader.read({0, 0, 6, 20}, s);
  for (const std::size_t t : {0, 5, 57, 119}) {
    BoundModel b = paint();
    b.values[b.model.find("alpha")->first] = static_cast<double>(0.1F + 0.01F * float(t % 6));
    b.values[b.model.find("kd")->first] = static_cast<double>(0.02F * float(t / 6));
    for (const char* held : {"f0", "kd"})  // as files hold them
      for (std::size_t c = 0; c < 3; ++c) {
        double& v = b.values[b.model.find(held)->slot(c)];
        v = static_cast<double>(static_cast<float>(v));
      }
    for (std::size_t i = 0; i < 5; ++i) {
      const auto& image = written.images[i];
      const std::vector at{angles({*direction_of(image.light), *direction_of(image.view)})};
      const auto value = evaluate(b, at);
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_EQ(s.values[(i * 3 + c) * 120 + t], static_cast<float>(value[c][0]));
    }
  }
  const auto truth = open_image(f / "s/parameters.exr");
  EXPECT_NE(std::ranges::find(truth->channels(), "f0.G"), truth->channels().end());
}

TEST(StackSynth, IsTheSameInOpenExrAndInNumpysArrays) {
  const Folder f;
  StackSynthOptions o;
  o.images = 3;
  o.width = 9;
  o.height = 17;
  synthesize_stack(paint(), o, f / "exr");
  o.format = ImageFormat::npy;
  synthesize_stack(paint(), o, f / "npy");
  StackPart exr, npy;
  StackReader(read_stack(f / "exr/stack.json")).read({0, 0, 9, 17}, exr);
  StackReader(read_stack(f / "npy/stack.json")).read({0, 0, 9, 17}, npy);
  EXPECT_EQ(exr.values, npy.values);
  EXPECT_EQ(exr.light, npy.light);
}

TEST(StackSynth, NoiseIsOfTheSizeAskedForAndTheSameWhateverTheThreads) {
  const Folder f;
  StackSynthOptions o;
  o.images = 2;
  o.width = o.height = 40;
  const auto bytes = [&](int threads, std::uint64_t seed, const std::string& name) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(threads));
    o.noise = 0.1;
    o.seed = seed;
    synthesize_stack(paint(), o, f / name);
    return read_bytes(f / name + "/image_001.exr");
  };
  EXPECT_EQ(bytes(1, 3, "a"), bytes(4, 3, "b"));
  EXPECT_NE(bytes(1, 3, "a"), bytes(1, 4, "c"));
  const auto noisy = planes_of(f / "a/image_001.exr");
  o.noise = 0;
  o.seed = 3;
  synthesize_stack(paint(), o, f / "clean");
  const auto clean = planes_of(f / "clean/image_001.exr");
  double sum = 0, squares = 0;
  for (std::size_t t = 0; t + 16 * 40 < 1600; ++t)
    EXPECT_NE(noisy[0][t], noisy[0][t + 16 * 40]) << "each texel draws its own";
  for (std::size_t t = 0; t < 1600; ++t) {
    const double z = std::log(static_cast<double>(noisy[0][t] / clean[0][t])) / 0.1;
    sum += z;
    squares += z * z;
  }
  EXPECT_NEAR(sum / 1600, 0, 4 / std::sqrt(1600));
  EXPECT_NEAR(squares / 1600, 1, 4 * std::sqrt(2.0 / 1600));
}

TEST(StackSynth, OfANormalIsThatOfTheTurnedDirections) {
  const Folder f;
  Image n;
  n.width = 2;
  n.height = 1;
  n.channels = {"X", "Y", "Z"};
  n.planes = {{0.6F, 0}, {0, 0}, {0.8F, 0}};  // of the second texel there is none
  write_exr(f / "n.exr", n);
  DirectionList l;
  l.theta_i_deg = {50};
  l.phi_i_deg = {0};
  l.theta_o_deg = {10};
  l.phi_o_deg = {0};
  StackSynthOptions o;
  o.directions = l;
  o.normals = f / "n.exr";
  o.values = StackValues::f_r_cosine;
  synthesize_stack(paint(), o, f / "s");
  const auto got = planes_of(f / "s/image_000.exr");
  const double tilt = std::atan2(0.6, 0.8) / degree;
  const std::vector at{
      angles({direction((50 - tilt) * degree, 0), direction((tilt - 10) * degree, 180 * degree)})};
  const double expected = evaluate(paint(), at)[0][0] * std::cos((50 - tilt) * degree);
  EXPECT_NEAR(got[2][0], expected, 1e-6 * expected);  // R is the last by its name
  EXPECT_TRUE(std::isnan(got[2][1]));
}

TEST(StackSynth, RefusesParametersThatNoModelHasOrTakes) {
  const Folder f;
  Image p;
  p.width = p.height = 1;
  const auto line = [&](const std::string& channel, float value) {
    p.channels = {channel};
    p.planes = {{value}};
    write_exr(f / "p.exr", p);
    StackSynthOptions o;
    o.images = 1;
    o.parameters = f / "p.exr";
    return refusal([&] { synthesize_stack(paint(), o, f / "s"); });
  };
  EXPECT_EQ(line("kd", 0.5F), "") << "grey";
  EXPECT_HAS(line("roughness", 0.5F), "found roughness, expected parameters of the model: kd.R");
  EXPECT_HAS(line("rms", 0.5F), "found rms");
  const std::filesystem::path folder(f / "s");
  std::filesystem::remove_all(folder);
  EXPECT_HAS(line("alpha", -2), "column 0, row 0: found alpha = -2");
  EXPECT_TRUE(std::filesystem::is_empty(folder)) << "nothing is left";
  EXPECT_EQ(line("alpha", std::numeric_limits<float>::quiet_NaN()), "");
  EXPECT_TRUE(std::isnan(planes_of(f / "s/image_000.exr")[0][0]));
}

}  // namespace
}  // namespace gonio
