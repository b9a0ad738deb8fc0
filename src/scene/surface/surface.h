#pragma once
/// \file
/// Surface of a material, its effects in chosen forms, and which forms a material leaves to choose.

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "brdf/model/model.h"
#include "integrate/scattering/tabulated_lobe.h"
#include "scene/description/scene.h"
#include "scene/kernel/spectral.h"
#include "scene/surface/effect.h"
#include "scene/surface/image_light.h"
#include "scene/surface/lobe_albedo.h"

namespace gonio::scene {

/// Light that leaves the first lobe after several bounces, in a form of Effect::compensation.
struct MultipleScattering {
  Form form = Form::uncompensated;
  AlbedoCurve<double> albedo{};
  /// By channel: of turquin F0; of fdez_aguera F_avg; of kulla_conty f of two directions from which
  /// nothing comes out at once [1/sr].
  std::array<double, 3> strength{};
  std::shared_ptr<const TabulatedLobe> lobe;  ///< of tabulated
};

/// Surface, as it is evaluated: three channels.
struct Surface {
  BoundModel base;                 ///< diffuse terms and lobes
  std::optional<BoundModel> coat;  ///< one lobe; what is below it loses what the lobe's F keeps
  MultipleScattering multiple;
  /// What the F of the first lobe is in place of the model's.
  std::optional<SpectralMetal<double>> spectrum;
  /// What an environment's light gives, where that is not gathered direction by direction.
  std::shared_ptr<const ImageLit> image_lit;
  bool single = false;  ///< computed in float

  /// "lambert.coupled+ggx/smith_ggx.correlated/schlick+coat:ggx/…"
  std::string spec() const;
  /// Every parameter of that spec; those of the coat end in the number of its lobe.
  std::vector<std::pair<std::string, std::vector<double>>> parameters() const;
};

/// Forms of an effect that a material leaves to choose.
struct Offer {
  std::vector<Form> forms;  ///< cheapest first, the exact one last; never empty
  /// Cheapest form that gives exactly what the exact one gives, and in words why; the exact one itself where every
  /// cheaper form may differ.
  Form same_as_exact{};
  std::string why;
};

/// Material, as its effects see it.
///
/// Exact is what the material stands for: GGX and Beckmann under Smith's correlated masking, a conductor or dielectric under
/// Fresnel's equations, with all that the first lobe's facets reflect after several bounces, tabulated from random walks.  No walk on
/// GTR is known: Kulla and Conty's lobe stands there.  A grey F0 of at most a quarter is a
/// dielectric's; a coloured F0 says nothing of other angles, so that Schlick's form is then all there is.  Of a metal that is
/// named, Fresnel's equations hold for every wavelength, under light of D65's spectrum that a light's colour filters.  Effects
/// that a material does not show, an absent coat or a diffuse albedo of 0, stand in the exact form all the
/// same, for that is what a shader for every material computes.
class Look {
 public:
  /// \param sky  environment that the material stands in; nullptr: none
  explicit Look(const Material&, std::shared_ptr<const ImageLight> sky = nullptr);

  const Offer& offer(Effect e) const { return offers_[static_cast<std::size_t>(e)]; }
  /// Every effect in its exact form.
  Forms exact() const;
  /// The same, but with the dearest compensation that renderers ship: what a shader for every material computes, which
  /// times are compared with.
  Forms everything() const;
  /// Every effect in the cheapest form that is the same.
  Forms structural() const;
  /// The effects that the material has, with the compensation of everything() in place of the reference's table.
  Forms shipped() const;
  /// Forms without what the others leave nothing of: the coupling of no diffuse, the spectrum of a form that has none.
  Forms plain(Forms) const;
  /// \param forms  each one that is offered
  Surface surface(const Forms& forms) const;
  /// True where the exact form is known with its error: a walk, or no facets.
  bool is_bounded() const;
  /// Turn of the tangent about the normal [rad].
  double turn() const { return turn_; }
  /// Widths of the lobes, the coat's too: what directions are drawn from.
  std::vector<double> widths() const;

 private:
  using Settings = std::vector<Setting>;
  void read(const BoundModel&, bool coated);
  void read_spectrum(const Material&);
  void read(const GltfMaterial&);
  void read_fresnel(std::string_view id, const BoundModel&, const TermUse&);
  void offer_forms();
  std::shared_ptr<const TabulatedLobe> tabulated() const;
  std::shared_ptr<const ImageLit> image_lit(const Surface&, const Forms&) const;

  std::array<Offer, effect_count> offers_;
  struct Diffuse {
    std::string kind = "none";
    bool coupled = false;
    std::vector<double> kd{0, 0, 0};
    double alpha = 1;
    Settings others{};   ///< further parameters of a term that no form stands for
    bool own = false;    ///< a function of a person's file, which may be a whole model
    double width = 1.0;  ///< of such a function's highlight, guessed from its alpha or roughness
  } diffuse_;
  /// First lobe.
  struct First {
    bool known = false;  ///< its distribution and masking are of those that forms are of
    bool any = false;
    LobeSpec lobe;  ///< as given
    double alpha_x = 1, alpha_y = 1, gamma = 2;
    Settings shape;  ///< of D and V as given
  } first_;
  struct Fresnel {
    std::string id;
    Settings parameters;
    bool has_schlick = false;  ///< the exact form is none that shaders have
    std::vector<double> f0, f82_tint;
    /// Of the exact form over the hemisphere, by channel and by band.
    std::vector<double> average{0, 0, 0}, band_average;
    std::optional<SpectralMetal<double>> spectrum;
    bool is_named = false;  ///< a metal
  } fresnel_;
  std::vector<LobeSpec> others_;  ///< further lobes
  Settings others_settings_;
  struct Coat {
    LobeSpec lobe;
    Settings parameters;
    double width = 0.1, mean_width = 0.1;  ///< the wider of both, and their geometric mean
    bool absent = false;
  } coat_;
  double turn_ = 0;
  LobeAlbedo albedo_;
  std::shared_ptr<const ImageLight> sky_;
};

/// Looks of a scene's materials, under its environment if it has one.
std::vector<Look> looks_of(const Scene&);

}  // namespace gonio::scene
