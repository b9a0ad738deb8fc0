#include "table/convert/convert.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>

#include "base/error.h"
#include "base/numbers.h"
#include "base/quantile.h"
#include "table/convert/isotropy.h"
#include "table/convert/rgb_spectra.h"
#include "table/format/exr_slice.h"
#include "table/format/formats.h"
#include "table/format/measured_by.h"
#include "table/format/rgl/resample.h"
#include "table/format/wavelengths.h"
#include "table/nearest_sample.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/parallel_for.h>

namespace gonio {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kChunk = 4096;

bool above_horizon(const DirectionPair& p) {
  return p.wi.z > horizon_cosine && p.wo.z > horizon_cosine;
}
double difference(double a, double b) {
  return a == b ? 0 : 2 * std::abs(a - b) / (std::abs(a) + std::abs(b));
}

bool is_slice(const Grid& g) {
  return g.axes[2].spacing == Axis::Spacing::constant;
}
/// One value for (wi, wo) and (wo, wi).
bool joins_ways(const Grid& g) {
  return g.kind == Grid::Kind::half_difference && (is_slice(g) || g.axes[2].span < 4);
}
/// One value for φ and −φ.
bool joins_sides(const Grid& g) {
  return g.kind == Grid::Kind::in_out || is_slice(g);
}

template <class F>
void for_each_chunk(std::size_t n, F f) {
  tbb::parallel_for(std::size_t{0}, (n + kChunk - 1) / kChunk,
                    [&](std::size_t k) { f(k * kChunk, std::min(n, (k + 1) * kChunk)); });
}

bool is_spectrum(const std::vector<std::string>& channels) {
  return channels.size() > 1 &&
         std::ranges::all_of(channels, [](const auto& c) { return wavelength_of(c).has_value(); });
}

Table with_channels(const Table& t, const ConvertOptions& o, Loss& loss) {
  Table out;
  out.format = o.format;
  out.where = t.where;
  out.negative_is_noise = t.negative_is_noise;
  std::vector<std::size_t> picked;
  auto wanted = o.channels.empty() ? t.channels : o.channels;
  const bool spectrum = o.format == "rgl" && is_spectrum(wanted);
  if (spectrum) std::ranges::stable_sort(wanted, {}, wavelength_of);
  for (const auto& name : wanted) {
    picked.push_back(channel_named(t, name));
    const auto& own = t.channels[picked.back()];
    if (std::ranges::find(out.channels, own) != out.channels.end())
      throw wrong_usage(fmt::format("channel '{}' twice", name));
    out.channels.push_back(own);
    out.values.push_back(t.values[picked.back()]);
    if (o.format == "csv" && !t.errors.empty()) out.errors.push_back(t.errors[picked.back()]);
  }
  out.aperture = t.aperture;
  if (t.between)
    out.between = [between = t.between, picked](const DirectionPair& p, std::size_t c) {
      return between(p, picked[c]);
    };
  for (const auto& name : t.channels)
    if (std::ranges::find(out.channels, name) == out.channels.end()) loss.dropped.push_back(name);
  if (o.format == "csv" || o.format == "exr" || spectrum) return out;
  const std::size_t n = out.channels.size();
  if (o.format == "zemax") {
    if (n != 1 && out.channels != std::vector<std::string>{"X", "Y", "Z"})
      throw wrong_usage(
          fmt::format("zemax holds one channel, or X, Y and Z: --channels takes one of {}",
                      fmt::join(t.channels, ", ")));
    return out;
  }
  if (n != 1 && n != 3)
    throw wrong_usage(fmt::format("{} holds one channel or three{}: --channels takes them of {}",
                                  o.format, o.format == "rgl" ? ", or wavelengths" : "",
                                  fmt::join(t.channels, ", ")));
  loss.replicated = n == 1 && (o.format == "merl" || o.format == "utia" || o.format == "rgl");
  const std::vector<std::string> rgb{"r", "g", "b"};
  if (n == 3 && out.channels != rgb) loss.renamed = std::exchange(out.channels, rgb);
  if (n == 1) out.channels = {"f"};
  return out;
}

Grid target_grid(const Table& t, const ConvertOptions& o) {
  const Grid* g = t.grid();
  const Bins bins = o.bins.value_or(t.bins());
  const bool same = g && t.format == o.format;
  if (o.format == "merl") return merl_grid(bins, !(same && g->axes[2].size == 360));
  if (o.format == "mbsdf")
    return mbsdf_grid(o.n_theta.value_or(same ? g->axes[0].size : 45),
                      o.n_phi.value_or(same ? g->axes[2].size : 90), bins);
  return image_slice_grid(same ? g->axes[0].size : 90, same ? g->axes[1].size : 90,
                          o.phi_d_deg ? *o.phi_d_deg * degree
                          : same      ? g->axes[2].span
                                      : std::numbers::pi / 2,
                          bins);
}

/// Each bin as its direction.
Table listed(Table t, Loss& loss) {
  const Grid grid = *t.grid();
  const SampleAngles at(t);
  DirectionList l;
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const auto p = at.directions(i);
    if (!above_horizon(p)) continue;
    kept.push_back(i);
    l.theta_i_deg.push_back(theta_of(p.wi) / degree);
    l.phi_i_deg.push_back(phi_of(p.wi) / degree);
    l.theta_o_deg.push_back(theta_of(p.wo) / degree);
    l.phi_o_deg.push_back(phi_of(p.wo) / degree);
  }
  loss.method = Loss::Method::listed;
  loss.left_out = t.size() - kept.size();
  for (auto* planes : {&t.values, &t.errors})
    for (auto& plane : *planes) {
      for (std::size_t k = 0; k < kept.size(); ++k) plane[k] = plane[kept[k]];
      plane.resize(kept.size());
    }
  t.where = std::move(l);
  return t;
}

/// Mean of each channel over the pairs that the target has one value for; the pairs' differences are
/// kept of some thousand bins.
class Resampling {
 public:
  /// \param to  its grid, or nullptr of a list, which has a value for each pair
  Resampling(const Table& from, const Grid* to)
      : from_(from),
        f_(from),
        ways_(to && joins_ways(*to) && !is_slice(*to) &&
              !(from.grid() && joins_ways(*from.grid()))),
        sides_(to && joins_sides(*to) && !is_slice(*to) &&
               !(from.grid() && joins_sides(*from.grid()))) {}

  double operator()(const DirectionPair& p, std::size_t channel, bool keep) {
    double sum = 0;
    std::size_t count = 0;
    const auto add = [&](const DirectionPair& q) {
      const double v = f_(q, channel);
      if (std::isfinite(v)) sum += v, ++count;
      return v;
    };
    const double here = add(p);
    if (ways_) note(reciprocity_, here, add(swapped(p)), keep);
    if (sides_) note(mirror_, here, add(mirrored(p)), keep);
    if (ways_ && sides_) add(mirrored(swapped(p)));
    return count ? sum / static_cast<double>(count) : kNone;
  }
  void tell(Loss& loss) {
    if (ways_ && !reciprocity_.empty()) loss.reciprocity = median(reciprocity_);
    if (sides_ && !mirror_.empty()) loss.mirror = median(mirror_);
  }

 private:
  void note(std::vector<double>& differences, double a, double b, bool keep) {
    if (!keep || !std::isfinite(a) || !std::isfinite(b)) return;
    const std::lock_guard lock(mutex_);
    differences.push_back(difference(a, b));
  }
  const Table& from_;
  Interpolator f_;
  bool ways_, sides_;
  std::mutex mutex_;
  std::vector<double> reciprocity_, mirror_;
};

/// \param joins  a grid that has one value for what the target has one for; none of a list
void resample(const Table& from, Table& to, const std::optional<Grid>& joins, Loss& loss) {
  if (loss.method == Loss::Method::copied) loss.method = Loss::Method::interpolated;
  loss.one_phi_d = from.grid() && is_slice(*from.grid());
  Resampling f(from, joins ? &*joins : nullptr);
  const SampleAngles at(to);
  const std::size_t every = 1 + to.size() / 20'000;
  for_each_chunk(to.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const auto p = at.directions(i);
      if (!above_horizon(p)) continue;
      for (std::size_t c = 0; c < to.values.size(); ++c) to.values[c][i] = f(p, c, i % every == 0);
    }
  });
  f.tell(loss);
}

/// The bin that a direction pair falls in.
std::optional<std::size_t> bin_of(const Grid& g, const DirectionPair& p, double reach) {
  std::array<double, 3> angle;
  if (g.kind == Grid::Kind::half_difference) {
    const auto a = half_difference(p);
    angle = {a.theta_h, a.theta_d, a.phi_d < 0 ? a.phi_d + g.axes[2].span : a.phi_d};
    if (is_slice(g) &&
        std::abs(std::remainder(a.phi_d - g.axes[2].span, std::numbers::pi)) * std::sin(a.theta_d) >
            reach)
      return {};
  } else {
    const double phi = std::remainder(phi_of(p.wo) - phi_of(p.wi), 2 * std::numbers::pi);
    angle = {theta_of(p.wi), theta_of(p.wo), std::abs(phi)};
  }
  std::size_t bin = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto size = static_cast<double>(g.axes[a].size);
    double i = std::round(g.axes[a].index(angle[a], g.bins));
    if (g.axes[a].name == "phi_d" && i >= size) i -= size;  // a period, not an end
    if (i < -1 || i > size) return {};
    bin = bin * g.axes[a].size + static_cast<std::size_t>(std::clamp(i, 0.0, size - 1));
  }
  return bin;
}

/// \param to  with its directions; gets values of all channels
void gather(const Table& from, Table& to, double reach_deg, Loss& loss) {
  if (from.values.size() > 1) {  // of one channel, which tells before all take their memory
    Table one, there;
    one.path = from.path, one.where = from.where, one.values = {from.values[0]};
    one.channels = {from.channels[0]};
    there.where = to.where;
    Loss of_one;
    gather(one, there, reach_deg, of_one);
  }
  loss.method = Loss::Method::gathered;
  to.values.assign(from.values.size(), Values(to.grid()->size(), kNone));
  const Grid& grid = *to.grid();
  const SampleAngles source(from), at(to);
  const double reach = reach_deg * degree;
  const std::size_t channels = to.values.size();
  std::vector<char> seen(to.size(), 0);
  std::vector<std::vector<std::uint32_t>> counts(channels, std::vector<std::uint32_t>(to.size()));
  NearestSample nearest(reach);
  for (std::size_t i = 0; i < from.size(); ++i) {
    const auto p = source.directions(i);
    if (!above_horizon(p)) continue;
    std::vector<DirectionPair> equal{p};
    if (joins_ways(grid)) equal.push_back(swapped(p));
    for (const auto& q : equal) {
      nearest.add(q, i);
      nearest.add(mirrored(q), i);
      const auto bin = bin_of(grid, q, reach);
      if (!bin) continue;
      seen[*bin] = 1;
      for (std::size_t c = 0; c < channels; ++c) {
        const double v = from.values[c][i];
        if (mask(source(i), v) != Mask::valid) continue;
        double& sum = to.values[c][*bin];
        sum = counts[c][*bin]++ ? sum + v : v;
      }
    }
  }
  std::atomic<std::size_t> taken = 0, reached = 0, bins = 0;
  for_each_chunk(to.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const auto p = at.directions(i);
      if (!above_horizon(p)) continue;
      ++bins;
      if (seen[i]) {
        ++reached;
        for (std::size_t c = 0; c < channels; ++c)
          if (counts[c][i] > 1) to.values[c][i] /= counts[c][i];
      } else if (const auto sample = reach > 0 ? nearest(p) : std::nullopt) {
        ++reached;
        ++taken;
        for (std::size_t c = 0; c < channels; ++c) {
          const double v = from.values[c][*sample];
          if (mask(source(*sample), v) == Mask::valid) to.values[c][i] = v;
        }
      }
    }
  });
  loss.nearest = taken;
  if (2 * reached < bins)
    throw bad_input(from.path, "converting",
                    fmt::format("samples within {:g}° of {:.1f} % of the bins", reach_deg,
                                100 * static_cast<double>(reached) / static_cast<double>(bins)),
                    "half of them at least (--reach takes samples from further away)");
}

void count_bins(const Table& t, Loss& loss) {
  const SampleAngles at(t);
  std::vector<std::size_t> without(t.values.size());
  for (std::size_t i = 0; i < t.size(); ++i) {
    const auto a = at(i);
    if (mask(a, 1) == Mask::below_horizon) continue;
    ++loss.bins;
    for (std::size_t c = 0; c < without.size(); ++c)
      without[c] += mask(a, t.values[c][i]) != Mask::valid;
  }
  loss.without_data = *std::ranges::max_element(without);
}

void there_and_back(const Table& from, const Table& to, Loss& loss) {
  const Interpolator back(to);
  const RglFunction rgl = to.format == "rgl" ? rgl_function(to) : nullptr;
  const SampleAngles at(from);
  const auto returned = [&](std::size_t i, std::size_t c) {
    if (rgl) {
      const auto p = at.directions(i);
      return std::min(p.wi.z, p.wo.z) >= least_cosine ? rgl(p, c) : kNone;
    }
    if (loss.method == Loss::Method::listed) return from.values[c][i];
    if (loss.method == Loss::Method::copied) return to.values[c][i];
    return back(at.directions(i), c);
  };
  std::vector<Loss> parts((from.size() + kChunk - 1) / kChunk);  // summed in order: the same bits
  std::vector<std::vector<double>> differences(rgl ? parts.size() : 0);
  for_each_chunk(from.size(), [&](std::size_t first, std::size_t last) {
    Loss& here = parts[first / kChunk];
    for (std::size_t i = first; i < last; ++i)
      for (std::size_t c = 0; c < from.values.size(); ++c) {
        const double v = from.values[c][i];
        if (mask(at(i), v) != Mask::valid) continue;
        const double w = returned(i, c);
        if (!std::isfinite(w)) {
          ++here.lost;
          continue;
        }
        const double d = difference(v, w);
        ++here.compared;
        here.rms += d * d;
        if (d > here.largest) here.largest = d, here.largest_at = at.directions(i);
        if (rgl) differences[first / kChunk].push_back(d);
      }
  });
  for (const Loss& part : parts) {
    loss.lost += part.lost;
    loss.compared += part.compared;
    loss.rms += part.rms;
    if (part.largest > loss.largest) loss.largest = part.largest, loss.largest_at = part.largest_at;
  }
  if (loss.compared) loss.rms = std::sqrt(loss.rms / static_cast<double>(loss.compared));
  std::vector<double> all;
  for (const auto& part : differences) all.insert(all.end(), part.begin(), part.end());
  if (!all.empty()) loss.most = quantile(all, 0.99);
}

/// Mean of the channels' function over eight turns about the normal.
RglFunction turned_mean(const Table& from) {
  return [&from](const DirectionPair& p, std::size_t channel) {
    double sum = 0;
    int count = 0;
    for (int k = 0; k < 8; ++k) {
      const double c = std::cos(45 * k * degree), s = std::sin(45 * k * degree);
      const auto turned = [&](const Direction& d) {
        return Direction{c * d.x - s * d.y, s * d.x + c * d.y, d.z};
      };
      const double v = from.between({turned(p.wi), turned(p.wo)}, channel);
      if (std::isfinite(v)) sum += v, ++count;
    }
    return count ? sum / count : kNone;
  };
}

/// Refuses a table that changes as its surface is turned, for a file that has one azimuth of light.
void expect_isotropic(const Table& from, const char* file, Loss& loss) {
  loss.azimuth = change_with_azimuth(from);
  if (loss.azimuth && *loss.azimuth > most_change)
    throw bad_input(
        from.path, "converting",
        fmt::format("f that changes by {:.3g} % as the surface is turned", 100 * *loss.azimuth),
        fmt::format("{:g} % at most: {} has one azimuth of light", 100 * most_change, file));
}

/// A list whose format says nothing of what lies between its samples, on a grid.
Table on_a_grid(const Table& from, double reach_deg, Loss& loss) {
  Table grid;
  grid.format = "mbsdf";
  grid.channels = from.channels;
  grid.where = mbsdf_grid(45, 90, from.bins());
  gather(from, grid, reach_deg, loss);
  return grid;
}

/// \param from  with the channels wanted
Conversion to_rgl(const Table& from, const ConvertOptions& o, Loss loss) {
  expect_isotropic(from, "an isotropic RGL file", loss);
  const RglSizes sizes{o.n_theta.value_or(RglSizes{}.n_theta), o.n_grid.value_or(RglSizes{}.n)};
  if (sizes.n_theta < 2)
    throw wrong_usage("an RGL file has two incident angles or more: --theta 2");
  const bool spectrum = is_spectrum(from.channels), one = from.channels.size() == 1;
  loss.to_spectra = o.spectral && !spectrum;
  const std::size_t channels = spectrum      ? from.channels.size()
                               : !o.spectral ? 3
                               : one         ? 2
                                             : rgb_bands;
  if (const auto numbers = rgl_numbers(channels, sizes); numbers > most_values)
    throw wrong_usage(
        fmt::format("{} incident angles × {} × {} values × {} channels are {} numbers with their "
                    "angles, at most {}: "
                    "a smaller --grid or --theta, or fewer --channels",
                    sizes.n_theta, sizes.n, sizes.n, channels, numbers, most_values));
  RglTable made;
  if (!from.grid() && !from.between) {
    const Table grid = on_a_grid(from, o.reach_deg, loss);
    count_bins(grid, loss);
    made = rgl_table(Interpolator(grid), from.channels, sizes);
  } else {
    loss.method = Loss::Method::interpolated;
    loss.one_phi_d = from.grid() && is_slice(*from.grid());
    made = loss.azimuth.value_or(0) > 1e-6 ? rgl_table(turned_mean(from), from.channels, sizes)
                                           : rgl_table(Interpolator(from), from.channels, sizes);
    loss.bins = made.nodes;
    loss.without_data = made.without_data;
  }
  loss.filled = loss.without_data > 0;
  loss.rounded = true;
  there_and_back(from, made.table, loss);
  std::vector<std::string> names;
  std::vector<std::vector<double>> weight;
  if (spectrum) {
    for (std::size_t c = 0; c < channels; ++c) {
      names.push_back(fmt::format("{:.6g}", *wavelength_of(from.channels[c])));
      if (c > 0 && names[c] == names[c - 1])
        throw wrong_usage(fmt::format("two channels of wavelength {} nm", names[c]));
      weight.emplace_back(channels);
      weight.back()[c] = 1;
    }
  } else if (!o.spectral) {
    names = {"r", "g", "b"};
    weight =
        one ? decltype(weight){{1}, {1}, {1}} : decltype(weight){{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  } else {
    for (std::size_t band = 0; band < rgb_bands; band += one ? rgb_bands - 1 : 1) {
      names.push_back(fmt::format("{:g}", rgb_band_nm(band)));
      weight.push_back(
          one ? std::vector<double>{1}
              : std::vector<double>(rgb_spectra[band].begin(), rgb_spectra[band].end()));
    }
  }
  return {rgl_mixed(made.table, names, spectrum || o.spectral, weight), std::move(loss)};
}

/// Turns values into those that the format will hold: in float, and with its mark for "no data".
void settle_values(Table& t, const Loss& loss) {
  const bool resampled = loss.method >= Loss::Method::interpolated;
  if (resampled) t.negative_is_noise = t.format != "merl";
  for (auto& plane : t.values)
    for (double& v : plane) {
      if (loss.rounded) v = static_cast<double>(static_cast<float>(v));
      if (resampled && !t.negative_is_noise && std::isnan(v)) v = -1;
    }
}

}  // namespace

Conversion convert(const Table& source, const ConvertOptions& o) {
  Conversion result;
  Loss& loss = result.loss;
  Table from = with_channels(source, o, loss);
  from.path = source.path;
  if (o.format == "rgl") {
    loss.weights_dropped = !source.weights.empty();
    return to_rgl(from, o, std::move(loss));
  }
  loss.rounded = o.format == "mbsdf" || o.format == "exr";
  const bool to_list = o.format == "csv", to_utia = o.format == "utia",
             to_zemax = o.format == "zemax";
  if (to_zemax) {
    expect_isotropic(from, "a PlaneSymmetrical file", loss);
    if (!from.grid() && !from.between) from = on_a_grid(from, o.reach_deg, loss);
  }
  const std::optional<Grid> grid =
      to_list || to_utia || to_zemax ? std::nullopt : std::optional(target_grid(source, o));
  if (o.format == "exr" && grid->size() > most_slice_values / from.values.size())
    throw wrong_usage(
        fmt::format("an image slice of {} × {} pixels and {} channels has more than {} "
                    "values: fewer --channels",
                    grid->axes[0].size, grid->axes[1].size, from.values.size(), most_slice_values));
  Table& to = result.table;
  if (grid       ? source.grid() && *source.grid() == *grid
      : to_utia  ? has_utia_directions(source)
      : to_zemax ? false
                 : !source.grid()) {
    to = from;
    to.between = {};
  } else if (to_list) {
    to = listed(from, loss);
  } else {
    if (grid)
      to.where = *grid;
    else
      to.where = to_zemax ? zemax_directions(zemax_axes(source)) : utia_directions();
    to.channels = from.channels;
    if (from.grid() || from.between) {
      to.values.assign(from.values.size(),
                       Values(grid ? grid->size() : to.list()->theta_i_deg.size(), kNone));
      resample(from, to, to_zemax ? std::optional(mbsdf_grid(2, 2, Bins::centre)) : grid, loss);
    } else if (grid) {
      gather(from, to, o.reach_deg, loss);
    } else {
      throw bad_input(from.path, "converting", "a list of other directions than UTIA's",
                      "a grid, or a format that says what lies between its samples");
    }
  }
  to.format = o.format;
  if (to_utia) interpolate_utia(to);
  if (to_zemax) interpolate_zemax(to);
  if (loss.method == Loss::Method::copied || loss.method == Loss::Method::listed)
    to.truth = source.truth;
  settle_values(to, loss);
  if (to_list && loss.method == Loss::Method::copied) to.weights = source.weights;
  loss.weights_dropped = !source.weights.empty() && to.weights.empty();
  to.aperture = source.aperture;
  if (!source.errors.empty() && to.errors.empty()) loss.dropped.emplace_back("uncertainties");
  count_bins(to, loss);
  there_and_back(from, to, loss);
  return result;
}

}  // namespace gonio
