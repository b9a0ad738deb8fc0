#include "base/record.h"

#include <cstring>

namespace gonio {
namespace {

template <class N>
N load(const void* from) {
  N value;
  std::memcpy(&value, from, sizeof value);
  return value;
}
template <class N>
void store(void* to, N value) {
  std::memcpy(to, &value, sizeof value);
}

}  // namespace

double ValueType::number(const void* v) const {
  return size == sizeof(float) ? static_cast<double>(load<float>(v)) : load<double>(v);
}

void ValueType::set_number(void* v, double to) const {
  return size == sizeof(float) ? store(v, static_cast<float>(to)) : store(v, to);
}

std::int64_t ValueType::whole(const void* v) const {
  switch (size) {
    case 1:
      return is_signed ? load<std::int8_t>(v) : load<std::uint8_t>(v);
    case 2:
      return is_signed ? load<std::int16_t>(v) : load<std::uint16_t>(v);
    case 4:
      return is_signed ? load<std::int32_t>(v) : std::int64_t{load<std::uint32_t>(v)};
    default:
      return load<std::int64_t>(v);
  }
}

void ValueType::set_whole(void* v, std::int64_t to) const {
  switch (size) {
    case 1:
      return store(v, static_cast<std::uint8_t>(to));
    case 2:
      return store(v, static_cast<std::uint16_t>(to));
    case 4:
      return store(v, static_cast<std::uint32_t>(to));
    default:
      return store(v, to);
  }
}

}  // namespace gonio
