// Constants of a discrete shell that are extreme eigenvalues: H^1 norms, inf-sup constants, softest motions.
//
// Norms, (2) of the paper:
//   |V|_X^2 = 1/L^2 int |v|^2 / L^2 + |s|^2 + a^{ab} (d_a v . d_b v + L^2 d_a s . d_b s) sqrt(a) dx,
//   |q|_1^2 = 1/L^2 int q^2 / L^2 + a^{ab} d_a q d_b q sqrt(a) dx,
// invariant in place of the printed derivatives. The terms of the printed norm have different units. Here L, a length of the
// shell, is the unit of length. So the norms are pure numbers (for q in metres), the same in metres and in millimetres.
//
// Inf-sup constants of the forms that couple multipliers to the shell:
//   b of (M14)   beta_b = min_q max_V b(V, q) / (|V|_X |grad q|),
//   c of (M19)   beta_c = min_eta max_V c(eta, V) / (|V|_X |eta|),    c(eta, V) = sum_i weight_i eta_i n_i . (v + z s)_i,
// b and c in units of L too. The proof of Theorem 5 of the paper measures eta in H^{-1}; L2 is here for comparison.
//
// Softest motions: the smallest theta of a(V, W) = theta (V, W)_X for all W. In relaxed formulations a(., .) includes the form of
// normal_rotation.hpp. The first theta is the constant alpha of coercivity (Lemmas 2 and 3 of the paper). Without supports six vanish
// with the mesh size, the rigid motions. On developable surfaces relaxed formulations have a seventh.
#pragma once
#include <plastron/algebra/matrix.hpp>
#include <plastron/assembly/discrete_shell.hpp>

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace plastron::spectra {

using geometry::Vector3d;

/// z' X z = |V|_X^2 for V with nodal coordinates z and L = `length` [m], in the pattern of stiffness_matrix() (collective).
algebra::Matrix h1_matrix(const energy::ShellOperator& shell, const assembly::NodalCoordinates& coordinates,
                          double length);
/// q' K q = |q|_1^2 for scalar nodal values (collective).
algebra::Matrix scalar_h1_matrix(const energy::ShellOperator& shell, double length);

struct ContactInfSup {
  double dual = 0;  ///< |eta|: the norm dual to |w|_1 of scalar nodal fields w that vanish where supports hold the face
  double l2 = 0;    ///< |eta| = (sum_i weight_i eta_i^2)^{1/2}
  std::int64_t multipliers = 0;  ///< nodes with a multiplier
};

/// The inf-sup constant of b for a relaxed formulation. Empty if no support fixes a rotation, because b contains only
/// gradients. `length` is L [m]. (collective) Throws std::runtime_error if the eigenvalue is not found.
std::optional<double> tangency_inf_sup(const assembly::DiscreteShell& discrete, double length);

/// The inf-sup constant of c in the space of the shell's formulation. Each node has a multiplier if the obstacle's normal
/// has a part in the free displacements. Empty without such nodes. (collective) Throws like tangency_inf_sup().
///
/// At these nodes w = n . (v + z s) is a coordinate of V (nodal_coordinates.hpp). Let S w be the forces that hold w while
/// the rest of V makes |V|_X smallest. Then
///   1 / beta_c^2 = max_w w' S w / w' M w,   M the matrix of |w|_1 (dual norm), or of the weights (L2):
/// beta_c is large if every w is the gap of a small V.
std::optional<ContactInfSup> contact_inf_sup(const assembly::DiscreteShell& discrete, double length);

/// The kind of motion that dominates a mode.
enum class ModeKind {
  translation,      ///< u = c
  rotation,         ///< u = w x (phi - c), r = w x a_3, less its part among the translations
  normal_rotation,  ///< r . a_3 is constant and not zero
  deformation
};
std::string_view to_string(ModeKind kind);

struct Mode {
  double stiffness = 0;        ///< theta = a(V, V) / |V|_X^2 through strains [J]; 0 if below rounding
  double translation = 0;      ///< share of |V|_X^2 in the translations
  double rotation = 0;         ///< share in the rotations that is not in the translations
  double normal_rotation = 0;  ///< share of int |r|^2 in constant multiples of a_3

  ModeKind kind() const;
};

/// Ascending. Modes that all cost nothing are turned among themselves: translations come first, then rotations, then
/// the rest. `length` is L of the norm [m]. Precondition: no obstacle, whose nodal coordinates are not orthonormal.
/// (collective) Throws std::runtime_error if the eigenvalues do not converge.
std::vector<Mode> softest_modes(const assembly::DiscreteShell& discrete, int count, double length);

}  // namespace plastron::spectra
