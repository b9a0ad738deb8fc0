#include "table/format/as_one.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "base/error.h"
#include "base/quantile.h"
#include "base/sha256.h"
#include "table/format/in_memory.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {
namespace {

/// Values of earlier files by direction, the surface taken to be isotropic.
class EarlierFiles {
 public:
  /// Compares a file's samples with those before, then adds them.
  /// \returns the logarithms of the file's values over the earlier ones
  std::vector<double> compare_and_add(const Table& t) {
    std::vector<double> ratios;
    std::vector<std::pair<Key, double>> own;
    const SampleAngles at(t);
    for (std::size_t i = 0; i < t.size(); ++i) {
      const auto key = key_of(angles_deg(t, at, i));
      double sum = 0;
      std::size_t count = 0;
      for (const auto& plane : t.values)
        if (mask(at(i), plane[i]) == Mask::valid && plane[i] > 0)
          sum += std::log(plane[i]), ++count;
      if (count < t.values.size()) continue;
      const double mean = sum / static_cast<double>(count);
      if (const auto earlier = means_.find(key); earlier != means_.end())
        ratios.push_back(mean -
                         earlier->second.first / static_cast<double>(earlier->second.second));
      own.emplace_back(key, mean);
    }
    for (const auto& [key, mean] : own) {
      auto& [sum, count] = means_[key];
      sum += mean;
      ++count;
    }
    return ratios;
  }

 private:
  using Key = std::array<long, 3>;  // [0.05°]
  static Key key_of(const std::array<double, 4>& deg) {
    const auto part = [](double x) { return std::lround(x * 20); };
    const bool turned = deg[0] > 0 && deg[2] > 0;  // at the normal azimuths mean nothing
    return {part(deg[0]), part(deg[2]),
            turned ? part(std::abs(std::remainder(deg[3] - deg[1], 360))) : 0};
  }
  std::map<Key, std::pair<double, std::size_t>> means_;
};

/// Standard error of a median by the median deviation, as of a normal distribution.
double error_of_median(const std::vector<double>& x, double median_of_x) {
  std::vector<double> off;
  for (const double v : x) off.push_back(std::abs(v - median_of_x));
  return 1.4826 * median(off) * std::sqrt(std::numbers::pi / 2 / static_cast<double>(x.size()));
}

std::string in_words(const Aperture& a) {
  return a ? fmt::format("{:.4g}°, {:.4g}°", a.light / degree, a.detector / degree) : "none";
}

}  // namespace

Table read_as_one(const std::vector<std::string>& paths, std::optional<Bins> bins) {
  Table all;
  DirectionList l;
  EarlierFiles earlier;
  std::string digests;
  std::vector<std::string> agreement;
  bool same_truth = true;
  for (const auto& path : paths) {
    TableAndDigest file(path, bins);
    const Table& t = file.table;
    const bool first = all.path.empty();
    if (first) {
      all.channels = t.channels;
      all.format = t.format;
      all.truth = t.truth;
      all.values.resize(t.values.size());
      all.errors.resize(t.errors.size());
      all.aperture = t.aperture;
    } else if (t.channels != all.channels) {
      throw bad_input(path, "channels", fmt::format("{}", fmt::join(t.channels, " ")),
                      fmt::format("{}, as {} has", fmt::join(all.channels, " "), paths.front()));
    }
    if (t.errors.empty() != all.errors.empty())
      throw bad_input(path, "uncertainties", t.errors.empty() ? "none" : "some",
                      fmt::format("as {} has", paths.front()));
    if (t.aperture != all.aperture)
      throw bad_input(path, "aperture", in_words(t.aperture),
                      fmt::format("{}, as {} has", in_words(all.aperture), paths.front()));
    same_truth = same_truth && t.truth && all.truth && t.truth->model == all.truth->model &&
                 t.truth->parameters == all.truth->parameters;
    auto ratios = earlier.compare_and_add(t);
    if (!ratios.empty()) {
      const double typical = median(ratios), error = error_of_median(ratios, typical);
      const std::string said =
          fmt::format("{} is {:.4g} × the files before it, at {} shared directions", path,
                      std::exp(typical), ratios.size());
      constexpr double close = 0.05;
      if (std::abs(typical) > std::max(close, 3 * error))
        all.warnings.push_back(said + ": their scales differ");
      agreement.push_back(said);
    }
    if ((l.theta_i_deg.size() + t.size()) * (4 + t.values.size()) > most_values)
      throw bad_input(path, "joining", "more samples",
                      fmt::format("at most {} numbers, directions included", most_values));
    const SampleAngles at(t);
    for (std::size_t i = 0; i < t.size(); ++i) {
      const auto deg = angles_deg(t, at, i);
      const auto a = at(i);
      if (t.grid() && !(a.nol > horizon_cosine && a.nov > horizon_cosine)) continue;
      l.theta_i_deg.push_back(deg[0]);
      l.phi_i_deg.push_back(deg[1]);
      l.theta_o_deg.push_back(deg[2]);
      l.phi_o_deg.push_back(deg[3]);
      for (std::size_t c = 0; c < t.values.size(); ++c)
        all.values[c].push_back(t.values[c][i] < 0 && !t.negative_is_noise
                                    ? std::numeric_limits<double>::quiet_NaN()
                                    : t.values[c][i]);
      for (std::size_t c = 0; c < t.errors.size(); ++c) all.errors[c].push_back(t.errors[c][i]);
      if (!t.weights.empty()) all.weights.resize(l.theta_i_deg.size() - 1, 1);
      if (!t.weights.empty() || !all.weights.empty())
        all.weights.push_back(t.weights.empty() ? 1 : t.weights[i]);
    }
    file.finish();
    digests += t.sha256 + "\n";
    for (const auto& w : t.warnings) all.warnings.push_back(path + ": " + w);
    all.path += (first ? "" : ", ") + path;
    if (t.format != all.format) all.format = "csv";
    all.patch_deg = std::max(all.patch_deg, t.patch_deg);
  }
  if (!same_truth) all.truth.reset();
  all.where = std::move(l);
  all.sha256 = sha256(digests);
  all.notes.emplace_back("agreement", agreement.empty()
                                          ? "no direction stands in two files"
                                          : fmt::format("{}", fmt::join(agreement, "; ")));
  return all;
}

TableAndDigest read_files(const std::vector<std::string>& paths, std::optional<Bins> bins) {
  return paths.size() == 1 ? TableAndDigest(paths[0], bins)
                           : TableAndDigest(read_as_one(paths, bins));
}

}  // namespace gonio
