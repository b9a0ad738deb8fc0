#pragma once
/// \file
/// Tables from files and into files, whatever the format.

#include <memory>
#include <optional>
#include <string>

#include "table/format/alta.h"
#include "table/format/astm.h"
#include "table/format/brdf_json.h"
#include "table/format/csv.h"
#include "table/format/exr_slice.h"
#include "table/format/klems.h"
#include "table/format/mbsdf.h"
#include "table/format/merl.h"
#include "table/format/ngan.h"
#include "table/format/rgl/rgl.h"
#include "table/format/ssdd.h"
#include "table/format/utia.h"
#include "table/format/zemax.h"
#include "table/table.h"

namespace gonio {

/// Table of a file whose format is found from the bytes, not from the name.
/// \param bins  beats what the file or its side file (table/format/metadata.h) says, which beats `centre`
Table read_table(const std::string& path, std::optional<Bins> bins = {});

/// A table that is used while its file's SHA-256 is still being made.
class TableAndDigest {
 public:
  explicit TableAndDigest(const std::string& path, std::optional<Bins> bins = {});
  /// Of a table that has its SHA-256 already.
  explicit TableAndDigest(Table);
  ~TableAndDigest();
  TableAndDigest(TableAndDigest&&) noexcept;

  Table table;  ///< with the SHA-256 of its file after finish()
  /// Before anything made from the table is shown: waits, and fails where the file has changed since
  /// it was opened, or where its side file speaks of another.
  void finish();

 private:
  friend Table read_table(const std::string&, std::optional<Bins>);
  class Digest;
  std::unique_ptr<Digest> digest_;
  std::string side_;  ///< text of the side file
};

/// Memory that the fit of a table takes, about, by its file [bytes].
double memory_needed(const std::string& path);

/// Text of the side file of a table; "" if there is none.
std::string side_text(const std::string& path);

/// Writes the table in the format of Table::format and, where there is more to say than that holds,
/// its side file; both or neither.
void write_table(const Table&, const std::string& path);

}  // namespace gonio
