#include "reports/page/numbers.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace gonio::page {
namespace {

std::string with_minus(std::string s) {
  if (s.starts_with('-')) s.replace(0, 1, "−");
  return s;
}
std::string superscript(int n) {
  constexpr std::array digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string out;
  for (const char c : fmt::format("{}", n))
    out += c == '-' ? "⁻" : digits[static_cast<std::size_t>(c - '0')];
  return out;
}

}  // namespace

std::string significant(double x, int digits) {
  if (!std::isfinite(x)) return "–";
  if (x == 0) return "0";
  const auto rounded = fmt::format("{:.{}e}", x, digits - 1);
  const int power = std::stoi(rounded.substr(rounded.find('e') + 1));
  if (power < -4 || power > 6)
    return with_minus(rounded.substr(0, rounded.find('e'))) + "·10" + superscript(power);
  const auto text = fmt::format("{:.{}f}", x, std::max(0, digits - 1 - power));
  if (power >= 4 && digits - 1 <= power)
    return (x < 0 ? "−" : "") + count_text(static_cast<std::size_t>(std::llround(std::abs(x))));
  return with_minus(text);
}
std::string plain(double x, int digits) {
  if (!std::isfinite(x)) return "–";
  const auto text = fmt::format("{:.{}g}", x, digits);
  return with_minus(text.find('e') == text.npos ? text : fmt::format("{}", std::stod(text)));
}
std::string count_text(std::size_t n) {
  std::string s = std::to_string(n);
  for (std::size_t at = s.size(); at > 3;) s.insert(at -= 3, "\u202f");
  return s;
}
std::string many(std::size_t n, std::string_view thing) {
  return fmt::format("{} {}{}", count_text(n), thing, n == 1 ? "" : "s");
}
std::string percent(double share, int digits) {
  std::string text = significant(100 * share, digits);
  // Not all is never told as all.
  constexpr int most = 9;
  while (share < 1 && text == "100" && digits < most) text = significant(100 * share, ++digits);
  return text + "\u202f%";
}
std::string signed_percent(double share) {
  return (share > 0 ? "+" : "") + percent(share);
}
std::string times(double x) {
  if (x < 0.1) return significant(x, 2) + "\u202f×";
  return fmt::format("{:.{}f}\u202f×", x, x < 9.95 ? 1 : 0);
}
std::string ratio_text(double ln) {
  if (!std::isfinite(ln)) return "–";
  const double f = std::exp(std::abs(ln));
  const auto text = f < 10 ? fmt::format("{:.{}f}", f, f < 1.1 ? 3 : 2) : significant(f);
  if (text == "1.000") return "×1";
  return (ln < 0 ? "÷" : "×") + text;
}
std::string factor_text(double log_rms) {
  return "×/÷\u202f" + ratio_text(std::abs(log_rms)).substr(std::string_view("×").size());
}
std::string milliseconds_text(double ms) {
  return ms >= 1000 ? significant(ms / 1000) + "\u202fs" : significant(ms) + "\u202fms";
}
std::string with_error(double x, double error) {
  if (!(error > 0) || !std::isfinite(error) || !std::isfinite(x)) return plain(x);
  const auto rounded = fmt::format("{:.1e}", error);
  const int power = std::stoi(rounded.substr(rounded.find('e') + 1));
  return with_minus(fmt::format("{:.{}f}", x, std::clamp(1 - power, 0, 12)));
}
std::string words(std::string_view name) {
  std::string out(name);
  std::ranges::replace(out, '_', ' ');
  return out;
}
std::string degrees_text(double x, int decimals) {
  if (!std::isfinite(x)) return "–";
  const double to = std::pow(10, decimals);
  return plain(std::round(to * x) / to, 9) + "°";
}

}  // namespace gonio::page
