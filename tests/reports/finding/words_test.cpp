#include "reports/finding/words.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

TEST(ListText, SetsAWordBeforeTheLast) {
  EXPECT_EQ(list_text({}), "");
  EXPECT_EQ(list_text({"a"}), "a");
  EXPECT_EQ(list_text({"a", "b"}), "a and b");
  EXPECT_EQ(list_text({"a", "b", "c"}, " or "), "a, b or c");
}

}  // namespace
}  // namespace gonio
