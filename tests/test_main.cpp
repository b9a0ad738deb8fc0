#include <cstdio>
#include <string>
#include <string_view>

#include "support.h"

#include <gtest/gtest.h>

namespace gonio::test {

std::string project_folder() {
  return GONIO_SOURCE_DIR;
}

}  // namespace gonio::test

namespace {

// The filter that takes only the tests of a file, by the end of its path.
std::string tests_of(std::string_view file) {
  std::string filter;
  const auto& all = *testing::UnitTest::GetInstance();
  for (int s = 0; s < all.total_test_suite_count(); ++s) {
    const auto& suite = *all.GetTestSuite(s);
    for (int t = 0; t < suite.total_test_count(); ++t) {
      const auto& test = *suite.GetTestInfo(t);
      if (std::string_view(test.file()).ends_with(file)) {
        filter += std::string(suite.name()) + '.' + test.name() + ':';
      }
    }
  }
  return filter;
}

}  // namespace

// As every program of GoogleTest; `--file=FOLDER/NAME_test.cpp` runs the tests of that file in one
// process, which computes once what they share.
int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  constexpr std::string_view option = "--file=";
  if (argc == 2 && std::string_view(argv[1]).starts_with(option)) {
    const auto filter = tests_of(std::string_view(argv[1]).substr(option.size()));
    if (filter.empty()) {
      std::fprintf(stderr, "%s: no test is in a file of that name\n", argv[1]);
      return 2;
    }
    testing::GTEST_FLAG(filter) = filter;
  }
  return RUN_ALL_TESTS();
}
