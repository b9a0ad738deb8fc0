// gonio split_sum: the two numbers that image-based light looks up, one by one or as a table, and
// what is lost by them under an environment.
#include "integrate/light/split_sum.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/numbers.h"
#include "base/text.h"
#include "cli/line/command.h"
#include "cli/line/terminal.h"
#include "integrate/light/split_sum_light.h"
#include "integrate/light/split_sum_table.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gonio::cli {
namespace {

using Json = nlohmann::ordered_json;

struct SplitSumCall : Common {
  std::vector<double> roughness, nov, f0;
  std::string masking = "smith_ggx.correlated", size, out, environment;
  std::optional<Storage> precision;
  std::size_t samples = 0, views = 0;
  std::optional<double> error;
};

Goal goal_or(const SplitSumCall& o, double error) {
  return {o.error.value_or(error)};
}

/// Refuses values that are no numbers, as where NoV is so small that its square is 0.
void expect_finite(const SplitSumCall& o,
                   double roughness,
                   double nov,
                   std::initializer_list<double> values) {
  if (!std::ranges::all_of(values, [](double v) { return std::isfinite(v); }))
    throw bad_input(o.masking, fmt::format("roughness = {}, nov = {}", roughness, nov),
                    "values that are no numbers", "finite ones");
}

Exit rows(const SplitSumCall& o) {
  std::string table =
      fmt::format("{:>10} {:>10} {:>12} {:>12} {:>12}\n", "roughness", "nov", "a", "b", "diffuse");
  Json rows = Json::array();
  const Goal goal = goal_or(o, Goal{}.error);
  Progress progress(o.quiet);
  progress("integrating");
  std::vector<double> diffuse;
  double diffuse_error = 0;
  if (o.samples > 0) {
    diffuse = sampled_split_sum_diffuse(o.nov, o.samples);
  } else {
    for (const auto& d : split_sum_diffuse(o.nov, goal)) {
      diffuse.push_back(d.value[0]);
      diffuse_error = std::max(diffuse_error, d.error);
    }
  }
  for (const double r : o.roughness) {
    const auto sums = o.samples > 0 ? sampled_split_sum(o.masking, r, o.nov, o.samples)
                                    : split_sum(o.masking, r, o.nov, goal);
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const auto& s = sums[i];
      expect_finite(o, r, o.nov[i], {s.a, s.b, diffuse[i]});
      table += fmt::format("{:>10} {:>10} {:>12.9f} {:>12.9f} {:>12.9f}\n", r, o.nov[i], s.a, s.b,
                           diffuse[i]);
      rows.push_back(
          {{"roughness", r}, {"nov", o.nov[i]}, {"a", s.a}, {"b", s.b}, {"diffuse", diffuse[i]}});
      if (o.samples == 0) rows.back()["error_bound"] = std::max(s.error, diffuse_error);
    }
  }
  progress.clear();
  if (!o.json) {
    fmt::print("{}", table);
  } else {
    Json document{{"masking", o.masking}};
    if (o.samples > 0) document["samples"] = o.samples;
    document["rows"] = rows;
    print_document(document);
  }
  return Exit::done;
}

/// "64x32"
std::array<std::size_t, 2> size_from(const std::string& text) {
  if (const auto parts = split(text, 'x'); parts.size() == 2) {
    const auto width = number_from<std::size_t>(parts[0]),
               height = number_from<std::size_t>(parts[1]);
    if (width && height) return {*width, *height};
  }
  throw wrong_usage(fmt::format("--size {} is not WIDTHxHEIGHT, such as 64x64", text));
}

Json json_of(const SplitSumDeviation& d) {
  if (d.values == 0) return nullptr;
  const auto one = [](const Deviation& v) { return Json{{"max", v.max}, {"rms", v.rms}}; };
  return {{"a", one(d.a)}, {"b", one(d.b)}, {"e", one(d.e)}};
}

Exit table(const SplitSumCall& o) {
  const auto [width, height] = size_from(o.size);
  check_outputs({}, {o.out});
  Progress progress(o.quiet);
  progress("integrating");
  const auto exact = split_sum_table(o.masking, width, height, o.samples, goal_or(o, 1e-7));
  const auto storage = o.precision.value_or(Storage::single);
  const std::string_view precision = name_of(storage);
  const auto written = stored(exact, storage);
  write_split_sum_table(o.out, exact, storage);
  progress("looking up");
  const auto storing = difference(written, exact);
  const auto lookup = lookup_error(written);
  progress.clear();
  if (o.json) {
    Json document{{"output", o.out},
                  {"masking", exact.masking},
                  {"width", width},
                  {"height", height},
                  {"precision", precision}};
    if (o.samples > 0)
      document["samples"] = o.samples;
    else
      document["error_bound"] = exact.error;
    document["storage_error"] = json_of(storing);
    document["lookup_error"] = json_of(lookup.all);
    document["lookup_error_between_centres"] = json_of(lookup.between);
    print_document(document);
    return Exit::done;
  }
  say("{}: {} × {}, {}, {}\n", o.out, width, height, precision, exact.masking);
  if (o.samples > 0)
    fmt::print("{} samples a texel\n", o.samples);
  else
    fmt::print("quadrature: ± {:.1e}\n", exact.error);
  fmt::print("{:<32} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "off by", "A max", "rms", "B max",
             "rms", "A+B max", "rms");
  const auto line = [](const char* name, const SplitSumDeviation& d) {
    fmt::print("{:<32}", name);
    if (d.values == 0)
      fmt::print(" {:>9}", "nowhere");
    else
      for (const auto& v : {d.a, d.b, d.e}) fmt::print(" {:9.1e} {:9.1e}", v.max, v.rms);
    fmt::print("\n");
  };
  line("storage", storing);
  line("bilinear lookup", lookup.all);
  line("the same, where nothing clamps", lookup.between);
  return Exit::done;
}

Exit under_light(const SplitSumCall& o) {
  const auto f0s = o.f0.empty() ? std::vector{0.04} : o.f0;
  const std::size_t view_count = o.views > 0 ? o.views : 16;
  for (const double f0 : f0s)
    if (!(LitView::f0[0] <= f0 && f0 <= LitView::f0[1]))
      throw wrong_usage(
          fmt::format("f0 = {} is outside [{}, {}]", f0, LitView::f0[0], LitView::f0[1]));
  TimedProgress progress(o.quiet, "gathering", o.roughness.size() * o.nov.size());
  const SummedEnvironment light(read_environment(o.environment));
  const RelativeGoal goal{o.error.value_or(RelativeGoal{}.error)};
  std::string table = fmt::format(
      "truth and split sum: light towards the viewer, as luminance in the map's unit of radiance, "
      "mean over {}\n"
      "rms, max and bias: what the split sum is off by, in % of the truth; ± truth: what these may "
      "be off by\n"
      "{:>9} {:>6} {:>6} {:>11} {:>11} {:>9} {:>9} {:>9} {:>9}\n",
      counted(view_count, "view"), "roughness", "nov", "f0", "truth", "split sum", "rms [%]",
      "max [%]", "bias [%]", "± truth");
  Json rows = Json::array();
  std::size_t done = 0;
  for (const double r : o.roughness)
    for (const double nov : o.nov) {
      const auto even = split_sum(o.masking, r, {{nov}})[0];  // where it fails, so do views, slowly
      expect_finite(o, r, nov, {even.a, even.b});
      const auto views = lit_views(light, o.masking, r, nov, view_count, goal);
      progress(++done);
      for (const auto& v : views)
        expect_finite(o, r, nov, {luminance(v.exact_at[1]), luminance(v.prefiltered)});
      for (const double f0 : f0s) {
        const auto e = split_sum_light_error(views, f0);
        table += fmt::format(
            "{:>9} {:>6} {:>6} {:>11.5g} {:>11.5g} {:>9.2f} {:>9.2f} {:>+9.2f} {:>9.2g}\n", r, nov,
            f0, luminance(e.exact), luminance(e.split), 100 * e.rms, 100 * e.max, 100 * e.bias,
            100 * e.truth);
        rows.push_back({{"roughness", r},
                        {"nov", nov},
                        {"f0", f0},
                        {"truth", e.exact},
                        {"split_sum", e.split},
                        {"relative_error", e.rms},
                        {"max_relative_error", e.max},
                        {"bias", e.bias},
                        {"error_over_mean", e.of_mean},
                        {"truth_error", e.truth},
                        {"lit_views", e.views}});
      }
    }
  progress.clear();
  if (!o.json) {
    fmt::print("{}", table);
    return Exit::done;
  }
  const Json document{{"environment", o.environment},
                      {"width", light.map().width},
                      {"height", light.map().height},
                      {"negative_values", light.map().negative},
                      {"masking", o.masking},
                      {"views", view_count},
                      {"rows", rows}};
  print_document(document);
  return Exit::done;
}

Exit run(const SplitSumCall& o) {
  if (o.error && !(*o.error > 0))
    throw wrong_usage(fmt::format("--error {} is not above 0", *o.error));
  if (o.error && o.samples > 0) throw wrong_usage("--error is of quadrature, not of --samples");
  use(o);
  const bool some_points = !o.roughness.empty() || !o.nov.empty();
  if (o.size.empty() != o.out.empty() || o.size.empty() != some_points)
    throw wrong_usage("split_sum needs --roughness and --nov, or --size and -o");
  if (!o.size.empty() && !o.environment.empty())
    throw wrong_usage("--environment needs --roughness and --nov, not --size");
  if (o.size.empty() && o.precision) throw wrong_usage("--precision is of a table, --size");
  if (o.environment.empty() && !o.f0.empty()) throw wrong_usage("--f0 is for --environment");
  if (o.environment.empty() && o.views > 0) throw wrong_usage("--views is for --environment");
  if (!o.size.empty()) return table(o);
  if (o.roughness.empty() || o.nov.empty())
    throw wrong_usage("split_sum needs both --roughness and --nov");
  if (o.environment.empty()) return rows(o);
  if (o.samples > 0) throw wrong_usage("--environment is by quadrature, not by --samples");
  return under_light(o);
}

}  // namespace

void add_split_sum(CommandLine& line) {
  auto [c, o] = line.command<SplitSumCall>(
      "split_sum",
      "A and B of the split sum: GGX under Schlick's Fresnel reflects F0 A + B of an even "
      "environment",
      "gonio split_sum --roughness 0.1,0.5 --nov 0.05,1 --json\n"
      "  gonio split_sum --size 64x64 --precision half -o table.exr\n"
      "  gonio split_sum --environment sky.exr --roughness 0.1,0.5 --nov 0.05,1 --f0 0.04,0.9",
      run);
  c.option("--roughness", o->roughness, "Roughness, alpha = roughness²").delimiter(',');
  c.option("--nov", o->nov, "Cosines of the view's zenith angle, in (0, 1]").delimiter(',');
  c.option("--masking", o->masking, "Masking term");
  c.option("--samples", o->samples,
           "By so many half vectors drawn from D, as renderers make their table (default: by "
           "quadrature)")
      .in(std::size_t{1}, std::size_t{4294967295});
  c.option(
      "--error", o->error,
      "Error asked for: absolute (1e-8, of a table 1e-7), under an environment relative (1e-3)");
  c.option("--size", o->size, "A table of WIDTHxHEIGHT texels: NoV along, roughness down");
  c.option("--precision", o->precision, "What the table's numbers are stored as (float)");
  c.option("-o,--output", o->out, "OpenEXR file that the table is written to");
  c.option("--environment", o->environment,
           "OpenEXR map over longitude and latitude: what the split sum is off by under its light");
  c.option("--f0", o->f0,
           "Reflectance at normal incidence, under an environment, in [0.02, 1] (0.04)")
      .delimiter(',');
  c.option("--views", o->views, "Views, even over the environment (16)")
      .in(std::size_t{1}, std::size_t{100'000});
  add_jobs(c, *o);
  add_output(c, *o);
}

}  // namespace gonio::cli
