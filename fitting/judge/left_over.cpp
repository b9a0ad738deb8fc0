#include "fitting/judge/left_over.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <unordered_set>
#include <utility>

#include "base/quantile.h"
#include "fitting/sample/incident_angles.h"
#include "fitting/sample/model_blocks.h"
#include "table/health/rounding.h"

namespace gonio::misfit {
namespace {

constexpr double arithmetic = 1e-7;           ///< of f: below it is rounding of our own
constexpr std::size_t most_values = 1 << 15;  ///< looked at
constexpr std::size_t no_unit = static_cast<std::size_t>(-1);
constexpr std::size_t most_channels = 16;
constexpr std::size_t most_neighbours =
    1 << 17;  ///< values of a table whose neighbours are looked at

/// True of a slot whose value stands at the end of what it may be.
bool is_at_bound(const Problem& p, std::span<const double> values, std::size_t slot) {
  return p.bounds.at_end(p.free.index(slot), values[slot]);
}

/// Fills in what the table itself shows of the noise of its values.
void find_noise(TableFacts& facts, std::size_t stride, std::vector<Value>& values) {
  const Table& t = facts.table();
  if (t.size() * t.values.size() > most_neighbours) return;
  std::map<std::pair<std::size_t, std::size_t>, double> of;
  for (const auto& d : facts.noise_samples().all) of[{d.sample, d.channel}] = d.more;
  for (auto& v : values)
    if (const auto found = of.find({v.sample, v.channel * stride}); found != of.end())
      v.noise = found->second;
}

/// Values of the smooth functions.  θ_h counts by its logarithm above 2°: highlights are narrow.
std::array<double, fine> functions(const Angles<double>& a) {
  const double theta_d = std::acos(std::clamp(a.voh, -1.0, 1.0));
  const double theta_h = std::asin(std::sqrt(std::clamp(a.sin2_theta_h, 0.0, 1.0)));
  const double h = std::log1p(theta_h / (2 * degree)) / 2;
  return {1,
          h,
          theta_d,
          h * theta_d,
          h * h,
          theta_d * theta_d,
          theta_d * theta_d * theta_d,
          a.nol + a.nov,
          a.nol * a.nov,
          1 / ((a.nol + 0.1) * (a.nov + 0.1)),
          h * h * h,
          h * h * h * h};
}

std::size_t cell_of(const Angles<double>& a) {
  const double theta_d = std::acos(std::clamp(a.voh, 0.0, 1.0)) / degree;
  const double theta_h = std::asin(std::sqrt(std::clamp(a.sin2_theta_h, 0.0, 1.0))) / degree;
  const auto place = [](double x, std::size_t n) {
    return std::min(static_cast<std::size_t>(x), n - 1);
  };
  return place(rows * std::sqrt(theta_h / 90), rows) * columns +
         place(columns * theta_d / 90, columns);
}

/// Numbers of a sample's angles along each axis, as they are met.
class AngleNumbers {
 public:
  explicit AngleNumbers(const Sampling& s) : incident_(s), list_(s.table().list()) {
    if (const Grid* g = s.table().grid(); g && g->kind == Grid::Kind::in_out) grid_ = g;
  }
  std::array<std::size_t, shared_angles> operator()(std::size_t sample, double nol) {
    const auto key = incident_(sample, nol);
    std::array<Key, shared_angles> keys;
    keys.fill({0, static_cast<long>(key)});
    if (grid_) {
      const auto at = grid_->unravel(sample);
      const auto out = static_cast<long>(at[1]), phi = static_cast<long>(at[2]);
      keys = {keys[0], keys[0], Key{0, out}, Key{0, phi}, Key{phi, out}};
    } else if (list_) {
      const auto place = [&](const auto& theta_deg, const auto& phi_deg) {
        const long theta = thousandths(theta_deg[sample]), turn = 2 * half_turn;
        const long phi = (thousandths(phi_deg[sample]) % turn + turn) % turn;
        return Key{theta == 0 ? 0 : phi, theta};  // at the normal an azimuth means nothing
      };
      const Key light = place(list_->theta_i_deg, list_->phi_i_deg),
                detector = place(list_->theta_o_deg, list_->phi_o_deg);
      keys = {keys[0], light, Key{0, detector[1]}, Key{0, detector[0]}, detector};
    }
    std::array<std::size_t, shared_angles> all{};
    for (std::size_t a = 0; a < shared_angles; ++a)
      all[a] = numbers_[a].emplace(keys[a], numbers_[a].size()).first->second;
    return all;
  }
  void give(Left& to) const {
    if (list_) {  // at the normal the light has no azimuth, and is at number 0
      const auto& lights = numbers_[static_cast<std::size_t>(SharedAngle::light)];
      const auto azimuth = [](const auto& light) { return light.first[0] % half_turn; };
      const auto first =
          std::ranges::find_if(lights, [](const auto& l) { return l.first[1] != 0; });
      to.turned = first != lights.end() && std::ranges::any_of(lights, [&](const auto& l) {
                    return l.first[1] != 0 && azimuth(l) != azimuth(*first);
                  });
    }
    for (std::size_t a = 0; a < (grid_ || list_ ? shared_angles : 1); ++a) {
      to.angles[a] = numbers_[a].size();
      to.places[a].resize(numbers_[a].size());
      for (const auto& [key, number] : numbers_[a]) to.places[a][number] = key;
    }
  }

 private:
  using Key = std::array<long, 2>;
  static constexpr long half_turn = 180'000;
  static long thousandths(double deg) { return std::lround(deg * 1000); }
  IncidentKeys incident_;
  const DirectionList* list_;
  const Grid* grid_ = nullptr;
  std::array<std::map<Key, std::size_t>, shared_angles> numbers_;
};

/// Readings that stand in a table twice: the same value where an isotropic reciprocal model has one.
class Readings {
 public:
  explicit Readings(bool has_frame) : has_frame_(has_frame) {}
  /// True the first time.
  bool is_new(const Angles<double>& a, std::size_t channel, double y) {
    if (has_frame_) return true;  // mirrored directions differ
    const auto place = [](double cosine) { return std::llround(1e8 * cosine); };
    const auto [low, high] = std::minmax(a.nol, a.nov);
    return seen_
        .insert({place(low), place(high), place(a.voh), static_cast<std::int64_t>(channel),
                 std::bit_cast<std::int32_t>(static_cast<float>(y))})  // but for a last digit
        .second;
  }

 private:
  using Reading = std::array<std::int64_t, 5>;
  struct Hash {
    std::size_t operator()(const Reading& r) const {
      std::uint64_t h = 0;
      for (const std::int64_t x : r) h = (h ^ static_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15U;
      return static_cast<std::size_t>(h ^ (h >> 32));
    }
  };
  bool has_frame_;
  std::unordered_set<Reading, Hash> seen_;
};

}  // namespace

double row_edge(std::size_t k) {
  const double part = static_cast<double>(k) / rows;
  return 90 * part * part;
}
double column_edge(std::size_t k) {
  return 90.0 * static_cast<double>(k) / columns;
}

Left left_over(const Sampling& s, const Problem& p, const Fitted& f, TableFacts& facts) {
  const std::size_t stride = (s.channels() + most_channels - 1) / most_channels;
  const std::size_t looked_at = (s.channels() + stride - 1) / stride;
  Left all;
  ModelBlocks<double> model(s, f.model, p.free.mask());
  const double *const link = model.link(), *const slope = model.slope();

  std::vector<std::vector<const double*>> derivatives;
  std::map<std::size_t, std::size_t> numbers;  // of the unknowns met
  for (std::size_t c = 0; c < s.channels(); c += stride) {
    auto& unknowns = all.unknowns.emplace_back();
    auto& of = derivatives.emplace_back();
    for (const auto& [slot, column] : model.channel(c).d) {
      if (is_at_bound(p, f.model.values, slot)) continue;
      unknowns.push_back(numbers.emplace(slot, numbers.size()).first->second);
      of.push_back(column);
    }
  }
  all.slots.resize(numbers.size());
  for (const auto& [slot, number] : numbers) all.slots[number] = slot;

  AngleNumbers numbers_of(s);
  Readings readings(s.has_frame());
  const auto offset = s.link_offset();
  const FileRounding rounding = rounding_of(s.table());
  const SampleAngles at(s.table());
  const std::size_t members = s.groups().widest();
  const Tasks tasks(s, std::max<std::size_t>(most_values / (members * looked_at), 64),
                    BlockReader<double>::block);
  std::vector<std::size_t> unit_of;
  for (std::size_t k = 0; k < tasks.count; ++k) {
    BlockReader<double> in(s, tasks.first(k), tasks.last(k), tasks.step);
    while (in.next()) {
      const auto x = in.angles();
      unit_of.assign(members * in.size(), no_unit);
      model.run(in, [&](std::size_t c) {
        if (c % stride != 0) return;
        const double* const value = model.channel(c).value;
        for (std::size_t m = 0; m < members; ++m) {
          const auto& data = in.values(m, c);
          for (std::size_t i = 0; i < in.size(); ++i) {
            const double w = data.weight[i];
            if (!(w > 0)) continue;
            const double weight = s.root_weight(in.sample(m)[i]);
            const double r = w * (link[i] - data.target[i]);
            // Below what the link tells apart f is as large as that; such a datum says nothing of
            // it.
            const bool faint = slope[i] == 0;
            constexpr double least = static_cast<double>(faintest);
            const double f_seen = faint ? least : value[i],
                         slope_seen = faint ? 1 / least : slope[i];
            if (!std::isfinite(r) || !std::isfinite(slope_seen) || (faint && r == 0)) continue;
            const Angles<double> a{x.nol[i], x.nov[i], x.noh[i], x.voh[i], x.sin2_theta_h[i]};
            if (!readings.is_new(a, c, data.y[i])) continue;
            auto& unit = unit_of[m * in.size() + i];
            if (unit == no_unit) {
              unit = all.units.size();
              const std::size_t sample = in.sample(m)[i];
              all.units.push_back({functions(a), cell_of(a), numbers_of(sample, in.nol(m)[i]),
                                   s.count_of(sample), x.nov[i], at.directions(sample)});
              all.directions += all.units.back().count;
            }
            auto& v = all.values.emplace_back();
            v.unit = unit;
            v.channel = c / stride;
            v.sample = in.sample(m)[i];
            v.whole = r;
            v.root_count = std::sqrt(all.units[unit].count);
            all.samples += all.units[unit].count;
            v.r = std::clamp(r, -f.huber, f.huber);
            v.active = std::abs(r) <= f.huber ? 1 : 0;
            // By f where the metric divides by y: noise in both would follow itself.
            v.slope = s.metric() == Metric::relative ? 1 / (f_seen + s.offset())
                                                     : w / weight * slope_seen;
            v.change = w * slope_seen * f_seen;
            v.f = f_seen;
            all.without_logarithm += !(data.y[i] > 0) && value[i] > least;
            const double rounded = std::hypot(rounding.of(data.y[i]), arithmetic * data.y[i]);
            v.rounding =
                w * (link_of(s.metric()) == Link::log ? std::log1p(rounded / (data.y[i] + offset))
                                                      : rounded);
            const auto& of = derivatives[v.channel];
            for (std::size_t q = 0; q < of.size(); ++q) v.j[q] = w * slope[i] * of[q][i];
          }
        }
      });
    }
  }
  find_noise(facts, stride, all.values);
  numbers_of.give(all);
  all.robust = p.options.robust;
  all.stated = s.in_uncertainties();
  return all;
}

namespace {

/// Residuals less their regression, by parts of f, on the smooth functions of the angles: these take up what a wrong model leaves, and
/// little noise [modified Gram–Schmidt].
std::vector<double> without_smooth(const Left& left) {
  const auto part = [&](std::size_t i) { return left.values[i].slope * left.values[i].f; };
  std::vector<double> rest(left.values.size());
  for (std::size_t i = 0; i < rest.size(); ++i)
    rest[i] = part(i) > 0 ? left.values[i].whole / part(i) : 0;
  std::vector<std::vector<double>> all;
  for (std::size_t k = 0; k < smooth; ++k) {
    std::vector<double> own(rest.size());
    for (std::size_t i = 0; i < own.size(); ++i)
      own[i] = left.units[left.values[i].unit].functions[k];
    const auto take_out = [](const std::vector<double>& unit, std::vector<double>& from) {
      const double length = std::inner_product(unit.begin(), unit.end(), from.begin(), 0.0);
      for (std::size_t i = 0; i < from.size(); ++i) from[i] -= length * unit[i];
    };
    const auto norm = [&] {
      return std::sqrt(std::inner_product(own.begin(), own.end(), own.begin(), 0.0));
    };
    const double before = norm();
    for (const auto& unit : all) take_out(unit, own);
    constexpr double rounding = 1e-6;
    const double after = norm();
    if (!(after > rounding * before)) continue;
    for (double& x : own) x /= after;
    take_out(own, rest);
    all.push_back(std::move(own));
  }
  for (std::size_t i = 0; i < rest.size(); ++i) rest[i] *= part(i);
  return rest;
}

}  // namespace

bool find_variances(Left& left) {
  if (left.stated) {
    for (auto& v : left.values) v.variance = 1;
    return false;
  }
  static constexpr double largest =
      1e150;  // whose square is finite: f may be next to nothing, or 0
  enum Noise { of_one_size, relative, over_cosine };
  const auto sigma = [&](const Value& v, Noise kind) {
    const double over = kind == over_cosine ? std::max(left.units[v.unit].nov, least_cosine) : 1;
    return std::clamp(v.slope * (kind == of_one_size ? 1 : v.f / over), 1 / largest, largest);
  };
  const double n = left.samples;
  std::vector<double> residuals;
  for (const auto& v : left.values) residuals.push_back(v.whole);
  const auto badness = [&](Noise kind) {
    double logs = 0, squares = 0;
    std::vector<double> sizes;
    for (std::size_t i = 0; i < residuals.size(); ++i) {
      const auto& v = left.values[i];
      const double root = residuals[i] / sigma(v, kind);
      logs += 2 * v.root_count * v.root_count * std::log(sigma(v, kind));
      squares += root * root;
      if (left.robust) sizes.push_back(std::abs(root));
    }
    if (!left.robust) return logs + n * std::log(squares);
    if (sizes.empty()) return 0.0;
    const double scale = median(sizes);
    for (const double size : sizes) logs += 2 * std::log(scale + size / scale * size);
    return logs - n * std::log(scale * scale);
  };
  Noise kind = badness(of_one_size) < badness(relative) ? of_one_size : relative;
  // A wrong model's residuals may grow towards grazing, too.
  constexpr double clearly = 6;  // twice the logarithm of the likelihoods' ratio
  residuals = without_smooth(left);
  if (badness(over_cosine) < std::min(badness(of_one_size), badness(relative)) - clearly)
    kind = over_cosine;
  for (auto& v : left.values) v.variance = sigma(v, kind) * sigma(v, kind);
  return kind != of_one_size;
}

std::vector<UnevenNoise> uneven_noise(const Left& whole) {
  constexpr std::size_t looked_at = 1 << 12;
  constexpr double clearly = 6;  // twice the logarithm of the likelihoods' ratio
  constexpr double apart = 1.5;  // a channel's noise, of another's
  const Left left = thinned(whole, looked_at);
  const auto rest = without_smooth(left);
  std::vector<UnevenNoise> all;
  bool is_uneven = false;
  for (std::size_t c = 0; c < left.unknowns.size(); ++c) {
    std::vector<std::array<double, 3>> values;  // f, what is left of it, and how often it counts
    for (std::size_t i = 0; i < rest.size(); ++i)
      if (const auto& v = left.values[i]; v.channel == c && v.slope > 0 && v.f > 0)
        values.push_back({v.f, rest[i] / v.slope, v.root_count * v.root_count});
    if (values.empty()) return {};
    double count = 0;
    for (const auto& v : values) count += v[2];
    const auto scatter = [&](double floor) {
      double logs = 0, squares = 0;
      for (const auto& [f, off, n] : values) {
        const double size = std::hypot(f, floor) / values[0][0];
        logs += 2 * n * std::log(size), squares += n * std::pow(off / size / values[0][0], 2);
      }
      return std::pair(logs + count * std::log(squares), squares / count);
    };
    const auto [least, most] = std::ranges::minmax(values, {}, [](const auto& v) { return v[0]; });
    auto best = scatter(0);
    UnevenNoise here{std::sqrt(best.second), 0};
    best.first -= clearly;
    constexpr double step = 2;
    for (double floor = least[0] / 16; floor < 64 * most[0]; floor *= step)
      if (const auto there = scatter(floor); there.first < best.first)
        best = there, here = {std::sqrt(there.second), floor}, is_uneven = true;
    all.push_back(here);
  }
  const auto [low, high] = std::ranges::minmax(all, {}, &UnevenNoise::part);
  if (!is_uneven && !(high.part > apart * low.part)) all.clear();
  return all;
}

std::optional<MisfitCell> worst_cell(const Left& left) {
  std::optional<MisfitCell> worst;
  struct Cell {
    double sum = 0, squares = 0;
    std::size_t values = 0;
  };
  std::array<Cell, rows * columns> all;
  double within = 0, freedom = 0;
  for (const auto& v : left.values) {
    Cell& c = all[left.units[v.unit].cell];
    const double off = v.change > 0 ? v.r / v.change : 0;
    c.sum += off;
    c.squares += off * off;
    ++c.values;
  }
  for (const auto& c : all)
    if (c.values > 1) {
      const auto n = static_cast<double>(c.values);
      within += std::max(0.0, c.squares - c.sum * c.sum / n);
      freedom += n - 1;
    }
  const double error = freedom > 0 ? std::sqrt(within / freedom) : 0;
  double furthest = 0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto n = static_cast<double>(all[k].values);
    const double mean = all[k].sum / n, distance = std::abs(mean) - 2 * error / std::sqrt(n);
    if (!(distance > furthest)) continue;
    furthest = distance;
    worst = {row_edge(k / columns),
             row_edge(k / columns + 1),
             column_edge(k % columns),
             column_edge(k % columns + 1),
             all[k].values,
             mean};
  }
  return worst;
}

Left thinned(const Left& all, std::size_t values) {
  const std::size_t step = (all.values.size() + values - 1) / values;
  if (step <= 1) return all;
  Left some = all;
  some.values.clear();
  some.samples = some.directions = 0;
  for (const auto& v : all.values)
    if (v.unit % step == 0) {
      some.values.push_back(v);
      some.samples += all.units[v.unit].count;
    }
  for (std::size_t k = 0; k < all.units.size(); k += step) some.directions += all.units[k].count;
  return some;
}

bool only_rounded(const std::vector<Value>& values, std::span<const double> r) {
  constexpr double most = 4;  // squares, of those of rounding
  constexpr double clipped = 100;
  double squares = 0, rounded = 0, own = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double square = r[i] * r[i], by_rounding = values[i].rounding * values[i].rounding;
    squares += square;
    rounded += by_rounding;
    own += square > clipped * by_rounding ? clipped : square > 0 ? square / by_rounding : 0;
  }
  return squares <= most * rounded && own <= most * static_cast<double>(values.size());
}

}  // namespace gonio::misfit
