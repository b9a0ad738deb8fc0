// Maps as SVG and as OpenEXR.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>

#include "image/exr.h"
#include "reports/picture/figure.h"
#include "reports/picture/figure_scale.h"
#include "reports/picture/figure_style.h"
#include "reports/picture/svg.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {
namespace {

using svg::number;

using Colour = std::array<double, 3>;
constexpr int shades = 128;  ///< more of them nobody sees, and files grow

Colour channels(std::string_view hex) {
  Colour c{};
  for (std::size_t k = 0; k < 3; ++k)
    c[k] = std::stoi(std::string(hex.substr(1 + 2 * k, 2)), nullptr, 16);
  return c;
}
/// Colour between those of a list, at t in [0, 1].
Colour between(std::span<const Colour> list, double t) {
  const double x = std::clamp(t, 0.0, 1.0) * static_cast<double>(list.size() - 1);
  const auto i = std::min(list.size() - 2, static_cast<std::size_t>(x));
  Colour c{};
  for (std::size_t k = 0; k < 3; ++k)
    c[k] = list[i][k] + (x - static_cast<double>(i)) * (list[i + 1][k] - list[i][k]);
  return c;
}
std::string hex(const Colour& c) {
  return fmt::format("#{:02x}{:02x}{:02x}", std::lround(c[0]), std::lround(c[1]),
                     std::lround(c[2]));
}

class Drawing {
 public:
  explicit Drawing(const FigureMap& m)
      : m_(m), colours_(colour_scale(m)), x_edges_(cell_edges(m.x)), y_edges_(cell_edges(m.y)) {
    for (const auto name : colours_of(m)) list_.push_back(channels(paper_colour(name)));
    x_ = {x_edges_.front(), x_edges_.back(), m.x.log && m.x.names.empty()};
    y_ = {y_edges_.front(), y_edges_.back(), m.y.log && m.y.names.empty()};
  }

  std::string document() {
    const auto head = svg::heading(m_.title, m_.note, width_);
    const double edge = 16 + 18 + widest(m_.y, y_) + 8;
    top_ = head.height + 4;
    std::string marks = head.marks;
    const double middle = (edge + width_ - 22) / 2, begin = top_;
    if (m_.slices.empty()) {
      left_ = edge;
      right_ = width_ - 22;
      bottom_ = top_ + (m_.y.names.empty()
                            ? 360
                            : std::clamp(26 * static_cast<double>(m_.y.size()), 120.0, 1200.0));
      turned_ = !m_.x.names.empty() &&
                widest(m_.x, x_) > (right_ - left_) / static_cast<double>(m_.x.size()) - 6;
      marks += panel(0, map_ticks_most, true, true);
    } else {
      marks += panels(edge);
    }
    const double below = bottom_ + (turned_ ? 0.75 * widest(m_.x, x_) + 14 : 22);
    marks += svg::text(middle, below + 16, m_.x.label, {.anchor = svg::Anchor::middle});
    marks += svg::text(22, (begin + bottom_) / 2, m_.y.label,
                       {.anchor = svg::Anchor::middle, .turned = -90});
    left_ = edge;
    marks += legend(below + 34);
    return svg::document(width_, below + 34 + 56, m_.title, marks);
  }

 private:
  double x_at(double v) const { return left_ + (right_ - left_) * x_.part(v); }
  double y_at(double v) const { return bottom_ - (bottom_ - top_) * y_.part(v); }
  double value(std::size_t slice, std::size_t i, std::size_t j) const {
    return m_.values[(slice * m_.x.size() + i) * m_.y.size() + j];
  }
  Colour shade(int of) const { return between(list_, static_cast<double>(of) / shades); }
  int shade_of(double v) const {
    return static_cast<int>(std::lround(shades * colour_part(m_, colours_, v)));
  }

  /// Slices beside each other, in rows; the axes stand at the outer ones.
  std::string panels(double edge) {
    const std::size_t n = m_.slices.size(), columns = std::min<std::size_t>(n, 4);
    constexpr double gap = 14, title = 18;
    const double w = (width_ - 22 - edge + gap) / static_cast<double>(columns) - gap, h = 0.85 * w;
    const double begin = top_;
    std::string out;
    for (std::size_t k = 0; k < n; ++k) {
      left_ = edge + static_cast<double>(k % columns) * (w + gap);
      right_ = left_ + w;
      top_ = begin + title + static_cast<double>(k / columns) * (h + title + gap);
      bottom_ = top_ + h;
      out += svg::text(left_, top_ - 5, m_.slices[k], {.fill = svg::ink});
      out += panel(k, map_ticks_few, k + columns >= n, k % columns == 0);
    }
    return out;
  }

  /// A map in its frame.  \param ticks  at most about
  std::string panel(std::size_t slice, std::size_t ticks, bool x_ticks, bool y_ticks) const {
    std::string out = cells(slice) + line(slice) + cell_texts(slice);
    out += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" stroke=\"{}\"/>\n",
                       number(left_), number(top_), number(right_ - left_), number(bottom_ - top_),
                       svg::rule);
    return out + axes(ticks, x_ticks, y_ticks);
  }

  static double widest(const FigureMap::Axis& axis, const FigureScale& scale) {
    double w = 0;
    for (const auto& name : axis.names) w = std::max(w, svg::text_width(name));
    if (axis.names.empty())
      for (const double t : scale_ticks(scale, map_ticks_most))
        w = std::max(w, svg::text_width(tick_text(t)));
    return w;
  }

  /// Cells of a shade are one path; those above each other one rectangle of it.
  std::string cells(std::size_t slice) const {
    std::map<int, std::string> paths;
    for (std::size_t i = 0; i < m_.x.size(); ++i)
      for (std::size_t j = 0, end = 0; j < m_.y.size(); j = end) {
        end = j + 1;
        if (!std::isfinite(value(slice, i, j))) continue;
        const int s = shade_of(value(slice, i, j));
        while (end < m_.y.size() && std::isfinite(value(slice, i, end)) &&
               shade_of(value(slice, i, end)) == s)
          ++end;
        const double l = x_at(x_edges_[i]), r = x_at(x_edges_[i + 1]), b = y_at(y_edges_[j]),
                     t = y_at(y_edges_[end]);
        paths[s] += "M" + number(l) + " " + number(t) + "H" + number(r) + "V" + number(b) + "H" +
                    number(l) + "z";
      }
    std::string out = "<g shape-rendering=\"crispEdges\">\n";
    for (const auto& [s, path] : paths)
      out += fmt::format("<path d=\"{}\" fill=\"{}\"/>\n", path, hex(shade(s)));
    return out + "</g>\n";
  }

  /// Edges between cells above the map's line and others.
  std::string line(std::size_t slice) const {
    if (!std::isfinite(m_.line)) return "";
    const auto above = [&](std::size_t i, std::size_t j) { return value(slice, i, j) > m_.line; };
    std::string path;
    for (std::size_t i = 0; i < m_.x.size(); ++i)
      for (std::size_t j = 0; j < m_.y.size(); ++j) {
        const std::string right = number(x_at(x_edges_[i + 1])),
                          top = number(y_at(y_edges_[j + 1]));
        if (i + 1 < m_.x.size() && above(i, j) != above(i + 1, j))
          path += "M" + right + " " + number(y_at(y_edges_[j])) + "V" + top;
        if (j + 1 < m_.y.size() && above(i, j) != above(i, j + 1))
          path += "M" + number(x_at(x_edges_[i])) + " " + top + "H" + right;
      }
    return fmt::format("<path d=\"{}\" stroke=\"{}\" stroke-width=\"2\"/>\n", path, svg::ink);
  }

  /// The numbers in the cells of a small matrix.
  std::string cell_texts(std::size_t slice) const {
    if (m_.x.names.empty() || m_.y.names.empty()) return "";
    std::string out;
    for (std::size_t i = 0; i < m_.x.size(); ++i)
      for (std::size_t j = 0; j < m_.y.size(); ++j) {
        const double v = value(slice, i, j);
        if (!std::isfinite(v)) continue;
        const std::string what = tick_text(std::strtod(fmt::format("{:.2g}", v).c_str(), nullptr));
        const double l = x_at(x_edges_[i]), r = x_at(x_edges_[i + 1]);
        if (svg::text_width(what, 11) > r - l - 2) continue;
        const Colour c = shade(shade_of(v));
        const bool dark = 0.299 * c[0] + 0.587 * c[1] + 0.114 * c[2] < 130;
        out += svg::text(
            (l + r) / 2, (y_at(y_edges_[j]) + y_at(y_edges_[j + 1])) / 2 + 4, what,
            {.anchor = svg::Anchor::middle, .fill = dark ? svg::ground : svg::ink, .size = 11});
      }
    return out;
  }

  std::string axes(std::size_t most, bool x_ticks, bool y_ticks) const {
    std::string out;
    const auto x_mark = [&](double at, const std::string& name) {
      const double x = x_at(at);
      if (turned_) {
        out += svg::text(x + 4, bottom_ + 14, name, {.anchor = svg::Anchor::end, .turned = -40});
      } else {
        out += svg::line(x, bottom_, x, bottom_ + 4, svg::muted);
        out += svg::text(x, bottom_ + 17, name, {.anchor = svg::Anchor::middle});
      }
    };
    const auto y_mark = [&](double at, const std::string& name) {
      out += svg::line(left_ - 4, y_at(at), left_, y_at(at), svg::muted);
      out += svg::text(left_ - 8, y_at(at) + 4, name, {.anchor = svg::Anchor::end});
    };
    const auto each = [&](const FigureMap::Axis& axis, const FigureScale& scale, const auto& mark) {
      for (std::size_t i = 0; i < axis.names.size(); ++i)
        mark(static_cast<double>(i) + 0.5, axis.names[i]);
      if (axis.names.empty())
        for (const double t : scale_ticks(scale, most)) mark(t, tick_text(t));
    };
    if (x_ticks) each(m_.x, x_, x_mark);
    if (y_ticks) each(m_.y, y_, y_mark);
    return out;
  }

  std::string legend(double top) const {
    constexpr double length = 300, step = length / shades;
    std::string out = "<g shape-rendering=\"crispEdges\">\n";
    for (int s = 0; s < shades; ++s)
      out += fmt::format("<path d=\"M{} {}h{}v10h-{}z\" fill=\"{}\"/>\n", number(left_ + s * step),
                         number(top), number(step), number(step), hex(shade(s)));
    out += "</g>\n";
    for (const double t : colours_.ticks) {
      const double part = colour_part(m_, colours_, t);
      const auto anchor = part < 0.02   ? svg::Anchor::start
                          : part > 0.98 ? svg::Anchor::end
                                        : svg::Anchor::middle;
      out += svg::text(left_ + part * length, top + 24, tick_text(t), {.anchor = anchor});
    }
    return out + svg::text(left_, top + 44, m_.value, {.fill = svg::ink});
  }

  const FigureMap& m_;
  ColourScale colours_;
  std::vector<double> x_edges_, y_edges_;
  std::vector<Colour> list_;
  FigureScale x_{}, y_{};
  double width_ = 760, left_ = 0, right_ = width_ - 22, top_ = 0, bottom_ = 0;
  bool turned_ = false;  ///< names of x, which are longer than their cells are wide
};

/// A channel's name without what readers take for layers or choke on.
std::string channel_name(const std::string& value) {
  std::string out;
  for (const char c : value) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
    if (plain)
      out += c;
    else if (!out.empty() && out.back() != '_')
      out += '_';
  }
  while (!out.empty() && out.back() == '_') out.pop_back();
  return out.empty() ? "value" : out;
}

std::string places(const FigureMap::Axis& axis) {
  if (!axis.names.empty()) return fmt::format("{}", fmt::join(axis.names, "; "));
  return fmt::format("{:.6g}", fmt::join(axis.at, "; "));
}

}  // namespace

std::string to_svg(const FigureMap& m) {
  return Drawing(m).document();
}

std::string to_exr(const FigureMap& m) {
  const std::size_t width = m.x.size(), height = m.y.size();
  Image image;
  image.width = width;
  image.height = height;
  image.attributes = {{"title", m.title},
                      {"note", m.note},
                      {"value", m.value},
                      {"x", m.x.label},
                      {"x.at", places(m.x)},
                      {"y", m.y.label},
                      {"y.at", places(m.y)},
                      {"layout", "columns as x.at, rows as y.at from the lowest row upwards"}};
  for (std::size_t slice = 0; slice < std::max<std::size_t>(1, m.slices.size()); ++slice) {
    image.channels.push_back(channel_name(m.slices.empty() ? m.value : m.slices[slice]));
    auto& plane = image.planes.emplace_back(width * height);
    for (std::size_t i = 0; i < width; ++i)
      for (std::size_t j = 0; j < height; ++j)
        plane[(height - 1 - j) * width + i] =
            static_cast<float>(m.values[(slice * width + i) * height + j]);
  }
  return exr_bytes(m.id + ".exr", image);
}

}  // namespace gonio
