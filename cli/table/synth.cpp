// gonio synth: a table, or a stack of images, sampled from a model.
#include "data_synth/synth.h"

#include <algorithm>

#include "answer/model_argument.h"
#include "cli/line/command.h"
#include "cli/line/reading.h"
#include "cli/line/terminal.h"
#include "data_synth/stack_synth.h"
#include "image/image_file.h"
#include "table/format/csv.h"
#include "table/format/formats.h"
#include "table/format/measured_by.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gonio::cli {
namespace {

using Json = nlohmann::ordered_json;

struct SynthCall : Common {
  ReadingWords reading;
  std::string spec, layout, output;
  std::vector<std::string> set;
  SynthOptions synth;
  std::optional<std::string> aperture;
  // Of the layout map alone:
  StackSynthOptions map;
  std::optional<std::string> directions, size;
  bool half = false;
  std::vector<Option> sampled, of_map;
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

/// Options that a layout does not read are refused: what was asked for would not be done.
void expect_options_of(const SynthCall& o) {
  const bool map = o.layout == map_layout;
  const auto given = [](const std::vector<Option>& options, auto... names) {
    std::string first;
    for (const Option& option : options)
      if (const auto words = option.given(); !words.empty() && first.empty())
        if (sizeof...(names) == 0 || ((words[0] == names) || ...)) first = words[0];
    return first;
  };
  if (const auto name = given(o.of_map); !map && !name.empty())
    throw wrong_usage(fmt::format("{} goes with --layout map, not {}", name, o.layout));
  if (const auto name =
          given(o.sampled, "--bins", "--floor", "--outliers", "--aperture", "--uncertainty");
      map && !name.empty())
    throw wrong_usage(fmt::format("{} goes with a table, not a stack", name));
  if (o.directions && !given(o.of_map, "--images").empty())
    throw wrong_usage("--images draws directions at random; --directions has them");
}

Exit run_map(const SynthCall& o) {
  StackSynthOptions s = o.map;
  s.noise = o.synth.noise;
  s.seed = o.synth.seed;
  if (o.size) {
    if (s.parameters || s.normals)
      throw wrong_usage("--size goes with constants; images have a size of their own");
    const auto size = two_numbers(*o.size, "--size", 1, longest_side, true);
    s.width = size[0];
    s.height = size[1];
  }
  if (o.half) {
    if (s.format == ImageFormat::npy) throw wrong_usage("--half goes with --images-as exr");
    s.storage = Storage::half;
  }
  auto inputs = file_in(o.spec);
  for (const auto& path : {s.parameters, s.normals, o.directions})
    if (path) inputs.push_back(*path);
  check_outputs(inputs, {o.output});
  if (o.directions) {
    InputFile in(*o.directions);
    s.directions = *read_directions_csv(in).list();
  }
  const auto model = model_argument(read_as(o.spec, o.reading), parse_settings(o.set)).model;
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
  use(o);
  expect_options_of(o);
  if (o.layout == map_layout) return run_map(o);
  check_outputs(file_in(o.spec), {o.output});
  SynthOptions s = o.synth;
  s.layout = value_of<Layout>(o.layout, "layout");
  const auto model = model_argument(read_as(o.spec, o.reading), parse_settings(o.set)).model;
  Progress progress(o.quiet);
  progress("sampling");
  const Table t = synthesize(model, s, o.aperture ? aperture_from(*o.aperture) : Aperture{});
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
  add_reading(c, o->reading);
  std::vector<std::string> layouts(names_of<Layout>.begin(), names_of<Layout>.end());
  layouts.emplace_back(map_layout);
  c.option("--layout", o->layout,
           "merl, mbsdf, utia, rgl, in_plane, image_slice, hemisphere or random; map: a stack of "
           "images in a folder")
      .one_of(layouts)
      .required();
  o->sampled = c.options(o->synth);
  o->sampled.push_back(c.option("--aperture", o->aperture, aperture_in_words));
  o->of_map = c.options(o->map);
  for (const Option& option :
       {c.option("--size", o->size, "Map: WIDTH,HEIGHT where no image says it (64,64)"),
        c.option("--directions", o->directions,
                 "Map: CSV with theta_i,phi_i,theta_o,phi_o in degrees, an image for each line"),
        c.flag("--half", o->half, "Map: images in half precision")})
    o->of_map.push_back(option);
  c.option("-o,--output", o->output, "File to write; of a map a folder").required();
  add_follow_paths(c, *o);
  add_jobs(c, *o);
  add_output(c, *o);
}

}  // namespace gonio::cli
