#pragma once
/// \file
/// A page as data: sections of prose, tables and pictures, which one renderer shows (render.h).  Text in `backticks` is code, in
/// **asterisks** bold.

#include <algorithm>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "reports/picture/figure.h"

namespace gonio::page {

struct Cell {
  std::string text;
  std::string title;   ///< what a pointer reads
  std::string aside;   ///< small, after the text
  std::string look;    ///< a class of page.css
  std::string mark{};  ///< HTML before the text: a bar, a small drawing
  Cell() = default;
  Cell(std::string what, std::string read = {}, std::string beside = {}, std::string as = {})
      : text(std::move(what)),
        title(std::move(read)),
        aside(std::move(beside)),
        look(std::move(as)) {}
  Cell(const char* what) : text(what) {}
};
/// Name of a form, and its id small.
Cell form_cell(std::string_view form);

struct Column {
  std::string name;
  bool number = false;  ///< set right
};
/// Columns by their names, of numbers after a '>': "form|>RMS|>worst".
std::vector<Column> columns(std::string_view names);
struct Table {
  std::vector<Column> head{};
  std::vector<std::vector<Cell>> rows{};
  /// Class of how it is set: "in-cards" of numbers, "in-cards dense" of many, "told-by-cell" of words.
  std::string look = "in-cards";
  /// Heads above columns beside each other, with how many; what a card then says of a cell is both.
  std::vector<std::pair<std::string, std::size_t>> above{};
  std::vector<std::string> row_looks{};

  /// A row of these.
  template <class... C>
  void add(const C&... cells) {
    rows.push_back({Cell(cells)...});
  }
};

struct Prose {
  std::string text;
  std::string look{};  ///< "small muted"
};
struct Subtitle {
  std::string text;
};
struct Points {  ///< a list.  look: "findings", "warnings"
  std::vector<std::string> each{};
  std::string look = "findings";
};
struct Pairs {  ///< a term and what it is; one without a text is left out
  std::vector<std::pair<std::string, Cell>> each;
  std::string look = "pairs";  ///< "facts": large, beside each other
};
/// The picture of a family that has these choices; of a map with slices one more: {"at", the slice}.
struct Shown {
  std::string family;
  FigureChoices choices{};
  double height = 300;       ///< of curves [px]
  std::string emphasised{};  ///< curve before which all others stand back
  bool again = false;        ///< it stands on the page a second time
};
struct Markup {  ///< HTML of what nothing else on a page looks like
  std::string html;
};
/// Things that a reader looks through by words, by kind and in the order of a value: as cards and as rows of a table.
struct Browse {
  struct Item {
    std::string html;   ///< of its card
    std::string words;  ///< that find it
    std::string kind;
    std::vector<std::string> keys;  ///< as many as Browse has; empty: not known
  };
  std::vector<std::string> keys{};   ///< what items are put in order by
  std::vector<std::string> kinds{};  ///< beside "all"
  std::vector<Item> items{};
  Table rows{};  ///< a row of each, heads called as the keys
};
struct Part;
/// What is shown when a reader asks for it.
struct Fold {
  std::string title;
  std::vector<Part> parts;
};
/// Parts beside each other.  look: "columns", "columns map", "panels".
struct Group {
  std::string look;
  std::vector<Part> parts;
};
/// What a reader chooses by.
struct Control {
  std::string key;   ///< of the pictures' choices
  std::string name;  ///< what it stands beside
  std::string chosen{};
  bool list = false;  ///< of many; else words beside each other
  /// What values are called, of those that are not called by themselves.
  std::vector<std::pair<std::string, std::string>> called{};
};
/// What is shown by which choices: a value for each control; empty where any will do.
struct Alternative {
  std::vector<std::string> chosen;
  std::vector<Part> parts;
};
/// One place whose content changes; the first that a choice has says what can be chosen together.
struct Slot {
  std::vector<Alternative> each;
  bool on_paper = true;  ///< other values of the first control are printed, too, small
};
struct Choice {
  std::vector<Control> controls;
  std::vector<Slot> slots;
  std::string look = "columns";
  std::size_t emphasis =
      std::string::npos;  ///< control whose value names the curve that others stand back behind
};

struct Part {
  std::variant<Prose, Subtitle, Points, Pairs, Table, Shown, Markup, Browse, Fold, Group, Choice>
      is;
  template <class T>
  Part(T of) : is(std::move(of)) {}
};

struct Section {
  std::string title;
  std::string text;
  std::vector<Part> parts;
  std::string anchor{};  ///< empty: the title's words
};

struct Page {
  std::string
      name;  ///< of the report, whose folder has the files of its pictures; empty: there are none
  std::string command;         ///< "report schlick"
  std::string title, heading;  ///< of the window; of the page
  std::vector<std::string> findings{};
  std::vector<Part> first{};         ///< what shows the first finding
  bool wide = false;                 ///< that needs the width of the page
  std::vector<Section> sections{};   ///< without parts and text: left out
  bool full = false, quick = false;  ///< setting of a report
  bool all_files =
      true;  ///< pictures that a reader chooses have files, as those shown at first have
  std::string setting{};  ///< what is said of it at the end
  /// Names of curves that are shown at first where there are more than can be told apart.
  std::vector<std::string> most_shipped{};
};

/// What rows have, each once, in order.  \param of  a member, or a function of a row
template <class Rows, class Of>
std::vector<std::string> unique(const Rows& rows, Of of) {
  std::vector<std::string> out;
  for (const auto& r : rows)
    if (std::string value(std::invoke(of, r)); std::ranges::find(out, value) == out.end())
      out.push_back(std::move(value));
  return out;
}

/// Bar of a part of the longest one, for a cell.
std::string bar(double part);

/// All pictures of a family as one slot.
/// \param controls  whose keys tell them apart   \param fixed  what all of them have
Slot slot_of(const Pictures&,
             std::string_view family,
             const std::vector<Control>& controls,
             double height = 300,
             const FigureChoices& fixed = {});
/// The picture that shows a page's first finding; nothing where it is not there.
std::vector<Part> opening(const Pictures&,
                          std::string_view family,
                          FigureChoices choices = {},
                          double height = 330);
/// Whether a family has a picture.
bool has_family(const Pictures&, std::string_view family);
/// Values of a choice that a family has, in order.
std::vector<std::string> values_of(const Pictures&, std::string_view family, std::string_view key);

}  // namespace gonio::page
