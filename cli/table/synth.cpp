// gonio synth: a table, or a stack of images, sampled from a model.
#include "data_synth/synth.h"

#include <algorithm>

#include "answer/model_argument.h"
#include "cli/line/command.h"
#include "cli/line/terminal.h"
#include "data_synth/stack_synth.h"
#include "image/image_file.h"
#include "table/format/csv.h"
#include "table/format/formats.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gonio::cli {
namespace {

using Json = nlohmann::ordered_json;

struct SynthCall : Common {
  std::string spec, layout, output;
  std::vector<std::string> set;
  std::optional<std::string> bins;
  SynthOptions synth;
  // Of the layout map alone:
  std::optional<std::string> parameters, normals, directions, size, values, images_as;
  std::optional<std::size_t> images;
  bool half = false;
};
constexpr const char* map_layout = "map";

/// "1,458,000"
std::string with_commas(std::size_t n) {
  std::string s = std::to_string(n);
  for (std::size_t k = s.size(); k > 3; k -= 3) s.insert(k - 3, ",");
  return s;
}

void print(const Table& t, const SynthCall& o) {
  std::string how = o.synth.noise > 0 ? "noise " + percent(o.synth.noise) : "no noise";
  if (o.synth.floor > 0) how += fmt::format(", floor {:g} 1/sr", o.synth.floor);
  if (o.synth.outliers > 0) how += ", outliers " + percent(o.synth.outliers);
  if (o.synth.noise > 0 || o.synth.outliers > 0 || o.layout == "random")
    how += fmt::format(", seed {}", o.synth.seed);
  say_below(o.output + ": ",
            fmt::format("{}, {} directions, {} {}, {}", t.format, with_commas(t.size()),
                        t.channels.size() == 1 ? "channel" : "channels",
                        fmt::to_string(fmt::join(t.channels, " ")), how));
}

/// SynthCall that a layout does not read are refused: what was asked for would not be done.
void expect_options_of(const SynthCall& o) {
  const bool map = o.layout == map_layout;
  for (const auto& [given, option] : {std::pair(o.parameters.has_value(), "--parameters"),
                                      {o.normals.has_value(), "--normals"},
                                      {o.directions.has_value(), "--directions"},
                                      {o.size.has_value(), "--size"},
                                      {o.values.has_value(), "--values"},
                                      {o.images_as.has_value(), "--images-as"},
                                      {o.images.has_value(), "--images"},
                                      {o.half, "--half"}})
    if (given && !map)
      throw wrong_usage(fmt::format("{} goes with --layout map, not {}", option, o.layout));
  for (const auto& [given, option] : {std::pair(o.bins.has_value(), "--bins"),
                                      {o.synth.floor > 0, "--floor"},
                                      {o.synth.outliers > 0, "--outliers"}})
    if (given && map) throw wrong_usage(fmt::format("{} goes with a table, not a stack", option));
  if (o.images && o.directions)
    throw wrong_usage("--images draws directions at random; --directions has them");
}

Exit run_map(const SynthCall& o) {
  StackSynthOptions s;
  s.parameters = o.parameters;
  s.normals = o.normals;
  s.noise = o.synth.noise;
  s.seed = o.synth.seed;
  if (o.images) s.images = *o.images;
  if (o.size) {
    if (o.parameters || o.normals)
      throw wrong_usage("--size goes with constants; images have a size of their own");
    const auto size = two_numbers(*o.size, "--size", 1, longest_side, true);
    s.width = size[0];
    s.height = size[1];
  }
  if (o.values) s.values = value_of<StackValues>(*o.values, "values");
  if (o.images_as) s.format = value_of<ImageFormat>(*o.images_as, "images-as");
  if (o.half) {
    if (s.format == ImageFormat::npy) throw wrong_usage("--half goes with --images-as exr");
    s.storage = Storage::half;
  }
  auto inputs = file_in(o.spec);
  for (const auto& path : {o.parameters, o.normals, o.directions})
    if (path) inputs.push_back(*path);
  check_outputs(inputs, {o.output});
  if (o.directions) {
    InputFile in(*o.directions);
    s.directions = *read_directions_csv(in).list();
  }
  const auto model = model_argument(o.spec, parse_settings(o.set)).model;
  Progress progress(o.quiet);
  progress("sampling");
  const Stack stack = synthesize_stack(model, s, o.output);
  progress.clear();
  if (o.json)
    print_document({{"path", stack.path}, {"layout", o.layout}, {"images", stack.images.size()}});
  else if (!o.quiet)
    say_below(stack.path + ": ",
              fmt::format("{} images, {}", stack.images.size(),
                          s.noise > 0 ? fmt::format("noise {}, seed {}", percent(s.noise), s.seed)
                                      : "no noise"));
  return Exit::done;
}

Exit run(const SynthCall& o) {
  use_jobs(o.jobs);
  expect_options_of(o);
  if (o.layout == map_layout) return run_map(o);
  check_outputs(file_in(o.spec), {o.output});
  SynthOptions s = o.synth;
  s.layout = value_of<Layout>(o.layout, "layout");
  s.bins = bins_from(o.bins).value_or(Bins::centre);
  const auto model = model_argument(o.spec, parse_settings(o.set)).model;
  Progress progress(o.quiet);
  progress("sampling");
  const Table t = synthesize(model, s);
  progress("writing " + o.output);
  write_table(t, o.output);
  progress.clear();
  if (o.json)
    print_document(
        {{"path", o.output}, {"format", t.format}, {"layout", o.layout}, {"samples", t.size()}});
  else if (!o.quiet)
    print(t, o);
  return Exit::done;
}

}  // namespace

void add_synth(CommandLine& line) {
  auto [c, o] = line.command<SynthCall>(
      "synth", "Samples a table, or a stack of images, from a model, with noise if asked",
      "gonio synth lambert+ggx/smith_ggx.correlated/schlick --set alpha=0.15 kd=0.2,0.1,0.05 "
      "--layout merl --noise 0.02 -o paint.binary\n  gonio synth "
      "lambert+ggx/smith_ggx.correlated/schlick --layout map --parameters maps.exr -o stack/",
      run);
  c.option("MODEL", o->spec, spec_or_fit).required();
  add_set(c, o->set);
  std::vector<std::string> layouts(names_of<Layout>.begin(), names_of<Layout>.end());
  layouts.emplace_back(map_layout);
  c.option("--layout", o->layout,
           "merl, mbsdf, utia, rgl, in_plane, image_slice, hemisphere or random; map: a stack of "
           "images in a folder")
      .one_of(layouts)
      .required();
  add_bins(c, o->bins);
  c.option("--samples", o->synth.samples, "Number of samples of the random layout")
      .in(1, 10'000'000)
      .show_default();
  c.option("--noise", o->synth.noise, "Multiplies each value by exp(NOISE · z), z standard normal")
      .in(0.0, 5.0);
  c.option("--floor", o->synth.floor, "Added to every value before the noise [1/sr]").in(0.0, 1e6);
  c.option("--outliers", o->synth.outliers, "Share of samples thrown off by up to 100 times")
      .in(0.0, 1.0);
  add_seed(c, o->synth.seed, "Seed of all that is random (1)");
  c.option("--parameters", o->parameters,
           "Map: image with a channel for each parameter that varies, as alpha or kd.R");
  c.option("--normals", o->normals, "Map: image of normals, linear in [-1, 1]");
  c.option("--size", o->size, "Map: WIDTH,HEIGHT where no image says it (64,64)");
  c.option("--images", o->images, "Map: number of images, of directions at random (16)")
      .in<std::size_t>(1, 512);
  c.option("--directions", o->directions,
           "Map: CSV with theta_i,phi_i,theta_o,phi_o in degrees, an image for each line");
  c.option("--values", o->values, "Map: f_r, or f_r_cosine: what a camera sees (f_r)")
      .one_of(names_of<StackValues>);
  c.option("--images-as", o->images_as, "Map: exr or npy (exr)").one_of(names_of<ImageFormat>);
  c.flag("--half", o->half, "Map: images in half precision");
  c.option("-o,--output", o->output, "File to write; of a map a folder").required();
  add_jobs(c, *o);
  add_output(c, *o);
}

}  // namespace gonio::cli
