// Maps as SVG and as OpenEXR.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>

#include "base/base64.h"
#include "base/text.h"
#include "image/exr.h"
#include "image/png.h"
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

constexpr double map_page_width = 560, scale_length = 300;
constexpr int shades = 64;  ///< more of them nobody sees, and pages grow

char kind_of(const FigureMap& m) {
  return m.diverging ? 'd' : 'q';
}

/// Number at a place of the scale of colours; its ends say where there are values beyond.
std::string scale_text(const FigureMap& m, const ColourScale& colours, double at) {
  // A ratio near 1 needs the digits in which it differs from 1.
  const double beside = m.diverging && m.begin > 0 ? std::abs(at / m.begin - 1) : 1;
  const int digits =
      beside > 0 && beside < 0.1 ? 1 - static_cast<int>(std::floor(std::log10(beside))) : 3;
  const std::string text =
      tick_text(std::strtod(fmt::format("{:.{}g}", at, std::min(digits, 6)).c_str(), nullptr));
  constexpr double rounding = 1e-9;
  const auto any = [&](auto beyond) { return std::ranges::any_of(m.values, beyond); };
  if (at == colours.high && any([&](double v) { return v > at * (1 + rounding); }))
    return "≥\u202f" + text;
  if (at == colours.low && at != 0 &&
      any([&](double v) { return v < at - rounding * std::abs(at); }))
    return "≤\u202f" + text;
  return text;
}

class MapDrawing {
 public:
  MapDrawing(const FigureMap& m, svg::Box box)
      : m_(m),
        box_(box),
        colours_(colour_scale(m)),
        x_edges_(cell_edges(m.x)),
        y_edges_(cell_edges(m.y)),
        x_{x_edges_.front(), x_edges_.back(), m.x.log && m.x.names.empty(), m.x.root},
        y_{y_edges_.front(), y_edges_.back(), m.y.log && m.y.names.empty(), m.y.root},
        turned_(!m.x.names.empty() &&
                widest(m.x, x_) > box.width / static_cast<double>(m.x.size()) - 6) {
    for (const auto name : colours_of(m)) list_.push_back(channels(paper_colour(name)));
  }

  /// Room that the texts of y need, and those below the box up to the name of x.
  double left() const { return 34 + widest(m_.y, y_) + (m_.y.names.empty() ? 0 : 4); }
  double below() const { return turned_ ? 0.75 * widest(m_.x, x_) + 26 : 36; }

  /// Width of the box that names of x and numbers in cells need.
  double least() const {
    const double name = turned_ ? svg::text_size : widest(m_.x, x_);
    return static_cast<double>(m_.x.size()) * (std::max(name, svg::text_width("−0.00", 11)) + 4);
  }

  /// \param x_texts, y_texts  whether they stand at this one of several
  std::string marks(std::size_t slice,
                    std::size_t most,
                    bool x_texts,
                    bool y_texts,
                    bool with_cells = true) const {
    const auto ticks = [&](const FigureMap::Axis& axis, const FigureScale& scale, auto place) {
      svg::Ticks out;
      for (std::size_t i = 0; i < axis.names.size(); ++i)
        out.emplace_back(place(static_cast<double>(i) + 0.5), axis.names[i]);
      if (axis.names.empty())
        for (const double t : scale_ticks(scale, most)) out.emplace_back(place(t), tick_text(t));
      return out;
    };
    svg::Ticks x, y;
    if (x_texts) x = ticks(m_.x, x_, [&](double v) { return x_at(v); });
    if (y_texts) y = ticks(m_.y, y_, [&](double v) { return y_at(v); });
    return box_.inside((!m_.colours.empty() ? coloured_cells()
                        : with_cells        ? cells(slice)
                                            : R"(<g class="cells"/>)") +
                       line(slice) +
                       fmt::format(R"(<path class="ax" d="M0 0H{0}V{1}H0z"/>)", number(box_.width),
                                   number(box_.height))) +
           cell_texts(slice) + svg::axis_texts(box_, x, y, turned_);
  }
  std::string names(double left) const {
    return svg::axis_names(box_, m_.x.label, m_.y.label, left, below());
  }

  std::string on_page(std::size_t slice, bool with_cells) const {
    const auto axis = [](const FigureScale& s) {
      return fmt::format("{:.6g} {:.6g}{}", s.low, s.high, s.log ? " log" : s.root ? " root" : "");
    };
    const auto edges = [&](std::span<const double> of, auto place) {
      std::string out;
      for (const double e : of) out += (out.empty() ? "" : " ") + number(place(e));
      return out;
    };
    const auto named = [](const char* key, const FigureMap::Axis& of) {
      return of.names.empty()
                 ? std::string()
                 : fmt::format(R"( {}="{}")", key,
                               markup_text(fmt::format("{}", fmt::join(of.names, "|"))));
    };
    return fmt::format(
        R"(<svg class="plot" role="img" tabindex="0" aria-label="{}" data-x="{}" data-y="{}" data-xs="{}" data-ys="{}"{}{} data-scale="{} {:.6g} {:.6g}{}" data-cells="{}" style="--left:{}px;--below:{}px;--least:{}px;height:{}px">{}{}</svg>)",
        markup_text(m_.x.label.empty() ? m_.title + "."
                                       : fmt::format("{}: {} by {} and {}.", m_.title, m_.value,
                                                     m_.x.label, m_.y.label)),
        axis(x_), axis(y_), edges(x_edges_, [&](double v) { return x_at(v); }),
        edges(y_edges_, [&](double v) { return y_at(v); }), named("data-nx", m_.x),
        named("data-ny", m_.y), name_of(m_.scale), colours_.low, colours_.high,
        m_.diverging ? " diverging" : "", values(slice), number(left()), number(below()),
        number(least()), number(box_.height), marks(slice, map_ticks_most, true, true, with_cells),
        names(left()));
  }

  std::string legend(double left, double top) const {
    std::string out;
    constexpr double step = scale_length / shades;
    out += fmt::format(R"x(<g class="cells" transform="translate({} {})">)x", number(left),
                       number(top));
    for (int s = 0; s < shades; ++s)
      out += fmt::format("<path d=\"M{} 0h{}v10h-{}z\"{}/>", s * step, step, step, shade(s));
    out += "</g>";
    for (const double t : colours_.ticks) {
      const double part = colour_part(m_, colours_, t);
      const char* anchor = part < 0.02 ? "start" : part > 0.98 ? "end" : "middle";
      out += fmt::format(R"(<text x="{}" y="{}" text-anchor="{}">{}</text>)",
                         number(left + part * scale_length), number(top + 24), anchor,
                         scale_text(m_, colours_, t));
    }
    return out + fmt::format(R"(<text class="in" x="{}" y="{}">{}</text>)", number(left),
                             number(top + 44), markup_text(m_.value));
  }

 private:
  double x_at(double v) const { return box_.width * x_.part(v); }
  double y_at(double v) const { return box_.height * (1 - y_.part(v)); }
  double value(std::size_t slice, std::size_t i, std::size_t j) const {
    return m_.values[(slice * m_.x.size() + i) * m_.y.size() + j];
  }
  int shade_of(double v) const {
    return static_cast<int>(std::lround(shades * colour_part(m_, colours_, v)));
  }
  Colour colour(int of) const { return between(list_, static_cast<double>(of) / shades); }
  /// Attribute of a shade: a class of the page, or the colour.
  std::string shade(int of) const {
    return box_.page ? fmt::format(R"( class="{}{}")", kind_of(m_), of)
                     : fmt::format(R"( color="{}")", hex(colour(of)));
  }

  static double widest(const FigureMap::Axis& axis, const FigureScale& scale) {
    double w = 0;
    for (const auto& name : axis.names) w = std::max(w, svg::text_width(name));
    if (axis.names.empty())
      for (const double t : scale_ticks(scale, map_ticks_most))
        w = std::max(w, svg::text_width(tick_text(t)));
    return w;
  }

  /// Cells of a shade are one path; those above each other one rectangle of it, or one stroke where all columns are as wide.
  std::string cells(std::size_t slice) const {
    const double column = box_.width / static_cast<double>(m_.x.size());
    bool even = true;
    for (std::size_t i = 0; i < m_.x.size(); ++i)
      even = even && std::abs(x_at(x_edges_[i]) - column * static_cast<double>(i)) < 0.05;
    std::map<int, svg::Path> paths;
    std::map<int, std::string> rectangles;
    for (std::size_t i = 0; i < m_.x.size(); ++i)
      for (std::size_t j = 0, end = 0; j < m_.y.size(); j = end) {
        end = j + 1;
        if (!std::isfinite(value(slice, i, j))) continue;
        const int s = shade_of(value(slice, i, j));
        while (end < m_.y.size() && std::isfinite(value(slice, i, end)) &&
               shade_of(value(slice, i, end)) == s)
          ++end;
        const double b = y_at(y_edges_[j]), t = y_at(y_edges_[end]);
        if (even) {
          paths[s].move(static_cast<double>(i), b);
          paths[s].up(t);
          continue;
        }
        const double l = x_at(x_edges_[i]), r = x_at(x_edges_[i + 1]);
        rectangles[s] += "M" + number(l) + " " + number(t) + "H" + number(r) + "V" + number(b) +
                         "H" + number(l) + "z";
      }
    std::string out =
        even
            ? fmt::format(
                  R"x(<g class="cells columns" shape-rendering="crispEdges" transform="scale({:.6g} 1) translate(.5)">)x",
                  column)
            : R"(<g class="cells" shape-rendering="crispEdges">)";
    for (const auto& [s, path] : paths)
      out += fmt::format(R"(<path{} d="{}"/>)", shade(s), path.text());
    for (const auto& [s, path] : rectangles)
      out += fmt::format(R"(<path{} d="{}"/>)", shade(s), path);
    return out + "</g>";
  }

  /// Cells in their own colours, whose columns and rows are each as wide, as one image.
  std::string coloured_cells() const {
    PngImage image{m_.x.size(), m_.y.size(), {}, {}};
    for (std::size_t j = m_.y.size(); j-- > 0;)
      for (std::size_t i = 0; i < m_.x.size(); ++i)
        image.pixels.push_back(m_.colours[i * m_.y.size() + j]);
    return fmt::format(
        R"(<image width="{}" height="{}" preserveAspectRatio="none" style="image-rendering:pixelated" href="data:image/png;base64,{}"/>)",
        number(box_.width), number(box_.height), base64(png_bytes(image)));
  }

  /// What a pointer reads: places on the scale of colours, two bytes a cell, the least first; 65535 where there is no value.
  std::string values(std::size_t slice) const {
    std::string bytes;
    for (std::size_t i = 0; i < m_.x.size(); ++i)
      for (std::size_t j = 0; j < m_.y.size(); ++j) {
        const double v = value(slice, i, j);
        const auto part =
            std::isfinite(v)
                ? static_cast<unsigned>(std::lround(65534 * colour_part(m_, colours_, v)))
                : 65535U;
        bytes += static_cast<char>(part & 255U);
        bytes += static_cast<char>(part >> 8U);
      }
    return base64(bytes);
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
    return fmt::format("<path class=\"edge\" d=\"{}\"/>", path);
  }

  /// The numbers in the cells of a small matrix.
  std::string cell_texts(std::size_t slice) const {
    if (m_.x.names.empty() || m_.y.names.empty()) return "";
    std::string out = R"(<g class="numbers" font-size="11" text-anchor="middle">)";
    for (std::size_t i = 0; i < m_.x.size(); ++i)
      for (std::size_t j = 0; j < m_.y.size(); ++j) {
        const double v = value(slice, i, j);
        if (!std::isfinite(v)) continue;
        const std::string what = tick_text(std::strtod(fmt::format("{:.2g}", v).c_str(), nullptr));
        const double l = x_at(x_edges_[i]), r = x_at(x_edges_[i + 1]);
        if (svg::text_width(what, 11) > r - l - 2) continue;
        const Colour c = colour(shade_of(v));
        const bool dark = 0.299 * c[0] + 0.587 * c[1] + 0.114 * c[2] < 130;
        out += box_.text((l + r) / 2, (y_at(y_edges_[j]) + y_at(y_edges_[j + 1])) / 2 + 4, what,
                         dark ? R"( class="on")" : R"( class="in")");
      }
    return out + "</g>";
  }

  const FigureMap& m_;
  svg::Box box_;
  ColourScale colours_;
  std::vector<double> x_edges_, y_edges_;
  FigureScale x_, y_;
  bool turned_;  ///< names of x, which are longer than their cells are wide
  std::vector<Colour> list_;
};

/// Height of the box of a map that stands alone.
double height_of(const FigureMap& m) {
  return m.y.names.empty() ? 340 : std::clamp(26 * static_cast<double>(m.y.size()), 120.0, 1200.0);
}

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
  const auto head = svg::heading(m.title, m.note, svg::file_width);
  const double top = head.height + 4, right = 22;
  std::string marks = head.marks;
  svg::Box box{false, svg::file_width, height_of(m)};
  const double left = MapDrawing(m, box).left() + 8, all = svg::file_width - right - left;
  box.width = all;
  double bottom = top + box.height;
  if (m.slices.empty()) {
    const MapDrawing d(m, box);
    marks += svg::placed(left, top, box, d.marks(0, map_ticks_most, true, true));
  } else {  // beside each other, in rows; texts stand at the outer ones
    const std::size_t n = m.slices.size(), columns = std::min<std::size_t>(n, 4);
    constexpr double gap = 14, title = 18;
    box.width = (all + gap) / static_cast<double>(columns) - gap;
    box.height = 0.85 * box.width;
    for (std::size_t k = 0; k < n; ++k) {
      const double x = left + static_cast<double>(k % columns) * (box.width + gap),
                   y = top + title + static_cast<double>(k / columns) * (box.height + title + gap);
      marks += fmt::format(R"(<text class="in" x="{}" y="{}">{}</text>)", number(x), number(y - 5),
                           markup_text(m.slices[k]));
      marks += svg::placed(
          x, y, box,
          MapDrawing(m, box).marks(k, map_ticks_few, k + columns >= n, k % columns == 0));
      bottom = y + box.height;
    }
  }
  const svg::Box whole{false, all, bottom - top};
  const MapDrawing d(m, whole);
  marks += svg::placed(left, top, whole, d.names(left - 8));
  const double below = bottom + d.below() + 20;
  marks += d.legend(left, below);
  return svg::document(svg::file_width, below + 56, m.title, "", marks);
}

std::string page_svg(const FigureMap& m, std::size_t slice, bool cells) {
  return MapDrawing(m, {true, map_page_width, height_of(m)}).on_page(slice, cells);
}

std::string page_scale(const FigureMap& m) {
  if (!m.colours.empty()) return "";
  const auto colours = colour_scale(m);
  std::string out = fmt::format(R"(<div class="scale {}"><i></i><b>)", kind_of(m));
  for (const double t : colours.ticks)
    out += fmt::format(R"(<span style="left:{:.3g}%">{}</span>)", 100 * colour_part(m, colours, t),
                       scale_text(m, colours, t));
  return out + "</b><small>" + markup_text(m.value) + "</small></div>";
}

std::string page_shades(std::span<const FigureMap> maps) {
  std::map<char, std::span<const std::string_view>> kinds;
  for (const auto& m : maps) kinds.emplace(kind_of(m), colours_of(m));
  std::string out;
  for (const auto& [kind, colours] : kinds) {
    const auto last = static_cast<double>(colours.size() - 1);
    for (int s = 0; s <= shades; ++s) {
      const double at = last * s / shades;
      const auto i = std::min(colours.size() - 2, static_cast<std::size_t>(at));
      out += fmt::format(".{}{}{{color:color-mix(in srgb,var(--{}) {:.3g}%,var(--{}))}}", kind, s,
                         colours[i + 1], 100 * (at - static_cast<double>(i)), colours[i]);
    }
    out += fmt::format(".scale.{} i{{background:linear-gradient(90deg,var(--{}))}}", kind,
                       fmt::join(colours, "),var(--"));
  }
  return out;
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
