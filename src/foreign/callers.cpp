#include "foreign/callers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "foreign/compiled_file.h"
#include "foreign/spirv_words.h"

namespace gonio::foreign {
namespace {

/// True of π and 1/π, maybe with a power of two up to 4.
bool is_of_pi(double v) {
  constexpr double same = 1e-3, most = 2;
  return std::ranges::any_of(std::array{v / std::numbers::pi, v * std::numbers::pi}, [](double x) {
    const double power = std::log2(x), whole = std::round(power);
    return std::abs(power - whole) < same && std::abs(whole) <= most;
  });
}

}  // namespace

std::vector<std::string> callers_with_pi(const std::string& path, const std::string& function) {
  const auto c = file_of(path);
  const auto called = c->functions.find(function);
  if (called == c->functions.end()) return {};
  std::set<Id> of_pi;
  const auto has_pi = [&](const Instruction& i) {
    return std::ranges::any_of(i.in, [&](Id id) { return of_pi.contains(id); });
  };
  for (const auto& g : c->module->globals())
    if ((g.op == spv::OpConstant && is_of_pi(number_of(*c->module, g).value_or(0))) ||
        (g.op == spv::OpConstantComposite && has_pi(g)))
      of_pi.insert(g.id);
  std::vector<std::string> all;
  for (const auto& [name, id] : c->functions) {
    bool calls = false, takes_pi = false;
    for (const auto& block : c->module->functions().at(id).blocks)
      for (const auto& i : block.code) {
        calls = calls || (i.op == spv::OpFunctionCall && i.in[0] == called->second);
        const std::array products{spv::OpFMul, spv::OpFDiv, spv::OpVectorTimesScalar,
                                  spv::OpCompositeConstruct};  // a vector of π, which divides
        takes_pi = takes_pi || (has_pi(i) && std::ranges::find(products, i.op) != products.end());
      }
    if (calls && takes_pi) all.push_back(name);
  }
  return all;
}

}  // namespace gonio::foreign
