#pragma once
/// \file
/// Commands of `gonio columns`, as a person types them.

#include <functional>
#include <string>

#include "table/format/column_map.h"
#include "table/table.h"

namespace gonio {

/// The table's file as a person types it; "FILE" of several, and of a table that is none.
std::string file_word(const Table&);

/// "gonio columns FILE --map theta_i=… …", with all that the map says.
std::string columns_command(const std::string& file, const ColumnMap&);

/// Exchanges the columns of two angles.
void exchange(ColumnMap&, const std::string& one, const std::string& other);
/// The column of a role: what the map says, else the column of that very name.
std::string column_of(const ColumnMap&, const std::string& role);
/// Says the column of a role.
void put_column(ColumnMap&, const std::string& role, std::string column);

/// The command after which the table's file is read as the changed map says.  A file of another format becomes CSV first.
/// \param change  gets the map that the table was read by
std::string reading_command(const Table&, const std::function<void(ColumnMap&)>& change);

}  // namespace gonio
