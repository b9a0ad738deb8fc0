#include "fitting/choice/cross_validation.h"

#include <algorithm>

#include "fitting/sample/incident_angles.h"
#include "fitting/solve/problem.h"
#include "fitting/solve/search.h"

#include <tbb/parallel_for.h>

namespace gonio {
namespace {

constexpr std::size_t most_groups = 65'536;

/// Table of which only some samples weigh anything.
Table with_only(const Table& t, auto&& keep) {
  Table part = t;
  part.weights.resize(t.size(), 1);
  for (std::size_t i = 0; i < part.weights.size(); ++i)
    if (!keep(i)) part.weights[i] = 0;
  return part;
}

LogResiduals left_out(const Table& t,
                      const FitOptions& o,
                      const Blocks& blocks,
                      std::size_t block,
                      const BoundModel& whole) {
  const auto is_left_out = [&](std::size_t i) { return blocks.of_sample[i] == block; };
  const Table seen = with_only(t, [&](std::size_t i) {
    return !is_left_out(i) && (blocks.of_exchanged.empty() || blocks.of_exchanged[i] != block);
  });
  const Problem p = pose(seen, o);
  Sampling sampling(seen, t.bins(), o.metric, p.offset, is_reciprocal(p.start) && !o.robust,
                    o.copies, p.start.model.anisotropic);
  sampling.set_bulk(bulk_of(p, sampling));
  const Fitted start{whole, no_huber, {}, false, 0};
  const Fitted found = compared_by(sampling, p, most_groups, start);
  const Table unseen = with_only(t, is_left_out);
  const Sampling rest(unseen, t.bins(), Metric::log, p.offset, false, o.copies,
                      p.start.model.anisotropic);
  return total(log_residuals(rest, found.model, most_groups));
}

}  // namespace

Blocks incident_blocks(const Sampling& s, std::size_t most) {
  const Table& t = s.table();
  const IncidentKeys keys(s);
  std::vector<bool> met(keys.count());  // keys rise with the angle
  std::vector<std::size_t> key(t.size());
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double nol = s.angles()(i).nol;
    key[i] = keys(i, std::clamp(nol, 0.0, 1.0));
    if (nol > 0) met[key[i]] = true;
  }
  const auto angles = static_cast<std::size_t>(std::ranges::count(met, true));
  Blocks b;
  if (angles < 2) return b;
  b.count = std::min(most, angles);
  std::vector<std::uint16_t> of_key(keys.count(), 0);
  for (std::size_t k = 0, rank = 0; k < met.size(); ++k)
    if (met[k]) of_key[k] = static_cast<std::uint16_t>(rank++ * b.count / angles);
  b.of_sample.resize(t.size());
  for (std::size_t i = 0; i < t.size(); ++i) b.of_sample[i] = of_key[key[i]];
  if (const Grid* grid = t.grid(); grid && grid->kind == Grid::Kind::half_difference)
    for (std::size_t i = 0; i < t.size(); ++i)
      b.of_exchanged.push_back(of_key[keys(i, std::clamp(s.angles()(i).nov, 0.0, 1.0))]);
  return b;
}

std::vector<LogResiduals> cross_validate(const Table& t,
                                         const FitOptions& o,
                                         const Blocks& blocks,
                                         const BoundModel& whole) {
  std::vector<LogResiduals> all(blocks.count);
  tbb::parallel_for(std::size_t{0}, all.size(),
                    [&](std::size_t b) { all[b] = left_out(t, o, blocks, b, whole); });
  return all;
}

}  // namespace gonio
