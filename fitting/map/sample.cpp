#include "fitting/map/sample.h"

#include <algorithm>
#include <cmath>

#include "base/quantile.h"
#include "brdf/model/evaluate.h"
#include "geometry/half_difference.h"
#include "stack/stack.h"

namespace gonio {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

Direction direction_at(const std::vector<float>& from, std::size_t at, std::size_t run) {
  return direction(Vector{double{from[at]}, double{from[at + run]}, double{from[at + 2 * run]}});
}

}  // namespace

double median_of(std::vector<double> of) {
  return of.empty() ? unknown : median(of);
}

double cosine_of(const TexelSample& s, std::size_t image, std::size_t t) {
  const std::size_t run = s.shared ? 1 : s.texels;
  const Direction l = direction_at(s.light, 3 * image * run + (s.shared ? 0 : t), run);
  return s.normal.empty() ? l.z : dot(direction_at(s.normal, t, s.texels), l);
}

TexelFit fit_sample(const TexelSample& s, const TexelOptions& o) {
  if (!s.of_light) return fit_texels(s.spans(), o);
  TexelSample f_r = s;
  for (std::size_t i = 0; i < s.images; ++i)
    for (std::size_t t = 0; t < s.texels; ++t) {
      const double c = cosine_of(s, i, t);
      const float by = c >= least_cosine ? static_cast<float>(1 / c) : std::nanf("");
      for (std::size_t k = 0; k < s.channels; ++k)
        f_r.values[(i * s.channels + k) * s.texels + t] *= by;
    }
  return fit_texels(f_r.spans(), o);
}

double residual_variance(const TexelFit& f, std::size_t t) {
  if (f.freedom[t] < 3 || f.outcome[t] == static_cast<std::uint8_t>(TexelOutcome::no_data))
    return unknown;
  const double rms = double{f.rms[t]};
  return rms * rms * double{f.count[t]} / double{f.freedom[t]};
}

std::vector<double> residual_deviations(const TexelFit& f) {
  std::vector<double> all;
  for (std::size_t t = 0; t < f.rms.size(); ++t) all.push_back(std::sqrt(residual_variance(f, t)));
  return all;
}

std::vector<double> light_residuals(const TexelSample& s,
                                    const TexelFit& f,
                                    const TexelFit& given) {
  auto all = residual_deviations(f);
  for (std::size_t t = 0; t < s.texels; ++t) {
    if (!s.of_light) {
      if (f.count[t] < 0.97F * given.count[t]) all[t] = unknown;
      continue;
    }
    double squares = 0;
    for (std::size_t i = 0; i < s.images; ++i) {
      if (cosine_of(s, i, t) >= least_cosine) continue;
      for (std::size_t c = 0; c < s.channels; ++c)
        if (const double y = double{s.values[(i * s.channels + c) * s.texels + t]}; y > 0)
          squares += y * y;
    }
    if (f.freedom[t] > 0) all[t] = std::sqrt(all[t] * all[t] + squares / double{f.freedom[t]});
  }
  return all;
}

std::vector<double> residual_floor(const TexelFit& f) {
  std::vector<double> all;
  for (const float signal : f.signal) all.push_back(1e-3 * double{signal});
  return all;
}

ResidualRatio compare_residuals(std::vector<double> now,
                                std::vector<double> before,
                                const std::vector<double>& least) {
  ResidualRatio c;
  std::vector<double> ratios;
  constexpr double alike = 0.01;
  std::size_t lower = 0, higher = 0;
  for (std::size_t t = 0; t < before.size(); ++t) {
    if (!(before[t] >= 0 && now[t] >= 0 && least[t] > 0))
      continue;  // of black texels nothing is known
    for (auto* rms : {&now[t], &before[t]}) *rms = std::max(*rms, least[t]);
    ratios.push_back(now[t] / before[t]);
    lower += now[t] < (1 - alike) * before[t];
    higher += now[t] > (1 + alike) * before[t];
    c.halved += 2 * now[t] <= before[t];
    c.doubled += now[t] >= 2 * before[t];
  }
  c.texels = ratios.size();
  if (ratios.empty()) return c;
  if (lower > 0) c.lower = static_cast<double>(lower) / static_cast<double>(lower + higher);
  c.ratio = median_of(std::move(ratios));
  return c;
}

void leave_out(TexelSample& s, std::size_t image) {
  const std::size_t run = s.channels * s.texels;
  std::fill_n(s.values.begin() + static_cast<std::ptrdiff_t>(image * run), run,
              std::numeric_limits<float>::quiet_NaN());
}

std::vector<double> predicted(const TexelSample& s, const TexelFit& f, const TexelTask& task) {
  std::vector<double> all(s.images * s.channels * s.texels, unknown);
  BoundModel model = task.problem.start;
  std::vector<FrameAngles<double>> angles(s.images);
  const auto& normals = f.normal.empty() ? s.normal : f.normal;
  for (std::size_t t = 0; t < s.texels; ++t) {
    model.values = task.problem.start.values;
    for (std::size_t k = 0; k < f.columns.size(); ++k)
      if (!std::isnan(f.columns[k].value[t])) model.values[k] = double{f.columns[k].value[t]};
    Direction n;
    if (!normals.empty()) n = direction_at(normals, t, s.texels);
    if (std::isnan(n.z)) continue;
    const std::size_t run = s.shared ? 1 : s.texels;
    for (std::size_t i = 0; i < s.images; ++i) {
      const std::size_t at = 3 * i * run + (s.shared ? 0 : t);
      const DirectionPair pair{direction_at(s.light, at, run), direction_at(s.view, at, run)};
      angles[i] = frame_angles(normals.empty() ? pair : within(pair, n));
    }
    const auto f_r = evaluate(model, angles);
    for (std::size_t i = 0; i < s.images; ++i) {
      const double by = f.normal.empty() ? 1 : angles[i].nol / cosine_of(s, i, t);
      for (std::size_t c = 0; c < s.channels; ++c)
        if (angles[i].nol > 0 && angles[i].nov > 0)
          all[(i * s.channels + c) * s.texels + t] = f_r[c][i] * by;
    }
  }
  return all;
}

std::vector<double> differences(const TexelSample& s,
                                std::size_t image,
                                std::size_t texel,
                                const std::vector<double>& f_r,
                                Metric metric) {
  std::vector<double> all;
  const double nol = cosine_of(s, image, texel);
  for (std::size_t c = 0; c < s.channels; ++c) {
    const std::size_t at = (image * s.channels + c) * s.texels + texel;
    const double y = double{s.values[at]} / (s.of_light ? nol : 1), f = f_r[at];
    if (!(y >= 0 && f >= 0 && nol >= least_cosine)) continue;
    if (metric == Metric::l2_cosine)
      all.push_back((y - f) * nol);
    else if (y > 0 && f > 0)
      all.push_back(std::log(y / f));
  }
  return all;
}

std::vector<double> differences(const TexelSample& s,
                                std::size_t image,
                                const std::vector<double>& f_r,
                                Metric metric) {
  std::vector<double> all;
  for (std::size_t t = 0; t < s.texels; ++t)
    for (const double d : differences(s, image, t, f_r, metric)) all.push_back(d);
  return all;
}

double rms_of_all(const std::vector<double>& all) {
  double sum = 0;
  for (const double x : all) sum += x * x;
  return std::sqrt(sum / static_cast<double>(all.size()));  // NaN of none
}

double shared_residuals(const TexelSample& s, const TexelFit& f, const TexelOptions& o) {
  const auto f_r = predicted(s, f, TexelTask(o, s.channels));
  const auto left = residual_deviations(f), least = residual_floor(f);
  // [image][channel][texel]; where an image lacks a channel of a texel, it is left out.
  std::vector<double> residuals(s.values.size(), unknown), typical;
  for (std::size_t i = 0; i < s.images; ++i)
    for (std::size_t t = 0; t < s.texels; ++t)
      if (const auto d = differences(s, i, t, f_r, o.metric); d.size() == s.channels)
        for (std::size_t c = 0; c < s.channels; ++c)
          residuals[(i * s.channels + c) * s.texels + t] = d[c];
  for (std::size_t row = 0; row < s.images * s.channels; ++row) {
    std::vector<double> sizes;
    for (std::size_t t = 0; t < s.texels; ++t)
      if (const double r = residuals[row * s.texels + t]; std::isfinite(r))
        sizes.push_back(std::abs(r));
    const double middle = median_of(std::move(sizes));
    typical.push_back(middle > 0 ? middle : unknown);
  }
  // Of a few bright images that have nearly all of the noise chance makes neighbours alike, unless
  // each image is compared with its own residuals.
  std::vector<double> shared, shared_by_image;
  // Not of the same square: cameras and what registers images spread noise over neighbours.
  for (std::size_t t = 0; t + s.block < s.texels; ++t) {
    if (t / s.block % 2) continue;
    const std::size_t next = t + s.block;
    if (!(left[t] >= 0 && left[next] >= 0)) continue;
    const bool is_resolved = left[t] > least[t] && left[next] > least[next];
    const auto part = [&](bool by_image) {
      double product = 0, first = 0, second = 0;
      for (std::size_t row = 0; row < typical.size(); ++row) {
        const double unit = by_image ? typical[row] : 1, a = residuals[row * s.texels + t] / unit,
                     b = residuals[row * s.texels + next] / unit;
        if (std::isfinite(a) && std::isfinite(b)) product += a * b, first += a * a, second += b * b;
      }
      return is_resolved && product != 0 ? product / std::sqrt(first * second) : 0;
    };
    shared.push_back(part(false));
    shared_by_image.push_back(std::abs(part(true)));
  }
  constexpr double chance = 0.35, chance_of_quarter = 0.7;
  constexpr std::size_t enough_images = 20;
  if (2 * shared.size() < few_texels) return 0;
  if (const double part = median_of(shared); part > chance) return part;
  // Where half of a surface fits, and where bumps change the sign of what is left.  Of few images
  // the noise of one or two decides on all residuals, and neighbours are alike but for the sign.
  if (!s.of_light || s.images < enough_images) return 0;
  const double part = quantile(shared_by_image, 0.75);
  return part > chance_of_quarter ? part : 0;
}

std::vector<double> unseen_errors(const TexelSample& s, const TexelOptions& o) {
  constexpr std::size_t parts = 4;
  const TexelTask task(o, s.channels);
  std::vector<std::vector<double>> differ(s.texels);
  // Not every fourth image: lists of lamps go round by such numbers, and all of one height would be
  // left out.
  const auto part = [&](std::size_t k) {
    std::vector<std::size_t> images;
    for (std::size_t i = 0; i < s.images; ++i)
      if ((i + i / parts) % parts == k) images.push_back(i);
    return images;
  };
  for (std::size_t k = 0; k < parts; ++k) {
    TexelSample less = s;
    for (const std::size_t i : part(k)) leave_out(less, i);
    const auto f_r = predicted(s, fit_sample(less, o), task);
    for (std::size_t t = 0; t < s.texels; ++t)
      for (const std::size_t i : part(k))
        for (const double d : differences(s, i, t, f_r, o.metric)) differ[t].push_back(d);
  }
  std::vector<double> errors;
  for (const auto& d : differ) errors.push_back(rms_of_all(d));
  return errors;
}

}  // namespace gonio
