#include "image/environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/error.h"
#include "image/exr.h"

#include <fmt/format.h>

namespace gonio {

Environment read_environment(const std::string& path) {
  constexpr std::size_t most = std::size_t{8192} * 4096 * 3;
  const Image header = read_exr_header(path);
  if (header.width != 2 * header.height)
    throw bad_input(path, "header", fmt::format("{} × {} pixels", header.width, header.height),
                    "a map over longitude and latitude, twice as wide as high");
  const Image image = read_exr(path, most, {"R", "G", "B"});
  Environment e{image.width, image.height, {}};
  e.radiance.resize(image.planes[0].size());
  double light = 0, taken = 0;
  const auto refuse = [&](std::size_t k, std::size_t c, const char* expected) {
    return bad_input(path, fmt::format("pixel ({}, {})", k % e.width, k / e.width),
                     fmt::format("{} = {}", image.channels[c], image.planes[c][k]), expected);
  };
  std::optional<Error> first;
  for (std::size_t k = 0; k < e.radiance.size(); ++k)
    for (std::size_t c = 0; c < 3; ++c) {
      const float v = image.planes[c][k];
      if (!std::isfinite(v)) throw refuse(k, c, "radiance, a finite number");
      e.radiance[k][c] = std::max(v, 0.0F);
      light += double{v};
      if (v < 0) {
        if (!first) first = refuse(k, c, "radiance, not negative");
        ++e.negative;
        taken -= double{v};
      }
    }
  if (taken > 1e-3 * (light + taken)) throw *first;
  return e;
}

}  // namespace gonio
