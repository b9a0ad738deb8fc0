#pragma once
/// \file
/// Stacks of images sampled from the models, with noise: what a camera would have measured of a surface whose parameters vary.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/describe.h"
#include "base/names.h"
#include "brdf/model/model.h"
#include "image/exr.h"
#include "stack/stack.h"
#include "table/table.h"

namespace gonio {

enum class ImageFormat { exr, npy };
template <>
inline constexpr std::array<std::string_view, 2> names_of<ImageFormat>{"exr", "npy"};

struct StackSynthOptions {
  std::size_t width = 64, height = 64;      ///< where no image says it
  std::size_t images = 16;                  ///< of directions as random_pairs() draws them
  std::optional<DirectionList> directions;  ///< of the images, in place of random ones
  /// Path of an image with channels by the names of parameters, as "alpha" or, of colours, "kd.R", "kd.G", "kd.B" or "kd"; those of
  /// a map that gonio fitted.  What it has not is as in the model.
  std::optional<std::string> parameters;
  std::optional<std::string> normals;  ///< path of an image of normals
  StackValues values = StackValues::f_r;
  ImageFormat format = ImageFormat::exr;
  Storage storage = Storage::single;  ///< of OpenEXR
  double noise = 0;  ///< values are multiplied by exp(noise · z), z standard normal
  std::uint64_t seed = 1;
};
/// What `gonio synth` takes for stacks alone.
template <>
inline constexpr auto description<StackSynthOptions> = FieldList{
    Field{"parameters", &StackSynthOptions::parameters,
          "Map: image with a channel for each parameter that varies, as alpha or kd.R"},
    Field{"normals", &StackSynthOptions::normals, "Map: image of normals, linear in [-1, 1]"},
    Field{"images", &StackSynthOptions::images, "Map: number of images, of directions at random",
          Numbers{1, 512}},
    Field{"values", &StackSynthOptions::values, "Map: f_r, or f_r_cosine: what a camera sees"},
    Field{"images_as", &StackSynthOptions::format, "Map: format of the images"}};

/// Writes a stack into a folder: stack.json, an image for each pair of directions, parameters.exr with the model's parameters, and normals.exr where there
/// are any.  Nothing is left there where it fails.  Values are 0 below the horizon, and NaN where a parameter is or the normal is none.
/// The same for a seed whatever the threads.  Memory: 16 rows of all images.
/// \throws Error  wrong usage; bad_input of a parameter outside its range, by its place
Stack synthesize_stack(const BoundModel&, const StackSynthOptions&, const std::string& folder);

}  // namespace gonio
