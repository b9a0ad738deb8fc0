#pragma once
/// \file
/// The audit of the catalogue: what every entry keeps and breaks of what a BRDF must keep, measured.
///
///   mistake    it differs from the form that it is named for
///   violates   which of the laws it breaks: normalisation, reciprocity, energy, range (a masking or a
///              Fresnel factor outside [0, 1], a negative value), finite (a legal input without a value)

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "number/counted.h"
#include "number/parameter.h"

namespace gonio {

/// The furthest that was found, and where.
struct Worst {
  double value = 0;
  double error = 0;  ///< bound of the value's own error; 0: of rounding
  std::string where;
};

/// Distance of an entry to the form it is named for or stands for.
struct Distance {
  std::string_view reference;
  std::string_view measure;  ///< what is compared: "G2", "F", "D / D at its peak" …
  Worst most;
  double rms = 0;
};

/// A curve that shows what the entry looks like, its reference beside it.
struct EntryPicture {
  std::string x, y;
  std::vector<double> at, value, reference;  ///< reference: empty where there is none
};

struct EntryAudit {
  const About* about;
  std::string_view kind;               ///< "ndf", "masking", "fresnel", "diffuse", "map", "model"
  std::optional<Worst> normalisation;  ///< ∫ D cos θ dω, the one furthest from 1
  std::optional<Worst> reciprocity;    ///< largest |f(l,v) − f(v,l)| over the larger of them
  std::optional<Worst> energy;         ///< largest directional albedo at F = 1 (or white)
  std::string energy_of;               ///< the model that it was measured in, its masking with it
  /// A distribution looked at with a masking that is not its own: what light the two make together
  /// is no law of it.
  bool energy_is_shared = false;
  /// Largest directional albedo of a diffuse term under a GGX lobe with Schlick's F and f0 = 0.04; a law of a coupled one alone.
  std::optional<Worst> energy_under_lobe;
  /// Divisor of every figure but the times: π of what an engine ships without its 1/π.
  double light_unit = 1;
  std::optional<Worst> lowest, highest;  ///< of the factor itself
  std::optional<Worst> grazing;          ///< the value at 90°, at default parameters
  std::optional<Distance> distance;
  std::size_t not_finite = 0;  ///< legal inputs, the ends of all ranges among them, without a value
  std::optional<Operations> operations;  ///< of one evaluation, parameters' part left out
  EntryPicture picture;
  bool mistake = false;
  std::vector<std::string_view> violates;
};

/// Verdict in a few words: what is broken, and how far an entry is from the form that it stands for.
std::string verdict(const EntryAudit&);

/// Every id that can be audited, in the order of the catalogue: terms, maps, models.
std::vector<std::string_view> auditable_ids();

/// \param ids   in any order; an unknown one is wrong usage naming the nearest
/// \param done  called after each entry with how many are done
std::vector<EntryAudit> audit(const std::vector<std::string>& ids,
                              const std::function<void(std::size_t)>& done = {});

/// {"entries": […]}: every figure; what does not apply is null.
std::string to_json(const std::vector<EntryAudit>&);
/// JSON Schema of that document.
std::string audit_schema();
std::string audit_page_html(const std::vector<EntryAudit>&);

}  // namespace gonio
