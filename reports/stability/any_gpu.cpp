// Forms under all that Vulkan allows a GPU: what is proved of them.
#include <algorithm>

#include "base/whole_loop.h"
#include "brdf/catalogue/registry.h"
#include "reports/stability/measure.h"
#include "reports/stability/stability.h"
#include "stability/answer.h"
#include "stability/prove.h"
#include "stability/prove_relative.h"

#include <fmt/format.h>

namespace gonio {

void stabilities::narrow_to_shaders(stability::Subject& s, Number number) {
  struct Part {
    std::string_view input;
    Range in_float, in_half;
  };
  static constexpr Part parts[] = {{"alpha", {1e-3, 1}, {0.1, 1}},
                                   {"sin2_theta_h", {1e-6, 0.999}, {1e-3, 0.9}},
                                   {"noh", {0.03, 0.9999995}, {0.3, 0.9995}},
                                   {"nol", {1e-3, 1}, {0.1, 1}},
                                   {"nov", {1e-3, 1}, {0.1, 1}},
                                   {"voh", {1e-3, 0.999}, {0.1, 0.85}},
                                   {"f0", {0.02, 1}, {0.02, 1}},
                                   {"eta", {1.1, 3}, {1.1, 3}},
                                   {"k", {0.1, 10}, {0.1, 10}}};
  for (auto& input : s.inputs)
    if (const auto at = std::ranges::find(parts, input.name, &Part::input); at != std::end(parts))
      input.domain = number == Number::half ? at->in_half : at->in_float;
}

namespace {

using namespace stability;
using Depth = StabilityOptions::Setting;

std::string text_of_domain(const Subject& s, const std::vector<Range>& domain) {
  std::string text;
  for (std::size_t k = 0; k < domain.size(); ++k)
    text += fmt::format("{}{} {:.4g} to {:.7g}", k ? ", " : "", s.inputs[k].name, domain[k].low,
                        domain[k].high);
  return text;
}

AnyGpuRow row_of(Subject s, Number number, double seconds) {
  stabilities::narrow_to_shaders(s, number);
  const Rounding rule = rounding_of({.number = number, .any_gpu = true});
  const auto relative = prove_relative(s, number, rule, seconds);
  const auto finite = prove(s, number, rule, finite_values(number), {.boxes = 500});
  AnyGpuRow row{s.id,
                std::string(s.form()),
                std::string(name_of(number)),
                text_of_domain(s, relative.domain),
                relative.bound ? Evidence::proved : Evidence::open,
                relative.bound,
                false,
                finite.holds(),
                relative.why};
  row.keeps = relative.bound && *relative.bound <= any_gpu_tolerance;
  if (relative.bound && !row.keeps) row.why = "the bound that is proved is larger";
  return row;
}

}  // namespace

std::vector<AnyGpuRow> any_gpu_rows(const StabilityOptions& o) {
  static constexpr std::string_view few[] = {"ndf.ggx", "masking.smith_ggx.correlated",
                                             "masking.ue_joint", "fresnel.schlick"};
  const bool brief = o.setting == Depth::brief;
  std::vector<Subject> subjects;
  for (const auto& id : stabilities::forms(o)) {
    if (brief && std::ranges::find(few, id) == std::end(few)) continue;
    for (auto& s : subjects_of(id)) subjects.push_back(std::move(s));
  }
  std::vector<Number> numbers{Number::float_};
  if (!brief) numbers.push_back(Number::half);
  std::vector<AnyGpuRow> rows(numbers.size() * subjects.size());
  for_each_whole(rows.size(), [&](std::size_t k) {
    rows[k] = row_of(subjects[k % subjects.size()], numbers[k / subjects.size()],
                     brief                      ? 1.5
                     : o.setting == Depth::full ? 10
                                                : 3);
  });
  return rows;
}

}  // namespace gonio
