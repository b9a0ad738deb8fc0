#pragma once
// Loops of oneTBB on the one thread that a page has.

namespace tbb {

struct task_group_context {
  enum kind { isolated, bound };
  task_group_context(kind = bound) {}
};

template <class I, class Body>
void parallel_for(I first, I last, const Body& body, task_group_context&) {
  for (I i = first; i < last; ++i) body(i);
}

}  // namespace tbb
