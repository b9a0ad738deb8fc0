#include "cli/fit/map_result.h"

#include <cmath>
#include <cstdint>
#include <filesystem>

#include "base/error.h"
#include "base/file.h"
#include "brdf/model/own_files.h"
#include "cli/line/terminal.h"
#include "fitting/map/tiles.h"

#include <fmt/format.h>

namespace gonio::cli {
namespace {

void print(const MapDocument& d, const std::string& beside) {
  const std::uint64_t texels = d.width * d.height;
  say("model   {}\n", d.model);
  if (d.models && d.models->size() > 1)
    say_below("chosen  ",
              fmt::format("{} leaves {:.3g} times as much in images that fits have not seen",
                          d.models->at(1).model,
                          d.models->at(1).unseen_rms / d.models->at(0).unseen_rms));
  std::string ended =
      fmt::format("{} × {}, {} converged", d.width, d.height, percent(d.converged, texels));
  if (d.not_converged) ended += fmt::format(", {} did not", percent(d.not_converged, texels));
  if (d.no_data) ended += fmt::format(", {} without a value", percent(d.no_data, texels));
  if (!beside.empty()) ended += "; " + beside;
  say_below("texels  ", ended);
  if (d.left_out > 0)
    say("values  {:.2g} % left out: no number, below 0, clipped or dark\n", 100 * d.left_out);
  if (!std::isnan(d.rms)) say("rms     {:.3g} on average, in the metric's unit\n", d.rms);
  if (d.judged == 0)
    say("misfit  not judged: the noise is not known\n");
  else if (misfits(d))
    say_below("misfit  ", fmt::format("{} of the texels are off by more than noise leaves",
                                      percent(d.misfit, d.judged)));
  if (d.azimuth && *d.azimuth != AzimuthCheck::checked) say_below("azimuth ", words_of(*d.azimuth));
  for (const auto& p : d.parameters) {
    std::string text = std::isnan(p.mean) ? "–" : fmt::format("{:.4g} on average", p.mean);
    if (!std::isnan(p.mean_std_error)) text += fmt::format(" ± {:.2g} each", p.mean_std_error);
    if (p.fixed) text += ", held";
    if (p.at_bound) text += fmt::format(", {} at a bound", percent(p.at_bound, texels));
    if (p.not_identifiable)
      text += fmt::format(", {} not known", percent(p.not_identifiable, texels));
    say_below(fmt::format("{:<13} ", p.name), text);
  }
  say("map     {}\n", d.path);
  for (const auto& w : d.warnings) say_below("warning ", w);
}

}  // namespace

void print_map(const MapDocument& d, const Common& o, const std::string& beside) {
  if (o.json)
    fmt::print("{}", to_json(d));
  else
    print(d, beside);
}

Exit outcome_of(const MapDocument& d) {
  return 2 * d.converged > d.converged + d.not_converged ? Exit::done : Exit::not_converged;
}

Exit gather_map(const std::string& folder, const std::string& output, const Common& o) {
  if (output.empty()) throw wrong_usage("the tiles of a map are joined into -o MAPS.exr");
  check_outputs({folder}, {output});
  OutputFile out(output);
  Progress progress(o.quiet);
  progress("joining tiles");
  const MapDocument d = gather_tiles(folder, out, threads_in_use());
  model_of_file(folder, d.model);
  out.commit();
  progress.clear();
  print_map(d, o, "");
  return outcome_of(d);
}

}  // namespace gonio::cli
