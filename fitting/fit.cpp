#include "fitting/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "brdf/registry.h"
#include "fitting/accumulate.h"
#include "fitting/data.h"
#include "fitting/residuals.h"
#include "fitting/solve.h"
#include "fitting/start.h"
#include "fitting/uncertainty.h"

namespace gonio {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t coarse_samples = 2048, middle_samples = 65536;

/// What stays the same for both bin conventions.
struct Problem {
  const FitOptions& options;
  BoundModel start;  ///< fixed values in place
  FreeSlots free;
  Bounds bounds;     ///< of the free slots
  double offset;
};

struct Fitted {
  std::vector<double> values;
  Objective objective;
  Solution solution;
};

/// Milliseconds since the last call, under a name.
class Stopwatch {
 public:
  explicit Stopwatch(std::vector<std::pair<std::string, double>>& into) : into_(into) {}
  void lap(std::string name) {
    const auto now = std::chrono::steady_clock::now();
    into_.emplace_back(std::move(name),
                       std::chrono::duration<double, std::milli>(now - last_).count());
    last_ = now;
  }

 private:
  std::vector<std::pair<std::string, double>>& into_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

Range fit_range(const FitOptions& o, const ModelParameter& p) {
  const auto own = std::ranges::find(o.bounds, p.name, &Setting::name);
  if (own == o.bounds.end()) return p.about->fit;
  if (own->values.size() != 2 || !(own->values[0] < own->values[1]))
    throw wrong_usage(fmt::format("bounds of {}: two numbers, the lower first", p.name));
  for (const double v : own->values) check_range(*p.about, p.name, v);
  return {own->values[0], own->values[1]};
}

Problem pose(const Table& t, const FitOptions& o) {
  BoundModel b = bind_model(o.model, o.fixed, t.channels.size(), o.grey);
  for (const auto& s : o.bounds)
    if (!b.model.find(s.name))
      throw wrong_usage(fmt::format("bounds: the model has no parameter '{}'", s.name));
  std::vector<bool> free(b.model.value_count, true);
  Bounds bounds;
  for (const auto& p : b.model.parameters) {
    const bool fixed = std::ranges::find(b.given, p.name) != b.given.end();
    const Range range = fit_range(o, p);
    for (std::size_t c = 0; c < p.count; ++c) {
      free[p.first + c] = !fixed;
      if (fixed) continue;
      bounds.low.push_back(range.low);
      bounds.high.push_back(range.high);
    }
  }
  return {o, std::move(b), FreeSlots(std::move(free)), std::move(bounds), noise_offset(t)};
}

Fitted minimise(const Problem& p, const FitData& data, std::vector<double> values,
                const Objective& objective, const SolveOptions& options = {}) {
  const auto slots = p.free.slots();
  const Accumulator accumulate(p.start.model, data, p.free, objective);
  std::vector<double> x;
  for (const std::size_t s : slots) x.push_back(values[s]);
  const auto evaluate = [&](const std::vector<double>& at) {
    for (std::size_t i = 0; i < at.size(); ++i) values[slots[i]] = at[i];
    return accumulate.normal_equations(values);
  };
  Fitted f{{}, objective, solve(evaluate, std::move(x), p.bounds, options)};
  for (std::size_t i = 0; i < slots.size(); ++i) values[slots[i]] = f.solution.x[i];
  f.values = std::move(values);
  return f;
}

/// Huber's threshold: 1.345 times the spread that the residuals' median size tells.
double huber_threshold(const Problem& p, const FitData& data, const Fitted& f) {
  auto r = Accumulator(p.start.model, data, p.free, f.objective).residuals(f.values);
  for (auto& x : r) x = std::abs(x);
  const auto middle = r.begin() + static_cast<std::ptrdiff_t>(r.size() / 2);
  std::ranges::nth_element(r, middle);
  return std::max(1.345 * 1.4826 * *middle, 1e-12);
}

/// From nothing to a start on thinned tables, the robust threshold included.  A model that does not
/// fit converges slowly: most of its steps are made where they are cheap.
Fitted coarse(const Problem& p, const FitData& data) {
  const FitData thin = thinned(data, coarse_samples);
  Objective objective{p.options.metric};
  auto values = find_start(p.start.model, thin, p.free, objective, p.bounds, p.start.values);
  Fitted f = minimise(p, thin, std::move(values), objective);
  if (p.options.robust)
    for (int round = 0; round < 2; ++round) {
      objective.huber = huber_threshold(p, thin, f);
      f = minimise(p, thin, f.values, objective);
    }
  if (data.samples() > 4 * middle_samples)
    f = minimise(p, thinned(data, middle_samples), f.values, objective);
  return f;
}

/// One document entry per parameter, alpha followed by roughness.
void describe(FitDocument& d, const Problem& p, const Fitted& f, const Uncertainty& u) {
  for (const auto& q : p.start.model.parameters) {
    FittedParameter e{q.name, {}, {}, {}, {}, {}};
    for (std::size_t s = q.first; s < q.first + q.count; ++s) {
      double value = f.values[s], error = nan;
      auto status = ParameterStatus::fixed;
      if (p.free.mask()[s]) {
        const std::size_t i = p.free.index(s);
        status = u.status[i];
        error = u.std_error[i];
        // A width at the low end of all that is looked at: narrower ones, or no lobe, would do as well.
        if (status == ParameterStatus::at_bound && is_alpha(q.name) &&
            value <= q.about->fit.low * (1 + 1e-3))
          status = ParameterStatus::not_identifiable;
        if (status == ParameterStatus::not_identifiable) value = error = nan;
      }
      e.value.push_back(value);
      e.std_error.push_back(error);
      e.ci95_low.push_back(std::max(value - u.t * error, q.about->legal.low));
      e.ci95_high.push_back(std::min(value + u.t * error, q.about->legal.high));
      if (std::isnan(error)) e.ci95_low.back() = e.ci95_high.back() = nan;
      e.status.push_back(status);
    }
    d.parameters.push_back(e);
    if (!is_alpha(q.name)) continue;
    FittedParameter r = e;  // roughness = √alpha, its error to first order
    r.name = roughness_name(q.name);
    for (auto* v : {&r.value, &r.ci95_low, &r.ci95_high}) (*v)[0] = std::sqrt((*v)[0]);
    r.std_error[0] = e.std_error[0] / (2 * r.value[0]);
    d.parameters.push_back(r);
  }
  for (const auto& q : p.start.model.parameters)
    for (std::size_t c = 0; c < q.count; ++c)
      if (p.free.mask()[q.first + c])
        d.free_names.push_back(q.count == 1 ? q.name : fmt::format("{}[{}]", q.name, c));
  d.correlations = u.correlations;
  d.condition = u.condition;
}

bool clustered(const FitOptions& o, const Table& t, std::size_t clusters, std::size_t free) {
  if (o.intervals == Intervals::independent) return false;
  if (o.intervals == Intervals::automatic && t.truth) return false;
  // With few clusters the sums of their scores say too little: at the optimum they add up to zero.
  return clusters >= std::max<std::size_t>(8, 2 * free);
}

}  // namespace

FitResult fit(const Table& t, const FitOptions& o, const std::function<void(const char*)>& phase) {
  const auto announce = [&](const char* what) {
    if (phase) phase(what);
  };
  const Problem p = pose(t, o);
  FitResult result{{}, p.start};
  FitDocument& d = result.document;
  d.solver.instruction_set = kernels<double>().instruction_set;
  Stopwatch watch(d.solver.phase_ms);

  const Bins bins = t.grid() ? t.grid()->bins : Bins::centre;
  Objective objective;
  {
    announce("reading columns");
    const FitData data = fit_data(t, bins, o.metric, p.offset);
    watch.lap("columns_ms");
    announce("finding a start");
    const Fitted start = coarse(p, data);
    watch.lap("start_ms");
    announce("fitting all samples");
    const Fitted f = minimise(p, data, start.values, start.objective);
    watch.lap("solve_ms");
    objective = f.objective;

    announce("standard errors");
    const bool by_angle = clustered(o, t, data.clusters, p.free.size());
    const Accumulator accumulate(p.start.model, data, p.free, f.objective);
    const std::size_t clusters = by_angle ? data.clusters : 0;
    const auto u = uncertainty(accumulate.sandwich(f.values, by_angle), f.solution.x, p.bounds,
                               data.values_used, clusters);
    watch.lap("errors_ms");

    result.model.values = f.values;
    d.model = p.start.model.spec;
    describe(d, p, f, u);
    d.metric = metric_names[static_cast<std::size_t>(o.metric)];
    d.log_offset = data.offset;
    d.robust = o.robust ? "huber" : "none";
    d.cost = f.solution.at.cost;
    d.intervals = by_angle ? "clustered by incident angle" : "independent values";
    d.clusters = clusters;
    d.solver.termination = f.solution.converged ? "converged" : "not_converged";
    d.solver.message = f.solution.message;
    d.solver.iterations = f.solution.iterations;
    d.solver.passes = f.solution.passes;
    d.solver.cost_per_iteration = f.solution.cost_per_iteration;
    d.residuals = residual_statistics(result.model, data);
    watch.lap("residuals_ms");
    d.values_used = data.values_used;
    d.masked = data.masked;
  }
  d.input_path = t.path;
  d.input_format = t.format;
  d.bins = t.has_bins() ? bins_names[static_cast<std::size_t>(bins)] : "none";

  if (t.has_bins() && o.bin_sensitivity) {
    announce("fitting under the other bin convention");
    const Bins other = bins == Bins::centre ? Bins::edge : Bins::centre;
    // Both conventions on the same thinned bins: a ratio needs no million of them.
    const auto refit = [&](Bins convention) {
      const FitData data = thinned(fit_data(t, convention, o.metric, p.offset), middle_samples);
      auto values = minimise(p, data, result.model.values, objective).values;
      const double log_rms = residual_statistics({p.start.model, values, {}}, data).log_rms;
      return std::pair(std::move(values), log_rms);
    };
    const auto [here, ignored] = refit(bins);
    const auto [there, log_rms] = refit(other);
    BinSensitivity s{bins_names[static_cast<std::size_t>(other)], {}, log_rms};
    for (const auto& q : p.start.model.parameters) {
      std::vector<double> change;
      for (std::size_t i = q.first; i < q.first + q.count; ++i)
        change.push_back(here[i] == 0 ? nan : there[i] / here[i] - 1);
      s.relative_change.emplace_back(q.name, std::move(change));
    }
    d.sensitivity.push_back(std::move(s));
    watch.lap("bin_sensitivity_ms");
  }
  return result;
}

}  // namespace gonio
