#include "table/format/rgl/tensor_file.h"

#include <algorithm>
#include <array>
#include <bit>

#include "base/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {

static_assert(std::endian::native == std::endian::little, "the files are little-endian");

template <class T>
T TensorFile::next() {
  T value{};
  in_.read(&value, sizeof value);
  return value;
}

TensorFile::TensorFile(InputFile& in) : in_(in) {
  std::array<char, tensor_magic.size()> magic{};
  in.read(magic.data(), magic.size());
  const auto major = next<std::uint8_t>(), minor = next<std::uint8_t>();
  if (major != 1)
    throw bad_input(in.path(), "byte 12", fmt::format("version {}.{}", major, minor), "1.0");
  const auto count = next<std::uint32_t>();
  if (count > 1024)
    throw bad_input(in.path(), "byte 14", fmt::format("{} fields", count), "at most 1024");
  for (std::uint32_t k = 0; k < count; ++k) {
    Tensor t;
    t.name.resize(next<std::uint16_t>());
    in.read(t.name.data(), t.name.size());
    const std::size_t dimensions = next<std::uint16_t>();
    t.type = next<std::uint8_t>();
    t.offset = next<std::uint64_t>();
    if (dimensions > 8) fail(t.name, fmt::format("{} dimensions", dimensions), "at most 8");
    for (std::size_t d = 0; d < dimensions; ++d) t.shape.push_back(next<std::uint64_t>());
    tensors_.push_back(std::move(t));
  }
}

bool TensorFile::has(std::string_view name) const {
  return std::ranges::find(tensors_, name, &Tensor::name) != tensors_.end();
}

const Tensor& TensorFile::tensor(std::string_view name,
                                 Tensor::Type type,
                                 std::size_t dimensions) const {
  const auto t = std::ranges::find(tensors_, name, &Tensor::name);
  if (t == tensors_.end()) fail(name, "no such field", "one");
  if (t->type != type)
    fail(name, fmt::format("type {}", t->type),
         type == Tensor::bytes ? "1 (bytes)" : "10 (32-bit floating point)");
  if (t->shape.size() != dimensions)
    fail(name, fmt::format("{} dimensions", t->shape.size()), fmt::format("{}", dimensions));
  // Divided, not multiplied: the product of 64-bit numbers may not fit.
  std::uint64_t left = t->offset > in_.size() ? 0 : in_.size() - t->offset;
  left /= type == Tensor::floats ? sizeof(float) : 1;
  for (const auto n : t->shape) left = n == 0 ? 0 : left / n;
  if (left == 0)
    fail(name, fmt::format("shape {} at byte {}", fmt::join(t->shape, " × "), t->offset),
         "a field inside the file");
  return *t;
}

const Tensor& TensorFile::shaped(std::string_view name,
                                 const std::vector<std::uint64_t>& shape,
                                 Tensor::Type type) const {
  const Tensor& t = tensor(name, type, shape.size());
  if (t.shape != shape)
    fail(name, fmt::format("shape {}", fmt::join(t.shape, " × ")),
         fmt::format("{}", fmt::join(shape, " × ")));
  return t;
}

std::vector<float> TensorFile::floats(const Tensor& t, std::uint64_t most) const {
  std::uint64_t count = 1;
  for (const auto n : t.shape) count *= n;  // at most the file's size: see tensor()
  if (count > most) fail(t.name, fmt::format("{} values", count), fmt::format("at most {}", most));
  std::vector<float> values(count);
  in_.read_at(t.offset, values.data(), count * sizeof(float));
  return values;
}

std::vector<char> TensorFile::bytes(std::string_view name,
                                    const std::vector<std::uint64_t>& shape) const {
  const Tensor& t = shaped(name, shape, Tensor::bytes);
  std::uint64_t count = 1;
  for (const auto n : shape) count *= n;
  std::vector<char> values(count);
  in_.read_at(t.offset, values.data(), count);
  return values;
}

bool TensorFile::flag(std::string_view name) const {
  const Tensor& t = tensor(name, Tensor::bytes, 1);
  char value = 0;
  in_.read_at(t.offset, &value, 1);
  return value != 0;
}

void TensorFile::fail(std::string_view field,
                      const std::string& found,
                      const std::string& expected) const {
  throw bad_input(in_.path(), fmt::format("field {}", field), found, expected);
}

namespace {

/// Data begin at multiples of it, as in RGL's own files.
constexpr std::uint64_t aligned = 8;

template <class T>
void append(std::string& to, T value) {
  to.append(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

void TensorWriter::bytes(std::string name, std::string_view text) {
  bytes(std::move(name), {text.size()}, text);
}

void TensorWriter::bytes(std::string name,
                         std::vector<std::uint64_t> shape,
                         std::span<const char> values) {
  fields_.push_back(
      {{std::move(name), Tensor::bytes, 0, std::move(shape)}, {values.data(), values.size()}});
}

void TensorWriter::floats(std::string name,
                          std::vector<std::uint64_t> shape,
                          std::span<const float> values) {
  fields_.push_back({{std::move(name), Tensor::floats, 0, std::move(shape)},
                     {reinterpret_cast<const char*>(values.data()), values.size_bytes()}});
}

void TensorWriter::write(OutputFile& out) const {
  const auto padded = [](std::uint64_t n) { return (n + aligned - 1) / aligned * aligned; };
  std::uint64_t offset = tensor_magic.size() + 6;
  for (const auto& f : fields_) offset += 13 + f.head.name.size() + 8 * f.head.shape.size();
  std::string head(tensor_magic);
  head += std::string_view("\1\0", 2);
  append(head, static_cast<std::uint32_t>(fields_.size()));
  for (const auto& f : fields_) {
    offset = padded(offset);
    append(head, static_cast<std::uint16_t>(f.head.name.size()));
    head += f.head.name;
    append(head, static_cast<std::uint16_t>(f.head.shape.size()));
    append(head, f.head.type);
    append(head, offset);
    for (const auto n : f.head.shape) append(head, n);
    offset += f.data.size();
  }
  out.write(head);
  std::uint64_t at = head.size();
  for (const auto& f : fields_) {
    out.write(std::string_view("\0\0\0\0\0\0\0", padded(at) - at));
    out.write(f.data);
    at = padded(at) + f.data.size();
  }
}

}  // namespace gonio
