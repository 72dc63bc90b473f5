#pragma once
// The constants of the laws of elastic_laws.h and strain_damping.h.

namespace dartboard {

struct NeoHookeanConstants {
  double mu, lambda;  // [Pa] mu' and lambda'
  double slack;       // a - 1
};
struct StVenantKirchhoffConstants {
  double mu, lambda;  // [Pa]
};
struct CorotationalConstants {
  double mu, lambda;  // [Pa]
};
struct DampingConstants {
  double shape, bulk;  // [Pa s] time 2 mu, and time lambda
};

}  // namespace dartboard
