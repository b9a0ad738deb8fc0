#include "fitting/solve/search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include "base/error.h"
#include "base/quantile.h"
#include "fitting/sample/data.h"
#include "fitting/solve/accumulate.h"
#include "fitting/solve/profile.h"
#include "fitting/solve/start.h"

#include <fmt/format.h>

namespace gonio {
namespace {

constexpr std::size_t middle_samples = 32768;

template <class F>
double huber_threshold(const Problem& p, const FitData<F>& data, const Fitted& f) {
  auto r = Accumulator<F>(p.start.model, data, p.free).residuals(f.model.values);
  for (auto& x : r) x = std::abs(x);
  return huber_of({r.begin(), r.end()});
}

/// Cost of one value's rounding in float, ½ (5e-7 x)² on average, where x is a value's residual if the
/// model were 0 there (or wrong by a factor e under logs).  0, which means double alone, where floats
/// do not hold the squares: of weights or residuals outside [1e-10, 1e10], of values beyond e^±40.
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

/// True where what float rounds off is less than a twentieth of each standard error, as a first look at
/// JᵀJ gives it.
bool float_suffices(const Problem& p, const Fitted& f, double samples_used) {
  constexpr double rounding = 1e-7;
  const auto x = p.free.of(f.model.values);
  const std::size_t n = x.size();
  const double variance = 2 * f.solution.at.cost / samples_used;
  for (std::size_t i = 0; i < n; ++i) {
    // 1/H_ii is the variance with all others known: not more than that of the parameter
    const double h = f.solution.at.h(i, i);
    if (h > 0 && std::sqrt(variance / h) < 20 * rounding * std::abs(x[i])) return false;
  }
  return true;
}

[[noreturn]] void no_values(const Sampling& sampling, const SampleCounts& counts) {
  std::string reasons;
  for (const auto& [reason, count] : counts.by_reason(sampling))
    if (count) reasons += fmt::format("{}{} {}", reasons.empty() ? "" : ", ", count, reason);
  throw bad_input(
      sampling.table().path, "values", fmt::format("none that can be used ({})", reasons),
      sampling.metric() == Metric::l2_cosine ? "at least one" : "at least one above 1e-30 [1/sr]");
}

/// Fit of a thinned table whose outliers count less and less.
template <class F>
Fitted robustly(const Problem& p, const FitData<F>& thin, Fitted f) {
  for (int round = 0; round < 2; ++round) {
    const double huber = huber_threshold(p, thin, f);  // before the model is moved from
    f = minimise(p, thin, std::move(f.model), huber);
  }
  return f;
}

/// Those starts of a thinned table that may be the best of all, as one with more samples tells.
template <class F>
std::vector<Start> best_of(const Problem& p, const FitData<F>& more, std::vector<Start> starts) {
  constexpr double worth_a_fit = 0.2;
  if (starts.size() < 2) return starts;
  const Accumulator<F> accumulate(p.start.model, more, p.free);
  for (auto& s : starts) s = descended_in_valley(accumulate, p, std::move(s.values), {8, 1e-3});
  keep_best(starts, starts.size());
  std::erase_if(starts,
                [&](const Start& s) { return s.cost > starts.front().cost * (1 + worth_a_fit); });
  return starts;
}

/// Least cost of all samples that the model reaches with fewer of its several lobes, where these are
/// better on a thinned table: not every lobe can vanish.
/// \param middle_cost  of the whole model
template <class F>
double cost_of_fewer(const Problem& p, const FitLevels<F>& data, double middle_cost) {
  double least = std::numeric_limits<double>::infinity();
  const Model& m = p.start.model;
  if (m.lobes.size() < 2 || p.options.robust) return least;
  const FitData<F>&thin = data.thinned[0], &scan = data.thinned[1], &middle = data.thinned[2];
  const bool any_will_do =
      p.options.fixed.empty() && p.options.bounds.empty() &&
      std::ranges::all_of(m.lobes, [&](const Lobe& l) { return are_alike(l, m.lobes.front()); });
  for (std::size_t bits = 0; bits + 1 < std::size_t{1} << m.lobes.size(); ++bits) {
    std::vector<std::size_t> kept;
    for (std::size_t l = 0; l < m.lobes.size(); ++l)
      if (bits >> l & 1U) kept.push_back(l);
    const Model fewer = with_lobes(m, kept);
    if (fewer.lobes.empty() && fewer.diffuse.empty()) continue;
    if (any_will_do && kept.size() == 1 && kept[0] > 0) continue;
    const Problem q = with_free(p, fewer, slots_read(fewer));
    Fitted f{q.start, no_huber, {}};
    f.solution.at.cost = std::numeric_limits<double>::infinity();
    for (const Start& s : best_of(q, scan, find_starts(q, thin, no_huber))) {
      Fitted other = minimise(q, middle, {fewer, s.values, {}}, no_huber);
      if (other.solution.at.cost < f.solution.at.cost) f = std::move(other);
    }
    if (!(f.solution.at.cost < middle_cost)) continue;
    f = minimise(q, data.all, std::move(f.model), no_huber);
    profile(q, thin, scan, data.all, f);
    least = std::min(least, f.solution.at.cost);
  }
  return least;
}

/// From nothing to the best fit of all samples.  A model that does not fit converges slowly: most of
/// the steps are made on thinned tables, where they are cheap.
template <class F>
Searched search_in(const Problem& p,
                   const Sampling& sampling,
                   SharedColumns& columns,
                   PhaseTimes& watch,
                   const std::function<void(const char*)>& announce) {
  announce("reading columns");
  constexpr std::array levels{coarse_samples, scan_samples, middle_samples};
  const auto read = columns.levels<F>(sampling, levels);
  const FitLevels<F>& data = *read;
  if (data.all.counts.used == 0) no_values(sampling, data.all.counts);
  const auto &thin = data.thinned[0], &scan = data.thinned[1], &middle = data.thinned[2];
  FitData<double> scanned = in_double(scan);
  watch.lap("columns_ms");

  announce("finding a start");
  const BoundModel* const bulk = sampling.bulk();
  const auto starts =
      bulk ? std::vector{Start{0, bulk->values}} : best_of(p, scan, find_starts(p, thin, no_huber));
  const auto fitted_from = [&](const Start& s) {
    BoundModel from{p.start.model, s.values, {}};
    if (bulk) return Fitted{std::move(from), no_huber, {}};
    return minimise(p, p.options.robust ? thin : middle, std::move(from), no_huber);
  };
  Fitted f = fitted_from(starts.front());
  for (std::size_t k = 1; k < starts.size(); ++k) {
    Fitted other = fitted_from(starts[k]);
    if (other.solution.at.cost < f.solution.at.cost) f = std::move(other);
  }
  f.model.given = p.start.given;
  if (p.options.robust) {
    f = robustly(p, thin, std::move(f));
    f = minimise(p, middle, f.model, f.huber);
  }
  if (!std::isfinite(f.solution.at.cost))
    throw bad_input(sampling.table().path, "values", "numbers whose squares have no finite sum",
                    "reflectances [1/sr]");
  const double middle_cost = f.solution.at.cost;
  watch.lap("start_ms");

  announce("fitting all samples");
  f = minimise(p, data.all, f.model, f.huber);
  f.in_float = std::is_same_v<F, float> && float_suffices(p, f, data.all.counts.samples);
  watch.lap("solve_ms");
  Searched found{std::move(f), std::numeric_limits<double>::infinity(), std::move(scanned), {}};
  if (p.options.certificate == Certify::none) return found;
  announce("looking for other valleys");
  found.profile = std::make_shared<const Profile>(profile(p, thin, scan, data.all, found.best));
  found.cost_of_fewer = cost_of_fewer(p, data, middle_cost);
  watch.lap("certificate_ms");
  return found;
}

}  // namespace

template <class F>
Fitted minimise(const Problem& p, const FitData<F>& data, BoundModel from, double huber) {
  const Accumulator<F> accumulate(from.model, data, p.free, huber);
  const auto evaluate = [&](const std::vector<double>& x) {
    p.free.put(x, from.values);
    return accumulate.normal_equations(from.values);
  };
  SolveOptions options;
  if (std::is_same_v<F, float>)
    options = {.function_tolerance = 1e-7,
               .rounding = p.rounding * static_cast<double>(data.counts.used)};
  auto x = p.free.of(from.values);
  Solution solution = solve(evaluate, x, p.bounds, options);
  p.free.put(x, from.values);
  return {std::move(from), huber, std::move(solution), false, data.groups, data.counts.samples};
}

template Fitted minimise(const Problem&, const FitData<float>&, BoundModel, double);
template Fitted minimise(const Problem&, const FitData<double>&, BoundModel, double);

std::optional<Fitted> coarse_fit(const Problem& p, const Sampling& sampling) {
  const auto thin = fit_data<double>(sampling, coarse_samples);
  if (thin.counts.used == 0) return {};
  const auto starts = find_starts(p, thin, no_huber);
  Fitted f = minimise(p, thin, {p.start.model, starts[0].values, {}}, no_huber);
  if (p.options.robust) f = robustly(p, thin, std::move(f));
  return f;
}

std::shared_ptr<const BoundModel> bulk_of(const Problem& p, const Sampling& sampling) {
  if (!p.options.robust || sampling.metric() == Metric::log) return nullptr;
  // An outlier of a factor of a hundred is as far off as 4.6 among logarithms, but as 10⁴ squares
  // among relative errors, whose minimum is then near f = 0.
  auto f = coarse_fit(p, sampling.by(Metric::log, p.offset));
  return f ? std::make_shared<const BoundModel>(std::move(f->model)) : nullptr;
}

double huber_of(std::vector<double> sizes) {
  return sizes.empty() ? no_huber : std::max(1.345 * 1.4826 * median(sizes), 1e-12);
}

Fitted compared_by(const Sampling& s, const Problem& p, std::size_t most, const Fitted& from) {
  const auto thin = fit_data<double>(s, most);
  return p.options.robust ? robustly(p, thin, from) : minimise(p, thin, from.model, no_huber);
}

Searched search(Problem p,
                const Sampling& sampling,
                SharedColumns& columns,
                PhaseTimes& watch,
                const std::function<void(const char*)>& announce) {
  // What has room in the caches is fitted in double at once.
  if (sampling.groups().size() > 8 * middle_samples)
    p.rounding = rounding_in_float(fit_data<double>(sampling, coarse_samples), sampling.channels());
  if (p.rounding == 0) return search_in<double>(p, sampling, columns, watch, announce);
  Searched s = search_in<float>(p, sampling, columns, watch, announce);
  if (s.best.in_float) return s;
  announce("fitting all samples in double");
  s.best = minimise(p, fit_data<double>(sampling), std::move(s.best.model), s.best.huber);
  watch.lap("solve_double_ms");
  return s;
}

}  // namespace gonio
