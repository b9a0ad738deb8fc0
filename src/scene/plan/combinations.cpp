#include "scene/plan/combinations.h"

#include <algorithm>

namespace gonio::scene {
namespace {

std::size_t count(const FormsLeft& left) {
  std::size_t n = 1;
  for (const auto& forms : left) n *= forms.size();
  return n;
}

}  // namespace

void thin_out(FormsLeft& left, const std::array<double, effect_count>& ns_saved, std::size_t most) {
  while (count(left) > most) {
    const auto longest = std::ranges::max_element(left, {}, &std::vector<Form>::size);
    if (longest->size() > 2) {
      longest->erase(longest->end() - 2);
      continue;
    }
    std::size_t least = effect_count;
    for (std::size_t e = 0; e < effect_count; ++e)
      if (left[e].size() > 1 && (least == effect_count || ns_saved[e] < ns_saved[least])) least = e;
    left[least] = {left[least].back()};
  }
}

std::vector<Forms> combinations(const FormsLeft& left) {
  std::vector<Forms> all(count(left));
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::size_t rest = i;
    for (std::size_t e = 0; e < effect_count; ++e) {
      all[i].form[e] = left[e][rest % left[e].size()];
      rest /= left[e].size();
    }
  }
  return all;
}

}  // namespace gonio::scene
