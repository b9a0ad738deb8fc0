#include "table/format/ssdd.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "base/blanks.h"
#include "base/error.h"
#include "base/numbers.h"
#include "base/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio {
namespace {

static_assert(std::endian::native == std::endian::little, "the numbers are little-endian");

constexpr std::string_view kFirst = "VERSION", kType = "DATA_TYPE";
constexpr std::array<std::string_view, 5> kLists{"PARAM0_LIST", "PARAM1_LIST", "PARAM2_LIST",
                                                 "PARAM3_LIST", "PARAM4_LIST"};
constexpr std::array<std::string_view, 5> kNotes{"NAME", "SOURCE_TYPE", "DEVICE", "CREATION_DATE",
                                                 "MEASUREMENT_DATE"};

using Angles4 = std::array<double, 4>;  ///< PARAM0 to PARAM3 [rad]

DirectionPair spherical(const Angles4& a, double) {
  return {direction(a[0], a[1]), direction(a[2], a[3])};
}
DirectionPair specular(const Angles4& a, double offset) {
  const Direction s = direction(a[2], a[3]);
  const SinCos theta(a[0] + offset), phi(a[1]);
  const double x = s.x * theta.cos - s.z * theta.sin;
  return {direction(a[0], a[1]),
          {x * phi.cos - s.y * phi.sin, x * phi.sin + s.y * phi.cos,
           s.x * theta.sin + s.z * theta.cos}};
}
DirectionPair by_half_vector(const Angles4& a, double) {
  return directions(HalfDifference{a[0], a[1], a[2], a[3]});
}

struct SsddParametrization {
  std::string_view name;
  double most_2;          ///< of PARAM2_LIST [degrees]
  bool first_has_a_pole;  ///< PARAM1 is no matter where PARAM0 is 0
  DirectionPair (*pair)(const Angles4&, double offset);
};
constexpr std::array kSsddParametrizations{
    SsddParametrization{"spherical_coordinate_system", 90, true, spherical},
    SsddParametrization{"specular_coordinate_system", 180, false, specular},
    SsddParametrization{"half_difference_coordinate_system", 90, false, by_half_vector}};

/// What stands between DATA_TYPE and DATA.
struct Block {
  std::string type, colour, parametrization;
  std::array<std::vector<double>, kLists.size()> lists;  ///< [degrees]
  std::vector<std::string> wavelengths;
  std::vector<std::pair<std::string, std::string>> notes;

  std::vector<std::string> channels() const {
    if (colour == "rgb") return {"r", "g", "b"};
    if (colour == "xyz") return {"x", "y", "z"};
    if (colour == "spectrum") return wavelengths;
    return {"f"};
  }
};

class SsddReader {
 public:
  explicit SsddReader(InputFile& in)
      : path_(in.path()), text_(in.read_rest(std::uint64_t{1} << 29)), rest_(text_) {}

  Table table() {
    for (std::string_view line; next_line(line);) {
      const auto key = next_word(line);
      if (first_) {
        if (key != kFirst || !line_has_version(line)) fail(key, "VERSION 0 and a minor one");
        first_ = false;
      } else if (key == kType) {
        block_ = Block{};
        block_.type = next_word(line);
        in_block_ = true;
        expect_few(others_.size(), "blocks");
      } else if (in_block_) {
        read_key(key, line);
      }
    }
    if (t_.values.empty()) fail("no DATA of DATA_TYPE brdf", "one");
    if (!others_.empty())
      t_.notes.emplace_back("left out", fmt::format("{}", fmt::join(others_, ", ")));
    return std::move(t_);
  }

 private:
  [[noreturn]] void fail(std::string_view found, const std::string& expected) const {
    throw bad_input(path_, fmt::format("line {}", line_), std::string(beginning(found, 100)),
                    expected);
  }
  static bool line_has_version(std::string_view line) {
    const auto version = next_word(line);
    return version == "0" || version.starts_with("0.");
  }
  /// Next line that says something.
  bool next_line(std::string_view& line) {
    while (!rest_.empty()) {
      ++line_;
      const auto end = std::min(rest_.find('\n'), rest_.size());
      line = trimmed(rest_.substr(0, end));
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      if (!line.empty() && line[0] != '#') return true;
    }
    return false;
  }
  static std::string_view without_comment(std::string_view line) {
    return line.substr(0, line.find('#'));
  }

  void read_key(std::string_view key, std::string_view value) {
    if (key == "DATA") return read_data(next_word(value));
    if (key == "COLOR_MODEL") {
      block_.colour = next_word(value);
      constexpr std::array<std::string_view, 4> known{"monochrome", "rgb", "xyz", "spectrum"};
      if (std::ranges::find(known, block_.colour) == known.end())
        fail(block_.colour, fmt::format("{}", fmt::join(known, ", ")));
    } else if (key == "WAVELENGTH_LIST") {
      block_.wavelengths.clear();
      for (const double nm : numbers(value, 0, 1e9, most_channels))
        block_.wavelengths.push_back(fmt::format("{:.6g}", nm));
      auto sorted = block_.wavelengths;
      std::ranges::sort(sorted);
      if (std::ranges::adjacent_find(sorted) != sorted.end())
        fail("a wavelength twice", "each once");
    } else if (key == "PARAM_TYPE") {
      block_.parametrization = next_word(value);
    } else if (key == "REDUCTION_TYPE") {
      add_note("reduction", value);
    } else if (const auto list = std::ranges::find(kLists, key); list != kLists.end()) {
      const auto k = static_cast<std::size_t>(list - kLists.begin());
      constexpr std::array<double, kLists.size()> least{0, 0, 0, 0, -90},
          most{90, 360, 180, 360, 90};
      block_.lists[k] = numbers(value, least[k], most[k], std::size_t{1} << 20);
      if (k < 4 && !std::ranges::is_sorted(block_.lists[k], std::less_equal<>{}))
        fail("angles out of order", "ascending ones");
    } else if (std::ranges::find(kNotes, key) != kNotes.end()) {
      add_note(key, value);
    }
  }
  /// A line may be short, and what is kept of it is not.
  void expect_few(std::size_t n, const char* what) const {
    constexpr std::size_t most = 1000;
    if (n >= most) fail(fmt::format("more {}", what), fmt::format("at most {}", most));
  }
  void add_note(std::string_view key, std::string_view value) {
    expect_few(block_.notes.size(), "notes");
    block_.notes.emplace_back(key, trimmed(value));
  }

  std::vector<double> numbers(std::string_view value,
                              double least,
                              double most,
                              std::size_t most_numbers) const {
    std::vector<double> all;
    value = without_comment(value);
    for (auto field = next_word(value); !field.empty(); field = next_word(value)) {
      const auto v = number_from<double>(field);
      if (all.size() == most_numbers) fail("more numbers", fmt::format("at most {}", most_numbers));
      if (!v || !(*v >= least && *v <= most))
        fail(in_quotes(field), fmt::format("a number from {} to {}", least, most));
      all.push_back(*v);
    }
    if (all.empty()) fail("an empty list", "one number at least");
    return all;
  }

  void read_data(std::string_view mode) {
    in_block_ = false;
    if (mode != "ascii" && mode != "binary") fail(mode, "ascii or binary");
    if (block_.colour.empty()) fail("no COLOR_MODEL", "one before DATA");
    if (block_.lists[0].empty()) fail("no PARAM0_LIST", "one before DATA");
    const auto channels = block_.channels();
    if (channels.empty()) fail("no WAVELENGTH_LIST", "one, as COLOR_MODEL is spectrum");
    const bool wanted = block_.type == "brdf", four = wanted || block_.type == "btdf";
    if (block_.lists[1].empty()) block_.lists[1] = {0};
    std::size_t count = 1;
    for (std::size_t k = 0; k < 4; ++k) {
      if (four && block_.lists[k].empty()) fail(fmt::format("no {}", kLists[k]), "one before DATA");
      const std::size_t size = four || k < 2 ? block_.lists[k].size() : 1;
      if (size > most_values / (4 + channels.size()) / count)
        fail(fmt::format("{} × {} or more samples", count, size),
             fmt::format("at most {} numbers, directions included", most_values));
      count *= size;
    }
    // A number is four bytes, or a digit and what ends it, though not at the end of the file.
    const std::size_t there =
        mode == "binary" ? rest_.size() / sizeof(float) : rest_.size() / 2 + 1;
    if (there / channels.size() < count)
      fail(fmt::format("{} bytes after DATA", rest_.size()),
           fmt::format("{} × {} numbers", count, channels.size()));
    if (!wanted) {
      others_.push_back(block_.type);
      const auto nothing = [](std::size_t, std::size_t, double) {};
      return mode == "ascii" ? lines(count, channels.size(), nothing)
                             : stream(count, channels.size(), nothing);
    }
    if (!t_.values.empty()) fail("DATA_TYPE brdf twice", "one");
    t_.format = "ssdd";
    t_.channels = channels;
    t_.notes = block_.notes;
    const auto kept = directions(count);
    t_.values.resize(channels.size());
    const auto add = [&](std::size_t i, std::size_t c, double v) {
      if (kept[i]) t_.values[c].push_back(v);
    };
    if (mode == "ascii")
      lines(count, channels.size(), add);
    else
      stream(count, channels.size(), add);
  }

  /// Directions of the block's samples, those of a direction's first name.  \return which these are
  std::vector<bool> directions(std::size_t count) {
    const auto p = std::ranges::find(kSsddParametrizations, block_.parametrization,
                                     &SsddParametrization::name);
    if (p == kSsddParametrizations.end()) {
      std::array<std::string_view, kSsddParametrizations.size()> names;
      std::ranges::transform(kSsddParametrizations, names.begin(), &SsddParametrization::name);
      fail(fmt::format("PARAM_TYPE {}", block_.parametrization),
           fmt::format("{}", fmt::join(names, ", ")));
    }
    const auto& l = block_.lists;
    if (l[2].back() > p->most_2)
      fail(fmt::format("PARAM2_LIST {}", l[2].back()), fmt::format("at most {}", p->most_2));
    if (!l[4].empty() && l[4].size() != l[0].size())
      fail(fmt::format("{} numbers in PARAM4_LIST", l[4].size()),
           fmt::format("{}, as in PARAM0_LIST", l[0].size()));
    const auto again = [](const std::vector<double>& azimuths, std::size_t i) {
      return i > 0 && i + 1 == azimuths.size() && azimuths[i] - azimuths[0] == 360;
    };
    DirectionList list;
    std::vector<bool> kept(count);
    std::size_t i = 0;
    for (std::size_t d = 0; d < l[3].size(); ++d)
      for (std::size_t c = 0; c < l[2].size(); ++c)
        for (std::size_t b = 0; b < l[1].size(); ++b)
          for (std::size_t a = 0; a < l[0].size(); ++a, ++i) {
            const bool pole = l[2][c] == 0 || l[2][c] == 180;
            kept[i] = !(again(l[1], b) || again(l[3], d) || (pole && d > 0) ||
                        (p->first_has_a_pole && l[0][a] == 0 && b > 0));
            if (!kept[i]) continue;
            const auto [wi, wo] =
                p->pair({l[0][a] * degree, l[1][b] * degree, l[2][c] * degree, l[3][d] * degree},
                        l[4].empty() ? 0 : l[4][a] * degree);
            list.theta_i_deg.push_back(theta_of(wi) / degree);
            list.phi_i_deg.push_back(phi_of(wi) / degree);
            list.theta_o_deg.push_back(theta_of(wo) / degree);
            list.phi_o_deg.push_back(phi_of(wo) / degree);
          }
    t_.where = std::move(list);
    return kept;
  }

  template <class Add>
  void lines(std::size_t count, std::size_t channels, const Add& add) {
    std::string_view line;
    for (std::size_t i = 0; i < count; ++i) {
      if (!next_line(line))
        fail(fmt::format("{} colours", i), fmt::format("{}, one a line", count));
      line = without_comment(line);
      std::size_t c = 0;
      for (auto field = next_word(line); !field.empty(); field = next_word(line)) {
        const auto v = number_from<double>(field);
        if (!v || c == channels) fail(in_quotes(field), fmt::format("{} numbers", channels));
        add(i, c++, *v);
      }
      if (c != channels) fail(fmt::format("{} numbers", c), fmt::format("{}", channels));
    }
  }

  template <class Add>
  void stream(std::size_t count, std::size_t channels, const Add& add) {
    for (std::size_t k = 0; k < count * channels; ++k) {
      float v = 0;
      std::memcpy(&v, rest_.data() + k * sizeof v, sizeof v);
      add(k / channels, k % channels, static_cast<double>(v));
    }
    rest_.remove_prefix(count * channels * sizeof(float));
  }

  std::string path_, text_;
  std::string_view rest_;
  std::size_t line_ = 0;
  bool first_ = true, in_block_ = false;
  Block block_;
  std::vector<std::string> others_;
  Table t_;
};

}  // namespace

bool is_ssdd(std::string_view head) {
  while (head.starts_with('#') || head.starts_with('\n') || head.starts_with("\r\n"))
    head.remove_prefix(std::min(head.find('\n'), head.size() - 1) + 1);
  return head.starts_with(kFirst) && head.find(kType) != head.npos;
}

Table read_ssdd(InputFile& in) {
  return SsddReader(in).table();
}

}  // namespace gonio
