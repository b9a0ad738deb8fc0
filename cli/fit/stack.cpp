// gonio stack: photographs and the list of their lamps become the document that fit_map reads.
#include "stack/stack.h"

#include <algorithm>
#include <numbers>
#include <optional>

#include "base/error.h"
#include "base/file.h"
#include "base/text.h"
#include "cli/line/command.h"
#include "cli/line/terminal.h"
#include "image/image_file.h"
#include "stack/lamps.h"
#include "stack/stack_reader.h"

#include <fmt/format.h>

namespace gonio::cli {
namespace {

struct StackCall : Common {
  std::string lamps, images, output;
  std::optional<double> white, saturation, floor;
  double reflectance = 1;
  bool linear = false;
};

/// What the images of a stack share.
struct ImagesInCommon {
  Rectangle size;
  bool in_unit_range = true;  ///< their numbers go from 0 to 1
};
/// Opens each image, which refuses those that are not light or of another size than the first.
ImagesInCommon look_at_all(const Stack& s) {
  ImagesInCommon all;
  Rectangle& size = all.size;
  for (const auto& image : s.images) {
    const auto file = open_image(s.path_of(image.path), s.linear);
    if (size.width == 0) size = {0, 0, file->width(), file->height()};
    expect_size_of(s.images[0].path, size.width, size.height, *file);
    all.in_unit_range = all.in_unit_range && file->in_unit_range();
  }
  return all;
}

Exit run(const StackCall& o) {
  use(o);
  if (o.saturation && o.floor && *o.saturation <= *o.floor)
    throw wrong_usage("--saturation: expected a number above that of --floor");
  if (o.reflectance != 1 && !o.white)
    throw wrong_usage("--white-reflectance: expected --white, the number that the tile has");
  check_outputs({o.lamps}, {o.output});
  Stack s = stack_of_lamps(o.lamps, o.images, o.output);
  s.linear = o.linear;
  if (o.white)
    for (auto& image : s.images) image.scale = o.reflectance / (std::numbers::pi * *o.white);
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
           "lamp of each")
      .required();
  c.option("--images", o->images, "Folder of the images (default: that of the list)");
  c.flag("--linear", o->linear, "The images are light, though PNG and TIFF files do not say so");
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
