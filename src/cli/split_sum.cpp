// gonio split_sum: the two numbers that image-based light looks up.
#include "integrate/split_sum.h"

#include "cli/command.h"

#include <nlohmann/json.hpp>

namespace gonio::cli {
namespace {

struct Options : Common {
  std::vector<double> roughness, nov;
  std::string masking = "smith_ggx.correlated";
  std::size_t samples = 0;
};

Exit run(const Options& o) {
  use_jobs(o.jobs);
  std::string table =
      fmt::format("{:>10} {:>10} {:>12} {:>12} {:>12}\n", "roughness", "nov", "a", "b", "diffuse");
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const double r : o.roughness) {
    const auto sums = o.samples > 0 ? sampled_split_sum(o.masking, r, o.nov, o.samples)
                                    : split_sum(o.masking, r, o.nov);
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const auto& s = sums[i];
      table += fmt::format("{:>10} {:>10} {:>12.9f} {:>12.9f} {:>12.9f}\n", r, o.nov[i], s.a, s.b,
                           s.diffuse);
      rows.push_back(
          {{"roughness", r}, {"nov", o.nov[i]}, {"a", s.a}, {"b", s.b}, {"diffuse", s.diffuse}});
      if (o.samples == 0) rows.back()["error_bound"] = s.error;
    }
  }
  if (!o.json) {
    fmt::print("{}", table);
  } else {
    nlohmann::ordered_json document{{"masking", o.masking}};
    if (o.samples > 0) document["samples"] = o.samples;
    document["rows"] = rows;
    fmt::print("{}\n", document.dump(2));
  }
  return Exit::done;
}

}  // namespace

void add_split_sum(CLI::App& app, Action& action) {
  auto o = std::make_shared<Options>();
  auto* c = add_command(
      app, action, "split_sum",
      "A and B of the split sum: GGX under Schlick's Fresnel reflects F0 A + B of an even "
      "environment",
      "gonio split_sum --roughness 0.1,0.5 --nov 0.05,1 --json", o, run);
  c->add_option("--roughness", o->roughness, "Roughness, alpha = roughness²")
      ->delimiter(',')
      ->required();
  c->add_option("--nov", o->nov, "Cosines of the view's zenith angle, in (0, 1]")
      ->delimiter(',')
      ->required();
  c->add_option("--masking", o->masking, "Masking term");
  c->add_option("--samples", o->samples,
                "By so many half vectors drawn from D, as renderers make their table (default: by "
                "quadrature)")
      ->check(CLI::Range(std::size_t{1}, std::size_t{4294967295}));
  add_jobs(c, *o);
  add_output(c, *o);
}

}  // namespace gonio::cli
