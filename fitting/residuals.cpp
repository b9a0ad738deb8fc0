#include "fitting/residuals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <tbb/parallel_for.h>

namespace gonio {
namespace {

struct Sums {
  std::size_t values = 0, positive = 0;
  double squares = 0, log_squares = 0;

  void add(double difference, double log_ratio, bool both_positive) {
    ++values;
    squares += difference * difference;
    if (both_positive) {
      ++positive;
      log_squares += log_ratio * log_ratio;
    }
  }
  void add(const Sums& s) {
    values += s.values;
    positive += s.positive;
    squares += s.squares;
    log_squares += s.log_squares;
  }
  double rms() const { return values ? std::sqrt(squares / static_cast<double>(values)) : 0; }
  double log_rms() const {
    return positive ? std::sqrt(log_squares / static_cast<double>(positive)) : 0;
  }
};

struct Bands {
  const char* angle;
  const double* Block<double>::*cosine;
  std::vector<double> edges_deg;
};
const std::array<Bands, 3>& bands() {
  static const std::array<Bands, 3> all{
      Bands{"theta_i", &Block<double>::nol, {0, 20, 40, 60, 75, 90}},
      Bands{"theta_h", &Block<double>::noh, {0, 1, 3, 8, 20, 45, 90}},
      Bands{"theta_d", &Block<double>::voh, {0, 20, 40, 60, 75, 90}}};
  return all;
}

}  // namespace

FitResiduals residual_statistics(const BoundModel& b, const FitData& d) {
  struct Part {
    Sums all;
    std::array<std::vector<Sums>, 3> band;
  };
  std::array<std::vector<double>, 3> cosines;
  Part total;
  for (std::size_t k = 0; k < 3; ++k) {
    for (const double e : bands()[k].edges_deg) cosines[k].push_back(std::cos(e * degree));
    total.band[k].resize(bands()[k].edges_deg.size() - 1);
  }

  constexpr std::size_t chunk = 16384;
  const std::size_t padded = d.angles.padded();
  std::vector<Part> parts((padded + chunk - 1) / chunk, total);
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t number) {
    const std::size_t first = number * chunk, n = std::min(chunk, padded - first);
    const auto x = d.angles.block().part(first, n);
    std::vector<Column<double>> f;
    std::vector<double*> out;
    for (std::size_t c = 0; c < d.y.size(); ++c) out.push_back(f.emplace_back(n).data());
    evaluate<double>(b.model, b.values, x, out);
    const auto& k = kernels<double>();
    std::vector<Column<double>> ratio;  // ln f − ln y, times the weight
    Column<double> slope(n);
    alignas(64) std::array<double, padding> cost{};
    const double* const w = d.root_weight.data() + first;
    for (std::size_t c = 0; c < f.size(); ++c) {
      ratio.emplace_back(n);
      k.residual[static_cast<std::size_t>(Metric::log)](
          n, {out[c], d.y[c].data() + first, w, x.nol, 0, std::numeric_limits<double>::max(),
              ratio[c].data(), slope.data(), cost.data()});
    }
    Part& part = parts[number];
    for (std::size_t i = 0; i < n; ++i) {
      if (!(w[i] > 0)) continue;
      Sums sample;
      for (std::size_t c = 0; c < f.size(); ++c) {
        const double y = d.y[c][first + i], model = out[c][i];
        if (y >= 0) sample.add(model - y, ratio[c][i] / w[i], y > 0 && model > 0);
      }
      part.all.add(sample);
      for (std::size_t a = 0; a < 3; ++a) {
        const double cosine = (x.*bands()[a].cosine)[i];
        std::size_t at = 0;
        while (at + 2 < cosines[a].size() && cosine < cosines[a][at + 1]) ++at;
        part.band[a][at].add(sample);
      }
    }
  });
  for (const auto& p : parts) {
    total.all.add(p.all);
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t i = 0; i < p.band[a].size(); ++i) total.band[a][i].add(p.band[a][i]);
  }

  FitResiduals r{total.all.rms(), total.all.log_rms(), {}};
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t i = 0; i < total.band[a].size(); ++i) {
      const auto& e = bands()[a].edges_deg;
      const auto& s = total.band[a][i];
      r.bands.push_back({bands()[a].angle, e[i], e[i + 1], s.values, s.rms(), s.log_rms()});
    }
  return r;
}

}  // namespace gonio
