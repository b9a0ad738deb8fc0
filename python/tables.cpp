// Tables: read, made of arrays, looked at, written.
#include <array>

#include "base/error.h"
#include "module.h"
#include "table/format/formats.h"
#include "table/format/in_memory.h"
#include "table/health/health.h"

#include <nanobind/stl/optional.h>

namespace gonio::python {
namespace {

using Self = nb::pointer_and_handle<Table>;

Table read(const std::string& path, const std::optional<std::string>& bins) {
  TableAndDigest in(path, bins_named(bins));
  in.finish();
  return std::move(in.table);
}

void expect_as_long(const char* name, const Column& c, std::size_t n) {
  if (c.size() != n)
    throw wrong_usage(std::string(name) + ": " + std::to_string(c.size()) + " values of " +
                      std::to_string(n) + " samples");
}

Table from_columns(const std::string& name,
                   const std::array<Column, 4>& at,
                   const std::vector<Column>& values,
                   const std::vector<std::string>& channels,
                   const std::optional<Column>& weights) {
  const std::size_t n = at[0].size();
  for (const auto& c : at) expect_as_long("directions", c, n);
  std::vector<std::span<const double>> columns;
  for (const auto& c : values) {
    expect_as_long("values", c, n);
    columns.push_back(span_of(c));
  }
  if (weights) expect_as_long("weights", *weights, n);
  if (!channels.empty() && channels.size() != values.size())
    throw wrong_usage("channels: a name for each channel of the values");
  return table_of(name, {span_of(at[0]), span_of(at[1]), span_of(at[2]), span_of(at[3])}, columns,
                  channels, weights ? span_of(*weights) : std::span<const double>());
}

/// Column of a table as an array that keeps the table alive.
View view(const Self& self, const double* data, std::size_t n) {
  return View(data, {n}, self.h);
}

/// One of the four angles of all samples: in place of a list; of a grid it is computed.
View angle(const Self& self, std::size_t which) {
  const Table& t = *self.p;
  if (const auto* l = t.list()) {
    const auto& column =
        *std::array{&l->theta_i_deg, &l->phi_i_deg, &l->theta_o_deg, &l->phi_o_deg}[which];
    return view(self, column.data(), column.size());
  }
  std::vector<double> angles(t.size());
  {
    const nb::gil_scoped_release others_run;
    const SampleAngles at(t);
    for (std::size_t i = 0; i < angles.size(); ++i) angles[i] = angles_deg(t, at, i)[which];
  }
  const std::size_t n = angles.size();
  return owning<View>(std::move(angles), {n});
}

}  // namespace

void bind_tables(nb::module_& m) {
  nb::class_<Table> table(m, "Table");
  table.def_ro("path", &Table::path)
      .def_ro("sha256", &Table::sha256)
      .def_ro("format", &Table::format)
      .def_ro("channels", &Table::channels)
      .def_ro("warnings", &Table::warnings)
      .def_prop_ro("bins", [](const Table& t) { return std::string(name_of(t.bins())); })
      .def_prop_ro("has_bins", &Table::has_bins)
      .def_prop_ro("is_grid", [](const Table& t) { return t.grid() != nullptr; })
      .def("__len__", &Table::size)
      .def(
          "column",
          [](const Self& self, std::size_t channel) {
            if (channel >= self.p->values.size()) throw nb::index_error();
            return view(self, self.p->values[channel].data(), self.p->size());
          },
          nb::arg("channel"))
      .def(
          "angle",
          [](const Self& self, std::size_t which) {
            if (which > 3) throw nb::index_error();
            return angle(self, which);
          },
          nb::arg("which"))
      .def("weights", [](const Self& self) {
        return view(self, self.p->weights.data(), self.p->weights.size());
      });
  const nb::call_guard<nb::gil_scoped_release> others_run;
  m.def("read", &read, nb::arg("path"), nb::arg("bins").none(), others_run);
  m.def("write", &write_table, nb::arg("table"), nb::arg("path"), others_run);
  m.def(
      "table",
      [](const std::string& name, const Column& theta_i, const Column& phi_i, const Column& theta_o,
         const Column& phi_o, const std::vector<Column>& values,
         const std::vector<std::string>& channels, const std::optional<Column>& weights) {
        return from_columns(name, {theta_i, phi_i, theta_o, phi_o}, values, channels, weights);
      },
      nb::arg("name"), nb::arg("theta_i").noconvert(), nb::arg("phi_i").noconvert(),
      nb::arg("theta_o").noconvert(), nb::arg("phi_o").noconvert(), nb::arg("values").noconvert(),
      nb::arg("channels"), nb::arg("weights").noconvert().none(), others_run);
  m.def(
      "inspect", [](const Table& t) { return to_json(t, inspect(t)); }, nb::arg("table"),
      others_run);
}

}  // namespace gonio::python
