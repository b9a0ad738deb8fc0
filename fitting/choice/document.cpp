#include "fitting/choice/document.h"

#include "base/json/describe.h"

namespace gonio {
namespace {

struct ModelsDocument {
  const ModelChoice& choice;
  const Advice& advice;
  const ComparedTable& table;
};

}  // namespace

template <>
struct Description<ModelRow> {
  static constexpr auto fields() {
    constexpr Numbers amounts{0, Numbers::any};
    using R = ModelRow;
    return FieldList{
        field("model", &R::model, "spec or preset, as asked"),
        field("converged", &R::converged, "false of one that was not compared, too"),
        field("misses", &R::misses, "whether it misses the table by more than noise"),
        field("note", if_there(&R::note), "why it could not be compared, or what to beware of"),
        field("parameters", &R::parameters, "free values, each channel's counted"),
        field("log_rms", if_there(&R::log_rms), "of ln f − ln y over the table", amounts),
        field("cv_log_rms", if_there(&R::cv_log_rms),
              "on incident angles that the fit had not seen", amounts),
        field("cv_behind", if_there(&R::cv_behind),
              "standard errors, over blocks of angles, that its mean square there is above the "
              "least",
              amounts),
        field("aic", if_there(&R::aic), "Akaike's criterion at effective_values", Numbers{}),
        field("bic", if_there(&R::bic), "Schwarz's criterion at effective_values", Numbers{}),
        field("delta_e_2000", if_there(&R::delta_e_2000),
              "of a sphere beside the table's, median pixel, mean of three lights", amounts),
        field("delta_e_itp", if_there(&R::delta_e_itp), "the same by ΔE_ITP, white at 203 cd/m²",
              amounts),
        field("ns", if_there(&R::ns), "of a sample in all channels, in float", amounts),
        field("ns_spread", if_there(&R::ns_spread), "half the distance of the quartiles", amounts),
        field("parameters_at_bound", &R::parameters_at_bound,
              "whose values the data push beyond their range")};
  }
};

template <>
struct Description<ModelsDocument> {
  /// Member of one of the three.
  template <auto part, class Member>
  struct Of {
    Member member;
    constexpr const auto& operator()(const ModelsDocument& d) const { return part(d).*member; }
  };
  template <class Member>
  static constexpr auto choice(Member m) {
    return Of < [](const ModelsDocument& d) -> const auto& {
      return d.choice;
    }
    , Member > {m};
  }
  template <class Member>
  static constexpr auto advice(Member m) {
    return Of < [](const ModelsDocument& d) -> const auto& {
      return d.advice;
    }
    , Member > {m};
  }
  template <class Member>
  static constexpr auto table(Member m) {
    return Of < [](const ModelsDocument& d) -> const auto& {
      return d.table;
    }
    , Member > {m};
  }

  static constexpr auto fields() {
    return FieldList{
        constant_text("schema", "gonio.models/1"),
        group("input", "table", field("path", table(&ComparedTable::path), ""),
              field("sha256", table(&ComparedTable::sha256), "of the file"),
              field("format", table(&ComparedTable::format), ""),
              field("mask", table(&ComparedTable::mask), "expression of --mask; empty: none")),
        field("metric", table(&ComparedTable::metric), "that the fits minimise"),
        field("log_offset", choice(&ModelChoice::log_offset),
              "added to values and model where log RMS is counted [1/sr]",
              Numbers{0, Numbers::any}),
        field("warnings", choice(&ModelChoice::warnings), "sentences on the table's values"),
        field("models", choice(&ModelChoice::rows), "in the order asked"),
        field("effective_values", if_there(choice(&ModelChoice::effective_values)),
              "independent values that the table's are worth", Numbers{0, Numbers::any}),
        field("blocks", choice(&ModelChoice::blocks),
              "of incident angles that were left out in turn; 0: too few angles"),
        field("recommended", if_there(advice(&Advice::recommended)), "model"),
        field("none_fits", advice(&Advice::none_fits),
              "whether all miss the table by more than noise; the nearest is still recommended"),
        field("reason", if_there(advice(&Advice::reason)), "sentences"),
        field("as_good", advice(&Advice::as_good), "models that the table cannot tell from it"),
        field("disagreement", advice(&Advice::disagreement),
              "what other judges prefer, in sentences"),
        field("beware", advice(&Advice::beware),
              "what the recommended one does not do, in sentences")};
  }
};

ComparedTable compared_table(const Table& t, const FitOptions& o) {
  return {t.path, t.sha256, t.format, std::string(name_of(o.metric)), t.mask};
}

std::string to_json(const ModelChoice& choice, const Advice& advice, const ComparedTable& table) {
  return json_text(ModelsDocument{choice, advice, table});
}

std::string models_schema() {
  return schema_text<ModelsDocument>("Models compared on a table");
}

}  // namespace gonio
