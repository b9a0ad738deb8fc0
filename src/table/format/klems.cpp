#include "table/format/klems.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <numbers>

#include "base/blanks.h"
#include "base/error.h"
#include "base/numbers.h"
#include "base/text.h"
#include "table/format/tensor_tree.h"

#include <fmt/format.h>
#include <pugixml.hpp>

namespace gonio {
namespace {

using std::numbers::pi;

/// A ring of patches.
struct Ring {
  double low, high;  ///< θ [degrees]
  std::size_t patches;
  std::size_t first;  ///< index of its first patch
};

class Basis {
 public:
  std::vector<Ring> rings;

  std::size_t size() const { return rings.empty() ? 0 : rings.back().first + rings.back().patches; }
  /// Side of a square of the patches' mean solid angle [degrees].
  double side_deg() const {
    const double covered = 2 * pi * (1 - std::cos(rings.back().high * degree));
    return std::sqrt(covered / static_cast<double>(size())) / degree;
  }
  struct Centre {
    double theta_deg, phi_deg;
  };
  std::vector<Centre> centres() const {
    std::vector<Centre> all;
    for (const Ring& r : rings)
      for (std::size_t k = 0; k < r.patches; ++k)
        all.push_back({r.patches == 1 && r.low == 0 ? 0 : (r.low + r.high) / 2,
                       360.0 * static_cast<double>(k) / static_cast<double>(r.patches)});
    return all;
  }
  /// ∫ cos θ dω of each patch.
  std::vector<double> projected() const {
    std::vector<double> all;
    for (const Ring& r : rings)
      all.insert(
          all.end(), r.patches,
          pi * (std::pow(std::sin(r.high * degree), 2) - std::pow(std::sin(r.low * degree), 2)) /
              static_cast<double>(r.patches));
    return all;
  }
  /// The patch of a direction; size() beyond the last ring.  \param phi  [rad]
  std::size_t patch(double theta, double phi) const {
    const auto r =
        std::ranges::find_if(rings, [&](const Ring& x) { return theta / degree < x.high; });
    if (r == rings.end()) return size();
    const auto n = static_cast<double>(r->patches);
    const double k = std::floor(phi / (2 * pi) * n + 0.5);
    return r->first + static_cast<std::size_t>(k - n * std::floor(k / n));
  }
};

constexpr std::size_t kMostPatches = 2048;
constexpr std::ptrdiff_t kMostTags = 1 << 17;

/// The document with the words for errors in it.
class KlemsReader {
 public:
  explicit KlemsReader(InputFile& in)
      : path_(in.path()), text_(in.read_rest(std::uint64_t{1} << 25)) {
    // A tag, with the text behind it, or an attribute takes up to 28 times its bytes: few of each
    // are 25 MB.
    for (const char c : {'<', '='})
      if (const auto n = std::ranges::count(text_, c); n > kMostTags)
        fail("document", fmt::format("'{}' {} times", c, n), fmt::format("at most {}", kMostTags));
    const auto parsed = document_.load_buffer_inplace(text_.data(), text_.size());
    if (!parsed)
      fail(fmt::format("byte {}", parsed.offset), parsed.description(), "well-formed XML");
  }

  Table table() {
    const auto layer = child(child(child(document_, "WindowElement"), "Optical"), "Layer");
    const auto definition = child(layer, "DataDefinition");
    const std::string structure = text(child(definition, "IncidentDataStructure"));
    const auto [block, band, direction] = choose(layer);
    if (structure == "TensorTree3" || structure == "TensorTree4") {
      Table t = tensor_tree_table(path_, child(block, "ScatteringData").text().get(),
                                  structure.back() == '3' ? 3 : 4, direction == kBack);
      t.notes = {{"wavelength", band}, {"direction", direction}};
      return t;
    }
    if (structure != "Columns" && structure != "Rows")
      fail("IncidentDataStructure", structure,
           "Columns or Rows: a matrix over Klems' patches; or TensorTree3 or 4");
    const bool columns = structure == "Columns";
    const Basis of_columns = basis(definition, text(child(block, "ColumnAngleBasis"))),
                of_rows = basis(definition, text(child(block, "RowAngleBasis")));
    const auto matrix = numbers(child(block, "ScatteringData"), of_rows.size() * of_columns.size());

    Table t;
    t.format = "klems";
    t.channels = {"f"};
    t.notes = {{"wavelength", band}, {"direction", direction}};
    const Basis &in = columns ? of_columns : of_rows, &out = columns ? of_rows : of_columns;
    // Seen from the back, turned about x, azimuths run the other way.
    const double turn = direction == kBack ? -1 : 1;
    DirectionList l;
    auto values = std::make_shared<std::vector<double>>();  // [incident][outgoing]
    const auto around = [](double deg) { return deg - 360 * std::floor(deg / 360); };
    std::size_t i = 0;
    for (const auto& wi : in.centres()) {
      std::size_t o = 0;
      const auto patches = out.projected();
      t.patches.insert(t.patches.end(), patches.begin(), patches.end());
      for (const auto& wo : out.centres()) {
        l.theta_i_deg.push_back(wi.theta_deg);
        l.phi_i_deg.push_back(around(turn * (wi.phi_deg + 180)));
        l.theta_o_deg.push_back(wo.theta_deg);
        l.phi_o_deg.push_back(around(turn * wo.phi_deg));
        values->push_back(columns ? matrix[o * in.size() + i] : matrix[i * out.size() + o]);
        ++o;
      }
      ++i;
    }
    t.where = std::move(l);
    t.values.emplace_back(values->begin(), values->end());
    t.patch_deg = std::max(in.side_deg(), out.side_deg());
    t.between = [values, in, out, turn](const DirectionPair& p, std::size_t) {
      const std::size_t from = in.patch(theta_of(p.wi), turn * phi_of(p.wi) - pi),
                        to = out.patch(theta_of(p.wo), turn * phi_of(p.wo));
      if (from == in.size() || to == out.size()) return std::nan("");
      return (*values)[from * out.size() + to];
    };
    return t;
  }

 private:
  static constexpr const char *kFront = "Reflection Front", *kBack = "Reflection Back";

  [[noreturn]] void fail(const std::string& place,
                         const std::string& found,
                         const std::string& expected) const {
    throw bad_input(path_, place, found, expected);
  }

  pugi::xml_node child(const pugi::xml_node& of, const char* name) const {
    const auto found = of.child(name);
    if (!found) fail(*of.name() ? of.name() : "document", fmt::format("no {}", name), "one");
    return found;
  }

  static std::string text(const pugi::xml_node& node) {
    const std::string_view all = node.text().get();
    const auto from = all.find_first_not_of(" \t\r\n");
    if (from == all.npos) return "";
    return std::string(all.substr(from, all.find_last_not_of(" \t\r\n") - from + 1));
  }

  double number(const pugi::xml_node& node, double least, double most) const {
    const std::string s = text(node);
    const auto v = number_from<double>(s);
    if (!v || !(*v >= least && *v <= most))
      fail(node.name(), in_quotes(s), fmt::format("a number in [{}, {}]", least, most));
    return *v;
  }

  struct Choice {
    pugi::xml_node block;
    std::string band, direction;
  };
  Choice choose(const pugi::xml_node& layer) const {
    std::vector<Choice> found;
    for (const auto& data : layer.children("WavelengthData"))
      for (const auto& block : data.children("WavelengthDataBlock"))
        found.push_back(
            {block, text(data.child("Wavelength")), text(block.child("WavelengthDataDirection"))});
    for (const char* direction : {kFront, kBack})
      for (const bool visible : {true, false})
        for (const Choice& c : found)
          if (c.direction == direction && (c.band == "Visible" || !visible)) return c;
    fail("Layer", found.empty() ? "no WavelengthDataBlock" : "only directions of transmission",
         fmt::format("{} or {}", kFront, kBack));
  }

  Basis basis(const pugi::xml_node& definition, const std::string& name) const {
    for (const auto& node : definition.children("AngleBasis")) {
      if (text(node.child("AngleBasisName")) != name) continue;
      Basis b;
      for (const auto& block : node.children("AngleBasisBlock")) {
        const auto bounds = child(block, "ThetaBounds");
        const double low = number(child(bounds, "LowerTheta"), 0, 90),
                     high = number(child(bounds, "UpperTheta"), 0, 90),
                     start = b.rings.empty() ? 0 : b.rings.back().high;
        if (!(std::abs(low - start) < 1e-3 && high > low))
          fail("ThetaBounds", fmt::format("{} to {}", low, high),
               fmt::format("a ring from {}", start));
        const double patches = number(child(block, "nPhis"), 1, 360);
        if (patches != std::floor(patches))
          fail("nPhis", fmt::format("{}", patches), "a whole number");
        b.rings.push_back({low, high, static_cast<std::size_t>(patches), b.size()});
        if (b.size() > kMostPatches)
          fail("AngleBasis", "more patches", fmt::format("at most {}", kMostPatches));
      }
      if (b.rings.empty()) fail("AngleBasis", "no AngleBasisBlock", "one for each ring of theta");
      return b;
    }
    fail("DataDefinition", fmt::format("no AngleBasis named '{}'", name), "the one that data use");
  }

  std::vector<double> numbers(const pugi::xml_node& node, std::size_t count) const {
    constexpr std::string_view between = ", \t\r\n";
    std::vector<double> all;
    std::string_view rest = node.text().get();
    for (;;) {
      rest.remove_prefix(std::min(rest.find_first_not_of(between), rest.size()));
      if (rest.empty()) break;
      const auto field = rest.substr(0, rest.find_first_of(between));
      const auto v = number_from<double>(field);
      const auto place = fmt::format("{}, number {}", node.name(), all.size() + 1);
      if (!v) fail(place, in_quotes(field), "a number");
      if (all.size() == count) fail(place, "one more", fmt::format("{} numbers", count));
      all.push_back(*v);
      rest.remove_prefix(field.size());
    }
    if (all.size() != count)
      fail(node.name(), fmt::format("{} numbers", all.size()), fmt::format("{}", count));
    return all;
  }

  std::string path_, text_;
  pugi::xml_document document_;
};

}  // namespace

bool is_klems(std::string_view head) {
  head = without_mark(head);
  head.remove_prefix(std::min(head.find_first_not_of(" \t\r\n"), head.size()));
  return head.starts_with("<") && head.find("<WindowElement") != head.npos;
}

Table read_klems(InputFile& in) {
  return KlemsReader(in).table();
}

}  // namespace gonio
