// Studies of fast arithmetic, of sampling and of the split sum's table: what is timed, and what is
// off.
#include "reports/cost/studies.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "base/random.h"
#include "brdf/model/evaluate.h"
#include "geometry/ggx_sampling.h"
#include "image/display.h"
#include "integrate/albedo/ggx_albedo.h"
#include "integrate/light/split_sum_table.h"
#include "reports/study/kernels.h"
#include "reports/study/sampling_weight.h"

#include <fmt/format.h>

namespace gonio::costing {
namespace {

constexpr std::string_view arithmetic = "arithmetic", in_f = "arithmetic_in_f",
                           sampled = "sampling", looked_up = "split_sum";
constexpr std::string_view masking = "masking.smith_ggx.correlated";
constexpr std::size_t table_sizes[] = {16, 32, 64};
constexpr double pi = std::numbers::pi;

/// Light and view of many samples.
struct Vectors {
  std::array<Column<float>, 3> light, view;
  explicit Vectors(std::size_t n) {
    for (auto* of : {&light, &view})
      for (auto& c : *of) c = Column<float>(n);
  }
  void set(std::size_t i, const Vector3<double>& l, const Vector3<double>& v) {
    for (std::size_t k = 0; k < 3; ++k) {
      light[k].data()[i] = static_cast<float>(l[k]);
      view[k].data()[i] = static_cast<float>(v[k]);
    }
  }
  VectorColumns columns(std::size_t n) const {
    return {{light[0].data(), light[1].data(), light[2].data()},
            {view[0].data(), view[1].data(), view[2].data()},
            n};
  }
};

Vector3<double> direction(double mu, double phi) {
  const double sine = std::sqrt((1 - mu) * (1 + mu));
  return {sine * std::cos(phi), sine * std::sin(phi), mu};
}

/// Pairs about highlights: the half vector is drawn from D of that width, neither direction is below 0.02.
Vectors highlights(double alpha, std::size_t n) {
  Vectors out(n);
  constexpr double least = 0.02;
  std::size_t i = 0;
  for (std::size_t tried = 0; i < n; ++tried) {
    Draws draw(11, tried);
    const double mu = least + (1 - least) * draw.uniform();
    const auto v = direction(mu, 2 * pi * draw.uniform());
    const double u = draw.uniform();
    const auto l = GgxNormals<double>::light(v, alpha, u, draw.uniform());
    if (l[2] > least) out.set(i++, l, v);
  }
  return out;
}

/// Values of an operation's domain, from its end to its beginning, evenly.
Column<float> domain(const FastKernel& k, std::size_t n) {
  Column<float> x(n);
  for (std::size_t i = 0; i < n; ++i)
    x.data()[i] = static_cast<float>(k.from + (k.to - k.from) * (static_cast<double>(i) + 0.5) /
                                                  static_cast<double>(n));
  return x;
}

constexpr double f0 = 0.04;
constexpr double fast_roughness[] = {0.1, 0.2, 0.4, 0.7, 1};

/// Error of f of one width, where f NoL is above a millionth of its most.
struct Off {
  static constexpr double faintest_seen = 1e-6;
  double max = 0, squares = 0, delta_e = 0;
  std::size_t n = 0;
  void add(std::span<const double> truth, const float* found, const float* nol) {
    double peak = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) peak = std::max(peak, truth[i] * double{nol[i]});
    for (std::size_t i = 0; i < truth.size(); ++i) {
      if (truth[i] * double{nol[i]} >= faintest_seen * peak) {
        const double off = double{found[i]} / truth[i] - 1;
        max = std::max(max, std::abs(off));
        squares += off * off;
        ++n;
      }
      const auto grey = [&](double f) {
        const double seen = std::clamp(f * double{nol[i]} / peak, 0.0, 1.0);
        return lab_of_display({seen, seen, seen});
      };
      delta_e = std::max(delta_e, delta_e_2000(grey(double{found[i]}), grey(truth[i])));
    }
  }
};

FastRow fast_row(const FastKernel& k) {
  FastRow r{std::string(k.id), std::string(k.name), std::string(k.operation), 0, 0, 0, 0, 0, 0, {}};
  constexpr std::size_t n = 1 << 16;
  const auto x = domain(k, n);
  Column<float> found(n);
  k.alone(x.data(), n, found.data());
  for (std::size_t i = 0; i < n; ++i) {
    const double exact = exact_operation(k.operation, double{x.data()[i]});
    // The fifth power is added to F0: where it is small it does not matter.
    const double whole = k.operation == "fifth power" ? 1 : exact;
    r.error = std::max(r.error, std::abs((double{found.data()[i]} - exact) / whole));
  }
  constexpr std::size_t pairs = 4096;
  Off by_cross, by_cosine;
  std::vector<double> truth(pairs);
  for (const double roughness : fast_roughness) {
    const double alpha = roughness * roughness;
    const std::array p{static_cast<float>(alpha), static_cast<float>(f0)};
    const auto vectors = highlights(alpha, pairs);
    const auto columns = vectors.columns(pairs);
    exact_shaded(k.operation, columns, p.data(), truth);
    for (const bool cosine : {false, true}) {
      k.shaded(columns, p.data(), cosine, found.data());
      (cosine ? by_cosine : by_cross).add(truth, found.data(), columns.light[2]);
    }
  }
  r.f_max = by_cross.max, r.f_rms = std::sqrt(by_cross.squares / static_cast<double>(by_cross.n));
  r.delta_e = by_cross.delta_e;
  r.f_max_by_cosine = by_cosine.max, r.delta_e_by_cosine = by_cosine.delta_e;
  return r;
}

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
      for (const auto& s : split_sum(masking, roughness_.back(), nov_, {1e-7, 4'000'000}))
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
    const auto exact = split_sum_table(masking, size, size, 0, {1e-5});
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
  return kind == arithmetic || kind == in_f || kind == sampled || kind == looked_up;
}

std::vector<StudySubject> study_subjects(std::string_view set, std::size_t samples) {
  std::vector<StudySubject> out;
  const auto kernels = study_kernels(set);
  const std::size_t n = (samples + padding - 1) / padding * padding;
  const auto result = std::make_shared<std::array<Column<float>, 4>>();
  for (auto& c : *result) c = Column<float>(n);
  const auto vectors = std::make_shared<Vectors>(highlights(0.25, n));
  for (const auto& k : kernels.fast) {
    const auto x = std::make_shared<Column<float>>(domain(k, n));
    out.push_back({std::string(k.id), arithmetic, "", {n, [=, alone = k.alone] {
                                                         alone(x->data(), n, (*result)[0].data());
                                                       }}});
    out.push_back({std::string(k.id),
                   in_f,
                   "in f",
                   {n, [=, shaded = k.shaded] {
                      static constexpr std::array p{0.25F, static_cast<float>(f0)};
                      shaded(vectors->columns(n), p.data(), false, (*result)[0].data());
                    }}});
  }
  const auto points = std::make_shared<std::array<Column<float>, 2>>();
  for (std::size_t k = 0; k < 2; ++k) {
    (*points)[k] = Column<float>(n);
    for (std::size_t i = 0; i < n; ++i)
      (*points)[k].data()[i] = static_cast<float>(0.01 + 0.98 * Draws(17 + k, i).uniform());
  }
  for (const auto& k : kernels.sampling)
    out.push_back({std::string(k.id), sampled, "", {n, [=, draw = k.draw] {
                                                      auto& r = *result;
                                                      draw(vectors->columns(n), (*points)[0].data(),
                                                           (*points)[1].data(), 0.25F,
                                                           {r[0].data(), r[1].data(), r[2].data(),
                                                            r[3].data()});
                                                    }}});
  const auto add_lookup = [&](std::string id, const LookupKernel& k, std::size_t size) {
    const auto texels = std::make_shared<std::vector<float>>(2 * size * size, 0.3F);
    out.push_back({std::move(id), looked_up, "", {n, [=, value = k.value] {
                                                    value((*points)[0].data(), (*points)[1].data(),
                                                          n, {texels->data(), size},
                                                          (*result)[0].data(), (*result)[1].data());
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
    for (const auto& k : study_kernels().fast) s.fast.push_back(fast_row(k));
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
  if (row.kind == arithmetic || row.kind == in_f)
    for (const auto& r : all.fast)
      if (r.id == row.id)
        return row.kind == arithmetic ? CostError{r.operation, "error, at most", r.error, r.error}
                                      : CostError{"f with an exact " + r.operation,
                                                  "relative error of f", r.f_max, r.f_rms};
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
  const auto time = [&](std::string_view id, std::string_view way = "") {
    const auto* r = find_row(rows, id, "float", isa, "cache", way);
    return r ? r->time : unknown_time;
  };
  for (auto& r : s.fast) r.time = time(r.id), r.time_in_f = time(r.id, "in f");
  for (auto& r : s.sampling) r.time = time(r.id);
  for (auto& r : s.lookup) r.time = time(timed_as(r));
  return s;
}

}  // namespace gonio::costing
