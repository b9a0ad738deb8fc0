#pragma once
/// \file
/// Text with columns, as instruments and spreadsheets write it: fields between `;`, tabs, commas or
/// blanks, perhaps quoted, a line of names above them.
///
/// What can be told for sure is read: a UTF-8 byte-order mark, Windows line ends, numbers with a
/// decimal comma where the comma separates nothing.  Lines that are blank or begin with '#' are
/// passed over; where the first of the others holds numbers alone, the names are those of the last
/// comment above it, if they are as many.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gonio {

/// A number that takes the whole field, with a point or one decimal comma; also nan and inf.
std::optional<double> number_in(std::string_view field);

/// Where a spreadsheet or an instrument has no value: an empty field, n/a, NA or -.
bool is_gap(std::string_view field);

/// Whether the beginning of a file looks like such text: a line with three numbers or more soon.
bool looks_delimited(std::string_view head);
/// The fields of the first line that says something: its names, if it has any.
std::vector<std::string_view> first_fields(std::string_view head);

/// Line by line.  The text must outlive it.
class Delimited {
 public:
  /// Passes over `skip` lines, then reads the names.  \param path  named in errors
  Delimited(std::string path, std::string_view text, std::size_t skip = 0);

  /// One a column; all "" where there is no line of names.
  const std::vector<std::string>& names() const { return names_; }
  /// The fields of the next line; a line that has more or fewer than there are columns is an error.
  bool next();
  const std::vector<std::string_view>& fields() const { return fields_; }
  /// What is no number, or mixes decimal points and commas, is an error.
  double number(std::size_t column);
  /// Names the line, and the column unless that is "".
  [[noreturn]] void fail(std::string_view column,
                         std::string_view found,
                         const std::string& expected) const;
  /// Its name, or its number as "#1".
  std::string label(std::size_t column) const;

 private:
  bool next_line();
  void header();
  std::string path_;
  std::string_view rest_, line_, comment_;
  std::size_t line_number_ = 0;
  char separator_ = ',';
  bool pending_ = false, any_row_ = false, points_ = false, commas_ = false;
  std::vector<std::string> names_;
  std::vector<std::string_view> fields_;
};

}  // namespace gonio
