#include "brdf/evaluate.h"

#include <algorithm>

namespace gonio {

template <class F>
Column<F>::Column(std::size_t n, F fill)
    : data_(static_cast<F*>(::operator new[](std::max<std::size_t>(n, 1) * sizeof(F),
                                             std::align_val_t(64)))) {
  std::fill_n(data_.get(), n, fill);
}

template <class F>
AngleColumns<F>::AngleColumns(std::size_t n)
    : size_(n), padded_((n + padding - 1) / padding * padding) {
  for (auto& c : column_) c = Column<F>(padded_, F(0.5));
}

template <class F>
Scratch<F>::Scratch() {
  std::fill_n((*this)[0], block, F(1));
  std::fill_n((*this)[1], block, F(0));
  std::fill_n((*this)[2], block, F(-1));
}

template <class F>
F* Scratch<F>::operator[](std::size_t i) {
  while (columns_.size() <= i) columns_.emplace_back(block);
  return columns_[i].data();
}

namespace {

/// A term's parameters for one channel, gathered.
template <class F>
std::array<F, 4> gather(const Model& m, const TermUse& t, std::span<const F> values,
                        std::size_t channel) {
  std::array<F, 4> p{};
  for (std::size_t k = 0; k < t.parameters.size(); ++k)
    p[k] = values[m.parameters[t.parameters[k]].slot(channel)];
  return p;
}

template <class F>
const FusedKernel<F>* find_fused(const Kernels<F>& k, const Lobe& l) {
  const std::array ids{k.terms[l.ndf.term].about->id, k.terms[l.masking.term].about->id,
                       k.terms[l.fresnel.term].about->id};
  const auto it = std::ranges::find(k.fused, ids, &FusedKernel<F>::ids);
  return it == k.fused.end() ? nullptr : &*it;
}

}  // namespace

template <class F>
void evaluate(const Model& m, std::span<const F> values, const Block<F>& x,
              std::span<F* const> out, const Kernels<F>& k) {
  Scratch<F> scratch;
  constexpr std::size_t first = Scratch<F>::first_free;
  F *const num = scratch[first], *const den = scratch[first + 1], *const less = scratch[first + 2];
  for (std::size_t at = 0; at < x.n; at += scratch.block) {
    const auto b = x.part(at, std::min(scratch.block, x.n - at));
    std::vector<const F*> base(m.channels, scratch.zeros());
    const auto add = [&](const TermUse& t, const F* factor, std::size_t c) {
      F* const to = out[c] + at;
      k.terms[t.term].add(b, gather(m, t, values, c).data(), {factor, nullptr, base[c], to, nullptr});
      base[c] = to;
    };
    bool coupled = false;
    for (const auto& t : m.diffuse) {
      coupled |= k.terms[t.term].coupled;
      for (std::size_t c = 0; c < m.channels; ++c) add(t, scratch.ones(), c);
    }
    for (std::size_t l = 0; l < m.lobes.size(); ++l) {
      const auto& lobe = m.lobes[l];
      const auto pd = gather(m, lobe.ndf, values, 0), pv = gather(m, lobe.masking, values, 0);
      const bool under = coupled && l == 0;
      const auto* fused = find_fused(k, lobe);
      if (fused && !under && m.channels == 1) {
        const auto pf = gather(m, lobe.fresnel, values, 0);
        fused->value(b, {pd.data(), pv.data(), pf.data()}, base[0], out[0] + at);
        base[0] = out[0] + at;
        continue;
      }
      k.terms[lobe.ndf.term].extend(b, pd.data(), {scratch.ones(), scratch.ones(), nullptr, num, den});
      k.terms[lobe.masking.term].close(b, pv.data(), {num, den, nullptr, num, nullptr});
      for (std::size_t c = 0; c < m.channels; ++c) {  // the channels share D·V
        const F* factor = num;
        if (under) {  // F (D V − coupled) + coupled, the last of which is in base already
          for (const auto& t : m.diffuse)
            if (k.terms[t.term].coupled) {
              k.terms[t.term].add(b, gather(m, t, values, c).data(),
                                  {scratch.minus_ones(), nullptr, factor, less, nullptr});
              factor = less;
            }
        }
        add(lobe.fresnel, factor, c);
      }
    }
  }
}

std::vector<std::vector<double>> evaluate(const BoundModel& b,
                                          std::span<const Angles<double>> angles) {
  AngleColumns<double> x(angles.size());
  for (std::size_t i = 0; i < angles.size(); ++i)
    if (angles[i].nol > 0 && angles[i].nov > 0) x.set(i, angles[i]);
  std::vector<Column<double>> columns;
  std::vector<double*> out;
  for (std::size_t c = 0; c < b.model.channels; ++c) {
    columns.emplace_back(x.padded());
    out.push_back(columns.back().data());
  }
  evaluate<double>(b.model, b.values, x.block(), out);
  std::vector<std::vector<double>> f;
  for (const auto* column : out) {
    f.emplace_back(column, column + angles.size());
    for (std::size_t i = 0; i < angles.size(); ++i)
      if (!(angles[i].nol > 0 && angles[i].nov > 0)) f.back()[i] = 0;
  }
  return f;
}

#define GONIO_INSTANTIATE(F)                                                               \
  template class Column<F>;                                                                \
  template class AngleColumns<F>;                                                          \
  template class Scratch<F>;                                                               \
  template void evaluate(const Model&, std::span<const F>, const Block<F>&, std::span<F* const>, \
                         const Kernels<F>&);
GONIO_INSTANTIATE(float)
GONIO_INSTANTIATE(double)

}  // namespace gonio
