#include "fitting/map/survey.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "fitting/map/images.h"
#include "fitting/map/sample.h"
#include "fitting/map/stack_sample.h"
#include "fitting/map/task.h"
#include "fitting/map/tone.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
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

/// \param wrong   the model asked for is known not to fit: then one texel in four may be accused wrongly, and else one in 200
/// \param shared  part of what is left that is no noise (shared_residuals); 0 of noise
TexelNoise noise_of(const TexelFit& f, bool wrong, double shared) {
  TexelNoise n;
  wrong = wrong || shared > 0;
  auto by_light = variances(f, true), same = variances(f, false);
  if (by_light.size() < few_texels) return n;
  n.follows_light = spread(by_light) <= spread(same);
  auto& all = n.follows_light ? by_light : same;
  std::ranges::sort(all);
  std::vector<double> least = residual_floor(f);
  std::erase_if(least, [](double x) { return !(x > 0); });
  const double floor = n.follows_light ? 1e-3 : median_of(std::move(least));
  const std::size_t beyond = std::max<std::size_t>(all.size() / (wrong ? 4 : 200), 1);
  // Three to five of their deviations above the median: of neighbours with common noise the
  // sample's ends are seldom reached, and texels whose fits went astray are no noise.
  const auto above = [&](double deviations) {
    return median_of(all) * std::exp(deviations * 1.4826 * spread(all));
  };
  const double end = all[all.size() - beyond], noise = wrong
                                                           ? std::min(end, above(5)) * (1 - shared)
                                                           : std::clamp(end, above(3), above(5));
  n.dark = static_cast<float>(dark_of(f));
  n.most = static_cast<float>((wrong ? 1 : 1.05) * std::max(std::sqrt(noise), floor));
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

/// The options whose fits leave least in images that they have not seen, and how much of what those asked for leave there: another model, or normals that are
/// sought.
std::pair<TexelOptions, double> best_options(const TexelSample& s,
                                             const TexelOptions& o,
                                             const TexelFit& fit_as_asked) {
  const auto given = unseen_errors(s, o), left = residual_deviations(fit_as_asked),
             least_rms = residual_floor(fit_as_asked);
  std::vector<TexelOptions> all;
  for (const auto model : others)
    if (model != o.model) all.push_back(asked_of(model, o));
  all.push_back(o);
  all.back().refine_normals = true;
  if (o.refine_normals) all.pop_back();
  std::vector<ResidualRatio> seen(all.size());
  tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t k) {
    const TexelOptions& other = all[k];
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
  if (least->ratio > 0.95 || least->lower < 0.6) return {o, 1};
  return {all[static_cast<std::size_t>(least - seen.begin())], least->ratio};
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
    const auto off = [&](std::size_t i) { return differences(s, i, f_r, Metric::l2_cosine); };
    const auto ratios = differences(s, image, f_r, Metric::log);
    const double middle = median_of(ratios);
    const auto to_its_side = static_cast<double>(
        std::ranges::count_if(ratios, [&](double x) { return (x > 0) == (middle > 0); }));
    const auto values = static_cast<double>(least->texels * s.channels);
    std::vector<double> light;
    for (const std::size_t i : left)
      if (const double of = rms_of_all(off(i)); of >= 0) light.push_back(of);
    const bool to_one_side = to_its_side > 0.9 * static_cast<double>(ratios.size()) &&
                             static_cast<double>(ratios.size()) > 0.8 * values &&
                             std::abs(middle) > 0.3;
    if (!to_one_side && !(rms_of_all(off(image)) > 3 * median_of(std::move(light)))) break;
    odd.push_back({image, least->ratio, std::exp(middle)});
    s = std::move(less);
    std::erase(left, image);
  }
  return odd;
}

/// Why no model explains the images, in one way: the one that leaves least.  Normals that are sought may be what hides it.
void blame_images(const TexelSample& s, const TexelOptions& o, StackSurvey& found) {
  for (const bool sought : {false, true}) {
    TexelOptions as = o;
    as.refine_normals = as.refine_normals || sought;
    try {
      check(as, s.channels);
    } catch (const Error&) {
      continue;
    }
    const TexelFit given = fit_sample(s, as);
    const auto exposure = other_exposure(s, as, given);
    if (exposure && (!found.exposure || exposure->ratio < found.exposure->ratio))
      found.exposure = exposure;
    const auto exchanged = exchanged_images(s, as, given);
    if (exchanged && (!found.exchanged || exchanged->ratio < found.exchanged->ratio))
      found.exchanged = exchanged;
  }
  if (found.exposure && found.exchanged) {
    if (found.exposure->ratio < found.exchanged->ratio)
      found.exchanged.reset();
    else
      found.exposure.reset();
  }
  if (found.exposure && found.exposure->images.size() == 1 && !found.odd.empty())
    found.exposure.reset();  // it is named already
  if (found.exposure || found.exchanged) {
    found.odd.clear();
    found.better.clear();
    found.seeks_normals = false;
  }
}

/// Part of the texels that reflect more than any dielectric: more than all light, or a highlight of metal above a base that is none.
double too_bright(const TexelFit& f) {
  constexpr double brightest_f0 = 0.3, dark_kd = 0.1;
  std::size_t bright = 0, all = 0;
  for (std::size_t t = 0; t < f.rms.size(); ++t) {
    bool is_bright = false, is_known = false;
    for (const auto& kd : f.columns)
      for (const auto& f0 : f.columns) {
        if (kd.parameter != "kd" || f0.parameter != "f0" ||
            (f0.channel >= 0 && kd.channel != f0.channel))
          continue;
        const double base = double{kd.value[t]}, top = double{f0.value[t]};
        is_known = is_known || base + top >= 0;
        is_bright = is_bright || base + top > 1 || (top > brightest_f0 && base > dark_kd);
      }
    all += is_known;
    bright += is_bright;
  }
  return all < few_texels ? 0 : static_cast<double>(bright) / static_cast<double>(all);
}

StackSurvey survey(const TexelSample& s, const TexelOptions& o) {
  StackSurvey found;
  const TexelFit given = fit_sample(s, o);
  for (std::size_t t = 0; t < s.texels; ++t) found.texels += residual_variance(given, t) >= 0;
  const auto taken = std::accumulate(given.count.begin(), given.count.end(), 0.0F);
  found.left_out = 1 - double{taken} / static_cast<double>(s.values.size());
  if (found.texels < few_texels) return found;
  const auto [best, ratio] = best_options(s, o, given);
  if (o.refine_normals && !s.normal.empty()) {  // which would hide that the given ones are others
    TexelOptions kept = o;
    kept.refine_normals = false;
    found.arrangement = other_arrangement(s, kept, kept);
    if (found.arrangement.sure) return found;
  }
  const AzimuthCheck by_normals = found.arrangement.azimuth;
  found.arrangement = other_arrangement(s, o, best);
  found.arrangement.azimuth = std::max(found.arrangement.azimuth, by_normals);
  if (found.arrangement.sure) return found;  // all else would be judged by wrong directions
  const bool is_other = ratio < 1;
  found.without_normals = s.normal.empty() && TexelTask(o, s.channels).turns();
  const TexelFit of_best = is_other ? fit_sample(s, best) : given;
  found.shared = shared_residuals(s, of_best, best);
  found.noise = noise_of(of_best, is_other, found.shared);
  found.odd = odd_images(s, best);
  if (is_other) {
    found.seeks_normals = best.model == o.model;
    if (!found.seeks_normals) found.better = best.model;
    found.better_ratio = ratio;
  }
  if (found.shared > 0) blame_images(s, o, found);
  if (const bool is_explained = found.exposure || found.exchanged;
      !is_explained && (found.shared > 0 || is_other))
    found.tone = other_tone(s, o, of_best);
  found.too_bright = too_bright(given);
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

namespace {

LampsOfList lamps_of(const Stack& stack) {
  const auto farthest = [&](double right, double up) {
    return std::ranges::max_element(
               stack.images, {},
               [&](const StackImage& i) {
                 auto light = direction_of(i.light);
                 if (const auto* near = std::get_if<SidePosition<Side::light>>(&i.light))
                   light = direction(near->at);
                 if (!light) return -2.0;
                 return right * light->x + up * light->y -
                        std::abs(right * light->y + up * light->x);
               })
        ->path;
  };
  return {farthest(1, 0), farthest(0, 1)};
}

}  // namespace

StackSurvey survey(const StackReader& stack, const TexelOptions& o) {
  if (o.refine_normals && o.model == "lambert" && stack.stack().values == StackValues::f_r)
    throw wrong_usage(
        "normals: f_r of lambert is the same whatever the normal; values f_r_cosine show it");
  StackSurvey found = survey(small_sample(stack), o);
  TexelOptions refined = o;
  refined.refine_normals = o.refine_normals || found.seeks_normals;
  if (!refined.refine_normals || found.arrangement.sure || found.texels < few_texels) return found;
  const TexelSample pieces = sample_in_pieces(stack);
  const auto other =
      arrangement_of_normals(pieces, fit_sample(pieces, refined), lamps_of(stack.stack()));
  if (other.sure)
    found.arrangement = other;
  else
    found.arrangement.azimuth = std::max(found.arrangement.azimuth, other.azimuth);
  return found;
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
    lines.push_back(fmt::format("it may be that {}: so read, the {} is {} times less (then {})",
                                a.what, a.measure, times(a.ratio), fmt::join(a.cure, "; ")));
  if (const auto& t = s.tone) {
    const std::string less = fmt::format("an rms {} times less is left then", times(t->ratio));
    if (t->power != 1)
      lines.push_back(
          fmt::format("the photographs seem not to be linear: read with a power of {:.2g}, "
                      "{}. Develop them without a tone curve, and make the stack again",
                      t->power, less));
    else if (t->shadows)
      lines.push_back(
          fmt::format("dark values seem to be cast shadows that a little light reaches: without "
                      "them {}. Leave them out by --floor",
                      less));
    else if (t->room > 0)
      lines.push_back(
          fmt::format("the photographs seem to hold light of the room, about {:.0f} % of "
                      "what they have on average: {}. Subtract a photograph taken with all "
                      "lamps off from each, see that they are linear, and leave out cast "
                      "shadows by --floor",
                      100 * t->room, less));
    else
      lines.push_back(
          fmt::format("the photographs seem to be too bright, by a factor of {:.2g}: {}. "
                      "See that --white is the number of a white tile that faces a lamp",
                      1 / t->scale, less));
  }
  if (const bool is_said = s.tone && s.tone->scale != 1; !is_said && s.too_bright > 0.5)
    lines.push_back(
        fmt::format("{:.0f} % of the texels reflect more than a dielectric can, f0 above "
                    "0.3 beside kd, or more than all light. See that --white is the number "
                    "of a white tile that faces a lamp, and that the photographs are linear",
                    100 * s.too_bright));
  if (s.seeks_normals)
    lines.push_back(
        fmt::format("the surface is not flat, or its normals are others: with --refine-normals the "
                    "images that fits have not seen leave an rms {} times less",
                    times(s.better_ratio)));
  else if (!s.better.empty() && !s.tone)
    lines.push_back(
        fmt::format("{} does not fit: in images that fits have not seen, {} leaves an rms {} times "
                    "less. See first "
                    "that the photographs are linear and hold no light of the room",
                    model, s.better, times(s.better_ratio)));
  for (const auto& odd : s.odd)
    lines.push_back(fmt::format(
        "{} does not agree with the other images, which leave an rms {} times less "
        "without it: {}. Its lamp, direction or place is another, or the model does not fit there",
        stack.images[odd.image].path, times(odd.ratio),
        odd.brightness > 0.95 && odd.brightness < 1.05
            ? "as bright as they predict, so it may have moved"
            : fmt::format("it is {:.2g} times as bright as they predict", odd.brightness)));
  if (const auto& e = s.exposure) {
    std::vector<std::string> names;
    for (const std::size_t i : e->images) names.push_back(stack.images[i].path);
    lines.push_back(
        fmt::format("{} of the {} images {} {:.3g} times as bright as the others predict: {}. So "
                    "scaled, the images leave an rms {} times less (then the scale there "
                    "becomes {:.3g} times what it is, unless the others are wrong)",
                    names.size(), stack.images.size(), names.size() > 1 ? "are all" : "is",
                    e->brightness, fmt::join(names, ", "), times(e->ratio), 1 / e->brightness));
  }
  if (const auto& e = s.exchanged)
    lines.push_back(fmt::format(
        "{} and {} stand for each other: exchanged, the images leave an rms {} times less",
        stack.images[e->first].path, stack.images[e->second].path, times(e->ratio)));
  if (s.shared > 0 && s.odd.empty() && !s.exposure && !s.exchanged && !s.tone) {
    lines.push_back(
        fmt::format("{:.0f} % of what {} leaves is alike in neighbouring texels, so it is no "
                    "noise. See first that "
                    "the photographs are linear and without light of the room, then to exposures, "
                    "lamps and their "
                    "order; else the model is wrong",
                    100 * s.shared, s.better.empty() ? model : s.better));
  }
  if (s.shared > 0 && s.without_normals)
    lines.push_back(
        "an anisotropic model takes the surface for flat, as the stack has no normals: if it is "
        "not, "
        "widths and tangents are others. Give \"normals\" in the stack, as those that an isotropic "
        "model finds with --refine-normals");
  return lines;
}

}  // namespace gonio
