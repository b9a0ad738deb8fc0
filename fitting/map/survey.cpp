#include "fitting/map/survey.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "fitting/map/sample.h"
#include "fitting/map/task.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace gonio {
namespace {

/// Scale of a texel's variance, by the kind of noise.
/// \param dark  signal below which the camera's own noise takes over
double scale(const TexelFit& f, std::size_t t, bool follows_light, double dark) {
  const double signal = std::max(double{f.signal[t]}, dark);
  return follows_light ? signal * signal : 1;
}

double dark_of(const TexelFit& f) {
  std::vector<double> signals(f.signal.begin(), f.signal.end());
  std::erase_if(signals, [](double s) { return !(s > 0); });
  return signals.empty() ? 0 : 0.05 * median_of(std::move(signals));
}

std::vector<double> variances(const TexelFit& f, bool follows_light) {
  std::vector<double> all;
  const double dark = dark_of(f);
  for (std::size_t t = 0; t < f.rms.size(); ++t)
    if (const double v = residual_variance(f, t) / scale(f, t, follows_light, dark); v > 0)
      all.push_back(v);
  return all;
}

/// Spread of the logarithms about their median: what one kind of noise explains better is less spread.
double spread(const std::vector<double>& all) {
  std::vector<double> off;
  const double middle = std::log(median_of(all));
  for (const double v : all) off.push_back(std::abs(std::log(v) - middle));
  return median_of(std::move(off));
}

/// \param wrong  the model asked for is known not to fit: then one texel in four may be accused wrongly, and else one in 200
TexelNoise noise_of(const TexelFit& f, bool wrong) {
  TexelNoise n;
  auto by_light = variances(f, true), same = variances(f, false);
  if (by_light.size() < few_texels) return n;
  n.follows_light = spread(by_light) <= spread(same);
  auto& all = n.follows_light ? by_light : same;
  std::ranges::sort(all);
  std::vector<double> least = residual_floor(f);
  std::erase_if(least, [](double x) { return !(x > 0); });
  const double floor = n.follows_light ? 1e-3 : median_of(std::move(least));
  const std::size_t beyond = std::max<std::size_t>(all.size() / (wrong ? 4 : 200), 1);
  n.dark = static_cast<float>(dark_of(f));
  n.most =
      static_cast<float>((wrong ? 1 : 1.05) * std::max(std::sqrt(all[all.size() - beyond]), floor));
  return n;
}

/// Models that a surface may follow where the one asked for does not fit.
constexpr std::array<std::string_view, 8> others{
    "lambert",
    "oren_nayar",
    "eon",
    "lambert+gtr/smith_ggx.correlated/schlick",
    "oren_nayar+ggx/smith_ggx.correlated/schlick",
    "lambert+beckmann/smith_beckmann.correlated/schlick",
    "lambert+ggx_aniso/smith_ggx_aniso.correlated/schlick",
    "lambert+ggx/smith_ggx.correlated/schlick+ggx/smith_ggx.correlated/schlick"};

TexelOptions asked_of(std::string_view model, const TexelOptions& asked) {
  if (model == asked.model) return asked;
  TexelOptions o;
  o.model = model;
  o.metric = asked.metric;
  o.offset = asked.offset;
  o.refine_normals = asked.refine_normals;
  return o;
}

/// The model that leaves least in images that its fits have not seen, and how much of what the one asked for leaves there.
std::pair<std::string, double> best_model(const TexelSample& s,
                                          const TexelOptions& o,
                                          const TexelFit& fit_as_asked) {
  const auto given = unseen_errors(s, o), left = residual_deviations(fit_as_asked),
             least_rms = residual_floor(fit_as_asked);
  std::array<ResidualRatio, others.size()> seen;
  tbb::parallel_for(std::size_t{0}, others.size(), [&](std::size_t k) {
    const TexelOptions other = asked_of(others[k], o);
    if (others[k] == o.model) return;
    try {
      check(other, s.channels);
    } catch (const Error&) {  // as an anisotropic one whose normals are sought
      return;
    }
    // In the images that its fits have seen, too: where few determine a model, its error in others
    // is chance.
    const auto inside =
        compare_residuals(residual_deviations(fit_sample(s, other)), left, least_rms);
    if (inside.ratio > 0.92 || inside.lower < 0.6) return;
    seen[k] = compare_residuals(unseen_errors(s, other), given, least_rms);
  });
  const auto least = std::ranges::min_element(seen, {}, &ResidualRatio::ratio);
  if (least->ratio > 0.95 || least->lower < 0.6) return {o.model, 1};
  return {std::string(others[static_cast<std::size_t>(least - seen.begin())]), least->ratio};
}

/// How much less is left of texels without an image.
ResidualRatio without(TexelSample less,
                      std::size_t image,
                      const TexelFit& with,
                      const TexelOptions& o) {
  leave_out(less, image);
  return compare_residuals(residual_deviations(fit_sample(less, o)), residual_deviations(with),
                           residual_floor(with));
}

/// The images whose logarithms differ most from what a fit says, 16 at most.
std::vector<std::size_t> loudest(const TexelSample& s,
                                 std::vector<std::size_t> images,
                                 const std::vector<double>& f_r) {
  std::vector<double> loud(s.images);
  for (const std::size_t i : images) {
    std::vector<double> off;
    for (std::size_t t = 0; t < s.texels; ++t)
      for (const double d : differences(s, i, t, f_r, Metric::log)) off.push_back(d);
    loud[i] = off.empty() ? 0 : rms_of_all(off);
  }
  std::ranges::stable_sort(images, std::ranges::greater{}, [&](std::size_t i) { return loud[i]; });
  constexpr std::size_t most = 16;
  images.resize(std::min(images.size(), most));
  return images;
}

/// An image is odd where the ratios of the others agree far better without it, and nearly all of its values are off to one side or its
/// light is off by far more than that of others: the darkest image of a noisy stack is neither.
std::vector<OddImage> odd_images(TexelSample s, TexelOptions by_ratios) {
  constexpr std::size_t most_odd = 3, least_images = 6;
  constexpr double odd_ratio = 0.7;
  std::vector<OddImage> odd;
  std::vector<std::size_t> left(s.images);
  std::iota(left.begin(), left.end(), std::size_t{0});
  by_ratios.metric = Metric::log;
  const TexelTask task(by_ratios, s.channels);
  while (odd.size() < most_odd && left.size() >= least_images) {
    const TexelFit with = fit_sample(s, by_ratios);
    const auto suspects = loudest(s, left, predicted(s, with, task));
    std::vector<ResidualRatio> seen(suspects.size());
    tbb::parallel_for(std::size_t{0}, suspects.size(),
                      [&](std::size_t k) { seen[k] = without(s, suspects[k], with, by_ratios); });
    const auto least = std::ranges::min_element(seen, {}, &ResidualRatio::ratio);
    if (least->ratio > odd_ratio || least->lower < 0.8 || least->texels < few_texels) break;
    const std::size_t image = suspects[static_cast<std::size_t>(least - seen.begin())];
    TexelSample less = s;
    leave_out(less, image);
    const auto f_r = predicted(s, fit_sample(less, by_ratios), task);
    const auto off = [&](std::size_t i, Metric metric) {
      std::vector<double> all;
      for (std::size_t t = 0; t < s.texels; ++t)
        for (const double d : differences(s, i, t, f_r, metric)) all.push_back(d);
      return all;
    };
    const auto ratios = off(image, Metric::log);
    const double middle = median_of(ratios);
    const auto to_its_side = static_cast<double>(
        std::ranges::count_if(ratios, [&](double x) { return (x > 0) == (middle > 0); }));
    const auto values = static_cast<double>(least->texels * s.channels);
    std::vector<double> light;
    for (const std::size_t i : left)
      if (const double of = rms_of_all(off(i, Metric::l2_cosine)); of >= 0) light.push_back(of);
    const bool to_one_side = to_its_side > 0.9 * static_cast<double>(ratios.size()) &&
                             static_cast<double>(ratios.size()) > 0.8 * values &&
                             std::abs(middle) > 0.3;
    if (!to_one_side &&
        !(rms_of_all(off(image, Metric::l2_cosine)) > 3 * median_of(std::move(light))))
      break;
    odd.push_back({image, least->ratio, std::exp(middle)});
    s = std::move(less);
    std::erase(left, image);
  }
  return odd;
}

StackSurvey survey(const TexelSample& s, const TexelOptions& o) {
  StackSurvey found;
  const TexelFit given = fit_sample(s, o);
  for (std::size_t t = 0; t < s.texels; ++t) found.texels += residual_variance(given, t) >= 0;
  const auto taken = std::accumulate(given.count.begin(), given.count.end(), 0.0F);
  found.left_out = 1 - double{taken} / static_cast<double>(s.values.size());
  if (found.texels < few_texels) return found;
  const auto [by, ratio] = best_model(s, o, given);
  found.arrangement = other_arrangement(s, o, asked_of(by, o));
  if (found.arrangement.sure) return found;  // all else would be judged by wrong directions
  if (by != o.model) {
    found.better = by;
    found.better_ratio = ratio;
  }
  const TexelOptions of_best = asked_of(by, o);
  found.noise = noise_of(by == o.model ? given : fit_sample(s, of_best), by != o.model);
  found.odd = odd_images(s, of_best);
  return found;
}

}  // namespace

StackSurvey survey(const TexelSamples& s, const TexelOptions& o) {
  const auto copy = [](std::span<const float> from) {
    return std::vector<float>(from.begin(), from.end());
  };
  return survey(TexelSample{s.texels, s.images, s.channels, s.shared, false, copy(s.values),
                            copy(s.light), copy(s.view), copy(s.normal)},
                o);
}

StackSurvey survey(const StackReader& stack, const TexelOptions& o) {
  // Fewer texels of many images, and of wide ones no more than the middle: neither time nor memory
  // grows with them.
  constexpr std::size_t least_rows = 4, most_of_row = 64, most_numbers = 1 << 24;
  const std::size_t images = stack.stack().images.size(),
                    of_row = std::clamp(std::size_t{1 << 14} / images, std::size_t{8}, most_of_row),
                    columns = std::clamp(most_numbers / (images * stack.channels().size()),
                                         std::size_t{1}, stack.width()),
                    begin = (stack.width() - columns) / 2, width = std::min(of_row, columns),
                    height =
                        std::min(std::max(least_rows, of_row * least_rows / width), stack.height());
  TexelSample s;
  s.texels = height * width;
  s.shared = stack.shared();
  StackPart part;
  for (std::size_t r = 0; r < height; ++r) {
    const std::size_t y = (2 * r + 1) * stack.height() / (2 * height);
    stack.read({begin, y, columns, 1}, part);
    if (r == 0) {
      s.images = part.images;
      s.channels = part.channels;
      s.values.resize(s.images * s.channels * s.texels);
      const std::size_t directions = 3 * s.images * (s.shared ? 1 : s.texels);
      s.light.resize(directions);
      s.view.resize(directions);
      if (stack.has_normals()) s.normal.resize(3 * s.texels);
    }
    for (std::size_t k = 0; k < width; ++k) {
      const std::size_t x = (2 * k + 1) * columns / (2 * width), to = r * width + k;
      const auto piece = part.piece(x / StackPart::piece_texels);
      const std::size_t from = x - piece.first;
      const auto take = [&](std::span<const float> in, std::vector<float>& out) {
        for (std::size_t row = 0; (row + 1) * piece.texels <= in.size(); ++row)
          out[row * s.texels + to] = in[row * piece.texels + from];
      };
      take(piece.values, s.values);
      if (!s.shared) {
        take(piece.light, s.light);
        take(piece.view, s.view);
      }
      if (stack.has_normals()) take(piece.normal, s.normal);
    }
    if (s.shared && r == 0) {
      std::ranges::copy(part.piece(0).light, s.light.begin());
      std::ranges::copy(part.piece(0).view, s.view.begin());
    }
  }
  s.of_light = stack.stack().values == StackValues::f_r_cosine;
  if (s.of_light)  // what was divided by n·l of the directions as given
    for (std::size_t i = 0; i < s.images; ++i)
      for (std::size_t t = 0; t < s.texels; ++t) {
        const auto by = static_cast<float>(cosine_of(s, i, t));
        for (std::size_t k = 0; k < s.channels; ++k)
          s.values[(i * s.channels + k) * s.texels + t] *= by;
      }
  return survey(s, o);
}

std::vector<float> misfit_of(const TexelFit& f, const TexelNoise& n) {
  std::vector<float> out(f.rms.size(), std::numeric_limits<float>::quiet_NaN());
  for (std::size_t t = 0; t < out.size(); ++t)
    out[t] = static_cast<float>(std::sqrt(residual_variance(f, t) /
                                          scale(f, t, n.follows_light, double{n.dark}))) /
             n.most;
  return out;
}

std::vector<std::string> warnings_of(const StackSurvey& s,
                                     const Stack& stack,
                                     std::string_view model) {
  std::vector<std::string> lines;
  const auto times = [](double ratio) { return fmt::format("{:.3g}", 1 / ratio); };
  if (const auto& a = s.arrangement; !a.what.empty())
    lines.push_back(
        fmt::format("it may be that {}: so read, the images leave an rms {} times less (then {})",
                    a.what, times(a.ratio), a.cure));
  if (!s.better.empty())
    lines.push_back(fmt::format(
        "{} does not fit: in images that fits have not seen, {} leaves an rms {} times less", model,
        s.better, times(s.better_ratio)));
  for (const auto& odd : s.odd)
    lines.push_back(fmt::format(
        "{} does not agree with the other images, which leave an rms {} times less "
        "without it: it is {:.2g} times as bright as they "
        "predict. Its lamp, direction or place is another, or the model does not fit there",
        stack.images[odd.image].path, times(odd.ratio), odd.brightness));
  return lines;
}

}  // namespace gonio
