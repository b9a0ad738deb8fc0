// Textures of eight bits, for targets with one highlight above a colour: a base, roughness and
// metal, the highlight's colour.
#include "fitting/export/map_target.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "brdf/term/map.h"
#include "fitting/export/map_files.h"
#include "fitting/export/placement.h"
#include "fitting/export/target.h"
#include "image/display.h"
#include "image/png.h"
#include "optics/f0.h"

#include <fmt/format.h>

namespace gonio {

double MapSummary::f0() const {
  constexpr double largest_ior = 10;
  return std::min(strong_f0, mapped<F0FromIor, double>(largest_ior, 1.0)[0]);
}
double MapSummary::ior() const {
  return mapped<IorFromF0, double>(f0())[0];
}

ShownLobe shown_lobe(const Surface& s) {
  for (const auto& placed : placements(s))
    if (placed.base) return {placed.base, placed.metal};
  return {};
}
double channel_of(const std::vector<double>& values, std::size_t c) {
  return values.empty() ? 0 : values[values.size() == 3 ? c : 0];
}
std::string texture_name(const std::string& output,
                         const std::string& what,
                         const std::string& ending) {
  return fmt::format("{}_{}.{}", std::filesystem::path(output).filename().string(), what, ending);
}

namespace {

/// Eight bits of a number of [0, 1], and back.
unsigned char byte_of(double x) {
  return static_cast<unsigned char>(std::lround(255 * std::clamp(x, 0.0, 1.0)));
}
double from_srgb(unsigned char byte) {
  const double x = byte / 255.0;  // IEC 61966-2-1
  return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

class EightBitTextures : public MapTarget {
 public:
  EightBitTextures(ExportTarget target, const MapExport& e, const MapSummary& summary)
      : target_(target),
        ior_(summary.ior()),
        strongest_(summary.f0()),
        of_(target == ExportTarget::usd_preview ? usd_preview_target
            : target == ExportTarget::open_pbr  ? open_pbr_target
                                                : gltf_target) {
    for (auto* png : {&textures_.base, &textures_.rough, &textures_.tint}) {
      png->width = e.width;
      png->height = e.height;
      png->pixels.resize(e.width * e.height);
    }
    textures_.rough.is_srgb = textures_.normals.is_srgb = false;
    Surface with_a_lobe;
    with_a_lobe.channels = 3;
    with_a_lobe.kd.assign(3, 0.5);
    with_a_lobe.lobes.push_back(
        {0.3, 0.3, 1, {0.04, 0.04, 0.04}, {1, 1, 1}, {1.5, 1.5, 1.5}, {0, 0, 0}});
    auto forms = of_.forms(with_a_lobe);
    form_ = std::move(target == ExportTarget::gltf ? forms.back() : forms.front());
  }

  void keep(std::size_t t, const Surface& s) override {
    const auto [lobe, metal] = shown_lobe(s);
    textures_.rough.pixels[t] = {0, byte_of(lobe ? one_roughness(*lobe) : 1),
                                 static_cast<unsigned char>(metal ? 255 : 0)};
    for (std::size_t c = 0; c < 3; ++c) {
      const double f0 = lobe ? lobe->weight * channel_of(lobe->f0, c) : 0;
      const double kd = channel_of(s.kd, c);
      unsigned char &base = textures_.base.pixels[t][c], &tint = textures_.tint.pixels[t][c];
      if (target_ == ExportTarget::usd_preview) {
        base = srgb_byte(metal ? 0 : kd);
        tint = srgb_byte(f0);
      } else {
        base = srgb_byte(metal ? f0 : kd);
        tint = srgb_byte(metal || strongest_ <= 0 ? 1 : f0 / strongest_);
      }
    }
  }

  std::vector<std::vector<double>> values(std::size_t t,
                                          std::span<const FrameAngles<double>> at) const override {
    std::vector<double> base, tint;
    for (std::size_t c = 0; c < 3; ++c) {
      base.push_back(from_srgb(textures_.base.pixels[t][c]));
      tint.push_back(from_srgb(textures_.tint.pixels[t][c]));
    }
    const auto& rough = textures_.rough.pixels[t];
    return form_.values(parameters(base, tint, rough[1] / 255.0, rough[2] / 255.0), at);
  }

  std::vector<std::string> lost(const BoundModel& start) const override {
    return of_.lost(start, surface_of(start), form_.parameters);
  }

  std::vector<std::string> files(MapExport& e,
                                 const std::vector<std::vector<float>>& normals,
                                 const std::string& stack,
                                 const std::string& output) override {
    if (!normals.empty()) {
      textures_.normals.width = e.width;
      textures_.normals.height = e.height;
      textures_.normals.pixels.resize(e.width * e.height);
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t t = 0; t < normals[k].size(); ++t)
          textures_.normals.pixels[t][k] = byte_of(double{normals[k][t]});
    }
    if (target_ == ExportTarget::gltf) return {gltf_file_of(e, textures_, stack)};
    std::vector<std::string> all(1);
    for (const auto& [name, image] : {std::pair{"color", &textures_.base},
                                      {"roughness_metal", &textures_.rough},
                                      {"highlight", &textures_.tint},
                                      {"normal", &textures_.normals}}) {
      if (image->pixels.empty()) continue;
      e.textures.push_back(texture_name(output, name, "png"));
      all.push_back(png_bytes(*image));
    }
    all[0] = target_ == ExportTarget::usd_preview ? usd_preview_file_of(e, stack)
                                                  : open_pbr_file_of(e, stack);
    return all;
  }

 private:
  /// Parameters of a target by its own names.
  TargetParameters parameters(const std::vector<double>& base,
                              const std::vector<double>& tint,
                              double roughness,
                              double metal) const {
    if (target_ == ExportTarget::usd_preview)
      return {{"diffuseColor", base}, {"specularColor", tint}, {"roughness", {roughness}}};
    if (target_ == ExportTarget::open_pbr)
      return {{"base_color", base},     {"base_metalness", {metal}},
              {"specular_weight", {1}}, {"specular_color", tint},
              {"specular_ior", {ior_}}, {"specular_roughness", {roughness}}};
    return {{"base_color", base}, {"metallic", {metal}}, {"roughness", {roughness}},
            {"ior", {ior_}},      {"specular", {1}},     {"specular_color", tint}};
  }

  ExportTarget target_;
  double ior_, strongest_;
  const Target& of_;
  TargetForm form_;
  MapTextures textures_;
};

}  // namespace

std::unique_ptr<MapTarget> map_target(ExportTarget target,
                                      const MapExport& e,
                                      const MapSummary& summary) {
  if (target == ExportTarget::mitsuba) return mitsuba_map(e, summary);
  return std::make_unique<EightBitTextures>(target, e, summary);
}

}  // namespace gonio
