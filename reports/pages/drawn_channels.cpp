#include "reports/pages/drawn_channels.h"

#include <algorithm>
#include <string>

namespace gonio {

std::vector<std::size_t> drawn_channels(std::size_t all, std::size_t most) {
  std::vector<std::size_t> drawn;
  const std::size_t n = std::min(all, most);
  for (std::size_t k = 0; k < n; ++k) drawn.push_back(n == all ? k : k * (all - 1) / (n - 1));
  return drawn;
}

std::optional<Table> of_drawn_channels(const Table& t) {
  const auto drawn = drawn_channels(t.values.size());
  if (drawn.size() == t.values.size()) return {};
  Table few = t;
  few.channels.clear(), few.values.clear(), few.errors.clear();
  for (const std::size_t c : drawn) {
    few.channels.push_back(t.channels[c]);
    few.values.push_back(t.values[c]);
    if (!t.errors.empty()) few.errors.push_back(t.errors[c]);
  }
  return few;
}

BoundModel of_drawn_channels(const BoundModel& b) {
  const auto drawn = drawn_channels(b.model.channels);
  if (drawn.size() == b.model.channels) return b;
  std::vector<std::string> grey;
  for (const auto& q : b.model.parameters)
    if (q.about->per_channel && q.count == 1) grey.push_back(q.name);
  BoundModel few{compose(b.model.spec, drawn.size(), grey), {}, b.given};
  few.model.held = b.model.held;
  few.values.resize(few.model.value_count);
  for (const auto& q : few.model.parameters)
    for (std::size_t c = 0; c < q.count; ++c)
      few.values[q.slot(c)] = b.values[b.model.find(q.name)->slot(drawn[c])];
  return few;
}

}  // namespace gonio
