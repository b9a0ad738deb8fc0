#include "fitting/map/texels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory>
#include <random>

#include "base/error.h"
#include "fitting/fit.h"
#include "fitting/map/stack.h"
#include "fitting/solve/problem.h"
#include "geometry/sampling.h"

#include <gtest/gtest.h>

namespace gonio {
namespace {

using test::Noise;
using test::Stack;
using test::StackOptions;

constexpr auto converged = static_cast<std::uint8_t>(TexelOutcome::converged);
constexpr auto no_data = static_cast<std::uint8_t>(TexelOutcome::no_data);
constexpr auto is_free = static_cast<std::uint8_t>(ParameterStatus::free);
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

bool is_long() {
  return std::getenv("GONIO_LONG") != nullptr;
}

TexelOptions options(const std::string& model, Metric metric = Metric::l2_cosine) {
  TexelOptions o;
  o.model = model;
  o.metric = metric;
  return o;
}

/// A texel as a table.
Table table_of(const Stack& s, std::size_t texel) {
  Table t;
  t.format = "csv";
  t.channels = s.model.model.channels == 1 ? std::vector<std::string>{"f"}
                                           : std::vector<std::string>{"r", "g", "b"};
  DirectionList l;
  for (std::size_t i = 0; i < s.images; ++i) {
    const auto d = s.directions(i);
    l.theta_i_deg.push_back(theta_of(d.wi) / degree);
    l.phi_i_deg.push_back(phi_of(d.wi) / degree);
    l.theta_o_deg.push_back(theta_of(d.wo) / degree);
    l.phi_o_deg.push_back(phi_of(d.wo) / degree);
  }
  t.where = std::move(l);
  for (std::size_t c = 0; c < t.channels.size(); ++c) {
    t.values.emplace_back(s.images);
    for (std::size_t i = 0; i < s.images; ++i) t.values[c][i] = double{s.values[s.at(i, c, texel)]};
  }
  return t;
}

/// The fit of a table, its last steps taken until nothing is left to gain: Ceres stops where a step lowers the cost by less than 1e-10 of
/// itself, which may be thousandths of a standard error away.
FitResult fit_to_the_end(const Table& table, const FitOptions& o) {
  FitResult f = fit(table, o);
  const Problem p = pose(table, o);
  const Sampling sampling = sampling_for(p, table, table.bins());
  const auto data = fit_data<double>(sampling);
  const Accumulator<double> accumulate(p.start.model, data, p.free);
  auto x = p.free.of(f.model.values);
  const auto evaluate = [&](const std::vector<double>& at) {
    p.free.put(at, f.model.values);
    return accumulate.normal_equations(f.model.values);
  };
  solve(evaluate, x, p.bounds,
        {.max_iterations = 500, .function_tolerance = 1e-16, .parameter_tolerance = 1e-13});
  p.free.put(x, f.model.values);
  return f;
}

/// Holds texels against the fit of each as a table: of the parameters 99 % to 1e-5, the rest to 0.01 standard errors.
void expect_fits_of_tables(const StackOptions& made, Metric metric) {
  const Stack s = test::stack(made);
  const TexelFit map = fit_texels(s.samples(), options(made.model, metric));
  FitOptions o;
  o.model = made.model;
  o.metric = metric;
  o.intervals = Intervals::independent;
  o.bin_sensitivity = false;
  std::size_t all = 0, close = 0, errors = 0, errors_close = 0;
  for (std::size_t t = 0; t < s.texels; ++t) {
    const FitResult one = fit_to_the_end(table_of(s, t), o);
    std::size_t column = 0;
    for (const auto& q : one.model.model.parameters)
      for (std::size_t c = 0; c < q.count; ++c, ++column) {
        const auto& mine = map.columns[column];
        const auto& p = *std::ranges::find(one.document.parameters, q.name, &FittedParameter::name);
        if (mine.status[t] != is_free || p.status[c] != ParameterStatus::free) continue;
        const double expected = one.model.values[q.first + c], found = double{mine.value[t]};
        ++all;
        if (std::abs(found - expected) <= 1e-5 * std::abs(expected)) {
          ++close;
        } else {
          const double error =
              std::isnan(p.std_error[c]) ? double{mine.std_error[t]} : p.std_error[c];
          EXPECT_LE(std::abs(found - expected), 0.01 * error)
              << made.model << " texel " << t << " " << q.name << " " << expected;
        }
        if (std::isnan(p.std_error[c])) continue;
        ++errors;
        const double error = p.std_error[c] * spread_of(double{mine.freedom[t]});
        errors_close += std::abs(double{mine.std_error[t]} - error) <= 0.02 * error;
      }
  }
  EXPECT_GE(all, s.texels * map.columns.size() * 9 / 10) << made.model;
  EXPECT_GE(close, all * 99 / 100) << made.model << " of " << all;
  // What the fit of a table widens them by, where it finds the model lacking, is not part of the
  // plain sandwich.
  EXPECT_GE(errors_close, errors * 9 / 10) << made.model << " of " << errors;
}

TEST(Texels, AgreeWithFitsOfThemAsTables) {
  StackOptions made;
  made.texels = is_long() ? 10000 : 250;
  made.noise = Noise::relative;
  made.sigma = 0.03;
  expect_fits_of_tables(made, Metric::l2_cosine);
}

TEST(Texels, AgreeWithFitsOfTablesInEveryMetric) {
  StackOptions made;
  made.texels = is_long() ? 1000 : 60;
  made.noise = Noise::relative;
  made.sigma = 0.03;
  expect_fits_of_tables(made, Metric::log);
  expect_fits_of_tables(made, Metric::relative);
}

TEST(Texels, AgreeWithFitsOfTablesWhateverTheModel) {
  StackOptions made;
  made.texels = is_long() ? 500 : 30;
  made.noise = Noise::relative;
  made.sigma = 0.01;
  for (const char* model : {"lambert.coupled+ggx/smith_ggx.correlated/schlick",
                            "lambert+beckmann/smith_beckmann.correlated/schlick",
                            "lambert+ggx_aniso/smith_ggx_aniso.correlated/schlick",
                            "ggx/smith_ggx.separable/schlick"}) {
    made.model = model;
    expect_fits_of_tables(made, Metric::l2_cosine);
  }
  made.channels = 1;
  made.model = "lambert+ggx/smith_ggx.correlated/dielectric";
  expect_fits_of_tables(made, Metric::l2_cosine);
}

/// Holds the parameters of texels without noise to `most` of their values.
void expect_truth(const Stack& s, const TexelFit& f, double most) {
  std::size_t column = 0;
  for (const auto& q : s.model.model.parameters)
    for (std::size_t c = 0; c < q.count; ++c, ++column)
      for (std::size_t t = 0; t < s.texels; ++t)
        EXPECT_NEAR(double{f.columns[column].value[t]}, s.truth[q.first + c][t],
                    most * std::abs(s.truth[q.first + c][t]))
            << to_text(s.model.model.spec) << " " << q.name << " of texel " << t;
}

TEST(Texels, ComeBackWithoutNoise) {
  for (const char* model : {"lambert+ggx/smith_ggx.correlated/schlick", "lambert",
                            "lambert+gtr/smith_ggx.correlated/schlick",
                            "lambert+ggx_aniso/smith_ggx_aniso.correlated/schlick"}) {
    StackOptions made;
    made.model = model;
    const Stack s = test::stack(made);
    const TexelFit f = fit_texels(s.samples(), options(model));
    for (const auto outcome : f.outcome) EXPECT_EQ(outcome, converged) << model;
    expect_truth(s, f, 1e-3);
  }
}

TEST(Texels, OfDullSurfacesUnderOneCameraFollowTheValleyToItsLowestPoint) {
  const std::string model = "lambert+ggx/smith_ggx.correlated/schlick";
  Stack s;
  s.model = bind_model(model, {}, 3);
  std::vector<FrameAngles<double>> angles;
  for (const double theta : {12., 24., 36., 48., 58., 68.})
    for (int k = 0; k < 4; ++k) {
      const Direction l = direction(theta * degree, (90 * k + theta) * degree);
      for (const double x : {l.x, l.y, l.z}) s.light.push_back(static_cast<float>(x));
      for (const float x : {0.F, 0.F, 1.F}) s.view.push_back(x);
      ++s.images;
    }
  for (std::size_t i = 0; i < s.images; ++i) angles.push_back(frame_angles(s.directions(i)));
  const std::array kd{0.08, 0.16, 0.38};
  std::vector<Values> all;  // [texel × channel]
  s.truth.resize(s.model.values.size());
  for (const double alpha : {0.4, 0.45, 0.5, 0.55, 0.6, 0.65, 0.7, 0.8})
    for (const double f0 : {0.04, 0.06, 0.09, 0.15}) {
      for (const auto& q : s.model.model.parameters)
        for (std::size_t c = 0; c < q.count; ++c) {
          const auto name = q.about->name;
          const double x = name == "alpha" ? alpha : name == "f0" ? f0 : kd[c];
          s.truth[q.first + c].push_back(s.model.values[q.first + c] = x);
        }
      for (auto& channel : evaluate(s.model, angles))
        all.emplace_back(channel.begin(), channel.end());
      ++s.texels;
    }
  for (std::size_t i = 0; i < s.images; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t t = 0; t < s.texels; ++t)
        s.values.push_back(static_cast<float>(all[3 * t + c][i]));
  for (const auto metric : {Metric::log, Metric::l2_cosine}) {
    const TexelFit f = fit_texels(s.samples(), options(model, metric));
    for (const auto outcome : f.outcome) EXPECT_EQ(outcome, converged);
    expect_truth(s, f, 2e-3);
  }
}

/// Columns as bits: two results are one or they are not.
std::vector<std::uint32_t> bits_of(const TexelFit& f, std::size_t texel) {
  std::vector<std::uint32_t> bits{f.outcome[texel], std::bit_cast<std::uint32_t>(f.rms[texel])};
  for (const auto& c : f.columns) {
    bits.push_back(std::bit_cast<std::uint32_t>(c.value[texel]));
    bits.push_back(std::bit_cast<std::uint32_t>(c.std_error[texel]));
    bits.push_back(c.status[texel]);
  }
  for (std::size_t k = 0; k < 3 && !f.normal.empty(); ++k)
    bits.push_back(std::bit_cast<std::uint32_t>(f.normal[k * f.outcome.size() + texel]));
  return bits;
}

/// Some of a stack's texels, in the order given.
Stack part_of(const Stack& s, const std::vector<std::size_t>& texels) {
  Stack p = s;
  p.texels = texels.size();
  p.values.clear();
  for (std::size_t row = 0; row < s.images * s.model.model.channels; ++row)
    for (const std::size_t t : texels) p.values.push_back(s.values[row * s.texels + t]);
  p.normal.clear();
  for (std::size_t k = 0; k < 3 && !s.normal.empty(); ++k)
    for (const std::size_t t : texels) p.normal.push_back(s.normal[k * s.texels + t]);
  return p;
}

TEST(Texels, DependNeitherOnTheirNeighboursNorOnTheBlock) {
  for (const bool refined : {false, true})
    for (const char* model :
         {"lambert+ggx/smith_ggx.correlated/schlick", "lambert+gtr/smith_ggx.correlated/schlick"}) {
      StackOptions made;
      made.model = model;
      made.texels = 83;
      made.noise = Noise::relative;
      made.sigma = 0.1;
      Stack s = test::stack(made);
      for (std::size_t t = 0; t < s.texels; t += 7) s.values[s.at(t % s.images, t % 3, t)] = nan;
      TexelOptions o = options(model);
      o.refine_normals = refined;
      const TexelFit whole = fit_texels(s.samples(), o);
      std::vector<std::size_t> backwards;
      for (std::size_t t = s.texels; t-- > 0;) backwards.push_back(t);
      const TexelFit turned = fit_texels(part_of(s, backwards).samples(), o);
      for (std::size_t t = 0; t < s.texels; ++t) {
        EXPECT_EQ(bits_of(turned, s.texels - 1 - t), bits_of(whole, t)) << model << t;
        if (t % 5 == 0) {
          const TexelFit alone = fit_texels(part_of(s, {t}).samples(), o);
          EXPECT_EQ(bits_of(alone, 0), bits_of(whole, t)) << model << t;
        }
      }
    }
}

TEST(Texels, AreTheSameWithDirectionsOfTheirOwn) {
  StackOptions made;
  made.texels = 40;
  made.noise = Noise::relative;
  made.sigma = 0.05;
  const Stack s = test::stack(made);
  std::vector<float> light, view, normal(3 * s.texels);
  for (std::size_t k = 0; k < 3 * s.images; ++k) {
    light.insert(light.end(), s.texels, s.light[k]);
    view.insert(view.end(), s.texels, s.view[k]);
  }
  std::fill(normal.begin() + static_cast<std::ptrdiff_t>(2 * s.texels), normal.end(), 1.0F);
  const auto o = options(made.model);
  const TexelFit shared = fit_texels(s.samples(), o);
  TexelSamples own = s.samples();
  own.shared = false;
  own.light = light;
  own.view = view;
  own.normal = normal;
  const TexelFit each = fit_texels(own, o);
  for (std::size_t t = 0; t < s.texels; ++t) EXPECT_EQ(bits_of(each, t), bits_of(shared, t)) << t;
}

TEST(Texels, AreTheSameWithEveryInstructionSet) {
  StackOptions made;
  made.texels = 50;
  made.noise = Noise::relative;
  made.sigma = 0.05;
  for (const char* model : {"lambert+ggx/smith_ggx.correlated/schlick",
                            "lambert.coupled+ggx/smith_ggx.separable/schlick"}) {
    made.model = model;
    const Stack s = test::stack(made);
    for (const auto metric : {Metric::l2_cosine, Metric::log}) {
      const auto o = options(model, metric);
      const TexelFit scalar = fit_texels(s.samples(), o, "scalar");
      for (const auto& set : instruction_sets()) {
        const TexelFit other = fit_texels(s.samples(), o, set);
        for (std::size_t t = 0; t < s.texels; ++t) {
          if (metric == Metric::l2_cosine) {  // + − × ÷ √ alone
            EXPECT_EQ(bits_of(other, t), bits_of(scalar, t)) << set << " texel " << t;
            continue;
          }
          for (std::size_t k = 0; k < scalar.columns.size();
               ++k)  // logarithms differ by their last digits
            EXPECT_NEAR(other.columns[k].value[t], scalar.columns[k].value[t],
                        1e-5 * std::abs(double{scalar.columns[k].value[t]}))
                << set << " texel " << t;
        }
      }
    }
  }
}

/// Tilts each surface by up to this angle; f_r is that of the true normal, divided by n·l of the map's.
std::vector<Direction> tilt(Stack& s, double most_deg, double sigma = 0) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise;
  std::vector<Direction> normals;
  for (std::size_t t = 0; t < s.texels; ++t) {
    const double part = static_cast<double>(t) / static_cast<double>(s.texels);
    const Direction z = normals.emplace_back(direction(most_deg * degree * part, 11 * part + 1));
    const Frame frame(z);
    for (std::size_t k = 0; k < s.truth.size(); ++k) s.model.values[k] = s.truth[k][t];
    for (std::size_t i = 0; i < s.images; ++i) {
      const auto d = s.directions(i);
      const Direction l = frame.inside(d.wi), v = frame.inside(d.wo);
      const bool lit = l.z > 0 && v.z > 0;
      const std::vector angles{frame_angles(lit ? DirectionPair{l, v} : d)};
      const auto f = evaluate(s.model, angles);
      for (std::size_t c = 0; c < f.size(); ++c)
        s.values[s.at(i, c, t)] =
            static_cast<float>(lit ? f[c][0] * l.z / d.wi.z * (1 + sigma * noise(random)) : 0);
    }
  }
  return normals;
}

TEST(Texels, FitTheNormalThatTheirHighlightsTell) {
  StackOptions made;
  made.texels = 40;
  Stack s = test::stack(made);
  const auto normals = tilt(s, 10);
  TexelOptions o = options(made.model);
  o.refine_normals = true;
  const TexelFit f = fit_texels(s.samples(), o);
  std::size_t right = 0;
  for (std::size_t t = 0; t < s.texels; ++t) {
    const Direction n{double{f.normal[t]}, double{f.normal[s.texels + t]},
                      double{f.normal[2 * s.texels + t]}};
    right += std::abs(n.x - normals[t].x) < 1e-4 && std::abs(n.y - normals[t].y) < 1e-4 &&
             std::abs(double{f.columns[3].value[t]} / s.truth[3][t] - 1) < 1e-3;
  }
  EXPECT_GE(right, s.texels * 19 / 20);
  // With the map's normals they are not what they seem.
  const TexelFit kept = fit_texels(s.samples(), options(made.model));
  EXPECT_GT(kept.rms[39], 10 * f.rms[39]);
}

TEST(Texels, ConvergeWhereColoursMakeUpForNormals) {
  StackOptions made;
  made.texels = 512;
  made.images = 12;
  Stack s = test::stack(made);
  tilt(s, 35, 0.02);
  TexelOptions o = options(made.model);
  o.refine_normals = true;
  const TexelFit f = fit_texels(s.samples(), o);
  EXPECT_GE(std::ranges::count(f.outcome, converged), 508);
}

/// A stack of one channel seen from above under lamps, black so far.
Stack under_lamps(const std::string& model,
                  std::size_t texels,
                  const std::vector<Direction>& lamps) {
  StackOptions made;
  made.model = model;
  made.texels = texels;
  made.channels = 1;
  Stack s = test::stack(made);
  s.images = lamps.size();
  s.light.clear();
  s.view.clear();
  s.values.assign(lamps.size() * texels, 0);
  for (const Direction& l : lamps) {
    for (const double x : {l.x, l.y, l.z}) s.light.push_back(static_cast<float>(x));
    for (const float x : {0.0F, 0.0F, 1.0F}) s.view.push_back(x);
  }
  return s;
}

std::vector<Direction> ring(std::size_t lamps, double theta_deg) {
  std::vector<Direction> all;
  for (std::size_t i = 0; i < lamps; ++i)
    all.push_back(direction(theta_deg * degree,
                            360 * degree * static_cast<double>(i) / static_cast<double>(lamps)));
  return all;
}

/// Light from `l` that a surface of normal z sends upwards.
double light_of(const BoundModel& surface, const Direction& z, const Direction& l) {
  if (dot(l, z) <= 0) return 0;
  const Frame frame(z);
  const std::vector a{frame_angles({frame.inside(l), frame.inside(Direction{0, 0, 1})})};
  return evaluate(surface, a)[0][0] * dot(l, z);
}

/// Angle between a normal that was fitted and the right one.
double angle_to(const Direction& right, const TexelFit& f, std::size_t t) {
  const std::size_t run = f.rms.size();
  const Direction n{double{f.normal[t]}, double{f.normal[run + t]}, double{f.normal[2 * run + t]}};
  return std::acos(std::min(dot(n, right), 1.0));
}

TEST(Texels, FindNormalsFarFromTheMapsOwnUnderRoughSurfaces) {
  const auto lamps = ring(8, 50);
  Stack s = under_lamps("oren_nayar", 90, lamps);
  const auto rough = bind_model("oren_nayar", {{"kd", {0.5}}, {"sigma", {0.3}}}, 1);
  std::vector<Direction> normals;
  for (std::size_t t = 0; t < s.texels; ++t) {
    const auto part = static_cast<double>(t) / static_cast<double>(s.texels);
    const Direction z = normals.emplace_back(direction((10 + 35 * part) * degree, 11 * part));
    for (std::size_t i = 0; i < lamps.size(); ++i)
      s.values[i * s.texels + t] =
          static_cast<float>(light_of(rough, z, lamps[i]) / std::cos(50 * degree));
  }
  TexelOptions o = options("oren_nayar");
  o.refine_normals = true;
  const auto right = [&] {
    const TexelFit f = fit_texels(s.samples(), o);
    std::size_t count = 0;
    for (std::size_t t = 0; t < s.texels; ++t) {
      count += angle_to(normals[t], f, t) < 0.2 * degree &&
               std::abs(double{f.columns[0].value[t]} - 0.5) < 0.01;
    }
    return count;
  };
  const std::size_t found = right();
  EXPECT_GE(found, s.texels * 4 / 5) << "8 values of one channel leave another valley to some";
  // From the map's own, given as if they were known, more end elsewhere.
  s.normal.assign(2 * s.texels, 0.0F);
  s.normal.insert(s.normal.end(), s.texels, 1.0F);
  EXPECT_LT(right(), found);
}

TEST(Texels, FindNormalsUnderHighlightsThatFewLampsSee) {
  const std::string model = "lambert+ggx/smith_ggx.correlated/schlick";
  std::vector<Direction> lamps;
  for (double k = 0; k < 24; ++k)  // a spiral down to 65°
    lamps.push_back(direction((10 + 55 * std::sqrt(k / 24)) * degree, 2.4 * k));
  Stack s = under_lamps(model, 200, lamps);
  std::vector<Direction> normals;
  std::mt19937 random(1);
  std::normal_distribution<double> noise;
  for (std::size_t t = 0; t < s.texels; ++t) {
    const auto part = static_cast<double>(t) / static_cast<double>(s.texels);
    const Direction z = normals.emplace_back(direction((5 + 15 * part) * degree, 11 * part));
    // Black and glossy: nearly all light is the highlight's.
    const auto paint =
        bind_model(model, {{"kd", {0.02}}, {"alpha", {0.12 + 0.15 * part}}, {"f0", {0.04}}}, 1);
    for (std::size_t i = 0; i < lamps.size(); ++i)
      s.values[i * s.texels + t] = static_cast<float>(light_of(paint, z, lamps[i]) *
                                                      (1 + 0.005 * noise(random)) / lamps[i].z);
  }
  TexelOptions o = options(model);
  o.refine_normals = true;
  const TexelFit f = fit_texels(s.samples(), o);
  std::size_t right = 0;
  for (std::size_t t = 0; t < s.texels; ++t) right += angle_to(normals[t], f, t) < 2 * degree;
  EXPECT_GE(right, s.texels * 97 / 100);
}

TEST(Texels, OfNormalsThatAreFittedLeaveOutWhatMayBeAttachedShadow) {
  // Six lamps 40° from the map's normal; surfaces tilted by 50° to 82° turn from one to three of
  // them, the last one from all but two.
  const auto lamps = ring(6, 40);
  Stack s = under_lamps("lambert", 96, lamps);
  const auto matt = bind_model("lambert", {{"kd", {0.5}}}, 1);
  std::vector<Direction> normals;
  std::size_t shadows = 0;
  for (std::size_t t = 0; t < s.texels; ++t) {
    const auto part = static_cast<double>(t) / static_cast<double>(s.texels);
    const Direction z = normals.emplace_back(direction((50 + 32 * part) * degree, 7 * part));
    for (std::size_t i = 0; i < lamps.size(); ++i) {
      shadows += dot(lamps[i], z) <= 0;
      s.values[i * s.texels + t] =
          static_cast<float>(light_of(matt, z, lamps[i]) / std::cos(40 * degree));
    }
  }
  EXPECT_GT(shadows, s.texels);
  const std::size_t last = s.texels - 1;
  for (std::size_t i = 0, lit = 0; i < 6; ++i)
    if (float& y = s.values[i * s.texels + last]; y > 0 && ++lit > 2) y = 0;
  TexelOptions o = options("lambert");
  o.refine_normals = true;
  const TexelFit f = fit_texels(s.samples(), o);
  EXPECT_TRUE(std::isnan(f.normal[last]) && std::isnan(f.columns[0].value[last]));
  for (std::size_t t = 0; t < last; ++t) {
    EXPECT_LT(angle_to(normals[t], f, t), 0.1 * degree) << t;
    EXPECT_NEAR(double{f.columns[0].value[t]}, 0.5, 1e-3) << t;
  }
}

TEST(Texels, AreJudgedByNormalsThatAreGiven) {
  StackOptions made;
  made.texels = 20;
  const Stack flat = test::stack(made);
  // All turned together: what the surface sees stays the same.
  const double c = std::cos(0.3), n = std::sin(0.3);
  Stack s = flat;
  for (auto* all : {&s.light, &s.view})
    for (std::size_t i = 0; i < s.images; ++i) {
      float *const x = all->data() + 3 * i, *const z = x + 2;
      const double old_x = double{*x}, old_z = double{*z};
      *x = static_cast<float>(c * old_x + n * old_z);
      *z = static_cast<float>(c * old_z - n * old_x);
    }
  s.normal.assign(s.texels, static_cast<float>(n));
  s.normal.insert(s.normal.end(), s.texels, 0.0F);
  s.normal.insert(s.normal.end(), s.texels, static_cast<float>(c));
  expect_truth(s, fit_texels(s.samples(), options(made.model)), 1e-3);
}

TEST(Texels, LeaveOutWhatWasNotMeasured) {
  StackOptions made;
  made.texels = 37;
  Stack s = test::stack(made);
  for (std::size_t t = 0; t < s.texels; ++t)
    for (std::size_t i = t % 5; i < s.images; i += 5)
      s.values[s.at(i, t % 3, t)] =
          std::array{nan, -1.0F, std::numeric_limits<float>::infinity()}[i % 3];
  expect_truth(s, fit_texels(s.samples(), options(made.model)), 1e-3);
}

TEST(Texels, SayOfWhatCannotBeComputedThatItIsNotKnown) {
  StackOptions made;
  made.texels = 200;
  Stack s = test::stack(made);
  std::uint32_t random = 1;
  for (float& v : s.values) {  // from 1e-30 to 1e18, beyond what a float's squares hold
    random = random * 1664525 + 1013904223;
    v *= std::pow(10.0F, static_cast<float>(random >> 16U) / 65536 * 48 - 30);
  }
  for (const auto metric : {Metric::l2_cosine, Metric::log, Metric::relative}) {
    const TexelFit f = fit_texels(s.samples(), options(made.model, metric));
    for (std::size_t t = 0; t < s.texels; ++t) {
      EXPECT_TRUE(f.outcome[t] != converged || !std::isnan(f.rms[t])) << name_of(metric) << t;
      for (const auto& c : f.columns)
        EXPECT_EQ(std::isnan(c.value[t]),
                  c.status[t] == static_cast<std::uint8_t>(ParameterStatus::not_identifiable))
            << name_of(metric) << " texel " << t << ": " << c.parameter;
    }
  }
}

TEST(Texels, SayNothingOfWhatHasNoData) {
  StackOptions made;
  made.texels = 20;
  Stack s = test::stack(made);
  for (std::size_t i = 0; i < s.images; ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      s.values[s.at(i, c, 3)] = nan;
      s.values[s.at(i, c, 4)] = 0;
    }
  for (const auto metric : {Metric::l2_cosine, Metric::log, Metric::relative}) {
    const TexelFit f = fit_texels(s.samples(), options(made.model, metric));
    EXPECT_EQ(f.outcome[3], no_data);
    EXPECT_TRUE(std::isnan(f.rms[3]));
    for (const auto& c : f.columns) {
      EXPECT_EQ(c.status[3], static_cast<std::uint8_t>(ParameterStatus::not_identifiable));
      EXPECT_TRUE(std::isnan(c.value[3]) && std::isnan(c.std_error[3]));
    }
    if (metric != Metric::l2_cosine) {  // a black texel has no logarithm
      EXPECT_EQ(f.outcome[4], no_data);
      continue;
    }
    EXPECT_EQ(f.outcome[4], converged);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(f.columns[k].value[4], 0, 1e-6);
    EXPECT_NE(f.columns[3].status[4], is_free);
  }
  expect_truth(part_of(s, {0}), fit_texels(part_of(s, {0}).samples(), options(made.model)), 1e-3);
}

TEST(Texels, SayWhatTheirDirectionsCannotTell) {
  for (const bool one_image : {true, false}) {
    StackOptions made;
    made.texels = 20;
    made.images = one_image ? 1 : 12;
    Stack s = test::stack(made);
    for (std::size_t i = 1; i < s.images; ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        s.light[3 * i + k] = s.light[k];
        s.view[3 * i + k] = s.view[k];
      }
    for (std::size_t i = 1; i < s.images; ++i)
      for (std::size_t t = 0; t < s.texels; ++t)
        for (std::size_t c = 0; c < 3; ++c)
          s.values[s.at(i, c, t)] =
              s.values[s.at(0, c, t)] * (1 + 0.01F * static_cast<float>(i % 3));
    const TexelFit f = fit_texels(s.samples(), options(made.model));
    for (std::size_t t = 0; t < s.texels; ++t) {
      EXPECT_TRUE(std::isfinite(f.rms[t]));
      std::size_t known = 0;
      for (const auto& c : f.columns) {
        const bool knows = std::isfinite(c.std_error[t]);
        known += knows;
        if (c.status[t] == static_cast<std::uint8_t>(ParameterStatus::not_identifiable)) {
          EXPECT_TRUE(std::isnan(c.value[t]));
        }
      }
      EXPECT_LE(known, one_image ? 0U : 3U) << "texel " << t;  // one number a channel
    }
  }
}

TEST(Texels, BearDirectionsThatAreNone) {
  StackOptions made;
  made.texels = 20;
  Stack s = test::stack(made);
  for (std::size_t k = 0; k < 3; ++k) {
    s.light[k] = -s.light[k];  // from below
    s.view[3 + k] = nan;       // no direction
    s.light[6 + k] = s.view[6 + k] = 0;
  }
  s.view[9] = 1;
  s.view[10] = s.view[11] = 0;  // along the surface
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t t = 0; t < s.texels; ++t)
      for (std::size_t c = 0; c < 3; ++c) s.values[s.at(i, c, t)] = 1e6F;
  expect_truth(s, fit_texels(s.samples(), options(made.model)), 1e-3);
  for (auto& x : s.light) x = -1;
  const TexelFit none = fit_texels(s.samples(), options(made.model));
  for (const auto outcome : none.outcome) EXPECT_EQ(outcome, no_data);
}

TEST(Texels, HoldWhatIsFixedAndStayInsideBounds) {
  StackOptions made;
  made.texels = 30;
  const Stack s = test::stack(made);
  TexelOptions o = options(made.model);
  o.fixed = {{"f0", {0.04}}};
  o.bounds = {{"alpha", {0.1, 0.2}}};
  const TexelFit f = fit_texels(s.samples(), o);
  std::size_t known = 0;
  for (std::size_t t = 0; t < s.texels; ++t) {
    EXPECT_EQ(f.columns[4].value[t], 0.04F);
    EXPECT_EQ(f.columns[4].status[t], static_cast<std::uint8_t>(ParameterStatus::fixed));
    const float alpha = f.columns[3].value[t];
    if (f.columns[3].status[t] == static_cast<std::uint8_t>(ParameterStatus::not_identifiable))
      continue;  // anywhere within: another f0 would fit
    ++known;
    EXPECT_TRUE(0.1F <= alpha && alpha <= 0.2F) << alpha;
    if (alpha == 0.1F || alpha == 0.2F) {
      EXPECT_EQ(f.columns[3].status[t], static_cast<std::uint8_t>(ParameterStatus::at_bound));
    }
  }
  EXPECT_GT(known, s.texels * 9 / 10);
}

TEST(Texels, RefuseOptionsAndSizesThatDoNotFit) {
  const Stack s = test::stack({});
  TexelOptions aniso = options("lambert+ggx_aniso/smith_ggx_aniso.correlated/schlick");
  aniso.refine_normals = true;
  EXPECT_THROW(check(aniso, 3), Error);
  EXPECT_THROW(check(options("nothing"), 3), Error);
  EXPECT_THROW(check(options("lambert"), 2), Error);
  EXPECT_NO_THROW(check(options("lambert"), 1));
  TexelSamples short_of_light = s.samples();
  short_of_light.light = short_of_light.light.first(3);
  EXPECT_THROW(fit_texels(short_of_light, {}), Error);
  const TexelFit nothing = fit_texels({0, 0, 3, {}, true, {}, {}, {}}, {});
  EXPECT_TRUE(nothing.rms.empty());
}

TEST(Texels, KnowNoTangentThatNoiseMayTurnByAQuarter) {
  StackOptions made;
  made.model = "ggx_aniso/smith_ggx_aniso.correlated/schlick";
  made.texels = 200;
  made.images = 8;
  made.noise = Noise::relative;
  made.sigma = 0.5;
  const TexelFit f = fit_texels(test::stack(made).samples(), options(made.model));
  const auto& tangent = *std::ranges::find(f.columns, "tangent", &TexelColumn::parameter);
  std::size_t known = 0, unknown = 0;
  for (std::size_t t = 0; t < made.texels; ++t)
    if (tangent.status[t] == is_free) {
      ++known;
      EXPECT_FALSE(1.96 * double{tangent.std_error[t]} > 90) << t;
    } else {
      ++unknown;
      EXPECT_TRUE(std::isnan(tangent.value[t])) << t;
    }
  EXPECT_GT(known, 50U);
  EXPECT_GT(unknown, 50U);
}

}  // namespace
}  // namespace gonio
