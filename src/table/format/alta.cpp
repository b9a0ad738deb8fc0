#include "table/format/alta.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <numbers>

#include "base/blanks.h"
#include "base/error.h"
#include "base/numbers.h"
#include "base/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {
namespace {

enum class Input { angles, cosines, vectors };

struct AltaParametrization {
  std::string_view name;
  std::size_t size;
  Input input;
  DirectionPair (*pair)(const double*);
};

/// ALTA's difference direction is the view's, gonio's the light's.
DirectionPair from_half_difference(double theta_h, double phi_h, double theta_d, double phi_d) {
  const auto [view, light] = directions(HalfDifference{theta_h, phi_h, theta_d, phi_d});
  return {light, view};
}

constexpr std::array kAltaParametrizations{
    AltaParametrization{"SPHERICAL_TL_PL_TV_PV", 4, Input::angles,
                        [](const double* x) -> DirectionPair {
                          return {direction(x[0], x[1]), direction(x[2], x[3])};
                        }},
    AltaParametrization{"CARTESIAN", 6, Input::vectors,
                        [](const double* x) -> DirectionPair {
                          return {{x[3], x[4], x[5]}, {x[0], x[1], x[2]}};
                        }},
    AltaParametrization{
        "ISOTROPIC_TL_TV_PROJ_DPHI", 3, Input::angles,
        [](const double* x) -> DirectionPair {
          return {direction(x[0], 0), direction(std::hypot(x[1], x[2]), std::atan2(x[2], x[1]))};
        }},
    AltaParametrization{
        "ISOTROPIC_TV_PROJ_DPHI", 2, Input::angles,
        [](const double* x) -> DirectionPair {
          return {{0, 0, 1}, direction(std::hypot(x[0], x[1]), std::atan2(x[1], x[0]))};
        }},
    AltaParametrization{"ISOTROPIC_TV_TL", 2, Input::angles,
                        [](const double* x) -> DirectionPair {
                          return {direction(x[1], 0), direction(x[0], 0)};
                        }},
    AltaParametrization{"ISOTROPIC_TV_TL_DPHI", 3, Input::angles,
                        [](const double* x) -> DirectionPair {
                          return {direction(x[1], 0), direction(x[0], x[2])};
                        }},
    AltaParametrization{
        "RUSIN_TH_PH_TD_PD", 4, Input::angles,
        [](const double* x) { return from_half_difference(x[0], x[1], x[2], x[3]); }},
    AltaParametrization{"RUSIN_TH_TD_PD", 3, Input::angles,
                        [](const double* x) { return from_half_difference(x[0], 0, x[1], x[2]); }},
    AltaParametrization{
        "RUSIN_TH_TD", 2, Input::angles,
        [](const double* x) { return from_half_difference(x[0], 0, x[1], std::numbers::pi / 2); }},
    AltaParametrization{"COS_TH_TD", 2, Input::cosines, [](const double* x) {
                          return from_half_difference(std::acos(x[0]), 0, std::acos(x[1]), 0);
                        }}};

constexpr std::array<std::string_view, 3> kEnds{"ALTA END HEADER", "ALTA HEADER END",
                                                "ALTA_END_HEADER"};
constexpr std::string_view kCosine = "INV_STERADIAN_COSINE_FACTOR";

constexpr std::array<std::string_view, 3> kOutputs{"INV_STERADIAN", kCosine, "RGB_COLOR"};

/// "A, B or C"
template <class Names>
std::string one_of(const Names& names) {
  return fmt::format("{} or {}", fmt::join(names.begin(), names.end() - 1, ", "), names.back());
}
std::string known_inputs() {
  std::array<std::string_view, kAltaParametrizations.size()> names;
  std::ranges::transform(kAltaParametrizations, names.begin(), &AltaParametrization::name);
  return one_of(names);
}

double byte_swapped(double x) {
  auto bytes = std::bit_cast<std::array<char, sizeof x>>(x);
  std::ranges::reverse(bytes);
  return std::bit_cast<double>(bytes);
}

class AltaReader {
 public:
  explicit AltaReader(InputFile& in)
      : path_(in.path()), text_(in.read_rest(std::uint64_t{1} << 29)), rest_(text_) {}

  Table table() {
    header();
    t_.format = "alta";
    if (n_out_ == 1)
      t_.channels = {"f"};
    else if (n_out_ == 3)
      t_.channels = {"r", "g", "b"};
    else
      for (std::size_t c = 1; c <= n_out_; ++c) t_.channels.push_back(fmt::format("{}", c));
    t_.values.resize(n_out_);
    if (binary_)
      stream();
    else
      lines();
    if (list_.theta_i_deg.empty()) fail("no samples", "at least one");
    t_.where = std::move(list_);
    if (cosine_)
      t_.notes.emplace_back("cosine",
                            fmt::format("divided by cos θ_o; {} values with cos θ_o below "
                                        "{} were not, and are masked",
                                        grazing_, least_cosine));
    return std::move(t_);
  }

 private:
  [[noreturn]] void fail(std::string_view found, const std::string& expected) const {
    throw bad_input(path_, fmt::format("line {}", line_), std::string(beginning(found, 100)),
                    expected);
  }

  bool next_line(std::string_view& line) {
    if (rest_.empty()) return false;
    ++line_;
    const auto end = std::min(rest_.find('\n'), rest_.size());
    line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    return true;
  }

  std::size_t number_in(std::string_view text, std::size_t least, std::size_t most) const {
    const auto n = number_from<std::size_t>(text);
    if (!n || *n < least || *n > most)
      fail(in_quotes(text), fmt::format("a whole number from {} to {}", least, most));
    return *n;
  }

  void header() {
    std::string_view line;
    // The end is known by its name: the first byte of a binary stream may be a '#'.
    while (rest_.starts_with('#') && next_line(line)) {
      line.remove_prefix(1);
      line = line.substr(0, line.find_last_not_of(blanks) + 1);
      if (std::ranges::find(kEnds, line) != kEnds.end()) break;
      if (line.starts_with("ALTA FUNC")) fail("a function of ALTA", "a table of ALTA");
      if (line.starts_with(' ')) continue;  // a comment
      const auto key = next_word(line);
      if (key == "BEGIN_STREAM") break;
      read_key(key, line);
    }
    if (!in_) fail("no #PARAM_IN", "one before the samples: " + known_inputs());
    if (!out_) fail("no #PARAM_OUT", "one before the samples: " + one_of(kOutputs));
    if (n_in_ != in_->size)
      fail(fmt::format("#DIM {} …", n_in_), fmt::format("{} for {}", in_->size, in_->name));
    if (binary_ && count_ == 0) fail("no #SAMPLE_COUNT", "one before #BEGIN_STREAM");
  }

  void read_key(std::string_view key, std::string_view value) {
    if (key == "DIM") {
      n_in_ = number_in(next_word(value), 1, 6);
      n_out_ = number_in(next_word(value), 1, most_channels);
    } else if (key == "PARAM_IN") {
      const auto name = next_word(value);
      const auto known = std::ranges::find(kAltaParametrizations, name, &AltaParametrization::name);
      if (known == kAltaParametrizations.end())
        fail(fmt::format("#PARAM_IN {}", name),
             "a parametrization of two directions: " + known_inputs());
      in_ = &*known;
    } else if (key == "PARAM_OUT") {
      const auto name = next_word(value);
      out_ = std::ranges::find(kOutputs, name) != kOutputs.end();
      cosine_ = name == kCosine;
      if (!out_) fail(fmt::format("#PARAM_OUT {}", name), one_of(kOutputs));
    } else if (key == "VS") {
      intervals_ = number_in(next_word(value), 0, 2);
    } else if (key == "FORMAT") {
      binary_ = next_word(value) == "binary";
    } else if (key == "SAMPLE_COUNT") {
      count_ = number_in(next_word(value), 1, most_values);
    } else if (key == "ENDIAN") {
      swapped_ = (next_word(value) == "big") == (std::endian::native == std::endian::little);
    } else if (key == "PRECISION" && next_word(value) != "ieee754-double") {
      fail("another #PRECISION", "ieee754-double");
    }
  }

  void lines() {
    std::vector<double> row;
    std::string_view line;
    while (next_line(line)) {
      row.clear();
      for (auto text = next_word(line); !text.empty() && text[0] != '#'; text = next_word(line)) {
        const auto v = number_from<double>(text);
        if (row.size() > 3 * n_out_ + n_in_ || !v)
          fail(in_quotes(text), fmt::format("{} numbers", n_in_ + n_out_));
        row.push_back(*v);
      }
      if (row.empty()) continue;
      // Files with intervals hold them for all outputs, for the first one only, or not at all.
      const std::size_t extra = row.size() - std::min(row.size(), n_in_ + n_out_);
      if (row.size() < n_in_ + n_out_ ||
          (extra != 0 && extra != intervals_ && extra != intervals_ * n_out_))
        fail(fmt::format("{} numbers", row.size()), fmt::format("{}", n_in_ + n_out_));
      add(row.data());
    }
  }

  void stream() {
    const std::size_t width = n_in_ + n_out_ * (1 + intervals_);
    if (rest_.size() / sizeof(double) / width < count_)
      fail(fmt::format("{} bytes after the header", rest_.size()),
           fmt::format("{} × {} doubles", count_, width));
    std::vector<double> row(width);
    for (std::size_t i = 0; i < count_; ++i) {
      std::copy_n(rest_.data() + i * width * sizeof(double), width * sizeof(double),
                  reinterpret_cast<char*>(row.data()));
      if (swapped_) std::ranges::transform(row, row.begin(), byte_swapped);
      add(row.data());
    }
  }

  void add(const double* row) {
    if ((list_.theta_i_deg.size() + 1) * (4 + n_out_) > most_values)
      fail("more samples", fmt::format("at most {} numbers", most_values));
    const double most = in_->input == Input::angles ? 2 * std::numbers::pi : 1.001;
    for (std::size_t k = 0; k < n_in_; ++k)
      if (!(std::abs(row[k]) <= most))
        fail(fmt::format("{}", row[k]),
             in_->input == Input::angles ? "an angle in radians" : "a cosine, at most 1");
    std::array<double, 6> input{};
    for (std::size_t k = 0; k < n_in_; ++k)
      input[k] = in_->input == Input::cosines ? std::clamp(row[k], -1.0, 1.0) : row[k];
    const auto [wi, wo] = in_->pair(input.data());
    for (const Direction& d : {wi, wo})
      if (!(std::abs(dot(d, d) - 1) < 0.01))
        fail(fmt::format("a vector of length {:.3g}", std::sqrt(dot(d, d))), "length 1");
    list_.theta_i_deg.push_back(theta_of(wi) / degree);
    list_.phi_i_deg.push_back(phi_of(wi) / degree);
    list_.theta_o_deg.push_back(theta_of(wo) / degree);
    list_.phi_o_deg.push_back(phi_of(wo) / degree);
    for (std::size_t c = 0; c < n_out_; ++c) t_.values[c].push_back(value(row[n_in_ + c], wo.z));
  }

  double value(double stored, double nov) {
    if (!cosine_) return stored;
    if (nov >= least_cosine) return stored / nov;
    grazing_ += nov > 0;
    return std::numeric_limits<double>::quiet_NaN();
  }

  std::string path_, text_;
  std::string_view rest_;
  std::size_t line_ = 0, n_in_ = 0, n_out_ = 0, intervals_ = 0, count_ = 0, grazing_ = 0;
  const AltaParametrization* in_ = nullptr;
  bool out_ = false, cosine_ = false, binary_ = false, swapped_ = false;
  DirectionList list_;
  Table t_;
};

}  // namespace

bool is_alta(std::string_view head) {
  while (head.starts_with('#')) {
    for (const std::string_view key : {"#DIM ", "#PARAM_IN", "#PARAM_OUT", "#ALTA"})
      if (head.starts_with(key)) return true;
    head.remove_prefix(std::min(head.find('\n'), head.size() - 1) + 1);
  }
  return false;
}

Table read_alta(InputFile& in) {
  return AltaReader(in).table();
}

}  // namespace gonio
