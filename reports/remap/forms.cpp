// Every masking form against exact Smith: G2, E, and the roughness that it behaves like.
#include <algorithm>
#include <cmath>
#include <map>

#include "base/whole_loop.h"
#include "brdf/catalogue/masking_shape.h"
#include "brdf/catalogue/registry.h"
#include "brdf/in_number/number.h"
#include "integrate/albedo/directional_albedo.h"
#include "integrate/rule/quadrature.h"
#include "reports/remap/pairs.h"

#include <fmt/format.h>

namespace gonio::remapping {
namespace {

constexpr Goal goal{1e-6, 400'000};

std::vector<RemapForm> all_forms() {
  std::vector<RemapForm> out;
  for (std::size_t i = 0; i < catalogue().size(); ++i) {
    const auto& t = catalogue()[i];
    const std::string shape(shape_of_term(t.about->id));
    if (role_of(t.about->id) != Role::masking || t.anisotropic || shape == "gtr" ||
        shape == "student_t" || shape == "charlie")
      continue;
    const auto operations = operations_of(i).sample;
    out.push_back({std::string(t.about->id),
                   "ndf." + shape,
                   std::string(t.about->formula),
                   std::string(t.about->ships),
                   operations.total(),
                   operations[Operation::sqrt],
                   reads_half(i),
                   {}});
  }
  return out;
}

/// E at every mu, and the largest bound.
std::pair<std::vector<double>, double> albedo(std::string_view ndf,
                                              std::string_view masking,
                                              double roughness,
                                              std::span<const double> mu) {
  const auto b = bind_model(model_of_lobe(short_id(ndf), short_id(masking), "constant"),
                            {{"alpha", {roughness * roughness}}, {"f0", {1}}}, 1);
  std::pair<std::vector<double>, double> out;
  for (const auto& a : directional_albedo(b, mu, 0, goal)) {
    out.first.push_back(a.value[0]);
    out.second = std::max(out.second, a.error);
  }
  return out;
}

double rms(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

/// Gauss's nodes over both cosines, from the least on; weights sum to 1.
struct Square {
  std::vector<double> weight;
  Pairs pairs;

  static Square of(int n, std::size_t azimuths) {
    std::vector<double> c, weight;
    const auto nodes = gauss_legendre(n);
    for (const auto& x : nodes) c.push_back(remap_least_cosine + (1 - remap_least_cosine) * x.x);
    for (const auto& x : nodes)
      for (const auto& y : nodes) weight.push_back(x.weight * y.weight);
    return {std::move(weight), Pairs(all_pairs(c), azimuths)};
  }
  struct Difference {
    double rms, mean;
  };
  Difference difference(std::span<const double> a, std::span<const double> b) const {
    Difference d{0, 0};
    for (std::size_t i = 0; i < a.size(); ++i) {
      d.mean += weight[i] * (a[i] - b[i]);
      d.rms += weight[i] * (a[i] - b[i]) * (a[i] - b[i]);
    }
    return {std::sqrt(d.rms), d.mean};
  }
};

/// Roughnesses among which the nearest is looked for, from the least that is legal.
std::vector<double> grid(double step) {
  std::vector<double> out{0.01};
  for (double r = step; r < 1 + step / 2; r += step) out.push_back(std::min(r, 1.0));
  return out;
}

/// Exact Smith under its own distribution: E over roughness, between whose steps it is a line.
class Reference {
 public:
  Reference(const std::string& ndf, std::string id, double step, std::span<const double> mu)
      : id_(std::move(id)), term_(find_term(id_)), grid_(grid(step)), albedo_(grid_.size()) {
    for_each_whole(grid_.size(),
                   [&](std::size_t i) { albedo_[i] = albedo(ndf, id_, grid_[i], mu).first; });
  }
  const std::string& id() const { return id_; }
  std::size_t term() const { return term_; }

  NearestRoughness by_albedo(std::span<const double> of) const {
    return nearest([&](double r) { return rms(of, at(r)); }, grid_);
  }
  /// Roughness by its masking alone.
  NearestRoughness by_g2(std::span<const double> of, const Square& s) const {
    static const auto coarse = grid(0.05);
    const auto off = [&](double r) { return s.difference(of, mean_g2(term_, r, s.pairs)).rms; };
    return nearest(off, coarse);
  }

 private:
  std::vector<double> at(double r) const {
    const auto after =
        std::clamp<std::ptrdiff_t>(std::ranges::upper_bound(grid_, r) - grid_.begin(), 1,
                                   static_cast<std::ptrdiff_t>(grid_.size()) - 1);
    const auto i = static_cast<std::size_t>(after);
    const double t = (r - grid_[i - 1]) / (grid_[i] - grid_[i - 1]);
    std::vector<double> out;
    for (std::size_t m = 0; m < albedo_[i].size(); ++m)
      out.push_back(std::lerp(albedo_[i - 1][m], albedo_[i][m], t));
    return out;
  }

  std::string id_;
  std::size_t term_;
  std::vector<double> grid_;
  std::vector<std::vector<double>> albedo_;
};

/// Both cosines in even steps, both ends among them.
Pairs even_pairs(std::size_t azimuths) {
  std::vector<double> c;
  for (int i = 2; i <= 40; ++i) c.push_back(i * 0.025);
  return {all_pairs(c), azimuths};
}

/// Places that all forms are compared over.
struct Places {
  explicit Places(std::size_t azimuths)
      : fine(Square::of(24, azimuths)),
        coarse(Square::of(16, azimuths)),
        even(even_pairs(azimuths)) {}
  Square fine, coarse;
  Pairs even;
};

RemapRow compare(const RemapForm& f,
                 const RemapForm::At& at,
                 const Reference& reference,
                 const Places& places,
                 std::span<const double> mu) {
  const std::size_t term = find_term(f.form);
  const double r = at.roughness;
  RemapRow row{};
  row.form = f.form, row.reference = reference.id(), row.roughness = r;

  const auto over = [&](const Pairs& p) {
    return std::pair(mean_g2(term, r, p), mean_g2(reference.term(), r, p));
  };
  const auto [fine, exact] = over(places.fine.pairs);
  const auto [again, exact_again] = over(places.coarse.pairs);
  const auto d = places.fine.difference(fine, exact);
  row.rms = d.rms, row.bias = d.mean;
  row.rms_error = std::abs(d.rms - places.coarse.difference(again, exact_again).rms);

  const auto& pairs = places.even;
  const auto [g, smith] = over(pairs);
  for (std::size_t i = 0; i < g.size(); ++i)
    if (const double off = std::abs(g[i] / smith[i] - 1); i == 0 || off > row.max_rel)
      row.max_rel = off, row.max_rel_nol = pairs.cosines()[i].nol,
      row.max_rel_nov = pairs.cosines()[i].nov;

  const auto half = static_cast<std::size_t>(std::ranges::find(mu, 0.5) - mu.begin());
  const auto [e, error] = albedo(f.ndf, reference.id(), r, mu.subspan(half, 1));
  row.albedo = at.albedo[half], row.albedo_reference = e[0], row.albedo_error = at.error + error;
  row.by_g2 = reference.by_g2(fine, places.fine);
  row.by_albedo = reference.by_albedo(at.albedo);
  return row;
}

}  // namespace

MeasuredForms measured_forms(const RemapOptions& o,
                             std::span<const double> mu,
                             std::span<const double> cosines,
                             const std::function<void(double)>& done) {
  MeasuredForms out{all_forms(), {}};
  if (!o.forms.empty())
    std::erase_if(out.forms, [&](const RemapForm& f) {
      return std::ranges::find(o.forms, f.form) == o.forms.end();
    });
  const Places places(o.azimuths);
  const Pairs map(all_pairs(cosines), o.azimuths);
  std::map<std::string, Reference> references;
  for (const auto& f : out.forms)
    for (const auto& id : references_of(f.ndf))
      if (!references.contains(id)) references.emplace(id, Reference(f.ndf, id, o.step, mu));

  std::size_t finished = 0;
  for (auto& f : out.forms) {
    const std::size_t n = o.roughness.size(), before = out.rows.size();
    f.at.resize(n);
    out.rows.resize(before + 2 * n);
    for_each_whole(n, [&](std::size_t i) {
      const double r = o.roughness[i];
      auto [e, error] = albedo(f.ndf, f.form, r, mu);
      f.at[i] = {r, std::move(e), error, {}};
      if (std::ranges::find(o.shown, r) != o.shown.end())
        f.at[i].g2 = mean_g2(find_term(f.form), r, map);
      const auto ids = references_of(f.ndf);
      for (std::size_t k = 0; k < 2; ++k)
        out.rows[before + k * n + i] = compare(f, f.at[i], references.at(ids[k]), places, mu);
    });
    done(static_cast<double>(++finished) / static_cast<double>(out.forms.size()));
  }
  return out;
}

}  // namespace gonio::remapping
