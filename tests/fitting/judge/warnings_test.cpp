// What a reader must know before believing the numbers is said, and nothing else.
#include "fitting/judge/warnings.h"

#include <algorithm>

#include "fitting/fit.h"
#include "fitting/support.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

FitResult fit_synthetic(const char* model, const std::string& settings, const SynthOptions& s) {
  FitOptions o;
  o.model = model;
  return fit(synthesize(test::bind(model, settings, 3), s), o);
}

TEST(Warnings, SaysThatThePeakIsNotResolved) {
  const auto warned = [](const std::string& alpha) {
    const auto d = fit_synthetic("lambert+ggx/smith_ggx.correlated/schlick", alpha + ",kd=0.1",
                                 {.layout = Layout::mbsdf, .noise = 0.02})
                       .document;
    return std::ranges::any_of(d.warnings, [](const std::string& w) {
      return w.starts_with("the table does not resolve its highlight");
    });
  };
  EXPECT_TRUE(warned("alpha=0.01"));
  EXPECT_FALSE(warned("alpha=0.3"));
}

TEST(Warnings, SaysThatWhatIsLeftIsMoreThanNoise) {
  const auto warned = [](const char* model) {
    const auto table = synthesize(
        bind_model("lambert+gtr/smith_ggx.correlated/schlick",
                   parse_settings(std::vector<std::string>{"alpha=0.3,gamma=1.3,f0=0.05,kd=0.2"}),
                   1),
        {.layout = Layout::in_plane, .noise = 0.005});
    FitOptions o;
    o.model = model;
    const auto d = fit(table, o).document;
    return std::ranges::any_of(d.warnings, [](const std::string& w) {
      return w.starts_with("the model misses the table by");
    });
  };
  EXPECT_TRUE(warned("lambert+ggx/smith_ggx.correlated/schlick"));
  EXPECT_FALSE(warned("lambert+gtr/smith_ggx.correlated/schlick"));
}

TEST(Warnings, SaysWhenTheModelDoesNotDescribeTheTable) {
  const char *metal = "ggx/smith_ggx.correlated/schlick", *settings = "alpha=0.3,f0=0.95,0.64,0.54";
  const Table t = synthesize(test::bind(metal, settings, 3), {.layout = Layout::random});
  FitOptions o;
  o.model = "lambert";
  const auto d = fit(t, o).document;
  ASSERT_FALSE(d.warnings.empty());
  EXPECT_TRUE(d.warnings[0].starts_with("the model misses the table by more than half"));
  EXPECT_TRUE(fit_synthetic(metal, settings, {.layout = Layout::random}).document.warnings.empty());
}

TEST(Warnings, EnoughAnglesAreEight) {
  EXPECT_TRUE(enough_angles(8));
  EXPECT_FALSE(enough_angles(7));
}

}  // namespace
}  // namespace gonio
