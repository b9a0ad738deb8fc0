#include "fitting/map/passes.h"

#include <algorithm>
#include <limits>

#include "brdf/catalogue/registry.h"

namespace gonio {
namespace {

/// Of k derivatives beside the residual: their products, and what `worth` has below them.
constexpr std::size_t entries_of(std::size_t k) {
  return (k + 1) * (k + 2) / 2 + 2 * k;
}
constexpr std::size_t most_entries = entries_of(max_columns - 1);

std::size_t slot_of(const Model& m, const TermUse& t, std::size_t parameter, std::size_t channel) {
  if (const std::size_t n = t.parameters.size(); parameter >= n)
    return m.tangent() ? m.tangent()->first : m.value_count + parameter - n;
  return m.parameters[t.parameters[parameter]].slot(channel);
}

UnknownOf unknowns_of(const TexelTask& task,
                      const std::vector<const TermUse*>& terms,
                      const TexelColumns& columns) {
  UnknownOf of(task.model().channels);
  for (std::size_t c = 0; c < of.size(); ++c)
    for (std::size_t k = 0; k < columns.count; ++k)
      of[c].push_back(task.unknown_of[slot_of(task.model(), *terms[columns.of[k].term],
                                              columns.of[k].parameter, c)]);
  return of;
}

}  // namespace

TexelPasses::Composed::Composed(const TexelTask& task,
                                std::vector<bool> which,
                                const Kernels<float>& k,
                                TexelTerms<float> way)
    : free(std::move(which)),
      terms(way),
      derivatives(task.model(), free, k, &terms),
      link(derivatives.fresh()),
      link_slope(derivatives.fresh()),
      r(derivatives.fresh()),
      slope(derivatives.fresh()),
      j(task.model().channels),
      unknown_of(task.model().channels) {
  for (std::size_t c = 0; c < j.size(); ++c)
    for (const auto& [slot, column] : derivatives.channel(c).d) {
      j[c].push_back(column);
      unknown_of[c].push_back(task.unknown_of[slot]);
    }
}

TexelPasses::TexelPasses(const TexelTask& task, const Kernels<float>& k, const LaneKernels& lanes)
    : task_(task),
      kernels_(k),
      lanes_(lanes),
      terms_(terms_of(task.model())),
      link_(link_of(task.asked.metric)),
      parameters_(max_fused_terms * max_channels * max_parameters * padding),
      memory_(max_channels * most_entries * padding),
      cost_(padding) {
  const Model& m = task.model();
  for (std::size_t c = 0; c < max_channels; ++c)
    sums_[c] = memory_.data() + c * most_entries * padding;
  const auto ids = fused_ids(m);
  if (ids)
    for (const auto& f : task.asked.refine_normals ? lanes.fused_tilted : lanes.fused)
      if (f.ids == *ids) fused_ = &f;
  if (fused_) {
    all_ = unknowns_of(task, terms_, fused_->columns);
    linear_ = unknowns_of(task, terms_, fused_->linear_columns);
    return;
  }
  const std::vector<bool>& free = task.problem.free.mask();
  std::vector<bool> no_shape = free;
  for (std::size_t s = 0; s < no_shape.size(); ++s) no_shape[s] = no_shape[s] && !task.is_shape[s];
  TexelTerms<float> given{lanes.terms, nullptr}, all = given;
  if (task.asked.refine_normals) {
    for (auto& column : cosine_) column = Column<float>(Scratch<float>::block);
    cosine_column_.value = held_cosine_.value = cosine_[0].data();
    for (std::size_t t = 0; t < 2; ++t)
      cosine_column_.d.emplace_back(m.value_count + t, cosine_[1 + t].data());
    all = {lanes.tilted, &cosine_column_};
    given.cosine = &held_cosine_;
  }
  composed_all_ = std::make_unique<Composed>(task, free, k, all);
  composed_linear_ = std::make_unique<Composed>(task, std::move(no_shape), k, given);
  all_ = composed_all_->unknown_of;
  linear_ = composed_linear_->unknown_of;
}

void TexelPasses::clear(const UnknownOf& of) {
  for (std::size_t c = 0; c < of.size(); ++c)
    std::fill_n(sums_[c], entries_of(of[c].size()) * padding, 0.0F);
}

void TexelPasses::run(TexelPass pass, const LaneSamples& s, const float* values, Link link) {
  const Model& m = task_.model();
  TexelArguments& a = arguments_;
  a.x = s.x;
  a.channels = m.channels;
  a.target = s.target;
  a.weight = s.weight;
  a.offset = link == Link::log ? static_cast<float>(task_.asked.offset) : 0;
  a.sums = sums_;
  a.cost = cost_.data();
  a.per_cosine = s.per_cosine;
  for (std::size_t t = 0; t < terms_.size(); ++t)
    for (std::size_t c = 0; c < m.channels; ++c) {
      float* const p = parameters_.data() + (t * max_channels + c) * max_parameters * padding;
      for (std::size_t k = 0; k < terms_[t]->parameters.size(); ++k)
        std::copy_n(values + slot_of(m, *terms_[t], k, c) * padding, padding, p + k * padding);
      a.parameters[t][c] = p;
    }
  pass(a);
}

template <class Visit>
void TexelPasses::run(
    Composed& model, const LaneSamples& s, const float* values, Link link, Visit&& visit) {
  const std::size_t slots = task_.model().value_count;
  model.derivatives.set({values, slots * padding});
  const float offset = link == Link::log ? static_cast<float>(task_.asked.offset) : 0;
  for (std::size_t at = 0; at < s.x.n; at += Scratch<float>::block) {
    const auto x = s.x.part(at, std::min(Scratch<float>::block, s.x.n - at));
    if (model.terms.cosine)
      for (std::size_t i = 0; i < x.n; ++i) {
        const float per = s.per_cosine[at + i];
        cosine_[0][i] = x.nol[i] * per;
        cosine_[1][i] = x.frame[2][i] * per;
        cosine_[2][i] = x.frame[3][i] * per;
      }
    model.derivatives.run(x, [&](std::size_t c) {
      kernels_.link[static_cast<std::size_t>(link)](x.n, model.derivatives.channel(c).value, offset,
                                                    model.link, model.link_slope);
      kernels_.residual(x.n,
                        {model.link, model.link_slope, s.target[c] + at, s.weight[c] + at,
                         std::numeric_limits<float>::max(), model.r, model.slope, cost_.data()});
      visit(x.n, c);
    });
  }
}

void TexelPasses::normal(const LaneSamples& s, const float* values) {
  clear(all_);
  const auto link = static_cast<std::size_t>(link_);
  if (fused_) return run(fused_->normal[s.shared][link], s, values, link_);
  auto& m = *composed_all_;
  run(m, s, values, link_, [&](std::size_t n, std::size_t c) {
    kernels_.gram[m.j[c].size() + 1](n, m.r, m.slope, m.j[c].data(), sums_[c]);
  });
}

void TexelPasses::linear(const LaneSamples& s, const float* values) {
  clear(linear_);
  if (fused_) return run(fused_->linear[s.shared], s, values, Link::identity);
  auto& m = *composed_linear_;
  run(m, s, values, Link::identity, [&](std::size_t n, std::size_t c) {
    kernels_.gram[m.j[c].size() + 1](n, m.r, m.slope, m.j[c].data(), sums_[c]);
  });
}

void TexelPasses::worth(const LaneSamples& s,
                        const float* values,
                        const std::array<const float*, max_channels>& inverse) {
  clear(all_);
  const auto link = static_cast<std::size_t>(link_);
  if (fused_) {
    arguments_.inverse = inverse;
    return run(fused_->worth[s.shared][link], s, values, link_);
  }
  auto& m = *composed_all_;
  run(m, s, values, link_, [&](std::size_t n, std::size_t c) {
    lanes_.worth[m.j[c].size() + 1](n, m.r, m.slope, m.j[c].data(), inverse[c], sums_[c]);
  });
}

}  // namespace gonio
