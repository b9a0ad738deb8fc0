#pragma once
/// \file
/// Text with columns, as instruments and spreadsheets write it: fields between `;`, tabs, commas or
/// blanks, a line of names above them.  A field that begins with a quote ends with one; a quote within
/// is doubled, separators and line ends are as good as any other character there [RFC 4180].
///
/// Variants that can be told for sure are read: a UTF-8 byte-order mark, Windows line ends, the line ends of old
/// Macs where there are no others, numbers with a decimal comma where the comma separates nothing.
/// Lines that are blank or begin with '#' are passed over; where the first of the others holds numbers
/// alone, the names are those of the last comment above it, if they are as many.

#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gonio {

/// Number that takes the whole field, with a point or one decimal comma; also nan and inf.
std::optional<double> number_in(std::string_view field);

/// Mark of a spreadsheet or an instrument that there is no value: an empty field, n/a, NA or -.
bool is_gap(std::string_view field);

/// True where the beginning of a file looks like such text: a line with so many numbers or more soon.
bool looks_delimited(std::string_view head, int least = 3);
/// The fields of the first line that says something: its names, if it has any.
std::vector<std::string> first_fields(std::string_view head);

/// A name as one field between commas, in quotes where it needs them.
std::string comma_field(std::string_view name);
/// The names of such fields.
std::vector<std::string> comma_fields(std::string_view);

/// Refuses text in UTF-16, with or without a byte-order mark, by name.  \param file  named in errors
void expect_no_utf16(const std::string& file, std::string_view head);

/// Lines above the names that are passed over: how many, and the first and the last that say something.
struct PassedOver {
  std::size_t lines = 0;
  std::string first, last;
};

/// Line by line.  The text must outlive it.
class Delimited {
 public:
  /// Passes over `skip` lines and over lines of words above the table, then reads the names.
  /// \param path  named in errors.  UTF-16 and a quote that does not end are errors.
  Delimited(std::string path, std::string_view text, std::size_t skip = 0);

  const PassedOver& passed_over() const { return passed_over_; }
  /// One a column, with the blanks that it has in quotes; all "" where there is no line of names.
  const std::vector<std::string>& names() const { return names_; }
  /// Goes to the next line; one that has more or fewer fields than there are columns is an error.
  bool next();
  /// Fields of this line, without blanks around them; there until the next one.
  const std::vector<std::string_view>& fields() const { return fields_; }
  /// Number in a field; one that is none, or mixes decimal points and commas, is an error.
  double number(std::size_t column);
  /// True where a number had a decimal point, or comma.
  bool saw_points() const { return saw_points_; }
  bool saw_commas() const { return saw_commas_; }
  /// Lines that are left, in parts of a megabyte that can be read at the same time, each counting its lines anew; none
  /// of a short text, or where quotes leave open where lines end.
  std::vector<Delimited> parts() const;
  /// Names the line, and the column unless that is "".
  [[noreturn]] void fail(std::string_view column,
                         std::string_view found,
                         const std::string& expected) const;
  /// Its name, or its number as "#1".
  std::string label(std::size_t column) const;

 private:
  bool next_line();
  std::size_t end_of_record() const;
  void header();
  std::string path_;
  std::string_view rest_, line_, comment_;
  PassedOver passed_over_;
  std::size_t line_number_ = 0;
  std::size_t lines_ = 1;  ///< that the record takes
  char line_end_, separator_ = 0;
  bool pending_ = false, any_row_ = false, saw_points_ = false, saw_commas_ = false;
  std::vector<std::string> names_;
  std::vector<std::string_view> fields_;
  std::deque<std::string> unescaped_;  ///< those of fields_ that had quotes within
};

}  // namespace gonio
