#include "fitting/plan/plan_next.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "base/error.h"
#include "fitting/fit.h"
#include "fitting/judge/assess.h"
#include "fitting/judge/describe.h"
#include "fitting/judge/warnings.h"
#include "fitting/plan/candidates.h"
#include "fitting/plan/forecast.h"
#include "fitting/sample/model_blocks.h"
#include "fitting/solve/matrix.h"
#include "fitting/solve/problem.h"
#include "integrate/aperture/mean_values.h"

#include <fmt/format.h>

namespace gonio {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t most_channels = 4;  ///< that are looked at
constexpr double most_followed = 2048;    ///< values of a table that are followed one by one
constexpr double next_to_nothing = 0.01;  ///< of a range
constexpr double least_between_deg = 2;   ///< directions of a plan, [°]
constexpr double worth_it = 0.999;  ///< of a width: a direction that leaves more does not narrow it

/// Table with some of its channels, evenly spread, where it has many.
std::optional<Table> with_few_channels(const Table& t) {
  if (t.channels.size() <= most_channels) return {};
  Table few = t;
  few.channels.clear();
  few.values.clear();
  few.errors.clear();
  few.between = {};
  for (std::size_t k = 0; k < most_channels; ++k) {
    const std::size_t c = k * (t.channels.size() - 1) / (most_channels - 1);
    few.channels.push_back(t.channels[c]);
    few.values.push_back(t.values[c]);
    if (!t.errors.empty()) few.errors.push_back(t.errors[c]);
  }
  return few;
}

/// One unknown of the fit.
struct Unknown {
  std::size_t free;  ///< number among the free slots
  std::string name;
  double scale;  ///< that its width is compared over
  double std_error, width;
};

/// Unknowns that a plan can narrow.
std::vector<Unknown> unknowns_of(const FitResult& r, const Problem& p) {
  std::vector<Unknown> all;
  for (const auto& q : p.start.model.parameters) {
    const auto& known = *std::ranges::find(r.document.parameters, q.name, &FittedParameter::name);
    for (std::size_t c = 0; c < q.count; ++c) {
      const auto status = known.status[c];
      if (status == ParameterStatus::fixed) continue;
      const std::size_t i = p.free.index(q.first + c);
      const double low = p.bounds.low[i], high = p.bounds.high[i],
                   value = r.model.values[q.first + c];
      Unknown u{i, name_of(q, c, r.document.channels),
                std::max(std::abs(value), next_to_nothing * (high - low)), known.std_error[c],
                known.ci95_high[c] - known.ci95_low[c]};
      if (status == ParameterStatus::upper_limit) u.width = known.limit[c] - low;
      if (status == ParameterStatus::lower_limit) u.width = high - known.limit[c];
      all.push_back(std::move(u));
    }
  }
  return all;
}

/// Derivatives of a table's residuals by the unknowns in their scales, over the noise: sample by sample.  A value that counts as
/// several is one of theirs that often.
std::vector<SampleRows> rows_of(const Sampling& s,
                                const Problem& p,
                                const BoundModel& model,
                                const std::vector<Unknown>& unknowns,
                                double noise) {
  std::vector<Index> column(p.free.size(), -1);
  for (std::size_t k = 0; k < unknowns.size(); ++k) column[unknowns[k].free] = index(k);
  ModelBlocks<double> look(s, model, p.free.mask());
  std::vector<SampleRows> all;
  BlockReader<double> in(s, 0, s.groups().size());
  while (in.next()) {
    const std::size_t first = all.size();
    all.resize(first + in.size(), SampleRows::Zero(index(s.channels()), index(unknowns.size())));
    look.run(in, [&](std::size_t c) {
      const double *const weight = in.values(0, c).weight.data(), *const slope = look.slope();
      for (const auto& [slot, by] : look.channel(c).d) {
        const Index k = column[p.free.index(slot)];
        if (k < 0) continue;
        const double scale = unknowns[static_cast<std::size_t>(k)].scale / noise;
        for (std::size_t i = 0; i < in.size(); ++i)
          if (weight[i] > 0) all[first + i](index(c), k) = scale * weight[i] * slope[i] * by[i];
      }
    });
    for (std::size_t i = 0, n = in.size(); i < n; ++i) {
      const double count = s.count_of(in.sample(0)[i]);
      if (!(count > 1)) continue;
      all[first + i] /= std::sqrt(count);
      for (double k = 1; k < count; ++k) all.push_back(all[first + i]);
    }
  }
  return all;
}

/// Table as this one of directions where the model is taken for measured.
Table as_measured(const DirectionList& where, const BoundModel& model, const Table& like) {
  Table t;
  t.channels = like.channels;
  t.aperture = like.aperture;
  t.where = where;
  const std::size_t n = where.theta_i_deg.size();
  t.values.assign(t.channels.size(), Values(n));
  const SampleAngles at(t);
  std::vector<Angles<double>> angles;
  for (std::size_t i = 0; i < n; ++i) angles.push_back(at(i));
  const auto seen = aperture_angles(t, t.bins(), model.model.anisotropic);
  const auto f = seen ? mean_values(model, *seen, 0, n) : evaluate(model, angles);
  for (std::size_t c = 0; c < f.size(); ++c) std::ranges::copy(f[c], t.values[c].begin());
  if (!like.errors.empty()) {  // as uncertain as the table's values typically are
    const double part = typical_uncertainty(like);
    t.errors = t.values;
    for (auto& plane : t.errors)
      for (double& u : plane) u = std::max(part * u, 1e-300);
  }
  return t;
}

/// True of pairs that an instrument, or a reciprocal surface, hardly tells apart: they would share what is wrong there.
bool is_near(const DirectionPair& a, const DirectionPair& b) {
  const double apart = std::cos(least_between_deg * degree);
  const auto alike = [&](const Direction& x, const Direction& y) { return dot(x, y) > apart; };
  // Mirrored at the plane of incidence, too: there a surface without a tangent has one value.
  const auto mirrored = [](const Direction& d) { return Direction{d.x, -d.y, d.z}; };
  const auto turned = [](const DirectionPair& p) {  // the second one's azimuth as phi_i = 0 has it
    return DirectionPair{direction(theta_of(p.wo), 0), direction(theta_of(p.wi), phi_of(p.wo))};
  };
  const auto same = [&](const DirectionPair& x) {
    return alike(a.wi, x.wi) && (alike(a.wo, x.wo) || alike(a.wo, mirrored(x.wo)));
  };
  return same(b) || same(turned(b));
}

/// Choice among candidates by the forecast.
class Planner {
 public:
  /// \param candidates  derivatives of each, and \p where it lies
  /// \param range       of each unknown, in its scale
  Planner(const Forecast& forecast,
          const std::vector<SampleRows>& candidates,
          std::vector<DirectionPair> where,
          VectorXd range)
      : forecast_(forecast),
        candidates_(candidates),
        where_(std::move(where)),
        range_(std::move(range)) {}

  std::vector<std::size_t> choose(std::size_t n) const {
    std::vector<std::size_t> chosen;
    while (chosen.size() < n) {
      const VectorXd now = unknown_first(forecast_.told_widths(samples(chosen)));
      std::optional<std::size_t> next;
      for (const Index k : widest_first(now)) {
        const Best best = best_with(chosen, [&](const VectorXd& w) { return w[k]; });
        const bool helps = best.if_alike < worth_it * now[k];
        // What so few values know that the fit tells no more by one of them begins with the one
        // that knows most.
        if (!next || helps) next = best.score < now[k] ? best.which : best.by_variance;
        if (helps) break;
      }
      chosen.push_back(*next);
    }
    exchange(chosen);
    return chosen;
  }

  std::vector<const SampleRows*> samples(std::span<const std::size_t> chosen) const {
    std::vector<const SampleRows*> all;
    for (const std::size_t c : chosen) all.push_back(&candidates_[c]);
    return all;
  }
  /// Unknowns by their widths; those that are as wide as their range come first.
  std::vector<Index> widest_first(const VectorXd& widths) const {
    const VectorXd w = unknown_first(widths);
    std::vector<Index> all(static_cast<std::size_t>(w.size()));
    std::iota(all.begin(), all.end(), Index{0});
    std::ranges::stable_sort(all, [&](Index i, Index k) { return w[i] > w[k]; });
    return all;
  }
  bool tells_nothing(const VectorXd& widths, Index k) const { return !(widths[k] < range_[k]); }

 private:
  struct Best {
    double score = std::numeric_limits<double>::infinity();
    std::size_t which = 0;
    double if_alike = std::numeric_limits<double>::infinity();  ///< score by the variances alone
    std::size_t by_variance = 0;                                ///< candidate of that
  };

  /// Widths, those that are as wide as their range beyond all others.
  VectorXd unknown_first(const VectorXd& widths) const {
    constexpr double wider_than_all = 1e3;
    VectorXd w = widths;
    for (Index k = 0; k < w.size(); ++k)
      if (tells_nothing(widths, k)) w[k] = std::isnan(w[k]) ? 1e300 : wider_than_all * w[k];
    return w;
  }

  /// Candidate with the least score beside the others, none of which it may be: of all candidates by their variances alone, of the most promising
  /// by the forecast.
  template <class Score>
  Best best_with(std::span<const std::size_t> others, const Score& score) const {
    constexpr std::size_t promising = 48;
    auto all = samples(others);
    const Eigen::MatrixXd v = forecast_.covariance(all);
    const VectorXd told = forecast_.told_widths(all).array() / v.diagonal().array().sqrt();
    std::vector<std::pair<double, std::size_t>> rough;
    const auto look = [&](const auto& passed_over) {
      for (std::size_t c = 0; c < candidates_.size(); ++c) {
        if (passed_over(c)) continue;
        const VectorXd after = Forecast::variances_after(v, candidates_[c]);
        rough.emplace_back(score(unknown_first(told.array() * after.array().sqrt())), c);
      }
    };
    look([&](std::size_t c) {
      return std::ranges::any_of(others,
                                 [&](std::size_t o) { return is_near(where_[c], where_[o]); });
    });
    if (rough.empty())  // so many directions that they must lie close together
      look([&](std::size_t c) { return std::ranges::find(others, c) != others.end(); });
    const std::size_t few = std::min(promising, rough.size());
    std::partial_sort(rough.begin(), rough.begin() + static_cast<std::ptrdiff_t>(few), rough.end());
    Best best{.if_alike = rough.front().first, .by_variance = rough.front().second};
    all.push_back(nullptr);
    for (std::size_t k = 0; k < few; ++k) {
      all.back() = &candidates_[rough[k].second];
      const double s = score(unknown_first(forecast_.told_widths(all)));
      if (s < best.score) best.score = s, best.which = rough[k].second;
    }
    return best;
  }

  void exchange(std::vector<std::size_t>& chosen) const {
    const auto widest = [](const VectorXd& w) { return w.maxCoeff(); };
    constexpr int most_passes = 4;
    double now = widest(unknown_first(forecast_.told_widths(samples(chosen))));
    bool moved = true;
    for (int pass = 0; moved && pass < most_passes; ++pass) {
      moved = false;
      for (auto& c : chosen) {
        std::vector<std::size_t> others;
        for (const auto& o : chosen)
          if (&o != &c) others.push_back(o);
        const Best best = best_with(others, widest);
        if (!(best.score < worth_it * now)) continue;
        c = best.which;
        now = best.score;
        moved = true;
      }
    }
  }

  const Forecast& forecast_;
  const std::vector<SampleRows>& candidates_;
  std::vector<DirectionPair> where_;
  VectorXd range_;
};

}  // namespace

std::vector<NextDirection> plan_next(const Table& whole,
                                     const FitOptions& given,
                                     std::size_t n,
                                     const std::function<void(const char*)>& phase) {
  const auto few = with_few_channels(whole);
  const Table& t = few ? *few : whole;
  const FitOptions o = expanded(given, t);
  const Problem p = pose(t, o);
  if (p.free.size() == 0)
    throw wrong_usage(
        fmt::format("no parameter of '{}' is free: there is nothing to plan for", given.model));
  if (p.start.model.anisotropic)
    throw wrong_usage(
        fmt::format("model '{}' is anisotropic: plans are for isotropic ones", given.model));
  const FitResult r = fit(t, given, phase);
  if (phase) phase("planning");
  const Sampling s = sampling_for(p, t, t.bins());
  const Assessment a = assess(s, r.model, p.free, no_huber, false);
  const auto unknowns = unknowns_of(r, p);
  const double freedom = a.counts.samples - static_cast<double>(p.free.size());
  if (freedom < 1)
    throw bad_input(
        t.path, "values", fmt::format("{} that a fit can use", a.counts.used),
        fmt::format(
            "more than the model's {} free parameters: the residuals of a fit show the noise",
            p.free.size()));
  if (r.document.solver.termination != "converged")
    throw Error(Exit::not_converged,
                fmt::format("{}: the fit of '{}' did not converge: nothing can be planned by it",
                            t.path, given.model));
  const double misfit = r.document.misfit.told ? r.document.misfit.size : 0;
  if (2 * misfit * misfit >
      std::pow(r.document.residuals.log_rms, 2)) {  // more than there is noise
    FitOptions again = given;
    again.certificate = Certify::automatic;
    const auto next = fit(t, again, phase).document.next;
    throw bad_input(t.path, "fit",
                    fmt::format("a model that misses the table by a factor of {} beyond noise",
                                typical_factor(misfit)),
                    "one that fits: no further direction mends that" +
                        (next.empty() ? "" : " (try " + next.front() + ")"));
  }
  if (unknowns.empty())
    throw bad_input(
        t.path, "fit",
        fmt::format("every parameter of '{}' pushed against the end of its range", given.model),
        "one that more values could tell");

  const auto& bread = a.sandwich.bread;
  double signal = 0;  // of the residuals, by any parameter's whole range
  for (std::size_t i = 0; i < p.free.size(); ++i)
    signal = std::max(signal, bread(i, i) * std::pow(p.bounds.high[i] - p.bounds.low[i], 2));
  constexpr double rounding = 1e-14;
  const double noise =
      std::sqrt(std::max(2 * r.document.cost / freedom, rounding * signal / a.counts.samples));

  const Index size = index(unknowns.size());
  FitSoFar so_far{Eigen::MatrixXd(size, size),
                  {},
                  VectorXd(size),
                  VectorXd(size),
                  VectorXd(size),
                  freedom,
                  r.document.misfit.told || r.document.clusters > 0};
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    const auto& u = unknowns[i];
    so_far.range[index(i)] = (p.bounds.high[u.free] - p.bounds.low[u.free]) / u.scale;
    so_far.std_error[index(i)] = u.std_error / u.scale;
    so_far.width[index(i)] = u.width / u.scale;
    for (std::size_t k = 0; k < unknowns.size(); ++k)
      so_far.information(index(i), index(k)) =
          bread(u.free, unknowns[k].free) * u.scale * unknowns[k].scale / (noise * noise);
  }
  if (a.counts.samples <= most_followed) so_far.values = rows_of(s, p, r.model, unknowns, noise);
  const VectorXd range = so_far.range;
  VectorXd widths = so_far.width;
  const Forecast forecast(std::move(so_far));

  const DirectionList where = candidates(is_in_plane_of_incidence(t));
  const Table measured = as_measured(where, r.model, t);
  const auto rows =
      rows_of(sampling_for(p, measured, measured.bins()), p, r.model, unknowns, noise);
  std::vector<DirectionPair> pairs;
  for (std::size_t i = 0; i < where.theta_i_deg.size(); ++i)
    pairs.push_back({direction(where.theta_i_deg[i] * degree, 0),
                     direction(where.theta_o_deg[i] * degree, where.phi_o_deg[i] * degree)});
  const Planner planner(forecast, rows, std::move(pairs), range);
  auto left = planner.choose(n);

  std::vector<NextDirection> next;
  std::vector<std::size_t> taken;
  const auto width_of = [&](Index k) {
    return planner.tells_nothing(widths, k)
               ? nan
               : widths[k] * unknowns[static_cast<std::size_t>(k)].scale;
  };
  while (!left.empty()) {
    const Eigen::MatrixXd v = forecast.covariance(planner.samples(taken));
    // The widest that one of them narrows, by the one that does so most.
    std::optional<Index> widest;
    auto best = left.begin();
    for (const Index k : planner.widest_first(widths)) {
      const auto variance_after = [&](std::size_t c) {
        return Forecast::variances_after(v, rows[c])[k];
      };
      const auto found = std::ranges::min_element(left, {}, variance_after);
      const bool helps = variance_after(*found) < worth_it * worth_it * v(k, k);
      if (!widest || helps) widest = k, best = found;
      if (helps) break;
    }
    auto& d = next.emplace_back();
    d.theta_i_deg = where.theta_i_deg[*best];
    d.theta_o_deg = where.theta_o_deg[*best];
    d.phi_o_deg = where.phi_o_deg[*best];
    d.parameter = unknowns[static_cast<std::size_t>(*widest)].name;
    d.over = unknowns[static_cast<std::size_t>(*widest)].scale;
    d.width_before = width_of(*widest);
    taken.push_back(*best);
    left.erase(best);
    const VectorXd after = forecast.widths(planner.samples(taken));
    // A fit that was lucky tells less than its noise makes: no measurement widens that.
    for (Index k = 0; k < size; ++k)
      widths[k] = std::isnan(widths[k]) ? after[k] : std::min(widths[k], after[k]);
    d.width_after = width_of(*widest);
  }
  return next;
}

}  // namespace gonio
