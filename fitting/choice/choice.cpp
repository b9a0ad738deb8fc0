#include "fitting/choice/choice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <memory>
#include <optional>
#include <set>

#include "base/error.h"
#include "brdf/model/column_run.h"
#include "brdf/model/evaluate.h"
#include "brdf/model/presets.h"
#include "brdf/model/roughness.h"
#include "brdf/model/takes_parameter.h"
#include "fitting/choice/cross_validation.h"
#include "fitting/fit.h"
#include "fitting/judge/free_scale.h"
#include "fitting/judge/warnings.h"
#include "fitting/solve/problem.h"
#include "number/distributions.h"
#include "table/format/measured_by.h"
#include "table/health/value_warnings.h"
#include "timing/timing.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {
namespace {

/// Samples that a model is timed over.
constexpr std::size_t timed_samples = 4096;
/// Groups of samples that residuals are summed over.
constexpr std::size_t most_groups = 1 << 17;

/// Free values of a fit.
std::size_t free_values(const FitDocument& d) {
  std::size_t n = 0;
  for (const auto& p : d.parameters) {
    if (is_roughness(p.name)) continue;  // alpha's other name
    n += static_cast<std::size_t>(
        std::ranges::count_if(p.status, [](auto s) { return s != ParameterStatus::fixed; }));
  }
  return n;
}
std::vector<std::string> at_bound(const FitDocument& d) {
  std::vector<std::string> names;
  for (const auto& p : d.parameters)
    if (!is_roughness(p.name) &&
        std::ranges::find(p.status, ParameterStatus::at_bound) != p.status.end())
      names.push_back(p.name);
  return names;
}

std::vector<Timing> times_of(const Table& t, std::span<const BoundModel> models) {
  const SampleAngles at(t);
  std::vector<std::size_t> above;  // below the horizon terms are not defined
  for (std::size_t i = 0; i < t.size(); ++i)
    if (const auto a = at(i); a.nol > 0 && a.nov > 0) above.push_back(i);
  const std::size_t n = std::min(above.size(), timed_samples);
  const std::size_t step = above.size() / n;
  auto x = std::make_shared<AngleColumns<float>>(n, true);
  for (std::size_t i = 0; i < n; ++i) x->set(i, at.frame(above[i * step]));
  std::vector<Timed> all;
  for (const auto& b : models) all.push_back({n, column_run(b, x)});
  TimingOptions options;
  options.of_thread = true;
  return time_all(all, options);
}

/// Mean squares of a model on blocks less those of another: their mean, and the standard error of it.
struct Behind {
  double mean, error;
};
Behind behind(const std::vector<LogResiduals>& a, const std::vector<LogResiduals>& best) {
  std::vector<double> d;
  for (std::size_t b = 0; b < a.size(); ++b)
    if (a[b].values > 0) d.push_back((a[b].squares - best[b].squares) / a[b].values);
  const auto n = static_cast<double>(d.size());
  double mean = 0, squares = 0;
  for (const double x : d) mean += x / n;
  for (const double x : d) squares += (x - mean) * (x - mean);
  return {mean, std::sqrt(squares / (n * std::max(n - 1, 1.0)))};
}

void check_settings(const FitOptions& o, std::span<const std::string> models) {
  const auto check = [&](const std::string& name) {
    if (std::ranges::none_of(models, [&](const auto& m) { return takes_parameter(m, name); }))
      throw wrong_usage(fmt::format("none of the models has a parameter '{}'", name));
  };
  for (const auto* settings : {&o.fixed, &o.bounds})
    for (const auto& s : *settings) check(s.name);
  for (const auto& name : o.grey) check(name);
}

/// True of a model that its fit tells to miss the table, where another is nearer of which that is not told: however little held-out
/// angles tell them apart.
bool is_refuted(const ModelRow& r, const std::vector<ModelRow>& all) {
  return r.misses && std::ranges::any_of(all, [&](const ModelRow& other) {
           return other.compared && !other.misses && other.log_rms < r.log_rms;
         });
}

template <class Of>
const ModelRow* least(const std::vector<ModelRow>& rows, Of of) {
  const ModelRow* best = nullptr;
  for (const auto& r : rows)
    if (!std::isnan(of(r)) && (!best || of(r) < of(*best))) best = &r;
  return best;
}

}  // namespace

std::span<const std::string_view> usual_models() {
  static constexpr std::array<std::string_view, 15> all{
      "lambert",
      "oren_nayar",
      "eon",
      "lambert+ggx/smith_ggx.correlated/schlick",
      "lambert+ggx/smith_ggx.correlated/schlick.f90",
      "lambert+beckmann/smith_beckmann.correlated/schlick",
      "lambert+gtr/smith_ggx.correlated/schlick",
      "lambert+ggx_aniso/smith_ggx_aniso.correlated/schlick",
      "lambert.coupled+ggx/smith_ggx.correlated/dielectric",
      "disney.coupled+ggx/smith_ggx.correlated/dielectric",
      "lambert+charlie/smith_charlie.correlated/schlick",
      "ggx/smith_ggx.correlated/schlick",
      "ggx/smith_ggx.correlated/conductor",
      "lambert+ggx/smith_ggx.correlated/schlick+ggx/smith_ggx.correlated/schlick",
      "lambert+ggx/smith_ggx.correlated/schlick.weighted+ggx/smith_ggx.correlated/"
      "schlick.weighted"};
  return all;
}

std::string floor_in_words(const ModelChoice& choice) {
  return choice.log_offset > 0
             ? fmt::format(
                   "Log RMS counts from {:.3g} 1/sr, the log metric's offset. A fit's own typical "
                   "factor has no offset: it counts small values, and their noise, in full.",
                   choice.log_offset)
             : "";
}

std::vector<std::string> models_asked(std::vector<std::string> models) {
  std::set<std::string_view> met;
  for (const auto& m : models)
    if (!met.insert(m).second) throw wrong_usage(fmt::format("--models: '{}' is there twice", m));
  const auto usual = usual_models();
  if (const auto all = std::ranges::find(models, "all"); all != models.end()) {
    models.erase(all);
    std::erase_if(models,
                  [&](const auto& m) { return std::ranges::find(usual, m) != usual.end(); });
    models.insert(models.begin(), usual.begin(), usual.end());
  }
  for (const auto& m : models) {  // a word that nobody knows is wrong usage, whatever the table
    std::vector<Setting> none;
    compose(resolve_preset(parse_model(m), none), 1);
  }
  return models;
}

ModelChoice compare_models(const Table& t,
                           const FitOptions& options,
                           std::span<const std::string> models,
                           const std::function<void(const std::string&, double)>& progress) {
  ModelChoice choice;
  std::vector<std::vector<LogResiduals>> left_out(models.size());
  std::vector<ResidualsByAngle> residuals(models.size());
  std::optional<Blocks> blocks;
  SharedColumns columns;
  std::exception_ptr refused;  // the first
  check_settings(options, models);
  double step = 1;  // samples of the table for one whose residual is looked at
  const auto share = [&](double steps) { return steps / (2 * static_cast<double>(models.size())); };
  for (std::size_t k = 0; k < models.size(); ++k) {
    ModelRow row;
    row.model = models[k];
    choice.fits.emplace_back();
    try {
      const FitOptions o = options_for(options, models[k]);
      if (progress) progress("fitting " + row.model, share(2.0 * static_cast<double>(k)));
      FitResult fitted = fit(t, o, columns);
      const FitDocument& d = fitted.document;
      row.compared = true;
      row.converged = d.solver.termination == "converged";
      if (!row.converged) row.note = "the fit did not converge";
      row.parameters = free_values(d);
      if (d.values_used <= row.parameters)
        throw bad_input(t.path, "values", fmt::format("{} that a fit can use", d.values_used),
                        fmt::format("more than the model's {} free parameters", row.parameters));
      row.parameters_at_bound = at_bound(d);
      row.misses = d.misfit.told;
      if (progress)
        progress("leaving out angles of " + row.model, share(2.0 * static_cast<double>(k) + 1));
      const FitOptions whole = expanded(o, t);
      const Problem p = pose(t, whole);
      const Sampling by_log = sampling_for(p, t, t.bins()).by(Metric::log, p.offset);
      residuals[k] = log_residuals(by_log, fitted.model, most_groups);
      step = static_cast<double>(Tasks::step_to(by_log.groups().size(), most_groups));
      row.log_rms = total(residuals[k]).rms();
      choice.log_offset = by_log.offset();
      if (!blocks) blocks = incident_blocks(by_log);
      left_out[k] = cross_validate(t, p, *blocks, fitted.model);
      if (blocks->count > 0) {
        LogResiduals unseen;
        for (const auto& b : left_out[k]) unseen.add(b);
        if (!left_out[k].empty()) row.cv_log_rms = unseen.rms();
      }
      choice.fits.back() = std::move(fitted.model);
    } catch (const Error& e) {
      if (!refused) refused = std::current_exception();
      row = {};
      row.model = models[k];
      row.note = e.what();
    }
    choice.rows.push_back(std::move(row));
  }
  choice.blocks = blocks ? blocks->count : 0;
  for (const auto& w : t.warnings)
    if (!(is_answered_by_a_fit(w) &&
          std::ranges::any_of(choice.rows, [](const auto& r) { return r.compared && !r.misses; })))
      choice.warnings.push_back(w);
  for (auto& w : value_warnings(columns.facts(t))) {
    if (options.metric == Metric::l2_cosine) w.metric.clear();
    choice.warnings.push_back(w.whole());
  }
  auto& rows = choice.rows;
  if (refused && std::ranges::none_of(rows, &ModelRow::compared)) std::rethrow_exception(refused);
  const ModelRow* nearest = least(rows, [](const auto& r) { return r.log_rms; });
  if (!nearest) return choice;
  const auto index = [&](const ModelRow* r) { return static_cast<std::size_t>(r - rows.data()); };
  choice.effective_values = effective_values(residuals[index(nearest)], step);
  const ModelRow* best = least(rows, [](const auto& r) { return r.cv_log_rms; });
  std::vector<BoundModel> timed;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    auto& r = rows[k];
    if (!r.compared) continue;
    timed.push_back(choice.fits[k]);
    const double n = choice.effective_values, p = static_cast<double>(r.parameters);
    const double fit_of = 2 * n * std::log(r.log_rms);
    r.aic = fit_of + 2 * p;
    r.bic = fit_of + p * std::log(n);
    if (!best || left_out[k].empty()) continue;
    const auto b = behind(left_out[k], left_out[index(best)]);
    r.cv_behind = b.mean > 0 ? b.mean / b.error : 0;
  }
  const auto times = times_of(t, timed);
  std::size_t next = 0;
  for (auto& r : rows) {
    if (!r.compared) continue;
    r.ns = times[next].ns, r.ns_spread = times[next].spread_ns;
    ++next;
  }
  return choice;
}

ModelChoice compare_on_scale(Table& t,
                             const FitOptions& options,
                             std::vector<std::string> models,
                             const std::function<void(const std::string&, double)>& progress) {
  if (options.scale == Scale::held) return compare_models(t, options, models, progress);
  FitOptions o = options;
  scale_values(t, working_factor(t));
  models = with_weights(o, models);
  o.scale = Scale::held;
  ModelChoice choice = compare_models(t, o, models, progress);
  choice.warnings.insert(choice.warnings.begin(),
                         "the scale is free: values are multiplied by a factor that makes the "
                         "table dark, and lobes have weights; ΔE is of that");
  return choice;
}

Advice advise(const ModelChoice& choice) {
  Advice a;
  const bool any_converged = std::ranges::any_of(choice.rows, &ModelRow::converged);
  std::vector<ModelRow> rows;
  for (const auto& r : choice.rows)
    if ((r.converged || !any_converged) && !is_refuted(r, choice.rows)) rows.push_back(r);
  const auto cv = [](const ModelRow& r) { return r.cv_log_rms; };
  const auto bic = [](const ModelRow& r) { return r.bic; };
  const ModelRow* best = least(rows, cv);
  const bool predicted = best != nullptr;
  if (!predicted) best = least(rows, bic);
  if (!best) return a;
  const double errors_behind =
      choice.blocks < 2 ? 2 : students_t_quantile(0.975, static_cast<double>(choice.blocks - 1));
  const double by_chance =
      choice.effective_values > 0
          ? std::min(most_more_by_chance, errors_behind / std::sqrt(2 * choice.effective_values))
          : 0;
  const auto judge = [&](const ModelRow& r) { return predicted ? cv(r) : bic(r); };
  const auto as_good = [&](const ModelRow& r) {
    if (std::isnan(judge(r))) return false;
    if (!predicted) return r.bic <= best->bic + 2;
    constexpr double rounding = 1e-6;  // of a log RMS: below it no model is better than another
    const double least = std::max(best->cv_log_rms, rounding);
    const double more = std::max(r.cv_log_rms, rounding) / least - 1;
    if (more == 0) return true;
    if (r.bic > best->bic + decisive_bic) return false;
    return more <= next_to_nothing_more ||
           (more <= std::max(most_more, by_chance) && r.cv_behind <= errors_behind);
  };
  const ModelRow* take = best;
  for (const auto& r : rows)
    if (as_good(r) && std::pair(r.parameters, judge(r)) < std::pair(take->parameters, judge(*take)))
      take = &r;
  a.recommended = take->model;
  a.none_fits = std::ranges::all_of(rows, &ModelRow::misses);
  for (const auto& r : rows)
    if (&r != take && as_good(r)) a.as_good.push_back(r.model);
  if (!predicted)
    a.reason = fmt::format(
        "The table has too few incident angles to leave some out, so BIC decides: it is least for "
        "{}.",
        take->model);
  else if (take == best && std::ranges::any_of(choice.rows, [&](const ModelRow& r) {
             return is_refuted(r, choice.rows) && r.cv_log_rms < take->cv_log_rms;
           }))
    a.reason = fmt::format(
        "Models that are nearer on incident angles held out of their fits miss the whole table by "
        "more than its noise. Of the others {} is nearest: there it is typically off by a factor "
        "of {}.",
        take->model, typical_factor(take->cv_log_rms));
  else if (take == best)
    a.reason = fmt::format(
        "On incident angles held out of its fit, {} is nearest to the table: there it is typically "
        "off by a factor of {}.",
        take->model, typical_factor(take->cv_log_rms));
  else
    a.reason = fmt::format(
        "{} has the fewest parameters of the {} that the table cannot tell apart: on incident "
        "angles held out of its fit it is typically off by a factor of {}, the nearest by {}.",
        take->model, a.as_good.size() + 1, typical_factor(take->cv_log_rms),
        typical_factor(best->cv_log_rms));
  if (a.none_fits) a.reason = "Every model misses the table by more than its noise. " + a.reason;
  const auto disagrees = [&](const char* judge_name, auto of, double by, auto text) {
    const ModelRow* other = least(rows, of);
    if (!other || other == take || std::isnan(of(*take)) || of(*take) <= of(*other) + by) return;
    if (std::ranges::find(a.as_good, other->model) != a.as_good.end()) return;
    a.disagreement.push_back(
        fmt::format("{} prefers {}{}.", judge_name, other->model, text(of(*other), of(*take))));
  };
  if (predicted)
    disagrees("BIC", bic, 2,
              [](double other, double taken) { return fmt::format(", by {:.0f}", taken - other); });
  disagrees(
      "The colour of a rendered sphere", [](const auto& r) { return r.delta_e_itp; }, 0.5,
      [](double other, double taken) {
        return fmt::format(": its ΔE_ITP is {:.2g} and not {:.2g}", other, taken);
      });
  if (take->log_rms > far_off)
    a.beware.push_back(fmt::format("It is not near the table: typically off by a factor of {:.3g}.",
                                   std::exp(take->log_rms)));
  if (!take->parameters_at_bound.empty())
    a.beware.push_back(
        fmt::format("{} {}: the model lacks something.", fmt::join(take->parameters_at_bound, ", "),
                    take->parameters_at_bound.size() == 1 ? "is at the end of its range"
                                                          : "are at the ends of their ranges"));
  return a;
}

}  // namespace gonio
