#include "reports/finding/words.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {
namespace {

constexpr double least_read = 1e-4;  ///< below it two digits would need a power

}  // namespace

std::string percent(double share, int digits) {
  const double y = 100 * std::abs(share);
  const bool large = y >= std::pow(10, digits) - 0.5;
  return fmt::format("{}{}\u00a0%", share < 0 ? "−" : "",
                     large ? fmt::format("{:.0f}", y) : fmt::format("{:.{}g}", y, digits));
}

std::string percent_given(double share) {
  return in_percent(share) + "\u00a0%";
}
std::string percent_at_most(double share, int digits) {
  return rounded_up(100 * share, digits) + "\u00a0%";
}

std::string short_text(double x) {
  if (x > 0 && x < least_read) return "under 0.0001";
  return x < 9.95 ? fmt::format("{:.2g}", x) : fmt::format("{:.0f}", x);
}
std::string at_most(double x, int digits) {
  return "≤ " + rounded_up(std::max(x, x > 0 ? least_read : x), digits);
}
std::string ns_text(double ns) {
  const double size = std::abs(ns);
  return fmt::format("{:.{}f} ns", size, size < 0.995 ? 2 : size < 9.95 ? 1 : 0);
}
std::string number_or_none(std::size_t n) {
  return n == 0 ? "none" : fmt::format("{}", n);
}
std::string of_all(std::size_t n, std::size_t all) {
  return fmt::format("{} of {}", number_or_none(n), all);
}

std::string place(double roughness, double mu) {
  return fmt::format("roughness {:g}, cosine {:g}", roughness, mu);
}
std::string at_angle(double mu) {
  return mu == 0   ? "on average"
         : mu == 1 ? "at normal incidence"
                   : fmt::format("at cosine {:g}", mu);
}
std::string first_text(double from) {
  return fmt::format("{:.2f}", std::ceil(100 * from - 1e-9) / 100);
}
std::string last_text(double to) {
  return fmt::format("{:.2f}", std::floor(100 * to + 1e-9) / 100);
}
std::string range_text(double from, double to, const std::string& word) {
  if (to >= 1) return fmt::format("from {}{} on", word, first_text(from));
  return fmt::format("from {}{} to {}", word, first_text(from), last_text(to));
}

std::string list_text(const std::vector<std::string>& all, std::string_view last) {
  if (all.size() < 2) return all.empty() ? "" : all[0];
  return fmt::format("{}{}{}", fmt::join(all.begin(), all.end() - 1, ", "), last, all.back());
}

}  // namespace gonio
