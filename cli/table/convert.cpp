// gonio convert: a table in another format, and what that lost.
#include "table/convert/convert.h"

#include <cmath>
#include <filesystem>

#include "base/text.h"
#include "cli/line/command.h"
#include "cli/line/terminal.h"
#include "table/format/formats.h"
#include "table/format/measured_by.h"
#include "table/format/metadata.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gonio::cli {
namespace {

using Json = nlohmann::ordered_json;

struct ConvertCall : Common {
  std::string input, output;
  std::optional<Bins> bins;
  AsMeasured measured;
  ConvertOptions convert;
};

std::string format_of(const ConvertCall& o) {
  if (!o.convert.format.empty()) return o.convert.format;
  const auto extension = std::filesystem::path(o.output).extension().string();
  if (extension == ".binary") return "merl";
  if (extension == ".bin") return "utia";
  if (extension == ".bsdf") return "rgl";
  if (extension == ".mbsdf" || extension == ".csv" || extension == ".exr")
    return extension.substr(1);
  throw wrong_usage(fmt::format(
      "what {} is to be is not clear: --to merl, mbsdf, utia, csv, exr, rgl or zemax", o.output));
}

std::string layout(const Table& t) {
  const Grid* g = t.grid();
  if (!g) return fmt::format("{}, {} samples", t.format, t.size());
  std::string s = t.format + ",";
  for (const auto& a : g->axes)
    if (a.spacing == Axis::Spacing::constant)
      s += fmt::format(" at {} {:g}°", a.name, a.span / degree);
    else
      s += fmt::format("{}{} {}", s.back() == ',' ? " " : " × ", a.size, a.name);
  return s + (t.has_bins() ? fmt::format(", bins {}", name_of(g->bins)) : "");
}

/// Way that the values were converted, in words.
std::string method(const Table& from, const Loss& l, double reach_deg) {
  switch (l.method) {
    case Loss::Method::copied:
      return "value for value";
    case Loss::Method::listed:
      return fmt::format("each bin as its direction, {} below the horizon left out", l.left_out);
    case Loss::Method::interpolated:
      return from.grid() ? "interpolated (trilinear)" : "interpolated as the format says";
    case Loss::Method::gathered:
      break;
  }
  return fmt::format("mean of the samples in a bin; {} of the bins took the nearest within {:g}°",
                     percent(l.nearest, l.bins), reach_deg);
}

std::array<double, 3> angles_deg(const DirectionPair& p) {
  return {theta_of(p.wi) / degree, theta_of(p.wo) / degree,
          std::abs(std::remainder(phi_of(p.wo) - phi_of(p.wi), 2 * std::numbers::pi)) / degree};
}

void print(const Table& from, const Conversion& c, const ConvertCall& o) {
  const auto line = [](const char* what, const std::string& text) {
    say("{:<14}{}\n", what, text);
  };
  const Loss& l = c.loss;
  line("from", layout(from));
  line("to", layout(c.table));
  for (const auto& [key, text] : from.notes)
    if (key == "reference") line("reference", text);
  line("values", method(from, l, o.convert.reach_deg) + (l.rounded ? ", rounded to float" : ""));
  line("no data",
       fmt::format("{} of {} {} above the horizon{}", percent(l.without_data, l.bins), l.bins,
                   c.table.grid() || l.method == Loss::Method::gathered ? "bins" : "samples",
                   l.filled ? ": they have the value of the nearest that has one" : ""));
  if (l.azimuth)
    line("azimuth",
         fmt::format("the surface turned changes f by {} on average", percent(*l.azimuth)));
  if (l.to_spectra) line("channels", "as spectra");
  if (l.mirror)
    line("azimuth",
         fmt::format("φ and −φ averaged: their median difference is {}", percent(*l.mirror)));
  if (l.reciprocity)
    line("reciprocity", fmt::format("(wi, wo) and (wo, wi) averaged: their median difference is {}",
                                    percent(*l.reciprocity)));
  if (l.one_phi_d) line("phi_d", "the slice was taken to hold for every phi_d");
  if (l.replicated) line("channels", "one written as three");
  if (!l.dropped.empty()) line("channels", fmt::format("dropped {}", fmt::join(l.dropped, " ")));
  if (!l.renamed.empty())
    line("channels", fmt::format("{} have become r g b", fmt::join(l.renamed, " ")));
  if (l.weights_dropped) line("weights", "dropped");
  if (l.compared == 0) {
    line("and back", "nothing");
  } else if (l.largest == 0 && l.lost == 0) {
    line("and back", "the same values");
  } else {
    const auto [in, out, phi] = angles_deg(l.largest_at);
    line(
        "and back",
        fmt::format("RMS difference {}, largest {} (theta_i {:.1f}°, theta_o {:.1f}°, phi {:.1f}°)",
                    percent(l.rms), percent(l.largest), in, out, phi));
    if (l.most) line("and back", fmt::format("99 % of the values within {}", percent(*l.most)));
    if (l.lost)
      line("and back",
           fmt::format("nothing for {} of the values", percent(l.lost, l.compared + l.lost)));
  }
}

Json to_json(const Table& from, const Conversion& c, const ConvertCall& o) {
  const auto side = [](const Table& t, const std::string& path) {
    return Json{{"path", path},
                {"format", t.format},
                {"channels", t.channels},
                {"samples", t.size()},
                {"bins", t.has_bins() ? name_of(t.bins()) : "none"}};
  };
  const auto maybe = [](const std::optional<double>& v) { return v ? Json(*v) : Json(); };
  const Loss& l = c.loss;
  Json largest_at;
  if (l.largest > 0) {
    const auto [in, out, phi] = angles_deg(l.largest_at);
    largest_at = {{"theta_i_deg", in}, {"theta_o_deg", out}, {"phi_deg", phi}};
  }
  return {{"input", side(from, o.input)},
          {"output", side(c.table, o.output)},
          {"method", name_of(l.method)},
          {"bins_above_horizon", l.bins},
          {"bins_without_data", l.without_data},
          {"bins_from_nearest", l.nearest},
          {"bins_left_out", l.left_out},
          {"mirror_difference", maybe(l.mirror)},
          {"reciprocity_difference", maybe(l.reciprocity)},
          {"bins_filled", l.filled ? l.without_data : 0},
          {"azimuth_difference", maybe(l.azimuth)},
          {"one_phi_d", l.one_phi_d},
          {"rounded_to_float", l.rounded},
          {"channels_replicated", l.replicated},
          {"channels_dropped", l.dropped},
          {"channels_renamed", l.renamed},
          {"channels_to_spectra", l.to_spectra},
          {"weights_dropped", l.weights_dropped},
          {"there_and_back",
           {{"compared", l.compared},
            {"lost", l.lost},
            {"rms", l.rms},
            {"within_99_percent", maybe(l.most)},
            {"largest", l.largest},
            {"largest_at", largest_at}}}};
}

Exit run(const ConvertCall& o) {
  use(o);
  ConvertOptions options = o.convert;
  options.format = format_of(o);
  options.channels = o.measured.channel_names();  // convert() picks them, and says what it drops
  AsMeasured measured = o.measured;
  measured.channels.clear();
  check_outputs({o.input}, {o.output});
  Progress progress(o.quiet);
  progress("reading " + o.input);
  Table from = read_table(o.input, o.bins);
  take(from, measured);
  progress("converting");
  const Conversion c = convert(from, options);
  progress("writing " + o.output);
  write_table(c.table, o.output);
  progress.clear();
  if (o.json)
    print_document(to_json(from, c, o));
  else
    print(from, c, o);
  return Exit::done;
}

}  // namespace

void add_convert(CommandLine& line) {
  auto [c, o] = line.command<ConvertCall>(
      "convert", "Writes a table in another format and says what that loses",
      "gonio convert paint.binary paint.mbsdf", run);
  c.option("IN", o->input, "Table").required();
  c.option("OUT", o->output, "File to write").required();
  c.option("--to", o->convert.format,
           "merl, mbsdf, utia, csv, exr (a slice), rgl or zemax; default: by OUT's ending, .binary "
           "being "
           "merl, .bin utia and .bsdf rgl")
      .one_of({"merl", "mbsdf", "utia", "csv", "exr", "rgl", "zemax"});
  add_bins(c, o->bins);
  c.options(o->measured);
  c.option("--to-bins", o->convert.bins, "Where a sample sits in OUT's bins (default: as in IN)");
  c.option("--theta", o->convert.n_theta,
           "Bins of theta_i and theta_o (mbsdf; default 45), or incident angles (rgl; default 32)")
      .in(1, 180);
  c.option("--phi", o->convert.n_phi, "Samples of phi over 0 to 180° (mbsdf; default 90)")
      .in(2, 721);
  c.option("--phi-d", o->convert.phi_d_deg, "phi_d of the slice in degrees (exr; default 90)")
      .in(0.0, 180.0);
  c.option("--grid", o->convert.n_grid,
           "Values along each side of the unit square (rgl; default 64)")
      .in(4, 512);
  c.flag("--spectral", o->convert.spectral, "Spectra in place of r, g, b (rgl): what pbrt reads");
  c.option("--reach", o->convert.reach_deg,
           "How far an empty bin looks for a sample of a list, in degrees")
      .in(0.0, 30.0)
      .show_default();
  add_jobs(c, *o);
  add_output(c, *o);
}

}  // namespace gonio::cli
