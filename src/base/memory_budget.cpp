#include "base/memory_budget.h"

#include <sys/resource.h>
#include <unistd.h>

namespace gonio {

double memory_allowed() {
  const double memory =
      static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
  rlimit r{};
  const bool limited = ::getrlimit(RLIMIT_AS, &r) == 0 && r.rlim_cur != RLIM_INFINITY;
  return limited ? std::min(memory, static_cast<double>(r.rlim_cur)) : memory;
}

}  // namespace gonio
