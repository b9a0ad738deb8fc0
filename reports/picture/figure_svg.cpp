// Curves and points as SVG.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/text.h"
#include "reports/picture/figure.h"
#include "reports/picture/figure_scale.h"
#include "reports/picture/figure_style.h"
#include "reports/picture/label_placer.h"
#include "reports/picture/svg.h"

#include <fmt/format.h>

namespace gonio {
namespace {

using svg::number;
using svg::Spot;

constexpr std::size_t most_labels = 60;  ///< more of them would hide the points
constexpr double file_height = 320, curve_page_width = 600;
/// Widths that labels are placed for, with the class that shows them where there is as much room.
constexpr std::pair<double, std::string_view> label_widths[] = {
    {310, "labels narrow"}, {curve_page_width, "labels"}, {1000, "labels wide"}};

/// Which points of a line are kept so that it moves by no more than can be seen.
std::vector<bool> kept(const std::vector<Spot>& line) {
  constexpr double unseen = 0.06;  // [px]
  std::vector<bool> keep(line.size(), false);
  keep.front() = keep.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> parts{{0, line.size() - 1}};
  while (!parts.empty()) {
    const auto [from, to] = parts.back();
    parts.pop_back();
    double most = unseen;
    std::size_t at = from;
    for (std::size_t i = from + 1; i < to; ++i) {
      const double part = (line[i].x - line[from].x) / (line[to].x - line[from].x);
      const double off = std::abs(line[i].y - std::lerp(line[from].y, line[to].y, part));
      if (!(off <= most)) most = off, at = i;
    }
    if (at == from) continue;
    keep[at] = true;
    parts.emplace_back(from, at);
    parts.emplace_back(at, to);
  }
  return keep;
}

class CurveDrawing {
 public:
  /// \param first  curves that the axes are made for
  CurveDrawing(const Figure& f, const CurveStyles& styles, svg::Box box, std::vector<bool> first)
      : f_(f), styles_(styles), box_(box), first_(std::move(first)) {
    Figure seen = f;
    std::size_t i = 0;
    std::erase_if(seen.curves, [&](const auto&) { return !first_[i++]; });
    x_ = x_scale(seen);
    y_ = y_scale(seen);
    for (const double t : scale_ticks(x_, x_ticks_most))
      x_ticks_.emplace_back(x_at(t), tick_text(t));
    for (const double t : scale_ticks(y_, y_ticks_most))
      y_ticks_.emplace_back(y_at(t), tick_text(t));
    for (const auto& [at, text] : y_ticks_) left_ = std::max(left_, 34 + svg::text_width(text));
  }

  /// All but what stands above it.
  std::string marks() const {
    svg::Path grid;
    for (const auto& [at, text] : x_ticks_) grid.move(at, 0), grid.line(at, box_.height);
    for (const auto& [at, text] : y_ticks_) grid.move(0, at), grid.line(box_.width, at);
    std::string inside = fmt::format(R"(<path class="g" d="{}"/>)", grid.text());
    if (!y_.log && y_.low < 0 && y_.high > 0)
      inside +=
          fmt::format(R"(<path class="zero" d="M0 {}h{}"/>)", number(y_at(0)), number(box_.width));
    inside += fmt::format(R"(<path class="ax" d="M0 0V{}H{}"/>)", number(box_.height),
                          number(box_.width));
    for (std::size_t i = 0; i < f_.curves.size(); ++i) inside += curve(i);
    return box_.inside(inside) + svg::axis_texts(box_, x_ticks_, y_ticks_) + all_labels() +
           svg::axis_names(box_, f_.x.label, f_.y.label, left_, 38);
  }
  std::string curves() const {
    std::string out;
    for (std::size_t i = 0; i < f_.curves.size(); ++i)
      if (first_[i]) out += curve(i);
    return out;
  }
  double left() const { return left_; }

  std::string on_page() const {
    const auto scale = [](const FigureScale& s) {
      return fmt::format("{:.6g} {:.6g}{}", s.low, s.high, s.log ? " log" : "");
    };
    return fmt::format(
        R"(<svg class="plot" role="img" tabindex="0" aria-label="{}" data-x="{}" data-y="{}" style="--left:{}px;height:{}px">{}</svg>)",
        markup_text(fmt::format("{}: {} by {}.", f_.title, f_.y.label, f_.x.label)), scale(x_),
        scale(y_), number(left_), number(box_.height), marks());
  }

 private:
  double x_at(double v) const { return box_.width * x_.part(v); }
  /// Far beyond the frame nothing is seen.
  double y_at(double v) const {
    return std::clamp(box_.height * (1 - y_.part(v)), -20 * box_.height, 20 * box_.height);
  }
  /// A value's place, or one beyond the frame: a bar's end may have no logarithm.
  double y_or_bottom(double v) const { return y_.log && v <= 0 ? box_.height + 10 : y_at(v); }
  double x_or_left(double v) const { return x_.log && v <= 0 ? -10 : x_at(v); }

  bool drawable(const FigureCurve& c, std::size_t i) const {
    return std::isfinite(c.x[i]) && std::isfinite(c.y[i]) && (!x_.log || c.x[i] > 0) &&
           (!y_.log || c.y[i] > 0);
  }

  std::string curve(std::size_t k) const {
    const auto& c = f_.curves[k];
    std::vector<std::size_t> order(c.x.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return c.x[i]; });
    svg::Path line, points, bars;
    std::string coloured;
    std::vector<Spot> run;  // up to a gap, as on the page: what is not known is not drawn
    const auto put_down = [&] {
      if (run.empty()) return;
      const auto keep = kept(run);
      line.move(run[0].x, run[0].y);
      for (std::size_t i = 1; i < run.size(); ++i)
        if (keep[i]) line.line(run[i].x, run[i].y);
      run.clear();
    };
    std::string said;
    for (const std::size_t i : order) {
      if (!drawable(c, i)) {
        put_down();
        continue;
      }
      const double x = x_at(c.x[i]), y = y_at(c.y[i]);
      run.push_back({x, y});
      points.dot(x, y);
      if (box_.page && i < c.colours.size()) {
        svg::Path one;
        one.dot(x, y);
        coloured += fmt::format(R"(<path class="dot" style="stroke:{}" d="{}"/>)", c.colours[i],
                                one.text());
      }
      if (i < c.labels.size()) said += (said.empty() ? "" : "|") + c.labels[i];
      const auto bar = [&](double x0, double y0, double x1, double y1) {
        bars.move(x0, y0);
        bars.line(x1, y1);
      };
      if (i < c.y_error.size() && c.y_error[i] > 0)
        bar(x, y_or_bottom(c.y[i] - c.y_error[i]), x, y_or_bottom(c.y[i] + c.y_error[i]));
      if (i < c.x_error.size() && c.x_error[i] > 0)
        bar(x_or_left(c.x[i] - c.x_error[i]), y, x_at(c.x[i] + c.x_error[i]), y);
    }
    put_down();
    std::string out =
        fmt::format(R"(<g class="{}{}")", look_class(c, styles_), first_[k] ? "" : " more");
    if (box_.page && !said.empty()) out += fmt::format(R"( data-labels="{}")", markup_text(said));
    const auto put = [&](std::string_view look, const svg::Path& path) {
      if (!path.text().empty()) out += fmt::format(R"(<path{} d="{}"/>)", look, path.text());
    };
    out += '>';
    put(R"( class="bar")", bars);
    if (c.kind != FigureCurve::Kind::points) put("", line);
    if (!coloured.empty()) {
      put(R"( class="rim")", points);
      out += coloured;
    } else if (c.kind != FigureCurve::Kind::line)
      put(c.x.size() > most_labels ? R"( class="dot small")" : R"( class="dot")", points);
    return out + "</g>";
  }

  /// On a page they are placed for several widths, of which it shows one: its box grows, and texts do not.
  std::string all_labels() const {
    std::size_t count = 0;
    for (const auto& c : f_.curves) count += c.labels.size();
    if (count == 0 || count > most_labels) return "";
    if (!box_.page) return labels(box_.width, "labels");
    std::string out;
    for (const auto& [width, look] : label_widths) out += labels(width, look);
    return out;
  }
  bool is_on_dashed_line(double x, double y) const {
    return std::ranges::any_of(f_.curves, [&](const FigureCurve& c) {
      for (std::size_t i = 0; c.dashed && i < c.x.size(); ++i)
        if (c.x[i] == x && c.y[i] == y) return true;
      return false;
    });
  }
  /// Names of points; those on a dashed line come first.
  std::string labels(double width, std::string_view look) const {
    const auto at = [&](const FigureCurve& c, std::size_t i) {
      return Spot{width * x_.part(c.x[i]), y_at(c.y[i])};
    };
    svg::LabelPlacer placer(width, box_.height);
    std::vector<std::pair<const FigureCurve*, std::size_t>> of;
    for (const auto& c : f_.curves) {
      for (std::size_t i = 1; c.dashed && c.kind != FigureCurve::Kind::points && i < c.x.size();
           ++i)
        if (drawable(c, i - 1) && drawable(c, i)) placer.add_line(at(c, i - 1), at(c, i));
      for (std::size_t i = 0; i < c.labels.size(); ++i) {
        if (!drawable(c, i)) continue;
        of.emplace_back(&c, i);
        const auto p = at(c, i);
        placer.add_point(p);
        if (i < c.x_error.size() && c.x_error[i] > 0)
          placer.add_bar({x_or_left(c.x[i] - c.x_error[i]) * width / box_.width, p.y - 2,
                          width * x_.part(c.x[i] + c.x_error[i]), p.y + 2});
      }
    }
    const auto is_on_line = [&](const auto& label) {
      return is_on_dashed_line(label.first->x[label.second], label.first->y[label.second]);
    };
    // Where there is little room, only points of the line keep long names.
    if (width < curve_page_width && std::ranges::any_of(of, is_on_line))
      std::erase_if(of, [&](const auto& label) {
        return !is_on_line(label) && svg::text_width(label.first->labels[label.second], 11) > 20;
      });
    const auto is_shown = [&](const auto& label) {
      return bool(first_[static_cast<std::size_t>(label.first - f_.curves.data())]);
    };
    std::ranges::stable_sort(of, std::ranges::greater{}, [&](const auto& label) {
      return std::pair(is_shown(label), is_on_line(label));
    });
    std::string out = fmt::format(R"(<g class="in {}" font-size="11">)", look);
    for (const auto& label : of) {
      const auto& text = label.first->labels[label.second];
      const auto p = at(*label.first, label.second);
      const double w = svg::text_width(text, 11);
      const auto place = placer.place(p, w);
      if (!place) continue;
      const auto more = is_shown(label) ? "" : R"( class="more")";
      const double x = p.x * box_.width / width;
      if (place->end) {
        const auto [right, down] = *place->end;
        const double dot = 4 / std::hypot(right, down);
        out += fmt::format(
            R"(<svg{} y="{}" overflow="visible"{}><path class="zero" stroke-width=".8" d="M{} {}L{} {}"/></svg>)",
            box_.x(x), number(p.y), more, number(dot * right), number(dot * down), number(right),
            number(down));
      }
      // Widths are estimates: a name on the left ends where it should, one on the right begins
      // there.
      const bool is_left = place->text.x + w / 2 < 0;
      out += box_.text(x, p.y + place->text.y, text,
                       fmt::format(R"( dx="{}"{}{})", number(place->text.x + (is_left ? w : 0)),
                                   is_left ? R"( text-anchor="end")" : "", more));
    }
    return out + "</g>";
  }

  const Figure& f_;
  const CurveStyles& styles_;
  svg::Box box_;
  std::vector<bool> first_;
  FigureScale x_{}, y_{};
  svg::Ticks x_ticks_, y_ticks_;
  double left_ = 0;
};

/// Look of a curve beside its name.
std::string key_marks(const FigureCurve& c) {
  std::string out;
  if (c.kind != FigureCurve::Kind::points) out += R"(<path d="M1 5h22"/>)";
  if (c.kind != FigureCurve::Kind::line) out += R"(<path class="dot" d="M12 5h0"/>)";
  return out;
}

}  // namespace

std::string to_svg(const Figure& f, const CurveStyles& styles) {
  auto head = svg::heading(f.title, f.note, svg::file_width);
  std::string looks =
      ".bar{stroke-width:1;stroke-dasharray:none}.dot{stroke-width:6.4;stroke-linecap:round;"
      "stroke-dasharray:none}.small{stroke-width:4.5}";
  double x = 16;
  for (const auto& c : f.curves) {
    looks += paper_look(c, styles);
    const double w = 30 + svg::text_width(label_of(c)) + 14;
    if (x > 16 && x + w > svg::file_width - 8) {
      x = 16;
      head.height += 18;
    }
    head.marks += fmt::format(
        R"x(<g class="{}" transform="translate({} {})">{}</g><text class="in" x="{}" y="{}">{}</text>)x",
        look_class(c, styles), number(x - 1), number(head.height + 3), key_marks(c), number(x + 27),
        number(head.height + 12), markup_text(label_of(c)));
    x += w;
  }
  head.height += f.curves.empty() ? 6 : 28;
  const std::vector<bool> all(f.curves.size(), true);
  const double left =
      CurveDrawing(f, styles, {false, svg::file_width, file_height}, all).left() + 8;
  const svg::Box box{false, svg::file_width - 22 - left, file_height};
  return svg::document(
      svg::file_width, head.height + file_height + 52, f.title, looks,
      head.marks + svg::placed(left, head.height, box, CurveDrawing(f, styles, box, all).marks()));
}

std::string page_svg(const Figure& f,
                     const CurveStyles& styles,
                     double height,
                     const std::vector<bool>& first) {
  return CurveDrawing(f, styles, {true, curve_page_width, height}, first).on_page();
}

std::string page_small(const Figure& f, double width, double height) {
  const CurveStyles styles({&f, 1});
  std::vector<bool> first(f.curves.size(), true);
  if (first.size() > 6) std::fill(first.begin() + 6, first.end(), false);
  return fmt::format(R"(<svg class="plot small" viewBox="0 0 {} {}" aria-hidden="true">{}</svg>)",
                     number(width), number(height),
                     CurveDrawing(f, styles, {true, width, height}, first).curves());
}

std::string page_key(const FigureCurve& c, const CurveStyles& styles) {
  return fmt::format(R"(<svg class="key {}">{}</svg>{})", look_class(c, styles), key_marks(c),
                     markup_text(label_of(c)));
}

}  // namespace gonio
