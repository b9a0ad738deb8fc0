// An answer as a document.
#include "base/json/describe.h"
#include "brdf/catalogue/registry.h"
#include "brdf/model/own_files.h"
#include "stability/answer.h"

namespace gonio {

template <>
inline constexpr auto description<stability::NamedInput> =
    FieldList{Field{"inputs", &stability::NamedInput::inputs, "by name"},
              Field{"inputs_hex", &stability::NamedInput::inputs_hex, "the number's bits"},
              Field{"value", &stability::NamedInput::value, "null: no number, or infinite"},
              Field{"exact", &stability::NamedInput::exact, "in fifty digits, rounded"}};

template <>
inline constexpr auto description<stability::Least> = FieldList{
    Field{"requirement", &stability::Least::requirement, ""},
    Field{"flush", &stability::Least::flush, "results below the least normal number become 0"},
    Field{"value", &stability::Least::value,
          "of alpha, or what else decides: the least from which it holds; null: it holds "
          "nowhere"},
    Field{"evidence", &stability::Least::evidence,
          "exhaustive, proved; searched: nothing above breaks it that a search finds"}};

template <>
struct Description<stability::Answer> {
  static constexpr auto fields() {
    using A = stability::Answer;
    using L = stability::Looked;
    return FieldList{
        constant_text("schema", "gonio.stability/1"),
        field("id", &A::id, "term of the catalogue, or a model's spec"),
        field("form", &A::form, "how the angles are given"),
        field("number", at(&A::arithmetic, &stability::Arithmetic::number), ""),
        field("flush", at(&A::arithmetic, &stability::Arithmetic::flush),
              "results below the least normal number become 0"),
        field("contract", at(&A::arithmetic, &stability::Arithmetic::contract),
              "a b + c is rounded once"),
        field("any_gpu", at(&A::arithmetic, &stability::Arithmetic::any_gpu),
              "all that Vulkan allows a GPU: only proofs establish, and what was looked at is IEEE "
              "arithmetic, which is one of those allowed"),
        field("domain", &A::domain, "ends of each input"),
        field("requirement", &A::requirement, "finite, nonnegative, relative=X or absolute=X"),
        field("evidence", &A::evidence,
              "exhaustive, searched, proved; open: it is neither proved nor refuted"),
        field("holds", &A::holds, "for every input of the domain"),
        field("counterexample", &A::counterexample, "an input for which it does not"),
        field("worst_rel", at(&A::looked, at(&L::relative, &stability::Worst::value)),
              "most relative error that was found"),
        field("worst_ulp", at(&A::looked, at(&L::ulp, &stability::Worst::value)),
              "most error in units of the last digit"),
        field("condition", at(&A::looked, &L::condition),
              "units that a unit of the inputs is worth, where worst_ulp is"),
        field("worst_at", &A::worst_at, "where worst_rel is"),
        field("worst_hex", &A::worst_hex, "the same in bits"),
        field("proved_rel", &A::proved_rel, "bound of the relative error, where one is proved"),
        field("unproved_because", &A::unproved_because,
              "why what is required is open, or the bound that is proved no proof of it; empty: it "
              "is "
              "neither, or nothing can be proved in this number"),
        field("range", range, "that the value is proved to lie in"),
        field("evaluations", at(&A::looked, &L::evaluations), ""),
        field("boxes", &A::boxes, "of the proof"),
        field("open_share", &A::open_share,
              "part of the domain that the proof leaves open, in logarithms"),
        field("safe_from", safe_from,
              "of alpha, or what else decides: the least value from which the requirement holds; "
              "of a "
              "smoothness, a gloss or a shininess the largest up to which it holds"),
        field("safe_from_evidence", safe_from_evidence,
              "exhaustive, proved; searched: nothing above breaks it that a search finds"),
        field("least", &A::least, "where --least asks: the same of every requirement"),
        field("tolerance", at(&A::looked, at(&L::tolerance, &stability::Tolerance::relative)),
              "relative, that was looked for"),
        field("settled", at(&A::looked, &L::settled),
              "searches from two seeds agree within a factor of two"),
        field(own_files_key, if_there(shaders), own_files_meaning)};
  }
  static std::vector<OwnFile> shaders(const stability::Answer& a) {
    const std::string_view id = a.id;
    for (const auto role : names_of<Role>)
      if (id.starts_with(role) && id.substr(role.size()).starts_with('.'))
        return own_files({std::string(id.substr(role.size() + 1))});
    return own_files({a.id});
  }
  static std::optional<double> safe_from(const stability::Answer& a) {
    return a.safe_from ? a.safe_from->value : std::nullopt;
  }
  static std::optional<stability::Evidence> safe_from_evidence(const stability::Answer& a) {
    if (!a.safe_from) return {};
    return a.safe_from->evidence;
  }
  static std::optional<std::array<double, 2>> range(const stability::Answer& a) {
    if (!a.range) return {};
    return std::array{a.range->low, a.range->high};
  }
};

namespace stability {

std::string to_json(const Answer& a) {
  return json_text(a);
}
std::string answer_schema() {
  return schema_text<Answer>("gonio stability");
}

}  // namespace stability
}  // namespace gonio
