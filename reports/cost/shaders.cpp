// What whole models take in a shader.
#include "reports/cost/models.h"
#include "reports/cost/studies.h"
#include "shader/program.h"

namespace gonio::costing {

std::vector<ShaderRow> shader_rows() {
  using shader::Instructions;
  std::vector<ShaderRow> rows;
  for (const auto& w : wholes()) {
    const auto f = shader::trace_model(bind_model(w.id, {}, 3), shader::Precision::float_, {}, {});
    ShaderRow row{w.id, f.operations()};
    if (const auto counted = shader::compiled_instructions(f))
      for (std::size_t k = 0; k < Instructions::kinds.size(); ++k)
        row.instructions.emplace_back(Instructions::kinds[k], counted->by_kind[k]);
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace gonio::costing
