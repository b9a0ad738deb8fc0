#pragma once
/// \file
/// Tests of so many fits that a sanitizer would take minutes over them.

#include <gtest/gtest.h>

#ifdef __SANITIZE_ADDRESS__
#define GONIO_MANY_FITS() \
  GTEST_SKIP() << "many fits, whose numbers are looked at without a sanitizer"
#else
#define GONIO_MANY_FITS() static_cast<void>(0)
#endif
