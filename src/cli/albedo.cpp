// gonio albedo: how much of the light that comes in a model gives back.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "cli/command.h"
#include "geometry/direction.h"
#include "integrate/directional_albedo.h"

#include <nlohmann/json.hpp>

namespace gonio::cli {
namespace {

struct Options : Common {
  std::string spec, scattering = "single";
  std::vector<std::string> set;
  std::vector<double> mu;
  double phi_deg = 0, error = Goal{}.error;
  bool average = false, furnace = false;
};
constexpr std::array scattering_names{"single"};

void expect_finite(const Options& o, const Albedo& a, const std::string& place) {
  if (!std::isfinite(a.error))
    throw bad_input(
        o.spec, place,
        std::isnan(a.value[0]) ? "values that are no numbers" : "an integral that diverges",
        "a finite albedo");
}

bool is_grey(const Albedo& a) {
  return std::ranges::all_of(a.value, [&](double v) { return v == a.value[0]; });
}

Exit run(const Options& o) {
  if (o.mu.empty() && !o.average) throw wrong_usage("albedo needs --mu or --average");
  if (!(o.error > 0)) throw wrong_usage(fmt::format("--error {} is not above 0", o.error));
  use_jobs(o.jobs);
  auto model = bind_model(o.spec, parse_settings(o.set));
  if (o.furnace) model = furnace(model);
  const Goal goal{o.error, Goal{}.evaluations};

  const auto at = directional_albedo(model, o.mu, o.phi_deg * degree, goal);
  for (std::size_t i = 0; i < at.size(); ++i)
    expect_finite(o, at[i], fmt::format("mu = {}", o.mu[i]));
  std::optional<Albedo> average;
  if (o.average) {
    average = hemispherical_albedo(model, goal);
    expect_finite(o, *average, "the average");
  }

  double error = average ? average->error : 0;
  bool grey = !average || is_grey(*average);
  for (const auto& a : at) {
    error = std::max(error, a.error);
    grey &= is_grey(a);
  }
  if (!o.json) {
    const auto line = [&](const std::string& name, const Albedo& a) {
      fmt::print("{:>10}", name);
      for (std::size_t c = 0; c < (grey ? 1 : a.value.size()); ++c)
        fmt::print("  {:.10f}", a.value[c]);
      fmt::print("  ± {:.1e}\n", a.error);
    };
    fmt::print("{:>10}  albedo\n", "mu");
    for (std::size_t i = 0; i < at.size(); ++i) line(fmt::format("{}", o.mu[i]), at[i]);
    if (average) line("average", *average);
    return Exit::done;
  }
  using Json = nlohmann::ordered_json;
  const auto values = [&](const Albedo& a) { return grey ? Json(a.value[0]) : Json(a.value); };
  Json albedo = Json::array();
  for (const auto& a : at) albedo.push_back(values(a));
  Json document{{"model", model.model.spec}, {"scattering", o.scattering}};
  document["mu"] = o.mu;
  document["albedo"] = albedo;
  if (average) document["average"] = grey ? Json::array({average->value[0]}) : Json(average->value);
  document["error_bound"] = error;
  fmt::print("{}\n", document.dump(2));
  return Exit::done;
}

}  // namespace

void add_albedo(CLI::App& app, Action& action) {
  auto o = std::make_shared<Options>();
  auto* c = add_command(
      app, action, "albedo",
      "Integrates how much of the light that comes in a model gives back, with a bound of the "
      "error",
      "gonio albedo ggx/smith_ggx.correlated/schlick --set alpha=1 f0=1 --mu 0.01,0.5,1 --average "
      "--json",
      o, run);
  c->add_option("SPEC", o->spec, "Model")->required();
  add_set(c, o->set);
  c->add_option("--mu", o->mu, "Cosines of the zenith angle, in (0, 1]")->delimiter(',');
  c->add_option("--phi", o->phi_deg, "Azimuth from the tangent, in degrees (anisotropic models)");
  c->add_flag("--average", o->average, "Also the average over the hemisphere, 2 ∫ E mu dmu");
  c->add_flag("--furnace", o->furnace, "With F = 1: what is then lost, masking has taken away");
  c->add_option("--scattering", o->scattering, "single: light that meets one facet")
      ->check(one_of(scattering_names));
  c->add_option("--error", o->error, "Absolute error asked for (1e-8)");
  add_jobs(c, *o);
  add_output(c, *o);
}

}  // namespace gonio::cli
