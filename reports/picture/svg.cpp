#include "reports/picture/svg.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "reports/picture/indices.h"

#include <fmt/format.h>

namespace gonio::svg {
namespace {

/// A number of tenths: "12.5", "-.3".
std::string tenths(long n) {
  std::string s = n < 0 ? "-" : "";
  n = std::abs(n);
  if (n >= 10 || n == 0) s += std::to_string(n / 10);
  if (n % 10 != 0) s += "." + std::to_string(n % 10);
  return s;
}

/// Marks of a text; what follows an index stands on the line again.
std::string low_indices(std::string_view text) {
  return with_indices(markup_text(text), R"(<tspan dy="3" font-size="75%">)",
                      "</tspan><tspan dy=\"-3\">\u200b</tspan>");
}

}  // namespace

double text_width(std::string_view text, double size) {
  const auto characters = std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; });
  return 0.56 * size * static_cast<double>(characters);
}

std::vector<std::string> wrapped(std::string_view text, double width, double size) {
  std::vector<std::string> lines;
  if (text.empty()) return lines;
  for (const auto& word : split(text, ' ')) {
    if (lines.empty() || text_width(lines.back() + " " + word, size) > width)
      lines.push_back(word);
    else
      lines.back() += " " + word;
  }
  return lines;
}

std::string number(double v) {
  return tenths(std::lround(10 * v));
}

void Path::move(double x, double y) {
  x_ = std::lround(10 * x), y_ = std::lround(10 * y);
  const auto down = tenths(y_);
  text_ += "M" + tenths(x_) + (down[0] == '-' ? "" : " ") + down;
  last_ = 'M';
}
void Path::line(double x, double y) {
  const long to_x = std::lround(10 * x), to_y = std::lround(10 * y);
  const auto right = tenths(to_x - x_), down = tenths(to_y - y_);
  if (last_ != 'l')
    text_ += 'l';
  else if (right[0] != '-')
    text_ += ' ';
  text_ += right + (down[0] == '-' ? "" : " ") + down;
  x_ = to_x, y_ = to_y, last_ = 'l';
}
void Path::up(double y) {
  const long to = std::lround(10 * y);
  text_ += 'v' + tenths(to - y_);
  y_ = to, last_ = 'v';
}
void Path::dot(double x, double y) {
  move(x, y);
  text_ += "h0";
}

std::string Box::x(double x, std::string_view attribute) const {
  if (!page) return fmt::format(R"( {}="{}")", attribute, number(x));
  return fmt::format(R"( {}="{:.4g}%")", attribute, 100 * x / width);
}
std::string Box::text(double x, double y, std::string_view what, std::string_view more) const {
  return fmt::format(R"(<text{} y="{}"{}>{}</text>)", this->x(x), number(y), more,
                     low_indices(what));
}
std::string Box::inside(std::string_view marks, std::string_view more) const {
  return fmt::format(
      R"(<svg width="{}" height="{}" viewBox="0 0 {} {}" preserveAspectRatio="none"{}>{}</svg>)",
      page ? "100%" : number(width), number(height), number(width), number(height), more, marks);
}

std::string axis_texts(const Box& box, const Ticks& x, const Ticks& y, bool turned) {
  std::string out =
      turned ? R"(<g class="xt" text-anchor="end">)" : R"(<g class="xt" text-anchor="middle">)";
  double end = -1;
  bool crowded = false;  // where the picture is half as wide
  for (const auto& [at, text] : x) {
    crowded |= at / 2 - text_width(text) / 2 < end;
    end = at / 2 + text_width(text) / 2 + 4;
    if (turned)
      out += fmt::format(
          R"(<svg{} y="{}" overflow="visible">{}</svg>)", box.x(at), number(box.height + 12),
          fmt::format(R"x(<text transform="rotate(-40)">{}</text>)x", markup_text(text)));
    else
      out += box.text(at, box.height + 17, text);
  }
  if (crowded && !turned) out.replace(0, 13, R"(<g class="xt crowded")");
  out += R"(</g><g class="yt" text-anchor="end">)";
  for (const auto& [at, text] : y)
    out += fmt::format(R"(<text x="-7" y="{}">{}</text>)", number(at + 4), markup_text(text));
  return out + "</g>";
}

std::string axis_names(
    const Box& box, std::string_view x, std::string_view y, double left, double below) {
  std::string out;
  double at = 12 - left;
  for (const auto& line : wrapped(y, std::max(120.0, box.height + 20))) {
    out += fmt::format(
        R"x(<text text-anchor="middle" transform="translate({} {}) rotate(-90)">{}</text>)x",
        number(at), number(box.height / 2), low_indices(line));
    at += 13;
  }
  if (!box.page) out += box.text(box.width / 2, box.height + below, x, R"( text-anchor="middle")");
  return out;
}

Heading heading(std::string_view title, std::string_view note, double width) {
  Heading h{{}, 16};
  const auto put = [&](std::string_view what, std::string_view look, double size, double step) {
    for (const auto& l : wrapped(what, width - 32, size)) {
      h.height += step;
      h.marks += fmt::format(R"(<text x="16" y="{}"{}>{}</text>)", number(h.height - 4), look,
                             low_indices(l));
    }
  };
  put(title, R"( class="in" font-size="15" font-weight="600")", 15, 19);
  put(note, "", text_size, 16);
  h.height += 6;
  return h;
}

std::string placed(double left, double top, const Box& box, std::string_view marks) {
  return fmt::format(R"(<svg x="{}" y="{}" width="{}" height="{}" overflow="visible">{}</svg>)",
                     number(left), number(top), number(box.width), number(box.height), marks);
}

std::string document(double width,
                     double height,
                     std::string_view title,
                     std::string_view looks,
                     std::string_view marks) {
  return fmt::format(
      R"(<?xml version="1.0" encoding="UTF-8"?>
<svg xmlns="http://www.w3.org/2000/svg" width="{0}" height="{1}" viewBox="0 0 {0} {1}" font-family="system-ui, 'Segoe UI', Roboto, 'DejaVu Sans', sans-serif" font-size="{2}" fill="#5d646b" role="img">
<title>{3}</title>
<style>path{{fill:none;stroke-linejoin:round}}.in{{fill:#1c1f23}}.on{{fill:{4}}}.g{{stroke:#efeee9}}.ax{{stroke:#dddcd5}}.zero,.tick{{stroke:#5d646b}}.edge{{stroke:#1c1f23;stroke-width:2}}.cells path{{stroke:none;fill:currentColor}}.cells.columns path{{stroke:currentColor;fill:none}}{5}</style>
<rect width="{0}" height="{1}" fill="{4}"/>
{6}</svg>
)",
      number(width), number(height), number(text_size), markup_text(title), ground, looks, marks);
}

}  // namespace gonio::svg
