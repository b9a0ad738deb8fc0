#include "table/health.h"
#include "table/json_reader.h"

namespace gonio {

std::string to_json(const Table& t, const Health& h) {
  Json masked = Json::object();
  for (std::size_t m = 1; m < h.masked.size(); ++m) masked[mask_names[m]] = h.masked[m];
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
            {"base", h.peak->base}};
  const auto number_or_null = [](const std::optional<double>& v) { return v ? Json(*v) : Json(); };
  return text_of(
      {{"path", t.path},
       {"format", t.format},
       {"channels", t.channels},
       {"samples", h.samples},
       {"values", h.values},
       {"valid", h.valid},
       {"masked", masked},
       {"bins", t.has_bins() ? bins_names[static_cast<std::size_t>(t.grid()->bins)] : "none"},
       {"bin_sensitivity", number_or_null(h.bin_sensitivity)},
       {"noise_floor", h.noise_floor},
       {"copied_rows", h.copied_rows},
       {"largest", h.largest},
       {"smallest_positive", h.smallest_positive},
       {"albedo", albedo},
       {"reciprocity_error", number_or_null(h.reciprocity_error)},
       {"reciprocity_note", h.reciprocity_note},
       {"peak", peak},
       {"warnings", t.warnings},
       {"truth", t.truth ? truth_json(*t.truth) : Json()}});
}

}  // namespace gonio
