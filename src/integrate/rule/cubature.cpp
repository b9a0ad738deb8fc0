#include "integrate/rule/cubature.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace gonio {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Kronrod's 15 nodes on [−1, 1] ascending, their weights, those of the 7 Gauss nodes among them (0 at
/// the others) [Piessens et al. 1983, QUADPACK, QK15], and those of the 8 others, exact to degree 7.
struct Rule {
  std::array<double, line_nodes> x, kronrod, gauss, others;
};
constexpr Rule make_rule() {
  constexpr std::array x{0.991455371120812639206854697526329, 0.949107912342758524526189684047851,
                         0.864864423359769072789712788640926, 0.741531185599394439863864773280788,
                         0.586087235467691130294144838258730, 0.405845151377397166906606412076961,
                         0.207784955007898467600689403773245, 0.0};
  constexpr std::array k{0.022935322010529224963732008058970, 0.063092092629978553290700663189204,
                         0.104790010322250183839876322541518, 0.140653259715525918745189590510238,
                         0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
                         0.204432940075298892414161999234649, 0.209482141084727828012999174891714};
  constexpr std::array g{0.129484966168869693270611432679082, 0.279705391489276667901467771423780,
                         0.381830050505118944950369775488975, 0.417959183673469387755102040816327};
  constexpr std::array o{0.0437879149922332667406576310189704, 0.209136164496178001188554155217948,
                         0.338314908133113070265386801127759, 0.408761012378475661805401412635322};
  Rule r{};
  for (std::size_t i = 0; i < 8; ++i) {
    const std::size_t mirror = line_nodes - 1 - i;
    r.x[i] = -x[i];
    r.x[mirror] = x[i];
    r.kronrod[i] = r.kronrod[mirror] = k[i];
    r.gauss[i] = r.gauss[mirror] = i % 2 ? g[i / 2] : 0;
    r.others[i] = r.others[mirror] = i % 2 ? 0 : o[i / 2];
  }
  return r;
}
constexpr Rule rule = make_rule();

/// A rectangle with what is known of it.
struct Part {
  Rectangle r;
  std::array<double, 2> error{};  ///< along each axis; the largest of the functions'
  double absolute = 0;            ///< ∫|f|, the largest of the functions'
  double parent = infinity;       ///< that of what it is a half of
  double inherited = 0;           ///< the least error, after a kink in what it is a half of
  bool kink = false;
  int splits = 0;
  double sum_error() const { return std::max(error[0] + error[1], inherited); }
};

/// Rectangles are not split further: they are 2⁻⁵⁰ of those given.
constexpr int most_splits = 50;

/// Rounding that sums and products of so much may have suffered.
double rounding_of(double absolute) {
  return 64 * std::numeric_limits<double>::epsilon() * absolute;
}

struct Sums {
  const Integrand& f;
  std::size_t functions;
  bool plane;
  std::vector<Part> parts;
  std::vector<double> values;  ///< [part][function]
  std::size_t evaluations = 0;
  std::vector<double> x, y, column;
  std::vector<double*> out;

  std::size_t lines() const { return plane ? line_nodes : 1; }
  std::size_t nodes() const { return lines() * line_nodes; }

  /// f over parts [first, end), in columns of bounded length.
  void evaluate(std::size_t first) {
    constexpr std::size_t at_once = 16;
    values.resize(parts.size() * functions);
    for (; first < parts.size(); first += at_once)
      evaluate(first, std::min(parts.size(), first + at_once));
  }

  void evaluate(std::size_t first, std::size_t end) {
    const std::size_t n = (end - first) * nodes();
    x.clear();
    y.clear();
    for (std::size_t p = first; p < end; ++p) {
      const auto& [low, high] = parts[p].r;
      for (std::size_t j = 0; j < lines(); ++j) {
        const double at = plane ? rule.x[j] : 0;
        y.push_back((low[1] + high[1]) / 2 + (high[1] - low[1]) / 2 * at);
        for (std::size_t i = 0; i < line_nodes; ++i)
          x.push_back((low[0] + high[0]) / 2 + (high[0] - low[0]) / 2 * rule.x[i]);
      }
    }
    if (column.size() < n * functions) column.resize(n * functions);
    out.clear();
    for (std::size_t c = 0; c < functions; ++c) out.push_back(column.data() + c * n);
    f(x, y, out);
    evaluations += n;
    for (std::size_t p = first; p < end; ++p)
      for (std::size_t c = 0; c < functions; ++c) add(p, c, out[c] + (p - first) * nodes());
  }

  void add(std::size_t index, std::size_t function, const double* f_at) {
    Part& p = parts[index];
    const double half_x = (p.r.high[0] - p.r.low[0]) / 2;
    const double area = plane ? half_x * (p.r.high[1] - p.r.low[1]) / 2 : half_x;
    double best = 0, absolute = 0;
    std::array<double, 2> gauss{}, others{};  // along each axis, Kronrod along the other one
    for (std::size_t j = 0; j < lines(); ++j) {
      double k = 0, g = 0, o = 0, a = 0;
      for (std::size_t i = 0; i < line_nodes; ++i) {
        const double v = f_at[j * line_nodes + i];
        k += rule.kronrod[i] * v;
        g += rule.gauss[i] * v;
        o += rule.others[i] * v;
        a += rule.kronrod[i] * std::abs(v);
      }
      const double w = plane ? rule.kronrod[j] : 1;
      best += w * k;
      absolute += w * a;
      gauss[0] += w * g;
      others[0] += w * o;
      gauss[1] += (plane ? rule.gauss[j] : 1) * k;
      others[1] += (plane ? rule.others[j] : 1) * k;
    }
    values[index * functions + function] = best * area;
    const auto worst = [](double& to, double v) {
      if (!(v <= to)) to = v;  // keeps a NaN
    };
    // The two rules may agree by chance where neither sees the function; the third then does not.
    // Of a smooth function it is off by far more than they are; where it is not there is a kink, of
    // which the nodes may see a part alone.
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double finer = std::abs(best - gauss[axis]), coarser = std::abs(best - others[axis]);
      const bool kink = 10 * finer > coarser;
      p.kink |= kink;
      worst(p.error[axis], area * std::max(kink ? 4 * std::max(finer, coarser) : finer,
                                           coarser * coarser / std::max(absolute, 1e-300)));
    }
    worst(p.absolute, absolute * area);
  }
};

}  // namespace

Integral integrate(const Integrand& f,
                   std::size_t functions,
                   std::vector<Rectangle> rectangles,
                   const Goal& goal) {
  Sums s{f, functions, false, {}, {}, 0, {}, {}, {}, {}};
  for (const auto& r : rectangles) {
    s.plane |= r.low[1] < r.high[1];
    s.parts.push_back({r});
  }
  s.evaluate(0);
  std::vector<std::size_t> order;
  for (;;) {
    Integral total{std::vector<double>(functions), 0, s.evaluations};
    double absolute = 0;
    bool divergent = false, finite = true;
    for (std::size_t p = 0; p < s.parts.size(); ++p) {
      const Part& part = s.parts[p];
      for (std::size_t c = 0; c < functions; ++c) total.value[c] += s.values[p * functions + c];
      total.error += part.sum_error();
      absolute += part.absolute;
      finite &= std::isfinite(part.absolute);
      divergent |= part.splits >= most_splits && part.absolute >= 0.999 * part.parent &&
                   part.sum_error() > goal.error;
    }
    const double rounding = rounding_of(absolute);
    if (!finite || divergent) {
      for (auto& v : total.value)
        v = finite ? std::copysign(infinity, v) : std::numeric_limits<double>::quiet_NaN();
      total.error = infinity;
      return total;
    }

    // The fewest parts without which the error would be half of what is asked for.
    order.resize(s.parts.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::erase_if(order, [&](std::size_t p) {
      // what is left there is rounding
      const Part& part = s.parts[p];
      return part.splits >= most_splits || !(part.sum_error() > rounding_of(part.absolute));
    });
    std::ranges::stable_sort(order, std::greater{},
                             [&](std::size_t p) { return s.parts[p].sum_error(); });
    const std::size_t room =
        goal.evaluations > s.evaluations ? (goal.evaluations - s.evaluations) / (2 * s.nodes()) : 0;
    double left = total.error;
    std::size_t chosen = 0;
    while (chosen < order.size() && left > goal.error / 2)
      left -= s.parts[order[chosen++]].sum_error();
    chosen = std::min(chosen, room);
    if (total.error <= std::max(goal.error, rounding) || chosen == 0) {
      total.error += rounding;
      return total;
    }
    // Halves of what was split stand at the end, to be evaluated together.
    order.resize(chosen);
    std::ranges::sort(order);
    std::vector<Part> halves;
    std::vector<double> kept;
    std::size_t next = 0, to = 0;
    for (std::size_t p = 0; p < s.parts.size(); ++p) {
      if (next < order.size() && order[next] == p) {
        ++next;
        const Part& whole = s.parts[p];
        const std::size_t axis = whole.error[1] > whole.error[0] ? 1 : 0;
        Part a{whole.r, {}, 0, whole.absolute, 0, false, whole.splits + 1};
        if (whole.kink) a.inherited = whole.sum_error() / 1024;
        Part b = a;
        a.r.high[axis] = b.r.low[axis] = (whole.r.low[axis] + whole.r.high[axis]) / 2;
        halves.insert(halves.end(), {a, b});
        continue;
      }
      for (std::size_t c = 0; c < functions; ++c)
        s.values[to * functions + c] = s.values[p * functions + c];
      s.parts[to++] = s.parts[p];
    }
    s.parts.resize(to);
    s.parts.insert(s.parts.end(), halves.begin(), halves.end());
    s.evaluate(to);
  }
}

}  // namespace gonio
