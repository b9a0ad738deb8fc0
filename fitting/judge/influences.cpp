#include "fitting/judge/influences.h"

#include <algorithm>
#include <cmath>

#include "fitting/judge/arrow_inverse.h"

namespace gonio {

Influences::Influences(const ArrowMatrix& bread, const std::vector<std::size_t>& determined)
    : layout_(bread.shared_layout()), place_(bread.size(), none) {
  const auto layout = std::make_shared<const ArrowLayout>(layout_->part(determined));
  inverse_ = std::make_shared<const ArrowInverse>(bread.part(layout, determined));
  for (std::size_t k = 0; k < determined.size(); ++k) {
    place_[determined[k]] = k;
    error_.push_back(std::sqrt((*inverse_)(k, k)));
  }
}

Influences::Channel Influences::channel(const std::vector<std::size_t>& free) const {
  Channel c;
  std::vector<std::size_t> moved = layout_->head();
  for (const std::size_t i : free)
    if (layout_->arm(i) != ArrowLayout::none) moved.push_back(i);
  c.row.assign(free.size(), none);
  c.leverage.assign(free.size(), 0);
  for (const std::size_t i : moved) {
    const std::size_t a = place_[i];
    if (a == none) continue;
    auto& beta = c.beta.emplace_back();
    for (std::size_t k = 0; k < free.size(); ++k) {
      const std::size_t b = place_[free[k]];
      beta.push_back(b == none ? 0 : (*inverse_)(a, b) / error_[a]);
      if (free[k] != i) continue;
      c.row[k] = c.unknown.size();
      c.leverage[k] = error_[a];
    }
    c.unknown.push_back(i);
  }
  return c;
}

void Influences::add_others(const std::vector<std::vector<double>>& by_arm,
                            std::vector<double>& fourth) const {
  const auto& head = layout_->head();
  const auto all = fourth;
  for (std::size_t a = 0; a < by_arm.size(); ++a)
    for (const std::size_t i : layout_->arms()[a]) {
      if (place_[i] == none) continue;
      double root = 0;
      std::size_t column = 0;  // of the determined ones in the head
      for (std::size_t h = 0; h < head.size(); ++h) {
        const std::size_t place = place_[head[h]];
        if (place == none) continue;
        const double share =
            std::abs(inverse_->along(place_[i], column++)) * error_[place] / error_[place_[i]];
        root += share * std::pow(std::max(all[head[h]] - by_arm[a][h], 0.0), 0.25);
      }
      fourth[i] += std::pow(root, 4);
    }
}

}  // namespace gonio
