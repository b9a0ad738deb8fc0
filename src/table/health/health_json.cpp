#include "base/json_reader.h"
#include "table/format/metadata.h"
#include "table/health/health.h"

namespace gonio {

std::string to_json(const Table& t, const Health& h) {
  Json masked = Json::object();
  for (std::size_t m = 1; m < h.masked.size(); ++m) masked[names_of<Mask>[m]] = h.masked[m];
  Json albedo = Json::array();
  for (const auto& a : h.albedo)
    albedo.push_back(Json{{"theta_i_deg", a.theta_i_deg},
                          {"albedo", per_channel(a.albedo)},
                          {"coverage", a.coverage}});
  Json peak;
  if (h.peak)
    peak = {{"half_width_deg", h.peak->half_width_deg},
            {"alpha", h.peak->alpha},
            {"samples_within", h.peak->samples_within},
            {"resolved", h.peak->resolved},
            {"height", h.peak->height},
            {"base", h.peak->base},
            {"limit", name_of(h.peak->limit)},
            {"in_words", peak_in_words(*h.peak)}};
  Json retro;
  if (h.retro)
    retro = {{"half_width_deg", h.retro->half_width_deg},
             {"height", h.retro->height},
             {"base", h.retro->base}};
  const auto bands = [](const std::vector<NoiseBand>& all, const std::string& unit) {
    Json out = Json::array();
    for (const auto& b : all)
      out.push_back(
          {{"from" + unit, b.from}, {"to" + unit, b.to}, {"values", b.values}, {"sigma", b.sigma}});
    return out;
  };
  Json prospects = Json::array();
  for (const auto& p : h.prospects)
    prospects.push_back({{"of", p.of}, {"verdict", name_of(p.verdict)}, {"because", p.because}});
  auto warnings = t.warnings;
  warnings.insert(warnings.end(), h.warnings.begin(), h.warnings.end());
  const auto number_or_null = [](const std::optional<double>& v) { return v ? Json(*v) : Json(); };
  return text_of({{"path", t.path},
                  {"format", t.format},
                  {"layout", layout_text(t)},
                  {"channels", t.channels},
                  {"samples", h.samples},
                  {"values", h.values},
                  {"valid", h.valid},
                  {"masked", masked},
                  {"bins", t.has_bins() ? name_of(t.grid()->bins) : "none"},
                  {"bin_sensitivity", h.peak ? number_or_null(h.peak->bin_sensitivity) : Json()},
                  {"noise_floor", h.noise_floor},
                  {"copied_rows", h.copied_rows},
                  {"copied_columns", h.copied_columns},
                  {"largest", h.largest},
                  {"smallest_positive", h.smallest_positive},
                  {"albedo", albedo},
                  {"reciprocity_error", number_or_null(h.reciprocity_error)},
                  {"reciprocity_note", h.reciprocity_note},
                  {"noise",
                   {{"sigma", number_or_null(h.noise.sigma)},
                    {"bound", h.noise.bound},
                    {"along", h.noise.along},
                    {"channels", per_channel(h.noise.channels)},
                    {"over_zenith", bands(h.noise.over_angle, "_deg")},
                    {"over_value", bands(h.noise.over_value, "")}}},
                  {"peak", peak},
                  {"warnings", warnings},
                  {"peak_profiles", h.peak_profiles},
                  {"peak_contrast", h.peak_contrast},
                  {"retro", retro},
                  {"prospects", prospects},
                  {"truth", t.truth ? truth_json(*t.truth) : Json()}});
}

}  // namespace gonio
