#include "fitting/export/map_export.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/file.h"
#include "base/json/describe.h"
#include "base/json/reader.h"
#include "base/quantile.h"
#include "base/text.h"
#include "brdf/model/evaluate.h"
#include "brdf/model/own_files.h"
#include "brdf/term/map.h"
#include "fitting/export/map_files.h"
#include "fitting/export/placement.h"
#include "fitting/export/target.h"
#include "geometry/half_difference.h"
#include "image/display.h"
#include "image/exr.h"
#include "image/png.h"
#include "stack/parameter_image.h"
#include "table/table.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace gonio {

template <>
inline constexpr auto description<FilledParameter> =
    FieldList{Field{"parameter", &FilledParameter::parameter, ""},
              Field{"texels", &FilledParameter::texels, "that do not know it"},
              Field{"value", &FilledParameter::value,
                    "of each channel, or one: the median of the texels that know it, or its "
                    "default if fewer than a tenth do"},
              Field{"is_default", &FilledParameter::is_default, "whether one of them is that"}};
static_assert(describes_every_member<FilledParameter>());
template <>
inline constexpr auto description<MapExport> = FieldList{
    constant_text("schema", "gonio.map_export/1"),
    Field{"target", &MapExport::target, ""},
    Field{"textures", &MapExport::textures, "files beside the first; glTF holds its own"},
    Field{"map", &MapExport::map, "path of the map"},
    Field{"model", &MapExport::model, "spec of the map's fits"},
    Field{"width", "texels", &MapExport::width, ""},
    Field{"height", "texels", &MapExport::height, ""},
    Field{"unknown", "texels", &MapExport::unknown, "without a value of each parameter"},
    Field{"filled", &MapExport::filled, "what these have in the place of the unknown ones"},
    Field{"metals", "texels", &MapExport::metals, "whose metallic is 1"},
    Field{"ior", &MapExport::ior,
          "refractive index of the highlight that one in 100 texels that are no metals exceeds"},
    Field{"median_residual", &MapExport::median_residual,
          "of the texels: root mean square of the relative distance from the map's f"},
    Field{"high_residual", &MapExport::high_residual, "the same, beyond which one texel in 20 is"},
    Field{"lost", &MapExport::lost, "what the target cannot express"}};
static_assert(describes_every_member<MapExport>());

std::string to_json(const MapExport& e) {
  return json_text(e);
}
std::string map_export_schema() {
  return schema_text<MapExport>("Export of a map");
}

namespace {

constexpr std::size_t rows_at_once = 16, judged = 32;
constexpr std::size_t most_texels = std::size_t{1} << 24;
constexpr double largest_ior = 10;

/// A texel's material.
struct Texel {
  std::array<double, 3> base{}, f0{};
  double roughness = 1;
  bool metal = false;
};

/// Numbers of a colour: of grey three times the same.
double of(const std::vector<double>& values, std::size_t c) {
  return values.empty() ? 0 : values[values.size() == 3 ? c : 0];
}

Texel texel_of(const BoundModel& model) {
  Texel t;
  const Surface s = surface_of(model);
  const SurfaceLobe* lobe = nullptr;
  for (const auto& placed : placements(s))
    if (placed.base && !lobe) {
      lobe = placed.base;
      t.metal = placed.metal;
    }
  if (lobe) t.roughness = one_roughness(*lobe);
  for (std::size_t c = 0; c < 3; ++c) {
    t.f0[c] = lobe ? lobe->weight * of(lobe->f0, c) : 0;
    t.base[c] = t.metal ? t.f0[c] : of(s.kd, c);
  }
  return t;
}

/// Eight bits of a number of [0, 1], and back.
unsigned char byte_of(double x) {
  return static_cast<unsigned char>(std::lround(255 * std::clamp(x, 0.0, 1.0)));
}
double from_srgb(unsigned char byte) {
  const double x = byte / 255.0;  // IEC 61966-2-1
  return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

double f0_of(double ior) {
  return mapped<F0FromIor, double>(ior, 1.0)[0];
}
/// Bytes of a texel in the textures.
struct TexelBytes {
  std::array<unsigned char, 3> base{}, rough{}, tint{};
};
TexelBytes bytes_of(const Texel& t, double strongest, ExportTarget target) {
  TexelBytes b;
  b.rough = {0, byte_of(t.roughness), static_cast<unsigned char>(t.metal ? 255 : 0)};
  for (std::size_t c = 0; c < 3; ++c)
    if (target == ExportTarget::usd_preview) {
      b.base[c] = srgb_byte(t.metal ? 0 : t.base[c]);
      b.tint[c] = srgb_byte(t.f0[c]);
    } else {
      b.base[c] = srgb_byte(t.base[c]);
      b.tint[c] = srgb_byte(t.metal || strongest <= 0 ? 1 : t.f0[c] / strongest);
    }
  return b;
}
/// Parameters of a target by its own names.
TargetParameters parameters_of(const TexelBytes& b, double ior, ExportTarget target) {
  std::vector<double> base, tint;
  for (std::size_t c = 0; c < 3; ++c) {
    base.push_back(from_srgb(b.base[c]));
    tint.push_back(from_srgb(b.tint[c]));
  }
  const double roughness = b.rough[1] / 255.0, metal = b.rough[2] / 255.0;
  if (target == ExportTarget::usd_preview)
    return {{"diffuseColor", base}, {"specularColor", tint}, {"roughness", {roughness}}};
  if (target == ExportTarget::open_pbr)
    return {{"base_color", base},     {"base_metalness", {metal}},
            {"specular_weight", {1}}, {"specular_color", tint},
            {"specular_ior", {ior}},  {"specular_roughness", {roughness}}};
  return {{"base_color", base}, {"metallic", {metal}}, {"roughness", {roughness}},
          {"ior", {ior}},       {"specular", {1}},     {"specular_color", tint}};
}

std::vector<FrameAngles<double>> judged_angles() {
  std::vector<FrameAngles<double>> all;
  const double least = std::cos(80 * degree);
  for (const auto& d : judged_directions())
    if (std::min(d.wi.z, d.wo.z) >= least && all.size() < judged) all.push_back(frame_angles(d));
  return all;
}

/// Root mean square of the relative distance between the target's f and the map's, which may be grey.
double residual_of(const std::vector<std::vector<double>>& target,
                   const std::vector<std::vector<double>>& fit,
                   const Surface& surface) {
  const auto scale = scale_of(fit, surface);
  double sum = 0;
  for (std::size_t c = 0; c < target.size(); ++c) {
    const std::size_t of_fit = fit.size() == target.size() ? c : 0;
    for (std::size_t i = 0; i < target[c].size(); ++i) {
      const double d = (target[c][i] - fit[of_fit][i]) / scale[of_fit][i];
      sum += d * d;
    }
  }
  return std::sqrt(sum / static_cast<double>(target.size() * target[0].size()));
}

/// Does something for the texels of a map, on all threads: each(texel's number, model of the texel), from any thread.
template <class Each>
void for_each_texel(const BoundModel& start, const std::string& path, Each&& each) {
  ParameterImage parameters(start, path);
  const std::size_t width = parameters.file()->width(), height = parameters.file()->height();
  std::vector<std::vector<float>> planes;
  for (std::size_t y = 0; y < height; y += rows_at_once) {
    const Rectangle part{0, y, width, std::min(rows_at_once, height - y)};
    parameters.read(part, planes);
    tbb::parallel_for(std::size_t{0}, part.height, [&](std::size_t row) {
      BoundModel here = start;
      for (std::size_t t = row * width; t < (row + 1) * width; ++t) {
        for (std::size_t v = 0; v < planes.size(); ++v)
          here.values[v] = static_cast<double>(planes[v][t]);
        each(y * width + t, here);
      }
    });
  }
}

/// Values of texels spread over a map, [slot][texel]; NaN of what one does not know.
std::vector<std::vector<double>> sample_of(const BoundModel& start,
                                           const std::string& map,
                                           std::size_t texels) {
  constexpr std::size_t most = 1 << 16;
  const std::size_t step = (texels + most - 1) / most;
  std::vector<std::vector<double>> seen(start.values.size(),
                                        std::vector<double>((texels + step - 1) / step));
  for_each_texel(start, map, [&](std::size_t t, const BoundModel& model) {
    if (t % step != 0) return;
    for (std::size_t v = 0; v < seen.size(); ++v) seen[v][t / step] = model.values[v];
  });
  return seen;
}

/// F0 that one in 100 texels that are no metals exceeds, of those that know all.
double strongest_highlight(const BoundModel& start, const std::vector<std::vector<double>>& seen) {
  std::vector<double> f0;
  BoundModel here = start;
  for (std::size_t t = 0; !seen.empty() && t < seen[0].size(); ++t) {
    for (std::size_t v = 0; v < seen.size(); ++v) here.values[v] = seen[v][t];
    if (std::ranges::any_of(here.values, [](double v) { return std::isnan(v); })) continue;
    const Texel texel = texel_of(here);
    if (!texel.metal) f0.push_back(*std::ranges::max_element(texel.f0));
  }
  return f0.empty() ? f0_of(1.5) : std::min(quantile(f0, 0.99), f0_of(largest_ior));
}

/// Values of a map where a texel does not know its own, and for how many they stand.
class MapMedians {
 public:
  MapMedians(const BoundModel& start, std::vector<std::vector<double>> seen)
      : start_(start), values_(start.values), is_default_(seen.size(), true) {
    for (std::size_t v = 0; v < seen.size(); ++v) {
      constexpr std::size_t few = 10;  // in a hundred, who may know it by chance
      const std::size_t all = seen[v].size();
      std::erase_if(seen[v], [](double x) { return std::isnan(x); });
      if (100 * seen[v].size() < few * all) continue;
      values_[v] = median(seen[v]);
      is_default_[v] = false;
    }
    missing_ = std::vector<std::atomic<std::size_t>>(start.model.parameters.size());
  }

  /// Fills a texel's model in.
  /// \return  whether it knew all itself
  bool fill(BoundModel& texel) {
    bool knew_all = true;
    for (std::size_t k = 0; k < missing_.size(); ++k) {
      const auto& q = start_.model.parameters[k];
      bool knew = true;
      for (std::size_t v = q.first; v < q.first + q.count; ++v)
        if (std::isnan(texel.values[v])) knew = false, texel.values[v] = values_[v];
      if (!knew) ++missing_[k];
      knew_all = knew_all && knew;
    }
    return knew_all;
  }
  std::vector<FilledParameter> filled() const {
    std::vector<FilledParameter> all;
    for (std::size_t k = 0; k < missing_.size(); ++k) {
      if (missing_[k] == 0) continue;
      const auto& q = start_.model.parameters[k];
      auto& of = all.emplace_back(FilledParameter{q.name, missing_[k], {}});
      for (std::size_t v = q.first; v < q.first + q.count; ++v) {
        of.value.push_back(values_[v]);
        of.is_default = of.is_default || is_default_[v];
      }
    }
    return all;
  }

 private:
  const BoundModel& start_;
  std::vector<double> values_;
  std::vector<bool> is_default_;                   ///< [slot]
  std::vector<std::atomic<std::size_t>> missing_;  ///< [parameter]
};

/// Normals of a map as a texture; no pixels where it has none.
PngImage normals_of(const std::string& path) {
  PngImage png;
  png.is_srgb = false;
  const auto file = open_image(path);
  std::vector<std::size_t> channels;
  for (const char* axis : {"normal.X", "normal.Y", "normal.Z"}) {
    const auto at = std::ranges::find(file->channels(), axis);
    if (at == file->channels().end()) return png;
    channels.push_back(static_cast<std::size_t>(at - file->channels().begin()));
  }
  png.width = file->width();
  png.height = file->height();
  std::array<std::vector<float>, 3> rows;
  std::array<float*, 3> into{};
  for (std::size_t y = 0; y < png.height; y += rows_at_once) {
    const Rectangle part{0, y, png.width, std::min(rows_at_once, png.height - y)};
    for (std::size_t k = 0; k < 3; ++k) {
      rows[k].resize(part.size());
      into[k] = rows[k].data();
    }
    file->read(part, channels, into);
    for (std::size_t t = 0; t < part.size(); ++t) {
      const bool known = !std::isnan(rows[0][t] + rows[1][t] + rows[2][t]);
      auto& pixel = png.pixels.emplace_back();
      for (std::size_t k = 0; k < 3; ++k)
        pixel[k] = byte_of(known ? (double{rows[k][t]} + 1) / 2 : k == 2 ? 1 : 0.5);
    }
  }
  return png;
}

}  // namespace

bool is_map(const std::string& path) {
  if (!InputFile(path).peek(4).starts_with("\x76\x2f\x31\x01")) return false;
  const auto header = read_exr_header(path);
  const auto schema = header.attributes.find("gonio:schema");
  return schema != header.attributes.end() && schema->second == "gonio.map/1";
}

bool takes_maps(ExportTarget target) {
  return target == ExportTarget::gltf || target == ExportTarget::open_pbr ||
         target == ExportTarget::usd_preview;
}

MapExport export_map(const std::string& path,
                     ExportTarget target,
                     const std::string& output,
                     std::vector<std::string>& files) {
  if (!is_map(path)) throw bad_input(path, "header", "no gonio:schema", "a map of gonio fit_map");
  const Image header = read_exr_header(path);
  if (header.width * header.height > most_texels)
    throw bad_input(path, "size", fmt::format("{} × {}", header.width, header.height),
                    fmt::format("at most {} texels: viewers take no larger textures, and all of "
                                "them are in memory",
                                most_texels));
  MapExport e;
  e.target = target;
  e.map = path;
  const auto attribute = [&](const char* name) {
    return attribute_of(header, name, path, "a map of gonio fit_map");
  };
  e.model = attribute("gonio:model");
  const std::string stack = attribute("gonio:stack");
  const std::string model = model_of_file(path, e.model);
  for (const auto& f : own_files({model}))
    if (attribute("gonio:shaders").find(f.sha256) == std::string::npos)
      throw bad_input(path, "gonio:shaders", "another text of " + f.file,
                      "the one that the map was fitted with");
  e.width = header.width;
  e.height = header.height;
  const std::size_t texels = e.width * e.height;
  const auto channels = split(attribute("gonio:channels"), ',').size();
  if (channels > most_channels || texels * channels > 3 * most_texels)
    throw bad_input(
        path, "gonio:channels", fmt::format("{} channels", channels),
        fmt::format("at most {}, and {} values of all texels", most_channels, 3 * most_texels));
  const BoundModel start = bind_model(model, {}, channels);

  auto seen = sample_of(start, path, texels);
  const double strongest = strongest_highlight(start, seen);
  e.ior = mapped<IorFromF0, double>(strongest)[0];

  MapTextures textures;
  for (auto* png : {&textures.base, &textures.rough, &textures.tint}) {
    png->width = e.width;
    png->height = e.height;
    png->pixels.resize(texels);
  }
  textures.rough.is_srgb = false;
  const auto at = judged_angles();
  Surface with_a_lobe;
  with_a_lobe.channels = 3;
  with_a_lobe.kd.assign(3, 0.5);
  with_a_lobe.lobes.push_back(
      {0.3, 0.3, 1, {0.04, 0.04, 0.04}, {1, 1, 1}, {1.5, 1.5, 1.5}, {0, 0, 0}});
  const Target& of = target == ExportTarget::usd_preview ? usd_preview_target
                     : target == ExportTarget::open_pbr  ? open_pbr_target
                                                         : gltf_target;
  const auto forms = of.forms(with_a_lobe);
  const TargetForm& form = target == ExportTarget::gltf ? forms.back() : forms.front();
  std::vector<float> residuals(texels, std::numeric_limits<float>::quiet_NaN());
  std::vector<unsigned char> metal(texels);
  MapMedians medians(start, std::move(seen));
  for_each_texel(start, path, [&](std::size_t t, BoundModel& fit) {
    const bool knew = medians.fill(fit);
    const Texel texel = texel_of(fit);
    const TexelBytes bytes = bytes_of(texel, strongest, target);
    textures.base.pixels[t] = bytes.base;
    textures.rough.pixels[t] = bytes.rough;
    textures.tint.pixels[t] = bytes.tint;
    metal[t] = texel.metal;
    if (knew)
      residuals[t] =
          static_cast<float>(residual_of(form.values(parameters_of(bytes, e.ior, target), at),
                                         evaluate(fit, at), surface_of(fit)));
  });
  e.metals = static_cast<std::size_t>(std::ranges::count(metal, 1));
  std::erase_if(residuals, [](float r) { return std::isnan(r); });
  e.unknown = texels - residuals.size();
  e.filled = medians.filled();
  std::ranges::sort(residuals);
  if (!residuals.empty()) {
    e.median_residual = double{residuals[residuals.size() / 2]};
    e.high_residual = double{residuals[residuals.size() - 1 - residuals.size() / 20]};
  }
  e.lost = of.lost(start, surface_of(start), form.parameters);

  textures.normals = normals_of(path);
  if (target == ExportTarget::gltf) {
    files = {gltf_file_of(e, textures, stack)};
    return e;
  }
  files.resize(1);
  for (const auto& [name, image] : {std::pair{"color", &textures.base},
                                    {"roughness_metal", &textures.rough},
                                    {"highlight", &textures.tint},
                                    {"normal", &textures.normals}}) {
    if (image->pixels.empty()) continue;
    e.textures.push_back(fmt::format("{}_{}_{}.png", std::filesystem::path(output).stem().string(),
                                     name_of(target), name));
    files.push_back(png_bytes(*image));
  }
  files[0] = target == ExportTarget::usd_preview ? usd_preview_file_of(e, stack)
                                                 : open_pbr_file_of(e, stack);
  return e;
}

}  // namespace gonio
