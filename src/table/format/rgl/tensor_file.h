#pragma once
/// \file
/// Tensor files, the container of the RGL's measurements: named fields of bytes or floats.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/file.h"
#include "table/table.h"

namespace gonio {

inline constexpr std::string_view tensor_magic{"tensor_file\0", 12};

struct Tensor {
  enum Type : std::uint8_t { bytes = 1, floats = 10 };

  std::string name;
  std::uint8_t type;
  std::uint64_t offset;
  std::vector<std::uint64_t> shape;
};

/// The fields of a file, read one by one when asked for.  Every failure is Error(bad_input) with the
/// field.
class TensorFile {
 public:
  explicit TensorFile(InputFile& in);

  bool has(std::string_view name) const;
  /// The shape of a field, which must have so many dimensions, none of them empty, and lie in the file.
  const Tensor& tensor(std::string_view name, Tensor::Type type, std::size_t dimensions) const;
  /// A field that must have this shape and lie in the file.
  const Tensor& shaped(std::string_view name,
                       const std::vector<std::uint64_t>& shape,
                       Tensor::Type type = Tensor::floats) const;
  /// \param most  refuses more values than that
  std::vector<float> floats(const Tensor&, std::uint64_t most = most_values) const;
  bool flag(std::string_view name) const;
  /// A field of bytes, which must have this shape and lie in the file.
  std::vector<char> bytes(std::string_view name, const std::vector<std::uint64_t>& shape) const;
  [[noreturn]] void fail(std::string_view field,
                         const std::string& found,
                         const std::string& expected) const;

 private:
  template <class T>
  T next();

  InputFile& in_;
  std::vector<Tensor> tensors_;
};

/// The fields of a file to be, written one after the other.
class TensorWriter {
 public:
  void bytes(std::string name, std::string_view text);
  void bytes(std::string name, std::vector<std::uint64_t> shape, std::span<const char> values);
  void floats(std::string name, std::vector<std::uint64_t> shape, std::span<const float> values);
  /// \pre what was handed in is still there
  void write(OutputFile&) const;

 private:
  struct Field {
    Tensor head;
    std::string_view data;
  };
  std::vector<Field> fields_;
};

}  // namespace gonio
