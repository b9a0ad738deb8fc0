#include "reports/own/energy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/numbers.h"
#include "base/whole_loop.h"
#include "brdf/model/model.h"
#include "geometry/direction.h"
#include "integrate/albedo/directional_albedo.h"
#include "reports/measure/samples.h"
#include "reports/own/parameters.h"

#include <fmt/format.h>

namespace gonio {

void take_largest(std::optional<FoundAt>& w, double v, const std::string& at) {
  if (!w || v > w->value || std::isnan(v)) w = FoundAt{v, at};
}
void take_smallest(std::optional<FoundAt>& w, double v, const std::string& at) {
  if (!w || v < w->value || std::isnan(w->value)) w = FoundAt{v, at};
}

namespace {

constexpr double steepest = 0.035;  ///< cosine of 88°
constexpr std::array views{steepest, 0.1, 0.5, 1.0};

std::vector<Setting> settings_of(std::span<const Parameter> parameters,
                                 const std::vector<double>& values) {
  std::vector<Setting> set;
  for (std::size_t k = 0; k < parameters.size(); ++k)
    set.push_back({std::string(parameters[k].name), {values[k]}});
  return set;
}

}  // namespace

OwnAlbedo::OwnAlbedo(std::string token,
                     std::span<const Parameter> parameters,
                     std::size_t channels,
                     bool anisotropic)
    : token_(std::move(token)),
      parameters_(parameters),
      channels_(channels),
      anisotropic_(anisotropic) {}

std::vector<double> OwnAlbedo::at(const std::vector<double>& values,
                                  std::span<const double> mu,
                                  double phi_deg,
                                  const Goal& goal,
                                  bool smallest) const {
  const auto model = bind_model(token_, settings_of(parameters_, values), channels_);
  std::vector<double> all;
  for (const auto& a : directional_albedo(model, mu, phi_deg * degree, goal)) {
    const auto has_none = std::ranges::find_if(a.value, [](double v) { return std::isnan(v); });
    all.push_back(has_none != a.value.end() ? *has_none
                  : smallest                ? *std::ranges::min_element(a.value)
                                            : *std::ranges::max_element(a.value));
  }
  return all;
}

double OwnAlbedo::along_normal(const std::vector<double>& values) const {
  return at(values, std::array{1.0}, 0, {1e-3, 200'000})[0];
}

FoundAt OwnAlbedo::found(const Place& p, bool smallest) const {
  const double value = at(p.values, std::span(&p.mu, 1), p.phi_deg, {1e-5}, smallest)[0];
  FoundAt f{value,
            auditing::joined(auditing::text(parameters_, p.values), fmt::format("NoV {}", p.mu))};
  if (anisotropic_) f.at += fmt::format(", φ {}°", p.phi_deg);
  std::string set;
  for (std::size_t k = 0; k < parameters_.size(); ++k)
    set += fmt::format(" {}={}", parameters_[k].name, p.values[k]);
  const bool has_options = token_.find('{') != token_.npos;
  f.repeat = fmt::format("gonio albedo {0}{1}{0}{2}{3} --mu {4}{5}", has_options ? "'" : "", token_,
                         set.empty() ? "" : " --set", set, p.mu,
                         anisotropic_ ? fmt::format(" --phi {}", p.phi_deg) : "");
  return f;
}

double OwnAlbedo::without_diffuse(const Place& p) const {
  auto values = p.values;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (is_colour(parameters_[k]) && !is_f0(parameters_[k])) values[k] = low_of(parameters_[k]);
  return at(values, std::span(&p.mu, 1), p.phi_deg, {1e-4})[0];
}

namespace {

/// A parameter, or the three of a colour whose channels mix, by its place in [0, 1] between its bounds.
struct Axis {
  std::vector<std::size_t> of;
  double low, high, usual;
  bool by_ratio, is_colour;

  double value(double part) const {
    const double v = by_ratio ? low * std::pow(high / low, part) : low + part * (high - low);
    // Four digits are enough to repeat it.
    return std::clamp(*number_from<double>(fmt::format("{:.4g}", v)), low, high);
  }
  double part_of(double v) const {
    if (!(high > low)) return 0;
    return by_ratio ? std::log(v / low) / std::log(high / low) : (v - low) / (high - low);
  }
};

std::vector<Axis> axes_of(std::span<const Parameter> parameters) {
  std::vector<Axis> all;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const auto& p = parameters[k];
    const bool is_channel = stem_of(p.name) != p.name;
    if (is_channel && !all.empty() &&
        stem_of(parameters[all.back().of[0]].name) == stem_of(p.name)) {
      all.back().of.push_back(k);
      continue;
    }
    const double low = low_of(p), high = high_of(p);
    all.push_back({{k}, low, high, usual_of(p), low > 0 && high > 10 * low, is_colour(p)});
  }
  return all;
}

/// The search for the largest or the smallest albedo.
class Sought {
 public:
  explicit Sought(const OwnAlbedo& albedo) : albedo_(albedo), axes_(axes_of(albedo.parameters())) {}

  /// Values by axis of which some are given; the others are their ends, their defaults, and of many places between.
  using Given = std::vector<std::optional<double>>;
  Given none() const { return Given(axes_.size()); }
  /// All colours at one end, but for one that is at the other.
  Given with_colours(bool high, std::optional<std::size_t> other = {}) const {
    Given g = none();
    for (std::size_t k = 0; k < axes_.size(); ++k)
      if (axes_[k].is_colour) g[k] = (k == other) != high ? axes_[k].high : axes_[k].low;
    return g;
  }
  std::vector<std::size_t> colours() const {
    std::vector<std::size_t> all;
    for (std::size_t k = 0; k < axes_.size(); ++k)
      if (axes_[k].is_colour) all.push_back(k);
    return all;
  }

  FoundAt largest(std::span<const Given> from) { return best(from, false); }
  /// Where the last search ended.
  const OwnAlbedo::Place& last() const { return last_; }
  FoundAt smallest(const Given& from) { return best(std::span(&from, 1), true); }
  /// Most light that one colour adds to what all colours black return; for F0 nothing is taken off, as its lobe is dark without it.
  FoundAt largest_part() {
    std::optional<FoundAt> most;
    for (const auto c : colours()) {
      subtracts_ = !is_f0(albedo_.parameters()[axes_[c].of[0]]);
      const auto f = largest(std::array{with_colours(false, c)});
      if (!most || f.value > most->value) most = f;
    }
    subtracts_ = false;
    return *most;
  }

 private:
  /// A place by axis: parameters, then the view's cosine and azimuth.
  struct Candidate {
    std::vector<double> parts;
    const Given* given = nullptr;
    double score = 0;
  };

  std::vector<std::vector<double>> sampled(const Given& given) const {
    std::size_t free = 0, factorial = 1;
    for (const auto& g : given)
      if (!g && factorial <= most_) ++free, factorial *= 3;
    const std::size_t count = factorial <= most_ ? factorial : most_;
    constexpr std::array roots{2.0,  3.0,  5.0,  7.0,  11.0, 13.0, 17.0, 19.0,
                               23.0, 29.0, 31.0, 37.0, 41.0, 43.0, 47.0, 53.0};
    std::vector<std::vector<double>> all;
    for (std::size_t i = 0; i < count; ++i) {
      std::vector<double> parts;
      std::size_t digits = i;
      for (std::size_t k = 0; k < axes_.size(); ++k) {
        if (given[k]) {
          parts.push_back(axes_[k].part_of(*given[k]));
          continue;
        }
        const double usual = axes_[k].part_of(axes_[k].usual);
        if (count == factorial) {
          parts.push_back(std::array{0.0, 1.0, usual}[digits % 3]);
          digits /= 3;
          continue;
        }
        double whole = 0;
        const double drawn = std::modf(static_cast<double>(i + 1) * std::sqrt(roots[k]), &whole);
        parts.push_back(drawn < 0.35   ? 0
                        : drawn < 0.7  ? 1
                        : drawn < 0.85 ? usual
                                       : (drawn - 0.85) / 0.15);
      }
      all.push_back(std::move(parts));
    }
    return all;
  }
  std::vector<double> values_of(const std::vector<double>& parts) const {
    std::vector<double> v(albedo_.parameters().size());
    for (std::size_t k = 0; k < axes_.size(); ++k)
      for (const auto p : axes_[k].of) v[p] = axes_[k].value(parts[k]);
    return v;
  }
  OwnAlbedo::Place place_of(const std::vector<double>& parts) const {
    const std::size_t n = axes_.size();
    return {values_of(parts), view_.value(parts[n]), azimuth_.value(parts[n + 1])};
  }
  std::vector<double> dark(std::vector<double> values) const {
    for (const auto& a : axes_)
      for (const auto p : a.of)
        if (a.is_colour) values[p] = a.low;
    return values;
  }
  std::vector<double> scores(const std::vector<double>& values,
                             std::span<const double> mu,
                             double phi_deg,
                             const Goal& goal,
                             bool smallest) const {
    auto all = albedo_.at(values, mu, phi_deg, goal, smallest);
    if (subtracts_) {
      const auto without = albedo_.at(dark(values), mu, phi_deg, goal);
      for (std::size_t k = 0; k < all.size(); ++k) all[k] -= without[k];
    }
    // Without a value is worse than any; of the smallest it is no light that is lost.
    for (double& x : all) x = std::isnan(x) ? smallest ? -1e300 : 1e300 : smallest ? -x : x;
    return all;
  }

  FoundAt best(std::span<const Given> from, bool smallest) {
    std::vector<Candidate> all;
    const std::size_t azimuths = albedo_.is_anisotropic() ? 2 : 1;
    for (const auto& given : from)
      for (auto& parts : sampled(given))
        for (std::size_t a = 0; a < azimuths; ++a) {
          all.push_back({parts, &given});
          all.back().parts.resize(axes_.size() + 2);
          all.back().parts.back() = azimuth_.part_of(90.0 * static_cast<double>(a));
        }
    for_each_whole(all.size(), [&](std::size_t i) {
      auto& c = all[i];
      const auto at =
          scores(values_of(c.parts), views, azimuth_.value(c.parts.back()), rough_, smallest);
      const auto most = std::ranges::max_element(at);
      c.score = *most;
      c.parts[axes_.size()] = view_.part_of(views[static_cast<std::size_t>(most - at.begin())]);
    });
    std::ranges::stable_sort(all, std::ranges::greater(), &Candidate::score);
    constexpr std::size_t climbs = 3;
    all.resize(std::min(climbs, all.size()));
    for (auto& c : all) climb(c, smallest);
    const auto& most = *std::ranges::max_element(all, {}, &Candidate::score);
    last_ = place_of(most.parts);
    auto found = albedo_.found(last_, smallest);
    if (subtracts_) found.value = most.score;
    return found;
  }

  /// Goes to the best neighbour along an axis as long as there is one, by steps that become smaller.
  void climb(Candidate& c, bool smallest) const {
    constexpr double first = 0.25, last = 0.004, least_gain = 2e-4;
    std::vector<std::size_t> along;
    for (std::size_t k = 0; k < axes_.size(); ++k)
      if (!(*c.given)[k] && axes_[k].high > axes_[k].low) along.push_back(k);
    along.push_back(axes_.size());
    const auto scored = [&](const Candidate& at) {
      const auto p = place_of(at.parts);
      return scores(p.values, std::span(&p.mu, 1), p.phi_deg, fine_, smallest)[0];
    };
    c.score = scored(c);
    if (albedo_.is_anisotropic()) along.push_back(axes_.size() + 1);
    for (double step = first; step > last;) {
      std::vector<Candidate> near;
      for (const auto k : along)
        for (const double by : {-step, step})
          if (const double to = std::clamp(c.parts[k] + by, 0.0, 1.0); to != c.parts[k]) {
            near.push_back(c);
            near.back().parts[k] = to;
          }
      for_each_whole(near.size(), [&](std::size_t i) { near[i].score = scored(near[i]); });
      const auto best = std::ranges::max_element(near, {}, &Candidate::score);
      if (best == near.end() || !(best->score > c.score + least_gain))
        step /= 2;
      else
        c = *best;
    }
  }

  static constexpr std::size_t most_ = 243;
  static constexpr Goal rough_{1e-2, 20'000}, fine_{1e-3, 100'000};
  const OwnAlbedo& albedo_;
  std::vector<Axis> axes_;
  OwnAlbedo::Place last_;
  bool subtracts_ = false;  ///< what there is without colours
  Axis view_{{}, steepest, 1, 1, true, false}, azimuth_{{}, 0, 180, 0, false, false};
};

}  // namespace

Energy energy_of(const OwnAlbedo& albedo) {
  Sought sought(albedo);
  const auto parameters = albedo.parameters();
  const auto colours = sought.colours();
  std::vector<Sought::Given> parts;
  for (const auto c : colours) parts.push_back(sought.with_colours(false, c));
  auto all = parts;
  all.push_back(sought.none());
  Energy e;
  e.darkest = sought.smallest(sought.with_colours(true));
  e.albedo = sought.largest(all);
  if (e.albedo.value > 1) e.without_diffuse = albedo.without_diffuse(sought.last());
  if (colours.size() > 1) e.part = sought.largest_part();
  if (std::ranges::none_of(parameters, [](const Parameter& p) { return std::isnan(p.start); })) {
    std::vector<double> usual;
    for (const auto& p : parameters) usual.push_back(usual_of(p));
    e.usual =
        FoundAt{albedo.at(usual, std::array{0.5}, 0, {1e-3, 200'000})[0], "defaults, NoV 0.5"};
  }
  return e;
}

}  // namespace gonio
