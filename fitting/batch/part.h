#pragma once
/// \file
/// Parts of a batch: which of its tables one of several processes fits.

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gonio {

/// Part k of n, 1 ≤ k ≤ n.
struct Part {
  std::size_t k = 1, n = 1;
  bool operator==(const Part&) const = default;
};
/// "2/4".
std::string text_of(const Part&);

/// Value of a variable of the environment, if it is there.
using Variable = std::function<std::optional<std::string>(const char* name)>;

/// Part that an option names: "2/4"; or "slurm", the task of an array: its number from the array's first, of as many as
/// the array has.  Of arrays with gaps part k would be another task's too: these are refused, as is all else, by wrong_usage.
Part part_from(std::string_view text, const Variable&);

/// Places of a part's tables among all, ascending: dealt out in turn, so that neighbours, which are often alike in size, go to
/// different parts.  Each place is in one part.
std::vector<std::size_t> share_of(const Part&, std::size_t tables);

}  // namespace gonio
