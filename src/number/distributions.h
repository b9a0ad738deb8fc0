#pragma once
/// \file
/// Quantiles and tails of distributions, by Boost: its templates cost half a minute in each file that reads them, so one does.

namespace gonio {

/// Returns the value that Student's t of `freedom` > 0 degrees stays below with that probability, in (0, 1).
double students_t_quantile(double probability, double freedom);
/// Returns the probability that Fisher's F of (of, freedom) degrees exceeds f ≥ 0.
double fisher_f_tail(double f, double of, double freedom);
/// Returns the probability of at most k hits among n, each of probability p.
double binomial_at_most(double k, double n, double p);
/// Returns the value that a beta variable of shapes a and b stays below with that probability.
double beta_quantile(double probability, double a, double b);

}  // namespace gonio
