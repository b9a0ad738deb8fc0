#include "integrate/scattering/compensation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/whole_loop.h"
#include "brdf/catalogue/foreign_terms.h"
#include "brdf/catalogue/registry.h"
#include "brdf/formula/scattering.h"
#include "integrate/albedo/ggx_albedo.h"
#include "integrate/rule/slopes.h"

#include <fmt/format.h>

namespace gonio {
namespace {

/// A Fresnel term at cosines, for one channel.
void fresnel_values(const BoundModel& model,
                    const TermUse& fresnel,
                    std::size_t channel,
                    std::span<const double> cosines,
                    double* out) {
  AngleBlock block(catalogue()[fresnel.term].anisotropic);
  const auto columns = block.resize(cosines.size());
  for (auto* column : columns) std::ranges::copy(cosines, column);
  double* const values = block.extra(0);
  term_values(term_of_channel(fresnel.term, channel), term_parameters(model, fresnel, channel),
              block.block(), values);
  std::copy_n(values, cosines.size(), out);
}

/// A map's first output, of inputs that are off by `error` at most.  All of these maps rise or fall along
/// each input all the way, so that a corner is off the most.
template <template <class> class Map, std::size_t N>
Bounded bounded(const std::array<double, N>& p, const std::array<double, N>& error) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (std::ranges::find(error, infinity) != error.end()) return {infinity, infinity};
  Bounded b{Map<double>::apply(p)[0], 0};
  for (std::size_t corner = 0; corner < std::size_t{1} << N; ++corner) {
    auto q = p;
    for (std::size_t k = 0; k < N; ++k) q[k] += (corner >> k & 1 ? 1 : -1) * error[k];
    const double off = std::abs(Map<double>::apply(q)[0] - b.value);
    if (!(off <= b.error)) b.error = off;  // keeps what is no number
  }
  return b;
}

/// A lobe with what its compensation needs that does not depend on the direction.
class CompensatedLobe {
 public:
  CompensatedLobe(const BoundModel& whole, const Lobe& lobe, Compensation how, const Goal& goal)
      : how_(how), single_(whole) {
    single_.model.diffuse.clear();
    single_.model.lobes = {lobe};
    white_ = furnace(single_);
    white_.model.channels = 1;
    find_ggx(lobe);
    const auto& fresnel = catalogue()[lobe.fresnel.term];
    if (how == Compensation::fdez_aguera) {
      if (fresnel.about->id != "fresnel.schlick")
        throw wrong_usage(
            fmt::format("'{}' has {}: fdez_aguera takes A and B of the split sum, which are of "
                        "fresnel.schlick",
                        to_text(whole.model.spec), fresnel.about->id));
      dark_ = single_;
      const auto& f0 = dark_.model.parameters[lobe.fresnel.parameters[0]];
      std::fill_n(dark_.values.begin() + static_cast<std::ptrdiff_t>(f0.first), f0.count, 0.0);
      dark_.model.channels = 1;
    }
    f0_.resize(whole.model.channels);
    for (std::size_t c = 0; c < f0_.size(); ++c)
      fresnel_values(whole, lobe.fresnel, c, {{1.0}}, &f0_[c]);
    if (how == Compensation::kulla_conty || how == Compensation::kulla_conty_linear) {
      f_average_ = fresnel_average(whole, lobe.fresnel);
      e_average_ = ggx_ ? ggx_average_albedo(alpha_, *ggx_, goal.error)
                        : bound_of(hemispherical_albedo(white_, goal));
    }
  }

  Albedo without(double mu, double phi, const Goal& goal) const {
    return directional_albedo(single_, {{mu}}, phi, goal)[0];
  }
  /// Adds its albedo.
  /// \param single  without compensation
  void add(double mu, double phi, const Goal& goal, const Albedo& single, Albedo& to) const {
    const auto at = [&](const BoundModel& m) {
      auto a = directional_albedo(m, {{mu}}, phi, goal)[0];
      to.evaluations += a.evaluations;
      return bound_of(a);
    };
    to.evaluations += single.evaluations;
    const Bounded e = ggx_ ? ggx_albedo(alpha_, mu, *ggx_, goal.error) : at(white_);
    const Bounded b = how_ == Compensation::fdez_aguera ? at(dark_) : Bounded{};
    double worst = 0;
    for (std::size_t c = 0; c < f0_.size(); ++c) {
      const Bounded all = compensated(c, {single.value[c], single.error}, e, b);
      to.value[c] += all.value;
      if (!(all.error <= worst)) worst = all.error;
    }
    to.error += worst;
  }

 private:
  static Bounded bound_of(const Albedo& a) { return {a.value[0], a.error}; }

  void find_ggx(const Lobe& lobe) {
    const auto masking = catalogue()[lobe.masking.term].about->id;
    if (catalogue()[lobe.ndf.term].about->id != "ndf.ggx") return;
    alpha_ = term_parameters(single_, lobe.ndf, 0)[0];
    if (masking == "masking.smith_ggx.correlated") ggx_ = SmithGgx::correlated;
    if (masking == "masking.smith_ggx.separable") ggx_ = SmithGgx::separable;
    if (ggx_ && term_parameters(single_, lobe.masking, 0)[0] != alpha_) ggx_.reset();
  }

  Bounded compensated(std::size_t c,
                      const Bounded& single,
                      const Bounded& e,
                      const Bounded& b) const {
    switch (how_) {
      case Compensation::turquin:
        return bounded<Turquin, 3>({single.value, e.value, f0_[c]}, {single.error, e.error, 0});
      case Compensation::fdez_aguera:
        return bounded<FdezAguera, 3>({e.value - b.value, b.value, f0_[c]},
                                      {e.error + b.error, b.error, 0});
      default: {
        const std::array p{single.value, e.value, e_average_.value, f_average_.value[c]};
        const std::array error{single.error, e.error, e_average_.error, f_average_.error};
        return how_ == Compensation::kulla_conty ? bounded<KullaConty, 4>(p, error)
                                                 : bounded<KullaContyLinear, 4>(p, error);
      }
    }
  }

  Compensation how_;
  BoundModel single_, white_, dark_;
  std::optional<SmithGgx> ggx_;
  double alpha_ = 0;
  std::vector<double> f0_;
  Bounded e_average_;
  Albedo f_average_;
};

/// A model's lobes under a compensation, and its diffuse terms.
class Compensated {
 public:
  Compensated(const BoundModel& model, Compensation how, const Goal& goal, LobeAlbedos* known)
      : model_(model), known_(known) {
    for (const auto& lobe : model.model.lobes) lobes_.emplace_back(model, lobe, how, shared(goal));
  }
  Albedo operator()(double mu, double phi, const Goal& goal) const {
    Albedo sum{std::vector<double>(model_.model.channels), 0, 0};
    for (std::size_t k = 0; k < lobes_.size(); ++k) {
      const auto without = [&] { return lobes_[k].without(mu, phi, shared(goal)); };
      const auto single = known_ ? known_->at(k, mu, phi, shared(goal), without) : without();
      lobes_[k].add(mu, phi, shared(goal), single, sum);
    }
    if (model_.model.diffuse.empty()) return sum;
    const auto diffuse = diffuse_albedo(model_, {{mu}}, phi, shared(goal))[0];
    for (std::size_t c = 0; c < sum.value.size(); ++c) sum.value[c] += diffuse.value[c];
    sum.error += diffuse.error;
    sum.evaluations += diffuse.evaluations;
    return sum;
  }

 private:
  /// Goal of each of a lobe's three integrals: Turquin makes an error of E = 0.3 up to ten times as
  /// large.
  Goal shared(const Goal& goal) const {
    const std::size_t parts = model_.model.lobes.size() + 1;
    return {goal.error / (16.0 * static_cast<double>(parts)), goal.evaluations / (3 * parts)};
  }
  const BoundModel& model_;
  LobeAlbedos* known_;
  std::vector<CompensatedLobe> lobes_;
};

}  // namespace

Albedo LobeAlbedos::at(std::size_t lobe,
                       double mu,
                       double phi,
                       const Goal& goal,
                       const std::function<Albedo()>& compute) {
  const std::tuple key(lobe, mu, phi, goal.error, goal.evaluations);
  {
    const std::lock_guard lock(mutex_);
    if (const auto found = known_.find(key); found != known_.end()) return found->second;
  }
  auto albedo = compute();
  const std::lock_guard lock(mutex_);
  return known_.emplace(key, std::move(albedo)).first->second;
}

Albedo fresnel_average(const BoundModel& model, const TermUse& fresnel, const Goal& goal) {
  const auto f = [&](std::span<const double> x, std::span<const double>,
                     std::span<double* const> out) {
    for (std::size_t c = 0; c < out.size(); ++c) {
      fresnel_values(model, fresnel, c, x, out[c]);
      for (std::size_t i = 0; i < x.size(); ++i) out[c][i] *= 2 * x[i];
    }
  };
  const auto i = integrate(f, model.model.channels, {{{0, 0}, {1, 0}}}, goal);
  return {i.value, i.error, i.evaluations};
}

std::vector<Albedo> compensated_albedo(const BoundModel& model,
                                       Compensation how,
                                       std::span<const double> mu,
                                       double phi,
                                       const Goal& goal,
                                       LobeAlbedos* lobes) {
  check_cosines(mu);
  check_azimuth(phi);
  const Compensated albedo(model, how, goal, lobes);
  std::vector<Albedo> all(mu.size());
  for_each_whole(mu.size(), [&](std::size_t i) { all[i] = albedo(mu[i], phi, goal); });
  return all;
}

Albedo compensated_average(const BoundModel& model,
                           Compensation how,
                           const Goal& goal,
                           LobeAlbedos* lobes) {
  const Compensated albedo(model, how, goal, lobes);
  return hemispherical_average(
      [&](double mu, double phi, const Goal& each) { return albedo(mu, phi, each); },
      model.model.channels, model.model.anisotropic, goal);
}

Albedo with_diffuse(const Scattered& lobes, const Albedo& diffuse) {
  Albedo sum{lobes.albedo, *std::ranges::max_element(lobes.error) + diffuse.error,
             diffuse.evaluations};
  for (std::size_t c = 0; c < sum.value.size(); ++c) sum.value[c] += diffuse.value[c];
  return sum;
}

Albedo diffuse_average(const BoundModel& model, const Goal& goal) {
  return hemispherical_average(
      [&](double mu, double phi, const Goal& each) {
        return diffuse_albedo(model, {{mu}}, phi, each)[0];
      },
      model.model.channels, model.model.anisotropic, goal);
}

}  // namespace gonio
