#include "fitting/map/task.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "brdf/catalogue/foreign_terms.h"
#include "brdf/catalogue/registry.h"
#include "brdf/model/evaluate.h"
#include "brdf/model/roughness.h"

#include <fmt/format.h>

namespace gonio {
namespace {

FitOptions options_of(const TexelOptions& o) {
  FitOptions f;
  f.model = o.model;
  f.fixed = o.fixed;
  f.bounds = o.bounds;
  f.grey = o.grey;
  f.metric = o.metric;
  return expanded(f);
}

/// Bound of a float that does not pass the one in double.
float inside(double bound, bool low) {
  const auto f = static_cast<float>(bound);
  const bool out = low ? double{f} < bound : double{f} > bound;
  constexpr float far = std::numeric_limits<float>::infinity();
  return out ? std::nextafter(f, low ? far : -far) : f;
}

std::vector<bool> shapes_of(const Model& m) {
  std::vector<bool> is(m.value_count);
  for (const auto& l : m.lobes)
    for (const auto* t : {&l.ndf, &l.masking})
      for (const std::size_t k : t->parameters)
        std::fill_n(is.begin() + static_cast<std::ptrdiff_t>(m.parameters[k].first),
                    m.parameters[k].count, true);
  for (const auto& t : m.diffuse)  // of a whole model what is no colour
    if (foreign_term(t.term))
      for (const std::size_t k : t.parameters)
        if (!m.parameters[k].about->per_channel) is[m.parameters[k].first] = true;
  if (const auto* t = m.tangent()) is[t->first] = true;
  return is;
}

/// Values of a shape's parameter that are tried: spread by ratio, from 0 evenly.
std::vector<float> rungs(const ModelParameter& q, const Range& range, std::size_t lobes) {
  const auto between = [&](std::initializer_list<double> all) {
    std::vector<float> in;
    for (const double x : all)
      if (range.low <= x && x <= range.high) in.push_back(static_cast<float>(x));
    if (in.empty()) in.push_back(static_cast<float>(std::sqrt(range.low * range.high)));
    return in;
  };
  if (q.name == "tangent") return between({0, 45, 90, 135});
  if (q.about->name == "alpha_x" || q.about->name == "alpha_y") return between({0.04, 0.15, 0.5});
  if (is_alpha(q.name))
    return lobes > 1 ? between({0.02, 0.08, 0.25, 0.7})
                     : between({0.01, 0.03, 0.07, 0.14, 0.25, 0.45, 0.6, 0.8});
  if (lobes == 0) {  // a person's own
    std::vector<float> spread;
    for (const double part : {1.0 / 6, 0.5, 5.0 / 6})
      spread.push_back(static_cast<float>(range.low > 0 && range.high > 20 * range.low
                                              ? range.low * std::pow(range.high / range.low, part)
                                              : range.low + part * (range.high - range.low)));
    return spread;
  }
  if (q.about->name == "tail") return between({0.3, 1});
  if (q.about->name == "gamma") return between({1.5, 3});
  return between({q.about->start});
}

/// True of widths of a start that another one repeats: exchanged they are a tangent a quarter turn further, and equal ones have none.
bool repeats_another(const Model& m,
                     const std::vector<std::pair<std::size_t, float>>& start,
                     const std::vector<bool>& free) {
  const auto value = [&](const std::string& name) {
    const auto* q = m.find(name);
    const auto at = std::ranges::find(start, q ? q->first : m.value_count,
                                      &std::pair<std::size_t, float>::first);
    return at == start.end() ? std::nanf("") : at->second;
  };
  const auto* t = m.tangent();
  if (t && free[t->first]) {
    const float x = value("alpha_x"), y = value("alpha_y");
    return x < y || (x == y && value("tangent") > 0);
  }
  const float first = value("alpha"), second = value(to_text({"alpha", 1}));
  if (m.lobes.size() < 2 || !are_alike(m.lobes[0], m.lobes[1])) return first == second;
  return first <= second;
}

std::vector<std::vector<std::pair<std::size_t, float>>> starts_of(const Problem& p,
                                                                  const std::vector<bool>& shape) {
  const Model& m = p.start.model;
  std::vector<std::vector<std::pair<std::size_t, float>>> all{{}};
  for (const auto& q : m.parameters) {
    if (!shape[q.first] || !p.free.mask()[q.first]) continue;
    const std::size_t i = p.free.index(q.first);
    auto values = rungs(q, {p.bounds.low[i], p.bounds.high[i]}, m.lobes.size());
    constexpr std::size_t most = 120;  // of several lobes the others begin in the middle
    if (all.size() * values.size() > most) values = {values[values.size() / 2]};
    std::vector<std::vector<std::pair<std::size_t, float>>> longer;
    for (const auto& start : all)
      for (const float v : values) {
        longer.push_back(start);
        for (std::size_t c = 0; c < q.count; ++c) longer.back().emplace_back(q.first + c, v);
      }
    all = std::move(longer);
  }
  if (all.size() > 1)
    std::erase_if(all, [&](const auto& s) { return repeats_another(m, s, p.free.mask()); });
  return all;
}

/// True where second differences of f by all that is no shape are 0.
bool is_linear(const Problem& p, const std::vector<bool>& shape) {
  std::vector<FrameAngles<double>> at;
  for (const double noh : {0.9, 0.7, 0.5})
    at.push_back({{0.8, 0.6, noh, 0.7, 1 - noh * noh}, 0.3, 0.2, 0.4, 0.2, 0.1, 0.3});
  std::array<std::vector<std::vector<double>>, 3> f;
  for (std::size_t k = 0; k < f.size(); ++k) {
    BoundModel b = p.start;
    for (const std::size_t s : p.free.slots()) {
      if (shape[s]) continue;
      const double low = p.bounds.low[p.free.index(s)], high = p.bounds.high[p.free.index(s)];
      b.values[s] = low + (high - low) * (0.2 + 0.3 * static_cast<double>(k));
    }
    f[k] = evaluate(b, at);
  }
  for (std::size_t c = 0; c < f[0].size(); ++c)
    for (std::size_t i = 0; i < at.size(); ++i)
      if (!(std::abs(f[0][c][i] - 2 * f[1][c][i] + f[2][c][i]) < 1e-9 * std::abs(f[1][c][i])))
        return false;
  return true;
}

TexelUnknowns unknowns_of(const Problem& p, const std::vector<bool>& shape, bool tilts) {
  const Model& m = p.start.model;
  TexelUnknowns u;
  u.channels = m.channels;
  u.rounding = 2e-14F;
  constexpr float anywhere = std::numeric_limits<float>::max(), by_three = 1.1F, tilted = 0.3F,
                  turned = 20;
  const auto add = [&](std::size_t slot, std::size_t first, double low, double high, bool ratio) {
    const bool is_tangent = m.tangent() && slot == m.tangent()->first;
    u.furthest.push_back(ratio                   ? by_three
                         : slot >= m.value_count ? tilted
                         : is_tangent            ? turned
                                                 : anywhere);
    u.slot.push_back(slot);
    u.first.push_back(first);
    u.low.push_back(inside(low, true));
    u.high.push_back(inside(high, false));
    u.by_ratio.push_back(ratio);
  };
  const auto add_slot = [&](const ModelParameter& q, std::size_t slot, std::size_t first) {
    const std::size_t i = p.free.index(slot);
    add(slot, first, p.bounds.low[i], p.bounds.high[i], is_alpha(q.name));
  };
  for (std::size_t c = 0; c < m.channels; ++c) {
    const std::size_t first = u.slot.size();
    for (const auto& q : m.parameters)
      if (q.count > 1 && p.free.mask()[q.first + c]) add_slot(q, q.first + c, first);
  }
  for (const bool of_shape : {false, true})
    for (const auto& q : m.parameters)
      if (q.count == 1 && p.free.mask()[q.first] && shape[q.first] == of_shape)
        add_slot(q, q.first, 0);
  constexpr double furthest = 12;  // tangent of the tilt along an axis: 85°
  for (std::size_t k = 0; tilts && k < 2; ++k)
    add(m.value_count + k, 0, -furthest, furthest, false);
  u.count = u.slot.size();
  return u;
}

}  // namespace

TexelTask::TexelTask(const TexelOptions& o, std::size_t channels)
    : asked(o), options(options_of(o)), problem(pose(channels, o.offset, options)) {
  if (channels != 1 && channels != max_channels)
    throw wrong_usage(fmt::format("{} channels: a map has 1 or 3", channels));
  if (!(o.offset >= 0) || !std::isfinite(o.offset))
    throw wrong_usage(fmt::format("offset = {}, expected a number from 0 on", o.offset));
  if (o.metric == Metric::uncertainty)
    throw wrong_usage(
        "metric uncertainty is of tables that state one of each value; images state none");
  if (o.offset > 0 && o.metric == Metric::l2_cosine)
    throw wrong_usage("offset goes with the metrics log and relative, not with l2_cosine");
  if (o.refine_normals && turns())
    throw wrong_usage(
        fmt::format("normals are refined only with isotropic models: '{}' is anisotropic",
                    to_text(model().spec)));
  for (const auto* t : terms_of(model())) {
    const auto* own = foreign_term(t->term);
    if (own && o.refine_normals)
      throw wrong_usage(
          fmt::format("{}: normals are refined of the catalogue's terms, whose derivatives by the "
                      "normal are known",
                      foreign::text_of(own->function->name)));
  }
  is_shape = shapes_of(model());
  unknowns = unknowns_of(problem, is_shape, o.refine_normals);
  unknown_of.assign(model().value_count + 2, unknowns.count);
  for (std::size_t i = 0; i < unknowns.count; ++i) unknown_of[unknowns.slot[i]] = i;
  for (std::size_t c = 0; c < channels; ++c) {
    std::size_t count = o.refine_normals ? 2 : 0;
    for (const auto& q : model().parameters) count += problem.free.mask()[q.slot(c)];
    if (count >= max_columns)
      throw wrong_usage(
          fmt::format("{} unknowns per channel, the normal's tilt among them; at most {} can be "
                      "fitted at once",
                      count, max_columns - 1));
  }
  // Seen from above, light that comes back of a dull lobe resembles diffuse light: its valley and a
  // narrower lobe's lie apart.
  const auto* width = model().find("alpha");
  const auto is_dull = [&](const Start& start) {
    constexpr float dull = 0.5F;
    return std::ranges::any_of(start, [&](const auto& at) {
      return width && at.first == width->first && at.second > dull;
    });
  };
  const bool one_lobe = !turns() && model().lobes.size() < 2;
  for (auto& start : starts_of(problem, is_shape)) {
    const auto like = [&](const auto& group) {
      return one_lobe ? o.refine_normals || is_dull(group.front()) == is_dull(start)
                      : group.front().back().second == start.back().second;
    };
    auto group = start.empty() ? starts.begin() : std::ranges::find_if(starts, like);
    if (group == starts.end()) group = starts.insert(group, std::vector<Start>{});
    group->push_back(std::move(start));
  }
  has_dull_group = one_lobe && starts.size() == 2;
  is_linear = gonio::is_linear(problem, is_shape);
  while (is_linear && o.metric != Metric::log && unknowns.linear < unknowns.count &&
         unknowns.slot[unknowns.linear] < is_shape.size() &&
         !is_shape[unknowns.slot[unknowns.linear]])
    ++unknowns.linear;
}

}  // namespace gonio
