#include "table/format/column_map.h"

#include <algorithm>

#include "table/format/delimited.h"

namespace gonio {

bool is_role(std::string_view name) {
  return std::ranges::find(angle_roles, name) != angle_roles.end() || name == "f" ||
         name == "weight" || name == "channel" || (name.starts_with("f_") && name.size() > 2) ||
         uncertainty_role(name);
}

std::optional<UncertaintyRole> uncertainty_role(std::string_view role) {
  if (!role.starts_with("u_") && !role.starts_with("U_")) return {};
  const double standard = role[0] == 'U' ? 0.5 : 1;  // metrology's U is expanded by k = 2
  role.remove_prefix(2);
  for (const auto& [kind, unit] :
       {std::pair<std::string_view, double>("f", 1), {"rel", 1}, {"percent", 0.01}}) {
    if (!role.starts_with(kind)) continue;
    const auto rest = role.substr(kind.size());
    if (rest.empty() || (rest[0] == '_' && rest.size() > 1))
      return UncertaintyRole{std::string(rest.substr(rest.empty() ? 0 : 1)), standard * unit,
                             kind != "f"};
  }
  return {};
}

std::optional<double> only_number(std::string_view text) {
  constexpr std::string_view digits = "0123456789", part_of_number = "0123456789.,";
  std::optional<double> found;
  for (auto at = text.find_first_of(digits); at != text.npos;) {
    auto end = std::min(text.find_first_not_of(part_of_number, at), text.size());
    while (end > at && digits.find(text[end - 1]) == digits.npos) --end;
    const bool is_signed =
        at > 0 && text[at - 1] == '-' && (at == 1 || text[at - 2] == ' ' || text[at - 2] == '=');
    const auto number = number_in(text.substr(at, end - at));
    if (!number || found) return {};
    found = is_signed ? -*number : *number;
    at = text.find_first_of(digits, end);
  }
  return found;
}

}  // namespace gonio
