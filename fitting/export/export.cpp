#include "fitting/export/export.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "base/error.h"
#include "base/json/describe.h"
#include "brdf/model/evaluate.h"
#include "fitting/export/surface.h"
#include "fitting/export/target.h"
#include "geometry/half_difference.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {

template <>
inline constexpr auto description<ExportResidual> =
    std::tuple{Field{"rms", &ExportResidual::rms, "root mean square of the relative distance"},
               Field{"largest", &ExportResidual::largest, "largest relative distance"}};
static_assert(describes_every_member<ExportResidual>());

template <>
inline constexpr auto description<Export> = std::tuple{
    constant_text("schema", "gonio.export/1"),
    Field{"target", &Export::target, "format that was written"},
    Field{"fit", &Export::fit, "path of the fit"},
    Field{"model", &Export::model, "spec of the fit"},
    Field{"parameters", per_name(&Export::parameters), "of the target, by its names"},
    Field{"tolerance", &Export::tolerance, "of the root mean square"},
    Field{"renamed", &Export::renamed, "residual of parameters that are only renamed"},
    Field{"written", &Export::written, "residual of the parameters that were written"},
    Field{"refitted", &Export::refitted, "whether these were fitted in the target's model"},
    Field{"lost", &Export::lost, "what the target cannot express"},
    Field{"clamped", &Export::clamped, "what was outside the target's range"}};
static_assert(describes_every_member<Export>());

namespace {

/// Directions that are the same for every export: one half anywhere, the other around the mirror's.
/// \param first  of the sequence; other ones where this is further than export_directions away
std::vector<DirectionPair> fixed_directions(std::size_t first) {
  std::vector<DirectionPair> all;
  const auto part = [](double x) { return x - std::floor(x); };
  for (std::size_t i = 0; i < export_directions; ++i) {
    // Additive recurrence of the root of x⁴ = x + 1 [Roberts 2018, "The unreasonable effectiveness
    // of quasirandom sequences"].
    constexpr double g = 1.2207440846057596;
    const double n = static_cast<double>(first + i) + 0.5;
    const double u = part(n / g), v = part(n / (g * g)), w = part(n / (g * g * g));
    const double in = 80 * u;
    const bool near = i % 2 == 1;
    const double a = 2 * v - 1, b = 2 * w - 1;
    const double out = near ? std::clamp(in + 40 * a * a * a, 0.0, 80.0) : 80 * v;
    const double phi = near ? 180 + 60 * b * b * b : 360 * w;
    const double turn = 360 * part(n * std::numbers::phi);  // of both, about the normal
    all.push_back(
        {direction(in * degree, turn * degree), direction(out * degree, (turn + phi) * degree)});
  }
  return all;
}

std::vector<FrameAngles<double>> fixed_angles(std::size_t first) {
  std::vector<FrameAngles<double>> all;
  for (const auto& d : fixed_directions(first)) all.push_back(frame_angles(d));
  return all;
}

ExportResidual residual(const std::vector<std::vector<double>>& target,
                        const std::vector<std::vector<double>>& fit) {
  ExportResidual r;
  double sum = 0;
  for (std::size_t c = 0; c < fit.size(); ++c) {
    double mean = 0;
    for (const double f : fit[c]) mean += f / static_cast<double>(export_directions);
    for (std::size_t i = 0; i < export_directions; ++i) {
      const double scale = std::max(fit[c][i], mean);
      const double d = scale > 0 ? std::abs(target[c][i] - fit[c][i]) / scale : target[c][i];
      sum += d * d;
      r.largest = std::max(r.largest, d);
    }
  }
  r.rms = std::sqrt(sum / static_cast<double>(export_directions * fit.size()));
  return r;
}

/// What a distance is relative to: f, or its mean in that channel where that is larger.
std::vector<std::vector<double>> scale_of(const std::vector<std::vector<double>>& fit) {
  auto scale = fit;
  for (auto& channel : scale) {
    double mean = 0;
    for (const double f : channel) mean += f / static_cast<double>(channel.size());
    for (double& f : channel) f = std::max({f, mean, std::numeric_limits<double>::min()});
  }
  return scale;
}

/// Values within the target's ranges; a sentence of each parameter that was not.
std::vector<std::string> clamp(TargetParameters& all) {
  std::vector<std::string> said;
  for (auto& p : all) {
    const auto before = p.values;
    for (double& v : p.values) v = std::clamp(v, p.legal.low, p.legal.high);
    if (p.values != before)
      said.push_back(fmt::format("{} = {:.4g} is outside [{}, {}].", p.name,
                                 fmt::join(before, ", "), p.legal.low, p.legal.high));
  }
  return said;
}

const Target& target_of(ExportTarget t) {
  switch (t) {
    case ExportTarget::gltf:
      return gltf_target;
    case ExportTarget::mitsuba:
      return mitsuba_target;
    case ExportTarget::standard_surface:
      return standard_surface_target;
    case ExportTarget::open_pbr:
      return open_pbr_target;
    case ExportTarget::usd_preview:
      return usd_preview_target;
  }
  throw std::logic_error("a target without a name");
}

}  // namespace

std::vector<DirectionPair> judged_directions() {
  return fixed_directions(0);
}

Export export_fit(ExportTarget to,
                  const std::string& path,
                  const BoundModel& fit,
                  double tolerance) {
  const std::size_t n = fit.model.channels;
  if (n != 1 && n != 3)
    throw bad_input(path, "channels", fmt::to_string(n), "1, or 3: red, green and blue");
  const Target& target = target_of(to);
  const Surface surface = surface_of(fit);
  const auto judged = fixed_angles(0), fitted = fixed_angles(export_directions);
  const auto wanted = evaluate(fit, judged), learned = evaluate(fit, fitted);
  Export best{to, path, fit.model.spec, {}, tolerance};
  bool first = true;
  for (auto& form : target.forms(surface)) {
    Export e{to, path, fit.model.spec, {}, tolerance};
    e.lost = target.lost(fit, surface, form.parameters);
    e.clamped = clamp(form.parameters);
    auto p = form.parameters;
    e.renamed = e.written = residual(form.values(p, judged), wanted);
    if (e.renamed.rms > tolerance) {
      auto q = refitted(p, form.values, fitted, learned, scale_of(learned));
      if (const auto r = residual(form.values(q, judged), wanted); r.rms < e.renamed.rms)
        p = std::move(q), e.written = r, e.refitted = true;
    }
    if (first || e.written.rms < best.written.rms) {
      for (const auto& x : p) e.parameters.emplace_back(x.name, x.values);
      best = std::move(e);
    }
    first = false;
    if (best.written.rms <= tolerance) break;
  }
  return best;
}

std::string file_of(const Export& e, const std::string& fit) {
  return target_of(e.target).file(e, fit);
}

std::string to_json(const Export& e) {
  return json_text(e);
}
std::string export_schema() {
  return schema_text<Export>("Export of a fit");
}

}  // namespace gonio
