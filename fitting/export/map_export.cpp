#include "fitting/export/map_export.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
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
#include "fitting/export/map_target.h"
#include "fitting/export/target.h"
#include "geometry/half_difference.h"
#include "image/exr.h"
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

/// Summary that a target needs before its texels are kept: of the texels that know every parameter.
MapSummary summary_of(const BoundModel& start, const std::vector<std::vector<double>>& seen) {
  constexpr double strong = 0.99;  // a texel whose fit went astray sets nothing for all others
  std::vector<double> f0, kd;
  MapSummary summary;
  BoundModel here = start;
  for (std::size_t t = 0; !seen.empty() && t < seen[0].size(); ++t) {
    for (std::size_t v = 0; v < seen.size(); ++v) here.values[v] = seen[v][t];
    if (std::ranges::any_of(here.values, [](double v) { return std::isnan(v); })) continue;
    const Surface s = surface_of(here);
    kd.push_back(s.largest_kd());
    if (s.lobes.size() > summary.anisotropic.size()) summary.anisotropic.resize(s.lobes.size());
    for (std::size_t l = 0; l < s.lobes.size(); ++l)
      if (s.lobes[l].alpha_x != s.lobes[l].alpha_y) summary.anisotropic[l] = true;
    const auto shown = shown_lobe(s);
    if (!shown.metal) f0.push_back(shown.lobe ? shown.lobe->weight * shown.lobe->largest_f0() : 0);
  }
  if (kd.empty()) summary.anisotropic.resize(surface_of(start).lobes.size());
  if (!f0.empty()) summary.strong_f0 = quantile(f0, strong);
  if (!kd.empty()) summary.strong_kd = quantile(kd, strong);
  return summary;
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

/// Normals of a map as textures have them, [axis][texel], each part of them in [0, 1]; empty where it has none.
std::vector<std::vector<float>> normals_of(const std::string& path) {
  const auto file = open_image(path);
  std::vector<std::size_t> channels;
  for (const char* axis : {"normal.X", "normal.Y", "normal.Z"}) {
    const auto at = std::ranges::find(file->channels(), axis);
    if (at == file->channels().end()) return {};
    channels.push_back(static_cast<std::size_t>(at - file->channels().begin()));
  }
  const std::size_t width = file->width();
  std::vector normals(3, std::vector<float>(width * file->height()));
  for (std::size_t y = 0; y < file->height(); y += rows_at_once) {
    const Rectangle part{0, y, width, std::min(rows_at_once, file->height() - y)};
    std::array<float*, 3> into{};
    for (std::size_t k = 0; k < 3; ++k) into[k] = normals[k].data() + y * width;
    file->read(part, channels, into);
    for (std::size_t t = y * width; t < y * width + part.size(); ++t) {
      const bool known = !std::isnan(normals[0][t] + normals[1][t] + normals[2][t]);
      for (std::size_t k = 0; k < 3; ++k)
        normals[k][t] = known ? (normals[k][t] + 1) / 2 : k == 2 ? 1.0F : 0.5F;
    }
  }
  return normals;
}

}  // namespace

bool is_map(const std::string& path) {
  if (!InputFile(path).peek(4).starts_with("\x76\x2f\x31\x01")) return false;
  const auto header = read_exr_header(path);
  const auto schema = header.attributes.find("gonio:schema");
  return schema != header.attributes.end() && schema->second == "gonio.map/1";
}

bool takes_maps(ExportTarget target) {
  return target != ExportTarget::standard_surface;
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
  const MapSummary summary = summary_of(start, seen);
  e.ior = summary.ior();
  const auto target_map = map_target(target, e, summary);
  const auto at = judged_angles();
  std::vector<float> residuals(texels, std::numeric_limits<float>::quiet_NaN());
  std::vector<unsigned char> metal(texels);
  MapMedians medians(start, std::move(seen));
  for_each_texel(start, path, [&](std::size_t t, BoundModel& fit) {
    const bool knew = medians.fill(fit);
    const Surface surface = surface_of(fit);
    target_map->keep(t, surface);
    metal[t] = shown_lobe(surface).metal;
    if (knew)
      residuals[t] =
          static_cast<float>(residual_of(target_map->values(t, at), evaluate(fit, at), surface));
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
  e.lost = target_map->lost(start);
  files = target_map->files(e, normals_of(path), stack, output);
  return e;
}

}  // namespace gonio
