#pragma once
/// \file
/// Small tables, and what a fit of many leaves.

#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "support.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gonio::test {

/// What lambert gives from this: kd = π √(a b).
inline std::string diffuse(double a, double b) {
  std::string csv = "theta_i,phi_i,theta_o,phi_o,f\n";
  for (int i = 0; i < 80; i += 10) csv += fmt::format("{},0,30,180,{}\n", i, i % 20 ? a : b);
  return csv;
}

/// A small table of a glossy material, and what it takes to be unlike the others.
inline std::string glossy(double tilt) {
  std::string csv = "theta_i,phi_i,theta_o,phi_o,f\n";
  for (int i = 5; i < 80; i += 15)
    for (int o = -75; o <= 75; o += 5)
      csv += fmt::format("{},0,{},{},{}\n", i, std::abs(o), o < 0 ? 0 : 180,
                         0.1 + 2 / (1 + tilt * (o - i) * (o - i)));
  return csv;
}

/// Document of a fit less its times.
inline nlohmann::json document(const std::string& path) {
  nlohmann::json d = nlohmann::json::parse(read_bytes(path));
  if (d.contains("solver")) d["solver"].erase("time_ms");
  return d;
}

inline std::set<std::string> names_in(const std::string& folder) {
  std::set<std::string> names;
  for (const auto& e : std::filesystem::directory_iterator(folder))
    names.insert(e.path().filename().string());
  return names;
}

/// One line of the tables' list in the batch's JSON, by path.
inline std::map<std::string, nlohmann::json> by_path(const nlohmann::json& batch) {
  std::map<std::string, nlohmann::json> all;
  for (const auto& t : batch["tables"]) all[t["path"].get<std::string>()] = t;
  return all;
}

/// Writes `in/g0.csv` and so on, every one another, and `list` with their paths; returns these.
inline std::vector<std::string> write_tables(const Folder& f, int n) {
  std::filesystem::create_directory(f / "in");
  std::vector<std::string> paths;
  std::string list;
  for (int i = 0; i < n; ++i) {
    paths.push_back(fmt::format("in/g{}.csv", i));
    f.write(paths.back(), glossy(0.001 + 0.01 * i));
    list += paths.back() + "\n";
  }
  f.write("list", list);
  return paths;
}

/// Bytes of a fit's document, the lines with its times left out.
inline std::string bytes_but_times(const std::string& path) {
  std::string out, line;
  std::istringstream in(read_bytes(path));
  while (std::getline(in, line))
    if (line.find("_ms\": ") == line.npos) out += line + "\n";
  return out;
}

/// Both folders have the documents of these tables, equal to the byte but for their times.
inline void expect_same_documents(const std::string& folder, const std::string& other, int tables) {
  for (int i = 0; i < tables; ++i) {
    const std::string name = fmt::format("/g{}.json", i), bytes = bytes_but_times(folder + name);
    EXPECT_NE(bytes, "") << folder << name;
    EXPECT_EQ(bytes, bytes_but_times(other + name)) << name;
  }
}

}  // namespace gonio::test
