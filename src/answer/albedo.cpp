#include "answer/albedo.h"

#include <algorithm>
#include <cmath>

#include "answer/file_functions.h"
#include "base/error.h"
#include "base/json/reader.h"
#include "geometry/direction.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

bool is_walked(const AlbedoQuestion& q) {
  return q.scattering == Scattering::walk;
}
bool is_solved(const AlbedoQuestion& q) {
  return is_walked(q) || q.scattering == Scattering::deterministic;
}

void by_formula(const BoundModel& model, const AlbedoQuestion& q, AlbedoAnswer& r) {
  const Goal goal{q.error.value_or(Goal{}.error), Goal{}.evaluations};
  const double phi = q.phi_deg * degree;
  if (q.scattering == Scattering::single) {
    r.at = directional_albedo(model, q.mu, phi, goal);
    if (q.average) r.average = hemispherical_albedo(model, goal);
  } else {
    const auto how = *find_value<Compensation>(name_of(q.scattering));
    r.at = compensated_albedo(model, how, q.mu, phi, goal);
    if (q.average) r.average = compensated_average(model, how, goal);
  }
}

WalkGoal walk_goal(const AlbedoQuestion& q) {
  WalkGoal goal;
  goal.seed = q.seed.value_or(goal.seed);
  goal.walks = q.walks.value_or(goal.walks);
  goal.error = q.error.value_or(goal.error);
  return goal;
}

void by_solution(const BoundModel& model,
                 const AlbedoQuestion& q,
                 AlbedoAnswer& r,
                 const AlbedoStep& step) {
  const double phi = q.phi_deg * degree;
  double error = 1e-9;  // of diffuse terms
  if (is_walked(q)) {
    // Each from the same numbers, so that what else is asked for changes nothing.
    const std::size_t all = q.mu.size() + (q.average ? 1 : 0);
    for (std::size_t i = 0; i < q.mu.size(); ++i) {
      step("walking", i, all);
      r.scattered.push_back(walk(model, {&q.mu[i], 1}, phi, walk_goal(q))[0]);
    }
    if (q.average)
      step("walking", q.mu.size(), all), r.scattered_average = walk_average(model, walk_goal(q));
  } else {
    error = q.error.value_or(1e-5);
    step("solving", 0, 0);
    auto solved = half_space(model, q.mu, error);
    r.scattered = std::move(solved.at);
    if (q.average) r.scattered_average = std::move(solved.average);
  }
  const auto diffuse = diffuse_albedo(model, q.mu, phi, {error, Goal{}.evaluations});
  for (std::size_t i = 0; i < q.mu.size(); ++i)
    r.at.push_back(with_diffuse(r.scattered[i], diffuse[i]));
  if (q.average)
    r.average =
        with_diffuse(*r.scattered_average, diffuse_average(model, {error, Goal{}.evaluations}));
}

void expect_finite(const std::string& name, const Albedo& a, const std::string& place) {
  if (!std::isfinite(a.error))
    throw bad_input(
        name, place,
        std::isnan(a.value[0]) ? "values that are no numbers" : "an integral that diverges",
        "a finite albedo");
}

bool is_grey(const std::vector<double>& by_channel) {
  return std::ranges::all_of(by_channel, [&](double v) { return v == by_channel[0]; });
}

/// Adds the figures of a walk or a half space beside the albedo: by channel, or of one where all are equal.
void add_scattered(Json& document, const AlbedoAnswer& r, const AlbedoQuestion& q) {
  const auto by_channel = [&](const auto& all) { return r.grey ? Json(all[0]) : Json(all); };
  Json orders = Json::array(), rest = Json::array(), error = Json::array();
  std::size_t bounces = 0;
  for (const auto& s : r.scattered) {
    orders.push_back(by_channel(s.order));
    rest.push_back(by_channel(s.rest));
    error.push_back(by_channel(s.error));
    bounces += s.bounces;
  }
  document["orders"] = orders;
  document["rest"] = rest;
  if (is_walked(q)) document["standard_error"] = error;
  if (r.scattered_average) {
    const auto& s = *r.scattered_average;
    const auto of_average = [&](const auto& all) {
      return r.grey ? Json::array({all[0]}) : Json(all);
    };
    document["average_orders"] = of_average(s.order);
    document["average_rest"] = of_average(s.rest);
    if (is_walked(q)) document["average_standard_error"] = of_average(s.error);
    bounces += s.bounces;
  }
  if (!is_walked(q)) return;
  document["seed"] = walk_goal(q).seed;
  document["walks"] = walk_goal(q).walks;
  document["bounces"] = bounces;
}

}  // namespace

AlbedoAnswer albedo_of(const BoundModel& asked,
                       const std::string& name,
                       const AlbedoQuestion& q,
                       const AlbedoStep& step) {
  if (q.mu.empty() && !q.average) throw wrong_usage("albedo needs --mu or --average");
  if (q.error && !(*q.error > 0))
    throw wrong_usage(fmt::format("--error {} is not above 0", *q.error));
  if (q.walks && *q.walks < 2) throw wrong_usage("--walks: at least 2");
  if (!is_walked(q) && (q.seed || q.walks))
    throw wrong_usage("--seed and --walks are for --scattering walk");
  check_cosines(q.mu);
  check_azimuth(q.phi_deg * degree);
  const AlbedoStep quiet = [](const std::string&, std::size_t, std::size_t) {};
  const auto& say = step ? step : quiet;
  AlbedoAnswer r;
  r.model = to_text(asked.model.spec);
  const BoundModel model = q.furnace ? furnace(asked) : asked;
  if (is_solved(q)) {
    by_solution(model, q, r, say);
  } else {
    say("integrating", 0, 0);
    by_formula(model, q, r);
  }
  for (std::size_t i = 0; i < r.at.size(); ++i)
    expect_finite(name, r.at[i], fmt::format("mu = {}", q.mu[i]));
  if (r.average) expect_finite(name, *r.average, "the average");

  r.error = r.average ? r.average->error : 0;
  r.grey = !r.average || is_grey(r.average->value);
  for (const auto& a : r.at) {
    r.error = std::max(r.error, a.error);
    r.grey &= is_grey(a.value);
  }
  return r;
}

std::string to_json(const AlbedoAnswer& r, const AlbedoQuestion& q) {
  Json albedo = Json::array();
  for (const auto& a : r.at) albedo.push_back(r.grey ? Json(a.value[0]) : Json(a.value));
  Json document{{"model", r.model}, {"scattering", name_of(q.scattering)}};
  document["mu"] = q.mu;
  document["albedo"] = albedo;
  if (r.average)
    document["average"] = r.grey ? Json::array({r.average->value[0]}) : Json(r.average->value);
  // A walk has no bound; 4 standard errors are left once in 16000 times.
  document["error_bound"] = is_walked(q) ? 4 * r.error : r.error;
  if (is_solved(q)) add_scattered(document, r, q);
  add_own_files(document, r.model);
  return text_of(document);
}

}  // namespace gonio
