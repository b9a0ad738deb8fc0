#include "table/format/no_table.h"

#include <algorithm>

#include "base/blanks.h"
#include "base/error.h"

#include <fmt/format.h>

namespace gonio {
namespace {

constexpr const char* as_csv = "a table: save it as CSV with theta_i, phi_i, theta_o, phi_o and f";
constexpr const char* one_sheet = "a table: save the sheet with the values as CSV";
constexpr const char* unpacked = "a table: unpack the archive first";
constexpr const char* from_numpy = "a table: numpy.savetxt writes its columns as text";
constexpr const char* copied = "a table: copy its numbers into a CSV file";
constexpr const char* no_picture =
    "a table, or an image slice as OpenEXR; `gonio stack` takes photographs";

/// Kind of file that is no table for gonio.
struct NoTable {
  std::string_view begins;  ///< in lower case where it is text
  std::string_view holds;   ///< behind that; "" of all
  const char* kind;
  const char* expected;
};
/// Of binary files the first bytes, as they are.
constexpr NoTable binary[]{
    {"PK\x03\x04", "xl/", "an Excel workbook", one_sheet},
    {"PK\x03\x04", "opendocument.spreadsheet", "an OpenDocument spreadsheet", one_sheet},
    {"PK\x03\x04", ".npy", "NumPy arrays (npz)", from_numpy},
    {"PK\x03\x04", "", "a spreadsheet, or another ZIP archive", one_sheet},
    {"\xd0\xcf\x11\xe0", "", "a spreadsheet of old Excel", one_sheet},
    {"\x93NUMPY", "", "a NumPy array", from_numpy},
    {"\x89HDF", "", "HDF5 (MATLAB writes it, too)", as_csv},
    {"MATLAB 5.0", "", "a file of MATLAB", as_csv},
    {"\x1f\x8b\x08", "", "a gzip archive", unpacked},
    {"7z\xbc\xaf", "", "a 7z archive", unpacked},
    {"%PDF-", "", "a PDF document", copied},
    {"{\\rtf", "", "an RTF document", copied},
    {"\x89PNG", "", "a PNG image", no_picture},
    {"\xff\xd8\xff", "", "a JPEG image", no_picture},
    {std::string_view("II*\0", 4), "", "a TIFF image", no_picture},
    {std::string_view("MM\0*", 4), "", "a TIFF image", no_picture}};
/// Of text: blanks are one.
constexpr NoTable beginnings_of_text[]{{"<!doctype html", "", "a web page", copied},
                                       {"<html", "", "a web page", copied},
                                       {"<", "", "XML that is no BSDF of a WindowElement", as_csv},
                                       {"{", "", "JSON", as_csv},
                                       {"[", "", "JSON", as_csv}};
/// The same, after any word: a line of comment may be above.
constexpr NoTable within_text[]{
    {"optis -", "", "a BSDF of Speos", as_csv},
    {"datatype:", "", "a BSDF file that begins with DataType:", as_csv}};

/// Refuses a document of gonio's own by its schema.
void expect_no_document(const std::string& path, std::string_view text) {
  constexpr std::string_view key = "\"schema\":";
  const auto at = text.find(key);
  if (!text.starts_with('{') || at == text.npos) return;
  std::string_view schema = text.substr(at + key.size());
  if (schema.starts_with(' ')) schema.remove_prefix(1);
  if (!schema.starts_with("\"gonio.")) return;
  schema.remove_prefix(1);
  schema = schema.substr(0, schema.find('"'));
  constexpr std::pair<std::string_view, const char*> uses[]{
      {"gonio.fit/", "a table; `gonio compare TABLE FIT` shows a fit beside one"},
      {"gonio.models/", "a table; `gonio fit TABLE` takes the model that it recommends"},
      {"gonio.stack/", "a table; `gonio fit_map` fits a stack of images"},
      {"gonio.scene/", "a table; `gonio plan` takes a scene"},
      {"gonio.table/", "a table; this one says how the file beside it is read"}};
  const auto* const use =
      std::ranges::find_if(uses, [&](const auto& u) { return schema.starts_with(u.first); });
  throw bad_input(path, "the beginning", fmt::format("a document of schema {}", schema),
                  use == std::end(uses) ? "a table" : use->second);
}

}  // namespace

void expect_no_foreign_format(const std::string& path, std::string_view head) {
  head = without_mark(head);
  const auto refuse = [&](const NoTable& n) {
    throw bad_input(path, "the beginning", n.kind, n.expected);
  };
  for (const auto& n : binary)
    if (head.starts_with(n.begins) && head.find(n.holds) != head.npos) refuse(n);
  std::string begin;  // with one blank for many
  for (const char c : head.substr(0, 4096)) {
    const bool blank = c == ' ' || c == '\t' || c == '\r' || c == '\n';
    if (!blank || (!begin.empty() && begin.back() != ' ')) begin += blank ? ' ' : c;
  }
  // A binary table may begin with any byte.
  if (std::ranges::any_of(begin, [](unsigned char c) { return c < 0x20 || c == 0x7f; })) return;
  expect_no_document(path, begin);
  std::ranges::transform(begin, begin.begin(), [](char c) {
    return 'A' <= c && c <= 'Z' ? static_cast<char>(c | 0x20) : c;
  });
  for (const auto& n : beginnings_of_text)
    if (begin.starts_with(n.begins)) refuse(n);
  for (const auto& n : within_text)
    if (begin.starts_with(n.begins) || begin.find(fmt::format(" {}", n.begins)) != begin.npos)
      refuse(n);
}

}  // namespace gonio
