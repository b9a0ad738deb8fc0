#include "reports/picture/indices.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

std::string marked(std::string_view text) {
  return with_indices(text, "<", ">");
}

TEST(WithIndices, SetsTheLetterAfterAnAngleLow) {
  EXPECT_EQ(marked("θ_i [°], φ_o and dω_o"), "θ<i> [°], φ<o> and dω<o>");
  EXPECT_EQ(marked("θ_h"), "θ<h>");
}

TEST(WithIndices, LeavesNamesAndLongerWordsAlone) {
  for (const auto* text : {"theta_i", "F_0", "θ_diff", "θ_", "θ _i", "_i", ""})
    EXPECT_EQ(marked(text), text);
}

}  // namespace
}  // namespace gonio
