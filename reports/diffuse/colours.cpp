// How each form looks beside its reference.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>

#include "base/whole_loop.h"
#include "brdf/catalogue/registry.h"
#include "brdf/model/evaluate.h"
#include "geometry/half_difference.h"
#include "image/display.h"
#include "integrate/albedo/directional_albedo.h"
#include "integrate/rule/quadrature.h"
#include "reports/diffuse/forms.h"
#include "reports/finding/facts.h"

namespace gonio {
namespace {

using namespace diffusing;

constexpr double pi = std::numbers::pi;

struct Material {
  const char* name;
  Rgb kd;
};
constexpr std::array materials{Material{"chalk", {0.85, 0.85, 0.85}},
                               Material{"grey", {0.18, 0.18, 0.18}},
                               Material{"terracotta", {0.55, 0.25, 0.15}}};
struct Light {
  const char* name;
  double from_viewer_deg;
};
constexpr std::array lights{Light{"front light", 0}, Light{"side light", 60},
                            Light{"rim light", 120}};
constexpr const char* even_light = "even light";

/// Points of a ball, seen from afar, that one light reaches, but for the rim beyond least_colour_cosine.
struct LitPoints {
  std::vector<Angles<double>> at;
  std::size_t inside = 0;  ///< the first so many are a picture's; the others lie where the rim
                           ///< begins, as errors are largest there
};
LitPoints lit_points(double from_viewer_deg, std::size_t pixels) {
  LitPoints out;
  const double t = from_viewer_deg * degree;
  const Direction light{std::sin(t), 0, std::cos(t)};
  const double voh = std::cos(t / 2);
  const Direction h{light.x / (2 * voh), 0, (light.z + 1) / (2 * voh)};
  const auto add = [&](double x, double y, double nov, double nol) {
    const double noh = (nol + nov) / (2 * voh);
    // |n × h|² from both vectors, as it cancels near the peak
    const double cx = y * h.z, cy = nov * h.x - x * h.z, cz = -y * h.x;
    out.at.push_back({nol, nov, std::min(noh, 1.0), voh, cx * cx + cy * cy + cz * cz});
  };
  for (std::size_t i = 0; i < pixels; ++i)
    for (std::size_t j = 0; j < pixels; ++j) {
      const auto at = [&](std::size_t k) {
        return (2 * static_cast<double>(k) + 1) / static_cast<double>(pixels) - 1;
      };
      const double x = at(i), y = at(j), z2 = 1 - x * x - y * y;
      if (z2 <= 0) continue;
      const double nov = std::sqrt(z2), nol = x * light.x + nov * light.z;
      if (nov >= least_colour_cosine && nol >= least_colour_cosine) add(x, y, nov, nol);
    }
  out.inside = out.at.size();
  const double least = least_colour_cosine;
  for (std::size_t i = 0; i <= pixels; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(pixels);
    const double across = std::sqrt(1 - least * least);  // of all points at that cosine to the view
    const double x = across * (2 * part - 1), nol = x * light.x + least * light.z;
    if (nol >= least) add(x, std::sqrt(across * across - x * x), least, nol);
    const double nov = std::lerp(least, 1.0, part), of_light = (least - nov * light.z) / light.x;
    if (const double y2 = 1 - nov * nov - of_light * of_light; y2 >= 0)
      add(of_light, std::sqrt(y2), nov, least);
  }
  return out;
}

/// Albedo of the lobe on plastic, by the cosine: lines between places that are densest at the horizon.
class LobeAlbedo {
 public:
  explicit LobeAlbedo(double roughness) {
    const auto lobe =
        bind_model(lobe_spec, {{"alpha", {alpha_of_slider(roughness)}}, {"f0", {lobe_f0}}}, 1);
    std::vector<double> mu;
    for (std::size_t i = 1; i <= steps; ++i) mu.push_back(place(i) * place(i));
    const Goal goal{1e-6, 400'000};
    for (const auto& a : directional_albedo(lobe, mu, 0, goal)) at_.push_back(a.value[0]);
    average_ = hemispherical_albedo(lobe, goal).value[0];
  }
  double average() const { return average_; }
  /// Share that the lobe leaves to what lies below, of both directions.
  double left(double nol, double nov) const {
    return (1 - at(nol)) * (1 - at(nov)) / (1 - average_);
  }
  double left(double nov) const { return 1 - at(nov); }

 private:
  static constexpr std::size_t steps = 64;
  static double place(std::size_t i) { return static_cast<double>(i) / steps; }
  double at(double mu) const {
    const double x = std::clamp(std::sqrt(mu) * steps, 1.0, static_cast<double>(steps)) - 1;
    const auto i = std::min(static_cast<std::size_t>(x), steps - 2);
    return std::lerp(at_[i], at_[i + 1], x - static_cast<double>(i));
  }
  std::vector<double> at_;
  double average_ = 0;
};

using Channels = std::vector<std::vector<double>>;  ///< [channel][point]

/// ΔE2000 at points, radiance of light that makes white of a white diffuser that faces it.
/// \param inside  the mean is of the first so many
DiffuseColour compared(const Channels& found,
                       const Channels& truth,
                       std::span<const double> of,
                       std::size_t inside) {
  DiffuseColour c{};
  for (std::size_t i = 0; i < of.size(); ++i) {
    const auto seen = [&](const Channels& f) {
      return Rgb{of[i] * f[0][i], of[i] * f[1][i], of[i] * f[2][i]};
    };
    const double off = displayed_difference(seen(found), seen(truth), 1);
    c.delta_e = std::max(c.delta_e, off);
    if (i < inside) c.delta_e_mean += off / static_cast<double>(inside);
  }
  return c;
}

/// The colours of one roughness.
class Comparison {
 public:
  Comparison(const DiffuseOptions& o, const std::vector<DiffuseForm>& forms, double roughness)
      : o_(o), forms_(forms), roughness_(roughness), lobe_(roughness) {
    for (const auto& l : lights) points_.push_back(lit_points(l.from_viewer_deg, o.pixels));
  }

  std::vector<DiffuseColour> operator()() const {
    std::vector<DiffuseColour> out;
    const auto all = known_forms();
    const auto& eon = *std::ranges::find(all, reference, &DiffuseForm::id);
    for (const auto& m : materials)
      for (const bool plastic : {false, true}) {
        std::vector<BoundModel> models;
        std::vector<double> given_back;
        const auto target = average_of_reference(eon, m, plastic);
        for (const auto& f : forms_) {
          models.push_back(is_of(f, plastic) ? model_of_average(f, m, plastic, target)
                                             : BoundModel{});
          given_back.push_back(is_of(f, plastic) ? least_share(average(models.back()), target) : 1);
        }
        for (std::size_t l = 0; l < lights.size(); ++l) {
          const auto truth = reference_values(eon, m, points_[l].at, plastic);
          std::vector<double> light;
          for (const auto& p : points_[l].at) light.push_back(pi * p.nol);
          for (std::size_t f = 0; f < forms_.size(); ++f)
            if (is_of(forms_[f], plastic))
              put(out, forms_[f], m, plastic, lights[l].name, given_back[f],
                  compared(evaluate(models[f], points_[l].at), truth, light, points_[l].inside));
        }
        const auto truth = reference_albedo(eon, m, plastic);
        const std::vector<double> ones(o_.mu.size(), 1);
        for (std::size_t f = 0; f < forms_.size(); ++f)
          if (is_of(forms_[f], plastic))
            put(out, forms_[f], m, plastic, even_light, given_back[f],
                compared(albedo(models[f]), truth, ones, ones.size()));
      }
    return out;
  }

 private:
  /// A form that holds its interface is none of a matte surface.
  static bool is_of(const DiffuseForm& f, bool plastic) {
    return plastic || (!f.with_interface && f.id != reference);
  }
  BoundModel model(const DiffuseForm& f, const Material& m, bool plastic) const {
    return bound(f, roughness_, {m.kd.begin(), m.kd.end()}, plastic);
  }
  /// What the diffuse part gives back on average over the hemisphere.
  static std::vector<double> average(const BoundModel& b) {
    return hemispherical_average(
               [&](double mu, double phi, const Goal& each) {
                 return diffuse_albedo(b, {&mu, 1}, phi, each)[0];
               },
               b.model.channels, false, {1e-4, 100'000})
        .value;
  }
  /// Over the channels, of what the target asks for.
  static double least_share(const std::vector<double>& found, const std::vector<double>& target) {
    double least = 1;
    for (std::size_t c = 0; c < target.size(); ++c) least = std::min(least, found[c] / target[c]);
    return least;
  }
  /// Of the reference below the lobe: what comes through both ways, as Lambert would give it back.
  std::vector<double> average_of_reference(const DiffuseForm& eon,
                                           const Material& m,
                                           bool plastic) const {
    auto target = average(model(eon, m, false));
    for (double& a : target) a *= plastic ? 1 - lobe_.average() : 1;
    return target;
  }
  BoundModel model_of_average(const DiffuseForm& f,
                              const Material& m,
                              bool plastic,
                              const std::vector<double>& target) const {
    BoundModel b = model(f, m, plastic);
    const auto& kd = *b.model.find("kd");
    for (int round = 0; round < 3; ++round) {  // the average is nearly proportional to kd
      const auto now = average(b);
      for (std::size_t c = 0; c < target.size(); ++c) {
        double& value = b.values[kd.slot(c)];
        value = std::min(value * target[c] / now[c], 1.0);
      }
    }
    return b;
  }
  BoundModel lobe() const {
    return bind_model(lobe_spec, {{"alpha", {alpha_of_slider(roughness_)}}, {"f0", {lobe_f0}}}, 1);
  }
  Channels albedo(const BoundModel& b) const {
    Channels out(3);
    for (const auto& a : directional_albedo(b, o_.mu, 0, {1e-6, 400'000}))
      for (std::size_t c = 0; c < 3; ++c) out[c].push_back(a.value[c]);
    return out;
  }
  Channels reference_values(const DiffuseForm& eon,
                            const Material& m,
                            const std::vector<Angles<double>>& at,
                            bool plastic) const {
    auto f = evaluate(model(eon, m, false), at);
    if (!plastic) return f;
    const auto above = evaluate(lobe(), at)[0];
    for (auto& channel : f)
      for (std::size_t i = 0; i < at.size(); ++i)
        channel[i] = above[i] + channel[i] * lobe_.left(at[i].nol, at[i].nov);
    return f;
  }
  /// ∫ f_EON (1 − E(l)) NoL dω/(1 − E_avg), which is the albedo of EON as it is seen from below.
  Channels reference_albedo(const DiffuseForm& eon, const Material& m, bool plastic) const {
    if (!plastic) return albedo(model(eon, m, false));
    Channels out(3);
    const auto above = directional_albedo(lobe(), o_.mu, 0, {1e-6, 400'000});
    const auto b = model(eon, m, false);
    for (std::size_t i = 0; i < o_.mu.size(); ++i) {
      const Direction v{std::sqrt((1 - o_.mu[i]) * (1 + o_.mu[i])), 0, o_.mu[i]};
      std::vector<Angles<double>> at;
      std::vector<double> weight;
      for (const auto& node : cosine_hemisphere(32, 64)) {
        at.push_back(angles({node.direction, v}));
        weight.push_back(node.weight * lobe_.left(node.direction.z, o_.mu[i]));
      }
      const auto f = evaluate(b, at);
      for (std::size_t c = 0; c < 3; ++c) {
        double sum = above[i].value[0];
        for (std::size_t k = 0; k < at.size(); ++k) sum += f[c][k] * weight[k];
        out[c].push_back(sum);
      }
    }
    return out;
  }
  void put(std::vector<DiffuseColour>& to,
           const DiffuseForm& f,
           const Material& m,
           bool plastic,
           const char* light,
           double given_back,
           DiffuseColour c) const {
    c.form = f.id;
    c.surface = plastic ? "plastic" : "matte";
    c.material = m.name;
    c.light = light;
    c.roughness = roughness_;
    c.given_back = given_back;
    to.push_back(std::move(c));
  }

  const DiffuseOptions& o_;
  const std::vector<DiffuseForm>& forms_;
  double roughness_;
  LobeAlbedo lobe_;
  std::vector<LitPoints> points_;  ///< by light
};

}  // namespace

std::vector<DiffuseColour> diffuse_colours(const DiffuseOptions& o,
                                           const std::vector<DiffuseForm>& forms,
                                           const std::function<void(double)>& done) {
  std::vector<std::vector<DiffuseColour>> all(o.roughness.size());
  for_each_whole(o.roughness.size(),
                 [&](std::size_t i) { all[i] = Comparison(o, forms, o.roughness[i])(); });
  done(1);
  std::vector<DiffuseColour> out;
  for (auto& a : all) std::ranges::move(a, std::back_inserter(out));
  return out;
}

}  // namespace gonio
