#pragma once
/// \file
/// A compute shader on the machine's Vulkan device, a software one where there is no other.

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace gonio::test {

class Vulkan {
 public:
  /// \param why  set where there is none: what is missing
  static std::unique_ptr<Vulkan> open(std::string& why);
  virtual ~Vulkan() = default;

  virtual std::string device() const = 0;
  /// Floats that a shader of 64 invocations a group leaves at binding 1 of those at binding 0.
  /// \param invocations  a multiple of 64
  virtual std::vector<float> run(std::span<const std::uint32_t> spirv,
                                 std::span<const float> inputs,
                                 std::size_t invocations,
                                 std::size_t outputs) = 0;
};

}  // namespace gonio::test
