#include "fitting/sample/shared_columns.h"

#include <algorithm>

namespace gonio {

template <class F>
std::shared_ptr<const FitLevels<F>> SharedColumns::levels(const Sampling& s,
                                                          std::span<const std::size_t> levels) {
  auto& kept = std::get<Kept<F>>(kept_);
  if (!kept.of || !kept.of->reads_like(s) || !std::ranges::equal(kept.levels, levels)) {
    kept.columns.reset();  // first: both at once may not fit
    kept.columns = std::make_shared<const FitLevels<F>>(fit_levels<F>(s, levels));
    kept.of.emplace(s);
    kept.levels.assign(levels.begin(), levels.end());
  }
  return kept.columns;
}

template std::shared_ptr<const FitLevels<float>> SharedColumns::levels(
    const Sampling&, std::span<const std::size_t>);
template std::shared_ptr<const FitLevels<double>> SharedColumns::levels(
    const Sampling&, std::span<const std::size_t>);

}  // namespace gonio
