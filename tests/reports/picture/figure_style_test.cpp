#include "reports/picture/figure_style.h"

#include "reports/page/assets.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace gonio {
namespace {

TEST(PaperColours, AreThoseOfThePageInItsLightScheme) {
  const auto light = assets::page_css.substr(0, assets::page_css.find('}'));
  FigureMap from_0, about_0;
  about_0.diverging = true;
  std::vector<std::string_view> names{"ink", "accent", "red", "green", "extra", "grey", "warn"};
  for (const auto* m : {&from_0, &about_0})
    for (const auto name : colours_of(*m)) names.push_back(name);
  for (const auto name : names)
    EXPECT_NE(light.find(fmt::format("--{}: {};", name, paper_colour(name))), light.npos) << name;
}

}  // namespace
}  // namespace gonio
