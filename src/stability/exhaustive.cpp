#include "stability/exhaustive.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <vector>

#include "base/error.h"
#include "brdf/model/evaluate.h"
#include "stability/evaluate.h"
#include "stability/places.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace gonio::stability {
namespace {

constexpr std::size_t angles = 11, chunk = 1024;

constexpr std::size_t padded_size(std::size_t n) {
  return (n + padding - 1) / padding * padding;
}
template <class F>
std::vector<Column<F>> columns_of(std::size_t count, std::size_t n) {
  std::vector<Column<F>> all;
  for (std::size_t k = 0; k < count; ++k) all.emplace_back(n);
  return all;
}

/// Halves of a range, all of them, ascending, from the one next to its lower end to the one next to its upper.
std::vector<double> halves_within(const Range& range) {
  std::vector<double> all;
  const auto places = places_within(Number::half, range, true);
  for (auto p = places.first; p <= places.last; ++p) all.push_back(at_place(Number::half, p, true));
  return all;
}

/// Inputs that are walked over: rows of columns, one of the inputs each, the others fixed.
struct Walk {
  std::vector<std::vector<double>> values;  ///< of each input
  std::size_t row = 0, column = 0;          ///< inputs; none: values.size()
};
std::optional<Walk> walk_of(const Subject& s) {
  Walk w;
  std::vector<std::size_t> free_angles, free_parameters;
  for (std::size_t k = 0; k < s.inputs.size(); ++k) {
    w.values.push_back(halves_within(s.inputs[k].domain));
    if (w.values[k].size() > 1) (k < s.parameters ? free_parameters : free_angles).push_back(k);
  }
  if (!s.term || free_parameters.size() > 1 || free_parameters.size() + free_angles.size() > 2)
    return {};
  w.row = w.column = s.inputs.size();
  if (!free_angles.empty()) w.column = free_angles.back();
  if (!free_parameters.empty()) w.row = free_parameters[0];
  if (free_angles.size() > 1) w.row = free_angles[0];
  return w;
}

/// Buffers of one thread, and a row's values in them.
class Rows {
 public:
  Rows(const Subject& s, const Walk& walk, const HalfRules& rules, const Formula& formula)
      : s_(s),
        walk_(walk),
        rules_(index_of(rules)),
        formula_(formula),
        n_(walk.column < walk.values.size() ? walk.values[walk.column].size() : 1),
        padded_(padded_size(n_)),
        half_in_(columns_of<float>(s.inputs.size() - s.parameters, padded_)),
        double_in_(columns_of<double>(half_in_.size(), padded_)),
        half_angles_(columns_of<float>(angles, padded_)),
        double_angles_(columns_of<double>(angles, padded_)),
        got_(padded_),
        want_(padded_) {
    for (std::size_t k = 0; k < half_in_.size(); ++k) {
      const auto& values = walk.values[s.parameters + k];
      fill(k, values[0]);
      if (s.parameters + k != walk.column) continue;
      for (std::size_t i = 0; i < n_; ++i) {
        half_in_[k].data()[i] = static_cast<float>(values[i]);
        double_in_[k].data()[i] = values[i];
      }
    }
    find_angles();
  }

  /// Values of row r, in halves and in double; beyond the column's end 0 and NaN, of which nothing is asked.
  void evaluate(std::size_t r) {
    std::array<float, most_parameters> half_parameters{};
    std::array<double, most_parameters> double_parameters{};
    const auto at = inputs(r, 0);
    for (std::size_t k = 0; k < s_.parameters; ++k) {
      half_parameters[k] = static_cast<float>(at[k]);
      double_parameters[k] = at[k];
    }
    if (walk_.row < at.size() && walk_.row >= s_.parameters) {
      fill(walk_.row - s_.parameters, at[walk_.row]);
      find_angles();
    }
    for (std::size_t first = 0; first < padded_; first += chunk) {
      const std::size_t n = std::min(chunk, padded_ - first);
      formula_.halves(block(half_angles_).part(first, n), half_parameters.data(),
                      got_.data() + first);
      formula_.doubles(block(double_angles_).part(first, n), double_parameters.data(),
                       want_.data() + first);
    }
    std::fill(got_.data() + n_, got_.data() + padded_, 0.0F);
    std::fill(want_.data() + n_, want_.data() + padded_, std::numeric_limits<double>::quiet_NaN());
  }

  std::size_t columns() const { return n_; }
  std::size_t padded() const { return padded_; }
  const float* got() const { return got_.data(); }
  const double* want() const { return want_.data(); }

  /// True where the value next to column i goes the other way than it should.
  bool goes_astray(std::size_t i) const {
    const float x = got()[i], y = got()[i + 1];
    const double f = want()[i], g = want()[i + 1];
    return bool((x < y) & (g < f)) | bool((y < x) & (f < g));
  }

  /// Inputs at row r and column c.
  std::vector<double> inputs(std::size_t r, std::size_t c) const {
    std::vector<double> in;
    for (std::size_t k = 0; k < walk_.values.size(); ++k)
      in.push_back(walk_.values[k][k == walk_.row ? r : k == walk_.column ? c : 0]);
    return in;
  }

 private:
  void fill(std::size_t angle, double x) {
    std::fill_n(half_in_[angle].data(), padded_, static_cast<float>(x));
    std::fill_n(double_in_[angle].data(), padded_, x);
  }
  void find_angles() {
    const auto& kernel = half_kernels();
    const auto find = [&](const auto& columns, auto& out, auto&& compute) {
      using F = std::remove_const_t<std::remove_pointer_t<decltype(columns[0].data())>>;
      std::vector<const F*> in;
      AngleColumns<F> to;
      for (const auto& c : columns) in.push_back(c.data());
      for (std::size_t k = 0; k < angles; ++k) to[k] = out[k].data();
      compute(s_.given, padded_, std::span<const F* const>(in), to);
    };
    find(half_in_, half_angles_, kernel.angles[rules_]);
    find(double_in_, double_angles_, kernel.double_angles);
  }
  template <class F>
  Block<F> block(const std::vector<Column<F>>& a) const {
    return {a[0].data(),
            a[1].data(),
            a[2].data(),
            a[3].data(),
            a[4].data(),
            padded_,
            {a[5].data(), a[6].data(), a[7].data(), a[8].data(), a[9].data(), a[10].data()}};
  }

  const Subject& s_;
  const Walk& walk_;
  std::size_t rules_;
  const Formula& formula_;
  std::size_t n_, padded_;
  std::vector<Column<float>> half_in_;
  std::vector<Column<double>> double_in_;
  std::vector<Column<float>> half_angles_;
  std::vector<Column<double>> double_angles_;
  Column<float> got_;
  Column<double> want_;
};

/// A result compared on its own.
Compared compared(double got, double want, const Tolerance& tolerance) {
  alignas(64) std::array<float, padding> x{};
  alignas(64) std::array<double, padding> f;
  f.fill(std::numeric_limits<double>::quiet_NaN());
  x[0] = static_cast<float>(got);
  f[0] = want;
  Compared c;
  half_kernels().compare(padding, x.data(), f.data(), tolerance, c);
  return c;
}

}  // namespace

Formula formula_of(std::size_t term, const HalfRules& rules, std::string_view instruction_set) {
  const HalfColumn in_halves = half_kernels(instruction_set).terms[term][index_of(rules)];
  const auto in_double = kernels<double>(instruction_set).terms[term].add_product;
  struct Constants {
    Column<double> none{chunk}, one{chunk, 1};
  };
  return {in_halves, [=, of = std::make_shared<const Constants>()](
                         const Block<double>& x, const double* parameters, double* out) {
            for (std::size_t first = 0; first < x.n; first += chunk)
              in_double(x.part(first, std::min(chunk, x.n - first)), parameters,
                        {of->one.data(), nullptr, of->none.data(), out + first, nullptr});
          }};
}

bool can_be_exhausted(const Subject& s) {
  return walk_of(s).has_value();
}

Looked exhaustive(const Subject& s,
                  const HalfRules& rules,
                  const Tolerance& tolerance,
                  const Formula* formula) {
  const auto walk = walk_of(s);
  if (!walk)
    throw wrong_usage(
        fmt::format("{}: too many inputs for all halves; expected at most two that are not fixed, "
                    "one of them a parameter",
                    s.id));
  const Formula own = formula ? *formula : formula_of(*s.term, rules);
  const std::size_t rows = walk->row < s.inputs.size() ? walk->values[walk->row].size() : 1;
  std::vector<Compared> by_row(rows);
  std::vector<std::uint64_t> astray(rows);  // not monotone where f is
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rows, 64), [&](const auto& part) {
    Rows evaluated(s, *walk, rules, own);
    for (std::size_t r = part.begin(); r != part.end(); ++r) {
      evaluated.evaluate(r);
      half_kernels().compare(evaluated.padded(), evaluated.got(), evaluated.want(), tolerance,
                             by_row[r]);
      for (std::size_t i = 0; i + 1 < evaluated.columns(); ++i)
        astray[r] += evaluated.goes_astray(i) ? 1 : 0;
    }
  });

  Looked found;
  found.evidence = Evidence::exhaustive;
  found.tolerance = tolerance;
  Rows again(s, *walk, rules, own);
  found.evaluations = rows * again.columns();

  // Where: the first of each count, in the order of rows and columns.
  const auto count = [&](Count& c, std::uint64_t Compared::*what) {
    for (std::size_t r = 0; r < rows; ++r) {
      if (by_row[r].*what == 0) continue;
      c.count += by_row[r].*what;
      if (!c.first.empty()) continue;
      again.evaluate(r);
      for (std::size_t i = 0; i < again.columns() && c.first.empty(); ++i)
        if (compared(static_cast<double>(again.got()[i]), again.want()[i], tolerance).*what > 0)
          c.first = again.inputs(r, i);
    }
  };
  for (std::size_t r = 0; r < rows; ++r) {
    if (astray[r] > 0 && found.not_monotone.count == 0) {
      again.evaluate(r);
      std::size_t i = 0;
      while (!again.goes_astray(i)) ++i;
      found.not_monotone.first = again.inputs(r, i);
    }
    found.not_monotone.count += astray[r];
  }
  count(found.no_value, &Compared::no_value);
  count(found.negative, &Compared::negative);
  count(found.overflow, &Compared::overflow);
  count(found.vanished, &Compared::vanished);
  count(found.undefined, &Compared::undefined);
  count(found.negative_too, &Compared::negative_too);
  count(found.lost, &Compared::beyond_tolerance);

  // The worst: by rows, those that claim most first, until none can claim more than what is
  // confirmed.
  const auto worst = [&](Worst& w, double Compared::*what, std::size_t most, auto&& look) {
    std::vector<std::size_t> order(rows);
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::stable_sort(order, std::greater<>(), [&](auto r) { return by_row[r].*what; });
    for (std::size_t k = 0; k < std::min(rows, most) && by_row[order[k]].*what > 0; ++k) {
      again.evaluate(order[k]);
      std::size_t at = 0;
      double largest = -1;
      for (std::size_t i = 0; i < again.columns(); ++i)
        if (const double x =
                compared(static_cast<double>(again.got()[i]), again.want()[i], tolerance).*what;
            x > largest) {
          largest = x;
          at = i;
        }
      const auto in = again.inputs(order[k], at);
      const double confirmed = look(in, static_cast<double>(again.got()[at]), largest);
      if (confirmed > w.value) w = {confirmed, in};
      if (k + 1 < rows && most == rows && w.value >= by_row[order[k + 1]].*what) break;
    }
  };
  const auto ulp_of = [](const WideValue& f) {
    return std::ldexp(1, std::max(std::ilogb(f.value), -14) - 10);
  };
  const auto error_in_ulp = [&](const WideValue& f, double x) {
    return std::abs((x - f.value) - f.rest) / ulp_of(f);
  };
  worst(found.relative, &Compared::relative, rows, [&](const auto& in, double x, double claimed) {
    return formula ? claimed : truth_of(s, in).relative_error(x);
  });
  worst(found.ulp, &Compared::ulp, rows, [&](const auto& in, double x, double claimed) {
    return formula ? claimed : error_in_ulp(truth_of(s, in), x);
  });
  if (!formula) {
    if (!found.relative.at.empty()) {
      half_flags = {};
      value_of(s, {Number::half, rules.flush, rules.contract}, found.relative.at);
      found.flags = half_flags;
    }
    if (!found.ulp.at.empty()) found.condition = truth_of(s, found.ulp.at).condition;
    worst(found.beyond, &Compared::ulp, std::min<std::size_t>(rows, 256),
          [&](const auto& in, double x, double) {
            const auto f = truth_of(s, in);
            return error_in_ulp(f, x) / std::max(1.0, f.condition);
          });
  }

  if (s.decides && walk->row == *s.decides) {
    const auto from = [&](auto&& is_broken) -> std::optional<double> {
      // From the wide end.
      const auto at = [&](std::size_t k) { return s.narrows ? k : rows - 1 - k; };
      std::size_t safe = 0;
      while (safe < rows && !is_broken(by_row[at(safe)])) ++safe;
      return safe > 0 ? std::optional(walk->values[walk->row][at(safe - 1)]) : std::nullopt;
    };
    const auto has_none = [](const Compared& c) {
      return c.no_value + c.overflow + c.undefined > 0;
    };
    found.finite_from = from(has_none);
    found.nonnegative_from =
        from([&](const Compared& c) { return has_none(c) || c.negative + c.negative_too > 0; });
    found.safe_from =
        from([&](const Compared& c) { return has_none(c) || c.beyond_tolerance > 0; });
  }
  return found;
}

}  // namespace gonio::stability
