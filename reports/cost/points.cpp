// Points that are no term: compensation, the split sum, quadrature and the share of a table that a
// fit uses, each by its time and its error.
#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "brdf/catalogue/maps.h"
#include "data_synth/synth.h"
#include "fitting/fit.h"
#include "integrate/light/split_sum_table.h"
#include "reports/cost/cost.h"
#include "reports/energy/energy.h"
#include "reports/finding/names.h"
#include "reports/finding/words.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

namespace gonio {
namespace {

/// Compensations as the energy report measures them.
void add_compensations(std::vector<CostPoint>& to) {
  for (const auto& c : compensation_costs(energy_materials(compensation_domain(), [](double) {})))
    to.push_back({"compensation",
                  c.id == "fdez_aguera" ? "image-based light" : "a light",
                  std::string(c.id),
                  {c.ns, c.spread_ns},
                  c.rms,
                  0,
                  c.operations,
                  c.bytes,
                  {c.without_ns, c.without_spread_ns}});
}

void add_quadrature(std::vector<CostPoint>& to, const EnergyOptions& o) {
  for (const auto& e : estimator_points(o, [](double) {}))
    to.push_back({"quadrature",
                  fmt::format("{}, {}", e.estimator, place(e.roughness, e.mu)),
                  fmt::format("{:g}", e.goal),
                  {e.ns, e.ns_spread},
                  e.error,
                  0});
}

/// A + B, which is E at F0 = 1, by every way that renderers take.
class SplitSumWays {
 public:
  SplitSumWays() {
    for (int i = 1; i <= steps; ++i) at_.push_back(static_cast<double>(i) / steps);
    for (const double r : at_)
      for (const auto& s : split_sum(form_id::smith, r, at_, {1e-9, 4'000'000}))
        truth_.push_back(s.a + s.b);
  }
  /// \param values  of a roughness, at every NoV
  template <class Values>
  void add(std::vector<CostPoint>& to,
           std::string series,
           std::string label,
           Values values,
           std::size_t bytes = 0) {
    double squares = 0;
    for (std::size_t r = 0; r < at_.size(); ++r) {
      const auto& v = values(at_[r]);
      for (std::size_t i = 0; i < at_.size(); ++i)
        squares += std::pow(v[i] - truth_[r * at_.size() + i], 2);
    }
    const auto n = static_cast<double>(truth_.size());
    volatile double kept = 0;
    tbb::task_arena one_thread(1);
    auto t = time_of([&] {
      one_thread.execute([&] {
        for (const double r : at_) kept = values(r).back();
      });
    });
    to.push_back({"split_sum",
                  std::move(series),
                  std::move(label),
                  {t.ns / n, t.spread_ns / n},
                  std::sqrt(squares / n),
                  0,
                  0,
                  bytes});
  }
  /// \param value  of a roughness and NoV
  template <class Value>
  auto each(const Value& value) const {
    return [this, value,
            out = std::vector<double>(at_.size())](double r) mutable -> const std::vector<double>& {
      for (std::size_t i = 0; i < at_.size(); ++i) out[i] = value(r, at_[i]);
      return out;
    };
  }
  const std::vector<double>& nov() const { return at_; }

 private:
  static constexpr int steps = 16;
  std::vector<double> at_, truth_;  ///< [roughness][NoV]
};

void add_split_sum(std::vector<CostPoint>& to) {
  SplitSumWays ways;
  for (const std::size_t size : {8, 16, 32, 64}) {
    const auto table =
        stored(split_sum_table(form_id::smith, size, size, 0, {1e-5}), Storage::half);
    ways.add(to, "bilinear table in half", fmt::format("{0} × {0}", size),
             ways.each([&](double r, double nov) {
               const auto [a, b] = table(nov, r);
               return a + b;
             }),
             size * size * 4);
  }
  ways.add(to, "formula", "gonio's fit", ways.each([](double r, double nov) {
    return mapped<AlbedoFit, double>(r * r, nov)[0];
  }));
  ways.add(to, "formula", "MaterialX's fit", ways.each([](double r, double nov) {
    return mapped<AlbedoFitMaterialx, double>(r * r, nov)[0];
  }));
  const auto sums = [](const std::vector<SplitSum>& all) {
    std::vector<double> out;
    for (const auto& s : all) out.push_back(s.a + s.b);
    return out;
  };
  for (std::size_t n = 16; n <= 4096; n *= 4)
    ways.add(to, "importance sampling", fmt::format("{} samples", n),
             [&](double r) { return sums(sampled_split_sum(form_id::smith, r, ways.nov(), n)); });
  for (int digits = 2; digits <= 7; ++digits)
    ways.add(to, "quadrature", fmt::format("goal 1e-{}", digits), [&](double r) {
      return sums(
          split_sum(form_id::smith, r, ways.nov(), {std::pow(10, -digits), Goal{}.evaluations}));
    });
}

/// Bins of a table chosen by chance, as a list of directions.
Table share_of(const Table& whole,
               const SampleAngles& angles,
               std::size_t bins,
               std::uint64_t seed) {
  Table t = whole;
  DirectionList list;
  for (auto& v : t.values) v.clear();
  Draws draw(seed, bins);
  const double share = static_cast<double>(bins) / static_cast<double>(whole.size());
  for (std::size_t i = 0; i < whole.size(); ++i) {
    if (draw.uniform() > share) continue;
    const auto d = angles.directions(i);
    if (!(d.wi.z > 0 && d.wo.z > 0)) continue;
    const auto zenith = [](const Direction& w) { return std::acos(std::min(w.z, 1.0)) / degree; };
    const auto azimuth = [](const Direction& w) { return std::atan2(w.y, w.x) / degree; };
    list.theta_i_deg.push_back(zenith(d.wi));
    list.phi_i_deg.push_back(azimuth(d.wi));
    list.theta_o_deg.push_back(zenith(d.wo));
    list.phi_o_deg.push_back(azimuth(d.wo));
    for (std::size_t c = 0; c < t.values.size(); ++c) t.values[c].push_back(whole.values[c][i]);
  }
  t.where = std::move(list);
  return t;
}

/// A MERL table with 2 % noise, of which a fit sees a share: the error of alpha over seeds.
void add_fits(std::vector<CostPoint>& to,
              const CostOptions& o,
              const std::function<void(double)>& done) {
  FitOptions options;
  options.bin_sensitivity = false;
  const auto truth =
      bind_model(options.model, {{"alpha", {0.15}}, {"f0", {0.05}}, {"kd", {0.2, 0.1, 0.05}}}, 3);
  struct Share {
    std::size_t bins;  ///< 0: all, as they are in the table
    std::vector<double> ns{}, off{};
  };
  std::vector<Share> shares{{0}, {262'144}, {65'536}, {16'384}, {4096}, {1024}, {256}};
  const std::size_t seeds = o.full ? 24 : 8;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    SynthOptions synth;
    synth.noise = 0.02, synth.seed = seed;
    const auto whole = synthesize(truth, synth);
    const SampleAngles angles(whole);
    for (auto& s : shares) {
      const auto result = fit(s.bins ? share_of(whole, angles, s.bins, seed) : whole, options);
      double ms = 0;
      for (const auto& [phase, took] : result.document.solver.phase_ms)
        if (phase.starts_with("columns") || phase.starts_with("start") ||
            phase.starts_with("solve"))
          ms += took;
      s.ns.push_back(1e6 * ms);
      s.off.push_back(result.model.values[result.model.model.find("alpha")->first] / 0.15 - 1);
    }
    done(static_cast<double>(seed) / static_cast<double>(seeds));
  }
  for (const auto& s : shares) {
    double squares = 0;
    for (const double off : s.off) squares += off * off;
    const double rms = std::sqrt(squares / static_cast<double>(seeds));
    to.push_back({"fit", s.bins ? "bins chosen by chance" : "the whole table",
                  s.bins ? fmt::format("{} bins", s.bins) : "all 1458000 bins", spread_of(s.ns),
                  rms,
                  // of an RMS of so many normal deviates
                  rms / std::sqrt(2 * static_cast<double>(seeds))});
  }
}

}  // namespace

std::vector<CostPoint> cost_points(const CostOptions& o, const std::function<void(double)>& done) {
  std::vector<CostPoint> out;
  auto of_energy = energy_options(false);
  of_energy.samples = o.full ? of_energy.samples : 4096;
  add_compensations(out);
  done(0.3);
  add_quadrature(out, of_energy);
  done(0.4);
  add_split_sum(out);
  done(0.6);
  add_fits(out, o, [&](double x) { done(0.6 + 0.4 * x); });
  return out;
}

}  // namespace gonio
