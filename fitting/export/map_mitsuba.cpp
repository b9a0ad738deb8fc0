// A map for Mitsuba 3: the material of a fit (mitsuba.cpp), its numbers in textures of floats.
//
// Textures that are marked raw are the numbers that they hold, beyond 1, too: alpha, eta, k and a
// lobe's weight.  RGB variants take three channels of eta and k, so that each texel has the index
// of its own F0; spectral variants take one channel of raw numbers, and refuse three.  The shares
// of the blend are the same for all texels: between texels a filter then leaves the mean of kd.
//
// v grows upwards on Mitsuba's rectangle and downwards in its images.  The rectangle is turned
// over, and keeps its normal.
#include <algorithm>
#include <cmath>
#include <limits>

#include "brdf/model/evaluate.h"
#include "fitting/export/map_files.h"
#include "fitting/export/map_target.h"
#include "fitting/export/mitsuba_parts.h"
#include "fitting/export/target.h"
#include "fitting/export/xml.h"
#include "image/exr.h"

#include <fmt/format.h>

namespace gonio {
namespace {

/// Parameter of Mitsuba's material in every texel.
struct TexturedParameter {
  std::string name;  ///< Mitsuba's
  std::size_t lobe = 0;
  const ModelParameter* in_model;
  std::vector<std::vector<float>> planes;  ///< [channel][texel]

  bool is_grey() const {
    return std::ranges::all_of(planes, [&](const auto& p) { return p == planes[0]; });
  }
  bool is_constant() const {
    return is_grey() && std::ranges::all_of(planes[0], [&](float x) { return x == planes[0][0]; });
  }
};

std::string texture_element(const std::string& name, const std::string& file, bool is_raw) {
  return fmt::format(
      "<texture type=\"bitmap\" name=\"{}\">\n<string name=\"filename\" value=\"{}\"/>\n<string "
      "name=\"wrap_mode\" value=\"clamp\"/>\n<boolean name=\"raw\" value=\"{}\"/>\n</texture>\n",
      name, file, is_raw);
}

class MitsubaMap : public MapTarget {
 public:
  MitsubaMap(const MapExport& e, const MapSummary& summary)
      : anisotropic_(summary.anisotropic),
        share_(anisotropic_.empty() ? 1 : mitsuba_diffuse_share(summary.strong_kd)),
        model_(bind_model(mitsuba_model(true, anisotropic_), {}, 3)) {
    if (const auto* tangent = model_.model.tangent()) model_.values[tangent->slot(0)] = 0;
    const auto add = [&](const std::string& name, std::size_t lobe, std::size_t channels) {
      parameters_.push_back({name, lobe,
                             model_.model.find(mitsuba_in_catalogue(to_text({name, lobe}))),
                             std::vector(channels, std::vector<float>(e.width * e.height))});
    };
    add("reflectance", 0, 3);
    for (std::size_t l = 0; l < anisotropic_.size(); ++l) {
      if (anisotropic_[l]) {
        add("alpha_u", l, 1);
        add("alpha_v", l, 1);
      } else {
        add("alpha", l, 1);
      }
      add("eta", l, 3);
      add("k", l, 3);
      add("specular_reflectance", l, 1);
    }
  }

  void keep(std::size_t t, const Surface& s) override {
    auto next = parameters_.begin();
    const auto put = [&](const std::vector<double>& values, Range legal) {
      for (std::size_t c = 0; c < next->planes.size(); ++c)
        next->planes[c][t] =
            static_cast<float>(std::clamp(channel_of(values, c), legal.low, legal.high));
      ++next;
    };
    constexpr Range any{0, std::numeric_limits<float>::max()};
    put(s.kd, any);
    const double x = std::cos(s.tangent_deg * degree), y = std::sin(s.tangent_deg * degree);
    const SurfaceLobe none{1, 1, 0, {0}, {1}, {1}, {0}};
    for (std::size_t l = 0; l < anisotropic_.size(); ++l) {
      const SurfaceLobe& lobe = l < s.lobes.size() ? s.lobes[l] : none;
      if (anisotropic_[l]) {  // widths of the slopes along the texture's axes
        put({std::hypot(x * lobe.alpha_x, y * lobe.alpha_y)}, mitsuba_widths);
        put({std::hypot(y * lobe.alpha_x, x * lobe.alpha_y)}, mitsuba_widths);
      } else {
        put({std::sqrt(lobe.alpha_x * lobe.alpha_y)}, mitsuba_widths);
      }
      put(lobe.eta, mitsuba_indices);
      put(lobe.k, mitsuba_extinctions);
      put({lobe.weight}, any);
    }
  }

  std::vector<std::vector<double>> values(std::size_t t,
                                          std::span<const FrameAngles<double>> at) const override {
    BoundModel here = model_;
    for (const auto& p : parameters_)
      for (std::size_t c = 0; c < p.planes.size(); ++c)
        here.values[p.in_model->slot(c)] = double{p.planes[c][t]};
    return evaluate(here, at);
  }

  std::vector<std::string> lost(const BoundModel& start) const override {
    auto all = mitsuba_target.lost(start, surface_of(start), {});
    if (start.model.anisotropic)
      all.emplace_back(
          "Tangents between the axes: the textures have the widths along x and along y.");
    if (std::ranges::any_of(parameters_, [](const auto& p) { return is_index(p) && !p.is_grey(); }))
      all.emplace_back(
          "Spectral variants: they refuse textures of eta and k that have three channels. "
          "fit_map --grey f0 leaves one.");
    std::size_t above = 0;
    for (std::size_t t = 0; t < parameters_[0].planes[0].size(); ++t)
      above += std::ranges::any_of(parameters_[0].planes,
                                   [&](const auto& p) { return double{p[t]} > share_; });
    if (above > 0)
      all.push_back(
          fmt::format("kd above {:.3g} of {} texels: spectral variants end there.", share_, above));
    return all;
  }

  std::vector<std::string> files(MapExport& e,
                                 const std::vector<std::vector<float>>& normals,
                                 const std::string& stack,
                                 const std::string& output) override {
    std::vector<std::string> all(1);
    const auto texture = [&](const std::string& what, std::vector<std::vector<float>> planes) {
      e.textures.push_back(texture_name(output, what, "exr"));
      const std::vector<std::string> channels = planes.size() == 1
                                                    ? std::vector<std::string>{"Y"}
                                                    : std::vector<std::string>{"R", "G", "B"};
      all.push_back(
          exr_bytes(e.textures.back(), {e.width, e.height, channels, std::move(planes), {}}));
      return e.textures.back();
    };
    const auto element = [&](TexturedParameter& p, double scale) {
      for (auto& plane : p.planes)
        for (float& x : plane) x = static_cast<float>(double{x} / scale);
      const bool is_width = p.name.starts_with("alpha");
      if (p.is_constant())
        return fmt::format("<{} name=\"{}\" value=\"{}\"/>\n", is_width ? "float" : "spectrum",
                           p.name, xml_numbers({double{p.planes[0][0]}}));
      if (p.is_grey()) p.planes.resize(1);
      return texture_element(p.name, texture(to_text({p.name, p.lobe}), std::move(p.planes)),
                             p.name != "reflectance");
    };
    const bool diffuse =
        anisotropic_.empty() || !parameters_[0].is_constant() || parameters_[0].planes[0][0] > 0;
    std::vector<std::pair<double, std::string>> parts;
    if (diffuse)
      parts.emplace_back(
          share_, "<bsdf type=\"diffuse\">\n" + element(parameters_[0], share_) + "</bsdf>\n");
    const double share = (diffuse ? 1 - share_ : 1) /
                         static_cast<double>(std::max<std::size_t>(anisotropic_.size(), 1));
    for (std::size_t l = 0; l < anisotropic_.size(); ++l) {
      std::string one =
          "<bsdf type=\"roughconductor\">\n<string name=\"distribution\" value=\"ggx\"/>\n";
      for (auto& p : parameters_)
        if (p.lobe == l && p.name != "reflectance")
          one += element(p, p.name == "specular_reflectance" ? share : 1);
      parts.emplace_back(share, std::move(one) + "</bsdf>\n");
    }
    std::string bsdf = mitsuba_blend(std::move(parts));
    if (!normals.empty())
      bsdf = "<bsdf type=\"normalmap\">\n" +
             texture_element("normalmap", texture("normal", normals), true) + bsdf + "</bsdf>\n";
    bsdf.insert(5, " id=\"map\"");
    const auto [across, up] = half_sides(e.width, e.height);
    all[0] =
        xml_file(fmt::format("<scene version=\"3.0.0\">\n{}<shape type=\"rectangle\">\n<transform "
                             "name=\"to_world\">\n<scale x=\"{}\" y=\"{}\"/>\n</transform>\n<ref "
                             "id=\"map\"/>\n</shape>\n</scene>\n",
                             bsdf, across, -up),
                 "what the textures were made of", document_of(e, stack));
    return all;
  }

 private:
  static bool is_index(const TexturedParameter& p) { return p.name == "eta" || p.name == "k"; }

  std::vector<bool> anisotropic_;  ///< [lobe]
  double share_;                   ///< of the diffuse part, where there is one
  BoundModel model_;
  std::vector<TexturedParameter> parameters_;
};

}  // namespace

std::unique_ptr<MapTarget> mitsuba_map(const MapExport& e, const MapSummary& summary) {
  return std::make_unique<MitsubaMap>(e, summary);
}

}  // namespace gonio
