#include "table/format/in_memory.h"

#include <cmath>
#include <limits>
#include <set>

#include "base/error.h"
#include "base/sha256.h"
#include "table/format/csv.h"

#include <fmt/format.h>

namespace gonio {
namespace {

void expect_within(const std::string& name,
                   const char* column,
                   std::span<const double> all,
                   double low,
                   double high,
                   const std::string& expected) {
  for (std::size_t i = 0; i < all.size(); ++i)
    if (!(all[i] >= low && all[i] <= high))
      throw bad_input(name, fmt::format("{}[{}]", column, i), fmt::format("{}", all[i]), expected);
}

std::string_view bytes_of(std::span<const double> column) {
  return {reinterpret_cast<const char*>(column.data()), column.size_bytes()};
}

void check_channels(const std::string& name, const std::vector<std::string>& channels) {
  std::set<std::string> seen;
  for (const auto& c : channels)
    if (!seen.insert(c).second)
      throw bad_input(name, "channels", "a second channel named " + c, "one");
}

}  // namespace

DirectionColumns columns_of(const DirectionList& l) {
  return {l.theta_i_deg, l.phi_i_deg, l.theta_o_deg, l.phi_o_deg};
}

std::array<double, 4> angles_deg(const Table& t, const SampleAngles& at, std::size_t i) {
  if (const auto* l = t.list())
    return {l->theta_i_deg[i], l->phi_i_deg[i], l->theta_o_deg[i], l->phi_o_deg[i]};
  const auto [wi, wo] = at.directions(i);
  return {theta_of(wi) / degree, phi_of(wi) / degree, theta_of(wo) / degree, phi_of(wo) / degree};
}

void check_directions(const std::string& name, const DirectionColumns& at) {
  const std::string zenith = "a number in [0, 180] degrees",
                    azimuth = "a number in [-360, 360] degrees";
  expect_within(name, "theta_i", at.theta_i, 0, 180, zenith);
  expect_within(name, "phi_i", at.phi_i, -360, 360, azimuth);
  expect_within(name, "theta_o", at.theta_o, 0, 180, zenith);
  expect_within(name, "phi_o", at.phi_o, -360, 360, azimuth);
}

std::vector<std::string> usual_channels(std::size_t count) {
  if (count == 1) return {"f"};
  if (count == 3) return {"r", "g", "b"};
  std::vector<std::string> names;
  for (std::size_t c = 0; c < count; ++c) names.push_back(std::to_string(c));
  return names;
}

Table table_of(const std::string& name,
               const DirectionColumns& at,
               std::span<const std::span<const double>> values,
               std::vector<std::string> channels,
               std::span<const double> weights) {
  if (at.size() == 0) throw bad_input(name, "theta_i", "no samples", "at least one");
  if (values.empty() || values.size() > most_channels)
    throw bad_input(name, "values", fmt::format("{} channels", values.size()),
                    fmt::format("1 to {}", most_channels));
  if (at.size() > most_values / (values.size() + 4))
    throw bad_input(name, "values",
                    fmt::format("{} samples of {} channels", at.size(), values.size()),
                    fmt::format("at most {} numbers, directions included", most_values));
  if (channels.empty()) channels = usual_channels(values.size());
  check_channels(name, channels);
  check_directions(name, at);
  expect_within(name, "weights", weights, 0, std::numeric_limits<double>::max(),
                "a number from 0 on");
  const auto copy = [](std::span<const double> c) {
    return std::vector<double>(c.begin(), c.end());
  };
  Table t;
  t.path = name;
  t.format = "csv";
  t.channels = std::move(channels);
  t.where = DirectionList{copy(at.theta_i), copy(at.phi_i), copy(at.theta_o), copy(at.phi_o)};
  for (const auto& column : values) t.values.emplace_back(column.begin(), column.end());
  t.weights = copy(weights);
  expect_light_from_above(name, *t.list());
  warn_of_directions(t);
  std::string bytes;
  for (const auto& c : {at.theta_i, at.phi_i, at.theta_o, at.phi_o}) bytes += bytes_of(c);
  for (const auto& c : values) bytes += bytes_of(c);
  bytes += bytes_of(weights);
  t.sha256 = sha256(bytes);
  return t;
}

}  // namespace gonio
