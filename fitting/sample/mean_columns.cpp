#include "fitting/sample/mean_columns.h"

namespace gonio {
namespace {

std::size_t count_angles(const ApertureAngles& a, std::span<const std::size_t> samples) {
  std::size_t n = 0;
  for (const std::size_t i : samples) n += a.end(i) - a.begin(i);
  return n;
}

}  // namespace

template <class F>
MeanColumns<F>::MeanColumns(const ApertureAngles& a,
                            std::span<const std::size_t> samples,
                            std::size_t padded,
                            bool frame)
    : angles_(count_angles(a, samples), frame), weight_(angles_.padded()) {
  std::size_t at = 0;
  for (const std::size_t i : samples) {
    for (std::size_t k = a.begin(i); k < a.end(i); ++k, ++at) {
      angles_.set(at, a.angles(k));
      weight_[at] = static_cast<F>(a.weight(k));
    }
    end_.push_back(static_cast<std::uint32_t>(at));
  }
  end_.resize(padded, static_cast<std::uint32_t>(at));
  block_ = {angles_.block(), weight_.data(), end_.data()};
}

template class MeanColumns<float>;
template class MeanColumns<double>;

}  // namespace gonio
