// Studies of sampling and of the split sum's table: what is timed, and what is off.
#include "reports/cost/studies.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "base/random.h"
#include "brdf/model/evaluate.h"
#include "geometry/ggx_sampling.h"
#include "integrate/albedo/ggx_albedo.h"
#include "integrate/light/split_sum_table.h"
#include "reports/finding/names.h"
#include "reports/study/kernels.h"
#include "reports/study/sampling_weight.h"

#include <fmt/format.h>

namespace gonio::costing {
namespace {

constexpr std::string_view sampled = "sampling", looked_up = "split_sum";
constexpr std::size_t table_sizes[] = {16, 32, 64};
using std::numbers::pi;

Vector3<double> direction(double mu, double phi) {
  const double sine = std::sqrt((1 - mu) * (1 + mu));
  return {sine * std::cos(phi), sine * std::sin(phi), mu};
}

constexpr double f0 = 0.04;

template <class Sampling>
void add_sampling(std::vector<SamplingRow>& to) {
  constexpr std::size_t samples = 1 << 15;
  for (const double roughness : {0.2, 0.5, 0.8, 1.0})
    for (const double mu : {0.1, 0.5, 0.9}) {
      const double alpha = roughness * roughness;
      const double truth = ggx_albedo(alpha, mu, SmithGgx::correlated, 1e-9).value;
      const auto v = direction(mu, 0);
      double squares = 0;
      std::size_t below = 0;
      for (std::size_t i = 0; i < samples; ++i) {
        Draws draw(13, i);
        const double u = draw.uniform();
        const auto l = Sampling::light(v, alpha, u, draw.uniform());
        const double weight = sampling_weight<Sampling, double>(v, alpha, l);
        squares += (weight - truth) * (weight - truth);
        below += l[2] <= 0;
      }
      const auto n = static_cast<double>(samples);
      to.push_back({std::string(Sampling::id),
                    std::string(Sampling::name),
                    roughness,
                    mu,
                    std::sqrt(squares / n) / truth,
                    static_cast<double>(below) / n,
                    {}});
    }
}

/// A, B at roughness 0.05 to 1 and NoV 1/32 to 1.
class SplitSumTruth {
 public:
  SplitSumTruth() {
    for (int i = 1; i <= 32; ++i) nov_.push_back(i / 32.0);
    for (int i = 1; i <= 20; ++i) {
      roughness_.push_back(i / 20.0);
      for (const auto& s : split_sum(form_id::smith, roughness_.back(), nov_, {1e-7, 4'000'000}))
        values_.push_back({s.a, s.b});
    }
  }
  /// \param value  of NoV and roughness; of a form of A + B alone that as A
  template <class Value>
  LookupRow row(std::string id, std::string name, bool sum_alone, const Value& value) const {
    LookupRow r{std::move(id), std::move(name), 0, 0, 0, 0, 0, 0, 0, {}};
    double a = 0, b = 0, plastic = 0, mirror = 0;
    std::size_t k = 0;
    for (const double roughness : roughness_)
      for (const double nov : nov_) {
        const auto& truth = values_[k++];
        const std::array<double, 2> found = value(nov, roughness);
        const double off_a = found[0] - truth[0], off_b = found[1] - truth[1];
        const double off = found[0] + found[1] - truth[0] - truth[1];
        a += off_a * off_a, b += off_b * off_b, mirror += off * off;
        plastic += std::pow(f0 * off_a + off_b, 2);
        r.mirror_max = std::max(r.mirror_max, std::abs(off));
      }
    const auto rms = [&](double squares) { return std::sqrt(squares / static_cast<double>(k)); };
    r.mirror_rms = rms(mirror);
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    r.a_rms = sum_alone ? unknown : rms(a), r.b_rms = sum_alone ? unknown : rms(b);
    r.plastic_rms = sum_alone ? unknown : rms(plastic);
    return r;
  }

 private:
  std::vector<double> nov_, roughness_;
  std::vector<std::array<double, 2>> values_;
};

std::string table_id(std::size_t size) {
  return fmt::format("split_sum.table.{}", size);
}

/// The table in 8 bits a channel, from 0 to 1.
SplitSumTable in_bytes(SplitSumTable t) {
  for (auto* values : {&t.a, &t.b})
    for (double& x : *values) x = std::round(std::clamp(x, 0.0, 1.0) * 255) / 255;
  return t;
}

std::vector<LookupRow> lookup_rows() {
  const SplitSumTruth truth;
  std::vector<LookupRow> out;
  for (const std::size_t size : table_sizes) {
    const auto exact = split_sum_table(form_id::smith, size, size, 0, {1e-5});
    const auto add = [&](const SplitSumTable& t, std::string_view format, std::size_t bytes) {
      auto r = truth.row(fmt::format("{}.{}", table_id(size), format),
                         fmt::format("{0} × {0} texels in {1}", size, format), false,
                         [&](double nov, double roughness) { return t(nov, roughness); });
      r.bytes = size * size * 2 * bytes, r.fetched = 4 * 2 * bytes;
      out.push_back(std::move(r));
    };
    add(stored(exact, Storage::half), "half", 2);
    if (size != 32) continue;
    add(exact, "float", 4);
    add(in_bytes(exact), "8 bits", 1);
  }
  for (const auto& k : study_kernels().lookup)
    if (!k.reads_table)
      out.push_back(
          truth.row(std::string(k.id), std::string(k.name), k.id == "split_sum.ours", k.exact));
  return out;
}

/// Id of what is timed for a row of the table.
std::string timed_as(const LookupRow& r) {
  return r.id.starts_with("split_sum.table") ? r.id.substr(0, r.id.rfind('.')) : r.id;
}

}  // namespace

bool is_study(std::string_view kind) {
  return kind == sampled || kind == looked_up;
}

std::vector<StudySubject> study_subjects(std::string_view set, std::size_t samples) {
  std::vector<StudySubject> out;
  const auto kernels = study_kernels(set);
  const std::size_t n = (samples + padding - 1) / padding * padding;
  const auto result = std::make_shared<std::array<Column<float>, 4>>();
  for (auto& c : *result) c = Column<float>(n);
  const auto views = std::make_shared<std::array<Column<float>, 3>>();
  for (auto& c : *views) c = Column<float>(n);
  for (std::size_t i = 0; i < n; ++i) {
    Draws draw(11, i);
    const double mu = 0.02 + 0.98 * draw.uniform();
    const auto v = direction(mu, 2 * pi * draw.uniform());
    for (std::size_t k = 0; k < 3; ++k) (*views)[k].data()[i] = static_cast<float>(v[k]);
  }
  const auto points = std::make_shared<std::array<Column<float>, 2>>();
  for (std::size_t k = 0; k < 2; ++k) {
    (*points)[k] = Column<float>(n);
    for (std::size_t i = 0; i < n; ++i)
      (*points)[k].data()[i] = static_cast<float>(0.01 + 0.98 * Draws(17 + k, i).uniform());
  }
  for (const auto& k : kernels.sampling)
    out.push_back({std::string(k.id),
                   sampled,
                   {n, [=, draw = k.draw] {
                      auto& r = *result;
                      draw({{(*views)[0].data(), (*views)[1].data(), (*views)[2].data()}, n},
                           (*points)[0].data(), (*points)[1].data(), 0.25F,
                           {r[0].data(), r[1].data(), r[2].data(), r[3].data()});
                    }}});
  const auto add_lookup = [&](std::string id, const LookupKernel& k, std::size_t size) {
    const auto texels = std::make_shared<std::vector<float>>(2 * size * size, 0.3F);
    out.push_back({std::move(id), looked_up, {n, [=, value = k.value] {
                                                value((*points)[0].data(), (*points)[1].data(), n,
                                                      {texels->data(), size}, (*result)[0].data(),
                                                      (*result)[1].data());
                                              }}});
  };
  for (const auto& k : kernels.lookup)
    if (k.reads_table)
      for (const std::size_t size : table_sizes) add_lookup(table_id(size), k, size);
    else
      add_lookup(std::string(k.id), k, 2);
  return out;
}

const Studies& study_errors() {
  static const Studies all = [] {
    Studies s;
    add_sampling<GgxNormals<double>>(s.sampling);
    add_sampling<GgxVisible2018<double>>(s.sampling);
    add_sampling<GgxCaps<double>>(s.sampling);
    add_sampling<GgxBounded<double>>(s.sampling);
    s.lookup = lookup_rows();
    return s;
  }();
  return all;
}

CostError study_error(const CostRow& row) {
  const auto& all = study_errors();
  CostError e;
  if (row.kind == sampled) {
    e.truth = "E", e.measure = "standard deviation of a sample over E";
    double squares = 0, n = 0;
    for (const auto& r : all.sampling)
      if (r.id == row.id) {
        e.max = std::max(e.max, r.deviation);
        squares += r.deviation * r.deviation;
        ++n;
      }
    e.rms = std::sqrt(squares / n);
  }
  if (row.kind == looked_up)
    for (const auto& r : all.lookup)
      if (timed_as(r) == row.id && (r.bytes == 0 || r.id.ends_with(".half")))
        return {"quadrature", "A + B", r.mirror_max, r.mirror_rms};
  return e;
}

Studies with_times(Studies s, const std::vector<CostRow>& rows, std::string_view isa) {
  const auto time = [&](std::string_view id) {
    const auto* r = find_row(rows, id, "float", isa, "cache");
    return r ? r->time : unknown_time;
  };
  for (auto& r : s.sampling) r.time = time(r.id);
  for (auto& r : s.lookup) r.time = time(timed_as(r));
  return s;
}

}  // namespace gonio::costing
