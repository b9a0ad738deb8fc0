#include "fitting/solve/profile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "brdf/model/roughness.h"
#include "fitting/solve/colours.h"

#include <tbb/parallel_for.h>

namespace gonio {
namespace {

/// Part of the cost by which another valley must be lower for the fit to go there.
constexpr double lower_by = 1e-6;

/// Problem with the axes held.
Problem with_axes_held(const Problem& p, const std::vector<std::size_t>& axes) {
  auto mask = p.free.mask();
  for (const std::size_t k : axes) {
    const auto& q = p.start.model.parameters[k];
    for (std::size_t c = 0; c < q.count; ++c) mask[q.first + c] = false;
  }
  return with_free(p, p.start.model, mask);
}

/// Places along an axis: even by ratio, from 0 even by root.
std::vector<double> places(const Problem& p, const ModelParameter& q, std::size_t count) {
  const std::size_t i = p.free.index(q.first);
  const double low = p.bounds.low[i], high = p.bounds.high[i];
  std::vector<double> at;
  for (std::size_t k = 0; k < count; ++k) {
    const double part = static_cast<double>(k) / static_cast<double>(count - 1);
    at.push_back(low > 0 ? std::min(high, low * std::pow(high / low, part))
                         : low + part * part * (high - low));
  }
  return at;
}

template <class F>
class Profiler {
 public:
  Profiler(const Problem& p, const FitData<F>& thin, double huber)
      : p_(p),
        axes_(profile_axes(p)),
        side_(axes_.size() == 1 ? profile_cells : profile_side),
        held_(with_axes_held(p, axes_)),
        rest_(held_.start.model, thin, held_.free, huber),
        whole_(p.start.model, thin, p.free, huber),
        colours_(held_, thin, huber),
        indices_(p, thin, huber) {}

  Profile run(const std::vector<double>& optimum) const {
    Profile profile{axes_, 0, {}, 0};
    if (axes_.empty()) return profile;
    const Start bottom = descended(whole_, p_, optimum, {30, 1e-8});
    auto& cells = profile.cells;
    cells.resize(axes_.size() == 1 ? side_ : side_ * side_);
    for (std::size_t i = 0; i < cells.size(); ++i)
      for (std::size_t a = 0; a < axes_.size(); ++a) cells[i].at.push_back(grid_at(a, step(i, a)));
    tbb::parallel_for(std::size_t{0}, cells.size(),
                      [&](std::size_t i) { solve(cells[i], bottom.values, is_looked_into(i)); });
    for (int sweep = 0; sweep < 2; ++sweep) learn_from_neighbours(cells);
    profile.optimum = bottom.cost;
    return profile;
  }

  /// Cells that none around them is below, the lowest first.
  std::vector<std::size_t> valleys(const std::vector<ProfileCell>& cells) const {
    std::vector<std::size_t> lowest;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const auto around = neighbours(i);
      if (std::ranges::none_of(around, [&](std::size_t j) {
            return cells[j].cost < cells[i].cost || (cells[j].cost == cells[i].cost && j < i);
          }))
        lowest.push_back(i);
    }
    std::ranges::stable_sort(lowest, {}, [&](std::size_t i) { return cells[i].cost; });
    return lowest;
  }
  const Problem& held() const { return held_; }
  /// Bottoms of other valleys of an index or an extinction that are nearly as low: those of one form,
  /// eta and 1/eta say, differ by so little that no start tells them apart.
  std::vector<Start> twins(const std::vector<double>& values) const {
    constexpr double nearly = 1e-3, near_one = 1e-2;
    constexpr std::size_t most = 24;  // each is a fit
    if (!indices_.has_valleys()) return {};
    const double cost = whole_.normal_equations(values).cost;
    auto others = indices_.other_valleys({cost, values}, {40, 1e-7}, nearly, most);
    if (others.size() == most) others.push_back(indices_.from_every_valley(values, {40, 1e-7}));
    // Next to eta = 1, where F all but vanishes, the other valley has no bottom to descend to.
    for (const auto& q : p_.start.model.parameters)
      for (std::size_t k = q.first; k < q.first + q.count; ++k)
        if (q.about->name == "eta" && p_.free.mask()[k] && std::abs(values[k] - 1) < near_one &&
            others.size() < 2 * most) {
          others.push_back({cost, values});
          others.back().values[k] = 1 / values[k];
        }
    std::vector<Start> apart;
    for (auto& s : others)
      if (std::ranges::none_of(apart,
                               [&](const Start& a) { return are_alike(a.values, s.values); }) &&
          !are_alike(s.values, values))
        apart.push_back(std::move(s));
    return apart;
  }
  /// Descent of the thinned table with the axes free.
  Start set_free(const ProfileCell& cell) const {
    return descended(whole_, p_, cell.values, {30, 1e-6});
  }

 private:
  /// True of values that are the same but for rounding and the last steps of a descent.
  bool are_alike(const std::vector<double>& a, const std::vector<double>& b) const {
    constexpr double same = 1e-5;
    for (std::size_t i = 0; i < p_.free.size(); ++i) {
      const std::size_t s = p_.free.slots()[i];
      if (std::abs(a[s] - b[s]) > same * std::max(std::abs(a[s]), std::abs(b[s]))) return false;
    }
    return true;
  }
  bool is_wider_along(const std::vector<double>& values) const {
    if (axes_.size() < 2 || parameter(0).about->name != "alpha_x" ||
        parameter(1).about->name != "alpha_y")
      return false;
    return values[parameter(0).first] > values[parameter(1).first];
  }
  const ModelParameter& parameter(std::size_t axis) const {
    return p_.start.model.parameters[axes_[axis]];
  }
  double grid_at(std::size_t axis, std::size_t step) const {
    return places(p_, parameter(axis), side_)[step];
  }
  std::size_t step(std::size_t cell, std::size_t axis) const {
    return axis + 1 == axes_.size() ? cell % side_ : cell / side_;
  }
  std::vector<std::size_t> neighbours(std::size_t cell) const {
    std::vector<std::size_t> around;
    const std::size_t x = step(cell, 0), y = axes_.size() == 2 ? step(cell, 1) : 0;
    const std::size_t rows = axes_.size() == 2 ? side_ : 1;
    for (const int dx : {-1, 0, 1})
      for (const int dy : {-1, 0, 1}) {
        const std::size_t i = x + static_cast<std::size_t>(dx),
                          j = y + static_cast<std::size_t>(dy);
        if ((dx == 0 && dy == 0) || i >= side_ || j >= rows) continue;
        around.push_back(rows == 1 ? i : i * side_ + j);
      }
    return around;
  }
  /// The values with the axes at a cell's place.  Widths along and across a tangent that change places take it a
  /// quarter turn along: where it stood it would be the worst of all, and no descent leaves that.
  std::vector<double> moved_to(const ProfileCell& cell, std::vector<double> values) const {
    const bool was_wider_along = is_wider_along(values);
    for (std::size_t a = 0; a < axes_.size(); ++a) {
      const auto& q = parameter(a);
      std::fill_n(values.begin() + static_cast<std::ptrdiff_t>(q.first), q.count, cell.at[a]);
    }
    const auto* const tangent = p_.start.model.tangent();
    if (is_wider_along(values) != was_wider_along && is_free(p_, *tangent))
      values[tangent->first] += values[tangent->first] > 0 ? -90 : 90;
    return values;
  }
  void take(ProfileCell& cell, Start s) const {
    if (!(s.cost < cell.cost)) return;
    cell.cost = s.cost;
    cell.values = std::move(s.values);
  }

  /// Every fourth cell on a diagonal: the others learn of other valleys from it.
  bool is_looked_into(std::size_t cell) const {
    return (step(cell, 0) + (axes_.size() == 2 ? step(cell, 1) : 0)) % 4 == 0;
  }
  /// From the optimum's other values and, where it is looked into, from the best of all colours.
  void solve(ProfileCell& cell, const std::vector<double>& optimum, bool is_looked_into) const {
    constexpr DescentOptions loosely{4, 1e-2}, closely{12, 1e-5};
    cell.cost = std::numeric_limits<double>::infinity();
    cell.values = moved_to(cell, optimum);
    take(cell, descended(rest_, held_, cell.values, closely));
    if (!colours_.has_valleys() || !is_looked_into) return;
    const auto& lobes = p_.start.model.lobes;
    for (std::size_t l = 0; l < lobes.size(); ++l) {
      const Start coloured = colours_.from_best_valley(moved_to(cell, optimum), l, loosely);
      if (coloured.cost < 1.5 * cell.cost)
        take(cell, descended_in_valley(rest_, held_, coloured.values, closely));
    }
    take(cell, descended_in_valley(
                   rest_, held_, colours_.from_every_valley(cell.values, loosely).values, closely));
  }

  /// Descents from the values of the lowest neighbour, where these do better than a cell's own: what
  /// lies in a lower valley spreads from cell to cell, one for each sweep.
  void learn_from_neighbours(std::vector<ProfileCell>& cells) const {
    constexpr DescentOptions closely{12, 1e-5}, look{1, 0};
    const auto before = cells;
    tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t i) {
      const auto around = neighbours(i);
      const std::size_t lowest =
          *std::ranges::min_element(around, {}, [&](std::size_t j) { return before[j].cost; });
      // A cell can be as low as its neighbour only where that one is lower.
      if (!(before[lowest].cost < cells[i].cost)) return;
      const Start there = descended(rest_, held_, moved_to(cells[i], before[lowest].values), look);
      if (there.cost < cells[i].cost)
        take(cells[i], descended(rest_, held_, there.values, closely));
    });
  }

  const Problem& p_;
  std::vector<std::size_t> axes_;
  std::size_t side_;  ///< cells along each axis
  Problem held_;
  Accumulator<F> rest_, whole_;
  Colours<F> colours_;  ///< with the axes held
  Colours<F> indices_;  ///< with the shapes held
};

/// Whether a fit of all samples from there is lower; then it is the fit.
template <class F>
bool moves_to(const Problem& p,
              const FitData<F>& all,
              const std::vector<double>& there,
              Fitted& f) {
  Fitted other = minimise(p, all, {p.start.model, there, p.start.given}, f.huber);
  const double gain = f.solution.at.cost - other.solution.at.cost;
  const double rounding = p.rounding * static_cast<double>(all.counts.used);
  if (!(gain > lower_by * f.solution.at.cost && gain > rounding)) return false;
  f = std::move(other);
  return true;
}

/// Cells that are to be solved for with all samples, the lowest first.
std::vector<std::size_t> low_cells(const Profile& profile, std::size_t most) {
  constexpr double near = 0.01;
  std::vector<std::size_t> order(profile.cells.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto cost = [&](std::size_t i) { return profile.cells[i].cost; };
  std::ranges::stable_sort(order, {}, cost);
  const double limit = std::min(profile.optimum, cost(order[0])) * (1 + near);
  std::size_t count = 1;
  while (count < order.size() && count < most && cost(order[count]) <= limit) ++count;
  order.resize(count);
  return order;
}

}  // namespace

std::vector<std::size_t> profile_axes(const Problem& p) {
  const auto& all = p.start.model.parameters;
  std::vector<std::size_t> axes;
  const auto add = [&](auto&& is_one) {
    for (std::size_t k = 0; k < all.size(); ++k)
      if (axes.size() < 2 && is_free(p, all[k]) && is_one(all[k])) axes.push_back(k);
  };
  add([](const ModelParameter& q) { return is_alpha(q.name); });
  add([&](const ModelParameter& q) {
    return is_shape(q) && !is_alpha(q.name) && &q != p.start.model.tangent();
  });
  for (const char* index : {"eta", "k"})
    add([&](const ModelParameter& q) {
      return q.about->name == index && (q.count == 1 || axes.empty());
    });
  return axes;
}

template <class F>
Profile profile(const Problem& p,
                const FitData<F>& thin,
                const FitData<F>& scan,
                const FitData<F>& all,
                Fitted& f) {
  constexpr int most_moves = 3;
  constexpr std::size_t most_valleys = 6, most_cells = 32;
  constexpr double worth_a_fit = 0.05;
  const Profiler<F> profiler(p, thin, f.huber);
  const Accumulator<F> scanned(p.start.model, scan, p.free, f.huber),
      whole(profiler.held().start.model, all, profiler.held().free, f.huber);
  Profile profile = profiler.run(f.model.values);
  for (int moves = 0; !profile.cells.empty(); ++moves) {
    profile.moves = moves;
    if (moves == most_moves) return profile;
    bool moved = false;

    // Other valleys, and what else is low, everything free: where a width leaves an exponent
    // without effect, only one of many equal cells leads down.
    auto from = profiler.valleys(profile.cells);
    from.resize(std::min(from.size(), most_valleys));
    const auto low = low_cells(profile, most_cells);
    from.insert(from.end(), low.begin(), low.end());
    std::vector<Start> bottoms(from.size());
    tbb::parallel_for(std::size_t{0}, from.size(), [&](std::size_t k) {
      bottoms[k] = profiler.set_free(profile.cells[from[k]]);
    });
    keep_best(bottoms, most_valleys);
    bottoms.insert(bottoms.begin(), Start{0, f.model.values});
    tbb::parallel_for(std::size_t{0}, bottoms.size(), [&](std::size_t k) {
      bottoms[k] = descended(scanned, p, std::move(bottoms[k].values), {30, 1e-6});
    });
    const double here = bottoms[0].cost;
    bottoms.erase(bottoms.begin());
    std::erase_if(bottoms, [&](const Start& s) {
      return std::abs(s.cost - here) < 1e-5 * here || s.cost > here * (1 + worth_a_fit);
    });
    keep_best(bottoms, most_valleys);
    for (const Start& s : bottoms) moved = moves_to(p, all, s.values, f) || moved;
    for (const Start& s : profiler.twins(f.model.values))
      moved = moves_to(p, all, s.values, f) || moved;

    // The lowest cells, with all samples.
    std::size_t lowest = low[0];
    for (const std::size_t i : low) {
      auto& cell = profile.cells[i];
      Start s = descended(whole, profiler.held(), cell.values, {3, 1e-6});
      cell.cost_of_all = s.cost;
      cell.values = std::move(s.values);
      if (s.cost < profile.cells[lowest].cost_of_all) lowest = i;
    }
    const auto& cell = profile.cells[lowest];
    if (cell.cost_of_all < f.solution.at.cost * (1 - lower_by))
      moved = moves_to(p, all, cell.values, f) || moved;
    if (!moved) return profile;
    profile = profiler.run(f.model.values);
  }
  return profile;
}

template Profile profile(
    const Problem&, const FitData<float>&, const FitData<float>&, const FitData<float>&, Fitted&);
template Profile profile(const Problem&,
                         const FitData<double>&,
                         const FitData<double>&,
                         const FitData<double>&,
                         Fitted&);

}  // namespace gonio
