#include "reports/page/spheres.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/base64.h"
#include "base/text.h"
#include "image/colour_difference.h"
#include "image/png.h"
#include "reports/page/numbers.h"

#include <fmt/format.h>

namespace gonio::page {
namespace {

using Rgb = std::array<unsigned char, 3>;
constexpr Rgb no_difference{0xe9, 0xe7, 0xe0}, at_limit{0xa9, 0x8f, 0xc4}, beyond{0xf0, 0xa8, 0x68},
    most{0xb3, 0x47, 0x0b};
constexpr unsigned not_known = 254, beside = 255;

Rgb colour_of(double x, const DifferenceScale& s) {
  const bool low = x <= s.limit;
  const auto &a = low ? no_difference : beyond, &b = low ? at_limit : most;
  const double part = std::clamp(low ? x / s.limit : (x - s.limit) / (s.max - s.limit), 0.0, 1.0);
  Rgb c{};
  for (std::size_t k = 0; k < 3; ++k)
    c[k] = static_cast<unsigned char>(std::lround(std::lerp(double(a[k]), double(b[k]), part)));
  return c;
}
std::string key(const Rgb& c, std::string_view text) {
  return fmt::format(
      R"(<span><span class="step" style="background:#{:02x}{:02x}{:02x}"></span>{}</span>)", c[0],
      c[1], c[2], text);
}

}  // namespace

std::string difference_png(std::string_view bytes, std::size_t pixels, const DifferenceScale& s) {
  PngImage image{pixels, pixels, {}, {}};
  for (const char c : from_base64(bytes)) {
    const auto byte = static_cast<unsigned char>(c);
    const std::size_t i = image.pixels.size();
    const unsigned char grey = (i % pixels + i / pixels) % 8 < 4 ? 136 : 184;
    image.pixels.push_back(byte == beside                   ? Rgb{0, 0, 0}
                           : s.hatched && byte == not_known ? Rgb{grey, grey, grey}
                                                            : colour_of(byte / s.steps, s));
  }
  return base64(png_bytes(image));
}

std::string sphere_figure(std::string_view caption,
                          std::size_t pixels,
                          const std::vector<SpherePicture>& pictures,
                          bool whole) {
  std::string images, below;
  for (const auto& p : pictures) {
    images += fmt::format(
        R"(<img class="sphere{3}" width="{0}" height="{0}" src="data:image/png;base64,{1}" alt="{2}">)",
        pixels, p.png, markup_text(p.of), whole ? " whole" : "");
    if (!p.word.empty()) below += fmt::format("<small>{}</small>", p.word);
  }
  return fmt::format(
      R"(<figure><figcaption>{}</figcaption><div class="sphere-row">{}{}</div></figure>)",
      markup_text(caption), images, below);
}

std::string sphere_keys(const DifferenceScale& s) {
  return fmt::format(
      R"(<p class="small keys">{}{}{}{}{}<span>nobody sees ΔE2000 up to {}; up to {} it shows only side by side</span></p>)",
      key(no_difference, "no difference"), key(at_limit, fmt::format("ΔE2000 {}", plain(s.limit))),
      key(beyond, fmt::format("above {}", plain(s.limit))), key(most, plain(s.max) + " or more"),
      s.hatched ? R"(<span><span class="step hatched"></span>the table has no value</span>)" : "",
      plain(just_seen), plain(side_by_side));
}

}  // namespace gonio::page
