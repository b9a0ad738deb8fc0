#include "fitting/map/choose.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/quantile.h"
#include "fitting/map/stack_sample.h"

#include <fmt/format.h>

namespace gonio {

std::vector<TriedModel> try_models(const StackReader& stack,
                                   const TexelOptions& asked,
                                   std::span<const std::string> models) {
  const TexelSample s = small_sample(stack);
  std::vector<std::vector<double>> left;
  for (const auto& model : models) {
    TexelOptions o = asked;
    o.model = model;
    check(o, s.channels);
    left.push_back(unseen_errors(s, o));
  }
  // The same texels for all: those that each model could be judged at.
  std::vector<TriedModel> tried;
  for (std::size_t m = 0; m < models.size(); ++m) {
    std::vector<double> seen;
    for (std::size_t t = 0; t < s.texels; ++t)
      if (std::ranges::all_of(left, [&](const auto& of) { return of[t] >= 0; }))
        seen.push_back(left[m][t]);
    if (seen.size() < few_texels)
      throw bad_input(
          stack.stack().path, "images",
          fmt::format("{} texels of a sample that all models can be compared at", seen.size()),
          fmt::format("{} or more: as many images with light as the models need", few_texels));
    tried.push_back({models[m], median(seen)});
  }
  constexpr double alike = 0.95;
  std::ranges::stable_sort(tried, {}, &TriedModel::unseen_rms);
  const auto named = [&](const TriedModel& t) {
    return std::ranges::find(models, t.model) - models.begin();
  };
  const auto end = std::ranges::find_if(
      tried, [&](const TriedModel& t) { return alike * t.unseen_rms > tried.front().unseen_rms; });
  std::ranges::stable_sort(tried.begin(), end, {}, named);
  return tried;
}

}  // namespace gonio
