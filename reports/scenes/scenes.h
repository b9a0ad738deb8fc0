#pragma once
/// \file
/// Scenes of one sphere each: which effects a material needs under a light, what the others would have changed, and
/// how much faster a shader without them is.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "reports/finding/report.h"
#include "scene/plan/plan.h"

namespace gonio {

namespace page {
struct Page;
}

struct ScenesOptions {
  bool full = false;
  std::vector<std::string> materials, lights;  ///< names of reports/scenes/cases.h
  std::string asset;  ///< glTF file whose materials are planned, too; empty: none
  scene::PlanOptions plan{};
  std::size_t verified = scene::verified_samples;  ///< fresh points of a verification
  std::size_t pixels = 96;                         ///< width of a picture
  std::size_t picture_samples = 64;                ///< of a pixel
  std::vector<double> map_angle_deg, map_roughness;
  std::size_t map_samples = 1024;
};
ScenesOptions scenes_options(bool full);

/// Material under a light, its plan and the verification of that on fresh points.
struct SceneRow {
  std::string material, light;
  std::string kept, dropped, absent;  ///< names, comma between; absent: what the material has not
  std::string spec;
  double speedup = 1;        ///< everything on in double, over the plan
  double speedup_float = 1;  ///< all that the material has in float, over the plan in float
  double ops_saved = 0;      ///< share of the operations
  /// Times of f of one direction of light: the plan; everything on in double and in float; in float all that
  /// the material has; the plan in float.
  double ns = 0, ns_exact = 0, ns_exact_float = 0, ns_present_float = 0, ns_float = 0;
  double error_quantile = 0, error_upper = 0, worst = 0;  ///< on the planner's own fresh points
  double reference_error = 0;  ///< what the reference may be off by itself, at the quantile
  std::uint64_t exceeding = 0, samples = 0;  ///< of the verification
  double upper_bound = 1;                    ///< of the share that exceeds
  bool holds = false;
  bool needs_table = false;  ///< it keeps light between facets as a table, which no shader has
};
/// Effect of a material under a light.
struct SceneEffectRow {
  std::string material, light;
  std::string effect, form, name;  ///< name: of its exact form, in words
  std::string keeps;               ///< name of the form that is kept; empty: it is dropped
  bool keep = false;
  std::string why, reason;
  double error_if_dropped = 0, ns_saved = 0, ops_saved = 0;
};
/// Set of forms of which none is cheaper and errs less.
struct SceneFrontRow {
  std::string material, light, kept;
  double ns = 0, ns_spread = 0, ops = 0, error_quantile = 0, error_upper = 0, worst = 0;
  bool chosen = false;
};
/// Sphere as the display shows it.
struct ScenePicture {
  std::string material, light;
  std::size_t pixels = 0;  ///< width and height
  /// In base64: PNG with all effects, and as planned; rows from the top of 50 times the difference of each pixel, a byte of
  /// at most 254, and 255 beside the sphere.
  std::string everything, planned, difference;
  double worst = 0;  ///< greatest difference of a pixel
};
/// Places where an effect switches on.
struct SceneMap {
  std::string material, effect, name;
  double own_roughness = 0;  ///< of the material in the scenes
  std::vector<double> light_deg, roughness;
  std::vector<double> error;  ///< [angle * roughness.size() + roughness], where it is dropped
};

/// Material of an asset that is no scene of the report.
struct SceneLeftOut {
  std::string material, why;
};

struct ScenesRows {
  scene::Tolerance tolerance;
  std::vector<SceneRow> rows;
  std::vector<SceneEffectRow> effects;
  std::vector<SceneFrontRow> front;
  std::vector<ScenePicture> pictures;
  std::vector<SceneMap> maps;
  std::vector<SceneLeftOut> left_out;
};

ScenesRows scenes_rows(const ScenesOptions&, const ReportProgress& done = {});
Findings findings(const ScenesRows&);
/// Pictures of the page, by family: figures front of material and light; maps switches_on of material and effect.
Pictures pictures(const ScenesRows&);

using ScenesReport = Report<ScenesRows>;
ScenesReport scenes_report(const ScenesOptions&, const ReportProgress& done = {});

/// Document {"rows": […], …}: flat objects; what is not known is null.
std::string to_json(const ScenesReport&);
/// Its rows as CSV.
std::string rows_csv(const ScenesReport&);
/// JSON Schema of the document.
std::string scenes_schema();
/// Its page.
page::Page report_page(const ScenesReport&);

}  // namespace gonio
