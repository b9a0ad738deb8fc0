#include "fitting/judge/bootstrap.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <vector>

#include "base/quantile.h"
#include "fitting/judge/lack_of_fit.h"
#include "fitting/sample/incident_angles.h"
#include "fitting/solve/colours.h"

#include <tbb/parallel_for.h>

namespace gonio {
namespace {

/// Rows of fit data that have a value: [row][column].
std::vector<std::vector<double>> rows_of(const FitData<double>& d, std::size_t channels) {
  std::vector<std::vector<double>> rows;
  for (const auto& task : d.tasks)
    for (const auto& b : task)
      for (std::size_t i = 0; i < b.n; ++i) {
        bool has_value = false;
        for (std::size_t c = 0; c < channels; ++c) has_value = has_value || b.weight(c)[i] > 0;
        if (!has_value) continue;
        auto& row = rows.emplace_back();
        for (std::size_t k = 0; k < b.columns_count; ++k) row.push_back(b.columns[k * b.n + i]);
      }
  return rows;
}

/// Rows that are drawn together.
std::vector<std::vector<std::size_t>> units_of(const std::vector<std::vector<double>>& rows,
                                               const IncidentKeys* angles) {
  std::map<std::size_t, std::vector<std::size_t>> units;
  for (std::size_t i = 0; i < rows.size(); ++i)
    units[angles ? angles->near(rows[i][0]) : i].push_back(i);
  std::vector<std::vector<std::size_t>> all;
  for (auto& [key, own] : units) all.push_back(std::move(own));
  return all;
}

}  // namespace

bool bootstrap(const Sampling& unfolded,
               const Problem& p,
               const Fitted& f,
               bool by_angle,
               const LackOfFit& lack,
               std::span<const double> seen_against,
               Uncertainty& u) {
  const std::size_t channels = unfolded.channels(), n = p.free.size();
  const auto thin = fit_data<double>(unfolded, scan_samples);
  const auto rows = rows_of(thin, channels);
  const IncidentKeys angles(unfolded);
  const auto units = units_of(rows, by_angle ? &angles : nullptr);
  if (units.size() < 2) return false;

  std::vector<std::vector<double>> found(bootstrap_tables);
  tbb::parallel_for(std::size_t{0}, bootstrap_tables, [&](std::size_t table) {
    std::mt19937_64 random(table + 1);
    std::vector<double> drawn;
    for (std::size_t k = 0; k < units.size(); ++k)
      for (const std::size_t row : units[random() % units.size()])
        drawn.insert(drawn.end(), rows[row].begin(), rows[row].end());
    const auto data = picked_from(thin, channels, drawn);
    const Accumulator<double> accumulate(p.start.model, data, p.free, f.huber);
    found[table] = p.free.of(descended(accumulate, p, f.model.values, {60, 1e-8}).values);
  });

  const double count = static_cast<double>(units.size());
  double part = std::sqrt(count / (count - 1));
  if (!by_angle && unfolded.groups().size() > scan_samples)
    part *= std::sqrt(count / static_cast<double>(unfolded.groups().size()));
  for (std::size_t i = 0; i < n; ++i) {
    if (u[i].status != ParameterStatus::free || std::isnan(u[i].std_error)) continue;
    const double value = f.model.values[p.free.slots()[i]];
    std::vector<double> moves;
    double sum = 0, squares = 0;
    for (const auto& x : found) {
      moves.push_back(part * (x[i] - value));
      sum += moves.back();
      squares += moves.back() * moves.back();
    }
    constexpr double tables = bootstrap_tables;
    const double error = std::sqrt(std::max(0.0, squares - sum * sum / tables) / (tables - 1));
    u[i].std_error =
        with_gains(lack, i, widened(error, lack.widening, seen_against[i]), u[i].freedom);
    const double wider = error > 0 ? u[i].std_error / error : 1;
    u[i].low = value + wider * quantile(moves, 0.025);
    u[i].high = value + wider * quantile(moves, 0.975);
  }
  return true;
}

}  // namespace gonio
