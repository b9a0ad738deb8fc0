#include "fitting/fit.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <tuple>

#include "base/error.h"
#include "base/quantile.h"
#include "brdf/catalogue/registry.h"
#include "fitting/judge/assess.h"
#include "fitting/judge/uncertainty.h"
#include "fitting/judge/warnings.h"
#include "fitting/sample/data.h"
#include "fitting/solve/accumulate.h"
#include "fitting/solve/problem.h"
#include "fitting/solve/solve.h"
#include "fitting/solve/start.h"

#include <fmt/format.h>
#include <tbb/task_group.h>

namespace gonio {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t coarse_samples = 2048, scan_samples = 16384, middle_samples = 32768;

struct Fitted {
  std::vector<double> values;
  double huber = no_huber;
  Solution solution;
  bool in_float = false;   ///< whether that was enough
  std::size_t groups = 0;  ///< looked at
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

template <class F>
Fitted minimise(const Problem& p,
                const FitData<F>& data,
                std::vector<double> values,
                double huber) {
  const auto slots = p.free.slots();
  const Accumulator<F> accumulate(p.start.model, data, p.free, huber);
  std::vector<double> x;
  for (const std::size_t s : slots) x.push_back(values[s]);
  const auto evaluate = [&](const std::vector<double>& at) {
    for (std::size_t i = 0; i < at.size(); ++i) values[slots[i]] = at[i];
    return accumulate.normal_equations(values);
  };
  SolveOptions options;
  if (std::is_same_v<F, float>)
    options = {.function_tolerance = 1e-7,
               .rounding = p.rounding * static_cast<double>(data.counts.used)};
  Fitted f{{}, huber, solve(evaluate, std::move(x), p.bounds, options)};
  for (std::size_t i = 0; i < slots.size(); ++i) values[slots[i]] = f.solution.x[i];
  f.values = std::move(values);
  return f;
}

/// Huber's threshold: 1.345 times the spread that the residuals' median size tells.
template <class F>
double huber_threshold(const Problem& p, const FitData<F>& data, const Fitted& f) {
  auto r = Accumulator<F>(p.start.model, data, p.free).residuals(f.values);
  if (r.empty()) return no_huber;
  for (auto& x : r) x = std::abs(x);
  return std::max(1.345 * 1.4826 * median(r), 1e-12);
}

/// The cost of one value's rounding in float; 0 where sums of squares leave what a float holds.
double rounding_in_float(const FitData<double>& thin, std::size_t channels) {
  constexpr double most = 1e10, relative = 5e-7;
  double squares = 0, count = 0, largest = 0;
  for (const auto& task : thin.tasks)
    for (const auto& b : task)
      for (std::size_t c = 0; c < channels; ++c)
        for (std::size_t i = 0; i < b.n; ++i) {
          const double w = b.weight(c)[i];
          if (w == 0) continue;
          const double x = w * (thin.link == Link::log ? 1 : b.target(c)[i]);
          constexpr double far = 40;  // e⁴⁰ squared is still a float
          if (w < 1 / most || w > most || std::abs(x) > most) return 0;
          if (thin.link == Link::log && std::abs(b.target(c)[i]) > far) return 0;
          largest = std::max(largest, std::abs(x));
          squares += x * x;
          ++count;
        }
  return largest < 1 / most ? 0 : relative * relative * squares / count / 2;
}

/// Whether what float rounds off is less than a twentieth of each standard error, as a first look at
/// JᵀJ gives it.
bool float_suffices(const Problem& p, const Fitted& f, std::size_t values_used) {
  constexpr double rounding = 1e-7;
  const std::size_t n = p.free.size();
  const double variance = 2 * f.solution.at.cost / static_cast<double>(values_used);
  for (std::size_t i = 0; i < n; ++i) {
    // 1/H_ii is the variance with all others known: not more than that of the parameter
    const double h = f.solution.at.h[i * n + i];
    if (h > 0 && std::sqrt(variance / h) < 20 * rounding * std::abs(f.solution.x[i])) return false;
  }
  return true;
}

[[noreturn]] void no_values(const Sampling& sampling, const SampleCounts& counts) {
  std::string reasons;
  for (const auto& [reason, count] : counts.by_reason(sampling))
    if (count) reasons += fmt::format("{}{} {}", reasons.empty() ? "" : ", ", count, reason);
  throw bad_input(sampling.table().path, "values",
                  fmt::format("none that can be used ({})", reasons), "at least one");
}

/// From nothing to the best fit of all samples.  A model that does not fit converges slowly: most of
/// the steps are made on thinned tables, where they are cheap.
/// \param scanned  is made: a thinned table
template <class F>
Fitted search(const Problem& p,
              const Sampling& sampling,
              FitData<double>& scanned,
              Stopwatch& watch,
              const std::function<void(const char*)>& announce) {
  announce("reading columns");
  constexpr std::array levels{coarse_samples, scan_samples, middle_samples};
  const auto data = fit_levels<F>(sampling, levels);
  if (data.all.counts.used == 0) no_values(sampling, data.all.counts);
  const auto& [thin, scan, middle] = std::tie(data.thinned[0], data.thinned[1], data.thinned[2]);
  scanned = in_double(scan);
  watch.lap("columns_ms");

  announce("finding a start");
  auto values = find_start(p.start.model, thin, p.free, p.bounds, p.start.values);
  Fitted f = minimise(p, p.options.robust ? thin : middle, std::move(values), no_huber);
  if (p.options.robust) {
    for (int round = 0; round < 2; ++round)
      f = minimise(p, thin, f.values, huber_threshold(p, thin, f));
    f = minimise(p, middle, f.values, f.huber);
  }
  if (!std::isfinite(f.solution.at.cost))
    throw bad_input(sampling.table().path, "values", "numbers whose squares have no finite sum",
                    "reflectances [1/sr]");
  watch.lap("start_ms");

  announce("fitting all samples");
  f = minimise(p, data.all, f.values, f.huber);
  f.groups = data.all.groups;
  f.in_float = std::is_same_v<F, float> && float_suffices(p, f, data.all.counts.used);
  watch.lap("solve_ms");
  return f;
}

/// Whether f stays the same with light and viewer exchanged: then such samples are one to the fit.
bool is_reciprocal(const BoundModel& b) {
  std::vector<Angles<double>> there, back;
  for (const double theta_h : {2.0, 15.0, 40.0})
    for (const double theta_d : {5.0, 30.0, 45.0})
      for (const double phi_d : {10.0, 70.0}) {
        const auto a =
            angles(SinCos(theta_h * degree), SinCos(theta_d * degree), std::cos(phi_d * degree));
        there.push_back(a);
        back.push_back({a.nov, a.nol, a.noh, a.voh, a.sin2_theta_h});
      }
  const auto f = evaluate(b, there), g = evaluate(b, back);
  for (std::size_t c = 0; c < f.size(); ++c)
    for (std::size_t i = 0; i < f[c].size(); ++i)
      if (std::abs(f[c][i] - g[c][i]) > 1e-12 * f[c][i]) return false;
  return true;
}

/// Two fits that differ in the bin convention alone, on thinned tables: a ratio needs no million bins.
struct BothConventions {
  Fitted here, there;
  double log_rms_there = nan;
};
BothConventions fit_both(const Problem& p,
                         const FitData<double>& scanned,
                         const Sampling& elsewhere,
                         const Fitted& f) {
  BothConventions b;
  b.here = minimise(p, scanned, f.values, f.huber);
  b.there = minimise(p, fit_data<double>(elsewhere, scan_samples), f.values, f.huber);
  if (b.there.solution.converged)
    b.log_rms_there =
        residual_statistics({p.start.model, b.there.values, {}}, elsewhere, scan_samples).log_rms;
  return b;
}

/// The model without its lobes.
Problem diffuse_alone(const Problem& p) {
  Problem q = p;
  q.start.model.lobes.clear();
  std::vector<bool> mask(p.free.mask().size(), false);
  q.bounds = {};
  q.narrowed.clear();
  for (const auto& t : p.start.model.diffuse)
    for (const std::size_t k : t.parameters) {
      const auto& parameter = p.start.model.parameters[k];
      for (std::size_t s = parameter.first; s < parameter.first + parameter.count; ++s)
        mask[s] = p.free.mask()[s];
    }
  for (const std::size_t s : p.free.slots())
    if (mask[s]) {
      q.bounds.low.push_back(p.bounds.low[p.free.index(s)]);
      q.bounds.high.push_back(p.bounds.high[p.free.index(s)]);
      q.narrowed.push_back(p.narrowed[p.free.index(s)]);
    }
  q.free = FreeSlots(std::move(mask));
  return q;
}

/// Takes the value from parameters that can be anything: moved over its whole range, the others as
/// they are, such a one lowers or raises the cost by no more than luck does.  A lobe that may be put
/// anywhere can always please one of N noisy values, which is worth 2 ln N [the largest of N squared
/// normal deviates].  Asked of the widths and exponents, which a vanished lobe leaves free, and of
/// what stands at a bound.
///
/// The lobe as a whole is asked too: where the diffuse terms alone, fitted anew, do as well or better,
/// nothing is known of it.  It may be unable to vanish: Schlick's F is 1 at 90° whatever f0 is.
/// Returns whether that is so.
bool find_undetermined(const Problem& p,
                       const FitData<double>& thin,
                       const Fitted& f,
                       std::size_t values_used,
                       Uncertainty& u) {
  const Accumulator<double> accumulate(p.start.model, thin, p.free, f.huber);
  const NormalEquations here = accumulate.normal_equations(f.values);
  const std::size_t n = p.free.size();
  if (thin.counts.used == 0) return false;
  const double count = static_cast<double>(thin.counts.used);
  double effect = 0;  // rounding is not evidence: residuals below 1e-7 of what a parameter can do
  for (std::size_t i = 0; i < n; ++i) {
    const double range = p.bounds.high[i] - p.bounds.low[i];
    effect = std::max(effect, here.h[i * n + i] * range * range);
  }
  const double variance = std::max(2 * here.cost, 1e-14 * effect) / count;
  const double share = static_cast<double>(thin.groups) / static_cast<double>(f.groups);
  const double luck = (3.84 + 2 * std::log(static_cast<double>(values_used))) * share;
  for (const auto& q : p.start.model.parameters)
    for (std::size_t s = q.first; s < q.first + q.count; ++s) {
      if (!p.free.mask()[s]) continue;
      const std::size_t i = p.free.index(s);
      if (q.about->per_channel && u.status[i] != ParameterStatus::at_bound) continue;
      auto moved = f.values;
      const double low = p.bounds.low[i], high = p.bounds.high[i];
      double most = 0;
      for (const double part : {0.0, 0.03, 0.1, 0.3, 0.6, 1.0}) {
        moved[s] = low + part * (high - low);
        most = std::max(most, std::abs(accumulate.normal_equations(moved).cost - here.cost));
      }
      if (2 * most < luck * variance) {
        u.status[i] = ParameterStatus::not_identifiable;
        u.std_error[i] = nan;
      }
    }

  if (p.start.model.diffuse.empty() || p.start.model.lobes.empty()) return false;
  const Problem rest = diffuse_alone(p);
  const double without = minimise(rest, thin, f.values, f.huber).solution.at.cost;
  if (2 * (without - here.cost) >= luck * variance) return false;
  for (const auto& l : p.start.model.lobes)
    for (const auto* t : {&l.ndf, &l.masking, &l.fresnel})
      for (const std::size_t k : t->parameters) {
        const auto& q = p.start.model.parameters[k];
        for (std::size_t s = q.first; s < q.first + q.count; ++s)
          if (p.free.mask()[s]) {
            u.status[p.free.index(s)] = ParameterStatus::not_identifiable;
            u.std_error[p.free.index(s)] = nan;
          }
      }
  return true;
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
        // A width at the low end of all there are: narrower ones, or no lobe, would do as well.
        if (status == ParameterStatus::at_bound && is_alpha(q.name) && !p.narrowed[i] &&
            value <= p.bounds.low[i] * (1 + 1e-3))
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
        d.free_names.push_back(q.count == 1 ? q.name : fmt::format("{}.{}", q.name, d.channels[c]));
  d.correlations = u.correlations;
  d.condition = u.condition;
}

}  // namespace

FitResult fit(const Table& t,
              const FitOptions& given,
              const std::function<void(const char*)>& phase) {
  const FitOptions o = expanded(given);
  const auto announce = [&](const char* what) {
    if (phase) phase(what);
  };
  Problem p = pose(t, o);
  FitResult result{{}, p.start};
  FitDocument& d = result.document;
  d.solver.instruction_set = kernels<double>().instruction_set;
  Stopwatch watch(d.solver.phase_ms);

  const Bins bins = t.bins();
  const bool reciprocal = is_reciprocal(p.start);
  const auto sampling_of = [&](Bins convention) {
    return Sampling(t, convention, o.metric, p.offset, reciprocal && !o.robust);
  };
  const Sampling sampling = sampling_of(bins);

  // What has room in the caches is fitted in double at once.
  if (sampling.groups().size() > 8 * middle_samples)
    p.rounding = rounding_in_float(fit_data<double>(sampling, coarse_samples), t.channels.size());
  FitData<double> scanned;
  Fitted f = p.rounding > 0 ? search<float>(p, sampling, scanned, watch, announce)
                            : search<double>(p, sampling, scanned, watch, announce);
  if (p.rounding > 0 && !f.in_float) {
    announce("fitting all samples in double");
    const std::size_t groups = f.groups;
    f = minimise(p, fit_data<double>(sampling), f.values, f.huber);
    f.groups = groups;
    watch.lap("solve_double_ms");
  }

  announce("standard errors");
  result.model.values = f.values;
  // Of few samples and so for one thread, beside what comes next.
  const bool has_other = t.has_bins() && o.bin_sensitivity;
  const Bins other = bins == Bins::centre ? Bins::edge : Bins::centre;
  BothConventions both;
  tbb::task_group meanwhile;
  if (has_other) meanwhile.run([&] { both = fit_both(p, scanned, sampling_of(other), f); });
  bool by_angle =
      o.intervals == Intervals::by_angle || (o.intervals == Intervals::automatic && !t.truth);
  auto a = assess(sampling, result.model, p.free, f.huber, by_angle, f.in_float);
  const std::size_t angles = a.incident_angles;
  if (o.intervals == Intervals::by_angle && a.incident_angles < 2)
    throw wrong_usage("intervals by_angle: the table has one incident angle");
  if (by_angle && o.intervals == Intervals::automatic &&
      !enough_angles(a.incident_angles, p.free.size())) {
    by_angle = false;
    a = assess(sampling, result.model, p.free, f.huber, by_angle, f.in_float);
  }
  const std::size_t clusters = by_angle ? a.incident_angles : 0;
  auto u = uncertainty(a.sandwich, f.solution.x, p.bounds, a.counts.used, clusters);
  const bool needless = find_undetermined(p, scanned, f, a.counts.used, u);
  watch.lap("errors_ms");

  d.model = p.start.model.spec;
  d.channels = t.channels;
  describe(d, p, f, u);
  d.metric = metric_names[static_cast<std::size_t>(o.metric)];
  d.log_offset = sampling.offset();
  d.robust = o.robust ? "huber" : "none";
  d.cost = f.solution.at.cost;
  d.intervals = by_angle ? "clustered by incident angle" : "independent values";
  d.clusters = clusters;
  d.solver.termination = f.solution.converged ? "converged" : "not_converged";
  d.solver.message = f.solution.message;
  d.solver.iterations = f.solution.iterations;
  d.solver.passes = f.solution.passes;
  d.solver.cost_per_iteration = f.solution.cost_per_iteration;
  d.residuals = a.residuals;
  d.values_used = a.counts.used;
  d.masked = a.counts.by_reason(sampling);
  d.input_path = t.path;
  d.input_format = t.format;
  d.bins = t.has_bins() ? bins_names[static_cast<std::size_t>(bins)] : "none";

  meanwhile.wait();
  if (has_other) {
    const auto& [here, there, log_rms] = both;
    if (here.solution.converged && there.solution.converged) {
      BinSensitivity s{bins_names[static_cast<std::size_t>(other)], {}, log_rms};
      for (const auto& q : p.start.model.parameters) {
        const auto& known = std::ranges::find(d.parameters, q.name, &FittedParameter::name)->value;
        std::vector<double> change;
        for (std::size_t c = 0; c < q.count; ++c) {
          const double x = here.values[q.first + c], y = there.values[q.first + c];
          change.push_back(std::isnan(known[c]) || x == 0 ? nan : y / x - 1);
        }
        s.relative_change.emplace_back(q.name, std::move(change));
      }
      d.sensitivity.push_back(std::move(s));
    }
    watch.lap("bin_sensitivity_ms");
  }
  d.warnings = warnings(o, t, d, angles, p.free.size());
  if (needless)
    d.warnings.push_back(
        "without its lobe the model meets the table as well or better: nothing is known of the "
        "lobe");
  d.warnings.insert(d.warnings.begin(), t.warnings.begin(), t.warnings.end());
  return result;
}

}  // namespace gonio
