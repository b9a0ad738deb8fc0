// Curves and points as SVG.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "reports/picture/figure.h"
#include "reports/picture/figure_scale.h"
#include "reports/picture/figure_style.h"
#include "reports/picture/svg.h"

#include <fmt/format.h>

namespace gonio {
namespace {

using svg::number;

constexpr std::size_t most_labels = 60;  ///< more of them would hide the points

/// Looks of the curves of a figure, in the colours of paper.
std::vector<CurveLook> looks(const Figure& f, const CurveStyles& styles) {
  std::vector<CurveLook> out;
  for (const auto& c : f.curves) {
    out.push_back(look_of(c, styles));
    out.back().colour = paper_colour(out.back().colour);
  }
  return out;
}

class CurveDrawing {
 public:
  CurveDrawing(const Figure& f, const CurveStyles& styles)
      : f_(f), styles_(looks(f, styles)), x_(x_scale(f)), y_(y_scale(f)) {}

  std::string document() {
    const auto head = svg::heading(f_.title, f_.note, width_);
    top_ = head.height;
    const std::string keys = legend();
    bottom_ = top_ + 320;
    const auto y_ticks = scale_ticks(y_, y_ticks_most);
    double widest = 0;
    for (const double t : y_ticks) widest = std::max(widest, svg::text_width(tick_text(t)));
    left_ = 16 + 18 + widest + 8;
    std::string marks = head.marks + keys + axes(y_ticks);
    marks += fmt::format(
        "<clipPath id=\"plot\"><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/></clipPath>\n"
        "<g clip-path=\"url(#plot)\">\n",
        number(left_), number(top_ - 4), number(right_ - left_ + 4), number(bottom_ - top_ + 8));
    for (std::size_t i = 0; i < f_.curves.size(); ++i) marks += curve(i);
    marks += "</g>\n" + labels();
    return svg::document(width_, bottom_ + 52, f_.title, marks);
  }

 private:
  struct Place {
    double x, y;
    std::size_t index;
  };

  double x_at(double v) const { return left_ + (right_ - left_) * x_.part(v); }
  double y_at(double v) const { return bottom_ - (bottom_ - top_) * y_.part(v); }
  /// A value's place, or one beyond the frame: a bar's end may have no logarithm.
  double y_or_bottom(double v) const { return y_.log && v <= 0 ? bottom_ + 10 : y_at(v); }
  double x_or_left(double v) const { return x_.log && v <= 0 ? left_ - 10 : x_at(v); }

  std::string legend() {
    std::string out;
    double x = 16;
    for (std::size_t i = 0; i < f_.curves.size(); ++i) {
      const double w = 30 + svg::text_width(label_of(f_.curves[i])) + 14;
      if (x > 16 && x + w > width_ - 8) {
        x = 16;
        top_ += 18;
      }
      const auto& s = styles_[i];
      const double y = top_ + 8;
      if (f_.curves[i].kind != FigureCurve::Kind::points)
        out += svg::line(x, y, x + 22, y, s.colour, s.width, s.dash);
      if (f_.curves[i].kind != FigureCurve::Kind::line) out += point(x + 11, y, s.colour);
      out += svg::text(x + 27, y + 4, label_of(f_.curves[i]), {.fill = svg::ink});
      x += w;
    }
    top_ += f_.curves.empty() ? 6 : 28;
    return out;
  }

  std::string axes(const std::vector<double>& y_ticks) const {
    std::string out;
    for (const double t : y_ticks) {
      out += svg::line(left_, y_at(t), right_, y_at(t), svg::faint);
      out += svg::text(left_ - 8, y_at(t) + 4, tick_text(t), {.anchor = svg::Anchor::end});
    }
    for (const double t : scale_ticks(x_, x_ticks_most)) {
      out += svg::line(x_at(t), top_, x_at(t), bottom_, svg::faint);
      out += svg::text(x_at(t), bottom_ + 18, tick_text(t), {.anchor = svg::Anchor::middle});
    }
    if (!y_.log && y_.low < 0 && y_.high > 0)
      out += svg::line(left_, y_at(0), right_, y_at(0), svg::muted);
    out += svg::line(left_, top_, left_, bottom_, svg::rule);
    out += svg::line(left_, bottom_, right_, bottom_, svg::rule);
    out +=
        svg::text((left_ + right_) / 2, bottom_ + 40, f_.x.label, {.anchor = svg::Anchor::middle});
    out += svg::text(22, (top_ + bottom_) / 2, f_.y.label,
                     {.anchor = svg::Anchor::middle, .turned = -90});
    return out;
  }

  std::string point(double x, double y, std::string_view colour) const {
    return fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"3.2\" fill=\"{}\"/>\n", number(x),
                       number(y), colour);
  }

  bool drawable(const FigureCurve& c, std::size_t i) const {
    return std::isfinite(c.x[i]) && std::isfinite(c.y[i]) && (!x_.log || c.x[i] > 0) &&
           (!y_.log || c.y[i] > 0);
  }

  std::string curve(std::size_t k) const {
    const auto& c = f_.curves[k];
    const auto& s = styles_[k];
    std::vector<std::size_t> order(c.x.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return c.x[i]; });
    std::string path, points, bars;
    bool pen_down = false;
    for (const std::size_t i : order) {
      if (!drawable(c, i)) {
        pen_down = false;  // a gap, as on the page: what is not known is not drawn
        continue;
      }
      const double x = x_at(c.x[i]), y = y_at(c.y[i]);
      path += (pen_down ? "L" : "M") + number(x) + " " + number(y);
      pen_down = true;
      points += point(x, y, s.colour);
      if (i < c.y_error.size() && c.y_error[i] > 0)
        bars += svg::line(x, y_or_bottom(c.y[i] - c.y_error[i]), x,
                          y_or_bottom(c.y[i] + c.y_error[i]), s.colour);
      if (i < c.x_error.size() && c.x_error[i] > 0)
        bars += svg::line(x_or_left(c.x[i] - c.x_error[i]), y, x_at(c.x[i] + c.x_error[i]), y,
                          s.colour);
    }
    std::string out = bars;
    if (c.kind != FigureCurve::Kind::points && !path.empty()) {
      out +=
          fmt::format("<path d=\"{}\" stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"",
                      path, s.colour, number(s.width));
      if (!s.dash.empty()) out += fmt::format(" stroke-dasharray=\"{}\"", s.dash);
      out += "/>\n";
    }
    return c.kind == FigureCurve::Kind::line ? out : out + points;
  }

  /// Beside its point, above or below a bar of its error, where it hides no other and lies on no dashed line.
  std::string labels() const {
    std::size_t count = 0;
    for (const auto& c : f_.curves) count += c.labels.size();
    if (count > most_labels) return "";
    struct Box {
      double left, top, right, bottom;
    };
    std::vector<Box> taken;
    const auto free = [&](const Box& b) {
      return b.left > left_ && b.right < right_ && b.top > top_ - 6 && b.bottom < bottom_ &&
             std::ranges::none_of(taken, [&](const Box& t) {
               return b.left < t.right && t.left < b.right && b.top < t.bottom && t.top < b.bottom;
             });
    };
    const auto cover = [&](double x0, double y0, double x1, double y1) {
      const int steps = std::max(1, static_cast<int>(std::hypot(x1 - x0, y1 - y0) / 4));
      for (int i = 0; i <= steps; ++i) {
        const double x = std::lerp(x0, x1, static_cast<double>(i) / steps),
                     y = std::lerp(y0, y1, static_cast<double>(i) / steps);
        taken.push_back({x - 2, y - 2, x + 2, y + 2});
      }
    };
    for (const auto& c : f_.curves)
      for (std::size_t i = 1; c.dashed && c.kind != FigureCurve::Kind::points && i < c.x.size();
           ++i)
        if (drawable(c, i - 1) && drawable(c, i))
          cover(x_at(c.x[i - 1]), y_at(c.y[i - 1]), x_at(c.x[i]), y_at(c.y[i]));
    std::vector<std::pair<const FigureCurve*, std::size_t>> of;
    for (const auto& c : f_.curves)
      for (std::size_t i = 0; i < c.labels.size(); ++i)
        if (drawable(c, i)) {
          of.emplace_back(&c, i);
          const double x = x_at(c.x[i]), y = y_at(c.y[i]);
          taken.push_back({x - 3, y - 3, x + 3, y + 3});
        }
    std::string out;
    for (const auto& [c, i] : of) {
      const double x = x_at(c->x[i]), y = y_at(c->y[i]), w = svg::text_width(c->labels[i], 11);
      for (const auto& [right, down] : {std::pair(5.0, -16.0),
                                        {-5 - w, -16},
                                        {5, 3},
                                        {-5 - w, 3},
                                        {7, -6},
                                        {-7 - w, -6},
                                        {-w / 2, -18},
                                        {-w / 2, 5}}) {
        const Box b{x + right, y + down, x + right + w, y + down + 13};
        if (free(b)) {
          taken.push_back(b);
          out += svg::text(b.left, b.bottom - 3, c->labels[i], {.fill = svg::ink, .size = 11});
          break;
        }
      }
    }
    return out;
  }

  const Figure& f_;
  std::vector<CurveLook> styles_;
  FigureScale x_, y_;
  double width_ = 760, left_ = 0, right_ = width_ - 22, top_ = 0, bottom_ = 0;
};

}  // namespace

std::string to_svg(const Figure& f, const CurveStyles& styles) {
  return CurveDrawing(f, styles).document();
}

}  // namespace gonio
