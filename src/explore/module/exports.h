#pragma once
// What both modules have: functions that a page calls by name, memory for its arguments, and one
// text as the answer to the last call.
#include <cstdlib>
#include <exception>
#include <string>

#define GONIO_EXPORT(name) extern "C" __attribute__((export_name(#name), used))

inline std::string answer;

GONIO_EXPORT(allocate) inline void* page_allocate(std::size_t bytes) {
  return std::aligned_alloc(64, (bytes + 63) / 64 * 64);
}
GONIO_EXPORT(release) inline void page_release(void* p) {
  std::free(p);
}
GONIO_EXPORT(answer) inline const char* page_answer() {
  return answer.c_str();
}
