#pragma once
/// \file
/// Descriptions of what the pages of tables show.

#include <tuple>

#include "base/describe.h"
#include "fitting/result/document_fields.h"
#include "reports/pages/fit_page.h"
#include "reports/pages/inspect_page.h"
#include "table/health/health_fields.h"

namespace gonio {

template <>
struct Description<Cut> {
  static constexpr auto fields() {
    return std::tuple{
        field("at", "", &Cut::at, "angle that the curve is at: theta_i or theta_d"),
        field("at_deg", "°", &Cut::at_deg, ""),
        field("within_deg", "°", &Cut::within_deg, "data of `at` this far off are shown, too"),
        field("along", "", &Cut::along, "angle that varies along the curve"),
        field("deg", "°", &Cut::deg, "places, ascending"),
        field("data", "1/sr", &Cut::data, "data by channel and place"),
        field("model", "1/sr", &Cut::model, "model by channel and place; empty without one")};
  }
};

template <>
struct Description<ResidualMap> {
  static constexpr auto fields() {
    return std::tuple{
        field("theta_h_deg", "°", &ResidualMap::theta_h_deg, "edges of the bins"),
        field("theta_d_deg", "°", &ResidualMap::theta_d_deg, "edges of the bins"),
        field("mean", "", &ResidualMap::mean, "mean of ln f_model − ln f_data, theta_d fastest"),
        field("rms", "", &ResidualMap::rms, "its RMS"),
        field("count", "", &ResidualMap::count, "number of values")};
  }
};

template <>
struct Description<ModelSphere> {
  static constexpr auto fields() {
    return std::tuple{
        field("picture", "", &ModelSphere::picture, "PNG in base64"),
        field("difference", "", &ModelSphere::difference,
              "a byte a pixel in base64: 25 ΔE2000, 253 more, 254 not covered, 255 beside the "
              "sphere"),
        field("median", "", &ModelSphere::median, "of ΔE2000 from the table, pixels it covers"),
        field("p95", "", &ModelSphere::p95, "95th percentile of these"),
        field("itp_median", "", &ModelSphere::itp_median, "of ΔE_ITP, white at 203 cd/m²"),
        field("spacing_median", "", &ModelSphere::spacing_median,
              "of ΔE2000 that the spacing of the table's samples alone makes"),
        field("spacing_p95", "", &ModelSphere::spacing_p95, "95th percentile of these")};
  }
};
static_assert(describes_every_member<ModelSphere>());

template <>
struct Description<SpheresUnderLight> {
  static constexpr auto fields() {
    using Light = SpheresUnderLight;
    return std::tuple{
        field("light", "", &Light::light, "front light, rim light or flash"),
        field("covered", "", &Light::covered, "share of the lit pixels that the table covers"),
        field("exposure", "sr", &Light::exposure,
              "what radiance over irradiance is multiplied with"),
        field("table", "", &Light::table, "PNG in base64; empty where too little is covered"),
        field("models", "", &Light::models, "spheres of the models, likewise")};
  }
};
static_assert(describes_every_member<SpheresUnderLight>());

template <>
struct Description<Spheres> {
  static constexpr auto fields() {
    return std::tuple{
        field("pixels", "", &Spheres::pixels, "width and height of the pictures"),
        field("models", "", &Spheres::models, "specs of the models"),
        field("channels", "", &Spheres::channels, "those shown: in their colours, or as a grey"),
        field("lights", "", &Spheres::lights, "the spheres by light")};
  }
};
static_assert(describes_every_member<Spheres>());

/// Document of a fit's page.
struct FitPageDocument {
  Embedded<FitDocument> fit;
  Embedded<TableHealth> health;
  FitPage page;
};
template <>
struct Description<FitPageDocument> {
  static constexpr auto fields() {
    return std::tuple{
        field("fit", "", &FitPageDocument::fit, "the fit document"),
        field("health", "", &FitPageDocument::health, "the table's health"),
        field("channels", "", at(&FitPageDocument::page, &FitPage::channels), ""),
        field("curves", "", at(&FitPageDocument::page, &FitPage::curves), "data against model"),
        field("residual_map", "", at(&FitPageDocument::page, &FitPage::residual_map),
              "where the model is off"),
        field("spheres", "", at(&FitPageDocument::page, &FitPage::spheres),
              "the same sphere, table and fit")};
  }
};

template <>
struct Description<SlicePicture> {
  static constexpr auto fields() {
    return std::tuple{
        field("phi_d_deg", "°", &SlicePicture::phi_d_deg, "null: the mean over all"),
        field("theta_h_deg", "°", &SlicePicture::theta_h_deg, "edges of the cells"),
        field("theta_d_deg", "°", &SlicePicture::theta_d_deg, "edges of the cells"),
        field("value", "1/sr", &SlicePicture::value, "by channel and cell, theta_d fastest")};
  }
};

template <>
struct Description<TrustMap> {
  static constexpr auto fields() {
    return std::tuple{
        field("x", "", &TrustMap::x, "name of the angle"),
        field("y", "", &TrustMap::y, "name of the angle"),
        field("x_deg", "°", &TrustMap::x_deg, "edges of the cells"),
        field("y_deg", "°", &TrustMap::y_deg, "edges of the cells"),
        field("values", "", &TrustMap::values, "number of values, y fastest"),
        field(
            "masked", "", [](const TrustMap& t) { return by_mask(t.masked); }, "by reason"),
        field("reciprocity", "", &TrustMap::reciprocity,
              "mean of |f(wi,wo) − f(wo,wi)| over their mean"),
        field("pairs", "", &TrustMap::pairs, "number of them")};
  }
};

/// Albedo of each channel, where health shows one number for one channel.
struct AlbedoPoint {
  AlbedoSample of;
};
template <>
struct Description<AlbedoPoint> {
  static constexpr auto fields() {
    return std::tuple{
        field("theta_i_deg", "°", at(&AlbedoPoint::of, &AlbedoSample::theta_i_deg),
              "angle of incidence"),
        field("albedo", "", at(&AlbedoPoint::of, &AlbedoSample::albedo), "∫ f cos θ_o dω_o"),
        field("coverage", "", at(&AlbedoPoint::of, &AlbedoSample::coverage),
              "share of the cosine-weighted hemisphere that valid samples speak for")};
  }
};

/// Document of a table's page.
struct InspectPageDocument {
  Embedded<TableHealth> health;
  InspectPage page;
};
template <>
struct Description<InspectPageDocument> {
  using Page = InspectPageDocument;
  static constexpr auto fields() {
    return std::tuple{
        field("health", "", &Page::health, "the table's health"),
        field("channels", "", at(&Page::page, &InspectPage::channels), ""),
        field("curves", "", at(&Page::page, &InspectPage::curves), ""),
        field("picture", "", at(&Page::page, &InspectPage::picture), "f_r as a picture"),
        field("trust", "", at(&Page::page, &InspectPage::trust),
              "what is masked or not reciprocal"),
        field(
            "albedo", "",
            [](const Page& d) {
              std::vector<AlbedoPoint> points;
              for (const auto& a : d.page.albedo) points.push_back({a});
              return points;
            },
            "by angle of incidence")};
  }
};

}  // namespace gonio
