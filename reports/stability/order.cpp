// Forms whose sums and products a compiler regroups: what that costs.
#include "base/whole_loop.h"
#include "reports/stability/measure.h"
#include "reports/stability/stability.h"
#include "stability/answer.h"
#include "stability/regroup.h"
#include "stability/search.h"

namespace gonio {
namespace {

using namespace stability;

std::optional<OrderRow> row_of(Subject s, Number number) {
  stabilities::narrow_to_shaders(s, number);
  const auto cost = regrouping(s, number);
  if (!cost) return {};
  return OrderRow{s.id,
                  std::string(s.form()),
                  std::string(name_of(number)),
                  cost->written,
                  cost->regrouped,
                  cost->at.empty() ? "" : stability::text_of(s, cost->at),
                  cost->no_value,
                  cost->lost,
                  cost->inputs};
}

}  // namespace

bool OrderRow::needs_precise() const {
  const double tolerance = usual_tolerance(*find_value<Number>(number));
  return no_value == 0 && written <= tolerance && (regrouped > tolerance || lost > 0);
}

std::vector<OrderRow> order_rows(const StabilityOptions& o) {
  std::vector<std::pair<Subject, Number>> jobs;
  for (const Number number : {Number::float_, Number::half})
    for (const auto& id : stabilities::forms(o))
      for (auto& s : subjects_of(id)) jobs.emplace_back(std::move(s), number);
  std::vector<std::optional<OrderRow>> found(jobs.size());
  for_each_whole(jobs.size(),
                 [&](std::size_t k) { found[k] = row_of(jobs[k].first, jobs[k].second); });
  std::vector<OrderRow> rows;
  for (auto& row : found)
    if (row) rows.push_back(std::move(*row));
  return rows;
}

}  // namespace gonio
