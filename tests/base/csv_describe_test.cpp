#include "base/csv_describe.h"

#include <limits>
#include <optional>

#include <gtest/gtest.h>

namespace gonio {

struct Line {
  std::string name;
  double x;
  std::optional<bool> known;
};
template <>
struct Description<Line> {
  static constexpr auto fields() {
    return FieldList{field("name", "", &Line::name, ""), field("x", "", &Line::x, ""),
                     field("known", "", &Line::known, "")};
  }
};

namespace {

TEST(CsvOf, HasALineForEachStructUnderItsKeys) {
  const std::vector<Line> lines{{"a,b", 1234567.5, true},
                                {"c", std::numeric_limits<double>::quiet_NaN(), {}}};
  EXPECT_EQ(csv_of(lines, Digits::six), "name,x,known\n\"a,b\",1.23457e+06,true\nc,,\n");
  EXPECT_EQ(csv_of(lines), "name,x,known\n\"a,b\",1234567.5,true\nc,,\n");
}

}  // namespace
}  // namespace gonio
