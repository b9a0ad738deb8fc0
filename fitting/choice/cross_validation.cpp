#include "fitting/choice/cross_validation.h"

#include <algorithm>

#include "base/whole_loop.h"
#include "fitting/sample/incident_angles.h"
#include "fitting/solve/search.h"

namespace gonio {
namespace {

constexpr std::size_t most_fold_groups = 65'536;

/// Ways to look at a table: as it is fitted, and as what is left out is judged.
struct Looks {
  Sampling fitted, judged;
};

LogResiduals left_out(const Looks& look,
                      const Problem& p,
                      const Blocks& blocks,
                      std::size_t block,
                      const BoundModel& whole) {
  const std::size_t n = blocks.of_sample.size();
  std::vector<bool> not_fitted(n), not_judged(n);
  for (std::size_t i = 0; i < n; ++i) {
    const bool left = blocks.of_sample[i] == block;
    not_judged[i] = !left;
    not_fitted[i] = left || (!blocks.of_exchanged.empty() && blocks.of_exchanged[i] == block);
  }
  Sampling seen = look.fitted.without(std::move(not_fitted));
  seen.set_bulk(bulk_of(p, seen));
  const Fitted start{whole, no_huber, {}, false, 0};
  const Fitted found = compared_by(seen, p, most_fold_groups, start);
  return total(
      log_residuals(look.judged.without(std::move(not_judged)), found.model, most_fold_groups));
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
                                         const Problem& p,
                                         const Blocks& blocks,
                                         const BoundModel& whole) {
  // A fit of fewer values than parameters would stay where that of the whole table is, which has
  // seen what is left out.
  std::vector<std::size_t> fitted(blocks.count, 0);
  for (std::size_t i = 0; i < t.size(); ++i)
    for (std::size_t b = 0; b < blocks.count; ++b)
      fitted[b] +=
          blocks.of_sample[i] != b && (blocks.of_exchanged.empty() || blocks.of_exchanged[i] != b);
  if (blocks.count == 0 || std::ranges::min(fitted) * t.channels.size() <= p.free.size()) return {};
  std::vector<LogResiduals> all(blocks.count);
  const Looks look{sampling_for(p, t, t.bins(), folds(p)),
                   sampling_for(p, t, t.bins()).by(Metric::log, p.offset)};
  for_each_whole(all.size(), [&](std::size_t b) { all[b] = left_out(look, p, blocks, b, whole); });
  return all;
}

}  // namespace gonio
