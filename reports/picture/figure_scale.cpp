#include "reports/picture/figure_scale.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace gonio {
namespace {

std::vector<double> linear_ticks(double low, double high, std::size_t most) {
  const double rough = (high - low) / static_cast<double>(most);
  const double decade = std::pow(10, std::floor(std::log10(rough)));
  double step = 10 * decade;
  for (const double digit : {1.0, 2.0, 5.0})
    if (digit * decade >= rough * (1 - 1e-9)) {
      step = digit * decade;
      break;
    }
  std::vector<double> out;
  const double first = std::ceil(low / step - 1e-9);
  for (std::size_t i = 0; i <= 2 * most; ++i) {
    const double tick = (first + static_cast<double>(i)) * step;
    if (tick > high + 1e-9 * step) break;
    out.push_back(tick);
  }
  return out;
}

/// The ends of a scale that values lie on; of none, and of one alone, something about them.
FigureScale around(double low, double high, bool log) {
  if (low > high) return {log ? 0.1 : 0, 1, log};
  if (high - low <= 1e-12 * std::max(std::abs(low), std::abs(high)))
    return log ? FigureScale{low / 2, 2 * high, log}
               : FigureScale{low - (low == 0 ? 0 : std::abs(low) / 2),
                             high + (high == 0 ? 1 : std::abs(high) / 2), log};
  return {low, high, log};
}

/// Least and largest of what can be drawn.
template <class Each>
std::pair<double, double> extremes(const Figure& f, Each each) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const auto& c : f.curves)
    for (std::size_t i = 0; i < c.x.size(); ++i) {
      if (!std::isfinite(c.x[i]) || !std::isfinite(c.y[i])) continue;
      if ((f.x.log && c.x[i] <= 0) || (f.y.log && c.y[i] <= 0)) continue;
      for (const double v : each(c, i)) {
        low = std::min(low, v);
        high = std::max(high, v);
      }
    }
  return {low, high};
}

/// A value and the ends of its error bar; an end that a logarithm has none of is left out.
std::array<double, 3> with_bar(double v,
                               const std::vector<double>& errors,
                               std::size_t i,
                               bool log) {
  const double e = i < errors.size() && std::isfinite(errors[i]) ? errors[i] : 0;
  return {v, log && v - e <= 0 ? v : v - e, v + e};
}

}  // namespace

double FigureScale::part(double value) const {
  if (root) return FigureScale{std::sqrt(low), std::sqrt(high), false}.part(std::sqrt(value));
  return log ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
}

std::vector<double> scale_ticks(const FigureScale& s, std::size_t most) {
  if (s.root) {
    std::vector<double> out;
    for (const double part : {0.0, 0.5, 2.0, 5.0, 10.0, 20.0, 30.0, 45.0, 60.0, 90.0})
      if (const double x = part * s.high / 90; x >= s.low) out.push_back(x);
    return out;
  }
  if (!s.log) return linear_ticks(s.low, s.high, most);
  const double span = std::log10(s.high / s.low);
  const std::vector<double> digits = span > 3     ? std::vector<double>{1}
                                     : span > 0.9 ? std::vector<double>{1, 2, 5}
                                                  : std::vector<double>{1, 1.5, 2, 3, 4, 5, 6, 8};
  const int step = std::max(1, static_cast<int>(std::ceil(span / static_cast<double>(most))));
  std::vector<double> out;
  for (int e = static_cast<int>(std::floor(std::log10(s.low)));
       e <= static_cast<int>(std::ceil(std::log10(s.high))); ++e)
    if (e % step == 0)
      for (const double d : digits)
        if (const double x = d * std::pow(10, e);
            x >= s.low * (1 - 1e-9) && x <= s.high * (1 + 1e-9))
          out.push_back(x);
  return out.size() > 1 ? out : linear_ticks(s.low, s.high, most);
}

std::string tick_text(double x) {
  if (x == 0) return "0";
  const auto with_minus = [](std::string s) {
    if (s[0] == '-') s.replace(0, 1, "−");
    return s;
  };
  const int power = static_cast<int>(std::floor(std::log10(std::abs(x)) + 1e-9));
  if (power >= -3 && power <= 3) return with_minus(fmt::format("{:.6g}", x));
  constexpr std::array superscripts{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string out = with_minus(fmt::format("{:.3g}", x / std::pow(10, power)));
  out = out == "1" ? "" : out == "−1" ? "−" : out + "·";
  out += "10";
  for (const char c : fmt::format("{}", power))
    out += c == '-' ? "⁻" : superscripts[static_cast<std::size_t>(c - '0')];
  return out;
}

FigureScale x_scale(const Figure& f) {
  const auto [low, high] = extremes(f, [&](const FigureCurve& c, std::size_t i) {
    return with_bar(c.x[i], c.x_error, i, f.x.log);
  });
  auto s = around(low, high, f.x.log);
  // Points must not lie on the frame; lines may begin there.
  const bool points = std::ranges::any_of(
      f.curves, [](const auto& c) { return c.kind != FigureCurve::Kind::line; });
  if (points) {
    const double room = 0.04;
    if (s.log) {
      const double factor = std::pow(s.high / s.low, room);
      s = {s.low / factor, s.high * factor, true};
    } else {
      const double span = s.high - s.low;
      s = {s.low - room * span, s.high + room * span, false};
    }
  }
  if (std::isfinite(f.x.from)) s.low = f.x.from;
  if (std::isfinite(f.x.to)) s.high = f.x.to;
  return s;
}

FigureScale y_scale(const Figure& f) {
  auto [low, high] = extremes(f, [&](const FigureCurve& c, std::size_t i) {
    return with_bar(c.y[i], c.y_error, i, f.y.log);
  });
  FigureScale s = around(low, high, f.y.log);
  if (low <= high) {
    if (s.log) {
      const double factor = std::pow(s.high / s.low, 0.06);
      s = {s.low / factor, s.high * factor, true};
    } else {
      if (low >= 0) s.low = 0;
      const double room = 0.06 * (s.high - s.low);
      s.high += room;
      if (low < 0) s.low -= room;
    }
  }
  if (std::isfinite(f.y.from)) s.low = f.y.from;
  if (std::isfinite(f.y.to)) s.high = f.y.to;
  return s;
}

std::vector<double> cell_edges(const FigureMap::Axis& a) {
  const std::size_t n = a.size();
  std::vector<double> edges(n + 1);
  if (!a.names.empty()) {
    for (std::size_t i = 0; i <= n; ++i) edges[i] = static_cast<double>(i);
    return edges;
  }
  const auto to = [&](double v) { return a.log ? std::log(v) : a.root ? std::sqrt(v) : v; };
  const auto from = [&](double v) { return a.log ? std::exp(v) : a.root ? v * v : v; };
  for (std::size_t i = 1; i < n; ++i) edges[i] = from((to(a.at[i - 1]) + to(a.at[i])) / 2);
  if (n == 1) {
    edges[0] = a.log ? a.at[0] / 2 : a.at[0] - 0.5;
    edges[1] = a.log ? a.at[0] * 2 : a.at[0] + 0.5;
  } else if (n > 1) {
    edges[0] = from(2 * to(a.at[0]) - to(edges[1]));
    edges[n] = from(2 * to(a.at[n - 1]) - to(edges[n - 1]));
  }
  if (std::isfinite(a.from)) edges[0] = a.from;
  if (std::isfinite(a.to)) edges[n] = a.to;
  return edges;
}

ColourScale colour_scale(const FigureMap& m) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const double v : m.values) {
    if (!std::isfinite(v) || v == 0 || (m.scale == FigureMap::Scale::log && v < 0)) continue;
    least = std::min(least, std::abs(v));
    most = std::max(most, std::abs(v));
  }
  const auto round_up = [](double v) {
    const double decade = std::pow(10, std::floor(std::log10(v)));
    for (const double digit : {1.0, 2.0, 5.0})
      if (digit * decade >= v * (1 - 1e-9)) return digit * decade;
    return 10 * decade;
  };
  const double end = std::isfinite(m.limit) ? m.limit : most > 0 ? round_up(most) : 1;
  if (m.scale == FigureMap::Scale::log && m.diverging) return {1 / end, end, {1 / end, 1, end}};
  if (m.scale == FigureMap::Scale::log && std::isfinite(m.begin))
    return {m.begin, end, scale_ticks({m.begin, end, true}, 6)};
  if (m.scale == FigureMap::Scale::log) {
    const double begin =
        std::min(most > 0 ? std::pow(10, std::floor(std::log10(least))) : end / 10, end / 10);
    return {begin, end, scale_ticks({begin, end, true}, 6)};
  }
  ColourScale s{m.diverging ? -end : 0, end, {}};
  const std::vector<double> parts = m.scale == FigureMap::Scale::root
                                        ? std::vector<double>{0, 0.05, 0.3, 1}
                                        : std::vector<double>{0, 0.5, 1};
  for (const double p : parts) {
    if (m.diverging && p > 0) s.ticks.insert(s.ticks.begin(), -p * end);
    s.ticks.push_back(p * end);
  }
  return s;
}

double colour_part(const FigureMap& m, const ColourScale& s, double v) {
  switch (m.scale) {
    case FigureMap::Scale::log:
      return v > 0 ? std::clamp(std::log(v / s.low) / std::log(s.high / s.low), 0.0, 1.0) : 0;
    case FigureMap::Scale::root:
    case FigureMap::Scale::linear:
      break;
  }
  double part = std::clamp(v / s.high, m.diverging ? -1.0 : 0.0, 1.0);
  if (m.scale == FigureMap::Scale::root) part = std::copysign(std::sqrt(std::abs(part)), part);
  return m.diverging ? (part + 1) / 2 : part;
}

}  // namespace gonio
