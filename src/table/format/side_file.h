#pragma once
/// \file
/// Description of a side file.

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/describe.h"
#include "base/json/describe.h"
#include "table/format/column_map.h"
#include "table/format/utia.h"
#include "table/table.h"

namespace gonio {

/// Standard uncertainty of all values:  u² = (relative f)² + floor²
struct StatedUncertainty {
  double relative = 0, floor = 0;
};
template <>
inline constexpr auto description<StatedUncertainty> =
    FieldList{Field{"relative", &StatedUncertainty::relative, "part of the value"},
              Field{"floor", "1/sr", &StatedUncertainty::floor, ""}};

/// Knowledge of a table beyond its format, as it stands in a file.
struct SideFile {
  std::string sha256;  ///< of the table's file; empty: nothing is said of it
  std::optional<Bins> bins;
  std::optional<UtiaValues> values;
  std::optional<ColumnMap> columns;
  std::optional<Truth> truth;
  std::vector<std::pair<std::string, std::string>> notes;
  std::vector<double> aperture_deg;  ///< empty: none is known
  std::optional<StatedUncertainty> uncertainty;
};
inline constexpr const char* side_file_id = "gonio.table/1";

enum class AngleUnit { degrees, radians };
template <>
inline constexpr std::array<std::string_view, 2> names_of<AngleUnit>{"degrees", "radians"};

/// A member of a column map that says something else than a map without it would.
template <auto member>
auto unusual(const ColumnMap& map) {
  const auto value = map.*member;
  return value != ColumnMap{}.*member ? std::optional(value) : std::nullopt;
}

template <>
inline constexpr auto description<ColumnMap> = FieldList{
    keyed(role_pattern,
          &ColumnMap::columns,
          "column: its name, its number (#1 is the first), or a constant"),
    Field{"unit", if_there([](const ColumnMap& map) {
            return map.radians ? std::optional(AngleUnit::radians) : std::nullopt;
          }),
          "of all angles, else degrees"},
    Field{"forward", "°", if_there(unusual<&ColumnMap::forward_deg>),
          "phi_o − phi_i of the mirror direction, else 180"},
    Field{"cosine", if_there([](const ColumnMap& map) {
            return map.cosines == CosinePowers{0, 1} ? std::optional(true) : std::nullopt;
          }),
          "values are f cos θ_o"},
    Field{"cosines", if_there([](const ColumnMap& map) {
            const auto [incident, outgoing] = map.cosines;
            return incident == 0 && (outgoing == 0 || outgoing == 1)
                       ? std::nullopt
                       : std::optional(std::vector<int>{incident, outgoing});
          }),
          "powers of cos θ_i and cos θ_o that values are f times"},
    Field{"scale", if_there(unusual<&ColumnMap::scale>), "values times this are f in 1/sr, else 1"},
    Field{"skip", if_there(unusual<&ColumnMap::skip>), "lines at the top that are passed over"}};

template <>
inline constexpr auto description<Truth> =
    FieldList{Field{"model", &Truth::model, ""},
              Field{"parameters", per_name(&Truth::parameters), ""},
              Field{"noise", &Truth::noise, "σ of the multiplicative noise exp(σ z)"},
              Field{"floor", "1/sr", &Truth::floor, "added to every value"},
              Field{"outliers", &Truth::outliers, "share of samples replaced"},
              Field{"seed", &Truth::seed, ""}};
static_assert(describes_every_member<Truth>());

template <>
inline constexpr auto description<SideFile> =
    FieldList{constant_text("schema", side_file_id),
              Field{"sha256", if_there([](const SideFile& f) {
                      return f.sha256.empty() ? std::nullopt : std::optional(f.sha256);
                    }),
                    "of the table's file; in a side file that gonio wrote"},
              Field{"bins", if_there(&SideFile::bins), "where a sample sits in its bin"},
              Field{"values", if_there(&SideFile::values), "what the numbers of a UTIA file are"},
              Field{"columns", if_there(&SideFile::columns), "how to read those of a CSV file"},
              Field{"truth", if_there(&SideFile::truth), "what the table was made from"},
              Field{"aperture", "°", if_there([](const SideFile& f) {
                      return f.aperture_deg.empty() ? std::nullopt : std::optional(f.aperture_deg);
                    }),
                    "full widths of the cones of light and detector"},
              Field{"uncertainty", if_there(&SideFile::uncertainty),
                    "standard uncertainty of the values, where the table states none"},
              Field{"notes", if_there([](const SideFile& f) {
                      return f.notes.empty() ? std::nullopt : std::optional(f.notes);
                    }),
                    "texts by their names"}};

}  // namespace gonio
