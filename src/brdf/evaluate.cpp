#include "brdf/evaluate.h"

#include <algorithm>

#include "base/error.h"

#include <fmt/format.h>

namespace gonio {

template <class F>
Column<F> Column<F>::for_overwrite(std::size_t n) {
  Column c;
  c.data_.reset(static_cast<F*>(allocate_array(n * sizeof(F))));
  return c;
}

template <class F>
Column<F>::Column(std::size_t n, F fill) : Column(for_overwrite(n)) {
  std::fill_n(data_.get(), n, fill);
}

template <class F>
AngleColumns<F>::AngleColumns(std::size_t n, bool frame)
    : size_(n), padded_((n + padding - 1) / padding * padding), column_(frame ? 11 : 5) {
  for (auto& c : column_) {
    c = Column<F>::for_overwrite(padded_);
    std::fill(c.data() + n, c.data() + padded_, F(0.5));
  }
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
std::array<F, max_parameters> gather(const Model& m,
                                     const TermUse& t,
                                     std::span<const F> values,
                                     std::size_t channel) {
  std::array<F, max_parameters> p{};
  for (std::size_t k = 0; k < t.parameters.size(); ++k)
    p[k] = values[m.parameters[t.parameters[k]].slot(channel)];
  return p;
}

/// nullptr if this combination is not a hot one
template <class F>
typename FusedKernel<F>::Value find_fused(const Kernels<F>& k,
                                          const Lobe& l,
                                          std::size_t channels) {
  const std::array ids{k.terms[l.ndf.term].about->id, k.terms[l.masking.term].about->id,
                       k.terms[l.fresnel.term].about->id};
  const auto it = std::ranges::find(k.fused, ids, &FusedKernel<F>::ids);
  return it == k.fused.end() || channels > max_channels ? nullptr : it->value[channels];
}

}  // namespace

template <class F>
void evaluate(const Model& m,
              std::span<const F> values,
              const Block<F>& x,
              std::span<F* const> out,
              const Kernels<F>& k) {
  Scratch<F> scratch;
  constexpr std::size_t first = Scratch<F>::first_free;
  F *const num = scratch[first], *const den = scratch[first + 1], *const less = scratch[first + 2];
  for (std::size_t at = 0; at < x.n; at += scratch.block) {
    const auto b = x.part(at, std::min(scratch.block, x.n - at));
    std::vector<const F*> base(m.channels, scratch.zeros());
    const auto add = [&](const TermUse& t, const F* factor, std::size_t c) {
      F* const to = out[c] + at;
      k.terms[t.term].add(b, gather(m, t, values, c).data(),
                          {factor, nullptr, base[c], to, nullptr});
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
      if (const auto fused = find_fused(k, lobe, m.channels); fused && !under) {
        std::array<std::array<F, max_parameters>, max_channels> pf;
        std::array<const F*, max_channels> p;
        std::array<F*, max_channels> to;
        for (std::size_t c = 0; c < m.channels; ++c) {
          pf[c] = gather(m, lobe.fresnel, values, c);
          p[c] = pf[c].data();
          to[c] = out[c] + at;
        }
        fused(b, pd.data(), pv.data(), p.data(), base.data(), to.data());
        std::copy_n(to.begin(), m.channels, base.begin());
        continue;
      }
      k.terms[lobe.ndf.term].extend(b, pd.data(),
                                    {scratch.ones(), scratch.ones(), nullptr, num, den});
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

namespace {

template <class Row>
std::vector<std::vector<double>> evaluate_rows(const BoundModel& b, std::span<const Row> angles) {
  AngleColumns<double> x(angles.size(), b.model.anisotropic);
  const auto above = [&](std::size_t i) { return angles[i].nol > 0 && angles[i].nov > 0; };
  constexpr FrameAngles<double> harmless{{0.5, 0.5, 0.5, 0.5, 0.75}, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5};
  for (std::size_t i = 0; i < angles.size(); ++i) {
    if (above(i))
      x.set(i, angles[i]);
    else
      x.set(i, harmless);
  }
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
      if (!above(i)) f.back()[i] = 0;
  }
  return f;
}

}  // namespace

std::vector<std::vector<double>> evaluate(const BoundModel& b,
                                          std::span<const Angles<double>> angles) {
  if (b.model.anisotropic)
    throw wrong_usage(
        fmt::format("model '{}' is anisotropic, and nothing here says how the surface was turned",
                    b.model.spec));
  return evaluate_rows(b, angles);
}
std::vector<std::vector<double>> evaluate(const BoundModel& b,
                                          std::span<const FrameAngles<double>> angles) {
  return evaluate_rows(b, angles);
}

#define GONIO_INSTANTIATE(F)                                                                     \
  template class Column<F>;                                                                      \
  template class AngleColumns<F>;                                                                \
  template class Scratch<F>;                                                                     \
  template void evaluate(const Model&, std::span<const F>, const Block<F>&, std::span<F* const>, \
                         const Kernels<F>&);
GONIO_INSTANTIATE(float)
GONIO_INSTANTIATE(double)

}  // namespace gonio
