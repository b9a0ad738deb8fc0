// gonio export: a fit as another program's material.
#include "fitting/export/export.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <list>
#include <optional>
#include <vector>

#include "base/file.h"
#include "base/json/reader.h"
#include "base/text.h"
#include "brdf/model/fit_misfit.h"
#include "brdf/model/fitted_model.h"
#include "cli/line/command.h"
#include "cli/line/terminal.h"
#include "fitting/export/map_export.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio::cli {
namespace {

namespace fs = std::filesystem;

struct ExportCall : Common {
  std::string fit, output;
  ExportTarget target{};
  double tolerance = default_export_tolerance;
  bool preview = false;
};

void print(const Export& e) {
  std::size_t width = 17;
  for (const auto& p : e.parameters) width = std::max(width, p.first.size() + 2);
  for (const auto& [name, values] : e.parameters)
    say("{:<{}}{}\n", name, width, fmt::format("{:.5g}", fmt::join(values, ", ")));
  const auto line = [](const ExportResidual& r) {
    const auto& at = r.largest_at;
    return fmt::format(
        "{:.3g} % off (RMS of {} directions), at worst {:.3g} %: light at {:.0f}°, "
        "view at {:.0f}°, azimuths {:.0f}° and {:.0f}°",
        100 * r.rms, export_directions, 100 * r.largest, at.theta_i, at.theta_o, at.phi_i,
        at.phi_o);
  };
  if (e.misfit)
    say("{:<{}}×/÷ {:.3g} off its table typically, before any export\n", "fit", width, *e.misfit);
  say("{:<{}}{}\n", "renamed", width, line(e.renamed));
  if (e.refitted) say("{:<{}}{}\n", "refitted", width, line(e.written));
  for (const auto& v : e.variants) say("{:<{}}{}\n", v.variant, width, line(v.residual));
  for (const auto& l : e.lost) say_below("lost    ", l);
  for (const auto& l : e.clamped)
    say_below("beware  ", l + (e.refitted ? " The refit began at the range's end."
                                          : " The range's end was written."));
  if (e.written.rms > e.tolerance)
    say_below("beware  ", fmt::format("no parameters of {} come within {:.3g} %", name_of(e.target),
                                      100 * e.tolerance));
}

/// A map's textures.
Exit run_map(const ExportCall& o) {
  if (!takes_maps(o.target))
    throw wrong_usage(
        fmt::format("--to {}: a map is written for gltf, mitsuba, open_pbr and usd_preview",
                    name_of(o.target)));
  const fs::path output(o.output);
  const std::string name = output.filename().string();
  if (o.target != ExportTarget::gltf &&
      (name.find_first_of("\"<>&'@{}") != std::string::npos || printable(name) != name))
    throw wrong_usage(fmt::format(
        "-o {}: textures are named after it; expected a name of letters that can be seen, without "
        "quotes, brackets, & and @",
        printable(o.output, 100)));
  OutputFile out(o.output);
  Progress progress(o.quiet);
  progress("exporting");
  std::vector<std::string> files;
  const MapExport e = export_map(o.fit, o.target, o.output, files);
  out.write(files[0]);
  std::list<OutputFile> textures;
  std::vector<OutputFile*> all{&out};
  for (std::size_t k = 0; k < e.textures.size(); ++k) {
    textures.emplace_back((output.parent_path() / e.textures[k]).string(), NamedBy::gonio)
        .write(files[k + 1]);
    all.push_back(&textures.back());
  }
  commit_all(all);
  progress.clear();
  if (o.json) {
    fmt::print("{}", to_json(e));
    return Exit::done;
  }
  say("textures  {} × {}, {} texels metal{}\n", e.width, e.height, e.metals,
      e.unknown ? fmt::format(", {} not known whole", e.unknown) : "");
  for (const auto& f : e.filled) {
    std::vector<std::string> values;
    for (const double v : f.value) values.push_back(fmt::format("{:.3g}", v));
    say_below("filled    ",
              fmt::format("{} of {} texels do not know {}: {} stands there{}", f.texels,
                          e.width * e.height, f.parameter, fmt::join(values, ", "),
                          f.is_default ? ", its default" : ", the map's median"));
  }
  say("residual  {:.3g} % (RMS of the median texel); one texel in 20 is off by more than {:.3g} "
      "%\n",
      100 * e.median_residual, 100 * e.high_residual);
  for (const auto& l : e.lost) say_below("lost      ", l);
  if (!e.textures.empty()) say_below("files     ", fmt::format("{}", fmt::join(e.textures, ", ")));
  return Exit::done;
}

Exit run(const ExportCall& o) {
  use(o);
  if (!std::isfinite(o.tolerance) || o.tolerance < 0)
    throw wrong_usage("--tolerance: expected a number from 0 on");
  if (o.preview && !can_preview(o.target))
    throw wrong_usage(fmt::format("--preview: found target {}, expected gltf", name_of(o.target)));
  check_outputs({o.fit}, {o.output});
  if (is_map(o.fit)) return run_map(o);
  OutputFile out(o.output);
  Progress progress(o.quiet);
  progress("exporting");
  const std::string bytes = InputFile(o.fit).read_rest(most_document_bytes);
  const FittedModel fitted = parse_fitted_model(o.fit, bytes);
  std::optional<std::size_t> channels;
  if (!fitted.channels.empty()) channels = fitted.channels.size();
  Export e = export_fit(o.target, o.fit, bind_fitted(o.fit, fitted, channels), o.tolerance);
  e.preview = o.preview;
  e.misfit = typical_misfit(o.fit, bytes);
  out.write(file_of(e, fit_document(o.fit, bytes)));
  out.commit();
  progress.clear();
  if (o.json)
    fmt::print("{}", to_json(e));
  else
    print(e);
  return Exit::done;
}

}  // namespace

void add_export(CommandLine& line) {
  auto [c, o] =
      line.command<ExportCall>("export",
                               "Writes a fit as another program's material, says how far that is "
                               "from the fit, and keeps the fit in the file",
                               "gonio export fit.json --to gltf -o paint.gltf", run);
  c.option("FIT", o->fit,
           "Document of a fit, or the map of gonio fit_map (gltf, mitsuba, open_pbr, usd_preview)")
      .required();
  c.option("--to", o->target, "Format of the file").required();
  c.option("--tolerance", o->tolerance,
           "Distance (RMS, relative) above which parameters are fitted again in the target's model")
      .show_default();
  c.flag("--preview", o->preview,
         "A sphere in the file, on which viewers show the material (gltf)");
  c.option("-o,--output", o->output, "File to write").required();
  add_follow_paths(c, *o);
  add_jobs(c, *o);
  add_output(c, *o);
}

}  // namespace gonio::cli
