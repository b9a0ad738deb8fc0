#include "base/names.h"

#include <string>

#include "base/error.h"
#include "refusal.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

enum class Colour { red, dark_green };
enum class Unnamed { one };

}  // namespace

template <>
inline constexpr std::array<std::string_view, 2> names_of<Colour>{"red", "dark green"};

namespace {

TEST(Names, LeadFromAValueToItsNameAndBack) {
  static_assert(name_of(Colour::dark_green) == "dark green");
  static_assert(find_value<Colour>("dark green") == Colour::dark_green);
  static_assert(!find_value<Colour>("dark_green"));
  static_assert(!Named<Unnamed> && !Named<int>);
  EXPECT_EQ(value_of<Colour>("red", "colour"), Colour::red);
}

TEST(Names, ThatThereAreNotAreWrongUsage) {
  EXPECT_EQ(test::refusal([] { value_of<Colour>("rad", "colour"); }, Exit::usage),
            "no colour 'rad'; nearest: red, dark green");
}

}  // namespace
}  // namespace gonio
