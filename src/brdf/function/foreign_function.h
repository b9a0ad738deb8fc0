#pragma once
/// \file
/// Rows of foreign terms, for the files that compile them for their numbers.

#include <array>
#include <map>
#include <memory>

#include "brdf/function/any_function.h"
#include "foreign/interpret.h"

namespace gonio {

/// Keeps what the making of a program costs out of this thread's count of operations.
template <class T>
struct NotCounted {};
template <class B>
struct NotCounted<Counted<B>> {
  Operations before = operations_so_far;
  ~NotCounted() { operations_so_far = before; }
};

/// A program on this thread, ready to run.
template <class T>
foreign::Interpreter<T>& foreign_interpreter(const foreign::Program& p) {
  thread_local std::map<const foreign::Program*, std::unique_ptr<foreign::Interpreter<T>>> all;
  auto& run = all[&p];
  if (!run) {
    [[maybe_unused]] const NotCounted<T> making{};
    run = std::make_unique<foreign::Interpreter<T>>(p);
  }
  return *run;
}

#define GONIO_FOREIGN_ROWS(T)                                                             \
  template <>                                                                             \
  void foreign_rows<T>(const ForeignTerm& t, std::span<const T> parameters,               \
                       std::span<const FrameAngles<T>> rows, Quotient<T>* out) {          \
    auto& run = foreign_interpreter<T>(t.program());                                      \
    run.set(parameters);                                                                  \
    const auto in = [&](std::size_t k, std::size_t i) -> T {                              \
      const auto& a = rows[i];                                                            \
      const std::array<const T*, foreign::angle_names.size()> at{                         \
          &a.nol, &a.nov, &a.noh, &a.voh, &a.sin2_theta_h, &a.xoh,                        \
          &a.yoh, &a.xol, &a.yol, &a.xov, &a.yov};                                        \
      return *at[k];                                                                      \
    };                                                                                    \
    run.run(rows.size(), in,                                                              \
            [&](std::size_t, std::size_t i, const T& v) { out[i] = as_quotient<T>(v); }); \
  }

}  // namespace gonio
