// The functions that a page calls by name: surfaces by number, arrays in the module's own memory.
// An error becomes -1, and its line the text of the answer.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>

#include "base/error.h"
#include "brdf/model/roughness.h"
#include "explore/sphere.h"
#include "exports.h"

namespace {

using namespace gonio;

std::vector<std::unique_ptr<explore::Surface>> surfaces;
std::unique_ptr<explore::Sphere> sphere;
std::vector<std::unique_ptr<explore::WideSphere>> wide;  // by surface

template <class Body>
int guarded(const Body& body) {
  try {
    return body();
  } catch (const std::exception& e) {
    answer = e.what();
    return -1;
  }
}

explore::Surface& at(int number) {
  const auto i = static_cast<std::size_t>(number);
  if (number < 0 || i >= surfaces.size() || !surfaces[i])
    throw wrong_usage("no surface of this number");
  return *surfaces[i];
}

int add(explore::Surface s) {
  surfaces.push_back(std::make_unique<explore::Surface>(std::move(s)));
  wide.emplace_back();
  return static_cast<int>(surfaces.size()) - 1;
}

int copied(const explore::Channels& f, double* to) {
  for (const auto& channel : f) to = std::copy(channel.begin(), channel.end(), to);
  return static_cast<int>(f.size());
}

}  // namespace

GONIO_EXPORT(catalogue) int page_catalogue() {
  return guarded([&] { return answer = explore::catalogue_json(), 0; });
}
/// \param channels  0 for as many as the settings have
GONIO_EXPORT(bind) int page_bind(const char* spec, const char* settings, std::size_t channels) {
  return guarded([&] {
    return add({spec, settings, channels ? std::optional(channels) : std::nullopt});
  });
}
/// Values by channel of a grid over half and difference angles.
GONIO_EXPORT(table)
int page_table(
    std::size_t channels, std::size_t h, std::size_t d, std::size_t p, const float* values) {
  return guarded([&] {
    Table t;
    t.where = explore::page_grid({h, d, p});
    const std::size_t n = h * d * p;
    for (std::size_t c = 0; c < channels; ++c) {
      t.channels.push_back(std::to_string(c));
      t.values.emplace_back(values + c * n, values + (c + 1) * n);
    }
    return add(explore::Surface(std::move(t)));
  });
}
GONIO_EXPORT(drop) void page_drop(int s) {
  if (s >= 0 && static_cast<std::size_t>(s) < surfaces.size())
    surfaces[static_cast<std::size_t>(s)] = nullptr, wide[static_cast<std::size_t>(s)] = nullptr;
}
GONIO_EXPORT(swap_model) int page_swap(int s, const char* spec) {
  return guarded([&] { return at(s).swap_model(spec), 0; });
}
GONIO_EXPORT(describe) int page_describe(int s) {
  return guarded([&] { return answer = at(s).description(), 0; });
}
/// The model's values, read and written in place; null of a table.
GONIO_EXPORT(values) double* page_values(int s) {
  auto* m = at(s).model();
  return m ? m->values.data() : nullptr;
}
GONIO_EXPORT(cut)
int page_cut(int s, double theta_i, double phi_i, std::size_t n, const double* theta_o, double* f) {
  return guarded([&] { return copied(explore::cut(at(s), theta_i, phi_i, {theta_o, n}), f); });
}
/// \param angles  the zenith angles, then the azimuths
GONIO_EXPORT(lobe)
int page_lobe(int s,
              double theta_i,
              double phi_i,
              std::size_t thetas,
              std::size_t phis,
              const double* angles,
              double* f) {
  return guarded([&] {
    return copied(explore::lobe(at(s), theta_i, phi_i, {angles, thetas}, {angles + thetas, phis}),
                  f);
  });
}
GONIO_EXPORT(slice)
int page_slice(int s,
               std::size_t size,
               double phi_d,
               double exposure,
               int logarithmic,
               double* f,
               unsigned char* rgba) {
  return guarded([&] {
    const auto values = explore::slice(at(s), size, phi_d);
    explore::paint(values, exposure, logarithmic, {rgba, 4 * size * size});
    return copied(values, f);
  });
}
/// Samples of a table: theta_i, phi_i, theta_o, phi_o [degrees] of each, then its values by channel.
GONIO_EXPORT(samples) int page_samples(std::size_t channels, std::size_t n, const float* numbers) {
  return guarded([&] {
    const auto column = [&](std::size_t k) {
      return std::vector<double>(numbers + k * n, numbers + (k + 1) * n);
    };
    Table t;
    t.where = DirectionList{column(0), column(1), column(2), column(3)};
    for (std::size_t c = 0; c < channels; ++c) {
      t.channels.push_back(std::to_string(c));
      t.values.emplace_back(numbers + (4 + c) * n, numbers + (5 + c) * n);
    }
    return add(explore::Surface(std::move(t)));
  });
}
/// \param to    values compared, typical factor, worst factor, its theta_h and theta_d [degrees]
/// \param rgba  a map of the ratio, Difference::cells across
GONIO_EXPORT(difference)
int page_difference(int model, int table, double* to, unsigned char* rgba) {
  return guarded([&] {
    const auto d = explore::difference(at(model), at(table));
    std::ranges::copy(std::array{static_cast<double>(d.values), d.typical_factor, d.worst_factor,
                                 d.worst_theta_h_deg, d.worst_theta_d_deg},
                      to);
    explore::paint_ratio(d, {rgba, 4 * d.log_ratio.size()});
    return 0;
  });
}
/// \param to  measured values of every stride-th sample, then the model's; how many of each is answered
GONIO_EXPORT(measured_and_modelled)
int page_measured(int model, int table, std::size_t channel, std::size_t stride, double* to) {
  return guarded([&] {
    int n = 0;
    for (const auto& values : explore::measured_and_modelled(at(model), at(table), channel)) {
      n = 0;
      for (std::size_t i = 0; i < values.size(); i += stride, ++n) *to++ = values[i];
    }
    return n;
  });
}
/// Of the light's direction: to the right, up, and to the viewer.
GONIO_EXPORT(sphere) int page_sphere(std::size_t pixels, double x, double y, double z) {
  return guarded([&] {
    const double length = std::sqrt(x * x + y * y + z * z);
    const Direction towards{x / length, y / length, z / length};
    sphere = std::make_unique<explore::Sphere>(pixels, std::span(&towards, 1));
    return 0;
  });
}
/// The same under the lights of that number among those of the catalogue.
GONIO_EXPORT(sphere_under) int page_sphere_under(std::size_t pixels, std::size_t lights) {
  return guarded([&] {
    sphere = std::make_unique<explore::Sphere>(pixels, sphere_lights().at(lights).towards);
    return 0;
  });
}
GONIO_EXPORT(draw) int page_draw(int s, std::size_t pixels, double exposure, unsigned char* rgba) {
  return guarded([&] {
    if (!sphere) throw wrong_usage("no sphere is prepared");
    return sphere->draw(at(s), exposure, {rgba, 4 * pixels * pixels}), 0;
  });
}
/// Begins a surface's sphere under the light that extends of that number.
GONIO_EXPORT(wide_sphere) int page_wide(int s, std::size_t pixels, std::size_t light) {
  return guarded([&] {
    at(s);
    wide[static_cast<std::size_t>(s)] = std::make_unique<explore::WideSphere>(pixels, light);
    return 0;
  });
}
/// One pass more of it; answers how many there are.
GONIO_EXPORT(gather) int page_gather(int s, double exposure, unsigned char* rgba) {
  return guarded([&] {
    const auto& surface = at(s);
    auto& lit = wide[static_cast<std::size_t>(s)];
    if (!lit) throw wrong_usage("no sphere is prepared");
    const auto done = lit->gather(surface);
    const auto radiance = lit->radiance();
    explore::paint(radiance, exposure, false, {rgba, 4 * radiance[0].size()});
    return static_cast<int>(done);
  });
}
/// \param to  median and 95 % quantile of ΔE2000, and the share of the pixels that are known
GONIO_EXPORT(sphere_difference)
int page_sphere_difference(int a, int b, double exposure, double* to) {
  return guarded([&] {
    if (!sphere) throw wrong_usage("no sphere is prepared");
    const auto d = sphere->difference(at(a), at(b), exposure);
    std::ranges::copy(std::array{d.median, d.p95, d.covered}, to);
    return 0;
  });
}
GONIO_EXPORT(roughness) double page_roughness(double alpha) {
  return roughness_of(alpha);
}
GONIO_EXPORT(albedo)
int page_albedo(int s, std::size_t n, const double* theta, int furnace, double* e) {
  return guarded([&] { return copied(explore::albedo(at(s), {theta, n}, furnace), e); });
}
