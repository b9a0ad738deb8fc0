#include "base/nearest_names.h"

#include <array>
#include <string>

#include "base/error.h"
#include "refusal.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

constexpr std::array<std::string_view, 5> known{"beckmann", "ggx", "gtr", "blinn_phong", "gtr1"};

std::string refusal(std::string_view name) {
  return test::refusal([&] { refuse_name(name, known, "distribution"); }, Exit::usage);
}

TEST(NearestNames, AreThoseThatFewestChangedLettersLeadTo) {
  EXPECT_EQ(refusal("ggy"), "no distribution 'ggy'; nearest: ggx, gtr, gtr1");
  EXPECT_EQ(refusal("bekman"), "no distribution 'bekman'; nearest: beckmann, ggx, gtr");
}

TEST(NearestNames, OfATextThatIsNoNameAreFoundAtOnceAndItIsToldInPart) {
  const auto line = refusal(std::string(10'000'000, 'g'));
  EXPECT_LT(line.size(), 200U);
  EXPECT_NE(line.find("ggg…'"), std::string::npos) << line;
}

}  // namespace
}  // namespace gonio
