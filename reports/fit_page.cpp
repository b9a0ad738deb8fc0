#include "reports/fit_page.h"

#include <cmath>
#include <cstdlib>

#include "reports/assets.h"
#include "reports/page.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

using Json = nlohmann::ordered_json;

/// Six digits: more than a curve shows, a third of the bytes.
Json number(double v) {
  if (!std::isfinite(v)) return nullptr;
  return std::strtod(fmt::format("{:.6g}", v).c_str(), nullptr);
}

Json numbers(const std::vector<double>& v) {
  Json out = Json::array();
  for (const double x : v) out.push_back(number(x));
  return out;
}

Json numbers(const std::vector<std::vector<double>>& v) {
  Json out = Json::array();
  for (const auto& row : v) out.push_back(numbers(row));
  return out;
}

Json json(const Cut& c) {
  return {{"at", c.at},
          {"at_deg", number(c.at_deg)},
          {"within_deg", number(c.within_deg)},
          {"along", c.along},
          {"deg", numbers(c.deg)},
          {"data", numbers(c.data)},
          {"model", numbers(c.model)}};
}

Json json(const ResidualMap& m) {
  return {{"theta_h_deg", numbers(m.theta_h_deg)},
          {"theta_d_deg", numbers(m.theta_d_deg)},
          {"mean", numbers(m.mean)},
          {"rms", numbers(m.rms)},
          {"count", m.count}};
}

}  // namespace

FitPage make_fit_page(const Table& table, const BoundModel& fitted) {
  return {table.channels, make_cuts(table, fitted), make_residual_map(table, fitted)};
}

std::string to_json(const FitPage& page, std::string_view fit_json, std::string_view health_json) {
  Json curves = Json::array();
  for (const Cut& c : page.curves) curves.push_back(json(c));
  const Json all{{"fit", Json::parse(fit_json)},
                 {"health", Json::parse(health_json)},
                 {"channels", page.channels},
                 {"curves", curves},
                 {"residual_map", json(page.residual_map)}};
  return all.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string fit_page_html(std::string_view title, std::string_view data) {
  return make_page(title, data, assets::fit_js);
}

}  // namespace gonio
