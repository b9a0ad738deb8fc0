#include "fitting/choice/log_residuals.h"

#include <algorithm>
#include <cmath>

#include "brdf/model/evaluate.h"
#include "brdf/model/mean_block.h"
#include "fitting/sample/incident_angles.h"

namespace gonio {

namespace {

/// f of the samples, which are means where the block says so.
void evaluate_at(Evaluator<double>& evaluate,
                 const SampleBlock<double>& x,
                 std::span<double* const> out) {
  if (!x.mean) return evaluate(x, out);
  for (double* f : out) std::fill_n(f, x.n, 0.0);
  std::vector<Column<double>> of_angles;
  std::vector<double*> to;
  for (std::size_t c = 0; c < out.size(); ++c)
    to.push_back(of_angles.emplace_back(Column<double>(BlockReader<double>::block)).data());
  for_parts(x, BlockReader<double>::block, [&](const Block<double>& angles, const auto& add) {
    evaluate(angles, to);
    for (std::size_t c = 0; c < out.size(); ++c) add(to[c], out[c]);
  });
}

}  // namespace

double LogResiduals::rms() const {
  return std::sqrt(squares / values);
}

ResidualsByAngle log_residuals(const Sampling& s, const BoundModel& model, std::size_t most) {
  const IncidentKeys keys(s);
  ResidualsByAngle all;
  Evaluator<double> evaluate(model.model);
  evaluate.set(model.values);
  constexpr std::size_t block = BlockReader<double>::block;
  std::vector<Column<double>> f;
  std::vector<double*> out;
  for (std::size_t c = 0; c < s.channels(); ++c)
    out.push_back(f.emplace_back(Column<double>(block)).data());
  const std::size_t members = s.groups().widest();
  const Tasks tasks(s, most, block);
  for (std::size_t k = 0; k < tasks.count; ++k) {
    BlockReader<double> in(s, tasks.first(k), tasks.last(k), tasks.step);
    while (in.next()) {
      evaluate_at(evaluate, in.angles(), out);
      for (std::size_t m = 0; m < members; ++m)
        for (std::size_t c = 0; c < s.channels(); ++c) {
          const auto& data = in.values(m, c);
          for (std::size_t i = 0; i < in.size(); ++i) {
            if (!(data.weight[i] > 0)) continue;
            // As the fit's own link: a model that underflows is judged where it does, too.
            const double shifted = std::max(out[c][i] + s.offset(), static_cast<double>(faintest));
            const double r = std::log(shifted) - data.target[i], n = s.count_of(in.sample(m)[i]);
            all[keys(in.sample(m)[i], in.nol(m)[i])].add({n, n * r, n * r * r});
          }
        }
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
