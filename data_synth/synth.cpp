#include "data_synth/synth.h"

#include <cmath>
#include <numbers>
#include <optional>

#include "base/error.h"
#include "base/random.h"
#include "base/text.h"
#include "brdf/model/evaluate.h"
#include "integrate/aperture/mean_values.h"
#include "table/format/formats.h"
#include "table/format/rgl/resample.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace gonio {
namespace {

void push(DirectionList& l, double theta_i, double phi_i, double theta_o, double phi_o) {
  l.theta_i_deg.push_back(theta_i);
  l.phi_i_deg.push_back(phi_i);
  l.theta_o_deg.push_back(theta_o);
  l.phi_o_deg.push_back(phi_o);
}

DirectionList in_plane() {
  DirectionList l;
  for (const int in : {10, 30, 45, 60, 75})
    for (int out = -85; out <= 85; ++out) push(l, in, 0, std::abs(out), out > 0 ? 180 : 0);
  return l;
}

DirectionList hemisphere() {
  DirectionList l;
  for (const int in : {0, 15, 30, 45, 60, 75})
    for (int out = 0; out <= 85; out += 5)
      for (int phi = 0; phi < (out == 0 ? 10 : 360); phi += 10) push(l, in, 0, out, phi);
  return l;
}

void lay_out(Table& t, const SynthOptions& o) {
  switch (o.layout) {
    case Layout::merl:
      t.format = "merl";
      t.where = merl_grid(o.bins);
      t.negative_is_noise = false;
      break;
    case Layout::mbsdf:
      t.format = "mbsdf";
      t.where = mbsdf_grid(45, 90, o.bins);
      break;
    case Layout::utia:
      t.format = "utia";
      t.where = utia_directions();
      break;
    case Layout::image_slice:
      t.format = "exr";
      t.where = image_slice_grid(o.slice, o.slice, 90 * degree, o.bins);
      break;
    case Layout::rgl:
      break;  // rgl_of() lays it out
    case Layout::in_plane:
      t.format = "csv";
      t.where = in_plane();
      break;
    case Layout::hemisphere:
      t.format = "csv";
      t.where = hemisphere();
      break;
    case Layout::random:
      t.format = "csv";
      t.where = random_pairs(o.samples, o.seed);
      break;
  }
}

Table rgl_of(const BoundModel& b, const SynthOptions& o) {
  const std::size_t channels = b.model.channels;
  if (channels != 1 && channels != 3)
    throw wrong_usage(
        fmt::format("an RGL table has 1 or 3 channels, the colours given have {}", channels));
  if (b.model.anisotropic)
    throw wrong_usage(fmt::format("model '{}' is anisotropic: layout rgl has one azimuth of light",
                                  to_text(b.model.spec)));
  if (o.noise > 0 || o.outliers > 0)
    throw wrong_usage(
        "layout rgl is what renderers draw from and takes neither noise nor outliers");
  const auto f = [&](const DirectionPair& p, std::size_t channel) {
    return evaluate(b, std::vector{angles(p)})[channel][0] + o.floor;
  };
  std::vector<std::string> names{"f"};
  std::vector<std::vector<double>> weight{{1}, {1}, {1}};
  if (channels == 3) {
    names = {"r", "g", "b"};
    weight = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  }
  return rgl_mixed(rgl_table(f, names, {}).table, {"r", "g", "b"}, false, weight);
}

}  // namespace

DirectionList random_pairs(std::size_t n, std::uint64_t seed) {
  DirectionList l;
  constexpr double lowest = 0.01, grazing = 87;  // [deg]
  for (std::uint64_t attempt = 0; l.theta_i_deg.size() < n; ++attempt) {
    Draws draw(seed ^ 0x5851f42d4c957f2dU, attempt);
    const auto upwards = [&] {
      const double z = draw.uniform();
      return direction(std::acos(z), 2 * std::numbers::pi * draw.uniform());
    };
    DirectionPair p;
    if (attempt % 2 == 0) {
      p.wi = upwards();
      p.wo = upwards();
    } else {
      const double theta_h = lowest * std::pow(60 / lowest, draw.uniform()) * degree;
      const double phi_h = 2 * std::numbers::pi * draw.uniform();
      const double theta_d = std::acos(draw.uniform());
      p = directions(
          HalfDifference{theta_h, phi_h, theta_d, 2 * std::numbers::pi * draw.uniform()});
    }
    const double in = theta_of(p.wi) / degree, out = theta_of(p.wo) / degree;
    if (in < grazing && out < grazing)
      push(l, in, phi_of(p.wi) / degree, out, phi_of(p.wo) / degree);
  }
  return l;
}

Table synthesize(const BoundModel& b, const SynthOptions& o, const Aperture& aperture) {
  const std::size_t channels = b.model.channels;
  if ((o.layout == Layout::merl || o.layout == Layout::utia) && channels != 3)
    throw wrong_usage(fmt::format("a {} table has 3 channels, the colours given have {}",
                                  o.layout == Layout::merl ? "MERL" : "UTIA", channels));
  if (o.layout == Layout::mbsdf && channels != 3 && channels != 1)
    throw wrong_usage(
        fmt::format("an MBSDF table has 1 or 3 channels, the colours given have {}", channels));

  if (o.layout == Layout::random && o.samples > most_values / (channels + 4))
    throw wrong_usage(
        fmt::format("{} samples of {}; a table has {} numbers at most, directions "
                    "included",
                    o.samples, counted(channels, "channel"), most_values));

  if (o.layout == Layout::rgl) {
    if (aperture) throw wrong_usage("aperture: layout rgl is a grid of points");
    Table t = rgl_of(b, o);
    t.truth = Truth{to_text(b.model.spec), named_values(b), 0, o.floor, 0, o.seed};
    t.notes.emplace_back("layout", name_of(o.layout));
    return t;
  }
  Table t;
  lay_out(t, o);
  for (std::size_t c = 0; c < channels; ++c)
    t.channels.push_back(channels == 1   ? "f"
                         : channels == 3 ? std::string(1, "rgb"[c])
                                         : std::to_string(c + 1));
  const std::size_t n = t.grid() ? t.grid()->size() : t.list()->theta_i_deg.size();
  for (std::size_t c = 0; c < channels; ++c) t.values.emplace_back(n);

  if (b.model.anisotropic && t.grid())
    throw wrong_usage(
        fmt::format("model '{}' is anisotropic: layout {} does not say how the surface was turned; "
                    "those of direction lists do: utia, in_plane, hemisphere, random",
                    to_text(b.model.spec), name_of(o.layout)));
  if (aperture && t.grid())
    throw wrong_usage(
        fmt::format("aperture: layout {} is a grid of points; those of direction lists take one: "
                    "utia, in_plane, hemisphere, random",
                    name_of(o.layout)));
  if (o.uncertainty && (t.format != "csv" || !(o.noise > 0)))
    throw wrong_usage(
        "uncertainty: goes with noise and a layout that is written as CSV: in_plane, hemisphere, "
        "random");
  const SampleAngles at(t);
  std::optional<ApertureAngles> seen;
  if (aperture) {
    t.aperture = aperture;
    seen.emplace(
        n, [&](std::size_t i) { return at.directions(i); }, t.aperture, b.model.anisotropic);
  }
  constexpr std::size_t chunk = 16384;
  tbb::parallel_for(std::size_t{0}, (n + chunk - 1) / chunk, [&](std::size_t k) {
    const std::size_t first = k * chunk, count = std::min(chunk, n - first);
    std::vector<bool> above(count);
    const auto values = [&](auto&& angles_of) {
      std::vector<decltype(angles_of(first))> angles(count);
      for (std::size_t i = 0; i < count; ++i) {
        angles[i] = angles_of(first + i);
        above[i] = angles[i].nol > 0 && angles[i].nov > 0;
      }
      return evaluate(b, angles);
    };
    auto f = b.model.anisotropic ? values([&](std::size_t i) { return at.frame(i); })
                                 : values([&](std::size_t i) { return at(i); });
    if (seen) f = mean_values(b, *seen, first, count);
    for (std::size_t i = 0; i < count; ++i) {
      Draws draw(o.seed, first + i);
      double outlier = 1;
      if (o.outliers > 0 && draw.uniform() < o.outliers)
        outlier = std::pow(10, 4 * draw.uniform() - 2);
      for (std::size_t c = 0; c < channels; ++c) {
        double v = above[i] ? f[c][i] + o.floor : 0;
        if (o.noise > 0) v *= std::exp(o.noise * draw.normal());
        t.values[c][first + i] = v * outlier;
      }
    }
  });

  if (o.uncertainty) {
    t.errors = t.values;
    for (auto& plane : t.errors)
      for (double& v : plane) v = std::max(o.noise * v, 1e-300);
  }
  t.truth = Truth{to_text(b.model.spec), named_values(b), o.noise, o.floor, o.outliers, o.seed};
  t.notes.emplace_back("layout", name_of(o.layout));
  return t;
}

}  // namespace gonio
