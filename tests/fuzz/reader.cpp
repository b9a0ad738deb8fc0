// Any bytes given to one reader of tables.
#include <fstream>

#include "base/file.h"
#include "fuzz/one_file.h"
#include "table/format/formats.h"
#include "table/format/metadata.h"
#include "table/health/health.h"

namespace {

using namespace gonio;

Table read(InputFile& in) {
#if defined(GONIO_FUZZ_merl)
  return read_merl(in);
#elif defined(GONIO_FUZZ_mbsdf)
  return read_mbsdf(in);
#elif defined(GONIO_FUZZ_csv)
  return read_csv(in);
#elif defined(GONIO_FUZZ_exr)
  return read_exr_slice(in.path());
#elif defined(GONIO_FUZZ_rgl)
  return read_rgl(in);
#elif defined(GONIO_FUZZ_klems)
  return read_klems(in);
#elif defined(GONIO_FUZZ_zemax)
  return read_zemax(in);
#elif defined(GONIO_FUZZ_brdf_json)
  return read_brdf_json(in);
#elif defined(GONIO_FUZZ_xompt)
  return read_xompt(in);
#elif defined(GONIO_FUZZ_alta)
  return read_alta(in);
#elif defined(GONIO_FUZZ_utia)
  return read_utia(in);
#elif defined(GONIO_FUZZ_ngan)
  return read_ngan(in);
#elif defined(GONIO_FUZZ_astm)
  return read_astm(in);
#elif defined(GONIO_FUZZ_ssdd)
  return read_ssdd(in);
#elif defined(GONIO_FUZZ_side)
  const std::string text = in.read_rest();
  column_map("side", text);
  Table t;
  t.where = mbsdf_grid(1, 2, Bins::centre);
  t.channels = {"f"};
  t.values.emplace_back(2, 0.5);
  apply_metadata(t, "side", text);
  return t;
#endif
}

/// Questions that every user of a table asks of it.
void use(const Table& t) {
  const SampleAngles at(t);
  std::size_t valid = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const auto a = at(i);
    for (const auto& plane : t.values) valid += mask(a, plane[i]) == Mask::valid;
  }
  if (valid > t.size() * t.values.size()) std::abort();
  const Interpolator f(t);
  for (const double theta : {0.0, 0.7, 1.5})
    for (const double phi : {-3.1, 0.0, 2.0})
      for (std::size_t c = 0; c < t.values.size(); ++c)
        f({direction(theta, phi), direction(theta + 0.05, -phi)}, c);
  if (t.size() <= 2000) inspect(t);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::read_as_file(data, size, [&](const std::string& path) {
#if defined(GONIO_FUZZ_utia)  // whose files all have one size, more than a fuzzer tries
    std::string bytes(1'990'656, '\0');
    for (std::size_t k = 0; size > 0 && k < bytes.size(); ++k)
      bytes[k] = static_cast<char>(data[k % size]);
    std::ofstream(path, std::ios::binary) << bytes;
#endif
    InputFile in(path);
    use(read(in));
  });
}
