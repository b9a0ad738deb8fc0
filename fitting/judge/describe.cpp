#include "fitting/judge/describe.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "brdf/model/roughness.h"

#include <fmt/format.h>

namespace gonio {

std::string name_of(const ModelParameter& p,
                    std::size_t channel,
                    const std::vector<std::string>& channels) {
  return p.count == 1 ? p.name : fmt::format("{}.{}", p.name, channels[channel]);
}

void describe(FitDocument& d,
              const Problem& p,
              std::span<const double> values,
              const Uncertainty& u) {
  for (const auto& q : p.start.model.parameters) {
    FittedParameter e{q.name, {}, {}, {}, {}, {}, {}, {}, {}};
    for (std::size_t s = q.first; s < q.first + q.count; ++s) {
      double value = values[s], error = not_known, low = not_known, high = not_known,
             limit = not_known, excluded = not_known;
      std::string reason;
      auto status = ParameterStatus::fixed;
      if (p.free.mask()[s]) {
        const ParameterVerdict& v = u[p.free.index(s)];
        status = v.status;
        error = v.std_error;
        low = v.low_end(value);
        high = v.high_end(value);
        limit = v.limit;
        reason = v.reason;
        if (status == ParameterStatus::not_identifiable) value = error = not_known;
        if (status == ParameterStatus::upper_limit && value > limit) std::swap(excluded, value);
      }
      e.value.push_back(value);
      e.std_error.push_back(error);
      e.ci95_low.push_back(std::max(low, q.about->legal.low));
      e.ci95_high.push_back(std::min(high, q.about->legal.high));
      if (std::isnan(error)) e.ci95_low.back() = e.ci95_high.back() = not_known;
      e.status.push_back(status);
      e.limit.push_back(limit);
      e.excluded.push_back(excluded);
      e.reason.push_back(std::move(reason));
    }
    d.parameters.push_back(e);
    if (!is_alpha(q.name)) continue;
    FittedParameter r = e;
    r.name = roughness_name(q.name);
    for (auto* v : {&r.value, &r.ci95_low, &r.ci95_high, &r.limit, &r.excluded})
      (*v)[0] = roughness_of((*v)[0]);
    r.std_error[0] = roughness_error(r.value[0], e.std_error[0]);
    d.parameters.push_back(r);
  }
  std::vector<std::string> names;
  for (const auto& q : p.start.model.parameters)
    for (std::size_t c = 0; c < q.count; ++c)
      if (p.free.mask()[q.first + c]) names.push_back(name_of(q, c, d.channels));
  for (const std::size_t i : u.correlated) d.free_names.push_back(names[i]);
  d.correlations = u.correlations;
  d.condition = u.condition;
}

}  // namespace gonio
