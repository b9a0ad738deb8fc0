#include "brdf/model/evaluate.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/error.h"
#include "geometry/direction.h"

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

template <class F, std::size_t samples>
Scratch<F, samples>::Scratch() {
  std::fill_n((*this)[0], block, F(1));
  std::fill_n((*this)[1], block, F(0));
  std::fill_n((*this)[2], block, F(-1));
}

template <class F, std::size_t samples>
F* Scratch<F, samples>::operator[](std::size_t i) {
  while (columns_.size() <= i) columns_.emplace_back(block);
  return columns_[i].data();
}

std::vector<const TermUse*> terms_of(const Model& m) {
  std::vector<const TermUse*> terms;
  for (const auto& t : m.diffuse) terms.push_back(&t);
  for (const auto& l : m.lobes) terms.insert(terms.end(), {&l.ndf, &l.masking, &l.fresnel});
  return terms;
}

std::optional<FusedIds> fused_ids(const Model& m) {
  const auto terms = terms_of(m);
  if (terms.size() > max_fused_terms) return {};
  FusedIds ids;
  ids.diffuse = m.diffuse.size();
  for (std::size_t t = 0; t < terms.size(); ++t) ids.id[t] = catalogue()[terms[t]->term].id();
  return ids;
}

template <class F>
TurnedFrame<F>::TurnedFrame(const Model& m, const Kernels<F>& k) : kernels_(k) {
  const auto* const tangent = m.tangent();
  has_tangent_ = tangent != nullptr;
  if (!tangent) return;
  slot_ = tangent->first;
  for (auto& column : factors_) column = Column<F>(block);
  for (auto& column : turned_) column = Column<F>(block);
}

template <class F>
void TurnedFrame<F>::set(std::span<const F> values) {
  turns_ = has_tangent_ && values[slot_] != 0;
  if (!turns_) return;
  const double t = static_cast<double>(values[slot_]) * degree;
  const std::array by{std::cos(t), std::sin(t), -std::sin(t)};
  for (std::size_t k = 0; k < by.size(); ++k)
    std::fill_n(factors_[k].data(), block, static_cast<F>(by[k]));
}

template <class F>
Block<F> TurnedFrame<F>::operator()(const Block<F>& x) {
  if (!turns_) return x;
  assert(x.n <= block);
  const F *const c = factors_[0].data(), *const s = factors_[1].data(),
                 *const minus_s = factors_[2].data();
  Block<F> turned = x;
  for (std::size_t k = 0; k < turned_.size(); k += 2) {  // of h, l, v
    kernels_.product_sum(x.n, x.frame[k], c, x.frame[k + 1], s, turned_[k].data());
    kernels_.product_sum(x.n, x.frame[k + 1], c, x.frame[k], minus_s, turned_[k + 1].data());
  }
  for (std::size_t k = 0; k < turned_.size(); ++k) turned.frame[k] = turned_[k].data();
  return turned;
}

template <class F>
Evaluator<F>::Evaluator(const Model& m, const Kernels<F>& k)
    : channels_(m.channels), diffuse_(m.diffuse.size()), turned_(m, k) {
  for (const auto* use : terms_of(m)) {
    const TermUse& t = *use;
    Term term{&catalogue()[t.term], &k.terms[t.term], {}, {}};
    for (std::size_t c = 0; c < m.channels; ++c) {
      auto& slots = term.slots.emplace_back();
      for (std::size_t i = 0; i < t.parameters.size(); ++i)
        slots[i] = m.parameters[t.parameters[i]].slot(c);
    }
    term.parameters.resize(m.channels);
    term.count = t.parameters.size();
    term.is_ggx = term.entry->id() == "ndf.ggx";
    terms_.push_back(std::move(term));
  }
  assert(diffuse_ <= 1);
  for (std::size_t t = 0; t < diffuse_; ++t) coupled_ |= terms_[t].entry->coupled;
  if (has_uniform_diffuse()) uniform_.resize(channels_);
  const auto ids = fused_ids(m);
  if (!ids || channels_ > max_channels) return;
  for (const auto& f : k.fused)
    if (f.ids == ids) fused_ = f.value[channels_];
  for (std::size_t t = 0; t < terms_.size(); ++t)
    for (std::size_t c = 0; c < channels_; ++c)
      arguments_.parameters[t][c] = terms_[t].parameters[c].data();
}

template <class F>
void Evaluator<F>::set(std::span<const F> values) {
  turned_.set(values);
  for (auto& t : terms_)
    for (std::size_t c = 0; c < channels_; ++c)
      for (std::size_t i = 0; i < t.count; ++i) t.parameters[c][i] = values[t.slots[c][i]];
  for (std::size_t c = 0; c < uniform_.size(); ++c)
    uniform_[c] = terms_[0].kernels->uniform(terms_[0].parameters[c].data());
}

template <class F>
void Evaluator<F>::operator()(const Block<F>& x, std::span<F* const> out) {
  if (fused_ && !turned_) return fused(x, 0, out);
  for (std::size_t at = 0; at < x.n; at += Between::block) {
    const Block<F> part = turned_(x.part(at, std::min(Between::block, x.n - at)));
    fused_ ? fused(part, at, out) : compose(part, at, out);
  }
}

template <class F>
void Evaluator<F>::fused(const Block<F>& x, std::size_t at, std::span<F* const> out) {
  arguments_.x = x;
  for (std::size_t c = 0; c < channels_; ++c) arguments_.out[c] = out[c] + at;
  fused_(arguments_);
}

template <class F>
void Evaluator<F>::compose(const Block<F>& x, std::size_t at, std::span<F* const> out) {
  std::size_t next = Between::first_free;
  F* const den = scratch_[next++];
  auto& dv = dv_;  // shared by the channels
  dv.clear();
  for (std::size_t t = diffuse_; t < terms_.size(); t += 3) {
    const Term &d = terms_[t], &v = terms_[t + 1];
    F* const num = dv.emplace_back(scratch_[next++]);
    if (d.is_ggx) {
      v.kernels->with_ggx(x, d.parameters[0].data(), v.parameters[0].data(), num);
      continue;
    }
    d.kernels->start_product(x, d.parameters[0].data(), {nullptr, nullptr, nullptr, num, den});
    v.kernels->finish_product(x, v.parameters[0].data(),
                              {num, d.entry->fraction ? den : nullptr, nullptr, num, nullptr});
  }
  const std::size_t together = channels_ % 3 == 0 ? 3 : 1;  // as the kernels take them
  for (std::size_t c = 0; c < channels_; c += together) {
    ChannelColumns<F> columns;
    const auto shade = [&](const Term& t) {
      for (std::size_t k = 0; k < together; ++k) columns.parameters[k] = t.parameters[c + k].data();
      t.kernels->shade[together](x, columns);
      std::ranges::copy(columns.out, columns.base.begin());
    };
    for (std::size_t k = 0; k < together; ++k) columns.out[k] = out[c + k] + at;
    if (has_uniform_diffuse())
      columns.uniform = uniform_.data() + c;
    else if (diffuse_ > 0)
      shade(terms_[0]);
    columns.coupled = coupled_;
    for (std::size_t l = 0; l < dv.size(); ++l) {
      columns.factor = dv[l];
      shade(terms_[diffuse_ + 3 * l + 2]);
      columns.coupled = false;
    }
  }
}

template <class F>
void evaluate(const Model& m,
              std::span<const F> values,
              const Block<F>& x,
              std::span<F* const> out,
              const Kernels<F>& k) {
  Evaluator<F> evaluator(m, k);
  evaluator.set(values);
  evaluator(x, out);
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
                    to_text(b.model.spec)));
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
  template class TurnedFrame<F>;                                                                 \
  template class Evaluator<F>;                                                                   \
  template void evaluate(const Model&, std::span<const F>, const Block<F>&, std::span<F* const>, \
                         const Kernels<F>&);
template class Scratch<float, Evaluator<float>::Between::block>;
GONIO_INSTANTIATE(float)
GONIO_INSTANTIATE(double)

}  // namespace gonio
