// The audit as JSON.
#include <utility>

#include "reports/audit/audit.h"
#include "reports/picture/document.h"

namespace gonio {
namespace {

struct AuditDocument {
  const std::vector<EntryAudit>* entries;
};

/// Operations by the names of their kinds.
using NamedOperations = std::vector<std::pair<std::string_view, std::size_t>>;
std::optional<NamedOperations> operations_of_entry(const EntryAudit& e) {
  if (!e.operations) return {};
  NamedOperations out;
  for (std::size_t k = 0; k < operation_names.size(); ++k)
    out.emplace_back(operation_names[k], e.operations->by_kind[k]);
  return out;
}

}  // namespace

template <>
inline constexpr auto description<Worst> =
    FieldList{Field{"value", &Worst::value, ""},
              Field{"error", &Worst::error, "bound of the value's own; 0: of rounding"},
              Field{"where", &Worst::where, ""}};
static_assert(describes_every_member<Worst>());

template <>
inline constexpr auto description<Distance> = FieldList{
    Field{"reference", &Distance::reference, "id"},
    Field{"measure", &Distance::measure, "what is compared"},
    Field{"max", at(&Distance::most, &Worst::value), ""},
    Field{"where", at(&Distance::most, &Worst::where), ""}, Field{"rms", &Distance::rms, ""}};

template <>
inline constexpr auto description<EntryPicture> =
    FieldList{Field{"x", &EntryPicture::x, "label"}, Field{"y", &EntryPicture::y, "label"},
              Field{"at", &EntryPicture::at, ""}, Field{"value", &EntryPicture::value, ""},
              Field{"reference", &EntryPicture::reference, "empty: there is none"}};
static_assert(describes_every_member<EntryPicture>());

template <>
struct Description<EntryAudit> {
  static constexpr auto fields() {
    using E = EntryAudit;
    constexpr auto about = [](auto member) {
      return [member](const E& e) { return std::string_view(e.about->*member); };
    };
    return FieldList{
        field("id", "", about(&About::id), ""),
        field("kind", "", &E::kind, "ndf, masking, fresnel, diffuse, map, model"),
        field("title", "", about(&About::title), ""),
        field("formula", "", about(&About::formula), ""),
        field("source", "", about(&About::source), ""),
        field("ships", "", about(&About::ships), "where"),
        field("mistake", "", &E::mistake, "it differs from the form that it is named for"),
        field("violates", "", &E::violates, "normalisation, reciprocity, energy, range, finite"),
        field("verdict", "", verdict, "in a few words, with the distance to its reference"),
        field("light_unit", "", &E::light_unit,
              "divisor of every figure: π of what an engine ships without its 1/π"),
        field("normalisation", "", &E::normalisation, "∫ D cos θ dω, the one furthest from 1"),
        field("reciprocity", "", &E::reciprocity, "most |f(l,v) − f(v,l)| over the larger of them"),
        field("energy", "", &E::energy, "largest directional albedo at F = 1, or white"),
        field("energy_of", "", &E::energy_of, "model that it was measured in, with its masking"),
        field("energy_under_lobe", "", &E::energy_under_lobe, "of a diffuse term under a GGX lobe"),
        field("lowest", "", &E::lowest, "value of the factor"),
        field("highest", "", &E::highest, "value of the factor"),
        field("grazing", "", &E::grazing, "value at 90°, at default parameters"),
        field("not_finite", "", &E::not_finite, "legal inputs without a value"),
        field("distance", "", &E::distance, "to the form it is named for or stands for"),
        field("operations", "", operations_of_entry, "of one evaluation"),
        field("picture", "", &E::picture, "curve that shows what it looks like")};
  }
};

template <>
inline constexpr auto description<AuditDocument> =
    FieldList{Field{"entries", [](const AuditDocument& d) -> const auto& {return *d.entries;
}
, ""
}
}
;

std::string to_json(const std::vector<EntryAudit>& entries) {
  return page_document(AuditDocument{&entries});
}
std::string audit_schema() {
  return schema_text<AuditDocument>("gonio audit --json");
}

}  // namespace gonio
