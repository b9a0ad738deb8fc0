#include "support.h"

#include <gtest/gtest.h>

namespace gonio::test {

std::string project_folder() {
  return GONIO_SOURCE_DIR;
}

}  // namespace gonio::test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
