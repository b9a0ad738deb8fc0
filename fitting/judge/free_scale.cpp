#include "fitting/judge/free_scale.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "base/error.h"
#include "brdf/model/evaluate.h"
#include "brdf/model/spec.h"
#include "fitting/judge/assess.h"
#include "fitting/judge/uncertainty.h"
#include "fitting/solve/problem.h"
#include "geometry/half_difference.h"
#include "table/format/measured_by.h"

#include <fmt/format.h>

namespace gonio {
namespace {

/// True of kd, weight, and those of another lobe.
bool is_linear(const std::string& name) {
  const auto of_term = parse_parameter(name).name;
  return of_term == "kd" || of_term == "weight";
}

void multiply(BoundModel& b, double factor) {
  for (const auto& p : b.model.parameters)
    if (is_linear(p.name))
      for (std::size_t c = 0; c < p.count; ++c) b.values[p.first + c] *= factor;
}

/// A value that the factor is on.
struct Linear {
  std::string name;
  double value, relative_error, t;
};

}  // namespace

FitOptions with_weights(FitOptions o) {
  const std::string model = o.model;
  for (const auto* settings : {&o.fixed, &o.bounds})
    for (const auto& s : *settings)
      if (is_linear(s.name))
        throw wrong_usage(fmt::format("scale free: found {} given, expected it open", s.name));
  ModelSpec weighted = compose(model, 1).spec;
  for (auto& lobe : weighted.lobes)
    if (!lobe.fresnel.ends_with(".weighted")) lobe.fresnel += ".weighted";
  const auto refuse = [&] {
    return wrong_usage(fmt::format(
        "scale free: found model '{}', expected a diffuse term that is linear in kd, and lobes "
        "with a Fresnel term that has a .weighted form (schlick, dielectric, conductor)",
        model));
  };
  try {
    const BoundModel whole = bind_model(weighted, {}, 1);
    BoundModel half = whole;
    multiply(half, 0.5);
    for (const double theta : {0.1, 0.7, 1.3}) {
      const std::vector a{frame_angles({direction(theta, 0), direction(0.5, 2.5)})};
      const double f = evaluate(whole, a)[0][0];
      constexpr double rounding = 1e-9;
      if (!(std::abs(evaluate(half, a)[0][0] - f / 2) <= rounding * f)) throw refuse();
    }
  } catch (const Error&) {
    throw refuse();
  }
  return options_for(std::move(o), to_text(weighted));
}

std::vector<std::string> with_weights(const FitOptions& o, std::span<const std::string> models) {
  std::vector<std::string> all;
  std::optional<Error> refused;
  for (const auto& model : models) try {
      FitOptions of = o;
      of.model = model;
      of = with_weights(std::move(of));
      if (std::ranges::find(all, of.model) == all.end()) all.push_back(of.model);
    } catch (const Error& e) {
      refused = e;
    }
  if (all.empty() && refused) throw Error(*refused);
  return all;
}

std::vector<double> moved_by_scale(const Table& t, const Problem& p, const Fitted& f, double here) {
  constexpr double far_less = 0.5;
  if (!t.list() || t.truth || p.options.scale == Scale::free) return {};
  try {
    Table scaled = t;
    scale_values(scaled, working_factor(t));
    const FitOptions weighted = with_weights(p.options);  // which the problem refers to
    const Problem q = pose(scaled, weighted);
    const Sampling s = sampling_for(q, scaled, t.bins());
    const auto open = coarse_fit(q, s);
    if (!open || !(residual_statistics(open->model, s, coarse_samples).log_rms < far_less * here))
      return {};
    std::vector<double> moved(p.free.size());
    for (const auto& a : p.start.model.parameters) {
      const auto* b = q.start.model.find(a.name);
      for (std::size_t c = 0; b && !is_linear(a.name) && c < a.count; ++c)
        if (p.free.mask()[a.first + c])
          moved[p.free.index(a.first + c)] =
              open->model.values[b->first + c] - f.model.values[a.first + c];
    }
    return moved;
  } catch (const Error&) {  // its lobes have no weights
    return {};
  }
}

void leave_unbounded_by_scale(const Problem& p, std::span<const double> values, Uncertainty& u) {
  for (const auto& q : p.start.model.parameters)
    for (std::size_t s = q.first; is_linear(q.name) && s < q.first + q.count; ++s) {
      if (!p.free.mask()[s]) continue;
      const std::size_t i = p.free.index(s);
      auto& v = u[i];
      if (v.status != ParameterStatus::free) continue;
      v.low = p.bounds.low[i], v.high = p.bounds.high[i];
      v.leave_unbounded("at this scale", p.bounds.at_end(i, values[s]),
                        "the model meets the table better at another");
    }
}

double working_factor(const Table& t) {
  constexpr double small = 0.01;  // albedo of the brightest channel away from its highlight
  double brightest = 0;
  for (const auto& plane : t.values)
    brightest = std::max(brightest, typical_value(plane).value_or(0));
  return brightest > 0 ? small / (std::numbers::pi * brightest) : 1;
}

bool is_scale_too_large(const BoundModel& b) {
  constexpr double near_end = 0.9;
  return std::ranges::any_of(b.model.parameters, [&](const auto& p) {
    return is_linear(p.name) &&
           std::any_of(b.values.begin() + static_cast<std::ptrdiff_t>(p.first),
                       b.values.begin() + static_cast<std::ptrdiff_t>(p.first + p.count),
                       [](double v) { return v > near_end; });
  });
}

void leave_scale_open(FitDocument& d, BoundModel& fitted, double factor) {
  std::vector<Linear> all;
  auto& ratios = d.ratios.emplace();
  for (auto& p : d.parameters) {
    if (!is_linear(p.name)) continue;
    for (std::size_t c = 0; c < p.value.size(); ++c) {
      const double value = p.value[c], error = p.std_error[c];
      if (p.status[c] == ParameterStatus::at_bound && value == 0) continue;  // whatever the scale
      const auto name = p.value.size() > 1 ? p.name + "." + d.channels[c] : p.name;
      if (p.status[c] == ParameterStatus::free && error > 0 && value > 0)
        all.push_back({name, value, error / value, (p.ci95_high[c] - p.ci95_low[c]) / (2 * error)});
      if (p.status[c] != ParameterStatus::not_identifiable)
        p.reason[c] = "only up to one factor: the scale is free";
      p.status[c] = ParameterStatus::not_identifiable;
      for (auto* x : {&p.value, &p.std_error, &p.ci95_low, &p.ci95_high, &p.limit, &p.excluded})
        (*x)[c] = not_known;
    }
  }
  const auto correlation = [&](const std::string& a, const std::string& b) {
    const auto i = std::ranges::find(d.free_names, a), j = std::ranges::find(d.free_names, b);
    if (i == d.free_names.end() || j == d.free_names.end()) return -1.0;  // the widest
    const double rho = d.correlations[static_cast<std::size_t>(i - d.free_names.begin())]
                                     [static_cast<std::size_t>(j - d.free_names.begin())];
    return std::isnan(rho) ? -1 : rho;
  };
  const auto surest = std::ranges::min_element(all, {}, &Linear::relative_error);
  for (auto x = all.begin(); x != all.end(); ++x) {
    if (x == surest) continue;
    const double a = x->relative_error, b = surest->relative_error;
    const double spread =
        std::max(x->t, surest->t) *
        std::sqrt(std::max(0.0, a * a + b * b - 2 * correlation(x->name, surest->name) * a * b));
    const double ratio = x->value / surest->value;
    ratios.push_back(
        {x->name, surest->name, ratio, ratio * std::exp(-spread), ratio * std::exp(spread)});
  }
  multiply(fitted, 1 / factor);
  d.residuals.rms /= factor;
  for (auto& band : d.residuals.bands) band.rms /= factor;
  d.log_offset /= factor;
  d.physics.theta_i_deg.clear();
  d.physics.model_albedo.clear();
  d.physics.data_albedo.clear();
  d.warnings.insert(
      d.warnings.begin(),
      "the scale is free: kd and weights are known up to one factor, so are colours' brightness "
      "and albedo; ratios, widths and Fresnel curves do not depend on it");
}

}  // namespace gonio
