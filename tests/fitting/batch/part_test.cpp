#include "fitting/batch/part.h"

#include <algorithm>
#include <limits>
#include <map>

#include "base/error.h"
#include "refusal.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

using Variables = std::map<std::string, std::string>;

Variable from(const Variables& all) {
  return [all](const char* name) -> std::optional<std::string> {
    const auto at = all.find(name);
    return at == all.end() ? std::nullopt : std::optional(at->second);
  };
}
Variables with(Variables all, const std::string& name, const std::string& value) {
  all[name] = value;
  return all;
}
const Variables third_of_five{
    {"SLURM_ARRAY_TASK_ID", "9"}, {"SLURM_ARRAY_TASK_MIN", "7"}, {"SLURM_ARRAY_TASK_COUNT", "5"}};

TEST(Part, EveryTableIsInOnePartOfAnyNumberOfParts) {
  for (const std::size_t tables : {0, 1, 5, 16, 200})
    for (const std::size_t n : {1, 2, 3, 8, 300}) {
      std::vector<int> parts(tables);
      for (std::size_t k = 1; k <= n; ++k) {
        const auto share = share_of({k, n}, tables);
        EXPECT_TRUE(std::ranges::is_sorted(share));
        EXPECT_LE(share.size(), tables / n + 1) << "no part has more than another by two";
        for (const std::size_t i : share) ++parts.at(i);
      }
      EXPECT_EQ(parts, std::vector<int>(tables, 1)) << tables << " in " << n;
    }
}

TEST(Part, OfMoreThanCanBeCountedEndsToo) {
  constexpr std::size_t most = std::numeric_limits<std::size_t>::max();
  EXPECT_EQ(share_of({2, most}, 3), std::vector<std::size_t>{1});
  EXPECT_EQ(share_of({most, most}, 3), std::vector<std::size_t>{});
}

TEST(Part, IsNamedByTwoNumbers) {
  EXPECT_EQ(part_from("2/4", from({})), (Part{2, 4}));
  EXPECT_EQ(part_from("1/1", from({})), (Part{1, 1}));
  EXPECT_EQ(text_of(Part{2, 4}), "2/4");
}

TEST(Part, OfAnythingElseIsRefused) {
  for (const char* text : {"", "2", "2/", "/4", "2/4/8", "-1/4", "+1/4", "1/-4", "1/+4", "a/b",
                           " 1/4", "1/4 ", "1.5/4", "99999999999999999999/4", "Slurm", "2:4"})
    EXPECT_HAS(test::refusal([&] { part_from(text, from(third_of_five)); }, Exit::usage),
               "expected K/N");
  for (const char* text : {"0/4", "5/4", "1/0", "0/0"})
    EXPECT_HAS(test::refusal([&] { part_from(text, from({})); }, Exit::usage),
               "parts count from 1 to N");
}

TEST(Part, OfAnArrayIsTheTaskCountedFromTheFirst) {
  EXPECT_EQ(part_from("slurm", from(third_of_five)), (Part{3, 5}));
  const auto whole =
      with(with(third_of_five, "SLURM_ARRAY_TASK_STEP", "1"), "SLURM_ARRAY_TASK_MAX", "11");
  EXPECT_EQ(part_from("slurm", from(whole)), (Part{3, 5}));
}

TEST(Part, IsNeverTakenFromTheEnvironmentAlone) {
  EXPECT_EQ(part_from("1/2", from(third_of_five)), (Part{1, 2}));
}

TEST(Part, OfAnArrayWithGapsIsRefused) {
  for (const auto& gaps : {with(third_of_five, "SLURM_ARRAY_TASK_STEP", "2"),
                           with(third_of_five, "SLURM_ARRAY_TASK_STEP", "0"),
                           with(third_of_five, "SLURM_ARRAY_TASK_MAX", "12"),
                           with(third_of_five, "SLURM_ARRAY_TASK_MAX", "6")})
    EXPECT_HAS(test::refusal([&] { part_from("slurm", from(gaps)); }, Exit::usage),
               "the array has gaps");
}

TEST(Part, OutsideOfAnArrayIsRefusedByTheVariableThatIsNotThere) {
  for (const auto& [name, value] : third_of_five) {
    auto less = third_of_five;
    less.erase(name);
    EXPECT_HAS(test::refusal([&] { part_from("slurm", from(less)); }, Exit::usage), "no " + name);
  }
}

TEST(Part, OfVariablesThatAreNoNumbersOrNoTaskIsRefused) {
  for (const auto& [name, value] : third_of_five)
    for (const char* text : {"", "x", "-1", "1.5"})
      EXPECT_HAS(test::refusal([&] { part_from("slurm", from(with(third_of_five, name, text))); },
                               Exit::usage),
                 name + " is '");
  for (const char* id : {"6", "12"})
    EXPECT_HAS(
        test::refusal(
            [&] { part_from("slurm", from(with(third_of_five, "SLURM_ARRAY_TASK_ID", id))); },
            Exit::usage),
        "is none of 5 tasks");
  EXPECT_HAS(
      test::refusal(
          [&] { part_from("slurm", from(with(third_of_five, "SLURM_ARRAY_TASK_COUNT", "0"))); },
          Exit::usage),
      "is none of 0 tasks");
}

}  // namespace
}  // namespace gonio
