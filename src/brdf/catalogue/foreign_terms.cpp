#include "brdf/catalogue/foreign_terms.h"

#include <algorithm>
#include <array>
#include <deque>
#include <limits>
#include <memory>
#include <mutex>
#include <utility>

#include "base/error.h"
#include "brdf/catalogue/registry_parts.h"

#include <fmt/format.h>

namespace gonio {
namespace {

/// What a foreign term's entry points into.
struct Kept {
  std::string token;  ///< as it was named
  Role role;
  foreign::Function function;
  std::string id, title, formula, source;
  About about;
  std::vector<Parameter> parameters;
  std::size_t first = 0;    ///< its first term
  bool is_said = false;     ///< what was guessed of it
  std::uint64_t named = 0;  ///< when last
  std::shared_ptr<const void>
      hold{};  ///< none: it has given its place away, and its names are left
};

std::mutex foreign_mutex;
std::deque<Kept>& kept() {
  static std::deque<Kept> all;
  return all;
}
std::array<ForeignTerm, most_foreign_terms>& terms() {
  static std::array<ForeignTerm, most_foreign_terms> all{};
  return all;
}
std::uint64_t next_id() {
  static std::uint64_t last = 0;
  return ++last;
}

/// The function whose place this is; nullptr of none.
Kept* owner_of(std::size_t place) {
  const auto of = std::ranges::find_if(kept(), [&](const Kept& k) {
    const std::size_t first = k.first - catalogue_size();
    return k.hold && first <= place && place < first + k.function.programs.size();
  });
  return of == kept().end() ? nullptr : &*of;
}
/// The first of so many places in a row that are free.
std::optional<std::size_t> free_places(std::size_t count) {
  std::size_t free = 0;
  for (std::size_t place = 0; place < most_foreign_terms; ++place) {
    free = owner_of(place) ? 0 : free + 1;
    if (free == count) return place + 1 - count;
  }
  return {};
}
/// Frees the places of the function that was named longest ago and is not held.  \return  whether there is one
bool release_one() {
  Kept* oldest = nullptr;
  for (auto& k : kept())
    if (k.hold && k.hold.use_count() == 1 && (!oldest || k.named < oldest->named)) oldest = &k;
  if (!oldest) return false;
  for (std::size_t c = 0; c < oldest->function.programs.size(); ++c)
    terms()[oldest->first - catalogue_size() + c] = {};
  oldest->function.programs.clear();
  oldest->hold.reset();
  return true;
}

Role role_standing(foreign::Stands s) {
  switch (s) {
    case foreign::Stands::distribution:
      return Role::ndf;
    case foreign::Stands::masking:
      return Role::masking;
    case foreign::Stands::fresnel:
      return Role::fresnel;
    case foreign::Stands::lobe:
      break;
  }
  return Role::diffuse;
}
foreign::Stands stands_of(Role r) {
  switch (r) {
    case Role::ndf:
      return foreign::Stands::distribution;
    case Role::masking:
      return foreign::Stands::masking;
    case Role::fresnel:
      return foreign::Stands::fresnel;
    case Role::diffuse:
      break;
  }
  return foreign::Stands::lobe;
}

/// Parameters without bounds may be anything that is set, have no default, and are not fitted.
Parameter parameter_of(const foreign::FunctionParameter& p) {
  constexpr double most = 1e30, none = std::numeric_limits<double>::quiet_NaN();
  if (!p.bounded)
    return {p.name, {-most, most}, {-most, most}, none, p.per_channel, "no bounds were given"};
  return {p.name, p.range, p.range, p.start, p.per_channel, "of the file"};
}

foreign::Program all_channels(const foreign::Function& f) {
  std::vector<const foreign::Program*> of;
  for (std::size_t c = 0; c < 3; ++c) of.push_back(&f.programs[f.programs.size() == 3 ? c : 0]);
  return foreign::merged(of, [&](std::size_t c, std::size_t k) {
    return k + (f.parameters[k].per_channel ? c * foreign_stride : 0);
  });
}

void describe(Kept& k) {
  const auto& f = k.function;
  k.id = fmt::format("{}.{}", name_of(k.role), k.token);
  k.title = fmt::format("{} of {}", f.name.function, f.name.file);
  k.formula = f.includes == "nothing" || f.includes == "v"
                  ? "as the file computes it"
                  : fmt::format("as the file computes it, {} taken out", f.includes);
  k.source = fmt::format("{}, line {}, SHA-256 {}", f.name.file, f.line, f.sha256.substr(0, 12));
  k.about = {.id = k.id, .title = k.title, .formula = k.formula, .source = k.source};
  for (const auto& p : f.parameters) k.parameters.push_back(parameter_of(p));
}

}  // namespace

const ForeignTerm* foreign_term(std::size_t term) {
  return term < catalogue_size() ? nullptr : &terms()[term - catalogue_size()];
}

std::shared_ptr<const void> hold_foreign(std::size_t term) {
  if (term < catalogue_size()) return nullptr;
  const std::lock_guard lock(foreign_mutex);
  const auto* owner = owner_of(term - catalogue_size());
  return owner ? owner->hold : nullptr;
}

std::size_t term_of_channel(std::size_t term, std::size_t channel) {
  const auto* f = foreign_term(term);
  return f && f->function->programs.size() == 3 ? term + channel % 3 : term;
}

bool is_foreign(std::string_view name) {
  return foreign::is_name(name);
}

std::vector<std::string> take_foreign_guesses() {
  const std::lock_guard lock(foreign_mutex);
  std::vector<std::string> all;
  for (auto& k : kept()) {
    const auto& f = k.function;
    if (std::exchange(k.is_said, true)) continue;
    if (!f.guessed || (!f.unclear && (f.includes == "nothing" || f.includes == "v"))) continue;
    all.push_back(
        f.unclear
            ? fmt::format("{}: not clear whether its value includes π; taken to include {}. Say "
                          "--includes pi or nothing",
                          k.token, f.includes)
            : fmt::format("{}: guessed to include {}, which is taken out; --includes says it",
                          k.token,
                          f.includes == "pi"          ? "π"
                          : f.includes == "cosine,pi" ? "the cosine NoL and π"
                          : f.includes == "cosine"    ? "the cosine NoL"
                                                      : "4 NoL NoV, as G does"));
  }
  return all;
}

std::size_t foreign_term_named(std::string_view name, std::optional<Role> role) {
  for (const auto prefix : names_of<Role>)
    if (name.starts_with(std::string(prefix) + ".") && is_foreign(name.substr(prefix.size() + 1))) {
      role = value_of<Role>(prefix, "role");
      name.remove_prefix(prefix.size() + 1);
      break;
    }
  const std::lock_guard lock(foreign_mutex);
  for (auto& k : kept())
    if (k.hold && k.token == name && (!role || *role == k.role)) {
      k.named = next_id();
      return k.first;
    }
  std::optional<foreign::Stands> stands;
  if (role) stands = stands_of(*role);
  Kept k{std::string(name),
         {},
         foreign::read_function(foreign::parse_name(name), stands),
         {},
         {},
         {},
         {},
         {},
         {}};
  k.role = role_standing(k.function.stands);
  if (role == Role::diffuse && !k.function.name.reading.includes)
    if (const auto alone = foreign::read_function(k.function.name).stands;
        alone == foreign::Stands::distribution || alone == foreign::Stands::fresnel)
      throw wrong_usage(fmt::format(
          "{} is no whole model: it reads {}, as a {} does; in a model it stands in its "
          "place, as in {}",
          name, alone == foreign::Stands::distribution ? "NoH" : "VoH", name_of(alone),
          alone == foreign::Stands::distribution
              ? std::string(name) + "/smith_ggx.correlated/schlick"
              : "ggx/smith_ggx.correlated/" + std::string(name)));
  const bool is_colour =
      k.function.programs.size() > 1 ||
      std::ranges::any_of(k.function.parameters, &foreign::FunctionParameter::per_channel);
  if (is_colour && (k.role == Role::ndf || k.role == Role::masking))
    throw wrong_usage(fmt::format("{} gives a colour, where a {} gives one number", name,
                                  k.role == Role::ndf ? "distribution" : "masking term"));
  auto place = free_places(k.function.programs.size());
  while (!place && release_one()) place = free_places(k.function.programs.size());
  if (!place)
    throw wrong_usage(fmt::format("{}: more than {} functions of files are in use at once", name,
                                  most_foreign_terms));
  describe(k);
  k.first = catalogue_size() + *place;
  k.named = next_id();
  k.hold = std::make_shared<int>();
  auto& owned = kept().emplace_back(std::move(k));
  // The strings moved: what points to them is made again.
  owned.about = {
      .id = owned.id, .title = owned.title, .formula = owned.formula, .source = owned.source};
  for (std::size_t i = 0; i < owned.parameters.size(); ++i)
    owned.parameters[i].name = owned.function.parameters[i].name;
  const auto& f = owned.function;
  for (std::size_t c = 0; c < f.programs.size(); ++c) {
    terms()[*place + c] = {
        &f,
        c,
        foreign::with_derivatives(f.programs[c], f.parameters.size(), f.anisotropic),
        c == 0 ? all_channels(f) : foreign::Program(),
        f.parameters.size(),
        next_id()};
    set_term(owned.first + c, {&owned.about, owned.parameters, false, f.anisotropic, true, false});
  }
  return owned.first;
}

}  // namespace gonio
