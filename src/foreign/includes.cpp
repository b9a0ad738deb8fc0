// What a function's value includes, guessed from reciprocity and albedo.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/nearest_names.h"
#include "foreign/directions.h"
#include "foreign/guesses.h"
#include "foreign/interpret.h"

namespace gonio::foreign {
namespace {

class Includes {
 public:
  explicit Includes(Function& f) : f_(f) {}

  void take() {
    for (std::size_t k = first_of_frame; k < angle_names.size(); ++k)
      f_.reads_frame = f_.reads_frame || reads_angle(f_, angle_names[k]);
    const auto settings = many_settings();
    f_.anisotropic = f_.reads_frame && is_anisotropic(settings);
    if (f_.stands == Stands::masking) {
      const auto& said = f_.name.reading.includes;
      f_.is_g = said ? *said == "g" : gives_g(settings[0]);
      f_.includes = f_.is_g ? "g" : "v";
      f_.guessed = !said;
    }
    if (f_.stands == Stands::lobe) includes_of_lobe(settings);
  }

 private:
  /// Values of parameters that stand for all: the defaults first, then many drawn within the bounds, and of each its ends with the
  /// others drawn.  What is decided at the defaults is wrong of two widths that have the same.
  std::vector<std::vector<double>> many_settings() const {
    std::vector<std::vector<double>> all{defaults_of(f_)};
    const auto drawn = [&] {
      constexpr double golden = 0.618033988749895;
      const auto j = static_cast<double>(all.size());
      std::vector<double> v;
      for (const auto& p : f_.parameters) {
        const double k = static_cast<double>(v.size() + 1), part = std::fmod(j * k * golden, 1);
        // Without bounds it may be an angle in degrees, or a mode.
        const double wide = p.bounded || all.size() % 4 ? 1 : 50;
        v.push_back(p.range.low + wide * part * (p.range.high - p.range.low));
      }
      return v;
    };
    constexpr std::size_t many = 12;
    while (all.size() <= many) all.push_back(drawn());
    for (std::size_t k = 0; k < f_.parameters.size(); ++k)
      for (const double end : {f_.parameters[k].range.low, f_.parameters[k].range.high}) {
        auto v = drawn();
        v[k] = end;
        all.push_back(std::move(v));
      }
    return all;
  }
  /// True where turning the surface changes a value, whatever the parameters are.
  bool is_anisotropic(const std::vector<std::vector<double>>& settings) const {
    if (std::ranges::any_of(f_.arguments, [&](const Argument& a) {
          const std::size_t k = angle(a.stands_for);
          return k >= first_of_frame && k < angle_names.size() && reads_angle(f_, a.stands_for);
        }))
      return true;
    constexpr std::size_t places = 12;
    std::vector<std::array<double, 11>> at;
    for (std::size_t i = 0; i < places; ++i) {
      const double k = static_cast<double>(i);
      const double t = 0.11 + 0.11 * k, u = 1.4 - 0.1 * k, phi = 0.3 + 0.5 * k;
      at.push_back(angles_between(t, phi, u, 0));
      at.push_back(angles_between(t, phi, u, 0.7 + 0.3 * k));
    }
    return std::ranges::any_of(f_.programs, [&](const Program& p) {
      Interpreter<double> run(p, at.size());
      return std::ranges::any_of(settings, [&](const std::vector<double>& values) {
        std::vector<double> v(at.size());
        run.set(values);
        run.run(
            at.size(), [&](std::size_t k, std::size_t j) { return at[j][k]; },
            [&](std::size_t, std::size_t j, double x) { v[j] = x; });
        double most = 0;
        for (const double x : v) most = std::fmax(most, std::abs(x));
        for (std::size_t i = 0; i < v.size(); i += 2)
          if (differ(v[i], v[i + 1]) && std::abs(v[i] - v[i + 1]) > 1e-12 * most) return true;
        return false;
      });
    });
  }
  /// True of a masking function that gives G: 1 along the normal and never more; a V without its 4 is 1 there, too, and more elsewhere.
  /// One whose name says G is G, too, where it falls towards the horizon, as no V does.
  bool gives_g(const std::vector<double>& p) const {
    const auto at = [&](double theta_l, double theta_v) {
      return value_of(f_, p, angles_between(theta_l, 1, theta_v, 0))[0];
    };
    constexpr double steep = 1.3, same = 1e-3, much = 0.9;
    if (plain(f_.name.function).starts_with("g") && at(steep, steep) < much * at(0, 0)) return true;
    return at(0, 0) > 0.6 && !(std::fmax(at(steep, steep), at(0, steep)) > at(0, 0) * (1 + same));
  }
  void includes_of_lobe(const std::vector<std::vector<double>>& settings) {
    if (const auto& said = f_.name.reading.includes) {
      static constexpr std::string_view known[] = {"nothing", "cosine", "pi", "cosine,pi"};
      if (std::ranges::find(known, *said) == std::end(known))
        refuse_name(*said, known, "thing that a value includes");
      f_.includes = *said;
      return;
    }
    f_.guessed = true;
    if (!takes_direction(f_)) return;  // a helper
    bool cosine = false;
    std::vector<double> brightest;  // there F is 1 whatever cosine it takes
    for (const auto& p : f_.parameters) brightest.push_back(p.range.high);
    auto all = settings;
    all.push_back(std::move(brightest));
    for (const auto& p : all)
      if (const Cosine has = has_cosine(p); has != Cosine::unknown) {
        cosine = has == Cosine::there;
        break;
      }
    const bool pi = has_pi(settings[0], cosine);
    f_.includes = cosine && pi ? "cosine,pi" : cosine ? "cosine" : pi ? "pi" : "nothing";
  }
  enum class Cosine { unknown, missing, there };
  /// Guesses whether a value is f NoL by reciprocity: f(l, v) = f(v, l) with the cosine taken out, not with it in; unknown where the value
  /// is 0, as with a default of 0, or reciprocal neither way.  Shaders add 1e-5 to a cosine so that it is never 0: that is no cosine of
  /// their own.
  Cosine has_cosine(const std::vector<double>& p) const {
    int plain_differs = 0, without_differs = 0, seen = 0;
    double plain_off = 0, without_off = 0;
    const auto off = [](double a, double b) {
      return std::abs(a - b) / std::max(std::abs(a), std::abs(b));
    };
    for (int k = 0; k < 24; ++k) {
      const double t = 0.15 + 0.05 * k, u = 1.3 - 0.045 * k, phi = 0.4 * k;
      const auto x = angles_between(t, phi, u, 0), y = angles_between(u, -phi, t, 0);
      const double a = value_of(f_, p, x)[0], b = value_of(f_, p, y)[0];
      if (!std::isfinite(a) || !std::isfinite(b) || (a == 0 && b == 0)) continue;
      ++seen;
      plain_differs += differ(a, b);
      without_differs += differ(a / x[0], b / y[0]);
      plain_off = std::fmax(plain_off, off(a, b));
      without_off = std::fmax(without_off, off(a / x[0], b / y[0]));
    }
    if (seen == 0) return Cosine::unknown;
    if (plain_differs <= 3) return Cosine::missing;
    if (without_differs == 0 || without_off < 1e-3 * plain_off) return Cosine::there;
    constexpr double much = 1e-2;  // as of a slip, not of a guard
    return plain_off > much && without_off > much ? Cosine::unknown : Cosine::missing;
  }
  /// Rough albedo of the first channel where θ_v = 0.5, over rings about the mirror direction that are narrow near it: a lobe of
  /// any width is seen.
  double rough_albedo(const std::vector<double>& p, bool cosine) const {
    constexpr int rings = 64, columns = 16;
    constexpr double theta_v = 0.5, most = std::numbers::pi / 2 + theta_v;
    std::vector<std::array<double, 11>> at;
    std::vector<double> weights;
    for (int i = 0; i < rings; ++i)
      for (int j = 0; j < columns; ++j) {
        const double t = (i + 0.5) / rings, rho = most * t * t * t;
        const double phi = 2 * std::numbers::pi * (j + 0.5) / columns;
        const double along = std::sin(rho) * std::cos(phi), across = std::sin(rho) * std::sin(phi);
        const double x = along * std::cos(theta_v) - std::cos(rho) * std::sin(theta_v);
        const double z = along * std::sin(theta_v) + std::cos(rho) * std::cos(theta_v);
        if (z <= 0) continue;
        at.push_back(
            angles_between(std::acos(std::min(z, 1.0)), std::atan2(across, x), theta_v, 0));
        const double width = most * 3 * t * t / rings * 2 * std::numbers::pi / columns;
        weights.push_back((cosine ? 1 : z) * std::sin(rho) * width);
      }
    Interpreter<double> run(f_.programs[0], at.size());
    run.set(p);
    double sum = 0;
    run.run(
        at.size(), [&](std::size_t k, std::size_t j) { return at[j][k]; },
        [&](std::size_t, std::size_t j, double v) { sum += v * weights[j]; });
    return sum;
  }
  /// Guesses whether a value is π times f.  A colour at 1, with the others dark, gives an albedo near 1, or else near π, where it
  /// gives most: a rough highlight loses light.
  bool has_pi(const std::vector<double>& starts, bool cosine) {
    const auto is_near = [](double a, double b) { return std::abs(a / b - 1) < 0.1; };
    double most = 0;
    bool near_one = false, near_pi = false;
    const auto take = [&](double albedo) {
      most = std::fmax(most, albedo);
      near_one = near_one || is_near(albedo, 1);
      near_pi = near_pi || is_near(albedo, std::numbers::pi);
    };
    // Parameters in which the value is linear; of a colour whose channels mix the three together.
    using Group = std::vector<std::size_t>;
    std::vector<Group> colours;
    const auto with = [](std::vector<double> p, const Group& g, const std::vector<double>& by) {
      for (const auto k : g) p[k] = by[k];
      return p;
    };
    std::vector<double> low, high, middle;
    for (const auto& q : f_.parameters) {
      low.push_back(q.range.low);
      high.push_back(q.range.high);
      middle.push_back((q.range.low + q.range.high) / 2);
    }
    Group others;
    for (std::size_t k = 0; k < f_.parameters.size(); ++k) {
      Group g{k};
      const auto stem = [&](std::size_t i) {
        const auto& n = f_.parameters[i].name;
        return n.ends_with("_r") || n.ends_with("_g") || n.ends_with("_b")
                   ? n.substr(0, n.size() - 2)
                   : n;
      };
      while (k + 1 < f_.parameters.size() && stem(k + 1) == stem(g[0])) g.push_back(++k);
      const double a = rough_albedo(with(starts, g, low), cosine),
                   b = rough_albedo(with(starts, g, middle), cosine),
                   c = rough_albedo(with(starts, g, high), cosine);
      if (c > a && std::abs((b - a) / (c - a) - 0.5) < 0.02)
        colours.push_back(g);
      else
        others.insert(others.end(), g.begin(), g.end());
    }
    auto dark = starts;
    for (const auto& g : colours) dark = with(dark, g, low);
    // One colour may be that of a diffuse part, and of a metal's highlight.
    const auto metal = std::ranges::find_if(
        others, [&](std::size_t k) { return plain(f_.parameters[k].name).starts_with("metal"); });
    std::vector<std::vector<double>> kinds{dark};
    if (metal != others.end()) kinds = {with(dark, {*metal}, low), with(dark, {*metal}, high)};
    for (const auto& kind : kinds) {
      std::vector<std::vector<double>> places{kind};
      for (const auto k : others)
        for (const auto* end : {&low, &high})
          if (metal == others.end() || k != *metal) places.push_back(with(kind, {k}, *end));
      for (const auto& g : colours) {
        double largest = 0;
        for (const auto& p : places)
          largest = std::fmax(largest, (rough_albedo(with(p, g, high), cosine) -
                                        rough_albedo(with(p, g, low), cosine)) /
                                           (high[g[0]] - low[g[0]]));
        take(largest);
      }
    }
    constexpr double little = 0.2;  // as a roughness that a diffuse part is nearly linear in
    if (most < little) take(rough_albedo(starts, cosine));
    f_.unclear = !near_one && !near_pi && most > 1.2;
    return near_pi && !near_one;
  }

  Function& f_;
};

}  // namespace

void guess_includes(Function& f) {
  Includes(f).take();
}

}  // namespace gonio::foreign
