#include <initializer_list>

#include "integrate/albedo/directional_albedo.h"
#include "integrate/light/split_sum.h"
#include "shaken/seeds.h"

#include <fmt/format.h>

namespace gonio {
namespace {

constexpr double cosines[] = {0.001, 0.05, 0.3, 0.8, 1};

/// From one that leaves most of the error to the rule to one near what sums round off.
constexpr double goals[] = {1e-4, 1e-8, 1e-11};

struct Case {
  const char* model;
  std::vector<std::string> settings;
};
const Case cases[] = {
    {"lambert", {"kd=0.5"}},
    {"ggx/smith_ggx.correlated/schlick", {"alpha=0.0001", "f0=1"}},
    {"ggx/smith_ggx.correlated/schlick", {"alpha=0.01", "f0=1"}},
    {"lambert.coupled+ggx/smith_ggx.correlated/dielectric", {"alpha=0.2", "eta=1.5", "kd=0.5"}},
    {"gtr/smith_ggx.correlated/schlick", {"alpha=0.2", "gamma=1.5", "f0=0.5"}},
    {"beckmann/smith_beckmann.correlated/conductor", {"alpha=0.5", "eta=0.2", "k=3.9"}},
    {"ggx_aniso/smith_ggx_aniso.correlated/schlick", {"alpha_x=0.5", "alpha_y=0.05", "f0=0.9"}},
};

/// Most that integrals of one goal moved, and of their stated errors.
struct Moved {
  double most = 0, of_error = 0;

  void add(const test::Spread& value, const test::Spread& error) {
    most = std::max(most, value.width);
    of_error = std::max(of_error, value.width / error.mean);
  }
  void print(const char* what, double goal) const {
    fmt::print("{} to {}: moved by {:.1e}, {:.1e} of the stated error\n", what, goal, most,
               of_error);
  }
};

TEST(ShakenAlbedo, MovesByAHundredthOfItsStatedErrorAtMost) {
  GONIO_NEEDS_SHAKEN();
  for (const double goal : goals) {
    Moved moved;
    for (const auto& c : cases) {
      const auto model = bind_model(c.model, parse_settings(c.settings), 1);
      const auto all =
          test::by_seed([&] { return directional_albedo(model, cosines, 0.3, {goal}); });
      for (std::size_t i = 0; i < std::size(cosines); ++i)
        moved.add({all, [&](const auto& a) { return a[i].value[0]; }},
                  {all, [&](const auto& a) { return a[i].error; }});
    }
    moved.print("albedos", goal);
    EXPECT_LT(moved.of_error, 0.01);
    EXPECT_GT(moved.most, 0);
  }
}

TEST(ShakenSplitSum, MovesByAHundredthOfItsStatedErrorAtMost) {
  GONIO_NEEDS_SHAKEN();
  for (const double goal : goals) {
    Moved moved;
    for (const char* masking : {"smith_ggx.correlated", "smith_ggx.separable"})
      for (const double roughness : {0.01, 0.1, 0.4, 1.0}) {
        const auto all =
            test::by_seed([&] { return split_sum(masking, roughness, cosines, {goal}); });
        for (std::size_t i = 0; i < std::size(cosines); ++i) {
          const test::Spread error(all, [&](const auto& s) { return s[i].error; });
          moved.add({all, [&](const auto& s) { return s[i].a; }}, error);
          moved.add({all, [&](const auto& s) { return s[i].b; }}, error);
        }
      }
    moved.print("split sums", goal);
    EXPECT_LT(moved.of_error, 0.01);
    EXPECT_GT(moved.most, 0);
  }
}

}  // namespace
}  // namespace gonio
