#include "shader/program.h"

#include <gtest/gtest.h>

namespace gonio::shader {
namespace {

std::size_t of(const Instructions& i, std::string_view kind) {
  for (std::size_t k = 0; k < Instructions::kinds.size(); ++k)
    if (Instructions::kinds[k] == kind) return i.by_kind[k];
  ADD_FAILURE() << kind;
  return 0;
}

/// An instruction of so many words.
void put(std::vector<std::uint32_t>& words,
         std::uint32_t operation,
         std::uint32_t length,
         std::uint32_t extended = 0) {
  words.push_back(length << 16U | operation);
  words.resize(words.size() + length - 1);
  if (length > 4) words[words.size() - length + 4] = extended;
}

TEST(Instructions, AreCountedByKindWithinFunctions) {
  std::vector<std::uint32_t> words(5);
  put(words, 43, 4);  // OpConstant: of no function
  put(words, 54, 5);  // OpFunction
  put(words, 248, 2);
  put(words, 129, 5);
  put(words, 131, 5);
  put(words, 142, 5);
  put(words, 12, 6, 31);  // sqrt
  put(words, 12, 7, 40);  // max
  put(words, 184, 5);     // OpFOrdLessThan
  put(words, 169, 6);
  put(words, 62, 3);  // OpStore
  put(words, 56, 1);
  put(words, 129, 5);  // beyond its end
  const auto i = count_instructions(words);
  EXPECT_EQ(of(i, "add"), 2U);
  EXPECT_EQ(of(i, "mul"), 1U);
  EXPECT_EQ(of(i, "sqrt"), 1U);
  EXPECT_EQ(of(i, "min_max"), 1U);
  EXPECT_EQ(of(i, "compare"), 1U);
  EXPECT_EQ(of(i, "select"), 1U);
  EXPECT_EQ(of(i, "other"), 1U);
  EXPECT_EQ(i.arithmetic(), 7U);
}

TEST(Instructions, OfABrokenModuleEndWithIt) {
  std::vector<std::uint32_t> words(5);
  put(words, 54, 5);
  put(words, 129, 5);
  words.push_back(129);  // no length
  EXPECT_EQ(count_instructions(words).arithmetic(), 1U);
  words.back() = 9U << 16U | 129U;  // longer than what is there
  EXPECT_EQ(count_instructions(words).arithmetic(), 1U);
  EXPECT_EQ(count_instructions({}).arithmetic(), 0U);
}

/// As many as the graph has: a compiler shares nothing more, and `precise` lets it regroup nothing.
TEST(Instructions, OfATermAreItsOperations) {
  for (const char* id : {"lambert", "disney"}) {
    const auto f = trace_model(bind_model(id, {}, 1), Precision::float_, {}, {});
    const auto i = compiled_instructions(f);
    if (!i)
      GTEST_SKIP() << "glslangValidator or spirv-opt is not there: run ./check, which installs it";
    const auto o = f.operations();
    EXPECT_EQ(of(*i, "add"), o[Operation::add]) << id;
    EXPECT_EQ(of(*i, "mul"), o[Operation::mul]) << id;
    EXPECT_EQ(of(*i, "div"), o[Operation::div]) << id;
    EXPECT_EQ(of(*i, "sqrt"), o[Operation::sqrt]) << id;
  }
}

}  // namespace
}  // namespace gonio::shader
