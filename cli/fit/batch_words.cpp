#include "cli/fit/batch_words.h"

#include <algorithm>
#include <filesystem>

#include "cli/line/terminal.h"

#include <fmt/format.h>

namespace gonio::cli {
namespace {

constexpr std::size_t shown = 5;

const char* words(LeftOut why) {
  switch (why) {
    case LeftOut::made_otherwise:
      return "made by another version or with other options";
    case LeftOut::another_of_its_table:
      return "of a table that has a newer one";
    case LeftOut::unreadable:
      return "cannot be read";
  }
  return "";
}

}  // namespace

std::string some_of(const std::vector<std::string>& names) {
  std::string list;
  for (std::size_t k = 0; k < std::min(shown, names.size()); ++k)
    list += fmt::format("{}{}", k ? ", " : "", names[k]);
  if (names.size() > shown) list += fmt::format(" and {} more", names.size() - shown);
  return list;
}

void print_rows(const BatchSummary& s, std::size_t kept) {
  const auto of = [&](Exit outcome) {
    return static_cast<std::size_t>(std::ranges::count(s.rows, outcome, &BatchRow::outcome));
  };
  const auto failures = of(Exit::bad_input) + of(Exit::usage);
  const auto converged = of(Exit::done), left = of(Exit::not_converged);
  std::string line =
      fmt::format("{}{}: {} fitted", s.rows.size(), s.part.empty() ? "" : " of part " + s.part,
                  converged + left - kept);
  if (kept) line += fmt::format(", {} kept from before", kept);
  if (failures) line += fmt::format(", {} failed", failures);
  if (left) line += fmt::format("; {} did not converge", left);
  say("tables   {}\n", line);
  std::size_t k = 0;
  for (const auto& row : s.rows)
    if (row.document.empty() && k++ < shown) say("failed   {}\n", row.message);
  if (failures > shown) say("         and {} more, see the summary\n", failures - shown);
}

void print_left_out(const BatchSummary& s) {
  for (const LeftOut why :
       {LeftOut::made_otherwise, LeftOut::another_of_its_table, LeftOut::unreadable}) {
    std::vector<std::string> names;
    for (const auto& d : s.left_out)
      if (d.why == why) names.push_back(d.document);
    if (!names.empty())
      say_below("beware  ",
                fmt::format("{} there, {}, not in the summary: {}",
                            counted(names.size(), "document"), words(why), some_of(names)));
  }
}

void print_summary_place(const std::string& folder) {
  say("results  {}, .csv\n", (std::filesystem::path(folder) / "summary.html").string());
}

}  // namespace gonio::cli
