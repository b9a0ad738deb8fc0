#include "reports/picture/svg.h"

#include <algorithm>

#include "base/text.h"

#include <fmt/format.h>

namespace gonio::svg {

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
  std::string s = fmt::format("{:.2f}", v);
  s.erase(s.find_last_not_of('0') + 1);
  if (s.back() == '.') s.pop_back();
  return s == "-0" ? "0" : s;
}

std::string text(double x, double y, std::string_view what, const TextStyle& o) {
  constexpr std::string_view anchors[]{"start", "middle", "end"};
  std::string out = fmt::format(R"(<text x="{}" y="{}" fill="{}")", number(x), number(y), o.fill);
  if (o.anchor != Anchor::start)
    out += fmt::format(R"( text-anchor="{}")", anchors[static_cast<std::size_t>(o.anchor)]);
  if (o.size != text_size) out += fmt::format(R"( font-size="{}")", number(o.size));
  if (o.bold) out += R"( font-weight="600")";
  if (o.turned != 0)
    out += fmt::format(" transform=\"rotate({} {} {})\"", number(o.turned), number(x), number(y));
  return out + ">" + markup_text(what) + "</text>\n";
}

std::string line(double x1,
                 double y1,
                 double x2,
                 double y2,
                 std::string_view stroke,
                 double width,
                 std::string_view dash) {
  std::string out = fmt::format(R"(<path d="M{} {}L{} {}" stroke="{}")", number(x1), number(y1),
                                number(x2), number(y2), stroke);
  if (width != 1) out += fmt::format(R"( stroke-width="{}")", number(width));
  if (!dash.empty()) out += fmt::format(R"( stroke-dasharray="{}")", dash);
  return out + "/>\n";
}

Heading heading(std::string_view title, std::string_view note, double width) {
  Heading h{{}, 16};
  const auto put = [&](std::string_view what, const TextStyle& o, double step) {
    for (const auto& l : wrapped(what, width - 32, o.size)) {
      h.height += step;
      h.marks += text(16, h.height - 4, l, o);
    }
  };
  put(title, {.fill = ink, .size = 15, .bold = true}, 19);
  put(note, {}, 16);
  h.height += 6;
  return h;
}

std::string document(double width, double height, std::string_view title, std::string_view marks) {
  return fmt::format(
      R"(<?xml version="1.0" encoding="UTF-8"?>
<svg xmlns="http://www.w3.org/2000/svg" width="{0}" height="{1}" viewBox="0 0 {0} {1}" font-family="system-ui, 'Segoe UI', Roboto, 'DejaVu Sans', sans-serif" font-size="{2}" fill="none" role="img">
<title>{3}</title>
<rect width="{0}" height="{1}" fill="{4}"/>
{5}</svg>
)",
      number(width), number(height), number(text_size), markup_text(title), ground, marks);
}

}  // namespace gonio::svg
