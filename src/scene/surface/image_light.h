#pragma once
/// \file
/// Environment of a scene as image-based light has it: two lookups for a lobe in place of an integral over directions.

#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "brdf/formula/coat.h"
#include "brdf/formula/scattering.h"
#include "geometry/sampling.h"
#include "integrate/light/prefiltered.h"
#include "optics/fresnel_approximate.h"
#include "scene/description/scene.h"

namespace gonio::scene {

/// Point of a surface, as an environment's maps are looked up for it.
struct SkyView {
  Direction normal, mirror;  ///< of the map; the way to the viewer, mirrored about the normal
  double nov = 1;
};

SkyView sky_view(const Frame&, const Direction& to_viewer);

/// Maps of an environment and tables of lobes, each made when first asked for.  All calls may come from many threads.
class ImageLight {
 public:
  /// \param light  outlives this
  explicit ImageLight(const EnvironmentLight& light) : light_(light) {}

  /// Split sum of GGX under a masking: P, and A and B at the centres of `cosines` equal steps of NoV.
  struct Lobe {
    static constexpr std::size_t cosines = 64;
    FilteredLight light;
    std::array<double, cosines> a{}, b{};
  };
  std::shared_ptr<const Lobe> lobe(const std::string& masking, double alpha) const;
  /// E/π, and what a white coupled Lambertian reflects by NoV as split_sum_diffuse() has it.
  struct Even {
    FilteredLight mean;
    std::array<double, Lobe::cosines> diffuse{};
  };
  std::shared_ptr<const Even> even() const;
  double scale() const { return light_.scale; }

 private:
  const LightPyramid& pyramid() const;

  const EnvironmentLight& light_;
  mutable std::mutex making_;
  mutable std::optional<LightPyramid> pyramid_;
  mutable std::map<std::pair<std::string, double>, std::shared_ptr<const Lobe>> lobes_;
  mutable std::shared_ptr<const Even> even_;
};

/// Surface as the split sum of renderers sees it: Schlick's Fresnel, GGX as wide in all directions, Lambert's diffuse.
struct ImageLitParts {
  struct Layer {
    std::string masking;  ///< of GGX: "smith_ggx.correlated"
    double alpha = 1;
    Rgb f0{};
    double weight = 1;
  };
  std::optional<Layer> lobe, coat;
  Rgb kd{};
  bool coupled = false, compensated = false;
};

/// What is looked up for one point.
template <class T>
struct LookedUp {
  T nov{};
  std::array<T, 3> mean{}, lobe{}, coat{};  ///< radiance: E/π, P, and P of the coat
  T a{}, b{}, coat_a{}, coat_b{};
  T diffuse{};
};

/// Light that is sent to the viewer, nothing being in its way.
///
///   L = P (F0 A + B) + F_ms (1 − A − B) E/π + kd (1 − F0) diffuse E/π                       [Karis 2013; Fdez-Agüera 2019]
///
/// the middle where light is followed through several bounces, with F_ms = (F0 A + B) F_avg/(1 − F_avg (1 − A − B)); of an uncoupled
/// diffuse kd E/π.  A coat lies on all of it:
///
///   w P_c (F0_c A_c + B_c) + (1 − w F_c(NoV)) L
template <Real T>
std::array<T, 3> image_lit(const ImageLitParts& p, const LookedUp<T>& at) {
  std::array<T, 3> sum;
  for (std::size_t c = 0; c < 3; ++c) {
    sum[c] = T(0);
    if (p.kd[c] > 0) {
      sum[c] = T(p.kd[c]) * at.mean[c];
      if (p.coupled) sum[c] = sum[c] * (T(p.lobe ? 1 - p.lobe->f0[c] : 1) * at.diffuse);
    }
    if (p.lobe) {
      const T f0(p.lobe->f0[c]), once = f0 * at.a + at.b;
      sum[c] = sum[c] + once * at.lobe[c];
      if (p.compensated) {
        const T lost = 1 - at.a - at.b, average = schlick_average<T>(f0);
        sum[c] = sum[c] + once * average * lost / (1 - average * lost) * at.mean[c];
      }
    }
    if (p.coat) {
      const T f0(p.coat->f0[c]), weight(p.coat->weight);
      const T once = weight * (f0 * at.coat_a + at.coat_b);
      sum[c] = sum[c] * left_by_view<T>(weight * schlick<T>(f0, schlick_weight(at.nov))) +
               once * at.coat[c];
    }
  }
  return sum;
}

/// Light of an environment that a surface sends to viewers by the split sum.
class ImageLit {
 public:
  ImageLit(const ImageLight&, ImageLitParts);
  Rgb operator()(const SkyView&) const;
  const ImageLitParts& parts() const { return parts_; }

 private:
  ImageLitParts parts_;
  std::shared_ptr<const ImageLight::Lobe> lobe_, coat_;
  std::shared_ptr<const ImageLight::Even> even_;
  double scale_;
};

}  // namespace gonio::scene
