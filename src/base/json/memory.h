#pragma once
/// \file
/// Memory of several documents together.

#include <cstddef>

namespace gonio {

/// While one lives, the values of documents that its thread parses count to an amount: all that were counted to it take at most what
/// those of one document may.
class CountedJson {
 public:
  explicit CountedJson(std::size_t& bytes);
  ~CountedJson();
  CountedJson(const CountedJson&) = delete;
  CountedJson& operator=(const CountedJson&) = delete;

 private:
  std::size_t* before_;
};

}  // namespace gonio
