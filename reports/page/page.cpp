#include "reports/page/page.h"

#include "base/text.h"
#include "reports/finding/names.h"
#include "reports/page/assets.h"
#include "reports/picture/json_numbers.h"

#include <fmt/format.h>

namespace gonio {
namespace {

/// JSON for a script: a '<' stands in strings only; escaped there, no "</script" or "<!--" is left for the
/// HTML parser to see.
std::string script_json(std::string_view json) {
  std::string out;
  out.reserve(json.size());
  for (const char c : json) {
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  }
  return out;
}

/// Names of forms by their ids, as the scripts of reports know them.
std::string names_script() {
  auto names = PageJson::object();
  for (auto& [form, name] : form_names()) names[std::move(form)] = std::move(name);
  return fmt::format("const form_names = {};\n", script_json(page_text(names)));
}

}  // namespace

std::string make_page(std::string_view title, std::string_view json_data, std::string_view script) {
  return fmt::format(
      R"(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:; base-uri 'none'; form-action 'none'">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta name="generator" content="gonio">
<link rel="icon" href="data:,">
<title>{title}</title>
<style>{uplot_css}
{page_css}</style>
</head>
<body>
<main id="page"><noscript>This page draws its figures with a script; the numbers are in the JSON document that was written beside it.</noscript></main>
<script type="application/json" id="page-data">{json}</script>
<script>
/* uPlot
{license}
*/
{uplot_js}</script>
<script>{page_js}</script>
<script>{plots_js}</script>
<script>{script}</script>
</body>
</html>
)",
      fmt::arg("title", markup_text(title)), fmt::arg("uplot_css", assets::uplot_css),
      fmt::arg("page_css", assets::page_css), fmt::arg("json", script_json(json_data)),
      fmt::arg("license", assets::uplot_license), fmt::arg("uplot_js", assets::uplot_js),
      fmt::arg("page_js", assets::page_js), fmt::arg("plots_js", assets::plots_js),
      fmt::arg("script", script));
}

std::string make_report_page(std::string_view title,
                             std::string_view json_data,
                             std::string_view script) {
  return make_page(title, json_data,
                   std::string(assets::report_js)
                       .append(names_script())
                       .append(assets::figures_js)
                       .append(script));
}

std::string beside_index(std::string html) {
  constexpr std::string_view root = R"(<html lang="en")";
  if (const auto at = html.find(root); at != html.npos)
    html.insert(at + root.size(), " data-index");
  return html;
}

}  // namespace gonio
