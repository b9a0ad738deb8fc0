// The diffuse forms in sentences: made from their rows alone.
#include <algorithm>
#include <cmath>

#include "reports/diffuse/diffuse.h"
#include "reports/finding/words.h"

#include <fmt/format.h>

namespace gonio {
namespace {

constexpr std::string_view lambert = "diffuse.lambert", disney = "diffuse.disney",
                           eon = "diffuse.eon";

/// Greatest ΔE2000, never below itself.
std::string delta(double x) {
  return rounded_up(x);
}

/// Forms that reflect more than they receive, the brightest first.
void light_is_made(Findings& to, const DiffuseRows& r) {
  std::vector<const DiffuseForm*> makers;
  for (const auto& f : r.forms)
    if (f.most_albedo > 1 + 1e-4) makers.push_back(&f);
  if (makers.empty()) return;
  const auto& most =
      **std::ranges::max_element(makers, {}, [](const DiffuseForm* f) { return f->most_albedo; });
  to.headline = fmt::format(
      "{}'s diffuse makes light: a white surface reflects {:.3g} times what it receives, at {}.",
      most.name, most.most_albedo, place(most.most_roughness, most.most_mu));
  to.say(to.headline);
  for (const auto* f : makers)
    if (f != &most && f->most_albedo > 1.05 && f->name.find("coupled") == f->name.npos)
      to.say(fmt::format("{}'s reflects up to {:.3g} times what it receives, at {}.", f->name,
                         f->most_albedo, place(f->most_roughness, f->most_mu)));
}

void light_is_lost(Findings& to, const DiffuseRows& r) {
  const auto *nayar = find_form(r.forms, "diffuse.oren_nayar"), *kept = find_form(r.forms, eon);
  if (nayar && kept)
    to.say(fmt::format(
        "A white surface under Oren–Nayar loses {} of the light on average where "
        "it is roughest, and under EON {}.",
        percent(1 - nayar->least_average, 2),
        std::abs(1 - kept->least_average) < 1e-4 ? std::string("nothing")
                                                 : percent(1 - kept->least_average, 2)));
}

void looks(Findings& to, const DiffuseRows& r) {
  if (const auto most = largest_difference(r.colours, lambert, "matte")) {
    double least = HUGE_VAL;  // roughness that is looked at, but for 0
    for (const auto& c : r.colours)
      if (c.roughness > 0) least = std::min(least, c.roughness);
    const auto there = largest_difference(r.colours, lambert, "matte", least);
    to.say(fmt::format(
        "On matte surfaces Lambert differs from EON by up to ΔE2000 {}{}.", delta(*most),
        there ? fmt::format(", at roughness {:g} already by up to {}", least, delta(*there))
              : std::string()));
  }
  const auto free = largest_difference(r.colours, lambert, "plastic"),
             coupled = largest_difference(r.colours, "diffuse.lambert.coupled", "plastic"),
             hammon = largest_difference(r.colours, "diffuse.hammon", "plastic");
  if (free && coupled && hammon)
    to.say(fmt::format(
        "Below a plastic's lobe and at equal albedo, Lambert is off by up to ΔE2000 {}, "
        "coupled Lambert by {} and Hammon's form by {}. The reference there is EON, "
        "coupled by albedos.",
        delta(*free), delta(*coupled), delta(*hammon)));
  if (const auto most = largest_difference(r.colours, disney, "plastic"))
    to.say(fmt::format(
        "Disney's form holds the interface and is no matte surface: below a lobe it is off by up "
        "to "
        "ΔE2000 {}, and Frostbite's by {}.",
        delta(*most),
        delta(largest_difference(r.colours, "diffuse.frostbite", "plastic").value_or(0))));
}

void below_a_lobe(Findings& to, const DiffuseRows& r) {
  const auto *free = find_form(r.forms, lambert),
             *coupled = find_form(r.forms, "diffuse.lambert.coupled");
  if (free && coupled)
    to.say(
        fmt::format("With a lobe of F0 = 0.04 on top, white Lambert reflects up to {:.3g} times "
                    "what it receives. Coupled by 1 − F it still reflects {:.3g} times as much as "
                    "it receives, on smooth surfaces at grazing angles.",
                    free->most_with_lobe, coupled->most_with_lobe));
}

void laws_and_times(Findings& to, const DiffuseRows& r) {
  const auto worst = std::ranges::max_element(r.forms, {}, &DiffuseForm::reciprocity);
  if (worst == r.forms.end()) return;
  to.say(
      worst->reciprocity < 1e-9
          ? std::string("All of them are reciprocal.")
          : fmt::format("{} is not reciprocal: exchanging light and view changes it by up to {}.",
                        worst->name, percent(worst->reciprocity, 2)));
  const auto *cheap = find_form(r.forms, lambert), *dear = find_form(r.forms, eon);
  if (cheap && dear)
    to.say(
        fmt::format("A sample takes {:.2f} ns under Lambert and {:.2f} ns under EON, in float, "
                    "from cache.",
                    cheap->ns, dear->ns));
}

}  // namespace

Findings findings(const DiffuseRows& r) {
  Findings all;
  light_is_made(all, r);
  looks(all, r);
  light_is_lost(all, r);
  below_a_lobe(all, r);
  laws_and_times(all, r);
  return all;
}

}  // namespace gonio
