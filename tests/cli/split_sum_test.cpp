// gonio split_sum: what it prints and writes, and what it refuses.
#include <cmath>
#include <cstdio>

#include "cli/program.h"
#include "image/exr.h"

namespace gonio::test {
namespace {

/// A sky of an even grey, in OpenEXR; below the horizon half of it.
std::string even_sky(const std::string& path, float radiance) {
  Image sky{16, 8, {"R", "G", "B"}, {}, {}};
  for (int c = 0; c < 3; ++c) {
    auto& plane = sky.planes.emplace_back();
    for (std::size_t k = 0; k < sky.width * sky.height; ++k)
      plane.push_back(k < sky.width * sky.height / 2 ? radiance : radiance / 2);
  }
  return exr_bytes(path, sky);
}

TEST(SplitSumCommand, AddsUpToTheAlbedo) {
  const Folder f;
  const auto j = gonio(f, "split_sum --roughness 0.5,1 --nov 0.05,1 --json").json();
  ASSERT_EQ(j["rows"].size(), 4U);
  const auto& row = j["rows"][3];
  EXPECT_EQ(row["roughness"], 1);
  EXPECT_EQ(row["nov"], 1);
  EXPECT_NEAR(row["a"].get<double>() + row["b"].get<double>(), 1 - std::log(2.0), 1e-7);
  EXPECT_LE(row["error_bound"], 1e-7);
  const auto separable =
      gonio(f, "split_sum --roughness 1 --nov 0.05 --masking smith_ggx.separable --json").json();
  EXPECT_NEAR(separable["rows"][0]["a"].get<double>() + separable["rows"][0]["b"].get<double>(),
              2 * (1 - std::log(2.0)) / 1.05, 1e-7);
}

TEST(SplitSumCommand, BySamplesIsNearTheQuadrature) {
  const Folder f;
  const std::string words = "split_sum --roughness 0.5 --nov 0.4 --json";
  const auto truth = gonio(f, words).json()["rows"][0];
  const auto sampled = gonio(f, words + " --samples 1024").json()["rows"][0];
  for (const char* name : {"a", "b", "diffuse"}) {
    EXPECT_NEAR(sampled[name], truth[name], 0.005) << name;
    EXPECT_NE(sampled[name], truth[name]) << name;
  }
  EXPECT_FALSE(sampled.contains("error_bound"));
}

TEST(SplitSumCommand, WritesTheTableAndSaysHowFarOffItIs) {
  const Folder f;
  const std::string words = "split_sum --size 16x16 --json -o t.exr --precision ";
  const auto half = gonio(f, words + "half");
  ASSERT_EQ(half.code, 0) << half.err;
  const auto bytes = read_bytes(f / "t.exr");
  EXPECT_NE(bytes.find("gonio:split_sum"), bytes.npos);
  const auto j = half.json();
  EXPECT_EQ(j["width"], 16);
  EXPECT_EQ(j["precision"], "half");
  EXPECT_EQ(j["masking"], "masking.smith_ggx.correlated");
  EXPECT_LE(j["error_bound"], 1e-7);
  EXPECT_LE(j["storage_error"]["a"]["max"], 0x1p-12);
  EXPECT_GT(j["storage_error"]["a"]["max"], 1e-5);
  EXPECT_GT(j["lookup_error"]["e"]["max"], j["lookup_error_between_centres"]["e"]["max"]);
  EXPECT_EQ(gonio(f, words + "half --jobs 1").json(), j);
  EXPECT_EQ(read_bytes(f / "t.exr"), bytes);
}

TEST(SplitSumCommand, KnowsNoErrorBetweenTheCentresOfOneTexel) {
  const Folder f;
  const auto j = gonio(f, "split_sum --size 1x1 --json -o t.exr").json();
  EXPECT_TRUE(j["lookup_error_between_centres"].is_null());
  EXPECT_GT(j["lookup_error"]["e"]["max"], 0.1);
}

TEST(SplitSumCommand, SaysWhatItIsOffByUnderAnEnvironment) {
  GONIO_NEEDS_SHARED(map, "data/env/studio.exr");
  const Folder f;
  const std::string words = "split_sum --environment '" + map +
                            "' --roughness 0.5 --nov 0.3,1 --f0 0.04,1 --views 4 --json";
  const auto o = gonio(f, words);
  ASSERT_EQ(o.code, 0) << o.err;
  const auto j = o.json();
  EXPECT_EQ(j["width"], 1024);
  EXPECT_EQ(j["negative_values"], 3);
  ASSERT_EQ(j["rows"].size(), 4U);
  for (const auto& row : j["rows"]) {
    EXPECT_LE(row["truth_error"], 2e-3);
    EXPECT_GT(row["relative_error"], row["truth_error"]);
    EXPECT_GE(row["max_relative_error"], row["relative_error"]);
    EXPECT_EQ(row["truth"].size(), 3U);
  }
  EXPECT_GT(j["rows"][1]["truth"][0], j["rows"][0]["truth"][0]);  // F0 = 1 and 0.04
  EXPECT_EQ(gonio(f, words + " --jobs 1").json(), j);
  expect_one_line(gonio(f, "split_sum --environment '" + map + "' --roughness 0.5 --nov 1e-300"), 3,
                  "nov = 1e-300");
}

TEST(SplitSumCommand, NamesTheUnitsOfWhatIsLostUnderAnEnvironment) {
  const Folder f;
  f.write("sky.exr", even_sky(f / "sky.exr", 0.5F));
  const auto o = gonio(f, "split_sum --environment sky.exr --roughness 0.5 --nov 0.3 --views 2");
  ASSERT_EQ(o.code, 0) << o.err;
  for (const char* words : {"unit of radiance", "in % of the truth", "rms [%]", "bias [%]"})
    EXPECT_NE(o.out.find(words), std::string::npos) << o.out;
  const auto row =
      gonio(f, "split_sum --environment sky.exr --roughness 0.5 --nov 0.3 --views 2 --json")
          .json()["rows"][0];
  char percent[16];
  std::snprintf(percent, sizeof percent, "%.2f", 100 * row["relative_error"].get<double>());
  EXPECT_NE(o.out.find(percent), std::string::npos) << o.out;
}

TEST(SplitSumCommand, RefusesWhatItCannotDo) {
  const Folder f;
  expect_one_line_each(f, 2,
                       {{"split_sum --roughness 0.5 --nov 0", "outside (0, 1]"},
                        {"split_sum --roughness 0.5,1.5 --nov 1", "outside"},
                        {"split_sum --roughness 0.5 --nov 1 --masking smith", "smith"},
                        {"split_sum --roughness 0.5 --nov 1 --samples 0", "samples"},
                        {"split_sum --roughness 0.5", "--nov"},
                        {"split_sum", "--size"},
                        {"split_sum --size 8x8", "-o"},
                        {"split_sum --size 8x8 -o t.exr --nov 1", "or --size"}});
  for (const char* size : {"8", "8x", "x8", "8x8x8", "-8x8", "0x8", "8x5000", "8×8"})
    expect_one_line(gonio(f, std::string("split_sum -o t.exr --size ") + size), 2, "8");
  expect_one_line(gonio(f, "split_sum --size 8x8 --precision double -o t.exr"), 2, "precision");
  expect_one_line(gonio(f, "split_sum --size 8x8 --error 0 -o t.exr"), 2, "--error");
  expect_one_line(gonio(f, "split_sum --size 8x8 -o none/t.exr"), 3, "none/t.exr");
  expect_one_line(gonio(f, "split_sum --roughness 0.1 --nov 1e-300"), 3, "nov = 1e-300");
  for (const char* word : {"--precision half", "--f0 0.5", "--views 3"})
    expect_one_line(gonio(f, std::string("split_sum --roughness 0.5 --nov 1 ") + word), 2,
                    std::string(word).substr(0, 4));
  for (const char* word : {"--f0 0.5", "--views 3"})
    expect_one_line(gonio(f, std::string("split_sum --size 8x8 -o t.exr ") + word), 2,
                    "--environment");
  EXPECT_EQ(f.entries(), 0U);
  const std::string light = "split_sum --roughness 0.5 --nov 1 --environment ";
  expect_one_line(gonio(f, light + "none.exr"), 3, "none.exr");
  ASSERT_EQ(gonio(f, "split_sum --size 8x4 --samples 1 -o two.exr").code, 0);
  expect_one_line(gonio(f, light + "two.exr"), 3, "B among them");
  expect_one_line_each(f, 2,
                       {{light + "none.exr --f0 0", "f0 = 0 is outside [0.02, 1]"},
                        {light + "none.exr --samples 8", "--samples"},
                        {light + "none.exr --precision half", "--precision"},
                        {"split_sum --size 8x8 -o t.exr --environment none.exr", "--size"}});
}

}  // namespace
}  // namespace gonio::test
