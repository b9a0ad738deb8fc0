// What a sample of a stack's texels says of its directions, its model and its images.
#include "fitting/map/survey.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

#include "fitting/map/arrangement.h"
#include "fitting/map/stack.h"
#include "fitting/map/stacks.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

using namespace test;
using MadeUp = test::Stack;
using Loud = test::Noise;

constexpr unsigned seeds = 20;

MadeUp made_up(unsigned seed,
               Loud noise = Loud::relative,
               std::size_t images = 24,
               const std::string& model = "lambert+ggx/smith_ggx.correlated/schlick") {
  StackOptions o;
  o.model = model;
  o.texels = 96;
  o.images = images;
  o.noise = noise;
  o.sigma = noise == Loud::relative ? 0.02 : 0.003;
  o.seed = seed;
  o.gamma = 1.4;
  return stack(o);
}

StackSurvey look(const MadeUp& s, Metric metric = Metric::l2_cosine) {
  TexelOptions o;
  o.metric = metric;
  return survey(s.samples(), o);
}

/// Light or view of all images becomes another.
void change(std::vector<float>& directions, const std::function<void(float& x, float& y)>& by) {
  for (std::size_t i = 0; i + 2 < directions.size(); i += 3) by(directions[i], directions[i + 1]);
}

TEST(Survey, SaysNothingOfAStackThatIsAsItSays) {
  for (unsigned seed = 1; seed <= seeds; ++seed)
    for (const auto noise : {Loud::none, Loud::relative, Loud::of_light})
      for (const std::size_t images : {10, 24}) {
        if (seed % 4 != images % 4 && !std::getenv("GONIO_LONG")) continue;
        const auto found = look(made_up(seed, noise, images));
        SCOPED_TRACE(testing::Message() << seed << " " << static_cast<int>(noise) << " " << images);
        EXPECT_EQ(found.arrangement.what, "") << found.arrangement.ratio;
        EXPECT_EQ(found.better, "") << found.better_ratio;
        EXPECT_FALSE(found.seeks_normals || found.tone);
        EXPECT_EQ(found.shared, 0);
        EXPECT_TRUE(found.odd.empty()) << found.odd[0].image << " " << found.odd[0].ratio;
        EXPECT_FALSE(std::isnan(found.noise.most));
      }
}

TEST(Survey, SaysNothingOfRightStacksOfAnyModelNoiseAndNumberOfImages) {
  int looked = 0, accused = 0;
  for (const char* model :
       {"lambert+ggx/smith_ggx.correlated/schlick", "lambert+gtr/smith_ggx.correlated/schlick",
        "oren_nayar+ggx/smith_ggx.correlated/schlick",
        "lambert+beckmann/smith_beckmann.correlated/schlick",
        "lambert+ggx_aniso/smith_ggx_aniso.correlated/schlick", "lambert", "eon"})
    for (const auto noise : {Loud::none, Loud::relative, Loud::of_light})
      for (const std::size_t images : {6, 10, 24})
        for (unsigned seed = 1; seed <= (std::getenv("GONIO_LONG") ? seeds : 1); ++seed) {
          const auto s = made_up(seed, noise, images, model);
          TexelOptions o;
          o.model = model;
          const auto found = survey(s.samples(), o);
          ++looked;
          const bool is_accused = found.shared > 0 || !found.odd.empty() || !found.better.empty() ||
                                  found.seeks_normals || found.tone ||
                                  !found.arrangement.what.empty();
          accused += is_accused;
          if (is_accused)
            std::cout << model << " noise " << static_cast<int>(noise) << " images " << images
                      << " seed " << seed << ": shared " << found.shared << " odd "
                      << found.odd.size() << " better " << found.better << " " << found.better_ratio
                      << " arr " << found.arrangement.what << "\n";
        }
  EXPECT_LE(100 * accused, looked) << accused;
}

TEST(Survey, BlamesTheModelAndNotTheDirectionsForAMatteSurface) {
  for (const char* model : {"lambert", "oren_nayar"})
    for (unsigned seed = 1; seed <= 4; ++seed) {
      const auto found = look(made_up(seed, Loud::relative, 24, model));
      EXPECT_EQ(found.arrangement.what, "") << model << seed << " " << found.arrangement.ratio;
      EXPECT_NE(found.better, "") << model << seed;
    }
}

/// Photographs from above, of lamps at so many heights.
gonio::Stack dome(
    const Folder& f, int step_deg, int heights, double noise, const std::string& normals = "") {
  StackSynthOptions o;
  o.noise = noise;
  o.values = StackValues::f_r_cosine;
  if (!normals.empty()) o.normals = normals;
  o.directions = DirectionList{};
  for (int k = 0; k < 24; ++k) {
    o.directions->theta_i_deg.push_back(10 + step_deg * (k % heights));
    o.directions->phi_i_deg.push_back(67 * k % 360);
    o.directions->theta_o_deg.push_back(0);
    o.directions->phi_o_deg.push_back(0);
  }
  return read_stack(known_stack(f, "s", o));
}

TEST(Survey, SaysNothingOfADomeOfFewHeights) {
  const Folder f;
  const auto found = survey(StackReader(dome(f, 20, 4, 0.02)), {});
  EXPECT_EQ(found.arrangement.what, "") << found.arrangement.ratio;
  EXPECT_EQ(found.better, "") << found.better_ratio;
  EXPECT_TRUE(found.odd.empty());
}

TEST(Survey, FindsDirectionsThatAreNotTheImagesOwn) {
  const auto negated = [](float&, float& y) { y = -y; };
  const auto exchanged = [](float& x, float& y) { std::swap(x, y); };
  const auto quarter = [](float& x, float& y) {
    std::swap(x, y);
    x = -x;
  };
  for (unsigned seed = 1; seed <= (std::getenv("GONIO_LONG") ? seeds : 4); ++seed) {
    const MadeUp right = made_up(seed);
    const auto expect = [&](MadeUp s, const char* what) {
      const auto found = look(s).arrangement;
      EXPECT_TRUE(found.sure) << seed << " " << what << ": " << found.ratio;
      EXPECT_NE(found.what.find(what), std::string::npos) << seed << " " << found.what;
    };
    for (const auto which : {&MadeUp::light, &MadeUp::view}) {
      MadeUp s = right;
      change(s.*which, negated);
      expect(s, "negated");
      s = right;
      change(s.*which, exchanged);
      expect(s, "exchanged");
      s = right;
      change(s.*which, quarter);
      expect(s, "quarter");
    }
    // Values of another image under each pair of directions.
    const std::size_t run = right.texels * 3;
    const auto ordered = [&](const std::vector<std::size_t>& order) {
      MadeUp s = right;
      for (std::size_t i = 0; i < s.images; ++i)
        std::copy_n(right.values.begin() + static_cast<std::ptrdiff_t>(order[i] * run), run,
                    s.values.begin() + static_cast<std::ptrdiff_t>(i * run));
      return s;
    };
    std::vector<std::size_t> order(right.images);
    std::iota(order.rbegin(), order.rend(), std::size_t{0});
    expect(ordered(order), "reverse");
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::rotate(order, order.begin() + 1);
    expect(ordered(order), "place early");
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [](std::size_t i) { return std::to_string(i + 1); });
    expect(ordered(order), "as words");
  }
}

TEST(Survey, SaysNothingOfAMirrorImageThatChangesNoValue) {
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    MadeUp s = made_up(seed);
    for (const auto which : {&MadeUp::light, &MadeUp::view})
      change(s.*which, [](float&, float& y) { y = -y; });
    EXPECT_EQ(look(s).arrangement.what, "") << seed;
  }
}

TEST(Survey, NamesAModelThatFitsBetter) {
  const unsigned few = std::getenv("GONIO_LONG") ? seeds : 4;
  for (unsigned seed = 1; seed <= few; ++seed) {
    const auto s = made_up(seed, Loud::relative, 64, "lambert+gtr/smith_ggx.correlated/schlick");
    EXPECT_NE(look(s, Metric::log).better, "") << seed;
    EXPECT_FALSE(look(s, Metric::log).tone) << seed;
  }
}

TEST(Survey, KnowsTheNoiseOfTheRightModelAndTheMisfitOfAWrongOne) {
  const auto part = [](const MadeUp& s, const std::string& model) {
    TexelOptions o;
    o.model = model;
    o.metric = Metric::log;
    const auto found = survey(s.samples(), o);
    const auto misfit = misfit_of(fit_texels(s.samples(), o), found.noise);
    return static_cast<double>(std::ranges::count_if(misfit, [](float m) { return m > 1; })) /
           static_cast<double>(s.texels);
  };
  double right = 0, wrong = 0;
  const unsigned few = std::getenv("GONIO_LONG") ? seeds : 4;
  for (unsigned seed = 1; seed <= few; ++seed) {
    const auto s = made_up(seed, Loud::relative, 64, "lambert+gtr/smith_ggx.correlated/schlick");
    right += part(s, "lambert+gtr/smith_ggx.correlated/schlick") / few;
    wrong += part(s, "lambert+ggx/smith_ggx.correlated/schlick") / few;
  }
  EXPECT_LE(right, 0.02);
  EXPECT_GE(wrong, 0.95);
}

TEST(Survey, NamesAnImageWhoseLampWasOffAndOneOfAnotherPlace) {
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    const MadeUp right = made_up(seed);
    const std::size_t run = right.texels * 3, image = seed % right.images;
    MadeUp s = right;
    for (std::size_t k = 0; k < run; ++k) s.values[image * run + k] *= 0.02F;
    auto found = look(s).odd;
    ASSERT_EQ(found.size(), 1U) << seed;
    EXPECT_EQ(found[0].image, image) << seed;
    EXPECT_NEAR(found[0].brightness, 0.02, 0.01) << seed;
    s = right;  // shifted by some texels
    const auto at = s.values.begin() + static_cast<std::ptrdiff_t>(image * run);
    std::rotate(at, at + 5, at + static_cast<std::ptrdiff_t>(run));
    found = look(s).odd;
    ASSERT_FALSE(found.empty()) << seed;
    EXPECT_EQ(found[0].image, image) << seed;
  }
}

TEST(Survey, LooksPastBlackAndEmptyTexels) {
  const MadeUp right = made_up(1);
  MadeUp s = right;
  const std::size_t lit = 40;  // of 96
  for (std::size_t row = 0; row < s.images * 3; ++row)
    for (std::size_t t = lit; t < s.texels; ++t)
      s.values[row * s.texels + t] = t % 2 ? 0 : std::nanf("");
  EXPECT_EQ(look(s).arrangement.what, "");
  change(s.light, [](float&, float& y) { y = -y; });
  EXPECT_TRUE(look(s).arrangement.sure);
  s = right;
  for (std::size_t k = 0; k < s.texels * 3; ++k) s.values[5 * s.texels * 3 + k] *= 0.02F;
  for (std::size_t row = 0; row < s.images * 3; ++row)
    for (std::size_t t = lit; t < s.texels; ++t) s.values[row * s.texels + t] = std::nanf("");
  const auto odd = look(s).odd;
  ASSERT_EQ(odd.size(), 1U);
  EXPECT_EQ(odd[0].image, 5U);
}

TEST(Survey, OfFewTexelsOrImagesKnowsNothing) {
  MadeUp s = made_up(1);
  s.texels = 96;
  std::fill(s.values.begin(), s.values.end(), std::nanf(""));
  EXPECT_EQ(look(s).texels, 0U);
  EXPECT_TRUE(std::isnan(look(made_up(1, Loud::none, 2)).noise.most));
}

/// A map of normals with none in it.
Image without_normals() {
  Image normals;
  normals.width = map_width;
  normals.height = map_height;
  normals.channels = {"X", "Y", "Z"};
  normals.planes.resize(3);
  return normals;
}

/// Photographs of a surface of these slopes, given without its normals.
/// \param slopes  along x and along y, of a texel's column and row
template <class Slopes>
gonio::Stack photographs(const Folder& f, Slopes&& slopes) {
  Image normals = without_normals();
  for (std::size_t t = 0; t < map_width * map_height; ++t) {
    const auto [p, q] =
        slopes(static_cast<float>(t % map_width), static_cast<float>(t / map_width));
    const float z = 1 / std::sqrt(1 + p * p + q * q);
    normals.planes[0].push_back(-p * z);
    normals.planes[1].push_back(-q * z);
    normals.planes[2].push_back(z);
  }
  write_exr(f / "n.exr", normals);
  auto stack = dome(f, 12, 5, 0.01, f / "n.exr");
  stack.normals.reset();
  return stack;
}

/// \param turn  of their phase from one texel to the next   \param steep  slope
gonio::Stack waves(const Folder& f, float turn = 0.3F, float steep = 0.2F) {
  return photographs(f, [=](float column, float row) {
    const float u = turn * column, v = -turn / 1.5F * row;
    return std::array{steep * std::cos(u) * std::cos(v), -steep * std::sin(u) * std::sin(v) * 0.7F};
  });
}

TEST(Survey, AsksForNormalsWhereTheSurfaceIsNotFlat) {
  const Folder f;
  const auto stack = waves(f);
  const auto found = survey(StackReader(stack), {});
  EXPECT_TRUE(found.seeks_normals);
  EXPECT_EQ(found.shared, 0);
  const auto lines = warnings_of(found, stack, "m");
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NE(lines[0].find("--refine-normals"), lines[0].npos) << lines[0];
}

TEST(Survey, SaysThatRefinedNormalsBelongToNoSurface) {
  const Folder f;
  auto stack = waves(f);
  TexelOptions o;
  o.refine_normals = true;
  const auto right = survey(StackReader(stack), o);
  EXPECT_EQ(right.arrangement.what, "");
  EXPECT_TRUE(warnings_of(right, stack, "m").empty());
  for (auto& image : stack.images) {
    auto& light = std::get<SideAngles<Side::light>>(image.light);
    light.phi_deg = -light.phi_deg;
  }
  const auto negated = survey(StackReader(stack), o).arrangement;
  EXPECT_TRUE(negated.sure);
  EXPECT_NE(negated.what.find("negated"), negated.what.npos) << negated.what;
  EXPECT_NE(negated.measure.find("curl"), negated.measure.npos);
  for (auto& image : stack.images) {
    auto& light = std::get<SideAngles<Side::light>>(image.light);
    light.phi_deg = std::remainder(-light.phi_deg + 90, 360);
  }
  const auto turned = survey(StackReader(stack), o).arrangement;
  EXPECT_NE(turned.what.find("quarter turn"), turned.what.npos) << turned.what;
}

TEST(Survey, NamesTwoPhotographsWhereAQuarterTurnMayBeAMirrorImage) {
  const Folder f;
  auto stack = photographs(f, [](float column, float row) {  // a bowl
    return std::array{0.02F * (column - 11), -0.02F * (row - 9)};
  });
  TexelOptions o;
  o.refine_normals = true;
  EXPECT_EQ(survey(StackReader(stack), o).arrangement.what, "");
  for (auto& image : stack.images) {
    auto& light = std::get<SideAngles<Side::light>>(image.light);
    light.phi_deg = std::remainder(light.phi_deg + 90, 360);
  }
  const auto turned = survey(StackReader(stack), o).arrangement;
  EXPECT_TRUE(turned.sure);
  ASSERT_EQ(turned.cure.size(), 7U) << turned.what;
  EXPECT_NE(turned.cure[0].find("and then at image_"), std::string::npos) << turned.cure[0];
  // What the list has on the right stands below, and what it has on top on the right.
  EXPECT_TRUE(std::ranges::any_of(turned.cure, [](const std::string& line) {
    return line.starts_with("the lower side, and then the right one: phi_i becomes φ − 90°");
  }));
}

TEST(Survey, SaysSoOfGentleBumpsAndWhereNormalsAreNotAskedForToo) {
  const Folder f;
  for (const bool refined : {true, false}) {
    const auto stack = waves(f, 0.15F, 0.2F);
    TexelOptions o;
    o.refine_normals = refined;
    EXPECT_EQ(survey(StackReader(stack), o).arrangement.what, "");
    auto negated = stack;
    for (auto& image : negated.images) {
      auto& light = std::get<SideAngles<Side::light>>(image.light);
      light.phi_deg = -light.phi_deg;
    }
    const auto found = survey(StackReader(negated), o).arrangement;
    EXPECT_TRUE(found.sure) << refined << " " << found.ratio << " "
                            << survey(StackReader(negated), o).seeks_normals;
    EXPECT_NE(found.what.find("negated"), found.what.npos) << found.what;
  }
}

TEST(Survey, SaysWhetherAzimuthsCouldBeChecked) {
  const Folder f;
  TexelOptions refined;
  refined.refine_normals = true;
  EXPECT_EQ(survey(StackReader(waves(f)), refined).arrangement.azimuth,
            AzimuthCheck::half_turn_open);
  EXPECT_EQ(survey(StackReader(waves(f)), {}).arrangement.azimuth, AzimuthCheck::half_turn_open);
  const Folder flat;
  EXPECT_EQ(survey(StackReader(dome(flat, 20, 4, 0.02)), {}).arrangement.azimuth,
            AzimuthCheck::open);
  EXPECT_EQ(survey(StackReader(dome(flat, 20, 4, 0.02)), refined).arrangement.azimuth,
            AzimuthCheck::open);
  EXPECT_NE(words_of(AzimuthCheck::open).find("could not be checked"), std::string::npos);
}

TEST(Survey, FindsAnglesThatAreMeasuredFromThePlane) {
  const Folder f;
  auto stack = dome(f, 3, 24, 0.01);  // listed by their heights, as in reverse
  for (auto& image : stack.images) {
    auto& light = std::get<SideAngles<Side::light>>(image.light);
    light.theta_deg = 90 - light.theta_deg;
  }
  const auto found = survey(StackReader(stack), {}).arrangement;
  EXPECT_TRUE(found.sure);
  EXPECT_NE(found.what.find("from the plane"), found.what.npos) << found.what;
}

TEST(Survey, SaysInWholeWhatToLookAtBeforeWhatToChange) {
  const Folder f;
  auto stack = waves(f);
  for (auto& image : stack.images) {
    auto& light = std::get<SideAngles<Side::light>>(image.light);
    light.phi_deg = -light.phi_deg;
  }
  const auto text = refusal_of(survey(StackReader(stack), {}).arrangement);
  EXPECT_EQ(text.find("…"), text.npos) << text;
  const auto look = text.find("which side of a bump is bright");
  ASSERT_NE(look, text.npos) << text;
  EXPECT_LT(look, text.find("the right side: phi_i becomes −φ")) << text;
  EXPECT_LT(look, text.find("the left side: phi_i becomes 180° − φ")) << text;
}

TEST(Survey, HearsTheTexelsThatTellAmongIndifferentOnes) {
  // Two in three slope along x, which a mirror image leaves as they are.
  const Folder f;
  Image normals = without_normals();
  for (std::size_t t = 0; t < map_width * map_height; ++t) {
    const float slope = t / map_width % 2 ? 0.3F : -0.3F;
    const bool tells = t % map_width % 3 == 0;
    normals.planes[0].push_back(tells ? 0 : slope);
    normals.planes[1].push_back(tells ? slope : 0);
    normals.planes[2].push_back(std::sqrt(1 - 0.09F));
  }
  write_exr(f / "n.exr", normals);
  auto stack = dome(f, 12, 5, 0.01, f / "n.exr");
  EXPECT_EQ(survey(StackReader(stack), {}).arrangement.what, "");
  for (auto& image : stack.images) {
    auto& light = std::get<SideAngles<Side::light>>(image.light);
    light.phi_deg = -light.phi_deg;
  }
  for (const bool refined : {false, true}) {
    TexelOptions o;
    o.refine_normals = refined;
    const auto found = survey(StackReader(stack), o).arrangement;
    EXPECT_TRUE(found.sure) << refined;
    EXPECT_NE(found.what.find("negated"), found.what.npos) << found.what;
  }
}

TEST(Survey, SaysThatAnAnisotropicModelNeedsNormals) {
  const Folder f;
  TexelOptions o;
  o.model = "lambert+ggx_aniso/smith_ggx_aniso.correlated/schlick";
  const auto stack = waves(f);
  const auto lines = warnings_of(survey(StackReader(stack), o), stack, o.model);
  ASSERT_FALSE(lines.empty());
  EXPECT_NE(lines.back().find("takes the surface for flat"), lines.back().npos) << lines.back();
  const Folder flat;
  const auto right = dome(flat, 12, 5, 0.01);
  EXPECT_TRUE(warnings_of(survey(StackReader(right), o), right, o.model).empty());
}

TEST(Survey, NamesAllImagesThatWereExposedOtherwise) {
  const Folder f;
  const auto right = dome(f, 9, 7, 0.01);
  for (const std::size_t every : {6, 2}) {
    auto stack = right;
    for (std::size_t i = 1; i < 24; i += every) stack.images[i].scale *= 0.5;
    const auto found = survey(StackReader(stack), {});
    SCOPED_TRACE(every);
    EXPECT_GT(found.shared, 0.5);
    ASSERT_TRUE(found.exposure);
    EXPECT_EQ(found.exposure->images.size(), 24 / every);
    EXPECT_EQ(warnings_of(found, stack, "m").size(), 1U);
    if (every == 2) continue;  // either half may be the wrong one
    EXPECT_NEAR(found.exposure->brightness, 0.5, 0.03);
    for (const std::size_t i : found.exposure->images) EXPECT_EQ(i % every, 1U);
  }
}

TEST(Survey, NamesTwoImagesThatStandForEachOther) {
  const Folder f;
  const auto right = dome(f, 9, 7, 0.01);
  for (const std::size_t other : {4, 8, 15}) {
    auto stack = right;
    std::swap(stack.images[3].path, stack.images[other].path);
    const auto found = survey(StackReader(stack), {});
    ASSERT_TRUE(found.exchanged) << other;
    EXPECT_EQ(found.exchanged->first, 3U) << other;
    EXPECT_EQ(found.exchanged->second, other);
    EXPECT_EQ(found.better, "") << other;
    EXPECT_EQ(found.arrangement.what, "") << other;
  }
}

TEST(Survey, TakesWhatNeighboursShareForNoNoise) {
  const Folder f;
  auto stack = dome(f, 9, 7, 0.01);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0.6, 1.6);
  for (auto& image : stack.images) image.scale *= uniform(random);
  const auto found = survey(StackReader(stack), {});
  EXPECT_GT(found.shared, 0.5);
  EXPECT_FALSE(found.exposure);
  const auto lines = warnings_of(found, stack, "m");
  ASSERT_FALSE(lines.empty());
  EXPECT_NE(lines.back().find("no noise"), lines.back().npos) << lines.back();
  const StackReader reader(stack);
  StackPart part;
  reader.read({0, 0, map_width, map_height}, part);
  const auto p = part.piece(0);
  const auto misfit = misfit_of(
      fit_texels({p.texels, part.images, part.channels, p.values, true, p.light, p.view, {}}, {}),
      found.noise);
  EXPECT_GE(std::ranges::count_if(misfit, [](float m) { return m > 1; }),
            9 * std::ssize(misfit) / 10);
}

TEST(Survey, NamesNoOrderOfTheImagesThatOnlyHelps) {
  const Folder f;
  const auto right = dome(f, 9, 7, 0.01);
  std::mt19937 random(3);
  for (int k = 0; k < 2; ++k) {
    auto stack = right;
    for (std::size_t i = stack.images.size(); i-- > 1;)
      std::swap(stack.images[i].path,
                stack.images[std::uniform_int_distribution<std::size_t>(0, i)(random)].path);
    const auto found = survey(StackReader(stack), {});
    EXPECT_EQ(found.arrangement.what, "") << k;
    EXPECT_FALSE(found.exposure) << k;
    EXPECT_FALSE(found.exchanged) << k;
    EXPECT_GT(found.shared, 0.5) << k;
  }
}

TEST(Survey, OfAStackOfFilesIsOfRowsAllOverItAlsoOfLightAndNormals) {
  const Folder f;
  Image normals = without_normals();
  for (std::size_t t = 0; t < map_width * map_height; ++t) {
    const float x = 0.5F * std::sin(0.7F * static_cast<float>(t % map_width)),
                y = 0.5F * std::sin(0.9F * static_cast<float>(t / map_width));
    normals.planes[0].push_back(x);
    normals.planes[1].push_back(y);
    normals.planes[2].push_back(std::sqrt(1 - x * x - y * y));
  }
  write_exr(f / "n.exr", normals);
  StackSynthOptions o;
  o.noise = 0.02;
  o.values = StackValues::f_r_cosine;
  o.normals = f / "n.exr";
  const std::string path = known_stack(f, "s", o);
  const auto right = survey(StackReader(read_stack(path)), {});
  EXPECT_GE(right.texels, 80U);
  EXPECT_EQ(right.arrangement.what, "") << right.arrangement.ratio;
  EXPECT_TRUE(warnings_of(right, read_stack(path), "m").empty());
  EXPECT_EQ(right.arrangement.azimuth, AzimuthCheck::checked);
  // The normals of another convention, whose y points down.
  for (float& y : normals.planes[1]) y = -y;
  write_exr(f / "s/normals.exr", normals);
  const auto wrong = survey(StackReader(read_stack(path)), {});
  EXPECT_TRUE(wrong.arrangement.sure) << wrong.arrangement.ratio;
  EXPECT_NE(wrong.arrangement.what.find("normals' azimuth is negated"), std::string::npos)
      << wrong.arrangement.what;
  EXPECT_EQ(warnings_of(wrong, read_stack(path), "m").size(), 1U);
  TexelOptions refined;
  refined.refine_normals = true;
  EXPECT_TRUE(survey(StackReader(read_stack(path)), refined).arrangement.sure)
      << "refining hides it";
  // The right normals, and lamps by half a turn off: what lies in their shadow is dark all the
  // same.
  for (float& y : normals.planes[1]) y = -y;
  write_exr(f / "s/normals.exr", normals);
  auto stack = read_stack(path);
  for (auto& image : stack.images) {
    auto& light = std::get<SideAngles<Side::light>>(image.light);
    light.phi_deg = light.phi_deg > 0 ? light.phi_deg - 180 : light.phi_deg + 180;
  }
  f.write("s/turned.json", to_json(stack));
  const auto turned = survey(StackReader(read_stack(f / "s/turned.json")), {});
  EXPECT_TRUE(turned.arrangement.sure) << turned.arrangement.ratio;
  EXPECT_NE(turned.arrangement.what.find("half a turn"), std::string::npos)
      << turned.arrangement.what;
}

}  // namespace
}  // namespace gonio
