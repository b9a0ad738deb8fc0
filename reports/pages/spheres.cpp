#include "reports/pages/spheres.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "base/base64.h"
#include "base/quantile.h"
#include "brdf/model/evaluate.h"
#include "image/display.h"
#include "image/lit_sphere.h"
#include "image/png.h"
#include "reports/pages/drawn_channels.h"
#include "reports/picture/figure.h"
#include "table/lookup.h"

#include <tbb/parallel_for.h>

namespace gonio {
namespace {

/// Which channels are shown: of many a few show the grey as well, in a fraction of the time.
std::vector<std::size_t> shown_channels(const Table& t) {
  return drawn_channels(t.channels.size(), 4);
}

class Comparison {
 public:
  Comparison(const Table& t, std::span<const BoundModel> models, std::size_t pixels)
      : table_(t), models_(models), pixels_(pixels), channels_(shown_channels(t)) {
    if (!t.between) lookup_.emplace(t, Spheres::reach_deg * degree);
    for (const std::size_t c : channels_) names_.push_back(t.channels[c]);
  }
  const std::vector<std::string>& channels() const { return names_; }
  SpheresUnderLight under(const SphereLight&) const;

 private:
  /// Colours from what a channel has at a point.
  template <class F>
  std::vector<Rgb> colours(std::size_t points, const F& value) const {
    std::vector<Rgb> all(points);
    tbb::parallel_for(std::size_t{0}, points, [&](std::size_t i) {
      std::array<double, 4> f;
      for (std::size_t k = 0; k < channels_.size(); ++k) f[k] = value(i, channels_[k]);
      all[i] = colour_of_channels(names_, std::span(f).first(channels_.size()));
    });
    return all;
  }
  std::vector<GridCell> cells(const LitSphere&) const;
  std::vector<Rgb> of_table(const LitSphere&, const std::vector<GridCell>&) const;
  std::vector<Rgb> of_model(const LitSphere&, const BoundModel&) const;
  /// By the model's values at the samples that speak for the table.
  std::vector<Rgb> through_samples(const std::vector<GridCell>&, const BoundModel&) const;

  const Table& table_;
  std::span<const BoundModel> models_;
  std::size_t pixels_;
  std::vector<std::size_t> channels_;
  std::vector<std::string> names_;
  std::optional<Lookup> lookup_;
};

std::vector<GridCell> Comparison::cells(const LitSphere& sphere) const {
  std::vector<GridCell> all(lookup_ ? sphere.points.size() : 0);
  tbb::parallel_for(std::size_t{0}, all.size(),
                    [&](std::size_t i) { all[i] = (*lookup_)(sphere.points[i].at); });
  return all;
}

std::vector<Rgb> Comparison::of_table(const LitSphere& sphere,
                                      const std::vector<GridCell>& cells) const {
  return colours(sphere.points.size(), [&](std::size_t i, std::size_t c) {
    if (lookup_) return cells[i].mean_of(table_.values[c]);
    const double f = table_.between(sphere.points[i].at, c);
    return f >= 0 ? f : no_value;
  });
}

std::vector<Rgb> Comparison::of_model(const LitSphere& sphere, const BoundModel& model) const {
  std::vector<FrameAngles<double>> x;
  for (const auto& p : sphere.points) x.push_back(frame_angles(p.at));
  const auto f = evaluate(model, x);
  return colours(x.size(), [&](std::size_t i, std::size_t c) { return f[c][i]; });
}

std::vector<Rgb> Comparison::through_samples(const std::vector<GridCell>& cells,
                                             const BoundModel& model) const {
  std::vector<std::size_t> used;
  for (const auto& cell : cells)
    used.insert(used.end(), cell.sample.begin(),
                cell.sample.begin() + static_cast<std::ptrdiff_t>(cell.count));
  std::ranges::sort(used);
  used.erase(std::ranges::unique(used).begin(), used.end());
  const SampleAngles at(table_);
  std::vector<FrameAngles<double>> x;
  for (const std::size_t i : used) x.push_back(at.frame(i));
  const auto f = evaluate(model, x);
  std::vector<Values> values;
  for (const auto& channel : f) {
    auto& v = values.emplace_back(table_.size());
    for (std::size_t k = 0; k < used.size(); ++k) v[used[k]] = channel[k];
  }
  return colours(cells.size(),
                 [&](std::size_t i, std::size_t c) { return cells[i].mean_of(values[c]); });
}

/// Pixels that both light and the table's values reach, the number of those that light reaches.
struct Coverage {
  std::vector<std::size_t> pixels;
  std::vector<bool> hatched;
  std::size_t lit = 0;
};
Coverage coverage_of(const LitSphere& sphere, const std::vector<Rgb>& radiance) {
  Coverage c;
  c.hatched.resize(radiance.size());
  for (std::size_t k = 0; k < sphere.points.size(); ++k) {
    const std::size_t i = sphere.points[k].pixel;
    if (k > 0 && sphere.points[k - 1].pixel == i) continue;
    ++c.lit;
    c.hatched[i] = std::isnan(radiance[i][0]);
    if (!c.hatched[i]) c.pixels.push_back(i);
  }
  return c;
}

double exposure_of(const std::vector<Rgb>& radiance, const std::vector<std::size_t>& pixels) {
  std::vector<double> all;
  for (const std::size_t i : pixels) all.push_back(luminance(radiance[i]));
  const double white = quantile(all, 0.99);
  return white > 0 ? 1 / white : 1;
}

std::string picture(const std::vector<Rgb>& radiance,
                    double exposure,
                    std::size_t pixels,
                    const std::vector<bool>& hatched) {
  constexpr std::size_t stripe = 4;
  PngImage image{pixels, pixels, {}, {}};
  for (std::size_t i = 0; i < radiance.size(); ++i) {
    if (!hatched.empty() && hatched[i]) {
      const bool dark = (i % pixels + i / pixels) % (2 * stripe) < stripe;
      const unsigned char grey = dark ? 136 : 184;
      image.pixels.push_back({grey, grey, grey});
    } else {
      image.pixels.push_back(displayed_bytes(radiance[i], exposure));
    }
  }
  return base64(png_bytes(image));
}

/// Differences of each covered pixel.
std::vector<double> differences(const std::vector<Rgb>& reference,
                                const std::vector<Rgb>& radiance,
                                double exposure,
                                const std::vector<std::size_t>& pixels,
                                double (*difference)(const Rgb&,
                                                     const Rgb&,
                                                     double) = displayed_difference) {
  std::vector<double> all(pixels.size());
  tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t k) {
    all[k] = difference(radiance[pixels[k]], reference[pixels[k]], exposure);
  });
  return all;
}

std::string difference_bytes(const LitSphere& sphere,
                             const Coverage& covered,
                             const std::vector<double>& apart) {
  std::string bytes(sphere.inside.size(), static_cast<char>(ModelSphere::beside));
  for (std::size_t i = 0; i < bytes.size(); ++i)
    if (sphere.inside[i])
      bytes[i] = covered.hatched[i] ? static_cast<char>(ModelSphere::not_covered) : '\0';
  for (std::size_t k = 0; k < apart.size(); ++k) {
    const double byte = std::min(ModelSphere::difference_steps * apart[k],
                                 static_cast<double>(ModelSphere::most_byte));
    bytes[covered.pixels[k]] = static_cast<char>(static_cast<unsigned char>(std::lround(byte)));
  }
  return base64(bytes);
}

SpheresUnderLight Comparison::under(const SphereLight& light) const {
  const LitSphere sphere(light.towards, pixels_);
  const auto cells = this->cells(sphere);
  const auto table = sphere.radiance(of_table(sphere, cells));
  const Coverage covered = coverage_of(sphere, table);
  SpheresUnderLight s;
  s.light = light.name;
  s.covered = static_cast<double>(covered.pixels.size()) / static_cast<double>(covered.lit);
  s.exposure = no_value;
  if (s.covered < Spheres::least_share) return s;
  s.exposure = exposure_of(table, covered.pixels);
  s.table = picture(table, s.exposure, pixels_, covered.hatched);
  for (const auto& model : models_) {
    const auto radiance = sphere.radiance(of_model(sphere, model));
    auto apart = differences(table, radiance, s.exposure, covered.pixels);
    ModelSphere m{picture(radiance, s.exposure, pixels_, {}),
                  difference_bytes(sphere, covered, apart),
                  0,
                  0,
                  0,
                  no_value,
                  no_value};
    m.median = median(apart);
    auto in_light = differences(table, radiance, s.exposure, covered.pixels, difference_in_light);
    m.itp_median = median(in_light);
    m.p95 = quantile(apart, 0.95);
    if (lookup_) {
      const auto seen = sphere.radiance(through_samples(cells, model));
      auto spacing = differences(seen, radiance, s.exposure, covered.pixels);
      m.spacing_median = median(spacing);
      m.spacing_p95 = quantile(spacing, 0.95);
    }
    s.models.push_back(std::move(m));
  }
  return s;
}

}  // namespace

Spheres make_spheres(const Table& table, std::span<const BoundModel> models, std::size_t pixels) {
  const Comparison compared(table, models, pixels);
  Spheres s;
  s.pixels = pixels;
  for (const auto& m : models) s.models.push_back(to_text(m.model.spec));
  s.channels = compared.channels();
  for (const auto& light : sphere_lights()) s.lights.push_back(compared.under(light));
  return s;
}

}  // namespace gonio
