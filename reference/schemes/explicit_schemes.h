#pragma once
// One step of the explicit methods, from their tableaux and splittings, in any precision.

#include <string>
#include <string_view>
#include <vector>

#include "reference/spring_network.h"

namespace dartboard::reference {

bool is_explicit_scheme(std::string_view name);

/// Steps of one explicit method on one network.
///
/// pre  is_explicit_scheme(name); the network outlives this
template <class Real>
class ExplicitScheme {
 public:
  ExplicitScheme(std::string_view name, const SpringNetwork& network);
  ExplicitScheme(const ExplicitScheme&) = delete;
  ExplicitScheme& operator=(const ExplicitScheme&) = delete;

  /// y = (x, v) moves on by h [s].
  void step(std::vector<Real>& y, Real h) const;

 private:
  void runge_kutta(std::vector<Real>& y, Real h) const;
  void splitting(std::vector<Real>& y, Real h) const;
  void decay_in_turn(const std::vector<Real>& y, std::vector<Real>& v, Real h, bool there_and_back) const;
  void decay_by_series(const std::vector<Real>& y, const std::vector<Real>& kick, std::vector<Real>& v, Real h) const;

  std::string name_;
  const SpringNetwork* network_;
  SpringNetwork elastic_, dissipative_;  // the forces that have a potential, and the others
  NetworkRates<Real> rates_, elastic_rates_, dissipative_rates_;
  bool dissipates_;
};

extern template class ExplicitScheme<double>;
extern template class ExplicitScheme<long double>;

}  // namespace dartboard::reference
