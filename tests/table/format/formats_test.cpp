// Memory that a table's fit takes is known from its file before it is read.
#include "table/format/formats.h"

#include <string>

#include "support.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

std::string with_channels(int channels) {
  std::string head = "theta_i,theta_o", row = "10,20";
  for (int c = 0; c < channels; ++c) head += ",f_" + std::to_string(c), row += ",1";
  return head + "\n" + row + "\n";
}

TEST(MemoryNeeded, OfATableWithHundredsOfChannelsIsThatOfItsFit) {
  const test::Folder folder;
  const auto times = [&](int channels) {
    const auto text = with_channels(channels);
    return memory_needed(folder.write("t.csv", text)) / static_cast<double>(text.size());
  };
  EXPECT_LT(times(3), 10);
  EXPECT_GT(times(400), 90) << "a value has two bytes in the file, and its fit takes 200";
}

}  // namespace
}  // namespace gonio
