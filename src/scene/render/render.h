#pragma once
/// \file
/// Pictures of a scene: radiance by pixel.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "scene/description/scene.h"
#include "scene/surface/surface.h"

namespace gonio::scene {

/// Material, as a picture shows it.
struct Shown {
  Surface surface;
  std::vector<double>
      widths;  ///< what directions are drawn from: those of all forms, so that the same are drawn
  double turn = 0;  ///< of the tangent about the normal [rad]

  Shown(const Look& look, const Forms& forms)
      : surface(look.surface(forms)), widths(look.widths()), turn(look.turn()) {}
};

struct RenderOptions {
  std::size_t width = 512, height = 512;
  std::size_t samples = 64;  ///< of a pixel
  std::uint64_t seed = 1;
};

struct Picture {
  std::size_t width = 0, height = 0;
  std::vector<Rgb> radiance;  ///< linear RGB, row by row from the top
};

/// Picture from the middle of the scene's views, where nothing is hit the environment or black.  Light comes from the
/// lights alone: objects do not light each other, but they cast shadows.
///
/// Directions follow from the options alone, whatever the surfaces and whatever the threads.
///
/// \param materials  as many as the scene has
/// \param progress   is told how many of all parts are done, by one thread at a time
Picture render(const Scene&,
               std::span<const Shown> materials,
               const RenderOptions&,
               const std::function<void(std::size_t done, std::size_t all)>& progress = {});

}  // namespace gonio::scene
