#pragma once
/// \file
/// Knowledge of a table beyond its format: bin convention, truth, notes, the meaning of its
/// columns; as JSON in a side file (FILE.gonio.json) or an attribute.
///
///   {"schema": "gonio.table/1", "sha256": of the table's file (in a side file that gonio wrote),
///    "bins": "centre"|"edge" (where there are bins),
///    "values": "f_r"|"srgb"|"dj_brdf"|"xyz" (of a UTIA file, see table/format/utia.h),
///    "columns": how to read them (of CSV, see table/format/column_map.h),
///    "truth": {"model", "parameters": {NAME: number or array}, "noise", "floor", "outliers", "seed"},
///    "notes": {NAME: string}}
///
/// What may stand there is described in table/format/side_file.h.

#include <optional>
#include <string>

#include "table/format/column_map.h"
#include "table/table.h"

namespace gonio {

std::string side_path(const std::string& path);
/// True where there is anything that a reader would not assume anyway.
bool needs_metadata(const Table&);
/// \param sha256  of the file that this goes beside; empty: said nothing of
std::string metadata_text(const Table&, const std::string& sha256 = "");
/// JSON Schema of it.
std::string side_file_schema();
/// A sha256 that is not the table's is an error: the text speaks of another.  While the table's is
/// still being made, that is left to expect_same_table().
/// \param file  named in errors
void apply_metadata(Table&, const std::string& file, const std::string& text);
void expect_same_table(const Table&, const std::string& file, const std::string& text);

/// Columns as a side file names them, if it does.  An unknown key is an error.
std::optional<ColumnMap> column_map(const std::string& file, const std::string& text);
/// The text with its columns replaced, all else kept.  \param text  of a side file, or ""
std::string with_columns(const std::string& file, const std::string& text, const ColumnMap&);

}  // namespace gonio
