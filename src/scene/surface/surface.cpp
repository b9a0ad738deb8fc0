#include "scene/surface/surface.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <numeric>

#include "brdf/catalogue/foreign_terms.h"
#include "brdf/catalogue/registry.h"
#include "brdf/formula/scattering.h"
#include "brdf/formula/widths.h"
#include "brdf/in_number/number.h"
#include "brdf/model/evaluate.h"
#include "brdf/model/reflectances.h"
#include "integrate/rule/slopes.h"
#include "integrate/scattering/compensation.h"
#include "optics/f0.h"
#include "optics/fresnel_approximate.h"
#include "optics/spectrum.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

namespace gonio::scene {
namespace {

constexpr std::size_t channels = 3;
/// Largest F0 that is taken for a dielectric's: eta = 3.
constexpr double most_dielectric_f0 = 0.25;
constexpr double f82_cosine = 1.0 / 7;
constexpr std::string_view coupled = ".coupled", aniso = "_aniso";
const LobeSpec gltf_coat{"ggx", "smith_ggx.correlated", "schlick.weighted"};
/// Forms with no compensation dearer than renderers ship.
Forms as_shipped(Forms f) {
  f[Effect::compensation] = std::min(f[Effect::compensation], Form::kulla_conty);
  return f;
}

std::string name_of_term(const TermUse& t) {
  return std::string(short_id(catalogue()[t.term].id()));
}
bool all_equal(const std::vector<double>& v) {
  return std::ranges::all_of(v, [&](double x) { return x == v[0]; });
}
bool all_zero(const std::vector<double>& v) {
  return std::ranges::all_of(v, [](double x) { return x == 0; });
}

/// Parameters of some terms with their values.
std::vector<Setting> settings_of(const BoundModel& b, std::initializer_list<const TermUse*> terms) {
  std::vector<Setting> all;
  for (const auto* t : terms)
    for (const auto k : t->parameters) {
      const auto& p = b.model.parameters[k];
      if (std::ranges::find(all, p.name, &Setting::name) == all.end())
        all.push_back({p.name,
                       {b.values.begin() + static_cast<std::ptrdiff_t>(p.first),
                        b.values.begin() + static_cast<std::ptrdiff_t>(p.first + p.count)}});
    }
  return all;
}
double number_of(const std::vector<Setting>& all, std::string_view name, double otherwise) {
  const auto at = std::ranges::find(all, name, &Setting::name);
  return at == all.end() ? otherwise : at->values[0];
}

LobeSpec spec_of(const Lobe& l) {
  return {name_of_term(l.ndf), name_of_term(l.masking), name_of_term(l.fresnel)};
}

/// Model of those of the settings that it has.
BoundModel bound(const ModelSpec& spec, const std::vector<Setting>& settings) {
  const Model m = compose(spec, 1);
  std::vector<Setting> own;
  for (const auto& s : settings)
    if (m.find(s.name)) own.push_back(s);
  return bind_model(spec, own, channels);
}

/// Reflectance near 82° over Schlick's.
double edge_tint(double f0, double edge) {
  return std::clamp(edge / schlick<double>(f0, schlick_weight(f82_cosine)), 0.0, 1.0);
}

/// F of each channel at a cosine.
std::vector<double> reflectance(const BoundModel& b, const TermUse& fresnel, double cosine) {
  std::vector<double> f;
  const std::array row{FrameAngles<double>{{cosine, cosine, cosine, cosine, 0}, 0, 0, 0, 0, 0, 0}};
  for (std::size_t c = 0; c < channels; ++c) {
    f.push_back(values_in(Number::double_, fresnel.term, term_parameters(b, fresnel, c), row)[0]);
  }
  return f;
}

/// Index of a metal by bands.
SpectralMetal<double> spectral(const gonio::Material& metal) {
  static_assert(SpectralMetal<double>::bands == wavebands);
  SpectralMetal<double> m;
  const auto bands = waveband_colours();
  for (std::size_t b = 0; b < wavebands; ++b) {
    const Index n = metal.at(bands[b].nm);
    m.eta[b] = n.n;
    m.k[b] = n.k;
    for (std::size_t c = 0; c < channels; ++c) m.weight[c][b] = bands[b].rgb[c];
  }
  return m;
}
/// Σ_b weight_cb values_b
std::vector<double> colour(const SpectralMetal<double>& m, const std::vector<double>& values) {
  std::vector<double> rgb;
  for (const auto& weight : m.weight)
    rgb.push_back(std::inner_product(weight.begin(), weight.end(), values.begin(), 0.0));
  return rgb;
}
/// F_avg of each band.
std::vector<double> band_averages(const SpectralMetal<double>& m) {
  std::vector<double> all;
  for (std::size_t b = 0; b < wavebands; ++b) {
    const BoundModel one =
        bind_model("ggx/smith_ggx.correlated/conductor",
                   std::vector<Setting>{{"alpha", {1}}, {"eta", {m.eta[b]}}, {"k", {m.k[b]}}}, 1);
    all.push_back(fresnel_average(one, one.model.lobes[0].fresnel, {1e-9, 100'000}).value[0]);
  }
  return all;
}

/// Name of a distribution that forms are of, without its anisotropy; "" of any other.
std::string_view family_of(std::string_view ndf) {
  const auto name = ndf.substr(0, ndf.size() - (ndf.ends_with(aniso) ? aniso.size() : 0));
  return name == "ggx" || name == "beckmann" || ndf == "gtr" ? name : "";
}
bool stands_for_smith(std::string_view masking) {
  return masking.starts_with("smith_ggx") || masking.starts_with("smith_beckmann") ||
         masking.starts_with("smith_gtr") || masking.starts_with("schlick_") ||
         masking.starts_with("ue_joint") || masking == "hammon" || masking == "disney_remap";
}

/// Table of a lobe, made once: scenes, plans and maps ask for the same again.
std::shared_ptr<const TabulatedLobe> tabulated_lobe(const BoundModel& lobe,
                                                    std::span<const ColourOfChannel> colours) {
  constexpr std::size_t most = 64;
  static std::mutex making;
  static std::map<std::pair<std::string, std::vector<double>>, std::shared_ptr<const TabulatedLobe>>
      all;
  std::pair key{to_text(lobe.model.spec), lobe.values};
  for (const auto& c : colours) key.second.insert(key.second.end(), c.begin(), c.end());
  const std::scoped_lock lock(making);
  if (const auto known = all.find(key); known != all.end()) return known->second;
  if (all.size() == most) all.clear();
  auto& made = all[std::move(key)];
  // Isolated, as ImageLight is: a waiting thread must not take up a task that asks for this lock.
  tbb::this_task_arena::isolate(
      [&] { made = std::make_shared<const TabulatedLobe>(lobe, colours); });
  return made;
}

}  // namespace

std::string Surface::spec() const {
  ModelSpec all = base.model.spec;
  if (coat) all.coat = coat->model.spec.lobes[0];
  return to_text(all);
}

std::vector<std::pair<std::string, std::vector<double>>> Surface::parameters() const {
  auto all = named_values(base);
  if (coat)
    for (auto& [name, values] : named_values(*coat))
      all.emplace_back(to_text({name, base.model.lobes.size()}), values);
  return all;
}

Look::Look(const Material& m, std::shared_ptr<const ImageLight> sky) : sky_(std::move(sky)) {
  if (const auto* model = std::get_if<BoundModel>(&m.is))
    read(in_reflectances(*model), m.coated);
  else
    read(std::get<GltfMaterial>(m.is));
  read_spectrum(m);
  if (coat_.lobe.ndf.empty()) {
    coat_.lobe = gltf_coat;
    coat_.parameters = {{"alpha", {0.01}}, {"f0", {0.04}}, {"weight", {0}}};
  }
  coat_.absent = number_of(coat_.parameters, "weight", 1) == 0;
  const double alpha = number_of(coat_.parameters, "alpha", 0.1);
  const double x = number_of(coat_.parameters, "alpha_x", alpha);
  const double y = number_of(coat_.parameters, "alpha_y", alpha);
  coat_.width = std::max(x, y);
  coat_.mean_width = std::sqrt(x * y);
  offer_forms();
  if (!first_.known) return;
  const auto base = surface(structural()).base;
  fresnel_.average = fresnel_average(base, base.model.lobes[0].fresnel, {1e-9, 100'000}).value;
  albedo_ = lobe_albedo(surface(everything()).base);
}

void Look::read_spectrum(const Material& m) {
  const auto* from = std::get_if<FromSpec>(&m.from);
  if (!from || fresnel_.id != "conductor") return;
  const auto named =
      std::ranges::find(from->parameters, "metal", &GivenParameters::value_type::first);
  fresnel_.is_named = named != from->parameters.end();
  if (!fresnel_.is_named || !others_.empty()) return;
  fresnel_.spectrum = spectral(*find_metal(named->second.word));
  fresnel_.band_average = band_averages(*fresnel_.spectrum);
  const SpectralReflectance<double> f(*fresnel_.spectrum);
  auto at_normal = f(1);
  const auto at_edge = f(f82_cosine);
  // Gold's red is 1.04.  Within the gamut, half way between keeping the brightness and keeping the
  // hue is nearest: ΔE2000 0.75.
  const double most = std::ranges::max(at_normal);
  if (most > 1)
    for (double& x : at_normal) x /= std::sqrt(most);
  for (std::size_t c = 0; c < channels; ++c) {
    fresnel_.f0[c] = std::clamp(at_normal[c], 0.0, 1.0);
    fresnel_.f82_tint[c] = edge_tint(fresnel_.f0[c], at_edge[c]);
  }
}

void Look::read(const BoundModel& b, bool coated) {
  if (const auto* tangent = b.model.tangent()) turn_ = b.values[tangent->first] * degree;
  auto lobes = b.model.lobes;
  if (coated) {
    const Lobe& lobe = lobes.back();
    coat_.lobe = spec_of(lobe);
    coat_.parameters = settings_of(b, {&lobe.ndf, &lobe.masking, &lobe.fresnel});
    for (auto& s : coat_.parameters) s.name = parse_parameter(s.name).name;
    lobes.pop_back();
  }
  if (!b.model.diffuse.empty()) {
    const TermUse& term = b.model.diffuse[0];
    diffuse_.kind = name_of_term(term);
    diffuse_.coupled = catalogue()[term.term].coupled;
    if (diffuse_.coupled) diffuse_.kind.resize(diffuse_.kind.size() - coupled.size());
    diffuse_.own = foreign_term(term.term) != nullptr;
    const auto given = settings_of(b, {&term});
    if (!diffuse_.own) diffuse_.kd = std::ranges::find(given, "kd", &Setting::name)->values;
    diffuse_.alpha = number_of(given, "alpha", 1);
    // A file's function may call anything alpha; one number of that name is the lobe's, too.
    for (const auto& s : given)
      if (s.name == "kd" ? diffuse_.own : s.name != "alpha" || s.values.size() > 1)
        diffuse_.others.push_back(s);
    if (diffuse_.own)
      diffuse_.width = std::clamp(
          number_of(given, "alpha", std::pow(number_of(given, "roughness", 0.5), 2)), 0.01, 1.0);
  }
  if (lobes.empty()) return;
  const Lobe& first = lobes[0];
  first_.any = true;
  first_.lobe = spec_of(first);
  first_.shape = settings_of(b, {&first.ndf, &first.masking});
  first_.known = !family_of(first_.lobe.ndf).empty() && stands_for_smith(first_.lobe.masking);
  const double alpha = number_of(first_.shape, "alpha", 1);
  first_.alpha_x = number_of(first_.shape, "alpha_x", alpha);
  first_.alpha_y = number_of(first_.shape, "alpha_y", alpha);
  first_.gamma = number_of(first_.shape, "gamma", 2);
  read_fresnel(first_.lobe.fresnel, b, first.fresnel);
  for (std::size_t l = 1; l < lobes.size(); ++l) {
    auto given = settings_of(b, {&lobes[l].ndf, &lobes[l].masking, &lobes[l].fresnel});
    if (number_of(given, to_text({"weight", l}), 1) == 0) continue;  // there is none of it
    others_.push_back(spec_of(lobes[l]));
    for (auto& s : given) s.name = to_text({parse_parameter(s.name).name, others_.size()});
    others_settings_.insert(others_settings_.end(), given.begin(), given.end());
  }
}

void Look::read_fresnel(std::string_view id, const BoundModel& b, const TermUse& term) {
  fresnel_.parameters = settings_of(b, {&term});
  const auto f0 = reflectance(b, term, 1);
  if (id == "schlick" || (id == "schlick.f90" && number_of(fresnel_.parameters, "f90", 1) == 1)) {
    if (all_equal(f0) && f0[0] <= most_dielectric_f0) {
      const double eta = IorFromF0<double>::apply(std::array{f0[0]})[0];
      const std::vector<Setting> parameters{{"eta", {eta}}};
      const BoundModel exact =
          bound(model_of_lobe("ggx", "smith_ggx.correlated", "dielectric"), parameters);
      read_fresnel("dielectric", exact, exact.model.lobes[0].fresnel);
      return;
    }
    id = "schlick";
    fresnel_.parameters = {{"f0", f0}};
  }
  fresnel_.id = id;
  fresnel_.f0 = f0;
  fresnel_.has_schlick =
      id == "dielectric" || id == "conductor" || id == "gulbrandsen" || id == "lazanyi";
  const auto edge = reflectance(b, term, f82_cosine);
  for (std::size_t c = 0; c < channels; ++c) fresnel_.f82_tint.push_back(edge_tint(f0[c], edge[c]));
}

void Look::read(const GltfMaterial& m) {
  const double alpha = std::max(m.roughness * m.roughness, alpha_parameter.legal.low);
  const double f0_of_ior = F0FromIor<double>::apply(std::array{m.ior, 1.0})[0];
  const double f90 = m.specular + m.metallic * (1 - m.specular);
  std::vector<double> f0, kd;
  for (std::size_t c = 0; c < channels; ++c) {
    const double dielectric = std::min(f0_of_ior * m.specular_color[c], 1.0) * m.specular;
    f0.push_back(dielectric + m.metallic * (m.base_color[c] - dielectric));
    kd.push_back(m.base_color[c] * (1 - m.metallic));
  }
  std::vector<Setting> settings{{"alpha", {alpha}}, {"f0", f0}, {"f90", {f90}}, {"kd", kd}};
  const bool turned = m.anisotropy > 0;
  settings.push_back({"alpha_x", {alpha + (1 - alpha) * m.anisotropy * m.anisotropy}});
  settings.push_back({"alpha_y", {alpha}});
  const std::string ndf = turned ? "ggx_aniso" : "ggx";
  read(bound({"lambert.coupled", {{ndf, "smith_" + ndf + ".correlated", "schlick.f90"}}}, settings),
       false);
  turn_ = m.anisotropy_rotation;
  coat_.lobe = gltf_coat;
  coat_.parameters = {
      {"alpha",
       {std::max(m.clearcoat_roughness * m.clearcoat_roughness, alpha_parameter.legal.low)}},
      {"f0", {0.04}},
      {"weight", {m.clearcoat}}};
}

void Look::offer_forms() {
  using enum Form;
  const auto offer = [&](Effect e, std::vector<Form> forms, bool same = false,
                         std::string why = {}) {
    Offer& o = offers_[static_cast<std::size_t>(e)];
    o.forms = std::move(forms);
    o.same_as_exact = same ? o.forms.front() : o.forms.back();
    o.why = same || o.forms.size() == 1 ? std::move(why) : "";
  };
  const bool dark = !diffuse_.own && all_zero(diffuse_.kd);
  if (diffuse_.kind == "none")
    diffuse_ = {.kind = "disney", .coupled = first_.any, .kd = {0, 0, 0}};
  if (diffuse_.kind == "lambert" || diffuse_.kind == "disney") {
    std::vector<Form> kinds{no_diffuse, lambert};
    if (diffuse_.kind == "disney") kinds.push_back(disney);
    if (!first_.any) kinds.erase(kinds.begin());  // it is all that there is
    offer(Effect::diffuse, kinds, dark,
          first_.any ? "its diffuse albedo is 0" : "it is all there is");
  } else {
    offer(
        Effect::diffuse, {given_diffuse}, false,
        diffuse_.own ? "a function of a file has one form" : "its diffuse term is of another kind");
  }
  if (diffuse_.coupled)
    offer(Effect::coupling, {uncoupled, Form::coupled}, dark, "its diffuse albedo is 0");
  else
    offer(Effect::coupling, {uncoupled}, false, "it is given uncoupled");

  const bool gtr = first_.lobe.ndf == "gtr";
  const std::string as_given = first_.any ? "its lobe is of another kind" : "it has no lobe";
  if (first_.known && !gtr)
    offer(Effect::anisotropy, {isotropic, anisotropic}, first_.alpha_x == first_.alpha_y,
          "it is as wide along the tangent as across");
  else
    offer(Effect::anisotropy, {isotropic}, false, as_given);
  if (first_.known && gtr)
    offer(Effect::tail, {ggx_tail, gtr_tail}, first_.gamma == 2, "gamma is 2, which is GGX");
  else
    offer(Effect::tail, {ggx_tail}, false,
          first_.known ? "its distribution has no other tail" : as_given);
  if (first_.known) {
    offer(Effect::masking, {schlick_k, separable, correlated});
    std::vector<Form> kinds{uncompensated, turquin, fdez_aguera, kulla_conty};
    if (!gtr || first_.gamma == 2) kinds.push_back(Form::tabulated);  // which is GGX
    offer(Effect::compensation, kinds);
  } else {
    offer(Effect::masking, {first_.any ? correlated : schlick_k}, false, as_given);
    offer(Effect::compensation, {uncompensated}, false, as_given);
  }
  if (fresnel_.id == "f82")
    offer(Effect::fresnel, {schlick, f82});
  else if (fresnel_.has_schlick)
    offer(Effect::fresnel, {schlick, f82, exact_fresnel});
  else if (fresnel_.id == "schlick")
    offer(Effect::fresnel, {schlick}, false, "its F0 is all that is known of it");
  else
    offer(Effect::fresnel, {first_.any ? exact_fresnel : schlick}, false, as_given);
  offer(Effect::coat, {uncoated, coated}, coat_.absent, "its coat has no weight");
  if (fresnel_.spectrum)
    offer(Effect::spectrum, {rgb, Form::spectral});
  else
    offer(Effect::spectrum, {rgb}, false,
          fresnel_.is_named ? "its further lobes have none"
                            : "it is no metal whose spectrum is known");
  // Two sums stand for one lobe of GGX's kind, and for what is diffuse.
  if (!sky_)
    offer(Effect::environment, {split_sum}, false, "no environment lights it");
  else if (diffuse_.own || (first_.any && (!first_.known || !others_.empty())) ||
           !coat_.lobe.ndf.starts_with("ggx"))
    offer(Effect::environment, {quadrature}, false, "two sums do not stand for its lobes");
  else
    offer(Effect::environment, {split_sum, quadrature});
  offer(Effect::precision, {in_float, in_double});
}

Forms Look::exact() const {
  Forms f;
  for (std::size_t e = 0; e < effect_count; ++e) f.form[e] = offers_[e].forms.back();
  return f;
}
Forms Look::everything() const {
  return as_shipped(exact());
}
Forms Look::shipped() const {
  return as_shipped(structural());
}
bool Look::is_bounded() const {
  return !first_.any || exact()[Effect::compensation] == Form::tabulated;
}
Forms Look::structural() const {
  Forms f;
  for (std::size_t e = 0; e < effect_count; ++e) f.form[e] = offers_[e].same_as_exact;
  return f;
}

Forms Look::plain(Forms f) const {
  if (f[Effect::diffuse] == Form::no_diffuse)
    f[Effect::coupling] = offer(Effect::coupling).forms.front();
  if (f[Effect::fresnel] != Form::exact_fresnel)
    f[Effect::spectrum] = offer(Effect::spectrum).forms.front();
  return f;
}

Surface Look::surface(const Forms& forms) const {
  Surface s;
  ModelSpec spec;
  Settings settings;
  const auto diffuse = forms[Effect::diffuse];
  if (diffuse != Form::no_diffuse) {
    spec.diffuse = diffuse == Form::lambert ? "lambert" : diffuse_.kind;
    if (forms[Effect::coupling] == Form::coupled) spec.diffuse += coupled;
    if (!diffuse_.own) settings.push_back({"kd", diffuse_.kd});
    settings.insert(settings.end(), diffuse_.others.begin(), diffuse_.others.end());
  }
  if (first_.any) {
    LobeSpec lobe = first_.lobe;
    const double alpha = std::sqrt(first_.alpha_x * first_.alpha_y);
    if (first_.known) {
      const auto family = family_of(first_.lobe.ndf);
      const bool anisotropic = forms[Effect::anisotropy] == Form::anisotropic;
      const bool tail = family != "gtr" || forms[Effect::tail] == Form::gtr_tail;
      // GTR under a masking of GGX is held under that one, as it was given.
      const auto smith =
          tail && (family != "gtr" || lobe.masking.starts_with("smith_gtr")) ? family : "ggx";
      const auto masking = forms[Effect::masking];
      lobe.ndf = tail ? family : "ggx";
      if (anisotropic) lobe.ndf += aniso;
      if (masking == Form::schlick_k)
        lobe.masking = smith == "beckmann" ? "schlick_beckmann" : "schlick_ggx.half_alpha";
      else
        lobe.masking =
            fmt::format("smith_{}{}.{}", smith,
                        anisotropic && masking == Form::correlated ? aniso : "", name_of(masking));
      settings.push_back({"alpha_x", {first_.alpha_x}});
      settings.push_back({"alpha_y", {first_.alpha_y}});
      settings.push_back({"alpha", {alpha}});
      settings.push_back({"gamma", {first_.gamma}});
    } else {
      settings.insert(settings.end(), first_.shape.begin(), first_.shape.end());
    }
    const auto fresnel = forms[Effect::fresnel];
    if (fresnel == Form::exact_fresnel || name_of(fresnel) == fresnel_.id) {
      lobe.fresnel = fresnel_.id;
      settings.insert(settings.end(), fresnel_.parameters.begin(), fresnel_.parameters.end());
    } else {
      lobe.fresnel = name_of(fresnel);
      settings.push_back({"f0", fresnel_.f0});
      settings.push_back({"f82_tint", fresnel_.f82_tint});
    }
    spec.lobes.push_back(std::move(lobe));
  }
  if (std::ranges::find(settings, "alpha", &Setting::name) == settings.end())
    settings.push_back({"alpha", {diffuse_.alpha}});
  settings.insert(settings.end(), others_settings_.begin(), others_settings_.end());
  spec.lobes.insert(spec.lobes.end(), others_.begin(), others_.end());
  s.base = bound(spec, settings);
  if (forms[Effect::coat] == Form::coated) s.coat = bound({"", {coat_.lobe}}, coat_.parameters);
  const bool equations = forms[Effect::fresnel] == Form::exact_fresnel;
  if (equations && forms[Effect::spectrum] == Form::spectral) s.spectrum = fresnel_.spectrum;
  s.single = forms[Effect::precision] == Form::in_float;

  if (sky_ && forms[Effect::environment] == Form::split_sum) s.image_lit = image_lit(s, forms);

  auto& m = s.multiple;
  m.form = forms[Effect::compensation];
  m.albedo = albedo_.curve;
  if (m.form == Form::uncompensated) return s;
  if (m.form == Form::tabulated) {
    m.lobe = tabulated();
    return s;
  }
  const bool by_channel = equations && !s.spectrum;
  if (m.form == Form::kulla_conty) {
    const bool by_band = fresnel_.spectrum && !by_channel;
    auto strength = by_band ? fresnel_.band_average : fresnel_.average;
    for (double& x : strength) {
      const std::array p{0.0, 0.0, albedo_.average, x};
      x = KullaContyLobe<double>::apply(p)[0];
    }
    if (by_band) strength = colour(*fresnel_.spectrum, strength);
    std::ranges::copy(strength, m.strength.begin());
    return s;
  }
  const auto f0 = by_channel ? reflectance(s.base, s.base.model.lobes[0].fresnel, 1) : fresnel_.f0;
  for (std::size_t c = 0; c < channels; ++c)
    m.strength[c] = m.form == Form::turquin ? f0[c] : schlick_average<double>(f0[c]);
  return s;
}

std::shared_ptr<const TabulatedLobe> Look::tabulated() const {
  Forms forms = structural();
  forms[Effect::compensation] = Form::uncompensated;
  BoundModel lobe = surface(forms).base;
  lobe.model.diffuse.clear();
  lobe.model.lobes.resize(1);
  if (!fresnel_.spectrum) return tabulated_lobe(lobe, red_green_blue);
  const auto& metal = *fresnel_.spectrum;
  std::vector<ColourOfChannel> colours;
  for (std::size_t b = 0; b < SpectralMetal<double>::bands; ++b)
    colours.push_back({metal.weight[0][b], metal.weight[1][b], metal.weight[2][b]});
  auto settings = settings_of(lobe, {&lobe.model.lobes[0].ndf});
  settings.push_back({"eta", {metal.eta.begin(), metal.eta.end()}});
  settings.push_back({"k", {metal.k.begin(), metal.k.end()}});
  return tabulated_lobe(
      bind_model(ModelSpec{"", {spec_of(lobe.model.lobes[0])}}, settings, colours.size()), colours);
}

std::shared_ptr<const ImageLit> Look::image_lit(const Surface& s, const Forms& forms) const {
  const auto rgb = [](const std::vector<double>& v) {
    return v.size() == 1 ? Rgb{v[0], v[0], v[0]} : Rgb{v[0], v[1], v[2]};
  };
  ImageLitParts parts;
  if (first_.any) {
    const auto masking = forms[Effect::masking];
    parts.lobe = ImageLitParts::Layer{masking == Form::schlick_k
                                          ? std::string("schlick_ggx.half_alpha")
                                          : fmt::format("smith_ggx.{}", name_of(masking)),
                                      std::sqrt(first_.alpha_x * first_.alpha_y), rgb(fresnel_.f0)};
  }
  if (s.coat) {
    const auto& fresnel = s.coat->model.lobes[0].fresnel;
    auto f0 = reflectance(*s.coat, fresnel, 1);
    const double weight = number_of(coat_.parameters, "weight", 1);
    if (weight > 0)
      for (double& x : f0) x /= weight;
    parts.coat = ImageLitParts::Layer{"smith_ggx.correlated", coat_.mean_width, rgb(f0), weight};
  }
  if (!s.base.model.diffuse.empty()) parts.kd = rgb(diffuse_.kd);
  parts.coupled = forms[Effect::coupling] == Form::coupled;
  parts.compensated = forms[Effect::compensation] != Form::uncompensated;
  return std::make_shared<const ImageLit>(*sky_, std::move(parts));
}

std::vector<Look> looks_of(const Scene& s) {
  std::shared_ptr<const ImageLight> sky;
  for (const auto& light : s.lights)
    if (const auto* e = std::get_if<EnvironmentLight>(&light))
      sky = std::make_shared<ImageLight>(*e);
  std::vector<Look> looks;
  for (const auto& m : s.materials) looks.emplace_back(m, sky);
  return looks;
}

std::vector<double> Look::widths() const {
  std::vector<double> all;
  if (first_.any) all.push_back(std::max(first_.alpha_x, first_.alpha_y));
  if (diffuse_.own) all.push_back(diffuse_.width);
  if (!coat_.absent) all.push_back(coat_.width);
  return all;
}

}  // namespace gonio::scene
