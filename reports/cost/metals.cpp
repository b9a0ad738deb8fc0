// Errors of the Fresnel forms on metals.
#include <cmath>
#include <map>

#include "reports/cost/cost.h"
#include "reports/measure/fresnel_error.h"

namespace gonio {

std::vector<MetalError> errors_on_metals() {
  struct Sum {
    double squares = 0;
    std::size_t n = 0;
  };
  std::map<std::string, Sum> forms;
  for (const auto& m : metals())
    for (const auto& r : fresnel_errors(spectral(m), 90)) {
      auto& s = forms[r.form];
      s.squares += r.rms * r.rms;
      ++s.n;
    }
  forms["fresnel.conductor"];  // the truth itself
  std::vector<MetalError> out;
  for (const auto& [form, s] : forms)
    out.push_back({form, s.n ? std::sqrt(s.squares / static_cast<double>(s.n)) : 0});
  return out;
}

}  // namespace gonio
