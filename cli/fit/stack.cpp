// gonio stack: photographs and the list of their lamps become the document that fit_map reads.
#include "stack/stack.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "base/numbers.h"
#include "base/text.h"
#include "cli/line/command.h"
#include "cli/line/terminal.h"
#include "image/image_file.h"
#include "stack/lamps.h"
#include "stack/mirror_ball.h"
#include "stack/stack_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio::cli {
namespace {

struct StackCall : Common {
  std::string lamps, images, output;
  std::optional<std::string> dark, flat, ball;
  std::optional<double> white, saturation, floor, near;
  double reflectance = 1;
  bool linear = false;
};

/// Size and kind of numbers that all images of a stack have.
struct ImagesInCommon {
  Rectangle size;
  bool in_unit_range = true;  ///< their numbers go from 0 to 1
};
/// Opens each image and frame, which refuses those that are not light, of another size than the first or of other channels.
ImagesInCommon look_at_all(const Stack& s) {
  ImagesInCommon all;
  Rectangle& size = all.size;
  std::vector<std::string> paths, channels;
  for (const auto& image : s.images) paths.push_back(image.path);
  for (const auto& frame : {s.dark, s.flat})
    if (frame) paths.push_back(*frame);
  for (const auto& path : paths) {
    const auto file = open_image(s.path_of(path), s.linear);
    if (size.width == 0) size = {0, 0, file->width(), file->height()};
    expect_size_of(paths[0], size.width, size.height, *file);
    if (channels.empty()) channels = file->channels();
    if (file->channels() != channels)
      throw bad_input(s.path_of(path), "channels",
                      fmt::format("{}", fmt::join(file->channels(), " ")),
                      fmt::format("{}, as {} has", fmt::join(channels, " "), paths[0]));
    const bool is_frame = path == s.dark || path == s.flat;
    all.in_unit_range = all.in_unit_range && (is_frame || file->in_unit_range());
  }
  return all;
}

MirrorBall ball_of(const std::string& words) {
  std::vector<double> numbers;
  for (const auto& word : split(std::string_view(words), ','))
    numbers.push_back(number_from<double>(word).value_or(std::numeric_limits<double>::quiet_NaN()));
  if (numbers.size() != 3 || !std::ranges::all_of(numbers, [](double x) { return x >= 0; }))
    throw wrong_usage(fmt::format("--ball {}: expected X,Y,RADIUS in pixels", words));
  return {numbers[0], numbers[1], numbers[2]};
}

Exit run(const StackCall& o) {
  use(o);
  if (o.saturation && o.floor && *o.saturation <= *o.floor)
    throw wrong_usage("--saturation: expected a number above that of --floor");
  if (o.reflectance != 1 && !o.white)
    throw wrong_usage("--white-reflectance: expected --white, the number that the tile has");
  std::vector<std::string> inputs{o.lamps};
  for (const auto& frame : {o.dark, o.flat})
    if (frame) inputs.push_back(*frame);
  check_outputs(inputs, {o.output});
  if (o.ball && (o.near || !o.images.empty()))
    throw wrong_usage(
        fmt::format("--ball: it gives directions of the images in the folder that is "
                    "named, so not with {}",
                    o.near ? "--near" : "--images"));
  Stack s = o.ball ? stack_of_ball(o.lamps, ball_of(*o.ball), o.output, o.linear,
                                   {inputs.begin() + 1, inputs.end()})
                   : stack_of_lamps(o.lamps, o.images, o.output);
  s.linear = o.linear;
  for (const auto& [option, path, frame] :
       {std::tuple{"--dark", &o.dark, &s.dark}, {"--flat", &o.flat, &s.flat}})
    if (*path) *frame = name_in_stack(**path, o.output, **path, option);
  if (o.white)
    for (auto& image : s.images) image.scale = o.reflectance / (std::numbers::pi * *o.white);
  if (o.near) {  // lamps of one brightness; the tile was in the middle, under the first of them
    s.width = o.near;
    std::optional<double> first;
    for (auto& image : s.images) {
      const Vector at = std::get<SideVector<Side::light>>(image.light).towards;
      image.light = SidePosition<Side::light>{at};
      image.scale *= dot(at, at) / first.value_or(dot(at, at));
      if (!first) first = dot(at, at);
    }
  }
  s.saturation = o.saturation;
  s.floor = o.floor;
  const auto [size, in_unit_range] = look_at_all(s);
  const std::pair<const char*, std::optional<double>> numbers[] = {
      {"--white", o.white}, {"--saturation", o.saturation}, {"--floor", o.floor}};
  for (const auto& [option, number] : numbers)
    if (in_unit_range && number && *number > 1)
      throw wrong_usage(fmt::format(
          "{} {:g}: files of 16 bits have numbers from 0 to 1 here; expected that of the "
          "file over 65535, {:.4g}",
          option, *number, *number / 65535));
  if (!s.saturation && in_unit_range) s.saturation = 1;  // the largest number that they have
  if (s.dark || s.flat) StackReader::expect_frames(s);
  const std::string text = to_json(s);
  write_file(o.output, text);
  if (o.json) {
    fmt::print("{}", text);
    return Exit::done;
  }
  say("{}: {} of {} × {}\n", o.output, counted(s.images.size(), "image"), size.width, size.height);
  if (!o.white)
    say("scale   unknown: kd and f0 are off by one factor. Photograph a white tile that faces the "
        "lamp, and give its value: --white 0.8\n");
  return Exit::done;
}

}  // namespace

void add_stack(CommandLine& line) {
  auto [c, o] = line.command<StackCall>(
      "stack", "Makes the stack of a map from photographs and the list of their lamps",
      "gonio stack dome.lp --linear --white 0.8 -o stack.json", run);
  c.option("LAMPS", o->lamps,
           "List of lamps, .lp: the number of images, then NAME X Y Z a line, the vector to the "
           "lamp of each; with --ball the folder of the images")
      .required();
  c.option("--images", o->images, "Folder of the images (default: that of the list)");
  c.flag("--linear", o->linear, "The images are light, though PNG and TIFF files do not say so");
  c.option(
      "--ball", o->ball,
      "X,Y,RADIUS of a mirror ball in the images, in pixels from their left and top edges: its "
      "highlight shows where each lamp was");
  c.option("--near", o->near,
           "Width of the surface that the images show: the vectors to lamps are their places, in "
           "the same unit, from the middle of the image (default: lamps are far away)")
      .in(1e-9, 1e9);
  c.option("--dark", o->dark,
           "Photograph without light, as one with the lens cap on: its numbers are taken off all "
           "others first");
  c.option("--flat", o->flat,
           "Photograph of a white sheet under even light: it shows how a lens darkens towards the "
           "corners, and all others are divided by it");
  c.option("--white", o->white,
           "Number that a white diffuse tile facing the lamp has in the images, from 0 to 1 where "
           "they have 16 bits: what gives f its scale")
      .in(1e-9, 1e9);
  c.option("--white-reflectance", o->reflectance, "Reflectance of that tile")
      .in(0.01, 1.0)
      .show_default();
  c.option("--saturation", o->saturation,
           "Number of the images from which on light is clipped: left out (default: the largest "
           "that 16 bits hold)")
      .in(1e-9, 1e30);
  c.option(
       "--floor", o->floor,
       "Number of the images up to which there is shadow or noise: left out (default: nothing is)")
      .in(0.0, 1e30);
  c.option("-o,--output", o->output, "Document to write; the images lie in its folder or below")
      .required();
  add_output(c, *o);
}

}  // namespace gonio::cli
