// Choice of a map's model by images that fits have not seen.
#include "fitting/map/choose.h"

#include "fitting/map/stacks.h"
#include "refusal.h"

namespace gonio {
namespace {

using namespace test;

std::vector<TriedModel> tried(const std::string& stack, const std::vector<std::string>& models) {
  return try_models(StackReader(read_stack(stack)), {}, models);
}

TEST(TriedModels, BeginWithTheOneThatTheImagesFollow) {
  const Folder f;
  StackSynthOptions noisy;
  noisy.noise = 0.02;
  const std::string stack = known_stack(f, "s", noisy);
  const std::string right = "lambert+ggx/smith_ggx.correlated/schlick";
  const auto found = tried(stack, {"lambert", "oren_nayar", right});
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].model, right);
  EXPECT_GT(found[1].unseen_rms, 2 * found[0].unseen_rms);
  EXPECT_LE(found[1].unseen_rms, found[2].unseen_rms);
}

TEST(TriedModels, ThatAreAlikeStandAsTheyWereNamed) {
  const Folder f;
  StackSynthOptions noisy;
  noisy.width = noisy.height = 24;
  noisy.images = 64;
  noisy.noise = 0.05;
  synthesize_stack(bind_model("lambert", {}, 3), noisy, f / "s");
  const std::string stack = f / "s/stack.json";
  EXPECT_EQ(tried(stack, {"lambert", "oren_nayar"})[0].model, "lambert");
  EXPECT_EQ(tried(stack, {"oren_nayar", "lambert"})[0].model, "oren_nayar");
}

TEST(TriedModels, NeedTexelsThatAllOfThemCanBeComparedAt) {
  const Folder f;
  StackSynthOptions small;
  small.width = small.height = 4;
  synthesize_stack(known_model(), small, f / "s");
  EXPECT_HAS(refusal([&] {
               tried(f / "s/stack.json", {"lambert", "oren_nayar"});
             }),
             "stack.json: images: found 16 texels");
}

}  // namespace
}  // namespace gonio
