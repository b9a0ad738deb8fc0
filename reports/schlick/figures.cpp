// The pictures of the report on Schlick's approximation.
#include <algorithm>
#include <cmath>
#include <functional>

#include "brdf/catalogue/registry.h"
#include "reports/finding/names.h"
#include "reports/schlick/schlick.h"

#include <fmt/format.h>

namespace gonio {
namespace {

constexpr std::string_view exact = "exact";

std::string side_of(std::string_view kind) {
  return kind == "dielectric" ? "from outside" : "from inside";
}
bool is_side(std::string_view kind) {
  return kind == "dielectric" || kind == "dielectric_inside";
}
std::string kind_name(std::string_view kind) {
  if (kind == "dielectric") return "at 550 nm";
  if (kind == "dielectric_inside") return "from inside";
  return kind == "metal" ? "three wavelengths" : "spectrum in linear RGB";
}
std::string of_channel(const std::string& material, const std::string& channel) {
  return channel.empty() ? material : material + ", " + channel;
}

// --- By angle and index --------------------------------------------------------------------------

FigureMap map_of(const SchlickRows& r, const FresnelMap& m, std::string family) {
  auto out = make_map(std::move(family),
                      {{"form", std::string(short_id(m.form))}, {"side", side_of(m.kind)}});
  out.x = {"θ [°], angle from the facet's normal", r.maps.theta_deg};
  out.y = {"index of refraction", r.maps.ior};
  // [index][angle] there, by angle and then by index here
  for (std::size_t t = 0; t < r.maps.theta_deg.size(); ++t)
    for (std::size_t n = 0; n < r.maps.ior.size(); ++n)
      out.values.push_back(m.error[n * r.maps.theta_deg.size() + t]);
  return out;
}

void add_maps(Pictures& p, const SchlickRows& r) {
  const FresnelMap* truth = nullptr;  // of the same side: comes before its forms
  for (const auto& m : r.maps.maps) {
    if (m.form == exact) {
      truth = &m;
      auto& map = p.maps.emplace_back(map_of(r, m, "exact_reflectance"));
      map.title = "Exact F, " + side_of(m.kind);
      map.value = "F";
      map.limit = 1;
      continue;
    }
    const std::string name =
        fmt::format("{} against exact Fresnel, {}", name_of_form(m.form), side_of(m.kind));
    // Small errors are seen beside great ones, and forms beside each other: the root, up to 1.
    const auto put = [&](const FresnelMap& errors, const char* family, const char* value) {
      auto& map = p.maps.emplace_back(map_of(r, errors, family));
      map.title = name;
      map.note = "by angle and index; the scale of colours grows as the square";
      map.value = value;
      map.diverging = true;
      map.scale = FigureMap::Scale::root;
      map.limit = 1;
    };
    put(m, "error_by_angle", "F − exact");
    auto relative = m;
    for (std::size_t k = 0; k < relative.error.size(); ++k) relative.error[k] /= truth->error[k];
    put(relative, "relative_error_by_angle", "(F − exact)/exact");
  }
}

void add_errors_by_index(Pictures& p, const SchlickRows& r) {
  struct Curves {
    std::string form, kind;
    std::vector<double> ior, most, rms;
  };
  std::vector<Curves> all;
  for (const auto& row : r.smooth) {
    if (!is_side(row.kind) || !row.name.starts_with("IOR ")) continue;
    auto at = std::ranges::find_if(
        all, [&](const Curves& c) { return c.form == row.form && c.kind == row.kind; });
    if (at == all.end()) at = all.insert(all.end(), {row.form, row.kind, {}, {}, {}});
    at->ior.push_back(row.kind == "dielectric" ? row.eta : 1 / row.eta);
    at->most.push_back(row.max_abs);
    at->rms.push_back(row.rms);
  }
  for (const auto& c : all) {
    auto f = make_figure("error_by_index",
                         {{"form", std::string(short_id(c.form))}, {"side", side_of(c.kind)}});
    f.title = "Error by index";
    f.note = fmt::format("{}, {}", name_of_form(c.form), side_of(c.kind));
    f.x = {"index of refraction", false, 1, 3};
    f.y = {"error of F", true};
    const auto reference = std::ranges::find_if(
        all, [&](const Curves& o) { return o.form == form_id::schlick && o.kind == c.kind; });
    if (c.form != form_id::schlick && reference != all.end())
      f.curves.push_back(
          {"schlick, most", reference->ior, reference->most, FigureCurve::Kind::line, true});
    f.curves.push_back({"most |error|", c.ior, c.most});
    f.curves.push_back({"RMS", c.ior, c.rms});
    p.figures.push_back(std::move(f));
  }
}

// --- Forms beside each other

struct Named {
  std::string form;
  std::vector<double> y;
};
/// Forms that come to the same on a surface are one curve, under both names.
std::vector<FigureCurve> distinct(const std::vector<double>& x, const std::vector<Named>& forms) {
  std::vector<FigureCurve> out;
  for (const auto& f : forms) {
    const auto same = std::ranges::find_if(out, [&](const FigureCurve& c) {
      return std::ranges::equal(c.y, f.y,
                                [](double a, double b) { return std::abs(a - b) < 1e-9; });
    });
    const std::string name(short_id(f.form));
    if (same != out.end()) {
      if (same->look.empty()) same->look = same->name;
      same->name += " = " + name;
      same->label += " = " + name_of_form(f.form);
      same->dashed = same->dashed || f.form == exact;
    } else {
      out.push_back({name, x, f.y, FigureCurve::Kind::line, f.form == exact});
      out.back().label = name_of_form(f.form);
    }
  }
  return out;
}

/// Runs of entries that go together, in their order.
template <class T, class Same, class Use>
void each_run(const std::vector<T>& list, Same same, Use use) {
  for (auto from = list.begin(); from != list.end();) {
    const auto to = std::find_if(from, list.end(), [&](const T& x) { return !same(*from, x); });
    use(std::vector<T>(from, to));
    from = to;
  }
}

void add_materials(Pictures& p, const SchlickRows& r) {
  const auto same = [](const FresnelCurve& a, const FresnelCurve& b) {
    return a.material == b.material && a.kind == b.kind && a.channel == b.channel;
  };
  each_run(r.curves.curves, same, [&](const std::vector<FresnelCurve>& list) {
    const auto& of = list.front();  // "exact" stands first
    std::vector<Named> values, errors;
    for (const auto& c : list) {
      values.push_back({c.form, c.value});
      if (c.form == exact || c.form.find("linear") != c.form.npos) continue;
      Named error{c.form, c.value};
      for (std::size_t i = 0; i < error.y.size(); ++i) error.y[i] -= of.value[i];
      if (std::ranges::any_of(error.y, [](double v) { return std::abs(v) >= 1e-9; }))
        errors.push_back(std::move(error));
    }
    const FigureChoices choices{
        {"material", of.material}, {"kind", kind_name(of.kind)}, {"channel", of.channel}};
    auto f = make_figure("reflectance", choices);
    f.title = "F(θ)";
    f.note = fmt::format("{}, {}", of_channel(of.material, of.channel), kind_name(of.kind));
    f.x = {"θ [°]", false, 0, 90};
    f.y = {"F"};
    f.curves = distinct(r.curves.theta_deg, values);
    p.figures.push_back(f);
    auto e = make_figure("reflectance_error", choices);
    e.title = "F − exact";
    e.note = f.note + "; without the linear form, and those that are exact";
    e.x = f.x;
    e.y = {"F − exact"};
    e.curves = distinct(r.curves.theta_deg, errors);
    p.figures.push_back(std::move(e));
  });
}

bool left_out(const std::string& form) {  // the one dwarfs the others, the other is exact
  return form.find("linear") != form.npos || form.find("gulbrandsen") != form.npos;
}
std::string mu_text(double mu) {
  return fmt::format("{:g}", mu);
}

void add_rough(Pictures& p, const SchlickRows& r) {
  std::vector<FresnelAlbedo> albedos = r.rough.albedos;
  const auto key = [](const auto& a) { return std::tie(a.material, a.channel, a.mu); };
  std::ranges::stable_sort(albedos, {}, key);
  each_run(
      albedos, [&](const auto& a, const auto& b) { return key(a) == key(b); },
      [&](const std::vector<FresnelAlbedo>& list) {
        const auto& of = list.front();
        const FigureChoices choices{
            {"material", of.material}, {"channel", of.channel}, {"mu", mu_text(of.mu)}};
        const auto put = [&](const char* family, const char* title, const char* y,
                             const std::function<double(double, double)>& off) {
          std::vector<Named> forms;
          for (const auto& a : list) {
            if (left_out(a.form)) continue;
            Named one{a.form, a.albedo};
            for (std::size_t i = 0; i < one.y.size(); ++i) one.y[i] = off(a.albedo[i], a.exact[i]);
            forms.push_back(std::move(one));
          }
          auto f = make_figure(family, choices);
          f.title = title;
          f.note = fmt::format("{}, μ = {}", of_channel(of.material, of.channel), mu_text(of.mu));
          f.x = over_roughness();
          f.y = {y};
          f.curves = distinct(r.rough.roughness, forms);
          p.figures.push_back(std::move(f));
        };
        put("albedo_error", "E − exact", "error of E", [](double a, double e) { return a - e; });
        put("albedo_relative_error", "E/exact − 1", "relative error of E [%]",
            [](double a, double e) { return 100 * (a / e - 1); });
      });
}

void add_colours(Pictures& p, const SchlickRows& r) {
  std::vector<FresnelColour> colours = r.rough.colours;
  std::erase_if(colours, [](const FresnelColour& c) {
    return std::ranges::find(albedo_mus, c.mu) == albedo_mus.end();
  });
  const auto key = [](const auto& c) { return std::tie(c.material, c.mu); };
  std::ranges::stable_sort(colours, {}, key);
  each_run(
      colours, [&](const auto& a, const auto& b) { return key(a) == key(b); },
      [&](const std::vector<FresnelColour>& list) {
        const auto& of = list.front();
        std::vector<Named> forms;
        for (const auto& c : list)
          if (!left_out(c.form)) forms.push_back({c.form, c.delta_e});
        auto f =
            make_figure("colour_difference", {{"material", of.material}, {"mu", mu_text(of.mu)}});
        f.title = "ΔE2000";
        f.note = fmt::format("{}, μ = {}; of the colours under D65, all channels", of.material,
                             mu_text(of.mu));
        f.x = over_roughness();
        f.y = {"ΔE2000"};
        f.curves = distinct(r.rough.roughness, forms);
        p.figures.push_back(std::move(f));
      });
}

}  // namespace

Pictures pictures(const SchlickRows& r) {
  Pictures p;
  add_maps(p, r);
  add_errors_by_index(p, r);
  add_materials(p, r);
  add_rough(p, r);
  add_colours(p, r);
  return p;
}

}  // namespace gonio
