#include "brdf/model/derivatives.h"

#include <algorithm>

#include "brdf/catalogue/foreign_terms.h"
#include "brdf/term/product.h"

namespace gonio {
namespace {

template <class F>
const F* derivative(const DualColumn<F>& a, std::size_t slot) {
  const auto it = std::ranges::find(a.d, slot, &std::pair<std::size_t, const F*>::first);
  return it == a.d.end() ? nullptr : it->second;
}

}  // namespace

/// A column as a number: what is computed with it is written down, to be done to every block.
template <class F>
struct ModelDerivatives<F>::Written {
  ModelDerivatives* to;
  DualColumn<F> column;

  Written operator*(const Written& b) const { return {to, to->product(column, b.column)}; }
  Written operator+(const Written& b) const {
    return {to, to->sum(column, b.column, to->scratch_.ones())};
  }
  Written operator-(const Written& b) const {
    return {to, to->sum(column, b.column, to->scratch_.minus_ones())};
  }
};

template <class F>
ModelDerivatives<F>::ModelDerivatives(const Model& m,
                                      const std::vector<bool>& free,
                                      const Kernels<F>& k,
                                      const TexelTerms<F>* texels,
                                      bool means)
    : model_(m), free_(free), k_(k), texels_(texels), turned_(m, k), channel_steps_(m.channels) {
  std::vector<DualColumn<F>> dv;  // D·V, shared by the channels
  for (const auto& l : m.lobes) {
    const auto d = term(l.ndf, 0);
    dv.push_back(product(d, term(l.masking, 0)));
  }

  const std::size_t shared = next_;
  std::size_t used = next_;
  for (std::size_t c = 0; c < m.channels; ++c) {
    next_ = shared;  // the next channel takes the same columns
    into_ = &channel_steps_[c];
    DualColumn<F> f, coupled;
    const auto written = [&](const DualColumn<F>& x) { return Written{this, x}; };
    const auto add = [&](DualColumn<F>& to, const DualColumn<F>& x) {
      to = to.value ? sum(to, x, scratch_.ones()) : x;
    };
    for (const auto& t : m.diffuse) {
      const auto x = term(t, c);
      add(f, x);
      if (catalogue()[t.term].coupled) add(coupled, x);
    }
    for (std::size_t l = 0; l < m.lobes.size(); ++l) {
      const auto add_lobe = [&](const auto& base, const auto& under) {
        const auto fresnel = written(term(m.lobes[l].fresnel, c));
        f = lobe_on(base, under, One{}, written(dv[l]), fresnel).column;
      };
      if (!f.value)
        add_lobe(Zero{}, Zero{});
      else if (l == 0 && coupled.value)
        add_lobe(written(f), written(coupled));
      else
        add_lobe(written(f), Zero{});
    }
    if (texels && texels->cosine) f = product(f, *texels->cosine);
    channels_.push_back(std::move(f));
    used = std::max(used, next_);
  }
  next_ = used;
  if (!means) return;
  at_angles_ = channels_;
  for (auto& channel : channels_) {
    auto& own = means_.emplace_back(1 + channel.d.size());
    for (auto& column : own) column = Column<F>(Scratch<F>::block);
    channel.value = own[0].data();
    for (std::size_t i = 0; i < channel.d.size(); ++i) channel.d[i].second = own[1 + i].data();
  }
}

template <class F>
void ModelDerivatives<F>::find_means(const SampleBlock<F>& samples) {
  for (auto& own : means_)
    for (auto& column : own) std::fill_n(column.data(), samples.n, F(0));
  for_parts(samples, Scratch<F>::block, [&](const Block<F>& angles, const auto& add) {
    const Block<F> b = turned_(angles);
    for (const auto& s : shared_steps_) s(b);
    for (std::size_t c = 0; c < at_angles_.size(); ++c) {
      for (const auto& s : channel_steps_[c]) s(b);
      add(at_angles_[c].value, means_[c][0].data());
      for (std::size_t k = 0; k < at_angles_[c].d.size(); ++k)
        add(at_angles_[c].d[k].second, means_[c][1 + k].data());
    }
  });
}

template <class F>
void ModelDerivatives<F>::set(std::span<const F> values) {
  const std::size_t stride = texels_ ? padding : 1;
  if (!texels_) turned_.set(values);
  for (auto& g : parameters_)
    for (std::size_t i = 0; i < g.slots.size(); ++i)
      std::copy_n(values.data() + g.slots[i] * stride, stride, g.p.data() + i * stride);
}

template <class F>
DualColumn<F> ModelDerivatives<F>::term(const TermUse& t, std::size_t c) {
  Gathered& gathered = parameters_.emplace_back();
  gathered.p = Column<F>(most_parameters * (texels_ ? padding : 1));
  std::array<F*, most_parameters + 2> d{};
  F* const value = fresh();
  DualColumn<F> r{value, {}};
  for (std::size_t i = 0; i < t.parameters.size(); ++i) {
    const std::size_t slot = model_.parameters[t.parameters[i]].slot(c);
    gathered.slots.push_back(slot);
    d[i] = fresh();
    if (free_[slot]) r.d.emplace_back(slot, d[i]);
  }
  if (catalogue()[t.term].anisotropic) {
    F*& by_turn = d[t.parameters.size()] = fresh();
    if (const std::size_t slot = model_.tangent()->first; free_[slot])
      r.d.emplace_back(slot, by_turn);
  }
  if (texels_ && texels_->cosine)
    for (std::size_t k = 0; k < texels_->cosine->d.size(); ++k)
      r.d.emplace_back(texels_->cosine->d[k].first, d[t.parameters.size() + k] = fresh());
  const std::size_t own = term_of_channel(t.term, c);
  const auto kernel = texels_ ? texels_->derivatives[own] : k_.terms[own].derivatives;
  into_->push_back(
      [=, p = gathered.p.data()](const Block<F>& b) { kernel(b, p, value, d.data()); });
  return r;
}

/// (a·b)' = a'·b + a·b'
template <class F>
DualColumn<F> ModelDerivatives<F>::product(const DualColumn<F>& a, const DualColumn<F>& b) {
  DualColumn<F> r{times(a.value, b.value), {}};
  for (const auto& [slot, da] : a.d) {
    const F* const db = derivative(b, slot);
    r.d.emplace_back(slot, db ? times_sum(da, b.value, a.value, db) : times(da, b.value));
  }
  for (const auto& [slot, db] : b.d)
    if (!derivative(a, slot)) r.d.emplace_back(slot, times(a.value, db));
  return r;
}

template <class F>
DualColumn<F> ModelDerivatives<F>::sum(const DualColumn<F>& a,
                                       const DualColumn<F>& b,
                                       const F* sign) {
  DualColumn<F> r = a;
  r.value = plus(a.value, b.value, sign);
  for (const auto& [slot, db] : b.d) {
    const auto it = std::ranges::find(r.d, slot, &std::pair<std::size_t, const F*>::first);
    if (it == r.d.end())
      r.d.emplace_back(slot, sign == scratch_.ones() ? db : times(db, sign));
    else
      it->second = plus(it->second, db, sign);
  }
  return r;
}

template <class F>
const F* ModelDerivatives<F>::times(const F* a, const F* b) {
  F* const r = fresh();
  into_->push_back([=, f = k_.product](const Block<F>& x) { f(x.n, a, b, r); });
  return r;
}
template <class F>
const F* ModelDerivatives<F>::times_sum(const F* a, const F* b, const F* c, const F* d) {
  F* const r = fresh();
  into_->push_back([=, f = k_.product_sum](const Block<F>& x) { f(x.n, a, b, c, d, r); });
  return r;
}
template <class F>
const F* ModelDerivatives<F>::plus(const F* a, const F* b, const F* sign) {
  F* const r = fresh();
  into_->push_back([=, f = k_.add_product](const Block<F>& x) { f(x.n, a, b, sign, r); });
  return r;
}

template class ModelDerivatives<float>;
template class ModelDerivatives<double>;

}  // namespace gonio
