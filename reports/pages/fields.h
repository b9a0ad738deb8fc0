#pragma once
/// \file
/// Descriptions of what the pages of tables show.

#include "base/describe.h"
#include "fitting/result/document_fields.h"
#include "reports/pages/fit_page.h"
#include "reports/pages/inspect_page.h"
#include "table/health/health_fields.h"

namespace gonio {

template <>
inline constexpr auto description<Cut> = FieldList{
    Field{"at", &Cut::at, "angle that the curve is at: theta_i or theta_d"},
    Field{"at_deg", "°", &Cut::at_deg, ""},
    Field{"within_deg", "°", &Cut::within_deg, "data of `at` this far off are shown, too"},
    Field{"along", &Cut::along, "angle that varies along the curve"},
    Field{"deg", "°", &Cut::deg, "places, ascending"},
    Field{"data", "1/sr", &Cut::data, "data by channel and place"},
    Field{"model", "1/sr", &Cut::model, "model by channel and place; empty without one"},
    Field{"uncertainty", "1/sr", if_there([](const Cut& c) {
            return c.uncertainty.empty() ? std::nullopt : std::optional(c.uncertainty);
          }),
          "standard uncertainty of the data, where it is stated"},
    Field{"left_out", "1/sr", if_there([](const Cut& c) {
            return c.left_out.empty() ? std::nullopt : std::optional(c.left_out);
          }),
          "data that --mask leaves out"}};

template <>
inline constexpr auto description<ResidualMap> =
    FieldList{Field{"theta_h_deg", "°", &ResidualMap::theta_h_deg, "edges of the bins"},
              Field{"theta_d_deg", "°", &ResidualMap::theta_d_deg, "edges of the bins"},
              Field{"mean", &ResidualMap::mean, "mean of ln f_model − ln f_data, theta_d fastest"},
              Field{"rms", &ResidualMap::rms, "its RMS"},
              Field{"count", &ResidualMap::count, "number of values"},
              Field{"measured", "1/sr", &ResidualMap::measured,
                    "some of the values, evenly spread over the table"},
              Field{"predicted", "1/sr", &ResidualMap::predicted, "the model there"}};

template <>
inline constexpr auto description<ModelSphere> = FieldList{
    Field{"picture", &ModelSphere::picture, "PNG in base64"},
    Field{"difference", &ModelSphere::difference,
          "a byte a pixel in base64: 25 ΔE2000, 253 more, 254 not covered, 255 beside the "
          "sphere"},
    Field{"median", &ModelSphere::median, "of ΔE2000 from the table, pixels it covers"},
    Field{"p95", &ModelSphere::p95, "95th percentile of these"},
    Field{"itp_median", &ModelSphere::itp_median, "of ΔE_ITP, white at 203 cd/m²"},
    Field{"spacing_median", &ModelSphere::spacing_median,
          "of ΔE2000 that the spacing of the table's samples makes by itself"},
    Field{"spacing_p95", &ModelSphere::spacing_p95, "95th percentile of these"}};
static_assert(describes_every_member<ModelSphere>());

template <>
inline constexpr auto description<SpheresUnderLight> = FieldList{
    Field{"light", &SpheresUnderLight::light, "front light, rim light or flash"},
    Field{"covered", &SpheresUnderLight::covered, "share of the lit pixels that the table covers"},
    Field{"exposure", "sr", &SpheresUnderLight::exposure,
          "what radiance over irradiance is multiplied with"},
    Field{"table", &SpheresUnderLight::table, "PNG in base64; empty where too little is covered"},
    Field{"models", &SpheresUnderLight::models, "spheres of the models, likewise"}};
static_assert(describes_every_member<SpheresUnderLight>());

template <>
inline constexpr auto description<Spheres> =
    FieldList{Field{"pixels", &Spheres::pixels, "width and height of the pictures"},
              Field{"models", &Spheres::models, "specs of the models"},
              Field{"channels", &Spheres::channels, "those shown: in their colours, or as a grey"},
              Field{"lights", &Spheres::lights, "the spheres by light"}};
static_assert(describes_every_member<Spheres>());

/// Document of a fit's page.
struct FitPageDocument {
  Embedded<FitDocument> fit;
  Embedded<TableHealth> health;
  FitPage page;
};
template <>
inline constexpr auto description<FitPageDocument> =
    FieldList{Field{"fit", &FitPageDocument::fit, "the fit document"},
              Field{"health", &FitPageDocument::health, "the table's health"},
              Field{"channels", at(&FitPageDocument::page, &FitPage::channels), ""},
              Field{"curves", at(&FitPageDocument::page, &FitPage::curves), "data against model"},
              Field{"residual_map", at(&FitPageDocument::page, &FitPage::residual_map),
                    "where the model is off"},
              Field{"spheres", at(&FitPageDocument::page, &FitPage::spheres),
                    "the same sphere, table and fit"}};

template <>
inline constexpr auto description<SlicePicture> =
    FieldList{Field{"phi_d_deg", "°", &SlicePicture::phi_d_deg, "null: the mean over all"},
              Field{"theta_h_deg", "°", &SlicePicture::theta_h_deg, "edges of the cells"},
              Field{"theta_d_deg", "°", &SlicePicture::theta_d_deg, "edges of the cells"},
              Field{"value", "1/sr", &SlicePicture::value, "by channel and cell, theta_d fastest"}};

template <>
inline constexpr auto description<TrustMap> = FieldList{
    Field{"x", &TrustMap::x, "name of the angle"},
    Field{"y", &TrustMap::y, "name of the angle"},
    Field{"x_deg", "°", &TrustMap::x_deg, "edges of the cells"},
    Field{"y_deg", "°", &TrustMap::y_deg, "edges of the cells"},
    Field{"values", &TrustMap::values, "number of values, y fastest"},
    Field{"masked", [](const TrustMap& t) { return by_mask(t.masked); }, "by reason"},
    Field{"reciprocity", &TrustMap::reciprocity, "mean of |f(wi,wo) − f(wo,wi)| over their mean"},
    Field{"pairs", &TrustMap::pairs, "number of them"}};

/// Albedo of each channel, where health shows one number for one channel.
struct AlbedoPoint {
  AlbedoSample of;
};
template <>
inline constexpr auto description<AlbedoPoint> =
    FieldList{Field{"theta_i_deg", "°", at(&AlbedoPoint::of, &AlbedoSample::theta_i_deg),
                    "angle of incidence"},
              Field{"albedo", at(&AlbedoPoint::of, &AlbedoSample::albedo), "∫ f cos θ_o dω_o"},
              Field{"coverage", at(&AlbedoPoint::of, &AlbedoSample::coverage),
                    "share of the cosine-weighted hemisphere that valid samples speak for"}};

/// Document of a table's page.
struct InspectPageDocument {
  Embedded<TableHealth> health;
  InspectPage page;
};
template <>
inline constexpr auto description<InspectPageDocument> = FieldList{
    Field{"health", &InspectPageDocument::health, "the table's health"},
    Field{"channels", at(&InspectPageDocument::page, &InspectPage::channels), ""},
    Field{"curves", at(&InspectPageDocument::page, &InspectPage::curves), ""},
    Field{"picture", at(&InspectPageDocument::page, &InspectPage::picture), "f_r as a picture"},
    Field{"trust", at(&InspectPageDocument::page, &InspectPage::trust),
          "what is masked or not reciprocal"},
    Field{"albedo",
          [](const InspectPageDocument& d) {
            std::vector<AlbedoPoint> points;
            for (const auto& a : d.page.albedo) points.push_back({a});
            return points;
          },
          "by angle of incidence"}};

}  // namespace gonio
