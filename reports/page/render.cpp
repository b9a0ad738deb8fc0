#include "reports/page/render.h"

#include <algorithm>
#include <cctype>
#include <set>

#include "base/text.h"
#include "reports/page/assets.h"
#include "reports/page/page.h"
#include "reports/picture/indices.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio::page {
namespace {

/// Markup whose words that a line would break after a sign within are kept whole: "×/÷ 1.2", its space unbreakable, "|a × b|²".
std::string with_whole_words(std::string_view markup) {
  std::string out;
  while (!markup.empty()) {
    const auto word = markup.substr(0, markup.find(' '));
    const bool breaks = word.find("×/÷") != word.npos || word.find("|²") != word.npos;
    if (breaks && word.find_first_of("`*<") == word.npos)
      out.append("<span class=\"nw\">").append(word).append("</span>");
    else
      out += word;
    markup.remove_prefix(word.size());
    for (; markup.starts_with(' '); markup.remove_prefix(1)) out += ' ';
  }
  return out;
}
/// Text with its code set as such, and indices of angles set low.
std::string prose(std::string_view text) {
  std::string out;
  bool code = false, bold = false;
  const auto escaped = with_whole_words(with_indices(markup_text(text), "<sub>", "</sub>"));
  for (std::size_t i = 0; i < escaped.size(); ++i)
    if (escaped[i] == '`') {
      out += (code = !code) ? "<code>" : "</code>";
    } else if (!code && escaped.compare(i, 2, "**") == 0) {
      out += (bold = !bold) ? "<b>" : "</b>";
      ++i;
    } else {
      out += escaped[i];
      if (code && escaped[i] == '+') out += "<wbr>";  // where a spec that does not fit breaks
    }
  return out + (code ? "</code>" : "") + (bold ? "</b>" : "");
}
std::string attribute(std::string_view name, std::string_view value) {
  return value.empty() ? std::string() : fmt::format(R"( {}="{}")", name, markup_text(value));
}
std::string element(std::string_view tag, std::string_view look, std::string_view inside) {
  return fmt::format("<{0}{1}>{2}</{0}>", tag, attribute("class", look), inside);
}
/// A title's words in small letters.
std::string anchor_of(std::string_view title) {
  std::string out;
  for (const char c : title) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x80 || std::isalnum(byte) != 0)
      out += static_cast<char>(byte < 0x80 ? std::tolower(byte) : byte);
    else if (!out.empty() && out.back() != '-')
      out += '-';
  }
  while (out.ends_with('-')) out.pop_back();
  return out;
}

class Renderer {
 public:
  Renderer(const Page& page, const Pictures& pictures, std::set<std::string>* linked)
      : page_(page), pictures_(pictures), linked_(linked), styles_(pictures.figures) {}

  std::string html() {
    std::string contents, sections;
    for (const auto& s : page_.sections) {
      if (s.parts.empty() && s.text.empty()) continue;
      const auto anchor = s.anchor.empty() ? anchor_of(s.title) : s.anchor;
      contents += fmt::format("<a href=\"#{}\">{}</a>", markup_text(anchor), prose(s.title));
      sections += fmt::format("<section id=\"{}\"><h2>{}</h2>{}{}</section>\n", markup_text(anchor),
                              prose(s.title), s.text.empty() ? "" : element("p", "", prose(s.text)),
                              parts(s.parts));
    }
    const std::string opening = findings();
    return drawn_page(
        page_.title,
        fmt::format(
            R"(<header>{}<h1>{}</h1><nav class="contents" aria-label="Contents">{}</nav></header>
{}{}<footer>{}</footer>)",
            page_.command.empty()
                ? ""
                : fmt::format(
                      R"(<p class="over"><a class="back" href="index.html">All reports</a>gonio {}</p>)",
                      page_.command),
            prose(page_.heading), contents, opening, sections, setting()),
        page_looks(styles_, pictures_.figures) + page_shades(pictures_.maps));
  }

 private:
  std::string setting() const {
    if (page_.name.empty()) return prose(page_.setting);
    return fmt::format(
        "{} setting. {}{}The rows and pictures of this page are in the JSON document beside it.",
        page_.full    ? "Full"
        : page_.quick ? "Quick"
                      : "Standard",
        prose(page_.setting), page_.setting.empty() ? "" : " ");
  }
  std::string parts(const std::vector<Part>& list) {
    std::string out;
    for (const auto& p : list)
      out += std::visit([&](const auto& part) { return html_of(part); }, p.is);
    return out;
  }

  std::string html_of(const Prose& p) { return element("p", p.look, prose(p.text)) + "\n"; }
  std::string html_of(const Subtitle& s) { return element("h3", "", prose(s.text)) + "\n"; }
  std::string html_of(const Markup& m) { return m.html; }
  std::string html_of(const Group& g) { return element("div", g.look, parts(g.parts)) + "\n"; }
  std::string html_of(const Points& list) {
    std::string out;
    for (const auto& text : list.each) out += element("li", "", prose(text));
    return element("ul", list.look, out);
  }
  std::string html_of(const Pairs& list) {
    std::string out;
    for (const auto& [term, what] : list.each) {
      if (what.text.empty()) continue;
      const auto pair = element("dt", "", prose(term)) + element("dd", "", inside(what));
      out += list.look == "facts" ? element("div", "", pair) : pair;
    }
    return element("dl", list.look, out);
  }
  std::string html_of(const Fold& f) {
    return fmt::format(R"(<details class="more"><summary>{}</summary>{}</details>)", prose(f.title),
                       parts(f.parts));
  }
  /// Returns one of several choices, as a radio button.
  static std::string option(std::string_view name,
                            std::string_view value,
                            bool chosen,
                            std::string_view text) {
    return fmt::format(
        R"(<label><input type="radio" name="{}" value="{}"{}><span>{}</span></label>)", name,
        markup_text(value), chosen ? " checked" : "", text);
  }
  std::string html_of(const Browse& b) {
    std::string kinds = option("kind", "", true, "all"), keys = "<option>as given</option>", cards;
    for (const auto& k : b.kinds) kinds += option("kind", k, false, prose(k));
    for (const auto& k : b.keys) keys += element("option", "", prose(k));
    for (const auto& item : b.items)
      cards += fmt::format(
          R"(<article class="card" data-words="{}" data-kind="{}" data-keys="{}">{}</article>)",
          markup_text(item.words), markup_text(item.kind),
          markup_text(fmt::format("{}", fmt::join(item.keys, "|"))), item.html);
    return fmt::format(
        R"(<div class="browse"><form class="controls"><input type="search" name="words" placeholder="part of a name" aria-label="Filter by name or flag"><span class="switch" role="group" aria-label="Which ones">{}</span><label>by <select name="key">{}</select></label><label><input type="checkbox" name="falling"> falling</label><span class="switch" role="group" aria-label="View">{}{}</span><span class="muted shown"></span></form><div class="cards">{}</div><div class="rows" hidden>{}</div></div>)",
        kinds, keys, option("view", "cards", true, "cards"), option("view", "rows", false, "rows"),
        cards, html_of(b.rows));
  }

  std::string html_of(const Table& t) {
    std::string above, head, body;
    std::vector<std::string> names;  // what a card says of a cell
    std::size_t column = 0;
    for (const auto& [text, n] : t.above) {
      above += fmt::format(R"(<th{}{}>{}</th>)", n > 1 ? fmt::format(" colspan=\"{}\"", n) : "",
                           text.empty() ? "" : R"( class="n")", prose(text));
      for (std::size_t i = 0; i < n && column < t.head.size(); ++i, ++column)
        names.push_back(t.head[column].name + (text.empty() ? "" : " " + text));
    }
    for (const auto& c : t.head) {
      head += fmt::format(R"(<th{} scope="col">{}</th>)", c.number ? R"( class="n")" : "",
                          prose(c.name));
      if (t.above.empty()) names.push_back(c.name);
    }
    for (std::size_t r = 0; r < t.rows.size(); ++r) {
      body +=
          fmt::format("<tr{}>", attribute("class", r < t.row_looks.size() ? t.row_looks[r] : ""));
      for (std::size_t k = 0; k < t.rows[r].size(); ++k)
        body += cell(t.rows[r][k], k == 0, k < t.head.size() && t.head[k].number);
      body += "</tr>\n";
    }
    if (!above.empty()) above = "<tr>" + above + "</tr>";
    std::string cards;
    for (std::size_t k = 1; k < names.size(); ++k)
      if (!names[k].empty()) cards += fmt::format("--{}:\"{}: \";", k + 1, names[k]);
    return fmt::format(
        R"(<div class="{}{}"><table{}><thead>{}<tr>{}</tr></thead><tbody>{}</tbody></table></div>)",
        t.look.starts_with("in-cards") ? "scroll " : "", t.look, attribute("style", cards), above,
        head, body);
  }
  static std::string inside(const Cell& c) {
    std::string text = c.mark + prose(c.text);
    if (!c.aside.empty()) text += fmt::format(" <small>{}</small>", prose(c.aside));
    if (!c.look.empty() || !c.title.empty())
      text = fmt::format("<span{}{}>{}</span>", attribute("class", c.look),
                         attribute("title", c.title), text);
    return text;
  }
  static std::string cell(const Cell& c, bool first, bool number) {
    return fmt::format("<{0}{1}{2}>{3}</{0}>", first ? "th" : "td", number ? " class=n" : "",
                       first ? " scope=row" : "", inside(c));
  }

  // --- Pictures ----------------------------------------------------------------------------------
  /// \param slices  whether "at" is one of them and no choice
  static bool has(const FigureChoices& own, const FigureChoices& asked, bool slices) {
    return std::ranges::all_of(asked, [&](const auto& c) {
      return (slices && c.first == "at") || std::ranges::find(own, c) != own.end();
    });
  }
  std::string html_of(const Shown& s) {
    for (const auto& f : pictures_.figures)
      if (f.family == s.family && has(f.choices, s.choices, false)) return figure(f, s);
    for (const auto& m : pictures_.maps)
      if (m.family == s.family && has(m.choices, s.choices, !m.slices.empty())) return map(m, s);
    return "";
  }
  /// Title, note and links to the files beside the page.
  template <class Picture>
  std::string caption(const Picture& p,
                      std::string_view slice,
                      std::initializer_list<std::string_view> endings) {
    std::string files;
    const bool links = !page_.name.empty() && (page_.all_files || !hidden_);
    if (links && linked_) linked_->insert(p.id);
    for (const auto e : endings)
      files += fmt::format(R"(<a href="{}/{}.{}">{}</a>)", page_.name, p.id, e,
                           e == "svg"   ? "SVG"
                           : e == "csv" ? "CSV"
                                        : "EXR");
    auto note = p.note;
    if (!slice.empty()) note += (note.empty() ? "" : ", ") + std::string(slice);
    return fmt::format("<figcaption>{}{}{}</figcaption>", prose(p.title),
                       note.empty() ? "" : " <small>" + prose(note) + "</small>",
                       links ? " " + element("span", "files", files) : "");
  }
  template <class Picture>
  std::string opened(const Picture& p, const Shown& s, std::string_view look) {
    const bool first = !s.again && ids_.insert(p.id).second;
    return fmt::format("<figure{}{}>", attribute("class", look),
                       first ? attribute("id", p.id) : "");
  }

  std::string figure(const Figure& f, const Shown& s) {
    const auto first = shown_first(f, s.emphasised);
    const auto own = std::ranges::count_if(f.curves, [](const auto& c) { return !c.dashed; });
    std::string keys;
    for (std::size_t i = 0; i < f.curves.size(); ++i) {
      const auto& c = f.curves[i];
      keys += fmt::format(R"(<button type="button"{}{}>{}</button>)",
                          first[i] ? "" : R"( class="more")",
                          c.label.empty() ? "" : attribute("value", c.name), page_key(c, styles_));
    }
    if (std::ranges::find(first, false) != first.end())
      keys += fmt::format(R"(<button type="button" class="all">all {}</button>)", own);
    return opened(f, s, "") + caption(f, "", {"svg", "csv"}) + element("div", "keys", keys) +
           page_svg(f, styles_, s.height, first) + element("div", "xl", prose(f.x.label)) +
           R"(<div class="readout" aria-live="polite"></div></figure>)" + "\n";
  }
  std::string map(const FigureMap& m, const Shown& s) {
    const auto at = std::ranges::find(s.choices, "at", [](const auto& c) { return c.first; });
    const std::string slice = at == s.choices.end() ? "" : at->second;
    const auto k = slice.empty() ? 0 : std::ranges::find(m.slices, slice) - m.slices.begin();
    return opened(m, s, m.x.names.empty() && m.y.names.empty() ? "" : "named") +
           caption(m, slice, {"svg", "csv", "exr"}) +
           page_svg(m, static_cast<std::size_t>(k), !hidden_) +
           element("div", "xl", prose(m.x.label)) + page_scale(m) +
           R"(<div class="readout" aria-live="polite"></div></figure>)" + "\n";
  }
  /// Which curves are shown until the reader asks for all: references, what is emphasised, then what is most shipped.
  std::vector<bool> shown_first(const Figure& f, std::string_view emphasised) const {
    constexpr std::size_t told_apart = 6;
    const auto rank = [&](std::size_t i) -> std::size_t {
      const auto& name = f.curves[i].name;
      if (name == emphasised) return 0;
      for (std::size_t k = 0; k < page_.most_shipped.size(); ++k) {
        const auto& one = page_.most_shipped[k];
        for (std::size_t at = 0; at < name.size();) {  // "a = b": curves that came to the same
          const auto end = std::min(name.find(" = ", at), name.size());
          if (name.compare(at, end - at, one) == 0) return k + 1;
          at = end + 3;
        }
      }
      return page_.most_shipped.size() + 1;
    };
    std::vector<std::size_t> own;
    for (std::size_t i = 0; i < f.curves.size(); ++i)
      if (!f.curves[i].dashed) own.push_back(i);
    std::vector<bool> out(f.curves.size(), true);
    if (own.size() <= told_apart) return out;
    std::ranges::stable_sort(own, {}, rank);
    for (std::size_t k = told_apart; k < own.size(); ++k) out[own[k]] = false;
    return out;
  }

  // --- Choices
  static bool fits(const std::vector<std::string>& of, const std::vector<std::string>& now) {
    for (std::size_t k = 0; k < of.size(); ++k)
      if (!of[k].empty() && of[k] != now[k]) return false;
    return true;
  }
  /// What is chosen at first: of what there is, what has most of what was asked for.
  static std::vector<std::string> at_first(const Choice& c) {
    std::vector<std::string> asked;
    for (const auto& k : c.controls) asked.push_back(k.chosen);
    const Alternative* best = nullptr;
    std::size_t most = 0;
    for (const auto& a : c.slots[0].each) {
      std::size_t same = 0;  // what comes first counts more
      for (std::size_t k = 0; k < asked.size(); ++k)
        if (a.chosen[k].empty() || a.chosen[k] == asked[k])
          same += std::size_t{1} << (asked.size() - k);
      if (!best || same > most) best = &a, most = same;
    }
    for (std::size_t k = 0; best && k < asked.size(); ++k)
      if (!best->chosen[k].empty()) asked[k] = best->chosen[k];
    return asked;
  }
  std::string html_of(const Choice& c) {
    if (c.slots.empty() || c.slots[0].each.empty()) return "";
    const auto now = at_first(c);
    std::string controls, slots;
    for (std::size_t k = 0; k < c.controls.size(); ++k) controls += control(c, k, now[k]);
    for (const auto& s : c.slots) {
      std::string inside;
      const Alternative* chosen = nullptr;
      for (const auto& a : s.each)
        if (!chosen && fits(a.chosen, now)) chosen = &a;
      const auto put = [&](const char* tag, const Alternative& a) {
        std::string of;
        for (const auto& value : a.chosen) of += (&value == a.chosen.data() ? "" : "|") + value;
        inside +=
            fmt::format(R"(<{0} data-of="{1}">{2}</{0}>)", tag, markup_text(of), parts(a.parts));
      };
      if (chosen)
        put("div", *chosen);
      else
        inside += "<div></div>";
      hidden_ = true;
      for (const auto& a : s.each)
        if (&a != chosen) put("template", a);
      hidden_ = false;
      slots +=
          fmt::format(R"(<div class="slot"{}>{}</div>)", s.on_paper ? " data-paper" : "", inside);
    }
    const auto emphasis =
        c.emphasis < c.controls.size() ? fmt::format(R"( data-emphasis="{}")", c.emphasis) : "";
    return fmt::format(R"(<div class="choice"{}><form class="controls">{}</form>{}</div>)",
                       emphasis, controls, element("div", c.look, slots)) +
           "\n";
  }
  static std::string control(const Choice& c, std::size_t k, const std::string& now) {
    const auto& control = c.controls[k];
    std::vector<std::string> values;
    for (const auto& s : c.slots)
      for (const auto& a : s.each)
        if (!a.chosen[k].empty() && std::ranges::find(values, a.chosen[k]) == values.end())
          values.push_back(a.chosen[k]);
    std::string options;
    for (const auto& v : values) {
      const auto called =
          std::ranges::find(control.called, v, [](const auto& one) { return one.first; });
      const auto text = prose(called == control.called.end() ? v : called->second);
      options += control.list ? fmt::format(R"(<option value="{}"{}>{}</option>)", markup_text(v),
                                            v == now ? " selected" : "", text)
                              : option(fmt::format("c{}", k), v, v == now, text);
    }
    const char* hidden = values.size() < 2 ? " hidden" : "";
    return control.list
               ? fmt::format(R"(<label{}>{} <select name="c{}">{}</select></label>)", hidden,
                             prose(control.name), k, options)
               : fmt::format(R"(<span class="switch" role="group" aria-label="{}"{}>{}</span>)",
                             markup_text(control.name), hidden, options);
  }

  // --- The first sentences
  std::string findings() {
    constexpr std::size_t at_once = 3;
    if (page_.findings.empty()) return parts(page_.first);
    std::string answer, some, others;
    for (std::size_t i = 0; i < page_.findings.size(); ++i) {
      const auto p = element("p", i == 0 ? "verdict answer" : "", prose(page_.findings[i]));
      (i == 0 ? answer : i <= at_once ? some : others) += p;
    }
    if (!others.empty()) {
      const auto n = page_.findings.size() - at_once - 1;
      some += fmt::format("<details><summary>{} more finding{}</summary>{}</details>", n,
                          n == 1 ? "" : "s", others);
    }
    return fmt::format(R"(<div class="opening{}">{}{}{}</div>)", page_.wide ? " wide" : "", answer,
                       parts(page_.first), some.empty() ? "" : element("div", "verdict", some)) +
           "\n";
  }

  const Page& page_;
  const Pictures& pictures_;
  std::set<std::string>* linked_;
  CurveStyles styles_;
  std::set<std::string> ids_;
  bool hidden_ = false;  ///< what is rendered is not shown until it is chosen
};

}  // namespace

std::string page_html(const Page& page, const Pictures& pictures, std::set<std::string>* linked) {
  return Renderer(page, pictures, linked).html();
}

}  // namespace gonio::page
