// An audit of a file as people and programs read it.
#include <cmath>
#include <numbers>

#include "base/json/describe.h"
#include "brdf/model/own_files.h"
#include "reports/finding/words.h"
#include "reports/own/audit_file.h"
#include "reports/own/parameters.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gonio {
namespace {

std::string width_text(const std::string& width, double power) {
  return width.empty() ? "" : ", alpha = " + alpha_text(width, power);
}

std::string nearest_text(const FunctionAudit& a) {
  const auto& n = *a.nearest;
  const auto id = catalogue()[n.term].id();
  const std::string map = width_text(n.width ? std::string(n.width->name) : "", n.power);
  if (!is_same(n)) return fmt::format("{}{}: up to {} apart", id, map, rounded_up(n.difference));
  return fmt::format("{}{}{}", id, map, n.of_one ? ", by one direction" : "");
}

/// \param line  adds a line with a name
void energy_lines(const FunctionAudit& a, const auto& line) {
  const auto& e = *a.energy;
  constexpr double rounded = 1e-3;
  const auto gains = [](const FoundAt& f) { return f.value > 1 + rounded; };
  if (std::isnan(e.albedo.value)) {
    line("energy", "the albedo has no value at " + e.albedo.at);
  } else if (!gains(e.albedo)) {
    line("energy", fmt::format("gains none: albedo at most {:.4g} up to 88°, at {}", e.albedo.value,
                               e.albedo.at));
  } else {
    line("energy", fmt::format("gains: albedo {:.4g} at {}", e.albedo.value, e.albedo.at));
    if (a.of.function->unclear)
      line("", fmt::format("albedo {:.4g} there if the value includes π",
                           e.albedo.value / std::numbers::pi));
    if (const double highlight = e.without_diffuse.value_or(0),
        diffuse = e.albedo.value - highlight;
        highlight > rounded && diffuse > rounded && std::max(highlight, diffuse) < 1 + rounded)
      line("", fmt::format("only the sum exceeds 1: the highlight returns {:.3g} and the diffuse "
                           "part {:.3g}; multiply the diffuse part by 1 − the highlight's albedo, "
                           "since 1 − F(VoH) takes too little",
                           highlight, diffuse));
  }
  line("repeat it", e.albedo.repeat);
  if (e.usual) line("", fmt::format("albedo {:.4g} at {}", e.usual->value, e.usual->at));
  if (const auto& h = a.highlight)
    line("", fmt::format("the highlight with F0 = 1 returns {:.3g} along the normal at {}, "
                         "expected 1 where it is smooth",
                         h->value, h->at));
  line("returns",
       fmt::format("at least {:.3g} % of the light with colours at their upper bounds, at {}",
                   100 * e.darkest.value, e.darkest.at));
}

}  // namespace

std::string to_json(const std::vector<FunctionAudit>& all) {
  Json rows = Json::array();
  const auto found = [](const std::optional<FoundAt>& w) {
    if (!w) return Json();
    Json j{{"value", w->value}, {"at", w->at}};
    if (!w->repeat.empty()) j["repeat"] = w->repeat;
    return j;
  };
  for (const auto& a : all) {
    Json j{{"function", a.of.entry.function}, {"line", a.of.entry.line}};
    if (!a.of.function) {
      j["refused"] = a.of.entry.refused;
      rows.push_back(j);
      continue;
    }
    j["stands_for"] = name_of(a.of.function->stands);
    j["includes"] = a.of.function->includes;
    j["guessed"] = a.of.function->guessed;
    j["unclear"] = a.of.function->unclear;
    j["operations"] = a.of.operations.total();
    j["normalisation"] = found(a.laws.normalisation);
    j["reciprocity"] = found(a.laws.reciprocity);
    const auto& e = a.energy;
    j["albedo"] = e ? found(e->albedo) : Json();
    j["part"] = e ? found(e->part) : Json();
    j["usual"] = e ? found(e->usual) : Json();
    j["without_diffuse"] = e && e->without_diffuse ? Json(*e->without_diffuse) : Json();
    j["darkest"] = e ? found(e->darkest) : Json();
    j["highlight"] = found(a.highlight);
    j["lowest"] = found(a.laws.lowest);
    j["above_one"] = found(a.laws.above_one);
    j["not_finite"] = a.laws.not_finite;
    j["not_finite_at"] = a.laws.not_finite ? Json(a.laws.not_finite_at) : Json();
    j["half"] = a.half;
    j["nearest"] = Json();
    if (a.nearest)
      j["nearest"] = {{"id", catalogue()[a.nearest->term].id()},
                      {"same", is_same(*a.nearest)},
                      {"width", a.nearest->width ? Json(a.nearest->width->name) : Json()},
                      {"power", a.nearest->power},
                      {"factor", a.nearest->factor},
                      {"difference", a.nearest->difference},
                      {"operations", operations_in_one(a.nearest->term)}};
    j["model"] = Json();
    if (a.model)
      j["model"] = {{"spec", a.model->spec},
                    {"width", a.width_of_model},
                    {"power", a.model->power},
                    {"masking_power", a.model->masking_power},
                    {"factor", a.model->factor},
                    {"operations", a.model->operations},
                    {"lacks_diffuse", a.model->lacks_diffuse}};
    j["of_the_kind"] = Json();
    if (const auto& k = a.of_the_kind)
      j["of_the_kind"] = {{"spec", k->spec}, {"operations", k->operations}};
    j["no_model"] = a.no_model.empty() ? Json() : Json(a.no_model);
    j["slips"] = a.slips;
    j["to_check"] = a.to_check;
    j["not_looked_at"] = a.not_looked_at;
    rows.push_back(j);
  }
  Json document{{"rows", rows}};
  for (const auto& a : all)
    if (const auto& f = a.of.function; f && !document.contains(own_files_key))
      document[std::string(own_files_key)] = json_of(std::vector{OwnFile{f->name.file, f->sha256}});
  return text_of(document);
}

std::string text_of(const FunctionAudit& a) {
  if (!a.of.function) return fmt::format("{}: {}\n", a.of.entry.function, a.of.entry.refused);
  const auto& f = *a.of.function;
  std::string s =
      fmt::format("{}{}: {} operations a sample\n", foreign::text_of(f.name),
                  f.line > 0 ? fmt::format(", line {}", f.line) : "", a.of.operations.total());
  const auto line = [&](const char* name, const std::string& text) {
    if (!text.empty()) s += fmt::format("  {:<16}{}\n", name, text);
  };
  if (!is_audited(f)) {
    line("not audited",
         takes_direction(f)
             ? "it takes a view and no light, as an albedo does: it is no BRDF. Where an argument "
               "is the light's, say which: --argument u=nol"
             : "it takes no direction. Where an argument is a cosine, say which: --argument u=voh");
    return s;
  }
  if (f.stands == foreign::Stands::lobe)
    line("includes", f.includes + (f.unclear   ? " (not clear: --includes pi or nothing says it)"
                                   : f.guessed ? " (guessed; --includes says it)"
                                               : ""));
  if (const auto& n = a.laws.normalisation)
    line("∫ D cos θ", std::abs(n->value - 1) < 1e-4
                          ? "1: normalised"
                          : fmt::format("{:.5g} at {}, expected 1", n->value, n->at));
  if (a.energy) energy_lines(a, line);
  if (const auto& r = a.laws.reciprocity)
    line("reciprocity",
         r->value < 1e-6 ? "kept" : fmt::format("off by {:.2g} at {}", r->value, r->at));
  if (a.laws.lowest)
    line("negative", fmt::format("{:.3g} at {}", a.laws.lowest->value, a.laws.lowest->at));
  if (a.laws.above_one)
    line("above 1", fmt::format("{:.4g} at {}: it reflects more than all light",
                                a.laws.above_one->value, a.laws.above_one->at));
  if (a.laws.not_finite)
    line("without a value", fmt::format("{} inputs, in double; the first at {}", a.laws.not_finite,
                                        a.laws.not_finite_at));
  line("in half", a.half);
  if (a.nearest) {
    line(is_same(*a.nearest) ? "it is" : "nearest", nearest_text(a));
    line("beside ours", fmt::format("{} operations{}, ours {}", a.operations_in_one,
                                    channels_text(f, true), operations_in_one(a.nearest->term)));
  }
  if (const auto& m = a.model) {
    line("D and V",
         fmt::format("those of {}{}{}{}{}{}", m->spec, width_text(a.width_of_model, m->power),
                     m->masking_power == m->power
                         ? ""
                         : " in D" + width_text(a.width_of_model, m->masking_power) + " in V",
                     m->f0.empty() ? "" : ", F0 = " + m->f0,
                     f.anisotropic ? "; without anisotropy" : "",
                     m->other_fresnel ? "; its Fresnel term is that of none of ours" : ""));
    line("beside ours",
         fmt::format("{} operations, ours {}{}", a.of.operations.total(), m->operations,
                     m->lacks_diffuse ? " with Lambert in place of its diffuse part" : ""));
  }
  if (const auto& k = a.of_the_kind)
    line("beside ours",
         fmt::format("{} operations{}, {} has {}: ours of its kind, not the same form",
                     k->own_operations, channels_text(f, k->spec.starts_with("diffuse.")), k->spec,
                     k->operations));
  if (!a.no_model.empty()) line("none of ours", a.no_model);
  for (const auto& slip : a.slips) line("likely slip", slip);
  for (const auto& c : a.to_check) line("check", c);
  for (const auto& n : f.notes) line("note", fmt::format("line {}: {}", n.line, n.text));
  for (const auto& n : a.not_looked_at) line("not looked at", n);
  return s;
}

}  // namespace gonio
