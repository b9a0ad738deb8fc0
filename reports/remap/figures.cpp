// The pictures of the remap report.
#include <algorithm>

#include "brdf/catalogue/registry.h"
#include "reports/finding/names.h"
#include "reports/remap/remap.h"

#include <fmt/format.h>

namespace gonio {
namespace {

std::string distribution(std::string_view ndf) {
  return ndf == "ndf.beckmann" ? "Beckmann" : "GGX";
}
std::string name_of(std::string_view form) {
  return std::string(short_id(form));
}

// --- Maps ----------------------------------------------------------------------------------------

FigureMap map_over_cosines(const RemapRows& r, std::string family, FigureChoices choices) {
  auto m = make_map(std::move(family), std::move(choices));
  m.x.label = "NoL";
  m.y.label = "NoV";
  for (auto* axis : {&m.x, &m.y}) {
    axis->at = r.cosines;
    axis->from = 0;
    axis->to = 1;
  }
  return m;
}

void add_maps(Pictures& p, const RemapRows& r) {
  for (const auto& f : r.forms) {
    auto own = map_over_cosines(r, "g2", {{"form", name_of(f.form)}});
    own.title = fmt::format("G2 of {}", in_text(f.form));
    own.note = f.reads_half ? "averaged over azimuths" : "";
    own.value = "G2";
    own.limit = 1;
    for (const auto& at : f.at) {
      if (at.g2.empty()) continue;
      own.slices.push_back(fmt::format("roughness {:g}", at.roughness));
      std::ranges::copy(at.g2, std::back_inserter(own.values));
    }
    if (own.slices.empty()) continue;
    for (const auto& reference : references_of(f.ndf)) {
      const auto* smith = find_form(r.forms, reference);
      if (!smith || reference == f.form) continue;
      auto off = map_over_cosines(r, "masking_error",
                                  {{"form", name_of(f.form)}, {"reference", last_word(reference)}});
      off.title = fmt::format("{} against {}", name_of_form(f.form), in_text(reference));
      off.note = "relative error of G2; below 0 it masks too much";
      off.value = "G2 / Smith − 1 [%]";
      off.diverging = true;
      off.scale = FigureMap::Scale::root;
      off.slices = own.slices;
      for (std::size_t k = 0; k < f.at.size(); ++k)
        for (std::size_t i = 0; i < f.at[k].g2.size(); ++i)
          off.values.push_back(100 * (f.at[k].g2[i] / smith->at[k].g2[i] - 1));
      p.maps.push_back(std::move(off));
    }
    p.maps.push_back(std::move(own));
  }
}

// --- Forms beside each other

/// Curves of a value of the rows, one for each form of a distribution.
template <class Value>
std::vector<FigureCurve> curves_of(const RemapRows& r,
                                   std::string_view ndf,
                                   std::string_view reference,
                                   Value value) {
  std::vector<FigureCurve> out;
  for (const auto& f : r.forms) {
    if (f.ndf != ndf || f.form == reference) continue;
    FigureCurve c{name_of(f.form), {}, {}};
    c.label = name_of_form(f.form);
    for (const auto& row : r.rows)
      if (row.form == f.form && row.reference == reference) {
        c.x.push_back(row.roughness);
        c.y.push_back(value(row));
      }
    if (!c.x.empty()) out.push_back(std::move(c));
  }
  return out;
}

void add_comparisons(Pictures& p, const RemapRows& r, std::string_view ndf) {
  std::vector<double> roughness;
  for (const auto& row : r.rows) roughness.push_back(row.roughness);
  std::ranges::sort(roughness);
  roughness.erase(std::unique(roughness.begin(), roughness.end()), roughness.end());
  for (const auto& reference : references_of(ndf)) {
    const FigureChoices choices{{"distribution", distribution(ndf)},
                                {"reference", last_word(reference)}};
    const auto put = [&](Figure f) {
      if (!f.curves.empty()) p.figures.push_back(std::move(f));
    };
    auto rms = make_figure("rms", choices);
    rms.title = "RMS of G2 − Smith";
    rms.note = fmt::format("over NoL, NoV in [0.05, 1]²; against {}", in_text(reference));
    rms.x = over_roughness();
    rms.y = {"RMS of G2 − Smith"};
    rms.curves = curves_of(r, ndf, reference, [](const RemapRow& x) { return x.rms; });
    put(std::move(rms));
    const auto like = [&](const char* by, auto value) {
      auto with_by = choices;
      with_by.emplace_back("by", by);
      auto f = make_figure("behaves_like", with_by);
      f.title = "Behaves like roughness …";
      f.note = fmt::format("of {}, by its {}", in_text(reference), by);
      f.x = over_roughness();
      f.y = {"roughness that it behaves like"};
      f.curves = curves_of(r, ndf, reference, value);
      if (!f.curves.empty())
        f.curves.push_back({"as it should", roughness, roughness, FigureCurve::Kind::line, true});
      put(std::move(f));
    };
    like("G2", [](const RemapRow& x) { return x.by_g2.roughness; });
    like("E", [](const RemapRow& x) { return x.by_albedo.roughness; });
  }
}

/// E(μ) of every form of a distribution, at each roughness whose G2 is kept.
void add_furnaces(Pictures& p, const RemapRows& r, std::string_view ndf) {
  const auto references = references_of(ndf);
  for (std::size_t k = 0; !r.forms.empty() && k < r.forms[0].at.size(); ++k) {
    const double roughness = r.forms[0].at[k].roughness;
    auto f = make_figure("furnace", {{"distribution", distribution(ndf)},
                                     {"roughness", fmt::format("{:g}", roughness)}});
    f.title = "Furnace: E(μ) at F = 1";
    f.note = fmt::format("roughness {:g}", roughness);
    f.x = {"μ", false, 0, 1};
    f.y = {"E"};
    for (const auto& form : r.forms) {
      if (form.ndf != ndf || form.at[k].g2.empty()) continue;
      f.curves.push_back({name_of(form.form), r.mu, form.at[k].albedo, FigureCurve::Kind::line,
                          std::ranges::find(references, form.form) != references.end()});
      f.curves.back().label = name_of_form(form.form);
    }
    if (!f.curves.empty()) p.figures.push_back(std::move(f));
  }
}

// --- In the wrong place, and in place of V F

void add_uses(Pictures& p, const RemapRows& r) {
  for (const std::string_view light : {"even", "single"})
    for (const double mu : r.mu) {
      auto f =
          make_figure("each_k", {{"light", std::string(light)}, {"mu", fmt::format("{:g}", mu)}});
      const bool even = light == "even";
      f.title = even ? "Even environment" : "A single light in the mirror direction";
      f.note = fmt::format("{}μ = {:g}", even ? "F = 1, " : "NoL = NoV = ", mu);
      f.x = over_roughness();
      f.y = {even ? "E" : "G2"};
      FigureCurve separable{"Smith, separable", {}, {}, FigureCurve::Kind::line, true},
          correlated{"Smith, correlated", {}, {}, FigureCurve::Kind::line, true};
      for (const auto& [form, name] : {std::pair{"masking.schlick_ggx.direct", "k = (r+1)²/8"},
                                       std::pair{"masking.schlick_ggx.half_alpha", "k = r²/2"}}) {
        FigureCurve c{name, {}, {}};
        const bool first = separable.x.empty();
        for (const auto& u : r.uses) {
          if (u.form != form || u.light != light || u.mu != mu) continue;
          c.x.push_back(u.roughness);
          c.y.push_back(u.value);
          if (!first) continue;
          for (auto* smith : {&separable, &correlated}) smith->x.push_back(u.roughness);
          separable.y.push_back(u.separable);
          correlated.y.push_back(u.correlated);
        }
        if (!c.x.empty()) f.curves.push_back(std::move(c));
      }
      if (f.curves.empty()) continue;
      f.curves.push_back(std::move(separable));
      f.curves.push_back(std::move(correlated));
      p.figures.push_back(std::move(f));
    }
}

void add_vf(Pictures& p, const RemapRows& r) {
  const auto same = [](const RemapVf& a) {
    return [&a](const RemapVf& b) {
      return a.form == b.form && a.fresnel == b.fresnel && a.over == b.over;
    };
  };
  for (auto at = r.vf.begin(); at != r.vf.end(); ++at) {
    if (std::find_if(r.vf.begin(), at, same(*at)) != at) continue;  // shown already
    auto f = make_figure(
        "in_place_of_vf",
        {{"form", name_of(at->form)}, {"fresnel", at->fresnel}, {"over", std::string(at->over)}});
    f.title = at->over == "all" ? "All directions" : "Mirror direction";
    f.note = fmt::format("{}; {} over V F, {}", at->over == "all" ? "azimuths even" : "h = n",
                         name_of_form(at->form), at->fresnel);
    f.x = over_roughness();
    f.y = {"ratio", true};
    FigureCurve mean{"geometric mean", {}, {}}, least{"least", {}, {}}, most{"most", {}, {}};
    least.dashed = most.dashed = true;
    for (const auto& v : r.vf) {
      if (!same(*at)(v)) continue;
      for (auto* c : {&mean, &least, &most}) c->x.push_back(v.roughness);
      mean.y.push_back(v.bias);
      least.y.push_back(v.least);
      most.y.push_back(v.most);
    }
    f.curves = {std::move(mean), std::move(least), std::move(most)};
    p.figures.push_back(std::move(f));
  }
}

}  // namespace

std::string last_word(std::string_view id) {
  return std::string(id.substr(id.rfind('.') + 1));
}

Pictures pictures(const RemapRows& r) {
  Pictures p;
  add_maps(p, r);
  for (const std::string_view ndf : {"ndf.ggx", "ndf.beckmann"}) {
    add_comparisons(p, r, ndf);
    add_furnaces(p, r, ndf);
  }
  add_uses(p, r);
  add_vf(p, r);
  return p;
}

}  // namespace gonio
