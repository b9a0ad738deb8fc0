#include "base/text.h"

#include "support.h"

namespace gonio {
namespace {

TEST(Split, GivesEveryPartEmptyOnesIncluded) {
  using Parts = std::vector<std::string>;
  EXPECT_EQ(split("a,bc,d", ','), (Parts{"a", "bc", "d"}));
  EXPECT_EQ(split(",a,,", ','), (Parts{"", "a", "", ""}));
  EXPECT_EQ(split("a,b", '+'), Parts{"a,b"});
  EXPECT_EQ(split("", ','), Parts{""});
}

}  // namespace
}  // namespace gonio
