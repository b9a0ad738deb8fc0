// Pictures as CSV.
#include <cmath>
#include <string_view>

#include "base/csv_describe.h"
#include "reports/picture/figure.h"

namespace gonio {
namespace {

class Line {
 public:
  explicit Line(std::string& out) : out_(out) {}
  template <class T>
  Line& operator<<(const T& value) {
    if (!first_) out_ += ',';
    first_ = false;
    out_ += csv_cell(value, Digits::six);
    return *this;
  }
  ~Line() { out_ += '\n'; }
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;

 private:
  std::string& out_;
  bool first_ = true;
};

template <class T>
T at_or(const std::vector<T>& v, std::size_t i, T otherwise) {
  return i < v.size() ? v[i] : otherwise;
}

}  // namespace

std::string to_csv(const Figure& f) {
  bool labels = false, x_errors = false, y_errors = false;
  for (const auto& c : f.curves) {
    labels = labels || !c.labels.empty();
    x_errors = x_errors || !c.x_error.empty();
    y_errors = y_errors || !c.y_error.empty();
  }
  std::string out;
  {
    Line head(out);
    head << std::string_view("curve") << std::string_view(f.x.label) << std::string_view(f.y.label);
    if (labels) head << std::string_view("label");
    if (x_errors) head << std::string_view("± " + f.x.label);
    if (y_errors) head << std::string_view("± " + f.y.label);
  }
  for (const auto& c : f.curves)
    for (std::size_t i = 0; i < c.x.size(); ++i) {
      if (!std::isfinite(c.x[i]) || !std::isfinite(c.y[i])) continue;
      Line line(out);
      line << std::string_view(c.name) << c.x[i] << c.y[i];
      if (labels) line << std::string_view(at_or(c.labels, i, std::string()));
      if (x_errors) line << at_or(c.x_error, i, no_value);
      if (y_errors) line << at_or(c.y_error, i, no_value);
    }
  return out;
}

std::string to_csv(const FigureMap& m) {
  std::string out;
  {
    Line head(out);
    if (!m.slices.empty()) head << std::string_view("slice");
    head << std::string_view(m.x.label) << std::string_view(m.y.label) << std::string_view(m.value);
  }
  const auto place = [](Line& line, const FigureMap::Axis& axis, std::size_t i) {
    if (axis.names.empty())
      line << axis.at[i];
    else
      line << std::string_view(axis.names[i]);
  };
  const std::size_t cells = m.x.size() * m.y.size();
  for (std::size_t k = 0; k < m.values.size(); ++k) {
    if (!std::isfinite(m.values[k])) continue;
    Line line(out);
    if (!m.slices.empty()) line << std::string_view(m.slices[k / cells]);
    place(line, m.x, k % cells / m.y.size());
    place(line, m.y, k % m.y.size());
    line << m.values[k];
  }
  return out;
}

}  // namespace gonio
