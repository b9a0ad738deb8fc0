#include "fitting/export/export.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "base/error.h"
#include "base/json/describe.h"
#include "brdf/formula/scattering.h"
#include "brdf/model/evaluate.h"
#include "brdf/model/own_files.h"
#include "fitting/export/surface.h"
#include "fitting/export/target.h"
#include "geometry/half_difference.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {

template <>
inline constexpr auto description<ExportPlace> =
    FieldList{Field{"theta_i", "°", &ExportPlace::theta_i, "of the light"},
              Field{"phi_i", "°", &ExportPlace::phi_i, "in (−180, 180]"},
              Field{"theta_o", "°", &ExportPlace::theta_o, "of the view"},
              Field{"phi_o", "°", &ExportPlace::phi_o, "in (−180, 180]"}};
template <>
inline constexpr auto description<ExportResidual> =
    FieldList{Field{"rms", &ExportResidual::rms, "root mean square of the relative distance"},
              Field{"largest", &ExportResidual::largest, "largest relative distance"},
              Field{"largest_at", &ExportResidual::largest_at, "where that is"}};
static_assert(describes_every_member<ExportResidual>());
template <>
inline constexpr auto description<ExportVariant> =
    FieldList{Field{"variant", &ExportVariant::variant, "as the target names it"},
              Field{"residual", &ExportVariant::residual, "of what was written, computed so"}};

template <>
inline constexpr auto description<Export> = FieldList{
    constant_text("schema", "gonio.export/1"),
    Field{"target", &Export::target, "format that was written"},
    Field{"fit", &Export::fit, "path of the fit"},
    Field{"model", &Export::model, "spec of the fit"},
    Field{"parameters", per_name(&Export::parameters), "of the target, by its names"},
    Field{"misfit", &Export::misfit,
          "typical factor of the fit from its table; null: its document has none"},
    Field{"tolerance", &Export::tolerance, "of the root mean square"},
    Field{"renamed", &Export::renamed, "residual of parameters that are only renamed"},
    Field{"written", &Export::written, "residual of the parameters that were written"},
    Field{"variants", &Export::variants, "ways in which the target computes what was written"},
    Field{"preview", &Export::preview, "whether the file has a sphere to show the material on"},
    Field{"refitted", &Export::refitted, "whether these were fitted in the target's model"},
    Field{"lost", &Export::lost, "what the target cannot express"},
    Field{"clamped", &Export::clamped, "what was outside the target's range"},
    Field{own_files_key, if_there([](const Export& e) { return own_files({e.model}); }),
          own_files_meaning}};
static_assert(describes_every_member<Export>());

namespace {

constexpr double most_zenith = 88;  ///< of light and view [°]

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
    const double in = most_zenith * u;
    const bool near = i % 2 == 1;
    const double a = 2 * v - 1, b = 2 * w - 1;
    const double out = near ? std::clamp(in + 40 * a * a * a, 0.0, most_zenith) : most_zenith * v;
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

ExportPlace place_of(const DirectionPair& d) {
  const auto zenith = [](const Direction& w) { return std::acos(std::min(w.z, 1.0)) / degree; };
  const auto azimuth = [](const Direction& w) { return std::atan2(w.y, w.x) / degree; };
  return {zenith(d.wi), azimuth(d.wi), zenith(d.wo), azimuth(d.wo)};
}

ExportResidual residual(const std::vector<std::vector<double>>& target,
                        const std::vector<std::vector<double>>& fit,
                        const std::vector<std::vector<double>>& scale) {
  ExportResidual r;
  double sum = 0;
  std::size_t worst = 0;
  for (std::size_t c = 0; c < fit.size(); ++c)
    for (std::size_t i = 0; i < export_directions; ++i) {
      const double d = std::abs(target[c][i] - fit[c][i]) / scale[c][i];
      sum += d * d;
      if (d > r.largest) r.largest = d, worst = i;
    }
  r.rms = std::sqrt(sum / static_cast<double>(export_directions * fit.size()));
  r.largest_at = place_of(judged_directions()[worst]);
  return r;
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

std::vector<std::vector<double>> scale_of(std::vector<std::vector<double>> f,
                                          const Surface& surface) {
  for (std::size_t c = 0; c < f.size(); ++c) {
    double albedo = surface.kd[c];
    for (const auto& l : surface.lobes) albedo += l.weight * schlick_average(l.f0[c]);
    const double least = std::max(albedo / std::numbers::pi, std::numeric_limits<double>::min());
    for (double& x : f[c]) x = std::max(x, least);
  }
  return f;
}

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
  const auto scale = scale_of(wanted, surface), learned_scale = scale_of(learned, surface);
  Export best{to, path, to_text(fit.model.spec), {}, {}, tolerance};
  bool first = true;
  for (auto& form : target.forms(surface)) {
    Export e{to, path, to_text(fit.model.spec), {}, {}, tolerance};
    e.lost = target.lost(fit, surface, form.parameters);
    e.clamped = clamp(form.parameters);
    auto p = form.parameters;
    e.renamed = e.written = residual(form.values(p, judged), wanted, scale);
    if (e.renamed.rms > tolerance) {
      auto q = refitted(p, form.values, fitted, learned, learned_scale);
      if (const auto r = residual(form.values(q, judged), wanted, scale); r.rms < e.renamed.rms)
        p = std::move(q), e.written = r, e.refitted = true;
    }
    if (first || e.written.rms < best.written.rms) {
      for (const auto& x : p) e.parameters.emplace_back(x.name, x.values);
      for (const auto& [name, values] : form.variants)
        e.variants.push_back({name, residual(values(p, judged), wanted, scale)});
      constexpr double alike = 1e-6;  // of a grey index, which every variant reads alike
      if (std::ranges::all_of(e.variants, [&](const auto& v) {
            return std::abs(v.residual.largest - e.written.largest) < alike &&
                   std::abs(v.residual.rms - e.written.rms) < alike;
          }))
        e.variants.clear();
      best = std::move(e);
    }
    first = false;
    if (best.written.rms <= tolerance) break;
  }
  return best;
}

bool can_preview(ExportTarget t) {
  return t == ExportTarget::gltf;
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
