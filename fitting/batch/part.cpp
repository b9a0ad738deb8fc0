#include "fitting/batch/part.h"

#include <cstdint>

#include "base/error.h"
#include "base/numbers.h"
#include "base/text.h"

#include <fmt/format.h>

namespace gonio {
namespace {

/// Whole number that digits alone are: a sign is none.
std::optional<std::uint64_t> count_from(std::string_view text) {
  return text.starts_with('+') ? std::nullopt : number_from<std::uint64_t>(text);
}

Part part_of_slurm(const Variable& variable) {
  const auto number = [&](const char* name) -> std::optional<std::uint64_t> {
    const auto text = variable(name);
    if (!text) return {};
    const auto value = count_from(*text);
    if (!value)
      throw wrong_usage(fmt::format("--part slurm: {} is '{}', expected a whole number", name,
                                    printable(*text, 40)));
    return value;
  };
  const auto needed = [&](const char* name) {
    const auto value = number(name);
    if (!value)
      throw wrong_usage(
          fmt::format("--part slurm: no {} here; it is for the tasks of sbatch --array=1-N", name));
    return *value;
  };
  const std::uint64_t id = needed("SLURM_ARRAY_TASK_ID"), least = needed("SLURM_ARRAY_TASK_MIN"),
                      n = needed("SLURM_ARRAY_TASK_COUNT");
  const auto step = number("SLURM_ARRAY_TASK_STEP"), last = number("SLURM_ARRAY_TASK_MAX");
  // Of a list of tasks, as --array=1,3,7, Slurm gives no step: its last task tells the gaps.
  if ((step && *step != 1) || (last && (*last < least || *last - least != n - 1)))
    throw wrong_usage(fmt::format(
        "--part slurm: the array has gaps, expected one of step 1: sbatch --array=1-{}", n));
  if (id < least || id - least >= n)
    throw wrong_usage(
        fmt::format("--part slurm: task {} is none of {} tasks from {} on", id, n, least));
  return {static_cast<std::size_t>(id - least) + 1, static_cast<std::size_t>(n)};
}

}  // namespace

std::string text_of(const Part& p) {
  return fmt::format("{}/{}", p.k, p.n);
}

Part part_from(std::string_view text, const Variable& variable) {
  if (text == "slurm") return part_of_slurm(variable);
  const auto words = split(text, '/');
  const auto k = count_from(words[0]), n = words.size() == 2 ? count_from(words[1]) : std::nullopt;
  if (!k || !n)
    throw wrong_usage(
        fmt::format("--part: found '{}', expected K/N, as 2/4, or slurm", printable(text, 40)));
  if (*k < 1 || *k > *n)
    throw wrong_usage(fmt::format("--part {}/{}: parts count from 1 to N", *k, *n));
  return {static_cast<std::size_t>(*k), static_cast<std::size_t>(*n)};
}

std::vector<std::size_t> share_of(const Part& p, std::size_t tables) {
  std::vector<std::size_t> places;
  for (std::size_t i = p.k - 1; i < tables; i += p.n) {
    places.push_back(i);
    if (tables - i <= p.n) break;  // i + n may be more than a number holds
  }
  return places;
}

}  // namespace gonio
