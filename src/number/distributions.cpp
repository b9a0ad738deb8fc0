#include "number/distributions.h"

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/students_t.hpp>

namespace gonio {

double students_t_quantile(double probability, double freedom) {
  return boost::math::quantile(boost::math::students_t(freedom), probability);
}
double fisher_f_tail(double f, double of, double freedom) {
  return boost::math::cdf(boost::math::complement(boost::math::fisher_f(of, freedom), f));
}
double binomial_at_most(double k, double n, double p) {
  return boost::math::cdf(boost::math::binomial(n, p), k);
}
double beta_quantile(double probability, double a, double b) {
  return boost::math::ibeta_inv(a, b, probability);
}

}  // namespace gonio
