#include "base/memory.h"

#include <algorithm>
#include <cstdlib>

#include <sys/mman.h>

namespace gonio {

void* allocate_array(std::size_t bytes) {
  constexpr std::size_t huge = std::size_t{1} << 21, line = 64;
  const bool large = bytes >= 2 * huge;
  const std::size_t alignment = large ? huge : line;
  const std::size_t part = large ? huge : line;  // whole pages: the last one is a huge one too
  const std::size_t rounded = (std::max<std::size_t>(bytes, 1) + part - 1) / part * part;
  if (rounded < bytes) throw std::bad_alloc();
  void* p = nullptr;
  if (::posix_memalign(&p, alignment, rounded) != 0) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
  if (large) ::madvise(p, rounded, MADV_HUGEPAGE);  // a wish: it may be refused
#endif
  return p;
}

void free_array(void* p) noexcept {
  std::free(p);
}

}  // namespace gonio
