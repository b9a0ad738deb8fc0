#include "reports/page/page.h"

#include "base/text.h"
#include "reports/page/assets.h"

#include <fmt/format.h>

namespace gonio {

std::string drawn_page(std::string_view title, std::string_view body, std::string_view looks) {
  return scripted_page(title, body, looks, assets::pictures_js, false);
}

std::string scripted_page(std::string_view title,
                          std::string_view body,
                          std::string_view looks,
                          std::string_view script,
                          bool runs_module) {
  return fmt::format(
      R"(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src 'unsafe-inline'{}; style-src 'unsafe-inline'; img-src data:; base-uri 'none'; form-action 'none'">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta name="generator" content="gonio">
<link rel="icon" href="data:,">
<title>{}</title>
<style>{}{}</style>
</head>
<body>
<main id="page">
{}</main>
<script>{}</script>
</body>
</html>
)",
      runs_module ? " 'wasm-unsafe-eval'; worker-src blob:" : "", markup_text(title),
      assets::page_css, looks, body, script);
}

std::string beside_index(std::string html) {
  constexpr std::string_view root = R"(<html lang="en")";
  if (const auto at = html.find(root); at != html.npos)
    html.insert(at + root.size(), " data-index");
  return html;
}

}  // namespace gonio
