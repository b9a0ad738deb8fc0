#include "base/options.h"

#include <array>
#include <map>
#include <optional>

#include <gtest/gtest.h>

namespace gonio {
namespace {

enum class Pace { slow, fast };

struct Walk {
  Pace pace = Pace::fast;
  bool back = false, carried = false;
  double metres = 1e7;
  std::optional<unsigned> steps = {};
  std::vector<std::string> places = {};
  int kept = 0;
};

}  // namespace

template <>
inline constexpr std::array<std::string_view, 2> names_of<Pace>{"slow", "fast"};
template <>
inline constexpr auto description<Walk> =
    FieldList{Field{"pace", &Walk::pace, "how fast"},
              Field{"back", &Walk::back, "whether back, too", Either{"there", "back"}},
              Field{"carried", &Walk::carried, "by others"},
              Field{"metres", "m", &Walk::metres, "how far", Numbers{0, 1e7}},
              Field{"steps", &Walk::steps, "how many"},
              Field{"places", &Walk::places, "where"},
              Field{"kept", &Walk::kept, "a member that no call gives", not_asked}};

namespace {

/// Whether words were taken for an option, and the option as a word.
std::pair<bool, std::string> said(const std::string& name, const std::vector<std::string>& words) {
  Walk walk;
  std::pair<bool, std::string> all{false, "no such option"};
  for_each_option(record_of<Walk>, &walk, [&](const RecordField& f, void* value) {
    if (f.name == name)
      all = {set_from_words(*f.type, f.rules, value, words), word_of(*f.type, f.rules, value)};
  });
  return all;
}
using Taken = std::pair<bool, std::string>;

TEST(Options, AreTheFieldsThatACallMayGiveWithTheirDefaultsAsWords) {
  Walk walk;
  std::map<std::string, std::string> defaults;
  for_each_option(record_of<Walk>, &walk, [&](const RecordField& f, const void* value) {
    defaults.emplace(f.name, word_of(*f.type, f.rules, value));
  });
  EXPECT_EQ(defaults, (std::map<std::string, std::string>{{"pace", "fast"},
                                                          {"back", "there"},
                                                          {"carried", "false"},
                                                          {"metres", "10000000"},
                                                          {"steps", ""},
                                                          {"places", ""}}));
}

TEST(Options, TakeTheirOwnWordsOnly) {
  EXPECT_EQ(said("pace", {"slow"}), Taken(true, "slow"));
  EXPECT_EQ(said("pace", {"1"}), Taken(false, "fast"));
  EXPECT_EQ(said("back", {"back"}), Taken(true, "back"));
  EXPECT_EQ(said("back", {"true"}), Taken(false, "there"));
  EXPECT_EQ(said("steps", {"7"}), Taken(true, "7"));
  EXPECT_FALSE(said("steps", {"4294967296"}).first) << "more than the type holds";
  EXPECT_FALSE(said("steps", {"-1"}).first);
  EXPECT_FALSE(said("steps", {"1.5"}).first);
  EXPECT_FALSE(said("pace", {"slow", "fast"}).first) << "two words for one value";
}

TEST(Options, KeepToTheirRangeWhichHoldsNoNan) {
  EXPECT_EQ(said("metres", {"0.25"}), Taken(true, "0.25"));
  for (const char* word : {"-1", "1e8", "nan", "far", ""})
    EXPECT_EQ(said("metres", {word}), Taken(false, "10000000")) << word;
}

TEST(Options, TakeAListInSeveralWords) {
  EXPECT_TRUE(said("places", {"here", "there"}).first);
}

}  // namespace
}  // namespace gonio
