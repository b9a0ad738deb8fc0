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
SurfaceEvaluator<F>::SurfaceEvaluator(const Surface& s, const SurfaceKernels<F>& kernels)
    : kernels_(kernels), base_(evaluator<F>(s.base, s.base.model, kernels_.terms)) {
  const auto how = forms_of(Effect::compensation)[s.multiple.form];
  multiple_ = how == "turquin"       ? kernels_.layers.turquin
              : how == "fdez_aguera" ? kernels_.layers.fdez_aguera
              : how == "kulla_conty" ? kernels_.layers.kulla_conty
                                     : nullptr;
  const auto& m = s.base.model;
  const bool more = !m.diffuse.empty() || m.lobes.size() > 1;
  if (multiple_ && how != "kulla_conty" && more) {
    Model lobe = m;
    lobe.diffuse.clear();
    lobe.lobes.resize(1);
    lobe_.emplace(evaluator<F>(s.base, lobe, kernels_.terms));
  }
  albedo_ = s.multiple.albedo.template in<F>();
  std::ranges::transform(s.multiple.strength, strength_.begin(),
                         [](double x) { return static_cast<F>(x); });
  if (!s.coat) return;
  const Lobe& lobe = s.coat->model.lobes[0];
  const std::array terms{&lobe.ndf, &lobe.masking, &lobe.fresnel};
  auto& coat = coat_.emplace();
  for (std::size_t t = 0; t < terms.size(); ++t) {
    coat.term[t] = terms[t]->term;
    for (std::size_t c = 0; c < max_channels; ++c) {
      const auto values = term_parameters(*s.coat, *terms[t], c);
      coat.parameters[t][c].assign(values.begin(), values.end());
    }
  }
}

template <class F>
void SurfaceEvaluator<F>::add_multiple(const Block<F>& x, const std::array<F*, max_channels>& out) {
  MultipleColumns<F> columns{{out[0], out[1], out[2]}, out};
  if (lobe_) {
    std::array<F*, max_channels> alone{};
    for (std::size_t c = 0; c < max_channels; ++c) alone[c] = scratch_[Between::first_free + c];
    (*lobe_)(x, alone);
    std::ranges::copy(alone, columns.lobe.begin());
  }
  multiple_(x, albedo_, strength_, columns);
}

template <class F>
void SurfaceEvaluator<F>::add_coat(const Block<F>& x, const std::array<F*, max_channels>& out) {
  const auto kernel = [&](std::size_t t) -> const TermKernels<F>& {
    return kernels_.terms.terms[coat_->term[t]];
  };
  const auto parameters = [&](std::size_t t, std::size_t c) {
    return coat_->parameters[t][c].data();
  };
  F *const num = scratch_[Between::first_free], *const den = scratch_[Between::first_free + 1];
  kernel(0).start_product(x, parameters(0, 0), {nullptr, nullptr, nullptr, num, den});
  const bool fraction = catalogue()[coat_->term[0]].fraction;
  kernel(1).finish_product(x, parameters(1, 0),
                           {num, fraction ? den : nullptr, nullptr, num, nullptr});
  ChannelColumns<F> columns;
  columns.factor = num;
  columns.coupled = true;
  for (std::size_t c = 0; c < max_channels; ++c) {
    columns.base[c] = columns.out[c] = out[c];
    columns.parameters[c] = parameters(2, c);
  }
  kernel(2).shade[max_channels](x, columns);
}

template <class F>
void SurfaceEvaluator<F>::operator()(const Block<F>& x, std::span<F* const> out) {
  for (std::size_t at = 0; at < x.n; at += Between::block) {
    const auto part = x.part(at, std::min(Between::block, x.n - at));
    const std::array here{out[0] + at, out[1] + at, out[2] + at};
    base_(part, here);
    if (multiple_) add_multiple(part, here);
    if (coat_) add_coat(part, here);
  }
}

template class SurfaceEvaluator<float>;
template class SurfaceEvaluator<double>;

}  // namespace gonio::scene
