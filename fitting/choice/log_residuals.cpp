#include "fitting/choice/log_residuals.h"

#include <algorithm>
#include <cmath>

#include "fitting/sample/incident_angles.h"
#include "fitting/sample/model_blocks.h"

namespace gonio {

double LogResiduals::rms() const {
  return std::sqrt(squares / values);
}

ResidualsByAngle log_residuals(const Sampling& s, const BoundModel& model, std::size_t most) {
  const IncidentKeys keys(s);
  ResidualsByAngle all;
  ModelBlocks<double> look(s, model, std::vector<bool>(model.model.value_count));
  const std::size_t members = s.groups().widest();
  const Tasks tasks(s, most, BlockReader<double>::block);
  for (std::size_t k = 0; k < tasks.count; ++k) {
    BlockReader<double> in(s, tasks.first(k), tasks.last(k), tasks.step);
    while (in.next()) {
      look.run(in, [&](std::size_t c) {
        for (std::size_t m = 0; m < members; ++m) {
          const auto& data = in.values(m, c);
          for (std::size_t i = 0; i < in.size(); ++i) {
            if (!(data.weight[i] > 0)) continue;
            const double r = look.link()[i] - data.target[i], n = s.count_of(in.sample(m)[i]);
            all[keys(in.sample(m)[i], in.nol(m)[i])].add({n, n * r, n * r * r});
          }
        }
      });
    }
  }
  return all;
}

LogResiduals total(const ResidualsByAngle& angles) {
  LogResiduals all;
  for (const auto& [key, a] : angles) all.add(a);
  return all;
}

double effective_values(const ResidualsByAngle& angles, double step) {
  const LogResiduals all = total(angles);
  double squared_sizes = 0, between_squares = 0;
  for (const auto& [key, a] : angles) {
    squared_sizes += a.values * a.values;
    between_squares += a.sum * a.sum / a.values;
  }
  const auto k = static_cast<double>(angles.size());
  if (k < 2 || all.values <= k) return step * all.values;
  const double between = (between_squares - all.sum * all.sum / all.values) / (k - 1);
  const double within = (all.squares - between_squares) / (all.values - k);
  const double m = (all.values - squared_sizes / all.values) / (k - 1);
  const double variance = between + (m - 1) * within;
  const double rho = variance > 0 ? std::clamp((between - within) / variance, 0.0, 1.0) : 0;
  const double alike = step * squared_sizes / all.values;
  return std::max(k, step * all.values / (1 + (alike - 1) * rho));
}

}  // namespace gonio
