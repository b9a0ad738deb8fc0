#include "brdf/model/column_run.h"

#include <utility>
#include <vector>

namespace gonio {

std::function<void()> column_run(const BoundModel& b,
                                 std::shared_ptr<const AngleColumns<float>> x) {
  struct State {
    std::shared_ptr<const AngleColumns<float>> x;
    Evaluator<float> evaluate;
    std::vector<Column<float>> f{};
    std::vector<float*> out{};
  };
  auto s = std::make_shared<State>(State{std::move(x), Evaluator<float>(b.model)});
  const std::vector<float> values(b.values.begin(), b.values.end());
  s->evaluate.set(values);
  s->f.reserve(b.model.channels);
  for (std::size_t c = 0; c < b.model.channels; ++c)
    s->out.push_back(s->f.emplace_back(Column<float>(s->x->padded())).data());
  return [s] { s->evaluate(s->x->block(), s->out); };
}

}  // namespace gonio
