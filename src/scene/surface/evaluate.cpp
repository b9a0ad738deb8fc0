#include "scene/surface/evaluate.h"

#include <algorithm>

#include "integrate/rule/slopes.h"

namespace gonio::scene {
namespace {

template <class F>
Evaluator<F> evaluator(const BoundModel& b, const Model& of, const Kernels<F>& k) {
  Evaluator<F> e(of, k);
  const std::vector<F> values(b.values.begin(), b.values.end());
  e.set(values);
  return e;
}

}  // namespace

template <class F>
auto SurfaceEvaluator<F>::shape_of(const BoundModel& b, const Lobe& lobe) -> Shape {
  Shape s{{lobe.ndf.term, lobe.masking.term}, {}};
  const std::array terms{&lobe.ndf, &lobe.masking};
  for (std::size_t t = 0; t < terms.size(); ++t) {
    const auto values = term_parameters(b, *terms[t], 0);
    s.parameters[t].assign(values.begin(), values.end());
  }
  return s;
}

template <class F>
SurfaceEvaluator<F>::SurfaceEvaluator(const Surface& s, const SurfaceKernels<F>& kernels)
    : kernels_(kernels) {
  const auto how = s.multiple.form;
  multiple_ = how == Form::turquin       ? kernels_.layers.turquin
              : how == Form::fdez_aguera ? kernels_.layers.fdez_aguera
              : how == Form::kulla_conty ? kernels_.layers.kulla_conty
                                         : nullptr;
  const auto& m = s.base.model;
  const bool more = !m.diffuse.empty() || m.lobes.size() > 1;
  const bool alone = multiple_ && how != Form::kulla_conty && more;
  Model under = m, lobe = m;
  lobe.diffuse.clear();
  lobe.lobes.resize(std::min<std::size_t>(lobe.lobes.size(), 1));
  if (s.spectrum) {
    const bool coupled = std::ranges::any_of(
        m.diffuse, [](const TermUse& t) { return catalogue()[t.term].coupled; });
    spectral_.emplace(
        Spectral{shape_of(s.base, m.lobes[0]), s.spectrum->template in<F>(), coupled, alone});
    under.lobes.erase(under.lobes.begin());
  } else if (alone) {
    lobe_.emplace(evaluator<F>(s.base, lobe, kernels_.terms));
  }
  if (!under.diffuse.empty() || !under.lobes.empty())
    base_.emplace(evaluator<F>(s.base, under, kernels_.terms));
  albedo_ = s.multiple.albedo.template in<F>();
  tabulated_ = s.multiple.lobe;
  std::ranges::transform(s.multiple.strength, strength_.begin(),
                         [](double x) { return static_cast<F>(x); });
  if (!s.coat) return;
  const Lobe& coat = s.coat->model.lobes[0];
  coat_.emplace(Coat{shape_of(*s.coat, coat), coat.fresnel.term, {}});
  for (std::size_t c = 0; c < max_channels; ++c) {
    const auto values = term_parameters(*s.coat, coat.fresnel, c);
    coat_->parameters[c].assign(values.begin(), values.end());
  }
}

template <class F>
const F* SurfaceEvaluator<F>::shape(const Block<F>& x, const Shape& s) {
  const auto& terms = kernels_.terms.terms;
  F *const num = scratch_[Between::first_free], *const den = scratch_[Between::first_free + 1];
  terms[s.term[0]].start_product(x, s.parameters[0].data(), {nullptr, nullptr, nullptr, num, den});
  const bool fraction = catalogue()[s.term[0]].fraction;
  terms[s.term[1]].finish_product(x, s.parameters[1].data(),
                                  {num, fraction ? den : nullptr, nullptr, num, nullptr});
  return num;
}

template <class F>
void SurfaceEvaluator<F>::add_spectral(const Block<F>& x, const Columns& out) {
  ChannelColumns<F> columns;
  columns.factor = shape(x, spectral_->shape);
  columns.out = out;
  columns.coupled = spectral_->coupled;
  if (base_) std::ranges::copy(out, columns.base.begin());
  kernels_.layers.spectral(x, spectral_->metal, columns);
  if (!spectral_->alone) return;
  columns.base = {};
  columns.out = alone();
  kernels_.layers.spectral(x, spectral_->metal, columns);
}

template <class F>
auto SurfaceEvaluator<F>::alone() -> Columns {
  Columns columns{};
  for (std::size_t c = 0; c < max_channels; ++c) columns[c] = scratch_[Between::first_free + 2 + c];
  return columns;
}

template <class F>
void SurfaceEvaluator<F>::add_multiple(const Block<F>& x, const Columns& out) {
  MultipleColumns<F> columns{{out[0], out[1], out[2]}, out};
  if (lobe_) (*lobe_)(x, alone());
  if (lobe_ || (spectral_ && spectral_->alone)) std::ranges::copy(alone(), columns.lobe.begin());
  multiple_(x, albedo_, strength_, columns);
}

template <class F>
void SurfaceEvaluator<F>::add_coat(const Block<F>& x, const Columns& out) {
  ChannelColumns<F> columns;
  columns.factor = shape(x, coat_->shape);
  columns.coupled = true;
  for (std::size_t c = 0; c < max_channels; ++c) {
    columns.base[c] = columns.out[c] = out[c];
    columns.parameters[c] = coat_->parameters[c].data();
  }
  kernels_.terms.terms[coat_->fresnel].shade[max_channels](x, columns);
}

template <class F>
void SurfaceEvaluator<F>::operator()(const Block<F>& x,
                                     std::span<F* const> out,
                                     std::span<F* const> off) {
  for (std::size_t at = 0; at < x.n; at += Between::block) {
    const auto part = x.part(at, std::min(Between::block, x.n - at));
    const Columns here{out[0] + at, out[1] + at, out[2] + at};
    Columns there{};
    if (base_) (*base_)(part, here);
    if (spectral_) add_spectral(part, here);
    if (multiple_) add_multiple(part, here);
    for (std::size_t c = 0; c < off.size(); ++c)
      there[c] = std::copy_n(here[c], part.n, off[c] + at) - part.n;
    if (tabulated_) tabulated_->add(part, here, 2, there);
    if (!coat_) continue;
    add_coat(part, here);
    if (!off.empty()) add_coat(part, there);
  }
}

template class SurfaceEvaluator<float>;
template class SurfaceEvaluator<double>;

}  // namespace gonio::scene
