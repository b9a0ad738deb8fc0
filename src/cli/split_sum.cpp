// gonio split_sum: the two numbers that image-based light looks up, one by one or as a table.
#include "integrate/split_sum.h"

#include <array>
#include <charconv>

#include "cli/command.h"
#include "cli/terminal.h"
#include "integrate/split_sum_table.h"

#include <nlohmann/json.hpp>

namespace gonio::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Options : Common {
  std::vector<double> roughness, nov;
  std::string masking = "smith_ggx.correlated", size, precision = "float", out;
  std::size_t samples = 0;
  std::optional<double> error;
};
constexpr std::array precision_names{"float", "half"};
constexpr std::array storages{Storage::single, Storage::half};

Goal goal_or(const Options& o, double error) {
  return {o.error.value_or(error)};
}

Exit rows(const Options& o) {
  std::string table =
      fmt::format("{:>10} {:>10} {:>12} {:>12} {:>12}\n", "roughness", "nov", "a", "b", "diffuse");
  Json rows = Json::array();
  const Goal goal = goal_or(o, Goal{}.error);
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
      table += fmt::format("{:>10} {:>10} {:>12.9f} {:>12.9f} {:>12.9f}\n", r, o.nov[i], s.a, s.b,
                           diffuse[i]);
      rows.push_back(
          {{"roughness", r}, {"nov", o.nov[i]}, {"a", s.a}, {"b", s.b}, {"diffuse", diffuse[i]}});
      if (o.samples == 0) rows.back()["error_bound"] = std::max(s.error, diffuse_error);
    }
  }
  if (!o.json) {
    fmt::print("{}", table);
  } else {
    Json document{{"masking", o.masking}};
    if (o.samples > 0) document["samples"] = o.samples;
    document["rows"] = rows;
    fmt::print("{}\n", document.dump(2));
  }
  return Exit::done;
}

/// "64x32"
std::array<std::size_t, 2> size_from(const std::string& text) {
  std::array<std::size_t, 2> size{};
  const char* const end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size[0]);
  if (width.ec == std::errc() && width.ptr != end && *width.ptr == 'x') {
    const auto height = std::from_chars(width.ptr + 1, end, size[1]);
    if (height.ec == std::errc() && height.ptr == end) return size;
  }
  throw wrong_usage(fmt::format("--size {} is not WIDTHxHEIGHT, such as 64x64", text));
}

Json json_of(const SplitSumDeviation& d) {
  const auto one = [](const Deviation& v) { return Json{{"max", v.max}, {"rms", v.rms}}; };
  return {{"a", one(d.a)}, {"b", one(d.b)}, {"e", one(d.e)}};
}

Exit table(const Options& o) {
  const auto [width, height] = size_from(o.size);
  check_outputs({}, {o.out});
  Progress progress(o.quiet || o.json);
  progress("integrating");
  const auto exact = split_sum_table(o.masking, width, height, o.samples, goal_or(o, 1e-7));
  const Storage storage = storages[index_of(precision_names, o.precision)];
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
                  {"precision", o.precision}};
    if (o.samples > 0)
      document["samples"] = o.samples;
    else
      document["error_bound"] = exact.error;
    document["storage_error"] = json_of(storing);
    document["lookup_error"] = json_of(lookup.all);
    document["lookup_error_between_centres"] = json_of(lookup.between);
    fmt::print("{}\n", document.dump(2));
    return Exit::done;
  }
  fmt::print("{}: {} × {}, {}, {}\n", o.out, width, height, o.precision, exact.masking);
  if (o.samples > 0)
    fmt::print("{} samples a texel\n", o.samples);
  else
    fmt::print("quadrature: ± {:.1e}\n", exact.error);
  fmt::print("{:<32} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "off by", "A max", "rms", "B max",
             "rms", "A+B max", "rms");
  const auto line = [](const char* name, const SplitSumDeviation& d) {
    fmt::print("{:<32}", name);
    for (const auto& v : {d.a, d.b, d.e}) fmt::print(" {:9.1e} {:9.1e}", v.max, v.rms);
    fmt::print("\n");
  };
  line("storage", storing);
  line("bilinear lookup", lookup.all);
  line("the same, where nothing clamps", lookup.between);
  return Exit::done;
}

Exit run(const Options& o) {
  if (o.error && !(*o.error > 0))
    throw wrong_usage(fmt::format("--error {} is not above 0", *o.error));
  if (o.error && o.samples > 0) throw wrong_usage("--error is of quadrature, not of --samples");
  use_jobs(o.jobs);
  const bool is_table = !o.size.empty();
  if (is_table == (!o.roughness.empty() || !o.nov.empty()) || is_table == o.out.empty())
    throw wrong_usage("split_sum needs --roughness and --nov, or --size and -o");
  if (is_table) return table(o);
  if (o.roughness.empty() || o.nov.empty())
    throw wrong_usage("split_sum needs both --roughness and --nov");
  return rows(o);
}

}  // namespace

void add_split_sum(CLI::App& app, Action& action) {
  auto o = std::make_shared<Options>();
  auto* c = add_command(
      app, action, "split_sum",
      "A and B of the split sum: GGX under Schlick's Fresnel reflects F0 A + B of an even "
      "environment",
      "gonio split_sum --roughness 0.1,0.5 --nov 0.05,1 --json\n"
      "  gonio split_sum --size 64x64 --precision half -o table.exr",
      o, run);
  c->add_option("--roughness", o->roughness, "Roughness, alpha = roughness²")->delimiter(',');
  c->add_option("--nov", o->nov, "Cosines of the view's zenith angle, in (0, 1]")->delimiter(',');
  c->add_option("--masking", o->masking, "Masking term");
  c->add_option("--samples", o->samples,
                "By so many half vectors drawn from D, as renderers make their table (default: by "
                "quadrature)")
      ->check(CLI::Range(std::size_t{1}, std::size_t{4294967295}));
  c->add_option("--error", o->error, "Absolute error asked for (1e-8, of a table 1e-7)");
  c->add_option("--size", o->size, "A table of WIDTHxHEIGHT texels: NoV along, roughness down");
  c->add_option("--precision", o->precision, "What the table's numbers are stored as")
      ->check(one_of(precision_names))
      ->capture_default_str();
  c->add_option("-o,--output", o->out, "OpenEXR file that the table is written to");
  add_jobs(c, *o);
  add_output(c, *o);
}

}  // namespace gonio::cli
