#include "scene/plan/cost.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include "brdf/cost/model_operations.h"
#include "number/counted.h"
#include "scene/kernel/multiple.h"

namespace gonio::scene {
namespace {

using C = Counted<double>;
constexpr std::size_t most_rows = 2048;  ///< that stay in a core's cache

Operations of_multiple(const MultipleScattering& m) {
  const auto curve = m.albedo.in<C>();
  const C nol(0.5), nov(0.6), one(1.0), half(0.5);
  return count_operations([&] {
    if (m.form == Form::uncompensated) return;
    if (m.form == Form::tabulated) {
      // Three coordinates or four by logarithms, four nodes along each, and at each of these places
      // the product of their shares, times three channels.  What is fetched counts nothing.
      const std::size_t axes = m.lobe->anisotropic() ? 4 : 3;
      for (std::size_t k = 0; k < axes; ++k) {
        static_cast<void>(log(half + sqrt(half * half + one)) / one);
        static_cast<void>(sqrt((one - nol * nol) * (one - nov * nov)) / one);
        for (int node = 0; node < 4; ++node)
          static_cast<void>(((half * nol + one) * nol + half) * nol);
      }
      for (std::size_t place = 0; place < std::size_t{1} << (2 * axes); ++place) {
        for (std::size_t k = 1; k < axes; ++k) static_cast<void>(half * nol);
        for (std::size_t c = 0; c < max_channels; ++c) static_cast<void>(one + half * nol);
      }
      return;
    }
    if (m.form == Form::kulla_conty) {
      const C lost = lost_to_bounces(curve, nol, nov);
      for (std::size_t c = 0; c < max_channels; ++c)
        static_cast<void>(one + added_by_kulla_conty(half, lost));
      return;
    }
    const C e = value_at(curve, nov);
    for (std::size_t c = 0; c < max_channels; ++c)
      static_cast<void>(one + (m.form == Form::turquin ? added_by_turquin(one, e, half)
                                                       : added_by_fdez_aguera(one, e, half)));
  });
}

/// True of a compensation that needs the first lobe by itself.
bool is_brightened(const MultipleScattering& m) {
  return m.form == Form::turquin || m.form == Form::fdez_aguera;
}

/// What Fresnel's equations of every band cost more than those of three channels.
Operations of_spectrum(const SpectralMetal<double>& m) {
  const SpectralReflectance<C> f(m.in<C>());
  return count_operations([&] { static_cast<void>(f(C(0.5))); });
}
Operations of_channels() {
  const std::array p{C(0.2), C(3.0)};
  const Conductor<C> f(p);
  const C c(0.5);
  return count_operations([&] {
    for (std::size_t i = 0; i < max_channels; ++i) static_cast<void>(f({c, c, c, c, c}).value());
  });
}

Operations of_lookups(const ImageLit& lit) {
  const LookedUp<C> at{C(0.5),
                       {C(1), C(1), C(1)},
                       {C(1), C(1), C(1)},
                       {C(1), C(1), C(1)},
                       C(0.8),
                       C(0.1),
                       C(0.8),
                       C(0.1),
                       C(0.9)};
  return count_operations([&] { static_cast<void>(image_lit(lit.parts(), at)); });
}

/// Share of a row, of n, that is evaluated, and points that are looked up.
struct Looking {
  std::size_t rows, points;
};
Looking looking(const Surface& s, const LitPoints& p, std::size_t n) {
  if (!s.image_lit || p.point.empty()) return {n, 0};
  const double per_row = static_cast<double>(n) / static_cast<double>(p.point.size());
  const auto rows = static_cast<double>(p.sky) * per_row,
             points = static_cast<double>(p.count) * per_row;
  return {static_cast<std::size_t>(std::lround(rows)),
          std::clamp<std::size_t>(static_cast<std::size_t>(std::lround(points)), 1, p.count)};
}

/// Work that a timing repeats.
template <class F>
std::function<void()> work(const Surface& s,
                           const Block<F>& all,
                           const Looking& looking,
                           std::span<const SkyView> views) {
  const auto x = all.part(0, (looking.rows + padding - 1) / padding * padding);
  struct State {
    SurfaceEvaluator<F> evaluate;
    std::vector<Column<F>> f;
    std::array<F*, max_channels> out{};
    std::vector<Rgb> looked_up;
  };
  auto state = std::make_shared<State>(
      State{SurfaceEvaluator<F>(s, SurfaceKernels<F>::composed()), {}, {}, {}});
  for (std::size_t c = 0; c < max_channels; ++c)
    state->out[c] = state->f.emplace_back(Column<F>(std::max(x.n, padding))).data();
  const auto seen = views.first(looking.points);
  state->looked_up.resize(seen.size());
  return [state, x, seen, lit = s.image_lit] {
    if (x.n > 0) state->evaluate(x, state->out);
    if (lit) std::ranges::transform(seen, state->looked_up.begin(), std::cref(*lit));
  };
}

double operations_of_row(const Surface& s) {
  Operations sum = gonio::operations_of(s.base.model);
  sum += of_multiple(s.multiple);
  if (is_brightened(s.multiple) &&
      (!s.base.model.diffuse.empty() || s.base.model.lobes.size() > 1)) {
    Model lobe = s.base.model;  // evaluated once more, alone
    lobe.diffuse.clear();
    lobe.lobes.resize(1);
    sum += gonio::operations_of(lobe);
  }
  if (s.coat) {
    sum += gonio::operations_of(s.coat->model);
    sum[Operation::add] += 2 * max_channels;  // on all that is below
  }
  auto total = static_cast<double>(sum.total());
  if (s.spectrum)
    total += static_cast<double>(of_spectrum(*s.spectrum).total()) -
             static_cast<double>(of_channels().total());
  return total;
}

}  // namespace

double operations_of(const Surface& s, const LitPoints& p) {
  const double row = operations_of_row(s);
  if (!s.image_lit || p.point.empty()) return row;
  const auto rows = static_cast<double>(p.point.size());
  return row * static_cast<double>(p.sky) / rows +
         static_cast<double>(of_lookups(*s.image_lit).total()) * static_cast<double>(p.count) /
             rows;
}

bool are_too_near(const Timing& a, const Timing& b) {
  return std::abs(a.ns - b.ns) <= 2 * (a.spread_ns + b.spread_ns);
}

bool is_as_fast(double speedup) {
  return are_too_near({speedup, least_spread * speedup}, {1, least_spread});
}

std::vector<Timing> times_of(std::span<const Surface> surfaces, const LitPoints& points) {
  // Where no light comes to any point, angles like any others.
  const std::vector<FrameAngles<double>> dark(
      most_rows, {{0.5, 0.6, 0.9, 0.7, 0.19}, 0.3, 0.3, 0.1, 0.2, 0.3, 0.4});
  const auto& rows = points.angles.empty() ? dark : points.angles;
  const std::size_t n = std::min(rows.size(), most_rows);
  const LitColumns columns(std::span<const FrameAngles<double>>(rows).first(n));
  std::vector<Timed> timed;
  for (const auto& s : surfaces)
    timed.push_back(
        {n, s.single ? work<float>(s, columns.narrow.block(), looking(s, points, n), points.view)
                     : work<double>(s, columns.wide.block(), looking(s, points, n), points.view)});
  TimingOptions options;
  options.repetitions = 9;
  options.seconds = 1e-4;
  options.of_thread = true;
  return time_all(timed, options);
}

}  // namespace gonio::scene
