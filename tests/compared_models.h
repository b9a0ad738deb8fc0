#pragma once
/// \file
/// A choice among models with made-up figures: one of everything that its page shows.

#include "fitting/choice/choice.h"
#include "reports/pages/spheres.h"
#include "tables.h"

namespace gonio::test {

inline Table compared_table() {
  return filled(half_difference_grid(20), glossy());
}

/// Seven models of which some lie close together in error and time, and one that could not be compared.
inline ModelChoice compared_models() {
  struct Made {
    std::string model;
    double unseen, ns;
    std::vector<std::string> at_bound = {};
  };
  const std::vector<Made> all{
      {"lambert", 0.9, 0.2},
      {"ggx/smith_ggx.correlated/schlick", 0.5, 0.61},
      {"lambert+ggx/smith_ggx.correlated/schlick", 0.401, 0.602},
      {"lambert+ggx/smith_ggx.correlated/schlick.f90", 0.4, 0.6, {"f90"}},
      {"lambert+gtr/smith_ggx.correlated/schlick", 0.402, 0.605},
      {"lambert.coupled+ggx/smith_ggx.correlated/dielectric", 0.41, 0.6},
      {"lambert+ggx/smith_ggx.correlated/schlick+ggx/smith_ggx.correlated/schlick", 0.39, 1.6}};
  ModelChoice c;
  for (const auto& m : all) {
    ModelRow r;
    r.model = m.model;
    r.compared = r.converged = true;
    r.parameters = c.rows.size() + 1;
    r.log_rms = m.unseen - 0.01 * static_cast<double>(r.parameters);
    r.cv_log_rms = m.unseen;
    r.cv_behind = m.unseen > 0.45 ? 9 : 1;
    r.aic = r.bic = 100 * m.unseen;
    r.ns = m.ns, r.ns_spread = 0.01;
    r.parameters_at_bound = m.at_bound;
    c.rows.push_back(r);
    c.fits.push_back(glossy(0.05 * static_cast<double>(r.parameters)));
  }
  ModelRow left_out;
  left_out.model = "lambert+ggx_aniso/smith_ggx_aniso.correlated/schlick";
  left_out.note = "it is anisotropic, and the table is not";
  c.rows.push_back(left_out);
  c.fits.emplace_back();
  c.effective_values = 32100;
  c.blocks = 5;
  return c;
}

inline Spheres compared_spheres(const Table& t, const ModelChoice& c) {
  std::vector<BoundModel> fits;
  for (std::size_t k = 0; k < c.rows.size(); ++k)
    if (c.rows[k].compared) fits.push_back(c.fits[k]);
  return make_spheres(t, fits, 16);
}

}  // namespace gonio::test
