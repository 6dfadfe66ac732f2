// The four ways to keep the rotation tangent, r . a_3 = 0 (docs/model.md, section 5).
#pragma once
#include <string_view>

namespace plastron::element {

enum class Formulation {
  tangent,    ///< (M12) two rotations per node, in its tangent plane
  penalised,  ///< (M13) three rotations per node; the gradient of r . a_3 is penalised
  mixed,      ///< (M14) three rotations per node and a multiplier lambda, stabilised
  classical   ///< (M15) covariant components of u and r are interpolated
};

constexpr std::string_view to_string(Formulation formulation) {
  switch (formulation) {
    case Formulation::tangent:
      return "tangent";
    case Formulation::penalised:
      return "penalised";
    case Formulation::mixed:
      return "mixed";
    case Formulation::classical:
      break;
  }
  return "classical";
}

/// The strains: linear in (u, r), or those of finite rotations (M23-M27).
enum class Rotations { small, finite };

/// Whether r . a_3 is a separate unknown.
constexpr bool is_relaxed(Formulation formulation) {
  return formulation == Formulation::penalised || formulation == Formulation::mixed;
}

/// The formulation with its dimensionless parameters. The code multiplies them by E e^3 [N m], so that the form int
/// a^{ab} d_a(r . a_3) d_b(s . a_3) sqrt(a) dx becomes an energy.
struct Tangency {
  Formulation formulation = Formulation::tangent;
  double penalty = 0.1;        ///< p of (M13), in (0, 1]: the form is multiplied by E e^3 / p
  double stabilisation = 1.0;  ///< rho of (M14), > 0: the form is multiplied by rho E e^3
};

}  // namespace plastron::element
