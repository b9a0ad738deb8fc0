#include "fitting/export/export.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/json_describe.h"
#include "brdf/model/evaluate.h"
#include "brdf/model/presets.h"
#include "brdf/model/reflectances.h"
#include "fitting/fit.h"

#include <fmt/format.h>

namespace gonio {

template <>
struct Description<ExportResidual> {
  static constexpr auto fields() {
    return std::tuple{
        field("rms", "", &ExportResidual::rms, "root mean square of the relative distance"),
        field("largest", "", &ExportResidual::largest, "largest relative distance")};
  }
};
static_assert(describes_every_member<ExportResidual>());

template <>
struct Description<Export> {
  static constexpr auto fields() {
    return std::tuple{
        constant_text("schema", "gonio.export/1"),
        field("target", "", &Export::target, "format that was written"),
        field("fit", "", &Export::fit, "path of the fit"),
        field("model", "", &Export::model, "spec of the fit"),
        field("parameters", "", per_name(&Export::parameters), "of the target, by its names"),
        field("tolerance", "", &Export::tolerance, "of the root mean square"),
        field("renamed", "", &Export::renamed, "residual of parameters that are only renamed"),
        field("written", "", &Export::written, "residual of the parameters that were written"),
        field("refitted", "", &Export::refitted, "whether these were fitted in the target's model"),
        field("lost", "", &Export::lost, "what the target cannot express")};
  }
};
static_assert(describes_every_member<Export>());

namespace {

/// Directions that are the same for every export: one half anywhere, the other around the mirror's.
/// \param first  of the sequence; other ones where this is further than export_directions away
Table fixed_directions(const std::vector<std::string>& channels, std::size_t first) {
  Table t;
  t.path = "directions of the export", t.format = "csv", t.channels = channels;
  DirectionList l;
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
    l.theta_i_deg.push_back(in);
    l.phi_i_deg.push_back(0);
    l.theta_o_deg.push_back(near ? std::clamp(in + 40 * a * a * a, 0.0, 80.0) : 80 * v);
    l.phi_o_deg.push_back(near ? 180 + 60 * b * b * b : 360 * w);
  }
  t.where = std::move(l);
  return t;
}

std::vector<std::vector<double>> values_of(const BoundModel& b, const Table& at) {
  Table one = at;
  one.values.assign(1, Values(export_directions));
  const SampleAngles of(one);
  std::vector<FrameAngles<double>> angles;
  for (std::size_t i = 0; i < export_directions; ++i) angles.push_back(of.frame(i));
  return evaluate(b, angles);
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

using Parameters = std::vector<std::pair<std::string, std::vector<double>>>;
const std::vector<double>* find(const Parameters& all, std::string_view name) {
  const auto it = std::ranges::find(all, name, &Parameters::value_type::first);
  return it == all.end() ? nullptr : &it->second;
}

/// Names of glTF in place of the fit's.
Parameters renamed(const BoundModel& fit) {
  const auto own = named_values(fit), plain = named_values(in_reflectances(fit));
  const std::size_t n = fit.model.channels;
  const auto per_channel = [&](const std::vector<double>* v, std::size_t c) {
    return v ? (*v)[v->size() > 1 ? c : 0] : 0;
  };
  const auto *kd = find(plain, "kd"), *f0 = find(plain, "f0"), *eta = find(plain, "eta"),
             *k = find(plain, "k");
  double diffuse = 0, specular = 0;
  std::vector<double> color, reflected;
  for (std::size_t c = 0; c < n; ++c) {
    double r = per_channel(f0, c);
    if (eta) {
      const double m = per_channel(eta, c), x = per_channel(k, c);
      r = ((m - 1) * (m - 1) + x * x) / ((m + 1) * (m + 1) + x * x);
    }
    reflected.push_back(r), color.push_back(per_channel(kd, c));
    diffuse += color.back(), specular += r;
  }
  double metallic = specular > diffuse ? 1 : 0;
  if (metallic == 1) color = reflected;
  if (const auto* b = find(own, "base_color"), *m = find(own, "metallic"); b && m)
    color = *b, metallic = (*m)[0];
  double alpha = 1;
  if (const auto* a = find(plain, "alpha")) alpha = (*a)[0];
  if (const auto* x = find(plain, "alpha_x"), *y = find(plain, "alpha_y"); x && y)
    alpha = std::sqrt((*x)[0] * (*y)[0]);
  return {{"base_color", color}, {"metallic", {metallic}}, {"roughness", {std::sqrt(alpha)}}};
}

BoundModel bound(const Parameters& p, std::size_t channels) {
  std::vector<Setting> settings;
  for (const auto& [name, values] : p) settings.push_back({name, values});
  return bind_model("gltf", settings, channels);
}

std::vector<std::string> lost_in_gltf(const BoundModel& fit) {
  std::vector<std::string> lost;
  const auto plain = named_values(fit);
  const auto has = [&](std::string_view name) { return find(plain, name) != nullptr; };
  if (fit.model.lobes.size() > 1) lost.push_back("A second lobe: glTF has one.");
  if (fit.model.lobes.empty()) lost.push_back("A surface without a highlight: glTF reflects 4 %.");
  if (fit.model.anisotropic)
    lost.push_back("Anisotropy: glTF's material without extensions has one roughness.");
  if (has("gamma")) lost.push_back("The exponent of the distribution: glTF's is 2.");
  if (has("eta") || has("f82") || has("f90"))
    lost.push_back("The Fresnel curve: glTF has Schlick's, which ends at 1.");
  return lost;
}

}  // namespace

Export export_fit(const std::string& path, const BoundModel& fit, double tolerance) {
  const std::size_t n = fit.model.channels;
  if (n != 1 && n != 3)
    throw bad_input(path, "channels", fmt::to_string(n), "1, or 3: red, green and blue");
  Export e{ExportTarget::gltf, path, fit.model.spec, {}, tolerance};
  const std::vector<std::string> channels =
      n == 3 ? std::vector<std::string>{"r", "g", "b"} : std::vector<std::string>{"f"};
  const Table judged = fixed_directions(channels, 0);
  const auto wanted = values_of(fit, judged);
  e.lost = lost_in_gltf(fit);
  e.parameters = renamed(fit);
  e.renamed = e.written = residual(values_of(bound(e.parameters, n), judged), wanted);
  if (e.renamed.rms <= tolerance) return e;
  Table t = fixed_directions(channels, export_directions);  // what is fitted does not judge itself
  for (const auto& f : values_of(fit, t)) t.values.emplace_back(f.begin(), f.end());
  FitOptions options;
  options.model = "gltf";
  options.metric = Metric::relative;
  options.intervals = Intervals::independent;
  options.copies = true, options.bin_sensitivity = false;
  const auto fitted = named_values(gonio::fit(t, options).model);
  Parameters p = e.parameters;
  for (auto& [name, values] : p) {
    if (const auto* v = find(fitted, name)) values = *v;
    if (const auto* a = find(fitted, "alpha"); name == "roughness" && a)
      values = {std::sqrt((*a)[0])};
  }
  if (const auto r = residual(values_of(bound(p, n), judged), wanted); r.rms < e.renamed.rms)
    e.parameters = std::move(p), e.written = r, e.refitted = true;
  return e;
}

std::string gltf_of(const Export& e, const std::string& fit) {
  const auto& color = *find(e.parameters, "base_color");
  Json factor = Json::array();
  for (std::size_t c = 0; c < 3; ++c) factor.push_back(color[color.size() == 3 ? c : 0]);
  factor.push_back(1.0);
  const Json material{{"name", "fit"},
                      {"pbrMetallicRoughness",
                       {{"baseColorFactor", factor},
                        {"metallicFactor", (*find(e.parameters, "metallic"))[0]},
                        {"roughnessFactor", (*find(e.parameters, "roughness"))[0]}}},
                      {"extras", {{"gonio", parse_json(e.fit, fit)}}}};
  return text_of(Json{{"asset", {{"version", "2.0"}, {"generator", "gonio"}}},
                      {"materials", Json::array({material})}});
}

std::string to_json(const Export& e) {
  return text_of(json_of(e));
}
std::string export_schema() {
  return schema_text<Export>("Export of a fit");
}

}  // namespace gonio
