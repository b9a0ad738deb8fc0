// gonio albedo: how much of the light that comes in a model gives back.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include "cli/command.h"
#include "cli/model_argument.h"
#include "cli/terminal.h"
#include "geometry/direction.h"
#include "integrate/scattering/compensation.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gonio::cli {
namespace {

struct Options : Common {
  std::string spec, scattering = "single";
  std::vector<std::string> set;
  std::vector<double> mu;
  double phi_deg = 0;
  std::optional<double> error;
  std::optional<std::uint64_t> seed;
  std::optional<std::size_t> walks;
  bool average = false, furnace = false;
};

/// At each mu, and on average; of a walk or a half space also by number of bounces.
struct Result {
  std::vector<Albedo> at;
  std::optional<Albedo> average;
  std::vector<Scattered> scattered;
  std::optional<Scattered> scattered_average;
};

Result by_formula(const BoundModel& model, const Options& o) {
  const Goal goal{o.error.value_or(Goal{}.error), Goal{}.evaluations};
  const double phi = o.phi_deg * degree;
  Result r;
  Progress progress(o.quiet);
  progress("integrating");
  if (o.scattering == "single") {
    r.at = directional_albedo(model, o.mu, phi, goal);
    if (o.average) r.average = hemispherical_albedo(model, goal);
  } else {
    const auto how = value_of<Compensation>(o.scattering, "compensation");
    r.at = compensated_albedo(model, how, o.mu, phi, goal);
    if (o.average) r.average = compensated_average(model, how, goal);
  }
  return r;
}

WalkGoal walk_goal(const Options& o) {
  WalkGoal goal;
  goal.seed = o.seed.value_or(goal.seed);
  goal.walks = o.walks.value_or(goal.walks);
  goal.error = o.error.value_or(goal.error);
  return goal;
}

Result by_solution(const BoundModel& model, const Options& o) {
  Result r;
  const double phi = o.phi_deg * degree;
  double error = 1e-9;  // of diffuse terms
  if (o.scattering == "walk") {
    // Each from the same numbers, so that what else is asked for changes nothing.
    TimedProgress progress(o.quiet, "walking", o.mu.size() + (o.average ? 1 : 0));
    for (std::size_t i = 0; i < o.mu.size(); ++i) {
      progress(i);
      r.scattered.push_back(walk(model, {&o.mu[i], 1}, phi, walk_goal(o))[0]);
    }
    if (o.average) progress(o.mu.size()), r.scattered_average = walk_average(model, walk_goal(o));
  } else {
    error = o.error.value_or(1e-5);
    Progress progress(o.quiet);
    progress("solving");
    auto solved = half_space(model, o.mu, error);
    r.scattered = std::move(solved.at);
    if (o.average) r.scattered_average = std::move(solved.average);
  }
  const auto diffuse = diffuse_albedo(model, o.mu, phi, {error, Goal{}.evaluations});
  for (std::size_t i = 0; i < o.mu.size(); ++i)
    r.at.push_back(with_diffuse(r.scattered[i], diffuse[i]));
  if (o.average)
    r.average =
        with_diffuse(*r.scattered_average, diffuse_average(model, {error, Goal{}.evaluations}));
  return r;
}

void expect_finite(const Options& o, const Albedo& a, const std::string& place) {
  if (!std::isfinite(a.error))
    throw bad_input(
        o.spec, place,
        std::isnan(a.value[0]) ? "values that are no numbers" : "an integral that diverges",
        "a finite albedo");
}

bool is_grey(const std::vector<double>& by_channel) {
  return std::ranges::all_of(by_channel, [&](double v) { return v == by_channel[0]; });
}

using Json = nlohmann::ordered_json;

/// Adds the figures of a walk or a half space beside the albedo: by channel, or of one where all are equal.
void add_scattered(Json& document, const Result& r, bool grey, const Options& o) {
  const auto by_channel = [&](const auto& all) { return grey ? Json(all[0]) : Json(all); };
  const bool walked = o.scattering == "walk";
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
  if (walked) document["standard_error"] = error;
  if (r.scattered_average) {
    const auto& s = *r.scattered_average;
    const auto of_average = [&](const auto& all) {
      return grey ? Json::array({all[0]}) : Json(all);
    };
    document["average_orders"] = of_average(s.order);
    document["average_rest"] = of_average(s.rest);
    if (walked) document["average_standard_error"] = of_average(s.error);
    bounces += s.bounces;
  }
  if (!walked) return;
  document["seed"] = walk_goal(o).seed;
  document["walks"] = walk_goal(o).walks;
  document["bounces"] = bounces;
}

Exit run(const Options& o) {
  if (o.mu.empty() && !o.average) throw wrong_usage("albedo needs --mu or --average");
  if (o.error && !(*o.error > 0))
    throw wrong_usage(fmt::format("--error {} is not above 0", *o.error));
  const bool walked = o.scattering == "walk", solved = walked || o.scattering == "deterministic";
  if (!walked && (o.seed || o.walks))
    throw wrong_usage("--seed and --walks are for --scattering walk");
  use_jobs(o.jobs);
  auto model = model_argument(o.spec, o.set).model;
  if (o.furnace) model = furnace(model);
  check_cosines(o.mu);
  check_azimuth(o.phi_deg * degree);
  const Result r = solved ? by_solution(model, o) : by_formula(model, o);
  for (std::size_t i = 0; i < r.at.size(); ++i)
    expect_finite(o, r.at[i], fmt::format("mu = {}", o.mu[i]));
  if (r.average) expect_finite(o, *r.average, "the average");

  double error = r.average ? r.average->error : 0;
  bool grey = !r.average || is_grey(r.average->value);
  for (const auto& a : r.at) {
    error = std::max(error, a.error);
    grey &= is_grey(a.value);
  }
  if (!o.json) {
    const auto line = [&](const std::string& name, const Albedo& a) {
      fmt::print("{:>10}", name);
      for (std::size_t c = 0; c < (grey ? 1 : a.value.size()); ++c)
        fmt::print("  {:.10f}", a.value[c]);
      fmt::print("  ± {:.1e}\n", a.error);
    };
    fmt::print("{:>10}  albedo{}\n", "mu", walked ? " ± standard error" : "");
    for (std::size_t i = 0; i < r.at.size(); ++i) line(fmt::format("{}", o.mu[i]), r.at[i]);
    if (r.average) line("average", *r.average);
    return Exit::done;
  }
  Json albedo = Json::array();
  for (const auto& a : r.at) albedo.push_back(grey ? Json(a.value[0]) : Json(a.value));
  Json document{{"model", model.model.spec}, {"scattering", o.scattering}};
  document["mu"] = o.mu;
  document["albedo"] = albedo;
  if (r.average)
    document["average"] = grey ? Json::array({r.average->value[0]}) : Json(r.average->value);
  // A walk has no bound; 4 standard errors are left once in 16000 times.
  document["error_bound"] = walked ? 4 * error : error;
  if (solved) add_scattered(document, r, grey, o);
  print_document(document);
  return Exit::done;
}

}  // namespace

void add_albedo(CommandLine& line) {
  std::vector<std::string> scattering{"single", "walk", "deterministic"};
  scattering.insert(scattering.end(), names_of<Compensation>.begin(), names_of<Compensation>.end());
  auto [c, o] = line.command(
      "albedo",
      "Integrates how much of the light that comes in a model gives back, with a bound of the "
      "error",
      "gonio albedo ggx/smith_ggx.correlated/schlick --set alpha=1 f0=1 --mu 0.01,0.5,1 --average "
      "--scattering deterministic --json",
      run);
  c.option("MODEL", o->spec, spec_or_fit).required();
  add_set(c, o->set);
  c.option("--mu", o->mu, "Cosines of the zenith angle, in (0, 1]").delimiter(',');
  c.option("--phi", o->phi_deg, "Azimuth from the tangent, in degrees (anisotropic models)");
  c.flag("--average", o->average, "Also the average over the hemisphere, 2 ∫ E mu dmu");
  c.flag("--furnace", o->furnace, "With F = 1: what is then lost, masking has taken away");
  c.option("--scattering", o->scattering,
           "single: light that meets one facet; all of it by random walks (walk) or by quadrature "
           "(deterministic); or as shaders compensate: kulla_conty, turquin, fdez_aguera")
      .one_of(scattering);
  c.option("--error", o->error,
           "Absolute error asked for (1e-8; deterministic 1e-5; of a walk the standard error at "
           "which it may stop)");
  c.option("--walks", o->walks, "Random walks at most, at each mu and lobe (1000000)")
      .in(std::size_t{2}, std::size_t{1} << 40);
  add_seed(c, o->seed, "Of the random walks (1)");
  add_jobs(c, *o);
  add_output(c, *o);
}

}  // namespace gonio::cli
