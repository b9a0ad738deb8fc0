// Any words as SPIR-V that the validator passes, or any bytes as a .brdf file: read, run on
// symbols, or refused in one line.
#include <cstring>

#include "base/error.h"
#include "foreign/function.h"
#include "foreign/spirv_module.h"
#include "foreign/translate.h"

#include <spirv-tools/libspirv.hpp>

#ifdef GONIO_FUZZ_spirv
namespace {

void run(std::vector<std::uint32_t> words) {
  using namespace gonio::foreign;
  static const spvtools::SpirvTools tools(SPV_ENV_UNIVERSAL_1_6);
  if (!tools.Validate(words)) return;
  try {
    const SpirvModule module(std::move(words));
    for (const auto& [id, function] : module.functions()) {
      try {
        std::size_t next = 0;
        const auto t =
            translate(module, id, [&](Program& p, const std::string&, std::size_t size, Kind kind) {
              std::vector<Ref> r;
              for (std::size_t k = 0; k < size; ++k)
                r.push_back(kind == Kind::number ? p.input(next % 2 == 0, next % 11)
                                                 : p.constant(1, kind)),
                    ++next;
              return r;
            });
        with_derivatives(t.program, 2, true);
      } catch (const Refused&) {
      } catch (const std::out_of_range&) {
      }
    }
  } catch (const Refused&) {
  } catch (const std::out_of_range&) {
  }
}

}  // namespace
#endif

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
#ifdef GONIO_FUZZ_spirv
  if (size < 4) return 0;
  std::vector<std::uint32_t> words(size / 4);
  std::memcpy(words.data(), data, words.size() * 4);
  run(std::move(words));
#else
  try {
    gonio::foreign::source_of("input.brdf", {reinterpret_cast<const char*>(data), size});
  } catch (const gonio::Error& e) {
    if (e.code() != gonio::Exit::bad_input || std::string(e.what()).find('\n') != std::string::npos)
      std::abort();
  }
#endif
  return 0;
}
