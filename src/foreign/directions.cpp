#include "foreign/directions.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>

#include "base/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gonio::foreign {

std::string plain(std::string_view name) {
  std::string s;
  for (const char c : name)
    if (c != '_') s += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return s;
}

namespace {

/// What a vector of that name stands for; empty where it is none of the usual ones.  lightDirectionWS is as light.
std::string vector_of(std::string s) {
  static const std::map<std::string, std::string_view> all{
      {"n", "N"},       {"normal", "N"},  {"nrm", "N"},  {"l", "L"},       {"light", "L"},
      {"wi", "L"},      {"v", "V"},       {"view", "V"}, {"eye", "V"},     {"camera", "V"},
      {"wo", "V"},      {"h", "H"},       {"half", "H"}, {"halfway", "H"}, {"x", "X"},
      {"t", "X"},       {"tangent", "X"}, {"y", "Y"},    {"b", "Y"},       {"bitangent", "Y"},
      {"binormal", "Y"}};
  for (const std::string_view space : {"ws", "vs", "ts", "os"})
    if (s.size() > 2 && s.ends_with(space)) s.resize(s.size() - space.size());
  for (const std::string_view kind : {"direction", "vector", "dir", "vec"})
    if (s.size() > kind.size() && s.ends_with(kind)) s.resize(s.size() - kind.size());
  for (const std::string_view before : {"world", "surface", "to"})
    if (s.size() > before.size() && s.starts_with(before)) s.erase(0, before.size());
  const auto known = all.find(s);
  return known == all.end() ? "" : std::string(known->second);
}

/// What --argument says of a parameter that no name says: how it enters a model.
constexpr std::array<std::string_view, 8> roles{"f0",        "alpha",     "roughness", "smoothness",
                                                "shininess", "basecolor", "metallic",  "eta"};

/// The usual name of a cosine between two of n l v h t b, however it is written; empty where it is none.
std::string cosine_of(const std::string& s) {
  if (s == "costheta" || s == "cosine" || s == "costhetad") return "voh";
  if (s == "costhetai" || s == "costhetal") return "nol";
  if (s == "costhetao" || s == "costhetav") return "nov";
  if (s == "costhetah" || s == "costhetam" || s == "cosh") return "noh";
  if (s == "sin2thetah" || s == "sinthetah2") return "sin2_theta_h";
  std::string pair = s;
  for (const char* between : {"dot", "o"})
    if (const auto at = s.find(between);
        at == 1 && s.size() == std::string_view(between).size() + 2)
      pair = {s.front(), s.back()};
  if (s.size() == 5 && s.starts_with("dot")) pair = s.substr(3);
  if (pair.size() != 2 ||
      (s.size() == 2 && s != "nl" && s != "nv" && s != "nh" && s != "vh" && s != "lh" && s != "lv"))
    return "";
  for (char& c : pair) c = c == 't' ? 'x' : c == 'b' ? 'y' : c;
  static const std::map<std::string, std::string> known{
      {"nl", "nol"}, {"nv", "nov"}, {"nh", "noh"}, {"vh", "voh"}, {"lh", "voh"}, {"lv", "lov"},
      {"xh", "xoh"}, {"yh", "yoh"}, {"xl", "xol"}, {"yl", "yol"}, {"xv", "xov"}, {"yv", "yov"}};
  for (const auto& p : {pair, std::string(pair.rbegin(), pair.rend())})
    if (const auto k = known.find(p); k != known.end()) return k->second;
  return "";
}

}  // namespace

std::string direction_of(const std::string& name, std::size_t size, const Reading& reading) {
  const auto given = reading.arguments.find(name);
  const std::string s = plain(given == reading.arguments.end() ? name : given->second);
  std::string found;
  if (size == 3)
    found = vector_of(s);
  else if (size == 1)
    found = cosine_of(s);
  const bool is_role = s == "parameter" || std::ranges::find(roles, s) != roles.end();
  if (given != reading.arguments.end() && found.empty() && !is_role)
    throw wrong_usage(fmt::format(
        "argument {}={}: expected {}; or of a parameter its role: {}", name, given->second,
        size == 3 ? "N, L, V, H, X or Y" : "nol, nov, noh, voh, lov, sin2_theta_h, xoh …",
        fmt::join(roles, ", ")));
  return found;
}

std::size_t angle(std::string_view name) {
  return static_cast<std::size_t>(std::ranges::find(angle_names, name) - angle_names.begin());
}

std::vector<Ref> coordinates(Program& p, char direction) {
  const auto in = [&](std::string_view n) { return p.input(true, angle(n)); };
  switch (direction) {
    case 'N':
      return {p.frame_zero(), p.frame_zero(), p.constant(1)};
    case 'X':
      return {p.constant(1), p.frame_zero(), p.frame_zero()};
    case 'Y':
      return {p.frame_zero(), p.constant(1), p.frame_zero()};
    case 'L':
      return {in("xol"), in("yol"), in("nol")};
    case 'V':
      return {in("xov"), in("yov"), in("nov")};
    default:
      return {in("xoh"), in("yoh"), in("noh")};
  }
}

std::vector<Ref> from_half(Program& p, char direction) {
  if (direction != 'L' && direction != 'V')
    return coordinates(p, direction == 'H' ? 'N' : direction);
  const Ref c = p.input(true, angle("voh")), zero = p.constant(0), one = p.constant(1);
  const Ref s = p(Op::sqrt, p(Op::max, zero, p(Op::sub, one, p(Op::mul, c, c))));
  return {direction == 'V' ? s : p(Op::neg, s), p.frame_zero(), c};
}

Ref cosine(Program& p, const std::string& name) {
  if (name != "lov") return p.input(true, angle(name));
  const auto l = coordinates(p, 'L'), v = coordinates(p, 'V');
  Ref s = p(Op::mul, l[0], v[0]);
  for (std::size_t k = 1; k < 3; ++k) s = p(Op::add, s, p(Op::mul, l[k], v[k]));
  return s;
}

}  // namespace gonio::foreign
