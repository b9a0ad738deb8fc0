#include "fitting/fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "base/error.h"
#include "brdf/catalogue/registry.h"
#include "brdf/model/evaluate.h"
#include "brdf/model/own_files.h"
#include "brdf/model/presets.h"
#include "brdf/model/spec.h"
#include "fitting/judge/assess.h"
#include "fitting/judge/bin_sensitivity.h"
#include "fitting/judge/bootstrap.h"
#include "fitting/judge/certificate.h"
#include "fitting/judge/describe.h"
#include "fitting/judge/free_scale.h"
#include "fitting/judge/lack_of_fit.h"
#include "fitting/judge/next_steps.h"
#include "fitting/judge/physics.h"
#include "fitting/judge/seen.h"
#include "fitting/judge/stated.h"
#include "fitting/judge/uncertainty.h"
#include "fitting/judge/undetermined.h"
#include "fitting/judge/warnings.h"
#include "fitting/solve/order.h"
#include "fitting/solve/problem.h"
#include "fitting/solve/search.h"
#include "table/format/measured_by.h"
#include "table/health/lost_values.h"
#include "table/health/value_warnings.h"

#include <fmt/format.h>
#include <tbb/task_group.h>

namespace gonio {
namespace {

FitSolver solver_of(const Solution& s, std::vector<std::pair<std::string, double>> phase_ms) {
  return {s.converged ? "converged" : "not_converged",
          s.message,
          s.iterations,
          s.passes,
          s.cost_per_iteration,
          std::string(kernels<double>().instruction_set),
          std::move(phase_ms)};
}

/// Words on the parameter that outliers move most: its value in the robust fit and in this one; "" where no interval shows the move.
std::string without_outliers(const Problem& p,
                             const FitDocument& d,
                             std::span<const double> values,
                             const LackOfFit& l,
                             const Uncertainty& u) {
  constexpr double shows = 0.5;  // of the error, in which the move is
  std::string words;
  double most = shows;
  for (const auto& q : p.start.model.parameters)
    for (std::size_t c = 0; !l.moved_by_outliers.empty() && c < q.count; ++c) {
      const std::size_t slot = q.first + c;
      if (!p.free.mask()[slot]) continue;
      const std::size_t i = p.free.index(slot);
      const double by = l.moved_by_outliers[i], share = std::abs(by) / u[i].std_error;
      if (!(share > most)) continue;
      most = share;
      words = fmt::format(": it finds {} {:.4g} instead of {:.4g}", name_of(q, c, d.channels),
                          values[slot] - by, values[slot]);
    }
  return words;
}

/// Leaves out the changes of values that are not known.
void forget_unknown(BinSensitivity& s, const FitDocument& d) {
  for (auto& [name, change] : s.relative_change) {
    const auto& known = std::ranges::find(d.parameters, name, &FittedParameter::name)->value;
    for (std::size_t c = 0; c < change.size(); ++c)
      if (std::isnan(known[c])) change[c] = known[c];
  }
}

/// Takes a fit of the diffuse terms without the lobes, and its residuals: of lobes that are not known neither those beside them nor
/// their highlights say anything.  Returns its model; none where the cost and the residuals stay those of the model with its lobes.
std::optional<BoundModel> take_diffuse_alone(FitDocument& d,
                                             const Table& t,
                                             FitOptions o,
                                             SharedColumns& columns) {
  const auto diffuse = parse_model(d.model).diffuse;
  if (diffuse.empty() || catalogue()[find_term(diffuse, Role::diffuse)].coupled ||
      find_preset(diffuse))  // as "disney", which alone is the name of a whole model
    return {};
  const std::size_t fixed = o.fixed.size();
  o = options_for(std::move(o), diffuse);
  const bool holds_lobe = o.fixed.size() < fixed;
  o.bin_sensitivity = false;
  o.certificate = Certify::none;
  o.scale = Scale::held;  // the table is at its working scale
  FitResult of_diffuse = fit(t, o, columns);
  FitDocument& alone = of_diffuse.document;
  for (auto& p : alone.parameters) {
    FittedParameter& beside = *std::ranges::find(d.parameters, p.name, &FittedParameter::name);
    for (std::size_t c = 0; c < p.value.size(); ++c) {
      if (p.reason[c].empty()) p.reason[c] = "of a fit without the lobe; the interval holds both";
      // Nobody knows how much of its light is the lobe's.
      p.ci95_low[c] = std::fmin(p.ci95_low[c], beside.ci95_low[c]);
      p.ci95_high[c] = std::fmax(p.ci95_high[c], beside.ci95_high[c]);
    }
    beside = std::move(p);
  }
  d.free_names = std::move(alone.free_names);
  d.correlations = std::move(alone.correlations);
  d.condition = alone.condition;
  if (holds_lobe) return {};  // what it costs to hold it is what was asked
  d.cost = alone.cost;
  d.residuals = std::move(alone.residuals);
  if (alone.misfit.told ||
      !d.misfit.too_few)  // values too few for the model that was asked for say no more of this
    d.misfit = std::move(alone.misfit);
  d.physics = std::move(alone.physics);
  return std::move(of_diffuse.model);
}

/// Worth of the parameters, by values or by clusters of an incident angle.
struct Judged {
  Assessment assessment;
  Uncertainty uncertainty;
  std::vector<double> seen_against;  ///< standard errors of what a misfit is judged against
  std::size_t angles;                ///< incident angles of the table
  std::size_t clusters;  ///< those whose values share their errors; 0: all are independent
  std::string in_words;
};
/// \param stated  whether the residuals are in standard errors that the table states
Judged judge(const Sampling& s, const Problem& p, const Fitted& f, bool stated) {
  const auto asked =
      p.options.intervals == Intervals::bootstrap ? Intervals::automatic : p.options.intervals;
  const auto x = p.free.of(f.model.values);
  const auto errors = [&](const Assessment& a, bool known) {
    return uncertainty(a.sandwich, x, p.bounds, a.counts.samples, known);
  };
  const auto by_value = [&] {
    const bool clips = p.options.robust;  // then not all that was fitted is in the bread
    const ArrowMatrix bread =
        clips ? assess(s, f.model, p.free, f.huber, false, nullptr, f.in_float).sandwich.bread
              : f.solution.at.h;
    const Influences influences(bread, find_determined(bread, x, p.bounds).unknowns);
    return assess(s, f.model, p.free, f.huber, false, &influences, f.in_float);
  };
  const char* const independent = stated ? "stated uncertainties" : "independent values";
  constexpr const char* clustered = "clustered by incident angle";
  if (asked == Intervals::independent || (asked == Intervals::automatic && s.table().truth)) {
    auto a = by_value();
    const auto u = errors(a, stated);
    return {std::move(a), u, u.std_errors(), 0, 0, independent};
  }
  auto a = assess(s, f.model, p.free, f.huber, true, nullptr, f.in_float);
  const std::size_t angles = a.incident_angles;
  if (asked == Intervals::by_angle && angles < 2)
    throw wrong_usage("intervals by_angle: the table has one incident angle");
  auto u = errors(a, false);
  if (asked == Intervals::by_angle || enough_angles(angles))
    return {std::move(a), u, u.std_errors(), angles, angles, clustered};
  const auto values = errors(by_value(), stated);
  if (angles < 2) return {std::move(a), values, values.std_errors(), angles, 0, independent};
  return {std::move(a), wider(std::move(u), values), values.std_errors(), angles, angles,
          clustered};
}

/// Refuses a person's function that has no value where the table has one: no number of such a fit means anything.
void expect_values(const Table& t, const BoundModel& m) {
  if (!names_own_file(to_text(m.model.spec))) return;
  const SampleAngles sample(t);
  std::size_t missing = 0, first = 0;
  std::vector<FrameAngles<double>> angles;
  std::vector<std::size_t> samples;
  constexpr std::size_t block = 4096;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const FrameAngles<double> at = sample.frame(i);
    const auto is_there = [&](const auto& values) { return mask(at, values[i]) == Mask::valid; };
    if (std::ranges::any_of(t.values, is_there)) {
      angles.push_back(at);
      samples.push_back(i);
    }
    if (angles.size() < block && i + 1 < t.size()) continue;
    const auto f = evaluate(m, angles);
    for (std::size_t k = 0; k < samples.size(); ++k)
      if (std::ranges::any_of(f, [&](const auto& c) { return !std::isfinite(c[k]); }) &&
          missing++ == 0)
        first = samples[k];
    angles.clear();
    samples.clear();
  }
  if (missing == 0) return;
  const auto [l, v] = sample.directions(first);
  throw bad_input(
      to_text(m.model.spec), fmt::format("{} of {} samples", missing, t.size()),
      fmt::format("no value, first at θ_i {:.4g}°, θ_o {:.4g}°", std::acos(l.z) / degree,
                  std::acos(v.z) / degree),
      "a number; `gonio audit` names its inputs without one, and --mask leaves samples out");
}

/// \param tries  whether other models are tried, for `next`
FitResult fit_and_judge(const Table& t,
                        const FitOptions& given,
                        SharedColumns& columns,
                        const std::function<void(const char*)>& phase,
                        bool tries) {
  const FitOptions o = expanded(given, t);
  const auto announce = [&](const char* what) {
    if (phase) phase(what);
  };
  Problem p = pose(t, o);
  std::vector<std::pair<std::string, double>> phase_ms;
  PhaseTimes watch(phase_ms);

  const Bins bins = t.bins();
  const bool folded = folds(p);
  std::shared_ptr<const BoundModel> bulk;
  const auto sampling_of = [&](Bins convention, bool fold) {
    Sampling s = sampling_for(p, t, convention, fold);
    s.set_bulk(bulk);
    return s;
  };
  bulk = bulk_of(p, sampling_of(bins, folded));
  const Sampling sampling = sampling_of(bins, folded);
  Searched found = search(p, sampling, columns, watch, announce);
  const auto in_order = put_in_order(p, found.best);
  const Fitted& f = found.best;
  expect_values(t, f.model);

  announce("standard errors");
  // Of few samples and so for one thread, beside what comes next.
  const bool has_other = t.has_bins() && o.bin_sensitivity;
  std::optional<BinSensitivity> sensitivity;
  tbb::task_group meanwhile;
  if (has_other)
    meanwhile.run([&] {
      const Bins other = bins == Bins::centre ? Bins::edge : Bins::centre;
      sensitivity =
          bin_sensitivity(p, found.scanned, sampling, sampling_of(other, folded), other, f);
    });
  const auto beside = beside_stated(sampling, p, f.solution.at.cost, f.values);
  const Judged judged = judge(sampling, p, f, beside && beside->holds);
  const Assessment& a = judged.assessment;
  Uncertainty u = judged.uncertainty;
  watch.lap("errors_ms");
  const bool shared =
      judged.clusters > 0 && (o.intervals == Intervals::by_angle || enough_angles(judged.clusters));
  const auto attempt = [&](const Table& as, const FitOptions& with, const std::string& spec) {
    try {
      const FitOptions other = options_for(with, spec);
      const Problem q = pose(as, other);
      const Sampling s = sampling_for(q, as, bins);
      const auto coarse = coarse_fit(q, s);
      return coarse ? residual_statistics(coarse->model, s, coarse_samples).log_rms : std::nan("");
    } catch (const Error&) {  // not of this table
      return std::nan("");
    }
  };
  std::optional<std::pair<double, std::optional<OtherUnit>>> last;  // asked for, and found
  const auto unit_of = [&](double here) {
    const auto as_given = [&](const Table& as, const FitOptions& with) {
      return attempt(as, with, with.model);
    };
    if (!last || last->first != here) last.emplace(here, other_unit(t, o, here, as_given));
    return last->second;
  };
  TableFacts& table = columns.facts(t);
  LackOfFit lack = lack_of_fit(sampling, p, f, a.counts.samples, table);
  // Scales of single angles are no instrument's where another unit takes up more than they do.
  if (!lack.misfit.told && !lack.gains.empty() && unit_of(attempt(t, o, o.model))) {
    FitOptions independent = o;
    independent.intervals = Intervals::independent;
    const Problem without{independent, p.start, p.free, p.bounds, p.narrowed, p.offset, p.rounding};
    lack = lack_of_fit(sampling, without, f, a.counts.samples, table);
  }
  find_dark_bias(lack, sampling, p, f, u, table);
  if (lack.misfit.told) lack.moved_by_scale = moved_by_scale(t, p, f, a.residuals.log_rms);
  widen(u, lack, judged.seen_against);
  watch.lap("misfit_ms");
  const bool needless = find_undetermined(p, found.scanned, f, a.counts, lack.misfit.told, u,
                                          t.truth ? std::vector<double>() : table.lost_below());
  if (!lack.moved_by_scale.empty()) leave_unbounded_by_scale(p, f.model.values, u);
  keep_to_what_is_seen(table, p, f.model.values, lack.misfit, u);
  watch.lap("limits_ms");
  for (std::size_t i = 0; i < in_order.size(); ++i)
    if (u[i].reason.empty()) u[i].reason = in_order[i];
  std::string in_words = judged.in_words;
  if (o.intervals == Intervals::bootstrap) {
    announce("fits of tables drawn from this one");
    if (bootstrap(sampling_of(bins, false), p, f, shared, lack, judged.seen_against, u))
      in_words = shared ? "bootstrap of incident angles" : "bootstrap of values";
    watch.lap("bootstrap_ms");
  }

  FitDocument d;
  d.model = to_text(p.start.model.spec);
  d.channels = t.channels;
  describe(d, p, f.model.values, u);
  d.metric = name_of(o.metric);
  d.log_offset = sampling.offset();
  d.robust = o.robust ? "huber" : "none";
  d.cost = f.solution.at.cost;
  d.intervals = in_words;
  for (const auto& gains : lack.gains) d.intervals += ", and errors shared by each " + gains.of;
  d.clusters = judged.clusters;
  d.residuals = a.residuals;
  if (beside) d.residuals.chi2_per_freedom = beside->chi2_per_freedom;
  d.uncertainty = t.errors.empty() ? "none" : "stated";
  d.misfit = lack.misfit;
  // Judged on a sample; of all values no more is left than the fit leaves.
  if (d.misfit.told) d.misfit.size = std::fmin(d.misfit.size, d.residuals.log_rms);
  if (lack.outliers && !lack.outliers->retro) d.misfit.outliers = lack.outliers->values;
  d.physics = check_physics(f.model, table, found.scanned);
  watch.lap("physics_ms");
  auto without_lobes = needless ? take_diffuse_alone(d, t, o, columns) : std::nullopt;
  if (t.aperture)
    d.aperture_deg = std::vector{t.aperture.light / degree, t.aperture.detector / degree};
  d.values_used = a.counts.used;
  d.masked = a.counts.by_reason(sampling);
  if (!t.mask.empty()) {
    d.mask = t.mask;
    const auto left_out = d.masked["left_out_by_mask"] = values_left_out(t);
    if (t.grid()) {
      auto& without = d.masked[std::string(name_of(Mask::not_finite))];
      without -= std::min(left_out, without);
    } else {  // samples of a list are gone, whatever else kept them from being used
      for (std::size_t m = 1; m < names_of<Mask>.size(); ++m)
        if (const auto n = values_left_out(t, static_cast<Mask>(m)); n > 0)
          d.masked[std::string(names_of<Mask>[m])] += n;
    }
  }
  d.input_path = t.path;
  d.input_format = t.format;
  d.bins = t.has_bins() ? name_of(bins) : "none";

  meanwhile.wait();
  if (has_other) watch.lap("bin_sensitivity_ms");
  if (sensitivity) {
    forget_unknown(*sensitivity, d);
    d.sensitivity.push_back(std::move(*sensitivity));
  }
  if (found.profile && !without_lobes) d.certificate = certificate_of(p, *found.profile);
  d.solver = solver_of(f.solution, std::move(phase_ms));
  for (const auto& w : t.warnings)
    if (!(d.misfit.reproduces() && is_answered_by_a_fit(w))) d.warnings.push_back(w);
  FitFacts facts{judged.angles, p.free.size(), found.cost_of_fewer, needless};
  std::vector<std::pair<std::size_t, std::string>> guesses;  // of the values' unit
  for (auto& w : value_warnings(table)) {
    if (w.of_scale && o.scale == Scale::free) continue;
    facts.no_f = facts.no_f || w.of_unit;
    facts.no_scale = facts.no_scale || w.of_scale;
    if (!w.guess.empty()) guesses.emplace_back(d.warnings.size(), w.guess);
    d.warnings.push_back(w.text + (o.metric == Metric::l2_cosine ? "" : w.metric));
  }
  facts.odd_angle = lack.odd_angle;
  facts.outliers = lack.outliers;
  facts.dark_bias = lack.dark_bias;
  facts.without_outliers = without_outliers(p, d, f.model.values, lack, u);
  facts.beyond_stated = beside && !beside->holds;
  facts = with_table(std::move(facts), o, table, d);
  for (auto& w : warnings(o, t, d, facts)) d.warnings.push_back(std::move(w));
  if (tries) announce("trying other models");
  bool knows_unit = false;
  d.next = next_steps(
      o, d, facts,
      [&](const std::string& spec) { return tries ? attempt(t, o, spec) : std::nan(""); },
      [&](double left) {
        auto unit = tries ? unit_of(left) : std::nullopt;
        knows_unit = unit.has_value();
        return unit;
      });
  if (!knows_unit)  // else a unit was found that mends the fit
    for (const auto& [k, guess] : guesses) d.warnings[k] += guess;
  return {std::move(d), std::move(found.best.model), std::move(without_lobes)};
}

/// Fit of a table that is known up to one factor.
FitResult fit_free_scale(const Table& t,
                         FitOptions o,
                         const std::function<void(const char*)>& phase,
                         bool tries) {
  o = with_weights(std::move(o));
  double factor = working_factor(t);
  for (int left = 3;; --left) {
    Table scaled = t;
    scale_values(scaled, factor);
    SharedColumns own;
    FitResult result = fit_and_judge(scaled, o, own, phase, tries);
    if (left > 0 && is_scale_too_large(result.model)) {
      factor *= 0.01;
      continue;
    }
    leave_scale_open(result.document, result.model, factor);
    result.without_lobes.reset();  // which is of the working scale
    return result;
  }
}

}  // namespace

FitResult fit(const Table& t, const FitOptions& o, const std::function<void(const char*)>& phase) {
  SharedColumns alone;
  const bool tries = o.certificate != Certify::none;
  return o.scale == Scale::free ? fit_free_scale(t, o, phase, tries)
                                : fit_and_judge(t, o, alone, phase, tries);
}

FitResult fit(const Table& t,
              const FitOptions& o,
              SharedColumns& columns,
              const std::function<void(const char*)>& phase) {
  return o.scale == Scale::free ? fit_free_scale(t, o, phase, false)
                                : fit_and_judge(t, o, columns, phase, false);
}

}  // namespace gonio
