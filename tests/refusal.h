#pragma once
/// \file
/// Words that a refused call is told with.

#include <string>

#include "base/error.h"

#include <gtest/gtest.h>

namespace gonio::test {

/// The one line that a call is refused with; "" where it is not.
template <class Call>
std::string refusal(Call&& call, Exit code = Exit::bad_input) {
  try {
    call();
    return "";
  } catch (const Error& e) {
    std::string line = e.what();
    EXPECT_EQ(e.code(), code) << line;
    EXPECT_EQ(line.find('\n'), line.npos) << line;
    return line;
  } catch (const NameTaken& e) {
    EXPECT_EQ(code, Exit::usage) << e.what();
    return e.what();
  }
}

#define EXPECT_HAS(text, part) EXPECT_PRED_FORMAT2(testing::IsSubstring, part, text)

}  // namespace gonio::test
